// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Files that a scenario names.
#ifndef MB4SIM_SRC_TEXT_FILE_HPP_
#define MB4SIM_SRC_TEXT_FILE_HPP_

#include <string>

namespace mb4::sim {

// The whole file. Throws ScenarioError "path: cannot read: reason".
std::string read_text_file(const std::string& path);

// `file` as named inside scenario `scenario`: relative to the scenario's folder.
std::string beside(const std::string& scenario, const std::string& file);

}  // namespace mb4::sim

#endif  // MB4SIM_SRC_TEXT_FILE_HPP_
