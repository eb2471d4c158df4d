// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Windows of samples against the receiver of the model: three rules of the sample, whole starts
// with jitter and duty distortion, wrong bits, random samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "Vdsl_receiver.h"
#include "places.hpp"
#include "sim/masters/dsl_model/receiver.hpp"
#include "tests/block/dsl/dsl_waveform.hpp"
#include "tests/support/model_context.hpp"

namespace {

using namespace mb4::sim::dsl_model;

enum Purpose : std::uint8_t { kForStart, kForMatch, kForWords, kForIdentity };

constexpr unsigned kLatest = 48;  // clocks from the last sample to done_o
using Samples = mb4test::DslSamples;

// Where each word of an answer ends.
constexpr unsigned kLowest[] = {51, 41, 31, 21, 11, 0};

class DslReceiverBlock : public testing::TestWithParam<SampleRule> {
 protected:
  DslReceiverBlock() {
    m.sample_i = static_cast<std::uint8_t>(GetParam());
    m.table_i = 0;
    m.forget_i = 0;
    m.purpose_i = kForStart;
    block.clock();
    m.rst_ni = 1;
    rest(16);
  }

  void show(bool valid, unsigned number) {
    using namespace mb4test::places::dsl_pkg::stream_t;
    m.stream_i = static_cast<std::uint32_t>(kValid(valid) | kNumber(number) | kLevels(levels));
  }
  void rest(unsigned clocks) {
    for (unsigned i = 0; i < clocks; ++i) {
      levels = (levels << 1U | random.below(2)) & 0x1FFU;
      show(false, ++count);
      block.clock();
    }
  }
  void forget() {
    m.forget_i = 1;
    block.clock();
    m.forget_i = 0;
    rest(10);
    model.forget();
  }

  // One window through both. Returns whether the model liked it.
  bool window(Purpose purpose, const Samples& samples) {
    m.purpose_i = purpose;
    count = ~0U;
    words.clear();
    model.begin();
    const auto look = [this] {
      if (m.word_valid_o == 0) return;
      EXPECT_EQ(m.number_o, words.size());
      words.push_back(m.line_o);
    };
    for (const bool sample : samples) {
      levels = (levels << 1U | (sample ? 1U : 0U)) & 0x1FFU;
      show(true, ++count);
      m.eval();
      look();
      EXPECT_EQ(m.done_o, 0);
      block.clock();
      model.take(sample);
    }
    bool done = false;
    for (unsigned i = 0; i < kLatest && !done; ++i) {
      levels = (levels << 1U | random.below(2)) & 0x1FFU;
      show(false, ++count);
      m.eval();
      look();
      done = m.done_o != 0;
      if (done) good = m.good_o != 0;
      block.clock();
    }
    EXPECT_TRUE(done);
    bool expected = true;
    Answer answer = 0;
    if (purpose == kForStart) expected = model.learn();
    if (purpose == kForMatch) expected = model.matches();
    const bool words_come = purpose >= kForWords;
    if (words_come) answer = model.answer(purpose == kForWords);
    if (!words_come) {
      EXPECT_EQ(good, expected);
    }
    if (!expected) return false;
    EXPECT_EQ(m.place_o >> 8U, model.delay());
    EXPECT_EQ(m.place_o >> 5U, model.delay() * 8 + model.eighth());
    if (GetParam() == SampleRule::kTracking) {
      EXPECT_EQ(m.place_o - 4 * 32, model.place());
    }
    EXPECT_EQ(m.edges_o, model.edges());
    EXPECT_EQ(m.rssi_o, words_come ? model.rssi() : m.rssi_o);
    if (words_come) {
      EXPECT_EQ(words.size(), 6U);
      for (unsigned i = 0; i < words.size(); ++i) {
        EXPECT_EQ(words[i], answer >> kLowest[i] & 0x3FFU) << "word " << i;
      }
    }
    return true;
  }

  Samples samples_of(Answer answer, int begin, unsigned jitter, int duty) {
    return mb4test::samples_of(answer, {.begin = begin, .jitter = jitter, .duty = duty}, random);
  }
  Answer any_answer() {
    Answer answer = 0;
    for (unsigned i = 0; i < 4; ++i) answer = answer << 16U | random.below(65536);
    return answer & ((Answer{1} << kAnswerBits) - 1);
  }

  mb4test::Dice random;
  mb4test::Block<Vdsl_receiver> block;
  Vdsl_receiver& m = block.model;
  Receiver model{GetParam(), false};
  unsigned levels = 0x1FF;
  unsigned count = 576;
  bool good = false;
  std::vector<unsigned> words;
};

// Starts with nine START frames, nine LEARN, sixteen CHECK, and frames with random answers whose
// edges drift. The jitter goes beyond what a rule takes, so starts fail at each point.
TEST_P(DslReceiverBlock, StartsAtRandom_AreThoseOfTheModel) {
  unsigned linked = 0;
  unsigned failed = 0;
  for (unsigned start = 0; start < 200; ++start) {
    SCOPED_TRACE(testing::Message() << "start " << start);
    forget();
    rest(random.below(40));
    int begin = static_cast<int>(random.below(12 * 128));
    const unsigned jitter = random.below(4) * random.below(40);
    const int duty = static_cast<int>(random.below(31)) - 15;
    const int drift = static_cast<int>(random.below(25)) - 12;
    const bool wrong = random.below(8) == 0;
    const unsigned wrong_frame = random.below(34);
    bool went = true;
    for (unsigned frame = 0; frame < 34 + 30 && went; ++frame) {
      SCOPED_TRACE(testing::Message() << "frame " << frame);
      const Purpose purpose = frame < 9     ? kForStart
                              : frame < 34  ? kForMatch
                              : frame == 34 ? kForIdentity
                                            : kForWords;
      // Far enough for the bound of a link, which the identity has not.
      if (frame == 34)
        begin = std::clamp(begin + static_cast<int>(random.below(113)) - 56, 0, 13 * 128);
      Answer answer = frame >= 34 ? any_answer() : kTestPattern;
      if (wrong && frame == wrong_frame) answer ^= Answer{1} << random.below(kAnswerBits);
      went = window(purpose, samples_of(answer, begin, jitter, duty));
      rest(200 + random.below(20));
      if (frame > 34) begin = std::clamp(begin + drift, 0, 13 * 128);
      if (HasFailure()) return;
    }
    (went ? linked : failed) += 1;
  }
  EXPECT_GT(linked, 30U);
  EXPECT_GT(failed, 30U);
}

// Windows of noise: no sample of them is like that of an encoder.
TEST_P(DslReceiverBlock, NoiseAtRandom_IsThatOfTheModel) {
  for (unsigned start = 0; start < 300; ++start) {
    SCOPED_TRACE(testing::Message() << "start " << start);
    forget();
    // Each second one with the published table of the strength.
    model = Receiver(GetParam(), start % 2 != 0);
    m.table_i = start % 2 != 0;
    // Half of the time a good START frame goes first, so that others are looked at.
    const int begin = 64 + static_cast<int>(random.below(10 * 128));
    const bool good_first = random.below(2) == 0;
    if (good_first && !window(kForStart, samples_of(kTestPattern, begin, 0, 0))) continue;
    bool went = true;
    for (unsigned frame = 0; frame < 12 && went; ++frame) {
      SCOPED_TRACE(testing::Message() << "frame " << frame);
      rest(200);
      Samples samples(Receiver::kSamples);
      // Few edges, many edges, none.
      const unsigned among = 1 + random.below(2) * random.below(40);
      const std::size_t quiet = random.below(110);
      bool level = true;
      for (std::size_t i = 0; i < samples.size(); ++i) {
        if (i >= quiet && random.below(among) == 0) level = !level;
        samples[i] = level;
      }
      if (random.below(16) == 0) samples.assign(samples.size(), random.below(2) != 0);
      const bool first = frame == 0 && !good_first;
      const Purpose purpose = first || random.below(8) == 0 ? kForStart
                              : random.below(4) == 0        ? kForIdentity
                                                            : kForWords;
      went = window(purpose, samples);
      if (HasFailure()) return;
    }
  }
}

std::string name_of(const testing::TestParamInfo<SampleRule>& rule) {
  constexpr const char* kNames[] = {"Published", "FirstZero", "Tracking"};
  return kNames[static_cast<unsigned>(rule.param)];
}

INSTANTIATE_TEST_SUITE_P(Rules, DslReceiverBlock,
                         testing::Values(SampleRule::kPublished, SampleRule::kFirstZero,
                                         SampleRule::kTracking),
                         name_of);

}  // namespace
