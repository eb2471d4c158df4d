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
#include "sim/lines/registers/control_slave.hpp"
#include "tests/reference/reference.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::one_slave;
using mb4test::Protocol;
namespace sim = mb4::sim;

const std::string kSlave = "data_bits = 26\ncrc = 0x43\ndata = 0x0AAAAAA\n";

constexpr unsigned kErr = 0x80, kNotRegErr = 0x08, kRegEnd = 0x04, kEot = 0x01;

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
  chip.simulator.line(1)->faults().stick(std::nullopt);
  chip.simulator.refresh_lines();
}
// Line 1 for a read of register 0x20.
void configure(Chip& chip, Protocol protocol, unsigned freqs, unsigned freqr,
               std::uint8_t freqags) {
  const bool biss_c = protocol == Protocol::kBissC;
  chip.write(0xC0, {0x59, 0x06, 0x00, 0x00});
  chip.write(0xE2, {0x20, 0x00, 0x00, static_cast<std::uint8_t>(biss_c ? 0xC0 : 0x80),
                    static_cast<std::uint8_t>(freqr << 5U | freqs), 0x00, freqags});
  chip.write(0xEC, {0x01, static_cast<std::uint8_t>(biss_c ? 0x0D : 0x0C)});
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
      chip.write(0xC0, {0x59, 0x06, 0x00, 0x00});
      chip.write(0xD0, {0x59, 0x06, 0x00, 0x00});
      chip.write(0xE6, {0xA0, 0x00, 0x7C});
      chip.advance_us(10);
      for (unsigned setting = 0; setting < 128; ++setting) {
        const bool slaveloc5 = (setting & 1U) != 0, regvers = (setting & 2U) != 0;
        const unsigned chsel = (setting >> 2U) & 3U;
        const bool cts = (setting & 16U) != 0, ags = (setting & 32U) != 0;
        const unsigned instr = (setting & 64U) != 0 ? 7 : 4;
        chip.instruct(0x80);
        chip.advance_us(50);
        chip.write(0xE2, {0x20, 0x00, static_cast<std::uint8_t>(chsel),
                          static_cast<std::uint8_t>((cts ? 0x80 : 0) | (regvers ? 0x40 : 0))});
        chip.write(0xEC, {static_cast<std::uint8_t>(slaveloc5 ? 0x11 : 0x01),
                          static_cast<std::uint8_t>(code_of(second) << 2U | code_of(first))});
        const unsigned lines = mb4test::Reference::access_lines(
            {first, slaveloc5 ? second : std::nullopt}, regvers, chsel, cts);
        chip.instruct(static_cast<std::uint8_t>(instr << 1U | (ags ? 1U : 0U)));
        chip.advance_us(ags ? 20 : 2);
        const unsigned status = chip.status();
        const unsigned left = chip.read(0xF4) & 0x0E;
        const std::string what = "CFGCH " + std::to_string(code_of(first)) + " " +
                                 std::to_string(code_of(second)) + ", setting " +
                                 std::to_string(setting);
        if (lines == 0) {
          ++in_vain;
          ASSERT_EQ(status & (kErr | kNotRegErr | kRegEnd), kRegEnd) << what;
          ASSERT_EQ(left, 0x00U) << what;
          ASSERT_EQ(chip.read(0xF3) & 0x3F, 0x00) << what;
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

// Table 63: REGBYTES are those of the access that failed, whatever the host configures behind it;
// those of an earlier one are not shown by an access that cannot run.
TEST(ChipAccess, RegBytes_AreThoseOfTheAccessThatFailed) {
  Chip chip(two_lines(Protocol::kBissB, Protocol::kBissC, "missing = [0x23, 0x35]\n"));
  chip.write(0xE6, {0x00, 0x00, 0x7C});
  chip.write(0xEC, {0x11, 0x04});  // line 1 BiSS B, line 2 BiSS C
  // Reads `count` bytes over the line, at a FREQAGS that suits both.
  const auto read = [&](unsigned line, unsigned address, unsigned count) {
    chip.write(0xE2, {static_cast<std::uint8_t>(address), static_cast<std::uint8_t>(count - 1),
                      static_cast<std::uint8_t>(line),
                      static_cast<std::uint8_t>(line == 1 ? 0x80 : 0xC0)});
    chip.instruct(0x09);
    for (unsigned i = 0; i < 400 && (chip.read(0xF4) & 0x0E) != 0; ++i) chip.advance_us(100);
    chip.instruct(0x00);  // the running frame ends
    chip.advance_us(100);
    return chip.status() & 0x2CU;
  };
  const auto reg_bytes = [&] { return chip.read(0xF3) & 0x3FU; };
  unsigned turn = 0;
  for (const unsigned line : {1U, 2U, 1U}) {
    const std::string what = "turn " + std::to_string(++turn) + ", line " + std::to_string(line);
    const unsigned start = line == 1 ? 0x21 : 0x31;
    EXPECT_EQ(read(line, start, 6), 0x0CU) << what << ": nDELAYERR = 0";
    EXPECT_EQ(reg_bytes(), line == 1 ? 2U : 4U) << what;
    chip.write(0xE5, {static_cast<std::uint8_t>(line == 1 ? 0xC0 : 0x80)});
    chip.advance_us(2);
    EXPECT_EQ(reg_bytes(), line == 1 ? 2U : 4U) << what << ", REGVERS of the next access";
    EXPECT_EQ(read(line, 0x40, 3), 0x2CU) << what;
    EXPECT_EQ(reg_bytes(), 0U) << what << ": no error";
    // The line is not one of this REGVERS.
    chip.write(0xE4, {static_cast<std::uint8_t>(3 - line)});
    chip.instruct(0x08);
    chip.advance_us(2);
    EXPECT_EQ(chip.status() & 0x0CU, 0x04U) << what << ": nREGERR = 0";
    EXPECT_EQ(reg_bytes(), 0U) << what << ": none of this access";
  }
}

// Decisions 4, 19, 37: an INSTR that cannot run is taken behind the running frame. MA is forced to
// 1, so this frame hangs until the force bits are cleared.
TEST(ChipAccess, InVainDuringAFrameThatHangs_EndsBehindIt) {
  for (const unsigned ags : {0U, 1U}) {
    Chip chip(one_slave(kSlave, "", "", "sclk_hz = 20_000_000"));
    chip.configure_slave1(26, 0x06, 0x04, 0x7C);
    chip.write(0xE4, {0x01, 0x80});  // line 1 is BiSS C, REGVERS of BiSS B
    chip.write(0xF5, {0x30});
    chip.advance_us(10);
    chip.instruct(static_cast<std::uint8_t>(0x04U | ags));
    chip.advance_us(100);
    chip.instruct(static_cast<std::uint8_t>(0x08U | ags));
    chip.advance_us(20'000);
    EXPECT_EQ(chip.status() & (kRegEnd | kEot), 0U) << ags;
    EXPECT_EQ(chip.read(0xF4), 0x08U | ags) << ags;
    chip.write(0xF5, {0x00});
    chip.advance_us(200);
    EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd), kRegEnd) << ags;
    EXPECT_EQ(chip.read(0xF4), ags) << ags;
  }
}

// After a good access one that cannot run is no success, and its data stay those of the good one.
TEST(ChipAccess, InVainAfterASuccess_IsAnErrorAndKeepsRdata) {
  Chip chip(one_slave(kSlave + "registers = { 0x20 = [0x5A] }", "", "", "sclk_hz = 20_000_000"));
  chip.configure_slave1(26, 0x06, 0x04, 0x7C);
  chip.write(0xE2, {0x20, 0x00, 0x00, 0xC0});
  chip.instruct(0x09);
  chip.advance_us(4000);
  ASSERT_EQ(chip.status() & (kNotRegErr | kRegEnd), kNotRegErr | kRegEnd);
  ASSERT_EQ(chip.read(0x80), 0x5A);
  chip.instruct(0x80);
  chip.advance_us(50);
  chip.write(0xE2, {0x21});
  chip.write(0xE5, {0x80});
  chip.instruct(0x08);
  EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd | kEot), kRegEnd | kEot) << "the first read";
  EXPECT_EQ(chip.read(0x80), 0x5A);
  // And the way back: the next access that can run does.
  chip.write(0xE5, {0xC0});
  chip.instruct(0x09);
  chip.advance_us(4000);
  EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd), kNotRegErr | kRegEnd);
  EXPECT_EQ(chip.read(0x80), 0x00);
}

// CHSEL = 11, REGVERS = 0: the access runs on the line of BiSS B although the other does not fit.
TEST(ChipAccess, OneOfTwoLinesFits_TheAccessRunsThere) {
  for (const Protocol other : {Protocol::kBissC, Protocol::kSsi}) {
    for (const bool swapped : {false, true}) {
      Chip chip(swapped ? two_lines(Protocol::kBissB, other) : two_lines(other, Protocol::kBissB));
      chip.write(0xC0, {0x59, 0x06, 0x00, 0x00});
      chip.write(0xD0, {0x59, 0x06, 0x00, 0x00});
      chip.write(0xE6, {0x04, 0x00, 0x00});
      chip.write(0xE2, {0x20, 0x00, 0x03, 0x00});
      const unsigned code = static_cast<unsigned>(other);
      chip.write(0xEC, {0x11, static_cast<std::uint8_t>(swapped ? code << 2U : code)});
      chip.advance_us(10);
      chip.instruct(0x08);
      chip.advance_us(3000);
      EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd), kNotRegErr | kRegEnd) << swapped;
      EXPECT_EQ(chip.read(0x80), 0x5A) << swapped;
    }
  }
}

// Decision 42: requests every 300 us while SL = 0. The first that comes later than 9/8 of
// 4096 * 2^(FREQR + 1) MA periods after the first one ends the access.
TEST(ChipAccess, SlLow_EndsWhateverFreqagsIs) {
  constexpr double kLimitUs = 9.0 / 8 * 4096 * 64 * 0.5;  // FREQR = 5, f_MA = 2 MHz
  for (const Protocol protocol : {Protocol::kBissC, Protocol::kBissB}) {
    for (const unsigned freqags : {0x7CU, 0x31U, 0x00U, 0x7DU, 0x80U}) {
      const bool agsmin = freqags == 0x7C;
      const std::string what =
          std::to_string(static_cast<unsigned>(protocol)) + " " + std::to_string(freqags) + " ";
      Chip chip(sl_low(protocol));
      configure(chip, protocol, 0x04, 5, static_cast<std::uint8_t>(freqags));
      sim::Time first = sim::kNever;
      unsigned ends = 0;
      sim::Time last = 0;
      for (unsigned request = 0; request < 1200; ++request) {
        const auto before = chip.simulator.now();
        chip.instruct(0x08);
        const auto now = chip.simulator.now();
        if (first == sim::kNever) first = now;
        chip.advance_us(300);
        const unsigned status = chip.status();
        if ((status & kRegEnd) == 0) {
          ASSERT_EQ(status, agsmin ? 0xFAU : 0x3BU) << what << request;
        } else {
          ASSERT_EQ(status, agsmin ? 0x77U : 0x37U) << what << request;
          ASSERT_EQ(chip.read(0xF3), 0x00) << what << request;
          ASSERT_EQ(chip.read(0xF4), 0x00) << what << request;
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
      chip.instruct(0x80);
      chip.advance_us(50);
      chip.write(0xE8, {0x7C});
      chip.instruct(0x09);
      chip.advance_us(protocol == Protocol::kBissB ? 12'000 : 4000);
      EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd), kNotRegErr | kRegEnd) << what;
      EXPECT_EQ(chip.read(0x80), 0x5A) << what;
    }
  }
}

// The host sets AGS while an access waits for SL: no request ends it from then on. BiSS C ends as
// with AGS from the beginning (docs/choices.md); BiSS B still waits for the line.
TEST(ChipAccess, SlLowAndAgsBehindTheFirstRequest_EndsAsUnderAgs) {
  for (const Protocol protocol : {Protocol::kBissC, Protocol::kBissB}) {
    for (const unsigned freqags : {0x7CU, 0x31U, 0x80U}) {
      for (const unsigned byte : {0x01U, 0x05U, 0x09U}) {
        const std::string what = std::to_string(static_cast<unsigned>(protocol)) + " " +
                                 std::to_string(freqags) + " " + std::to_string(byte);
        Chip chip(sl_low(protocol));
        configure(chip, protocol, 0x00, 0, static_cast<std::uint8_t>(freqags));
        chip.instruct(0x08);
        chip.advance_us(100);
        chip.instruct(static_cast<std::uint8_t>(byte));
        chip.advance_us(1500);  // the limit is 922 us
        const bool ends = protocol == Protocol::kBissC;
        EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd), ends ? kRegEnd : kNotRegErr) << what;
        EXPECT_EQ(chip.read(0xF4), ends && byte == 0x09 ? 0x01 : byte) << what;
        // Without AGS an access starts anew: the time before does not count.
        chip.instruct(0x00);
        chip.instruct(0x08);
        chip.advance_us(10);
        EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd), kNotRegErr) << what;
        release_sl(chip);
        chip.instruct(0x80);
        chip.advance_us(50);
        chip.instruct(0x09);
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
    std::uint8_t regvers, cfgch;
  };
  for (const Protocol protocol : {Protocol::kBissB, Protocol::kBissC}) {
    for (const unsigned freqags : {0x31U, 0x80U, 0x7CU, 0x7DU}) {
      for (const Change& change : {Change{0x80, 0x0D}, Change{0x80, 0x0F}, Change{0xC0, 0x0C},
                                   Change{0xC0, 0x0D}, Change{0x80, 0x0C}, Change{0xC0, 0x0E}}) {
        for (const bool low : {false, true}) {
          for (unsigned phase = 0; phase < 12; ++phase) {
            const std::string what = std::to_string(static_cast<unsigned>(protocol)) +
                                     ", FREQAGS " + std::to_string(freqags) + ", change " +
                                     std::to_string(change.regvers) + " " +
                                     std::to_string(change.cfgch) + (low ? ", SL low" : "") +
                                     ", phase " + std::to_string(phase);
            Chip chip(sl_low(protocol));
            if (!low) release_sl(chip);
            configure(chip, protocol, 0x00, 0, static_cast<std::uint8_t>(freqags));
            chip.advance_us(10);
            chip.instruct(0x01);
            chip.advance_us(60);
            chip.instruct(phase % 2 == 0 ? 0x09 : 0x0F);
            chip.simulator.advance(phase * phase * 450 * sim::kPsPerNs);
            chip.write(0xE5, {change.regvers});
            chip.write(0xED, {change.cfgch});
            chip.advance_us(5000);
            const bool biss_b = change.regvers == 0x80 && change.cfgch == 0x0C;
            const bool waits_getsens = freqags == 0x7D && (protocol == Protocol::kBissC || biss_b);
            if (waits_getsens || (low && biss_b)) continue;
            EXPECT_EQ(chip.status() & kRegEnd, kRegEnd) << what;
            EXPECT_EQ(chip.read(0xF4), 0x01) << what;
          }
        }
      }
    }
  }
}

// Decisions 37, 38: a BiSS B access waits for its automatic frame while SL is low. The host asks
// for it again, and directly behind it writes REGVERS = 1, with which it can run on line 2 alone.
// With a slow clock both arrive at about the same time. The access runs or has ended; it does not
// stay.
TEST(ChipAccess, AskedAgainAndChangedWhileItWaits_Ends) {
  for (const unsigned khz : {800U, 1000U, 1700U, 2500U}) {
    for (unsigned phase = 0; phase < 24; ++phase) {
      Chip chip("[chip]\nf_clk_hz = " + std::to_string(1000 * khz) + "\n" +
                two_lines(Protocol::kBissB, Protocol::kBissC));
      chip.simulator.line(1)->faults().stick(false);
      chip.simulator.refresh_lines();
      chip.write(0xE2, {0x20, 0x00, 0x03, 0x80, 0x00, 0x00, 0x7C});
      chip.write(0xEC, {0x11, 0x04});
      chip.advance_us(200);
      chip.instruct(0x09);
      chip.simulator.advance((40'000 + phase * 1'000'000 / khz / 6) * sim::kPsPerNs);
      chip.instruct(0x09);
      chip.write(0xE5, {0xC0});
      chip.advance_us(50);
      release_sl(chip);
      for (unsigned i = 0; i < 50 && (chip.status() & kRegEnd) == 0; ++i) chip.advance_us(2000);
      EXPECT_EQ(chip.status() & kRegEnd, kRegEnd) << khz << " kHz, phase " << phase;
      EXPECT_EQ(chip.read(0xF4), 0x01) << khz << " kHz, phase " << phase;
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
          chip.write(0xE2, {static_cast<std::uint8_t>(address), 0x00, static_cast<std::uint8_t>(on),
                            static_cast<std::uint8_t>(on == 1 ? 0x80 : 0xC0)});
          chip.instruct(byte);
        };
        chip.write(0xE6, {0x00, 0x00, 0x31});
        chip.write(0xEC, {0x11, 0x04});  // line 1 BiSS B, line 2 BiSS C
        chip.advance_us(10);
        ask(0x20, line, 0x09);
        chip.simulator.advance((50'000 + 1'130 * phase) * sim::kPsPerNs);
        ask(0x21, next_line, 0x89);
        chip.advance_us(5000);
        EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd), kNotRegErr | kRegEnd) << what;
        EXPECT_EQ(chip.read(0x80), 0xC3) << what;
        EXPECT_EQ(chip.read(0xF4), 0x01) << what;
      }
    }
  }
}

// Decision 38: the same without BREAK, with an INSTR that the host writes around the end of the
// access. In the last frame it is the next access, before it none.
TEST(ChipAccess, NextAccessInTheLastFrame_TakesTheNewSettings) {
  std::array<unsigned, 3> seen{};  // accesses
  for (unsigned phase = 0; phase < 120; ++phase) {
    Chip chip(one_slave(kSlave + "timeout = 1.0\nregisters = { 0x20 = [0x5A, 0xC3] }", "", "",
                        "sclk_hz = 20_000_000"));
    chip.configure_slave1(26, 0x06, 0x00, 0x31);  // a frame every 50 us
    chip.write(0xE2, {0x20, 0x00, 0x01, 0xC0});
    chip.advance_us(10);
    chip.instruct(0x09);
    chip.advance_us(45 * 50);
    chip.simulator.advance(phase * 3'130 * sim::kPsPerNs);
    chip.write(0xE2, {0x21});
    chip.instruct(0x0F);
    chip.advance_us(6000);
    const auto starts = chip.simulator.slave(1)->control()->counters().starts;
    ++seen.at(starts);
    EXPECT_EQ(chip.status() & (kNotRegErr | kRegEnd), kNotRegErr | kRegEnd) << phase;
    EXPECT_EQ(chip.read(0x80), starts == 1 ? 0x5A : 0xC3) << phase;
    EXPECT_EQ(chip.read(0xF4), 0x01) << phase;
  }
  EXPECT_GT(seen[1], 0U);
  EXPECT_GT(seen[2], 0U);
}

// Decision 38: an access goes on with what it was started with, whenever the host writes its
// settings: a write of three registers arrives whole at the slave and at the address it began with.
TEST(ChipAccess, SettingsChangedWhileItRuns_DoNotReachIt) {
  for (unsigned phase = 0; phase < 300; ++phase) {
    Chip chip(one_slave(kSlave, "", "", "sclk_hz = 20_000_000"));
    chip.configure_slave1(26, 0x06, 0x00, 0x7C);
    chip.write(0x80, {0xA1, 0xB2, 0xC3});
    // Three bytes from 0x20 on, WNR = 1 (bit 7), slave ID 0.
    chip.write(0xE2, {0xA0, 0x02, 0x00, 0xC0});
    chip.advance_us(10);
    chip.instruct(0x09);
    chip.simulator.advance(phase * 3'333 * sim::kPsPerNs);
    chip.write(0xE2, {0x51, 0x3F, 0x02, 0x38});
    chip.advance_us(3000);
    const auto& slave = *chip.simulator.slave(1);
    ASSERT_EQ(chip.status() & (kNotRegErr | kRegEnd), kNotRegErr | kRegEnd) << phase;
    ASSERT_EQ(chip.read(0xF4) & 0x0E, 0x00) << phase;
    const std::vector<std::uint8_t> want{0xA1, 0xB2, 0xC3, 0x00};
    for (unsigned i = 0; i < want.size(); ++i) {
      ASSERT_EQ(slave.reg_read(static_cast<std::uint8_t>(0x20 + i)), want[i]) << phase;
    }
  }
}

}  // namespace
