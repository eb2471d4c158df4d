// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/model/whole_models.hpp"

#include <vector>

namespace mb4::sim {
namespace {

// The objects that tell of models may come before any other of this file.
std::vector<std::string_view>& told_whole() {
  static std::vector<std::string_view> names;
  return names;
}

}  // namespace

WholeModel::WholeModel(std::string_view name) { told_whole().push_back(name); }

std::span<const std::string_view> whole_models() { return told_whole(); }

}  // namespace mb4::sim
