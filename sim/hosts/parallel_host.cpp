// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/hosts/parallel_host.hpp"

#include <algorithm>

namespace mb4::sim {
namespace {

constexpr unsigned kBits = 8;
constexpr Time kShortestRead = 110'000;  // what for_cycle() leaves a read, whatever a write takes

}  // namespace

Time ParallelTiming::read_cycle() const {
  return ale_high + std::max(ale_to_strobe, address_hold) + read_strobe + std::max(hold, release);
}

Time ParallelTiming::write_cycle() const {
  return ale_high + std::max(ale_to_strobe, address_hold) + write_strobe +
         std::max(hold, data_hold);
}

ParallelTiming ParallelTiming::for_cycle(Time cycle) {
  ParallelTiming timing;
  const Time read = std::max(cycle, kShortestRead);
  const Time before = (std::max(cycle, timing.read_cycle()) - timing.read_cycle()) / 2;
  timing.ale_to_strobe += before;
  timing.read_strobe += read - timing.read_cycle();
  timing.write_strobe += cycle - std::min(cycle, timing.write_cycle());
  return timing;
}

Pin ParallelHost::db(unsigned bit) const {
  return static_cast<Pin>(static_cast<int>(wires_.db0) + static_cast<int>(bit));
}

void ParallelHost::rest() {
  pins_.set_pin(wires_.cfgspi, false);
  pins_.set_pin(wires_.int_nmot, mode_ == ParallelMode::kIntel);
  pins_.set_pin(wires_.ncs, true);
  pins_.set_pin(wires_.ale, false);
  pins_.set_pin(wires_.nrd_rnw, true);
  pins_.set_pin(wires_.nwr_e, mode_ == ParallelMode::kIntel);
}

void ParallelHost::drive(unsigned byte) {
  for (unsigned bit = 0; bit < kBits; ++bit) pins_.set_pin(db(bit), ((byte >> bit) & 1U) != 0);
}

void ParallelHost::latch(std::uint8_t address) {
  drive(address);
  pins_.set_pin(wires_.ncs, false);
  pins_.set_pin(wires_.ale, true);
  wait(timing_.ale_high);
  pins_.set_pin(wires_.ale, false);
}

void ParallelHost::strobe(bool read, bool active) {
  if (mode_ == ParallelMode::kMotorola) {
    pins_.set_pin(wires_.nwr_e, active);
  } else {
    pins_.set_pin(read ? wires_.nrd_rnw : wires_.nwr_e, !active);
  }
}

void ParallelHost::write(std::uint8_t address, std::uint8_t value) {
  latch(address);
  if (mode_ == ParallelMode::kMotorola) pins_.set_pin(wires_.nrd_rnw, false);
  wait(std::max(timing_.address_hold, timing_.ale_to_strobe));
  drive(value);
  strobe(false, true);
  wait(timing_.write_strobe);
  strobe(false, false);
  const Time end = pins_.now();
  wait(timing_.hold);
  pins_.set_pin(wires_.nrd_rnw, true);
  pins_.set_pin(wires_.ncs, true);
  pins_.run_until(std::max(pins_.now(), end + timing_.data_hold));
  drive(0);
}

std::uint8_t ParallelHost::read(std::uint8_t address) {
  latch(address);
  wait(std::max(timing_.address_hold, timing_.ale_to_strobe));
  drive(0);  // pull-downs (A06) hold the released bus at 0
  strobe(true, true);
  wait(timing_.read_strobe);
  unsigned value = 0;
  for (unsigned bit = 0; bit < kBits; ++bit) {
    value |= (pins_.pin(db(bit)) ? 1U : 0U) << bit;
  }
  strobe(true, false);
  const Time end = pins_.now();
  wait(timing_.hold);
  pins_.set_pin(wires_.ncs, true);
  pins_.run_until(std::max(pins_.now(), end + timing_.release));
  return static_cast<std::uint8_t>(value);
}

}  // namespace mb4::sim
