// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The registers of a master of 32-bit words, read one by one.
#ifndef MB4SIM_TOOL_WORD_REGISTERS_HPP_
#define MB4SIM_TOOL_WORD_REGISTERS_HPP_

#include <fmt/core.h>

#include <cstdint>

#include "register_table.hpp"
#include "report/exit_status.hpp"
#include "session.hpp"
#include "word_port.hpp"

namespace mb4::tool {

// Those up to address `last`. `fields`, `codes`: kFields and kCodes of the generated table. Throws
// UseError if the master does not answer.
template <typename Fields, typename Codes>
RegisterMap read_registers(WordPort& port, unsigned last, const Fields& fields,
                           const Codes& codes) {
  RegisterMap map;
  map.bits = 32;
  for (unsigned address = 0; address <= last; address += sizeof(std::uint32_t)) {
    std::uint32_t value = 0;
    if (!port.read(address, value)) {
      throw UseError(
          fmt::format("the master does not answer at 0x{:03X}: its clock stands", address));
    }
    map.words.push_back(value);
  }
  for (const auto& field : fields) {
    map.fields.push_back(field_of(field, codes, map.words[field.address / sizeof(std::uint32_t)]));
  }
  return map;
}

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_WORD_REGISTERS_HPP_
