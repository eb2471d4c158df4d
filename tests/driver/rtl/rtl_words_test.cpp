// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The driver on a bus of words: buses and cores of any speed, snapshots, the interrupt. All other
// tests of the driver run there too (DriverHost.* of CMakeLists.txt).

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>
#include <string>

#include "drivers/c/mb4_c_access.hpp"
#include "mb4/words/page.hpp"
#include "mb4/words/snapshots.hpp"
#include "tests/support/chip_fixture.hpp"
#include "word_port.hpp"

namespace {

using mb4::Config;
using mb4::Error;
using mb4::TimedReading;
using mb4test::Chip;
using mb4test::config26;
namespace page = mb4::page;
namespace sim = mb4::sim;

struct Clocks {
  const char* interface;
  std::uint64_t bus_hz;
  std::uint32_t core_hz;
};

std::string encoder(const Clocks& clocks, const std::string& more = "") {
  return "[chip]\nf_clk_hz = " + std::to_string(clocks.core_hz) + "\n[host]\ninterface = \"" +
         clocks.interface + "\"\nbus_hz = " + std::to_string(clocks.bus_hz) +
         "\n[[channel]]\nnumber = 1\ndelay_ns = 100\n[[channel.slave]]\nprotocol = \"biss-c\"\n"
         "data_bits = 28\nsource = \"ramp\"\nstep = 5\ncontrol = true\n"
         "registers = { 0x44 = [0x12, 0x34] }\n" +
         more;
}

Config periodic(const Clocks& clocks, std::uint32_t period_clk = 2000) {
  Config config = config26(clocks.core_hz / 4, clocks.core_hz);
  config.frame_start = mb4::FrameStart::kPeriodic;
  config.frame_period_clk = period_clk;
  return config;
}

struct WordChip : Chip {
  explicit WordChip(const std::string& scenario)
      : Chip(scenario), port(simulator), page(port), snapshots(page) {}

  mb4::tool::WordPort port;
  mb4::Page<mb4::tool::WordPort> page;
  mb4::Snapshots<mb4::tool::WordPort> snapshots;
};

class DriverWords : public testing::TestWithParam<Clocks> {};

TEST_P(DriverWords, FramesRegistersAndIdentity_AreRead) {
  WordChip chip(encoder(GetParam()));
  const auto identity = chip.page.probe();
  ASSERT_TRUE(identity.ok());
  EXPECT_EQ(page::TWO_LINES::get(identity->features), 1U);
  Config config = config26(GetParam().core_hz / 4, GetParam().core_hz);
  ASSERT_TRUE(chip.device.configure(config).ok());
  ASSERT_TRUE(chip.device.verify().ok());
  for (std::uint64_t i = 0; i < 5; ++i) {
    const auto reading = chip.device.read_frame(1);
    ASSERT_TRUE(reading.ok()) << mb4::to_string(reading.error());
    EXPECT_EQ(reading->position, 5 * i);
  }
  std::array<std::uint8_t, 2> id{};
  ASSERT_TRUE(chip.device.control().read_registers({1, 0}, 0x44, id).ok());
  EXPECT_EQ(id, (std::array<std::uint8_t, 2>{0x12, 0x34}));
}

// Whatever the phase: each reading is the word that the encoder has sent in this frame, latched at
// its time, and each frame is read or counted as missed.
TEST_P(DriverWords, SnapshotsOfPeriodicFrames_AreWhatTheEncoderSent) {
  constexpr std::uint32_t kPeriod = 2000;
  WordChip chip(encoder(GetParam()));
  const Config config = periodic(GetParam(), kPeriod);
  ASSERT_TRUE(chip.device.configure(config).ok());
  ASSERT_TRUE(chip.device.automatic().start().ok());
  ASSERT_TRUE(chip.snapshots.begin(config).ok());
  std::minstd_rand random(7);
  const sim::Time period = kPeriod * (sim::kPsPerSecond / GetParam().core_hz);
  std::uint32_t readings = 0;
  std::uint32_t missed = 0;
  std::uint32_t first_frame = 0;
  std::uint64_t first_latched = 0;
  std::uint32_t last = 0;
  while (readings < 200) {
    chip.simulator.advance(random() % (2 * period));
    const mb4::Result<TimedReading> timed = chip.snapshots.poll(1);
    if (timed.error() == Error::kNoData) continue;
    ASSERT_TRUE(timed.ok());
    if (++readings == 1) {
      first_frame = timed->frame;
      first_latched = timed->latched;
    } else {
      missed += timed->missed;
    }
    last = timed->frame;
    EXPECT_EQ(timed->reading.raw, chip.simulator.slave(1)->sent_in(timed->frame));
    EXPECT_EQ(timed->latched - first_latched, std::uint64_t{kPeriod} * (last - first_frame));
    const auto now = chip.page.time();
    ASSERT_TRUE(now.ok());
    EXPECT_LT(*now - timed->latched, 2 * kPeriod);
  }
  EXPECT_EQ(readings + missed, last - first_frame + 1);
  // Nothing is held and no flag has changed.
  EXPECT_EQ(chip.status() & 0xFAU, 0xFAU & 0xFEU);
  EXPECT_TRUE(chip.device.automatic().stop().ok());
}

TEST_P(DriverWords, InterruptOfEachFrame_BringsItsPosition) {
  WordChip chip(encoder(GetParam()));
  const Config config = periodic(GetParam());
  ASSERT_TRUE(chip.device.configure(config).ok());
  ASSERT_TRUE(chip.device.automatic().start().ok());
  ASSERT_TRUE(chip.snapshots.begin(config).ok());
  ASSERT_TRUE(chip.page.enable(page::FRAME::kMask | page::LOST::kMask).ok());
  const auto irq = [&] { return chip.simulator.pin(sim::Pin::kIrq); };
  std::uint32_t last = 0;
  for (int frame = 0; frame < 50; ++frame) {
    ASSERT_TRUE(chip.simulator.run_while_waiting(irq, chip.simulator.now() + 1000 * sim::kPsPerUs));
    EXPECT_EQ(chip.page.take_events().value_or(0), page::FRAME::kMask) << frame;
    EXPECT_FALSE(irq());
    const mb4::Result<TimedReading> timed = chip.snapshots.poll(1);
    ASSERT_TRUE(timed.ok()) << frame;
    EXPECT_EQ(timed->missed, 0U);
    if (last != 0) {
      EXPECT_EQ(timed->frame, last + 1);
    }
    last = timed->frame;
  }
  // A handler that comes too late once is told.
  chip.simulator.advance(300 * sim::kPsPerUs + 4000 * (sim::kPsPerSecond / GetParam().core_hz));
  EXPECT_EQ(chip.page.take_events().value_or(0), page::FRAME::kMask | page::LOST::kMask);
  ASSERT_TRUE(chip.snapshots.poll(1).ok());
}

// A register access of the Device runs beside the snapshots.
TEST_P(DriverWords, RegisterAccessBesideSnapshots_LosesNothing) {
  WordChip chip(encoder(GetParam()));
  const Config config = periodic(GetParam());
  ASSERT_TRUE(chip.device.configure(config).ok());
  ASSERT_TRUE(chip.device.automatic().start().ok());
  ASSERT_TRUE(chip.snapshots.begin(config).ok());
  mb4_c::PolledAccess control(chip.device);
  ASSERT_TRUE(control.begin_read({1, 0}, 0x44, 2).ok());
  unsigned readings = 0;
  for (bool ended = false; !ended;) {
    const mb4::Result<bool> polled = control.poll();
    ASSERT_TRUE(polled.ok());
    ended = *polled;
    chip.simulator.advance(20 * sim::kPsPerUs);
    const mb4::Result<TimedReading> timed = chip.snapshots.poll(1);
    if (timed.error() == Error::kNoData) continue;
    ASSERT_TRUE(timed.ok());
    EXPECT_EQ(timed->missed, 0U);
    EXPECT_EQ(timed->reading.raw, chip.simulator.slave(1)->sent_in(timed->frame));
    ++readings;
  }
  EXPECT_GT(readings, 10U);
  std::array<std::uint8_t, 2> id{};
  ASSERT_TRUE(control.take(id).ok());
  EXPECT_EQ(id, (std::array<std::uint8_t, 2>{0x12, 0x34}));
}

// The last word of a frame with a wrong CRC is told once.
TEST_P(DriverWords, BadFrame_IsToldOnce) {
  WordChip chip(encoder(GetParam(), "[[fault]]\nkind = \"bit-flip\"\nat_us = 400\nbits = [9]\n"));
  const Config config = periodic(GetParam());
  ASSERT_TRUE(chip.device.configure(config).ok());
  ASSERT_TRUE(chip.device.automatic().start().ok());
  ASSERT_TRUE(chip.snapshots.begin(config).ok());
  unsigned bad = 0;
  std::uint32_t missed = 0;
  for (int i = 0; i < 100; ++i) {
    chip.simulator.advance(20 * sim::kPsPerUs);
    const mb4::Result<TimedReading> timed = chip.snapshots.poll(1);
    if (timed.ok()) missed += timed->missed;
    if (timed.error() == Error::kCrc) ++bad;
    if (!timed.ok() && timed.error() != Error::kNoData) {
      EXPECT_EQ(timed.error(), Error::kCrc);
    }
  }
  EXPECT_EQ(bad, 1U);
  EXPECT_EQ(missed, 0U);
}

TEST_P(DriverWords, CoreClockStandsStill_IsTransport) {
  WordChip chip(encoder(GetParam()));
  const Config config = periodic(GetParam());
  ASSERT_TRUE(chip.device.configure(config).ok());
  ASSERT_TRUE(chip.device.automatic().start().ok());
  ASSERT_TRUE(chip.snapshots.begin(config).ok());
  chip.simulator.inject("[[fault]]\nkind = \"clock-stop\"\nat_us = 0\nfor_us = 2000\n");
  EXPECT_EQ(chip.snapshots.poll(1).error(), Error::kTransport);
  EXPECT_EQ(chip.device.automatic().poll_slave(1).error(), Error::kTransport);
  chip.simulator.advance(2000 * sim::kPsPerUs);
  // It goes on where it was.
  ASSERT_TRUE(chip.device.automatic().restart().ok());
  chip.simulator.advance(500 * sim::kPsPerUs);
  EXPECT_TRUE(chip.snapshots.poll(1).ok());
}

INSTANTIATE_TEST_SUITE_P(
    Clocks, DriverWords,
    testing::Values(Clocks{"axi", 20'000'000, 20'000'000}, Clocks{"axi", 150'000'000, 10'000'000},
                    Clocks{"axi", 10'000'000, 25'000'000}, Clocks{"wb", 150'000'000, 25'000'000},
                    Clocks{"wb", 33'333'333, 20'000'000}, Clocks{"wb", 10'000'000, 10'000'000}),
    [](const auto& clocks) {
      return std::string(clocks.param.interface) + "_bus_" +
             std::to_string(clocks.param.bus_hz / 1'000'000) + "_core_" +
             std::to_string(clocks.param.core_hz / 1'000'000);
    });

}  // namespace
