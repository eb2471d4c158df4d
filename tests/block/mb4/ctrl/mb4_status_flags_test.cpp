// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The status flags alone: pages 33 to 35, Tables 54 to 60, 62 to 64; decisions 8, 9.
#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>

#include "Vmb4_status_flags.h"
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

struct Flags {
  bool n_scderr = true, n_agserr = true, n_regerr = true, n_delayerr = true, regend = false;
  bool swbank_fail = false;
};

namespace flags_t = mb4test::places::mb4_pkg::flags_t;

// The events of one clock.
struct Events {
  bool busy = false, clear = false, scd_en = false, scd_bad = false, ags_error = false;
  bool bank_fail = false, bank_swapped = false, bank_lost = false;
  bool reg_begin = false, reg_end = false, reg_error = false, delay_error = false;
};

class Status : public mb4test::Block<Vmb4_status_flags> {
 public:
  Status() {
    model.frame_i = model.bank_i = model.access_i = model.access_state_i = 0;
    reset();
  }
  // One clock with the events of `now`, which are over then.
  void pulse() {
    namespace at = mb4test::places::mb4_pkg;
    namespace frame_t = at::frame_flags_t;
    namespace access_t = at::access_event_t;
    model.frame_i = static_cast<std::uint8_t>(
        frame_t::kBusy(now.busy) | frame_t::kClear(now.clear) | frame_t::kScdEn(now.scd_en) |
        frame_t::kScdBad(now.scd_bad) | frame_t::kAgsError(now.ags_error) |
        frame_t::kBankFail(now.bank_fail));
    model.bank_i = static_cast<std::uint8_t>(at::bank_event_t::kSwapped(now.bank_swapped) |
                                             at::bank_event_t::kLost(now.bank_lost));
    model.access_i = static_cast<std::uint8_t>(
        access_t::kBegins(now.reg_begin) | access_t::kEnds(now.reg_end) |
        access_t::kRegError(now.reg_error) | access_t::kDelayError(now.delay_error));
    now = {};
    clock();
  }
  bool flag(mb4test::Place place) const { return place.of(model.flags_o) != 0; }
  bool eot() const { return flag(flags_t::kEot); }
  void expect(const Flags& flags) {
    EXPECT_EQ(flag(flags_t::kNAgserr), flags.n_agserr);
    EXPECT_EQ(flag(flags_t::kNDelayerr), flags.n_delayerr);
    EXPECT_EQ(flag(flags_t::kNScderr), flags.n_scderr);
    EXPECT_EQ(flag(flags_t::kNRegerr), flags.n_regerr);
    EXPECT_EQ(flag(flags_t::kRegend), flags.regend);
    EXPECT_EQ(flag(flags_t::kSwbankFail), flags.swbank_fail);
    // Table 60: pin NER is low if any of the four is indicated.
    EXPECT_EQ(model.ner_low_o,
              !(flags.n_scderr && flags.n_agserr && flags.n_regerr && flags.n_delayerr));
  }

  Events now;
};

TEST(StatusBlock, Reset_NoErrorAndNothingEnded) {
  Status status;
  status.expect({});
  EXPECT_TRUE(status.eot());
}

// Table 55, decision 9: the result of the last frame only.
TEST(StatusBlock, FrameEnds_NscderrIsItsResult) {
  Status status;
  for (const bool bad : {true, false, true, true}) {
    status.now.scd_en = true;
    status.now.scd_bad = bad;
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
      status.now.reg_end = true;
      status.now.reg_error = error;
      status.now.delay_error = delay;
      status.pulse();
      status.expect({.n_regerr = !error, .n_delayerr = !delay, .regend = true});
      status.now.reg_begin = true;
      status.pulse();
      status.expect({});
    }
  }
}

// Table 62: until the next successful switch.
TEST(StatusBlock, SwitchPrevented_SwbankfailUntilTheNextSwitch) {
  for (const bool lost : {false, true}) {
    Status status;
    (lost ? status.now.bank_lost : status.now.bank_fail) = true;
    status.pulse();
    status.expect({.swbank_fail = true});
    status.pulse();
    status.now.clear = true;
    status.pulse();
    status.expect({.swbank_fail = true});
    status.now.bank_swapped = true;
    status.pulse();
    status.expect({});
  }
}

// Page 32, decision 8: INIT and BREAK set nSCDERR, nREGERR, nDELAYERR, nAGSERR and reset REGEND.
TEST(StatusBlock, InitOrBreak_FourFlagsAreSetAndRegendIsReset) {
  Status status;
  status.now.ags_error = status.now.scd_en = status.now.scd_bad = true;
  status.now.reg_end = status.now.reg_error = status.now.delay_error = true;
  status.pulse();
  status.expect({false, false, false, false, true, false});
  status.now.clear = true;
  status.pulse();
  status.expect({});
}

// Random events, one in each clock: a flag that the event does not concern keeps its value.
TEST(StatusBlock, RandomEvents_EachFlagFollowsItsOwn) {
  mb4test::Dice random;
  Status status;
  Flags flags;
  for (int step = 0; step < 20'000 && !testing::Test::HasFailure(); ++step) {
    SCOPED_TRACE(testing::Message() << "step " << step);
    const bool bad = random.below(2) != 0;
    const bool delay = random.below(2) != 0;
    auto& now = status.now;
    switch (random.below(8)) {
      case 0:
        now.clear = true;
        flags = {.swbank_fail = flags.swbank_fail};
        break;
      case 1:
        now.scd_en = true;
        now.scd_bad = bad;
        flags.n_scderr = !bad;
        break;
      case 2:
        now.ags_error = true;
        flags.n_agserr = false;
        break;
      case 3:
        now.bank_fail = true;
        flags.swbank_fail = true;
        break;
      case 4:
        now.bank_swapped = true;
        flags.swbank_fail = false;
        break;
      case 5:
        now.reg_begin = true;
        flags.n_regerr = flags.n_delayerr = true;
        flags.regend = false;
        break;
      case 6:
        now.reg_end = true;
        now.reg_error = bad;
        now.delay_error = delay;
        flags.n_regerr = !bad;
        flags.n_delayerr = !delay;
        flags.regend = true;
        break;
      default:
        // Results without an event do not count.
        now.scd_bad = now.reg_error = now.delay_error = true;
    }
    status.pulse();
    status.expect(flags);
  }
}

// Table 54: 0 while data are transmitted; back only when the other flags have settled.
TEST(StatusBlock, Busy_EotFallsAtOnceAndRisesThreeClocksAfterIt) {
  Status status;
  for (const int busy : {1, 2, 7}) {
    for (int i = 0; i < busy; ++i) {
      status.now.busy = true;
      status.pulse();
      EXPECT_FALSE(status.eot());
    }
    for (int i = 1; i <= 6; ++i) {
      status.pulse();
      EXPECT_EQ(status.eot(), i >= 3) << "busy " << busy << " clock " << i;
    }
  }
}

// Tables 63, 64: the number of good bytes only with nREGERR or nDELAYERR; CDMTIMEOUT as it is.
TEST(StatusBlock, AccessHasEnded_BytesAreToldAfterAnErrorOnly) {
  for (const bool error : {false, true}) {
    for (const bool delay : {false, true}) {
      Status status;
      namespace state_t = mb4test::places::mb4_pkg::access_state_t;
      status.model.access_state_i =
          static_cast<std::uint8_t>(state_t::kCdmTimeout(1) | state_t::kGoodBytes(41));
      status.now.reg_end = true;
      status.now.reg_error = error;
      status.now.delay_error = delay;
      status.pulse();
      EXPECT_TRUE(status.flag(flags_t::kCdmTimeout)) << "CDMTIMEOUT";
      EXPECT_EQ(flags_t::kRegbytes.of(status.model.flags_o), error || delay ? 41U : 0U);
    }
  }
}

}  // namespace
