// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/device.hpp"

namespace mb4::sim {

std::string_view DeviceConfig::refuses(const SlaveFault& fault) const {
  if (fault == slave_fault::kWrongCrc && crc.width() != 0) return "";
  return fault.refusal;
}

}  // namespace mb4::sim
