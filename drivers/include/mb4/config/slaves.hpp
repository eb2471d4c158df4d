// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Which slaves and protocols a Config has, and where. All functions are constexpr.

#ifndef MB4_CONFIG_SLAVES_HPP_
#define MB4_CONFIG_SLAVES_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/config/members.hpp"

namespace mb4 {

// Bytes of SCDATAx that hold data, 1..8.
[[nodiscard]] constexpr std::uint8_t data_bytes(const SlaveConfig& slave) {
  return static_cast<std::uint8_t>((slave.data_bits + 7U) / 8U);
}

// Bytes of SCDATAx that a stored CRC takes, 1 or 2. 0x12F is the longest polynomial whose CRC fits
// one byte.
[[nodiscard]] constexpr std::uint8_t crc_bytes(const SlaveConfig& slave) {
  return slave.crc_polynomial > 0x1FF ? 2 : 1;
}

// True if the chip stores this slave's CRC. The CRC takes the top byte of SCDATAx, a CRC of 16 bits
// the two top bytes, if the data leaves them free (page 26). For a valid `config`.
[[nodiscard]] constexpr bool crc_is_stored(const Config& config, const SlaveConfig& slave) {
  return config.spi_check != SpiCheck::kOff && slave.crc_polynomial != 0 &&
         data_bytes(slave) + crc_bytes(slave) <= 8;
}

// True if slaves 5 to 8 are on channel 2 (SLAVELOC5).
[[nodiscard]] constexpr bool channels_are_split(const Config& config) {
  return config.channels[1].protocol != Protocol::kUnused;
}

// Channel 1 or 2 of slave 1..8.
[[nodiscard, gnu::noinline]] constexpr std::uint8_t channel_of(const Config& config,
                                                               std::size_t slave) {
  return channels_are_split(config) && slave > kSlaves / 2 ? 2 : 1;
}

// Protocol of slave 1..8.
[[nodiscard]] constexpr Protocol protocol_of(const Config& config, std::size_t slave) {
  return config.channels[channel_of(config, slave) - 1U].protocol;
}

// True if a channel uses `protocol`.
[[nodiscard]] constexpr bool any_channel_is(const Config& config, Protocol protocol) {
  return config.channels[0].protocol == protocol || config.channels[1].protocol == protocol;
}

// True if BiSS B is in use and BiSS C is not. This is the protocol of INIT and of 0xE5 (REGVERS)
// while no control communication runs: one BiSS C channel makes it BiSS C.
[[nodiscard]] constexpr bool only_biss_b(const Config& config) {
  return any_channel_is(config, Protocol::kBissB) && !any_channel_is(config, Protocol::kBissC);
}

// Enabled slaves; bit 0 is slave 1.
[[nodiscard]] constexpr std::uint8_t enabled_slaves(const Config& config) {
  unsigned mask = 0;
  for (std::size_t i = kSlaves; i-- > 0;) {
    mask = mask << 1 | (config.slaves[i].enabled ? 1U : 0U);
  }
  return static_cast<std::uint8_t>(mask);
}

// Enabled slaves that take words (ACTnSENS).
[[nodiscard]] constexpr std::uint8_t actuators(const Config& config) {
  unsigned mask = 0;
  for (std::size_t i = kSlaves; i-- > 0;) {
    mask = mask << 1 | (config.slaves[i].enabled && config.slaves[i].actuator ? 1U : 0U);
  }
  return static_cast<std::uint8_t>(mask);
}

// Enabled slaves that deliver data.
[[nodiscard]] constexpr std::uint8_t sensors(const Config& config) {
  return static_cast<std::uint8_t>(enabled_slaves(config) & ~unsigned{actuators(config)});
}

// `config` without channel 1 or 2 and its slaves, for a line that is dead: a frame ends when all
// its lines have ended, so a line without an answer stops the other channel too.
[[nodiscard]] constexpr Config without_channel(Config config, std::uint8_t channel) {
  for (std::size_t slave = 1; slave <= kSlaves; ++slave) {
    if (channel_of(config, slave) == channel) {
      config.slaves[slave - 1].enabled = false;
    }
  }
  if (channel >= 1 && channel <= kChannels) {
    config.channels[channel - 1U].protocol = Protocol::kUnused;
  }
  return config;
}

// True if `slave` is 1..8 and in `mask` (bit 0 is slave 1). Any `slave` is allowed.
[[nodiscard]] constexpr bool is_in(std::uint8_t mask, std::uint8_t slave) {
  return (std::uint32_t{mask} << 1 >> (slave < 32 ? slave : 31) & 1U) != 0;
}

}  // namespace mb4

#endif  // MB4_CONFIG_SLAVES_HPP_
