// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A chip whose registers the test sets directly for the slaves of a scenario, for any protocol
// (Tables 8 to 19, 35, 36, 39, 40), and a record of its line pins.
#ifndef TESTS_SUPPORT_PROTOCOL_CHIP_HPP_
#define TESTS_SUPPORT_PROTOCOL_CHIP_HPP_

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/chip_fixture.hpp"
#include "tests/support/control_host.hpp"

namespace mb4test {

// What the host sets beside the slaves.
struct ChipPlan {
  unsigned freqs = 0;
  unsigned freqr = 5;
  bool biss_c_registers = true;  // REGVERS
  bool en_mo = false;
  unsigned mo_busy = 0;
  bool holdcdm = false;
  std::uint8_t freqags = reg::kFreqagsAgsMin;
};

// Table 35, in system clocks.
inline unsigned ma_clocks(unsigned freqs) {
  if (freqs < 0x10) return 2 * (freqs + 1);
  return freqs == 0x11 ? 40 : 20 * (freqs - 15);
}

// SELCRCS and SCRCLEN or SCRCPOLY (Tables 13 to 15) for a full polynomial.
inline std::uint8_t crc_register(std::uint32_t polynomial) {
  if (polynomial == 0) return 0;
  if (polynomial == 0x190D9) return 0x10;
  if (polynomial == 0x12F) return 0x08;
  return static_cast<std::uint8_t>(0x80 | (polynomial >> 1U));
}

// A change of a line pin.
struct PinEdge {
  sim::Time time = 0;
  bool level = false;
};

// What ProtocolChip::svalid() returns if SVALIDx is 1 for these x and 0 for all others.
inline unsigned valid(std::initializer_list<unsigned> slaves) {
  unsigned bits = 0;
  for (const unsigned x : slaves) {
    const unsigned byte = reg::kFamilySvalid.address(x) - reg::kAddrSvalidLo;
    bits |= unsigned{reg::kFamilySvalid.mask(x)} << 8U * byte;
  }
  return bits;
}

class ProtocolChip : public Chip {
 public:
  static constexpr sim::Time kClk = 50 * sim::kPsPerNs;  // 20 MHz

  explicit ProtocolChip(const std::string& scenario, const ChipPlan& plan = {}) : Chip(scenario) {
    unsigned cfgch = 0x0F;
    unsigned actnsens = 0;
    for (const sim::ChannelConfig& channel : simulator.scenario().channels) {
      unsigned x = channel.number == 1 ? 0 : 4;
      for (const sim::SlaveConfig& slave : channel.slaves) {
        const sim::DeviceTraits traits = slave.traits();
        std::uint8_t bit7 = 0;
        if (traits.stop_bit) bit7 = reg::kLstopWith;
        if (traits.gray) bit7 = reg::kGraysGray;
        actnsens |= static_cast<unsigned>(traits.actuator) << x;
        const sim::Crc& crc = slave.crc();
        write(reg::slave_cfg_address(++x),
              {static_cast<std::uint8_t>(bit7 | reg::kEnscdYes | (slave.data_bits() - 1)),
               crc_register(crc.polynomial), static_cast<std::uint8_t>(crc.start & 0xFF),
               static_cast<std::uint8_t>(crc.start >> 8U)});
      }
      const std::string_view protocol = channel.protocol().key;
      const unsigned code = protocol == "biss-b" ? 0 : protocol == "biss-c" ? 1 : 2;
      const unsigned shift = channel.number == 1 ? 0 : 2;
      cfgch = (cfgch & ~(3U << shift)) | code << shift;
    }
    ctrl_ = (plan.biss_c_registers ? reg::kRegversBissC : 0U) | (plan.en_mo ? reg::kEnMoData : 0U) |
            (plan.holdcdm ? reg::kHoldcdmHold : 0U);
    write(reg::kAddrCtrl,
          {static_cast<std::uint8_t>(ctrl_),
           static_cast<std::uint8_t>(reg::FREQR::of(plan.freqr) | reg::FREQS::of(plan.freqs)),
           reg::kNocrcDropped, plan.freqags, static_cast<std::uint8_t>(plan.mo_busy)});
    write(reg::kAddrSlaveloc5,
          {static_cast<std::uint8_t>(simulator.line(2) != nullptr
                                         ? reg::kResetSlaveloc5 | reg::kSlaveloc5Split
                                         : reg::kResetSlaveloc5),
           static_cast<std::uint8_t>(cfgch), 0x00, static_cast<std::uint8_t>(actnsens)});
    t_ma = ma_clocks(plan.freqs) * kClk;
    t_mar = t_ma << (plan.freqr + 1);
    advance_us(5);  // the memories are cleared
  }

  // INSTR; waits for EOT and for all slaves, recording MA and MO. False if it does not end.
  bool frame(std::uint8_t instr = reg::kInstrCdm0) {
    const bool ended = run(instr);
    simulator.run_while_waiting([&] { return idle(); }, simulator.now() + sim::kPsPerSecond);
    return ended;
  }
  bool run(std::uint8_t instr, std::uint64_t limit_us = 20'000'000) {
    for (unsigned line = 0; line < 2; ++line) {
      ma[line].clear();
      mo[line].clear();
      seen_ma_[line] = simulator.pin(kMaPins[line]);
      seen_mo_[line] = simulator.pin(kMoPins[line]);
    }
    instruct(instr);
    const sim::Time begin = simulator.now() + 400 * sim::kPsPerNs;
    return simulator.run_while_waiting(
        [&] {
          record();
          return simulator.now() >= begin && simulator.pin(sim::Pin::kEot);
        },
        simulator.now() + limit_us * sim::kPsPerUs);
  }
  bool idle() {
    record();
    for (const unsigned line : {1U, 2U}) {
      if (simulator.line(line) == nullptr) continue;
      if (!clocked(simulator.line(line))->chain().idle() || !clocked(simulator.line(line))->sl())
        return false;
    }
    return true;
  }

  // SCDATAx, x = 1 to 8.
  std::uint64_t scdata(unsigned x) {
    const auto bytes = read(reg::scdata_address(x), 8);
    std::uint64_t word = 0;
    for (unsigned i = 0; i < 8; ++i) word |= std::uint64_t{bytes[i]} << (8 * i);
    return word;
  }
  // The low bits of SCDATAx.
  std::uint64_t scdata(unsigned x, unsigned bits) {
    const std::uint64_t word = scdata(x);
    return bits == 64 ? word : word & ((std::uint64_t{1} << bits) - 1);
  }
  void write_scdata(unsigned x, std::uint64_t word) {
    std::vector<std::uint8_t> tx{reg::kSpiOpcodeWriteRegisters, reg::scdata_address(x)};
    for (unsigned i = 0; i < 8; ++i) tx.push_back(static_cast<std::uint8_t>(word >> (8 * i)));
    spi(tx);
    advance_us(1);
  }
  // Both bytes of SVALID; valid() makes the value to compare with.
  unsigned svalid() {
    const auto status = spi({reg::kSpiOpcodeReadStatus, 0, 0, 0});
    return status[2] | status[3] << 8U;
  }

  // BiSS B registers (REGVERS = 0): REGADR, WNR, REGNUM, SLAVEID.
  void set_access(unsigned id, unsigned address, unsigned count, bool write_access) {
    write(reg::kAddrRegadr,
          {static_cast<std::uint8_t>((write_access ? reg::kWnrWrite : 0) | address),
           static_cast<std::uint8_t>(count - 1)});
    write(reg::kAddrCtrl, {static_cast<std::uint8_t>(ctrl_ | reg::SLAVEID::of(id))});
  }
  void write_rdata(const std::vector<std::uint8_t>& bytes) {
    std::vector<std::uint8_t> tx{reg::kSpiOpcodeWriteRegisters, reg::kAddrRdata};
    tx.insert(tx.end(), bytes.begin(), bytes.end());
    spi(tx);
    advance_us(1);
  }

  // Edges at the chip's pins since run(), by line.
  std::vector<PinEdge> ma[2];
  std::vector<PinEdge> mo[2];
  sim::Time t_ma = 0;
  sim::Time t_mar = 0;

 private:
  static constexpr sim::Pin kMaPins[] = {sim::Pin::kMa1, sim::Pin::kMa2};
  static constexpr sim::Pin kMoPins[] = {sim::Pin::kMo1, sim::Pin::kMo2};

  void record() {
    for (unsigned line = 0; line < 2; ++line) {
      record(kMaPins[line], seen_ma_[line], ma[line]);
      record(kMoPins[line], seen_mo_[line], mo[line]);
    }
  }
  void record(sim::Pin pin, bool& seen, std::vector<PinEdge>& edges) {
    const bool level = simulator.pin(pin);
    if (level == seen) return;
    seen = level;
    edges.push_back({simulator.now(), level});
  }

  unsigned ctrl_ = 0;
  bool seen_ma_[2] = {true, true};
  bool seen_mo_[2] = {false, false};
};

}  // namespace mb4test

#endif  // TESTS_SUPPORT_PROTOCOL_CHIP_HPP_
