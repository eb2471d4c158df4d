// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A processor on the parallel bus. Every edge has its own time.
//
// Source of the limits: iC-MB4 Rev D2, items I001 to I016 (Intel 8051), I101 to I114 (Motorola
// 68HC11).
#ifndef MB4SIM_PARALLEL_HOST_HPP_
#define MB4SIM_PARALLEL_HOST_HPP_

#include <cstdint>

#include "sim/core/time.hpp"
#include "sim/hosts/host_pins.hpp"

namespace mb4::sim {

enum class ParallelMode { kIntel, kMotorola };

// Phases of a bus cycle in their order, ps. The defaults are the shortest times that the datasheet
// allows.
struct ParallelTiming {
  Time ale_high = 15'000;  // I002, I102; address, NCS and ALE begin together (I001, I004: 10 ns)
  Time address_hold = 15'000;   // I003, I103, from ALE falling
  Time ale_to_strobe = 15'000;  // I005, I011, I105, I107, from ALE falling, not below address_hold
  Time read_strobe = 54'000;    // I007, I109; the host samples at its end (I008, I110: 54 ns)
  Time write_strobe = 15'000;   // I013, I109; data begin with it (I014, I112)
  Time data_hold = 15'000;      // I015, I113
  Time hold = 10'000;           // I006, I010, I012, I016, I106, I108, I114, from the strobe's end
  Time release = 25'000;        // I009, I111: the chip lets go of the data bus after a read

  // Timing of a bus that begins a cycle every `cycle` ps, 60 ns or more. Below 110 ns only its
  // writes are as short, and a read takes 110 ns. Half of the time that a read leaves is added to
  // the address phase, the rest to the strobe.
  static ParallelTiming for_cycle(Time cycle);
  Time read_cycle() const;
  Time write_cycle() const;
};

// The pins of the master to which a host is connected. The data pins have consecutive numbers.
struct ParallelPins {
  Pin db0, ncs, ale, nrd_rnw, nwr_e;
  Pin cfgspi, int_nmot;  // straps: 0 = parallel bus; 1 = Intel
};

class ParallelHost final : public HostModel {
 public:
  ParallelHost(HostPins& pins, ParallelMode mode, const ParallelTiming& timing,
               const ParallelPins& wires)
      : pins_(pins), wires_(wires), mode_(mode), timing_(timing) {}

  // One bus cycle each. The calls return when NCS is high again and the next cycle may begin.
  void write(std::uint8_t address, std::uint8_t value);
  std::uint8_t read(std::uint8_t address);

  // Sets the levels between cycles, and the straps.
  void rest();

  ParallelMode mode() const { return mode_; }
  void set_timing(const ParallelTiming& timing) { timing_ = timing; }
  const ParallelTiming& timing() const { return timing_; }

 private:
  void wait(Time duration) { pins_.run_until(pins_.now() + duration); }
  void drive(unsigned byte);
  void latch(std::uint8_t address);
  void strobe(bool read, bool active);

  Pin db(unsigned bit) const;

  HostPins& pins_;
  ParallelPins wires_;
  ParallelMode mode_;
  ParallelTiming timing_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_PARALLEL_HOST_HPP_
