// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/dsl_model/quality.hpp"

#include <algorithm>

namespace mb4::sim::dsl_model {
namespace {

struct Steps {
  int vsync_early;
  int vsync_missing;
  int rssi_low;
  int acceleration_error;
  int safe1_error;
  int lowest;  // at this value and below it the link begins again
};

constexpr Steps kSteps[] = {
    {-4, -8, -8, -1, -8, 0},   // document
    {-6, -4, -4, -2, -6, 0},   // sick
    {-4, -6, -4, -2, -6, -1},  // firmware
};
constexpr int kCodeError = -1;
constexpr int kSpecial = -2;
constexpr int kSafe2Error = -8;

}  // namespace

bool Quality::frame(const QualityEvents& events) {
  const Steps& steps = kSteps[static_cast<unsigned>(rules_)];
  int change = kSpecial * static_cast<int>(events.specials);
  const auto add = [&change](bool happened, int step) { change += happened ? step : 0; };
  add(events.vsync_early, steps.vsync_early);
  add(events.vsync_missing, steps.vsync_missing);
  add(events.vsync_good, 1);
  add(events.rssi_low, steps.rssi_low);
  add(events.parameter_error, kCodeError);
  add(events.pipeline_error, kCodeError);
  add(events.acceleration_error, steps.acceleration_error);
  add(events.safe1_error, steps.safe1_error);
  add(events.safe1_good, 1);
  add(events.safe2_error, kSafe2Error);
  value_ = std::min(value_ + change, kMost);
  return value_ > steps.lowest;
}

}  // namespace mb4::sim::dsl_model
