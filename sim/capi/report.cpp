// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/capi/report.hpp"

#include "sim/core/json_text.hpp"
#include "sim/core/number_text.hpp"

namespace mb4::sim {
namespace {

std::string fault_json(const FaultConfig& fault, const FaultRecord& record,
                       const FaultStory& story) {
  return "{\"kind\": " + json_text(fault.kind->name) +
         ", \"channel\": " + std::to_string(fault.channel) +
         ", \"slave\": " + std::to_string(fault.slave) + ", \"what\": " + json_text(record.what) +
         ", \"begin_ns\": " + ns_text(record.begin) +
         ", \"end_ns\": " + (record.end == kNever ? "null" : ns_text(record.end)) +
         ", \"frames\": " + std::to_string(story.frames) +
         ", \"ner_low\": " + std::to_string(story.error_low) + "}";
}

}  // namespace

std::string report_json(Simulator& simulator, const std::vector<FaultStory>& stories) {
  std::string out = "{\"time_ns\": " + ns_text(simulator.now()) + ", \"faults\": [";
  const std::vector<FaultRecord>& records = simulator.faults();
  for (std::size_t i = 0; i < records.size(); ++i) {
    const FaultStory story = i < stories.size() ? stories[i] : FaultStory{};
    const FaultConfig& fault = simulator.scenario().faults[records[i].config];
    out += (i == 0 ? "\n  " : ",\n  ") + fault_json(fault, records[i], story);
  }
  const HostCheck& check = simulator.host_check();
  out += "], \"host_violations\": {\"count\": " + std::to_string(check.count()) + ", \"first\": [";
  for (std::size_t i = 0; i < check.violations().size(); ++i) {
    const HostCheck::Violation& violation = check.violations()[i];
    out += (i == 0 ? "\n  " : ",\n  ") + ("{\"item\": " + json_text(violation.item)) +
           ", \"text\": " + json_text(violation.text) + "}";
  }
  out += "]}, \"hints\": [";
  const std::vector<Hint> hints = simulator.hints();
  for (std::size_t i = 0; i < hints.size(); ++i) {
    out += (i == 0 ? "\n  " : ",\n  ") + ("{\"kind\": " + json_text(hints[i].kind)) +
           ", \"place\": " + json_text(hints[i].place) + ", \"text\": " + json_text(hints[i].text) +
           "}";
  }
  return out + "]}\n";
}

}  // namespace mb4::sim
