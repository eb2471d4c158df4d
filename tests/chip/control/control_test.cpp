// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Control communication of BiSS C through the registers: pages 27..29, 32, 34, 35; decisions 12,
// 14, 20, 22..24, 31.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/registers/control_slave.hpp"
#include "tests/support/control_host.hpp"

namespace {

using mb4test::Chip;
using mb4test::ControlHost;
using mb4test::kAllGood;
using mb4test::one_slave;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

const char kEncoder[] = "data_bits = 14\ncrc = 0x43\ndata = 0x1ABC";

// `count` slaves of 14 bits on channel 1.
std::string chain(unsigned count) {
  std::string text = one_slave(kEncoder);
  for (unsigned i = 1; i < count; ++i) {
    text += "[[channel.slave]]\nprotocol = \"biss-c\"\n" + std::string(kEncoder) + "\n";
  }
  return text;
}
std::string two_channels() {
  return one_slave(kEncoder) +
         "[[channel]]\nnumber = 2\n[[channel.slave]]\nprotocol = \"biss-c\"\n" + kEncoder + "\n";
}
void configure(Chip& chip, unsigned slaves = 1, std::uint8_t freqs = 0x00,
               std::uint8_t freqags = reg::kFreqagsAgsMin) {
  for (unsigned i = 0; i < slaves; ++i) {
    chip.write(reg::slave_cfg_address(i + 1), {reg::kEnscdYes | 13, reg::kScrclenCrc6, 0x00, 0x00});
  }
  chip.write(reg::kAddrCtrl, {reg::kRegversBissC,
                              static_cast<std::uint8_t>(reg::FREQR::of(5) | freqs), 0, freqags});
  chip.write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5, reg::kCfgch2Unused | reg::kCfgch1BissC});
}
void configure_two(Chip& chip) {
  configure(chip);
  chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 13, reg::kScrclenCrc6, 0x00, 0x00});
  chip.write(reg::kAddrSlaveloc5,
             {reg::kResetSlaveloc5 | reg::kSlaveloc5Split, reg::kCfgch2BissC | reg::kCfgch1BissC});
}

TEST(Control, SixtyFourBytes_Take929FramesAndComeBack) {
  Chip chip(one_slave(kEncoder));
  configure(chip);
  ControlHost host(chip);
  std::vector<std::uint8_t> bytes(64);
  for (std::size_t i = 0; i < 64; ++i) bytes[i] = static_cast<std::uint8_t>(i * 37 + 11);
  host.set_write(0, 0x00, bytes);
  const unsigned frames = host.run_single(1000);
  EXPECT_EQ(frames, 929U);
  EXPECT_EQ(host.status(), kAllGood);
  EXPECT_EQ(host.regbytes(), 0U);
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_EQ(chip.simulator.slave(1)->reg_read(static_cast<std::uint8_t>(i)), bytes[i]) << i;
  }
  chip.spi(std::vector<std::uint8_t>(66, 0x80));                 // an unknown opcode, to be ignored
  host.set_write(0, 0x00, std::vector<std::uint8_t>(64, 0x00));  // RDATA = 0
  host.set_read(0, 0x00, 64);
  chip.instruct(reg::kBreakAbort);
  // The zeros of the last access count from its stop bit on: 2 of 14 have been sent.
  EXPECT_EQ(host.run_single(1000), 929U - 2U);
  EXPECT_EQ(host.rdata(64), bytes);
  std::printf("64 bytes: %u frames\n", frames);
}

// Decision 12.
TEST(Control, AddressPast0x7F_WrapsTo0x00) {
  Chip chip(one_slave(kEncoder));
  configure(chip);
  ControlHost host(chip);
  host.set_write(0, 0x7E, {0x11, 0x22, 0x33});
  ASSERT_NE(host.run_single(100), 0U);
  EXPECT_EQ(chip.simulator.slave(1)->reg_read(0x7E), 0x11);
  EXPECT_EQ(chip.simulator.slave(1)->reg_read(0x7F), 0x22);
  EXPECT_EQ(chip.simulator.slave(1)->reg_read(0x00), 0x33);
}

// Decision 23: with AGS = 1 one write is enough, INSTR reads 4 until the end; REGEND is 0 in the
// first status read. Position data stay valid in every frame.
TEST(Control, UnderAgs_OneWriteIsEnoughAndPositionsGoOn) {
  Chip chip(one_slave(kEncoder));
  configure(chip, 1, 0x00, 0x04);  // 5 us
  ControlHost host(chip);
  chip.simulator.slave(1)->reg_write(0x7E, 0x57);
  chip.simulator.slave(1)->reg_write(0x7F, 0x41);
  chip.instruct(reg::kAgsOn);
  chip.advance_us(100);
  for (int round = 0; round < 3; ++round) {
    host.set_read(0, 0x7E, 2);
    chip.instruct(reg::kInstrControl | reg::kAgsOn);
    const auto frames = chip.simulator.slave(1)->frames();
    EXPECT_EQ(host.status() & reg::REGEND::kMask, 0);
    EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kInstrControl | reg::kAgsOn);
    unsigned polls = 0;
    std::uint8_t f0 = 0;
    do {
      const auto rx = chip.spi({reg::kSpiOpcodeReadStatus, 0, 0});
      f0 = rx[1];
      EXPECT_EQ(f0 & (reg::nSCDERR::kMask | reg::nAGSERR::kMask | reg::nREGERR::kMask |
                      reg::nDELAYERR::kMask),
                0x78);
      EXPECT_EQ(rx[2], 0x02) << "SVALID1";
      ASSERT_LT(++polls, 1000U);
    } while ((f0 & reg::REGEND::kMask) == 0);
    chip.advance_us(1);
    EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kAgsOn);
    EXPECT_EQ(host.rdata(2), (std::vector<std::uint8_t>{0x57, 0x41}));
    // 33 + 14 frames and up to 14 zeros, one running frame, one until the poll has seen it.
    const auto used = chip.simulator.slave(1)->frames() - frames;
    EXPECT_GE(used, 47U);
    EXPECT_LE(used, 47U + 14U + 4U);
  }
}

// All CHSEL lines: the slave of channel 2, data channel 5. Page 27: registers of one channel at a
// time, so 11 is channel 1.
TEST(Control, Channel2_IsSelectedByChsel) {
  Chip chip(two_channels());
  configure_two(chip);
  ControlHost host(chip);
  chip.simulator.slave(1)->reg_write(0x10, 0x11);
  chip.simulator.slave(5)->reg_write(0x10, 0x55);
  for (const unsigned chsel : {0U, 1U, 2U, 3U}) {
    host.select(static_cast<std::uint8_t>(chsel));
    host.set_read(0, 0x10, 1);
    const auto starts =
        clocked(chip.simulator.slave(chsel == 2 ? 1 : 5))->control()->counters().starts;
    ASSERT_NE(host.run_single(60, reg::kInstrControl, chsel == 2 ? 2 : 1), 0U);
    EXPECT_EQ(host.status(), kAllGood);
    EXPECT_EQ(host.rdata(1)[0], chsel == 2 ? 0x55 : 0x11);
    EXPECT_EQ(clocked(chip.simulator.slave(chsel == 2 ? 1 : 5))->control()->counters().starts,
              starts)
        << "the other line sends CDM = 0";
  }
}

// IDs count from the far end: ID k is slave n - k.
TEST(Control, Chains_EverySlaveHasItsId) {
  for (unsigned count = 1; count <= 8; ++count) {
    Chip chip(chain(count));
    configure(chip, count);
    ControlHost host(chip);
    for (unsigned n = 1; n <= count; ++n) {
      chip.simulator.slave(n)->reg_write(0x33, static_cast<std::uint8_t>(0x10 * n));
    }
    for (unsigned id = 0; id < count; ++id) {
      host.set_read(id, 0x33, 1);
      ASSERT_TRUE(host.run_ags(2000)) << count << " " << id;
      EXPECT_EQ(host.status() & ~reg::EOT::kMask,
                (reg::kResetStatus0 & ~reg::EOT::kMask) | reg::kRegendDone)
          << count << " " << id;
      EXPECT_EQ(host.rdata(1)[0], 0x10 * (count - id));
    }
  }
}

// Decision 24, first half; page 34: "inverted R-bit". An ID that no slave has.
TEST(Control, MissingId_SetsNRegErr) {
  Chip chip(chain(2));
  configure(chip, 2);
  ControlHost host(chip);
  host.set_read(2, 0x33, 1);
  EXPECT_EQ(host.run_single(60), 14U + 18U) << "R echo is expected in slot 17";
  EXPECT_EQ(host.status(),
            (reg::kResetStatus0 | reg::kRegendDone) & ~reg::nREGERR::kMask & ~reg::nERR::kMask);
  EXPECT_FALSE(chip.simulator.pin(sim::Pin::kNer)) << "page 34: NER";
  EXPECT_EQ(host.regbytes(), 0U);
  host.set_write(2, 0x33, {0x12});
  EXPECT_EQ(host.run_single(60), 14U + 19U) << "W echo is expected in slot 18";
  EXPECT_EQ(host.status(),
            (reg::kResetStatus0 | reg::kRegendDone) & ~reg::nREGERR::kMask & ~reg::nERR::kMask);
  host.set_read(1, 0x33, 1);
  EXPECT_NE(host.run_single(60), 0U);
  EXPECT_EQ(host.status(), kAllGood) << "the next one clears the flag";
}

// Decision 24, second half; Table 58: a register that does not exist. 4096 x 2^(FREQR + 1) periods.
TEST(Control, MissingRegister_SetsNDelayErrAfterTheLimit) {
  for (const unsigned freqr : {0U, 1U, 5U}) {
    Chip chip(one_slave(kEncoder));
    configure(chip);
    chip.write(reg::kAddrFreq, {static_cast<std::uint8_t>(freqr << 5U)});
    sim::RegisterFile::Marks missing;
    missing[0x21] = true;
    chip.simulator.slave(1)->registers().set_missing(missing);
    ControlHost host(chip);
    host.set_read(0, 0x20, 2);
    const sim::Time start = chip.simulator.now();
    ASSERT_TRUE(host.run_ags(40000)) << freqr;
    const double us = static_cast<double>(chip.simulator.now() - start) / sim::kPsPerUs;
    const double limit = 4096.0 * (2U << freqr) * 0.1;
    EXPECT_GT(us, limit);
    EXPECT_LT(us, limit * 1.1 + 400) << "half a period a frame, and 46 frames before";
    EXPECT_EQ(host.status() & ~reg::EOT::kMask,
              ((reg::kResetStatus0 & ~reg::EOT::kMask) | reg::kRegendDone) &
                  ~reg::nDELAYERR::kMask & ~reg::nERR::kMask);
    EXPECT_EQ(host.regbytes(), 1U) << "Table 63: one byte was good";
    if (freqr == 0) {
      chip.instruct(reg::kInitStart);
      ASSERT_TRUE(chip.wait_eot());
      EXPECT_EQ(host.status(), reg::kResetStatus0) << "INIT";
      EXPECT_EQ(host.regbytes(), 0U) << "Table 63: INIT resets it";
    }
    std::printf("FREQR %u: nDELAYERR after %.0f us, limit %.0f us\n", freqr, us, limit);
    host.set_read(0, 0x20, 1);
    ASSERT_TRUE(host.run_ags(2000));
    EXPECT_EQ(host.status() & ~reg::EOT::kMask,
              (reg::kResetStatus0 & ~reg::EOT::kMask) | reg::kRegendDone);
    EXPECT_EQ(host.regbytes(), 0U) << "Table 63: so does a new control communication";
  }
}

// With AGS = 0 the limit can pass between two frames, but only a frame ends the access. Otherwise a
// host that has read REGEND = 0 just before would write INSTR again and begin a new access
// (decision 23).
TEST(Control, MissingRegisterWithoutFrames_EndsWithTheNextFrame) {
  Chip chip(one_slave(kEncoder));
  configure(chip);
  sim::RegisterFile::Marks missing;
  missing[0x20] = true;
  chip.simulator.slave(1)->registers().set_missing(missing);
  ControlHost host(chip);
  host.set_read(0, 0x20, 1);
  EXPECT_EQ(host.run_single(40), 0U);
  EXPECT_EQ(host.status() & reg::REGEND::kMask, 0);
  chip.advance_us(60000);
  EXPECT_EQ(host.status() & reg::REGEND::kMask, 0);
  EXPECT_EQ(host.run_single(2), 1U);
  EXPECT_EQ(host.status(),
            (reg::kResetStatus0 | reg::kRegendDone) & ~reg::nDELAYERR::kMask & ~reg::nERR::kMask);
  EXPECT_FALSE(chip.simulator.pin(sim::Pin::kNer)) << "page 34: NER";
  chip.instruct(reg::kBreakAbort);
  chip.advance_us(1);
  EXPECT_EQ(host.status(), reg::kResetStatus0) << "BREAK";
  EXPECT_TRUE(chip.simulator.pin(sim::Pin::kNer));
}

// The master repeats S as long as the slave is busy, and no data are lost, however long that takes.
TEST(Control, BusySlave_IsWaitedFor) {
  for (const unsigned busy : {1U, 2U, 13U, 14U, 100U}) {
    Chip chip(one_slave(std::string(kEncoder) + "\nread_busy_frames = " + std::to_string(busy) +
                        "\nwrite_busy_frames = " + std::to_string(busy)));
    configure(chip);
    ControlHost host(chip);
    host.set_write(0, 0x05, {0xA5, 0x5A});
    EXPECT_EQ(host.run_single(1000), 14U + 18U + 28U + 1U + 2U * busy);
    EXPECT_EQ(host.status(), kAllGood);
    host.set_read(0, 0x05, 2);
    EXPECT_EQ(host.run_single(1000), 12U + 18U + 28U + 1U + 2U * busy);
    EXPECT_EQ(host.rdata(2), (std::vector<std::uint8_t>{0xA5, 0x5A}));
  }
}

// BREAK and INIT end it: flags back, REGEND 0; the next access works.
TEST(Control, BreakAndInit_EndItAnywhere) {
  Chip chip(one_slave(kEncoder));
  configure(chip);
  ControlHost host(chip);
  chip.simulator.slave(1)->reg_write(0x31, 0x77);
  for (unsigned frames = 1; frames < 60; frames += 3) {
    for (const unsigned instruction : {reg::kBreakAbort, reg::kInitStart}) {
      host.set_read(0, 0x30, 2);
      EXPECT_EQ(host.run_single(frames), 0U);
      chip.instruct(static_cast<std::uint8_t>(instruction));
      ASSERT_TRUE(chip.wait_eot());
      EXPECT_EQ(host.status(), reg::kResetStatus0);
      EXPECT_EQ(host.regbytes(), 0U);
      EXPECT_EQ(chip.read(reg::kAddrInstr), 0);
      host.set_read(0, 0x31, 1);
      ASSERT_NE(host.run_single(60), 0U) << frames;
      EXPECT_EQ(host.status(), kAllGood) << frames;
      EXPECT_EQ(host.rdata(1)[0], 0x77);
    }
  }
}

// A host that reads positions with HOLDBANK writes 0xF4 meanwhile; the running control
// communication goes on with every frame.
TEST(Control, WritingInstrWithoutIt_DoesNotEndIt) {
  Chip chip(one_slave(kEncoder));
  configure(chip, 1, 0x00, 0x18);  // 25 us
  ControlHost host(chip);
  chip.simulator.slave(1)->reg_write(0x31, 0x77);
  host.set_read(0, 0x31, 1);
  chip.instruct(reg::kInstrControl | reg::kAgsOn);
  for (int i = 0; i < 30; ++i) {
    chip.advance_us(17);
    chip.instruct(reg::kHoldbankPrevented | reg::kAgsOn);
    chip.instruct(reg::kAgsOn);
  }
  chip.advance_us(2000);
  EXPECT_EQ(host.status() & ~reg::EOT::kMask,
            (reg::kResetStatus0 & ~reg::EOT::kMask) | reg::kRegendDone);
  EXPECT_EQ(host.rdata(1)[0], 0x77);
}

// Page 32: within a running control communication CDM is that of the access, whatever INSTR says;
// otherwise it is INSTR's.
TEST(Control, OtherInstrWithinAnAccess_CdmIsTheAccesssAndThenInstrs) {
  const auto run = [](Chip& chip, ControlHost& host, std::initializer_list<unsigned> codes) {
    configure(chip);
    chip.simulator.slave(1)->reg_write(0x31, 0x77);
    host.set_read(0, 0x31, 1);
    std::vector<bool> cdm;
    while (cdm.size() < 60 && (host.status() & reg::REGEND::kMask) == 0) {
      const unsigned code = cdm.empty() ? 0b100U : codes.begin()[cdm.size() % codes.size()];
      host.run_single(1, static_cast<std::uint8_t>(code << 1U));
      EXPECT_EQ(chip.read(reg::kAddrInstr), 0);
      cdm.push_back(host.cdm().at(0));
    }
    EXPECT_EQ(host.status(), kAllGood);
    EXPECT_EQ(host.rdata(1)[0], 0x77);
    return cdm;
  };
  Chip plain(one_slave(kEncoder));
  ControlHost plain_host(plain);
  const auto expected = run(plain, plain_host, {0b100});
  EXPECT_EQ(expected.size(), 14U + 18U + 15U);
  Chip chip(one_slave(kEncoder));
  ControlHost host(chip);
  EXPECT_EQ(run(chip, host, {0b001, 0b010, 0b011, 0b100, 0b001}), expected);
  for (const bool cdm : {true, false, true}) {
    host.run_single(1, cdm ? reg::kInstrCdm1 : reg::kInstrCdm0);
    EXPECT_EQ(host.cdm().at(0), cdm) << "behind it";
  }
}

TEST(Control, OtherInstrWithinAnAccessUnderAgs_CountsBehindIt) {
  for (const bool cdm : {true, false}) {
    Chip chip(one_slave(kEncoder));
    configure(chip, 1, 0x00, 0x18);  // 25 us
    ControlHost host(chip);
    chip.simulator.slave(1)->reg_write(0x31, 0x77);
    host.set_read(0, 0x31, 1);
    chip.instruct(reg::kInstrControl | reg::kAgsOn);
    chip.advance_us(40);
    chip.instruct(cdm ? reg::kInstrCdm1 | reg::kAgsOn : reg::kInstrCdm0 | reg::kAgsOn);
    sim::ClockedSlave& slave = *clocked(chip.simulator.slave(1));
    unsigned looks = 0;
    while ((host.status() & reg::REGEND::kMask) == 0) {
      ASSERT_LT(++looks, 300U);
      chip.advance_us(5);
    }
    EXPECT_EQ(host.status() & ~reg::EOT::kMask,
              (reg::kResetStatus0 & ~reg::EOT::kMask) | reg::kRegendDone);
    EXPECT_EQ(host.rdata(1)[0], 0x77);
    EXPECT_EQ(slave.control()->counters().starts, 1U);
    chip.advance_us(100);
    EXPECT_EQ(chip.read(reg::kAddrInstr),
              cdm ? reg::kInstrCdm1 | reg::kAgsOn : reg::kInstrCdm0 | reg::kAgsOn);
    for (unsigned frame = 0; frame < 5; ++frame) {
      chip.advance_us(25);
      EXPECT_EQ(slave.last_cdm(), cdm) << frame;
    }
  }
}

// Page 34: "In case of an error the transmission of data is terminated." The second of four bytes
// is disturbed on its way back; nothing follows, and CDM is 0 from then on.
TEST(Control, ErrorInTheSecondByte_TheOthersAreNotSent) {
  for (const bool reading : {false, true}) {
    Chip chip(one_slave(kEncoder));
    configure(chip, 1, 0x00, 0x13);  // 20 us
    ControlHost host(chip);
    sim::ClockedSlave& slave = *clocked(chip.simulator.slave(1));
    const std::vector<std::uint8_t> bytes{0x11, 0x22, 0x33, 0x44};
    const std::vector<std::uint8_t> before{0xE1, 0xE2, 0xE3, 0xE4};
    if (reading) {
      for (unsigned i = 0; i < 4; ++i) slave.reg_write(static_cast<std::uint8_t>(i), bytes[i]);
      chip.spi({reg::kSpiOpcodeWriteRegisters, reg::kAddrRdata, 0xE1, 0xE2, 0xE3, 0xE4});
      host.set_read(0, 0x00, 4);
    } else {
      host.set_write(0, 0x00, bytes);
    }
    // Slot 19 is S of the first byte, 33 of the second: bit D5 of it.
    slave.control()->faults().flip_cds_in_slot(36);
    const auto count = slave.cdm_count();
    chip.instruct(reg::kInstrControl | reg::kAgsOn);
    unsigned looks = 0;
    while ((host.status() & reg::REGEND::kMask) == 0) {
      ASSERT_LT(++looks, 500U);
      chip.advance_us(5);
    }
    // Up to slot 36 for an echo, to the second byte's CRC for a read; all four take up to slot 75.
    EXPECT_LE(slave.cdm_count() - count, 14U + 1U + (reading ? 46U : 37U));
    EXPECT_EQ(host.status() & (reg::nREGERR::kMask | reg::nDELAYERR::kMask), reg::nDELAYERR::kMask);
    EXPECT_EQ(host.regbytes(), 1U);
    for (unsigned frame = 0; frame < 40; ++frame) {
      chip.advance_us(20);
      EXPECT_FALSE(slave.last_cdm()) << frame;
    }
    EXPECT_EQ(slave.control()->counters().starts, 1U);
    EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kAgsOn);
    if (reading) {
      EXPECT_EQ(host.rdata(4), (std::vector<std::uint8_t>{0x11, 0xE2, 0xE3, 0xE4})) << "page 28";
    } else {
      EXPECT_EQ(slave.reg_read(0), 0x11);
      for (unsigned i = 1; i < 4; ++i) EXPECT_EQ(slave.reg_read(static_cast<std::uint8_t>(i)), 0);
    }
  }
}

// Page 27: with HOLDCDM = 1 control communication works "even if the master is not configured
// according to the data channel(s) of the connected BiSS slave(s)". Without it SL = 1 after the
// clocks looks as if the slave's timeout were over, and MA returns to 1 too early for a CDM of 1.
TEST(Control, HoldCdm_WorksWithAWrongOrAbsentDataChannel) {
  // ENSCD, SCDLEN; no CRC: no channel at all, bits that are too few and too many.
  for (const unsigned channel : {0x00U, 0x40U | 4U, 0x40U | 39U}) {
    for (const bool ags : {false, true}) {
      for (const bool hold : {true, false}) {
        Chip chip(one_slave("data_bits = 14\ncrc = 0x43\ndata = 0x3FFF\ntimeout = 5.0"));
        configure(chip, 1, 0x00, ags ? 0x31 : 0x00);  // 50 us
        chip.write(reg::slave_cfg_address(1), {static_cast<std::uint8_t>(channel), 0});
        ControlHost host(chip);
        chip.simulator.slave(1)->reg_write(0x31, 0x77);
        host.set_read(0, 0x31, 1);
        chip.write(reg::kAddrCtrl,
                   {static_cast<std::uint8_t>(
                       hold ? reg::kCtsRegisterAccess | reg::kRegversBissC | reg::kHoldcdmHold
                            : reg::kCtsRegisterAccess | reg::kRegversBissC)});
        bool ended = false;
        if (ags) {
          ended = host.run_ags(10'000);
        } else {
          for (unsigned frame = 0; frame < 60 && !ended; ++frame) {
            chip.instruct(reg::kInstrControl);
            ASSERT_TRUE(chip.wait_eot());
            ended = (host.status() & reg::REGEND::kMask) != 0;
            chip.advance_us(20);
          }
        }
        const bool good =
            ended &&
            (host.status() & (reg::REGEND::kMask | reg::nREGERR::kMask | reg::nDELAYERR::kMask)) ==
                (reg::REGEND::kMask | reg::nREGERR::kMask | reg::nDELAYERR::kMask);
        // Frames that are clocked out, or longer: SL is 0 after them, and HOLDCDM makes no
        // difference.
        EXPECT_EQ(good, hold || channel == (0x40U | 39U)) << channel << " " << ags;
        if (good) {
          EXPECT_EQ(host.rdata(1)[0], 0x77) << channel << " " << ags;
        }
      }
    }
  }
}

// ---- commands ---------------------------------------------------------------------------------

// Headers of commands worked out by hand (page 29; rule of the CRC: docs/theory.md): CTS, IDS0..7,
// CMD1..0 and the inverted CRC.
TEST(Command, Headers_AreAsWorkedOut) {
  struct Row {
    std::uint8_t ids;
    unsigned code;
    unsigned ncrc;
  };
  for (const Row row :
       {Row{0x00, 0, 0xF}, Row{0x00, 1, 0xC}, Row{0x00, 2, 0x9}, Row{0x80, 0, 0x2},
        Row{0x40, 0, 0x0}, Row{0xC0, 0, 0xD}, Row{0x01, 0, 0x3}, Row{0x80, 1, 0x1}}) {
    Chip chip(chain(2));
    configure(chip, 2);
    ControlHost host(chip);
    host.set_command(row.ids, row.code);
    const unsigned frames = host.run_single(60);
    // Broadcast: up to P in slot 17. Addressed: up to the last acknowledge in slot 24.
    ASSERT_EQ(frames, row.ids == 0 ? 14U + 18U : 14U + 25U);
    std::uint32_t sent = 0;
    for (std::size_t slot = 1; slot <= 17; ++slot)
      sent = sent << 1U | (host.cdm()[14 + slot] ? 1U : 0U);
    const std::uint32_t header = static_cast<std::uint32_t>(row.ids) << 2U | row.code;
    EXPECT_EQ(sent, ((header << 4U | row.ncrc) << 2U) | 2U) << "EX = 1 in slot 16, P = 0";
  }
}

TEST(Command, Broadcast_ReachesAllWithoutAcknowledge) {
  Chip chip(chain(3));
  configure(chip, 3);
  ControlHost host(chip);
  host.set_command(0x00, 2);
  ASSERT_TRUE(host.run_ags(2000));
  EXPECT_EQ(host.status() & ~reg::EOT::kMask,
            (reg::kResetStatus0 & ~reg::EOT::kMask) | reg::kRegendDone);
  for (unsigned n = 1; n <= 3; ++n) {
    EXPECT_EQ(clocked(chip.simulator.slave(n))->control()->counters().commands, 1U);
    EXPECT_EQ(clocked(chip.simulator.slave(n))->control()->last_command().code, 2);
  }
}

TEST(Command, Addressed_ReachesThoseAndIsAcknowledged) {
  for (const bool tested : {false, true}) {
    Chip chip(chain(3));
    configure(chip, 3);
    ControlHost host(chip);
    host.set_command(0x80 | 0x20, 3, tested);  // IDs 0 and 2: slaves 3 and 1
    EXPECT_EQ(host.run_single(60), tested ? 14U + 26U : 14U + 25U);
    EXPECT_EQ(host.status(), kAllGood) << tested;
    EXPECT_EQ(clocked(chip.simulator.slave(1))->control()->counters().commands, 1U);
    EXPECT_EQ(clocked(chip.simulator.slave(2))->control()->counters().commands, 0U);
    EXPECT_EQ(clocked(chip.simulator.slave(3))->control()->counters().commands, 1U);
  }
}

// Table 34: the command is not executed if the test fails; without the test it is.
TEST(Command, MissingId_IsExecutedOnlyWithoutTheTest) {
  for (const bool tested : {false, true}) {
    Chip chip(chain(2));
    configure(chip, 2);
    ControlHost host(chip);
    host.set_command(0x80 | 0x04, 3, tested);  // no slave has ID 5
    ASSERT_NE(host.run_single(60), 0U);
    EXPECT_EQ(host.status(),
              (reg::kResetStatus0 | reg::kRegendDone) & ~reg::nREGERR::kMask & ~reg::nERR::kMask);
    EXPECT_EQ(clocked(chip.simulator.slave(2))->control()->counters().commands, tested ? 0U : 1U);
  }
}

// Decision 5: the other reading of the datasheets.
TEST(Command, IdaTestInvertQuirk_SwapsThePolarity) {
  for (const bool invert : {false, true}) {
    for (const bool ida_test : {false, true}) {
      Chip chip(one_slave(kEncoder, "", invert ? "quirks = { IDA_TEST_INVERT = true }" : ""));
      configure(chip);
      ControlHost host(chip);
      const bool tested = ida_test != invert;
      host.set_command(0x80, 3, ida_test);
      EXPECT_EQ(host.run_single(60), tested ? 14U + 26U : 14U + 25U) << invert << ida_test;
      EXPECT_EQ(host.status(), kAllGood);
      EXPECT_EQ(clocked(chip.simulator.slave(1))->control()->counters().commands, 1U);
      host.set_command(0x80 | 0x04, 3, ida_test);  // no slave has ID 5
      ASSERT_NE(host.run_single(60), 0U);
      EXPECT_EQ(host.status(),
                (reg::kResetStatus0 | reg::kRegendDone) & ~reg::nREGERR::kMask & ~reg::nERR::kMask);
      EXPECT_EQ(clocked(chip.simulator.slave(1))->control()->counters().commands, tested ? 1U : 2U);
    }
  }
}

// Page 27: commands on both channels at once; each channel tests its own acknowledge.
TEST(Command, BothChannels_GetIt) {
  for (const unsigned silent : {1U, 5U}) {
    Chip chip(two_channels());
    configure_two(chip);
    ControlHost host(chip);
    host.select(3);
    host.set_command(0x80, 3, true);
    ASSERT_NE(host.run_single(60), 0U);
    EXPECT_EQ(host.status(), kAllGood);
    for (const unsigned slave : {1U, 5U}) {
      EXPECT_EQ(clocked(chip.simulator.slave(slave))->control()->counters().commands, 1U) << slave;
      EXPECT_EQ(clocked(chip.simulator.slave(slave))->control()->last_command().code, 3) << slave;
    }
    clocked(chip.simulator.slave(silent))->control()->faults().set_silent(true);
    ASSERT_NE(host.run_single(60), 0U);
    EXPECT_EQ(host.status(),
              (reg::kResetStatus0 | reg::kRegendDone) & ~reg::nREGERR::kMask & ~reg::nERR::kMask)
        << "silent: slave " << silent;
    EXPECT_EQ(clocked(chip.simulator.slave(6 - silent))->control()->counters().commands, 2U)
        << silent;
    EXPECT_EQ(clocked(chip.simulator.slave(silent))->control()->counters().commands, 1U) << silent;
  }
}

// INSTR = 111 (decision 14): Ack, start, CDS, then the clock stops with the CDM level. HOLDCDM as
// page 27 asks for frames that are not clocked out. SCDATA and SVALID stay.
TEST(Command, ReducedFrames_CarryItAndLeaveSensorData) {
  Chip chip(one_slave(std::string(kEncoder) + "\ntimeout = 5.0"));
  configure(chip, 1, 0x00, 0x13);  // 20 us
  ControlHost host(chip);
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  const auto before = chip.read(reg::kAddrScdata, 8);
  ASSERT_EQ(before[0], 0xBC);
  ASSERT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
  chip.simulator.slave(1)->set_data(0x2FFF);
  host.set_command(0x80, 3, true);
  chip.write(reg::kAddrCtrl, {reg::kRegversBissC | 3U << 4U | 8U | 1U});
  chip.instruct(reg::kInstrControlReduced | reg::kAgsOn);
  chip.advance_us(100);
  unsigned looks = 0;
  for (;; ++looks) {
    ASSERT_LT(looks, 200U) << "it never ends";
    const auto now = chip.read(reg::kAddrScdata, 8);
    const auto svalid = chip.read(reg::kAddrSvalidLo);
    const auto rising =
        clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now()).rising;
    const auto commands = clocked(chip.simulator.slave(1))->control()->counters().commands;
    const bool regend = (host.status() & reg::REGEND::kMask) != 0;
    // While INSTR is 111, only reduced frames have run, so the values above must not have changed.
    if (chip.read(reg::kAddrInstr) != 0x0F) break;
    EXPECT_EQ(now, before) << looks;
    EXPECT_EQ(svalid, 0x02) << looks;
    EXPECT_EQ(rising, 5U) << looks;
    EXPECT_FALSE(regend) << looks;
    EXPECT_EQ(commands, 0U) << looks;
  }
  EXPECT_GT(looks, 10U);
  EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kAgsOn);
  chip.advance_us(50);
  EXPECT_EQ(chip.read(reg::kAddrScdata, 2), (std::vector<std::uint8_t>{0xFF, 0x2F}))
      << "whole frames again";
  chip.instruct(0);
  chip.advance_us(50);
  EXPECT_EQ(host.status(), kAllGood);
  EXPECT_EQ(clocked(chip.simulator.slave(1))->control()->counters().commands, 1U);
  EXPECT_EQ(clocked(chip.simulator.slave(1))->control()->last_command().ids, 0x80);
  EXPECT_EQ(clocked(chip.simulator.slave(1))->control()->last_command().code, 3);
}

TEST(Command, ReducedFramesWithoutAgs_LeaveBothBanks) {
  Chip chip(one_slave(std::string(kEncoder) + "\ntimeout = 5.0"));
  configure(chip);
  ControlHost host(chip);
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  const auto other = chip.read(reg::kAddrScdata, 8);
  chip.simulator.slave(1)->set_data(0x0123);
  chip.advance_us(10);
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  const auto before = chip.read(reg::kAddrScdata, 8);
  ASSERT_NE(before, other);
  chip.advance_us(10);
  chip.simulator.slave(1)->set_data(0x2FFF);
  host.set_command(0x80, 3);
  chip.write(reg::kAddrCtrl, {reg::kRegversBissC | 3U << 4U | 1U});
  // Two zeros were sent before: S is in frame 12, the last acknowledge in frame 36.
  for (int frame = 0; frame < 37; ++frame) {
    chip.instruct(reg::kInstrControlReduced);
    ASSERT_TRUE(chip.wait_eot());
    EXPECT_EQ(chip.read(reg::kAddrInstr), 0) << frame;
    EXPECT_EQ(host.status() & reg::REGEND::kMask, frame == 36 ? reg::REGEND::kMask : 0) << frame;
    chip.advance_us(10);
    EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now()).rising, 5U)
        << frame;
    EXPECT_EQ(chip.read(reg::kAddrScdata, 8), before);
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
    // The lone slave locks ID 0 in slot 1 and acknowledges in slot 17.
    EXPECT_EQ(chip.read(reg::kAddrStatus3) & reg::CDSSEL::kMask,
              frame == 13 || frame == 29 ? reg::kCdsselHigh : 0)
        << frame;
    // Executed at once: EX is in slot 16, its stop bit in slot 17.
    EXPECT_EQ(clocked(chip.simulator.slave(1))->control()->counters().commands,
              frame < 29 ? 0U : 1U);
  }
  EXPECT_EQ(host.status(), kAllGood);
  EXPECT_EQ(clocked(chip.simulator.slave(1))->control()->last_command().ids, 0x80);
  EXPECT_EQ(clocked(chip.simulator.slave(1))->control()->last_command().code, 3);
  chip.instruct(reg::SWBANK::kMask);
  chip.advance_us(1);
  EXPECT_EQ(chip.read(reg::kAddrScdata, 8), other);
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
}

// ---- by hand ----------------------------------------------------------------------------------

// A CDM that depends on CDS also arrives over a long line and with the shortest frame.
TEST(ControlByHand, CdmByCds_ComesRightAtAnyDelay) {
  for (const char* delay : {"0.0", "30.0", "250.0", "1900.0"}) {
    for (const unsigned cds : {0U, 1U}) {
      for (const bool sensor : {false, true}) {
        Chip chip(one_slave(std::string(kEncoder) + "\ntimeout = 12.5",
                            std::string("delay_ns = ") + delay));
        configure(chip);
        if (!sensor) {
          chip.write(reg::slave_cfg_address(1), {0});
          chip.write(reg::kAddrCtrl, {reg::kRegversBissC |
                                      reg::kHoldcdmHold});  // HOLDCDM: the frame is not clocked out
        }
        if (cds == 1) clocked(chip.simulator.line(1))->faults().flip_next_frame({1});
        const auto count = clocked(chip.simulator.slave(1))->cdm_count();
        chip.instruct(reg::kInstrCdmNotCdssel);
        ASSERT_TRUE(chip.wait_eot());
        chip.advance_us(40);
        EXPECT_EQ(clocked(chip.simulator.slave(1))->cdm_count(), count + 1);
        EXPECT_EQ(clocked(chip.simulator.slave(1))->last_cdm(), cds == 0) << delay << " " << sensor;
      }
    }
  }
}

}  // namespace
