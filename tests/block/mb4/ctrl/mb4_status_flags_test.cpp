// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The status flags alone: pages 33 to 35, Tables 54 to 60, 62; decisions 8, 9.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "Vmb4_status_flags.h"
#include "tests/support/model_context.hpp"

namespace {

struct Flags {
  bool n_scderr = true, n_agserr = true, n_regerr = true, n_delayerr = true, regend = false;
  bool swbank_fail = false;
};

class Status : public mb4test::Block<Vmb4_status_flags> {
 public:
  Status() {
    none();
    reset();
  }
  std::array<std::uint8_t*, 10> inputs() {
    return {&model.busy_i,      &model.clear_i,     &model.scd_en_i,       &model.scd_bad_i,
            &model.ags_error_i, &model.bank_fail_i, &model.bank_swapped_i, &model.reg_begin_i,
            &model.reg_end_i,   &model.reg_error_i};
  }
  void none() {
    for (std::uint8_t* input : inputs()) *input = 0;
    model.delay_error_i = 0;
  }
  void pulse() {
    clock();
    none();
  }
  void expect(const Flags& flags) {
    EXPECT_EQ(model.n_scderr_o, flags.n_scderr);
    EXPECT_EQ(model.n_agserr_o, flags.n_agserr);
    EXPECT_EQ(model.n_regerr_o, flags.n_regerr);
    EXPECT_EQ(model.n_delayerr_o, flags.n_delayerr);
    EXPECT_EQ(model.regend_o, flags.regend);
    EXPECT_EQ(model.swbank_fail_o, flags.swbank_fail);
    // Table 60: pin NER is low if any of the four is indicated.
    EXPECT_EQ(model.ner_low_o,
              !(flags.n_scderr && flags.n_agserr && flags.n_regerr && flags.n_delayerr));
  }
};

TEST(StatusBlock, Reset_NoErrorAndNothingEnded) {
  Status status;
  status.expect({});
  EXPECT_EQ(status.model.eot_o, 1);
}

// Table 55, decision 9: the result of the last frame only.
TEST(StatusBlock, FrameEnds_NscderrIsItsResult) {
  Status status;
  for (const bool bad : {true, false, true, true}) {
    status.model.scd_en_i = 1;
    status.model.scd_bad_i = bad;
    status.pulse();
    status.expect({.n_scderr = !bad});
  }
}

// Tables 56 to 58: the end of a control communication sets REGEND and gives both error flags; its
// begin takes all three back.
TEST(StatusBlock, ControlCommunicationEnds_ThreeFlagsTellIt) {
  for (const bool error : {false, true}) {
    for (const bool delay : {false, true}) {
      Status status;
      status.model.reg_end_i = 1;
      status.model.reg_error_i = error;
      status.model.delay_error_i = delay;
      status.pulse();
      status.expect({.n_regerr = !error, .n_delayerr = !delay, .regend = true});
      status.model.reg_begin_i = 1;
      status.pulse();
      status.expect({});
    }
  }
}

// Table 62: until the next successful switch.
TEST(StatusBlock, SwitchPrevented_SwbankfailUntilTheNextSwitch) {
  Status status;
  status.model.bank_fail_i = 1;
  status.pulse();
  status.expect({.swbank_fail = true});
  status.clock();
  status.model.clear_i = 1;
  status.pulse();
  status.expect({.swbank_fail = true});
  status.model.bank_swapped_i = 1;
  status.pulse();
  status.expect({});
}

// Page 32, decision 8: INIT and BREAK set nSCDERR, nREGERR, nDELAYERR, nAGSERR and reset REGEND.
TEST(StatusBlock, InitOrBreak_FourFlagsAreSetAndRegendIsReset) {
  Status status;
  status.model.ags_error_i = status.model.scd_en_i = status.model.scd_bad_i = 1;
  status.model.reg_end_i = status.model.reg_error_i = status.model.delay_error_i = 1;
  status.pulse();
  status.expect({false, false, false, false, true, false});
  status.model.clear_i = 1;
  status.pulse();
  status.expect({});
}

// Any events, one a clock: what is not concerned keeps its value.
TEST(StatusBlock, RandomEvents_EachFlagFollowsItsOwn) {
  mb4test::Dice random;
  Status status;
  Flags flags;
  for (int step = 0; step < 20'000 && !testing::Test::HasFailure(); ++step) {
    SCOPED_TRACE(testing::Message() << "step " << step);
    const bool bad = random.below(2) != 0;
    const bool delay = random.below(2) != 0;
    auto& m = status.model;
    switch (random.below(8)) {
      case 0:
        m.clear_i = 1;
        flags = {.swbank_fail = flags.swbank_fail};
        break;
      case 1:
        m.scd_en_i = 1;
        m.scd_bad_i = bad;
        flags.n_scderr = !bad;
        break;
      case 2:
        m.ags_error_i = 1;
        flags.n_agserr = false;
        break;
      case 3:
        m.bank_fail_i = 1;
        flags.swbank_fail = true;
        break;
      case 4:
        m.bank_swapped_i = 1;
        flags.swbank_fail = false;
        break;
      case 5:
        m.reg_begin_i = 1;
        flags.n_regerr = flags.n_delayerr = true;
        flags.regend = false;
        break;
      case 6:
        m.reg_end_i = 1;
        m.reg_error_i = bad;
        m.delay_error_i = delay;
        flags.n_regerr = !bad;
        flags.n_delayerr = !delay;
        flags.regend = true;
        break;
      default:
        // Results without an event do not count.
        m.scd_bad_i = m.reg_error_i = m.delay_error_i = 1;
    }
    status.pulse();
    status.expect(flags);
  }
}

// Table 54: 0 while data are transmitted; back only when the other flags have settled.
TEST(StatusBlock, Busy_EotFallsAtOnceAndRisesThreeClocksAfterIt) {
  Status status;
  for (const int busy : {1, 2, 7}) {
    status.model.busy_i = 1;
    for (int i = 0; i < busy; ++i) {
      status.clock();
      EXPECT_EQ(status.model.eot_o, 0);
    }
    status.model.busy_i = 0;
    for (int i = 1; i <= 6; ++i) {
      status.clock();
      EXPECT_EQ(status.model.eot_o, i >= 3) << "busy " << busy << " clock " << i;
    }
  }
}

}  // namespace
