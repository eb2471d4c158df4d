// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Slaves that are missing, stop answering, or are unplugged in the middle of a control
// communication. The communication must end by itself with the flag of pages 34 and 35 (decision
// 24), in every mode of frames.
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

enum class Frames { kRate, kMin, kSingle };
struct Mode {
  Frames frames;
  unsigned open_level;
  std::uint8_t freqags;
  bool holds = false;  // HOLDBANK = 1, which changes nothing: frames run on (decision 15)
  unsigned freqs = 0;  // 0 or 1
  [[nodiscard]] std::uint8_t ags(unsigned instr = 0) const {
    return static_cast<std::uint8_t>(instr | reg::kAgsOn | (holds ? reg::kHoldbankPrevented : 0U));
  }
};
std::string name_of(const Mode& mode) {
  const char* const names[] = {"Rate", "Agsmin", "Single"};
  const bool other = mode.frames == Frames::kSingle && mode.freqags != reg::kFreqagsAgsMin;
  return std::string(names[static_cast<unsigned>(mode.frames)]) +
         (other ? "Freqags" + std::to_string(mode.freqags) : "") + "_SlOpenIs" +
         std::to_string(mode.open_level) + (mode.holds ? "_HoldBank" : "") +
         (mode.freqs != 0 ? "_Freqs" + std::to_string(mode.freqs) : "");
}
void PrintTo(const Mode& mode, std::ostream* out) { *out << name_of(mode); }

// Table 58 at FREQR = 0 and FREQS = 0, which is 10 MHz: 4096 x 2 periods, and an eighth more for
// frames that hang. With FREQS = 1 a period is twice as long.
constexpr double kLimitUs = 4096 * 2 * 0.1 * 9 / 8;
constexpr unsigned kPauseUs = 300;  // between two requests

class ControlAbsent : public testing::TestWithParam<Mode> {
 protected:
  void SetUp() override {
    chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 13, reg::kScrclenCrc6, 0x00, 0x00});
    chip.write(reg::kAddrCtrl, {reg::kRegversBissC, static_cast<std::uint8_t>(GetParam().freqs), 0,
                                GetParam().freqags});
    chip.write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5, reg::kCfgch2Unused | reg::kCfgch1BissC});
    if (!single()) chip.instruct(GetParam().ags());
    chip.advance_us(60);
  }
  bool single() const { return GetParam().frames == Frames::kSingle; }
  // With automatic frames one instruction is enough; single frames ask with each frame.
  void begin() {
    if (!single()) chip.instruct(GetParam().ags(reg::kInstrControl));
  }
  // Lets the control communication that is set up run until its CDM of `slot` has been taken, and
  // the slave is idle again.
  void run_to_slot(unsigned slot) {
    sim::ClockedSlave& slave = *clocked(chip.simulator.slave(1));
    const auto& counters = slave.control()->counters();
    begin();
    const auto next = [&] {
      if (single()) chip.instruct(reg::kInstrControl);
      const auto count = slave.cdm_count();
      ASSERT_TRUE(chip.simulator.run_while_waiting([&] { return slave.cdm_count() != count; },
                                                   chip.simulator.now() + 100 * sim::kPsPerUs));
    };
    const auto starts = counters.starts;
    for (unsigned i = 0; i < 20 && counters.starts == starts; ++i) next();
    ASSERT_EQ(counters.starts, starts + 1);
    for (unsigned i = 0; i < slot; ++i) next();
    chip.simulator.advance(200 * sim::kPsPerNs);  // SL = 1 has come through
  }
  void unplug() { chip.simulator.line(1)->act(chip.simulator.now(), sim::ClockedLine::kUnplug); }
  // While SL = 0 the chip leaves out frames, unless FREQAGS is AGSMIN (decision 3). So the host
  // asks again and again (decision 42).
  bool asks_again() const { return single() && GetParam().freqags != reg::kFreqagsAgsMin; }
  // Returns 0xF0 with REGEND = 1, or 0 if REGEND stays 0. When the host has requested the frame
  // that does not end, it only reads.
  std::uint8_t end_of_it() {
    if (single()) chip.instruct(reg::kInstrControl);
    const sim::Time start = chip.simulator.now();
    sim::Time asked = start;
    while (chip.simulator.now() - start < 5000 * sim::kPsPerUs) {
      if (asks_again() && chip.simulator.now() - asked >= kPauseUs * sim::kPsPerUs) {
        asked = chip.simulator.now();
        chip.instruct(reg::kInstrControl);
      }
      const std::uint8_t status = host.status();
      if ((status & reg::REGEND::kMask) != 0) {
        took_us = static_cast<double>(chip.simulator.now() - start) / sim::kPsPerUs;
        return status;
      }
      chip.advance_us(5);
    }
    return 0;
  }
  void expect_end(std::uint8_t flag) {
    const std::uint8_t status = end_of_it();
    ASSERT_NE(status & reg::REGEND::kMask, 0) << "it never ends";
    EXPECT_LT(took_us, kLimitUs * (1 + GetParam().freqs) + 60 + (asks_again() ? kPauseUs : 0));
    EXPECT_EQ(status & (reg::nREGERR::kMask | reg::nDELAYERR::kMask),
              (reg::nREGERR::kMask | reg::nDELAYERR::kMask) & ~flag);
    if (single()) {
      EXPECT_EQ(status & reg::nAGSERR::kMask,
                asks_again() && GetParam().open_level == 0 ? 0 : reg::kNagserrGood)
          << "nAGSERR: decision 3";
    }
    EXPECT_EQ(status & reg::nERR::kMask, 0) << "page 34: NER";
    EXPECT_EQ(chip.read(reg::kAddrInstr) & reg::INSTR::kMask, 0) << "INSTR";
    EXPECT_EQ(host.regbytes(), 0U);
  }
  // BREAK, and everything works again.
  void plug_and_check() {
    chip.simulator.line(1)->act(chip.simulator.now(), sim::ClockedLine::kPlug);
    chip.simulator.slave(1)->reg_write(0x31, 0x77);
    chip.instruct(reg::kBreakAbort);
    chip.advance_us(50);
    host.set_read(0, 0x31, 1);
    ASSERT_NE(host.run_single(60), 0U);
    EXPECT_EQ(host.status(), kAllGood);
    EXPECT_EQ(host.rdata(1)[0], 0x77);
  }

  Chip chip{one_slave("data_bits = 14\nread_busy_frames = 5",
                      "open_level = " + std::to_string(GetParam().open_level))};
  ControlHost host{chip};
  double took_us = 0;
};

TEST_P(ControlAbsent, BeforeTheAccess_IsNRegErr) {
  unplug();
  host.set_read(0, 0x31, 1);
  begin();
  expect_end(reg::nREGERR::kMask);
  plug_and_check();
}

TEST_P(ControlAbsent, BeforeACommand_IsNRegErr) {
  unplug();
  host.set_command(0x00, 2);
  begin();
  expect_end(reg::nREGERR::kMask);
  plug_and_check();
}

TEST_P(ControlAbsent, UnpluggedInTheHeader_IsNRegErr) {
  host.set_write(0, 0x31, {0x12});
  run_to_slot(8);
  unplug();
  expect_end(reg::nREGERR::kMask);
  plug_and_check();
}

// The slave has confirmed, its start bit is missing: Table 58.
TEST_P(ControlAbsent, UnpluggedWhileBusy_IsNDelayErr) {
  host.set_read(0, 0x31, 1);
  run_to_slot(22);
  unplug();
  expect_end(reg::nDELAYERR::kMask);
  plug_and_check();
}

TEST_P(ControlAbsent, UnpluggedInTheData_IsNRegErr) {
  host.set_read(0, 0x31, 2);
  run_to_slot(19 + 5 + 6);
  unplug();
  expect_end(reg::nREGERR::kMask);
  plug_and_check();
}

// The slave is on the line but does not answer any more.
TEST_P(ControlAbsent, SilentSlave_IsNRegErrInTheSlotOfTheEcho) {
  clocked(chip.simulator.slave(1))->control()->faults().set_silent(true);
  host.set_read(0, 0x31, 1);
  const auto before = clocked(chip.simulator.slave(1))->cdm_count();
  if (single()) {
    EXPECT_EQ(host.run_single(60), 14U + 18U);
  } else {
    begin();
    EXPECT_NE(end_of_it() & reg::REGEND::kMask, 0);
    EXPECT_LE(clocked(chip.simulator.slave(1))->cdm_count() - before, 14U + 18U + 2U);
  }
  EXPECT_EQ(host.status() & (reg::nREGERR::kMask | reg::nDELAYERR::kMask), reg::nDELAYERR::kMask);
  clocked(chip.simulator.slave(1))->control()->faults().set_silent(false);
  plug_and_check();
}

INSTANTIATE_TEST_SUITE_P(
    Modes, ControlAbsent,
    testing::Values(Mode{Frames::kRate, 1, 0x18}, Mode{Frames::kRate, 0, 0x18},
                    Mode{Frames::kRate, 1, 0x18, true}, Mode{Frames::kRate, 0, 0x18, true},
                    Mode{Frames::kRate, 1, 0x18, false, 1}, Mode{Frames::kRate, 0, 0x18, false, 1},
                    Mode{Frames::kMin, 1, reg::kFreqagsAgsMin},
                    Mode{Frames::kMin, 0, reg::kFreqagsAgsMin},
                    Mode{Frames::kSingle, 1, reg::kFreqagsAgsMin},
                    Mode{Frames::kSingle, 0, reg::kFreqagsAgsMin}, Mode{Frames::kSingle, 1, 0x1F},
                    Mode{Frames::kSingle, 0, 0x1F}, Mode{Frames::kSingle, 1, 0x00},
                    Mode{Frames::kSingle, 0, 0x00}, Mode{Frames::kSingle, 1, 0x7D},
                    Mode{Frames::kSingle, 0, 0x7D}, Mode{Frames::kSingle, 1, 0x80},
                    Mode{Frames::kSingle, 0, 0x80}),
    [](const auto& tested) { return name_of(tested.param); });

// A cable that is plugged in again before the limit delays the access and does not end it.
TEST(ControlPlug, PluggedInAgainInTime_AccessGoesOn) {
  Chip chip(one_slave("data_bits = 14\nread_busy_frames = 40",
                      "open_level = 0\n[[channel.event]]\n"
                      "at_us = 1400\naction = \"unplug\"\n[[channel.event]]\nat_us = 1900\n"
                      "action = \"plug\""));
  chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 13, reg::kScrclenCrc6, 0x00, 0x00});
  chip.write(reg::kAddrCtrl,
             {reg::kRegversBissC, reg::FREQR::of(1), 0, 0x18});  // FREQR = 1: 1638 us
  chip.write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5, reg::kCfgch2Unused | reg::kCfgch1BissC});
  ControlHost host(chip);
  chip.simulator.slave(1)->reg_write(0x31, 0x77);
  host.set_read(0, 0x31, 1);
  ASSERT_TRUE(host.run_ags(8000));
  EXPECT_EQ(host.status() & (reg::REGEND::kMask | reg::nREGERR::kMask | reg::nDELAYERR::kMask),
            reg::REGEND::kMask | reg::nREGERR::kMask | reg::nDELAYERR::kMask);
  EXPECT_EQ(host.rdata(1)[0], 0x77);
  EXPECT_GT(chip.simulator.now(), 2000 * sim::kPsPerUs);
}

// The host writes one instruction for each frame and pauses between reading the status and writing.
// Only a frame ends the access, so the host never misses the end.
TEST(ControlSingle, HostOfAnyPace_SeesNDelayErr) {
  for (unsigned pause_us = 0; pause_us < 400; pause_us += 13) {
    Chip chip(one_slave("data_bits = 14\nmissing = [0x20]"));
    chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 13, reg::kScrclenCrc6, 0x00, 0x00});
    chip.write(reg::kAddrCtrl, {reg::kRegversBissC, 0, 0, reg::kFreqagsAgsMin});
    chip.write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5, reg::kCfgch2Unused | reg::kCfgch1BissC});
    ControlHost host(chip);
    host.set_read(0, 0x20, 1);
    unsigned frames = 0;
    std::uint8_t status = 0;
    while ((status & reg::REGEND::kMask) == 0 && frames < 500) {
      chip.advance_us(frames < 14 + 18 ? 3 : pause_us);
      chip.instruct(reg::kInstrControl);
      ++frames;
      ASSERT_TRUE(chip.wait_eot());
      status = host.status();
    }
    ASSERT_EQ(status,
              (reg::kResetStatus0 | reg::kRegendDone) & ~reg::nDELAYERR::kMask & ~reg::nERR::kMask)
        << pause_us;
    const std::uint64_t starts = clocked(chip.simulator.slave(1))->control()->counters().starts;
    EXPECT_EQ(starts, 1U) << "the access was begun again, pause " << pause_us;
  }
}

// Table 58, decision 24: the last start bit in time and the first that is late.
TEST(ControlBusy, StartBitAtTheLimit_LastInTimeIsGood) {
  // 25 us a frame; the limit is 32.77 frames after the one that carried the S that was not
  // answered.
  for (const unsigned busy : {0U, 1U, 31U, 32U, 33U, 40U}) {
    for (const bool reading : {true, false}) {
      Chip chip(one_slave("data_bits = 14\nread_busy_frames = " + std::to_string(busy) +
                          "\nwrite_busy_frames = " + std::to_string(busy)));
      chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 13, reg::kScrclenCrc6, 0x00, 0x00});
      chip.write(reg::kAddrCtrl, {reg::kRegversBissC, 0, 0, 0x18});
      chip.write(reg::kAddrSlaveloc5,
                 {reg::kResetSlaveloc5, reg::kCfgch2Unused | reg::kCfgch1BissC});
      ControlHost host(chip);
      chip.simulator.slave(1)->reg_write(0x31, 0x77);
      if (reading) {
        host.set_read(0, 0x31, 1);
      } else {
        host.set_write(0, 0x31, {0x55});
      }
      ASSERT_TRUE(host.run_ags(8000)) << busy;
      const std::uint8_t flags = host.status() & (reg::nREGERR::kMask | reg::nDELAYERR::kMask);
      const bool in_time = busy <= 32;
      EXPECT_EQ(flags, in_time ? reg::nREGERR::kMask | reg::nDELAYERR::kMask : reg::nREGERR::kMask)
          << busy;
      if (reading && in_time) {
        EXPECT_EQ(host.rdata(1)[0], 0x77);
      }
      if (!reading) {
        EXPECT_EQ(chip.simulator.slave(1)->reg_read(0x31), in_time ? 0x55 : 0x77) << busy;
      }
    }
  }
}

}  // namespace
