// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Cables of a scenario: keys, events at given times, and one seed for all random choices.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mb4sim/simulator.hpp"
#include "sim/core/wire_faults.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/masters/mb4/pins.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/support/scenario_place.hpp"

namespace mb4test {

using namespace mb4::sim;

namespace {

std::string channel(const std::string& keys) {
  return "[[channel]]\nnumber = 1\n" + keys +
         "\n[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 8\n";
}

ClockedConfig parse(const std::string& keys) {
  return clocked(*parse_scenario(channel(keys), "s.toml").channels.front().cable);
}

TEST(CableKeys, LengthAndTransceivers_AddUpToTheRoundTrip) {
  EXPECT_EQ(parse("").delay, 0U);
  EXPECT_EQ(parse("cable_m = 10").delay, 106'000U);
  EXPECT_EQ(parse("cable_m = 10\nns_per_m = 8.3").delay, 166'000U);
  EXPECT_EQ(parse("cable_m = 10\nns_per_m = 8.3\ntransceiver_ns = 69").delay, 304'000U);
  EXPECT_EQ(parse("delay_ns = 12.5\ntransceiver_ns = 1.5").delay, 15'500U);
}

TEST(CableKeys, AllFaults_AreReadWithTheirUnits) {
  const ClockedConfig cable = parse(
      "jitter_ns = 1.5\nma_jitter_ns = 2\nskew_ns = -3\nma_skew_ns = 0.25\n"
      "glitches_per_s = 100\nma_glitches_per_s = 200\nglitch_ns = 7\nopen_level = 0\n"
      "[[channel.event]]\nat_us = 1.5\naction = \"unplug\"\n"
      "[[channel.event]]\nat_us = 2\naction = \"ma-free\"\n");
  EXPECT_EQ(cable.sl.jitter, 1500U);
  EXPECT_EQ(cable.ma.jitter, 2000U);
  EXPECT_EQ(cable.sl.skew, -3000);
  EXPECT_EQ(cable.ma.skew, 250);
  EXPECT_EQ(cable.sl.glitches_per_s, 100U);
  EXPECT_EQ(cable.ma.glitches_per_s, 200U);
  EXPECT_EQ(cable.sl.glitch_width, 7000U);
  EXPECT_EQ(cable.ma.glitch_width, 7000U);
  EXPECT_FALSE(cable.open_level);
  ASSERT_EQ(cable.events.size(), 2U);
  EXPECT_EQ(cable.events[0].time, 1'500'000U);
  EXPECT_EQ(cable.events[0].action, ClockedLine::kUnplug);
  EXPECT_EQ(cable.events[1].action, ClockedLine::kMaFree);
  const ClockedConfig none = parse("");
  EXPECT_FALSE(none.sl.any() || none.ma.any());
  EXPECT_TRUE(none.open_level);
}

struct BadCable {
  const char* name;
  const char* keys;
  const char* message;
};

class BadCables : public testing::TestWithParam<BadCable> {};

TEST_P(BadCables, AreRefusedWithPlaceAndKey) {
  try {
    parse(GetParam().keys);
    FAIL() << "accepted";
  } catch (const ScenarioError& error) {
    const std::string text = channel(GetParam().keys);
    EXPECT_EQ(error.what(), with_section(text, GetParam().message));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BadCables,
    testing::Values(
        BadCable{"NsPerMetreAlone", "ns_per_m = 5",
                 "s.toml:3:12: key 'ns_per_m': only together with cable_m"},
        BadCable{"NegativeJitter", "jitter_ns = -1",
                 "s.toml:3:13: key 'jitter_ns': -1 is outside 0 to 100000"},
        BadCable{"SkewTooLarge", "ma_skew_ns = 1e6",
                 "s.toml:3:14: key 'ma_skew_ns': 1e+06 is outside -100000 to 100000"},
        BadCable{"GlitchWidthAlone", "glitch_ns = 5",
                 "s.toml:3:13: key 'glitch_ns': only together with glitches_per_s or "
                 "ma_glitches_per_s"},
        BadCable{"TooManyGlitches", "glitches_per_s = 10000001",
                 "s.toml:3:18: key 'glitches_per_s': 10000001 is outside 0 to 10000000"},
        BadCable{"OpenLevel", "open_level = 2",
                 "s.toml:3:14: key 'open_level': 2 is outside 0 to 1"},
        BadCable{"Misspelt", "jiter_ns = 1",
                 "s.toml:3:1: key 'jiter_ns': unknown key, did you mean 'jitter_ns'?"},
        BadCable{"EventWithoutTime", "[[channel.event]]\naction = \"plug\"",
                 "s.toml:3:1: key 'at_us': missing"},
        BadCable{"EventWithoutAction", "[[channel.event]]\nat_us = 1",
                 "s.toml:3:1: key 'action': missing"},
        BadCable{"EventUnknown", "[[channel.event]]\nat_us = 1\naction = \"pull\"",
                 "s.toml:5:10: key 'action': unknown value 'pull', expected one of: unplug, plug, "
                 "sl-low, sl-high, sl-free, ma-low, ma-high, ma-free"},
        BadCable{"EventUnknownKey", "[[channel.event]]\nat_us = 1\naction = \"plug\"\nlevel = 1",
                 "s.toml:6:1: key 'level': unknown key; write level = 1 under [[fault]]"}),
    [](const auto& entry) { return entry.param.name; });

// A chip with one 8-bit slave; channel, CRC and MA at 5 MHz set up by hand.
struct CableBench {
  explicit CableBench(const std::string& keys, std::uint64_t seed = 1)
      : sim(parse_scenario(channel(keys), "s.toml"), SimulatorOptions{seed, std::nullopt}) {
    for (const std::vector<std::uint8_t>& bytes :
         {std::vector<std::uint8_t>{0x02, 0xC0, 0x47, 0x06, 0, 0},
          {0x02, 0xE6, 0xA1},
          {0x02, 0xEC, 0x01, 0x0D}}) {
      std::vector<std::uint8_t> rx(bytes.size());
      sim.spi().transfer(bytes, rx);
    }
  }
  std::uint8_t transfer(std::vector<std::uint8_t> tx) {
    std::vector<std::uint8_t> rx(tx.size());
    sim.spi().transfer(tx, rx);
    return rx.back();
  }
  // One frame; status 0xF0, EOT in bit 0.
  std::uint8_t frame() {
    transfer({0x07, 0x04});
    sim.advance(30 * kPsPerUs);
    return transfer({0x05, 0x00});
  }
  bool at(double us, Pin pin) {
    sim.run_until(from_us(us));
    return sim.pin(pin);
  }
  Simulator sim;
};

TEST(LineEvents, StuckSl_FollowsTheEventsOfTheScenario) {
  CableBench bench(
      "[[channel.event]]\nat_us = 100\naction = \"sl-low\"\n"
      "[[channel.event]]\nat_us = 200\naction = \"sl-free\"\n");
  EXPECT_TRUE(bench.at(99.9, Pin::kSl1));
  EXPECT_FALSE(bench.at(100.1, Pin::kSl1));
  EXPECT_EQ(bench.frame() & 0x40, 0x00) << "nAGSERR: SL low at the start";
  EXPECT_FALSE(bench.at(199.9, Pin::kSl1));
  EXPECT_TRUE(bench.at(200.1, Pin::kSl1));
  EXPECT_EQ(bench.frame() & 0x11, 0x11) << "nSCDERR, EOT";
}

// Unplugged in the middle of a frame: no answer; BREAK, plug, and the next frame is good.
TEST(LineEvents, UnpluggedAndPlugged_AtEveryPhaseOfAFrame_NextFrameIsGood) {
  for (unsigned phase = 0; phase < 40; ++phase) {
    CableBench bench("delay_ns = 70");
    ASSERT_EQ(bench.frame() & 0x11, 0x11);
    bench.transfer({0x07, 0x04});
    bench.sim.advance(phase * 130 * kPsPerNs);
    bench.sim.line(1)->act(bench.sim.now(), ClockedLine::kUnplug);
    EXPECT_FALSE(bench.sim.line(1)->plugged());
    bench.sim.advance(50 * kPsPerUs);
    EXPECT_TRUE(clocked(bench.sim.slave(1))->idle()) << phase;
    const auto frames = bench.sim.slave(1)->frames();
    if ((bench.transfer({0x05, 0x00}) & 0x01) == 0) bench.transfer({0x07, 0x80});
    EXPECT_EQ(bench.frame() & 0x01, 0x00) << "no slave: MA runs on until BREAK";
    EXPECT_EQ(bench.sim.slave(1)->frames(), frames);
    bench.sim.line(1)->act(bench.sim.now(), ClockedLine::kPlug);
    bench.sim.advance(10 * kPsPerUs);
    bench.transfer({0x07, 0x80});
    bench.sim.advance(50 * kPsPerUs);
    EXPECT_EQ(bench.frame() & 0x11, 0x11) << phase;
  }
}

TEST(LineEvents, OpenPair_ShowsItsOpenLevel) {
  for (const bool level : {false, true}) {
    CableBench bench("open_level = " + std::to_string(level) +
                     "\n[[channel.event]]\nat_us = 100\naction = \"unplug\"\n");
    EXPECT_TRUE(bench.at(99.9, Pin::kSl1));
    EXPECT_EQ(bench.at(100.1, Pin::kSl1), level);
  }
}

TEST(LineEvents, BrokenMa_SlaveSeesNoFrame) {
  CableBench bench("[[channel.event]]\nat_us = 50\naction = \"ma-high\"\n");
  bench.sim.run_until(from_us(60));
  bench.frame();
  EXPECT_EQ(bench.sim.slave(1)->frames(), 0U);
  bench.transfer({0x07, 0x80});
  bench.sim.advance(10 * kPsPerUs);
  bench.sim.line(1)->act(bench.sim.now(), ClockedLine::kMaFree);
  EXPECT_EQ(bench.frame() & 0x11, 0x11);
  EXPECT_EQ(bench.sim.slave(1)->frames(), 1U);
}

// The same seed gives the same edges to the picosecond; another seed gives others.
TEST(CableSeed, JitterAndGlitches_RepeatWithTheSeed) {
  const auto run = [](std::uint64_t seed) {
    CableBench bench("jitter_ns = 30\nma_jitter_ns = 5\nglitches_per_s = 200000\nglitch_ns = 3\n",
                     seed);
    std::vector<Time> changes;
    bool level = true;
    bench.transfer({0x07, 0x04});
    bench.sim.run_while_waiting(
        [&] {
          if (bench.sim.pin(Pin::kSl1) != level) changes.push_back(bench.sim.now());
          level = bench.sim.pin(Pin::kSl1);
          return false;
        },
        bench.sim.now() + 100 * kPsPerUs);
    return changes;
  };
  const std::vector<Time> first = run(1);
  EXPECT_GT(first.size(), 20U);
  EXPECT_EQ(first, run(1));
  EXPECT_NE(first, run(2));
}

// The guard at the MA pin is part of every simulation: a pulse that is too short ends the
// simulation.
TEST(MaGuard, ShortenedMa_EndsTheSimulation) {
  CableBench bench("");
  bench.frame();
  EXPECT_EQ(ma_check(bench.sim.line_end(1)).shortest(), 100 * kPsPerNs);
  EXPECT_GT(ma_check(bench.sim.line_end(1)).pulses(), 30U);
  EXPECT_EQ(ma_check(bench.sim.line_end(2)).pulses(), 0U);
  ma_check(bench.sim.line_end(1)).require(100 * kPsPerNs);
  EXPECT_EQ(bench.frame() & 0x11, 0x11);
  bench.transfer({0x02, 0xE6, 0xA0});  // MA at 10 MHz: half of it
  try {
    bench.frame();
    FAIL() << "a short pulse went by";
  } catch (const ModelStopped& error) {
    EXPECT_EQ(std::string(error.what()).rfind("MA1: short MA pulse: low for 50000 ps", 0), 0U)
        << error.what();
  }
  EXPECT_THROW(bench.sim.advance(1), ModelStopped);
}

}  // namespace
}  // namespace mb4test
