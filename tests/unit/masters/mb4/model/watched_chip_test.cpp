// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A waveform of a part of a run holds what a waveform of the whole run holds of this part.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "mb4_regs.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/core/trace_error.hpp"
#include "sim/masters/mb4/pins.hpp"
#include "tests/unit/model/waveform.hpp"

namespace mb4test {

using namespace mb4::sim;
namespace reg = mb4::regs;

namespace {

// A run of two parts. All of it takes place, and the waveform begins between them.
struct Case {
  const char* name;
  const char* scenario;
  std::function<void(Simulator&)> before;
  std::function<void(Simulator&)> after;
};

void send(Simulator& simulator, const std::vector<std::uint8_t>& tx) {
  std::vector<std::uint8_t> rx(tx.size());
  simulator.spi().transfer(tx, rx);
}

void configure(Simulator& simulator, std::uint8_t freqags) {
  send(simulator, {reg::kSpiOpcodeWriteRegisters, reg::slave_cfg_address(1), reg::kEnscdYes | 27,
                   reg::kScrclenCrc6, 0, 0});
  send(simulator, {reg::kSpiOpcodeWriteRegisters, reg::kAddrCtrl, reg::kRegversBissC,
                   reg::FREQR::of(5), 0, freqags});
  send(simulator,
       {reg::kSpiOpcodeWriteRegisters, reg::kAddrCfgch, reg::kCfgch1BissC | reg::kCfgch2Unused});
}

void frame(Simulator& simulator) {
  send(simulator, {reg::kSpiOpcodeWriteInstruction, reg::kInstrCdm0});
  simulator.advance(60 * kPsPerUs);
}

std::ostream& operator<<(std::ostream& out, const Case& one) { return out << one.name; }

class TracedPart : public testing::TestWithParam<Case> {
 protected:
  static std::string file(const std::string& name) {
    return testing::TempDir() + "watched_chip_" + std::to_string(getpid()) + "_" + name + ".fst";
  }
};

constexpr Time kCable = 100 * kPsPerNs;  // more than the delay of each cable of the cases, one way

// The chip's flops without a reset have the same random values in both runs, so all signals agree.
TEST_P(TracedPart, HoldsWhatTheWholeWaveformHolds) {
  const Case& one = GetParam();
  const Scenario scenario = load_scenario(std::string(MB4_EXAMPLES) + one.scenario);
  Simulator part(scenario);
  one.before(part);
  const Time begin = part.now();
  part.start_trace(file("part"));
  one.after(part);
  EXPECT_TRUE(part.stop_trace());
  EXPECT_FALSE(part.stop_trace());

  Simulator whole(scenario);
  whole.start_trace(file("whole"));
  EXPECT_THROW(whole.start_trace(file("part")), TraceError);
  one.before(whole);
  ASSERT_EQ(whole.now(), begin);
  one.after(whole);
  EXPECT_TRUE(whole.stop_trace());
  ASSERT_EQ(whole.now(), part.now());
  EXPECT_EQ(whole.clk_cycles(), part.clk_cycles());

  const Waveform seen = read_waveform(file("part"));
  const Waveform expected = read_waveform(file("whole"));
  EXPECT_EQ(seen.begin, begin);
  EXPECT_EQ(seen.end, expected.end);
  EXPECT_GT(seen.changes.size(), 500U);
  ASSERT_EQ(seen.changes.size(), expected.changes.size());
  std::size_t edges = 0;
  for (const auto& [name, changes] : expected.changes) {
    // Edges that are on the cable at the begin may appear earlier at the slaves.
    const Time from = begin + (name.starts_with("mb4.slaves_") ? kCable : 0);
    const Changes ours = since(from, changes);
    const Changes theirs = since(from, seen.changes.at(name));
    EXPECT_EQ(theirs, ours) << name;
    edges += ours.size() - 1;
  }
  EXPECT_GT(edges, 1000U);
  std::filesystem::remove(file("part"));
  std::filesystem::remove(file("whole"));
}

// FREQAGS = 20 us.
constexpr std::uint8_t kCyclic = 19;

INSTANTIATE_TEST_SUITE_P(
    Cases, TracedPart,
    testing::Values(Case{
                        "frames", "/resolute-26.toml",
                        [](Simulator& simulator) {
                          configure(simulator, reg::kFreqagsAgsMin);
                          frame(simulator);
                          simulator.advance(10 * kPsPerUs);
                        },
                        [](Simulator& simulator) {
                          frame(simulator);
                          send(simulator, {reg::kSpiOpcodeReadRegisters, reg::kAddrRevision, 0, 0});
                        }},
                    Case{"inside_a_frame", "/resolute-26.toml",
                         [](Simulator& simulator) {
                           configure(simulator, reg::kFreqagsAgsMin);
                           send(simulator, {reg::kSpiOpcodeWriteInstruction, reg::kInstrCdm0});
                           simulator.advance(2'012'345);
                         },
                         [](Simulator& simulator) { simulator.advance(60 * kPsPerUs); }},
                    Case{"inside_a_transfer", "/resolute-26.toml",
                         [](Simulator& simulator) {
                           configure(simulator, reg::kFreqagsAgsMin);
                           simulator.spi().select(true);
                           simulator.spi().byte(reg::kSpiOpcodeWriteInstruction);
                         },
                         [](Simulator& simulator) {
                           simulator.spi().byte(reg::kInstrCdm0);
                           simulator.spi().select(false);
                           simulator.advance(60 * kPsPerUs);
                         }},
                    // The chip rests between the frames, and the simulator leaves its clocks out.
                    Case{"at_rest", "/resolute-26.toml",
                         [](Simulator& simulator) {
                           configure(simulator, kCyclic);
                           send(simulator, {reg::kSpiOpcodeWriteInstruction, reg::AGS::kMask});
                           simulator.advance(203 * kPsPerUs + 7);
                         },
                         [](Simulator& simulator) { simulator.advance(100 * kPsPerUs); }},
                    Case{"oscillator", "/sine-internal-osc.toml",
                         [](Simulator& simulator) {
                           send(simulator, {reg::kSpiOpcodeWriteRegisters, reg::kAddrIface,
                                            reg::kClkeniInternal});
                           simulator.advance(kPsPerUs + 11);
                           configure(simulator, reg::kFreqagsAgsMin);
                         },
                         [](Simulator& simulator) {
                           frame(simulator);
                           send(simulator, {reg::kSpiOpcodeWriteRegisters, reg::kAddrIface,
                                            reg::kClkeniExternal});
                           simulator.advance(10 * kPsPerUs);
                         }}),
    [](const testing::TestParamInfo<Case>& one) { return std::string(one.param.name); });

// The run with a waveform in its middle is the run without one.
TEST(WatchedChip, Waveform_ChangesNothing) {
  const Scenario scenario = load_scenario(std::string(MB4_EXAMPLES) + "/resolute-26.toml");
  const auto run = [&](bool traced) {
    const std::string path =
        testing::TempDir() + "watched_chip_" + std::to_string(getpid()) + ".fst";
    Simulator simulator(scenario);
    configure(simulator, reg::kFreqagsAgsMin);
    std::vector<std::uint64_t> seen;
    for (int round = 0; round < 6; ++round) {
      if (traced && round % 2 == 1) simulator.start_trace(path);
      frame(simulator);
      std::vector<std::uint8_t> rx(10);
      simulator.spi().transfer(
          std::vector<std::uint8_t>{reg::kSpiOpcodeReadRegisters, 0, 0, 0, 0, 0, 0, 0, 0, 0}, rx);
      seen.insert(seen.end(), rx.begin(), rx.end());
      seen.push_back(simulator.now());
      seen.push_back(simulator.clk_cycles());
      seen.push_back(simulator.slave(1)->frames());
      EXPECT_EQ(simulator.stop_trace(), traced && round % 2 == 1);
    }
    std::filesystem::remove(path);
    return seen;
  };
  EXPECT_EQ(run(true), run(false));
}

// A waveform that cannot be written leaves the run as it is, and another one can begin.
TEST(WatchedChip, FileThatCannotBeWritten_IsAnErrorAndNoMore) {
  Simulator simulator(load_scenario(std::string(MB4_EXAMPLES) + "/resolute-26.toml"));
  configure(simulator, reg::kFreqagsAgsMin);
  EXPECT_THROW(simulator.start_trace("/no/such/folder/x.fst"), TraceError);
  EXPECT_THROW(simulator.start_trace(testing::TempDir()), TraceError);
  EXPECT_FALSE(simulator.stop_trace());
  frame(simulator);
  EXPECT_EQ(simulator.slave(1)->frames(), 1U);
  const std::string path = testing::TempDir() + "watched_chip_" + std::to_string(getpid()) + ".fst";
  simulator.start_trace(path);
  frame(simulator);
  EXPECT_EQ(simulator.slave(1)->frames(), 2U);
  EXPECT_TRUE(simulator.stop_trace());
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace mb4test
