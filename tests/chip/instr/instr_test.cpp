// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The instruction register 0xF4 (pages 31..33, Tables 44..49; decisions 8, 16, 19, 30) and the CRC
// polynomials of a channel (page 25, Table 15), as the host sees them.
#include <gtest/gtest.h>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::one_slave;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

constexpr sim::Time kClk = 50'000;  // 20 MHz in ps
const char kEncoder26[] = "data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF\ntimeout = \"adaptive\"";

// Page 32: the frame starts when the byte is complete, at the last rising edge of SCLK. From there
// 3 to 4 clocks and half a period of MA to its falling edge (docs/timing.md), at every phase. BREAK
// in the same byte has nothing to end and takes no time.
TEST(ChipInstrTiming, LastSclkEdgeToMa_ThreeToFourClocksAndHalfAPeriod) {
  for (const unsigned freqs : {0x00U, 0x04U, 0x1FU}) {
    Chip chip(one_slave(kEncoder26));
    chip.configure_slave1(28, reg::kScrclenCrc6, static_cast<std::uint8_t>(freqs), 0x00);
    const auto& timing = chip.simulator.spi().timing();
    const sim::Time half = (freqs < 0x10 ? freqs + 1 : 10 * (freqs - 15)) * kClk;
    sim::Time least = ~sim::Time{0};
    sim::Time most = 0;
    for (unsigned phase = 0; phase < 50; ++phase) {
      const sim::Time millisecond = 1000 * sim::kPsPerUs;
      chip.simulator.run_until((chip.simulator.now() / millisecond + 1) * millisecond +
                               phase * sim::kPsPerNs);
      chip.instruct(phase % 2 == 0 ? reg::kInstrCdm0 : reg::kBreakAbort | reg::kInstrCdm0);
      const sim::Time byte = chip.simulator.now() - timing.ncs_hold - timing.sclk_high;
      ASSERT_TRUE(chip.wait_eot());
      chip.advance_us(40);  // the monitor knows that the clock has ended
      const auto frame = clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now());
      const sim::Time way = frame.start - byte - half;
      least = std::min(least, way);
      most = std::max(most, way);
      EXPECT_GE(way, 3 * kClk);
      EXPECT_LE(way, 4 * kClk);
    }
    EXPECT_LE(least, 3 * kClk + 2'000) << "the phases reach from one end";
    EXPECT_GE(most, 4 * kClk - 2'000) << "to the other";
  }
}

// Table 44, AGS = 0: no frame starts by itself, for any FREQAGS and GETSENS.
TEST(ChipInstr, NoAgs_NothingRunsByItself) {
  for (const unsigned freqags : {0x00U, 0x31U, 0x7CU, 0x7DU, 0x80U, 0xFFU}) {
    Chip chip(one_slave(kEncoder26));
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, static_cast<std::uint8_t>(freqags));
    chip.simulator.set_pin(sim::Pin::kGetsens, true);
    chip.instruct(0);
    chip.advance_us(9000);
    EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().frames(), 0U) << freqags;
    EXPECT_EQ(chip.status(), reg::kResetStatus0);
  }
}

// After AGS is cleared the running frame ends as usual, and no other one follows.
TEST(ChipInstr, AgsCleared_TheRunningFrameEndsAndNoneFollows) {
  for (const unsigned freqags : {0x09U, 0x7CU}) {
    for (unsigned phase = 0; phase < 24; ++phase) {
      Chip chip(one_slave(kEncoder26));
      chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, static_cast<std::uint8_t>(freqags));
      chip.instruct(reg::kAgsOn);
      chip.simulator.advance(40 * sim::kPsPerUs + phase * 413 * sim::kPsPerNs);
      chip.instruct(0);
      ASSERT_TRUE(chip.wait_eot());
      const auto frames = clocked(chip.simulator.line(1))->monitor().frames();
      EXPECT_EQ(chip.simulator.slave(1)->frames(), frames) << "each has got its start bit";
      chip.advance_us(100);
      EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().frames(), frames);
      EXPECT_EQ(chip.status(), reg::kResetStatus0);
      EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
      EXPECT_EQ(chip.read(reg::kAddrScdata, 4),
                (std::vector<std::uint8_t>{0xBF, 0x37, 0xAF, 0x0A}));
    }
  }
}

// Table 45 does not list 101 and 110: no frame, they clear themselves (docs/choices.md). With
// AGS = 1 the frames that come by themselves go on, with CDM = 0.
TEST(ChipInstr, CodesNotListed_ClearThemselvesWithoutAFrame) {
  for (const unsigned freqags : {0x31U, 0x7CU, 0x7DU}) {  // 50 us, AGSMIN, AGSINFINITE
    for (const unsigned code : {0b101U, 0b110U}) {
      Chip ags(one_slave(kEncoder26));
      ags.configure_slave1(28, reg::kScrclenCrc6, 0x00, static_cast<std::uint8_t>(freqags));
      const sim::ClockedSlave& slave = *clocked(ags.simulator.slave(1));
      if (freqags != 0x7D) {
        ags.instruct(reg::kInstrCdm1 | reg::kAgsOn);
        ags.advance_us(120);
        EXPECT_TRUE(slave.last_cdm());
      }
      ags.instruct(static_cast<std::uint8_t>(code << 1U | 1U));
      const auto frames = slave.frames();
      ags.advance_us(120);
      EXPECT_EQ(ags.read(reg::kAddrInstr), reg::kAgsOn) << code;
      EXPECT_EQ(ags.status() & ~reg::EOT::kMask, reg::kResetStatus0 & ~reg::EOT::kMask) << code;
      EXPECT_FALSE(slave.last_cdm()) << code;
      if (freqags == 0x7D) {
        EXPECT_EQ(slave.frames(), 0U) << code;
      } else {
        EXPECT_GE(slave.frames(), frames + (freqags == 0x31 ? 2U : 20U)) << code;
        EXPECT_LE(slave.frames(), frames + (freqags == 0x31 ? 3U : 35U)) << code;
      }
    }
  }
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x00);
  for (const unsigned code : {0b101U, 0b110U}) {
    chip.instruct(static_cast<std::uint8_t>(code << 1U));
    chip.advance_us(20);
    EXPECT_EQ(chip.read(reg::kAddrInstr), 0) << code;
    EXPECT_EQ(chip.status(), reg::kResetStatus0);
    EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().frames(), 0U);
  }
}

// Decision 30: without an enabled channel frames run under AGS without an error (request,
// acknowledge, start bit, CDS: five edges); ENSCD written meanwhile counts from the next frame on.
TEST(ChipAgs, NoChannelEnabled_FramesRunAndEnscdCountsFromTheNext) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x31);  // 50 us
  chip.write(reg::slave_cfg_address(1), {27});
  chip.instruct(reg::kAgsOn);
  chip.advance_us(220);
  EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nAGSERR::kMask | reg::nSCDERR::kMask),
            reg::kNerrGood | reg::kNagserrGood | reg::kNscderrGood);
  EXPECT_EQ(chip.simulator.slave(1)->frames(), 4U);
  EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now()).rising, 5U);
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), 0);
  chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 27});
  chip.advance_us(50);
  EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now()).rising, 39U);
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
  EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nAGSERR::kMask | reg::nSCDERR::kMask),
            reg::kNerrGood | reg::kNagserrGood | reg::kNscderrGood);
}

// Table 11: a slave of the chain whose channel is not enabled has no bits in the frame's length:
// the words of the channels that are enabled follow one another; SCDATA and SVALID of the others
// stay as they were.
TEST(ChipBanks, ChannelNotEnabled_ItsDataStay) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  // The sensor is channel 3 now; channels 1, 2 and 4 have lengths and CRCs but are not enabled.
  chip.write(reg::slave_cfg_address(1),
             {27, reg::kScrclenCrc6, 0, 0, 13, reg::kScrclenCrc5, 0, 0, reg::kEnscdYes | 27,
              reg::kScrclenCrc6, 0, 0, 63, reg::kScrclenCrc16, 0, 0});
  chip.write(reg::kAddrBankcfg, {reg::kSinglebankOneBank});
  std::vector<std::uint8_t> tx{reg::kSpiOpcodeWriteRegisters0};
  for (unsigned i = 0; i < 64; ++i) tx.push_back(static_cast<std::uint8_t>(0xC0 + i));
  chip.spi(tx);
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo, 2),
            (std::vector<std::uint8_t>{reg::SVALID<3>::kMask, 0}));
  const auto memory = chip.read(reg::kAddrScdata, 64);
  const std::vector<std::uint8_t> word{0xBF, 0x37, 0xAF, 0x0A, 0xD4, 0xD5, 0xD6, 0x18};
  for (unsigned i = 0; i < 64; ++i) {
    EXPECT_EQ(memory[i], i / 8 == 2 ? word[i % 8] : 0xC0 + i) << i;
  }
  EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now()).rising, 39U);
}

// Decision 8: BREAK never reads back 1, not even in the first read that can follow.
TEST(ChipBreak, ReadAtOnce_IsZero) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x1F, reg::kFreqagsAgsMin);
  chip.simulator.spi().set_timing(sim::SpiTiming::for_frequency(50'000'000));
  for (unsigned phase = 0; phase < 60; ++phase) {
    chip.instruct(reg::kInstrCdm0);
    chip.simulator.advance(phase * 1'700);
    chip.instruct(reg::kBreakAbort | reg::kAgsOn);
    EXPECT_EQ(chip.read(reg::kAddrInstr) & reg::BREAK::kMask, 0) << phase;
    chip.instruct(reg::kBreakAbort);
    chip.advance_us(200);
    EXPECT_EQ(chip.read(reg::kAddrInstr), 0);
  }
}

// Decision 19: AGS written while INIT runs is not lost, and INIT is not either.
TEST(ChipInit, AgsWrittenDuringInit_FramesFollow) {
  for (unsigned phase = 0; phase < 20; ++phase) {
    Chip chip(one_slave(kEncoder26, "delay_ns = 1000.0"));
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x31);
    chip.instruct(reg::kInitStart);
    chip.simulator.advance(phase * 100 * sim::kPsPerNs);
    chip.instruct(reg::kAgsOn);
    EXPECT_EQ(chip.read(reg::kAddrInstr) & reg::AGS::kMask, reg::kAgsOn);
    chip.advance_us(520);
    EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kAgsOn);
    EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nAGSERR::kMask | reg::nSCDERR::kMask),
              reg::kNerrGood | reg::kNagserrGood | reg::kNscderrGood);
    EXPECT_GE(chip.simulator.slave(1)->frames(), 9U) << phase;
    EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().frames(),
              chip.simulator.slave(1)->frames() + 1)
        << "and the INIT";
  }
}

// Decision 16: INIT writes the line delay to the bank that the host reads; the other bank keeps its
// byte.
TEST(ChipInit, LineDelay_IsInTheHostsBank) {
  for (const unsigned frames : {0U, 1U}) {
    Chip chip(one_slave(kEncoder26));
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
    for (unsigned i = 0; i < frames; ++i) {
      chip.instruct(reg::kInstrCdm0);
      ASSERT_TRUE(chip.wait_eot());
    }
    chip.write(reg::kAddrScdata, {0x5A});
    chip.instruct(reg::SWBANK::kMask);
    chip.advance_us(1);
    chip.write(reg::kAddrScdata, {0xA5, 0xA6});
    chip.instruct(reg::SWBANK::kMask | reg::kInitStart);
    ASSERT_TRUE(chip.wait_eot());
    EXPECT_EQ(chip.read(reg::kAddrScdata, 2), (std::vector<std::uint8_t>{1, 0xA6}));
    chip.instruct(0);
    chip.advance_us(1);
    EXPECT_EQ(chip.read(reg::kAddrScdata), 0x5A);
  }
}

// Decisions 19, 34: SWBANK in the middle of a frame swaps at once. Bytes that have come are in the
// one bank, the rest goes to the other; the word is valid in neither, although both held a valid
// one, and the frame ends with nSCDERR = 0.
TEST(ChipBanks, SwBankDuringAFrame_ActsAtOnce) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  for (int frame = 0; frame < 2; ++frame) {
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
    chip.advance_us(10);
  }
  using Bytes = std::vector<std::uint8_t>;
  const Bytes ones(8, 0x11);
  chip.spi({reg::kSpiOpcodeWriteRegisters0, 0x22, 0x22, 0x22, 0x22, 0x22, 0x22, 0x22, 0x22});
  chip.instruct(reg::SWBANK::kMask);
  chip.advance_us(1);
  chip.spi({reg::kSpiOpcodeWriteRegisters0, 0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0x11});
  chip.advance_us(1);
  ASSERT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
  chip.write(reg::kAddrFreq,
             {reg::FREQR::of(5) | reg::FREQS::of(31)});  // 62.5 kHz: the frame takes 600 us
  chip.instruct(reg::SWBANK::kMask | reg::kInstrCdm0);
  // 4 + 12 of 28 bits, 16 us each, after four periods: bytes 3 and 2 have come.
  chip.advance_us(345);
  EXPECT_EQ(chip.read(reg::kAddrScdata, 8), ones) << "the host's bank";
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
  chip.instruct(reg::kInstrCdm0);
  EXPECT_EQ(chip.status() & reg::EOT::kMask, 0) << "the frame still runs";
  EXPECT_EQ(chip.read(reg::kAddrScdata, 8),
            (Bytes{0x22, 0x22, 0xAF, 0x0A, 0x22, 0x22, 0x22, 0x22}));
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), 0);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.simulator.slave(1)->frames(), 3U);
  EXPECT_EQ(chip.status(), reg::kResetStatus0 & ~(reg::nERR::kMask | reg::nSCDERR::kMask))
      << "nERR = nSCDERR = 0";
  // Its end swaps again.
  EXPECT_EQ(chip.read(reg::kAddrScdata, 8),
            (Bytes{0xBF, 0x37, 0x11, 0x11, 0x11, 0x11, 0x11, 0x18}));
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), 0);
  chip.instruct(reg::SWBANK::kMask);
  chip.advance_us(1);
  EXPECT_EQ(chip.read(reg::kAddrScdata, 8),
            (Bytes{0x22, 0x22, 0xAF, 0x0A, 0x22, 0x22, 0x22, 0x22}));
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), 0);
  chip.advance_us(100);
  chip.instruct(reg::SWBANK::kMask | reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.status(), reg::kResetStatus0);
  EXPECT_EQ(chip.read(reg::kAddrScdata, 4), (Bytes{0xBF, 0x37, 0xAF, 0x0A}));
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
}

// Page 33, decision 34: SWBANK acts at once, HOLDBANK or not; a switch that HOLDBANK keeps back is
// not lost by it and still comes with the release.
TEST(ChipBanks, SwBankUnderHoldBank_SwapsAndThePendingSwitchStays) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  const auto expect = [&](std::uint8_t instruction, std::uint8_t byte, std::uint8_t svalid) {
    chip.instruct(instruction);
    ASSERT_TRUE(chip.wait_eot());
    EXPECT_EQ(chip.read(reg::scdata_address(2)), byte) << unsigned{instruction};
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo), svalid) << unsigned{instruction};
  };
  chip.write(reg::scdata_address(2), {0x11});
  expect(reg::SWBANK::kMask, 0x00, 0x00);
  chip.write(reg::scdata_address(2), {0x22});
  expect(reg::kHoldbankPrevented | reg::SWBANK::kMask, 0x22, 0x00);
  expect(reg::kHoldbankPrevented, 0x11, 0x00);
  expect(reg::kHoldbankPrevented | reg::SWBANK::kMask, 0x22, 0x00);
  expect(reg::kHoldbankPrevented | reg::SWBANK::kMask | reg::kInstrCdm0, 0x22,
         0x00);                                 // the frame's switch is kept back
  expect(reg::kHoldbankPrevented, 0x11, 0x02);  // its bank, by SWBANK
  expect(reg::kHoldbankPrevented | reg::SWBANK::kMask, 0x22, 0x00);
  expect(reg::SWBANK::kMask, 0x11, 0x02);  // released
  EXPECT_EQ(chip.status(), reg::kResetStatus0);
}

class Polynomial : public testing::TestWithParam<unsigned> {};

// Table 15: every SCRCPOLY stands for code & '1'; good words are valid, an inverted bit is not.
TEST_P(Polynomial, GoodWordsAreValidAndEveryInvertedBitIsFound) {
  const unsigned code = GetParam();
  const auto crc = mb4test::crc_choice(static_cast<std::uint8_t>(0x80 | code));
  ASSERT_EQ(crc.polynomial, 2 * code + 1);
  Chip chip(one_slave("data_bits = 9\nflag_bits = 0\ncrc = " + std::to_string(crc.polynomial)));
  chip.configure_slave1(9, static_cast<std::uint8_t>(reg::kSelcrcsByPolynomial | code), 0x00,
                        reg::kFreqagsAgsMin);
  for (unsigned bit = 0; bit <= 9 + crc.width; ++bit) {
    const std::uint64_t word = (bit * 167 + 1) & 0x1FF;
    chip.simulator.slave(1)->set_data(word);
    if (bit != 0) clocked(chip.simulator.line(1))->faults().flip_next_frame({1 + bit});
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo), bit == 0 ? reg::SVALID<1>::kMask : 0) << bit;
    EXPECT_EQ(chip.status() & reg::nSCDERR::kMask, bit == 0 ? reg::kNscderrGood : 0) << bit;
    if (bit != 0) continue;
    const auto line = mb4test::word_on_line(word, 9, crc, 0).substr(9);
    const auto stored = ~mb4test::from_bits(line) & ((1ULL << crc.width) - 1);
    EXPECT_EQ(chip.read(reg::SCDATA<1, 7>::kAddress), stored) << "reinverted, right aligned";
  }
}

INSTANTIATE_TEST_SUITE_P(Table15, Polynomial, testing::Range(1U, 0x80U));

}  // namespace
