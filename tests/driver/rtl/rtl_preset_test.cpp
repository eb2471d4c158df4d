// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Every BiSS C preset connected to the chip: the driver reads its position and its registers.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/lines/biss/biss_c_slave.hpp"
#include "sim/lines/presets.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4::Config;
using mb4::Frame;
using mb4test::Chip;
using mb4test::config26;
namespace sim = mb4::sim;

std::vector<std::string> names() {
  std::vector<std::string> list;
  for (const sim::Preset& preset : sim::presets()) {
    if (preset.device->traits().protocol.control) {
      list.emplace_back(preset.name);
    }
  }
  return list;
}

class DriverPreset : public testing::TestWithParam<std::string> {
 protected:
  static constexpr unsigned kFreeLength = 22;  // where the preset asks for it

  const sim::Preset& preset = *sim::preset_by_name(GetParam());
  const sim::BissCSlaveConfig& device = preset.device.as<sim::BissCSlaveConfig>();
  unsigned bits = device.data_bits == 0 ? kFreeLength : device.data_bits;
  Chip chip{mb4test::one_slave("preset = \"" + GetParam() + "\"" +
                               (device.data_bits == 0 ? "\ndata_bits = 22" : "") +
                               "\nsource = \"ramp\"\nstart = 5")};

  void SetUp() override {
    Config config = config26(5'000'000);
    config.slaves[0].data_bits = static_cast<std::uint8_t>(bits);
    config.slaves[0].crc_polynomial = device.crc.polynomial;
    if (device.flag_bits != 2) {
      config.slaves[0].flags = mb4::Flags::kNone;
    }
    ASSERT_TRUE(chip.device.configure(config).ok());
    ASSERT_TRUE(chip.device.automatic().start().ok());
  }
  std::uint8_t published(unsigned address) const {
    for (const auto& run : preset.registers) {
      if (address >= run.address && address < run.address + run.values.size()) {
        return run.values[address - run.address];
      }
    }
    return 0;
  }
};

TEST_P(DriverPreset, Position_IsRead) {
  Frame frame;
  for (unsigned i = 0; i < 3; ++i) {
    ASSERT_TRUE(chip.device.automatic().next(frame).ok());
    ASSERT_TRUE(frame.good(1));
    EXPECT_GE(frame[1]->position, 5U);
    EXPECT_FALSE(frame[1]->slave_error);
  }
}

TEST_P(DriverPreset, Scan_FindsItsIdentity) {
  std::array<mb4::SlaveIdentity, 2> found{};
  const mb4::Result<std::uint8_t> count = mb4::scan_bus(chip.device, 1, found);
  ASSERT_TRUE(count.ok()) << mb4::to_string(count.error());
  if (!device.control.present) {
    EXPECT_EQ(*count, 0) << "unidirectional";
    return;
  }
  ASSERT_EQ(*count, 1);
  EXPECT_TRUE(found[0].has_identity);
  for (unsigned i = 0; i < 6; ++i) {
    EXPECT_EQ(found[0].device_id[i], published(0x78 + i)) << i;
  }
  EXPECT_EQ(found[0].manufacturer[0], published(0x7E));
  EXPECT_EQ(found[0].manufacturer[1], published(0x7F));
  EXPECT_EQ(found[0].has_eds, published(0x41) != 0);
}

// All 128 registers in two accesses, beside position data.
TEST_P(DriverPreset, Registers_AreAsPublished) {
  if (!device.control.present) {
    return;  // Scan_FindsItsIdentity shows that it has none
  }
  std::array<std::uint8_t, 128> bytes{};
  const mb4::Result<void> read = chip.device.control().read_registers({1, 0}, 0, bytes);
  ASSERT_TRUE(read.ok()) << mb4::to_string(read.error());
  for (unsigned address = 0; address < bytes.size(); ++address) {
    EXPECT_EQ(bytes[address], published(address)) << address;
  }
}

INSTANTIATE_TEST_SUITE_P(All, DriverPreset, testing::ValuesIn(names()), [](const auto& tested) {
  std::string name = tested.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

// Chapter EDS of a device: scan, bank select, common page, page of the data channel.
TEST(DriverEds, Sensor_IsConfiguredByWhatItSays) {
  Chip chip(mb4test::one_slave("preset = \"eds-sensor\"\ndata = 0x2ABCDEF"));
  Config config = config26(5'000'000);
  config.slaves[0].enabled = false;  // nothing is known yet
  config.hold_cdm = true;
  config.frame_start = mb4::FrameStart::kPeriodic;
  config.frame_period_clk = 1000;
  ASSERT_TRUE(chip.device.configure(config).ok());
  ASSERT_TRUE(chip.device.automatic().start().ok());
  std::array<mb4::SlaveIdentity, 1> found{};
  ASSERT_EQ(*mb4::scan_bus(chip.device, 1, found), 1);
  ASSERT_TRUE(found[0].has_eds);

  const auto select = [&](std::uint8_t bank) {
    const std::array<std::uint8_t, 1> value{bank};
    return chip.device.control().write_registers({1, 0}, 0x40, value).ok();
  };
  std::array<std::uint8_t, 64> page{};
  ASSERT_TRUE(select(found[0].eds_bank));
  ASSERT_TRUE(chip.device.control().read_registers({1, 0}, 0, page).ok());
  const std::uint8_t length = page[0x15];
  ASSERT_TRUE(select(page[0x14]));
  ASSERT_TRUE(chip.device.control().read_registers({1, 0}, 0, page).ok());
  const std::uint8_t polynomial = page[0x1F];
  ASSERT_TRUE(chip.device.automatic().stop().ok());

  Config learned = config26(5'000'000);
  learned.slaves[0].data_bits = length;
  learned.slaves[0].crc_polynomial = polynomial;
  ASSERT_TRUE(chip.device.configure(learned).ok());
  Frame frame;
  ASSERT_TRUE(chip.device.read_all(frame).ok());
  ASSERT_TRUE(frame.good(1));
  EXPECT_EQ(frame[1]->raw, 0x2ABCDEFU);
}

// examples/control-bus.toml: three encoders on a bus; IDs count from the far end.
TEST(DriverExample, ControlBus_IsScanned) {
  const sim::Scenario scenario = sim::load_scenario(MB4_EXAMPLES "/control-bus.toml");
  sim::Simulator simulator(scenario);
  mb4::tool::SimBus bus(simulator);
  mb4::tool::SimClock clock(simulator);
  mb4::Device<mb4::tool::SimBus, mb4::tool::SimClock> device(bus, clock);
  Config config = config26(5'000'000);
  config.slaves[2] = config.slaves[1] = config.slaves[0];
  config.slaves[0].data_bits = 14;
  config.slaves[1].data_bits = 26;
  config.slaves[2].data_bits = 26;
  config.slaves[2].crc_polynomial = 0x25;
  ASSERT_TRUE(device.configure(config).ok());
  ASSERT_TRUE(device.automatic().start().ok());
  std::array<mb4::SlaveIdentity, 8> found{};
  const mb4::Result<std::uint8_t> count = mb4::scan_bus(device, 1, found);
  ASSERT_TRUE(count.ok()) << mb4::to_string(count.error());
  ASSERT_EQ(*count, 3);
  const auto text = [](const mb4::SlaveIdentity& identity) {
    return std::string(identity.device_id.begin(), identity.device_id.end());
  };
  EXPECT_EQ(text(found[0]), "MB4SIM");
  EXPECT_EQ(text(found[1]), std::string("SMA1\0\0", 6));
  EXPECT_EQ(found[2].manufacturer, (std::array<std::uint8_t, 2>{0x57, 0x41}));
  EXPECT_EQ(found[0].eds_bank, 2);
  EXPECT_FALSE(found[1].has_eds);
}

}  // namespace
