/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * mb4sim.h in a plain C99 program: every function is called once. */
#include <stdio.h>
#include <string.h>

#include "mb4_regs.h"
#include "mb4sim.h"

static int check(int condition, const char *what) {
  if (!condition) fprintf(stderr, "failed: %s\n", what);
  return condition ? 0 : 1;
}

static void count_frame(void *context, const mb4sim_frame *frame) {
  if (frame->size >= sizeof *frame) ++*(int *)context;
}

int main(void) {
  static const char text[] =
      "[[channel]]\nnumber = 1\n"
      "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 8\n";
  char error[128];
  const uint8_t tx[4] = {MB4_SPI_OPCODE_READ_REGISTERS, MB4_ADDR_REVISION, 0, 0};
  uint8_t rx[4] = {0, 0, 0, 0};
  uint8_t value = 0;
  uint64_t raw = 0;
  int frames = 0;
  int failures = 0;
  mb4sim *sim = mb4sim_open(text, error, sizeof error);
  if (sim == NULL) {
    fprintf(stderr, "%s\n", error);
    return 1;
  }
  failures += check(mb4sim_open_file("/no/such.toml", error, sizeof error) == NULL, "open_file");
  failures += check(mb4sim_spi_transfer(sim, tx, rx, 4) == 0 && rx[3] == MB4_DEVICE_VERSION_IC_MB4,
                    "spi_transfer");
  mb4sim_spi_select(sim, 1);
  (void)mb4sim_spi_byte(sim, MB4_SPI_OPCODE_READ_STATUS);
  failures += check(mb4sim_spi_byte(sim, 0) == MB4_RESET_STATUS0, "spi_byte");
  mb4sim_spi_select(sim, 0);
  mb4sim_advance_ns(sim, 1000);
  failures += check(mb4sim_time_ns(sim) > 1000, "time_ns");
  failures += check(mb4sim_clk_cycles(sim) > 20, "clk_cycles");
  failures += check(mb4sim_pin_read(sim, "EOT") == 1, "pin_read");
  failures += check(mb4sim_pin_write(sim, "GETSENS", 0) == 0, "pin_write");
  failures += check(mb4sim_slave_set_data(sim, 1, 0xA5) == 0, "slave_set_data");
  failures += check(mb4sim_slave_reg_write(sim, 1, 0x44, 7) == 0, "slave_reg_write");
  failures +=
      check(mb4sim_slave_reg_read(sim, 1, 0x44, &value) == 0 && value == 7, "slave_reg_read");
  failures += check(mb4sim_slave_frames(sim, 1) == 0, "slave_frames");
  failures += check(mb4sim_on_frame(sim, count_frame, &frames) == 0, "on_frame");
  failures += check(mb4sim_on_edge(sim, NULL, NULL) == 0, "on_edge");
  failures += check(mb4sim_watch_pins(sim, NULL, 0, 1, NULL, NULL) == MB4SIM_ERROR_UNKNOWN,
                    "watch_pins without a callback");
  failures +=
      check(mb4sim_trace_start(sim, "/no/such/folder/x.fst") == MB4SIM_ERROR_TRACE, "trace_start");
  failures += check(mb4sim_trace_stop(sim) == MB4SIM_ERROR_TRACE, "trace_stop");
  mb4sim_advance_ns(sim, 1);
  failures += check(mb4sim_inject(sim, "[[fault]]\n", error, sizeof error) < 0, "inject");
  failures += check(mb4sim_slave_sent(sim, 1, 1, &raw) < 0, "slave_sent");
  failures += check(mb4sim_run_until(sim, "EOT", 0, 1000) == 0, "run_until");
  failures += check(mb4sim_bus_write(sim, 0xE6, 0) < 0, "bus_write");
  failures += check(mb4sim_bus_read(sim, 0xE6, &value) < 0, "bus_read");
  failures += check(mb4sim_report(sim, error, sizeof error) > 0, "report");
  failures += check(mb4sim_last_error(sim, NULL, 0) == 0, "last_error");
  failures += check(frames == 0, "frames");
  failures += check(strlen(mb4sim_version()) > 0, "version");
  mb4sim_close(sim);
  return failures == 0 ? 0 : 1;
}
