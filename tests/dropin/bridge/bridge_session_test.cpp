// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The bridge's protocol without sockets: requests cut at every place, and answers of a chip whose
// model has stopped.
#include "bridge/bridge_session.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "mb4_regs.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/masters/mb4/pins.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4test {

using namespace mb4::tool;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes request(char kind, const Bytes& payload) {
  Bytes bytes(BridgeSession::kHeader + payload.size());
  bytes[0] = static_cast<std::uint8_t>(kind);
  bytes[1] = static_cast<std::uint8_t>(payload.size());
  bytes[2] = static_cast<std::uint8_t>(payload.size() >> 8U);
  std::copy(payload.begin(), payload.end(), bytes.begin() + BridgeSession::kHeader);
  return bytes;
}

Bytes answer(std::uint8_t status, const Bytes& payload) {
  return request(static_cast<char>(status), payload);
}

class BridgeSessionTest : public testing::Test {
 protected:
  sim::Simulator simulator_{sim::parse_scenario("", "test")};
  BridgeChip chip_{simulator_, Pace::kRequests};
  BridgeSession session_{chip_};
};

TEST_F(BridgeSessionTest, RequestsCutAnywhere_AreAnsweredOnceComplete) {
  const Bytes read = request('T', {reg::kSpiOpcodeReadRegisters, reg::kAddrRevision, 0, 0, 0});
  const Bytes expected =
      answer(0, {0, 0, reg::kRevisionY, reg::kVersionIcMb4, reg::kResetSlaveloc5});
  Bytes both = read;
  both.insert(both.end(), read.begin(), read.end());
  for (std::size_t cut = 0; cut <= both.size(); ++cut) {
    const std::span<const std::uint8_t> all(both);
    Bytes got = session_.feed(all.first(cut));
    EXPECT_EQ(got.size(), cut / read.size() * expected.size()) << cut;
    const Bytes rest = session_.feed(all.subspan(cut));
    got.insert(got.end(), rest.begin(), rest.end());
    Bytes twice = expected;
    twice.insert(twice.end(), expected.begin(), expected.end());
    EXPECT_EQ(got, twice) << cut;
  }
}

TEST_F(BridgeSessionTest, EveryRequestByte_IsAnsweredExactlyOnce) {
  for (unsigned kind = 0; kind < 256; ++kind) {
    for (const std::size_t length : {0U, 1U, 5U, 8U, 11U, 12U}) {
      const Bytes got =
          session_.feed(request(static_cast<char>(kind), Bytes(length, std::uint8_t{1})));
      ASSERT_GE(got.size(), BridgeSession::kHeader) << kind << " " << length;
      EXPECT_EQ(got.size(), BridgeSession::kHeader + got[1] + 256U * got[2]) << kind;
    }
  }
}

TEST_F(BridgeSessionTest, FrameLeftOpen_EndsWithItsConnectionOnly) {
  BridgeSession other(chip_);
  session_.feed(request('S', {1}));
  EXPECT_FALSE(simulator_.pin(sim::Pin::kNcs));
  other.close();
  EXPECT_FALSE(simulator_.pin(sim::Pin::kNcs));
  session_.close();
  EXPECT_TRUE(simulator_.pin(sim::Pin::kNcs));
}

TEST_F(BridgeSessionTest, StoppedModel_AnswersEveryRequestWithItsText) {
  chip_.set_stopped("top.x: assertion");
  for (const char kind : {'T', 'M', 'W', 'S', 'G'}) {
    const Bytes got = session_.feed(request(kind, {}));
    ASSERT_GT(got.size(), BridgeSession::kHeader);
    EXPECT_EQ(got[0], 3);
    EXPECT_EQ(std::string(got.begin() + BridgeSession::kHeader, got.end()), "top.x: assertion");
  }
}

TEST(BridgePace, Gaps_LetTenMicrosecondsPassWithEveryRequest) {
  sim::Simulator simulator(sim::parse_scenario("", "test"));
  BridgeChip chip(simulator, Pace::kGaps);
  BridgeSession session(chip);
  const sim::Time before = simulator.now();
  session.feed(request('P', {1, 'G', 'E', 'T', 'S', 'E', 'N', 'S'}));
  EXPECT_EQ(simulator.now() - before, 10 * sim::kPsPerUs);
}

}  // namespace
}  // namespace mb4test
