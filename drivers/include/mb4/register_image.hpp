// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Encodes a Config as the bytes of the chip's registers. Device uses it; others need it only to
// show or to store a register image.

#ifndef MB4_REGISTER_IMAGE_HPP_
#define MB4_REGISTER_IMAGE_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/crc.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

// First and last register of the configuration burst. The range includes the constant registers
// REVISION and VERSION, and it ends with the SVALID flags. The chip ignores writes to read-only
// bits (page 21), so one burst sets all registers and also clears the flags of old data.
inline constexpr std::uint8_t kImageFirst = regs::kAddrSlaveCfg;
inline constexpr std::uint8_t kImageLast = regs::kAddrSvalidHi;
inline constexpr std::size_t kImageBytes = kImageLast - kImageFirst + 1;
// The request of a control communication: 0xE2..0xE5.
inline constexpr std::size_t kRequestBytes = regs::kAddrCtrl - regs::kAddrRegadr + 1;

using RegisterImage = std::array<std::uint8_t, kImageBytes>;

namespace detail {

template <typename Field>
constexpr void put(RegisterImage& image, std::uint8_t value) {
  std::uint8_t& byte = image[Field::kAddress - kImageFirst];
  byte = Field::insert(byte, value);
}

template <typename Field, typename Code>
constexpr void put(RegisterImage& image, Code code) {
  put<Field>(image, static_cast<std::uint8_t>(code));
}

constexpr void put_slave(RegisterImage& image, const SlaveConfig& slave, std::size_t number) {
  const CrcCode crc_code = encode_crc(slave.crc_polynomial);
  // All slaves have the same layout: the fields of slave 1 at the address of slave `number`.
  const std::size_t base =
      regs::slave_cfg_address(static_cast<unsigned>(number)) - std::size_t{kImageFirst};
  // Bit 7 is GRAYSx of a sensor, LSTOPx of an actuator.
  const bool bit7 = slave.actuator ? slave.stop_bit : slave.gray;
  image[base + regs::kSlaveCfgLengthOffset] = static_cast<std::uint8_t>(
      regs::ENSCD<1>::encode<1>() | regs::GRAYS<1>::insert(0, bit7 ? 1 : 0) |
      regs::SCDLEN<1>::insert(0, static_cast<std::uint8_t>(slave.data_bits - 1U)));
  image[base + regs::kSlaveCfgCrcOffset] =
      regs::SELCRCS<1>::insert(crc_code.code, crc_code.by_polynomial ? 1 : 0);
  image[base + regs::kSlaveCfgCrcstartLoOffset] = static_cast<std::uint8_t>(slave.crc_start);
  image[base + regs::kSlaveCfgCrcstartHiOffset] = static_cast<std::uint8_t>(slave.crc_start >> 8);
}

constexpr std::uint8_t encode_freqags(const Config& config) {
  switch (config.frame_start) {
    case FrameStart::kPeriodic:
      return freqags_code(config.frame_period_clk).value_or(0);
    case FrameStart::kRequireIdleLine:
      return static_cast<std::uint8_t>(regs::AgsRate::kAgsInfinite);
    default:
      return static_cast<std::uint8_t>(regs::AgsRate::kAgsMin);
  }
}

// FREQR of Config::register_divider.
constexpr std::uint8_t encode_freqr(const Config& config) {
  return static_cast<std::uint8_t>(crc_width_bits(config.register_divider) - 1);
}

// The bits of 0xE5 that frames and INIT need.
constexpr std::uint8_t encode_ctrl(const Config& config, bool biss_b) {
  return static_cast<std::uint8_t>(regs::REGVERS::insert(0, biss_b ? 0 : 1) |
                                   regs::EN_MO::insert(0, config.mo ? 1 : 0) |
                                   regs::HOLDCDM::insert(0, config.hold_cdm ? 1 : 0));
}

}  // namespace detail

// Registers kImageFirst..kImageLast for a valid `config`. Registers of slaves that are not enabled
// and reserved registers are 0.
[[nodiscard]] constexpr RegisterImage encode_registers(const Config& config) {
  RegisterImage image{};
  for (std::size_t number = 1; number <= kSlaves; ++number) {
    if (config.slaves[number - 1].enabled) {
      detail::put_slave(image, config.slaves[number - 1], number);
    }
  }
  // The request at rest is a read of register 0, of ID 0 (0xE2..0xE5).
  image[regs::kAddrCtrl - kImageFirst] =
      regs::CTS::insert(detail::encode_ctrl(config, only_biss_b(config)), 1);
  detail::put<regs::FREQR>(image, detail::encode_freqr(config));
  detail::put<regs::FREQS>(image, freqs_code(config.f_clk_hz, config.ma_hz).value_or(0));
  detail::put<regs::NOCRC>(image, config.spi_check == SpiCheck::kOff ? regs::CrcStorage::kDropped
                                                                     : regs::CrcStorage::kStored);
  detail::put<regs::SINGLEBANK>(
      image, config.single_bank ? regs::BankMode::kOneBank : regs::BankMode::kTwoBanks);
  detail::put<regs::FREQAGS>(image, detail::encode_freqags(config));
  image[regs::kAddrMoBusy - kImageFirst] = config.mo_busy;
  image[regs::kAddrActnsens - kImageFirst] = actuators(config);
  // Bit 0 of 0xEC is constant 1 (table 6). The image holds this 1, so that the comparison needs no
  // exception.
  image[regs::kAddrSlaveloc5 - kImageFirst] = regs::kResetSlaveloc5;
  detail::put<regs::SLAVELOC5>(image, channels_are_split(config)
                                          ? regs::SlaveLocation::kSplit
                                          : regs::SlaveLocation::kAllOnChannel1);
  detail::put<regs::CFGCH1>(image, config.channels[0].protocol);
  detail::put<regs::CFGCH2>(image, config.channels[1].protocol);
  return image;
}

// Register 0xF5 for a valid `config`: clock source and interface. MA is not forced and the factory
// test is off.
[[nodiscard]] constexpr std::uint8_t encode_interface(const Config& config) {
  const std::uint8_t byte =
      regs::CFGIF::insert(0, static_cast<std::uint8_t>(config.line_interface));
  return regs::CLKENI::insert(byte, static_cast<std::uint8_t>(config.clock_source));
}

}  // namespace mb4

#endif  // MB4_REGISTER_IMAGE_HPP_
