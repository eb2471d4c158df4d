// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The top biss_clb at its pins: reference frame, clock counts, half periods, phases of SL, the last
// level of MA, watchdog, registers, wrong numbers. Expected values are those of TIDM-1010 and of
// the stimulus that comes with its library.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "tests/block/clb/biss_clb_bench.hpp"
#include "tests/support/dice.hpp"

namespace {

namespace reg = biss_clb::regs;
using mb4test::bits_of;
using Words = std::vector<unsigned>;

class Clb : public testing::Test {
 protected:
  // MA clocks from START on and words of 12 bits for a position (2.3.5.4).
  static unsigned after_start(unsigned bits) { return bits + 4 + 6; }
  static unsigned count(unsigned bits) { return (after_start(bits) + 11) / 12; }
  // Reads one frame of a position; what the line has from START on, as text.
  std::string frame(unsigned bits, bool cdm = false) {
    bench.start(after_start(bits), count(bits), cdm);
    return bench.line(bench.words(count(bits)));
  }
  // START and what the encoder sends.
  std::string sent() const { return "1" + bench.slave.payload; }
  void timeout(unsigned clocks) { bench.slave.timeout = clocks; }
  void rest(unsigned clocks = 2000) { bench.clocks(clocks); }

  mb4test::ClbPins bench;
};

// ---- Reference frame ------------------------------------------------------------------------

struct Reference {
  unsigned delay, extension;
};
class ClbReference : public Clb, public testing::WithParamInterface<Reference> {};

TEST_P(ClbReference, Frame_GivesTheTwoWordsOfTheStimulus) {
  bench.set_half(10);
  timeout(400);
  bench.delay = GetParam().delay;
  bench.slave.busy = GetParam().extension / 20;
  bench.set_word(0x0E08, 13);
  EXPECT_EQ(bench.slave.payload,
            "0"
            "0111000001000"
            "1"
            "1"
            "101110");
  bench.start(23, 2);
  const Words words = bench.words(2);
  EXPECT_EQ(words, (Words{0x9C1, 0x1DC}));
  const std::string line = bench.line(words);
  EXPECT_EQ(line.substr(2, 13), bits_of(0x0E08, 13));
  EXPECT_EQ(line.substr(15, 2), "11") << "nE, nW";
  EXPECT_EQ(bench.spi_rises.size(), 24U);
}

INSTANTIATE_TEST_SUITE_P(Stimulus, ClbReference,
                         testing::Values(Reference{60, 0}, Reference{75, 80}, Reference{97, 120}),
                         [](const auto& test) {
                           return "Delay" + std::to_string(test.param.delay) + "Extension" +
                                  std::to_string(test.param.extension);
                         });

// ---- Clocks ---------------------------------------------------------------------------------

struct Position {
  unsigned bits, ma_clocks, spi_clocks;
};
class ClbClocks : public Clb, public testing::WithParamInterface<Position> {};

// The rises of MA behind the clock in which the synchroniser shows the start bit are those of state
// 10. With MA high at the end one more is seen.
TEST_P(ClbClocks, MaAndSpiClocks_AreThoseOfThePosition) {
  const Position& position = GetParam();
  bench.set_half(20);
  timeout(1200);
  bench.set_word(0xA5A5'A5A5U & ((std::uint64_t{1} << position.bits) - 1), position.bits);
  for (const unsigned delay : {0U, 7U, 95U}) {
    for (const bool cdm : {false, true}) {
      bench.delay = delay;
      bench.start(after_start(position.bits), count(position.bits), cdm);
      EXPECT_EQ(after_start(position.bits), position.ma_clocks);
      while (bench.spi_rises.empty()) bench.clock();
      // The first bit is taken half a bit behind START.
      const std::uint64_t start = bench.spi_rises[0] - 20;
      const unsigned at_start = static_cast<unsigned>(
          std::count_if(bench.rises.begin(), bench.rises.end(),
                        [start](std::uint64_t rise) { return rise <= start; }));
      EXPECT_EQ(bench.read(reg::kAddrFsmCounter1Match1), at_start + position.ma_clocks);
      rest(6000);
      EXPECT_EQ(bench.rises.size(), at_start + position.ma_clocks + (cdm ? 0 : 1)) << delay;
      EXPECT_EQ(bench.falls.size(), at_start + position.ma_clocks + 1);
      EXPECT_EQ(bench.spi_rises.size(), position.spi_clocks);
      const std::uint32_t state = bench.read(reg::kAddrFsmState);
      EXPECT_EQ(state, position.spi_clocks << 16U | (at_start + position.ma_clocks) << 8U |
                           (cdm ? 0U : 8U) | 4U | 3U);
      EXPECT_EQ(bench.line(bench.words(count(position.bits))).substr(0, position.ma_clocks),
                sent());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Bits, ClbClocks,
                         testing::Values(Position{13, 23, 24}, Position{18, 28, 36},
                                         Position{28, 38, 48}, Position{32, 42, 48}),
                         [](const auto& test) { return "X" + std::to_string(test.param.bits); });

class ClbHalf : public Clb, public testing::WithParamInterface<unsigned> {};

// Either tile may be started first.
TEST_P(ClbHalf, HalfPeriods_AreExactFromTheFirstOneOn) {
  const unsigned half = GetParam();
  bench.set_half(half);
  bench.set_word(0x1234, 13);
  timeout(60 * half);
  for (const bool clock_first : {false, true}) {
    for (unsigned phase = 0; phase < (clock_first ? 2 * half : 1); ++phase) {
      if (clock_first) {
        // The counter's clock runs for a while before the frame begins.
        bench.start(23, 2);
        bench.write(reg::kAddrFsmLoadEn, 0);
        rest(70 * half + phase);
        bench.write(reg::kAddrSpiffrx, 2);
        bench.write(reg::kAddrSpiffrx, 0x2002);
        bench.write(reg::kAddrFsmGpreg, 0x80);
        bench.write(reg::kAddrFsmLoadEn, reg::FSM_GLOBAL_EN::kMask);
        bench.rises.clear();
        bench.falls.clear();
        bench.write(reg::kAddrFsmGpreg, 0x81);
      } else {
        bench.start(23, 2);
      }
      const Words words = bench.words(2);
      EXPECT_EQ(bench.line(words).substr(0, 23), sent());
      rest(2 * half);  // the words are there before the last edge of MA
      ASSERT_EQ(bench.rises.size(), bench.falls.size());
      ASSERT_GE(bench.rises.size(), 23U + 3U);
      for (std::size_t i = 0; i < bench.falls.size(); ++i) {
        EXPECT_EQ(bench.rises[i] - bench.falls[i], half) << i;
        if (i > 0) {
          EXPECT_EQ(bench.falls[i] - bench.rises[i - 1], half) << i;
        }
      }
      rest(70 * half);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Clocks, ClbHalf, testing::Values(10, 20, 50, 100),
                         [](const auto& test) { return "D" + std::to_string(test.param); });

// ---- Phases of SL ---------------------------------------------------------------------------

// Bit k is taken at the clock in which the synchroniser shows START, plus MATCH1 + 1 + k T.
TEST_F(Clb, EdgeOfSlInEveryClockOf2Periods_GivesEveryBit) {
  for (const unsigned half : {4U, 10U, 20U}) {
    bench.set_half(half);
    timeout(60 * half);
    mb4test::Dice dice;
    for (unsigned delay = 0; delay <= 4 * half; ++delay) {
      bench.delay = delay;
      bench.set_word(dice.below(1U << 18U), 18, dice.below(4), dice.below(2) != 0);
      EXPECT_EQ(frame(18).substr(0, 28), sent()) << half << ' ' << delay;
      ASSERT_EQ(bench.spi_rises.size(), 36U);
      for (std::size_t i = 1; i < bench.spi_rises.size(); ++i)
        EXPECT_EQ(bench.spi_rises[i] - bench.spi_rises[i - 1], 2 * half);
      // The receive clock falls at 0.
      ASSERT_GE(bench.spi_falls.size(), 35U);
      for (std::size_t i = 0; i < 35; ++i) EXPECT_EQ(bench.spi_falls[i] - bench.spi_rises[i], half);
      rest(70 * half);
    }
  }
}

// 10 ns a metre for both ways (C-8), 200 MHz: 2 clocks a metre; 10, 5, 2 and 1 MHz.
TEST_F(Clb, CableOf0To100MetresAtEachRate_GivesEveryBit) {
  mb4test::Dice dice;
  for (const unsigned half : {10U, 20U, 50U, 100U}) {
    bench.set_half(half);
    timeout(60 * half);
    for (unsigned metres = 0; metres <= 100; metres += 10) {
      bench.delay = 2 * metres;
      bench.slave.busy = dice.below(5);
      bench.set_word(dice.below(0x10000) << 16U | dice.below(0x10000), 32);
      EXPECT_EQ(frame(32).substr(0, 42), sent()) << half << ' ' << metres;
      rest(70 * half);
    }
  }
}

// SL is 1 for one clock only, in each place around the instant at which bit 5 should be taken.
TEST_F(Clb, SamplingInstant_IsHalfABitBehindStartPlusWholeBits) {
  constexpr unsigned kHalf = 10, kBit = 5;
  bench.set_half(kHalf);
  std::vector<int> taken;
  for (int place = -3; place <= 3; ++place) {
    std::optional<std::uint64_t> start;
    bench.rises.clear();
    bench.drive_sl = [&]() {
      if (bench.rises.size() >= 3 && !start) start = bench.now;
      if (!start) return bench.rises.size() < 2;
      const std::int64_t since = static_cast<std::int64_t>(bench.now - *start);
      return since < 2 || since == static_cast<std::int64_t>(kHalf + kBit * 2 * kHalf) + place;
    };
    const std::string line = frame(13);
    if (line.at(kBit) == '1') taken.push_back(place);
    bench.drive_sl = nullptr;
    rest();
  }
  // The law allows one clock more or less.
  EXPECT_EQ(taken, std::vector<int>{0});
}

// ---- Level of MA at the end -----------------------------------------------------------------

TEST_F(Clb, LevelAtTheEnd_IsGpregBit7AndCdmForTheEncoder) {
  bench.set_half(10);
  bench.set_word(0x0E08, 13);
  timeout(300);
  const std::vector<bool> wanted{false, true, true, false, true, false, false, true};
  for (const bool cdm : wanted) {
    frame(13, cdm);
    rest();
    EXPECT_EQ(bench.ma(), !cdm);
    EXPECT_EQ(bench.state(), 3U);
  }
  EXPECT_EQ(bench.cdms, wanted);
  bench.write(reg::kAddrFsmLoadEn, 0);
  EXPECT_TRUE(bench.ma()) << "the reset of the tile";
  EXPECT_EQ(bench.state(), 0U);
  EXPECT_EQ(bench.read(reg::kAddrFsmState) & ~4U, 8U);
}

// ---- Interrupt and FIFO ---------------------------------------------------------------------

TEST_F(Clb, Interrupt_ComesWithTheLastWordAndWithStart) {
  bench.set_half(10);
  bench.set_word(0x0E08, 13);
  timeout(300);
  bench.write(reg::kAddrIrqEnable, 1);
  bench.start(23, 2);
  while (!bench.irq() && bench.now < 100'000) bench.clock();
  EXPECT_EQ(bench.spi_rises.size(), 24U);
  EXPECT_LE(bench.now - bench.spi_rises.back(), 12U);
  EXPECT_EQ(bench.read(reg::kAddrIrqStatus), 9U) << "RXFFINT and START";
  EXPECT_EQ(bench.read(reg::kAddrSpiffrx) >> 7U & 0x3FU, 5U) << "two words, RXFFINT";
  bench.write(reg::kAddrIrqStatus, 1);
  EXPECT_FALSE(bench.irq());
  EXPECT_EQ(bench.read(reg::kAddrIrqStatus), 8U);
  bench.write(reg::kAddrIrqStatus, 0xFF);
  EXPECT_EQ(bench.read(reg::kAddrIrqStatus), 0U);
  rest();
  bench.write(reg::kAddrIrqEnable, 8);
  bench.start(23, 2);
  while (!bench.irq() && bench.now < 200'000) bench.clock();
  EXPECT_TRUE(bench.spi_rises.empty()) << "the start bit, before it is taken";
  rest();
  // RXFFINT that is not enabled interrupts nothing.
  bench.write(reg::kAddrIrqStatus, 0xFF);
  bench.write(reg::kAddrIrqEnable, 0xFF);
  EXPECT_EQ(bench.read(reg::kAddrIrqEnable), 0xBU);
  bench.start(23, 2);
  bench.write(reg::kAddrSpiffrx, 0x2002);
  EXPECT_EQ(bench.words(2).size(), 2U);
  rest();
  EXPECT_EQ(bench.read(reg::kAddrIrqStatus), 8U);
}

TEST_F(Clb, Overflow_DropsTheNewWordAndInterrupts) {
  bench.set_half(4);
  bench.set_word(0x0E08, 13);
  timeout(20'000);
  bench.start(23, 16);
  bench.write(reg::kAddrFsmCounter2Match1, 17 * 12);
  rest(17 * 12 * 8 + 1000);
  EXPECT_EQ(bench.read(reg::kAddrSpiffrx) >> 7U, 0x161U) << "RXFFOVF, 16 words, RXFFINT";
  EXPECT_EQ(bench.read(reg::kAddrIrqStatus), 0xBU);
  const Words words = bench.words(16);
  ASSERT_EQ(words.size(), 16U);
  EXPECT_EQ(words[0], 0x9C1U);
  EXPECT_EQ(words[1], 0x1DCU);
  for (std::size_t i = 2; i < 16; ++i) EXPECT_EQ(words[i], 0U) << "the encoder's timeout";
  EXPECT_EQ(bench.read(reg::kAddrSpirxbuf), 0U);
  constexpr std::uint32_t kOverflow = reg::RXFFOVF::kMask;
  bench.write(reg::kAddrSpiffrx, reg::RXFIFORESET::kMask);
  EXPECT_EQ(bench.read(reg::kAddrSpiffrx) & kOverflow, kOverflow) << "stays";
  bench.write(reg::kAddrSpiffrx, reg::RXFIFORESET::kMask | reg::RXFFOVFCLR::kMask);
  EXPECT_EQ(bench.read(reg::kAddrSpiffrx) & kOverflow, 0U);
}

TEST_F(Clb, SixteenWords_AreNoOverflow) {
  bench.set_half(4);
  timeout(20'000);
  bench.start(23, 16);
  rest(16 * 12 * 8 + 1000);
  EXPECT_EQ(bench.spi_rises.size(), 16U * 12U);
  EXPECT_EQ(bench.read(reg::kAddrSpiffrx) >> 7U, 0x61U) << "16 words, RXFFINT";
  EXPECT_EQ(bench.read(reg::kAddrIrqStatus), 9U);
}

TEST_F(Clb, WriteOfSpirxbuf_TakesNoWordOut) {
  bench.set_half(10);
  bench.set_word(0x0E08, 13);
  timeout(300);
  bench.start(23, 2);
  rest();
  bench.write(reg::kAddrSpirxbuf, 0);
  EXPECT_EQ(bench.words(2), (Words{0x9C1, 0x1DC}));
}

TEST_F(Clb, Rxffint_StaysUntilItIsClearedBelowItsLevel) {
  const auto raised = [this] { return reg::RXFFINT::get(bench.read(reg::kAddrSpiffrx)) != 0; };
  const std::uint32_t clear = reg::RXFIFORESET::kMask | reg::RXFFINTCLR::kMask | 2U;
  bench.set_half(10);
  timeout(300);
  bench.start(23, 2);
  rest();
  EXPECT_TRUE(raised());
  bench.write(reg::kAddrSpiffrx, clear);
  EXPECT_TRUE(raised()) << "two words wait";
  bench.read(reg::kAddrSpirxbuf);
  EXPECT_TRUE(raised()) << "below the level";
  bench.write(reg::kAddrSpiffrx, clear);
  EXPECT_FALSE(raised());
}

// A write of SPICCR drops a part word: in each clock around the last bit of a word it leaves this
// word whole, or nothing of it. The next word begins with the next bit.
TEST_F(Clb, SpiccrInAnyClockAroundTheLastBit_LeavesAWordOrNone) {
  bench.set_half(10);
  bench.drive_sl = [this] { return bench.rises.size() != 2; };
  bool kept = false, dropped = false;
  for (unsigned place = 0; place < 24; ++place) {
    bench.start(40, 3);
    while (bench.spi_rises.size() < 11) bench.clock();
    rest(place);
    bench.write(reg::kAddrSpiccr, reg::SPISWRESET::kMask | 11U);
    rest(1500);
    EXPECT_EQ(bench.spi_rises.size(), 36U);
    const Words words = bench.words(3, 100);
    // Of 36 bits: three words, or two behind 11 or 12 that are dropped.
    ASSERT_TRUE(words.size() == 3 || words.size() == 2) << place;
    for (const unsigned word : words) EXPECT_EQ(word, 0xFFFU) << place;
    (words.size() == 3 ? kept : dropped) = true;
  }
  EXPECT_TRUE(kept);
  EXPECT_TRUE(dropped);
}

// RXFFINT waits until it may interrupt.
TEST_F(Clb, Rxffiena_LetsAnInterruptThatWaitsThrough) {
  bench.set_half(10);
  timeout(300);
  bench.start(23, 2);
  bench.write(reg::kAddrSpiffrx, reg::RXFIFORESET::kMask | 2U);
  rest();
  EXPECT_EQ(bench.read(reg::kAddrIrqStatus), reg::START_SEEN::kMask);
  bench.write(reg::kAddrSpiffrx, reg::RXFIFORESET::kMask | reg::RXFFIENA::kMask | 2U);
  rest(20);
  EXPECT_EQ(bench.read(reg::kAddrIrqStatus), reg::START_SEEN::kMask | reg::RECEIVED::kMask);
}

TEST_F(Clb, OtherWordWidths_TakeTheSameBits) {
  bench.set_half(10);
  timeout(600);
  bench.set_word(0x5'A5A5, 19);
  for (unsigned width = 1; width <= 16; ++width) {
    const unsigned count = std::min(16U, 28 / width);
    bench.start(after_start(19), 2);
    bench.write(reg::kAddrSpiccr, 0x80U | (width - 1));
    bench.write(reg::kAddrFsmCounter2Match1, count * width);
    rest(2000);
    EXPECT_EQ(bench.read(reg::kAddrSpiffrx) >> 8U & 0x1FU, count);
    std::string line;
    for (unsigned i = 0; i < count; ++i) line += bits_of(bench.read(reg::kAddrSpirxbuf), width);
    EXPECT_EQ(line, sent().substr(0, count * width)) << width;
    rest();
  }
}

// ---- Watchdog -------------------------------------------------------------------------------

TEST_F(Clb, FrameWithoutStart_IsEndedByTheWatchdog) {
  bench.drive_sl = [] { return true; };
  bench.set_half(4);
  EXPECT_EQ(bench.read(reg::kAddrWatchdog), 4096U);
  for (const unsigned limit : {1U, 2U, 300U, 4096U}) {
    bench.write(reg::kAddrWatchdog, limit);
    bench.write(reg::kAddrIrqStatus, 0xFF);
    bench.start(23, 2, true);
    bench.clocks(8 * limit + 200);
    EXPECT_EQ(bench.rises.size(), limit);
    EXPECT_TRUE(bench.ma()) << "whatever GPREG says";
    const std::uint32_t state = bench.read(reg::kAddrFsmState);
    EXPECT_EQ(state >> 24U, 1U);
    EXPECT_EQ(state & 3U, 3U);
    EXPECT_EQ(bench.read(reg::kAddrIrqStatus), 2U);
    EXPECT_TRUE(bench.spi_rises.empty());
  }
  bench.drive_sl = nullptr;
  bench.set_word(0x0E08, 13);
  timeout(300);
  EXPECT_EQ(frame(13).substr(0, 23), sent()) << "the next frame is good";
  EXPECT_EQ(bench.read(reg::kAddrFsmState) >> 24U, 0U);
}

// The start bit comes in each clock around the one in which the watchdog ends the frame: one of the
// two has the frame, and the other leaves no trace.
TEST_F(Clb, StartInAnyClockAroundTheWatchdog_HasTheFrameOrNone) {
  constexpr unsigned kLimit = 5, kHalf = 4;
  bench.set_half(kHalf);
  bench.write(reg::kAddrWatchdog, kLimit);
  unsigned ended = 0, began = 0;
  for (unsigned place = 0; place < 4 * kHalf; ++place) {
    std::optional<std::uint64_t> from;
    bench.drive_sl = [&] {
      if (bench.rises.size() == kLimit - 1 && !from) from = bench.now;
      return from && bench.now >= *from + place;
    };
    bench.write(reg::kAddrIrqStatus, 0xFF);
    bench.start(23, 2);
    rest(600);
    const bool watchdog = bench.read(reg::kAddrFsmState) >> 24U != 0;
    EXPECT_EQ(bench.read(reg::kAddrIrqStatus), watchdog ? 2U : 9U) << place;
    EXPECT_EQ(bench.words(2, 100), watchdog ? Words{} : (Words{0xFFF, 0xFFF})) << place;
    ++(watchdog ? ended : began);
    EXPECT_TRUE(watchdog || ended == 0) << place;
  }
  EXPECT_GT(ended, 0U);
  EXPECT_GT(began, 0U);
}

TEST_F(Clb, Watchdog0_RunsWithoutEndUntilTheTileIsReset) {
  bench.drive_sl = [] { return false; };
  bench.set_half(4);
  bench.write(reg::kAddrWatchdog, 0);
  bench.start(23, 2);
  bench.clocks(8 * 70'000);
  EXPECT_GT(bench.rises.size(), 69'000U) << "more than the count of MA clocks can hold";
  EXPECT_EQ(bench.state(), 1U);
  for (std::size_t i = 1; i < bench.rises.size(); ++i)
    ASSERT_EQ(bench.rises[i] - bench.rises[i - 1], 8U) << "also at the published limit of 200";
  bench.write(reg::kAddrFsmLoadEn, 0);
  EXPECT_EQ(bench.state(), 0U);
  EXPECT_TRUE(bench.ma());
}

// ---- Wrong use ------------------------------------------------------------------------------

TEST_F(Clb, Match2NotAboveMatch1_LeavesMaAtRest) {
  const unsigned pairs[][2] = {{9, 9}, {9, 8}, {9, 0}, {0, 0}, {4095, 4095}, {4095, 0}};
  for (const auto& pair : pairs) {
    bench.write(reg::kAddrClkCounter0Match1, pair[0]);
    bench.write(reg::kAddrClkCounter0Match2, pair[1]);
    bench.load = pair[0];
    bench.start(23, 2);
    bench.clocks(10'000);
    EXPECT_TRUE(bench.falls.empty()) << pair[0] << ' ' << pair[1];
    EXPECT_EQ(bench.state(), 1U);
  }
  bench.set_half(10);
  bench.set_word(0x0E08, 13);
  timeout(300);
  EXPECT_EQ(frame(13).substr(0, 23), sent());
}

TEST_F(Clb, R0Of0_EndsWithTheNextRisingEdge) {
  bench.set_half(10);
  timeout(300);
  bench.set_word(0x0E08, 13);
  for (unsigned delay = 0; delay < 22; ++delay) {
    bench.delay = delay;
    bench.write(reg::kAddrFsmCounter1Match1, 200);
    bench.start(0, 2, true);
    rest(600);
    EXPECT_EQ(bench.state(), 3U);
    const std::uint32_t state = bench.read(reg::kAddrFsmState);
    EXPECT_EQ(state >> 8U & 0xFFU, bench.rises.size()) << delay;
    EXPECT_EQ(bench.read(reg::kAddrFsmCounter1Match1), bench.rises.size());
    EXPECT_FALSE(bench.ma());
  }
}

// The encoder's timeout still holds SL at 0: its end is taken as the start bit.
TEST_F(Clb, StartWhileSlIsLow_TakesTheNextRiseAsStart) {
  bench.set_half(10);
  bool sl = false;
  bench.drive_sl = [&] { return sl; };
  bench.start(23, 2);
  bench.clocks(500);
  EXPECT_EQ(bench.state(), 1U);
  sl = true;
  bench.clocks(600);
  EXPECT_EQ(bench.state(), 3U);
  EXPECT_EQ(bench.words(2), (Words{0xFFF, 0xFFF}));
}

// ---- Registers ------------------------------------------------------------------------------

struct Row {
  unsigned address;
  std::uint32_t reset, writable;
};
// Map D: what reads, and the bits that read what was written.
const Row kRows[] = {
    {0x000, 0, 0},     {0x004, 0, 0},          {0x010, 9, 0xFFF},
    {0x014, 9, 0xFFF}, {0x020, 19, 0xFFF},     {0x024, 19, 0xFFF},
    {0x040, 0, 1},     {0x044, 0, 2},          {0x084, 0, 0},
    {0x088, 0, 0},     {0x094, 200, 0xFFFF},   {0x098, 24, 0xFF},
    {0x0B0, 23, 0xFF}, {0x0C0, 0, 0x81},       {0x0C4, 0, 2},
    {0x0C8, 0xC, 0},   {0x100, 0x0B, 0x8F},    {0x104, 0x2000, 0x203F},
    {0x108, 0, 0},     {0x200, 0x454E4304, 0}, {0x204, reg::kResetVersion, 0},
    {0x208, 1, 0},     {0x20C, 0, 0},          {0x210, 0, 0xB},
    {0x218, 0, 0},     {0x220, 4096, 0xFFFF},
};

TEST_F(Clb, EveryAddress_ReadsAsTheMapSays) {
  std::vector<std::uint32_t> reset(1024, 0), writable(1024, 0);
  for (const Row& row : kRows) {
    reset[row.address / 4] = row.reset;
    writable[row.address / 4] = row.writable;
  }
  const auto skip = [](unsigned address) { return address == reg::kAddrTimeLow; };
  for (unsigned address = 0; address < 4096; address += 4)
    if (!skip(address)) {
      EXPECT_EQ(bench.read(address), reset[address / 4]) << std::hex << address;
    }
  for (const bool ones : {true, false}) {
    for (unsigned address = 0; address < 4096; address += 4) {
      if (skip(address) || address == 0xC0 || address == 0x40) continue;  // these start something
      bench.write(address, ones ? 0xFFFF'FFFF : 0);
      const std::uint32_t wanted =
          (reset[address / 4] & ~writable[address / 4]) | (ones ? writable[address / 4] : 0);
      if (address == reg::kAddrSpiffrx) {
        EXPECT_EQ(bench.read(address), wanted);
        continue;
      }
      EXPECT_EQ(bench.read(address), wanted) << std::hex << address << ' ' << ones;
    }
  }
}

TEST_F(Clb, BytesWithoutTheirStrobe_KeepTheirValue) {
  for (const unsigned strobes : {0x0U, 0x1U, 0x2U, 0xCU, 0xDU, 0xEU}) {
    bench.write(reg::kAddrClkCounter0Match1, 0xFFF, strobes);
    EXPECT_EQ(bench.read(reg::kAddrClkCounter0Match1), 9U) << strobes;
    bench.write(reg::kAddrWatchdog, 0xFFFF, strobes);
    EXPECT_EQ(bench.read(reg::kAddrWatchdog), 4096U) << strobes;
    bench.write(reg::kAddrFsmHlcR0, 0xFF, strobes & ~1U);
    EXPECT_EQ(bench.read(reg::kAddrFsmHlcR0), 23U) << strobes;
  }
  bench.write(reg::kAddrClkCounter0Match1, 0xABC, 0x3);
  EXPECT_EQ(bench.read(reg::kAddrClkCounter0Match1), 0xABCU);
  bench.write(reg::kAddrFsmHlcR0, 0xFF, 0x1);
  EXPECT_EQ(bench.read(reg::kAddrFsmHlcR0), 0xFFU);
  bench.write(reg::kAddrSpiffrx, 0xFFFF, 0x1);
  EXPECT_EQ(bench.read(reg::kAddrSpiffrx), 0x203FU);
  bench.write(reg::kAddrSpiffrx, 0, 0x2);
  EXPECT_EQ(bench.read(reg::kAddrSpiffrx), 0x003FU);
}

// What one register is written with changes no other one.
TEST_F(Clb, WriteOfOneRegister_LeavesTheOthers) {
  const auto skip = [](unsigned address) {
    return address == reg::kAddrTimeLow || address == reg::kAddrFsmState;  // these move
  };
  for (const Row& written : kRows) {
    bench.reset(true);
    rest(3);
    bench.reset(false);
    rest(5);
    // No frame: without the clock tile's START_OPERATION no clock runs.
    bench.write(written.address, written.address == reg::kAddrClkGpreg ? 0 : 0xFFFF'FFFF);
    for (const Row& row : kRows) {
      if (&row == &written || skip(row.address)) continue;
      EXPECT_EQ(bench.read(row.address), row.reset)
          << std::hex << written.address << ' ' << row.address;
    }
  }
}

// A period of MA begins with its low half, and the first one does so when the count is 0.
TEST_F(Clb, LoadOfTheMaCounter_SaysWhenMaFalls) {
  constexpr unsigned kHalf = 50;
  bench.set_half(kHalf);
  std::vector<std::uint64_t> first;
  for (const unsigned load : {kHalf - 1, kHalf - 11, 0U}) {
    bench.load = load;
    bench.start(23, 2);
    const std::uint64_t begin = bench.now;
    while (bench.falls.empty() && bench.now < begin + 1000) bench.clock();
    ASSERT_EQ(bench.falls.size(), 1U);
    first.push_back(bench.falls[0] - begin);
    rest(kHalf);
  }
  EXPECT_EQ(first[1] - first[0], 10U);
  EXPECT_EQ(first[2] - first[0], kHalf - 1U);
}

// In state 10 the next bit is taken as many clocks later as the count is lower. A write of another
// register moves no bit.
TEST_F(Clb, LoadOfTheReceiveCounter_SaysWhenTheNextBitIsTaken) {
  constexpr unsigned kHalf = 100;
  bench.set_half(kHalf);
  timeout(100 * kHalf);
  std::vector<std::uint64_t> taken;
  for (const unsigned load : {90U, 60U, 0U}) {
    bench.start(23, 2);
    while (bench.spi_rises.size() < 3) bench.clock();
    rest(20);
    bench.write(reg::kAddrFsmHlcR0, 23);
    bench.write(reg::kAddrClkCounter1Match1, kHalf - 1);
    while (bench.spi_rises.size() < 4) bench.clock();
    EXPECT_EQ(bench.spi_rises[3] - bench.spi_rises[2], 2 * kHalf);
    rest(20);
    bench.write(reg::kAddrClkCounter1Load, load);
    const std::uint64_t written = bench.now;
    while (bench.spi_rises.size() < 5) bench.clock();
    taken.push_back(bench.spi_rises[4] - written);
    rest(150 * kHalf);
  }
  EXPECT_EQ(taken[1] - taken[0], 30U);
  EXPECT_EQ(taken[2] - taken[0], 90U);
}

// START_OPERATION of the clock tile is a level: without it nothing moves, and then all goes on.
TEST_F(Clb, StartOperationOfTheClockTile_IsALevel) {
  bench.set_half(10);
  bench.set_word(0x0E08, 13);
  timeout(5000);
  bench.start(23, 2);
  while (bench.spi_rises.size() < 5) bench.clock();
  for (int stop = 0; stop < 40; ++stop) {
    rest(3);
    bench.write(reg::kAddrClkGpreg, 0);
    const std::size_t edges = bench.rises.size() + bench.falls.size();
    const std::size_t bits = bench.spi_rises.size();
    rest(100);
    EXPECT_EQ(bench.rises.size() + bench.falls.size(), edges);
    EXPECT_EQ(bench.spi_rises.size(), bits);
    bench.write(reg::kAddrClkGpreg, 1);
  }
  EXPECT_EQ(bench.words(2), (Words{0x9C1, 0x1DC}));
}

// START_OPERATION of the FSM tile is an edge: a 0 begins nothing, and neither does a 1 that is
// written again, nor does it end anything.
TEST_F(Clb, StartOperationOfTheFsmTile_IsAnEdge) {
  bench.write(reg::kAddrFsmLoadEn, reg::FSM_GLOBAL_EN::kMask);
  bench.write(reg::kAddrFsmGpreg, reg::END_LEVEL::kMask);
  EXPECT_EQ(bench.state(), 0U);
  bench.set_half(10);
  bench.set_word(0x0E08, 13);
  timeout(300);
  bench.start(23, 2);
  for (int again = 0; again < 40; ++again) {
    bench.write(reg::kAddrFsmGpreg, reg::END_LEVEL::kMask | reg::FSM_START_OPERATION::kMask);
    rest(3);
  }
  EXPECT_EQ(bench.words(2), (Words{0x9C1, 0x1DC}));
  EXPECT_EQ(bench.rises.size(), 26U + 1U) << "3 before START";
}

// GLOBAL_EN = 0 of either tile sets MA to 1, also in its low half.
TEST_F(Clb, GlobalEn0OfATile_SetsMaTo1) {
  bench.set_half(100);
  for (const unsigned address : {reg::kAddrClkLoadEn, reg::kAddrFsmLoadEn}) {
    bench.start(23, 2);
    while (bench.falls.size() < 3) bench.clock();
    rest(20);
    EXPECT_FALSE(bench.ma());
    bench.write(address, 0);
    EXPECT_TRUE(bench.ma()) << address;
    rest(1000);
    EXPECT_TRUE(bench.ma()) << address;
    EXPECT_EQ(bench.falls.size(), 3U) << address;
    rest(4000);
  }
}

// In each clock of a frame: MA, interrupt and receive clock have their levels at once.
TEST_F(Clb, ResetInAFrame_SetsThePinsAtOnce) {
  bench.set_half(10);
  timeout(300);
  for (unsigned clocks = 60; clocks < 120; ++clocks) {
    bench.set_half(10);
    bench.write(reg::kAddrIrqEnable, 8);
    bench.start(23, 2);
    rest(clocks);
    bench.reset(true);
    EXPECT_TRUE(bench.ma());
    EXPECT_FALSE(bench.irq());
    EXPECT_FALSE(bench.spi_clock());
    rest(3);
    bench.reset(false);
    rest(600);
    EXPECT_TRUE(bench.ma());
    EXPECT_EQ(bench.state(), 0U);
  }
}

TEST_F(Clb, Load_SetsTheCountersAtOnce) {
  bench.write(reg::kAddrFsmLoadEn, reg::FSM_GLOBAL_EN::kMask);
  bench.write(reg::kAddrFsmCounter1Load, 0x1AB);
  bench.write(reg::kAddrFsmCounter2Load, 0xCD);
  EXPECT_EQ(bench.read(reg::kAddrFsmState), 0x00CD'AB0CU);
  bench.write(reg::kAddrFsmLoadEn, 0);
  EXPECT_EQ(bench.read(reg::kAddrFsmState), 0xCU);
}

TEST_F(Clb, Time_CountsClocks) {
  const std::uint32_t before = bench.read(reg::kAddrTimeLow);
  const std::uint64_t from = bench.now;
  rest(1000);
  const std::uint32_t after = bench.read(reg::kAddrTimeLow);
  EXPECT_EQ(after - before, bench.now - from);
  EXPECT_EQ(bench.read(reg::kAddrTimeHigh), 0U);
}

// Addresses, strobes and values at random, at any time, also while a frame runs. Nothing hangs:
// each access is answered, and behind a clean start the next frame is good.
TEST_F(Clb, RandomAccesses_NeverHangAndLeaveTheNextFrameGood) {
  mb4test::Dice dice;
  const char* text = std::getenv("MB4_CLB_ACCESSES");
  const int accesses = text != nullptr ? std::atoi(text) : 100'000;
  bench.set_word(0x0E08, 13);
  timeout(300);
  int frames = 0;
  for (int i = 0; i < accesses; ++i) {
    const unsigned row = dice.below(sizeof kRows / sizeof *kRows + 1);
    const unsigned address =
        row < sizeof kRows / sizeof *kRows ? kRows[row].address : dice.below(0x1000);
    if (dice.below(2) != 0) {
      const unsigned kind = dice.below(3);
      const std::uint32_t value = kind == 0   ? dice.below(2)
                                  : kind == 1 ? dice.below(64)
                                              : dice.below(0x10000) << 16U | dice.below(0x10000);
      bench.write(address, value, dice.below(4) != 0 ? 0xFU : dice.below(16));
    } else {
      bench.read(address);
    }
    if (HasFatalFailure()) return;
    if (dice.below(8) == 0) bench.clocks(dice.below(100));
    if (i % 1000 == 999) {
      bench.write(reg::kAddrFsmLoadEn, 0);
      bench.write(reg::kAddrWatchdog, 4096);
      rest(400);  // the encoder's timeout
      bench.set_half(10);
      ASSERT_EQ(frame(13).substr(0, 23), sent()) << i;
      ++frames;
    }
  }
  EXPECT_EQ(frames, accesses / 1000);
}

}  // namespace
