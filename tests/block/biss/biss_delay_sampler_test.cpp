// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The sampler by delay alone.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "Vbiss_delay_sampler.h"
#include "tests/support/model_context.hpp"

namespace {

using mb4test::Block;

// hello-fpga manual, 0x3C: clocks from the second rising MA edge to the acknowledge.
TEST(DelaySamplerBlock, DelayOfKClocks_IsCountedAndBitsAreTakenInTheirMiddle) {
  for (const unsigned half : {1U, 2U, 5U, 50U, 255U}) {
    for (const unsigned delay : {0U, 1U, 2U, 7U, 120U, 1000U}) {
      Block<Vbiss_delay_sampler> sampler;
      auto& m = sampler.model;
      m.sl_i = 1;
      m.half_last_i = static_cast<std::uint8_t>(half - 1);
      m.median_i = 0;
      m.armed_i = 0;
      m.clear_i = 1;
      sampler.reset();
      m.clear_i = 0;
      // MA rises at clock edge 0, and SL falls `delay` clocks later: just after that edge. Then
      // bits follow, one a period.
      const std::string bits = "1011001110001";
      std::string seen;
      const unsigned last = delay + 2 * half * 15 + 8;
      for (unsigned clock = 0; clock < last; ++clock) {
        // The clock that begins at edge `clock`.
        m.armed_i = 1;
        const unsigned slot = clock < delay ? 0 : (clock - delay) / (2 * half);
        m.sl_i =
            clock < delay || (slot > 0 && (slot > bits.size() || bits[slot - 1] == '1')) ? 1 : 0;
        m.eval();
        if (m.bit_valid_o != 0) seen += m.bit_o != 0 ? '1' : '0';
        sampler.clock();
      }
      EXPECT_EQ(m.delay_o, delay) << "half " << half;
      ASSERT_GE(seen.size(), bits.size() + 1) << "half " << half << " delay " << delay;
      EXPECT_EQ(seen.substr(0, bits.size() + 1), "0" + bits)
          << "half " << half << " delay " << delay;
    }
  }
}

TEST(DelaySamplerBlock, NoAcknowledge_IsLateAfter1023Clocks) {
  Block<Vbiss_delay_sampler> sampler;
  auto& m = sampler.model;
  m.sl_i = 1;
  m.half_last_i = 4;
  m.median_i = 0;
  m.armed_i = 0;
  m.clear_i = 1;
  sampler.reset();
  m.clear_i = 0;
  m.armed_i = 1;
  unsigned clocks = 0;
  while (m.late_o == 0 && clocks < 2000) {
    sampler.clock();
    ++clocks;
    EXPECT_EQ(m.bit_valid_o, 0);
  }
  EXPECT_EQ(clocks, 1023U + 2U);  // the synchroniser
  for (unsigned i = 0; i < 2000; ++i) sampler.clock();
  EXPECT_EQ(m.delay_o, 1023U);
  EXPECT_EQ(m.ack_o, 0);
}

}  // namespace
