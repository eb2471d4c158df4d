// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Status flags 0xF0..0xF3, 0xF8..0xFB and the pins EOT and NER: the events that set and clear
// each of them (pages 34..36, Tables 54, 55, 59..62, 64..67; decisions 8, 9, 20). The flags of
// control communication have tests of their own.
#include <gtest/gtest.h>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::one_slave;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

const char kEncoder26[] = "data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF\ntimeout = \"adaptive\"";

void frame(Chip& chip, std::uint8_t instruction = reg::kInstrCdm0) {
  chip.instruct(instruction);
  ASSERT_TRUE(chip.wait_eot());
}
// Bit 1 on the wire is CDS: a slave of this version sends 0.
void frame_with_cds(Chip& chip, unsigned line, std::uint8_t instruction = reg::kInstrCdm0) {
  clocked(chip.simulator.line(line))->faults().flip_next_frame({1});
  frame(chip, instruction);
}
void frame_with_wrong_crc(Chip& chip) {
  clocked(chip.simulator.line(1))->faults().flip_next_frame({7});
  frame(chip);
}
// Two lines with a sensor of 28 bits each: data channels 1 and 5.
std::string two_lines() {
  return one_slave(kEncoder26) +
         "[[channel]]\nnumber = 2\ndelay_ns = 60.0\n[[channel.slave]]\nprotocol = \"biss-c\"\n" +
         kEncoder26 + "\n";
}
void configure_two_lines(Chip& chip) {
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 27, reg::kScrclenCrc6, 0x00, 0x00});
  chip.write(reg::kAddrSlaveloc5,
             {reg::kResetSlaveloc5 | reg::kSlaveloc5Split, reg::kCfgch2BissC | reg::kCfgch1BissC});
}

// Table 54: nothing runs after a reset, and the pin says so from its first moment on.
TEST(ChipStatus, EotAfterReset_StaysHigh) {
  Chip chip(one_slave(kEncoder26));
  auto& simulator = chip.simulator;
  simulator.set_pin(sim::Pin::kNres, false);
  simulator.advance(500 * sim::kPsPerNs);
  EXPECT_TRUE(simulator.pin(sim::Pin::kEot));
  simulator.set_pin(sim::Pin::kNres, true);
  for (unsigned step = 0; step < 100; ++step) {
    simulator.advance(25 * sim::kPsPerNs);
    EXPECT_TRUE(simulator.pin(sim::Pin::kEot)) << step;
  }
}

// Table 54 and page 34: 0 from the instruction to the end of the frame, the pin with it.
TEST(ChipStatus, Eot_IsZeroDuringFramesAndInitAndEqualsThePin) {
  Chip chip(one_slave(kEncoder26));
  chip.simulator.spi().set_timing(sim::SpiTiming::for_frequency(50'000'000));
  chip.simulator.bus().set_timing({});
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x03, reg::kFreqagsAgsMin);
  for (const unsigned instruction : {reg::kInstrCdm0, reg::kInitStart}) {
    EXPECT_EQ(chip.status() & reg::EOT::kMask, reg::kEotIdle);
    EXPECT_TRUE(chip.simulator.pin(sim::Pin::kEot));
    chip.instruct(static_cast<std::uint8_t>(instruction));
    chip.simulator.advance(400 * sim::kPsPerNs);
    unsigned reads = 0;
    while (!chip.simulator.pin(sim::Pin::kEot)) {
      const std::uint8_t flag = chip.status() & reg::EOT::kMask;
      if (chip.simulator.pin(sim::Pin::kEot)) break;  // rose during the read
      EXPECT_EQ(flag, 0x00);
      ++reads;
      ASSERT_LT(reads, 1000U);
    }
    EXPECT_GT(reads, 3U);
    EXPECT_EQ(chip.status() & reg::EOT::kMask, reg::kEotIdle);
  }
}

// Table 55, decision 9: set by a wrong CRC; cleared by the next good frame, by INIT, by BREAK.
TEST(ChipStatus, Nscderr_WrongCrcSetsItGoodFrameInitAndBreakClearIt) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  for (const unsigned clear : {reg::kInstrCdm0, reg::kInitStart, reg::kBreakAbort}) {
    frame_with_wrong_crc(chip);
    EXPECT_EQ(chip.status(), reg::kResetStatus0 & ~(reg::nERR::kMask | reg::nSCDERR::kMask))
        << "nERR = nSCDERR = 0";
    EXPECT_FALSE(chip.simulator.pin(sim::Pin::kNer));
    chip.advance_us(10);
    EXPECT_EQ(chip.status(), reg::kResetStatus0 & ~(reg::nERR::kMask | reg::nSCDERR::kMask))
        << "stays until it is cleared";
    frame(chip, static_cast<std::uint8_t>(clear));
    EXPECT_EQ(chip.status(), reg::kResetStatus0) << "cleared by " << clear;
    EXPECT_TRUE(chip.simulator.pin(sim::Pin::kNer));
  }
}

// Table 59, page 32: set when a frame cannot start (SL low); cleared by INIT and by BREAK, not by
// the next good frame ("at least one").
TEST(ChipStatus, Nagserr_MissedFrameSetsItInitAndBreakClearIt) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x00);
  for (const unsigned clear : {reg::kInitStart, reg::kBreakAbort}) {
    clocked(chip.simulator.line(1))->faults().stick(false);
    chip.simulator.refresh_lines();
    chip.advance_us(1);
    frame(chip);
    EXPECT_EQ(chip.status(), reg::kResetStatus0 & ~(reg::nERR::kMask | reg::nAGSERR::kMask))
        << "nERR = nAGSERR = 0";
    EXPECT_FALSE(chip.simulator.pin(sim::Pin::kNer));
    clocked(chip.simulator.line(1))->faults().stick(std::nullopt);
    chip.simulator.refresh_lines();
    chip.advance_us(1);
    frame(chip);
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask) << "the next frame is tried";
    EXPECT_EQ(chip.status(), reg::kResetStatus0 & ~(reg::nERR::kMask | reg::nAGSERR::kMask));
    chip.advance_us(10);
    frame(chip, static_cast<std::uint8_t>(clear));
    EXPECT_EQ(chip.status(), reg::kResetStatus0) << "cleared by " << clear;
    EXPECT_TRUE(chip.simulator.pin(sim::Pin::kNer));
  }
}

// Table 60, page 34: NER is open drain: chip and outside can each pull it low. nERR shows the pin,
// and an error of another component touches no other flag.
TEST(ChipStatus, NerPin_InternalAndExternalErrorsAreWiredOr) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  for (const bool internal : {false, true}) {
    for (const bool external : {false, true}) {
      chip.simulator.set_pin(sim::Pin::kNer, !external);
      if (internal) {
        frame_with_wrong_crc(chip);
      } else {
        frame(chip);
      }
      const bool low = internal || external;
      EXPECT_EQ(chip.simulator.pin(sim::Pin::kNer), !low);
      EXPECT_EQ(chip.status(),
                (low ? 0x00 : 0x80) |
                    (internal ? reg::kResetStatus0 & ~(reg::nERR::kMask | reg::nSCDERR::kMask)
                              : reg::kResetStatus0 & ~reg::nERR::kMask));
    }
  }
  chip.simulator.set_pin(sim::Pin::kNer, true);
  EXPECT_FALSE(chip.simulator.pin(sim::Pin::kNer)) << "the chip still pulls";
  frame(chip);
  EXPECT_TRUE(chip.simulator.pin(sim::Pin::kNer));
}

// Table 61: each SVALIDx at its bit: a frame sets it, a wrong CRC of this slave alone clears it,
// and so does writing 0 to it alone.
TEST(ChipStatus, EverySvalid_HasItsOwnBit) {
  std::string text = "[host]\nsclk_hz = 20_000_000\n[[channel]]\nnumber = 1\n";
  for (int i = 0; i < 8; ++i) {
    text +=
        "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 4\nflag_bits = 0\n"
        "crc = 0x43\ndata = 9\n";
  }
  Chip chip(text);
  for (unsigned x = 0; x < 8; ++x) {
    chip.write(reg::slave_cfg_address(x + 1), {reg::kEnscdYes | 3, reg::kScrclenCrc6, 0x00, 0x00});
  }
  chip.write(reg::kAddrCtrl, {reg::kRegversBissC, reg::FREQR::of(5), 0, reg::kFreqagsAgsMin});
  chip.write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5, reg::kCfgch2Unused | reg::kCfgch1BissC});
  for (unsigned x = 0; x < 8; ++x) {
    const unsigned bit = 1U << (8 * (x / 4) + 2 * (x % 4) + 1);  // in F2:F1
    const auto flags = [&] {
      const auto bytes = chip.read(reg::kAddrSvalidLo, 2);
      return bytes[0] | (bytes[1] << 8U);
    };
    frame(chip);
    EXPECT_EQ(flags(), 0xAAAA);
    clocked(chip.simulator.line(1))->faults().flip_next_frame({2 + 10 * x + 5});
    frame(chip);
    EXPECT_EQ(flags(), 0xAAAA & ~bit) << "wrong CRC of slave " << x + 1;
    frame(chip);
    EXPECT_EQ(flags(), 0xAAAA);
    chip.write(reg::kAddrSvalidLo,
               {static_cast<std::uint8_t>(~bit & 0xFFU), static_cast<std::uint8_t>(~bit >> 8U)});
    chip.advance_us(1);
    EXPECT_EQ(flags(), 0xAAAA & ~bit) << "written";
  }
}

// Tables 65, 66: CDS of each line, CDSSEL of the line that CHSEL selects (00 means channel 1); they
// switch with the banks.
TEST(ChipStatus, CdsBits_FollowTheirLineAndChsel) {
  Chip chip(two_lines());
  configure_two_lines(chip);
  for (const unsigned chsel : {0U, 1U, 2U}) {
    chip.write(reg::kAddrChsel, {static_cast<std::uint8_t>(chsel)});
    for (unsigned pattern = 0; pattern < 4; ++pattern) {
      for (const unsigned line : {1U, 2U}) {
        if (((pattern >> (line - 1)) & 1U) != 0) {
          clocked(chip.simulator.line(line))->faults().flip_next_frame({1});
        }
      }
      frame(chip);
      const unsigned cds1 = pattern & 1U;
      const unsigned cds2 = pattern >> 1U;
      EXPECT_EQ(chip.read(reg::kAddrStatus8), 0x55 | (cds1 << 1U) | (cds2 << 3U));
      EXPECT_EQ(chip.read(reg::kAddrStatus3) & reg::CDSSEL::kMask, (chsel == 2 ? cds2 : cds1) << 6U)
          << chsel;
      EXPECT_EQ(chip.read(reg::kAddrSvalidLo, 2),
                (std::vector<std::uint8_t>{reg::SVALID<1>::kMask, reg::SVALID<5>::kMask}));
    }
  }
}

TEST(ChipStatus, CdsUnderHoldBank_SwitchesWithTheBank) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  frame(chip);
  frame_with_cds(chip, 1, 0x44);
  EXPECT_EQ(chip.read(reg::kAddrStatus8), 0x55);
  EXPECT_EQ(chip.read(reg::kAddrStatus3) & reg::CDSSEL::kMask, 0);
  chip.instruct(0);
  chip.advance_us(1);
  EXPECT_EQ(chip.read(reg::kAddrStatus8), 0x57);
  EXPECT_EQ(chip.read(reg::kAddrStatus3) & reg::CDSSEL::kMask, reg::kCdsselHigh);
  frame(chip);
  EXPECT_EQ(chip.read(reg::kAddrStatus8), 0x55);
}

// Table 49, page 35: CDS and CDSSEL belong to their bank. Each inversion of SWBANK shows those of
// the other one at once, also in the middle of a frame, whose CDS goes to the frame's bank.
TEST(ChipStatus, CdsUnderSwbank_SwitchesWithTheBank) {
  for (const unsigned line : {1U, 2U}) {
    Chip chip(two_lines());
    configure_two_lines(chip);
    chip.write(reg::kAddrChsel, {static_cast<std::uint8_t>(line)});
    const auto expect_cds = [&](bool high, const char* when) {
      EXPECT_EQ(chip.read(reg::kAddrStatus8), 0x55U | (high ? (line == 1 ? 0x02U : 0x08U) : 0U))
          << when << ", line " << line;
      EXPECT_EQ(chip.read(reg::kAddrStatus3) & reg::CDSSEL::kMask, high ? reg::kCdsselHigh : 0)
          << when << ", line " << line;
    };
    frame_with_cds(chip, line);
    expect_cds(true, "frame with CDS = 1");
    frame(chip);
    expect_cds(false, "frame with CDS = 0");
    std::uint8_t swbank = 0;
    for (int turn = 0; turn < 4; ++turn) {
      swbank ^= reg::SWBANK::kMask;
      chip.instruct(swbank);
      chip.advance_us(1);
      expect_cds(turn % 2 == 0, "SWBANK");
    }
    // The host has the bank of CDS = 0. After the inversion in the frame it has that of CDS = 1;
    // the frame ends in the other one, and the switch at its end shows its CDS.
    for (const bool high : {true, false}) {
      if (high) clocked(chip.simulator.line(line))->faults().flip_next_frame({1});
      chip.instruct(swbank | reg::kInstrCdm0);
      chip.advance_us(2);
      swbank ^= reg::SWBANK::kMask;
      chip.instruct(swbank | reg::kInstrCdm0);
      ASSERT_TRUE(chip.wait_eot());
      expect_cds(high, "SWBANK in a frame");
      chip.advance_us(10);
    }
  }
}

// Decision 14: a reduced frame changes only the CDS bits, at once. Under HOLDBANK the host's bank
// does not change; the CDS bits go to the other bank.
TEST(ChipStatus, CdsOfReducedFrames_ShowsAtOnceButNotUnderHoldBank) {
  for (const bool hold : {false, true}) {
    Chip chip(one_slave(kEncoder26));
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
    chip.write(reg::kAddrCtrl,
               {reg::kRegversBissC |
                reg::kHoldcdmHold});  // a command; HOLDCDM for frames that are not clocked out
    frame(chip);
    frame_with_cds(chip, 1, hold ? 0x4E : 0x0E);
    chip.advance_us(10);
    EXPECT_EQ(chip.read(reg::kAddrStatus3) & reg::CDSSEL::kMask, hold ? 0 : reg::kCdsselHigh);
    EXPECT_EQ(chip.read(reg::kAddrStatus8), hold ? 0x55 : 0x57);
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
    chip.instruct(hold ? reg::kHoldbankPrevented | reg::SWBANK::kMask : reg::SWBANK::kMask);
    chip.advance_us(1);
    EXPECT_EQ(chip.read(reg::kAddrStatus3) & reg::CDSSEL::kMask, hold ? reg::kCdsselHigh : 0)
        << "the other bank";
  }
}

// Table 62: set when HOLDBANK has kept a frame from switching; cleared by the next switch only.
TEST(ChipStatus, SwBankFail_PreventedSwitchSetsItTheNextSwitchClearsIt) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  frame(chip, 0x44);
  EXPECT_EQ(chip.read(reg::kAddrSwbankfail), 0) << "held back, not lost";
  frame(chip, 0x44);
  EXPECT_EQ(chip.read(reg::kAddrSwbankfail), reg::kSwbankfailFailed);
  frame(chip, reg::kInitStart | reg::kHoldbankPrevented);
  EXPECT_EQ(chip.status(), reg::kResetStatus0) << "INIT clears nAGSERR";
  EXPECT_EQ(chip.read(reg::kAddrSwbankfail), reg::kSwbankfailFailed) << "but not this flag";
  chip.instruct(0);
  chip.advance_us(1);
  EXPECT_EQ(chip.read(reg::kAddrSwbankfail), 0);
}

// Table 45, 011: CDM = NOT CDSSEL, one frame with AGS = 0; Table 23: on the selected line, 0 on the
// other. CDS comes before CDM in a frame, and a host that waits for a slave's start bit needs the
// answer in the frame that brings it: CDSSEL is the CDS of this frame (docs/choices.md).
TEST(ChipInstr, CdmNotCdssel_IsTheInverseOfTheCdsOfTheFrame) {
  for (const unsigned chsel : {0U, 1U, 2U, 3U}) {
    Chip chip(two_lines());
    configure_two_lines(chip);
    chip.write(reg::kAddrChsel, {static_cast<std::uint8_t>(chsel)});
    for (const bool cds : {true, false, false, true, true}) {
      const auto frames = chip.simulator.slave(1)->frames();
      if (cds) {
        frame_with_cds(chip, chsel == 2 ? 2 : 1, 0x06);
      } else {
        frame(chip, 0x06);
      }
      EXPECT_EQ(chip.read(reg::kAddrInstr), 0);
      EXPECT_EQ((chip.read(reg::kAddrStatus3) & reg::CDSSEL::kMask) != 0, cds) << "CDSSEL";
      chip.advance_us(10);
      EXPECT_EQ(chip.simulator.slave(1)->frames(), frames + 1);
      EXPECT_EQ(clocked(chip.simulator.slave(1))->last_cdm(), chsel != 2 && !cds) << chsel;
      EXPECT_EQ(clocked(chip.simulator.slave(5))->last_cdm(), chsel == 3 || (chsel == 2 && !cds))
          << chsel;
    }
  }
}

// Table 6: constants of the status block.
TEST(ChipStatus, ConstantBits_ReadAsPrinted) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  frame(chip);
  EXPECT_EQ(chip.read(reg::kAddrStatus0) & 0x02,
            reg::kResetStatus0 & ~(reg::nERR::kMask | reg::nAGSERR::kMask | reg::nDELAYERR::kMask |
                                   reg::nSCDERR::kMask | reg::nREGERR::kMask | reg::EOT::kMask));
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo, 2), (std::vector<std::uint8_t>{reg::SVALID<1>::kMask, 0}))
      << "even bits are 0";
  EXPECT_EQ(chip.read(reg::kAddrStatus8) & reg::kConstStatus8, 0x50);
  EXPECT_EQ(chip.read(reg::kAddrStatus9), 0x55);
}

}  // namespace
