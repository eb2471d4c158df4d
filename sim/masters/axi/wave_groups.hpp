// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The waveform view of the BiSS C master on AXI: bus, stream, sample clock, then each channel with
// its encoder, then the inside.
#ifndef MB4SIM_AXI_WAVE_GROUPS_HPP_
#define MB4SIM_AXI_WAVE_GROUPS_HPP_

#include <vector>

#include "sim/hosts/host_config.hpp"
#include "sim/model/wave_view.hpp"

namespace mb4::sim {

std::vector<WaveGroup> axi_wave_groups(const HostConfig& host);

}  // namespace mb4::sim

#endif  // MB4SIM_AXI_WAVE_GROUPS_HPP_
