// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "bridge/bridge_session.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

#include "mb4sim/model_stopped.hpp"

namespace mb4::tool {
namespace {

constexpr std::uint64_t kMaxWaitNs = 1'000'000'000'000;  // 1000 s

// The request cannot be understood; what() is one line.
class Malformed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

std::uint64_t number(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = (value << 8U) | bytes[i];
  return value;
}

void put(std::vector<std::uint8_t>& out, std::uint64_t value, unsigned bytes) {
  for (unsigned i = 0; i < bytes; ++i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

void require_length(std::span<const std::uint8_t> payload, std::size_t length) {
  if (payload.size() != length) {
    throw Malformed(fmt::format("{} bytes instead of {}", payload.size(), length));
  }
}

std::string_view text(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

sim::Pin pin_of(const sim::Simulator& simulator, std::span<const std::uint8_t> name) {
  const auto pin = simulator.pin_by_name(text(name));
  if (!pin) throw RefusedValue("there is no such pin");
  return *pin;
}

// Reads one transfer of request M from the front of `payload` and removes it there.
SpiTransfer take_transfer(std::span<const std::uint8_t>& payload) {
  constexpr std::size_t kDescription = 11;
  constexpr std::uint8_t kCsChange = 1;
  constexpr std::uint8_t kHasData = 2;
  if (payload.size() < kDescription) throw Malformed("a transfer is cut off");
  SpiTransfer transfer;
  transfer.length = number(payload.subspan(0, 2));
  transfer.speed_hz = static_cast<std::uint32_t>(number(payload.subspan(2, 4)));
  transfer.delay_us = static_cast<std::uint16_t>(number(payload.subspan(6, 2)));
  transfer.word_delay_us = payload[8];
  transfer.bits_per_word = payload[9];
  const std::uint8_t flags = payload[10];
  if ((flags & ~(kCsChange | kHasData)) != 0) throw Malformed("unknown flags of a transfer");
  transfer.cs_change = (flags & kCsChange) != 0;
  payload = payload.subspan(kDescription);
  if ((flags & kHasData) != 0) {
    if (payload.size() < transfer.length) throw Malformed("the data of a transfer are cut off");
    transfer.tx = payload.first(transfer.length);
    payload = payload.subspan(transfer.length);
  }
  return transfer;
}

}  // namespace

BridgeChip::BridgeChip(sim::Simulator& simulator, Pace pace)
    : simulator_(simulator),
      pace_(pace),
      bus_(simulator),
      port_(simulator),
      last_answer_(std::chrono::steady_clock::now()),
      pairs_(simulator) {}

void BridgeChip::keep_pace() {
  if (pace_ == Pace::kGaps) simulator_.advance(kRequestGap);
  if (pace_ == Pace::kWall) {
    const auto passed = std::chrono::steady_clock::now() - last_answer_;
    const auto ns = std::chrono::duration_cast<std::chrono::nanoseconds>(passed).count();
    simulator_.advance(static_cast<sim::Time>(std::max<long long>(ns, 0)) * sim::kPsPerNs);
  }
}

SpiPort& BridgeChip::port() {
  if (!simulator_.scenario().host.serial()) {
    throw RefusedValue("the scenario's host is not on SPI");
  }
  return port_;
}

std::vector<std::uint8_t> BridgeSession::feed(std::span<const std::uint8_t> bytes) {
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
  std::vector<std::uint8_t> answers;
  std::size_t done = 0;
  while (waiting_.size() - done >= kHeader) {
    const std::span<const std::uint8_t> rest = std::span(waiting_).subspan(done);
    const std::size_t length = number(rest.subspan(1, 2));
    if (rest.size() < kHeader + length) break;
    std::vector<std::uint8_t> answer;
    Status status = Status::kDone;
    std::string complaint;
    try {
      if (chip_.stopped()) throw sim::ModelStopped(*chip_.stopped());
      execute(static_cast<char>(rest[0]), rest.subspan(kHeader, length), answer);
      if (answer.size() > kMaxPayload) throw RefusedValue("the answer would be too long");
    } catch (const Malformed& error) {
      status = Status::kMalformed;
      complaint = error.what();
    } catch (const RefusedValue& error) {
      status = Status::kRefused;
      complaint = error.what();
    } catch (const sim::ModelStopped& error) {
      chip_.set_stopped(error.what());
      status = Status::kStopped;
      complaint = error.what();
    }
    if (status != Status::kDone) {
      answer.assign(complaint.begin(), complaint.end());
      answer.resize(std::min(answer.size(), kMaxPayload));
    }
    answers.push_back(static_cast<std::uint8_t>(status));
    put(answers, answer.size(), 2);
    answers.insert(answers.end(), answer.begin(), answer.end());
    done += kHeader + length;
    chip_.answered();
  }
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(done));
  return answers;
}

void BridgeSession::close() {
  if (!open_ || chip_.stopped()) return;
  open_ = false;
  try {
    chip_.port().release();
  } catch (const sim::ModelStopped& error) {
    chip_.set_stopped(error.what());
  }
}

void BridgeSession::execute(char request, Payload payload, std::vector<std::uint8_t>& answer) {
  sim::Simulator& simulator = chip_.simulator();
  switch (request) {
    case 'V':
      require_length(payload, 0);
      put(answer, kVersion, 2);
      return;
    case 'W': {
      require_length(payload, 8);
      const std::uint64_t ns = number(payload);
      if (ns > kMaxWaitNs) throw RefusedValue("more than 1000 s");
      simulator.advance(ns * sim::kPsPerNs);
      put(answer, simulator.now() / sim::kPsPerNs, 8);
      return;
    }
    case 'G':
      require_length(payload, 0);
      put(answer, chip_.port().settings().mode, 4);
      put(answer, chip_.port().settings().bits_per_word, 4);
      put(answer, chip_.port().settings().speed_hz, 4);
      return;
    case 'C':
      return set(payload);
    case 'R':
      return read_pin(payload, answer);
    default:
      break;
  }
  switch (request) {
    case 'P':
    case 'S':
    case 'X':
    case 'T':
    case 'M':
      chip_.keep_pace();
      break;
    default:
      throw Malformed(fmt::format("unknown request 0x{:02X}", static_cast<unsigned char>(request)));
  }
  if (request == 'P') return set_pin(payload);
  if (request == 'S') return select(payload);
  if (request == 'X') return bytes(payload, answer);
  if (request == 'M') return message(payload, answer);
  answer.resize(payload.size());
  if (simulator.scenario().host.serial()) {
    const std::uint64_t hz = simulator.scenario().host.sclk_hz;
    simulator.spi().set_timing(sim::SpiTiming::for_frequency(hz));
  }
  chip_.bus().transfer({payload.data(), payload.size()}, {answer.data(), answer.size()});
  open_ = false;
}

void BridgeSession::set_pin(Payload payload) {
  if (payload.size() < 2 || payload[0] > 1) throw Malformed("a level 0 or 1 and a name are needed");
  const sim::Pin pin = pin_of(chip_.simulator(), payload.subspan(1));
  if (!chip_.simulator().can_set(pin)) {
    throw RefusedValue("the pin is driven by chip or simulation");
  }
  chip_.simulator().set_pin(pin, payload[0] == 1);
}

void BridgeSession::read_pin(Payload payload, std::vector<std::uint8_t>& answer) {
  answer.push_back(chip_.simulator().pin(pin_of(chip_.simulator(), payload)) ? 1 : 0);
}

void BridgeSession::select(Payload payload) {
  require_length(payload, 1);
  chip_.port();
  chip_.simulator().spi().select(payload[0] != 0);
  open_ = payload[0] != 0;
}

void BridgeSession::bytes(Payload payload, std::vector<std::uint8_t>& answer) {
  chip_.port();
  sim::SpiHost& host = chip_.simulator().spi();
  host.set_timing(sim::SpiTiming::for_frequency(chip_.simulator().scenario().host.sclk_hz));
  for (const std::uint8_t byte : payload) answer.push_back(host.byte(byte));
}

void BridgeSession::set(Payload payload) {
  require_length(payload, 5);
  const auto value = static_cast<std::uint32_t>(number(payload.subspan(1)));
  switch (payload[0]) {
    case 0:
      return chip_.port().set_mode(value);
    case 1:
      return chip_.port().set_bits_per_word(value);
    case 2:
      return chip_.port().set_speed(value);
    default:
      throw Malformed("unknown setting");
  }
}

void BridgeSession::message(Payload payload, std::vector<std::uint8_t>& answer) {
  std::vector<SpiTransfer> transfers;
  std::size_t length = 0;
  while (!payload.empty()) {
    transfers.push_back(take_transfer(payload));
    length += transfers.back().length;
  }
  if (length > kMaxPayload) throw RefusedValue("the answer would be too long");
  chip_.port().message(transfers, answer);
  open_ = !transfers.empty() && transfers.back().cs_change;
}

}  // namespace mb4::tool
