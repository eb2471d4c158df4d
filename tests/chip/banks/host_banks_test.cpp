// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Accesses of the host that follow each other faster than the core's clock: bytes and SVALID before
// and after SWBANK or HOLDBANK, words read after these, CDS, and words after bytes of the host
// (pages 26, 33, 35; decisions 14, 15, 18, 36, 41). Every host, every phase, CLK from 10 to 25 MHz
// and slow.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/chip/host/fast_host.hpp"
#include "tests/support/random_case.hpp"

namespace {

using mb4test::FastHost;
using mb4test::kPhases;
using mb4test::Random;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

constexpr std::uint8_t kHold = reg::kHoldbankPrevented;
constexpr std::uint8_t kSwap = reg::SWBANK::kMask;
constexpr double kClocks[] = {10.0, 12.5, 20.0, 25.0, 1.0};

class HostBanks : public testing::TestWithParam<std::string> {};

// A sensor of 64 bits whose word is eight bytes of the number of its frame.
class Frames : public FastHost {
 public:
  Frames(const std::string& interface, double mhz)
      : FastHost(interface, mhz,
                 "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\n"
                 "data_bits = 64\nflag_bits = 0\ncrc = 0\nsource = \"ramp\"\nstart = 0\n"
                 "step = 0x0101010101010101\n"),
        period(static_cast<sim::Time>(1e6 / mhz)) {
    settle();
    settle();
    write(reg::slave_cfg_address(1), {reg::kEnscdYes | 63, 0, 0x00, 0x00});
    write(reg::kAddrCtrl, {reg::kRegversBissC, reg::FREQR::of(5), 0, reg::kFreqagsAgsMin});
    write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5, reg::kCfgch2Unused | reg::kCfgch1BissC});
    settle();
  }
  void settle() { chip().advance(100 * period); }
  // Runs one frame, with these other bits of 0xF4, and waits until its slave is idle.
  void frame(std::uint8_t bits = 0) {
    start(bits);
    EXPECT_TRUE(ends());
    chip().advance(30'000'000);
  }
  // Waits for pin EOT = 1.
  bool ends() {
    return chip().run_while_waiting([&] { return chip().pin(sim::Pin::kEot); },
                                    chip().now() + 5000 * period);
  }
  void start(std::uint8_t bits) {
    write(reg::kAddrInstr, {static_cast<std::uint8_t>(bits | reg::kInstrCdm0)});
    chip().advance(8 * period);
  }
  // Starts a frame and runs up to `step`, 0 to 399, of its end: 64 bits, acknowledge, start bit and
  // CDS take two clocks a bit, and the frame ends in the 50 clocks of these steps.
  void run_near_end(std::uint8_t bits, unsigned step) {
    chip().run_until((chip().now() / period + 20) * period);
    start(bits);
    chip().advance(110 * period + step * period / 8);
  }
  // Returns the number of the frame whose word the host reads, from 1 on. A torn word gives a huge
  // number.
  std::uint64_t word() {
    std::uint64_t value = 0;
    for (unsigned i = 0; i < 8; ++i) {
      value |= std::uint64_t{read(static_cast<std::uint8_t>(i))} << (8 * i);
    }
    return 1 - value * 0xFF;
  }
  std::uint64_t frames() { return chip().slave(1)->frames(); }

  sim::Time period;
};

// Bytes and inversions of SWBANK in any order: each byte is in the bank that the host had when it
// wrote the byte, as the order of the writes tells it.
TEST_P(HostBanks, BytesBeforeAndBehindSwbank_AreInTheBankOfTheirWrite) {
  for (const double mhz : kClocks) {
    FastHost host(GetParam(), mhz);
    const auto period = static_cast<sim::Time>(1e6 / mhz);
    host.chip().advance(200 * period);
    Random random(5);
    std::array<std::array<std::uint8_t, 64>, 2> bank{};
    unsigned own = 0;
    const auto invert = [&] {
      own ^= 1U;
      host.write(reg::kAddrInstr, {own != 0 ? kSwap : std::uint8_t{0}});
    };
    for (unsigned phase = 0; phase < kPhases; ++phase) {
      host.phase(period, phase);
      for (unsigned access = 1 + random.below(10); access-- > 0;) {
        if (random.one_in(3)) {
          invert();
          continue;
        }
        std::vector<std::uint8_t> bytes(1 + random.below(8));
        const unsigned first = random.below(64 - static_cast<unsigned>(bytes.size()));
        for (unsigned i = 0; i < bytes.size(); ++i) {
          bank[own][first + i] = bytes[i] = static_cast<std::uint8_t>(random.below(256));
        }
        host.write(static_cast<std::uint8_t>(first), bytes);
      }
      for (unsigned side = 0; side < 2; ++side) {
        host.chip().advance(200 * period);
        for (unsigned i = 0; i < 64; ++i) {
          ASSERT_EQ(host.read(static_cast<std::uint8_t>(i)), bank[own][i])
              << mhz << " MHz, phase " << phase << ", byte " << i << ", side " << side;
        }
        invert();
      }
    }
  }
}

// The same with the release of HOLDBANK that switches to the word of a frame.
TEST_P(HostBanks, BytesBeforeAndBehindTheRelease_AreInTheBankOfTheirWrite) {
  for (const double mhz : kClocks) {
    Frames host(GetParam(), mhz);
    for (unsigned phase = 0; phase < kPhases; ++phase) {
      const auto mark = static_cast<std::uint8_t>(phase + 1);
      const std::string where = std::to_string(mhz) + " MHz, phase " + std::to_string(phase);
      host.write(reg::kAddrInstr, {kHold});
      host.settle();
      host.frame(kHold);
      host.phase(host.period, phase);
      host.write(0x20, {mark, mark, mark, mark});
      host.write(reg::kAddrInstr, {0});
      host.write(0x28, {mark, mark});
      host.settle();
      ASSERT_EQ(host.word(), host.frames()) << where;
      ASSERT_NE(host.read(0x20), mark) << where;
      ASSERT_NE(host.read(0x23), mark) << where;
      ASSERT_EQ(host.read(0x28), mark) << where;
      ASSERT_EQ(host.read(0x29), mark) << where;
      host.write(reg::kAddrInstr, {kSwap});
      host.settle();
      ASSERT_EQ(host.read(0x20), mark) << where;
      ASSERT_EQ(host.read(0x23), mark) << where;
      ASSERT_NE(host.read(0x28), mark) << where;
      host.write(reg::kAddrInstr, {0});
      host.settle();
    }
  }
}

// Decision 18: a 0 written to SVALID acts on the host's bank, as the order of the writes tells it.
TEST_P(HostBanks, SvalidBeforeAndBehindSwbank_IsClearedInTheBankOfTheWrite) {
  for (const double mhz : kClocks) {
    Frames host(GetParam(), mhz);
    for (unsigned phase = 0; phase < kPhases; ++phase) {
      for (const bool before : {true, false}) {
        host.frame();
        host.frame();
        host.phase(host.period, phase);
        if (before) host.write(reg::kAddrSvalidLo, {0, 0});
        host.write(reg::kAddrInstr, {kSwap});
        if (!before) host.write(reg::kAddrSvalidLo, {0, 0});
        host.settle();
        ASSERT_EQ(host.read(reg::kAddrSvalidLo), before ? reg::SVALID<1>::kMask : 0U)
            << mhz << " MHz, phase " << phase;
        host.write(reg::kAddrInstr, {0});
        host.settle();
        ASSERT_EQ(host.read(reg::kAddrSvalidLo), before ? 0U : reg::SVALID<1>::kMask)
            << mhz << " MHz, phase " << phase;
      }
    }
  }
}

// Decision 36: a byte of the host that the core has taken does not hide the word of a frame, while
// later bytes of the host wait.
TEST_P(HostBanks, WordBehindBytesOfTheHost_IsNotHidden) {
  for (const double mhz : kClocks) {
    Frames host(GetParam(), mhz);
    for (unsigned phase = 0; phase < kPhases; ++phase) {
      for (const unsigned count : {1U, 2U, 4U}) {
        for (const std::uint8_t later : {reg::kAddrSvalidHi, reg::rdata_address(9)}) {
          host.write(reg::kAddrScdata, std::vector<std::uint8_t>(count, 0x77));
          host.frame();
          host.phase(host.period, phase);
          host.write(later, {0});
          if (phase % 2 != 0) host.write(later, {0});
          ASSERT_EQ(host.word(), host.frames())
              << mhz << " MHz, phase " << phase << ", " << count << " bytes";
        }
      }
    }
  }
}

// The same with a byte that begins a long row of writes: the core has taken it before the word
// comes, and later ones wait all the time. With one bank the frame writes where the host does.
TEST_P(HostBanks, WordAfterTheFirstOfManyBytes_IsNotHidden) {
  constexpr unsigned kWrites = 120;
  Frames host(GetParam(), 1.0);
  auto& chip = host.chip();
  host.write(reg::SINGLEBANK::kAddress, {reg::kSinglebankOneBank});
  host.start(0);
  const sim::Time before = chip.now();
  ASSERT_TRUE(host.ends());
  const sim::Time length = chip.now() - before;
  for (unsigned step = 0; step < 8; ++step) {
    host.settle();
    host.start(0);
    // The core takes one byte in each clock, the host writes faster. The byte is there before that
    // of the word, which comes at the end of the frame.
    chip.advance(length - (kWrites - 20 - 4 * step) * host.period);
    const sim::Time first = chip.now();
    host.write(reg::kAddrScdata, {0x77});
    for (unsigned i = 0; i < kWrites; ++i) host.write(reg::rdata_address(9 + i % 2), {0});
    ASSERT_TRUE(host.ends());
    ASSERT_LT(chip.now() - first, kWrites * host.period) << "no byte waits, step " << step;
    ASSERT_EQ(host.read(reg::kAddrScdata), host.frames() - 1) << step;
  }
}

// Decision 41: two writes without HOLDBANK, at any time around the end of a frame. HOLDBANK = 1
// after the frame then keeps its word.
TEST_P(HostBanks, HoldBankAfterTwoWritesAtTheEndOfAFrame_KeepsItsWord) {
  for (const double mhz : {1.0, 10.0}) {
    Frames host(GetParam(), mhz);
    auto& chip = host.chip();
    for (unsigned step = 0; step < 400; ++step) {
      host.write(reg::kAddrInstr, {0});
      host.settle();
      host.run_near_end(0, step);
      host.write(reg::kAddrInstr, {0});
      host.write(reg::kAddrInstr, {0});
      ASSERT_TRUE(host.ends());
      host.write(reg::kAddrInstr, {kHold});
      chip.advance(30'000'000);
      host.settle();
      ASSERT_EQ(host.word(), host.frames()) << mhz << " MHz, step " << step;
    }
  }
}

// Decision 41: the host writes HOLDBANK 1, 0, 1 after a frame, as fast as it can. The switch that
// HOLDBANK held back is done, and from then on the host reads one word. Around the end of the frame
// this is the old or the new word.
TEST_P(HostBanks, ReleasedAndSetAgain_TheSwitchIsDone) {
  for (const double mhz : kClocks) {
    Frames host(GetParam(), mhz);
    auto& chip = host.chip();
    host.write(reg::kAddrInstr, {kHold});
    host.settle();
    host.frame(kHold);
    host.write(reg::kAddrInstr, {0});
    host.settle();
    unsigned older = 0;
    unsigned newer = 0;
    for (unsigned step = 0; step < 400; ++step) {
      const std::string where = std::to_string(mhz) + " MHz, step " + std::to_string(step);
      host.write(reg::kAddrInstr, {kHold});
      host.settle();
      host.run_near_end(kHold, step);
      host.write(reg::kAddrInstr, {0});
      const bool ended = chip.pin(sim::Pin::kEot);
      host.write(reg::kAddrInstr, {kHold});
      const auto first = host.word();
      const auto again = host.word();
      host.settle();
      ASSERT_EQ(first, again) << where;
      ASSERT_EQ(host.word(), first) << where;
      ASSERT_LE(first, host.frames()) << where;
      ASSERT_GE(first, host.frames() - 1) << where;
      if (ended) {
        ASSERT_EQ(first, host.frames()) << where;
      }
      ++(first == host.frames() ? newer : older);
      ASSERT_EQ(host.read(reg::kAddrSwbankfail), 0) << where;
      host.write(reg::kAddrInstr, {0});
      host.settle();
      ASSERT_EQ(host.word(), host.frames()) << where;
    }
    std::printf("%s, %g MHz: %u older, %u newer\n", GetParam().c_str(), mhz, older, newer);
    EXPECT_GT(older, 10U);
    EXPECT_GT(newer, 10U);
  }
}

// Page 35: CDS, CDSSEL and SVALID are kept with the word, from the write of HOLDBANK on.
TEST_P(HostBanks, CdsBehindHoldbank_IsThatOfTheWord) {
  for (const double mhz : kClocks) {
    Frames host(GetParam(), mhz);
    auto& chip = host.chip();
    host.frame();
    host.frame();
    unsigned older = 0;
    unsigned newer = 0;
    bool cds = false;  // of the next frame
    for (unsigned step = 0; step < 400; ++step) {
      const std::string where = std::to_string(mhz) + " MHz, step " + std::to_string(step);
      chip.run_until((chip.now() / host.period + 20) * host.period);
      cds = !cds;
      if (cds) clocked(chip.line(1))->faults().flip_next_frame({1});
      host.start(0);
      chip.advance(110 * host.period + step * host.period / 8);
      host.write(reg::kAddrInstr, {kHold});
      const auto status8 = host.read(reg::kAddrStatus8);
      const auto status3 = host.read(reg::kAddrStatus3);
      const auto word = host.word();
      const bool seen = word == host.frames() ? cds : !cds;
      ASSERT_GE(word, host.frames() - 1) << where;
      ASSERT_EQ((status8 & reg::CDS1::kMask) != 0, seen) << where;
      ASSERT_EQ((status3 & reg::CDSSEL::kMask) != 0, seen) << where;
      host.settle();
      ASSERT_EQ(host.read(reg::kAddrStatus8) & reg::CDS1::kMask, status8 & reg::CDS1::kMask)
          << where;
      ASSERT_EQ(host.word(), word) << where;
      ++(word == host.frames() ? newer : older);
      host.write(reg::kAddrInstr, {0});
      host.settle();
      ASSERT_EQ(host.word(), host.frames()) << where;
      ASSERT_EQ((host.read(reg::kAddrStatus8) & reg::CDS1::kMask) != 0, cds) << where;
    }
    std::printf("%s, %g MHz: %u older, %u newer\n", GetParam().c_str(), mhz, older, newer);
    EXPECT_GT(older, 10U);
    EXPECT_GT(newer, 10U);
  }
}

// A byte that the core has not taken yet belongs to the bank that the host had at the write. The
// host reads its own bank at once, also after SWBANK (decision 36). The clock is slow, so all
// accesses come before the core takes a byte.
TEST_P(HostBanks, ReadBehindSwbank_IsOfTheBankThatTheHostHas) {
  FastHost host(GetParam(), 1.0);
  host.chip().advance(200'000'000);
  for (unsigned phase = 0; phase < 40; ++phase) {
    host.chip().advance(200'000'000 + phase * 25'000);
    const auto a = static_cast<std::uint8_t>(0x10 + phase);
    const auto b = static_cast<std::uint8_t>(0x80 + phase);
    host.write(0x00, {a});
    host.write(reg::kAddrInstr, {kSwap});
    if (phase != 0) {
      EXPECT_EQ(host.read(0x00), static_cast<std::uint8_t>(0x7F + phase)) << phase;
    }
    host.write(0x00, {b});
    EXPECT_EQ(host.read(0x00), b) << phase;
    host.write(reg::kAddrInstr, {0});
    EXPECT_EQ(host.read(0x00), a) << phase;
  }
}

// Pin EOT tells that the word is there. A write of 0xF4 without HOLDBANK shortly before does not
// keep the host on the old bank.
TEST_P(HostBanks, WordAtPinEotBehindAWrite_IsTheNewOne) {
  for (const double mhz : kClocks) {
    Frames host(GetParam(), mhz);
    // Time from the start of a frame to the rise of the pin.
    host.start(0);
    const sim::Time began = host.chip().now();
    const auto at_end = [&] { return host.chip().pin(sim::Pin::kEot); };
    ASSERT_TRUE(host.chip().run_while_waiting(at_end, began + 5000 * host.period));
    const sim::Time length = host.chip().now() - began;
    host.chip().advance(30'000'000);
    for (sim::Time before = 0; before < 12 * host.period; before += host.period / 4) {
      host.start(0);
      host.chip().advance(length - before - host.period);
      host.write(reg::kAddrInstr, {0});
      ASSERT_TRUE(host.chip().run_while_waiting(at_end, host.chip().now() + 5000 * host.period));
      EXPECT_EQ(host.word(), host.frames()) << mhz << " MHz, " << before << " ps before";
      host.chip().advance(30'000'000);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Hosts, HostBanks, testing::Values("spi", "intel", "motorola"),
                         [](const auto& host) { return host.param; });

}  // namespace
