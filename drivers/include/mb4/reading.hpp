// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The data of one frame, and its decoding from the bytes of SCDATAx.

#ifndef MB4_READING_HPP_
#define MB4_READING_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/result.hpp"
#include "mb4_cyclic.h"

namespace mb4 {

namespace detail {

// Stands where a member had a name that is no longer in use.
struct OldName {
  constexpr OldName() = default;
  OldName(const OldName&) = delete;
  OldName& operator=(const OldName&) = delete;
  ~OldName() = default;
  template <typename T>
  constexpr operator T() const {
    static_assert(sizeof(T) == 0,
                  "mb4: the members 'error' and 'warning' of a Reading are called 'slave_error' "
                  "and 'slave_warning'; the error of the call is Result::error()");
    return T();
  }
};

}  // namespace detail

// The data of one slave from one good frame. Exists only if the chip and the driver found the frame
// good; a bad frame is an error, never a Reading. Where nE is 0 the Result that brings it has the
// error kSlaveError, and Result::reading() gives it.
struct Reading {
  // All data bits, right aligned: the position (Gray code as the chip has converted it) and the
  // flags as the slave sent them.
  std::uint64_t raw = 0;
  // The data bits without the flag bits, right aligned.
  std::uint64_t position = 0;
  // CRC as stored by the chip (not inverted); 0 unless crc_stored.
  std::uint16_t crc = 0;
  // Config::spi_check is not kOff and the chip had room for the CRC.
  bool crc_stored = false;
  // The slave reports an error (nE = 0): the position is not to be trusted. False without flags.
  bool slave_error = false;
  // The slave reports a warning (nW = 0). False without flags.
  bool slave_warning = false;
  // Slave 1..8.
  std::uint8_t slave = 0;

  static constexpr detail::OldName error{};    // does not compile where it is used
  static constexpr detail::OldName warning{};  // nor does this
};

// How many bytes of SCDATAx a Reading needs: 1..7, or 8 with a stored CRC or 57..64 data bits.
[[nodiscard]] constexpr std::size_t reading_bytes(const Config& config, std::uint8_t slave) {
  const SlaveConfig& slave_config = config.slaves[slave - 1U];
  return crc_is_stored(config, slave_config) ? 8U : data_bytes(slave_config);
}

namespace detail {

constexpr mb4_slave_config to_c(const SlaveConfig& from) {
  return {from.enabled,   from.data_bits,      static_cast<std::uint8_t>(from.flags),
          from.crc_start, from.crc_polynomial, from.gray,
          from.actuator,  from.stop_bit};
}

// `slave` 1..8 of a valid configuration.
inline void set_word(const Config& config, std::uint8_t slave, mb4_word& word) {
  const mb4_slave_config one = to_c(config.slaves[slave - 1U]);
  mb4_word_set(&word, slave, &one, static_cast<std::uint8_t>(config.spi_check));
  if (protocol_of(config, slave) == Protocol::kBissC) {
    mb4_word_biss_c(&word, &one, channel_of(config, slave));
  }
}

// What a slot or a read with this code has: a reading, whose nE may be 0.
constexpr bool has_reading(std::uint8_t code) { return code == MB4_OK || code == MB4_SLAVE_ERROR; }

inline Result<Reading> to_result(const mb4_reading& from, std::uint8_t code) {
  if (!has_reading(code)) {
    return static_cast<Error>(code);
  }
  Reading reading;
  reading.raw = from.raw;
  reading.position = from.position;
  reading.crc = from.crc;
  reading.crc_stored = from.crc_stored;
  reading.slave_error = from.slave_error;
  reading.slave_warning = from.slave_warning;
  reading.slave = from.slave;
  return {reading, static_cast<Error>(code)};
}

inline Result<Reading> to_result(const mb4_word& word, const mb4_slot& slot) {
  mb4_reading reading{};
  if (has_reading(slot.code)) {
    mb4_slot_reading(&word, &slot, &reading, MB4_WITH_ALL);
  }
  return to_result(reading, slot.code);
}

static_assert(static_cast<int>(Error::kCorrupted) == MB4_CORRUPTED);
static_assert(static_cast<int>(Error::kBankSwitched) == MB4_BANK_SWITCHED);
static_assert(static_cast<int>(Error::kSlaveError) == MB4_SLAVE_ERROR);
static_assert(static_cast<int>(SpiCheck::kFull) == MB4_SPI_CHECK_FULL);
static_assert(static_cast<int>(SpiCheck::kFullAndRelease) == MB4_SPI_CHECK_FULL_AND_RELEASE);

}  // namespace detail

// Decodes `bytes` (the first reading_bytes() bytes of SCDATAx, page 26) of slave 1..8 of a valid
// `config`. kCorrupted when bits that the chip sets to 0 are not 0 or when the stored CRC does not
// belong to the data. kSlaveError: nE is 0; Result::reading() has the word. kInvalidArgument:
// `slave` is not 1..8, or there are fewer bytes.
[[nodiscard]] inline Result<Reading> decode_reading(const Config& config, std::uint8_t slave,
                                                    Span<const std::uint8_t> bytes) {
  if (!is_in(0xFF, slave) || bytes.size() < reading_bytes(config, slave)) {
    return Error::kInvalidArgument;
  }
  mb4_word word;
  mb4_slot slot{};
  detail::set_word(config, slave, word);
  mb4_slot_load(&word, &slot, bytes.data());
  slot.code = mb4_slot_good(&word, &slot, MB4_WITH_ALL) ? MB4_OK : MB4_CORRUPTED;
  static_cast<void>(mb4_slot_tell(&word, &slot, MB4_WITH_ALL));
  return detail::to_result(word, slot);
}

}  // namespace mb4

#endif  // MB4_READING_HPP_
