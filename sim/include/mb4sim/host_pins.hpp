// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What a host model needs of the world: time and the chip's host pins. Simulator offers it; tests
// offer their own.
#ifndef MB4SIM_HOST_PINS_HPP_
#define MB4SIM_HOST_PINS_HPP_

#include "mb4sim/pins.hpp"
#include "mb4sim/time.hpp"

namespace mb4::sim {

class HostPins {
 public:
  virtual Time now() const = 0;
  // Lets the simulation run up to and including `time`.
  virtual void run_until(Time time) = 0;
  virtual void set_pin(Pin pin, bool level) = 0;
  virtual bool pin(Pin pin) const = 0;

 protected:
  ~HostPins() = default;
};

}  // namespace mb4::sim

#endif  // MB4SIM_HOST_PINS_HPP_
