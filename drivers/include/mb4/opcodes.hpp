// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The six SPI opcodes (datasheet table 3, pages 17 to 19), one SPI frame per call.

#ifndef MB4_OPCODES_HPP_
#define MB4_OPCODES_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/bus.hpp"
#include "mb4/result.hpp"
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

  [[nodiscard]] Bus& bus() { return *bus_; }

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
  Result<void> write(regs::SpiOpcode opcode, bool send_address, std::uint8_t address,
                     Span<const std::uint8_t> data) {
    return exchange(opcode, send_address, address, data.data(), nullptr, data.size(), 0);
  }

  Result<void> read(regs::SpiOpcode opcode, bool send_address, std::uint8_t address,
                    Span<std::uint8_t> data, std::uint8_t filler) {
    return exchange(opcode, send_address, address, nullptr, data.data(), data.size(), filler);
  }

  // One transfer: writes `from`, or, if that is null, sends `filler` and reads into `to`.
  [[gnu::noinline]] Result<void> exchange(regs::SpiOpcode opcode, bool send_address,
                                          std::uint8_t address, const std::uint8_t* from,
                                          std::uint8_t* to, std::size_t count,
                                          std::uint8_t filler) {
    if (count < 1 || count > kMaxBurstBytes || std::size_t{address} + count > 0x100) {
      return Error::kInvalidArgument;
    }
    std::uint8_t tx[kMaxTransferBytes];
    std::uint8_t rx[kMaxTransferBytes];
    tx[0] = static_cast<std::uint8_t>(opcode);
    tx[1] = address;
    const std::size_t header = send_address ? 2 : 1;
    const std::size_t size = header + count;
    for (std::size_t i = header; i < size; ++i) {
      tx[i] = from != nullptr ? from[i - header] : filler;
      // A bus that claims success without writing rx must not turn stack contents into data.
      rx[i] = 0;
    }
    const Span<std::uint8_t> received =
        from != nullptr ? Span<std::uint8_t>() : Span<std::uint8_t>(rx, size);
    if (!bus_->transfer(Span<const std::uint8_t>(tx, size), received)) {
      return Error::kTransport;
    }
    for (std::size_t i = 0; to != nullptr && i < count; ++i) {
      to[i] = rx[header + i];
    }
    return {};
  }

  Bus* bus_;
};

}  // namespace mb4

#endif  // MB4_OPCODES_HPP_
