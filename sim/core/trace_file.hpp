// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The file of a waveform, and the part of the run that it shows.
#ifndef MB4SIM_TRACE_FILE_HPP_
#define MB4SIM_TRACE_FILE_HPP_

#include <string>

#include "sim/core/time.hpp"

namespace mb4::sim {

struct TraceFile {
  std::string path;
  Time from = 0;
  Time to = kNever;
};

}  // namespace mb4::sim

#endif  // MB4SIM_TRACE_FILE_HPP_
