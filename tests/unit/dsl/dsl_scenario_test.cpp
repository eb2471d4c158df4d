// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Master and encoder from a scenario: its keys, its refusals, and the frames of a whole simulator.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mb4sim/simulator.hpp"
#include "sim/core/scenario_error.hpp"
#include "sim/core/trace_error.hpp"
#include "sim/lines/dsl/dsl_slave.hpp"
#include "sim/lines/duplex/duplex_line.hpp"
#include "sim/masters/dsl_model/dsl_master.hpp"
#include "sim/scenario/scenario.hpp"

namespace {

using namespace mb4::sim;
using dsl_model::LinkFrame;
using dsl_model::LinkHost;

constexpr char kMaster[] = "[master]\ntype = \"dsl-model\"\n";
constexpr char kMotor[] =
    "[[channel]]\nnumber = 1\ncable_m = 20\njitter_ns = 5\n"
    "[[channel.slave]]\nprotocol = \"dsl\"\n";

std::string error_of(const std::string& text) {
  try {
    parse_scenario(text, "motor.toml");
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "";
}

const DslSlaveConfig& encoder_of(const Scenario& scenario) {
  return dynamic_cast<const DslSlaveConfig&>(*scenario.channels.front().slaves.front().device);
}

TEST(DslScenario, Defaults_AreThoseOfThePage) {
  const Scenario scenario = parse_scenario(std::string(kMaster) + kMotor, "motor.toml");
  EXPECT_EQ(scenario.chip.f_clk_hz, 75'000'000U);
  EXPECT_EQ(scenario.host.interface.key, "none");
  EXPECT_EQ(scenario.host.link_wait, 100'000 * kPsPerUs);
  const DuplexConfig& cable = duplex(*scenario.channels.front().cable);
  EXPECT_EQ(cable.enable, 30 * kPsPerNs);
  EXPECT_EQ(cable.disable, 40 * kPsPerNs);
  EXPECT_EQ(cable.answer_errors, 0);
  const DslSlaveConfig& encoder = encoder_of(scenario);
  EXPECT_EQ(encoder.data_bits, 32U);
  EXPECT_EQ(encoder.acceleration_bits, 11U);
  EXPECT_EQ(encoder.sync_frames, 8U);
  EXPECT_EQ(encoder.vsync_after, 3U);
  EXPECT_FALSE(encoder.positive);
  EXPECT_FALSE(encoder.direction.has_value());
  EXPECT_TRUE(encoder.status2_k28);
  EXPECT_EQ(encoder.latency, 95 * kPsPerNs);
  const auto rules = dsl_model::rules_of(scenario.chip);
  EXPECT_EQ(rules.sample, dsl_model::SampleRule::kTracking);
  EXPECT_EQ(rules.check, dsl_model::CodeCheck::kStrict);
  EXPECT_EQ(rules.quality, dsl_model::QualityRules::kSick);
  EXPECT_TRUE(rules.recover);
  EXPECT_FALSE(rules.rssi_table);
  EXPECT_EQ(rules.rx_start, 5U);
  EXPECT_EQ(rules.start_blocks, 4U);
  EXPECT_EQ(rules.vsync_limit, 64U);
  EXPECT_EQ(rules.stale_limit, 2U);
  EXPECT_TRUE(rules.strict_id);
  EXPECT_TRUE(rules.check_answers);
}

TEST(DslScenario, KeysAreRead) {
  const Scenario scenario = parse_scenario(
      std::string(kMaster) +
          "[chip]\nf_clk_hz = 75_007_500\n[chip.quirks]\nRECOVER = false\nSTRICT_CODE = false\n"
          "SAMPLE = 1\nRULES = \"firmware\"\nRSSI_TABLE = true\nRX_START = 15\nSTART_BLOCKS = 26\n"
          "VSYNC_LIMIT = 255\nSTALE_LIMIT = 3\nSTRICT_ID = false\nCHECK_ANSWERS = "
          "false\n[host]\ninterface = "
          "\"none\"\nlink_ms = 2.5\n" +
          "[[channel]]\nnumber = 1\nanswer_errors = 1e-4\nmaster_errors = 0.01\n"
          "[[channel.slave]]\nprotocol = \"dsl\"\nposition_bits = 40\nacceleration_bits = 8\n"
          "index = 15\nsigned = true\nsummary = 0x80\nsafe2_bits = 20\npipeline = 7\n"
          "s_par_bits = 3\nsync_frames = 16\nvsync_after = 9\nmsync = \"follow\"\n"
          "first = \"follow\"\nvsync_phase = 7\nstart_disparity = 1\ndirection_bit = 1\n"
          "lead_ns = 50\nlead_level = 0\nstatus2_k28 = false\nlatency_ns = 12.5\n"
          "clock_ppm = -50\nidentity_flip = 0x8_0001\nvertical_k28 = true\nsource = \"ramp\"\nstep "
          "= 3\n",
      "motor.toml");
  EXPECT_EQ(scenario.chip.f_clk_hz, 75'007'500U);
  EXPECT_EQ(scenario.host.link_wait, 2500 * kPsPerUs);
  const auto rules = dsl_model::rules_of(scenario.chip);
  EXPECT_FALSE(rules.recover);
  EXPECT_EQ(rules.check, dsl_model::CodeCheck::kPublished);
  EXPECT_EQ(rules.sample, dsl_model::SampleRule::kFirstZero);
  EXPECT_EQ(rules.quality, dsl_model::QualityRules::kFirmware);
  EXPECT_TRUE(rules.rssi_table);
  EXPECT_EQ(rules.rx_start, 15U);
  EXPECT_EQ(rules.start_blocks, 26U);
  EXPECT_EQ(rules.vsync_limit, 255U);
  EXPECT_EQ(rules.stale_limit, 3U);
  EXPECT_FALSE(rules.strict_id);
  EXPECT_FALSE(rules.check_answers);
  const DuplexConfig& cable = duplex(*scenario.channels.front().cable);
  EXPECT_EQ(cable.answer_errors, 1e-4);
  EXPECT_EQ(cable.master_errors, 0.01);
  const DslSlaveConfig& encoder = encoder_of(scenario);
  EXPECT_EQ(encoder.data_bits, 40U);
  EXPECT_EQ(encoder.acceleration_bits, 8U);
  EXPECT_EQ(encoder.index, 15U);
  EXPECT_TRUE(encoder.is_signed);
  EXPECT_EQ(encoder.summary, 0x80);
  EXPECT_EQ(encoder.safe2_bits, 20U);
  EXPECT_EQ(encoder.pipeline, 7);
  EXPECT_EQ(encoder.s_par_bits, 3U);
  EXPECT_EQ(encoder.sync_frames, 16U);
  EXPECT_EQ(encoder.identity_flip, 0x80001U);
  EXPECT_TRUE(encoder.vertical_k28);
  EXPECT_EQ(encoder.vsync_after, 9U);
  EXPECT_EQ(encoder.msync, DslFollow::kFollow);
  EXPECT_EQ(encoder.first, DslFollow::kFollow);
  EXPECT_EQ(encoder.vsync_phase, 7U);
  EXPECT_TRUE(encoder.positive);
  EXPECT_EQ(encoder.direction, true);
  EXPECT_EQ(encoder.lead, 50 * kPsPerNs);
  EXPECT_FALSE(encoder.lead_level);
  EXPECT_FALSE(encoder.status2_k28);
  EXPECT_EQ(encoder.latency, 12'500U);
  EXPECT_EQ(encoder.clock_ppm, -50);
  EXPECT_EQ(encoder.source.step, 3);
}

TEST(DslScenario, KeysOfMessages_AreRead) {
  const Scenario scenario = parse_scenario(
      std::string(kMaster) + kMotor +
          "turn_bits = 18\naccess_level = 3\nhardware_version = 9\nshort_latency_frames = 4\n"
          "status_latency_frames = 6500\nlong_latency_frames = 50\nlate_frames = 7\n"
          "short_inside_long = false\nwrite_answer_data = false\n"
          "[[channel.slave.resource]]\nid = 0x300\nname = \"TEMP\"\ntype = \"i16\"\n"
          "value = -5\nread_level = 1\nwrite_level = 2\ntimeout_ms = 80\nparent = 0x301\n"
          "latency_frames = 12\n"
          "[[channel.slave.resource]]\nid = 0x301\nname = \"OWN\"\ntype = \"node\"\n"
          "[[channel.slave.resource]]\nid = 0x302\nname = \"PLATE\"\ntype = \"string\"\n"
          "value = \"AB\"\n"
          "[[channel.slave.resource]]\nid = 0x303\nname = \"RAW\"\ntype = \"structure\"\n"
          "value = [1, 255]\n",
      "motor.toml");
  const dsl::MessageConfig& messages = encoder_of(scenario).messages;
  EXPECT_EQ(messages.turn_bits, 18U);
  EXPECT_EQ(messages.access_level, 3U);
  EXPECT_EQ(messages.hardware_version, 9);
  EXPECT_EQ(messages.short_latency, 4U);
  EXPECT_EQ(messages.status_latency, 6500U);
  EXPECT_EQ(messages.long_latency, 50U);
  EXPECT_EQ(messages.late, 7U);
  EXPECT_FALSE(messages.short_inside_long);
  EXPECT_FALSE(messages.write_answer_data);
  ASSERT_EQ(messages.resources.size(), 4U);
  const dsl::Resource& temperature = messages.resources[0];
  EXPECT_EQ(temperature.id, 0x300U);
  EXPECT_EQ(temperature.name, "TEMP");
  EXPECT_EQ(temperature.type, dsl::ResourceType::kI16);
  EXPECT_EQ(temperature.value, (std::vector<std::uint8_t>{0xFF, 0xFB}));
  EXPECT_EQ(temperature.read_level, 1U);
  EXPECT_EQ(temperature.write_level, 2U);
  EXPECT_EQ(temperature.timeout_ms, 80U);
  EXPECT_EQ(temperature.parent, 0x301U);
  EXPECT_EQ(temperature.latency, 12U);
  EXPECT_EQ(messages.resources[2].value, (std::vector<std::uint8_t>{'A', 'B'}));
  EXPECT_EQ(messages.resources[2].write_level, dsl::Resource::kNever);
  EXPECT_EQ(messages.resources[3].value, (std::vector<std::uint8_t>{1, 255}));
}

TEST(DslScenario, WrongKeys_NameFileLineAndKey) {
  const struct {
    std::string text;
    const char* in_error;
  } kCases[] = {
      {std::string(kMaster) + "[host]\ninterface = \"spi\"\n", "interface"},
      {std::string(kMaster) + "[chip]\nf_clk_hz = 0\n", "f_clk_hz"},
      {std::string(kMaster) + "[chip]\nf_clk_hz = 74_924_999\n", "f_clk_hz"},
      {std::string(kMaster) + "[chip]\nf_clk_hz = 75_075_001\n", "f_clk_hz"},
      {std::string(kMaster) + "[chip]\nf_clk_hz = 74_000_000\n", "f_clk_hz"},
      {std::string(kMaster) + "[chip]\nf_clk_hz = 76_000_000\n", "f_clk_hz"},
      {std::string(kMaster) + "[chip.quirks]\nSDK_MAP = true\n", "SDK_MAP"},
      {std::string(kMaster) + "[chip.quirks]\nSAMPLE = 3\n", "SAMPLE"},
      {std::string(kMaster) + "[[channel]]\nnumber = 2\n", "number"},
      {std::string(kMaster) + kMotor + "source = \"file\"\n", "file"},
      {std::string(kMaster) + kMotor + "position_bits = 41\n", "position_bits"},
      {std::string(kMaster) + kMotor + "data_bits = 32\n", "data_bits"},
      {std::string(kMaster) + kMotor + "acceleration_bits = 7\n", "acceleration_bits"},
      {std::string(kMaster) + kMotor + "vsync_phase = 1\n", "vsync_phase"},
      {std::string(kMaster) + kMotor + "start_disparity = 0\n", "start_disparity"},
      {std::string(kMaster) + kMotor + "direction_bit = 2\n", "direction_bit"},
      {std::string(kMaster) + "[[channel]]\nnumber = 1\nanswer_errors = 0.2\n", "answer_errors"},
      {std::string(kMaster) + kMotor + "[[channel.slave]]\nprotocol = \"dsl\"\n", "slave"},
      {std::string(kMaster) + kMotor + "turn_bits = 32\n", "turn_bits"},
      {std::string(kMaster) + kMotor + "access_level = 15\n", "access_level"},
      {std::string(kMaster) + kMotor + "[[channel.slave.resource]]\nid = 0x400\n", "id"},
      {std::string(kMaster) + kMotor + "[[channel.slave.resource]]\nname = \"A\"\n", "id"},
      {std::string(kMaster) + kMotor +
           "[[channel.slave.resource]]\nid = 5\nname = \"LONGERONE\"\ntype = \"void\"\n",
       "name"},
      {std::string(kMaster) + kMotor +
           "[[channel.slave.resource]]\nid = 5\nname = \"A\"\ntype = \"u8\"\nvalue = 256\n",
       "value"},
      {std::string(kMaster) + kMotor +
           "[[channel.slave.resource]]\nid = 5\nname = \"A\"\ntype = \"i8\"\nvalue = -129\n",
       "value"},
      {std::string(kMaster) + kMotor +
           "[[channel.slave.resource]]\nid = 5\nname = \"A\"\ntype = \"string\"\nvalue = 3\n",
       "value"},
      {std::string(kMaster) + kMotor +
           "[[channel.slave.resource]]\nid = 5\nname = \"A\"\ntype = \"string\"\n",
       "value"},
      {std::string(kMaster) + kMotor +
           "[[channel.slave.resource]]\nid = 5\nname = \"A\"\ntype = \"void\"\n"
           "[[channel.slave.resource]]\nid = 5\nname = \"B\"\ntype = \"void\"\n",
       "resource"},
      {std::string(kMaster) + kMotor + "[[fault]]\nkind = \"busy\"\nslave = 1\nat_us = 1\n",
       "slave"},
      {std::string("[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"dsl\"\n"), "protocol"},
      {std::string(kMaster) + "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"ssi\"\n",
       "protocol"}};
  for (const auto& [text, in_error] : kCases) {
    const std::string error = error_of(text);
    EXPECT_NE(error.find("motor.toml:"), std::string::npos) << text << error;
    EXPECT_NE(error.find("'" + std::string(in_error) + "'"), std::string::npos) << text << error;
  }
}

TEST(DslScenario, ClockOfNoOrOtherFrequency_NamesTheLimits) {
  EXPECT_EQ(error_of(std::string(kMaster) + "[chip]\nf_clk_hz = 0\n"),
            "motor.toml:4:12: key 'f_clk_hz': 0 is outside 74925000 to 75075000 (in [chip])");
  EXPECT_EQ(error_of(std::string(kMaster) + "[chip]\nf_clk_hz = 74_925_000\n"), "");
  EXPECT_EQ(error_of(std::string(kMaster) + "[chip]\nf_clk_hz = 75_075_000\n"), "");
}

// The master finds its speed by a difference of eight frames: 8 x speed must fit into a signed
// number of the position's width, and into 24 bits of speed. The limit itself is refused, one less
// is not.
TEST(DslScenario, SpeedThatCannotBeTold_IsRefused) {
  struct {
    unsigned bits;
    long long limit;
  } constexpr kLimits[] = {{12, 256},      {16, 4096},     {20, 65'536},
                           {24, 1 << 20U}, {27, 1 << 23U}, {40, 1 << 23U}};
  const auto scenario = [](unsigned bits, const std::string& source) {
    return std::string(kMaster) + kMotor + "position_bits = " + std::to_string(bits) + "\n" +
           source;
  };
  for (const auto& [bits, limit] : kLimits) {
    for (const int sign : {-1, 1}) {
      const auto ramp = [&](long long step) {
        return scenario(bits, "source = \"ramp\"\nstep = " + std::to_string(sign * step) + "\n");
      };
      EXPECT_EQ(error_of(ramp(limit - 1)), "") << bits;
      const std::string error = error_of(ramp(limit));
      EXPECT_NE(error.find("key 'step': too fast for a position of " + std::to_string(bits) +
                           " bits: its speed must stay below " + std::to_string(limit) +
                           " steps a frame"),
                std::string::npos)
          << error;
    }
    // The highest speed of a sine: amplitude x 2 pi x 11.52 us / period.
    const auto sine = [&](double speed) {
      return scenario(bits, "source = \"sine\"\nperiod_us = 100_000\namplitude = " +
                                std::to_string(speed / (2 * 3.14159265 * 11.52 / 100'000)) + "\n");
    };
    EXPECT_EQ(error_of(sine(0.99 * static_cast<double>(limit))), "") << bits;
    EXPECT_NE(error_of(sine(1.01 * static_cast<double>(limit))).find("'amplitude'"),
              std::string::npos)
        << bits;
  }
  // A step that wraps is a small one.
  EXPECT_EQ(error_of(scenario(12, "source = \"ramp\"\nstep = 4095\n")), "");
}

// Just below the limit each certain position is right, at widths where a fast motor was called
// certain with wrong positions.
TEST(DslScenario, FastestSpeedOfEachWidth_IsFollowed) {
  for (const unsigned bits : {12U, 16U, 20U, 24U}) {
    const auto step = (1LL << (bits - 4)) - 1;
    Simulator simulator(
        parse_scenario(std::string(kMaster) + kMotor + "position_bits = " + std::to_string(bits) +
                           "\nsource = \"ramp\"\nstep = " + std::to_string(step) + "\n",
                       "motor.toml"));
    auto& host = simulator.host<LinkHost>("none");
    const auto* encoder = dynamic_cast<const DslSlave*>(simulator.slave(1));
    unsigned certain = 0;
    unsigned wrong = 0;
    simulator.run_while_waiting(
        [&] {
          while (const auto frame = host.take()) {
            if (frame->number == 0 || frame->lost) continue;
            ++certain;
            if (frame->position != encoder->sent_in(frame->number)) ++wrong;
          }
          return certain >= 200;
        },
        100'000 * kPsPerUs);
    EXPECT_EQ(certain, 200U) << bits;
    EXPECT_EQ(wrong, 0U) << bits;
  }
}

// The whole simulator: each running frame with a certain position has the encoder's.
TEST(DslScenario, Motor_IsFollowed) {
  Simulator simulator(parse_scenario(std::string(kMaster) + kMotor +
                                         "source = \"sine\"\namplitude = 200_000\n"
                                         "period_us = 20_000\n",
                                     "motor.toml"));
  auto& host = simulator.host<LinkHost>("none");
  const auto* encoder = dynamic_cast<const DslSlave*>(simulator.slave(1));
  unsigned certain = 0;
  unsigned wrong = 0;
  simulator.run_while_waiting(
      [&] {
        while (const auto frame = host.take()) {
          if (frame->number == 0 || frame->lost) continue;
          ++certain;
          if (frame->position != encoder->sent_in(frame->number)) ++wrong;
        }
        return certain >= 2000;
      },
      100'000 * kPsPerUs);
  EXPECT_EQ(certain, 2000U);
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(host.model().link().restarts(), 0U);
  EXPECT_FALSE(encoder->overflowed());
  EXPECT_LE(duplex(simulator.line(1))->contention(simulator.now()).longest, 30 * kPsPerNs);
  EXPECT_THROW(simulator.start_trace("no.fst"), TraceError);
}

// A bit-flip of a named frame: the running frames count.
TEST(DslScenario, BitFlip_HitsItsFrame) {
  const std::string flip = "[[fault]]\nkind = \"bit-flip\"\nchannel = 1\nanswer_bit = 33\n";
  Simulator simulator(
      parse_scenario(std::string(kMaster) + kMotor + flip + "frame = 200\n", "motor.toml"));
  auto& host = simulator.host<LinkHost>("none");
  std::vector<std::uint64_t> bad;
  simulator.run_until(5000 * kPsPerUs);
  while (const auto frame = host.take()) {
    if (frame->number != 0 && !frame->acceleration_good) bad.push_back(frame->number);
  }
  EXPECT_EQ(bad, std::vector<std::uint64_t>{200});
  for (const char* other : {"at_us = 1\n", "per_s = 1\n"}) {
    EXPECT_NE(error_of(std::string(kMaster) + kMotor + flip + "frame = 200\n" + other)
                  .find("cannot be given together with frame"),
              std::string::npos);
  }
  // An answer has 61 bits, and a random one is one of them.
  const std::string past =
      "[[fault]]\nkind = \"bit-flip\"\nchannel = 1\nframe = 2\nanswer_bit = 61\n";
  EXPECT_NE(error_of(std::string(kMaster) + kMotor + past).find("'answer_bit'"), std::string::npos);
  const std::string list = "[[fault]]\nkind = \"bit-flip\"\nchannel = 1\nat_us = 2\nbits = [61]\n";
  EXPECT_NE(error_of(std::string(kMaster) + kMotor + list).find("'bits'"), std::string::npos);
  const Scenario random = parse_scenario(
      std::string(kMaster) + kMotor + "[[fault]]\nkind = \"bit-flip\"\nchannel = 1\nat_us = 2\n",
      "motor.toml");
  EXPECT_EQ(random.faults.front().frame_bits, 61U);
  EXPECT_NE(error_of(std::string(kMaster) + kMotor + flip + "frame = 0\n").find("'frame'"),
            std::string::npos);
  EXPECT_NE(
      error_of(std::string(kMaster) + kMotor + flip + "frame = 2\nbits = [1]\n").find("answer_bit"),
      std::string::npos);
}

// It happens when its frame comes, and not before; one whose frame does not come does not happen.
TEST(DslScenario, BitFlip_HappensWithItsFrame) {
  const std::string flip = "[[fault]]\nkind = \"bit-flip\"\nchannel = 1\nanswer_bit = 33\nframe = ";
  Simulator simulator(parse_scenario(
      std::string(kMaster) + kMotor + flip + "100000\n" + flip + "20\n", "motor.toml"));
  auto& host = simulator.host<LinkHost>("none");
  EXPECT_TRUE(simulator.faults().empty());
  Time sampled = 0;
  simulator.run_while_waiting(
      [&] {
        while (const auto frame = host.take()) {
          if (frame->number == 20) sampled = host.model().time_of(frame->sampled);
        }
        return sampled != 0;
      },
      100'000 * kPsPerUs);
  ASSERT_EQ(simulator.faults().size(), 1U);
  const FaultRecord& record = simulator.faults().front();
  EXPECT_EQ(record.frame, 20U);
  EXPECT_EQ(record.config, 1U);
  EXPECT_GT(record.begin, sampled);
  EXPECT_LT(record.begin, sampled + 2500 * kPsPerNs);  // the end of M_PAR, and the cable
  EXPECT_EQ(record.end, record.begin);
  simulator.run_until(5000 * kPsPerUs);
  EXPECT_EQ(simulator.faults().size(), 1U);
  EXPECT_NE(error_of(std::string(kMaster) + kMotor +
                     "[[fault]]\nkind = \"bit-flip\"\nchannel = 1\nanswer_bit = 33\n")
                .find("one of at_us (fixed times), per_s (random) and frame is needed"),
            std::string::npos);
}

// Faults of a slave and of the line; the link comes back after each.
TEST(DslScenario, Faults_BeginAndEnd) {
  for (const char* kind : {"silent", "unplug", "wrong-crc", "wrong-crc2", "fast-marker",
                           "safe-marker", "safe2-marker", "no-vsync", "early-vsync"}) {
    Simulator simulator(parse_scenario(std::string(kMaster) + kMotor + "[[fault]]\nkind = \"" +
                                           kind + "\"\nslave = 1\nat_us = 2000\nfor_us = 300\n",
                                       "motor.toml"));
    auto& host = simulator.host<LinkHost>("none");
    simulator.run_until(1990 * kPsPerUs);
    EXPECT_FALSE(host.model().link().frame().lost) << kind;
    simulator.run_until(2300 * kPsPerUs);
    EXPECT_EQ(simulator.faults().size(), 1U) << kind;
    simulator.run_until(5000 * kPsPerUs);
    EXPECT_FALSE(host.model().link().frame().lost) << kind;
    EXPECT_EQ(host.model().link().frame().quality, 15U) << kind;
  }
}

}  // namespace
