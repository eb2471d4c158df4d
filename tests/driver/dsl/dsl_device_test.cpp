// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Link, position, safe position, quality and events of dsl/device.hpp on the RTL. Every bit of
// every bus answer is flipped once.
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/lines/dsl/dsl_faults.hpp"
#include "tests/driver/dsl/dsl_rig.hpp"

namespace {

namespace fault = mb4::sim::slave_fault;
namespace page = dsl::page;
using dsl::Error;
using mb4test::DslRig;

constexpr dsl::SafeRules kRules = [] {
  dsl::SafeRules rules;
  rules.bits2 = mb4test::kDslBits;
  return rules;
}();

template <typename T>
Error error_of(const dsl::Result<T>& result) {
  return result.error();
}

TEST(DslDriver, Start_LinkAndEncoder) {
  DslRig rig;
  ASSERT_TRUE(rig.device.start());
  const auto early = rig.device.linked();
  ASSERT_TRUE(early);
  EXPECT_FALSE(*early);
  EXPECT_EQ(rig.device.position().error(), Error::kNoLink);
  EXPECT_EQ(rig.device.safe(kRules).error(), Error::kNoLink);
  const auto found = rig.device.wait_for_link(rig, 5000);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->position_bits, mb4test::kDslBits);
  EXPECT_EQ(found->acceleration_bits, 11);
  EXPECT_TRUE(found->is_signed);
  ASSERT_TRUE(rig.device.stop());
  rig.frames(3);
  EXPECT_EQ(rig.device.position().error(), Error::kNoLink);
  // From a stopped master, and from a link.
  rig.link();
  rig.link();
  EXPECT_TRUE(rig.device.position());
}

TEST(DslDriver, NoEncoder_TimeoutAlsoWithoutAClock) {
  DslRig rig;
  rig.set_fault(fault::kSilent);
  ASSERT_TRUE(rig.device.start());
  EXPECT_EQ(rig.device.wait_for_link(rig, 3000).error(), Error::kTimeout);
  rig.clock_stands = true;
  EXPECT_EQ(rig.device.wait_for_link(rig, 300).error(), Error::kTimeout);
}

// Memory in which nothing is a DSL master.
struct Nothing {
  std::uint32_t word = 0xFFFFFFFF;
  unsigned writes = 0;
  bool read(std::uint32_t, std::uint32_t& value) const {
    value = word;
    return true;
  }
  bool write(std::uint32_t, std::uint8_t) {
    ++writes;
    return true;
  }
};

TEST(DslDriver, AnotherMaster_IsAbsentAndUntouched) {
  for (const std::uint32_t word : {0U, 0xFFFFFFFFU, 0x454E4304U}) {
    Nothing nothing{word};
    dsl::Device<Nothing> device(nothing);
    EXPECT_EQ(device.start().error(), Error::kAbsent);
    EXPECT_EQ(nothing.writes, 0U);
  }
}

TEST(DslDriver, MemoryPort_IsTheAddressSpace) {
  alignas(4) std::uint8_t memory[8] = {1, 2, 3, 4, 5, 6, 7, 8};
  dsl::MemoryPort port(memory);
  EXPECT_TRUE(port.write(6, 0x77));
  std::uint32_t word = 0;
  EXPECT_TRUE(port.read(4, word));
  EXPECT_EQ(word, 0x08770605U);
}

TEST(DslDriver, Position_IsThatOfTheEncoderInEachFrame) {
  DslRig rig;
  rig.link();
  std::int64_t offset = 0;
  for (unsigned i = 0; i < 400; ++i) {
    rig.frames(1);
    const auto now = rig.device.position();
    ASSERT_TRUE(now);
    // The frame's number counts the encoder's samples.
    ASSERT_TRUE(rig.was_at(now->position, 3)) << i;
    std::size_t at = rig.truth.size() - 1;
    while (rig.truth[at] != now->position) --at;
    if (i == 0) offset = static_cast<std::int64_t>(at) - now->frame;
    ASSERT_EQ(static_cast<std::int64_t>(at) - now->frame, offset);
    ASSERT_EQ(now->speed, rig.truth[at] - rig.truth[at - 1]);
    ASSERT_EQ(now->quality, 15);
  }
}

TEST(DslDriver, MissingWord_UncertainAndNeverWrong) {
  DslRig rig;
  rig.link();
  rig.set_fault(fault::kFastMarker);
  rig.frames(2);
  rig.set_fault(fault::kFastMarker, false);
  unsigned uncertain = 0;
  for (unsigned i = 0; i < 200; ++i) {
    rig.frames(1);
    const auto now = rig.device.position();
    if (now) {
      ASSERT_TRUE(rig.was_at(now->position, 3));
    } else {
      ASSERT_EQ(now.error(), Error::kUncertain);
      ++uncertain;
    }
  }
  EXPECT_GE(uncertain, 7U);
  EXPECT_LE(uncertain, 64U);
}

TEST(DslDriver, Safe_IsAPositionOfTheEncoder) {
  DslRig rig;
  rig.link();
  rig.frames(20);
  dsl::ToggleWatch toggle;
  std::set<std::int64_t> seen;
  for (unsigned i = 0; i < 400; ++i) {
    // Of all phases of a vertical frame.
    rig.simulator().advance(mb4test::kDslFrame * 3 / 7);
    const auto safe = rig.device.safe(kRules);
    ASSERT_TRUE(safe) << static_cast<int>(safe.error()) << " in step " << i;
    ASSERT_TRUE(rig.was_at(safe->position, 20));
    ASSERT_LE(safe->age, 8U);
    const auto now = rig.device.position();
    ASSERT_TRUE(now);
    ASSERT_TRUE(toggle.fits(*safe, now->frame)) << i;
    seen.insert(safe->position);
  }
  EXPECT_GE(seen.size(), 20U);
}

TEST(DslDriver, ToggleThatStands_IsSeen) {
  dsl::ToggleWatch watch;
  dsl::SafePosition safe;
  EXPECT_TRUE(watch.fits(safe, 100));
  EXPECT_TRUE(watch.fits(safe, 102));   // the same vertical frame
  EXPECT_TRUE(watch.fits(safe, 116));   // two later
  EXPECT_FALSE(watch.fits(safe, 124));  // one later
  safe.toggle = true;
  EXPECT_TRUE(watch.fits(safe, 132));
  watch.restart();
  safe.toggle = false;
  EXPECT_TRUE(watch.fits(safe, 140));
}

// What a fault of the encoder does to safe().
struct SafeCase {
  const mb4::sim::SlaveFault* kind;
  Error error;
};

TEST(DslDriver, Safe_EachFaultHasItsError) {
  const SafeCase cases[] = {
      {&fault::kWrongCrc, Error::kNoSafe},           {&fault::kWrongCrc2, Error::kNoSafe},
      {&fault::kSafeMarker, Error::kNoSafe},         {&fault::kSafe2Marker, Error::kNoSafe},
      {&fault::kSafe2Mismatch, Error::kSafeDiffers}, {&fault::kTest2, Error::kSafeState},
      {&fault::kError2, Error::kSafeState},          {&fault::kFix2, Error::kSafeState},
      {&fault::kToggle2, Error::kSafeState},         {&fault::kStaleSafe, Error::kSafeState},
      {&fault::kEarlyVsync, Error::kSafeState},      {&fault::kLateVsync, Error::kSafeState},
      {&fault::kNoVsync, Error::kSafeState}};
  for (const SafeCase& each : cases) {
    SCOPED_TRACE(std::string(each.kind->name));
    DslRig rig;
    rig.link();
    rig.frames(20);
    ASSERT_TRUE(rig.device.safe(kRules));
    rig.set_fault(*each.kind);
    std::set<Error> errors;
    for (unsigned i = 0; i < 34; ++i) {
      rig.frames(1);
      const auto safe = rig.device.safe(kRules);
      if (!safe) errors.insert(safe.error());
    }
    EXPECT_EQ(errors.count(each.error), 1U);
    EXPECT_LE(errors.size(), 2U);
  }
  DslRig rig;
  rig.link();
  rig.frames(20);
  dsl::SafeRules fresh = kRules;
  fresh.max_age = 2;
  std::set<Error> errors;
  for (unsigned i = 0; i < 16; ++i) {
    rig.frames(1);
    errors.insert(rig.device.safe(fresh).error());
  }
  EXPECT_EQ(errors, (std::set<Error>{Error::kNone, Error::kSafeOld}));
}

// Words of a bus that is slow: the two positions are the same, their vertical frames are not.
TEST(DslDriver, Safe_ChannelsOfTwoVerticalFrames_AreOld) {
  const auto words = [](std::uint64_t position, std::uint8_t state, std::uint32_t age) {
    const std::uint64_t covered = std::uint64_t{state} << 40U | position;
    dsl::SafeWords made;
    made.low = static_cast<std::uint32_t>(position);
    made.high = static_cast<std::uint32_t>(position >> 32U);
    made.check = page::SAFE1_GOOD::kMask | std::uint32_t{state} << 16U |
                 (enc::crc(0x190D9, 0, covered, 48) ^ 0x00FFU);
    made.age = age;
    return made;
  };
  constexpr std::uint64_t kMask = (std::uint64_t{1} << 40) - 1;
  const dsl::Encoder encoder{mb4test::kDslBits, 11, true};
  const auto judged = [&](std::uint32_t first, std::uint32_t second) {
    return dsl::check_safe(words(77, 0, first), words(~std::uint64_t{77} & kMask, 0x1C, second), 0,
                           encoder, kRules)
        .error();
  };
  EXPECT_EQ(judged(3, 3), Error::kNone);
  EXPECT_EQ(judged(3, 10), Error::kNone);  // the bus took seven frames
  EXPECT_EQ(judged(3, 2), Error::kSafeOld);
  EXPECT_EQ(judged(3, 11), Error::kSafeOld);
  EXPECT_EQ(judged(17, 17), Error::kSafeOld);
}

TEST(DslDriver, NarrowSecondPosition_IsComparedByItsBits) {
  DslRig rig("safe2_bits = 20\n");
  rig.link();
  rig.frames(20);
  dsl::SafeRules rules = kRules;
  rules.bits2 = 20;
  rules.tolerance = 0;
  EXPECT_TRUE(rig.device.safe(rules));
  rules.bits2 = 19;  // not what the encoder has
  rules.tolerance = 0;
  EXPECT_EQ(rig.device.safe(rules).error(), Error::kSafeDiffers);
  rules.bits2 = 0;
  EXPECT_TRUE(rig.device.safe(rules));
}

TEST(DslDriver, Safe_EachFlippedBit_NoWrongPosition) {
  DslRig rig;
  rig.link();
  rig.frames(20);
  rig.arm({});
  ASSERT_TRUE(rig.device.safe(kRules));
  const std::uint64_t reads = rig.reads();
  ASSERT_EQ(reads, 9U);
  for (std::uint64_t read = 0; read < reads; ++read) {
    for (unsigned bit = 0; bit < 32; ++bit) {
      rig.frames(1);
      rig.arm({.fails = {}, .flips = read, .hole = {}, .bit = bit});
      const auto safe = rig.device.safe(kRules);
      const bool once = rig.reads() == reads;  // no vertical frame has ended meanwhile
      rig.arm({});
      // Position, state and CRC of both channels, and whether they are good; not ages and
      // SAFE_STATUS.
      const std::uint64_t word = read % 4;
      const bool covered = once && read < 8 && (word < 2 || (word == 2 && (bit < 24 || bit > 29)));
      ASSERT_FALSE(covered && safe) << "read " << read << ", bit " << bit;
      ASSERT_TRUE(!safe || rig.was_at(safe->position, 20)) << "read " << read << ", bit " << bit;
    }
  }
}

// The bits that nothing protects in position(), as docs/dsl.md names them.
TEST(DslDriver, Position_EachFlippedBit_OnlyTheNamedOnesPass) {
  DslRig rig;
  rig.link();
  rig.frames(20);
  rig.arm({});
  ASSERT_TRUE(rig.device.position());
  ASSERT_EQ(rig.reads(), 5U);
  std::vector<std::set<unsigned>> wrong(5);  // by the read: a value that is not the encoder's
  for (unsigned read = 0; read < 5; ++read) {
    for (unsigned bit = 0; bit < 32; ++bit) {
      rig.frames(1);
      const auto before = rig.device.position();
      rig.arm({.fails = {}, .flips = read, .hole = {}, .bit = bit});
      const auto now = rig.device.position();
      rig.arm({});
      const auto after = rig.device.position();
      ASSERT_TRUE(before && after);
      const auto same = [&now](const dsl::Position& other) {
        return now->position == other.position && now->speed == other.speed &&
               now->frame == other.frame && now->quality == other.quality;
      };
      if (now && !same(*before) && !same(*after)) wrong[read].insert(bit);
    }
  }
  for (unsigned read = 0; read < 4; ++read) EXPECT_EQ(wrong[read].size(), 32U) << read;
  // FRAME_STATUS: only the quality.
  EXPECT_EQ(wrong[4], (std::set<unsigned>{8, 9, 10, 11}));
}

TEST(DslDriver, EachFailedAccess_IsBus) {
  DslRig rig;
  rig.link();
  rig.frames(20);
  const dsl::Events some{};
  const std::vector<std::function<Error()>> calls = {
      [&] { return error_of(rig.device.linked()); },
      [&] { return error_of(rig.device.wait_for_link(rig, 5000)); },
      [&] { return error_of(rig.device.position()); },
      [&] { return error_of(rig.device.safe(kRules)); },
      [&] { return error_of(rig.device.quality()); },
      [&] { return error_of(rig.device.take_events()); },
      [&] { return error_of(rig.device.mask_events(some, 0)); },
      [&] { return error_of(rig.device.enable_interrupts(0)); },
      [&] { return error_of(rig.device.take_interrupts()); },
      [&] { return error_of(rig.device.reset_messages()); },
      [&] { return error_of(rig.device.start()); },
      [&] { return error_of(rig.device.stop()); }};
  for (std::size_t call = 0; call < calls.size(); ++call) {
    rig.arm({});
    ASSERT_EQ(calls[call](), Error::kNone) << call;
    const std::uint64_t accesses = rig.accesses();
    ASSERT_GE(accesses, 1U);
    for (std::uint64_t access = 0; access < accesses; ++access) {
      rig.arm({.fails = access, .flips = {}, .hole = {}});
      const Error error = calls[call]();
      rig.arm({});
      EXPECT_EQ(error, Error::kBus) << call << ", access " << access;
    }
  }
}

TEST(DslDriver, QualityAndEvents) {
  DslRig rig;
  rig.link();
  rig.frames(20);
  auto quality = rig.device.quality();
  ASSERT_TRUE(quality);
  EXPECT_EQ(quality->quality, 15);
  // 30 m, there and back, and 95 ns in the encoder: 413 ns, in bits of 106.67 ns.
  EXPECT_EQ(quality->delay_bits, 4);
  EXPECT_NE(quality->edges, 0);
  EXPECT_EQ(quality->restarts, 0);
  EXPECT_EQ(quality->illegal_words, 0);
  ASSERT_TRUE(rig.device.take_events());
  auto events = rig.device.take_events();
  ASSERT_TRUE(events);
  EXPECT_EQ(events->high | events->low | events->safe, 0);

  // Interrupts: each event of the mask raises one, and is cleared by what reads it.
  dsl::Events mask;
  mask.high = dsl::regs::SCE::kMask;
  mask.safe = dsl::regs::S_SCE::kMask;
  ASSERT_TRUE(rig.device.mask_events(mask, 0));
  ASSERT_TRUE(rig.device.take_interrupts());
  ASSERT_TRUE(rig.device.enable_interrupts(page::EVENT::kMask | page::SAFE_EVENT::kMask));
  rig.set_fault(fault::kWrongCrc);
  rig.frames(8);  // one vertical frame
  rig.set_fault(fault::kWrongCrc, false);
  rig.frames(17);
  const auto pending = rig.device.take_interrupts();
  ASSERT_TRUE(pending);
  EXPECT_EQ(*pending & (page::EVENT::kMask | page::SAFE_EVENT::kMask),
            page::EVENT::kMask | page::SAFE_EVENT::kMask);
  events = rig.device.take_events();
  ASSERT_TRUE(events);
  EXPECT_EQ(events->high & 0x7F, dsl::regs::SCE::kMask);
  EXPECT_EQ(events->safe & 0x7F, dsl::regs::S_SCE::kMask | dsl::regs::S_QMLW::kMask);
  EXPECT_EQ(events->low, dsl::regs::QMLW::kMask);
  events = rig.device.take_events();
  ASSERT_TRUE(events);
  EXPECT_EQ(events->high | events->safe, 0);

  // A restart is counted and has a reason.
  rig.set_fault(fault::kSilent);
  rig.frames(10);
  rig.set_fault(fault::kSilent, false);
  rig.frames(300);
  quality = rig.device.quality();
  ASSERT_TRUE(quality);
  EXPECT_GE(quality->restarts, 1);
  EXPECT_NE(quality->restart_reason, 0);
}

}  // namespace
