// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Keys of protocols "biss-b" and "ssi", of actuators and of MO.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "sim/lines/biss/biss_b_slave.hpp"
#include "sim/lines/biss/biss_c_slave.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/presets.hpp"
#include "sim/lines/ssi/ssi_slave.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/support/scenario_place.hpp"

namespace mb4test {

using namespace mb4::sim;

namespace {

std::string slave(const std::string& protocol, const std::string& keys) {
  return "[[channel.slave]]\nprotocol = \"" + protocol + "\"\n" + keys + "\n";
}
std::string channel(const std::string& keys, const std::string& slaves) {
  return "[[channel]]\nnumber = 1\n" + keys + slaves;
}

template <typename Config>
const Config& config_of(const Scenario& scenario, std::size_t index = 0) {
  return scenario.channels.at(0).slaves.at(index).device.as<Config>();
}

TEST(ScenarioProtocols, Ssi_IsReadCompletely) {
  const Scenario scenario =
      parse_scenario(channel("", slave("ssi",
                                       "data_bits = 25\nflag_bits = 1\ngray = true\nring = true\n"
                                       "timeout = 25\nresponse_ns = 300.5\ndata = 0x1FF")),
                     "s");
  const auto& config = config_of<SsiSlaveConfig>(scenario);
  EXPECT_EQ(config.data_bits, 25U);
  EXPECT_EQ(config.flag_bits, 1U);
  EXPECT_TRUE(config.gray);
  EXPECT_TRUE(config.ring);
  EXPECT_EQ(config.monoflop, from_us(25));
  EXPECT_EQ(config.response, from_ns(300.5));
  EXPECT_EQ(config.source.constant, 0x1FFU);
  EXPECT_EQ(config.crc.width(), 0U);
  EXPECT_FALSE(config.control.present);
  EXPECT_EQ(scenario.channels[0].protocol().key, "ssi");
}

TEST(ScenarioProtocols, SsiDefaults_AreThoseOfThePage) {
  const Scenario scenario = parse_scenario(channel("", slave("ssi", "data_bits = 13")), "s");
  const auto& config = config_of<SsiSlaveConfig>(scenario);
  EXPECT_EQ(config.flag_bits, 0U);
  EXPECT_EQ(config.source.constant, 0U);
  EXPECT_EQ(config.monoflop, from_us(20));
  EXPECT_FALSE(config.gray || config.ring);
}

TEST(ScenarioProtocols, BissB_IsReadCompletely) {
  const Scenario scenario = parse_scenario(
      channel("",
              slave("biss-b",
                    "data_bits = 15\ntimeout = 4\nregister_timeout = 32\n"
                    "busy_periods = 2\nacknowledge = \"passed-on\"\nids = 2\nread_busy_clocks = 7\n"
                    "store_busy_us = 4000\nmissing = [0x50]\n"
                    "registers = { 0x44 = [1, 2] }") +
                  slave("biss-b", "data_bits = 8\nids = 3\nregister_timeout = \"adaptive\"")),
      "s");
  const auto& near = config_of<BissBSlaveConfig>(scenario);
  EXPECT_EQ(near.timeout.fixed, from_us(4));
  EXPECT_EQ(near.register_timeout, from_us(32));
  EXPECT_EQ(near.busy_periods, 2U);
  EXPECT_TRUE(near.passes_acknowledge);
  EXPECT_EQ(near.access.ids, 2U);
  EXPECT_EQ(near.access.read_busy.frames, 7U);
  EXPECT_EQ(near.access.store_busy.time, from_us(4000));
  EXPECT_TRUE(near.access.missing[0x50]);
  EXPECT_EQ(near.crc.polynomial, 0x43U);
  // IDs count from the last slave.
  EXPECT_EQ(near.access.first_id, 3U);
  const auto& far = config_of<BissBSlaveConfig>(scenario, 1);
  EXPECT_EQ(far.access.first_id, 0U);
  EXPECT_EQ(far.register_timeout, 0U);
  EXPECT_FALSE(far.passes_acknowledge);
  EXPECT_EQ(far.timeout.fixed, from_us(16));
  EXPECT_EQ(scenario.channels[0].protocol().key, "biss-b");
}

TEST(ScenarioProtocols, ActuatorAndMo_AreReadCompletely) {
  const Scenario scenario = parse_scenario(
      channel("delay_ns = 100\nmo = true\nmo_delay_ns = 80\n",
              slave("biss-c",
                    "actuator = true\ndata_bits = 16\nstop_bit = false\ndata = 0x1234\n"
                    "acknowledge = \"passed-on\"") +
                  slave("biss-c", "actuator = true\ndata_bits = 8\nacknowledge = \"latched\"")),
      "s");
  EXPECT_TRUE(clocked(*scenario.channels[0].cable).mo);
  EXPECT_EQ(clocked(*scenario.channels[0].cable).mo_late,
            from_ns(30));  // 80 ns less half the round trip
  const auto& near = config_of<BissCSlaveConfig>(scenario);
  EXPECT_TRUE(near.actuator);
  EXPECT_FALSE(near.stop_bit);
  EXPECT_EQ(near.source.constant, 0x1234U);
  EXPECT_EQ(near.channel_bits(), 22U);
  EXPECT_TRUE(near.passes_acknowledge);
  const auto& far = config_of<BissCSlaveConfig>(scenario, 1);
  EXPECT_TRUE(far.stop_bit);
  EXPECT_FALSE(far.passes_acknowledge);
  EXPECT_EQ(far.flag_bits, 0U);
  EXPECT_EQ(far.channel_bits(), 15U);
}

TEST(ScenarioProtocols, LifeCounter_IsReadCompletely) {
  const std::string keys = "data_bits = 20\nlife_counter_bits = 6\nlife_counter_first = 1\n";
  const Scenario scenario =
      parse_scenario(channel("", slave("biss-c", keys) + slave("biss-c", keys + "flag_bits = 7\n") +
                                     slave("biss-c", "preset = \"bp3-spw\"")),
                     "s");
  const auto& config = config_of<BissCSlaveConfig>(scenario);
  EXPECT_EQ(config.life_counter.bits, 6U);
  EXPECT_EQ(config.life_counter.first, 1U);
  EXPECT_EQ(config.flag_bits, 8U) << "nE, nW and the counter";
  EXPECT_EQ(config.flags, 0xC0U) << "no error, no warning";
  EXPECT_EQ(config.source.constant, 0xC0U);
  const auto& one_flag = config_of<BissCSlaveConfig>(scenario, 1);
  EXPECT_EQ(one_flag.flag_bits, 7U);
  EXPECT_EQ(one_flag.flags, 0x40U);
  // BiSS Safety: position, nE, nW, sign of life of 6 bits; CRC of 16 bits.
  const auto& safety = config_of<BissCSlaveConfig>(scenario, 2);
  EXPECT_EQ(safety.data_bits, 26U + 2 + 6);
  EXPECT_EQ(safety.flag_bits, 8U);
  EXPECT_EQ(safety.source.constant, 0xC0U);
  EXPECT_EQ(safety.life_counter.bits, 6U);
  EXPECT_EQ(safety.life_counter.first, 0U);
  EXPECT_EQ(safety.crc.polynomial, 0x190D9U);
}

TEST(ScenarioProtocols, EveryPreset_CanBeUsedWithItsProtocol) {
  const char* const protocols[] = {"biss-c", "biss-b", "ssi"};
  for (const Preset& preset : presets()) {
    const unsigned bits = preset.device->data_bits;
    std::string keys = "preset = \"" + std::string(preset.name) + "\"";
    if (bits == 0) keys += "\ndata_bits = 20";
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string text = channel("", slave(protocols[i], keys));
      if (preset.device->traits().protocol.key == protocols[i]) {
        EXPECT_NO_THROW(parse_scenario(text, "s")) << preset.name;
      } else {
        EXPECT_THROW(parse_scenario(text, "s"), ScenarioError) << preset.name;
      }
    }
  }
}

struct BadKeys {
  const char* name;
  std::string text;
  const char* message;  // complete
};

void PrintTo(const BadKeys& bad, std::ostream* out) { *out << bad.name; }

class ScenarioProtocolErrors : public testing::TestWithParam<BadKeys> {};

TEST_P(ScenarioProtocolErrors, BadInput_GivesOneLineWithPlaceAndKey) {
  try {
    parse_scenario(GetParam().text, "s.toml");
    FAIL() << "accepted";
  } catch (const ScenarioError& error) {
    EXPECT_EQ(error.what(), with_section(GetParam().text, GetParam().message));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Bad, ScenarioProtocolErrors,
    testing::Values(
        BadKeys{"SsiBeside",
                channel("", slave("ssi", "data_bits = 8") + slave("ssi", "data_bits = 8")),
                "s.toml:6:1: key 'protocol': an SSI encoder must be alone on its channel"},
        BadKeys{"TwoProtocols",
                channel("", slave("biss-c", "data_bits = 8") + slave("biss-b", "data_bits = 8")),
                "s.toml:6:1: key 'protocol': all slaves of a channel must have the same protocol"},
        BadKeys{"SsiTimeout", channel("", slave("ssi", "data_bits = 8\ntimeout = \"adaptive\"")),
                "s.toml:6:11: key 'timeout': expected a number, found a string"},
        BadKeys{
            "SsiBusy", channel("", slave("ssi", "data_bits = 8\nbusy_periods = 1")),
            "s.toml:6:1: key 'busy_periods': unknown key; it goes with protocol = \"biss-b\" or "
            "\"biss-c\""},
        BadKeys{"SsiIds", channel("", slave("ssi", "data_bits = 8\nids = 1")),
                "s.toml:6:7: key 'ids': needs control = true"},
        BadKeys{"Response", channel("", slave("ssi", "data_bits = 8\nresponse_ns = -1")),
                "s.toml:6:15: key 'response_ns': -1 is outside 0 to 100000"},
        BadKeys{"GrayOfBissC", channel("", slave("biss-c", "data_bits = 8\ngray = true")),
                "s.toml:6:1: key 'gray': unknown key; it goes with protocol = \"ssi\""},
        BadKeys{"Acknowledge",
                channel("", slave("biss-c", "data_bits = 8\nacknowledge = \"late\"")),
                "s.toml:6:15: key 'acknowledge': unknown value 'late', expected one of: latched, "
                "passed-on"},
        BadKeys{"SsiAcknowledge",
                channel("", slave("ssi", "data_bits = 8\nacknowledge = \"latched\"")),
                "s.toml:6:1: key 'acknowledge': unknown key; it goes with protocol = \"biss-b\" or "
                "\"biss-c\""},
        BadKeys{"RegisterTimeout",
                channel("", slave("biss-b", "data_bits = 8\nregister_timeout = \"long\"")),
                "s.toml:6:20: key 'register_timeout': expected \"adaptive\" or a number of "
                "microseconds"},
        BadKeys{
            "BusyFramesOfBissB",
            channel("", slave("biss-b", "data_bits = 8\nread_busy_frames = 1")),
            "s.toml:6:1: key 'read_busy_frames': unknown key; it goes with protocol = \"biss-c\" "
            "or \"ssi\""},
        BadKeys{"BissBIds", channel("", slave("biss-b", "data_bits = 8\ncontrol = false\nids = 1")),
                "s.toml:7:7: key 'ids': needs control = true"},
        BadKeys{"ActuatorWithoutMo", channel("", slave("biss-c", "data_bits = 8\nactuator = true")),
                "s.toml:3:1: key 'actuator': an actuator needs mo = true on its channel"},
        BadKeys{"StopBitOfASensor", channel("", slave("biss-c", "data_bits = 8\nstop_bit = true")),
                "s.toml:6:12: key 'stop_bit': only an actuator has it"},
        BadKeys{
            "LifeCounterWithoutRoom",
            channel("", slave("biss-c", "data_bits = 20\nflag_bits = 5\nlife_counter_bits = 6")),
            "s.toml:7:21: key 'life_counter_bits': 6 is more than flag_bits"},
        BadKeys{"FirstWithoutLifeCounter",
                channel("", slave("biss-c", "data_bits = 20\nlife_counter_first = 1")),
                "s.toml:6:22: key 'life_counter_first': there is no life counter"},
        BadKeys{"LifeCounterOfAnActuator",
                channel("mo = true\n", slave("biss-c",
                                             "data_bits = 20\nactuator = true\n"
                                             "life_counter_bits = 6")),
                "s.toml:8:21: key 'life_counter_bits': an actuator has none"},
        BadKeys{"LifeCounterOfBissB",
                channel("", slave("biss-b", "data_bits = 20\nlife_counter_bits = 6")),
                "s.toml:6:1: key 'life_counter_bits': unknown key; it goes with protocol = "
                "\"biss-c\""},
        BadKeys{"SourceOfAnActuator",
                channel("mo = true\n",
                        slave("biss-c", "data_bits = 8\nactuator = true\nsource = \"ramp\"")),
                "s.toml:8:10: key 'source': an actuator has none; data is the word that it holds "
                "at first"},
        BadKeys{"MoDelayWithoutMo", channel("mo_delay_ns = 1\n", ""),
                "s.toml:3:15: key 'mo_delay_ns': only together with mo = true"},
        BadKeys{"MoDelay", channel("delay_ns = 100\nmo = true\nmo_delay_ns = 49\n", ""),
                "s.toml:5:15: key 'mo_delay_ns': MO must not overtake MA, which takes 50 ns one "
                "way"},
        BadKeys{"PresetOfOtherProtocol", channel("", slave("ssi", "preset = \"ic-nq\"")),
                "s.toml:5:10: key 'preset': 'ic-nq' speaks another protocol, expected one of: "
                "posital-ssi-25, tr-ce-65"}),
    [](const auto& entry) { return entry.param.name; });

}  // namespace
}  // namespace mb4test
