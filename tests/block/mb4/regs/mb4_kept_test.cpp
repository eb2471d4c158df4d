// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Which registers are read back from the memory of mb4_recent: all addresses, written and not, in
// the whole chip and in a core with one data channel.
#include <gtest/gtest.h>

#include <array>
#include <set>

#include "Vmb4_kept.h"
#include "Vmb4_kept_one.h"
#include "mb4_regs.hpp"
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

constexpr std::uint32_t host(bool write, unsigned wr_addr, unsigned rd_addr) {
  namespace at = mb4test::places::mb4_pkg::host_t;
  return static_cast<std::uint32_t>(at::kWrEn(write ? 1 : 0) | at::kWrAddr(wr_addr) | at::kRdEn(1) |
                                    at::kRdAddr(rd_addr));
}

template <class Model>
class KeptBlock : public testing::Test {
 public:
  static std::set<unsigned> kept();
};

namespace regs = mb4::regs;

// docs/choices.md, 44: all bits of these are there in the chip.
template <>
std::set<unsigned> KeptBlock<Vmb4_kept>::kept() {
  return {regs::kAddrRegadr, regs::kAddrFreq,     regs::kAddrFreqags,
          regs::kAddrMoBusy, regs::kAddrActnsens, regs::kAddrIface};
}
// A core with one data channel, control, MO and force bits: its configuration too.
template <>
std::set<unsigned> KeptBlock<Vmb4_kept_one>::kept() {
  return {regs::kAddrRegadr,       regs::kAddrFreq,         regs::kAddrFreqags,
          regs::kAddrMoBusy,       regs::kAddrIface,        regs::kAddrSlaveCfg,
          regs::kAddrSlaveCfg + 1, regs::kAddrSlaveCfg + 2, regs::kAddrSlaveCfg + 3};
}

using Models = testing::Types<Vmb4_kept, Vmb4_kept_one>;
TYPED_TEST_SUITE(KeptBlock, Models);

TYPED_TEST(KeptBlock, EachAddress_HitsBehindItsWriteIfItIsKept) {
  const std::set<unsigned> kept = TestFixture::kept();
  for (unsigned address = 0; address < 256; ++address) {
    mb4test::Owned<TypeParam> owner;
    TypeParam& m = *owner;
    m.wr_clk_i = 0;
    m.host_i = 0;
    mb4test::pulse_reset(m);
    const bool here = kept.contains(address);

    m.host_i = host(true, address, address);
    m.eval();
    EXPECT_EQ(m.wr_o != 0, here) << std::hex << address;
    EXPECT_EQ(m.hits_o, 0) << "before the edge, " << std::hex << address;
    m.wr_clk_i = 1;
    m.eval();
    m.wr_clk_i = 0;
    m.host_i = host(false, address, address);
    m.eval();
    EXPECT_FALSE(m.wr_o) << std::hex << address;
    // The result of both addresses that differ in bit 0 only, whatever bit 0 is.
    for (unsigned bit = 0; bit < 2; ++bit) {
      for (unsigned other = 0; other < 256; other += 2) {
        m.host_i = host(false, 0, other | bit);
        m.eval();
        const unsigned hits = here && other == (address & 0xFEU) ? 1U << (address & 1U) : 0;
        EXPECT_EQ(m.hits_o, hits) << std::hex << address << " read at " << (other | bit);
      }
    }
  }
}

}  // namespace
