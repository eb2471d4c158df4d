// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The encoders of BiSS C and of BiSS B that are known by name.
#ifndef MB4SIM_BISS_PRESETS_HPP_
#define MB4SIM_BISS_PRESETS_HPP_

#include <vector>

#include "sim/lines/presets.hpp"

namespace mb4::sim {

std::vector<Preset> biss_c_presets();
std::vector<Preset> biss_b_presets();

}  // namespace mb4::sim

#endif  // MB4SIM_BISS_PRESETS_HPP_
