// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Messages and resources by dsl/messages.hpp and dsl/resources.hpp on the RTL, in both maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/lines/dsl/dsl_faults.hpp"
#include "tests/driver/dsl/dsl_rig.hpp"

namespace {

namespace fault = mb4::sim::slave_fault;
using dsl::Error;
using mb4test::DslRig;

constexpr std::uint32_t kLimitUs = 40'000;
constexpr std::uint8_t kPing = 0x7F;
const char* const kResources =
    "hardware_version = 0x5A\naccess_level = 1\n"
    "[[channel.slave.resource]]\nid = 0x200\nname = \"MOTOR\"\ntype = \"node\"\n"
    "[[channel.slave.resource]]\nid = 0x201\nname = \"PLATE\"\ntype = \"string\"\n"
    "value = \"AX-400 no. 17\"\nparent = 0x200\nwrite_level = 2\ntimeout_ms = 100\n"
    "[[channel.slave.resource]]\nid = 0x202\nname = \"TEMP\"\ntype = \"i16\"\nvalue = -5\n"
    "parent = 0x200\n"
    "[[channel.slave.resource]]\nid = 0x203\nname = \"SECRET\"\ntype = \"u32\"\nvalue = 42\n"
    "parent = 0x200\nread_level = 3\n"
    "[[channel.slave.resource]]\nid = 0x204\nname = \"TABLE\"\ntype = \"u16\"\nvalue = 9\n"
    "parent = 0x200\nwrite_level = 1\n";

class DslTalkTest : public testing::TestWithParam<bool> {
 protected:
  DslTalkTest() : rig(kResources, GetParam() ? "[chip.quirks]\nSDK_MAP = true\n" : "") {
    rig.link();
    rig.frames(20);
  }
  DslRig rig;
};
INSTANTIATE_TEST_SUITE_P(Maps, DslTalkTest, testing::Values(false, true),
                         [](const auto& map) { return map.param ? "Sdk" : "Ours"; });

dsl::LongRequest request(std::uint16_t resource, std::uint8_t size, bool indirect = true,
                         std::uint16_t offset = 0) {
  dsl::LongRequest made;
  made.resource = resource;
  made.size = size;
  made.indirect = indirect;
  made.offset = offset;
  return made;
}

TEST_P(DslTalkTest, Short_ReadsAndWrites) {
  for (auto* host : {&rig.messages, &rig.of_safe_host}) {
    auto value = host->read(kPing, kLimitUs);
    ASSERT_TRUE(value);
    EXPECT_EQ(*value, host == &rig.messages ? 0x5A : 0x33);
    ASSERT_TRUE(host->write(kPing, 0x33, kLimitUs));
    value = host->read(kPing, kLimitUs);
    ASSERT_TRUE(value);
    EXPECT_EQ(*value, 0x33);
  }
}

TEST_P(DslTalkTest, Long_ReadsWritesAndTellsErrors) {
  auto answer = rig.messages.ask(request(0x202, 2), kLimitUs);
  ASSERT_TRUE(answer);
  EXPECT_EQ(static_cast<std::int16_t>(answer->number()), -5);
  dsl::LongRequest write = request(0x204, 2);
  write.write = true;
  write.data = {0x12, 0x34};
  ASSERT_TRUE(rig.messages.ask(write, kLimitUs));
  answer = rig.messages.ask(request(0x204, 2), kLimitUs);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->number(), 0x1234U);
  // The host's level is 1.
  answer = rig.messages.ask(request(0x203, 4), kLimitUs);
  ASSERT_EQ(answer.error(), Error::kEncoder);
  EXPECT_EQ(answer.info().encoder, 0x4112);
  // Eight bytes of a text, the second part of it.
  answer = rig.messages.ask(request(0x201, 8, true, 8), kLimitUs);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->data[0], 'o');
  // A request without data: RESET gives PING its first value.
  ASSERT_TRUE(rig.messages.write(kPing, 1, kLimitUs));
  dsl::LongRequest reset = request(0x100, 0);
  reset.write = true;
  ASSERT_TRUE(rig.messages.ask(reset, kLimitUs));
  const auto ping = rig.messages.read(kPing, kLimitUs);
  ASSERT_TRUE(ping);
  EXPECT_EQ(*ping, 0x5A);
}

TEST_P(DslTalkTest, Walk_IsTheTree) {
  std::string text;
  const auto done =
      dsl::walk(rig.messages, kLimitUs, [&text](const dsl::Resource& resource, unsigned depth) {
        text += std::string(depth, ' ') + resource.name.data() + " " +
                std::to_string(static_cast<unsigned>(resource.type)) + " " +
                std::to_string(resource.size) + " " + std::to_string(resource.read_level) + " " +
                std::to_string(resource.write_level) + " " + std::to_string(resource.time_ms) +
                "\n";
      });
  ASSERT_TRUE(done) << static_cast<int>(done.error()) << "\n" << text;
  // docs/dsl.md, "Messages of the encoder", and the scenario.
  EXPECT_NE(text.find("ROOT 0 2 0 15 "), std::string::npos) << text;
  EXPECT_NE(text.find(" RESOLUTN 5 4 "), std::string::npos) << text;
  EXPECT_NE(text.find(" FWDATE 11 "), std::string::npos) << text;
  EXPECT_NE(text.find(" RESET 1 "), std::string::npos) << text;
  EXPECT_NE(text.find(" MOTOR 0 2 0 15 0\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  PLATE 11 13 0 2 100\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  TEMP 8 2 0 "), std::string::npos) << text;
  EXPECT_NE(text.find("  SECRET 5 4 3 "), std::string::npos) << text;
}

TEST_P(DslTalkTest, InSteps_ShortAndLongTogether) {
  EXPECT_EQ(rig.messages.poll_short().error(), Error::kArgument);
  EXPECT_EQ(rig.messages.poll_long().error(), Error::kArgument);
  ASSERT_TRUE(rig.messages.begin(request(0x202, 2), kLimitUs));
  ASSERT_TRUE(rig.messages.begin_read(kPing, kLimitUs));
  EXPECT_EQ(rig.messages.begin(request(0x202, 2), kLimitUs).error(), Error::kBusy);
  EXPECT_EQ(rig.messages.begin_write(kPing, 7, kLimitUs).error(), Error::kBusy);
  unsigned short_frames = 0, long_frames = 0;
  for (unsigned i = 1; short_frames == 0 || long_frames == 0; ++i) {
    ASSERT_LT(i, 500U);
    rig.frames(1);
    ASSERT_TRUE(rig.device.position());
    if (short_frames == 0) {
      const auto value = rig.messages.poll_short();
      if (value) {
        EXPECT_EQ(*value, 0x5A);
        short_frames = i;
      } else {
        ASSERT_EQ(value.error(), Error::kBusy);
      }
    }
    if (long_frames == 0) {
      const auto answer = rig.messages.poll_long();
      if (answer) {
        EXPECT_EQ(static_cast<std::int16_t>(answer->number()), -5);
        long_frames = i;
      } else {
        ASSERT_EQ(answer.error(), Error::kBusy);
      }
    }
  }
  // The short one goes first (F12).
  EXPECT_LT(short_frames, long_frames);
}

TEST_P(DslTalkTest, WrongCalls_ChangeNothing) {
  rig.arm({});
  EXPECT_EQ(rig.messages.read(0x3F, kLimitUs).error(), Error::kArgument);
  EXPECT_EQ(rig.messages.write(0x80, 0, kLimitUs).error(), Error::kArgument);
  for (const std::uint8_t size : std::vector<std::uint8_t>{1, 3, 5, 9}) {
    EXPECT_EQ(rig.messages.ask(request(0x202, size), kLimitUs).error(), Error::kArgument);
  }
  EXPECT_EQ(rig.messages.ask(request(0x400, 2), kLimitUs).error(), Error::kArgument);
  EXPECT_EQ(rig.messages.ask(request(0x202, 2, true, 0x8000), kLimitUs).error(), Error::kArgument);
  EXPECT_EQ(rig.of_safe_host.ask(request(0x202, 2), kLimitUs).error(), Error::kArgument);
  EXPECT_EQ(rig.accesses(), 0U);
}

TEST_P(DslTalkTest, SilentEncoder_TimeoutThenTheChannelIsFree) {
  rig.set_fault(fault::kNoMessage);
  EXPECT_EQ(rig.messages.read(kPing, 3000).error(), Error::kTimeout);
  EXPECT_EQ(rig.messages.poll_short().error(), Error::kArgument);
  rig.set_fault(fault::kNoMessage, false);
  rig.frames(100);
  EXPECT_EQ(*rig.messages.read(kPing, kLimitUs), 0x5A);
  rig.set_fault(fault::kNoMessage);
  EXPECT_EQ(rig.messages.ask(request(0x202, 2), 3000).error(), Error::kTimeout);
  rig.set_fault(fault::kNoMessage, false);
  // The reset is under way: INIT must be acknowledged first.
  EXPECT_EQ(rig.messages.begin_read(kPing, kLimitUs).error(), Error::kBusy);
  EXPECT_EQ(rig.messages.begin(request(0x202, 2), kLimitUs).error(), Error::kBusy);
  rig.frames(100);
  EXPECT_TRUE(rig.messages.ask(request(0x202, 2), kLimitUs));
  // A clock that stands still.
  rig.set_fault(fault::kNoMessage);
  rig.clock_stands = true;
  EXPECT_EQ(rig.messages.read(kPing, 200).error(), Error::kTimeout);
  rig.set_fault(fault::kNoMessage, false);
  rig.frames(100);
  EXPECT_TRUE(rig.device.position());
}

TEST_P(DslTalkTest, Refused_LongEndsAndShortGoesAgain) {
  rig.set_fault(fault::kMessageNak);
  EXPECT_EQ(rig.messages.ask(request(0x202, 2), kLimitUs).error(), Error::kRefused);
  ASSERT_TRUE(rig.messages.begin_read(kPing, kLimitUs));
  rig.frames(200);
  EXPECT_EQ(rig.messages.poll_short().error(), Error::kBusy);
  rig.set_fault(fault::kMessageNak, false);
  rig.frames(100);
  const auto value = rig.messages.poll_short();
  ASSERT_TRUE(value);
  EXPECT_EQ(*value, 0x5A);
  // A refusal leaves nothing for the next one.
  EXPECT_TRUE(rig.messages.ask(request(0x202, 2), kLimitUs));
}

TEST_P(DslTalkTest, ResetByTheOther_IsReset) {
  rig.set_fault(fault::kNoMessage);
  ASSERT_TRUE(rig.messages.begin_read(kPing, kLimitUs));
  ASSERT_TRUE(rig.messages.begin(request(0x202, 2), kLimitUs));
  rig.frames(20);
  rig.set_fault(fault::kNoMessage, false);
  ASSERT_TRUE(rig.of_safe_host.reset());
  rig.frames(100);
  EXPECT_EQ(rig.messages.poll_short().error(), Error::kReset);
  EXPECT_EQ(rig.messages.poll_long().error(), Error::kReset);
  EXPECT_EQ(*rig.messages.read(kPing, kLimitUs), 0x5A);
}

TEST_P(DslTalkTest, EndOfTheLink_LongRefusedShortGoesAgain) {
  ASSERT_TRUE(rig.messages.begin(request(0x201, 8), kLimitUs));
  rig.frames(4);
  rig.set_fault(fault::kSilent);
  rig.frames(10);
  EXPECT_EQ(rig.messages.poll_long().error(), Error::kRefused);
  ASSERT_TRUE(rig.messages.begin_read(kPing, kLimitUs));
  rig.frames(50);
  EXPECT_EQ(rig.messages.poll_short().error(), Error::kBusy);
  rig.set_fault(fault::kSilent, false);
  rig.frames(400);
  const auto value = rig.messages.poll_short();
  ASSERT_TRUE(value);
  EXPECT_EQ(*value, 0x5A);
}

TEST_P(DslTalkTest, EachFailedAccess_IsBus) {
  const std::vector<std::function<Error()>> calls = {
      [&] { return rig.messages.read(kPing, kLimitUs).error(); },
      [&] { return rig.messages.write(kPing, 0x5A, kLimitUs).error(); },
      [&] { return rig.messages.ask(request(0x202, 2), kLimitUs).error(); },
      [&] { return dsl::describe(rig.messages, 0x202, kLimitUs).error(); },
      [&] { return dsl::number_in(rig.messages, 0x200, 0, kLimitUs).error(); }};
  for (std::size_t call = 0; call < calls.size(); ++call) {
    rig.arm({});
    ASSERT_EQ(calls[call](), Error::kNone) << call;
    const std::uint64_t last = rig.accesses();
    // Up to its first polls, and the last ones of the message with what follows them.
    for (std::uint64_t access = 0; access < last; ++access) {
      if (access == 20) access = std::max(access, last - 5);
      rig.arm({.fails = access, .flips = {}, .hole = {}});
      const Error error = calls[call]();
      const bool reached = rig.accesses() > access;
      rig.arm({});
      EXPECT_EQ(error, reached ? Error::kBus : Error::kNone) << call << ", access " << access;
      // The message may run on in the master.
      ASSERT_TRUE(rig.messages.reset());
      rig.frames(50);
      while (rig.messages.poll_short().error() != Error::kArgument) rig.frames(1);
      while (rig.messages.poll_long().error() != Error::kArgument) rig.frames(1);
    }
    EXPECT_EQ(calls[call](), Error::kNone) << call;
  }
  rig.arm({.fails = 0, .flips = {}, .hole = {}});
  EXPECT_EQ(rig.messages.reset().error(), Error::kBus);
  // The answer is there and cannot be read; then it can, and is not lost.
  for (const std::uint32_t hole : {0x20U, 0x24U, 0x28U}) {
    rig.arm({.fails = {}, .flips = {}, .hole = hole});
    ASSERT_EQ(rig.messages.ask(request(0x202, 2), kLimitUs).error(), Error::kBus) << hole;
    rig.arm({});
    const auto answer = rig.messages.poll_long();
    ASSERT_TRUE(answer);
    EXPECT_EQ(static_cast<std::int16_t>(answer->number()), -5);
  }
}

// A master without messages.
struct WithoutMessages {
  std::uint32_t features = 0;
  bool read(std::uint32_t offset, std::uint32_t& word) const {
    word = offset == dsl::page::kAddrId ? dsl::page::kResetId : features;
    return true;
  }
  bool write(std::uint32_t, std::uint8_t) { return true; }
  std::uint32_t now_us() const { return 0; }
};

TEST(DslTalk, MasterWithoutMessages_IsAbsent) {
  WithoutMessages master;
  dsl::Device<WithoutMessages> device(master);
  dsl::Messages<WithoutMessages, WithoutMessages> messages(device, master);
  ASSERT_TRUE(device.start());
  EXPECT_EQ(messages.read(kPing, 10).error(), Error::kAbsent);
  EXPECT_EQ(messages.ask(request(0x202, 2), 10).error(), Error::kAbsent);
  EXPECT_EQ(dsl::describe(messages, 0, 10).error(), Error::kAbsent);
  EXPECT_EQ(dsl::walk(messages, 10, [](const dsl::Resource&, unsigned) {}).error(), Error::kAbsent);
}

}  // namespace
