// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The saved view that belongs to a waveform file.
#ifndef MB4SIM_WAVE_VIEW_HPP_
#define MB4SIM_WAVE_VIEW_HPP_

#include <optional>
#include <string>

#include "mb4sim/time.hpp"

namespace mb4::sim {

// Writes a GTKWave save file for a finished FST file: the chip's signals in the groups host,
// registers, control, line and slaves, states by their names. The view begins where the waveform
// does; `marker` is where GTKWave's marker stands, else at the beginning. It is made from the
// hierarchy found in the FST file, so it always fits it. Throws std::runtime_error if one file
// cannot be read or the other not written.
void write_wave_view(const std::string& fst_path, const std::string& view_path,
                     std::optional<Time> marker = {});

}  // namespace mb4::sim

#endif  // MB4SIM_WAVE_VIEW_HPP_
