// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/mb4/functional_coverage.hpp"

#include <algorithm>
#include <string_view>

#include "mb4_regs.hpp"
#include "mb4_regs_table.hpp"

namespace mb4::sim {
namespace {

namespace reg = mb4::regs;

// The frames of each protocol, in the order of CFGCH, by what starts them. Then the other requests
// of an instruction.
enum Kind : unsigned {
  kSingle,
  kRate,
  kMin,
  kInfinite,
  kStarts,
  kProtocols = 3,
  kReadC = kProtocols * kStarts,
  kWriteC,
  kCommand,
  kBroadcast,
  kReduced,
  kReadB,
  kWriteB,
  kWriteSsi,
  kInitB,
  kInitC,
  kKinds
};
constexpr unsigned kUnused = 3;           // CFGCH
constexpr unsigned kLastInfinite = 0x7F;  // FREQAGS, Table 37
constexpr unsigned kBissB = 0;
constexpr unsigned kBissC = 1;
constexpr unsigned kSsi = 2;

struct KindName {
  unsigned kind;
  const char* name;
};

// The frames of protocol P that kSingle to kInfinite start have the number P * kStarts + start.
constexpr std::array<KindName, kKinds> kKindNames{{
    {kBissB * kStarts + kSingle, "BiSS B frame, one"},
    {kBissB * kStarts + kRate, "BiSS B frame, AGS"},
    {kBissB * kStarts + kMin, "BiSS B frame, AGSMIN"},
    {kBissB * kStarts + kInfinite, "BiSS B frame, AGSINFINITE"},
    {kBissC * kStarts + kSingle, "BiSS C frame, one"},
    {kBissC * kStarts + kRate, "BiSS C frame, AGS"},
    {kBissC * kStarts + kMin, "BiSS C frame, AGSMIN"},
    {kBissC * kStarts + kInfinite, "BiSS C frame, AGSINFINITE"},
    {kSsi * kStarts + kSingle, "SSI frame, one"},
    {kSsi * kStarts + kRate, "SSI frame, AGS"},
    {kSsi * kStarts + kMin, "SSI frame, AGSMIN"},
    {kSsi * kStarts + kInfinite, "SSI frame, AGSINFINITE"},
    {kReadC, "BiSS C register read"},
    {kWriteC, "BiSS C register write"},
    {kCommand, "BiSS C addressed command"},
    {kBroadcast, "BiSS C broadcast command"},
    {kReduced, "BiSS C reduced control"},
    {kReadB, "BiSS B register read"},
    {kWriteB, "BiSS B register write"},
    {kWriteSsi, "SSI register write"},
    {kInitB, "BiSS B INIT"},
    {kInitC, "BiSS C INIT"},
}};

// The table has each kind once, at the place of its number.
constexpr bool kinds_in_order() {
  for (unsigned kind = 0; kind < kKinds; ++kind) {
    if (kKindNames[kind].kind != kind) return false;
  }
  return true;
}
static_assert(kinds_in_order());

constexpr bool is_access(unsigned kind) { return kind >= kReadC && kind <= kWriteSsi; }
constexpr bool is_init(unsigned kind) { return kind == kInitB || kind == kInitC; }

// True if a frame is of this kind because of the field. Then only one of its values can meet it.
bool makes(const reg::FieldInfo& field, unsigned kind) {
  const std::string_view name = field.name;
  if (name == "REGVERS") return is_access(kind) || is_init(kind);
  if (name == "CTS") return is_access(kind);
  if (name == "WNR") return is_access(kind) && kind != kCommand && kind != kBroadcast;
  if (name == "FREQAGS") {
    const unsigned start = kind % kStarts;
    return kind < kReadC && (start == kMin || start == kInfinite);
  }
  return false;
}

// True for a field that the host configures. AGS is not one: it tells how frames start.
bool is_configuration(const reg::FieldInfo& field) {
  return field.address >= reg::kAddrSlaveCfg && field.access == reg::Access::kReadWrite &&
         std::string_view(field.name) != "AGS";
}

unsigned classes(const reg::FieldInfo& field) { return field.width == 1 ? 2 : 4; }

unsigned class_of(const reg::FieldInfo& field, unsigned value) {
  if (field.width <= 2 || value <= 1) return value;
  return value == (1U << field.width) - 1 ? 3 : 2;
}

std::string class_name(const reg::FieldInfo& field, unsigned index) {
  if (field.width <= 2 || index <= 1) return std::to_string(index);
  return index == 2 ? "middle" : "maximum";
}

// A field and a kind of frame: the index of their first point.
struct Pair {
  const reg::FieldInfo* field;
  std::size_t first;
};

struct Table {
  std::array<std::vector<Pair>, kKinds> pairs;
  std::size_t points = 0;
  Table() {
    for (unsigned kind = 0; kind < kKinds; ++kind) {
      for (const reg::FieldInfo& field : reg::kFields) {
        if (!is_configuration(field) || makes(field, kind)) continue;
        pairs[kind].push_back({&field, points});
        points += classes(field);
      }
    }
  }
};

const Table& table() {
  static const Table made;
  return made;
}

}  // namespace

FunctionalCoverage::FunctionalCoverage() : counts_(table().points) {}

void FunctionalCoverage::restart() {
  image_.fill(0);
  for (const reg::FieldInfo& field : reg::kFields) {
    image_[field.address] |= static_cast<std::uint8_t>(field.reset << field.lsb);
  }
  asked_ = false;
  writes_ = {};
}

void FunctionalCoverage::pin_changed(Pin pin, bool level) {
  const bool changed = levels_[static_cast<std::size_t>(pin)] != level;
  levels_[static_cast<std::size_t>(pin)] = level;
  if (!changed) return;
  if (pin == Pin::kNres) {
    restart();
  } else if (pin == Pin::kEot) {
    if (!level) frame();
  } else {
    writes_.edge(pin, level, levels_, *this);
  }
}

void FunctionalCoverage::written(std::uint8_t address, std::uint8_t value) {
  image_[address] = value;
  if (address != reg::kAddrInstr) return;
  asked_ =
      (value & reg::BREAK::kMask) == 0 && (value & (reg::INSTR::kMask | reg::INIT::kMask)) != 0;
}

bool FunctionalCoverage::line_used(unsigned line, unsigned protocol) const {
  return (image_[reg::kAddrCfgch] >> reg::kFamilyCfgch.shift(line + 1) & kUnused) == protocol &&
         (line == 0 || (image_[reg::kAddrSlaveloc5] & reg::SLAVELOC5::kMask) != 0);
}

void FunctionalCoverage::frame() {
  const unsigned instruction = image_[reg::kAddrInstr];
  const unsigned code = instruction & reg::INSTR::kMask;
  const unsigned ctrl = image_[reg::kAddrCtrl];
  const bool asked = asked_;
  asked_ = false;
  const bool biss_c = (ctrl & reg::REGVERS::kMask) != 0;
  const bool write = (image_[reg::kAddrRegadr] & reg::WNR::kMask) != 0;
  if (asked && (instruction & reg::INIT::kMask) != 0) return hit(biss_c ? kInitC : kInitB);
  if (asked && (code == reg::kInstrControl || code == reg::kInstrControlReduced)) {
    const unsigned chosen = image_[reg::kAddrChsel] & reg::CHSEL::kMask;
    const auto on = [&](unsigned protocol) {
      return (((chosen & 1U) != 0 || chosen == 0) && line_used(0, protocol)) ||
             ((chosen & 2U) != 0 && line_used(1, protocol));
    };
    if (!biss_c && on(kBissB)) hit(write ? kWriteB : kReadB);
    if (biss_c && on(kSsi) && write) hit(kWriteSsi);
    if (biss_c && on(kBissC)) {
      if ((ctrl & reg::CTS::kMask) == 0) {
        hit(image_[reg::kAddrIds] == 0 ? kBroadcast : kCommand);
      } else {
        hit(write ? kWriteC : kReadC);
      }
      if (code == reg::kInstrControlReduced) hit(kReduced);
    }
  }
  unsigned start = kSingle;
  if ((instruction & reg::AGS::kMask) != 0) {
    const unsigned rate = image_[reg::kAddrFreqags];
    start = rate == reg::kFreqagsAgsMin                                 ? kMin
            : rate >= reg::kFreqagsAgsInfinite && rate <= kLastInfinite ? kInfinite
                                                                        : kRate;
  } else if (!asked || code == reg::kInstrControl || code == reg::kInstrControlReduced) {
    return;  // a control communication goes on
  }
  for (unsigned protocol = 0; protocol < kProtocols; ++protocol) {
    if (line_used(0, protocol) || line_used(1, protocol)) hit(protocol * kStarts + start);
  }
}

void FunctionalCoverage::hit(unsigned kind) {
  for (const auto& [field, first] : table().pairs[kind]) {
    const unsigned value = image_[field->address] >> field->lsb & ((1U << field->width) - 1);
    ++counts_[first + class_of(*field, value)];
  }
}

void FunctionalCoverage::add(const std::vector<std::uint64_t>& counts) {
  if (counts.size() != counts_.size()) return;
  for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += counts[i];
}

std::uint64_t FunctionalCoverage::reached() const {
  return counts_.size() -
         static_cast<std::uint64_t>(std::count(counts_.begin(), counts_.end(), 0U));
}

std::string FunctionalCoverage::text() const {
  std::string lines;
  for (unsigned kind = 0; kind < kKinds; ++kind) {
    for (const auto& [field, first] : table().pairs[kind]) {
      for (unsigned index = 0; index < classes(*field); ++index) {
        lines += std::to_string(counts_[first + index]) + "\t" + kKindNames[kind].name + "\t" +
                 field->name + "=" + class_name(*field, index) + "\n";
      }
    }
  }
  return lines;
}

}  // namespace mb4::sim
