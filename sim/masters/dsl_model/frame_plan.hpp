// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// An H-frame as the master sends it: one entry for each bit, in eighths, and where the answer is.
// The fields: SYNC 001011, SAMPLE 110, CYCLE RESET 110, EQUALISATION, M_PAR, SWITCH with the answer
// window, TRAILER 00000011, stuffing. The master samples the position at the falling edge in
// SAMPLE.
#ifndef MB4SIM_DSL_MODEL_FRAME_PLAN_HPP_
#define MB4SIM_DSL_MODEL_FRAME_PLAN_HPP_

#include <cstdint>

namespace mb4::sim::dsl_model {

// The lowest five bits of M_PAR.
enum Symbol : std::uint8_t {
  kIdle = 0x10,
  kSync = 0x19,
  kStart = 0x1A,
  kLearn = 0x1B,
  kCheck = 0x1C,
  kIdRequest = 0x1D,
  kInit = 0x1E,
  kReset = 0x1F,
};
inline constexpr unsigned kFirstBit = 0x80;     // first: of each frame after the training
inline constexpr unsigned kVerticalBit = 0x40;  // msync

inline constexpr unsigned kTicksPerBit = 8;
inline constexpr unsigned kFrameBits = 108;  // without extra ones and stuffing
inline constexpr unsigned kWindowBits = 74;  // SWITCH and what the encoder may use
inline constexpr unsigned kBlockBits = 6;    // of stuffing
inline constexpr unsigned kMaxBlocks = 26;
inline constexpr unsigned kMaxExtra = 16;

// What the plan of a frame says besides its symbol.
struct FrameShape {
  unsigned extra = 0;   // whole ones before the edge of SAMPLE
  unsigned rest = 0;    // ... and eighths, 0 to 7
  unsigned blocks = 0;  // of stuffing
};

// Decides EQUALISATION from the disparity, which it changes. A pattern's first bit is bit 3.
unsigned equalise(int& disparity);

class FramePlan {
 public:
  static constexpr unsigned kMaxBits = kFrameBits + kMaxExtra + 1 + kMaxBlocks * kBlockBits;

  // Makes a frame. `answer`: the window is the encoder's; else the master fills it with 0101... The
  // counter goes on as the equaliser needs it: `added` is what the plan of a sync mode adds to it.
  void make(unsigned parameter, bool answer, const FrameShape& shape, int& disparity,
            int added = 0);
  // Not a frame: the driver is off for 16 bits and sends 16 zeros.
  void make_gap();
  // The frame ends with its trailer.
  void drop_stuffing() { bits_ = trailer_end_; }

  unsigned bits() const { return bits_; }
  // The level in eighth `eighth` of a bit.
  bool level(unsigned bit, unsigned eighth) const {
    return (eighths_[bit] >> (7 - eighth) & 1U) != 0;
  }
  // The same level in all eighths.
  bool whole(unsigned bit) const { return eighths_[bit] == 0 || eighths_[bit] == 0xFF; }
  bool drives(unsigned bit) const { return drives_[bit]; }
  unsigned sample_tick() const { return sample_tick_; }  // of the edge in SAMPLE, from the begin
  unsigned switch_bit() const { return switch_bit_; }
  unsigned trailer_bit() const { return switch_bit_ + kWindowBits; }
  unsigned equalisation() const { return equalisation_; }
  unsigned parameter_word() const { return parameter_word_; }

 private:
  void put(bool level, bool drives = true);
  void put_bits(unsigned bits, unsigned count);

  std::uint8_t eighths_[kMaxBits] = {};
  bool drives_[kMaxBits] = {};
  unsigned bits_ = 0;
  unsigned trailer_end_ = 0;
  unsigned sample_tick_ = 0;
  unsigned switch_bit_ = 0;
  unsigned equalisation_ = 0;
  unsigned parameter_word_ = 0;
};

}  // namespace mb4::sim::dsl_model

#endif  // MB4SIM_DSL_MODEL_FRAME_PLAN_HPP_
