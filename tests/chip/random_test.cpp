// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Random configurations, slaves and line faults: the chip against the reference in tests/reference.
// MB4_RANDOM_CONFIGS sets the number of configurations (default 500; nightly 10000), MB4_SEED the
// first seed. A failure prints the seed, the scenario and the SPI frames for `mb4sim spi`.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <sstream>

#include "chip_fixture.hpp"
#include "reference.hpp"

namespace {

using mb4ref::CrcChoice;
using mb4ref::Lines;
using mb4ref::Reference;
using mb4ref::Registers;
using mb4test::Chip;
namespace sim = mb4::sim;

unsigned number_from(const char* variable, unsigned fallback) {
  const char* text = std::getenv(variable);
  return text == nullptr ? fallback : static_cast<unsigned>(std::strtoul(text, nullptr, 10));
}

std::string to_bits(std::uint64_t value, unsigned width) {
  std::string text;
  for (unsigned i = width; i-- > 0;) text += ((value >> i) & 1U) != 0 ? '1' : '0';
  return text;
}

// One slave of a chain and the data channel (0..7) that receives it.
struct Device {
  unsigned channel = 0;
  unsigned bits = 0;
  CrcChoice crc;
  std::uint16_t start = 0;
};

struct Case {
  Registers registers;
  std::array<std::vector<Device>, 2> lines;  // in chain order, next to SL first
  unsigned freqs = 0;
  std::string scenario;
};

class Generator {
 public:
  explicit Generator(std::uint64_t seed) : random_(seed) {}
  unsigned below(unsigned limit) { return static_cast<unsigned>(random_() % limit); }
  bool one_in(unsigned n) { return below(n) == 0; }
  std::uint64_t word(unsigned bits) {
    const std::uint64_t value = one_in(8) ? 0 : one_in(8) ? ~0ULL : random_();
    return bits == 64 ? value : value & ((1ULL << bits) - 1);
  }

  Case make() {
    Case result;
    result.registers.slaveloc5 = one_in(2);
    result.registers.nocrc = one_in(4);
    result.registers.singlebank = one_in(5);
    result.freqs = one_in(3) ? 0 : one_in(12) ? 0x11 + below(2) : below(6);
    std::ostringstream text;
    text << "[chip]\nf_clk_hz = "
         << (one_in(2)   ? 20'000'000
             : one_in(2) ? 25'000'000
                         : 12'500'000)
         << "\n";
    for (unsigned line = 0; line < (result.registers.slaveloc5 ? 2U : 1U); ++line) {
      const unsigned first = line * 4;
      const unsigned room = result.registers.slaveloc5 ? 4 : 8;
      text << "[[channel]]\nnumber = " << line + 1
           << "\ndelay_ns = " << (one_in(3) ? 0U : below(one_in(10) ? 20'000 : 900)) << ".0\n";
      unsigned mask = 0;
      while (mask == 0) mask = below(1U << room);
      if (one_in(2)) mask = 1U << below(room);  // one slave is the usual case
      for (unsigned x = 0; x < room; ++x) {
        if (((mask >> x) & 1U) == 0) continue;
        result.lines[line].push_back(device(result.registers, first + x, text));
      }
    }
    result.scenario = text.str();
    return result;
  }

 private:
  Device device(Registers& registers, unsigned channel, std::ostringstream& text) {
    Device result;
    result.channel = channel;
    result.bits = one_in(6) ? (one_in(2) ? 1 : 64) : 1 + below(64);
    const unsigned codes[] = {0x03, 0x04, 0x05, 0x06, 0x06, 0x07, 0x08, 0x10, 0x00};
    std::uint8_t c1 = static_cast<std::uint8_t>(codes[below(9)]);
    if (one_in(4)) c1 = static_cast<std::uint8_t>(0x80 | below(128));
    result.crc = mb4ref::crc_choice(c1);
    if (result.crc.width != 0 && one_in(2)) result.start = static_cast<std::uint16_t>(random_());
    registers.slave[4 * channel] = static_cast<std::uint8_t>(0x40 | (result.bits - 1));
    registers.slave[4 * channel + 1] = c1;
    registers.slave[4 * channel + 2] = static_cast<std::uint8_t>(result.start & 0xFF);
    registers.slave[4 * channel + 3] = static_cast<std::uint8_t>(result.start >> 8);
    text << "[[channel.slave]]\nprotocol = \"biss-c\"\ntimeout = \"adaptive\"\nflag_bits = 0\n"
         << "data_bits = " << result.bits << "\ncrc = " << result.crc.polynomial
         << "\ncrc_start = " << (result.start & ((1U << result.crc.width) - 1U))
         << "\nbusy_periods = " << (one_in(3) ? below(20) : 0U) << "\n";
    return result;
  }

  std::mt19937_64 random_;
};

struct Counts {
  unsigned frames = 0;
  unsigned words = 0;
  unsigned faulty_words = 0;
  unsigned undetected = 0;
};

// One configuration, some frames. Returns false at the first difference.
void run_case(std::uint64_t seed, Counts& counts) {
  Generator generator(seed);
  const Case c = generator.make();
  std::ostringstream log;
  log << "seed " << seed << "\n" << c.scenario << "--- spi\n";
  SCOPED_TRACE(log.str());
  Chip chip(c.scenario);
  Reference reference;
  std::vector<std::uint8_t> config{0x02, 0xC0};
  config.insert(config.end(), c.registers.slave.begin(), c.registers.slave.end());
  chip.spi(config);
  chip.write(0xE5, {0x40, static_cast<std::uint8_t>(0xA0 | c.freqs),
                    static_cast<std::uint8_t>((c.registers.nocrc ? 2 : 0) |
                                              (c.registers.singlebank ? 1 : 0)),
                    0x7C});
  chip.write(0xEC, {static_cast<std::uint8_t>(c.registers.slaveloc5 ? 0x11 : 0x01),
                    static_cast<std::uint8_t>(c.registers.slaveloc5 ? 0x05 : 0x0D)});
  // What no frame touches must stay: fill the host's bank.
  for (unsigned address = 0; address < 64; ++address) {
    const auto value = static_cast<std::uint8_t>(generator.below(256));
    chip.write(static_cast<std::uint8_t>(address), {value});
    reference.write(address, value);
  }
  const unsigned frames = 2 + generator.below(4);
  for (unsigned frame = 0; frame < frames; ++frame) {
    Lines lines;
    std::array<std::vector<bool>, 2> touched;
    for (unsigned line = 0; line < 2; ++line) {
      if (line == 1 && !c.registers.slaveloc5) continue;
      std::string& bits = lines.bits[line];
      bits = "0";  // CDS outside control communication
      for (std::size_t i = 0; i < c.lines[line].size(); ++i) {
        const Device& device = c.lines[line][i];
        const std::uint64_t word = generator.word(device.bits);
        const std::string data = to_bits(word, device.bits);
        const auto number = static_cast<unsigned>(4 * line + i + 1);
        ASSERT_TRUE(chip.simulator.slave(number)->set_data(word));
        bits += data + to_bits(~std::uint64_t{remainder(data, device.crc, device.start)},
                               device.crc.width);
      }
      ASSERT_EQ(bits.size(), 1 + Reference::frame_bits(c.registers, line + 1));
      // Faults on the way back: single bits, pairs, bursts. Bit 0 of the injector is the start bit.
      if (generator.one_in(3) && bits.size() > 1) {
        std::vector<unsigned> flips;
        const unsigned first = 1 + generator.below(static_cast<unsigned>(bits.size()) - 1);
        flips.push_back(first);
        const unsigned more = generator.one_in(2) ? 0 : generator.below(5);
        for (unsigned k = 0; k < more; ++k) {
          const unsigned next = generator.one_in(2)
                                    ? first + k + 1
                                    : 1 + generator.below(static_cast<unsigned>(bits.size()) - 1);
          if (next < bits.size()) flips.push_back(next);
        }
        std::sort(flips.begin(), flips.end());
        flips.erase(std::unique(flips.begin(), flips.end()), flips.end());
        std::vector<unsigned> injected;
        std::vector<bool> changed(bits.size(), false);
        for (const unsigned position : flips) {
          bits[position] = bits[position] == '0' ? '1' : '0';
          changed[position] = true;
          injected.push_back(position + 1);
        }
        touched[line] = changed;
        chip.simulator.line(line + 1)->faults().flip_next_frame(injected);
      }
    }
    reference.frame(c.registers, lines);
    chip.instruct(0x04);
    ASSERT_TRUE(chip.wait_eot(100'000)) << "frame " << frame;
    const auto status = chip.spi({0x05, 0, 0, 0, 0});
    ASSERT_EQ(status[1] & 0xD1, reference.scd_error() ? 0x41 : 0xD1) << "frame " << frame;
    ASSERT_EQ(status[2], reference.svalid_lo()) << "frame " << frame;
    ASSERT_EQ(status[3], reference.svalid_hi()) << "frame " << frame;
    const auto memory = chip.read(0x00, 64);
    for (unsigned address = 0; address < 64; ++address) {
      ASSERT_EQ(memory[address], reference.scdata(address))
          << "frame " << frame << " address " << address;
    }
    // How often did the CRC not see a fault? Only words with an even-weight or long pattern may.
    ++counts.frames;
    for (unsigned line = 0; line < 2; ++line) {
      std::size_t at = 1;
      for (const Device& device : c.lines[line]) {
        const std::size_t length = device.bits + device.crc.width;
        ++counts.words;
        if (!touched[line].empty()) {
          const auto begin = touched[line].begin() + static_cast<std::ptrdiff_t>(at);
          const auto flipped = std::count(begin, begin + static_cast<std::ptrdiff_t>(length), true);
          const unsigned valid = device.channel < 4 ? reference.svalid_lo() : reference.svalid_hi();
          const bool is_valid = ((valid >> (2 * (device.channel % 4) + 1)) & 1U) != 0;
          if (flipped > 0 && device.crc.width != 0) {
            ++counts.faulty_words;
            if (is_valid) ++counts.undetected;
            // A polynomial with more than one term finds every single error.
            if (flipped == 1) {
              ASSERT_FALSE(is_valid);
            }
          }
        }
        at += length;
      }
    }
    chip.advance_us(1);
  }
}

TEST(ChipRandom, Configurations_AgreeWithTheReference) {
  const unsigned count = number_from("MB4_RANDOM_CONFIGS", 500);
  const unsigned first = number_from("MB4_SEED", 1);
  Counts counts;
  for (unsigned i = 0; i < count; ++i) {
    run_case(first + i, counts);
    if (HasFailure()) {
      FAIL() << "repeat with: MB4_SEED=" << first + i
             << " MB4_RANDOM_CONFIGS=1 chip_test --gtest_filter=ChipRandom.*";
    }
  }
  std::printf("%u configurations, %u frames, %u words, %u faulty words with a CRC, %u unnoticed\n",
              count, counts.frames, counts.words, counts.faulty_words, counts.undetected);
}

}  // namespace
