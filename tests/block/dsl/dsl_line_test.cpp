// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A whole line beside the model of a master: the same encoder answers both, tick by tick. Levels,
// driver and times of the line; of each frame its words, its place, quality, state, reasons and
// restarts. The safe channels are judged here, from the words that the RTL gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "Vdsl_line.h"
#include "places.hpp"
#include "sim/lines/dsl/dsl_code.hpp"
#include "sim/masters/dsl_model/link.hpp"
#include "tests/block/dsl/dsl_quirks.hpp"
#include "tests/block/dsl/dsl_waveform.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/model_context.hpp"

namespace {

using namespace mb4::sim::dsl_model;
namespace dsl = mb4::sim::dsl;
using mb4test::quirks_of;

constexpr unsigned kVertical = 8;
constexpr unsigned kFrameTicks = 864;

// ---- Ports --------------------------------------------------------------------------------------

namespace at = mb4test::places::dsl_pkg;

struct AnswerPort {
  explicit AnswerPort(std::uint32_t port) {
    using namespace at::answer_t;
    ends = kEnds.of(port) != 0;
    word.only_strict = kWordOnlyStrict.of(port) != 0;
    word.special = kWordSpecial.of(port) != 0;
    word.error = kWordError.of(port) != 0;
    word.byte = static_cast<std::uint8_t>(kWordData.of(port));
    number = static_cast<unsigned>(kNumber.of(port));
    valid = kValid.of(port) != 0;
    place = static_cast<unsigned>(kPlace.of(port));
    running = kRunning.of(port) != 0;
    begins = kBegins.of(port) != 0;
    linked = kLinked.of(port) != 0;
  }
  bool linked, begins, running, valid, ends;
  unsigned place, number;
  Word word;
};

struct StatusPort {
  explicit StatusPort(std::uint64_t port) {
    using namespace at::line_status_t;
    const auto of = [port](const mb4test::Place& field) {
      return static_cast<unsigned>(field.of(port));
    };
    place = of(kPlace);
    edges = of(kEdges);
    rssi = of(kRssi);
    low = of(kLow) != 0;
    quality = of(kQuality);
    width = of(kWidth);
    identity = of(kIdentity);
    reason = of(kReason);
    state = of(kState);
  }
  unsigned place, edges, rssi, quality, width, identity, reason, state;
  bool low;
};

// ---- What is not in the line
// ----------------------------------------------------------------------

// The safe channels and the count of missing accelerations, by the words that the line gives.
class Judge {
 public:
  explicit Judge(const LinkRules& rules) : rules_(rules) {}

  void take(unsigned number, const Word& word) { words_[number] = word; }
  // dsl_pkg::verdict_t of the frame.
  unsigned verdict(const AnswerPort& answer, unsigned identity) {
    if (answer.place == 0) channels_ = {};
    Channel& one = channels_[0];
    Channel& two = channels_[1];
    bool error1 = one.take(answer.place, words_[0]);
    bool error2 = two.take(answer.place, words_[5]);
    bool good1 = false;
    const bool firmware = rules_.quality == QualityRules::kFirmware;
    if (firmware && answer.place == 0 && (words_[5].byte & 0x40U) != 0) error2 = true;
    if (answer.place + 1 == kVertical) {
      if (!one.error) (one.crc_good() ? good1 : error1) = true;
      if (!two.error && !two.crc_good() && !firmware) error2 = true;
    }
    missing_ = acceleration_good() ? 0 : missing_ + 1;
    const bool misfit = rules_.strict_id && good1 && !one.mark && !one.fits(identity);
    using namespace at::verdict_t;
    return static_cast<unsigned>(kSafe1Error(error1) | kSafe1Good(good1) | kSafe2Error(error2) |
                                 kMisfit(misfit) |
                                 kMissing(missing_ != 0 && missing_ >= rules_.acceleration_limit));
  }
  void begin() { missing_ = 0; }

 private:
  struct Channel {
    std::array<std::uint8_t, kVertical> bytes{};
    bool error = false;
    bool mark = false;  // a special character but K28
    // The first error of the code.
    bool take(unsigned place, const Word& word) {
      bytes[place] = word.byte;
      const bool first = word.error && !error;
      error |= word.error;
      mark |= word.special && !word.error && (word.byte & 0x1FU) != 28;
      return first;
    }
    // The position as a number of the identity's width, widened again, is what came.
    bool fits(unsigned identity) const {
      std::int64_t position = 0;
      for (unsigned i = 1; i <= 5; ++i) position = position << 8 | bytes[i];
      const unsigned width = (identity >> 4U & 0x3FU) + (identity & 0xFU) + 8;
      std::int64_t low = position & ((std::int64_t{1} << width) - 1);
      if ((identity & 0x400U) != 0 && low >> (width - 1) != 0) low -= std::int64_t{1} << width;
      return (low & 0xFF'FFFF'FFFF) == position;
    }
    bool crc_good() const {
      const auto& b = bytes;
      return dsl::check_safe({b[0], b[1], b[2], b[3], b[4], b[5]}) == (b[6] << 8U | b[7]);
    }
  };
  bool acceleration_good() const {
    for (const unsigned i : {3U, 4U}) {
      if (words_[i].error) return false;
      const bool k28 = (words_[i].byte & 0x1FU) == 28;
      if (rules_.check == CodeCheck::kStrict && words_[i].special && !k28) return false;
    }
    const unsigned word = unsigned{words_[3].byte} << 8U | words_[4].byte;
    const int value = static_cast<int>(word >> 5U) - (word >= 0x8000U ? 2048 : 0);
    return dsl::with_check(value) == word;
  }

  LinkRules rules_;
  std::array<Word, 6> words_;
  std::array<Channel, 2> channels_;
  unsigned missing_ = 0;
};

// ---- The encoder
// ----------------------------------------------------------------------------------

// Answers each frame of the model as an encoder would, good or bad.
class Encoder {
 public:
  Encoder(mb4test::Dice& random, const LinkRules& rules) : random_(random), rules_(rules) {}
  bool faults = true;

  // The line is trained anew: what this start is like.
  void begin() {
    silent_ = marks_ = wild_ = wrong_identity_ = false;
    timing_ = {.begin = 40 * 16};
    drift_ = 0;
    frames_ = inits_ = running_ = place_ = rare_ = 0;
    vsync_after_ = 3;
    wrong_frame_ = life_ = ~0U;
    if (!faults) return;
    const unsigned fate = starts_++ % 8;
    wild_ = fate == 0;
    timing_.begin = wild_ ? static_cast<int>(random_.below(13 * 128))
                          : 20 * 16 + static_cast<int>(random_.below(9 * 128));
    timing_.jitter = random_.below(wild_ ? 150 : 12);
    timing_.duty = static_cast<int>(random_.below(wild_ ? 31 : 5)) - (wild_ ? 15 : 2);
    drift_ = wild_ ? static_cast<int>(random_.below(25)) - 12 : 0;
    if (fate == 1) wrong_frame_ = 9 + random_.below(9);
    if (fate == 5) wrong_frame_ = random_.below(34);
    if (fate == 6) wrong_frame_ = 18 + random_.below(16);
    wrong_identity_ = fate == 2;
    vsync_after_ = 1 + random_.below(6);
    // Without a limit it waits for more than its counter can count.
    const unsigned limit = rules_.vsync_limit == 0 ? 256 : rules_.vsync_limit;
    if (fate == 3) vsync_after_ = limit + random_.below(4);
    marks_ = fate == 4;
    life_ = 10 + random_.below(marks_ ? 30 : 300);
    constexpr unsigned kRare[] = {0, 0, 60, 15, 4};
    if (!marks_ && fate != 3) rare_ = kRare[random_.below(5)];
  }
  // The frame's window. `state` is that of the model.
  mb4test::DslSamples window(LinkState state) {
    const Answer answer = answer_of(state);
    if (faults && state == LinkState::kRun) {
      timing_.begin = std::clamp(timing_.begin + drift_, 0, 13 * 128);
    }
    const bool disturbed = wild_ || (rare_ != 0 && state == LinkState::kRun);
    if (silent_ || (disturbed && dice(400))) return mb4test::DslSamples(Receiver::kSamples, true);
    if (disturbed && dice(200)) return noise();
    auto samples = mb4test::samples_of(answer, timing_, random_);
    // Edges all over a slot, half of the time beside the sample of its bit.
    if (rare_ != 0 && state == LinkState::kRun && dice(30)) {
      const unsigned slot = 14 + random_.below(50);
      for (unsigned i = random_.below(2); i < 8; i += 2) samples[slot * 8 + i].flip();
    }
    return samples;
  }

 private:
  bool dice(unsigned among) { return random_.below(among) == 0; }

  Answer answer_of(LinkState state) {
    if (state <= LinkState::kCheck) {
      const bool wrong = frames_++ == wrong_frame_;
      return kTestPattern ^ (wrong ? Answer{1} << random_.below(kAnswerBits) : 0);
    }
    if (state == LinkState::kIdRequest) return identity();
    return data(state == LinkState::kRun);
  }

  static Answer join(std::initializer_list<unsigned> five, unsigned direction, unsigned last) {
    Answer all = 0;
    for (const unsigned word : five) all = all << 10U | word;
    return (all << 1U | direction) << 10U | last;
  }

  Answer identity() {
    dsl::Coder coder(dice(2));
    unsigned acceleration = faults ? random_.below(4) : 3;
    unsigned width = faults ? 12 + random_.below(29) : 32;
    if (wrong_identity_ && dice(2)) acceleration = random_.below(16);
    if (wrong_identity_ && dice(2)) width = 8 + random_.below(60);
    const unsigned less = (width - acceleration - 8) & 0x3FU;
    // Now and then more of it would follow, or the width is not that of the positions.
    const unsigned top = random_.below(wrong_identity_ ? 16 : 8);
    const unsigned id = top << 16U | random_.below(64) << 10U | less << 4U | acceleration;
    width_ = std::clamp(less + acceleration + 8, 8U, 40U);
    signed_ = (id & 0x400U) != 0;
    wide_ = faults && dice(12);
    std::array<unsigned, 5> bytes = {id & 0xFFU, id >> 8U & 0xFFU, (id >> 16U) * 0x11U,
                                     id >> 8U & 0xFFU, id & 0xFFU};
    if (wrong_identity_) bytes[random_.below(5)] ^= random_.below(2) << random_.below(8);
    std::array<unsigned, 5> words{};
    for (unsigned i = 0; i < 5; ++i) words[i] = coder.data(static_cast<std::uint8_t>(bytes[i]));
    return join({words[0], words[1], words[2], words[3], words[4]}, random_.below(2),
                coder.data(0x1C));
  }

  void fill() {
    for (auto& channel : bytes_) {
      for (auto& byte : channel) byte = static_cast<std::uint8_t>(random_.below(256));
    }
    if (!wide_) {
      std::int64_t position = 0;
      for (unsigned i = 1; i <= 5; ++i) position = position << 8 | bytes_[0][i];
      position &= (std::int64_t{1} << width_) - 1;
      if (signed_ && position >> (width_ - 1) != 0) position -= std::int64_t{1} << width_;
      for (unsigned i = 1; i <= 5; ++i) {
        bytes_[0][i] = static_cast<std::uint8_t>(position >> 8 * (5 - i));
      }
    }
    bytes_[1][0] =
        static_cast<std::uint8_t>(0x1CU | random_.below(2) << 7U | (dice(8) ? 0x40U : 0U));
    for (auto& b : bytes_) {
      const std::uint16_t crc = dsl::check_safe({b[0], b[1], b[2], b[3], b[4], b[5]});
      b[6] = static_cast<std::uint8_t>(crc >> 8U);
      b[7] = static_cast<std::uint8_t>(crc);
    }
  }

  Answer data(bool running) {
    if (running) {
      if (place_ == 0) fill();
      if (++running_ > life_ && !marks_) silent_ = true;
    }
    const bool bad = rare_ != 0 && dice(rare_);
    const bool last = running ? place_ + 1 == kVertical : ++inits_ >= vsync_after_;
    const bool vsync = last != (bad && dice(3));
    dsl::Coder coder(dice(2));
    // A byte that a fault has made something else.
    const auto byte = [&](std::uint8_t value) {
      if (!bad || !dice(3)) return coder.data(value);
      constexpr std::uint8_t kSpecials[] = {0xFD, 0xFB, 0xF7, 0xFE, 0x1C, 0x3C, 0x5C, 0xBC, 0xFC};
      switch (random_.below(3)) {
        case 0:
          return coder.data(static_cast<std::uint8_t>(value ^ 1U << random_.below(8)));
        case 1:
          return coder.special(kSpecials[random_.below(9)]);
        default:
          return random_.below(1024);
      }
    };
    const bool k28 = running && place_ == 0 && dice(2);
    const unsigned a = byte(bytes_[0][place_]);
    const unsigned b = byte(static_cast<std::uint8_t>((vsync ? 0x80U : 0U) | random_.below(128)));
    const unsigned c = byte(static_cast<std::uint8_t>(random_.below(256)));
    const std::uint16_t word = dsl::with_check(static_cast<int>(random_.below(2048)) - 1024);
    // The encoder says that it has no position.
    const bool marked = running && marks_ && running_ > life_;
    const bool both = bad && dice(3);  // words of the acceleration are anything
    const auto half = [&](unsigned value) {
      if (marked) return coder.special(0xFD);
      return both ? random_.below(1024) : byte(static_cast<std::uint8_t>(value));
    };
    const unsigned d = half(word >> 8U);
    const unsigned e = half(word & 0xFFU);
    const unsigned f = k28 ? coder.special(bytes_[1][place_]) : byte(bytes_[1][place_]);
    Answer answer = join({a, b, c, d, e}, random_.below(2), f);
    if (bad && dice(3)) answer ^= Answer{1} << random_.below(kAnswerBits);
    if (running) place_ = (place_ + 1) % kVertical;
    return answer;
  }

  mb4test::DslSamples noise() {
    mb4test::DslSamples samples(Receiver::kSamples);
    const unsigned among = 1 + random_.below(20);
    bool level = true;
    for (auto&& sample : samples) {
      if (dice(among)) level = !level;
      sample = level;
    }
    return samples;
  }

  mb4test::Dice& random_;
  LinkRules rules_;
  unsigned starts_ = 0;
  bool silent_ = false;
  bool marks_ = false;
  bool wild_ = false;  // far from what a rule takes
  mb4test::DslTiming timing_;
  int drift_ = 0;
  unsigned frames_ = 0;
  unsigned wrong_frame_ = ~0U;
  bool wrong_identity_ = false;
  unsigned width_ = 32;
  bool signed_ = false;
  bool wide_ = false;  // positions are wider than the identity says
  unsigned vsync_after_ = 3;
  unsigned inits_ = 0;
  unsigned running_ = 0;
  unsigned place_ = 0;
  unsigned life_ = ~0U;
  unsigned rare_ = 0;
  std::array<std::array<std::uint8_t, kVertical>, 2> bytes_{};
};

// ---- Both masters
// ---------------------------------------------------------------------------------

// The RTL and the model on one line, a tick at a time.
class Lines final : public LinkListener {
 public:
  Lines(mb4test::Dice& random, const LinkRules& rules)
      : rules_(rules), random_(random), judge_(rules), encoder(random, rules), model(rules) {
    model.set_listener(this);
    m.quirks_i = quirks_of(rules);
    m.hold_i = 0;
    m.symbol_i = 0x10;  // IDLE
    m.verdict_i = 0;
    m.line_i = 1;
    block.clock();
    m.rst_ni = 1;
  }

  void answered(const LinkFrame& frame) override {
    EXPECT_TRUE(!judged_ || held_) << "a frame has not ended in the RTL";
    judged_ = frame;
  }

  // From the first tick of a frame to its last.
  void frame() {
    begin();
    while (at_ == 0 || at_ < model.plan().bits() * kTicksPerBit) {
      tick();
      if (testing::Test::HasFailure()) return;
    }
    ASSERT_FALSE(judged_) << "the model has judged a frame, the RTL has not";
    const bool gap = model.state() == LinkState::kGap;
    EXPECT_NE(any_edge_, gap);
    if (gap) return;
    const bool stuffed =
        model.state() == LinkState::kStart && model.frame().restart == Restart::kNone;
    EXPECT_EQ(at_, kFrameTicks + (stuffed ? rules_.start_blocks * kBlockBits * kTicksPerBit : 0));
  }

  // hold_i rises somewhere in a frame, before its last bit, and falls again. The frame is finished
  // with its trailer, and a gap begins a new start.
  void held_frame() {
    begin();
    tick();
    if (testing::Test::HasFailure()) return;
    const bool gap = model.state() == LinkState::kGap;
    const unsigned end =
        (gap ? model.plan().bits() : model.plan().trailer_bit() + 8) * kTicksPerBit;
    const unsigned at = 1 + random_.below(end - kTicksPerBit - 1);
    while (at_ < at) {
      tick();
      if (testing::Test::HasFailure()) return;
    }
    // A frame that fails from now on is no restart that counts.
    m.hold_i = 1;
    held_ = true;
    // The driver is off in a gap: it stays off, and the gap goes on behind hold_i.
    const unsigned gone = (at_ + kTicksPerBit - 1) / kTicksPerBit;
    const bool off = gap && gone < 16;
    for (; !off && at_ < end;) {
      tick();
      if (testing::Test::HasFailure()) return;
      EXPECT_FALSE(AnswerPort(m.answer_o).linked);
    }
    illegal_ += model.illegal_words();
    for (unsigned i = 1 + random_.below(3'000); i > 0; --i) still();
    m.hold_i = 0;
    while (ticks % kTicksPerBit != 0) still();
    began_ = ticks;
    model = Link(rules_);
    model.set_listener(this);
    judged_.reset();
    words_.clear();
    held_ = false;
    if (!off) return;
    for (at_ = 0; at_ < gone * kTicksPerBit; ++at_) model.tick(true);
    began_ -= at_;
    while (at_ < model.plan().bits() * kTicksPerBit) {
      tick();
      if (testing::Test::HasFailure()) return;
    }
  }

  // Bits of the last frame, as the RTL has sent them.
  std::string bits;

  mb4test::Block<Vdsl_line> block;
  Vdsl_line& m = block.model;
  LinkRules rules_;
  mb4test::Dice& random_;
  Judge judge_;
  Encoder encoder;
  Link model;
  std::uint64_t ticks = 0;
  std::uint64_t running = 0;
  std::set<Restart> seen;  // reasons

 private:
  void begin() {
    at_ = 0;
    any_edge_ = false;
    samples_.clear();
    bits.clear();
  }

  void clock(bool in) {
    m.line_i = in ? 1 : 0;
    take_verdict();
    m.eval();
    restarts_ += at::counts_t::kRestart.of(m.counts_o);
    illegal_words_ += at::counts_t::kIllegal.of(m.counts_o);
    block.clock();
    ++ticks;
  }

  void tick() {
    bool in = random_.below(2) != 0;
    if (at_ >= first_ && at_ - first_ < samples_.size()) in = samples_[at_ - first_];
    clock(in);
    model.tick(in);
    if (at_ == 0) {
      const LinkState state = model.state();
      ASSERT_EQ(StatusPort(m.status_o).state, static_cast<unsigned>(state));
      if (state == LinkState::kGap) encoder.begin();
      if (state >= LinkState::kStart) {
        first_ = model.plan().switch_bit() * kTicksPerBit + rules_.rx_start;
        samples_ = encoder.window(state);
      }
    }
    ASSERT_EQ(m.line_o != 0, model.out()) << "tick " << at_;
    ASSERT_EQ(m.drive_o != 0, model.enable()) << "tick " << at_;
    // The edge of SAMPLE.
    const bool edge = model.state() != LinkState::kGap && at_ == model.plan().sample_tick();
    ASSERT_EQ(m.sampled_o != 0, edge) << "tick " << at_;
    if (edge) sampled_ = ticks - 1;
    any_edge_ |= edge;
    if (at_ % kTicksPerBit == 4) bits += m.drive_o == 0 ? '.' : m.line_o != 0 ? '1' : '0';
    ++at_;
    look();
  }

  // A tick without a model: the driver is off.
  void still() {
    clock(random_.below(2) != 0);
    EXPECT_EQ(m.drive_o, 0);
    EXPECT_EQ(m.line_o, 1);
    EXPECT_EQ(m.ended_o, 0);
    EXPECT_EQ(StatusPort(m.status_o).state, 0U);
  }

  // Right from the clock behind `ends` on, up to the first word of the next frame; else anything.
  void take_verdict() {
    m.verdict_i = static_cast<std::uint8_t>(verdict_ ? *verdict_ : random_.below(32));
  }

  void look() {
    const AnswerPort answer(m.answer_o);
    if (answer.begins) judge_.begin();
    if (answer.valid) {
      verdict_.reset();
      EXPECT_EQ(answer.number, words_.size());
      words_.push_back(answer.word);
      judge_.take(answer.number, answer.word);
    }
    if (answer.ends) {
      if (answer.running) verdict_ = judge_.verdict(answer, StatusPort(m.status_o).identity);
      running_ = answer.running;
      place_ = answer.place;
    }
    if (m.ended_o != 0 && !held_) expect_frame(answer);
  }

  void expect_frame(const AnswerPort& answer) {
    ASSERT_TRUE(judged_) << "the RTL has judged a frame, the model has not";
    const LinkFrame frame = *judged_;
    judged_.reset();
    const StatusPort status(m.status_o);
    SCOPED_TRACE(testing::Message() << name_of(frame.state) << ", " << name_of(frame.restart));
    EXPECT_EQ(frame.sampled, sampled_ - began_);
    EXPECT_EQ(status.state, static_cast<unsigned>(frame.state));
    if (frame.restart != Restart::kNone) {
      ++resets_;
      reason_ = frame.restart;
    }
    EXPECT_EQ(restarts_, resets_);
    EXPECT_EQ(status.reason, static_cast<unsigned>(reason_));
    EXPECT_EQ(illegal_words_, illegal_ + model.illegal_words());
    EXPECT_EQ(answer.linked, frame.linked);
    EXPECT_EQ(running_, frame.state == LinkState::kRun);
    const bool training = frame.state < LinkState::kIdRequest;
    // Where a training frame fails, these are those of the next start.
    if (!training || frame.restart == Restart::kNone) {
      EXPECT_EQ(status.place >> 8U, frame.delay);
      EXPECT_EQ(status.place >> 5U, frame.sample_place);
      EXPECT_EQ(status.edges, model.edges());
    }
    if (!training) {
      EXPECT_EQ(status.rssi, frame.rssi);
      EXPECT_EQ(status.identity, model.identity() & 0xFFFFFU);
      if (frame.linked) {
        EXPECT_EQ(status.width + 8, model.position_bits());
      }
      const AnswerWords& w = frame.words;
      const Word* expected[] = {&w.vertical,          &w.parameter,        &w.pipeline,
                                &w.acceleration_high, &w.acceleration_low, &w.secondary};
      ASSERT_EQ(words_.size(), 6U);
      for (unsigned i = 0; i < 6; ++i) {
        EXPECT_EQ(words_[i].byte, expected[i]->byte) << "word " << i;
        EXPECT_EQ(words_[i].error, expected[i]->error) << "word " << i;
        EXPECT_EQ(words_[i].special, expected[i]->special) << "word " << i;
        EXPECT_EQ(words_[i].only_strict, expected[i]->only_strict) << "word " << i;
      }
    }
    if (frame.state == LinkState::kRun || frame.linked) {
      EXPECT_EQ(status.quality, frame.quality);
      EXPECT_EQ(status.low, frame.quality < 14);
    }
    if (frame.state == LinkState::kRun) {
      EXPECT_EQ(place_, frame.place);
      ++running;
    }
    seen.insert(frame.restart);
    words_.clear();
  }

  unsigned at_ = 0;  // tick of the frame
  unsigned first_ = 0;
  mb4test::DslSamples samples_;
  bool any_edge_ = false;
  // hold_i begins a new model. The RTL counts on.
  bool held_ = false;
  std::uint64_t resets_ = 0;
  std::uint64_t illegal_ = 0;
  // What the RTL has counted.
  std::uint64_t restarts_ = 0;
  std::uint64_t illegal_words_ = 0;
  std::uint64_t began_ = 0;  // the model
  Restart reason_ = Restart::kNone;
  std::optional<LinkFrame> judged_;
  std::optional<unsigned> verdict_;
  std::vector<Word> words_;
  std::uint64_t sampled_ = 0;
  bool running_ = false;
  unsigned place_ = 0;
};

std::string name_of_rule(const testing::TestParamInfo<SampleRule>& rule) {
  constexpr const char* kNames[] = {"Published", "FirstZero", "Tracking"};
  return kNames[static_cast<unsigned>(rule.param)];
}

class DslLineBlock : public testing::TestWithParam<SampleRule> {
 protected:
  LinkRules rules_at_random() {
    LinkRules rules;
    rules.sample = GetParam();
    if (random.below(2) == 0) return rules;
    rules.check = random.below(2) != 0 ? CodeCheck::kStrict : CodeCheck::kPublished;
    rules.quality = static_cast<QualityRules>(random.below(3));
    rules.rssi_table = random.below(2) != 0;
    rules.rx_start = random.below(16);
    rules.start_blocks = random.below(27);
    rules.acceleration_limit = random.below(32);
    rules.sdk_map = random.below(2) != 0;
    rules.strict_id = random.below(2) != 0;
    constexpr unsigned kLimits[] = {0, 1, 5, 64, 255};
    rules.vsync_limit = kLimits[random.below(5)];
    return rules;
  }
  mb4test::Dice random;
};

TEST_P(DslLineBlock, FramesAtRandom_AreThoseOfTheModel) {
  const std::uint64_t frames = mb4test::number("MB4_DSL_FRAMES", 6'000);
  std::uint64_t running = 0;
  std::uint64_t restarts = 0;
  std::set<Restart> seen;
  for (std::uint64_t frame = 0; frame < frames;) {
    Lines lines(random, rules_at_random());
    const std::uint64_t end = frame + 1'200;
    for (; frame < end; ++frame) {
      SCOPED_TRACE(testing::Message() << "frame " << frame);
      lines.frame();
      if (HasFailure()) return;
    }
    running += lines.running;
    restarts += lines.model.restarts();
    seen.merge(lines.seen);
  }
  EXPECT_GT(running, frames / 10);
  EXPECT_GT(restarts, frames / 200);
  EXPECT_EQ(seen.size(), 8U) << "each reason of a restart, and none: "
                             << testing::PrintToString(seen);
}

// PRST. What follows its end is a start like the first one.
TEST_P(DslLineBlock, HoldAtRandom_EndsTheFrameAndBeginsAStart) {
  Lines lines(random, rules_at_random());
  for (unsigned i = 0; i < 40; ++i) {
    SCOPED_TRACE(testing::Message() << "hold " << i);
    for (unsigned frames = random.below(random.below(2) != 0 ? 4 : 90); frames > 0; --frames) {
      lines.frame();
      if (HasFailure()) return;
    }
    lines.held_frame();
    if (HasFailure()) return;
  }
}

// The bits of a start in free run, as the facts print them.
TEST_P(DslLineBlock, StartUp_HasThePublishedBits) {
  LinkRules rules;
  rules.sample = GetParam();
  Lines lines(random, rules);
  lines.encoder.faults = false;
  lines.frame();
  EXPECT_EQ(lines.bits, std::string(16, '.') + std::string(16, '0'));
  constexpr struct {
    unsigned frames;
    const char* parameter;
    const char* equalisation;                 // of the first frame
  } kFrames[] = {{1, "0101001011", "0000"},   // RESET
                 {1, "0101001011", "1101"},   //
                 {1, "1001100100", "1101"},   // SYNC
                 {15, "1001100100", "0000"},  //
                 {9, "0101100100", "0000"},   // START
                 {9, "0010011011", "0000"},   // LEARN
                 {16, "1100001011", "0000"},  // CHECK
                 {1, "0100011011", "0000"},   // ID request
                 {3, "1000011101", "0000"},   // INIT
                 {8, "1001001101", "0000"},   // IDLE
                 {8, "1001000110", "0000"},   // with msync
                 {8, "1001001101", "0000"}};
  std::string pattern;
  while (pattern.size() < 74) pattern += "01";
  const std::string answer(74, '.');
  unsigned number = 0;
  for (const auto& [frames, parameter, equalisation] : kFrames) {
    for (unsigned i = 0; i < frames; ++i, ++number) {
      SCOPED_TRACE(testing::Message() << "frame " << number);
      lines.frame();
      if (HasFailure()) return;
      const bool start = number >= 18 && number < 27;
      EXPECT_EQ(lines.bits, std::string("001011110110") + equalisation + parameter +
                                (number < 18 ? pattern : answer) + "00000011" +
                                (start ? "001011001011001011001011" : ""));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Rules, DslLineBlock,
                         testing::Values(SampleRule::kPublished, SampleRule::kFirstZero,
                                         SampleRule::kTracking),
                         name_of_rule);

}  // namespace
