// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands/commands.hpp"
#include "plot/pictures.hpp"
#include "plot/vcd_writer.hpp"
#include "plot/wave_json.hpp"
#include "report/exit_status.hpp"
#include "report/output_file.hpp"
#include "report/picture_file.hpp"
#include "report/trace_file.hpp"
#include "scenario_argument.hpp"
#include "session.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {
namespace {

constexpr unsigned kFramesBehind = 15;  // a control frame

// --- what is asked for -------------------------------------------------------------------------

unsigned number(std::string_view text, unsigned maximum, const char* option) {
  const bool hex = text.starts_with("0x") || text.starts_with("0X");
  const std::string_view digits = hex ? text.substr(2) : text;
  unsigned value = 0;
  const auto [stop, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value, hex ? 16 : 10);
  if (error != std::errc() || stop != digits.data() + digits.size() || value > maximum) {
    throw UseError(fmt::format("{}: '{}' is no whole number of 0 to {}", option, text, maximum));
  }
  return value;
}

// The two sides of "A:B".
std::pair<std::string, std::string> halves(const std::string& text, char between) {
  const std::size_t at = text.find(between);
  if (at == std::string::npos) return {text, ""};
  return {text.substr(0, at), text.substr(at + 1)};
}

ControlRequest read_access(const std::string& text) {
  const auto [address, count] = halves(text, ':');
  ControlRequest access;
  access.kind = ControlRequest::Kind::kRead;
  access.address = static_cast<std::uint8_t>(number(address, 0x7F, "--read"));
  const unsigned bytes = count.empty() && !text.ends_with(':') ? 1 : number(count, 64, "--read");
  if (bytes == 0) throw UseError("--read: a count of 1 to 64 is needed");
  access.bytes.resize(bytes);
  return access;
}

ControlRequest write_access(const std::string& text) {
  auto [address, values] = halves(text, ':');
  ControlRequest access;
  access.kind = ControlRequest::Kind::kWrite;
  access.address = static_cast<std::uint8_t>(number(address, 0x7F, "--write"));
  for (bool more = true; more;) {
    more = values.find(',') != std::string::npos;
    const auto [value, rest] = halves(values, ',');
    access.bytes.push_back(static_cast<std::uint8_t>(number(value, 0xFF, "--write")));
    values = rest;
  }
  if (access.bytes.size() > 64) throw UseError("--write: more than 64 bytes");
  return access;
}

ControlRequest command_of(const std::string& text) {
  const auto [code, ids] = halves(text, ':');
  ControlRequest command;
  command.kind = ControlRequest::Kind::kCommand;
  command.code = static_cast<std::uint8_t>(number(code, 3, "--command"));
  for (const char id : ids) {
    if (id == ',') continue;
    command.ids = static_cast<std::uint8_t>(command.ids |
                                            1U << number(std::string_view(&id, 1), 7, "--command"));
  }
  return command;
}

ControlRequest resource_of(const std::string& text) {
  const auto [id, offset] = halves(text, ':');
  ControlRequest request;
  request.kind = ControlRequest::Kind::kResource;
  request.resource = number(id, 0x3FF, "--resource");
  if (!offset.empty() || text.ends_with(':')) {
    request.offset = number(offset, 0x7FFF, "--resource");
  }
  return request;
}

bool is_control(const PlotOptions& options) {
  return !options.read.empty() || !options.write.empty() || !options.command.empty() ||
         !options.resource.empty();
}

ControlRequest request_of(const PlotOptions& options) {
  ControlRequest request = !options.read.empty()      ? read_access(options.read)
                           : !options.write.empty()   ? write_access(options.write)
                           : !options.command.empty() ? command_of(options.command)
                                                      : resource_of(options.resource);
  request.channel = options.channel;
  request.id = options.id;
  return request;
}

// A message has one byte, and commands are none.
void check_message(const PlotOptions& options) {
  if (!options.command.empty())
    throw UseError("--command: control frames are drawn of BiSS C only");
  const ControlRequest request = request_of(options);
  if (request.kind == ControlRequest::Kind::kResource) return;
  constexpr std::uint8_t kLowest = 0x40;
  const char* const option = options.read.empty() ? "--write" : "--read";
  if (request.address < kLowest) {
    throw UseError(fmt::format("{}: registers of this encoder are 0x40 to 0x7F", option));
  }
  if (request.bytes.size() != 1) throw UseError(fmt::format("{}: a message has one byte", option));
}

// --- doing it ------------------------------------------------------------------------------------

void check(const PlotOptions& options, const sim::Scenario& scenario) {
  const unsigned asked = (options.read.empty() ? 0U : 1U) + (options.write.empty() ? 0U : 1U) +
                         (options.command.empty() ? 0U : 1U) + (options.resource.empty() ? 0U : 1U);
  if (asked > 1) {
    throw UseError("only one of --read, --write, --command and --resource is possible");
  }
  const sim::ChannelConfig* channel = scenario.channel(options.channel);
  if (channel == nullptr || channel->slaves.empty()) {
    throw UseError(
        fmt::format("{}: there is no slave on channel {}", options.scenario, options.channel));
  }
  if (picture_of(scenario, *channel) == nullptr) {
    throw UseError(fmt::format("{}: there is no picture of \"{}\"", options.scenario,
                               channel->protocol().title));
  }
  const bool messages = support_of(scenario).messages;
  if (is_control(options) && !channel->protocol().control && !messages) {
    throw UseError("control frames are drawn of BiSS C only");
  }
  if (!options.resource.empty() && !messages) {
    throw UseError("--resource: only an encoder with DSL has resources");
  }
  if (is_control(options) && messages) check_message(options);
  if (is_control(options) && !support_of(scenario).control && !messages) {
    throw UseError(fmt::format("{}: the master \"{}\" makes no control frames", options.scenario,
                               scenario.master->type));
  }
  if (options.svg.empty() && options.wavejson.empty() && options.vcd.empty() &&
      ::isatty(STDOUT_FILENO) != 0) {
    throw UseError("plot prints SVG, which no terminal shows: give --svg FILE.svg, or > FILE.svg");
  }
  // Mistakes in numbers show before anything is written.
  if (is_control(options)) request_of(options);
}

}  // namespace

int plot_command(const PlotOptions& options) {
  const sim::Scenario scenario = open_scenario(options.scenario);
  const MasterSupport& support = support_of(scenario);
  support.check(scenario);
  check(options, scenario);
  std::vector<Output> outputs;
  for (const auto& [name, path] : {std::pair{"--svg", options.svg},
                                   {"--wavejson", options.wavejson},
                                   {"--vcd", options.vcd}}) {
    if (path.empty()) continue;
    outputs.push_back({name, path});
    outputs.push_back({name, partial_path(path)});
  }
  require_distinct(outputs, inputs_of(options.scenario, scenario));
  std::unique_ptr<PictureFile> svg;
  std::unique_ptr<OutputFile> wavejson;
  std::unique_ptr<OutputFile> vcd;
  if (!options.svg.empty()) svg = std::make_unique<PictureFile>(options.svg);
  if (!options.wavejson.empty()) wavejson = std::make_unique<OutputFile>(options.wavejson);
  if (!options.vcd.empty()) vcd = std::make_unique<OutputFile>(options.vcd);

  SessionOptions session_options;
  session_options.simulator.seed = options.seed;
  session_options.actuators = false;
  const std::unique_ptr<Session> session = support.open(scenario, session_options);
  sim::Simulator& simulator = session->simulator();
  std::map<unsigned, std::unique_ptr<LinePicture>> pictures;  // by channel
  for (const sim::ChannelConfig& channel : scenario.channels) {
    const PictureDecoder* const decoder = picture_of(scenario, channel);
    if (decoder != nullptr) pictures[channel.number] = decoder->record(simulator, channel);
  }
  std::string error = session->configure();
  if (error.empty() && is_control(options)) {
    error = session->access(request_of(options));
    // The host goes on with frames without control communication, so that the picture shows its
    // end.
    for (unsigned i = 1; i <= kFramesBehind; ++i) session->read(i);
  } else {
    for (unsigned i = 1; error.empty() && i <= options.frame; ++i) error = session->read(i).error;
  }
  LinePicture& line = *pictures.at(options.channel);
  line.finish(simulator);
  const Picture picture = line.draw(
      {options.frame, is_control(options), options.scenario, options.title}, simulator.now());
  if (!error.empty()) fmt::print(stderr, "mb4sim: {}\n", error);
  if (vcd != nullptr) vcd->commit(lines_vcd(pictures, simulator.now()));
  if (wavejson != nullptr) wavejson->commit(wave_json(picture.diagram));
  if (svg != nullptr) {
    svg->commit(timing_svg(picture.diagram));
  } else if (vcd == nullptr && wavejson == nullptr) {
    fmt::print("{}", timing_svg(picture.diagram));
  }
  return error.empty() && picture.good ? kGood : kBad;
}

}  // namespace mb4::tool
