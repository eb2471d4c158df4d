// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The saved view for a waveform file.
#ifndef MB4SIM_WAVE_VIEW_HPP_
#define MB4SIM_WAVE_VIEW_HPP_

#include <optional>
#include <string>

#include "sim/core/time.hpp"
#include "sim/hosts/host_config.hpp"

namespace mb4::sim {

// Writes a GTKWave save file for a finished FST file. The view shows the chip's signals in the
// groups host, registers, control, line and slaves. States have their names. Pins have the names
// that the datasheet gives them with this interface (page 3). The view begins where the waveform
// begins. GTKWave's marker stands at `marker`, without a value at the beginning. The view is made
// from the hierarchy in the FST file, so it always fits the file. Throws std::runtime_error if one
// file cannot be read or the other cannot be written.
void write_wave_view(const std::string& fst_path, const std::string& view_path,
                     HostInterface interface, std::optional<Time> marker = {});

}  // namespace mb4::sim

#endif  // MB4SIM_WAVE_VIEW_HPP_
