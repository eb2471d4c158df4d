// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The status registers as one snapshot (datasheet pages 34, 35).

#ifndef MB4_STATUS_HPP_
#define MB4_STATUS_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4_regs.hpp"

namespace mb4 {

// SVALIDx of slave 1..8 in Status::valid_flags().
[[nodiscard]] constexpr std::uint16_t flag_of(std::uint8_t slave) {
  return static_cast<std::uint16_t>(std::uint32_t{1} << (2U * slave - 1U));
}

// 0xF0..0xF4 as read in one SPI frame. The names state the active meaning: `scd_error()` is true
// when nSCDERR is 0.
class Status {
 public:
  static constexpr std::size_t kBytes = regs::kAddrInstr - regs::kAddrStatus0 + 1;

  constexpr Status() = default;
  explicit constexpr Status(const std::array<std::uint8_t, kBytes>& bytes) : bytes_(bytes) {}

  // Value of any field of 0xF0..0xF4, right aligned.
  template <typename Field>
  [[nodiscard]] constexpr std::uint8_t get() const {
    static_assert(Field::kAddress >= regs::kAddrStatus0 && Field::kAddress <= regs::kAddrInstr,
                  "mb4: this field is not part of the status snapshot");
    return Field::get(bytes_[Field::kAddress - regs::kAddrStatus0]);
  }

  // No frame, register access or INIT is running (EOT = 1).
  [[nodiscard]] constexpr bool idle() const { return get<regs::EOT>() == 1; }
  // No instruction waits for its frame or is being executed (INSTR = 0).
  [[nodiscard]] constexpr bool instruction_done() const { return get<regs::INSTR>() == 0; }
  // A frame could not be started (nAGSERR = 0). Page 34 can be read so that a chip sets nAGSERR = 0
  // at each write of 0xF4. On such a chip this is true after every request, also of a good frame.
  [[nodiscard]] constexpr bool start_error() const { return get<regs::nAGSERR>() == 0; }
  // A CRC of the last frame was wrong (nSCDERR = 0).
  [[nodiscard]] constexpr bool scd_error() const { return get<regs::nSCDERR>() == 0; }
  // The control communication has ended (REGEND = 1), with or without success.
  [[nodiscard]] constexpr bool control_ended() const { return get<regs::REGEND>() == 1; }
  // control_error(): the last control communication has failed (nREGERR = 0). delay_error(): the
  // slave's start bit did not come (nDELAYERR = 0).
  [[nodiscard]] constexpr bool control_error() const { return get<regs::nREGERR>() == 0; }
  [[nodiscard]] constexpr bool delay_error() const { return get<regs::nDELAYERR>() == 0; }
  // NER is low (nERR = 0): one of the chip's errors, or another device on that pin.
  [[nodiscard]] constexpr bool ner_low() const { return get<regs::nERR>() == 0; }
  // SVALIDx of `slave` (1..8, not checked), of the bank that the host reads.
  [[nodiscard]] constexpr bool valid(std::uint8_t slave) const {
    return (bytes_[regs::kFamilySvalid.address(slave) - regs::kAddrStatus0] &
            regs::kFamilySvalid.mask(slave)) != 0;
  }

  // 0xF2 and 0xF1, high and low byte: SVALIDx of slave x is bit 2 x - 1 (flag_of()).
  [[nodiscard]] constexpr std::uint16_t valid_flags() const {
    return static_cast<std::uint16_t>(bytes_[1] | bytes_[2] << 8);
  }
  // SVALIDx of all slaves; bit 0 is slave 1.
  [[nodiscard]] constexpr std::uint8_t valid_mask() const {
    // Bits 7, 5, 3, 1 of each register.
    static_assert(regs::kFamilySvalid.lsb == 1 && regs::kFamilySvalid.lsb_step == 2 &&
                  regs::kFamilySvalid.per_register == 4);
    unsigned bits = unsigned{valid_flags()} >> 1U;
    bits = (bits & 0x1111U) | (bits & 0x4444U) >> 1U;
    bits = (bits & 0x0303U) | (bits & 0x3030U) >> 2U;
    return static_cast<std::uint8_t>((bits & 0x0FU) | (bits & 0x0F00U) >> 4U);
  }
  // The reverse of valid_mask(): 0xF2 and 0xF1 (high and low byte) for a mask of slaves.
  [[nodiscard]] static constexpr std::uint16_t valid_registers(std::uint8_t mask) {
    unsigned bits = (mask & 0x0FU) | (mask & 0xF0U) << 4U;
    bits = (bits & 0x0303U) | (bits & 0x0C0CU) << 2U;
    bits = (bits & 0x1111U) | (bits & 0x2222U) << 1U;
    return static_cast<std::uint16_t>(bits << 1U);
  }

  // The constant bits (table 6, page 22) read as they must: bit 1 of 0xF0 is 1, bits 0, 2, 4, 6 of
  // 0xF1 and 0xF2 are 0. False for MISO stuck at 0 or at 1, also for the last byte alone: no chip
  // has all instructions of 0xF4 at once, but a bus that has not stored this byte leaves 0xFF.
  [[nodiscard]] constexpr bool plausible() const {
    static_assert((regs::kResetStatus0 & regs::kConstStatus0) == regs::kConstStatus0);
    static_assert((regs::kResetSvalidLo & regs::kConstSvalidLo) == 0);
    static_assert((regs::kResetSvalidHi & regs::kConstSvalidHi) == 0);
    return (bytes_[0] & regs::kConstStatus0) != 0 &&
           (bytes_[regs::kAddrSvalidLo - regs::kAddrStatus0] & regs::kConstSvalidLo) == 0 &&
           (bytes_[regs::kAddrSvalidHi - regs::kAddrStatus0] & regs::kConstSvalidHi) == 0 &&
           instruction() != 0xFF;
  }

  // The byte of 0xF4: the instruction bits that have not returned to 0, HOLDBANK, AGS.
  [[nodiscard]] constexpr std::uint8_t instruction() const { return bytes_[kBytes - 1]; }

  [[nodiscard]] constexpr const std::array<std::uint8_t, kBytes>& bytes() const { return bytes_; }

 private:
  std::array<std::uint8_t, kBytes> bytes_{};
};

}  // namespace mb4

#endif  // MB4_STATUS_HPP_
