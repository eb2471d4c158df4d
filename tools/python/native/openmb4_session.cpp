// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

#include "openmb4_session.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iterator>
#include <string_view>
#include <vector>

#include "connected_slaves.hpp"
#include "drivers/c/mb4_c_convert.hpp"
#include "masters/mb4/chip_setup.hpp"
#include "sim/masters/master.hpp"
#include "sim/model/wave_view.hpp"
#include "sim/scenario/scenario.hpp"

namespace {

bool transfer(void* context, const uint8_t* tx, uint8_t* rx, size_t size) {
  auto& session = *static_cast<openmb4_session*>(context);
  const int error = mb4sim_spi_transfer(session.sim, tx, rx, size);
  if (error != 0) session.error = error;
  return error == 0;
}

// Each look at the clock takes time, as on a processor: a driver that waits then comes to an end.
uint32_t now_us(void* context) {
  mb4sim* const sim = static_cast<openmb4_session*>(context)->sim;
  constexpr uint64_t kLookNs = 100;
  mb4sim_advance_ns(sim, kLookNs);
  return static_cast<uint32_t>(mb4sim_time_ns(sim) / 1000);
}

template <typename T>
uint8_t number(T value) {
  return static_cast<uint8_t>(value);
}

mb4::sim::Scenario read(const char* scenario, bool is_path) {
  return is_path ? mb4::sim::load_scenario(scenario)
                 : mb4::sim::parse_scenario(scenario, "scenario");
}

// Runs `call`. The words of its exception go to `error`; then the result is `failed`.
template <typename Call>
int told(int failed, char* error, size_t error_size, Call call) {
  try {
    call();
    return 0;
  } catch (const std::exception& failure) {
    std::snprintf(error, error_size, "%s", failure.what());
    return failed;
  }
}

template <size_t Size>
void copy(std::string_view text, char (&to)[Size]) {
  to[text.copy(to, Size - 1)] = '\0';
}

// Where the edges of openmb4_record() come together.
struct Recording {
  std::vector<openmb4_edge> edges;
  std::vector<uint32_t> pins;  // index of each watched pin among the wires
  const int* place;
  const unsigned* channel;
  size_t n;

  static void pin(void* context, size_t pin, uint64_t time_ps, int level) {
    auto& self = *static_cast<Recording*>(context);
    self.edges.push_back({time_ps, self.pins[pin], static_cast<uint32_t>(level)});
  }
  static void line(void* context, unsigned channel, unsigned place, uint64_t time_ps, int level) {
    auto& self = *static_cast<Recording*>(context);
    for (size_t i = 0; i < self.n; ++i) {
      if (self.place[i] == static_cast<int>(place) && self.channel[i] == channel)
        self.edges.push_back({time_ps, static_cast<uint32_t>(i), static_cast<uint32_t>(level)});
    }
  }
};

}  // namespace

void openmb4_begin(openmb4_session* session, mb4sim* sim) {
  session->sim = sim;
  session->error = 0;
  mb4_open(&session->device, transfer, session, now_us, session);
}

size_t openmb4_read(openmb4_session* session, bool automatic, openmb4_row* rows, size_t count) {
  session->error = 0;
  for (size_t i = 0; i < count; ++i) {
    openmb4_row& row = rows[i];
    row.result = automatic ? mb4_automatic_next(&session->device, &row.frame)
                           : mb4_read_all(&session->device, &row.frame);
    row.time_ns = mb4sim_time_ns(session->sim);
    if (session->error != 0) return i;
    if (row.result.code != MB4_OK) {
      std::fill(std::begin(row.frame.code), std::end(row.frame.code), row.result.code);
    }
  }
  return count;
}

int openmb4_config(const char* scenario, bool is_path, mb4_config* config, char* error,
                   size_t error_size) {
  return told(MB4SIM_ERROR_VALUE, error, error_size,
              [&] { *config = mb4_c::to_c(mb4::tool::make_config(read(scenario, is_path))); });
}

int openmb4_record(mb4sim* sim, const char* const* name, const int* place, const unsigned* channel,
                   size_t n, uint64_t ns, openmb4_edges* edges) {
  auto* recording = new Recording{{}, {}, place, channel, n};
  *edges = {nullptr, 0, recording};
  std::vector<const char*> pins;
  for (size_t i = 0; i < n; ++i) {
    if (place[i] >= 0) continue;
    pins.push_back(name[i]);
    recording->pins.push_back(static_cast<uint32_t>(i));
  }
  int error = pins.size() == n ? 0 : mb4sim_on_edge(sim, &Recording::line, recording);
  if (error != 0) return error;
  error = mb4sim_watch_pins(sim, pins.data(), pins.size(), ns, &Recording::pin, recording);
  if (pins.size() != n) {
    const int ended = mb4sim_on_edge(sim, nullptr, nullptr);
    if (error == 0) error = ended;
  }
  edges->edges = recording->edges.data();
  edges->count = recording->edges.size();
  return error;
}

void openmb4_free(openmb4_edges* edges) { delete static_cast<Recording*>(edges->memory); }

int openmb4_describe(const char* scenario, bool is_path, openmb4_scenario* found, char* error,
                     size_t error_size) {
  return told(MB4SIM_ERROR_VALUE, error, error_size, [&] {
    const mb4::sim::Scenario all = read(scenario, is_path);
    *found = {};
    copy(all.master->type, found->master);
    found->f_clk_hz = static_cast<uint32_t>(all.chip.system_hz());
    for (const mb4::tool::ConnectedSlave& one : mb4::tool::connected_slaves(all)) {
      if (found->slaves == std::size(found->slave)) break;
      auto& slave = found->slave[found->slaves++];
      slave.number = number(one.number);
      slave.channel = number(one.channel);
      slave.data_bits = number(one.config->data_bits());
      copy(one.config->traits().protocol.key, slave.protocol);
    }
  });
}

int openmb4_write_view(const char* scenario, bool is_path, const char* trace, const char* view,
                       char* error, size_t error_size) {
  return told(MB4SIM_ERROR_TRACE, error, error_size, [&] {
    const mb4::sim::Scenario all = read(scenario, is_path);
    if (all.master->wave_groups == nullptr) return;
    mb4::sim::write_wave_view(trace, view, all.master->wave_groups(all.host));
  });
}
