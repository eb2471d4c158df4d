// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames of the BiSS C master on AXI: words, modes, CRC, encoders that do not answer.
#include <cmath>
#include <vector>

#include "sim/core/random.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/chip/axi/axi_bench.hpp"

namespace mb4test {
namespace {

std::uint32_t position_of(unsigned bits, sim::Random& random) {
  const auto all = static_cast<std::uint32_t>(random.next());
  return bits == 32 ? all : all & ((1U << bits) - 1);
}

// 16 cables of 0 to 100 m: 5 ns a metre, both ways. One edge of the sample clock starts all of them
// at one instant.
TEST(Axi, F3SixteenCablesUpTo100m_OneBeatWithAllWordsAndTheirDelays) {
  const auto tap = [](sim::Time now, void* receiver, sim::ClockedLine::Signal signal, bool level) {
    auto& first = *static_cast<sim::Time*>(receiver);
    if (signal == sim::ClockedLine::Signal::kMa && !level && first == 0) first = now;
  };
  for (const unsigned divider : {50U, 10U, 5U}) {
    std::vector<AxiEncoder> encoders;
    for (unsigned c = 0; c < 16; ++c) encoders.push_back({.delay_ns = 1000.0 * c / 15});
    AxiBench bench(axi_scenario(encoders));
    bench.set_up(26, divider);
    bench.write(axireg::kAddrSampleClock, 1);
    bench.write(axireg::kAddrMode, 0);
    sim::Random random(divider);
    for (unsigned round = 0; round < 4; ++round) {
      std::vector<std::uint32_t> sent;
      std::vector<sim::Time> begun(16);
      for (unsigned c = 0; c < 16; ++c) {
        sent.push_back(position_of(26, random));
        bench.simulator.slave(c + 1)->set_data(raw_word(sent.back()));
        clocked(bench.simulator.line(c + 1))->set_tap(tap, &begun[c]);
      }
      bench.set_pin("ext_sample_clk", true);
      bench.simulator.advance(50 * sim::kPsPerUs);
      bench.set_pin("ext_sample_clk", false);
      bench.simulator.advance(50 * sim::kPsPerUs);
      ASSERT_EQ(bench.host.beats_waiting(), 1U) << "MA divider " << divider;
      const auto beat = bench.host.next_beat();
      EXPECT_EQ(beat->words, sent) << "MA divider " << divider;
      EXPECT_EQ(beat->user, 0xFFFFU);
      EXPECT_TRUE(beat->last);
      EXPECT_GT(begun[0], sim::Time{0});
      for (unsigned c = 0; c < 16; ++c) {
        EXPECT_EQ(begun[c], begun[0]) << "channel " << c;
        const double clocks = encoders[c].delay_ns / 10.0;
        EXPECT_NEAR(bench.read(c, axireg::kAddrLineDelay), clocks, 1.0) << "channel " << c;
      }
    }
  }
}

TEST(Axi, F4EighteenTo32Bits_TheBitsAboveAreZero) {
  for (const unsigned bits : {1U, 18U, 26U, 32U}) {
    AxiBench bench(axi_scenario({{.bits = bits, .delay_ns = 35}}));
    bench.set_up(bits, 5);
    const std::uint32_t ones = bits == 32 ? ~0U : (1U << bits) - 1;
    for (const std::uint32_t word : {ones, 0U, ones ^ (ones >> 1U), 1U}) {
      bench.simulator.slave(1)->set_data(raw_word(word));
      const auto beat = bench.frame();
      ASSERT_TRUE(beat) << bits;
      EXPECT_EQ(beat->words[0], word) << bits;
      EXPECT_EQ(beat->user, 1U) << bits;
      EXPECT_EQ(bench.read(axireg::kAddrSinglePointData), word) << bits;
    }
  }
}

// A corrupted bit: with the check the last good word stays.
TEST(Axi, F5CorruptedFrame_IsDeliveredOnlyWithoutTheCheck) {
  for (const bool ignores : {false, true}) {  // CRC_BIT_IGNORES
    for (const bool check : {false, true}) {
      const std::string quirks = ignores ? "CRC_BIT_IGNORES = true\n" : "";
      AxiBench bench(axi_scenario({{.delay_ns = 50}}, 100'000'000, "", quirks));
      bench.set_up(26, 5);
      bench.write(axireg::kAddrCrcCheck, check != ignores ? 1 : 0);
      bench.simulator.slave(1)->set_data(raw_word(0x155'5555));
      ASSERT_TRUE(bench.frame());
      EXPECT_EQ(bench.read(axireg::kAddrReceivedCrc), bench.read(axireg::kAddrCalculatedCrc));
      EXPECT_EQ(bench.read(axireg::kAddrSinglePointValid), 1U);
      bench.simulator.slave(1)->set_data(raw_word(0x0AA'AAAA));
      // Bits 0 and 1 are start bit and CDS; 2 is the highest of the position.
      bench.simulator.inject("[[fault]]\nkind = \"bit-flip\"\nat_us = 0\nbits = [2]\n");
      const auto beat = bench.frame();
      ASSERT_TRUE(beat);
      EXPECT_NE(bench.read(axireg::kAddrReceivedCrc), bench.read(axireg::kAddrCalculatedCrc));
      EXPECT_EQ(beat->user, check ? 0U : 1U);
      EXPECT_EQ(beat->words[0], check ? 0x155'5555U : 0x2AA'AAAAU);
      EXPECT_EQ(bench.read(axireg::kAddrSinglePointValid), check ? 0U : 1U);
      EXPECT_EQ(bench.read(axireg::kAddrSinglePointData), check ? 0x155'5555U : 0x2AA'AAAAU);
    }
  }
}

// CRC of two words by hand: x^6 + x + 1 over position, nE, nW; sent inverted.
TEST(Axi, CrcRegisters_ShowTheSixBitsOfTheLine) {
  const auto crc6 = [](std::uint64_t word, unsigned bits) {
    unsigned rest = 0;
    for (unsigned bit = bits; bit-- > 0;) {
      const unsigned top = (rest >> 5U ^ static_cast<unsigned>(word >> bit)) & 1U;
      rest = ((rest << 1U) & 0x3FU) ^ (top != 0 ? 0x03U : 0U);
    }
    return rest ^ 0x3FU;
  };
  AxiBench bench(axi_scenario({{}}));
  bench.set_up(26, 5);
  for (const std::uint32_t word : {0x123'4567U, 0x3FF'FFFFU}) {
    bench.simulator.slave(1)->set_data(raw_word(word));
    ASSERT_TRUE(bench.frame());
    EXPECT_EQ(bench.read(axireg::kAddrReceivedCrc), crc6(raw_word(word), 28));
    EXPECT_EQ(bench.read(axireg::kAddrCalculatedCrc), crc6(raw_word(word), 28));
  }
}

TEST(Axi, F6EdgeAtRequest_IsOneFrameAndSetsValidAndData) {
  for (const bool until_request : {true, false}) {
    const std::string quirks =
        std::string("VALID_UNTIL_REQUEST = ") + (until_request ? "true\n" : "false\n");
    AxiBench bench(axi_scenario({{}, {.delay_ns = 300}}, 100'000'000, "", quirks));
    bench.set_up(26, 5);
    bench.write(axireg::kAddrRequest, 0);
    bench.simulator.advance(50 * sim::kPsPerUs);
    EXPECT_EQ(bench.frames(1), 0U);
    bench.simulator.slave(1)->set_data(raw_word(1111));
    bench.simulator.slave(2)->set_data(raw_word(2222));
    ASSERT_TRUE(bench.frame());
    EXPECT_EQ(bench.frames(1), 1U);
    EXPECT_EQ(bench.read(axireg::kAddrSinglePointValid), 3U);
    EXPECT_EQ(bench.read(0, axireg::kAddrSinglePointData), 1111U);
    EXPECT_EQ(bench.read(1, axireg::kAddrSinglePointData), 2222U);
    // A 1 that stays is no edge.
    bench.write(axireg::kAddrRequest, 1);
    bench.simulator.advance(50 * sim::kPsPerUs);
    EXPECT_EQ(bench.frames(1), 1U);
    // While the next frame runs.
    bench.request();
    bench.simulator.advance(2 * sim::kPsPerUs);
    EXPECT_EQ(bench.read(axireg::kAddrSinglePointValid), until_request ? 0U : 3U);
    bench.simulator.advance(100 * sim::kPsPerUs);
    EXPECT_EQ(bench.read(axireg::kAddrSinglePointValid), 3U);
    // A bad frame: channel 1 loses its bits, channel 2 not.
    bench.simulator.inject("[[fault]]\nkind = \"bit-flip\"\nchannel = 1\nat_us = 0\nbits = [5]\n");
    bench.simulator.slave(1)->set_data(raw_word(3333));
    ASSERT_TRUE(bench.frame());
    EXPECT_EQ(bench.read(axireg::kAddrSinglePointValid), until_request ? 2U : 3U);
    EXPECT_EQ(bench.read(0, axireg::kAddrSinglePointData), 1111U);
    // Soft reset clears results, not the configuration.
    bench.write(axireg::kAddrSoftReset, 1);
    EXPECT_EQ(bench.read(axireg::kAddrSinglePointValid), 0U);
    EXPECT_EQ(bench.read(0, axireg::kAddrSinglePointData), 0U);
    EXPECT_EQ(bench.read(axireg::kAddrMaDivider), 5U);
    bench.write(axireg::kAddrSoftReset, 0);
    const auto frames = bench.frames(1);
    bench.write(axireg::kAddrSampleClock, 1);
    bench.write(axireg::kAddrMode, 0);
    bench.request();
    bench.simulator.advance(50 * sim::kPsPerUs);
    EXPECT_EQ(bench.frames(1), frames) << "a request in sample-clock mode";
    EXPECT_EQ(bench.read(axireg::kAddrSinglePointValid), 0U);
  }
}

TEST(Axi, F7ExternalClock_IsOneFrameForEachRisingEdgeWhileEnabled) {
  AxiBench bench(axi_scenario({{}}));
  bench.set_up(26, 5);
  bench.write(axireg::kAddrSampleClock, 1);
  bench.write(axireg::kAddrMode, 0);
  bench.simulator.advance(50 * sim::kPsPerUs);
  const auto base = bench.frames(1);
  const auto pulse = [&] {
    bench.set_pin("ext_sample_clk", true);
    bench.simulator.advance(40 * sim::kPsPerUs);
    bench.set_pin("ext_sample_clk", false);
    bench.simulator.advance(40 * sim::kPsPerUs);
  };
  for (unsigned n = 1; n <= 5; ++n) {
    bench.simulator.slave(1)->set_data(raw_word(n));
    pulse();
    EXPECT_EQ(bench.frames(1), base + n);
  }
  bench.set_pin("sample_en", false);
  pulse();
  EXPECT_EQ(bench.frames(1), base + 5);
  bench.set_pin("sample_en", true);
  bench.simulator.advance(50 * sim::kPsPerUs);
  EXPECT_EQ(bench.frames(1), base + 5);
  pulse();
  EXPECT_EQ(bench.frames(1), base + 6);
  // Frames of a sample clock never touch what single-point mode shows.
  EXPECT_EQ(bench.read(axireg::kAddrSinglePointValid), 0U);
  EXPECT_EQ(bench.host.beats_waiting(), 6U);
  for (unsigned n = 1; n <= 5; ++n) EXPECT_EQ(bench.host.next_beat()->words[0], n);
}

TEST(Axi, F8ErrorAndWarningBits_PullTheirPins) {
  AxiBench bench(axi_scenario({{}, {}}));
  bench.set_up(26, 5);
  for (const unsigned flags : {3U, 1U, 2U, 0U, 3U}) {  // nE, nW
    bench.simulator.slave(2)->set_data(1000U << 2U | flags);
    ASSERT_TRUE(bench.frame());
    EXPECT_EQ(bench.pin("error"), (flags & 2U) != 0) << flags;
    EXPECT_EQ(bench.pin("warn"), (flags & 1U) != 0) << flags;
  }
  // Only enabled channels count.
  bench.simulator.slave(2)->set_data(1000U << 2U);
  ASSERT_TRUE(bench.frame());
  EXPECT_FALSE(bench.pin("error"));
  bench.write(axireg::kAddrChannelEnable, 1);
  EXPECT_TRUE(bench.pin("error"));
  EXPECT_TRUE(bench.pin("warn"));
}

// A period of 10 us; an encoder whose timeout is 40 us.
TEST(Axi, F9SampleClockFasterThanTheEncoder_SkipsWholePeriods) {
  AxiBench bench(axi_scenario({{.slave = "timeout = 40\nsource = \"ramp\"\nstep = 1\n"}}));
  bench.set_up(26, 5);
  bench.write(axireg::kAddrSampleDivider, 500);
  bench.write(axireg::kAddrMode, 0);
  bench.simulator.advance(2000 * sim::kPsPerUs);
  bench.write(axireg::kAddrMode, 1);
  bench.simulator.advance(100 * sim::kPsPerUs);
  const std::size_t beats = bench.host.beats_waiting();
  EXPECT_EQ(bench.frames(1), beats);
  // A frame lasts about 4.1 us; then 40 us of timeout: every fifth edge, 50 us.
  EXPECT_NEAR(static_cast<double>(beats), 2000.0 / 50, 2.0);
  std::optional<sim::Time> before;
  while (const auto beat = bench.host.next_beat()) {
    EXPECT_EQ(beat->user, 1U);
    EXPECT_EQ(beat->time - before.value_or(beat->time - 50 * sim::kPsPerUs), 50 * sim::kPsPerUs);
    before = beat->time;
  }
}

// 16 channels: one open, one shorted high, one shorted low.
TEST(Axi, ChannelsThatDoNotAnswer_StopNoOther) {
  std::vector<AxiEncoder> encoders(16);
  for (unsigned c = 0; c < 16; ++c) encoders[c].delay_ns = 20.0 * c;
  encoders[3].keys = "[[channel.event]]\nat_us = 0\naction = \"unplug\"\n";
  encoders[7].keys = "[[channel.event]]\nat_us = 0\naction = \"sl-high\"\n";
  encoders[11].keys = "[[channel.event]]\nat_us = 0\naction = \"sl-low\"\n";
  AxiBench bench(axi_scenario(encoders));
  bench.set_up(26, 5);
  constexpr unsigned kGood = 0xFFFF & ~(1U << 3U | 1U << 7U | 1U << 11U);
  for (unsigned round = 0; round < 5; ++round) {
    for (unsigned c = 0; c < 16; ++c)
      bench.simulator.slave(c + 1)->set_data(raw_word(100 * c + round));
    const auto frames = bench.frames(1);
    const auto beat = bench.frame(60 * sim::kPsPerUs);
    ASSERT_TRUE(beat) << round;
    EXPECT_EQ(beat->user, kGood) << round;
    EXPECT_EQ(bench.frames(1), frames + 1);
    for (unsigned c = 0; c < 16; ++c) {
      EXPECT_EQ(beat->words[c], (kGood >> c & 1U) != 0 ? 100 * c + round : 0U) << c;
    }
    EXPECT_EQ(bench.read(axireg::kAddrSinglePointValid), kGood);
  }
  EXPECT_EQ(bench.read(3, axireg::kAddrLineDelay), 1023U);
  // MA of the channel whose SLO is 0 has never moved.
  EXPECT_EQ(bench.frames(12), 0U);
}

TEST(Axi, NoStartBitWithinTheLimit_EndsTheFrameAsABadOne) {
  AxiBench bench(axi_scenario({{.slave = "busy_periods = 1500\n"}, {}}));
  bench.set_up(26, 5);
  const auto bad = bench.frame(300 * sim::kPsPerUs);
  ASSERT_TRUE(bad);
  EXPECT_EQ(bad->user, 2U);
  EXPECT_TRUE(bench.pin("ma0"));
  AxiBench slow(axi_scenario({{.slave = "busy_periods = 1000\n"}, {}}));
  slow.set_up(26, 5);
  slow.simulator.slave(1)->set_data(raw_word(77));
  const auto good = slow.frame(300 * sim::kPsPerUs);
  ASSERT_TRUE(good);
  EXPECT_EQ(good->user, 3U);
  EXPECT_EQ(good->words[0], 77U);
}

// A soft reset or a disable in the middle of a frame; MaPulseCheck guards the pulses of MA.
TEST(Axi, SoftResetAndDisableInAFrame_EndItWithoutAShortPulse) {
  for (const bool soft : {true, false}) {
    for (unsigned clocks = 0; clocks < 500; clocks += 7) {
      AxiBench bench(axi_scenario({{.delay_ns = 120}, {.delay_ns = 120}}));
      bench.set_up(26, 5);
      bench.request();
      bench.simulator.advance(clocks * bench.period);
      if (soft) {
        bench.write(axireg::kAddrSoftReset, 1);
        bench.write(axireg::kAddrSoftReset, 0);
      } else {
        bench.write(axireg::kAddrChannelEnable, 2);
      }
      bench.simulator.advance(100 * sim::kPsPerUs);
      EXPECT_TRUE(bench.pin("ma0"));
      bench.write(axireg::kAddrChannelEnable, 3);
      bench.simulator.slave(1)->set_data(raw_word(clocks + 1));
      const auto beat = bench.frame();
      ASSERT_TRUE(beat) << clocks;
      EXPECT_EQ(beat->user, 3U) << clocks;
      EXPECT_EQ(beat->words[0], clocks + 1);
    }
  }
}

// SLO of one channel falls in the middle of a word and stays low: the others deliver every word,
// and the next read starts after the longest timeout, 4000 clocks.
TEST(Axi, LineStuckLowInAFrame_StopsNoOther) {
  AxiBench bench(axi_scenario({{}, {.delay_ns = 200}}));
  bench.set_up(26, 5);
  bench.simulator.slave(2)->set_data(raw_word(100));
  bench.simulator.inject("[[fault]]\nkind = \"stuck\"\nchannel = 1\nlevel = 0\nat_us = 8\n");
  bench.simulator.advance(5 * sim::kPsPerUs);
  const auto beat = bench.frame(30 * sim::kPsPerUs);
  ASSERT_TRUE(beat);
  EXPECT_EQ(beat->user, 2U);
  EXPECT_EQ(beat->words[1], 100U);
  EXPECT_FALSE(bench.frame(20 * sim::kPsPerUs)) << "held back by channel 1";
  bench.simulator.slave(2)->set_data(raw_word(101));
  const auto next = bench.frame(50 * sim::kPsPerUs);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->user, 2U);
  EXPECT_EQ(next->words[1], 101U);
}

// 0x2C, 0x30 and 0x3C are of the last start, also if it brought no word.
TEST(Axi, DebugRegistersOfAFrameWithoutCrc_AreNotThoseOfAnEarlierOne) {
  AxiBench bench(axi_scenario({{.delay_ns = 70}}));
  bench.set_up(26, 5);
  bench.simulator.slave(1)->set_data(raw_word(0x123'4567));
  for (const char* level : {"0", "1"}) {
    ASSERT_TRUE(bench.frame());
    ASSERT_NE(bench.read(axireg::kAddrReceivedCrc), 0U);
    expect_frame_without_crc(bench, level);
    EXPECT_EQ(bench.read(axireg::kAddrLineDelay), 1023U) << level;
  }
}

// A bit of two clocks is sampled behind its middle, up to its end, but never in the next one.
TEST(Axi, MaDividerOf1_ReadsEveryDelayWithoutJitter) {
  for (unsigned tenth = 0; tenth <= 200; tenth += 3) {
    AxiBench bench(axi_scenario({{.delay_ns = tenth * 5.0}}, 20'000'000));
    bench.set_up(26, 1);
    for (const std::uint32_t word : {0x155'5555U, 0x2AA'AAAAU, 0x333'3333U}) {
      bench.simulator.slave(1)->set_data(raw_word(word));
      const auto beat = bench.frame();
      ASSERT_TRUE(beat) << tenth;
      EXPECT_EQ(beat->user, 1U) << "delay of " << tenth << " tenths of a clock";
      EXPECT_EQ(beat->words[0], word) << tenth;
    }
  }
}

// Must hold: delays in steps of one clock x jitter on SL only.
TEST(Axi, DelaysTo120Clocks_AreReadRightWithJitterOnSl) {
  for (const std::uint64_t hz : {std::uint64_t{10'000'000}, std::uint64_t{100'000'000}}) {
    for (const unsigned jitter : {0U, 2U, 4U}) {  // clocks, peak to peak
      unsigned right = 0;
      for (unsigned delay = 0; delay <= 120; ++delay) {
        const double clock_ns = 1e9 / static_cast<double>(hz);
        AxiBench bench(axi_scenario(
            {{.delay_ns = delay * clock_ns,
              .keys =
                  jitter == 0 ? "" : "jitter_ns = " + std::to_string(jitter * clock_ns) + "\n"}},
            hz));
        bench.set_up(26, 5);
        bool good = true;
        for (unsigned round = 0; round < 4; ++round) {
          const std::uint32_t word = 0x2A5'A5A5U + 0x111'1111U * round;
          bench.simulator.slave(1)->set_data(raw_word(word & 0x3FF'FFFFU));
          const auto beat = bench.frame(700 * bench.period + 45 * sim::kPsPerUs);
          good = good && beat && beat->user == 1 && beat->words[0] == (word & 0x3FF'FFFFU);
        }
        const std::uint32_t measured = bench.read(axireg::kAddrLineDelay);
        if (jitter == 0)
          good = good && std::abs(static_cast<int>(measured) - static_cast<int>(delay)) <= 1;
        right += good ? 1 : 0;
      }
      EXPECT_EQ(right, 121U) << hz << " Hz, jitter " << jitter << " clocks";
    }
  }
}

}  // namespace
}  // namespace mb4test
