// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Chips with fewer features, statement by statement of decision 44. The full chip runs the same
// tests. They run for the presets that the build has (MB4_PRESETS).
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/chip/features/core.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::Core;
using mb4test::one_slave;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

const char kEncoder[] = "data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF\ntimeout = \"adaptive\"";
constexpr unsigned kEncoderWord = 0xAAF37BF;

class ChipFeatures : public testing::TestWithParam<Core> {
 protected:
  static std::string key() { return std::string("features = \"") + GetParam().name + "\""; }
  // One BiSS C encoder on channel 1.
  static std::string scenario(const std::string& slave = kEncoder) {
    return one_slave(slave, "", key());
  }
  static std::string two_lines() {
    return scenario() + "[[channel]]\nnumber = 2\n[[channel.slave]]\nprotocol = \"biss-c\"\n" +
           kEncoder + "\n";
  }
  static std::vector<std::uint8_t> zeros(std::size_t count) {
    return std::vector<std::uint8_t>(count, 0x00);
  }
  static std::uint8_t instr(Chip& chip) { return chip.read(reg::kAddrInstr); }
  static unsigned word28(Chip& chip, unsigned x) {
    const auto bytes = chip.read(reg::scdata_address(x), 4);
    return bytes[0] | bytes[1] << 8U | bytes[2] << 16U | static_cast<unsigned>(bytes[3]) << 24U;
  }
  // Levels of the chip's pins MA and MO of a line.
  static bool ma(const Chip& chip, unsigned line) {
    return (chip.simulator.outputs(line) & sim::kMaPin) != 0;
  }
  static bool mo(const Chip& chip, unsigned line) {
    return (chip.simulator.outputs(line) & sim::kMoPin) != 0;
  }
  // Lets time pass; returns the edges of MA of a line meanwhile.
  static unsigned ma_edges(Chip& chip, unsigned line, unsigned us) {
    unsigned edges = 0;
    bool level = ma(chip, line);
    chip.simulator.run_while_waiting(
        [&] {
          edges += ma(chip, line) != level ? 1U : 0U;
          level = ma(chip, line);
          return false;
        },
        chip.simulator.now() + us * sim::kPsPerUs);
    return edges;
  }
  static unsigned rising(Chip& chip, unsigned line) {
    return static_cast<unsigned>(
        clocked(chip.simulator.line(line))->monitor().last(chip.simulator.now()).rising);
  }
  // What decision 37 says of an instruction that cannot run.
  static void expect_ends_at_once(Chip& chip, unsigned instruction, const char* what) {
    chip.instruct(static_cast<std::uint8_t>(reg::kBreakAbort | reg::kAgsOff));
    chip.advance_us(5);
    chip.instruct(static_cast<std::uint8_t>(instruction));
    const unsigned edges = ma_edges(chip, 1, 5);
    EXPECT_TRUE(chip.simulator.pin(sim::Pin::kEot) || (instruction & reg::kAgsOn) != 0) << what;
    EXPECT_EQ(instr(chip), instruction & reg::kAgsOn) << what;
    const unsigned status = chip.status();
    EXPECT_EQ(status & reg::REGEND::kMask, reg::REGEND::kMask) << what;
    EXPECT_EQ(status & reg::nREGERR::kMask, 0U) << what;
    EXPECT_EQ(status & reg::nDELAYERR::kMask, reg::nDELAYERR::kMask) << what;
    if ((instruction & reg::kAgsOn) == 0) {
      EXPECT_EQ(edges, 0U) << what;
    }
    chip.instruct(reg::kBreakAbort);
    chip.advance_us(100);
  }
  // A control communication with automatic frames, as configured.
  static void expect_ends_well(Chip& chip) {
    chip.instruct(reg::kInstrControl | reg::kAgsOn);
    for (unsigned i = 0; i < 200 && (chip.status() & reg::REGEND::kMask) == 0; ++i) {
      chip.advance_us(20);
    }
    EXPECT_EQ(chip.status() | reg::EOT::kMask, 0xFFU);
  }
};

// Of the cores that have it.
class ChipFeaturesControl : public ChipFeatures {};
class ChipFeaturesSsi : public ChipFeatures {};
class ChipFeaturesTwoLines : public ChipFeatures {};
class ChipFeaturesOneLine : public ChipFeatures {};

TEST_P(ChipFeatures, Byte7F_TellsWhatTheCoreHas) {
  Chip chip(scenario());
  EXPECT_EQ(chip.read(0x7F), GetParam().byte);
  // Its neighbours are reserved, and it cannot be written.
  EXPECT_EQ(chip.read(0x7D, 2), zeros(2));
  chip.write(0x7F, {0xFF});
  EXPECT_EQ(chip.read(0x7F), GetParam().byte);
}

TEST_P(ChipFeatures, Frame_BringsTheWordOfChannel1) {
  Chip chip(scenario());
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x03, reg::kFreqagsAgsMin);
  chip.instruct(reg::kInitStart);
  ASSERT_TRUE(chip.wait_eot());
  for (const unsigned word : {kEncoderWord, 0x5555555U, 0xFFFFFFFU, 0x0000001U}) {
    ASSERT_TRUE(chip.simulator.slave(1)->set_data(word));
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
    EXPECT_EQ(word28(chip, 1), word);
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
    EXPECT_EQ(chip.read(reg::kAddrSvalidHi), 0U);
    EXPECT_EQ(chip.status(), reg::kResetStatus0);
    EXPECT_EQ(rising(chip, 1), 28U + 6U + 5U);
  }
}

TEST_P(ChipFeatures, AgsAtItsRate_BringsEachWord) {
  Chip chip(scenario());
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x03, 49);  // 20 x 50 clocks: 50 us
  chip.instruct(reg::kAgsOn | reg::kInstrCdm0);
  chip.advance_us(20);
  const auto frames = chip.simulator.slave(1)->frames();
  chip.advance_us(500);
  EXPECT_EQ(chip.simulator.slave(1)->frames() - frames, 10U);
  EXPECT_EQ(word28(chip, 1), kEncoderWord);
  EXPECT_EQ(chip.status() | reg::EOT::kMask, reg::kResetStatus0);
}

// The driver's comparison of what it has written passes, and it reads what core it has.
TEST_P(ChipFeatures, Driver_KnowsTheCoreAndReadsTheEncoder) {
  const Core& core = GetParam();
  Chip chip(scenario());
  const auto told = mb4::read_features(chip.bus);
  ASSERT_TRUE(told.ok());
  EXPECT_EQ(told->lines, core.lines);
  EXPECT_EQ(told->slaves == 1, core.slaves == 1);
  EXPECT_EQ(told->control, core.control);
  EXPECT_EQ(told->free_crc, core.free_crc);
  mb4::Config config = mb4test::config26(2'500'000);
  config.single_bank = core.banks == 1;
  EXPECT_TRUE(mb4::validate(config, *told).ok());
  ASSERT_TRUE(chip.device.configure(config).ok());
  ASSERT_TRUE(chip.device.initialize().ok());
  const auto frame = chip.device.read_frame(1);
  ASSERT_TRUE(frame.ok());
  EXPECT_TRUE(chip.device.verify().ok());
}

// "Registers of absent data channels read 0 and ignore writes."
TEST_P(ChipFeatures, DataChannelsThatAreAbsent_ReadZeroAndIgnoreWrites) {
  const Core& core = GetParam();
  Chip chip(scenario());
  const auto data = [](unsigned x) {
    return std::vector<std::uint8_t>{
        static_cast<std::uint8_t>(x),       0xFF, 0x5A, 0xA5, 0x01, 0x80, 0x7E,
        static_cast<std::uint8_t>(0xF0 + x)};
  };
  const auto config = [](unsigned x) {
    return std::vector<std::uint8_t>{static_cast<std::uint8_t>(0x80 + x), 0x06, 0xC3,
                                     static_cast<std::uint8_t>(x)};
  };
  const auto write = [&](unsigned address, std::vector<std::uint8_t> bytes) {
    bytes.insert(bytes.begin(),
                 {reg::kSpiOpcodeWriteRegisters, static_cast<std::uint8_t>(address)});
    chip.spi(bytes);
  };
  // Absent ones last: they must not come through at the places of the others.
  for (const bool present : {true, false}) {
    for (unsigned x = 1; x <= 8; ++x) {
      if (core.channel(x) != present) continue;
      write(reg::scdata_address(x), data(x));
      write(reg::slave_cfg_address(x), config(x));
      // At once, while the bytes are on their way (decision 36).
      EXPECT_EQ(chip.read(static_cast<std::uint8_t>(reg::scdata_address(x) + 7)),
                present ? 0xF0 + x : 0U)
          << x;
    }
  }
  chip.advance_us(20);
  for (unsigned x = 1; x <= 8; ++x) {
    EXPECT_EQ(chip.read(reg::scdata_address(x), 8), core.channel(x) ? data(x) : zeros(8)) << x;
    EXPECT_EQ(chip.read(reg::slave_cfg_address(x), 4), core.channel(x) ? config(x) : zeros(4)) << x;
  }
}

// "... ignore writes": such writes take no place of the 128 that wait for the core's clock, and
// hide no byte of the last four addresses, which read back at once. RDATA is absent without
// control.
TEST_P(ChipFeatures, WritesToAbsentDataChannels_TakeNoPlaceOfOthers) {
  const Core& core = GetParam();
  Chip chip(one_slave(kEncoder, "", key() + "\nf_clk_hz = 0"));
  std::vector<std::uint8_t> absent;
  for (unsigned x = 1; x <= 8; ++x) {
    for (unsigned byte = 0; byte < 8 && !core.channel(x); ++byte) {
      absent.push_back(static_cast<std::uint8_t>(reg::scdata_address(x) + byte));
    }
  }
  for (unsigned byte = 0; byte < 64 && !core.control; ++byte) {
    absent.push_back(static_cast<std::uint8_t>(reg::kAddrRdata + byte));
  }
  const std::vector<std::uint8_t> word{0x01, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF};
  chip.write(reg::scdata_address(1), {0x01, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF});
  const std::vector<std::uint8_t> last(word.begin() + 4, word.end());
  for (std::size_t count = 0; count < 150 && !absent.empty(); count += absent.size()) {
    for (const std::uint8_t address : absent) {
      chip.write(address, {static_cast<std::uint8_t>(0x80 + address)});
      ASSERT_EQ(chip.read(reg::scdata_address(1) + 4, 4), last) << unsigned{address};
      ASSERT_EQ(chip.read(address), 0U) << unsigned{address};
    }
  }
  chip.write(reg::kAddrIface, {reg::CLKENI::kMask});
  chip.advance_us(50);
  EXPECT_EQ(chip.read(reg::scdata_address(1), 8), word);
  for (const std::uint8_t address : absent) EXPECT_EQ(chip.read(address), 0U) << unsigned{address};
}

// ENSCDx of an absent data channel is not written either: the chain's frame is that of one word.
TEST_P(ChipFeatures, EnscdOfAnAbsentDataChannel_AddsNoWord) {
  Chip chip(scenario());
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x03, reg::kFreqagsAgsMin);
  for (unsigned x = 2; x <= 8; ++x) {
    if (!GetParam().channel(x))
      chip.write(reg::slave_cfg_address(x), {reg::kEnscdYes | 27, 6, 0, 0});
  }
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(rising(chip, 1), 28U + 6U + 5U);
  EXPECT_EQ(chip.status(), reg::kResetStatus0);
  EXPECT_EQ(word28(chip, 1), kEncoderWord);
}

// "CFGCHx, SLAVELOC5, REGVERS, CHSEL, EN_MO, GRAYSx, SELCRCSx/SCRCLENx, SINGLEBANK, HOLDBANK,
// SWBANK keep and read back what was written."
TEST_P(ChipFeatures, BitsThatChooseSomethingAbsent_ReadBack) {
  Chip chip(scenario());
  for (unsigned value = 0; value < 16; ++value) {
    const auto byte = static_cast<std::uint8_t>(value);
    chip.write(reg::kAddrCfgch, {byte});
    EXPECT_EQ(chip.read(reg::kAddrCfgch), value);
  }
  for (const std::uint8_t byte : {reg::kSlaveloc5Split, reg::kSlaveloc5AllOnChannel1}) {
    chip.write(reg::kAddrSlaveloc5, {byte});
    EXPECT_EQ(chip.read(reg::kAddrSlaveloc5), byte | reg::kResetSlaveloc5);
  }
  for (std::uint8_t value = 0; value < 4; ++value) {
    chip.write(reg::kAddrChsel, {value});
    EXPECT_EQ(chip.read(reg::kAddrChsel), value);
    chip.write(reg::kAddrBankcfg, {value});
    EXPECT_EQ(chip.read(reg::kAddrBankcfg), value);
  }
  const std::uint8_t ctrl = reg::kRegversBissC | reg::kEnMoData | reg::kHoldcdmHold;
  chip.write(reg::kAddrCtrl, {ctrl});
  EXPECT_EQ(chip.read(reg::kAddrCtrl), ctrl);
  chip.write(reg::kAddrFreq, {0xFF, 0x00, 0xA5});
  EXPECT_EQ(chip.read(reg::kAddrFreq, 3), (std::vector<std::uint8_t>{0xFF, 0x00, 0xA5}));
  chip.write(static_cast<std::uint8_t>(reg::slave_cfg_address(1) + 2), {0x34});
  EXPECT_EQ(chip.read(reg::slave_cfg_address(1), 4), (std::vector<std::uint8_t>{0, 0, 0x34, 0}));
  for (const std::uint8_t crc : {std::uint8_t{0x92}, std::uint8_t{0x05}, std::uint8_t{0xA1}}) {
    chip.write(reg::slave_cfg_address(1), {reg::kGraysGray | 27, crc, 0x34, 0x12});
    EXPECT_EQ(chip.read(reg::slave_cfg_address(1), 4),
              (std::vector<std::uint8_t>{reg::kGraysGray | 27, crc, 0x34, 0x12}));
  }
  for (const unsigned byte : {unsigned{reg::HOLDBANK::kMask | reg::SWBANK::kMask}, 0U}) {
    chip.instruct(static_cast<std::uint8_t>(byte));
    EXPECT_EQ(instr(chip), byte) << "at once";
    chip.advance_us(2);
    EXPECT_EQ(instr(chip), byte);
  }
}

// "Without control 0x80..0xBF, 0xE2, 0xE3, CTS, SLAVEID/CMD/IDA_TEST read 0."
TEST_P(ChipFeatures, RegistersOfControl_ReadZeroWithoutIt) {
  const bool control = GetParam().control;
  Chip chip(scenario());
  for (unsigned i = 0; i < 64; ++i) {
    const auto address = static_cast<std::uint8_t>(reg::kAddrRdata + i);
    const auto byte = static_cast<std::uint8_t>(0xFF - i);
    chip.write(address, {byte});
    EXPECT_EQ(chip.read(address), control ? byte : 0U) << "at once " << i;
  }
  chip.advance_us(20);
  for (unsigned i = 0; i < 64; ++i) {
    EXPECT_EQ(chip.read(static_cast<std::uint8_t>(reg::kAddrRdata + i)), control ? 0xFF - i : 0U);
  }
  EXPECT_EQ(chip.read(reg::scdata_address(1), 8), zeros(8)) << "RDATA is not SCDATA";
  chip.write(reg::kAddrRegadr, {0xC5, 0x2A});
  EXPECT_EQ(chip.read(reg::kAddrRegadr, 2),
            control ? (std::vector<std::uint8_t>{0xC5, 0x2A}) : zeros(2));
  chip.write(reg::kAddrCtrl, {reg::kWmaskCtrl});
  const unsigned gone = reg::CTS::kMask | reg::SLAVEID::kMask;
  EXPECT_EQ(chip.read(reg::kAddrCtrl), reg::kWmaskCtrl & ~(control ? 0U : gone));
}

// "Without force bits 0xF5(7:4) reads 0."
TEST_P(ChipFeatures, ForceBits_ReadZeroAndForceNothingWithoutThem) {
  const std::uint8_t bits =
      reg::kMavoLow | reg::kMafoForced | reg::kMavsLow | reg::kMafsForced;  // both lines low
  Chip chip(scenario());
  chip.write(reg::kAddrIface, {bits});
  EXPECT_EQ(chip.read(reg::kAddrIface), GetParam().force ? bits : 0U);
  chip.advance_us(5);
  EXPECT_EQ(ma(chip, 1), !GetParam().force);
  EXPECT_EQ(ma(chip, 2), !(GetParam().force && GetParam().lines == 2));
}

// "Without MO: pin MO = 0 whatever EN_MO says, MO_BUSY and ACTnSENSx read 0."
TEST_P(ChipFeatures, Mo_IsZeroAndHasNoRegistersWithoutIt) {
  const Core& core = GetParam();
  Chip chip(scenario());
  chip.write(reg::kAddrMoBusy, {0xA5});
  EXPECT_EQ(chip.read(reg::kAddrMoBusy), core.mo ? 0xA5U : 0U);
  chip.write(reg::kAddrMoBusy, {0});
  chip.write(reg::kAddrActnsens, {0xFF});
  unsigned channels = 0;
  for (unsigned x = 1; x <= 8; ++x) channels |= core.channel(x) ? 1U << (x - 1) : 0U;
  EXPECT_EQ(chip.read(reg::kAddrActnsens), core.mo ? channels : 0U);
  if (core.mo) return;
  // EN_MO = 1 and an actuator: a sensor as ever, and MO does not move.
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x03, reg::kFreqagsAgsMin);
  chip.write(reg::kAddrCtrl, {reg::kRegversBissC | reg::kEnMoData});
  bool low = true;
  for (const unsigned instruction : {reg::kInitStart, reg::kInstrCdm0}) {
    chip.instruct(static_cast<std::uint8_t>(instruction));
    chip.simulator.run_while_waiting(
        [&] {
          low = low && !mo(chip, 1) && !mo(chip, 2);
          return false;
        },
        chip.simulator.now() + 300 * sim::kPsPerUs);
  }
  EXPECT_TRUE(low);
  EXPECT_EQ(word28(chip, 1), kEncoderWord);
  EXPECT_EQ(chip.status(), reg::kResetStatus0);
}

// "CFGCHx with an absent protocol acts as 11." Low SL does not matter then, and no frame runs.
TEST_P(ChipFeatures, ProtocolThatIsAbsent_ActsAsUnused) {
  const Core& core = GetParam();
  struct Choice {
    std::uint8_t cfgch;
    bool absent;
  };
  for (const Choice& choice :
       {Choice{reg::kCfgch1BissB, !core.biss_b}, Choice{reg::kCfgch1Ssi, !core.ssi},
        Choice{reg::kCfgch1Unused, true}}) {
    if (!choice.absent) continue;
    Chip chip(scenario());
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x03, 49);
    chip.write(reg::kAddrCfgch, {static_cast<std::uint8_t>(reg::kCfgch2Unused | choice.cfgch)});
    for (const bool sl : {true, false}) {
      clocked(chip.simulator.line(1))->faults().stick(sl);
      chip.simulator.refresh_lines();
      for (const unsigned ags : {reg::kAgsOff, reg::kAgsOn}) {
        chip.instruct(static_cast<std::uint8_t>(reg::kInstrCdm0 | ags));
        EXPECT_EQ(ma_edges(chip, 1, 200), 0U) << unsigned{choice.cfgch};
        EXPECT_EQ(chip.status(), reg::kResetStatus0) << unsigned{choice.cfgch};
        EXPECT_EQ(instr(chip) & ~reg::INSTR::kMask, ags);
        chip.instruct(reg::kBreakAbort);
        chip.advance_us(2);
      }
    }
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo), 0U);
  }
}

// "An instruction that needs something absent ends as in 37."
TEST_P(ChipFeatures, InstructionThatNeedsSomethingAbsent_EndsAtOnce) {
  const Core& core = GetParam();
  Chip chip(scenario());
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x03, reg::kFreqagsAgsMin);
  for (const unsigned code : {reg::kInstrControl, reg::kInstrControlReduced}) {
    for (const unsigned ags : {reg::kAgsOff, reg::kAgsOn}) {
      chip.write(reg::kAddrFreqags, {99});
      chip.write(reg::kAddrChsel, {0});
      chip.write(reg::kAddrCtrl, {reg::kRegversBissC});
      if (!core.control) expect_ends_at_once(chip, code | ags, "no control");
      chip.write(reg::kAddrCfgch, {reg::kCfgch2Unused | reg::kCfgch1BissB});
      chip.write(reg::kAddrCtrl, {reg::kRegversBissB});
      if (!core.control || !core.biss_b) expect_ends_at_once(chip, code | ags, "no BiSS B");
      chip.write(reg::kAddrCtrl, {reg::kRegversBissC});
      chip.write(reg::kAddrChsel, {reg::kChsel2Used});
      for (const std::uint8_t split : {reg::kSlaveloc5Split, reg::kSlaveloc5AllOnChannel1}) {
        chip.write(reg::kAddrSlaveloc5, {static_cast<std::uint8_t>(reg::kResetSlaveloc5 | split),
                                         reg::kCfgch2BissC | reg::kCfgch1BissC});
        if (core.lines == 1) expect_ends_at_once(chip, code | ags, "no line 2");
      }
    }
  }
  // INIT of BiSS B.
  chip.write(reg::kAddrChsel, {0});
  chip.write(reg::kAddrCfgch, {reg::kCfgch2Unused | reg::kCfgch1BissC});
  chip.write(reg::kAddrCtrl, {reg::kRegversBissB});
  if (!core.biss_b) expect_ends_at_once(chip, reg::kInitStart, "INIT of BiSS B");
  // And the chip is well.
  chip.write(reg::kAddrCtrl, {reg::kRegversBissC});
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(word28(chip, 1), kEncoderWord);
}

// "CDM by INSTR 001..011 and HOLDCDM stay": MA keeps the inverted CDM up to the next frame.
TEST_P(ChipFeatures, CdmByInstr_IsSentAndHeld) {
  Chip chip(scenario());
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x03, reg::kFreqagsAgsMin);
  chip.write(reg::kAddrCtrl, {reg::kRegversBissC | reg::kHoldcdmHold});
  for (const unsigned instruction :
       {reg::kInstrCdm1, reg::kInstrCdm0, reg::kInstrCdmNotCdssel, reg::kInstrCdm0}) {
    chip.instruct(static_cast<std::uint8_t>(instruction));
    ASSERT_TRUE(chip.wait_eot());
    chip.advance_us(60);
    // CDS of this encoder is 0, so not CDS is 1.
    EXPECT_EQ(ma(chip, 1), instruction == reg::kInstrCdm0) << instruction;
  }
}

// Control communication of the cores that have it.
TEST_P(ChipFeaturesControl, RegisterOfTheSlave_IsReadAndWritten) {
  Chip chip(scenario(std::string(kEncoder) + "\nregisters = { 0x44 = [0x12, 0xD9] }"));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  const auto access = [&](std::uint8_t regadr) {
    chip.write(reg::kAddrRegadr, {regadr, 1});
    chip.write(reg::kAddrCtrl, {reg::kCtsRegisterAccess | reg::kRegversBissC});
    expect_ends_well(chip);
  };
  access(0x44);
  EXPECT_EQ(chip.read(reg::kAddrRdata, 2), (std::vector<std::uint8_t>{0x12, 0xD9}));
  chip.write(reg::kAddrRdata, {0x5A, 0xA5});
  access(reg::WNR::kMask | 0x44);
  EXPECT_EQ(chip.simulator.slave(1)->reg_read(0x45), 0xA5U);
}

// "A word ... with a CRC that the core does not have (length as configured), keeps SVALID = 0, and
// its frame ends with nSCDERR = 0."
TEST_P(ChipFeatures, CrcThatIsAbsent_MakesTheWordBadWithItsLength) {
  struct Crc {
    unsigned polynomial;
    std::uint8_t code;
    unsigned bits;
    bool always;
  };
  for (const Crc& crc :
       {Crc{0x43, reg::kScrclenCrc6, 6, true}, Crc{0x43, reg::kSelcrcsByPolynomial | 0x21, 6, true},
        Crc{0x190D9, reg::kScrclenCrc16, 16, true}, Crc{0, reg::kScrclenNone, 0, true},
        Crc{0x25, reg::kScrclenCrc5, 5, false}, Crc{0x12F, reg::kScrclenCrc8, 8, false},
        Crc{0x61, reg::kSelcrcsByPolynomial | 0x30, 6, false},
        Crc{0x53, reg::kSelcrcsByPolynomial | 0x29, 6, false}}) {
    const bool good = crc.always || GetParam().free_crc;
    const std::string key =
        crc.polynomial == 0 ? "crc = 0" : "crc = " + std::to_string(crc.polynomial);
    Chip chip(scenario("data_bits = 28\ndata = 0xAAF37BF\n" + key));
    chip.configure_slave1(28, crc.code, 0x03, reg::kFreqagsAgsMin);
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
    EXPECT_EQ(rising(chip, 1), 28U + crc.bits + 5U) << key;
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo), good ? reg::SVALID<1>::kMask : 0U) << key;
    EXPECT_EQ((chip.status() & reg::nSCDERR::kMask) != 0, good) << key;
  }
}

// "A word with GRAYSx = 1 on an SSI line without Gray ... keeps SVALID = 0, and its frame ends with
// nSCDERR = 0." With any CRC, and without one.
TEST_P(ChipFeaturesSsi, GrayCodeThatIsAbsent_MakesTheWordBad) {
  for (const bool crc : {false, true}) {
    for (const bool gray : {false, true}) {
      Chip chip("[chip]\n" + key() + "\n[host]\n[[channel]]\nnumber = 1\n[[channel.slave]]\n" +
                "protocol = \"ssi\"\ndata_bits = 25\ndata = 0x12345A5\ncrc = " +
                (crc ? "0x43" : "0") + (gray ? "\ngray = true\n" : "\n"));
      chip.configure_slave1(25, crc ? reg::kScrclenCrc6 : reg::kScrclenNone, 0x09,
                            reg::kFreqagsAgsMin);
      chip.write(reg::kAddrCfgch, {reg::kCfgch2Unused | reg::kCfgch1Ssi});
      chip.write(reg::slave_cfg_address(1),
                 {static_cast<std::uint8_t>(reg::kEnscdYes | (gray ? reg::kGraysGray : 0) | 24)});
      chip.instruct(reg::kInstrCdm0);
      ASSERT_TRUE(chip.wait_eot());
      const bool good = GetParam().gray || !gray;
      EXPECT_EQ(chip.read(reg::kAddrSvalidLo), good ? reg::SVALID<1>::kMask : 0U) << crc << gray;
      EXPECT_EQ((chip.status() & reg::nSCDERR::kMask) != 0, good) << crc << gray;
      EXPECT_EQ(rising(chip, 1), 25U + (crc ? 6U : 0U) + 1U);
      if (good) {
        EXPECT_EQ(word28(chip, 1), 0x12345A5U);
      }
    }
  }
}

// "Two lines with n = 1..4: SCDATA1..n on line 1, SCDATA5..4+n on line 2 with SLAVELOC5 = 1."
TEST_P(ChipFeaturesTwoLines, SecondLine_HasChannel5) {
  Chip chip(two_lines());
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x03, reg::kFreqagsAgsMin);
  chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 27, reg::kScrclenCrc6, 0, 0});
  chip.write(reg::kAddrSlaveloc5,
             {reg::kResetSlaveloc5 | reg::kSlaveloc5Split, reg::kCfgch2BissC | reg::kCfgch1BissC});
  ASSERT_TRUE(chip.simulator.slave(5)->set_data(0x1234567));
  for (const unsigned instruction : {reg::kInitStart, reg::kInstrCdm0}) {
    chip.instruct(static_cast<std::uint8_t>(instruction));
    ASSERT_TRUE(chip.wait_eot());
  }
  EXPECT_EQ(word28(chip, 1), kEncoderWord);
  EXPECT_EQ(word28(chip, 5), 0x1234567U);
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo, 2),
            (std::vector<std::uint8_t>{reg::SVALID<1>::kMask, reg::SVALID<5>::kMask}));
  EXPECT_EQ(chip.status(), reg::kResetStatus0);
  EXPECT_EQ(rising(chip, 2), 28U + 6U + 5U);
}

// "... with SLAVELOC5 = 0 line 2 is unused and line 1 has SCDATA1..n only."
TEST_P(ChipFeaturesTwoLines, SecondLineWithoutSlaveloc5_IsUnused) {
  const Core& core = GetParam();
  Chip chip(two_lines());
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x03, reg::kFreqagsAgsMin);
  chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 27, reg::kScrclenCrc6, 0, 0});
  chip.write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5, reg::kCfgch2BissC | reg::kCfgch1BissC});
  chip.instruct(reg::kInstrCdm0);
  EXPECT_EQ(ma_edges(chip, 2, 100), 0U);
  // The full chip has SCDATA5 on line 1 now.
  EXPECT_EQ(rising(chip, 1), (core.slaves == 8 ? 2U : 1U) * (28U + 6U) + 5U);
  EXPECT_EQ(chip.read(reg::kAddrSvalidHi), 0U);
}

// "One line: SCDATA1..n, with SLAVELOC5 = 1 only those up to 4." A second line is not looked at.
TEST_P(ChipFeaturesOneLine, OneLine_WorksWithAnySlaveloc5) {
  const Core& core = GetParam();
  Chip chip(scenario());
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x03, reg::kFreqagsAgsMin);
  chip.simulator.set_pin(sim::Pin::kSl2, false);
  for (const std::uint8_t split : {reg::kSlaveloc5AllOnChannel1, reg::kSlaveloc5Split}) {
    chip.write(reg::kAddrSlaveloc5, {static_cast<std::uint8_t>(reg::kResetSlaveloc5 | split),
                                     reg::kCfgch2BissC | reg::kCfgch1BissC});
    chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 9, reg::kScrclenNone, 0, 0});
    chip.instruct(reg::kInstrCdm0);
    EXPECT_EQ(ma_edges(chip, 2, 100), 0U);
    EXPECT_TRUE(ma(chip, 2));
    EXPECT_EQ(rising(chip, 1), 28U + 6U + 5U + (core.channel(5) && split == 0 ? 10U : 0U));
    EXPECT_EQ(word28(chip, 1), kEncoderWord);
    EXPECT_EQ(chip.status(), reg::kResetStatus0);
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
    EXPECT_EQ(chip.read(reg::kAddrStatus8) & (reg::SL<2>::kMask | reg::CDS<2>::kMask),
              reg::SL<2>::kMask);
  }
}

// "One line": codes of a line that is left out ask for no frame, so no bank is switched.
TEST_P(ChipFeaturesOneLine, OneLine_LeftOutLineTakesPartInNothing) {
  const Core& core = GetParam();
  Chip chip(scenario());
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x03, reg::kFreqagsAgsMin);
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  const auto split = static_cast<std::uint8_t>(reg::kResetSlaveloc5 | reg::kSlaveloc5Split);
  for (const std::uint8_t line2 :
       {reg::kCfgch2BissB, reg::kCfgch2BissC, reg::kCfgch2Ssi, reg::kCfgch2Unused}) {
    chip.write(reg::kAddrSlaveloc5, {split, static_cast<std::uint8_t>(line2 | reg::kCfgch1Unused)});
    for (const std::uint8_t ags : {reg::kAgsOff, reg::kAgsOn}) {
      chip.instruct(static_cast<std::uint8_t>(reg::kInstrCdm0 | ags));
      EXPECT_EQ(ma_edges(chip, 1, 100), 0U) << unsigned{line2};
      EXPECT_EQ(instr(chip), ags == 0 ? 0U : reg::kInstrCdm0 | ags) << unsigned{line2};
      EXPECT_EQ(word28(chip, 1), kEncoderWord) << unsigned{line2};
      EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask) << unsigned{line2};
      chip.instruct(reg::kAgsOff);
    }
  }
  if (!core.control) return;
  // A command to both lines is one to line 1, which answers.
  chip.write(reg::kAddrSlaveloc5, {split, reg::kCfgch2BissC | reg::kCfgch1BissC});
  chip.write(reg::kAddrChsel, {reg::kChsel1Used | reg::kChsel2Used});
  chip.write(reg::kAddrCtrl, {reg::kCtsCommand | reg::kRegversBissC});
  chip.write(reg::kAddrRdata, {0x80});
  expect_ends_well(chip);
}

// "One bank: acts as SINGLEBANK = 1, SWBANKFAIL = 0."
TEST_P(ChipFeatures, OneBank_ShowsTheNewestWordWhateverIsHeldOrSwapped) {
  const bool one = GetParam().banks == 1;
  Chip chip(scenario());
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x03, reg::kFreqagsAgsMin);
  const auto frame = [&](unsigned word, unsigned held) {
    ASSERT_TRUE(chip.simulator.slave(1)->set_data(word));
    chip.instruct(static_cast<std::uint8_t>(reg::kInstrCdm0 | held));
    ASSERT_TRUE(chip.wait_eot());
  };
  frame(0x1111111, 0);
  EXPECT_EQ(word28(chip, 1), 0x1111111U);
  // Held: two banks keep the word before, and the second frame overwrites a pending one.
  frame(0x2222222, reg::kHoldbankPrevented);
  EXPECT_EQ(word28(chip, 1), one ? 0x2222222U : 0x1111111U);
  frame(0x3333333, reg::kHoldbankPrevented);
  EXPECT_EQ(word28(chip, 1), one ? 0x3333333U : 0x1111111U);
  EXPECT_EQ(chip.read(reg::kAddrSwbankfail), one ? 0U : reg::kSwbankfailFailed);
  chip.instruct(0);
  chip.advance_us(2);
  EXPECT_EQ(word28(chip, 1), 0x3333333U);
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
  // Swapped: the other bank of two.
  chip.instruct(reg::SWBANK::kMask);
  chip.advance_us(2);
  EXPECT_EQ(word28(chip, 1) == 0x3333333U, one);
  EXPECT_EQ(chip.status(), reg::kResetStatus0);
}

INSTANTIATE_TEST_SUITE_P(Cores, ChipFeatures, testing::ValuesIn(mb4test::built_cores()),
                         mb4test::core_name);
INSTANTIATE_TEST_SUITE_P(Cores, ChipFeaturesControl,
                         testing::ValuesIn(mb4test::built_cores([](const Core& core) {
                           return core.control;
                         })),
                         mb4test::core_name);
INSTANTIATE_TEST_SUITE_P(Cores, ChipFeaturesSsi,
                         testing::ValuesIn(mb4test::built_cores([](const Core& core) {
                           return core.ssi;
                         })),
                         mb4test::core_name);
INSTANTIATE_TEST_SUITE_P(Cores, ChipFeaturesTwoLines,
                         testing::ValuesIn(mb4test::built_cores([](const Core& core) {
                           return core.lines == 2;
                         })),
                         mb4test::core_name);
INSTANTIATE_TEST_SUITE_P(Cores, ChipFeaturesOneLine,
                         testing::ValuesIn(mb4test::built_cores([](const Core& core) {
                           return core.lines == 1;
                         })),
                         mb4test::core_name);

// A preset that a build does not have, and one that is none.
TEST(ChipFeaturesKey, UnknownOrAbsentPreset_IsOneClearError) {
  const auto error = [](const std::string& value) -> std::string {
    try {
      sim::parse_scenario(one_slave(kEncoder, "", "features = \"" + value + "\""), "test.toml");
    } catch (const sim::ScenarioError& problem) {
      return problem.what();
    }
    return "";
  };
  EXPECT_NE(error("tiny").find("test.toml:2"), std::string::npos) << error("tiny");
  EXPECT_NE(error("tiny").find("single"), std::string::npos) << error("tiny");
  for (const sim::ChipPreset& preset : sim::chip_presets()) {
    const std::string text = error(std::string(preset.name));
    EXPECT_EQ(text.empty(), preset.built) << preset.name;
    if (!preset.built) {
      EXPECT_EQ(text, "test.toml:2:12: key 'features': this build has no \"" +
                          std::string(preset.name) +
                          "\"; `cmake --preset default -DMB4_PRESETS='single;" +
                          std::string(preset.name) + "'` and a new build bring it (in [chip])");
    }
  }
}

}  // namespace
