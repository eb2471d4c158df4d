// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The quality monitor by its three documents, alone and on the line with a faulty encoder (D-8,
// D-14).
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sim/lines/dsl/dsl_code.hpp"
#include "sim/lines/dsl/dsl_faults.hpp"
#include "tests/unit/dsl/dsl_bench.hpp"

namespace {

using namespace mb4::sim;
using namespace mb4::sim::dsl_test;
using dsl_model::Quality;
using dsl_model::QualityEvents;
using dsl_model::QualityRules;

// In the order of QualityRules: document, sick, firmware.
constexpr QualityRules kRules[] = {QualityRules::kDocument, QualityRules::kSick,
                                   QualityRules::kFirmware};

// One event from 15 down, by the table of the three documents.
TEST(DslQuality, Steps_AreThoseOfThreeDocuments) {
  struct {
    const char* what;
    QualityEvents events;
    int steps[3];
  } const kTable[] = {{"VSYNC early", {.vsync_early = true}, {-4, -6, -4}},
                      {"VSYNC missing", {.vsync_missing = true}, {-8, -4, -6}},
                      {"RSSI", {.rssi_low = true}, {-8, -4, -4}},
                      {"S_PAR", {.parameter_error = true}, {-1, -1, -1}},
                      {"pipeline", {.pipeline_error = true}, {-1, -1, -1}},
                      {"acceleration", {.acceleration_error = true}, {-1, -2, -2}},
                      {"special", {.specials = 1}, {-2, -2, -2}},
                      {"safe 1", {.safe1_error = true}, {-8, -6, -6}},
                      {"safe 2", {.safe2_error = true}, {-8, -8, -8}},
                      {"CRC", {.safe1_good = true}, {1, 1, 1}},
                      {"VSYNC", {.vsync_good = true}, {1, 1, 1}}};
  for (unsigned rules = 0; rules < 3; ++rules) {
    for (const auto& row : kTable) {
      Quality quality(kRules[rules]);
      quality.start();
      EXPECT_EQ(quality.value(), 8U);
      for (unsigned i = 0; i < 6; ++i) quality.frame({.vsync_good = true});  // to 14
      EXPECT_TRUE(quality.frame(row.events)) << row.what;
      EXPECT_EQ(static_cast<int>(quality.value()), 14 + row.steps[rules]) << row.what;
    }
    // It stops at 15.
    Quality quality(kRules[rules]);
    quality.start();
    for (unsigned i = 0; i < 20; ++i) quality.frame({.vsync_good = true});
    EXPECT_EQ(quality.value(), 15U);
  }
}

// D-14: from 15 down by one; QMLW below 14; the link ends at 0, by the firmware below it.
TEST(DslQuality, FromFifteenDown_EndsTheLink) {
  for (unsigned rules = 0; rules < 3; ++rules) {
    Quality quality(kRules[rules]);
    quality.start();
    for (unsigned i = 0; i < 7; ++i) quality.frame({.vsync_good = true});
    ASSERT_EQ(quality.value(), 15U);
    for (unsigned left = 15; left-- > 1;) {
      ASSERT_TRUE(quality.frame({.parameter_error = true}));
      EXPECT_EQ(quality.value(), left);
      EXPECT_EQ(quality.low(), left < 14);
    }
    EXPECT_EQ(quality.frame({.parameter_error = true}), kRules[rules] == QualityRules::kFirmware);
    EXPECT_EQ(quality.value(), 0U);
    EXPECT_FALSE(quality.frame({.parameter_error = true}));
  }
}

// QM at the end of a vertical frame in which the encoder did something, from 15.
struct Told {
  unsigned quality = 0;
  bool valid1 = false;
  bool error1 = false;
  bool valid2 = false;
  bool error2 = false;
  std::uint64_t position1 = 0;
  bool lost = true;
  std::uint64_t restarts = 0;
};

template <typename Do>
Told after(
    QualityRules rules, Do act,
    const std::function<void(const LinkFrame&)>& look = [](const LinkFrame&) {}) {
  BenchSetup setup;
  setup.rules.quality = rules;
  setup.encoder.source.constant = 0x11223344;
  Bench bench(setup);
  EXPECT_TRUE(bench.run_frames(8 * 10));
  EXPECT_EQ(bench.link().frame().quality, 15U);
  Told told;
  bench.on_frame = [&](const LinkFrame& frame) {
    look(frame);
    if (frame.number != 8 * 11) return;
    told.quality = frame.quality;
    told.valid1 = frame.safe1.valid;
    told.error1 = frame.safe1.error;
    told.valid2 = frame.safe2.valid;
    told.error2 = frame.safe2.error;
    told.position1 = frame.safe1.position;
    told.lost = frame.lost;
    told.restarts = bench.link().restarts();
  };
  act(bench);
  EXPECT_TRUE(bench.run_frames(8, bench.now() + 300 * kPsPerUs));
  return told;
}

// D-8: each byte of each safe channel, with two wrong bits that no table has, and with one.
TEST(DslQuality, WrongVerticalByte_KeepsTheOldSafePosition) {
  constexpr unsigned kAtTheEnd[] = {15 - 8 + 1, 15 - 6 + 1, 15 - 6 + 1};  // VSYNC is good
  for (unsigned rules = 0; rules < 3; ++rules) {
    for (unsigned place = 0; place < 8; ++place) {
      for (const unsigned bit : {0U, 5U, 9U}) {
        const Told told = after(
            kRules[rules], [&](Bench& bench) { bench.line().flip(8 * 10 + 1 + place, {bit}); });
        EXPECT_FALSE(told.valid1) << place << " " << bit;
        EXPECT_TRUE(told.error1) << place << " " << bit;
        EXPECT_TRUE(told.valid2) << place << " " << bit;
        EXPECT_EQ(told.position1, 0x11223344U) << place << " " << bit;
        EXPECT_FALSE(told.lost) << place << " " << bit;
        // A wrong word can be a special character, which costs two more.
        EXPECT_TRUE(told.quality == kAtTheEnd[rules] || told.quality == kAtTheEnd[rules] - 2)
            << rules << " " << place << " " << bit << ": " << told.quality;
      }
    }
  }
}

// The legal words by the encoder's code, which the master does not use: byte, special character.
std::map<unsigned, std::pair<unsigned, bool>> legal_words() {
  std::map<unsigned, std::pair<unsigned, bool>> words;
  for (const bool positive : {false, true}) {
    for (unsigned byte = 0; byte < 256; ++byte) {
      const auto b = static_cast<std::uint8_t>(byte);
      words[dsl::Coder(positive).data(b)] = {byte, false};
      const bool special =
          (byte & 0x1F) == 28 || byte == 0xF7 || byte == 0xFB || byte == 0xFD || byte == 0xFE;
      if (special) words[dsl::Coder(positive).special(b)] = {byte, true};
    }
  }
  return words;
}

// Each bit of each word of channel 2, wrong once. 15, then VSYNC and the CRC of channel 1 (+2), is
// cut to 15. A word that is none, or a wrong CRC, costs 8; the firmware does not count the CRC; a
// special character that must not be there costs 2 more. K28 and D28 are the same byte.
TEST(DslQuality, WrongSecondaryByte_CostsEight) {
  const auto legal = legal_words();
  for (unsigned rules = 0; rules < 3; ++rules) {
    const bool firmware = kRules[rules] == QualityRules::kFirmware;
    for (unsigned place = 0; place < 8; ++place) {
      unsigned code_errors = 0;
      for (unsigned bit = 51; bit < 61; ++bit) {
        unsigned word = 0;
        const Told told = after(
            kRules[rules], [&](Bench& bench) { bench.line().flip(8 * 10 + 1 + place, {bit}); },
            [&](const LinkFrame& frame) {
              if (frame.number == 8 * 10 + 1 + place) word = frame.answer & 0x3FF;
            });
        const auto was = legal.find(word ^ 1U << (60 - bit));
        ASSERT_NE(was, legal.end());
        const auto is = legal.find(word);
        const bool error = is == legal.end();
        const bool same = !error && is->second.first == was->second.first;
        const bool special = !error && is->second.second && (is->second.first & 0x1F) != 28;
        const bool unexpected = special && is->second.first != 0xFB;
        const std::string what =
            std::to_string(rules) + " " + std::to_string(place) + " " + std::to_string(bit);
        // The firmware also counts a test of the encoder, which STATUS2 tells.
        const bool test2 = firmware && place == 0 && !error && (is->second.first & 0x40) != 0;
        const int code = (error || test2 ? 8 : 0) + (unexpected ? 2 : 0);
        const int crc = !error && !same && !firmware ? 8 : 0;
        const int quality = std::min(15, 15 + 2 - code - crc);
        EXPECT_EQ(told.quality, static_cast<unsigned>(quality)) << what;
        EXPECT_TRUE(told.valid1) << what;
        EXPECT_EQ(told.valid2, same) << what;
        EXPECT_EQ(told.error2, !same) << what;
        code_errors += error ? 1U : 0U;
      }
      EXPECT_GT(code_errors, 0U) << place;
    }
  }
}

TEST(DslQuality, FaultsOfTheEncoder_AreTold) {
  struct Row {
    const SlaveFault* fault;
    unsigned quality[3];
    bool valid1, error1, valid2, error2;
  };
  const Row kRows[] = {
      // VSYNC +1; the CRC of channel 1 costs 8, 6, 6.
      {&slave_fault::kWrongCrc, {8, 10, 10}, false, true, true, false},
      // VSYNC and CRC +2; that of channel 2 costs 8, by the firmware nothing.
      {&slave_fault::kWrongCrc2, {9, 9, 15}, true, false, false, true},
      // Markers are no errors of a channel.
      {&slave_fault::kSafeMarker, {15, 15, 15}, false, false, true, false},
      {&slave_fault::kSafe2Marker, {15, 15, 15}, true, false, false, false},
      {&slave_fault::kFastMarker, {15, 15, 15}, true, false, true, false},
      // Without VSYNC -8, -4, -6, and +1 of the CRC; one that comes early costs 4, 6, 4.
      {&slave_fault::kNoVsync, {8, 12, 10}, true, false, true, false},
      {&slave_fault::kEarlyVsync, {13, 11, 13}, true, false, true, false}};
  for (unsigned rules = 0; rules < 3; ++rules) {
    for (const Row& row : kRows) {
      const Told told =
          after(kRules[rules], [&](Bench& bench) { bench.encoder().set_fault(*row.fault, true); });
      const std::string what = std::string(row.fault->name) + " " + std::to_string(rules);
      EXPECT_EQ(told.quality, row.quality[rules]) << what;
      EXPECT_EQ(told.valid1, row.valid1) << what;
      EXPECT_EQ(told.error1, row.error1) << what;
      EXPECT_EQ(told.valid2, row.valid2) << what;
      EXPECT_EQ(told.error2, row.error2) << what;
      EXPECT_EQ(told.restarts, 0U) << what;
      EXPECT_EQ(told.lost, row.fault == &slave_fault::kFastMarker) << what;
    }
  }
}

// R13: value 28 is accepted as D28 and as K28 in each channel. An encoder that always sends K28
// there keeps its link and its quality; by the published check it loses both.
TEST(DslQuality, EncoderWithK28_KeepsTheLink) {
  for (const QualityRules rules : kRules) {
    for (const bool strict : {true, false}) {
      BenchSetup setup;
      setup.rules.quality = rules;
      setup.rules.check = strict ? dsl_model::CodeCheck::kStrict : dsl_model::CodeCheck::kPublished;
      setup.encoder.vertical_k28 = true;
      setup.encoder.summary = 0x1C;
      setup.encoder.source.constant = 0x1CFC9C1C;
      Bench bench(setup);
      bench.run_until(5000 * kPsPerUs);
      EXPECT_EQ(bench.link().restarts() == 0, strict) << static_cast<int>(rules);
      if (!strict) continue;
      EXPECT_EQ(bench.link().frame().quality, 15U);
      EXPECT_EQ(bench.link().frame().safe1.position, 0x1CFC9C1CU);
      EXPECT_EQ(bench.link().frame().position, 0x1CFC9C1CU);
      EXPECT_FALSE(bench.link().frame().lost);
    }
  }
}

// R1: no link, no valid safe position.
TEST(DslQuality, SafePositionsWithoutALink_AreNotValid) {
  BenchSetup setup;
  setup.encoder.source.constant = 0x11223344;
  Bench bench(setup);
  ASSERT_TRUE(bench.run_frames(81));
  ASSERT_TRUE(bench.link().frame().safe1.valid && bench.link().frame().safe2.valid);
  bench.encoder().set_fault(slave_fault::kSilent, true);
  bench.line().slave_changed(bench.now());
  unsigned frames = 0;
  bench.on_frame = [&](const LinkFrame& frame) {
    if (frame.linked) return;
    ++frames;
    EXPECT_FALSE(frame.safe1.valid || frame.safe2.valid);
  };
  bench.run_until(bench.now() + 600 * kPsPerUs);
  EXPECT_GT(frames, 1U);
}

// A silent encoder ends the link within two frames; nothing is called certain meanwhile.
TEST(DslQuality, SilentEncoder_EndsTheLink) {
  for (const QualityRules rules : kRules) {
    BenchSetup setup;
    setup.rules.quality = rules;
    Bench bench(setup);
    ASSERT_TRUE(bench.run_frames(81));
    bench.encoder().set_fault(slave_fault::kSilent, true);
    bench.line().slave_changed(bench.now());
    std::uint64_t last = 0;
    std::vector<Restart> restarts;
    bench.on_frame = [&](const LinkFrame& frame) {
      if (frame.number != 0) last = frame.number;
      if (frame.restart != Restart::kNone) restarts.push_back(frame.restart);
      EXPECT_TRUE(frame.lost);
    };
    // A start takes 32 bits, 18 frames and its START frame: about 222 us.
    bench.run_until(bench.now() + 600 * kPsPerUs);
    EXPECT_LE(last, 83U);
    EXPECT_FALSE(bench.link().linked());
    EXPECT_EQ(restarts,
              (std::vector<Restart>{Restart::kQuality, Restart::kNotFound, Restart::kNotFound}));
    bench.encoder().set_fault(slave_fault::kSilent, false);
    EXPECT_TRUE([&] {
      bench.on_frame = nullptr;
      return bench.link_up(bench.now() + 3000 * kPsPerUs);
    }());
  }
}

}  // namespace
