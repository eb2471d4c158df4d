// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Checks the conditions for a control communication before it begins.

#ifndef MB4_DETAIL_CONTROL_CHECKS_HPP_
#define MB4_DETAIL_CONTROL_CHECKS_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/command.hpp"
#include "mb4/config.hpp"
#include "mb4/detail/chip.hpp"
#include "mb4/result.hpp"
#include "mb4/slave_address.hpp"
#include "mb4_regs.hpp"

namespace mb4::detail {

template <typename Bus, typename Clock>
class ControlChecks {
 public:
  explicit constexpr ControlChecks(Chip<Bus, Clock>& chip) : chip_(chip) {}

 protected:
  // `without`: the protocol that does not have this kind of access.
  [[nodiscard]] Result<void> check_protocol(std::uint8_t channel, Protocol without) const {
    const Protocol protocol = chip_.config.channels[channel - 1U].protocol;
    if (protocol == Protocol::kUnused) {
      return Error::kInvalidArgument;
    }
    if (protocol == without) {
      return ErrorInfo(Error::kUnsupported, ConfigField::kChannelProtocol, channel);
    }
    return {};
  }

  [[nodiscard]] bool is_biss_b(std::uint8_t channel) const {
    return chip_.config.channels[channel - 1U].protocol == Protocol::kBissB;
  }

  [[nodiscard]] Result<void> check_free() const {
    if (!chip_.configured) {
      return Error::kNotConfigured;
    }
    if (chip_.control.kind != ControlState::Kind::kNone) {
      return Error::kBusy;
    }
    if (!chip_.automatic && chip_.config.frame_start != FrameStart::kWaitForLine) {
      return ErrorInfo(Error::kUnsupported, ConfigField::kFrameStart, 0);
    }
    return {};
  }

  [[nodiscard]] Result<void> check_access(SlaveAddress slave, std::uint8_t address,
                                          std::size_t count, Protocol without) const {
    if (const Result<void> free = check_free(); !free) {
      return free;
    }
    if (slave.channel < 1 || slave.channel > kChannels || slave.id >= kSlaveIds || count < 1 ||
        count > kMaxRegistersPerAccess || address + count > kSlaveRegisters) {
      return Error::kInvalidArgument;
    }
    if (is_biss_b(slave.channel)) {
      if (chip_.config.mo && slave.id == 0) {
        return Error::kInvalidArgument;
      }
      if (chip_.automatic) {
        return Error::kWrongMode;
      }
    }
    return check_protocol(slave.channel, without);
  }

  [[nodiscard]] Result<void> check_command(const Command& command) const {
    if (const Result<void> free = check_free(); !free) {
      return free;
    }
    const bool broadcast = command.ids == 0;
    if (command.channels < 1 || command.channels > 3 || command.code > regs::CMD::kMax ||
        (broadcast && (command.test_acknowledge || command.code == regs::CMD::kMax))) {
      return Error::kInvalidArgument;
    }
    for (std::uint8_t channel = 1; channel <= kChannels; ++channel) {
      const Result<void> possible = (command.channels & channel) == 0
                                        ? Result<void>()
                                        : check_protocol(channel, Protocol::kBissB);
      if (!possible) {
        return possible;
      }
    }
    return {};
  }

  Chip<Bus, Clock>& chip_;
};

}  // namespace mb4::detail

#endif  // MB4_DETAIL_CONTROL_CHECKS_HPP_
