// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The whole simulator with the Verilated chip: tests of the simulator itself.
#include "mb4sim/simulator.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "mb4_regs.hpp"
#include "sim/lines/biss/biss_c_slave.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/masters/mb4/pins.hpp"

namespace mb4test {

using namespace mb4::sim;
namespace reg = mb4::regs;

namespace {

Scenario load(const char* example) { return load_scenario(std::string(MB4_EXAMPLES) + example); }

std::vector<std::uint8_t> exchange(Simulator& simulator, std::vector<std::uint8_t> tx) {
  std::vector<std::uint8_t> rx(tx.size());
  simulator.spi().transfer(tx, rx);
  return rx;
}

// Datasheet Tables 41, 42.
TEST(Simulator, ChipAfterReset_AnswersOverSpi) {
  Simulator simulator(load("/resolute-26.toml"));
  const auto rx = exchange(simulator, {reg::kSpiOpcodeReadRegisters, reg::kAddrRevision, 0, 0});
  EXPECT_EQ(rx[2], reg::kRevisionY);
  EXPECT_EQ(rx[3], reg::kVersionIcMb4);
}

// Datasheet page 21: RAM registers reset to 0, for any power-on values of the flops.
TEST(Simulator, AnySeed_ConfigurationIsZeroAfterReset) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SimulatorOptions options;
    options.seed = seed;
    Simulator simulator(load("/resolute-26.toml"), options);
    std::vector<std::uint8_t> tx(2 + 42, 0);
    tx[0] = reg::kSpiOpcodeReadRegisters;
    tx[1] = reg::slave_cfg_address(1);
    const auto rx = exchange(simulator, tx);
    for (std::size_t i = 2; i < rx.size(); ++i) EXPECT_EQ(rx[i], 0) << "seed " << seed;
  }
}

TEST(Simulator, ClockAndTime_AgreeWithTheFrequency) {
  Scenario scenario = load("/resolute-26.toml");
  scenario.channels.clear();
  Simulator simulator(scenario);
  const std::uint64_t before = simulator.clk_cycles();
  simulator.advance(1000 * kPsPerUs);
  EXPECT_EQ(simulator.clk_cycles() - before, 20'000U);
  EXPECT_EQ(simulator.now(), Simulator::kReady + 1000 * kPsPerUs);
}

TEST(Simulator, NoClockAtPin_StandsStillUntilOscillatorIsSelected) {
  Simulator simulator(load("/sine-internal-osc.toml"));
  simulator.advance(10 * kPsPerUs);
  EXPECT_EQ(simulator.clk_cycles(), 0U);
  exchange(simulator, {reg::kSpiOpcodeWriteRegisters, reg::kAddrIface, reg::kClkeniInternal});
  simulator.advance(kPsPerUs);  // the clock switch takes two periods
  const std::uint64_t before = simulator.clk_cycles();
  simulator.advance(100 * kPsPerUs);
  EXPECT_EQ(simulator.clk_cycles() - before, 2000U);
  exchange(simulator, {reg::kSpiOpcodeWriteRegisters, reg::kAddrIface, reg::kClkeniExternal});
  simulator.advance(10 * kPsPerUs);
  const std::uint64_t stopped = simulator.clk_cycles();
  simulator.advance(10 * kPsPerUs);
  EXPECT_EQ(simulator.clk_cycles(), stopped);
}

TEST(Simulator, Callbacks_RunAtTheirTimes) {
  Simulator simulator(load("/resolute-26.toml"));
  std::vector<Time> seen;
  for (const Time time : {5'000'123U, 2'000'000U, 3'333'333U}) {
    simulator.at(time, [&] { seen.push_back(simulator.now()); });
  }
  simulator.run_until(10 * kPsPerUs);
  EXPECT_EQ(seen, (std::vector<Time>{2'000'000, 3'333'333, 5'000'123}));
}

TEST(Simulator, ManyAtOnce_DoNotDisturbEachOther) {
  const Scenario scenario = load("/resolute-26.toml");
  Simulator first(scenario);
  Simulator second(scenario);
  exchange(first, {reg::kSpiOpcodeWriteRegisters, reg::kAddrFreq, 0x55});
  EXPECT_EQ(exchange(first, {reg::kSpiOpcodeReadRegisters, reg::kAddrFreq, 0})[2], 0x55);
  EXPECT_EQ(exchange(second, {reg::kSpiOpcodeReadRegisters, reg::kAddrFreq, 0})[2], 0x00);
}

// Slave 1 as examples/resolute-26.toml has it, MA at 10 MHz.
void configure_resolute(Simulator& simulator) {
  exchange(simulator, {reg::kSpiOpcodeWriteRegisters, reg::slave_cfg_address(1),
                       reg::kEnscdYes | 27, reg::kScrclenCrc6, 0, 0});
  exchange(simulator, {reg::kSpiOpcodeWriteRegisters, reg::kAddrCtrl, reg::kRegversBissC,
                       reg::FREQR::of(5), 0, reg::kFreqagsAgsMin});
  exchange(simulator, {reg::kSpiOpcodeWriteRegisters, reg::kAddrCfgch,
                       reg::kCfgch1BissC | reg::kCfgch2Unused});
}

TEST(Simulator, SameSeed_GivesTheSameRun) {
  Scenario scenario = load("/resolute-26.toml");
  scenario.channels[0].slaves[0].device.as<BissCSlaveConfig>().timeout.sample_period = 9'000;
  const auto run = [&](std::uint64_t seed) {
    SimulatorOptions options;
    options.seed = seed;
    Simulator simulator(scenario, options);
    configure_resolute(simulator);
    Time end = 0;
    for (int i = 0; i < 5; ++i) {
      exchange(simulator, {reg::kSpiOpcodeWriteInstruction, reg::kInstrCdm0});
      simulator.run_while_waiting([&] { return !clocked(simulator.slave(1))->idle(); },
                                  simulator.now() + 100 * kPsPerUs);
      simulator.run_while_waiting([&] { return clocked(simulator.slave(1))->idle(); },
                                  simulator.now() + 100 * kPsPerUs);
      end = end * 31 + simulator.now();
    }
    EXPECT_EQ(simulator.slave(1)->frames(), 5U);
    return end;
  };
  EXPECT_EQ(run(7), run(7));
  EXPECT_NE(run(7), run(8));
}

// Pins that no device drives, by the items of the electrical characteristics. The simulator drives
// NRES (high, after its reset) and CFGSPI (the scenario's host) against their pull-downs.
TEST(Simulator, UndrivenPins_RestAtTheirPulls) {
  struct Row {
    const char* item;
    bool up;
    std::vector<Pin> pins;
  };
  const std::vector<Row> rows = {
      {"A06",
       false,
       {Pin::kCfgspi, Pin::kIntNmot, Pin::kAle, Pin::kDb0, Pin::kDb1, Pin::kDb2, Pin::kDb3,
        Pin::kDb4, Pin::kDb5, Pin::kDb6, Pin::kDb7}},
      {"A07", true, {Pin::kNcs, Pin::kNrdRnw, Pin::kNwrE}},
      {"B01", true, {Pin::kSl1, Pin::kSl2}},
      {"C06", false, {Pin::kGetsens}},
      {"C07", true, {Pin::kNer}},
      {"D06", false, {Pin::kClk}},
      {"E07", false, {Pin::kNres}},
  };
  const Simulator simulator(parse_scenario("[chip]\nf_clk_hz = 0\n", "open.toml"));
  for (const Row& row : rows) {
    for (const Pin pin : row.pins) {
      EXPECT_EQ(pulled_up(pin), row.up) << row.item << " " << static_cast<int>(pin);
      const bool driven = pin == Pin::kNres || pin == Pin::kCfgspi;
      EXPECT_EQ(simulator.pin(pin), driven || row.up) << row.item << " " << static_cast<int>(pin);
    }
  }
  EXPECT_TRUE(simulator.pin(Pin::kMa1));
  EXPECT_TRUE(simulator.pin(Pin::kEot));
  EXPECT_FALSE(simulator.pin(Pin::kMo1));
}

// A06: the data bus is not driven between two cycles; an open GETSENS (C06) asks for no frame, an
// open SL (B01) is ready for one.
TEST(Simulator, BusLetGo_ReturnsToItsPullDowns) {
  Simulator simulator(parse_scenario("[host]\ninterface = \"intel\"\n", "open.toml"));
  constexpr std::uint8_t kCrc = reg::slave_cfg_address(1) + reg::kSlaveCfgCrcOffset;
  simulator.bus().write(kCrc, 0xFF);
  EXPECT_EQ(simulator.bus().read(kCrc), 0xFF);
  for (unsigned bit = 0; bit < 8; ++bit) {
    EXPECT_FALSE(simulator.pin(static_cast<Pin>(bit))) << bit;
  }
  simulator.bus().write(reg::kAddrCfgch, reg::kCfgch1BissC | reg::kCfgch2BissC);
  simulator.bus().write(reg::kAddrFreqags, reg::kFreqagsAgsInfinite);
  simulator.bus().write(reg::kAddrInstr, reg::kAgsOn);
  simulator.advance(100 * kPsPerUs);
  EXPECT_TRUE(simulator.pin(Pin::kMa1));
  EXPECT_TRUE(simulator.pin(Pin::kEot));
  EXPECT_EQ(simulator.bus().read(reg::kAddrStatus0), reg::kResetStatus0);
  simulator.set_pin(Pin::kGetsens, true);
  EXPECT_TRUE(simulator.run_while_waiting([&] { return !simulator.pin(Pin::kMa1); },
                                          simulator.now() + 100 * kPsPerUs));
}

TEST(Simulator, NerPulledOutside_ReadsLowUntilReleased) {
  Simulator simulator(load("/resolute-26.toml"));
  simulator.set_pin(Pin::kNer, false);
  EXPECT_FALSE(simulator.pin(Pin::kNer));
  EXPECT_EQ(exchange(simulator, {reg::kSpiOpcodeReadStatus, 0})[1] & reg::nERR::kMask,
            0);  // shows the level of the pin
  simulator.set_pin(Pin::kNer, true);
  EXPECT_TRUE(simulator.pin(Pin::kNer));
}

TEST(Simulator, DrivenPins_CannotBeSet) {
  Simulator simulator(load("/resolute-26.toml"));
  for (const Pin pin : {Pin::kEot, Pin::kMa1, Pin::kMa2, Pin::kMo1, Pin::kSl1, Pin::kClk}) {
    EXPECT_FALSE(simulator.can_set(pin));
  }
  EXPECT_TRUE(simulator.can_set(Pin::kSl2));  // no channel 2 in this scenario
}

// Datasheet BiSS C chapter: N + 5 rising edges, 50 % duty (I302, I303) and CDM = 0: MA rests high.
TEST(Simulator, OneFrame_MonitorSeesTheChipsClock) {
  Scenario scenario = load("/resolute-26.toml");
  scenario.channels[0].cable->delay = 0;
  Simulator simulator(scenario);
  configure_resolute(simulator);
  exchange(simulator, {reg::kSpiOpcodeWriteInstruction, reg::kInstrCdm0});
  simulator.advance(50 * kPsPerUs);
  const MaFrame frame = clocked(simulator.line(1))->monitor().last(simulator.now());
  EXPECT_EQ(frame.rising, 28U + 6 + 5);
  EXPECT_EQ(frame.min_low, 50'000U);
  EXPECT_EQ(frame.max_low, 50'000U);
  EXPECT_EQ(frame.min_high, 50'000U);
  EXPECT_EQ(frame.max_high, 50'000U);
  EXPECT_TRUE(frame.rest_level);
  EXPECT_EQ(simulator.slave(1)->frames(), 1U);
  EXPECT_FALSE(clocked(simulator.slave(1))->last_cdm());
  const auto rx = exchange(simulator, {reg::kSpiOpcodeReadRegisters0, 0, 0, 0, 0});
  EXPECT_EQ(rx[1], 0xEF);
  EXPECT_EQ(rx[4], 0x02);
}

// The jitter of the first fault lasts when the second is added; afterwards the cable is as it was.
TEST(Simulator, InjectedJitterWithinAnother_LeavesTheCableAsItWas) {
  Simulator simulator(load("/resolute-26.toml"));
  const auto inject = [&](const std::string& for_us) {
    simulator.inject("[[fault]]\nkind = \"jitter\"\njitter_ns = 20\nat_us = 1.0\nfor_us = " +
                     for_us);
    simulator.advance(50 * kPsPerUs);
  };
  ASSERT_EQ(clocked(simulator.line(1))->sl_faults().jitter, 0U);
  inject("100.0");
  EXPECT_EQ(clocked(simulator.line(1))->sl_faults().jitter, 20'000U);
  inject("300.0");
  EXPECT_EQ(clocked(simulator.line(1))->sl_faults().jitter, 20'000U);
  simulator.advance(400 * kPsPerUs);
  EXPECT_EQ(clocked(simulator.line(1))->sl_faults().jitter, 0U);
  EXPECT_EQ(simulator.faults().size(), 2U);
}

}  // namespace
}  // namespace mb4test
