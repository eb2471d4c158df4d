// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/chip/fuzz/chip_fuzz_host.hpp"

#include <algorithm>

#include "mb4_regs.hpp"
#include "sim/masters/mb4/ma_frequency.hpp"

namespace mb4test {
namespace {

namespace reg = mb4::regs;
namespace sim = mb4::sim;
using mb4test::Protocol;
using sim::Pin;

// A clock that makes no edge for so long stands still: longer than the oscillator needs to take
// over from a pin CLK that has stopped (1023 of its periods).
constexpr std::uint64_t kStandsNs = 200'000;

// Two writes of 0xF4 that are so far apart are both seen.
constexpr unsigned kInstrClocks = 6;

unsigned ma_clocks(unsigned freq_register) {
  const unsigned divider = sim::ma_divider(freq_register & 0x1FU);
  return divider != 0 ? divider : 20;  // code 0x10 is not permitted
}

// Table 58: 4096 register clocks; they are MA periods times Table 36.
std::uint64_t start_bit_limit(unsigned freq_register) {
  const unsigned freqr = freq_register >> 5U;
  const unsigned periods = freqr == 7 ? 256 : 2U << freqr;
  return std::uint64_t{4096} * periods * ma_clocks(freq_register);
}

}  // namespace

FuzzHost::FuzzHost(const FuzzChip& chip, const std::filesystem::path& folder)
    : chip_(chip), session_(chip.scenario, folder) {
  const std::uint64_t slowest = *std::min_element(chip.clocks_hz.begin(), chip.clocks_hz.end());
  clock_ns_ = (1'000'000'000 + slowest - 1) / slowest;
  at_rest();
}

void FuzzHost::write(unsigned address, const std::vector<std::uint8_t>& bytes) {
  session_.write(static_cast<std::uint8_t>(address), bytes);
  for (const std::uint8_t byte : bytes) took(address++ & 0xFFU, byte);
}

std::array<std::uint8_t, 5> FuzzHost::status() {
  const auto rx = session_.spi({reg::kSpiOpcodeReadStatus, 0, 0, 0, 0, 0});
  return {rx[1], rx[2], rx[3], rx[4], rx[5]};
}

void FuzzHost::instruct(unsigned byte) {
  session_.instruct(byte);
  took(reg::kAddrInstr, static_cast<std::uint8_t>(byte));
}

void FuzzHost::instruct_twice(unsigned first, unsigned second) {
  if (!chip_.parallel) {
    instruct(first);
    instruct(second);
    return;
  }
  for (const unsigned byte : {first, second}) {
    bus_write(reg::kAddrInstr, static_cast<std::uint8_t>(byte));
    took(reg::kAddrInstr, static_cast<std::uint8_t>(byte));
  }
  wait_ns(5 * clock_ns_);
}

void FuzzHost::bus_data(unsigned value) {
  static constexpr const char* kNames[] = {"DB0", "DB1", "DB2", "DB3", "DB4", "DB5", "DB6", "DB7"};
  for (unsigned bit = 0; bit < 8; ++bit) {
    const Pin db = static_cast<Pin>(bit);
    if (const bool level = ((value >> bit) & 1U) != 0; simulator().pin(db) != level) {
      pin(db, kNames[bit], level);
    }
  }
}

// One bus cycle of the shortest times (I001 to I016, I101 to I114).
void FuzzHost::bus_write(std::uint8_t address, std::uint8_t value) {
  bus_data(address);
  pin(Pin::kNcs, "NCS", false);
  pin(Pin::kAle, "ALE", true);
  wait_ns(15);
  pin(Pin::kAle, "ALE", false);
  if (chip_.motorola) pin(Pin::kNrdRnw, "NRD_RNW", false);
  wait_ns(15);
  bus_data(value);
  pin(Pin::kNwrE, "NWR_E", chip_.motorola);
  wait_ns(15);
  pin(Pin::kNwrE, "NWR_E", !chip_.motorola);
  wait_ns(15);
  if (chip_.motorola) pin(Pin::kNrdRnw, "NRD_RNW", true);
  pin(Pin::kNcs, "NCS", true);
  bus_data(0);
}

void FuzzHost::reset(std::uint64_t low_ns) {
  pin(Pin::kNres, "NRES", false);
  wait_ns(low_ns);
  pin(Pin::kNres, "NRES", true);
  image_.fill(0);
  access_open_ = false;
  note_configuration();
}

bool FuzzHost::wait_clocks(std::uint64_t clocks) {
  const std::uint64_t end = this->clocks() + clocks;
  std::uint64_t seen = this->clocks();
  std::uint64_t still_ns = 0;
  while (seen < end) {
    const std::uint64_t ns = std::max<std::uint64_t>((end - seen) * clock_ns_ / 2, 50);
    const std::uint64_t step = std::min<std::uint64_t>(ns, kStandsNs);
    session_.wait_ns(step);
    still_ns = this->clocks() == seen ? still_ns + step : 0;
    if (still_ns >= kStandsNs) return false;
    seen = this->clocks();
  }
  return true;
}

bool FuzzHost::line_used(unsigned line) const {
  return protocol(line) != Protocol::kUnused &&
         (line == 0 || (image_[reg::kAddrSlaveloc5] & reg::SLAVELOC5::kMask) != 0);
}

Protocol FuzzHost::protocol(unsigned line) const {
  return static_cast<Protocol>((image_[reg::kAddrCfgch] >> (2 * line)) & 3U);
}

bool FuzzHost::access_can_run() const {
  const bool biss_c = (image_[reg::kAddrCtrl] & reg::REGVERS::kMask) != 0;
  const unsigned chsel = image_[reg::kAddrChsel] & reg::CHSEL::kMask;
  for (const unsigned line : {0U, 1U}) {
    if ((((chsel == 0 ? 1U : chsel) >> line) & 1U) == 0 || !line_used(line)) continue;
    if ((protocol(line) == Protocol::kBissB) != biss_c) return true;
  }
  return false;
}

void FuzzHost::took(unsigned address, std::uint8_t value) {
  image_[address] = value;
  if (address == reg::kAddrInstr) {
    image_[address] = value & static_cast<std::uint8_t>(~reg::BREAK::kMask);
    // Another write that comes too close takes the place of INIT, not that of BREAK (decision 41).
    if (lost_with_init_ && clocks() < init_clock_ + kInstrClocks) access_open_ = true;
    lost_with_init_ = access_open_ && (value & reg::INIT::kMask) != 0;
    init_clock_ = clocks();
    if ((value & (reg::BREAK::kMask | reg::INIT::kMask)) != 0) access_open_ = false;
    if ((value & reg::BREAK::kMask) != 0) lost_with_init_ = false;
    if (is_control(value)) {
      access_clean_ = rest_ && !access_open_ && (value & reg::INIT::kMask) == 0;
      access_open_ = true;
    } else {
      access_clean_ = false;
    }
  } else if (address >= 0xC0) {
    access_clean_ = false;
  }
  rest_ = rest_ && (address != reg::kAddrInstr ||
                    (value & (reg::INSTR::kMask | reg::INIT::kMask | reg::AGS::kMask)) == 0);
  note_configuration();
}

void FuzzHost::note_configuration() {
  const unsigned freq = image_[reg::kAddrFreq];
  possible_.ma_clocks = std::max(possible_.ma_clocks, ma_clocks(freq));
  possible_.limit = std::max(possible_.limit, start_bit_limit(freq));
  unsigned bits = 0;
  for (unsigned x = 1; x <= reg::kSlaves; ++x) {
    const unsigned length = image_[reg::slave_cfg_address(x)];
    constexpr unsigned kMostCrc = 16;
    if ((length & 0x40U) != 0) bits += (length & 0x3FU) + 2 + kMostCrc;
  }
  // Request, acknowledge, delay, processing time, CDS and the end.
  possible_.frame_periods =
      std::max(possible_.frame_periods, bits + image_[reg::kAddrMoBusy] + 60U);
  possible_.bytes = std::max(possible_.bytes, (image_[reg::kAddrRegnum] & reg::REGNUM::kMask) + 1U);
  for (const unsigned line : {0U, 1U}) {
    possible_.used[line] = possible_.used[line] || line_used(line);
    possible_.biss[line] =
        possible_.biss[line] || (line_used(line) && protocol(line) != Protocol::kSsi);
  }
  possible_.biss_b_control |= (image_[reg::kAddrCtrl] & reg::REGVERS::kMask) == 0;
  possible_.control_asked |=
      is_control(image_[reg::kAddrInstr]) || (image_[reg::kAddrInstr] & reg::INIT::kMask) != 0;
  const unsigned code = image_[reg::kAddrFreqags];
  possible_.agsmin |= code == reg::kFreqagsAgsMin;
  possible_.paired |= (image_[reg::kAddrIface] & reg::kCfgifRs422) != 0;
  possible_.ma_forced |= (image_[reg::kAddrIface] & kMaForced) != 0;
  possible_.ma_may_rest |=
      (image_[reg::kAddrCtrl] & reg::EN_MO::kMask) != 0 && image_[reg::kAddrActnsens] != 0;
  const std::uint64_t period = code < reg::kFreqagsAgsMin ? 20U * (code + 1U)
                               : code < 0x80              ? 0
                                                          : 625U * (code - 127U);
  possible_.ags_period = std::max(possible_.ags_period, period);
}

void FuzzHost::at_rest() {
  possible_ = {};
  note_configuration();
  rest_ = true;
}

}  // namespace mb4test
