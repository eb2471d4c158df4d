// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The chip's set-up with a protocol that it does not speak. A program of its own: it adds the
// protocol to the list of them.
#include <gtest/gtest.h>

#include <string>

#include "masters/mb4/chip_setup.hpp"
#include "sim/core/scenario_error.hpp"
#include "sim/core/toml_reader.hpp"
#include "sim/lines/clocked/clocked_lines.hpp"
#include "sim/lines/protocols.hpp"
#include "sim/lines/ssi/ssi_slave.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4test {
namespace {

using namespace mb4::sim;

// An encoder on the lines of the chip, with words of a kind of its own.
struct ForeignConfig : SsiSlaveConfig {
  DeviceTraits traits() const override {
    DeviceTraits found = SsiSlaveConfig::traits();
    found.protocol = {.key = "foreign", .title = "a foreign protocol"};
    return found;
  }
};

const Protocol kForeign{
    "foreign",
    &kClockedLines,
    [](TomlReader&) {},
    [] { return Device(ForeignConfig()); },
    nullptr,
    [](TomlReader&, DeviceConfig& device, std::string&) { device.data_bits = 16; }};

TEST(ChipSetup, ProtocolThatTheChipDoesNotSpeak_IsRefused) {
  add_protocol(kForeign);
  const Scenario scenario = parse_scenario(
      "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"foreign\"\n", "foreign.toml");
  try {
    mb4::tool::make_config(scenario);
    FAIL() << "the chip was set up";
  } catch (const ScenarioError& error) {
    EXPECT_STREQ(error.what(),
                 "foreign.toml:4:12: key 'protocol': the chip speaks BiSS C, BiSS B and SSI, not "
                 "\"foreign\" (in [[channel.slave]])");
  }
}

}  // namespace
}  // namespace mb4test
