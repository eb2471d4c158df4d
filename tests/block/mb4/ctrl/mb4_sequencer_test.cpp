// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The order of frames and the end of instructions alone: datasheet pages 31 to 33, Tables 44 to 49;
// decisions 1, 3, 8, 15, 19, 21, 23, 25, 26, 37. The test plays the host's half of 0xF4, both lines
// and the requests of automatic frames.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "Vmb4_sequencer.h"
#include "mb4_regs.hpp"
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace reg = mb4::regs;

constexpr unsigned kAgs = 0x01, kInit = 0x10, kSwbank = 0x20, kHoldbank = 0x40, kBreak = 0x80;
constexpr unsigned kCdm0 = reg::INSTR::of(reg::Instr::kCdm0);
constexpr unsigned kCdm1 = reg::INSTR::of(reg::Instr::kCdm1);
constexpr unsigned kControl = reg::INSTR::of(reg::Instr::kControl);
constexpr unsigned kCut = 1100;  // clocks after which INIT waits no more, and some
namespace pkg = mb4test::places::mb4_pkg;
namespace go_t = mb4test::places::biss_pkg::line_go_t;
namespace event_t = mb4test::places::biss_pkg::line_event_t;
namespace status_t = mb4test::places::biss_pkg::line_status_t;

constexpr auto kDue = static_cast<std::uint8_t>(pkg::request_t::kDue(1) | pkg::request_t::kAsks(1));
constexpr auto kAgsmin = static_cast<std::uint8_t>(pkg::request_t::kAgsmin(1));
constexpr auto kInfinite = static_cast<std::uint8_t>(pkg::request_t::kInfinite(1));
constexpr unsigned kAgserrOnWrite = 2, kAgserrOnHoldbank = 4, kAgsCleared = 8;  // quirks

class SequencerBlock : public testing::Test {
 protected:
  SequencerBlock() {
    m.instr_i = m.kind_i = m.quirks_i = m.request_i = m.missed_i = m.event_i = 0;
    m.word_bad_i = m.mem_i = 0;
    m.control_active_i = m.control_start_i = m.control_end_i = m.control_stalled_i = m.stale_i = 0;
    m.regvers_i = m.tick_i = 1;
    m.status_i = 0;
    for (unsigned line = 0; line < 2; ++line) m.status_i |= status(line, true, false, true);
    block.reset();
    clocks(kCut);  // INIT waits after a reset (decision 46)
    forget();
  }
  static std::uint16_t status(unsigned line, bool idle, bool timeout, bool sl) {
    using namespace status_t;
    return static_cast<std::uint16_t>((kIdle(idle) | kTimeout(timeout) | kSl(sl))
                                      << kAllBits * line);
  }
  void clock() {
    m.eval();
    const std::uint64_t instr = pkg::instr_t::kInstr.of(m.instr_o);
    const bool control = instr == 4 || instr == 7;
    // Both lines are in use.
    using namespace pkg::kind_t;
    m.kind_i = static_cast<std::uint16_t>(kInUse(3) | kFrameUse(3) | kInitUse(init_use) |
                                          kIsFrame(instr != 0 && (!control || can_control)) |
                                          kIsControl(control && can_control) |
                                          kIsVoid(control && !can_control));
    m.status_i = m.event_i = 0;
    for (unsigned line = 0; line < 2; ++line) {
      const bool idle = left[line] == 0;
      const bool timeout = left[line] > 0 && left[line] <= timeout_clocks;
      const bool high = (low_lines >> line & 1U) == 0;
      m.status_i |= status(line, idle, timeout, high && !timeout);
      const bool over = left[line] == timeout_clocks + 1;
      const std::uint64_t event = event_t::kLineEnd(over && !in_init) |
                                  event_t::kInitDone(over && in_init && !init_fails) |
                                  event_t::kInitFail(over && in_init && init_fails);
      m.event_i |= static_cast<std::uint8_t>(event << event_t::kAllBits * line);
      if (left[line] > 0 && !(stuck && timeout)) --left[line];
    }
    m.eval();
    const bool start = go_t::kStart.of(m.go_o) != 0;
    if (start) {
      in_init = go_t::kInit.of(m.go_o) != 0;
      (in_init ? inits : starts).push_back(now);
      EXPECT_EQ(m.start_use_o, in_init ? init_use : 3U);
      // Line 2 takes longer.
      for (unsigned line = 0; line < 2; ++line) {
        if ((m.start_use_o >> line & 1U) != 0) left[line] = timeout_clocks + 20 + 10 * line;
      }
    }
    if (go_t::kStop.of(m.go_o) != 0) {
      stops.push_back(now);
      left = {};
    }
    if (pkg::frame_flags_t::kScdEn.of(m.flags_o) != 0) results.push_back(now);
    if (pkg::bank_cmd_t::kFrameEnd.of(m.bank_o) != 0) ends.push_back(now);
    ags_errors += pkg::frame_flags_t::kAgsError.of(m.flags_o) != 0 ? 1U : 0U;
    bank_fails += pkg::frame_flags_t::kBankFail.of(m.flags_o) != 0 ? 1U : 0U;
    clears += pkg::frame_flags_t::kClear.of(m.flags_o) != 0 ? 1U : 0U;
    voids += m.void_o;
    swaps += pkg::bank_cmd_t::kSwap.of(m.bank_o) != 0 ? 1U : 0U;
    refusals += m.refused_o;
    block.clock();
    m.eval();
    ++now;
  }
  void clocks(unsigned number) {
    for (unsigned i = 0; i < number; ++i) clock();
  }
  void forget() {
    starts.clear();
    inits.clear();
    ends.clear();
    stops.clear();
    results.clear();
    ags_errors = bank_fails = clears = voids = swaps = refusals = 0;
  }
  // A byte to 0xF4; five clocks, after which the core has taken it.
  void write(unsigned byte) {
    count = (count << 1 & 2U) | (~count >> 1 & 1U);
    m.instr_i = static_cast<std::uint16_t>(pkg::instr_host_t::kCount(count) |
                                           pkg::instr_host_t::kWritten(byte));
    clocks(5);
  }
  unsigned held() const { return static_cast<unsigned>(pkg::instr_core_t::kHeld.of(m.instr_o)); }
  bool busy() {
    m.eval();
    return pkg::frame_flags_t::kBusy.of(m.flags_o) != 0;
  }
  void request() {
    m.request_i |= kDue;
    clock();
    m.request_i &= static_cast<std::uint8_t>(~kDue);
  }

  mb4test::Block<Vmb4_sequencer> block;
  Vmb4_sequencer& m = block.model;
  std::array<unsigned, 2> left{};  // clocks up to the end of the timeout
  unsigned timeout_clocks = 15, low_lines = 0, init_use = 3, count = 0, now = 0;
  bool can_control = true, in_init = false, init_fails = false, stuck = false;
  std::vector<unsigned> starts, inits, ends, stops, results;
  unsigned ags_errors = 0, bank_fails = 0, clears = 0, voids = 0, swaps = 0, refusals = 0;
};

// Table 45, decisions 1 and 26: one frame for a write. It ends with the last of its lines.
TEST_F(SequencerBlock, Instruction_IsOneFrameAndClearsItself) {
  for (const unsigned code : {kCdm0, kCdm1, 0x06U}) {
    forget();
    write(code);
    EXPECT_TRUE(busy());
    EXPECT_EQ(held(), code);
    ASSERT_EQ(starts.size(), 1U);
    while (left[1] > timeout_clocks + 1) {
      clock();
      EXPECT_TRUE(ends.empty() && busy());
    }
    clocks(3);
    EXPECT_FALSE(busy()) << "in the slaves' timeout";
    EXPECT_EQ(held(), 0U);
    ASSERT_EQ(ends.size(), 1U);
    ASSERT_EQ(results.size(), 1U);
    EXPECT_EQ(ends[0], results[0] + 1) << "the result comes before the end";
    clocks(200);
    EXPECT_EQ(starts.size(), 1U);
    EXPECT_EQ(ags_errors + clears, 0U);
  }
}

// Decision 19: another INSTR written in a frame is taken at its end; the same one asks for nothing.
// SL is 0 then, in the slaves' timeout (decisions 1, 3): an error, or with AGSMIN the frame waits.
TEST_F(SequencerBlock, InstructionWrittenInAFrame_CountsIfItIsAnother) {
  for (const bool same : {true, false}) {
    for (const bool agsmin : {true, false}) {
      m.request_i = agsmin ? kAgsmin : 0;
      forget();
      write(kCdm1);
      write(same ? kCdm1 : kCdm0);
      clocks(200);
      ASSERT_EQ(starts.size(), !same && agsmin ? 2U : 1U);
      EXPECT_EQ(ags_errors, !same && !agsmin ? 1U : 0U);
      EXPECT_EQ(held(), 0U);
      EXPECT_GE(starts.back(), starts.size() == 1 ? 0 : ends.at(0) + timeout_clocks);
    }
  }
}

// Decision 8: at once, in any clock of a frame or of INIT; no result; it never reads back 1.
TEST_F(SequencerBlock, Break_EndsEverythingAtOnce) {
  for (unsigned at = 0; at < 60; ++at) {
    for (const unsigned running : {kCdm1, kInit}) {
      for (const unsigned with : {0U, kAgs}) {
        write(running);
        clocks(at);
        forget();
        write(kBreak | with);
        ASSERT_EQ(stops.size(), 1U) << at;
        EXPECT_EQ(held(), with);
        EXPECT_FALSE(busy());
        EXPECT_GE(clears, 1U);
        for (const unsigned end : ends) EXPECT_LT(end, stops[0]);
        for (const unsigned result : results) EXPECT_LT(result, stops[0]);
        forget();
        clocks(kCut);
        EXPECT_TRUE(starts.empty() && inits.empty() && ends.empty());
        write(0);
      }
    }
  }
}

// Table 46, decision 25: INIT reads 1 until the slaves have had their timeout; EOT is 0 meanwhile.
TEST_F(SequencerBlock, Init_LastsUntilTheTimeoutHasEnded) {
  for (const bool biss_c : {true, false}) {
    for (const bool fails : {true, false}) {
      m.regvers_i = biss_c;
      init_fails = fails;
      forget();
      write(kInit);
      ASSERT_EQ(inits.size(), 1U);
      EXPECT_EQ(clears, 1U);
      write(0);  // does not end it
      while (left[1] > 1) {
        EXPECT_EQ(held(), kInit);
        EXPECT_TRUE(busy());
        clock();
      }
      clocks(3);
      EXPECT_EQ(held(), 0U);
      EXPECT_FALSE(busy());
      EXPECT_EQ(ags_errors > 0, fails) << "no acknowledge";
      EXPECT_TRUE(ends.empty() && starts.empty());
    }
  }
}

// INIT in a frame begins after it and the slaves' timeout, an AGS with it is kept (decision 19).
TEST_F(SequencerBlock, InitInAFrame_WaitsForItsTimeout) {
  write(kCdm1);
  write(kInit | kAgs);
  clocks(200);
  ASSERT_EQ(inits.size(), 1U);
  EXPECT_GE(inits[0], ends.at(0) + timeout_clocks);
  EXPECT_EQ(held(), kAgs);
}

// A slave whose timeout does not end: 1024 MA periods after the frame the line is set free.
TEST_F(SequencerBlock, InitWithoutEndOfTheTimeout_IsNotHeldForEver) {
  stuck = true;
  write(kCdm1);
  clocks(60);
  write(kInit);
  clocks(3000);
  ASSERT_EQ(stops.size(), 1U);
  EXPECT_NEAR(stops[0] - ends.at(0), 2 * 1024, 2);
  ASSERT_EQ(inits.size(), 1U);
  EXPECT_GT(inits[0], stops[0]);
}

// Decision 46: after a BREAK that cut something INIT waits for 1,024 clocks of SL = 1 in one piece,
// at most 2,048 of SL = 0. One that cut nothing delays nothing.
TEST_F(SequencerBlock, InitBehindBreak_WaitsFor1024ClocksOfRest) {
  for (const unsigned cut : {kCdm1, kInit}) {
    for (const unsigned low : {0U, 700U, 3000U}) {
      for (const bool same_byte : {false, true}) {
        write(cut);
        clocks(12);
        forget();
        low_lines = low == 0 ? 0 : 2;
        const unsigned begin = now;
        write(same_byte ? kBreak | kInit : kBreak);
        if (!same_byte) write(kInit);
        while (now - begin < low) clock();
        low_lines = 0;
        clocks(2500);
        ASSERT_EQ(inits.size(), 1U) << low;
        EXPECT_NEAR(inits[0] - begin, low == 3000 ? 2048 : low + 1024, 20) << low;
        EXPECT_EQ(held(), 0U);
        EXPECT_EQ(ags_errors, 0U);
        forget();
        write(kBreak | kInit);
        ASSERT_EQ(inits.size(), 1U) << "nothing was cut";
        clocks(kCut);
      }
    }
  }
}

// Decision 3: SL = 0 when a frame is due is nAGSERR = 0, or with AGSMIN waits for SL = 1.
TEST_F(SequencerBlock, LowLine_IsAnErrorOrWaitsWithAgsmin) {
  for (const unsigned line : {1U, 2U}) {
    for (const bool agsmin : {false, true}) {
      m.request_i = agsmin ? kAgsmin : 0;
      low_lines = line;
      forget();
      write(kCdm1);
      clocks(50);
      EXPECT_TRUE(starts.empty());
      EXPECT_EQ(ags_errors, agsmin ? 0U : 1U);
      EXPECT_EQ(held(), agsmin ? kCdm1 : 0U);
      EXPECT_EQ(busy(), agsmin);
      EXPECT_EQ(refusals, agsmin ? 0U : 1U);
      low_lines = 0;
      clocks(100);
      EXPECT_EQ(starts.size(), agsmin ? 1U : 0U);
    }
  }
}

// Table 44: a frame for each request; INSTR is the CDM of these frames and stays. It asks for a
// frame itself only with AGSINFINITE.
TEST_F(SequencerBlock, AutomaticFrames_KeepInstr) {
  write(kAgs | kCdm1);
  clocks(100);
  EXPECT_TRUE(starts.empty());
  for (unsigned i = 1; i <= 3; ++i) {
    request();
    clocks(100);
    EXPECT_EQ(starts.size(), i);
    EXPECT_EQ(ends.size(), i);
    EXPECT_EQ(held(), kAgs | kCdm1);
  }
  m.request_i = kInfinite;
  write(kAgs | kCdm0);
  clocks(100);
  EXPECT_EQ(starts.size(), 4U);
  EXPECT_EQ(ags_errors, 0U);
}

// Page 34, decision 21: a frame left out is nAGSERR = 0. AGS stays, but with the quirk.
TEST_F(SequencerBlock, MissedFrame_IsAnErrorAndAgsStays) {
  for (const unsigned quirks : {0U, kAgsCleared}) {
    m.quirks_i = static_cast<std::uint8_t>(quirks);
    forget();
    write(kAgs);
    m.missed_i = 1;
    clock();
    m.missed_i = 0;
    EXPECT_EQ(ags_errors, 1U);
    clocks(3);
    EXPECT_EQ(held(), quirks == 0 ? kAgs : 0U);
  }
  // Decision 8, the other quirk: each write to 0xF4.
  forget();
  write(0);
  EXPECT_EQ(ags_errors, 0U);
  m.quirks_i = kAgserrOnWrite;
  write(0);
  EXPECT_EQ(ags_errors, 1U);
}

// Decision 15, Tables 48 and 49: HOLDBANK and SWBANK are kept; each change of SWBANK is a swap.
// With the quirk a frame that is due while a switch waits is left out.
TEST_F(SequencerBlock, Holdbank_LeavesAFrameOutOnlyWithTheQuirk) {
  write(kSwbank);
  EXPECT_EQ(swaps, 1U);
  write(kSwbank | kHoldbank);
  EXPECT_EQ(swaps, 1U);
  write(kHoldbank);
  EXPECT_EQ(swaps, 2U);
  EXPECT_EQ(held(), kHoldbank);
  m.mem_i = static_cast<std::uint8_t>(pkg::mem_state_t::kPending(1));
  for (const bool quirk : {false, true}) {
    m.quirks_i = quirk ? kAgserrOnHoldbank : 0;
    forget();
    request();
    clocks(100);
    EXPECT_EQ(starts.size(), quirk ? 0U : 1U);
    EXPECT_EQ(ags_errors, quirk ? 1U : 0U);
    EXPECT_EQ(bank_fails, quirk ? 1U : 0U);
  }
}

// Decision 37: INSTR = 100 that cannot run ends at once, with AGS or without.
TEST_F(SequencerBlock, ControlThatCannotRun_EndsAtOnce) {
  can_control = false;
  for (const unsigned ags : {0U, kAgs}) {
    forget();
    write(ags | kControl);
    clocks(5);
    EXPECT_EQ(voids, 1U);
    EXPECT_EQ(held(), ags);
    EXPECT_FALSE(busy());
    EXPECT_TRUE(starts.empty());
  }
}

// Decision 23: without AGS one frame for each write; with AGS INSTR stays until the access ends.
TEST_F(SequencerBlock, Control_IsAFrameAWriteOrStaysWithAgs) {
  for (unsigned i = 1; i <= 3; ++i) {
    write(kControl);
    m.control_active_i = m.control_start_i = 1;
    clocks(100);
    EXPECT_EQ(starts.size(), i);
    EXPECT_EQ(held(), 0U);
  }
  m.control_active_i = m.control_start_i = 0;
  forget();
  write(kAgs | kControl);
  m.eval();
  EXPECT_EQ(m.control_begin_o, 0) << "taken, because with AGS it asks for no frame";
  m.control_active_i = m.control_start_i = 1;
  for (int i = 0; i < 3; ++i) {
    request();
    clocks(100);
    EXPECT_EQ(held(), kAgs | kControl);
  }
  m.control_end_i = 1;
  clock();
  m.control_end_i = 0;
  EXPECT_EQ(held(), kAgs);
  EXPECT_EQ(starts.size(), 3U);
}

}  // namespace
