// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The choice of the banks alone: pages 26, 31, 33, Tables 38, 48, 49; decision 15.
#include <gtest/gtest.h>

#include <cstdint>

#include "Vmb4_bank_ctrl.h"
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace at = mb4test::places::mb4_pkg;
constexpr auto kRun = static_cast<std::uint8_t>(at::bank_cmd_t::kRun(1));
constexpr auto kDataEnd = static_cast<std::uint8_t>(at::bank_cmd_t::kDataEnd(1));
constexpr auto kSwap = static_cast<std::uint8_t>(at::bank_cmd_t::kSwap(1));

class Banks : public mb4test::Block<Vmb4_bank_ctrl> {
 public:
  Banks() {
    model.singlebank_i = model.holdbank_i = model.kept_i = 0;
    model.bank_i = 0;
    reset();
  }
  void settle() {
    for (int i = 0; i < 4; ++i) clock();
  }
  void hold(bool level) {
    // The host keeps the base that it has at its write.
    if (level) model.kept_i = model.base_o;
    settle();
    model.holdbank_i = level;
    settle();
  }
  void begin_frame() {
    model.bank_i = kRun;
    lost = false;
    for (int i = 0; i < 4; ++i) {
      model.eval();
      lost = lost || at::bank_event_t::kLost.of(model.event_o) != 0;
      clock();
    }
  }
  void end_frame() {
    model.bank_i |= kDataEnd;
    clock();
    model.bank_i = 0;
    settle();
  }
  void frame() {
    begin_frame();
    end_frame();
  }
  void invert_swbank() {
    model.bank_i = kSwap;
    clock();
    model.bank_i = 0;
    settle();
  }
  std::uint64_t host() const { return at::banks_t::kHost.of(model.banks_o); }
  std::uint64_t engine() const { return at::banks_t::kEng.of(model.banks_o); }

  bool lost = false;
};

TEST(BankCtrlBlock, Reset_HostAndEngineUseDifferentBanks) {
  Banks banks;
  EXPECT_EQ(banks.host(), 0U);
  EXPECT_EQ(banks.engine(), 1U);
  EXPECT_EQ(banks.model.pending_o, 0);
}

// Page 26: the banks are swapped at the end of the frame.
TEST(BankCtrlBlock, FrameEnds_BanksAreSwappedOnce) {
  Banks banks;
  for (unsigned frames = 1; frames <= 4; ++frames) {
    banks.begin_frame();
    EXPECT_EQ(banks.host(), (frames - 1) % 2) << "not before the end";
    banks.end_frame();
    EXPECT_EQ(banks.host(), frames % 2);
    EXPECT_EQ(banks.engine(), (frames + 1) % 2);
  }
}

// Page 33, Table 48: a prevented switch happens after HOLDBANK = 0.
TEST(BankCtrlBlock, HoldBank_SwapWaitsUntilItIsCleared) {
  Banks banks;
  banks.hold(true);
  banks.frame();
  EXPECT_EQ(banks.host(), 0U);
  EXPECT_EQ(banks.model.pending_o, 1);
  banks.hold(false);
  EXPECT_EQ(banks.host(), 1U);
  EXPECT_EQ(banks.model.pending_o, 0);
}

// Decision 15: the next frame runs into the other bank again, and the switch before it is lost.
TEST(BankCtrlBlock, FrameWhileSwapIsPending_SwapIsLostAndToldOnce) {
  Banks banks;
  banks.hold(true);
  banks.frame();
  EXPECT_FALSE(banks.lost);
  banks.begin_frame();
  EXPECT_TRUE(banks.lost);
  EXPECT_EQ(banks.model.pending_o, 0);
  EXPECT_EQ(banks.engine(), 1U);
  banks.end_frame();
  banks.hold(false);
  EXPECT_EQ(banks.host(), 1U) << "the switch of the second frame";
}

// Table 49: each inversion of SWBANK switches, whatever HOLDBANK is.
TEST(BankCtrlBlock, SwbankInverted_BanksAreSwapped) {
  Banks banks;
  for (const bool hold : {false, true}) {
    banks.hold(hold);
    const std::uint64_t before = banks.host();
    banks.invert_swbank();
    EXPECT_NE(banks.host(), before);
    EXPECT_NE(banks.host(), banks.engine());
    banks.invert_swbank();
    EXPECT_EQ(banks.host(), before);
  }
}

// Table 38: one bank for both; the end of a frame switches nothing.
TEST(BankCtrlBlock, SingleBank_BothUseTheHostsBank) {
  Banks banks;
  banks.model.singlebank_i = 1;
  for (const unsigned bank : {0U, 1U}) {
    banks.frame();
    EXPECT_EQ(banks.host(), bank);
    EXPECT_EQ(banks.engine(), bank);
    EXPECT_EQ(banks.model.pending_o, 0);
    banks.invert_swbank();
  }
}

// Frames, HOLDBANK and SWBANK in any order, each after the one before has acted.
TEST(BankCtrlBlock, RandomOrder_HostHasTheBankThatTheRulesGive) {
  mb4test::Dice random;
  Banks banks;
  bool hold = false, pending = false;
  unsigned host = 0;
  for (int step = 0; step < 20'000; ++step) {
    switch (random.below(3)) {
      case 0:
        banks.frame();
        ASSERT_EQ(banks.lost, pending) << "step " << step;
        pending = hold;
        if (!hold) host ^= 1;
        break;
      case 1:
        hold = !hold;
        banks.hold(hold);
        if (!hold && pending) {
          host ^= 1;
          pending = false;
        }
        break;
      default:
        banks.invert_swbank();
        host ^= 1;
    }
    ASSERT_EQ(banks.host(), host) << "step " << step;
    ASSERT_EQ(banks.engine(), host ^ 1U) << "step " << step;
    ASSERT_EQ(banks.model.pending_o, pending) << "step " << step;
  }
}

}  // namespace
