// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Driver of the DSL master, one channel: link, position, safe position, quality, events.
// Freestanding C++17: no heap, no exceptions, no static state. Messages: dsl/messages.hpp.
//
//   dsl::MemoryPort port(base);
//   dsl::Device<dsl::MemoryPort> motor(port);
//   motor.start();                          then until it is true: motor.linked()
//   motor.position();                       in the interrupt of each frame
//   motor.safe(rules);                      in the main loop
//
// An interrupt that calls position() needs no lock against a main loop that calls the others: each
// group of registers has a copy of its own (docs/dsl.md, "Bus"). Two contexts must not call the
// same one at the same time.

#ifndef DSL_DEVICE_HPP_
#define DSL_DEVICE_HPP_

#include "enc/cpp17.hpp"
#if __cplusplus >= 201703L

#include <cstdint>

#include "dsl/error.hpp"
#include "dsl/port.hpp"
#include "dsl/safe.hpp"
#include "dsl_page_regs.hpp"
#include "dsl_regs.hpp"

namespace dsl {

// Polls that `limit_us` may hold, so that a clock that stands still ends a wait too: an access
// takes longer than a sixteenth of 1 us.
[[nodiscard]] constexpr std::uint64_t most_polls(std::uint32_t limit_us) {
  return std::uint64_t{limit_us} * 16U + 1U;
}

// The fast position at the sample of one frame. Nothing on the bus protects it: no CRC covers these
// words (docs/dsl.md, "Driver", names the bits).
struct Position {
  std::int64_t position = 0;  // steps
  std::int32_t speed = 0;     // steps a frame
  std::uint32_t frame = 0;    // running frames, modulo 2^32; the same again is no new position
  std::uint8_t quality = 0;   // 0 to 15; below 14 is poor
};

struct Quality {
  std::uint8_t quality = 0;         // QM, 0 to 15
  std::uint8_t rssi = 0;            // 0 to 12: how clean the edges are
  std::uint8_t delay_bits = 0;      // bits of 106.67 ns that the answer comes late, about 10 m each
  std::uint8_t edges = 0;           // samples of a bit in which an edge was seen in the training
  std::uint8_t restart_reason = 0;  // RESTART_REASON of dsl::page
  std::uint16_t restarts = 0;       // of the link, modulo 2^16
  std::uint16_t illegal_words = 0;  // refused by the strict check alone, modulo 2^16
};

// Bits of take_events() and mask_events(), as docs/dsl.md has them.
struct Events {
  std::uint8_t high = 0;  // EVENT_H
  std::uint8_t low = 0;   // EVENT_L; take_events() leaves MIN, ANS, FREL, FRES to the messages
  std::uint8_t safe = 0;  // EVENT_S; take_events() leaves MIN and FRES to the messages
};

// Port: see kIsPort. It lives as long as the device.
template <typename Port>
class Device {
  static_assert(
      kIsPort<Port>,
      "Port needs bool read(offset, std::uint32_t&) and bool write(offset, std::uint8_t)");

 public:
  explicit constexpr Device(Port& port) : port_(port) {}

  // ---- the link ----
  // Takes the driver off the line and starts the link anew. The interrupts of the page are off and
  // no interrupt is pending then. kBus, kAbsent (nothing was written).
  Result<void> start() {
    std::uint32_t id = 0;
    if (!read(page::kAddrId, id) || !read(page::kAddrFeatures, features_)) return Error::kBus;
    if (id != page::kResetId) return Error::kAbsent;
    encoder_ = {};
    const bool done =
        write(page::kAddrIrqEnable, 0) && write(page::kAddrIrqStatus, kAllInterrupts) &&
        write(regs::kAddrSyncCtrl, 0) && set_control(regs::PRST::kMask) && set_control(0);
    return done ? Error::kNone : Error::kBus;
  }
  // Takes the driver off the line; the link ends. kBus.
  Result<void> stop() {
    return set_control(regs::PRST::kMask | regs::OEN::kMask) ? Error::kNone : Error::kBus;
  }
  // Whether positions are certain: the encoder answers, and its position is known. One step, to be
  // called again until it is true; a link needs about 1 ms. Then encoder() is that of this link.
  // kBus.
  Result<bool> linked() {
    std::uint32_t status = 0;
    if (!read(page::kAddrStatus, status)) return Error::kBus;
    if (!certain(status)) return false;
    std::uint32_t id = 0;
    if (!read(word_of(regs::kAddrEncId2), id)) return Error::kBus;
    encoder_ = encoder_of(byte_of(id, regs::kAddrEncId1), byte_of(id, regs::kAddrEncId0));
    return true;
  }
  // Waits for linked(), `limit_us` (up to 2^31) at most. `Clock`: enc/bus.hpp. kBus, kTimeout.
  template <typename Clock>
  Result<Encoder> wait_for_link(Clock& clock, std::uint32_t limit_us) {
    const std::uint32_t begin = clock.now_us();
    for (std::uint64_t left = most_polls(limit_us); left != 0; --left) {
      const Result<bool> now = linked();
      if (!now) return now.failure();
      if (*now) return encoder_;
      if (clock.now_us() - begin > limit_us) break;
    }
    return Error::kTimeout;
  }
  // As the last linked() that was true has found it.
  [[nodiscard]] const Encoder& encoder() const { return encoder_; }

  // ---- position ----
  // The position of the last frame, for an interrupt: five accesses. kBus, kNoLink, kUncertain;
  // then `now` is as before. It makes no copy: 25 instructions of a Cortex-M0+.
  [[nodiscard]] Error read_position(Position& now) {
    std::uint32_t low = 0, high = 0, speed = 0, frame = 0, status = 0;
    if (!read(page::kAddrPosLo, low) || !read(page::kAddrPosHi, high) ||
        !read(page::kAddrVel, speed) || !read(page::kAddrFrameCount, frame) ||
        !read(page::kAddrFrameStatus, status)) {
      return Error::kBus;
    }
    if (!certain(status))
      return (status & page::LINKED::kMask) == 0 ? Error::kNoLink : Error::kUncertain;
    now.position = static_cast<std::int64_t>(std::uint64_t{high} << 32U | low);
    now.speed = static_cast<std::int32_t>(speed);
    now.frame = frame;
    now.quality = static_cast<std::uint8_t>(page::QUALITY::get(status));
    return Error::kNone;
  }
  // The same as a Result.
  Result<Position> position() {
    Position now;
    const Error error = read_position(now);
    if (error != Error::kNone) return error;
    return now;
  }
  // The last safe position, after all checks of check_safe(). linked() must have been true in this
  // link. kBus, kNoLink (it was not), kNoSafe, kSafeOld, kSafeCrc, kSafeState, kSafeDiffers.
  Result<SafePosition> safe(const SafeRules& rules) {
    if (encoder_.position_bits == 0) return Error::kNoLink;
    SafeWords first, second;
    std::uint32_t states = 0;
    // A vertical frame that ends between the two makes the second one younger: read both anew.
    constexpr unsigned kTries = 3;
    for (unsigned i = 0; i < kTries; ++i) {
      if (!read_safe(page::kAddrSafe1Lo, first) || !read_safe(page::kAddrSafe2Lo, second) ||
          !read(page::kAddrSafeStatus, states)) {
        return Error::kBus;
      }
      if (second.age >= first.age) break;
    }
    return check_safe(first, second, states, encoder_, rules);
  }

  // ---- quality, events ----
  // kBus.
  Result<Quality> quality() {
    std::uint32_t monitor = 0, edges = 0, status = 0, restarts = 0;
    if (!read(word_of(regs::kAddrMasterQm), monitor) || !read(word_of(regs::kAddrEdges), edges) ||
        !read(page::kAddrStatus, status) || !read(page::kAddrRestarts, restarts)) {
      return Error::kBus;
    }
    Quality now;
    const std::uint8_t line = byte_of(edges, regs::kAddrDelay);
    now.quality = regs::QM::get(byte_of(monitor, regs::kAddrMasterQm));
    now.edges = byte_of(edges, regs::kAddrEdges);
    now.rssi = regs::RSSI::get(line);
    now.delay_bits = regs::DELAY::get(line);
    now.restart_reason = static_cast<std::uint8_t>(page::RESTART_REASON::get(status));
    now.restarts = static_cast<std::uint16_t>(page::NUM_RESETS::get(restarts));
    now.illegal_words = static_cast<std::uint16_t>(page::CODE_ILLEGAL::get(restarts));
    return now;
  }
  // The events since the last call. It clears what it returns, and nothing else. kBus.
  Result<Events> take_events() {
    std::uint32_t now = 0, of_safe_host = 0;
    if (!read(regs::kAddrEventH, now) || !read(word_of(regs::kAddrEventS), of_safe_host))
      return Error::kBus;
    Events events;
    events.high = byte_of(now, regs::kAddrEventH);
    events.low = byte_of(now, regs::kAddrEventL) & kLowEvents;
    events.safe = byte_of(of_safe_host, regs::kAddrEventS) & kSafeEvents;
    const bool done = write(regs::kAddrEventH, ~events.high) &&
                      write(regs::kAddrEventL, ~events.low) &&
                      write(regs::kAddrEventS, ~events.safe);
    if (!done) return Error::kBus;
    return events;
  }
  // Lets events raise the interrupts EVENT and SAFE_EVENT; `summary`: bits of SUMMARY that SUM
  // looks at. kBus.
  Result<void> mask_events(const Events& events, std::uint8_t summary) {
    return write(regs::kAddrMaskH, events.high) && write(regs::kAddrMaskL, events.low) &&
                   write(regs::kAddrMaskS, events.safe) && write(regs::kAddrMaskSum, summary)
               ? Error::kNone
               : Error::kBus;
  }
  // Interrupts of the page, as bits of IRQ_STATUS. kBus.
  Result<void> enable_interrupts(std::uint8_t mask) {
    return write(page::kAddrIrqEnable, mask) ? Error::kNone : Error::kBus;
  }
  // Returns those that are pending and clears them. kBus.
  Result<std::uint8_t> take_interrupts() {
    std::uint32_t pending = 0;
    if (!read(page::kAddrIrqStatus, pending)) return Error::kBus;
    const auto mask = static_cast<std::uint8_t>(pending & kAllInterrupts);
    if (!write(page::kAddrIrqStatus, mask)) return Error::kBus;
    return mask;
  }

  // ---- for dsl::Messages ----
  // Resets the message channel of both hosts. kBus.
  Result<void> reset_messages() {
    return write(regs::kAddrSysCtrl, std::uint32_t{control_} | regs::MRST::kMask) ? Error::kNone
                                                                                  : Error::kBus;
  }
  // FEATURES, as start() has read it.
  [[nodiscard]] std::uint32_t features() const { return features_; }
  bool read(std::uint32_t offset, std::uint32_t& word) { return port_.read(offset, word); }
  bool write(std::uint32_t offset, std::uint32_t byte) {
    return port_.write(offset, static_cast<std::uint8_t>(byte));
  }

 private:
  static constexpr std::uint8_t kAllInterrupts = 0x7F;
  static constexpr std::uint8_t kLowEvents = regs::QMLW::kMask;
  static constexpr std::uint8_t kSafeEvents =
      0xFFU & ~std::uint32_t{regs::S_MIN::kMask | regs::S_FRES::kMask};

  bool set_control(std::uint32_t bits) {
    control_ = static_cast<std::uint8_t>(bits);
    return write(regs::kAddrSysCtrl, control_);
  }
  // LINK, VSYNC and no POS.
  static bool certain(std::uint32_t status) {
    constexpr std::uint32_t kGood = page::LINKED::kMask | page::VSYNC_SEEN::kMask;
    return (status & (kGood | page::POS_LOST::kMask)) == kGood;
  }
  bool read_safe(std::uint32_t at, SafeWords& words) {
    return read(at, words.low) && read(at + 4U, words.high) && read(at + 8U, words.check) &&
           read(at + 12U, words.age);
  }

  Port& port_;
  std::uint8_t control_ = 0;  // SYS_CTRL, as it was written last
  std::uint32_t features_ = 0;
  Encoder encoder_{};
};

}  // namespace dsl

#endif  // __cplusplus >= 201703L

#endif  // DSL_DEVICE_HPP_
