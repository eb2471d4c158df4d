// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/core/version.hpp"

namespace mb4::sim {

const char* version() { return MB4SIM_VERSION; }

}  // namespace mb4::sim
