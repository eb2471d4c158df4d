// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Position and speed: exact in every frame without errors, and after words that were lost.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/lines/dsl/dsl_faults.hpp"
#include "sim/masters/dsl_model/motion.hpp"
#include "tests/unit/dsl/dsl_bench.hpp"

namespace {

using namespace mb4::sim;
using namespace mb4::sim::dsl_test;

std::uint64_t low(std::uint64_t value, unsigned bits) {
  return value & (~std::uint64_t{0} >> (64 - bits));
}

// Counts what must not happen in a run without errors.
struct Watch {
  explicit Watch(Bench& bench) : bench_(bench) {
    bench.on_frame = [this](const LinkFrame& frame) { look(frame); };
  }
  void look(const LinkFrame& frame) {
    const std::uint64_t truth = *bench_.encoder().sent_word();
    if (frame.number == 0) {
      before_ = truth;
      return;
    }
    if (!frame.lost && frame.position != truth) ++wrong;
    if (frame.number >= 33 && frame.lost) ++late;
    if (frame.number >= 33 && frame.quality != 15) ++poor;
    if (!frame.acceleration_good) ++missing;
    const dsl_model::AnswerWords& words = frame.words;
    for (const auto* word : {&words.vertical, &words.parameter, &words.pipeline,
                             &words.acceleration_high, &words.acceleration_low, &words.secondary}) {
      if (word->error) ++errors;
    }
    // The safe position is that of the sample before the vertical frame.
    if (frame.place == 0) safe_ = before_;
    if (frame.safe_new) {
      // The whole field of 40 bits: the second safe position is the inverse of the first.
      const DslSlaveConfig& encoder = bench_.encoder().config();
      const unsigned above = 64 - encoder.data_bits;
      const auto wide = static_cast<std::int64_t>(safe_ << above) >> above;
      const std::uint64_t safe = encoder.is_signed ? static_cast<std::uint64_t>(wide) : safe_;
      if (!frame.safe1.valid || !frame.safe2.valid) ++errors;
      if (frame.safe1.position != low(safe, 40)) ++wrong_safe;
      if (frame.safe2.position != low(~safe, 40)) ++wrong_safe;
    }
    before_ = truth;
  }

  unsigned wrong = 0;
  unsigned late = 0;
  unsigned poor = 0;
  unsigned missing = 0;
  unsigned errors = 0;
  unsigned wrong_safe = 0;

 private:
  Bench& bench_;
  std::uint64_t before_ = 0;
  std::uint64_t safe_ = 0;
};

void expect_clean(const Watch& watch, const Bench& bench, const std::string& what) {
  EXPECT_EQ(watch.wrong, 0U) << what;
  EXPECT_EQ(watch.late, 0U) << what;
  EXPECT_EQ(watch.poor, 0U) << what;
  EXPECT_EQ(watch.missing, 0U) << what;
  EXPECT_EQ(watch.errors, 0U) << what;
  EXPECT_EQ(watch.wrong_safe, 0U) << what;
  EXPECT_EQ(const_cast<Bench&>(bench).link().restarts(), 0U) << what;
  EXPECT_EQ(const_cast<Bench&>(bench).link().illegal_words(), 0U) << what;
}

// D-16: second differences up to +-1023, across zero, four widths, both forms of STATUS2.
TEST(DslMotion, RandomMotion_IsFollowedExactly) {
  const std::uint64_t frames = long_run();
  for (const unsigned bits : {30U, 32U, 35U, 40U}) {
    for (const bool k28 : {false, true}) {
      BenchSetup setup;
      setup.encoder.data_bits = bits;
      setup.encoder.is_signed = k28;
      setup.encoder.status2_k28 = k28;
      setup.metres(bits);
      Bench bench(setup);
      RandomMotion motion(bench.encoder(), bits);
      Watch watch(bench);
      ASSERT_TRUE(bench.run_frames(frames / 2)) << bits;
      expect_clean(watch, bench, std::to_string(bits) + " bits");
    }
  }
}

// The highest speed of 24 bits, and a position that wraps.
TEST(DslMotion, HighestSpeed_IsFollowedExactly) {
  BenchSetup setup;
  setup.encoder.data_bits = 30;
  Bench bench(setup);
  RandomMotion motion(bench.encoder(), 5, 1023, 8'000'000);
  Watch watch(bench);
  ASSERT_TRUE(bench.run_frames(20'000));
  expect_clean(watch, bench, "fast");
}

// D-6: still, constant speed, a sine whose second difference is nearly the limit.
TEST(DslMotion, StillConstantAndSine_AreFollowedExactly) {
  for (const int kind : {0, 1, 2, 3}) {
    BenchSetup setup;
    DataSource& source = setup.encoder.source;
    if (kind == 0) source.constant = 0x12345678;
    if (kind == 1 || kind == 3) {
      source.kind = DataSource::Kind::kRamp;
      source.start = 5;
      source.step = kind == 1 ? 123'456 : -77'777;
    }
    if (kind == 2) {
      // A (2 pi 11.52 us / T)^2 = 1020 counts a frame and frame.
      source.kind = DataSource::Kind::kSine;
      source.period = 20'000 * kPsPerUs;
      source.amplitude = 1020.0 / std::pow(2 * 3.14159265358979 * 11.52 / 20'000, 2);
    }
    Bench bench(setup);
    Watch watch(bench);
    ASSERT_TRUE(bench.run_frames(20'000)) << kind;
    expect_clean(watch, bench, "kind " + std::to_string(kind));
    EXPECT_FALSE(bench.encoder().overflowed()) << kind;
  }
}

// A step of the encoder: markers, POS, and afterwards the true position.
TEST(DslMotion, StepBeyondElevenBits_IsMarkedAndFound) {
  for (const bool recover : {true, false}) {
    BenchSetup setup;
    setup.rules.recover = recover;
    Bench bench(setup);
    ASSERT_TRUE(bench.run_frames(100));
    ASSERT_TRUE(bench.encoder().set_data(1'000'000));
    unsigned lost = 0;
    unsigned wrong = 0;
    bench.on_frame = [&](const LinkFrame& frame) {
      lost += frame.lost ? 1U : 0U;
      wrong += !frame.lost && frame.position != bench.encoder().sent_word() ? 1U : 0U;
    };
    ASSERT_TRUE(bench.run_frames(300));
    EXPECT_TRUE(bench.encoder().overflowed());
    EXPECT_EQ(wrong, 0U);
    EXPECT_GT(lost, 8U);
    EXPECT_FALSE(bench.link().frame().lost);
    EXPECT_EQ(bench.link().frame().position, 1'000'000U);
    EXPECT_EQ(bench.link().restarts(), 0U);
  }
}

// A signed position below 0: bytes of both channels, and of a shorter second one.
TEST(DslMotion, NegativeSafePosition_HasItsInverse) {
  for (const unsigned second_bits : {0U, 20U}) {
    BenchSetup setup;
    setup.encoder.data_bits = 30;
    setup.encoder.is_signed = true;
    setup.encoder.safe2_bits = second_bits;
    setup.encoder.source.constant = 0x3FFFFCBD;  // -835
    Bench bench(setup);
    ASSERT_TRUE(bench.run_frames(8 * 6));
    const LinkFrame& frame = bench.link().frame();
    ASSERT_TRUE(frame.safe1.valid && frame.safe2.valid);
    EXPECT_EQ(frame.safe1.position, 0xFFFFFFFCBDU);
    // -835 / 1024 is -1 when it is cut.
    EXPECT_EQ(frame.safe2.position, second_bits == 0 ? 0x0000000342U : 0U);
  }
}

// R23: an encoder whose second difference does not fit marks it, and its words behind the marker
// may only lead the sum back to the truth. A repair takes them for true ones: with the marker in
// RX7 any difference of the position up to 2047 passes for one of the speed. So a marked word is
// not repaired, the four phases begin.
TEST(DslMotion, WordsThatCatchUp_MakeNoWrongPositionCertain) {
  dsl_model::Motion motion{dsl_model::MotionRules{}};
  motion.start(32);
  unsigned place = 0;
  std::uint64_t before = 0;  // the position at the sample before RX0
  std::uint64_t truth = 0;
  unsigned wrong = 0;
  const auto frame = [&](std::optional<int> word, bool marked) {
    if (place % 8 == 0) before = truth;
    if (place >= 8 * 5 + 7) truth += 1500;
    motion.frame(word, marked);
    if (++place % 8 == 0) motion.vertical_end(before);
    if (!motion.lost() && motion.position() != truth) ++wrong;
  };
  for (unsigned i = 0; i < 8 * 5 + 7; ++i) frame(0, false);
  ASSERT_FALSE(motion.lost());
  // Up to here it stood at 0. In RX7 it begins to move by 1500 steps a frame, which does not fit.
  frame(std::nullopt, true);
  EXPECT_TRUE(motion.lost());
  // Legal words that bring the sum from 0 to the truth and to its speed within eight frames.
  for (const int word : {1023, 1023, 0, 0, -207, -339, 0, 0}) frame(word, false);
  EXPECT_TRUE(motion.lost());
  for (unsigned i = 0; i < 8 * 8; ++i) frame(0, false);
  EXPECT_EQ(wrong, 0U);
  EXPECT_FALSE(motion.lost());
  EXPECT_EQ(motion.position(), truth);
  EXPECT_EQ(motion.speed(), 1500);
}

// ---- Loss ---------------------------------------------------------------------------------------

// One wrong bit in the acceleration of RX`place`, in 500 motions of one run. Counts for how many
// frames POS is set each time.
std::map<unsigned, unsigned> lose_words(bool recover, unsigned place) {
  constexpr unsigned kLosses = 500;
  // A word that is not repaired takes up to 62 frames.
  constexpr unsigned kApart = 96;
  BenchSetup setup;
  setup.rules.recover = recover;
  setup.metres(10);
  Bench bench(setup);
  RandomMotion motion(bench.encoder(), 11 + place);
  std::map<unsigned, unsigned> lengths;
  unsigned lost = 0;
  unsigned wrong = 0;
  unsigned stays = 0;
  bool marked = false;
  unsigned marks = 0;
  bench.on_frame = [&](const LinkFrame& frame) {
    if (frame.number < 40) return;
    const bool exact = frame.position == bench.encoder().sent_word();
    // A wrong bit can make the marker of the encoder, which is not repaired.
    const auto& words = frame.words;
    if (recover && (words.acceleration_high.is(dsl_model::kMarker1) ||
                    words.acceleration_low.is(dsl_model::kMarker1))) {
      marked = true;
      ++marks;
    }
    if (frame.lost) {
      ++lost;
    } else {
      if (!exact) ++wrong;
      if (lost != 0 && !marked) ++lengths[lost];
      lost = 0;
      marked = false;
    }
    if (frame.number % kApart == 0 && frame.lost && !marked) ++stays;
  };
  EXPECT_TRUE(bench.run_frames(40));
  // Running frame 1 is RX0.
  for (unsigned i = 1; i <= kLosses; ++i) {
    const std::uint64_t frame = std::uint64_t{i} * kApart + 1 + place;
    bench.line().flip(frame, {30 + i % 20});
  }
  EXPECT_TRUE(bench.run_frames(std::uint64_t{kLosses + 2} * kApart));
  EXPECT_EQ(wrong, 0U) << place;
  EXPECT_EQ(stays, 0U) << place;
  EXPECT_LE(marks, 5U) << place;
  EXPECT_EQ(bench.link().restarts(), 0U) << place;
  return lengths;
}

TEST(DslLoss, OneWord_IsRepairedIn8To15Frames) {
  for (unsigned place = 0; place < 8; ++place) {
    const auto lengths = lose_words(true, place);
    ASSERT_EQ(lengths.size(), 1U) << place;
    EXPECT_EQ(lengths.begin()->first, 15 - place);
    // A bit between two legal words for the same byte loses nothing.
    EXPECT_GE(lengths.begin()->second, 490U) << place;
  }
}

TEST(DslLoss, OneWordAsPublished_Takes31Or56To62Frames) {
  for (unsigned place = 0; place < 8; ++place) {
    unsigned all = 0;
    for (const auto& [length, count] : lose_words(false, place)) {
      all += count;
      // A guess that was right, or wrong by so little that nothing shows, needs one pass.
      const bool one_pass = length <= 31;
      if (place == 0) {
        EXPECT_EQ(length, 31U);
      } else if (one_pass) {
        EXPECT_LE(count, 10U) << "RX" << place << ": " << length;
      } else {
        EXPECT_GE(length, 56U) << place;
        EXPECT_LE(length, 62U) << place;
      }
    }
    EXPECT_GE(all, 490U) << place;
  }
}

// D-7: the guesses of one and of five bad words by the formula, worked out beside the model.
int guessed(std::array<int, 6>& last) {
  int sum = 0;
  for (unsigned i = 0; i < 5; ++i) sum += (last[i] - last[i + 1]) << (4 - i);
  sum = static_cast<std::int16_t>(sum);
  const int a = std::clamp(last[0] + static_cast<int>(std::floor(sum / 32.0)), -1024, 1023);
  for (unsigned i = 5; i > 0; --i) last[i] = last[i - 1];
  return last[0] = a;
}

TEST(DslLoss, FiveBadWords_AreGuessedByTheFormula) {
  for (const unsigned bad : {1U, 5U}) {
    Bench bench{BenchSetup()};
    RandomMotion motion(bench.encoder(), 21);
    std::array<int, 6> last{};
    int speed = 0;
    unsigned compared = 0;
    constexpr unsigned kFirst = 8 * 20 + 2;
    bench.on_frame = [&](const LinkFrame& frame) {
      if (frame.number < kFirst) {
        speed = frame.speed;
        const auto& words = frame.words;
        const auto word = static_cast<std::uint16_t>(words.acceleration_high.byte << 8U |
                                                     words.acceleration_low.byte);
        for (unsigned i = 5; i > 0; --i) last[i] = last[i - 1];
        last[0] = dsl_model::acceleration_of(word);
      } else if (frame.number < kFirst + bad) {
        EXPECT_FALSE(frame.acceleration_good);
        speed += guessed(last);
        EXPECT_EQ(frame.speed, speed);
        EXPECT_TRUE(frame.lost);
        ++compared;
      }
    };
    ASSERT_TRUE(bench.run_frames(40));
    for (unsigned i = 0; i < bad; ++i) bench.line().flip(kFirst + i, {32, 41});
    ASSERT_TRUE(bench.run_frames(250));
    EXPECT_EQ(compared, bad);
    EXPECT_FALSE(bench.link().frame().lost);
    EXPECT_EQ(bench.link().frame().position, bench.encoder().sent_word());
  }
}

// As many words missing in a row as the limit says end the link; one less does not.
TEST(DslLoss, WordsUpToTheLimit_Restart) {
  for (const unsigned missing : {30U, 31U}) {
    Bench bench{BenchSetup()};
    ASSERT_TRUE(bench.run_frames(100));
    unsigned seen = 0;
    bench.encoder().set_fault(slave_fault::kFastMarker, true);
    bench.on_frame = [&](const LinkFrame& frame) {
      if (!frame.acceleration_good) ++seen;
      if (seen == missing) bench.encoder().set_fault(slave_fault::kFastMarker, false);
    };
    ASSERT_TRUE(bench.run_frames(80, bench.now() + 3000 * kPsPerUs));
    EXPECT_EQ(bench.link().restarts(), missing == 31 ? 1U : 0U);
    if (missing == 31) {
      EXPECT_EQ(bench.link().last_restart(), Restart::kAcceleration);
    }
  }
}

// A limit of 0 is none of the published ones: the first missing word ends the link, as with 1.
TEST(DslLoss, LimitOfZero_IsAsOne) {
  for (const unsigned limit : {0U, 1U}) {
    BenchSetup setup;
    setup.rules.acceleration_limit = limit;
    Bench bench(setup);
    ASSERT_TRUE(bench.run_frames(100, 3000 * kPsPerUs)) << limit;
    EXPECT_EQ(bench.link().restarts(), 0U) << limit;
    bench.line().flip(102, {32, 41});
    bench.run_until(bench.now() + 300 * kPsPerUs);
    EXPECT_EQ(bench.link().restarts(), 1U) << limit;
    EXPECT_EQ(bench.link().last_restart(), Restart::kAcceleration) << limit;
  }
}

// Safe positions that do not come: two in a row, and the fast one is no longer certain.
TEST(DslLoss, StaleSafePosition_SetsPos) {
  for (const unsigned limit : {0U, 1U, 2U, 3U}) {
    BenchSetup setup;
    setup.rules.stale_limit = limit;
    setup.rules.quality = dsl_model::QualityRules::kSick;
    Bench bench(setup);
    ASSERT_TRUE(bench.run_frames(8 * 10));
    bench.encoder().set_fault(slave_fault::kSafeMarker, true);
    std::optional<std::uint64_t> lost_at;
    bench.on_frame = [&](const LinkFrame& frame) {
      if (frame.lost && !lost_at) lost_at = frame.number;
      if (frame.safe_new) {
        EXPECT_FALSE(frame.safe1.valid);
        EXPECT_FALSE(frame.safe1.error);  // its CRC is right: the encoder says so itself
        EXPECT_TRUE(frame.safe2.valid);
      }
    };
    ASSERT_TRUE(bench.run_frames(8 * 6));
    if (limit == 0) {
      EXPECT_FALSE(lost_at.has_value());
    } else {
      EXPECT_EQ(lost_at, 8 * 10 + 8 * limit);
    }
  }
}

}  // namespace
