// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The iC-MB4 in a simulation: the chip with its pins, its reset and its hosts. Hosts by name:
// "spi", "spi2", "bus". The straps, which the scenario's interface has set, decide which of them
// the chip listens to: "spi" with CFGSPI = 1, "spi2" in addition with NWR_E = 0, "bus" with CFGSPI
// = 0.
#ifndef MB4SIM_LIVE_MB4_HPP_
#define MB4SIM_LIVE_MB4_HPP_

#include <array>
#include <memory>

#include "sim/hosts/parallel_host.hpp"
#include "sim/hosts/spi_host.hpp"
#include "sim/lines/clocked/clocked_end.hpp"
#include "sim/masters/live_master.hpp"
#include "sim/masters/mb4/hints/host_writes.hpp"
#include "sim/masters/mb4/hints/setup_watch.hpp"
#include "sim/masters/mb4/mb4_host_check.hpp"
#include "sim/masters/mb4/model/chip_model.hpp"

namespace mb4::sim {

class WatchedChip;

class LiveMb4 final : public LiveMaster {
 public:
  explicit LiveMb4(const MasterSetup& setup);
  ~LiveMb4() override;

  MasterModel& model() override { return *chip_; }
  // NRES is low for 500 ns (E08: at least 250 ns).
  void power_on() override;

  // False for output pins, SL of a channel that the scenario has, and CLK if it is connected. With
  // CFGIF = 10 or 11 channel 1 also drives SL2_NSL1 with the inverse of SL1, unless the scenario
  // has channel 2.
  bool can_set(Pin pin) const override;
  // At NER false pulls the pin low and true leaves it to the pull-up.
  void set_pin(Time now, Pin pin, bool level) override;
  bool pin(Pin pin) const override;
  void own_outputs_changed(Time now, MasterModel::Outputs changed) override;
  void set_observer(PinObserver* observer) override;
  void start_trace(const TraceFile& file) override;
  void stop_trace() override;

  HostModel* host(std::string_view name) override;
  HostCheck& host_check() override { return host_check_; }
  std::vector<Hint> hints(std::span<const HintLine> lines, std::uint64_t missed) override;
  void abort_transfer(std::uint64_t bits) override { spi_.abort_next(bits); }

 private:
  bool has_line(unsigned line) const { return (lines_ & MasterModel::of_line(line, kMaPin)) != 0; }
  bool drives_pair() const { return chip_->paired() && has_line(0) && !has_line(1); }
  bool input(Pin pin) const;
  void drive(Time now, Pin pin, bool level);

  HostPins& outside_;
  const ChipConfig& config_;
  HostInterface interface_;
  MasterModel::Outputs lines_;
  bool clk_connected_;
  SpiHost spi_;
  SpiHost spi2_;
  ParallelHost bus_;
  Mb4HostCheck host_check_;
  HostWrites writes_;
  SetupWatch setup_;
  std::unique_ptr<ChipModel> chip_;
  WatchedChip* watched_ = nullptr;  // chip_ while start_trace() writes a waveform
  PinObserver* observer_ = nullptr;
  bool clk_by_hand_ = false;       // pin CLK, which is not connected
  bool ner_pulled_ = false;        // by something outside
  std::array<bool, 32> levels_{};  // of input pins but SL, index is Pin
};

}  // namespace mb4::sim

#endif  // MB4SIM_LIVE_MB4_HPP_
