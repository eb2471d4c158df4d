// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The saved view for a waveform file.
#ifndef MB4SIM_WAVE_VIEW_HPP_
#define MB4SIM_WAVE_VIEW_HPP_

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/time.hpp"

namespace mb4::sim {

// A signal of the top module, shown under the name of a pin.
struct WavePin {
  std::string_view name;    // empty: the signal's name
  std::string_view signal;  // without the range of a vector
  int bit = -1;             // bit of a vector; -1: all of it
};

// A group of the view: pins of a master, and signals inside it whose path contains a scope.
struct WaveGroup {
  std::string_view name;
  bool open;  // unfolded when the view is loaded
  std::vector<WavePin> pins;
  std::vector<std::string_view> scopes;
};

// Writes a GTKWave save file for a finished FST file. The view shows the signals in these groups.
// States have their names. The view begins where the waveform begins. GTKWave's marker stands at
// `marker`, without a value at the beginning. The view is made from the hierarchy in the FST file,
// so it always fits the file. Throws std::runtime_error if one file cannot be read or the other
// cannot be written.
void write_wave_view(const std::string& fst_path, const std::string& view_path,
                     std::span<const WaveGroup> groups, std::optional<Time> marker = {});

}  // namespace mb4::sim

#endif  // MB4SIM_WAVE_VIEW_HPP_
