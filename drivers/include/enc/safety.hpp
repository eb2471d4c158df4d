// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// BiSS Safety (BP3): one sensor sends two position words in each frame. The control position word
// (CPW) is for the control loop. The safety position word (SPW) has a longer CRC and a counter of
// frames, the sign of life. `Safety` checks both words against each other and against the frames
// before.
//
// A driver fills a SafetySample from what its master has read. The CRCs are those that came over
// the line, so the check also covers the way from the line to this code.
//
// Interrupt safety: a Safety has no lock and no static data. All calls on one object belong in one
// context. Nothing here makes a transfer, waits or asks for the time.

#ifndef ENC_SAFETY_HPP_
#define ENC_SAFETY_HPP_

#include <cstdint>

#include "enc/crc.hpp"
#include "enc/position.hpp"

namespace enc {

// The place of a bit that a word does not have.
inline constexpr std::uint8_t kNoBit = 0xFF;

// One word: where its parts are. Place 0 is the lowest data bit, the last one on the line before
// the CRC. Parts must not overlap. Bits that are in no part are covered by the CRC alone.
struct SafetyWord {
  std::uint8_t data_bits = 0;  // without the CRC, 1..64
  std::uint8_t position_bits = 0;
  std::uint8_t position_place = 0;      // of the lowest position bit
  std::uint8_t error_place = kNoBit;    // nE: 0 is an error
  std::uint8_t warning_place = kNoBit;  // nW: 0 is a warning
  std::uint32_t crc_polynomial = 0;     // in full, degree 1..16
  std::uint16_t crc_start = 0;          // low bits count, as many as the CRC has
};

// Both words, the counter, and what the positions have to do with each other. bp3_safety() fills
// in the layout of BP3.
//
// The relation, all modulo 2^compare_bits, must differ by at most `tolerance`:
//   control position >> control_shift
//   (safety position >> safety_shift, inverted with safety_inverted) + safety_offset
struct SafetyConfig {
  SafetyWord control;
  SafetyWord safety;
  // The sign of life in the safety word, 2..8 bits. After its highest value it is `life_first`
  // again, 0 or 1.
  std::uint8_t life_bits = 6;
  std::uint8_t life_place = 0;
  std::uint8_t life_first = 0;
  std::uint8_t control_shift = 0;
  std::uint8_t safety_shift = 0;
  bool safety_inverted = false;
  // 0: as many as both positions have after their shifts. Fewer leave out the highest bits: turns
  // that only one word has.
  std::uint8_t compare_bits = 0;
  std::uint64_t safety_offset = 0;
  std::uint64_t tolerance = 0;  // below half of 2^compare_bits
};

// The layout of BP3: CPW is position, nE, nW with a CRC of 6 bits (0x43); SPW is position, nE, nW,
// sign of life of 6 bits with a CRC of 16 bits (0x190D9). From the highest bit on. A shorter safety
// position holds the highest bits of the position; set control_shift and compare_bits yourself if
// it does not. The start values of both CRCs are a matter of the sensor.
[[nodiscard]] constexpr SafetyConfig bp3_safety(std::uint8_t control_bits, std::uint8_t safety_bits,
                                                std::uint16_t control_start = 0,
                                                std::uint16_t safety_start = 0) {
  constexpr std::uint8_t kFlags = 2;
  SafetyConfig config;
  config.control = {static_cast<std::uint8_t>(control_bits + kFlags),
                    control_bits,
                    kFlags,
                    1,
                    0,
                    0x43,
                    control_start};
  const auto low = static_cast<std::uint8_t>(config.life_bits + kFlags);
  config.safety = {static_cast<std::uint8_t>(safety_bits + low),
                   safety_bits,
                   low,
                   static_cast<std::uint8_t>(low - 1U),
                   static_cast<std::uint8_t>(low - 2U),
                   0x190D9,
                   safety_start};
  if (control_bits > safety_bits) {
    config.control_shift = static_cast<std::uint8_t>(control_bits - safety_bits);
  } else {
    config.safety_shift = static_cast<std::uint8_t>(safety_bits - control_bits);
  }
  return config;
}

// The member of SafetyConfig that is impossible.
enum class SafetyField : std::uint8_t {
  kNone = 0,
  kControlDataBits,
  kControlPosition,  // position_bits, position_place
  kControlFlags,     // error_place, warning_place
  kControlCrc,       // crc_polynomial
  kSafetyDataBits,
  kSafetyPosition,
  kSafetyFlags,
  kSafetyCrc,
  kLife,  // life_bits, life_place, life_first
  kShift,
  kCompareBits,
  kOffset,
  kTolerance,
};

// What a Safety checks, in the order in which it checks.
enum class SafetyCheck : std::uint8_t {
  kConfigured = 0,  // configure() has succeeded
  kControlWord,     // there is a control word
  kSafetyWord,      // there is a safety word
  kOneFrame,        // both are of one frame
  kControlCrc,      // its CRC is right
  kSafetyCrc,       // its CRC is right
  kLifeKnown,       // there is an earlier word to compare with, and not too long ago
  kLifeValue,       // the counter has such a value
  kLifeStuck,       // the counter has moved
  kLifeSkipped,     // no word was left out
  kLifeRepeated,    // the word is not an older one
  kPositions,       // the positions have to do with each other as configured
  kControlError,    // nE of the control word is 1
  kSafetyError,     // nE of the safety word is 1
};

// What one frame has shown.
struct SafetyVerdict {
  std::uint64_t position = 0;         // of the control word; 0 unless its CRC is right
  std::uint64_t safety_position = 0;  // of the safety word; 0 unless its CRC is right
  std::uint16_t checks_failed = 0;    // bit n: SafetyCheck n
  std::uint8_t life = 0;              // sign of life; 0 unless the CRC of the safety word is right
  bool warning = false;               // nW of a word with a right CRC is 0; no failure

  // Every check is passed.
  [[nodiscard]] constexpr bool ok() const { return checks_failed == 0; }
  [[nodiscard]] constexpr bool failed(SafetyCheck check) const {
    return (checks_failed >> static_cast<unsigned>(check) & 1U) != 0;
  }
  constexpr void fail_if(bool bad, SafetyCheck check) {
    checks_failed =
        static_cast<std::uint16_t>(checks_failed | (bad ? 1U : 0U) << static_cast<unsigned>(check));
  }
};

// One word as it was read.
struct SafetyWordRead {
  enum class State : std::uint8_t {
    kMissing,  // nothing new
    kBadCrc,   // something came, and the master or the driver has refused it
    kHere,
  };
  std::uint64_t data = 0;
  std::uint16_t crc = 0;  // as it came, not inverted
  State state = State::kMissing;
};

struct SafetySample {
  SafetyWordRead control;
  SafetyWordRead safety;
  bool one_frame = true;
};

namespace detail {

constexpr std::uint64_t safety_bits_at(std::uint8_t bits, std::uint8_t place) {
  return place < kMaxPositionBits ? low_bits(bits) << place : 0;
}

// True if `bits` at `place` are within the word and none of them is in `taken`; adds them to it.
constexpr bool safety_takes(const SafetyWord& word, std::uint8_t bits, std::uint8_t place,
                            std::uint64_t& taken) {
  if (bits < 1 || bits > word.data_bits || place > word.data_bits - bits) {
    return false;
  }
  const std::uint64_t mask = safety_bits_at(bits, place);
  const bool is_free = (taken & mask) == 0;
  taken |= mask;
  return is_free;
}

constexpr bool safety_takes_flag(const SafetyWord& word, std::uint8_t place, std::uint64_t& taken) {
  return place == kNoBit || safety_takes(word, 1, place, taken);
}

// `first` is the first of the four fields of the word.
constexpr SafetyField check_safety_word(const SafetyWord& word, SafetyField first,
                                        std::uint64_t& taken) {
  const auto field = [first](unsigned number) {
    return static_cast<SafetyField>(static_cast<unsigned>(first) + number);
  };
  if (word.data_bits < 1 || word.data_bits > kMaxPositionBits) {
    return first;
  }
  if (!safety_takes(word, word.position_bits, word.position_place, taken)) {
    return field(1);
  }
  if (!safety_takes_flag(word, word.error_place, taken) ||
      !safety_takes_flag(word, word.warning_place, taken)) {
    return field(2);
  }
  const std::uint8_t width = crc_width_bits(word.crc_polynomial);
  return width < 1 || width > 16 || (word.crc_polynomial & 1U) == 0 ? field(3) : SafetyField::kNone;
}

constexpr bool safety_crc_is_right(const SafetyWord& word, const SafetyWordRead& read) {
  return (read.data & ~low_bits(word.data_bits)) == 0 &&
         crc(word.crc_polynomial, word.crc_start, read.data, word.data_bits) == read.crc;
}

constexpr bool safety_flag_is_low(std::uint64_t data, std::uint8_t place) {
  return place < kMaxPositionBits && (data >> place & 1U) == 0;
}

}  // namespace detail

// How many bits of the positions are compared, for a valid `config`.
[[nodiscard]] constexpr std::uint8_t safety_compare_bits(const SafetyConfig& config) {
  const auto control =
      static_cast<std::uint8_t>(config.control.position_bits - config.control_shift);
  const auto safety = static_cast<std::uint8_t>(config.safety.position_bits - config.safety_shift);
  const std::uint8_t both = control < safety ? control : safety;
  return config.compare_bits != 0 ? config.compare_bits : both;
}

// The first member that is impossible, or kNone. constexpr: a static_assert can check a constant
// configuration.
[[nodiscard]] constexpr SafetyField validate(const SafetyConfig& config) {
  std::uint64_t taken = 0;
  SafetyField field =
      detail::check_safety_word(config.control, SafetyField::kControlDataBits, taken);
  if (field != SafetyField::kNone) {
    return field;
  }
  taken = 0;
  field = detail::check_safety_word(config.safety, SafetyField::kSafetyDataBits, taken);
  if (field != SafetyField::kNone) {
    return field;
  }
  if (config.life_bits < 2 || config.life_bits > 8 || config.life_first > 1 ||
      !detail::safety_takes(config.safety, config.life_bits, config.life_place, taken)) {
    return SafetyField::kLife;
  }
  if (config.control_shift >= config.control.position_bits ||
      config.safety_shift >= config.safety.position_bits) {
    return SafetyField::kShift;
  }
  SafetyConfig all = config;
  all.compare_bits = 0;
  if (config.compare_bits > safety_compare_bits(all)) {
    return SafetyField::kCompareBits;
  }
  const std::uint64_t most = low_bits(safety_compare_bits(config));
  if (config.safety_offset > most) {
    return SafetyField::kOffset;
  }
  return config.tolerance > most / 2 ? SafetyField::kTolerance : SafetyField::kNone;
}

// Checks the words of one sensor, frame by frame.
//
//   Safety safety;
//   safety.configure(bp3_safety(26, 26));   // SafetyField::kNone
//   const SafetyVerdict verdict = safety.check(sample);
//   if (verdict.ok()) control(verdict.position);
class Safety {
 public:
  // Takes `config` if it is valid; the next sample is the first one. Otherwise nothing changes.
  [[nodiscard]] constexpr SafetyField configure(const SafetyConfig& config) {
    const SafetyField field = validate(config);
    if (field == SafetyField::kNone) {
      config_ = config;
      config_.compare_bits = safety_compare_bits(config);
      configured_ = true;
      restart();
    }
    return field;
  }

  // The next sample is the first one: its counter has nothing to be compared with, so its verdict
  // is kLifeKnown. Call it when frames have run that nobody has counted.
  constexpr void restart() { pending_ = kForgotten; }

  // Checks the words of the newest frame. `frames`: how many frames the sensor has sent since the
  // sample before, this one included; 0 counts as 1. Call it for each frame that was due, also
  // without a word or with a bad one: the next good word is compared with the last good one, over
  // the frames in between. When these are as many as the counter has values, the verdict is
  // kLifeKnown.
  //
  // A failure of the counter is told once; then the new value counts. A stuck one is told with each
  // sample.
  [[nodiscard]] constexpr SafetyVerdict check(const SafetySample& sample,
                                              std::uint32_t frames = 1) {
    SafetyVerdict verdict;
    if (!configured_) {
      verdict.fail_if(true, SafetyCheck::kConfigured);
      return verdict;
    }
    add_frames(frames);
    verdict.fail_if(!sample.one_frame, SafetyCheck::kOneFrame);
    const bool control = good(config_.control, sample.control, SafetyCheck::kControlWord,
                              SafetyCheck::kControlCrc, verdict);
    const bool safety = good(config_.safety, sample.safety, SafetyCheck::kSafetyWord,
                             SafetyCheck::kSafetyCrc, verdict);
    if (control) {
      verdict.position = position(config_.control, sample.control.data);
      read_flags(config_.control, sample.control.data, SafetyCheck::kControlError, verdict);
    }
    if (safety) {
      verdict.safety_position = position(config_.safety, sample.safety.data);
      read_flags(config_.safety, sample.safety.data, SafetyCheck::kSafetyError, verdict);
      verdict.life = static_cast<std::uint8_t>((sample.safety.data >> config_.life_place) &
                                               low_bits(config_.life_bits));
      check_life(verdict);
    }
    if (control && safety) {
      verdict.fail_if(!related(verdict), SafetyCheck::kPositions);
    }
    return verdict;
  }

 private:
  static constexpr std::uint32_t kForgotten = 0xFFFF;  // more than any counter has values

  constexpr void add_frames(std::uint32_t frames) {
    frames = frames == 0 ? 1 : frames;
    pending_ = frames > kForgotten - pending_ ? kForgotten : pending_ + frames;
  }

  static constexpr bool good(const SafetyWord& word, const SafetyWordRead& read,
                             SafetyCheck is_there, SafetyCheck crc_is_right,
                             SafetyVerdict& verdict) {
    const bool bad =
        read.state == SafetyWordRead::State::kBadCrc ||
        (read.state == SafetyWordRead::State::kHere && !detail::safety_crc_is_right(word, read));
    verdict.fail_if(read.state == SafetyWordRead::State::kMissing, is_there);
    verdict.fail_if(bad, crc_is_right);
    return read.state == SafetyWordRead::State::kHere && !bad;
  }

  static constexpr std::uint64_t position(const SafetyWord& word, std::uint64_t data) {
    return (data >> word.position_place) & low_bits(word.position_bits);
  }

  static constexpr void read_flags(const SafetyWord& word, std::uint64_t data, SafetyCheck error,
                                   SafetyVerdict& verdict) {
    verdict.fail_if(detail::safety_flag_is_low(data, word.error_place), error);
    verdict.warning = verdict.warning || detail::safety_flag_is_low(data, word.warning_place);
  }

  constexpr void check_life(SafetyVerdict& verdict) {
    const std::uint32_t values = (std::uint32_t{1} << config_.life_bits) - config_.life_first;
    if (verdict.life < config_.life_first) {
      verdict.fail_if(true, SafetyCheck::kLifeValue);
      return;
    }
    if (pending_ >= values) {
      verdict.fail_if(true, SafetyCheck::kLifeKnown);
    } else {
      // Steps from the last value to this one, 0 to values - 1.
      const std::uint32_t steps = verdict.life >= last_
                                      ? std::uint32_t{verdict.life} - last_
                                      : std::uint32_t{verdict.life} + values - last_;
      const std::uint32_t ahead = steps >= pending_ ? steps - pending_ : steps + values - pending_;
      verdict.fail_if(steps == 0, SafetyCheck::kLifeStuck);
      verdict.fail_if(steps != 0 && ahead != 0 && ahead <= values / 2, SafetyCheck::kLifeSkipped);
      verdict.fail_if(steps != 0 && ahead > values / 2, SafetyCheck::kLifeRepeated);
    }
    last_ = verdict.life;
    pending_ = 0;
  }

  [[nodiscard]] constexpr bool related(const SafetyVerdict& verdict) const {
    const std::uint64_t safety = verdict.safety_position >> config_.safety_shift;
    const std::uint64_t expected =
        (config_.safety_inverted ? ~safety : safety) + config_.safety_offset;
    const std::uint64_t mask = low_bits(config_.compare_bits);
    const std::uint64_t up = ((verdict.position >> config_.control_shift) - expected) & mask;
    const std::uint64_t down = (0 - up) & mask;
    return (up < down ? up : down) <= config_.tolerance;
  }

  SafetyConfig config_;
  std::uint32_t pending_ = kForgotten;  // frames since the last good safety word, this one included
  std::uint8_t last_ = 0;               // its counter
  bool configured_ = false;
};

// Short stable names for messages.
[[nodiscard]] constexpr const char* to_string(SafetyCheck check) {
  switch (check) {
    case SafetyCheck::kConfigured:
      return "not configured";
    case SafetyCheck::kControlWord:
      return "no control word";
    case SafetyCheck::kSafetyWord:
      return "no safety word";
    case SafetyCheck::kOneFrame:
      return "words of two frames";
    case SafetyCheck::kControlCrc:
      return "CRC error of the control word";
    case SafetyCheck::kSafetyCrc:
      return "CRC error of the safety word";
    case SafetyCheck::kLifeKnown:
      return "life counter not comparable";
    case SafetyCheck::kLifeValue:
      return "impossible life counter";
    case SafetyCheck::kLifeStuck:
      return "life counter stuck";
    case SafetyCheck::kLifeSkipped:
      return "safety word left out";
    case SafetyCheck::kLifeRepeated:
      return "old safety word";
    case SafetyCheck::kPositions:
      return "positions differ";
    case SafetyCheck::kControlError:
      return "error flag of the control word";
    case SafetyCheck::kSafetyError:
      return "error flag of the safety word";
  }
  return "unknown";
}

}  // namespace enc

#endif  // ENC_SAFETY_HPP_
