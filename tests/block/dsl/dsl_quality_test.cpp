// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The quality monitor against the one of the model: frames with random events, three rules.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "Vdsl_quality.h"
#include "sim/masters/dsl_model/quality.hpp"
#include "tests/support/model_context.hpp"

namespace {

using namespace mb4::sim::dsl_model;

// dsl_pkg::event_e.
enum Event : std::uint8_t {
  kGood,
  kVsyncEarly,
  kVsyncMissing,
  kRssiLow,
  kCodeError,
  kAcceleration,
  kSpecial,
  kSafe1Error,
  kSafe2Error
};

std::vector<Event> list_of(const QualityEvents& events) {
  std::vector<Event> list(events.specials, kSpecial);
  const auto add = [&list](bool happened, Event event) {
    if (happened) list.push_back(event);
  };
  add(events.vsync_early, kVsyncEarly);
  add(events.vsync_missing, kVsyncMissing);
  add(events.vsync_good, kGood);
  add(events.rssi_low, kRssiLow);
  add(events.parameter_error, kCodeError);
  add(events.pipeline_error, kCodeError);
  add(events.acceleration_error, kAcceleration);
  add(events.safe1_error, kSafe1Error);
  add(events.safe1_good, kGood);
  add(events.safe2_error, kSafe2Error);
  return list;
}

TEST(DslQualityBlock, FramesAtRandom_AreThoseOfTheModel) {
  mb4test::Dice random;
  mb4test::Block<Vdsl_quality> block;
  auto& m = block.model;
  m.rules_i = m.start_i = m.add_i = m.event_i = m.end_i = 0;
  block.reset();
  unsigned ended = 0;
  for (const auto rules : {QualityRules::kDocument, QualityRules::kSick, QualityRules::kFirmware}) {
    SCOPED_TRACE(testing::Message() << "rules " << static_cast<int>(rules));
    m.rules_i = static_cast<std::uint8_t>(rules);
    Quality quality(rules);
    bool linked = false;
    for (unsigned frame = 0; frame < 30'000; ++frame) {
      if (!linked) {
        quality.start();
        m.start_i = 1;
        block.clock();
        m.start_i = 0;
        ASSERT_EQ(m.value_o, 8);
      }
      const auto dice = [&random](unsigned among) { return random.below(among) == 0; };
      const unsigned rare = 3 + random.below(60);
      QualityEvents events;
      events.vsync_early = dice(rare);
      events.vsync_missing = !events.vsync_early && dice(rare);
      events.vsync_good = !events.vsync_missing && dice(3);
      events.rssi_low = dice(rare);
      events.parameter_error = dice(rare);
      events.pipeline_error = dice(rare);
      events.acceleration_error = dice(rare);
      events.specials = dice(rare) ? random.below(6) : 0;
      events.safe1_error = dice(rare);
      events.safe1_good = dice(3);
      events.safe2_error = dice(rare);
      for (const Event event : list_of(events)) {
        m.add_i = 1;
        m.event_i = event;
        block.clock();
        m.add_i = 0;
        if (dice(2)) block.clock();
      }
      linked = quality.frame(events);
      m.end_i = 1;
      m.eval();
      ASSERT_EQ(m.good_o, linked) << "frame " << frame;
      block.clock();
      m.end_i = 0;
      ASSERT_EQ(m.value_o, quality.value()) << "frame " << frame;
      ASSERT_EQ(m.low_o, quality.low()) << "frame " << frame;
      ended += linked ? 0 : 1;
    }
  }
  EXPECT_GT(ended, 1000U);
}

}  // namespace
