// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// BiSS Safety (BP3) on this chip: two slaves of a configuration are the words of one sensor. The
// check itself stands in enc/safety.hpp.
//
//   mb4::Safety safety;
//   safety.configure(mb4::bp3_safety(26, 26, 0, 0x1234));
//   mb4::safety_fits(config, 1, 2, mb4::bp3_safety(26, 26, 0, 0x1234));
//   ... device.automatic().poll(frame) ...
//   const mb4::SafetyVerdict verdict = safety.check(mb4::safety_sample(frame[1], frame[2]));

#ifndef MB4_SAFETY_HPP_
#define MB4_SAFETY_HPP_

#include <cstdint>

#include "enc/safety.hpp"
#include "mb4/config.hpp"
#include "mb4/error.hpp"
#include "mb4/reading.hpp"
#include "mb4/result.hpp"

namespace mb4 {

using enc::bp3_safety;
using enc::Safety;
using enc::SafetyCheck;
using enc::SafetyConfig;
using enc::SafetyField;
using enc::SafetySample;
using enc::SafetyVerdict;
using enc::SafetyWord;
using enc::SafetyWordRead;

namespace detail {

// kNone: `slave` of `config` brings `word` with its CRC.
constexpr ConfigField safety_misfit(const Config& config, std::uint8_t slave,
                                    const SafetyWord& word) {
  const SlaveConfig& one = config.slaves[slave - 1U];
  if (!one.enabled || one.actuator || protocol_of(config, slave) != Protocol::kBissC) {
    return ConfigField::kSlaveEnabled;
  }
  if (one.data_bits != word.data_bits) {
    return ConfigField::kDataBits;
  }
  if (one.crc_polynomial != word.crc_polynomial) {
    return ConfigField::kCrcPolynomial;
  }
  if (one.crc_start != word.crc_start) {
    return ConfigField::kCrcStart;
  }
  if (one.flags != Flags::kNone && (word.error_place != 1 || word.warning_place != 0)) {
    return ConfigField::kFlags;
  }
  if (config.spi_check == SpiCheck::kOff) {
    return ConfigField::kSpiCheck;
  }
  return crc_is_stored(config, one) ? ConfigField::kNone : ConfigField::kDataBits;
}

}  // namespace detail

// Slaves `control` and `safety` (1..8, not the same) of a valid `config` bring the words of
// `words`, each with its CRC. kInvalidArgument: another number. kUnsupported: ErrorInfo::field and
// ::number name what does not fit. kSlaveEnabled: no sensor of BiSS C. kDataBits: another length,
// or the chip has no room for the CRC (data and CRC have more than eight bytes). kSpiCheck: with
// kOff the chip stores no CRC. kFlags: kErrorWarning, but the two lowest bits are not nE and nW.
[[nodiscard]] constexpr Result<void> safety_fits(const Config& config, std::uint8_t control,
                                                 std::uint8_t safety, const SafetyConfig& words) {
  if (!is_in(0xFF, control) || !is_in(0xFF, safety) || control == safety) {
    return Error::kInvalidArgument;
  }
  const ConfigField of_control = detail::safety_misfit(config, control, words.control);
  if (of_control != ConfigField::kNone) {
    return ErrorInfo(Error::kUnsupported, of_control, control);
  }
  const ConfigField of_safety = detail::safety_misfit(config, safety, words.safety);
  if (of_safety != ConfigField::kNone) {
    return ErrorInfo(Error::kUnsupported, of_safety, safety);
  }
  return {};
}

// A word from the result of its slave. A reading without a stored CRC counts as missing. One with
// kSlaveError is here: the check looks at nE itself.
[[nodiscard]] constexpr SafetyWordRead safety_word(const Result<Reading>& reading) {
  SafetyWordRead word;
  if (!reading.has_reading()) {
    const bool bad = reading.error() == Error::kCrc || reading.error() == Error::kCorrupted;
    word.state = bad ? SafetyWordRead::State::kBadCrc : SafetyWordRead::State::kMissing;
  } else if (reading.reading().crc_stored) {
    word.data = reading.reading().raw;
    word.crc = reading.reading().crc;
    word.state = SafetyWordRead::State::kHere;
  }
  return word;
}

// The sample of a frame, from the results of its two slaves. `one_frame`: FrameRead::one_frame();
// true for read_all(), next() and poll() unless a word was bad.
[[nodiscard]] constexpr SafetySample safety_sample(const Result<Reading>& control,
                                                   const Result<Reading>& safety,
                                                   bool one_frame = true) {
  return {safety_word(control), safety_word(safety), one_frame};
}

}  // namespace mb4

#endif  // MB4_SAFETY_HPP_
