// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Random configurations of smaller cores against the reference, as ChipRandom does it for the whole
// chip: BiSS C sensors, host writes to all data channels, banks, automatic frames, line faults.
// MB4_RANDOM_CONFIGS is their number (default 40), MB4_SEED the first seed.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/chip/features/core.hpp"
#include "tests/chip/random/random_run.hpp"
#include "tests/support/bits.hpp"

namespace {

using mb4test::Core;

class FeaturesRandom : public testing::TestWithParam<Core> {};

TEST_P(FeaturesRandom, Configurations_AgreeWithTheReference) {
  const Core& core = GetParam();
  const std::uint64_t count = mb4test::number_from("MB4_RANDOM_CONFIGS", 40);
  const std::uint64_t first = mb4test::number_from("MB4_SEED", 1);
  mb4test::RandomCounts counts;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    mb4test::Random random(seed);
    const auto random_case =
        mb4test::make_case(random, false, {core.name, core.lines, core.slaves, core.free_crc});
    const auto folder =
        mb4test::failure_path("mb4-" + std::string(core.name) + "-" + std::to_string(seed));
    mb4test::RandomRun run(random_case, random, folder);
    try {
      run.run(counts);
    } catch (const mb4test::Difference& difference) {
      FAIL() << core.name << ", seed " << seed << ": " << difference.what()
             << "\nrepeat with: " << run.session().save() << "\nor with: MB4_SEED=" << seed
             << " MB4_RANDOM_CONFIGS=1 features_test --gtest_filter=*FeaturesRandom.*";
    }
    for (const mb4::sim::Hint& hint : run.session().simulator().hints()) {
      ADD_FAILURE() << core.name << ", seed " << seed
                    << ": a hint without a mistake: " << hint.text;
    }
    std::filesystem::remove_all(folder);
  }
  EXPECT_GT(counts.frames, 5 * count);
  EXPECT_GT(counts.words, 5 * count);
}

INSTANTIATE_TEST_SUITE_P(Cores, FeaturesRandom,
                         testing::ValuesIn(mb4test::built_cores([](const Core& core) {
                           return core.banks == 2;  // as the reference has
                         })),
                         mb4test::core_name);

}  // namespace
