// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Functional coverage of the iC-MB4: which values of each configuration field have met which kind
// of frame. The class sees the pins alone. It takes the configuration from the writes of the host,
// and pin EOT tells it that a frame starts. Simulator::set_observer() connects it.
//
// A point is a class of values of a field, with a kind of frame. A field of one or two bits has a
// class for each value; a wider one has 0, 1, its maximum, and everything between. A field that
// itself makes a frame of this kind (REGVERS of a register access) has no points with it.
//
// A control communication or INIT counts once, at its start. Writes on SPI2 do not exist.
#ifndef MB4SIM_FUNCTIONAL_COVERAGE_HPP_
#define MB4SIM_FUNCTIONAL_COVERAGE_HPP_

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/hosts/host_pins.hpp"
#include "sim/masters/mb4/hints/host_writes.hpp"
#include "sim/masters/mb4/pins.hpp"

namespace mb4::sim {

class FunctionalCoverage final : public PinObserver {
 public:
  FunctionalCoverage();

  // Begins with another chip after its reset. The counts stay.
  void restart();
  void pin_changed(Pin pin, bool level) override;

  // How often each point was met, in the order of text().
  const std::vector<std::uint64_t>& counts() const { return counts_; }
  // Adds what another one has counted; of another length it does nothing.
  void add(const std::vector<std::uint64_t>& counts);
  std::uint64_t points() const { return counts_.size(); }
  std::uint64_t reached() const;
  // A line for each point: count, kind, field and class, with tabs between them. A class is
  // "FREQS=middle".
  std::string text() const;

 private:
  friend HostWrites;
  void written(std::uint8_t address, std::uint8_t value);
  void unknown(std::uint8_t /*opcode*/) {}
  void frame();
  bool line_used(unsigned line, unsigned protocol) const;
  void hit(unsigned kind);

  std::vector<std::uint64_t> counts_;  // of the points, in their order
  HostWrites::Levels levels_{};
  HostWrites writes_;
  std::array<std::uint8_t, 256> image_{};  // as the host has written it
  bool asked_ = false;                     // an instruction that has not started a frame yet
};

}  // namespace mb4::sim

#endif  // MB4SIM_FUNCTIONAL_COVERAGE_HPP_
