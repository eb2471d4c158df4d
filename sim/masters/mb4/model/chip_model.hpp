// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The Verilated chip behind an interface without Verilator types.
#ifndef MB4SIM_MB4_CHIP_MODEL_HPP_
#define MB4SIM_MB4_CHIP_MODEL_HPP_

#include <cstdint>
#include <memory>
#include <optional>

#include "sim/core/time.hpp"
#include "sim/core/trace_file.hpp"
#include "sim/lines/clocked/clocked_end.hpp"
#include "sim/masters/chip_config.hpp"
#include "sim/masters/master_model.hpp"
#include "sim/masters/mb4/pins.hpp"
#include "sim/model/clock_source.hpp"

class Vmb4_chip;  // of Verilator
class Vmb4_chip___024root;

namespace mb4::sim {

// A chip that runs, for another model that goes on from there.
struct RunningChip {
  const Vmb4_chip___024root& signals;
  ClockSource pin_clock;
  ClockSource oscillator;
  bool osc_selected;
  bool osc_running;
  unsigned osc_tail;
};

class ChipModel : public MasterModel {
 public:
  static constexpr Outputs kMa1 = of_line(0, kMaPin);
  static constexpr Outputs kMa2 = of_line(1, kMaPin);
  static constexpr Outputs kMo1 = of_line(0, kMoPin);
  static constexpr Outputs kMo2 = of_line(1, kMoPin);
  static constexpr Outputs kEot = own(0);
  static constexpr Outputs kNerLow = own(1);

  // Time of the next clock edge; kNever without a clock.
  virtual Time next_edge() const = 0;
  // Drives an input pin and evaluates the chip at time `now`. `pin` must not be an output.
  virtual void set_input(Time now, Pin pin, bool level) = 0;
  // Levels of pins: CLK, SL of a line, the data bus as far as the chip drives it (DB0 is bit 0).
  virtual bool clk() const = 0;
  virtual bool sl(unsigned line) const = 0;
  virtual unsigned db_out() const = 0;
  virtual unsigned db_enable() const = 0;
  // True if CFGIF makes the pins of line 2 the inverse of those of line 1.
  bool paired() const { return followers_ != 0; }
  // From now on set_inputs() of line 1 also drives SL2 with the inverse.
  void drive_pair(bool on) { drives_pair_ = on; }
  // Nothing for a model whose state cannot be taken over.
  virtual std::optional<RunningChip> running() const { return std::nullopt; }

 protected:
  bool drives_pair_ = false;
};

// The two models that are built: one without tracing code, one that writes an FST file. The model
// without tracing can be evaluated with as little work as possible (fast) or by Verilator's eval()
// alone (plain). On return all inputs are at their defaults (pins.hpp), NRES is low, and the chip
// has been evaluated at time 0.
std::unique_ptr<ChipModel> make_fast_chip(const ChipConfig& config, std::uint64_t seed);
std::unique_ptr<ChipModel> make_plain_chip(const ChipConfig& config, std::uint64_t seed);
std::unique_ptr<ChipModel> make_traced_chip(const ChipConfig& config, std::uint64_t seed,
                                            const TraceFile& trace);
// A traced model that goes on from the present state of `chip`, which must have been made by
// make_fast_chip() or make_plain_chip() from the same config. The waveform begins at `trace.from`,
// the present time. Throws TraceError.
std::unique_ptr<ChipModel> make_traced_chip(const ChipConfig& config, const ChipModel& chip,
                                            const TraceFile& trace);

}  // namespace mb4::sim

#endif  // MB4SIM_MB4_CHIP_MODEL_HPP_
