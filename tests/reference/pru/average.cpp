// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

#include "tests/reference/pru/average.hpp"

#include <cmath>

#include "tests/reference/pru/sampling.hpp"

namespace pru_judge {

void Average::add(unsigned place) {
  places_.push_back(place);
  if (places_.size() > 4) places_.pop_front();
}

unsigned Average::used(unsigned own, bool as_published) const {
  if (as_published) {
    unsigned sum = 0;
    for (const unsigned place : places_) sum += bit_number(place);
    const unsigned mean = sum / 4;
    return own / kSamples * kSamples + (kSamples - 1 - mean);
  }
  // How far each place lies from this frame's own, on a circle of eight: -4 to 3.
  int sum = 0;
  for (const unsigned place : places_) {
    int distance = static_cast<int>(place) - static_cast<int>(own) + 4;
    while (distance < 0) distance += 8;
    sum += distance % 8 - 4;
  }
  // A half goes to the later sample, upwards.
  const double mean = std::floor(sum / 4.0 + 0.5);
  return static_cast<unsigned>(static_cast<int>(own) + static_cast<int>(mean));
}

}  // namespace pru_judge
