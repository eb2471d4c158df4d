// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The request of automatic frames alone: pages 30 to 32, Tables 37, 44; decision 19.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "Vmb4_frame_request.h"
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace at = mb4test::places::mb4_pkg::request_t;

class Requests : public mb4test::Block<Vmb4_frame_request> {
 public:
  explicit Requests(unsigned freqags) {
    model.ags_i = model.restart_i = model.hold_cdm_i = model.getsens_i = 0;
    model.busy_i = model.taken_i = 0;
    model.lines_idle_i = 1;
    model.freqags_i = static_cast<std::uint8_t>(freqags);
    reset();
  }
  bool due() const { return at::kDue.of(model.request_o) != 0; }
  bool asks() const { return at::kAsks.of(model.request_o) != 0; }
  bool agsmin() const { return at::kAgsmin.of(model.request_o) != 0; }
  bool infinite() const { return at::kInfinite.of(model.request_o) != 0; }
  // The clocks, counted from 1, that end with a request; each request is taken in the next clock.
  std::vector<unsigned> run(unsigned clocks) {
    std::vector<unsigned> times;
    for (unsigned i = 1; i <= clocks; ++i) {
      clock();
      model.taken_i = 0;
      model.eval();
      if (!due()) continue;
      times.push_back(i);
      model.taken_i = 1;
    }
    return times;
  }
};

// Table 37: clocks from frame to frame; 0 where the code has no rate.
unsigned period_of(unsigned code) {
  if (code <= 0x7B) return 20 * (code + 1);
  return code >= 0x80 ? 625 * (code - 127) : 0;
}

TEST(FrameRequestBlock, FastAndSlowRates_OneRequestAPeriodFromAgsOn) {
  // Only some of the slow codes, because they take long.
  for (unsigned code = 0; code < 256; code += code < 0x80 || code == 0xFE ? 1 : 7) {
    const unsigned period = period_of(code);
    if (period == 0) continue;
    Requests requests(code);
    EXPECT_TRUE(requests.run(50).empty()) << "AGS = 0";
    requests.model.ags_i = 1;
    EXPECT_EQ(requests.run(3 * period), (std::vector<unsigned>{period, 2 * period, 3 * period}))
        << "FREQAGS " << code;
    EXPECT_FALSE(requests.agsmin());
    EXPECT_FALSE(requests.infinite());
  }
}

// Table 44: with AGSMIN the next frame follows the one before; AGSINFINITE waits for pin GETSENS.
TEST(FrameRequestBlock, CodesWithoutRate_AgsminAlwaysAndAgsinfiniteNever) {
  Requests least(0x7C);
  EXPECT_TRUE(least.agsmin());
  least.model.eval();
  EXPECT_FALSE(least.due());
  least.model.ags_i = 1;
  EXPECT_EQ(least.run(10).size(), 10U);
  for (const unsigned code : {0x7DU, 0x7EU, 0x7FU}) {
    Requests infinite(code);
    infinite.model.ags_i = 1;
    EXPECT_TRUE(infinite.run(5000).empty()) << code;
    EXPECT_TRUE(infinite.infinite()) << code;
  }
}

// Page 34: a frame that is due while another one runs is left out; the times of the rest stay.
TEST(FrameRequestBlock, DueInARunningFrame_IsToldAndLeftOut) {
  Requests requests(1);  // 40 clocks
  requests.model.ags_i = 1;
  requests.run(39);
  requests.model.busy_i = 1;
  requests.model.eval();
  EXPECT_EQ(requests.model.missed_o, 1);
  EXPECT_TRUE(requests.run(1).empty());
  EXPECT_EQ(requests.model.missed_o, 0);
  requests.run(10);
  requests.model.busy_i = 0;
  EXPECT_EQ(requests.run(70), (std::vector<unsigned>{30, 70}));
}

TEST(FrameRequestBlock, Break_TimesBeginAgain) {
  Requests requests(1);
  requests.model.ags_i = 1;
  requests.run(39);
  requests.model.restart_i = 1;
  EXPECT_TRUE(requests.run(1).empty());
  requests.model.restart_i = 0;
  EXPECT_EQ(requests.run(80), (std::vector<unsigned>{40, 80}));
}

// Page 31: two clocks from the pin to the start. A high level that stays starts the next frame if
// HOLDCDM = 0; with HOLDCDM = 1 each pulse gives one frame.
TEST(FrameRequestBlock, Getsens_StartsAfterTwoClocksAndByHoldcdmOnceOrAgain) {
  for (const bool hold : {false, true}) {
    Requests requests(0x7F);
    requests.model.ags_i = 1;
    requests.model.hold_cdm_i = hold;
    requests.run(5);
    for (int pulse = 0; pulse < 3; ++pulse) {
      requests.model.getsens_i = 1;
      EXPECT_TRUE(requests.run(1).empty());
      const std::vector<unsigned> times = requests.run(9);
      ASSERT_FALSE(times.empty());
      EXPECT_EQ(times.front(), 1U);
      EXPECT_EQ(times.size(), hold ? 1U : 9U);
      requests.model.getsens_i = 0;
      requests.run(5);
    }
    requests.model.getsens_i = 1;
    requests.model.lines_idle_i = 0;
    EXPECT_TRUE(requests.run(20).empty()) << "lines at work";
    EXPECT_TRUE(requests.asks());  // it would be due, if the lines were idle
  }
}

}  // namespace
