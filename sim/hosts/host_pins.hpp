// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What a host model needs: time and the pins of a master. Simulator implements it. Tests have their
// own implementations.
#ifndef MB4SIM_HOST_PINS_HPP_
#define MB4SIM_HOST_PINS_HPP_

#include <optional>
#include <string_view>

#include "sim/core/time.hpp"

namespace mb4::sim {

// A pin of a master, by a number of the master's own. The master names its pins;
// masters/mb4/pins.hpp has the names of the iC-MB4.
enum class Pin : int;

// The pin of this name in a table of pairs, name and pin.
template <typename Names>
constexpr std::optional<Pin> find_pin(const Names& names, std::string_view name) {
  for (const auto& [text, pin] : names) {
    if (text == name) return pin;
  }
  return std::nullopt;
}

class HostPins {
 public:
  // Time since power-on, ps.
  virtual Time now() const = 0;
  // Lets the simulation run up to and including `time`.
  virtual void run_until(Time time) = 0;
  // Drives a pin of the master from outside.
  virtual void set_pin(Pin pin, bool level) = 0;
  // Level of a pin.
  virtual bool pin(Pin pin) const = 0;

 protected:
  ~HostPins() = default;
};

// Sees pins of a master as they change.
class PinObserver {
 public:
  virtual void pin_changed(Pin pin, bool level) = 0;

 protected:
  ~PinObserver() = default;
};

// A host on pins or registers of a master. A program asks the simulator for it by its name and its
// class.
class HostModel {
 public:
  HostModel() = default;
  HostModel(const HostModel&) = delete;
  HostModel& operator=(const HostModel&) = delete;
  virtual ~HostModel() = default;
};

}  // namespace mb4::sim

#endif  // MB4SIM_HOST_PINS_HPP_
