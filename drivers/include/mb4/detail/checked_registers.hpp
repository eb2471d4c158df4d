// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Writes and reads registers of the chip with the checks that SpiCheck selects.

#ifndef MB4_DETAIL_CHECKED_REGISTERS_HPP_
#define MB4_DETAIL_CHECKED_REGISTERS_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/detail/chip.hpp"
#include "mb4/opcodes.hpp"
#include "mb4/result.hpp"
#include "mb4/span.hpp"

namespace mb4::detail {

// Reads data.size() (1..64) registers and compares them with `data`. One transfer. kTransport;
// kCorrupted: they differ.
template <typename Bus, typename Clock>
Result<void> compare_registers(Chip<Bus, Clock>& chip, std::uint8_t address,
                               Span<const std::uint8_t> data) {
  std::array<std::uint8_t, kMaxBurstBytes> bytes{};
  const Result<void> read =
      chip.opcodes.read_registers(address, Span<std::uint8_t>(bytes.data(), data.size()));
  if (!read) {
    return read;
  }
  for (std::size_t i = 0; i < data.size(); ++i) {
    if (bytes[i] != data[i]) {
      return Error::kCorrupted;
    }
  }
  return {};
}

// Writes registers; with SpiCheck::kFull it reads them back. kTransport; kCorrupted: they differ.
template <typename Bus, typename Clock>
Result<void> write_checked(Chip<Bus, Clock>& chip, std::uint8_t address,
                           Span<const std::uint8_t> data) {
  const Result<void> written = chip.opcodes.write_registers(address, data);
  return written && chip.checks_all() ? compare_registers(chip, address, data) : written;
}

// Reads registers; with SpiCheck::kFull it reads them again. kTransport; kCorrupted: they differ.
template <typename Bus, typename Clock>
Result<void> read_checked(Chip<Bus, Clock>& chip, std::uint8_t address, Span<std::uint8_t> out) {
  const Result<void> read = chip.opcodes.read_registers(address, out);
  return read && chip.checks_all() ? compare_registers(chip, address, Span<const std::uint8_t>(out))
                                   : read;
}

}  // namespace mb4::detail

#endif  // MB4_DETAIL_CHECKED_REGISTERS_HPP_
