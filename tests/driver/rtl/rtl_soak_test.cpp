// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// A drive with everything that can go wrong, on the Verilated chip: bits of the line and of SPI are
// flipped, transfers fail or are lost, MISO is stuck, the encoder is unplugged and plugged in
// again, and registers are read and written beside all that. No position that the encoder has not
// just sent counts as good, and each period without one is counted as lost.
//
// The encoder sends the number of its frame. Faults stay within what the checks promise
// (docs/driver.md): at most two bits of the data and CRC of a frame, which CRC6 0x43 finds, and one
// disturbed transfer in a tick, which SpiCheck::kFullAndRelease finds. SpiCheck::kFull does not
// find two bits of the 0x07 that releases the bank; with it these stay as they are. MB4_SEED
// repeats a run; MB4_SOAK_FRAMES is its length.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <random>
#include <string>
#include <tuple>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/driver/rtl/rtl_calls.hpp"
#include "tests/support/environment.hpp"

namespace {

using namespace mb4test;  // NOLINT: scenarios and configurations
using mb4::Operation;
using mb4::Result;
namespace sim = mb4::sim;

constexpr std::uint8_t kWith = MB4_WITH_ALL | MB4_WITH_COUNTS;

class Drive {
 public:
  Drive(bool omits, mb4::SpiCheck check, std::uint64_t seed)
      : chip(std::string("[chip.quirks]\nAGSERR_ON_HOLDBANK = ") + (omits ? "true" : "false") +
             "\n[host]\nsclk_hz = 10_000_000\n[[channel]]\nnumber = 1\n[[channel.slave]]\n"
             "protocol = \"biss-c\"\ndata_bits = 28\nflag_bits = 0\nsource = \"ramp\"\n"
             "start = 0\nstep = 1\ncontrol = true\nregisters = { 0x44 = [0x00, 0xD9] }\n"),
        omits_(omits),
        random_(seed) {
    config_ = config26(10'000'000);
    config_.spi_check = check;
    config_.slaves[0].flags = mb4::Flags::kNone;
    config_.frame_start = mb4::FrameStart::kPeriodic;
    config_.frame_period_clk = mb4::frame_period_clk_at_least(config_.f_clk_hz, 100'000);
    period_ = config_.frame_period_clk * (sim::kPsPerSecond / config_.f_clk_hz);
    configure();
    chip.device.automatic().count(&counts);
    tick_ = chip.simulator.now() + 3 * period_ + period_ / 3;
  }

  void run(std::uint64_t ticks) {
    for (std::uint64_t i = 0; i < ticks && !testing::Test::HasFailure(); ++i) {
      for (tick_ += period_; tick_ < chip.simulator.now(); tick_ += period_) ++i;  // busy meanwhile
      chip.simulator.run_until(tick_);
      faults(i);
      read(i);
      access(i);
      if (spi_fault_ == i) {  // which frames the fault met
        const auto& opcodes = chip.bus.opcodes();
        story_ += "\ntick " + std::to_string(i) + " " + fault_.text() + ", opcodes";
        for (const std::uint8_t opcode : opcodes) story_ += " " + std::to_string(opcode);
        if (story_.size() > 2000) story_.erase(0, 1000);
      }
      chip.bus.plan({});
      if (i % 500 == 499) check_configuration();
    }
  }

  mb4_counts counts{};
  unsigned unplugged = 0;
  unsigned flipped_frames = 0;
  unsigned disturbed = 0;
  unsigned accesses = 0;
  unsigned failed_accesses = 0;
  unsigned restarts = 0;
  unsigned configured = 0;

 private:
  std::uint64_t below(std::uint64_t limit) { return random_() % limit; }

  void stick(std::optional<bool> level) {
    clocked(chip.simulator.line(1))->faults().stick(level);
    chip.simulator.refresh_lines();
  }

  void faults(std::uint64_t i) {
    if (plug_in_ != 0 && --plug_in_ == 0) stick(std::nullopt);
    if (plug_in_ == 0 && below(1000) == 0) {
      plug_in_ = 1 + below(60);
      stick(below(2) == 0);
      ++unplugged;
    } else if (plug_in_ == 0 && below(50) == 0) {
      // 0 and 1 are start bit and CDS, which no CRC protects.
      std::vector<unsigned> bits{static_cast<unsigned>(2 + below(34))};
      if (below(2) == 0) bits.push_back(static_cast<unsigned>(2 + (bits[0] - 1 + below(32)) % 34));
      clocked(chip.simulator.line(1))->faults().flip_next_frame(bits);
      ++flipped_frames;
    }
    Fault fault;
    if (below(40) == 0) {
      constexpr std::array kKinds{
          FaultKind::kRefused,  FaultKind::kFailedAfter, FaultKind::kLost,
          FaultKind::kMisoLow,  FaultKind::kMisoHigh,    FaultKind::kFlipMiso,
          FaultKind::kFlipMosi, FaultKind::kFlipMiso,    FaultKind::kFlipMosi};
      fault.kind = kKinds[below(kKinds.size())];
      fault.first = fault.last = below(10);
      fault.bit = below(16);  // every frame has two bytes
      // INSTR = 100 or SWBANK = 1 in the 0x07 that releases the bank: kFull does not find it
      // (docs/driver.md).
      if (config_.spi_check == mb4::SpiCheck::kFull && fault.kind == FaultKind::kFlipMosi) {
        if (fault.bit == 12) fault.bit = 13;
        if (fault.bit == 10) fault.bit = 11;
      }
      ++disturbed;
      spi_fault_ = i;
    }
    fault_ = fault;
    chip.bus.plan(fault);
  }

  void read(std::uint64_t i) {
    const Result<mb4::Reading> reading = chip.device.automatic().poll_slave<kWith>(1);
    if (reading) {
      const std::uint64_t word = reading->raw;
      const std::uint64_t sent = chip.simulator.slave(1)->frames();
      EXPECT_LT(word, sent);
      EXPECT_LE(sent - word, 3U) << "old: " << word << " of " << sent << ", tick " << i;
      EXPECT_TRUE(!last_ || word > *last_) << "again: " << word << ", tick " << i << story_;
      if (last_) {
        EXPECT_EQ(counts.sequence - sequence_, i - last_tick_) << "not counted, tick " << i;
        // In a period whose frame the chip has left out nothing was sampled. A disturbed bit of
        // 0xF4 does the same.
        if (whole_ && !omits_ && (!spi_fault_ || *spi_fault_ + 2 < last_tick_)) {
          EXPECT_EQ(word - *last_, i - last_tick_) << "tick " << i;
        }
      }
      EXPECT_EQ(counts.good + counts.lost, counts.sequence);
      last_ = word;
      last_tick_ = i;
      sequence_ = counts.sequence;
      whole_ = plug_in_ == 0;
      return;
    }
    switch (reading.error()) {
      case Error::kTimeout:
      case Error::kLineError:
      case Error::kWrongMode:
        restart();
        break;
      case Error::kNoData:
      case Error::kCrc:
        break;
      default:
        suspicious_ = true;
    }
    whole_ = whole_ && plug_in_ == 0;
  }

  // One step of a register access a tick; a write and a read in turns.
  void access(std::uint64_t i) {
    if (!running_) {
      if (!chip.device.automatic().running()) return;
      if (writes_) {
        address_ = static_cast<std::uint8_t>(0x60 + below(4));
        value_ = static_cast<std::uint8_t>(below(256));
      }
      const Result<void> planned =
          writes_ ? chip.device.control().plan_write(op_, {1, 0}, address_,
                                                     mb4::Span<const std::uint8_t>(&value_, 1))
                  : chip.device.control().plan_read(op_, {1, 0}, address_, {&back_, 1});
      EXPECT_TRUE(planned.ok()) << mb4::to_string(planned.error());
      running_ = true;
      begun_ = i;
      return;
    }
    if (!chip.device.finish(op_, op_.run(chip.bus), chip.clock.now_us())) return;
    running_ = false;
    if (op_.result().ok()) {
      ++accesses;
      if (writes_) {
        EXPECT_EQ(chip.simulator.slave(1)->reg_read(address_), value_)
            << "begun in tick " << begun_ << ", ended in " << i << story_;
      } else {
        EXPECT_EQ(back_, value_) << "begun in tick " << begun_ << ", ended in " << i << story_;
      }
      writes_ = !writes_;
    } else {
      ++failed_accesses;
      writes_ = true;  // what the register holds is unknown
      suspicious_ = true;
    }
    if (suspicious_) check_configuration();
    if (!chip.device.automatic().running()) restart();
  }

  void restart() {
    end_access();
    ++restarts;
    whole_ = false;
    chip.bus.plan({});
    check_configuration();
    EXPECT_TRUE(chip.device.automatic().restart().ok());
  }

  // A disturbed transfer may have written to another register.
  void check_configuration() {
    chip.bus.plan({});
    suspicious_ = false;
    if (chip.device.verify().ok()) return;
    end_access();
    configure();
    ++configured;
    whole_ = false;
  }

  void configure() {
    EXPECT_TRUE(chip.device.configure(config_).ok());
    EXPECT_TRUE(chip.device.automatic().start().ok());
  }

  void end_access() {
    if (running_) {
      while (!chip.device.finish(op_, false, chip.clock.now_us())) {
      }
    }
    running_ = false;
    writes_ = true;
  }

  FaultyChip chip;
  const bool omits_;
  std::mt19937_64 random_;
  Config config_;
  sim::Time period_ = 0;
  sim::Time tick_ = 0;
  std::uint64_t plug_in_ = 0;  // ticks until the encoder is plugged in again
  std::optional<std::uint64_t> last_;
  std::uint64_t last_tick_ = 0;
  std::uint32_t sequence_ = 0;
  std::optional<std::uint64_t> spi_fault_;  // tick of the last one
  bool whole_ = false;                      // since the last good word all frames ran
  bool suspicious_ = false;
  Operation op_;
  bool running_ = false;
  std::uint64_t begun_ = 0;
  Fault fault_;
  std::string story_;  // the last faults of SPI
  bool writes_ = true;
  std::uint8_t address_ = 0x60;
  std::uint8_t value_ = 0;
  std::uint8_t back_ = 0;
};

class DriverSoak : public testing::TestWithParam<std::tuple<bool, mb4::SpiCheck>> {};

TEST_P(DriverSoak, EverythingGoesWrong_NoWrongPositionAndEachLossCounted) {
  const std::uint64_t ticks = number("MB4_SOAK_FRAMES", 4'000);
  const std::uint64_t seed = number("MB4_SEED", 32);
  SCOPED_TRACE("MB4_SEED=" + std::to_string(seed));
  Drive drive(std::get<0>(GetParam()), std::get<1>(GetParam()), seed);
  drive.run(ticks);
  const mb4_counts& counts = drive.counts;
  std::printf(
      "%llu frames, seed %llu: %u good, %u lost, %u bad CRC, %u errors, %u late; %u frames "
      "flipped, "
      "%u transfers disturbed, %u times unplugged; %u restarts, %u configured again; %u accesses, "
      "%u failed\n",
      static_cast<unsigned long long>(ticks), static_cast<unsigned long long>(seed), counts.good,
      counts.lost, counts.crc, counts.faults, counts.late, drive.flipped_frames, drive.disturbed,
      drive.unplugged, drive.restarts, drive.configured, drive.accesses, drive.failed_accesses);
  EXPECT_GT(counts.good, ticks * 8 / 10);
  EXPECT_GT(drive.accesses, ticks / 200);
  EXPECT_GT(drive.flipped_frames, 0U);
  EXPECT_GT(drive.disturbed, 0U);
  EXPECT_GT(drive.unplugged, 0U);
  EXPECT_GT(counts.crc, 0U);
}

INSTANTIATE_TEST_SUITE_P(Quirk, DriverSoak,
                         testing::Combine(testing::Bool(),
                                          testing::Values(mb4::SpiCheck::kFull,
                                                          mb4::SpiCheck::kFullAndRelease)),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param) ? "Omits" : "Overwrites") +
                                  (std::get<1>(test.param) == mb4::SpiCheck::kFull ? ""
                                                                                   : "_Release");
                         });

}  // namespace
