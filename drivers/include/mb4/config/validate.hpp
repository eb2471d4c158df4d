// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The complete check of a Config. Everything is constexpr:
//
//   constexpr mb4::Config kConfig = make_config();
//   static_assert(mb4::validate(kConfig).ok());

#ifndef MB4_CONFIG_VALIDATE_HPP_
#define MB4_CONFIG_VALIDATE_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/config/frame_time.hpp"
#include "mb4/config/members.hpp"
#include "mb4/config/slaves.hpp"
#include "mb4/crc.hpp"
#include "mb4/error.hpp"
#include "mb4/frequency.hpp"
#include "mb4/result.hpp"

namespace mb4 {

namespace detail {

// A cast or the C binding can make enumeration values that are out of range.
template <typename Enumeration>
constexpr bool is_code(Enumeration value, Enumeration last) {
  return static_cast<std::uint8_t>(value) <= static_cast<std::uint8_t>(last);
}

// The ErrorInfo of an invalid `field`; success if `field` is kNone.
[[gnu::noinline]] constexpr ErrorInfo invalid(ConfigField field, std::size_t number = 0) {
  return field == ConfigField::kNone
             ? ErrorInfo()
             : ErrorInfo(Error::kInvalidConfig, field, static_cast<std::uint8_t>(number));
}

constexpr ConfigField wrong_in_clock(const Config& config) {
  constexpr std::uint32_t kMaxClkHz = 25'000'000;
  // 1 MHz is not from the datasheet, see Config::f_clk_hz.
  const std::uint32_t min_clk_hz =
      config.clock_source == ClockSource::kInternal ? 10'000'000 : 1'000'000;
  if (!is_code(config.clock_source, ClockSource::kInternal)) {
    return ConfigField::kClockSource;
  }
  if (config.f_clk_hz < min_clk_hz || config.f_clk_hz > kMaxClkHz) {
    return ConfigField::kClkHz;
  }
  return freqs_code(config.f_clk_hz, config.ma_hz) ? ConfigField::kNone : ConfigField::kMaHz;
}

constexpr ConfigField wrong_in_chip(const Config& config) {
  if (!is_code(config.line_interface, LineInterface::kLvds)) {
    return ConfigField::kLineInterface;
  }
  if (!is_code(config.spi_check, SpiCheck::kFullAndRelease)) {
    return ConfigField::kSpiCheck;
  }
  if (config.frame_timeout_us > kMaxFrameTimeoutUs) {
    return ConfigField::kFrameTimeoutUs;
  }
  if (config.register_busy_us > kMaxRegisterBusyUs) {
    return ConfigField::kRegisterBusyUs;
  }
  if (config.register_timeout_us > kMaxFrameTimeoutUs) {
    return ConfigField::kRegisterTimeoutUs;
  }
  if (config.mo_busy != 0 && !config.mo) {
    return ConfigField::kMoBusy;
  }
  // A power of two, 2 to 256; 64 with BiSS C (table 36).
  const unsigned divider = config.register_divider;
  const bool possible = divider >= 2 && divider <= 256 && (divider & (divider - 1)) == 0;
  return possible && (divider == 64 || !any_channel_is(config, Protocol::kBissC))
             ? ConfigField::kNone
             : ConfigField::kRegisterDivider;
}

// The period must be one of table 37 and long enough for a frame. Only kPeriodic has a period.
constexpr ConfigField wrong_in_frame_start(const Config& config) {
  if (!is_code(config.frame_start, FrameStart::kPeriodic)) {
    return ConfigField::kFrameStart;
  }
  const bool on_pin = config.frame_start == FrameStart::kOnPin;
  if (config.pin_period_us > (on_pin ? kMaxPinPeriodUs : 0) ||
      (config.pin_period_us != 0 &&
       config.pin_period_us + 1 < periods_us(config, frame_periods(config)))) {
    return ConfigField::kPinPeriodUs;
  }
  if (config.frame_start != FrameStart::kPeriodic) {
    return config.frame_period_clk == 0 ? ConfigField::kNone : ConfigField::kFramePeriodClk;
  }
  const std::uint32_t divider = ma_divider(freqs_code(config.f_clk_hz, config.ma_hz).value_or(0));
  // In hundredths of a period of MA, which need not be whole; 0.55 for the slaves' timeout.
  return freqags_code(config.frame_period_clk) &&
                 config.frame_period_clk * 100 >= (frame_periods(config) * 100 + 55) * divider
             ? ConfigField::kNone
             : ConfigField::kFramePeriodClk;
}

constexpr std::uint8_t slaves_of_channel(const Config& config, std::size_t number) {
  const unsigned first = channels_are_split(config) ? 0x0FU : 0xFFU;
  return static_cast<std::uint8_t>(enabled_slaves(config) & (number == 1 ? first : ~first));
}

// A channel in use has a slave; wrong_in_slave() looks for the reverse.
constexpr ErrorInfo check_channels(const Config& config) {
  if (config.channels[0].protocol == Protocol::kUnused && !channels_are_split(config)) {
    return invalid(ConfigField::kChannelProtocol, 1);
  }
  // Frames without data are not clocked out, so SL = 1 does not mean that the slave is ready
  // (page 30).
  const bool without_data = config.hold_cdm && config.frame_start != FrameStart::kWaitForLine;
  for (std::size_t number = 1; number <= kChannels; ++number) {
    const Protocol protocol = config.channels[number - 1].protocol;
    if (!is_code(protocol, Protocol::kUnused)) {
      return invalid(ConfigField::kChannelProtocol, number);
    }
    if (protocol != Protocol::kUnused && !without_data && slaves_of_channel(config, number) == 0) {
      return invalid(ConfigField::kSlaveEnabled, number == 1 ? 1 : kSlaves / 2 + 1);
    }
  }
  return {};
}

constexpr ConfigField wrong_in_slave(const Config& config, std::size_t number) {
  const SlaveConfig& slave = config.slaves[number - 1];
  const Protocol protocol = protocol_of(config, number);
  const bool ssi = protocol == Protocol::kSsi;
  if (protocol == Protocol::kUnused) {
    return ConfigField::kSlaveEnabled;
  }
  if (slave.data_bits < 1 || slave.data_bits > 64) {
    return ConfigField::kDataBits;
  }
  if (!is_code(slave.flags, Flags::kErrorWarning) ||
      (slave.flags == Flags::kErrorWarning && slave.data_bits < 3 && !slave.actuator)) {
    return ConfigField::kFlags;
  }
  if (!encode_crc(slave.crc_polynomial).valid) {
    return ConfigField::kCrcPolynomial;
  }
  if (slave.crc_polynomial == 0 && slave.crc_start != 0) {
    return ConfigField::kCrcStart;
  }
  if (slave.gray && !ssi) {
    return ConfigField::kGray;
  }
  return slave.actuator && (ssi || !config.mo) ? ConfigField::kActuator : ConfigField::kNone;
}

// Erratum 2 of table 68, before revision Y: data of actuators fails if there are some on both
// channels and the frames of the channels differ in length. For a valid `config`.
constexpr bool needs_revision_y(const Config& config) {
  const unsigned words = actuators(config);
  return words > 0x0F && (words & 0x0FU) != 0 && channels_are_split(config) &&
         channel_periods(config, 1) != channel_periods(config, 2);
}

constexpr ErrorInfo check_revision(std::uint8_t revision) {
  return revision < static_cast<std::uint8_t>(regs::DeviceRevision::kY)
             ? ErrorInfo(Error::kInvalidConfig, ConfigField::kActuator, kSlaves / 2 + 1)
             : ErrorInfo();
}

}  // namespace detail

// Checks the whole configuration; makes no transfer. kInvalidConfig: the chip does not allow a
// value; ErrorInfo names the first such member. Members of a slave that is not enabled are not
// checked.
[[nodiscard]] constexpr Result<void> validate(const Config& config) {
  ConfigField wrong = detail::wrong_in_clock(config);
  if (wrong == ConfigField::kNone) {
    wrong = detail::wrong_in_chip(config);
  }
  if (wrong != ConfigField::kNone) {
    return detail::invalid(wrong);
  }
  if (const ErrorInfo channels = detail::check_channels(config); channels.code != Error::kNone) {
    return channels;
  }
  for (std::size_t number = 1; number <= kSlaves; ++number) {
    wrong = config.slaves[number - 1].enabled ? detail::wrong_in_slave(config, number)
                                              : ConfigField::kNone;
    if (wrong != ConfigField::kNone) {
      return detail::invalid(wrong, number);
    }
  }
  if (config.activate_at_initialize &&
      (actuators(config) != 0 || !any_channel_is(config, Protocol::kBissC))) {
    return detail::invalid(ConfigField::kActivateAtInitialize);
  }
  // Last, because it needs the length of a frame.
  wrong = detail::wrong_in_frame_start(config);
  return detail::invalid(wrong);
}

// The same for a chip whose `revision` is known (Identity::revision). kInvalidConfig, kActuator, 5:
// the chip is older than revision Y, which cannot have actuators on both channels unless their
// frames are equally long (table 68). configure() asks the chip where this matters.
[[nodiscard]] constexpr Result<void> validate(const Config& config, std::uint8_t revision) {
  const Result<void> valid = validate(config);
  return valid && detail::needs_revision_y(config) ? detail::check_revision(revision) : valid;
}

}  // namespace mb4

#endif  // MB4_CONFIG_VALIDATE_HPP_
