// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "text_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "mb4sim/scenario.hpp"

namespace mb4::sim {

std::string read_text_file(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw ScenarioError(path + ": cannot read: it is a directory");
  }
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (!in || (in.peek() != std::ifstream::traits_type::eof() && !(text << in.rdbuf()))) {
    throw ScenarioError(path + ": cannot read: " + std::strerror(errno != 0 ? errno : EIO));
  }
  return text.str();
}

std::string beside(const std::string& scenario, const std::string& file) {
  const std::filesystem::path path(file);
  return path.is_absolute() ? file
                            : (std::filesystem::path(scenario).parent_path() / path).string();
}

}  // namespace mb4::sim
