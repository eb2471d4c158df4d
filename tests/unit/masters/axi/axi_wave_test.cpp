// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The waveform of the BiSS C master on AXI or SPI: each model, each channel, all of a run or a part
// of it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "axi_regs.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/core/trace_error.hpp"
#include "sim/masters/axi/live_axi.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/unit/model/waveform.hpp"

namespace mb4test {

using namespace mb4::sim;
namespace axireg = biss_axi::regs;

namespace {

constexpr unsigned kBits = 26;
constexpr Time kClock = 10 * kPsPerNs;

// A model of the master: channels of the scenario, [chip] and [chip.quirks].
struct Kind {
  const char* name;
  unsigned channels;
  const char* chip;
};

std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.name; }

// Round trip of a channel: whole clocks and a bit.
Time delay_of(unsigned channel) { return (37 * channel + 4) * kPsPerNs; }

std::uint64_t position_of(unsigned channel) { return 0x1234567U + 0x10101U * channel; }

Scenario scenario_of(const Kind& kind) {
  std::string text = "[master]\ntype = \"axi\"\n[chip]\nf_clk_hz = 100_000_000\n";
  text += kind.chip;
  for (unsigned channel = 0; channel < kind.channels; ++channel) {
    text += "[[channel]]\nnumber = " + std::to_string(channel + 1) +
            "\ndelay_ns = " + std::to_string(delay_of(channel) / kPsPerNs) +
            "\n[[channel.slave]]\nprotocol = \"biss-c\"\ncrc = 0x43\ndata_bits = " +
            std::to_string(kBits + 2) +
            "\ndata = " + std::to_string(position_of(channel) << 2U | 3U) + "\n";
  }
  return parse_scenario(text, "test.toml");
}

void configure(Simulator& simulator, const Kind& kind) {
  auto& host = simulator.host<AxiHost>("axi");
  host.write(axireg::kAddrMode, 1);
  host.write(axireg::kAddrPositionBits, kBits);
  host.write(axireg::kAddrMaDivider, 5);
  host.write(axireg::kAddrCrcCheck, 1);
  host.write(axireg::kAddrMaShift, (1U << kind.channels) - 1U);
  host.write(axireg::kAddrChannelEnable, (1U << kind.channels) - 1U);
  simulator.advance(41 * kPsPerUs);  // a reset holds starts back
}

void frame(Simulator& simulator) {
  auto& host = simulator.host<AxiHost>("axi");
  host.write(axireg::kAddrRequest, 0);
  host.write(axireg::kAddrRequest, 1);
  simulator.advance(50 * kPsPerUs);
}

class AxiWave : public testing::TestWithParam<Kind> {
 protected:
  void TearDown() override {
    for (const std::string& path : files_) std::filesystem::remove(path);
  }
  std::string file(const std::string& name) {
    files_.push_back(testing::TempDir() + "axi_wave_" + std::to_string(getpid()) + "_" + name +
                     ".fst");
    return files_.back();
  }

  // One frame in a simulator whose waveform is there from the beginning.
  Waveform whole_run(bool plain) {
    SimulatorOptions options;
    options.trace_path = file(plain ? "plain" : "whole");
    options.plain_evaluation = plain;
    {
      Simulator simulator(scenario_of(GetParam()), options);
      configure(simulator, GetParam());
      frame(simulator);
    }
    return read_waveform(*options.trace_path);
  }

 private:
  std::vector<std::string> files_;
};

const Changes& of(const Waveform& wave, const std::string& name) {
  static const Changes kNone;
  const auto found = wave.changes.find("mb4sim.biss_axi." + name);
  EXPECT_NE(found, wave.changes.end()) << name;
  return found == wave.changes.end() ? kNone : found->second;
}

// The same changes, a time later. What happens at one time stands one picosecond apart.
void expect_later(const Changes& first, const Changes& second, Time delay,
                  const std::string& what) {
  const Changes from = since(kPsPerUs, first);
  const Changes to = since(kPsPerUs, second);
  ASSERT_EQ(from.size(), to.size()) << what;
  for (std::size_t i = 1; i < from.size(); ++i) {
    EXPECT_EQ(from[i].second, to[i].second) << what;
    EXPECT_NEAR(static_cast<double>(to[i].first), static_cast<double>(from[i].first + delay), 100)
        << what;
  }
}

// Levels at the pins of every channel and at its encoder, and the word that the channel takes.
TEST_P(AxiWave, EveryChannel_ShowsItsFrame) {
  const Waveform wave = whole_run(false);
  for (unsigned c = 0; c < GetParam().channels; ++c) {
    const std::string number = std::to_string(c);
    SCOPED_TRACE(number);
    // BiSS C: two edges up to the acknowledge, start, "0", the word and its six CRC bits, and the
    // edge with which the timeout begins.
    const Changes& ma = of(wave, "ma" + number);
    const auto rises = std::count_if(ma.begin() + 1, ma.end(),
                                     [](const auto& change) { return change.second == "1"; });
    EXPECT_EQ(rises, 2 + 2 + kBits + 2 + 6 + 1);
    expect_later(ma, of(wave, "encoder" + number + "_ma"), delay_of(c) / 2, "MA");
    expect_later(of(wave, "encoder" + number + "_slo"), of(wave, "slo" + number), delay_of(c) / 2,
                 "SLO");
    EXPECT_EQ(of(wave, "encoder" + number + "_ready").back().second, "1");
    const std::string inside = "gen_channel[" + number + "].u_channel.";
    const std::string word = inside + "u_word.word_q.";
    std::string position;
    for (unsigned bit = 32; bit-- > 0;) {
      position += ((position_of(c) >> bit) & 1U) != 0 ? '1' : '0';
    }
    EXPECT_EQ(of(wave, word + "position [31:0]").back().second, position);
    EXPECT_EQ(of(wave, word + "good").back().second, "1");
    // Held back by the reset, rest, second rising edge, acknowledge, start bit, CDS, data, CRC,
    // stop, timeout, rest.
    std::vector<std::string> states;
    for (const auto& change : of(wave, inside + "state_q [3:0]")) states.push_back(change.second);
    EXPECT_EQ(states, (std::vector<std::string>{"1001", "0000", "0001", "0010", "0011", "0100",
                                                "0101", "0110", "0111", "1000", "0000"}));
  }
  EXPECT_EQ(of(wave, "s_axis_tvalid").size(), 3U);
  const Changes& clock = of(wave, "axi_aclk");
  for (std::size_t i = 2; i < clock.size(); ++i) {
    // A change of another signal at the same time may be written before.
    EXPECT_NEAR(static_cast<double>(clock[i].first - clock[i - 1].first), kClock / 2, 100);
  }
}

// Registers of a model whose edges run in parts are those of the whole model.
TEST_P(AxiWave, ModelInParts_ShowsWhatTheWholeModelShows) {
  const Waveform parts = whole_run(false);
  const Waveform whole = whole_run(true);
  EXPECT_GT(whole.changes.size(), 90U);
  ASSERT_EQ(parts.changes.size(), whole.changes.size());
  for (const auto& [name, changes] : whole.changes) {
    EXPECT_EQ(parts.changes.at(name), changes) << name;
  }
}

TEST_P(AxiWave, PartOfARun_HoldsWhatTheWholeWaveformHolds) {
  const Scenario scenario = scenario_of(GetParam());
  const auto go_on = [](Simulator& simulator) {
    simulator.advance(40 * kPsPerUs);
    frame(simulator);
    simulator.host<AxiHost>("axi").read(axireg::kAddrLineDelay);
  };
  const auto prepare = [](Simulator& simulator) {
    configure(simulator, GetParam());
    frame(simulator);
    simulator.host<AxiHost>("axi").write(axireg::kAddrRequest, 0);
    simulator.host<AxiHost>("axi").write(axireg::kAddrRequest, 1);
    simulator.advance(2'012'345);  // in the middle of a frame
  };
  Simulator part(scenario);
  prepare(part);
  const Time begin = part.now();
  const std::string part_file = file("part");
  part.start_trace(part_file);
  EXPECT_THROW(part.start_trace(file("other")), TraceError);
  go_on(part);
  EXPECT_TRUE(part.stop_trace());
  EXPECT_FALSE(part.stop_trace());
  const std::string whole_file = file("all");
  Simulator whole(scenario);
  whole.start_trace(whole_file);
  prepare(whole);
  ASSERT_EQ(whole.now(), begin);
  go_on(whole);
  EXPECT_TRUE(whole.stop_trace());
  EXPECT_EQ(whole.clk_cycles(), part.clk_cycles());
  EXPECT_EQ(whole.slave(1)->frames(), 3U);

  const Waveform seen = read_waveform(part_file);
  const Waveform expected = read_waveform(whole_file);
  EXPECT_EQ(seen.begin, begin);
  EXPECT_EQ(seen.end, expected.end);
  ASSERT_EQ(seen.changes.size(), expected.changes.size());
  std::size_t edges = 0;
  for (const auto& [name, changes] : expected.changes) {
    // Levels at the encoders become known with their first edge.
    const Time from = begin + (name.find(".encoder") != std::string::npos ? kPsPerUs : 0);
    const Changes ours = since(from, changes);
    EXPECT_EQ(since(from, seen.changes.at(name)), ours) << name;
    edges += ours.size() - 1;
  }
  EXPECT_GT(edges, 10'000U);
}

INSTANTIATE_TEST_SUITE_P(Models, AxiWave,
                         testing::Values(Kind{"document_1", 1, ""}, Kind{"document_4", 3, ""},
                                         Kind{"document_16", 16, ""},
                                         Kind{"align_4", 4, "[chip.quirks]\nALIGN_LATCH = true\n"},
                                         Kind{"align_16", 5, "[chip.quirks]\nALIGN_LATCH = true\n"},
                                         Kind{"full_1", 1, "features = \"full\"\n"},
                                         Kind{"full_4", 4, "features = \"full\"\n"},
                                         Kind{"full_16", 16, "features = \"full\"\n"}),
                         [](const testing::TestParamInfo<Kind>& one) {
                           return std::string(one.param.name);
                         });

// The run with a waveform in its middle is the run without one.
TEST(AxiWaveOfAPart, Waveform_ChangesNothing) {
  const Kind kind{"", 4, "features = \"full\"\n"};
  const auto run = [&](bool traced) {
    const std::string path = testing::TempDir() + "axi_wave_" + std::to_string(getpid()) + ".fst";
    Simulator simulator(scenario_of(kind));
    configure(simulator, kind);
    std::vector<std::uint64_t> seen;
    for (int round = 0; round < 6; ++round) {
      if (traced && round % 2 == 1) simulator.start_trace(path);
      frame(simulator);
      auto& host = simulator.host<AxiHost>("axi");
      while (const auto beat = host.next_beat()) {
        seen.push_back(beat->time);
        seen.push_back(beat->user);
        seen.insert(seen.end(), beat->words.begin(), beat->words.end());
      }
      for (unsigned address = 0; address < 0xA0; address += 4) seen.push_back(host.read(address));
      seen.push_back(simulator.now());
      seen.push_back(simulator.clk_cycles());
      EXPECT_EQ(simulator.stop_trace(), traced && round % 2 == 1);
    }
    std::filesystem::remove(path);
    return seen;
  };
  EXPECT_EQ(run(true), run(false));
}

// What stands between the falling and the rising edges of NCS: a level at each rising edge of SCLK.
std::vector<std::string> spi_frames(const Waveform& wave, const std::string& data) {
  const auto level = [](const Changes& changes, Time time) {
    std::string value = changes.front().second;
    for (const auto& change : changes) {
      if (change.first < time) value = change.second;
    }
    return value;
  };
  std::vector<std::string> frames;
  Time begin = 0;
  for (const auto& ncs : of(wave, "ncs")) {
    if (ncs.second == "0") begin = ncs.first;
    if (ncs.second != "1" || begin == 0) continue;
    std::string& bits = frames.emplace_back();
    for (const auto& sclk : of(wave, "sclk")) {
      if (sclk.second == "1" && sclk.first > begin && sclk.first < ncs.first)
        bits += level(of(wave, data), sclk.first);
    }
  }
  return frames;
}

std::string bits_of(const std::vector<std::uint8_t>& bytes) {
  std::string bits;
  for (const std::uint8_t byte : bytes) {
    for (unsigned bit = 8; bit-- > 0;) bits += (byte >> bit & 1U) != 0 ? '1' : '0';
  }
  return bits;
}

// biss_spi: frames of SPI at the pins as its page has them (docs/axi.md), one channel and four.
TEST(AxiWaveSpi, Frames_AreThoseOfThePage) {
  for (const Kind& kind :
       {Kind{"one", 1, ""}, Kind{"four", 4, ""}, Kind{"full", 4, "features = \"full\"\n"}}) {
    SCOPED_TRACE(kind.name);
    SimulatorOptions options;
    options.trace_path = testing::TempDir() + "axi_wave_" + std::to_string(getpid()) + "_spi.fst";
    Scenario scenario = scenario_of(kind);
    scenario.host.interface = HostInterface::kSpi;
    scenario.host.sclk_hz = 12'500'000;
    {
      Simulator simulator(scenario, options);
      simulator.advance(41 * kPsPerUs);
      for (const std::vector<std::uint8_t>& bytes :
           {std::vector<std::uint8_t>{0x02, axireg::kAddrMaDivider, 0, 0, 0, 0, 0x5A},
            std::vector<std::uint8_t>{0x03, axireg::kAddrMaDivider, 0, 0, 0, 0, 0}}) {
        std::vector<std::uint8_t> answer(bytes.size());
        simulator.spi().transfer(bytes, answer);
        simulator.advance(kPsPerUs);
      }
    }
    const Waveform wave = read_waveform(*options.trace_path);
    std::filesystem::remove(*options.trace_path);
    const std::vector<std::string> sent = spi_frames(wave, "mosi");
    const std::vector<std::string> answered = spi_frames(wave, "miso");
    ASSERT_EQ(sent.size(), 2U);
    EXPECT_EQ(sent[0], bits_of({0x02, axireg::kAddrMaDivider, 0, 0, 0, 0, 0x5A}));
    EXPECT_EQ(sent[1], bits_of({0x03, axireg::kAddrMaDivider, 0, 0, 0, 0, 0}));
    // 0101, v after the reset, r; then the word.
    EXPECT_EQ(answered[0], bits_of({0, 0, 0x55, 0, 0, 0, 0}));
    EXPECT_EQ(answered[1], bits_of({0, 0, 0x55, 0, 0, 0, 0x5A}));
  }
}

TEST(AxiWaveOfAPart, FileThatCannotBeWritten_IsAnErrorAndNoMore) {
  const Kind kind{"", 1, ""};
  Simulator simulator(scenario_of(kind));
  configure(simulator, kind);
  EXPECT_THROW(simulator.start_trace("/no/such/folder/x.fst"), TraceError);
  EXPECT_THROW(simulator.start_trace(testing::TempDir()), TraceError);
  EXPECT_FALSE(simulator.stop_trace());
  frame(simulator);
  EXPECT_EQ(simulator.slave(1)->frames(), 1U);
}

}  // namespace
}  // namespace mb4test
