/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* A control frame is a free word of 32 bits, so it can be wrong. The write of TIDEP0022, Table 7, is printed with one
 * hexadecimal digit that does not fit: the encoder refuses it, and CMD_CRC_ERR tells. Then follows the right word.
 *
 *   pru_malformed_word encoder.toml
 */

#include <stdio.h>

#include "mb4sim.h"
#include "pru_regs.h"

#define READ_60 0x8C174000U
#define PRINTED 0x8C13C194U /* R, W and S are 1, and the CRC of the address does not fit */
#define RIGHT 0x8C16C194U   /* writes 0x06 to register 0x60 */

static mb4sim *sim;

static uint32_t read_word(uint32_t address) {
  uint32_t value = 0;
  if (mb4sim_axi_read(sim, address, &value) != 0) printf("no answer at 0x%03X\n", (unsigned)address);
  return value;
}

static void write_word(uint32_t address, uint32_t value) {
  if (mb4sim_axi_write(sim, address, value, 0xF) != 0) printf("no answer at 0x%03X\n", (unsigned)address);
}

/* Sends the bits behind START, and waits for the end of the control frame. */
static void control(const char *what, uint32_t word) {
  write_word(PRU_ADDR_IRQ_STATUS, PRU_CTRL_ENDED_MASK);
  write_word(PRU_ADDR_CTRL, word);
  if (mb4sim_run_until(sim, "irq_o", 1, 20000000) != 1) printf("the control frame has not ended\n");
  printf("%-8s %08X: result %02X%s\n", what, (unsigned)word, (unsigned)read_word(PRU_ADDR_CTRL_RESULT),
         (read_word(PRU_ADDR_STATUS) & PRU_CMD_CRC_ERR_MASK) != 0 ? ", refused" : "");
}

int main(int argc, char **argv) {
  char error[300];
  sim = argc == 2 ? mb4sim_open_file(argv[1], error, sizeof error) : NULL;
  if (!sim) {
    printf("%s\n", argc == 2 ? error : "usage: pru_malformed_word SCENARIO");
    return 2;
  }
  write_word(PRU_ADDR_LENGTHS, 5U << 16 | 8U << 8 | 12U); /* 5 MHz; nE, nW and six bits of CRC; 12 bits */
  write_word(PRU_ADDR_IRQ_ENABLE, PRU_CTRL_ENDED_ENABLE_MASK);
  write_word(PRU_ADDR_RUN, 1);
  control("read", READ_60);
  control("printed", PRINTED);
  control("read", READ_60);
  control("right", RIGHT);
  control("read", READ_60);
  mb4sim_close(sim);
  return 0;
}
