// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The BiSS C master with N channels in a simulation. Its hosts by name: "axi", or "spi" and
// "words", which sends words as frames of "spi".
#ifndef MB4SIM_LIVE_AXI_HPP_
#define MB4SIM_LIVE_AXI_HPP_

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "sim/hosts/host_pins.hpp"
#include "sim/hosts/spi_host.hpp"
#include "sim/hosts/word_access.hpp"
#include "sim/hosts/word_host.hpp"
#include "sim/masters/axi/axi_hints.hpp"
#include "sim/masters/axi/axi_model.hpp"
#include "sim/masters/live_master.hpp"

namespace mb4::sim {

// A manager of AXI4-Lite and the sink of the stream.
class AxiHost final : public PollingWordHost, public StreamSink {
 public:
  // No answer within 1000 clocks of `period` is none.
  AxiHost(HostPins& outside, AxiModel& model, Time period)
      : PollingWordHost(outside, model, period, 1000, 0xFF), model_(model) {}

  using PollingWordHost::read;
  std::optional<std::uint8_t> write(std::uint32_t address, std::uint32_t data,
                                    std::uint8_t strobe) override {
    setup_.written(address, data, strobe);
    return PollingWordHost::write(address, data, strobe);
  }
  // Writes all four bytes.
  std::optional<std::uint8_t> write(std::uint32_t address, std::uint32_t data) {
    return write(address, data, 0xF);
  }
  StreamSink* stream() override { return this; }
  // For callers that know that the clock runs: the value, or 0 without an answer.
  std::uint32_t read(std::uint32_t address);

  // The oldest beat of the stream that has not been read. A sink that is always ready has taken it.
  std::optional<StreamBeat> next_beat() override;
  std::size_t beats_waiting() const { return model_.beats().size(); }

  AxiSetup& setup() { return setup_; }

 private:
  AxiModel& model_;
  AxiSetup setup_;
};

// Words as frames of SPI (docs/axi.md, "biss_spi").
class AxiSpiWords final : public WordHost {
 public:
  AxiSpiWords(SpiHost& spi, AxiSetup& setup) : spi_(spi), setup_(setup) {}

  // kNotTaken: the answer of the frame does not say that it was understood. The frame writes all
  // four bytes; another strobe is kNotTaken, and nothing is sent.
  std::optional<std::uint8_t> write(std::uint32_t address, std::uint32_t data,
                                    std::uint8_t strobe) override;
  std::optional<std::uint8_t> read(std::uint32_t address, std::uint32_t& data) override;
  std::uint32_t last_address() const override { return 0xFF; }

  static constexpr std::uint8_t kNotTaken = 2;

 private:
  std::uint8_t exchange(std::uint8_t opcode, std::uint32_t address, std::uint32_t& data);

  SpiHost& spi_;
  AxiSetup& setup_;
};

class LiveAxi final : public LiveMaster {
 public:
  explicit LiveAxi(const MasterSetup& setup);

  MasterModel& model() override { return *model_; }
  // axi_aresetn and por_n are low for 500 ns.
  void power_on() override;

  bool can_set(Pin pin) const override;
  void set_pin(Time now, Pin pin, bool level) override;
  bool pin(Pin pin) const override;

  void start_trace(const TraceFile& file) override { model_->start_wave(file); }
  void stop_trace() override { model_->stop_wave(); }

  HostModel* host(std::string_view name) override;
  std::vector<Hint> hints(std::span<const HintLine> lines, std::uint64_t missed) override {
    return host_.setup().hints(config_, lines, missed);
  }

 private:
  HostPins& outside_;
  const ChipConfig& config_;
  MasterModel::Outputs lines_;
  std::unique_ptr<AxiModel> model_;
  AxiHost host_;
  bool behind_spi_;
  SpiHost spi_;
  AxiSpiWords words_;
  bool aresetn_ = false;
  bool por_n_ = false;
};

// Pins by the document's names; those of SPI are ncs, sclk, mosi, miso; ma0 to ma15 and slo0 to
// slo15 are the lines.
std::optional<Pin> axi_pin_by_name(std::string_view name);

}  // namespace mb4::sim

#endif  // MB4SIM_LIVE_AXI_HPP_
