// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// All changes of the pins of a chip, for tests that compare two chips.
#ifndef TESTS_SUPPORT_PIN_CHANGES_HPP_
#define TESTS_SUPPORT_PIN_CHANGES_HPP_

#include <utility>
#include <vector>

#include "mb4sim/simulator.hpp"
#include "sim/masters/mb4/pins.hpp"

namespace mb4test {

inline constexpr mb4::sim::Pin kOutputs[] = {
    mb4::sim::Pin::kEot, mb4::sim::Pin::kMa1, mb4::sim::Pin::kMa2,
    mb4::sim::Pin::kMo1, mb4::sim::Pin::kMo2, mb4::sim::Pin::kNer,
    mb4::sim::Pin::kDb1, mb4::sim::Pin::kSl1, mb4::sim::Pin::kSl2};

inline unsigned levels(const mb4::sim::Simulator& simulator) {
  unsigned word = 0;
  for (const mb4::sim::Pin pin : kOutputs) word = word << 1U | (simulator.pin(pin) ? 1U : 0U);
  return word;
}

using Changes = std::vector<std::pair<mb4::sim::Time, unsigned>>;

// Lets time pass and writes down every change of a pin.
inline Changes advance(mb4::sim::Simulator& simulator, mb4::sim::Time duration) {
  Changes changes;
  const mb4::sim::Time end = simulator.now() + duration;
  unsigned now = levels(simulator);
  const auto changed = [&] { return levels(simulator) != now; };
  while (simulator.run_while_waiting(changed, end)) {
    now = levels(simulator);
    changes.emplace_back(simulator.now(), now);
  }
  return changes;
}

}  // namespace mb4test

#endif  // TESTS_SUPPORT_PIN_CHANGES_HPP_
