// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What the registers of the page make of CRC and timeout of a frame (regmap/axi.rdl:
// CRC_POLYNOMIAL, CRC_START, TIMEOUT), with a TIMEOUT_LIMIT of 777.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "Vaxi_rule.h"
#include "tests/block/axi/axi_bus.hpp"
#include "tests/support/model_context.hpp"

namespace {

constexpr unsigned kLimit = 777;

struct Page {
  std::uint32_t polynomial, start;
  bool fixed;
  std::uint32_t limit;
  std::uint64_t port() const {
    namespace at = mb4test::places::axi_pkg::page_t;
    return at::kCrcPolynomial(polynomial) | at::kCrcStart(start) | at::kTimeoutFixed(fixed) |
           at::kTimeoutLimit(limit);
  }
};

TEST(AxiRuleBlock, Registers_CountWhenTheyAreTaken) {
  mb4test::Dice dice;
  mb4test::Block<Vaxi_rule> block;
  Vaxi_rule& m = block.model;
  m.page_i = 0;
  m.take_i = 0;
  block.reset();
  Page taken{0, 0, false, 0};
  bool any = false;
  for (int round = 0; round < 3000; ++round) {
    const unsigned degree = dice.below(18);
    const std::uint32_t below = dice.below(0x10000) & ((1U << degree) - 1U);
    const Page page{degree == 17 ? 0 : (1U << degree | below) & 0x1FFFF, dice.below(0x10000),
                    dice.below(2) != 0, dice.below(3) == 0 ? 0 : dice.below(0x100000)};
    m.page_i = page.port();
    m.take_i = dice.below(2) != 0 ? 1 : 0;
    m.eval();
    const auto polynomial = [](const Page& of) { return of.polynomial < 2 ? 0x43 : of.polynomial; };
    EXPECT_EQ(m.crc_bits_o, std::bit_width(polynomial(page)) - 1);
    if (m.take_i != 0) {
      taken = page;
      any = true;
    }
    block.clock();
    if (!any) continue;
    const unsigned bits = static_cast<unsigned>(std::bit_width(polynomial(taken))) - 1;
    namespace at = mb4test::places::axi_pkg::rule_t;
    const std::uint32_t limit = taken.limit == 0 ? kLimit : taken.limit;
    ASSERT_EQ(at::kTimeoutLast.get(m.rule_o), limit - 1);
    ASSERT_EQ(at::kFixed.get(m.rule_o), taken.fixed ? 1U : 0U);
    ASSERT_EQ(at::kCrcLast.get(m.rule_o), bits - 1);
    ASSERT_EQ(at::kCrcStart.get(m.rule_o), taken.start);
    ASSERT_EQ(at::kCrcTop.get(m.rule_o), 1U << (bits - 1));
    ASSERT_EQ(at::kCrcPoly.get(m.rule_o), polynomial(taken) & ((1U << bits) - 1U));
  }
}

}  // namespace
