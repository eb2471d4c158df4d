// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A host that writes and reads anything at any time. Each access has its answer, no assertion of
// the RTL fails (that would throw), and after a clean start the next frame is good.
// MB4_PRU_ACCESSES: accesses.
#include <iterator>

#include "sim/core/random.hpp"
#include "tests/chip/pru/pru_sim.hpp"
#include "tests/support/environment.hpp"

namespace mb4test {
namespace {

// A register of the map three times of four, else any word.
std::uint32_t any_address(sim::Random& random) {
  constexpr std::uint32_t kAll[] = {
      prureg::kAddrLengths,    prureg::kAddrCtrl,        prureg::kAddrPosHi,
      prureg::kAddrPosLo,      prureg::kAddrCtrlResult,  prureg::kAddrStatus,
      prureg::kAddrReceived,   prureg::kAddrTimes,       prureg::kAddrIrqStatus,
      prureg::kAddrIrqEnable,  prureg::kAddrTimeLow,     prureg::kAddrTimeHigh,
      prureg::kAddrRun,        prureg::kAddrRun,         prureg::kAddrTriggerPeriod,
      prureg::kAddrOverhead,   prureg::kAddrProcTimeMax, prureg::kAddrSignals,
      prureg::kAddrFrameCount, prureg::kAddrLatchTime};
  if (random.up_to(3) == 0) return static_cast<std::uint32_t>(random.up_to(0x3FF)) << 2U;
  return kAll[random.up_to(std::size(kAll) - 1)];
}

// Values that do something: small ones, single bits, any.
std::uint32_t any_value(sim::Random& random) {
  switch (random.up_to(3)) {
    case 0:
      return static_cast<std::uint32_t>(random.up_to(40));
    case 1:
      return 1U << random.up_to(31);
    case 2:
      return static_cast<std::uint32_t>(random.up_to(0xFFFF));
    default:
      return static_cast<std::uint32_t>(random.next());
  }
}

TEST(PruRandom, AnyAccessAtAnyTime_EndsAndTheNextFrameIsGood) {
  constexpr unsigned kBits = 18;
  const std::uint64_t accesses = number("MB4_PRU_ACCESSES", 100'000);
  const std::uint64_t seed = number("MB4_SEED", 1);
  SCOPED_TRACE("MB4_SEED=" + std::to_string(seed));
  sim::Random random(seed);
  const std::string encoder =
      "[[channel]]\nnumber = 1\ncable_m = 10.0\n[[channel.slave]]\nprotocol = \"biss-c\"\n"
      "data_bits = 20\ncrc = 0x43\ntimeout = 5\n";
  PruSim slow(pru_scenario(encoder, 80'000'000));
  PruSim fast(pru_scenario(encoder));
  constexpr unsigned kRates[] = {1, 2, 5, 10};
  std::uint64_t done = 0, starts = 0;
  while (done < accesses) {
    PruSim& pru = starts % 2 == 0 ? slow : fast;
    // Most of the time a frame runs.
    pru.write(prureg::kAddrTriggerPeriod, static_cast<std::uint32_t>(random.up_to(3000)));
    pru.write(prureg::kAddrOverhead, static_cast<std::uint32_t>(random.up_to(1000)));
    pru.write(prureg::kAddrRun, 1);
    for (unsigned i = 0; i < 200; ++i, ++done) {
      const std::uint32_t address = any_address(random);
      if (random.up_to(2) == 0) {
        pru.read(address);
      } else {
        pru.write(address, any_value(random), static_cast<std::uint8_t>(random.up_to(15)));
      }
      if (random.up_to(20) == 0) {
        pru.simulator.set_pin(*pru.simulator.pin_by_name("trigger_i"), random.up_to(1) != 0);
      }
      pru.simulator.advance(random.up_to(2'000'000));  // not only at edges of the clock
    }
    // The clean start of a program, after the longest timeout of an encoder.
    pru.write(prureg::kAddrRun, 0);
    pru.write(prureg::kAddrOverhead, 2160);
    pru.write(prureg::kAddrProcTimeMax, 0);
    pru.write(prureg::kAddrCtrl, 0);
    pru.simulator.advance(50 * sim::kPsPerUs);
    const unsigned mhz = kRates[random.up_to(3)];
    const std::uint64_t first = random.next() & 0x3FFFF;
    pru.simulator.slave(1)->set_data(first << 2U | 3U);
    const PruFrame run = pru.start(kBits, 8, mhz);
    ASSERT_EQ(run.position, first) << "after " << done << " accesses";
    const std::uint64_t position = random.next() & 0x3FFFF;
    pru.simulator.slave(1)->set_data(position << 2U | 3U);
    const PruFrame frame = pru.frame();
    ASSERT_EQ(frame.position, position) << "after " << done << " accesses";
    ASSERT_EQ(frame.flags() & ~kPruSending & ~kPruControlCrc, 0U);
    ++starts;
  }
  EXPECT_GE(starts, accesses / 200);
}

}  // namespace
}  // namespace mb4test
