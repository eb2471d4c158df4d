// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/register_bytes.hpp"

#include <set>
#include <string>
#include <string_view>

#include "sim/core/number_text.hpp"

namespace mb4::sim {
namespace {

std::string hex_byte(std::uint64_t value) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  return std::string("0x") + kDigits[(value >> 4U) & 0xFU] + kDigits[value & 0xFU];
}

}  // namespace

void read_bytes(const TomlReader& reader, const TomlValue& table, std::uint64_t last,
                const std::function<void(std::uint8_t, std::uint8_t)>& put) {
  std::set<std::uint64_t> given;
  for (const auto& [key, where, given_value] : table.entries) {
    const auto address = parse_word(key);
    if (!address || *address > last) {
      reader.fail_at(where, key, "expected a register address of 0x00 to " + hex_byte(last));
    }
    std::uint64_t at = *address;
    const auto put_byte = [&, &name = key](const TomlValue& value) {
      if (!value.within(0, 0xFF)) reader.fail_at(value.where, name, "expected bytes of 0 to 255");
      if (at > last) reader.fail_at(value.where, name, "runs past register " + hex_byte(last));
      if (!given.insert(at).second) {
        reader.fail_at(value.where, name, "register " + hex_byte(at) + " is given twice");
      }
      put(static_cast<std::uint8_t>(at++), static_cast<std::uint8_t>(value.integer));
    };
    if (given_value.is(TomlValue::Kind::kArray)) {
      for (const TomlValue& value : given_value.items) put_byte(value);
    } else {
      put_byte(given_value);
    }
  }
}

void read_registers(TomlReader& reader, std::map<std::uint8_t, std::uint8_t>& registers) {
  const TomlValue* table = reader.table("registers");
  if (table == nullptr) return;
  read_bytes(reader, *table, kLastRegister,
             [&](std::uint8_t address, std::uint8_t value) { registers[address] = value; });
}

}  // namespace mb4::sim
