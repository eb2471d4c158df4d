// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The Verilated BiSS C master with N channels behind an interface without Verilator types.
#ifndef MB4SIM_AXI_MODEL_HPP_
#define MB4SIM_AXI_MODEL_HPP_

#include <cstdint>
#include <deque>
#include <memory>

#include "sim/core/time.hpp"
#include "sim/core/trace_file.hpp"
#include "sim/hosts/word_access.hpp"
#include "sim/hosts/word_host.hpp"
#include "sim/masters/chip_config.hpp"
#include "sim/masters/master_model.hpp"

namespace mb4::sim {

inline constexpr unsigned kAxiChannels = 16;

// ChipConfig::features: what the document has, all extras but FRAME_SAMPLER, all extras (EXTRAS of
// biss_axi).
inline constexpr unsigned kAxiDocument = 0;
inline constexpr unsigned kAxiFull = 1;
inline constexpr unsigned kAxiFrames = 2;
// ChipConfig::quirks: bits of axi_pkg::switch_t, and above them POR_PIN; parameters of biss_axi.
inline constexpr unsigned kAxiValidUntilRequest = 1;
inline constexpr unsigned kAxiAlignLatch = 2;
inline constexpr unsigned kAxiCrcBitIgnores = 4;
inline constexpr unsigned kAxiEnableActiveLow = 8;
inline constexpr unsigned kAxiSwitches = 15;
inline constexpr unsigned kAxiPorPin = 16;

// Levels at the inputs of biss_spi.
struct SpiLevels {
  bool ncs = true;
  bool sclk = false;
  bool mosi = false;
};

class AxiModel : public MasterModel, public WordManager {
 public:
  // Bits of outputs() beside MA.
  static constexpr Outputs kError = own(0);      // pin error is 1
  static constexpr Outputs kWarn = own(1);       // pin warn is 1
  static constexpr Outputs kSampleClk = own(2);  // pin sample_clk_output
  static constexpr Outputs kDone = own(3);       // changes at the end of each access
  static constexpr Outputs kBeat = own(4);       // changes with each beat of the stream
  static constexpr Outputs kIrq = own(5);        // pin irq
  static constexpr Outputs kMiso = own(6);       // behind SPI: pin miso

  // Number of channels that the model has: at least those of the scenario.
  virtual unsigned channels() const = 0;

  // Pins axi_aresetn and por_n. The second counts only with kAxiPorPin.
  virtual void set_reset(Time now, bool active) = 0;
  virtual void set_power_on_reset(Time now, bool active) = 0;
  virtual void set_ext_sample_clk(Time now, bool level) = 0;
  virtual void set_sample_en(Time now, bool level) = 0;
  virtual bool ext_sample_clk() const = 0;
  virtual bool sample_en() const = 0;
  virtual bool slo(unsigned line) const = 0;
  // The pins of SPI; they count in a model of make_axi_spi_model() only.
  virtual void set_spi(Time now, const SpiLevels& levels) = 0;
  virtual SpiLevels spi() const = 0;

  // A waveform of pins, registers and encoders from now on. Throws TraceError if it cannot be
  // written.
  virtual void start_wave(const TraceFile& file) = 0;
  virtual void stop_wave() = 0;

  // Beats of the stream in mode 0 that the sink has taken: a word for each channel of the model
  // (with extras two, the lower first), and in `user` bit c: the word of channel c is of this
  // frame and good. The oldest ones are dropped when there are too many.
  std::deque<StreamBeat>& beats() { return beats_; }
  std::uint64_t beats_dropped() const { return beats_dropped_; }

 protected:
  static constexpr std::size_t kMostBeats = 65'536;

  std::deque<StreamBeat> beats_;
  std::uint64_t beats_dropped_ = 0;
};

// `channels`: as many as the scenario needs. Of the models that are built (1, 4, 16 channels, each
// as the document, as the document with ALIGN_LATCH, with all extras but FRAME_SAMPLER, and with
// all) the smallest one that is
// enough is made. `plain`: each edge is evaluated in the simplest way.
std::unique_ptr<AxiModel> make_axi_model(const ChipConfig& chip, unsigned channels,
                                         std::uint64_t seed, bool plain);

// The same behind SPI: 1 or 4 channels as the document, 4 with extras.
inline constexpr unsigned kAxiSpiChannels = 4;
std::unique_ptr<AxiModel> make_axi_spi_model(const ChipConfig& chip, unsigned channels,
                                             std::uint64_t seed, bool plain);

}  // namespace mb4::sim

#endif  // MB4SIM_AXI_MODEL_HPP_
