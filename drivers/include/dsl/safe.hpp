// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The safe positions of a DSL encoder and what a host checks of them: the CRC of each channel, its
// age, the state bits, and one channel against the other. Every bit of the bus answers is covered
// by one of them. No claim of a safety level: the master shows, this code compares, the system
// around it decides. Source: docs/dsl.md, "Safe channels".

#ifndef DSL_SAFE_HPP_
#define DSL_SAFE_HPP_

#include "enc/cpp17.hpp"
#if __cplusplus >= 201703L

#include <cstdint>

#include "dsl/error.hpp"
#include "dsl_page_regs.hpp"
#include "dsl_regs.hpp"
#include "enc/crc.hpp"

namespace dsl {

// What the encoder says of itself (ENC_ID).
struct Encoder {
  std::uint8_t position_bits = 0;      // 8 to 40
  std::uint8_t acceleration_bits = 0;  // 8 to 11
  bool is_signed = false;
};

// The lower two bytes of ENC_ID.
[[nodiscard]] constexpr Encoder encoder_of(std::uint8_t id1, std::uint8_t id0) {
  constexpr unsigned kLeast = 8;  // bits of an acceleration
  const unsigned acceleration = regs::ENC_ACC::get(id0) + kLeast;
  const unsigned more = unsigned{regs::ENC_WIDTH_H::get(id1)} << regs::ENC_WIDTH_L::kWidth |
                        regs::ENC_WIDTH_L::get(id0);
  Encoder encoder;
  encoder.acceleration_bits = static_cast<std::uint8_t>(acceleration);
  encoder.position_bits = static_cast<std::uint8_t>(acceleration + more);
  encoder.is_signed = regs::ENC_SIGNED::get(id1) != 0;
  return encoder;
}

// What the host knows of the encoder, and how much it accepts.
struct SafeRules {
  // Bits of safe position 2, the upper ones of the position; more than the position has are as many
  // as it has. 0: the two are not compared, and only the CRC protects safe position 1.
  std::uint8_t bits2 = 0;
  std::uint8_t tolerance = 0;  // the two may differ by that many steps of safe position 2
  // Frames (11.52 us each) since it came. A new one comes every 8 frames.
  std::uint32_t max_age = 16;
  // Bits of SAFE_STATUS (dsl::page) that make a safe position bad. MISMATCH is computed here.
  std::uint32_t bad_states = 0x7FFE;
};

// One channel as its four words have it.
struct SafeWords {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint32_t check = 0;
  std::uint32_t age = 0;
};

// A safe position that has passed all checks.
struct SafePosition {
  std::int64_t position = 0;  // steps, at the sample one frame before its vertical frame began
  std::uint8_t summary = 0;   // eight groups of states of the encoder; 0: nothing to tell
  bool toggle = false;        // TOG2 of channel 2: it changes with each vertical frame
  std::uint32_t age = 0;      // frames since it came
};

namespace detail {

// Both channels have the same places; the names here are those of the first one.
static_assert(page::SAFE1_HI::kMask == page::SAFE2_HI::kMask &&
              page::SAFE1_GOOD::kMask == page::SAFE2_GOOD::kMask &&
              page::SAFE1_SCE::kMask == page::SAFE2_SCE::kMask &&
              page::SAFE1_SUMMARY::kMask == page::SAFE2_STATUS2::kMask &&
              page::SAFE1_CRC::kMask == page::SAFE2_CRC::kMask);

// Bits 39 to 32, 31 to 0.
[[nodiscard]] constexpr std::uint64_t safe_bits(const SafeWords& words) {
  return std::uint64_t{page::SAFE1_HI::get(words.high)} << 32U | words.low;
}

// The CRC of a vertical frame covers the state byte and the five bytes of the position; its low
// byte is sent inverted.
[[nodiscard]] constexpr bool crc_fits(const SafeWords& words) {
  constexpr std::uint32_t kPolynomial = 0x190D9;
  const std::uint64_t state = page::SAFE1_SUMMARY::get(words.check);
  const std::uint16_t crc = enc::crc(kPolynomial, 0, state << 40U | safe_bits(words), 48);
  return (crc ^ 0x00FFU) == page::SAFE1_CRC::get(words.check);
}

// Good and without an error, as the master says.
[[nodiscard]] constexpr bool is_good(const SafeWords& words) {
  return page::SAFE1_GOOD::get(words.check) != 0 && page::SAFE1_SCE::get(words.check) == 0 &&
         (words.high & ~page::SAFE1_HI::kMask) == 0;
}

// Whether the channels tell the same position. Channel 2 is the inverse of the upper bits.
[[nodiscard]] constexpr bool agree(std::uint64_t first, std::uint64_t second,
                                   const Encoder& encoder, const SafeRules& rules) {
  const unsigned bits1 = encoder.position_bits;
  const unsigned bits2 = rules.bits2 < bits1 ? rules.bits2 : bits1;
  const std::uint64_t mask = (std::uint64_t{1} << bits2) - 1U;
  const std::uint64_t up = ((first >> (bits1 - bits2)) + second + 1U) & mask;
  const std::uint64_t down = (mask + 1U - up) & mask;
  return (up < down ? up : down) <= rules.tolerance;
}

}  // namespace detail

// Checks both channels: kNoSafe, kSafeOld, kSafeCrc, kSafeState, kSafeDiffers. `states`:
// SAFE_STATUS.
[[nodiscard]] constexpr Result<SafePosition> check_safe(const SafeWords& first,
                                                        const SafeWords& second,
                                                        std::uint32_t states,
                                                        const Encoder& encoder,
                                                        const SafeRules& rules) {
  constexpr std::uint32_t kToggle2 = 0x80;
  constexpr std::uint32_t kFix2 = 0x1C;  // of the other bits; TEST2 and ERR2 are 0
  constexpr std::uint32_t kFrames = 8;   // of a vertical frame
  if (!detail::is_good(first) || !detail::is_good(second)) return Error::kNoSafe;
  // Both came with the same vertical frame, and channel 2 was read later: modulo 2^32, a younger
  // one is far away.
  if (first.age > rules.max_age || second.age > rules.max_age ||
      second.age - first.age >= kFrames) {
    return Error::kSafeOld;
  }
  if (!detail::crc_fits(first) || !detail::crc_fits(second)) return Error::kSafeCrc;
  const std::uint32_t status2 = page::SAFE2_STATUS2::get(second.check);
  if ((status2 & ~kToggle2) != kFix2 || (states & rules.bad_states) != 0) return Error::kSafeState;
  const std::uint64_t bits = detail::safe_bits(first);
  if (rules.bits2 != 0 && !detail::agree(bits, detail::safe_bits(second), encoder, rules))
    return Error::kSafeDiffers;
  constexpr unsigned kAbove = 64 - 40;
  SafePosition safe;
  safe.position = encoder.is_signed ? static_cast<std::int64_t>(bits << kAbove) >> kAbove
                                    : static_cast<std::int64_t>(bits);
  safe.summary = static_cast<std::uint8_t>(page::SAFE1_SUMMARY::get(first.check));
  safe.toggle = (status2 & kToggle2) != 0;
  safe.age = first.age;
  return safe;
}

// TOG2 over the safe positions that a host has read: it has changed once for each vertical frame.
class ToggleWatch {
 public:
  // `frame`: Position::frame of a position that was read within two frames of the safe one. False:
  // the bit is not what the number of vertical frames makes it. The first call after a link has
  // begun, see restart(), only takes the bit.
  constexpr bool fits(const SafePosition& safe, std::uint32_t frame) {
    const std::uint32_t came = frame - safe.age;
    const std::uint32_t steps = (came - came_ + 4U) / 8U;
    const bool fits = !known_ || safe.toggle == (toggle_ != ((steps & 1U) != 0));
    known_ = true;
    came_ = came;
    toggle_ = safe.toggle;
    return fits;
  }
  // The link has begun anew.
  constexpr void restart() { known_ = false; }

 private:
  bool known_ = false;
  bool toggle_ = false;
  std::uint32_t came_ = 0;
};

}  // namespace dsl

#endif  // __cplusplus >= 201703L

#endif  // DSL_SAFE_HPP_
