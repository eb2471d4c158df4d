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

void read_host(TomlReader& reader, const ChipConfig& /*chip*/, HostConfig& host) {
  read_link_key(reader, host);
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
                             .min_clk_hz = dsl_model::kMinClkHz,
                             .max_clk_hz = dsl_model::kMaxClkHz,
                             .min_osc_hz = 0,
                             .max_osc_hz = 0,
                             .clk_needed = true,
                             .clk_hz = dsl_model::kClkHz,
                             .quirks = dsl_model::packed(dsl_model::LinkRules{}),
                             .read_quirks = dsl_model::read_rules,
                             .read_host = dsl_model::read_host,
                             .pin_by_name = nullptr,
                             .make = [](const MasterSetup& setup) -> std::unique_ptr<LiveMaster> {
                               return std::make_unique<dsl_model::LiveLink>(setup);
                             },
                             .wave_groups = nullptr};

}  // namespace mb4::sim
