// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A smaller core beside the full chip, with the same host and the same encoder on line 1: as long
// as the host uses what both have, all pins are the same at every time, and so are all registers
// but the byte of the features. MB4_LOCKSTEP_CASES is the number of random sessions (default 12),
// MB4_SEED the first seed.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "tests/chip/features/core.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/pin_changes.hpp"
#include "tests/support/random_case.hpp"

namespace {

using mb4test::advance;
using mb4test::Core;
using mb4test::Random;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

// An encoder of a random length, with a CRC that every core has.
struct Encoder {
  explicit Encoder(Random& random) : bits(1 + random.below(64)) {
    constexpr std::uint8_t kCodes[] = {reg::kScrclenNone, reg::kScrclenCrc6, reg::kScrclenCrc16};
    constexpr const char* kPolynomials[] = {"0", "0x43", "0x190D9"};
    const unsigned choice = random.below(3);
    code = kCodes[choice];
    polynomial = kPolynomials[choice];
  }
  std::string scenario(const char* features, unsigned f_clk_hz) const {
    return std::string("[chip]\nf_clk_hz = ") + std::to_string(f_clk_hz) + "\nfeatures = \"" +
           features +
           "\"\n[host]\ninterface = \"intel\"\n[[channel]]\nnumber = 1\ndelay_ns = 120.0\n" +
           "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = " + std::to_string(bits) +
           "\ncrc = " + polynomial +
           "\nsource = \"ramp\"\nstep = 977\ntimeout = \"adaptive\"\nregisters = { 0x20 = [0x12, "
           "0x34, 0x56] }\n";
  }

  unsigned bits;
  std::uint8_t code;
  std::string polynomial;
};

class Pair {
 public:
  Pair(const Encoder& encoder, const char* features, unsigned f_clk_hz)
      : full_(sim::parse_scenario(encoder.scenario("full", f_clk_hz), "full")),
        core_(sim::parse_scenario(encoder.scenario(features, f_clk_hz), features)) {
    pass(10 * sim::kPsPerUs);
  }
  template <typename Action>
  void both(const Action& action) {
    action(full_);
    action(core_);
  }
  void write(unsigned address, unsigned value) {
    both([&](sim::Simulator& chip) {
      chip.bus().write(static_cast<std::uint8_t>(address), static_cast<std::uint8_t>(value));
    });
    pass(600 * sim::kPsPerNs);
  }
  void pass(sim::Time duration) { ASSERT_EQ(advance(full_, duration), advance(core_, duration)); }
  void compare() {
    for (unsigned address = 0; address < 256; ++address) {
      if (address == 0x7F) continue;
      const auto byte = static_cast<std::uint8_t>(address);
      ASSERT_EQ(full_.bus().read(byte), core_.bus().read(byte)) << "0x" << std::hex << address;
    }
    ASSERT_EQ(full_.slave(1)->frames(), core_.slave(1)->frames());
  }
  std::uint64_t frames() const { return core_.slave(1)->frames(); }

 private:
  sim::Simulator full_;
  sim::Simulator core_;
};

void configure(Pair& chips, const Encoder& encoder, Random& random) {
  chips.write(reg::slave_cfg_address(1), reg::kEnscdYes | (encoder.bits - 1));
  chips.write(reg::slave_cfg_address(1) + 1, encoder.code);
  chips.write(reg::kAddrFreq, random.below(8));
  chips.write(reg::kAddrCtrl, reg::kRegversBissC | (random.one_in(2) ? reg::kHoldcdmHold : 0U));
  chips.write(reg::kAddrSlaveloc5,
              reg::kResetSlaveloc5 | (random.one_in(2) ? reg::kSlaveloc5Split : 0U));
  chips.write(reg::kAddrCfgch, reg::kCfgch2Unused | reg::kCfgch1BissC);
  chips.write(reg::kAddrFreqags, random.one_in(2) ? reg::kFreqagsAgsMin : 20 + random.below(80));
}

// INSTR without what only some cores have.
unsigned instruction(Random& random, const Core& core) {
  constexpr unsigned kCodes[] = {0, reg::kInstrCdm0, reg::kInstrCdm1, reg::kInstrCdmNotCdssel};
  unsigned byte = kCodes[random.below(4)] | (random.one_in(2) ? reg::kAgsOn : 0U);
  if (core.control && random.one_in(4)) byte = reg::kInstrControl | reg::kAgsOn;
  if (random.one_in(6)) byte |= reg::kHoldbankPrevented;
  if (random.one_in(8)) byte |= reg::SWBANK::kMask;
  if (random.one_in(10)) byte = reg::kBreakAbort;
  if (random.one_in(10)) byte = reg::kInitStart;
  return byte;
}

void act(Pair& chips, const Encoder& encoder, Random& random, const Core& core) {
  const auto byte = [&] { return random.below(256); };
  switch (random.below(9)) {
    case 0:
    case 1:
    case 2:
      chips.write(reg::kAddrInstr, instruction(random, core));
      break;
    case 3:
      chips.write(reg::kAddrFreqags,
                  random.one_in(2) ? reg::kFreqagsAgsMin : 20 + random.below(80));
      break;
    case 4:
      for (const bool level : {true, false}) {
        chips.both([&](sim::Simulator& chip) { chip.set_pin(sim::Pin::kGetsens, level); });
        chips.pass((1 + random.below(400)) * 10 * sim::kPsPerNs);
      }
      break;
    case 5:
      chips.write(reg::scdata_address(1) + random.below(8), byte());
      if (random.one_in(4))
        chips.write(reg::kAddrSvalidLo, random.below(2) * reg::SVALID<1>::kMask);
      break;
    case 6:
      if (!core.control) break;
      chips.write(reg::kAddrRdata + random.below(64), byte());
      chips.write(reg::kAddrRegadr, (random.one_in(3) ? reg::WNR::kMask : 0U) | random.below(128));
      chips.write(reg::kAddrRegnum, random.below(4));
      chips.write(reg::kAddrCtrl, reg::kCtsRegisterAccess | reg::kRegversBissC);
      break;
    case 7:
      if (core.force) chips.write(reg::kAddrIface, random.one_in(3) ? random.below(4) << 4U : 0U);
      break;
    default:
      if (!random.one_in(4)) break;
      for (const bool level : {false, true}) {
        chips.both([&](sim::Simulator& chip) { chip.set_pin(sim::Pin::kNres, level); });
        chips.pass(sim::kPsPerUs);
      }
      configure(chips, encoder, random);  // the reset chooses BiSS B
      break;
  }
  constexpr sim::Time kLongest[] = {100, 3'000, 100'000, 2'000'000};
  chips.pass((1 + random.word() % kLongest[random.below(4)]) * sim::kPsPerNs);
}

class FeaturesLockstep : public testing::TestWithParam<Core> {};

TEST_P(FeaturesLockstep, WhatBothHave_IsTheSameAtEveryTime) {
  const Core& core = GetParam();
  const std::uint64_t cases = mb4test::number_from("MB4_LOCKSTEP_CASES", 12);
  const std::uint64_t first = mb4test::number_from("MB4_SEED", 1);
  std::uint64_t frames = 0;
  for (std::uint64_t seed = first; seed < first + cases; ++seed) {
    Random random(seed);
    const Encoder encoder(random);
    constexpr unsigned kClk[] = {1'000'000, 7'300'000, 20'000'000, 25'000'000};
    Pair chips(encoder, core.name, kClk[random.below(4)]);
    configure(chips, encoder, random);
    for (unsigned action = 0; action < 80 && !HasFatalFailure(); ++action) {
      act(chips, encoder, random, core);
      if (action % 8 == 7) chips.compare();
    }
    if (HasFatalFailure()) FAIL() << core.name << ", MB4_SEED=" << seed << " MB4_LOCKSTEP_CASES=1";
    frames += chips.frames();
  }
  EXPECT_GT(frames, 10 * cases);
}

INSTANTIATE_TEST_SUITE_P(Cores, FeaturesLockstep,
                         testing::ValuesIn(mb4test::built_cores([](const Core& core) {
                           return std::string(core.name) != "full" && core.banks == 2;
                         })),
                         mb4test::core_name);

}  // namespace
