// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/dsl/dsl_rtl_master.hpp"

#include <memory>
#include <vector>

#include "sim/core/toml_reader.hpp"
#include "sim/hosts/host_keys.hpp"
#include "sim/lines/duplex/duplex_lines.hpp"
#include "sim/masters/dsl/live_dsl.hpp"
#include "sim/masters/dsl_model/dsl_master.hpp"
#include "sim/model/axi_lite_groups.hpp"

namespace mb4::sim {
namespace {

constexpr HostInterface kDslInterfaces[] = {{"axi", false, "an AXI access is never aborted", true}};

// The published firmware's choices, which the map of the SDK brings.
constexpr dsl_model::LinkRules kPublished{.sample = dsl_model::SampleRule::kPublished,
                                          .quality = dsl_model::QualityRules::kFirmware,
                                          .recover = false,
                                          .stale_limit = 0,
                                          .check_answers = false};

void read_dsl_quirks(TomlReader& reader, ChipConfig& chip) {
  if (reader.boolean("SDK_MAP").value_or(false)) {
    chip.quirks = dsl_model::packed(kPublished) | dsl_model::kSdkMap;
  }
  dsl_model::read_rules(reader, chip);
}

void read_dsl_host(TomlReader& reader, const ChipConfig& chip, HostConfig& host) {
  read_word_keys(reader, chip.f_clk_hz, host);
  dsl_model::read_link_key(reader, host);
}

// Bus, line with its encoder, then the inside.
std::vector<WaveGroup> dsl_wave_groups(const HostConfig& /*host*/) {
  std::vector<WaveGroup> groups = axi_lite_groups();
  groups.insert(groups.end(), {{"line",
                                true,
                                {{"", "dsl_out_o"},
                                 {"", "dsl_en_o"},
                                 {"", "dsl_in_i"},
                                 {"", "encoder_line"},
                                 {"", "encoder_out"},
                                 {"", "encoder_ready"},
                                 {"", "sample_edge_o"},
                                 {"", "position_ready_o"},
                                 {"", "link_o"},
                                 {"", "irq_o"}},
                                {}},
                               {"link", true, {}, {"u_line.u_link."}},
                               {"receiver", false, {}, {"u_line.u_receiver."}},
                               {"sender", false, {}, {"u_line.u_tx."}},
                               {"safe positions", false, {}, {"u_vertical."}},
                               {"position", false, {}, {"u_position."}},
                               {"registers", false, {}, {"u_regs."}}});
  return groups;
}

}  // namespace

const Master kDslMaster{.type = "dsl",
                        .interfaces = kDslInterfaces,
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
                        .read_quirks = read_dsl_quirks,
                        .read_host = read_dsl_host,
                        .pin_by_name = dsl_pin_by_name,
                        .make = [](const MasterSetup& setup) -> std::unique_ptr<LiveMaster> {
                          return std::make_unique<LiveDsl>(setup);
                        },
                        .wave_groups = dsl_wave_groups};

}  // namespace mb4::sim
