// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The six SPI opcodes (datasheet table 3, pages 17 to 19), one SPI frame per call.

#ifndef MB4_OPCODES_HPP_
#define MB4_OPCODES_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/bus.hpp"
#include "mb4/result.hpp"
#include "mb4/span.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

// Most data bytes in one SPI frame: the whole single-cycle data RAM, 0x00..0x3F.
inline constexpr std::size_t kMaxBurstBytes = 64;
// Longest SPI frame that the bus sees: opcode, address, data.
inline constexpr std::size_t kMaxTransferBytes = kMaxBurstBytes + 2;

// Transfers bytes. It does not know the meaning of the registers, so it protects no sticky or
// self-clearing bit. Every call makes exactly one bus transfer, or none when an argument is wrong:
//   kInvalidArgument  no byte, more than kMaxBurstBytes, or the burst would pass address 0xFF;
//                     not touched
//   kTransport        the bus failed. The first bytes of a write may have taken effect; a read has
//                     stored nothing
// The address rises by one with each byte. A call uses up to 2 * kMaxTransferBytes of stack. No
// other user of the same bus object may interrupt a call.
template <typename Bus>
class Opcodes {
  static_assert(kIsBus<Bus>,
                "mb4: the Bus type needs "
                "'bool transfer(mb4::Span<const std::uint8_t> tx, mb4::Span<std::uint8_t> rx)'; "
                "see mb4/bus.hpp");

 public:
  // The bus must outlive this object.
  explicit constexpr Opcodes(Bus& bus) : bus_(&bus) {}

  // 0x02: writes `data` from `address` upwards.
  Result<void> write_registers(std::uint8_t address, Span<const std::uint8_t> data) {
    return write(regs::SpiOpcode::kWriteRegisters, true, address, data);
  }
  // 0x03: reads from `address` upwards. The bus must keep I204, see bus.hpp. `filler` is the byte
  // on MOSI meanwhile: if a disturbed bit turns the opcode into a write, the chip stores this byte.
  Result<void> read_registers(std::uint8_t address, Span<std::uint8_t> data,
                              std::uint8_t filler = 0) {
    return read(regs::SpiOpcode::kReadRegisters, true, address, data, filler);
  }
  // 0x05: reads from 0xF0 upwards.
  Result<void> read_status(Span<std::uint8_t> data) {
    return read(regs::SpiOpcode::kReadStatus, false, regs::kAddrStatus0, data, 0);
  }
  // 0x07: writes from 0xF4 upwards.
  Result<void> write_instruction(Span<const std::uint8_t> data) {
    return write(regs::SpiOpcode::kWriteInstruction, false, regs::kAddrInstr, data);
  }
  // 0x09: reads from 0x00 upwards. `filler` as for read_registers().
  Result<void> read_registers0(Span<std::uint8_t> data, std::uint8_t filler = 0) {
    return read(regs::SpiOpcode::kReadRegisters0, false, 0, data, filler);
  }
  // 0x0B: writes from 0x00 upwards.
  Result<void> write_registers0(Span<const std::uint8_t> data) {
    return write(regs::SpiOpcode::kWriteRegisters0, false, 0, data);
  }

 private:
  static constexpr bool burst_fits(std::uint8_t address, std::size_t count) {
    return count >= 1 && count <= kMaxBurstBytes && std::size_t{address} + count <= 0x100;
  }

  // Fills opcode and, where it is sent, address; returns the number of bytes before the data.
  static std::size_t begin(std::uint8_t* tx, regs::SpiOpcode opcode, bool send_address,
                           std::uint8_t address) {
    tx[0] = static_cast<std::uint8_t>(opcode);
    if (!send_address) {
      return 1;
    }
    tx[1] = address;
    return 2;
  }

  Result<void> write(regs::SpiOpcode opcode, bool send_address, std::uint8_t address,
                     Span<const std::uint8_t> data) {
    if (!burst_fits(address, data.size())) {
      return Error::kInvalidArgument;
    }
    std::uint8_t tx[kMaxTransferBytes];
    const std::size_t header = begin(tx, opcode, send_address, address);
    for (std::size_t i = 0; i < data.size(); ++i) {
      tx[header + i] = data[i];
    }
    if (!bus_->transfer(Span<const std::uint8_t>(tx, header + data.size()), Span<std::uint8_t>())) {
      return Error::kTransport;
    }
    return {};
  }

  Result<void> read(regs::SpiOpcode opcode, bool send_address, std::uint8_t address,
                    Span<std::uint8_t> data, std::uint8_t filler) {
    if (!burst_fits(address, data.size())) {
      return Error::kInvalidArgument;
    }
    std::uint8_t tx[kMaxTransferBytes];
    std::uint8_t rx[kMaxTransferBytes];
    const std::size_t header = begin(tx, opcode, send_address, address);
    const std::size_t size = header + data.size();
    for (std::size_t i = header; i < size; ++i) {
      tx[i] = filler;
    }
    // A bus that claims success without writing rx must not turn stack contents into data.
    for (std::size_t i = 0; i < size; ++i) {
      rx[i] = 0;
    }
    if (!bus_->transfer(Span<const std::uint8_t>(tx, size), Span<std::uint8_t>(rx, size))) {
      return Error::kTransport;
    }
    for (std::size_t i = 0; i < data.size(); ++i) {
      data[i] = rx[header + i];
    }
    return {};
  }

  Bus* bus_;
};

}  // namespace mb4

#endif  // MB4_OPCODES_HPP_
