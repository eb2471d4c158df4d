// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The host half of the instruction register alone: pages 32, 33, Tables 44 to 49; decisions 25, 26,
// 41.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "Vmb4_instr_reg.h"
#include "mb4_regs.hpp"
#include "places.hpp"
#include "tests/block/mb4/host_port.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace reg = mb4::regs;

constexpr std::uint8_t kBreak = 0x80, kHoldBank = 0x40, kSwBank = 0x20;

namespace host_t = mb4test::places::mb4_pkg::instr_host_t;
namespace core_t = mb4test::places::mb4_pkg::instr_core_t;

class Instr : public mb4test::Owned<Vmb4_instr_reg> {
 public:
  Instr() : m(**this) {
    m.wr_clk_i = 0;
    m.host_i = 0;
    m.instr_i = m.base_i = m.newest_i = 0;
    for (const int level : {1, 0, 1}) {
      m.rst_ni = static_cast<std::uint8_t>(level);
      m.eval();
    }
  }
  void write(std::uint8_t data, std::uint8_t address = reg::kAddrInstr) {
    m.host_i = mb4test::host_writes(address, data);
    m.wr_clk_i = 1;
    m.eval();
    m.wr_clk_i = 0;
    m.host_i = 0;
    m.eval();
  }
  // The core takes one step of the Gray count 0, 1, 3, 2 and keeps the byte without BREAK.
  void core_takes() {
    static constexpr std::uint8_t kNext[] = {1, 3, 0, 2};
    const std::uint64_t ack = core_t::kAck.of(m.instr_i);
    ASSERT_NE(count(), ack);
    answer(kNext[ack], static_cast<std::uint8_t>(written() & ~kBreak));
  }
  std::uint64_t count() const { return host_t::kCount.of(m.instr_o); }
  std::uint64_t written() const { return host_t::kWritten.of(m.instr_o); }
  void answer(unsigned ack, std::uint8_t held) {
    m.instr_i = static_cast<std::uint16_t>(core_t::kAck(ack) | core_t::kHeld(held));
    m.eval();
  }
  Vmb4_instr_reg& m;
};

TEST(InstrRegBlock, AnyByte_ReadsAsWrittenUntilTheCoreHasActed) {
  for (unsigned value = 0; value < 256; ++value) {
    Instr instr;
    EXPECT_EQ(instr.m.pending_o, 0);
    instr.write(static_cast<std::uint8_t>(value));
    EXPECT_EQ(instr.written(), value);
    EXPECT_EQ(instr.m.rd_data_o, value & 0x7F) << "BREAK never reads 1";
    EXPECT_EQ(instr.m.pending_o, 1);
    const unsigned code = (value >> 1) & 7;  // Table 45
    EXPECT_EQ(instr.m.pending_control_o, code == 4 || code == 7) << value;
    instr.core_takes();
    EXPECT_EQ(instr.m.pending_o, 0);
    EXPECT_EQ(instr.m.pending_control_o, 0);
    instr.answer(static_cast<unsigned>(instr.count()), static_cast<std::uint8_t>(~value));
    EXPECT_EQ(instr.m.rd_data_o, ~value & 0xFF) << "what the core holds";
  }
}

TEST(InstrRegBlock, OtherAddresses_ChangeNothing) {
  Instr instr;
  for (unsigned address = 0; address < 256; ++address) {
    if (address == reg::kAddrInstr) continue;
    instr.write(0xFF, static_cast<std::uint8_t>(address));
    ASSERT_EQ(instr.m.pending_o, 0) << address;
    ASSERT_EQ(instr.written(), 0) << address;
  }
}

// Decision 41: writes closer than the core can take. Its last step comes with the last byte, and a
// BREAK stays in the byte until the core has acted.
TEST(InstrRegBlock, CloseWritesInAnyNumber_LastByteCountsAndNoBreakIsLost) {
  mb4test::Dice random;
  Instr instr;
  for (int round = 0; round < 5'000; ++round) {
    std::uint8_t last = 0;
    bool broken = false;
    for (unsigned i = 0, writes = 1 + random.below(5); i < writes; ++i) {
      last = static_cast<std::uint8_t>(random.below(256));
      broken = broken || (last & kBreak) != 0;
      instr.write(last);
    }
    unsigned steps = 0;
    while (instr.m.pending_o != 0) {
      ASSERT_EQ(instr.written(), (last & ~kBreak) | (broken ? kBreak : 0)) << "round " << round;
      instr.core_takes();
      ASSERT_LE(++steps, 2U) << "round " << round;
    }
  }
}

// Each step of the count changes one bit, so the core never sees a step that was not made.
TEST(InstrRegBlock, CountOfWrites_IsAGrayCount) {
  Instr instr;
  for (int i = 0; i < 9; ++i) {
    const std::uint64_t before = instr.count();
    instr.write(0);
    EXPECT_EQ(std::popcount(before ^ instr.count()), 1);
    instr.core_takes();
  }
}

// Table 49: each inversion switches the host's bank at its write, long before the core has acted.
TEST(InstrRegBlock, SwbankInverted_HostsBankIsSwitchedAtTheWrite) {
  for (const bool base : {false, true}) {
    Instr instr;
    instr.m.base_i = instr.m.newest_i = base;
    instr.m.eval();
    for (const std::uint8_t byte : {std::uint8_t{0}, kSwBank, kSwBank, std::uint8_t{0}}) {
      instr.write(byte);
      EXPECT_EQ(instr.m.bank_o, base != (byte != 0));
    }
    instr.core_takes();
    EXPECT_EQ(instr.m.bank_o, base);
  }
}

// Table 48: from the write of HOLDBANK = 1 on the host's bank stays, also when a frame ends in the
// core. A byte with HOLDBANK = 0 gives the bank with the newest word at once; a byte with HOLDBANK
// = 1 does not.
TEST(InstrRegBlock, HoldBankWritten_BankStaysUntilItIsCleared) {
  Instr instr;
  instr.write(kHoldBank);
  instr.m.base_i = instr.m.newest_i = 1;
  instr.m.eval();
  EXPECT_EQ(instr.m.bank_o, 0);
  EXPECT_EQ(instr.m.kept_o, 0);
  // The core undoes the switch; the newest word waits in the other bank.
  instr.core_takes();
  instr.m.base_i = 0;
  instr.m.eval();
  instr.write(kHoldBank);
  EXPECT_EQ(instr.m.bank_o, 0);
  instr.write(0);
  EXPECT_EQ(instr.m.bank_o, 1);
  EXPECT_EQ(instr.m.kept_o, 1);
}

}  // namespace
