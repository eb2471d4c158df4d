// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The calls of the C interface for programs that test firmware, through the shared library.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string>
#include <vector>

#include "mb4_regs.hpp"
#include "mb4sim.h"

namespace reg = mb4::regs;

namespace {

// Two channels with one encoder of 28 bits each; both slaves count their frames.
constexpr const char* kScenario = R"(
[[channel]]
number = 1
[[channel.slave]]
protocol = "biss-c"
data_bits = 28
flag_bits = 0
source = "ramp"
start = 100
step = 3
[[channel]]
number = 2
[[channel.slave]]
protocol = "biss-c"
data_bits = 28
data = 0x1234567
)";

struct Seen {
  std::vector<mb4sim_frame> frames;
  mb4sim* sim = nullptr;
  int calls = 0;
};

void keep(void* context, const mb4sim_frame* frame) {
  auto* seen = static_cast<Seen*>(context);
  seen->frames.push_back(*frame);
}

class CApiFirmware : public testing::Test {
 protected:
  void SetUp() override {
    char error[200];
    sim = mb4sim_open(kScenario, error, sizeof error);
    ASSERT_NE(sim, nullptr) << error;
    configure();
  }
  void configure() {
    // SCDATA1 and 5 with 28 bits and CRC6, SCDATA5 on channel 2, BiSS C on both channels (datasheet
    // pages 23 to 26).
    send({reg::kSpiOpcodeWriteRegisters, reg::slave_cfg_address(1), reg::kEnscdYes | 27,
          reg::kScrclenCrc6, 0, 0});
    send({reg::kSpiOpcodeWriteRegisters, reg::slave_cfg_address(5), reg::kEnscdYes | 27,
          reg::kScrclenCrc6, 0, 0});
    send({reg::kSpiOpcodeWriteRegisters, reg::kAddrCtrl, reg::kRegversBissC, reg::FREQR::of(5), 0,
          reg::kFreqagsAgsMin});
    send({reg::kSpiOpcodeWriteRegisters, reg::kAddrSlaveloc5, reg::kSlaveloc5Split,
          reg::kCfgch1BissC | reg::kCfgch2BissC});
  }
  void TearDown() override { mb4sim_close(sim); }

  void send(std::initializer_list<uint8_t> bytes) {
    EXPECT_EQ(mb4sim_spi_transfer(sim, bytes.begin(), nullptr, bytes.size()), 0);
  }
  // One frame on both channels, from its start to 60 us later.
  void frame() {
    send({reg::kSpiOpcodeWriteInstruction, reg::kInstrCdm0});
    mb4sim_advance_ns(sim, 60'000);
  }
  // SVALID of data channels 1 and 5.
  std::pair<bool, bool> valid() {
    const uint8_t tx[4] = {reg::kSpiOpcodeReadRegisters, reg::kAddrSvalidLo, 0, 0};
    const uint8_t tx2[4] = {reg::kSpiOpcodeReadRegisters, reg::kAddrSvalidHi, 0, 0};
    uint8_t rx[4] = {};
    uint8_t rx2[4] = {};
    EXPECT_EQ(mb4sim_spi_transfer(sim, tx, rx, 4), 0);
    EXPECT_EQ(mb4sim_spi_transfer(sim, tx2, rx2, 4), 0);
    return {(rx[2] & 0x02) != 0, (rx2[2] & 0x02) != 0};
  }
  std::string report() {
    std::string text(static_cast<size_t>(mb4sim_report(sim, nullptr, 0)), 'x');
    EXPECT_EQ(mb4sim_report(sim, text.data(), text.size() + 1), static_cast<int>(text.size()));
    return text;
  }
  std::string refusal(const char* toml) {
    char error[200] = "untouched";
    EXPECT_EQ(mb4sim_inject(sim, toml, error, sizeof error), MB4SIM_ERROR_VALUE);
    return error;
  }

  mb4sim* sim = nullptr;
};

TEST_F(CApiFirmware, InjectedFault_ActsFromNowOnAndIsReported) {
  frame();
  ASSERT_EQ(valid(), std::make_pair(true, true));
  char error[100] = "untouched";
  ASSERT_EQ(mb4sim_inject(sim,
                          "[[fault]]\nkind = \"wrong-crc\"\nslave = 5\nat_us = 3.5\n"
                          "for_us = 40.0\n",
                          error, sizeof error),
            0);
  EXPECT_STREQ(error, "");
  const uint64_t begin = mb4sim_time_ns(sim) + 3'500;
  frame();  // its word is latched before the fault begins
  EXPECT_EQ(valid(), std::make_pair(true, true));
  mb4sim_inject(sim, "[[fault]]\nkind = \"wrong-crc\"\nslave = 5\nat_us = 0.0\nfor_us = 40.0\n",
                nullptr, 0);
  frame();
  EXPECT_EQ(valid(), std::make_pair(true, false));
  frame();
  EXPECT_EQ(valid(), std::make_pair(true, true));
  const std::string text = report();
  EXPECT_NE(text.find("\"kind\": \"wrong-crc\", \"channel\": 2, \"slave\": 5"), std::string::npos)
      << text;
  EXPECT_NE(text.find("\"begin_ns\": " + std::to_string(begin) + "."), std::string::npos) << text;
  // The second fault made the chip pull NER low. The first fault began too late for its frame.
  EXPECT_NE(text.find("\"frames\": 1, \"ner_low\": 1"), std::string::npos) << text;
  EXPECT_NE(text.find("\"frames\": 1, \"ner_low\": 0"), std::string::npos) << text;
}

TEST_F(CApiFirmware, InjectedBitFlip_IsCountedForTheFrameItHits) {
  ASSERT_EQ(
      mb4sim_inject(sim, "[[fault]]\nkind = \"bit-flip\"\nchannel = 1\nbits = [5]\nat_us = 1.0\n",
                    nullptr, 0),
      0);
  mb4sim_advance_ns(sim, 100'000);
  frame();
  EXPECT_EQ(valid(), std::make_pair(false, true));
  frame();
  EXPECT_EQ(valid(), std::make_pair(true, true));
  EXPECT_NE(report().find("\"frames\": 1, \"ner_low\": 1"), std::string::npos) << report();
}

TEST_F(CApiFirmware, InjectedLineEvents_CountFromNow) {
  mb4sim_advance_ns(sim, 1'000'000);
  ASSERT_EQ(mb4sim_inject(sim,
                          "[[channel]]\nnumber = 1\n"
                          "[[channel.event]]\nat_us = 0.0\naction = \"unplug\"\n"
                          "[[channel.event]]\nat_us = 100.0\naction = \"plug\"\n",
                          nullptr, 0),
            0);
  frame();
  EXPECT_EQ(mb4sim_slave_frames(sim, 1), 0U);
  EXPECT_EQ(mb4sim_slave_frames(sim, 5), 1U);
  send({reg::kSpiOpcodeWriteInstruction,
        reg::kBreakAbort});  // the chip waits for the acknowledge of channel 1
  mb4sim_advance_ns(sim, 100'000);
  frame();
  EXPECT_EQ(valid(), std::make_pair(true, true));
  EXPECT_EQ(mb4sim_slave_frames(sim, 1), 1U);
}

TEST_F(CApiFirmware, WrongText_NamesLineAndKeyAndInjectsNothing) {
  const std::string good = "[[fault]]\nkind = \"silent\"\nslave = 1\nat_us = 0.0\n";
  EXPECT_EQ(refusal((good + "[[fault]]\nkind = \"silent\"\nslave = 2\nat_us = 0.0\n").c_str()),
            "inject:7:9: key 'slave': the scenario has no slave 2; it has 1, 5; the one in "
            "place 2 of the file is slave = 5 (in [[fault]])");
  EXPECT_EQ(refusal("[[channel]]\nnumber = 1\ndelay_ns = 5\n"),
            "inject:3:1: key 'delay_ns': unknown key, known here: [[channel.event]], number (in "
            "[[channel]])");
  EXPECT_EQ(refusal("[[channel]]\nnumber = 3\n"),
            "inject:2:10: key 'number': 3 is outside 1 to 2 (in [[channel]])");
  EXPECT_EQ(refusal("[chip]\n"),
            "inject:1:2: key 'chip': unknown key, known here: [[channel]], [[fault]]");
  EXPECT_NE(refusal("fault").find("inject:1:"), std::string::npos);
  EXPECT_EQ(mb4sim_inject(sim, nullptr, nullptr, 0), MB4SIM_ERROR_UNKNOWN);
  EXPECT_EQ(mb4sim_inject(nullptr, good.c_str(), nullptr, 0), MB4SIM_ERROR_UNKNOWN);
  frame();
  EXPECT_EQ(valid(), std::make_pair(true, true));
  EXPECT_NE(report().find("\"faults\": []"), std::string::npos) << report();
}

// The ramp adds 3 with every frame, from 100 on (the scenario).
TEST_F(CApiFirmware, SentWords_AreKeptForTheLast1024Frames) {
  uint64_t raw = 0;
  EXPECT_EQ(mb4sim_slave_sent(sim, 1, 1, &raw), MB4SIM_ERROR_VALUE);
  constexpr uint64_t kFrames = 1030;
  for (uint64_t i = 0; i < kFrames; ++i) frame();
  ASSERT_EQ(mb4sim_slave_frames(sim, 1), kFrames);
  std::vector<uint64_t> words;
  for (uint64_t number = kFrames - 1023; number <= kFrames; ++number) {
    ASSERT_EQ(mb4sim_slave_sent(sim, 1, number, &raw), 0) << number;
    words.push_back(raw);
  }
  for (size_t i = 1; i < words.size(); ++i) ASSERT_EQ(words[i] - words[i - 1], 3U) << i;
  EXPECT_EQ(words.front(), 100 + 3 * (kFrames - 1024));
  EXPECT_EQ(mb4sim_slave_sent(sim, 1, kFrames - 1024, &raw), MB4SIM_ERROR_VALUE);
  EXPECT_EQ(mb4sim_slave_sent(sim, 1, kFrames + 1, &raw), MB4SIM_ERROR_VALUE);
  EXPECT_EQ(mb4sim_slave_sent(sim, 1, 0, &raw), MB4SIM_ERROR_VALUE);
  EXPECT_EQ(mb4sim_slave_sent(sim, 2, 1, &raw), MB4SIM_ERROR_UNKNOWN);
  EXPECT_EQ(mb4sim_slave_sent(sim, 1, 1, nullptr), MB4SIM_ERROR_UNKNOWN);
  ASSERT_EQ(mb4sim_slave_sent(sim, 5, kFrames, &raw), 0);
  EXPECT_EQ(raw, 0x1234567U);
}

TEST_F(CApiFirmware, RunUntil_StopsAtTheLevelOrTheLimit) {
  EXPECT_EQ(mb4sim_run_until(sim, "EOT", 1, 0), 1);
  const uint64_t before = mb4sim_time_ns(sim);
  EXPECT_EQ(mb4sim_run_until(sim, "EOT", 0, 5000), 0);
  EXPECT_EQ(mb4sim_time_ns(sim), before + 5000);
  send({reg::kSpiOpcodeWriteInstruction, reg::kInstrCdm0});
  ASSERT_EQ(mb4sim_run_until(sim, "MA1", 0, 100'000), 1);
  EXPECT_EQ(mb4sim_pin_read(sim, "MA1"), 0);
  ASSERT_EQ(mb4sim_run_until(sim, "EOT", 1, 100'000), 1);
  EXPECT_EQ(mb4sim_pin_read(sim, "EOT"), 1);
  EXPECT_EQ(mb4sim_run_until(sim, "EOT", 2, 1), MB4SIM_ERROR_VALUE);
  EXPECT_EQ(mb4sim_run_until(sim, "CLK", 1, 1), MB4SIM_ERROR_DRIVEN);
  EXPECT_EQ(mb4sim_run_until(sim, "MA3", 1, 1), MB4SIM_ERROR_UNKNOWN);
  EXPECT_EQ(mb4sim_run_until(nullptr, "EOT", 1, 1), MB4SIM_ERROR_UNKNOWN);
  EXPECT_EQ(mb4sim_run_until(sim, "MA1", 0, UINT64_MAX / 1'000'000), 0);  // 18 s: nothing runs
}

// The callback against the pins: the same frame, watched edge by edge.
TEST_F(CApiFirmware, OnFrame_TellsWhatThePinsShow) {
  send({reg::kSpiOpcodeWriteInstruction, reg::kInstrCdm0});
  unsigned edges = 0;
  uint64_t first = 0;
  uint64_t last = 0;
  for (int level = 0; mb4sim_run_until(sim, "MA1", level, 100'000) == 1; level = 1 - level) {
    last = mb4sim_time_ns(sim);
    if (edges++ == 0) first = last;
  }
  ASSERT_GT(edges, 60U);
  Seen seen;
  ASSERT_EQ(mb4sim_on_frame(sim, &keep, &seen), 0);
  const uint64_t start = mb4sim_time_ns(sim);
  send({reg::kSpiOpcodeWriteInstruction, reg::kInstrCdm0});
  ASSERT_EQ(mb4sim_run_until(sim, "MA1", 0, 100'000), 1);
  const uint64_t begun = mb4sim_time_ns(sim);
  EXPECT_GT(begun, start);
  mb4sim_advance_ns(sim, 100'000);
  ASSERT_EQ(seen.frames.size(), 2U);  // one a channel
  for (const mb4sim_frame& frame : seen.frames) {
    EXPECT_EQ(frame.size, sizeof frame);
    EXPECT_EQ(frame.number, 2U);
    EXPECT_EQ(frame.flags, 0U);
  }
  const mb4sim_frame& one = seen.frames[seen.frames[0].channel == 1 ? 0 : 1];
  EXPECT_EQ(one.channel, 1U);
  EXPECT_EQ(one.ma_edges, edges);
  EXPECT_EQ(one.start_ns, begun);
  EXPECT_EQ(one.end_ns - one.start_ns, last - first);
  ASSERT_EQ(mb4sim_on_frame(sim, nullptr, nullptr), 0);
  frame();
  EXPECT_EQ(seen.frames.size(), 2U);
}

// With AGS one frame follows another; each is told once, in its order, and before the next begins.
TEST_F(CApiFirmware, OnFrame_TellsEveryCyclicFrameOnce) {
  Seen seen;
  ASSERT_EQ(mb4sim_on_frame(sim, &keep, &seen), 0);
  send({reg::kSpiOpcodeWriteRegisters, reg::kAddrFreqags, 0x10});  // a frame in 100 us or so
  send({reg::kSpiOpcodeWriteInstruction, reg::kAgsOn});
  mb4sim_advance_ns(sim, 5'000'000);
  send({reg::kSpiOpcodeWriteInstruction, reg::kBreakAbort});
  mb4sim_advance_ns(sim, 100'000);
  const uint64_t frames = mb4sim_slave_frames(sim, 1);
  ASSERT_GT(frames, 20U);
  std::vector<mb4sim_frame> one;
  for (const mb4sim_frame& frame : seen.frames) {
    if (frame.channel == 1) one.push_back(frame);
  }
  ASSERT_GE(one.size(), frames);  // BREAK may cut one before its start bit
  ASSERT_LE(one.size(), frames + 1);
  for (size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].number, i + 1);
    if (i > 0) {
      EXPECT_GT(one[i].start_ns, one[i - 1].end_ns);
    }
  }
}

struct Edge {
  unsigned channel;
  unsigned place;
  uint64_t time_ps;
  int level;
};

void keep_edge(void* context, unsigned channel, unsigned place, uint64_t time_ps, int level) {
  static_cast<std::vector<Edge>*>(context)->push_back({channel, place, time_ps, level});
}

// The edges of a place of channel 1, behind its level when the recording began.
std::vector<Edge> of_place(const std::vector<Edge>& edges, unsigned place) {
  std::vector<Edge> found;
  for (const Edge& edge : edges) {
    if (edge.channel == 1 && edge.place == place) found.push_back(edge);
  }
  EXPECT_FALSE(found.empty());
  return found;
}

TEST_F(CApiFirmware, OnEdge_TellsWhatThePinsShow) {
  send({reg::kSpiOpcodeWriteInstruction, reg::kInstrCdm0});
  std::vector<uint64_t> seen;  // as the pin shows it
  for (int level = 0; mb4sim_run_until(sim, "MA1", level, 100'000) == 1; level = 1 - level)
    seen.push_back(mb4sim_time_ns(sim));

  mb4sim_advance_ns(sim, 60'000);
  std::vector<Edge> edges;
  ASSERT_EQ(mb4sim_on_edge(sim, &keep_edge, &edges), 0);
  ASSERT_EQ(edges.size(), 8U);  // four places of two channels: their levels now
  for (const Edge& edge : edges) {
    EXPECT_EQ(edge.level, edge.place == MB4SIM_EDGE_MO ? 0 : 1);
    EXPECT_EQ(edge.time_ps / 1000, mb4sim_time_ns(sim));
  }
  frame();
  const std::vector<Edge> ma = of_place(edges, MB4SIM_EDGE_MA);
  ASSERT_EQ(ma.size(), seen.size() + 1);
  for (size_t i = 1; i < ma.size(); ++i) {
    EXPECT_EQ(ma[i].level, 1 - ma[i - 1].level);
    EXPECT_EQ(ma[i].time_ps / 1000 - ma[1].time_ps / 1000, seen[i - 1] - seen[0]);
  }

  ASSERT_EQ(mb4sim_on_edge(sim, nullptr, nullptr), 0);
  const size_t before = edges.size();
  frame();
  EXPECT_EQ(edges.size(), before);
  EXPECT_EQ(mb4sim_on_edge(nullptr, &keep_edge, &edges), MB4SIM_ERROR_UNKNOWN);
}

struct PinChange {
  size_t pin;
  uint64_t time_ps;
  int level;
};

void keep_change(void* context, size_t pin, uint64_t time_ps, int level) {
  static_cast<std::vector<PinChange>*>(context)->push_back({pin, time_ps, level});
}

// The edges of the line come from another place in the simulator than the levels of its pins.
TEST_F(CApiFirmware, WatchPins_TellsTheEdgesOfTheLineAndOtherPins) {
  std::vector<Edge> edges;
  ASSERT_EQ(mb4sim_on_edge(sim, &keep_edge, &edges), 0);
  std::vector<PinChange> changes;
  send({reg::kSpiOpcodeWriteInstruction, reg::kInstrCdm0});
  const uint64_t begin = mb4sim_time_ns(sim);
  const size_t before = edges.size();
  const char* const pins[] = {"MA1", "SL1", "EOT"};
  ASSERT_EQ(mb4sim_watch_pins(sim, pins, 3, 60'000, &keep_change, &changes), 0);
  EXPECT_EQ(mb4sim_time_ns(sim), begin + 60'000);
  edges.erase(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(before));
  constexpr unsigned kPlaces[] = {MB4SIM_EDGE_MA, MB4SIM_EDGE_SL};
  for (size_t pin = 0; pin < 2; ++pin) {
    const std::vector<Edge> line = of_place(edges, kPlaces[pin]);
    std::vector<PinChange> seen;
    std::copy_if(changes.begin() + 3, changes.end(), std::back_inserter(seen),
                 [&](const PinChange& change) { return change.pin == pin; });
    ASSERT_EQ(seen.size(), line.size());
    ASSERT_GT(seen.size(), 10U);
    for (size_t i = 0; i < seen.size(); ++i) {
      EXPECT_EQ(seen[i].time_ps, line[i].time_ps);
      EXPECT_EQ(seen[i].level, line[i].level);
    }
  }
  EXPECT_EQ(changes[2].pin, 2U);
  EXPECT_EQ(changes.back().pin, 2U);  // EOT rises behind the frame
  EXPECT_EQ(changes.back().level, 1);

  const char* const wrong[] = {"MA1", "MA3", "CLK"};
  changes.clear();
  EXPECT_EQ(mb4sim_watch_pins(sim, wrong, 2, 10, &keep_change, &changes), MB4SIM_ERROR_UNKNOWN);
  EXPECT_EQ(mb4sim_watch_pins(sim, wrong + 2, 1, 10, &keep_change, &changes), MB4SIM_ERROR_DRIVEN);
  EXPECT_EQ(mb4sim_watch_pins(sim, nullptr, 1, 10, &keep_change, &changes), MB4SIM_ERROR_UNKNOWN);
  EXPECT_EQ(mb4sim_watch_pins(sim, pins, 1, 10, nullptr, nullptr), MB4SIM_ERROR_UNKNOWN);
  EXPECT_EQ(mb4sim_watch_pins(nullptr, pins, 1, 10, &keep_change, &changes), MB4SIM_ERROR_UNKNOWN);
  EXPECT_TRUE(changes.empty());
  EXPECT_EQ(mb4sim_time_ns(sim), begin + 60'000);
}

TEST_F(CApiFirmware, EdgesOfACable_ComeAfterHalfOfItsDelay) {
  mb4sim_close(sim);
  sim = mb4sim_open(
      "[[channel]]\nnumber = 1\ndelay_ns = 100.001\n"
      "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\ndata = 0x1234567\n",
      nullptr, 0);
  ASSERT_NE(sim, nullptr);
  configure();
  std::vector<Edge> edges;
  ASSERT_EQ(mb4sim_on_edge(sim, &keep_edge, &edges), 0);
  frame();
  const std::vector<Edge> sl = of_place(edges, MB4SIM_EDGE_SL);
  const std::vector<Edge> slo = of_place(edges, MB4SIM_EDGE_SLO);
  ASSERT_EQ(sl.size(), slo.size());
  ASSERT_GT(sl.size(), 10U);
  for (size_t i = 1; i < sl.size(); ++i) {
    EXPECT_EQ(sl[i].level, slo[i].level);
    EXPECT_EQ(sl[i].time_ps, slo[i].time_ps + 50'001);  // the odd picosecond is on the way back
  }
  // The acknowledge: the second rising edge of MA makes SLO 0.
  EXPECT_EQ(slo[1].time_ps, of_place(edges, MB4SIM_EDGE_MA)[4].time_ps + 50'000);
}

TEST_F(CApiFirmware, CallsThatLetTimePass_AreRefusedInACallback) {
  Seen seen;
  seen.sim = sim;
  const auto call = [](void* context, const mb4sim_frame*) {
    auto* inside = static_cast<Seen*>(context);
    const uint64_t before = mb4sim_time_ns(inside->sim);
    mb4sim_advance_ns(inside->sim, 1000);
    EXPECT_EQ(mb4sim_last_error(inside->sim, nullptr, 0), MB4SIM_ERROR_CALLBACK);
    EXPECT_EQ(mb4sim_time_ns(inside->sim), before);
    const uint8_t byte = reg::kSpiOpcodeReadStatus;
    EXPECT_EQ(mb4sim_spi_transfer(inside->sim, &byte, nullptr, 1), MB4SIM_ERROR_CALLBACK);
    EXPECT_EQ(mb4sim_run_until(inside->sim, "EOT", 1, 1), MB4SIM_ERROR_CALLBACK);
    EXPECT_EQ(mb4sim_inject(inside->sim, "", nullptr, 0), MB4SIM_ERROR_CALLBACK);
    EXPECT_EQ(mb4sim_pin_write(inside->sim, "GETSENS", 1), MB4SIM_ERROR_CALLBACK);
    EXPECT_EQ(mb4sim_slave_set_data(inside->sim, 1, 0), MB4SIM_ERROR_CALLBACK);
    EXPECT_EQ(mb4sim_on_frame(inside->sim, nullptr, nullptr), MB4SIM_ERROR_CALLBACK);
    EXPECT_GE(mb4sim_pin_read(inside->sim, "EOT"), 0);
    uint64_t raw = 0;
    EXPECT_EQ(mb4sim_slave_sent(inside->sim, 1, 1, &raw), 0);
    EXPECT_EQ(raw, 100U);
    ++inside->calls;
  };
  ASSERT_EQ(mb4sim_on_frame(sim, call, &seen), 0);
  frame();
  EXPECT_EQ(seen.calls, 2);
  mb4sim_advance_ns(sim, 1);
  EXPECT_EQ(mb4sim_last_error(sim, nullptr, 0), 0);
}

#ifdef MB4_TRACE
std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Two waveforms after each other; frames are simulated as before, between and after them.
TEST_F(CApiFirmware, Trace_WritesAWaveformOfWhatLiesBetween) {
  const std::string folder = testing::TempDir() + "c_api_trace_" + std::to_string(getpid());
  const std::string first = folder + "_1.fst";
  const std::string second = folder + "_2.fst";
  frame();
  ASSERT_EQ(mb4sim_trace_start(sim, first.c_str()), 0);
  char why[300];
  EXPECT_EQ(mb4sim_trace_start(sim, second.c_str()), MB4SIM_ERROR_TRACE);
  EXPECT_EQ(mb4sim_last_error(sim, why, sizeof why), MB4SIM_ERROR_TRACE);
  EXPECT_EQ(why, second + ": a waveform is being written already");
  frame();
  EXPECT_EQ(mb4sim_trace_stop(sim), 0);
  EXPECT_EQ(mb4sim_last_error(sim, why, sizeof why), 0);
  EXPECT_STREQ(why, "");
  EXPECT_EQ(mb4sim_trace_stop(sim), MB4SIM_ERROR_TRACE);
  EXPECT_EQ(mb4sim_last_error(sim, why, sizeof why), MB4SIM_ERROR_TRACE);
  EXPECT_STREQ(why, "no waveform is being written");
  frame();
  ASSERT_EQ(mb4sim_trace_start(sim, second.c_str()), 0);
  frame();
  EXPECT_EQ(mb4sim_slave_frames(sim, 1), 4U);
  EXPECT_EQ(valid(), std::make_pair(true, true));
  mb4sim_close(sim);  // completes the file
  sim = nullptr;
  const std::string one = read_file(first);
  const std::string two = read_file(second);
  EXPECT_GT(one.size(), 1000U);
  EXPECT_GT(two.size(), 1000U);
  EXPECT_NE(one, two);
  std::filesystem::remove(first);
  std::filesystem::remove(second);
}

TEST_F(CApiFirmware, TraceBesideEdges_LeavesThemAsTheyAre) {
  const std::string path = testing::TempDir() + "c_api_edges_" + std::to_string(getpid()) + ".fst";
  std::vector<Edge> edges;
  ASSERT_EQ(mb4sim_on_edge(sim, &keep_edge, &edges), 0);
  frame();
  const size_t plain = edges.size();
  ASSERT_EQ(mb4sim_trace_start(sim, path.c_str()), 0);
  frame();
  const size_t traced = edges.size() - plain;
  ASSERT_EQ(mb4sim_trace_stop(sim), 0);
  edges.clear();
  EXPECT_GT(traced, 100U);
  frame();
  const std::vector<Edge> slo = of_place(edges, MB4SIM_EDGE_SLO);  // the probe is still there
  EXPECT_GT(slo.size(), 10U);
  std::filesystem::remove(path);
}

TEST_F(CApiFirmware, TraceThatCannotBe_IsToldAndLeavesTheHandleAlive) {
  char why[300];
  EXPECT_EQ(mb4sim_trace_start(sim, "/no/such/folder/x.fst"), MB4SIM_ERROR_TRACE);
  EXPECT_EQ(mb4sim_last_error(sim, why, sizeof why), MB4SIM_ERROR_TRACE);
  EXPECT_STREQ(why, "/no/such/folder/x.fst: cannot write the waveform");
  EXPECT_EQ(mb4sim_trace_start(sim, nullptr), MB4SIM_ERROR_UNKNOWN);
  EXPECT_EQ(mb4sim_trace_start(nullptr, "x.fst"), MB4SIM_ERROR_UNKNOWN);
  EXPECT_EQ(mb4sim_trace_stop(nullptr), MB4SIM_ERROR_UNKNOWN);
  const auto call = [](void* context, const mb4sim_frame*) {
    auto* inside = static_cast<Seen*>(context);
    EXPECT_EQ(mb4sim_trace_start(inside->sim, "x.fst"), MB4SIM_ERROR_CALLBACK);
    EXPECT_EQ(mb4sim_trace_stop(inside->sim), MB4SIM_ERROR_CALLBACK);
    ++inside->calls;
  };
  Seen seen;
  seen.sim = sim;
  ASSERT_EQ(mb4sim_on_frame(sim, call, &seen), 0);
  frame();
  EXPECT_EQ(seen.calls, 2);
}
#endif

// A simulator that a callback closes goes when the call that lets time pass returns.
TEST_F(CApiFirmware, ClosedInACallback_EndsWithTheCall) {
  const auto call = [](void* context, const mb4sim_frame*) {
    mb4sim_close(static_cast<mb4sim*>(context));
  };
  ASSERT_EQ(mb4sim_on_frame(sim, call, sim), 0);
  send({reg::kSpiOpcodeWriteInstruction, reg::kInstrCdm0});
  mb4sim_advance_ns(sim, 60'000);
  sim = nullptr;
}

// Round trips of more than a period of MA, and lines of different length: the chip tells its errors
// after MA has come to rest.
TEST_F(CApiFirmware, FaultsBehindALongCable_AreToldAtTheEndOfTheFrame) {
  mb4sim_close(sim);
  std::string text = kScenario;
  text.replace(text.find("number = 1"), 10, "number = 1\ndelay_ns = 2000.0");
  sim = mb4sim_open(text.c_str(), nullptr, 0);
  ASSERT_NE(sim, nullptr);
  configure();
  for (const char* slave : {"1", "5"}) {
    const std::string fault = std::string("[[fault]]\nkind = \"wrong-crc\"\nslave = ") + slave +
                              "\nat_us = 0.0\nfor_us = 40.0\n";
    ASSERT_EQ(mb4sim_inject(sim, fault.c_str(), nullptr, 0), 0);
    frame();
    EXPECT_EQ(valid(), std::make_pair(slave[0] != '1', slave[0] != '5'));
  }
  const std::string all = report();
  const size_t first = all.find("\"frames\": 1, \"ner_low\": 1");
  ASSERT_NE(first, std::string::npos) << all;
  EXPECT_NE(all.find("\"frames\": 1, \"ner_low\": 1", first + 1), std::string::npos) << all;
}

// What begins now acts at once: on the frame that runs, and on the next transfer.
TEST_F(CApiFirmware, InjectedInsideAFrame_IsCountedForThisFrame) {
  send({reg::kSpiOpcodeWriteInstruction, reg::kInstrCdm0});
  ASSERT_EQ(mb4sim_run_until(sim, "MA1", 0, 100'000), 1);
  Seen seen;
  ASSERT_EQ(
      mb4sim_inject(sim, "[[fault]]\nkind = \"bit-flip\"\nchannel = 1\nbits = [5]\nat_us = 0.0\n",
                    nullptr, 0),
      0);
  ASSERT_EQ(mb4sim_on_frame(sim, &keep, &seen), 0);
  mb4sim_advance_ns(sim, 60'000);
  EXPECT_EQ(valid(), std::make_pair(false, true));
  frame();
  EXPECT_EQ(valid(), std::make_pair(true, true));
  ASSERT_EQ(seen.frames.size(), 4U);
  for (const mb4sim_frame& frame : seen.frames) {
    const bool hit = frame.channel == 1 && frame.number == 1;
    EXPECT_EQ(frame.flags, hit ? unsigned{MB4SIM_FRAME_FAULT} : 0U) << frame.number;
  }
  EXPECT_NE(report().find("\"frames\": 1, \"ner_low\": 1"), std::string::npos) << report();
}

TEST_F(CApiFirmware, InjectedAbort_CutsTheNextTransfer) {
  ASSERT_EQ(mb4sim_inject(sim, "[[fault]]\nkind = \"abort\"\nafter_clocks = 3\nat_us = 0.0\n",
                          nullptr, 0),
            0);
  const uint8_t tx[4] = {reg::kSpiOpcodeReadRegisters, reg::kAddrRevision, 0, 0};
  uint8_t rx[4] = {};
  EXPECT_EQ(mb4sim_spi_transfer(sim, tx, rx, 4), 0);
  EXPECT_EQ(rx[3], 0);
  EXPECT_EQ(mb4sim_spi_transfer(sim, tx, rx, 4), 0);
  EXPECT_EQ(rx[3], reg::kVersionIcMb4);
  frame();
  EXPECT_NE(report().find("\"frames\": 0"), std::string::npos) << report();
}

TEST_F(CApiFirmware, NumberThatNoDoubleHolds_IsAMistake) {
  EXPECT_NE(refusal("[[fault]]\nkind = \"silent\"\nslave = 1\nat_us = 9007199254740993\n")
                .find("inject:4:9: key 'at_us': "),
            std::string::npos);
  EXPECT_NE(refusal("[[fault]]\nkind = \"silent\"\nslave = 1\nat_us = 0\n"
                    "for_us = 9007199254740993\n")
                .find("inject:5:10: key 'for_us': "),
            std::string::npos);
}

TEST_F(CApiFirmware, Report_HoldsHintsOnceWordsAreAskedFor) {
  frame();
  EXPECT_NE(report().find("\"hints\": []}"), std::string::npos) << report();
  send({reg::kSpiOpcodeWriteRegisters, reg::slave_cfg_address(1), reg::kEnscdYes | 25});
  EXPECT_NE(report().find("\"hints\": []}"), std::string::npos) << report();
  frame();
  EXPECT_NE(report().find("\"hints\": [\n  {\"kind\": \"length\", \"place\": \"slave 1\", "
                          "\"text\": \"slave 1 sends 28 bits, the chip takes 26 (SCDLEN1 = "
                          "0x19)\"}]}"),
            std::string::npos)
      << report();
}

TEST_F(CApiFirmware, Report_HoldsTheHostsViolations) {
  EXPECT_NE(report().find("\"host_violations\": {\"count\": 0, \"first\": []}"), std::string::npos)
      << report();
  char text[20];
  const int length = mb4sim_report(sim, text, sizeof text);
  EXPECT_GT(length, 19);
  EXPECT_EQ(std::string(text), report().substr(0, 19));
  EXPECT_EQ(mb4sim_report(nullptr, text, sizeof text), MB4SIM_ERROR_UNKNOWN);
  // I209: NCS must be high for 10 ns between two frames.
  mb4sim_pin_write(sim, "NCS", 0);
  mb4sim_advance_ns(sim, 1000);
  mb4sim_pin_write(sim, "NCS", 1);
  mb4sim_advance_ns(sim, 1);
  mb4sim_pin_write(sim, "NCS", 0);
  mb4sim_advance_ns(sim, 1000);
  mb4sim_pin_write(sim, "NCS", 1);
  EXPECT_NE(report().find("{\"item\": \"I209\", \"text\": \"I209: "), std::string::npos)
      << report();
}

TEST_F(CApiFirmware, ParallelBus_IsAnotherHost) {
  uint8_t data = 0;
  EXPECT_EQ(mb4sim_bus_write(sim, reg::kAddrFreq, 0), MB4SIM_ERROR_HOST);
  EXPECT_EQ(mb4sim_bus_read(sim, reg::kAddrFreq, &data), MB4SIM_ERROR_HOST);
  EXPECT_EQ(mb4sim_bus_read(sim, reg::kAddrFreq, nullptr), MB4SIM_ERROR_UNKNOWN);
  for (const char* interface : {"intel", "motorola"}) {
    const std::string text = std::string("[host]\ninterface = \"") + interface + "\"\n";
    mb4sim* bus = mb4sim_open(text.c_str(), nullptr, 0);
    ASSERT_NE(bus, nullptr);
    EXPECT_EQ(mb4sim_bus_write(bus, reg::kAddrFreq, 0x5A), 0);
    EXPECT_EQ(mb4sim_bus_read(bus, reg::kAddrFreq, &data), 0);
    EXPECT_EQ(data, 0x5A);
    EXPECT_EQ(mb4sim_bus_read(bus, reg::kAddrVersion, &data), 0);
    EXPECT_EQ(data, reg::kVersionIcMb4);
    EXPECT_EQ(mb4sim_last_error(bus, nullptr, 0), 0);
    char why[100];
    mb4sim_spi_select(bus, 1);
    EXPECT_EQ(mb4sim_last_error(bus, why, sizeof why), MB4SIM_ERROR_HOST);
    EXPECT_STREQ(why, "the scenario's host has another interface");
    EXPECT_EQ(mb4sim_spi_byte(bus, reg::kSpiOpcodeReadStatus), 0);
    EXPECT_EQ(mb4sim_last_error(bus, why, sizeof why), MB4SIM_ERROR_HOST);
    EXPECT_EQ(mb4sim_bus_read(bus, reg::kAddrFreq, &data), 0);
    EXPECT_EQ(data, 0x5A);
    mb4sim_close(bus);
  }
}

}  // namespace
