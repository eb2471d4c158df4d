// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

#include "openmb4_session.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iterator>

#include "masters/mb4/chip_setup.hpp"
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

mb4_config to_c(const mb4::Config& from) {
  mb4_config to = mb4_config_default();
  to.f_clk_hz = from.f_clk_hz;
  to.ma_hz = from.ma_hz;
  to.frame_timeout_us = from.frame_timeout_us;
  to.clock_source = number(from.clock_source);
  to.spi_check = number(from.spi_check);
  to.mo = from.mo;
  to.mo_busy = from.mo_busy;
  for (size_t i = 0; i < std::size(to.protocol); ++i) {
    to.protocol[i] = number(from.channels[i].protocol);
  }
  for (size_t i = 0; i < std::size(to.slaves); ++i) {
    const mb4::SlaveConfig& slave = from.slaves[i];
    to.slaves[i] = {slave.enabled,        slave.data_bits, number(slave.flags), slave.crc_start,
                    slave.crc_polynomial, slave.gray,      slave.actuator,      slave.stop_bit};
  }
  return to;
}

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
  try {
    *config =
        to_c(mb4::tool::make_config(is_path ? mb4::sim::load_scenario(scenario)
                                            : mb4::sim::parse_scenario(scenario, "scenario")));
    return 0;
  } catch (const std::exception& failure) {
    std::snprintf(error, error_size, "%s", failure.what());
    return MB4SIM_ERROR_VALUE;
  }
}
