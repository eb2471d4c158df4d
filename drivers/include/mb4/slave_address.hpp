// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The address of a slave and of its registers in a control communication.

#ifndef MB4_SLAVE_ADDRESS_HPP_
#define MB4_SLAVE_ADDRESS_HPP_

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

}  // namespace mb4

#endif  // MB4_SLAVE_ADDRESS_HPP_
