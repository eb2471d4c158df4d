// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/model/whole_models.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

namespace sim = mb4::sim;

// Told as the program starts, as the files of models do.
const sim::WholeModel kPlanted("a planted model");

TEST(WholeModels, OneThatTellsOfItself_IsListed) {
  const auto names = sim::whole_models();
  EXPECT_EQ(std::count(names.begin(), names.end(), "a planted model"), 1);
}

}  // namespace
