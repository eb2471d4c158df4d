// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The host inverts SWBANK in the middle of a frame, at every phase (page 33, Table 49; decision
// 34). Bytes, SVALID and nSCDERR must be those that the reference predicts for a switch at one bit
// of the frame. When the inversion comes later, that bit comes later too.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "tests/reference/reference.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

constexpr std::uint64_t kWords[] = {0x0AAAAAA, 0x155};

struct Split {
  unsigned slaves = 1;  // of 26 bits, and one of 10 bits
  bool nocrc = false;
  bool singlebank = false;
  bool valid = false;  // both banks hold good words
  unsigned apart = 0;  // clocks to a second inversion; 0: none
};

mb4test::Registers registers(const Split& split) {
  mb4test::Registers result;
  const std::uint8_t bytes[] = {0x59, 0x06, 0x00, 0x00, 0x49, 0x05, 0x00, 0x00};
  for (unsigned i = 0; i < 4 * split.slaves; ++i) result.slave[i] = bytes[i];
  result.nocrc = split.nocrc;
  result.singlebank = split.singlebank;
  return result;
}

std::string scenario(const Split& split) {
  std::string text = "[host]\nsclk_hz = 20_000_000\n[[channel]]\nnumber = 1\n";
  text +=
      "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 26\ncrc = 0x43\ndata = 0x0AAAAAA\n";
  if (split.slaves == 2) {
    text += "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 10\ncrc = 0x25\ndata = 0x155\n";
  }
  return text;
}

// CDS and both words, after the start bit.
std::string line_bits(const Split& split) {
  std::string bits(1, '0');
  bits += mb4test::word_on_line(kWords[0], 26, {6, 0x43}, 0);
  if (split.slaves == 2) bits += mb4test::word_on_line(kWords[1], 10, {5, 0x25}, 0);
  return bits;
}

// What the host can read.
struct Seen {
  std::vector<std::uint8_t> data;
  std::uint8_t svalid = 0;
  bool scd_error = false;
  unsigned gap = 0;  // clocks between the inversions
  bool operator==(const Seen& other) const {
    return data == other.data && svalid == other.svalid && scd_error == other.scd_error;
  }
};

Seen predicted(const Split& split, const std::vector<unsigned>& swaps) {
  mb4test::Reference reference;
  const auto config = registers(split);
  mb4test::Lines lines;
  lines.bits[0] = line_bits(split);
  if (split.valid) {
    reference.frame(config, lines);
    reference.frame(config, lines);
  }
  for (unsigned address = 0; address < 8 * split.slaves; ++address) {
    reference.write(address, static_cast<std::uint8_t>(0x11 + address));
  }
  reference.swap_banks();
  for (unsigned address = 0; address < 8 * split.slaves; ++address) {
    reference.write(address, static_cast<std::uint8_t>(0x91 + address));
  }
  lines.swaps = swaps;
  reference.frame(config, lines);
  Seen seen{{}, reference.svalid_lo(), reference.scd_error(), 0};
  for (unsigned address = 0; address < 8 * split.slaves; ++address) {
    seen.data.push_back(reference.scdata(address));
  }
  // The other bank as well.
  reference.swap_banks();
  seen.svalid = static_cast<std::uint8_t>(seen.svalid << 4U | reference.svalid_lo());
  for (unsigned address = 0; address < 8 * split.slaves; ++address) {
    seen.data.push_back(reference.scdata(address));
  }
  return seen;
}

Seen measured(const Split& split, unsigned clocks) {
  Chip chip(scenario(split));
  const auto config = registers(split);
  chip.write(reg::slave_cfg_address(1),
             {config.slave[0], config.slave[1], 0, 0, config.slave[4], config.slave[5], 0, 0});
  const unsigned bank = (split.nocrc ? 2 : 0) | (split.singlebank ? 1 : 0);
  chip.write(reg::kAddrCtrl, {reg::kRegversBissC, reg::FREQR::of(5) | reg::FREQS::of(4),
                              static_cast<std::uint8_t>(bank), reg::kFreqagsAgsMin});
  chip.write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5, reg::kCfgch2Unused | reg::kCfgch1BissC});
  chip.advance_us(10);
  unsigned f4 = 0;
  const auto instruct = [&](unsigned bits) { chip.instruct(static_cast<std::uint8_t>(f4 | bits)); };
  const auto frame = [&] {
    instruct(reg::kInstrCdm0);
    EXPECT_TRUE(chip.wait_eot());
    chip.advance_us(30);
  };
  const auto fill = [&](unsigned first) {
    std::vector<std::uint8_t> tx{reg::kSpiOpcodeWriteRegisters, reg::kAddrScdata};
    for (unsigned i = 0; i < 8 * split.slaves; ++i)
      tx.push_back(static_cast<std::uint8_t>(first + i));
    chip.spi(tx);
    chip.advance_us(1);
  };
  if (split.valid) {
    frame();
    frame();
  }
  fill(0x11);
  f4 ^= 0x20;
  instruct(0);
  chip.advance_us(1);
  fill(0x91);
  instruct(reg::kInstrCdm0);
  chip.simulator.advance(clocks * 50 * sim::kPsPerNs);
  f4 ^= 0x20;
  instruct(0);  // INSTR = 000: the frame runs on
  const auto inverted = chip.simulator.now();
  if (split.apart != 0) {
    chip.simulator.advance(split.apart * 50 * sim::kPsPerNs);
    f4 ^= 0x20;
    instruct(0);
  }
  Seen seen;
  seen.gap = static_cast<unsigned>((chip.simulator.now() - inverted) / (50 * sim::kPsPerNs));
  EXPECT_TRUE(chip.wait_eot());
  const auto look = [&] {
    const auto data = chip.read(reg::kAddrScdata, 8 * split.slaves);
    seen.data.insert(seen.data.end(), data.begin(), data.end());
    seen.svalid = static_cast<std::uint8_t>(seen.svalid << 4U | chip.read(reg::kAddrSvalidLo));
  };
  look();
  seen.scd_error = (chip.status() & reg::nSCDERR::kMask) == 0;
  f4 ^= 0x20;
  instruct(0);
  chip.advance_us(1);
  look();
  return seen;
}

void sweep(const Split& split) {
  const int bits = static_cast<int>(line_bits(split).size());
  const auto place = [&](int position) {
    return static_cast<unsigned>(std::clamp(position, 0, bits));
  };
  // Half a microsecond, 10 clocks, a bit at FREQS = 4. CDS comes at bit 0; acknowledge, start bit
  // and the way of two instructions to the core lie before it.
  int at = -16;       // position that the last phase showed
  unsigned hits = 0;  // positions that differ and were seen
  for (unsigned clocks = 0; clocks < static_cast<unsigned>(bits + 14) * 10; ++clocks) {
    const Seen seen = measured(split, clocks);
    const int gap = static_cast<int>(seen.gap / 10);
    std::optional<int> found;
    for (int first = at; first <= bits && !found; ++first) {
      if (split.apart == 0) {
        if (seen == predicted(split, {place(first)})) found = first;
        continue;
      }
      for (const int second : {first + gap, first + gap + 1}) {
        if (seen == predicted(split, {place(first), place(second)})) found = first;
      }
    }
    ASSERT_TRUE(found) << testing::PrintToString(seen.data) << " SVALID " << +seen.svalid
                       << " error " << seen.scd_error << ", inversion " << clocks
                       << " clocks behind the instruction, from bit " << at;
    hits += *found != at ? 1U : 0U;
    at = *found;
  }
  EXPECT_GE(hits, split.slaves * 4) << "the sweep saw too few places of the frame";
}

TEST(ChipBankSplit, EveryPhase_BytesValidityAndErrorAsPredicted) { sweep({}); }

TEST(ChipBankSplit, BothBanksValid_NeitherIsBehind) { sweep({.valid = true}); }

TEST(ChipBankSplit, TwoWords_OnlyTheOneThatIsSplitIsInvalid) {
  sweep({.slaves = 2, .valid = true});
}

TEST(ChipBankSplit, NoCrcStored_TheCrcStillBelongsToTheWord) { sweep({.nocrc = true}); }

TEST(ChipBankSplit, OneBank_TheMemoryChangesAllTheSame) { sweep({.singlebank = true}); }

TEST(ChipBankSplit, InvertedTwiceInAWord_NotValidInEither) {
  sweep({.valid = true, .apart = 4});
  sweep({.slaves = 2, .valid = true, .apart = 44});
}

}  // namespace
