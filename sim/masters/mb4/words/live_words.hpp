// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The iC-MB4 on a bus of words in a simulation: mb4_axil or mb4_wb. Its host has the name of the
// interface, "axi" or "wb".
//
// Pins: NRES, GETSENS, NER, SL1, SL2 are inputs; CLK, EOT, MA1, MA2, MO1, MO2, IRQ, CLKENI can be
// read. The other pins of the chip do not exist here: they read 0.
#ifndef MB4SIM_LIVE_WORDS_HPP_
#define MB4SIM_LIVE_WORDS_HPP_

#include <memory>
#include <string_view>

#include "sim/hosts/word_access.hpp"
#include "sim/lines/clocked/clocked_end.hpp"
#include "sim/masters/live_master.hpp"
#include "sim/masters/mb4/hints/setup_watch.hpp"
#include "sim/masters/mb4/pins.hpp"
#include "sim/masters/mb4/words/bus_model.hpp"

namespace mb4::sim {

class LiveWords final : public LiveMaster {
 public:
  // Throws TraceError: there is no waveform.
  explicit LiveWords(const MasterSetup& setup);

  MasterModel& model() override { return *model_; }
  // NRES is low for 500 ns.
  void power_on() override;

  bool can_set(Pin pin) const override;
  void set_pin(Time now, Pin pin, bool level) override;
  bool pin(Pin pin) const override;
  void own_outputs_changed(Time now, MasterModel::Outputs changed) override;

  HostModel* host(std::string_view name) override { return name == interface_ ? &host_ : nullptr; }
  std::vector<Hint> hints(std::span<const HintLine> lines, std::uint64_t missed) override;

 private:
  // The registers of the chip are the first bytes of the bus.
  class Host final : public PollingWordHost {
   public:
    using PollingWordHost::PollingWordHost;
    std::optional<std::uint8_t> write(std::uint32_t address, std::uint32_t data,
                                      std::uint8_t strobe) override;
    SetupWatch setup;
  };

  bool has_line(unsigned line) const { return (lines_ & MasterModel::of_line(line, kMaPin)) != 0; }

  HostPins& outside_;
  const ChipConfig& config_;
  std::string_view interface_;
  MasterModel::Outputs lines_;
  std::unique_ptr<BusModel> model_;
  Host host_;
  bool nres_ = false;
  bool getsens_ = false;
  bool ner_pulled_ = false;  // by something outside
};

}  // namespace mb4::sim

#endif  // MB4SIM_LIVE_WORDS_HPP_
