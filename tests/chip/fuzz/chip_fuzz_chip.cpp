// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/chip/fuzz/chip_fuzz_chip.hpp"

#include <algorithm>
#include <sstream>

#include "mb4_regs.hpp"
#include "tests/support/bits.hpp"

namespace mb4test {
namespace {

using mb4test::Protocol;

constexpr const char* kProtocolNames[] = {"biss-b", "biss-c", "ssi"};
constexpr std::uint64_t kLeastClockHz = 2'000'000;
constexpr unsigned kLeastWriteNs = 60;  // I001 to I016, I101 to I114
constexpr unsigned kLeastReadNs = 110;

// Inverse of an odd number modulo 2^64.
std::uint64_t inverse(std::uint64_t odd) {
  std::uint64_t result = odd;  // right in the lowest three bits
  for (int i = 0; i < 5; ++i) result *= 2 - odd * result;
  return result;
}

FuzzSlave make_slave(Random& random, const FuzzLine& line) {
  FuzzSlave slave;
  slave.bits = random.one_in(6) ? 64 : 10 + random.below(45);
  static constexpr std::uint8_t kCrcs[] = {0x05, 0x06, 0x06, 0x07, 0x08, 0x08, 0x10, 0x10, 0x10};
  slave.crc_register = random.one_in(8) ? static_cast<std::uint8_t>(0x90 | random.below(0x70))
                                        : kCrcs[random.below(9)];
  slave.crc = mb4test::crc_choice(slave.crc_register);
  if (random.one_in(2)) slave.crc_start = static_cast<std::uint16_t>(random.word());
  slave.gray = line.protocol == Protocol::kSsi && random.one_in(3);
  slave.actuator = line.mo && line.protocol == Protocol::kBissC && random.one_in(4);
  slave.first_word = random.word() & slave.mask() & ~(1ULL << 63U);
  slave.step = (random.word() & 0x7FFF'FFFFU) | 1U;
  return slave;
}

std::string slave_text(Random& random, const FuzzLine& line, const FuzzSlave& slave) {
  std::ostringstream text;
  text << "[[channel.slave]]\nprotocol = \"" << kProtocolNames[static_cast<unsigned>(line.protocol)]
       << "\"\nflag_bits = 0\ndata_bits = " << slave.bits << "\ncrc = " << slave.crc.polynomial
       << "\ncrc_start = " << (slave.crc_start & ((1U << slave.crc.width) - 1U)) << "\n";
  if (slave.actuator) {
    text << "actuator = true\nstop_bit = true\n";
  } else {
    text << "source = \"ramp\"\nstart = " << slave.first_word << "\nstep = " << slave.step << "\n";
  }
  switch (line.protocol) {
    case Protocol::kSsi:
      text << "gray = " << (slave.gray ? "true" : "false")
           << "\ntimeout = " << 10 + random.below(20) << "\n";
      break;
    case Protocol::kBissB:
      text << "timeout = " << 10 + random.below(20)
           << "\nregister_timeout = " << 40 + random.below(60)
           << "\nbusy_periods = " << random.below(8) << "\n";
      break;
    default:
      text << (random.one_in(3) ? "timeout = " + std::to_string(5 + random.below(20))
                                : std::string("timeout = \"adaptive\""))
           << "\nbusy_periods = " << random.below(8) << "\n";
      break;
  }
  if (line.protocol != Protocol::kSsi) {
    text << "registers = { 0x20 = [0x5A, 0xC3, 0x0F] }\n";
    if (random.one_in(3)) text << "acknowledge = \"passed-on\"\n";
    if (random.one_in(3)) text << "missing = [\"0x30-0x3F\"]\n";
  }
  return text.str();
}

std::string fault_text(Random& random, FuzzChip& chip) {
  std::ostringstream text;
  const auto add = [&](const std::string& kind, const std::string& keys, bool lasts,
                       unsigned most_us = 0) {
    const unsigned at_us = 5 + random.below(800);
    const unsigned for_us = most_us != 0 ? most_us : 1 + random.below(random.one_in(3) ? 300 : 30);
    text << "[[fault]]\nkind = \"" << kind << "\"\nat_us = " << at_us << "." << random.below(1000)
         << "\n"
         << keys;
    if (lasts) text << "for_us = " << for_us << "\n";
    chip.faults_end_ns = std::max<std::uint64_t>(chip.faults_end_ns, (at_us + for_us + 2) * 1000);
  };
  for (unsigned line = 0; line < 2; ++line) {
    const FuzzLine& of = chip.lines[line];
    if (!of.present || random.one_in(2)) continue;
    const std::string channel = "channel = " + std::to_string(line + 1) + "\n";
    // Long enough for an access to end.
    if (random.one_in(6)) add("stuck", channel + "on = \"sl\"\nlevel = 0\n", true, 3000);
    for (unsigned count = random.below(4); count > 0; --count) {
      const auto& slave = of.slaves[random.below(static_cast<unsigned>(of.slaves.size()))];
      const std::string of_slave = "slave = " + std::to_string(slave.number) + "\n";
      switch (random.below(7)) {
        case 0:
          add("stuck", channel + "on = \"sl\"\nlevel = " + std::to_string(random.below(2)) + "\n",
              true);
          break;
        case 1:
          add("stuck", channel + "on = \"ma\"\nlevel = " + std::to_string(random.below(2)) + "\n",
              true);
          break;
        case 2:
          add("silent", of_slave, true);
          break;
        case 3:
          if (of.protocol != Protocol::kSsi) add("busy", of_slave, true);
          break;
        case 4:
          add("wrong-crc", of_slave, true);
          break;
        case 5:
          add("unplug", of_slave, true);
          break;
        default: {  // one after the other, of any width up to some bits
          const std::string width = "width_ns = " + std::to_string(1 + random.below(300)) + "\n";
          for (unsigned left = 1 + random.below(12); left > 0; --left) {
            add("glitch", channel + width, false);
          }
          break;
        }
      }
    }
  }
  if (chip.f_clk_hz != 0 && random.one_in(3)) {
    chip.clk_stops = true;
    chip.clk_stops_for_ever = random.one_in(6);
    add("clock-stop", "", !chip.clk_stops_for_ever);
  }
  if (chip.f_clk_hz != 0 && random.one_in(3)) {
    for (unsigned left = 1 + random.below(4); left > 0; --left) {
      const std::uint64_t hz = random.one_in(2) ? 10'000'000 + random.below(15'000'001)
                                                : kLeastClockHz + random.below(8'000'000);
      add("clock-frequency", "hz = " + std::to_string(hz) + "\n", random.one_in(2));
      chip.clocks_hz.push_back(hz);
    }
  }
  chip.clk_changes = text.str().find("\"clock-") != std::string::npos;
  return text.str();
}

std::string channel_text(Random& random, FuzzChip& chip, unsigned index) {
  FuzzLine& line = chip.lines[index];
  std::ostringstream text;
  text << "[[channel]]\nnumber = " << index + 1 << "\ndelay_ns = " << line.delay_ns << "\n";
  if (line.mo) text << "mo = true\n";
  for (const FuzzSlave& slave : line.slaves) text << slave_text(random, line, slave);
  return text.str();
}

void make_line(Random& random, FuzzChip& chip, unsigned index, unsigned room) {
  FuzzLine& line = chip.lines[index];
  line.present = true;
  line.protocol = random.one_in(2) ? Protocol::kBissC : static_cast<Protocol>(random.below(3));
  line.mo = line.protocol != Protocol::kSsi && random.one_in(3);
  line.delay_ns =
      random.one_in(3) || line.protocol == Protocol::kSsi ? random.below(60) : random.below(900);
  unsigned mask = 1U << random.below(room);
  if (line.protocol != Protocol::kSsi && random.one_in(3)) mask |= 1U << random.below(room);
  for (unsigned x = 0; x < room; ++x) {
    if (((mask >> x) & 1U) == 0) continue;
    FuzzSlave slave = make_slave(random, line);
    slave.channel = index * 4 + x;
    slave.number = static_cast<unsigned>(4 * index + line.slaves.size() + 1);
    std::uint8_t* const bytes = &chip.fit[reg::slave_cfg_address(slave.channel + 1)];
    bytes[0] = static_cast<std::uint8_t>(reg::kEnscdYes | (slave.bits - 1) |
                                         (slave.gray       ? reg::kGraysGray
                                          : slave.actuator ? reg::kLstopWith
                                                           : 0));
    bytes[1] = slave.crc_register;
    bytes[2] = static_cast<std::uint8_t>(slave.crc_start);
    bytes[3] = static_cast<std::uint8_t>(slave.crc_start >> 8U);
    if (slave.actuator)
      chip.fit[reg::kAddrActnsens] |= static_cast<std::uint8_t>(1U << slave.channel);
    line.slaves.push_back(slave);
  }
}

}  // namespace

bool FuzzSlave::has_sent(std::uint64_t word, std::uint64_t frames) const {
  return (((word - first_word) * inverse(step)) & mask()) <= frames;
}

std::uint32_t FuzzSlave::crc_of(std::uint64_t word) const {
  const std::uint64_t sent = gray ? word ^ (word >> 1U) : word;
  return mb4test::remainder(to_bits(sent, bits), crc, crc_start);
}

std::string FuzzSlave::line_bits(std::uint64_t word, std::uint32_t inverted_crc) const {
  const std::uint64_t sent = gray ? word ^ (word >> 1U) : word;
  return to_bits(sent, bits) + to_bits(inverted_crc, crc.width);
}

bool FuzzLine::has_actuator() const {
  return std::any_of(slaves.begin(), slaves.end(),
                     [](const auto& slave) { return slave.actuator; });
}

FuzzChip make_fuzz_chip(Random& random, std::uint64_t seed) {
  FuzzChip chip;
  static constexpr std::uint64_t kClocks[] = {20'000'000, 20'000'000,    25'000'000, 12'500'000,
                                              10'000'000, kLeastClockHz, 0};
  chip.f_clk_hz = kClocks[random.below(7)];
  chip.f_osc_hz = random.one_in(3) ? 12'500'000 + random.below(12'500'000) : 20'000'000;
  for (const std::uint64_t hz : {chip.f_clk_hz, chip.f_osc_hz}) {
    if (hz != 0) chip.clocks_hz.push_back(hz);
  }
  chip.agserr_on_write = random.one_in(16);
  chip.agserr_on_hold = random.one_in(8);
  // SLAVELOC5 = 1 if line 2 is used; then each has its four data channels.
  const bool second = random.one_in(2);
  const bool first = !second || !random.one_in(5);
  if (first) make_line(random, chip, 0, second ? 4 : 8);
  if (second) make_line(random, chip, 1, 4);
  chip.fit[reg::kAddrSlaveloc5] =
      second ? reg::kResetSlaveloc5 | reg::kSlaveloc5Split : reg::kResetSlaveloc5;
  chip.fit[reg::kAddrCfgch] =
      static_cast<std::uint8_t>(static_cast<unsigned>(chip.lines[0].protocol) |
                                static_cast<unsigned>(chip.lines[1].protocol) << 2U);

  static constexpr const char* kHosts[] = {"spi", "spi", "spi2", "intel", "motorola"};
  const unsigned host = random.below(5);
  chip.parallel = host >= 3;
  chip.motorola = host == 4;
  chip.spi2 = host == 2;
  chip.cycle_ns = random.one_in(2) ? kLeastWriteNs + random.below(kLeastReadNs - kLeastWriteNs)
                                   : kLeastReadNs + random.below(3) * 400;
  static constexpr unsigned kSclk[] = {50'000'000, 20'000'000, 20'000'000, 5'000'000};
  std::ostringstream text;
  text << "[sim]\nseed = " << seed << "\n[chip]\nf_clk_hz = " << chip.f_clk_hz
       << "\nf_osc_hz = " << chip.f_osc_hz
       << "\n[chip.quirks]\nAGSERR_ON_HOLDBANK = " << (chip.agserr_on_hold ? "true" : "false")
       << "\nAGSERR_ON_INSTR_WRITE = " << (chip.agserr_on_write ? "true" : "false")
       << "\n[host]\ninterface = \"" << kHosts[host] << "\"\nsclk_hz = " << kSclk[random.below(4)]
       << "\ncycle_ns = " << chip.cycle_ns << "\n";
  const std::string faults = fault_text(random, chip);
  for (const unsigned line : {0U, 1U}) {
    if (chip.lines[line].present) text << channel_text(random, chip, line);
  }
  chip.scenario.text = text.str() + faults;
  chip.scenario.any_host = false;
  return chip;
}

}  // namespace mb4test
