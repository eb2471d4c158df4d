// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// dsl_bus in a simulation. Its host by name: "axi".
#ifndef MB4SIM_DSL_LIVE_DSL_HPP_
#define MB4SIM_DSL_LIVE_DSL_HPP_

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "sim/hosts/host_pins.hpp"
#include "sim/hosts/word_access.hpp"
#include "sim/masters/dsl/dsl_rtl.hpp"
#include "sim/masters/live_master.hpp"

namespace mb4::sim {

// The host on the bus. It also knows when the master has asked for the last positions.
class DslHost final : public PollingWordHost {
 public:
  DslHost(HostPins& outside, DslRtl& model, Time period, unsigned most_clocks);

  // An edge in SAMPLE has left the master.
  void sampled(Time now);
  // The reset has ended: registers count clocks from here on.
  void begin() { began_ = model_.cycles(); }
  // The edge whose time in the registers is `clocks`. Nothing if it is none of the last few.
  std::optional<Time> edge_at(std::uint64_t clocks) const;
  std::optional<Time> last_edge() const;

 private:
  struct Edge {
    std::uint64_t cycles = 0;
    Time at = kNever;
  };

  DslRtl& model_;
  std::uint64_t began_ = 0;
  std::array<Edge, 8> edges_{};
  std::size_t next_ = 0;
};

class LiveDsl final : public LiveMaster {
 public:
  explicit LiveDsl(const MasterSetup& setup);

  MasterModel& model() override { return *model_; }
  // rst_ni and s_axi_aresetn are low for 500 ns.
  void power_on() override;

  bool can_set(Pin pin) const override;
  void set_pin(Time now, Pin pin, bool level) override;
  bool pin(Pin pin) const override;
  void own_outputs_changed(Time now, MasterModel::Outputs changed) override;

  void start_trace(const TraceFile& file) override { model_->start_wave(file); }
  void stop_trace() override { model_->stop_wave(); }

  HostModel* host(std::string_view name) override { return name == "axi" ? &host_ : nullptr; }

 private:
  HostPins& outside_;
  bool has_line_;
  std::unique_ptr<DslRtl> model_;
  DslHost host_;
  bool core_runs_ = false;  // rst_ni
  bool bus_runs_ = false;   // s_axi_aresetn
};

// Pins by the names of dsl_axil.
std::optional<Pin> dsl_pin_by_name(std::string_view name);

}  // namespace mb4::sim

#endif  // MB4SIM_DSL_LIVE_DSL_HPP_
