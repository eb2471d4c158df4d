// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// In place of traced_chip.cpp in a build without waveforms (MB4_TRACE = OFF).
#include "chip_model.hpp"
#include "sim/core/trace_error.hpp"

namespace mb4::sim {

std::unique_ptr<ChipModel> make_traced_chip(const ChipConfig& /*config*/, std::uint64_t /*seed*/,
                                            const TraceFile& trace) {
  throw TraceError(trace.path + ": this build writes no waveforms");
}

std::unique_ptr<ChipModel> make_traced_chip(const ChipConfig& /*config*/, const ChipModel& /*chip*/,
                                            const TraceFile& trace) {
  throw TraceError(trace.path + ": this build writes no waveforms");
}

}  // namespace mb4::sim
