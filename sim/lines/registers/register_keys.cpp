// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/registers/register_keys.hpp"

#include <initializer_list>
#include <set>
#include <string>
#include <string_view>

#include "sim/core/number_text.hpp"
#include "sim/lines/register_bytes.hpp"

namespace mb4::sim {
namespace {

constexpr std::uint64_t kLastBank = 0xFF;
constexpr std::int64_t kMaxIds = 8;
constexpr std::int64_t kMaxBusyFrames = 1'000'000;
constexpr double kMaxBusyUs = 1e6;

void read_banks(TomlReader& reader, RegisterFile::Banks& banks) {
  const TomlValue* table = reader.table("banks");
  if (table == nullptr) return;
  std::set<std::uint64_t> given;
  for (const auto& [key, where, bytes] : table->entries) {
    const auto number = parse_word(key);
    if (!number || *number > kLastBank) {
      reader.fail_at(where, key, "expected a bank of 1 to 255");
    }
    if (*number == 0) {
      reader.fail_at(where, key, "bank 0 is registers 0x00 to 0x3F");
    }
    if (!given.insert(*number).second) {
      reader.fail_at(where, key, "bank " + std::to_string(*number) + " is given twice");
    }
    if (!bytes.is(TomlValue::Kind::kTable)) {
      reader.fail_at(bytes.where, key, "expected a table of bytes by address");
    }
    RegisterFile::Bank& bank = banks[static_cast<std::uint8_t>(*number)];
    read_bytes(reader, bytes, RegisterFile::kBankSize - 1,
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
  const TomlValue* list = reader.value(key, {"array"});
  if (list == nullptr) return;
  if (!list->is(TomlValue::Kind::kArray)) reader.fail(key, "expected a list of register addresses");
  marks.reset();
  for (const TomlValue& entry : list->items) {
    const bool one = entry.within(0, kLastRegister);
    if (one) marks.set(static_cast<std::size_t>(entry.integer));
    if (!one && !(entry.is(TomlValue::Kind::kText) && mark_text(entry.text, marks))) {
      reader.fail_at(entry.where, key,
                     "expected an address of 0x00 to 0xFF or a range such as \"0x44-0x47\"");
    }
  }
}

}  // namespace

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
  const TomlValue* value = reader.value(frames_key, {"\"forever\""});
  if (value != nullptr && value->is(TomlValue::Kind::kText)) {
    if (value->text != "forever") {
      reader.fail(frames_key, "expected \"forever\" or a number of frames");
    }
    busy = {BusyTime::kForever, 0};
  } else if (const auto frames = reader.integer(frames_key, 0, kMaxBusyFrames)) {
    busy = {static_cast<std::uint32_t>(*frames), 0};
  }
  if (const auto us = reader.number(us_key, 0, kMaxBusyUs)) {
    if (value != nullptr) {
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
