/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* A program that uses every call, type and global of pm_bissc_include.h. It is C99 and C++. */

#include "pm_bissc_program.h"

PM_bissc_scdStruct scd;
PM_bissc_cdStruct cd;
PM_bissc_registerStruct reg;
PM_bissc_encoderStruct encoder;

void program_begin(uint16_t mt_bits, uint16_t st_bits, uint16_t crc_bits, uint16_t crc_poly,
                   uint16_t crc_start, uint32_t div) {
  PM_bissc_scdStruct_Handle position = &scd;
  PM_bissc_cdStruct_Handle control = &cd;
  position->positionMTBits = mt_bits;
  position->positionSTBits = st_bits;
  position->crcBits = crc_bits;
  position->crcPoly = crc_poly;
  position->crcStart = crc_start;
  control->crcBits = 4;
  control->crcPoly = 3;
  control->crcStart = 0;
  PM_bissc_setupPeriph();
  PM_bissc_initParams(position, control);
  PM_bissc_setFreq(div);
}

uint16_t program_frame(uint32_t div) {
  PM_bissc_doCDTasks(&cd, &reg);
  PM_bissc_setupSCDTransaction(&scd);
  PM_bissc_startOperation(&scd, div);
  while (!scd.dataReady) PM_BISSC_WAIT();
  return PM_bissc_receivePosition(&scd, &cd, &encoder);
}

uint16_t program_access(enum cdRegisterAccessType type, uint16_t address, uint16_t data,
                        uint32_t div) {
  PM_bissc_registerStruct_Handle access = &reg;
  int frames;
  access->accessType = type;
  access->address = address;
  access->txData = data;
  cd.cdState = PM_BISSC_CD_NEW_REQUEST;
  for (frames = 0; frames < 200 && cd.cdState != PM_BISSC_CD_PARSED; ++frames)
    (void)program_frame(div);
  return cd.cdState == PM_BISSC_CD_PARSED ? (uint16_t)cd.cdStatus : (uint16_t)PM_BISSC_FAIL;
}

int program_rest(void) {
  static uint16_t table[256];
  PM_bissc_encoderStruct_Handle values = &encoder;
  const volatile uint32_t *words = scdRxData;
  const enum cdState states[] = {PM_BISSC_CD_NEW_REQUEST, PM_BISSC_CD_TRANSMITTING,
                                 PM_BISSC_CD_COMPLETE,    PM_BISSC_CD_PARSED,
                                 PM_BISSC_CD_WAIT,        PM_BISSC_CD_NONE};
  const enum cdStatus statuses[] = {PM_BISSC_CD_PASS,
                                    PM_BISSC_CD_WRITE_FAIL,
                                    PM_BISSC_CD_WRITE_PASS,
                                    PM_BISSC_CD_READ_FAIL,
                                    PM_BISSC_CD_READ_PASS,
                                    PM_BISSC_CD_CRC_FAIL,
                                    PM_BISSC_CD_READ_WRITE_INVALID,
                                    PM_BISSC_CD_READ_WRITE_UNSUPPORTED};
  const uint32_t codes = PM_BISSC_PASS | PM_BISSC_FAIL | PM_BISSC_SCD_CRC_FAIL |
                         PM_BISSC_DATA_INVALID;
  int i;
  PM_bissc_generateCRCTable(6, 3, table);
  for (i = 0; i < 256; ++i)
    if (table[i] >= 64U) return 1;
  bissc_generateCRCTable(4, 3, table);
  for (i = 0; i < 256; ++i)
    if (table[i] != bisscCRCtableCD[i] || bisscCRCtableSCD[i] > scd.crc_M) return 2;
  if (words[0] > scd.spiFIFOMask || scd.spiFIFOWidth != 12U || scd.spiFIFOLevel > 16U) return 3;
  if (scd.numDataClocks != scd.positionBits + 4U + scd.crcBits) return 4;
  if (((uint64_t)values->positionMT << scd.positionMT_S | values->positionST << scd.positionST_S) !=
      (values->position & scd.position_M))
    return 5;
  if (values->positionMT > scd.positionMT_M || values->positionST > scd.positionST_M) return 6;
  if ((scd.posErrWarnBits & 3U) != (uint64_t)(values->error * 2U + values->warning)) return 7;
  if (states[5] != PM_BISSC_CD_NONE || statuses[7] != PM_BISSC_CD_READ_WRITE_UNSUPPORTED) return 8;
  if (codes != 0xFFFFU || cd.cdmStream > 14U || cd.cdsStream == 1U) return 9;
  bissc_spiRxISR(); /* without a frame it does nothing */
  PM_bissc_haltOperation();
  return scd.dataReady ? 10 : 0;
}
