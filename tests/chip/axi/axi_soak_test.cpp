// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Many frames of the BiSS C master on AXI over all delays of 0 to 120 clocks with jitter of SLO, of
// MA and of both, at MA = clock / 10. MB4_AXI_FRAMES: frames for each jitter.
#include <cstdlib>
#include <string>

#include "sim/core/random.hpp"
#include "tests/chip/axi/axi_bench.hpp"

namespace mb4test {
namespace {

constexpr unsigned kDelays = 121;
constexpr unsigned kBits = 26;

// x^6 + x + 1 over position, nE, nW; sent inverted.
std::uint32_t crc6(std::uint64_t word) {
  std::uint32_t rest = 0;
  for (unsigned bit = kBits + 2; bit-- > 0;) {
    const unsigned top = (rest >> 5U ^ static_cast<unsigned>(word >> bit)) & 1U;
    rest = ((rest << 1U) & 0x3FU) ^ (top != 0 ? 0x03U : 0U);
  }
  return rest ^ 0x3FU;
}

struct Jitter {
  unsigned sl, ma;  // clocks, peak to peak
  bool clean;       // no frame may be bad
};

class AxiSoak : public testing::TestWithParam<Jitter> {};

TEST_P(AxiSoak, EveryDelay_NoWrongWordBeyondWhatTheCrcLetsThrough) {
  const Jitter jitter = GetParam();
  const char* text = std::getenv("MB4_AXI_FRAMES");
  const std::uint64_t frames = text != nullptr ? std::strtoull(text, nullptr, 0) : 5 * kDelays;
  const char* seed_text = std::getenv("MB4_SEED");
  const std::uint64_t seed = seed_text != nullptr ? std::strtoull(seed_text, nullptr, 0) : 1;
  SCOPED_TRACE("MB4_SEED=" + std::to_string(seed));
  sim::Random random(seed);
  std::uint64_t done = 0, bad = 0, aliases = 0;
  for (unsigned delay = 0; delay < kDelays; ++delay) {
    const std::uint64_t until = frames * (delay + 1) / kDelays;
    const std::string keys = "jitter_ns = " + std::to_string(10 * jitter.sl) +
                             "\nma_jitter_ns = " + std::to_string(10 * jitter.ma) + "\n";
    AxiBench bench("[sim]\nseed = " + std::to_string(random.next() >> 33U) + "\n" +
                   axi_scenario({{.bits = kBits, .delay_ns = 10.0 * delay, .keys = keys}}));
    bench.set_up(kBits, 5);
    for (; done < until; ++done) {
      const std::uint64_t word = random.next() & ((std::uint64_t{1} << (kBits + 2)) - 1);
      bench.simulator.slave(1)->set_data(word);
      bench.request();
      std::optional<sim::StreamBeat> beat;
      bench.simulator.run_while_waiting(
          [&] {
            beat = bench.host.next_beat();
            return beat.has_value();
          },
          bench.simulator.now() + 100 * sim::kPsPerUs);
      ASSERT_TRUE(beat) << "frame " << done;
      // The encoder's timeout, then that of the master: SLO has been seen, and MA rests.
      bench.simulator.advance(sim::kPsPerUs);
      bench.simulator.run_while_waiting([&] { return bench.pin("slo0"); },
                                        bench.simulator.now() + 50 * sim::kPsPerUs);
      bench.simulator.advance(sim::kPsPerUs);
      if (beat->user == 0) {
        ++bad;
        continue;
      }
      const std::uint64_t got = std::uint64_t{beat->words[0]} << 2U |
                                (bench.pin("error") ? 2U : 0U) | (bench.pin("warn") ? 1U : 0U);
      if (got == word) continue;
      ++aliases;
      ASSERT_EQ(bench.read(axireg::kAddrReceivedCrc), crc6(got)) << "frame " << done;
    }
  }
  RecordProperty("frames", std::to_string(done));
  RecordProperty("bad", std::to_string(bad));
  RecordProperty("aliases", std::to_string(aliases));
  std::printf(
      "jitter of SLO %u, of MA %u clocks: %llu frames, %llu bad, %llu wrong with a right CRC\n",
      jitter.sl, jitter.ma, static_cast<unsigned long long>(done),
      static_cast<unsigned long long>(bad), static_cast<unsigned long long>(aliases));
  if (jitter.clean) {
    EXPECT_EQ(bad, 0U);
    EXPECT_EQ(aliases, 0U);
  } else {
    // A test that sees no bad frame has no jitter.
    EXPECT_GT(bad, 0U);
    EXPECT_LE(aliases, bad / 16 + 3);  // one in 64 if the bits were random
  }
}

INSTANTIATE_TEST_SUITE_P(Clocks, AxiSoak,
                         testing::Values(Jitter{0, 0, true}, Jitter{2, 0, true}, Jitter{4, 0, true},
                                         Jitter{0, 2, true}, Jitter{0, 4, true}, Jitter{2, 2, true},
                                         Jitter{8, 0, false}, Jitter{4, 4, false}),
                         [](const auto& test) {
                           return "Sl" + std::to_string(test.param.sl) + "Ma" +
                                  std::to_string(test.param.ma);
                         });

}  // namespace
}  // namespace mb4test
