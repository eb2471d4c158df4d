// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The DSL master's map on a bus of words, as dsl_regs and dsl_core have it.
#ifndef TESTS_BLOCK_DSL_DSL_REGISTERS_HPP_
#define TESTS_BLOCK_DSL_DSL_REGISTERS_HPP_

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>

#include "dsl_page_regs.hpp"
#include "dsl_page_regs_table.hpp"
#include "dsl_regs.hpp"
#include "dsl_regs_table.hpp"

namespace dsl_registers {

constexpr unsigned kBytes = 0x1000;
constexpr unsigned kMostClocks = 64;  // of an access

// Words that reset values and constants give, by address. Those that are 0 are left out.
inline std::map<unsigned, std::uint32_t> reset_words(bool sdk) {
  std::map<unsigned, std::uint32_t> words;
  namespace map = dsl::regs;
  const auto only_sdk = [](unsigned address) {
    return address == map::kAddrSafeCtrl || address == map::kAddrSafeSum ||
           address == map::kAddrAccErrCntThresh || address == map::kAddrMaxdevThreshH ||
           address == map::kAddrMaxdevThreshL;
  };
  const auto not_sdk = [](unsigned address) {
    return address == map::kAddrPipeS || address == map::kAddrSSlaveRegCtrl ||
           address == map::kAddrMaxacc;
  };
  for (const auto& field : dsl::regs::kFields) {
    if (sdk ? not_sdk(field.address) : only_sdk(field.address)) continue;
    std::uint32_t value = field.reset;
    if (field.address == dsl::regs::kAddrCodeVersion && sdk) value = 0x10;
    words[field.address & ~3U] |= value << (field.lsb + 8 * (field.address & 3U));
  }
  for (const auto& field : dsl::page::kFields) words[field.address] |= field.reset << field.lsb;
  // Constants.
  words[dsl::page::kAddrId] = dsl::page::kResetId;
  words[dsl::page::kAddrVersion] = dsl::page::kResetVersion;
  std::erase_if(words, [](const auto& word) { return word.second == 0; });
  return words;
}

// ---- Records ------------------------------------------------------------------------------------

constexpr unsigned kGroups = 6;
using Record = std::array<std::uint8_t, 64>;

// Where the bytes of a word stand in the record (docs/dsl.md), -1: it reads 0.
struct WordOfRecord {
  unsigned address;
  unsigned group;
  std::array<int, 4> places;
};
inline constexpr WordOfRecord kWords[] = {
    {dsl::regs::kAddrPos4, 0, {4, 3, 2, 1}},
    {dsl::regs::kAddrPos0, 0, {0, 10, 9, 8}},
    {dsl::regs::kAddrSummary, 1, {37, 36, 35, 34}},
    {dsl::regs::kAddrVpos1, 1, {33, 32, 39, 38}},
    {0x44, 2, {-1, -1, 45, 44}},
    {dsl::regs::kAddrVpos23, 2, {43, 42, 41, 40}},
    {dsl::regs::kAddrVposcrc2H, 2, {47, 46, -1, -1}},
    {dsl::page::kAddrPosLo, 3, {56, 57, 58, 59}},
    {dsl::page::kAddrPosHi, 3, {60, 61, 62, 63}},
    {dsl::page::kAddrVel, 3, {8, 9, 10, 11}},
    {dsl::page::kAddrFrameCount, 3, {16, 17, 18, 19}},
    {dsl::page::kAddrFrameTimeLo, 3, {24, 25, 26, 27}},
    {dsl::page::kAddrFrameTimeHi, 3, {28, 29, 30, 31}},
    {dsl::page::kAddrFrameStatus, 3, {20, 21, 22, 23}},
    {dsl::page::kAddrSafe1Lo, 4, {32, 33, 34, 35}},
    {dsl::page::kAddrSafe1Hi, 4, {36, -1, -1, -1}},
    {dsl::page::kAddrSafe1Check, 4, {38, 39, 37, 20}},
    {dsl::page::kAddrSafe1Age, 4, {48, 49, 50, 51}},
    {dsl::page::kAddrSafe2Lo, 5, {40, 41, 42, 43}},
    {dsl::page::kAddrSafe2Hi, 5, {44, -1, -1, -1}},
    {dsl::page::kAddrSafe2Check, 5, {46, 47, 45, 20}},
    {dsl::page::kAddrSafe2Age, 5, {52, 53, 54, 55}},
};

// The first word of a group copies the others.
inline bool is_first(const WordOfRecord& word) {
  return &word == kWords || word.group != (&word)[-1].group;
}

// Bits of a word that are of its group: POSTX stands beside the last one of the byte map.
inline std::uint32_t bits_of_group(const WordOfRecord& word) {
  return word.address == dsl::regs::kAddrVposcrc2H ? 0xFFFFU : 0xFFFF'FFFFU;
}

inline std::uint32_t word_of(const WordOfRecord& word, const Record& record) {
  constexpr int kStatus = 20;
  std::uint32_t value = 0;
  for (unsigned lane = 0; lane < 4; ++lane) {
    const int place = word.places[lane];
    if (place < 0) continue;
    unsigned byte = record[static_cast<unsigned>(place)];
    if (place == kStatus) {
      // Of a safe channel: good, error. Else without the errors of the two.
      const unsigned valid = word.group == 4 ? 3 : 4;
      const unsigned error = word.group == 4 ? 6 : 7;
      byte =
          word.group == 3 ? byte & 0x3FU : (byte >> valid & 1U) << 7U | (byte >> error & 1U) << 6U;
    }
    value |= byte << 8 * lane;
  }
  return value;
}

// ---- The bus ------------------------------------------------------------------------------------

// One access. `clock` is a clock of what has the bus.
template <typename Model, typename Clock>
std::uint32_t access(Model& m, unsigned address, bool write, std::uint32_t data, unsigned strobes,
                     const Clock& clock) {
  m.word_req_i = 1;
  m.word_write_i = write ? 1 : 0;
  m.word_addr_i = static_cast<std::uint16_t>(address / 4);
  m.word_data_i = data;
  m.word_be_i = static_cast<std::uint8_t>(strobes);
  unsigned left = kMostClocks;
  for (m.eval(); m.word_ready_o == 0; m.eval()) {
    EXPECT_NE(left, 0U) << "no answer at " << address;
    if (left-- == 0) break;
    clock();
  }
  const std::uint32_t answer = m.word_data_o;
  clock();
  m.word_req_i = 0;
  return answer;
}

}  // namespace dsl_registers

#endif  // TESTS_BLOCK_DSL_DSL_REGISTERS_HPP_
