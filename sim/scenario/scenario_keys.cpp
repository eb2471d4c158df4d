// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scenario/scenario_keys.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "sim/core/json_text.hpp"
#include "sim/faults/fault_types.hpp"
#include "sim/lines/protocols.hpp"

namespace mb4::sim {
namespace {

// A key, and the scenario in which the reader has asked for it: what master and so on it had.
struct Found {
  AskedKey asked;
  std::map<std::string, std::string, std::less<>> sample;  // "type", "protocol", "source", "kind"
};

std::string line_of(const char* key, std::string_view value) {
  return value.empty() ? "" : std::string(key) + " = \"" + std::string(value) + "\"\n";
}

// Reads a scenario with one channel, slave and fault. An empty word leaves its line out.
void read_sample(const Master& master, std::string_view protocol, std::string_view source,
                 std::string_view kind, std::string_view more, std::vector<Found>& found) {
  std::string text = "[master]\n" + line_of("type", master.type) +
                     "[chip]\n[chip.quirks]\n[host]\n[sim]\n[[channel]]\n[[channel.event]]\n"
                     "[[channel.slave]]\n" +
                     line_of("protocol", protocol) + line_of("source", source);
  // Keys without which the reader does not ask for others.
  if (kind.empty()) text += "control = true\nplay = \"clock\"\n";
  if (!kind.empty()) text += "[[fault]]\n" + line_of("kind", kind);
  text += more;
  for (AskedKey& asked : keys_asked_for(text)) {
    const bool of_slave = asked.table == "[[channel.slave]]";
    const bool of_fault = asked.table == "[[fault]]";
    Found each{std::move(asked), {{"type", std::string(master.type)}}};
    if (of_slave) each.sample["protocol"] = protocol;
    if (of_slave) each.sample["source"] = source;
    if (of_fault) each.sample["kind"] = kind;
    found.push_back(std::move(each));
  }
}

std::vector<Found> read_samples() {
  std::vector<Found> found;
  for (const Master* master : masters()) {
    std::string_view first;
    for (const Protocol* protocol : protocols()) {
      if (protocol->line != master->line) continue;
      if (first.empty()) first = protocol->key;
      for (const char* source : {"", "ramp", "sine", "file"}) {
        read_sample(*master, protocol->key, source, "", "", found);
      }
      read_sample(*master, protocol->key, "", "", "capture = \"\"\n", found);
      if (!protocol->sample.empty()) {
        read_sample(*master, protocol->key, "", "", protocol->sample, found);
      }
    }
    read_sample(*master, "", "", "", "", found);  // knows the keys of all
    for (const FaultType& type : fault_types()) {
      for (const char* when : {"at_us = 1\n", "per_s = 1\n"}) {
        read_sample(*master, first, "", type.name, when, found);
      }
    }
  }
  return found;
}

const std::vector<Found>& all_keys() {
  static const std::vector<Found> keys = read_samples();
  return keys;
}

bool is_table(const AskedKey& asked) {
  return asked.kind == AskedKey::Kind::kTable || asked.kind == AskedKey::Kind::kTables;
}

std::string title_of(const AskedKey& asked) {
  std::string path = asked.table;
  std::erase_if(path, [](char c) { return c == '[' || c == ']'; });
  path += (path.empty() ? "" : ".") + asked.key;
  return asked.kind == AskedKey::Kind::kTables ? "[[" + path + "]]" : "[" + path + "]";
}

// --- advice --------------------------------------------------------------------------------------

// What a line of this table must say for the reader to ask for the key; empty if it does.
std::string condition(std::vector<const Found*> fitting, const Master& master,
                      const TomlValue& table) {
  for (const char* key : {"type", "protocol", "source", "kind"}) {
    std::string own(key == std::string_view("type") ? master.type : "");
    if (const TomlValue* value = table.find(key); own.empty() && value != nullptr)
      own = value->text;
    if (own.empty() && key != std::string_view("source")) continue;
    std::set<std::string> words;
    std::vector<const Found*> left;
    for (const Found* each : fitting) {
      const auto said = each->sample.find(key);
      if (said == each->sample.end() || said->second == own) {
        left.push_back(each);
      } else {
        words.insert(said->second);
      }
    }
    if (left.empty()) {
      std::string list;
      for (const std::string& word : words) list += (list.empty() ? "\"" : " or \"") + word + '"';
      return std::string(key == std::string_view("type") ? "[master] type = " : "") +
             (key == std::string_view("type") ? "" : std::string(key) + " = ") + list;
    }
    fitting = left;
  }
  return "";
}

// --- schema --------------------------------------------------------------------------------------

struct Range {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void widen(const AskedKey& asked) {
    least = std::min(least, asked.minimum);
    most = std::max(most, asked.maximum);
  }
  bool empty() const { return least > most; }
};

// All that a key of a table may be, over all masters and protocols.
struct KeyForms {
  std::set<AskedKey::Kind> kinds;
  Range whole;
  Range number;
  std::vector<std::string> words;  // of a choice, as the reader lists them
  std::set<std::string> accepts;   // of a value that its own reader checks
  std::string below;               // title of a table
};

using Tables = std::map<std::string, std::map<std::string, KeyForms>>;

void add_word(std::vector<std::string>& words, const std::string& word) {
  if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
}

Tables all_tables() {
  Tables tables;
  for (const Found& found : all_keys()) {
    const AskedKey& asked = found.asked;
    KeyForms& forms = tables[asked.table][asked.key];
    forms.kinds.insert(asked.kind);
    if (asked.kind == AskedKey::Kind::kInteger) forms.whole.widen(asked);
    if (asked.kind == AskedKey::Kind::kNumber) forms.number.widen(asked);
    if (asked.kind == AskedKey::Kind::kChoice) {
      for (const std::string& word : asked.words) add_word(forms.words, word);
    }
    if (asked.kind == AskedKey::Kind::kOther) {
      forms.accepts.insert(asked.words.begin(), asked.words.end());
    }
    if (is_table(asked)) forms.below = title_of(asked);
  }
  return tables;
}

std::string json_number(double value) {
  constexpr double kExact = 9.2e18;
  std::string text = std::to_string(value);
  if (value == std::floor(value) && std::abs(value) < kExact) {
    return std::to_string(static_cast<std::int64_t>(value));
  }
  while (text.ends_with('0')) text.pop_back();
  return text;
}

std::string typed(const char* type, const Range& range) {
  constexpr double kAll = 9.2e18;  // limits of 64 bits are none
  std::string text = std::string(R"({"type": ")") + type + '"';
  if (range.least > -kAll) text += ", \"minimum\": " + json_number(range.least);
  if (range.most < kAll) text += ", \"maximum\": " + json_number(range.most);
  return text + "}";
}

std::string table_json(const Tables& tables, const std::string& title, const std::string& indent);

std::vector<std::string> alternatives(const KeyForms& forms) {
  using Kind = AskedKey::Kind;
  std::vector<std::string> list;
  if (forms.kinds.contains(Kind::kChoice)) {
    std::string words;
    for (const std::string& word : forms.words) {
      words += (words.empty() ? "" : ", ") + json_text(word);
    }
    list.push_back(R"({"enum": [)" + words + "]}");
  } else if (forms.kinds.contains(Kind::kText)) {
    list.push_back(R"({"type": "string"})");
  }
  for (const std::string& each : forms.accepts) {
    const bool kind = std::isalpha(static_cast<unsigned char>(each.front())) != 0;
    list.push_back(kind ? R"({"type": ")" + each + "\"}" : R"({"const": )" + each + "}");
  }
  if (!forms.number.empty()) {
    list.push_back(typed("number", forms.number));
  } else if (!forms.whole.empty()) {
    list.push_back(typed("integer", forms.whole));
  }
  if (forms.kinds.contains(Kind::kBoolean)) {
    list.push_back(R"({"type": ["boolean", "integer"], "minimum": 0, "maximum": 1})");
  }
  if (forms.kinds.contains(Kind::kWord)) {
    list.push_back(R"({"type": "integer", "minimum": 0})");
    list.push_back(R"({"type": "string", "pattern": "^(0[xX][0-9A-Fa-f_]+|[0-9_]+)$"})");
  }
  return list;
}

std::string key_json(const Tables& tables, const KeyForms& forms, const std::string& indent) {
  if (!forms.below.empty()) {
    const std::string object = table_json(tables, forms.below, indent);
    if (!forms.kinds.contains(AskedKey::Kind::kTables)) return object;
    return R"({"type": "array", "minItems": 1, "items": )" + object + "}";
  }
  const std::vector<std::string> list = alternatives(forms);
  if (list.empty()) return "{}";
  if (list.size() == 1) return list.front();
  std::string any;
  for (const std::string& each : list) any += (any.empty() ? "" : ", ") + each;
  return R"({"anyOf": [)" + any + "]}";
}

std::string table_json(const Tables& tables, const std::string& title, const std::string& indent) {
  const auto table = tables.find(title);
  if (table == tables.end()) return R"({"type": "object"})";
  const std::string deeper = indent + "  ";
  std::string text = R"({"type": "object", "additionalProperties": false, "properties": {)";
  const char* separator = "\n";
  for (const auto& [key, forms] : table->second) {
    text += separator + deeper + json_text(key) + ": " + key_json(tables, forms, deeper);
    separator = ",\n";
  }
  return text + "\n" + indent + "}}";
}

}  // namespace

std::string place_of_key(const Master& master, const TomlValue& table, std::string_view key) {
  std::vector<const Found*> here;
  const Found* elsewhere = nullptr;
  for (const Found& found : all_keys()) {
    if (found.asked.key != key) continue;
    const auto protocol = found.sample.find("protocol");
    if (protocol != found.sample.end() && protocol->second.empty()) continue;
    if (found.asked.table == table.where.table) here.push_back(&found);
    const bool of_master = found.sample.at("type") == master.type;
    if (of_master && elsewhere == nullptr) elsewhere = &found;
  }
  if (!here.empty()) {
    const std::string needs = condition(here, master, table);
    return needs.empty() ? "" : "; it goes with " + needs;
  }
  if (elsewhere == nullptr) return "";
  if (is_table(elsewhere->asked)) return "; write " + title_of(elsewhere->asked);
  const TomlValue* value = table.find(key);
  const std::string text = value == nullptr ? "" : toml_text(*value);
  return "; write " + std::string(key) + (text.empty() ? "" : " = " + text) + " under " +
         elsewhere->asked.table;
}

std::string scenario_schema() {
  const std::string all = table_json(all_tables(), "", "");
  return R"({"$schema": "http://json-schema.org/draft-07/schema#", "title": "openmb4 scenario", )" +
         all.substr(1) + "\n";
}

}  // namespace mb4::sim
