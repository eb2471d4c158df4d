// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads one TOML table of a scenario key by key. Every mistake becomes a ScenarioError with the
// place of the node. A key that the caller never asks for is a mistake, too; it is reported before
// a missing key.
#ifndef MB4SIM_TOML_READER_HPP_
#define MB4SIM_TOML_READER_HPP_

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/scenario_error.hpp"

namespace mb4::sim {

struct TomlEntry;

// A value of a TOML file, and where it stands.
struct TomlValue {
  enum class Kind { kTable, kArray, kText, kInteger, kNumber, kBoolean, kDate };

  Kind kind = Kind::kTable;
  SourcePos where;
  std::int64_t integer = 0;        // kInteger
  double number = 0;               // kNumber, and kInteger as near as a double comes
  bool boolean = false;            // kBoolean
  std::string text;                // kText
  std::vector<TomlValue> items;    // kArray
  std::vector<TomlEntry> entries;  // kTable, from top to bottom

  bool is(Kind other) const { return kind == other; }
  bool is_number() const { return kind == Kind::kInteger || kind == Kind::kNumber; }
  // Whether it is an integer of minimum to maximum.
  bool within(std::int64_t minimum, std::int64_t maximum) const {
    return kind == Kind::kInteger && integer >= minimum && integer <= maximum;
  }
  // The value of a key, or null.
  const TomlValue* find(std::string_view key) const;
};

struct TomlEntry {
  std::string key;
  SourcePos where;  // of the key
  TomlValue value;
};

// State that the readers of one file share.
struct TomlFile {
  std::string name;
  std::optional<ScenarioError> missing;  // the first key that is not there
};

// Parses TOML and returns the table of the whole file. Throws ScenarioError with the place of a
// mistake, which begins with `name`.
TomlValue parse_toml(std::string_view text, const std::string& name);

class TomlReader {
 public:
  TomlReader(const TomlValue& table, TomlFile& file) : table_(table), file_(file) {}

  // Records that a required key is not there. The caller continues with any value, so that finish()
  // can find an unknown key, which is probably this one misspelt, and report it instead. Any other
  // mistake throws the error of this missing key.
  void missing(std::string_view key, const std::string& message = "missing");
  // Throws if missing() was called for any table of the file.
  static void throw_missing(const TomlFile& file);
  // Names keys that are known although the caller does not ask for them.
  void know(std::initializer_list<std::string_view> keys) {
    known_.insert(keys.begin(), keys.end());
  }

  // Throws "file:line:column: key 'key': message". The place is that of the key's value if it is
  // there, else that of the table.
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;
  [[noreturn]] void fail_at(SourcePos where, std::string_view key,
                            const std::string& message) const;

  bool has(std::string_view key) const { return table_.find(key) != nullptr; }

  // The next calls return nothing if the key is absent. They throw if the value is wrong.
  std::optional<std::int64_t> integer(std::string_view key, std::int64_t minimum,
                                      std::int64_t maximum);
  // An integer, or for 64-bit words a string such as "0xFFFF_FFFF_FFFF_FFFF".
  std::optional<std::uint64_t> word(std::string_view key);
  std::optional<double> number(std::string_view key, double minimum, double maximum);
  std::optional<bool> boolean(std::string_view key);
  std::optional<std::string> text(std::string_view key);
  // Returns the index of the value in `choices`.
  std::optional<std::size_t> choice(std::string_view key,
                                    std::span<const std::string_view> choices);
  std::optional<std::size_t> choice(std::string_view key,
                                    std::initializer_list<std::string_view> choices) {
    return choice(key, std::span(choices.begin(), choices.size()));
  }
  // The name of a file: text without a NUL character.
  std::optional<std::string> file_name(std::string_view key);
  const TomlValue* value(std::string_view key);
  const TomlValue* table(std::string_view key);
  // An array of tables ([[key]]); null if it is absent.
  const std::vector<TomlValue>* tables(std::string_view key);

  // Throws for the first key of the table that has not been asked for.
  void finish() const;

  TableSource source() const;
  TomlFile& file() const { return file_; }

 private:
  const TomlValue& table_;
  TomlFile& file_;
  std::set<std::string, std::less<>> known_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_TOML_READER_HPP_
