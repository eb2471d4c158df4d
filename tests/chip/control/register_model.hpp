// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The registers of a BiSS C slave with one ID, as sim/README.md describes them: what a test
// expects, written without the simulator's own RegisterFile.
#ifndef TESTS_CHIP_CONTROL_REGISTER_MODEL_HPP_
#define TESTS_CHIP_CONTROL_REGISTER_MODEL_HPP_

#include <array>
#include <bitset>
#include <cstdint>
#include <map>

#include "sim/lines/register_file.hpp"

namespace mb4test {

struct RegisterModel {
  static constexpr unsigned kSize = 128;
  static constexpr unsigned kBankSize = 64;
  static constexpr unsigned kBankSelect = 0x40;

  std::array<std::uint8_t, kSize> bytes{};  // below 0x40: bank 0
  std::map<std::uint8_t, std::array<std::uint8_t, kBankSize>> banks;
  std::bitset<kSize> missing;
  std::bitset<kSize> write_protected;

  // `address` counts on from 0x7F at 0x00 (decision 12).
  bool exists(unsigned address) const {
    const unsigned at = address % kSize;
    return !missing[at] && (!banked(at) || banks.count(bytes[kBankSelect]) != 0);
  }
  // Only if it exists.
  std::uint8_t read(unsigned address) const {
    const unsigned at = address % kSize;
    return banked(at) ? banks.at(bytes[kBankSelect])[at] : bytes[at];
  }
  void write(unsigned address, std::uint8_t value) {
    const unsigned at = address % kSize;
    if (!write_protected[at]) (banked(at) ? banks.at(bytes[kBankSelect])[at] : bytes[at]) = value;
  }
  // The simulated slave holds exactly this.
  bool equals(const mb4::sim::RegisterFile& file) const {
    for (unsigned i = 0; i < kSize; ++i) {
      if (file.get(i) != bytes[i]) return false;
    }
    for (const auto& [number, bank] : banks) {
      if (file.banks().at(number) != bank) return false;
    }
    return true;
  }

 private:
  bool banked(unsigned at) const {
    return at < kBankSize && !banks.empty() && bytes[kBankSelect] != 0;
  }
};

}  // namespace mb4test

#endif  // TESTS_CHIP_CONTROL_REGISTER_MODEL_HPP_
