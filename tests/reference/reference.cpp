// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/reference/reference.hpp"

#include <map>
#include <stdexcept>

namespace mb4test {
namespace {

bool on_line(const Registers& registers, unsigned x, unsigned line) {
  // Table 10: channels 5..8 belong to line 2 with SLAVELOC5 = 1.
  return (registers.slaveloc5 && x >= 4) == (line == 2);
}

bool enabled(const Registers& registers, unsigned x) {
  return (registers.slave[4 * x] & 0x40) != 0;
}

unsigned data_bits(const Registers& registers, unsigned x) {
  return (registers.slave[4 * x] & 0x3FU) + 1;
}

bool is_actuator(const Registers& registers, unsigned x) {
  return ((registers.actnsens >> x) & 1U) != 0;
}

// Bits of channel `x` on the line. LSTOPx is bit 7 of the same register, for actuators only.
unsigned slot_bits(const Registers& registers, unsigned x) {
  const bool stop = is_actuator(registers, x) && (registers.slave[4 * x] & 0x80) != 0;
  return data_bits(registers, x) + crc_choice(registers.slave[4 * x + 1]).width + (stop ? 1 : 0);
}

std::uint16_t crc_start(const Registers& registers, unsigned x) {
  return static_cast<std::uint16_t>(registers.slave[4 * x + 2] | (registers.slave[4 * x + 3] << 8));
}

// Each binary digit is the sum of all Gray digits up to it.
std::string binary_of_gray(const std::string& gray) {
  std::string binary;
  bool digit = false;
  for (const char bit : gray) {
    digit = digit != (bit == '1');
    binary += digit ? '1' : '0';
  }
  return binary;
}

}  // namespace

CrcChoice crc_choice(std::uint8_t register_c1) {
  const unsigned code = register_c1 & 0x7FU;
  if ((register_c1 & 0x80) != 0) {
    // Table 15: the polynomial without its last 1; its degree is the width.
    if (code == 0) return {};
    unsigned width = 0;
    for (unsigned rest = code; rest != 0; rest /= 2) ++width;
    return {width, code * 2 + 1};
  }
  static const std::map<unsigned, std::uint32_t> table14 = {
      {3, 0xB}, {4, 0x13}, {5, 0x25}, {6, 0x43}, {7, 0x89}, {8, 0x12F}, {16, 0x190D9}};
  const auto found = table14.find(code);
  return found == table14.end() ? CrcChoice{} : CrcChoice{code, found->second};
}

std::uint32_t remainder(const std::string& data, CrcChoice crc, std::uint16_t start) {
  // Long division on a string of bits: the start value is added to the first `width` bits of the
  // message with `width` zeros after it.
  std::string message = data + std::string(crc.width, '0');
  for (unsigned i = 0; i < crc.width; ++i) {
    const bool bit = ((start >> (crc.width - 1 - i)) & 1U) != 0;
    if (bit) message[i] = message[i] == '0' ? '1' : '0';
  }
  for (std::size_t i = 0; i < data.size(); ++i) {
    if (message[i] == '0') continue;
    for (unsigned k = 0; k <= crc.width; ++k) {
      if (((crc.polynomial >> (crc.width - k)) & 1U) != 0) {
        message[i + k] = message[i + k] == '0' ? '1' : '0';
      }
    }
  }
  std::uint32_t value = 0;
  for (unsigned i = 0; i < crc.width; ++i) {
    value = value * 2 + (message[data.size() + i] == '1' ? 1U : 0U);
  }
  return value;
}

unsigned Reference::frame_bits(const Registers& registers, unsigned line) {
  unsigned bits = 0;
  for (unsigned x = 0; x < 8; ++x) {
    if (enabled(registers, x) && on_line(registers, x, line)) bits += slot_bits(registers, x);
  }
  return bits;
}

std::string Reference::actuator_slot(const Registers& registers, unsigned x) const {
  const Bank& bank = engine_bank(registers);
  const unsigned length = data_bits(registers, x);
  std::string data;
  for (unsigned weight = length; weight-- > 0;) {
    data += ((bank.data[8 * x + weight / 8] >> (weight % 8)) & 1U) != 0 ? '1' : '0';
  }
  const CrcChoice crc = crc_choice(registers.slave[4 * x + 1]);
  const std::uint32_t check = remainder(data, crc, crc_start(registers, x));
  std::string slot = slot_bits(registers, x) > length + crc.width ? "0" : "";
  slot += data;
  for (unsigned i = crc.width; i-- > 0;) slot += ((check >> i) & 1U) != 0 ? '0' : '1';
  return slot;
}

std::string Reference::mo_bits(const Registers& registers, unsigned line) const {
  std::string bits;
  for (unsigned x = 0; x < 8; ++x) {
    if (!enabled(registers, x) || !on_line(registers, x, line)) continue;
    bits += is_actuator(registers, x) ? actuator_slot(registers, x)
                                      : std::string(slot_bits(registers, x), '0');
  }
  return bits;
}

bool Reference::word(const Registers& registers, unsigned x, std::string& bits,
                     const std::function<Bank&(unsigned)>& bank_at) {
  const unsigned length = data_bits(registers, x);
  const CrcChoice crc = crc_choice(registers.slave[4 * x + 1]);
  const std::uint16_t start = crc_start(registers, x);
  if (bits.size() < length + crc.width) throw std::logic_error("reference: too few bits");
  const std::string data = bits.substr(0, length);
  const std::string sent = bits.substr(length, crc.width);
  bits.erase(0, length + crc.width);
  // Table 19 and decision 29: Gray code counts on an SSI line; the CRC is over what was sent.
  const unsigned line = registers.slaveloc5 && x >= 4 ? 1 : 0;
  const bool gray =
      registers.protocol[line] == Protocol::kSsi && (registers.slave[4 * x] & 0x80) != 0;
  const std::string value_bits = gray ? binary_of_gray(data) : data;

  // Page 26: byte by byte from the least significant end, unused bits of a touched byte are zero.
  const unsigned bytes = (length + 7) / 8;
  for (unsigned byte = 0; byte < bytes; ++byte) {
    unsigned value = 0;
    for (unsigned bit = 0; bit < 8; ++bit) {
      const unsigned weight = byte * 8 + bit;
      if (weight < length && value_bits[length - 1 - weight] == '1') value |= 1U << bit;
    }
    bank_at(length - 8 * byte).data[8 * x + byte] = static_cast<std::uint8_t>(value);
  }
  if (crc.width == 0) return true;

  std::uint32_t received = 0;
  for (const char bit : sent) received = received * 2 + (bit == '0' ? 1U : 0U);  // sent inverted
  const unsigned crc_bytes = crc.width > 8 ? 2 : 1;
  if (!registers.nocrc && bytes + crc_bytes <= 8) {
    const unsigned top = length + (crc_bytes == 2 ? 8 : crc.width);
    bank_at(top).data[8 * x + 7] =
        static_cast<std::uint8_t>(crc_bytes == 2 ? received >> 8 : received);
    if (crc_bytes == 2) {
      bank_at(top + 8).data[8 * x + 6] = static_cast<std::uint8_t>(received & 0xFF);
    }
  }
  return received == remainder(data, crc, start);
}

void Reference::frame(const Registers& registers, const Lines& lines) {
  scd_error_ = false;
  // Decision 15: the frame writes over the bank whose switch is held back.
  if (pending_) swbank_fail_ = true;
  pending_ = false;
  for (unsigned line = 1; line <= 2; ++line) {
    std::string bits = lines.bits[line - 1];
    if (bits.empty()) continue;  // takes no part
    const std::vector<unsigned> swaps = line == 1 ? lines.swaps : std::vector<unsigned>{};
    std::size_t done = 0;  // inversions so far
    const std::size_t all = bits.size();
    const auto taken = [&] { return static_cast<unsigned>(all - bits.size()); };
    const auto swap_up_to = [&](unsigned position) {
      for (; done < swaps.size() && swaps[done] <= position; ++done) swap_banks();
    };
    // Page 15: CDS is BiSS C's alone.
    const bool biss_c = registers.protocol[line - 1] == Protocol::kBissC;
    const bool cds = biss_c && bits[0] == '1';
    if (biss_c) bits.erase(0, 1);
    for (unsigned x = 0; x < 8; ++x) {
      if (!enabled(registers, x) || !on_line(registers, x, line)) continue;
      if (is_actuator(registers, x)) {
        bits.erase(0, slot_bits(registers, x));  // decision 11
        continue;
      }
      const unsigned first = taken();
      swap_up_to(first);
      const std::size_t before = done;
      std::vector<Bank*> banks;  // by bit of the word: the one that it goes to
      for (unsigned bit = 0; bit < slot_bits(registers, x); ++bit) {
        swap_up_to(first + bit);
        banks.push_back(&engine_bank(registers));
      }
      const bool split = done != before;  // decision 34
      const bool good =
          word(registers, x, bits, [&](unsigned bit) -> Bank& { return *banks.at(bit - 1); }) &&
          !split;
      if (split) banks_[0].valid[x] = banks_[1].valid[x] = false;
      engine_bank(registers).valid[x] = good;
      if (!good) scd_error_ = true;
    }
    swap_up_to(~0U);
    engine_bank(registers).cds[line - 1] = cds;
  }
  if (registers.singlebank) return;
  if (held_) {
    pending_ = true;
  } else {
    switch_banks();
  }
}

void Reference::switch_banks() {
  host_ = 1 - host_;
  pending_ = false;
  swbank_fail_ = false;
}

void Reference::hold(bool held) {
  held_ = held;
  if (!held && pending_) switch_banks();
}

void Reference::omitted_frame() {
  ags_error_ = true;
  swbank_fail_ = true;
}

void Reference::init(const std::array<std::optional<std::uint8_t>, 2>& quarters) {
  for (Bank& bank : banks_) bank.valid.fill(false);
  for (unsigned line = 0; line < 2; ++line) {
    if (quarters[line]) banks_[host_].data[32 * line] = *quarters[line];
  }
  clear_errors();
}

unsigned Reference::access_lines(const std::array<std::optional<Protocol>, 2>& protocol,
                                 bool regvers, unsigned chsel, bool cts) {
  const unsigned named = chsel == 0 ? 1 : chsel;
  unsigned lines = 0;
  for (unsigned line = 0; line < 2; ++line) {
    if (((named >> line) & 1U) == 0 || !protocol[line]) continue;
    if ((*protocol[line] != Protocol::kBissB) == regvers) lines |= 1U << line;
  }
  // One line at a time carries registers of BiSS C (page 27); CTS is BiSS C's (decision 43).
  return lines == 3 && cts && regvers ? 1 : lines;
}

void Reference::write_svalid(std::uint16_t value) {
  for (unsigned x = 0; x < 8; ++x) {
    if (((value >> (2 * x + 1)) & 1U) == 0) banks_[host_].valid[x] = false;
  }
}

std::uint8_t Reference::spread(unsigned first) const {
  unsigned value = 0;
  for (unsigned i = 0; i < 4; ++i) {
    if (banks_[host_].valid[first + i]) value |= 2U << (2 * i);
  }
  return static_cast<std::uint8_t>(value);
}

}  // namespace mb4test
