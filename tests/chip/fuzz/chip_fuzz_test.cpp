// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Fuzz of the whole chip: two lines, all protocols, control communication, EN_MO, force bits, every
// configuration register written at any time, all hosts, NRES, a clock that stops or changes its
// frequency, slaves and lines that fail. In every session
//   * no assertion in the RTL fails and no pulse at MA is short (the simulator's guard),
//   * every instruction and access ends, but for the waits that are counted, which BREAK ends,
//   * a word shown as valid is one that its slave has sent, other than a CRC alias,
//   * SCDATA and RDATA are read back behind their writes (decision 36),
//   * after configuration, BREAK and INIT a frame works,
//   * INIT behind a BREAK in a frame or in the slaves' timeout measures the same line delays.
// The sessions are split into parts. MB4_CHIP_FUZZ_SESSIONS: sessions of all parts (default 1000),
// MB4_SEED: seed of the first, MB4_CHIP_FUZZ_SECONDS: instead of a number, for each part. A failure
// prints its seed and leaves a scenario and a script for `mb4sim spi` in the folder MB4_FAILURES.
// MB4_CHIP_FUZZ_COVER: folder that takes the functional coverage of each part (default: none).
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "mb4sim/model_stopped.hpp"
#include "sim/masters/mb4/functional_coverage.hpp"
#include "tests/chip/fuzz/chip_fuzz_run.hpp"
#include "tests/support/bits.hpp"

namespace {

using mb4test::FuzzCounts;

constexpr unsigned kParts = 8;
constexpr unsigned kShown = 5;  // failures of one kind that are printed in full

class ChipFuzz : public testing::TestWithParam<unsigned> {};

// The rule that a session broke; empty: none.
std::string run_session(std::uint64_t seed, FuzzCounts& counts, std::string& text,
                        mb4::sim::FunctionalCoverage* coverage) {
  mb4test::Random random(seed);
  const mb4test::FuzzChip chip = mb4test::make_fuzz_chip(random, seed);
  const auto folder = mb4test::failure_path("mb4-chip-fuzz-" + std::to_string(seed));
  mb4test::FuzzRun run(chip, random, folder);
  if (coverage != nullptr) {
    coverage->restart();
    run.host().simulator().set_observer(coverage);
  }
  std::string rule;
  try {
    run.run();
  } catch (const mb4test::FuzzFailure& failure) {
    rule = failure.rule();
    text = failure.what();
  } catch (const mb4::sim::ModelStopped& stopped) {
    text = stopped.what();
    rule = text.substr(0, 2) == "MA" ? "short MA pulse" : "assertion";
  }
  counts.add(run.counts());
  counts.clocks += run.host().clocks();
  if (rule.empty()) {
    std::filesystem::remove_all(folder);
  } else {
    text += "\nrepeat with: " + run.host().session().save() +
            "\nor with: MB4_SEED=" + std::to_string(seed) +
            " MB4_CHIP_FUZZ_SESSIONS=1 chip_fuzz_test --gtest_filter=*ChipFuzz.*/0";
  }
  return rule;
}

TEST_P(ChipFuzz, AnySession_EndsAndRecovers) {
  const std::uint64_t all = mb4test::number_from("MB4_CHIP_FUZZ_SESSIONS", 1000);
  const std::uint64_t seconds = mb4test::number_from("MB4_CHIP_FUZZ_SECONDS", 0);
  const std::uint64_t seed_of_all = mb4test::number_from("MB4_SEED", 1);
  const std::uint64_t share = (all + kParts - 1) / kParts;
  const std::uint64_t first = seed_of_all + GetParam() * share;
  const std::uint64_t end = std::min(first + share, seed_of_all + all);
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const char* cover = std::getenv("MB4_CHIP_FUZZ_COVER");
  mb4::sim::FunctionalCoverage coverage;
  FuzzCounts counts;
  std::map<std::string, unsigned> failures;
  for (std::uint64_t seed = first;
       seconds != 0 ? elapsed() < static_cast<double>(seconds) : seed < end; ++seed) {
    std::string text;
    const std::string rule =
        run_session(seed, counts, text, cover != nullptr ? &coverage : nullptr);
    if (rule.empty()) continue;
    if (++failures[rule] <= kShown) ADD_FAILURE() << "seed " << seed << ": " << text;
  }
  std::printf("sessions %llu from seed %llu, %.1f million clocks, %.1f s\n",
              static_cast<unsigned long long>(counts.number),
              static_cast<unsigned long long>(first), static_cast<double>(counts.clocks) * 1e-6,
              elapsed());
  for (unsigned what = 0; what < FuzzCounts::kWhats; ++what) {
    std::printf("%8llu in %6llu sessions  %s\n",
                static_cast<unsigned long long>(counts.total[what]),
                static_cast<unsigned long long>(counts.sessions[what]), FuzzCounts::name(what));
    // Words that the test cannot judge are no aim.
    if (what == FuzzCounts::kAliasesUnclear) continue;
    // Only longer runs reach rare events.
    if (counts.number >= 5000 || (counts.number >= 200 && FuzzCounts::is_common(what))) {
      EXPECT_GT(counts.total[what], 0U) << FuzzCounts::name(what);
    }
  }
  if (cover != nullptr) {
    std::filesystem::create_directories(cover);
    const auto path = std::filesystem::path(cover) / (std::to_string(GetParam()) + ".txt");
    EXPECT_TRUE(std::ofstream(path) << coverage.text()) << path;
  }
  for (const auto& [rule, number] : failures) {
    std::printf("FAILED: %6u sessions  %s\n", number, rule.c_str());
  }
}

// The files of a failure repeat its session: `mb4sim spi` gets the same answers as the test, byte
// by byte.
TEST(ChipFuzzScript, SavedSessions_AreRepeatedByTheCommand) {
  const auto folder = mb4test::failure_path("mb4-chip-fuzz-repeated");
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    mb4test::Random random(seed);
    const mb4test::FuzzChip chip = mb4test::make_fuzz_chip(random, seed);
    mb4test::FuzzRun run(chip, random, folder);
    try {
      run.run();
    } catch (const mb4test::FuzzFailure&) {
      // A session that fails has a script too.
    }
    run.host().session().save();
    const std::string answers = (folder / "again.txt").string();
    const std::string command = "\"" MB4SIM_COMMAND "\" spi \"" +
                                (folder / "scenario.toml").string() + "\" < \"" +
                                (folder / "frames.spi").string() + "\" > \"" + answers +
                                "\" 2> \"" + (folder / "messages.txt").string() + "\"";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    std::ostringstream text;
    text << std::ifstream(answers).rdbuf();
    ASSERT_GT(run.host().session().answers().size(), 500U);
    EXPECT_EQ(text.str(), run.host().session().answers()) << "seed " << seed;
  }
  std::filesystem::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(Parts, ChipFuzz, testing::Range(0U, kParts));

}  // namespace
