// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The parts of [[fault]] tables: glitches, aborted SPI frames, unplugged slaves, clocks.
// cli_fault_test.py tests the whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clock_source.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/core/wire.hpp"
#include "sim/faults/fault_types.hpp"
#include "sim/hosts/spi_host.hpp"
#include "sim/lines/biss/biss_c_slave.hpp"
#include "sim/lines/clocked/slave_chain.hpp"
#include "sim/masters/mb4/pins.hpp"
#include "tests/unit/core/arrivals.hpp"

namespace mb4test {

using namespace mb4::sim;

namespace {

// The order is that of the message which lists the kinds; each protocol's own come after the shared
// ones.
TEST(FaultParts, Kinds_AreListedOnce) {
  std::vector<std::string_view> names;
  for (const FaultType& type : fault_types()) names.push_back(type.name);
  const std::vector<std::string_view> expected = {
      "bit-flip",       "glitch",        "stuck",           "jitter",
      "silent",         "busy",          "wrong-crc",       "wrong-id",
      "stuck-word",     "stuck-counter", "skipped-word",    "swapped-words",
      "wrong-crc2",     "fast-marker",   "safe-marker",     "safe2-marker",
      "no-vsync",       "early-vsync",   "late-vsync",      "stale-safe",
      "safe2-mismatch", "toggle2-stuck", "test2",           "error2",
      "fix2",           "lost-nibble",   "wrong-message",   "message-nak",
      "no-message",     "late-message",  "foreign-address", "foreign-direction",
      "foreign-length", "unplug",        "abort",           "clock-frequency",
      "clock-stop"};
  EXPECT_EQ(names, expected);
}

TEST(FaultParts, FaultOfASlave_HasAPlaceForItsNameAndAReasonAgainstIt) {
  for (const FaultType& type : fault_types()) {
    if (type.of_slave == nullptr) continue;
    EXPECT_EQ(std::count(type.of_slave->happens.begin(), type.of_slave->happens.end(), '%'), 1)
        << type.name;
    EXPECT_EQ(type.of_slave->refusal.empty(), type.name == "silent") << type.name;
  }
}

TEST(FaultParts, Glitch_InvertsTheLevelForItsWidth) {
  EventQueue queue;
  Arrivals arrivals;
  Wire wire(queue, 1000, {}, 1, 1, record, &arrivals);
  wire.glitch(50, 20);
  while (!queue.empty()) queue.run_next();
  EXPECT_EQ(arrivals, (Arrivals{{50, 0}, {70, 1}}));
}

// A second glitch inside the first restores the level for its duration.
TEST(FaultParts, GlitchInAGlitch_IsTheLevelAgain) {
  EventQueue queue;
  Arrivals arrivals;
  Wire wire(queue, 1000, {}, 1, 0, record, &arrivals);
  wire.glitch(0, 100);
  queue.post(30, [&] { wire.glitch(30, 20); });
  while (!queue.empty()) queue.run_next();
  EXPECT_EQ(arrivals, (Arrivals{{0, 1}, {30, 0}, {50, 1}, {100, 0}}));
}

// Records the rising edges of SCLK while NCS is low.
class CountingPins final : public HostPins {
 public:
  Time now() const override { return now_; }
  void run_until(Time time) override { now_ = std::max(now_, time); }
  void set_pin(Pin pin, bool level) override {
    if (pin == Pin::kNcs) selected = !level;
    if (pin == Pin::kAle && level && selected) ++clocks;
  }
  bool pin(Pin /*pin*/) const override { return true; }

  bool selected = false;
  unsigned clocks = 0;

 private:
  Time now_ = 0;
};

TEST(FaultParts, AbortedSpiFrame_EndsBehindItsClocks) {
  CountingPins pins;
  SpiHost host(pins, SpiTiming::for_frequency(10'000'000), kSpiPins);
  const std::array<std::uint8_t, 4> tx{};
  std::array<std::uint8_t, 4> rx{1, 2, 3, 4};
  host.abort_next(11);
  host.transfer(tx, rx);
  EXPECT_EQ(pins.clocks, 11U);
  EXPECT_FALSE(pins.selected);
  EXPECT_EQ(rx, (std::array<std::uint8_t, 4>{0xFF, 0xE0, 0, 0})) << "MISO is 1 here";
  EXPECT_EQ(host.aborted(), 1U);
  host.transfer(tx, rx);
  EXPECT_EQ(pins.clocks, 11U + 32U) << "only the next one";
}

TEST(FaultParts, AbortBehindTheEnd_StillCutsTheLastClock) {
  CountingPins pins;
  SpiHost host(pins, SpiTiming::for_frequency(10'000'000), kSpiPins);
  const std::array<std::uint8_t, 2> tx{};
  host.abort_next(1000);
  host.transfer(tx, {});
  EXPECT_EQ(pins.clocks, 15U);
}

TEST(FaultParts, ClockAtAnotherFrequency_GoesOnFromThere) {
  ClockSource clock(1'000'000'000);  // edges every 500 ps
  EXPECT_TRUE(clock.edge());
  clock.retune(100'000'000, 700);
  EXPECT_EQ(clock.next(), 700U + 5000U);
  EXPECT_FALSE(clock.edge());
  EXPECT_EQ(clock.next(), 700U + 10'000U);
  clock.retune(0, 11'000);
  EXPECT_EQ(clock.next(), kNever);
  clock.retune(1'000'000'000, 20'000);
  EXPECT_EQ(clock.next(), 20'500U);
  EXPECT_TRUE(clock.edge());
}

void ignore(Time /*now*/, void* /*receiver*/, bool /*slo*/) {}

// Three slaves; MA falls and rises by hand.
struct Chain {
  Chain() {
    for (unsigned i = 0; i < 3; ++i) {
      BissCSlaveConfig config;
      config.timeout.fixed = from_us(10);
      chain.add(std::make_unique<BissCSlave>(config, i));
    }
  }
  EventQueue queue;
  SlaveChain chain{queue, &ignore, nullptr};
};

TEST(FaultParts, DetachedSlaves_IdleAndHearNothing) {
  Chain bus;
  bus.chain.drive(1000, false, false);
  for (unsigned i = 0; i < 3; ++i) EXPECT_FALSE(bus.chain.slave(i).idle()) << i;
  bus.chain.detach(2000, 1);
  while (!bus.queue.empty()) bus.queue.run_next();
  bus.chain.drive(from_us(50), true, false);
  bus.chain.drive(from_us(60), false, false);
  EXPECT_FALSE(bus.chain.slave(0).idle());
  EXPECT_TRUE(bus.chain.slave(1).idle());
  EXPECT_TRUE(bus.chain.slave(2).idle());
  // Slave 1 sees an open SLI, 1: it is not the last one.
  EXPECT_FALSE(dynamic_cast<BissCSlave&>(bus.chain.slave(0)).is_last());
  bus.chain.detach(from_us(61), 3);
  EXPECT_FALSE(bus.chain.slave(1).idle()) << "MA = 0 came back";
}

TEST(FaultParts, SilentSlave_HoldsSlo) {
  Chain bus;
  bus.chain.slave(0).set_fault(slave_fault::kSilent, true);
  bus.chain.refresh(0);
  for (Time now = 1000; now < 20'000; now += 1000) {
    bus.chain.drive(now, (now / 1000) % 2 == 0, false);
    EXPECT_TRUE(bus.chain.slo()) << now;
  }
}

// A record of each, with its times.
TEST(FaultParts, Simulator_RecordsItsFaults) {
  Simulator simulator(
      parse_scenario("[[channel]]\nnumber = 1\n[[channel.slave]]\n"
                     "protocol = \"biss-c\"\ndata_bits = 8\n"
                     "[[fault]]\nkind = \"silent\"\nslave = 1\nat_us = [20, 30]\n"
                     "for_us = 15\n[[fault]]\nkind = \"glitch\"\nwidth_ns = 40\n"
                     "at_us = 25\n",
                     "test"));
  EXPECT_TRUE(simulator.faults().empty());
  simulator.run_until(from_us(40));
  ASSERT_EQ(simulator.faults().size(), 3U);
  EXPECT_EQ(simulator.faults()[0].begin, from_us(20));
  EXPECT_EQ(simulator.faults()[0].end, from_us(35));
  EXPECT_EQ(simulator.faults()[1].end, from_us(25) + from_ns(40));
  EXPECT_EQ(simulator.faults()[1].what, "glitch of 40 ns on SL of channel 1");
  EXPECT_EQ(simulator.faults()[2].end, kNever);
  EXPECT_TRUE(simulator.slave(1)->silent()) << "the second one goes on";
  simulator.run_until(from_us(46));
  EXPECT_FALSE(simulator.slave(1)->silent());
}

}  // namespace
}  // namespace mb4test
