// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "masters/dsl/dsl_walk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <set>
#include <string>

#include "masters/dsl/dsl_session.hpp"
#include "masters/dsl/dsl_talk.hpp"
#include "sim/lines/dsl/dsl_resources.hpp"

namespace mb4::tool {
namespace {

using sim::dsl::Resource;
using sim::dsl::ResourceType;

std::string_view dsl_type_name(unsigned type) {
  constexpr std::string_view kNames[] = {"node", "void", "bit", "u8",  "u16", "u32",
                                         "u64",  "i8",   "i16", "i32", "i64", "string"};
  constexpr unsigned kStructure = static_cast<unsigned>(ResourceType::kStructure);
  return type < std::size(kNames) ? kNames[type] : type >= kStructure ? "structure" : "?";
}

class Walk {
 public:
  explicit Walk(sim::Simulator& simulator) : talk_(simulator) {}

  void tree(unsigned id, unsigned depth, std::vector<EncoderResource>& list);

 private:
  unsigned number(unsigned id, bool indirect, unsigned offset);
  std::string value(const EncoderResource& resource);
  std::string bytes(const EncoderResource& resource);

  DslTalk talk_;
  std::set<unsigned> seen_;
};

unsigned Walk::number(unsigned id, bool indirect, unsigned offset) {
  const DslTalk::Answer answer = talk_.ask(id, indirect, offset, 2);
  if (!answer.error.empty()) {
    throw DslTalkError(fmt::format("resource {:03X}h, offset {}: {}", id, offset, answer.error));
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
    const DslTalk::Answer part = talk_.ask(resource.id, true, from, kAtOnce);
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
  const DslTalk::Answer answer = talk_.ask(resource.id, true, 0, std::max(size, 2U));
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
  const DslTalk::Answer name = talk_.ask(id, false, 0, 8);
  if (!name.error.empty()) {
    throw DslTalkError(fmt::format("resource {:03X}h: {}", id, name.error));
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
    Walk walk(session->simulator());
    walk.tree(sim::dsl::kRootId, 0, found.resources);
  } catch (const DslTalkError& error) {
    found.error = error.what();
  }
  found.faults = session->simulator().faults();
  return found;
}

}  // namespace mb4::tool
