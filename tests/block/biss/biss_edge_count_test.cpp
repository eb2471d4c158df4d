// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The rising MA edges of a frame: pages 12 to 16, Figures 8 to 16.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "Vbiss_edge_count.h"
#include "tests/support/model_context.hpp"

namespace {

enum class Protocol { kBissB, kBissC, kSsi };

class Edges : public mb4test::Block<Vbiss_edge_count> {
 public:
  Edges() {
    model.biss_c_i = model.ssi_i = model.bus_i = model.mo_busy_i = 0;
    model.begin_i = model.len_valid_i = model.len_last_i = model.wait_i = model.rise_i = 0;
    reset();
  }
  void begin(Protocol protocol) {
    model.biss_c_i = protocol == Protocol::kBissC;
    model.ssi_i = protocol == Protocol::kSsi;
    model.begin_i = 1;
    clock();
    model.begin_i = 0;
  }
  void word(unsigned bits) {
    model.len_valid_i = 1;
    model.len_last_i = static_cast<std::uint8_t>(bits - 1);
    clock();
    model.len_valid_i = 0;
    clock();
  }
  // Clocks MA until no edge is left; returns how many rising edges there were.
  unsigned run() {
    unsigned edges = 0;
    for (; model.none_left_o == 0 && edges < 2000; ++edges) {
      last_told = model.one_left_o != 0;
      model.rise_i = 1;
      model.eval();
      EXPECT_EQ(model.two_edges_next_o, edges >= 1);
      EXPECT_EQ(model.two_edges_o, edges >= 2);
      clock();
      model.rise_i = 0;
      if (edges < waits) model.wait_i = 1;
      clock();
      model.wait_i = 0;
      clock();
    }
    return edges;
  }
  unsigned waits = 0;
  bool last_told = false;  // one_left_o before the last edge
};

// N + 5 + b edges in BiSS C; BiSS B has no CDS slot; SSI latches with the first edge.
TEST(EdgeCountBlock, RandomFrames_EdgesAreThoseOfTheProtocol) {
  mb4test::Dice random;
  for (int round = 0; round < 2'000; ++round) {
    SCOPED_TRACE(testing::Message() << "round " << round);
    Edges edges;
    const auto protocol = static_cast<Protocol>(random.below(3));
    unsigned expected = protocol == Protocol::kBissC ? 5 : protocol == Protocol::kBissB ? 4 : 1;
    edges.model.bus_i = protocol != Protocol::kSsi && random.below(2) != 0;
    edges.model.mo_busy_i = static_cast<std::uint8_t>(random.below(16));
    if (edges.model.bus_i != 0) expected += edges.model.mo_busy_i;
    edges.begin(protocol);
    for (unsigned words = random.below(9); words > 0; --words) {
      const unsigned bits = 1 + random.below(80);
      edges.word(bits);
      expected += bits;
    }
    edges.waits = std::min<unsigned>(random.below(4), expected - 1);  // processing time
    ASSERT_EQ(edges.run(), expected + edges.waits);
    ASSERT_TRUE(edges.last_told || expected == 0);
  }
}

// An edge that MA makes before the length of a word is known counts for this word.
TEST(EdgeCountBlock, OneEdgeTooMany_WordNeedsOneLess) {
  Edges edges;
  edges.begin(Protocol::kSsi);
  EXPECT_EQ(edges.run(), 1U);
  edges.model.rise_i = 1;
  edges.clock();
  edges.model.rise_i = 0;
  edges.model.len_valid_i = 1;
  edges.model.len_last_i = 12;
  edges.clock();
  edges.model.len_valid_i = 0;
  edges.clock();
  unsigned more = 0;
  for (; edges.model.none_left_o == 0; ++more) {
    edges.model.rise_i = 1;
    edges.clock();
    edges.model.rise_i = 0;
  }
  EXPECT_EQ(more, 12U);
}

// The lengths of words of a frame that BREAK has ended do not count in the next frame.
TEST(EdgeCountBlock, FrameBeginsAsAWordIsTold_WordIsForgotten) {
  Edges edges;
  edges.begin(Protocol::kBissC);
  edges.model.len_valid_i = 1;
  edges.model.len_last_i = 29;
  edges.begin(Protocol::kBissC);
  edges.model.len_valid_i = 0;
  EXPECT_EQ(edges.run(), 5U);
}

}  // namespace
