// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Accesses of the host that follow each other faster than the core's clock: a byte read directly
// after its write (decision 36), and writes of 0xF4 close together (decision 41). The tests run
// with every host, every phase, and CLK from 10 to 25 MHz, slow, and stopped.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "tests/chip/host/fast_host.hpp"
#include "tests/support/random_case.hpp"

namespace {

using mb4test::FastHost;
using mb4test::kPhases;
using mb4test::Random;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

const std::string kSlave =
    "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 26\n"
    "crc = 0x43\ndata = 0x0AAAAAA\n";

class CloseAccess : public testing::TestWithParam<std::string> {};

TEST_P(CloseAccess, ReadBehindAWrite_GivesWhatWasWritten) {
  for (const double mhz : {10.0, 12.5, 16.0, 20.0, 25.0, 1.0, 0.1}) {
    FastHost host(GetParam(), mhz);
    const auto period = static_cast<sim::Time>(1e6 / mhz);
    host.chip().advance(200 * period);
    Random random(1);
    for (unsigned phase = 0; phase < kPhases; ++phase) {
      for (unsigned count = 1; count <= 4; ++count) {
        for (const unsigned first : {0x00U, 0x1EU, 0x3CU, 0x80U, 0xBCU}) {
          host.phase(period, phase);
          std::vector<std::uint8_t> bytes(count);
          for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random.below(256));
          host.write(static_cast<std::uint8_t>(first), bytes);
          // The same address once more: its last byte counts.
          bytes[0] = static_cast<std::uint8_t>(random.below(256));
          host.write(static_cast<std::uint8_t>(first), {bytes[0]});
          for (unsigned i = 0; i < count; ++i) {
            ASSERT_EQ(host.read(static_cast<std::uint8_t>(first + i)), bytes[i])
                << mhz << " MHz, phase " << phase << ", byte " << i << " of " << count;
          }
          for (unsigned i = 0; i < count; ++i) {
            ASSERT_EQ(host.read(static_cast<std::uint8_t>(first + i)), bytes[i]) << "later";
          }
        }
      }
    }
  }
}

// Decision 36: bytes in a row, then all of them read back. The parallel bus writes with cycles of
// 100 ns, from 20 MHz on with its shortest ones, and up to four bytes with these at any clock.
TEST_P(CloseAccess, ManyBytesWithClock_AllReadBack) {
  for (const double mhz : {10.0, 12.5, 16.0, 20.0, 25.0}) {
    for (const unsigned cycle_ns : {60U, 80U, 100U, 110U}) {
      if (GetParam() == "spi" && cycle_ns != 60) break;
      FastHost host(GetParam(), mhz, "cycle_ns = " + std::to_string(cycle_ns) + "\n");
      const auto period = static_cast<sim::Time>(1e6 / mhz);
      host.chip().advance(200 * period);
      const auto cycle = sim::ParallelTiming::for_cycle(cycle_ns * sim::kPsPerNs);
      if (GetParam() != "spi") host.chip().bus().set_timing(cycle);
      const bool few = GetParam() != "spi" && mhz < 20 && cycle_ns < 100;
      Random random(2);
      for (unsigned phase = 0; phase < kPhases; ++phase) {
        host.phase(period, phase);
        const unsigned count = few ? 4 : phase % 2 == 0 ? 40 : 5 + phase % 60;
        std::vector<std::uint8_t> bytes(count);
        for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random.below(256));
        const sim::Time start = host.chip().now();
        host.write(reg::kAddrRdata, bytes);
        if (GetParam() != "spi") {
          ASSERT_EQ(host.chip().now() - start, count * cycle_ns * sim::kPsPerNs);
        }
        for (unsigned i = 0; i < count; ++i) {
          ASSERT_EQ(host.read(reg::rdata_address(i + 1)), bytes[i])
              << mhz << " MHz, " << cycle_ns << " ns, phase " << phase << ", byte " << i << " of "
              << count;
        }
      }
    }
  }
}

// Pin CLK is open: the last four different addresses answer, older ones as the memory holds them.
TEST_P(CloseAccess, NoClock_TheLastFourAddressesAnswer) {
  FastHost host(GetParam(), 0);
  Random random(3);
  std::vector<std::uint8_t> order;  // newest first
  std::array<std::uint8_t, 256> value{};
  for (unsigned write = 0; write < 100; ++write) {
    const unsigned pick = random.below(6);
    const std::uint8_t address =
        static_cast<std::uint8_t>((pick & 1U) != 0 ? 0x80 + pick : pick * 9);
    value[address] = static_cast<std::uint8_t>(random.below(256));
    host.write(address, {value[address]});
    std::erase(order, address);
    order.insert(order.begin(), address);
    for (unsigned i = 0; i < std::min<std::size_t>(4, order.size()); ++i) {
      ASSERT_EQ(host.read(order[i]), value[order[i]]) << "write " << write << ", address " << i;
    }
  }
}

// The memory answers as soon as the core has taken the bytes. So the host sees a switched bank and
// the word of a frame, even while it goes on writing to other addresses.
TEST_P(CloseAccess, CoreHasTakenTheByte_TheMemoryAnswers) {
  for (const bool writes : {false, true}) {
    FastHost host(GetParam(), 20, kSlave);
    host.chip().advance(200 * 50'000);
    host.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 25, reg::kScrclenCrc6, 0x00, 0x00});
    host.write(reg::kAddrCtrl, {reg::kRegversBissC, reg::FREQR::of(5), 0, reg::kFreqagsAgsMin});
    host.write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5, reg::kCfgch2Unused | reg::kCfgch1BissC});
    for (unsigned phase = 0; phase < 100; ++phase) {
      host.chip().run_until((host.chip().now() / 50'000 + 200) * 50'000 + phase * 500);
      host.write(reg::kAddrScdata, {0x77, 0x66});
      host.write(reg::kAddrInstr, {reg::kInstrCdm0});
      const auto end = host.chip().now() + 20'000'000;
      while (host.chip().now() < end) {
        if (writes) {
          host.write(reg::rdata_address(9), {static_cast<std::uint8_t>(phase)});
        } else {
          host.chip().advance(100'000);
        }
        // The host reads the flag first, because it shows that the banks have switched.
        if (host.read(reg::kAddrSvalidLo) != reg::SVALID<1>::kMask) continue;
        ASSERT_EQ(host.read(reg::kAddrScdata), 0xAA) << phase;
        ASSERT_EQ(host.read(reg::SCDATA<1, 1>::kAddress), 0xAA) << phase;
      }
      ASSERT_EQ(host.read(reg::kAddrScdata), 0xAA) << phase;
      host.write(reg::kAddrSvalidLo, {0});
    }
  }
}

// Page 33, decision 41: a BREAK that is followed by another write at once ends the frame all the
// same, and the later byte counts.
TEST_P(CloseAccess, BreakBeforeAnotherWrite_IsDone) {
  for (const double mhz : {10.0, 12.5, 20.0, 25.0}) {
    const auto period = static_cast<sim::Time>(1e6 / mhz);
    for (unsigned phase = 0; phase < kPhases; ++phase) {
      for (unsigned more = 1; more <= 4; ++more) {
        // The line never answers: the frame runs until BREAK.
        FastHost host(GetParam(), mhz,
                      kSlave + "[[channel.event]]\nat_us = 50\naction = \"sl-high\"\n");
        host.chip().advance(100 * period);
        host.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 25, reg::kScrclenCrc6, 0x00, 0x00});
        host.write(reg::kAddrCtrl,
                   {reg::kRegversBissC, reg::FREQR::of(5) | reg::FREQS::of(1), 0, 0x31});
        host.write(reg::kAddrSlaveloc5,
                   {reg::kResetSlaveloc5, reg::kCfgch2Unused | reg::kCfgch1BissC});
        host.chip().run_until(60'000'000);
        host.write(reg::kAddrInstr, {reg::kInstrCdm0});
        host.chip().advance(20'000'000);
        ASSERT_EQ(host.read(reg::kAddrStatus0) & reg::EOT::kMask, 0);
        host.phase(period, phase);
        host.write(reg::kAddrInstr, {reg::kBreakAbort});
        for (unsigned i = 1; i < more; ++i) host.write(reg::kAddrInstr, {reg::kHoldbankPrevented});
        host.write(reg::kAddrInstr, {reg::SWBANK::kMask});
        host.chip().advance(10'000'000);
        ASSERT_EQ(host.read(reg::kAddrStatus0) & reg::EOT::kMask, reg::kEotIdle)
            << mhz << " MHz, phase " << phase << ", " << more;
        ASSERT_EQ(host.read(reg::kAddrInstr), reg::SWBANK::kMask)
            << mhz << " MHz, phase " << phase << ", " << more;
      }
    }
  }
}

// Tables 47, 56, decisions 25, 26: REGEND is 0 from the write of INSTR 100 or 111 on; the other
// codes leave it as it is, however soon the host reads.
TEST_P(CloseAccess, RegendBehindInstr_FallsForControlCommunicationOnly) {
  for (const double mhz : {20.0, 1.0}) {
    FastHost host(GetParam(), mhz);
    const auto period = static_cast<sim::Time>(1e6 / mhz);
    host.chip().advance(200 * period);
    host.write(reg::kAddrSlaveloc5,
               {reg::kResetSlaveloc5, reg::kCfgch2Unused | reg::kCfgch1Unused});
    for (unsigned phase = 0; phase < kPhases; ++phase) {
      for (unsigned instr = 0; instr < 8; ++instr) {
        // No line is in use: the instruction ends at once, with REGEND = 1 (decision 37).
        host.write(reg::kAddrInstr, {reg::kInstrControl});
        host.phase(period, phase);
        ASSERT_EQ(host.read(reg::kAddrStatus0) & reg::REGEND::kMask, reg::kRegendDone);
        host.write(reg::kAddrInstr, {static_cast<std::uint8_t>(instr << 1U)});
        const bool control = instr == 4 || instr == 7;
        if (control && mhz > 1.0) continue;  // it may have ended
        ASSERT_EQ(host.read(reg::kAddrStatus0) & reg::REGEND::kMask,
                  control ? 0U : reg::kRegendDone)
            << mhz << " MHz, phase " << phase << ", INSTR " << instr;
      }
    }
  }
}

// One to five writes of 0xF4 in a row: the last one is what the core holds in the end, and the
// host's bank has changed if SWBANK has.
void writes_in_a_row(FastHost& host, const std::function<void()>& before,
                     const std::function<void()>& settle) {
  host.write(reg::kAddrScdata, {0x11});
  settle();
  Random random(4);
  unsigned swbank = 0;
  bool marked = true;  // the host's bank holds 0x11 at 0x00, the other one 0
  for (unsigned round = 0; round < 4 * kPhases; ++round) {
    before();
    const unsigned count = 1 + random.below(5);
    unsigned last = 0;
    for (unsigned i = 0; i < count; ++i) {
      last = random.below(4) << 5U;
      host.write(reg::kAddrInstr, {static_cast<std::uint8_t>(last)});
    }
    ASSERT_EQ(host.read(reg::kAddrInstr), last) << "read back at once";
    settle();
    if ((last & 0x20U) != swbank) marked = !marked;
    swbank = last & 0x20U;
    ASSERT_EQ(host.read(reg::kAddrInstr), last) << "round " << round;
    ASSERT_EQ(host.read(reg::kAddrScdata), marked ? 0x11 : 0x00) << "round " << round;
  }
}

TEST_P(CloseAccess, WritesOf0xF4InARow_TheLastOneCounts) {
  for (const double mhz : {10.0, 12.5, 20.0, 25.0}) {
    SCOPED_TRACE(mhz);
    FastHost host(GetParam(), mhz);
    const auto period = static_cast<sim::Time>(1e6 / mhz);
    host.chip().advance(200 * period);
    unsigned phase = 0;
    writes_in_a_row(
        host, [&] { host.phase(period, phase++ % kPhases); },
        [&] { host.chip().advance(20 * period); });
  }
}

TEST_P(CloseAccess, WritesOf0xF4WithAStoppedClock_TheLastOneCountsWhenItRuns) {
  FastHost host(GetParam(), 0);
  const auto clocks = [&](unsigned count) {
    for (unsigned i = 0; i < 2 * count; ++i) {
      host.chip().set_pin(sim::Pin::kClk, i % 2 == 0);
      host.chip().advance(25'000);
    }
  };
  clocks(200);
  writes_in_a_row(
      host, [] {}, [&] { clocks(20); });
}

INSTANTIATE_TEST_SUITE_P(Hosts, CloseAccess, testing::Values("spi", "intel", "motorola"),
                         [](const auto& host) { return host.param; });

}  // namespace
