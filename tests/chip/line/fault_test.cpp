// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Line faults in random configurations: which words does the chip call valid (pages 24, 25, 35,
// Tables 13..16, 61)? A word with a fault may only be valid if the pattern of inverted bits is a
// multiple of the CRC polynomial; so single bits, bursts up to the CRC's width and pairs closer
// than the polynomial's period are always found. MB4_FAULT_FRAMES sets the number of frames
// (default 20,000; nightly 1,000,000 in four parts), MB4_SEED the first seed.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <sstream>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::CrcChoice;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

enum Kind { kNone, kSingle, kPair, kShortBurst, kLongBurst, kRandom, kStartBit, kKinds };
const char* const kNames[] = {"none", "single", "pair", "burst<=n", "burst>n", "random", "start"};

struct Tally {
  std::uint64_t faulty = 0;
  std::uint64_t missed = 0;
  double expected = 0;  // sum of the probabilities that theory gives
};
using Tallies = std::map<unsigned, std::array<Tally, kKinds>>;  // by CRC width

struct Sensor {
  unsigned bits = 0;
  CrcChoice crc;
  std::uint16_t start = 0;
  unsigned period = 0;  // smallest distance of two errors that the polynomial divides
  std::string sent;     // this frame
};

// Smallest e > 0 with x^e = 1 modulo the polynomial: pairs that far apart are not seen.
unsigned period_of(CrcChoice crc) {
  std::uint32_t power = 1;
  for (unsigned e = 1;; ++e) {
    power <<= 1;
    if ((power >> crc.width) != 0) power ^= crc.polynomial;
    if (power == 1) return e;
  }
}

class Campaign {
 public:
  explicit Campaign(std::uint64_t seed) : random_(seed) {}

  // Up to `frames` frames in one random configuration.
  void run(unsigned frames, Tallies& tallies, std::uint64_t& wrong) {
    std::ostringstream text;
    text << "[host]\nsclk_hz = 50_000_000\n[[channel]]\nnumber = 1\ndelay_ns = " << below(400)
         << ".0\n";
    sensors_.clear();
    const unsigned count = one_in(12) ? 8 : 1 + below(3);
    const unsigned longest = one_in(20) ? 64 : 14;
    std::vector<std::uint8_t> registers{reg::kSpiOpcodeWriteRegisters, reg::slave_cfg_address(1)};
    for (unsigned i = 0; i < count; ++i) add_sensor(longest, text, registers);
    Chip chip(text.str());
    chip.spi(registers);
    chip.write(reg::kAddrCtrl, {reg::kRegversBissC, reg::FREQR::of(5), reg::kNocrcDropped,
                                reg::kFreqagsAgsMin});  // f_CLK / 2, NOCRC, AGSMIN
    chip.write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5, reg::kCfgch2Unused | reg::kCfgch1BissC});
    for (unsigned i = 0; i < frames; ++i) {
      frame(chip, tallies, wrong);
      if (testing::Test::HasFatalFailure()) return;
    }
  }

 private:
  unsigned below(unsigned limit) { return static_cast<unsigned>(random_() % limit); }
  bool one_in(unsigned n) { return below(n) == 0; }

  void add_sensor(unsigned longest, std::ostringstream& text,
                  std::vector<std::uint8_t>& registers) {
    Sensor sensor;
    sensor.bits = 1 + below(longest);
    const std::uint8_t codes[] = {0x03, 0x04, 0x05, 0x06, 0x07, 0x08, 0x10};
    const std::uint8_t code =
        one_in(3) ? static_cast<std::uint8_t>(0x81 + below(127)) : codes[below(7)];
    sensor.crc = mb4test::crc_choice(code);
    sensor.start = one_in(2) ? static_cast<std::uint16_t>(random_()) : std::uint16_t{0};
    sensor.period = period_of(sensor.crc);
    for (const unsigned byte : {0x40U | (sensor.bits - 1), unsigned{code}, sensor.start & 0xFFU,
                                unsigned{sensor.start} >> 8U}) {
      registers.push_back(static_cast<std::uint8_t>(byte));
    }
    text << "[[channel.slave]]\nprotocol = \"biss-c\"\nflag_bits = 0\ndata_bits = " << sensor.bits
         << "\ncrc = " << sensor.crc.polynomial
         << "\ncrc_start = " << (sensor.start & ((1U << sensor.crc.width) - 1U)) << "\n";
    sensors_.push_back(sensor);
  }

  // Inverted bits of one word; empty if this kind of fault does not fit into it.
  std::string draw(const Sensor& sensor, Kind kind, double& probability) {
    const auto length = static_cast<unsigned>(sensor.sent.size());
    const unsigned n = sensor.crc.width;
    std::string flips(length, '0');
    probability = 0;
    unsigned burst = 0;
    switch (kind) {
      case kSingle:
        flips[below(length)] = '1';
        return flips;
      case kPair: {
        const unsigned first = below(length);
        const unsigned second = below(length);
        if (first == second) return {};
        flips[first] = flips[second] = '1';
        const unsigned distance = first > second ? first - second : second - first;
        probability = distance % sensor.period == 0 ? 1 : 0;
        return flips;
      }
      case kShortBurst:
        burst = 1 + below(n);
        break;
      case kLongBurst:
        if (length == n + 1) {
          burst = length;
        } else {
          burst = n + 1 + below(length - n);
        }
        probability = std::pow(0.5, burst == n + 1 ? n - 1 : n);
        break;
      default:  // every pattern but none, with the same probability
        do {
          for (char& bit : flips) bit = one_in(2) ? '1' : '0';
        } while (flips.find('1') == std::string::npos);
        probability = (std::pow(2.0, sensor.bits) - 1) / (std::pow(2.0, length) - 1);
        return flips;
    }
    const unsigned at = below(length - burst + 1);
    for (unsigned i = 0; i < burst; ++i) {
      flips[at + i] = i == 0 || i == burst - 1 || one_in(2) ? '1' : '0';
    }
    return flips;
  }

  void frame(Chip& chip, Tallies& tallies, std::uint64_t& wrong) {
    std::string line = "0";  // CDS
    std::vector<unsigned> injected;
    std::vector<Kind> kinds;
    std::vector<double> probabilities;
    for (std::size_t i = 0; i < sensors_.size(); ++i) {
      Sensor& sensor = sensors_[i];
      const std::uint64_t mask = sensor.bits == 64 ? ~0ULL : (1ULL << sensor.bits) - 1;
      const std::uint64_t word = random_() & mask;
      ASSERT_TRUE(chip.simulator.slave(static_cast<unsigned>(i) + 1)->set_data(word));
      sensor.sent = mb4test::word_on_line(word, sensor.bits, sensor.crc, sensor.start);
      kinds.push_back(static_cast<Kind>(below(kStartBit)));
      probabilities.push_back(0);
      std::string flips;
      if (kinds[i] != kNone) flips = draw(sensor, kinds[i], probabilities[i]);
      if (flips.empty()) kinds[i] = kNone;
      std::string word_bits = sensor.sent;
      for (std::size_t k = 0; k < flips.size(); ++k) {
        if (flips[k] == '0') continue;
        mb4test::invert(word_bits, k);
        injected.push_back(static_cast<unsigned>(line.size() + k) + 1);
      }
      line += word_bits;
    }
    // A start bit that is lost: the next 1 is taken for it, and the words end in the stop zeros.
    if (one_in(16) && line.find('1') != std::string::npos) {
      injected.push_back(0);
      const std::size_t length = line.size();
      line.erase(0, line.find('1') + 1);
      line.resize(length, '0');
      for (std::size_t i = 0; i < kinds.size(); ++i) {
        kinds[i] = kStartBit;
        probabilities[i] = std::pow(0.5, sensors_[i].crc.width);
      }
    }
    clocked(chip.simulator.line(1))->faults().flip_next_frame(injected);
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
    std::vector<std::uint8_t> status = chip.spi({reg::kSpiOpcodeReadStatus, 0, 0, 0});
    const std::vector<std::uint8_t> memory = chip.spi(std::vector<std::uint8_t>{[&] {
      std::vector<std::uint8_t> tx(1 + 8 * sensors_.size(), 0);
      tx[0] = reg::kSpiOpcodeReadRegisters0;
      return tx;
    }()});
    bool all_good = true;
    std::size_t at = 1;
    for (std::size_t i = 0; i < sensors_.size(); ++i) {
      const Sensor& sensor = sensors_[i];
      const std::string got = line.substr(at, sensor.sent.size());
      at += got.size();
      const std::string data = got.substr(0, sensor.bits);
      const bool divides = mb4test::crc_fits(got, sensor.bits, sensor.crc, sensor.start);
      const bool valid = ((status[2 + i / 4] >> (2 * (i % 4) + 1)) & 1U) != 0;
      ASSERT_EQ(valid, divides) << kNames[kinds[i]] << " in word " << i + 1;
      std::uint64_t value = 0;
      for (unsigned byte = 0; byte < (sensor.bits + 7) / 8; ++byte) {
        value |= std::uint64_t{memory[1 + 8 * i + byte]} << (8 * byte);
      }
      ASSERT_EQ(value, mb4test::from_bits(data)) << "word " << i + 1;
      all_good = all_good && valid;
      if (got == sensor.sent) {
        ASSERT_TRUE(valid);
        continue;
      }
      Tally& tally = tallies[sensor.crc.width][kinds[i]];
      ++tally.faulty;
      tally.expected += probabilities[i];
      if (!valid) continue;
      ++tally.missed;
      // Every polynomial with x^n and 1 detects these, and also pairs that are closer than its
      // period.
      const bool certain = kinds[i] == kSingle || kinds[i] == kShortBurst ||
                           (kinds[i] == kPair && probabilities[i] == 0);
      if (certain) ++wrong;
      ASSERT_FALSE(certain) << kNames[kinds[i]] << " was not seen";
    }
    ASSERT_EQ(status[1] & 0x10, all_good ? 0x10 : 0x00) << "nSCDERR";
  }

  std::mt19937_64 random_;
  std::vector<Sensor> sensors_;
};

TEST(ChipFaults, RandomFaults_OnlyMultiplesOfThePolynomialPass) {
  const std::uint64_t frames = mb4test::number_from("MB4_FAULT_FRAMES", 20'000);
  const std::uint64_t first = mb4test::number_from("MB4_SEED", 1);
  constexpr unsigned kFramesEach = 200;
  Tallies tallies;
  std::uint64_t done = 0;
  std::uint64_t wrong = 0;
  for (std::uint64_t seed = first; done < frames; ++seed) {
    Campaign campaign(seed);
    const auto now = static_cast<unsigned>(std::min<std::uint64_t>(kFramesEach, frames - done));
    campaign.run(now, tallies, wrong);
    done += now;
    if (HasFatalFailure()) {
      FAIL() << "repeat with: MB4_SEED=" << seed << " MB4_FAULT_FRAMES=" << kFramesEach
             << " chip_test --gtest_filter=ChipFaults.*";
    }
  }
  std::printf("%llu frames; wrong words with SVALID = 1 that the CRC must find: %llu\n",
              static_cast<unsigned long long>(done), static_cast<unsigned long long>(wrong));
  std::printf("CRC width, fault, faulty words, not found, expected\n");
  for (const auto& [width, kinds] : tallies) {
    for (unsigned kind = kSingle; kind < kKinds; ++kind) {
      const Tally& tally = kinds[kind];
      std::printf("%2u %-8s %8llu %6llu %9.1f\n", width, kNames[kind],
                  static_cast<unsigned long long>(tally.faulty),
                  static_cast<unsigned long long>(tally.missed), tally.expected);
      // A lost start bit does not leave a random pattern, so the test prints 2^-n for it and
      // compares nothing.
      if (kind == kStartBit) continue;
      EXPECT_NEAR(static_cast<double>(tally.missed), tally.expected,
                  6 * std::sqrt(tally.expected) + 6)
          << "CRC width " << width << ", " << kNames[kind];
    }
  }
}

}  // namespace
