// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include "masters/dsl/dsl_readings.hpp"
#include "sim/masters/dsl_model/dsl_master.hpp"

namespace mb4::tool {
namespace {

using sim::dsl_model::Link;
using sim::dsl_model::LinkFrame;
using sim::dsl_model::LinkHost;
using sim::dsl_model::Restart;

class ModelReadings final : public DslReadings {
 public:
  explicit ModelReadings(sim::Simulator& simulator)
      : simulator_(simulator), host_(simulator.host<LinkHost>("none")) {}

  std::optional<DslReading> next(sim::Time limit) override {
    simulator_.run_while_waiting([this] { return host_.any(); }, limit);
    const auto frame = host_.take();
    if (!frame) return std::nullopt;
    DslReading out;
    out.number = frame->number;
    out.sampled = host_.model().time_of(frame->sampled);
    out.acceleration_good = frame->acceleration_good;
    out.lost = frame->lost;
    out.position = frame->position;
    out.speed = frame->speed;
    out.quality = frame->quality;
    out.delay = frame->delay;
    out.safe_new = frame->safe_new;
    out.safe1 = frame->safe1;
    out.safe2 = frame->safe2;
    if (frame->restart != Restart::kNone) out.restart = sim::dsl_model::name_of(frame->restart);
    return out;
  }

  std::uint64_t restarts() override { return link().restarts(); }
  std::string state() override {
    return fmt::format("state {}, {} restarts, the last one: {}",
                       sim::dsl_model::name_of(link().state()), link().restarts(),
                       sim::dsl_model::name_of(link().last_restart()));
  }
  std::uint32_t identity() const override { return host_.model().link().identity(); }

 private:
  Link& link() { return host_.model().link(); }

  sim::Simulator& simulator_;
  LinkHost& host_;
};

}  // namespace

std::unique_ptr<DslReadings> readings_of_model(sim::Simulator& simulator) {
  return std::make_unique<ModelReadings>(simulator);
}

}  // namespace mb4::tool
