// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/dsl_model/motion.hpp"

#include <algorithm>

namespace mb4::sim::dsl_model {
namespace {

constexpr int kMinAcceleration = -1024;
constexpr int kMaxAcceleration = 1023;
constexpr std::int64_t kMaxSpeedError = 2047;

// The lowest `bits` bits as a signed number.
std::int64_t low_signed(std::int64_t value, unsigned bits) {
  const unsigned shift = 64 - bits;
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(value) << shift) >> shift;
}

}  // namespace

// The newest change weighs half, each older one half of that. The sum has 16 bits.
int estimate(const std::array<int, 6>& last) {
  int sum = 0;
  for (unsigned i = 0; i < 5; ++i) sum += (last[i] - last[i + 1]) * (16 >> i);
  const auto change = static_cast<int>(low_signed(sum, 16) >> 5);
  return std::clamp(last[0] + change, kMinAcceleration, kMaxAcceleration);
}

void Motion::start(unsigned position_bits) {
  *this = Motion(rules_);
  bits_ = position_bits;
  mask_ = (std::uint64_t{1} << position_bits) - 1;
}

std::int64_t Motion::as_signed(std::uint64_t position) const {
  return low_signed(static_cast<std::int64_t>(position), bits_);
}

void Motion::add_speed(std::int64_t speed) {
  speed_ = static_cast<int>(low_signed(speed_ + speed, 24));
}

void Motion::frame(std::optional<int> acceleration, bool marked) {
  const int a = acceleration ? *acceleration : estimate(last_);
  std::move_backward(last_.begin(), last_.end() - 1, last_.end());
  last_[0] = a;
  add_speed(a);
  fast_ = masked(fast_ + static_cast<std::uint64_t>(std::int64_t{speed_}));
  since_ += static_cast<std::uint64_t>(std::int64_t{speed_});
  if (lost_frames_ != 0) ++lost_frames_;
  if (acceleration) {
    missing_ = 0;
    return;
  }
  ++missing_;
  if (rules_.recover && !marked && phase_ == kAligned && !lost_) {
    lost_ = true;
    lost_frames_ = 1;
    lost_first_ = 0;
  } else {
    lose();
  }
}

// Alignment begins again.
void Motion::lose() {
  lost_ = true;
  phase_ = 0;
  lost_frames_ = 0;
}

void Motion::vertical_end(std::optional<std::uint64_t> safe) {
  stale_ = safe ? 0 : stale_ + 1;
  disagreed_ = false;
  if (lost_frames_ != 0) {
    recover(safe);
  } else if (safe) {
    align(masked(*safe));
  } else if (phase_ == 1 || phase_ == 2) {
    phase_ = 0;
  }
  if (rules_.stale_limit != 0 && stale_ >= rules_.stale_limit) lose();
  since_ = 0;
}

void Motion::align(std::uint64_t safe) {
  const std::uint64_t moved = masked(safe + since_);
  switch (phase_) {
    case 0:
      fast_ = kept_ = moved;
      phase_ = 1;
      break;
    case 1: {
      const std::int64_t wrong = as_signed(masked(safe - kept_));
      add_speed(wrong >> 3);
      fast_ = masked(fast_ + 2 * static_cast<std::uint64_t>(wrong));
      phase_ = 2;
      break;
    }
    case 2:
      phase_ = kAligned;
      break;
    default:
      if (moved == fast_) {
        lost_ = false;
      } else {
        disagreed_ = true;
        lose();
      }
  }
}

// The speed is wrong by the same amount in each frame since the loss, so the position at the end of
// the loss's vertical frame is wrong by a multiple of it. The next safe position is the one there.
void Motion::recover(std::optional<std::uint64_t> safe) {
  if (lost_first_ == 0) {
    lost_first_ = lost_frames_;
    lost_position_ = fast_;
    return;
  }
  if (!safe) return lose();
  const std::int64_t wrong = as_signed(masked(*safe - lost_position_));
  const auto frames = static_cast<std::int64_t>(lost_first_);
  const std::int64_t each = wrong / frames;
  if (each * frames != wrong || each < -kMaxSpeedError || each > kMaxSpeedError) return lose();
  add_speed(each);
  fast_ = masked(fast_ + static_cast<std::uint64_t>(each * std::int64_t{lost_frames_}));
  lost_ = false;
  lost_frames_ = 0;
}

}  // namespace mb4::sim::dsl_model
