// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Checks the conditions for a control communication before it begins.

#ifndef MB4_DETAIL_CONTROL_CHECKS_HPP_
#define MB4_DETAIL_CONTROL_CHECKS_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/command.hpp"
#include "mb4/config.hpp"
#include "mb4/detail/chip_state.hpp"
#include "mb4/result.hpp"
#include "mb4/slave_address.hpp"
#include "mb4_regs.hpp"

namespace mb4::detail {

// `without`: the protocol that does not have this kind of access.
[[nodiscard]] inline Result<void> check_protocol(const ChipState& chip, std::uint8_t channel,
                                                 Protocol without) {
  const Protocol protocol = chip.config.channels[channel - 1U].protocol;
  if (protocol == Protocol::kUnused) {
    return Error::kInvalidArgument;
  }
  if (protocol == without) {
    return ErrorInfo(Error::kUnsupported, ConfigField::kChannelProtocol, channel);
  }
  return {};
}

[[nodiscard, gnu::always_inline]] inline Result<void> check_idle(const ChipState& chip) {
  if (!chip.configured) {
    return Error::kNotConfigured;
  }
  return chip.control_runs() || chip.in_doubt() ? Error::kBusy : Error::kNone;
}

[[nodiscard, gnu::always_inline]] inline Result<void> check_free(const ChipState& chip) {
  if (const Result<void> idle = check_idle(chip); !idle) {
    return idle;
  }
  if (!chip.automatic && chip.config.frame_start != FrameStart::kWaitForLine) {
    return ErrorInfo(Error::kUnsupported, ConfigField::kFrameStart, 0);
  }
  return {};
}

[[nodiscard, gnu::always_inline]] inline Result<void> check_access(const ChipState& chip,
                                                                   SlaveAddress slave,
                                                                   std::uint8_t address,
                                                                   std::size_t count,
                                                                   Protocol without) {
  if (const Result<void> free = check_free(chip); !free) {
    return free;
  }
  if (slave.channel < 1 || slave.channel > kChannels || slave.id >= kSlaveIds || count < 1 ||
      count > kMaxRegistersPerAccess || address + count > kSlaveRegisters) {
    return Error::kInvalidArgument;
  }
  if (chip.config.channels[slave.channel - 1U].protocol == Protocol::kBissB) {
    if (chip.config.mo && slave.id == 0) {
      return Error::kInvalidArgument;
    }
    if (chip.automatic) {
      return Error::kWrongMode;
    }
  }
  return check_protocol(chip, slave.channel, without);
}

[[nodiscard]] inline Result<void> check_command(const ChipState& chip, const Command& command) {
  if (const Result<void> free = check_free(chip); !free) {
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
                                      : check_protocol(chip, channel, Protocol::kBissB);
    if (!possible) {
      return possible;
    }
  }
  return {};
}

// The IDs of the enabled slaves of `channel` (1, 2), if it is BiSS C: bit n is ID n. Each slave has
// one.
[[nodiscard]] inline std::uint8_t biss_c_ids(const ChipState& chip, std::uint8_t channel) {
  unsigned ids = 0;
  if (chip.config.channels[channel - 1U].protocol == Protocol::kBissC) {
    for (unsigned left = slaves_of_channel(chip.config, channel); left != 0; left &= left - 1U) {
      ids = ids << 1U | 1U;
    }
  }
  return static_cast<std::uint8_t>(ids);
}

[[nodiscard]] inline Result<void> check_activate(const ChipState& chip, std::uint8_t ids_1,
                                                 std::uint8_t ids_2) {
  if (const Result<void> idle = check_idle(chip); !idle) {
    return idle;
  }
  for (std::uint8_t channel = 1; channel <= kChannels; ++channel) {
    const bool asked = (channel == 1 ? ids_1 : ids_2) != 0;
    if (asked && chip.config.channels[channel - 1U].protocol != Protocol::kBissC) {
      return ErrorInfo(Error::kUnsupported, ConfigField::kChannelProtocol, channel);
    }
  }
  return any_channel_is(chip.config, Protocol::kBissC)
             ? ErrorInfo()
             : ErrorInfo(Error::kUnsupported, ConfigField::kChannelProtocol, 1);
}

}  // namespace mb4::detail

#endif  // MB4_DETAIL_CONTROL_CHECKS_HPP_
