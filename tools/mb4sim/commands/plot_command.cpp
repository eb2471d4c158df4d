// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <charconv>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "chip_setup.hpp"
#include "commands/commands.hpp"
#include "mb4/device.hpp"
#include "mb4sim/simulator.hpp"
#include "plot/control_diagram.hpp"
#include "plot/frame_diagram.hpp"
#include "plot/line_recording.hpp"
#include "plot/vcd_writer.hpp"
#include "report/exit_status.hpp"
#include "report/output_file.hpp"
#include "report/trace_file.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim_bus.hpp"

namespace mb4::tool {
namespace {

constexpr std::size_t kMaxEdges = 1000;  // of a frame that can be drawn
constexpr unsigned kFramesBehind = 15;   // a control frame
constexpr sim::Time kLongestEnd = sim::kPsPerSecond;

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

struct Access {
  std::uint8_t address = 0;
  std::vector<std::uint8_t> bytes;  // to write; to be read: as many
};

Access read_access(const std::string& text) {
  const auto [address, count] = halves(text, ':');
  Access access;
  access.address = static_cast<std::uint8_t>(number(address, 0x7F, "--read"));
  const unsigned bytes = count.empty() && !text.ends_with(':') ? 1 : number(count, 64, "--read");
  if (bytes == 0) throw UseError("--read: a count of 1 to 64 is needed");
  access.bytes.resize(bytes);
  return access;
}

Access write_access(const std::string& text) {
  auto [address, values] = halves(text, ':');
  Access access;
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

Command command_of(const PlotOptions& options) {
  const auto [code, ids] = halves(options.command, ':');
  Command command;
  command.channels = static_cast<std::uint8_t>(options.channel);  // bit 0 and bit 1
  command.code = static_cast<std::uint8_t>(number(code, 3, "--command"));
  for (const char id : ids) {
    if (id == ',') continue;
    command.ids = static_cast<std::uint8_t>(command.ids |
                                            1U << number(std::string_view(&id, 1), 7, "--command"));
  }
  return command;
}

bool is_control(const PlotOptions& options) {
  return !options.read.empty() || !options.write.empty() || !options.command.empty();
}

// --- doing it ------------------------------------------------------------------------------------

using TheDevice = Device<SimBus, SimClock>;

Result<void> access(const PlotOptions& options, TheDevice& device) {
  const SlaveAddress slave{static_cast<std::uint8_t>(options.channel),
                           static_cast<std::uint8_t>(options.id)};
  if (!options.read.empty()) {
    Access read = read_access(options.read);
    return device.control().read_registers(slave, read.address,
                                           {read.bytes.data(), read.bytes.size()});
  }
  if (!options.write.empty()) {
    const Access write = write_access(options.write);
    return device.control().write_registers(slave, write.address,
                                            {write.bytes.data(), write.bytes.size()});
  }
  return device.control().send(command_of(options));
}

// Lets the last frame end: its slaves are idle again.
void finish(sim::Simulator& simulator, sim::Line& line) {
  simulator.run_while_waiting([&] { return line.chain().idle() && line.sl(); },
                              simulator.now() + kLongestEnd);
  simulator.advance(10 * sim::kPsPerUs);
}

struct Picture {
  std::string svg;
  bool good = false;
};

Picture frame_picture(const PlotOptions& options, const LineRecording& recording,
                      const sim::ChannelConfig& channel, sim::Time now) {
  const std::vector<FrameTrace> frames = recording.frames(now);
  if (frames.size() < options.frame) {
    throw UseError(fmt::format("{}: only {} frame(s) on channel {} have ended", options.scenario,
                               frames.size(), options.channel));
  }
  const FrameTrace& trace = frames[options.frame - 1];
  if (trace.rising.size() > kMaxEdges) {
    throw UseError(fmt::format("frame {} has {} clocks, more than {} are not drawn", options.frame,
                               trace.rising.size(), kMaxEdges));
  }
  const DecodedFrame decoded = decode_frame(recording, trace, channel);
  const std::string title =
      options.title.empty() ? fmt::format("Frame {} of channel {}", options.frame, options.channel)
                            : options.title;
  return {timing_svg(frame_diagram(recording, decoded, channel, title)), decoded.good};
}

Picture control_picture(const PlotOptions& options, const LineRecording& recording,
                        const sim::ChannelConfig& channel, sim::Time now) {
  std::vector<ControlBits> bits;
  for (const FrameTrace& trace : recording.frames(now)) {
    const DecodedFrame decoded = decode_frame(recording, trace, channel);
    bits.push_back({decoded.cdm, decoded.cds});
  }
  const ControlFrame frame = decode_control(bits);
  if (frame.slots == 0) {
    throw UseError(fmt::format("{}: there was no control frame on channel {}", options.scenario,
                               options.channel));
  }
  const std::string title = options.title.empty()
                                ? fmt::format("Control frame of channel {}", options.channel)
                                : options.title;
  return {timing_svg(control_diagram(bits, frame, title)), frame.good};
}

void check(const PlotOptions& options, const sim::Scenario& scenario) {
  const unsigned asked = (options.read.empty() ? 0U : 1U) + (options.write.empty() ? 0U : 1U) +
                         (options.command.empty() ? 0U : 1U);
  if (asked > 1) throw UseError("only one of --read, --write and --command is possible");
  const sim::ChannelConfig* channel = scenario.channel(options.channel);
  if (channel == nullptr || channel->slaves.empty()) {
    throw UseError(
        fmt::format("{}: there is no slave on channel {}", options.scenario, options.channel));
  }
  if (is_control(options) && !channel->protocol().control) {
    throw UseError("control frames are drawn of BiSS C only");
  }
  // Mistakes in numbers show before anything is written.
  if (!options.read.empty()) read_access(options.read);
  if (!options.write.empty()) write_access(options.write);
  if (!options.command.empty()) command_of(options);
}

}  // namespace

int plot_command(const PlotOptions& options) {
  const sim::Scenario scenario = load_chip_scenario(options.scenario);
  const Config config = make_config(scenario);
  check(options, scenario);
  std::vector<Output> outputs;
  for (const auto& [name, path] : {std::pair{"--svg", options.svg}, {"--vcd", options.vcd}}) {
    if (path.empty()) continue;
    outputs.push_back({name, path});
    outputs.push_back({name, partial_path(path)});
  }
  require_distinct(outputs, inputs_of(options.scenario, scenario));
  std::unique_ptr<OutputFile> svg;
  std::unique_ptr<OutputFile> vcd;
  if (!options.svg.empty()) svg = std::make_unique<OutputFile>(options.svg);
  if (!options.vcd.empty()) vcd = std::make_unique<OutputFile>(options.vcd);

  sim::SimulatorOptions sim_options;
  sim_options.seed = options.seed;
  sim::Simulator simulator(scenario, sim_options);
  std::vector<std::unique_ptr<LineRecording>> recordings(2);
  for (const sim::ChannelConfig& channel : scenario.channels) {
    recordings[channel.number - 1] =
        std::make_unique<LineRecording>(*simulator.line(channel.number));
  }
  SimBus bus(simulator);
  SimClock clock(simulator);
  TheDevice device(bus, clock);
  Result<void> done = device.configure(config);
  Frame frame;
  if (done && is_control(options)) {
    done = access(options, device);
    // The host goes on with frames without control communication, so that the picture shows its
    // end.
    for (unsigned i = 0; i < kFramesBehind; ++i) static_cast<void>(device.read_all(frame));
  } else {
    for (unsigned i = 0; done && i < options.frame; ++i) done = device.read_all(frame);
  }
  finish(simulator, *simulator.line(options.channel));

  const LineRecording& recording = *recordings[options.channel - 1];
  const sim::ChannelConfig& channel = *scenario.channel(options.channel);
  const Picture picture = is_control(options)
                              ? control_picture(options, recording, channel, simulator.now())
                              : frame_picture(options, recording, channel, simulator.now());
  if (!done) fmt::print(stderr, "mb4sim: {}\n", describe(done.info()));
  if (vcd != nullptr) vcd->commit(lines_vcd(recordings, simulator.now()));
  if (svg != nullptr) {
    svg->commit(picture.svg);
  } else if (vcd == nullptr) {
    fmt::print("{}", picture.svg);
  }
  return done && picture.good ? kGood : kBad;
}

}  // namespace mb4::tool
