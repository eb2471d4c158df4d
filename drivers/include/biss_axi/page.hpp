// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The page of biss_axi behind 0x40: what a master with extras (parameter EXTRAS) has beyond the
// manual. Freestanding C++17. No call waits; an access to an encoder's register is begun and asked
// for. A page must not be used at the same time as a Device of the same master: both use its index
// register.

#ifndef BISS_AXI_PAGE_HPP_
#define BISS_AXI_PAGE_HPP_

#include <cstdint>

#include "biss_axi/device.hpp"

namespace biss_axi {

struct Counters {
  std::uint32_t frames = 0;  // ended, good or not
  std::uint16_t crc_errors = 0;
  std::uint16_t late_starts = 0;  // SLO was 0 at the start
};

// An access to a register of an encoder.
struct RegisterAccess {
  std::uint8_t channel = 0;  // 0 to 15
  std::uint8_t slave = 0;    // ID; 0 is the only one on the channel
  std::uint8_t address = 0;  // 0 to 127
  bool write = false;
  std::uint8_t value = 0;  // to write
};

// The last word of a channel, in every mode.
struct LastWord {
  std::uint64_t position = 0;  // 0 without a good word
  // Of the read that brought it, from 1 on, modulo 2^16; 0: there was none yet. The same number
  // again is no new word; a larger step than 1 tells how many words were missed.
  std::uint16_t number = 0;
  bool good = false;
  bool slave_error = true;    // nE = 0: the position is not to be trusted
  bool slave_warning = true;  // nW = 0
  bool crc_error = false;
  bool late_start = false;  // SLO was 0 at the start
};

// The eye of a line in the last frame of its channel: clocks of a bit between the latest edge and
// the earliest one of the next bit. Source: regmap/axi.rdl, EYE.
struct Eye {
  // The numbers are those of the last frame, whether its CRC fits or not; else they are 0: it did
  // not come to its end, or its MA divider was out of reach.
  bool valid = false;
  // The words are taken by frames at the MA divider of the read that runs or of the last one (10 to
  // 20 clocks a bit).
  bool used = false;
  std::uint8_t width = 0;  // clocks; a bit has 2 * divider clocks
  // The smallest width since eye() was called for this channel, the last frame of then included. It
  // counts clocks: call eye() once behind a change of the divider.
  std::uint8_t smallest = 0;
  std::uint8_t point = 0;   // sampling point: clocks behind the rise of the start bit
  std::uint8_t before = 0;  // clocks that edges could have come later
  std::uint8_t after = 0;   // clocks that those of the next bit could have come earlier
};

enum class AccessState : std::uint8_t {
  kRunning,  // its bits go with the frames of the channel
  kDone,
  kFailed,  // wrong echo or CRC, a frame that failed, no such channel, or ended by end_access()
  kSilent,  // the encoder has not answered
};

struct AccessResult {
  AccessState state = AccessState::kRunning;
  std::uint8_t value = 0;  // kDone after a read
};

// Events, as bits of take_events() and enable_interrupt().
inline constexpr std::uint32_t kEventFrame = regs::FRAME::kMask;
inline constexpr std::uint32_t kEventError = regs::ERROR::kMask;
inline constexpr std::uint32_t kEventAccess = regs::REGISTER_END::kMask;
inline constexpr std::uint32_t kEventSense = regs::SENSE::kMask;
inline constexpr std::uint32_t kEventLost = regs::LOST::kMask;

// Port: see kIsPort. It lives as long as the page.
template <typename Port>
class Page {
  static_assert(kIsPort<Port>,
                "Port needs bool write(offset, value) and bool read(offset, value&)");

 public:
  explicit Page(Port& port) : port_(port) {}

  // Register FEATURES (regs::HAS_..., regs::CHANNEL_COUNT); 0 for a master without extras.
  Result<std::uint32_t> features() { return biss_axi::features(port_); }

  // ---- extra ANY_CRC: from the next frame on ----
  // `polynomial` with its highest power, degree 1 to 16; kConfig if it has none of these.
  Result<void> set_crc(std::uint32_t polynomial, std::uint32_t start = 0) {
    if (polynomial < 2 || polynomial > regs::CRC_POLYNOMIAL::kMax || start > regs::CRC_START::kMax)
      return Error::kConfig;
    return set(regs::kAddrCrcPolynomial, polynomial, regs::kAddrCrcStart, start);
  }

  // ---- extra TIMEOUT: from the next frame on ----
  // `fixed`: wait for all `clocks`; else until SLO is 1, and no longer than `clocks` (0: the
  // parameter TIMEOUT_LIMIT).
  Result<void> set_timeout(std::uint32_t clocks, bool fixed) {
    if (clocks > regs::TIMEOUT_LIMIT::kMax) return Error::kConfig;
    return set(regs::kAddrTimeout, regs::TIMEOUT_FIXED::insert(clocks, fixed ? 1 : 0));
  }

  // ---- time ----
  // Clocks since the reset.
  Result<std::uint64_t> time() { return pair(regs::kAddrTimeLow, regs::kAddrTimeHigh); }
  // Extra STAMP: the instant at which the encoders latched in the last frame.
  Result<std::uint64_t> sample_time() {
    return pair(regs::kAddrSampleTimeLow, regs::kAddrSampleTimeHigh);
  }

  // ---- counters ----
  Result<std::uint32_t> skipped_starts() { return get(regs::kAddrSkipCount); }
  // Extra COUNTERS.
  Result<Counters> counters(unsigned channel) {
    if (channel >= regs::kChannels) return Error::kChannel;
    std::uint32_t frames = 0, crc_errors = 0, lates = 0;
    if (!port_.write(regs::kAddrChannelIndex, channel) ||
        !port_.read(regs::kAddrFrameCount, frames) ||
        !port_.read(regs::kAddrCrcErrorCount, crc_errors) ||
        !port_.read(regs::kAddrLateCount, lates)) {
      return Error::kBus;
    }
    Counters counters;
    counters.frames = frames;
    counters.crc_errors = static_cast<std::uint16_t>(crc_errors);
    counters.late_starts = static_cast<std::uint16_t>(lates);
    return counters;
  }

  // ---- interrupt ----
  Result<void> enable_interrupt(std::uint32_t events) { return set(regs::kAddrIrqEnable, events); }
  // The events that have come, and clears these.
  Result<std::uint32_t> take_events() { return take(regs::kAddrIrqStatus); }

  // ---- single points without waiting ----
  // Asks for one frame of all enabled channels in single-point mode, and returns at once; false: a
  // frame or a timeout ran, and nothing was started. kEventFrame tells the end; then last() has the
  // words.
  Result<bool> request() {
    std::uint32_t before = 0, after = 0;
    if (!port_.read(regs::kAddrSkipCount, before) || !port_.write(regs::kAddrRequest, 0) ||
        !port_.write(regs::kAddrRequest, 1) || !port_.read(regs::kAddrMode, after) ||
        !port_.read(regs::kAddrSkipCount, after)) {
      return Error::kBus;
    }
    return before == after;
  }

  // ---- extra LAST ----
  // The channel's last word, whatever started its frame; three accesses, with `wide` four.
  Result<LastWord> last(unsigned channel, bool wide = false) {
    if (channel >= regs::kChannels) return Error::kChannel;
    std::uint32_t status = 0, low = 0, high = 0;
    if (!port_.write(regs::kAddrChannelIndex, channel) ||
        !port_.read(regs::kAddrLastStatus, status) || !port_.read(regs::kAddrLastPosition, low) ||
        (wide && !port_.read(regs::kAddrLastPositionHigh, high))) {
      return Error::kBus;
    }
    LastWord word;
    word.position = std::uint64_t{high} << 32U | low;
    word.number = static_cast<std::uint16_t>(regs::LAST_NUMBER::get(status));
    word.good = regs::LAST_GOOD::get(status) != 0;
    word.slave_error = regs::LAST_NERR::get(status) == 0;
    word.slave_warning = regs::LAST_NWARN::get(status) == 0;
    word.crc_error = regs::LAST_CRC_ERROR::get(status) != 0;
    word.late_start = regs::LAST_LATE::get(status) != 0;
    return word;
  }

  // ---- extra ALARM ----
  // Watches the delay of a channel from the next frame on. `tolerance` is that of all channels.
  Result<void> watch_delay(unsigned channel, std::uint32_t clocks, std::uint32_t tolerance) {
    if (channel >= regs::kChannels) return Error::kChannel;
    if (clocks > regs::DELAY_REFERENCE::kMax || tolerance > regs::DELAY_TOLERANCE::kMax)
      return Error::kConfig;
    if (!port_.write(regs::kAddrChannelIndex, channel)) return Error::kBus;
    return set(regs::kAddrDelayTolerance, tolerance, regs::kAddrDelayReference,
               regs::DELAY_WATCH::insert(clocks, 1));
  }
  // Bit c: the delay of channel c has moved. Clears what it returns.
  Result<std::uint32_t> take_alarms() { return take(regs::kAddrDelayAlarm); }

  // ---- extra FRAME_SAMPLER ----
  // Begins the smallest width of the channel anew, with that of the last frame.
  Result<Eye> eye(unsigned channel) {
    if (channel >= regs::kChannels) return Error::kChannel;
    std::uint32_t word = 0;
    if (!port_.write(regs::kAddrChannelIndex, channel) || !port_.read(regs::kAddrEye, word))
      return Error::kBus;
    Eye eye;
    eye.valid = regs::EYE_VALID::get(word) != 0;
    eye.used = regs::EYE_USED::get(word) != 0;
    eye.width = static_cast<std::uint8_t>(regs::EYE_WIDTH::get(word));
    eye.smallest = static_cast<std::uint8_t>(regs::EYE_SMALLEST::get(word));
    eye.point = static_cast<std::uint8_t>(regs::EYE_POINT::get(word));
    eye.before = static_cast<std::uint8_t>(regs::EYE_BEFORE::get(word));
    eye.after = static_cast<std::uint8_t>(regs::EYE_AFTER::get(word));
    return eye;
  }
  // A frame of any channel with a width below `clocks` sets its alarm and kEventError; 0: none.
  // kConfig above 31.
  Result<void> watch_eyes(std::uint32_t clocks) {
    if (clocks > regs::EYE_LIMIT::kMax) return Error::kConfig;
    return set(regs::kAddrEyeLimit, clocks);
  }
  // Bit c: an eye of channel c was narrower. Clears what it returns.
  Result<std::uint32_t> take_eye_alarms() { return take(regs::kAddrEyeAlarm); }

  // ---- extra WIDE ----
  // The channel's word of the last single-point request; see Device::position().
  Result<Reading<std::uint64_t>> position(unsigned channel) {
    return read_position<std::uint64_t>(port_, channel);
  }

  // ---- extra ACCESS ----
  // Begins an access. kConfig if one runs or if it names no register.
  Result<void> begin_access(const RegisterAccess& access) {
    if (access.channel >= regs::kChannels) return Error::kChannel;
    if (access.slave > regs::ACCESS_SLAVE::kMax || access.address > regs::ACCESS_ADDRESS::kMax)
      return Error::kConfig;
    const Result<AccessResult> before = access_result();
    if (!before.ok()) return before.error();
    if (before->state == AccessState::kRunning) return Error::kConfig;
    std::uint32_t word = access.address;
    word = regs::ACCESS_SLAVE::insert(word, access.slave);
    word = regs::ACCESS_CHANNEL::insert(word, access.channel);
    word = regs::ACCESS_WRITE::insert(word, access.write ? 1 : 0);
    word = regs::ACCESS_START::insert(word, 1);
    return set(regs::kAddrAccessData, access.value, regs::kAddrAccess, word);
  }
  Result<AccessResult> access_result() {
    std::uint32_t status = 0, data = 0;
    if (!port_.read(regs::kAddrAccessStatus, status) || !port_.read(regs::kAddrAccessData, data))
      return Error::kBus;
    AccessResult result;
    result.value = static_cast<std::uint8_t>(data);
    if (regs::ACCESS_ACTIVE::get(status) != 0) {
      result.state = AccessState::kRunning;
    } else if (regs::ACCESS_SILENT::get(status) != 0) {
      result.state = AccessState::kSilent;
    } else {
      result.state =
          regs::ACCESS_ERROR::get(status) != 0 ? AccessState::kFailed : AccessState::kDone;
    }
    return result;
  }
  Result<void> end_access() { return set(regs::kAddrAccess, 0); }

 private:
  Result<std::uint32_t> get(std::uint32_t offset) {
    std::uint32_t value = 0;
    if (!port_.read(offset, value)) return Error::kBus;
    return value;
  }
  // Bits that are cleared by writing 1.
  Result<std::uint32_t> take(std::uint32_t offset) {
    std::uint32_t bits = 0;
    if (!port_.read(offset, bits) || !port_.write(offset, bits)) return Error::kBus;
    return bits;
  }
  Result<void> set(std::uint32_t offset, std::uint32_t value) {
    if (!port_.write(offset, value)) return Error::kBus;
    return {};
  }
  Result<void> set(std::uint32_t first, std::uint32_t value, std::uint32_t second,
                   std::uint32_t other) {
    if (!port_.write(first, value)) return Error::kBus;
    return set(second, other);
  }
  // Reading the low word copies the high one.
  Result<std::uint64_t> pair(std::uint32_t low_offset, std::uint32_t high_offset) {
    std::uint32_t low = 0, high = 0;
    if (!port_.read(low_offset, low) || !port_.read(high_offset, high)) return Error::kBus;
    return std::uint64_t{high} << 32U | low;
  }

  Port& port_;
};

}  // namespace biss_axi

#endif  // BISS_AXI_PAGE_HPP_
