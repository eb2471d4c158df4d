// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What the judge gives for whole frames: Table 10 of the published text, errors, processing time,
// lengths, and no encoder (R-P13 to R-P16, R-P18 to R-P22).
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "tests/unit/pru/judge_bench.hpp"

namespace {

using namespace pru_judge;
using namespace pru_judge_test;

const std::vector<std::string> kNone;

JudgeSetup at_80_mhz() {
  JudgeSetup setup;
  setup.clock_hz = 80'000'000;
  return setup;
}

// P-4. Row 9 is blank in the text; the facts have 2.
TEST(PruJudgeFrame, Table10_GivesItsLineDelays) {
  struct Row {
    unsigned mhz;
    unsigned metres;
    unsigned line_delay;
  };
  constexpr Row kTable10[] = {{1, 2, 1}, {1, 17, 1}, {1, 27, 1}, {1, 42, 1}, {1, 67, 2},
                              {2, 2, 1}, {2, 17, 1}, {2, 27, 2}, {2, 42, 2}, {2, 67, 3},
                              {5, 2, 1}, {5, 17, 3}, {5, 27, 3}, {10, 2, 4}};
  struct Cable {
    Time fixed_ns;
    Time ps_per_m;
  };
  for (const JudgeSetup& setup : {JudgeSetup{}, at_80_mhz()}) {
    for (const Cable& cable : {Cable{148, 16'000}, Cable{138, 16'600}}) {
      for (const Row& row : kTable10) {
        Bench bench(setup);
        bench.delay = cable.fixed_ns * kNs + row.metres * cable.ps_per_m;
        bench.start(12, 8, row.mhz);
        for (unsigned i = 0; i < 8; ++i) {
          const FrameReport report = bench.frame({0, false, word(0x800 + i, 12)});
          EXPECT_EQ(report.complaints, kNone);
          EXPECT_TRUE(report.good);
          EXPECT_EQ(bench.judge.position(), 0x800U + i);
          if (i == 0) continue;  // at 1 MHz
          EXPECT_EQ(bench.judge.byte(kLineDelay), row.line_delay) << row.mhz << " " << row.metres;
        }
        EXPECT_EQ(bench.judge.value(kPosCrcErrors, 2), 0U);
      }
    }
  }
}

// R-P22: the line itself has 2 periods at 10 MHz.
TEST(PruJudgeFrame, Extra10_CanBeLeftOut) {
  JudgeSetup setup;
  setup.extra_10 = false;
  Bench bench(setup);
  bench.start(12, 8, 10);
  bench.frame({0, false, word(1, 12)});
  EXPECT_TRUE(bench.frame({0, false, word(2, 12)}).good);
  EXPECT_EQ(bench.judge.byte(kLineDelay), 2);
}

// P-5: the counter counts, POS and the signals stay as in the last good frame.
TEST(PruJudgeFrame, BitErrors_AreCountedAndChangeNoPosition) {
  for (const unsigned errors : {29U, 6U, 1U}) {
    Bench bench;
    bench.start(12, 8, 5);
    unsigned seen = 0;
    for (unsigned i = 0; i < 1000; ++i) {
      std::string bits = word(i, 12, i % 2 == 0 ? "10" : "01");
      const bool bad = i % (1000 / errors) == 5 && seen < errors;
      const std::uint64_t before = bench.judge.position();
      const std::uint32_t signals = bench.judge.picture().signals & 3U;
      if (bad) bits[i % 20] ^= 1;
      EXPECT_EQ(bench.frame({0, false, bits}).good, !bad);
      seen += bad ? 1 : 0;
      EXPECT_EQ(bench.judge.position(), bad ? before : i);
      EXPECT_EQ(bench.judge.picture().signals & 3U, bad ? signals : i % 2 == 0 ? 1U : 2U);
      EXPECT_EQ(bench.judge.byte(kFlags) & kPosCrcErr, bad ? kPosCrcErr : 0);
      EXPECT_EQ(binary(bench.judge.byte(kPosCrc), 6), bits.substr(14));
    }
    EXPECT_EQ(bench.judge.value(kPosCrcErrors, 2), errors);
    EXPECT_EQ(bench.judge.picture().frame_count, 1000U);
    bench.start(12, 8, 5);
    EXPECT_EQ(bench.judge.value(kPosCrcErrors, 2), 0U);
  }
}

// P-6, R-P13, R-P16. With SL low from the sixth eighth on MA ends two edges after the limit.
TEST(PruJudgeFrame, ProcessingTime_IsExactUpToTheLimit) {
  constexpr unsigned kLimits[][2] = {{1, 40}, {2, 80}, {5, 200}, {10, 400}};
  for (const JudgeSetup& setup : {JudgeSetup{}, at_80_mhz()}) {
    for (const auto& [mhz, limit] : kLimits) {
      Bench bench(setup);
      bench.start(12, 8, mhz);
      bench.delay = Time{180} * kNs / mhz;
      bench.frame({0, false, word(0xABC, 12)});
      for (unsigned zeros = 0; zeros <= limit; zeros += zeros < 5 || zeros + 5 > limit ? 1 : 17) {
        const FrameReport report = bench.frame({zeros, false, word(zeros, 12)});
        EXPECT_EQ(report.complaints, kNone) << zeros;
        EXPECT_EQ(report.ma.least, 25 + zeros);
        EXPECT_EQ(report.ma.most, 25 + zeros);
        EXPECT_TRUE(report.good) << zeros;
        EXPECT_EQ(bench.judge.value(kProcTime, 2), zeros);
        EXPECT_EQ(bench.judge.byte(kFlags) & kProcTimeErr, 0);
      }
      const std::uint64_t position = bench.judge.position();
      const std::uint8_t crc = bench.judge.byte(kPosCrc);
      bench.ma_edges = limit + 4;
      const FrameReport dropped = bench.frame({limit + 1, false, word(0, 12)});
      EXPECT_EQ(dropped.complaints, kNone);
      EXPECT_EQ(dropped.reading.kind, FrameKind::kDropped);
      EXPECT_EQ(dropped.ma.least, limit + 4);
      EXPECT_EQ(bench.judge.byte(kFlags) & ~kSmaFlag, kProcTimeErr);
      EXPECT_EQ(bench.judge.value(kProcTime, 2), limit + 1);
      EXPECT_EQ(bench.judge.byte(kRawData), dropped.reading.raw);
      EXPECT_EQ(bench.judge.position(), position);
      EXPECT_EQ(bench.judge.byte(kPosCrc), crc);
      EXPECT_EQ(bench.judge.value(kPosCrcErrors, 2), 0U);
      EXPECT_TRUE(bench.frame({0, false, word(1, 12)}).good);
      EXPECT_EQ(bench.judge.byte(kFlags) & ~kSmaFlag, 0);
    }
  }
}

TEST(PruJudgeFrame, ProcTimeMax_IsTheLimit) {
  Bench bench;
  bench.start(12, 8, 5);
  bench.judge.write(kProcTimeMax, 0xFFFFFC03);
  EXPECT_EQ(bench.judge.read(kProcTimeMax), 3U);
  bench.frame({0, false, word(0, 12)});
  EXPECT_TRUE(bench.frame({3, false, word(0, 12)}).good);
  EXPECT_EQ(bench.frame({4, false, word(0, 12)}).reading.kind, FrameKind::kDropped);
  EXPECT_EQ(bench.judge.value(kProcTime, 2), 4U);
}

// MA: 5 + bits + PROC_TIME rising edges, whatever the line delay.
TEST(PruJudgeFrame, MaEdges_DoNotDependOnTheLineDelay) {
  for (const Time periods : {0, 1, 12}) {
    Bench bench;
    bench.start(12, 8, 5);
    bench.frame({0, false, word(0, 12)});
    bench.delay = periods * 200 * kNs + 30 * kNs;
    for (const unsigned zeros : {0U, 3U}) {
      const FrameReport report = bench.frame({zeros, false, word(77, 12)});
      EXPECT_EQ(report.complaints, kNone);
      EXPECT_TRUE(report.good);
      EXPECT_EQ(report.ma.least, 25 + zeros);
      EXPECT_EQ(bench.judge.byte(kLineDelay), periods + 1);
    }
  }
}

// R-P18, R-P19, R-P20.
TEST(PruJudgeFrame, EveryLength_IsReadRight) {
  std::mt19937_64 random(1);
  for (unsigned bits = 1; bits <= 55; ++bits) {
    Bench bench;
    bench.start(bits, 8, 5);
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint64_t position = random() >> (64 - bits);
      EXPECT_TRUE(bench.frame({i, i % 2 == 0, word(position, bits, "01")}).good) << bits;
      EXPECT_EQ(bench.judge.position(), position) << bits;
      EXPECT_EQ(bench.judge.picture().signals & 3U, 2U);
    }
  }
}

TEST(PruJudgeFrame, CheckBits_AreCrcFlagsAndMore) {
  for (unsigned check = 0; check <= 40; ++check) {
    Bench bench;
    bench.start(12, check, 1);
    const unsigned acts = check > 32 ? 32 : check;
    const std::string signals(acts < 6 ? acts : acts - 6, '0');
    std::string bits = binary(0x5A5, 12) + signals;
    if (acts >= 6) bits += crc6(bits);
    const FrameReport report = bench.frame({0, false, bits});
    EXPECT_EQ(report.complaints, kNone) << check;
    EXPECT_TRUE(report.good) << check;
    EXPECT_EQ(bench.judge.position(), 0x5A5U) << check;
    EXPECT_EQ(bench.judge.byte(kPosCrc) != 0, acts >= 6) << check;
    EXPECT_EQ(bench.judge.picture().signals & 3U, signals.empty()       ? 3U
                                                  : signals.size() == 1 ? 2U
                                                                        : 0U)
        << check;
  }
}

TEST(PruJudgeFrame, LengthsOutOfRange_AreCut) {
  struct Row {
    unsigned position;
    unsigned check;
    unsigned position_acts;
    unsigned check_acts;
  };
  constexpr Row kRows[] = {{0, 8, 1, 8},    {55, 8, 55, 8}, {56, 8, 55, 8}, {255, 255, 31, 32},
                           {255, 0, 63, 0}, {64, 6, 57, 6}, {1, 33, 1, 32}, {31, 32, 31, 32}};
  for (const Row& row : kRows) {
    Bench bench;
    bench.start(row.position, row.check, 1);
    EXPECT_EQ(bench.judge.position_bits(), row.position_acts);
    EXPECT_EQ(bench.judge.check_bits(), row.check_acts);
    EXPECT_EQ(bench.judge.byte(kDataLength), row.position);
    const std::uint64_t position = ~std::uint64_t{0} >> (64 - row.position_acts);
    std::string bits = binary(position, row.position_acts);
    bits += std::string(row.check_acts < 6 ? 0 : row.check_acts - 6, '1');
    if (row.check_acts >= 6) bits += crc6(bits);
    EXPECT_TRUE(bench.frame({0, true, bits}).good);
    EXPECT_EQ(bench.judge.position(), position);
  }
}

// R-P4: lengths are taken when RUN rises.
TEST(PruJudgeFrame, Lengths_CountWithRun) {
  Bench bench;
  bench.start(12, 8, 1);
  bench.judge.write(kDataLength, 0x0814, 3);
  EXPECT_TRUE(bench.frame({0, false, word(0x123, 12)}).good);
  bench.judge.write(kRun, 1);  // it is 1 already
  EXPECT_TRUE(bench.frame({0, false, word(0x124, 12)}).good);
  bench.judge.write(kRun, 0);
  bench.judge.write(kRun, 1);
  EXPECT_TRUE(bench.frame({0, false, word(0xFEDCB, 20)}).good);
  EXPECT_EQ(bench.judge.position(), 0xFEDCBU);
}

// R-P5: before any legal one 1 MHz, then the last legal one.
TEST(PruJudgeFrame, IllegalFrequency_IsIgnored) {
  Bench bench;
  bench.start(12, 8, 7);
  const auto rate_after = [&](unsigned mhz) {
    bench.judge.write(kDataLength, mhz << 16, 4);
    EXPECT_TRUE(bench.frame({0, false, word(1, 12)}).good);
    return bench.judge.mhz();
  };
  EXPECT_EQ(rate_after(7), 1U);
  EXPECT_EQ(rate_after(5), 5U);
  EXPECT_EQ(rate_after(0), 5U);
  EXPECT_EQ(rate_after(10), 10U);
  EXPECT_EQ(rate_after(255), 10U);
  EXPECT_EQ(bench.judge.byte(kFrequency), 255);
  EXPECT_EQ(rate_after(2), 2U);
}

// R-P15: unplugged with SL = 0, stuck at 1, plugged again without the host.
TEST(PruJudgeFrame, NoEncoder_IsToldAndForgotten) {
  for (const unsigned mhz : {1U, 2U, 5U, 10U}) {
    Bench bench;
    bench.start(12, 8, mhz);
    bench.frame({2, false, word(0x777, 12)});
    bench.frame({2, false, word(0x777, 12)});
    const Picture good = bench.judge.picture();
    bench.judge.write(kIrqStatus, 0x1F);

    Picture due = good;
    due.memory[kRawData] = 0;
    due.memory[kFlags] = kNoSlaveFlag;
    due.frame_count = 3;
    due.irq_status = kIrqFrame | kIrqFlags;
    const FrameReport low = bench.frame_without_ma();
    EXPECT_EQ(low.complaints, kNone);
    EXPECT_EQ(differences(due, bench.judge.picture()), kNone);

    Answer silent;
    silent.acknowledges = false;
    const FrameReport high = bench.frame(silent);
    EXPECT_EQ(high.complaints, kNone);
    EXPECT_EQ(high.ma.least, 25U);
    due.memory[kRawData] = 0xFF;
    due.memory[kLineDelay] = mhz == 10 ? 25 : 23;
    due.memory[kProcTime] = 0;
    due.frame_count = 4;
    due.irq_status = kIrqFrame | kIrqFlags | kIrqLost;
    due.latch_time = bench.judge.picture().latch_time;
    EXPECT_NE(due.latch_time, good.latch_time);
    EXPECT_EQ(differences(due, bench.judge.picture()), kNone);

    EXPECT_TRUE(bench.frame({1, false, word(0x778, 12)}).good);
    EXPECT_EQ(bench.judge.position(), 0x778U);
    EXPECT_EQ(bench.judge.byte(kFlags), 0);
  }
}

// Broken as the first thing: nothing but the flag.
TEST(PruJudgeFrame, NoEncoderAtTheStart_ShowsTheFlagOnly) {
  Bench bench;
  bench.start(12, 8, 5);
  bench.frame_without_ma();
  Picture due;
  due.memory[kDataLength] = 12;
  due.memory[kCrcErrWar] = 8;
  due.memory[kFrequency] = 5;
  due.memory[kFlags] = kNoSlaveFlag;
  due.irq_status = kIrqFrame | kIrqFlags;
  due.frame_count = 1;
  due.signals = 3;
  EXPECT_EQ(differences(due, bench.judge.picture()), kNone);
  EXPECT_EQ(bench.judge.mhz(), 5U);
}

// An acknowledge in the last byte of the search is one, a period later there is none.
TEST(PruJudgeFrame, Search_EndsWithTheClocks) {
  Bench bench;
  bench.start(1, 8, 5);
  bench.frame({0, false, word(1, 1)});
  bench.delay = 11 * 200 * kNs + 100 * kNs;
  const FrameReport last = bench.frame({0, false, word(1, 1)});
  EXPECT_EQ(last.complaints, kNone);
  EXPECT_TRUE(last.good);
  EXPECT_EQ(bench.judge.byte(kLineDelay), 12);
  bench.delay += 200 * kNs;
  EXPECT_EQ(bench.frame({0, false, word(1, 1)}).reading.kind, FrameKind::kNoAcknowledge);
  EXPECT_EQ(bench.judge.byte(kLineDelay), 12);
}

// Of 3000 random frames with jitter of 10 % of a period all are read right. All parts of a frame
// vary.
TEST(PruJudgeFrame, RandomFrames_AreReadRight) {
  std::mt19937_64 random(22);
  const auto below = [&](std::uint64_t limit) { return static_cast<Time>(random() % limit); };
  constexpr unsigned kMhz[] = {1, 2, 5, 10};
  for (unsigned round = 0; round < 150; ++round) {
    JudgeSetup setup = round % 2 == 0 ? JudgeSetup{} : at_80_mhz();
    setup.first_low = round % 4 >= 2;
    Bench bench(setup);
    const unsigned mhz = kMhz[below(4)];
    const unsigned bits = 9 + static_cast<unsigned>(below(47));
    bench.start(bits, 8, mhz);
    bench.delay = 100 * kNs;
    bench.frame({0, false, word(0, bits)});
    bench.delay = below(12'000'000 / mhz);
    const Time jitter = 100'000 / mhz;
    bench.jitter = [&] { return below(static_cast<std::uint64_t>(jitter)); };
    for (unsigned i = 0; i < 20; ++i) {
      const std::uint64_t position = random() >> (64 - bits);
      const unsigned zeros = static_cast<unsigned>(below(20));
      const FrameReport report = bench.frame({zeros, below(2) == 1, word(position, bits)});
      ASSERT_EQ(report.complaints, kNone) << round << " " << i;
      ASSERT_TRUE(report.good) << round << " " << i << " " << mhz << " " << bench.delay;
      ASSERT_EQ(bench.judge.position(), position);
      ASSERT_EQ(bench.judge.value(kProcTime, 2), zeros);
    }
  }
}

// Bad words of frames `from` to `to` (exclusive) at a rate, over 121 delays in 12 periods, with
// jitter of SL in percent of a period, peak to peak.
unsigned bad_words(const JudgeSetup& setup, unsigned mhz, unsigned percent, unsigned from,
                   unsigned to) {
  std::mt19937_64 random(percent);
  const Time period = kUs / mhz;
  const Time jitter = period * percent / 100;
  unsigned bad = 0;
  for (Time step = 0; step < 121; ++step) {
    Bench bench(setup);
    bench.start(12, 8, mhz);
    if (mhz != 1) bench.frame({0, false, word(0, 12)});
    bench.delay = period + period * step / 10 - jitter / 2;
    bench.jitter = [&] { return static_cast<Time>(random() % static_cast<unsigned>(jitter)); };
    for (unsigned i = 0; i < to; ++i) {
      const std::uint64_t position = random() >> 52;
      const FrameReport report = bench.frame({0, false, word(position, 12)});
      EXPECT_EQ(report.settings.averages, mhz != 10 && i >= 4);
      if (i >= from && (!report.good || bench.judge.position() != position)) ++bad;
    }
  }
  return bad;
}

// The jitter that the rulings promise; above it the ones count fails, FIRST_LOW does not (R-P12a).
TEST(PruJudgeFrame, Jitter_IsStoodAsTheRulingsSay) {
  for (const JudgeSetup& clock : {JudgeSetup{}, at_80_mhz()}) {
    JudgeSetup first_low = clock;
    first_low.first_low = true;
    for (const unsigned mhz : {1U, 2U, 5U, 10U}) {
      const bool averages = mhz != 10;
      EXPECT_EQ(bad_words(clock, mhz, 12, 0, averages ? 4 : 12), 0U) << mhz;
      if (averages) {
        EXPECT_EQ(bad_words(clock, mhz, 20, 4, 16), 0U) << mhz;
      }
      EXPECT_EQ(bad_words(first_low, mhz, 30, 0, 16), 0U) << mhz;
    }
    EXPECT_GT(bad_words(clock, 10, 35, 0, 16), 0U);
  }
}

// R-P12: the published average reads wrong bits where SP goes from 0 to 7, at 10 % of jitter.
TEST(PruJudgeFrame, PublishedAverage_FailsWhereThePointWraps) {
  JudgeSetup setup;
  setup.sma_wrap = true;
  EXPECT_GT(bad_words(setup, 1, 10, 4, 16), 0U);
  EXPECT_EQ(bad_words(JudgeSetup{}, 1, 10, 4, 16), 0U);
}

}  // namespace
