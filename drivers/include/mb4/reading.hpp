// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The data of one frame, and its decoding from the bytes of SCDATAx.

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

namespace detail {

// CRC of the data bits as they were on the line. Where the chip has converted Gray code, the bits
// are converted back.
constexpr std::uint16_t crc_on_line(const SlaveConfig& slave, Span<const std::uint8_t> bytes) {
  CrcShift shift(slave.crc_polynomial, slave.crc_start);
  unsigned above = 0;
  for (unsigned i = slave.data_bits; i-- > 0;) {
    const unsigned bit = bytes[i / 8] >> i % 8 & 1U;
    shift.shift(bit ^ above);
    above = slave.gray ? bit : 0;
  }
  return shift.value();
}

}  // namespace detail

// Decodes `bytes` (the first reading_bytes() bytes of SCDATAx, page 26) of slave 1..8. kCorrupted
// when bits that the chip sets to 0 are not 0 or when the stored CRC does not belong to the data.
[[nodiscard]] constexpr Result<Reading> decode_reading(const Config& config, std::uint8_t slave,
                                                       Span<const std::uint8_t> bytes) {
  const SlaveConfig& slave_config = config.slaves[slave - 1U];
  const unsigned bits = slave_config.data_bits;
  // In halves: shifting 64 bits by a variable costs a function on a small core.
  std::uint32_t half[2] = {0, 0};
  const unsigned count = data_bytes(slave_config);
  for (unsigned i = 0; i < count; ++i) {
    half[i / 4] |= std::uint32_t{bytes[i]} << 8 * (i % 4);
  }
  if (bits % 8 != 0 && bytes[count - 1] >> bits % 8 != 0) {
    return Error::kCorrupted;
  }
  Reading reading;
  reading.slave = slave;
  reading.raw = std::uint64_t{half[1]} << 32 | half[0];
  if (crc_is_stored(config, slave_config)) {
    reading.crc_stored = true;
    reading.crc = bytes[7];
    if (slave_config.crc_polynomial > 0x1FF) {
      reading.crc = static_cast<std::uint16_t>((bytes[7] << 8) | bytes[6]);
    }
    if (reading.crc != detail::crc_on_line(slave_config, bytes)) {
      return Error::kCorrupted;
    }
  }
  reading.position = reading.raw;
  if (slave_config.flags == Flags::kErrorWarning) {
    // With Gray code the chip converts the flags together with the position.
    const unsigned sent = slave_config.gray ? bytes[0] ^ (bytes[0] >> 1) : bytes[0];
    reading.error = (sent & 2U) == 0;
    reading.warning = (sent & 1U) == 0;
    reading.raw ^= (bytes[0] ^ sent) & 3U;
    reading.position >>= 2;
  }
  return reading;
}

}  // namespace mb4

#endif  // MB4_READING_HPP_
