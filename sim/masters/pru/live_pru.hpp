// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// biss_pru in a simulation. Its host by name: "axi".
#ifndef MB4SIM_LIVE_PRU_HPP_
#define MB4SIM_LIVE_PRU_HPP_

#include <memory>
#include <optional>
#include <string_view>

#include "sim/hosts/host_pins.hpp"
#include "sim/hosts/word_access.hpp"
#include "sim/masters/live_master.hpp"
#include "sim/masters/pru/pru_model.hpp"

namespace mb4::sim {

class LivePru final : public LiveMaster {
 public:
  explicit LivePru(const MasterSetup& setup);

  MasterModel& model() override { return *model_; }
  // rst_ni is low for 500 ns.
  void power_on() override;

  bool can_set(Pin pin) const override;
  void set_pin(Time now, Pin pin, bool level) override;
  bool pin(Pin pin) const override;

  void start_trace(const TraceFile& file) override { model_->start_wave(file); }
  void stop_trace() override { model_->stop_wave(); }

  HostModel* host(std::string_view name) override { return name == "axi" ? &host_ : nullptr; }

 private:
  HostPins& outside_;
  bool has_line_;
  std::unique_ptr<PruModel> model_;
  PollingWordHost host_;
  bool rst_n_ = false;
};

// Pins by the names of biss_pru.
std::optional<Pin> pru_pin_by_name(std::string_view name);

}  // namespace mb4::sim

#endif  // MB4SIM_LIVE_PRU_HPP_
