// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The driver over a bus of 32-bit words, AXI4-Lite or Wishbone: each SPI frame that the driver asks
// for becomes accesses to the registers, four bytes to a word.

#ifndef MB4_WORDS_MEMORY_BUS_HPP_
#define MB4_WORDS_MEMORY_BUS_HPP_

#include "enc/cpp17.hpp"
#if __cplusplus >= 201703L

#include <cstddef>
#include <cstdint>

#include "mb4/detail/spi_frame.hpp"
#include "mb4/result.hpp"
#include "mb4/words/port.hpp"
#include "mb4_page_regs.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

// A bus (bus.hpp) on top of a port of words (port.hpp): mb4::Device<mb4::MemoryBus<Port>, Clock>.
//
// * Bytes of a frame that share a word are one access. 0xF4 and the bytes behind it act with 0xF4
//   last, whatever their order on SPI.
// * A frame on SPI gives the chip time to act on a write, and to bring data into its memory behind
//   a status that tells of them. Words are faster. So some accesses wait for the core: they read
//   TIME_LOW before, which takes about 20 clocks of the core and replaces the copy in TIME_HIGH.
//   They are the first one after a write to 0xF4, the first read after a write to SVALID, and the
//   first one to SCDATA or RDATA, or write to 0xF4, after a read of the status.
// * transfer() returns false when an access has failed. The first bytes of a write may have taken
//   effect.
template <typename Port>
class MemoryBus {
  static_assert(kIsWordPort<Port>,
                "mb4: the Port type needs "
                "'bool read(std::uint32_t offset, std::uint32_t& value)' and "
                "'bool write(std::uint32_t offset, std::uint32_t value, std::uint8_t strobes)'; "
                "see mb4/words/port.hpp");

 public:
  // The port must outlive this object.
  explicit constexpr MemoryBus(Port& port) : port_(&port) {}

  bool transfer(Span<const std::uint8_t> tx, Span<std::uint8_t> rx) {
    for (std::uint8_t& byte : rx) {
      byte = 0;
    }
    const detail::SpiFrame frame = detail::decode_frame(tx);
    std::uint8_t address = frame.address;
    for (std::size_t i = frame.first; i < tx.size();) {
      const std::uint8_t word = address & 0xFCU;
      std::uint32_t value = 0;
      if (!settle(word, frame.reads) || (frame.reads && !port_->read(word, value))) {
        return false;
      }
      std::uint8_t strobes = 0;
      do {
        const unsigned place = address & 3U;
        if (!frame.reads) {
          value |= std::uint32_t{tx[i]} << (8U * place);
          strobes = static_cast<std::uint8_t>(strobes | 1U << place);
        } else if (i < rx.size()) {
          rx[i] = static_cast<std::uint8_t>(value >> (8U * place));
        }
        ++i;
        ++address;
      } while (i < tx.size() && (address & 3U) != 0);
      if (frame.reads && word == regs::kAddrStatus0) {
        wait_ = Wait::kBeforeData;
      }
      if (!frame.reads) {
        if (word == regs::kAddrInstr && (strobes & 1U) != 0) {
          wait_ = Wait::kAlways;
        } else if (word == regs::kAddrStatus0) {
          wait_ = Wait::kBeforeRead;
        }
        if (!port_->write(word, value, strobes)) {
          return false;
        }
      }
    }
    return true;
  }

 private:
  // What the next access has to wait for.
  enum class Wait : std::uint8_t { kNever, kBeforeData, kBeforeRead, kAlways };

  // After it the core has acted on all that came before the access to `word`.
  bool settle(std::uint8_t word, bool reads) {
    constexpr unsigned kNoData = 0x40;  // of an address: neither SCDATA nor RDATA
    std::uint32_t time = 0;
    const bool instructs = !reads && word == regs::kAddrInstr;
    if (wait_ == Wait::kNever ||
        (wait_ == Wait::kBeforeData && (word & kNoData) != 0 && !instructs) ||
        (wait_ == Wait::kBeforeRead && !reads)) {
      return true;
    }
    if (!port_->read(page::kAddrTimeLow, time)) {
      return false;
    }
    wait_ = Wait::kNever;
    return true;
  }

  Port* port_;
  Wait wait_ = Wait::kNever;
};

}  // namespace mb4

#endif  // C++17

#endif  // MB4_WORDS_MEMORY_BUS_HPP_
