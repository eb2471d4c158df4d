// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Cores with fewer features than the chip (FPGA builds): what they have, and the check of a Config
// against it. A core that is known when the program is compiled:
//
//   static_assert(mb4::validate(kConfig, mb4::kSingleCore).ok());
//
// One that tells what it is, over any bus:
//
//   const mb4::Result<mb4::Features> core = mb4::read_features(bus);
//   if (!core) return core.failure();
//   const mb4::Result<void> fits = mb4::validate(config, *core);

#ifndef MB4_CONFIG_FEATURES_HPP_
#define MB4_CONFIG_FEATURES_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/config/validate.hpp"
#include "mb4/opcodes.hpp"

namespace mb4 {

// The parameters of the core. The default is the whole chip.
struct Features {
  std::uint8_t lines = 2;
  // Data channels of each line: slaves 1 to `slaves`, and on channel 2 from 5 on.
  std::uint8_t slaves = 8;
  bool biss_b = true;
  bool ssi = true;
  bool mo = true;
  bool control = true;
  bool gray = true;
  // False: CRC 0x43 and 0x190D9 only.
  bool free_crc = true;
  std::uint8_t banks = 2;

  constexpr Features() = default;
  constexpr Features(unsigned line_count, unsigned slave_count, bool has_control, bool has_free_crc)
      : lines(static_cast<std::uint8_t>(line_count)),
        slaves(static_cast<std::uint8_t>(slave_count)),
        biss_b(false),
        ssi(false),
        mo(false),
        control(has_control),
        gray(false),
        free_crc(has_free_crc) {}
};

// The presets of the RTL.
inline constexpr Features kFullCore{};
inline constexpr Features kDriveCore{2, 2, true, true};
inline constexpr Features kSingleCore{1, 1, true, true};
inline constexpr Features kReaderCore{1, 1, false, false};

// Byte 0x7F of the core: 0 for the whole chip.
inline constexpr std::uint8_t kFeaturesAddress = 0x7F;

// What the byte at kFeaturesAddress tells. It does not tell the number of slaves beyond one, Gray
// code, and banks: these are as in the chip then.
[[nodiscard]] constexpr Features features_of(std::uint8_t byte) {
  Features features;
  if ((byte & 0x80U) == 0) {
    return features;
  }
  features.lines = (byte & 0x40U) != 0 ? 2 : 1;
  features.biss_b = (byte & 0x20U) != 0;
  features.ssi = (byte & 0x10U) != 0;
  features.mo = (byte & 0x08U) != 0;
  features.control = (byte & 0x04U) != 0;
  features.slaves = (byte & 0x02U) != 0 ? 8 : 1;
  features.free_crc = (byte & 0x01U) != 0;
  return features;
}

// Reads the byte at kFeaturesAddress. One transfer, changes nothing. kTransport.
template <typename Bus>
Result<Features> read_features(Bus& bus) {
  std::array<std::uint8_t, 1> byte{};
  if (const Result<void> read = Opcodes<Bus>(bus).read_registers(kFeaturesAddress, byte); !read) {
    return read.failure();
  }
  return features_of(byte[0]);
}

namespace detail {

constexpr bool has_protocol(const Features& core, Protocol protocol) {
  return (protocol != Protocol::kBissB || core.biss_b) && (protocol != Protocol::kSsi || core.ssi);
}

constexpr bool has_slave(const Features& core, const Config& config, std::size_t number) {
  return channel_of(config, number) == 1 ? number <= core.slaves
                                         : number - kSlaves / 2 <= core.slaves;
}

constexpr ConfigField absent_in_slave(const Features& core, const Config& config,
                                      std::size_t number) {
  const SlaveConfig& slave = config.slaves[number - 1];
  const std::uint32_t crc = slave.crc_polynomial;
  if (!has_slave(core, config, number)) {
    return ConfigField::kSlaveEnabled;
  }
  if (!core.free_crc && crc != 0 && crc != 0x43 && crc != 0x190D9) {
    return ConfigField::kCrcPolynomial;
  }
  return slave.gray && !core.gray ? ConfigField::kGray : ConfigField::kNone;
}

}  // namespace detail

// validate() for a core with `core`. kInvalidConfig also names the first member that asks for what
// the core does not have; kSingleBank asks for single_bank = true.
[[nodiscard]] constexpr Result<void> validate(const Config& config, const Features& core) {
  if (const Result<void> valid = validate(config); !valid) {
    return valid;
  }
  for (std::size_t number = 1; number <= kChannels; ++number) {
    const Protocol protocol = config.channels[number - 1].protocol;
    if (protocol != Protocol::kUnused &&
        (number > core.lines || !detail::has_protocol(core, protocol))) {
      return detail::invalid(ConfigField::kChannelProtocol, number);
    }
  }
  for (std::size_t number = 1; number <= kSlaves; ++number) {
    const ConfigField absent = config.slaves[number - 1].enabled
                                   ? detail::absent_in_slave(core, config, number)
                                   : ConfigField::kNone;
    if (absent != ConfigField::kNone) {
      return detail::invalid(absent, number);
    }
  }
  if (config.mo && !core.mo) {
    return detail::invalid(ConfigField::kMo);
  }
  return detail::invalid(core.banks == 1 && !config.single_bank ? ConfigField::kSingleBank
                                                                : ConfigField::kNone);
}

}  // namespace mb4

#endif  // MB4_CONFIG_FEATURES_HPP_
