// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// How much the edges of the answer may be away from their places: duty and jitter, in the first,
// two middle and the tenth slot, at 32 phases of a quarter tick. A start of a link is good if it
// links at once and stays without an error. The suite makes 2 starts of 200 frames at each point,
// the nightly run as many as MB4_DSL_STARTS says.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/unit/dsl/dsl_bench.hpp"

namespace {

using namespace mb4::sim;
using namespace mb4::sim::dsl_test;
using dsl_model::SampleRule;

constexpr double kTickPs = 1e12 / 75e6;
constexpr double kBitPs = 8 * kTickPs;
constexpr unsigned kPhases = 32;

unsigned starts() {
  const char* text = std::getenv("MB4_DSL_STARTS");
  return text == nullptr ? 2 : static_cast<unsigned>(std::strtoul(text, nullptr, 10));
}

struct Edges {
  double duty = 0;    // each edge moves by this part of a bit, the falling ones late
  double jitter = 0;  // peak to peak, parts of a bit
};

// Failed starts at one point. The first edge of the answer lies `phase` quarter ticks behind the
// begin of the slot.
unsigned failures(SampleRule rule, unsigned slot, unsigned phase, const Edges& edges) {
  unsigned failed = 0;
  for (unsigned i = 0; i < starts(); ++i) {
    BenchSetup setup;
    setup.rules.sample = rule;
    setup.cable.in.jitter = static_cast<Time>(edges.jitter * kBitPs);
    setup.cable.in.skew = static_cast<std::int64_t>(2 * edges.duty * kBitPs);
    // Slot 0 begins 5 ticks behind the begin of SWITCH, which lasts 8.
    const double first_edge = (8.0 * slot + phase / 4.0 + 5 - 8) * kTickPs;
    setup.encoder.latency = static_cast<Time>(first_edge + 0.5);
    setup.encoder.source.constant = 0x12345678;
    setup.seed = 1 + i + 1000 * phase;
    Bench bench(setup);
    RandomMotion motion(bench.encoder(), setup.seed);
    bool good = true;
    bench.on_frame = [&](const LinkFrame& frame) {
      if (frame.number == 0) return;
      const auto& words = frame.words;
      const bool error = words.vertical.error || words.parameter.error || words.pipeline.error ||
                         words.acceleration_high.error || words.acceleration_low.error ||
                         words.secondary.error || !frame.acceleration_good;
      if (error ||
          (frame.number > 32 && (frame.lost || frame.position != bench.encoder().sent_word()))) {
        good = false;
      }
    };
    const Time limit = 300 * kFrameTime;
    good = bench.run_frames(200, limit) && good && bench.link().restarts() == 0;
    failed += good ? 0U : 1U;
  }
  return failed;
}

void expect_none(SampleRule rule, std::initializer_list<unsigned> slots, const Edges& edges) {
  for (const unsigned slot : slots) {
    for (unsigned phase = 0; phase < kPhases; ++phase) {
      EXPECT_EQ(failures(rule, slot, phase, edges), 0U)
          << "slot " << slot << " phase " << phase << " duty " << edges.duty << " jitter "
          << edges.jitter;
    }
  }
}

TEST(DslRobust, PublishedRule_TakesDutyAndJitter) {
  expect_none(SampleRule::kPublished, {1, 5, 9}, {.duty = 0.05});
  expect_none(SampleRule::kPublished, {1, 5, 9}, {.duty = -0.05});
  expect_none(SampleRule::kPublished, {1, 5, 9}, {.jitter = 0.12});
}

// Slot 10: no room for four ones and more (F5). Counted, not judged.
TEST(DslRobust, PublishedRuleInSlot10_IsCounted) {
  unsigned sum = 0;
  for (const Edges edges : {Edges{.duty = 0.05}, Edges{.duty = -0.05}, Edges{.jitter = 0.12}}) {
    std::string line;
    unsigned all = 0;
    for (unsigned phase = 0; phase < kPhases; ++phase) {
      const unsigned failed = failures(SampleRule::kPublished, 10, phase, edges);
      line += " " + std::to_string(failed);
      all += failed;
    }
    std::printf(
        "published rule, slot 10, duty %+.0f %%, jitter %.0f %%, failed starts of %u by phase:%s\n",
        100 * edges.duty, 100 * edges.jitter, starts(), line.c_str());
    sum += all;
    EXPECT_LT(all, kPhases * starts() / 4);
  }
  EXPECT_GT(sum, 0U);  // where seven ones stand before the edge nothing is left
}

TEST(DslRobust, FirstZero_TakesDutyAndJitter) {
  expect_none(SampleRule::kFirstZero, {1, 5, 9, 10}, {.duty = 0.18});
  expect_none(SampleRule::kFirstZero, {1, 5, 9, 10}, {.duty = -0.18});
  expect_none(SampleRule::kFirstZero, {1, 5, 9, 10}, {.jitter = 0.35});
}

TEST(DslRobust, Tracking_TakesHalfABitOfJitter) {
  expect_none(SampleRule::kTracking, {1, 5, 9, 10}, {.jitter = 0.50});
  expect_none(SampleRule::kTracking, {1, 5, 9, 10}, {.duty = 0.18});
  expect_none(SampleRule::kTracking, {1, 5, 9, 10}, {.duty = -0.18});
}

}  // namespace
