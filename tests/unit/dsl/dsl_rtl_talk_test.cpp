// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What a host sees of the RTL in the simulator, by its registers on AXI: messages of both hosts at
// random under the judge of the model, one in four disturbed, and the checks of the safe channels,
// each with a fault that trips it alone.
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>

#include "dsl_page_regs.hpp"
#include "dsl_regs.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/hosts/word_host.hpp"
#include "sim/lines/dsl/dsl_faults.hpp"
#include "sim/lines/dsl/dsl_slave.hpp"
#include "sim/masters/dsl_model/safe_checks.hpp"
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
  std::optional<std::uint8_t> word_write(std::uint32_t address, std::uint32_t value) {
    return bus_->write(address, value, 0xF);
  }
  std::uint32_t safe_age() {
    word(page::kAddrSafe1Lo);  // copies it
    return word(page::kAddrSafe1Age);
  }
  HostPort port() {
    return {.read =
                [this](unsigned address) {
                  return static_cast<std::uint8_t>(word(address & ~3U) >> 8 * (address & 3U));
                },
            .write =
                [this](unsigned address, std::uint8_t data) {
                  const sim::ByteWrite one(address, data);
                  EXPECT_EQ(bus_->write(one.address, one.data, one.strobe), std::uint8_t{0})
                      << address;
                }};
  }
  std::uint32_t frame_count() {
    word(page::kAddrPosLo);  // copies it
    return word(page::kAddrFrameCount);
  }
  bool has_messages() { return page::MESSAGES_EVENTS::get(word(page::kAddrFeatures)) != 0; }

 private:
  std::optional<sim::Simulator> simulator_;
  sim::WordHost* bus_ = nullptr;
};

TEST(DslRtlTransactions, OfBothHosts_EndByRule) {
  RtlHost side("");
  ASSERT_TRUE(side.has_messages());
  side.simulator().advance(3000 * sim::kPsPerUs);
  Dialogue dialogue(side.port(), side.encoder().messages(), side.encoder().registers(), 21);
  const std::uint32_t frames_before = side.frame_count();
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
  const std::uint32_t frames = side.frame_count() - frames_before;
  EXPECT_NEAR(frames, static_cast<double>(side.simulator().now() - began) / kFrame, 2);
  EXPECT_EQ(page::NUM_RESETS::get(side.word(page::kAddrRestarts)), 0U);
}

// Bits of SAFE_STATUS that the vertical frames from the next one on set. The fault lasts for one of
// them.
unsigned tripped_by(const sim::SlaveFault* fault, unsigned flipped_bit) {
  constexpr std::uint32_t kSafeCheck = 0x14C;
  constexpr std::uint32_t kSafeStatus = 0x150;
  constexpr unsigned kVertical = 8;
  constexpr std::uint32_t kBits2 = 30;
  RtlHost side("");
  side.simulator().advance(3000 * sim::kPsPerUs);
  EXPECT_EQ(side.word_write(kSafeCheck, kBits2), std::uint8_t{0});
  while (side.safe_age() != 0) side.simulator().advance(kFrame / 4);
  unsigned tripped = 0;
  for (unsigned i = 0; i < 6 * kVertical; ++i) {
    if (i == 0 && fault == nullptr) {
      side.simulator().line(1)->flip(side.encoder().flip_frames() + 3, {flipped_bit});
    } else if (fault != nullptr && (i == 0 || i == kVertical)) {
      side.encoder().set_fault(*fault, i == 0);
    }
    side.simulator().advance(kFrame);
    tripped |= side.word(kSafeStatus);
  }
  return tripped;
}

constexpr unsigned bit_of(sim::dsl_model::SafeCheck check) {
  return 1U << static_cast<unsigned>(check);
}

TEST(DslRtlSafety, EachCheck_HasAFaultThatTripsItAlone) {
  namespace fault = sim::slave_fault;
  using sim::dsl_model::SafeCheck;
  const struct {
    const sim::SlaveFault& fault;
    SafeCheck check;
  } kCases[] = {
      {fault::kWrongCrc, SafeCheck::kCrc1},         {fault::kSafeMarker, SafeCheck::kMarked1},
      {fault::kEarlyVsync, SafeCheck::kVsyncEarly}, {fault::kLateVsync, SafeCheck::kVsyncLate},
      {fault::kStaleSafe, SafeCheck::kStale},       {fault::kSafe2Mismatch, SafeCheck::kMismatch},
      {fault::kToggle2, SafeCheck::kToggle2},       {fault::kTest2, SafeCheck::kTest2},
      {fault::kError2, SafeCheck::kError2},         {fault::kFix2, SafeCheck::kFix2},
      {fault::kNoVsync, SafeCheck::kVsyncMissing},  {fault::kSafe2Marker, SafeCheck::kMarked2},
      {fault::kWrongCrc2, SafeCheck::kCrc2}};
  for (const auto& test : kCases) {
    EXPECT_EQ(tripped_by(&test.fault, 0), bit_of(test.check)) << test.fault.name;
  }
  // A wrong bit makes another word, whose CRC is wrong then, or none.
  for (const bool second : {false, true}) {
    unsigned codes = 0;
    for (unsigned bit = 0; bit < 10; ++bit) {
      const unsigned tripped = tripped_by(nullptr, bit + (second ? 51U : 0U));
      const unsigned code = bit_of(second ? SafeCheck::kCode2 : SafeCheck::kCode1);
      EXPECT_NE(tripped, 0U);
      codes += tripped == code ? 1 : 0;
    }
    EXPECT_GT(codes, 2U);
  }
}

}  // namespace
