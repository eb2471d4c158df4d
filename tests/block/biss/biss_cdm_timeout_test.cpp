// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// CDMTIMEOUT alone: page 35, Table 64; decision 20.
#include <gtest/gtest.h>

#include "Vbiss_cdm_timeout.h"
#include "tests/support/model_context.hpp"

namespace {

class Timeout : public mb4test::Block<Vbiss_cdm_timeout> {
 public:
  Timeout() {
    model.frame_done_i = model.cdm_i = model.clear_i = 0;
    reset();
  }
  void frames(unsigned count, bool cdm) {
    for (unsigned i = 0; i < count; ++i) {
      model.frame_done_i = 1;
      model.cdm_i = cdm;
      clock();
      model.frame_done_i = 0;
      model.cdm_i = 1;  // counts at the end of a frame only
      for (int k = 0; k < 3; ++k) clock();
    }
  }
  bool reached() const { return model.timeout_o != 0; }
};

TEST(CdmTimeoutBlock, FourteenFramesWithZero_IsReachedAndStays) {
  Timeout timeout;
  EXPECT_FALSE(timeout.reached());
  timeout.frames(13, false);
  EXPECT_FALSE(timeout.reached());
  timeout.frames(1, false);
  EXPECT_TRUE(timeout.reached());
  timeout.frames(40, false);
  EXPECT_TRUE(timeout.reached());
}

TEST(CdmTimeoutBlock, FrameWithOneOrInit_FourteenMoreAreNeeded) {
  for (const unsigned before : {1U, 13U, 14U, 20U}) {
    for (const bool init : {false, true}) {
      Timeout timeout;
      timeout.frames(before, false);
      if (init) {
        timeout.model.clear_i = 1;
        timeout.clock();
        timeout.model.clear_i = 0;
      } else {
        timeout.frames(1, true);
      }
      EXPECT_FALSE(timeout.reached());
      timeout.frames(13, false);
      EXPECT_FALSE(timeout.reached());
      timeout.frames(1, false);
      EXPECT_TRUE(timeout.reached());
    }
  }
}

}  // namespace
