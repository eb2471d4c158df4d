// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The driver over the parallel bus: each SPI frame that the driver asks for becomes bus cycles.

#ifndef MB4_PARALLEL_BUS_HPP_
#define MB4_PARALLEL_BUS_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/detail/spi_frame.hpp"
#include "mb4/result.hpp"

namespace mb4 {

// A bus (bus.hpp) on top of a port that makes single cycles, Intel or Motorola (datasheet pages 9,
// 10, 17). A type `Port` has
//
//   bool write(std::uint8_t address, std::uint8_t value);
//   bool read(std::uint8_t address, std::uint8_t& value);
//
// * One call is one bus cycle with its address. It returns true when the cycle was made.
// * The port waits at least five system clocks (0.5 us at 10 MHz, the oscillator's lowest) after a
//   write to 0xF4 before the next write to 0xF4. The chip takes two closer writes as one.
// * On most processors a cycle is one access to memory that is mapped to the chip.
//
// Unknown opcodes do nothing, as on SPI; addresses wrap after 0xFF. After a failed cycle transfer()
// returns false at once: the first bytes of a write may have taken effect.
template <typename Port>
class ParallelBus {
 public:
  // The port must outlive this object.
  explicit constexpr ParallelBus(Port& port) : port_(&port) {}

  bool transfer(Span<const std::uint8_t> tx, Span<std::uint8_t> rx) {
    for (std::uint8_t& byte : rx) {
      byte = 0;
    }
    const detail::SpiFrame frame = detail::decode_frame(tx);
    std::uint8_t address = frame.address;
    for (std::size_t i = frame.first; i < tx.size(); ++i) {
      std::uint8_t value = 0;
      if (!(frame.reads ? port_->read(address, value) : port_->write(address, tx[i]))) {
        return false;
      }
      if (frame.reads && i < rx.size()) {
        rx[i] = value;
      }
      ++address;
    }
    return true;
  }

 private:
  Port* port_;
};

}  // namespace mb4

#endif  // MB4_PARALLEL_BUS_HPP_
