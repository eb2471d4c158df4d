// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The driver's control communication without an answer: no slave at all, one that stops answering,
// one that is unplugged meanwhile. A typed error within the time that the driver promises.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>

#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/registers/control_slave.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4::Config;
using mb4::Error;
using mb4::ErrorInfo;
using mb4::Frame;
using mb4test::Chip;
using mb4test::config26;
namespace sim = mb4::sim;

struct Mode {
  bool ags;
  unsigned open_level;  // SL while the cable is unplugged
};
std::string name_of(const Mode& mode) {
  return std::string(mode.ags ? "Automatic" : "Single") + "_SlOpenIs" +
         std::to_string(mode.open_level);
}
void PrintTo(const Mode& mode, std::ostream* out) { *out << name_of(mode); }

class DriverControlAbsent : public testing::TestWithParam<Mode> {
 protected:
  void SetUp() override {
    ASSERT_TRUE(chip.device.configure(config).ok());
    if (GetParam().ags) {
      ASSERT_TRUE(chip.device.automatic().start().ok());
    }
    chip.simulator.slave(1)->reg_write(0x60, 0x11);
  }
  // The cable is connected again: the next access works, and so do positions.
  void TearDown() override {
    act(sim::ClockedLine::kPlug);
    if (GetParam().ags) {
      ASSERT_TRUE(chip.device.automatic().restart().ok());
    }
    chip.advance_us(100);
    std::array<std::uint8_t, 1> value{};
    const mb4::Result<void> again = chip.device.control().read_registers({1, 0}, 0x60, value);
    EXPECT_TRUE(again.ok()) << mb4::to_string(again.error());
    EXPECT_EQ(value[0], 0x11);
    Frame frame;
    const mb4::Result<void> read =
        GetParam().ags ? chip.device.automatic().next(frame) : chip.device.read_all(frame);
    EXPECT_TRUE(read.ok()) << mb4::to_string(read.error());
    EXPECT_TRUE(frame.good(1));
  }
  void act(sim::LineAction action) { chip.simulator.line(1)->act(chip.simulator.now(), action); }
  // Unplugs when the slave has taken the CDM of `slot`.
  void unplug_in_slot(unsigned slot) {
    sim::ClockedSlave& slave = *sim::clocked(chip.simulator.slave(1));
    const auto starts = slave.control()->counters().starts;
    watch(slave, starts, slot);
  }
  // Runs `call`, which must fail in time, and returns its error.
  template <typename Call>
  ErrorInfo fails_in_time(std::uint8_t count, Call call) {
    const sim::Time start = chip.simulator.now();
    const ErrorInfo info = call().info();
    const auto us = static_cast<double>(chip.simulator.now() - start) / sim::kPsPerUs;
    const std::uint32_t limit_us =
        mb4::detail::control_frames(count) * mb4::detail::frame_pitch_us(config) +
        mb4::detail::register_busy_us(config) + mb4::kFrameMarginUs;
    EXPECT_LT(us, 1.1 * limit_us + 2.0 * mb4::frame_timeout_us(config));
    std::printf("%s after %.0f us\n", mb4::to_string(info.code), us);
    return info;
  }
  // Automatic frames: the chip itself reports. Single ones: the frame that hangs comes first.
  void expect_error(const ErrorInfo& info, Error automatic) {
    EXPECT_EQ(info.code, GetParam().ags ? automatic : Error::kTimeout) << mb4::to_string(info.code);
    EXPECT_EQ(info.bytes(), 0);
  }

  Config config = config26(10'000'000);
  Chip chip{"[[channel]]\nnumber = 1\nopen_level = " + std::to_string(GetParam().open_level) +
            "\n[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\nread_busy_frames = 30\n"};
  std::array<std::uint8_t, 4> bytes{};

 private:
  void watch(sim::ClockedSlave& slave, std::uint64_t starts, unsigned slot) {
    const auto now = chip.simulator.now();
    if (slave.control()->counters().starts != starts && slave.idle()) {
      if (first_ == 0) {
        first_ = slave.cdm_count();
      }
      if (slave.cdm_count() >= first_ + slot) {
        return act(sim::ClockedLine::kUnplug);
      }
    }
    chip.simulator.at(now + sim::kPsPerUs / 4,
                      [this, &slave, starts, slot] { watch(slave, starts, slot); });
  }
  std::uint64_t first_ = 0;
};

TEST_P(DriverControlAbsent, NobodyThere_ReadAndWriteFail) {
  act(sim::ClockedLine::kUnplug);
  expect_error(fails_in_time(4,
                             [&] {
                               return chip.device.control().read_registers({1, 0}, 0x60, bytes);
                             }),
               Error::kRegister);
  expect_error(fails_in_time(4,
                             [&] {
                               return chip.device.control().write_registers({1, 0}, 0x60, bytes);
                             }),
               Error::kRegister);
}

TEST_P(DriverControlAbsent, NobodyThere_CommandFails) {
  act(sim::ClockedLine::kUnplug);
  mb4::Command command;
  command.code = 2;
  expect_error(fails_in_time(1, [&] { return chip.device.control().send(command); }),
               Error::kCommand);
}

TEST_P(DriverControlAbsent, NobodyThere_ScanFindsNobody) {
  act(sim::ClockedLine::kUnplug);
  const mb4::Result<std::uint8_t> count =
      mb4::scan_bus(chip.device, 1, mb4::Span<mb4::SlaveIdentity>());
  if (GetParam().ags) {
    ASSERT_TRUE(count.ok()) << mb4::to_string(count.error());
    EXPECT_EQ(*count, 0);
  } else {
    EXPECT_EQ(count.error(), Error::kTimeout);
  }
}

TEST_P(DriverControlAbsent, UnpluggedInTheHeader_Fails) {
  unplug_in_slot(9);
  expect_error(fails_in_time(4,
                             [&] {
                               return chip.device.control().read_registers({1, 0}, 0x60, bytes);
                             }),
               Error::kRegister);
}

TEST_P(DriverControlAbsent, UnpluggedWhileBusy_Fails) {
  unplug_in_slot(30);
  expect_error(fails_in_time(4,
                             [&] {
                               return chip.device.control().read_registers({1, 0}, 0x60, bytes);
                             }),
               Error::kRegisterDelay);
}

TEST_P(DriverControlAbsent, UnpluggedInTheData_Fails) {
  unplug_in_slot(19 + 30 + 5);
  expect_error(fails_in_time(4,
                             [&] {
                               return chip.device.control().read_registers({1, 0}, 0x60, bytes);
                             }),
               Error::kRegister);
}

TEST_P(DriverControlAbsent, SilentSlave_IsRegisterError) {
  clocked(chip.simulator.slave(1))->control()->faults().set_silent(true);
  const ErrorInfo info = fails_in_time(4, [&] {
    return chip.device.control().read_registers({1, 0}, 0x60, bytes);
  });
  EXPECT_EQ(info.code, Error::kRegister);
  clocked(chip.simulator.slave(1))->control()->faults().set_silent(false);
}

INSTANTIATE_TEST_SUITE_P(Modes, DriverControlAbsent,
                         testing::Values(Mode{true, 1}, Mode{true, 0}, Mode{false, 1},
                                         Mode{false, 0}),
                         [](const auto& tested) { return name_of(tested.param); });

}  // namespace
