// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// SSI on the whole chip: pages 14 (I501 to I506), 16 (extended SSI), 24, 26 (Table 19), 30.
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/registers/control_slave.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/protocol_chip.hpp"

namespace {

using mb4test::ChipPlan;
using mb4test::ControlHost;
using mb4test::ma_clocks;
using mb4test::ProtocolChip;
using mb4test::valid;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

// FREQS codes at f_CLK = 20 MHz: 2 MHz, 1 MHz, 500 kHz, 250 kHz, 100 kHz, 62.5 kHz.
constexpr unsigned kFreqs[] = {0x04, 0x09, 0x11, 0x13, 0x19, 0x1F};
constexpr unsigned kLengths[] = {13, 24, 25, 32, 64};

std::string encoder(unsigned bits, const std::string& keys, const std::string& channel_keys = "") {
  return "[[channel]]\nnumber = 1\n" + channel_keys +
         "\n[[channel.slave]]\nprotocol = \"ssi\"\ndata_bits = " + std::to_string(bits) + "\n" +
         keys + "\n";
}

std::string timeout_key(sim::Time period) {
  return "timeout = " + std::to_string(sim::to_us(std::max<sim::Time>(3 * period, 20'000'000))) +
         "\n";
}

std::uint64_t low_bits(std::uint64_t value, unsigned bits) {
  return bits == 64 ? value : value & ((1ULL << bits) - 1);
}

class SsiFrames : public testing::TestWithParam<std::tuple<unsigned, unsigned, bool>> {};

// Each length and code with the whole range of delays: none, half a period, and the most that is
// allowed, one period less 30 ns (I504), by the encoder, by the cable, by both.
TEST_P(SsiFrames, EveryDelay_WordIsRightAndMaIsLPlusOne) {
  const auto [freqs, bits, gray] = GetParam();
  const sim::Time period = ma_clocks(freqs) * ProtocolChip::kClk;
  const double most = sim::to_ns(period) - 30;
  const struct {
    double response;
    double cable;
  } delays[] = {{0, 0}, {most / 2, 0}, {most, 0}, {0, most}, {most / 3, 2 * most / 3}};
  for (const auto& delay : delays) {
    ProtocolChip chip(encoder(bits,
                              timeout_key(period) + "response_ns = " +
                                  std::to_string(delay.response) + (gray ? "\ngray = true" : ""),
                              "delay_ns = " + std::to_string(delay.cable)),
                      {.freqs = freqs});
    std::uint64_t word = 0x9E3779B97F4A7C15ULL;
    for (const std::uint64_t each :
         {word, ~word, std::uint64_t{0}, ~std::uint64_t{0}, std::uint64_t{1}}) {
      const std::uint64_t expected = low_bits(each, bits);
      ASSERT_TRUE(chip.simulator.slave(1)->set_data(expected));
      ASSERT_TRUE(chip.frame());
      EXPECT_EQ(chip.scdata(1, bits), expected) << delay.response << " " << delay.cable;
      EXPECT_EQ(chip.svalid(), 2U);
      EXPECT_EQ(chip.status(), reg::kResetStatus0);
      const auto ma = clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now());
      EXPECT_EQ(ma.rising, bits + 1);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Table, SsiFrames,
                         testing::Combine(testing::ValuesIn(kFreqs), testing::ValuesIn(kLengths),
                                          testing::Bool()),
                         [](const auto& entry) {
                           return "Freqs" + std::to_string(std::get<0>(entry.param)) + "_" +
                                  std::to_string(std::get<1>(entry.param)) + "Bits_" +
                                  (std::get<2>(entry.param) ? "Gray" : "Binary");
                         });

// I501 to I503: period of Table 35, both levels half of it, at every FREQS code.
TEST(ChipSsi, EveryFreqs_HasItsPeriodAndHalfDuty) {
  for (unsigned freqs = 0; freqs < 32; ++freqs) {
    if (freqs == 0x10) continue;
    const sim::Time period = ma_clocks(freqs) * ProtocolChip::kClk;
    ProtocolChip chip(encoder(13, timeout_key(period) + "data = 0x1234"), {.freqs = freqs});
    ASSERT_TRUE(chip.frame()) << freqs;
    EXPECT_EQ(chip.scdata(1, 13), 0x1234U) << freqs;
    ASSERT_EQ(chip.ma[0].size(), 28U) << freqs;  // 14 falling, 14 rising
    for (std::size_t i = 0; i < chip.ma[0].size(); ++i) {
      EXPECT_EQ(chip.ma[0][i].level, i % 2 == 1);
      if (i == 0) continue;
      EXPECT_EQ(chip.ma[0][i].time - chip.ma[0][i - 1].time, period / 2) << freqs << " " << i;
    }
  }
}

// I504, I505: SL counts at the rising edge of MA, from 30 ns before to the edge itself. A bit that
// lasts no longer than that is enough: the line is inverted at all other times.
TEST(ChipSsi, LevelAtTheRisingEdge_IsWhatCounts) {
  for (const unsigned freqs : {0x00U, 0x01U, 0x04U, 0x13U}) {
    ProtocolChip chip(encoder(8, "data = 0xA7"), {.freqs = freqs});
    // By hand: SL of channel 2 is free, so the encoder is played by the test.
    const sim::Time period = chip.t_ma;
    chip.write(reg::kAddrSlaveloc5,
               {reg::kResetSlaveloc5 | reg::kSlaveloc5Split, reg::kCfgch2Ssi | reg::kCfgch1Unused});
    chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 7, 0, 0x00, 0x00});
    const std::string bits = mb4test::to_bits(0xA7, 8);
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.simulator.run_while_waiting(
        [&] { return !chip.simulator.pin(sim::Pin::kMa2); }, chip.simulator.now() + 1'000'000'000));
    const sim::Time first = chip.simulator.now() + period / 2;  // first rising edge
    for (unsigned i = 0; i < 8; ++i) {
      const bool level = bits[i] == '1';
      const sim::Time edge = first + (i + 1) * period;
      chip.simulator.at(edge - 30'000,
                        [&chip, level] { chip.simulator.set_pin(sim::Pin::kSl2, level); });
      chip.simulator.at(edge + 1,
                        [&chip, level] { chip.simulator.set_pin(sim::Pin::kSl2, !level); });
    }
    chip.simulator.at(first + 10 * period,
                      [&chip] { chip.simulator.set_pin(sim::Pin::kSl2, true); });
    chip.simulator.advance(40 * period);
    EXPECT_EQ(chip.scdata(5, 8), 0xA7U) << freqs;
  }
}

// Table 19: without GRAYSx the same line gives the code itself.
TEST(ChipSsi, GraysOff_LeavesTheCode) {
  ProtocolChip chip(encoder(13, "gray = true\ndata = 0x1234"), {.freqs = 9});
  ASSERT_TRUE(chip.frame());
  EXPECT_EQ(chip.scdata(1, 13), 0x1234U);
  chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 12});
  ASSERT_TRUE(chip.frame());
  EXPECT_EQ(chip.scdata(1, 13), 0x1234U ^ (0x1234U >> 1U));
}

// A CRC after the word, right and wrong.
TEST(ChipSsi, WithCrc_IsChecked) {
  ProtocolChip chip(encoder(24, "crc = 0x43\ndata = 0xC0FFEE"), {.freqs = 9});
  ASSERT_TRUE(chip.frame());
  EXPECT_EQ(chip.scdata(1, 24), 0xC0FFEEU);
  EXPECT_EQ(chip.status(), reg::kResetStatus0);
  for (const unsigned bit : {0U, 11U, 23U, 24U, 29U}) {
    clocked(chip.simulator.line(1))->faults().flip_next_frame({bit});
    ASSERT_TRUE(chip.frame());
    EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nSCDERR::kMask), 0U) << bit;
    EXPECT_EQ(chip.svalid(), 0U) << bit;
    ASSERT_TRUE(chip.frame());
    EXPECT_EQ(chip.svalid(), 2U) << bit;
  }
}

// AGSMIN waits for SL = 1 at the end of the monoflop time: every frame is a new one.
TEST(ChipSsi, Agsmin_ReadsEveryWordOnce) {
  ProtocolChip chip(encoder(25, "source = \"ramp\"\ngray = true"), {.freqs = 9});
  chip.instruct(reg::kAgsOn);
  std::uint64_t last = 0;
  // 26 us of clock and 20 us of monoflop time; a look takes about 38 us.
  for (unsigned i = 0; i < 50; ++i) {
    chip.advance_us(30);
    const auto word = chip.scdata(1, 25);
    EXPECT_LE(word - last, 1U);
    last = word;
  }
  EXPECT_GT(last, 35U);
  EXPECT_EQ(chip.status() & (reg::nAGSERR::kMask | reg::nSCDERR::kMask),
            unsigned{reg::kNagserrGood | reg::kNscderrGood});
}

// Multiple transmission: two data channels read the word twice in one frame, the second after one
// 0.
TEST(ChipSsi, Ring_SecondChannelReadsTheSameWord) {
  ProtocolChip chip(encoder(25, "ring = true\ndata = 0x1A5B37C"), {.freqs = 9});
  chip.write(reg::slave_cfg_address(2), {reg::kEnscdYes | 25, 0, 0x00, 0x00});
  ASSERT_TRUE(chip.frame());
  EXPECT_EQ(chip.scdata(1, 25), 0x1A5B37CU);
  EXPECT_EQ(chip.scdata(2, 26), 0x1A5B37CU);
  EXPECT_EQ(chip.svalid(), valid({1, 2}));
}

// Page 16: CDM goes out as the inverted level of MA after the frame.
TEST(ChipSsi, ExtendedSsi_SendsCdmBehindTheFrame) {
  ProtocolChip chip(encoder(13, "control = true\ndata = 0x1234"), {.freqs = 9});
  unsigned count = 0;
  for (const bool cdm : {true, false, true, true, false}) {
    ASSERT_TRUE(chip.frame(cdm ? reg::kInstrCdm1 : reg::kInstrCdm0));
    EXPECT_EQ(clocked(chip.simulator.slave(1))->last_cdm(), cdm);
    EXPECT_EQ(clocked(chip.simulator.slave(1))->cdm_count(), ++count);
    EXPECT_EQ(chip.scdata(1, 13), 0x1234U);
    EXPECT_TRUE(chip.simulator.pin(sim::Pin::kMa1));
  }
}

// Pages 16, 28: the register write of BiSS C without an answer, 1 to 64 bytes.
TEST(ChipSsi, ExtendedSsi_WritesRegistersBlind) {
  for (const unsigned count : {1U, 2U, 3U, 17U, 64U}) {
    ProtocolChip chip(encoder(13, "control = true\ntimeout = 5\ndata = 0x1234"), {.freqs = 9});
    ControlHost host(chip);
    std::vector<std::uint8_t> bytes;
    for (unsigned i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(0x35 * i + 7));
    host.set_write(0, 0x30, bytes);
    EXPECT_TRUE(host.run_ags(1'000'000)) << count;
    for (unsigned i = 0; i < count; ++i) {
      EXPECT_EQ(chip.simulator.slave(1)->reg_read(static_cast<std::uint8_t>(0x30 + i)), bytes[i]);
    }
    const auto& counters = clocked(chip.simulator.slave(1))->control()->counters();
    EXPECT_EQ(counters.writes, count);
    EXPECT_EQ(counters.header_errors + counters.data_errors + counters.protocol_errors, 0U);
    EXPECT_EQ(host.status() & (reg::nAGSERR::kMask | reg::nDELAYERR::kMask | reg::nSCDERR::kMask |
                               reg::nREGERR::kMask | reg::REGEND::kMask),
              unsigned{reg::kNagserrGood | reg::kNdelayerrGood | reg::kNscderrGood |
                       reg::kNregerrGood | reg::kRegendDone})
        << count;  // no error, REGEND
  }
}

TEST(ChipSsi, ExtendedSsi_CannotRead) {
  ProtocolChip chip(encoder(13, "control = true\ntimeout = 5"), {.freqs = 9});
  ControlHost host(chip);
  chip.simulator.slave(1)->reg_write(0x30, 0x5A);
  chip.simulator.slave(1)->reg_write(0x31, 0xA5);
  const std::vector<std::uint8_t> before{0xE1, 0xE2, 0xE3};
  chip.write_rdata(before);
  host.set_read(0, 0x30, 2);
  EXPECT_TRUE(host.run_ags(1'000'000));
  EXPECT_EQ(host.status() & (reg::nREGERR::kMask | reg::REGEND::kMask),
            reg::kRegendDone);  // REGEND, nREGERR = 0
  EXPECT_EQ(host.regbytes(), 0U);
  EXPECT_EQ(host.rdata(3), before) << "page 28: stored after success only";
}

// Page 30: a line that is low is not ready.
TEST(ChipSsi, SlLow_GivesAgsErrorUnlessAgsmin) {
  ProtocolChip chip(encoder(13, "data = 0x1234"), {.freqs = 9, .freqags = 0x00});
  clocked(chip.simulator.line(1))->faults().stick(false);
  chip.simulator.refresh_lines();
  chip.instruct(reg::kInstrCdm0);
  chip.advance_us(100);
  EXPECT_EQ(chip.status() & (reg::nAGSERR::kMask | reg::EOT::kMask), reg::kEotIdle);
  EXPECT_EQ(chip.simulator.slave(1)->frames(), 0U);
}

}  // namespace
