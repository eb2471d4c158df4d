// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/registers/register_keys.hpp"

#include <algorithm>
#include <initializer_list>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/number_text.hpp"

namespace mb4::sim {
namespace {

constexpr std::uint64_t kLastRegister = 0xFF;
constexpr std::uint64_t kLastBank = 0xFF;
constexpr std::int64_t kMaxIds = 8;
constexpr std::int64_t kMaxBusyFrames = 1'000'000;
constexpr double kMaxBusyUs = 1e6;

std::string hex_byte(std::uint64_t value) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  return std::string("0x") + kDigits[(value >> 4U) & 0xFU] + kDigits[value & 0xFU];
}

// Returns the entries from top to bottom, as the user reads them. The table is sorted by name.
std::vector<std::pair<const toml::key*, const toml::node*>> in_order(const toml::table& table) {
  std::vector<std::pair<const toml::key*, const toml::node*>> entries;
  for (auto&& [key, node] : table) entries.emplace_back(&key, &node);
  std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    return a.first->source().begin < b.first->source().begin;
  });
  return entries;
}

// Reads a byte or a list of bytes for each address, 0 to `last`. Calls put(address, value) for each
// byte.
template <typename Put>
void read_bytes(const TomlReader& reader, const toml::table& table, std::uint64_t last, Put put) {
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

void read_banks(TomlReader& reader, RegisterFile::Banks& banks) {
  const toml::table* table = reader.table("banks");
  if (table == nullptr) return;
  std::set<std::uint64_t> given;
  for (const auto& [key, node] : in_order(*table)) {
    const auto number = parse_word(key->str());
    if (!number || *number > kLastBank) {
      reader.fail_at(key->source(), key->str(), "expected a bank of 1 to 255");
    }
    if (*number == 0) {
      reader.fail_at(key->source(), key->str(), "bank 0 is registers 0x00 to 0x3F");
    }
    if (!given.insert(*number).second) {
      reader.fail_at(key->source(), key->str(),
                     "bank " + std::to_string(*number) + " is given twice");
    }
    if (!node->is_table()) {
      reader.fail_at(node->source(), key->str(), "expected a table of bytes by address");
    }
    RegisterFile::Bank& bank = banks[static_cast<std::uint8_t>(*number)];
    read_bytes(reader, *node->as_table(), RegisterFile::kBankSize - 1,
               [&bank](std::uint8_t address, std::uint8_t value) { bank[address] = value; });
  }
}

// Marks the registers of a text such as "0x44-0x47" or "0x44". Returns false if the text is wrong.
bool mark_text(std::string_view text, RegisterFile::Marks& marks) {
  const auto dash = text.find('-');
  const auto first = parse_word(text.substr(0, dash));
  const auto last = dash == std::string_view::npos ? first : parse_word(text.substr(dash + 1));
  if (!first || !last || *first > *last || *last > kLastRegister) return false;
  for (std::uint64_t address = *first; address <= *last; ++address) marks.set(address);
  return true;
}

void read_marks(TomlReader& reader, std::string_view key, RegisterFile::Marks& marks) {
  const toml::node* node = reader.node(key);
  if (node == nullptr) return;
  const auto* list = node->as_array();
  if (list == nullptr) reader.fail(key, "expected a list of register addresses");
  marks.reset();
  for (const auto& entry : *list) {
    const auto* integer = entry.as_integer();
    const auto* text = entry.as_string();
    bool good = false;
    if (integer != nullptr && integer->get() >= 0) {
      good = static_cast<std::uint64_t>(integer->get()) <= kLastRegister;
      if (good) marks.set(static_cast<std::size_t>(integer->get()));
    } else if (text != nullptr) {
      good = mark_text(text->get(), marks);
    }
    if (!good) {
      reader.fail_at(entry.source(), key,
                     "expected an address of 0x00 to 0xFF or a range such as \"0x44-0x47\"");
    }
  }
}

}  // namespace

void read_registers(TomlReader& reader, std::map<std::uint8_t, std::uint8_t>& registers) {
  const toml::table* table = reader.table("registers");
  if (table == nullptr) return;
  read_bytes(reader, *table, kLastRegister,
             [&](std::uint8_t address, std::uint8_t value) { registers[address] = value; });
}

void read_layout(TomlReader& reader, RegisterFile::Layout& layout) {
  read_banks(reader, layout.banks);
  read_marks(reader, "missing", layout.missing);
  read_marks(reader, "write_protected", layout.write_protected);
}

bool read_present(TomlReader& reader, bool& present, std::initializer_list<std::string_view> keys) {
  if (const auto given = reader.boolean("control")) present = *given;
  if (present) return true;
  for (const std::string_view key : keys) {
    if (reader.has(key)) reader.fail(key, "needs control = true");
  }
  return false;
}

void read_busy(TomlReader& reader, std::string_view frames_key, std::string_view us_key,
               BusyTime& busy) {
  const toml::node* node = reader.node(frames_key);
  if (node != nullptr && node->is_string()) {
    if (node->as_string()->get() != "forever") {
      reader.fail(frames_key, "expected \"forever\" or a number of frames");
    }
    busy = {BusyTime::kForever, 0};
  } else if (const auto frames = reader.integer(frames_key, 0, kMaxBusyFrames)) {
    busy = {static_cast<std::uint32_t>(*frames), 0};
  }
  if (const auto us = reader.number(us_key, 0, kMaxBusyUs)) {
    if (node != nullptr) {
      reader.fail(us_key, "cannot be given together with " + std::string(frames_key));
    }
    busy = {0, from_us(*us)};
  }
}

void read_busy_us(TomlReader& reader, std::string_view us_key, BusyTime& busy) {
  if (const auto us = reader.number(us_key, 0, kMaxBusyUs)) busy = {0, from_us(*us)};
}

void read_ids(TomlReader& reader, unsigned& ids) {
  if (const auto given = reader.integer("ids", 1, kMaxIds)) ids = static_cast<unsigned>(*given);
}

void read_control(TomlReader& reader, ControlConfig& control) {
  if (!read_present(
          reader, control.present,
          {"ids", "banks", "missing", "write_protected", "read_busy_frames", "read_busy_us",
           "write_busy_frames", "write_busy_us", "store_busy_frames", "store_busy_us"})) {
    return;
  }
  read_ids(reader, control.ids);
  read_layout(reader, control);
  read_busy(reader, "read_busy_frames", "read_busy_us", control.read_busy);
  read_busy(reader, "write_busy_frames", "write_busy_us", control.write_busy);
  read_busy(reader, "store_busy_frames", "store_busy_us", control.store_busy);
}

void know_control_keys(TomlReader& reader) {
  reader.know({"control", "ids", "banks", "missing", "write_protected", "read_busy_frames",
               "read_busy_us", "write_busy_frames", "write_busy_us", "store_busy_frames",
               "store_busy_us"});
}

}  // namespace mb4::sim
