// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// BiSS C frames through the pins, mostly read by the driver.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::config26;
using mb4test::one_slave;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

const char kEncoder26[] = "data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF\ntimeout = \"adaptive\"";

// TI TIDM-1010, reference stimulus: 13 data bits 0111000001000, nE = nW = 1, CRC line bits 101110,
// as recorded edges.
TEST(ChipReplay, TiReferenceFrame_IsPosition0E08) {
  sim::Scenario scenario = sim::load_scenario(MB4_EXAMPLES "/ti-tidm-1010.toml");
  sim::Simulator simulator(scenario);
  mb4::tool::SimBus bus(simulator);
  mb4::tool::SimClock clock(simulator);
  mb4::Device device(bus, clock);
  mb4::Config config = config26(static_cast<std::uint32_t>(scenario.host.ma_hz));
  config.slaves[0].data_bits = 15;
  ASSERT_TRUE(device.configure(config).ok());
  for (int i = 0; i < 3; ++i) {
    const auto reading = device.read_frame();
    ASSERT_TRUE(reading.ok());
    EXPECT_EQ(reading.value().position, 0x0E08U);
    EXPECT_FALSE(reading.value().slave_error);
    EXPECT_FALSE(reading.value().slave_warning);
  }
}

class ChipFrequency : public testing::TestWithParam<std::uint32_t> {};

// 26 + 2 + 6 bits; N + 5 rising edges, 50 % duty (I301..I303), MA high through the timeout (CDM 0).
TEST_P(ChipFrequency, Encoder26_PositionEdgesAndDutyAreRight) {
  const std::uint32_t ma_hz = GetParam();
  // Below 1 / (2 * timeout) only an adaptive timeout works; busy as in the protocol: none.
  Chip chip(one_slave(kEncoder26));
  ASSERT_TRUE(chip.device.configure(config26(ma_hz)).ok());
  for (int i = 0; i < 3; ++i) {
    const auto reading = chip.device.read_frame();
    ASSERT_TRUE(reading.ok());
    EXPECT_EQ(reading.value().position, 0xAAF37BFU >> 2);
    EXPECT_FALSE(reading.value().slave_error);
    EXPECT_FALSE(reading.value().slave_warning);
    const auto frame = clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now());
    EXPECT_EQ(frame.rising, 34U + 5U);
    const sim::Time half = 1'000'000'000'000ULL / ma_hz / 2;
    EXPECT_EQ(frame.min_high, half);
    EXPECT_EQ(frame.max_high, half);
    EXPECT_EQ(frame.min_low, half);
    EXPECT_EQ(frame.max_low, half);
    EXPECT_TRUE(frame.rest_level);
  }
  EXPECT_EQ(chip.simulator.slave(1)->frames(), 3U);
}

INSTANTIATE_TEST_SUITE_P(MaHz, ChipFrequency,
                         testing::Values(10'000'000, 5'000'000, 2'500'000, 1'000'000, 250'000,
                                         62'500));

// N + 5 + b rising edges for processing times b, with and without line delay.
TEST(ChipFrame, ProcessingTimeAndDelay_EdgesAreNPlus5PlusB) {
  for (const unsigned busy : {0U, 1U, 3U, 17U}) {
    for (const char* delay : {"0.0", "37.5", "612.0", "3000.0"}) {
      Chip chip(one_slave(std::string(kEncoder26) + "\nbusy_periods = " + std::to_string(busy),
                          std::string("delay_ns = ") + delay));
      ASSERT_TRUE(chip.device.configure(config26(10'000'000)).ok());
      for (int i = 0; i < 2; ++i) {
        const auto reading = chip.device.read_frame();
        ASSERT_TRUE(reading.ok()) << busy << " " << delay;
        EXPECT_EQ(reading.value().position, 0xAAF37BFU >> 2);
        EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now()).rising,
                  34U + 5U + busy)
            << busy << " " << delay;
      }
    }
  }
}

// Every single flipped bit of data and CRC: no value from the driver, SVALID1 = 0, nSCDERR = 0,
// NER.
TEST(ChipFrame, EveryFlippedBit_IsAnErrorAndNeverAValue) {
  Chip chip(one_slave(kEncoder26));
  ASSERT_TRUE(chip.device.configure(config26(10'000'000)).ok());
  for (unsigned bit = 2; bit < 2 + 34; ++bit) {
    clocked(chip.simulator.line(1))->faults().flip_next_frame({bit});
    const auto reading = chip.device.read_frame();
    ASSERT_FALSE(reading.ok()) << bit;
    EXPECT_EQ(reading.error(), mb4::Error::kCrc) << bit;
    // Once more by hand: the flags as the chip shows them.
    chip.advance_us(10);
    clocked(chip.simulator.line(1))->faults().flip_next_frame({bit});
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
    const auto status = chip.spi({reg::kSpiOpcodeReadStatus, 0, 0});
    EXPECT_EQ(status[1] & 0x90, 0x00) << "nSCDERR = 0, nERR = 0";
    EXPECT_EQ(status[1] & 0x01, 0x01) << "EOT";
    EXPECT_EQ(status[2] & 0x02, 0x00) << "SVALID1";
    EXPECT_FALSE(chip.simulator.pin(sim::Pin::kNer));
    // The next good frame clears nSCDERR (decision 9).
    ASSERT_TRUE(chip.device.read_frame().ok());
    EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nSCDERR::kMask | reg::EOT::kMask),
              reg::kNerrGood | reg::kNscderrGood | reg::kEotIdle);
    EXPECT_TRUE(chip.simulator.pin(sim::Pin::kNer));
  }
}

// Table 22: bytes of SCDATA1 that a frame does not touch keep their value; CRC right aligned in the
// top byte; one frame fills one bank, the next the other.
TEST(ChipFrame, ScdataAndCrcByte_AreWhereTable22ShowsThem) {
  Chip chip(one_slave("data_bits = 21\ncrc = 0x43\ndata = 0x15A5A5"));
  chip.configure_slave1(21, reg::kScrclenCrc6, 0x00);
  for (int bank = 0; bank < 2; ++bank) {
    chip.write(reg::kAddrScdata, {0xE0, 0xE1, 0xE2, 0xE3, 0xE4, 0xE5, 0xE6, 0xE7});
    chip.write(reg::kAddrInstr,
               {static_cast<std::uint8_t>(bank == 0 ? reg::SWBANK::kMask : 0)});  // SWBANK changes
  }
  for (int frame = 0; frame < 4; ++frame) {
    chip.advance_us(20);
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
    EXPECT_EQ(chip.read(reg::kAddrScdata, 8),
              (std::vector<std::uint8_t>{0xA5, 0xA5, 0x15, 0xE3, 0xE4, 0xE5, 0xE6, 0x27}));
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo) & reg::SVALID<1>::kMask, reg::SVALID<1>::kMask);
  }
}

// Table 45: INSTR = 010 sends CDM = 0 (MA high in the timeout), 001 sends CDM = 1 (MA low), each
// clears itself; EOT is 0 while the frame runs and equals the pin.
TEST(ChipInstr, CdmZeroAndOne_AreSentAndInstrClears) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x123\ntimeout = 20.0"));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00);
  for (int round = 0; round < 3; ++round) {
    for (const unsigned cdm : {0U, 1U}) {
      const std::uint8_t instr = cdm == 0 ? 0x04 : 0x02;
      chip.instruct(instr);
      EXPECT_EQ(chip.status() & reg::EOT::kMask, 0);
      EXPECT_FALSE(chip.simulator.pin(sim::Pin::kEot));
      EXPECT_EQ(chip.read(reg::kAddrInstr), instr);
      ASSERT_TRUE(chip.wait_eot());
      EXPECT_EQ(chip.read(reg::kAddrInstr), 0);
      EXPECT_EQ(chip.status() & reg::EOT::kMask, reg::kEotIdle);
      chip.advance_us(5);
      EXPECT_EQ(chip.simulator.pin(sim::Pin::kMa1), cdm == 0);
      EXPECT_FALSE(chip.simulator.pin(sim::Pin::kSl1));
      const auto count = clocked(chip.simulator.slave(1))->cdm_count();
      chip.advance_us(40);
      EXPECT_EQ(clocked(chip.simulator.slave(1))->cdm_count(), count + 1);
      EXPECT_EQ(clocked(chip.simulator.slave(1))->last_cdm(), cdm == 1);
      EXPECT_TRUE(chip.simulator.pin(sim::Pin::kMa1)) << "HOLDCDM = 0: back to 1";
    }
  }
}

// Table 25: HOLDCDM = 1 keeps MA until the next frame begins.
TEST(ChipInstr, HoldCdm_MaStaysLowUntilNextFrame) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x01);
  chip.write(reg::kAddrCtrl, {reg::kRegversBissC | reg::kHoldcdmHold});
  chip.instruct(reg::kInstrCdm1);
  ASSERT_TRUE(chip.wait_eot());
  chip.advance_us(100);
  EXPECT_FALSE(chip.simulator.pin(sim::Pin::kMa1));
  EXPECT_TRUE(chip.simulator.pin(sim::Pin::kSl1));
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo) & reg::SVALID<1>::kMask, reg::SVALID<1>::kMask);
  chip.advance_us(100);
  EXPECT_TRUE(chip.simulator.pin(sim::Pin::kMa1));
  EXPECT_TRUE(clocked(chip.simulator.slave(1))->cdm_count() == 2 &&
              !clocked(chip.simulator.slave(1))->last_cdm());
}

// Decision 3 and Table 45's text: SL low at the start of a frame.
TEST(ChipInstr, SlLowAtStart_NoFrameAndAgsError) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x00);
  clocked(chip.simulator.line(1))->faults().stick(false);
  chip.simulator.refresh_lines();
  chip.advance_us(1);
  chip.instruct(reg::kInstrCdm0);
  chip.advance_us(2);
  EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nAGSERR::kMask | reg::EOT::kMask),
            reg::kEotIdle)
      << "nERR = nAGSERR = 0, EOT = 1";
  EXPECT_EQ(chip.read(reg::kAddrInstr), 0);
  EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().frames(), 0U);
  // BREAK returns the flags to 1 (decision 8).
  chip.instruct(reg::kBreakAbort);
  EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nAGSERR::kMask | reg::EOT::kMask),
            reg::kNerrGood | reg::kNagserrGood | reg::kEotIdle);
}

TEST(ChipInstr, SlLowAtStartWithAgsMin_WaitsForOneWithoutError) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  clocked(chip.simulator.line(1))->faults().stick(false);
  chip.simulator.refresh_lines();
  chip.advance_us(1);
  chip.instruct(reg::kInstrCdm0);
  chip.advance_us(50);
  EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nAGSERR::kMask | reg::EOT::kMask),
            reg::kNerrGood | reg::kNagserrGood);
  EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().frames(), 0U);
  clocked(chip.simulator.line(1))->faults().stick(std::nullopt);
  chip.simulator.refresh_lines();
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo) & reg::SVALID<1>::kMask, reg::SVALID<1>::kMask);
}

// Decision 4: a silent sensor keeps the frame running; page 33: BREAK ends it.
TEST(ChipBreak, SilentSensor_FrameRunsUntilBreak) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00);
  clocked(chip.simulator.line(1))->faults().stick(true);
  chip.simulator.refresh_lines();
  chip.instruct(reg::kInstrCdm0);
  chip.advance_us(2000);
  EXPECT_EQ(chip.status() & reg::EOT::kMask, 0);
  EXPECT_GT(clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now()).rising, 19000U);
  chip.instruct(reg::kBreakAbort);
  EXPECT_EQ(chip.status(), reg::kResetStatus0);
  EXPECT_EQ(chip.read(reg::kAddrInstr), 0);
  chip.advance_us(1);
  EXPECT_TRUE(chip.simulator.pin(sim::Pin::kMa1));
  const auto rising = clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now()).rising;
  chip.advance_us(100);
  EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now()).rising, rising);
  // The next frame works.
  clocked(chip.simulator.line(1))->faults().stick(std::nullopt);
  chip.simulator.refresh_lines();
  chip.advance_us(100);
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo) & reg::SVALID<1>::kMask, reg::SVALID<1>::kMask);
  EXPECT_EQ(chip.read(reg::kAddrScdata, 4), (std::vector<std::uint8_t>{0xBF, 0x37, 0xAF, 0x0A}));
}

// BREAK in the middle of a frame at every phase: no bank switch, no validity, no short pulse.
TEST(ChipBreak, AnyPhaseOfAFrame_AbortsAndRecovers) {
  Chip chip(one_slave(kEncoder26, "delay_ns = 123.0"));
  ASSERT_TRUE(chip.device.configure(config26(5'000'000)).ok());
  for (unsigned step = 0; step < 90; ++step) {
    chip.write(reg::kAddrScdata, {0x5A});  // the host's bank; a good read has cleared SVALID1
    chip.instruct(reg::kInstrCdm0);
    chip.simulator.advance(step * 67 * sim::kPsPerNs);
    chip.instruct(reg::kBreakAbort);
    EXPECT_EQ(chip.status() & (reg::nAGSERR::kMask | reg::nDELAYERR::kMask | reg::nSCDERR::kMask |
                               reg::nREGERR::kMask | reg::EOT::kMask),
              reg::kNagserrGood | reg::kNdelayerrGood | reg::kNscderrGood | reg::kNregerrGood |
                  reg::kEotIdle)
        << step;
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo), 0) << "no validity at step " << step;
    EXPECT_EQ(chip.read(reg::kAddrScdata), 0x5A) << "no bank switch at step " << step;
    chip.advance_us(30);
    EXPECT_TRUE(chip.simulator.pin(sim::Pin::kMa1)) << step;
    const auto frame = clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now());
    EXPECT_GE(frame.min_low, 100 * sim::kPsPerNs) << step;
    const auto reading = chip.device.read_frame();
    ASSERT_TRUE(reading.ok()) << step;
    EXPECT_EQ(reading.value().position, 0xAAF37BFU >> 2);
  }
}

// The driver on the real chip: what it must do with a silent and with a stuck line.
TEST(ChipDriver, SilentSensor_TimeoutAndNextReadWorks) {
  Chip chip(one_slave(kEncoder26));
  ASSERT_TRUE(chip.device.configure(config26(10'000'000)).ok());
  clocked(chip.simulator.line(1))->faults().stick(true);
  chip.simulator.refresh_lines();
  auto reading = chip.device.read_frame();
  ASSERT_FALSE(reading.ok());
  EXPECT_EQ(reading.error(), mb4::Error::kTimeout);
  clocked(chip.simulator.line(1))->faults().stick(false);
  chip.simulator.refresh_lines();
  reading = chip.device.read_frame();
  ASSERT_FALSE(reading.ok());
  EXPECT_EQ(reading.error(), mb4::Error::kLineError);
  clocked(chip.simulator.line(1))->faults().stick(std::nullopt);
  chip.simulator.refresh_lines();
  chip.advance_us(100);
  reading = chip.device.read_frame();
  ASSERT_TRUE(reading.ok());
  EXPECT_EQ(reading.value().position, 0xAAF37BFU >> 2);
}

// A read that fails while its frame runs must not hand that frame's position to the next read.
TEST(ChipDriver, ReadFailsInTheMiddle_NextReadReturnsANewPosition) {
  Chip chip(one_slave(std::string(kEncoder26) + "\nbusy_periods = 60"));
  struct FlakyBus {
    mb4::tool::SimBus& bus;
    int fail_at = 0;
    int count = 0;
    bool transfer(mb4::Span<const std::uint8_t> tx, mb4::Span<std::uint8_t> rx) {
      return ++count == fail_at ? false : bus.transfer(tx, rx);
    }
  };
  for (int fail = 1; fail <= 6; ++fail) {
    FlakyBus bus{chip.bus};
    mb4::Device device(bus, chip.clock);
    ASSERT_TRUE(device.configure(config26(10'000'000)).ok());
    ASSERT_TRUE(chip.simulator.slave(1)->set_data((100U << 2) | 3U));
    bus.count = 0;
    bus.fail_at = fail;
    const auto failed = device.read_frame();
    ASSERT_TRUE(chip.simulator.slave(1)->set_data((200U << 2) | 3U));
    if (failed.ok()) continue;
    bus.fail_at = 0;
    const auto reading = device.read_frame();
    ASSERT_TRUE(reading.ok()) << fail;
    EXPECT_EQ(reading.value().position, 200U) << fail;
  }
}

// Page 34 read literally (decision 8): each write of 0xF4, BREAK as well, sets nAGSERR to 0, and an
// INIT that begins sets it to 1 again; good frames stay good. Without the quirk no write does.
TEST(ChipDriver, QuirkAgserrOnInstrWrite_GoodFramesAreRead) {
  for (const bool quirk : {false, true}) {
    Chip chip(
        one_slave(kEncoder26, "", quirk ? "[chip.quirks]\nAGSERR_ON_INSTR_WRITE = true" : ""));
    ASSERT_TRUE(chip.device.configure(config26(10'000'000)).ok());
    for (int i = 0; i < 3; ++i) {
      const auto reading = chip.device.read_frame();
      ASSERT_TRUE(reading.ok());
      EXPECT_EQ(reading.value().raw, 0xAAF37BFU);
      EXPECT_EQ(chip.status(), quirk
                                   ? reg::kResetStatus0 & ~(reg::nERR::kMask | reg::nAGSERR::kMask)
                                   : reg::kResetStatus0)
          << "nERR, nAGSERR";
      EXPECT_EQ(chip.simulator.pin(sim::Pin::kNer), !quirk);
    }
    for (const unsigned byte : {0x00U, 0x80U, 0x40U, 0x20U, 0x04U}) {
      chip.instruct(reg::kInitStart);
      ASSERT_TRUE(chip.wait_eot());
      EXPECT_EQ(chip.status(), reg::kResetStatus0) << "INIT";
      chip.write(reg::kAddrStatus3, {static_cast<std::uint8_t>(byte)});
      EXPECT_EQ(chip.status(), reg::kResetStatus0) << "another register";
      chip.write(reg::kAddrInstr, {static_cast<std::uint8_t>(byte)});
      ASSERT_TRUE(chip.wait_eot());
      EXPECT_EQ(chip.status(), quirk
                                   ? reg::kResetStatus0 & ~(reg::nERR::kMask | reg::nAGSERR::kMask)
                                   : reg::kResetStatus0)
          << byte;
      chip.advance_us(20);
    }
  }
}

TEST(ChipDriver, Probe_ReportsVersionAndRevision) {
  for (const auto& [quirk, revision] : {std::pair{"", 0x20},
                                        {"[chip.quirks]\nREVISION = 0x10\n", 0x10},
                                        {"[chip.quirks]\nREVISION = 0x11\n", 0x11}}) {
    Chip chip(quirk);
    const auto identity = chip.device.probe();
    ASSERT_TRUE(identity.ok());
    EXPECT_EQ(identity.value().version, 0x84);
    EXPECT_EQ(identity.value().revision, revision);
  }
}

TEST(ChipDriver, EncoderReportsErrorBit_ReadingSaysSo) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x4\n"));
  ASSERT_TRUE(chip.device.configure(config26(10'000'000)).ok());
  const auto reading = chip.device.read_frame();
  EXPECT_EQ(reading.error(), mb4::Error::kSlaveError);
  EXPECT_EQ(reading.reading().position, 1U);
  EXPECT_TRUE(reading.reading().slave_error);
  EXPECT_TRUE(reading.reading().slave_warning);
}

// The same word whatever the length, CRC and frequency; the slave's data change from frame to
// frame.
TEST(ChipDriver, LengthsAndCrcs_RoundTrip) {
  std::uint64_t seed = 0x9E3779B97F4A7C15ULL;
  for (unsigned bits = 1; bits <= 64; ++bits) {
    for (const std::uint32_t polynomial : {0x0U, 0xBU, 0x43U, 0x97U, 0x12FU, 0x190D9U}) {
      std::ostringstream keys;
      keys << "data_bits = " << bits << "\ncrc = " << polynomial
           << "\ncrc_start = " << (polynomial == 0 ? 0 : 5) << "\n";
      Chip chip(one_slave(keys.str(), "delay_ns = 80.0"));
      mb4::Config config = config26(10'000'000);
      config.slaves[0].data_bits = static_cast<std::uint8_t>(bits);
      config.slaves[0].flags = mb4::Flags::kNone;
      config.slaves[0].crc_polynomial = polynomial;
      config.slaves[0].crc_start = polynomial == 0 ? 0 : 5;
      config.spi_check = bits % 2 == 0 ? mb4::SpiCheck::kFull : mb4::SpiCheck::kOff;
      ASSERT_TRUE(chip.device.configure(config).ok()) << bits;
      for (int i = 0; i < 2; ++i) {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        const std::uint64_t word = bits == 64 ? seed : seed & ((1ULL << bits) - 1);
        ASSERT_TRUE(chip.simulator.slave(1)->set_data(word));
        const auto reading = chip.device.read_frame();
        ASSERT_TRUE(reading.ok()) << bits << " crc " << polynomial;
        EXPECT_EQ(reading.value().raw, word) << bits << " crc " << polynomial;
      }
    }
  }
}

// Page 32, 33, Table 46: BiSS C INIT stores the line delay of channel 1 in quarter periods
// (decision 2: an ideal line gives 1), resets the flags and clears itself.
TEST(ChipInit, LineDelay_IsMeasuredInQuarterPeriods) {
  for (const auto& [delay, quarters] :
       {std::pair{"0.0", 1}, {"30.0", 2}, {"110.0", 5}, {"1000.0", 41}, {"6300.0", 253}}) {
    Chip chip(one_slave(kEncoder26, std::string("delay_ns = ") + delay));
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x00);
    // Decision 25: INIT reads back 1 at least until the next possible register read.
    chip.simulator.spi().set_timing(sim::SpiTiming::for_frequency(50'000'000));
    chip.instruct(reg::kInitStart);
    EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kInitStart);
    chip.simulator.spi().set_timing(sim::SpiTiming::for_frequency(10'000'000));
    ASSERT_TRUE(chip.wait_eot());
    EXPECT_EQ(chip.read(reg::kAddrInstr), 0);
    EXPECT_EQ(chip.status(), reg::kResetStatus0);
    EXPECT_EQ(chip.read(reg::kAddrScdata), quarters) << delay;
    EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now()).rising, 2U);
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo) & reg::SVALID<1>::kMask, reg::SVALID<1>::kMask);
  }
}

// INIT is not lost and does not hang, whatever the line is doing (decisions 19, 25).
TEST(ChipInit, WrittenAtAnyTime_RunsOnceAndLeavesTheFrameBeforeItWhole) {
  for (unsigned step = 0; step < 60; ++step) {
    for (const unsigned cdm : {0U, 1U}) {
      Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF\ntimeout = 13.0"));
      chip.configure_slave1(28, reg::kScrclenCrc6, 0x01);
      chip.instruct(cdm == 0 ? reg::kInstrCdm0 : reg::kInstrCdm1);
      chip.simulator.advance(step * 500 * sim::kPsPerNs);
      chip.instruct(reg::kInitStart);
      ASSERT_TRUE(chip.wait_eot()) << step;
      EXPECT_EQ(chip.read(reg::kAddrInstr), 0);
      EXPECT_EQ(chip.status(), reg::kResetStatus0);
      EXPECT_EQ(chip.read(reg::kAddrScdata), 1) << step;
      EXPECT_EQ(chip.simulator.slave(1)->frames(), 1U) << step;
      EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().frames(), 2U) << step;
      EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now()).rising, 2U);
    }
  }
}

// A slave that is still in the frame broken off may not answer the first INIT; the next one does.
TEST(ChipInit, TogetherWithBreakOnASilentLine_EndsAndTheNextMeasuresTheLine) {
  for (unsigned step = 0; step < 24; ++step) {
    Chip chip(one_slave(kEncoder26));
    chip.configure_slave1(28, reg::kScrclenCrc6, static_cast<std::uint8_t>(step % 12));
    clocked(chip.simulator.line(1))->faults().stick(true);
    chip.simulator.refresh_lines();
    chip.instruct(reg::kInstrCdm0);
    chip.simulator.advance(30 * sim::kPsPerUs + step * 31 * sim::kPsPerNs);
    clocked(chip.simulator.line(1))->faults().stick(std::nullopt);
    chip.simulator.refresh_lines();
    chip.instruct(reg::kBreakAbort | reg::kInitStart);
    ASSERT_TRUE(chip.wait_eot()) << step;
    EXPECT_EQ(chip.read(reg::kAddrInstr), 0);
    chip.advance_us(50);
    chip.instruct(reg::kInitStart);
    ASSERT_TRUE(chip.wait_eot()) << step;
    EXPECT_EQ(chip.status(), reg::kResetStatus0);
    EXPECT_EQ(chip.read(reg::kAddrScdata), 1);
  }
}

// FREQS and HOLDCDM belong to the next frame as soon as EOT is 1, though MA may still have to end.
TEST(ChipConfig, FreqsWrittenAtEot_TheRunningTailKeepsItsClock) {
  for (const auto& [before, after] : {std::pair{0x1F, 0x01}, {0x01, 0x1F}, {0x09, 0x00}}) {
    Chip chip(one_slave(kEncoder26));
    chip.simulator.spi().set_timing(sim::SpiTiming::for_frequency(50'000'000));
    chip.configure_slave1(28, reg::kScrclenCrc6, static_cast<std::uint8_t>(before));
    chip.instruct(reg::kInstrCdm1);
    ASSERT_TRUE(chip.wait_eot());
    chip.write(reg::kAddrFreq, {static_cast<std::uint8_t>(reg::FREQR::of(5) | after)});
    chip.advance_us(100);
    const auto frame = clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now());
    const unsigned half_clocks = before < 0x10 ? before + 1 : 10 * (before - 15);
    EXPECT_EQ(frame.max_low, half_clocks * 50 * sim::kPsPerNs);
    EXPECT_EQ(frame.max_high, half_clocks * 50 * sim::kPsPerNs);
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
  }
}

// Page 35: CDS1, CDSSEL switch with the banks; CDMTIMEOUT counts 14 frames with CDM = 0.
TEST(ChipStatus, CdmTimeout_FourteenZerosSetItAndAOneClearsIt) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  for (int round = 0; round < 2; ++round) {
    for (int i = 1; i <= 16; ++i) {
      chip.instruct(reg::kInstrCdm0);
      ASSERT_TRUE(chip.wait_eot());
      EXPECT_EQ(chip.read(reg::kAddrStatus3) & reg::CDMTIMEOUT::kMask,
                i >= 14 ? reg::kCdmtimeoutReached : 0)
          << i;
    }
    chip.instruct(reg::kInstrCdm1);
    ASSERT_TRUE(chip.wait_eot());
    EXPECT_EQ(chip.read(reg::kAddrStatus3) & reg::CDMTIMEOUT::kMask, 0);
  }
  for (int i = 0; i < 14; ++i) {
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
  }
  chip.instruct(reg::kInitStart);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(reg::kAddrStatus3) & reg::CDMTIMEOUT::kMask, 0) << "INIT";
}

// No line in use: nothing to run; INSTR clears itself all the same (docs/choices.md).
TEST(ChipInstr, NoLineInUse_InstrClearsWithoutAFrame) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00);
  chip.write(reg::kAddrCfgch, {reg::kCfgch2Unused | reg::kCfgch1Unused});
  chip.instruct(reg::kInstrCdm0);
  chip.advance_us(2);
  EXPECT_EQ(chip.read(reg::kAddrInstr), 0);
  EXPECT_EQ(chip.status(), reg::kResetStatus0);
  EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().frames(), 0U);
}

// Decision 19: the same INSTR written again during its frame (to set HOLDBANK, say) is no request.
TEST(ChipInstr, SameInstrWrittenDuringItsFrame_NoSecondFrame) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x03, reg::kFreqagsAgsMin);
  chip.instruct(reg::kInstrCdm0);
  chip.advance_us(2);
  chip.instruct(reg::kHoldbankPrevented | reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  chip.advance_us(100);
  EXPECT_EQ(chip.status(), reg::kResetStatus0);
  EXPECT_EQ(chip.read(reg::kAddrSwbankfail), 0);
  EXPECT_EQ(chip.simulator.slave(1)->frames(), 1U);
  EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kHoldbankPrevented);
  // A different one is taken after the frame.
  chip.instruct(reg::kInstrCdm0);
  chip.advance_us(2);
  chip.instruct(reg::kInstrCdm1);
  chip.advance_us(200);
  EXPECT_EQ(chip.simulator.slave(1)->frames(), 3U);
  EXPECT_TRUE(clocked(chip.simulator.slave(1))->last_cdm());
}

TEST(ChipInit, NoAnswerIn255Quarters_AbortsWithAgsError) {
  Chip chip(one_slave(kEncoder26, "delay_ns = 7000.0"));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00);
  chip.instruct(reg::kInitStart);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.status() & (reg::nAGSERR::kMask | reg::EOT::kMask), reg::kEotIdle);
  EXPECT_EQ(chip.read(reg::kAddrInstr), 0);
}

TEST(ChipInit, SlConstantlyLow_IsIgnored) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00);
  clocked(chip.simulator.line(1))->faults().stick(false);
  chip.simulator.refresh_lines();
  chip.instruct(reg::kInitStart);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.status(), reg::kResetStatus0);
}

}  // namespace
