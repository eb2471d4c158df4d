// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A host starts a message by the registers of the byte map, polls EVENT_L up to its end, and goes
// from ROOT down the tree.
#include "masters/dsl/dsl_walk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

#include "dsl_page_regs.hpp"
#include "masters/dsl/dsl_session.hpp"
#include "sim/lines/dsl/dsl_resources.hpp"
#include "sim/masters/dsl_model/dsl_master.hpp"
#include "word_port.hpp"

namespace mb4::tool {
namespace {

namespace at = sim::dsl_model::host_address;
namespace on = sim::dsl_model::host_bit;
using sim::dsl::Resource;
using sim::dsl::ResourceType;
using Bytes = std::vector<std::uint8_t>;

constexpr sim::Time kFrameTime = 11'520 * sim::kPsPerNs;

// Bits of PC_ADD_H.
constexpr unsigned kRead = 0x40;
constexpr unsigned kOffset = 0x20;  // in an answer: an error
constexpr unsigned kIndirect = 0x10;

struct WalkError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The bytes of a master's map.
struct ByteMap {
  std::function<std::uint8_t(unsigned address)> read;
  std::function<void(unsigned address, std::uint8_t data)> write;
};

ByteMap map_of_model(sim::Simulator& simulator) {
  auto& host = simulator.host<sim::dsl_model::LinkHost>("none").model().link().host();
  return {.read = [&host](unsigned address) { return host.read(address); },
          .write = [&host](unsigned address, std::uint8_t data) { host.write(address, data); }};
}

ByteMap map_of_registers(sim::Simulator& simulator) {
  const auto port = std::make_shared<WordPort>(simulator);
  const auto lane = [](unsigned address) { return address % 4; };
  const auto check = [](bool done) {
    if (!done) throw WalkError("AXI: no answer, or an error answer");
  };
  std::uint32_t features = 0;
  check(port->read(dsl::page::kAddrFeatures, features));
  if (dsl::page::MESSAGES_EVENTS::get(features) == 0) {
    throw WalkError("this master sends no messages");
  }
  return {.read =
              [=](unsigned address) {
                std::uint32_t word = 0;
                check(port->read(address - lane(address), word));
                return static_cast<std::uint8_t>(word >> 8 * lane(address));
              },
          .write =
              [=](unsigned address, std::uint8_t data) {
                check(port->write(address - lane(address), std::uint32_t{data} << 8 * lane(address),
                                  static_cast<std::uint8_t>(1U << lane(address))));
              }};
}

std::string_view dsl_type_name(unsigned type) {
  constexpr std::string_view kNames[] = {"node", "void", "bit", "u8",  "u16", "u32",
                                         "u64",  "i8",   "i16", "i32", "i64", "string"};
  constexpr unsigned kStructure = static_cast<unsigned>(ResourceType::kStructure);
  return type < std::size(kNames) ? kNames[type] : type >= kStructure ? "structure" : "?";
}

class Walk {
 public:
  Walk(sim::Simulator& simulator, ByteMap map) : simulator_(simulator), map_(std::move(map)) {}

  void tree(unsigned id, unsigned depth, std::vector<EncoderResource>& list);

 private:
  struct Answer {
    Bytes data;
    std::string error;  // its code; empty: none
  };
  Answer ask(unsigned id, bool indirect, unsigned offset, unsigned length);
  unsigned number(unsigned id, bool indirect, unsigned offset);
  std::string value(const EncoderResource& resource);
  std::string bytes(const EncoderResource& resource);

  sim::Simulator& simulator_;
  ByteMap map_;
  std::set<unsigned> seen_;
};

Walk::Answer Walk::ask(unsigned id, bool indirect, unsigned offset, unsigned length) {
  const unsigned code = length == 8 ? 3 : length / 2;
  const auto byte = [](unsigned value) { return static_cast<std::uint8_t>(value); };
  map_.write(at::kOffH, byte(offset >> 8U));
  map_.write(at::kOffL, byte(offset));
  map_.write(at::kAddH, byte(kRead | (offset != 0 ? kOffset : 0U) | (indirect ? kIndirect : 0U) |
                             code << 2U | id >> 8U));
  map_.write(at::kAddL, byte(id));
  map_.write(at::kEventL, byte(~(unsigned{on::kAns} | on::kFrel)));
  map_.write(at::kCtrl, on::kStart);
  const sim::Time limit = simulator_.now() + simulator_.scenario().host.link_wait;
  std::uint8_t events = 0;
  while (((events = map_.read(at::kEventL)) & on::kFrel) == 0) {
    if (simulator_.now() >= limit) {
      throw WalkError(fmt::format("resource {:03X}h: no answer within {} ms", id,
                                  sim::to_us(simulator_.scenario().host.link_wait) / 1000));
    }
    simulator_.advance(kFrameTime);
  }
  if ((events & on::kAns) != 0) {
    throw WalkError(
        fmt::format("resource {:03X}h: the request was refused, or its answer is wrong", id));
  }
  Answer answer;
  for (unsigned i = 0; i < length; ++i) answer.data.push_back(map_.read(at::kBuffer0 + i));
  if ((map_.read(at::kAddH) & kOffset) != 0) {
    // The higher byte of a code is the one that says what kind it is, in either map.
    const std::uint8_t one = map_.read(at::kBuffer0);
    const std::uint8_t other = map_.read(at::kBuffer0 + 1);
    answer.error = fmt::format("error {:02X}/{:02X}", std::max(one, other), std::min(one, other));
  }
  return answer;
}

unsigned Walk::number(unsigned id, bool indirect, unsigned offset) {
  const Answer answer = ask(id, indirect, offset, 2);
  if (!answer.error.empty()) {
    throw WalkError(fmt::format("resource {:03X}h, offset {}: {}", id, offset, answer.error));
  }
  return unsigned{answer.data[0]} << 8U | answer.data[1];
}

// Text, or the bytes of a structure.
std::string Walk::bytes(const EncoderResource& resource) {
  constexpr unsigned kAtOnce = 8;
  constexpr unsigned kMost = 64;
  const bool text = resource.type == static_cast<unsigned>(ResourceType::kString);
  std::string out = text ? "\"" : "";
  for (unsigned from = 0; from < std::min(resource.size, kMost); from += kAtOnce) {
    const Answer part = ask(resource.id, true, from, kAtOnce);
    if (!part.error.empty()) return part.error;
    for (unsigned i = 0; i < kAtOnce && from + i < resource.size; ++i) {
      const bool print = part.data[i] >= 0x20 && part.data[i] < 0x7F;
      out += text ? std::string(1, print ? static_cast<char>(part.data[i]) : '.')
                  : fmt::format("{}{:02X}", out.empty() ? "" : " ", part.data[i]);
    }
  }
  return out + (text ? "\"" : "") + (resource.size > kMost ? " ..." : "");
}

std::string Walk::value(const EncoderResource& resource) {
  const auto type = static_cast<ResourceType>(resource.type);
  if (type == ResourceType::kVoid) return "";
  const unsigned size = sim::dsl::bytes_of(type);
  if (size == 0) return bytes(resource);
  const Answer answer = ask(resource.id, true, 0, std::max(size, 2U));
  if (!answer.error.empty()) return answer.error;
  std::uint64_t number = 0;
  for (const std::uint8_t byte : answer.data) number = number << 8U | byte;
  if (type < ResourceType::kI8) return fmt::format("{}", number);
  const unsigned above = 64 - 8 * static_cast<unsigned>(answer.data.size());
  return fmt::format("{}", static_cast<std::int64_t>(number << above) >> above);
}

void Walk::tree(unsigned id, unsigned depth, std::vector<EncoderResource>& list) {
  if (!seen_.insert(id).second) return;
  EncoderResource resource;
  resource.id = id;
  resource.depth = depth;
  const Answer name = ask(id, false, 0, 8);
  if (!name.error.empty()) {
    throw WalkError(fmt::format("resource {:03X}h: {}", id, name.error));
  }
  for (const std::uint8_t c : name.data) {
    if (c >= 0x20 && c < 0x7F) resource.name += static_cast<char>(c);
  }
  resource.size = number(id, false, 1);
  resource.read_level = number(id, false, 2);
  resource.write_level = number(id, false, 3);
  resource.timeout_ms = number(id, false, 4);
  resource.type = number(id, false, 5);
  resource.type_name = dsl_type_name(resource.type);
  if (resource.type != static_cast<unsigned>(ResourceType::kNode)) {
    resource.value = value(resource);
    list.push_back(resource);
    return;
  }
  const unsigned children = number(id, true, 0);
  resource.value = fmt::format("{} below", children);
  list.push_back(resource);
  for (unsigned i = 1; i <= children; ++i) tree(number(id, true, i), depth + 1, list);
}

}  // namespace

EncoderTree walk_dsl(const sim::Scenario& scenario) {
  const bool rtl = scenario.master->type == kDslSupport.type;
  const MasterSupport& support = rtl ? kDslSupport : kDslModelSupport;
  const std::unique_ptr<Session> session = support.open(scenario, {});
  EncoderTree found;
  if (found.error = session->configure(); !found.error.empty()) return found;
  try {
    sim::Simulator& simulator = session->simulator();
    Walk walk(simulator, rtl ? map_of_registers(simulator) : map_of_model(simulator));
    walk.tree(sim::dsl::kRootId, 0, found.resources);
  } catch (const WalkError& error) {
    found.error = error.what();
  }
  found.faults = session->simulator().faults();
  return found;
}

}  // namespace mb4::tool
