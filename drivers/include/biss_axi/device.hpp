// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Driver of biss_axi, the BiSS C master with N channels on AXI4-Lite. Freestanding C++17: no heap,
// no exceptions, no static state. Several devices may be used at once. A device must not be used
// from two contexts (an interrupt and the main program) at the same time: the words of a channel
// go by an index register.

#ifndef BISS_AXI_DEVICE_HPP_
#define BISS_AXI_DEVICE_HPP_

#include "enc/cpp17.hpp"
#if __cplusplus >= 201703L

#include <cstdint>
#include <type_traits>
#include <utility>

#include "axi_regs.hpp"
#include "enc/bus.hpp"
#include "enc/crc.hpp"
#include "enc/result.hpp"

namespace biss_axi {

// What went wrong. The master was touched, unless it says otherwise.
enum class Error : std::uint8_t {
  kNone = 0,
  kConfig,   // the configuration is wrong; see ErrorInfo::field; the master was not touched
  kChannel,  // no such channel; the master was not touched
  kBus,      // the port reported a failed access
  kTimeout,  // no good word came in time: no encoder, a wrong CRC, or a busy line
  kNoData,   // position(): the last request has brought no good word of this channel, or not yet
  // The word has come and its nE is 0: the encoder says that its position is not to be trusted.
  // Result::value() refuses it, Result::reading() gives it.
  kSlaveError,
  // CALCULATED_CRC fits the word with none of the four pairs of nE and nW: they are not of one
  // frame.
  kCrc,
};

// The member of Config that is wrong.
enum class Field : std::uint8_t { kNone = 0, kClkHz, kMaHz, kPositionBits, kChannels, kSampleHz };

struct ErrorInfo {
  constexpr ErrorInfo(Error error = Error::kNone, Field where = Field::kNone)
      : code(error), field(where) {}
  Error code;
  Field field;
  static constexpr std::uint32_t pack(ErrorInfo info) {
    return static_cast<std::uint32_t>(info.code) | static_cast<std::uint32_t>(info.field) << 8U;
  }
  static constexpr ErrorInfo unpack(std::uint32_t word) {
    return {static_cast<Error>(word & 0xFFU), static_cast<Field>(word >> 8U & 0xFFU)};
  }
};

template <typename T>
using Result = enc::Result<T, ErrorInfo>;

// The word of one channel; where its position is wanted it converts to it.
template <typename T>
struct Reading {
  constexpr Reading(T word = 0) : position(word) {}
  constexpr operator T() const { return position; }
  T position;
  bool slave_error = false;    // nE = 0: the position is not to be trusted
  bool slave_warning = false;  // nW = 0
};

// The port contract. A type `Port` has
//
//   bool write(std::uint32_t offset, std::uint32_t value);
//   bool read(std::uint32_t offset, std::uint32_t& value);
//
// One call is one access of 32 bits at a byte offset from the master's base address. It returns
// false if the access failed.
template <typename Port, typename = void>
inline constexpr bool kIsPort = false;

template <typename Port>
inline constexpr bool kIsPort<
    Port, std::void_t<decltype(std::declval<Port&>().write(std::uint32_t{}, std::uint32_t{})),
                      decltype(std::declval<Port&>().read(std::uint32_t{},
                                                          std::declval<std::uint32_t&>()))>> =
    std::is_same_v<decltype(std::declval<Port&>().write(std::uint32_t{}, std::uint32_t{})), bool>;

enum class Start : std::uint8_t {
  kSinglePoint,    // read_single()
  kInternalClock,  // the divider, sample_hz
  kExternalClock,  // pin ext_sample_clk
};

struct Config {
  std::uint32_t f_clk_hz = 100'000'000;  // axi_aclk; 1 kHz to 1 GHz
  // Clock at pin ma: f_clk_hz / (2 M) with M = 1 to 255, exactly.
  std::uint32_t ma_hz = 10'000'000;
  std::uint8_t position_bits = 26;  // 1 to 32; with `wide` to 64
  std::uint32_t channels = 1;       // bit c: channel c is enabled; 16 bits
  bool check_crc = true;
  // Parameters of the master: the extra WIDE, ENABLE_ACTIVE_LOW, CRC_BIT_IGNORES.
  bool wide = false;
  bool enable_active_low = false;
  bool crc_bit_ignores = false;
  Start start = Start::kSinglePoint;
  // kInternalClock only: f_clk_hz / (2 N) with N = 1 to 268435455, exactly.
  std::uint32_t sample_hz = 0;
};

// The divider M or N for a frequency, or 0 if the master cannot make it.
[[nodiscard]] constexpr std::uint32_t divider(std::uint32_t f_clk_hz, std::uint32_t hz,
                                              std::uint32_t most) {
  if (hz == 0 || hz > f_clk_hz / 2U || f_clk_hz % hz != 0 || f_clk_hz / hz % 2U != 0) return 0;
  return f_clk_hz / hz / 2U <= most ? f_clk_hz / hz / 2U : 0;
}

// The smallest divider M for which MA is not faster than `most_hz`, which is not 0. It may be more
// than the register holds.
[[nodiscard]] constexpr std::uint32_t divider_at_most(std::uint32_t f_clk_hz,
                                                      std::uint32_t most_hz) {
  const std::uint64_t period = 2U * std::uint64_t{most_hz};
  return static_cast<std::uint32_t>((f_clk_hz + period - 1U) / period);
}

[[nodiscard]] constexpr ErrorInfo validate(const Config& config) {
  if (config.f_clk_hz < 1'000U || config.f_clk_hz > 1'000'000'000U)
    return {Error::kConfig, Field::kClkHz};
  if (divider(config.f_clk_hz, config.ma_hz, regs::MA_DIVIDER::kMax) == 0)
    return {Error::kConfig, Field::kMaHz};
  if (config.position_bits < 1 || config.position_bits > (config.wide ? 64 : 32))
    return {Error::kConfig, Field::kPositionBits};
  if (config.channels == 0 || config.channels > regs::CHANNEL_ENABLE::kMax)
    return {Error::kConfig, Field::kChannels};
  if (config.start == Start::kInternalClock &&
      divider(config.f_clk_hz, config.sample_hz, regs::SAMPLE_DIVIDER::kMax) == 0)
    return {Error::kConfig, Field::kSampleHz};
  return {};
}

// How long a single-point frame can last, and how long the master or an encoder may be in its
// timeout: the master for TIMEOUT_LIMIT clocks while SLO stays low, an encoder for 40 us.
// The master is asked for words first after the time of the shortest frame, then in steps of an
// eighth of it.
struct WaitTimes {
  std::uint32_t frame_us = 0;
  std::uint32_t timeout_us = 0;
  std::uint32_t shortest_us = 0;
};

// For a master with START_LIMIT and TIMEOUT_LIMIT as they are by default. The frame has the longest
// processing time that the master waits for and the longest line delay. `f_clk_hz` is not 0.
[[nodiscard]] constexpr WaitTimes wait_times(std::uint32_t f_clk_hz, std::uint32_t ma_divider,
                                             std::uint32_t position_bits) {
  constexpr std::uint64_t kStartLimit = 1024;    // MA periods
  constexpr std::uint64_t kOtherBits = 16;       // edges, flags, CRC
  constexpr std::uint64_t kDelayLimit = 1023;    // clocks
  constexpr std::uint64_t kTimeoutLimit = 4000;  // clocks
  constexpr std::uint32_t kEncoderTimeoutUs = 40;
  const std::uint64_t frame =
      2U * std::uint64_t{ma_divider} * (kStartLimit + position_bits + kOtherBits) + kDelayLimit;
  const std::uint64_t timeout_us = kTimeoutLimit * 1'000'000U / f_clk_hz + 1U;
  const std::uint64_t shortest = 2U * std::uint64_t{ma_divider} * (position_bits + 2U);
  return {
      static_cast<std::uint32_t>(frame * 1'000'000U / f_clk_hz) + 1U,
      timeout_us > kEncoderTimeoutUs ? static_cast<std::uint32_t>(timeout_us) : kEncoderTimeoutUs,
      static_cast<std::uint32_t>(shortest * 1'000'000U / f_clk_hz)};
}

// A word of one channel (0 to 15), which goes by the index register.
template <typename Port>
Result<std::uint32_t> channel_word(Port& port, unsigned channel, std::uint32_t offset) {
  std::uint32_t value = 0;
  if (!port.write(regs::kAddrChannelIndex, channel) || !port.read(offset, value))
    return Error::kBus;
  return value;
}

// Register FEATURES, or 0 if the master has no page.
template <typename Port>
Result<std::uint32_t> features(Port& port) {
  std::uint32_t id = 0;
  std::uint32_t value = 0;
  if (!port.read(regs::kAddrId, id) || !port.read(regs::kAddrFeatures, value)) return Error::kBus;
  return id == regs::kResetId ? value : 0;
}

// What the registers say of a channel's word of the last single-point request.
struct SinglePoint {
  std::uint64_t word = 0;
  std::uint32_t bits = 0;
  std::uint32_t calculated = 0;  // CALCULATED_CRC
  std::uint32_t polynomial = 0, start = 0;
};

// Reads them: kNoData without a word. At most ten accesses.
template <typename Port>
Result<SinglePoint> read_single_point(Port& port, unsigned channel) {
  std::uint32_t valid = 0, low = 0, high = 0;
  if (channel >= regs::kChannels) return Error::kChannel;
  if (!port.write(regs::kAddrChannelIndex, channel) ||
      !port.read(regs::kAddrSinglePointValid, valid)) {
    return Error::kBus;
  }
  if ((valid >> channel & 1U) == 0) return Error::kNoData;
  const Result<std::uint32_t> has = features(port);
  const bool wide = has.ok() && regs::HAS_WIDE::get(*has) != 0;
  const bool any_crc = has.ok() && regs::HAS_ANY_CRC::get(*has) != 0;
  SinglePoint point;
  if (!has.ok() || !port.read(regs::kAddrSinglePointData, low) ||
      (wide && !port.read(regs::kAddrPositionHigh, high)) ||
      !port.read(regs::kAddrPositionBits, point.bits) ||
      !port.read(regs::kAddrCalculatedCrc, point.calculated) ||
      (any_crc && (!port.read(regs::kAddrCrcPolynomial, point.polynomial) ||
                   !port.read(regs::kAddrCrcStart, point.start)))) {
    return Error::kBus;
  }
  const std::uint32_t most = wide ? 64U : 32U;
  point.bits = point.bits == 0 ? 32U : point.bits > most ? most : point.bits;
  point.polynomial = point.polynomial < 2U ? 0x43U : point.polynomial;
  point.word = std::uint64_t{high} << 32U | low;
  return point;
}

// The flags of a word: kSlaveError, kCrc. The map does not show nE and nW. CALCULATED_CRC is that
// of the position and the flags as they came, and each of the four pairs has a CRC of its own, so
// it tells which they were. Polynomial and start are those of Page::set_crc().
template <typename T>
Result<Reading<T>> with_flags(const SinglePoint& point) {
  constexpr unsigned kPairs = 4;
  enc::CrcShift of_position(point.polynomial, static_cast<std::uint16_t>(point.start));
  for (std::uint32_t bit = point.bits; bit > 0; --bit) {
    of_position.shift(static_cast<unsigned>(point.word >> (bit - 1U) & 1U));
  }
  const std::uint32_t mask = (std::uint32_t{1} << enc::crc_width_bits(point.polynomial)) - 1U;
  Reading<T> reading(static_cast<T>(point.word));
  bool fits = false;
  for (unsigned pair = 0; pair < kPairs; ++pair) {
    enc::CrcShift crc = of_position;
    crc.shift(pair >> 1U);
    crc.shift(pair & 1U);
    if ((~std::uint32_t{crc.value()} & mask) == (point.calculated & mask)) {
      // A CRC of one bit fits several: then the worst of them counts.
      reading.slave_error = reading.slave_error || (pair & 2U) == 0;
      reading.slave_warning = reading.slave_warning || (pair & 1U) == 0;
      fits = true;
    }
  }
  if (!fits) return Error::kCrc;
  return {reading, reading.slave_error ? Error::kSlaveError : Error::kNone};
}

// The channel's word of the last single-point request, as T, with its flags.
template <typename T, typename Port>
Result<Reading<T>> read_position(Port& port, unsigned channel) {
  const Result<SinglePoint> point = read_single_point(port, channel);
  if (!point.ok()) return point.error();
  return with_flags<T>(*point);
}

// The clock is polled at most so often, so one that stands still cannot block a call for ever.
inline constexpr std::uint32_t kMostPolls = 1'000'000;

// When the master is asked for words.
class Looks {
 public:
  explicit constexpr Looks(const WaitTimes& times)
      : next_us_(times.shortest_us), step_us_(times.shortest_us / 8U + 1U) {}
  // `passed_us`: since the frame was asked for.
  constexpr bool due(std::uint32_t passed_us) {
    if (passed_us < next_us_) return false;
    next_us_ = passed_us + step_us_;
    return true;
  }

 private:
  std::uint32_t next_us_, step_us_;
};

// The time since its making. Where the clock has not moved for many readings, an access lets time
// pass: so a clock that counts accesses, as in a simulation, goes on too.
template <typename Port, typename Clock>
class Watch {
 public:
  Watch(Port& port, Clock& clock)
      : port_(port), clock_(clock), begin_us_(clock.now_us()), now_us_(begin_us_) {}
  // False: the access has failed.
  bool passed(std::uint32_t& us) {
    const std::uint32_t now = clock_.now_us();
    still_ = now == now_us_ ? still_ + 1U : 0U;
    now_us_ = now;
    us = now - begin_us_;
    if (still_ < kStill) return true;
    still_ = 0;
    std::uint32_t value = 0;
    return port_.read(regs::kAddrMode, value);
  }

 private:
  static constexpr std::uint32_t kStill = 64;
  Port& port_;
  Clock& clock_;
  std::uint32_t begin_us_, now_us_;
  std::uint32_t still_ = 0;
};

// Frames and starts of a channel so far, modulo 2^32: it changes with the end of each frame and
// with each start at which SLO is 0.
template <typename Port>
bool read_ends(Port& port, unsigned channel, std::uint32_t& ends) {
  std::uint32_t lates = 0;
  if (!port.write(regs::kAddrChannelIndex, channel) || !port.read(regs::kAddrFrameCount, ends) ||
      !port.read(regs::kAddrLateCount, lates)) {
    return false;
  }
  ends += lates;
  return true;
}

// Makes the rising edge at REQUEST until a read has started. An edge in a timeout, or in a frame of
// another mode, is skipped. A timeout ends when SLO rises, at any instant, so the request is
// repeated, but not faster than every two microseconds. False: every edge was skipped.
template <typename Port, typename Clock>
Result<bool> request_until_taken(Port& port, Clock& clock, const WaitTimes& times) {
  constexpr std::uint32_t kAgainUs = 2;
  std::uint32_t skips = 0, value = 0, next = 0, passed = 0;
  if (!port.read(regs::kAddrSkipCount, skips)) return Error::kBus;
  Watch<Port, Clock> watch(port, clock);
  const std::uint32_t longest = times.timeout_us + times.frame_us;
  for (std::uint32_t n = 0; n < kMostPolls && passed <= longest; ++n) {
    if (!watch.passed(passed)) return Error::kBus;
    if (passed < next) continue;
    next = passed + kAgainUs;
    if (!port.write(regs::kAddrRequest, 0) || !port.write(regs::kAddrRequest, 1) ||
        !port.read(regs::kAddrSinglePointValid, value) || !port.read(regs::kAddrSkipCount, value)) {
      return Error::kBus;
    }
    if (value == skips) return true;
    skips = value;
  }
  return false;
}

// single_point() for a master with counters that clears SINGLE_POINT_VALID at a request. Nothing is
// reset, and it ends when the channels have ended their frames.
template <typename Port, typename Clock>
Result<std::uint32_t> single_point_by_counters(Port& port, Clock& clock, const WaitTimes& times,
                                               std::uint32_t channels) {
  std::uint32_t before[regs::kChannels] = {};
  for (unsigned c = 0; c < regs::kChannels; ++c) {
    if ((channels >> c & 1U) != 0 && !read_ends(port, c, before[c])) return Error::kBus;
  }
  const Result<bool> taken = request_until_taken(port, clock, times);
  if (!taken.ok()) return taken.error();
  if (!*taken) return std::uint32_t{0};
  Watch<Port, Clock> watch(port, clock);
  Looks looks(times);
  std::uint32_t waited = channels, passed = 0, value = 0;
  for (std::uint32_t n = 0; n < kMostPolls && waited != 0; ++n) {
    if (!watch.passed(passed)) return Error::kBus;
    const bool last = passed > times.frame_us;  // and look once more
    if (!last && !looks.due(passed)) continue;
    for (unsigned c = 0; c < regs::kChannels; ++c) {
      std::uint32_t ends = 0;
      if ((waited >> c & 1U) == 0) continue;
      if (!read_ends(port, c, ends)) return Error::kBus;
      if (ends != before[c]) waited &= ~(1U << c);
    }
    if (last) waited = 0;
  }
  if (!port.read(regs::kAddrSinglePointValid, value)) return Error::kBus;
  return value;
}

// One single-point frame: clears all results, lets the encoders' timeouts pass, makes the rising
// edge at REQUEST and waits until the words of all `channels` (bit c: channel c) have come, at most
// as long as a frame can last. Returns bit c: the word of channel c has come and is good. With
// counters (FEATURES) it resets nothing; see single_point_by_counters().
template <typename Port, typename Clock>
Result<std::uint32_t> single_point(Port& port, Clock& clock, const WaitTimes& times,
                                   std::uint32_t channels) {
  const Result<std::uint32_t> has = features(port);
  if (!has.ok()) return has;
  if (regs::HAS_COUNTERS::get(*has) != 0 && regs::CLEARS_VALID::get(*has) != 0)
    return single_point_by_counters(port, clock, times, channels);
  if (!port.write(regs::kAddrRequest, 0) || !port.write(regs::kAddrSoftReset, 1) ||
      !port.write(regs::kAddrSoftReset, 0)) {
    return Error::kBus;
  }
  std::uint32_t value = 0, passed = 0;
  Watch<Port, Clock> resting(port, clock);
  for (std::uint32_t n = 0; n < kMostPolls && passed <= times.timeout_us; ++n) {
    if (!resting.passed(passed)) return Error::kBus;
  }
  if (!port.write(regs::kAddrRequest, 1)) return Error::kBus;
  Watch<Port, Clock> watch(port, clock);
  Looks looks(times);
  bool last = false;
  for (std::uint32_t n = 0; n < kMostPolls && !last; ++n) {
    if (!watch.passed(passed)) return Error::kBus;
    last = passed > times.frame_us || n + 1 == kMostPolls;  // and look once more
    if (!last && !looks.due(passed)) continue;
    if (!port.read(regs::kAddrSinglePointValid, value)) return Error::kBus;
    last = last || (value & channels) == channels;
  }
  return value;
}

// Port: see kIsPort. Clock: see enc/bus.hpp. Both live as long as the device.
template <typename Port, typename Clock>
class Device {
  static_assert(kIsPort<Port>,
                "Port needs bool write(offset, value) and bool read(offset, value&)");
  static_assert(enc::kIsClock<Clock>, "Clock needs std::uint32_t now_us()");

 public:
  Device(Port& port, Clock& clock) : port_(port), clock_(clock) {}

  // Ends what runs, clears all results, and sets everything. The channels are enabled last.
  Result<void> configure(const Config& config) {
    if (const ErrorInfo wrong = validate(config); wrong.code != Error::kNone) return wrong;
    const bool single = config.start == Start::kSinglePoint;
    const std::uint32_t sample =
        config.start == Start::kInternalClock
            ? divider(config.f_clk_hz, config.sample_hz, regs::SAMPLE_DIVIDER::kMax)
            : regs::SAMPLE_DIVIDER::kMax;  // it starts nothing, and changes its pin seldom
    const std::uint32_t ma = divider(config.f_clk_hz, config.ma_hz, regs::MA_DIVIDER::kMax);
    const bool done =
        write(regs::kAddrSoftReset, 1) && write(regs::kAddrMode, 1) &&
        write(regs::kAddrRequest, 0) && write(regs::kAddrSampleDivider, sample) &&
        write(regs::kAddrMaDivider, ma) && write(regs::kAddrPositionBits, config.position_bits) &&
        write(regs::kAddrCrcCheck, config.check_crc != config.crc_bit_ignores ? 1 : 0) &&
        write(regs::kAddrSampleClock, config.start == Start::kExternalClock ? 1 : 0) &&
        write(regs::kAddrChannelEnable, config.enable_active_low
                                            ? ~config.channels & regs::CHANNEL_ENABLE::kMax
                                            : config.channels) &&
        write(regs::kAddrMode, single ? 1 : 0) && write(regs::kAddrSoftReset, 0);
    if (!done) return Error::kBus;
    times_ = wait_times(config.f_clk_hz, ma, config.position_bits);
    channels_ = config.channels;
    return {};
  }

  // Starts one frame on all enabled channels, in single-point mode, and waits for the word of one.
  // position() has the words of the others; one with a longer cable or processing time may still
  // come. An old word is never taken for a new one: the call clears all results first, or the
  // request does.
  // kSlaveError: the word has come with nE = 0.
  Result<Reading<std::uint32_t>> read_single(unsigned channel) {
    if (channel >= regs::kChannels || (channels_ >> channel & 1U) == 0) return Error::kChannel;
    const Result<std::uint32_t> good = single_point(port_, clock_, times_, 1U << channel);
    if (!good.ok()) return good.failure();
    if ((*good >> channel & 1U) == 0) return Error::kTimeout;
    return read_position<std::uint32_t>(port_, channel);
  }

  // The same for all enabled channels. Returns bit c: channel c has a word with a right CRC, and
  // position() has it; nE is not looked at. Without one of the words the call lasts as long as a
  // frame can.
  Result<std::uint32_t> read_all() { return single_point(port_, clock_, times_, channels_); }

  // The channel's word of the last single-point request; kNoData while it has brought no good one,
  // kSlaveError if its nE is 0.
  Result<Reading<std::uint32_t>> position(unsigned channel) {
    return read_position<std::uint32_t>(port_, channel);
  }
  // Round trip from MA to SLO in clocks, of the channel's last frame; 1023: no acknowledge.
  Result<std::uint32_t> line_delay(unsigned channel) {
    if (channel >= regs::kChannels) return Error::kChannel;
    return channel_word(port_, channel, regs::kAddrLineDelay);
  }
  // Bit c: the single-point word of channel c is good and of the last request.
  Result<std::uint32_t> valid() {
    std::uint32_t value = 0;
    if (!read(regs::kAddrSinglePointValid, value)) return Error::kBus;
    return value;
  }

 private:
  bool write(std::uint32_t offset, std::uint32_t value) { return port_.write(offset, value); }
  bool read(std::uint32_t offset, std::uint32_t& value) { return port_.read(offset, value); }

  Port& port_;
  Clock& clock_;
  WaitTimes times_;
  std::uint32_t channels_ = 0;
};

}  // namespace biss_axi

#endif  // C++17

#endif  // BISS_AXI_DEVICE_HPP_
