// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A master beside the iC-MB4, made by this test alone: no RTL, no pins, one line, and a memory as
// its host. Each write makes one BiSS C frame. It shows what a master needs, and that the simulator
// needs no change for it.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <typeinfo>

#include "mb4sim.h"
#include "mb4sim/model_stopped.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/core/scenario_error.hpp"
#include "sim/core/toml_reader.hpp"
#include "sim/hosts/word_host.hpp"
#include "sim/lines/clocked/clocked_end.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/clocked/clocked_lines.hpp"
#include "sim/masters/live_master.hpp"
#include "sim/masters/master.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::sim {
namespace {

constexpr unsigned kDataBits = 28;
constexpr unsigned kCrcBits = 6;
constexpr unsigned kLatestStart = 64;  // bits to wait for the start bit

constexpr char kSlLowTooEarly[] =
    "SL has gone low before the first frame, which stops this master with a message of its own";

// MA has half of the clock's frequency. SL is taken at the rising edges of MA.
class FrameMaker final : public MasterModel {
 public:
  explicit FrameMaker(std::uint64_t hz) : period_(kPsPerSecond / hz) {
    min_clock_ = period_;
    outputs_ = of_line(0, kMaPin);
  }

  void start(Time now) {
    next_ = now + period_;
    acknowledged_ = false;
    bits_ = 0;
    started_ = std::nullopt;
    word_ = 0;
  }
  bool busy() const { return next_ != kNever; }
  // Of the last frame; nothing if no start bit came.
  std::optional<std::uint64_t> word() const {
    return started_ ? std::optional(word_) : std::nullopt;
  }

  Time run_clocks(Time limit) override {
    if (next_ > limit) return kNever;
    const Time now = next_;
    next_ += period_;
    ++cycles_;
    outputs_ ^= of_line(0, kMaPin);
    if ((outputs_ & of_line(0, kMaPin)) != 0) take_bit();
    return now;
  }
  void set_inputs(Time /*now*/, unsigned /*line*/, unsigned levels) override {
    sl_ = levels != 0;
    if (!sl_ && cycles_ == 0) throw ModelStopped(kSlLowTooEarly);
  }
  void set_clock(Time /*now*/, std::uint64_t hz) override {
    if (hz != 0) period_ = kPsPerSecond / hz;
  }
  unsigned half_clocks(unsigned /*line*/) const override { return 1; }

 private:
  void take_bit() {
    ++bits_;
    if (!started_) {
      acknowledged_ = acknowledged_ || !sl_;
      if (acknowledged_ && sl_) started_ = bits_;
      if (bits_ == kLatestStart) next_ = kNever;
      return;
    }
    const unsigned place = bits_ - *started_;  // 1 is CDS
    if (place > 1 && place <= 1 + kDataBits) word_ = word_ << 1U | (sl_ ? 1U : 0U);
    if (place == 1 + kDataBits + kCrcBits) next_ = kNever;
  }

  Time period_;
  Time next_ = kNever;
  bool sl_ = true;
  bool acknowledged_ = false;
  unsigned bits_ = 0;
  std::optional<unsigned> started_;
  std::uint64_t word_ = 0;
};

// kFrame: any write makes a frame; reading gives 1 while it runs. kWord: the word, or all ones
// without a start bit. kRefused answers with an error, kSilent never. An access takes 10 ns.
class MemoryHost final : public WordHost {
 public:
  MemoryHost(HostPins& outside, FrameMaker& maker) : outside_(outside), maker_(maker) {}
  std::optional<std::uint8_t> write(std::uint32_t address, std::uint32_t /*data*/,
                                    std::uint8_t /*strobe*/) override {
    pass();
    if (address == kFrame) maker_.start(outside_.now());
    return answer(address);
  }
  std::optional<std::uint8_t> read(std::uint32_t address, std::uint32_t& data) override {
    pass();
    data =
        address == kFrame ? maker_.busy() : static_cast<std::uint32_t>(maker_.word().value_or(~0U));
    return answer(address);
  }
  std::uint32_t last_address() const override { return kSilent + 3; }

  static constexpr std::uint32_t kFrame = 0;
  static constexpr std::uint32_t kWord = 4;
  static constexpr std::uint32_t kRefused = 8;
  static constexpr std::uint32_t kSilent = 12;

 private:
  static std::optional<std::uint8_t> answer(std::uint32_t address) {
    if (address == kSilent) return std::nullopt;
    return address == kRefused ? std::uint8_t{2} : std::uint8_t{0};
  }
  void pass() { outside_.run_until(outside_.now() + 10 * kPsPerNs); }

  HostPins& outside_;
  FrameMaker& maker_;
};

class LiveOneLine final : public LiveMaster {
 public:
  explicit LiveOneLine(const MasterSetup& setup)
      : maker_(setup.chip.f_clk_hz), memory_(setup.outside, maker_) {}
  MasterModel& model() override { return maker_; }
  void power_on() override {}
  HostModel* host(std::string_view name) override { return name == "memory" ? &memory_ : nullptr; }

 private:
  FrameMaker maker_;
  MemoryHost memory_;
};

constexpr HostInterface kInterfaces[] = {{"memory", false, "a memory is never aborted"}};
const Master kOneLine{
    .type = "one-line",
    .interfaces = kInterfaces,
    .line = &kClockedLines,
    .channels = 1,
    .slaves = 1,
    .slaves_shared = 1,
    .min_clk_hz = 1'000'000,
    .max_clk_hz = 20'000'000,
    .min_osc_hz = 0,
    .max_osc_hz = 0,
    .read_quirks = [](TomlReader& /*reader*/, ChipConfig& /*chip*/) {},
    .read_host = [](TomlReader& /*reader*/, const ChipConfig& /*chip*/, HostConfig& /*host*/) {},
    .pin_by_name = nullptr,
    .make = [](const MasterSetup& setup) -> std::unique_ptr<LiveMaster> {
      return std::make_unique<LiveOneLine>(setup);
    },
    .wave_groups = nullptr};

constexpr char kChannel[] =
    "[[channel]]\nnumber = 1\ndelay_ns = 40\n"
    "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\n";

Scenario scenario(const std::string& rest) {
  [[maybe_unused]] static const bool added = [] {
    add_master(kOneLine);
    return true;
  }();
  return parse_scenario("[master]\ntype = \"one-line\"\n" + rest, "test.toml");
}

std::string error_of(const std::string& rest) {
  try {
    scenario(rest);
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "";
}

std::uint32_t frame(Simulator& simulator) {
  auto& memory = simulator.host<MemoryHost>("memory");
  std::uint32_t data = 0;
  memory.write(MemoryHost::kFrame, 1, 0xF);
  while (memory.read(MemoryHost::kFrame, data), data != 0) simulator.advance(kPsPerUs);
  simulator.advance(100 * kPsPerUs);  // the slave's timeout
  memory.read(MemoryHost::kWord, data);
  return data;
}

TEST(SecondMaster, EachWrite_IsAFrameWithTheWordOfTheSlave) {
  Simulator simulator(scenario(kChannel));
  for (const std::uint32_t word : {0x0U, 0xFFF'FFFFU, 0x8000001U, 0x5A5A5A5U}) {
    ASSERT_TRUE(simulator.slave(1)->set_data(word));
    const auto frames = simulator.slave(1)->frames();
    EXPECT_EQ(frame(simulator), word);
    EXPECT_EQ(simulator.slave(1)->frames(), frames + 1);
  }
  EXPECT_EQ(ma_check(simulator.line_end(1)).shortest(), 50 * kPsPerNs);  // f_clk_hz is 20 MHz
  EXPECT_GT(simulator.clk_cycles(), 0U);
}

TEST(SecondMaster, CableAndFaults_AreThoseOfEveryMaster) {
  Simulator simulator(scenario(std::string(kChannel) +
                               "[[channel.event]]\nat_us = 300\naction = \"unplug\"\n"
                               "[[fault]]\nkind = \"bit-flip\"\nat_us = 100\nbits = [29]\n"));
  simulator.slave(1)->set_data(0x1234567);
  EXPECT_EQ(frame(simulator), 0x1234567U);
  simulator.run_until(110 * kPsPerUs);
  EXPECT_EQ(frame(simulator), 0x1234566U);  // bits 0 and 1 are start bit and CDS
  EXPECT_EQ(simulator.faults().size(), 1U);
  simulator.run_until(310 * kPsPerUs);
  EXPECT_EQ(frame(simulator), ~0U);
}

TEST(SecondMaster, WordBusOfTheCInterface_IsThatOfItsHost) {
  scenario("");  // adds the master
  char error[200];
  mb4sim* const sim = mb4sim_open(
      (std::string("[master]\ntype = \"one-line\"\n") + kChannel).c_str(), error, sizeof error);
  ASSERT_NE(sim, nullptr) << error;
  uint32_t data = 77;
  EXPECT_EQ(mb4sim_axi_read(sim, MemoryHost::kWord, &data), 0);
  EXPECT_EQ(data, ~0U);
  EXPECT_EQ(mb4sim_axi_write(sim, MemoryHost::kRefused, 0, 0xF), 1);
  EXPECT_EQ(mb4sim_axi_read(sim, MemoryHost::kRefused, &data), 1);
  data = 77;
  EXPECT_EQ(mb4sim_axi_write(sim, MemoryHost::kSilent, 0, 0xF), MB4SIM_ERROR_SILENT);
  EXPECT_EQ(mb4sim_axi_read(sim, MemoryHost::kSilent, &data), MB4SIM_ERROR_SILENT);
  EXPECT_EQ(mb4sim_axi_read(sim, MemoryHost::kSilent + 4, &data), MB4SIM_ERROR_VALUE);
  EXPECT_EQ(data, 77U);
  // Bytes: the first word that does not answer well is the last one.
  std::array<std::uint8_t, 8> bytes{1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_EQ(mb4sim_mem_write(sim, MemoryHost::kRefused, bytes.data(), 8), 1);
  EXPECT_EQ(mb4sim_mem_read(sim, MemoryHost::kSilent, bytes.data(), 4), MB4SIM_ERROR_SILENT);
  EXPECT_EQ(bytes[0], 1);
  mb4sim_close(sim);
}

// The simulator goes when the call returns, and the call still tells why it has stopped.
TEST(SecondMaster, ClosedInACallback_InjectTellsItsError) {
  scenario("");  // adds the master
  const std::string text = std::string("[master]\ntype = \"one-line\"\n") + kChannel;
  mb4sim* const sim = mb4sim_open(text.c_str(), nullptr, 0);
  ASSERT_NE(sim, nullptr);
  const auto close = [](void* context, unsigned, unsigned place, uint64_t, int level) {
    if (place == MB4SIM_EDGE_SL && level == 0) mb4sim_close(static_cast<mb4sim*>(context));
  };
  ASSERT_EQ(mb4sim_on_edge(sim, close, sim), 0);
  char error[200];
  EXPECT_EQ(mb4sim_inject(sim,
                          "[[channel]]\nnumber = 1\n"
                          "[[channel.event]]\nat_us = 0\naction = \"sl-low\"\n",
                          error, sizeof error),
            MB4SIM_ERROR_STOPPED);
  EXPECT_STREQ(error, kSlLowTooEarly);
}

TEST(SecondMaster, WhatItDoesNotHave_IsRefused) {
  EXPECT_NE(error_of("[[channel]]\nnumber = 2\n").find("test.toml:4:10: key 'number'"),
            std::string::npos);
  EXPECT_NE(error_of("[host]\ninterface = \"spi\"\n").find("memory"), std::string::npos);
  EXPECT_NE(error_of("[host]\nma_hz = 10_000_000\n").find("key 'ma_hz': unknown"),
            std::string::npos);
  EXPECT_NE(error_of("[[fault]]\nkind = \"abort\"\nat_us = 1\n").find("never aborted"),
            std::string::npos);
  Simulator simulator(scenario(kChannel));
  EXPECT_THROW(simulator.spi(), std::bad_cast);
  EXPECT_EQ(simulator.pin_by_name("NCS"), std::nullopt);
  // A scenario without [master] has the iC-MB4.
  EXPECT_EQ(parse_scenario("", "test.toml").master->type, "ic-mb4");
}

}  // namespace
}  // namespace mb4::sim
