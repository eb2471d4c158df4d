// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/dsl_model/messages.hpp"

#include <algorithm>
#include <utility>

#include "sim/masters/dsl_model/frame_plan.hpp"

namespace mb4::sim::dsl_model {
namespace {

// Symbols of the encoder.
constexpr unsigned kSymbol = 0x1F;
constexpr unsigned kNibble = 0x10;  // those below it
constexpr unsigned kShortNak = 0x15;
constexpr unsigned kLongNak = 0x1A;
constexpr unsigned kInitialised = 0x1F;

// The first byte of a message.
constexpr std::uint8_t kLongBit = 0x80;
constexpr std::uint8_t kReadBit = 0x40;
constexpr std::uint8_t kShortAddress = 0x3F;
constexpr std::uint8_t kOffsetBit = 0x20;  // in an answer: an error
constexpr std::uint8_t kHighAddress = 0x03;
constexpr std::uint8_t kControlRead = 0x80;

constexpr unsigned length_of(std::uint8_t header) {
  constexpr unsigned kLengths[] = {0, 2, 4, 8};
  return kLengths[header >> 2U & 3U];
}

// Nibbles of an answer whose first byte is known.
constexpr std::size_t nibbles_of(std::uint8_t header) {
  if ((header & kLongBit) != 0) return 8 + 2 * std::size_t{length_of(header)};
  return (header & kReadBit) != 0 ? 8 : 6;
}

}  // namespace

// ---- The host -----------------------------------------------------------------------------------

bool Messages::start_short(Host host, std::uint8_t control) {
  Short& one = shorts_[host];
  if (one.runs || resetting_ || control == kIdleControl) return false;
  one.runs = true;
  one.control = control;
  return true;
}

std::uint8_t Messages::control(Host host) const {
  return shorts_[host].runs ? shorts_[host].control : kIdleControl;
}

void Messages::set_data(Host host, std::uint8_t data) {
  if (!shorts_[host].runs) shorts_[host].data = data;
}

bool Messages::start_long() {
  if (long_.runs || resetting_) return false;
  long_ = {.runs = true};
  return true;
}

void Messages::set_buffer(unsigned index, std::uint8_t data) {
  if (!long_.runs) buffer_[index] = data;
}

void Messages::set_address(Address which, std::uint8_t data) {
  if (long_.runs) return;
  const bool high = which == kAddressHigh || which == kOffsetHigh;
  address_[which] = static_cast<std::uint8_t>(data | (high ? kLongBit : 0U));
}

// ---- Requests -----------------------------------------------------------------------------------

Messages::Bytes Messages::request(Kind kind) const {
  Bytes bytes;
  if (kind == Kind::kShort) {
    const Short& one = shorts_[*turn_.host];
    const bool read = (one.control & kControlRead) != 0;
    bytes.push_back(
        static_cast<std::uint8_t>((one.control & kShortAddress) | (read ? kReadBit : 0U)));
    if (!read) bytes.push_back(one.data);
  } else {
    bytes = {address_[kAddressHigh], address_[kAddressLow]};
    if ((bytes[0] & kOffsetBit) != 0) {
      bytes.push_back(address_[kOffsetHigh]);
      bytes.push_back(address_[kOffsetLow]);
    }
    if ((bytes[0] & kReadBit) == 0) {
      bytes.insert(bytes.end(), buffer_.begin(), buffer_.begin() + length_of(bytes[0]));
    }
  }
  const std::uint16_t crc = crc16(bytes);
  bytes.push_back(static_cast<std::uint8_t>(crc >> 8U));
  bytes.push_back(static_cast<std::uint8_t>(crc));
  return bytes;
}

// Who sends next.
void Messages::choose() {
  if (!turn_.host) {
    for (const Host host : {kMain, kSafe}) {
      if (turn_.host || !shorts_[host].runs) continue;
      turn_ = {.host = host, .due = true};
    }
  }
  if (turn_.host) {
    if (turn_.due && !answer_comes()) armed_ = Kind::kShort;
    return;
  }
  if (long_.runs && !long_.begun) armed_ = Kind::kLong;
}

void Messages::send(Kind kind) {
  sending_ = kind;
  out_.clear();
  next_ = 0;
  for (const std::uint8_t byte : request(kind)) {
    out_.push_back(byte >> 4U);
    out_.push_back(byte & 0xFU);
  }
  if (kind == Kind::kLong) {
    long_.begun = true;
    return;
  }
  if (turn_.begun) ++retries_;
  turn_.begun = true;
  turn_.due = false;
}

// The last nibble of a request goes with this frame.
void Messages::sent() {
  if (std::exchange(sending_, Kind::kNone) == Kind::kLong) {
    long_.open = true;
    return;
  }
  turn_.repeated |= turn_.by_time && turn_.open;
  turn_.by_time = false;
  turn_.open = true;
  turn_.since = 0;
}

unsigned Messages::symbol() {
  init_ = resetting_;
  if (init_) return kInit;
  if (turn_.open || turn_.answered) ++turn_.since;
  if (sending_ == Kind::kShort && answer_comes()) {
    // An answer to the request before: the rest of this one is not sent.
    sending_ = Kind::kNone;
    turn_.due = true;
    return kIdle;
  }
  if (sending_ == Kind::kShort && !turn_.host) sending_ = Kind::kNone;
  if (armed_ == Kind::kShort && (answer_comes() || !turn_.due)) armed_ = Kind::kNone;
  if (const Kind now = std::exchange(armed_, Kind::kNone); now != Kind::kNone) send(now);
  if (sending_ != Kind::kNone) {
    const unsigned value = out_[next_++];
    if (next_ == out_.size()) sent();
    return value;
  }
  if (turn_.open && turn_.since >= kWait && !turn_.due) turn_.due = turn_.by_time = true;
  if (quiet_ == 0) {
    choose();
  } else {
    --quiet_;
  }
  return kIdle;
}

// ---- Answers ------------------------------------------------------------------------------------

MessageEvents Messages::frame(const Word& parameter) {
  MessageEvents events;
  std::optional<unsigned> symbol;
  if (!parameter.error && !parameter.special) symbol = parameter.byte & kSymbol;
  if (init_) {
    if (symbol == kInitialised) events = initialised();
    return events;
  }
  if (symbol && *symbol < kNibble) {
    nibble(*symbol, events);
  } else {
    other(symbol, events);
  }
  if (turn_.answered && turn_.since >= kWait) end_short(events);
  wait_for_long(events);
  return events;
}

void Messages::nibble(unsigned value, MessageEvents& events) {
  if (ignoring_) return;
  const auto digit = static_cast<std::uint8_t>(value);
  if (receiving_ == Kind::kNone) {
    const bool says_long = value >= 8;
    const bool goes_on = paused_ && (says_long || !turn_.open);
    receiving_ = goes_on || says_long ? Kind::kLong : Kind::kShort;
    if (goes_on) {
      paused_ = false;
    } else if (receiving_ == Kind::kLong) {
      long_in_.clear();
      long_expected_ = long_.open;
    } else {
      short_in_.clear();
      short_expected_ = turn_.open;
    }
  }
  std::vector<std::uint8_t>& in = receiving_ == Kind::kLong ? long_in_ : short_in_;
  in.push_back(digit);
  if (in.size() < 2) return;
  if (in.size() < nibbles_of(static_cast<std::uint8_t>(in[0] << 4U | in[1]))) return;
  Bytes bytes;
  for (std::size_t i = 0; i < in.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(in[i] << 4U | in[i + 1]));
  }
  ignoring_ = true;
  const Kind kind = std::exchange(receiving_, Kind::kNone);
  const std::size_t covered = bytes.size() - 2;
  if (crc16({bytes.data(), covered}) != (bytes[covered] << 8U | bytes[covered + 1])) {
    return broken(kind, events);
  }
  whole(kind, bytes, events);
}

// A symbol that is no nibble, or none that could be read.
void Messages::other(std::optional<unsigned> symbol, MessageEvents& events) {
  ignoring_ = false;
  if (const Kind kind = std::exchange(receiving_, Kind::kNone); kind != Kind::kNone) {
    const bool pauses = kind == Kind::kLong && symbol == kIdle && short_waits();
    if (pauses) {
      paused_ = true;
      pause_ = 0;
    } else {
      broken(kind, events);
    }
  }
  if (symbol == kShortNak && turn_.open && sending_ != Kind::kShort) turn_.due = true;
  if (symbol == kLongNak && long_.open) {
    events.wrong_answer = true;
    end_long(events);
  }
}

void Messages::broken(Kind kind, MessageEvents& events) {
  if (kind != Kind::kLong || !long_.open) return;
  events.wrong_answer = true;
  end_long(events);
}

void Messages::whole(Kind kind, const Bytes& bytes, MessageEvents& events) {
  if (kind == Kind::kShort) {
    take_short(bytes, events);
  } else {
    take_long(bytes, events);
  }
}

void Messages::take_short(const Bytes& bytes, MessageEvents& events) {
  const bool read = (bytes[0] & kReadBit) != 0;
  bool fits = turn_.open && short_expected_;
  if (fits && rules_.check_answers) {
    const std::uint8_t control = shorts_[*turn_.host].control;
    fits = ((control & kControlRead) != 0) == read && ((control ^ bytes[0]) & kShortAddress) == 0;
  }
  if (!fits) {
    ++foreign_;
    return;
  }
  if (read) shorts_[*turn_.host].data = bytes[1];
  turn_.open = turn_.due = false;
  if (sending_ == Kind::kShort) sending_ = Kind::kNone;
  turn_.answered = true;
  if (!turn_.repeated || turn_.since >= kWait) end_short(events);
}

void Messages::end_short(MessageEvents& events) {
  events.short_free[*turn_.host] = true;
  shorts_[*turn_.host].runs = false;
  turn_ = {};
}

void Messages::take_long(const Bytes& bytes, MessageEvents& events) {
  const std::uint8_t asked = address_[kAddressHigh];
  const bool error = (bytes[0] & kOffsetBit) != 0;
  const unsigned length = length_of(bytes[0]);
  bool fits = long_.open && long_expected_;
  if (fits && rules_.check_answers) {
    const bool read = (asked & kReadBit) != 0;
    const bool right_length = error || length == length_of(asked) || (!read && length == 0);
    fits = ((asked ^ bytes[0]) & (kReadBit | kHighAddress)) == 0 &&
           bytes[1] == address_[kAddressLow] && right_length;
  }
  if (!fits) {
    ++foreign_;
    return;
  }
  address_[kAddressHigh] = bytes[0];
  address_[kAddressLow] = bytes[1];
  std::copy(bytes.begin() + 2, bytes.begin() + 2 + length, buffer_.begin());
  if (error && rules_.sdk_map && length >= 2) std::swap(buffer_[0], buffer_[1]);
  end_long(events);
}

void Messages::end_long(MessageEvents& events) {
  events.long_free = true;
  long_ = {};
  paused_ = false;
}

// A long answer that has paused goes on within a time, unless a short message is under way.
void Messages::wait_for_long(MessageEvents& events) {
  if (!paused_) return;
  if (short_waits()) {
    pause_ = 0;
  } else if (++pause_ == kWait) {
    paused_ = false;
    broken(Kind::kLong, events);
  }
}

// ---- The link -----------------------------------------------------------------------------------

MessageEvents Messages::initialised() {
  MessageEvents events;
  events.initialised = events.long_free = true;
  events.short_free = {true, true};
  resetting_ = init_ = false;
  for (Short& one : shorts_) one.runs = false;
  long_ = {};
  turn_ = {};
  armed_ = sending_ = receiving_ = Kind::kNone;
  ignoring_ = paused_ = false;
  return events;
}

MessageEvents Messages::link_begins() {
  constexpr unsigned kVertical = 8;
  quiet_ = kVertical;
  MessageEvents events;
  events.long_free = !long_.runs;
  for (const Host host : {kMain, kSafe}) events.short_free[host] = !shorts_[host].runs;
  return events;
}

// A long message may have been done. A short one is sent again.
MessageEvents Messages::link_ends() {
  MessageEvents events;
  if (long_.begun) {
    events.wrong_answer = true;
    end_long(events);
  }
  if (turn_.answered) end_short(events);
  if (turn_.host) turn_ = {.host = turn_.host, .begun = turn_.begun, .due = true};
  armed_ = sending_ = receiving_ = Kind::kNone;
  ignoring_ = paused_ = init_ = false;
  return events;
}

}  // namespace mb4::sim::dsl_model
