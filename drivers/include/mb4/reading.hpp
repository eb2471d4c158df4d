// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// What one frame delivered, and its decoding from the bytes of SCDATAx.

#ifndef MB4_READING_HPP_
#define MB4_READING_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/crc.hpp"
#include "mb4/result.hpp"
#include "mb4/span.hpp"

namespace mb4 {

// The data of one slave from one good frame. Exists only if the chip and the driver found the frame
// good; a bad frame is an error, never a Reading.
struct Reading {
  // All data bits as sent, right aligned: position and flags.
  std::uint64_t raw = 0;
  // The data bits without the flag bits, right aligned.
  std::uint64_t position = 0;
  // CRC as stored by the chip (not inverted); 0 unless crc_stored.
  std::uint16_t crc = 0;
  // Config::spi_check is not kOff and the chip had room for the CRC.
  bool crc_stored = false;
  // The slave reports an error (nE = 0): the position is not to be trusted. False without flags.
  bool error = false;
  // The slave reports a warning (nW = 0). False without flags.
  bool warning = false;
  // Slave 1..8.
  std::uint8_t slave = 0;
};

// How many bytes of SCDATAx a Reading needs: 1..7, or 8 with a stored CRC or 57..64 data bits.
[[nodiscard]] constexpr std::size_t reading_bytes(const Config& config, std::uint8_t slave) {
  const SlaveConfig& slave_config = config.slaves[slave - 1U];
  return crc_is_stored(config, slave_config) ? 8U : data_bytes(slave_config);
}

// Decodes `bytes` (the first reading_bytes() bytes of SCDATAx, page 26) of slave 1..8. kCorrupted
// when bits that the chip sets to 0 are not 0 or when the stored CRC does not belong to the data.
[[nodiscard]] constexpr Result<Reading> decode_reading(const Config& config, std::uint8_t slave,
                                                       Span<const std::uint8_t> bytes) {
  const SlaveConfig& slave_config = config.slaves[slave - 1U];
  Reading reading;
  reading.slave = slave;
  for (std::size_t i = data_bytes(slave_config); i > 0; --i) {
    reading.raw = (reading.raw << 8) | bytes[i - 1];
  }
  if (slave_config.data_bits < 64 && (reading.raw >> slave_config.data_bits) != 0) {
    return Error::kCorrupted;
  }
  if (crc_is_stored(config, slave_config)) {
    const std::uint8_t width_bits = crc_width_bits(slave_config.crc_polynomial);
    reading.crc_stored = true;
    reading.crc = bytes[7];
    if (width_bits > 8) {
      reading.crc = static_cast<std::uint16_t>((bytes[7] << 8) | bytes[6]);
    }
    if (reading.crc != crc(slave_config.crc_polynomial, slave_config.crc_start, reading.raw,
                           slave_config.data_bits)) {
      return Error::kCorrupted;
    }
  }
  reading.position = reading.raw;
  if (slave_config.flags == Flags::kErrorWarning) {
    reading.error = (reading.raw & 2U) == 0;
    reading.warning = (reading.raw & 1U) == 0;
    reading.position >>= 2;
  }
  return reading;
}

}  // namespace mb4

#endif  // MB4_READING_HPP_
