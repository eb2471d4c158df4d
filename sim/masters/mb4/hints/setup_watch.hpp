// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What the host of an iC-MB4 has told it: the registers at the latest instruction that asks for
// words, or at the begin of the latest frame that fetches them. Frames of register accesses,
// commands and INIT do not count: before the host knows the words of a slave it may well ask it for
// its registers.
#ifndef MB4SIM_SETUP_WATCH_HPP_
#define MB4SIM_SETUP_WATCH_HPP_

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "mb4_regs.hpp"

namespace mb4::sim {

// The registers from 0xC0 on, as the host has written them.
struct WrittenSetup {
  static constexpr unsigned kFirst = regs::kAddrSlaveCfg;

  std::uint8_t operator[](unsigned address) const { return bytes[address - kFirst]; }
  std::array<std::uint8_t, 256 - kFirst> bytes{};
};

class SetupWatch {
 public:
  // The chip is in reset.
  void restart() {
    now_ = {};
    told_ = false;
    asked_ = false;
    automatic_ = false;
    changed_ = true;
  }
  void written(std::uint8_t address, std::uint8_t value) {
    if (address < WrittenSetup::kFirst) return;
    if (address == regs::kAddrInstr) {
      instruction(value);
      return;
    }
    std::uint8_t& byte = now_.bytes[address - WrittenSetup::kFirst];
    changed_ = changed_ || byte != value;
    byte = value;
  }
  void unknown(std::uint8_t opcode) {
    if (std::find(opcodes_.begin(), opcodes_.end(), opcode) == opcodes_.end()) {
      opcodes_.push_back(opcode);
    }
  }
  // A frame begins: pin EOT falls.
  void frame() {
    if (asked_ || automatic_) take();
    asked_ = false;
  }

  // Null: the host has not asked for words.
  const WrittenSetup* setup() const { return told_ ? &taken_ : nullptr; }
  // Each once.
  const std::vector<std::uint8_t>& opcodes() const { return opcodes_; }

 private:
  void instruction(std::uint8_t value) {
    const unsigned code = value & regs::INSTR::kMask;
    const bool stops = (value & (regs::BREAK::kMask | regs::INIT::kMask)) != 0;
    automatic_ = (value & regs::AGS::kMask) != 0;
    asked_ = !stops && (automatic_ || code == regs::kInstrCdm0 || code == regs::kInstrCdm1 ||
                        code == regs::kInstrCdmNotCdssel);
    if (asked_) take();  // its frame may never begin
  }
  void take() {
    if (!changed_) return;
    changed_ = false;
    told_ = true;
    taken_ = now_;
  }

  WrittenSetup now_;
  WrittenSetup taken_;
  bool told_ = false;
  bool changed_ = true;     // now_ is not taken_
  bool asked_ = false;      // an instruction for words whose frame has not begun
  bool automatic_ = false;  // AGS
  std::vector<std::uint8_t> opcodes_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_SETUP_WATCH_HPP_
