/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* port.h and the port of pm_bissc_include.h on the simulator. */

#include <stdio.h>

#include "mb4sim.h"
#include "port.h"

static mb4sim *sim;

bool board_open(const char *scenario) {
  char error[300];
  sim = mb4sim_open_file(scenario, error, sizeof error);
  if (!sim) printf("%s\n", error);
  return sim != NULL;
}

void board_close(void) { mb4sim_close(sim); }

uint32_t board_clk_hz(void) { return 200000000; }

void board_pause_us(uint32_t us) { mb4sim_advance_ns(sim, (uint64_t)us * 1000); }

bool board_sleep_us(uint32_t us) {
  return mb4sim_run_until(sim, "irq_o", 1, (uint64_t)us * 1000) == 1;
}

void pm_bissc_port_write(uint32_t offset, uint32_t value) {
  if (mb4sim_axi_write(sim, offset, value, 0xF) != 0) printf("bus error at 0x%03X\n", (unsigned)offset);
}

uint32_t pm_bissc_port_read(uint32_t offset) {
  uint32_t value = 0;
  if (mb4sim_axi_read(sim, offset, &value) != 0) printf("bus error at 0x%03X\n", (unsigned)offset);
  return value;
}

uint32_t pm_bissc_port_now_us(void) { return (uint32_t)(mb4sim_time_ns(sim) / 1000); }
