// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/core/toml_reader.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <utility>

#include "sim/core/number_text.hpp"

namespace mb4::sim {
namespace {

using Kind = TomlValue::Kind;

std::string type_name(const TomlValue& value) {
  switch (value.kind) {
    case Kind::kTable:
      return "a table";
    case Kind::kArray:
      return "an array";
    case Kind::kText:
      return "a string";
    case Kind::kInteger:
      return "an integer";
    case Kind::kNumber:
      return "a floating-point number";
    case Kind::kBoolean:
      return "a boolean";
    case Kind::kDate:
      break;
  }
  return "a date or time";
}

SourcePos position(const toml::source_region& where) {
  return {where.begin.line, where.begin.column};
}

bool before(SourcePos a, SourcePos b) {
  return std::pair(a.line, a.column) < std::pair(b.line, b.column);
}

TomlValue copied(const toml::node& node) {
  TomlValue value;
  value.where = position(node.source());
  if (const auto* table = node.as_table()) {
    for (auto&& [key, entry] : *table) {
      value.entries.push_back({std::string(key.str()), position(key.source()), copied(entry)});
    }
    // toml++ sorts by name, but the user reads from top to bottom.
    std::stable_sort(value.entries.begin(), value.entries.end(),
                     [](const auto& a, const auto& b) { return before(a.where, b.where); });
  } else if (const auto* list = node.as_array()) {
    value.kind = Kind::kArray;
    for (const auto& item : *list) value.items.push_back(copied(item));
  } else if (const auto* text = node.as_string()) {
    value.kind = Kind::kText;
    value.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.kind = Kind::kInteger;
    value.integer = integer->get();
    value.number = static_cast<double>(integer->get());
  } else if (const auto* number = node.as_floating_point()) {
    value.kind = Kind::kNumber;
    value.number = number->get();
  } else if (const auto* boolean = node.as_boolean()) {
    value.kind = Kind::kBoolean;
    value.boolean = boolean->get();
  } else {
    value.kind = Kind::kDate;
  }
  return value;
}

}  // namespace

const TomlValue* TomlValue::find(std::string_view key) const {
  const auto entry = std::find_if(entries.begin(), entries.end(),
                                  [&](const TomlEntry& each) { return each.key == key; });
  return entry == entries.end() ? nullptr : &entry->value;
}

TomlValue parse_toml(std::string_view text, const std::string& name) {
  try {
    return copied(toml::parse(text, name));
  } catch (const toml::parse_error& error) {
    const auto where = error.source().begin;
    std::string description(error.description());
    std::replace(description.begin(), description.end(), '\n', ' ');
    throw ScenarioError(name + ":" + std::to_string(where.line) + ":" +
                        std::to_string(where.column) + ": not valid TOML: " + description);
  }
}

void TomlReader::missing(std::string_view key, const std::string& message) {
  known_.emplace(key);
  if (file_.missing) return;
  file_.missing.emplace(file_.name, table_.where, key, message);
}

void TomlReader::throw_missing(const TomlFile& file) {
  if (file.missing) throw ScenarioError(*file.missing);
}

void TomlReader::fail_at(SourcePos where, std::string_view key, const std::string& message) const {
  throw_missing(file_);
  throw ScenarioError(file_.name, where, key, message);
}

void TomlReader::fail(std::string_view key, const std::string& message) const {
  const TomlValue* found = table_.find(key);
  fail_at(found != nullptr ? found->where : table_.where, key, message);
}

const TomlValue* TomlReader::value(std::string_view key) {
  known_.emplace(key);
  return table_.find(key);
}

std::optional<std::int64_t> TomlReader::integer(std::string_view key, std::int64_t minimum,
                                                std::int64_t maximum) {
  const TomlValue* found = value(key);
  if (found == nullptr) return std::nullopt;
  if (!found->is(Kind::kInteger)) fail(key, "expected an integer, found " + type_name(*found));
  if (!found->within(minimum, maximum)) {
    fail(key, std::to_string(found->integer) + " is outside " + std::to_string(minimum) + " to " +
                  std::to_string(maximum));
  }
  return found->integer;
}

std::optional<std::uint64_t> TomlReader::word(std::string_view key) {
  const TomlValue* found = value(key);
  if (found == nullptr) return std::nullopt;
  if (found->is(Kind::kText)) {
    const auto word = parse_word(found->text);
    if (!word) fail(key, "'" + found->text + "' is no 64-bit number");
    return word;
  }
  if (!found->is(Kind::kInteger)) {
    fail(key, "expected an integer or a string with one, found " + type_name(*found));
  }
  if (found->integer < 0) fail(key, std::to_string(found->integer) + " is negative");
  return static_cast<std::uint64_t>(found->integer);
}

std::optional<double> TomlReader::number(std::string_view key, double minimum, double maximum) {
  const TomlValue* found = value(key);
  if (found == nullptr) return std::nullopt;
  if (!found->is_number()) fail(key, "expected a number, found " + type_name(*found));
  if (!(found->number >= minimum && found->number <= maximum)) {
    fail(key, plain(found->number) + " is outside " + plain(minimum) + " to " + plain(maximum));
  }
  return found->number;
}

std::optional<bool> TomlReader::boolean(std::string_view key) {
  const TomlValue* found = value(key);
  if (found == nullptr) return std::nullopt;
  if (found->is(Kind::kBoolean)) return found->boolean;
  if (found->within(0, 1)) return found->integer == 1;
  fail(key, "expected true or false, found " + type_name(*found));
}

std::optional<std::string> TomlReader::text(std::string_view key) {
  const TomlValue* found = value(key);
  if (found == nullptr) return std::nullopt;
  if (!found->is(Kind::kText)) fail(key, "expected a string, found " + type_name(*found));
  return found->text;
}

std::optional<std::string> TomlReader::file_name(std::string_view key) {
  auto name = text(key);
  if (name && name->find('\0') != std::string::npos) {
    fail(key, "a file name cannot hold a NUL character");
  }
  return name;
}

TableSource TomlReader::source() const {
  TableSource source;
  source.table = table_.where;
  for (const TomlEntry& entry : table_.entries) source.keys.emplace(entry.key, entry.value.where);
  return source;
}

std::optional<std::size_t> TomlReader::choice(std::string_view key,
                                              std::span<const std::string_view> choices) {
  const auto value = text(key);
  if (!value) return std::nullopt;
  std::string list;
  std::size_t index = 0;
  for (const std::string_view choice : choices) {
    if (choice == *value) return index;
    list += (index == 0 ? "" : ", ") + std::string(choice);
    ++index;
  }
  fail(key, "unknown value '" + *value + "', expected one of: " + list);
}

const TomlValue* TomlReader::table(std::string_view key) {
  const TomlValue* found = value(key);
  if (found == nullptr) return nullptr;
  if (!found->is(Kind::kTable)) fail(key, "expected a table, found " + type_name(*found));
  return found;
}

const std::vector<TomlValue>* TomlReader::tables(std::string_view key) {
  const TomlValue* found = value(key);
  if (found == nullptr) return nullptr;
  const bool fits = !found->items.empty() &&
                    std::all_of(found->items.begin(), found->items.end(),
                                [](const TomlValue& item) { return item.is(Kind::kTable); });
  if (!fits) {
    fail(key, "expected tables in double brackets, found " + type_name(*found));
  }
  return &found->items;
}

void TomlReader::finish() const {
  for (const TomlEntry& entry : table_.entries) {
    if (known_.contains(entry.key)) continue;
    throw ScenarioError(file_.name, entry.where, entry.key, "unknown key");
  }
}

}  // namespace mb4::sim
