// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Control communication that cannot run, cannot start, or whose settings change while it runs:
// decisions 37, 38, 42 and 43, pages 27, 28, 34.
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bits.hpp"
#include "chip_fixture.hpp"
#include "mb4/fields.hpp"
#include "reference.hpp"

namespace {

using mb4ref::Protocol;
using mb4test::Chip;
using mb4test::one_slave;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

const std::string kSlave = "data_bits = 26\ncrc = 0x43\ndata = 0x0AAAAAA\n";


// One slave on each line, of the protocol of the line.
std::string two_lines(Protocol first, Protocol second, const std::string& keys = "") {
  const std::array<const char*, 3> names{"biss-b", "biss-c", "ssi"};
  std::string text = "[host]\nsclk_hz = 20_000_000\n";
  unsigned number = 1;
  for (const Protocol protocol : {first, second}) {
    text += "[[channel]]\nnumber = " + std::to_string(number++) +
            "\n[[channel.slave]]\nprotocol = \"" + names[static_cast<unsigned>(protocol)] +
            "\"\ndata_bits = 26\ndata = 0x0AAAAAA\n";
    text += protocol == Protocol::kSsi
                ? "timeout = 1.0\n"
                : "crc = 0x43\ntimeout = 1.0\nregisters = { 0x20 = [0x5A] }\n";
    if (protocol == Protocol::kBissB) text += "register_timeout = 0.8\n";
    text += keys;
  }
  return text;
}

constexpr unsigned code_of(std::optional<Protocol> protocol) {
  return !protocol ? 3U : static_cast<unsigned>(*protocol);  // Table 8
}

// Every combination of CFGCH, SLAVELOC5, REGVERS, CHSEL, CTS, INSTR 100 or 111, AGS: the access
// ends at once exactly where the reference says that no line fits, with REGEND = 1, nREGERR = 0,
// REGBYTES = 0 and INSTR = 000, and elsewhere it does not.
TEST(ChipAccess, NoLineThatFits_EndsAtOnceWithAnError) {
  const std::array<std::optional<Protocol>, 4> kinds{Protocol::kBissB, Protocol::kBissC,
                                                     Protocol::kSsi, std::nullopt};
  unsigned in_vain = 0, runs = 0;
  for (const auto& first : kinds) {
    for (const auto& second : kinds) {
      Chip chip(two_lines(first.value_or(Protocol::kBissC), second.value_or(Protocol::kBissC)));
      chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 25, reg::kScrclenCrc6, 0x00, 0x00});
      chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 25, reg::kScrclenCrc6, 0x00, 0x00});
      chip.write(reg::kAddrFreq, {reg::FREQR::of(5), 0, reg::kFreqagsAgsMin});
      chip.advance_us(10);
      for (unsigned setting = 0; setting < 128; ++setting) {
        const bool slaveloc5 = (setting & 1U) != 0, regvers = (setting & 2U) != 0;
        const unsigned chsel = (setting >> 2U) & 3U;
        const bool cts = (setting & 16U) != 0, ags = (setting & 32U) != 0;
        const unsigned instr = (setting & 64U) != 0 ? 7 : 4;
        chip.instruct(reg::kBreakAbort);
        chip.advance_us(50);
        chip.write(reg::kAddrRegadr,
                   {0x20, 0x00, static_cast<std::uint8_t>(chsel),
                    static_cast<std::uint8_t>((cts ? reg::kCtsRegisterAccess : 0) |
                                              (regvers ? reg::kRegversBissC : 0))});
        chip.write(
            reg::kAddrSlaveloc5,
            {static_cast<std::uint8_t>(slaveloc5 ? reg::kResetSlaveloc5 | reg::kSlaveloc5Split
                                                 : reg::kResetSlaveloc5),
             static_cast<std::uint8_t>(code_of(second) << 2U | code_of(first))});
        const unsigned lines = mb4ref::Reference::access_lines(
            {first, slaveloc5 ? second : std::nullopt}, regvers, chsel, cts);
        chip.instruct(static_cast<std::uint8_t>(instr << 1U | (ags ? 1U : 0U)));
        chip.advance_us(ags ? 20 : 2);
        const unsigned status = chip.status();
        const unsigned left = chip.read(reg::kAddrInstr) & reg::INSTR::kMask;
        const std::string what = "CFGCH " + std::to_string(code_of(first)) + " " +
                                 std::to_string(code_of(second)) + ", setting " +
                                 std::to_string(setting);
        if (lines == 0) {
          ++in_vain;
          ASSERT_EQ(status & (reg::nERR::kMask | reg::nREGERR::kMask | reg::REGEND::kMask),
                    reg::REGEND::kMask)
              << what;
          ASSERT_EQ(left, 0x00U) << what;
          ASSERT_EQ(chip.read(reg::kAddrStatus3) & reg::REGBYTES::kMask, 0) << what;
        } else {
          ++runs;
          ASSERT_EQ(status & (reg::nREGERR::kMask | reg::REGEND::kMask), reg::nREGERR::kMask)
              << what;
        }
      }
    }
  }
  EXPECT_GT(in_vain, 500U);
  EXPECT_GT(runs, 300U);
}

// Table 63: REGBYTES are those of the access that failed, whatever the host configures behind it;
// those of an earlier one are not shown by an access that cannot run.
TEST(ChipAccess, RegBytes_AreThoseOfTheAccessThatFailed) {
  Chip chip(two_lines(Protocol::kBissB, Protocol::kBissC, "missing = [0x23, 0x35]\n"));
  chip.write(reg::kAddrFreq, {0, 0, reg::kFreqagsAgsMin});
  chip.write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5 | reg::kSlaveloc5Split,
                                   reg::kCfgch2BissC});  // line 1 BiSS B, line 2 BiSS C
  // Reads `count` bytes over the line, at a FREQAGS that suits both.
  const auto read = [&](unsigned line, unsigned address, unsigned count) {
    chip.write(
        reg::kAddrRegadr,
        {static_cast<std::uint8_t>(address), static_cast<std::uint8_t>(count - 1),
         static_cast<std::uint8_t>(line),
         static_cast<std::uint8_t>(line == 1 ? reg::kCtsRegisterAccess
                                             : reg::kCtsRegisterAccess | reg::kRegversBissC)});
    chip.instruct(reg::kInstrControl | reg::kAgsOn);
    for (unsigned i = 0; i < 400 && (chip.read(reg::kAddrInstr) & reg::INSTR::kMask) != 0; ++i)
      chip.advance_us(100);
    chip.instruct(0);  // the running frame ends
    chip.advance_us(100);
    return chip.status() & (reg::nDELAYERR::kMask | reg::nREGERR::kMask | reg::REGEND::kMask);
  };
  const auto reg_bytes = [&] { return chip.read(reg::kAddrStatus3) & reg::REGBYTES::kMask; };
  unsigned turn = 0;
  for (const unsigned line : {1U, 2U, 1U}) {
    const std::string what = "turn " + std::to_string(++turn) + ", line " + std::to_string(line);
    const unsigned start = line == 1 ? 0x21 : 0x31;
    EXPECT_EQ(read(line, start, 6), 0x0CU) << what << ": nDELAYERR = 0";
    EXPECT_EQ(reg_bytes(), line == 1 ? 2U : 4U) << what;
    chip.write(reg::kAddrCtrl,
               {static_cast<std::uint8_t>(line == 1 ? reg::kCtsRegisterAccess | reg::kRegversBissC
                                                    : reg::kCtsRegisterAccess)});
    chip.advance_us(2);
    EXPECT_EQ(reg_bytes(), line == 1 ? 2U : 4U) << what << ", REGVERS of the next access";
    EXPECT_EQ(read(line, 0x40, 3), 0x2CU) << what;
    EXPECT_EQ(reg_bytes(), 0U) << what << ": no error";
    // The line is not one of this REGVERS.
    chip.write(reg::kAddrChsel, {static_cast<std::uint8_t>(3 - line)});
    chip.instruct(reg::kInstrControl);
    chip.advance_us(2);
    EXPECT_EQ(chip.status() & (reg::nREGERR::kMask | reg::REGEND::kMask), reg::kRegendDone)
        << what << ": nREGERR = 0";
    EXPECT_EQ(reg_bytes(), 0U) << what << ": none of this access";
  }
}

// Decisions 4, 19, 37: an INSTR that cannot run is taken behind the running frame. MA is forced to
// 1, so this frame hangs until the force bits are cleared.
TEST(ChipAccess, InVainDuringAFrameThatHangs_EndsBehindIt) {
  for (const unsigned ags : {0U, 1U}) {
    Chip chip(one_slave(kSlave, "", "", "sclk_hz = 20_000_000"));
    chip.configure_slave1(26, reg::kScrclenCrc6, 0x04, reg::kFreqagsAgsMin);
    chip.write(reg::kAddrChsel,
               {reg::kChsel1Used, reg::kCtsRegisterAccess});  // line 1 is BiSS C, REGVERS of BiSS B
    chip.write(reg::kAddrIface, {reg::kMavsHigh | reg::kMafsForced});
    chip.advance_us(10);
    chip.instruct(static_cast<std::uint8_t>(reg::kInstrCdm0 | ags));
    chip.advance_us(100);
    chip.instruct(static_cast<std::uint8_t>(reg::kInstrControl | ags));
    chip.advance_us(20'000);
    EXPECT_EQ(chip.status() & (reg::REGEND::kMask | reg::EOT::kMask), 0U) << ags;
    EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kInstrControl | ags) << ags;
    chip.write(reg::kAddrIface, {0});
    chip.advance_us(200);
    EXPECT_EQ(chip.status() & (reg::nREGERR::kMask | reg::REGEND::kMask), reg::REGEND::kMask)
        << ags;
    EXPECT_EQ(chip.read(reg::kAddrInstr), ags) << ags;
  }
}

// After a good access one that cannot run is no success, and its data stay those of the good one.
TEST(ChipAccess, InVainAfterASuccess_IsAnErrorAndKeepsRdata) {
  Chip chip(one_slave(kSlave + "registers = { 0x20 = [0x5A] }", "", "", "sclk_hz = 20_000_000"));
  chip.configure_slave1(26, reg::kScrclenCrc6, 0x04, reg::kFreqagsAgsMin);
  chip.write(reg::kAddrRegadr, {0x20, 0x00, 0, reg::kCtsRegisterAccess | reg::kRegversBissC});
  chip.instruct(reg::kInstrControl | reg::kAgsOn);
  chip.advance_us(4000);
  ASSERT_EQ(chip.status() & (reg::nREGERR::kMask | reg::REGEND::kMask),
            reg::nREGERR::kMask | reg::REGEND::kMask);
  ASSERT_EQ(chip.read(reg::kAddrRdata), 0x5A);
  chip.instruct(reg::kBreakAbort);
  chip.advance_us(50);
  chip.write(reg::kAddrRegadr, {0x21});
  chip.write(reg::kAddrCtrl, {reg::kCtsRegisterAccess});
  chip.instruct(reg::kInstrControl);
  EXPECT_EQ(chip.status() & (reg::nREGERR::kMask | reg::REGEND::kMask | reg::EOT::kMask),
            reg::REGEND::kMask | reg::EOT::kMask)
      << "the first read";
  EXPECT_EQ(chip.read(reg::kAddrRdata), 0x5A);
  // And the way back: the next access that can run does.
  chip.write(reg::kAddrCtrl, {reg::kCtsRegisterAccess | reg::kRegversBissC});
  chip.instruct(reg::kInstrControl | reg::kAgsOn);
  chip.advance_us(4000);
  EXPECT_EQ(chip.status() & (reg::nREGERR::kMask | reg::REGEND::kMask),
            reg::nREGERR::kMask | reg::REGEND::kMask);
  EXPECT_EQ(chip.read(reg::kAddrRdata), 0x00);
}

// CHSEL = 11, REGVERS = 0: the access runs on the line of BiSS B although the other does not fit.
TEST(ChipAccess, OneOfTwoLinesFits_TheAccessRunsThere) {
  for (const Protocol other : {Protocol::kBissC, Protocol::kSsi}) {
    for (const bool swapped : {false, true}) {
      Chip chip(swapped ? two_lines(Protocol::kBissB, other) : two_lines(other, Protocol::kBissB));
      chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 25, reg::kScrclenCrc6, 0x00, 0x00});
      chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 25, reg::kScrclenCrc6, 0x00, 0x00});
      chip.write(reg::kAddrFreq, {reg::FREQS::of(4), 0, 0x00});
      chip.write(reg::kAddrRegadr, {0x20, 0x00, reg::kChsel2Used | reg::kChsel1Used, 0});
      const unsigned code = static_cast<unsigned>(other);
      chip.write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5 | reg::kSlaveloc5Split,
                                       static_cast<std::uint8_t>(swapped ? code << 2U : code)});
      chip.advance_us(10);
      chip.instruct(reg::kInstrControl);
      chip.advance_us(3000);
      EXPECT_EQ(chip.status() & (reg::nREGERR::kMask | reg::REGEND::kMask),
                reg::nREGERR::kMask | reg::REGEND::kMask)
          << swapped;
      EXPECT_EQ(chip.read(reg::kAddrRdata), 0x5A) << swapped;
    }
  }
}

// Decision 42: requests every 300 us while SL = 0. The first that comes later than 9/8 of
// 4096 * 2^(FREQR + 1) MA periods after the first one ends the access.
TEST(ChipAccess, SlLow_EndsWhateverFreqagsIs) {
  constexpr double kLimitUs = 9.0 / 8 * 4096 * 64 * 0.5;  // FREQR = 5, f_MA = 2 MHz
  for (const unsigned freqags : {0x7CU, 0x31U, 0x00U, 0x7DU, 0x80U}) {
    const bool agsmin = freqags == 0x7C;
    Chip chip(one_slave(kSlave, "[[channel.event]]\nat_us = 0\naction = \"sl-low\"\n", "",
                        "sclk_hz = 20_000_000"));
    chip.configure_slave1(26, reg::kScrclenCrc6, 0x04, static_cast<std::uint8_t>(freqags));
    chip.write(reg::kAddrRegadr, {0x20, 0x00, 0, reg::kCtsRegisterAccess | reg::kRegversBissC});
    sim::Time first = sim::kNever;
    unsigned ends = 0;
    sim::Time last = 0;
    for (unsigned request = 0; request < 1200; ++request) {
      const auto before = chip.simulator.now();
      chip.instruct(reg::kInstrControl);
      const auto now = chip.simulator.now();
      if (first == sim::kNever) first = now;
      chip.advance_us(300);
      const unsigned status = chip.status();
      if ((status & reg::REGEND::kMask) == 0) {
        ASSERT_EQ(status,
                  agsmin ? reg::kResetStatus0 & ~reg::EOT::kMask
                         : unsigned{reg::kResetStatus0 & ~(reg::nERR::kMask | reg::nAGSERR::kMask)})
            << request;
      } else {
        ASSERT_EQ(status,
                  agsmin
                      ? unsigned{(reg::kResetStatus0 & ~(reg::nERR::kMask | reg::nREGERR::kMask)) |
                                 reg::kRegendDone}
                      : unsigned{(reg::kResetStatus0 &
                                  ~(reg::nERR::kMask | reg::nAGSERR::kMask | reg::nREGERR::kMask)) |
                                 reg::kRegendDone})
            << request;
        ++ends;
        const double waited = static_cast<double>(now - first) / 1e6;
        EXPECT_GT(waited, kLimitUs - (agsmin ? 302 : 1)) << request;
        EXPECT_LT(static_cast<double>(last - first) / 1e6, kLimitUs + 1) << request;
        first = sim::kNever;
      }
      last = before;
    }
    EXPECT_GE(ends, 2U) << freqags;
    // SL comes back: the next access runs.
    chip.simulator.line(1)->faults().stick(std::nullopt);
    chip.simulator.refresh_lines();
    chip.instruct(reg::kBreakAbort);
    chip.advance_us(50);
    chip.write(reg::kAddrFreqags, {reg::kFreqagsAgsMin});
    chip.instruct(reg::kInstrControl | reg::kAgsOn);
    chip.advance_us(4000);
    EXPECT_EQ(chip.status() & (reg::nREGERR::kMask | reg::REGEND::kMask),
              reg::nREGERR::kMask | reg::REGEND::kMask)
        << freqags;
  }
}

// Decision 38: an access goes on with what it was started with, whenever the host writes its
// settings: a write of three registers arrives whole at the slave and at the address it began with.
TEST(ChipAccess, SettingsChangedWhileItRuns_DoNotReachIt) {
  for (unsigned phase = 0; phase < 300; ++phase) {
    Chip chip(one_slave(kSlave, "", "", "sclk_hz = 20_000_000"));
    chip.configure_slave1(26, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
    chip.write(reg::kAddrRdata, {0xA1, 0xB2, 0xC3});
    // Three bytes from 0x20 on, WNR = 1 (bit 7), slave ID 0.
    chip.write(reg::kAddrRegadr,
               {reg::kWnrWrite | 0x20, 0x02, 0, reg::kCtsRegisterAccess | reg::kRegversBissC});
    chip.advance_us(10);
    chip.instruct(reg::kInstrControl | reg::kAgsOn);
    chip.simulator.advance(phase * 3'333 * sim::kPsPerNs);
    chip.write(reg::kAddrRegadr,
               {0x51, 0x3F, reg::kChsel2Used, reg::CMD::of(3) | reg::kIdaTestTested});
    chip.advance_us(3000);
    const auto& slave = *chip.simulator.slave(1);
    ASSERT_EQ(chip.status() & (reg::nREGERR::kMask | reg::REGEND::kMask),
              reg::nREGERR::kMask | reg::REGEND::kMask)
        << phase;
    ASSERT_EQ(chip.read(reg::kAddrInstr) & reg::INSTR::kMask, 0) << phase;
    const std::vector<std::uint8_t> want{0xA1, 0xB2, 0xC3, 0x00};
    for (unsigned i = 0; i < want.size(); ++i) {
      ASSERT_EQ(slave.reg_read(static_cast<std::uint8_t>(0x20 + i)), want[i]) << phase;
    }
  }
}

}  // namespace
