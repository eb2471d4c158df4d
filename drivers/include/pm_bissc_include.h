/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* The calls of the PM_bissc library of TIDM-1010, with its names, types and values, for biss_clb.
 * drivers/c/pm_bissc.c has their code. One master a program. C99, freestanding.
 *
 * A frame: PM_bissc_doCDTasks, PM_bissc_setupSCDTransaction, PM_bissc_startOperation; when
 * scd->dataReady is true PM_bissc_receivePosition. Pin irq_o calls bissc_spiRxISR, or the program
 * does so while it waits. All other calls come from one thread.
 *
 * The program sets the widths and CRCs in the structures, then calls PM_bissc_initParams. */

#ifndef PM_BISSC_INCLUDE_H_
#define PM_BISSC_INCLUDE_H_

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Supplied by the program: one access of 32 bits at a byte offset of the master; microseconds,
 * counting up and wrapping at 2^32. */
void pm_bissc_port_write(uint32_t offset, uint32_t value);
uint32_t pm_bissc_port_read(uint32_t offset);
uint32_t pm_bissc_port_now_us(void);

/* For a loop that waits for dataReady: what lets time pass where it does not pass by itself. */
#ifndef PM_BISSC_WAIT
#define PM_BISSC_WAIT() ((void)0)
#endif

/* Macros that a build may define:
 * PM_BISSC_START_AT_ONCE   no call waits for the end of the encoder's timeout
 * PM_BISSC_SWAPPED_FLAGS   error and warning swapped, as published */

/* Return codes. */
#define PM_BISSC_PASS 0U
#define PM_BISSC_FAIL 0xFFFFU
#define PM_BISSC_SCD_CRC_FAIL 0xFFFCU
#define PM_BISSC_DATA_INVALID 0xFFFAU

enum cdState {
  PM_BISSC_CD_NEW_REQUEST,  /* set by the program; waits for 14 frames with CDM = 0 */
  PM_BISSC_CD_TRANSMITTING, /* one bit a frame */
  PM_BISSC_CD_COMPLETE,     /* all bits have come */
  PM_BISSC_CD_PARSED,       /* cdStatus and rxData are those of the answer */
  PM_BISSC_CD_WAIT,         /* 14 frames with CDM = 0 */
  PM_BISSC_CD_NONE
};

enum cdStatus {
  PM_BISSC_CD_PASS,
  PM_BISSC_CD_WRITE_FAIL,
  PM_BISSC_CD_WRITE_PASS,
  PM_BISSC_CD_READ_FAIL,
  PM_BISSC_CD_READ_PASS,
  PM_BISSC_CD_CRC_FAIL,
  PM_BISSC_CD_READ_WRITE_INVALID,    /* the answer has R = W = 1 */
  PM_BISSC_CD_READ_WRITE_UNSUPPORTED /* the answer has S = 0: not yet, or not at all */
};

enum cdRegisterAccessType { PM_BISSC_REGISTER_WRITE = 1, PM_BISSC_REGISTER_READ = 2 };

/* Position. The program sets crcBits (1 to 16; 0 stands for 6 bits, polynomial 3), crcPoly without
 * its highest power, crcStart, positionSTBits, positionMTBits (together 1 to 64).
 * PM_bissc_initParams sets the others. */
typedef struct {
  volatile bool dataReady;
  uint16_t crcBits;
  uint16_t crcPoly;
  uint16_t crcStart;
  uint16_t crc_M;
  uint16_t spiFIFOWidth; /* bits of a word */
  uint16_t spiFIFOMask;
  uint16_t spiFIFOLevel;  /* words of a frame */
  uint16_t numDataClocks; /* MA clocks from the start bit on; 0: the widths are wrong */
  uint16_t positionSTBits;
  uint16_t positionST_S;
  uint16_t positionMTBits;
  uint16_t positionMT_S;
  uint16_t positionBits;
  uint32_t positionMT_M;
  uint32_t positionST_M;
  uint64_t position_M;
  uint64_t posErrWarnBits; /* position, nE and nW as received, the last 64 of them */
} PM_bissc_scdStruct;
typedef PM_bissc_scdStruct *PM_bissc_scdStruct_Handle;

/* Control data. The program sets cdState to PM_BISSC_CD_NEW_REQUEST, and crcBits (4), crcPoly,
 * crcStart before PM_bissc_initParams; crcBits 0 stands for 4 bits, polynomial 3.
 * cdmStream is the word that is sent, from START to STOP; between two words it counts the frames
 * with CDM = 0 up to 14. cdsStream is the answer, the bit of the frame with START highest. */
typedef struct {
  enum cdState cdState;
  enum cdStatus cdStatus;
  uint32_t cdmStream;
  uint32_t cdsStream;
  uint16_t crcBits;
  uint16_t crcPoly;
  uint16_t crcStart;
} PM_bissc_cdStruct;
typedef PM_bissc_cdStruct *PM_bissc_cdStruct_Handle;

typedef struct {
  uint16_t address;
  uint16_t rxData;
  uint16_t txData;
  enum cdRegisterAccessType accessType;
} PM_bissc_registerStruct;
typedef PM_bissc_registerStruct *PM_bissc_registerStruct_Handle;

/* error and warning are nE and nW as they are on the line: 0 is an error. */
typedef struct {
  uint32_t positionMT;
  uint32_t positionST;
  uint64_t position;
  uint16_t error;
  uint16_t warning;
} PM_bissc_encoderStruct;
typedef PM_bissc_encoderStruct *PM_bissc_encoderStruct_Handle;

extern volatile uint32_t scdRxData[16];
extern uint16_t bisscCRCtableSCD[256];
extern uint16_t bisscCRCtableCD[256];

/* Remainders of all bytes for a polynomial of 1 to 16 bits, without its highest power. */
void PM_bissc_generateCRCTable(uint16_t bits, uint16_t poly, uint16_t *table);
void bissc_generateCRCTable(uint16_t bits, uint16_t poly, uint16_t *table);

/* Masks, shifts, clock count and both tables; the control channel begins anew. */
void PM_bissc_initParams(PM_bissc_scdStruct_Handle scd, PM_bissc_cdStruct_Handle cd);
/* MA is the clock of the master divided by 2 * div, 1 to 2048. Other values act as the next one. */
void PM_bissc_setFreq(uint32_t div);
/* The master at rest, with MA = 1, CDM = 0 and its interrupt enabled. */
void PM_bissc_setupPeriph(void);
/* The bit of the control channel for the next frame. Once a frame; more calls change nothing. Waits
 * for the end of the encoder's timeout before it changes the level of MA. */
void PM_bissc_doCDTasks(PM_bissc_cdStruct_Handle cd, PM_bissc_registerStruct_Handle reg);
/* Ends what runs at once. */
void PM_bissc_haltOperation(void);
/* The position of the frame that has come. PM_BISSC_DATA_INVALID: no frame has, or it had no start
 * bit; PM_BISSC_SCD_CRC_FAIL: the CRC is wrong. In both cases *encoder keeps its values.
 * PM_BISSC_FAIL: wrong widths or a null pointer. */
uint16_t PM_bissc_receivePosition(PM_bissc_scdStruct_Handle scd, PM_bissc_cdStruct_Handle cd,
                                  PM_bissc_encoderStruct_Handle encoder);
/* Prepares tiles, FIFO and clock counts for the next frame. Waits for the end of the encoder's
 * timeout, 40 us at most. */
void PM_bissc_setupSCDTransaction(PM_bissc_scdStruct_Handle scd);
/* Starts MA. Waits until SL is 1, 40 us at most. */
void PM_bissc_startOperation(PM_bissc_scdStruct_Handle scd, uint32_t div);
/* Takes the words of a frame out of the FIFO and sets dataReady, also when the watchdog has ended
 * the frame. Without a frame that has come it does nothing. */
void bissc_spiRxISR(void);

#ifdef __cplusplus
}
#endif

#endif /* PM_BISSC_INCLUDE_H_ */
