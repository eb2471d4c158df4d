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

// Page 33, decision 15: another frame due while the switch is held back: none runs, SWBANKFAIL = 1,
// nAGSERR = 0; SWBANKFAIL stays until the next good switch.
TEST(ChipBanks, FrameDueWhileSwitchIsPending_IsOmittedAndFlagged) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111"));
  chip.configure_slave1(28, 0x06, 0x00, 0x7C);
  chip.instruct(0x44);
  ASSERT_TRUE(chip.wait_eot());
  chip.advance_us(10);
  chip.instruct(0x44);
  chip.advance_us(10);
  EXPECT_EQ(chip.simulator.slave(1)->frames(), 1U);
  EXPECT_EQ(chip.read(0xFB), 0x01);
  EXPECT_EQ(chip.status() & 0x40, 0x00);
  chip.instruct(0x00);
  chip.advance_us(1);
  EXPECT_EQ(chip.read(0x00), 0x11);
  EXPECT_EQ(chip.read(0xFB), 0x00);
}

// Table 48: HOLDBANK released and the next frame asked for in one byte.
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
  // SLAVELOC5 = 0: channel 2 takes no part whatever CFGCH2 says; slaves 5 to 8 would be on line 1.
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
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111"));
  chip.configure_slave1(28, 0x06, 0x00);
  chip.write(0x80, {1, 2, 3, 4});
  chip.instruct(0x04);
  ASSERT_TRUE(chip.wait_eot());
  chip.advance_us(20);
  chip.instruct(0x02);
  chip.advance_us(2);
  chip.simulator.set_pin(sim::Pin::kNres, false);
  chip.simulator.advance(250 * sim::kPsPerNs);
  EXPECT_TRUE(chip.simulator.pin(sim::Pin::kEot));
  chip.simulator.set_pin(sim::Pin::kNres, true);
  // At once: the memories are still being cleared, the host reads 0 all the same.
  EXPECT_EQ(chip.spi({0x09, 0, 0, 0, 0}), (std::vector<std::uint8_t>{0, 0, 0, 0, 0}));
  chip.advance_us(40);
  EXPECT_TRUE(chip.simulator.pin(sim::Pin::kMa1));
  const auto values = chip.read(0x00, 256);
  for (unsigned address = 0; address < 256; ++address) {
    EXPECT_EQ(values[address], table6(address).fixed) << std::hex << address;
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
  chip.write(0xED, {0x0D});
  chip.instruct(0x08);  // INIT
  ASSERT_TRUE(chip.wait_eot());
  chip.advance_us(40);
  chip.instruct(0x02);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(0x00, 8), (std::vector<std::uint8_t>{0x67, 0x45, 0x23, 0x01, 0, 0, 0, 0}));
  EXPECT_EQ(chip.read(0xF1), 0x02);
}

}  // namespace
