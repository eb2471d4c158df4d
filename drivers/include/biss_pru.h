/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The calls of biss_pru, the BiSS C master with the memory of TIDEP0022: positions, line delay,
 * processing time, registers of the encoder. C99 and C++, freestanding; no heap, no static data.
 * A program needs this header and the generated pru_regs.h. It supplies two functions that access
 * the registers and one that tells the time. Several masters: one biss_pru_master object each.
 *
 *   biss_pru_start(&pru, &port, &config);
 *   for (;;) {
 *     code = biss_pru_position(&pru, &reading);   // BISS_PRU_OK: a new position
 *     ...
 *   }
 *
 * A register of the encoder takes 47 frames. biss_pru_begin_read() or biss_pru_begin_write(), then
 * biss_pru_poll() until it no longer returns BISS_PRU_PENDING; positions go on meanwhile. The calls
 * biss_pru_read_register() and biss_pru_write_register() wait for the end.
 *
 * biss_pru_position() may interrupt the calls for registers and biss_pru_set_frequency(), if the
 * functions of the port allow it. No other call may interrupt another one on the same object.
 * FRAME_ENDED of IRQ_STATUS belongs to biss_pru_position() if biss_pru_config.interrupt is true,
 * CTRL_ENDED to the calls for registers. The other bits are the program's; biss_pru_start() clears
 * all.
 *
 * Sources: TIDEP0022, Table 1 and 3.2.3.2; docs/pru.md; regmap/generated/pru/registers.md.
 */
#ifndef BISS_PRU_H_
#define BISS_PRU_H_

#include <stdbool.h>
#include <stdint.h>

#include "pru_regs.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Results --------------------------------------------------------------------------------- */

typedef enum {
  BISS_PRU_OK = 0,

  /* No new result; nothing is wrong. */
  BISS_PRU_NO_NEW_FRAME, /* no frame has ended since the last one that was told */
  BISS_PRU_PENDING,      /* the access of a register goes on */

  /* What a frame brought. It has no position. */
  BISS_PRU_NO_SLAVE,      /* no acknowledge, or SL was 0 before the frame */
  BISS_PRU_CRC,           /* the CRC of the position is wrong */
  BISS_PRU_PROCESSING,    /* the encoder's processing time is over the limit */
  BISS_PRU_ENCODER_ERROR, /* the frame is good, but its nE is 0: the position is not to be trusted
                           */

  /* The master. */
  BISS_PRU_NOT_RUNNING, /* RUN is 0: stopped, or reset. Only biss_pru_start() helps */
  BISS_PRU_NO_FRAMES,   /* no frame has ended for longer than frame_limit_us */
  BISS_PRU_TORN,      /* a frame has ended during each of BISS_PRU_TRIES reads: the port is slow */
  BISS_PRU_NO_MASTER, /* no biss_pru of this map at the port */

  /* The access of a register. */
  BISS_PRU_BUSY,       /* another word waits, or its control frame runs; nothing was written */
  BISS_PRU_NO_ACCESS,  /* biss_pru_poll() without an access that has begun */
  BISS_PRU_NO_ANSWER,  /* data and CRC came as zeros: no such ID or register, or it takes longer */
  BISS_PRU_BAD_ANSWER, /* the CRC of the answer is wrong */
  BISS_PRU_BAD_ECHO,   /* of a write: another byte has come back, with a CRC that fits it */
  BISS_PRU_TIMEOUT,    /* the control frame has not ended in time */

  /* A wrong argument; nothing was written. */
  BISS_PRU_BAD_PORT,          /* a function is null */
  BISS_PRU_BAD_POSITION_BITS, /* 1 to 63, with crc_err_war at most 63 */
  BISS_PRU_BAD_CRC_ERR_WAR,   /* at most 32 */
  BISS_PRU_UNCHECKED,         /* fewer than 6 bits of CRC, and `unchecked` is false */
  BISS_PRU_BAD_FREQUENCY,     /* 1, 2, 5, 10 */
  BISS_PRU_BAD_PERIOD,        /* both given, or more than 24 bits of clocks */
  BISS_PRU_BAD_OVERHEAD,      /* more than 16 bits of clocks */
  BISS_PRU_BAD_PROC_TIME_MAX, /* more than 10 bits */
  BISS_PRU_BAD_FRAME_LIMIT,   /* over a minute; or 0, and frames come by the pin */
  BISS_PRU_BAD_REGISTER       /* ID over 7, or address over 127 */
} biss_pru_result;

#if defined(__GNUC__)
#define BISS_PRU_RESULT static inline __attribute__((warn_unused_result)) biss_pru_result
#else
#define BISS_PRU_RESULT static inline biss_pru_result
#endif

/* Bits of biss_pru_reading.flags, as in FLAGS of TIDEP0022. */
enum {
  BISS_PRU_SMA_FLAG = 0x01, /* the frame used the average of the sample points */
  BISS_PRU_PROC_TIME_ERR = 0x02,
  BISS_PRU_CMD_START_FLAG = 0x04, /* a control frame is being sent */
  BISS_PRU_POS_CRC_ERR = 0x08,
  BISS_PRU_CMD_CRC_ERR = 0x10, /* of the last control frame */
  BISS_PRU_NO_SLAVE_FLAG = 0x20
};

enum {
  BISS_PRU_TRIES = 4,          /* reads of a frame before BISS_PRU_TORN */
  BISS_PRU_ACCESS_FRAMES = 47, /* ends of frames from the write of a word to the end of its frame */
  BISS_PRU_CRC_BITS = 6,
  BISS_PRU_SETTLE_US = 40, /* from RUN to the first frame */
  BISS_PRU_OVERHEAD_US = 27,
  BISS_PRU_MARGIN_US = 100 /* of waiting */
};

/* ---- Types ----------------------------------------------------------------------------------- */

/* Supplied by the program. `context` comes back as it was given. */
typedef struct {
  void *context;
  /* One access of 32 bits at a byte offset of the master, 0x000 to 0x238. One that fails reads 0:
   * the calls then say BISS_PRU_NO_MASTER or BISS_PRU_NOT_RUNNING. */
  uint32_t (*read)(void *context, uint32_t offset);
  void (*write)(void *context, uint32_t offset, uint32_t value);
  /* Microseconds, counting up and wrapping at 2^32. */
  uint32_t (*now_us)(void *context);
} biss_pru_port;

/* Members that are 0 have the value in brackets. */
typedef struct {
  uint8_t position_bits; /* 1 to 63, with crc_err_war at most 63 */
  uint8_t crc_err_war;   /* bits of CRC, nE and nW: 8; 6: the encoder has no flags. At most 32 */
  uint8_t mhz;           /* MA: 1, 2, 5 or 10. The first frame has 1 */
  bool unchecked;        /* crc_err_war may be below 6: nothing is checked then. Not for a drive */
  bool interrupt;        /* irq_o rises with the end of each frame; biss_pru_position() clears it */
  uint32_t period_us;    /* between two triggers. [pin trigger_i only] */
  uint32_t period_clk;   /* the same in clocks, instead of period_us */
  uint32_t overhead_us;  /* from the last sample to the results [27] */
  uint16_t proc_time_max;  /* limit of the processing time in MA periods, up to 1023 [40 us] */
  uint32_t frame_limit_us; /* BISS_PRU_NO_FRAMES after so long without a frame, up to 60,000,000
                              [twice the longest frame or period, and 100 us]. Must be given if
                              frames come by the pin */
} biss_pru_config;

/* One frame. All members are of the same frame. */
typedef struct {
  uint64_t position; /* right aligned, as sent; 0 unless BISS_PRU_OK or BISS_PRU_ENCODER_ERROR */
  uint16_t frame;    /* FRAME_COUNT, wraps */
  uint16_t
      frames; /* frames that have ended since the last one that was told; 1: none is left out */
  uint16_t proc_time;  /* MA periods; over the limit: limit + 1 */
  uint16_t crc_errors; /* POS_CRC_ERRORS, since the start; wraps */
  uint8_t line_delay;  /* MA periods; with EXTRA_10 two more at 10 MHz. Without MA: of the frame
                          before */
  uint8_t flags;       /* BISS_PRU_..., as published */
  uint8_t crc;         /* POS_CRC as received: inverted */
  uint8_t raw_data;    /* the eight samples with the acknowledge, oldest in bit 7 */
  bool warning;        /* nW is 0. False without a position */
} biss_pru_reading;

/* The members are private. */
typedef struct {
  biss_pru_port port;
  uint32_t lengths;  /* register LENGTHS without FREQUENCY */
  uint32_t limit_us; /* frame_limit_us */
  bool interrupt;
  /* of biss_pru_position() */
  uint16_t told;    /* FRAME_COUNT of the last frame that was told */
  uint32_t seen_us; /* when FRAME_COUNT was last seen to have moved */
  /* of the calls for registers */
  uint8_t access; /* BISS_PRU_IDLE... */
  bool is_write;
  uint8_t data; /* of a write */
  uint16_t access_frame;
  uint32_t begin_us;
  uint32_t moved_us; /* when access_frame last moved */
} biss_pru_master;

enum {
  BISS_PRU_IDLE = 0,
  BISS_PRU_RUNS,     /* an access has begun */
  BISS_PRU_ABANDONED /* it was told as failed, and its control frame may go on */
};

/* ---- Control words --------------------------------------------------------------------------- */

/* CRC of `bits` bits of control data as sent: x^4 + x + 1, start 0, highest bit first, inverted. */
static inline uint32_t biss_pru_crc4(uint32_t value, uint8_t bits) {
  uint32_t crc = 0;
  for (; bits != 0; bits = (uint8_t)(bits - 1U)) {
    const uint32_t feed = (crc >> 3 ^ value >> (bits - 1U)) & 1U;
    crc = (crc << 1 & 0xFU) ^ (feed != 0 ? 3U : 0U);
  }
  return ~crc & 0xFU;
}

/* CTS = 1, three bits of ID, seven of address, CRC: in their places of CTRL_WORD. */
static inline uint32_t biss_pru_header(uint8_t id, uint8_t address) {
  const uint32_t header = 0x400U | (uint32_t)(id & 7U) << 7 | (address & 0x7FU);
  return header << 21 | biss_pru_crc4(header, 11) << 17;
}

/* CTRL_WORD that reads or writes a register: `id` 0 to 7, an encoder alone has 0; `address` 0 to
 * 127. START is not part of it. TIDEP0022, Table 7: the words of reads are equal to the printed
 * ones. Its write of 0x60 is printed 0x8C13C194, whose CRC and RWS are wrong, for 0x8C16C194. */
static inline uint32_t biss_pru_read_word(uint8_t id, uint8_t address) {
  return biss_pru_header(id, address) | 5UL << 14; /* RWS 101 */
}

static inline uint32_t biss_pru_write_word(uint8_t id, uint8_t address, uint8_t data) {
  return biss_pru_header(id, address) | 3UL << 14 /* RWS 011 */ | (uint32_t)data << 6 |
         biss_pru_crc4(data, 8) << 2;
}

/* ---- Registers of the master ----------------------------------------------------------------- */

static inline uint32_t biss_pru_get(const biss_pru_master *pru, uint32_t offset) {
  return pru->port.read(pru->port.context, offset);
}

static inline void biss_pru_put(const biss_pru_master *pru, uint32_t offset, uint32_t value) {
  pru->port.write(pru->port.context, offset, value);
}

static inline uint32_t biss_pru_now(const biss_pru_master *pru) {
  return pru->port.now_us(pru->port.context);
}

static inline uint16_t biss_pru_frame_count(const biss_pru_master *pru) {
  return (uint16_t)(biss_pru_get(pru, PRU_ADDR_FRAME_COUNT) & PRU_FRAME_COUNT_MASK);
}

static inline bool biss_pru_runs(const biss_pru_master *pru) {
  return biss_pru_get(pru, PRU_ADDR_RUN) == PRU_RUN_MASK;
}

/* What register STATUS says about the last frame. */
static inline biss_pru_result biss_pru_frame_result(uint32_t status) {
  if ((status & PRU_NO_SLAVE_FLAG_MASK) != 0) {
    return BISS_PRU_NO_SLAVE;
  }
  if ((status & PRU_PROC_TIME_ERR_MASK) != 0) {
    return BISS_PRU_PROCESSING;
  }
  return (status & PRU_POS_CRC_ERR_MASK) != 0 ? BISS_PRU_CRC : BISS_PRU_OK;
}

static inline bool biss_pru_legal_mhz(uint8_t mhz) {
  return mhz == 1 || mhz == 2 || mhz == 5 || mhz == 10;
}

static inline uint32_t biss_pru_at_mhz(const biss_pru_master *pru, uint8_t mhz) {
  return pru->lengths | (uint32_t)mhz << PRU_FREQUENCY_SHIFT;
}

/* ---- Start and stop -------------------------------------------------------------------------- */

/* The members that do not depend on the clock. */
static inline biss_pru_result biss_pru_check(const biss_pru_config *config) {
  if (config->crc_err_war > 32) {
    return BISS_PRU_BAD_CRC_ERR_WAR;
  }
  if (config->position_bits < 1 || config->position_bits + config->crc_err_war > 63) {
    return BISS_PRU_BAD_POSITION_BITS;
  }
  if (config->crc_err_war < BISS_PRU_CRC_BITS && !config->unchecked) {
    return BISS_PRU_UNCHECKED;
  }
  if (!biss_pru_legal_mhz(config->mhz)) {
    return BISS_PRU_BAD_FREQUENCY;
  }
  if ((config->period_us != 0 && config->period_clk != 0) ||
      config->period_clk > PRU_TRIGGER_PERIOD_MASK) {
    return BISS_PRU_BAD_PERIOD;
  }
  if (config->proc_time_max > PRU_PROC_TIME_MAX_MASK) {
    return BISS_PRU_BAD_PROC_TIME_MAX;
  }
  if (config->frame_limit_us > 60000000UL ||
      (config->frame_limit_us == 0 && config->period_us == 0 && config->period_clk == 0)) {
    return BISS_PRU_BAD_FRAME_LIMIT;
  }
  return BISS_PRU_OK;
}

/* Longest frame at 1 MHz in us, with the longest line delay that the master looks for. */
static inline uint32_t biss_pru_longest_us(const biss_pru_config *config, uint32_t overhead_us) {
  const uint32_t bits = 3U + config->position_bits + config->crc_err_war;
  const uint32_t limit = config->proc_time_max > 40 ? config->proc_time_max : 40U;
  return 2U + 2U * bits + limit + overhead_us;
}

/* The end of the first frame after RUN. */
static inline biss_pru_result biss_pru_first_frame(const biss_pru_master *pru, uint32_t wait_us) {
  const uint32_t begin = biss_pru_now(pru);
  for (;;) {
    /* The time comes first: a thread that sleeps here must not miss a frame. */
    const uint32_t now = biss_pru_now(pru);
    if (biss_pru_frame_count(pru) != pru->told) {
      return biss_pru_frame_result(biss_pru_get(pru, PRU_ADDR_STATUS));
    }
    if (!biss_pru_runs(pru)) {
      return BISS_PRU_NOT_RUNNING;
    }
    if (now - begin > wait_us) {
      return BISS_PRU_NO_FRAMES;
    }
  }
}

/* Ends frames at once, MA = 1. An access of a register ends with them; an encoder whose control
 * frame was complete has done what it said. */
static inline void biss_pru_stop(biss_pru_master *pru) {
  biss_pru_put(pru, PRU_ADDR_RUN, 0);
  biss_pru_put(pru, PRU_ADDR_CTRL, 0);
  pru->access = BISS_PRU_IDLE;
}

/* Clocks of a microsecond: 200 or 80. 0: no master that these calls know. */
static inline uint32_t biss_pru_clk_per_us(const biss_pru_master *pru) {
  uint32_t features = 0;
  if (biss_pru_get(pru, PRU_ADDR_ID) != PRU_RESET_ID) {
    return 0;
  }
  features = biss_pru_get(pru, PRU_ADDR_FEATURES);
  if ((features & PRU_SUCCESSOR_MASK) != 0) {
    return 0;
  }
  return (features & PRU_CLOCK_80_MASK) != 0 ? 80U : 200U;
}

/* What the calls need of the configuration. `longest_us`: biss_pru_longest_us(). */
static inline void biss_pru_take_config(biss_pru_master *pru, const biss_pru_config *config,
                                        uint32_t clk_per_us, uint32_t longest_us) {
  const uint32_t period_us = config->period_us + config->period_clk / clk_per_us;
  pru->interrupt = config->interrupt;
  pru->lengths = (uint32_t)config->crc_err_war << PRU_CRC_ERR_WAR_SHIFT | config->position_bits;
  pru->limit_us =
      config->frame_limit_us != 0
          ? config->frame_limit_us
          : 2U * (period_us > longest_us ? period_us : longest_us) + (uint32_t)BISS_PRU_MARGIN_US;
}

/* The registers of the stopped master. */
static inline void biss_pru_write_config(const biss_pru_master *pru, const biss_pru_config *config,
                                         uint32_t clk_per_us, uint32_t overhead_us) {
  uint32_t enables = 0;
  biss_pru_put(pru, PRU_ADDR_LENGTHS, biss_pru_at_mhz(pru, config->mhz));
  biss_pru_put(pru, PRU_ADDR_TRIGGER_PERIOD, config->period_us * clk_per_us + config->period_clk);
  biss_pru_put(pru, PRU_ADDR_OVERHEAD, overhead_us * clk_per_us);
  biss_pru_put(pru, PRU_ADDR_PROC_TIME_MAX, config->proc_time_max);
  biss_pru_put(pru, PRU_ADDR_IRQ_STATUS, PRU_WMASK_IRQ_STATUS);
  enables = biss_pru_get(pru, PRU_ADDR_IRQ_ENABLE) & (uint32_t)~PRU_FRAME_ENDED_ENABLE_MASK;
  enables |= config->interrupt ? (uint32_t)PRU_FRAME_ENDED_ENABLE_MASK : 0U;
  biss_pru_put(pru, PRU_ADDR_IRQ_ENABLE, enables);
}

/* Stops the master, configures it, starts it, and waits for the end of the first frame, which has
 * 1 MHz: at most 40 us, the longest frame and 100 us. The frames after it have config->mhz.
 * BISS_PRU_OK: the first frame is good.
 * BISS_PRU_NO_SLAVE, BISS_PRU_CRC, BISS_PRU_PROCESSING: it is not. The master runs nevertheless and
 * tries again with each trigger, so an encoder may come later.
 * BISS_PRU_NO_FRAMES: it has not ended; the master is stopped. Others: it does not run. */
BISS_PRU_RESULT biss_pru_start(biss_pru_master *pru, const biss_pru_port *port,
                               const biss_pru_config *config) {
  const uint32_t overhead_us =
      config->overhead_us != 0 ? config->overhead_us : (uint32_t)BISS_PRU_OVERHEAD_US;
  biss_pru_result result = biss_pru_check(config);
  uint32_t longest_us = 0;
  uint32_t clk_per_us = 0;
  if (port->read == 0 || port->write == 0 || port->now_us == 0) {
    return BISS_PRU_BAD_PORT;
  }
  if (result != BISS_PRU_OK) {
    return result;
  }
  pru->port = *port;
  clk_per_us = biss_pru_clk_per_us(pru);
  if (clk_per_us == 0) {
    return BISS_PRU_NO_MASTER;
  }
  if (config->period_us > PRU_TRIGGER_PERIOD_MASK / clk_per_us) {
    return BISS_PRU_BAD_PERIOD;
  }
  if (overhead_us > PRU_OVERHEAD_MASK / clk_per_us) {
    return BISS_PRU_BAD_OVERHEAD;
  }
  longest_us = biss_pru_longest_us(config, overhead_us);
  biss_pru_take_config(pru, config, clk_per_us, longest_us);
  biss_pru_stop(pru);
  biss_pru_write_config(pru, config, clk_per_us, overhead_us);
  pru->told = biss_pru_frame_count(pru);
  biss_pru_put(pru, PRU_ADDR_RUN, PRU_RUN_MASK);
  result = biss_pru_first_frame(pru, BISS_PRU_SETTLE_US + longest_us + BISS_PRU_MARGIN_US);
  if (result == BISS_PRU_NO_FRAMES) {
    biss_pru_stop(pru);
  }
  return result;
}

/* MA of the next frames: `mhz` 1, 2, 5 or 10. The master takes it with the end of a frame, for the
 * frame after it. *first_frame becomes the FRAME_COUNT of the first reading that surely has it; it
 * may be null. A change turns the average off for four frames.
 * BISS_PRU_BAD_FREQUENCY, BISS_PRU_NOT_RUNNING: nothing was written. */
BISS_PRU_RESULT biss_pru_set_frequency(biss_pru_master *pru, uint8_t mhz, uint16_t *first_frame) {
  if (!biss_pru_legal_mhz(mhz)) {
    return BISS_PRU_BAD_FREQUENCY;
  }
  if (!biss_pru_runs(pru)) {
    return BISS_PRU_NOT_RUNNING;
  }
  biss_pru_put(pru, PRU_ADDR_LENGTHS, biss_pru_at_mhz(pru, mhz));
  if (first_frame != 0) {
    *first_frame = (uint16_t)(biss_pru_frame_count(pru) + 2U);
  }
  return BISS_PRU_OK;
}

/* ---- Positions ------------------------------------------------------------------------------- */

/* Reads the memory once. Returns what RUN was. */
static inline bool biss_pru_read_memory(const biss_pru_master *pru, biss_pru_reading *reading,
                                        uint32_t *signals) {
  const uint32_t status = biss_pru_get(pru, PRU_ADDR_STATUS);
  const uint32_t received = biss_pru_get(pru, PRU_ADDR_RECEIVED);
  const uint32_t times = biss_pru_get(pru, PRU_ADDR_TIMES);
  const uint32_t high = biss_pru_get(pru, PRU_ADDR_POS_HI); /* copies POS_LO */
  const uint32_t low = biss_pru_get(pru, PRU_ADDR_POS_LO);
  *signals = biss_pru_get(pru, PRU_ADDR_SIGNALS);
  reading->position = (uint64_t)high << 32 | low;
  reading->flags = (uint8_t)(status >> PRU_SMA_FLAG_SHIFT);
  reading->crc_errors = (uint16_t)(status & PRU_POS_CRC_ERRORS_MASK);
  reading->crc = (uint8_t)(received & PRU_POS_CRC_MASK);
  reading->raw_data = (uint8_t)(received >> PRU_RAW_DATA_SHIFT);
  reading->proc_time = (uint16_t)(times & PRU_PROC_TIME_MASK);
  reading->line_delay = (uint8_t)(times >> PRU_LINE_DELAY_SHIFT);
  return biss_pru_runs(pru);
}

/* Reads what the frame has brought whose FRAME_COUNT is reading->frame, or a later one that ends
 * meanwhile. All results change in one clock: they are of one frame if FRAME_COUNT has not moved.
 */
static inline biss_pru_result biss_pru_read_frame(const biss_pru_master *pru,
                                                  biss_pru_reading *reading, uint32_t *signals) {
  uint8_t tries = BISS_PRU_TRIES;
  for (;;) {
    const uint16_t count = reading->frame;
    if (!biss_pru_read_memory(pru, reading, signals)) {
      return BISS_PRU_NOT_RUNNING;
    }
    reading->frame = biss_pru_frame_count(pru);
    if (reading->frame == count) {
      return BISS_PRU_OK;
    }
    tries = (uint8_t)(tries - 1U);
    if (tries == 0) {
      return BISS_PRU_TORN;
    }
  }
}

/* The last frame, if it was not told yet. Each frame is told once, whatever it brought. Never
 * waits: 10 accesses of the port, 8 more for each frame that ends meanwhile, 3 without a new frame.
 * BISS_PRU_OK: a new position. BISS_PRU_ENCODER_ERROR: what the encoder has sent, for a message.
 * BISS_PRU_NO_SLAVE, BISS_PRU_CRC, BISS_PRU_PROCESSING: *reading has the others of its members.
 * BISS_PRU_NO_NEW_FRAME, BISS_PRU_NO_FRAMES, BISS_PRU_NOT_RUNNING, BISS_PRU_TORN: *reading keeps
 * its values. A new position may be as old as the call before, or the start. FRAME_COUNT has 16
 * bits: after exactly 65,536 frames a new one looks like none. */
BISS_PRU_RESULT biss_pru_position(biss_pru_master *pru, biss_pru_reading *reading) {
  const uint32_t now = biss_pru_now(pru); /* before FRAME_COUNT, as in biss_pru_first_frame() */
  biss_pru_reading next;
  uint32_t signals = 0;
  biss_pru_result result = BISS_PRU_OK;
  if (pru->interrupt) {
    biss_pru_put(pru, PRU_ADDR_IRQ_STATUS, PRU_FRAME_ENDED_MASK);
  }
  next.frame = biss_pru_frame_count(pru);
  if (next.frame == pru->told) {
    if (!biss_pru_runs(pru)) {
      return BISS_PRU_NOT_RUNNING;
    }
    return now - pru->seen_us > pru->limit_us ? BISS_PRU_NO_FRAMES : BISS_PRU_NO_NEW_FRAME;
  }
  pru->seen_us = now;
  result = biss_pru_read_frame(pru, &next, &signals);
  if (result != BISS_PRU_OK) {
    return result;
  }
  next.frames = (uint16_t)(next.frame - pru->told);
  pru->told = next.frame;
  result = biss_pru_frame_result((uint32_t)next.flags << PRU_SMA_FLAG_SHIFT);
  /* POS and SIGNALS are those of the last good frame: of this one, if it is good. */
  next.warning = result == BISS_PRU_OK && (signals & PRU_NW_MASK) == 0;
  if (result != BISS_PRU_OK) {
    next.position = 0;
  } else if ((signals & PRU_NE_MASK) == 0) {
    result = BISS_PRU_ENCODER_ERROR;
  }
  *reading = next;
  return result;
}

/* ---- Registers of the encoder ---------------------------------------------------------------- */

/* Nobody runs a control frame. */
static inline biss_pru_result biss_pru_access_free(const biss_pru_master *pru) {
  if (pru->access == BISS_PRU_RUNS) {
    return BISS_PRU_BUSY;
  }
  if (!biss_pru_runs(pru)) {
    return BISS_PRU_NOT_RUNNING;
  }
  if (biss_pru_get(pru, PRU_ADDR_CTRL) != 0 ||
      (biss_pru_get(pru, PRU_ADDR_STATUS) & PRU_CMD_START_FLAG_MASK) != 0) {
    return BISS_PRU_BUSY;
  }
  /* The 14 frames before START show nowhere. Only the end of an abandoned control frame is sure. */
  if (pru->access == BISS_PRU_ABANDONED &&
      (biss_pru_get(pru, PRU_ADDR_IRQ_STATUS) & PRU_CTRL_ENDED_MASK) == 0) {
    return BISS_PRU_BUSY;
  }
  return BISS_PRU_OK;
}

static inline biss_pru_result biss_pru_begin(biss_pru_master *pru, uint8_t id, uint8_t address,
                                             uint32_t word) {
  biss_pru_result result = BISS_PRU_OK;
  if (id > 7 || address > 127) {
    return BISS_PRU_BAD_REGISTER;
  }
  result = biss_pru_access_free(pru);
  if (result != BISS_PRU_OK) {
    return result;
  }
  pru->access = BISS_PRU_RUNS;
  pru->begin_us = biss_pru_now(pru);
  pru->moved_us = pru->begin_us;
  pru->access_frame = biss_pru_frame_count(pru);
  biss_pru_put(pru, PRU_ADDR_IRQ_STATUS, PRU_CTRL_ENDED_MASK);
  biss_pru_put(pru, PRU_ADDR_CTRL, word); /* all bytes: byte 7 of the memory arms the word */
  return BISS_PRU_OK;
}

/* Begins to read or write one register of the encoder: `id` 0 to 7, an encoder alone has 0;
 * `address` 0 to 127. Then biss_pru_poll().
 * BISS_PRU_BAD_REGISTER, BISS_PRU_BUSY, BISS_PRU_NOT_RUNNING: nothing was written. */
BISS_PRU_RESULT biss_pru_begin_read(biss_pru_master *pru, uint8_t id, uint8_t address) {
  const biss_pru_result result = biss_pru_begin(pru, id, address, biss_pru_read_word(id, address));
  if (result == BISS_PRU_OK) {
    pru->is_write = false;
  }
  return result;
}

BISS_PRU_RESULT biss_pru_begin_write(biss_pru_master *pru, uint8_t id, uint8_t address,
                                     uint8_t data) {
  const biss_pru_result result =
      biss_pru_begin(pru, id, address, biss_pru_write_word(id, address, data));
  if (result == BISS_PRU_OK) {
    pru->is_write = true;
    pru->data = data;
  }
  return result;
}

/* The end of a control frame: its results stay until the next one. */
static inline biss_pru_result biss_pru_answer(biss_pru_master *pru, uint8_t *data) {
  const uint32_t result = biss_pru_get(pru, PRU_ADDR_CTRL_RESULT) & PRU_CTRL_RESULT_MASK;
  const uint32_t status = biss_pru_get(pru, PRU_ADDR_STATUS);
  const uint32_t received = biss_pru_get(pru, PRU_ADDR_RECEIVED);
  const uint32_t crc = (uint32_t)((received & PRU_CTRL_CRC_MASK) >> PRU_CTRL_CRC_SHIFT);
  pru->access = BISS_PRU_IDLE;
  if (result == 0 && crc == 0) {
    return (status & PRU_NO_SLAVE_FLAG_MASK) != 0 ? BISS_PRU_NO_SLAVE : BISS_PRU_NO_ANSWER;
  }
  if ((status & PRU_CMD_CRC_ERR_MASK) != 0 || crc != biss_pru_crc4(result, 8)) {
    return BISS_PRU_BAD_ANSWER;
  }
  if (pru->is_write && result != pru->data) {
    return BISS_PRU_BAD_ECHO;
  }
  *data = (uint8_t)result;
  return BISS_PRU_OK;
}

/* The time is over. A word that still waits is taken back. */
static inline biss_pru_result biss_pru_give_up(biss_pru_master *pru, uint32_t now) {
  const uint16_t count = biss_pru_frame_count(pru);
  pru->access = BISS_PRU_ABANDONED;
  if (biss_pru_get(pru, PRU_ADDR_CTRL) != 0) {
    biss_pru_put(pru, PRU_ADDR_CTRL, 0);
    if (biss_pru_frame_count(pru) == count) {
      pru->access = BISS_PRU_IDLE; /* no frame has ended, so none has taken the word */
    }
  }
  if (now - pru->moved_us > pru->limit_us) {
    return BISS_PRU_NO_FRAMES;
  }
  return (biss_pru_get(pru, PRU_ADDR_STATUS) & PRU_NO_SLAVE_FLAG_MASK) != 0 ? BISS_PRU_NO_SLAVE
                                                                            : BISS_PRU_TIMEOUT;
}

/* The access that has begun. Never waits: 3 to 8 accesses of the port. All codes but
 * BISS_PRU_PENDING end it.
 * BISS_PRU_OK: *data is the register's value; of a write, what the encoder has sent back, which is
 * the written byte. Nothing in the published format confirms that the encoder has stored it, or
 * that its R and W bits came back: read the register if it matters.
 * BISS_PRU_NO_ANSWER, BISS_PRU_BAD_ANSWER, BISS_PRU_BAD_ECHO, BISS_PRU_NO_SLAVE: a write may have
 * been done or not. An encoder that needs longer than one frame for its start bit gives one of the
 * first two: the published format does not wait for it.
 * BISS_PRU_NO_FRAMES, BISS_PRU_TIMEOUT, and BISS_PRU_NO_SLAVE while SL is 0: only after 48 times
 * frame_limit_us. The control frame may still go on with the next frames, and a write be done;
 * BISS_PRU_BUSY until it has ended, or until biss_pru_stop() and biss_pru_start(). If frames come
 * back in the very instant of this call, only the latter may end it. BISS_PRU_NOT_RUNNING: the
 * master was stopped or reset, so the encoder saw all or a part of it. BISS_PRU_NO_ACCESS: none has
 * begun. */
BISS_PRU_RESULT biss_pru_poll(biss_pru_master *pru, uint8_t *data) {
  const uint32_t now = biss_pru_now(pru);
  uint16_t count = 0;
  if (pru->access != BISS_PRU_RUNS) {
    return BISS_PRU_NO_ACCESS;
  }
  if (!biss_pru_runs(pru)) {
    pru->access = BISS_PRU_IDLE;
    return BISS_PRU_NOT_RUNNING;
  }
  if ((biss_pru_get(pru, PRU_ADDR_IRQ_STATUS) & PRU_CTRL_ENDED_MASK) != 0) {
    return biss_pru_answer(pru, data);
  }
  count = biss_pru_frame_count(pru);
  if (count != pru->access_frame) {
    pru->access_frame = count;
    pru->moved_us = now;
  }
  if (now - pru->begin_us <= (BISS_PRU_ACCESS_FRAMES + 1U) * pru->limit_us) {
    return BISS_PRU_PENDING;
  }
  return biss_pru_give_up(pru, now);
}

/* The same, waiting for the end: 47 frames. Codes as of biss_pru_begin_... and biss_pru_poll(). */
BISS_PRU_RESULT biss_pru_wait(biss_pru_master *pru, uint8_t *data) {
  biss_pru_result result = BISS_PRU_PENDING;
  while (result == BISS_PRU_PENDING) {
    result = biss_pru_poll(pru, data);
  }
  return result;
}

BISS_PRU_RESULT biss_pru_read_register(biss_pru_master *pru, uint8_t id, uint8_t address,
                                       uint8_t *data) {
  const biss_pru_result result = biss_pru_begin_read(pru, id, address);
  return result == BISS_PRU_OK ? biss_pru_wait(pru, data) : result;
}

BISS_PRU_RESULT biss_pru_write_register(biss_pru_master *pru, uint8_t id, uint8_t address,
                                        uint8_t data) {
  uint8_t echo = 0;
  const biss_pru_result result = biss_pru_begin_write(pru, id, address, data);
  return result == BISS_PRU_OK ? biss_pru_wait(pru, &echo) : result;
}

/* ---- Messages -------------------------------------------------------------------------------- */

/* A few words for each result; of a wrong argument its name. */
static inline const char *biss_pru_text(biss_pru_result result) {
  switch (result) {
    case BISS_PRU_OK:
      return "done";
    case BISS_PRU_NO_NEW_FRAME:
      return "no new frame";
    case BISS_PRU_PENDING:
      return "the access goes on";
    case BISS_PRU_NO_SLAVE:
      return "no encoder";
    case BISS_PRU_CRC:
      return "wrong CRC";
    case BISS_PRU_PROCESSING:
      return "processing time over the limit";
    case BISS_PRU_ENCODER_ERROR:
      return "the encoder reports an error";
    case BISS_PRU_NOT_RUNNING:
      return "the master does not run";
    case BISS_PRU_NO_FRAMES:
      return "no frames";
    case BISS_PRU_TORN:
      return "frames end faster than they are read";
    case BISS_PRU_NO_MASTER:
      return "no biss_pru";
    case BISS_PRU_BUSY:
      return "another access";
    case BISS_PRU_NO_ACCESS:
      return "no access has begun";
    case BISS_PRU_NO_ANSWER:
      return "no answer";
    case BISS_PRU_BAD_ANSWER:
      return "wrong CRC of the answer";
    case BISS_PRU_BAD_ECHO:
      return "another byte came back";
    case BISS_PRU_TIMEOUT:
      return "the control frame has not ended";
    case BISS_PRU_BAD_PORT:
      return "port";
    case BISS_PRU_BAD_POSITION_BITS:
      return "position_bits";
    case BISS_PRU_BAD_CRC_ERR_WAR:
      return "crc_err_war";
    case BISS_PRU_UNCHECKED:
      return "fewer than 6 bits of CRC";
    case BISS_PRU_BAD_FREQUENCY:
      return "mhz";
    case BISS_PRU_BAD_PERIOD:
      return "period_us, period_clk";
    case BISS_PRU_BAD_OVERHEAD:
      return "overhead_us";
    case BISS_PRU_BAD_PROC_TIME_MAX:
      return "proc_time_max";
    case BISS_PRU_BAD_FRAME_LIMIT:
      return "frame_limit_us";
    case BISS_PRU_BAD_REGISTER:
      return "ID or address";
    default:
      return "not a result";
  }
}

#ifdef __cplusplus
}
#endif

#endif /* BISS_PRU_H_ */
