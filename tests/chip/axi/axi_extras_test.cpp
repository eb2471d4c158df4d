// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Extras of the BiSS C master on AXI, [chip] features = "full": the page behind 0x40 and what it
// configures (docs/axi.md, "Extras").
#include <array>
#include <string>
#include <vector>

#include "sim/core/random.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/registers/control_slave.hpp"
#include "tests/chip/axi/axi_bench.hpp"

namespace mb4test {
namespace {

std::string full(const std::string& text) { return with_features(text, "full"); }

std::string without_crc(std::string text) {
  for (std::size_t at = text.find("crc = 0x43\n"); at != std::string::npos;
       at = text.find("crc = 0x43\n")) {
    text.erase(at, 11);
  }
  return text;
}

// First rising edge of MA of each frame, as the line sees it.
struct Rises {
  std::vector<sim::Time> all;
  static void tap(sim::Time now, void* receiver, sim::ClockedLine::Signal signal, bool level) {
    auto& list = static_cast<Rises*>(receiver)->all;
    if (signal == sim::ClockedLine::Signal::kMa && level && (list.empty() || list.back() != now)) {
      list.push_back(now);
    }
  }
};

TEST(AxiExtras, Identity_IsTheCommonPage) {
  for (const unsigned channels : {1U, 4U, 16U}) {
    AxiBench bench(full(axi_scenario(std::vector<AxiEncoder>(channels))));
    EXPECT_EQ(bench.read(axireg::kAddrId), 0x454E'4302U);
    EXPECT_EQ(bench.read(axireg::kAddrVersion), axireg::kResetVersion);
    EXPECT_EQ(bench.read(axireg::kAddrFeatures), channels << 16U | 1U << 13U | 1U << 9U | 0x1FFU);
    // Words without a register.
    for (unsigned address : {0x5CU, 0xB0U, 0xC0U, 0xFCU}) {
      bench.write(static_cast<std::uint8_t>(address), ~0U);
      EXPECT_EQ(bench.read(static_cast<std::uint8_t>(address)), 0U) << address;
    }
  }
}

// Bits of each word of the page that keep what a host writes, and a write without all strobes.
TEST(AxiExtras, PageRegisters_HaveTheirWidthsAndAreWrittenWhole) {
  const std::vector<std::pair<std::uint8_t, std::uint32_t>> writable{
      {axireg::kAddrIrqEnable, 0x1F},       {axireg::kAddrCrcPolynomial, 0x1'FFFF},
      {axireg::kAddrCrcStart, 0xFFFF},      {axireg::kAddrTimeout, 0x800F'FFFF},
      {axireg::kAddrDelayTolerance, 0x3FF}, {axireg::kAddrDelayReference, 0x8000'03FF},
      {axireg::kAddrAccessData, 0xFF}};
  AxiBench bench(full(axi_scenario(std::vector<AxiEncoder>(4))));
  sim::Random random(3);
  for (const auto& [address, mask] : writable) {
    EXPECT_EQ(bench.read(address), 0U) << unsigned{address};
    for (int round = 0; round < 10; ++round) {
      const auto data = static_cast<std::uint32_t>(random.next());
      bench.write(address, data);
      EXPECT_EQ(bench.read(address), data & mask) << unsigned{address};
      EXPECT_EQ(bench.host.write(address, ~data, 0x7), std::uint8_t{0});
      EXPECT_EQ(bench.read(address), data & mask) << unsigned{address};
    }
    bench.write(address, ~0U);
  }
  for (const auto& [address, mask] : writable) EXPECT_EQ(bench.read(address), mask);
  // One reference for each channel.
  bench.write(axireg::kAddrChannelIndex, 2);
  EXPECT_EQ(bench.read(axireg::kAddrDelayReference), 0U);
  for (const std::uint8_t address :
       {axireg::kAddrId, axireg::kAddrVersion, axireg::kAddrFeatures, axireg::kAddrFrameCount,
        axireg::kAddrPositionHigh, axireg::kAddrSampleTimeLow}) {
    const std::uint32_t before = bench.read(address);
    bench.write(address, ~before);
    EXPECT_EQ(bench.read(address), before) << unsigned{address};
  }
}

// WIDE: positions beyond 32 bits, in 0x38 and 0x60 and in two words of the beat.
TEST(AxiExtras, WidePositions_HaveAHighWord) {
  sim::Random random(4);
  for (const unsigned bits : {1U, 31U, 32U, 33U, 40U, 61U, 62U}) {
    AxiBench bench(full(axi_scenario({{.bits = bits, .delay_ns = 35}, {.bits = bits}})));
    bench.set_up(bits, 5);
    for (int round = 0; round < 5; ++round) {
      const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
      const std::array<std::uint64_t, 2> sent{random.next() & mask, random.next() & mask};
      for (unsigned c = 0; c < 2; ++c) bench.simulator.slave(c + 1)->set_data(raw_word(sent[c]));
      const auto beat = bench.frame();
      ASSERT_TRUE(beat) << bits;
      EXPECT_EQ(beat->user, 3U);
      ASSERT_EQ(beat->words.size(), 8U);
      for (unsigned c = 0; c < 2; ++c) {
        EXPECT_EQ(beat->words[2 * c], static_cast<std::uint32_t>(sent[c])) << bits;
        EXPECT_EQ(beat->words[2 * c + 1], static_cast<std::uint32_t>(sent[c] >> 32U)) << bits;
        EXPECT_EQ(bench.read(c, axireg::kAddrSinglePointData), beat->words[2 * c]);
        EXPECT_EQ(bench.read(c, axireg::kAddrPositionHigh), beat->words[2 * c + 1]);
      }
    }
  }
}

// ANY_CRC: the remainder by the definition, inverted.
TEST(AxiExtras, AnyCrc_IsCheckedAndShown) {
  const auto crc = [](std::uint64_t word, unsigned bits, std::uint32_t polynomial,
                      std::uint32_t start) {
    unsigned degree = 0;
    while (polynomial >> (degree + 1) != 0) ++degree;
    std::uint32_t rest = start;
    for (unsigned bit = bits; bit-- > 0;) {
      rest = rest << 1U ^ static_cast<std::uint32_t>(word >> bit & 1U) << degree;
      if ((rest >> degree & 1U) != 0) rest ^= polynomial;
    }
    return ~rest & ((1U << degree) - 1U);
  };
  const std::pair<std::uint32_t, std::uint32_t> cases[] = {
      {0x43, 0},     {0x25, 0},    {0x25, 0x1F},      {0x13, 5},         {0x0B, 0},
      {0x12F, 0xA5}, {0x190D9, 0}, {0x190D9, 0xFFFF}, {0x11021, 0x1D0F}, {0x43, 0x2A}};
  for (const auto& [polynomial, start] : cases) {
    SCOPED_TRACE(testing::Message() << std::hex << polynomial << " start " << start);
    const std::string slave =
        "crc = " + std::to_string(polynomial) + "\ncrc_start = " + std::to_string(start) + "\n";
    AxiBench bench(full(without_crc(axi_scenario({{.delay_ns = 85, .slave = slave}}))));
    bench.set_up(26, 5);
    bench.write(axireg::kAddrCrcPolynomial, polynomial == 0x43 && start == 0 ? 0 : polynomial);
    bench.write(axireg::kAddrCrcStart, start);
    std::uint32_t good = 0;
    for (std::uint32_t word : {0x123'4567U, 0x3FF'FFFFU, 0U, 0x155'5555U}) {
      bench.simulator.slave(1)->set_data(raw_word(word));
      const auto beat = bench.frame();
      ASSERT_TRUE(beat);
      EXPECT_EQ(beat->user, 1U);
      EXPECT_EQ(beat->words[0], word);
      EXPECT_EQ(bench.read(axireg::kAddrReceivedCrc), crc(raw_word(word), 28, polynomial, start));
      EXPECT_EQ(bench.read(axireg::kAddrCalculatedCrc), bench.read(axireg::kAddrReceivedCrc));
      good = word;
    }
    bench.simulator.slave(1)->set_data(raw_word(0x0AA'AAAA));
    bench.simulator.inject("[[fault]]\nkind = \"bit-flip\"\nat_us = 0\nbits = [9]\n");
    const auto beat = bench.frame();
    ASSERT_TRUE(beat);
    EXPECT_EQ(beat->user, 0U);
    EXPECT_EQ(beat->words[0], good);
    EXPECT_NE(bench.read(axireg::kAddrCalculatedCrc), bench.read(axireg::kAddrReceivedCrc));
  }
}

// 0x2C and 0x30 are of the last start with all their bits, also if it brought no word.
TEST(AxiExtras, AnyCrcOfAFrameThatDidNotCome_IsZero) {
  AxiBench bench(full(without_crc(axi_scenario({{.delay_ns = 85, .slave = "crc = 0x190D9\n"}}))));
  bench.set_up(26, 5);
  bench.write(axireg::kAddrCrcPolynomial, 0x190D9);
  bench.simulator.slave(1)->set_data(raw_word(0x123'4567));
  for (const char* level : {"0", "1"}) {
    ASSERT_TRUE(bench.frame());
    ASSERT_GT(bench.read(axireg::kAddrReceivedCrc), 0x3FU);
    expect_frame_without_crc(bench, level);
  }
}

// TIMEOUT: adaptive with a limit that is shorter than the encoder's, and fixed.
TEST(AxiExtras, TimeoutRegister_LimitsOrFixesTheWait) {
  const auto run = [](const std::string& slave, std::uint32_t timeout) {
    AxiBench bench(full(axi_scenario({{.slave = slave}})));
    bench.set_up(26, 5);
    bench.write(axireg::kAddrTimeout, timeout);
    ASSERT_TRUE(bench.frame());  // takes the register
    bench.write(axireg::kAddrSampleDivider, 1);
    bench.write(axireg::kAddrMode, 0);
    bench.simulator.advance(100 * sim::kPsPerUs);
    while (bench.host.next_beat()) {
    }
    const std::uint32_t lates = bench.read(axireg::kAddrLateCount);
    bench.simulator.advance(200 * sim::kPsPerUs);
    std::optional<sim::Time> before;
    sim::Time least = sim::kNever, most = 0;
    unsigned beats = 0;
    while (const auto beat = bench.host.next_beat()) {
      if (before) least = std::min(least, beat->time - *before);
      if (before) most = std::max(most, beat->time - *before);
      before = beat->time;
      ++beats;
    }
    const double clock = static_cast<double>(bench.period);
    // A frame lasts 0.5 + 39 periods of 10 clocks.
    if (timeout == 0) {
      // The encoder's own 20 us.
      EXPECT_NEAR(static_cast<double>(least) / clock, 395 + 2000, 25);
      EXPECT_EQ(bench.read(axireg::kAddrLateCount), lates);
    } else if ((timeout >> 31U) != 0) {
      EXPECT_NEAR(static_cast<double>(least) / clock, 395 + 1500, 25);
      EXPECT_NEAR(static_cast<double>(most) / clock, 395 + 1500, 25);
    } else {
      // After the limit of 300 clocks each start is late until SLO is 1 again.
      EXPECT_GT(bench.read(axireg::kAddrLateCount), lates + 100);
      EXPECT_GT(beats, 100U);
    }
  };
  run("timeout = 20\n", 0);
  run("timeout = 20\n", 300);
  run("timeout = 5\n", 1U << 31U | 1500);
}

// COUNTERS, SKIP_COUNT: events that the simulator has made.
TEST(AxiExtras, Counters_CountWhatHappened) {
  AxiBench bench(full(axi_scenario({{}, {.delay_ns = 300}, {}})));
  bench.set_up(26, 5);
  const auto counts = [&](unsigned channel) {
    return std::array{bench.read(channel, axireg::kAddrFrameCount),
                      bench.read(channel, axireg::kAddrCrcErrorCount),
                      bench.read(channel, axireg::kAddrLateCount)};
  };
  using Counts = std::array<std::uint32_t, 3>;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(bench.frame());
  bench.simulator.inject("[[fault]]\nkind = \"bit-flip\"\nchannel = 2\nat_us = 0\nbits = [7]\n");
  ASSERT_TRUE(bench.frame());
  bench.simulator.inject(
      "[[fault]]\nkind = \"stuck\"\nchannel = 3\nlevel = 0\nat_us = 0\nfor_us = 50\n");
  bench.simulator.advance(sim::kPsPerUs);
  ASSERT_TRUE(bench.frame());
  bench.simulator.inject("[[fault]]\nkind = \"unplug\"\nslave = 1\nat_us = 0\n");
  bench.simulator.advance(sim::kPsPerUs);
  ASSERT_TRUE(bench.frame());
  EXPECT_EQ(counts(0), (Counts{6, 0, 0})) << "a frame without acknowledge has ended";
  EXPECT_EQ(counts(1), (Counts{6, 1, 0}));
  EXPECT_EQ(counts(2), (Counts{5, 0, 1}));
  EXPECT_EQ(counts(3), (Counts{0, 0, 0})) << "not in the scenario";
  EXPECT_EQ(bench.read(axireg::kAddrSkipCount), 0U);
  bench.request();
  for (int i = 0; i < 4; ++i) bench.request();
  EXPECT_EQ(bench.read(axireg::kAddrSkipCount), 4U);
  bench.simulator.advance(100 * sim::kPsPerUs);
  bench.write(axireg::kAddrSoftReset, 1);
  bench.write(axireg::kAddrSoftReset, 0);
  for (unsigned c = 0; c < 3; ++c) EXPECT_EQ(counts(c), (Counts{0, 0, 0}));
  EXPECT_EQ(bench.read(axireg::kAddrSkipCount), 0U);
}

// STAMP: the first rising edge of MA, in clocks of the same count as TIME.
TEST(AxiExtras, SampleTime_IsTheFirstRisingEdge) {
  AxiBench bench(full(axi_scenario({{}, {.delay_ns = 500}})));
  bench.set_up(26, 5);
  std::optional<std::int64_t> offset;
  for (const unsigned divider : {5U, 1U, 50U, 5U}) {
    bench.write(axireg::kAddrMaDivider, divider);
    Rises rises;
    clocked(bench.simulator.line(1))->set_tap(&Rises::tap, &rises);
    ASSERT_TRUE(bench.frame(150 * sim::kPsPerUs));
    ASSERT_FALSE(rises.all.empty());
    const std::uint64_t low = bench.read(axireg::kAddrSampleTimeLow);
    const std::uint64_t stamp = low | std::uint64_t{bench.read(axireg::kAddrSampleTimeHigh)} << 32U;
    const auto edge = static_cast<std::int64_t>(rises.all.front() / bench.period);
    const std::int64_t seen = static_cast<std::int64_t>(stamp) - edge;
    EXPECT_EQ(seen, offset.value_or(seen)) << "MA divider " << divider;
    offset = seen;
  }
  // TIME counts from the end of the reset on, 500 ns after power-on.
  EXPECT_NEAR(static_cast<double>(*offset), -50, 2);
  const std::uint32_t now = bench.read(axireg::kAddrTimeLow);
  EXPECT_NEAR(now, static_cast<double>(bench.simulator.now() / bench.period) - 50, 8);
  EXPECT_EQ(bench.read(axireg::kAddrTimeHigh), 0U);
}

// IRQ_STATUS, IRQ_ENABLE, pin irq.
TEST(AxiExtras, Interrupts_TellTheEventsOfThePage) {
  constexpr std::uint32_t kFrame = 1, kError = 2, kSense = 8, kLost = 16;
  AxiBench bench(full(axi_scenario({{}, {}})));
  bench.set_up(26, 5);
  const auto take = [&] {
    const std::uint32_t status = bench.read(axireg::kAddrIrqStatus);
    bench.write(axireg::kAddrIrqStatus, status);
    EXPECT_EQ(bench.read(axireg::kAddrIrqStatus), 0U);
    return status;
  };
  EXPECT_EQ(take(), 0U);
  ASSERT_TRUE(bench.frame());
  EXPECT_FALSE(bench.pin("irq"));
  bench.write(axireg::kAddrIrqEnable, kFrame);
  EXPECT_TRUE(bench.pin("irq"));
  EXPECT_EQ(take(), kFrame);
  EXPECT_FALSE(bench.pin("irq"));
  bench.simulator.inject("[[fault]]\nkind = \"bit-flip\"\nchannel = 2\nat_us = 0\nbits = [7]\n");
  ASSERT_TRUE(bench.frame());
  EXPECT_TRUE(bench.pin("irq"));
  EXPECT_EQ(take(), kFrame | kError);
  ASSERT_TRUE(bench.frame());
  ASSERT_TRUE(bench.frame());
  EXPECT_EQ(take(), kFrame | kLost) << "a frame ended while FRAME was still set";
  bench.request();
  bench.request();
  bench.simulator.advance(100 * sim::kPsPerUs);
  EXPECT_EQ(take(), kFrame | kLost) << "a start was skipped";
  bench.write(axireg::kAddrSampleClock, 1);
  bench.write(axireg::kAddrMode, 0);
  bench.set_pin("ext_sample_clk", true);
  bench.simulator.advance(100 * sim::kPsPerUs);
  EXPECT_EQ(take(), kFrame | kSense);
  bench.set_pin("ext_sample_clk", false);
  bench.simulator.advance(10 * sim::kPsPerUs);
  EXPECT_EQ(take(), 0U);
}

// ALARM: a delay beyond the tolerance, an encoder that is gone.
TEST(AxiExtras, DelayAlarm_IsOneOfItsChannel) {
  AxiBench bench(full(axi_scenario({{.delay_ns = 100}, {.delay_ns = 400}, {.delay_ns = 700}})));
  bench.set_up(26, 5);
  ASSERT_TRUE(bench.frame());
  bench.write(axireg::kAddrDelayTolerance, 3);
  std::array<std::uint32_t, 3> delay{};
  for (unsigned c = 0; c < 3; ++c) {
    delay[c] = bench.read(c, axireg::kAddrLineDelay);
    bench.write(axireg::kAddrDelayReference, delay[c] | 1U << 31U);
  }
  ASSERT_TRUE(bench.frame());
  EXPECT_EQ(bench.read(axireg::kAddrDelayAlarm), 0U);
  for (const int off : {3, -3, 4, -4, 9}) {
    const bool alarm = off > 3 || off < -3;
    bench.write(axireg::kAddrChannelIndex, 1);
    bench.write(axireg::kAddrDelayReference, (delay[1] + off) | 1U << 31U);
    bench.write(axireg::kAddrIrqStatus, 0x1F);
    ASSERT_TRUE(bench.frame());
    EXPECT_EQ(bench.read(axireg::kAddrDelayAlarm), alarm ? 2U : 0U) << off;
    EXPECT_EQ(bench.read(axireg::kAddrIrqStatus), alarm ? 3U : 1U) << off;
    // Not watched.
    bench.write(axireg::kAddrDelayReference, delay[1] + off);
    bench.write(axireg::kAddrDelayAlarm, 0x2);
    ASSERT_TRUE(bench.frame());
    EXPECT_EQ(bench.read(axireg::kAddrDelayAlarm), 0U) << off;
  }
  bench.simulator.inject("[[fault]]\nkind = \"unplug\"\nslave = 3\nat_us = 0\n");
  bench.simulator.advance(sim::kPsPerUs);
  ASSERT_TRUE(bench.frame());
  EXPECT_EQ(bench.read(axireg::kAddrDelayAlarm), 4U);
  bench.write(axireg::kAddrDelayAlarm, 0x3);
  EXPECT_EQ(bench.read(axireg::kAddrDelayAlarm), 4U) << "another channel's bit";
  bench.write(axireg::kAddrSoftReset, 1);
  bench.write(axireg::kAddrSoftReset, 0);
  EXPECT_EQ(bench.read(axireg::kAddrDelayAlarm), 0U);
}

// ALIGN_LATCH, 3.9: channels with their bit in MA_SHIFT latch at the instant of the slowest one. It
// is a switch of the document, so it needs no extra.
class AxiAlign : public testing::TestWithParam<bool> {};

TEST_P(AxiAlign, AlignLatch_MakesAllEncodersLatchTogether) {
  const bool all_extras = GetParam();
  const std::vector<double> delays{20, 330, 1000, 640};
  std::vector<AxiEncoder> encoders;
  for (const double delay : delays) encoders.push_back({.delay_ns = delay});
  for (const bool on : {true, false}) {
    const std::string scenario = axi_scenario(
        encoders, 100'000'000, "", std::string("ALIGN_LATCH = ") + (on ? "true\n" : "false\n"));
    AxiBench bench(all_extras ? full(scenario) : scenario);
    bench.set_up(26, 5);
    bench.write(axireg::kAddrMaShift, 0xF);
    for (unsigned round = 0; round < 4; ++round) {
      std::array<Rises, 4> rises;
      for (unsigned c = 0; c < 4; ++c) {
        clocked(bench.simulator.line(c + 1))->set_tap(&Rises::tap, &rises[c]);
        bench.simulator.slave(c + 1)->set_data(raw_word(1000 * round + c));
      }
      if (round == 3) bench.write(axireg::kAddrMaShift, 0xD);
      const auto beat = bench.frame();
      ASSERT_TRUE(beat);
      EXPECT_EQ(beat->user, 0xFU);
      for (unsigned c = 0; c < 4; ++c) {
        EXPECT_EQ(beat->words[all_extras ? 2 * c : c], 1000 * round + c);
        EXPECT_NEAR(bench.read(c, axireg::kAddrLineDelay), delays[c] / 10, 1);
        ASSERT_FALSE(rises[c].all.empty());
        // Edge at the master and half the round trip.
        const auto latch = [&](unsigned channel) {
          return static_cast<double>(rises[channel].all.front()) / 1e3 + delays[channel] / 2;
        };
        const bool shifted = on && round > 0 && !(round == 3 && c == 1);
        const double expected = shifted ? 0 : (delays[c] - delays[2]) / 2;
        EXPECT_NEAR(latch(c) - latch(2), expected, 10.1) << "channel " << c << " round " << round;
      }
    }
    // The page is an extra.
    EXPECT_EQ(bench.read(axireg::kAddrId) != 0, all_extras);
  }
}

INSTANTIATE_TEST_SUITE_P(Features, AxiAlign, testing::Bool(), [](const auto& one) {
  return std::string(one.param ? "full" : "document");
});

// The next larger model, and the first frame of each size.
TEST(AxiExtras, AlignLatchOfSixteenChannels_ActsAsOfFour) {
  std::vector<AxiEncoder> encoders(16);
  for (unsigned c = 0; c < 16; ++c) encoders[c].delay_ns = 20 + 60 * c;
  AxiBench bench(axi_scenario(encoders, 100'000'000, "", "ALIGN_LATCH = true\n"));
  bench.set_up(26, 5);
  bench.write(axireg::kAddrMaShift, 0xFFFF);
  ASSERT_TRUE(bench.frame());
  std::array<Rises, 16> rises;
  for (unsigned c = 0; c < 16; ++c) {
    clocked(bench.simulator.line(c + 1))->set_tap(&Rises::tap, &rises[c]);
    bench.simulator.slave(c + 1)->set_data(raw_word(c));
  }
  const auto beat = bench.frame();
  ASSERT_TRUE(beat);
  EXPECT_EQ(beat->user, 0xFFFFU);
  for (unsigned c = 0; c < 16; ++c) {
    EXPECT_EQ(beat->words[c], c);
    const double latch = static_cast<double>(rises[c].all.front()) / 1e3 + encoders[c].delay_ns / 2;
    const double last =
        static_cast<double>(rises[15].all.front()) / 1e3 + encoders[15].delay_ns / 2;
    EXPECT_NEAR(latch, last, 10.1) << "channel " << c;
  }
}

// One channel has nothing to be aligned to: the switch changes nothing.
TEST(AxiExtras, AlignLatchOfOneChannel_ChangesNothing) {
  std::array<std::vector<sim::Time>, 2> edges;
  for (const bool on : {false, true}) {
    AxiBench bench(axi_scenario({{.delay_ns = 500}}, 100'000'000, "",
                                std::string("ALIGN_LATCH = ") + (on ? "true\n" : "false\n")));
    bench.set_up(26, 5);
    bench.write(axireg::kAddrMaShift, 1);
    Rises rises;
    clocked(bench.simulator.line(1))->set_tap(&Rises::tap, &rises);
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(bench.frame());
    edges[on ? 1 : 0] = rises.all;
  }
  EXPECT_EQ(edges[0], edges[1]);
  EXPECT_GT(edges[0].size(), 60U);
}

const std::string kSlave = "registers = { 0x20 = [0x5A], 0x21 = [0xC3] }\n";

struct Access {
  AxiBench& bench;
  // Status when the access has ended; frames go on all the time.
  std::uint32_t run(unsigned channel, bool write, unsigned address, std::uint8_t data = 0,
                    unsigned slave = 0) {
    bench.write(axireg::kAddrAccessData, data);
    bench.write(axireg::kAddrAccess,
                1U << 31U | (write ? 1U << 16U : 0U) | channel << 12U | slave << 8U | address);
    for (int i = 0; i < 5000; ++i) {
      bench.simulator.advance(20 * sim::kPsPerUs);
      const std::uint32_t status = bench.read(axireg::kAddrAccessStatus);
      if ((status & 1U) == 0) return status;
    }
    ADD_FAILURE() << "the access does not end";
    return ~0U;
  }
  std::uint32_t data() { return bench.read(axireg::kAddrAccessData); }
};

// Positions of all channels at 25 kHz, each one more than the last, while registers are accessed.
TEST(AxiExtras, RegisterAccess_ReadsAndWritesWhilePositionsFlow) {
  const std::string ramp = "source = \"ramp\"\nstep = 1\n";
  AxiBench bench(full(axi_scenario({{.delay_ns = 35, .slave = ramp + kSlave},
                                    {.delay_ns = 835, .slave = ramp + kSlave},
                                    {.delay_ns = 235, .slave = ramp + kSlave}})));
  bench.write(axireg::kAddrSampleDivider, 2000);
  bench.set_up(26, 5);
  bench.write(axireg::kAddrMode, 0);
  Access access{bench};
  sim::Random random(5);
  std::vector<std::uint32_t> last;
  unsigned beats = 0;
  for (unsigned round = 0; round < 40; ++round) {
    const auto channel = static_cast<unsigned>(random.next() % 3);
    const auto address = 0x20 + static_cast<unsigned>(random.next() % 0x18);
    const auto value = static_cast<std::uint8_t>(random.next());
    sim::Slave& slave = *bench.simulator.slave(channel + 1);
    EXPECT_EQ(access.run(channel, true, address, value), 0U) << round;
    EXPECT_EQ(slave.reg_read(static_cast<std::uint8_t>(address)), value) << round;
    EXPECT_EQ(access.run(channel, false, address), 0U) << round;
    EXPECT_EQ(access.data(), value) << round;
    while (const auto beat = bench.host.next_beat()) {
      EXPECT_EQ(beat->user, 7U);
      if (!last.empty()) {
        for (unsigned c = 0; c < 3; ++c) EXPECT_EQ(beat->words[2 * c], last[2 * c] + 1) << c;
      }
      last = beat->words;
      ++beats;
    }
  }
  EXPECT_GT(beats, 2000U);
  const auto& counters = clocked(bench.simulator.slave(1))->control()->counters();
  EXPECT_EQ(counters.header_errors + counters.data_errors + counters.protocol_errors, 0U);
  EXPECT_EQ(access.run(0, false, 0x21), 0U);
}

// The line is longer than the word: MA has all its edges before CDS comes back, and CDM still
// depends on it.
TEST(AxiExtras, RegisterAccessOverALineLongerThanTheWord_IsRight) {
  AxiBench bench(full(axi_scenario({{.bits = 4, .delay_ns = 4000, .slave = kSlave}})));
  bench.write(axireg::kAddrSampleDivider, 1500);
  bench.set_up(4, 5);
  bench.write(axireg::kAddrMode, 0);
  Access access{bench};
  EXPECT_EQ(access.run(0, false, 0x21), 0U);
  EXPECT_EQ(access.data(), 0xC3U);
  EXPECT_EQ(access.run(0, true, 0x20, 0x3C), 0U);
  EXPECT_EQ(bench.simulator.slave(1)->reg_read(0x20), 0x3C);
  EXPECT_EQ(access.run(0, false, 0x20), 0U);
  EXPECT_EQ(access.data(), 0x3CU);
}

TEST(AxiExtras, RegisterAccessThatFails_SaysHow) {
  const std::string unidirectional = "control = false\n";
  AxiBench bench(full(axi_scenario({{.slave = kSlave + "missing = [0x30]\n"},
                                    {.slave = unidirectional},
                                    {.delay_ns = 100, .slave = kSlave}})));
  bench.write(axireg::kAddrSampleDivider, 1000);
  bench.set_up(26, 5);
  bench.write(axireg::kAddrMode, 0);
  Access access{bench};
  constexpr std::uint32_t kError = 2, kSilent = 4, kRegisterEnd = 4;
  bench.write(axireg::kAddrIrqStatus, 0x1F);
  EXPECT_EQ(access.run(1, false, 0x20), kError) << "no echo of R and W";
  EXPECT_NE(bench.read(axireg::kAddrIrqStatus) & kRegisterEnd, 0U);
  EXPECT_EQ(access.run(0, false, 0x30), kSilent) << "a register that does not exist";
  EXPECT_EQ(access.run(0, false, 0x20, 0, 3), kError) << "a slave that does not exist";
  EXPECT_EQ(access.run(9, false, 0x20), kError) << "a channel that does not exist";
  // The host ends it.
  bench.write(axireg::kAddrAccess, 1U << 31U | 0x20);
  bench.simulator.advance(300 * sim::kPsPerUs);
  EXPECT_EQ(bench.read(axireg::kAddrAccess), 1U << 31U | 0x20U);
  EXPECT_EQ(bench.read(axireg::kAddrAccessStatus), 1U);
  bench.write(axireg::kAddrAccess, 1U << 31U | 0x21);
  EXPECT_EQ(bench.read(axireg::kAddrAccess), 1U << 31U | 0x20U) << "one at a time";
  bench.write(axireg::kAddrAccess, 0);
  EXPECT_EQ(bench.read(axireg::kAddrAccessStatus), kError);
  // A frame that fails.
  bench.write(axireg::kAddrAccess, 1U << 31U | 2U << 12U | 0x20);
  bench.simulator.advance(800 * sim::kPsPerUs);
  EXPECT_EQ(bench.read(axireg::kAddrAccessStatus), 1U);
  bench.simulator.inject("[[fault]]\nkind = \"silent\"\nslave = 3\nat_us = 0\nfor_us = 50\n");
  bench.simulator.advance(100 * sim::kPsPerUs);
  EXPECT_EQ(bench.read(axireg::kAddrAccessStatus), kError);
  // SLO that falls in the middle of a frame is an acknowledge without start bit: 1024 bits more.
  bench.simulator.advance(200 * sim::kPsPerUs);
  EXPECT_EQ(access.run(2, false, 0x21), 0U);
  EXPECT_EQ(access.data(), 0xC3U);
  EXPECT_EQ(access.run(0, false, 0x20), 0U);
  EXPECT_EQ(access.data(), 0x5AU);
}

TEST(AxiScenario, FeaturesAndAlignLatch_AreIndependentKeys) {
  const auto error = [](const std::string& chip) -> std::string {
    try {
      sim::parse_scenario("[master]\ntype = \"axi\"\n" + chip, "test.toml");
    } catch (const sim::ScenarioError& failure) {
      return failure.what();
    }
    return "";
  };
  EXPECT_EQ(error("[chip]\nfeatures = \"full\"\n[chip.quirks]\nALIGN_LATCH = true\n"), "");
  EXPECT_EQ(error("[chip]\nfeatures = \"document\"\n[chip.quirks]\nALIGN_LATCH = true\n"), "");
  EXPECT_EQ(error("[chip.quirks]\nALIGN_LATCH = true\n"), "");
  EXPECT_NE(error("[chip]\nfeatures = \"most\"\n").find("key 'features'"), std::string::npos);
  EXPECT_NE(error("[chip.quirks]\nALIGN_LATCH = 2\n").find("key 'ALIGN_LATCH'"), std::string::npos);
}

}  // namespace
}  // namespace mb4test
