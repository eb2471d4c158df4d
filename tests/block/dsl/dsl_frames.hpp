// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Answers for the blocks behind the line of the DSL master: what stands in a frame, and the port
// that it comes by.
#ifndef TESTS_BLOCK_DSL_DSL_FRAMES_HPP_
#define TESTS_BLOCK_DSL_DSL_FRAMES_HPP_

#include <array>
#include <cstdint>

#include "places.hpp"
#include "sim/masters/dsl_model/line_code.hpp"
#include "sim/masters/dsl_model/link.hpp"
#include "tests/block/dsl/dsl_quirks.hpp"
#include "tests/support/dice.hpp"

namespace dsl_frames {

using namespace mb4::sim::dsl_model;
namespace at = mb4test::places::dsl_pkg;
using mb4test::quirks_of;

// The words of a frame as they come: vertical, S_PAR, pipeline, two of the acceleration, secondary.
enum Place : unsigned { kVertical, kParameter, kPipeline, kHigh, kLow, kSecondary, kWords };
using Words = std::array<Word, kWords>;

inline Word byte_word(unsigned byte) { return {.byte = static_cast<std::uint8_t>(byte)}; }

inline void set_acceleration(Words& words, unsigned word) {
  words[kHigh] = byte_word(word >> 8U & 0xFFU);
  words[kLow] = byte_word(word & 0xFFU);
}

inline AnswerWords answer_of(const Words& words) {
  return {.vertical = words[kVertical],
          .parameter = words[kParameter],
          .pipeline = words[kPipeline],
          .acceleration_high = words[kHigh],
          .acceleration_low = words[kLow],
          .secondary = words[kSecondary]};
}

// Makes a word what a bad line, or an encoder with a fault, could send.
inline void spoil(Word& word, mb4test::Dice& random) {
  switch (random.below(6)) {
    case 0:
      word.error = true;
      break;
    case 1:
      word.error = word.special = true;
      break;
    case 2:
      word = {.byte = kMarker1, .special = true};
      break;
    case 3:
      word = {.byte = static_cast<std::uint8_t>(random.below(8) << 5U | 28U), .special = true};
      break;
    case 4:
      word.special = true;
      break;
    default:
      word.byte ^= static_cast<std::uint8_t>(1U << random.below(8));
  }
}

// The eight bytes of a safe channel.
using SafeBytes = std::array<std::uint8_t, SafeChannels::kFrames>;
inline SafeBytes safe_bytes(unsigned summary, std::uint64_t position) {
  SafeBytes bytes{};
  bytes[0] = static_cast<std::uint8_t>(summary);
  for (unsigned i = 1; i <= 5; ++i) bytes[i] = static_cast<std::uint8_t>(position >> 8 * (5 - i));
  const std::uint16_t crc = crc16({bytes.data(), 6});
  bytes[6] = static_cast<std::uint8_t>(crc >> 8U);
  bytes[7] = static_cast<std::uint8_t>(crc);
  return bytes;
}

// dsl_pkg::answer_t.
struct AnswerPort {
  bool linked = false;
  bool begins = false;
  bool running = false;
  unsigned place = 0;
  bool valid = false;
  unsigned number = 0;
  Word word{};
  bool ends = false;

  std::uint32_t bits() const {
    using namespace at::answer_t;
    return static_cast<std::uint32_t>(
        kLinked(linked) | kBegins(begins) | kRunning(running) | kPlace(place) | kValid(valid) |
        kNumber(number) | kWordData(word.byte) | kWordError(word.error) |
        kWordSpecial(word.special) | kWordOnlyStrict(word.only_strict) | kEnds(ends));
  }
};

// dsl_pkg::line_status_t.
struct StatusPort {
  unsigned state = 0;
  unsigned reason = 0;
  unsigned identity = 0;
  unsigned width = 8;  // bits of the position, 8 or more
  unsigned quality = 0;
  unsigned low = 0;
  unsigned rssi = 0;
  unsigned edges = 0;
  unsigned place = 0;

  std::uint64_t bits() const {
    namespace to = at::line_status_t;
    return to::kState(state) | to::kReason(reason) | to::kIdentity(identity) |
           to::kWidth(width - 8) | to::kQuality(quality) | to::kLow(low) | to::kRssi(rssi) |
           to::kEdges(edges) | to::kPlace(place);
  }
};

// dsl_pkg::told_t.
struct Told {
  explicit Told(unsigned port)
      : bits(port),
        acceleration_good(at::told_t::kAccelerationGood.of(port) != 0),
        acceleration_marked(at::told_t::kAccelerationMarked.of(port) != 0),
        missing(static_cast<unsigned>(at::told_t::kMissing.of(port))),
        safe1_valid(at::told_t::kSafe1Valid.of(port) != 0),
        safe1_error(at::told_t::kSafe1Error.of(port) != 0),
        safe2_valid(at::told_t::kSafe2Valid.of(port) != 0),
        safe2_error(at::told_t::kSafe2Error.of(port) != 0) {}
  // dsl_pkg::safe_checks_t.
  unsigned checks() const { return static_cast<unsigned>(at::told_t::kChecks.of(bits)); }
  unsigned bits;
  bool acceleration_good;
  bool acceleration_marked;
  unsigned missing;
  bool safe1_valid;
  bool safe1_error;
  bool safe2_valid;
  bool safe2_error;
};

// dsl_pkg::verdict_t.
struct Verdict {
  explicit Verdict(unsigned port)
      : safe1_error(at::verdict_t::kSafe1Error.of(port) != 0),
        safe1_good(at::verdict_t::kSafe1Good.of(port) != 0),
        safe2_error(at::verdict_t::kSafe2Error.of(port) != 0),
        misfit(at::verdict_t::kMisfit.of(port) != 0),
        missing(at::verdict_t::kMissing.of(port) != 0) {}
  bool safe1_error;
  bool safe1_good;
  bool safe2_error;
  bool misfit;
  bool missing;
};

// Sends the words of a frame and its end. `clock` is one clock of what listens, `gap` gives the
// clocks from the word of a number to what follows it, 10 or more.
template <typename Gap, typename Clock>
void send(AnswerPort& port, const Words& words, const Gap& gap, const Clock& clock) {
  for (unsigned i = 0; i < kWords; ++i) {
    port.valid = true;
    port.number = i;
    port.word = words[i];
    clock();
    port.valid = false;
    for (unsigned rest = gap(i) - 1; rest != 0; --rest) clock();
  }
  port.ends = true;
  clock();
  port.ends = false;
}

}  // namespace dsl_frames

#endif  // TESTS_BLOCK_DSL_DSL_FRAMES_HPP_
