// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Files that a scenario names.
#ifndef MB4SIM_TEXT_FILE_HPP_
#define MB4SIM_TEXT_FILE_HPP_

#include <cstddef>
#include <string>

namespace mb4::sim {

// Returns the whole file, up to `mib` MiB. Throws ScenarioError "path: cannot read: reason".
std::string read_text_file(const std::string& path, std::size_t mib = 16);

// Returns the path of `file`, which scenario `scenario` names relative to its own folder.
std::string beside(const std::string& scenario, const std::string& file);

}  // namespace mb4::sim

#endif  // MB4SIM_TEXT_FILE_HPP_
