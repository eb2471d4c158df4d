// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Each edge of SL moves by a random time, evenly spread over a part of the MA period, with 20
// clocks a bit and 121 delays over 12 periods. The words that come are compared with those that
// were sent.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <string>

#include "tests/block/clb/biss_clb_bench.hpp"
#include "tests/support/dice.hpp"

namespace {

namespace reg = biss_clb::regs;

struct Count {
  unsigned frames = 0, bad = 0, wrong = 0;  // wrong: another position, and its CRC fits
};

class ClbJitter : public testing::Test {
 protected:
  static constexpr unsigned kHalf = 10, kBits = 12;
  static constexpr unsigned kClocks = kBits + 4 + 6, kWords = 2;

  ClbJitter() {
    bench.set_half(kHalf);
    bench.slave.timeout = 60;
    bench.start(kClocks, kWords);  // what stays is written here
    bench.clocks(3000);
    bench.drive_sl = [this] { return level(); };
  }
  // One frame; its words from START on.
  std::string frame() {
    bench.write(reg::kAddrFsmLoadEn, 0);
    bench.write(reg::kAddrClkGpreg, 0);
    bench.write(reg::kAddrFsmGpreg, 0x80);
    bench.write(reg::kAddrSpiffrx, kWords);
    bench.write(reg::kAddrSpiffrx, 0x2040U | kWords);
    bench.write(reg::kAddrFsmLoadEn, reg::FSM_GLOBAL_EN::kMask);
    bench.rises.clear();
    bench.falls.clear();
    bench.spi_rises.clear();
    bench.write(reg::kAddrFsmGpreg, 0x81);
    bench.write(reg::kAddrClkCounter0Load, kHalf - 1);
    bench.write(reg::kAddrClkGpreg, 1);
    for (int i = 0; i < 5000 && bench.spi_rises.size() < 12 * kWords; ++i) bench.clock();
    bench.clocks(10);
    const std::string line =
        bench.line({bench.read(reg::kAddrSpirxbuf), bench.read(reg::kAddrSpirxbuf)});
    while (bench.slave.in_frame || out != bench.slave.out || !edges.empty()) bench.clock();
    return line;
  }
  // `part` of the period, peak to peak.
  Count run(double part, unsigned frames) {
    jitter = part * 2 * kHalf;
    Count count;
    for (unsigned i = 0; i <= 120; ++i) {
      delay = i * 2.0;
      for (unsigned k = 0; k < frames / 121 + (i < frames % 121 ? 1U : 0U); ++k) {
        bench.set_word(dice.below(1U << kBits), kBits, dice.below(4), dice.below(2) != 0);
        const std::string sent = "1" + bench.slave.payload;
        const std::string got = frame().substr(0, kClocks);
        ++count.frames;
        if (got.substr(2) == sent.substr(2)) continue;
        ++count.bad;
        const std::uint32_t crc = ~mb4test::crc_of(got.substr(2, kBits + 2), 0x43) & 0x3FU;
        if (got.substr(2 + kBits + 2) == mb4test::bits_of(crc, 6)) ++count.wrong;
      }
    }
    return count;
  }

  mb4test::ClbPins bench;
  double jitter = 0, delay = 0;

 private:
  // SL at the next edge of the clock.
  bool level() {
    if (bench.slave.out != out) {
      out = bench.slave.out;
      edges.push_back(
          {static_cast<double>(bench.now) + delay + jitter * dice.below(4096) / 4096, out});
    }
    while (!edges.empty() && edges.front().time <= static_cast<double>(bench.now)) {
      sl = edges.front().level;
      edges.pop_front();
    }
    return sl;
  }
  struct Edge {
    double time;
    bool level;
  };
  mb4test::Dice dice;
  std::deque<Edge> edges;
  bool out = true, sl = true;
};

unsigned frames_of(unsigned usual) {
  const char* text = std::getenv("MB4_CLB_JITTER_FRAMES");
  return text != nullptr ? static_cast<unsigned>(std::atoi(text)) : usual;
}

TEST_F(ClbJitter, To40PercentOfThePeriod_NoWordIsBad) {
  const Count count = run(0.40, frames_of(20'000));
  EXPECT_EQ(count.bad, 0U) << "of " << count.frames;
}

// Beyond that bad words are counted, and those of them by themselves that a CRC does not find.
TEST_F(ClbJitter, Beyond40Percent_BadWordsAreCounted) {
  unsigned before = 0;
  for (const unsigned percent : {45U, 50U, 55U, 60U}) {
    const Count count = run(percent / 100.0, frames_of(20'000) / 10);
    std::printf("jitter %u %%: %u of %u words bad, %u of them with a CRC that fits\n", percent,
                count.bad, count.frames, count.wrong);
    EXPECT_GE(count.bad + 20, before) << "more jitter, more bad words";
    before = count.bad;
  }
}

}  // namespace
