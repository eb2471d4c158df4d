// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A progress bar on standard error. It appears only on a terminal and only during long work.
#ifndef MB4SIM_TOOL_PROGRESS_HPP_
#define MB4SIM_TOOL_PROGRESS_HPP_

#include <chrono>
#include <cstdint>

namespace mb4::tool {

class Progress {
 public:
  explicit Progress(std::uint64_t total);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { clear(); }

  // Draws the bar anew if it is time to.
  void update(std::uint64_t done);
  // Removes the bar, so that something else can be printed.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::uint64_t total_;
  bool terminal_;
  bool drawn_ = false;
  Clock::time_point begin_;
  Clock::time_point next_;
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_PROGRESS_HPP_
