// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Values that follow from a Config. All functions are constexpr.

#ifndef MB4_CONFIG_FIGURES_HPP_
#define MB4_CONFIG_FIGURES_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/config_data.hpp"
#include "mb4/crc.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

// Bytes of SCDATAx that hold data, 1..8.
[[nodiscard]] constexpr std::uint8_t data_bytes(const SlaveConfig& slave) {
  return static_cast<std::uint8_t>((slave.data_bits + 7U) / 8U);
}

// True if the chip stores this slave's CRC. The CRC takes the top byte of SCDATAx, a CRC of 16 bits
// the two top bytes, if the data leaves them free (page 26). For a valid `config`.
[[nodiscard]] constexpr bool crc_is_stored(const Config& config, const SlaveConfig& slave) {
  // 0x12F is the longest polynomial whose CRC fits one byte.
  const unsigned crc_bytes = slave.crc_polynomial > 0x1FF ? 2 : 1;
  return config.spi_check != SpiCheck::kOff && slave.crc_polynomial != 0 &&
         data_bytes(slave) + crc_bytes <= 8;
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

// True if `slave` is 1..8 and in `mask` (bit 0 is slave 1). Any `slave` is allowed.
[[nodiscard]] constexpr bool is_in(std::uint8_t mask, std::uint8_t slave) {
  return (std::uint32_t{mask} << 1 >> (slave < 32 ? slave : 31) & 1U) != 0;
}

// Periods of MA in a frame without processing time, for the channel with the longer frame. A frame
// has 5 periods in BiSS C (acknowledge, start, CDS), 4 in BiSS B (no CDS), 1 in SSI. Data, CRC and
// an actuator's stop bit are added, and in BiSS MO_BUSY.
[[nodiscard]] constexpr std::uint32_t frame_periods(const Config& config) {
  std::uint32_t longest = 0;
  for (std::uint8_t channel = 1; channel <= kChannels; ++channel) {
    const Protocol protocol = config.channels[channel - 1U].protocol;
    std::uint32_t periods = 5U + config.mo_busy;
    if (protocol != Protocol::kBissC) {
      periods = protocol == Protocol::kSsi ? 1U : 4U + config.mo_busy;
    }
    for (std::size_t slave = 1; slave <= kSlaves; ++slave) {
      const SlaveConfig& one = config.slaves[slave - 1];
      if (one.enabled && channel_of(config, slave) == channel) {
        periods += one.data_bits + std::uint32_t{crc_width_bits(one.crc_polynomial)};
        periods += one.actuator && one.stop_bit ? 1U : 0U;
      }
    }
    longest = periods > longest ? periods : longest;
  }
  return longest;
}

// The calculated timeout adds this time to the MA periods of the frame. It covers the slaves'
// timeout of the previous frame (up to 40 us), the slave's processing time, the line delay and the
// SPI transfers.
inline constexpr std::uint32_t kFrameMarginUs = 200;

namespace detail {

// Adds the spread of the internal oscillator, which may run at 10 MHz while f_clk_hz says 25 MHz
// (D05).
[[gnu::noinline]] constexpr std::uint32_t with_spread(const Config& config, std::uint32_t time) {
  return config.clock_source == ClockSource::kInternal ? 3 * time : time;
}

// Converts up to 4 million periods of MA to microseconds, rounded up. It does without a division of
// 64 bits, which costs 1 KB on a small core.
[[gnu::noinline]] constexpr std::uint32_t periods_us(const Config& config, std::uint32_t periods) {
  return periods * 1000U / (config.ma_hz / 1000U) + 1U;
}

}  // namespace detail

// The timeout of a frame in microseconds: Config::frame_timeout_us, or, if that is 0, the time of
// the frame plus kFrameMarginUs. For a valid `config`.
[[nodiscard]] constexpr std::uint32_t frame_timeout_us(const Config& config) {
  if (config.frame_timeout_us != 0) {
    return config.frame_timeout_us;
  }
  // Eight slaves need at most 908 * 3 periods; 2'724'000'000 fits 32 bits.
  return detail::with_spread(config, frame_periods(config)) * 1'000'000U / config.ma_hz + 1 +
         kFrameMarginUs;
}

}  // namespace mb4

#endif  // MB4_CONFIG_FIGURES_HPP_
