// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Arithmetic on positions: sign, Gray code, turns. No function uses a chip. `Info` is the driver's
// (result.hpp); its codes include kInvalidArgument and kJump.

#ifndef ENC_POSITION_HPP_
#define ENC_POSITION_HPP_

#include <cstdint>

#include "enc/result.hpp"

namespace enc {

inline constexpr std::uint8_t kMaxPositionBits = 64;

// The low `bits` (0..64) bits set.
[[nodiscard]] constexpr std::uint64_t low_bits(std::uint8_t bits) {
  return bits == 0 ? 0 : ~std::uint64_t{0} >> (kMaxPositionBits - bits);
}

// A position of `bits` (1..64) bits as two's complement: -2^(bits-1) to 2^(bits-1) - 1. Higher bits
// are ignored. For encoders whose zero is in the middle of their range.
[[nodiscard]] constexpr std::int64_t to_signed(std::uint64_t position, std::uint8_t bits) {
  const std::uint64_t low = position & low_bits(bits);
  if (bits == kMaxPositionBits) {
    return static_cast<std::int64_t>(low);
  }
  const std::uint64_t half = std::uint64_t{1} << (bits - 1U);
  return low < half ? static_cast<std::int64_t>(low)
                    : -1 - static_cast<std::int64_t>(low_bits(bits) - low);
}

// Gray code to binary. BiSS data is binary; SSI encoders often send Gray code.
[[nodiscard]] constexpr std::uint64_t gray_to_binary(std::uint64_t gray) {
  for (unsigned shift = 1; shift < kMaxPositionBits; shift *= 2) {
    gray ^= gray >> shift;
  }
  return gray;
}

// Binary to Gray code.
[[nodiscard]] constexpr std::uint64_t binary_to_gray(std::uint64_t binary) {
  return binary ^ (binary >> 1);
}

// Whole turns and the angle within the turn.
struct Turns {
  std::uint64_t multi = 0;   // counter of turns, as the encoder sends it
  std::uint64_t single = 0;  // 0..2^single_bits - 1
};

// Splits a position of an encoder that sends the turns first (BiSS profile BP3 and most others):
// `single_bits` (0..63) low bits are the angle, the next `multi_bits` are the turns, together
// 1..64. Higher bits are ignored. kInvalidArgument for other numbers of bits.
template <typename Info>
[[nodiscard]] constexpr Result<Turns, Info> split_turns(std::uint64_t position,
                                                        std::uint8_t multi_bits,
                                                        std::uint8_t single_bits) {
  if (single_bits >= kMaxPositionBits || multi_bits + single_bits < 1 ||
      multi_bits + single_bits > kMaxPositionBits) {
    return Info(decltype(Info::code)::kInvalidArgument);
  }
  Turns turns;
  turns.single = position & low_bits(single_bits);
  turns.multi = (position >> single_bits) & low_bits(multi_bits);
  return turns;
}

// Extends a position across the roll-over of the encoder: a 17-bit single-turn encoder gives a
// position over any number of turns. The encoder must move less than half its range between two
// calls. It uses no heap and no clock; one object serves one encoder.
//
//   PositionTracker tracker(26);     // a driver names its own PositionTracker<Info>
//   if (reading) total = tracker.update(reading->position);   // never a position whose nE is 0
template <typename Info>
class PositionTracker {
  using Error = decltype(Info::code);

 public:
  // `bits`: length of the position, 1..64. `max_step`: largest allowed step between two calls, 1 to
  // 2^(bits-1) - 1; 0 = 2^(bits-1) - 1. A smaller value finds more jumps. update() reports values
  // that are out of range.
  constexpr explicit PositionTracker(std::uint8_t bits, std::uint64_t max_step = 0)
      : max_step_(max_step), bits_(bits) {}

  // Returns the total position. The first call returns `position` itself (unsigned). kJump: the
  // position has moved more than max_step, or the total does not fit 64 bits. The tracker keeps its
  // state on an error, so one bad position does no harm. Call reset() after a pause in which turns
  // may be lost. kInvalidArgument: bits or max_step is out of range, or `position` has more than
  // `bits` bits.
  [[nodiscard]] constexpr Result<std::int64_t, Info> update(std::uint64_t position) {
    if (bits_ < 1 || bits_ > kMaxPositionBits || max_step_ > low_bits(bits_) / 2 ||
        (position & ~low_bits(bits_)) != 0) {
      return Error::kInvalidArgument;
    }
    if (!started_) {
      started_ = true;
      total_ = static_cast<std::int64_t>(position);
      last_ = position;
      return total_;
    }
    const std::uint64_t up = (position - last_) & low_bits(bits_);
    const std::uint64_t down = (last_ - position) & low_bits(bits_);
    const bool downward = down < up;
    const std::uint64_t step = downward ? down : up;
    // Half the range exactly could be a step up or down, so it is a jump.
    const std::uint64_t limit = max_step_ != 0 ? max_step_ : low_bits(bits_) / 2;
    if (step > limit) {
      return Error::kJump;
    }
    const std::int64_t signed_step = static_cast<std::int64_t>(step);
    if (downward ? total_ < kLowest + signed_step : total_ > kHighest - signed_step) {
      return Error::kJump;
    }
    total_ = downward ? total_ - signed_step : total_ + signed_step;
    last_ = position;
    return total_;
  }

  // The next update() begins anew.
  constexpr void reset() { started_ = false; }

 private:
  static constexpr std::int64_t kHighest = static_cast<std::int64_t>(low_bits(63));
  static constexpr std::int64_t kLowest = -kHighest - 1;

  std::uint64_t last_ = 0;
  std::uint64_t max_step_;
  std::int64_t total_ = 0;
  std::uint8_t bits_;
  bool started_ = false;
};

}  // namespace enc

#endif  // ENC_POSITION_HPP_
