// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// A hook that sees each SPI frame.

#ifndef ENC_TRACE_HPP_
#define ENC_TRACE_HPP_

#include <cstdint>

#include "enc/bus.hpp"
#include "enc/span.hpp"

namespace enc {

// A bus on top of another one. After each frame it calls
//
//   hook(Span<const std::uint8_t> tx, Span<const std::uint8_t> rx, bool transferred);
//
// in the context of the caller, in an interrupt too; rx is empty if the received bytes were not
// wanted. Who makes the frames of steps himself, by DMA, sees them anyway.
//
//   enc::TracedBus traced(bus, [](auto tx, auto rx, bool transferred) { ... });
//   mb4::Device device(traced, clock);
template <typename Bus, typename Hook>
class TracedBus {
  static_assert(kIsBus<Bus>, "enc: the Bus type needs 'bool transfer(tx, rx)'; see enc/bus.hpp");

 public:
  // The bus must outlive this object.
  constexpr TracedBus(Bus& bus, Hook hook) : bus_(&bus), hook_(hook) {}

  bool transfer(Span<const std::uint8_t> tx, Span<std::uint8_t> rx) {
    const bool transferred = bus_->transfer(tx, rx);
    hook_(tx, Span<const std::uint8_t>(rx.data(), rx.size()), transferred);
    return transferred;
  }

 private:
  Bus* bus_;
  Hook hook_;
};

}  // namespace enc

#endif  // ENC_TRACE_HPP_
