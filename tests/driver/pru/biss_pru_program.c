/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* A program that uses every call of biss_pru.h. It is C99 and C++, and is compiled only. */

#include "biss_pru.h"

biss_pru_result program(biss_pru_master *pru, const biss_pru_port *port, biss_pru_reading *reading);
const char *program_text(biss_pru_result result);

biss_pru_result program(biss_pru_master *pru, const biss_pru_port *port, biss_pru_reading *reading) {
  biss_pru_config config;
  uint8_t data = 0;
  uint16_t first_frame = 0;
  biss_pru_result result = BISS_PRU_OK;
  config.position_bits = 12;
  config.crc_err_war = 8;
  config.mhz = 1;
  config.unchecked = false;
  config.interrupt = false;
  config.period_us = 100;
  config.period_clk = 0;
  config.overhead_us = 0;
  config.proc_time_max = 0;
  config.frame_limit_us = 0;
  result = biss_pru_start(pru, port, &config);
  if (result == BISS_PRU_OK) {
    result = biss_pru_set_frequency(pru, 10, &first_frame);
  }
  if (result == BISS_PRU_OK) {
    result = biss_pru_position(pru, reading);
  }
  if (result == BISS_PRU_OK) {
    result = biss_pru_read_register(pru, 0, 0x44, &data);
  }
  if (result == BISS_PRU_OK) {
    result = biss_pru_write_register(pru, 0, 0x60, data);
  }
  if (result == BISS_PRU_OK) {
    result = biss_pru_begin_read(pru, 0, 0x44);
  }
  if (result == BISS_PRU_OK) {
    result = biss_pru_wait(pru, &data);
  }
  if (result == BISS_PRU_OK) {
    result = biss_pru_begin_write(pru, 0, 0x60, data);
  }
  if (result == BISS_PRU_OK) {
    result = biss_pru_poll(pru, &data);
  }
  biss_pru_stop(pru);
  return result;
}

const char *program_text(biss_pru_result result) { return biss_pru_text(result); }
