// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The simulator evaluates the chip with as little work as possible, and omits clocks in which the
// chip is at rest (sim/masters/mb4/model/direct_steps.hpp). Two simulators run side by side through
// random sessions, one as usual and one with Verilator's eval() at every edge: all pins at every
// time, all registers and all slaves must be the same.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "mb4sim/simulator.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/pin_changes.hpp"
#include "tests/support/random_case.hpp"
#include "tests/support/session.hpp"

namespace mb4test {
namespace {

namespace reg = mb4::regs;
namespace sim = mb4::sim;

sim::SimulatorOptions plain_options() {
  sim::SimulatorOptions options;
  options.plain_evaluation = true;
  return options;
}

// Two bare chips on the parallel bus, without slaves' words and a script to write down.
struct Pair {
  explicit Pair(const sim::Scenario& scenario, sim::Time pause = 10 * sim::kPsPerUs)
      : fast(scenario), plain(scenario, plain_options()) {
    both([&](sim::Simulator& chip) { chip.advance(pause); });
  }
  template <typename Action>
  void both(const Action& action) {
    action(fast);
    action(plain);
  }
  void write(std::uint8_t address, std::uint8_t value) {
    both([&](sim::Simulator& chip) {
      chip.bus().write(address, value);
      chip.advance(600 * sim::kPsPerNs);
    });
  }
  void configure(const std::vector<std::pair<std::uint8_t, std::uint8_t>>& registers) {
    for (const auto& [address, value] : registers) write(address, value);
  }

  sim::Simulator fast;
  sim::Simulator plain;
};

class Lockstep {
 public:
  Lockstep(const RandomCase& random_case, const std::filesystem::path& folder)
      : fast_(random_case.scenario, folder / "fast"),
        plain_(random_case.scenario, folder / "plain", plain_options()) {}

  void write(std::uint8_t address, const std::vector<std::uint8_t>& bytes) {
    fast_.write(address, bytes);
    plain_.write(address, bytes);
  }
  void pin(sim::Pin pin, const char* name, bool level) {
    fast_.pin(pin, name, level);
    plain_.pin(pin, name, level);
  }
  void pass(sim::Time duration) {
    ASSERT_EQ(advance(fast_.simulator(), duration), advance(plain_.simulator(), duration));
  }
  void compare() {
    const std::vector<std::uint8_t> registers = fast_.read(reg::kAddrScdata, 256);
    ASSERT_EQ(registers, plain_.read(reg::kAddrScdata, 256));
    sim::Simulator& a = fast_.simulator();
    sim::Simulator& b = plain_.simulator();
    ASSERT_EQ(levels(a), levels(b));
    ASSERT_EQ(a.now(), b.now());
    ASSERT_EQ(a.clk_cycles(), b.clk_cycles());
    for (unsigned slave = 1; slave <= 8; ++slave) {
      ASSERT_EQ(a.slave(slave) == nullptr, b.slave(slave) == nullptr);
      if (a.slave(slave) == nullptr) continue;
      ASSERT_EQ(a.slave(slave)->frames(), b.slave(slave)->frames()) << "slave " << slave;
    }
  }
  const Session& session() const { return fast_; }
  sim::Simulator& fast() { return fast_.simulator(); }

 private:
  Session fast_;
  Session plain_;
};

// Both lines are used, with slaves or without.
void configure(Lockstep& chips, const RandomCase& random_case) {
  chips.pass(10 * sim::kPsPerUs);
  std::uint8_t cfgch = random_case.cfgch;
  for (const unsigned line : {0U, 1U}) {
    constexpr unsigned kBissC = 1;
    if (random_case.used[line]) continue;
    cfgch = static_cast<std::uint8_t>((cfgch & ~(3U << 2 * line)) | kBissC << 2 * line);
  }
  const auto& slaves = random_case.registers.slave;
  chips.write(reg::slave_cfg_address(1), {slaves.begin(), slaves.end()});
  chips.write(reg::kAddrChsel,
              {random_case.chsel,
               static_cast<std::uint8_t>(random_case.en_mo ? reg::kRegversBissC | reg::kEnMoData
                                                           : reg::kRegversBissC),
               static_cast<std::uint8_t>(reg::FREQR::of(5) | random_case.freqs), 0,
               reg::kFreqagsAgsMin, random_case.mo_busy});
  chips.write(reg::kAddrSlaveloc5,
              {static_cast<std::uint8_t>(random_case.registers.slaveloc5
                                             ? reg::kResetSlaveloc5 | reg::kSlaveloc5Split
                                             : reg::kResetSlaveloc5),
               cfgch, 0x00, random_case.registers.actnsens});
}

// One action of a host; most of them leave the chip at rest sooner or later.
void act(Lockstep& chips, Random& random) {
  const auto byte = [&] { return static_cast<std::uint8_t>(random.below(256)); };
  switch (random.below(12)) {
    case 0:  // a frame or a control communication
      chips.write(reg::kAddrInstr, {static_cast<std::uint8_t>(2 * random.below(8))});
      break;
    case 1:  // frames by themselves: fast, slow, by GETSENS
      chips.write(reg::kAddrFreqags, {byte()});
      chips.write(reg::kAddrInstr, {reg::kAgsOn});
      break;
    case 2:
      chips.write(
          reg::kAddrFreqags,
          {static_cast<std::uint8_t>(random.one_in(2) ? 0x80 + random.below(8)
                                                      : reg::kFreqagsAgsMin + random.below(4))});
      chips.write(reg::kAddrInstr, {reg::kAgsOn});
      break;
    case 3:
      chips.write(reg::kAddrInstr, {reg::kBreakAbort});
      break;
    case 4:
      for (const bool level : {true, false}) {
        chips.pin(sim::Pin::kGetsens, "GETSENS", level);
        chips.pass((1 + random.below(400)) * 10 * sim::kPsPerNs);
      }
      break;
    case 5:  // any register, any bits; instructions are above
      chips.write(static_cast<std::uint8_t>(random.below(reg::kAddrInstr)), {byte()});
      break;
    case 6:
      chips.write(reg::kAddrFreq, {byte()});
      break;
    case 7:  // the oscillator, and back
      chips.write(reg::kAddrIface, {static_cast<std::uint8_t>(random.one_in(4) ? byte() : 0)});
      break;
    case 8:
      if (!random.one_in(4)) break;
      for (const bool level : {false, true}) {
        chips.pin(sim::Pin::kNres, "NRES", level);
        chips.pass(sim::kPsPerUs);
      }
      break;
    case 9:  // a line without slaves moves at times that have nothing to do with CLK
      for (const auto& [pin, name] : {std::pair{sim::Pin::kSl1, "SL1"}, {sim::Pin::kSl2, "SL2"}}) {
        if (!chips.fast().can_set(pin)) continue;
        for (unsigned i = 0; i < 40; ++i) {
          chips.pin(pin, name, random.one_in(2));
          chips.pass((1 + random.below(200)) * sim::kPsPerNs);
        }
      }
      break;
    default:
      break;
  }
  // From a clock to 10 ms.
  constexpr sim::Time kLongest[] = {100, 3'000, 100'000, 10'000'000};
  const sim::Time longest = kLongest[random.below(4)];
  chips.pass((1 + random.word() % longest) * sim::kPsPerNs);
}

TEST(Lockstep, LessWork_ChangesNothing) {
  const std::uint64_t cases = number_from("MB4_LOCKSTEP_CASES", 16);
  const std::uint64_t first = number_from("MB4_SEED", 1);
  std::uint64_t left_out = 0;
  std::uint64_t clocks = 0;
  for (std::uint64_t seed = first; seed < first + cases; ++seed) {
    Random random(seed);
    const RandomCase random_case = make_case(random, true);
    const std::filesystem::path folder = failure_path("lockstep_" + std::to_string(seed));
    Lockstep chips(random_case, folder);
    configure(chips, random_case);
    for (unsigned action = 0; action < 60 && !::testing::Test::HasFatalFailure(); ++action) {
      act(chips, random);
      if (action % 8 == 7) chips.compare();
    }
    if (::testing::Test::HasFatalFailure()) {
      FAIL() << "MB4_SEED=" << seed << " MB4_LOCKSTEP_CASES=1; " << chips.session().save();
    }
    clocks += chips.fast().clk_cycles();
    left_out += chips.fast().clk_cycles_left_out();
    std::filesystem::remove_all(folder);
  }
#ifdef MB4_EDGE_IN_PARTS
  // Clocks must have been left out, or the two chips did the same work.
  EXPECT_GT(left_out, clocks / 4);
#endif
  EXPECT_GT(clocks - left_out, 1000 * cases);
  std::cout << cases << " cases, " << clocks << " clocks, " << left_out << " of them left out\n";
}

// CLKENI set and cleared between two rising edges of CLK: the oscillator starts and runs on for a
// while, but the clock switch has not moved. The edges of CLK in that time count as any others.
TEST(Lockstep, ClkeniShorterThanAClock_ChangesNothing) {
  const sim::Scenario scenario = sim::parse_scenario(
      "[chip]\nf_clk_hz = 10_000_000\n[host]\ninterface = \"intel\"\n[[channel]]\nnumber = 1\n"
      "[[channel.slave]]\nprotocol = \"biss-c\"\npreset = \"resolute-26\"\n",
      "clkeni");
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Pair chips(scenario);
    chips.both([](sim::Simulator& chip) { chip.bus().set_timing({}); });
    chips.configure(
        {{reg::slave_cfg_address(1), reg::kEnscdYes | 27},
         {reg::SCRCLEN<1>::kAddress, reg::kSelcrcsByPolynomial | reg::SCRCPOLY<1>::of(33)},
         {reg::kAddrChsel, reg::kChsel1Used},
         {reg::kAddrCtrl, reg::kRegversBissC},
         {reg::kAddrFreq, reg::FREQR::of(1) | reg::FREQS::of(3)},
         {reg::kAddrFreqags, reg::kFreqagsAgsMin},
         {reg::kAddrSlaveloc5, reg::kResetSlaveloc5},
         {reg::kAddrCfgch, reg::kCfgch1BissC}});
    for (unsigned step = 0; step < 400; ++step) {
      if (random.one_in(4)) {
        chips.write(reg::kAddrRegadr, static_cast<std::uint8_t>(random.below(256)));
        chips.write(reg::kAddrInstr, static_cast<std::uint8_t>(2 * random.below(8) | 1U));
      } else if (random.one_in(3)) {
        chips.write(reg::kAddrInstr, reg::kBreakAbort);
      }
      const sim::Time pause = (1 + random.below(30'000)) * sim::kPsPerNs;
      ASSERT_EQ(advance(chips.fast, pause), advance(chips.plain, pause)) << seed << " " << step;
      // Rising edges of CLK are 100 ns apart.
      constexpr sim::Time kPeriod = 100 * sim::kPsPerNs;
      const sim::Time edge = (chips.fast.now() / kPeriod + 2) * kPeriod + 13 * sim::kPsPerNs;
      if (random.one_in(2)) {
        chips.both([&](sim::Simulator& chip) {
          chip.run_until(edge);
          chip.bus().write(reg::kAddrIface, reg::kClkeniInternal);
          chip.bus().write(reg::kAddrIface, 0);
        });
      }
      ASSERT_EQ(advance(chips.fast, 3 * sim::kPsPerUs), advance(chips.plain, 3 * sim::kPsPerUs))
          << seed << " " << step;
      ASSERT_EQ(chips.fast.clk_cycles(), chips.plain.clk_cycles()) << seed << " " << step;
    }
  }
}

// SL and a pin of the host change one after the other, between two edges of CLK.
TEST(Lockstep, SlBesideAHostPin_ChangesNothing) {
  const sim::Scenario scenario =
      sim::parse_scenario("[chip]\nf_clk_hz = 20_000_000\n[host]\ninterface = \"intel\"\n", "sl");
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    Pair chips(scenario);
    chips.configure(
        {{reg::slave_cfg_address(1), reg::kEnscdYes | 27},
         {reg::SCRCLEN<1>::kAddress, reg::kSelcrcsByPolynomial | reg::SCRCPOLY<1>::of(33)},
         {reg::kAddrFreq, 0},
         {reg::kAddrFreqags, reg::kFreqagsAgsMin},
         {reg::kAddrCfgch, reg::kCfgch1BissC},
         {reg::kAddrInstr, reg::kAgsOn}});
    for (unsigned step = 0; step < 2'000; ++step) {
      const sim::Time before = 1 + random.below(60'000);
      const sim::Time between = 1 + random.below(10'000);
      const bool sl = random.one_in(2);
      const sim::Pin pin = random.one_in(2) ? sim::Pin::kGetsens : sim::Pin::kNer;
      const bool level = random.one_in(2);
      ASSERT_EQ(advance(chips.fast, before), advance(chips.plain, before)) << seed << " " << step;
      chips.both([&](sim::Simulator& chip) { chip.set_pin(sim::Pin::kSl1, sl); });
      ASSERT_EQ(advance(chips.fast, between), advance(chips.plain, between)) << seed << " " << step;
      chips.both([&](sim::Simulator& chip) { chip.set_pin(pin, level); });
    }
    for (unsigned address = 0; address < 256; ++address) {
      const auto byte = static_cast<std::uint8_t>(address);
      ASSERT_EQ(chips.fast.bus().read(byte), chips.plain.bus().read(byte))
          << seed << " " << address;
    }
  }
}

// The clock switch takes up CLK again after each reset, in the same clock in both. The write tells
// the clock: its frame waits for the memories to be cleared.
TEST(LockstepReset, OfAnyLength_EndsInTheSameClock) {
  for (const unsigned khz : {5'000U, 7'300U, 8'000U, 10'000U, 11'000U, 12'500U, 20'000U, 25'000U}) {
    const sim::Scenario scenario = sim::parse_scenario(
        "[chip]\nf_clk_hz = " + std::to_string(khz) + "_000\n[host]\ninterface = \"intel\"\n",
        "reset");
    Pair chips(scenario, 0);
    const sim::Time clock = sim::kPsPerSecond / (1'000 * khz);
    for (unsigned clocks = 0; clocks < 16; ++clocks) {
      if (clocks > 0) {
        chips.both([&](sim::Simulator& chip) {
          chip.set_pin(sim::Pin::kNres, false);
          chip.advance(clocks * clock + clock / 3);
          chip.set_pin(sim::Pin::kNres, true);
        });
      }
      chips.both([](sim::Simulator& chip) { chip.bus().write(reg::kAddrInstr, reg::kInstrCdm1); });
      ASSERT_EQ(advance(chips.fast, 50 * sim::kPsPerUs), advance(chips.plain, 50 * sim::kPsPerUs))
          << khz << " kHz, reset of " << clocks << " clocks";
    }
    ASSERT_EQ(chips.fast.clk_cycles(), chips.plain.clk_cycles()) << khz;
  }
}

// CLK again after the oscillator, at frequencies below its own.
TEST(LockstepReset, BackToASlowClk_TakesTheSameClocks) {
  for (const unsigned khz : {1'000U, 2'500U, 7'300U, 20'000U}) {
    const sim::Scenario scenario = sim::parse_scenario(
        "[chip]\nf_clk_hz = " + std::to_string(khz) + "_000\n[host]\ninterface = \"intel\"\n",
        "reset");
    Pair chips(scenario);
    chips.write(reg::kAddrFreqags, 0x02);
    chips.write(reg::kAddrInstr, reg::kAgsOn);
    for (unsigned turn = 0; turn < 20; ++turn) {
      for (const unsigned oscillator : {1U, 0U}) {
        chips.write(reg::kAddrIface, static_cast<std::uint8_t>(oscillator));
        const sim::Time pause = (3 + 7 * turn) * sim::kPsPerUs;
        ASSERT_EQ(advance(chips.fast, pause), advance(chips.plain, pause))
            << khz << " kHz, turn " << turn << ", CLKENI " << oscillator;
      }
    }
    ASSERT_EQ(chips.fast.clk_cycles(), chips.plain.clk_cycles()) << khz;
  }
}

// All pins that a chip can drive, the data bus bit by bit.
unsigned all_levels(const sim::Simulator& simulator) {
  unsigned word = levels(simulator);
  for (int bit = 0; bit < 8; ++bit) {
    word = word << 1U |
           (simulator.pin(static_cast<sim::Pin>(static_cast<int>(sim::Pin::kDb0) + bit)) ? 1U : 0U);
  }
  return word;
}

// The time of a host's next step: at an edge of CLK, or anywhere from 1 ps on.
sim::Time some_time(Random& random, sim::Time half_clock) {
  if (random.one_in(3)) return half_clock * (1 + random.below(4));
  constexpr sim::Time kLongest[] = {3, 100, 3'000};
  return 1 + random.word() % (kLongest[random.below(3)] * sim::kPsPerNs);
}

// Hosts that keep no protocol: pins change one by one at random times, many at those of edges of
// CLK. Frames run meanwhile, begun by a write in between. CLK has all ratios to the host.
class LockstepPins : public ::testing::TestWithParam<const char*> {};

TEST_P(LockstepPins, EdgesOfHostPins_ChangeNothingElse) {
  const std::string interface = GetParam();
  const std::uint64_t cases = number_from("MB4_LOCKSTEP_CASES", 12);
  for (std::uint64_t seed = 1; seed <= cases; ++seed) {
    Random random(seed);
    constexpr std::uint64_t kClk[] = {1'000'000, 7'300'000, 20'000'000, 25'000'000};
    const std::uint64_t f_clk = kClk[random.below(4)];
    const sim::Time half_clock = sim::kPsPerSecond / (2 * f_clk);
    const sim::Scenario scenario = sim::parse_scenario(
        "[chip]\nf_clk_hz = " + std::to_string(f_clk) + "\n[host]\ninterface = \"" + interface +
            "\"\n[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\n"
            "preset = \"resolute-26\"\n",
        "pins");
    Pair chips(scenario);
    const bool serial = interface.starts_with("spi");
    const auto write = [&](std::uint8_t address, std::uint8_t value) {
      chips.both([&](sim::Simulator& chip) {
        if (serial) {
          chip.spi().transfer(std::vector<std::uint8_t>{0x02, address, value}, {});
        } else {
          chip.bus().write(address, value);
        }
        chip.advance(600 * sim::kPsPerNs);
      });
    };
    write(reg::slave_cfg_address(1), reg::kEnscdYes | 27);
    write(reg::SCRCLEN<1>::kAddress, reg::kSelcrcsByPolynomial | reg::SCRCPOLY<1>::of(33));
    write(reg::kAddrChsel, reg::kChsel1Used);
    write(reg::kAddrCfgch, reg::kCfgch1BissC);
    write(reg::kAddrFreqags, reg::kFreqagsAgsMin);
    write(reg::kAddrInstr, reg::kAgsOn);
    for (unsigned step = 0; step < 3'000; ++step) {
      // SCLK and the strobes change most often, so that bytes are complete now and then.
      constexpr sim::Pin kPins[] = {
          sim::Pin::kAle, sim::Pin::kNwrE, sim::Pin::kNrdRnw, sim::Pin::kNcs,     sim::Pin::kDb5,
          sim::Pin::kDb4, sim::Pin::kDb6,  sim::Pin::kDb0,    sim::Pin::kGetsens, sim::Pin::kNer};
      const unsigned kind = random.below(40);
      const sim::Pin pin = kind < 20   ? sim::Pin::kAle
                           : kind < 30 ? sim::Pin::kDb0
                                       : kPins[random.below(10)];
      const bool level = !chips.plain.pin(pin);
      if (pin != sim::Pin::kNcs || random.one_in(8) || !level) {
        chips.both([&](sim::Simulator& chip) { chip.set_pin(pin, level); });
      }
      ASSERT_EQ(all_levels(chips.fast), all_levels(chips.plain)) << seed << " " << step;
      const sim::Time pause = some_time(random, half_clock);
      ASSERT_EQ(advance(chips.fast, pause), advance(chips.plain, pause)) << seed << " " << step;
      ASSERT_EQ(all_levels(chips.fast), all_levels(chips.plain)) << seed << " " << step;
      if (step % 300 == 299) {  // a byte that is written, then pins again
        chips.both([&](sim::Simulator& chip) { chip.set_pin(sim::Pin::kNcs, true); });
        write(static_cast<std::uint8_t>(random.below(reg::kAddrIface)),
              static_cast<std::uint8_t>(random.below(256)));
        write(reg::kAddrInstr, static_cast<std::uint8_t>(random.below(128)));
      }
    }
    ASSERT_EQ(chips.fast.clk_cycles(), chips.plain.clk_cycles()) << seed;
    chips.both([&](sim::Simulator& chip) { chip.set_pin(sim::Pin::kNcs, true); });
    for (unsigned address = 0; address < 256; ++address) {
      const auto byte = static_cast<std::uint8_t>(address);
      const auto read = [&](sim::Simulator& chip) {
        if (!serial) return chip.bus().read(byte);
        std::vector<std::uint8_t> back(3);
        chip.spi().transfer(std::vector<std::uint8_t>{0x03, byte, 0}, back);
        return back[2];
      };
      ASSERT_EQ(read(chips.fast), read(chips.plain)) << seed << " " << address;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Hosts, LockstepPins,
                         ::testing::Values("spi", "spi2", "intel", "motorola"));

}  // namespace
}  // namespace mb4test
