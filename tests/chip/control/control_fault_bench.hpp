// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Two slaves and a control frame with one inverted bit.
#ifndef TESTS_CHIP_CONTROL_CONTROL_FAULT_BENCH_HPP_
#define TESTS_CHIP_CONTROL_CONTROL_FAULT_BENCH_HPP_

#include <gtest/gtest.h>

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/registers/control_slave.hpp"
#include "tests/support/control_host.hpp"

namespace mb4test {

enum class Way { kCdm, kCds };
enum class Flag { kNone, kRegErr, kDelayErr };

struct Expected {
  Flag flag = Flag::kNone;
  unsigned good_bytes = 0;  // REGBYTES, with a flag
  bool operator==(const Expected&) const = default;
};
inline void PrintTo(const Expected& expected, std::ostream* out) {
  *out << "flag " << static_cast<int>(expected.flag) << ", REGBYTES " << expected.good_bytes;
}

inline constexpr Expected kGood{};
inline constexpr Expected reg_error(unsigned good) { return {Flag::kRegErr, good}; }
inline constexpr Expected delay_error(unsigned good) { return {Flag::kDelayErr, good}; }

// Two slaves; accesses go to ID 0, the far one, commands to both. FREQR = 0: short nDELAYERR limit.
class FaultBench {
 public:
  FaultBench(Way way, unsigned slot, const std::string& keys = "")
      : chip(scenario(keys)), host(chip), near(control(1)), far(control(2)) {
    for (const std::uint8_t address : {std::uint8_t{0xC0}, std::uint8_t{0xC4}}) {
      chip.write(address, {reg::kEnscdYes | 13, reg::kScrclenCrc6, 0x00, 0x00});
    }
    chip.write(reg::kAddrCtrl, {reg::kRegversBissC, 0, 0, reg::kFreqagsAgsMin});
    chip.write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5, reg::kCfgch2Unused | reg::kCfgch1BissC});
    if (way == Way::kCdm) {
      near.faults().flip_cdm_in_slot(slot);  // a fault of the line hits all slaves
      far.faults().flip_cdm_in_slot(slot);
    } else {
      near.faults().flip_cds_in_slot(slot);  // at the master's end of the chain
    }
  }

  // Runs what the host has set up, to its end.
  Expected run() {
    EXPECT_TRUE(host.run_ags(4000)) << "it never ends";
    const std::uint8_t status = host.status();
    EXPECT_NE(status & reg::REGEND::kMask, 0);
    const bool bad = (status & reg::nREGERR::kMask) == 0;
    const bool delay = (status & reg::nDELAYERR::kMask) == 0;
    EXPECT_FALSE(bad && delay);
    EXPECT_EQ((status & reg::nERR::kMask) == 0, bad || delay) << "page 34: NER";
    const unsigned good = host.regbytes();
    // The slaves see 14 zeros, also after a fault in the zeros themselves.
    chip.advance_us(150);
    EXPECT_FALSE(near.faults().pending() || far.faults().pending()) << "the fault was not reached";
    EXPECT_TRUE(bad || delay || good == 0) << "Table 63";
    return {bad ? Flag::kRegErr : delay ? Flag::kDelayErr : Flag::kNone, good};
  }
  // Checks that register access and commands work.
  void check_next() {
    const std::vector<std::uint8_t> out{0x3C, 0xC3};
    host.set_write(0, 0x50, out);
    EXPECT_EQ(run(), kGood);
    EXPECT_EQ(slave_reg(0x50), 0x3C);
    EXPECT_EQ(slave_reg(0x51), 0xC3);
    host.set_read(0, 0x50, 2);
    EXPECT_EQ(run(), kGood);
    EXPECT_EQ(host.rdata(2), out);
    const auto commands = near.counters().commands;
    host.set_command(0xC0, 3, true);
    EXPECT_EQ(run(), kGood);
    EXPECT_EQ(near.counters().commands, commands + 1);
  }
  std::uint8_t slave_reg(unsigned address) {
    return chip.simulator.slave(2)->reg_read(static_cast<std::uint8_t>(address));
  }
  void set_reg(unsigned address, std::uint8_t value) {
    chip.simulator.slave(2)->reg_write(static_cast<std::uint8_t>(address), value);
  }
  // Checks that no register of the two slaves has changed, except `count` of the far one from
  // `first_allowed` on.
  void check_untouched(unsigned first_allowed, unsigned count) {
    for (unsigned address = 0; address < 128; ++address) {
      if (address >= first_allowed && address < first_allowed + count) continue;
      EXPECT_EQ(slave_reg(address), 0) << address;
    }
    for (unsigned address = 0; address < 128; ++address) {
      EXPECT_EQ(chip.simulator.slave(1)->reg_read(static_cast<std::uint8_t>(address)), 0);
    }
  }

  Chip chip;
  ControlHost host;
  mb4::sim::ControlSlave& near;
  mb4::sim::ControlSlave& far;

 private:
  static std::string scenario(const std::string& keys) {
    const std::string slave = "data_bits = 14\ncrc = 0x43\n" + keys + "\n";
    return one_slave(slave) + "[[channel.slave]]\nprotocol = \"biss-c\"\n" + slave;
  }
  mb4::sim::ControlSlave& control(unsigned number) {
    return *clocked(chip.simulator.slave(number))->control();
  }
};

}  // namespace mb4test

#endif  // TESTS_CHIP_CONTROL_CONTROL_FAULT_BENCH_HPP_
