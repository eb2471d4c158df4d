/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * mb4sim.h in a plain C99 program: every function is called once. */
#include <stdio.h>
#include <string.h>

#include "mb4sim.h"

static int check(int condition, const char *what) {
  if (!condition) fprintf(stderr, "failed: %s\n", what);
  return condition ? 0 : 1;
}

int main(void) {
  static const char text[] =
      "[[channel]]\nnumber = 1\n"
      "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 8\n";
  char error[128];
  const uint8_t tx[4] = {0x03, 0xEA, 0x00, 0x00};
  uint8_t rx[4] = {0, 0, 0, 0};
  uint8_t value = 0;
  int failures = 0;
  mb4sim *sim = mb4sim_open(text, error, sizeof error);
  if (sim == NULL) {
    fprintf(stderr, "%s\n", error);
    return 1;
  }
  failures += check(mb4sim_open_file("/no/such.toml", error, sizeof error) == NULL, "open_file");
  failures += check(mb4sim_spi_transfer(sim, tx, rx, 4) == 0 && rx[3] == 0x84, "spi_transfer");
  mb4sim_spi_select(sim, 1);
  (void)mb4sim_spi_byte(sim, 0x05);
  failures += check(mb4sim_spi_byte(sim, 0x00) == 0xFB, "spi_byte");
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
  failures += check(strlen(mb4sim_version()) > 0, "version");
  mb4sim_close(sim);
  return failures == 0 ? 0 : 1;
}
