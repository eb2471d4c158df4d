// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The Verilated chip behind an interface without Verilator types. One virtual call runs as many
// clock edges as there are between two outside events; nothing virtual happens per clock.
#ifndef MB4SIM_MODEL_CHIP_MODEL_HPP_
#define MB4SIM_MODEL_CHIP_MODEL_HPP_

#include <cstdint>
#include <memory>
#include <string>

#include "mb4sim/pins.hpp"
#include "mb4sim/scenario.hpp"
#include "mb4sim/time.hpp"

namespace mb4::sim {

// Where a waveform goes and which part of the run it shows.
struct TraceFile {
  std::string path;
  Time from = 0;
  Time to = kNever;
};

class ChipModel {
 public:
  // Bits of watched(): outputs whose change stops run_clocks().
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

  // Runs all clock edges up to and including `limit`, but stops behind the first one that changes
  // a watched output. Returns the time of that edge, or kNever if none has changed.
  virtual Time run_clocks(Time limit) = 0;
  // Time of the next clock edge, kNever without a clock.
  virtual Time next_edge() const = 0;
  // Drives an input pin (no output pin) and evaluates the chip at time `now`.
  virtual void set_input(Time now, Pin pin, bool level) = 0;
  // Another frequency at pin CLK from `now` on; 0: it stands still. Nothing if the scenario has no
  // clock there.
  virtual void set_clock(Time now, std::uint64_t hz) = 0;
  unsigned watched() const { return watched_; }
  // Level of pin CLK.
  virtual bool clk() const = 0;
  // Data bus as the chip drives it: DB0 in bit 0.
  virtual unsigned db_out() const = 0;
  virtual unsigned db_enable() const = 0;
  // Rising edges of the selected system clock so far.
  std::uint64_t cycles() const { return cycles_; }
  // Those of them that were left out because the chip was at rest.
  virtual std::uint64_t left_out() const = 0;
  // Half a period of MA in system clocks, as the running or last frame took it from FREQS.
  virtual unsigned half_clocks() const = 0;
  // Shortest period that the system clock can have had so far, ps; 0 = unknown.
  Time min_clock() const { return min_clock_; }
  // CFGIF makes the pins of line 2 the inverse ones of line 1.
  virtual bool paired() const = 0;
  // Levels outside the chip for the waveform: MA at the slaves (bit n = channel n + 1), SLO and
  // idle of the slaves (bit n = slave n + 1). No effect without a trace.
  virtual void set_probes(Time now, unsigned ma, unsigned slo, unsigned idle) = 0;
  // Writes what the trace still holds. No effect without a trace.
  virtual void finish_trace() = 0;

 protected:
  // Asked at every edge of MA: no virtual calls.
  unsigned watched_ = 0;
  std::uint64_t cycles_ = 0;
  Time min_clock_ = 0;
};

// The two models that are built: one without any tracing code, one that writes an FST file. The
// first one can be evaluated with as little work as possible or in Verilator's plain way.
// All inputs are at their defaults (pins.hpp) with NRES low, evaluated at time 0.
std::unique_ptr<ChipModel> make_fast_chip(const ChipConfig& config, std::uint64_t seed);
std::unique_ptr<ChipModel> make_plain_chip(const ChipConfig& config, std::uint64_t seed);
std::unique_ptr<ChipModel> make_traced_chip(const ChipConfig& config, std::uint64_t seed,
                                            const TraceFile& trace);

}  // namespace mb4::sim

#endif  // MB4SIM_MODEL_CHIP_MODEL_HPP_
