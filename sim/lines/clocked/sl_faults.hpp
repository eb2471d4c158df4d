// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Deliberate faults of one line: inverted bits in a frame, and a data line that is stuck.
#ifndef MB4SIM_SL_FAULTS_HPP_
#define MB4SIM_SL_FAULTS_HPP_

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/lines/flip_watch.hpp"

namespace mb4::sim {

class SlFaults {
 public:
  // Inverts these bits of the next frame that reaches its start bit. Bits are counted on the wire
  // in periods of MA: 0 = start bit, 1 = CDS, 2 = first data bit (MSB of slave 1), and so on
  // through the CRC and the next slaves. Several calls add up. BiSS B has no CDS: 1 = first data
  // bit, and a register access counts as a frame. SSI has no start bit either: 0 = first data bit.
  void flip_next_frame(std::vector<unsigned> bits);
  // The same in frame number `frame` of the line. Frames count from 1, as in Slave::frames(). The
  // frame must not have come yet. `watch` is told when it has.
  void flip_frame(std::uint64_t frame, const std::vector<unsigned>& bits, FlipWatch watch = {});
  // Number of frames of the line that have reached their start bit.
  std::uint64_t frames() const { return frames_; }
  // Sets the level of pin SL, whatever the slaves send. Without a value the line works again. The
  // call takes effect at the next change on the line or with Simulator::refresh_lines().
  void stick(std::optional<bool> level) { stuck_ = level; }
  std::optional<bool> stuck() const { return stuck_; }

  // The line has no start bit (SSI): a frame begins with the first rising edge of MA.
  void set_no_start_bit() { start_bit_ = false; }

  // --- used by Line --------------------------------------------------------------------------
  // True if the frame has reached its start bit and no bit of it is inverted. Then levels() has
  // nothing to do before the slaves are idle.
  bool only_counts() const { return counting_ && pending_.empty(); }
  void count_bit() { ++bit_; }
  // MA rises at the slaves.
  void rising_edge() {
    if (counting_) {
      ++bit_;
      update();
    } else if (!start_bit_ && acknowledged_) {
      begin_frame();
    }
  }
  // Called after each change at the slaves.
  void levels(bool slo, bool idle) {
    if (idle) {
      if (acknowledged_) end_frame();
    } else if (!acknowledged_) {
      acknowledged_ = !start_bit_ || !slo;
    } else if (!counting_ && slo && start_bit_) {
      begin_frame();
    }
  }
  bool wire(bool slo) const { return slo != flip_now_; }

 private:
  void begin_frame();
  void end_frame();
  void update() { flip_now_ = !pending_.empty() && is_pending(bit_); }
  bool is_pending(unsigned bit) const;

  bool start_bit_ = true;
  std::vector<unsigned> pending_;
  PlannedFlips planned_;
  std::uint64_t frames_ = 0;  // that have reached their start bit
  std::optional<bool> stuck_;
  bool acknowledged_ = false;
  bool counting_ = false;
  unsigned bit_ = 0;
  bool flip_now_ = false;
};

}  // namespace mb4::sim

#endif  // MB4SIM_SL_FAULTS_HPP_
