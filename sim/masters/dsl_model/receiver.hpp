// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What the master makes of its samples: eight of each bit, in slots that begin RX_START ticks after
// the driver is off. It learns where the answer is, and takes the 61 bits of an answer. Three
// rules:
//
//   published    the number of ones in the first slot that is not all ones places the edge; with
//                four ones or more in slot 10 the last sample of the slot is taken
//   first zero   the first 0 places the edge
//   tracking     the first 0 of the first frame; then each frame moves the place by the mean
//                distance of its edges from where they should be
#ifndef MB4SIM_DSL_MODEL_RECEIVER_HPP_
#define MB4SIM_DSL_MODEL_RECEIVER_HPP_

#include <array>
#include <cstdint>
#include <optional>

namespace mb4::sim::dsl_model {

inline constexpr unsigned kAnswerBits = 61;

// The bits of an answer, the first one is bit 60.
using Answer = std::uint64_t;
// What the encoder sends while the line is trained; bit 50 of the line, between the two safe
// channels, is 0.
inline constexpr Answer kTestPattern =
    0b0100110011'0010000001'0001010111'0111111011'0011001101'0'0010011001;

enum class SampleRule { kPublished, kFirstZero, kTracking };

// Strength of the line by the edges in a slot, a bit for each sample that differs from the one
// before: 12 is good. `table`: 12 where the rule gives 0.
unsigned rssi_of(std::uint8_t edges, bool table);

class Receiver {
 public:
  static constexpr unsigned kSlots = 72;
  static constexpr unsigned kSamples = kSlots * 8;
  static constexpr unsigned kBestRssi = 12;

  Receiver(SampleRule rule, bool rssi_table) : rule_(rule), rssi_table_(rssi_table) {}

  // --- one window: begin(), kSamples times take(), then the calls below --------------------------
  void begin() { count_ = 0; }
  bool full() const { return count_ == kSamples; }
  void take(bool level) { samples_[count_++] = level; }

  // --- training ----------------------------------------------------------------------------------
  // Before the first frame that is to be learned.
  void forget();
  // A START frame. False: the encoder was not found, or not where a 61-bit answer fits.
  bool learn();
  // The window holds the test pattern at the learned place; its edges are collected.
  bool matches();

  // --- answers -----------------------------------------------------------------------------------
  // `linked`: a link is there, which keeps the place from moving far.
  Answer answer(bool linked);
  // Of that answer.
  unsigned rssi() const { return frame_rssi_; }

  // Whole bits that were dropped before the first one of the answer, and the sample of its slots.
  unsigned delay() const { return place_of_bit() / 8; }
  unsigned eighth() const { return place_of_bit() % 8; }
  // Number of a sample with five fractional bits; for tracking the learned edge.
  unsigned place() const { return place_; }
  std::uint8_t edges() const { return edges_; }  // of LEARN and CHECK frames

 private:
  static constexpr unsigned kFraction = 5;
  static constexpr unsigned kMinDelay = 1;
  static constexpr unsigned kMaxDelay = 11;

  unsigned place_of_bit() const;
  Answer bits_from(unsigned sample) const;
  std::optional<unsigned> first_zero() const;
  bool fits() const { return delay() >= kMinDelay && delay() <= kMaxDelay; }
  bool learn_by_search();
  enum class Window { kTraining, kIdentity, kLinked };
  void track(Window window);
  std::uint8_t edges_of(unsigned slot) const;

  SampleRule rule_;
  bool rssi_table_;
  std::array<bool, kSamples> samples_{};
  unsigned count_ = 0;
  bool learning_ = false;  // the first START frame has been seen
  unsigned place_ = 0;     // of the first edge; << kFraction
  unsigned sample_ = 0;    // of the first bit, for the two rules without tracking
  std::uint8_t edges_ = 0;
  unsigned frame_rssi_ = kBestRssi;
};

}  // namespace mb4::sim::dsl_model

#endif  // MB4SIM_DSL_MODEL_RECEIVER_HPP_
