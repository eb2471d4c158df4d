// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The registers of a slave. The seven address bits of a BiSS register access reach a window of 128,
// the standard window of BiSS C slaves:
//
//   0x00-0x3F  selected bank        0x44-0x47  serial number
//   0x40       bank select          0x48-0x77  device
//   0x41       EDS bank             0x78-0x7D  device ID
//   0x42-0x43  profile              0x7E-0x7F  manufacturer
//
// A device with several IDs has 128 registers for each ID, in the order of the IDs.
#ifndef MB4SIM_REGISTER_FILE_HPP_
#define MB4SIM_REGISTER_FILE_HPP_

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <map>

namespace mb4::sim {

class RegisterFile {
 public:
  static constexpr unsigned kPerId = 128;
  static constexpr unsigned kSize = 8 * kPerId;
  static constexpr unsigned kBankSize = 64;
  static constexpr unsigned kBankSelect = 0x40;
  using Bank = std::array<std::uint8_t, kBankSize>;
  using Banks = std::map<std::uint8_t, Bank>;
  using Marks = std::bitset<kSize>;

  // What the user chooses for a device.
  struct Layout {
    // Banks 1 to 255 that exist. Bank 0 is registers 0x00 to 0x3F. If there are no other banks,
    // 0x40 is an ordinary register and bank 0 is always selected.
    Banks banks;
    // Registers that do not exist, and registers that take no write, by the address that the master
    // sees. Below 0x40 a mark counts in every bank.
    Marks missing;
    Marks write_protected;
  };

  // Access from outside the bus: bank 0, every address below kSize. Marks have no effect.
  std::uint8_t get(std::size_t address) const { return bytes_[address]; }
  void set(std::size_t address, std::uint8_t value) { bytes_[address] = value; }

  void set_layout(const Layout& layout) { layout_ = layout; }
  void set_missing(const Marks& missing) { layout_.missing = missing; }
  const Banks& banks() const { return layout_.banks; }

  // Register access of BiSS; `address` is below kSize.
  bool exists(unsigned address) const {
    return !layout_.missing[address] && (!in_bank(address) || banks().contains(selected()));
  }
  // Reads a register for which exists() is true.
  std::uint8_t read(unsigned address) const {
    return in_bank(address) ? banks().at(selected())[address] : bytes_[address];
  }
  // Writes a register for which exists() is true. Returns false if the register is protected and
  // keeps its value.
  bool write(unsigned address, std::uint8_t value);

 private:
  std::uint8_t selected() const { return bytes_[kBankSelect]; }
  // The address lies in a bank other than bank 0.
  bool in_bank(unsigned address) const {
    return address < kBankSize && !banks().empty() && selected() != 0;
  }

  std::array<std::uint8_t, kSize> bytes_{};
  Layout layout_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_REGISTER_FILE_HPP_
