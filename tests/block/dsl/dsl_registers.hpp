// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The DSL master's map on a bus of words, as dsl_regs and dsl_core have it.
#ifndef TESTS_BLOCK_DSL_DSL_REGISTERS_HPP_
#define TESTS_BLOCK_DSL_DSL_REGISTERS_HPP_

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
  const auto only_sdk = [](unsigned address) {
    return address == dsl::regs::kAddrSafeCtrl || address == dsl::regs::kAddrSafeSum ||
           address == dsl::regs::kAddrAccErrCntThresh;
  };
  for (const auto& field : dsl::regs::kFields) {
    if (only_sdk(field.address) && !sdk) continue;
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
