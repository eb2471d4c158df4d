// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Microseconds out of a counter of any rate that wraps, for the clocks of the ports.

#ifndef MB4_PORTS_COUNTER_US_HPP_
#define MB4_PORTS_COUNTER_US_HPP_

#include <cstdint>

namespace mb4::ports {

// `Count` is as wide as the counter. Less than one turn of it passes within a call of the driver;
// turns that pass between two calls are missing in the time, which automatic frames and counts
// need too. What a reading rounds off counts in
// the next one, so the time is exact at any rate. One object for one Device: at() changes it.
template <typename Count>
class CounterUs {
 public:
  std::uint32_t at(Count count, std::uint32_t hz) {
    const auto counted = static_cast<Count>(count - last_count_);
    const std::uint64_t parts = rest_ + std::uint64_t{counted} * 1'000'000U;
    last_count_ = count;
    time_us_ += static_cast<std::uint32_t>(parts / hz);
    rest_ = parts % hz;
    return time_us_;
  }

 private:
  std::uint64_t rest_ = 0;  // of a microsecond, times the counter's rate
  Count last_count_ = 0;
  std::uint32_t time_us_ = 0;
};

}  // namespace mb4::ports

#endif  // MB4_PORTS_COUNTER_US_HPP_
