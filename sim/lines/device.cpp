// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/device.hpp"

namespace mb4::sim {

std::string_view DeviceConfig::refuses(SlaveFault fault) const {
  switch (fault) {
    case SlaveFault::kSilent:
      return "";
    case SlaveFault::kBusy:
      return "this slave has no busy time";
    case SlaveFault::kWrongCrc:
      return crc.width() == 0 ? "this slave sends no CRC" : "";
    case SlaveFault::kWrongId:
      return "this slave has no ID";
    case SlaveFault::kStuckWord:
    case SlaveFault::kSwappedWords:
      return "only a BiSS C sensor can have it";
    case SlaveFault::kStuckCounter:
    case SlaveFault::kSkippedWord:
      return "this slave has no life counter";
  }
  return "";
}

}  // namespace mb4::sim
