// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/core/toml_reader.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/number_text.hpp"

namespace mb4::sim {
namespace {

std::string type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a floating-point number";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

SourcePos position(const toml::source_region& where) {
  return {where.begin.line, where.begin.column};
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& name) {
  try {
    return toml::parse(text, name);
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
  file_.missing.emplace(file_.name, position(table_.source()), key, message);
}

void TomlReader::throw_missing(const TomlFile& file) {
  if (file.missing) throw ScenarioError(*file.missing);
}

void TomlReader::fail_at(const toml::source_region& where, std::string_view key,
                         const std::string& message) const {
  throw_missing(file_);
  throw ScenarioError(file_.name, position(where), key, message);
}

void TomlReader::fail(std::string_view key, const std::string& message) const {
  const toml::node* found = table_.get(key);
  fail_at(found != nullptr ? found->source() : table_.source(), key, message);
}

const toml::node* TomlReader::node(std::string_view key) {
  known_.emplace(key);
  return table_.get(key);
}

std::optional<std::int64_t> TomlReader::integer(std::string_view key, std::int64_t minimum,
                                                std::int64_t maximum) {
  const toml::node* found = node(key);
  if (found == nullptr) return std::nullopt;
  if (!found->is_integer()) fail(key, "expected an integer, found " + type_name(*found));
  const std::int64_t value = found->as_integer()->get();
  if (value < minimum || value > maximum) {
    fail(key, std::to_string(value) + " is outside " + std::to_string(minimum) + " to " +
                  std::to_string(maximum));
  }
  return value;
}

std::optional<std::uint64_t> TomlReader::word(std::string_view key) {
  const toml::node* found = node(key);
  if (found == nullptr) return std::nullopt;
  if (const auto* text = found->as_string()) {
    const auto value = parse_word(text->get());
    if (!value) fail(key, "'" + text->get() + "' is no 64-bit number");
    return value;
  }
  if (!found->is_integer()) {
    fail(key, "expected an integer or a string with one, found " + type_name(*found));
  }
  const std::int64_t value = found->as_integer()->get();
  if (value < 0) fail(key, std::to_string(value) + " is negative");
  return static_cast<std::uint64_t>(value);
}

std::optional<double> TomlReader::number(std::string_view key, double minimum, double maximum) {
  const toml::node* found = node(key);
  if (found == nullptr) return std::nullopt;
  if (!found->is_number()) fail(key, "expected a number, found " + type_name(*found));
  // toml++ gives no double for an integer that a double cannot hold.
  const auto* whole = found->as_integer();
  const double value =
      whole != nullptr ? static_cast<double>(whole->get()) : found->as_floating_point()->get();
  if (!(value >= minimum && value <= maximum)) {
    fail(key, plain(value) + " is outside " + plain(minimum) + " to " + plain(maximum));
  }
  return value;
}

std::optional<bool> TomlReader::boolean(std::string_view key) {
  const toml::node* found = node(key);
  if (found == nullptr) return std::nullopt;
  if (const auto* value = found->as_boolean()) return value->get();
  if (const auto* value = found->as_integer(); value != nullptr) {
    if (value->get() == 0 || value->get() == 1) return value->get() == 1;
  }
  fail(key, "expected true or false, found " + type_name(*found));
}

std::optional<std::string> TomlReader::text(std::string_view key) {
  const toml::node* found = node(key);
  if (found == nullptr) return std::nullopt;
  if (!found->is_string()) fail(key, "expected a string, found " + type_name(*found));
  return found->as_string()->get();
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
  source.table = position(table_.source());
  for (auto&& [key, value] : table_) {
    source.keys.emplace(std::string(key.str()), position(value.source()));
  }
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

const toml::table* TomlReader::table(std::string_view key) {
  const toml::node* found = node(key);
  if (found == nullptr) return nullptr;
  if (!found->is_table()) fail(key, "expected a table, found " + type_name(*found));
  return found->as_table();
}

const toml::array* TomlReader::tables(std::string_view key) {
  const toml::node* found = node(key);
  if (found == nullptr) return nullptr;
  if (!found->is_array_of_tables()) {
    fail(key, "expected tables in double brackets, found " + type_name(*found));
  }
  return found->as_array();
}

void TomlReader::finish() const {
  const toml::key* first = nullptr;
  for (auto&& [key, value] : table_) {
    if (known_.contains(key.str())) continue;
    // The table is sorted by name, but the user reads from top to bottom.
    if (first == nullptr || key.source().begin < first->source().begin) first = &key;
  }
  if (first == nullptr) return;
  throw ScenarioError(file_.name, position(first->source()), first->str(), "unknown key");
}

}  // namespace mb4::sim
