// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Scans a channel: counts its slaves and reads their identities.

#ifndef MB4_SCAN_HPP_
#define MB4_SCAN_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/result.hpp"
#include "mb4/slave_address.hpp"

namespace mb4 {

// Standard registers of a BiSS C slave.
inline constexpr std::uint8_t kRegisterEdsBank = 0x41;
inline constexpr std::uint8_t kRegisterDeviceId = 0x78;  // six bytes, then two of the manufacturer

// The identity registers of one slave ID: raw bytes in the order of their addresses.
struct SlaveIdentity {
  std::array<std::uint8_t, 6> device_id{};     // 0x78..0x7D, ASCII by custom
  std::array<std::uint8_t, 2> manufacturer{};  // 0x7E, 0x7F
  std::uint8_t eds_bank = 0;                   // 0x41: first bank of the electronic data sheet
  // False: the slave does not have these registers; the bytes are 0.
  bool has_identity = false;
  // False: no such register, or it says that there is no EDS (0x00, 0xFF).
  bool has_eds = false;
};

namespace detail {

// Reads once more after kRegister without a byte: one disturbed frame must not hide a slave.
template <typename Device>
Result<void> read_twice(Device& device, SlaveAddress slave, std::uint8_t address,
                        Span<std::uint8_t> out) {
  const Result<void> first = device.control().read_registers(slave, address, out);
  return first.error() == Error::kRegister ? device.control().read_registers(slave, address, out)
                                           : first;
}

}  // namespace detail

// Reads ID 0, 1, ... of `channel` (1 or 2) until an ID does not answer; IDs have no gaps. Stores
// the identities of the first out.size() IDs. Returns how many have answered, 0..8. A device with
// several IDs counts once for each ID.
//
// The Config of that channel must have the right data lengths. Or no slave is enabled, with
// Config::hold_cdm and automatic frames of FrameStart::kPeriodic, whose period is longer than the
// slaves' timeout.
//
// Two register accesses for each slave, two more for the end. A register that a slave does not have
// takes the chip's time limit, about 26 ms at f_MA = 10 MHz.
//
// Errors of Control::read_registers(), except kRegisterDelay. kRegister: a slave has answered
// wrongly twice. kUnsupported also for BiSS B, where a missing slave looks like a slave without the
// register.
template <typename Device>
Result<std::uint8_t> scan_bus(Device& device, std::uint8_t channel, Span<SlaveIdentity> out) {
  if (channel >= 1 && channel <= kChannels &&
      device.config().channels[channel - 1U].protocol == Protocol::kBissB) {
    return ErrorInfo(Error::kUnsupported, ConfigField::kChannelProtocol, channel);
  }
  for (std::uint8_t id = 0; id < kSlaveIds; ++id) {
    const SlaveAddress slave{channel, id};
    SlaveIdentity identity;
    std::array<std::uint8_t, 8> bytes{};
    const Result<void> named = detail::read_twice(device, slave, kRegisterDeviceId, bytes);
    if (named.error() == Error::kRegister && named.info().bytes() == 0) {
      return id;
    }
    if (!named && named.error() != Error::kRegisterDelay) {
      return named.failure();
    }
    identity.has_identity = named.ok();
    // `bytes` is all zeros if the read failed.
    for (std::size_t i = 0; i < identity.device_id.size(); ++i) {
      identity.device_id[i] = bytes[i];
    }
    for (std::size_t i = 0; i < identity.manufacturer.size(); ++i) {
      identity.manufacturer[i] = bytes[identity.device_id.size() + i];
    }
    const Result<void> eds = detail::read_twice(device, slave, kRegisterEdsBank,
                                                Span<std::uint8_t>(&identity.eds_bank, 1));
    if (!eds && eds.error() != Error::kRegisterDelay) {
      return eds.failure();
    }
    identity.has_eds = eds.ok() && identity.eds_bank != 0x00 && identity.eds_bank != 0xFF;
    if (id < out.size()) {
      out[id] = identity;
    }
  }
  return kSlaveIds;
}

}  // namespace mb4

#endif  // MB4_SCAN_HPP_
