// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The configuration registers alone: pages 21 to 31, Table 6 and the tables of each field. The
// addresses and bits are those of the datasheet, not of the generated map.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "Vmb4_cfg_regs.h"
#include "places.hpp"
#include "tests/block/mb4/host_port.hpp"
#include "tests/support/model_context.hpp"

namespace {

struct Field {
  const char* name;
  unsigned address, lsb, width;
  mb4test::Place place;  // in cfg_o
};
namespace at = mb4test::places::mb4_pkg::cfg_t;

constexpr Field kFields[] = {
    {"CLKENI", 0xF5, 0, 1, at::kClkeni},
    {"ENTEST", 0xF5, 1, 1, at::kEntest},
    {"CFGIF", 0xF5, 2, 2, at::kCfgif},
    {"MAFS", 0xF5, 4, 1, at::kMafs},
    {"MAVS", 0xF5, 5, 1, at::kMavs},
    {"MAFO", 0xF5, 6, 1, at::kMafo},
    {"MAVO", 0xF5, 7, 1, at::kMavo},
    {"ACTnSENS", 0xEF, 0, 8, at::kActnsens},
    {"CFGCH1", 0xED, 0, 2, at::kCfgch1},
    {"CFGCH2", 0xED, 2, 2, at::kCfgch2},
    {"SLAVELOC5", 0xEC, 4, 1, at::kSlaveloc5},
    {"MO_BUSY", 0xE9, 0, 8, at::kMoBusy},
    {"FREQAGS", 0xE8, 0, 8, at::kFreqags},
    {"SINGLEBANK", 0xE7, 0, 1, at::kSinglebank},
    {"NOCRC", 0xE7, 1, 1, at::kNocrc},
    {"FREQS", 0xE6, 0, 5, at::kFreqs},
    {"FREQR", 0xE6, 5, 3, at::kFreqr},
    {"HOLDCDM", 0xE5, 0, 1, at::kHoldcdm},
    {"EN_MO", 0xE5, 1, 1, at::kEnMo},
    {"SLAVEID", 0xE5, 3, 3, at::kAccessSlaveid},
    {"REGVERS", 0xE5, 6, 1, at::kAccessRegvers},
    {"CTS", 0xE5, 7, 1, at::kAccessCts},
    {"REGNUM", 0xE3, 0, 6, at::kAccessRegnum},
    {"REGADR", 0xE2, 0, 7, at::kAccessRegadr},
    {"WNR", 0xE2, 7, 1, at::kAccessWnr},
    {"CHSEL", 0xE4, 0, 2, at::kAccessChsel},
};

class CfgRegsBlock : public testing::Test {
 protected:
  CfgRegsBlock() {
    m.wr_clk_i = 0;
    m.host_i = 0;
    mb4test::pulse_reset(m);
  }
  void write(unsigned address, unsigned byte, bool enable = true) {
    m.host_i = mb4test::host_writes(address, byte, enable);
    m.wr_clk_i = 1;
    m.eval();
    m.wr_clk_i = 0;
    m.eval();
  }
  unsigned read(unsigned address) {
    m.host_i = address;
    m.eval();
    return (address & 1U) != 0 ? m.rd_data_o >> 8 : m.rd_data_o & 0xFFU;
  }
  // `written`: the last byte of each address. Decision 13: bits of no field read 0. Registers
  // without such a bit read 0 here, as mb4_recent has them.
  void expect(const std::array<unsigned, 256>& written) {
    std::array<unsigned, 256> reads{};
    std::array<unsigned, 256> used{};
    reads[0xEC] = 0x01;  // page 22
    for (const Field& field : kFields) {
      const unsigned mask = (1U << field.width) - 1;
      const unsigned value = written[field.address] >> field.lsb & mask;
      reads[field.address] |= value << field.lsb;
      used[field.address] |= mask << field.lsb;
      ASSERT_EQ(field.place.width, field.width) << field.name;
      ASSERT_EQ(field.place.get(m.cfg_o), value) << field.name;
    }
    // mb4_host_read takes the bytes for these addresses only.
    for (unsigned address = 0xE0; address < 256; ++address) {
      ASSERT_EQ(read(address), used[address] == 0xFF ? 0 : reads[address]) << std::hex << address;
    }
  }
  mb4test::Owned<Vmb4_cfg_regs> owner;
  Vmb4_cfg_regs& m = *owner;
};

TEST_F(CfgRegsBlock, RandomWrites_ReadBackAndReachTheirFields) {
  mb4test::Dice random;
  std::array<unsigned, 256> written{};
  expect(written);
  for (int step = 0; step < 3'000; ++step) {
    SCOPED_TRACE(testing::Message() << "step " << step);
    const unsigned address = random.below(4) == 0 ? random.below(256) : 0xE0 + random.below(32);
    const unsigned byte = random.below(256);
    const bool enable = random.below(4) != 0;
    write(address, byte, enable);
    if (enable) written[address] = byte;
    expect(written);
    if (HasFatalFailure()) return;
  }
  // Page 22: a reset sets all of them to 0, without a clock.
  m.rst_ni = 0;
  m.eval();
  m.rst_ni = 1;
  m.eval();
  expect({});
}

}  // namespace
