// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/dsl_model/dsl_quirks.hpp"

#include <cstdint>

#include "sim/core/toml_reader.hpp"

namespace mb4::sim::dsl_model {
namespace {

constexpr unsigned get(unsigned quirks, QuirkField field) {
  return quirks >> field.lsb & ((1U << field.width) - 1);
}

}  // namespace

LinkRules rules_of(const ChipConfig& chip) {
  const unsigned quirks = chip.quirks;
  LinkRules rules;
  rules.sample = static_cast<SampleRule>(get(quirks, kQuirkSample));
  rules.check = get(quirks, kQuirkCheck) != 0 ? CodeCheck::kStrict : CodeCheck::kPublished;
  rules.quality = static_cast<QualityRules>(get(quirks, kQuirkRules));
  rules.rssi_table = get(quirks, kQuirkTable) != 0;
  rules.recover = get(quirks, kQuirkRecover) != 0;
  rules.rx_start = get(quirks, kQuirkRxStart);
  rules.start_blocks = get(quirks, kQuirkBlocks);
  rules.vsync_limit = get(quirks, kQuirkVsync);
  rules.stale_limit = get(quirks, kQuirkStale);
  rules.strict_id = get(quirks, kQuirkId) != 0;
  rules.check_answers = get(quirks, kQuirkAnswers) != 0;
  rules.sdk_map = (quirks & kSdkMap) != 0;
  return rules;
}

void set_sample(ChipConfig& chip, SampleRule rule) {
  put(chip.quirks, kQuirkSample, static_cast<unsigned>(rule));
}

void read_rules(TomlReader& reader, ChipConfig& chip) {
  const auto flag = [&](const char* key, QuirkField field) {
    if (const auto on = reader.boolean(key)) put(chip.quirks, field, *on ? 1 : 0);
  };
  const auto number = [&](const char* key, QuirkField field, std::int64_t most) {
    if (const auto value = reader.integer(key, 0, most)) {
      put(chip.quirks, field, static_cast<unsigned>(*value));
    }
  };
  flag("RECOVER", kQuirkRecover);
  flag("STRICT_CODE", kQuirkCheck);
  flag("STRICT_ID", kQuirkId);
  flag("RSSI_TABLE", kQuirkTable);
  flag("CHECK_ANSWERS", kQuirkAnswers);
  number("SAMPLE", kQuirkSample, 2);
  if (const auto rules = reader.choice("RULES", {"document", "sick", "firmware"})) {
    put(chip.quirks, kQuirkRules, static_cast<unsigned>(*rules));
  }
  number("RX_START", kQuirkRxStart, 15);
  number("START_BLOCKS", kQuirkBlocks, kMaxBlocks);
  number("VSYNC_LIMIT", kQuirkVsync, 255);
  number("STALE_LIMIT", kQuirkStale, 3);
}

void read_link_key(TomlReader& reader, HostConfig& host) {
  constexpr double kMaxLinkMs = 1e5;
  if (const auto ms = reader.number("link_ms", 0.001, kMaxLinkMs)) {
    host.link_wait = from_us(*ms * 1000);
  }
}

}  // namespace mb4::sim::dsl_model
