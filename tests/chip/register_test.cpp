// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Register map through SPI: datasheet pages 21, 22 (Table 6) and the tables of each register.
#include <gtest/gtest.h>

#include "chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::one_slave;
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
  const auto values = chip.read(0x00, 256);
  for (unsigned address = 0; address < 256; ++address) {
    EXPECT_EQ(values[address], table6(address).fixed) << std::hex << address;
  }
}

TEST(ChipRegisters, WrittenBits_ReadBackAndReservedOnesReadZero) {
  Chip chip("");
  chip.advance_us(4);  // the memories are cleared
  for (unsigned address = 0; address < 256; ++address) {
    if (address == 0xF4 || address == 0xF5) continue;  // instructions and clock: tests of their own
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
  for (unsigned address = 0; address < 0xF0; ++address) {
    chip.write(static_cast<std::uint8_t>(address), {static_cast<std::uint8_t>(address * 37 + 11)});
  }
  for (unsigned address = 0; address < 0xF0; ++address) {
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
    chip.write(0xF5, {value});
    chip.advance_us(1);
    EXPECT_EQ(chip.read(0xF5), value);
  }
}

// Table 43: "keep ENTEST = 0". There is no factory test here: the bit reads back and does nothing.
TEST(ChipRegisters, Entest_ReadsBackAndChangesNothing) {
  for (const unsigned entest : {0x00U, 0x02U}) {
    Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1234567"));
    chip.configure_slave1(28, 0x06, 0x00, 0x00);
    chip.write(0xF5, {static_cast<std::uint8_t>(entest)});
    EXPECT_EQ(chip.read(0xF5), entest);
    for (const unsigned instruction : {0x10U, 0x04U, 0x02U}) {
      chip.instruct(static_cast<std::uint8_t>(instruction));
      ASSERT_TRUE(chip.wait_eot());
      EXPECT_EQ(chip.status(), 0xFB);
      chip.advance_us(50);
    }
    EXPECT_EQ(chip.read(0x00, 4), (std::vector<std::uint8_t>{0x67, 0x45, 0x23, 0x01}));
    EXPECT_EQ(chip.read(0xF1), 0x02);
    EXPECT_EQ(chip.simulator.line(1)->monitor().last(chip.simulator.now()).rising, 28U + 6 + 5);
    EXPECT_TRUE(chip.simulator.slave(1)->last_cdm());
    EXPECT_EQ(chip.read(0xF5), entest);
  }
}

// Decision 32, design: the host domain needs no system clock.
TEST(ChipNoClock, ClkNotConnected_ConfigurationIsWrittenAndRead) {
  Chip chip("[chip]\nf_clk_hz = 0\n");
  for (unsigned address = 0xC0; address < 0xF0; ++address) {
    chip.write(static_cast<std::uint8_t>(address), {static_cast<std::uint8_t>(~address)});
  }
  for (unsigned address = 0xC0; address < 0xF0; ++address) {
    const Bits bits = table6(address);
    EXPECT_EQ(chip.read(static_cast<std::uint8_t>(address)),
              (static_cast<std::uint8_t>(~address) & bits.writable) | bits.fixed)
        << std::hex << address;
  }
  EXPECT_EQ(chip.read(0xEB), 0x84);
  EXPECT_EQ(chip.status(), 0xFB);
  EXPECT_EQ(chip.simulator.clk_cycles(), 0U);
}

// Table 7: the internal oscillator is switched on through the very interface.
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
    EXPECT_EQ(chip.read(0xF8), 0x50 | ((levels & 2U) << 1) | (levels & 1U));
  }
}

// Page 34, Table 60: nERR shows pin NER, also when something outside pulls it low.
TEST(ChipPins, NerPulledLowOutside_NerrIsZeroAndNoOtherFlag) {
  Chip chip("");
  chip.simulator.set_pin(sim::Pin::kNer, false);
  chip.advance_us(1);
  EXPECT_EQ(chip.status(), 0x7B);
  chip.simulator.set_pin(sim::Pin::kNer, true);
  chip.advance_us(1);
  EXPECT_EQ(chip.status(), 0xFB);
}

// Decision 18: writing 0 to SVALIDx clears, writing 1 has no effect.
TEST(ChipSvalid, Writing_ZeroClearsAndOneDoesNothing) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1"));
  chip.configure_slave1(28, 0x06, 0x00);
  chip.write(0xF1, {0xFF});
  EXPECT_EQ(chip.read(0xF1), 0x00);
  chip.instruct(0x04);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(0xF1), 0x02);
  chip.write(0xF1, {0xFF});
  EXPECT_EQ(chip.read(0xF1), 0x02);
  chip.write(0xF1, {0x02});
  EXPECT_EQ(chip.read(0xF1), 0x02);
  chip.write(0xF1, {0xFD});
  EXPECT_EQ(chip.read(0xF1), 0x00);
}

// Page 35: with the CRC off SVALID is set when the data have been read.
TEST(ChipSvalid, CrcOff_IsSetAfterTheFrame) {
  Chip chip(one_slave("data_bits = 12\ncrc = 0\ndata = 0xABC"));
  chip.configure_slave1(12, 0x00, 0x00);
  chip.instruct(0x04);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(0xF1), 0x02);
  EXPECT_EQ(chip.read(0x00, 2), (std::vector<std::uint8_t>{0xBC, 0x0A}));
}

// Table 48: HOLDBANK keeps data and SVALID; the switch follows when it is released.
TEST(ChipBanks, HoldBank_KeepsTheHostsBankUntilReleased) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111", "", ""));
  chip.configure_slave1(28, 0x06, 0x00, 0x7C);
  chip.instruct(0x04);
  ASSERT_TRUE(chip.wait_eot());
  ASSERT_EQ(chip.read(0x00), 0x11);
  chip.simulator.slave(1)->set_data(0x2222222);
  chip.instruct(0x44);  // HOLDBANK and a frame
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(0x00, 4), (std::vector<std::uint8_t>{0x11, 0x11, 0x11, 0x01}));
  EXPECT_EQ(chip.read(0xF1), 0x02);
  chip.write(0xF1, {0x00});
  chip.advance_us(1);
  EXPECT_EQ(chip.read(0xF1), 0x00) << "cleared while held, in the host's bank only";
  EXPECT_EQ(chip.read(0xFB), 0x00);
  chip.instruct(0x00);
  chip.advance_us(1);
  EXPECT_EQ(chip.read(0x00, 4), (std::vector<std::uint8_t>{0x22, 0x22, 0x22, 0x02}));
  EXPECT_EQ(chip.read(0xF1), 0x02) << "SVALID switches with the data";
}

// Page 33, decision 15: another frame due while the switch is held back runs into the other bank
// and the switch is lost: nAGSERR stays 1, SWBANKFAIL = 1 until the next good switch. With the
// quirk no frame runs, nAGSERR = 0, and the switch takes place when HOLDBANK is released.
TEST(ChipBanks, FrameDueWhileSwitchIsPending_OverwritesOrIsOmitted) {
  for (const bool omits : {false, true}) {
    Chip chip(one_slave(
        "data_bits = 28\ncrc = 0x43\ndata = 0x1111111", "",
        std::string("quirks = { AGSERR_ON_HOLDBANK = ") + (omits ? "true }" : "false }")));
    chip.configure_slave1(28, 0x06, 0x00, 0x7C);
    chip.instruct(0x44);
    ASSERT_TRUE(chip.wait_eot());
    chip.advance_us(10);
    EXPECT_EQ(chip.read(0xFB), 0x00);
    chip.simulator.slave(1)->set_data(0x2222222);
    chip.instruct(0x44);
    chip.advance_us(10);
    EXPECT_EQ(chip.simulator.slave(1)->frames(), omits ? 1U : 2U);
    EXPECT_EQ(chip.read(0xFB), 0x01);
    EXPECT_EQ(chip.status() & 0x40, omits ? 0x00 : 0x40);
    EXPECT_EQ(chip.read(0x00), 0x00) << "held";
    chip.instruct(0x00);
    chip.advance_us(1);
    EXPECT_EQ(chip.read(0x00), omits ? 0x11 : 0x22);
    EXPECT_EQ(chip.read(0xFB), 0x00);
  }
}

// HOLDBANK released while a frame runs over the switch that it held back: the banks switch at that
// frame's end, and no word is mixed, whenever the release comes.
TEST(ChipBanks, ReleaseWhileAFrameOverwrites_SwitchesAtItsEnd) {
  for (unsigned clocks = 0; clocks < 120; ++clocks) {
    Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111"));
    chip.configure_slave1(28, 0x06, 0x00, 0x7C);
    chip.instruct(0x44);
    ASSERT_TRUE(chip.wait_eot());
    chip.advance_us(10);
    chip.simulator.slave(1)->set_data(0x2222222);
    chip.instruct(0x44);
    chip.simulator.advance(clocks * 50 * sim::kPsPerNs);
    chip.instruct(0x00);
    const unsigned svalid = chip.read(0xF1);
    if ((chip.status() & 0x01) == 0) {
      ASSERT_EQ(svalid, 0U) << clocks << ": no word before the end";
    }
    ASSERT_TRUE(chip.wait_eot());
    chip.advance_us(1);
    ASSERT_EQ(chip.read(0xF1), 0x02) << clocks;
    ASSERT_EQ(chip.read(0x00, 4), (std::vector<std::uint8_t>{0x22, 0x22, 0x22, 0x02})) << clocks;
  }
}

// Table 48: one byte releases HOLDBANK and requests the next frame.
TEST(ChipBanks, ReleaseAndFrameInOneByte_SwitchAndFrameHappen) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111"));
  chip.configure_slave1(28, 0x06, 0x00, 0x7C);
  chip.instruct(0x44);
  ASSERT_TRUE(chip.wait_eot());
  chip.simulator.slave(1)->set_data(0x2222222);
  chip.instruct(0x04);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.status(), 0xFB);
  EXPECT_EQ(chip.read(0xFB), 0x00);
  EXPECT_EQ(chip.simulator.slave(1)->frames(), 2U);
  EXPECT_EQ(chip.read(0x00), 0x22);
}

// With one bank a frame that is broken off must not leave half-written data marked as valid.
TEST(ChipBanks, SingleBankFrameBrokenOff_SvalidIsZero) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111"));
  chip.configure_slave1(28, 0x06, 0x03, 0x7C);
  chip.write(0xE7, {0x01});
  chip.instruct(0x04);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(0xF1), 0x02);
  chip.advance_us(50);
  chip.instruct(0x04);
  chip.advance_us(10);
  chip.instruct(0x80);
  EXPECT_EQ(chip.read(0xF1), 0x00);
}

// Two lines: unequal lengths end one frame together; a line that is not used stays quiet.
TEST(ChipBanks, TwoLines_UnequalLengthsEndTogether) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111") +
            "[[channel]]\nnumber = 2\ndelay_ns = 333.0\n[[channel.slave]]\n"
            "protocol = \"biss-c\"\ndata_bits = 50\ncrc = 0x25\ndata = 0x2FEDCBA987654\n");
  chip.configure_slave1(28, 0x06, 0x00, 0x7C);
  chip.write(0xD0, {0x40 | 49, 0x05});
  // SLAVELOC5 = 0: channel 2 takes no part for any CFGCH2; slaves 5 to 8 would be on line 1.
  chip.write(0xD0, {0x00});
  chip.write(0xEC, {0x01, 0x05});
  chip.instruct(0x04);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.simulator.line(2)->monitor().frames(), 0U);
  EXPECT_EQ(chip.read(0xF1), 0x02);
  chip.write(0xD0, {0x40 | 49});
  chip.write(0xEC, {0x11, 0x0D});  // CFGCH2: not used
  for (int i = 0; i < 30; ++i) {
    chip.instruct(0x04);
    ASSERT_TRUE(chip.wait_eot());
  }
  EXPECT_EQ(chip.read(0xF1, 2), (std::vector<std::uint8_t>{0x02, 0x00}));
  EXPECT_EQ(chip.simulator.line(2)->monitor().frames(), 0U);
  chip.write(0xED, {0x05});
  chip.instruct(0x04);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(0xF1, 2), (std::vector<std::uint8_t>{0x02, 0x02}));
  EXPECT_EQ(chip.read(0x20, 7),
            (std::vector<std::uint8_t>{0x54, 0x76, 0x98, 0xBA, 0xDC, 0xFE, 0x02}));
  EXPECT_EQ(chip.read(0x00, 4), (std::vector<std::uint8_t>{0x11, 0x11, 0x11, 0x01}));
}

// Table 10, code 0: data channels 5 to 8 are on line 1 behind the others, line 2 takes no part,
// whatever CFGCH2 says. The same slaves with code 1: channel 5 is line 2's.
TEST(ChipBanks, Slaveloc5_SaysWhichLineChannels5To8AreOn) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111") +
            "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 20\ncrc = 0x25\n"
            "data = 0xA5A5A\n[[channel]]\nnumber = 2\n[[channel.slave]]\n"
            "protocol = \"biss-c\"\ndata_bits = 20\ncrc = 0x25\ndata = 0x5B5B5\n");
  chip.configure_slave1(28, 0x06, 0x00, 0x00);
  chip.write(0xD0, {0x40 | 19, 0x05, 0x00, 0x00});
  for (const bool second_line : {false, true, false}) {
    chip.write(0xEC, {static_cast<std::uint8_t>(second_line ? 0x11 : 0x01), 0x05});
    const auto frames = chip.simulator.line(2)->monitor().frames();
    chip.instruct(0x04);
    ASSERT_TRUE(chip.wait_eot());
    chip.advance_us(50);
    EXPECT_EQ(chip.read(0xF1, 2), (std::vector<std::uint8_t>{0x02, 0x02}));
    EXPECT_EQ(chip.read(0x00, 4), (std::vector<std::uint8_t>{0x11, 0x11, 0x11, 0x01}));
    EXPECT_EQ(chip.read(0x20, 3), second_line ? (std::vector<std::uint8_t>{0xB5, 0xB5, 0x05})
                                              : (std::vector<std::uint8_t>{0x5A, 0x5A, 0x0A}));
    EXPECT_EQ(chip.simulator.line(2)->monitor().frames(), frames + (second_line ? 1 : 0));
    EXPECT_EQ(chip.simulator.line(1)->monitor().last(chip.simulator.now()).rising,
              second_line ? 28U + 6 + 5 : 28U + 6 + 20 + 5 + 5);
    EXPECT_EQ(chip.status(), 0xFB);
  }
}

// Table 8, code 3: no device connected. The line keeps quiet, its data and SVALID stay, SL = 0
// there keeps no frame waiting. With neither line in use INSTR clears itself without a frame.
TEST(ChipBanks, LineNotUsed_KeepsQuietAndTheOtherWorks) {
  for (const unsigned unused : {1U, 2U, 3U}) {
    Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111") +
              "[[channel]]\nnumber = 2\n[[channel.slave]]\n"
              "protocol = \"biss-c\"\ndata_bits = 28\ncrc = 0x43\ndata = 0x2222222\n");
    chip.configure_slave1(28, 0x06, 0x00, 0x00);
    chip.write(0xD0, {0x40 | 27, 0x06, 0x00, 0x00});
    chip.write(0xE7, {0x01});  // one bank
    chip.write(0xEC, {0x11, static_cast<std::uint8_t>(0x05U | ((unused & 1U) != 0 ? 3U : 0U) |
                                                      ((unused & 2U) != 0 ? 0xCU : 0U))});
    for (const unsigned x : {0U, 0x20U}) {
      chip.write(static_cast<std::uint8_t>(x), {0xE0, 0xE1, 0xE2, 0xE3});
    }
    for (const unsigned line : {1U, 2U}) {
      if (((unused >> (line - 1)) & 1U) != 0) chip.simulator.line(line)->faults().stick(false);
    }
    chip.simulator.refresh_lines();
    for (const unsigned instruction : {0x04U, 0x02U, 0x10U}) {
      chip.instruct(static_cast<std::uint8_t>(instruction));
      ASSERT_TRUE(chip.wait_eot(100)) << unused << " " << instruction;
      EXPECT_EQ(chip.read(0xF4), 0x00);
      EXPECT_EQ(chip.status(), 0xFB) << unused << " " << instruction;
      if (instruction == 0x10) continue;
      for (const unsigned line : {1U, 2U}) {
        const bool used = ((unused >> (line - 1)) & 1U) == 0;
        const auto byte = static_cast<std::uint8_t>(0x11 * line);
        EXPECT_EQ(chip.read(static_cast<std::uint8_t>(0x20 * (line - 1)), 3),
                  used ? std::vector<std::uint8_t>(3, byte)
                       : (std::vector<std::uint8_t>{0xE0, 0xE1, 0xE2}));
        EXPECT_EQ(chip.read(static_cast<std::uint8_t>(0xF0 + line)), used ? 0x02 : 0x00);
      }
      chip.advance_us(50);
    }
    for (const unsigned line : {1U, 2U}) {
      EXPECT_EQ(chip.simulator.line(line)->monitor().frames(),
                ((unused >> (line - 1)) & 1U) != 0 ? 0U : 3U)
          << unused;
    }
  }
}

// Table 49: each change of SWBANK swaps once; the same value again does nothing.
TEST(ChipBanks, SwBank_EveryChangeSwapsOnce) {
  Chip chip("");
  chip.advance_us(4);  // the memories are cleared
  chip.write(0x00, {0xAA});
  chip.instruct(0x20);
  chip.advance_us(1);
  EXPECT_EQ(chip.read(0x00), 0x00);
  chip.write(0x00, {0x55});
  chip.instruct(0x20);
  chip.advance_us(1);
  EXPECT_EQ(chip.read(0x00), 0x55);
  EXPECT_EQ(chip.read(0xF4), 0x20);
  chip.instruct(0x00);
  chip.advance_us(1);
  EXPECT_EQ(chip.read(0x00), 0xAA);
}

// Table 38: one bank: the host sees the new data at once, nothing swaps.
TEST(ChipBanks, SingleBank_HostAndFrameUseTheSameBank) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111"));
  chip.configure_slave1(28, 0x06, 0x00, 0x7C);
  chip.write(0xE7, {0x01});
  chip.write(0x00, {0xE0, 0xE1, 0xE2, 0xE3, 0xE4});
  for (int i = 0; i < 3; ++i) {
    chip.instruct(0x44);
    ASSERT_TRUE(chip.wait_eot());
    EXPECT_EQ(chip.read(0x00, 5), (std::vector<std::uint8_t>{0x11, 0x11, 0x11, 0x01, 0xE4}));
    EXPECT_EQ(chip.read(0xF1), 0x02);
  }
}

// E08, page 22: NRES resets registers and data memories, also in the middle of a frame.
TEST(ChipReset, NresInAFrame_EverythingReadsItsResetValue) {
  // What is read at once, while the memories are still being cleared.
  for (const unsigned first : {0x00U, 0x3CU, 0x80U, 0xBCU}) {
    Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111"));
    chip.configure_slave1(28, 0x06, 0x00);
    chip.write(0xE2, {0xFF, 0x3F, 0x03});
    chip.write(0xE9, {0xFF});
    std::vector<std::uint8_t> scdata(65, 0xFF);
    scdata[0] = 0x0B;
    std::vector<std::uint8_t> rdata(66, 0xFF);
    rdata[0] = 0x02;
    rdata[1] = 0x80;
    chip.spi(rdata);
    // Both banks, with a word and SVALID1 = 1 in each.
    for (const unsigned swbank : {0x20U, 0x00U}) {
      chip.spi(scdata);
      chip.instruct(static_cast<std::uint8_t>(swbank));
      chip.advance_us(1);
    }
    for (unsigned bank = 0; bank < 2; ++bank) {
      chip.instruct(0x04);
      ASSERT_TRUE(chip.wait_eot());
      chip.advance_us(20);
    }
    for (const unsigned swbank : {0x20U, 0x00U}) {
      chip.instruct(static_cast<std::uint8_t>(swbank));
      chip.advance_us(1);
      ASSERT_EQ(chip.read(0x00, 5), (std::vector<std::uint8_t>{0x11, 0x11, 0x11, 0x01, 0xFF}));
      ASSERT_EQ(chip.read(0x3F), 0xFF);
      ASSERT_EQ(chip.read(0xF1), 0x02);
    }
    chip.instruct(0x02);
    chip.advance_us(2);
    chip.simulator.set_pin(sim::Pin::kNres, false);
    chip.simulator.advance(250 * sim::kPsPerNs);
    EXPECT_TRUE(chip.simulator.pin(sim::Pin::kEot));
    chip.simulator.set_pin(sim::Pin::kNres, true);
    EXPECT_EQ(chip.read(static_cast<std::uint8_t>(first), 4), std::vector<std::uint8_t>(4, 0));
    chip.advance_us(40);
    EXPECT_TRUE(chip.simulator.pin(sim::Pin::kMa1));
    const auto values = chip.read(0x00, 256);
    for (unsigned address = 0; address < 256; ++address) {
      EXPECT_EQ(values[address], table6(address).fixed) << std::hex << address;
    }
    chip.instruct(0x20);
    chip.advance_us(1);
    EXPECT_EQ(chip.read(0x00, 64), std::vector<std::uint8_t>(64, 0)) << "the other bank";
    EXPECT_EQ(chip.read(0xF1, 2), (std::vector<std::uint8_t>{0, 0}));
  }
}

// The data channels' configuration lies in memories, which no reset clears: what was there before
// must show neither to the host nor in a frame.
TEST(ChipReset, OneByteOfAChannelWritten_TheOthersAreZero) {
  for (unsigned byte = 0; byte < 4; ++byte) {
    Chip chip("");
    for (unsigned address = 0xC0; address < 0xE0; ++address) {
      chip.write(static_cast<std::uint8_t>(address), {0xFF});
    }
    chip.simulator.set_pin(sim::Pin::kNres, false);
    chip.advance_us(1);
    chip.simulator.set_pin(sim::Pin::kNres, true);
    chip.advance_us(1);
    chip.write(static_cast<std::uint8_t>(0xC8 + byte), {0xA5});
    const auto values = chip.read(0xC0, 32);
    for (unsigned i = 0; i < 32; ++i) EXPECT_EQ(values[i], i == 8 + byte ? 0xA5 : 0x00) << i;
  }
}

TEST(ChipReset, OnlyLengthWritten_TheFrameHasNoCrc) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0\ndata = 0x1234567"));
  chip.configure_slave1(28, 0x06, 0x00);
  chip.write(0xC1, {0x86, 0xFF, 0xFF});
  chip.simulator.set_pin(sim::Pin::kNres, false);
  chip.advance_us(1);
  chip.simulator.set_pin(sim::Pin::kNres, true);
  chip.advance_us(4);
  chip.write(0xC0, {0x40 | 27});
  chip.write(0xE5, {0x40});
  chip.write(0xED, {0x0D});
  chip.instruct(0x10);  // INIT
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.simulator.line(1)->monitor().frames(), 1U);
  EXPECT_EQ(chip.simulator.line(1)->monitor().last(chip.simulator.now()).rising, 2U);
  EXPECT_EQ(chip.read(0x00), 1) << "the line delay";
  chip.advance_us(40);
  chip.instruct(0x02);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(0x00, 8), (std::vector<std::uint8_t>{0x67, 0x45, 0x23, 0x01, 0, 0, 0, 0}));
  EXPECT_EQ(chip.read(0xF1), 0x02);
}

}  // namespace
