// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The C interface. It translates names, numbers and exceptions. What it adds is in FrameWatch and
// report.hpp.
#include <algorithm>
#include <climits>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "mb4sim.h"
#include "mb4sim/simulator.hpp"
#include "sim/capi/frame_watch.hpp"
#include "sim/capi/report.hpp"
#include "sim/core/trace_error.hpp"
#include "sim/core/version.hpp"

using mb4::sim::FrameWatch;
using mb4::sim::ModelStopped;
using mb4::sim::ParallelHost;
using mb4::sim::Scenario;
using mb4::sim::Simulator;
using mb4::sim::SpiHost;
using mb4::sim::WordHost;

// What a handle points to.
struct mb4sim {
  // Faults of the scenario are followed from the beginning; without any, frames cost less.
  explicit mb4sim(const Scenario& scenario) : simulator(scenario) {
    if (!scenario.faults.empty()) watch();
  }
  FrameWatch& watch() {
    if (frames == nullptr) frames = std::make_unique<FrameWatch>(simulator);
    return *frames;
  }
  Simulator simulator;
  std::unique_ptr<FrameWatch> frames;
  bool failed = false;      // by an exception that leaves the simulator in an unknown state
  bool inside = false;      // a call that lets time pass is running
  bool closing = false;     // a callback has closed the handle: it goes when that call returns
  int last_error = 0;       // of the last call that cannot return one
  std::string reason;       // why the simulator has stopped
  std::string trace_error;  // why the latest call of a waveform has failed
};

namespace {

void put_error(const char* message, char* error, size_t error_size) {
  if (error == nullptr || error_size == 0) return;
  const size_t length = std::min(std::strlen(message), error_size - 1);
  std::memcpy(error, message, length);
  error[length] = '\0';
}

template <typename Load>
mb4sim* open(Load load, char* error, size_t error_size) {
  try {
    auto sim = std::make_unique<mb4sim>(load());
    put_error("", error, error_size);
    return sim.release();
  } catch (const std::exception& failure) {
    put_error(failure.what(), error, error_size);
    return nullptr;
  } catch (...) {
    put_error("scenario: unknown failure", error, error_size);
    return nullptr;
  }
}

template <typename Call>
int run(mb4sim& sim, Call call) {
  try {
    return call(sim.simulator);
  } catch (const ModelStopped& stop) {
    if (sim.reason.empty()) sim.reason = stop.what();
    return MB4SIM_ERROR_STOPPED;
  } catch (...) {
    sim.failed = true;
    return MB4SIM_ERROR_FAILED;
  }
}

constexpr auto kNoNote = [](mb4sim& /*sim*/, int /*result*/) {};
// For mb4sim_last_error().
constexpr auto kKeep = [](mb4sim& sim, int result) { sim.last_error = std::min(result, 0); };

// Runs `call` on the simulator. Every exception becomes a negative error. A callback must not let
// time pass, because time is passing already. `note` receives the simulator and the result, while
// the simulator still exists: a callback may have closed it.
template <typename Call, typename Note = decltype(kNoNote)>
int guarded(mb4sim* sim, Call call, Note note = kNoNote) {
  if (sim == nullptr) return MB4SIM_ERROR_UNKNOWN;
  const auto noted = [&](int result) {
    note(*sim, result);
    return result;
  };
  if (sim->failed) return noted(MB4SIM_ERROR_FAILED);
  if (sim->inside) return noted(MB4SIM_ERROR_CALLBACK);
  sim->inside = true;
  const int result = noted(run(*sim, call));
  sim->inside = false;
  if (sim->closing) delete sim;
  return result;
}

// The same with the master's host on SPI, or on the parallel bus, as the scenario says.
template <typename Host, typename Call, typename Note = decltype(kNoNote)>
int hosted(mb4sim* sim, Call call, Note note = kNoNote) {
  constexpr bool kParallel = std::is_same_v<Host, ParallelHost>;
  const auto with_host = [&](Simulator& simulator) {
    const bool wired = simulator.scenario().host.parallel() == kParallel;
    Host* const host = simulator.find_host<Host>(kParallel ? "bus" : "spi");
    return wired && host != nullptr ? call(*host) : int{MB4SIM_ERROR_HOST};
  };
  return guarded(sim, with_host, note);
}

// The same with a host on a bus of 32-bit words. `call` returns the answer of the bus.
template <typename Call>
int word_access(mb4sim* sim, uint32_t address, Call call) {
  return guarded(sim, [&](Simulator& simulator) {
    WordHost* const host = simulator.word_bus();
    if (host == nullptr) return int{MB4SIM_ERROR_HOST};
    if (address > host->last_address() || address % 4 != 0) return int{MB4SIM_ERROR_VALUE};
    const std::optional<std::uint8_t> answer = call(*host);
    if (!answer) return int{MB4SIM_ERROR_SILENT};
    return *answer == 0 ? 0 : 1;
  });
}

// The words that `n` bytes from `address` on touch, upwards, until one does not answer well:
// call(host, address of the word, index of its first byte, position of this byte in the word, count
// of bytes) returns the answer of the bus.
template <typename Call>
int memory_access(mb4sim* sim, uint32_t address, size_t n, Call call) {
  constexpr uint32_t kWord = 4;
  return guarded(sim, [&](Simulator& simulator) {
    WordHost* const host = simulator.word_bus();
    if (host == nullptr) return int{MB4SIM_ERROR_HOST};
    const uint64_t end = uint64_t{host->last_address()} / kWord * kWord + kWord;
    if (address > end || n > end - address) return int{MB4SIM_ERROR_VALUE};
    int result = 0;
    for (size_t i = 0; i < n && result == 0;) {
      const uint32_t byte = address + static_cast<uint32_t>(i);
      const uint32_t offset = byte % kWord;
      const size_t count = std::min(n - i, size_t{kWord - offset});
      const std::optional<std::uint8_t> answer = call(*host, byte - offset, i, offset, count);
      result = !answer ? int{MB4SIM_ERROR_SILENT} : *answer == 0 ? 0 : 1;
      i += count;
    }
    return result;
  });
}

// A pin by its name; nothing for null pointers and other names.
std::optional<mb4::sim::Pin> find_pin(const mb4sim* sim, const char* name) {
  if (sim == nullptr || name == nullptr) return std::nullopt;
  return sim->simulator.pin_by_name(name);
}

const char* error_text(const mb4sim& sim, int error) {
  switch (error) {
    case 0:
      return "";
    case MB4SIM_ERROR_STOPPED:
      return sim.reason.c_str();
    case MB4SIM_ERROR_HOST:
      return "the scenario's host has another interface";
    case MB4SIM_ERROR_CALLBACK:
      return "not allowed in a callback";
    case MB4SIM_ERROR_TRACE:
      return sim.trace_error.c_str();
    case MB4SIM_ERROR_SILENT:
      return "the bus has not answered";
    default:
      return "out of memory or another failure; only closing is left";
  }
}

// In ps, not beyond the end of time.
mb4::sim::Time duration(uint64_t ns) {
  return std::min(ns, mb4::sim::kEndOfTime / mb4::sim::kPsPerNs + 1) * mb4::sim::kPsPerNs;
}

}  // namespace

mb4sim* mb4sim_open(const char* scenario_text, char* error, size_t error_size) {
  if (scenario_text == nullptr) {
    put_error("scenario: no text", error, error_size);
    return nullptr;
  }
  return open([&] { return mb4::sim::parse_scenario(scenario_text, "scenario"); }, error,
              error_size);
}

mb4sim* mb4sim_open_file(const char* path, char* error, size_t error_size) {
  if (path == nullptr) {
    put_error("scenario: no path", error, error_size);
    return nullptr;
  }
  return open([&] { return mb4::sim::load_scenario(path); }, error, error_size);
}

void mb4sim_close(mb4sim* sim) {
  if (sim != nullptr && sim->inside) {
    sim->closing = true;
  } else {
    delete sim;
  }
}

int mb4sim_spi_transfer(mb4sim* sim, const uint8_t* tx, uint8_t* rx, size_t n) {
  if (tx == nullptr && n != 0) return MB4SIM_ERROR_UNKNOWN;
  return hosted<SpiHost>(sim, [&](SpiHost& spi) {
    spi.transfer(std::span(tx, n), std::span(rx, rx == nullptr ? 0 : n));
    return 0;
  });
}

void mb4sim_spi_select(mb4sim* sim, int active) {
  const auto call = [&](SpiHost& spi) {
    spi.select(active != 0);
    return 0;
  };
  hosted<SpiHost>(sim, call, kKeep);
}

uint8_t mb4sim_spi_byte(mb4sim* sim, uint8_t mosi) {
  const auto call = [&](SpiHost& spi) { return int{spi.byte(mosi)}; };
  const int value = hosted<SpiHost>(sim, call, kKeep);
  return value < 0 ? uint8_t{0} : static_cast<uint8_t>(value);
}

void mb4sim_advance_ns(mb4sim* sim, uint64_t ns) {
  const auto call = [&](Simulator& simulator) {
    simulator.advance(duration(ns));
    return 0;
  };
  guarded(sim, call, kKeep);
}

uint64_t mb4sim_time_ns(const mb4sim* sim) {
  return sim == nullptr ? 0 : sim->simulator.now() / mb4::sim::kPsPerNs;
}

uint64_t mb4sim_clk_cycles(const mb4sim* sim) {
  return sim == nullptr ? 0 : sim->simulator.clk_cycles();
}

int mb4sim_pin_read(mb4sim* sim, const char* pin) {
  const auto which = find_pin(sim, pin);
  if (!which) return MB4SIM_ERROR_UNKNOWN;
  return sim->simulator.pin(*which) ? 1 : 0;
}

int mb4sim_pin_write(mb4sim* sim, const char* pin, int level) {
  const auto which = find_pin(sim, pin);
  if (!which) return MB4SIM_ERROR_UNKNOWN;
  if (level != 0 && level != 1) return MB4SIM_ERROR_VALUE;
  return guarded(sim, [&](Simulator& simulator) {
    if (!simulator.can_set(*which)) return int{MB4SIM_ERROR_DRIVEN};
    simulator.set_pin(*which, level == 1);
    return 0;
  });
}

int mb4sim_slave_set_data(mb4sim* sim, unsigned slave, uint64_t raw) {
  return guarded(sim, [&](Simulator& simulator) {
    auto* device = simulator.slave(slave);
    if (device == nullptr) return int{MB4SIM_ERROR_UNKNOWN};
    return device->set_data(raw) ? 0 : int{MB4SIM_ERROR_VALUE};
  });
}

int mb4sim_slave_reg_read(mb4sim* sim, unsigned slave, uint8_t address, uint8_t* value) {
  if (sim == nullptr || value == nullptr) return MB4SIM_ERROR_UNKNOWN;
  const auto* device = sim->simulator.slave(slave);
  if (device == nullptr) return MB4SIM_ERROR_UNKNOWN;
  *value = device->reg_read(address);
  return 0;
}

int mb4sim_slave_reg_write(mb4sim* sim, unsigned slave, uint8_t address, uint8_t value) {
  return guarded(sim, [&](Simulator& simulator) {
    auto* device = simulator.slave(slave);
    if (device == nullptr) return int{MB4SIM_ERROR_UNKNOWN};
    device->reg_write(address, value);
    return 0;
  });
}

uint64_t mb4sim_slave_frames(const mb4sim* sim, unsigned slave) {
  const auto* device = sim == nullptr ? nullptr : sim->simulator.slave(slave);
  return device == nullptr ? 0 : device->frames();
}

int mb4sim_inject(mb4sim* sim, const char* toml, char* error, size_t error_size) {
  put_error("", error, error_size);
  if (toml == nullptr) {
    put_error("inject: no text", error, error_size);
    return MB4SIM_ERROR_UNKNOWN;
  }
  const auto call = [&](Simulator& simulator) {
    try {
      sim->watch();
      simulator.inject(toml);
    } catch (const mb4::sim::ScenarioError& failure) {
      put_error(failure.what(), error, error_size);
      return int{MB4SIM_ERROR_VALUE};
    }
    return 0;
  };
  const auto tell = [&](const mb4sim& handle, int result) {
    if (result != MB4SIM_ERROR_VALUE) put_error(error_text(handle, result), error, error_size);
  };
  if (sim == nullptr) put_error("no simulator", error, error_size);
  return guarded(sim, call, tell);
}

int mb4sim_slave_sent(const mb4sim* sim, unsigned slave, uint64_t frame, uint64_t* raw) {
  if (sim == nullptr || raw == nullptr) return MB4SIM_ERROR_UNKNOWN;
  const auto* device = sim->simulator.slave(slave);
  if (device == nullptr) return MB4SIM_ERROR_UNKNOWN;
  const auto word = device->sent_in(frame);
  if (!word) return MB4SIM_ERROR_VALUE;
  *raw = *word;
  return 0;
}

int mb4sim_run_until(mb4sim* sim, const char* pin, int level, uint64_t limit_ns) {
  const auto which = find_pin(sim, pin);
  if (!which) return MB4SIM_ERROR_UNKNOWN;
  if (which == sim->simulator.pin_by_name("CLK")) return MB4SIM_ERROR_DRIVEN;
  if (level != 0 && level != 1) return MB4SIM_ERROR_VALUE;
  return guarded(sim, [&](Simulator& simulator) {
    const auto done = [&] { return simulator.pin(*which) == (level == 1); };
    const auto limit = std::min(mb4::sim::kEndOfTime, simulator.now() + duration(limit_ns));
    return simulator.run_while_waiting(done, std::max(limit, simulator.now())) ? 1 : 0;
  });
}

int mb4sim_watch_pins(mb4sim* sim, const char* const* pins, size_t n, uint64_t ns,
                      mb4sim_pin_callback callback, void* context) {
  if (sim == nullptr || callback == nullptr || (pins == nullptr && n != 0))
    return MB4SIM_ERROR_UNKNOWN;
  struct Watched {
    mb4::sim::Pin pin;
    bool level;
  };
  return guarded(sim, [&](Simulator& simulator) {
    std::vector<Watched> watched;
    for (const char* name : std::span(pins, n)) {
      const auto pin = find_pin(sim, name);
      if (!pin) return int{MB4SIM_ERROR_UNKNOWN};
      if (pin == simulator.pin_by_name("CLK")) return int{MB4SIM_ERROR_DRIVEN};
      watched.push_back({*pin, simulator.pin(*pin)});
    }
    const auto tell = [&](const Watched& one) {
      callback(context, static_cast<size_t>(&one - watched.data()), simulator.now(), one.level);
    };
    const auto look = [&] {
      for (Watched& one : watched) {
        if (simulator.pin(one.pin) == one.level) continue;
        one.level = !one.level;
        tell(one);
      }
      return false;
    };
    for (const Watched& one : watched) tell(one);
    const auto limit = std::min(mb4::sim::kEndOfTime, simulator.now() + duration(ns));
    simulator.run_while_waiting(look, std::max(limit, simulator.now()));
    return 0;
  });
}

int mb4sim_bus_write(mb4sim* sim, uint8_t address, uint8_t data) {
  return hosted<ParallelHost>(sim, [&](ParallelHost& bus) {
    bus.write(address, data);
    return 0;
  });
}

int mb4sim_bus_read(mb4sim* sim, uint8_t address, uint8_t* data) {
  if (data == nullptr) return MB4SIM_ERROR_UNKNOWN;
  return hosted<ParallelHost>(sim, [&](ParallelHost& bus) {
    *data = bus.read(address);
    return 0;
  });
}

int mb4sim_axi_write(mb4sim* sim, uint32_t address, uint32_t data, uint8_t strobe) {
  constexpr uint8_t kAllBytes = 0xF;
  if (sim != nullptr && strobe > kAllBytes) return MB4SIM_ERROR_VALUE;
  return word_access(sim, address,
                     [&](WordHost& host) { return host.write(address, data, strobe); });
}

int mb4sim_axi_read(mb4sim* sim, uint32_t address, uint32_t* data) {
  if (data == nullptr) return MB4SIM_ERROR_UNKNOWN;
  return word_access(sim, address, [&](WordHost& host) {
    std::uint32_t value = 0;
    const std::optional<std::uint8_t> answer = host.read(address, value);
    if (answer) *data = value;
    return answer;
  });
}

int mb4sim_mem_write(mb4sim* sim, uint32_t address, const uint8_t* bytes, size_t n) {
  if (bytes == nullptr && n != 0) return MB4SIM_ERROR_UNKNOWN;
  return memory_access(
      sim, address, n,
      [bytes](WordHost& host, uint32_t word, size_t first, uint32_t offset, size_t count) {
        std::uint32_t data = 0;
        std::uint32_t strobe = 0;
        for (size_t i = 0; i < count; ++i) {
          data |= std::uint32_t{bytes[first + i]} << (8 * (offset + i));
          strobe |= 1U << (offset + i);
        }
        return host.write(word, data, static_cast<std::uint8_t>(strobe));
      });
}

int mb4sim_mem_read(mb4sim* sim, uint32_t address, uint8_t* bytes, size_t n) {
  if (bytes == nullptr && n != 0) return MB4SIM_ERROR_UNKNOWN;
  return memory_access(
      sim, address, n,
      [bytes](WordHost& host, uint32_t word, size_t first, uint32_t offset, size_t count) {
        std::uint32_t data = 0;
        const std::optional<std::uint8_t> answer = host.read(word, data);
        for (size_t i = 0; answer && i < count; ++i) {
          bytes[first + i] = static_cast<std::uint8_t>(data >> (8 * (offset + i)));
        }
        return answer;
      });
}

int mb4sim_stream_read(mb4sim* sim, uint32_t* words, size_t n, uint32_t* user) {
  if (words == nullptr && n != 0) return MB4SIM_ERROR_UNKNOWN;
  return guarded(sim, [&](Simulator& simulator) {
    WordHost* const host = simulator.word_bus();
    mb4::sim::StreamSink* const stream = host == nullptr ? nullptr : host->stream();
    if (stream == nullptr) return int{MB4SIM_ERROR_HOST};
    const auto beat = stream->next_beat();
    if (!beat) return 0;
    std::copy_n(beat->words.begin(), std::min(n, beat->words.size()), words);
    if (user != nullptr) *user = beat->user;
    return static_cast<int>(beat->words.size());
  });
}

int mb4sim_on_frame(mb4sim* sim, mb4sim_frame_callback callback, void* context) {
  return guarded(sim, [&](Simulator&) {
    if (callback == nullptr) {
      if (sim->frames != nullptr) sim->frames->set_callback({});
      return 0;
    }
    sim->watch().set_callback([callback, context](const mb4::sim::SeenFrame& seen) {
      mb4sim_frame frame{};
      frame.size = sizeof frame;
      frame.channel = seen.channel;
      frame.number = seen.frame.number;
      frame.start_ns = seen.frame.start / mb4::sim::kPsPerNs;
      frame.end_ns = seen.frame.end / mb4::sim::kPsPerNs;
      frame.ma_edges = static_cast<unsigned>(seen.frame.edges);
      if (seen.frame.rests_low) frame.flags |= MB4SIM_FRAME_MA_LOW;
      if (seen.fault) frame.flags |= MB4SIM_FRAME_FAULT;
      callback(context, &frame);
    });
    return 0;
  });
}

int mb4sim_on_edge(mb4sim* sim, mb4sim_edge_callback callback, void* context) {
  return guarded(sim, [&](Simulator&) {
    if (callback == nullptr) {
      if (sim->frames != nullptr) sim->frames->set_edges({});
      return 0;
    }
    sim->watch().set_edges(
        [callback, context](unsigned channel, unsigned place, mb4::sim::Time now, bool level) {
          callback(context, channel, place, now, level ? 1 : 0);
        });
    return 0;
  });
}

int mb4sim_trace_start(mb4sim* sim, const char* path) {
  if (path == nullptr) return MB4SIM_ERROR_UNKNOWN;
  const auto call = [&](Simulator& simulator) {
    try {
      simulator.start_trace(path);
    } catch (const mb4::sim::TraceError& failure) {
      sim->trace_error = failure.what();
      return int{MB4SIM_ERROR_TRACE};
    }
    return 0;
  };
  return guarded(sim, call, kKeep);
}

int mb4sim_trace_stop(mb4sim* sim) {
  const auto call = [&](Simulator& simulator) {
    if (simulator.stop_trace()) return 0;
    sim->trace_error = "no waveform is being written";
    return int{MB4SIM_ERROR_TRACE};
  };
  return guarded(sim, call, kKeep);
}

int mb4sim_report(const mb4sim* sim, char* json, size_t size) {
  if (sim == nullptr) return MB4SIM_ERROR_UNKNOWN;
  try {
    // The call only reads; the simulator's own calls for it are not const.
    auto* const self = const_cast<mb4sim*>(sim);
    const std::string text =
        report_json(self->simulator, self->frames == nullptr ? std::vector<mb4::sim::FaultStory>{}
                                                             : self->frames->stories());
    put_error(text.c_str(), json, size);
    return static_cast<int>(std::min<size_t>(text.size(), INT_MAX));
  } catch (...) {
    return MB4SIM_ERROR_FAILED;
  }
}

int mb4sim_last_error(const mb4sim* sim, char* text, size_t size) {
  const int error = sim == nullptr ? int{MB4SIM_ERROR_UNKNOWN} : sim->last_error;
  put_error(sim == nullptr ? "no simulator" : error_text(*sim, error), text, size);
  return error;
}

const char* mb4sim_version(void) { return mb4::sim::version(); }
