// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The side of a master that runs: its clocks and its lines. It may consist of several Verilated
// models, or of none. One virtual call runs all clock edges between two outside events, so there is
// no virtual call per clock.
#ifndef MB4SIM_MASTER_MODEL_HPP_
#define MB4SIM_MASTER_MODEL_HPP_

#include <algorithm>
#include <cstdint>

#include "sim/core/master_clock.hpp"
#include "sim/core/time.hpp"

namespace mb4::sim {

// A line is a channel of the scenario. Its index is the number of the channel - 1.
class MasterModel : public MasterClock {
 public:
  // The outputs that others wait for: the bits of each line, which its kind gives a meaning
  // (LineEnd::drive()), and up to 16 bits of the master's own.
  using Outputs = std::uint64_t;
  static constexpr unsigned kMaxLines = 24;
  static constexpr Outputs of_line(unsigned line, unsigned levels) {
    return Outputs{levels} << (kBitsOfLine * line);
  }
  static constexpr unsigned kLevels = (1U << kBitsOfLine) - 1;
  static constexpr Outputs own(unsigned bit) {
    return Outputs{1} << (kBitsOfLine * kMaxLines + bit);
  }

  MasterModel() = default;
  MasterModel(const MasterModel&) = delete;
  MasterModel& operator=(const MasterModel&) = delete;
  virtual ~MasterModel() = default;

  // Runs all clock edges up to and including `limit`. Stops after the first edge that changes
  // outputs(). Returns the time of that edge, or kNever if outputs() has not changed.
  virtual Time run_clocks(Time limit) = 0;
  Outputs outputs() const { return outputs_; }
  // The bits that the master takes from a line change. The simulator looks at outputs() afterwards.
  virtual void set_inputs(Time now, unsigned line, unsigned levels) = 0;
  // Changes the frequency of the clock from `now` on; with 0 it stands still. Does nothing if the
  // scenario has no clock.
  virtual void set_clock(Time now, std::uint64_t hz) = 0;

  // Bits of the lines whose outputs only follow other pins, and so have no pulses of their own.
  Outputs followers() const { return followers_; }

  // Number of clocks that were left out because the master was at rest.
  virtual std::uint64_t left_out() const { return 0; }
  // Levels at the devices, for the waveform: what has arrived (bit n = line n), what each sends,
  // and whether it waits for a frame (bit n = slave n + 1).
  virtual void set_probes(Time /*now*/, std::uint64_t /*arrived*/, std::uint64_t /*sent*/,
                          std::uint64_t /*ready*/) {}
  // Writes the rest of the waveform to its file.
  virtual void finish_trace() {}

 protected:
  // Period of a clock, rounded down to a picosecond; 0 without a clock.
  static constexpr Time period_of(std::uint64_t hz) { return hz == 0 ? 0 : kPsPerSecond / hz; }
  // The system clock may have this frequency from now on; 0: it stands still.
  void may_run_at(std::uint64_t hz) {
    if (hz != 0 && min_clock_ != 0) min_clock_ = std::min(min_clock_, period_of(hz));
  }

  // These are read at every edge of a line, so they are not virtual.
  Outputs outputs_ = 0;
  Outputs followers_ = 0;
};

}  // namespace mb4::sim

#endif  // MB4SIM_MASTER_MODEL_HPP_
