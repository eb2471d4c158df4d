/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* port.h on the simulator. Time passes in accesses and in board_sleep_us(). */

#include <stdio.h>

#include "mb4sim.h"
#include "port.h"

static mb4sim *sim;

static uint32_t port_read(void *context, uint32_t offset) {
  uint32_t value = 0;
  return mb4sim_axi_read(context, offset, &value) == 0 ? value : 0;
}

static void port_write(void *context, uint32_t offset, uint32_t value) {
  if (mb4sim_axi_write(context, offset, value, 0xF) != 0) printf("bus error at 0x%03X\n", (unsigned)offset);
}

static uint32_t port_now_us(void *context) { return (uint32_t)(mb4sim_time_ns(context) / 1000); }

bool board_open(const char *place, biss_pru_port *port) {
  char error[300];
  sim = mb4sim_open_file(place, error, sizeof error);
  if (!sim) printf("%s\n", error);
  port->context = sim;
  port->read = port_read;
  port->write = port_write;
  port->now_us = port_now_us;
  return sim != NULL;
}

void board_close(void) { mb4sim_close(sim); }

void board_sleep_us(uint32_t us) { mb4sim_run_until(sim, "irq_o", 1, (uint64_t)us * 1000); }
