// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The hosts of the 28-pin device on its pins: parallel bus, SPI2, straps, differential pins, reset
// and clock pins. Datasheet pages 3, 8 to 11, 17 to 19, 23; decisions 13, 32.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/chip/host/host_pins.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::one_slave;
namespace reg = mb4::regs;
namespace sim = mb4::sim;
using sim::Pin;

using Bytes = std::vector<std::uint8_t>;

// Frame number of an eight-byte word that a ramp with step 0x0101010101010101 has sent: 0xFF times
// the step is -1. A torn word gives a huge number.
std::uint64_t frame_of(const Bytes& word) {
  std::uint64_t value = 0;
  for (unsigned i = 8; i-- > 0;) value = value << 8U | word[i];
  return -(value * 0xFF);
}

std::string host(const std::string& name, const std::string& more = "") {
  return more + "\n[host]\ninterface = \"" + name + "\"\ncycle_ns = 110\n";
}

// The host drives the eight data pins.
void drive_bus(sim::Simulator& simulator, unsigned value) {
  for (unsigned bit = 0; bit < 8; ++bit) {
    simulator.set_pin(static_cast<Pin>(static_cast<unsigned>(Pin::kDb0) + bit),
                      ((value >> bit) & 1U) != 0);
  }
}

class ParallelHostChip : public testing::TestWithParam<const char*> {};

// Figures 3 to 6 at the datasheet's shortest times.
TEST_P(ParallelHostChip, EveryAddress_HoldsItsOwnByte) {
  Chip chip(host(GetParam()));
  for (unsigned address = 0; address < reg::kAddrStatus0; ++address) {
    chip.simulator.bus().write(static_cast<std::uint8_t>(address),
                               static_cast<std::uint8_t>(address * 37 + 11));
  }
  chip.advance_us(1);
  for (unsigned address = 0; address < reg::kAddrStatus0; ++address) {
    const unsigned value = (address * 37 + 11) & 0xFFU;
    const auto read = chip.simulator.bus().read(static_cast<std::uint8_t>(address));
    const bool memory = address < 0x40 || (address >= reg::kAddrRdata && address < 0xE0);
    EXPECT_EQ(read, memory ? value : chip.read(static_cast<std::uint8_t>(address))) << address;
    if (address >= 0x40 && address < reg::kAddrRdata) {
      EXPECT_EQ(read, 0);
    }
  }
  EXPECT_EQ(chip.simulator.bus().read(reg::kAddrVersion), reg::kVersionIcMb4);
}

// Page 17: data pins in high impedance outside a read; a read byte stands while its strobe lasts.
TEST_P(ParallelHostChip, DataBus_IsDrivenInReadStrobesOnlyAndStandsStill) {
  Chip chip(host(GetParam()));
  auto& simulator = chip.simulator;
  const bool intel = simulator.bus().mode() == sim::ParallelMode::kIntel;
  const auto data = [&] {
    unsigned value = 0;
    for (unsigned bit = 0; bit < 8; ++bit) {
      const auto pin = static_cast<Pin>(static_cast<unsigned>(Pin::kDb0) + bit);
      value |= (simulator.pin(pin) ? 1U : 0U) << bit;
    }
    return value;
  };
  const auto drive = [&](unsigned value) {
    drive_bus(simulator, value);
    simulator.advance(20'000);
  };
  const auto set = [&](Pin pin, bool level) {
    simulator.set_pin(pin, level);
    simulator.advance(20'000);
  };
  set(Pin::kNcs, false);
  drive(0xF8);  // SL1 and SL2 live
  set(Pin::kAle, true);
  EXPECT_EQ(data(), 0xF8U);
  set(Pin::kAle, false);
  drive(0x00);
  EXPECT_EQ(data(), 0x00U);
  for (const bool sl1 : {true, false, true}) {
    simulator.set_pin(Pin::kSl1, sl1);
    simulator.advance(200'000);
    EXPECT_EQ(data(), 0x00U);
    set(intel ? Pin::kNrdRnw : Pin::kNwrE, !intel);
    EXPECT_EQ(data(), sl1 ? 0x55U : 0x54U);
    simulator.set_pin(Pin::kSl1, !sl1);
    simulator.advance(500'000);
    EXPECT_EQ(data(), sl1 ? 0x55U : 0x54U) << "taken at the start of the strobe";
    set(intel ? Pin::kNrdRnw : Pin::kNwrE, intel);
    EXPECT_EQ(data(), 0x00U);
  }
  // NCS = 1 ends the read too. While NCS = 1 the chip ignores the strobes.
  set(intel ? Pin::kNrdRnw : Pin::kNwrE, !intel);
  EXPECT_EQ(data(), 0x54U);
  set(Pin::kNcs, true);
  EXPECT_EQ(data(), 0x00U);
  set(intel ? Pin::kNrdRnw : Pin::kNwrE, intel);
  simulator.host_check().clear();  // the last one was illegal
}

// Figures 7 and 8: a byte is written at the end of the strobe; what the bus shows before does not
// count (I110: setup before the end).
TEST_P(ParallelHostChip, ByteIsTakenAtTheEndOfTheWriteStrobe) {
  Chip chip(host(GetParam()));
  auto& simulator = chip.simulator;
  const bool intel = simulator.bus().mode() == sim::ParallelMode::kIntel;
  const auto set = [&](Pin pin, bool level) {
    simulator.set_pin(pin, level);
    simulator.advance(50'000);
  };
  const auto drive = [&](unsigned value) {
    drive_bus(simulator, value);
    simulator.advance(50'000);
  };
  set(Pin::kNcs, false);
  set(Pin::kAle, true);
  drive(0xC0);
  set(Pin::kAle, false);
  drive(0x3C);
  if (!intel) set(Pin::kNrdRnw, false);
  set(Pin::kNwrE, !intel);
  drive(0xC3);
  drive(0x5A);
  set(Pin::kNwrE, intel);
  drive(0xFF);
  if (!intel) set(Pin::kNrdRnw, true);
  set(Pin::kNcs, true);
  EXPECT_EQ(chip.read(reg::slave_cfg_address(1)), reg::kEnscdYes | 26);
  simulator.host_check().clear();
}

// Table 1: the serial interface is not there with CFGSPI = 0, nor the parallel one with 1.
TEST_P(ParallelHostChip, SpiFramesOnTheParallelStraps_ChangeNothing) {
  Chip chip(host(GetParam()));
  const auto before = chip.read(reg::slave_cfg_address(1), 0x30);
  const Bytes tx{0x02, 0xC0, 0xFF, 0xFF, 0xFF};
  chip.simulator.spi().transfer(tx, {});
  EXPECT_EQ(chip.read(reg::slave_cfg_address(1), 0x30), before);
  chip.simulator.host_check().clear();
}

INSTANTIATE_TEST_SUITE_P(Hosts, ParallelHostChip, testing::Values("intel", "motorola"));

// Table 1, the other way round: cycles of both buses to every address, with CFGSPI = 1. Each has an
// NCS of its own, so ALE is a single SCLK edge of an incomplete byte (decision 13).
TEST(ChipStraps, BusStrobesOnTheSpiStraps_ChangeNothing) {
  for (const bool intel : {true, false}) {
    Chip chip("[host]\ninterface = \"spi\"\n");
    auto& simulator = chip.simulator;
    simulator.set_pin(Pin::kIntNmot, intel);
    chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 27, reg::kScrclenCrc6, 0x12, 0x34});
    const Bytes before = chip.read(0x00, 0x100);
    const auto set = [&](Pin pin, bool level) {
      simulator.set_pin(pin, level);
      simulator.advance(50 * sim::kPsPerNs);
    };
    const auto strobe = [&](bool read, bool active) {
      if (intel) {
        set(read ? Pin::kNrdRnw : Pin::kNwrE, !active);
      } else {
        set(Pin::kNwrE, active);
      }
    };
    const auto cycle = [&](bool read, unsigned address, unsigned value) {
      drive_bus(simulator, address);
      set(Pin::kNcs, false);
      set(Pin::kAle, true);
      set(Pin::kAle, false);
      if (!intel) set(Pin::kNrdRnw, read);
      drive_bus(simulator, value);
      strobe(read, true);
      for (unsigned bit = 2; bit < 7; ++bit) {
        const auto pin = static_cast<Pin>(static_cast<unsigned>(Pin::kDb0) + bit);
        EXPECT_EQ(simulator.pin(pin), ((value >> bit) & 1U) != 0) << "the chip drives DB" << bit;
      }
      strobe(read, false);
      set(Pin::kNcs, true);
      set(Pin::kNrdRnw, true);
      drive_bus(simulator, 0);
    };
    simulator.set_pin(Pin::kNwrE, intel);
    for (unsigned address = 0; address < 0x100; ++address) {
      for (const unsigned value : {0x00U, 0xFFU, ~unsigned{before[address]} & 0xFFU}) {
        cycle(false, address, value);
      }
      cycle(true, address, 0x00);
      EXPECT_TRUE(simulator.pin(Pin::kEot)) << address;
    }
    simulator.set_pin(Pin::kNwrE, true);
    EXPECT_EQ(chip.read(0x00, 0x100), before) << (intel ? "Intel" : "Motorola");
    simulator.host_check().clear();
  }
}

// HOLDBANK at once followed by a read, while frames end all the time: the word and its SVALID are
// of one frame, at the shortest bus cycles and at the highest SCLK, also with a slow clock.
struct HoldCase {
  const char* interface;
  const char* sclk_hz;
  const char* f_clk_hz;
};
class HoldBankAtOnce : public testing::TestWithParam<HoldCase> {};

TEST_P(HoldBankAtOnce, FirstReadAfterTheWrite_NeverTorn) {
  const HoldCase& one = GetParam();
  Chip chip(std::string("[chip]\nf_clk_hz = ") + one.f_clk_hz + "\n[host]\ninterface = \"" +
            one.interface + "\"\nsclk_hz = " + one.sclk_hz +
            "\ncycle_ns = 110\n[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\n"
            "data_bits = 64\nflag_bits = 0\ncrc = 0\nsource = \"ramp\"\nstart = 0\n"
            "step = 0x0101010101010101\n");
  auto& simulator = chip.simulator;
  const sim::Time clk = sim::kPsPerSecond / simulator.scenario().chip.f_clk_hz;
  const sim::Time period = 20 * 16 * clk;
  chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 63, 0, 0x00, 0x00});
  chip.write(reg::kAddrCtrl, {reg::kRegversBissC, reg::FREQR::of(5), 0, 0x0F});
  chip.write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5, reg::kCfgch2Unused | reg::kCfgch1BissC});
  chip.instruct(reg::kAgsOn);
  simulator.advance(4 * period + 7);
  sim::Time next = simulator.now();
  std::set<std::uint64_t> words;
  unsigned torn = 0;
  unsigned without = 0;
  constexpr unsigned kTurns = 2000;
  for (unsigned i = 0; i < kTurns; ++i) {
    // Around the end of a frame, where the banks switch, in steps of a fraction of a clock.
    simulator.run_until(next);
    next += 3 * period + clk / 9 + (i % 5 == 0 ? period / 400 : 0);
    if (i % 2 == 0) chip.instruct(reg::kHoldbankPrevented | reg::kAgsOn);
    const Bytes word = simulator.scenario().host.parallel() ? chip.read(reg::kAddrScdata, 8) : [&] {
      const auto rx = chip.spi(Bytes{0x09, 0, 0, 0, 0, 0, 0, 0, 0});
      return Bytes(rx.begin() + 1, rx.end());
    }();
    const bool whole = frame_of(word) <= simulator.slave(1)->frames();
    torn += i % 2 == 0 && !whole ? 1U : 0U;
    without += i % 2 != 0 && !whole ? 1U : 0U;
    if (i % 2 == 0) {
      ASSERT_TRUE(whole) << "turn " << i;
      ASSERT_EQ(chip.read(reg::kAddrScdata, 8), word) << "turn " << i;
      words.insert(frame_of(word));
      chip.instruct(reg::kAgsOn);
    }
    next = std::max(next, simulator.now());
  }
  EXPECT_EQ(torn, 0U);
  EXPECT_GT(words.size(), 900U) << "new words all the time";
  std::printf("%u turns, torn without HOLDBANK: %u\n", kTurns, without);
}

INSTANTIATE_TEST_SUITE_P(Hosts, HoldBankAtOnce,
                         testing::Values(HoldCase{"spi", "50_000_000", "20_000_000"},
                                         HoldCase{"spi", "50_000_000", "10_000_000"},
                                         HoldCase{"spi", "50_000_000", "5_000_000"},
                                         HoldCase{"intel", "1_000_000", "20_000_000"},
                                         HoldCase{"motorola", "1_000_000", "10_000_000"}),
                         [](const auto& one) {
                           return std::string(one.param.interface) + "_" +
                                  std::to_string(one.index);
                         });

// SCDATA5..8 filled by the host, read back through SPI2.
class Spi2 : public testing::Test {
 protected:
  Spi2() : chip(host("spi2")) {
    Bytes tx{0x02, 0x00};
    for (unsigned i = 0; i < 64; ++i) tx.push_back(value(i));
    chip.spi(tx);
    chip.advance_us(1);
  }
  static std::uint8_t value(unsigned address) {
    return static_cast<std::uint8_t>(address * 73 + 5);
  }
  static Bytes values(unsigned address, unsigned count) {
    Bytes bytes;
    for (unsigned i = 0; i < count; ++i) bytes.push_back(value(address + i));
    return bytes;
  }
  Bytes spi2(const Bytes& tx) {
    Bytes rx(tx.size());
    chip.simulator.spi2().transfer(tx, rx);
    return rx;
  }
  Bytes read2(unsigned address, unsigned count) {
    Bytes tx(count + 2);
    tx[0] = 0x03;
    tx[1] = static_cast<std::uint8_t>(address);
    const Bytes rx = spi2(tx);
    EXPECT_EQ(rx[0] | rx[1], 0);
    return {rx.begin() + 2, rx.end()};
  }

  Chip chip;
};

// Table 5.
TEST_F(Spi2, BothOpcodes_ReadScdata5To8) {
  for (unsigned address = 0x20; address < 0x40; ++address) {
    EXPECT_EQ(read2(address, 1)[0], value(address));
  }
  EXPECT_EQ(read2(0x20, 32), values(0x20, 32));
  Bytes expected = values(0x20, 32);
  expected.insert(expected.begin(), 0);
  Bytes tx(33);
  tx[0] = 0x09;
  EXPECT_EQ(spi2(tx), expected);
}

// Page 19: nothing but 0x20..0x3F, and no writing.
TEST_F(Spi2, OtherAddressesAndOpcodes_ReadZeroAndChangeNothing) {
  for (unsigned address = 0; address < 0x100; ++address) {
    if (address >= 0x20 && address < 0x40) continue;
    EXPECT_EQ(read2(address, 1)[0], 0) << address;
  }
  Bytes expected{value(0x3E), value(0x3F), 0, 0, 0};
  EXPECT_EQ(read2(0x3E, 5), expected);
  EXPECT_EQ(read2(0x1F, 2), (Bytes{0, value(0x20)}));
  const Bytes before = chip.read(reg::kAddrScdata, 256);
  for (unsigned opcode = 0; opcode < 256; ++opcode) {
    if (opcode == 0x03 || opcode == 0x09) continue;
    EXPECT_EQ(spi2({static_cast<std::uint8_t>(opcode), 0x20, 0xFF, 0xFF, 0x03}),
              (Bytes{0, 0, 0, 0, 0}));
  }
  chip.advance_us(1);
  EXPECT_EQ(chip.read(reg::kAddrScdata, 256), before);
}

// Table 4; the pins of SPI2 in high impedance.
TEST_F(Spi2, NotEnabledOrNotSelected_MisoIsHighImpedance) {
  auto& simulator = chip.simulator;
  const auto clocks = [&] {
    for (unsigned i = 0; i < 16; ++i) {
      simulator.set_pin(Pin::kDb5, true);
      simulator.advance(100'000);
      simulator.set_pin(Pin::kDb5, false);
      simulator.advance(100'000);
      // A pin that the chip does not drive has the level from outside.
      simulator.set_pin(Pin::kDb7, true);
      EXPECT_TRUE(simulator.pin(Pin::kDb7));
      simulator.set_pin(Pin::kDb7, false);
      EXPECT_FALSE(simulator.pin(Pin::kDb7));
    }
  };
  clocks();
  simulator.set_pin(Pin::kNwrE, true);
  simulator.set_pin(Pin::kDb4, false);
  clocks();
  simulator.set_pin(Pin::kDb4, true);
  simulator.advance(20'000);
  simulator.set_pin(Pin::kNwrE, false);
  EXPECT_EQ(read2(0x21, 2), values(0x21, 2));
}

// Page 22: SCDATA reads 0 from the end of a reset on, although its memory is cleared byte by byte.
TEST_F(Spi2, RightAfterAReset_ReadsZero) {
  auto& simulator = chip.simulator;
  simulator.spi2().set_timing(sim::SpiTiming::for_frequency(50'000'000));
  EXPECT_EQ(read2(0x20, 32), values(0x20, 32));
  simulator.set_pin(Pin::kNres, false);
  simulator.advance(250 * sim::kPsPerNs);
  simulator.set_pin(Pin::kNres, true);
  simulator.advance(20'000);
  // The last bytes are cleared last.
  EXPECT_EQ(read2(0x3F, 1), Bytes(1, 0));
  EXPECT_EQ(read2(0x20, 32), Bytes(32, 0));
}

// At the same time as SPI, at unrelated frequencies and phases, both at full speed.
TEST_F(Spi2, BesideSpi_NeitherDisturbsTheOther) {
  auto& simulator = chip.simulator;
  simulator.spi().set_timing(sim::SpiTiming::for_frequency(50'000'000));
  unsigned frames = 0;
  for (const sim::Time half : {10'000U, 11'300U, 23'456U, 50'000U, 111'111U}) {
    for (unsigned round = 0; round < 20; ++round) {
      const unsigned from = 0x20 + round;
      Bytes tx(14);
      tx[0] = 0x03;
      tx[1] = static_cast<std::uint8_t>(from);
      mb4test::BackgroundSpi2 other(simulator, tx);
      other.start(simulator.now() + 1'000 + round * 7'777, half);
      for (unsigned k = 0; !other.done(); ++k) {
        chip.write(reg::slave_cfg_address(2),
                   {static_cast<std::uint8_t>(k), static_cast<std::uint8_t>(round)});
        ASSERT_EQ(chip.read(reg::slave_cfg_address(2), 2),
                  (Bytes{static_cast<std::uint8_t>(k), static_cast<std::uint8_t>(round)}));
        ASSERT_EQ(chip.read(reg::scdata_address(4), 12), values(0x18, 12));
        ++frames;
      }
      ASSERT_EQ(Bytes(other.rx().begin() + 2, other.rx().end()), values(from, 12)) << half;
    }
  }
  EXPECT_GT(frames, 200U);
}

// Page 19, Table 48: sensor data of slave 5 through SPI2 under HOLDBANK, while frames run.
TEST(Spi2Frames, HoldBank_WordsAreWhole) {
  Chip chip(std::string("[host]\ninterface = \"spi2\"\n[[channel]]\nnumber = 2\n") +
            "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 64\nflag_bits = 0\ncrc = 0\n"
            "source = \"ramp\"\nstart = 0\nstep = 0x0101010101010101\n");
  auto& simulator = chip.simulator;
  simulator.spi2().set_timing(sim::SpiTiming::for_frequency(50'000'000));
  chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 63, 0, 0x00, 0x00});
  chip.write(reg::kAddrCtrl, {reg::kRegversBissC, reg::FREQR::of(5), 0, 0x0B});
  chip.write(reg::kAddrSlaveloc5,
             {reg::kResetSlaveloc5 | reg::kSlaveloc5Split, reg::kCfgch2BissC | reg::kCfgch1Unused});
  chip.instruct(reg::kAgsOn);
  chip.advance_us(40);
  std::set<std::uint64_t> seen;
  for (unsigned i = 0; i < 500; ++i) {
    chip.instruct(reg::kHoldbankPrevented | reg::kAgsOn);
    Bytes rx(9);
    simulator.spi2().transfer(Bytes{0x09, 0, 0, 0, 0, 0, 0, 0, 0}, rx);
    const Bytes word(rx.begin() + 1, rx.end());
    ASSERT_LE(frame_of(word), simulator.slave(5)->frames()) << i;
    ASSERT_EQ(chip.read(reg::scdata_address(5), 8), word) << "the driver's SPI2 route, " << i;
    seen.insert(frame_of(word));
    chip.instruct(reg::kAgsOn);
    simulator.advance(12'000'000 + i * 31'000);
  }
  EXPECT_EQ(seen.size(), 500U);
}

// Tables 7 and 9, page 3: with CFGIF = 10, 11 the pins of line 2 are the inverse of line 1.
TEST(ChipPinsPaired, Cfgif_MakesTheSecondPinsTheInverseOfTheFirst) {
  for (const unsigned cfgif : {0U, 1U, 2U, 3U}) {
    Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF"));
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x03, reg::kFreqagsAgsMin);
    chip.write(reg::kAddrIface, {static_cast<std::uint8_t>(cfgif << 2U)});
    unsigned edges = 0;
    bool last = true;
    chip.instruct(reg::kInstrCdm0);
    chip.simulator.run_while_waiting(
        [&] {
          const bool ma1 = chip.simulator.pin(Pin::kMa1);
          edges += ma1 != last ? 1U : 0U;
          last = ma1;
          EXPECT_EQ(chip.simulator.pin(Pin::kMa2), cfgif < 2 || !ma1);
          EXPECT_EQ(chip.simulator.pin(Pin::kMo2), cfgif >= 2 && !chip.simulator.pin(Pin::kMo1));
          return false;
        },
        chip.simulator.now() + 30 * sim::kPsPerUs);
    EXPECT_EQ(edges, 2 * (34 + 5U)) << cfgif;
    // The other input is the cable's as well; line 2 sees 1.
    EXPECT_EQ(chip.simulator.can_set(Pin::kSl2), cfgif < 2);
    EXPECT_EQ(chip.simulator.pin(Pin::kSl2), cfgif < 2);
    chip.simulator.set_pin(Pin::kSl2, false);
    chip.advance_us(1);
    EXPECT_EQ(chip.read(reg::kAddrStatus8) & (reg::SL2::kMask | reg::SL1::kMask),
              cfgif < 2 ? 0x01 : 0x05);
    EXPECT_EQ(chip.read(reg::kAddrScdata, 4), (Bytes{0xBF, 0x37, 0xAF, 0x0A})) << cfgif;
    chip.write(reg::kAddrIface, {0});
    chip.advance_us(1);
    EXPECT_EQ(chip.simulator.pin(Pin::kSl2), cfgif >= 2) << "let go: pull-up";
  }
}

// Table 9, B13, B20: with CFGIF = 10, 11 the receiver takes the difference of SL1 and SL2_NSL1;
// docs/choices.md: equal levels are 1. With 00, 01 each pin is a line of its own.
TEST(ChipPinsPaired, ReceiverPair_TakesTheDifference) {
  Chip chip("[host]\ninterface = \"spi\"\n");
  for (const unsigned cfgif : {0U, 1U, 2U, 3U}) {
    chip.write(reg::kAddrIface, {static_cast<std::uint8_t>(cfgif << 2U)});
    for (const bool sl1 : {true, false}) {
      for (const bool sl2 : {true, false}) {
        chip.simulator.set_pin(Pin::kSl1, sl1);
        chip.simulator.set_pin(Pin::kSl2, sl2);
        chip.advance_us(1);
        const unsigned expected =
            cfgif < 2 ? (sl2 ? 4U : 0U) | (sl1 ? 1U : 0U) : (!sl1 && sl2 ? 4U : 5U);
        EXPECT_EQ(chip.read(reg::kAddrStatus8) & (reg::SL2::kMask | reg::SL1::kMask), expected)
            << cfgif << " " << sl1 << sl2;
      }
    }
  }
}

// A word on the pair, and with one wire at a level that does not change: open (pull-up, 1) or
// shorted to 0. An SSI encoder played by hand.
TEST(ChipPinsPaired, WordOnThePair_IsTheDifference) {
  struct Row {
    unsigned wires;  // that carry the word: 1 SL1, 2 SL2_NSL1
    bool other;      // level of the other one
    unsigned word;
  };
  for (const unsigned cfgif : {2U, 3U}) {
    for (const Row& row : {Row{3, true, 0xA7}, Row{1, true, 0xA7}, Row{1, false, 0xFF},
                           Row{2, true, 0xFF}, Row{2, false, 0xA7}}) {
      Chip chip("[host]\ninterface = \"spi\"\n");
      chip.configure_slave1(8, 0, 0x09, reg::kFreqagsAgsMin);  // 1 MHz
      chip.write(reg::kAddrCfgch, {reg::kCfgch2Unused | reg::kCfgch1Ssi});
      chip.write(reg::kAddrIface, {static_cast<std::uint8_t>(cfgif << 2U)});
      const auto send = [&chip, row](bool level) {
        chip.simulator.set_pin(Pin::kSl1, (row.wires & 1U) != 0 ? level : row.other);
        chip.simulator.set_pin(Pin::kSl2, (row.wires & 2U) != 0 ? !level : row.other);
      };
      send(true);
      chip.instruct(reg::kInstrCdm0);
      ASSERT_TRUE(chip.simulator.run_while_waiting([&] { return !chip.simulator.pin(Pin::kMa1); },
                                                   chip.simulator.now() + 10'000'000));
      const sim::Time first = chip.simulator.now() + 500'000;  // first rising edge
      for (unsigned i = 0; i < 8; ++i) {
        const bool level = ((0xA7U >> (7 - i)) & 1U) != 0;
        chip.simulator.at(first + i * 1'000'000 + 500'000, [send, level] { send(level); });
      }
      chip.simulator.at(first + 8'500'000, [send] { send(true); });
      ASSERT_TRUE(chip.wait_eot());
      EXPECT_EQ(chip.read(reg::kAddrScdata), row.word) << row.wires << " " << row.other;
      EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask) << row.wires;
    }
  }
}

// A BiSS C frame at f_CLK / 2 on SL2_NSL1 alone, SL1 shorted to 0, played by hand: with every
// delay, so that bits are taken at each of the four sampling points, at both edges of CLK.
TEST(ChipPinsPaired, FrameOnOneWire_IsReadAtEveryDelay) {
  for (sim::Time delay = 5'000; delay < 210'000; delay += 5'000) {
    Chip chip("[host]\ninterface = \"spi\"\n");
    chip.configure_slave1(16, 0, 0x00, reg::kFreqagsAgsMin);  // 100 ns
    chip.write(reg::kAddrIface, {reg::kCfgifRs422});
    const auto send = [&chip](bool level) { chip.simulator.set_pin(Pin::kSl2, !level); };
    chip.simulator.set_pin(Pin::kSl1, false);
    send(true);
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.simulator.run_while_waiting([&] { return !chip.simulator.pin(Pin::kMa1); },
                                                 chip.simulator.now() + 10'000'000));
    // Rising edges 2 to 20: acknowledge, start bit, CDS, 16 bits; then 0 and the timeout's end.
    const std::string bits = "0101011001101001010";
    sim::Time edge = chip.simulator.now() + 50'000 + 100'000 + delay;
    for (const char bit : bits) {
      chip.simulator.at(edge, [send, bit] { send(bit == '1'); });
      edge += 100'000;
    }
    chip.simulator.at(edge, [send] { send(false); });
    chip.simulator.at(edge + 1'000'000, [send] { send(true); });
    ASSERT_TRUE(chip.wait_eot(50)) << delay;
    EXPECT_EQ(chip.read(reg::kAddrScdata, 2), (Bytes{0x4A, 0xB3})) << delay;
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask) << delay;
  }
}

// The cable of channel 1 drives both wires: frames, line delay and control data come through; a
// level that is stuck on the line is so on both.
TEST(ChipPinsPaired, CableOnThePair_FramesAndRegistersWork) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF\nregisters = { 0x31 = 0x77 }",
                      "delay_ns = 330.0"));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  chip.write(reg::kAddrIface, {reg::kCfgifRs422});
  chip.instruct(reg::kInitStart);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(reg::kAddrScdata), 14U) << "330 ns in quarters of 100 ns";
  chip.write(reg::kAddrRegadr, {0x31, 0x00});
  chip.write(reg::kAddrCtrl, {reg::kCtsRegisterAccess | reg::kRegversBissC});
  for (unsigned frame = 0; frame < 60 && (chip.status() & reg::REGEND::kMask) == 0; ++frame) {
    chip.instruct(reg::kInstrControl);
    ASSERT_TRUE(chip.wait_eot());
    EXPECT_EQ(chip.read(reg::kAddrScdata, 4), (Bytes{0xBF, 0x37, 0xAF, 0x0A})) << frame;
    chip.advance_us(2);
    EXPECT_NE(chip.simulator.pin(Pin::kSl1), chip.simulator.pin(Pin::kSl2));
  }
  EXPECT_EQ(chip.status(), reg::kResetStatus0 | reg::kRegendDone);
  EXPECT_EQ(chip.read(reg::kAddrRdata), 0x77);
  clocked(chip.simulator.line(1))->faults().stick(false);
  chip.simulator.refresh_lines();
  chip.advance_us(1);
  EXPECT_TRUE(chip.simulator.pin(Pin::kSl2));
  EXPECT_EQ(chip.read(reg::kAddrStatus8) & (reg::SL2::kMask | reg::SL1::kMask), 0x04);
}

// An SPI frame across the end of a reset is no frame.
TEST(ChipResetPins, NresRisesInsideAFrame_TheFrameIsIgnored) {
  for (unsigned clocks = 0; clocks < 40; ++clocks) {
    Chip chip("[host]\ninterface = \"spi\"\n");
    auto& simulator = chip.simulator;
    const std::uint64_t bits = 0x02C0FF02C0FFULL;  // whatever byte it may begin with
    simulator.set_pin(Pin::kNres, false);
    simulator.advance(250 * sim::kPsPerNs);
    simulator.set_pin(Pin::kNcs, false);
    simulator.advance(20'000);
    for (unsigned i = 0; i < 48; ++i) {
      if (i == clocks) simulator.set_pin(Pin::kNres, true);
      simulator.set_pin(Pin::kDb0, ((bits >> (47 - i)) & 1U) != 0);
      simulator.advance(10'000);
      simulator.set_pin(Pin::kAle, true);
      simulator.advance(10'000);
      simulator.set_pin(Pin::kAle, false);
    }
    simulator.advance(10'000);
    simulator.set_pin(Pin::kNcs, true);
    simulator.advance(50'000);
    simulator.host_check().clear();
    EXPECT_EQ(chip.read(reg::slave_cfg_address(1), 0x30)[0], 0x00) << clocks;
    chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 26});
    EXPECT_EQ(chip.read(reg::slave_cfg_address(1)), reg::kEnscdYes | 26) << clocks;
  }
}

// Page 22: the memories are cleared after a reset; what the host writes meanwhile is kept.
class WritesAfterReset : public testing::TestWithParam<const char*> {};

TEST_P(WritesAfterReset, AllDataBytesAtFullSpeed_NoneIsLost) {
  Chip chip(std::string("[chip]\nf_clk_hz = 10_000_000\n[host]\ninterface = \"") + GetParam() +
            "\"\nsclk_hz = 50_000_000\n");
  auto& simulator = chip.simulator;
  simulator.bus().set_timing({});
  simulator.set_pin(Pin::kNres, false);
  simulator.advance(250 * sim::kPsPerNs);
  simulator.set_pin(Pin::kNres, true);
  simulator.advance(20'000);
  const auto value = [](unsigned address) { return static_cast<std::uint8_t>(address * 29 + 1); };
  for (const unsigned begin : {0x00U, 0x80U}) {
    Bytes tx{0x02, static_cast<std::uint8_t>(begin)};
    for (unsigned i = 0; i < 64; ++i) tx.push_back(value(begin + i));
    chip.spi(tx);
  }
  chip.advance_us(20);
  for (const unsigned begin : {0x00U, 0x80U}) {
    const Bytes bytes = chip.read(static_cast<std::uint8_t>(begin), 64);
    for (unsigned i = 0; i < 64; ++i) ASSERT_EQ(bytes[i], value(begin + i)) << begin + i;
  }
}

INSTANTIATE_TEST_SUITE_P(Hosts, WritesAfterReset, testing::Values("spi", "intel", "motorola"));

// Data bytes written without a clock wait for it; of the host's own the last four addresses answer
// at once (decision 36).
TEST(ChipNoClockWrites, DataBytes_TakeEffectWhenTheClockComes) {
  Chip chip("[chip]\nf_clk_hz = 0\n[host]\n");
  chip.write(reg::scdata_address(3), {1, 2, 3, 4, 5, 6, 7, 8, 9});
  chip.advance_us(5);
  EXPECT_EQ(chip.read(reg::scdata_address(3), 9), (Bytes{0, 0, 0, 0, 0, 6, 7, 8, 9}));
  chip.write(reg::kAddrIface, {reg::kClkeniInternal});
  chip.advance_us(20);
  EXPECT_EQ(chip.read(reg::scdata_address(3), 9), (Bytes{1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

// Page 30, Table 35: f_CLK is the clock that CLKENI selects. Both clocks run; T_MA and the pitch of
// automatic frames (Table 37) are multiples of the periods of the selected one.
TEST(ChipClockPin, ClkeniSelectsBetweenTwoLiveClocks_MaAndAgsFollow) {
  struct Clocks {
    const char* keys;
    std::array<sim::Time, 2> period;  // of CLKENI = 0, 1, ps
  };
  for (const Clocks& clocks :
       {Clocks{"f_clk_hz = 20000000\nf_osc_hz = 12500000", {50'000, 80'000}},
        Clocks{"f_clk_hz = 10000000\nf_osc_hz = 25000000", {100'000, 40'000}}}) {
    Chip chip(
        one_slave("data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF\ntimeout = 5.0", "", clocks.keys));
    chip.configure_slave1(28, reg::kScrclenCrc6, reg::FREQS::of(2), 0x31);  // 6 T, 1000 T
    auto& monitor = clocked(chip.simulator.line(1))->monitor();
    for (const unsigned clkeni : {0U, 1U, 0U, 1U}) {
      const sim::Time period = clocks.period.at(clkeni);
      chip.write(reg::kAddrIface, {clkeni != 0 ? reg::kClkeniInternal : std::uint8_t{0}});
      chip.advance_us(200);
      chip.instruct(reg::kAgsOn);
      chip.simulator.advance(2500 * period);
      const sim::MaFrame first = monitor.last(chip.simulator.now());
      chip.simulator.advance(1000 * period);
      const sim::MaFrame second = monitor.last(chip.simulator.now());
      EXPECT_EQ(second.start - first.start, 1000 * period) << clocks.keys << ", " << clkeni;
      for (const sim::Time width :
           {second.min_high, second.max_high, second.min_low, second.max_low}) {
        EXPECT_EQ(width, 3 * period) << clocks.keys << ", " << clkeni;
      }
      chip.instruct(0);
      chip.advance_us(100);
    }
  }
}

// Decision 32, Table 7: a pin CLK that stops after it has run does not keep the oscillator away.
TEST(ChipClockPin, StopsAfterItHasRun_ClkeniStillWorks) {
  for (const bool rest : {false, true}) {
    Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF", "", "f_clk_hz = 0"));
    auto& simulator = chip.simulator;
    for (unsigned i = 0; i < 200; ++i) {
      simulator.set_pin(Pin::kClk, i % 2 == 0);
      simulator.advance(25'000);
    }
    simulator.set_pin(Pin::kClk, rest);
    simulator.advance(25'000);
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
    chip.write(reg::kAddrIface, {reg::kClkeniInternal});
    chip.advance_us(100);
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot()) << rest;
    EXPECT_EQ(chip.read(reg::kAddrScdata, 4), (Bytes{0xBF, 0x37, 0xAF, 0x0A}));
  }
}

}  // namespace
