// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What both masters of DSL read of a scenario: the clock, how long a host waits for the link, and
// the rules of a link. These are in ChipConfig::quirks bit by bit as dsl_pkg::quirks_t has them.
#ifndef MB4SIM_DSL_MODEL_DSL_QUIRKS_HPP_
#define MB4SIM_DSL_MODEL_DSL_QUIRKS_HPP_

#include <cstdint>

#include "sim/hosts/host_config.hpp"
#include "sim/masters/chip_config.hpp"
#include "sim/masters/dsl_model/link.hpp"

namespace mb4::sim {
class TomlReader;
}

namespace mb4::sim::dsl_model {

inline constexpr std::int64_t kClkHz = 75'000'000;
inline constexpr std::int64_t kMinClkHz = kClkHz - kClkHz / 1000;  // 1000 ppm
inline constexpr std::int64_t kMaxClkHz = kClkHz + kClkHz / 1000;

// The map of the SDK, which only a master with registers has.
inline constexpr unsigned kSdkMap = 1U << 27U;

struct QuirkField {
  unsigned lsb;
  unsigned width;
};
inline constexpr QuirkField kQuirkStale{0, 2};
inline constexpr QuirkField kQuirkVsync{2, 8};
inline constexpr QuirkField kQuirkBlocks{10, 5};
inline constexpr QuirkField kQuirkRxStart{15, 4};
inline constexpr QuirkField kQuirkTable{19, 1};
inline constexpr QuirkField kQuirkRules{20, 2};
inline constexpr QuirkField kQuirkSample{22, 2};
inline constexpr QuirkField kQuirkId{24, 1};
inline constexpr QuirkField kQuirkCheck{25, 1};
inline constexpr QuirkField kQuirkRecover{26, 1};
inline constexpr QuirkField kQuirkAnswers{28, 1};
static_assert(kSdkMap == 2U << kQuirkRecover.lsb);

constexpr void put(unsigned& quirks, QuirkField field, unsigned value) {
  quirks = (quirks & ~(((1U << field.width) - 1) << field.lsb)) | value << field.lsb;
}

constexpr unsigned packed(const LinkRules& rules) {
  unsigned quirks = rules.sdk_map ? kSdkMap : 0;
  put(quirks, kQuirkSample, static_cast<unsigned>(rules.sample));
  put(quirks, kQuirkCheck, rules.check == CodeCheck::kStrict ? 1 : 0);
  put(quirks, kQuirkRules, static_cast<unsigned>(rules.quality));
  put(quirks, kQuirkTable, rules.rssi_table ? 1 : 0);
  put(quirks, kQuirkRecover, rules.recover ? 1 : 0);
  put(quirks, kQuirkRxStart, rules.rx_start);
  put(quirks, kQuirkBlocks, rules.start_blocks);
  put(quirks, kQuirkVsync, rules.vsync_limit);
  put(quirks, kQuirkStale, rules.stale_limit);
  put(quirks, kQuirkId, rules.strict_id ? 1 : 0);
  put(quirks, kQuirkAnswers, rules.check_answers ? 1 : 0);
  return quirks;
}

// The rules that [chip.quirks] has asked for.
LinkRules rules_of(const ChipConfig& chip);
// Another rule of the sample than [chip.quirks] has asked for.
void set_sample(ChipConfig& chip, SampleRule rule);

// The keys of [chip.quirks] but SDK_MAP, and `link_ms` of [host]. Throw ScenarioError.
void read_rules(TomlReader& reader, ChipConfig& chip);
void read_link_key(TomlReader& reader, HostConfig& host);

}  // namespace mb4::sim::dsl_model

#endif  // MB4SIM_DSL_MODEL_DSL_QUIRKS_HPP_
