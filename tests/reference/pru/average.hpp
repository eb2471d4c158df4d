// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The average of the sample points over four frames: R-P12.
#ifndef TESTS_REFERENCE_PRU_AVERAGE_HPP_
#define TESTS_REFERENCE_PRU_AVERAGE_HPP_

#include <deque>

namespace pru_judge {

class Average {
 public:
  // RUN rose, or the rate has changed: off until four points are known again.
  void clear() { places_.clear(); }
  // A frame with an acknowledge has measured a place (0..15). It counts for the frames after it.
  void add(unsigned place);
  bool ready() const { return places_.size() == 4; }
  // The place to use in a frame that has measured `own`. ready() must be true. `as_published`:
  // SMA_WRAP, the mean of the bit numbers in the byte that this frame's own place chooses.
  unsigned used(unsigned own, bool as_published) const;

 private:
  std::deque<unsigned> places_;  // of the last four, the newest at the end
};

}  // namespace pru_judge

#endif  // TESTS_REFERENCE_PRU_AVERAGE_HPP_
