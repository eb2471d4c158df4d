// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Two channels with different protocols (page 23, Tables 8, 10): all nine pairings run frame after
// frame. MB4_PAIR_FRAMES sets how many (default 300, nightly 10,000).
#include <gtest/gtest.h>

#include "tests/support/bits.hpp"
#include "tests/support/protocol_chip.hpp"

namespace {

using mb4test::ProtocolChip;
using mb4test::valid;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

const char* const kNames[] = {"BissB", "BissC", "Ssi"};

std::string channel(unsigned number, unsigned protocol, unsigned bits, int step) {
  static const char* const kKeys[] = {"protocol = \"biss-b\"\ncrc = 0x43\ntimeout = 2\n",
                                      "protocol = \"biss-c\"\ncrc = 0x43\nbusy_periods = 2\n",
                                      "protocol = \"ssi\"\ngray = true\ntimeout = 3\n"};
  return "[[channel]]\nnumber = " + std::to_string(number) +
         "\ndelay_ns = " + std::to_string(110 * number) + "\n[[channel.slave]]\n" +
         kKeys[protocol] + "data_bits = " + std::to_string(bits) +
         "\nflag_bits = 0\nsource = \"ramp\"\nstart = 5\nstep = " + std::to_string(step) + "\n";
}

class Pairings : public testing::TestWithParam<std::tuple<unsigned, unsigned>> {};

TEST_P(Pairings, EveryFrame_IsRightOnBothChannels) {
  const auto [first, second] = GetParam();
  const std::uint64_t frames = mb4test::number_from("MB4_PAIR_FRAMES", 300);
  ProtocolChip chip(channel(1, first, 25, 3) + channel(2, second, 34, -7), {.freqs = 4});
  std::uint64_t bad = 0;
  for (std::uint64_t i = 0; i < frames; ++i) {
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
    bad += chip.scdata(1, 25) != ((5 + 3 * i) & 0x1FFFFFF) ? 1 : 0;
    bad += chip.scdata(5, 34) != ((5 - 7 * i) & 0x3FFFFFFFF) ? 1 : 0;
    bad += chip.status() != reg::kResetStatus0 || chip.svalid() != valid({1, 5}) ? 1 : 0;
    ASSERT_EQ(bad, 0U) << "frame " << i;
  }
  EXPECT_EQ(chip.simulator.slave(1)->frames(), frames);
  EXPECT_EQ(chip.simulator.slave(5)->frames(), frames);
}

// The same with frames that follow each other by themselves.
TEST_P(Pairings, Agsmin_RunsWithoutAnError) {
  const auto [first, second] = GetParam();
  const std::uint64_t frames = mb4test::number_from("MB4_PAIR_FRAMES", 300);
  ProtocolChip chip(channel(1, first, 25, 3) + channel(2, second, 34, -7), {.freqs = 4});
  chip.instruct(reg::kAgsOn);
  while (chip.simulator.slave(1)->frames() < frames) {
    chip.advance_us(97);
    chip.instruct(reg::kHoldbankPrevented | reg::kAgsOn);  // HOLDBANK
    const auto n = (chip.scdata(1, 25) - 5) / 3;
    const bool same = chip.scdata(5, 34) == ((5 - 7 * n) & 0x3FFFFFFFF);
    chip.instruct(reg::kAgsOn);
    ASSERT_TRUE(same) << n;
    ASSERT_EQ(chip.svalid(), valid({1, 5}));
  }
  EXPECT_EQ(chip.simulator.slave(1)->frames(), chip.simulator.slave(5)->frames());
}

INSTANTIATE_TEST_SUITE_P(Channels, Pairings,
                         testing::Combine(testing::Range(0U, 3U), testing::Range(0U, 3U)),
                         [](const auto& entry) {
                           return std::string(kNames[std::get<0>(entry.param)]) +
                                  kNames[std::get<1>(entry.param)];
                         });

}  // namespace
