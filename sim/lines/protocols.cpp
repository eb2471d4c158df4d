// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/protocols.hpp"

#include <algorithm>
#include <iterator>

#include "sim/lines/biss/biss_protocols.hpp"
#ifdef MB4SIM_LINES_DSL
#include "sim/lines/dsl/dsl_protocol.hpp"
#endif
#include "sim/lines/replay/replay_protocol.hpp"
#include "sim/lines/ssi/ssi_protocol.hpp"

namespace mb4::sim {

namespace {

// The protocols of this library, and those that the program has added.
std::vector<const Protocol*>& list() {
  static std::vector<const Protocol*> all{
      &kBissCProtocol, &kReplayProtocol, &kBissBProtocol, &kSsiProtocol,
#ifdef MB4SIM_LINES_DSL
      &kDslProtocol,
#endif
  };
  return all;
}

}  // namespace

std::span<const Protocol* const> protocols() { return list(); }

void add_protocol(const Protocol& protocol) { list().push_back(&protocol); }

std::span<const Preset> presets() {
  static const std::vector<Preset> list = [] {
    std::vector<Preset> all;
    for (const Protocol* protocol : protocols()) {
      if (protocol->presets == nullptr) continue;
      std::vector<Preset> own = protocol->presets();
      std::move(own.begin(), own.end(), std::back_inserter(all));
    }
    return all;
  }();
  return list;
}

const Preset* preset_by_name(std::string_view name) {
  const auto all = presets();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Preset& p) { return p.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace mb4::sim
