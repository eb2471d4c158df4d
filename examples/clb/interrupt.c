/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* Positions by the interrupt of biss_clb: the processor does something else, or sleeps, while a frame runs. The encoder has
 * 12 bits multiturn and 20 bits single turn.
 *
 *   interrupt SCENARIO */

#include <stdio.h>

#include "port.h"

static PM_bissc_scdStruct scd;
static PM_bissc_cdStruct cd;
static PM_bissc_registerStruct reg;
static PM_bissc_encoderStruct encoder;

/* On a board the interrupt controller calls bissc_spiRxISR(). */
static bool frame(uint32_t div) {
  PM_bissc_doCDTasks(&cd, &reg);
  PM_bissc_setupSCDTransaction(&scd);
  PM_bissc_startOperation(&scd, div);
  while (!scd.dataReady) {
    if (!board_sleep_us(5000)) return false;
    bissc_spiRxISR();
  }
  return PM_bissc_receivePosition(&scd, &cd, &encoder) == PM_BISSC_PASS;
}

int main(int argc, char **argv) {
  const uint32_t div = board_clk_hz() / (2 * 1000000); /* MA = 1 MHz */
  if (argc != 2 || !board_open(argv[1])) return 2;
  scd.positionMTBits = 12;
  scd.positionSTBits = 20;
  cd.cdState = PM_BISSC_CD_NONE;
  PM_bissc_setupPeriph();
  PM_bissc_initParams(&scd, &cd);
  PM_bissc_setFreq(div);
  int status = 0;
  for (int i = 0; i < 5 && status == 0; ++i) {
    if (frame(div)) {
      printf("turn %lu, angle %lu, nE %u, nW %u\n", (unsigned long)encoder.positionMT,
             (unsigned long)encoder.positionST, (unsigned)encoder.error, (unsigned)encoder.warning);
    } else {
      status = 1;
    }
    board_pause_us(200);
  }
  PM_bissc_haltOperation();
  board_close();
  return status;
}
