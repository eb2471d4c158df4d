// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A device on a duplex line: a Slave with a transceiver on the one wire. It alone knows what a
// frame is, because such a line need never rest.
#ifndef MB4SIM_DUPLEX_SLAVE_HPP_
#define MB4SIM_DUPLEX_SLAVE_HPP_

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "sim/core/random.hpp"
#include "sim/core/time.hpp"
#include "sim/lines/flip_watch.hpp"
#include "sim/lines/slave.hpp"

namespace mb4::sim {

class DuplexLine;

// What the transceiver of one end drives. While the driver is off the level has no meaning.
struct DuplexDrive {
  bool level = true;
  bool enable = false;

  bool operator==(const DuplexDrive&) const = default;
};

// Bits that are wrong at random, each with the same chance.
class BitErrors {
 public:
  BitErrors() = default;
  BitErrors(double chance, std::uint64_t seed)
      : random_(seed), limit_(static_cast<std::uint64_t>(chance * 0x1p64)) {}
  bool next_is_wrong() { return limit_ != 0 && random_.next() < limit_; }

 private:
  Random random_{0};
  std::uint64_t limit_ = 0;  // of 2^64
};

class DuplexSlave : public Slave {
 public:
  // The level that the receiver at this end sees has changed. It also sees what this end drives.
  virtual void line_changed(Time now, bool level) = 0;
  // The time of call_at() has come.
  virtual void timer(Time /*now*/, std::uint64_t /*word*/) {}
  // True while the device waits for a frame.
  virtual bool idle() const = 0;

  DuplexDrive drive() const { return drive_; }
  // The inverted bits of frame `frame` of this device; several calls add up. The device says what
  // the bits count. `watch` is told when it takes them.
  void flip(std::uint64_t frame, const std::vector<unsigned>& bits, FlipWatch watch = {}) {
    flips_.add(frame, bits, watch);
  }
  // Number of frames that have begun.
  std::uint64_t begun() const { return begun_; }
  // Number of frames that flip() has counted: all of them, unless a device counts its own way.
  virtual std::uint64_t flip_frames() const { return begun_; }

 protected:
  // Its transceiver: the level goes out as long as the driver is on.
  void set_drive(Time now, DuplexDrive drive);
  // A call of timer() at `time`, with this word. The device must be on a line.
  void call_at(Time time, std::uint64_t word);
  // A frame begins, with the bits that are to be inverted in it; it is over. A frame that begins
  // before the last one is over has ended it.
  std::vector<unsigned> begin_frame(Time now);
  // `edges`: what mb4sim_frame counts, if not the edges at the device. `end` may lie in the past
  // for a device that sees the end late, but not before the last frame that it has told of.
  void end_frame(Time end, std::optional<std::uint64_t> edges = std::nullopt);
  // The same two steps for a device that recognises a frame late: `start` may lie in the past, and
  // the bits to invert are asked for by the number that the device gives the frame.
  void announce_frame(Time start);
  std::vector<unsigned> take_flips(std::uint64_t frame) { return flips_.take(frame); }

  // Of the transceiver at this end: from the pin to a driver that is on, and off.
  Time enable_time() const;
  Time disable_time() const;
  // Draws whether a bit is wrong, as the scenario wants it: one that this end sends, one that it
  // takes. Each bit is drawn once.
  bool wrong_answer_bit() { return errors_.answer.next_is_wrong(); }
  bool wrong_master_bit() { return errors_.master.next_is_wrong(); }

 private:
  friend class DuplexLine;

  DuplexLine* line_ = nullptr;
  DuplexDrive drive_;
  std::uint64_t begun_ = 0;
  PlannedFlips flips_;
  struct {
    BitErrors answer;
    BitErrors master;
  } errors_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_DUPLEX_SLAVE_HPP_
