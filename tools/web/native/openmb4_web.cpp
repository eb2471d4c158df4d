// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A session of the command line as the page calls it: one scenario with any master, numbers and
// JSON texts instead of classes. A frame is the row that `mb4sim run --csv` writes. A text that a
// function returns is valid until the next call. Functions that return an error return "" for
// success.
#include <emscripten/emscripten.h>
#include <fmt/format.h>

#include <cstdint>
#include <exception>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "report/frame_report.hpp"
#include "scenario_argument.hpp"
#include "session.hpp"
#include "sim/capi/frame_watch.hpp"
#include "sim/capi/report.hpp"
#include "sim/core/json_text.hpp"
#include "sim/core/version.hpp"
#include "sim/lines/presets.hpp"
#include "sim/masters/mb4/ma_frequency.hpp"

namespace {

using mb4::sim::json_text;
using mb4::sim::Simulator;
using mb4::tool::Session;

constexpr std::size_t kMaxEdges = 200'000;  // until web_edges() takes them; later ones are lost

struct Edge {
  double time_ns;
  double channel;
  double place;
  double level;
};

// An open scenario.
struct Run {
  explicit Run(const mb4::sim::Scenario& scenario)
      : session(mb4::tool::support_of(scenario).open(scenario, {})),
        rows(session->simulator().scenario(), session->columns()) {}

  mb4::sim::FrameWatch& watching() {
    if (watch == nullptr) watch = std::make_unique<mb4::sim::FrameWatch>(session->simulator());
    return *watch;
  }

  std::unique_ptr<Session> session;
  mb4::tool::FrameReport rows;
  std::unique_ptr<mb4::sim::FrameWatch> watch;  // goes before the session
  std::uint64_t frames = 0;
  std::vector<Edge> edges;
  std::vector<mb4::sim::SeenFrame> seen;
};

std::unique_ptr<Run> run;
std::string answer;

const char* tell(std::string text) {
  answer = std::move(text);
  return answer.c_str();
}

Simulator& simulator() { return run->session->simulator(); }

// What `call` returns, or the words of its exception: of a mistake in a text, or why the simulator
// has stopped.
template <typename Call>
const char* guarded(Call call) {
  try {
    return tell(call());
  } catch (const std::exception& failure) {
    return tell(failure.what());
  }
}

// The bus of words of the scenario's host.
mb4::sim::WordHost& words() {
  mb4::sim::WordHost* const host = simulator().word_bus();
  if (host == nullptr) throw std::runtime_error("the scenario's host has another interface");
  return *host;
}

std::string word_answer(std::optional<std::uint8_t> answered) {
  if (!answered) return "the bus has not answered";
  return *answered == 0 ? "" : "the bus has answered with an error";
}

// Throws if the master, or its host, cannot do what the scenario asks for.
void check(const mb4::sim::Scenario& scenario) { mb4::tool::support_of(scenario).check(scenario); }

}  // namespace

extern "C" {

// The encoders that are known by name: [{name, description, protocol, start_bit, control: there is
// CDS, data_bits: 0 where a scenario must give them, flag_bits, crc_bits}].
EMSCRIPTEN_KEEPALIVE const char* web_presets() {
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

// Why a master cannot read an encoder that is known by name; "" if it can.
EMSCRIPTEN_KEEPALIVE const char* web_refuses(const char* master, const char* encoder) {
  return guarded([&]() -> std::string {
    check(mb4::sim::parse_scenario(
        fmt::format("[master]\ntype = \"{}\"\n{}", master,
                    mb4::tool::preset_scenario(*mb4::sim::preset_by_name(encoder))),
        encoder));
    return "";
  });
}

// The frequencies of MA in Hz that the iC-MB4 makes from this clock, the highest first.
EMSCRIPTEN_KEEPALIVE const char* web_frequencies(double clk_hz) {
  std::string text;
  for (unsigned code = 0; code < 32; ++code) {
    const auto hz = mb4::sim::ma_frequency(static_cast<std::uint64_t>(clk_hz), code);
    if (hz != 0) text += fmt::format("{}{}", text.empty() ? "" : ",", hz);
  }
  return tell("[" + text + "]");
}

// Opens a scenario in place of the one before. An error is the line that names the mistake; then
// the one before stays.
EMSCRIPTEN_KEEPALIVE const char* web_open(const char* scenario) {
  return guarded([&]() -> std::string {
    const mb4::sim::Scenario found = mb4::sim::parse_scenario(scenario, "scenario");
    check(found);
    run = std::make_unique<Run>(found);
    return "";
  });
}

// Configures the master as `mb4sim run` does. Returns an error.
EMSCRIPTEN_KEEPALIVE const char* web_configure() {
  return guarded([] { return run->session->configure(); });
}

// What a row has of each word, between the number of the slave and the state: [{key, title}].
EMSCRIPTEN_KEEPALIVE const char* web_columns() {
  std::string text;
  for (const mb4::tool::WordColumn& column : run->session->columns()) {
    text += fmt::format("{}{{\"key\":{},\"title\":{}}}", text.empty() ? "" : ",",
                        json_text(column.key), json_text(column.title));
  }
  return tell("[" + text + "]");
}

// Reads `count` frames: {"error": why the simulator has stopped or "", "rows": [[a row for each
// slave]]}.
EMSCRIPTEN_KEEPALIVE const char* web_read(int count) {
  std::string text;
  std::string error;
  try {
    for (int i = 0; i < count; ++i) {
      const mb4::tool::SessionFrame frame = run->session->read(++run->frames);
      std::string rows;
      for (std::size_t slave = 0; slave < frame.results.size(); ++slave) {
        run->rows.add(frame, run->session->slaves()[slave].number, slave);
        std::string row = run->rows.csv_row();
        row.pop_back();
        rows += fmt::format("{}{}", rows.empty() ? "" : ",", json_text(row));
      }
      text += fmt::format("{}[{}]", text.empty() ? "" : ",", rows);
    }
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  return tell(fmt::format("{{\"error\":{},\"rows\":[{}]}}", json_text(error), text));
}

// Reads `count` frames and keeps nothing, to measure the speed. Returns the number of frames read.
EMSCRIPTEN_KEEPALIVE int web_read_only(int count) {
  for (int i = 0; i < count; ++i) run->session->read(++run->frames);
  return count;
}

// One SPI frame; the chip's bytes come in place of those sent. Returns an error.
EMSCRIPTEN_KEEPALIVE const char* web_spi(std::uint8_t* bytes, int size) {
  return guarded([&]() -> std::string {
    auto* const host = simulator().find_host<mb4::sim::SpiHost>("spi");
    if (host == nullptr || simulator().scenario().host.parallel()) {
      return "the scenario's host has another interface";
    }
    const std::vector<std::uint8_t> sent(bytes, bytes + size);
    host->transfer(sent, std::span(bytes, sent.size()));
    return "";
  });
}

// Words of a master on a bus of words, at byte addresses. Both return an error.
EMSCRIPTEN_KEEPALIVE const char* web_word_read(std::uint32_t address, std::uint32_t* value) {
  return guarded([&] { return word_answer(words().read(address, *value)); });
}
EMSCRIPTEN_KEEPALIVE const char* web_word_write(std::uint32_t address, std::uint32_t value) {
  return guarded([&] { return word_answer(words().write(address, value, 0xF)); });
}

EMSCRIPTEN_KEEPALIVE const char* web_advance_ns(double ns) {
  return guarded([&]() -> std::string {
    simulator().advance(static_cast<mb4::sim::Time>(ns) * mb4::sim::kPsPerNs);
    return "";
  });
}

EMSCRIPTEN_KEEPALIVE double web_time_ps() { return static_cast<double>(simulator().now()); }
EMSCRIPTEN_KEEPALIVE double web_clk_cycles() {
  return static_cast<double>(simulator().clk_cycles());
}
// The level of a pin; -1: there is none.
EMSCRIPTEN_KEEPALIVE int web_pin(const char* name) {
  const auto pin = simulator().pin_by_name(name);
  return pin ? static_cast<int>(simulator().pin(*pin)) : -1;
}
EMSCRIPTEN_KEEPALIVE const char* web_set_pin(const char* name, int level) {
  return guarded([&]() -> std::string {
    const auto pin = simulator().pin_by_name(name);
    if (!pin || !simulator().can_set(*pin)) return fmt::format("no pin '{}' to set", name);
    simulator().set_pin(*pin, level != 0);
    return "";
  });
}

// Adds faults or cable events; times count from now. An error names the mistake.
EMSCRIPTEN_KEEPALIVE const char* web_inject(const char* toml) {
  return guarded([&]() -> std::string {
    run->watching();
    simulator().inject(toml);
    return "";
  });
}

// The text of mb4sim_report().
EMSCRIPTEN_KEEPALIVE const char* web_report() {
  return guarded([] { return report_json(simulator(), run->watching().stories()); });
}

// From now on edges and frames are kept, or not.
EMSCRIPTEN_KEEPALIVE void web_record(int on) {
  Run& now = *run;
  now.edges.clear();
  now.seen.clear();
  if (on == 0) {
    now.watching().set_callback({});
    now.watching().set_edges({});
    return;
  }
  now.watching().set_callback(
      [&now](const mb4::sim::SeenFrame& frame) { now.seen.push_back(frame); });
  now.watching().set_edges(
      [&now](unsigned channel, unsigned place, mb4::sim::Time time, bool level) {
        if (now.edges.size() >= kMaxEdges) return;
        now.edges.push_back({static_cast<double>(time) / 1000, static_cast<double>(channel),
                             static_cast<double>(place), level ? 1.0 : 0.0});
      });
}

// The edges since the last call, four numbers each: time in ns, channel, MB4SIM_EDGE_..., level.
// Valid until time passes. web_edge_count() comes first.
EMSCRIPTEN_KEEPALIVE int web_edge_count() { return static_cast<int>(run->edges.size()); }
EMSCRIPTEN_KEEPALIVE const Edge* web_edges() {
  static std::vector<Edge> taken;
  taken.swap(run->edges);
  run->edges.clear();
  return taken.data();
}

// The frames since the last call, which the line has told at their ends: [{channel, start_ns,
// end_ns}].
EMSCRIPTEN_KEEPALIVE const char* web_frames() {
  std::string text;
  for (const mb4::sim::SeenFrame& seen : run->seen) {
    text += fmt::format("{}{{\"channel\":{},\"start_ns\":{},\"end_ns\":{}}}",
                        text.empty() ? "" : ",", seen.channel,
                        seen.frame.start / mb4::sim::kPsPerNs, seen.frame.end / mb4::sim::kPsPerNs);
  }
  run->seen.clear();
  return tell("[" + text + "]");
}

EMSCRIPTEN_KEEPALIVE const char* web_version() { return mb4::sim::version(); }

}  // extern "C"
