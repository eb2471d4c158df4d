// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A host reads a word byte by byte while automatic frames run. With HOLDBANK all bytes come from
// one frame at any phase. Without it the bytes come from two frames when the banks switch (pages
// 26, 33, Table 48). SCLK up to 2 f_CLK: see docs/crossings.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::one_slave;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

constexpr unsigned kBytes = 8;
constexpr sim::Time kClk = 50'000;  // 20 MHz in ps
constexpr unsigned kRate = 0x0B;    // Table 37: a frame every 240 clocks, 12 us
constexpr sim::Time kPeriod = 20 * (kRate + 1) * kClk;

// A sensor of 64 bits that sends f times this step in frame f: eight bytes of f up to f = 255.
constexpr std::uint64_t kStep = 0x0101010101010101;
std::string bytes_of_the_frame_number(const std::string& sclk_hz) {
  return one_slave(
      "data_bits = 64\nflag_bits = 0\ncrc = 0\nsource = \"ramp\"\nstart = 0\n"
      "step = 0x0101010101010101",
      "delay_ns = 90.0", "", "sclk_hz = " + sclk_hz);
}

std::vector<std::uint8_t> bytes_of(std::uint64_t frame) {
  std::vector<std::uint8_t> bytes;
  for (unsigned i = 0; i < kBytes; ++i) {
    bytes.push_back(static_cast<std::uint8_t>((frame * kStep) >> (8 * i)));
  }
  return bytes;
}

void start_frames(Chip& chip) {
  chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 63, 0, 0x00, 0x00});
  chip.write(reg::kAddrCtrl, {reg::kRegversBissC, reg::FREQR::of(5), 0, kRate});
  chip.write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5, reg::kCfgch2Unused | reg::kCfgch1BissC});
  chip.instruct(reg::kAgsOn);
}

class Tearing : public testing::TestWithParam<const char*> {};

// The host's loop moves through all phases of the frames: 3 frames and 31 ns a turn.
TEST_P(Tearing, HoldBankAtEveryPhase_NoWordIsTorn) {
  Chip chip(bytes_of_the_frame_number(GetParam()));
  start_frames(chip);
  chip.advance_us(40);
  sim::Time next = chip.simulator.now();
  std::set<std::vector<std::uint8_t>> seen;
  const auto turn = (chip.simulator.spi().timing().sclk_high > 20'000 ? 16 : 6) * kPeriod + 31'000;
  for (unsigned i = 0; i < 400; ++i) {
    chip.simulator.run_until(next);
    next += turn;
    chip.instruct(reg::kHoldbankPrevented | reg::kAgsOn);
    const auto frames = chip.simulator.slave(1)->frames();  // one may run
    std::vector<std::uint8_t> word;
    if (i % 2 == 0) {
      for (unsigned byte = 0; byte < kBytes; ++byte) {
        word.push_back(chip.read(static_cast<std::uint8_t>(byte)));
      }
    } else {
      word = chip.read(reg::kAddrScdata, kBytes);
    }
    const auto again = chip.read(reg::kAddrScdata, kBytes);
    chip.instruct(reg::kAgsOn);
    ASSERT_TRUE(word == bytes_of(frames - 1) || word == bytes_of(frames - 2))
        << "torn at turn " << i;
    ASSERT_EQ(again, word) << "turn " << i;
    seen.insert(word);
    ASSERT_LT(chip.simulator.now(), next) << "the loop keeps its phase";
  }
  EXPECT_EQ(seen.size(), 400U) << "the words are new ones";
}

INSTANTIATE_TEST_SUITE_P(SclkHz, Tearing,
                         testing::Values("10_000_000", "20_000_000", "40_000_000"));

// Without HOLDBANK each byte is that of the bank which the host owns at that moment: of the last
// frame that has ended. Frames end exactly one period apart.
TEST(ChipTearing, WithoutHoldBank_BytesChangeExactlyWhereAFrameEnds) {
  Chip chip(bytes_of_the_frame_number("10_000_000"));
  start_frames(chip);
  auto& simulator = chip.simulator;
  const auto eot = [&](bool level) {
    ASSERT_TRUE(simulator.run_while_waiting([&] { return simulator.pin(sim::Pin::kEot) == level; },
                                            simulator.now() + 4 * kPeriod));
  };
  eot(false);
  eot(true);
  const sim::Time first_end = simulator.now();  // frame 0: the ramp's word 0
  // Banks switch two clocks before EOT (docs/timing.md); one more for either side to settle.
  const auto frame_at = [&](sim::Time time) {
    return static_cast<unsigned>((time - first_end) / kPeriod);
  };
  simulator.advance(3 * kPeriod);
  unsigned certain = 0;
  unsigned torn = 0;
  for (unsigned i = 0; i < 200; ++i) {
    simulator.advance(17 * kPeriod / 200);
    std::set<std::uint8_t> values;
    for (unsigned byte = 0; byte < kBytes; ++byte) {
      const sim::Time begin = simulator.now();
      const std::uint8_t value = chip.read(static_cast<std::uint8_t>(byte));
      const unsigned oldest = frame_at(begin - kClk);
      const unsigned newest = frame_at(simulator.now() + 4 * kClk);
      ASSERT_GE(value, oldest & 0xFFU) << i;
      ASSERT_LE(value, newest & 0xFFU) << i;
      certain += oldest == newest ? 1 : 0;
      values.insert(value);
    }
    torn += values.size() > 1 ? 1 : 0;
    if (frame_at(simulator.now()) > 220) break;
  }
  std::printf("%u bytes are certain, %u words torn\n", certain, torn);
  EXPECT_GT(certain, 100U);
  EXPECT_GT(torn, 10U);
}

}  // namespace
