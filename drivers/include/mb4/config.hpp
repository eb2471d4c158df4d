// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// What the chip shall do, in real units, and its complete validation. Everything is constexpr:
//
//   constexpr mb4::Config kConfig = make_config();
//   static_assert(mb4::validate(kConfig).ok());

#ifndef MB4_CONFIG_HPP_
#define MB4_CONFIG_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/crc.hpp"
#include "mb4/result.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

inline constexpr std::size_t kSlaves = 8;
inline constexpr std::size_t kChannels = 2;

// CFGCHx, table 8, page 23.
using Protocol = regs::Protocol;
// CLKENI, table 7, page 23.
using ClockSource = regs::ClockSource;
// CFGIF, table 9, page 23.
using LineInterface = regs::LineInterface;

// What happens when a frame is requested while SL is low, as it is until the slaves' timeout after
// the previous frame is over (page 32).
enum class FrameStart : std::uint8_t {
  // The chip waits for SL = 1 (FREQAGS = AGSMIN). Frames can be requested back to back.
  kWaitForLine = 0,
  // The chip refuses and sets nAGSERR = 0, read_frame() returns kLineError at once. The caller
  // keeps frames apart by the slaves' timeout.
  kRequireIdleLine = 1,
};

// Which of the data bits are not position.
enum class Flags : std::uint8_t {
  kNone = 0,
  // The last two data bits are nE and nW: error and warning, both active low.
  kErrorWarning = 1,
};

// One single-cycle data channel of the chip.
struct SlaveConfig {
  bool enabled = false;
  // Data length on the line without CRC: position and flags. 1..64; with flags 3..64.
  std::uint8_t data_bits = 0;
  Flags flags = Flags::kErrorWarning;
  // Full polynomial, 0x43 = x^6 + x + 1; 0 = no CRC. See encode_crc() for what the chip can do.
  std::uint32_t crc_polynomial = 0x43;
  // Start value; only as many low bits count as the CRC is wide. 0 when there is no CRC.
  std::uint16_t crc_start = 0;
};

struct ChannelConfig {
  Protocol protocol = Protocol::kUnused;
};

// Complete configuration of one chip. This driver version accepts one slave on channel 1, BiSS C;
// other combinations are reported as kUnsupported.
struct Config {
  // System clock. Pin CLK: at most 25 MHz (D01, page 9). D01 states no minimum; validate() asks
  // for 1 MHz, which is this driver's own choice. Internal: 10..25 MHz (D05), 20 MHz typical with a
  // wide spread, so ma_hz and the timeout are then only as good as this figure. A slow system clock
  // limits SCLK: <= 2 * f_clk_hz is always safe, see bus.hpp; the driver cannot check it.
  std::uint32_t f_clk_hz = 20'000'000;
  ClockSource clock_source = ClockSource::kExternal;

  // Clock at pin MA. Must be one of the 31 frequencies of table 35 (page 30), in whole hertz,
  // rounded down: use ma_hz_at_most() to choose. Each MA half period must be shorter than the
  // shortest timeout of the slaves.
  std::uint32_t ma_hz = 0;

  LineInterface line_interface = LineInterface::kTtl;
  FrameStart frame_start = FrameStart::kWaitForLine;

  // True: the chip also stores the received CRC (NOCRC = 0). Then read_frame() fetches all 8 bytes
  // of the slave, repeats the CRC check on what came over SPI, and returns the CRC. False: only the
  // bytes that hold data are read.
  bool store_crc = false;

  // Longest time from the request of a frame to its end, 1..1'000'000 us. 0 = calculated, see
  // frame_timeout_us().
  std::uint32_t frame_timeout_us = 0;

  std::array<ChannelConfig, kChannels> channels{};  // [0] is channel 1
  std::array<SlaveConfig, kSlaves> slaves{};        // [0] is slave 1, next to SL, SCDATA1
};

inline constexpr std::uint32_t kMaxFrameTimeoutUs = 1'000'000;

// ---- MA frequency: table 35, page 30 ------------------------------------------------------------

inline constexpr std::uint8_t kFreqsCodes = 32;

// f_CLK / f_MA for a FREQS code 0..31; 0 for code 0x10 (not permitted) and for codes above 31.
[[nodiscard]] constexpr std::uint32_t ma_divider(std::uint8_t freqs_code) {
  if (freqs_code < 0x10) {
    return 2U * (freqs_code + 1U);
  }
  if (freqs_code > 0x10 && freqs_code < kFreqsCodes) {
    return 20U * (freqs_code - 15U);
  }
  return 0;
}

// FREQS code whose frequency, rounded down to whole hertz, is `ma_hz`. kInvalidConfig (kMaHz) when
// there is none.
[[nodiscard]] constexpr Result<std::uint8_t> freqs_code(std::uint32_t f_clk_hz,
                                                        std::uint32_t ma_hz) {
  for (std::uint8_t code = 0; code < kFreqsCodes; ++code) {
    const std::uint32_t divider = ma_divider(code);
    if (divider != 0 && f_clk_hz / divider == ma_hz && ma_hz != 0) {
      return code;
    }
  }
  return ErrorInfo(Error::kInvalidConfig, ConfigField::kMaHz, 0);
}

// Highest frequency of table 35 that does not exceed `limit_hz`, in whole hertz, rounded down;
// 0 when even f_CLK / 320 is too fast.
[[nodiscard]] constexpr std::uint32_t ma_hz_at_most(std::uint32_t f_clk_hz,
                                                    std::uint32_t limit_hz) {
  std::uint32_t best_hz = 0;
  for (std::uint8_t code = 0; code < kFreqsCodes; ++code) {
    const std::uint32_t divider = ma_divider(code);
    // The comparison is exact: f / divider <= limit, without the rounding.
    if (divider != 0 && f_clk_hz <= std::uint64_t{limit_hz} * divider &&
        f_clk_hz / divider > best_hz) {
      best_hz = f_clk_hz / divider;
    }
  }
  return best_hz;
}

// ---- Derived figures ----------------------------------------------------------------------------

// Bytes of SCDATAx that hold data, 1..8.
[[nodiscard]] constexpr std::uint8_t data_bytes(const SlaveConfig& slave) {
  return static_cast<std::uint8_t>((slave.data_bits + 7U) / 8U);
}

// Whether the chip stores this slave's CRC: it takes the top byte of SCDATAx, CRC16 the two top
// bytes, if data leaves them free (page 26).
[[nodiscard]] constexpr bool crc_is_stored(const Config& config, const SlaveConfig& slave) {
  const std::uint8_t width_bits = encode_crc(slave.crc_polynomial).width_bits;
  return config.store_crc && width_bits != 0 && data_bytes(slave) + (width_bits + 7U) / 8U <= 8U;
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
  std::uint32_t periods = 5;
  for (const SlaveConfig& slave : config.slaves) {
    if (slave.enabled) {
      periods += slave.data_bits + encode_crc(slave.crc_polynomial).width_bits;
    }
  }
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
  switch (config.frame_start) {
    case FrameStart::kWaitForLine:
    case FrameStart::kRequireIdleLine:
      break;
    default:
      return invalid(ConfigField::kFrameStart);
  }
  if (config.frame_timeout_us > kMaxFrameTimeoutUs) {
    return invalid(ConfigField::kFrameTimeoutUs);
  }
  return {};
}

constexpr ErrorInfo check_channel(const Config& config, std::size_t number) {
  switch (config.channels[number - 1].protocol) {
    case Protocol::kBissC:
      return number == 1 ? ErrorInfo() : unsupported(ConfigField::kChannelProtocol, number);
    case Protocol::kUnused:
      return number == 2 ? ErrorInfo() : invalid(ConfigField::kChannelProtocol, number);
    case Protocol::kBissB:
    case Protocol::kSsi:
      return unsupported(ConfigField::kChannelProtocol, number);
    default:
      return invalid(ConfigField::kChannelProtocol, number);
  }
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
  for (std::size_t number = 1; number <= kSlaves && problem.code == Error::kNone; ++number) {
    const SlaveConfig& slave = config.slaves[number - 1];
    if (slave.enabled) {
      problem = number == 1 ? detail::check_slave(slave, number)
                            : detail::unsupported(ConfigField::kSlaveEnabled, number);
    }
  }
  if (problem.code == Error::kNone && !config.slaves[0].enabled) {
    problem = detail::invalid(ConfigField::kSlaveEnabled, 1);
  }
  return problem;
}

}  // namespace mb4

#endif  // MB4_CONFIG_HPP_
