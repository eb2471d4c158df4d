// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The check of the host's timing, and the host models under this check: datasheet pages 9 to 11.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <set>
#include <string>

#include "mb4_regs.hpp"
#include "sim/hosts/parallel_host.hpp"
#include "sim/hosts/spi_host.hpp"
#include "sim/masters/mb4/mb4_host_check.hpp"

namespace mb4test {

using namespace mb4::sim;

namespace {

// Pins without a chip, watched.
class WatchedPins final : public HostPins {
 public:
  WatchedPins() {
    for (const Pin pin : {Pin::kNcs, Pin::kNrdRnw, Pin::kNwrE, Pin::kCfgspi, Pin::kNres}) {
      set_pin(pin, true);
    }
    now_ = kPsPerUs;
  }
  Time now() const override { return now_; }
  void run_until(Time time) override { now_ = std::max(now_, time); }
  void set_pin(Pin pin, bool level) override { check.edge(now_, pin, level); }
  bool pin(Pin /*pin*/) const override { return false; }
  std::set<std::string> items() const {
    std::set<std::string> found;
    for (const auto& violation : check.violations()) found.insert(violation.item);
    return found;
  }

  Mb4HostCheck check;

 private:
  Time now_ = 0;
};

constexpr Time kBelow10 = 9'999;
constexpr Time kBelow15 = 14'999;

struct ParallelCase {
  std::string intel, motorola;  // the items that must be reported
  std::function<void(ParallelTiming&)> change;
};

std::set<std::string> parallel_items(ParallelMode mode,
                                     const std::function<void(ParallelTiming&)>& change) {
  WatchedPins pins;
  ParallelTiming timing;
  if (change) change(timing);
  ParallelHost host(pins, mode, timing, kParallelPins);
  host.rest();
  pins.run_until(2 * kPsPerUs);
  for (unsigned i = 0; i < 4; ++i) {
    host.write(0x55, 0xAA);
    host.read(0xAA);
    host.read(0x0F);
    host.write(0xF0, 0x55);
  }
  return pins.items();
}

TEST(HostCheck, ParallelHostAtTheLimits_NoViolation) {
  for (const auto mode : {ParallelMode::kIntel, ParallelMode::kMotorola}) {
    EXPECT_EQ(parallel_items(mode, nullptr), std::set<std::string>{});
    EXPECT_EQ(parallel_items(mode, [](auto& t) { t = ParallelTiming::for_cycle(500'000); }),
              std::set<std::string>{});
  }
}

TEST(HostCheck, ParallelHostOnePicosecondBelowALimit_TheItemIsReported) {
  const std::array<ParallelCase, 10> cases{{
      {"I001", "I101", [](auto& t) { t.ale_high = kBelow10; }},
      {"I002", "I102", [](auto& t) { t.ale_high = kBelow15; }},
      {"I004", "I104", [](auto& t) { t.ale_high = kBelow10; }},
      {"I003", "I103", [](auto& t) { t.address_hold = t.ale_to_strobe = kBelow15; }},
      {"I005", "I105", [](auto& t) { t.address_hold = t.ale_to_strobe = kBelow10; }},
      {"I011", "I107", [](auto& t) { t.address_hold = t.ale_to_strobe = kBelow10; }},
      {"I014", "I112", [](auto& t) { t.write_strobe = kBelow15; }},
      {"I013", "I109", [](auto& t) { t.write_strobe = kBelow10; }},
      {"I007", "I109", [](auto& t) { t.read_strobe = kBelow10; }},
      {"I015", "I113", [](auto& t) { t.data_hold = kBelow15; }},
  }};
  for (const ParallelCase& one : cases) {
    EXPECT_TRUE(parallel_items(ParallelMode::kIntel, one.change).contains(one.intel)) << one.intel;
    EXPECT_TRUE(parallel_items(ParallelMode::kMotorola, one.change).contains(one.motorola))
        << one.motorola;
  }
  const auto short_hold = [](auto& t) { t.hold = t.data_hold = t.release = kBelow10; };
  for (const char* item : {"I006", "I010", "I012", "I016"}) {
    EXPECT_TRUE(parallel_items(ParallelMode::kIntel, short_hold).contains(item)) << item;
  }
  for (const char* item : {"I106", "I108", "I114"}) {
    EXPECT_TRUE(parallel_items(ParallelMode::kMotorola, short_hold).contains(item)) << item;
  }
}

std::set<std::string> spi_items(const std::function<void(SpiTiming&)>& change,
                                const SpiPins& wires) {
  WatchedPins pins;
  pins.set_pin(Pin::kDb4, true);
  pins.set_pin(Pin::kNwrE, false);  // SPI2 is there
  pins.run_until(2 * kPsPerUs);
  SpiTiming timing = SpiTiming::for_frequency(50'000'000);
  if (change) change(timing);
  SpiHost host(pins, timing, wires);
  const std::array<std::uint8_t, 4> tx{mb4::regs::kSpiOpcodeReadRegisters, 0xA5, 0x5A, 0xFF};
  for (unsigned i = 0; i < 3; ++i) host.transfer(tx, {});
  return pins.items();
}

TEST(HostCheck, SpiHosts_AtAndBelowTheLimits) {
  for (const SpiPins& wires : {kSpiPins, kSpi2Pins}) {
    EXPECT_EQ(spi_items(nullptr, wires), std::set<std::string>{});
    const auto one = [&](const char* item, const std::function<void(SpiTiming&)>& change) {
      EXPECT_TRUE(spi_items(change, wires).contains(item)) << item;
    };
    one("I201", [](auto& t) { t.ncs_setup = t.sclk_low = kBelow10; });
    one("I202", [](auto& t) { t.ncs_hold = kBelow10; });
    one("I203", [](auto& t) { t.sclk_low = kBelow10; });
    one("I204", [](auto& t) { t.sclk_high = kBelow10; });
    one("I204", [](auto& t) { t.sclk_high_address = 99'999; });
    one("I205", [](auto& t) { t.sclk_low = 7'499; });
    one("I209", [](auto& t) { t.ncs_high = kBelow10; });
  }
}

TEST(HostCheck, MosiChangesWhileSclkIsHigh_HoldTimeIsReported) {
  WatchedPins pins;
  for (const Time hold : {7'500U, 7'499U}) {
    pins.set_pin(Pin::kNcs, false);
    pins.run_until(pins.now() + 20'000);
    pins.set_pin(Pin::kAle, true);
    pins.run_until(pins.now() + hold);
    pins.set_pin(Pin::kDb0, hold == 7'500);
    pins.run_until(pins.now() + 20'000);
    pins.set_pin(Pin::kAle, false);
    pins.run_until(pins.now() + 20'000);
    pins.set_pin(Pin::kNcs, true);
    pins.run_until(pins.now() + 20'000);
    EXPECT_EQ(pins.check.count(), hold == 7'500 ? 0U : 1U);
  }
  EXPECT_EQ(
      pins.check.violations().front().text,
      "I206: MOSI stable after SCLK has risen for 7.499 ns at 1114.999 ns, at least 7.500 ns");
}

// Short pulses on wires of an interface that is not selected, or in a reset, have no effect.
TEST(HostCheck, NotSelectedOrInReset_NothingIsReported) {
  WatchedPins pins;
  for (unsigned i = 0; i < 10; ++i) {
    pins.set_pin(Pin::kAle, i % 2 == 0);
    pins.run_until(pins.now() + 1'000);
  }
  pins.set_pin(Pin::kNres, false);
  pins.set_pin(Pin::kNcs, false);
  for (unsigned i = 0; i < 10; ++i) {
    pins.set_pin(Pin::kAle, i % 2 == 0);
    pins.run_until(pins.now() + 1'000);
  }
  EXPECT_EQ(pins.check.count(), 0U);
}

}  // namespace
}  // namespace mb4test
