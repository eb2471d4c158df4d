// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Parallel bus alone: datasheet pages 9, 10, 17 (Table 2, Figures 3 to 6, 17, 18).
#include <gtest/gtest.h>

#include <vector>

#include "Vmb4_par_bus.h"
#include "tests/support/model_context.hpp"

namespace {

class ParBus : public testing::TestWithParam<bool> {
 protected:
  struct Access {
    bool write;
    unsigned address, data;
    bool operator==(const Access&) const = default;
  };

  ParBus() {
    bus.enable_i = 1;
    bus.int_nmot_i = GetParam() ? 1 : 0;
    bus.cs_ni = 1;
    bus.ale_i = 0;
    bus.nrd_rnw_i = 1;
    bus.nwr_e_i = GetParam() ? 1 : 0;
    bus.db_i = 0;
    for (const int level : {1, 0, 1}) {
      bus.rst_ni = static_cast<std::uint8_t>(level);
      bus.eval();
    }
    seen.clear();
    last_wr = bus.wr_clk_o != 0;
    last_rd = bus.rd_clk_o != 0;
  }

  // Notes what the registers would take at each rising edge of wr_clk_o and rd_clk_o.
  void eval() {
    bus.eval();
    if (bus.wr_clk_o != 0 && !last_wr) seen.push_back({true, bus.addr_o, bus.db_i});
    if (bus.rd_clk_o != 0 && !last_rd) seen.push_back({false, bus.addr_o, 0});
    last_wr = bus.wr_clk_o != 0;
    last_rd = bus.rd_clk_o != 0;
  }
  void set(std::uint8_t& pin, unsigned value) {
    pin = static_cast<std::uint8_t>(value);
    eval();
  }
  void latch(unsigned address) {
    set(bus.db_i, address);
    set(bus.ale_i, 1);
    set(bus.ale_i, 0);
    set(bus.db_i, address ^ 0xFFU);
  }
  void strobe(bool read, bool active) {
    if (GetParam()) {
      set(read ? bus.nrd_rnw_i : bus.nwr_e_i, active ? 0 : 1);
    } else {
      if (active) set(bus.nrd_rnw_i, read ? 1 : 0);
      set(bus.nwr_e_i, active ? 1 : 0);
      if (!active) set(bus.nrd_rnw_i, 1);
    }
  }

  mb4test::Owned<Vmb4_par_bus> owner;
  Vmb4_par_bus& bus = *owner;
  std::vector<Access> seen;
  bool last_wr = false, last_rd = false;
};

TEST_P(ParBus, ReadCycle_OneReadAtTheStartOfTheStrobeAndTheBusIsDrivenWhileItLasts) {
  set(bus.cs_ni, 0);
  latch(0xA5);
  EXPECT_EQ(bus.db_oe_o, 0);
  EXPECT_TRUE(seen.empty());
  strobe(true, true);
  EXPECT_EQ(seen, (std::vector<Access>{{false, 0xA5, 0}}));
  EXPECT_EQ(bus.db_oe_o, 1);
  set(bus.db_i, 0x11);  // its own data come back
  set(bus.db_i, 0xEE);
  strobe(true, false);
  EXPECT_EQ(bus.db_oe_o, 0);
  set(bus.cs_ni, 1);
  EXPECT_EQ(seen.size(), 1U);
}

TEST_P(ParBus, WriteCycle_OneWriteAtTheEndOfTheStrobe) {
  set(bus.cs_ni, 0);
  latch(0x5A);
  strobe(false, true);
  set(bus.db_i, 0x01);
  set(bus.db_i, 0x77);
  EXPECT_TRUE(seen.empty());
  EXPECT_EQ(bus.db_oe_o, 0);
  strobe(false, false);
  EXPECT_EQ(seen, (std::vector<Access>{{true, 0x5A, 0x77}}));
  set(bus.cs_ni, 1);
  EXPECT_EQ(seen.size(), 1U);
}

TEST_P(ParBus, AddressStaysForFurtherAccesses) {
  set(bus.cs_ni, 0);
  latch(0x33);
  for (unsigned i = 0; i < 3; ++i) {
    strobe(true, true);
    strobe(true, false);
    strobe(false, true);
    set(bus.db_i, i);
    strobe(false, false);
  }
  EXPECT_EQ(seen, (std::vector<Access>{{false, 0x33, 0},
                                       {true, 0x33, 0},
                                       {false, 0x33, 0},
                                       {true, 0x33, 1},
                                       {false, 0x33, 0},
                                       {true, 0x33, 2}}));
}

TEST_P(ParBus, NcsHighOrNotEnabled_NothingHappens) {
  set(bus.cs_ni, 0);
  latch(0x44);
  for (const bool enabled : {true, false}) {
    bus.enable_i = enabled ? 1 : 0;
    set(bus.cs_ni, enabled ? 1 : 0);
    seen.clear();
    latch(0x99);
    for (const bool read : {true, false}) {
      strobe(read, true);
      EXPECT_EQ(bus.db_oe_o, 0);
      strobe(read, false);
    }
    EXPECT_TRUE(seen.empty());
    EXPECT_EQ(bus.addr_o, 0x44);
  }
}

// Illegal: both strobes of the Intel bus. The chip must not drive against the host.
TEST_P(ParBus, ReadAndWriteTogether_TheBusIsNotDriven) {
  if (!GetParam()) return;  // Motorola has one strobe
  set(bus.cs_ni, 0);
  latch(0x10);
  strobe(true, true);
  strobe(false, true);
  EXPECT_EQ(bus.db_oe_o, 0);
  set(bus.db_i, 0x21);
  strobe(false, false);
  EXPECT_EQ(seen[1], (Access{true, 0x10, 0x21}));
}

INSTANTIATE_TEST_SUITE_P(Modes, ParBus, testing::Bool(), [](const auto& one) {
  return one.param ? std::string("Intel") : std::string("Motorola");
});

}  // namespace
