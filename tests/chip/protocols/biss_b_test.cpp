// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// BiSS B on the whole chip: pages 12, 13 (I401 to I407), 16, 28, 30 (Table 36), 32, 34.
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/lines/biss/biss_b_slave.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/protocol_chip.hpp"

namespace {

using mb4test::ChipPlan;
using mb4test::ma_clocks;
using mb4test::ProtocolChip;
using mb4test::to_bits;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

// Register timeout of 80 % of a register clock (I407), sensor timeout of 55 % of T_MA (I306) but
// not below 1 us.
std::string slave(unsigned freqs, unsigned freqr, const std::string& keys = "data_bits = 16\n") {
  const double t_ma_us = ma_clocks(freqs) * 0.05;
  return "[[channel.slave]]\nprotocol = \"biss-b\"\ntimeout = " +
         std::to_string(std::max(1.0, 0.55 * t_ma_us)) +
         "\nregister_timeout = " + std::to_string(0.8 * t_ma_us * (2U << freqr)) + "\n" + keys;
}
std::string channel(unsigned number = 1, const std::string& keys = "") {
  return "[[channel]]\nnumber = " + std::to_string(number) + "\n" + keys;
}

sim::BissBSlave& biss_b(ProtocolChip& chip, unsigned number = 1) {
  return dynamic_cast<sim::BissBSlave&>(*chip.simulator.slave(number));
}

// MA of one access as widths of high and low levels in percent of T_MAR, from the first cell on.
std::string cells(const ProtocolChip& chip, std::size_t first_rise, bool& exact) {
  std::string text;
  exact = true;
  const auto& ma = chip.ma[0];
  for (std::size_t i = first_rise; i + 2 < ma.size(); i += 2) {
    const sim::Time high = ma[i + 1].time - ma[i].time;
    exact = exact && ma[i + 2].time - ma[i].time == chip.t_mar;
    text += 4 * high == chip.t_mar       ? '0'
            : 4 * high == 3 * chip.t_mar ? '1'
            : 2 * high == chip.t_mar     ? 'c'
                                         : '?';
  }
  return text;
}

// CRC4 of x^4 + x + 1, inverted (long division).
std::string with_crc4(const std::string& bits) {
  return bits + to_bits(~std::uint64_t{mb4test::remainder(bits, {4, 0x13}, 0)}, 4);
}

TEST(ChipBissB, SensorFrame_EveryFreqs) {
  for (unsigned freqs = 0; freqs < 32; ++freqs) {
    if (freqs == 0x10) continue;
    ProtocolChip chip(channel() + slave(freqs, 0, "data_bits = 28\nbusy_periods = 2\n"),
                      {.freqs = freqs, .freqr = 0, .biss_c_registers = false});
    chip.simulator.slave(1)->set_data(0xABCDEF7);
    ASSERT_TRUE(chip.frame()) << freqs;
    EXPECT_EQ(chip.scdata(1, 28), 0xABCDEF7U) << freqs;
    EXPECT_EQ(chip.svalid(), 2U);
    EXPECT_EQ(chip.status(), reg::kResetStatus0);
    // N + 4 edges and the processing time: no CDS; MA rests high.
    ASSERT_EQ(chip.ma[0].size(), 2U * (28 + 6 + 4 + 2)) << freqs;
    for (std::size_t i = 1; i < chip.ma[0].size(); ++i) {
      EXPECT_EQ(chip.ma[0][i].time - chip.ma[0][i - 1].time, chip.t_ma / 2);
    }
    EXPECT_TRUE(chip.simulator.pin(sim::Pin::kMa1));
  }
}

TEST(ChipBissB, LineDelay_IsCompensatedInFrames) {
  for (const double delay_ns : {0.0, 17.0, 99.0, 333.0, 1234.5, 20'000.0}) {
    ProtocolChip chip(channel(1, "delay_ns = " + std::to_string(delay_ns) + "\n") +
                          slave(0, 0, "data_bits = 28\n"),
                      {.freqs = 0, .freqr = 0, .biss_c_registers = false});
    chip.simulator.slave(1)->set_data(0xABCDEF7);
    for (unsigned i = 0; i < 3; ++i) {
      ASSERT_TRUE(chip.frame());
      EXPECT_EQ(chip.scdata(1, 28), 0xABCDEF7U) << delay_ns;
    }
  }
}

// Pages 26, 33: banks and nSCDERR belong to sensor frames; a register access is none.
TEST(ChipBissB, RegisterAccess_LeavesDataAndErrorOfTheFrameBefore) {
  ProtocolChip chip(channel() + slave(0, 0, "data_bits = 28\n"),
                    {.freqs = 0, .freqr = 0, .biss_c_registers = false});
  for (const unsigned data : {0x1111111U, 0x2222222U, 0x3333333U}) {
    for (const bool bad : {false, true}) {
      chip.simulator.slave(1)->set_data(data);
      ASSERT_TRUE(chip.frame());
      if (bad) {
        chip.write(reg::SCRCLEN<1>::kAddress,
                   {mb4test::crc_register(0x12F)});  // not the slave's CRC
        ASSERT_TRUE(chip.frame());
        chip.write(reg::SCRCLEN<1>::kAddress, {mb4test::crc_register(reg::SCRCLEN<1>::of(67))});
      }
      const unsigned flags = chip.status();
      EXPECT_EQ(flags & 0x10U, bad ? 0U : 0x10U) << "nSCDERR";
      const std::uint64_t before = chip.scdata(1, 28);
      chip.write_rdata({0xA6});
      chip.set_access(0, 0x21, 1, true);
      ASSERT_TRUE(chip.frame(reg::kInstrControl));
      EXPECT_EQ(chip.status(), flags | 0x04U) << "REGEND";
      EXPECT_EQ(chip.scdata(1, 28), before);
      EXPECT_EQ(before, data);
    }
  }
}

// Both entries, every FREQS with every FREQR (below 500 kHz, unless MB4_BISSB_LENGTHS=1, up to 3):
// one register written and read back.
class BissBClocks : public testing::TestWithParam<std::tuple<unsigned, bool>> {};

TEST_P(BissBClocks, EveryFreqr_WritesAndReadsWithExactCells) {
  const auto [freqs, by_mo] = GetParam();
  const bool all = freqs < 0x10 || mb4test::number_from("MB4_BISSB_LENGTHS", 0) != 0;
  for (unsigned freqr = 0; freqr < (all ? 8U : 4U); ++freqr) {
    ProtocolChip chip(channel(1, by_mo ? "mo = true\n" : "") + slave(freqs, freqr),
                      {.freqs = freqs, .freqr = freqr, .biss_c_registers = false, .en_mo = by_mo});
    const unsigned id = by_mo ? 1 : 0;
    const unsigned address = 0x21 + freqr;
    const unsigned value = 0xA6 ^ freqr;
    const std::string what = std::to_string(freqs) + " " + std::to_string(freqr);
    for (const bool write : {true, false}) {
      chip.write_rdata({static_cast<std::uint8_t>(write ? value : 0)});
      chip.set_access(id, address, 1, write);
      ASSERT_TRUE(chip.frame(reg::kInstrControl)) << what;
      EXPECT_EQ(chip.status(), reg::kResetStatus0 | reg::kRegendDone) << what;
      EXPECT_EQ(chip.read(reg::kAddrStatus3) & reg::REGBYTES::kMask, 0U)
          << what;  // REGBYTES: after an error only
      EXPECT_EQ(biss_b(chip).access().counters().protocol_errors, 0U) << what;
      EXPECT_EQ(chip.simulator.slave(1)->reg_read(static_cast<std::uint8_t>(address)), value);
      if (by_mo) {
        EXPECT_EQ(chip.ma[0][1].time - chip.ma[0][0].time, chip.t_mar / 2) << what;
      }
      // I401 to I404, from the first rising edge on.
      bool exact = false;
      std::string header(1, '1');
      header += with_crc4(to_bits(id, 3) + to_bits(address, 7) + (write ? "1" : "0"));
      header += '0';
      const std::string sent = cells(chip, 1, exact);
      EXPECT_TRUE(exact) << what;
      if (write) {
        header += '1';
        header += with_crc4(to_bits(value, 8));
        EXPECT_EQ(sent, header + '0') << what;
      } else {
        ASSERT_GE(sent.size(), header.size() + 13) << what;
        EXPECT_EQ(sent.substr(0, header.size()), header) << what;
        EXPECT_EQ(sent.substr(header.size()), std::string(sent.size() - header.size(), 'c'))
            << what;
      }
    }
    EXPECT_EQ(chip.read(reg::kAddrRdata), value) << what;
    EXPECT_EQ(biss_b(chip).handshakes(), by_mo ? 0U : 2U);
    EXPECT_EQ(biss_b(chip).mo_selections(), by_mo ? 2U : 0U);
    // And a sensor frame after it.
    chip.simulator.slave(1)->set_data(0x1234);
    ASSERT_TRUE(chip.frame()) << what;
    EXPECT_EQ(chip.scdata(1, 16), 0x1234U) << what;
  }
}

std::vector<unsigned> freqs_codes() {
  std::vector<unsigned> codes;
  for (unsigned code = 0; code < 32; ++code) {
    if (code != 0x10) codes.push_back(code);
  }
  return codes;
}

INSTANTIATE_TEST_SUITE_P(Freqs, BissBClocks,
                         testing::Combine(testing::ValuesIn(freqs_codes()), testing::Bool()),
                         [](const auto& entry) {
                           return std::to_string(std::get<0>(entry.param)) +
                                  (std::get<1>(entry.param) ? "_Mo" : "_HandOver");
                         });

// 1 to 64 bytes; MB4_BISSB_LENGTHS=1 does it at every FREQR of FREQS 0 and 7 (nightly).
TEST(ChipBissB, OneToSixtyFourBytes_AreWrittenAndReadBack) {
  const bool all = mb4test::number_from("MB4_BISSB_LENGTHS", 0) != 0;
  for (const unsigned freqs : {0U, 7U}) {
    for (unsigned freqr = 0; freqr < (all ? 8U : 1U); ++freqr) {
      for (const bool by_mo : {false, true}) {
        ProtocolChip chip(
            channel(1, by_mo ? "mo = true\n" : "") + slave(freqs, freqr),
            {.freqs = freqs, .freqr = freqr, .biss_c_registers = false, .en_mo = by_mo});
        for (unsigned count = 1; count <= 64; ++count) {
          std::vector<std::uint8_t> bytes;
          for (unsigned i = 0; i < count; ++i) {
            bytes.push_back(static_cast<std::uint8_t>(count * 7 + i * 31));
          }
          const unsigned address = (count * 5) % 128;
          chip.write_rdata(bytes);
          chip.set_access(by_mo ? 1 : 0, address, count, true);
          ASSERT_TRUE(chip.frame(reg::kInstrControl)) << count;
          ASSERT_EQ(chip.status(), reg::kResetStatus0 | reg::kRegendDone) << count;
          chip.write_rdata(std::vector<std::uint8_t>(64, 0));
          chip.set_access(by_mo ? 1 : 0, address, count, false);
          ASSERT_TRUE(chip.frame(reg::kInstrControl)) << count;
          ASSERT_EQ(chip.status(), reg::kResetStatus0 | reg::kRegendDone) << count;
          EXPECT_EQ(chip.read(reg::kAddrRdata, count), bytes) << count;
          for (unsigned i = 0; i < count; ++i) {
            EXPECT_EQ(
                chip.simulator.slave(1)->reg_read(static_cast<std::uint8_t>((address + i) % 128)),
                bytes[i])
                << count;
          }
        }
      }
    }
  }
}

// I405, I406: an answer may take a register clock less 30 ns.
TEST(ChipBissB, LongestCable_IsARegisterClockLessThirtyNs) {
  for (const unsigned freqr : {0U, 1U, 3U}) {
    const double t_mar = 100.0 * (2U << freqr);
    for (const double delay : {0.0, t_mar / 2, t_mar - 30}) {
      ProtocolChip chip(
          channel(1, "delay_ns = " + std::to_string(delay) + "\n") +
              slave(0, freqr, "data_bits = 16\nregisters = { 0x10 = [0x5A, 0xC3, 0x00, 0xFF] }\n"),
          {.freqs = 0, .freqr = freqr, .biss_c_registers = false});
      chip.set_access(0, 0x10, 4, false);
      ASSERT_TRUE(chip.frame(reg::kInstrControl)) << delay;
      EXPECT_EQ(chip.status(), reg::kResetStatus0 | reg::kRegendDone) << delay;
      EXPECT_EQ(chip.read(reg::kAddrRdata, 4), (std::vector<std::uint8_t>{0x5A, 0xC3, 0x00, 0xFF}))
          << delay;
      chip.write_rdata({0x12, 0x34});
      chip.set_access(0, 0x20, 2, true);
      ASSERT_TRUE(chip.frame(reg::kInstrControl)) << delay;
      EXPECT_EQ(chip.status(), reg::kResetStatus0 | reg::kRegendDone) << delay;
      EXPECT_EQ(chip.simulator.slave(1)->reg_read(0x21), 0x34) << delay;
    }
  }
}

TEST(ChipBissB, BusySlave_IsWaitedForBeforeEachByte) {
  for (const unsigned busy : {1U, 7U, 300U, 4000U}) {
    ProtocolChip chip(
        channel() + slave(0, 0,
                          "data_bits = 16\nread_busy_clocks = " + std::to_string(busy) +
                              "\nregisters = { 0x10 = [1, 2, 3] }\n"),
        {.freqs = 0, .freqr = 0, .biss_c_registers = false});
    chip.set_access(0, 0x10, 3, false);
    ASSERT_TRUE(chip.frame(reg::kInstrControl)) << busy;
    EXPECT_EQ(chip.status(), reg::kResetStatus0 | reg::kRegendDone) << busy;
    EXPECT_EQ(chip.read(reg::kAddrRdata, 3), (std::vector<std::uint8_t>{1, 2, 3})) << busy;
  }
}

// Decision 6: no start bit within 4096 register clocks gives nDELAYERR = 0.
TEST(ChipBissB, MissingRegister_EndsAfter4096Clocks) {
  ProtocolChip chip(channel() + slave(0, 1, "data_bits = 16\nmissing = [0x12]\n"),
                    {.freqs = 0, .freqr = 1, .biss_c_registers = false});
  chip.set_access(0, 0x10, 5, false);
  ASSERT_TRUE(chip.run(reg::kInstrControl));
  EXPECT_EQ(
      chip.status() & (reg::nDELAYERR::kMask | reg::nREGERR::kMask | reg::REGEND::kMask),
      unsigned{reg::kNregerrGood | reg::kRegendDone});  // nDELAYERR = 0, nREGERR = 1, REGEND = 1
  EXPECT_EQ(chip.read(reg::kAddrStatus3) & reg::REGBYTES::kMask, 2U);  // bytes before it
  const sim::Time clocked = chip.ma[0].back().time - chip.ma[0].front().time;
  EXPECT_GE(clocked, 4096 * chip.t_mar);
  EXPECT_LE(clocked, (4096 + 17 + 3 * 14 + 10) * chip.t_mar);
}

TEST(ChipBissB, WrongCrcAndSilentSlave_AreReported) {
  ProtocolChip chip(channel() + slave(0, 0), {.freqs = 0, .freqr = 0, .biss_c_registers = false});
  biss_b(chip).access().set_wrong_data_crc(true);
  const std::vector<std::uint8_t> before{0xE1, 0xE2, 0xE3};
  chip.write_rdata(before);
  chip.set_access(0, 0x10, 2, false);
  ASSERT_TRUE(chip.frame(reg::kInstrControl));
  EXPECT_EQ(chip.status() & (reg::nREGERR::kMask | reg::REGEND::kMask), reg::kRegendDone);
  EXPECT_EQ(chip.read(reg::kAddrStatus3) & reg::REGBYTES::kMask, 0U);
  EXPECT_EQ(chip.read(reg::kAddrRdata, 3), before) << "page 28: stored after success only";
  biss_b(chip).access().set_wrong_data_crc(false);
  biss_b(chip).access().set_silent(true);
  chip.write_rdata({0x12});
  chip.set_access(0, 0x10, 1, true);
  ASSERT_TRUE(chip.frame(reg::kInstrControl));
  EXPECT_EQ(chip.status() & (reg::nREGERR::kMask | reg::REGEND::kMask), reg::kRegendDone);
  biss_b(chip).access().set_silent(false);
  ASSERT_TRUE(chip.frame(reg::kInstrControl));
  EXPECT_EQ(chip.status(), reg::kResetStatus0 | reg::kRegendDone);
  EXPECT_EQ(chip.simulator.slave(1)->reg_read(0x10), 0x12);
}

// No hand-over: nAGSERR = 0 (decision 7); BREAK and the next frame work.
TEST(ChipBissB, NoHandOver_IsAnAgsError) {
  ProtocolChip chip(channel() + slave(0, 0), {.freqs = 0, .freqr = 0, .biss_c_registers = false});
  clocked(chip.simulator.line(1))->faults().stick(true);
  chip.set_access(0, 0x10, 1, false);
  ASSERT_TRUE(chip.run(reg::kInstrControl, 10'000));
  EXPECT_EQ(chip.status() & (reg::nAGSERR::kMask | reg::nDELAYERR::kMask | reg::nREGERR::kMask |
                             reg::REGEND::kMask | reg::EOT::kMask),
            unsigned{reg::kNdelayerrGood | reg::kNregerrGood | reg::kRegendDone | reg::kEotIdle});
  clocked(chip.simulator.line(1))->faults().stick(std::nullopt);
  chip.simulator.refresh_lines();
  chip.instruct(reg::kBreakAbort);
  chip.advance_us(100);
  chip.simulator.slave(1)->set_data(0x1234);
  ASSERT_TRUE(chip.frame());
  EXPECT_EQ(chip.scdata(1, 16), 0x1234U);
}

// Page 33: BREAK anywhere in an access, in its hand-over and in every cell: idle at once, MA and MO
// at rest, all flags good, no byte that the host or the slave has not sent; the next one works.
TEST(ChipBissB, BreakInAnyCell_EndsItAndTheNextAccessWorks) {
  for (const bool by_mo : {false, true}) {
    for (const bool writing : {false, true}) {
      unsigned in_cells = 0;
      ProtocolChip chip(channel(1, by_mo ? "mo = true\n" : "") +
                            slave(0, 1, "data_bits = 16\nregisters = { 0x10 = [0x51, 0x52] }\n"),
                        {.freqs = 0, .freqr = 1, .biss_c_registers = false, .en_mo = by_mo});
      const unsigned id = by_mo ? 1 : 0;
      const std::vector<std::uint8_t> host_bytes{0xE1, 0xE2};
      const std::vector<std::uint8_t> slave_bytes{0x51, 0x52};
      // 17 cells of address, 14 of each byte, 400 ns each; steps that meet every quarter of a cell.
      for (unsigned phase = 0; phase < 220; ++phase) {
        for (unsigned i = 0; i < 2; ++i) {
          chip.simulator.slave(1)->reg_write(static_cast<std::uint8_t>(0x10 + i), slave_bytes[i]);
        }
        chip.write_rdata(host_bytes);
        chip.set_access(id, 0x10, 2, writing);
        chip.instruct(reg::kInstrControl);
        chip.simulator.advance(phase * 93 * sim::kPsPerNs);
        if (!chip.simulator.pin(sim::Pin::kEot)) ++in_cells;
        chip.instruct(reg::kBreakAbort);
        chip.advance_us(1);
        EXPECT_TRUE(chip.simulator.pin(sim::Pin::kEot)) << phase;
        EXPECT_TRUE(chip.simulator.pin(sim::Pin::kMa1)) << phase;
        EXPECT_EQ(chip.simulator.pin(sim::Pin::kMo1), by_mo) << phase;
        EXPECT_EQ(chip.read(reg::kAddrInstr), 0) << phase;
        EXPECT_EQ(chip.status(), reg::kResetStatus0) << phase;
        EXPECT_EQ(chip.read(reg::kAddrStatus3) & reg::REGBYTES::kMask, 0U) << phase;
        const auto rdata = chip.read(reg::kAddrRdata, 2);
        for (unsigned i = 0; i < 2; ++i) {
          const auto held = chip.simulator.slave(1)->reg_read(static_cast<std::uint8_t>(0x10 + i));
          EXPECT_TRUE(rdata[i] == host_bytes[i] || (!writing && rdata[i] == slave_bytes[i]))
              << phase;
          EXPECT_TRUE(held == slave_bytes[i] || (writing && held == host_bytes[i])) << phase;
        }
        chip.advance_us(5);  // the slave's register timeout
        ASSERT_TRUE(chip.frame(reg::kInstrControl)) << phase;
        EXPECT_EQ(chip.status(), reg::kResetStatus0 | reg::kRegendDone) << phase;
        EXPECT_EQ(chip.read(reg::kAddrRdata, 2), writing ? host_bytes : slave_bytes) << phase;
        if (!writing) continue;
        EXPECT_EQ(chip.simulator.slave(1)->reg_read(0x10), host_bytes[0]) << phase;
        EXPECT_EQ(chip.simulator.slave(1)->reg_read(0x11), host_bytes[1]) << phase;
      }
      EXPECT_GT(in_cells, 150U);
    }
  }
}

// Page 32, Table 46; page 16, figure 16: the first falling edge and the hand-over only.
TEST(ChipBissB, Init_IsTheHandOverAlone) {
  for (const unsigned freqs : {0U, 9U, 0x1FU}) {
    ProtocolChip chip(channel() + slave(freqs, 0),
                      {.freqs = freqs, .freqr = 0, .biss_c_registers = false});
    ASSERT_TRUE(chip.frame(reg::kInitStart));
    EXPECT_EQ(biss_b(chip).handshakes(), 1U);
    ASSERT_EQ(chip.ma[0].size(), 2U) << freqs;
    EXPECT_GE(chip.ma[0][1].time - chip.ma[0][0].time, biss_b(chip).config().timeout.fixed);
    EXPECT_EQ(chip.status(), reg::kResetStatus0) << freqs;
    chip.simulator.slave(1)->set_data(0x1234);
    ASSERT_TRUE(chip.frame());
    EXPECT_EQ(chip.scdata(1, 16), 0x1234U);
  }
}

// IDs in a chain count from the last slave.
TEST(ChipBissB, Chain_EachSlaveByItsId) {
  for (const bool by_mo : {false, true}) {
    std::string text = channel(1, by_mo ? "mo = true\n" : "");
    for (unsigned i = 1; i <= 7; ++i) {
      text += slave(1, 1,
                    "data_bits = 9\nregisters = { 0x10 = " + std::to_string(0x10 * i) +
                        " }\ndata = " + std::to_string(0x100 + i) + "\n");
    }
    ProtocolChip chip(text, {.freqs = 1, .freqr = 1, .biss_c_registers = false, .en_mo = by_mo});
    for (unsigned id = 0; id < 7; ++id) {
      chip.set_access(id + (by_mo ? 1 : 0), 0x10, 1, false);
      ASSERT_TRUE(chip.frame(reg::kInstrControl)) << id;
      EXPECT_EQ(chip.status(), reg::kResetStatus0 | reg::kRegendDone) << id;
      EXPECT_EQ(chip.read(reg::kAddrRdata), 0x10 * (7 - id)) << id;
      ASSERT_TRUE(chip.frame());
      for (unsigned i = 1; i <= 7; ++i) EXPECT_EQ(chip.scdata(i, 9), 0x100U + i);
    }
  }
}

}  // namespace
