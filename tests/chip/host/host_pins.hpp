// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Hosts that drive single pins, for accesses that the simulator's host models do not make.
#ifndef TESTS_CHIP_HOST_HOST_PINS_HPP_
#define TESTS_CHIP_HOST_HOST_PINS_HPP_

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "mb4sim/simulator.hpp"
#include "sim/masters/mb4/pins.hpp"

namespace mb4test {

// One SPI2 frame whose edges come at their own times while something else drives the simulation.
// The object must live until the frame is over.
class BackgroundSpi2 {
 public:
  BackgroundSpi2(mb4::sim::Simulator& simulator, std::vector<std::uint8_t> tx)
      : simulator_(simulator), tx_(std::move(tx)), rx_(tx_.size()) {}

  // NCS falls at `begin`; `half` is half a period of SCLK. Returns the time at which NCS rises.
  mb4::sim::Time start(mb4::sim::Time begin, mb4::sim::Time half) {
    using mb4::sim::Pin;
    const auto set = [this](mb4::sim::Time at, Pin pin, bool level) {
      simulator_.at(at, [this, pin, level] { simulator_.set_pin(pin, level); });
    };
    set(begin, Pin::kDb4, false);
    mb4::sim::Time now = begin + half;
    for (std::size_t i = 0; i < tx_.size(); ++i) {
      for (unsigned bit = 8; bit-- > 0;) {
        set(now, Pin::kDb6, ((tx_[i] >> bit) & 1U) != 0);
        now += half;
        simulator_.at(now, [this, i] {
          rx_[i] = static_cast<std::uint8_t>(rx_[i] << 1U | (simulator_.pin(Pin::kDb7) ? 1U : 0U));
          simulator_.set_pin(Pin::kDb5, true);
        });
        now += i == 1 && bit == 0 ? std::max<mb4::sim::Time>(half, 100'000) : half;  // I204
        set(now, Pin::kDb5, false);
      }
    }
    now += half;
    simulator_.at(now, [this] {
      simulator_.set_pin(mb4::sim::Pin::kDb4, true);
      done_ = true;
    });
    return now;
  }

  bool done() const { return done_; }
  const std::vector<std::uint8_t>& rx() const { return rx_; }

 private:
  mb4::sim::Simulator& simulator_;
  std::vector<std::uint8_t> tx_;
  std::vector<std::uint8_t> rx_;
  bool done_ = false;
};

}  // namespace mb4test

#endif  // TESTS_CHIP_HOST_HOST_PINS_HPP_
