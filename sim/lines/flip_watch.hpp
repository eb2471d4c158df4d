// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What is told when Line::flip() inverts the bits of a frame.
#ifndef MB4SIM_FLIP_WATCH_HPP_
#define MB4SIM_FLIP_WATCH_HPP_

namespace mb4::sim {

struct FlipWatch {
  void (*happens)(void* receiver) = nullptr;  // null: nobody is told
  void* receiver = nullptr;

  void tell() const {
    if (happens != nullptr) happens(receiver);
  }
};

}  // namespace mb4::sim

#endif  // MB4SIM_FLIP_WATCH_HPP_
