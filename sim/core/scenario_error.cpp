// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/core/scenario_error.hpp"

namespace mb4::sim {

SourcePos TableSource::of(std::string_view key) const {
  const auto found = keys.find(key);
  return found == keys.end() ? table : found->second;
}

ScenarioError::ScenarioError(const std::string& file, const SourcePos& where, std::string_view key,
                             const std::string& message)
    : ScenarioError(file + ":" +
                    (where.line == 0
                         ? ""
                         : std::to_string(where.line) + ":" + std::to_string(where.column) + ":") +
                    " key '" + std::string(key) + "': " + message +
                    (where.table.empty() ? "" : " (in " + where.table + ")")) {}

std::string left_out(std::string_view name, std::string_view option) {
  return "this build has no \"" + std::string(name) + "\"; `cmake --preset default " +
         std::string(option) + "` and a new build bring it";
}

}  // namespace mb4::sim
