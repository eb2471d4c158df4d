// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The error that ends a simulation when an assertion in the RTL or a guard at its pins fails.
#ifndef MB4SIM_MODEL_STOPPED_HPP_
#define MB4SIM_MODEL_STOPPED_HPP_

#include <stdexcept>
#include <string>

namespace mb4::sim {

// Every call that lets time pass can throw this. After that the chip must not be evaluated again:
// every later call that would do so throws the same error.
class ModelStopped : public std::runtime_error {
 public:
  ModelStopped(const char* file, int line, const char* hierarchy);
  // For a check inside the simulator; `what` is one line.
  explicit ModelStopped(const std::string& what) : std::runtime_error(what) {}
};

}  // namespace mb4::sim

#endif  // MB4SIM_MODEL_STOPPED_HPP_
