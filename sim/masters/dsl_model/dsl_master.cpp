// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/dsl_model/dsl_master.hpp"

#include <memory>
#include <string_view>

#include "sim/core/toml_reader.hpp"
#include "sim/core/trace_error.hpp"
#include "sim/lines/duplex/duplex_lines.hpp"
#include "sim/masters/live_master.hpp"

namespace mb4::sim {
namespace dsl_model {
namespace {

constexpr HostInterface kInterfaces[] = {{"none", false, "this master has no bus"}};
constexpr std::int64_t kClkHz = 75'000'000;
constexpr std::int64_t kClkSpan = kClkHz / 1000;  // 1000 ppm
constexpr double kMaxLinkMs = 1e5;

// ChipConfig::quirks: the fields of LinkRules in a row.
struct Field {
  unsigned lsb;
  unsigned width;
};
constexpr Field kQuirkSample{0, 2};
constexpr Field kQuirkCheck{2, 1};
constexpr Field kQuirkRules{3, 2};
constexpr Field kQuirkTable{5, 1};
constexpr Field kQuirkRecover{6, 1};
constexpr Field kQuirkRxStart{7, 4};
constexpr Field kQuirkBlocks{11, 5};
constexpr Field kQuirkVsync{16, 8};
constexpr Field kQuirkStale{24, 2};

constexpr unsigned get(unsigned quirks, Field field) {
  return quirks >> field.lsb & ((1U << field.width) - 1);
}
constexpr void put(unsigned& quirks, Field field, unsigned value) {
  quirks = (quirks & ~(((1U << field.width) - 1) << field.lsb)) | value << field.lsb;
}

constexpr unsigned packed(const LinkRules& rules) {
  unsigned quirks = 0;
  put(quirks, kQuirkSample, static_cast<unsigned>(rules.sample));
  put(quirks, kQuirkCheck, rules.check == CodeCheck::kStrict ? 1 : 0);
  put(quirks, kQuirkRules, static_cast<unsigned>(rules.quality));
  put(quirks, kQuirkTable, rules.rssi_table ? 1 : 0);
  put(quirks, kQuirkRecover, rules.recover ? 1 : 0);
  put(quirks, kQuirkRxStart, rules.rx_start);
  put(quirks, kQuirkBlocks, rules.start_blocks);
  put(quirks, kQuirkVsync, rules.vsync_limit);
  put(quirks, kQuirkStale, rules.stale_limit);
  return quirks;
}

void read_quirks(TomlReader& reader, ChipConfig& chip) {
  const auto flag = [&](const char* key, Field field) {
    if (const auto on = reader.boolean(key)) put(chip.quirks, field, *on ? 1 : 0);
  };
  const auto number = [&](const char* key, Field field, std::int64_t most) {
    if (const auto value = reader.integer(key, 0, most)) {
      put(chip.quirks, field, static_cast<unsigned>(*value));
    }
  };
  flag("RECOVER", kQuirkRecover);
  flag("STRICT_CODE", kQuirkCheck);
  flag("RSSI_TABLE", kQuirkTable);
  number("SAMPLE", kQuirkSample, 2);
  if (const auto rules = reader.choice("RULES", {"document", "sick", "firmware"})) {
    put(chip.quirks, kQuirkRules, static_cast<unsigned>(*rules));
  }
  number("RX_START", kQuirkRxStart, 15);
  number("START_BLOCKS", kQuirkBlocks, kMaxBlocks);
  number("VSYNC_LIMIT", kQuirkVsync, 255);
  number("STALE_LIMIT", kQuirkStale, 3);
}

void read_host(TomlReader& reader, const ChipConfig& /*chip*/, HostConfig& host) {
  if (const auto ms = reader.number("link_ms", 0.001, kMaxLinkMs)) {
    host.link_wait = from_us(*ms * 1000);
  }
}

class LiveLink final : public LiveMaster {
 public:
  explicit LiveLink(const MasterSetup& setup)
      : model_(rules_of(setup.chip), setup.chip.f_clk_hz, kResetLow), host_(model_) {
    if (setup.trace != nullptr) {
      throw TraceError(setup.trace->path + ": this master writes no waveform");
    }
  }
  MasterModel& model() override { return model_; }
  void power_on() override {}
  HostModel* host(std::string_view name) override {
    return name == kInterfaces[0].key ? &host_ : nullptr;
  }

 private:
  LinkModel model_;
  LinkHost host_;
};

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
  return rules;
}

void set_sample(ChipConfig& chip, SampleRule rule) {
  put(chip.quirks, kQuirkSample, static_cast<unsigned>(rule));
}

std::optional<LinkFrame> LinkHost::take() {
  if (frames_.empty()) return std::nullopt;
  const LinkFrame frame = frames_.front();
  frames_.pop_front();
  return frame;
}

}  // namespace dsl_model

const Master kDslModelMaster{.type = "dsl-model",
                             .interfaces = dsl_model::kInterfaces,
                             .line = &kDuplexLines,
                             .channels = 1,
                             .slaves = 1,
                             .slaves_shared = 1,
                             .min_clk_hz = dsl_model::kClkHz - dsl_model::kClkSpan,
                             .max_clk_hz = dsl_model::kClkHz + dsl_model::kClkSpan,
                             .min_osc_hz = 0,
                             .max_osc_hz = 0,
                             .clk_needed = true,
                             .clk_hz = dsl_model::kClkHz,
                             .quirks = dsl_model::packed(dsl_model::LinkRules{}),
                             .read_quirks = dsl_model::read_quirks,
                             .read_host = dsl_model::read_host,
                             .pin_by_name = nullptr,
                             .make = [](const MasterSetup& setup) -> std::unique_ptr<LiveMaster> {
                               return std::make_unique<dsl_model::LiveLink>(setup);
                             },
                             .wave_groups = nullptr};

}  // namespace mb4::sim
