// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// No pulse at MA is shorter than half of the configured period (I302, I303), even if a frame is
// cut. The guard at the MA pins ends a simulation that breaks this: see MaGuard and MaPulseCheck in
// tests/unit. The MA force bits: ma_force_test.cpp.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "sim/core/random.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::one_slave;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

const char kEncoder[] = "data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF";
const char kInternal[] = "f_clk_hz = 0\nf_osc_hz = 25000000\n";

// Half a period of MA in ns for a code of FREQS.
sim::Time half_ns(unsigned freqs, sim::Time clk_ns) {
  return (freqs < 0x10 ? freqs + 1 : 10 * (freqs - 15)) * clk_ns;
}

// A good frame shows that everything has recovered.
void expect_good_frame(Chip& chip, std::uint8_t freqs, const std::string& what) {
  chip.configure_slave1(28, reg::kScrclenCrc6, freqs);
  chip.advance_us(100);
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot()) << what;
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo) & reg::SVALID<1>::kMask, reg::SVALID<1>::kMask) << what;
  EXPECT_EQ(chip.read(reg::kAddrScdata, 4), (std::vector<std::uint8_t>{0xBF, 0x37, 0xAF, 0x0A}))
      << what;
}

constexpr std::uint8_t byte(unsigned value) { return static_cast<std::uint8_t>(value); }

struct Cut {
  std::uint8_t freqs;
  std::uint8_t instr;  // 0x04: CDM = 0, 0x02: CDM = 1, 0x10: INIT
};

class MaPulse : public testing::TestWithParam<Cut> {
 protected:
  // Runs `cut` at many phases of a frame, off the clock's grid; each time on a new chip.
  template <typename Action>
  void at_every_phase(const std::string& chip_keys, sim::Time clk_ns, Action cut) {
    const auto [freqs, instr] = GetParam();
    const sim::Time half = half_ns(freqs, clk_ns);
    constexpr unsigned kPhases = 45;  // over half a frame, none twice at the same phase of MA
    for (unsigned phase = 0; phase < kPhases; ++phase) {
      Chip chip(one_slave(kEncoder, "delay_ns = 90.0", chip_keys));
      if (!chip_keys.empty()) chip.write(reg::kAddrIface, {reg::kClkeniInternal});
      chip.configure_slave1(28, reg::kScrclenCrc6, freqs);
      if (instr == 0x02)
        chip.write(reg::kAddrCtrl,
                   {reg::kRegversBissC | reg::kHoldcdmHold});  // HOLDCDM: MA rests low
      chip.instruct(instr);
      chip.simulator.advance(phase * half * sim::kPsPerNs * 8 / 7 + phase * 3137);
      const bool ma = chip.simulator.pin(sim::Pin::kMa1);
      const std::string what = "phase " + std::to_string(phase) + ", MA " + std::to_string(ma);
      ASSERT_NO_THROW(cut(chip)) << what;
      if (testing::Test::HasFatalFailure()) return;
      EXPECT_TRUE(chip.simulator.pin(sim::Pin::kMa1)) << what;
      ASSERT_NO_THROW(expect_good_frame(chip, freqs, what)) << what;
      EXPECT_GE(ma_check(chip.simulator.line_end(1)).pulses(), 2U * (28U + 6U + 4U));
    }
  }
};

TEST_P(MaPulse, BreakAtAnyPhase_CutsNothingShort) {
  at_every_phase("", 50, [](Chip& chip) {
    chip.instruct(reg::kBreakAbort);
    chip.advance_us(200);
  });
}

// The reset is asynchronous and shorter than half a period; MA ends its low level all the same.
TEST_P(MaPulse, ResetAtAnyPhase_CutsNothingShort) {
  at_every_phase("", 50, [](Chip& chip) {
    chip.simulator.set_pin(sim::Pin::kNres, false);
    chip.simulator.advance(251 * sim::kPsPerNs);
    chip.simulator.set_pin(sim::Pin::kNres, true);
    chip.advance_us(200);
  });
}

// Reset selects pin CLK again. Nothing clocks the chip then until CLKENI is set.
TEST_P(MaPulse, ResetOnTheOscillator_CutsNothingShort) {
  at_every_phase(kInternal, 40, [](Chip& chip) {
    chip.simulator.set_pin(sim::Pin::kNres, false);
    chip.simulator.advance(251 * sim::kPsPerNs);
    chip.simulator.set_pin(sim::Pin::kNres, true);
    chip.advance_us(20);
    chip.write(reg::kAddrIface, {reg::kClkeniInternal});
    chip.advance_us(200);
  });
}

// CLKENI in the middle of a frame: the frame continues with the other clock.
TEST_P(MaPulse, ClockSwitchAtAnyPhase_CutsNothingShort) {
  for (const unsigned osc : {10'000'000U, 25'000'000U}) {
    at_every_phase("f_osc_hz = " + std::to_string(osc) + "\n", 50, [](Chip& chip) {
      chip.write(reg::kAddrIface, {0});
      chip.advance_us(20);
      chip.write(reg::kAddrIface, {reg::kClkeniInternal});
      chip.instruct(reg::kBreakAbort);
      chip.advance_us(300);
    });
  }
}

// The MA force bits in the middle of a frame, and released again.
TEST_P(MaPulse, ForcedAtAnyPhase_CutsNothingShort) {
  for (const unsigned level : {0x00U, 0x20U}) {
    at_every_phase("", 50, [level](Chip& chip) {
      chip.write(reg::kAddrIface, {static_cast<std::uint8_t>(reg::kMafsForced | level)});
      chip.advance_us(20);
      chip.write(reg::kAddrIface, {0});
      chip.instruct(reg::kBreakAbort);
      chip.advance_us(200);
    });
  }
}

// BREAK and the next frame as fast as the host can write them.
TEST_P(MaPulse, BreakAndNewFrameAtOnce_CutNothingShort) {
  at_every_phase("", 50, [](Chip& chip) {
    chip.simulator.spi().set_timing(sim::SpiTiming::for_frequency(50'000'000));
    chip.instruct(reg::kBreakAbort);
    chip.instruct(reg::kInstrCdm0);
    chip.instruct(reg::kBreakAbort | reg::kInstrCdm1);
    chip.instruct(reg::kBreakAbort);
    chip.advance_us(200);
  });
}

// FREQS changes and line 1 goes out of use, and line 2 starts in its place: before BREAK, after it,
// and without one (decision 40).
TEST_P(MaPulse, LineTakenOutOfUseAtAnyPhase_CutsNothingShort) {
  for (const unsigned order : {0U, 1U, 2U}) {
    for (const std::uint8_t next : std::array<std::uint8_t, 3>{0x00, 0x04, 0x1F}) {
      at_every_phase("", 50, [order, next](Chip& chip) {
        chip.simulator.spi().set_timing(sim::SpiTiming::for_frequency(50'000'000));
        if (order == 0) chip.instruct(reg::kBreakAbort);
        chip.write(reg::kAddrFreq, {next});
        chip.write(reg::kAddrSlaveloc5,
                   {0x10, reg::kCfgch2BissC | reg::kCfgch1Unused});  // BiSS C on line 2 only
        chip.instruct(order == 1 ? reg::kBreakAbort | reg::kInstrCdm0 : reg::kInstrCdm0);
        chip.advance_us(20);
        chip.instruct(reg::kBreakAbort);
        chip.advance_us(200);
      });
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cuts, MaPulse,
                         testing::Values(Cut{0x00, 0x04}, Cut{0x00, 0x02}, Cut{0x01, 0x04},
                                         Cut{0x04, 0x02}, Cut{0x09, 0x04}, Cut{0x09, 0x10},
                                         Cut{0x11, 0x02}, Cut{0x1F, 0x04}, Cut{0x1F, 0x02}),
                         [](const auto& entry) {
                           return "Freqs" + std::to_string(entry.param.freqs) + "_Instr" +
                                  std::to_string(entry.param.instr);
                         });

// ---- two lines ----------------------------------------------------------------------------------

std::string two_lines(const char* line1 = "biss-c") {
  std::string text = "[chip]\n[host]\ninterface = \"spi\"\nsclk_hz = 20_000_000\n";
  for (unsigned line = 1; line <= 2; ++line) {
    text += "[[channel]]\nnumber = ";
    text += std::to_string(line);
    text += "\n[[channel.slave]]\nprotocol = \"";
    text += line == 1 ? line1 : "biss-c";
    text += "\"\ndata_bits = 26\ncrc = 0x43\ndata = 0x0AAAAAA\ntimeout = 20\n";
  }
  return text;
}

// After any earlier events both lines deliver data.
void expect_good_frames(Chip& chip, const std::string& what, std::uint8_t cfgch = 0x05) {
  chip.instruct(reg::kBreakAbort);
  chip.write(reg::kAddrIface, {0});
  for (unsigned slave = reg::slave_cfg_address(1); slave < reg::slave_cfg_address(9);
       slave += reg::kSlaveCfgStride) {
    const bool used = slave == reg::slave_cfg_address(1) || slave == reg::slave_cfg_address(5);
    chip.write(byte(slave), {byte(used ? 0x59 : 0x00), 0x06, 0x00, 0x00});
  }
  chip.write(reg::kAddrChsel, {0, reg::kRegversBissC, reg::FREQS::of(1), 0, 0x00, 0x00});
  chip.write(reg::kAddrSlaveloc5, {reg::kSlaveloc5Split, cfgch});
  chip.write(reg::kAddrActnsens, {0});
  chip.advance_us(1000);
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot()) << what;
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo, 2),
            (std::vector<std::uint8_t>{reg::SVALID<1>::kMask, reg::SVALID<5>::kMask}))
      << what;
  const std::vector<std::uint8_t> word{0xAA, 0xAA, 0xAA, 0x00};
  EXPECT_EQ(chip.read(reg::kAddrScdata, 4), word) << what;
  EXPECT_EQ(chip.read(reg::scdata_address(5), 4), word) << what;
}

// Every phase of the last half period, in steps of a clock. The half period is 8 us long; its line
// goes out of use, and the other line starts with half periods of a tenth of it or less. The limits
// of both lines follow from their own FREQS, not from the chip's status.
TEST(MaPulseTwoLines, LastHalfPeriodOfALineOutOfUse_EndsInItsTime) {
  struct Way {
    bool break_first;
    bool by_slaveloc5;   // line 2 goes out of use instead of line 1
    std::uint8_t freqs;  // of the line that starts
    sim::Time half;      // ns
  };
  for (const Way way :
       {Way{true, false, 0x04, 250}, Way{false, false, 0x04, 250}, Way{true, false, 0x00, 50},
        Way{false, false, 0x0F, 800}, Way{true, true, 0x04, 250}, Way{false, true, 0x00, 50}}) {
    for (sim::Time d = 0; d <= 9400; d += 50) {
      Chip chip(two_lines());
      const unsigned old_line = way.by_slaveloc5 ? 2 : 1;
      // 1 ns for clock edges that are rounded to picoseconds.
      ma_check(chip.simulator.line_end(old_line)).require(8'000 * sim::kPsPerNs - sim::kPsPerNs);
      ma_check(chip.simulator.line_end(3 - old_line))
          .require(way.half * sim::kPsPerNs - sim::kPsPerNs);
      chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 25, reg::kScrclenCrc6, 0x00, 0x00});
      chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 25, reg::kScrclenCrc6, 0x00, 0x00});
      chip.write(reg::kAddrCtrl, {reg::kRegversBissC, reg::FREQS::of(31), 0, reg::kFreqagsAgsMin});
      chip.write(reg::kAddrSlaveloc5,
                 {0x10, byte(way.by_slaveloc5 ? reg::kCfgch2BissC | reg::kCfgch1Unused
                                              : reg::kCfgch2Unused | reg::kCfgch1BissC)});
      chip.instruct(reg::kInstrCdm0);
      chip.simulator.advance(d * sim::kPsPerNs);
      const std::string what = "D " + std::to_string(d) + " ns, FREQS " +
                               std::to_string(way.freqs) + (way.break_first ? ", BREAK first" : "");
      ASSERT_NO_THROW({
        if (way.break_first) chip.instruct(reg::kBreakAbort);
        chip.write(reg::kAddrFreq, {way.freqs});
        chip.write(reg::kAddrSlaveloc5,
                   {byte(way.by_slaveloc5 ? 0x00 : 0x10),
                    byte(way.by_slaveloc5 ? reg::kCfgch2Unused | reg::kCfgch1BissC
                                          : reg::kCfgch2BissC | reg::kCfgch1Unused)});
        chip.instruct(way.break_first ? reg::kInstrCdm0 : reg::kBreakAbort | reg::kInstrCdm0);
        chip.advance_us(90);
      }) << what;
      EXPECT_GE(ma_check(chip.simulator.line_end(3 - old_line)).pulses(), 2U * (26U + 6U + 4U))
          << what;
    }
  }
}

// A line that waits for SL = 1 when it goes out of use keeps the other one waiting for half a
// period at most.
TEST(MaPulseTwoLines, LineOutOfUseWithSlLow_StartsTheOther) {
  for (const std::uint8_t instr : std::array<std::uint8_t, 3>{0x04, 0x02, 0x10}) {
    Chip chip(two_lines());
    chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 25, reg::kScrclenCrc6, 0x00, 0x00});
    chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 25, reg::kScrclenCrc6, 0x00, 0x00});
    chip.write(reg::kAddrCtrl, {reg::kRegversBissC, reg::FREQS::of(1), 0, 0x00});
    chip.write(reg::kAddrSlaveloc5, {reg::kSlaveloc5Split, reg::kCfgch2BissC | reg::kCfgch1BissC});
    chip.instruct(instr);
    chip.advance_us(5);
    clocked(chip.simulator.line(1))->faults().stick(false);
    chip.simulator.refresh_lines();
    ASSERT_TRUE(chip.wait_eot());
    chip.advance_us(40);
    chip.write(reg::kAddrCfgch, {reg::kCfgch2BissC | reg::kCfgch1Unused});
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot(100));
    EXPECT_EQ(chip.read(reg::kAddrSvalidHi), reg::SVALID<5>::kMask)
        << "INSTR byte " << unsigned{instr};
    EXPECT_TRUE(chip.simulator.pin(sim::Pin::kMa1));
  }
}

// A line that is forced low also ends its half period, whichever line starts with a shorter half
// period and whatever ends the force. The same with a longer half period.
TEST(MaPulseTwoLines, ForcedLineOtherFreqs_CutsNothingShort) {
  for (unsigned way = 0; way < 8; ++way) {
    std::uint64_t pulses = 0;
    const bool slower = (way & 1U) != 0;
    for (sim::Time d = 0; d < 5000; d += 50) {
      Chip chip(two_lines());
      chip.write(reg::kAddrChsel, {reg::kChsel2Used});
      chip.write(reg::kAddrFreq, {byte(slower ? 0 : reg::FREQS::of(24))});
      chip.write(reg::kAddrIface, {reg::kMafoForced});  // line 1 low
      chip.simulator.advance(8'000 * sim::kPsPerNs + d * sim::kPsPerNs);
      ASSERT_NO_THROW({
        chip.write(reg::kAddrCtrl, {reg::kCtsRegisterAccess | reg::kRegversBissC,
                                    byte(slower ? reg::FREQS::of(24) : 0)});
        chip.write(reg::kAddrChsel, {0});  // line 2 low, line 1 released
        chip.instruct((way & 2U) != 0 ? reg::kBreakAbort | reg::kInstrCdm0
                                      : reg::kBreakAbort | reg::kInitStart);
        chip.simulator.advance((d % 7) * 211 * sim::kPsPerNs);
        if ((way & 4U) != 0) {
          chip.write(reg::kAddrIface, {0});
        } else {
          chip.simulator.set_pin(sim::Pin::kNres, false);
          chip.simulator.advance(100 * sim::kPsPerNs);
          chip.simulator.set_pin(sim::Pin::kNres, true);
        }
        chip.advance_us(100);
      }) << "way "
         << way << ", D " << d << " ns";
      EXPECT_TRUE(chip.simulator.pin(sim::Pin::kMa2));
      pulses += ma_check(chip.simulator.line_end(2)).pulses();
    }
    EXPECT_GE(pulses, 20U) << "way " << way;
  }
}

// ---- settings in the middle of a frame (decision 38) --------------------------------------------

// A frame whose MA was forced away from the slave, then released, while EN_MO and ACTNSENS make the
// line one with actuators and back again.
TEST(SettingsInAFrame, EnMoAndForceChange_FrameGoesOnWithWhatItBeganWith) {
  Chip chip(two_lines("biss-b"));
  chip.write(reg::kAddrIface, {reg::kMafsForced});
  chip.instruct(reg::kInstrCdm0);
  chip.write(reg::slave_cfg_address(6), {reg::kEnscdYes});
  chip.write(reg::kAddrCtrl, {reg::kEnMoData});
  chip.write(reg::kAddrActnsens, {reg::ACTnSENS<6>::kMask});
  chip.write(reg::kAddrIface, {0});
  chip.write(reg::kAddrCtrl, {0, reg::FREQR::of(5)});
  ASSERT_NO_THROW(chip.advance_us(300));
  ASSERT_NO_FATAL_FAILURE(expect_good_frames(chip, "", 0x04));
}

// A healthy line's frame ends, whatever is configured after its first clock, for any protocol.
TEST(SettingsInAFrame, AnyConfigurationRegister_FrameEnds) {
  const std::array<const char*, 3> protocols{"biss-b", "biss-c", "ssi"};
  for (unsigned session = 0; session < 600; ++session) {
    sim::Random random(session);
    const auto below = [&random](unsigned n) {
      return static_cast<std::uint8_t>(random.next() % n);
    };
    const unsigned protocol = session % 3;
    Chip chip(two_lines(protocols.at(protocol)));
    const auto cfgch = static_cast<std::uint8_t>(0x04U | protocol);
    chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 25, reg::kScrclenCrc6, 0x00, 0x00});
    chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 25, reg::kScrclenCrc6, 0x00, 0x00});
    chip.write(reg::kAddrCtrl, {reg::kRegversBissC, reg::FREQS::of(20), 0, reg::kFreqagsAgsMin});
    chip.write(reg::kAddrSlaveloc5, {reg::kSlaveloc5Split, cfgch});
    if (below(3) == 0) chip.write(reg::kAddrCtrl, {reg::kRegversBissC | reg::kEnMoData});
    if (below(3) == 0) chip.write(reg::kAddrActnsens, {below(256)});
    chip.advance_us(50);
    const bool init = session % 5 == 0;
    chip.instruct(init ? reg::kInitStart : session % 2 == 0 ? reg::kInstrCdm0 : reg::kInstrCdm1);
    chip.simulator.advance(sim::Time{10U + below(100)} * (init ? 50 : 1000) * sim::kPsPerNs);
    ASSERT_FALSE(chip.simulator.pin(sim::Pin::kEot)) << session;
    std::string what = "session " + std::to_string(session) + ":";
    for (unsigned count = 1U + below(4); count > 0; --count) {
      static constexpr std::array<std::uint8_t, 11> kMore{
          reg::kAddrRegadr,  reg::kAddrChsel,    reg::kAddrCtrl,   reg::kAddrFreq,
          reg::kAddrBankcfg, reg::kAddrFreqags,  reg::kAddrMoBusy, reg::kAddrSlaveloc5,
          reg::kAddrCfgch,   reg::kAddrActnsens, reg::kAddrCfgch};
      const std::uint8_t address = below(3) == 0 ? static_cast<std::uint8_t>(0xC0U + below(32))
                                                 : kMore.at(below(kMore.size()));
      const std::uint8_t value = below(256);
      what.append(" ").append(std::to_string(address)).append("=").append(std::to_string(value));
      ASSERT_NO_THROW(chip.write(address, {value})) << what;
    }
    ASSERT_NO_THROW(ASSERT_TRUE(chip.wait_eot(30'000)) << what) << what;
    ASSERT_NO_FATAL_FAILURE(expect_good_frames(chip, what, cfgch));
  }
}

}  // namespace
