// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// pru_core against the judge of tests/reference/pru: frames at random on disturbed lines. After
// each frame all bytes of the memory, SIGNALS, FRAME_COUNT and LATCH_TIME are those of the judge,
// and MA has the edges that the judge expects.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/block/pru/pru_bench.hpp"
#include "tests/support/environment.hpp"

namespace {

using mb4test::bits_of;
using mb4test::crc_of;
using mb4test::Dice;
using pru_judge::Judge;
using pru_judge::JudgeSetup;
using pru_judge::Time;
namespace reg = biss_pru::regs;

unsigned frames_of(unsigned usual) {
  return static_cast<unsigned>(mb4test::number("MB4_PRU_FRAMES", usual));
}

JudgeSetup setup_of(std::uint32_t hz, unsigned quirks) {
  JudgeSetup setup;
  setup.clock_hz = hz;
  setup.sma_wrap = (quirks & 4U) != 0;
  setup.first_low = (quirks & 2U) != 0;
  setup.extra_10 = (quirks & 1U) != 0;
  // Four clocks at least, and seven more to pin irq_o, which tells the test.
  setup.update_clocks = 11;
  return setup;
}

// A master with its judge. What the host writes goes to both.
template <typename Bench>
class Judged {
 public:
  explicit Judged(unsigned quirks) : bench(quirks), judge(setup_of(Bench::kHz, quirks)) {}

  void write(std::uint32_t address, std::uint32_t data, unsigned strobes = 0xF) {
    bench.write(address, data, strobes);
    judge.write(address, data, strobes);
  }
  // RUN, and its frame at 1 MHz.
  void run() {
    write(reg::kAddrIrqEnable, 1);
    write(reg::kAddrTriggerPeriod, 0);
    write(reg::kAddrIrqStatus, 0x1F);
    bench.write(reg::kAddrRun, 0);
    judge.write(reg::kAddrRun, 0);
    bench.clocks(3000);
    const Time before = bench.now;
    write(reg::kAddrRun, 1);
    frame(before + 40'000'000);
    write(reg::kAddrIrqStatus, 0x1F);
  }
  // A frame by the pin.
  void trigger() {
    bench.m.trigger_i = 1;
    bench.clocks(3);  // two flops, and one that keeps the trigger
    const Time start = bench.now;
    frame(start);
    bench.m.trigger_i = 0;
    judge.trigger(false);
    bench.clocks(4);
    ended = judge.picture().irq_status;
    EXPECT_EQ(bench.read(reg::kAddrIrqStatus), ended);
    write(reg::kAddrIrqStatus, 0x1F);
  }

  Bench bench;
  Judge judge;
  pru_judge::FrameReport last;
  unsigned frames = 0;
  std::uint32_t ended = 0;  // IRQ_STATUS behind the last frame

 private:
  void frame(Time start) {
    const std::uint64_t most = 120'000;
    std::uint64_t i = 0;
    while (bench.m.irq_o == 0 && i < most) {
      bench.clock();
      ++i;
    }
    ASSERT_LT(i, most) << "no end of a frame";
    const Time updated = bench.now;
    pru_judge::Picture seen = judge.picture();
    for (std::uint32_t address = 0; address < pru_judge::kMemoryEnd; address += 4) {
      const std::uint32_t word = bench.read(address);
      for (unsigned byte = 0; byte < 4; ++byte)
        seen.memory.at(address + byte) = static_cast<std::uint8_t>(word >> 8 * byte);
    }
    seen.signals = bench.read(reg::kAddrSignals);
    seen.frame_count = bench.read(reg::kAddrFrameCount);
    seen.latch_time = bench.read(reg::kAddrLatchTime);
    bench.clocks(2 * Bench::kHz /
                 1'000'000);  // the last edge of MA may come behind the last sample
    last = judge.frame({start, bench.now, bench.ma, bench.sl, updated});
    ++frames;
    // What the clock counted when it began is another matter; see LatchTime_* below.
    pru_judge::Picture expected = judge.picture();
    seen.irq_status = expected.irq_status;
    if (!zero_known_ && last.reading.kind != pru_judge::FrameKind::kSlLow) {
      zero_ = expected.latch_time - seen.latch_time;
      zero_known_ = true;
    }
    if (seen.latch_time != 0 || zero_known_) seen.latch_time += zero_;
    if (!zero_known_) seen.latch_time = expected.latch_time;
    for (const std::string& line : last.complaints) ADD_FAILURE() << line;
    for (const std::string& line : differences(expected, seen)) ADD_FAILURE() << line;
    bench.ma.forget(bench.now);
    bench.sl.forget(bench.now - 20 * Bench::kClock);
  }

  std::uint32_t zero_ = 0;
  bool zero_known_ = false;
};

// Frames at random: lengths, rates, line, encoder, control words, quirks.
template <typename Bench>
void judge_frames(unsigned frames) {
  Dice dice;
  unsigned done = 0;
  unsigned kinds[4] = {};
  unsigned averaged = 0;
  unsigned controls = 0;  // control frames that ended
  while (done < frames) {
    const unsigned quirks = dice.below(8);
    Judged<Bench> judged(quirks);
    auto& bench = judged.bench;
    auto& encoder = bench.encoder;
    const unsigned bits = 1 + dice.below(55);
    const unsigned tail = dice.below(4) != 0 ? 8 : dice.below(dice.below(4) == 0 ? 40 : 9);
    const unsigned rates[] = {1, 2, 5, 10};
    unsigned mhz = rates[dice.below(4)];
    judged.write(reg::kAddrLengths, bits | tail << 8U | mhz << 16U);
    unsigned most = dice.below(3) == 0 ? 0 : 1 + dice.below(30);
    judged.write(reg::kAddrProcTimeMax, most);
    judged.write(reg::kAddrOverhead, dice.below(8) == 0 ? dice.below(6) : 100 + dice.below(2000));
    const double jitter = dice.below(3) == 0 ? 0 : dice.below(36) / 100.0;
    const auto line = [&](unsigned rate) {
      const Time period = 1'000'000 / rate;
      bench.delay = static_cast<Time>(dice.below(12'001)) * period / 1000;
      bench.skew = dice.below(3) == 0 ? dice.below(15) * period / 100 : 0;
      bench.jitter = [&dice, period, jitter]() -> Time {
        return static_cast<Time>(jitter * static_cast<double>(period) * dice.below(1000) / 1000);
      };
      encoder.timeout =
          static_cast<std::uint64_t>(period * 3 / 2 + dice.below(1000) * period / 1000);
    };
    const auto answer = [&] {
      const unsigned limit = most != 0 ? most : 40 * judged.judge.mhz();
      std::string word = bits_of(
          static_cast<std::uint64_t>(dice.below(1U << 31)) << 32U | dice.below(1U << 31), bits);
      if (tail >= 8) word += bits_of(dice.below(4), 2);
      if (tail >= 6) word += bits_of(~crc_of(word, 0x43), 6);
      while (word.size() < bits + tail) word += dice.below(2) != 0 ? '1' : '0';
      if (dice.below(20) == 0) word[dice.below(static_cast<unsigned>(word.size()))] ^= 1;
      encoder.payload = (dice.below(2) != 0 ? '1' : '0') + word;
      encoder.busy = dice.below(8) == 0 ? limit - 1 + dice.below(3) : dice.below(3);
      bench.silent = dice.below(40) == 0;
    };
    SCOPED_TRACE("bits " + std::to_string(bits) + ", tail " + std::to_string(tail) + ", " +
                 std::to_string(mhz) + " MHz, quirks " + std::to_string(quirks) + ", frame " +
                 std::to_string(done));
    line(1);
    answer();
    judged.run();
    // A control frame has 46 frames.
    const unsigned count = 10 + dice.below(dice.below(3) == 0 ? 150 : 40);
    for (unsigned i = 0; i < count && !testing::Test::HasFailure(); ++i) {
      if (i == 0 || dice.below(10) == 0) line(judged.judge.mhz());
      if (dice.below(12) == 0) {
        mhz = dice.below(4) == 0 ? dice.below(256) : rates[dice.below(4)];
        judged.write(reg::kAddrLengths, mhz << 16U, 4);
      }
      if (dice.below(10) == 0) {
        judged.write(reg::kAddrCtrl, dice.below(1U << 31) << 1U | dice.below(2),
                     1 + dice.below(15));
      }
      if (dice.below(15) == 0) {
        most = dice.below(3) == 0 ? 0 : 1 + dice.below(30);
        judged.write(reg::kAddrProcTimeMax, most);
      }
      if (dice.below(25) == 0) {
        bench.stuck = dice.below(2) != 0;
      } else if (dice.below(3) != 0) {
        bench.stuck.reset();
      }
      answer();
      if (dice.below(6) == 0) {
        const Time at =
            bench.now + static_cast<Time>(dice.below(1'000'000)) * (20 / judged.judge.mhz() + 1);
        bench.glitch(at, 1000 + dice.below(200'000));
      }
      // Mostly the encoder has ended its timeout.
      if (dice.below(10) != 0) {
        for (int k = 0; k < 20'000 && (encoder.in_frame || k < 300); ++k) bench.clock();
        bench.clocks(static_cast<std::uint64_t>(bench.delay / Bench::kClock) + 300);
      }
      judged.trigger();
      ++kinds[static_cast<unsigned>(judged.last.reading.kind)];
      averaged += judged.last.settings.averages ? 1 : 0;
      controls += (judged.ended & pru_judge::kIrqControl) != 0 ? 1 : 0;
    }
    done += judged.frames;
    if (testing::Test::HasFailure()) return;
  }
  std::printf(
      "%u frames: %u without MA, %u without acknowledge, %u dropped, %u read; %u with the "
      "average, %u control frames: 0 differences\n",
      done, kinds[0], kinds[1], kinds[2], kinds[3], averaged, controls);
  for (const unsigned kind : kinds) EXPECT_GT(kind, frames / 200);
  EXPECT_GT(controls, frames / 500);
  EXPECT_GT(averaged, frames / 10);
}

// Frames follow each other as closely as they can, and CDM leaves MA at 0 behind some of them. The
// encoder is nearer than a sample and its timeout is short, so SL is 1 before each frame.
template <typename Bench>
void look_at_levels_of_ma() {
  constexpr Time kHalf = 500'000;  // of a period at 1 MHz
  Bench bench;
  bench.write(reg::kAddrLengths, 12 | 8U << 8U | 1U << 16U);
  bench.write(reg::kAddrOverhead, 0);
  bench.write(reg::kAddrTriggerPeriod, 2);
  bench.encoder.payload = std::string(21, '1');
  bench.encoder.timeout = kHalf * 6 / 5;
  bench.write(reg::kAddrRun, 1);
  bench.write(reg::kAddrCtrl, 0xFFFFFFFF);
  bool level = true;
  Time since = bench.now;
  unsigned levels = 0;
  unsigned frames = 0;
  while (frames < 60) {
    bench.clock();
    if ((bench.m.ma_o != 0) == level) continue;
    EXPECT_GE(bench.now - since, kHalf) << "frame " << frames << ", MA at " << level;
    frames += bench.now - since > kHalf ? 1 : 0;
    level = !level;
    since = bench.now;
    ++levels;
  }
  EXPECT_NE(bench.read(reg::kAddrIrqStatus) & 4U, 0U) << "no control frame has ended";
  EXPECT_GT(levels, 60U * 40U);
}

// ---- Instants ----------------------------------------------------------------------------------

// A line of ones, of which one clock reads 0: what the frame makes of it.
template <typename Bench>
class OneLowClock {
 public:
  explicit OneLowClock(unsigned mhz, unsigned bits = 1, unsigned overhead = 0) {
    bench_.silent = true;
    bench_.write(reg::kAddrLengths, bits | mhz << 16U);
    bench_.write(reg::kAddrOverhead, overhead);
    bench_.write(reg::kAddrTriggerPeriod, 0);
    bench_.write(reg::kAddrRun, 1);
    for (int frame = 0; frame < 2; ++frame) pass();  // that of RUN, and one with the rate
  }
  // A frame in which SL reads 0 in the clock edge with this number behind the second rise of MA.
  // RAW_DATA, 0xFF if that edge is no sample.
  std::uint32_t raw(unsigned clock) {
    bench_.m.trigger_i = 1;
    unsigned rises = 0;
    bool before = true;
    while (rises < 2) {
      bench_.clock();
      const bool level = bench_.m.ma_o != 0;
      rises += level && !before ? 1 : 0;
      before = level;
    }
    const Time edge = bench_.now + static_cast<Time>(clock) * Bench::kClock;
    bench_.glitch(edge - Bench::kClock / 2, Bench::kClock - 2);
    bench_.m.trigger_i = 0;
    pass();
    return bench_.read(reg::kAddrReceived) >> 16U & 0xFFU;
  }

 private:
  void pass() { bench_.clocks(Bench::kHz / 1'000'000 * 100); }
  Bench bench_;
};

// P-1: eight samples a period at 1, 2, 5 and 10 MHz, as evenly as the clock allows.
template <typename Bench>
void look_at_samples() {
  for (const unsigned mhz : {1U, 2U, 5U, 10U}) {
    OneLowClock<Bench> line(mhz);
    const unsigned period = Bench::kHz / 1'000'000 / mhz;
    std::vector<unsigned> at;
    unsigned together = 0;  // bits of RAW_DATA that a sample of the byte has made 0
    for (unsigned clock = period / 2; clock < period / 2 + 2 * period; ++clock) {
      const std::uint32_t raw = line.raw(clock);
      if (raw == 0xFF) continue;
      at.push_back(clock);
      ASSERT_EQ(__builtin_popcount(raw), 7) << mhz << " MHz, clock " << clock;
      together |= ~raw & 0xFFU;
    }
    ASSERT_EQ(at.size(), 16U) << mhz << " MHz";
    EXPECT_EQ(together, 0xFFU);
    for (std::size_t i = 1; i < at.size(); ++i) {
      EXPECT_GE(at[i] - at[i - 1], period / 8) << mhz;
      EXPECT_LE(at[i] - at[i - 1], (period + 7) / 8) << mhz;
      if (i >= 8) {
        EXPECT_EQ(at[i] - at[i - 8], period) << mhz;
      }
    }
  }
}

TEST(Pru, EachRateHasEightSamplesAPeriod_AsEvenlyAsTheClockAllows) {
  look_at_samples<mb4test::PruBench200>();
  look_at_samples<mb4test::PruBench80>();
}

// A frame at 5 MHz of an encoder that always sends the same, from the reset on. SL is inverted in
// the clock edge with the number `low` behind the first rise of MA, if it is not 0; a word is read
// about `read` clocks behind that rise.
template <typename Bench>
std::uint32_t read_beside_a_frame(unsigned overhead, unsigned low, unsigned read,
                                  std::uint32_t address) {
  Bench bench;
  bench.encoder.timeout = 20'000'000;
  const std::string word = bits_of(0x5A3, 12) + "11";
  bench.encoder.payload = "0" + word + bits_of(~crc_of(word, 0x43), 6);
  bench.write(reg::kAddrLengths, 12 | 8U << 8U | 5U << 16U);
  bench.write(reg::kAddrOverhead, overhead);
  bench.write(reg::kAddrTriggerPeriod, 0);
  bench.write(reg::kAddrRun, 1);
  bench.clocks(Bench::kHz / 1'000'000 * 150);
  bench.m.trigger_i = 1;
  for (bool before = true, rose = false; !rose; before = bench.m.ma_o != 0) {
    bench.clock();
    rose = bench.m.ma_o != 0 && !before;
  }
  if (low != 0) {
    bench.glitch(bench.now + static_cast<Time>(low) * Bench::kClock - Bench::kClock / 2,
                 Bench::kClock - 2);
  }
  bench.clocks(read);
  return bench.read(address);
}

// R-P10: the memory changes OVERHEAD clocks behind the edge that takes the last sample, four at
// least.
template <typename Bench>
void look_at_the_update() {
  const auto read = read_beside_a_frame<Bench>;
  constexpr unsigned kPeriod = Bench::kHz / 5'000'000;
  constexpr unsigned kLong = 60 * kPeriod;
  // The last sample: the last edge at which the level of SL matters.
  unsigned sample = 0;
  for (unsigned clock = 22 * kPeriod; clock < 27 * kPeriod; ++clock) {
    const bool bad = (read(0, clock, kLong, reg::kAddrStatus) >> 19U & 1U) != 0;
    if (bad) sample = clock;
  }
  ASSERT_NE(sample, 0U);
  const std::uint32_t rise = read(0, 0, kLong, reg::kAddrLatchTime);
  for (const unsigned overhead : {0U, 3U, 4U, 5U, 6U, 40U}) {
    const unsigned due = sample + std::max(overhead, 4U);
    std::uint32_t changed = 0;  // TIME_LOW at which the memory is first seen as changed
    for (unsigned clock = due - 8; clock < due + 8 && changed == 0; ++clock) {
      if (read(overhead, 0, clock, reg::kAddrFrameCount) != 2) continue;
      changed = read(overhead, 0, clock, reg::kAddrTimeLow);
    }
    // What changes at an edge is seen at the next one.
    EXPECT_EQ(changed - rise, due + 1) << overhead;
  }
}

TEST(Pru, MemoryChanges_OverheadClocksBehindTheLastSample) {
  look_at_the_update<mb4test::PruBench200>();
  look_at_the_update<mb4test::PruBench80>();
}

// ---- Registers ---------------------------------------------------------------------------------

struct MapRow {
  unsigned address;
  std::uint32_t reset, writable;
};

// Map B of the memory and the page: what each address reads behind the reset, and which bits keep
// what is written.
template <typename Bench>
void look_at_the_map() {
  const bool slow = Bench::kHz == 80'000'000;
  for (unsigned quirks = 0; quirks < 8; ++quirks) {
    const unsigned features = (slow ? 2U : 0U) | (quirks >> 2U & 1U) << 2U |
                              (quirks >> 1U & 1U) << 3U | (quirks & 1U) << 4U;
    const MapRow rows[] = {{0x000, 0, 0xFF'FFFF},
                           {0x004, 0, 0xFFFF'FFFF},
                           {0x200, 0x454E4303, 0},
                           {0x204, reg::kResetVersion, 0},
                           {0x208, features, 0},
                           {0x210, 0, 0x1F},
                           {0x220, 0, 1},
                           {0x224, slow ? 8000U : 20'000U, 0xFF'FFFF},
                           {0x228, slow ? 2160U : 5400U, 0xFFFF},
                           {0x22C, 0, 0x3FF},
                           {0x230, 3, 0}};
    Bench bench(quirks);
    std::vector<std::uint32_t> reset(1024, 0);
    std::vector<std::uint32_t> writable(1024, 0);
    for (const MapRow& row : rows) {
      reset[row.address / 4] = row.reset;
      writable[row.address / 4] = row.writable;
    }
    for (unsigned address = 0; address < 4096; address += 4) {
      if (address == reg::kAddrTimeLow) continue;
      ASSERT_EQ(bench.read(address), reset[address / 4]) << std::hex << address;
    }
    for (const bool ones : {true, false}) {
      for (unsigned address = 0; address < 4096; address += 4) {
        if (address == reg::kAddrTimeLow || address == reg::kAddrRun) continue;
        bench.write(address, ones ? 0xFFFF'FFFF : 0);
        const std::uint32_t kept = reset[address / 4] & ~writable[address / 4];
        ASSERT_EQ(bench.read(address), kept | (ones ? writable[address / 4] : 0))
            << std::hex << address << ' ' << ones;
      }
    }
    bench.write(reg::kAddrRun, 0xFFFF'FFFF);
    ASSERT_EQ(bench.read(reg::kAddrRun), 1U);
  }
}

TEST(Pru, EveryAddress_ReadsAsTheMapSays) {
  look_at_the_map<mb4test::PruBench200>();
  look_at_the_map<mb4test::PruBench80>();
}

TEST(PruMa, CdmOneAndFramesWithoutAPause_EveryLevelLastsHalfAPeriod) {
  look_at_levels_of_ma<mb4test::PruBench200>();
  look_at_levels_of_ma<mb4test::PruBench80>();
}

TEST(Pru, FramesAtRandom200MHz_MemoryIsThatOfTheJudge) {
  judge_frames<mb4test::PruBench200>(frames_of(1000));
}

TEST(Pru, FramesAtRandom80MHz_MemoryIsThatOfTheJudge) {
  judge_frames<mb4test::PruBench80>(frames_of(1000));
}

}  // namespace
