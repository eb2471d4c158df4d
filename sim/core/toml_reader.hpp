// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads one TOML table of a scenario key by key. Every mistake becomes a ScenarioError with the
// place of the node. A key that the caller never asks for is a mistake, too; it is reported before
// a missing key.
#ifndef MB4SIM_TOML_READER_HPP_
#define MB4SIM_TOML_READER_HPP_

#include <toml++/toml.h>

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "sim/core/scenario_error.hpp"

namespace mb4::sim {

// State that the readers of one file share.
struct TomlFile {
  std::string name;
  std::optional<ScenarioError> missing;  // the first key that is not there
};

// Parses TOML. Throws ScenarioError with the place of a mistake, which begins with `name`.
toml::table parse_toml(std::string_view text, const std::string& name);

class TomlReader {
 public:
  TomlReader(const toml::table& table, TomlFile& file) : table_(table), file_(file) {}

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
  [[noreturn]] void fail_at(const toml::source_region& where, std::string_view key,
                            const std::string& message) const;

  bool has(std::string_view key) const { return table_.contains(key); }

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
  const toml::node* node(std::string_view key);
  const toml::table* table(std::string_view key);
  // An array of tables ([[key]]); null if it is absent.
  const toml::array* tables(std::string_view key);

  // Throws for the first key of the table that has not been asked for.
  void finish() const;

  TableSource source() const;
  const toml::table& raw() const { return table_; }
  TomlFile& file() const { return file_; }

 private:
  const toml::table& table_;
  TomlFile& file_;
  std::set<std::string, std::less<>> known_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_TOML_READER_HPP_
