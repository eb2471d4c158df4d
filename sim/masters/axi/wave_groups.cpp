// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/axi/wave_groups.hpp"

#include <array>
#include <string>
#include <string_view>

#include "sim/masters/axi/axi_model.hpp"

namespace mb4::sim {
namespace {

// Names that belong to a channel, and live as long as the program.
struct ChannelNames {
  std::string group, inside, ma, slo, encoder_ma, encoder_slo, encoder_ready, scope, delays;
  std::string word, result, state;
};

const std::array<ChannelNames, kAxiChannels>& channel_names() {
  static const auto names = [] {
    std::array<ChannelNames, kAxiChannels> all;
    for (unsigned line = 0; line < kAxiChannels; ++line) {
      const std::string number = std::to_string(line);
      const std::string scope = "gen_channel[" + number + "].u_channel.";
      all[line] = {.group = "channel " + number,
                   .inside = "inside channel " + number,
                   .ma = "ma" + number,
                   .slo = "slo" + number,
                   .encoder_ma = "encoder" + number + "_ma",
                   .encoder_slo = "encoder" + number + "_slo",
                   .encoder_ready = "encoder" + number + "_ready",
                   .scope = scope,
                   .delays = "gen_channel[" + number + "].gen_own_timebase.",
                   .word = scope + "u_word.word_q.",
                   .result = scope + "u_word.result_q.",
                   .state = scope + "state_q"};
    }
    return all;
  }();
  return names;
}

}  // namespace

// The first groups are those that a user of the master sees.
std::vector<WaveGroup> axi_wave_groups(const HostConfig& host) {
  const WaveGroup spi{
      "SPI", true, {{"", "ncs"}, {"", "sclk"}, {"", "mosi"}, {"", "miso"}}, {"gen_spi.u_spi."}};
  const std::vector<WaveGroup> axi{{"write",
                                    false,
                                    {{"", "S_AXI_AWVALID"},
                                     {"", "S_AXI_AWREADY"},
                                     {"", "S_AXI_AWADDR"},
                                     {"", "S_AXI_WVALID"},
                                     {"", "S_AXI_WREADY"},
                                     {"", "S_AXI_WDATA"},
                                     {"", "S_AXI_WSTRB"},
                                     {"", "S_AXI_BVALID"},
                                     {"", "S_AXI_BREADY"},
                                     {"", "S_AXI_BRESP"}},
                                    {}},
                                   {"read",
                                    false,
                                    {{"", "S_AXI_ARVALID"},
                                     {"", "S_AXI_ARREADY"},
                                     {"", "S_AXI_ARADDR"},
                                     {"", "S_AXI_RVALID"},
                                     {"", "S_AXI_RREADY"},
                                     {"", "S_AXI_RDATA"},
                                     {"", "S_AXI_RRESP"}},
                                    {}}};
  const WaveGroup stream{"stream",
                         true,
                         {{"", "s_axis_tvalid"},
                          {"", "s_axis_tready"},
                          {"", "s_axis_tlast"},
                          {"", "s_axis_tuser"},
                          {"", "s_axis_tdata"}},
                         {}};
  const bool behind_spi = host.interface == HostInterface::kSpi;
  std::vector<WaveGroup> groups{
      {"clock and reset", true, {{"", "axi_aclk"}, {"", "axi_aresetn"}, {"", "por_n"}}, {}}};
  if (behind_spi) {
    groups.push_back(spi);
  } else {
    groups.insert(groups.end(), axi.begin(), axi.end());
  }
  groups.push_back({"sample clock",
                    true,
                    {{"", "ext_sample_clk"}, {"", "sample_en"}, {"", "sample_clk_output"}},
                    {}});
  if (!behind_spi) groups.push_back(stream);
  groups.push_back({"pins", true, {{"", "error"}, {"", "warn"}, {"", "irq"}}, {}});
  for (const ChannelNames& names : channel_names()) {
    groups.push_back({names.group,
                      true,
                      {{"", names.ma},
                       {"", names.encoder_ma},
                       {"", names.encoder_slo},
                       {"", names.slo},
                       {"", names.encoder_ready}},
                      {names.state, names.word, names.result}});
  }
  groups.push_back({"registers", false, {}, {"u_regs."}});
  groups.push_back({"start of frames", false, {}, {"u_start.", "u_rule.", "u_timebase."}});
  for (const ChannelNames& names : channel_names()) {
    groups.push_back({names.inside, false, {}, {names.scope, names.delays}});
  }
  groups.push_back({"extras", false, {}, {"u_extras."}});
  return groups;
}

}  // namespace mb4::sim
