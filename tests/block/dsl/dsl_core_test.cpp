// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The whole master beside the model of one, tick by tick, with an encoder that moves, and a host
// that reads and writes all the time. Expected values are the model's, and the encoder's position.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "Vdsl_core.h"
#include "sim/core/random.hpp"
#include "sim/lines/dsl/dsl_code.hpp"
#include "sim/masters/dsl_model/link.hpp"
#include "tests/block/dsl/dsl_frames.hpp"
#include "tests/block/dsl/dsl_registers.hpp"
#include "tests/block/dsl/dsl_waveform.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/model_context.hpp"

namespace {

using namespace mb4::sim::dsl_model;
namespace dsl_line = mb4::sim::dsl;
namespace map = dsl::regs;
namespace page = dsl::page;
using dsl_registers::kGroups;
using dsl_registers::kWords;
using dsl_registers::Record;
using dsl_registers::WordOfRecord;

constexpr std::uint32_t kNever = 0xFFFF'FFFF;
constexpr unsigned kResetClocks = 2;  // from rst_ni to the first clock without reset

// ---- The encoder --------------------------------------------------------------------------------

// Moves at random, and is not always right.
class Encoder {
 public:
  explicit Encoder(mb4test::Dice& random) : random_(random) {}
  bool faults = true;
  std::uint64_t position = 0;
  std::uint64_t mask = 0;
  bool marked = false;  // it has told the master less than it moved
  bool lied = false;    // a wrong word may have passed the checks: two bits were flipped

  void begin() {
    const unsigned fate = faults ? starts_++ % 6 : 5;
    frames_ = inits_ = place_ = running_ = 0;
    wrong_frame_ = fate == 0 ? 9 + random_.below(25) : ~0U;
    wrong_identity_ = fate == 1;
    width_ = faults ? 20 + random_.below(21) : 32;
    signed_ = random_.below(2) != 0;
    mask = (std::uint64_t{1} << width_) - 1;
    position = noise_.next();
    speed_ = static_cast<std::int64_t>(random_.below(1000)) - 500;
    timing_ = {.begin = 20 * 16 + static_cast<int>(random_.below(9 * 128)),
               .jitter = random_.below(12)};
    life_ = faults ? 20 + random_.below(250) : ~0U;
    constexpr unsigned kRare[] = {0, 100, 30, 12};
    rare_ = faults ? kRare[random_.below(4)] : 0;
    marked = lied = false;
  }

  void silence() { life_ = 0; }
  mb4test::DslSamples window(LinkState state) {
    if (state == LinkState::kRun && running_ > life_) {
      return mb4test::DslSamples(Receiver::kSamples, true);
    }
    return mb4test::samples_of(answer_of(state), timing_, random_);
  }

 private:
  bool dice(unsigned among) { return random_.below(among) == 0; }

  Answer answer_of(LinkState state) {
    if (state <= LinkState::kCheck) {
      const bool wrong = frames_++ == wrong_frame_;
      return kTestPattern ^ (wrong ? Answer{1} << random_.below(kAnswerBits) : 0);
    }
    if (state == LinkState::kIdRequest) {
      const unsigned id =
          (signed_ ? 1U << 10U : 0U) | (width_ - 11) << 4U | 3U | (wrong_identity_ ? 4U : 0U);
      return words(id & 0xFFU, id >> 8U & 0xFFU, 0, (id & 0xFF00U) | (id & 0xFFU), 0x1C, false);
    }
    return data(state == LinkState::kRun);
  }

  Answer words(unsigned vertical, unsigned parameter, unsigned pipeline, unsigned acceleration,
               unsigned secondary, bool mark) {
    dsl_line::Coder coder(dice(2));
    const auto byte = [&coder](unsigned value) {
      return coder.data(static_cast<std::uint8_t>(value));
    };
    const auto half = [&](unsigned value) { return mark ? coder.special(kMarker1) : byte(value); };
    Answer all = byte(vertical);
    all = all << 10U | byte(parameter);
    all = all << 10U | byte(pipeline);
    all = all << 10U | half(acceleration >> 8U);
    all = all << 10U | half(acceleration & 0xFFU);
    all = all << 1U | random_.below(2);
    return all << 10U | byte(secondary);
  }

  Answer data(bool running) {
    const bool vsync = running ? place_ == 7 : ++inits_ == 3;
    int next = static_cast<int>(random_.below(401)) - 200;
    if (speed_ > 3000) next = -200;
    if (speed_ < -3000) next = 200;
    if (!running) next = 0;
    const std::uint64_t before = position;
    if (running) {
      ++running_;
      speed_ += next;
      position += static_cast<std::uint64_t>(speed_);
      if (place_ == 0) {
        std::uint64_t sent = before & mask;
        if (signed_ && (sent >> (width_ - 1)) != 0) sent |= ~mask;
        const unsigned summary = dice(4) ? random_.below(256) : 0;
        safe_ = {dsl_frames::safe_bytes(summary, sent),
                 dsl_frames::safe_bytes(0x1C | random_.below(2) << 7U, ~sent)};
      }
    }
    const bool bad = running && rare_ != 0 && dice(rare_);
    const bool mark = bad && dice(4);
    marked |= mark;
    Answer answer = words(safe_[0][place_], (vsync ? 0x80U : 0U) | 0x10U, random_.below(256),
                          dsl_line::with_check(next), safe_[1][place_], mark);
    if (bad && !mark) {
      answer ^= Answer{1} << random_.below(kAnswerBits);
      if (dice(4)) {
        answer ^= Answer{1} << random_.below(kAnswerBits);
        lied = true;
      }
    }
    if (running) place_ = (place_ + 1) % 8;
    return answer;
  }

  mb4test::Dice& random_;
  mb4::sim::Random noise_{11};
  unsigned starts_ = 0;
  unsigned width_ = 32;
  bool signed_ = false;
  std::int64_t speed_ = 0;
  mb4test::DslTiming timing_;
  unsigned frames_ = 0, wrong_frame_ = ~0U, inits_ = 0, place_ = 0, running_ = 0;
  unsigned life_ = ~0U, rare_ = 0;
  bool wrong_identity_ = false;
  std::array<dsl_frames::SafeBytes, 2> safe_{};
};

// ---- Both masters, and the host -----------------------------------------------------------------

class DslCoreBlock : public testing::TestWithParam<bool>, public LinkListener {
 protected:
  DslCoreBlock() { model.set_listener(this); }
  bool sdk() const { return GetParam(); }

  void start(const LinkRules& given) {
    rules = given;
    rules.sdk_map = sdk();
    model = Link(rules);
    model.set_listener(this);
    m.quirks_i = dsl_frames::quirks_of(rules);
    m.word_req_i = 0;
    m.dsl_in_i = 1;
    block.clock();
    m.rst_ni = 1;
    for (unsigned i = 0; i < kResetClocks; ++i) block.clock();
  }

  void answered(const LinkFrame& frame) override {
    // A frame that wakes nobody else has no record.
    if (frame.state == LinkState::kRun) {
      EXPECT_FALSE(pending) << "a record has not come";
      pending = frame;
      sampled_position = encoder.position & encoder.mask;
    }
    if (frame.state == LinkState::kIdRequest && frame.linked) {
      known = false;  // the record of the link that begins
      ages = {kNever, kNever};
    }
    if (frame.linked || frame.state == LinkState::kRun) {
      if (frame.quality < 14) events |= unsigned{map::QMLW::kMask} << 8U;
    }
    if (frame.state == LinkState::kRun && frame.lost && !lost_before) events |= map::POS::kMask;
    lost_before = frame.lost;
    restarted |= frame.restart != Restart::kNone;
    seen.insert(frame.restart);
  }

  void tick() {
    bool in = random.below(2) != 0;
    if (at >= first && at - first < samples.size()) in = samples[at - first];
    m.dsl_in_i = in ? 1 : 0;
    m.eval();
    const bool ready = m.position_ready_o != 0;
    block.clock();
    ++now;
    if (held) return;
    model.tick(in);
    if (at == 0) frame_begins();
    ASSERT_EQ(m.dsl_out_o != 0, model.out()) << "tick " << at;
    ASSERT_EQ(m.dsl_en_o != 0, model.enable()) << "tick " << at;
    if (++at == model.plan().bits() * kTicksPerBit) {
      at = 0;
      ++frames;
    }
    if (ready) take_record();
  }
  void frame_begins() {
    const LinkState state = model.state();
    if (state == LinkState::kGap) encoder.begin();
    if (state == LinkState::kReset && before == LinkState::kGap) events |= map::EVENT_PRST::kMask;
    // The channel of messages is free.
    if (state == LinkState::kRun && before != LinkState::kRun) {
      events |= (map::FREL::kMask | map::FRES::kMask) << 8U;
    }
    before = state;
    first = ~0U;
    if (state < LinkState::kStart) return;
    first = model.plan().switch_bit() * kTicksPerBit + rules.rx_start;
    samples = encoder.window(state);
  }

  // The position is not certain, and no safe one has come.
  static Record before_any_link() {
    Record r{};
    r[20] = 1;
    std::fill(r.begin() + 48, r.begin() + 56, 0xFF);
    return r;
  }
  // The record of the frame that the model has judged.
  void take_record() {
    ASSERT_TRUE(pending);
    const LinkFrame f = *pending;
    pending.reset();
    for (std::uint32_t& age : ages) age += age == kNever ? 0 : 1;
    if (f.safe1_new) ages[0] = 0;
    if (f.safe_new && f.safe2.valid) ages[1] = 0;
    if (!f.lost && !encoder.lied) {
      ++certain;
      EXPECT_EQ(f.position, sampled_position) << "frame " << f.number;
    }
    Record r{};
    const auto put = [&r](unsigned place, std::uint64_t value, unsigned bytes) {
      for (unsigned i = 0; i < bytes; ++i) {
        r[place + i] = static_cast<std::uint8_t>(value >> 8 * i);
      }
    };
    const unsigned bits = model.position_bits();
    const bool negative =
        (model.identity() >> 10U & 1U) != 0 && (f.position >> (bits - 1) & 1U) != 0;
    put(0, f.position, 5);
    put(8, static_cast<std::uint64_t>(f.speed), 5);
    put(16, f.number, 4);
    const bool error = f.safe1.error || f.safe2.error;
    const auto bit = [](bool level, unsigned place) { return (level ? 1U : 0U) << place; };
    put(20,
        bit(f.lost, 0) | bit(f.linked, 1) | 4U | bit(f.safe1.valid, 3) | bit(f.safe2.valid, 4) |
            bit(error, 5) | bit(f.safe1.error, 6) | bit(f.safe2.error, 7),
        1);
    put(21, f.delay << 4U | f.quality, 1);
    put(22, 8, 1);
    put(23, static_cast<unsigned>(model.last_restart()), 1);
    put(24, f.sampled + 1, 8);  // the edge is at the pin behind this clock
    put(32, f.safe1.position, 5);
    put(37, f.safe1.summary, 1);
    put(38, f.safe1.crc, 2);
    put(40, f.safe2.position, 5);
    put(45, f.safe2.summary, 1);
    put(46, f.safe2.crc, 2);
    put(48, ages[0], 4);
    put(52, ages[1], 4);
    put(56, f.position | (negative ? ~((std::uint64_t{1} << bits) - 1) : 0), 8);
    newest = r;
    // The next state may have begun when the record of a last frame is made.
    known = f.restart == Restart::kNone;
    if (!known) last_record = r;
    ++records;
    const bool sum = f.safe1_new && f.safe1.summary != 0;
    const bool vpos = f.safe_new && f.safe1.marked;
    events |= (sum ? map::SUM::kMask : 0U) | (f.safe_new && error ? map::SCE::kMask : 0U) |
              (vpos ? map::VPOS::kMask : 0U) | (f.lost && f.linked ? map::POS::kMask : 0U);
  }

  // ---- The host
  std::uint32_t read(unsigned address) {
    return dsl_registers::access(m, address & ~3U, false, 0, 0xF, [this] { tick(); });
  }
  std::uint8_t read_byte(unsigned address) {
    return static_cast<std::uint8_t>(read(address) >> 8 * (address & 3U));
  }
  void write(unsigned address, std::uint32_t data, unsigned strobes) {
    dsl_registers::access(m, address, true, data, strobes, [this] { tick(); });
  }

  // A word of a record: of the copy, or of what was the newest record before or behind the read.
  void read_record(const WordOfRecord& word) {
    const std::optional<Record> old = known ? std::optional(newest) : std::nullopt;
    const std::uint64_t count = records;
    const bool was_known = known;
    const std::uint32_t value = read(word.address) & dsl_registers::bits_of_group(word);
    if (HasFatalFailure()) return;
    if (dsl_registers::is_first(word)) {
      copies[word.group].reset();
      if (!was_known || !known) return;
      if (count == records)
        copies[word.group] = old;
      else if (value == dsl_registers::word_of(word, *old) &&
               value == dsl_registers::word_of(word, newest))
        return;  // either of them
      else
        copies[word.group] = value == dsl_registers::word_of(word, *old) ? *old : newest;
      mixed += count == records ? 0 : 1;
    }
    if (!copies[word.group]) return;
    ASSERT_EQ(value, dsl_registers::word_of(word, *copies[word.group]))
        << std::hex << word.address << std::dec << " frame " << newest[16];
    ++checked;
  }
  // All words of a group, with time in between.
  void read_group(unsigned group, unsigned pause) {
    for (const WordOfRecord& word : kWords) {
      if (word.group != group) continue;
      read_record(word);
      for (unsigned i = random.below(pause + 1); i != 0; --i) tick();
      if (HasFatalFailure()) return;
    }
  }

  // Right behind a record: what is of now.
  void look_at_state() {
    const std::uint64_t count = records;
    for (unsigned i = 0; records == count; ++i) {
      if (i > 60'000) return;
      tick();
      if (HasFatalFailure()) return;
    }
    tick();
    if (!known || at > 600) return;
    const std::uint32_t now_bits = events;
    ASSERT_EQ(read(map::kAddrEventH) & 0xFFFFU, now_bits);
    const std::uint32_t status = read(page::kAddrStatus);
    ASSERT_EQ(status & 0xFFFF'FF3FU, newest[20] % 64U | newest[21] << 8U | newest[22] << 16U |
                                         std::uint32_t{newest[23]} << 24U);
    ASSERT_EQ(read(page::kAddrRestarts),
              (model.illegal_words() & 0xFFFFU) << 16U | (model.restarts() & 0xFFFFU));
    ASSERT_EQ(read_byte(map::kAddrMasterQm), 0x80U | (newest[21] & 0xFU));
    ASSERT_EQ(read_byte(map::kAddrEdges), model.edges());
    ASSERT_EQ(read_byte(map::kAddrDelay), model.frame().rssi << 4U | model.frame().delay);
    const std::uint32_t id = model.identity();
    ASSERT_EQ(read(map::kAddrEncId2) >> 8U,
              (id >> 16U & 0xFU) | (id & 0xFF00U) | (id & 0xFFU) << 16U);
    ASSERT_EQ(read_byte(map::kAddrSafeSum), sdk() ? newest[37] : 0);
    if (records != count + 0 && records > count + 1) return;
    // Some of the events are cleared.
    const unsigned keep = random.below(1U << 16U);
    const std::uint32_t events_before = events;
    write(map::kAddrEventH, keep, 0x3);
    ASSERT_EQ(events, events_before) << "an event within the write";
    events &= keep;
    ++states;
  }

  mb4test::Dice random;
  mb4test::Block<Vdsl_core> block;
  Vdsl_core& m = block.model;
  LinkRules rules;
  Link model{rules};
  Encoder encoder{random};
  std::uint64_t now = 0;
  std::uint64_t frames = 0;
  unsigned at = 0;
  unsigned first = ~0U;
  mb4test::DslSamples samples;
  LinkState before = LinkState::kGap;
  bool held = false;  // the model does not know what the host has done

  std::optional<LinkFrame> pending;
  std::uint64_t sampled_position = 0;
  Record newest = before_any_link();
  bool known = false;
  std::array<std::uint32_t, 2> ages{kNever, kNever};
  std::array<std::optional<Record>, kGroups> copies;
  std::uint32_t events = 0;
  bool lost_before = true;
  bool restarted = false;
  std::set<Restart> seen;
  Record last_record{};  // of the frame that has ended the link
  std::uint64_t records = 0, checked = 0, mixed = 0, states = 0, certain = 0;
};

TEST_P(DslCoreBlock, FramesAtRandom_AreThoseOfTheModel) {
  const std::uint64_t all = mb4test::number("MB4_DSL_FRAMES", 3'000);
  LinkRules given;
  given.recover = !sdk();
  given.stale_limit = sdk() ? 0 : 2;
  given.quality = sdk() ? QualityRules::kFirmware : QualityRules::kSick;
  given.acceleration_limit = 2;
  start(given);
  write(sdk() ? map::kAddrAccErrCntThresh & ~3U : map::kAddrAccErrCnt & ~3U, 0x0202,
        sdk() ? 0x2 : 0x1);
  write(map::kAddrMaskSum, 0xFF, 0x1);
  while (frames < all) {
    SCOPED_TRACE(testing::Message() << "frame " << frames);
    switch (random.below(6)) {
      case 0:
        look_at_state();
        break;
      case 1:
        for (unsigned i = random.below(3000); i != 0 && !HasFailure(); --i) tick();
        break;
      case 2:
        read_group(random.below(kGroups), 900);
        break;
      case 3:
        read_group(random.below(kGroups), 3);
        break;
      case 4:
        // While a record comes.
        for (unsigned i = 0; !pending && i < 2000 && !HasFailure(); ++i) tick();
        for (const unsigned group = random.below(kGroups); pending && !HasFailure();) {
          read_group(group, 0);
        }
        break;
      default:
        read_record(kWords[random.below(std::size(kWords))]);
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(records, all / 4);
  EXPECT_GT(checked, all / 2);
  EXPECT_GT(mixed, all / 200);
  EXPECT_GT(states, all / 100);
  EXPECT_GT(certain, all / 20);
  EXPECT_GT(seen.size(), 3U) << testing::PrintToString(seen);
  RecordProperty("records", static_cast<int>(records));
  RecordProperty("certain", static_cast<int>(certain));
}

// Two readers take turns at random, one on the byte map, one on the window, while the encoder
// moves: what each of them reads between two first words is of one frame.
TEST_P(DslCoreBlock, ReadersOfMapAndWindowInTurns_EachGetOneFrame) {
  const std::uint64_t pairs = mb4test::number("MB4_DSL_PAIRS", 2'000);
  start({});
  encoder.faults = false;
  while (!known && !HasFailure()) tick();
  const auto words_of = [](unsigned group) {
    std::vector<const WordOfRecord*> words;
    for (const WordOfRecord& word : kWords) {
      if (word.group == group) words.push_back(&word);
    }
    return words;
  };
  std::uint64_t moved = 0;
  for (std::uint64_t pair = 0; pair < pairs && !HasFailure(); ++pair) {
    SCOPED_TRACE(testing::Message() << "pair " << pair);
    const std::array readers{words_of(random.below(3)), words_of(3 + random.below(3))};
    std::array<std::size_t, 2> next{};
    const std::uint64_t count = records;
    const unsigned pause = random.below(4) == 0 ? 1200 : 60;  // a frame has 864 clocks
    while (next[0] < readers[0].size() || next[1] < readers[1].size()) {
      std::size_t who = random.below(2);
      if (next[who] == readers[who].size()) who = 1 - who;
      read_record(*readers[who][next[who]++]);
      if (HasFailure()) return;
      for (unsigned i = random.below(pause); i != 0 && !HasFailure(); --i) tick();
    }
    moved += records != count ? 1 : 0;
  }
  // A record came in between for a part of them, and most words have been compared.
  EXPECT_GT(moved, pairs / 5);
  EXPECT_GT(checked, pairs * 4);
  RecordProperty("pairs", static_cast<int>(pairs));
  RecordProperty("moved", static_cast<int>(moved));
}

// Each address before the first link ends its start, and while nobody answers.
TEST_P(DslCoreBlock, AfterReset_EachAddressHasItsResetValue) {
  start({});
  auto expected = dsl_registers::reset_words(sdk());
  if (sdk()) expected[page::kAddrFeatures] |= 1U << 3U;
  for (unsigned address = 0; address < 0x200; address += 4) {
    // The state goes on, and so does the time.
    if (address == page::kAddrTimeLow) continue;
    const std::uint32_t ignored = address == page::kAddrStatus ? 0x000F'0000U : 0U;
    const auto word = expected.find(address);
    const std::uint32_t value = now < 16 * 2 * kTicksPerBit || address != map::kAddrEventH
                                    ? (word == expected.end() ? 0U : word->second)
                                    : std::uint32_t{map::EVENT_PRST::kMask};
    ASSERT_EQ(read(address) & ~ignored, value) << std::hex << address;
  }
}

TEST_P(DslCoreBlock, Time_CountsClocks) {
  start({});
  for (unsigned i = 0; i < 50; ++i) {
    const std::uint64_t begin = now;
    const std::uint32_t low = read(page::kAddrTimeLow);
    ASSERT_GE(low, begin);
    ASSERT_LT(low, now);
    ASSERT_EQ(read(page::kAddrTimeHigh), 0U);
    for (unsigned rest = random.below(3000); rest != 0; --rest) tick();
  }
}

// R1, R19: no safe position is valid, or young, when the link is gone. What the last frame has told
// is of its end, although the next frame begins before its record is made.
TEST_P(DslCoreBlock, LinkLost_SafePositionsAreNotValid) {
  start({});
  encoder.faults = false;
  for (unsigned frame = 0; !known && !HasFailure();) {
    tick();
    frame += at == 0 ? 1 : 0;
    ASSERT_LT(frame, 100U);
  }
  for (const std::uint64_t count = records; records < count + 40 && !HasFailure();) tick();
  ASSERT_EQ(read(page::kAddrStatus) & 0x1FU, 0x1EU);
  read(page::kAddrSafe1Lo);
  ASSERT_LT(read(page::kAddrSafe1Lo + 12), 8U);
  encoder.silence();
  while (known && !HasFailure()) tick();
  // The record of the last frame.
  for (unsigned i = 0; i < 4; ++i) tick();
  EXPECT_EQ(read(page::kAddrPosLo), last_record[0] | last_record[1] << 8U | last_record[2] << 16U |
                                        std::uint32_t{last_record[3]} << 24U);
  EXPECT_EQ(read(page::kAddrFrameStatus) & 0x000F'001FU, 0x0008'0005U);
  const unsigned reason = static_cast<unsigned>(model.last_restart());
  EXPECT_EQ(read(page::kAddrFrameStatus) >> 24U, reason);
  for (unsigned turn = 0; turn < 3; ++turn) {
    for (unsigned i = 0; i < 400; ++i) tick();
    EXPECT_EQ(read(page::kAddrStatus) & 0x1BU, 1U);
    for (const unsigned address : {page::kAddrSafe1Lo, page::kAddrSafe2Lo}) {
      read(address);
      EXPECT_EQ(read(address + 8) >> 31U, 0U);
      EXPECT_EQ(read(address + 12), kNever);
    }
    read(page::kAddrPosLo);
    EXPECT_EQ(read(page::kAddrFrameStatus) & 0x1BU, 1U);
  }
}

// PRST: a level that holds the driver off, or a pulse of the SDK; a new start in both.
TEST_P(DslCoreBlock, Prst_BeginsANewStart) {
  start({});
  encoder.faults = false;
  while (!known && !HasFailure()) tick();
  ASSERT_EQ(m.link_o, 1);
  write(map::kAddrEventH, 0, 3);
  held = true;
  write(map::kAddrSysCtrl, map::PRST::kMask, 1);
  for (unsigned i = 0; i < 4; ++i) tick();
  EXPECT_EQ(m.link_o, 0);
  EXPECT_EQ(read_byte(map::kAddrSysCtrl), sdk() ? 0 : map::PRST::kMask);
  if (!sdk()) {
    for (unsigned i = 0; i < 900; ++i) tick();
    for (unsigned i = 0; i < 5000; ++i) {
      tick();
      ASSERT_EQ(m.dsl_en_o, 0);
    }
    EXPECT_EQ(read(page::kAddrStatus) >> 16U & 0xFU, 0U);
    EXPECT_EQ(read_byte(map::kAddrEventH) & map::EVENT_PRST::kMask, 0);
    write(map::kAddrSysCtrl, 0, 1);
  }
  // The frame's end, 16 bits without a driver, 16 zeros, RESET.
  unsigned off = 0;
  for (unsigned i = 0; (read(page::kAddrStatus) >> 16U & 0xFU) != 1; ++i) {
    ASSERT_LT(i, 300U);
    off += m.dsl_en_o == 0 ? 1 : 0;
  }
  EXPECT_GT(off, 5U);
  EXPECT_EQ(read_byte(map::kAddrEventH) & map::EVENT_PRST::kMask, map::EVENT_PRST::kMask);
  // The host asked for it: no restart that counts.
  EXPECT_EQ(read(page::kAddrRestarts) & 0xFFFFU, 0U);
}

TEST_P(DslCoreBlock, Oen_KeepsTheDriverOff) {
  start({});
  held = true;
  write(map::kAddrSysCtrl, map::OEN::kMask, 1);
  unsigned moved = 0;
  for (unsigned i = 0; i < 5000; ++i) {
    tick();
    ASSERT_EQ(m.dsl_en_o, 0);
    moved += m.dsl_out_o;
  }
  EXPECT_GT(moved, 100U);
  write(map::kAddrSysCtrl, 0, 1);
  unsigned on = 0;
  for (unsigned i = 0; i < 2000; ++i) {
    tick();
    on += m.dsl_en_o;
  }
  EXPECT_GT(on, 500U);
}

// One interrupt a frame, cleared each time; without that bit 4 tells of frames that were missed.
TEST_P(DslCoreBlock, Interrupt_OfEachFrame) {
  start({});
  encoder.faults = false;
  while (!known && !HasFailure()) tick();
  for (unsigned wait = 0; wait < 8; ++wait) tick();
  constexpr unsigned kOfFrames = page::FRAME_ENDED::kMask | page::FRAME_LOST::kMask;
  write(page::kAddrIrqStatus, 0x1F, 1);
  write(page::kAddrIrqEnable, page::FRAME_ENDED_ENABLE::kMask, 1);
  for (unsigned i = 0; i < 40; ++i) {
    const std::uint64_t count = records;
    ASSERT_EQ(m.irq_o, 0);
    while (records == count && !HasFailure()) tick();
    for (unsigned wait = 0; wait < 8; ++wait) tick();
    ASSERT_EQ(m.irq_o, 1);
    ASSERT_EQ(read(page::kAddrIrqStatus) & kOfFrames, page::FRAME_ENDED::kMask);
    read_group(3, 0);
    write(page::kAddrIrqStatus, page::FRAME_ENDED::kMask, 1);
  }
  for (const std::uint64_t count = records; records < count + 2;) tick();
  for (unsigned wait = 0; wait < 8; ++wait) tick();
  EXPECT_EQ(read(page::kAddrIrqStatus) & kOfFrames, kOfFrames);
}

INSTANTIATE_TEST_SUITE_P(Maps, DslCoreBlock, testing::Values(false, true),
                         [](const auto& sdk) { return sdk.param ? "Sdk" : "Ours"; });

}  // namespace
