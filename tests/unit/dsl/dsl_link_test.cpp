// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The start of a link: cables from 0 m on, broken answers in the training, the encoder's identity,
// and the frames on the line.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/lines/dsl/dsl_faults.hpp"
#include "tests/unit/dsl/dsl_bench.hpp"

namespace {

using namespace mb4::sim;
using namespace mb4::sim::dsl_test;
using dsl_model::SampleRule;

constexpr SampleRule kRules[] = {SampleRule::kPublished, SampleRule::kFirstZero,
                                 SampleRule::kTracking};

// Number of the sample that first sees the answer, from the begin of slot 0: five ticks behind the
// driver's end. The encoder counts 19 nominal bits from the edge of SAMPLE to the end of SWITCH;
// the master counts 18 of its own to the begin of SWITCH.
unsigned first_sample(const BenchSetup& setup) {
  const double tick = 1e12 / static_cast<double>(setup.hz);
  const double edge = static_cast<double>(setup.cable.delay) + 19 * 320'000.0 / 3 +
                      static_cast<double>(setup.encoder.latency);
  return static_cast<unsigned>(std::ceil(edge / tick - 1e-6)) - 18 * 8 - 5;
}

// DELAY of a rule that places the edge at this sample: whole slots before the first sampled bit.
unsigned delay_of(SampleRule rule, unsigned sample) {
  if (rule == SampleRule::kPublished && sample / 8 == 10) return 10;  // no wrap into the next slot
  return (sample + 4) / 8;
}

// 0 to 100 m, three clocks, both forms of STATUS2: the first start succeeds, QM reaches 15, DELAY
// is that of the round trip, RSSI is 12.
void link_up(SampleRule rule) {
  for (int metres = 0; metres <= 100; ++metres) {
    for (const int ppm : {-100, 0, 100}) {
      for (const bool k28 : {false, true}) {
        BenchSetup setup;
        setup.rules.sample = rule;
        setup.metres(metres);
        setup.hz = static_cast<std::uint64_t>(75'000'000 + 75 * ppm);
        setup.encoder.status2_k28 = k28;
        Bench bench(setup);
        bench.on_frame = [&](const LinkFrame& frame) {
          if (frame.number != 0) {
            ASSERT_EQ(frame.rssi, 12U) << metres;
          }
          if (frame.number >= 32) {
            ASSERT_FALSE(frame.lost) << metres;
          }
        };
        ASSERT_TRUE(bench.run_frames(40, 2000 * kPsPerUs)) << metres << " m " << ppm << " ppm";
        const LinkFrame& frame = bench.link().frame();
        EXPECT_EQ(bench.link().restarts(), 0U) << metres << " m " << ppm << " ppm";
        EXPECT_TRUE(frame.linked);
        EXPECT_EQ(frame.quality, 15U) << metres << " m " << ppm << " ppm";
        const unsigned sample = first_sample(setup);
        if (rule == SampleRule::kTracking) {
          // The mean of all edges may lie a sample beside the first.
          EXPECT_NEAR(frame.sample_place, sample + 4, 1) << metres << " m " << ppm << " ppm";
        } else {
          EXPECT_EQ(frame.delay, delay_of(rule, sample)) << metres << " m " << ppm << " ppm";
        }
      }
    }
  }
}

TEST(DslLink, From0To100Metres_LinksAtOnce_Published) { link_up(SampleRule::kPublished); }
TEST(DslLink, From0To100Metres_LinksAtOnce_FirstZero) { link_up(SampleRule::kFirstZero); }
TEST(DslLink, From0To100Metres_LinksAtOnce_Tracking) { link_up(SampleRule::kTracking); }

// F7: cables that the published receiver links, by the latency of the encoder; without a gap.
TEST(DslLink, PublishedReceiver_LinksTheKnownLengths) {
  struct {
    double latency_ns;
    int from, to;  // m
  } constexpr kRanges[] = {{95, 0, 101}, {0, 1, 110}, {2 * 320.0 / 3, 0, 90}};
  for (const auto& [latency, from, to] : kRanges) {
    for (int metres = 0; metres <= 112; ++metres) {
      // Without any delay the first edge falls on an edge of the clock: either is right.
      if (latency == 0 && metres == 0) continue;
      BenchSetup setup;
      setup.rules.sample = SampleRule::kPublished;
      setup.encoder.latency = from_ns(latency);
      setup.metres(metres);
      Bench bench(setup);
      const bool links = bench.run_frames(1, 1500 * kPsPerUs) && bench.link().restarts() == 0;
      EXPECT_EQ(links, metres >= from && metres <= to) << latency << " ns " << metres << " m";
    }
  }
}

// Restarts without end, and nothing that a user could take for a position.
void no_link(BenchSetup setup, LineAction action, const std::string& what) {
  for (const SampleRule rule : kRules) {
    setup.rules.sample = rule;
    Bench bench(setup);
    bench.line().act(0, action);
    bench.on_frame = [&](const LinkFrame& frame) {
      ASSERT_FALSE(frame.linked) << what;
      ASSERT_TRUE(frame.lost) << what;
      ASSERT_EQ(frame.number, 0U) << what;
    };
    bench.run_until(10'000 * kPsPerUs);
    const std::uint64_t first = bench.link().restarts();
    EXPECT_GT(first, 20U) << what;
    bench.run_until(20'000 * kPsPerUs);
    EXPECT_GT(bench.link().restarts(), first + 20) << what;
    EXPECT_EQ(bench.running(), 0U) << what;
  }
}

TEST(DslLink, LongOpenAndShortedLines_RestartWithoutEnd) {
  using What = LineAction::What;
  constexpr LineAction kNothing{What::kPlug, 0};
  for (const double metres : {115.0, 120.0, 150.0, 200.0}) {
    no_link(BenchSetup().metres(metres), kNothing, std::to_string(metres) + " m");
  }
  no_link(BenchSetup(), {What::kUnplug, 0}, "open");
  no_link(BenchSetup(), {What::kLow, DuplexLine::kBoth}, "low");
  no_link(BenchSetup(), {What::kHigh, DuplexLine::kBoth}, "high");
}

// A line that is plugged in later links then.
TEST(DslLink, LineThatComesBack_LinksAgain) {
  Bench bench(BenchSetup().metres(30));
  ASSERT_TRUE(bench.link_up(2000 * kPsPerUs));
  bench.line().act(bench.now(), {LineAction::What::kUnplug, 0});
  bench.run_until(bench.now() + 1000 * kPsPerUs);
  EXPECT_FALSE(bench.link().linked());
  EXPECT_TRUE(bench.link().frame().lost);
  bench.line().act(bench.now(), {LineAction::What::kPlug, 0});
  EXPECT_TRUE(bench.link_up(bench.now() + 3000 * kPsPerUs));
}

// D-4: each bit of each training frame, wrong once, is a restart; with tracking the first START
// frame only measures.
void wrong_training_bit(SampleRule rule, unsigned first) {
  unsigned tried = 0;
  for (unsigned training = first; training <= 34; ++training) {
    for (unsigned bit = 0; bit < 61; ++bit, ++tried) {
      BenchSetup setup;
      setup.rules.sample = rule;
      setup.metres(20);
      Bench bench(setup);
      bench.encoder().flip_training(training, bit);
      unsigned seen = 0;
      bench.on_frame = [&](const LinkFrame& frame) {
        if (++seen == training) {
          EXPECT_NE(frame.restart, Restart::kNone) << training << " " << bit;
        } else {
          EXPECT_EQ(frame.restart, Restart::kNone) << training << " " << bit;
        }
      };
      while (seen < training && bench.next_frame()) {
      }
      ASSERT_EQ(bench.link().restarts(), 1U) << training << " " << bit;
    }
  }
  EXPECT_EQ(tried, (35 - first) * 61);
}

TEST(DslLink, WrongBitInTraining_Restarts_Published) {
  wrong_training_bit(SampleRule::kPublished, 1);
}
TEST(DslLink, WrongBitInTraining_Restarts_FirstZero) {
  wrong_training_bit(SampleRule::kFirstZero, 1);
}
TEST(DslLink, WrongBitInTraining_Restarts_Tracking) {
  wrong_training_bit(SampleRule::kTracking, 2);
}

// An encoder whose test pattern is wrong once, in each of the 34 training frames: one restart, in
// this frame, and then a link.
TEST(DslLink, WrongPatternOfTheEncoder_RestartsOnce) {
  for (unsigned training = 1; training <= 34; ++training) {
    BenchSetup setup;
    setup.rules.sample = SampleRule::kFirstZero;
    setup.encoder.wrong_pattern = training;
    Bench bench(setup);
    unsigned seen = 0;
    unsigned restarted = 0;
    bench.on_frame = [&](const LinkFrame& frame) {
      ++seen;
      if (frame.restart != Restart::kNone) restarted = seen;
    };
    ASSERT_TRUE(bench.link_up(3000 * kPsPerUs)) << training;
    EXPECT_EQ(bench.link().restarts(), 1U) << training;
    EXPECT_EQ(restarted, training);
  }
}

// QM reads 8 when LINK rises, with the identity, and POS is set until the position is aligned.
TEST(DslLink, LinkRises_WithQualityEightAndPos) {
  Bench bench{BenchSetup()};
  unsigned rises = 0;
  bool before = false;
  bench.on_frame = [&](const LinkFrame& frame) {
    if (frame.linked && !before) {
      ++rises;
      EXPECT_EQ(frame.state, LinkState::kIdRequest);
      EXPECT_EQ(frame.quality, 8U);
    }
    EXPECT_EQ(frame.lost, frame.number < 32) << frame.number;
    before = frame.linked;
  };
  ASSERT_TRUE(bench.run_frames(50));
  EXPECT_EQ(rises, 1U);
}

// The start after a restart: the frame ends with its trailer, 16 bits nobody drives, 16 zeros.
TEST(DslLink, Restart_FinishesItsFrame) {
  BenchSetup setup;
  Bench bench(setup);
  bench.encoder().flip_training(3, 7);
  std::uint64_t begin = 0;
  std::uint64_t first = 0;
  bench.on_frame = [&](const LinkFrame& frame) {
    if (frame.restart != Restart::kNone) begin = frame.sampled - 64;
    if (begin != 0 && frame.restart == Restart::kNone && first == 0) first = frame.sampled - 64;
  };
  while (first == 0) ASSERT_TRUE(bench.next_frame());
  // Frame, gap, 18 frames of RESET and SYNC.
  EXPECT_EQ(first - begin, (108 + 32 + 18 * 108) * 8U);
}

// D-5: widths from the identity, and a broken one.
TEST(DslLink, Identity_GivesWidths) {
  struct {
    unsigned position;
    unsigned acceleration;
    unsigned index;
    bool is_signed;
    unsigned id;
  } constexpr kEncoders[] = {{40, 11, 0, false, 0x1D3},
                             {32, 11, 0, false, 0x153},
                             {35, 11, 0, false, 0x183},
                             {32, 11, 0, true, 0x553},
                             {30, 8, 9, false, 0x9160}};
  for (const auto& each : kEncoders) {
    BenchSetup setup;
    setup.encoder.data_bits = each.position;
    setup.encoder.acceleration_bits = each.acceleration;
    setup.encoder.index = each.index;
    setup.encoder.is_signed = each.is_signed;
    Bench bench(setup);
    ASSERT_TRUE(bench.link_up(2000 * kPsPerUs));
    EXPECT_EQ(bench.link().identity(), each.id);
    EXPECT_EQ(bench.link().position_bits(), each.position);
  }
}

TEST(DslLink, IdentityOf32And11_IsTheGoldenAnswer) {
  Bench bench{BenchSetup()};
  std::vector<unsigned> bytes;
  bench.on_frame = [&](const LinkFrame& frame) {
    if (frame.state != LinkState::kIdRequest) return;
    const auto& words = frame.words;
    bytes = {words.vertical.byte, words.parameter.byte, words.pipeline.byte,
             words.acceleration_high.byte, words.acceleration_low.byte};
  };
  ASSERT_TRUE(bench.link_up(2000 * kPsPerUs));
  EXPECT_EQ(bytes, (std::vector<unsigned>{0x53, 0x01, 0x00, 0x01, 0x53}));
}

TEST(DslLink, BrokenIdentity_Restarts) {
  BenchSetup setup;
  setup.encoder.broken_identity = true;
  Bench bench(setup);
  bench.run_until(5000 * kPsPerUs);
  EXPECT_GT(bench.link().restarts(), 3U);
  EXPECT_EQ(bench.link().last_restart(), Restart::kIdentity);
  EXPECT_FALSE(bench.link().linked());
}

// Wrong bits in both copies of the one identity make a width that cannot be seen there. The safe
// positions show it: their bits above the width are not those of a sign, or 0.
TEST(DslLink, WrongWidth_EndsTheLinkWithASafePosition) {
  struct {
    std::uint64_t position;
    bool is_signed;
    unsigned flip;
  } constexpr kWrong[] = {{0x89ABCDEF, false, 0x040},  // 28 bits
                          {0x99ABCDEF, false, 0x003},  // 29 bits: two of the acceleration less
                          {0x89ABCDEF, false, 0x400},  // a sign
                          {0x89ABCDEF, true, 0x400},   // no sign
                          {0xFFFFFFFF, true, 0x400},   //
                          {0x89ABCDEF, true, 0x080}};  // 40 bits
  for (const auto& wrong : kWrong) {
    for (const bool strict : {true, false}) {
      BenchSetup setup;
      setup.rules.strict_id = strict;
      setup.encoder.source.constant = wrong.position;
      setup.encoder.is_signed = wrong.is_signed;
      setup.encoder.identity_flip = wrong.flip;
      Bench bench(setup);
      // 40 bits of a number with a sign of 32 are a right position too.
      const bool told = strict && wrong.flip != 0x080;
      std::uint64_t last = 0;
      bench.on_frame = [&](const LinkFrame& frame) {
        if (frame.restart != Restart::kNone) last = frame.number;
        EXPECT_TRUE(frame.lost || !told) << wrong.flip;
      };
      bench.run_until(3000 * kPsPerUs);
      const std::string what = std::to_string(wrong.position) + " " + std::to_string(wrong.flip);
      EXPECT_EQ(bench.link().restarts() > 1, told) << what;
      if (!told) continue;
      EXPECT_EQ(bench.link().last_restart(), Restart::kIdentity) << what;
      EXPECT_EQ(last % 8, 0U) << what;
    }
  }
}

// Bit 19: more of the identity would follow. What that is nobody has published.
TEST(DslLink, IdentityThatWouldGoOn_Restarts) {
  for (const bool strict : {true, false}) {
    BenchSetup setup;
    setup.rules.strict_id = strict;
    setup.encoder.identity_flip = 0x80000;
    Bench bench(setup);
    EXPECT_EQ(bench.link_up(3000 * kPsPerUs), !strict);
    EXPECT_EQ(bench.link().last_restart(), strict ? Restart::kIdentity : Restart::kNone);
    EXPECT_EQ(bench.link().identity(), 0x80153U);
  }
}

// R13: CODE_ILLEGAL counts in each frame that brings words of the code.
TEST(DslLink, IllegalWords_AreCountedInIdentityAndInitToo) {
  for (const unsigned vsync_after : {3U, 65U}) {
    BenchSetup setup;
    setup.cable.answer_errors = 0.0005;
    setup.encoder.vsync_after = vsync_after;  // 65 is too late
    Bench bench(setup);
    std::uint64_t running = 0;
    std::uint64_t before = 0;
    bench.on_frame = [&](const LinkFrame& frame) {
      if (frame.state < LinkState::kIdRequest) return;
      const auto& w = frame.words;
      for (const auto* word : {&w.vertical, &w.parameter, &w.pipeline, &w.acceleration_high,
                               &w.acceleration_low, &w.secondary}) {
        if (word->only_strict) ++(frame.state == LinkState::kRun ? running : before);
      }
      EXPECT_EQ(bench.link().illegal_words(), running + before);
    };
    bench.run_until(30'000 * kPsPerUs);
    EXPECT_GT(vsync_after == 3 ? running : before, 10U);
  }
}

// R30: the place moves by two eighths at most when linked. In the ID frame there is no link yet.
TEST(DslLink, TrackingInTheIdFrame_HasNoBound) {
  for (const bool linked : {false, true}) {
    dsl_model::Receiver receiver(SampleRule::kTracking, false);
    const auto window = [&receiver](unsigned begin) {
      receiver.begin();
      for (unsigned i = 0; i < dsl_model::Receiver::kSamples; ++i) {
        const unsigned bit = (i - begin) / 8;
        const bool inside = i >= begin && bit < dsl_model::kAnswerBits;
        receiver.take(!inside || (dsl_model::kTestPattern >> (60 - bit) & 1U) != 0);
      }
    };
    receiver.forget();
    for (unsigned frame = 0; frame < 9; ++frame) {
      window(40);
      ASSERT_TRUE(receiver.learn());
    }
    EXPECT_EQ(receiver.place(), 40U * 32);
    window(43);
    receiver.answer(linked);
    EXPECT_EQ(receiver.place(), (linked ? 42U : 43U) * 32);
  }
}

// The limit of the wait for VSYNC, and none.
TEST(DslLink, NoVsync_RestartsAfterItsLimit) {
  for (const unsigned after : {3U, 11U, 64U, 65U}) {
    BenchSetup setup;
    setup.encoder.vsync_after = after;
    Bench bench(setup);
    bench.run_until(4000 * kPsPerUs);
    EXPECT_EQ(bench.link().linked() && !bench.link().frame().lost, after <= 64) << after;
    if (after > 64) {
      EXPECT_EQ(bench.link().last_restart(), Restart::kVsync);
    }
    setup.rules.vsync_limit = 0;
    Bench patient(setup);
    EXPECT_TRUE(patient.link_up(4000 * kPsPerUs)) << after;
  }
}

// What nobody knows of real encoders makes no difference to the master.
TEST(DslLink, EncodersFreedoms_AllLink) {
  std::vector<DslSlaveConfig> encoders(1);
  const auto add = [&](auto change) {
    encoders.emplace_back();
    change(encoders.back());
  };
  add([](auto& e) { e.msync = e.first = DslFollow::kFollow; });
  add([](auto& e) { e.sync_frames = 16; });
  add([](auto& e) { e.positive = true; });
  add([](auto& e) { e.s_par_bits = 3; });
  add([](auto& e) { e.lead = 100 * kPsPerNs; });
  add([](auto& e) { e.pipeline = 0xA5; });
  add([](auto& e) { e.summary = 0x81; });
  add([](auto& e) { e.safe2_bits = 20; });
  add([](auto& e) { e.clock_ppm = 100; });
  add([](auto& e) { e.clock_ppm = -100; });
  for (const DslSlaveConfig& encoder : encoders) {
    BenchSetup setup;
    setup.encoder = encoder;
    setup.metres(25);
    Bench bench(setup);
    RandomMotion motion(bench.encoder(), 3);
    unsigned wrong = 0;
    bench.on_frame = [&](const LinkFrame& frame) {
      if (frame.number >= 41 && frame.lost) ++wrong;
      if (!frame.lost && frame.position != bench.encoder().sent_word()) ++wrong;
    };
    const std::size_t number = static_cast<std::size_t>(&encoder - encoders.data());
    ASSERT_TRUE(bench.run_frames(200, 10'000 * kPsPerUs)) << number;
    EXPECT_EQ(wrong, 0U) << number;
    EXPECT_EQ(bench.link().restarts(), 0U) << number;
  }
  // The bit before safe channel 2 is no bit of data, but in the training it has to be 0.
  for (const bool direction : {false, true}) {
    BenchSetup setup;
    setup.encoder.direction = direction;
    Bench bench(setup);
    EXPECT_EQ(bench.link_up(5000 * kPsPerUs), !direction);
  }
  // Without enough SYNC frames it never answers.
  BenchSetup setup;
  setup.encoder.sync_frames = 17;
  Bench bench(setup);
  bench.run_until(3000 * kPsPerUs);
  EXPECT_EQ(bench.link().last_restart(), Restart::kNotFound);
}

// An encoder that wants its vertical frames elsewhere than this master begins them: its VSYNC comes
// early, the link begins again, and no wrong position is called certain.
TEST(DslLink, EncoderWithAnotherVsyncPhase_LosesTheLink) {
  for (unsigned phase = 1; phase < 8; ++phase) {
    BenchSetup setup;
    setup.encoder.msync = DslFollow::kFollow;
    setup.encoder.vsync_phase = phase;
    Bench bench(setup);
    RandomMotion motion(bench.encoder(), 3);
    bench.on_frame = [&](const LinkFrame& frame) {
      if (!frame.lost) {
        EXPECT_EQ(frame.position, bench.encoder().sent_word()) << phase;
      }
    };
    bench.run_until(20'000 * kPsPerUs);
    EXPECT_GT(bench.link().restarts(), 2U) << phase;
  }
}

// ---- D-1: the frame on the line -----------------------------------------------------------------

struct Recorder final : LineObserver {
  void frame_begun() override {}
  void frame_over(const LineFrame& frame) override { frames.push_back(frame); }
  void edge(Time now, unsigned place, bool level) override {
    if (place == 4) out.emplace_back(now, level);
    if (place == 5) enable.emplace_back(now, level);
  }
  static bool at(const std::vector<std::pair<Time, bool>>& edges, Time time) {
    bool level = false;
    for (const auto& [when, value] : edges) {
      if (when > time) break;
      level = value;
    }
    return level;
  }

  std::vector<LineFrame> frames;
  std::vector<std::pair<Time, bool>> out;
  std::vector<std::pair<Time, bool>> enable;
};

TEST(DslLine, Frame_Has108BitsFieldByField) {
  Bench bench{BenchSetup()};
  ASSERT_TRUE(bench.link_up(2000 * kPsPerUs));
  Recorder recorder;
  bench.line().observe(bench.now(), &recorder, true);
  std::vector<Time> begins;
  bench.on_frame = [&](const LinkFrame& frame) {
    begins.push_back(bench.model().time_of(frame.sampled) - 8 * 320'000 / 3);
  };
  bench.run_frames(4);
  bench.line().observe(bench.now(), nullptr, false);
  ASSERT_EQ(begins.size(), 4U);
  // First and last bit of each field; the answer is the encoder's.
  const std::string expected =
      "001011"
      "110"
      "110"
      "0000";
  const std::string trailer = "00000011";
  for (unsigned i = 1; i < 3; ++i) {
    EXPECT_NEAR(static_cast<double>(begins[i + 1] - begins[i]), 11.52e6, 20'000);
    std::string bits;
    std::string drives;
    for (unsigned bit = 0; bit < 108; ++bit) {
      const Time middle = begins[i] + static_cast<Time>((bit + 0.5) * 320'000 / 3);
      bits += Recorder::at(recorder.out, middle) ? '1' : '0';
      drives += Recorder::at(recorder.enable, middle) ? '1' : '0';
    }
    EXPECT_EQ(bits.substr(0, 16), expected);
    EXPECT_EQ(bits.substr(100), trailer);
    // IDLE with first, and msync in every other vertical frame.
    EXPECT_TRUE(bits.substr(16, 10) == "1001001101" || bits.substr(16, 10) == "1001000110") << bits;
    EXPECT_EQ(drives, std::string(26, '1') + std::string(74, '0') + std::string(8, '1'));
  }
  // A frame of the line: its bits, from SYNC to the trailer.
  ASSERT_GE(recorder.frames.size(), 2U);
  for (const LineFrame& frame : recorder.frames) {
    EXPECT_EQ(frame.edges, 108U);
    EXPECT_NEAR(static_cast<double>(frame.end - frame.start), 11.52e6, 1000);
  }
}

// A frame of the line is as long as its stuffing makes it, and the next one begins where it ends. A
// restart ends a START frame with its trailer.
TEST(DslLine, StartFrames_CarryTheirStuffing) {
  for (const unsigned blocks : {0U, 1U, 4U, 26U}) {
    BenchSetup setup;
    setup.rules.start_blocks = blocks;
    setup.metres(30);
    Bench bench(setup);
    Recorder recorder;
    bench.line().observe(0, &recorder, false);
    ASSERT_TRUE(bench.run_frames(10)) << blocks;
    bench.line().observe(bench.now(), nullptr, false);
    EXPECT_EQ(bench.link().restarts(), 0U) << blocks;
    ASSERT_GT(recorder.frames.size(), 40U);
    for (std::size_t i = 0; i < recorder.frames.size(); ++i) {
      const LineFrame& frame = recorder.frames[i];
      const bool start = i >= 18 && i < 27;
      const unsigned bits = 108 + (start ? 6 * blocks : 0);
      EXPECT_EQ(frame.edges, bits) << blocks << " " << i;
      EXPECT_NEAR(static_cast<double>(frame.end - frame.start), bits * 320'000.0 / 3, 1000) << i;
      if (i + 1 == recorder.frames.size()) break;
      EXPECT_NEAR(static_cast<double>(frame.end), static_cast<double>(recorder.frames[i + 1].start),
                  1000)
          << blocks << " " << i;
    }
  }
  BenchSetup setup;
  setup.encoder.sync_frames = 17;  // no answer: each first START frame is the last one
  Bench bench(setup);
  Recorder recorder;
  bench.line().observe(0, &recorder, false);
  bench.run_until(2000 * kPsPerUs);
  bench.line().observe(bench.now(), nullptr, false);
  EXPECT_GT(bench.link().restarts(), 4U);
  for (const LineFrame& frame : recorder.frames) EXPECT_EQ(frame.edges, 108U);
}

// A drive in step with its own cycle sends more ones in SAMPLE: the encoder's frame begins with
// SYNC all the same.
TEST(DslLine, FrameWithMoreOnes_BeginsWithSync) {
  for (unsigned extra = 0; extra <= 9; ++extra) {
    EventQueue queue;
    struct Nobody final : LineMaster {
      void set_inputs(Time /*now*/, unsigned /*line*/, unsigned /*levels*/) override {}
      [[noreturn]] void stop(const std::string& reason) override {
        throw std::runtime_error(reason);
      }
    } master;
    const DuplexConfig cable;
    DuplexLine line({queue, cable, {}, 1, master, 0});
    line.add(std::make_unique<DslSlave>(DslSlaveConfig()));
    Recorder recorder;
    line.observe(0, &recorder, false);
    dsl_model::FramePlan plan;
    int disparity = 0;
    Time begin = 1000 * kPsPerNs;
    std::vector<Time> begins;
    for (unsigned frame = 0; frame < 4; ++frame) {
      plan.make(dsl_model::kSync, false, {.extra = extra, .blocks = extra}, disparity,
                static_cast<int>(extra));
      begins.push_back(begin);
      for (unsigned bit = 0; bit < plan.bits(); ++bit) {
        const Time at = begin + kBits(bit);
        while (queue.next_time() <= at) queue.run_next();
        line.drive(at, (plan.level(bit, 0) ? kOutPin : 0U) | kEnablePin);
      }
      begin += kBits(plan.bits());
    }
    ASSERT_EQ(recorder.frames.size(), 3U) << extra;
    for (std::size_t i = 0; i < recorder.frames.size(); ++i) {
      EXPECT_NEAR(static_cast<double>(recorder.frames[i].start), static_cast<double>(begins[i]), 10)
          << extra;
      EXPECT_NEAR(static_cast<double>(recorder.frames[i].end), static_cast<double>(begins[i + 1]),
                  10)
          << extra;
      EXPECT_EQ(recorder.frames[i].edges, plan.bits()) << extra;
    }
  }
}

// R5: slot 0 begins RX_START ticks behind the begin of SWITCH, so each tick more is one sample less
// up to the answer. The sample of tick 0 is still the last bit of M_PAR, a 0: nothing is found
// then.
TEST(DslLink, RxStart_MovesTheSlots) {
  unsigned links = 0;
  for (const unsigned start : {1U, 2U, 3U, 4U, 5U, 8U, 12U, 15U}) {
    for (const int metres : {30, 60, 95}) {
      BenchSetup setup;
      setup.rules.sample = SampleRule::kFirstZero;
      setup.rules.rx_start = start;
      setup.metres(metres);
      Bench bench(setup);
      ASSERT_TRUE(bench.run_frames(10, 2000 * kPsPerUs)) << start << " " << metres;
      EXPECT_EQ(bench.link().restarts(), 0U) << start << " " << metres;
      const unsigned sample = first_sample(setup) + 5 - start;
      EXPECT_EQ(bench.link().frame().sample_place, sample + 4) << start << " " << metres;
      EXPECT_EQ(bench.link().frame().delay, (sample + 4) / 8) << start << " " << metres;
      ++links;
    }
  }
  EXPECT_EQ(links, 24U);
  BenchSetup setup;
  setup.rules.rx_start = 0;
  setup.metres(30);
  Bench bench(setup);
  bench.run_until(3000 * kPsPerUs);
  EXPECT_EQ(bench.running(), 0U);
  EXPECT_EQ(bench.link().last_restart(), Restart::kNotFound);
}

// EDGES: the neighbouring samples that differ, over the slots of LEARN and CHECK frames. A clean
// line has its edges at one eighth alone, with jitter at its neighbours too.
TEST(DslLink, Edges_AreThoseOfTheTraining) {
  for (const SampleRule rule : kRules) {
    for (int metres = 3; metres < 60; metres += 7) {
      BenchSetup setup;
      setup.rules.sample = rule;
      setup.metres(metres);
      Bench bench(setup);
      ASSERT_TRUE(bench.run_frames(40, 2000 * kPsPerUs));
      EXPECT_EQ(bench.link().edges(), 1U << first_sample(setup) % 8) << metres;
      setup.cable.in.jitter = 13'333 * 2;  // two ticks peak to peak
      Bench jittered(setup);
      ASSERT_TRUE(jittered.run_frames(40, 2000 * kPsPerUs));
      const unsigned edges = jittered.link().edges();
      EXPECT_GE(std::popcount(edges), 2) << metres;
      EXPECT_LE(std::popcount(edges), 4) << metres;
    }
  }
}

// RESET and SYNC fill the window with 0101..., START frames carry four blocks of stuffing.
TEST(DslLine, Training_IsAsPublished) {
  BenchSetup setup;
  Bench bench(setup);
  Recorder recorder;
  bench.line().observe(0, &recorder, true);
  bench.run_until(600 * kPsPerUs);
  bench.line().observe(bench.now(), nullptr, false);
  // The first driven level, then 16 zeros, then frames.
  Time begin = 0;
  for (const auto& [when, on] : recorder.enable) {
    if (on && begin == 0) begin = when;
  }
  const auto bits = [&](Time from, unsigned count) {
    std::string text;
    for (unsigned bit = 0; bit < count; ++bit) {
      text += Recorder::at(recorder.out, from + static_cast<Time>((bit + 0.5) * 320'000 / 3)) ? '1'
                                                                                              : '0';
    }
    return text;
  };
  const auto after = [&](unsigned count) {
    return begin + static_cast<Time>(count * 320'000.0 / 3);
  };
  EXPECT_EQ(bits(begin, 16), std::string(16, '0'));
  std::string window;
  for (unsigned i = 0; i < 37; ++i) window += "01";
  const std::string head = "001011110110";
  const char* const equal[] = {"0000", "1101", "1101", "0000"};
  const char* const words[] = {"0101001011", "0101001011", "1001100100", "1001100100"};
  for (unsigned i = 0; i < 4; ++i) {
    EXPECT_EQ(bits(after(16 + 108 * i), 108), head + equal[i] + words[i] + window + "00000011");
  }
  const std::string start = bits(after(16 + 108 * 18), 132);
  EXPECT_EQ(start.substr(0, 26), head + "0000" + "0101100100");
  EXPECT_EQ(start.substr(100), "00000011001011001011001011001011");
}

}  // namespace
