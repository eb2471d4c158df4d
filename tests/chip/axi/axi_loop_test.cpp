// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A control loop on a soft core: the sample clock of a timer, the interrupt, the last words of the
// page, no stream (docs/axi.md, "A processor alone").
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "biss_axi/device.hpp"
#include "biss_axi/page.hpp"
#include "tests/chip/axi/axi_bench.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/environment.hpp"

namespace mb4test {
namespace {

struct Port {
  bool write(std::uint32_t offset, std::uint32_t value) {
    ++accesses;
    return bench.host.write(offset, value) == std::uint8_t{0};
  }
  bool read(std::uint32_t offset, std::uint32_t& value) {
    ++accesses;
    const auto answer = static_cast<sim::WordHost&>(bench.host).read(offset, value);
    return answer == std::uint8_t{0};
  }
  AxiBench& bench;
  unsigned accesses = 0;
};

struct Clock {
  std::uint32_t now_us() {
    bench.simulator.advance(100 * sim::kPsPerNs);
    return static_cast<std::uint32_t>(bench.simulator.now() / sim::kPsPerUs);
  }
  AxiBench& bench;
};

std::string full(const std::string& text) { return with_features(text, "full"); }

struct Loop {
  explicit Loop(const std::vector<AxiEncoder>& encoders) : bench(full(axi_scenario(encoders))) {}
  AxiBench bench;
  Port port{bench};
  Clock clock{bench};
  biss_axi::Device<Port, Clock> device{port, clock};
  biss_axi::Page<Port> page{port};
};

constexpr unsigned kLoopHz = 16'000;
constexpr unsigned kChannels = 2;

biss_axi::Config by_timer() {
  biss_axi::Config config;
  config.start = biss_axi::Start::kInternalClock;
  config.sample_hz = kLoopHz;
  config.channels = (1U << kChannels) - 1;
  return config;
}

// The handler of the interrupt is late now and then, by up to two periods. Each read is delivered
// once to each channel, or its number is missed; each sample is a read or a skipped start.
TEST(AxiLoop, SamplesOfATimer_AreDeliveredOnceOrCounted) {
  const std::uint64_t samples = number("MB4_AXI_SAMPLES", 1'000);
  Dice dice;
  constexpr std::uint64_t kFirst = 3, kStep = 4;
  const std::string ramp = "source = \"ramp\"\nstart = 3\nstep = 4\n";
  Loop loop({{.delay_ns = 40, .slave = ramp}, {.delay_ns = 930, .slave = ramp}});
  ASSERT_TRUE(loop.page.enable_interrupt(biss_axi::kEventFrame).ok());
  ASSERT_TRUE(loop.device.configure(by_timer()).ok());
  const sim::Time begin = loop.bench.simulator.now();
  const auto limit = begin + sim::kPsPerSecond / kLoopHz * (samples + 10);
  std::uint64_t delivered = 0, missed = 0;
  std::uint16_t before[kChannels] = {};
  std::uint64_t total[kChannels] = {};  // reads so far
  while (delivered + missed < samples) {
    ASSERT_TRUE(
        loop.bench.simulator.run_while_waiting([&] { return loop.bench.pin("irq"); }, limit));
    if (dice.below(10) == 0) {
      loop.bench.simulator.advance(dice.below(130'000) * sim::kPsPerNs);
    }
    ASSERT_TRUE(loop.page.take_events().ok());
    for (unsigned c = 0; c < kChannels; ++c) {
      const auto last = loop.page.last(c);
      ASSERT_TRUE(last.ok());
      const auto step = static_cast<std::uint16_t>(last->number - before[c]);
      before[c] = last->number;
      if (step == 0) continue;  // no new word
      ASSERT_TRUE(last->good);
      ASSERT_FALSE(last->slave_error);
      ASSERT_FALSE(last->crc_error || last->late_start);
      // The encoder counts its frames: each read has one.
      total[c] += step;
      ASSERT_EQ(last->position, kFirst + kStep * (total[c] - 1));
      if (c == 0) {
        ++delivered;
        missed += step - 1U;
      }
    }
  }
  const auto skipped = loop.page.skipped_starts();
  ASSERT_TRUE(skipped.ok());
  const std::uint64_t passed = (loop.bench.simulator.now() - begin) * kLoopHz / sim::kPsPerSecond;
  EXPECT_NEAR(static_cast<double>(delivered + missed + *skipped), static_cast<double>(passed), 2.0);
  EXPECT_GT(delivered, samples * 8 / 10);
  EXPECT_GT(missed, 0U);
}

TEST(AxiLoop, UnpluggedLine_GivesNoNumbers) {
  Loop loop({{.slave = "data = " + std::to_string(raw_word(4711)) + "\n"},
             {.slave = "data = " + std::to_string(raw_word(815)) + "\n"}});
  ASSERT_TRUE(loop.page.enable_interrupt(biss_axi::kEventFrame).ok());
  ASSERT_TRUE(loop.device.configure(by_timer()).ok());
  std::uint16_t before = 0;
  for (unsigned n = 0; n < 40; ++n) {
    if (n == 20) {
      loop.bench.simulator.inject(
          "[[channel]]\nnumber = 2\n[[channel.event]]\nat_us = 0\naction = \"unplug\"\n");
    }
    ASSERT_TRUE(loop.bench.simulator.run_while_waiting(
        [&] { return loop.bench.pin("irq"); }, loop.bench.simulator.now() + sim::kPsPerSecond));
    ASSERT_TRUE(loop.page.take_events().ok());
    const auto plugged = loop.page.last(0);
    const auto line = loop.page.last(1);
    ASSERT_TRUE(plugged.ok() && line.ok());
    EXPECT_EQ(plugged->position, 4711U);
    EXPECT_EQ(line->number, plugged->number);
    EXPECT_EQ(static_cast<std::uint16_t>(line->number - before), 1U);
    before = line->number;
    EXPECT_EQ(line->good, n < 20) << n;
    EXPECT_EQ(line->position, n < 20 ? 815U : 0U) << n;
    EXPECT_EQ(line->slave_error, n >= 20) << n;
  }
}

// Without waiting: asks, goes on, and the interrupt says that the words are there.
TEST(AxiLoop, Request_ReturnsAtOnceAndTheInterruptTells) {
  Loop loop({{.slave = "data = " + std::to_string(raw_word(4711)) + "\n"}});
  ASSERT_TRUE(loop.page.enable_interrupt(biss_axi::kEventFrame).ok());
  ASSERT_TRUE(loop.device.configure({}).ok());
  for (unsigned n = 1; n < 10; ++n) {
    const auto asked = loop.page.request();
    ASSERT_TRUE(asked.ok());
    EXPECT_TRUE(*asked);
    EXPECT_FALSE(loop.bench.pin("irq"));
    const auto again = loop.page.request();  // in the frame
    ASSERT_TRUE(again.ok());
    EXPECT_FALSE(*again);
    ASSERT_TRUE(loop.bench.simulator.run_while_waiting(
        [&] { return loop.bench.pin("irq"); }, loop.bench.simulator.now() + sim::kPsPerSecond));
    ASSERT_TRUE(loop.page.take_events().ok());
    const auto last = loop.page.last(0);
    ASSERT_TRUE(last.ok());
    EXPECT_EQ(last->number, n);
    EXPECT_EQ(last->position, 4711U);
    loop.bench.simulator.advance(50 * sim::kPsPerUs);
  }
}

// The bus is free while a read waits.
TEST(AxiLoop, ReadAll_AsksSeldom) {
  for (const bool page : {false, true}) {
    const std::string text = axi_scenario({{}, {}});
    AxiBench bench(page ? full(text) : text);
    Port port{bench};
    Clock clock{bench};
    biss_axi::Device<Port, Clock> device(port, clock);
    biss_axi::Config config;
    config.channels = 3;
    ASSERT_TRUE(device.configure(config).ok());
    ASSERT_TRUE(device.read_all().ok());
    bench.simulator.advance(100 * sim::kPsPerUs);
    port.accesses = 0;
    const auto good = device.read_all();
    ASSERT_TRUE(good.ok());
    EXPECT_EQ(*good, 3U);
    EXPECT_LE(port.accesses, page ? 45U : 12U);
  }
}

}  // namespace
}  // namespace mb4test
