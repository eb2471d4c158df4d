// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The store of sensor data: where received bytes and line delays go, and words that SWBANK splits.
// Pages 23, 26, 32, 33, 35, Tables 10, 20, 49, 61; decisions 16, 34.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "Vmb4_scd_store.h"
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace pkg = mb4test::places::mb4_pkg;
namespace line_t = mb4test::places::biss_pkg::line_data_t;

// What a line tells.
struct Line {
  bool wr_en = false;
  unsigned slave = 0, wr_byte = 0, wr_data = 0;
  bool first = false, open = false, done = false, ok = false;
  bool delay_en = false;
  unsigned delay = 0;

  std::uint64_t port() const {
    using namespace line_t;
    return kRxSlave(slave) | kRxWrEn(wr_en) | kRxWrByte(wr_byte) | kRxWrData(wr_data) |
           kRxFirst(first) | kRxOpen(open) | kRxDone(done) | kRxOk(ok) | kDelayEn(delay_en) |
           kDelay(delay);
  }
};

constexpr auto kSwap = static_cast<unsigned>(pkg::bank_cmd_t::kSwap(1));

class ScdStore : public mb4test::Block<Vmb4_scd_store> {
 public:
  ScdStore() {
    model.slaveloc5_i = model.banks_i = model.bank_i = model.post_valid_i = 0;
    model.post_i = 0;
    model.clear_i = 0;
    model.rd_clk_i = model.rd_i = model.rd2_clk_i = model.rd2_i = 0;
    model.mo_read_i = 0;
    model.data_i = 0;
    reset();
    for (unsigned address = 0; address < 64; ++address) {
      model.clear_i =
          static_cast<std::uint16_t>(pkg::mem_wr_t::kEn(1) | pkg::mem_wr_t::kAddr(address));
      clock();
    }
    model.clear_i = 0;
  }
  void apply(const std::array<Line, 2>& lines) {
    model.data_i = lines[1].port() << line_t::kAllBits | lines[0].port();
    model.eval();
  }
  // The byte of a bank at an address of Table 20, as the host reads it.
  unsigned read(unsigned bank, unsigned address) {
    model.rd_i =
        static_cast<std::uint8_t>(pkg::mem_rd_t::kEn(1) | pkg::mem_rd_t::kAddr(address & 31));
    model.rd_clk_i = 1;
    model.eval();
    model.rd_clk_i = 0;
    model.eval();
    const unsigned both = address < 32 ? model.rd_lo_data_o : model.rd_hi_data_o;
    return both >> (8 * bank) & 0xFF;
  }
};

TEST(ScdStoreBlock, RandomBytes_StandAtTheAddressesOfTable20) {
  mb4test::Dice random;
  ScdStore store;
  auto& m = store.model;
  unsigned expected[2][64] = {};
  for (int step = 0; step < 20'000; ++step) {
    const bool two_lines = random.below(2) != 0;
    const bool init = random.below(8) == 0;  // INIT measures delays and receives no word
    const unsigned host = random.below(2);
    const unsigned engine = random.below(2);
    m.slaveloc5_i = two_lines;
    m.banks_i = static_cast<std::uint8_t>(pkg::banks_t::kHost(host) | pkg::banks_t::kEng(engine));
    std::array<Line, 2> lines;
    for (unsigned i = 0; i < 2; ++i) {
      Line& line = lines[i];
      const bool here = i == 0 || two_lines;
      line.wr_en = here && !init && random.below(2) != 0;
      // Table 10: data channels 5 to 8 are those of line 2 with SLAVELOC5 = 1, else of line 1.
      line.slave = two_lines ? 4 * i + random.below(4) : random.below(8);
      line.wr_byte = random.below(8);
      line.wr_data = random.below(256);
      line.delay_en = here && init && random.below(2) != 0;
      line.delay = random.below(256);
      if (line.wr_en) expected[engine][8 * line.slave + line.wr_byte] = line.wr_data;
      // Page 33: SCDATA1(7:0) and SCDATA5(7:0), in the bank that the host reads.
      if (line.delay_en) expected[host][32 * i] = line.delay;
    }
    store.apply(lines);
    store.clock();
    store.apply({});
    store.clock();  // bytes are in the memory one clock late
    for (const unsigned address : {random.below(64), 0U, 32U}) {
      for (unsigned bank = 0; bank < 2; ++bank) {
        ASSERT_EQ(store.read(bank, address), expected[bank][address])
            << "step " << step << " bank " << bank << " address " << address;
      }
    }
  }
}

// Words of both lines at any time, good ones, and SWBANK now and then.
TEST(ScdStoreBlock, SwbankAtAnyTime_WordsItSplitsAreNotValidAndNoOthers) {
  mb4test::Dice random;
  ScdStore store;
  store.model.slaveloc5_i = 1;
  bool split[2] = {};
  unsigned left[2] = {};  // clocks until the word ends
  unsigned slave[2] = {0, 4};
  unsigned seen_split = 0, seen_whole = 0;
  unsigned banks = 1;
  std::array<std::optional<std::pair<unsigned, bool>>, 2> told;  // flag of a word that has ended
  for (int step = 0; step < 50'000; ++step) {
    const bool swap = random.below(10) == 0;
    std::array<Line, 2> lines;
    unsigned bad = 0;
    for (unsigned i = 0; i < 2; ++i) {
      lines[i].slave = slave[i];
      lines[i].open = left[i] > 1;
      lines[i].done = lines[i].ok = left[i] == 1;
      if (lines[i].open && swap) split[i] = true;
      // A word that ends now is complete, also if SWBANK comes now.
      if (lines[i].done && split[i]) bad |= 1U << i;
    }
    store.model.banks_i = static_cast<std::uint8_t>(banks);
    store.model.bank_i = swap ? kSwap : 0;
    store.apply(lines);
    ASSERT_EQ(store.model.word_bad_o, bad) << "step " << step;
    store.clock();
    // SVALID follows one clock after the word.
    for (auto& one : told) {
      if (one) {
        ASSERT_EQ(store.model.svalid_o >> one->first & 1, one->second) << "step " << step;
      }
      one.reset();
    }
    for (unsigned i = 0; i < 2; ++i) {
      const unsigned flag = (banks & 1) * 8 + slave[i];
      if (left[i] == 1) {
        ++(split[i] ? seen_split : seen_whole);
        told[i] = {flag, !split[i]};
      }
      if (left[i] > 0) {
        --left[i];
      } else if (random.below(3) == 0) {
        left[i] = 2 + random.below(12);
        split[i] = false;
        slave[i] = 4 * i + random.below(4);
      }
    }
    if (swap) banks ^= 3;
  }
  EXPECT_GT(seen_split, 1000U);
  EXPECT_GT(seen_whole, 1000U);
}

// A wrong CRC is told, with or without SWBANK.
TEST(ScdStoreBlock, WrongCrc_WordIsBad) {
  ScdStore store;
  for (const bool ok : {true, false}) {
    std::array<Line, 2> lines;
    lines[0].done = true;
    lines[0].ok = ok;
    store.apply(lines);
    EXPECT_EQ(store.model.word_bad_o, ok ? 0U : 1U);
    store.clock();
    store.apply({});
    store.clock();
    EXPECT_EQ(store.model.svalid_o & 1, ok ? 1 : 0);
  }
}

}  // namespace
