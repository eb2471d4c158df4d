// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Compares the registers of the configuration with what was written.

#ifndef MB4_DETAIL_VERIFICATION_HPP_
#define MB4_DETAIL_VERIFICATION_HPP_

#include <cstdint>

#include "mb4/detail/image_writer.hpp"
#include "mb4/detail/procedures.hpp"

namespace mb4::detail {

// Three frames, one a step. The last registers come first, because VERSION is among them: without a
// chip every register differs, and kVerify would say less.
inline constexpr std::uint8_t kFirstCompared = 0xE4;
inline constexpr std::uint8_t kPartCompared = Operation::kMaxFrameBytes - 2;
static_assert(kFirstCompared + kPartCompared == regs::kAddrIface + 1);
static_assert(kImageFirst + 2 * kPartCompared == kFirstCompared);

// Compares the registers that configure() has written with what the chip holds. kTransport,
// kNotDetected, kVerify; after the last two the chip counts as not configured.
inline void Procedures::plan_verify(ChipState& chip, Operation& op) {
  begin(chip, op, verify_step, false);
  op.at_ = kFirstCompared;
  add_read(op, kFirstCompared, kPartCompared);
  mb4_plan_rx(&op.plan_, 0)[2 + regs::kAddrVersion - kFirstCompared] = 0;
}

inline Result<void> Procedures::verify_step(ChipState& chip, Operation& op,
                                            std::uint32_t /*now_us*/) {
  if (!op.good_ || !chip.configured) {
    return op.good_ ? Error::kWrongMode : Error::kTransport;
  }
  const std::uint8_t* is = received(op) + 2;
  const std::uint8_t* want = chip.image.data() + (op.at_ - kImageFirst);
  const bool first = op.at_ == kFirstCompared;
  if (first && is[regs::kAddrVersion - kFirstCompared] !=
                   static_cast<std::uint8_t>(regs::DeviceVersion::kIcMb4)) {
    chip.configured = false;
    return Error::kNotDetected;
  }
  // Status and instruction, 0xF0..0xF4, end the last part but 0xF5.
  const unsigned size = first ? unsigned{regs::kAddrStatus0 - kFirstCompared} : kPartCompared;
  for (unsigned i = 0; i < size; ++i) {
    if (is[i] != want[i] && is_compared(op.at_ + i, true)) {
      chip.configured = false;
      return ErrorInfo::at_register(Error::kVerify, static_cast<std::uint8_t>(op.at_ + i));
    }
  }
  if (first && is[kPartCompared - 1] != encode_interface(chip.config)) {
    chip.configured = false;
    return ErrorInfo::at_register(Error::kVerify, regs::kAddrIface);
  }
  op.at_ = first ? std::uint32_t{kImageFirst} : op.at_ + kPartCompared;
  if (op.at_ != kFirstCompared) {
    add_read(op, static_cast<std::uint8_t>(op.at_), kPartCompared);
  }
  return {};
}

}  // namespace mb4::detail

#endif  // MB4_DETAIL_VERIFICATION_HPP_
