// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/register_file.hpp"

namespace mb4::sim {

bool RegisterFile::write(unsigned address, std::uint8_t value) {
  if (layout_.write_protected[address]) return false;
  (in_bank(address) ? layout_.banks.at(selected())[address] : bytes_[address]) = value;
  return true;
}

}  // namespace mb4::sim
