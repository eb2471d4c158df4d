// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The CDS bits in two banks: page 35, Tables 65, 66; decision 14.
#include <gtest/gtest.h>

#include <cstdint>

#include "Vmb4_cds_bank.h"
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

TEST(CdsBankBlock, RandomFrames_BitsAreThoseOfTheLastFrameOfTheirBank) {
  mb4test::Dice random;
  mb4test::Block<Vmb4_cds_bank> block;
  auto& m = block.model;
  m.banks_i = m.bank_i = m.holdbank_i = m.cds_i = 0;
  block.reset();
  unsigned banks[2] = {0, 0};
  for (int step = 0; step < 5'000; ++step) {
    const unsigned host = random.below(2);
    const unsigned engine = random.below(2);
    const bool end = random.below(3) != 0;
    const bool reduced = random.below(2) != 0;
    const bool hold = random.below(2) != 0;
    const unsigned cds = random.below(4);
    namespace at = mb4test::places::mb4_pkg;
    m.banks_i = static_cast<std::uint8_t>(at::banks_t::kHost(host) | at::banks_t::kEng(engine));
    m.bank_i = static_cast<std::uint8_t>(at::bank_cmd_t::kFrameEnd(end) |
                                         at::bank_cmd_t::kReduced(reduced));
    m.holdbank_i = hold;
    m.cds_i = static_cast<std::uint8_t>(cds);
    block.clock();
    // A reduced frame switches only these bits: the host sees them at once, unless it holds.
    if (end) banks[reduced && !hold ? host : engine] = cds;
    ASSERT_EQ(m.cds_o, banks[0] | banks[1] << 2) << "step " << step;
  }
}

}  // namespace
