// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Fields of a generated table (regmap/generated/*/*_regs_table.hpp) as those of a RegisterMap.
#ifndef MB4SIM_TOOL_REGISTER_TABLE_HPP_
#define MB4SIM_TOOL_REGISTER_TABLE_HPP_

#include <cstddef>
#include <cstdint>

#include "session.hpp"

namespace mb4::tool {

// `info`: an entry of kFields; `codes`: kCodes of the same table; `word`: the whole register.
template <typename Info, typename Codes>
RegisterMap::Field field_of(const Info& info, const Codes& codes, std::uint32_t word) {
  RegisterMap::Field field;
  field.name = info.name;
  field.alternate = info.alternate == nullptr ? "" : info.alternate;
  field.address = info.address;
  field.lsb = info.lsb;
  field.width = info.width;
  field.word = word;
  field.description = info.description;
  field.reset = info.reset;
  for (std::size_t i = 0; i < info.codes; ++i) {
    const auto& code = codes[info.first_code + i];
    field.codes.push_back({code.first, code.last, code.name, code.meaning});
  }
  return field;
}

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_REGISTER_TABLE_HPP_
