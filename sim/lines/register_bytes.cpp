// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/register_bytes.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "sim/core/number_text.hpp"

namespace mb4::sim {
namespace {

constexpr std::uint64_t kLastRegister = 0xFF;

std::string hex_byte(std::uint64_t value) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  return std::string("0x") + kDigits[(value >> 4U) & 0xFU] + kDigits[value & 0xFU];
}

}  // namespace

std::vector<std::pair<const toml::key*, const toml::node*>> in_order(const toml::table& table) {
  std::vector<std::pair<const toml::key*, const toml::node*>> entries;
  for (auto&& [key, node] : table) entries.emplace_back(&key, &node);
  std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    return a.first->source().begin < b.first->source().begin;
  });
  return entries;
}

void read_bytes(const TomlReader& reader, const toml::table& table, std::uint64_t last,
                const std::function<void(std::uint8_t, std::uint8_t)>& put) {
  std::set<std::uint64_t> given;
  for (const auto& [key_entry, node_entry] : in_order(table)) {
    const toml::key& key = *key_entry;
    const auto address = parse_word(key.str());
    if (!address || *address > last) {
      reader.fail_at(key.source(), key.str(),
                     "expected a register address of 0x00 to " + hex_byte(last));
    }
    std::uint64_t at = *address;
    const auto put_byte = [&](const toml::node& value) {
      const auto* integer = value.as_integer();
      if (integer == nullptr || integer->get() < 0 || integer->get() > 0xFF) {
        reader.fail_at(value.source(), key.str(), "expected bytes of 0 to 255");
      }
      if (at > last)
        reader.fail_at(value.source(), key.str(), "runs past register " + hex_byte(last));
      if (!given.insert(at).second) {
        reader.fail_at(value.source(), key.str(), "register " + hex_byte(at) + " is given twice");
      }
      put(static_cast<std::uint8_t>(at++), static_cast<std::uint8_t>(integer->get()));
    };
    if (const auto* list = node_entry->as_array()) {
      for (const auto& value : *list) put_byte(value);
    } else {
      put_byte(*node_entry);
    }
  }
}

void read_registers(TomlReader& reader, std::map<std::uint8_t, std::uint8_t>& registers) {
  const toml::table* table = reader.table("registers");
  if (table == nullptr) return;
  read_bytes(reader, *table, kLastRegister,
             [&](std::uint8_t address, std::uint8_t value) { registers[address] = value; });
}

}  // namespace mb4::sim
