// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A BiSS C control communication as it stands on the lines: one CDM bit and one CDS bit a frame,
// from the start bit S on. Written from the datasheet (pages 27 to 29) and decisions 31 and 12; the
// CDS of a frame answers the CDM of the frame before.
#ifndef TESTS_BLOCK_BISS_CONTROL_SCRIPT_HPP_
#define TESTS_BLOCK_BISS_CONTROL_SCRIPT_HPP_

#include <cstdint>
#include <string>
#include <vector>

#include "places.hpp"
#include "tests/block/biss/frame_bench.hpp"

namespace mb4test {

inline constexpr std::uint32_t kControlCrc = 0x13;

struct ControlAccess {
  bool command = false;
  // Registers
  bool write = false;
  unsigned id = 0, address = 0;
  std::vector<unsigned> bytes;  // 1 to 64, written or in the slave
  std::vector<unsigned> busy;   // frames for which the slave does not answer S, for each byte
  // Commands
  unsigned ids = 0, cmd = 0;  // IDS0 is bit 7
  bool tested = false;

  // A command has its number and whether it is answered in the lowest bits.
  std::uint32_t port() const {
    if (command) return cmd << 1 | (tested ? 1U : 0U);
    namespace at = places::biss_pkg::access_t;
    return static_cast<std::uint32_t>(at::kCts(1) | at::kWrite(write) | at::kAddr(address) |
                                      at::kByteLast(bytes.size() - 1) | at::kId(id));
  }
};

// Registers: 1 to `longest` of them.
inline ControlAccess random_access(Dice& dice, bool write, unsigned longest) {
  ControlAccess made;
  made.write = write;
  made.id = dice.below(8);
  made.address = dice.below(128);
  for (unsigned i = 1 + dice.below(longest); i > 0; --i) {
    made.bytes.push_back(dice.below(256));
    made.busy.push_back(dice.below(4));
  }
  return made;
}

// Strings with one character a frame. place: 'h' header, 'w' S is awaited, 's' S comes, 'd' data or
// acknowledge, 'p' stop bit, 'z' after it. byte: of a register access, from 0 on.
struct ControlScript {
  std::string cdm, cds, place;
  std::vector<unsigned> byte;

  void add(const std::string& cdm_bits, const std::string& cds_bits, char where,
           unsigned byte_number = 0) {
    cdm += cdm_bits;
    cds += cds_bits;
    place += std::string(cdm_bits.size(), where);
    byte.resize(place.size(), byte_number);
  }
};

inline ControlScript script_of(const ControlAccess& access) {
  ControlScript script;
  // S, header and its CRC; IDL shows one slave.
  const std::string fields = access.command
                                 ? "0" + bits_of(access.ids, 8) + bits_of(access.cmd, 2)
                                 : "1" + bits_of(access.id, 3) + bits_of(access.address, 7);
  script.add("1", "0", 'h');
  script.add(line_word(std::stoull(fields, nullptr, 2), 11, kControlCrc), "100000000000000", 'h');
  if (access.command) {
    const std::string ida = bits_of(access.ids, 8);
    if (access.ids == 0) {
      script.add("1", "0", 'd');
      script.add("0", "0", 'p');
    } else if (!access.tested) {
      script.add("1", "0", 'd');  // EX
      script.add("0", ida.substr(0, 1), 'p');
      script.add("0000000", ida.substr(1), 'z');
    } else {
      script.add("0", "0", 'd');
      script.add("00000001", ida, 'd');  // EX with the last acknowledge
      script.add("0", "0", 'p');
    }
    return script;
  }
  const std::string r = access.write ? "0" : "1";
  const std::string w = access.write ? "1" : "0";
  script.add(r + w + "1", "0" + r + w, 'h');
  for (unsigned i = 0; i < access.bytes.size(); ++i) {
    const std::string word = line_word(access.bytes[i], 8, kControlCrc);
    const std::string sent = access.write ? word : std::string(12, '0');
    const bool last = i + 1 == access.bytes.size();
    script.add(std::string(access.busy[i], '1'), std::string(access.busy[i], '0'), 'w', i);
    script.add(sent.substr(0, 1), "1", 's', i);
    script.add(sent.substr(1), word.substr(0, 11), 'd', i);  // CDS is a bit behind
    script.add("0", word.substr(11), 'p', i);
    script.add(last ? "0" : "1", "0", 'z', i);
  }
  return script;
}

}  // namespace mb4test

#endif  // TESTS_BLOCK_BISS_CONTROL_SCRIPT_HPP_
