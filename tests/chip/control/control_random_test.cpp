// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Random register accesses and commands with busy slaves and faults, written registers read back
// (pages 27..29, 34, 35). The chip must not report an access as good that was not done, except at
// the weak places of docs/choices.md, which the model predicts. MB4_CONTROL_ACCESSES sets the
// number of accesses (default 500; nightly 10,000), MB4_SEED the first seed. A failure prints the
// seed and leaves scenario and accesses in the folder MB4_FAILURES (default: the temporary folder).
#include "tests/chip/control/control_random.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tests/support/bits.hpp"

namespace {

using mb4test::ControlFault;
using mb4test::ControlRun;
using mb4test::ControlTally;

constexpr unsigned kAccessesOfOneChip = 40;

// Scenario and accesses up to the failure, in one file.
std::string save(const ControlRun& run, std::uint64_t seed) {
  const auto path = mb4test::failure_path("mb4-control-" + std::to_string(seed) + ".toml");
  std::filesystem::create_directories(path.parent_path());
  std::ofstream out(path);
  std::string line;
  for (const char c : run.log()) line += c == '\n' ? std::string("\n# ") : std::string(1, c);
  out << run.scenario() << "\n# " << line << "\n";
  return path.string();
}

TEST(ChipControlRandom, WrittenAndReadBack_NothingIsGoodThatIsNot) {
  const std::uint64_t accesses = mb4test::number_from("MB4_CONTROL_ACCESSES", 500);
  const std::uint64_t first = mb4test::number_from("MB4_SEED", 1);
  ControlTally tally;
  std::uint64_t done = 0;
  for (std::uint64_t seed = first; done < accesses; ++seed) {
    ControlRun run(seed);
    try {
      for (unsigned i = 0; i < kAccessesOfOneChip && done < accesses; ++i, ++done) run.step(tally);
    } catch (const mb4test::WrongReport& report) {
      FAIL() << "seed " << seed << ": " << report.what() << "\n"
             << run.scenario() << run.log() << "saved as " << save(run, seed)
             << "\nrepeat with: MB4_SEED=" << seed << " MB4_CONTROL_ACCESSES=" << kAccessesOfOneChip
             << " chip_test --gtest_filter=ChipControlRandom.*";
    }
  }
  const auto print = [](const char* what, std::uint64_t count) {
    std::printf("%s %llu; ", what, static_cast<unsigned long long>(count));
  };
  print("accesses", done);
  print("reads", tally.reads);
  print("writes", tally.writes);
  print("commands", tally.commands);
  print("registers", tally.bytes);
  print("nREGERR", tally.reg_errors);
  print("nDELAYERR", tally.delay_errors);
  print("not there", tally.missing);
  print("part of a byte written", tally.cut_writes);
  std::printf("\nfaults: ");
  static const char* const kNames[] = {"none", "CDM",  "CDM of one slave", "CDS",
                                       "zero", "data", "silent",           "wrong CRC"};
  for (unsigned i = 0; i < ControlFault::kKinds; ++i) {
    print(kNames[i], tally.faults[i]);
    if (done >= 500) {
      EXPECT_GT(tally.faults[i], 0U) << kNames[i];
    }
  }
  std::printf("\nweak places: ");
  print("lost start bit of a write", tally.lost_start);
  print("early start bit of a write", tally.early_start);
  print("lost EX", tally.lost_execution);
  print("lost broadcast", tally.lost_broadcast);
  print("false acknowledge", tally.false_acknowledge);
  print("rest of a byte read as zeros", tally.cut_reads);
  std::printf("\n");
  if (done >= 5000) {
    EXPECT_GT(tally.lost_start, 0U);
    EXPECT_GT(tally.early_start, 0U);
    EXPECT_GT(tally.lost_execution, 0U);
    EXPECT_GT(tally.lost_broadcast, 0U);
    EXPECT_GT(tally.cut_reads, 0U);
  }
}

}  // namespace
