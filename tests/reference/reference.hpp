// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Computes what an iC-MB4 shows its host after a frame, and what it sends on MO, from the registers
// that the host wrote and the bits on the lines. The source is the datasheet (pages 14..16,
// 23..27, 31, 33..35) and decisions 8, 9, 11, 15, 16, 18, 28..30, 34, 35, 37, 43. It shares no code
// with the RTL, the simulator or the driver.
#ifndef TESTS_REFERENCE_REFERENCE_HPP_
#define TESTS_REFERENCE_REFERENCE_HPP_

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mb4test {

// CFGCHx (Table 8).
enum class Protocol : std::uint8_t { kBissB = 0, kBissC = 1, kSsi = 2, kUnused = 3 };

// Registers 0xC0..0xDF and the few others that shape a frame.
struct Registers {
  std::array<std::uint8_t, 32> slave{};
  std::array<Protocol, 2> protocol{Protocol::kBissC, Protocol::kBissC};
  std::uint8_t actnsens = 0;
  bool slaveloc5 = false;
  bool nocrc = false;
  bool singlebank = false;
};

// Bits of one line after the start bit as '0' and '1': in BiSS C CDS first, then all words in the
// order of their channels. In SSI from the second rising edge on.
struct Lines {
  std::array<std::string, 2> bits;
  // SWBANK is inverted when so many bits of line 1 have been taken, in ascending order.
  std::vector<unsigned> swaps{};
};

// One data channel's choice of CRC (Tables 13..15).
struct CrcChoice {
  unsigned width = 0;            // 0 = off
  std::uint32_t polynomial = 0;  // with its highest power
};
CrcChoice crc_choice(std::uint8_t register_c1);

// Remainder of polynomial division: data bits, MSB first, start value, bit by bit on a string.
std::uint32_t remainder(const std::string& data, CrcChoice crc, std::uint16_t start);

class Reference {
 public:
  // Bits that the enabled channels of line 1 or 2 take, stop bits of actuators included.
  static unsigned frame_bits(const Registers& registers, unsigned line);

  // A complete frame; then the banks switch (SINGLEBANK = 0), or with HOLDBANK wait to switch.
  void frame(const Registers& registers, const Lines& lines);
  // Writing HOLDBANK: 0 makes up for the switch that it has held back (Table 48).
  void hold(bool held);
  // A frame falls due while a switch is held back: with AGSERR_ON_HOLDBANK it is left out (page
  // 33).
  void omitted_frame();
  // SWBANK changes its value (Table 49).
  void swap_banks() { host_ = 1 - host_; }
  // INIT of BiSS C (decisions 16, 35): line delays of the lines in use, else nothing.
  void init(const std::array<std::optional<std::uint8_t>, 2>& quarters);
  // Lines (bit 0 = line 1) on which INSTR 100 runs by REGVERS, CHSEL, CTS and the protocols of the
  // lines, none if not in use (decisions 37, 43). 0: it ends at once with nREGERR = 0.
  static unsigned access_lines(const std::array<std::optional<Protocol>, 2>& protocol, bool regvers,
                               unsigned chsel, bool cts);
  // BREAK between two frames (decision 8).
  void clear_errors() { scd_error_ = ags_error_ = false; }

  // What the next frame sends on MO for channel `x` (0..7), an actuator: stop bit if LSTOPx, data
  // of the bank on the BiSS side, inverted CRC (pages 25, 31).
  std::string actuator_slot(const Registers& registers, unsigned x) const;
  // All slots of MO of a line, sensors as zeros.
  std::string mo_bits(const Registers& registers, unsigned line) const;

  // What the host reads.
  std::uint8_t scdata(unsigned address) const { return banks_[host_].data.at(address); }
  std::uint8_t svalid_lo() const { return spread(0); }
  std::uint8_t svalid_hi() const { return spread(4); }
  bool scd_error() const { return scd_error_; }
  bool ags_error() const { return ags_error_; }
  bool swbank_fail() const { return swbank_fail_; }
  bool cds(unsigned line) const { return banks_[host_].cds.at(line - 1); }

  // A host write to SCDATA.
  void write(unsigned address, std::uint8_t value) { banks_[host_].data.at(address) = value; }
  // A host write to SVALID, 0xF2 in the high byte: zeros clear (decision 18).
  void write_svalid(std::uint16_t value);

 private:
  struct Bank {
    std::array<std::uint8_t, 64> data{};
    std::array<bool, 8> valid{};
    std::array<bool, 2> cds{};
  };

  const Bank& engine_bank(const Registers& registers) const {
    return banks_[registers.singlebank ? host_ : 1 - host_];
  }
  std::uint8_t spread(unsigned first) const;
  void switch_banks();
  Bank& engine_bank(const Registers& registers) {
    return banks_[registers.singlebank ? host_ : 1 - host_];
  }
  // Takes channel `x` (0..7) from the front of `bits`; false if its CRC is wrong. `bank_at(n)` is
  // the bank that gets what the word's bit n (from 1) completes.
  bool word(const Registers& registers, unsigned x, std::string& bits,
            const std::function<Bank&(unsigned)>& bank_at);

  std::array<Bank, 2> banks_{};
  unsigned host_ = 0;
  bool scd_error_ = false;
  bool ags_error_ = false;
  bool held_ = false;
  bool pending_ = false;  // a switch is held back
  bool swbank_fail_ = false;
};

}  // namespace mb4test

#endif  // TESTS_REFERENCE_REFERENCE_HPP_
