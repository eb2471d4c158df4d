// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "random_case.hpp"

#include <algorithm>
#include <sstream>

#include "bits.hpp"
#include "mb4sim/ma_frequency.hpp"

namespace mb4test {
namespace {

namespace sim = mb4::sim;

std::uint64_t data_word(Random& random, unsigned bits) {
  const std::uint64_t value = random.one_in(8) ? 0 : random.one_in(8) ? ~0ULL : random.word();
  return bits == 64 ? value : value & ((1ULL << bits) - 1);
}

Sensor make_sensor(Random& random, mb4ref::Registers& registers, unsigned channel) {
  Sensor sensor;
  sensor.channel = channel;
  sensor.bits = random.one_in(6) ? (random.one_in(2) ? 1 : 64) : 1 + random.below(64);
  const unsigned codes[] = {0x03, 0x04, 0x05, 0x06, 0x06, 0x07, 0x08, 0x10, 0x00};
  unsigned c1 = codes[random.below(9)];
  if (random.one_in(4)) c1 = 0x80 | random.below(128);
  sensor.crc = mb4ref::crc_choice(static_cast<std::uint8_t>(c1));
  if (sensor.crc.width != 0 && random.one_in(2)) {
    sensor.start = static_cast<std::uint16_t>(random.word());
  }
  // Bit 7 of 0xC0 (GRAYS) does nothing on a BiSS sensor (decision 29).
  const unsigned gray = random.one_in(4) ? 0x80 : 0x00;
  registers.slave[4 * channel] = static_cast<std::uint8_t>(gray | 0x40 | (sensor.bits - 1));
  registers.slave[4 * channel + 1] = static_cast<std::uint8_t>(c1);
  registers.slave[4 * channel + 2] = static_cast<std::uint8_t>(sensor.start & 0xFF);
  registers.slave[4 * channel + 3] = static_cast<std::uint8_t>(sensor.start >> 8);
  for (unsigned i = 0; i < RandomCase::kFrames; ++i) {
    sensor.words.push_back(data_word(random, sensor.bits));
  }
  return sensor;
}

// "adaptive" or a time that is longer than half a period of MA at the slowest FREQS made here.
std::string timeout_key(Random& random) {
  if (!random.one_in(3)) return "timeout = \"adaptive\"\n";
  std::ostringstream text;
  text << "timeout = " << 3 + random.below(25) << "." << random.below(10) << "\n";
  return text.str();
}

// Single bits, pairs, bursts; positions behind the start bit, CDS (0) left alone.
std::vector<unsigned> make_flips(Random& random, unsigned length) {
  if (length < 2 || !random.one_in(3)) return {};
  const unsigned first = 1 + random.below(length - 1);
  std::vector<unsigned> flips{first};
  const unsigned more = random.one_in(2) ? 0 : random.below(5);
  for (unsigned k = 0; k < more; ++k) {
    const unsigned next = random.one_in(2) ? first + k + 1 : 1 + random.below(length - 1);
    if (next < length) flips.push_back(next);
  }
  std::sort(flips.begin(), flips.end());
  flips.erase(std::unique(flips.begin(), flips.end()), flips.end());
  return flips;
}

std::string channel_text(Random& random, const RandomCase& result, unsigned line) {
  const unsigned delay = random.one_in(3) ? 0 : random.below(random.one_in(10) ? 20'000 : 900);
  // I305: any two edges may deviate by 25 % of T_MA; rounded down.
  const std::uint64_t period_ns = sim::ma_divider(result.freqs) * 1'000'000'000 / result.f_clk_hz;
  const auto jitter = random.one_in(3) ? random.below(static_cast<unsigned>(period_ns / 4) + 1) : 0;
  std::ostringstream text;
  text << "[[channel]]\nnumber = " << line + 1 << "\ndelay_ns = " << delay
       << ".0\njitter_ns = " << jitter << "\nflips = [";
  for (unsigned frame = 0; frame < RandomCase::kFrames; ++frame) {
    if (result.flips[line][frame].empty()) continue;
    text << "[" << frame + 1;
    // The simulator counts from the start bit.
    for (const unsigned bit : result.flips[line][frame]) text << ", " << bit + 1;
    text << "], ";
  }
  text << "]\n";
  for (const Sensor& sensor : result.lines[line]) {
    text << "[[channel.slave]]\nprotocol = \"biss-c\"\ncontrol = false\nflag_bits = 0\ndata_bits = "
         << sensor.bits << "\ncrc = " << sensor.crc.polynomial
         << "\ncrc_start = " << (sensor.start & ((1U << sensor.crc.width) - 1U))
         << "\nbusy_periods = " << (random.one_in(3) ? random.below(20) : 0) << "\n";
    text << timeout_key(random) << WordScenario::source_keys(sensor.slave);
  }
  return text.str();
}

}  // namespace

mb4ref::Lines RandomCase::frame(std::uint64_t frame) const {
  mb4ref::Lines result;
  const auto at = static_cast<std::size_t>(std::min<std::uint64_t>(frame, kFrames - 1));
  for (unsigned line = 0; line < 2; ++line) {
    if (!used[line]) continue;
    std::string& bits = result.bits[line];
    bits.assign(1, '0');  // CDS outside control communication
    for (const Sensor& sensor : lines[line]) {
      bits += word_on_line(sensor.words[at], sensor.bits, sensor.crc, sensor.start);
    }
    if (frame >= kFrames) continue;
    for (const unsigned bit : flips[line][at]) invert(bits, bit);
  }
  return result;
}

RandomCase make_case(Random& random) {
  RandomCase result;
  mb4ref::Registers& registers = result.registers;
  registers.slaveloc5 = random.one_in(2);
  registers.nocrc = random.one_in(4);
  registers.singlebank = random.one_in(5);
  result.freqs = random.one_in(3)    ? 0
                 : random.one_in(12) ? 0x11 + random.below(2)
                                     : random.below(6);
  result.f_clk_hz = random.one_in(2) ? 20'000'000 : random.one_in(2) ? 25'000'000 : 12'500'000;
  // With SLAVELOC5 = 1 sometimes one of the two lines is not used although slaves hang on it.
  const unsigned unused = registers.slaveloc5 && random.one_in(4) ? 1 + random.below(2) : 0;
  result.used = {unused != 1, registers.slaveloc5 && unused != 2};
  result.cfgch = static_cast<std::uint8_t>((result.used[0] ? 1 : 3) | (result.used[1] ? 4 : 12));
  result.chsel = static_cast<std::uint8_t>(random.below(4));
  std::string text =
      "[chip]\nf_clk_hz = " + std::to_string(result.f_clk_hz) + "\n[host]\nsclk_hz = 20_000_000\n";
  for (unsigned line = 0; line < (registers.slaveloc5 ? 2U : 1U); ++line) {
    const unsigned room = registers.slaveloc5 ? 4 : 8;
    unsigned mask = 0;
    while (mask == 0) mask = random.below(1U << room);
    if (random.one_in(2)) mask = 1U << random.below(room);  // one slave is the usual case
    unsigned length = 1;
    for (unsigned x = 0; x < room; ++x) {
      if (((mask >> x) & 1U) == 0) continue;
      Sensor sensor = make_sensor(random, registers, line * 4 + x);
      sensor.slave = static_cast<unsigned>(4 * line + result.lines[line].size() + 1);
      length += sensor.bits + sensor.crc.width;
      result.scenario.words.emplace_back(sensor.slave, sensor.words);
      result.lines[line].push_back(std::move(sensor));
    }
    for (auto& flips : result.flips[line]) flips = make_flips(random, length);
    text += channel_text(random, result, line);
  }
  result.scenario.text = "[sim]\nseed = " + std::to_string(random.below(1000)) + "\n" + text;
  result.hold_cdm = random.one_in(4);
  return result;
}

}  // namespace mb4test
