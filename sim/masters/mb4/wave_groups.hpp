// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The waveform view of the iC-MB4: host, line, slaves, then the chip's inside and the straps. Pins
// have the names that the datasheet gives them with this interface (page 3).
#ifndef MB4SIM_MB4_WAVE_GROUPS_HPP_
#define MB4SIM_MB4_WAVE_GROUPS_HPP_

#include <vector>

#include "sim/hosts/host_config.hpp"
#include "sim/model/wave_view.hpp"

namespace mb4::sim {

// None if the chip is on a bus of words: then it writes no waveform.
std::vector<WaveGroup> mb4_wave_groups(const HostConfig& host);

}  // namespace mb4::sim

#endif  // MB4SIM_MB4_WAVE_GROUPS_HPP_
