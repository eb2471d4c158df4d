// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/replay/replay_protocol.hpp"

#include "sim/core/text_file.hpp"
#include "sim/lines/clocked/clocked_lines.hpp"
#include "sim/lines/replay/capture.hpp"
#include "sim/lines/replay/replay_slave.hpp"
#include "sim/lines/sensor_keys.hpp"

namespace mb4::sim {
namespace {

constexpr unsigned kFlagsOfEncoders = 2;
constexpr std::size_t kMaxEdgesMib = 16;
constexpr std::size_t kMaxCaptureMib = 256;

// Reads the file `name` of a key; its mistakes become those of the scenario.
template <typename Parse>
ReplayRecording read_file(TomlReader& reader, const char* key, const std::string& name,
                          std::size_t mib, std::string& file, Parse parse) {
  file = beside(reader.file().name, name);
  std::string bytes;
  try {
    bytes = read_text_file(file, mib);
  } catch (const ScenarioError& error) {
    reader.fail(key, error.what());
  }
  try {
    return parse(bytes, file);
  } catch (const RecordingError& error) {
    throw ScenarioError(error.what());
  }
}

void read_edges(TomlReader& reader, ReplaySlaveConfig& config, std::string& file) {
  const auto name = reader.file_name("edges");
  if (!name) {
    reader.missing("edges", "missing: protocol \"replay\" needs a file of edges, or a 'capture'");
    return;
  }
  config.recording = read_file(reader, "edges", *name, kMaxEdgesMib, file, parse_recording);
}

void read_capture(TomlReader& reader, ReplaySlaveConfig& config, std::string& file) {
  if (reader.has("edges")) reader.fail("edges", "not together with 'capture'");
  const auto name = reader.file_name("capture");
  CaptureNames names;
  for (const auto& [key, signal] : {std::pair{"ma", &names.ma}, {"sl", &names.sl}}) {
    const auto text = reader.text(key);
    if (!text) reader.missing(key, "missing: the name of this signal in the capture");
    *signal = text.value_or("");
  }
  const std::size_t invert = reader.choice("invert", {"none", "ma", "sl", "both"}).value_or(0);
  const Time rest = from_us(reader.number("rest_us", 0, 1e6).value_or(0));
  const auto frame = reader.integer("frame", 1, 1'000'000'000);
  if (names.ma.empty() || names.sl.empty()) return;
  config.recording = read_file(reader, "capture", *name, kMaxCaptureMib, file,
                               [&](std::string_view bytes, const std::string& path) {
                                 Capture capture = parse_capture(bytes, path, names);
                                 if (invert == 1 || invert == 3) capture.ma.invert();
                                 if (invert == 2 || invert == 3) capture.sl.invert();
                                 return frames_of(capture, rest, path, names);
                               });
  auto& frames = config.recording.frames;
  if (!frame) return;
  if (static_cast<std::uint64_t>(*frame) > frames.size()) {
    reader.fail("frame", "the capture has " + std::to_string(frames.size()) + " frame(s) to play");
  }
  frames = {frames[static_cast<std::size_t>(*frame) - 1]};
}

void read_replay(TomlReader& reader, DeviceConfig& device, std::string& file) {
  auto& config = static_cast<ReplaySlaveConfig&>(device);
  read_lengths(reader, config.data_bits, config.flag_bits, kFlagsOfEncoders);
  config.crc = Crc{0x43, 0};
  read_crc(reader, config.crc);
  if (reader.choice("play", {"time", "clock"}).value_or(0) == 1) {
    config.play = ReplaySlaveConfig::Play::kClock;
    read_timeout(reader, config.timeout);
  } else if (reader.has("timeout")) {
    reader.fail("timeout", "only with play = \"clock\": the recording holds the timeout");
  }
  if (reader.has("capture")) {
    read_capture(reader, config, file);
  } else {
    for (const char* key : {"ma", "sl", "invert", "rest_us", "frame"}) {
      if (reader.has(key)) reader.fail(key, "only with the key 'capture'");
    }
    read_edges(reader, config, file);
  }
}

void know_replay_keys(TomlReader& reader) {
  reader.know({"data_bits", "flag_bits", "crc", "crc_start", "timeout", "t_sample_ns", "edges",
               "play", "capture", "ma", "sl", "invert", "rest_us", "frame"});
}

}  // namespace

const Protocol kReplayProtocol{"replay",         &kClockedLines,
                               know_replay_keys, [] { return Device(ReplaySlaveConfig()); },
                               nullptr,          read_replay};

}  // namespace mb4::sim
