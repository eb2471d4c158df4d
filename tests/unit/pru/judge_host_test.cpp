// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Map B as the judge has it: reset values, widths, what the host may write and how it reads.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "tests/unit/pru/judge_bench.hpp"

namespace {

using namespace pru_judge;
using namespace pru_judge_test;

TEST(PruJudgeHost, AfterReset_WordsAreThoseOfTheMap) {
  for (const std::uint32_t clock_hz : {200'000'000U, 80'000'000U}) {
    JudgeSetup setup;
    setup.clock_hz = clock_hz;
    setup.version = 0x00010000;
    setup.sma_wrap = clock_hz == 80'000'000;
    Judge judge(setup);
    for (std::uint32_t address = 0; address < 0x1000; address += 4) {
      std::uint32_t due = 0;
      if (address == 0x200) due = 0x454E4303;
      if (address == 0x204) due = 0x00010000;
      if (address == 0x208) due = clock_hz == 80'000'000 ? 0x16 : 0x10;
      if (address == 0x224) due = clock_hz == 80'000'000 ? 8000 : 20000;
      if (address == 0x228) due = clock_hz == 80'000'000 ? 2160 : 5400;
      if (address == 0x230) due = 3;
      EXPECT_EQ(judge.read(address), due) << address;
    }
  }
  JudgeSetup wrong;
  wrong.clock_hz = 100'000'000;
  EXPECT_THROW(Judge{wrong}, std::invalid_argument);
}

// R-P21 and the widths: bits that the host can set.
TEST(PruJudgeHost, OnesEverywhere_StayWhereTheHostWrites) {
  Judge judge{JudgeSetup{}};
  for (std::uint32_t address = 0; address < 0x1000; address += 4) {
    if (address != kRun) judge.write(address, 0xFFFFFFFF);
  }
  for (std::uint32_t address = 0; address < 0x1000; address += 4) {
    std::uint32_t due = 0;
    if (address == 0x000) due = 0x00FFFFFF;
    if (address == 0x004) due = 0xFFFFFFFF;
    if (address == 0x200) due = 0x454E4303;
    if (address == 0x208) due = 0x10;
    if (address == 0x210) due = 0x1F;
    if (address == 0x224) due = 0x00FFFFFF;
    if (address == 0x228) due = 0xFFFF;
    if (address == 0x22C) due = 0x3FF;
    if (address == 0x230) due = 3;
    EXPECT_EQ(judge.read(address), due) << address;
  }
  judge.write(kTriggerPeriod, 0, 2);
  EXPECT_EQ(judge.read(kTriggerPeriod), 0xFF00FFU);
  judge.write(kDataLength, 0x55555555, 4);
  EXPECT_EQ(judge.read(kDataLength), 0x0055FFFFU);
}

// R-P9.
TEST(PruJudgeHost, PosHi_KeepsPosLoForTheNextRead) {
  Bench bench;
  bench.start(40, 8, 5);
  bench.frame({0, false, word(0x12FFFFFFFF, 40)});
  EXPECT_EQ(bench.judge.read(kPosHi), 0x12U);
  bench.frame({0, false, word(0x1300000000, 40)});
  EXPECT_EQ(bench.judge.read(kPosLo), 0xFFFFFFFFU);
  EXPECT_EQ(bench.judge.read(kPosLo), 0U);
  EXPECT_EQ(bench.judge.read(kPosHi), 0x13U);
}

TEST(PruJudgeHost, Interrupts_TellFramesAndFlags) {
  Bench bench;
  bench.start(12, 8, 1);
  Judge& judge = bench.judge;
  bench.frame({0, false, word(1, 12)});
  EXPECT_EQ(judge.read(kIrqStatus), unsigned{kIrqFrame});
  EXPECT_FALSE(judge.irq());
  judge.write(kIrqEnable, kIrqFrame);
  EXPECT_TRUE(judge.irq());
  bench.frame({0, false, word(1, 12)});
  EXPECT_EQ(judge.read(kIrqStatus), unsigned{kIrqFrame | kIrqLost});
  judge.write(kIrqStatus, kIrqFrame | kIrqLost, 2);
  EXPECT_EQ(judge.read(kIrqStatus), unsigned{kIrqFrame | kIrqLost});
  judge.write(kIrqStatus, kIrqFrame);
  EXPECT_EQ(judge.read(kIrqStatus), unsigned{kIrqLost});
  EXPECT_FALSE(judge.irq());
  judge.write(kIrqStatus, 0x1F);
  std::string bad = word(1, 12);
  bad[0] ^= 1;
  bench.frame({0, false, bad});
  EXPECT_EQ(judge.read(kIrqStatus), unsigned{kIrqFrame | kIrqFlags});
  judge.write(kIrqStatus, 0x1F);
  bench.frame({0, false, bad});  // the flag has not risen again
  EXPECT_EQ(judge.read(kIrqStatus), unsigned{kIrqFrame});
  judge.write(kIrqStatus, 0x1F);
  judge.trigger(false);
  EXPECT_EQ(judge.read(kIrqStatus), unsigned{kIrqTrigger});
  judge.trigger(true);
  EXPECT_EQ(judge.read(kIrqStatus), unsigned{kIrqTrigger | kIrqLost});
}

// LATCH_TIME is the clock of rising edge 1: 100 us, 1 us and a period after time 0.
TEST(PruJudgeHost, LatchTime_IsTheClockOfRisingEdge1) {
  JudgeSetup setup;
  setup.time_zero = 50 * kUs;
  Bench bench(setup);
  bench.start(12, 8, 1);
  bench.frame({0, false, word(1, 12)});
  EXPECT_EQ(bench.judge.read(kLatchTime), 52U * 200);
}

TEST(PruJudgeHost, Counters_Wrap) {
  Bench bench;
  bench.start(1, 6, 10);
  std::string bad = "1" + crc6("1");
  bad[3] ^= 1;
  for (unsigned i = 0; i < 65'536; ++i) {
    EXPECT_EQ(bench.judge.read(kFrameCount), i);
    EXPECT_EQ(bench.judge.value(kPosCrcErrors, 2), i);
    bench.frame({0, false, bad});
  }
  EXPECT_EQ(bench.judge.read(kFrameCount), 0U);
  EXPECT_EQ(bench.judge.value(kPosCrcErrors, 2), 0U);
  EXPECT_EQ(bench.judge.byte(kPosCrcErrors + 2), kPosCrcErr);
}

TEST(PruJudgeHost, Differences_NameByteAndValues) {
  Picture due;
  Picture seen;
  EXPECT_EQ(differences(due, seen), std::vector<std::string>());
  seen.memory[kProcTime + 1] = 0xA0;
  seen.signals = 3;
  EXPECT_EQ(differences(due, seen),
            (std::vector<std::string>{"0x0000001D PROC_TIME is 0x000000A0, not 0x00000000",
                                      "0x00000230 SIGNALS is 0x00000003, not 0x00000000"}));
}

}  // namespace
