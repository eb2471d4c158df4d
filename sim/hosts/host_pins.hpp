// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What a host model needs: time and the chip's host pins. Simulator implements it. Tests have their
// own implementations.
#ifndef MB4SIM_HOST_PINS_HPP_
#define MB4SIM_HOST_PINS_HPP_

#include "sim/core/time.hpp"
#include "sim/hosts/pins.hpp"

namespace mb4::sim {

class HostPins {
 public:
  // Time since power-on, ps.
  virtual Time now() const = 0;
  // Lets the simulation run up to and including `time`.
  virtual void run_until(Time time) = 0;
  // Drives a pin of the chip from outside.
  virtual void set_pin(Pin pin, bool level) = 0;
  // Level of a pin.
  virtual bool pin(Pin pin) const = 0;

 protected:
  ~HostPins() = default;
};

// Sees pins of the chip as they change.
class PinObserver {
 public:
  virtual void pin_changed(Pin pin, bool level) = 0;

 protected:
  ~PinObserver() = default;
};

}  // namespace mb4::sim

#endif  // MB4SIM_HOST_PINS_HPP_
