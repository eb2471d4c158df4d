// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Resets of biss_axi at any instant of a frame, and a start 0 to 50 us after them: the encoder may
// still be in its frame or in its timeout. No word of the encoder's old frame, and no wrong one,
// may come as good. MB4_AXI_RESETS: resets for each case. Source: docs/axi.md, "Reset".
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "sim/core/random.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/chip/axi/axi_bench.hpp"

namespace mb4test {
namespace {

constexpr unsigned kBits = 26;
constexpr std::uint64_t kMost = (std::uint64_t{1} << kBits) - 1;
constexpr sim::Time kHold = 41 * sim::kPsPerUs;  // TIMEOUT_LIMIT, 4000 clocks, and some

struct Case {
  unsigned channels;
  bool fixed;    // timeouts of the encoders
  bool por_pin;  // POR_PIN
};

std::string quirk(bool por_pin) { return por_pin ? "POR_PIN = true\n" : ""; }

std::uint64_t cuts(AxiBench& bench) {
  std::uint64_t all = 0;
  for (unsigned c = 1; c <= bench.simulator.scenario().channels.size(); ++c) {
    all += ma_check(bench.simulator.line_end(c)).cut();
  }
  return all;
}

class AxiReset : public testing::TestWithParam<Case> {
 protected:
  std::uint64_t below(std::uint64_t limit) { return random_.next() % limit; }

  std::string scenario(bool full) {
    std::vector<AxiEncoder> encoders;
    for (unsigned c = 0; c < GetParam().channels; ++c) {
      constexpr const char* kTimeouts[] = {"20", "2", "38"};
      encoders.push_back(
          {.bits = kBits,
           .delay_ns = static_cast<double>(below(800)),
           .slave = "busy_periods = " + std::to_string(below(4)) + "\n" +
                    (GetParam().fixed ? std::string("timeout = ") + kTimeouts[below(4) % 3] + "\n"
                                      : std::string())});
    }
    std::string text = "[sim]\nseed = " + std::to_string(below(1'000'000)) + "\n" +
                       axi_scenario(encoders, 100'000'000, "", quirk(GetParam().por_pin));
    if (full) text = with_features(text, "full");
    return text;
  }

  // Words that the encoders latch from now on; many of them are 1 for long.
  void set_data(AxiBench& bench) {
    for (unsigned c = 0; c < GetParam().channels; ++c) {
      now_[c] = below(3) == 0 ? kMost - below(4) : random_.next() & kMost;
      bench.simulator.slave(c + 1)->set_data(raw_word(now_[c]));
    }
  }

  // Beats that have come: each good word must be the present one.
  void look(AxiBench& bench, bool full) {
    while (const auto beat = bench.host.next_beat()) {
      for (unsigned c = 0; c < GetParam().channels; ++c) {
        if ((beat->user >> c & 1U) == 0) continue;
        ++good_;
        if (beat->words[full ? 2 * c : c] != now_[c]) ++wrong_;
      }
    }
  }

  sim::Random random_{1};
  std::uint64_t now_[16] = {};
  std::uint64_t good_ = 0, wrong_ = 0;
};

TEST_P(AxiReset, AtAnyInstant_NoWrongWordComesAsGood) {
  const char* text = std::getenv("MB4_AXI_RESETS");
  const std::uint64_t resets = text != nullptr ? std::strtoull(text, nullptr, 0) : 24;
  const char* seed_text = std::getenv("MB4_SEED");
  const std::uint64_t seed = seed_text != nullptr ? std::strtoull(seed_text, nullptr, 0) : 1;
  SCOPED_TRACE("MB4_SEED=" + std::to_string(seed));
  const Case& c = GetParam();
  random_ = sim::Random(seed * 100 + c.channels * 4 + (c.fixed ? 2U : 0U) + (c.por_pin ? 1U : 0U));
  std::uint64_t done = 0, cut = 0;
  while (done < resets) {
    const bool full = below(3) == 0;
    AxiBench bench(scenario(full));
    for (unsigned round = 0; round < 20 && done < resets; ++round, ++done) {
      const bool check = below(2) != 0;
      const auto divider = static_cast<unsigned>(1 + below(below(4) == 0 ? 100 : 20));
      const auto set_up = [&] {
        bench.set_up(kBits, divider);
        bench.write(axireg::kAddrCrcCheck, check ? 1 : 0);
        if (full && below(2) != 0) {
          bench.write(axireg::kAddrTimeout, 3'900U | static_cast<unsigned>(below(2)) << 31U);
        }
      };
      // A good frame, begun when every channel must be free.
      set_data(bench);
      set_up();
      bench.simulator.advance(kHold + 100 * sim::kPsPerUs);
      while (bench.host.next_beat()) {
      }
      bench.request();
      // Edges of MA up to the last bit, then up to 40 us of timeout.
      const sim::Time frame = (kBits + 20) * 2 * divider * bench.period;
      bench.simulator.advance(below(frame + (below(4) == 0 ? kHold : 0)));
      bench.set_pin("axi_aresetn", false);
      bench.simulator.advance(below(below(2) == 0 ? 100'000 : 3'000'000));
      bench.set_pin("axi_aresetn", true);
      look(bench, full);  // the frame that was cut may have ended just before
      set_data(bench);
      const sim::Time released = bench.simulator.now();
      // Registers are written in about 0.8 us.
      set_up();
      const sim::Time start = released + below((below(2) == 0 ? 3 : 50) * sim::kPsPerUs);
      if (start > bench.simulator.now()) bench.simulator.run_until(start);
      bench.request();
      bench.simulator.advance(frame + (divider < 8 ? 60 : 20) * sim::kPsPerUs);
      const std::uint64_t before = wrong_;
      look(bench, full);
      EXPECT_EQ(wrong_, before) << "reset " << done << ", start "
                                << (start - released) / sim::kPsPerNs << " ns after, CRC " << check
                                << ", divider " << divider;
      // The channels work again.
      if (below(8) != 0) continue;
      bench.simulator.advance(kHold + 2 * frame);
      while (bench.host.next_beat()) {
      }
      const auto beat = bench.frame(kHold + 2 * frame);
      ASSERT_TRUE(beat);
      EXPECT_EQ(beat->user, (1U << c.channels) - 1) << "reset " << done;
    }
    cut += cuts(bench);
  }
  EXPECT_EQ(wrong_, 0U);
  EXPECT_GT(good_, 0U) << "a test without good words shows nothing";
  // A pulse that is short for another reason stops the simulator.
  if (c.por_pin) {
    EXPECT_EQ(cut, 0U);
  } else {
    EXPECT_GT(cut, 0U);
  }
  RecordProperty("resets", std::to_string(done));
  RecordProperty("good", std::to_string(good_));
  RecordProperty("wrong", std::to_string(wrong_));
  RecordProperty("cut", std::to_string(cut));
  std::printf("%llu resets: %llu good words, %llu wrong, %llu pulses of MA cut\n",
              static_cast<unsigned long long>(done), static_cast<unsigned long long>(good_),
              static_cast<unsigned long long>(wrong_), static_cast<unsigned long long>(cut));
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const unsigned channels : {1U, 4U, 16U}) {
    for (const bool fixed : {false, true}) {
      for (const bool por_pin : {false, true}) cases.push_back({channels, fixed, por_pin});
    }
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Channels, AxiReset, testing::ValuesIn(all_cases()), [](const auto& test) {
  return std::to_string(test.param.channels) + (test.param.fixed ? "Fixed" : "Adaptive") +
         (test.param.por_pin ? "PorPin" : "NoPorPin");
});

// One low pulse of MA, 1 us long, and a reset in its middle.
TEST(AxiResetPins, LowPulseOfMa_IsCutOnlyWithoutPorPin) {
  for (const bool por_pin : {false, true}) {
    AxiBench bench(axi_scenario({{.bits = kBits}}, 100'000'000, "", quirk(por_pin)));
    bench.set_up(kBits, 100);
    bench.simulator.advance(kHold);
    bench.request();
    bench.simulator.run_while_waiting([&] { return !bench.pin("ma0"); },
                                      bench.simulator.now() + 10 * sim::kPsPerUs);
    const sim::Time fell = bench.simulator.now();
    ASSERT_FALSE(bench.pin("ma0"));
    bench.simulator.advance(300 * sim::kPsPerNs);
    bench.set_pin("axi_aresetn", false);
    EXPECT_EQ(bench.pin("ma0"), !por_pin);
    EXPECT_EQ(ma_check(bench.simulator.line_end(1)).cut(), por_pin ? 0U : 1U);
    bench.simulator.run_while_waiting([&] { return bench.pin("ma0"); },
                                      bench.simulator.now() + 10 * sim::kPsPerUs);
    EXPECT_EQ(bench.simulator.now() - fell, (por_pin ? 1000 : 300) * sim::kPsPerNs);
    // MA rests, during the reset and after it.
    const std::uint64_t pulses = ma_check(bench.simulator.line_end(1)).pulses();
    bench.simulator.advance(5 * sim::kPsPerUs);
    EXPECT_TRUE(bench.pin("ma0"));
    bench.set_pin("axi_aresetn", true);
    bench.simulator.advance(100 * sim::kPsPerUs);
    EXPECT_TRUE(bench.pin("ma0"));
    EXPECT_EQ(ma_check(bench.simulator.line_end(1)).pulses(), pulses);
  }
}

// Without POR_PIN por_n does nothing. With it por_n resets MA and everything else.
TEST(AxiResetPins, PorN_CountsOnlyWithPorPin) {
  for (const bool por_pin : {false, true}) {
    AxiBench bench(axi_scenario({{.bits = kBits}}, 100'000'000, "", quirk(por_pin)));
    EXPECT_TRUE(bench.pin("por_n"));
    bench.set_up(kBits, 100);
    bench.simulator.advance(kHold);
    bench.request();
    bench.simulator.run_while_waiting([&] { return !bench.pin("ma0"); },
                                      bench.simulator.now() + 10 * sim::kPsPerUs);
    bench.simulator.advance(300 * sim::kPsPerNs);
    bench.set_pin("por_n", false);
    EXPECT_EQ(bench.pin("ma0"), por_pin);
    EXPECT_FALSE(bench.pin("por_n"));
    bench.simulator.advance(100 * sim::kPsPerNs);
    bench.set_pin("por_n", true);
    bench.simulator.advance(100 * sim::kPsPerUs);
    EXPECT_EQ(bench.read(axireg::kAddrMaDivider), por_pin ? 0U : 100U);
    EXPECT_EQ(ma_check(bench.simulator.line_end(1)).cut(), por_pin ? 1U : 0U);
    if (por_pin) {
      EXPECT_FALSE(bench.host.next_beat());
    } else {
      EXPECT_EQ(bench.host.next_beat()->user, 1U);
    }
  }
}

// After a reset, and after a soft reset in a frame, a start is skipped for TIMEOUT_LIMIT = 4000
// clocks from the instant on at which MA rests.
TEST(AxiResetPins, Starts_AreHeldBackForTheLimitAfterMaRests) {
  for (const bool hard : {true, false}) {
    AxiBench bench(axi_scenario({{.bits = kBits}}, 100'000'000, "", quirk(true)));
    bench.set_up(kBits, 250);
    bench.simulator.advance(kHold);
    bench.request();
    bench.simulator.run_while_waiting([&] { return !bench.pin("ma0"); },
                                      bench.simulator.now() + 10 * sim::kPsPerUs);
    if (hard) {
      bench.set_pin("axi_aresetn", false);
      bench.simulator.advance(50 * sim::kPsPerNs);
      bench.set_pin("axi_aresetn", true);
    } else {
      bench.write(axireg::kAddrSoftReset, 1);
      bench.write(axireg::kAddrSoftReset, 0);
    }
    bench.simulator.run_while_waiting([&] { return bench.pin("ma0"); },
                                      bench.simulator.now() + 10 * sim::kPsPerUs);
    const sim::Time rests = bench.simulator.now();
    if (hard) bench.set_up(kBits, 250);
    while (bench.pin("ma0") && bench.simulator.now() < rests + 100 * sim::kPsPerUs) {
      bench.request();
      bench.simulator.advance(50 * sim::kPsPerNs);
    }
    EXPECT_FALSE(bench.pin("ma0"));
    // The half period of MA before its first falling edge, and the time of a request.
    const sim::Time held = bench.simulator.now() - rests - 250 * bench.period;
    EXPECT_GE(held, 4000 * bench.period) << hard;
    EXPECT_LE(held, 4050 * bench.period) << hard;
  }
}

}  // namespace
}  // namespace mb4test
