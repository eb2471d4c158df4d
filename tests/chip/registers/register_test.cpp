// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Register map through SPI: datasheet pages 21, 22 (Table 6) and the tables of each register.
#include <gtest/gtest.h>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::one_slave;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

// Table 6 by hand: bits of each address that can be written and read back, and the fixed ones.
struct Bits {
  std::uint8_t writable;
  std::uint8_t fixed;
};
Bits table6(unsigned address) {
  if (address < 0x40) return {0xFF, 0};
  if (address < 0x80) return {0, 0};
  if (address < 0xE0) return {0xFF, 0};
  switch (address) {
    case 0xE2:
      return {0xFF, 0};
    case 0xE3:
      return {0x3F, 0};
    case 0xE4:
      return {0x03, 0};
    case 0xE5:
      return {0xFB, 0};
    case 0xE6:
      return {0xFF, 0};
    case 0xE7:
      return {0x03, 0};
    case 0xE8:
      return {0xFF, 0};
    case 0xE9:
      return {0xFF, 0};
    case 0xEA:
      return {0, 0x20};
    case 0xEB:
      return {0, 0x84};
    case 0xEC:
      return {0x10, 0x01};
    case 0xED:
      return {0x0F, 0};
    case 0xEF:
      return {0xFF, 0};
    case 0xF0:
      return {0, 0xFB};  // decision 27: healthy bus, REGEND 0
    case 0xF5:
      return {0xFF, 0};
    case 0xF8:
      return {0, 0x55};  // '0101', CDS 0, SL1 and SL2 pulled up
    case 0xF9:
      return {0, 0x55};
    default:
      return {0, 0};
  }
}

// Page 22: all RAM registers are 0 after reset; the others as printed.
TEST(ChipRegisters, AfterReset_EveryAddressReadsItsResetValue) {
  Chip chip("");
  const auto values = chip.read(reg::kAddrScdata, 256);
  for (unsigned address = 0; address < 256; ++address) {
    EXPECT_EQ(values[address], table6(address).fixed) << std::hex << address;
  }
}

TEST(ChipRegisters, WrittenBits_ReadBackAndReservedOnesReadZero) {
  Chip chip("");
  chip.advance_us(4);  // the memories are cleared
  for (unsigned address = 0; address < 256; ++address) {
    if (address == reg::kAddrInstr || address == reg::kAddrIface)
      continue;  // instructions and clock: tests of their own
    for (const int pattern : {0xFF, 0x5A, 0xA5, 0x00}) {
      const auto value = static_cast<std::uint8_t>(pattern);
      chip.write(static_cast<std::uint8_t>(address), {value});
      const Bits bits = table6(address);
      EXPECT_EQ(chip.read(static_cast<std::uint8_t>(address)), (value & bits.writable) | bits.fixed)
          << std::hex << address << " <- " << +value;
    }
  }
}

TEST(ChipRegisters, EveryAddressHoldsItsOwnByte) {
  Chip chip("");
  for (unsigned address = 0; address < reg::kAddrStatus0; ++address) {
    chip.write(static_cast<std::uint8_t>(address), {static_cast<std::uint8_t>(address * 37 + 11)});
  }
  for (unsigned address = 0; address < reg::kAddrStatus0; ++address) {
    const Bits bits = table6(address);
    EXPECT_EQ(chip.read(static_cast<std::uint8_t>(address)),
              (static_cast<std::uint8_t>(address * 37 + 11) & bits.writable) | bits.fixed)
        << std::hex << address;
  }
}

// Tables 7, 9, 43, 50..53: 0xF5 reads back; CLKENI with an oscillator on board.
TEST(ChipRegisters, InterfaceByte_ReadsBack) {
  Chip chip("");
  for (const int pattern : {0xFC, 0x0D, 0x51, 0x00}) {
    const auto value = static_cast<std::uint8_t>(pattern);
    chip.write(reg::kAddrIface, {value});
    chip.advance_us(1);
    EXPECT_EQ(chip.read(reg::kAddrIface), value);
  }
}

// Table 43: "keep ENTEST = 0". There is no factory test here: the bit reads back and does nothing.
TEST(ChipRegisters, Entest_ReadsBackAndChangesNothing) {
  for (const unsigned entest : {0x00U, 0x02U}) {
    Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1234567"));
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x00);
    chip.write(reg::kAddrIface, {static_cast<std::uint8_t>(entest)});
    EXPECT_EQ(chip.read(reg::kAddrIface), entest);
    for (const unsigned instruction : {reg::kInitStart, reg::kInstrCdm0, reg::kInstrCdm1}) {
      chip.instruct(static_cast<std::uint8_t>(instruction));
      ASSERT_TRUE(chip.wait_eot());
      EXPECT_EQ(chip.status(), reg::kResetStatus0);
      chip.advance_us(50);
    }
    EXPECT_EQ(chip.read(reg::kAddrScdata, 4), (std::vector<std::uint8_t>{0x67, 0x45, 0x23, 0x01}));
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
    EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now()).rising,
              28U + 6 + 5);
    EXPECT_TRUE(clocked(chip.simulator.slave(1))->last_cdm());
    EXPECT_EQ(chip.read(reg::kAddrIface), entest);
  }
}

// Pages 18, 19, decision 13: from every address on the address grows by one with each byte, and
// goes from 0xFF to 0x00, in writes and in reads.
TEST(ChipRegisters, BurstFromEveryAddress_GrowsByOneAndWraps) {
  Chip chip("");
  chip.simulator.spi().set_timing(sim::SpiTiming::for_frequency(50'000'000));
  chip.simulator.bus().set_timing({});
  const auto value = [](unsigned first, unsigned address) {
    // No instruction, no force bits, and SVALID keeps its zeros.
    if (address >= reg::kAddrStatus0) return std::uint8_t{0};
    return static_cast<std::uint8_t>(address * 37 + first * 11 + 5);
  };
  constexpr unsigned kCount = 0x100 + 8;
  std::vector<std::uint8_t> tx(kCount + 2);
  for (unsigned first = 0; first < 0x100; ++first) {
    tx[0] = reg::kSpiOpcodeWriteRegisters;
    tx[1] = static_cast<std::uint8_t>(first);
    // The second round has other bytes: the last eight addresses hold those.
    for (unsigned i = 0; i < kCount; ++i) {
      tx[i + 2] = value(i < 0x100 ? first : first + 1, (first + i) & 0xFFU);
    }
    chip.spi(tx);
    chip.advance_us(2);
    const auto read = chip.read(static_cast<std::uint8_t>(first), kCount);
    for (unsigned i = 0; i < kCount; ++i) {
      const unsigned address = (first + i) & 0xFFU;
      const bool again = ((address - first) & 0xFFU) < kCount - 0x100;
      const Bits bits = table6(address);
      ASSERT_EQ(read[i], (value(again ? first + 1 : first, address) & bits.writable) | bits.fixed)
          << std::hex << "from " << first << ", address " << address;
    }
  }
}

// Decision 32: the host domain needs no system clock.
TEST(ChipNoClock, ClkNotConnected_ConfigurationIsWrittenAndRead) {
  Chip chip("[chip]\nf_clk_hz = 0\n");
  for (unsigned address = reg::kAddrSlaveCfg; address < reg::kAddrStatus0; ++address) {
    chip.write(static_cast<std::uint8_t>(address), {static_cast<std::uint8_t>(~address)});
  }
  for (unsigned address = reg::kAddrSlaveCfg; address < reg::kAddrStatus0; ++address) {
    const Bits bits = table6(address);
    EXPECT_EQ(chip.read(static_cast<std::uint8_t>(address)),
              (static_cast<std::uint8_t>(~address) & bits.writable) | bits.fixed)
        << std::hex << address;
  }
  EXPECT_EQ(chip.read(reg::kAddrVersion), reg::kVersionIcMb4);
  EXPECT_EQ(chip.status(), reg::kResetStatus0);
  EXPECT_EQ(chip.simulator.clk_cycles(), 0U);
}

// Table 7: a host without a system clock can switch the internal oscillator on.
TEST(ChipNoClock, ClkeniSet_FramesRunFromTheOscillator) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF", "", "f_clk_hz = 0"));
  mb4::Config config = mb4test::config26(10'000'000);
  config.clock_source = mb4::ClockSource::kInternal;
  ASSERT_TRUE(chip.device.configure(config).ok());
  const auto reading = chip.device.read_frame();
  ASSERT_TRUE(reading.ok());
  EXPECT_EQ(reading.value().raw, 0xAAF37BFU);
  EXPECT_GT(chip.simulator.clk_cycles(), 0U);
}

// Table 67: live levels of the pins SL1 and SL2_NSL1.
TEST(ChipPins, SlLevels_ShowInRegisterF8) {
  Chip chip("");
  for (const unsigned levels : {0U, 1U, 2U, 3U, 0U}) {
    chip.simulator.set_pin(sim::Pin::kSl1, (levels & 1U) != 0);
    chip.simulator.set_pin(sim::Pin::kSl2, (levels & 2U) != 0);
    chip.advance_us(1);
    EXPECT_EQ(chip.read(reg::kAddrStatus8), 0x50 | ((levels & 2U) << 1) | (levels & 1U));
  }
}

// Page 34, Table 60: nERR shows pin NER, also when something outside pulls it low.
TEST(ChipPins, NerPulledLowOutside_NerrIsZeroAndNoOtherFlag) {
  Chip chip("");
  chip.simulator.set_pin(sim::Pin::kNer, false);
  chip.advance_us(1);
  EXPECT_EQ(chip.status(), reg::kResetStatus0 & ~reg::nERR::kMask);
  chip.simulator.set_pin(sim::Pin::kNer, true);
  chip.advance_us(1);
  EXPECT_EQ(chip.status(), reg::kResetStatus0);
}

// Decision 18: writing 0 to SVALIDx clears, writing 1 has no effect.
TEST(ChipSvalid, Writing_ZeroClearsAndOneDoesNothing) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1"));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00);
  chip.write(reg::kAddrSvalidLo, {0xFF});
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), 0);
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
  chip.write(reg::kAddrSvalidLo, {0xFF});
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
  chip.write(reg::kAddrSvalidLo, {reg::SVALID<1>::kMask});
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
  chip.write(reg::kAddrSvalidLo, {0xFD});
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), 0);
}

// Page 35: with the CRC off SVALID is set when the data have been read.
TEST(ChipSvalid, CrcOff_IsSetAfterTheFrame) {
  Chip chip(one_slave("data_bits = 12\ncrc = 0\ndata = 0xABC"));
  chip.configure_slave1(12, 0, 0x00);
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
  EXPECT_EQ(chip.read(reg::kAddrScdata, 2), (std::vector<std::uint8_t>{0xBC, 0x0A}));
}

// Page 35: the flag of a word without a CRC comes with its last bit, not before. With one bank the
// host sees it all the time.
TEST(ChipSvalid, CrcOff_IsZeroWhileTheWordComes) {
  constexpr sim::Time kHalf = 8 * sim::kPsPerUs;  // of T_MA = 320 T
  for (const bool ssi : {false, true}) {
    const std::string kind = ssi ? "protocol = \"ssi\"\n" : "protocol = \"biss-c\"\n";
    const std::string word = kind + "data_bits = 12\ncrc = 0\nflag_bits = 0\ntimeout = 400.0\n";
    Chip chip("[host]\ninterface = \"spi\"\n[[channel]]\nnumber = 1\n[[channel.slave]]\n" + word +
              (ssi ? "" : "[[channel.slave]]\n" + word));
    const unsigned words = ssi ? 1 : 2;
    chip.configure_slave1(12, 0, 0x1F, 0xFF);
    chip.write(reg::kAddrBankcfg, {reg::kSinglebankOneBank});
    if (ssi) chip.write(reg::kAddrCfgch, {reg::kCfgch2Unused | reg::kCfgch1Ssi});
    if (!ssi) chip.write(reg::slave_cfg_address(2), {reg::kEnscdYes | 11, 0, 0, 0});
    for (int frame = 0; frame < 2; ++frame) {
      chip.instruct(reg::kInstrCdm0);
      ASSERT_TRUE(
          chip.simulator.run_while_waiting([&] { return !chip.simulator.pin(sim::Pin::kMa1); },
                                           chip.simulator.now() + 50 * sim::kPsPerUs));
      const sim::Time start = chip.simulator.now();
      const auto edges = [&] {  // rising edges of MA so far
        return static_cast<unsigned>((chip.simulator.now() - start + kHalf) / (2 * kHalf));
      };
      const unsigned before = ssi ? 0 : 4;  // edges before those of the words
      const std::uint8_t flags[] = {reg::SVALID<1>::kMask, reg::SVALID<2>::kMask};
      std::array<unsigned, 2> zeros{}, ones{};
      while (!chip.simulator.pin(sim::Pin::kEot)) {
        const unsigned edge = edges();
        const std::uint8_t svalid = chip.read(reg::kAddrSvalidLo);
        if (edges() != edge) continue;  // an edge in the read
        for (unsigned k = 0; k < words; ++k) {
          // Bit 1 of the word comes with the next edge after `last`, its last one 11 edges later.
          const unsigned last = before + 12 * k;
          if (edge > last + 1 && edge < last + 12) {
            EXPECT_EQ(svalid & flags[k], 0) << "word " << k << ", edge " << edge;
            ++zeros[k];
          } else if (edge > last + 13) {
            EXPECT_EQ(svalid & flags[k], flags[k]) << "word " << k << ", edge " << edge;
            ++ones[k];
          }
        }
      }
      for (unsigned k = 0; k < words; ++k) {
        EXPECT_GT(zeros.at(k), 30U) << k;
      }
      EXPECT_TRUE(words == 1 || ones.at(0) > 20U);
      EXPECT_EQ(chip.read(reg::kAddrSvalidLo), words == 2 ? flags[0] | flags[1] : flags[0]);
      chip.advance_us(1000);
    }
  }
}

// Table 48: HOLDBANK keeps data and SVALID; the switch follows when it is released.
TEST(ChipBanks, HoldBank_KeepsTheHostsBankUntilReleased) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111", "", ""));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  ASSERT_EQ(chip.read(reg::kAddrScdata), 0x11);
  chip.simulator.slave(1)->set_data(0x2222222);
  chip.instruct(reg::kHoldbankPrevented | reg::kInstrCdm0);  // HOLDBANK and a frame
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(reg::kAddrScdata, 4), (std::vector<std::uint8_t>{0x11, 0x11, 0x11, 0x01}));
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
  chip.write(reg::kAddrSvalidLo, {0});
  chip.advance_us(1);
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), 0) << "cleared while held, in the host's bank only";
  EXPECT_EQ(chip.read(reg::kAddrSwbankfail), 0);
  chip.instruct(0);
  chip.advance_us(1);
  EXPECT_EQ(chip.read(reg::kAddrScdata, 4), (std::vector<std::uint8_t>{0x22, 0x22, 0x22, 0x02}));
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask)
      << "SVALID switches with the data";
}

// Page 33, decision 15: another frame due while the switch is held back runs into the other bank
// and the switch is lost: nAGSERR stays 1, SWBANKFAIL = 1 until the next good switch. With the
// quirk no frame runs, nAGSERR = 0, and the switch takes place when HOLDBANK is released.
TEST(ChipBanks, FrameDueWhileSwitchIsPending_OverwritesOrIsOmitted) {
  for (const bool omits : {false, true}) {
    Chip chip(one_slave(
        "data_bits = 28\ncrc = 0x43\ndata = 0x1111111", "",
        std::string("quirks = { AGSERR_ON_HOLDBANK = ") + (omits ? "true }" : "false }")));
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
    chip.instruct(reg::kHoldbankPrevented | reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
    chip.advance_us(10);
    EXPECT_EQ(chip.read(reg::kAddrSwbankfail), 0);
    chip.simulator.slave(1)->set_data(0x2222222);
    chip.instruct(reg::kHoldbankPrevented | reg::kInstrCdm0);
    chip.advance_us(10);
    EXPECT_EQ(chip.simulator.slave(1)->frames(), omits ? 1U : 2U);
    EXPECT_EQ(chip.read(reg::kAddrSwbankfail), reg::kSwbankfailFailed);
    EXPECT_EQ(chip.status() & reg::nAGSERR::kMask, omits ? 0 : reg::kNagserrGood);
    EXPECT_EQ(chip.read(reg::kAddrScdata), 0x00) << "held";
    chip.instruct(0);
    chip.advance_us(1);
    EXPECT_EQ(chip.read(reg::kAddrScdata), omits ? 0x11 : 0x22);
    EXPECT_EQ(chip.read(reg::kAddrSwbankfail), 0);
  }
}

// HOLDBANK released while a frame runs over the switch that it held back: the banks switch at that
// frame's end, and no word is mixed, whenever the release comes.
TEST(ChipBanks, ReleaseWhileAFrameOverwrites_SwitchesAtItsEnd) {
  for (unsigned clocks = 0; clocks < 120; ++clocks) {
    Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111"));
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
    chip.instruct(reg::kHoldbankPrevented | reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
    chip.advance_us(10);
    chip.simulator.slave(1)->set_data(0x2222222);
    chip.instruct(reg::kHoldbankPrevented | reg::kInstrCdm0);
    chip.simulator.advance(clocks * 50 * sim::kPsPerNs);
    chip.instruct(0);
    const unsigned svalid = chip.read(reg::kAddrSvalidLo);
    if ((chip.status() & reg::EOT::kMask) == 0) {
      ASSERT_EQ(svalid, 0U) << clocks << ": no word before the end";
    }
    ASSERT_TRUE(chip.wait_eot());
    chip.advance_us(1);
    ASSERT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask) << clocks;
    ASSERT_EQ(chip.read(reg::kAddrScdata, 4), (std::vector<std::uint8_t>{0x22, 0x22, 0x22, 0x02}))
        << clocks;
  }
}

// Table 48: one byte releases HOLDBANK and requests the next frame.
TEST(ChipBanks, ReleaseAndFrameInOneByte_SwitchAndFrameHappen) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111"));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  chip.instruct(reg::kHoldbankPrevented | reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  chip.simulator.slave(1)->set_data(0x2222222);
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.status(), reg::kResetStatus0);
  EXPECT_EQ(chip.read(reg::kAddrSwbankfail), 0);
  EXPECT_EQ(chip.simulator.slave(1)->frames(), 2U);
  EXPECT_EQ(chip.read(reg::kAddrScdata), 0x22);
}

// With one bank a frame that is broken off must not leave half-written data marked as valid.
TEST(ChipBanks, SingleBankFrameBrokenOff_SvalidIsZero) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111"));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x03, reg::kFreqagsAgsMin);
  chip.write(reg::kAddrBankcfg, {reg::kSinglebankOneBank});
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
  chip.advance_us(50);
  chip.instruct(reg::kInstrCdm0);
  chip.advance_us(10);
  chip.instruct(reg::kBreakAbort);
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), 0);
}

// Two lines: unequal lengths end one frame together; a line that is not used stays quiet.
TEST(ChipBanks, TwoLines_UnequalLengthsEndTogether) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111") +
            "[[channel]]\nnumber = 2\ndelay_ns = 333.0\n[[channel.slave]]\n"
            "protocol = \"biss-c\"\ndata_bits = 50\ncrc = 0x25\ndata = 0x2FEDCBA987654\n");
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 49, reg::kScrclenCrc5});
  // SLAVELOC5 = 0: channel 2 takes no part for any CFGCH2; slaves 5 to 8 would be on line 1.
  chip.write(reg::slave_cfg_address(5), {0});
  chip.write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5, reg::kCfgch2BissC | reg::kCfgch1BissC});
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(clocked(chip.simulator.line(2))->monitor().frames(), 0U);
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
  chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 49});
  chip.write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5 | reg::kSlaveloc5Split,
                                   reg::kCfgch2Unused | reg::kCfgch1BissC});  // CFGCH2: not used
  for (int i = 0; i < 30; ++i) {
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
  }
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo, 2),
            (std::vector<std::uint8_t>{reg::SVALID<1>::kMask, 0}));
  EXPECT_EQ(clocked(chip.simulator.line(2))->monitor().frames(), 0U);
  chip.write(reg::kAddrCfgch, {reg::kCfgch2BissC | reg::kCfgch1BissC});
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo, 2),
            (std::vector<std::uint8_t>{reg::SVALID<1>::kMask, reg::SVALID<5>::kMask}));
  EXPECT_EQ(chip.read(reg::scdata_address(5), 7),
            (std::vector<std::uint8_t>{0x54, 0x76, 0x98, 0xBA, 0xDC, 0xFE, 0x02}));
  EXPECT_EQ(chip.read(reg::kAddrScdata, 4), (std::vector<std::uint8_t>{0x11, 0x11, 0x11, 0x01}));
}

// Table 10, code 0: data channels 5 to 8 come after the others on line 1, and line 2 takes no part,
// whatever CFGCH2 says. The same slaves with code 1: channel 5 is line 2's.
TEST(ChipBanks, Slaveloc5_SaysWhichLineChannels5To8AreOn) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111") +
            "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 20\ncrc = 0x25\n"
            "data = 0xA5A5A\n[[channel]]\nnumber = 2\n[[channel.slave]]\n"
            "protocol = \"biss-c\"\ndata_bits = 20\ncrc = 0x25\ndata = 0x5B5B5\n");
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x00);
  chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 19, reg::kScrclenCrc5, 0x00, 0x00});
  for (const bool second_line : {false, true, false}) {
    chip.write(reg::kAddrSlaveloc5,
               {static_cast<std::uint8_t>(second_line ? reg::kResetSlaveloc5 | reg::kSlaveloc5Split
                                                      : reg::kResetSlaveloc5),
                reg::kCfgch2BissC | reg::kCfgch1BissC});
    const auto frames = clocked(chip.simulator.line(2))->monitor().frames();
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
    chip.advance_us(50);
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo, 2),
              (std::vector<std::uint8_t>{reg::SVALID<1>::kMask, reg::SVALID<5>::kMask}));
    EXPECT_EQ(chip.read(reg::kAddrScdata, 4), (std::vector<std::uint8_t>{0x11, 0x11, 0x11, 0x01}));
    EXPECT_EQ(chip.read(reg::scdata_address(5), 3),
              second_line ? (std::vector<std::uint8_t>{0xB5, 0xB5, 0x05})
                          : (std::vector<std::uint8_t>{0x5A, 0x5A, 0x0A}));
    EXPECT_EQ(clocked(chip.simulator.line(2))->monitor().frames(), frames + (second_line ? 1 : 0));
    EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now()).rising,
              second_line ? 28U + 6 + 5 : 28U + 6 + 20 + 5 + 5);
    EXPECT_EQ(chip.status(), reg::kResetStatus0);
  }
}

// Table 8, code 3: no device connected. The line keeps quiet, its data and SVALID stay, SL = 0
// there keeps no frame waiting. With neither line in use INSTR clears itself without a frame.
TEST(ChipBanks, LineNotUsed_KeepsQuietAndTheOtherWorks) {
  for (const unsigned unused : {1U, 2U, 3U}) {
    Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111") +
              "[[channel]]\nnumber = 2\n[[channel.slave]]\n"
              "protocol = \"biss-c\"\ndata_bits = 28\ncrc = 0x43\ndata = 0x2222222\n");
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x00);
    chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 27, reg::kScrclenCrc6, 0x00, 0x00});
    chip.write(reg::kAddrBankcfg, {reg::kSinglebankOneBank});  // one bank
    chip.write(reg::kAddrSlaveloc5,
               {reg::kResetSlaveloc5 | reg::kSlaveloc5Split,
                static_cast<std::uint8_t>(reg::kCfgch2BissC | reg::kCfgch1BissC |
                                          ((unused & 1U) != 0 ? reg::kCfgch1Unused : 0U) |
                                          ((unused & 2U) != 0 ? reg::kCfgch2Unused : 0U))});
    for (const unsigned x : {reg::scdata_address(1), reg::scdata_address(5)}) {
      chip.write(static_cast<std::uint8_t>(x), {0xE0, 0xE1, 0xE2, 0xE3});
    }
    for (const unsigned line : {1U, 2U}) {
      if (((unused >> (line - 1)) & 1U) != 0)
        clocked(chip.simulator.line(line))->faults().stick(false);
    }
    chip.simulator.refresh_lines();
    for (const unsigned instruction : {reg::kInstrCdm0, reg::kInstrCdm1, reg::kInitStart}) {
      chip.instruct(static_cast<std::uint8_t>(instruction));
      ASSERT_TRUE(chip.wait_eot(100)) << unused << " " << instruction;
      EXPECT_EQ(chip.read(reg::kAddrInstr), 0);
      EXPECT_EQ(chip.status(), reg::kResetStatus0) << unused << " " << instruction;
      if (instruction == reg::kInitStart) continue;
      for (const unsigned line : {1U, 2U}) {
        const bool used = ((unused >> (line - 1)) & 1U) == 0;
        const auto byte = static_cast<std::uint8_t>(0x11 * line);
        EXPECT_EQ(chip.read(static_cast<std::uint8_t>(0x20 * (line - 1)), 3),
                  used ? std::vector<std::uint8_t>(3, byte)
                       : (std::vector<std::uint8_t>{0xE0, 0xE1, 0xE2}));
        EXPECT_EQ(chip.read(static_cast<std::uint8_t>(reg::kAddrStatus0 + line)),
                  used ? 0x02 : 0x00);
      }
      chip.advance_us(50);
    }
    for (const unsigned line : {1U, 2U}) {
      EXPECT_EQ(clocked(chip.simulator.line(line))->monitor().frames(),
                ((unused >> (line - 1)) & 1U) != 0 ? 0U : 3U)
          << unused;
    }
  }
}

// Table 49: each change of SWBANK swaps once; the same value again does nothing.
TEST(ChipBanks, SwBank_EveryChangeSwapsOnce) {
  Chip chip("");
  chip.advance_us(4);  // the memories are cleared
  chip.write(reg::kAddrScdata, {0xAA});
  chip.instruct(reg::SWBANK::kMask);
  chip.advance_us(1);
  EXPECT_EQ(chip.read(reg::kAddrScdata), 0x00);
  chip.write(reg::kAddrScdata, {0x55});
  chip.instruct(reg::SWBANK::kMask);
  chip.advance_us(1);
  EXPECT_EQ(chip.read(reg::kAddrScdata), 0x55);
  EXPECT_EQ(chip.read(reg::kAddrInstr), reg::SWBANK::kMask);
  chip.instruct(0);
  chip.advance_us(1);
  EXPECT_EQ(chip.read(reg::kAddrScdata), 0xAA);
}

// Table 38: one bank: the host sees the new data at once, nothing swaps.
TEST(ChipBanks, SingleBank_HostAndFrameUseTheSameBank) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111"));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  chip.write(reg::kAddrBankcfg, {reg::kSinglebankOneBank});
  chip.write(reg::kAddrScdata, {0xE0, 0xE1, 0xE2, 0xE3, 0xE4});
  for (int i = 0; i < 3; ++i) {
    chip.instruct(reg::kHoldbankPrevented | reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
    EXPECT_EQ(chip.read(reg::kAddrScdata, 5),
              (std::vector<std::uint8_t>{0x11, 0x11, 0x11, 0x01, 0xE4}));
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
  }
}

// E08, page 22: NRES resets registers and data memories, also in the middle of a frame.
TEST(ChipReset, NresInAFrame_EverythingReadsItsResetValue) {
  // The first address that the host reads, while the memories are still being cleared.
  for (const unsigned first : {0x00U, 0x3CU, 0x80U, 0xBCU}) {
    Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111"));
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x00);
    chip.write(reg::kAddrRegadr,
               {reg::kWnrWrite | 0x7F, 0x3F, reg::kChsel2Used | reg::kChsel1Used});
    chip.write(reg::kAddrMoBusy, {0xFF});
    std::vector<std::uint8_t> scdata(65, 0xFF);
    scdata[0] = 0x0B;
    std::vector<std::uint8_t> rdata(66, 0xFF);
    rdata[0] = 0x02;
    rdata[1] = reg::kAddrRdata;
    chip.spi(rdata);
    // Both banks, with a word and SVALID1 = 1 in each.
    for (const unsigned swbank : {0x20U, 0x00U}) {
      chip.spi(scdata);
      chip.instruct(static_cast<std::uint8_t>(swbank));
      chip.advance_us(1);
    }
    for (unsigned bank = 0; bank < 2; ++bank) {
      chip.instruct(reg::kInstrCdm0);
      ASSERT_TRUE(chip.wait_eot());
      chip.advance_us(20);
    }
    for (const unsigned swbank : {0x20U, 0x00U}) {
      chip.instruct(static_cast<std::uint8_t>(swbank));
      chip.advance_us(1);
      ASSERT_EQ(chip.read(reg::kAddrScdata, 5),
                (std::vector<std::uint8_t>{0x11, 0x11, 0x11, 0x01, 0xFF}));
      ASSERT_EQ(chip.read(reg::SCDATA<8, 7>::kAddress), 0xFF);
      ASSERT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
    }
    chip.instruct(reg::kInstrCdm1);
    chip.advance_us(2);
    chip.simulator.set_pin(sim::Pin::kNres, false);
    chip.simulator.advance(250 * sim::kPsPerNs);
    EXPECT_TRUE(chip.simulator.pin(sim::Pin::kEot));
    chip.simulator.set_pin(sim::Pin::kNres, true);
    EXPECT_EQ(chip.read(static_cast<std::uint8_t>(first), 4), std::vector<std::uint8_t>(4, 0));
    chip.advance_us(40);
    EXPECT_TRUE(chip.simulator.pin(sim::Pin::kMa1));
    const auto values = chip.read(reg::kAddrScdata, 256);
    for (unsigned address = 0; address < 256; ++address) {
      EXPECT_EQ(values[address], table6(address).fixed) << std::hex << address;
    }
    chip.instruct(reg::SWBANK::kMask);
    chip.advance_us(1);
    EXPECT_EQ(chip.read(reg::kAddrScdata, 64), std::vector<std::uint8_t>(64, 0))
        << "the other bank";
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo, 2), (std::vector<std::uint8_t>{0, 0}));
  }
}

// The data channels' configuration lies in memories, which no reset clears: what was there before
// must show neither to the host nor in a frame.
TEST(ChipReset, OneByteOfAChannelWritten_TheOthersAreZero) {
  for (unsigned byte = 0; byte < 4; ++byte) {
    Chip chip("");
    for (unsigned address = reg::kAddrSlaveCfg; address < reg::slave_cfg_address(9); ++address) {
      chip.write(static_cast<std::uint8_t>(address), {0xFF});
    }
    chip.simulator.set_pin(sim::Pin::kNres, false);
    chip.advance_us(1);
    chip.simulator.set_pin(sim::Pin::kNres, true);
    chip.advance_us(1);
    chip.write(static_cast<std::uint8_t>(reg::slave_cfg_address(3) + byte), {0xA5});
    const auto values = chip.read(reg::slave_cfg_address(1), 32);
    for (unsigned i = 0; i < 32; ++i) EXPECT_EQ(values[i], i == 8 + byte ? 0xA5 : 0x00) << i;
  }
}

TEST(ChipReset, OnlyLengthWritten_TheFrameHasNoCrc) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0\ndata = 0x1234567"));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00);
  chip.write(reg::SCRCLEN<1>::kAddress,
             {reg::kSelcrcsByPolynomial | reg::SCRCPOLY<1>::of(6), 0xFF, 0xFF});
  chip.simulator.set_pin(sim::Pin::kNres, false);
  chip.advance_us(1);
  chip.simulator.set_pin(sim::Pin::kNres, true);
  chip.advance_us(4);
  chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 27});
  chip.write(reg::kAddrCtrl, {reg::kRegversBissC});
  chip.write(reg::kAddrCfgch, {reg::kCfgch2Unused | reg::kCfgch1BissC});
  chip.instruct(reg::kInitStart);  // INIT
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().frames(), 1U);
  EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now()).rising, 2U);
  EXPECT_EQ(chip.read(reg::kAddrScdata), 1) << "the line delay";
  chip.advance_us(40);
  chip.instruct(reg::kInstrCdm1);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(reg::kAddrScdata, 8),
            (std::vector<std::uint8_t>{0x67, 0x45, 0x23, 0x01, 0, 0, 0, 0}));
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
}

}  // namespace
