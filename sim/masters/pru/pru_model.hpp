// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The Verilated pru_core behind an interface without Verilator types.
#ifndef MB4SIM_PRU_MODEL_HPP_
#define MB4SIM_PRU_MODEL_HPP_

#include <cstdint>
#include <memory>

#include "sim/core/time.hpp"
#include "sim/core/trace_file.hpp"
#include "sim/hosts/word_access.hpp"
#include "sim/masters/chip_config.hpp"
#include "sim/masters/master_model.hpp"

namespace mb4::sim {

class PruModel : public MasterModel, public WordManager {
 public:
  // Bits of outputs() beside MA.
  static constexpr Outputs kIrq = own(0);       // pin irq_o
  static constexpr Outputs kAnswered = own(1);  // changes at the end of each access

  virtual void set_reset(Time now, bool active) = 0;
  virtual void set_trigger(Time now, bool level) = 0;
  virtual bool trigger() const = 0;
  virtual bool sl() const = 0;

  // A waveform of pins, registers and the encoder from now on. Throws TraceError if it cannot be
  // written.
  virtual void start_wave(const TraceFile& file) = 0;
  virtual void stop_wave() = 0;
};

// The model of ClockHz = chip.f_clk_hz, with its quirks. `plain`: no clock is left out.
std::unique_ptr<PruModel> make_pru_model(const ChipConfig& chip, std::uint64_t seed, bool plain);

}  // namespace mb4::sim

#endif  // MB4SIM_PRU_MODEL_HPP_
