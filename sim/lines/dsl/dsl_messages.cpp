// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/dsl/dsl_messages.hpp"

#include <algorithm>
#include <utility>

#include "sim/lines/dsl/dsl_code.hpp"

namespace mb4::sim::dsl {
namespace {

// Remote registers.
constexpr std::uint8_t kStatus0 = 0x40;
constexpr std::uint8_t kStatus7 = 0x47;
constexpr std::uint8_t kStrength = 0x7C;
constexpr std::uint8_t kMail = 0x7E;
constexpr std::uint8_t kPing = 0x7F;
constexpr std::uint8_t kBestStrength = 7;
constexpr std::uint8_t kProtocolReset = 0x01;  // in ENC_ST0

// The first byte of a message.
constexpr std::uint8_t kLong = 0x80;
constexpr std::uint8_t kRead = 0x40;
constexpr std::uint8_t kAddress = 0x3F;   // of a short one
constexpr std::uint8_t kOffset = 0x20;    // of a long request; in an answer: an error
constexpr std::uint8_t kIndirect = 0x10;  // of a long one, and the next two
constexpr unsigned kLengthShift = 2;
constexpr std::uint8_t kHighAddress = 0x03;

constexpr unsigned kNibble = 0x10;  // symbols below it
constexpr unsigned kLostNibble = 2;

unsigned data_length(std::uint8_t header) {
  const unsigned code = header >> kLengthShift & 3U;
  return code == 0 ? 0 : 1U << code;
}

std::uint8_t with_length(std::uint8_t header, unsigned length) {
  const unsigned code = length == 8 ? 3U : length / 2;
  constexpr unsigned kMask = 3U << kLengthShift;
  return static_cast<std::uint8_t>((header & ~kMask) | code << kLengthShift);
}

bool good(const std::vector<std::uint8_t>& bytes) {
  const std::span all(bytes);
  return check_bytes(all.first(all.size() - 2)) == (all[all.size() - 2] << 8U | all.back());
}

void add_check(std::vector<std::uint8_t>& bytes) {
  const std::uint16_t crc = check_bytes(bytes);
  bytes.push_back(static_cast<std::uint8_t>(crc >> 8U));
  bytes.push_back(static_cast<std::uint8_t>(crc));
}

unsigned turn_bits(const MessageConfig& config, const ResourceFacts& facts) {
  constexpr unsigned kUsual = 20;
  const unsigned asked = config.turn_bits == 0 ? kUsual : config.turn_bits;
  return std::min({asked, facts.position_bits, 31U});
}

ResourceFacts with_turn(ResourceFacts facts, const MessageConfig& config) {
  facts.turn_bits = turn_bits(config, facts);
  return facts;
}

}  // namespace

ParameterChannel::ParameterChannel(const MessageConfig& config, const ResourceFacts& facts,
                                   RegisterFile& registers)
    : config_(config),
      registers_(registers),
      tree_(standard_resources(with_turn(facts, config)), config.resources, config.access_level) {
  registers_.set(kStatus0, kProtocolReset);
  registers_.set(kStrength, kBestStrength);
  registers_.set(kPing, config.hardware_version);
}

void ParameterChannel::reset() {
  received_.clear();
  ignoring_ = false;
  short_ = long_ = {};
  sending_ = nullptr;
  gap_ = true;
  nak_.reset();
}

unsigned ParameterChannel::frame(std::optional<unsigned> symbol) {
  // What comes with this frame is answered from the next one on.
  const unsigned sent = send();
  for (Order* order : {&short_, &long_}) {
    if (order->wait != 0) --order->wait;
  }
  take(symbol);
  return sent;
}

// ---- Requests -----------------------------------------------------------------------------------

void ParameterChannel::take(std::optional<unsigned> symbol) {
  if (!symbol || *symbol >= kNibble) return broken();
  if (ignoring_) return;
  received_.push_back(static_cast<std::uint8_t>(*symbol));
  if (received_.size() == expected()) whole();
}

// A run of nibbles has ended too early.
void ParameterChannel::broken() {
  ignoring_ = false;
  if (received_.empty()) return;
  const bool is_long = received_.front() >= 8;
  received_.clear();
  if (!(is_long ? long_ : short_).there()) nak_ = is_long ? kLongNak : kShortNak;
}

// Nibbles of the request that comes, as far as it says so.
std::size_t ParameterChannel::expected() const {
  constexpr std::size_t kFewest = 6;
  constexpr std::size_t kCheck = 4;
  if (received_.size() < 2) return kFewest;
  const auto header = static_cast<std::uint8_t>(received_[0] << 4U | received_[1]);
  if ((header & kLong) == 0) return (header & kRead) != 0 ? 2 + kCheck : 4 + kCheck;
  const std::size_t offset = (header & kOffset) != 0 ? 4 : 0;
  const std::size_t data = (header & kRead) != 0 ? 0 : std::size_t{2} * data_length(header);
  return 4 + offset + data + kCheck;
}

void ParameterChannel::whole() {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < received_.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(received_[i] << 4U | received_[i + 1]));
  }
  received_.clear();
  ignoring_ = true;
  const bool is_long = (bytes[0] & kLong) != 0;
  Order& order = is_long ? long_ : short_;
  if (order.there() && (order.request == bytes || !good(bytes))) return;
  if (!good(bytes) || (!is_long && !short_exists(bytes[0])) || faults_.nak) {
    nak_ = is_long ? kLongNak : kShortNak;
    return;
  }
  if (faults_.silent) return;
  if (nak_ == (is_long ? kLongNak : kShortNak)) nak_.reset();
  if (sending_ == &order) sending_ = nullptr;
  order = {};
  order.wait = is_long ? config_.long_latency : config_.short_latency;
  const unsigned address = kNibble << 2U | (bytes[0] & kAddress);
  if (!is_long && address <= kStatus7) order.wait = config_.status_latency;
  if (is_long) {
    const Resource* resource = tree_.find((bytes[0] & kHighAddress) << 8U | unsigned{bytes[1]});
    if (resource != nullptr && resource->latency) order.wait = *resource->latency;
  }
  if (faults_.late) order.wait += config_.late;
  order.request = std::move(bytes);
}

bool ParameterChannel::short_exists(std::uint8_t header) const {
  const auto address = static_cast<std::uint8_t>(0x40U | (header & kAddress));
  const bool read = (header & kRead) != 0;
  if (address <= kStatus7 || address == kPing) return true;
  return read ? address == kStrength : address == kMail;
}

// ---- Answers ------------------------------------------------------------------------------------

unsigned ParameterChannel::send() {
  const auto ready = [](const Order& order) { return order.there() && order.wait == 0; };
  const bool inside = config_.short_inside_long || sending_ != &long_;
  if (sending_ == &long_ && inside && ready(short_) && !short_.begun) {
    sending_ = nullptr;  // it goes on behind the short one
    gap_ = true;
    return kIdle;
  }
  if (sending_ == nullptr && nak_) {
    gap_ = true;
    return *std::exchange(nak_, std::nullopt);
  }
  if (sending_ == nullptr && gap_) {
    if (ready(short_)) {
      sending_ = &short_;
    } else if (ready(long_)) {
      sending_ = &long_;
    }
  }
  if (sending_ == nullptr) {
    gap_ = true;
    return kIdle;
  }
  if (!sending_->begun) begin(*sending_, sending_ == &long_);
  return next_nibble(*sending_);
}

unsigned ParameterChannel::next_nibble(Order& order) {
  if (faults_.lost_nibble && order.nibbles == kLostNibble) ++order.nibbles;
  const std::uint8_t byte = order.answer[order.nibbles / 2];
  const unsigned nibble = order.nibbles % 2 == 0 ? byte >> 4U : byte & 0xFU;
  if (++order.nibbles == 2 * order.answer.size()) {
    order = {};
    sending_ = nullptr;
  }
  gap_ = false;
  return nibble;
}

void ParameterChannel::begin(Order& order, bool is_long) {
  order.begun = true;
  order.answer = is_long ? long_answer(order.request) : short_answer(order.request);
  add_check(order.answer);
  if (faults_.wrong_crc) order.answer.back() ^= 1U;
}

void ParameterChannel::done(const Bytes& request) const {
  if (on_done) on_done(std::span(request).first(request.size() - 2));
}

ParameterChannel::Bytes ParameterChannel::short_answer(const Bytes& request) {
  std::uint8_t header = request[0];
  const bool read = (header & kRead) != 0;
  const auto address = static_cast<std::uint8_t>(0x40U | (header & kAddress));
  const std::uint8_t value = registers_.get(address);
  if (faults_.foreign()) {
    if (faults_.foreign_address) header ^= 1U;
    if (faults_.foreign_direction) header ^= kRead;
    Bytes answer{header};
    if (((header & kRead) != 0) != faults_.foreign_length) answer.push_back(value);
    return answer;
  }
  Bytes answer{header};
  if (read) {
    answer.push_back(value);
    if (address == kStrength) registers_.set(address, kBestStrength);
  } else if (address <= kStatus7) {
    registers_.set(address, value & request[1]);
  } else {
    registers_.set(address, request[1]);
  }
  done(request);
  return answer;
}

ParameterChannel::Bytes ParameterChannel::long_answer(const Bytes& request) {
  const std::uint8_t header = request[0];
  LongRequest asked;
  asked.id = (header & kHighAddress) << 8U | unsigned{request[1]};
  asked.read = (header & kRead) != 0;
  asked.indirect = (header & kIndirect) != 0;
  asked.length = data_length(header);
  std::size_t at = 2;
  if ((header & kOffset) != 0) {
    asked.offset = (request[at] & 0x7FU) << 8U | unsigned{request[at + 1]};
    at += 2;
  }
  if (!asked.read) asked.data = std::span(request).subspan(at, asked.length);

  auto first = static_cast<std::uint8_t>(header & ~kOffset);
  std::uint8_t second = request[1];
  if (faults_.foreign()) {
    unsigned length = asked.length;
    if (faults_.foreign_address) second ^= 1U;
    if (faults_.foreign_direction) first ^= kRead;
    if (faults_.foreign_length) length = length == 4 ? 8 : 4;
    Bytes answer{with_length(first, length), second};
    answer.resize(2 + length);
    return answer;
  }
  ResourceAnswer result = tree_.access(asked);
  if (result.error) {
    return {static_cast<std::uint8_t>(with_length(first, 2) | kOffset), second, result.error->low,
            result.error->high};
  }
  if (result.reset) registers_.set(kPing, config_.hardware_version);
  if (!asked.read && config_.write_answer_data) {
    result.data.assign(asked.data.begin(), asked.data.end());
  }
  Bytes answer{with_length(first, static_cast<unsigned>(result.data.size())), second};
  answer.insert(answer.end(), result.data.begin(), result.data.end());
  done(request);
  return answer;
}

}  // namespace mb4::sim::dsl
