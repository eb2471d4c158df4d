// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "report/fault_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>

#include "report/messages.hpp"

namespace mb4::tool {
namespace {

using Fate = FaultReport::Fate;

const char* to_string(Fate fate) {
  switch (fate) {
    case Fate::kDetected:
      return "detected";
    case Fate::kMissed:
      return "missed";
    default:
      return "no effect";
  }
}

struct KindCount {
  std::uint64_t injected = 0;
  std::array<std::uint64_t, 4> fates{};              // by Fate
  std::map<std::string, std::uint64_t> detected_by;  // error
};

// True for a fault that only accesses to registers show.
bool in_accesses(const sim::FaultConfig& fault) {
  const sim::SlaveFault* const of_slave = fault.kind->of_slave;
  return of_slave != nullptr && of_slave->in_accesses;
}

void add_to(KindCount& kind, const FaultReport::Entry& entry) {
  ++kind.injected;
  ++kind.fates[static_cast<std::size_t>(entry.fate)];
  if (entry.fate == Fate::kDetected) ++kind.detected_by[entry.error];
}

std::uint64_t of(const KindCount& kind, Fate fate) {
  return kind.fates[static_cast<std::size_t>(fate)];
}

std::string not_reached_text(const sim::FaultConfig& fault) {
  return fmt::format("did not happen: frame {} of channel {} has not come", fault.frame,
                     fault.channel);
}

std::string fault_text(const std::vector<sim::FaultRecord>& records, std::size_t index) {
  return fmt::format("fault {} at {:.3f} us: {}", index + 1, sim::to_us(records[index].begin),
                     records[index].what);
}

}  // namespace

std::string fault_lines(const std::vector<sim::FaultRecord>& records, std::size_t from) {
  std::string out;
  for (std::size_t i = from; i < records.size(); ++i) {
    out += fmt::format("  {}\n", fault_text(records, i));
  }
  return out;
}

void print_faults(bool json, const std::vector<sim::FaultRecord>& records, std::size_t from) {
  if (!json) fmt::print(stderr, "{}", fault_lines(records, from));
  for (std::size_t i = from; json && i < records.size(); ++i) {
    print_note(json, fault_text(records, i));
  }
}

FaultReport::FaultReport(const sim::Scenario& scenario,
                         const std::vector<sim::FaultRecord>& records)
    : scenario_(scenario), records_(records) {}

void FaultReport::add_new() { entries_.resize(records_.size()); }

void FaultReport::add(const SessionFrame& frame, Session& session) {
  this->frame(frame, session);
  if (const unsigned slave = unchecked_id(); slave != 0) id_checked(slave, session.check_id(slave));
}

void FaultReport::frame(const SessionFrame& frame, Session& session) {
  const std::vector<SlaveOutcome> outcomes = frame.outcomes(session.slaves());
  add_new();
  for (std::size_t i = first_open_; i < entries_.size(); ++i) {
    Entry& entry = entries_[i];
    if (entry.fate != Fate::kOpen) continue;
    const sim::FaultRecord& record = records_[i];
    const sim::FaultConfig& fault = scenario_.faults[record.config];
    if (in_accesses(fault)) continue;
    const bool named = fault.frame != 0;
    if (const std::string told = named ? session.told_between(fault.frame) : ""; !told.empty()) {
      entry.fate = Fate::kDetected;
      entry.error = told;
      entry.by = fmt::format("before frame {}: {}", frame.number, told);
      continue;
    }
    const SlaveOutcome* worst = nullptr;
    for (const SlaveOutcome& outcome : outcomes) {
      if (outcome.kind == SlaveOutcome::Kind::kRight) continue;
      if (fault.channel != 0 && fault.channel != outcome.channel) continue;
      if (worst == nullptr || outcome.kind > worst->kind) worst = &outcome;
    }
    if (worst != nullptr) {
      entry.fate = worst->kind == SlaveOutcome::Kind::kWrong ? Fate::kMissed : Fate::kDetected;
      entry.error = worst->state;
      entry.by = fmt::format("frame {}, slave {}: {}", frame.number, worst->slave, worst->state);
    } else if ((named || record.end <= frame.begin) && entry.late++ == session.late_frames()) {
      entry.fate = Fate::kNoEffect;
    }
  }
  while (first_open_ < entries_.size() && entries_[first_open_].fate != Fate::kOpen) ++first_open_;
}

unsigned FaultReport::unchecked_id() const {
  for (std::size_t i = first_open_; i < entries_.size(); ++i) {
    const sim::FaultConfig& fault = scenario_.faults[records_[i].config];
    if (in_accesses(fault) && entries_[i].fate == Fate::kOpen && !entries_[i].id_checked) {
      return fault.slave;
    }
  }
  return 0;
}

void FaultReport::id_checked(unsigned slave, const std::string& error) {
  for (std::size_t i = first_open_; i < entries_.size(); ++i) {
    const sim::FaultConfig& fault = scenario_.faults[records_[i].config];
    Entry& entry = entries_[i];
    if (!in_accesses(fault) || fault.slave != slave || entry.fate != Fate::kOpen) {
      continue;
    }
    entry.id_checked = true;
    if (error.empty()) continue;
    ids_good_ = false;
    entry.fate = Fate::kDetected;
    entry.error = error;
    entry.by = fmt::format("register access to slave {}: {}", slave, error);
  }
}

std::uint64_t FaultReport::count(Fate fate) const {
  return static_cast<std::uint64_t>(std::count_if(
      entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.fate == fate; }));
}

void FaultReport::finish() {
  add_new();
  for (Entry& entry : entries_) {
    if (entry.fate == Fate::kOpen) entry.fate = Fate::kNoEffect;
  }
}

std::vector<const sim::FaultConfig*> FaultReport::not_reached() const {
  std::vector<const sim::FaultConfig*> list;
  for (std::size_t i = 0; i < scenario_.faults.size(); ++i) {
    const sim::FaultConfig& fault = scenario_.faults[i];
    const bool came =
        std::any_of(records_.begin(), records_.end(),
                    [i](const sim::FaultRecord& record) { return record.config == i; });
    if (fault.frame != 0 && !came) list.push_back(&fault);
  }
  return list;
}

std::string FaultReport::new_lines() {
  std::string out = fault_lines(records_, printed_);
  printed_ = records_.size();
  return out;
}

std::string FaultReport::summary() const {
  if (!any()) return "";
  KindCount all;
  // Ordered as they are listed to the user: all kinds lie in one list.
  std::map<const sim::FaultType*, KindCount> kinds;
  for (const sim::FaultConfig& fault : scenario_.faults) kinds[fault.kind];
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    add_to(all, entries_[i]);
    add_to(kinds[scenario_.faults[records_[i].config].kind], entries_[i]);
  }
  const auto line = [](const KindCount& kind) {
    return fmt::format("injected {}, detected {}, no effect {}, missed {}", kind.injected,
                       of(kind, Fate::kDetected), of(kind, Fate::kNoEffect),
                       of(kind, Fate::kMissed));
  };
  std::string out = fmt::format("faults: {}\n", line(all));
  for (const auto& [kind, counts] : kinds) {
    out += fmt::format("  {:<15}  {}\n", kind->name, line(counts));
    for (const auto& [error, number] : counts.detected_by) {
      out += fmt::format("  {:<15}    detected by: {} ({})\n", "", error, number);
    }
    for (const sim::FaultConfig* fault : not_reached()) {
      if (fault->kind == kind) out += fmt::format("  {:<15}    {}\n", "", not_reached_text(*fault));
    }
  }
  return out;
}

std::string FaultReport::json() const {
  std::string out = "[";
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const sim::FaultRecord& record = records_[i];
    const Entry& entry = entries_[i];
    out += fmt::format(
        "{}\n  {{\"fault\": {}, \"line\": {}, \"kind\": \"{}\", \"time_us\": {:.6f}, \"end_us\": "
        "{}, \"what\": {}, \"fate\": \"{}\", \"by\": {}}}",
        i == 0 ? "" : ",", i + 1, scenario_.faults[record.config].scenario_line,
        scenario_.faults[record.config].kind->name, sim::to_us(record.begin),
        record.end == sim::kNever ? "null" : fmt::format("{:.6f}", sim::to_us(record.end)),
        json_text(record.what), to_string(entry.fate),
        entry.by.empty() ? "null" : json_text(entry.by));
  }
  for (const sim::FaultConfig* fault : not_reached()) {
    out += fmt::format(
        "{}\n  {{\"fault\": null, \"line\": {}, \"kind\": \"{}\", \"time_us\": null, \"end_us\": "
        "null, \"what\": {}, \"fate\": \"not reached\", \"by\": null}}",
        out.size() == 1 ? "" : ",", fault->scenario_line, fault->kind->name,
        json_text(not_reached_text(*fault)));
  }
  return out + "]";
}

}  // namespace mb4::tool
