// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames of a 26-bit encoder at 10 MHz over lines of 0 to 1.2 us whose edges jitter (I305). Random
// words; every frame is compared bit by bit with what the encoder sent, the wrong ones too.
// MB4_LINE_FRAMES: frames of each test (default 6050; nightly 1000000). MB4_SEED: first seed.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdio>

#include "sim/core/random.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::number_from;
using mb4test::one_slave;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

constexpr unsigned kDataBits = 28;  // 26 position bits, nE, nW
constexpr unsigned kCrcBits = 6;
constexpr unsigned kWordBits = kDataBits + kCrcBits;
constexpr mb4test::CrcChoice kCrc{kCrcBits, 0x43};
constexpr unsigned kSteps = 121;  // of the delay, 10 ns each
constexpr unsigned kPeriodNs = 100;

std::uint32_t crc6(std::uint64_t word) {
  return mb4test::remainder(mb4test::to_bits(word, kDataBits), kCrc, 0);
}

// Share of the error patterns of each weight that CRC-6 does not see: counted over its 2^28 code
// words by their dual's 64 words (MacWilliams), not by trying the chip.
std::array<double, kWordBits + 1> unseen_share() {
  // Columns of the parity check matrix: what one wrong bit does to the remainder.
  std::array<std::uint32_t, kWordBits> column{};
  for (unsigned i = 0; i < kDataBits; ++i) column[i] = crc6(std::uint64_t{1} << i);
  for (unsigned i = 0; i < kCrcBits; ++i) column[kDataBits + i] = 1U << i;
  std::array<double, kWordBits + 1> dual{};
  for (std::uint32_t row = 0; row < 1U << kCrcBits; ++row) {
    unsigned weight = 0;
    for (const std::uint32_t c : column) weight += std::popcount(c & row) & 1U;
    ++dual[weight];
  }
  const auto choose = [](unsigned n, unsigned k) {
    double value = k > n ? 0 : 1;
    for (unsigned i = 0; k <= n && i < k; ++i) value = value * (n - i) / (i + 1);
    return value;
  };
  std::array<double, kWordBits + 1> share{};
  for (unsigned k = 0; k <= kWordBits; ++k) {
    double count = 0;
    for (unsigned w = 0; w <= kWordBits; ++w) {
      double krawtchouk = 0;
      for (unsigned j = 0; j <= k; ++j) {
        krawtchouk += (j % 2 == 0 ? 1 : -1) * choose(w, j) * choose(kWordBits - w, k - j);
      }
      count += dual[w] * krawtchouk;
    }
    share[k] = count / (1U << kCrcBits) / choose(kWordBits, k);
  }
  return share;
}

struct Tally {
  std::uint64_t frames = 0;
  std::uint64_t wrong = 0;    // bits other than those sent, or no end
  std::uint64_t flagged = 0;  // of these: SVALID1 = 0 and nSCDERR = 0, or EOT = 0 for ever
  std::uint64_t endless = 0;  // of these: no start bit found, ended by BREAK
  std::uint64_t aliases = 0;  // wrong words that the CRC does not see
  double expected_aliases = 0;
};

// `frames` frames, spread over all delays; jitter in ps, peak to peak.
Tally run(sim::Time jitter, std::uint64_t frames, std::uint64_t seed) {
  static const auto share = unseen_share();
  Chip chip("[sim]\nseed = " + std::to_string(seed) + "\n" +
            one_slave("data_bits = 28\ncrc = 0x43"));
  chip.simulator.spi().set_timing(sim::SpiTiming::for_frequency(50'000'000));
  chip.configure_slave1(kDataBits, reg::kScrclenCrc6, 0x00);
  sim::WireFaults faults;
  faults.jitter = jitter;
  clocked(chip.simulator.line(1))->set_faults({}, faults);
  sim::Random random(sim::derive_seed(seed, 100));
  Tally tally;
  for (unsigned step = 0; step < kSteps; ++step) {
    chip.simulator.line(1)->set_round_trip(step * 10 * sim::kPsPerNs);
    const std::uint64_t share_of_step = frames * (step + 1) / kSteps - frames * step / kSteps;
    for (std::uint64_t i = 0; i < share_of_step; ++i) {
      const std::uint64_t sent = random.next() >> (64 - kDataBits);
      chip.simulator.slave(1)->set_data(sent);
      ++tally.frames;
      chip.instruct(reg::kInstrCdm0);
      if (!chip.wait_eot(60)) {
        ++tally.wrong;
        ++tally.flagged;
        ++tally.endless;
        chip.instruct(reg::kBreakAbort);
        chip.advance_us(60);
        continue;
      }
      const auto status = chip.spi({reg::kSpiOpcodeReadStatus, 0, 0});
      const bool valid = (status[2] & reg::SVALID<1>::kMask) != 0;
      const bool no_error = (status[1] & reg::nSCDERR::kMask) != 0;
      EXPECT_EQ(valid, no_error);
      const auto bytes = chip.read(reg::kAddrScdata, 8);
      std::uint64_t got = 0;
      for (unsigned byte = 4; byte-- > 0;) got = got << 8 | bytes[byte];
      const std::uint32_t got_crc = bytes[7];
      const unsigned wrong_bits =
          static_cast<unsigned>(std::popcount(got ^ sent) + std::popcount(got_crc ^ crc6(sent)));
      // A word is valid exactly if its CRC fits, right or wrong.
      EXPECT_EQ(valid, crc6(got) == got_crc) << "sent " << sent << " got " << got;
      if (wrong_bits != 0) {
        ++tally.wrong;
        ++(valid ? tally.aliases : tally.flagged);
        tally.expected_aliases += share[wrong_bits];
      }
      // The slave's timeout, so that SL is 1 again.
      chip.simulator.advance(500 * sim::kPsPerNs);
    }
  }
  return tally;
}

std::uint64_t frames_per_test() { return number_from("MB4_LINE_FRAMES", 50 * kSteps); }
std::uint64_t first_seed() { return number_from("MB4_SEED", 1); }

void print(unsigned percent, const Tally& tally) {
  std::printf(
      "jitter %u %% of T_MA: %llu frames, %llu wrong, %llu flagged (%llu without end), "
      "%llu CRC aliases, %.1f expected; MB4_SEED=%llu\n",
      percent, static_cast<unsigned long long>(tally.frames),
      static_cast<unsigned long long>(tally.wrong), static_cast<unsigned long long>(tally.flagged),
      static_cast<unsigned long long>(tally.endless),
      static_cast<unsigned long long>(tally.aliases), tally.expected_aliases,
      static_cast<unsigned long long>(first_seed()));
}

// The share of unseen patterns has known values: a 6-bit CRC of a primitive polynomial sees all
// patterns of one and two wrong bits up to 63 bits, and one in 64 of all.
TEST(LineJitterOracle, UnseenShare_IsThatOfAHammingCode) {
  const auto share = unseen_share();
  EXPECT_NEAR(share[0], 1, 1e-9);
  EXPECT_NEAR(share[1], 0, 1e-9);
  EXPECT_NEAR(share[2], 0, 1e-9);
  EXPECT_GT(share[3], 0);
  for (unsigned k = 4; k <= 30; ++k) EXPECT_NEAR(share[k], 1.0 / 64, 0.005) << k;
}

class LineJitter : public testing::TestWithParam<unsigned> {};

// I305: any two edges deviate by at most 25 % of T_MA: every frame is right.
TEST_P(LineJitter, UpTo25Percent_EveryFrameIsRight) {
  const unsigned percent = GetParam();
  const Tally tally =
      run(percent * kPeriodNs * sim::kPsPerNs / 100, frames_per_test(), first_seed() + percent);
  print(percent, tally);
  EXPECT_EQ(tally.frames, frames_per_test());
  EXPECT_EQ(tally.wrong, 0U);
}

INSTANTIATE_TEST_SUITE_P(Percent, LineJitter, testing::Values(0, 5, 12, 20, 25));

class LineJitterBeyond : public testing::TestWithParam<unsigned> {};

// With more jitter than I305 allows, frames go wrong, and the chip reports them. A wrong position
// is valid only if its CRC fits, and that is as rare as the theory says.
TEST_P(LineJitterBeyond, WrongFramesAreFlagged_ExceptCrcAliases) {
  const unsigned percent = GetParam();
  const Tally tally =
      run(percent * kPeriodNs * sim::kPsPerNs / 100, frames_per_test(), first_seed() + percent);
  print(percent, tally);
  EXPECT_EQ(tally.frames, frames_per_test());
  EXPECT_GT(tally.wrong, 0U);
  EXPECT_EQ(tally.flagged + tally.aliases, tally.wrong);
  // Error patterns of jitter are not evenly spread over all of their weight.
  EXPECT_LE(static_cast<double>(tally.aliases),
            2 * tally.expected_aliases + 6 * std::sqrt(tally.expected_aliases) + 3);
}

INSTANTIATE_TEST_SUITE_P(Percent, LineJitterBeyond, testing::Values(35, 50, 75, 100));

}  // namespace
