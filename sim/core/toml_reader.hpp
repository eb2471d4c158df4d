// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads one TOML table of a scenario key by key. Every mistake becomes a ScenarioError with the
// place of the node. A key that the caller never asks for is a mistake, too; it is reported before
// a missing key.
#ifndef MB4SIM_TOML_READER_HPP_
#define MB4SIM_TOML_READER_HPP_

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
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
  std::string key{};
  SourcePos where;  // of the key
  TomlValue value;
};

// What a reader asks for: a key of a table, and what its value may be.
struct AskedKey {
  enum class Kind { kInteger, kNumber, kBoolean, kText, kWord, kChoice, kTable, kTables, kOther };
  std::string table{};  // "[host]"
  std::string key{};
  Kind kind = Kind::kOther;
  double minimum = 0;  // kInteger, kNumber
  double maximum = 0;
  std::vector<std::string> words{};  // kChoice; kOther: kinds of value, or words in quotes
};

// State that the readers of one file share.
struct TomlFile {
  std::string name;
  std::optional<ScenarioError> missing;  // the first key that is not there
  // Where an unknown key of a table should stand; empty if nowhere.
  std::function<std::string(const TomlValue& table, std::string_view key)> advice{};
  std::vector<AskedKey>* asked = nullptr;  // takes all that is asked for
};

// A value as a scenario has it; empty for a table or an array.
std::string toml_text(const TomlValue& value);

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
    for (const std::string_view key : keys) ask(key, {});
  }
  // Names the words that a text() may be, for those who list the keys.
  void offer(std::string_view key, std::span<const std::string_view> words);

  // Throws "file:line:column: key 'key': message". The place is that of the key's value if it is
  // there, else that of the table.
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;
  [[noreturn]] void fail_at(const SourcePos& where, std::string_view key,
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
  // `accepts`, for those who list the keys: kinds of value ("array"), words ("\"adaptive\"").
  const TomlValue* value(std::string_view key,
                         std::initializer_list<std::string_view> accepts = {});
  const TomlValue* table(std::string_view key);
  // An array of tables ([[key]]); null if it is absent.
  const std::vector<TomlValue>* tables(std::string_view key);

  // Throws for the first key of the table that has not been asked for.
  void finish() const;

  TableSource source() const;
  TomlFile& file() const { return file_; }

 private:
  enum class Form { kValue, kTable, kTables };  // how the user writes it

  const TomlValue* ask(std::string_view key, AskedKey what, Form form = Form::kValue);
  std::string header(std::string_view key, Form form) const;
  // Of the key's value if it is there, else of the table.
  SourcePos place_of(std::string_view key) const;
  std::string unknown(const TomlEntry& entry) const;

  const TomlValue& table_;
  TomlFile& file_;
  std::map<std::string, Form, std::less<>> known_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_TOML_READER_HPP_
