// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/mb4/mb4_master.hpp"

namespace mb4::sim {

std::span<const Master* const> masters() {
  static constexpr const Master* kAll[] = {&kMb4Master};
  return kAll;
}

}  // namespace mb4::sim
