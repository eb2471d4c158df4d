// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A host that writes and reads anything at any time. Each access has its answer, no assertion of
// the RTL fails (that would throw), and after a clean start the next frame is good.
// MB4_CLB_ACCESSES: accesses.
#include <iterator>
#include <string>

#include "sim/core/random.hpp"
#include "tests/chip/clb/clb_bench.hpp"
#include "tests/support/environment.hpp"

namespace mb4test {
namespace {

constexpr unsigned kBits = 18;

// A register of the map three times of four, else any word.
std::uint32_t any_address(sim::Random& random) {
  constexpr std::uint32_t kAll[] = {clbreg::kAddrClkCounter0Load,
                                    clbreg::kAddrClkCounter1Load,
                                    clbreg::kAddrClkCounter0Match1,
                                    clbreg::kAddrClkCounter1Match1,
                                    clbreg::kAddrClkCounter0Match2,
                                    clbreg::kAddrClkCounter1Match2,
                                    clbreg::kAddrClkGpreg,
                                    clbreg::kAddrClkLoadEn,
                                    clbreg::kAddrFsmCounter1Load,
                                    clbreg::kAddrFsmCounter2Load,
                                    clbreg::kAddrFsmCounter1Match1,
                                    clbreg::kAddrFsmCounter2Match1,
                                    clbreg::kAddrFsmHlcR0,
                                    clbreg::kAddrFsmGpreg,
                                    clbreg::kAddrFsmLoadEn,
                                    clbreg::kAddrFsmState,
                                    clbreg::kAddrSpiccr,
                                    clbreg::kAddrSpiffrx,
                                    clbreg::kAddrSpirxbuf,
                                    clbreg::kAddrIrqStatus,
                                    clbreg::kAddrIrqEnable,
                                    clbreg::kAddrTimeLow,
                                    clbreg::kAddrTimeHigh,
                                    clbreg::kAddrWatchdog};
  if (random.up_to(3) == 0) return static_cast<std::uint32_t>(random.up_to(0x3FF)) << 2U;
  return kAll[random.up_to(std::size(kAll) - 1)];
}

// Values that do something: small ones, single bits, any.
std::uint32_t any_value(sim::Random& random) {
  switch (random.up_to(3)) {
    case 0:
      return static_cast<std::uint32_t>(random.up_to(40));
    case 1:
      return 1U << random.up_to(15);
    case 2:
      return static_cast<std::uint32_t>(random.up_to(0xFFFF));
    default:
      return static_cast<std::uint32_t>(random.next());
  }
}

TEST(ClbRandom, AnyAccessAtAnyTime_EndsAndTheNextFrameIsGood) {
  const std::uint64_t accesses = number("MB4_CLB_ACCESSES", 100'000);
  const std::uint64_t seed = number("MB4_SEED", 1);
  SCOPED_TRACE("MB4_SEED=" + std::to_string(seed));
  sim::Random random(seed);
  ClbBench bench(
      clb_scenario("[[channel]]\nnumber = 1\ncable_m = 10.0\n[[channel.slave]]\n"
                   "protocol = \"biss-c\"\ndata_bits = 20\ncrc = 0x43\ntimeout = 5\n"));
  std::uint64_t done = 0, starts = 0;
  while (done < accesses) {
    // Most of the time a frame runs.
    bench.set_up(kBits, static_cast<unsigned>(4 + random.up_to(30)));
    PM_bissc_setupSCDTransaction(&bench.scd);
    PM_bissc_startOperation(&bench.scd, 10);
    for (unsigned i = 0; i < 200; ++i, ++done) {
      const std::uint32_t address = any_address(random);
      if (random.up_to(2) == 0) {
        bench.read(address);
      } else {
        bench.write(address, any_value(random), static_cast<std::uint8_t>(random.up_to(15)));
      }
      bench.simulator.advance(random.up_to(500'000));  // not only at edges of the clock
    }
    // The clean start of an application, after the longest timeout of an encoder.
    bench.write(clbreg::kAddrWatchdog, 4096);
    bench.set_up(kBits, 10);
    bench.simulator.advance(50 * sim::kPsPerUs);
    const std::uint64_t position = random.next() & 0x3FFFF;
    bench.simulator.slave(1)->set_data(position << 2U | 3U);
    ASSERT_EQ(bench.frame(), PM_BISSC_PASS) << "after " << done << " accesses";
    ASSERT_EQ(bench.encoder.position, position) << "after " << done << " accesses";
    ++starts;
  }
  EXPECT_GE(starts, accesses / 200);
}

}  // namespace
}  // namespace mb4test
