// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The Verilated dsl_bus behind an interface without Verilator types.
#ifndef MB4SIM_DSL_DSL_RTL_HPP_
#define MB4SIM_DSL_DSL_RTL_HPP_

#include <cstdint>
#include <memory>

#include "sim/core/time.hpp"
#include "sim/core/trace_file.hpp"
#include "sim/hosts/word_access.hpp"
#include "sim/masters/chip_config.hpp"
#include "sim/masters/master_model.hpp"

namespace mb4::sim {

// The core has the clock f_clk_hz, the bus the clock bus_hz. Both begin at time 0: with the same
// frequency they are one clock.
class DslRtl : public MasterModel, public WordManager {
 public:
  // Bits of the line: level to send, driver on (sim/lines/duplex/).
  static constexpr unsigned kOut = 1;
  static constexpr unsigned kEnable = 2;
  // Bits of outputs() beside the line.
  static constexpr Outputs kIrq = own(0);
  static constexpr Outputs kLink = own(1);
  static constexpr Outputs kSampleEdge = own(2);
  static constexpr Outputs kReady = own(3);     // pin position_ready_o
  static constexpr Outputs kAnswered = own(4);  // changes at the end of each access

  // Levels of pins. The bus has its own reset.
  virtual void set_core_reset(Time now, bool active) = 0;
  virtual void set_bus_reset(Time now, bool active) = 0;
  virtual bool in() const = 0;

  // A waveform of pins, registers and the encoder from now on. Throws TraceError if it cannot be
  // written.
  virtual void start_wave(const TraceFile& file) = 0;
  virtual void stop_wave() = 0;
};

// On return both resets are active, and the line is 1. `plain`: every edge computes the whole
// model.
std::unique_ptr<DslRtl> make_dsl_rtl(const ChipConfig& chip, std::uint64_t bus_hz,
                                     std::uint64_t seed, bool plain);

}  // namespace mb4::sim

#endif  // MB4SIM_DSL_DSL_RTL_HPP_
