// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The AXI4-Lite subordinate alone, between a manager and a word bus (rtl/common/enc_axil.sv;
// IHI0022, A3 and B1).
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>

#include "Venc_axil.h"
#include "tests/support/model_context.hpp"

namespace {

constexpr unsigned kSlverr = 2;

class AxilBlock : public testing::Test {
 protected:
  AxilBlock() {
    m.s_axi_awvalid = m.s_axi_wvalid = m.s_axi_arvalid = 0;
    m.s_axi_awaddr = m.s_axi_araddr = 0;
    m.s_axi_wdata = 0;
    m.s_axi_wstrb = 0;
    m.s_axi_bready = m.s_axi_rready = 1;
    m.word_ready_i = m.word_error_i = 0;
    m.word_data_i = 0;
    block.reset();
  }
  std::uint16_t any_address() { return static_cast<std::uint16_t>(dice.below(1U << 10)); }
  void begin_write() {
    m.s_axi_awaddr = any_address();
    m.s_axi_wdata = dice.below(1U << 31) * 3U;
    m.s_axi_wstrb = static_cast<std::uint8_t>(dice.below(16));
    m.s_axi_awvalid = m.s_axi_wvalid = 1;
  }
  void begin_read() {
    m.s_axi_araddr = any_address();
    m.s_axi_arvalid = 1;
  }
  bool writes() const { return m.s_axi_awvalid != 0 && m.s_axi_wvalid != 0; }
  bool reads() const { return m.s_axi_arvalid != 0; }
  // The payload of the word bus is that of the request.
  void expect_request() {
    if (m.word_write_o != 0) {
      EXPECT_TRUE(writes());
      EXPECT_EQ(m.word_addr_o, m.s_axi_awaddr);
      EXPECT_EQ(m.word_data_o, m.s_axi_wdata);
      EXPECT_EQ(m.word_be_o, m.s_axi_wstrb);
    } else {
      EXPECT_TRUE(reads());
      EXPECT_EQ(m.word_addr_o, m.s_axi_araddr);
      EXPECT_EQ(m.word_be_o, 0xF);
    }
  }
  mb4test::Dice dice;
  mb4test::Block<Venc_axil> block;
  Venc_axil& m = block.model;
};

TEST_F(AxilBlock, Reset_NothingIsReadyOrValid) {
  begin_read();
  for (unsigned clocks = 0; clocks < 4; ++clocks) {
    m.word_ready_i = 1;
    for (unsigned i = 0; i < clocks; ++i) block.clock();
    m.rst_ni = 0;
    m.eval();
    for (int i = 0; i < 2; ++i) {
      EXPECT_EQ(m.s_axi_awready | m.s_axi_wready | m.s_axi_arready, 0);
      EXPECT_EQ(m.s_axi_bvalid | m.s_axi_rvalid, 0);
      EXPECT_EQ(m.word_req_o, 0);
      block.clock();
    }
    m.rst_ni = 1;
  }
}

// Each channel of the manager has delays of its own, and the word bus waits as it likes. An access
// is done once. Its READY comes in the clock behind it, its answer in the next one, which stays
// until it is taken. Nothing else runs meanwhile. A request that waits while nothing runs is on the
// word bus a clock later; of two that wait the kind changes.
TEST_F(AxilBlock, RandomTraffic_EachAccessIsDoneOnceAndAnswered) {
  enum class Phase { kRest, kDone, kAnswer };
  Phase phase = Phase::kRest;
  bool asked = false, both = false;  // in the clock before, at rest
  bool write = false, error = false;
  std::uint32_t data = 0;
  std::optional<bool> last;
  std::array<unsigned, 2> done{};
  unsigned turns = 0;
  for (int clock = 0; clock < 40'000; ++clock) {
    const unsigned rare = 1 + static_cast<unsigned>(clock / 10'000) * 3;
    if (m.s_axi_awvalid == 0 && dice.below(rare) == 0) {
      m.s_axi_awaddr = any_address();
      m.s_axi_awvalid = 1;
    }
    if (m.s_axi_wvalid == 0 && dice.below(rare) == 0) {
      m.s_axi_wdata = dice.below(1U << 31) * 3U;
      m.s_axi_wstrb = static_cast<std::uint8_t>(dice.below(16));
      m.s_axi_wvalid = 1;
    }
    if (m.s_axi_arvalid == 0 && dice.below(rare) == 0) begin_read();
    m.s_axi_bready = dice.below(3) != 0;
    m.s_axi_rready = dice.below(3) != 0;
    m.word_ready_i = dice.below(3) != 0;
    m.word_error_i = dice.below(3) == 0;
    m.word_data_i = dice.below(1U << 31) * 3U;
    m.eval();

    ASSERT_EQ(m.s_axi_awready != 0, phase == Phase::kDone && write) << clock;
    ASSERT_EQ(m.s_axi_wready, m.s_axi_awready) << clock;
    ASSERT_EQ(m.s_axi_arready != 0, phase == Phase::kDone && !write) << clock;
    ASSERT_EQ(m.s_axi_bvalid != 0, phase == Phase::kAnswer && write) << clock;
    ASSERT_EQ(m.s_axi_rvalid != 0, phase == Phase::kAnswer && !write) << clock;
    ASSERT_EQ(m.word_req_o != 0, phase == Phase::kRest && asked) << clock;
    Phase next = phase;
    if (phase == Phase::kAnswer) {
      EXPECT_EQ(write ? m.s_axi_bresp : m.s_axi_rresp, error ? kSlverr : 0U);
      if (!write) {
        EXPECT_EQ(m.s_axi_rdata, data);
      }
      if ((write ? m.s_axi_bready : m.s_axi_rready) != 0) next = Phase::kRest;
    }
    if (m.word_req_o != 0) {
      expect_request();
      if (both && last) {
        ASSERT_NE(m.word_write_o != 0, *last) << clock;
        ++turns;
      }
      if (m.word_ready_i != 0) {
        next = Phase::kDone;
        write = m.word_write_o != 0;
        error = m.word_error_i != 0;
        data = m.word_data_i;
        last = write;
        ++done[write ? 1 : 0];
      }
    }
    // The request that the module takes is chosen in the first clock of a rest.
    if (!asked) both = writes() && reads();
    if (phase == Phase::kRest && !writes() && !reads()) last.reset();
    asked = phase == Phase::kRest && next == Phase::kRest && (writes() || reads());
    const bool taken = phase == Phase::kDone;
    if (taken) next = Phase::kAnswer;
    block.clock();
    if (taken && write) m.s_axi_awvalid = m.s_axi_wvalid = 0;
    if (taken && !write) m.s_axi_arvalid = 0;
    phase = next;
  }
  EXPECT_GT(done[0], 1000U);
  EXPECT_GT(done[1], 1000U);
  EXPECT_GT(turns, 1000U);
}

// Misuse: the request leaves the word bus in the same clock, gets no answer, and the next access is
// done as any.
TEST_F(AxilBlock, RequestTakenBack_GetsNoAnswer) {
  enum class What { kRead, kAddress, kData, kWrite };
  for (const What what : {What::kRead, What::kAddress, What::kData, What::kWrite}) {
    for (unsigned wait = 0; wait < 4; ++wait) {
      // Up to the clock of READY, which is that of the handshake.
      for (unsigned at = 0; at <= wait + 2; ++at) {
        SCOPED_TRACE(testing::Message() << "wait " << wait << " taken back at " << at << " what "
                                        << static_cast<int>(what));
        const bool read = what == What::kRead;
        read ? begin_read() : begin_write();
        for (unsigned i = 0; i < at; ++i) {
          m.word_ready_i = i == 1 + wait;
          block.clock();
        }
        if (read) m.s_axi_arvalid = 0;
        if (what == What::kAddress || what == What::kWrite) m.s_axi_awvalid = 0;
        if (what == What::kData || what == What::kWrite) m.s_axi_wvalid = 0;
        m.word_ready_i = 1;
        for (int i = 0; i < 6; ++i) {
          m.eval();
          EXPECT_EQ(m.word_req_o, 0);
          EXPECT_EQ(m.s_axi_bvalid | m.s_axi_rvalid, 0);
          block.clock();
        }
        m.s_axi_awvalid = m.s_axi_wvalid = 0;
        begin_read();
        m.word_data_i = 0x1000U * wait + at;
        block.clock();
        m.eval();
        EXPECT_EQ(m.word_req_o, 1);
        EXPECT_EQ(m.word_write_o, 0);
        block.clock();
        EXPECT_EQ(m.s_axi_arready, 1);
        block.clock();
        m.s_axi_arvalid = 0;
        EXPECT_EQ(m.s_axi_rvalid, 1) << "3 clocks behind ARVALID";
        EXPECT_EQ(m.s_axi_rdata, 0x1000U * wait + at);
        block.clock();
        EXPECT_EQ(m.s_axi_rvalid, 0);
      }
    }
  }
}

}  // namespace
