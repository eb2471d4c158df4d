// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Checks the host's pins against the datasheet's limits for a host: setup, hold and pulse times on
// SPI, SPI2, the Intel and the Motorola bus. It sees every pin that is driven from outside, by a
// host model or by hand.
//
// Source: iC-MB4 Rev D2, pages 9 to 11.
#ifndef MB4SIM_MB4_HOST_CHECK_HPP_
#define MB4SIM_MB4_HOST_CHECK_HPP_

#include <array>

#include "sim/core/time.hpp"
#include "sim/hosts/host_check.hpp"
#include "sim/masters/mb4/pins.hpp"

namespace mb4::sim {

class Mb4HostCheck final : public HostCheck {
 public:
  // A pin gets a level at `now`. The level that it has already is no change. While NRES is low
  // nothing is checked.
  void edge(Time now, Pin pin, bool level);

 private:
  // One serial interface: its pins and the state of its frame.
  struct Serial {
    Pin ncs, sclk, mosi;
    unsigned bits = 0;
    unsigned opcode = 0;
    Time address_high = kNever;  // width of the high phase after the address of 0x03
  };

  Time& changed(Pin pin) { return changed_[static_cast<std::size_t>(pin)]; }
  bool level(Pin pin) const { return levels_[static_cast<std::size_t>(pin)]; }
  void check_serial(Time now, Serial& serial, Pin pin, bool level);
  void check_parallel(Time now, Pin pin, bool level);
  void check_data(Time now);
  void begin_strobe(Time now, bool read);
  void end_strobe(Time now, bool read);
  Time data_changed() const;

  Serial spi_{Pin::kNcs, Pin::kAle, Pin::kDb0};
  Serial spi2_{Pin::kDb4, Pin::kDb5, Pin::kDb6};
  std::array<bool, 32> levels_{};
  std::array<Time, 32> changed_{};  // last change of each pin
  Time address_latched_ = kNever;   // last falling edge of ALE with NCS low
  Time written_ = kNever;           // end of the last write
  Time strobe_begin_ = kNever;
  Time strobe_end_ = kNever;
  bool was_read_ = false;  // the last strobe
};

}  // namespace mb4::sim

#endif  // MB4SIM_MB4_HOST_CHECK_HPP_
