// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The Wishbone slave alone, between a master and a word bus, with classic and with pipelined cycles
// (rtl/common/enc_wb.sv; Wishbone B4, 3.1.3 to 3.2).
#include <gtest/gtest.h>

#include <cstdint>
#include <type_traits>

#include "Venc_wb.h"
#include "Venc_wb_pipelined.h"
#include "tests/support/model_context.hpp"

namespace {

template <typename Model>
struct Wishbone {
  Wishbone() {
    m.wb_cyc_i = m.wb_stb_i = m.wb_we_i = m.wb_sel_i = 0;
    m.wb_adr_i = 0;
    m.wb_dat_i = m.word_data_i = 0;
    m.word_ready_i = m.word_error_i = 0;
    block.reset();
  }
  void begin() {
    m.wb_cyc_i = m.wb_stb_i = 1;
    m.wb_we_i = dice.below(2) != 0;
    m.wb_adr_i = static_cast<std::uint16_t>(dice.below(1U << 10));
    m.wb_dat_i = dice.below(1U << 31) * 3U;
    m.wb_sel_i = static_cast<std::uint8_t>(dice.below(16));
  }
  bool strobe() const { return m.wb_cyc_i != 0 && m.wb_stb_i != 0; }

  mb4test::Dice dice;
  mb4test::Block<Model> block;
  Model& m = block.model;
};

template <typename Model>
class WbBlock : public testing::Test {};
using Models = testing::Types<Venc_wb, Venc_wb_pipelined>;
TYPED_TEST_SUITE(WbBlock, Models);

TYPED_TEST(WbBlock, Reset_NothingIsAskedForOrAnswered) {
  Wishbone<TypeParam> wb;
  TypeParam& m = wb.m;
  wb.begin();
  m.word_ready_i = 1;
  for (unsigned clocks = 0; clocks < 4; ++clocks) {
    for (unsigned i = 0; i < clocks; ++i) wb.block.clock();
    m.rst_ni = 0;
    m.eval();
    for (int i = 0; i < 2; ++i) {
      EXPECT_EQ(m.word_req_o, 0);
      EXPECT_EQ(m.wb_ack_o | m.wb_err_o, 0);
      EXPECT_EQ(m.wb_stall_o, 1);
      wb.block.clock();
    }
    m.rst_ni = 1;
  }
}

// A request is on the word bus a clock behind STB, as long as STB stays. The clock behind its
// access answers it in a classic cycle; in a pipelined one that clock takes STB, and the next one
// answers. In some rounds the master ends cycles or takes STB back before that, which is never
// answered.
TYPED_TEST(WbBlock, RandomTraffic_EachAccessIsDoneOnceAndAnswered) {
  constexpr bool kPipelined = std::is_same_v<TypeParam, Venc_wb_pipelined>;
  Wishbone<TypeParam> wb;
  TypeParam& m = wb.m;
  mb4test::Dice& dice = wb.dice;
  bool asked = false;  // STB waited in the clock before
  bool done = false;   // an access was done in the clock before
  bool taken = false;  // pipelined: STB was taken in the clock before
  bool error = false, answered_error = false;
  std::uint32_t data = 0, answered_data = 0;
  unsigned answers = 0, errors = 0, at_once = 0;
  for (int clock = 0; clock < 40'000; ++clock) {
    const bool takes_back = clock >= 20'000;
    if (!wb.strobe() && dice.below(3) == 0) wb.begin();
    if (takes_back && dice.below(8) == 0) m.wb_stb_i = 0;
    if (takes_back && dice.below(8) == 0) m.wb_cyc_i = m.wb_stb_i = 0;
    m.word_ready_i = dice.below(3) != 0;
    m.word_error_i = dice.below(3) == 0;
    m.word_data_i = dice.below(1U << 31) * 3U;
    m.eval();

    ASSERT_EQ(m.word_req_o != 0, asked && wb.strobe()) << clock;
    if (m.word_req_o != 0) {
      EXPECT_EQ(m.word_write_o, m.wb_we_i);
      EXPECT_EQ(m.word_addr_o, m.wb_adr_i);
      EXPECT_EQ(m.word_data_o, m.wb_dat_i);
      EXPECT_EQ(m.word_be_o, m.wb_we_i != 0 ? m.wb_sel_i : 0xF);
    }
    const bool answer = kPipelined ? taken && m.wb_cyc_i != 0 : done && wb.strobe();
    const bool bad = kPipelined ? answered_error : error;
    ASSERT_EQ(m.wb_ack_o != 0, answer && !bad) << clock;
    ASSERT_EQ(m.wb_err_o != 0, answer && bad) << clock;
    if (answer) {
      ASSERT_EQ(m.wb_dat_o, kPipelined ? answered_data : data) << clock;
      ++answers;
      errors += bad ? 1 : 0;
    }
    if (kPipelined) {
      ASSERT_EQ(m.wb_stall_o != 0, !done) << clock;
    }
    // STB of the access that was done is taken: by the answer, or, pipelined, by the clock without
    // a stall.
    const bool free = wb.strobe() && done;
    taken = free;
    answered_error = error;
    answered_data = data;
    done = m.word_req_o != 0 && m.word_ready_i != 0;
    if (done) {
      error = m.word_error_i != 0;
      data = m.word_data_i;
    }
    asked = wb.strobe() && !done;
    wb.block.clock();
    if (!free) continue;
    if (dice.below(2) == 0) {
      wb.begin();
      ++at_once;
    } else {
      m.wb_stb_i = 0;
      if (!kPipelined) m.wb_cyc_i = 0;
    }
  }
  EXPECT_GT(answers, 4000U);
  EXPECT_GT(errors, 1000U);
  EXPECT_GT(at_once, 1000U);
}

}  // namespace
