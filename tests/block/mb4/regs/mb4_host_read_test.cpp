// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What the host reads at each address: pages 21, 22 and 34 to 36, Tables 6, 41, 42, 54 to 67. The
// addresses and bits are those of the datasheet, not of the generated map.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "Vmb4_host_read.h"
#include "places.hpp"
#include "tests/block/mb4/host_port.hpp"
#include "tests/support/model_context.hpp"

namespace {

// The inputs, by the names of the datasheet.
struct Sources {
  bool ready, recent_hit, bank;
  unsigned lo, hi, rdata, recent, slave, cfg, instr;  // lo, hi: bank 1 in the upper byte
  bool instr_pending, control_pending;
  bool n_agserr, n_delayerr, n_scderr, n_regerr, regend, eot, swbank_fail, cdm_timeout;
  bool n_err, sl1, sl2;
  unsigned regbytes, svalid, cds;  // svalid, cds: bank 1 in the upper half
  bool cdssel2;
  unsigned revision;

  // Table 6, and docs/choices.md: 13 (reserved addresses; in cfg they are 0), 26 (EOT and REGEND
  // after an instruction), 36 (a byte that is on its way), "after reset".
  unsigned read(unsigned address) const {
    const auto of_bank = [&](unsigned two) { return bank ? two >> 8 : two & 0xFF; };
    if (address < 0xC0 && (address < 0x40 || address >= 0x80)) {
      if (recent_hit) return recent;
      if (!ready) return 0;
      return address >= 0x80 ? rdata : of_bank(address < 0x20 ? lo : hi);
    }
    if (address >= 0xC0 && address < 0xE0) return slave;
    const unsigned cds_now = bank ? cds >> 2 : cds & 3;
    unsigned flags = 0;  // of the four data channels, at bits 1, 3, 5, 7
    for (unsigned i = 0; i < 4; ++i) {
      flags |= (of_bank(svalid) >> (i + (address == 0xF2 ? 4 : 0)) & 1U) << (2 * i + 1);
    }
    switch (address) {
      case 0xEA:
        return revision == 1 ? 0x10 : revision == 2 ? 0x11 : 0x20;
      case 0xEB:
        return 0x84;
      case 0xF0:
        return n_err << 7 | n_agserr << 6 | n_delayerr << 5 | n_scderr << 4 | n_regerr << 3 |
               (regend && !control_pending) << 2 | 0x02 | (eot && !instr_pending);
      case 0xF1:
      case 0xF2:
        return flags;
      case 0xF3:
        return cdm_timeout << 7 | (cds_now >> cdssel2 & 1U) << 6 | regbytes;
      case 0xF4:
        return instr;
      case 0xF8:
        return 0x50 | (cds_now >> 1) << 3 | sl2 << 2 | (cds_now & 1U) << 1 | sl1;
      case 0xF9:
        return 0x55;
      case 0xFB:
        return swbank_fail;
      default:
        if (recent_hit) return recent;
        return address < 0xE0 || address == 0xFF ? 0 : (address & 1U) != 0 ? cfg >> 8 : cfg & 0xFFU;
    }
  }
};

Sources random_sources(mb4test::Dice& random) {
  const auto bit = [&] { return random.below(2) != 0; };
  const auto byte = [&] { return random.below(256); };
  const auto word = [&] { return random.below(65536); };
  Sources s{};
  s.ready = random.below(8) != 0;
  s.recent_hit = random.below(8) == 0;
  s.bank = bit();
  s.lo = word(), s.hi = word(), s.svalid = word();
  s.rdata = byte(), s.recent = byte(), s.slave = byte(), s.cfg = word(), s.instr = byte();
  s.instr_pending = bit(), s.control_pending = bit();
  s.n_agserr = bit(), s.n_delayerr = bit(), s.n_scderr = bit(), s.n_regerr = bit();
  s.regend = bit(), s.eot = bit(), s.swbank_fail = bit(), s.cdm_timeout = bit();
  s.n_err = bit(), s.sl1 = bit(), s.sl2 = bit(), s.cdssel2 = bit();
  s.regbytes = random.below(64), s.cds = random.below(16), s.revision = random.below(3);
  return s;
}

void drive(Vmb4_host_read& m, const Sources& s) {
  m.ram_ready_i = s.ready;
  m.bank_i = s.bank;
  m.cfg_data_i = static_cast<std::uint16_t>(s.cfg);
  m.instr_data_i = static_cast<std::uint8_t>(s.instr);
  m.instr_pending_i = s.instr_pending;
  m.control_pending_i = s.control_pending;
  m.svalid_i = static_cast<std::uint16_t>(s.svalid);
  m.cds_i = static_cast<std::uint8_t>(s.cds);
  m.cdssel2_i = s.cdssel2;
  m.revision_sel_i = static_cast<std::uint8_t>(s.revision);
  using namespace mb4test::places::mb4_pkg::status_t;
  m.status_i = static_cast<std::uint32_t>(
      kFlagsNAgserr(s.n_agserr) | kFlagsNDelayerr(s.n_delayerr) | kFlagsNScderr(s.n_scderr) |
      kFlagsNRegerr(s.n_regerr) | kFlagsRegend(s.regend) | kFlagsEot(s.eot) |
      kFlagsSwbankFail(s.swbank_fail) | kFlagsCdmTimeout(s.cdm_timeout) |
      kFlagsRegbytes(s.regbytes) | kNErr(s.n_err) | kSl2(s.sl2) | kSl1(s.sl1));
}

// The read registers of the memories, which change with the same edge.
void drive_memories(Vmb4_host_read& m, const Sources& s) {
  m.scd_lo_data_i = static_cast<std::uint16_t>(s.lo);
  m.scd_hi_data_i = static_cast<std::uint16_t>(s.hi);
  m.rdata_data_i = static_cast<std::uint8_t>(s.rdata);
  m.recent_hit_i = s.recent_hit;
  m.recent_data_i = static_cast<std::uint8_t>(s.recent);
  m.slave_data_i = static_cast<std::uint8_t>(s.slave);
}

// REGADR, FREQ, FREQAGS, MO_BUSY, ACTNSENS, the byte of the force bits: pages 27 to 33.
constexpr std::array<unsigned, 6> kWhole{0xE2, 0xE6, 0xE8, 0xE9, 0xEF, 0xF5};

TEST(HostReadBlock, EveryAddressAndRandomSources_ReadsAsTable6) {
  mb4test::Dice random;
  mb4test::Owned<Vmb4_host_read> owner;
  Vmb4_host_read& m = *owner;
  m.rd_clk_i = 0;
  m.host_i = 0;
  m.slave_data_i = 0;  // mb4_slave_cfg after a reset
  mb4test::pulse_reset(m);
  EXPECT_EQ(m.rd_data_o, 0);
  for (int round = 0; round < 100; ++round) {
    for (unsigned address = 0; address < 256; ++address) {
      Sources s = random_sources(random);
      // mb4_recent answers for the memories, and for registers without a reserved bit, which the
      // flops of the configuration then leave 0.
      const bool whole = std::ranges::find(kWhole, address) != kWhole.end();
      const bool memory = address < 0xC0 && (address < 0x40 || address >= 0x80);
      s.recent_hit = s.recent_hit && (memory || whole);
      if (s.recent_hit && whole) s.cfg &= (address & 1U) != 0 ? 0x00FFU : 0xFF00U;
      // mb4_slave_cfg gives 0 at the addresses of others.
      if (address < 0xC0 || address >= 0xE0) s.slave = 0;
      drive(m, s);
      m.host_i = mb4test::host_reads(address);
      m.eval();
      m.rd_clk_i = 1;
      m.eval();
      drive_memories(m, s);
      m.rd_clk_i = 0;
      m.eval();
      ASSERT_EQ(m.rd_data_o, s.read(address)) << std::hex << address;
      // Nothing changes the byte until the next read.
      drive(m, random_sources(random));
      m.host_i = random.below(256);
      m.rd_clk_i = 1;
      m.eval();
      m.rd_clk_i = 0;
      m.eval();
      ASSERT_EQ(m.rd_data_o, s.read(address)) << std::hex << address;
    }
  }
}

}  // namespace
