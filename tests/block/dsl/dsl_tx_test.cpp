// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames of dsl_tx against the plan of the model, bit by bit: fields, eighths, driver, equaliser.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>

#include "Vdsl_tx.h"
#include "places.hpp"
#include "sim/masters/dsl_model/frame_plan.hpp"
#include "tests/support/model_context.hpp"

namespace {

using namespace mb4::sim::dsl_model;

namespace bits = mb4test::places::dsl_pkg::bit_t;
namespace plans = mb4test::places::dsl_pkg::plan_t;

struct Bit {
  explicit Bit(unsigned port)
      : eighths(static_cast<unsigned>(bits::kEighths.of(port))),
        drive(bits::kDrive.of(port) != 0),
        first(bits::kFirst.of(port) != 0),
        edge(bits::kEdgeHere.of(port) != 0),
        turn(bits::kTurn.of(port) != 0) {}
  unsigned eighths;
  bool drive, first, edge, turn;
};

struct Frame {
  unsigned parameter = 0;
  bool answer = true;
  FrameShape shape;
  unsigned added = 0;

  unsigned port() const {
    return static_cast<unsigned>(plans::kAnswer(answer) | plans::kParameterByte(parameter) |
                                 plans::kExtra(shape.extra) | plans::kRest(shape.rest) |
                                 plans::kAdded(added) | plans::kBlocks(shape.blocks));
  }
};

class DslTxBlock : public testing::Test {
 protected:
  DslTxBlock() {
    m.slot_i = 0;
    m.gap_i = 0;
    m.plan_i = 0;
    block.clock();
    m.rst_ni = 1;
  }

  // The bits of `plan`, the first of which is there. `gap_at`: gap_i rises with this bit.
  void expect_bits(bool frame, unsigned bits, unsigned gap_at = ~0U) {
    for (unsigned i = 0; i < bits; ++i) {
      if (i >= gap_at) m.gap_i = 1;
      for (unsigned idle = random.below(3); idle > 0; --idle) block.clock();
      m.slot_i = 1;
      m.eval();
      const Bit bit(m.bit_o);
      unsigned eighths = 0;
      for (unsigned k = 0; k < 8; ++k) eighths = eighths << 1U | (plan.level(i, k) ? 1U : 0U);
      ASSERT_EQ(bit.eighths, eighths) << "bit " << i;
      ASSERT_EQ(bit.drive, plan.drives(i)) << "bit " << i;
      ASSERT_EQ(bit.first, i == 0) << "bit " << i;
      ASSERT_EQ(bit.edge, frame && i == plan.sample_tick() / 8) << "bit " << i;
      ASSERT_EQ(bit.turn, frame && i == plan.switch_bit() && !plan.drives(i)) << "bit " << i;
      ASSERT_EQ(m.begin_o, i + 1 == bits) << "bit " << i;
      block.clock();
      m.slot_i = 0;
    }
  }
  void expect_gap() {
    plan.make_gap();
    disparity = 0;
    m.gap_i = 0;
    expect_bits(false, plan.bits());
  }
  void expect_frame(const Frame& frame) {
    m.plan_i = frame.port();
    plan.make(frame.parameter, frame.answer, frame.shape, disparity, static_cast<int>(frame.added));
    expect_bits(true, plan.bits());
  }

  mb4test::Dice random;
  mb4test::Block<Vdsl_tx> block;
  Vdsl_tx& m = block.model;
  FramePlan plan;
  int disparity = 0;
};

TEST_F(DslTxBlock, FramesAtRandom_AreThoseOfTheModel) {
  expect_gap();
  for (unsigned i = 0; i < 3'000; ++i) {
    SCOPED_TRACE(testing::Message() << "frame " << i);
    Frame frame;
    frame.parameter = random.below(256);
    frame.answer = random.below(4) != 0;
    frame.shape.extra = random.below(2) * random.below(16);
    frame.shape.rest = random.below(2) * random.below(8);
    frame.shape.blocks = random.below(4) == 0 ? random.below(27) : 0;
    frame.added = random.below(2) * random.below(16);
    // The counter has eight bits: the law's sync mode does not leave them.
    if (std::abs(disparity) > 100) frame.answer = true;
    expect_frame(frame);
    if (HasFatalFailure()) return;
  }
}

// A restart: the frame ends with its trailer, or with the block of stuffing that runs.
TEST_F(DslTxBlock, Gap_FollowsTheTrailer) {
  expect_gap();
  for (unsigned blocks = 0; blocks <= 26; blocks += 13) {
    for (const unsigned at : {0U, 26U, 100U, 107U}) {
      SCOPED_TRACE(testing::Message() << blocks << " blocks, bit " << at);
      Frame frame;
      frame.parameter = kStart;
      frame.shape.blocks = blocks;
      m.plan_i = frame.port();
      plan.make(frame.parameter, true, frame.shape, disparity);
      plan.drop_stuffing();
      expect_bits(true, plan.bits(), at);
      expect_gap();
      if (HasFatalFailure()) return;
    }
  }
}

// F4: D of a start, free and in sync mode with E = 9, where it climbs to 91.
TEST_F(DslTxBlock, StartUp_IsThatOfTheModel) {
  for (unsigned extra = 0; extra <= 9; ++extra) {
    expect_gap();
    for (unsigned i = 0; i < 60; ++i) {
      SCOPED_TRACE(testing::Message() << "E " << extra << " frame " << i);
      Frame frame;
      frame.parameter = i < 2 ? kReset : i < 18 ? kSync : i < 27 ? kStart : 0x80 | kIdle;
      frame.answer = i >= 18;
      frame.shape.extra = frame.added = extra;
      if (i == 59) {
        m.gap_i = 1;
      }
      expect_frame(frame);
      if (HasFatalFailure()) return;
    }
  }
}

}  // namespace
