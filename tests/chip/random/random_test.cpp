// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Random configurations, slaves, line faults and host actions: the chip against the reference in
// tests/reference. Every second configuration has all protocols, MO and actuators
// (MB4_RANDOM_PROTOCOLS=1: all of them, 0: none). MB4_RANDOM_CONFIGS sets the number of
// configurations (default 500; nightly 10,000 in four parts), MB4_SEED the first seed. A difference
// prints its seed and leaves a scenario with the SPI frames for `mb4sim spi` in the folder
// MB4_FAILURES (default: the temporary folder).
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "tests/chip/random/random_run.hpp"
#include "tests/support/bits.hpp"

namespace {

using mb4test::Difference;
using mb4test::Random;
using mb4test::RandomCase;
using mb4test::RandomCounts;
using mb4test::RandomRun;

std::filesystem::path folder_of(std::uint64_t seed) {
  return mb4test::failure_path("mb4-random-" + std::to_string(seed));
}

// 0: BiSS C sensors only, 1: all protocols, MO and actuators, else by turns.
bool all_protocols(std::uint64_t seed) {
  const std::uint64_t choice = mb4test::number_from("MB4_RANDOM_PROTOCOLS", 2);
  return choice == 2 ? seed % 2 == 1 : choice == 1;
}

TEST(ChipRandom, Configurations_AgreeWithTheReference) {
  const std::uint64_t count = mb4test::number_from("MB4_RANDOM_CONFIGS", 500);
  const std::uint64_t first = mb4test::number_from("MB4_SEED", 1);
  RandomCounts counts;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    Random random(seed);
    const RandomCase random_case = mb4test::make_case(random, all_protocols(seed));
    const auto folder = folder_of(seed);
    RandomRun run(random_case, random, folder);
    try {
      run.run(counts);
    } catch (const Difference& difference) {
      FAIL() << "seed " << seed << ": " << difference.what()
             << "\nrepeat with: " << run.session().save() << "\nor with: MB4_SEED=" << seed
             << " MB4_RANDOM_CONFIGS=1 chip_test --gtest_filter=ChipRandom.*";
    }
    // The registers fit the lines, whatever faults there were.
    for (const mb4::sim::Hint& hint : run.session().simulator().hints()) {
      ADD_FAILURE() << "seed " << seed << ": a hint without a mistake: " << hint.text;
    }
    std::filesystem::remove_all(folder);
  }
  std::printf(
      "%llu configurations, %llu frames, %llu words, %llu faulty words with a CRC, "
      "%llu unnoticed\n",
      static_cast<unsigned long long>(count), static_cast<unsigned long long>(counts.frames),
      static_cast<unsigned long long>(counts.words),
      static_cast<unsigned long long>(counts.faulty_words),
      static_cast<unsigned long long>(counts.undetected));
  static const char* const kNames[] = {"INSTR",        "rate",   "AGSMIN", "GETSENS", "HOLDBANK",
                                       "AGS+HOLDBANK", "SWBANK", "SCDATA", "SVALID"};
  for (std::size_t i = 0; i < counts.actions.size(); ++i) {
    std::printf("%s %llu%s", kNames[i], static_cast<unsigned long long>(counts.actions[i]),
                i + 1 < counts.actions.size() ? ", " : "\n");
    if (count >= 100) {
      EXPECT_GT(counts.actions[i], 0U) << kNames[i];
    }
  }
}

// The files of a difference repeat its run: `mb4sim spi` gets the same answers as the test, byte by
// byte.
TEST(ChipRandom, SavedRuns_AreRepeatedByTheCommand) {
  for (std::uint64_t seed = 1001; seed < 1006; ++seed) {
    Random random(seed);
    const RandomCase random_case = mb4test::make_case(random, all_protocols(seed));
    const auto folder = folder_of(seed);
    RandomRun run(random_case, random, folder);
    RandomCounts counts;
    run.run(counts);
    run.session().save();
    const std::string answers = (folder / "again.txt").string();
    const std::string command = "\"" MB4SIM_COMMAND "\" spi \"" +
                                (folder / "scenario.toml").string() + "\" < \"" +
                                (folder / "frames.spi").string() + "\" > \"" + answers + "\"";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    std::ostringstream text;
    text << std::ifstream(answers).rdbuf();
    ASSERT_GT(run.session().answers().size(), 1000U);
    EXPECT_EQ(text.str(), run.session().answers()) << "seed " << seed;
    std::filesystem::remove_all(folder);
  }
}

}  // namespace
