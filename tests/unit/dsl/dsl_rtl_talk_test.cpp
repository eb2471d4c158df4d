// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Messages of the RTL in the simulator, by its registers on AXI, under the judge of the model:
// random transactions of both hosts with the encoder, one in four disturbed.
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>

#include "dsl_page_regs.hpp"
#include "dsl_regs.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/hosts/word_host.hpp"
#include "sim/lines/dsl/dsl_slave.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/unit/dsl/dsl_dialogue.hpp"

namespace {

namespace sim = mb4::sim;
namespace page = dsl::page;
using sim::dsl_test::Dialogue;
using sim::dsl_test::HostPort;

constexpr sim::Time kFrame = 11'520'000;

class RtlHost {
 public:
  explicit RtlHost(const std::string& keys) {
    sim::Scenario scenario = sim::parse_scenario(
        "[master]\ntype = \"dsl\"\n" + keys +
            "[[channel]]\nnumber = 1\ncable_m = 30.0\njitter_ns = 5.0\n"
            "[[channel.slave]]\nprotocol = \"dsl\"\nposition_bits = 30\nsource = \"ramp\"\n"
            "step = 777\n",
        "test");
    auto& encoder =
        dynamic_cast<sim::DslSlaveConfig&>(*scenario.channels.front().slaves.front().device);
    encoder.messages = Dialogue::encoder();
    simulator_.emplace(scenario, sim::SimulatorOptions{});
    bus_ = simulator_->word_bus();
  }
  sim::Simulator& simulator() { return *simulator_; }
  sim::DslSlave& encoder() { return dynamic_cast<sim::DslSlave&>(*simulator_->slave(1)); }

  std::uint32_t word(std::uint32_t address) {
    std::uint32_t value = 0;
    EXPECT_EQ(bus_->read(address, value), std::uint8_t{0}) << address;
    return value;
  }
  HostPort port() {
    return {.read =
                [this](unsigned address) {
                  return static_cast<std::uint8_t>(word(address & ~3U) >> 8 * (address & 3U));
                },
            .write =
                [this](unsigned address, std::uint8_t data) {
                  const unsigned lane = address & 3U;
                  const auto strobes = static_cast<std::uint8_t>(1U << lane);
                  EXPECT_EQ(bus_->write(address & ~3U, std::uint32_t{data} << 8 * lane, strobes),
                            std::uint8_t{0})
                      << address;
                }};
  }
  bool has_messages() { return page::MESSAGES_EVENTS::get(word(page::kAddrFeatures)) != 0; }

 private:
  std::optional<sim::Simulator> simulator_;
  sim::WordHost* bus_ = nullptr;
};

TEST(DslRtlTransactions, OfBothHosts_EndByRule) {
  RtlHost side("");
  if (!side.has_messages()) GTEST_SKIP() << "this master sends no messages";
  side.simulator().advance(3000 * sim::kPsPerUs);
  Dialogue dialogue(side.port(), side.encoder().messages(), side.encoder().registers(), 21);
  const std::uint32_t frames_before = side.word(page::kAddrFrameCount);
  const sim::Time began = side.simulator().now();
  const std::uint64_t wanted = sim::dsl_test::transactions(100);
  constexpr std::uint64_t kFramesEach = 400;
  for (std::uint64_t i = 0; i < kFramesEach * wanted && !HasFailure(); ++i) {
    if (dialogue.ended >= wanted) dialogue.stop_starting();
    if (dialogue.ended >= wanted && dialogue.all_ended()) break;
    dialogue.host_acts();
    side.simulator().advance(kFrame);
    // No position was lost.
    if (i % 64 == 0) {
      EXPECT_EQ(page::POS_LOST::get(side.word(page::kAddrStatus)), 0U);
    }
  }
  EXPECT_GE(dialogue.ended, wanted);
  EXPECT_TRUE(dialogue.all_ended());
  EXPECT_GT(4 * dialogue.disturbed, wanted);
  const std::uint32_t frames = side.word(page::kAddrFrameCount) - frames_before;
  EXPECT_NEAR(frames, static_cast<double>(side.simulator().now() - began) / kFrame, 2);
  EXPECT_EQ(page::NUM_RESETS::get(side.word(page::kAddrRestarts)), 0U);
}

}  // namespace
