// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The control communication alone, both lines: datasheet pages 27 to 29, 32, 34, 35; decisions 20,
// 24, 37, 38, 42. The test plays the sequence of frames, the slaves and RDATA.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "Vmb4_control_comm.h"
#include "mb4_regs.hpp"
#include "places.hpp"
#include "tests/block/biss/control_script.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace reg = mb4::regs;
namespace places = mb4test::places;
namespace kind_t = places::mb4_pkg::kind_t;
namespace go_t = places::biss_pkg::line_go_t;
using mb4test::ControlAccess;
using mb4test::ControlScript;

// Half MA periods with FREQR = 0: 4096 register clocks of two MA periods, and 9/8 of it.
constexpr unsigned kLimit = 4096 * 2 * 2, kStall = kLimit / 8 * 9;
constexpr unsigned kBissC = 1, kSsi = 2, kUnused = 3;  // Table 8

class ControlCommBlock : public testing::Test {
 protected:
  struct Byte {
    unsigned place, value;
    bool operator==(const Byte&) const = default;
  };

  ControlCommBlock() {
    for (auto& word : m.cfg_i.m_storage) word = 0;
    m.quirks_i = m.instr_i = m.rdata_i = m.post_busy_i = 0;
    m.begin_i = m.register_want_i = m.void_i = m.refused_i = m.clear_i = m.init_clear_i = 0;
    m.go_i = m.start_use_i = m.frame_done_i = m.automatic_i = 0;
    m.status_i = line_status(0, 0, 0) | line_status(1, 0, 0);
    m.live_i = m.tick_i = 1;
    lines(kBissC, kBissC);
    block.reset();
  }
  // A line that is idle, with SL = 1.
  static std::uint16_t line_status(unsigned line, unsigned cds, unsigned cdm) {
    using namespace places::biss_pkg::line_status_t;
    const std::uint64_t status = kIdle(1) | kCds(cds) | kCdm(cdm) | kSl(1);
    return static_cast<std::uint16_t>(status << kAllBits * line);
  }
  void lines(unsigned cfgch1, unsigned cfgch2) {
    m.protocol_i = static_cast<std::uint8_t>(cfgch2 << 2 | cfgch1);
  }
  void set_access(const ControlAccess& made, unsigned chsel, bool biss_c = true) {
    using namespace places::mb4_pkg::cfg_t;
    namespace from = places::biss_pkg::access_t;
    const std::uint32_t port = made.port();
    kAccessSlaveid.set(m.cfg_i, from::kId.of(port));
    kAccessRegvers.set(m.cfg_i, biss_c);
    kAccessCts.set(m.cfg_i, from::kCts.of(port));
    kAccessRegnum.set(m.cfg_i, from::kByteLast.of(port));
    kAccessRegadr.set(m.cfg_i, from::kAddr.of(port));
    kAccessWnr.set(m.cfg_i, from::kWrite.of(port));
    kAccessChsel.set(m.cfg_i, chsel);
  }
  unsigned select() const { return static_cast<unsigned>(kind_t::kSelect.of(m.kind_o)); }
  unsigned manual() const { return static_cast<unsigned>(kind_t::kManual.of(m.kind_o)); }

  void clock() {
    m.eval();
    namespace rdata_t = places::mb4_pkg::rdata_cmd_t;
    namespace event_t = places::mb4_pkg::access_event_t;
    const std::uint64_t address = rdata_t::kRdAddr.of(m.rdata_o);
    const bool read = rdata_t::kRdEn.of(m.rdata_o) != 0;
    if (rdata_t::kWrEn.of(m.rdata_o) != 0) {
      written.push_back({static_cast<unsigned>(rdata_t::kWrAddr.of(m.rdata_o)),
                         static_cast<unsigned>(rdata_t::kWrData.of(m.rdata_o))});
    }
    begins += static_cast<unsigned>(event_t::kBegins.of(m.event_o));
    if (event_t::kEnds.of(m.event_o) != 0) {
      ++ends;
      reg_error = event_t::kRegError.of(m.event_o) != 0;
      delay_error = event_t::kDelayError.of(m.event_o) != 0;
    }
    ags_errors += m.ags_error_o;
    block.clock();
    if (read) m.rdata_i = static_cast<std::uint8_t>(rdata[address]);
    m.eval();
  }
  void clocks(unsigned count) {
    for (unsigned i = 0; i < count; ++i) clock();
  }
  void start(std::uint64_t flags = 0) {
    m.go_i = static_cast<std::uint8_t>(go_t::kStart(1) | flags);
    clock();
    m.go_i = 0;
  }
  // A frame of both lines; the CDM that each of them sends.
  unsigned frame(unsigned cds, unsigned length = 3) {
    m.go_i = static_cast<std::uint8_t>(go_t::kStart(1));
    m.eval();
    const unsigned cdm = ((cds & m.cdm1_o) | (~cds & m.cdm0_o)) & 3U;
    start();
    m.begin_i = 0;
    clocks(length);
    m.status_i = 0;
    for (unsigned line = 0; line < 2; ++line) {
      m.status_i |= line_status(line, cds >> line, cdm >> line);
    }
    m.frame_done_i = 1;
    clock();
    m.frame_done_i = 0;
    clocks(2);
    return cdm;
  }
  void begin(const ControlAccess& started) {
    access = started;
    script = script_of(access);
    ends = begins = ags_errors = 0;
    written.clear();
    for (unsigned i = 0; i < 64; ++i) rdata[i] = random.below(256);
    if (access.command) rdata[0] = access.ids;
    for (unsigned i = 0; access.write && i < access.bytes.size(); ++i) rdata[i] = access.bytes[i];
    m.instr_i = reg::INSTR::of(reg::Instr::kControl) >> reg::INSTR::kLsb;
    m.begin_i = 1;
    clocks(3);
    EXPECT_EQ(begins, 1U);
    EXPECT_NE(m.active_o, 0);
  }
  // 14 zeros, then the frames of the script up to `last`.
  void play(unsigned last = ~0U) {
    for (unsigned i = 0; i < 14 && !cdm_timeout(); ++i) ASSERT_EQ(frame(0), 0U);
    ASSERT_TRUE(cdm_timeout());
    const unsigned lines_of_it = select();
    for (unsigned at = 0; at < script.cdm.size() && at < last && ends == 0; ++at) {
      const unsigned cds = script.cds[at] == '1' ? lines_of_it : 0U;
      const unsigned cdm = frame(cds | (random.below(4) & ~lines_of_it));
      ASSERT_EQ(cdm, script.cdm[at] == '1' ? lines_of_it : 0U) << "frame " << at;
      EXPECT_FALSE(cdm_timeout()) << "within a control frame, " << at;
      if (disturb) disturb();
    }
  }
  ControlAccess random_access(bool write) { return mb4test::random_access(random, write, 3); }
  void settle() {
    m.instr_i = 0;
    clocks(4);
    for (int i = 0; i < 14; ++i) frame(0);
  }
  bool cdm_timeout() const {
    return places::mb4_pkg::access_state_t::kCdmTimeout.of(m.state_o) != 0;
  }
  unsigned good_bytes() const {
    return static_cast<unsigned>(places::mb4_pkg::access_state_t::kGoodBytes.of(m.state_o));
  }
  // An access that succeeds, and its end.
  void write_two_bytes() {
    set_access(two_bytes, 1);
    clocks(2);
    begin(two_bytes);
    play();
    ASSERT_EQ(good_bytes(), 2U);
    settle();
  }

  const ControlAccess two_bytes{.write = true, .bytes = {1, 2}, .busy = {0, 0}};
  mb4test::Dice random;
  mb4test::Block<Vmb4_control_comm> block;
  Vmb4_control_comm& m = block.model;
  ControlAccess access;
  ControlScript script;
  std::array<unsigned, 64> rdata{};
  std::vector<Byte> written;
  std::function<void()> disturb;
  unsigned begins = 0, ends = 0, ags_errors = 0;
  bool reg_error = false, delay_error = false;
};

// Tables 23, 28 to 31: a register access runs on line 1 if both fit; bytes go to and come from
// RDATA. Decision 38: what the host changes meanwhile counts for the next access only.
TEST_F(ControlCommBlock, RandomRegisterAccesses_KeepTheirSettings) {
  for (int round = 0; round < 60; ++round) {
    SCOPED_TRACE(testing::Message() << "round " << round);
    const unsigned chsel = random.below(4);
    set_access(random_access(false), chsel);
    const ControlAccess next = random_access(random.below(2) != 0);
    set_access(next, chsel);
    clocks(2);
    begin(next);
    ASSERT_EQ(select(), chsel == 2 ? 2U : 1U);
    disturb = [&] { set_access(random_access(random.below(2) != 0), random.below(4), false); };
    play();
    if (HasFailure()) return;
    ASSERT_EQ(ends, 1U);
    ASSERT_FALSE(reg_error || delay_error);
    ASSERT_EQ(good_bytes(), next.bytes.size());
    ASSERT_EQ(written.size(), next.write ? 0 : next.bytes.size());
    for (unsigned i = 0; i < written.size(); ++i) ASSERT_EQ(written[i], (Byte{i, next.bytes[i]}));
    // The settings of now.
    set_access(next, 2);
    clocks(2);
    ASSERT_EQ(m.stale_o, 0);
    ASSERT_EQ(manual(), 2U);
    settle();
  }
}

// From the end up to the new settings the module says that they are old.
TEST_F(ControlCommBlock, EndOfAnAccess_SettingsAreStaleUntilTheyAreNew) {
  const ControlAccess first{.write = true, .bytes = {1}, .busy = {0}};
  set_access(first, 1);
  clocks(2);
  begin(first);
  play(5);
  set_access(first, 2);
  clocks(5);
  ASSERT_EQ(manual(), 1U);
  ASSERT_EQ(m.stale_o, 0);
  m.clear_i = 1;
  clock();
  m.clear_i = 0;
  for (unsigned i = 0; i < 4; ++i) {
    m.eval();
    EXPECT_TRUE(manual() == 2U || m.stale_o != 0) << i;
    clock();
  }
  EXPECT_EQ(manual(), 2U);
  EXPECT_EQ(ends, 0U) << "BREAK";
}

TEST_F(ControlCommBlock, Commands_RunOnBothLinesAndTakeTheQuirk) {
  for (unsigned round = 0; round < 16; ++round) {
    ControlAccess made;
    made.command = true;
    made.ids = round % 3 == 0 ? 0 : random.below(256);
    made.cmd = random.below(4);
    made.tested = round % 2 != 0;
    set_access(made, 3);
    m.quirks_i = round / 2 % 2;  // decision 5
    if (m.quirks_i != 0) {
      mb4test::Place{places::mb4_pkg::cfg_t::kAccessSlaveid.lsb, 1}.set(m.cfg_i,
                                                                        made.tested ? 0 : 1);
    }
    clocks(2);
    begin(made);
    ASSERT_EQ(select(), 3U);
    play();
    if (HasFailure()) return;
    EXPECT_TRUE(ends == 1 && !reg_error && !delay_error) << round;
    settle();
  }
}

// Table 45: CDM of frames without control communication, on the lines of CHSEL.
TEST_F(ControlCommBlock, FramesWithoutControl_SendTheCdmOfInstr) {
  for (unsigned chsel = 0; chsel < 4; ++chsel) {
    set_access({.bytes = {0}, .busy = {0}}, chsel);
    clocks(3);
    const unsigned named = chsel == 0 ? 1 : chsel;
    for (unsigned instr = 0; instr < 4; ++instr) {
      m.instr_i = static_cast<std::uint8_t>(instr);
      for (unsigned cds = 0; cds < 4; ++cds) {
        EXPECT_EQ(frame(cds), instr == 1 ? named : instr == 3 ? named & ~cds : 0U) << instr;
      }
    }
  }
}

// Page 35, Table 64, decision 20: CDMTIMEOUT after 14 zeros on the lines in use, until a 1 or INIT.
TEST_F(ControlCommBlock, FourteenZeros_AreCdmtimeout) {
  const auto reached = [&] { return cdm_timeout(); };
  for (int i = 0; i < 14; ++i) {
    EXPECT_FALSE(reached()) << i;
    frame(0);
  }
  EXPECT_TRUE(reached());
  m.init_clear_i = 1;
  clock();
  m.init_clear_i = 0;
  EXPECT_FALSE(reached());
  for (int i = 0; i < 14; ++i) frame(3);
  EXPECT_TRUE(reached()) << "CDS does not count";
  set_access({.bytes = {0}, .busy = {0}}, 2);
  clocks(2);
  m.instr_i = 1;
  frame(0);
  EXPECT_FALSE(reached());
  lines(kBissC, kUnused);
  for (int i = 0; i < 14; ++i) frame(0);
  EXPECT_TRUE(reached()) << "line 2 is not in use";
}

// Page 13: no CDS on SSI, so a write counts as right.
TEST_F(ControlCommBlock, WriteToSsi_NeedsNoAnswer) {
  lines(kSsi, kBissC);
  const ControlAccess blind{
      .write = true, .id = 5, .address = 0x31, .bytes = {9, 8}, .busy = {0, 0}};
  set_access(blind, 1);
  clocks(2);
  begin(blind);
  for (auto& bit : script.cds) bit = '0';
  play();
  EXPECT_TRUE(ends == 1 && !reg_error && !delay_error);
  EXPECT_EQ(good_bytes(), 2U);
}

// Decision 24: a slave that does not send its start bit is given up after 4096 register clocks, at
// the end of a frame: nDELAYERR = 0.
TEST_F(ControlCommBlock, SilentSlave_IsGivenUpAfterTheLimit) {
  const ControlAccess silent{.bytes = {7, 7}, .busy = {1, 1000}};
  set_access(silent, 1);
  clocks(2);
  begin(silent);
  play(18 + 15);
  ASSERT_EQ(ends, 0U);
  unsigned ticks = 0;
  for (; ends == 0 && ticks < 2 * kLimit; ticks += 54) {
    m.tick_i = 1;
    frame(0, 50);
  }
  EXPECT_TRUE(delay_error && !reg_error);
  EXPECT_GE(ticks, kLimit - 108);
  EXPECT_LE(ticks, kLimit + 108);
  EXPECT_EQ(good_bytes(), 1U);
}

// Frames that the host does not ask for are no stall: the next one ends the access.
TEST_F(ControlCommBlock, SilentSlaveWithoutFrames_IsGivenUpWithTheNextOne) {
  const ControlAccess silent{.bytes = {7}, .busy = {1000}};
  set_access(silent, 1);
  clocks(2);
  begin(silent);
  play(19 + 2);
  m.live_i = 0;
  clocks(2 * kStall);
  ASSERT_EQ(ends, 0U);
  frame(0);
  EXPECT_TRUE(ends == 1 && delay_error && !reg_error);
}

// A frame that does not end is given up after an eighth more, if frames run; else the host may take
// its time.
TEST_F(ControlCommBlock, FrameThatDoesNotEnd_IsGivenUpOnlyWhileFramesRun) {
  for (const bool live : {true, false}) {
    const ControlAccess slow{.bytes = {7}, .busy = {0}};
    set_access(slow, 1);
    clocks(2);
    begin(slow);
    play(8);
    m.live_i = live;
    start();
    clocks(kStall - 40);
    EXPECT_EQ(ends, 0U);
    clocks(80);
    EXPECT_EQ(ends, live ? 1U : 0U);
    if (live) {
      EXPECT_TRUE(reg_error && !delay_error);
      EXPECT_EQ(m.active_o, 0);
      settle();
    }
  }
  EXPECT_NE(m.active_o, 0);
}

// Decision 42: requests of an access that SL = 0 refuses. The first one after 9/8 of the limit ends
// the access; a request that is taken starts the time again.
TEST_F(ControlCommBlock, RefusedRequests_EndWithTheFirstAfterTheLimit) {
  const ControlAccess refused{.bytes = {7}, .busy = {0}};
  set_access(refused, 1);
  clocks(2);
  m.live_i = 0;
  const auto request = [&] {
    m.refused_i = 1;
    clock();
    m.refused_i = 0;
    clocks(3);
  };
  begin(refused);
  for (const bool taken : {true, false}) {
    for (int i = 0; i < 8; ++i) {
      request();
      clocks(kStall / 8 - 10);
    }
    EXPECT_NE(m.time_o, 0) << "the time base runs for it";
    if (taken) frame(0);
  }
  EXPECT_EQ(ends, 0U);
  clocks(kStall / 4);
  EXPECT_EQ(ends, 0U) << "no request";
  request();
  EXPECT_TRUE(ends == 1 && reg_error && !delay_error);
  clocks(4);
  EXPECT_EQ(m.active_o, 0);
}

// Decision 37: an access that cannot run ends with nREGERR = 0 and no bytes. BREAK gives no result.
TEST_F(ControlCommBlock, VoidAccess_EndsWithAnError) {
  ASSERT_NO_FATAL_FAILURE(write_two_bytes());
  ends = begins = 0;
  m.register_want_i = 1;
  clock();
  m.register_want_i = 0;
  EXPECT_EQ(begins, 1U);
  m.void_i = 1;
  clock();
  m.void_i = 0;
  clocks(3);
  EXPECT_TRUE(ends == 1 && reg_error && !delay_error);
  EXPECT_EQ(good_bytes(), 0U);
}

// Decision 6, BiSS B: no answer to the hand-over is nAGSERR = 0. REGBYTES is that of the access
// that ran last.
TEST_F(ControlCommBlock, BissBWithoutHandOver_IsAnAgsError) {
  ASSERT_NO_FATAL_FAILURE(write_two_bytes());
  lines(0, kUnused);
  set_access(two_bytes, 1, false);
  m.instr_i = reg::INSTR::of(reg::Instr::kControl) >> reg::INSTR::kLsb;
  clocks(3);
  ASSERT_EQ(kind_t::kIsControl.of(m.kind_o), 0U);
  ASSERT_EQ(kind_t::kIsRegister.of(m.kind_o), 1U) << "a BiSS B register access";
  ASSERT_EQ(kind_t::kIsVoid.of(m.kind_o), 0U);
  ends = ags_errors = 0;
  m.start_use_i = 1;
  m.register_want_i = 1;
  start(go_t::kRegisterAccess(1));
  m.register_want_i = 0;
  EXPECT_EQ(good_bytes(), 0U);
  unsigned ticks = 0;
  for (; ends == 0 && ticks < 2 * kLimit; ++ticks) clock();
  EXPECT_EQ(ends, 1U);
  EXPECT_EQ(ags_errors, 1U);
  EXPECT_NEAR(ticks, kLimit, 20);
}

}  // namespace
