/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* The calls of pm_bissc_include.h on the registers of biss_clb. C99, freestanding.
 *
 * What a control frame has reached is in its structure: cdsStream begins as 1, and this 1 moves up
 * with each CDS bit, so its place is the number of the next CDM bit. Calls that come twice in one
 * frame therefore change nothing. */

#include "pm_bissc_include.h"

#include "clb_regs.h"

enum {
  kWordBits = 12,
  kWords = 16,
  kZeros = 14,     /* frames with CDM = 0 before a control frame */
  kTimeoutUs = 40, /* the longest timeout of an encoder */
  kState = 3,
  kStateReceive = 3, /* MA has ended */
  kRunning = 1
};

/* Places in cdsStream: slot 0, of the frame with START, is bit 31. */
enum { kEchoR = 14, kEchoW = 13, kEchoS = 12, kData = 4, kCrc = 0 };

volatile uint32_t scdRxData[16];
uint16_t bisscCRCtableSCD[256];
uint16_t bisscCRCtableCD[256];

/* The frame that runs. bissc_spiRxISR has no argument and sets its dataReady. */
static PM_bissc_scdStruct *volatile pm_bissc_running;

/* ---- CRC --------------------------------------------------------------------------------- */

static uint32_t mask_of(uint32_t bits) {
  return bits >= 32U ? 0xFFFFFFFFU : ((uint32_t)1 << bits) - 1U;
}

static uint32_t one_bit(uint32_t crc, uint32_t bit, uint32_t bits, uint32_t poly) {
  const uint32_t top = (crc >> (bits - 1U)) & 1U;
  crc = (crc << 1) & mask_of(bits);
  return top != bit ? crc ^ (poly & mask_of(bits)) : crc;
}

static uint32_t one_byte(uint32_t crc, uint32_t byte, uint32_t bits, const uint16_t *table) {
  if (bits <= 8U) return table[((crc << (8U - bits)) ^ byte) & 0xFFU];
  return ((crc << 8) ^ table[((crc >> (bits - 8U)) ^ byte) & 0xFFU]) & mask_of(bits);
}

void PM_bissc_generateCRCTable(uint16_t bits, uint16_t poly, uint16_t *table) {
  if (bits == 0U || bits > 16U || !table) return;
  for (uint32_t byte = 0; byte < 256U; ++byte) {
    uint32_t crc = 0;
    for (uint32_t i = 8; i-- > 0U;) crc = one_bit(crc, (byte >> i) & 1U, bits, poly);
    table[byte] = (uint16_t)crc;
  }
}

void bissc_generateCRCTable(uint16_t bits, uint16_t poly, uint16_t *table) {
  PM_bissc_generateCRCTable(bits, poly, table);
}

/* ---- Registers --------------------------------------------------------------------------- */

static uint32_t end_level(void) {
  return pm_bissc_port_read(CLB_ADDR_FSM_GPREG) & CLB_END_LEVEL_MASK;
}

/* Until MA has ended and the encoder has let go of SL, or no frame has begun. */
static void wait_for_timeout(void) {
#ifndef PM_BISSC_START_AT_ONCE
  const uint32_t begin = pm_bissc_port_now_us();
  for (;;) {
    const uint32_t state = pm_bissc_port_read(CLB_ADDR_FSM_STATE);
    const uint32_t frame = state & CLB_FRAME_STATE_MASK;
    if ((frame == 0U || frame == (uint32_t)kStateReceive) && (state & CLB_SL_LEVEL_MASK) != 0U)
      return;
    if (pm_bissc_port_now_us() - begin > (uint32_t)kTimeoutUs) return;
  }
#endif
}

static uint32_t divider(uint32_t div) {
  if (div < 1U) return 1U;
  return div > 2048U ? 2048U : div;
}

void PM_bissc_setFreq(uint32_t div) {
  const uint32_t d = divider(div);
  pm_bissc_port_write(CLB_ADDR_CLK_COUNTER_0_MATCH1, d - 1U);
  pm_bissc_port_write(CLB_ADDR_CLK_COUNTER_0_MATCH2, 2U * d - 1U);
  pm_bissc_port_write(CLB_ADDR_CLK_COUNTER_1_MATCH1, d - 1U);
  pm_bissc_port_write(CLB_ADDR_CLK_COUNTER_1_MATCH2, 2U * d - 1U);
}

void PM_bissc_haltOperation(void) {
  pm_bissc_port_write(CLB_ADDR_CLK_GPREG, 0);
  pm_bissc_port_write(CLB_ADDR_FSM_GPREG, end_level());
  pm_bissc_port_write(CLB_ADDR_CLK_LOAD_EN, 0);
  pm_bissc_port_write(CLB_ADDR_FSM_LOAD_EN, 0);
}

void PM_bissc_setupPeriph(void) {
  pm_bissc_running = 0;
  PM_bissc_haltOperation();
  pm_bissc_port_write(CLB_ADDR_FSM_GPREG, CLB_END_LEVEL_MASK);
  pm_bissc_port_write(CLB_ADDR_SPICCR, (uint32_t)kWordBits - 1U);
  pm_bissc_port_write(CLB_ADDR_SPIFFRX, CLB_RXFFOVFCLR_MASK | CLB_RXFFINTCLR_MASK);
  pm_bissc_port_write(CLB_ADDR_IRQ_STATUS, CLB_RECEIVED_MASK | CLB_ERROR_MASK | CLB_START_SEEN_MASK);
  pm_bissc_port_write(CLB_ADDR_IRQ_ENABLE, CLB_RECEIVED_ENABLE_MASK | CLB_ERROR_ENABLE_MASK);
}

void PM_bissc_setupSCDTransaction(PM_bissc_scdStruct_Handle scd) {
  if (!scd) return;
  wait_for_timeout();
  pm_bissc_running = 0;
  PM_bissc_haltOperation();
  scd->dataReady = false;
  pm_bissc_port_write(CLB_ADDR_SPICCR, (uint32_t)kWordBits - 1U);
  pm_bissc_port_write(CLB_ADDR_SPIFFRX, CLB_RXFFOVFCLR_MASK | CLB_RXFFINTCLR_MASK);
  pm_bissc_port_write(CLB_ADDR_SPIFFRX, CLB_RXFIFORESET_MASK | CLB_RXFFINTCLR_MASK |
                                            CLB_RXFFIENA_MASK | scd->spiFIFOLevel);
  pm_bissc_port_write(CLB_ADDR_SPICCR, CLB_SPISWRESET_MASK | ((uint32_t)kWordBits - 1U));
  pm_bissc_port_write(CLB_ADDR_IRQ_STATUS, CLB_RECEIVED_MASK | CLB_ERROR_MASK | CLB_START_SEEN_MASK);
  pm_bissc_port_write(CLB_ADDR_FSM_COUNTER_2_MATCH1, (uint32_t)scd->spiFIFOLevel * kWordBits);
  pm_bissc_port_write(CLB_ADDR_FSM_HLC_R0, scd->numDataClocks);
  pm_bissc_running = scd;
  pm_bissc_port_write(CLB_ADDR_CLK_LOAD_EN, CLB_CLK_GLOBAL_EN_MASK);
  pm_bissc_port_write(CLB_ADDR_FSM_LOAD_EN, CLB_FSM_GLOBAL_EN_MASK);
}

void PM_bissc_startOperation(PM_bissc_scdStruct_Handle scd, uint32_t div) {
  if (!scd || scd->numDataClocks == 0U) return;
  wait_for_timeout();
  pm_bissc_port_write(CLB_ADDR_CLK_COUNTER_0_LOAD, divider(div) - 1U);
  pm_bissc_port_write(CLB_ADDR_FSM_GPREG, end_level() | (uint32_t)kRunning);
  pm_bissc_port_write(CLB_ADDR_CLK_GPREG, kRunning);
}

void bissc_spiRxISR(void) {
  PM_bissc_scdStruct *const scd = pm_bissc_running;
  const uint32_t fifo = pm_bissc_port_read(CLB_ADDR_SPIFFRX);
  if (!scd) {
    pm_bissc_port_write(CLB_ADDR_IRQ_STATUS, CLB_RECEIVED_MASK | CLB_ERROR_MASK);
    return;
  }
  if ((fifo & CLB_RXFFINT_MASK) != 0U) {
    for (uint32_t i = 0; i < (uint32_t)kWords && i < scd->spiFIFOLevel; ++i)
      scdRxData[i] = pm_bissc_port_read(CLB_ADDR_SPIRXBUF) & scd->spiFIFOMask;
  } else {
    /* Before the look: an end that comes in between interrupts again. After a halt it is no frame's. */
    pm_bissc_port_write(CLB_ADDR_IRQ_STATUS, CLB_ERROR_MASK);
    if ((pm_bissc_port_read(CLB_ADDR_FSM_STATE) & CLB_WATCHDOG_ENDED_MASK) == 0U) return;
    scdRxData[0] = 0; /* no start bit */
  }
  /* The level may interrupt again with the next frame only. */
  pm_bissc_port_write(CLB_ADDR_SPIFFRX,
                      CLB_RXFIFORESET_MASK | CLB_RXFFINTCLR_MASK | scd->spiFIFOLevel);
  pm_bissc_port_write(CLB_ADDR_IRQ_STATUS, CLB_RECEIVED_MASK | CLB_ERROR_MASK);
  pm_bissc_running = 0;
  scd->dataReady = true;
}

/* ---- Position ---------------------------------------------------------------------------- */

static bool widths_fit(const PM_bissc_scdStruct *scd) {
  const uint32_t bits = (uint32_t)scd->positionSTBits + scd->positionMTBits;
  return bits >= 1U && bits <= 64U && scd->crcBits >= 1U && scd->crcBits <= 16U;
}

void PM_bissc_initParams(PM_bissc_scdStruct_Handle scd, PM_bissc_cdStruct_Handle cd) {
  if (scd) {
    if (scd->crcBits == 0U) {
      scd->crcBits = 6;
      scd->crcPoly = 3;
    }
    scd->dataReady = false;
    scd->spiFIFOWidth = kWordBits;
    scd->spiFIFOMask = (uint16_t)mask_of(kWordBits);
    scd->numDataClocks = 0;
    scd->spiFIFOLevel = 0;
    if (widths_fit(scd)) {
      const uint32_t bits = (uint32_t)scd->positionSTBits + scd->positionMTBits;
      const uint32_t clocks = bits + 4U + scd->crcBits; /* START, CDS, nE, nW */
      scd->positionBits = (uint16_t)bits;
      scd->numDataClocks = (uint16_t)clocks;
      scd->spiFIFOLevel = (uint16_t)((clocks + kWordBits - 1U) / kWordBits);
      scd->crc_M = (uint16_t)mask_of(scd->crcBits);
      scd->positionST_S = 0;
      scd->positionMT_S = scd->positionSTBits;
      scd->positionST_M = mask_of(scd->positionSTBits);
      scd->positionMT_M = mask_of(scd->positionMTBits);
      scd->position_M = bits == 64U ? ~(uint64_t)0 : ((uint64_t)1 << bits) - 1U;
      scd->posErrWarnBits = 0;
      PM_bissc_generateCRCTable(scd->crcBits, scd->crcPoly, bisscCRCtableSCD);
    }
  }
  if (cd) {
    if (cd->crcBits == 0U) {
      cd->crcBits = 4;
      cd->crcPoly = 3;
    }
    cd->cdState = PM_BISSC_CD_NONE;
    cd->cdStatus = PM_BISSC_CD_PASS;
    cd->cdmStream = 0;
    cd->cdsStream = 0;
    PM_bissc_generateCRCTable(cd->crcBits, cd->crcPoly, bisscCRCtableCD);
  }
}

/* Bit `index` of the line, START is 0. */
static uint32_t line_bit(uint32_t index) {
  const uint32_t word = scdRxData[index / kWordBits];
  return (word >> ((uint32_t)kWordBits - 1U - index % kWordBits)) & 1U;
}

static uint32_t line_bits(uint32_t index, uint32_t count) {
  uint32_t value = 0;
  for (; count > 0U; --count) value = (value << 1) | line_bit(index++);
  return value;
}

/* CRC of position, nE and nW; those that make no whole byte come first. */
static uint32_t line_crc(const PM_bissc_scdStruct *scd) {
  uint32_t left = (uint32_t)scd->positionBits + 2U;
  uint32_t index = 2;
  uint32_t crc = scd->crcStart & (uint32_t)scd->crc_M;
  for (; left % 8U != 0U; --left) crc = one_bit(crc, line_bit(index++), scd->crcBits, scd->crcPoly);
  for (; left != 0U; left -= 8U, index += 8U)
    crc = one_byte(crc, line_bits(index, 8), scd->crcBits, bisscCRCtableSCD);
  return crc;
}

/* A frame that was no frame ends a control frame: the encoder may have seen its bit or not. */
static void control_failed(PM_bissc_cdStruct *cd) {
  if (cd->cdState != PM_BISSC_CD_TRANSMITTING) return;
  cd->cdsStream = 0;
  cd->cdmStream = 0;
  cd->cdState = PM_BISSC_CD_COMPLETE;
}

/* One CDS bit, of a frame with the level that MA has now. */
static void control_bit(PM_bissc_cdStruct *cd, uint32_t cds) {
  if (cd->cdState == PM_BISSC_CD_TRANSMITTING) {
    const bool last = (cd->cdsStream >> 31) != 0U;
    cd->cdsStream = (cd->cdsStream << 1) | cds;
    if (last) {
      cd->cdmStream = 0;
      cd->cdState = PM_BISSC_CD_COMPLETE;
    }
  } else if (end_level() == 0U || cd->cdmStream > (uint32_t)kZeros) {
    cd->cdmStream = 0; /* also a word that a new request has broken off */
  } else if (cd->cdmStream < (uint32_t)kZeros) {
    ++cd->cdmStream;
  }
}

uint16_t PM_bissc_receivePosition(PM_bissc_scdStruct_Handle scd, PM_bissc_cdStruct_Handle cd,
                                  PM_bissc_encoderStruct_Handle encoder) {
  if (!scd || !cd || !encoder || scd->numDataClocks == 0U) return PM_BISSC_FAIL;
  if (!scd->dataReady) return PM_BISSC_DATA_INVALID;
  scd->dataReady = false; /* a frame is read once */
  if (line_bit(0) == 0U) {
    control_failed(cd);
    return PM_BISSC_DATA_INVALID;
  }
  control_bit(cd, line_bit(1));

  uint32_t index = 2;
  uint64_t position = 0;
  for (uint32_t i = 0; i < scd->positionBits; ++i) position = (position << 1) | line_bit(index++);
  const uint32_t error = line_bit(index++);
  const uint32_t warning = line_bit(index++);
  const uint32_t crc = line_bits(index, scd->crcBits);
  scd->posErrWarnBits = (position << 2) | (error << 1) | warning;
  if ((~line_crc(scd) & scd->crc_M) != crc) return PM_BISSC_SCD_CRC_FAIL;

  encoder->position = position;
  encoder->positionST = (uint32_t)(position >> scd->positionST_S) & scd->positionST_M;
  encoder->positionMT = scd->positionMT_S >= 64U
                            ? 0U
                            : (uint32_t)(position >> scd->positionMT_S) & scd->positionMT_M;
#ifdef PM_BISSC_SWAPPED_FLAGS
  encoder->error = (uint16_t)warning;
  encoder->warning = (uint16_t)error;
#else
  encoder->error = (uint16_t)error;
  encoder->warning = (uint16_t)warning;
#endif
  return PM_BISSC_PASS;
}

/* ---- Control data ------------------------------------------------------------------------ */

static uint32_t control_crc(const PM_bissc_cdStruct *cd, uint32_t value, uint32_t count) {
  uint32_t crc = cd->crcStart & mask_of(cd->crcBits);
  for (; count % 8U != 0U; --count)
    crc = one_bit(crc, (value >> (count - 1U)) & 1U, cd->crcBits, cd->crcPoly);
  for (; count != 0U; count -= 8U)
    crc = one_byte(crc, (value >> (count - 8U)) & 0xFFU, cd->crcBits, bisscCRCtableCD);
  return ~crc & 0xFU;
}

/* START, CTS, ID 0, address, CRC, R, W, S, data, CRC, STOP. */
static uint32_t control_word(const PM_bissc_cdStruct *cd, const PM_bissc_registerStruct *reg) {
  const bool write = reg->accessType == PM_BISSC_REGISTER_WRITE;
  const uint32_t header = 0x400U | (reg->address & 0x7FU);
  const uint32_t data = reg->txData & 0xFFU;
  uint32_t word = 1;
  word = (word << 11) | header;
  word = (word << 4) | control_crc(cd, header, 11);
  word = (word << 3) | (write ? 3U : 5U);
  word = (word << 8) | (write ? data : 0U);
  word = (word << 4) | (write ? control_crc(cd, data, 8) : 0U);
  return word << 1;
}

static enum cdStatus answer(const PM_bissc_cdStruct *cd, PM_bissc_registerStruct *reg) {
  const bool write = reg->accessType == PM_BISSC_REGISTER_WRITE;
  const uint32_t r = (cd->cdsStream >> kEchoR) & 1U;
  const uint32_t w = (cd->cdsStream >> kEchoW) & 1U;
  const uint32_t data = (cd->cdsStream >> kData) & 0xFFU;
  const uint32_t crc = (cd->cdsStream >> kCrc) & 0xFU;
  if (((cd->cdsStream >> kEchoS) & 1U) == 0U) return PM_BISSC_CD_READ_WRITE_UNSUPPORTED;
  if (r == 1U && w == 1U) return PM_BISSC_CD_READ_WRITE_INVALID;
  if (write) {
    if (w == 0U || data != (reg->txData & 0xFFU)) return PM_BISSC_CD_WRITE_FAIL;
    return crc == control_crc(cd, data, 8) ? PM_BISSC_CD_WRITE_PASS : PM_BISSC_CD_CRC_FAIL;
  }
  if (r == 0U) return PM_BISSC_CD_READ_FAIL;
  if (crc != control_crc(cd, data, 8)) return PM_BISSC_CD_CRC_FAIL;
  reg->rxData = (uint16_t)data;
  return PM_BISSC_CD_READ_PASS;
}

/* Number of the next bit: the place of the highest 1 of cdsStream. */
static uint32_t next_slot(const PM_bissc_cdStruct *cd) {
  uint32_t slot = 31;
  while (slot > 0U && (cd->cdsStream >> slot) == 0U) --slot;
  return slot;
}

void PM_bissc_doCDTasks(PM_bissc_cdStruct_Handle cd, PM_bissc_registerStruct_Handle reg) {
  if (!cd || !reg) return;
  switch (cd->cdState) {
    case PM_BISSC_CD_NEW_REQUEST:
      if (cd->cdmStream == (uint32_t)kZeros) {
        cd->cdmStream = control_word(cd, reg);
        cd->cdsStream = 1;
        cd->cdStatus = PM_BISSC_CD_PASS;
        cd->cdState = PM_BISSC_CD_TRANSMITTING;
      }
      break;
    case PM_BISSC_CD_COMPLETE:
      cd->cdStatus = answer(cd, reg);
      cd->cdState = PM_BISSC_CD_PARSED;
      break;
    case PM_BISSC_CD_PARSED:
      cd->cdState = PM_BISSC_CD_WAIT;
      break;
    case PM_BISSC_CD_WAIT:
      if (cd->cdmStream == (uint32_t)kZeros) cd->cdState = PM_BISSC_CD_NONE;
      break;
    case PM_BISSC_CD_TRANSMITTING:
    case PM_BISSC_CD_NONE:
    default:
      break;
  }
  uint32_t cdm = 0;
  if (cd->cdState == PM_BISSC_CD_TRANSMITTING) cdm = (cd->cdmStream >> (31U - next_slot(cd))) & 1U;
  const uint32_t level = cdm != 0U ? 0U : CLB_END_LEVEL_MASK;
  if (end_level() != level) {
    /* Behind a frame MA has this level. The tile is reset first, so that MA does not fall: to the
     * encoder that would be the begin of a frame. */
    wait_for_timeout();
    if ((pm_bissc_port_read(CLB_ADDR_FSM_STATE) & CLB_FRAME_STATE_MASK) != 0U)
      pm_bissc_port_write(CLB_ADDR_FSM_LOAD_EN, 0);
    pm_bissc_port_write(CLB_ADDR_FSM_GPREG, level);
  }
}
