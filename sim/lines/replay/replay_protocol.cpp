// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/replay/replay_protocol.hpp"

#include "sim/core/text_file.hpp"
#include "sim/lines/clocked/clocked_lines.hpp"
#include "sim/lines/replay/replay_slave.hpp"
#include "sim/lines/sensor_keys.hpp"

namespace mb4::sim {
namespace {

constexpr unsigned kFlagsOfEncoders = 2;

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
  const auto name = reader.file_name("edges");
  if (!name) {
    reader.missing("edges", "missing: protocol \"replay\" needs a file of edges");
    return;
  }
  const std::string path = beside(reader.file().name, *name);
  std::string text;
  try {
    text = read_text_file(path);
  } catch (const ScenarioError& error) {
    reader.fail("edges", error.what());
  }
  try {
    config.recording = parse_recording(text, path);
  } catch (const RecordingError& error) {
    throw ScenarioError(error.what());
  }
  file = path;
}

void know_replay_keys(TomlReader& reader) {
  reader.know(
      {"data_bits", "flag_bits", "crc", "crc_start", "timeout", "t_sample_ns", "edges", "play"});
}

}  // namespace

const Protocol kReplayProtocol{"replay",         &kClockedLines,
                               know_replay_keys, [] { return Device(ReplaySlaveConfig()); },
                               nullptr,          read_replay};

}  // namespace mb4::sim
