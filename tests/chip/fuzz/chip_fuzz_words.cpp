// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Checks the words. A phase begins with a configuration that fits the slaves, BREAK and SVALID = 0
// in both banks. After that no write changes the configuration, so every valid word must be one
// that its slave has sent. The host writes SCDATA only under HOLDBANK = 1 and clears SVALIDx
// first: a word that the host has written is never valid.
#include <algorithm>
#include <variant>

#include "mb4_regs.hpp"
#include "sim/masters/mb4/ma_frequency.hpp"
#include "tests/chip/fuzz/chip_fuzz_run.hpp"
#include "tests/support/bits.hpp"

namespace mb4test {
namespace {

namespace reg = mb4::regs;
namespace sim = mb4::sim;

constexpr unsigned kSettleClocks = 30;
constexpr unsigned kLeastCrc = 5;  // bits, of a channel whose words are looked at
constexpr unsigned kSureCrc = 12;  // bits; an alias is too rare to explain a wrong word

bool valid(const std::vector<std::uint8_t>& svalid, unsigned channel) {
  return (svalid[channel / 4] >> (2 * (channel % 4) + 1) & 1U) != 0;
}

}  // namespace

bool LineRecord::level_at(sim::Time time) const {
  const auto later = std::upper_bound(edges.begin(), edges.end(), time,
                                      [](sim::Time t, const auto& edge) { return t < edge.first; });
  return later == edges.begin() || std::prev(later)->second;
}

bool LineRecord::has_brought(const std::string& bits, sim::Time period) const {
  const std::size_t change = bits.find_first_not_of(bits[0]);
  if (change == std::string::npos) return true;
  constexpr unsigned kParts = 8;
  for (const auto& [time, level] : edges) {
    if (level != (bits[change] == '1')) continue;
    // The bit `change` is taken within one period after this edge.
    for (unsigned part = 0; part < kParts; ++part) {
      const sim::Time first = time + period * part / kParts;
      if (first < change * period) continue;
      const sim::Time start = first - change * period;
      std::size_t at = 0;
      while (at < bits.size() && level_at(start + at * period) == (bits[at] == '1')) ++at;
      if (at == bits.size()) return true;
    }
  }
  return false;
}

// False: the clock stands still.
bool FuzzRun::begin_words() {
  ensure_clock();
  host_.pin(sim::Pin::kGetsens, "GETSENS", false);
  const unsigned clkeni = chip_.f_clk_hz == 0 ? reg::CLKENI::kMask
                                              : host_.written(reg::kAddrIface) & reg::CLKENI::kMask;
  host_.write(reg::kAddrIface, {static_cast<std::uint8_t>(clkeni)});
  configure();
  misfit_ = {};
  for (unsigned line = 0; line < 2; ++line) {
    const auto& slaves = chip_.lines[line].slaves;
    if (slaves.empty() || !one_in(6)) continue;
    // The length of a slave differs from its data channel's, or a data channel has no slave.
    const FuzzSlave& slave = slaves[below(static_cast<unsigned>(slaves.size()))];
    const unsigned channel = one_in(2) ? slave.channel : 4 * line + below(4);
    misfit_[line] = 1U << channel;
    host_.write(reg::slave_cfg_address(channel + 1),
                {static_cast<std::uint8_t>(0x40U | below(64))});
  }
  host_.instruct(reg::BREAK::kMask);
  if (!host_.wait_clocks(kSettleClocks + 2 * host_.possible().ma_clocks)) return false;
  host_.at_rest();
  for (const unsigned bank : {unsigned{reg::SWBANK::kMask}, 0U}) {
    host_.write(reg::kAddrSvalidLo, {0, 0});
    if (!host_.wait_clocks(kSettleClocks)) return false;
    const auto svalid = host_.read(reg::kAddrSvalidLo, 2);
    if (svalid[0] != 0 || svalid[1] != 0) fail("SVALID", "is not 0 after 0 was written");
    host_.instruct(bank);
    if (!host_.wait_clocks(kSettleClocks)) return false;
  }
  clock_changed_ = chip_.clk_changes;
  return true;
}

void FuzzRun::word_phase() {
  if (!begin_words()) return;
  count(FuzzCounts::kWordPhases);
  for (unsigned left = 8 + below(32); left > 0; --left) {
    count(FuzzCounts::kOperations);
    if (!word_operation()) return;
    if (one_in(2)) host_.wait_ns(1 + below(one_in(3) ? 40'000 : 6000));
  }
  read_words();
}

// False: the phase is over.
bool FuzzRun::word_operation() {
  const unsigned keep =
      host_.written(reg::kAddrInstr) &
      (reg::AGS::kMask | reg::INSTR::kMask | reg::SWBANK::kMask | reg::HOLDBANK::kMask);
  const unsigned again =
      (keep & reg::AGS::kMask) != 0 || one_in(4) ? keep : keep & ~reg::INSTR::kMask;
  switch (below(22)) {
    case 0:
    case 1:
    case 2: {
      static constexpr unsigned kCodes[] = {1, 2, 2, 3, 4, 7};
      host_.instruct(host_.banks() | kCodes[below(6)] << 1U | (one_in(3) ? reg::AGS::kMask : 0U));
      return true;
    }
    case 3:
      host_.instruct(host_.banks() | reg::AGS::kMask);
      return true;
    case 4:
    case 5:
      if (!host_.simulator().pin(sim::Pin::kEot)) count(FuzzCounts::kSwbankInFrame);
      host_.instruct(again ^ reg::SWBANK::kMask);
      return true;
    case 6:
      host_.instruct(again ^ reg::HOLDBANK::kMask);
      return true;
    case 7:
      return write_scdata();
    case 8:
      host_.write(reg::kAddrSvalidLo, {byte(), byte()});
      return true;
    case 9:
      host_.instruct(host_.banks() | reg::BREAK::kMask | (one_in(2) ? reg::AGS::kMask : 0U) |
                     (one_in(3) ? 4U : 0U) | (one_in(4) ? reg::INIT::kMask : 0U));
      return true;
    case 10:
      host_.instruct(host_.banks() | reg::INIT::kMask | (one_in(3) ? reg::AGS::kMask : 0U));
      return true;
    case 11: {
      const unsigned clkeni = host_.written(reg::kAddrIface) & reg::CLKENI::kMask;
      const bool change = chip_.f_clk_hz != 0 && one_in(6);
      clock_changed_ = clock_changed_ || change;
      host_.write(reg::kAddrIface,
                  {static_cast<std::uint8_t>((one_in(3) ? byte() & kForceBits : 0U) |
                                             (change ? clkeni ^ reg::CLKENI::kMask : clkeni))});
      return true;
    }
    case 12:
      if (one_in(2)) {
        host_.write(reg::kAddrFreqags, {static_cast<std::uint8_t>(random_freqags())});
      } else {
        getsens();
      }
      return true;
    case 13:
      ask_for_access();
      return true;
    default: {
      // A frame has time to end, or nearly so.
      host_.instruct(host_.banks() | reg::kInstrCdm0);
      const std::uint64_t clocks =
          std::uint64_t{host_.possible().frame_periods} * host_.possible().ma_clocks;
      host_.wait_ns((clocks * (50 + below(100)) / 100 + 100) * host_.clock_ns());
      return read_words();
    }
  }
}

bool FuzzRun::write_scdata() {
  if ((host_.written(reg::kAddrBankcfg) & reg::SINGLEBANK::kMask) != 0) return true;
  if (!host_.wait_clocks(kSettleClocks)) return false;
  const unsigned keep = host_.written(reg::kAddrInstr) & (reg::AGS::kMask | reg::SWBANK::kMask);
  host_.instruct(keep | reg::HOLDBANK::kMask);
  if (!host_.wait_clocks(kSettleClocks)) return false;
  const unsigned x = below(8);
  const unsigned clear = ~(1U << (2 * x + 1));
  host_.write(reg::kAddrSvalidLo,
              {static_cast<std::uint8_t>(clear), static_cast<std::uint8_t>(clear >> 8U)});
  std::vector<std::uint8_t> bytes(1 + below(8));
  for (auto& value : bytes) value = one_in(2) ? 0x22 : byte();
  host_.write(reg::scdata_address(x + 1), bytes);
  return host_.wait_clocks(kSettleClocks + 8 * bytes.size());
}

bool FuzzRun::read_words() {
  if (!host_.wait_clocks(kSettleClocks)) return false;
  if ((host_.written(reg::kAddrBankcfg) & reg::SINGLEBANK::kMask) != 0) {
    // One bank: only between two frames.
    host_.instruct(host_.banks());
    if (const End end = wait_end(); end != End::kDone) not_ended(end);
    compare_words();
    return true;
  }
  const unsigned written = host_.written(reg::kAddrInstr);
  const unsigned keep = written & (reg::AGS::kMask | reg::SWBANK::kMask |
                                   ((written & reg::AGS::kMask) != 0 ? reg::INSTR::kMask : 0U));
  host_.instruct(keep | reg::HOLDBANK::kMask);
  compare_words();
  if (one_in(2)) {
    if (!host_.wait_clocks(kSettleClocks)) return false;
    if (!host_.simulator().pin(sim::Pin::kEot)) count(FuzzCounts::kSwbankInFrame);
    host_.instruct((keep | reg::HOLDBANK::kMask) ^ reg::SWBANK::kMask);
    if (!host_.wait_clocks(kSettleClocks)) return false;
    compare_words();
  }
  if (!one_in(4)) {
    if (!host_.wait_clocks(kSettleClocks)) return false;
    host_.instruct(host_.written(reg::kAddrInstr) & ~reg::HOLDBANK::kMask);
  }
  return true;
}

void FuzzRun::compare_words() {
  const auto before = host_.read(reg::kAddrSvalidLo, 2);
  std::vector<std::pair<unsigned, const FuzzSlave*>> shown;
  std::vector<std::vector<std::uint8_t>> data;
  for (unsigned line = 0; line < 2; ++line) {
    for (const FuzzSlave& slave : chip_.lines[line].slaves) {
      if (slave.actuator || slave.crc.width < kLeastCrc ||
          (misfit_[line] >> slave.channel & 1U) != 0 || !valid(before, slave.channel)) {
        continue;
      }
      shown.emplace_back(line, &slave);
      data.push_back(host_.read(reg::scdata_address(slave.channel + 1), 8));
    }
  }
  if (shown.empty()) return;
  const auto after = host_.read(reg::kAddrSvalidLo, 2);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const auto& [line, slave] = shown[i];
    if (!valid(after, slave->channel)) continue;
    count(FuzzCounts::kWordsRead);
    compare_word(line, *slave, data[i]);
  }
}

void FuzzRun::compare_word(unsigned line, const FuzzSlave& slave,
                           const std::vector<std::uint8_t>& data) {
  const unsigned data_bytes = (slave.bits + 7) / 8;
  std::uint64_t word = 0;
  for (unsigned i = data_bytes; i-- > 0;) word = word << 8U | data[i];
  std::uint32_t crc = slave.crc_of(word & slave.mask());
  const unsigned crc_bytes = (slave.crc.width + 7) / 8;
  const bool stored =
      (host_.written(reg::kAddrBankcfg) & reg::NOCRC::kMask) == 0 && data_bytes + crc_bytes <= 8;
  if (stored) crc = crc_bytes == 2 ? data[7] * 256U + data[6] : data[7];
  const bool fits = word <= slave.mask() && crc == slave.crc_of(word);
  const std::uint64_t frames = host_.simulator().slave(slave.number)->frames();
  if (fits && slave.has_sent(word, frames)) return;
  // An alias was on the line like this, one bit each period of MA.
  if (fits) {
    const unsigned code = host_.written(reg::kAddrFreq) & reg::FREQS::kMask;
    const std::uint32_t inverted = ~crc & ((1U << slave.crc.width) - 1U);
    for (const std::uint64_t hz : chip_.clocks_hz) {
      const sim::Time period = sim::ma_divider(code) * sim::kPsPerSecond / hz;
      if (records_[line].has_brought(slave.line_bits(word, inverted), period)) {
        count(FuzzCounts::kAliases);
        return;
      }
    }
    if (clock_changed_ && slave.crc.width < kSureCrc) {
      count(FuzzCounts::kAliasesUnclear);
      return;
    }
  }
  fail("word", "SCDATA" + std::to_string(slave.channel + 1) + " is shown as valid, but its slave " +
                   "has not sent 0b" + to_bits(word, 64) + " with CRC 0b" +
                   to_bits(crc, slave.crc.width) + (fits ? "" : ", which do not fit each other"));
}

}  // namespace mb4test
