// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The caller supplies a serial bus and a clock. Both are template parameters, without virtual
// functions. FunctionBus and FunctionClock adapt plain C functions.

#ifndef ENC_BUS_HPP_
#define ENC_BUS_HPP_

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "enc/span.hpp"

namespace enc {

// The bus contract. A type `Bus` has
//
//   bool transfer(Span<const std::uint8_t> tx, Span<std::uint8_t> rx);
//
// * One call is one frame: the chip is selected, tx.size() bytes are exchanged, the chip is
//   released. The frame must not be split.
// * rx is either as long as tx (rx[i] is received while tx[i] is sent) or empty (the received bytes
//   are discarded). tx and rx never overlap.
// * It returns true when the whole frame was exchanged, and false when it was not or only in part.
// * The bus itself keeps other devices on the same wires away, for example by a lock.
//
// The driver of each master states mode, clock rate and length of a frame.
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
// It counts microseconds upwards and wraps at 2^32, in steps of at most 32 us (a counter of 32
// kHz). A reading is rounded down; steps must not add up to more than the time. The driver uses
// differences only. It also counts its polls, so a clock that stands still cannot block it for
// ever.
template <typename Clock, typename = void>
inline constexpr bool kIsClock = false;

template <typename Clock>
inline constexpr bool kIsClock<Clock, std::void_t<decltype(std::declval<Clock&>().now_us())>> =
    std::is_same_v<decltype(std::declval<Clock&>().now_us()), std::uint32_t>;

// How much more than the time between them two readings of a clock may differ: its step and the
// rounding, rounded up. A clock that is finer than 32 kHz may say so; alarms are then earlier:
//
//   static constexpr std::uint32_t kStepUs = 1;   // counts every microsecond
inline constexpr std::uint32_t kMaxClockStepUs = 33;

template <typename Clock, typename = void>
inline constexpr std::uint32_t clock_step_us = kMaxClockStepUs;

template <typename Clock>
inline constexpr std::uint32_t clock_step_us<Clock, std::void_t<decltype(Clock::kStepUs)>> =
    Clock::kStepUs;

// A bus made of one plain function and a context pointer. `rx` is null when the driver does not
// need the received bytes.
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

}  // namespace enc

#endif  // ENC_BUS_HPP_
