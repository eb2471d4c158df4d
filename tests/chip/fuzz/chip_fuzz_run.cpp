// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/chip/fuzz/chip_fuzz_run.hpp"

#include <algorithm>

#include "mb4_regs.hpp"
#include "sim/lines/clocked/clocked_line.hpp"

namespace mb4test {
namespace {

namespace reg = mb4::regs;
namespace sim = mb4::sim;
using sim::Pin;

}  // namespace

const char* FuzzCounts::name(unsigned what) {
  static constexpr const char* kNames[kWhats] = {"operations",
                                                 "resets",
                                                 "asked whether everything ends",
                                                 "instructions that ended",
                                                 "accesses that ended",
                                                 "accesses that cannot run (37)",
                                                 "waits: clock stands still",
                                                 "waits: SL low (3)",
                                                 "waits: slave (4)",
                                                 "waits: host's next write (23, 42)",
                                                 "waits: GETSENS",
                                                 "waits: HOLDBANK released",
                                                 "waits: limit too long to be waited for",
                                                 "waits ended by BREAK",
                                                 "phases of words",
                                                 "valid words compared",
                                                 "SWBANK inverted within a frame",
                                                 "CRC aliases",
                                                 "CRC aliases, unclear",
                                                 "recoveries",
                                                 "words after a recovery",
                                                 "bursts read back (36)",
                                                 "INIT behind BREAK (46)",
                                                 "line delays measured again (46)"};
  return kNames[what];
}

bool FuzzCounts::is_common(unsigned what) {
  return what != kWaitsSlLow && what != kWaitsGetsens && what != kWaitsHold && what != kAliases &&
         what != kAliasesUnclear;
}

void FuzzCounts::add(const std::array<std::uint64_t, kWhats>& session) {
  ++number;
  for (unsigned i = 0; i < kWhats; ++i) {
    total[i] += session[i];
    sessions[i] += session[i] != 0 ? 1 : 0;
  }
}

FuzzRun::FuzzRun(const FuzzChip& chip, Random& random, const std::filesystem::path& folder)
    : chip_(chip), random_(random), host_(chip, folder) {
  for (unsigned line = 0; line < 2; ++line) {
    if (!chip.lines[line].present) continue;
    clocked(host_.simulator().line(line + 1))
        ->set_tap(
            [](sim::Time now, void* record, sim::ClockedLine::Signal signal, bool level) {
              if (signal != sim::ClockedLine::Signal::kSl) return;
              static_cast<LineRecord*>(record)->edges.emplace_back(now, level);
            },
            &records_[line]);
  }
}

void FuzzRun::fail(const std::string& rule, const std::string& what) {
  std::string pins = "; pins";
  for (const auto& [pin, name] : {std::pair{Pin::kEot, " EOT "},
                                  {Pin::kMa1, ", MA1 "},
                                  {Pin::kSl1, ", SL1 "},
                                  {Pin::kMo1, ", MO1 "},
                                  {Pin::kMa2, ", MA2 "},
                                  {Pin::kSl2, ", SL2 "},
                                  {Pin::kMo2, ", MO2 "}}) {
    pins += name + std::to_string(host_.simulator().pin(pin) ? 1 : 0);
  }
  host_.session().comment("here: " + rule + ": " + what + pins);
  throw FuzzFailure(rule, what + pins);
}

void FuzzRun::run() {
  if (chip_.f_clk_hz == 0) host_.write(reg::kAddrIface, {reg::CLKENI::kMask});
  most_clocks_ = 300'000;
  for (unsigned phases = 1 + below(3); phases > 0; --phases) {
    if (one_in(2)) {
      word_phase();
    } else {
      wild_phase();
    }
    check_end();
  }
  recover();
}

unsigned FuzzRun::random_freqags() {
  if (one_in(2)) return reg::kFreqagsAgsMin;
  if (one_in(5)) return reg::kFreqagsAgsInfinite;
  return one_in(8) ? below(0x100) : below(40);
}

// Every register that shapes the lines as the slaves are (`anew`: also those that already do); the
// rest at random.
void FuzzRun::configure(bool anew) {
  const auto range = [&](unsigned first, unsigned count) {
    const auto begin = chip_.fit.begin() + first;
    host_.write(first, {begin, begin + count});
  };
  if (anew) {
    range(reg::kAddrSlaveCfg, 32);
  } else {
    for (unsigned x = 1; x <= reg::kSlaves; ++x) {
      const unsigned first = reg::slave_cfg_address(x);
      unsigned last = first + reg::kSlaveCfgStride;
      while (last > first && host_.written(last - 1) == chip_.fit[last - 1]) --last;
      if (last > first) range(first, last - first);
    }
  }
  bool biss_b = true;
  bool need_mo = false;
  std::uint64_t ma_ns = 100;
  for (const FuzzLine& line : chip_.lines) {
    if (!line.present) continue;
    biss_b = biss_b && line.protocol == mb4test::Protocol::kBissB;
    need_mo = need_mo || line.has_actuator();
    if (line.protocol == mb4test::Protocol::kSsi) ma_ns = std::max<std::uint64_t>(ma_ns, 150);
  }
  const bool en_mo = need_mo || one_in(4);
  unsigned freqs = below(3);
  while ((freqs + 1) * 2 * (1'000'000'000 / 25'000'000) < ma_ns) ++freqs;
  host_.write(reg::kAddrChsel,
              {static_cast<std::uint8_t>(below(4)),
               static_cast<std::uint8_t>((biss_b ? 0 : 0x40) | 0x80 | (en_mo ? 2 : 0)),
               static_cast<std::uint8_t>(below(2) << 5U | freqs),
               static_cast<std::uint8_t>((one_in(4) ? 2 : 0) | (one_in(6) ? 1 : 0)),
               static_cast<std::uint8_t>(random_freqags()),
               static_cast<std::uint8_t>(en_mo && one_in(2) ? below(12) : 0)});
  range(reg::kAddrSlaveloc5, 2);
  range(reg::kAddrActnsens, 1);
}

void FuzzRun::random_wait() {
  const unsigned limit = one_in(4) ? 60'000 : one_in(2) ? 10'000 : 1500;
  host_.wait_ns(1 + below(limit));
}

unsigned FuzzRun::random_instruction() {
  static constexpr unsigned kCodes[] = {1, 2, 2, 3, 4, 4, 4, 7, 0, 0, 5, 6};
  unsigned byte = kCodes[below(12)] << 1U | host_.banks();
  if (one_in(3)) byte |= reg::AGS::kMask;
  if (one_in(12)) byte |= reg::INIT::kMask;
  if (one_in(6)) byte |= reg::BREAK::kMask;
  if (one_in(6)) byte ^= reg::SWBANK::kMask;
  if (one_in(6)) byte ^= reg::HOLDBANK::kMask;
  return byte;
}

void FuzzRun::getsens() {
  host_.pin(Pin::kGetsens, "GETSENS", true);
  host_.wait_ns(one_in(4) ? below(20'000) : 2 * host_.clock_ns());
  if (one_in(8)) return;  // stays 1
  host_.pin(Pin::kGetsens, "GETSENS", false);
}

void FuzzRun::random_registers() {
  const auto put = [&](unsigned address, unsigned value) {
    host_.write(address, {static_cast<std::uint8_t>(value)});
  };
  switch (below(16)) {
    case 0:
      put(reg::kAddrSlaveCfg + below(32), byte());
      break;
    case 1: {  // data channels as no slave is
      const unsigned x = below(8);
      host_.write(reg::slave_cfg_address(x + 1), {byte(), byte(), byte(), byte()});
      break;
    }
    case 2:
      put(reg::kAddrFreq, one_in(20) ? byte() : below(2) << 5U | below(one_in(6) ? 32 : 4));
      break;
    case 3:
      put(reg::kAddrFreqags, random_freqags());
      break;
    case 4:
      put(reg::kAddrCtrl, one_in(2) ? byte() : 0xC0U | below(4));
      break;
    case 5:
      put(reg::kAddrCfgch, one_in(2) ? byte() : chip_.fit[reg::kAddrCfgch]);
      break;
    case 6:
      put(reg::kAddrSlaveloc5, byte());
      break;
    case 7:
      put(reg::kAddrChsel, byte());
      break;
    case 8:
      put(reg::kAddrActnsens, one_in(2) ? byte() : chip_.fit[reg::kAddrActnsens]);
      break;
    case 9:
      put(reg::kAddrMoBusy, one_in(8) ? byte() : below(12));
      break;
    case 10:
      put(reg::kAddrBankcfg, byte());
      break;
    case 11:  // force bits, CFGIF, CLKENI
      put(reg::kAddrIface, (one_in(2) ? byte() & kForceBits : 0U) |
                               (one_in(4) ? below(4) << 2U : 0U) | (one_in(8) ? 0x02U : 0U) |
                               (chip_.f_clk_hz == 0 ? !one_in(6) : one_in(4)));
      break;
    case 12:
      host_.write(reg::kAddrRegadr,
                  {static_cast<std::uint8_t>(one_in(2) ? byte() : below(2) << 7U | 0x20U),
                   static_cast<std::uint8_t>(one_in(16) ? byte() : below(3))});
      break;
    case 13: {
      std::vector<std::uint8_t> bytes(1 + below(16));
      for (auto& value : bytes) value = byte();
      host_.write(one_in(2) ? below(0x40) : 0x80 + below(0x30), bytes);
      break;
    }
    case 14:
      host_.write(reg::kAddrSvalidLo, {byte(), byte()});
      break;
    default:
      put(0x40 + below(0xB4), byte());
      break;
  }
}

void FuzzRun::random_pin() {
  switch (below(8)) {
    case 0:
      host_.pin(Pin::kNer, "NER", one_in(2));
      break;
    case 1:
    case 2:
    case 3:
      getsens();
      break;
    case 4:
      if (!chip_.lines[0].present) host_.pin(Pin::kSl1, "SL1", one_in(2));
      if (!chip_.lines[1].present) host_.pin(Pin::kSl2, "SL2_NSL1", one_in(2));
      break;
    case 5:
      if (chip_.f_clk_hz != 0) break;
      for (unsigned edges = 2 * below(12); edges > 0; --edges) {
        host_.pin(Pin::kClk, "CLK", edges % 2 == 0);
        host_.wait_ns(20 + below(80));
      }
      break;
    case 6:
      if (!one_in(3)) break;
      count(FuzzCounts::kResets);
      host_.reset(250 + below(2000));
      if (chip_.f_clk_hz == 0 && !one_in(4)) host_.write(reg::kAddrIface, {reg::CLKENI::kMask});
      if (one_in(2)) configure();
      break;
    default:
      short_spi_frame();
      break;
  }
}

// NCS rises in the middle of a byte.
void FuzzRun::short_spi_frame() {
  if (chip_.parallel) return;
  static constexpr std::uint8_t kOpcodes[] = {0x02, 0x03, 0x05, 0x07, 0x09, 0x0B};
  const unsigned bits = below(16);  // opcode and a part of a byte
  const std::uint32_t word = static_cast<std::uint32_t>(kOpcodes[below(6)]) << 8U | byte();
  host_.pin(Pin::kNcs, "NCS", false);
  host_.wait_ns(20);
  for (unsigned bit = 0; bit < bits; ++bit) {
    host_.pin(Pin::kDb0, "DB0", ((word >> (15 - bit)) & 1U) != 0);
    host_.wait_ns(15);
    host_.pin(Pin::kAle, "ALE", true);
    host_.wait_ns(15);
    host_.pin(Pin::kAle, "ALE", false);
  }
  host_.wait_ns(20);
  host_.pin(Pin::kDb0, "DB0", false);
  host_.pin(Pin::kNcs, "NCS", true);
  host_.wait_ns(20);
}

// A register access or a command, on lines that fit it or not.
void FuzzRun::ask_for_access() {
  const bool biss_b = one_in(3);
  const bool write = one_in(2);
  if (one_in(2)) {
    host_.write(reg::kAddrRdata,
                {static_cast<std::uint8_t>(one_in(2) ? 0 : reg::kWnrWrite), byte(), byte()});
  }
  host_.write(reg::kAddrRegadr,
              {static_cast<std::uint8_t>((write ? 0x80U : 0U) | (0x20 + below(20))),
               static_cast<std::uint8_t>(below(3)), static_cast<std::uint8_t>(below(4))});
  const unsigned kept = host_.written(reg::kAddrCtrl) & 0x03U;
  host_.write(reg::kAddrCtrl,
              {static_cast<std::uint8_t>(kept | (biss_b ? 0U : 0x40U) | (one_in(4) ? 0U : 0x80U) |
                                         (one_in(3) ? below(8) << 3U : 0U))});
  host_.instruct(host_.banks() | (one_in(4) ? reg::kInstrControlReduced : reg::kInstrControl) |
                 (one_in(2) ? reg::AGS::kMask : 0U));
}

void FuzzRun::wild_operation() {
  switch (below(12)) {
    case 0:
    case 1:
    case 2:
      random_registers();
      break;
    case 3:
    case 4:
    case 5:
      host_.instruct(random_instruction());
      break;
    case 6:
      random_pin();
      break;
    case 7:
      ask_for_access();
      break;
    case 8: {
      unsigned first = random_instruction();
      unsigned second = random_instruction();
      if (one_in(4)) {
        first |= reg::BREAK::kMask;
        second = (second & ~reg::BREAK::kMask) | reg::INIT::kMask;
      }
      host_.instruct_twice(first, second);
      break;
    }
    case 9: {
      const unsigned address = below(0x100);
      host_.read(address, 1 + below(12));
      if (one_in(2)) host_.read(reg::scdata_address(5), 1 + below(20));
      break;
    }
    default:
      random_wait();
      break;
  }
  if (one_in(2)) random_wait();
}

void FuzzRun::wild_phase() {
  if (one_in(2)) configure();
  for (unsigned left = 4 + below(24); left > 0; --left) {
    count(FuzzCounts::kOperations);
    wild_operation();
  }
}

}  // namespace mb4test
