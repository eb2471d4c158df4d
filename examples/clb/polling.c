/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* Positions and a register of the encoder, without interrupts: the loop takes the words itself. The encoder has 18 bits.
 * Register 0x40 is written with 1, 3 and 5, and read back, while positions come.
 *
 *   polling SCENARIO */

#include <stdio.h>

#include "port.h"

static PM_bissc_scdStruct scd;
static PM_bissc_cdStruct cd;
static PM_bissc_registerStruct reg;
static PM_bissc_encoderStruct encoder;

static bool frame(uint32_t div) {
  PM_bissc_doCDTasks(&cd, &reg);
  PM_bissc_setupSCDTransaction(&scd);
  PM_bissc_startOperation(&scd, div);
  while (!scd.dataReady) {
    PM_BISSC_WAIT(); /* the one line that a simulator needs */
    bissc_spiRxISR();
  }
  return PM_bissc_receivePosition(&scd, &cd, &encoder) == PM_BISSC_PASS;
}

/* One frame brings one bit of the access. */
static bool access(enum cdRegisterAccessType type, uint16_t data, uint32_t div) {
  reg.accessType = type;
  reg.address = 0x40;
  reg.txData = data;
  cd.cdState = PM_BISSC_CD_NEW_REQUEST;
  for (int frames = 0; frames < 200 && cd.cdState != PM_BISSC_CD_PARSED; ++frames) {
    if (!frame(div)) return false;
  }
  return cd.cdStatus == PM_BISSC_CD_WRITE_PASS || cd.cdStatus == PM_BISSC_CD_READ_PASS;
}

int main(int argc, char **argv) {
  const uint32_t div = board_clk_hz() / (2 * 10000000); /* MA = 10 MHz */
  if (argc != 2 || !board_open(argv[1])) return 2;
  scd.positionSTBits = 18;
  PM_bissc_setupPeriph();
  PM_bissc_initParams(&scd, &cd);
  PM_bissc_setFreq(div);
  int status = 0;
  for (uint16_t value = 1; value <= 5 && status == 0; value += 2) {
    if (access(PM_BISSC_REGISTER_WRITE, value, div) && access(PM_BISSC_REGISTER_READ, 0, div)) {
      printf("register 0x40: %u, angle %lu\n", (unsigned)reg.rxData,
             (unsigned long)encoder.positionST);
    } else {
      status = 1;
    }
  }
  PM_bissc_haltOperation();
  board_close();
  return status;
}
