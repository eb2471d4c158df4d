// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// MA of one line: pages 12 to 16, 33, Figures 8 to 16, Tables 50 to 53.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "Vbiss_ma_drive.h"
#include "tests/support/model_context.hpp"

namespace {

constexpr unsigned kHalf = 4;  // clocks of half an MA period

class Ma : public mb4test::Block<Vbiss_ma_drive> {
 public:
  Ma() {
    auto& m = model;
    m.por_ni = 0;
    m.tick_i = m.half_next_i = m.start_i = 0;
    m.begin_i = m.clocked_i = m.stop_i = m.enough_i = m.cdm_i = m.high_i = 0;
    m.register_i = m.register_ma_i = m.force_i = m.force_level_i = 0;
    m.eval();
    m.por_ni = 1;
    reset();
  }
  void begin(bool clocked = true) {
    model.begin_i = 1;
    model.clocked_i = clocked;
    clock();
    model.begin_i = 0;
    first_half_ = true;
  }
  // Half an MA period; the tick is its last clock. Returns the level of MA after it.
  char half() {
    for (unsigned i = 1; i < kHalf; ++i) clock();
    model.tick_i = 1;
    model.half_next_i = !first_half_;
    model.eval();
    rose = model.rise_o != 0;
    const bool before = model.ma_o != 0;
    clock();
    model.tick_i = 0;
    if (model.clocking_o != 0 && model.force_i == 0) {
      EXPECT_EQ(rose, !before && model.ma_o != 0);
    }
    first_half_ = !first_half_;
    return model.ma_o != 0 ? '1' : '0';
  }
  std::string halves(unsigned count) {
    std::string levels;
    for (unsigned i = 0; i < count; ++i) levels += half();
    return levels;
  }
  bool rose = false;

 private:
  bool first_half_ = true;  // the half that ends is a high one
};

TEST(MaDriveBlock, Frame_ClocksAndEndsWithTheInvertedCdm) {
  for (const bool cdm : {false, true}) {
    Ma ma;
    EXPECT_EQ(ma.model.ma_o, 1) << "at rest";
    ma.model.cdm_i = cdm;
    ma.begin();
    EXPECT_EQ(ma.halves(6), "010101");
    EXPECT_EQ(ma.model.clocking_o, 1);
    ma.model.enough_i = 1;
    EXPECT_EQ(ma.halves(4), cdm ? "0000" : "1111");
    EXPECT_EQ(ma.model.clocking_o, 0);
    ma.model.high_i = 1;  // the slaves' timeout has passed
    EXPECT_EQ(ma.halves(2), "11");
  }
}

// Enough edges in the low level: it is the last one with CDM = 1, otherwise MA rises once more.
TEST(MaDriveBlock, EnoughInALowLevel_NoEdgeMoreThanCdmNeeds) {
  for (const bool cdm : {false, true}) {
    Ma ma;
    ma.model.cdm_i = cdm;
    ma.begin();
    EXPECT_EQ(ma.halves(3), "010");
    ma.model.enough_i = 1;
    EXPECT_EQ(ma.half(), cdm ? '0' : '1');
    EXPECT_EQ(ma.rose, !cdm);
  }
}

TEST(MaDriveBlock, RegisterAccess_MaIsThatOfItsCells) {
  Ma ma;
  ma.begin(false);
  ma.model.register_i = 1;
  std::string sent;
  const std::string cells = "0110100111010";
  for (const char cell : cells) {
    ma.model.register_ma_i = cell == '1';
    sent += ma.half();
  }
  EXPECT_EQ(sent, cells);
}

// Tables 50 to 53: the forced line has the level of its force bit; the other bits do not matter.
TEST(MaDriveBlock, Force_LevelOfTheForceBitFromTheNextTickOn) {
  for (const bool level : {false, true}) {
    Ma ma;
    ma.begin();
    ma.halves(3);  // MA is low
    ma.model.force_i = 1;
    ma.model.force_level_i = level;
    ma.clock();
    EXPECT_EQ(ma.model.ma_o, 0) << "not before the tick";
    EXPECT_EQ(ma.halves(4), level ? "1111" : "0000");
    ma.model.force_level_i = !level;
    EXPECT_EQ(ma.halves(2), level ? "00" : "11");
    ma.model.force_i = 0;
    bool released = false;
    for (unsigned i = 0; i < 3; ++i) {
      ma.clock();
      released = released || ma.model.released_o != 0;
    }
    EXPECT_TRUE(released);
  }
}

// Reset by pin does not cut a level short; only the power-on reset sets MA.
TEST(MaDriveBlock, ResetInALowLevel_MaStaysLowUntilItsUserRaisesIt) {
  Ma ma;
  ma.begin();
  ma.halves(1);
  ma.model.rst_ni = 0;
  ma.clock();
  EXPECT_EQ(ma.model.ma_o, 0);
  EXPECT_EQ(ma.model.clocking_o, 0);
  ma.model.rst_ni = 1;
  ma.model.high_i = 1;
  EXPECT_EQ(ma.half(), '1');
  ma.begin();
  ma.half();
  ma.model.por_ni = 0;
  ma.model.eval();
  EXPECT_EQ(ma.model.ma_o, 1);
}

// I302, I303: whatever the frame, the access and the host do, MA falls at ticks only, and rises at
// ticks or at the beginning of a frame.
TEST(MaDriveBlock, RandomInputs_MaChangesAtTicksOnly) {
  mb4test::Dice random;
  Ma ma;
  auto& m = ma.model;
  unsigned changes = 0;
  for (int step = 0; step < 100'000; ++step) {
    const auto rarely = [&] { return static_cast<std::uint8_t>(random.below(16) == 0); };
    const auto often = [&] { return static_cast<std::uint8_t>(random.below(2)); };
    m.tick_i = static_cast<std::uint8_t>(step % kHalf == 0);
    m.half_next_i = static_cast<std::uint8_t>(step / kHalf % 2);
    m.begin_i = rarely();
    m.clocked_i = often();
    m.stop_i = rarely();
    if (rarely()) m.enough_i = often();
    if (rarely()) m.force_i = often();
    if (rarely()) m.register_i = often();
    m.cdm_i = often();
    m.high_i = often();
    m.register_ma_i = often();
    m.force_level_i = often();
    const bool before = m.ma_o != 0;
    ma.clock();
    if ((m.ma_o != 0) == before) continue;
    ++changes;
    ASSERT_TRUE(m.tick_i != 0 || (m.begin_i != 0 && m.ma_o != 0)) << "step " << step;
  }
  EXPECT_GT(changes, 5'000U);
}

}  // namespace
