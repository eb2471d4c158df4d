// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Wrong bits at random, with fixed seeds: what a user must never see, and how often POS is set.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <deque>
#include <string>

#include "tests/unit/dsl/dsl_bench.hpp"

namespace {

using namespace mb4::sim;
using namespace mb4::sim::dsl_test;
using dsl_model::CodeCheck;
using dsl_model::QualityRules;

struct Counts {
  std::uint64_t frames = 0;
  std::uint64_t lost = 0;         // with POS
  std::uint64_t wrong = 0;        // fast positions without POS
  std::uint64_t unexplained = 0;  // ... that no word with two wrong bits that passed explains
  std::uint64_t longest = 0;      // ... in a row
  std::uint64_t wrong_safe = 0;
  std::uint64_t safe = 0;  // good ones
  std::uint64_t restarts = 0;
  std::uint64_t illegal = 0;
  std::uint64_t all = 0;  // with those of the training
  double lost_percent_of_all() const {
    return 100.0 * static_cast<double>(lost) / static_cast<double>(all);
  }
  double lost_percent() const {
    return 100.0 * static_cast<double>(lost) / static_cast<double>(frames);
  }
};

// Wrong bits of the acceleration's two words.
unsigned wrong_bits(std::uint64_t inverted) {
  return static_cast<unsigned>(std::popcount(inverted >> 11U & 0xFFFFFU));
}

constexpr std::uint64_t kLongest = 24;  // frames with a wrong position in a row

Counts run(double errors, CodeCheck check, bool recover, std::uint64_t frames,
           QualityRules rules = QualityRules::kSick, bool master = false) {
  BenchSetup setup;
  setup.rules.check = check;
  setup.rules.recover = recover;
  setup.rules.quality = rules;
  (master ? setup.cable.master_errors : setup.cable.answer_errors) = errors;
  setup.metres(40);
  setup.seed = 2026;
  Bench bench(setup);
  bench.misreads = master;
  RandomMotion motion(bench.encoder(), 99);
  Counts counts;
  std::uint64_t row = 0;
  // The last word with two wrong bits and more that was taken. It explains what is wrong up to the
  // safe position that finds it.
  std::uint64_t passed = 0;
  std::uint64_t before = 0;
  std::uint64_t safe = 0;
  std::uint64_t place_0 = 0;  // its number
  bench.on_frame = [&](const LinkFrame& frame) {
    const std::uint64_t truth = *bench.encoder().sent_word();
    if (frame.number == 0) {
      before = truth;
      passed = 0;
      return;
    }
    ++counts.frames;
    if (frame.acceleration_good && wrong_bits(bench.encoder().inverted()) >= 2) {
      passed = frame.number;
    }
    if (frame.lost) {
      ++counts.lost;
      row = 0;
    } else if (frame.position != truth) {
      ++counts.wrong;
      counts.longest = std::max(counts.longest, ++row);
      if (passed == 0 || frame.number - passed >= kLongest) ++counts.unexplained;
    } else {
      row = 0;
    }
    if (frame.place == 0) {
      safe = before;
      place_0 = frame.number;
    }
    if (frame.safe_new && frame.safe1.valid) {
      ++counts.safe;
      if (frame.number - place_0 == 7 && (frame.safe1.position & 0xFFFFFFFF) != safe)
        ++counts.wrong_safe;
    }
    before = truth;
  };
  EXPECT_TRUE(bench.run_frames(frames));
  counts.restarts = bench.link().restarts();
  counts.all = bench.encoder().begun();
  counts.illegal = bench.link().illegal_words();
  std::printf(
      "%s errors %g, %s code check, %s: %llu frames, POS %.2f %% (%.2f %% with "
      "the training), wrong fast %llu (at most %llu in "
      "a "
      "row, %llu unexplained), safe %llu, wrong safe %llu, restarts %llu, illegal words %llu\n",
      master ? "master" : "answer", errors, check == CodeCheck::kStrict ? "strict" : "published",
      recover ? "recovery" : "four phases", static_cast<unsigned long long>(counts.frames),
      counts.lost_percent(), counts.lost_percent_of_all(),
      static_cast<unsigned long long>(counts.wrong),
      static_cast<unsigned long long>(counts.longest),
      static_cast<unsigned long long>(counts.unexplained),
      static_cast<unsigned long long>(counts.safe),
      static_cast<unsigned long long>(counts.wrong_safe),
      static_cast<unsigned long long>(counts.restarts),
      static_cast<unsigned long long>(counts.illegal));
  return counts;
}

TEST(DslNoise, OneErrorIn10000Bits_ShowsNothingWrong) {
  // 20,000 frames have about 40 losses of 8 to 15 frames: their number alone is worth 0.4 %.
  const std::uint64_t frames = std::max<std::uint64_t>(long_run(), 200'000);
  const Counts counts = run(1e-4, CodeCheck::kStrict, true, frames);
  EXPECT_EQ(counts.wrong_safe, 0U);
  EXPECT_GT(counts.safe, counts.frames / 10);
  EXPECT_LE(counts.lost_percent(), 3.0);
  EXPECT_GT(counts.lost_percent(), 1.0);  // the noise is there
  EXPECT_EQ(counts.unexplained, 0U);
}

TEST(DslNoise, OneErrorIn1000Bits_ShowsNothingWrongForLong) {
  const Counts counts = run(1e-3, CodeCheck::kStrict, true, long_run());
  EXPECT_EQ(counts.wrong_safe, 0U);
  EXPECT_EQ(counts.unexplained, 0U);
  EXPECT_LE(counts.longest, kLongest);
  EXPECT_LE(counts.lost_percent(), 55);
  // The known figure has the rules of the firmware, and the frames of the training count.
  const Counts firmware = run(1e-3, CodeCheck::kStrict, true, long_run(), QualityRules::kFirmware);
  EXPECT_NEAR(firmware.lost_percent_of_all(), 39, 4);
  EXPECT_EQ(firmware.wrong_safe, 0U);
  EXPECT_EQ(firmware.unexplained, 0U);
}

// What the published check and the published alignment give, for comparison.
TEST(DslNoise, PublishedChecks_AreCounted) {
  const Counts low = run(1e-4, CodeCheck::kPublished, true, long_run());
  EXPECT_EQ(low.wrong_safe, 0U);
  const Counts high = run(1e-3, CodeCheck::kPublished, true, long_run());
  EXPECT_LE(high.longest, kLongest);
  EXPECT_EQ(high.wrong_safe, 0U);
  // Four phases after each loss: about 13 % of the time.
  const Counts phases = run(1e-4, CodeCheck::kPublished, false, long_run());
  EXPECT_NEAR(phases.lost_percent(), 13, 2.5);
  EXPECT_EQ(phases.wrong_safe, 0U);
}

// Each answer is noisy, that to the ID request too. The link never gets past the wait for VSYNC.
TEST(DslNoise, WrongBitsOfTheIdentity_RestartTheLink) {
  BenchSetup setup;
  setup.rules.vsync_limit = 1;
  setup.cable.answer_errors = 1e-3;
  Bench bench(setup);
  std::uint64_t asked = 0;
  std::uint64_t broken = 0;
  bench.on_frame = [&](const LinkFrame& frame) {
    if (frame.state != LinkState::kIdRequest) return;
    ++asked;
    if (frame.restart == Restart::kIdentity) ++broken;
  };
  while (asked < 500) ASSERT_TRUE(bench.next_frame());
  // 40 of the 61 bits stand twice, a nibble more in the pipeline; not each wrong word is another
  // byte.
  const double chance = 100.0 * static_cast<double>(broken) / static_cast<double>(asked);
  EXPECT_GT(chance, 2.5);
  EXPECT_LT(chance, 7.5);
}

// Wrong bits on the way to the encoder: frames without an answer, and symbols that are none.
TEST(DslNoise, WrongBitsOfTheMaster_LoseFramesOnly) {
  const Counts counts = run(1e-4, CodeCheck::kStrict, true, long_run(), QualityRules::kSick, true);
  EXPECT_EQ(counts.wrong, 0U);
  EXPECT_EQ(counts.wrong_safe, 0U);
}

}  // namespace
