// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "masters/dsl/dsl_talk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "dsl_page_regs.hpp"
#include "sim/hosts/word_host.hpp"
#include "sim/masters/dsl_model/dsl_master.hpp"
#include "sim/scenario/scenario.hpp"
#include "word_port.hpp"

namespace mb4::tool {
namespace {

namespace at = sim::dsl_model::host_address;
namespace on = sim::dsl_model::host_bit;

constexpr sim::Time kFrameTime = 11'520 * sim::kPsPerNs;

// Bits of PC_ADD_H.
constexpr unsigned kRead = 0x40;
constexpr unsigned kOffset = 0x20;  // in an answer: an error
constexpr unsigned kIndirect = 0x10;

std::uint8_t byte(unsigned value) { return static_cast<std::uint8_t>(value); }

DslBytes bytes_of_model(sim::Simulator& simulator) {
  auto& host = simulator.host<sim::dsl_model::LinkHost>("none").model().link().host();
  return {.read = [&host](unsigned address) { return host.read(address); },
          .write = [&host](unsigned address, std::uint8_t data) { host.write(address, data); }};
}

DslBytes bytes_of_registers(sim::Simulator& simulator) {
  const auto port = std::make_shared<WordPort>(simulator);
  const auto lane = [](unsigned address) { return address % 4; };
  const auto check = [](bool done) {
    if (!done) throw DslTalkError("AXI: no answer, or an error answer");
  };
  std::uint32_t features = 0;
  check(port->read(dsl::page::kAddrFeatures, features));
  if (dsl::page::MESSAGES_EVENTS::get(features) == 0) {
    throw DslTalkError("this master sends no messages");
  }
  return {.sdk_map = dsl::page::SDK_MAP::get(features) != 0,
          .read =
              [=](unsigned address) {
                std::uint32_t word = 0;
                check(port->read(address - lane(address), word));
                return byte(word >> 8 * lane(address));
              },
          .write =
              [=](unsigned address, std::uint8_t data) {
                const sim::ByteWrite one(address, data);
                check(port->write(one.address, one.data, one.strobe));
              }};
}

}  // namespace

DslTalk::DslTalk(sim::Simulator& simulator)
    : simulator_(simulator),
      bytes_(simulator.scenario().master->type == "dsl" ? bytes_of_registers(simulator)
                                                        : bytes_of_model(simulator)) {}

// Returns the events that have come with this bit.
std::uint8_t DslTalk::wait(unsigned address, std::uint8_t bit, const std::string& what) {
  const sim::Time patience = simulator_.scenario().host.link_wait;
  const sim::Time limit = simulator_.now() + patience;
  while (true) {
    const std::uint8_t events = bytes_.read(address);
    if ((events & bit) != 0) return events;
    if (simulator_.now() >= limit) {
      throw DslTalkError(
          fmt::format("{}: no answer within {} ms", what, sim::to_us(patience) / 1000));
    }
    simulator_.advance(kFrameTime);
  }
}

void DslTalk::start_short(std::uint8_t control, const std::string& what) {
  bytes_.write(at::kControl, control);
  const bool safe = bytes_.sdk_map;
  wait(safe ? at::kEventS : at::kEventL, safe ? on::kSafeFres : on::kFres, what);
}

std::uint8_t DslTalk::read(std::uint8_t address) {
  constexpr unsigned kReads = 0x80;
  start_short(byte(kReads | address), fmt::format("register {:02X}h", address));
  return bytes_.read(bytes_.sdk_map ? at::kSafeData : at::kData);
}

void DslTalk::write(std::uint8_t address, std::uint8_t data) {
  bytes_.write(bytes_.sdk_map ? at::kSafeData : at::kData, data);
  start_short(address, fmt::format("register {:02X}h", address));
}

DslTalk::Answer DslTalk::ask(unsigned id, bool indirect, unsigned offset, unsigned length) {
  const std::string what = fmt::format("resource {:03X}h", id);
  const unsigned code = length == 8 ? 3 : length / 2;
  bytes_.write(at::kOffH, byte(offset >> 8U));
  bytes_.write(at::kOffL, byte(offset));
  bytes_.write(at::kAddH, byte(kRead | (offset != 0 ? kOffset : 0U) | (indirect ? kIndirect : 0U) |
                               code << 2U | id >> 8U));
  bytes_.write(at::kAddL, byte(id));
  bytes_.write(at::kEventL, byte(~(unsigned{on::kAns} | on::kFrel)));
  bytes_.write(at::kCtrl, on::kStart);
  if ((wait(at::kEventL, on::kFrel, what) & on::kAns) != 0) {
    throw DslTalkError(what + ": the request was refused, or its answer is wrong");
  }
  Answer answer;
  for (unsigned i = 0; i < length; ++i) answer.data.push_back(bytes_.read(at::kBuffer0 + i));
  if ((bytes_.read(at::kAddH) & kOffset) != 0) {
    // The higher byte of a code is the one that says what kind it is, in either map.
    const std::uint8_t one = bytes_.read(at::kBuffer0);
    const std::uint8_t other = bytes_.read(at::kBuffer0 + 1);
    answer.error = fmt::format("error {:02X}/{:02X}", std::max(one, other), std::min(one, other));
  }
  return answer;
}

}  // namespace mb4::tool
