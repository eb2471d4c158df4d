// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Exit statuses of mb4sim, and the exception for kWrongUse.
#ifndef MB4SIM_TOOL_EXIT_STATUS_HPP_
#define MB4SIM_TOOL_EXIT_STATUS_HPP_

#include <stdexcept>

namespace mb4::tool {

inline constexpr int kGood = 0;
inline constexpr int kBad = 1;           // a check failed or a frame was bad
inline constexpr int kWrongUse = 2;      // wrong use or input
inline constexpr int kModelStopped = 3;  // an assertion in the RTL failed
inline constexpr int kSignalled = 128;   // ended by a signal (this plus its number)

// Wrong use or input; what() is one complete line.
class UseError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_EXIT_STATUS_HPP_
