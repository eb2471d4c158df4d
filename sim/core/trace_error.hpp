// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The error of a waveform file that cannot be written.
#ifndef MB4SIM_TRACE_ERROR_HPP_
#define MB4SIM_TRACE_ERROR_HPP_

#include <stdexcept>
#include <string>

#include "sim/core/one_line.hpp"

namespace mb4::sim {

// what() is one line: "path: cannot write the waveform", with the reason if it is known.
class TraceError : public std::runtime_error {
 public:
  explicit TraceError(const std::string& message) : std::runtime_error(one_line(message)) {}
};

}  // namespace mb4::sim

#endif  // MB4SIM_TRACE_ERROR_HPP_
