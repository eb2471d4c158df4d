// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A BiSS C control frame alone, master side: pages 27 to 29, 34, Figures 20 to 22; decisions 5, 12,
// 24, 31. The test plays frames, slaves and RDATA.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "Vbiss_control_frame.h"
#include "places.hpp"
#include "tests/block/biss/control_script.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace at = mb4test::places::biss_pkg;

using mb4test::ControlAccess;
using mb4test::ControlScript;
using mb4test::script_of;

class ControlFrameBlock : public testing::Test {
 protected:
  struct Byte {
    unsigned place, value;
    bool operator==(const Byte&) const = default;
  };

  ControlFrameBlock() {
    m.access_i = 0;
    m.ida_invert_i = m.select_i = m.blind_i = m.rdata_i = m.post_busy_i = 0;
    m.begin_i = m.abort_i = m.start_i = m.frame_done_i = m.cds_i = 0;
    m.cdm_timeout_i = m.expired_i = m.stalled_i = m.stalled_start_i = 0;
    block.reset();
  }
  void clock() {
    m.eval();
    const auto place = static_cast<unsigned>(at::access_byte_t::kAddr.of(m.byte_o));
    if (at::access_byte_t::kWrEn.of(m.byte_o) != 0) {
      written.push_back({place, static_cast<unsigned>(at::access_byte_t::kWrData.of(m.byte_o))});
    }
    block.clock();
    m.rdata_i = static_cast<std::uint8_t>(rdata[place]);
    m.eval();
    if (at::access_end_t::kEnds.of(m.end_o) != 0) {
      EXPECT_FALSE(ended) << "it ends twice";
      ended = true;
      reg_error = at::access_end_t::kRegError.of(m.end_o) != 0;
      delay_error = at::access_end_t::kDelayError.of(m.end_o) != 0;
    }
  }
  void clocks(unsigned count) {
    for (unsigned i = 0; i < count; ++i) clock();
  }
  // One frame; cds and result: bit 0 is line 1. The CDM that each line sends.
  unsigned frame(unsigned cds) {
    m.start_i = 1;
    m.eval();
    const unsigned cdm = (cds & m.cdm1_o) | (~cds & m.cdm0_o);
    clock();
    m.start_i = 0;
    clocks(random.below(3));
    m.cds_i = static_cast<std::uint8_t>(cds);
    m.frame_done_i = 1;
    m.eval();
    in_body = m.in_body_o != 0;
    waits = m.wait_o != 0;
    clock();
    m.frame_done_i = 0;
    m.cds_i = static_cast<std::uint8_t>(random.below(4));
    clocks(1 + random.below(3));
    // Page 35: CDMTIMEOUT.
    zeros = cdm != 0 || in_body ? 0 : zeros + 1;
    m.cdm_timeout_i = zeros >= 14;
    return cdm & 3U;
  }
  void begin(const ControlAccess& started, unsigned select = 1) {
    access = started;
    script = script_of(access);
    ended = reg_error = delay_error = false;
    written.clear();
    for (unsigned i = 0; i < 64; ++i) rdata[i] = random.below(256);
    // Bytes that are on their way have not replaced the old ones.
    if (access.command) rdata[0] = m.post_busy_i != 0 ? ~access.ids & 0xFFU : access.ids;
    for (unsigned i = 0; access.write && i < access.bytes.size(); ++i) rdata[i] = access.bytes[i];
    m.access_i = access.port();
    m.select_i = static_cast<std::uint8_t>(select);
    m.begin_i = 1;
    m.eval();
    EXPECT_TRUE(m.begin_o);
    clock();
    m.begin_i = 0;
    clocks(3);
  }
  // The frames up to S. There are 14 with CDM = 0 before it, those before the access counted.
  void zeros_before() {
    while (zeros < 14) {
      ASSERT_EQ(frame(random.below(4)), 0U);
      ASSERT_FALSE(ended);
    }
  }
  // Frames of the script as long as the access runs, on the lines of m.select_i; the other line
  // answers anything. Returns the number of frames.
  unsigned play() {
    const unsigned select = m.select_i;
    unsigned at = 0;
    for (; at < script.cdm.size() && !ended; ++at) {
      const unsigned cds =
          (script.cds[at] == '1') != (static_cast<int>(at) == wrong_frame) ? select : 0U;
      const unsigned cdm = frame(cds | (random.below(4) & ~select));
      const unsigned expected = script.cdm[at] == '1' ? select : 0U;
      EXPECT_EQ(cdm, expected) << "frame " << at;
      // Zeros do not count from S to the last bit before the stop bit.
      if (expected == 0) {
        EXPECT_EQ(in_body, script.place[at] != 'p' && script.place[at] != 'z') << at;
      }
      EXPECT_EQ(waits, script.place[at] == 'w' || script.place[at] == 's') << at;
    }
    return at;
  }
  std::uint64_t good_bytes() const { return at::access_end_t::kGoodBytes.of(m.end_o); }
  ControlAccess random_access(bool write) { return mb4test::random_access(random, write, 4); }
  ControlAccess command(unsigned ids, unsigned cmd, bool tested) {
    ControlAccess made;
    made.command = true;
    made.ids = ids;
    made.cmd = cmd;
    made.tested = tested;
    return made;
  }
  std::vector<Byte> read_bytes(unsigned count) const {
    std::vector<Byte> read;
    for (unsigned i = 0; !access.write && i < count; ++i) read.push_back({i, access.bytes[i]});
    return read;
  }

  mb4test::Dice random;
  mb4test::Block<Vbiss_control_frame> block;
  Vbiss_control_frame& m = block.model;
  ControlAccess access;
  ControlScript script;
  std::array<unsigned, 64> rdata{};
  std::vector<Byte> written;
  bool ended = false, reg_error = false, delay_error = false, in_body = false, waits = false;
  unsigned zeros = 0;
  int wrong_frame = -1;
};

// TI TIDEP0022, Table 7: the CDM of slots 1 to 32 for a read of 0x67, and for a write of 0x06 to
// 0x60 (with the CRC of the header and the bits R and W set right).
TEST(ControlScript, PublishedFrames_AreMadeAsPrinted) {
  const auto read = script_of({.address = 0x67, .bytes = {0x5F}, .busy = {0}});
  EXPECT_EQ(read.cdm, "1" + mb4test::bits_of(0x8CE54000, 32));
  EXPECT_EQ(read.cds, std::string("010000000000000001") + "01" + "01011111" + "1111" + "0");
  const auto write = script_of({.write = true, .address = 0x60, .bytes = {0x06}, .busy = {0}});
  EXPECT_EQ(write.cdm, "1" + mb4test::bits_of(0x8C16C194, 32));
}

// Figure 20, Tables 28 to 31.
TEST_F(ControlFrameBlock, RandomRegisterAccesses_AreAsOnTheLine) {
  for (int round = 0; round < 200; ++round) {
    SCOPED_TRACE(testing::Message() << "round " << round);
    begin(random_access(random.below(2) != 0), 1 + random.below(2));
    zeros_before();
    ASSERT_EQ(play(), script.cdm.size());
    if (HasFailure()) return;
    ASSERT_TRUE(ended);
    ASSERT_FALSE(reg_error || delay_error || m.active_o != 0);
    ASSERT_EQ(good_bytes(), access.bytes.size());
    ASSERT_EQ(written, read_bytes(static_cast<unsigned>(good_bytes())));
  }
}

TEST_F(ControlFrameBlock, SixtyFourBytes_AreOneAccess) {
  for (const bool write : {false, true}) {
    ControlAccess long_access{.write = write, .address = 0x70, .bytes = {}, .busy = {}};
    for (unsigned i = 0; i < 64; ++i) long_access.bytes.push_back(i * 37 & 0xFF);
    long_access.busy.resize(64);
    begin(long_access);
    zeros_before();
    EXPECT_EQ(play(), 18U + 14 * 64 + 1);
    EXPECT_TRUE(ended && !reg_error);
    EXPECT_EQ(written, read_bytes(64));
  }
}

// Page 34: a wrong R or W, echo or CRC ends the access; REGBYTES tells the bytes before it. IDL and
// the bits up to R do not count. A missing S is waited for.
TEST_F(ControlFrameBlock, OneWrongAnswer_EndsTheAccess) {
  for (int round = 0; round < 400; ++round) {
    SCOPED_TRACE(testing::Message() << "round " << round);
    const ControlAccess next = random_access(random.below(2) != 0);
    const ControlScript right = script_of(next);
    unsigned at = 0;
    do {
      at = 17 + random.below(static_cast<unsigned>(right.cds.size()) - 17);
    } while (right.place[at] == 'w' || right.place[at] == 's' || right.place[at] == 'z');
    const unsigned byte = right.byte[at];
    wrong_frame = static_cast<int>(at);
    begin(next);
    zeros_before();
    const unsigned frames = play();
    if (HasFailure()) return;
    ASSERT_TRUE(ended && reg_error && !delay_error) << "frame " << at;
    ASSERT_EQ(good_bytes(), byte);
    ASSERT_EQ(written, read_bytes(byte));
    if (access.write || at < 19) {
      ASSERT_EQ(frames, at + 1) << "at once";
    } else {
      ASSERT_NE(script.place[frames - 1], 'z') << "with the CRC of the byte";
    }
  }
}

// Table 34, decision 31: EX at once, or after the acknowledge. One line or two.
TEST_F(ControlFrameBlock, Commands_AreAsOnTheLine) {
  for (unsigned round = 0; round < 300; ++round) {
    SCOPED_TRACE(testing::Message() << "round " << round);
    const bool tested = random.below(2) != 0;
    m.ida_invert_i = random.below(2) != 0;  // decision 5
    auto next = command(round % 4 == 0 ? 0 : random.below(256), random.below(4), tested);
    begin(next, 1 + random.below(3));
    if (m.ida_invert_i != 0) m.access_i ^= 1U;
    zeros_before();
    ASSERT_EQ(play(), script.cdm.size());
    if (HasFailure()) return;
    ASSERT_TRUE(ended && !reg_error && !delay_error);
    ASSERT_TRUE(written.empty());
  }
}

// Page 34: an error in IDA; tested, the command is not executed on that line (page 29).
TEST_F(ControlFrameBlock, OneWrongAcknowledge_IsAnErrorAndNotExecuted) {
  for (unsigned ida = 0; ida < 16; ++ida) {
    const unsigned ids = ida < 8 ? 0xA5 : 0xA4;
    for (const unsigned lines : {1U, 2U, 3U}) {
      for (const bool tested : {false, true}) {
        begin(command(ids, 1, tested), 3);
        zeros_before();
        for (unsigned at = 0; at < script.cdm.size(); ++at) {
          const unsigned cds = script.cds[at] == '1' ? 3U : 0U;
          const unsigned cdm = frame(at == 17 + ida % 8 ? cds ^ lines : cds);
          const unsigned sent = script.cdm[at] == '1' ? 3U : 0U;
          ASSERT_EQ(cdm, tested && at == 24 ? sent & ~lines : sent) << at;
        }
        ASSERT_TRUE(ended && reg_error && !delay_error) << ida;
      }
    }
  }
}

// Decision 24: no start bit up to the limit is nDELAYERR = 0, at the end of a frame. The limit does
// not count elsewhere.
TEST_F(ControlFrameBlock, NoStartBitUpToTheLimit_IsADelayError) {
  for (const bool write : {false, true}) {
    ControlAccess silent = random_access(write);
    silent.bytes = {1, 2};
    silent.busy = {3, 30};
    begin(silent);
    zeros_before();
    const auto wait = script.place.rfind('w');
    for (unsigned at = 0; at < wait - 10; ++at) {
      m.expired_i = script.place[at] != 'w';
      frame(script.cds[at] == '1' ? 1 : 0);
      ASSERT_FALSE(ended) << at;
    }
    m.expired_i = 1;
    frame(0);
    EXPECT_TRUE(ended && delay_error && !reg_error);
    EXPECT_EQ(good_bytes(), 1U);
    m.expired_i = 0;
  }
}

// Frames that do not end: nREGERR = 0, or nDELAYERR = 0 while S is awaited.
TEST_F(ControlFrameBlock, FramesThatDoNotEnd_EndTheAccess) {
  for (unsigned at = 0; at < 30; ++at) {
    ControlAccess slow = random_access(false);
    slow.bytes = {1};
    slow.busy = {3};
    begin(slow);
    zeros_before();
    for (unsigned i = 0; i < at; ++i) frame(script.cds[i] == '1' ? 1 : 0);
    const bool awaits = at >= 19 && at <= 22;
    m.start_i = 1;
    clock();
    m.start_i = 0;
    clocks(20);
    ASSERT_FALSE(ended);
    m.stalled_i = 1;
    m.begin_i = 1;  // still the old instruction
    clocks(3);
    EXPECT_TRUE(ended);
    EXPECT_EQ(delay_error, awaits) << at;
    EXPECT_EQ(reg_error, !awaits) << at;
    EXPECT_EQ(m.active_o, 0);
    m.stalled_i = m.begin_i = 0;
    clocks(3);
    zeros = 0;
    m.cdm_timeout_i = 0;
  }
}

// BREAK: at once and without a result, in the clock in which a frame ends too. The next access
// begins with its zeros.
TEST_F(ControlFrameBlock, Abort_EndsWithoutAResult) {
  for (unsigned round = 0; round < 84; ++round) {
    SCOPED_TRACE(round);
    const unsigned at = round / 2;
    ControlAccess stopped = random_access(false);
    stopped.bytes.resize(1);
    stopped.busy = {9};
    begin(stopped);
    zeros_before();
    ASSERT_EQ(script.cds.size(), 42U);
    for (unsigned i = 0; i < at; ++i) frame(script.cds[i] == '1' ? 1 : 0);
    const std::size_t bytes = written.size();
    if (round % 2 != 0) {
      m.start_i = 1;
      clock();
      m.start_i = 0;
      m.cds_i = script.cds[at] == '1' ? 1 : 0;
      m.frame_done_i = 1;
    }
    m.abort_i = 1;
    clock();
    m.abort_i = m.frame_done_i = 0;
    clocks(3);
    EXPECT_EQ(written.size(), bytes);
    EXPECT_FALSE(ended);
    EXPECT_EQ(m.active_o, 0);
    EXPECT_EQ(good_bytes(), 0U);
    EXPECT_EQ(m.active_start_o, 0);
    frame(1);
    EXPECT_FALSE(ended || in_body);
  }
}

// Page 13: SSI has no CDS. A write counts as right, a read cannot be.
TEST_F(ControlFrameBlock, LineWithoutCds_OnlyWrites) {
  for (const bool write : {true, false}) {
    m.blind_i = 1;
    ControlAccess blind = random_access(write);
    blind.busy.assign(blind.busy.size(), 0);
    begin(blind);
    zeros_before();
    for (auto& bit : script.cds) bit = '0';
    const unsigned frames = play();
    EXPECT_TRUE(ended);
    EXPECT_EQ(reg_error, !write);
    EXPECT_EQ(frames, write ? script.cdm.size() : 18U);
    EXPECT_EQ(good_bytes(), write ? blind.bytes.size() : 0U);
    EXPECT_TRUE(written.empty());
  }
}

// The frame that runs while the access begins carries no bit of it. IDS is what the host wrote
// before, also if it has not arrived yet.
TEST_F(ControlFrameBlock, BeginInAFrame_CountsFromTheNextOne) {
  for (int round = 0; round < 20; ++round) {
    while (zeros < 14) frame(0);
    m.start_i = 1;
    clock();
    m.start_i = 0;
    m.post_busy_i = 1;
    begin(command(random.below(256), 2, false));
    clocks(5);
    rdata[0] = access.ids;
    clocks(2);
    m.post_busy_i = 0;
    m.frame_done_i = 1;
    clock();
    m.frame_done_i = 0;
    clocks(3);
    EXPECT_EQ(play(), script.cdm.size());
    EXPECT_TRUE(ended && !reg_error);
  }
}

}  // namespace
