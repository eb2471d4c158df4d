// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The tests invert one bit of a control frame after another, to the slaves (CDM) and back (CDS). An
// access reported as good must be done, flags must be those of pages 34 and 35, and the next access
// must work. Where the protocol cannot detect the fault (no acknowledge after the bit), the test
// says so.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/lines/registers/control_slave.hpp"
#include "tests/chip/control/control_fault_bench.hpp"

namespace {

using mb4test::delay_error;
using mb4test::Expected;
using mb4test::FaultBench;
using mb4test::Flag;
using mb4test::kGood;
using mb4test::reg_error;
using mb4test::Way;
namespace reg = mb4::regs;
using Bytes = std::vector<std::uint8_t>;

// Line bits: 10100101 0100 and 00000110 0101 (TI TIDEP0022 and CRC4 of the protocol).
const Bytes kBytes{0xA5, 0x06};
constexpr unsigned kAddress = 0x30;
constexpr unsigned kLastSlot = 46;  // end mark of two bytes

// ---- read: two bytes ------------------------------------------------------------------------

Expected of_read(Way way, unsigned slot) {
  if (way == Way::kCdm) {
    if (slot <= 17) return reg_error(0);  // header, R, W: not confirmed
    if (slot == 18) return delay_error(0);
    // The slave sends zeros from the next bit on: the last two CRC bits of 0xA5 are zeros.
    if (slot <= 28) return reg_error(0);
    if (slot <= 31) return delay_error(1);  // no start bit for the second byte
    // Slot 32 is the 14th zero: the slaves take the repeated S for the start of a control frame,
    // and the master their IDL bits for the second byte. Its CRC does not fit.
    if (slot <= 44) return reg_error(1);
    return kGood;  // P and end mark: everything has been read
  }
  if (slot <= 16) return kGood;  // IDL and zeros: not for the master
  if (slot <= 18) return reg_error(0);
  if (slot == 19) return delay_error(0);  // the repeated S makes the slave fall silent
  if (slot <= 31) return reg_error(0);
  if (slot == 32) return kGood;
  if (slot == 33) return delay_error(1);
  if (slot <= 45) return reg_error(1);
  return kGood;
}

struct Fault {
  Way way;
  unsigned slot;
};
std::string name_of(const Fault& fault) {
  return (fault.way == Way::kCdm ? "Cdm" : "Cds") + std::to_string(fault.slot);
}
void PrintTo(const Fault& fault, std::ostream* out) { *out << name_of(fault); }

class ControlFaults : public testing::TestWithParam<Fault> {};

TEST_P(ControlFaults, Read_GivesGoodBytesOnly) {
  const auto [way, slot] = GetParam();
  FaultBench bench(way, slot);
  bench.set_reg(kAddress, kBytes[0]);
  bench.set_reg(kAddress + 1, kBytes[1]);
  const Bytes before{0xE1, 0xE2};
  bench.chip.write(reg::kAddrRdata, {before[0], before[1]});
  bench.host.set_read(0, kAddress, 2);
  const Expected result = bench.run();
  EXPECT_EQ(result, of_read(way, slot));
  const unsigned good = result.flag == Flag::kNone ? 2 : result.good_bytes;
  const Bytes data = bench.host.rdata(2);
  // Page 28: data are stored after they have come well.
  for (unsigned i = 0; i < 2; ++i) EXPECT_EQ(data[i], i < good ? kBytes[i] : before[i]);
  EXPECT_EQ(bench.near.counters().commands + bench.far.counters().commands, 0U);
  bench.check_next();
}

// ---- write: two bytes -----------------------------------------------------------------------

Expected of_write(Way way, unsigned slot) {
  if (way == Way::kCdm) {
    if (slot <= 17) return reg_error(0);
    if (slot == 18) return delay_error(0);
    if (slot <= 30) return reg_error(0);  // repeated CDS differs
    if (slot <= 32) return delay_error(1);
    if (slot <= 44) return reg_error(1);
    return kGood;
  }
  if (slot <= 16) return kGood;
  if (slot <= 18) return reg_error(0);
  // The slave takes the repeated S for D7 and echoes it: see LostStartBit below.
  if (slot == 19) return delay_error(1);
  if (slot <= 31) return reg_error(0);
  if (slot == 32) return kGood;
  return slot <= 45 ? reg_error(1) : kGood;
}

TEST_P(ControlFaults, Write_ReportsGoodOnlyWhatIsWritten) {
  const auto [way, slot] = GetParam();
  FaultBench bench(way, slot);
  bench.host.set_write(0, kAddress, kBytes);
  const Expected result = bench.run();
  EXPECT_EQ(result, of_write(way, slot));
  const unsigned good = result.flag == Flag::kNone ? 2 : result.good_bytes;
  for (unsigned i = 0; i < 2; ++i) {
    const unsigned value = bench.slave_reg(kAddress + i);
    EXPECT_TRUE(value == 0 || value == kBytes[i]) << "a value that nobody has sent";
    if (i < good && !(way == Way::kCds && slot == 19)) {
      EXPECT_EQ(value, kBytes[i]);
    }
  }
  bench.check_untouched(kAddress, 2);
  bench.check_next();
}

std::vector<Fault> all_faults() {
  std::vector<Fault> faults;
  for (unsigned slot = 0; slot <= kLastSlot; ++slot) faults.push_back({Way::kCdm, slot});
  for (unsigned slot = 1; slot <= kLastSlot; ++slot) faults.push_back({Way::kCds, slot});
  return faults;
}
INSTANTIATE_TEST_SUITE_P(EachSlot, ControlFaults, testing::ValuesIn(all_faults()),
                         [](const auto& tested) { return name_of(tested.param); });

// ---- commands -------------------------------------------------------------------------------

struct CommandCase {
  std::uint8_t ids;
  bool tested;
  unsigned last_slot;  // that the command has
};
constexpr CommandCase kBroadcast{0x00, false, 17};
constexpr CommandCase kImmediate{0xC0, false, 24};
constexpr CommandCase kTested{0xC0, true, 25};

// `ex`: the slot of EX. After the header only this bit decides whether the slaves execute the
// command. They confirm before EX comes, or are not asked, so no slave can report that EX was lost.
void command_matrix(const CommandCase& command, unsigned ex) {
  const bool addressed = command.ids != 0;
  for (const Way way : {Way::kCdm, Way::kCds}) {
    for (unsigned slot = way == Way::kCdm ? 0 : 1; slot <= command.last_slot; ++slot) {
      SCOPED_TRACE((way == Way::kCdm ? "CDM " : "CDS ") + std::to_string(slot));
      FaultBench bench(way, slot);
      bench.host.set_command(command.ids, 3, command.tested);
      const bool header = way == Way::kCdm && slot <= 15;
      const bool ida = way == Way::kCds && slot >= 17 && slot <= 24;
      const Flag flag = addressed && (header || ida) ? Flag::kRegErr : Flag::kNone;
      EXPECT_EQ(bench.run().flag, flag);
      const bool executed =
          !header && !(way == Way::kCdm && slot == ex) && !(ida && command.tested);  // Table 34
      EXPECT_EQ(bench.near.counters().commands, executed ? 1U : 0U);
      EXPECT_EQ(bench.far.counters().commands, executed ? 1U : 0U);
      bench.check_untouched(0, 0);
      bench.check_next();
    }
  }
}

TEST(ControlFaultMatrix, Broadcast_IsDoneOrNotButNeverReported) { command_matrix(kBroadcast, 16); }
TEST(ControlFaultMatrix, AddressedAtOnce_IsReportedByIda) { command_matrix(kImmediate, 16); }
TEST(ControlFaultMatrix, AddressedTested_IsNotDoneAfterAnIdaError) { command_matrix(kTested, 24); }

// One of two addressed slaves misses the command: the test of IDA keeps the other from it, too.
TEST(ControlFaultMatrix, OneSlaveMissesTheHeader_TestedCommandIsDoneByNone) {
  for (const bool tested : {false, true}) {
    for (unsigned slot = 0; slot <= 15; ++slot) {
      FaultBench bench(Way::kCdm, slot);
      bench.near.faults() = {};
      bench.host.set_command(0xC0, 3, tested);
      EXPECT_EQ(bench.run().flag, Flag::kRegErr) << slot;
      EXPECT_EQ(bench.near.counters().commands, tested ? 0U : 1U) << slot;
      EXPECT_EQ(bench.far.counters().commands, 0U) << slot;
      bench.check_next();
    }
  }
}

// ---- a slave that takes its time ------------------------------------------------------------

// A fault puts a start bit on the line while the slave is busy. No data follow it.
TEST(ControlFaultMatrix, FalseStartBitWhileBusy_IsAnError) {
  for (const bool reading : {true, false}) {
    for (unsigned slot = 19; slot <= 22; ++slot) {
      FaultBench bench(Way::kCds, slot, "read_busy_frames = 4\nwrite_busy_frames = 4");
      bench.set_reg(kAddress, kBytes[0]);
      if (reading) {
        bench.host.set_read(0, kAddress, 1);
      } else {
        bench.host.set_write(0, kAddress, {0x06});
      }
      EXPECT_EQ(bench.run(), reg_error(0)) << slot;
      EXPECT_EQ(bench.slave_reg(kAddress), kBytes[0]);
      bench.check_next();
    }
  }
}

TEST(ControlFaultMatrix, SilentSlaveAndWrongCrc_AreReported) {
  FaultBench bench(Way::kCds, 1);
  bench.set_reg(kAddress, 0x11);
  bench.host.set_read(0, kAddress, 1);
  bench.far.faults().set_wrong_data_crc(true);
  EXPECT_EQ(bench.run(), reg_error(0));
  bench.far.faults().set_wrong_data_crc(false);
  bench.far.faults().set_silent(true);
  EXPECT_EQ(bench.run(), reg_error(0));
  bench.host.set_write(0, kAddress, {0x22});
  EXPECT_EQ(bench.run(), reg_error(0));
  bench.host.set_command(0x80, 3);
  EXPECT_EQ(bench.run().flag, Flag::kRegErr);
  bench.far.faults().set_silent(false);
  EXPECT_EQ(bench.slave_reg(kAddress), 0x11);
  bench.check_next();
}

}  // namespace
