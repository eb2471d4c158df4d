// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The bits of frames to come that Line::flip() inverts, and what is told when it does.
#ifndef MB4SIM_FLIP_WATCH_HPP_
#define MB4SIM_FLIP_WATCH_HPP_

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace mb4::sim {

struct FlipWatch {
  void (*happens)(void* receiver) = nullptr;  // null: nobody is told
  void* receiver = nullptr;

  void tell() const {
    if (happens != nullptr) happens(receiver);
  }
};

// By the numbers of the frames. Several calls for one frame add up.
class PlannedFlips {
 public:
  void add(std::uint64_t frame, const std::vector<unsigned>& bits, FlipWatch watch) {
    Flips& flips = frames_[frame];
    flips.bits.insert(flips.bits.end(), bits.begin(), bits.end());
    flips.watches.push_back(watch);
  }
  // The frame has come: its bits, once. Who watches is told.
  std::vector<unsigned> take(std::uint64_t frame) {
    const auto found = frames_.extract(frame);
    if (found.empty()) return {};
    for (const FlipWatch& watch : found.mapped().watches) watch.tell();
    return std::move(found.mapped().bits);
  }

 private:
  struct Flips {
    std::vector<unsigned> bits;
    std::vector<FlipWatch> watches;
  };
  std::map<std::uint64_t, Flips> frames_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_FLIP_WATCH_HPP_
