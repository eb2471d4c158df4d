// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/random_case.hpp"

#include <algorithm>
#include <sstream>

#include "sim/masters/mb4/ma_frequency.hpp"
#include "tests/support/bits.hpp"

namespace mb4test {
namespace {

namespace sim = mb4::sim;

std::uint64_t data_word(Random& random, unsigned bits) {
  const std::uint64_t value = random.one_in(8) ? 0 : random.one_in(8) ? ~0ULL : random.word();
  return bits == 64 ? value : value & ((1ULL << bits) - 1);
}

using mb4test::Protocol;

constexpr const char* kProtocolNames[] = {"biss-b", "biss-c", "ssi"};

// What one line is made of, beside its slaves.
struct LinePlan {
  Protocol protocol = Protocol::kBissC;
  bool bus = false;        // MO is wired
  bool free_crc = true;    // the core has every CRC
  bool actuators = false;  // some slaves may be actuators
};

Sensor make_sensor(Random& random, RandomCase& result, const LinePlan& plan, unsigned channel) {
  mb4test::Registers& registers = result.registers;
  Sensor sensor;
  sensor.channel = channel;
  sensor.bits = random.one_in(6) ? (random.one_in(2) ? 1 : 64) : 1 + random.below(64);
  const unsigned codes[] = {0x03, 0x04, 0x05, 0x06, 0x06, 0x07, 0x08, 0x10, 0x00};
  unsigned c1 = codes[random.below(9)];
  if (random.one_in(4)) c1 = 0x80 | random.below(128);
  const unsigned few[] = {0x00, 0x06, 0x10, 0x80 | 0x21};
  if (!plan.free_crc) c1 = few[random.below(4)];
  sensor.crc = mb4test::crc_choice(static_cast<std::uint8_t>(c1));
  if (sensor.crc.width != 0 && random.one_in(2)) {
    sensor.start = static_cast<std::uint16_t>(random.word());
  }
  // Bit 7 of 0xC0: GRAYS, which does nothing on a BiSS sensor (decision 29), or LSTOP.
  bool bit7 = random.one_in(4);
  if (plan.actuators) sensor.actuator = random.one_in(2);
  if (sensor.actuator) {
    registers.actnsens = static_cast<std::uint8_t>(registers.actnsens | 1U << channel);
    // The first bit of its slot is what an actuator shows on SLO until its timeout. If it were 1,
    // SL would look like the end of the timeout (docs/choices.md, LSTOPx).
    sensor.stop_bit = bit7 = true;
  }
  if (plan.protocol == Protocol::kSsi) sensor.gray = bit7;
  const unsigned gray = bit7 ? 0x80 : 0x00;
  registers.slave[4 * channel] = static_cast<std::uint8_t>(gray | 0x40 | (sensor.bits - 1));
  registers.slave[4 * channel + 1] = static_cast<std::uint8_t>(c1);
  registers.slave[4 * channel + 2] = static_cast<std::uint8_t>(sensor.start & 0xFF);
  registers.slave[4 * channel + 3] = static_cast<std::uint8_t>(sensor.start >> 8);
  if (sensor.actuator) return sensor;
  for (unsigned i = 0; i < RandomCase::kFrames; ++i) {
    sensor.words.push_back(data_word(random, sensor.bits));
  }
  return sensor;
}

// "adaptive", or a time longer than 3 us, half a period of MA at the slowest FREQS made here.
std::string timeout_key(Random& random) {
  if (!random.one_in(3)) return "timeout = \"adaptive\"\n";
  std::ostringstream text;
  text << "timeout = " << 3 + random.below(25) << "." << random.below(10) << "5\n";
  return text.str();
}

// Single bits, pairs, bursts; positions after the start bit, CDS (0) left alone.
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

double ma_period_ns(const RandomCase& result) {
  return sim::ma_divider(result.freqs) * 1e9 / static_cast<double>(result.f_clk_hz);
}

// An SSI encoder may answer up to one period less 30 ns late, cable included (page 14).
std::string ssi_text(Random& random, const RandomCase& result, double jitter_ns, double& delay_ns) {
  const double room = ma_period_ns(result) - 30 - jitter_ns;
  delay_ns = random.one_in(3) ? 0 : room * random.below(1001) / 1000;
  const double response = random.one_in(2) ? 0 : (room - delay_ns) * random.below(1001) / 1000;
  std::ostringstream text;
  text << "response_ns = " << response
       << "\ntimeout = " << (5 + random.below(30)) * ma_period_ns(result) / 1000 << "\n";
  return text.str();
}

std::string slave_text(Random& random, const Sensor& sensor, const LinePlan& plan) {
  std::ostringstream text;
  text << "[[channel.slave]]\nprotocol = \"" << kProtocolNames[static_cast<unsigned>(plan.protocol)]
       << "\"\ncontrol = false\nflag_bits = 0\ndata_bits = " << sensor.bits
       << "\ncrc = " << sensor.crc.polynomial
       << "\ncrc_start = " << (sensor.start & ((1U << sensor.crc.width) - 1U)) << "\n";
  if (sensor.actuator) {
    text << "actuator = true\nstop_bit = " << (sensor.stop_bit ? "true" : "false") << "\n";
  } else {
    text << WordScenario::source_keys(sensor.slave);
  }
  if (plan.protocol == Protocol::kSsi) {
    if (sensor.gray) text << "gray = true\n";
    return text.str();
  }
  text << "busy_periods = " << (random.one_in(3) ? random.below(20) : 0) << "\n"
       << timeout_key(random);
  return text.str();
}

std::string channel_text(Random& random, RandomCase& result, const LinePlan& plan, unsigned line,
                         unsigned length) {
  double delay = random.one_in(3) ? 0 : random.below(random.one_in(10) ? 20'000 : 900);
  // I305: any two edges may deviate by 25 % of T_MA; rounded down.
  const auto most = static_cast<unsigned>(ma_period_ns(result) / 4);
  const unsigned jitter = random.one_in(3) ? random.below(most + 1) : 0;
  std::string slaves;
  for (const Sensor& sensor : result.lines[line]) slaves += slave_text(random, sensor, plan);
  // CDS has been taken three periods after its edge came back, the last edge is N periods later.
  if (plan.actuators && delay > ma_period_ns(result) * (static_cast<int>(length) - 4)) {
    result.late_cds = true;
  }
  if (plan.protocol == Protocol::kSsi) slaves += ssi_text(random, result, jitter, delay);
  std::ostringstream text;
  text << std::fixed << "[[channel]]\nnumber = " << line + 1 << "\ndelay_ns = " << delay
       << "\njitter_ns = " << jitter << "\n";
  if (plan.bus) {
    // Later than MA by what jitter leaves of I305: the start bit passes the slaves as MO brings it.
    const double late = random.one_in(2) ? 0 : (most - jitter) * random.below(1000) / 1000.0;
    text << "mo = true\nmo_delay_ns = " << delay / 2 + late + 0.001 << "\n";
  }
  text << "flips = [";
  for (unsigned frame = 0; frame < RandomCase::kFrames; ++frame) {
    if (result.flips[line][frame].empty()) continue;
    text << "[" << frame + 1;
    // The simulator counts from the start bit; SSI has none.
    const unsigned first = plan.protocol == Protocol::kSsi ? 0 : 1;
    for (const unsigned bit : result.flips[line][frame]) text << ", " << bit + first;
    text << "], ";
  }
  text << "]\n";
  return text.str() + slaves;
}

Protocol any_protocol(Random& random) { return static_cast<Protocol>(random.below(3)); }

// Chooses what the two lines are. Without `all_protocols` both have BiSS C sensors and no MO.
std::array<LinePlan, 2> make_plans(Random& random, RandomCase& result, bool all_protocols) {
  std::array<LinePlan, 2> plans;
  if (all_protocols) {
    result.en_mo = random.one_in(2);
    result.mo_busy = static_cast<std::uint8_t>(random.one_in(3)   ? 0
                                               : random.one_in(8) ? random.below(256)
                                                                  : random.below(24));
    for (LinePlan& plan : plans) {
      plan.protocol = any_protocol(random);
      plan.bus = plan.protocol != Protocol::kSsi && random.one_in(2);
      plan.actuators =
          plan.protocol == Protocol::kBissC && plan.bus && result.en_mo && random.one_in(2);
    }
  }
  for (unsigned line = 0; line < 2; ++line) {
    result.registers.protocol[line] = result.used[line] ? plans[line].protocol : Protocol::kUnused;
  }
  result.cfgch =
      static_cast<std::uint8_t>(static_cast<unsigned>(result.registers.protocol[0]) |
                                static_cast<unsigned>(result.registers.protocol[1]) << 2U);
  return plans;
}

}  // namespace

mb4test::Lines RandomCase::frame(std::uint64_t frame) const {
  mb4test::Lines result;
  const auto at = static_cast<std::size_t>(std::min<std::uint64_t>(frame, kFrames - 1));
  for (unsigned line = 0; line < 2; ++line) {
    if (!used[line]) continue;
    std::string& bits = result.bits[line];
    bits.assign(cds_bits(line), '0');  // CDS outside control communication
    for (const Sensor& sensor : lines[line]) {
      bits += sensor.actuator
                  ? std::string(sensor.slot_bits(), '0')
                  : word_on_line(sensor.sent(at), sensor.bits, sensor.crc, sensor.start);
    }
    if (frame >= kFrames) continue;
    for (const unsigned bit : flips[line][at]) invert(bits, bit);
  }
  return result;
}

RandomCase make_case(Random& random, bool all_protocols, const CoreLimits& limits) {
  RandomCase result;
  mb4test::Registers& registers = result.registers;
  registers.slaveloc5 = random.one_in(2);
  registers.nocrc = random.one_in(4);
  registers.singlebank = random.one_in(5);
  result.freqs = random.one_in(3)    ? 0
                 : random.one_in(12) ? 0x11 + random.below(2)
                                     : random.below(6);
  result.f_clk_hz = random.one_in(2) ? 20'000'000 : random.one_in(2) ? 25'000'000 : 10'000'000;
  // With SLAVELOC5 = 1 sometimes one of the two lines is not used although slaves hang on it.
  const unsigned lines = registers.slaveloc5 ? limits.lines : 1;
  const unsigned unused = lines == 2 && random.one_in(4) ? 1 + random.below(2) : 0;
  result.used = {unused != 1, lines == 2 && unused != 2};
  result.chsel = static_cast<std::uint8_t>(random.below(4));
  std::array<LinePlan, 2> plans = make_plans(random, result, all_protocols);
  for (LinePlan& plan : plans) plan.free_crc = limits.free_crc;
  const unsigned mask1 = (1U << limits.slaves) - 1;
  result.channels = static_cast<std::uint8_t>(
      limits.lines == 2 && limits.slaves < 8 ? mask1 | mask1 << 4U : mask1);
  std::string text = "[chip]\nf_clk_hz = " + std::to_string(result.f_clk_hz) + "\nfeatures = \"" +
                     limits.features + "\"\n[host]\nsclk_hz = 20_000_000\n";
  for (unsigned line = 0; line < lines; ++line) {
    const unsigned room = std::min(registers.slaveloc5 ? 4U : 8U, limits.slaves);
    unsigned mask = 0;
    while (mask == 0) mask = random.below(1U << room);
    // One slave is the usual case.
    if (random.one_in(2) || plans[line].protocol == Protocol::kSsi) mask = 1U << random.below(room);
    unsigned length = plans[line].protocol == Protocol::kBissC ? 1 : 0;
    for (unsigned x = 0; x < room; ++x) {
      if (((mask >> x) & 1U) == 0) continue;
      Sensor sensor = make_sensor(random, result, plans[line], line * 4 + x);
      sensor.slave = static_cast<unsigned>(4 * line + result.lines[line].size() + 1);
      length += sensor.slot_bits();
      if (!sensor.actuator) result.scenario.words.emplace_back(sensor.slave, sensor.words);
      result.lines[line].push_back(std::move(sensor));
    }
    for (auto& flips : result.flips[line]) flips = make_flips(random, length);
    text += channel_text(random, result, plans[line], line, length);
  }
  result.scenario.text = "[sim]\nseed = " + std::to_string(random.below(1000)) + "\n" + text;
  result.hold_cdm = random.one_in(4);
  result.omits = random.one_in(2);
  if (result.omits) result.scenario.text += "[chip.quirks]\nAGSERR_ON_HOLDBANK = true\n";
  return result;
}

}  // namespace mb4test
