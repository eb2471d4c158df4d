// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A host changes the configuration while the chip uses it (pages 23, 28: not allowed). Decision 38:
// an access keeps the settings with which it was started. A frame or an access may fail and show it
// in its flags, but it ends. After the configuration is written again everything works. No pulse of
// MA is short: see the guard at the MA pins.
#include <gtest/gtest.h>

#include <string>

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

std::string two_lines() {
  return one_slave(kEncoder, "", "", "sclk_hz = 50_000_000") +
         "[[channel]]\nnumber = 2\ndelay_ns = 60.0\n[[channel.slave]]\nprotocol = \"biss-c\"\n" +
         kEncoder + "\n";
}
void configure(Chip& chip) {
  chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 13, reg::kScrclenCrc6, 0x00, 0x00});
  chip.write(reg::slave_cfg_address(2),
             std::initializer_list<std::uint8_t>{0x00, 0x00, 0x00, 0x00});
  chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 13, reg::kScrclenCrc6, 0x00, 0x00});
  chip.write(reg::kAddrChsel, {0, reg::kRegversBissC, reg::FREQS::of(1), 0, reg::kFreqagsAgsMin,
                               0x00});  // FREQR 0: a short limit
  chip.write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5 | reg::kSlaveloc5Split,
                                   reg::kCfgch2BissC | reg::kCfgch1BissC, 0x00, 0});
  chip.write(reg::kAddrIface, {0});
}
void expect_all_works(Chip& chip, ControlHost& host, bool with_registers, const std::string& what) {
  configure(chip);
  chip.instruct(reg::kBreakAbort);
  chip.advance_us(100);
  chip.instruct(reg::kInitStart);
  ASSERT_TRUE(chip.wait_eot()) << what;
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot()) << what;
  EXPECT_EQ(chip.status(), reg::kResetStatus0) << what;
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo) & reg::SVALID<1>::kMask, reg::SVALID<1>::kMask) << what;
  EXPECT_EQ(chip.read(reg::kAddrSvalidHi) & reg::SVALID<5>::kMask, reg::SVALID<5>::kMask) << what;
  EXPECT_EQ(chip.read(reg::kAddrScdata, 2), (std::vector<std::uint8_t>{0xBC, 0x1A})) << what;
  EXPECT_EQ(chip.read(reg::scdata_address(5), 2), (std::vector<std::uint8_t>{0xBC, 0x1A})) << what;
  if (!with_registers) return;
  host.set_read(0, 0x31, 1);
  ASSERT_NE(host.run_single(80), 0U) << what;
  EXPECT_EQ(host.status(), kAllGood) << what;
  EXPECT_EQ(host.rdata(1)[0], 0x77) << what;
}

struct Change {
  std::uint8_t address;
  std::uint8_t value;
};
// Every configuration byte but CLKENI's, with fields at both ends of their range. FREQS = 0x1F
// takes long; force bits are released again before the frame can end.
constexpr Change kChanges[] = {
    {reg::slave_cfg_address(1), 0x00},
    {reg::slave_cfg_address(1), 0x40},
    {reg::slave_cfg_address(1), 0x7F},
    {reg::slave_cfg_address(1), 0xFF},
    {reg::SCRCLEN<1>::kAddress, 0x00},
    {reg::SCRCLEN<1>::kAddress, 0xFF},
    {reg::SCRCSTART_LO<1>::kAddress, 0xFF},
    {reg::SCRCSTART_HI<1>::kAddress, 0xFF},
    {reg::slave_cfg_address(2), 0x4D},
    {reg::slave_cfg_address(2), 0xFF},
    {reg::slave_cfg_address(5), 0x00},
    {reg::slave_cfg_address(5), 0x7F},
    {reg::SCRCLEN<5>::kAddress, 0x08},
    {reg::kAddrRegadr, 0xFF},
    {reg::kAddrRegadr, 0x00},
    {reg::kAddrRegnum, 0x3F},
    {reg::kAddrChsel, 0x01},
    {reg::kAddrChsel, 0x02},
    {reg::kAddrChsel, 0x03},
    {reg::kAddrCtrl, 0x40},
    {reg::kAddrCtrl, 0x00},
    {reg::kAddrCtrl, 0xC0},
    {reg::kAddrCtrl, 0xFB},
    {reg::kAddrCtrl, 0x42},
    {reg::kAddrCtrl, 0x41},
    {reg::kAddrFreq, 0x00},
    {reg::kAddrFreq, 0x09},
    {reg::kAddrFreq, 0x10},
    {reg::kAddrFreq, 0xE1},
    {reg::kAddrBankcfg, 0x01},
    {reg::kAddrBankcfg, 0x03},
    {reg::kAddrFreqags, 0x00},
    {reg::kAddrFreqags, 0x7D},
    {reg::kAddrFreqags, 0xFF},
    {reg::kAddrMoBusy, 0xFF},
    {reg::kAddrSlaveloc5, 0x01},
    {reg::kAddrCfgch, 0x00},
    {reg::kAddrCfgch, 0x0A},
    {reg::kAddrCfgch, 0x0F},
    {reg::kAddrCfgch, 0x07},
    {reg::kAddrCfgch, 0x0D},
    {reg::kAddrActnsens, 0x01},
    {reg::kAddrActnsens, 0xFF},
    {reg::kAddrIface, 0x04},
    {reg::kAddrIface, 0x0C},
    {reg::kAddrIface, 0x02},
};
std::string name_of(const Change& change, unsigned phase) {
  return std::to_string(change.address) + " <- " + std::to_string(change.value) + ", phase " +
         std::to_string(phase);
}

// With AGS = 1 a request waits for a line. The frame that begins in the clock in which CFGCH names
// the protocol is one of this protocol.
TEST(ConfigChange, LineTakenIntoUseUnderAgs_FirstFrameIsRight) {
  struct Kind {
    const char* protocol;
    std::uint8_t cfgch;  // Table 8
  };
  for (const Kind& kind : {Kind{"biss-b", 0x0C}, Kind{"biss-c", 0x0D}, Kind{"ssi", 0x0E}}) {
    for (unsigned phase = 0; phase < 10; ++phase) {
      const std::string what = std::string(kind.protocol) + ", phase " + std::to_string(phase);
      std::string text = one_slave(kEncoder, "", "", "sclk_hz = 20_000_000");
      text.replace(text.find("biss-c"), 6, kind.protocol);
      Chip chip(text);
      chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 13, reg::kScrclenCrc6, 0x00, 0x00});
      chip.write(reg::kAddrCtrl,
                 {reg::kRegversBissC, reg::FREQS::of(1), 0, 0x64});  // 5 MHz, a request each 101 us
      chip.write(reg::kAddrCfgch, {reg::kCfgch2Unused | reg::kCfgch1Unused});
      chip.instruct(reg::kAgsOn);
      chip.simulator.advance((150'000 + 10 * phase) * sim::kPsPerNs);
      EXPECT_EQ(chip.simulator.slave(1)->frames(), 0U) << what;
      chip.write(reg::kAddrCfgch, {kind.cfgch});
      chip.advance_us(40);  // the frame, and not the next one
      EXPECT_EQ(chip.simulator.slave(1)->frames(), 1U) << what;
      EXPECT_EQ(chip.status() & reg::nSCDERR::kMask, reg::kNscderrGood) << what << ": nSCDERR";
      EXPECT_EQ(chip.read(reg::kAddrSvalidLo) & reg::SVALID<1>::kMask, reg::SVALID<1>::kMask)
          << what << ": SVALID1";
      EXPECT_EQ(chip.read(reg::kAddrScdata, 2), (std::vector<std::uint8_t>{0xBC, 0x1A})) << what;
    }
  }
}

// CFGCH written within an SSI frame counts from the next one: the word is decoded as it began.
TEST(ConfigChange, ProtocolInAnSsiFrame_WordIsDecodedAsItBegan) {
  Chip chip(
      "[host]\nsclk_hz = 50_000_000\n[[channel]]\nnumber = 1\n[[channel.slave]]\n"
      "protocol = \"ssi\"\ndata_bits = 13\ngray = true\ndata = 0x1234\n");
  for (unsigned step = 0; step < 200; ++step) {
    chip.write(reg::slave_cfg_address(1),
               {reg::kEnscdYes | reg::kGraysGray | 12, 0x00, 0x00, 0x00});
    chip.write(reg::kAddrFreq, {0x09, 0x00, 0x7F});
    chip.write(reg::kAddrCfgch, {reg::kCfgch2Unused | reg::kCfgch1Ssi});
    chip.instruct(reg::kBreakAbort);
    chip.advance_us(60);
    chip.instruct(reg::kInstrCdm0);
    chip.simulator.advance(step * 100'000);  // in steps of two clocks
    chip.write(reg::kAddrCfgch, {reg::kCfgch2Unused | reg::kCfgch1BissC});
    ASSERT_TRUE(chip.wait_eot()) << step;
    EXPECT_EQ(chip.status() & reg::nSCDERR::kMask, reg::nSCDERR::kMask) << step;
    EXPECT_EQ(chip.read(reg::scdata_address(1), 2), (std::vector<std::uint8_t>{0x34, 0x12}))
        << step;
  }
}

// CFGCH written in the clocks around the start of an automatic frame without words: the frame is
// one of the old protocol or one of the new one. Either ends, but not a mixture: one edge of MA, as
// SSI needs, and no acknowledge (decision 38).
TEST(ConfigChange, ProtocolAsAFrameStarts_ItEnds) {
  constexpr std::uint8_t kProtocols[] = {reg::kCfgch1BissB, reg::kCfgch1BissC, reg::kCfgch1Ssi};
  Chip chip(one_slave(kEncoder, "", "", "sclk_hz = 50_000_000"));
  for (const std::uint8_t before : kProtocols) {
    for (const std::uint8_t after : kProtocols) {
      if (before == after) continue;
      for (unsigned step = 0; step < 400; ++step) {
        configure(chip);
        chip.write(reg::slave_cfg_address(1), {0x00});
        chip.write(reg::kAddrFreqags, {0x09});  // a frame each 10 us
        chip.write(reg::kAddrCfgch, {static_cast<std::uint8_t>(reg::kCfgch2Unused | before)});
        chip.instruct(reg::kBreakAbort);
        chip.advance_us(60);
        chip.instruct(reg::kAgsOn);
        chip.simulator.advance(sim::Time{11'000'000} + step * 25'000);
        chip.write(reg::kAddrCfgch, {static_cast<std::uint8_t>(reg::kCfgch2Unused | after)});
        chip.instruct(0x00);
        ASSERT_TRUE(chip.wait_eot(400))
            << unsigned{before} << " to " << unsigned{after} << ", step " << step;
      }
    }
  }
}

// In a frame of about 6 us, at steps that meet each of its parts.
TEST(ConfigChange, InAFrame_ItEndsAndEverythingWorksAgain) {
  for (const unsigned instruction : {reg::kInstrCdm0, reg::kInstrCdm1, reg::kInitStart}) {
    for (const Change& change : kChanges) {
      Chip chip(two_lines());
      ControlHost host(chip);
      configure(chip);
      chip.simulator.slave(1)->reg_write(0x31, 0x77);
      for (unsigned phase = 0; phase < 12; ++phase) {
        const std::string what = name_of(change, phase);
        chip.instruct(static_cast<std::uint8_t>(instruction));
        chip.simulator.advance(phase * 530 * sim::kPsPerNs);
        ASSERT_NO_THROW(chip.write(change.address, {change.value})) << what;
        // A slave that a longer frame still clocks sends zeros: the frame ends by its length.
        // CFGIF takes SL2 away: a line that does not answer waits for BREAK (decision 4).
        const bool takes_sl2 =
            change.address == reg::kAddrIface && (change.value & reg::kCfgifRs422) != 0;
        // INIT waits behind the reset (decision 46). If REGVERS is 0 when it begins it is a
        // hand-over, and no slave takes part: 4096 register clocks (decision 7 in docs/choices.md).
        const bool hands_over = instruction == reg::kInitStart &&
                                change.address == reg::kAddrCtrl &&
                                (change.value & reg::kRegversBissC) == 0;
        ASSERT_TRUE(chip.wait_eot(hands_over ? 2000 : 400) || takes_sl2) << what;
        ASSERT_NO_THROW(expect_all_works(chip, host, phase == 11, what)) << what;
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

// In an access, under AGS and with a request for each frame.
TEST(ConfigChange, InAnAccess_ItEndsAndEverythingWorksAgain) {
  for (const bool command : {false, true}) {
    for (const bool ags : {false, true}) {
      for (const Change& change : kChanges) {
        Chip chip(two_lines());
        ControlHost host(chip);
        configure(chip);
        chip.simulator.slave(1)->reg_write(0x31, 0x77);
        for (unsigned phase = 0; phase < 4; ++phase) {
          const std::string what = name_of(change, phase) + (ags ? ", AGS" : "");
          if (command) {
            host.set_command(0x80, 2, true);
          } else {
            host.set_read(0, 0x31, 2);
          }
          chip.instruct(ags ? reg::kInstrControl | reg::kAgsOn : reg::kInstrControl);
          // 14 zeros, the header, the data: up to frame 60 of 6 us each.
          for (unsigned frame = 0; frame < 15 * phase + 5; ++frame) {
            if (!ags) chip.instruct(reg::kInstrControl);
            ASSERT_NO_THROW(chip.advance_us(8)) << what;
          }
          ASSERT_NO_THROW(chip.write(change.address, {change.value})) << what;
          // AGSINFINITE: the frames of the access wait for GETSENS.
          chip.simulator.set_pin(sim::Pin::kGetsens, true);
          bool ended = false;
          for (unsigned look = 0; look < 150 && !ended; ++look) {
            if (!ags) chip.instruct(reg::kInstrControl);
            ASSERT_NO_THROW(chip.advance_us(40)) << what;
            ended = (host.status() & reg::REGEND::kMask) != 0;
          }
          chip.simulator.set_pin(sim::Pin::kGetsens, false);
          EXPECT_TRUE(ended) << what;
          ASSERT_NO_THROW(expect_all_works(chip, host, phase == 3, what)) << what;
          if (testing::Test::HasFailure()) return;
        }
      }
    }
  }
}

// CTS, REGADR, REGNUM, WNR, SLAVEID, CHSEL, CMD, REGVERS, IDA_TEST and IDS: the access goes on with
// what it was started with.
TEST(ConfigChange, FieldsOfAnAccess_CountAsItWasStarted) {
  constexpr Change kFields[] = {
      {reg::kAddrRegadr, 0x7E}, {reg::kAddrRegadr, 0xB0}, {reg::kAddrRegnum, 0x00},
      {reg::kAddrRegnum, 0x3F}, {reg::kAddrChsel, 0x02},  {reg::kAddrChsel, 0x03},
      {reg::kAddrCtrl, 0x40},   {reg::kAddrCtrl, 0x80},   {reg::kAddrCtrl, 0xF8},
      {reg::kAddrCtrl, 0xC8},   {reg::kAddrCtrl, 0x48},   {reg::kAddrCtrl, 0x70},
  };
  for (const bool ags : {false, true}) {
    for (const Change& change : kFields) {
      for (unsigned frame = 1; frame < 58; frame += ags ? 6 : 1) {
        const std::string what = name_of(change, frame) + (ags ? ", AGS" : "");
        Chip chip(two_lines());
        ControlHost host(chip);
        configure(chip);
        for (const unsigned slave : {1U, 5U}) {
          chip.simulator.slave(slave)->reg_write(0x30, static_cast<std::uint8_t>(0x10 * slave + 1));
          chip.simulator.slave(slave)->reg_write(0x31, static_cast<std::uint8_t>(0x10 * slave + 2));
        }
        chip.write(reg::kAddrRdata, {0xE1, 0xE2, 0xE3});
        host.set_read(0, 0x30, 2);
        bool ended = false;
        if (ags) {
          chip.instruct(reg::kInstrControl | reg::kAgsOn);
          chip.simulator.run_while_waiting(
              [&] { return clocked(chip.simulator.slave(1))->cdm_count() >= frame; },
              chip.simulator.now() + 1000 * sim::kPsPerUs);
          ASSERT_NO_THROW(chip.write(change.address, {change.value})) << what;
          for (unsigned look = 0; look < 200 && !ended; ++look) {
            ASSERT_NO_THROW(chip.advance_us(10)) << what;
            ended = (host.status() & reg::REGEND::kMask) != 0;
          }
        } else {
          ASSERT_EQ(host.run_single(frame), 0U) << what;
          ASSERT_NO_THROW(chip.write(change.address, {change.value})) << what;
          ASSERT_NO_THROW(ended = host.run_single(100) != 0) << what;
        }
        ASSERT_TRUE(ended) << what;
        EXPECT_EQ(host.status() & ~reg::EOT::kMask,
                  (reg::kResetStatus0 & ~reg::EOT::kMask) | reg::kRegendDone)
            << what;
        EXPECT_EQ(host.rdata(3), (std::vector<std::uint8_t>{0x11, 0x12, 0xE3})) << what;
        EXPECT_EQ(clocked(chip.simulator.slave(1))->control()->counters().starts, 1U) << what;
        EXPECT_EQ(clocked(chip.simulator.slave(5))->control()->counters().starts, 0U) << what;
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

TEST(ConfigChange, FieldsOfACommand_CountAsItWasStarted) {
  constexpr Change kFields[] = {{reg::kAddrIds, 0x40},   {reg::kAddrIds, 0x00},
                                {reg::kAddrChsel, 0x02}, {reg::kAddrChsel, 0x03},
                                {reg::kAddrCtrl, 0xC0},  {reg::kAddrCtrl, 0x60},
                                {reg::kAddrCtrl, 0x20},  {reg::kAddrCtrl, 0x40},
                                {reg::kAddrCtrl, 0x58},  {reg::kAddrCtrl, 0x68}};
  for (const bool tested : {false, true}) {
    for (const Change& change : kFields) {
      for (unsigned frame = 1; frame < 14 + (tested ? 26U : 25U); ++frame) {
        const std::string what = name_of(change, frame) + (tested ? ", tested" : "");
        Chip chip(two_lines());
        ControlHost host(chip);
        configure(chip);
        host.set_command(0x80, 2, tested);
        ASSERT_EQ(host.run_single(frame), 0U) << what;
        ASSERT_NO_THROW(chip.write(change.address, {change.value})) << what;
        unsigned frames = 0;
        ASSERT_NO_THROW(frames = host.run_single(100)) << what;
        EXPECT_EQ(frame + frames, 14U + (tested ? 26U : 25U)) << what;
        EXPECT_EQ(host.status(), kAllGood) << what;
        const auto& control = *clocked(chip.simulator.slave(1))->control();
        EXPECT_EQ(control.counters().commands, 1U) << what;
        EXPECT_EQ(control.last_command().ids, 0x80) << what;
        EXPECT_EQ(control.last_command().code, 2) << what;
        EXPECT_EQ(clocked(chip.simulator.slave(5))->control()->counters().commands, 0U) << what;
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

}  // namespace
