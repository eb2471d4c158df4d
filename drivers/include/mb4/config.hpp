// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The configuration, figures derived from it, and its complete validation. Everything is constexpr:
//
//   constexpr mb4::Config kConfig = make_config();
//   static_assert(mb4::validate(kConfig).ok());

#ifndef MB4_CONFIG_HPP_
#define MB4_CONFIG_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/config_data.hpp"
#include "mb4/crc.hpp"
#include "mb4/frequency.hpp"
#include "mb4/result.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

// ---- Derived figures ----------------------------------------------------------------------------

// Bytes of SCDATAx that hold data, 1..8.
[[nodiscard]] constexpr std::uint8_t data_bytes(const SlaveConfig& slave) {
  return static_cast<std::uint8_t>((slave.data_bits + 7U) / 8U);
}

// Whether the chip stores this slave's CRC: it takes the top byte of SCDATAx, CRC16 the two top
// bytes, if data leaves them free (page 26). For a valid `config`.
[[nodiscard]] constexpr bool crc_is_stored(const Config& config, const SlaveConfig& slave) {
  const std::uint8_t width_bits = crc_width_bits(slave.crc_polynomial);
  return config.spi_check != SpiCheck::kOff && width_bits != 0 &&
         data_bytes(slave) + (width_bits + 7U) / 8U <= 8U;
}

// Whether slaves 5 to 8 are on channel 2 (SLAVELOC5).
[[nodiscard]] constexpr bool channels_are_split(const Config& config) {
  return config.channels[1].protocol != Protocol::kUnused;
}

// Channel 1 or 2 of slave 1..8.
[[nodiscard]] constexpr std::uint8_t channel_of(const Config& config, std::size_t slave) {
  return channels_are_split(config) && slave > kSlaves / 2 ? 2 : 1;
}

// Enabled slaves; bit 0 is slave 1.
[[nodiscard]] constexpr std::uint8_t enabled_slaves(const Config& config) {
  unsigned mask = 0;
  for (std::size_t i = 0; i < kSlaves; ++i) {
    mask |= (config.slaves[i].enabled ? 1U : 0U) << i;
  }
  return static_cast<std::uint8_t>(mask);
}

// Rising edges of MA in a frame without processing time: acknowledge, start, CDS, data and CRC of
// the longer channel.
[[nodiscard]] constexpr std::uint32_t frame_periods(const Config& config) {
  std::uint32_t periods[kChannels] = {5, 5};
  for (std::size_t slave = 1; slave <= kSlaves; ++slave) {
    const SlaveConfig& one = config.slaves[slave - 1];
    if (one.enabled) {
      periods[channel_of(config, slave) - 1] +=
          std::uint32_t{one.data_bits} + encode_crc(one.crc_polynomial).width_bits;
    }
  }
  return periods[0] > periods[1] ? periods[0] : periods[1];
}

// Allowance of the calculated timeout for everything that is not MA periods of the frame: a
// previous slave timeout (up to 40 us), the slave's processing time, line delay, the SPI transfers.
inline constexpr std::uint32_t kFrameMarginUs = 200;

// The timeout in force: the configured one, or the calculated one: acknowledge, start, CDS, all
// data and CRC bits, and kFrameMarginUs. For a valid `config`.
[[nodiscard]] constexpr std::uint32_t frame_timeout_us(const Config& config) {
  if (config.frame_timeout_us != 0) {
    return config.frame_timeout_us;
  }
  std::uint32_t periods = frame_periods(config);
  // The internal oscillator may run at 10 MHz while f_clk_hz says 25 MHz (D05).
  if (config.clock_source == ClockSource::kInternal) {
    periods *= 3;
  }
  // Eight slaves need at most 645 * 3 periods; 1'935'000'000 fits 32 bits.
  return periods * 1'000'000U / config.ma_hz + 1 + kFrameMarginUs;
}

// ---- Validation ---------------------------------------------------------------------------------

namespace detail {

constexpr ErrorInfo invalid(ConfigField field, std::size_t number = 0) {
  return ErrorInfo(Error::kInvalidConfig, field, static_cast<std::uint8_t>(number));
}

constexpr ErrorInfo unsupported(ConfigField field, std::size_t number = 0) {
  return ErrorInfo(Error::kUnsupported, field, static_cast<std::uint8_t>(number));
}

constexpr ErrorInfo check_clock(const Config& config) {
  constexpr std::uint32_t kMaxClkHz = 25'000'000;
  std::uint32_t min_clk_hz = 0;
  switch (config.clock_source) {
    case ClockSource::kExternal:
      min_clk_hz = 1'000'000;  // not from the datasheet, see Config::f_clk_hz
      break;
    case ClockSource::kInternal:
      min_clk_hz = 10'000'000;
      break;
    default:
      return invalid(ConfigField::kClockSource);
  }
  if (config.f_clk_hz < min_clk_hz || config.f_clk_hz > kMaxClkHz) {
    return invalid(ConfigField::kClkHz);
  }
  return freqs_code(config.f_clk_hz, config.ma_hz).info();
}

// The period must be one of table 37 and hold a frame; it belongs to kPeriodic alone.
constexpr ErrorInfo check_frame_start(const Config& config) {
  switch (config.frame_start) {
    case FrameStart::kWaitForLine:
    case FrameStart::kRequireIdleLine:
      return config.frame_period_clk == 0 ? ErrorInfo() : invalid(ConfigField::kFramePeriodClk);
    case FrameStart::kPeriodic:
      break;
    default:
      return invalid(ConfigField::kFrameStart);
  }
  if (const Result<std::uint8_t> code = freqags_code(config.frame_period_clk); !code) {
    return code.info();
  }
  const std::uint32_t divider = ma_divider(freqs_code(config.f_clk_hz, config.ma_hz).value_or(0));
  // In hundredths of a period of MA, which need not be whole.
  return config.frame_period_clk * 100 >= (frame_periods(config) * 100 + 55) * divider
             ? ErrorInfo()
             : invalid(ConfigField::kFramePeriodClk);
}

constexpr ErrorInfo check_chip(const Config& config) {
  switch (config.line_interface) {
    case LineInterface::kTtl:
    case LineInterface::kCmos:
    case LineInterface::kRs422:
    case LineInterface::kLvds:
      break;
    default:
      return invalid(ConfigField::kLineInterface);
  }
  if (config.spi_check != SpiCheck::kOff && config.spi_check != SpiCheck::kCrc &&
      config.spi_check != SpiCheck::kFull) {
    return invalid(ConfigField::kSpiCheck);
  }
  if (config.frame_timeout_us > kMaxFrameTimeoutUs) {
    return invalid(ConfigField::kFrameTimeoutUs);
  }
  return config.register_busy_us > kMaxRegisterBusyUs ? invalid(ConfigField::kRegisterBusyUs)
                                                      : ErrorInfo();
}

constexpr bool channel_has_slave(const Config& config, std::size_t number) {
  for (std::size_t slave = 1; slave <= kSlaves; ++slave) {
    if (config.slaves[slave - 1].enabled && channel_of(config, slave) == number) {
      return true;
    }
  }
  return false;
}

constexpr ErrorInfo check_channel(const Config& config, std::size_t number) {
  switch (config.channels[number - 1].protocol) {
    case Protocol::kBissC:
    case Protocol::kUnused:
      return {};
    case Protocol::kBissB:
    case Protocol::kSsi:
      return unsupported(ConfigField::kChannelProtocol, number);
    default:
      return invalid(ConfigField::kChannelProtocol, number);
  }
}

// A channel in use and its slaves belong together.
constexpr ErrorInfo check_occupation(const Config& config) {
  bool any_used = false;
  for (std::size_t number = 1; number <= kChannels; ++number) {
    if (config.channels[number - 1].protocol == Protocol::kUnused) {
      continue;
    }
    any_used = true;
    // Such frames are not clocked out, so SL = 1 does not mean that the slave is ready (page 30).
    const bool without_data = config.hold_cdm && config.frame_start != FrameStart::kWaitForLine;
    if (!without_data && !channel_has_slave(config, number)) {
      return invalid(ConfigField::kSlaveEnabled, number == 1 ? 1 : kSlaves / 2 + 1);
    }
  }
  if (!any_used) {
    return invalid(ConfigField::kChannelProtocol, 1);
  }
  for (std::size_t slave = 1; slave <= kSlaves; ++slave) {
    if (config.slaves[slave - 1].enabled &&
        config.channels[channel_of(config, slave) - 1U].protocol == Protocol::kUnused) {
      return invalid(ConfigField::kSlaveEnabled, slave);
    }
  }
  return {};
}

constexpr ErrorInfo check_slave(const SlaveConfig& slave, std::size_t number) {
  if (slave.data_bits < 1 || slave.data_bits > 64) {
    return invalid(ConfigField::kDataBits, number);
  }
  switch (slave.flags) {
    case Flags::kNone:
      break;
    case Flags::kErrorWarning:
      if (slave.data_bits < 3) {
        return invalid(ConfigField::kFlags, number);
      }
      break;
    default:
      return invalid(ConfigField::kFlags, number);
  }
  if (!encode_crc(slave.crc_polynomial).valid) {
    return invalid(ConfigField::kCrcPolynomial, number);
  }
  if (slave.crc_polynomial == 0 && slave.crc_start != 0) {
    return invalid(ConfigField::kCrcStart, number);
  }
  return {};
}

}  // namespace detail

// Checks everything there is to check before a transfer. kInvalidConfig: the chip cannot do it.
// kUnsupported: this driver version cannot. ErrorInfo names the first offending member. Members of
// a slave that is not enabled are not looked at.
[[nodiscard]] constexpr Result<void> validate(const Config& config) {
  ErrorInfo problem = detail::check_clock(config);
  if (problem.code == Error::kNone) {
    problem = detail::check_chip(config);
  }
  for (std::size_t number = 1; number <= kChannels && problem.code == Error::kNone; ++number) {
    problem = detail::check_channel(config, number);
  }
  if (problem.code == Error::kNone) {
    problem = detail::check_occupation(config);
  }
  for (std::size_t number = 1; number <= kSlaves && problem.code == Error::kNone; ++number) {
    if (config.slaves[number - 1].enabled) {
      problem = detail::check_slave(config.slaves[number - 1], number);
    }
  }
  // Last, because it needs the length of a frame.
  if (problem.code == Error::kNone) {
    problem = detail::check_frame_start(config);
  }
  return problem;
}

}  // namespace mb4

#endif  // MB4_CONFIG_HPP_
