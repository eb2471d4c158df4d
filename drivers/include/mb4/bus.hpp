// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The caller supplies an SPI bus and a clock. Both are template parameters, without virtual
// functions. FunctionBus and FunctionClock adapt plain C functions.

#ifndef MB4_BUS_HPP_
#define MB4_BUS_HPP_

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "mb4/span.hpp"

namespace mb4 {

// The bus contract. A type `Bus` has
//
//   bool transfer(Span<const std::uint8_t> tx, Span<std::uint8_t> rx);
//
// * One call is one SPI frame: NCS falls, tx.size() bytes are exchanged, NCS rises (>= 10 ns high,
//   I209). The frame must not be split.
// * SPI mode 0 (clock idle low, sample on the rising edge), most significant bit first
//   (datasheet page 17). SCLK high and low >= 10 ns (I203, I204).
// * I204 (datasheet page 11): between the address byte of opcode 0x03 and the first data bit SCLK
//   must be high for >= 100 ns. Run SCLK at <= 5 MHz, or stretch the 16th high phase of frames
//   that begin with 0x03. All other opcodes may run at the full rate. read_frame() of slave 1 does
//   not use 0x03.
// * The chip needs three system clocks between two writes of 0xF4, and between such a write and a
//   status read that must see EOT = 0. SCLK <= 2 * f_CLK is always safe. This limits SCLK only with
//   a slow system clock: 2 MHz at f_CLK = 1 MHz. The driver cannot check SCLK.
// * rx is either as long as tx (rx[i] is received while tx[i] is sent) or empty (discard MISO).
//   tx and rx never overlap.
// * 2 <= tx.size() <= kMaxTransferBytes (opcodes.hpp).
// * It returns true when the whole frame was exchanged, and false when it was not or only in part.
// * The bus itself keeps other devices on the same SPI bus away, for example by a lock.
template <typename Bus, typename = void>
inline constexpr bool kIsBus = false;

template <typename Bus>
inline constexpr bool kIsBus<
    Bus, std::void_t<decltype(std::declval<Bus&>().transfer(
             std::declval<Span<const std::uint8_t>>(), std::declval<Span<std::uint8_t>>()))>> =
    std::is_same_v<decltype(std::declval<Bus&>().transfer(std::declval<Span<const std::uint8_t>>(),
                                                          std::declval<Span<std::uint8_t>>())),
                   bool>;

// The clock contract. A type `Clock` has
//
//   std::uint32_t now_us();
//
// It counts microseconds upwards and wraps at 2^32. The driver uses differences only. The driver
// also counts its polls, so a clock that stands still cannot block it for ever.
template <typename Clock, typename = void>
inline constexpr bool kIsClock = false;

template <typename Clock>
inline constexpr bool kIsClock<Clock, std::void_t<decltype(std::declval<Clock&>().now_us())>> =
    std::is_same_v<decltype(std::declval<Clock&>().now_us()), std::uint32_t>;

// A bus made of one plain function and a context pointer. `rx` is null when the driver does not
// need MISO.
class FunctionBus {
 public:
  using Transfer = bool (*)(void* context, const std::uint8_t* tx, std::uint8_t* rx,
                            std::size_t size_bytes);

  // `function` must not be null and obeys the bus contract above.
  constexpr FunctionBus(Transfer function, void* context)
      : transfer_(function), context_(context) {}

  bool transfer(Span<const std::uint8_t> tx, Span<std::uint8_t> rx) {
    return transfer_(context_, tx.data(), rx.empty() ? nullptr : rx.data(), tx.size());
  }

 private:
  Transfer transfer_;
  void* context_;
};

// A clock made of one plain function and a context pointer.
class FunctionClock {
 public:
  using NowUs = std::uint32_t (*)(void* context);

  // `function` must not be null.
  constexpr FunctionClock(NowUs function, void* context) : now_us_(function), context_(context) {}

  std::uint32_t now_us() { return now_us_(context_); }

 private:
  NowUs now_us_;
  void* context_;
};

}  // namespace mb4

#endif  // MB4_BUS_HPP_
