// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/dsl/live_dsl.hpp"

#include <utility>

#include "sim/masters/dsl_model/frame_plan.hpp"

namespace mb4::sim {
namespace {

// An access takes 17 clocks of the core and 10 of the bus at most, and ends after WaitLimit, 1,024
// clocks of the bus, if the core stands.
constexpr unsigned kLongestDslAccess = 1100;
constexpr std::uint32_t kLastDslAddress = 0xFFF;

constexpr Pin kDslRst{0};
constexpr Pin kDslBusRst{1};
constexpr Pin kDslOut{2};
constexpr Pin kDslEn{3};
constexpr Pin kDslIn{4};
constexpr Pin kDslIrq{5};
constexpr Pin kDslLink{6};
constexpr Pin kDslSampleEdge{7};
constexpr Pin kDslReady{8};

constexpr std::pair<std::string_view, Pin> kDslPins[] = {{"rst_ni", kDslRst},
                                                         {"s_axi_aresetn", kDslBusRst},
                                                         {"dsl_out_o", kDslOut},
                                                         {"dsl_en_o", kDslEn},
                                                         {"dsl_in_i", kDslIn},
                                                         {"irq_o", kDslIrq},
                                                         {"link_o", kDslLink},
                                                         {"sample_edge_o", kDslSampleEdge},
                                                         {"position_ready_o", kDslReady}};

}  // namespace

DslHost::DslHost(HostPins& outside, DslRtl& model, Time period, unsigned most_clocks)
    : PollingWordHost(outside, model, period, most_clocks, kLastDslAddress), model_(model) {}

void DslHost::sampled(Time now) {
  edges_[next_] = {model_.cycles(), now};
  next_ = (next_ + 1) % edges_.size();
}

// The registers count from a few clocks behind the reset on, so an edge is found by its distance.
std::optional<Time> DslHost::edge_at(std::uint64_t clocks) const {
  constexpr std::uint64_t kNear = 100;
  for (const Edge& edge : edges_) {
    const std::uint64_t counted = edge.cycles - began_;
    if (edge.at != kNever && counted - clocks + kNear < 2 * kNear) return edge.at;
  }
  return std::nullopt;
}

std::optional<Time> DslHost::last_edge() const {
  const Edge& last = edges_[(next_ + edges_.size() - 1) % edges_.size()];
  return last.at == kNever ? std::nullopt : std::optional(last.at);
}

LiveDsl::LiveDsl(const MasterSetup& setup)
    : outside_(setup.outside),
      has_line_((setup.lines & MasterModel::of_line(0, DslRtl::kOut)) != 0),
      model_(make_dsl_rtl(setup.chip, setup.host.bus_hz, setup.seed, setup.plain)),
      host_(outside_, *model_, kPsPerSecond / setup.host.bus_hz + 1, kLongestDslAccess) {
  if (setup.trace != nullptr) model_->start_wave(*setup.trace);
}

void LiveDsl::power_on() {
  outside_.run_until(kResetLow);
  outside_.set_pin(kDslRst, true);
  outside_.set_pin(kDslBusRst, true);
}

bool LiveDsl::can_set(Pin pin) const {
  return pin == kDslRst || pin == kDslBusRst || (pin == kDslIn && !has_line_);
}

void LiveDsl::set_pin(Time now, Pin pin, bool level) {
  if (!can_set(pin)) return;
  if (pin == kDslRst) {
    core_runs_ = level;
    model_->set_core_reset(now, !level);
    if (level) host_.begin();
  } else if (pin == kDslBusRst) {
    bus_runs_ = level;
    model_->set_bus_reset(now, !level);
  } else {
    model_->set_inputs(now, 0, level ? 1 : 0);
  }
}

bool LiveDsl::pin(Pin pin) const {
  const auto output = [this](MasterModel::Outputs bit) { return (model_->outputs() & bit) != 0; };
  if (pin == kDslRst) return core_runs_;
  if (pin == kDslBusRst) return bus_runs_;
  if (pin == kDslOut) return output(MasterModel::of_line(0, DslRtl::kOut));
  if (pin == kDslEn) return output(MasterModel::of_line(0, DslRtl::kEnable));
  if (pin == kDslIn) return model_->in();
  if (pin == kDslIrq) return output(DslRtl::kIrq);
  if (pin == kDslLink) return output(DslRtl::kLink);
  return output(pin == kDslSampleEdge ? DslRtl::kSampleEdge : DslRtl::kReady);
}

void LiveDsl::own_outputs_changed(Time now, MasterModel::Outputs changed) {
  const MasterModel::Outputs rise = changed & model_->outputs();
  if ((rise & DslRtl::kSampleEdge) != 0) host_.sampled(now);
}

std::optional<Pin> dsl_pin_by_name(std::string_view name) { return find_pin(kDslPins, name); }

}  // namespace mb4::sim
