// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Each edge of SL moves by a random time, evenly spread over a part of the MA period, over 121
// delays up to 12 periods. The words that come are compared with those that were sent.
// MB4_PRU_JITTER_FRAMES: frames of a row.
#include <cstdio>
#include <ostream>
#include <string>

#include "tests/block/pru/pru_frames.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/environment.hpp"

namespace mb4test {
namespace {

struct Count {
  unsigned frames = 0, bad = 0, wrong = 0;  // wrong: another position, and its CRC fits
};

// What a row is about.
struct Row {
  const char* name;
  unsigned percent;  // jitter, peak to peak, of T_MA
  bool first_low;    // the quirk
  bool averages;     // frames from the fifth on, else the first four of a rate
  bool ten;          // 10 MHz, else 1, 2 and 5 MHz
};

unsigned frames_of(unsigned usual) {
  return static_cast<unsigned>(mb4test::number("MB4_PRU_JITTER_FRAMES", usual));
}

template <typename Bench>
class Jitter {
 public:
  Jitter(const Row& row, unsigned percent)
      : row_(row), percent_(percent), frames_(row.first_low ? 3U : 1U) {
    frames_.bench.jitter = [this]() -> Time {
      return frames_.period() * percent_ / 100 * dice_.below(4096) / 4096;
    };
    frames_.send(0);
    frames_.start(row.ten ? 10 : 5);
  }
  // Each delay as often as the others.
  Count run(unsigned frames) {
    for (unsigned i = 0; i <= 120; ++i) {
      const unsigned last = count_.frames + frames / 121 + (i < frames % 121 ? 1U : 0U);
      change_rate();
      while (count_.frames < last && !testing::Test::HasFatalFailure()) {
        frames_.bench.delay = i * frames_.period() / 10;
        if (row_.averages) {
          if (at_rate_ == 0) warm_up();
        } else if (!row_.ten && at_rate_ == 4) {
          change_rate();
          frames_.bench.delay = i * frames_.period() / 10;
        }
        judge();
      }
    }
    return count_;
  }

 private:
  // 1 MHz takes longest, and comes least.
  void change_rate() {
    unsigned mhz = 10;
    if (!row_.ten) {
      do {
        const unsigned one = dice_.below(8);
        mhz = one == 0 ? 1 : one < 3 ? 2 : 5;
      } while (mhz == frames_.rate);
    }
    if (mhz != frames_.rate) {
      frames_.bench.write(prureg::kAddrLengths, mhz << 16U, 4);
      frames_.frame();  // its end reads the value
      frames_.set_rate(mhz);
    }
    at_rate_ = 0;
  }
  void warm_up() {
    for (unsigned k = 0; k < 4; ++k) frames_.frame();
    at_rate_ = 4;
  }
  void judge() {
    const std::uint64_t sent = dice_.below(1U << PruFrames<Bench>::kBits);
    frames_.send(sent);
    frames_.frame();
    ++count_.frames;
    ++at_rate_;
    const std::uint32_t flags = frames_.flags();
    EXPECT_EQ((flags & 1U) != 0, row_.averages);
    const bool crc_bad = (flags & ~1U) != 0;
    const bool same = !crc_bad && frames_.position() == sent;
    if (!same) ++count_.bad;
    if (!same && !crc_bad) ++count_.wrong;
  }

  Row row_;
  unsigned percent_;
  PruFrames<Bench> frames_;
  Dice dice_;
  Count count_;
  unsigned at_rate_ = 0;  // frames since the change
};

Count run(const Row& row, unsigned percent, unsigned frames) {
  // Half slots of 200 MHz are 5 ns at 5 and 10 MHz; a tenth of the frames.
  Count sum;
  const auto add = [&sum](const Count& one) {
    sum.frames += one.frames;
    sum.bad += one.bad;
    sum.wrong += one.wrong;
  };
  const unsigned tenth = frames / 10;
  add(Jitter<PruBench80>(row, percent).run(frames - tenth));
  add(Jitter<PruBench200>(row, percent).run(tenth));
  return sum;
}

constexpr Row kRows[] = {{"Off", 12, false, false, false},
                         {"At10MHz", 12, false, false, true},
                         {"On", 20, false, true, false},
                         {"FirstLowOff", 30, true, false, false},
                         {"FirstLowAt10MHz", 30, true, false, true},
                         {"FirstLowOn", 30, true, true, false}};

void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

class PruJitter : public testing::TestWithParam<Row> {};

TEST_P(PruJitter, UpToItsLimit_NoWordIsBad) {
  const Count count = run(GetParam(), GetParam().percent, frames_of(20'000));
  std::printf("%s, jitter %u %%: %u of %u words bad\n", GetParam().name, GetParam().percent,
              count.bad, count.frames);
  EXPECT_EQ(count.bad, 0U) << "of " << count.frames;
}

// Beyond that bad words are counted, and those of them by themselves that a CRC does not find.
TEST_P(PruJitter, BeyondIt_BadWordsAreCounted) {
  unsigned last = 0;
  for (const unsigned percent : {25U, 30U, 35U, 40U, 50U, 60U}) {
    if (percent <= GetParam().percent) continue;
    const Count count = run(GetParam(), percent, frames_of(20'000) / 20);
    std::printf("%s, jitter %u %%: %u of %u words bad, %u of them with a CRC that fits\n",
                GetParam().name, percent, count.bad, count.frames, count.wrong);
    last = count.bad;
  }
  EXPECT_GT(last, 0U) << "the test could see nothing";
}

INSTANTIATE_TEST_SUITE_P(Rows, PruJitter, testing::ValuesIn(kRows),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace mb4test
