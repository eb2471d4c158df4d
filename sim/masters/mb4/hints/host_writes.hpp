// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The bytes that a host writes, as the levels of its pins tell them: SPI, Intel and Motorola bus.
// SPI2 cannot write.
#ifndef MB4SIM_HOST_WRITES_HPP_
#define MB4SIM_HOST_WRITES_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4_regs.hpp"
#include "sim/masters/mb4/pins.hpp"

namespace mb4::sim {

class HostWrites {
 public:
  using Levels = std::array<bool, 32>;  // by Pin

  // A pin of the host has changed; `levels` has its new level. `receiver` is told of bytes and of
  // opcodes that the chip does not have: written(address, value), unknown(opcode).
  template <typename Receiver>
  void edge(Pin pin, bool level, const Levels& levels, Receiver& receiver) {
    if (levels[index(Pin::kCfgspi)]) {
      serial(pin, level, levels, receiver);
    } else {
      parallel(pin, level, levels, receiver);
    }
  }

 private:
  enum class Serial { kOpcode, kAddress, kData, kIgnore };

  static constexpr std::size_t index(Pin pin) { return static_cast<std::size_t>(pin); }
  static std::uint8_t data(const Levels& levels) {
    unsigned byte = 0;
    for (unsigned bit = 0; bit < 8; ++bit) {
      byte |= (levels[index(Pin::kDb0) + bit] ? 1U : 0U) << bit;
    }
    return static_cast<std::uint8_t>(byte);
  }

  template <typename Receiver>
  void serial(Pin pin, bool level, const Levels& levels, Receiver& receiver) {
    if (pin == Pin::kAle) {  // SCLK
      if (!level || serial_ == Serial::kIgnore) return;
      shift_ = static_cast<std::uint8_t>(shift_ << 1U | (levels[index(Pin::kDb0)] ? 1U : 0U));
      if (++bits_ % 8 == 0) byte(receiver);
    } else if (pin == Pin::kNcs) {
      serial_ = level ? Serial::kIgnore : Serial::kOpcode;
      bits_ = 0;
    }
  }

  template <typename Receiver>
  void byte(Receiver& receiver) {
    switch (serial_) {
      case Serial::kOpcode:
        opcode(receiver);
        break;
      case Serial::kAddress:
        address_ = shift_;
        serial_ = Serial::kData;
        break;
      case Serial::kData:
        receiver.written(address_++, shift_);
        break;
      case Serial::kIgnore:
        break;
    }
  }

  template <typename Receiver>
  void opcode(Receiver& receiver) {
    serial_ = Serial::kData;
    switch (shift_) {
      case regs::kSpiOpcodeWriteRegisters:
        serial_ = Serial::kAddress;
        break;
      case regs::kSpiOpcodeWriteRegisters0:
        address_ = regs::kAddrScdata;
        break;
      case regs::kSpiOpcodeWriteInstruction:
        address_ = regs::kAddrInstr;
        break;
      case regs::kSpiOpcodeReadRegisters:
      case regs::kSpiOpcodeReadRegisters0:
      case regs::kSpiOpcodeReadStatus:
        serial_ = Serial::kIgnore;
        break;
      default:
        serial_ = Serial::kIgnore;
        receiver.unknown(shift_);
        break;
    }
  }

  // Intel: NWR; Motorola: E with RNW low. ALE is high only before them.
  template <typename Receiver>
  void parallel(Pin pin, bool level, const Levels& levels, Receiver& receiver) {
    if (levels[index(Pin::kNcs)]) return;
    const bool intel = levels[index(Pin::kIntNmot)];
    if (pin == Pin::kAle && !level) {
      address_ = data(levels);
    } else if (pin == Pin::kNwrE && level == intel && (intel || !levels[index(Pin::kNrdRnw)])) {
      receiver.written(address_, data(levels));
    }
  }

  Serial serial_ = Serial::kIgnore;
  unsigned bits_ = 0;
  std::uint8_t shift_ = 0;
  std::uint8_t address_ = 0;
};

}  // namespace mb4::sim

#endif  // MB4SIM_HOST_WRITES_HPP_
