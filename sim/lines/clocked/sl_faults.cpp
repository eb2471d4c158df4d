// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/clocked/sl_faults.hpp"

#include <algorithm>
#include <utility>

namespace mb4::sim {

void SlFaults::flip_next_frame(std::vector<unsigned> bits) {
  pending_.insert(pending_.end(), bits.begin(), bits.end());
}

void SlFaults::flip_frame(std::uint64_t frame, const std::vector<unsigned>& bits, FlipWatch watch) {
  planned_.add(frame, bits, watch);
}

void SlFaults::end_frame() {
  if (counting_) pending_.clear();
  acknowledged_ = false;
  counting_ = false;
  flip_now_ = false;
}

void SlFaults::begin_frame() {
  counting_ = true;
  bit_ = 0;
  ++frames_;
  if (std::vector<unsigned> bits = planned_.take(frames_); !bits.empty()) {
    flip_next_frame(std::move(bits));
  }
  update();
}

bool SlFaults::is_pending(unsigned bit) const {
  return std::find(pending_.begin(), pending_.end(), bit) != pending_.end();
}

}  // namespace mb4::sim
