// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/core/toml_reader.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/core/number_text.hpp"
#include "sim/core/suggestion.hpp"
#include "sim/core/toml_advice.hpp"

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

SourcePos position(const toml::source_region& where, const std::string& table) {
  return {where.begin.line, where.begin.column, table};
}

bool before(const SourcePos& a, const SourcePos& b) {
  return std::pair(a.line, a.column) < std::pair(b.line, b.column);
}

std::string bracketed(const std::string& path, bool list) {
  return path.empty() ? "" : (list ? "[[" + path + "]]" : "[" + path + "]");
}

std::string path_of(std::string_view title) {
  const std::size_t first = title.find_first_not_of('[');
  if (first == std::string_view::npos) return "";
  return std::string(title.substr(first, title.find(']') - first));
}

std::string path_in(std::string_view title, std::string_view key) {
  const std::string path = path_of(title);
  return (path.empty() ? "" : path + ".") + std::string(key);
}

// `table`: title of the table that holds the node. `key`: of the node. `in_list`: it is an item of
// this key's array.
TomlValue copied(const toml::node& node, const std::string& table, std::string_view key,
                 bool in_list = false) {
  TomlValue value;
  value.where = position(node.source(), table);
  if (const auto* entries = node.as_table()) {
    const std::string title = key.empty() ? "" : bracketed(path_in(table, key), in_list);
    value.where.table = title;
    for (auto&& [name, entry] : *entries) {
      value.entries.push_back({std::string(name.str()), position(name.source(), title),
                               copied(entry, title, name.str())});
    }
    // toml++ sorts by name, but the user reads from top to bottom.
    std::stable_sort(value.entries.begin(), value.entries.end(),
                     [](const auto& a, const auto& b) { return before(a.where, b.where); });
  } else if (const auto* list = node.as_array()) {
    value.kind = Kind::kArray;
    for (const auto& item : *list) value.items.push_back(copied(item, table, key, true));
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

// The error of the parser, and what to write instead of the line.
std::string syntax_error(std::string_view text, const std::string& name,
                         const toml::parse_error& error) {
  const auto where = error.source().begin;
  std::string description(error.description());
  std::replace(description.begin(), description.end(), '\n', ' ');
  std::string message = name + ":" + std::to_string(where.line) + ":" +
                        std::to_string(where.column) + ": not valid TOML: " + description;
  const LineAdvice advice = advice_on_line(text, where.line);
  if (advice.key.empty()) return message;
  message += "; key '" + advice.key + "'";
  if (!advice.line.empty()) message += ": write " + advice.line;
  if (!advice.section.empty()) message += " (in " + advice.section + ")";
  return message;
}

// "; write cable_m = 10" where a string holds a number, and where a whole one is wanted as 3e6
// or 2.0.
std::string write_number(std::string_view key, const TomlValue& value) {
  constexpr double kExact = 9'007'199'254'740'992.0;  // 2^53: whole numbers up to it are exact
  std::string line;
  if (value.is(Kind::kText)) line = number_line(key, value.text);
  if (value.is(Kind::kNumber) && std::abs(value.number) <= kExact &&
      value.number == std::floor(value.number)) {
    line = std::string(key) + " = " + toml_number(value.number);
  }
  return line.empty() ? "" : "; write " + line;
}

// "; 20 MHz is 20_000_000" where megahertz stand in a key of hertz.
std::string write_hertz(std::string_view key, double value, double minimum, double maximum) {
  constexpr double kMega = 1e6;
  if (!key.ends_with("_hz") || value <= 0 || value >= minimum || value * kMega > maximum ||
      value * kMega < minimum) {
    return "";
  }
  return "; " + plain(value) + " MHz is " + toml_number(value * kMega);
}

std::string listed(std::span<const std::string_view> words) {
  std::string list;
  for (const std::string_view word : words) list += (list.empty() ? "" : ", ") + std::string(word);
  return list;
}

}  // namespace

const TomlValue* TomlValue::find(std::string_view key) const {
  const auto entry = std::find_if(entries.begin(), entries.end(),
                                  [&](const TomlEntry& each) { return each.key == key; });
  return entry == entries.end() ? nullptr : &entry->value;
}

std::string toml_text(const TomlValue& value) {
  switch (value.kind) {
    case Kind::kText:
      return '"' + value.text + '"';
    case Kind::kInteger:
      return std::to_string(value.integer);
    case Kind::kNumber:
      return plain(value.number);
    case Kind::kBoolean:
      return value.boolean ? "true" : "false";
    default:
      return "";
  }
}

TomlValue parse_toml(std::string_view text, const std::string& name) {
  try {
    return copied(toml::parse(text, name), "", "");
  } catch (const toml::parse_error& error) {
    throw ScenarioError(syntax_error(text, name, error));
  }
}

void TomlReader::missing(std::string_view key, const std::string& message) {
  known_.emplace(key, Form::kValue);
  if (file_.missing) return;
  file_.missing.emplace(file_.name, place_of(key), key, message);
}

void TomlReader::throw_missing(const TomlFile& file) {
  if (file.missing) throw ScenarioError(*file.missing);
}

void TomlReader::fail_at(const SourcePos& where, std::string_view key,
                         const std::string& message) const {
  throw_missing(file_);
  throw ScenarioError(file_.name, where, key, message);
}

void TomlReader::fail(std::string_view key, const std::string& message) const {
  fail_at(place_of(key), key, message);
}

SourcePos TomlReader::place_of(std::string_view key) const {
  const TomlValue* found = table_.find(key);
  if (found == nullptr) return table_.where;
  return {found->where.line, found->where.column, table_.where.table};
}

void TomlReader::offer(std::string_view key, std::span<const std::string_view> words) {
  ask(key, {.kind = AskedKey::Kind::kChoice, .words = {words.begin(), words.end()}});
}

const TomlValue* TomlReader::ask(std::string_view key, AskedKey what, Form form) {
  known_.emplace(key, form);
  if (file_.asked != nullptr) {
    what.table = table_.where.table;
    what.key = key;
    file_.asked->push_back(std::move(what));
  }
  return table_.find(key);
}

std::string TomlReader::header(std::string_view key, Form form) const {
  return form == Form::kValue ? std::string(key)
                              : bracketed(path_in(table_.where.table, key), form == Form::kTables);
}

const TomlValue* TomlReader::value(std::string_view key,
                                   std::initializer_list<std::string_view> accepts) {
  return ask(key, {.kind = AskedKey::Kind::kOther, .words = {accepts.begin(), accepts.end()}});
}

std::optional<std::int64_t> TomlReader::integer(std::string_view key, std::int64_t minimum,
                                                std::int64_t maximum) {
  const auto least = static_cast<double>(minimum);
  const auto most = static_cast<double>(maximum);
  const TomlValue* found =
      ask(key, {.kind = AskedKey::Kind::kInteger, .minimum = least, .maximum = most});
  if (found == nullptr) return std::nullopt;
  if (!found->is(Kind::kInteger)) {
    fail(key, "expected an integer, found " + type_name(*found) + write_number(key, *found));
  }
  if (!found->within(minimum, maximum)) {
    fail(key, std::to_string(found->integer) + " is outside " + std::to_string(minimum) + " to " +
                  std::to_string(maximum) + write_hertz(key, found->number, least, most));
  }
  return found->integer;
}

std::optional<std::uint64_t> TomlReader::word(std::string_view key) {
  const TomlValue* found = ask(key, {.kind = AskedKey::Kind::kWord});
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
  const TomlValue* found =
      ask(key, {.kind = AskedKey::Kind::kNumber, .minimum = minimum, .maximum = maximum});
  if (found == nullptr) return std::nullopt;
  if (!found->is_number()) {
    fail(key, "expected a number, found " + type_name(*found) + write_number(key, *found));
  }
  if (!(found->number >= minimum && found->number <= maximum)) {
    fail(key, plain(found->number) + " is outside " + plain(minimum) + " to " + plain(maximum));
  }
  return found->number;
}

std::optional<bool> TomlReader::boolean(std::string_view key) {
  const TomlValue* found = ask(key, {.kind = AskedKey::Kind::kBoolean});
  if (found == nullptr) return std::nullopt;
  if (found->is(Kind::kBoolean)) return found->boolean;
  if (found->within(0, 1)) return found->integer == 1;
  fail(key, "expected true or false, found " + type_name(*found) +
                (found->is(Kind::kText) ? "; write it without quotes" : ""));
}

std::optional<std::string> TomlReader::text(std::string_view key) {
  const TomlValue* found = ask(key, {.kind = AskedKey::Kind::kText});
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
  offer(key, choices);
  const auto value = text(key);
  if (!value) return std::nullopt;
  for (std::size_t index = 0; index < choices.size(); ++index) {
    if (choices[index] == *value) return index;
  }
  fail(key, "unknown value '" + *value + "', expected one of: " + listed(choices) +
                did_you_mean(*value, {choices.begin(), choices.end()}));
}

const TomlValue* TomlReader::table(std::string_view key) {
  const TomlValue* found = ask(key, {.kind = AskedKey::Kind::kTable}, Form::kTable);
  if (found == nullptr) return nullptr;
  if (!found->is(Kind::kTable)) {
    fail(key,
         "expected a table, found " + type_name(*found) + "; write " + header(key, Form::kTable));
  }
  return found;
}

const std::vector<TomlValue>* TomlReader::tables(std::string_view key) {
  const TomlValue* found = ask(key, {.kind = AskedKey::Kind::kTables}, Form::kTables);
  if (found == nullptr) return nullptr;
  const bool fits = !found->items.empty() &&
                    std::all_of(found->items.begin(), found->items.end(),
                                [](const TomlValue& item) { return item.is(Kind::kTable); });
  if (fits) return &found->items;
  const std::string own = header(key, Form::kTables);
  // [[channel.slave]] alone makes a table `channel` that holds nothing else.
  if (found->entries.size() == 1 && found->entries.front().value.is(Kind::kArray)) {
    const TomlEntry& below = found->entries.front();
    missing(key, own + " is missing: write it above [[" + path_in(own, below.key) + "]]");
    return nullptr;
  }
  fail(key, "expected tables in double brackets, found " + type_name(*found) + "; write " + own);
}

std::string TomlReader::unknown(const TomlEntry& entry) const {
  const std::string elsewhere = file_.advice ? file_.advice(table_, entry.key) : "";
  if (!elsewhere.empty()) return elsewhere;
  std::vector<std::string> keys;
  std::string list;
  for (const auto& [key, form] : known_) {
    keys.push_back(key);
    list += (list.empty() ? "" : ", ") + header(key, form);
  }
  if (entry.value.is_number()) {
    if (const auto other = other_unit(entry.key, entry.value.number, keys)) {
      return "; write " + other->key + " = " + toml_number(other->value);
    }
  }
  const std::string near = nearest(entry.key, keys);
  if (!near.empty()) return ", did you mean '" + header(near, known_.find(near)->second) + "'?";
  return list.empty() ? "" : ", known here: " + list;
}

void TomlReader::finish() const {
  for (const TomlEntry& entry : table_.entries) {
    if (known_.contains(entry.key)) continue;
    throw ScenarioError(file_.name, entry.where, entry.key, "unknown key" + unknown(entry));
  }
}

}  // namespace mb4::sim
