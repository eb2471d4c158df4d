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
// are converted back. As enc::CrcShift, but left aligned: the highest bit of the polynomial is
// shifted out, and no step needs a mask.
[[gnu::noinline]] constexpr std::uint32_t crc_on_line(const SlaveConfig& slave,
                                                      const std::uint8_t* bytes) {
  std::uint32_t polynomial = slave.crc_polynomial;
  std::uint32_t remainder = slave.crc_start;
  unsigned unused = 0;
  for (bool top = false; !top; ++unused) {
    top = (polynomial & 0x80000000U) != 0;
    polynomial <<= 1;
    remainder <<= 1;
  }
  unsigned above = 0;
  for (unsigned i = slave.data_bits; i-- > 0;) {
    const unsigned bit = bytes[i / 8] >> i % 8 & 1U;
    const bool differs = remainder >> 31 != (bit ^ above);
    remainder = remainder << 1 ^ (differs ? polynomial : 0);
    above = slave.gray ? bit : 0;
  }
  return remainder >> unused;
}

}  // namespace detail

namespace detail {

// The CRC in the top byte(s) of SCDATAx (page 26).
constexpr std::uint16_t stored_crc(const SlaveConfig& slave, const std::uint8_t* bytes) {
  return crc_bytes(slave) > 1 ? static_cast<std::uint16_t>(bytes[7] << 8 | bytes[6]) : bytes[7];
}

// decode_reading() without a check of its arguments.
constexpr Result<Reading> decode_bytes(const Config& config, std::uint8_t slave,
                                       const std::uint8_t* bytes) {
  const SlaveConfig& slave_config = config.slaves[slave - 1U];
  const unsigned bits = slave_config.data_bits;
  const unsigned count = data_bytes(slave_config);
  if (bits % 8 != 0 && bytes[count - 1] >> bits % 8 != 0) {
    return Error::kCorrupted;
  }
  Reading reading;
  reading.slave = slave;
  for (unsigned i = count; i-- > 0;) {
    reading.raw = reading.raw << 8 | bytes[i];
  }
  if (crc_is_stored(config, slave_config)) {
    reading.crc_stored = true;
    reading.crc = stored_crc(slave_config, bytes);
    if (reading.crc != crc_on_line(slave_config, bytes)) {
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

}  // namespace detail

// Decodes `bytes` (the first reading_bytes() bytes of SCDATAx, page 26) of slave 1..8 of a valid
// `config`. kCorrupted when bits that the chip sets to 0 are not 0 or when the stored CRC does not
// belong to the data. kInvalidArgument: `slave` is not 1..8, or there are fewer bytes.
[[nodiscard]] constexpr Result<Reading> decode_reading(const Config& config, std::uint8_t slave,
                                                       Span<const std::uint8_t> bytes) {
  return is_in(0xFF, slave) && bytes.size() >= reading_bytes(config, slave)
             ? detail::decode_bytes(config, slave, bytes.data())
             : Result<Reading>(Error::kInvalidArgument);
}

}  // namespace mb4

#endif  // MB4_READING_HPP_
