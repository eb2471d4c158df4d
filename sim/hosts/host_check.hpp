// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What a host has done wrong at the pins of a master. The master looks at them and knows the
// limits.
#ifndef MB4SIM_HOST_CHECK_HPP_
#define MB4SIM_HOST_CHECK_HPP_

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/core/time.hpp"

namespace mb4::sim {

class HostCheck {
 public:
  struct Violation {
    std::string item;  // "I205"
    std::string
        text;  // "I205: MOSI stable 3.000 ns before SCLK rises at 1234.000 ns, at least ..."
  };

  // violations() holds the first kKept violations; count() counts all of them.
  static constexpr std::size_t kKept = 100;
  const std::vector<Violation>& violations() const { return violations_; }
  std::uint64_t count() const { return count_; }
  void clear();

 protected:
  // Records a violation if a level has lasted for less than `minimum`. `since` is the time at which
  // it began; kNever if it never did.
  void need(Time now, const char* item, const char* what, Time since, Time minimum) {
    if (since != kNever && now - since < minimum) violated(now, item, what, since, minimum);
  }

 private:
  void violated(Time now, const char* item, const char* what, Time since, Time minimum);

  std::vector<Violation> violations_;
  std::uint64_t count_ = 0;
};

}  // namespace mb4::sim

#endif  // MB4SIM_HOST_CHECK_HPP_
