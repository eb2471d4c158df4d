// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The Verilated chip behind an interface without Verilator types. One virtual call runs all clock
// edges between two outside events, so there is no virtual call per clock.
#ifndef MB4SIM_MODEL_CHIP_MODEL_HPP_
#define MB4SIM_MODEL_CHIP_MODEL_HPP_

#include <cstdint>
#include <memory>
#include <string>

#include "sim/core/time.hpp"
#include "sim/hosts/pins.hpp"
#include "sim/masters/chip_config.hpp"

namespace mb4::sim {

// The file of a waveform, and the part of the run that it shows.
struct TraceFile {
  std::string path;
  Time from = 0;
  Time to = kNever;
};

class ChipModel {
 public:
  // Bits of watched(). run_clocks() stops when one of these outputs changes.
  enum Watched : unsigned {
    kMa1 = 1U << 0U,
    kMa2 = 1U << 1U,
    kMo1 = 1U << 2U,
    kMo2 = 1U << 3U,
    kEot = 1U << 4U,
    kNerLow = 1U << 5U,
  };

  ChipModel() = default;
  ChipModel(const ChipModel&) = delete;
  ChipModel& operator=(const ChipModel&) = delete;
  virtual ~ChipModel() = default;

  // Runs all clock edges up to and including `limit`. Stops after the first edge that changes a
  // watched output. Returns the time of that edge, or kNever if no watched output has changed.
  virtual Time run_clocks(Time limit) = 0;
  // Time of the next clock edge; kNever without a clock.
  virtual Time next_edge() const = 0;
  // Drives an input pin and evaluates the chip at time `now`. `pin` must not be an output.
  virtual void set_input(Time now, Pin pin, bool level) = 0;
  // Changes the frequency of pin CLK from `now` on; with 0 it stands still. Does nothing if the
  // scenario has no clock there.
  virtual void set_clock(Time now, std::uint64_t hz) = 0;
  unsigned watched() const { return watched_; }
  // Level of pin CLK.
  virtual bool clk() const = 0;
  // Levels of the data bus that the chip drives, and which of them it drives. DB0 is bit 0.
  virtual unsigned db_out() const = 0;
  virtual unsigned db_enable() const = 0;
  // Number of rising edges of the selected system clock so far.
  std::uint64_t cycles() const { return cycles_; }
  // Number of those edges that were left out because the chip was at rest.
  virtual std::uint64_t left_out() const = 0;
  // Half a period of MA in system clocks, as the running or last frame took it from FREQS.
  virtual unsigned half_clocks() const = 0;
  // Shortest period that the system clock can have had so far, ps; 0 = unknown.
  Time min_clock() const { return min_clock_; }
  // True if CFGIF makes the pins of line 2 the inverse of those of line 1.
  virtual bool paired() const = 0;
  // Levels outside the chip, for the waveform: MA at the slaves (bit n = channel n + 1), SLO and
  // idle of the slaves (bit n = slave n + 1). They have no effect without a trace.
  virtual void set_probes(Time now, unsigned ma, unsigned slo, unsigned idle) = 0;
  // Writes the rest of the trace to its file. Has no effect without a trace.
  virtual void finish_trace() = 0;

 protected:
  // These are read at every edge of MA, so they are not virtual.
  unsigned watched_ = 0;
  std::uint64_t cycles_ = 0;
  Time min_clock_ = 0;
};

// The two models that are built: one without tracing code, one that writes an FST file. The model
// without tracing can be evaluated with as little work as possible (fast) or by Verilator's eval()
// alone (plain). On return all inputs are at their defaults (pins.hpp), NRES is low, and the chip
// has been evaluated at time 0.
std::unique_ptr<ChipModel> make_fast_chip(const ChipConfig& config, std::uint64_t seed);
std::unique_ptr<ChipModel> make_plain_chip(const ChipConfig& config, std::uint64_t seed);
std::unique_ptr<ChipModel> make_traced_chip(const ChipConfig& config, std::uint64_t seed,
                                            const TraceFile& trace);

}  // namespace mb4::sim

#endif  // MB4SIM_MODEL_CHIP_MODEL_HPP_
