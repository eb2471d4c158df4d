// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Position and speed of the master: it adds up second differences, guesses the missing ones, and
// finds its absolute position by the safe position that comes with every eight frames.
//
// Alignment has four phases, one at each end of a vertical frame: the position is set, then speed
// and position are corrected, then nothing, then both have to agree. While it is aligned and
// `recover` is on, a single missing word is repaired by the next safe position alone: not one that
// the encoder has marked, because its words behind it may only lead the sum back to the truth.
#ifndef MB4SIM_DSL_MODEL_MOTION_HPP_
#define MB4SIM_DSL_MODEL_MOTION_HPP_

#include <array>
#include <cstdint>
#include <optional>

namespace mb4::sim::dsl_model {

struct MotionRules {
  bool recover = true;
  unsigned stale_limit = 2;  // vertical frames without a safe position; 0: no limit
};

// The guess for a missing second difference from those before it, the last one first. It needs six.
int estimate(const std::array<int, 6>& last);

class Motion {
 public:
  explicit Motion(const MotionRules& rules) : rules_(rules) {}

  // A link begins with an encoder of this width, 8 to 40 bits.
  void start(unsigned position_bits);
  // A frame, with its second difference if the word was good. `marked`: the encoder has none.
  void frame(std::optional<int> acceleration, bool marked = false);
  // The end of a vertical frame, after its last frame(), with its safe position if that is valid.
  void vertical_end(std::optional<std::uint64_t> safe);

  // The position is not certain.
  bool lost() const { return lost_; }
  std::uint64_t position() const { return fast_; }
  int speed() const { return speed_; }  // 24 bits, signed
  unsigned phase() const { return phase_; }
  // At the last end of a vertical frame safe and fast position should have agreed, and did not.
  bool disagreed() const { return disagreed_; }
  // Words missing one after another.
  unsigned missing() const { return missing_; }

 private:
  static constexpr unsigned kAligned = 3;

  std::uint64_t masked(std::uint64_t position) const { return position & mask_; }
  std::int64_t as_signed(std::uint64_t position) const;
  void add_speed(std::int64_t speed);
  void lose();
  void align(std::uint64_t safe);
  void recover(std::optional<std::uint64_t> safe);

  MotionRules rules_;
  std::uint64_t mask_ = 0;
  unsigned bits_ = 0;
  std::array<int, 6> last_{};  // second differences, the last one first
  int speed_ = 0;
  std::uint64_t fast_ = 0;
  std::uint64_t since_ = 0;  // moved since the last end of a vertical frame
  bool lost_ = true;
  unsigned phase_ = 0;
  bool disagreed_ = false;
  std::uint64_t kept_ = 0;  // phase 0's position, for phase 1
  unsigned missing_ = 0;
  unsigned stale_ = 0;  // vertical frames without a safe position, one after another
  // A loss is open: frames since it with its own, and up to the end of its vertical frame.
  unsigned lost_frames_ = 0;
  unsigned lost_first_ = 0;
  std::uint64_t lost_position_ = 0;
};

}  // namespace mb4::sim::dsl_model

#endif  // MB4SIM_DSL_MODEL_MOTION_HPP_
