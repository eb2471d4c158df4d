// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/clocked/sl_faults.hpp"

#include <algorithm>
#include <utility>

namespace mb4::sim {

void SlFaults::flip_next_frame(std::vector<unsigned> bits) {
  pending_.insert(pending_.end(), bits.begin(), bits.end());
}

void SlFaults::flip_frame(std::uint64_t frame, std::vector<unsigned> bits, FlipWatch watch) {
  Planned& planned = planned_[frame];
  planned.bits.insert(planned.bits.end(), bits.begin(), bits.end());
  planned.watches.push_back(watch);
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
  if (const auto found = planned_.find(frames_); found != planned_.end()) {
    const Planned planned = std::move(found->second);
    planned_.erase(found);
    flip_next_frame(planned.bits);
    for (const FlipWatch& watch : planned.watches) watch.tell();
  }
  update();
}

bool SlFaults::is_pending(unsigned bit) const {
  return std::find(pending_.begin(), pending_.end(), bit) != pending_.end();
}

}  // namespace mb4::sim
