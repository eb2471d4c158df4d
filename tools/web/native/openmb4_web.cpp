// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The C interfaces of simulator and driver as the page calls them: one chip, numbers and JSON texts
// instead of structs. It calls mb4sim.h, mb4.h and openmb4_session.h, as the Python package does,
// and the lists of encoders and frequencies. A text that a function returns is valid until the next
// call. Numbers of 64 bits are decimal texts in JSON, where a JavaScript number would round them.
#include <emscripten/emscripten.h>
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "openmb4_session.h"
#include "sim/core/json_text.hpp"
#include "sim/lines/presets.hpp"
#include "sim/masters/mb4/ma_frequency.hpp"

namespace {

constexpr std::size_t kErrorBytes = 1000;
constexpr std::size_t kMaxEdges = 200'000;  // until web_edges() takes them; later ones are lost

struct Edge {
  double time_ns;
  double channel;
  double place;
  double level;
};

mb4sim* sim = nullptr;
openmb4_session session;
mb4_config config;
std::string scenario_text;
std::string answer;
std::vector<Edge> edges;
std::vector<mb4sim_frame> frames;

const char* tell(std::string text) {
  answer = std::move(text);
  return answer.c_str();
}

// "" for success; otherwise what mb4sim says too.
std::string words(mb4_result result) {
  if (result.code == MB4_OK) return "";
  std::string text = mb4_error_text(result.code);
  if (result.field != 0) text += fmt::format(": {}", mb4_field_text(result.field));
  if (result.number != 0) text += fmt::format(" of {}", result.number);
  if (result.code == MB4_VERIFY) text += fmt::format(" at register 0x{:02X}", result.detail);
  return text;
}

// Why the simulator has stopped, or the name of the error.
std::string simulator_words(int error) {
  std::array<char, kErrorBytes> text{};
  mb4sim_advance_ns(sim, 0);
  if (mb4sim_last_error(sim, text.data(), text.size()) != 0) return text.data();
  return fmt::format("simulator: error {}", error);
}

void keep_edge(void*, unsigned channel, unsigned place, uint64_t time_ps, int level) {
  if (edges.size() >= kMaxEdges) return;
  edges.push_back({static_cast<double>(time_ps) / 1000, static_cast<double>(channel),
                   static_cast<double>(place), static_cast<double>(level)});
}

void keep_frame(void*, const mb4sim_frame* frame) { frames.push_back(*frame); }

}  // namespace

extern "C" {

// The encoders that are known by name: [{name, description, protocol, start_bit, control: there is
// CDS, data_bits: 0 where a scenario must give them, flag_bits, crc_bits}].
EMSCRIPTEN_KEEPALIVE const char* web_presets() {
  using mb4::sim::json_text;
  std::string text;
  for (const mb4::sim::Preset& preset : mb4::sim::presets()) {
    const mb4::sim::DeviceTraits traits = preset.device->traits();
    text += fmt::format(
        "{}{{\"name\":{},\"description\":{},\"protocol\":{},\"start_bit\":{},\"control\":{},"
        "\"data_bits\":{},\"flag_bits\":{},\"crc_bits\":{}}}",
        text.empty() ? "" : ",", json_text(preset.name), json_text(preset.description),
        json_text(traits.protocol.key), traits.protocol.start_bit, traits.protocol.control,
        preset.device->data_bits, preset.device->flag_bits, preset.device->crc.width());
  }
  return tell("[" + text + "]");
}

// The frequencies of MA in Hz that the chip makes from this clock, the highest first.
EMSCRIPTEN_KEEPALIVE const char* web_frequencies(double clk_hz) {
  std::string text;
  for (unsigned code = 0; code < 32; ++code) {
    const auto hz = mb4::sim::ma_frequency(static_cast<std::uint64_t>(clk_hz), code);
    if (hz != 0) text += fmt::format("{}{}", text.empty() ? "" : ",", hz);
  }
  return tell("[" + text + "]");
}

// Opens a scenario in place of the one before. "" or the line that names the mistake; then the chip
// before stays.
EMSCRIPTEN_KEEPALIVE const char* web_open(const char* scenario) {
  std::array<char, kErrorBytes> error{};
  mb4sim* const opened = mb4sim_open(scenario, error.data(), error.size());
  if (opened == nullptr) return tell(error.data());
  mb4_config found;
  if (openmb4_config(scenario, false, &found, error.data(), error.size()) != 0) {
    mb4sim_close(opened);
    return tell(error.data());
  }
  mb4sim_close(sim);
  sim = opened;
  config = found;
  edges.clear();
  frames.clear();
  openmb4_begin(&session, sim);
  return tell("");
}

// The driver's mb4_configure() with the configuration of `mb4sim run`. "" or its error.
EMSCRIPTEN_KEEPALIVE const char* web_configure() {
  session.error = 0;
  const mb4_result result = mb4_configure(&session.device, &config);
  return tell(session.error != 0 ? simulator_words(session.error) : words(result));
}

// Reads `count` frames (openmb4_read()): {"error": why the simulator has stopped or "", "rows":
// [{time_ns, text, status: 5 bytes, slaves: [{slave, text, raw, position, crc, error, warning}]}]}.
// Text is "" or the driver's error.
EMSCRIPTEN_KEEPALIVE const char* web_read(int count) {
  std::string text;
  openmb4_row row;
  std::string error;
  for (int i = 0; i < count && error.empty(); ++i) {
    if (openmb4_read(&session, false, &row, 1) != 1) {
      error = simulator_words(session.error);
      break;
    }
    text += fmt::format("{}{{\"time_ns\":{},\"text\":{},\"status\":[{}],\"slaves\":[",
                        text.empty() ? "" : ",", row.time_ns,
                        mb4::sim::json_text(words(row.result)), fmt::join(row.frame.status, ","));
    const char* separator = "";
    for (std::size_t slave = 0; slave < MB4_SLAVES; ++slave) {
      if (!config.slaves[slave].enabled) continue;
      const mb4_reading& reading = row.frame.reading[slave];
      const bool good = row.frame.code[slave] == MB4_OK;
      text += fmt::format(
          "{}{{\"slave\":{},\"text\":{},\"raw\":\"{}\",\"position\":\"{}\",\"crc\":{},\"error\":{},"
          "\"warning\":{}}}",
          separator, slave + 1,
          mb4::sim::json_text(good ? "" : mb4_error_text(row.frame.code[slave])),
          good ? reading.raw : 0, good ? reading.position : 0, good ? reading.crc : 0,
          good && reading.slave_error, good && reading.slave_warning);
      separator = ",";
    }
    text += "]}";
  }
  return tell(fmt::format("{{\"error\":{},\"rows\":[{}]}}", mb4::sim::json_text(error), text));
}

// Reads `count` frames and keeps nothing, to measure the speed. Returns the number of frames read.
EMSCRIPTEN_KEEPALIVE int web_read_only(int count) {
  openmb4_row row;
  int done = 0;
  while (done < count && openmb4_read(&session, false, &row, 1) == 1) ++done;
  return done;
}

// One SPI frame; the chip's bytes come in place of those sent. "" or the error.
EMSCRIPTEN_KEEPALIVE const char* web_spi(std::uint8_t* bytes, int size) {
  const std::vector<std::uint8_t> sent(bytes, bytes + size);
  const int error = mb4sim_spi_transfer(sim, sent.data(), bytes, sent.size());
  return tell(error == 0 ? "" : simulator_words(error));
}

EMSCRIPTEN_KEEPALIVE const char* web_advance_ns(double ns) {
  mb4sim_advance_ns(sim, static_cast<std::uint64_t>(ns));
  const int error = mb4sim_last_error(sim, nullptr, 0);
  return tell(error == 0 ? "" : simulator_words(error));
}

EMSCRIPTEN_KEEPALIVE double web_time_ns() { return static_cast<double>(mb4sim_time_ns(sim)); }
EMSCRIPTEN_KEEPALIVE double web_clk_cycles() { return static_cast<double>(mb4sim_clk_cycles(sim)); }
EMSCRIPTEN_KEEPALIVE int web_pin(const char* name) { return mb4sim_pin_read(sim, name); }
EMSCRIPTEN_KEEPALIVE const char* web_set_pin(const char* name, int level) {
  const int error = mb4sim_pin_write(sim, name, level);
  return tell(error == 0 ? "" : simulator_words(error));
}

// Adds faults or cable events; times count from now. "" or the line that names the mistake.
EMSCRIPTEN_KEEPALIVE const char* web_inject(const char* toml) {
  std::array<char, kErrorBytes> error{};
  mb4sim_inject(sim, toml, error.data(), error.size());
  return tell(error.data());
}

EMSCRIPTEN_KEEPALIVE const char* web_report() {
  const int size = mb4sim_report(sim, nullptr, 0);
  if (size < 0) return tell("{}");
  std::string text(static_cast<std::size_t>(size) + 1, '\0');
  mb4sim_report(sim, text.data(), text.size());
  text.pop_back();
  return tell(std::move(text));
}

// From now on edges and frames are kept, or not.
EMSCRIPTEN_KEEPALIVE void web_record(int on) {
  edges.clear();
  frames.clear();
  mb4sim_on_edge(sim, on != 0 ? keep_edge : nullptr, nullptr);
  mb4sim_on_frame(sim, on != 0 ? keep_frame : nullptr, nullptr);
}

// The edges since the last call, four numbers each: time in ns, channel, MB4SIM_EDGE_..., level.
// Valid until time passes. web_edge_count() comes first.
EMSCRIPTEN_KEEPALIVE int web_edge_count() { return static_cast<int>(edges.size()); }
EMSCRIPTEN_KEEPALIVE const Edge* web_edges() {
  static std::vector<Edge> taken;
  taken.swap(edges);
  edges.clear();
  return taken.data();
}

// The frames since the last call: [{channel, number, start_ns, end_ns, ma_edges, flags}].
EMSCRIPTEN_KEEPALIVE const char* web_frames() {
  std::string text;
  for (const mb4sim_frame& frame : frames) {
    text += fmt::format(
        "{}{{\"channel\":{},\"number\":{},\"start_ns\":{},\"end_ns\":{},\"ma_edges\":{},"
        "\"flags\":{}}}",
        text.empty() ? "" : ",", frame.channel, frame.number, frame.start_ns, frame.end_ns,
        frame.ma_edges, frame.flags);
  }
  frames.clear();
  return tell("[" + text + "]");
}

EMSCRIPTEN_KEEPALIVE const char* web_version() { return mb4sim_version(); }

}  // extern "C"
