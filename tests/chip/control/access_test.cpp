// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Control communication that cannot run, cannot start, or whose settings change while it runs:
// decisions 24, 37, 38, 42 and 43, pages 27, 28, 34.
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mb4/fields.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/registers/control_slave.hpp"
#include "tests/reference/reference.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::one_slave;
using mb4test::Protocol;
namespace sim = mb4::sim;
namespace reg = mb4::regs;

const std::string kSlave = "data_bits = 26\ncrc = 0x43\ndata = 0x0AAAAAA\n";

constexpr unsigned kErr = reg::nERR::kMask, kNotRegErr = reg::nREGERR::kMask;
constexpr unsigned kRegEnd = reg::REGEND::kMask, kEot = reg::EOT::kMask;
// INSTR of an access whose frames run by themselves.
constexpr std::uint8_t kAutomatic = reg::kInstrControl | reg::kAgsOn;
// CTRL of a register access.
constexpr std::uint8_t kAccessB = reg::kCtsRegisterAccess | reg::kRegversBissB;
constexpr std::uint8_t kAccessC = reg::kCtsRegisterAccess | reg::kRegversBissC;
// CFGCH: line 1 and line 2.
constexpr std::uint8_t kOnlyBissB = reg::kCfgch1BissB | reg::kCfgch2Unused;
constexpr std::uint8_t kOnlyBissC = reg::kCfgch1BissC | reg::kCfgch2Unused;
constexpr std::uint8_t kBissBAndC = reg::kCfgch1BissB | reg::kCfgch2BissC;
constexpr std::uint8_t kTwoLines = reg::kResetSlaveloc5 | reg::kSlaveloc5Split;
constexpr std::uint8_t kBothLines = reg::kChsel1Used | reg::kChsel2Used;
constexpr std::uint8_t kWord26 = reg::kEnscdYes | 25;

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

// A slave of registers on line 1, which holds SL at 0 from the first moment on.
std::string sl_low(Protocol protocol) {
  return "[host]\nsclk_hz = 20_000_000\n[[channel]]\nnumber = 1\n"
         "[[channel.event]]\nat_us = 0\naction = \"sl-low\"\n[[channel.slave]]\nprotocol = \"" +
         std::string(protocol == Protocol::kBissB ? "biss-b\"\nregister_timeout = 30.0\n"
                                                  : "biss-c\"\n") +
         kSlave + "registers = { 0x20 = [0x5A] }\n";
}
void release_sl(Chip& chip) {
  clocked(chip.simulator.line(1))->faults().stick(std::nullopt);
  chip.simulator.refresh_lines();
}
// Line 1 for a read of register 0x20.
void configure(Chip& chip, Protocol protocol, unsigned freqs, unsigned freqr,
               std::uint8_t freqags) {
  const bool biss_c = protocol == Protocol::kBissC;
  chip.write(reg::slave_cfg_address(1), {kWord26, reg::kScrclenCrc6, 0x00, 0x00});
  chip.write(reg::kAddrRegadr, {0x20, 0x00, 0x00, biss_c ? kAccessC : kAccessB,
                                reg::FREQR::insert(static_cast<std::uint8_t>(freqs),
                                                   static_cast<std::uint8_t>(freqr)),
                                0x00, freqags});
  chip.write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5, biss_c ? kOnlyBissC : kOnlyBissB});
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
      chip.write(reg::slave_cfg_address(1), {kWord26, reg::kScrclenCrc6, 0x00, 0x00});
      chip.write(reg::slave_cfg_address(5), {kWord26, reg::kScrclenCrc6, 0x00, 0x00});
      chip.write(reg::kAddrFreq, {reg::FREQR::of(5), 0x00, reg::kFreqagsAgsMin});
      chip.advance_us(10);
      for (unsigned setting = 0; setting < 128; ++setting) {
        const bool slaveloc5 = (setting & 1U) != 0, regvers = (setting & 2U) != 0;
        const unsigned chsel = (setting >> 2U) & 3U;
        const bool cts = (setting & 16U) != 0, ags = (setting & 32U) != 0;
        const unsigned instr =
            (setting & 64U) != 0 ? reg::kInstrControlReduced : reg::kInstrControl;
        chip.instruct(reg::kBreakAbort);
        chip.advance_us(50);
        chip.write(reg::kAddrRegadr,
                   {0x20, 0x00, static_cast<std::uint8_t>(chsel),
                    static_cast<std::uint8_t>((cts ? reg::kCtsRegisterAccess : 0) |
                                              (regvers ? reg::kRegversBissC : 0))});
        chip.write(reg::kAddrSlaveloc5,
                   {slaveloc5 ? kTwoLines : reg::kResetSlaveloc5,
                    static_cast<std::uint8_t>(code_of(second) << reg::kFamilyCfgch.shift(2) |
                                              code_of(first))});
        const unsigned lines = mb4test::Reference::access_lines(
            {first, slaveloc5 ? second : std::nullopt}, regvers, chsel, cts);
        chip.instruct(static_cast<std::uint8_t>(instr | (ags ? reg::kAgsOn : 0U)));
        chip.advance_us(ags ? 20 : 2);
        const unsigned status = chip.status();
        const unsigned left = chip.read(reg::kAddrInstr) & reg::INSTR::kMask;
        const std::string what = "CFGCH " + std::to_string(code_of(first)) + " " +
                                 std::to_string(code_of(second)) + ", setting " +
                                 std::to_string(setting);
        if (lines == 0) {
          ++in_vain;
          ASSERT_EQ(status & (kErr | kNotRegErr | kRegEnd), kRegEnd) << what;
          ASSERT_EQ(left, 0x00U) << what;
          ASSERT_EQ(chip.read(reg::kAddrStatus3) & reg::REGBYTES::kMask, 0x00) << what;
        } else {
          ++runs;
          ASSERT_EQ(status & (kNotRegErr | kRegEnd), kNotRegErr) << what;
        }
      }
    }
  }
  EXPECT_GT(in_vain, 500U);
  EXPECT_GT(runs, 300U);
}

// Table 63: REGBYTES belongs to the access that failed, whatever the host configures afterwards;
// after an access that cannot run it is 0.
TEST(ChipAccess, RegBytes_AreThoseOfTheAccessThatFailed) {
  Chip chip(two_lines(Protocol::kBissB, Protocol::kBissC, "missing = [0x23, 0x35]\n"));
  chip.write(reg::kAddrFreq, {0x00, 0x00, reg::kFreqagsAgsMin});
  chip.write(reg::kAddrSlaveloc5, {kTwoLines, kBissBAndC});  // line 1 BiSS B, line 2 BiSS C
  // Reads `count` bytes over the line, at a FREQAGS that suits both.
  const auto read = [&](unsigned line, unsigned address, unsigned count) {
    chip.write(reg::kAddrRegadr,
               {static_cast<std::uint8_t>(address), static_cast<std::uint8_t>(count - 1),
                static_cast<std::uint8_t>(line), line == 1 ? kAccessB : kAccessC});
    chip.instruct(kAutomatic);
    for (unsigned i = 0; i < 400 && (chip.read(reg::kAddrInstr) & reg::INSTR::kMask) != 0; ++i)
      chip.advance_us(100);
    chip.instruct(reg::kInstrNone);  // the running frame ends
    chip.advance_us(100);
    return chip.status() & (reg::nDELAYERR::kMask | kNotRegErr | kRegEnd);
  };
  const auto reg_bytes = [&] { return chip.read(reg::kAddrStatus3) & reg::REGBYTES::kMask; };
  unsigned turn = 0;
  for (const unsigned line : {1U, 2U, 1U}) {
    const std::string what = "turn " + std::to_string(++turn) + ", line " + std::to_string(line);
    const unsigned start = line == 1 ? 0x21 : 0x31;
    EXPECT_EQ(read(line, start, 6), kNotRegErr | kRegEnd) << what << ": nDELAYERR = 0";
    EXPECT_EQ(reg_bytes(), line == 1 ? 2U : 4U) << what;
    chip.write(reg::kAddrCtrl, {line == 1 ? kAccessC : kAccessB});
    chip.advance_us(2);
    EXPECT_EQ(reg_bytes(), line == 1 ? 2U : 4U) << what << ", REGVERS of the next access";
    EXPECT_EQ(read(line, 0x40, 3), reg::nDELAYERR::kMask | kNotRegErr | kRegEnd) << what;
    EXPECT_EQ(reg_bytes(), 0U) << what << ": no error";
    // The selected line has another protocol than REGVERS names.
    chip.write(reg::kAddrChsel, {static_cast<std::uint8_t>(3 - line)});
    chip.instruct(reg::kInstrControl);
    chip.advance_us(2);
    EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd), kRegEnd) << what << ": nREGERR = 0";
    EXPECT_EQ(reg_bytes(), 0U) << what << ": none of this access";
  }
}

// Decisions 4, 19, 37: the chip takes an INSTR that cannot run after the running frame. MA is
// forced to 1, so this frame hangs until the force bits are cleared.
TEST(ChipAccess, InVainDuringAFrameThatHangs_EndsBehindIt) {
  for (const unsigned ags : {0U, 1U}) {
    Chip chip(one_slave(kSlave, "", "", "sclk_hz = 20_000_000"));
    chip.configure_slave1(26, reg::kScrclenCrc6, 0x04, reg::kFreqagsAgsMin);
    chip.write(reg::kAddrChsel, {reg::kChsel1Used, kAccessB});  // line 1 is BiSS C
    chip.write(reg::kAddrIface, {reg::kMafsForced | reg::kMavsHigh});
    chip.advance_us(10);
    chip.instruct(static_cast<std::uint8_t>(reg::kInstrCdm0 | ags));
    chip.advance_us(100);
    chip.instruct(static_cast<std::uint8_t>(reg::kInstrControl | ags));
    chip.advance_us(20'000);
    EXPECT_EQ(chip.status() & (kRegEnd | kEot), 0U) << ags;
    EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kInstrControl | ags) << ags;
    chip.write(reg::kAddrIface, {0x00});
    chip.advance_us(200);
    EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd), kRegEnd) << ags;
    EXPECT_EQ(chip.read(reg::kAddrInstr), ags) << ags;
  }
}

// An access that cannot run, after a good one, ends with an error, and RDATA keeps the bytes of the
// good one.
TEST(ChipAccess, InVainAfterASuccess_IsAnErrorAndKeepsRdata) {
  Chip chip(one_slave(kSlave + "registers = { 0x20 = [0x5A] }", "", "", "sclk_hz = 20_000_000"));
  chip.configure_slave1(26, reg::kScrclenCrc6, 0x04, reg::kFreqagsAgsMin);
  chip.write(reg::kAddrRegadr, {0x20, 0x00, 0x00, kAccessC});
  chip.instruct(kAutomatic);
  chip.advance_us(4000);
  ASSERT_EQ(chip.status() & (kNotRegErr | kRegEnd), kNotRegErr | kRegEnd);
  ASSERT_EQ(chip.read(reg::kAddrRdata), 0x5A);
  chip.instruct(reg::kBreakAbort);
  chip.advance_us(50);
  chip.write(reg::kAddrRegadr, {0x21});
  chip.write(reg::kAddrCtrl, {kAccessB});
  chip.instruct(reg::kInstrControl);
  EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd | kEot), kRegEnd | kEot) << "the first read";
  EXPECT_EQ(chip.read(reg::kAddrRdata), 0x5A);
  // The next access that can run does run.
  chip.write(reg::kAddrCtrl, {kAccessC});
  chip.instruct(kAutomatic);
  chip.advance_us(4000);
  EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd), kNotRegErr | kRegEnd);
  EXPECT_EQ(chip.read(reg::kAddrRdata), 0x00);
}

// CHSEL = 11, REGVERS = 0: the access runs on the line of BiSS B although the other does not fit.
TEST(ChipAccess, OneOfTwoLinesFits_TheAccessRunsThere) {
  for (const Protocol other : {Protocol::kBissC, Protocol::kSsi}) {
    for (const bool swapped : {false, true}) {
      Chip chip(swapped ? two_lines(Protocol::kBissB, other) : two_lines(other, Protocol::kBissB));
      chip.write(reg::slave_cfg_address(1), {kWord26, reg::kScrclenCrc6, 0x00, 0x00});
      chip.write(reg::slave_cfg_address(5), {kWord26, reg::kScrclenCrc6, 0x00, 0x00});
      chip.write(reg::kAddrFreq, {0x04, 0x00, 0x00});
      chip.write(reg::kAddrRegadr, {0x20, 0x00, kBothLines, reg::kCtsCommand | reg::kRegversBissB});
      const unsigned code = static_cast<unsigned>(other);
      chip.write(reg::kAddrSlaveloc5,
                 {kTwoLines,
                  static_cast<std::uint8_t>(swapped ? code << reg::kFamilyCfgch.shift(2) : code)});
      chip.advance_us(10);
      chip.instruct(reg::kInstrControl);
      chip.advance_us(3000);
      EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd), kNotRegErr | kRegEnd) << swapped;
      EXPECT_EQ(chip.read(reg::kAddrRdata), 0x5A) << swapped;
    }
  }
}

// Decision 42: requests every 300 us while SL = 0. The first that comes later than 9/8 of
// 4096 * 2^(FREQR + 1) MA periods after the first one ends the access.
TEST(ChipAccess, SlLow_EndsWhateverFreqagsIs) {
  constexpr double kLimitUs = 9.0 / 8 * 4096 * 64 * 0.5;  // FREQR = 5, f_MA = 2 MHz
  // The access has failed; with a rate also: frames have been missed.
  constexpr unsigned kFailed = (reg::kResetStatus0 | kRegEnd) & ~kErr & ~kNotRegErr;
  constexpr unsigned kMissed = kFailed & ~reg::nAGSERR::kMask;
  for (const Protocol protocol : {Protocol::kBissC, Protocol::kBissB}) {
    for (const int freqags : {+reg::kFreqagsAgsMin, 0x31, 0x00, +reg::kFreqagsAgsInfinite, 0x80}) {
      const bool agsmin = freqags == reg::kFreqagsAgsMin;
      const std::string what =
          std::to_string(static_cast<unsigned>(protocol)) + " " + std::to_string(freqags) + " ";
      Chip chip(sl_low(protocol));
      configure(chip, protocol, 0x04, 5, static_cast<std::uint8_t>(freqags));
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
        if ((status & kRegEnd) == 0) {
          ASSERT_EQ(status, agsmin ? reg::kResetStatus0 & ~kEot : (kMissed & ~kRegEnd) | kNotRegErr)
              << what << request;
        } else {
          ASSERT_EQ(status, agsmin ? kFailed : kMissed) << what << request;
          ASSERT_EQ(chip.read(reg::kAddrStatus3), 0x00) << what << request;
          ASSERT_EQ(chip.read(reg::kAddrInstr), 0x00) << what << request;
          ++ends;
          const double waited = static_cast<double>(now - first) / 1e6;
          EXPECT_GT(waited, kLimitUs - (agsmin ? 302 : 1)) << what << request;
          EXPECT_LT(static_cast<double>(last - first) / 1e6, kLimitUs + 1) << what << request;
          first = sim::kNever;
        }
        last = before;
      }
      EXPECT_GE(ends, 2U) << what;
      // SL comes back: the next access runs.
      release_sl(chip);
      chip.instruct(reg::kBreakAbort);
      chip.advance_us(50);
      chip.write(reg::kAddrFreqags, {reg::kFreqagsAgsMin});
      chip.instruct(kAutomatic);
      chip.advance_us(protocol == Protocol::kBissB ? 12'000 : 4000);
      EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd), kNotRegErr | kRegEnd) << what;
      EXPECT_EQ(chip.read(reg::kAddrRdata), 0x5A) << what;
    }
  }
}

// The host sets AGS while an access waits for SL: no request ends it from then on. BiSS C ends as
// with AGS from the beginning (docs/choices.md); BiSS B still waits for the line.
TEST(ChipAccess, SlLowAndAgsBehindTheFirstRequest_EndsAsUnderAgs) {
  for (const Protocol protocol : {Protocol::kBissC, Protocol::kBissB}) {
    for (const int freqags : {+reg::kFreqagsAgsMin, 0x31, 0x80}) {
      for (const int byte : {+reg::kAgsOn, reg::kInstrCdm0 | reg::kAgsOn, +kAutomatic}) {
        const std::string what = std::to_string(static_cast<unsigned>(protocol)) + " " +
                                 std::to_string(freqags) + " " + std::to_string(byte);
        Chip chip(sl_low(protocol));
        configure(chip, protocol, 0x00, 0, static_cast<std::uint8_t>(freqags));
        chip.instruct(reg::kInstrControl);
        chip.advance_us(100);
        chip.instruct(static_cast<std::uint8_t>(byte));
        chip.advance_us(1500);  // the limit is 922 us
        const bool ends = protocol == Protocol::kBissC;
        EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd), ends ? kRegEnd : kNotRegErr) << what;
        EXPECT_EQ(chip.read(reg::kAddrInstr), ends && byte == kAutomatic ? reg::kAgsOn : byte)
            << what;
        // Without AGS an access starts anew: the time before does not count.
        chip.instruct(reg::kInstrNone);
        chip.instruct(reg::kInstrControl);
        chip.advance_us(10);
        EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd), kNotRegErr) << what;
        release_sl(chip);
        chip.instruct(reg::kBreakAbort);
        chip.advance_us(50);
        chip.instruct(kAutomatic);
        chip.advance_us(4000);
        EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd), kNotRegErr | kRegEnd) << what;
      }
    }
  }
}

// Decisions 24, 37: an access is asked for beside automatic frames, and before it begins, or while
// it runs, the lines or REGVERS change so that it cannot run any more. It ends.
TEST(ChipAccess, ChangedBeforeItsAutomaticFrame_Ends) {
  struct Change {
    std::uint8_t ctrl, cfgch;
  };
  constexpr std::uint8_t kNoLine = reg::kCfgch1Unused | reg::kCfgch2Unused;
  constexpr std::uint8_t kOnlySsi = reg::kCfgch1Ssi | reg::kCfgch2Unused;
  for (const Protocol protocol : {Protocol::kBissB, Protocol::kBissC}) {
    for (const int freqags : {0x31, 0x80, +reg::kFreqagsAgsMin, +reg::kFreqagsAgsInfinite}) {
      for (const Change& change : {Change{kAccessB, kOnlyBissC}, Change{kAccessB, kNoLine},
                                   Change{kAccessC, kOnlyBissB}, Change{kAccessC, kOnlyBissC},
                                   Change{kAccessB, kOnlyBissB}, Change{kAccessC, kOnlySsi}}) {
        for (const bool low : {false, true}) {
          for (unsigned phase = 0; phase < 12; ++phase) {
            const std::string what = std::to_string(static_cast<unsigned>(protocol)) +
                                     ", FREQAGS " + std::to_string(freqags) + ", change " +
                                     std::to_string(change.ctrl) + " " +
                                     std::to_string(change.cfgch) + (low ? ", SL low" : "") +
                                     ", phase " + std::to_string(phase);
            Chip chip(sl_low(protocol));
            if (!low) release_sl(chip);
            configure(chip, protocol, 0x00, 0, static_cast<std::uint8_t>(freqags));
            chip.advance_us(10);
            chip.instruct(reg::kAgsOn);
            chip.advance_us(60);
            chip.instruct(phase % 2 == 0 ? kAutomatic : reg::kInstrControlReduced | reg::kAgsOn);
            chip.simulator.advance(phase * phase * 450 * sim::kPsPerNs);
            chip.write(reg::kAddrCtrl, {change.ctrl});
            chip.write(reg::kAddrCfgch, {change.cfgch});
            chip.advance_us(5000);
            const bool biss_b = change.ctrl == kAccessB && change.cfgch == kOnlyBissB;
            const bool waits_getsens =
                freqags == reg::kFreqagsAgsInfinite && (protocol == Protocol::kBissC || biss_b);
            if (waits_getsens || (low && biss_b)) continue;
            EXPECT_EQ(chip.status() & kRegEnd, kRegEnd) << what;
            EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kAgsOn) << what;
          }
        }
      }
    }
  }
}

// Decisions 37, 38: a BiSS B access waits for its automatic frame while SL is low. The host asks
// for it again and then at once writes REGVERS = 1, with which the access can run on line 2 only.
// With a slow clock both writes arrive at about the same time. The access runs or ends; it does not
// wait for ever.
TEST(ChipAccess, AskedAgainAndChangedWhileItWaits_Ends) {
  for (const unsigned khz : {800U, 1000U, 1700U, 2500U}) {
    for (unsigned phase = 0; phase < 24; ++phase) {
      Chip chip("[chip]\nf_clk_hz = " + std::to_string(1000 * khz) + "\n" +
                two_lines(Protocol::kBissB, Protocol::kBissC));
      clocked(chip.simulator.line(1))->faults().stick(false);
      chip.simulator.refresh_lines();
      chip.write(reg::kAddrRegadr,
                 {0x20, 0x00, kBothLines, kAccessB, 0x00, 0x00, reg::kFreqagsAgsMin});
      chip.write(reg::kAddrSlaveloc5, {kTwoLines, kBissBAndC});
      chip.advance_us(200);
      chip.instruct(kAutomatic);
      chip.simulator.advance((40'000 + phase * 1'000'000 / khz / 6) * sim::kPsPerNs);
      chip.instruct(kAutomatic);
      chip.write(reg::kAddrCtrl, {kAccessC});
      chip.advance_us(50);
      release_sl(chip);
      for (unsigned i = 0; i < 50 && (chip.status() & kRegEnd) == 0; ++i) chip.advance_us(2000);
      EXPECT_EQ(chip.status() & kRegEnd, kRegEnd) << khz << " kHz, phase " << phase;
      EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kAgsOn) << khz << " kHz, phase " << phase;
    }
  }
}

// Decisions 8, 38: BREAK and the next access in one byte. This access has the settings that the
// host has written for it, at any phase of the one that BREAK ends.
TEST(ChipAccess, BreakAndTheNextAccessInOneByte_TakesTheNewSettings) {
  for (const unsigned line : {1U, 2U}) {
    for (const unsigned next_line : {1U, 2U}) {
      for (unsigned phase = 0; phase < 20; ++phase) {
        const std::string what = "line " + std::to_string(line) + ", then " +
                                 std::to_string(next_line) + ", phase " + std::to_string(phase);
        Chip chip(two_lines(Protocol::kBissB, Protocol::kBissC));
        chip.simulator.slave(next_line == 1 ? 1 : 5)->reg_write(0x21, 0xC3);
        const auto ask = [&](unsigned address, unsigned on, std::uint8_t byte) {
          chip.write(reg::kAddrRegadr,
                     {static_cast<std::uint8_t>(address), 0x00, static_cast<std::uint8_t>(on),
                      on == 1 ? kAccessB : kAccessC});
          chip.instruct(byte);
        };
        chip.write(reg::kAddrFreq, {0x00, 0x00, 0x31});
        chip.write(reg::kAddrSlaveloc5, {kTwoLines, kBissBAndC});  // line 1 BiSS B, line 2 BiSS C
        chip.advance_us(10);
        ask(0x20, line, kAutomatic);
        chip.simulator.advance((50'000 + 1'130 * phase) * sim::kPsPerNs);
        ask(0x21, next_line, reg::kBreakAbort | kAutomatic);
        chip.advance_us(5000);
        EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd), kNotRegErr | kRegEnd) << what;
        EXPECT_EQ(chip.read(reg::kAddrRdata), 0xC3) << what;
        EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kAgsOn) << what;
      }
    }
  }
}

// Decision 38: the same without BREAK, with an INSTR that the host writes around the end of the
// access. An INSTR in the last frame is the next access; an earlier one has no effect.
TEST(ChipAccess, NextAccessInTheLastFrame_TakesTheNewSettings) {
  std::array<unsigned, 3> seen{};  // accesses
  for (unsigned phase = 0; phase < 120; ++phase) {
    Chip chip(one_slave(kSlave + "timeout = 1.0\nregisters = { 0x20 = [0x5A, 0xC3] }", "", "",
                        "sclk_hz = 20_000_000"));
    chip.configure_slave1(26, reg::kScrclenCrc6, 0x00, 0x31);  // a frame every 50 us
    chip.write(reg::kAddrRegadr, {0x20, 0x00, reg::kChsel1Used, kAccessC});
    chip.advance_us(10);
    chip.instruct(kAutomatic);
    chip.advance_us(45 * 50);
    chip.simulator.advance(phase * 3'130 * sim::kPsPerNs);
    chip.write(reg::kAddrRegadr, {0x21});
    chip.instruct(reg::kInstrControlReduced | reg::kAgsOn);
    chip.advance_us(6000);
    const auto starts = clocked(chip.simulator.slave(1))->control()->counters().starts;
    ++seen.at(starts);
    EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd), kNotRegErr | kRegEnd) << phase;
    EXPECT_EQ(chip.read(reg::kAddrRdata), starts == 1 ? 0x5A : 0xC3) << phase;
    EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kAgsOn) << phase;
  }
  EXPECT_GT(seen[1], 0U);
  EXPECT_GT(seen[2], 0U);
}

// Decision 38: an access goes on with what it was started with, whenever the host writes its
// settings: a write of three registers arrives whole at the slave and at the address it began with.
TEST(ChipAccess, SettingsChangedWhileItRuns_DoNotReachIt) {
  for (unsigned phase = 0; phase < 300; ++phase) {
    Chip chip(one_slave(kSlave, "", "", "sclk_hz = 20_000_000"));
    chip.configure_slave1(26, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
    chip.write(reg::kAddrRdata, {0xA1, 0xB2, 0xC3});
    // Three bytes from 0x20 on, slave ID 0.
    chip.write(reg::kAddrRegadr, {reg::kWnrWrite | 0x20, 0x02, 0x00, kAccessC});
    chip.advance_us(10);
    chip.instruct(kAutomatic);
    chip.simulator.advance(phase * 3'333 * sim::kPsPerNs);
    chip.write(reg::kAddrRegadr, {0x51, 0x3F, 0x02, 0x38});
    chip.advance_us(3000);
    const auto& slave = *chip.simulator.slave(1);
    ASSERT_EQ(chip.status() & (kNotRegErr | kRegEnd), kNotRegErr | kRegEnd) << phase;
    ASSERT_EQ(chip.read(reg::kAddrInstr) & reg::INSTR::kMask, 0x00) << phase;
    const std::vector<std::uint8_t> want{0xA1, 0xB2, 0xC3, 0x00};
    for (unsigned i = 0; i < want.size(); ++i) {
      ASSERT_EQ(slave.reg_read(static_cast<std::uint8_t>(0x20 + i)), want[i]) << phase;
    }
  }
}

}  // namespace
