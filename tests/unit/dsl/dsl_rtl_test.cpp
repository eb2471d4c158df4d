// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The RTL of the DSL master in the simulator: two ways to compute an edge give the same, and no
// access of a host hangs or spoils the next one, whatever its clocks and resets do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "dsl_page_regs.hpp"
#include "dsl_regs.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/core/random.hpp"
#include "sim/hosts/word_host.hpp"
#include "sim/scenario/scenario.hpp"

namespace {

namespace sim = mb4::sim;
namespace map = dsl::regs;
namespace page = dsl::page;

constexpr std::uint32_t kLast = page::kAddrTimeHigh;
constexpr const char* kPins[] = {"dsl_out_o", "dsl_en_o", "dsl_in_i",      "irq_o",
                                 "link_o",    "rst_ni",   "s_axi_aresetn", "position_ready_o"};

std::string motor(const std::string& host, const std::string& faults) {
  return "[master]\ntype = \"dsl\"\n" + host +
         "[[channel]]\nnumber = 1\ncable_m = 25.0\njitter_ns = 8.0\nanswer_errors = 1e-4\n"
         "[[channel.slave]]\nprotocol = \"dsl\"\nposition_bits = 28\nsource = \"ramp\"\n"
         "step = 700\n" +
         faults;
}

class DslSim {
 public:
  DslSim(const std::string& text, std::uint64_t seed, bool plain) {
    sim::Scenario scenario = sim::parse_scenario(text, "test");
    scenario.seed = seed;
    sim::SimulatorOptions options;
    options.plain_evaluation = plain;
    simulator.emplace(scenario, options);
    bus = simulator->word_bus();
  }
  void set(const char* pin, bool level) { simulator->set_pin(*simulator->pin_by_name(pin), level); }
  bool level(const char* pin) const { return simulator->pin(*simulator->pin_by_name(pin)); }

  std::optional<sim::Simulator> simulator;
  sim::WordHost* bus = nullptr;
};

class DslRtl : public testing::TestWithParam<std::uint64_t> {};

TEST_P(DslRtl, EdgesInParts_ChangeNothing) {
  const std::string text =
      motor("",
            "[[fault]]\nkind = \"unplug\"\nslave = 1\nat_us = 4000\nfor_us = 200\n[[fault]]\n"
            "kind = \"clock-stop\"\nat_us = 7000\nfor_us = 5\n");
  DslSim plain(text, GetParam(), true);
  DslSim parts(text, GetParam(), false);
  sim::Random random(GetParam());
  constexpr unsigned kSteps = 400;
  std::uint32_t frames = 0;
  for (unsigned step = 0; step < kSteps; ++step) {
    SCOPED_TRACE(step);
    const std::uint64_t what = random.up_to(99);
    const auto value = static_cast<std::uint32_t>(random.next());
    const auto address = static_cast<std::uint32_t>(random.up_to(kLast / 4) * 4);
    const auto strobes = static_cast<std::uint8_t>(random.up_to(15));
    const sim::Time pause = random.up_to(random.up_to(1) == 0 ? 300'000 : 60'000'000);
    for (DslSim* side : {&plain, &parts}) {
      if (what == 0) {
        const char* pin = value % 2 == 0 ? "rst_ni" : "s_axi_aresetn";
        side->set(pin, false);
        side->simulator->advance(value % 200'000);
        side->set(pin, true);
      } else if (what < 20) {
        // Not PRST: the link would seldom be there.
        const bool harmless = address != map::kAddrSysCtrl || step % 10 == 0;
        if (harmless) side->bus->write(address, value, strobes);
      } else if (what < 22) {
        side->bus->write(map::kAddrSysCtrl, 0, 0xF);
      }
      side->simulator->advance(pause);
    }
    ASSERT_EQ(plain.simulator->now(), parts.simulator->now());
    ASSERT_EQ(plain.simulator->clk_cycles(), parts.simulator->clk_cycles());
    for (const char* pin : kPins) ASSERT_EQ(plain.level(pin), parts.level(pin)) << pin;
    for (std::uint32_t at = step % 8 * 4; at <= kLast; at += 32) {
      std::uint32_t one = 0;
      std::uint32_t other = 0;
      ASSERT_EQ(plain.bus->read(at, one), parts.bus->read(at, other)) << at;
      ASSERT_EQ(one, other) << at;
      if (at == page::kAddrFrameCount) frames = std::max(frames, one);
    }
  }
  EXPECT_GT(frames, 20U);  // the session has had a link
}

INSTANTIATE_TEST_SUITE_P(Seeds, DslRtl, testing::Range<std::uint64_t>(1, 5));

class DslBus : public testing::TestWithParam<std::uint64_t> {};

// Every access ends, and the first one behind a time of misuse is right.
TEST_P(DslBus, AccessesOfAnyKind_LeaveTheMasterUsable) {
  DslSim side(motor("[host]\nbus_hz = " + std::to_string(GetParam()) + "\n", ""), 3, false);
  sim::Random random(GetParam());
  for (unsigned step = 0; step < 300; ++step) {
    SCOPED_TRACE(step);
    const auto address = static_cast<std::uint32_t>(random.up_to(0x3FF) * 4);
    const auto value = static_cast<std::uint32_t>(random.next());
    switch (random.up_to(5)) {
      case 0:
        side.set(value % 2 == 0 ? "rst_ni" : "s_axi_aresetn", (value & 2U) != 0);
        break;
      case 1:
        side.simulator->inject("[[fault]]\nkind = \"clock-stop\"\nat_us = 0.1\nfor_us = " +
                               std::to_string(1 + value % 40) + "\n");
        break;
      case 2: {
        std::uint32_t read = 0;
        side.bus->read(address, read);
        break;
      }
      default:
        side.bus->write(address, value, static_cast<std::uint8_t>(random.up_to(15)));
    }
    side.simulator->advance(random.up_to(30'000'000));
    if (step % 10 != 9) continue;
    side.simulator->advance(60'000'000);  // the clock is there again
    side.set("rst_ni", true);
    side.set("s_axi_aresetn", true);
    side.simulator->advance(3'000'000);
    // What was under way when the clock stopped may still end with an error, once.
    std::uint32_t id = 0;
    if (side.bus->read(page::kAddrId, id) != std::uint8_t{0}) {
      ASSERT_EQ(side.bus->read(page::kAddrId, id), std::uint8_t{0});
    }
    ASSERT_EQ(id, 0x454E4305U);
  }
  ASSERT_EQ(side.bus->write(map::kAddrSysCtrl, 0x100, 0xF), std::uint8_t{0});
  ASSERT_EQ(side.bus->write(map::kAddrAccErrCnt & ~3U, 31, 0xF), std::uint8_t{0});
  side.simulator->advance(3'000'000'000);
  std::uint32_t status = 0;
  ASSERT_EQ(side.bus->read(page::kAddrStatus, status), std::uint8_t{0});
  EXPECT_EQ(page::LINK_STATE::get(status), 8U);
}

// Each frame's position, speed and time from the window, and both safe positions, beside the
// encoder's ramp, and what the encoder has told of itself.
void expect_frames_of_the_ramp(double metres, unsigned frames) {
  const std::string text =
      "[master]\ntype = \"dsl\"\n[[channel]]\nnumber = 1\ncable_m = " + std::to_string(metres) +
      "\n[[channel.slave]]\nprotocol = \"dsl\"\nposition_bits = 28\nsource = \"ramp\"\n"
      "start = 5\nstep = 700\nindex = 9\n";
  DslSim side(text, 1, false);
  const auto read = [&side](std::uint32_t address) {
    std::uint32_t value = 0;
    EXPECT_EQ(side.bus->read(address, value), std::uint8_t{0}) << address;
    return value;
  };
  constexpr sim::Time kFrame = 11'520'000;
  side.bus->write(page::kAddrIrqEnable, page::FRAME_ENDED_ENABLE::kMask, 0xF);
  std::uint32_t number = 0;
  std::uint64_t position = 0;
  unsigned certain = 0;
  for (unsigned tries = 0; certain < frames && tries < 200 + frames; ++tries) {
    SCOPED_TRACE(tries);
    const sim::Time end = side.simulator->now() + 20 * kFrame;
    side.simulator->run_while_waiting([&side] { return side.level("irq_o"); }, end);
    if (!side.level("irq_o")) {  // no link yet, and nothing that looks like one
      read(page::kAddrPosLo);
      read(page::kAddrSafe1Lo);
      ASSERT_EQ(read(page::kAddrFrameStatus), page::FRAME_POS_LOST::kMask);
      ASSERT_EQ(read(page::kAddrSafe1Age), ~0U);
      continue;
    }
    side.bus->write(page::kAddrIrqStatus, 0x1F, 0xF);
    const std::uint64_t now = read(page::kAddrPosLo);
    ASSERT_FALSE(side.level("irq_o"));  // cleared
    const std::uint32_t count = read(page::kAddrFrameCount);
    const bool lost = page::FRAME_POS_LOST::get(read(page::kAddrFrameStatus)) != 0;
    if (!lost) {
      ASSERT_EQ(read(page::kAddrVel), 700U);
      ASSERT_EQ((now - 5) % 700, 0U);
      if (certain++ != 0) {
        ASSERT_EQ(now - position, 700U * (count - number));
      }
      position = now;
      number = count;
    }
    if (count % 8 != 0 || lost) continue;
    const std::uint64_t safe = read(page::kAddrSafe1Lo);
    ASSERT_EQ(read(page::kAddrSafe1Age), 0U);
    ASSERT_EQ(now - safe, 700U * 8);
    const std::uint32_t second = read(page::kAddrSafe2Lo);
    ASSERT_EQ(second, ~static_cast<std::uint32_t>(safe));
  }
  EXPECT_EQ(certain, frames);
  // The identity, bytes 0Dh to 0Fh: 28 bits are 17 and 11, and the index.
  const std::uint32_t identity = read(map::kAddrEncId2 & ~3U);
  EXPECT_EQ(identity >> 24U & 0xF3U, (17U << 4U | 3U) & 0xF3U);
}

TEST(DslRuns, CableOf20Metres_BringsEachPosition) { expect_frames_of_the_ramp(20, 24); }
TEST(DslRuns, CableOf100Metres_BringsEachPosition) { expect_frames_of_the_ramp(100, 200); }
TEST(DslRuns, NoCable_BringsEachPosition) { expect_frames_of_the_ramp(0, 200); }

INSTANTIATE_TEST_SUITE_P(Hz, DslBus,
                         testing::Values(10'000'000, 75'000'000, 100'000'000, 250'000'000));

}  // namespace
