// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The addresses of a control communication, and its time limits.

#ifndef MB4_CONTROL_DATA_HPP_
#define MB4_CONTROL_DATA_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/config.hpp"

namespace mb4 {

// Registers that one access can transfer (REGNUM, table 30); registers of a slave that the 7-bit
// address reaches (table 28); slave IDs of a channel.
inline constexpr std::size_t kMaxRegistersPerAccess = 64;
inline constexpr std::size_t kSlaveRegisters = 128;
inline constexpr std::uint8_t kSlaveIds = 8;

// The slave of an access: channel 1 or 2, and slave ID 0..7. ID 0 is the last slave of the channel,
// the one farthest from SL; see slave_address().
struct SlaveAddress {
  std::uint8_t channel = 1;
  std::uint8_t id = 0;
};

// The address of slave `slave` (1..8, enabled, as in SCDATAx) on a channel where every device has
// one data channel and one ID. IDs count from the far end: of n slaves on the channel, the one next
// to SL has ID n - 1. BiSS B counts from 1 where MO is in use (page 16).
[[nodiscard]] constexpr SlaveAddress slave_address(const Config& config, std::uint8_t slave) {
  SlaveAddress address;
  address.channel = channel_of(config, slave);
  address.id = config.mo && protocol_of(config, slave) == Protocol::kBissB ? 1 : 0;
  for (std::size_t other = slave + 1U; other <= kSlaves; ++other) {
    if (config.slaves[other - 1].enabled && channel_of(config, other) == address.channel) {
      ++address.id;
    }
  }
  return address;
}

// A BiSS command (page 29).
struct Command {
  // CHSEL: bit 0 = channel 1, bit 1 = channel 2; both at once are allowed.
  std::uint8_t channels = 1;
  // Addressed slaves: bit n = ID n. 0 = broadcast, which no slave acknowledges.
  std::uint8_t ids = 0;
  // CMD, 0..3. Broadcast 3 is reserved. Protocol and device define the meaning of the codes; for
  // example broadcast 0 ends the single-cycle data of all slaves.
  std::uint8_t code = 0;
  // IDA_TEST: the slaves execute only if exactly those addressed have acknowledged. Not with
  // broadcast.
  bool test_acknowledge = false;
};

namespace detail {

// Reverses the order of the bits: bit 0 becomes bit 7.
constexpr std::uint8_t reversed(std::uint8_t bits) {
  unsigned out = 0;
  for (unsigned bit = 0; bit < 8; ++bit) {
    out |= (bits >> bit & 1U) << (7 - bit);
  }
  return static_cast<std::uint8_t>(out);
}

// Frames of an access to `count` registers without busy time: 14 with CDM = 0, 18 for the header,
// 14 for each register, one for the last CDS, and two as a reserve. A command needs fewer frames
// than a register.
constexpr std::uint32_t control_frames(std::uint8_t count) {
  return 14U + 18U + 14U * count + 1U + 2U;
}

// The chip's time limit for a slave's answer: 4096 register clocks (pages 30, 34).
constexpr std::uint32_t register_limit_us(const Config& config) {
  return periods_us(config, 4096U * config.register_divider);
}

// Time that a slave may take beyond the frames of its access: Config::register_busy_us, or, if that
// is 0, the chip's limit plus a quarter. The chip then reports nDELAYERR before the driver's time
// is over.
constexpr std::uint32_t register_busy_us(const Config& config) {
  return config.register_busy_us != 0
             ? config.register_busy_us
             : with_spread(config, periods_us(config, 5120U * config.register_divider));
}

// Longest time from one automatic frame to the next, in microseconds. With FrameStart::kOnPin the
// pulses at the pin decide; the function then returns the timeout of a frame.
constexpr std::uint32_t frame_pitch_us(const Config& config) {
  return config.frame_start != FrameStart::kPeriodic
             ? frame_timeout_us(config)
             : with_spread(config, config.frame_period_clk / (config.f_clk_hz / 1'000'000U) + 1U);
}

// Longest time of an access, in microseconds: at most 930 * 1 s + 13 s, which fits 32 bits.
constexpr std::uint32_t control_timeout_us(const Config& config, std::uint8_t count) {
  return control_frames(count) * frame_pitch_us(config) + register_busy_us(config) + kFrameMarginUs;
}

// The same for BiSS B, which needs no frames: the hand-over, 18 register clocks for the address, 14
// for each register.
constexpr std::uint32_t biss_b_timeout_us(const Config& config, std::uint8_t count) {
  const std::uint32_t clocks = 5120U + 18U + 14U * count;
  return with_spread(config, periods_us(config, clocks * config.register_divider)) +
         register_busy_us(config) + kFrameMarginUs;
}

// Largest number of frames of an access without automatic frames, where the host sets the pace. A
// busy slave takes as many frames as fit into its time. Each frame lasts at least its MA periods.
constexpr std::uint32_t control_frame_limit(const Config& config, std::uint8_t count) {
  // The product must fit 32 bits. So it uses kHz, and ms for long times, both rounded up. The
  // largest cases are 327'681 ms at 3 kHz and 10'000 ms at 12'500 kHz.
  constexpr std::uint32_t kShortUs = 340'000;
  const std::uint32_t busy_us = register_busy_us(config);
  const std::uint32_t ma_khz = config.ma_hz / 1000U + 1U;
  const std::uint32_t busy_periods =
      busy_us <= kShortUs ? busy_us * ma_khz / 1000U + 1U : (busy_us / 1000U + 1U) * ma_khz;
  return control_frames(count) + busy_periods / frame_periods(config) + 1U;
}

}  // namespace detail
}  // namespace mb4

#endif  // MB4_CONTROL_DATA_HPP_
