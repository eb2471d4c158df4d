// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Wrong masters: what the judge says to MA and to the instant at which the memory changes.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/pru/judge_bench.hpp"

namespace {

using namespace pru_judge;
using namespace pru_judge_test;
using Complaints = std::vector<std::string>;

// A frame at 5 MHz after one at 1 MHz, with MA made wrong.
Complaints complaints_of(const std::function<void(Bench&)>& wrong, bool starts_control = false) {
  Bench bench;
  bench.start(12, 8, 5);
  if (starts_control) bench.judge.write(kCtrlWord, 0x8CE54000);
  for (unsigned i = 0; i < (starts_control ? 15 : 1); ++i) bench.frame({0, false, word(1, 12)});
  wrong(bench);
  return bench.frame({0, false, word(1, 12)}).complaints;
}

TEST(PruJudgeMa, EdgeTooManyOrTooFew_IsTold) {
  EXPECT_EQ(complaints_of([](Bench&) {}), Complaints());
  EXPECT_EQ(complaints_of([](Bench& bench) { bench.ma_edges = 26; }),
            Complaints{"MA has 26 rising edges, not 25"});
  EXPECT_EQ(complaints_of([](Bench& bench) { bench.ma_edges = 24; }),
            Complaints{"MA has 24 rising edges, not 25"});
  // With CDM = 1 the last one is not sent.
  EXPECT_EQ(complaints_of([](Bench&) {}, true), Complaints());
  EXPECT_EQ(complaints_of([](Bench& bench) { bench.ma_edges = 26; }, true),
            Complaints{"MA has 25 rising edges, not 24"});
}

// Sends all edges of `ma` through `change`, which may move one or leave it out.
std::function<void(Bench&)> spoiled(const std::function<void(Trace&, Edge, unsigned)>& change) {
  return [change](Bench& bench) {
    bench.spoil = [change](Trace& ma) {
      Trace wrong(ma.before(0));
      unsigned number = 0;
      for (const Edge& edge : ma.within(0, 1'000'000 * kUs)) change(wrong, edge, number++);
      ma = wrong;
    };
  };
}

TEST(PruJudgeMa, EdgeAtAWrongTime_IsTold) {
  const auto moved = [](unsigned at, Time by) {
    return spoiled([=](Trace& ma, Edge edge, unsigned number) {
      ma.edge(edge.at + (number == at ? by : 0), edge.level);
    });
  };
  EXPECT_EQ(complaints_of(moved(11, 5 * kNs)), Complaints{"edge 11 of MA is 5 ns late"});
  EXPECT_EQ(complaints_of(moved(30, -5 * kNs)), Complaints{"edge 30 of MA is -5 ns late"});
  EXPECT_EQ(complaints_of(moved(0, 5 * kNs)), Complaints{"edge 0 of MA is 5 ns late"});
}

TEST(PruJudgeMa, WrongLevelAfterTheFrame_IsTold) {
  const auto cdm_of_1 = spoiled([](Trace& ma, Edge edge, unsigned number) {
    if (number < 49) ma.edge(edge.at, edge.level);  // 2 x 25 edges, without the last
  });
  EXPECT_EQ(complaints_of(cdm_of_1),
            (Complaints{"MA has 24 rising edges, not 25", "MA rests at 0"}));
}

// MA that rests at 0 is high for half a period before it falls for the next frame.
TEST(PruJudgeMa, ShortHighBeforeTheFrame_IsTold) {
  Bench bench;
  bench.start(12, 8, 5);
  bench.judge.write(kCtrlWord, 0xC0000000);
  for (unsigned i = 0; i < 16; ++i) bench.frame({0, false, word(1, 12)});
  ASSERT_TRUE(bench.judge.control().started());
  EXPECT_EQ(bench.frame({0, false, word(1, 12)}).complaints, Complaints());
  spoiled([](Trace& ma, Edge edge, unsigned number) {
    ma.edge(edge.at + (number == 0 ? 10 * kNs : 0), edge.level);
  })(bench);
  EXPECT_EQ(bench.frame({0, false, word(1, 12)}).complaints,
            Complaints{"MA is high for 90 ns before the frame"});
}

// The presence test, and an edge of SL next to it.
TEST(PruJudgeMa, PresenceTest_DecidesWhetherMaMoves) {
  Judge judge{JudgeSetup{}};
  judge.write(kDataLength, 0x01080C);
  judge.write(kRun, 1);
  const Trace still(true);
  const Trace high(true);
  const Trace low(false);
  EXPECT_EQ(judge.frame({kUs, 2 * kUs, still, high, {}}).complaints,
            Complaints{"MA stays although SL was 1 before the frame"});
  EXPECT_EQ(judge.frame({kUs, 2 * kUs, still, low, {}}).complaints, Complaints());
  for (const Time apart : {-20, -5, 0, 5, 20}) {
    Trace sl(true);
    sl.edge(kUs + apart * kNs, false);
    EXPECT_EQ(judge.frame({kUs, 2 * kUs, still, sl, {}}).complaints, Complaints());
  }
  Trace late(true);
  late.edge(kUs + 25 * kNs, false);
  EXPECT_EQ(judge.frame({kUs, 2 * kUs, still, late, {}}).complaints.size(), 1U);
  Trace moves(true);
  moves.edge(kUs, false);
  moves.edge(kUs + 500 * kNs, true);
  EXPECT_EQ(judge.frame({kUs, 2 * kUs, moves, low, {}}).complaints.front(),
            "MA moves although SL was 0 before the frame");
}

// R-P10: OVERHEAD after the last sample, or after the trigger.
TEST(PruJudgeMa, Update_ComesOverheadAfterTheLastSample) {
  Judge judge{JudgeSetup{}};
  judge.write(kDataLength, 0x01080C);
  judge.write(kRun, 1);
  judge.write(kOverhead, 100);
  const Trace ma(true);
  const Trace sl(false);
  const auto updated = [&](Time at) {
    const FrameReport report = judge.frame({10 * kUs, 20 * kUs, ma, sl, at});
    EXPECT_EQ(report.update_due, 10'500 * kNs);
    return report.complaints;
  };
  EXPECT_EQ(updated(10'500 * kNs), Complaints());
  EXPECT_EQ(updated(10'540 * kNs), Complaints());
  EXPECT_EQ(updated(10'545 * kNs), Complaints{"the memory changes 45 ns after it is due"});
  EXPECT_EQ(updated(10'495 * kNs), Complaints{"the memory changes -5 ns after it is due"});
}

// The last sample: 180 ns after rising edge 2 SL falls, so the sixth sample of byte 1 is the bit,
// and the last of 20 bits comes 22 periods after it.
TEST(PruJudgeMa, LastSample_IsThatOfTheLastBit) {
  Bench bench;
  bench.start(12, 8, 1);
  bench.judge.write(kOverhead, 0);
  const FrameReport report = bench.frame({0, false, word(1, 12)});
  EXPECT_EQ(report.reading.last_sample, report.reading.rising_edge_1 + kUs + 750 * kNs + 22 * kUs);
  EXPECT_EQ(report.update_due, report.reading.last_sample);
}

}  // namespace
