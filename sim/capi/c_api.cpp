// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The C interface. It translates names, numbers and exceptions and does nothing else.
#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <span>
#include <string>

#include "mb4sim.h"
#include "mb4sim/simulator.hpp"
#include "sim/core/version.hpp"

using mb4::sim::ModelStopped;
using mb4::sim::Scenario;
using mb4::sim::Simulator;

// What a handle points to.
struct mb4sim {
  explicit mb4sim(const Scenario& scenario) : simulator(scenario) {}
  Simulator simulator;
  bool failed = false;  // by an exception that leaves the simulator in an unknown state
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

// Runs `call` on the simulator. Every exception becomes a negative error.
template <typename Call>
int guarded(mb4sim* sim, Call call) {
  if (sim == nullptr) return MB4SIM_ERROR_UNKNOWN;
  if (sim->failed) return MB4SIM_ERROR_FAILED;
  try {
    return call(sim->simulator);
  } catch (const ModelStopped&) {
    return MB4SIM_ERROR_STOPPED;
  } catch (...) {
    sim->failed = true;
    return MB4SIM_ERROR_FAILED;
  }
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

void mb4sim_close(mb4sim* sim) { delete sim; }

int mb4sim_spi_transfer(mb4sim* sim, const uint8_t* tx, uint8_t* rx, size_t n) {
  if (tx == nullptr && n != 0) return MB4SIM_ERROR_UNKNOWN;
  return guarded(sim, [&](Simulator& simulator) {
    if (simulator.scenario().host.parallel()) return int{MB4SIM_ERROR_HOST};
    simulator.spi().transfer(std::span(tx, n), std::span(rx, rx == nullptr ? 0 : n));
    return 0;
  });
}

void mb4sim_spi_select(mb4sim* sim, int active) {
  guarded(sim, [&](Simulator& simulator) {
    simulator.spi().select(active != 0);
    return 0;
  });
}

uint8_t mb4sim_spi_byte(mb4sim* sim, uint8_t mosi) {
  const int value =
      guarded(sim, [&](Simulator& simulator) { return int{simulator.spi().byte(mosi)}; });
  return value < 0 ? uint8_t{0} : static_cast<uint8_t>(value);
}

void mb4sim_advance_ns(mb4sim* sim, uint64_t ns) {
  guarded(sim, [&](Simulator& simulator) {
    simulator.advance(std::min(ns, mb4::sim::kEndOfTime / mb4::sim::kPsPerNs + 1) *
                      mb4::sim::kPsPerNs);
    return 0;
  });
}

uint64_t mb4sim_time_ns(const mb4sim* sim) {
  return sim == nullptr ? 0 : sim->simulator.now() / mb4::sim::kPsPerNs;
}

uint64_t mb4sim_clk_cycles(const mb4sim* sim) {
  return sim == nullptr ? 0 : sim->simulator.clk_cycles();
}

int mb4sim_pin_read(mb4sim* sim, const char* pin) {
  if (sim == nullptr || pin == nullptr) return MB4SIM_ERROR_UNKNOWN;
  const auto which = sim->simulator.pin_by_name(pin);
  if (!which) return MB4SIM_ERROR_UNKNOWN;
  return sim->simulator.pin(*which) ? 1 : 0;
}

int mb4sim_pin_write(mb4sim* sim, const char* pin, int level) {
  if (sim == nullptr || pin == nullptr) return MB4SIM_ERROR_UNKNOWN;
  const auto which = sim->simulator.pin_by_name(pin);
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

const char* mb4sim_version(void) { return mb4::sim::version(); }
