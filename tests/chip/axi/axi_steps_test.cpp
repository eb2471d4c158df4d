// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The ways to evaluate an edge of the clock (sim/model/edge_steps.hpp) give the same results:
// two masters see the same random session, one of them evaluated in the simplest way.
#include <string>
#include <vector>

#include "sim/core/random.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/chip/axi/axi_bench.hpp"

namespace mb4test {
namespace {

sim::SimulatorOptions evaluation(bool plain) {
  sim::SimulatorOptions options;
  options.plain_evaluation = plain;
  return options;
}

struct Side {
  Side(const std::string& text, bool plain)
      : simulator(sim::parse_scenario(text, "test.toml"), evaluation(plain)),
        host(simulator.host<sim::AxiHost>("axi")) {}
  sim::Simulator simulator;
  sim::AxiHost& host;
};

// Encoders with cables, jitter and processing times of their own.
std::string session_scenario(unsigned channels, sim::Random& random) {
  std::vector<AxiEncoder> encoders;
  for (unsigned c = 0; c < channels; ++c) {
    AxiEncoder encoder;
    encoder.bits = 10;
    encoder.delay_ns = static_cast<double>(random.next() % 500);
    encoder.keys = "jitter_ns = " + std::to_string(random.next() % 20) + "\n";
    encoder.slave =
        "source = \"ramp\"\nstep = 7\nbusy_periods = " + std::to_string(random.next() % 4) + "\n";
    encoders.push_back(encoder);
  }
  const std::string faults =
      "[[fault]]\nkind = \"bit-flip\"\nchannel = 1\nat_us = 300\nbits = [5]\n"
      "[[fault]]\nkind = \"stuck\"\nchannel = 1\nlevel = 0\nat_us = 500\nfor_us = 100\n"
      "[[fault]]\nkind = \"clock-stop\"\nat_us = 800\nfor_us = 3\n";
  return axi_scenario(encoders, 100'000'000, "", "") + faults;
}

// One access or one pin, the same on both sides.
void act(Side& side, unsigned channels, unsigned what, std::uint32_t value) {
  const auto set = [&](const char* pin) {
    side.simulator.set_pin(*side.simulator.pin_by_name(pin), (value & 1U) != 0);
  };
  switch (what % 10) {
    case 0:
      side.host.write(axireg::kAddrRequest, value & 1U);
      break;
    case 1:
      side.host.write(axireg::kAddrMode, value & 1U);
      break;
    case 2:
      side.host.write(axireg::kAddrSampleDivider, 100 + value % 500);
      break;
    case 3:
      side.host.write(axireg::kAddrMaDivider, 2 + value % 6);
      break;
    case 4:
      side.host.write(axireg::kAddrChannelEnable, 1U | (value & ((1U << channels) - 1U)));
      break;
    case 5:
      side.host.write(axireg::kAddrSampleClock, value & 1U);
      break;
    case 6:
      set("ext_sample_clk");
      break;
    case 7:  // mostly 1
      side.simulator.set_pin(*side.simulator.pin_by_name("sample_en"), value % 8 != 0);
      break;
    case 8:
      if (value % 4 != 0) break;
      side.host.write(axireg::kAddrSoftReset, 1);
      side.host.write(axireg::kAddrSoftReset, 0);
      break;
    default:
      if (value % 32 != 0) break;
      for (const bool level : {false, true}) {
        side.simulator.set_pin(*side.simulator.pin_by_name("axi_aresetn"), level);
        side.simulator.advance(35 * sim::kPsPerNs);
      }
  }
}

void expect_same(Side& left, Side& right, unsigned channels) {
  ASSERT_EQ(left.simulator.now(), right.simulator.now());
  ASSERT_EQ(left.simulator.clk_cycles(), right.simulator.clk_cycles());
  for (const char* pin : {"error", "warn", "sample_clk_output"}) {
    ASSERT_EQ(left.simulator.pin(*left.simulator.pin_by_name(pin)),
              right.simulator.pin(*right.simulator.pin_by_name(pin)))
        << pin;
  }
  for (unsigned c = 1; c <= channels; ++c) {
    ASSERT_EQ(left.simulator.slave(c)->frames(), right.simulator.slave(c)->frames());
    ASSERT_EQ(ma_check(left.simulator.line_end(c)).shortest(),
              ma_check(right.simulator.line_end(c)).shortest());
    left.host.write(axireg::kAddrChannelIndex, c - 1);
    right.host.write(axireg::kAddrChannelIndex, c - 1);
    for (unsigned address = 0; address <= axireg::kAddrLineDelay; address += 4) {
      ASSERT_EQ(left.host.read(address), right.host.read(address)) << c << " " << address;
    }
  }
  ASSERT_EQ(left.host.beats_waiting(), right.host.beats_waiting());
  while (const auto beat = left.host.next_beat()) {
    const auto other = right.host.next_beat();
    ASSERT_EQ(beat->time, other->time);
    ASSERT_EQ(beat->words, other->words);
    ASSERT_EQ(beat->user, other->user);
  }
}

TEST(AxiSteps, LessWork_ChangesNothing) {
  for (const unsigned channels : {1U, 3U, 4U, 6U}) {
    SCOPED_TRACE(channels);
    sim::Random random(channels);
    const std::string text = session_scenario(channels, random);
    Side plain(text, true);
    Side fast(text, false);
    for (Side* side : {&plain, &fast}) {
      side->host.write(axireg::kAddrPositionBits, 10);
      side->host.write(axireg::kAddrMaDivider, 5);
      side->host.write(axireg::kAddrCrcCheck, 1);
      side->host.write(axireg::kAddrChannelEnable, (1U << channels) - 1U);
    }
    std::uint64_t beats = 0;
    for (unsigned step = 0; step < 300; ++step) {
      const auto what = static_cast<unsigned>(random.next() % 10);
      const auto value = static_cast<std::uint32_t>(random.next());
      const sim::Time pause = random.next() % 20'000 * 1000;  // not only at edges of the clock
      for (Side* side : {&plain, &fast}) {
        act(*side, channels, what, value);
        side->simulator.advance(pause);
      }
      beats += fast.host.beats_waiting();
      ASSERT_NO_FATAL_FAILURE(expect_same(plain, fast, channels)) << "step " << step;
    }
    EXPECT_GT(fast.simulator.slave(1)->frames(), 20U);
    EXPECT_GT(beats, 20U);
  }
}

// Encoders read one by one, with long pauses. The internal sample clock is slow, so that the master
// is at rest between them (sim/model/model_rest.hpp); its own edges come in the pauses too.
TEST(AxiSteps, LeftOutClocksAtRest_ChangeNothing) {
  for (const unsigned channels : {1U, 4U}) {
    for (const std::string kind : {"document", "full", "frames"}) {
      SCOPED_TRACE(std::to_string(channels) + ", " + kind);
      sim::Random random(channels);
      const std::string text = session_scenario(channels, random);
      const std::string features = "\nfeatures = \"" + kind + "\"";
      const std::string clock = "f_clk_hz = 100000000";
      std::string with = text;
      with.replace(with.find(clock), clock.size(), clock + features);
      Side plain(with, true);
      Side fast(with, false);
      for (Side* side : {&plain, &fast}) {
        side->host.write(axireg::kAddrMode, 1);
        side->host.write(axireg::kAddrPositionBits, 10);
        side->host.write(axireg::kAddrCrcCheck, 1);
        side->host.write(axireg::kAddrChannelEnable, (1U << channels) - 1U);
      }
      for (unsigned step = 0; step < 8; ++step) {
        const auto divider = static_cast<std::uint32_t>(2 + random.next() % 40);
        const auto sample = static_cast<std::uint32_t>(10'000 + random.next() % 60'000);
        const sim::Time pause = 400'000'000 + random.next() % 300'000'000;  // ps
        for (Side* side : {&plain, &fast}) {
          side->host.write(axireg::kAddrSampleDivider, sample);
          side->host.write(axireg::kAddrMaDivider, divider);
          side->host.write(axireg::kAddrRequest, 0);
          side->host.write(axireg::kAddrRequest, 1);
          side->simulator.advance(pause);
        }
        ASSERT_NO_FATAL_FAILURE(expect_same(plain, fast, channels)) << "step " << step;
        for (const std::uint32_t address : {0x54U, 0x58U}) {  // the time of the page, if it has one
          ASSERT_EQ(plain.host.read(address), fast.host.read(address));
        }
      }
      EXPECT_EQ(plain.simulator.clk_cycles_left_out(), 0U);
      EXPECT_GT(fast.simulator.clk_cycles_left_out(), fast.simulator.clk_cycles() / 2);
      EXPECT_GT(fast.simulator.slave(1)->frames(), 4U);
    }
  }
}

}  // namespace
}  // namespace mb4test
