// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "report/trace_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "report/exit_status.hpp"
#include "sim/model/wave_view.hpp"

namespace mb4::tool {
namespace {

bool is_vcd(const std::string& name) {
  std::string ending = name.substr(name.size() - std::min<std::size_t>(name.size(), 4));
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return ending == ".vcd";
}

// "x.fst" -> "x.gtkw"; other names get the ending added.
std::string view_path(const std::string& trace) {
  constexpr std::string_view kEnding = ".fst";
  const bool fst = trace.ends_with(kEnding);
  return trace.substr(0, trace.size() - (fst ? kEnding.size() : 0)) + ".gtkw";
}

}  // namespace

std::vector<std::string> inputs_of(const std::string& path, const sim::Scenario& scenario) {
  std::vector<std::string> inputs;
  if (!path.empty()) inputs.push_back(path);
  for (const sim::ChannelConfig& channel : scenario.channels) {
    for (const sim::SlaveConfig& slave : channel.slaves) {
      if (!slave.file.empty()) inputs.push_back(slave.file);
    }
  }
  return inputs;
}

TraceFile::TraceFile(const std::string& option, const std::string& scenario_path,
                     const sim::Scenario& scenario)
    : path_(option), master_(scenario.master), host_(scenario.host) {
  if (path_.empty()) return;
  if (master_->wave_groups == nullptr) {
    throw UseError(fmt::format("--trace: the master \"{}\" writes no waveform", master_->type));
  }
  if (master_->wave_groups(host_).empty()) {
    throw UseError(fmt::format("--trace: with the interface \"{}\" there is no waveform",
                               host_.interface.key));
  }
  if (is_vcd(path_)) {
    throw UseError(
        "--trace: " + path_ +
        ": a waveform is written as FST, call it .fst (fst2vcd of GTKWave makes VCD of it)");
  }
  // The FST writer keeps a second file while it works.
  for (const std::string& file : {path_, link_target(path_) + ".hier", view_path(path_)}) {
    require_regular(file);
    outputs_.push_back({"--trace", file});
  }
  require_distinct(outputs_, inputs_of(scenario_path, scenario));
  require_writable(path_);
  require_writable(view_path(path_));
}

std::optional<std::string> TraceFile::path() const {
  if (path_.empty()) return std::nullopt;
  // The FST writer would replace a link instead of following it.
  return link_target(path_);
}

void TraceFile::write_view(std::optional<sim::Time> marker) const {
  if (path_.empty()) return;
  sim::write_wave_view(path_, view_path(path_), master_->wave_groups(host_), marker);
}

}  // namespace mb4::tool
