// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/core/text_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "sim/core/scenario_error.hpp"

namespace mb4::sim {

std::string read_text_file(const std::string& path, std::size_t mib) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw ScenarioError(path + ": cannot read: it is a directory");
  }
  const std::size_t limit = mib << 20U;  // a device may have no end
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  std::string text;
  char part[65536];
  while (in && text.size() <= limit) {
    in.read(part, sizeof part);
    text.append(part, static_cast<std::size_t>(in.gcount()));
  }
  if (text.size() > limit) {
    throw ScenarioError(path + ": cannot read: more than " + std::to_string(mib) + " MiB");
  }
  if (!in.eof()) {
    throw ScenarioError(path + ": cannot read: " + std::strerror(errno != 0 ? errno : EIO));
  }
  return text;
}

std::string beside(const std::string& scenario, const std::string& file) {
  const std::filesystem::path path(file);
  return path.is_absolute() ? file
                            : (std::filesystem::path(scenario).parent_path() / path).string();
}

}  // namespace mb4::sim
