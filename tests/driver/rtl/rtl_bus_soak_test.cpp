// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// A drive that runs for long on a bad SPI bus, on the Verilated chip: in each call at most one
// fault, a flipped bit or a transfer that stores nothing; the encoder's plug is pulled at any
// instant of a frame and put back; registers are read and written beside the positions.
//
// A word that the plug has cut and whose CRC fits all the same is the protocol's limit (one in 64
// for a CRC of 6 bits). It is counted apart, and only if the recorded line has carried just these
// bits.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/line.hpp"
#include "tests/driver/rtl/sweep_rig.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/environment.hpp"

namespace {

using namespace mb4test;  // NOLINT: the rig

// The bits of SL at the rising edges of MA, by frame.
class Recorder {
 public:
  struct Frame {
    std::vector<bool> bits;
    std::optional<std::size_t> cut;  // the plug has moved while this bit was on the line
  };

  explicit Recorder(sim::Simulator& simulator) : simulator_(simulator) {
    clocked(simulator.line(1))->set_tap(&Recorder::tap, this);
  }
  void plug_moves() {
    if (frames_.empty() || simulator_.now() - last_edge_ > kGap) return;
    frames_.back().cut = frames_.back().bits.size();
  }

  // A frame that the plug has cut and whose bits are `word` of 28 bits and its CRC. The bit that
  // was on the line meanwhile, and its neighbours, may be either.
  [[nodiscard]] bool has(std::uint64_t word, std::uint16_t crc) const {
    const std::uint64_t want = word << 6U | (~std::uint64_t{crc} & 0x3FU);  // inverted on the line
    for (const Frame& frame : frames_) {
      if (!frame.cut) continue;
      std::size_t at = 0;
      while (at < frame.bits.size() && frame.bits[at]) ++at;   // before the acknowledge
      while (at < frame.bits.size() && !frame.bits[at]) ++at;  // until the start bit
      at += 2;                                                 // start bit, CDS
      bool same = !frame.bits.empty();
      for (std::size_t i = 0; i < 34 && same; ++i, ++at) {
        const bool is = at < frame.bits.size() ? frame.bits[at] : frame.bits.back();
        const bool moves = at + 1 >= *frame.cut && at <= *frame.cut + 1;
        same = moves || is == ((want >> (33 - i) & 1U) != 0);
      }
      if (same) return true;
    }
    return false;
  }

 private:
  static constexpr sim::Time kGap = 2 * sim::kPsPerUs;

  static void tap(sim::Time now, void* self, sim::ClockedLine::Signal signal, bool level) {
    static_cast<Recorder*>(self)->take(now, signal, level);
  }
  void take(sim::Time now, sim::ClockedLine::Signal signal, bool level) {
    if (signal == sim::ClockedLine::Signal::kSl) sl_ = level;
    if (signal != sim::ClockedLine::Signal::kMa || level == ma_) return;
    ma_ = level;
    if (!level) return;
    if (frames_.empty() || now - last_edge_ > kGap) {
      frames_.emplace_back();
      if (frames_.size() > 8) frames_.pop_front();
    }
    frames_.back().bits.push_back(sl_);
    last_edge_ = now;
  }

  sim::Simulator& simulator_;
  bool ma_ = true;
  bool sl_ = true;
  sim::Time last_edge_ = 0;
  std::deque<Frame> frames_;
};

class SoakRig : public Rig {
 public:
  SoakRig(const Setup& setup, std::uint64_t seed)
      : Rig(setup), recorder_(simulator), random_(seed) {
    bus.at_random(&random_, 1000);
  }

  void run(std::uint64_t ticks) {
    for (std::uint64_t i = 0; i < ticks; ++i) {
      plug();
      next_call();
      read();
      next_call();
      access();
      next_call();
      if (last_error_ == Error::kCorrupted || i % 500 == 499) check();
      next_call();
      recover();
      judge_registers();
    }
    bus.at_random(nullptr, 1000);
    next_call();
    move_plug(sim::ClockedLine::kPlug);
    simulator.advance(200 * sim::kPsPerUs);
    check();
    give_up();
    restart();
    good_ = 0;
    no_word_ = false;
    for (unsigned i = 0; i < 20; ++i) read();
    conclude();
  }

  std::uint64_t unplugged = 0;
  std::uint64_t accesses = 0;
  std::uint64_t failed_accesses = 0;
  std::uint64_t configured = 0;
  std::uint64_t restarts = 0;
  [[nodiscard]] std::uint64_t left_open_accesses() const { return left_open_; }
  [[nodiscard]] const mb4_counts& total() const { return counts_; }

 protected:
  [[nodiscard]] bool cut_on_the_line(const Word& word) const override {
    return recorder_.has(word.raw, word.crc);
  }
  // The banks were swapped by one bit of the read before.
  [[nodiscard]] bool may_be_old() override {
    const bool open = swapped_at_ && tick_number_ <= *swapped_at_ + 1;
    left_open_ += open ? 1 : 0;
    return open;
  }
  // A write that has ended in the middle of a byte: the frames behind bring zeros, as CDM rests,
  // and the encoder takes them as the rest of the byte, and as its CRC. It fits for one byte in 16.
  [[nodiscard]] bool cut_write(std::uint8_t now, std::uint8_t named) const override {
    const std::string word = mb4test::word_on_line(now, 8, mb4test::crc_choice(0x04), 0);
    const bool fits = word.substr(8) == "0000";
    for (unsigned bits = 0; bits < 8 && failed_write_ && fits; ++bits) {
      if (now == (named & (0xFF00U >> bits & 0xFFU))) return true;
    }
    return false;
  }

 private:
  // An access that begins meanwhile may take the end of a foreign one for its own.
  static constexpr std::uint64_t kOpenTicks = 100;

  std::uint64_t below(std::uint64_t limit) { return random_() % limit; }

  // A fault may come again.
  void next_call() {
    Transfer hit;
    const MeanFault* fault = bus.struck(hit);
    const Verdict opens = fault != nullptr ? left_open(setup_.check, *fault, hit) : Verdict::kRight;
    if (opens == Verdict::kUntrue) open_until_ = tick_number_ + kOpenTicks;
    if (opens == Verdict::kOld) swapped_at_ = tick_number_;
    bus.plan({});
  }

  void move_plug(sim::LineAction action) {
    recorder_.plug_moves();
    simulator.line(1)->act(simulator.now(), action);
    simulator.refresh_lines();
  }
  // Pulls or puts back the plug within this period, mostly while a frame runs.
  void plug() {
    if (pulled_ != 0 && --pulled_ == 0) {
      at_some_time(back_action_);
    } else if (pulled_ == 0 && below(300) == 0) {
      constexpr std::array kWays{sim::ClockedLine::kUnplug, sim::ClockedLine::kSlLow,
                                 sim::ClockedLine::kSlHigh};
      const sim::LineAction way = kWays[below(kWays.size())];
      back_action_ =
          way == sim::ClockedLine::kUnplug ? sim::ClockedLine::kPlug : sim::ClockedLine::kSlFree;
      pulled_ = 2 + below(30);
      ++unplugged;
      at_some_time(way);
    }
  }
  void at_some_time(sim::LineAction action) {
    const sim::Time period = period_time();
    // The loop ticks a third of a period after the start of a frame.
    const sim::Time from = below(4) == 0 ? below(period) : period * 2 / 3 + below(period / 10);
    simulator.at(simulator.now() + from, [this, action] { move_plug(action); });
  }

  void recover() {
    if (!device.configured()) {
      configure();
      ++configured;
    }
    if (last_error_ == Error::kTimeout || last_error_ == Error::kLineError ||
        last_error_ == Error::kWrongMode || !device.automatic().running()) {
      give_up();
      next_call();
      restart();
      ++restarts;
      next_call();
    }
  }
  void check() {
    bool good = true;
    call_stack().run(bus, [&] { good = device.verify().ok(); });
    next_call();
  }

  // One step of a register access; a write and a read in turns.
  void access() {
    if (!running_) {
      if (!device.automatic().running()) return;
      // A write that has failed, and may still come to its end, is made again as it was.
      if (writes_ && !failed_write_) {
        for (std::uint8_t& value : values_) value = static_cast<std::uint8_t>(below(256));
        named_ = values_;
      }
      failed_write_ = failed_write_ || writes_;
      const Result<void> planned = writes_
                                       ? device.control().plan_write(step_, {1, 0}, kNamed, values_)
                                       : device.control().plan_read(step_, {1, 0}, 0x44, back_);
      if (!planned) return;
      running_ = true;
      return;
    }
    if (!device.finish(step_, step_.run(bus), clock.now_us())) return;
    running_ = false;
    const bool done = step_.result().ok();
    accesses += done ? 1 : 0;
    failed_accesses += done ? 0 : 1;
    if (writes_) failed_write_ = !done;
    const sim::Slave& slave = *simulator.slave(1);
    for (unsigned i = 0; i < kNamedCount && done; ++i) {
      if (writes_ ? slave.reg_read(static_cast<std::uint8_t>(kNamed + i)) != values_[i]
                  : slave.reg_read(static_cast<std::uint8_t>(0x44 + i)) != back_[i]) {
        untrue(writes_ ? "nothing was written" : "another value was read");
      }
    }
    writes_ = failed_write_ || !writes_;
  }
  void untrue(const char* what) {
    if (tick_number_ < open_until_) {
      ++left_open_;
      note(std::string("left open: ") + what);
    } else {
      raise(Verdict::kUntrue, what);
    }
  }
  void give_up() {
    if (!running_) return;
    while (!device.finish(step_, false, clock.now_us())) {
    }
    running_ = false;
  }
  void judge_registers() {
    const Verdict before = verdict;
    judge_slaves();
    if (verdict > before) return;
    // What a named write has done is the state from now on.
    sim::Slave& slave = *simulator.slave(1);
    for (unsigned i = 0; i < kNamedCount; ++i) {
      registers_[0][kNamed + i] = slave.reg_read(static_cast<std::uint8_t>(kNamed + i));
    }
  }

  Recorder recorder_;
  std::mt19937_64 random_;
  std::uint64_t pulled_ = 0;  // ticks until the plug is put back
  sim::LineAction back_action_ = sim::ClockedLine::kPlug;
  mb4::Operation step_;
  bool running_ = false;
  bool writes_ = true;
  bool failed_write_ = false;     // the last one, or it was given up
  std::uint64_t open_until_ = 0;  // tick
  std::optional<std::uint64_t> swapped_at_;
  std::uint64_t left_open_ = 0;
  std::array<std::uint8_t, kNamedCount> values_{};
};

class DriverBusSoak : public testing::TestWithParam<std::tuple<SpiCheck, bool>> {};

TEST_P(DriverBusSoak, OneFaultACall_NoWrongPositionAndEachLossCounted) {
  const std::uint64_t ticks = number("MB4_SOAK_FRAMES", 4'000);
  const std::uint64_t seed = number("MB4_SEED", 56);
  mb4test::Setup setup;
  setup.check = std::get<0>(GetParam());
  setup.omits = std::get<1>(GetParam());
  SoakRig rig(setup, seed);
  rig.telling = std::getenv("MB4_SOAK_TELLS") != nullptr;
  if (rig.telling) rig.bus.log(&rig.story);
  rig.run(ticks);
  if (rig.telling) std::printf("%s", rig.story.c_str());
  std::printf(
      "%llu frames, MB4_SEED=%llu, %s: %llu faults, unplugged %llu times, %llu restarts, %llu "
      "configured, %llu "
      "accesses and %llu failed, accesses left open %llu, counts wrong by a period and doubtful "
      "%llu; cut on the line with "
      "a CRC that fits %llu "
      "and %llu bytes",
      static_cast<unsigned long long>(ticks), static_cast<unsigned long long>(seed),
      setup.text().c_str(), static_cast<unsigned long long>(rig.bus.faults()),
      static_cast<unsigned long long>(rig.unplugged), static_cast<unsigned long long>(rig.restarts),
      static_cast<unsigned long long>(rig.configured),
      static_cast<unsigned long long>(rig.accesses),
      static_cast<unsigned long long>(rig.failed_accesses),
      static_cast<unsigned long long>(rig.left_open_accesses()),
      static_cast<unsigned long long>(rig.slips), static_cast<unsigned long long>(rig.line_limits),
      static_cast<unsigned long long>(rig.cut_writes));
  for (unsigned i = 1; i < kVerdicts; ++i) {
    if (rig.seen[i] == 0) continue;
    std::printf("; %s %llu", to_string(static_cast<Verdict>(i)),
                static_cast<unsigned long long>(rig.seen[i]));
    const Verdict what = static_cast<Verdict>(i);
    EXPECT_FALSE(what >= Verdict::kRegister ||
                 (setup.check >= SpiCheck::kFull && what >= Verdict::kUncounted))
        << to_string(what) << " " << rig.seen[i] << " times";
  }
  std::printf("\n");
  EXPECT_LE(rig.left_open_accesses(), 2 + ticks / 10'000);
  // Wrong counts, and only `doubtful` says so: 1.4 in 10,000 frames at most were seen.
  EXPECT_LE(rig.slips, 2 + ticks / 5'000);
}

// With kFull a write of registers reads SCDATA beside it (0x80 and 0x00 differ in one bit). One bit
// makes that read a write of its own bytes, behind 0x00 (0x0B) or at its address (0x02). Both words
// of the encoder are such that their CRC fits what is there then.
TEST(DriverBus, GuardOfAWriteIsAWrite_NoForeignPosition) {
  struct Case {
    unsigned bit;  // of the frame
    std::uint64_t word;
  };
  constexpr std::uint64_t kFits = 0x43;  // the polynomial: another word with the same CRC
  for (const Case& each : {Case{4, 0xD010100 ^ kFits}, Case{7, 0xD5A0101 ^ kFits}}) {
    mb4test::Setup setup;
    setup.check = SpiCheck::kFull;
    Rig rig(setup);
    ASSERT_TRUE(rig.simulator.slave(1)->set_data(each.word));
    const sim::Time period = mb4test::period_us(setup) * sim::kPsPerUs;
    const auto poll = [&rig, &each] {
      const auto reading = rig.device.automatic().poll_slave(1);
      if (reading) {
        EXPECT_EQ(reading->position, each.word) << "bit " << each.bit;
      }
      return reading.ok();
    };
    rig.simulator.advance(4 * period);
    static_cast<void>(rig.device.automatic().poll_slave(1));  // from before
    for (unsigned i = 0; i < 4; ++i) {
      rig.simulator.advance(period);
      EXPECT_TRUE(poll());
    }
    const std::array<std::uint8_t, 2> values{0x4F, 0x91};
    mb4::Operation write;
    ASSERT_TRUE(rig.device.control().plan_write(write, {1, 0}, Rig::kNamed, values));
    rig.simulator.advance(period);
    rig.bus.plan({MeanKind::kFlipMosi, 1, each.bit});
    bool ended = rig.device.finish(write, write.run(rig.bus), rig.clock.now_us());
    ASSERT_FALSE(ended);
    Transfer hit;
    ASSERT_NE(rig.bus.struck(hit), nullptr);
    ASSERT_EQ(hit.opcode, 0x03);
    ASSERT_EQ(hit.second, 0x00);
    unsigned good = 0;
    for (unsigned i = 0; i < 200 && !ended; ++i) {
      good += poll() ? 1 : 0;
      rig.bus.plan({});
      rig.simulator.advance(period);
      ended = rig.device.finish(write, write.run(rig.bus), rig.clock.now_us());
    }
    EXPECT_TRUE(ended);
    EXPECT_TRUE(write.result()) << mb4::to_string(write.result().error());
    EXPECT_GE(good, 20U);
    EXPECT_EQ(rig.simulator.slave(1)->reg_read(Rig::kNamed + 1), 0x91);
  }
}

// The readings of RDATA in an access become writes of their own bytes in turn (0x03 and 0x0B). The
// right answer is 0 too, so that the call itself sees nothing. The word of the encoder is such that
// its CRC fits a word with these bytes.
TEST(DriverBus, ReadingOfZerosIsAWrite_NoForeignPosition) {
  constexpr std::uint64_t kFits = 0x43;
  constexpr std::uint8_t kRdata = 0x80;
  const std::array<std::uint8_t, 2> zeros{};
  std::array<std::uint8_t, 2> out{};
  for (const bool writes : {true, false}) {
    // What SCDATA1 holds behind each reading of RDATA: 0x80 and the fillers. A read has one of
    // RDATA1 alone, and then two of all.
    const std::vector<std::uint64_t> behind =
        writes ? std::vector<std::uint64_t>{0xD000080}
               : std::vector<std::uint64_t>{0xD005A80, 0xD5A5A80, 0xD000080};
    for (unsigned turn = 0; turn < 8 * behind.size(); ++turn) {
      const unsigned which = turn / 8;  // of the readings
      const std::uint64_t word = behind[which] ^ kFits;
      const unsigned phase = turn % 8;  // of the frames
      SCOPED_TRACE((writes ? "write, reading " : "read, reading ") + std::to_string(which) +
                   ", phase " + std::to_string(phase));
      mb4test::Setup setup;
      setup.check = SpiCheck::kFull;
      setup.zeros = true;
      Rig rig(setup);
      ASSERT_TRUE(rig.simulator.slave(1)->set_data(word));
      const sim::Time period = mb4test::period_us(setup) * sim::kPsPerUs;
      rig.simulator.advance(4 * period + phase * period / 8);
      static_cast<void>(rig.device.automatic().poll_slave(1));  // from before
      mb4::Operation access;
      ASSERT_TRUE(writes ? rig.device.control().plan_write(access, {1, 0}, Rig::kNamed, zeros)
                         : rig.device.control().plan_read(access, {1, 0}, Rig::kNamed, out));
      unsigned readings = 0;
      unsigned good = 0;
      bool hit = false;
      for (bool ended = false; !ended;) {
        for (unsigned i = 0; i < access.frames(); ++i) {
          if (access.tx(i)[0] == 0x03 && access.tx(i)[1] == kRdata && readings++ == which) {
            rig.bus.plan({MeanKind::kFlipMosi, i, 4});
          }
        }
        rig.simulator.advance(period);
        ended = rig.device.finish(access, access.run(rig.bus), rig.clock.now_us());
        Transfer struck;
        hit = hit || rig.bus.struck(struck) != nullptr;
        const auto reading = rig.device.automatic().poll_slave(1);
        if (reading) {
          EXPECT_EQ(reading->position, word);
          ++good;
        }
      }
      EXPECT_TRUE(hit);
      EXPECT_TRUE(access.result().ok() || access.result().error() == mb4::Error::kCorrupted);
      EXPECT_GE(good, 20U);
    }
  }
}

// The same for verify(): 0xD0 to 0xE1 are 0 where channel 2 has no slave. The reading puts 0xD0 and
// zeros into SCDATA1 to 3. For a word of zeros the CRC 0 is right. Its look at SCDATA1 may be a
// write, too.
TEST(DriverBus, VerifyThatWrites_NoForeignPosition) {
  for (unsigned turn = 0; turn < 2 * 2 * 2 * 8; ++turn) {
    const bool steps = turn % 2 != 0;
    const bool look = turn / 2 % 2 != 0;
    const unsigned phase = turn / 8;
    mb4test::Setup setup;
    setup.check = SpiCheck::kFull;
    setup.bus = turn / 4 % 2 != 0 ? mb4test::Bus::kTwo : mb4test::Bus::kNoCrc;
    setup.way = mb4test::Way::kPoll;
    SCOPED_TRACE(setup.text() + (steps ? ", in steps" : "") + (look ? ", the look" : "") +
                 ", phase " + std::to_string(phase));
    Rig rig(setup);
    constexpr std::uint64_t kWord = 0x1234567;
    for (const std::uint8_t slave : rig.sensors()) {
      ASSERT_TRUE(rig.simulator.slave(slave)->set_data(kWord + slave));
    }
    const sim::Time period = mb4test::period_us(setup) * sim::kPsPerUs;
    unsigned good = 0;
    const auto poll = [&] {
      mb4::Frame frame;
      if (!rig.device.automatic().poll(frame)) return;
      for (const std::uint8_t slave : rig.sensors()) {
        if (!frame[slave]) continue;
        EXPECT_EQ(frame[slave]->position, kWord + slave) << "slave " << int{slave};
        ++good;
      }
    };
    rig.simulator.advance(4 * period);
    mb4::Frame old;
    static_cast<void>(rig.device.automatic().poll(old));
    rig.simulator.advance(period + phase * period / 8);
    const MeanFault fault{MeanKind::kFlipMosi, look ? 1U : 0U, look ? 6U : 4U};
    bool hit = false;
    Transfer struck;
    if (steps) {
      mb4::Operation verify;
      ASSERT_TRUE(rig.device.plan_verify(verify).ok());
      for (bool ended = false; !ended;) {
        if (verify.tx(0)[1] == 0xD0) rig.bus.plan(fault);
        ended = rig.device.finish(verify, verify.run(rig.bus), rig.clock.now_us());
        hit = hit || rig.bus.struck(struck) != nullptr;
        rig.bus.plan({});
        if (hit) poll();
      }
    } else {
      rig.bus.plan({fault.kind, fault.transfer + 2, fault.place});
      EXPECT_TRUE(rig.device.verify().ok());
      hit = rig.bus.struck(struck) != nullptr;
      rig.bus.plan({});
    }
    EXPECT_TRUE(hit && struck.opcode == (look ? 0x09 : 0x03));
    for (unsigned i = 0; i < 4; ++i) {
      poll();
      rig.simulator.advance(period);
    }
    EXPECT_GE(good, 2U);
  }
}

INSTANTIATE_TEST_SUITE_P(Checks, DriverBusSoak,
                         testing::Combine(testing::Values(SpiCheck::kCrc, SpiCheck::kFull,
                                                          SpiCheck::kFullAndRelease),
                                          testing::Bool()),
                         [](const auto& test) {
                           return std::string(to_string(std::get<0>(test.param))).substr(1) +
                                  (std::get<1>(test.param) ? "_Omits" : "_Overwrites");
                         });

}  // namespace
