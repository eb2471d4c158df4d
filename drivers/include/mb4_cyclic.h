/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The read path of a control loop, in C99 and C++: positions of one slave from automatic frames.
 * Automatic::poll_slave() is a loop over it. A program in C needs this header, mb4.h and the
 * generated mb4_regs.h, and no C++ compiler. There is no heap, static data, callback or clock.
 *
 * A read is one or more plans. A plan holds SPI frames; the caller makes them, by DMA or otherwise:
 *
 *   mb4_cyclic_plan(&read, &plan, MB4_WITH_ALL);      // begins a read
 *   do {
 *     bool done = ...;                                // plan.size[i] bytes from plan.tx[i] to
 *                                                     // plan.rx[i], NCS low for each frame
 *     code = mb4_cyclic_finish(&read, &plan, done, now_us, MB4_WITH_ALL);
 *   } while (code == MB4_MORE);
 *   if (code == MB4_OK) { read.reading ... }
 *
 * With `chain` set, a read is one plan of four frames (table 69 of the datasheet): 0x07 HOLDBANK,
 * 0x09 or 0x03 data, 0x05 status, 0x02 SVALID = 0 and HOLDBANK = 0. Only a bad word needs another
 * plan. Without `chain` the 0x02 is a plan of its own, and a bad word needs one frame more.
 *
 * No function may be interrupted by another one on the same object.
 */
#ifndef MB4_CYCLIC_H_
#define MB4_CYCLIC_H_

#include <stdbool.h>
#include <stdint.h>

#include "mb4.h"

/* The same generated register map in either language. */
#ifdef __cplusplus
#include "mb4_regs.hpp"
enum {
  MB4_CYCLIC_AGS = mb4::regs::AGS::encode<1>(),
  MB4_CYCLIC_HOLD = mb4::regs::HOLDBANK::encode<1>() | MB4_CYCLIC_AGS,
  MB4_CYCLIC_SCDERR = mb4::regs::nSCDERR::kMask,
  MB4_CYCLIC_AGSERR = mb4::regs::nAGSERR::kMask,
  MB4_CYCLIC_REGEND = mb4::regs::REGEND::kMask,
  MB4_CYCLIC_CONST0 = mb4::regs::kConstStatus0,
  MB4_CYCLIC_CONST1 = mb4::regs::kConstSvalidLo,
  MB4_CYCLIC_SVALID = mb4::regs::kAddrSvalidLo,
  MB4_CYCLIC_WRITE = mb4::regs::kSpiOpcodeWriteRegisters,
  MB4_CYCLIC_READ = mb4::regs::kSpiOpcodeReadRegisters,
  MB4_CYCLIC_READ0 = mb4::regs::kSpiOpcodeReadRegisters0,
  MB4_CYCLIC_STATUS = mb4::regs::kSpiOpcodeReadStatus,
  MB4_CYCLIC_INSTRUCT = mb4::regs::kSpiOpcodeWriteInstruction,
  MB4_CYCLIC_LINES = mb4::regs::SL1::kAddress - mb4::regs::kAddrStatus0 + 1
};
#else
#include "mb4_regs.h"
enum {
  MB4_CYCLIC_AGS = MB4_AGS_MASK,
  MB4_CYCLIC_HOLD = MB4_HOLDBANK_MASK | MB4_AGS_MASK,
  MB4_CYCLIC_SCDERR = MB4_NSCDERR_MASK,
  MB4_CYCLIC_AGSERR = MB4_NAGSERR_MASK,
  MB4_CYCLIC_REGEND = MB4_REGEND_MASK,
  MB4_CYCLIC_CONST0 = MB4_CONST_STATUS0,
  MB4_CYCLIC_CONST1 = MB4_CONST_SVALID_LO,
  MB4_CYCLIC_SVALID = MB4_ADDR_SVALID_LO,
  MB4_CYCLIC_WRITE = MB4_SPI_OPCODE_WRITE_REGISTERS,
  MB4_CYCLIC_READ = MB4_SPI_OPCODE_READ_REGISTERS,
  MB4_CYCLIC_READ0 = MB4_SPI_OPCODE_READ_REGISTERS0,
  MB4_CYCLIC_STATUS = MB4_SPI_OPCODE_READ_STATUS,
  MB4_CYCLIC_INSTRUCT = MB4_SPI_OPCODE_WRITE_INSTRUCTION,
  MB4_CYCLIC_LINES = MB4_SL_ADDR(1U) - MB4_ADDR_STATUS0 + 1
};
#endif

/* Functions that are called from several places and stay functions: small code counts more here. */
#if defined(__GNUC__)
#define MB4_APART static __attribute__((noinline, unused))
#else
#define MB4_APART static inline
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Plans ----------------------------------------------------------------------------------- */

enum {
  MB4_PLAN_FRAMES = 4,
  MB4_PLAN_FRAME_BYTES = 12, /* longest frame: 10 bytes, rounded up to whole words */
  MB4_MORE = 255             /* of mb4_cyclic_finish(): make the frames of the plan */
};

/* SPI frames to make one after the other, each with NCS low. Every frame begins at a whole word.
 * Place the object where DMA reaches it. Write only rx. */
typedef struct {
  uint32_t pause_us; /* the next plan must not begin earlier than this after the last frame */
  uint8_t frames;    /* 1..MB4_PLAN_FRAMES */
  uint8_t size[MB4_PLAN_FRAMES]; /* bytes of each frame, 2..10 */
  uint8_t unused[3];
  uint8_t tx[MB4_PLAN_FRAMES][MB4_PLAN_FRAME_BYTES];
  uint8_t rx[MB4_PLAN_FRAMES][MB4_PLAN_FRAME_BYTES];
} mb4_plan;

/* Adds a frame of `size` bytes that begins with `first` and `second`; the rest is `filler`. */
static inline void mb4_plan_add(mb4_plan *plan, uint8_t size, uint8_t first, uint8_t second,
                                uint8_t filler) {
  uint8_t *tx = plan->tx[plan->frames];
  uint8_t i = 0;
  plan->size[plan->frames] = size;
  ++plan->frames;
  tx[0] = first;
  tx[1] = second;
  for (i = 2; i < size; ++i) {
    tx[i] = filler;
  }
}

/* False: the frame writes, so what comes back need not be stored. */
static inline bool mb4_plan_reads(const mb4_plan *plan, uint8_t frame) {
  return plan->tx[frame][0] != MB4_CYCLIC_WRITE && plan->tx[frame][0] != MB4_CYCLIC_INSTRUCT;
}

/* ---- The word of one slave ------------------------------------------------------------------- */

/* What SCDATAx of one slave holds. mb4_word_set() works it out. */
typedef struct {
  uint32_t polynomial;   /* left aligned, without its highest bit */
  uint32_t start;        /* left aligned */
  const uint32_t *table; /* of mb4_crc_table(); null: the CRC goes bit by bit */
  uint8_t slave;         /* 1..8 */
  uint8_t bits;          /* 1..64, flags included */
  uint8_t bytes;         /* to read: 1..8 */
  uint8_t crc_bits;      /* of the stored CRC; 0: none is stored */
  bool flags;            /* the last two bits are nE, nW */
  bool gray;             /* the chip has converted Gray code */
} mb4_word;

/* `slave` 1..8. The members of `config` must be those that the chip has (mb4_validate()).
 * `spi_check`: MB4_SPI_CHECK_..., as configured. */
static inline void mb4_word_set(mb4_word *word, uint8_t slave, const mb4_slave_config *config,
                                uint8_t spi_check) {
  const uint8_t data_bytes = (uint8_t)((config->data_bits + 7U) / 8U);
  uint8_t width = 0;
  while (config->crc_polynomial >> 1 >> width != 0) {
    ++width;
  }
  word->slave = slave;
  word->bits = config->data_bits;
  word->bytes = data_bytes;
  word->crc_bits = 0;
  word->polynomial = 0;
  word->start = 0;
  word->table = 0;
  /* The CRC takes the top byte(s) of SCDATAx if the data leaves them free (page 26). */
  if (spi_check != MB4_SPI_CHECK_OFF && width != 0 && data_bytes + (width > 8 ? 2 : 1) <= 8) {
    word->bytes = 8;
    word->crc_bits = width;
    word->polynomial = config->crc_polynomial << (32 - width);
    word->start = (uint32_t)config->crc_start << (32 - width);
  }
  word->flags = config->flags == MB4_FLAGS_ERROR_WARNING;
  word->gray = config->gray;
}

/* Parts of the read path that a build may leave out: the last argument of mb4_cyclic_finish(). A
 * constant lets the compiler drop the rest. What is left out must not be configured. */
enum {
  MB4_WITH_LONG = 1,     /* data of more than 32 bits */
  MB4_WITH_GRAY = 2,     /* SSI with Gray code */
  MB4_WITH_FULL = 4,     /* MB4_SPI_CHECK_FULL */
  MB4_WITH_UNHELD = 8,   /* without HOLDBANK beside a register access */
  MB4_WITH_SEVERAL = 16, /* other slaves deliver data too */
  MB4_WITH_ALL = 31,
  MB4_WITH_TABLE = 32 /* CRC by word->table, four bits a step, where it is not null */
};

/* `steps` (1..32) bits, of a CRC that is left aligned and has the data added to it. */
static inline uint32_t mb4_crc_steps(uint32_t crc, uint32_t polynomial, uint8_t steps) {
  do {
    const uint32_t top = crc & 0x80000000U;
    crc <<= 1;
    if (top != 0) {
      crc ^= polynomial;
    }
  } while (--steps != 0);
  return crc;
}

/* Fills the caller's table of 16 words for MB4_WITH_TABLE; 64 bytes for half the time of a read. */
static inline void mb4_crc_table(mb4_word *word, uint32_t *table) {
  uint8_t i = 0;
  for (i = 0; i < 16; ++i) {
    table[i] = mb4_crc_steps((uint32_t)i << 28, word->polynomial, 4);
  }
  word->table = table;
}

/* As mb4_crc_steps(), by the table if there is one. */
static inline uint32_t mb4_crc_add(const mb4_word *word, uint32_t crc, uint8_t steps,
                                   uint8_t with) {
  if ((with & MB4_WITH_TABLE) != 0 && word->table != 0) {
    if ((steps & 3U) != 0) {
      crc = mb4_crc_steps(crc, word->polynomial, steps & 3U);
    }
    for (; steps >= 4; steps = (uint8_t)(steps - 4)) {
      crc = crc << 4 ^ word->table[crc >> 28];
    }
    return crc;
  }
  return mb4_crc_steps(crc, word->polynomial, steps);
}

/* The CRC of the data bits `low`, `high` as they were on the line. word->crc_bits is not 0. */
MB4_APART uint16_t mb4_word_crc(const mb4_word *word, uint32_t low, uint32_t high, uint8_t with) {
  uint32_t crc = word->start;
  uint8_t bits = word->bits;
  if ((with & MB4_WITH_GRAY) != 0 && word->gray) {
    low ^= low >> 1 | high << 31;
    high ^= high >> 1;
  }
  if ((with & MB4_WITH_LONG) != 0 && bits > 32) {
    crc = mb4_crc_add(word, crc ^ high << (64 - bits), (uint8_t)(bits - 32), with);
    bits = 32;
  }
  crc = mb4_crc_add(word, crc ^ low << (32 - bits), bits, with);
  return (uint16_t)(crc >> (32 - word->crc_bits));
}

/* ---- Reading --------------------------------------------------------------------------------- */

/* What all slaves of one chip share. */
typedef struct {
  uint32_t news_us;    /* when the last frame was seen; set it when frames are started */
  uint32_t omitted_us; /* longest time without a frame after the chip has left some out */
  uint32_t silent_us;  /* longest time without a frame; 0: only the caller knows */
  uint8_t lines;       /* bits of 0xF8 that are 1 while the lines are idle: SL1, SL2 */
  bool several;        /* other slaves deliver data too */
  bool held;           /* a read has ended without the release of the bank: the next one begins with
                          it; clear it when frames are started */
  uint8_t taken;       /* slaves (bit 0 is slave 1) of which a read has taken a good word */
  uint32_t good_us[MB4_SLAVES]; /* when; set them when frames are started */
} mb4_watch;

/* One read. Set the object to zero once; then the members up to `chain` are the caller's. The
 * frames of a chain stay in the plan, so that the next read need not write them again: clear
 * `built` when the plan's memory, one of these members or `*word` has changed. */
typedef struct {
  const mb4_word *word;
  mb4_watch *watch;
  uint8_t spi_check; /* MB4_SPI_CHECK_..., as configured */
  bool unheld;       /* a register access runs, and the chip allows no HOLDBANK beside it */
  bool access;       /* a register access has begun, and its end has not been seen */
  bool chain;        /* one plan of four frames; not with MB4_SPI_CHECK_FULL, not unheld */
  /* Results. */
  bool bad;     /* a new word came with a wrong CRC; with MB4_OK a good one has followed */
  bool running; /* with `access`: REGEND = 0 in the last status, it runs */
  uint8_t status[MB4_STATUS_BYTES]; /* the last one */
  /* Private. */
  uint8_t stage;
  uint8_t code;  /* the result, once it is known */
  bool fresh;    /* SVALID was 1 before the data was read */
  bool again;    /* the second try, or the second reading, runs */
  bool unproven; /* a bad frame, and no stored CRC tells whose */
  /* The caller's again. */
  const mb4_plan *built; /* holds the frames of the chain; null: none */
  /* Private: SCDATAx. */
  uint32_t low;
  uint32_t high;
  /* Result. */
  mb4_reading reading; /* valid with MB4_OK */
} mb4_cyclic;

enum {
  MB4_STAGE_DATA,   /* HOLDBANK, data, status; in a chain also the end */
  MB4_STAGE_LOOK,   /* FULL: HOLDBANK, status; unheld: status, with FULL twice */
  MB4_STAGE_SECOND, /* FULL: data, status */
  MB4_STAGE_UNHELD, /* SVALID = 0, data, status; then, if need be, data and status again */
  MB4_STAGE_CLEAR,  /* FULL: data again, SVALID = 0, status; then, if need be, status again */
  MB4_STAGE_END,    /* the bank is released; the result is known */
  MB4_STAGE_LINES,  /* are the lines idle? */
  MB4_STAGE_FREE    /* the bank was still held: release, SVALID = 0 */
};

static inline void mb4_cyclic_add_data(const mb4_cyclic *read, mb4_plan *plan) {
  /* With FULL the filler is what a disturbed opcode would write: not zeros, which may pass. */
  const uint8_t filler = read->spi_check == MB4_SPI_CHECK_FULL ? 0x5A : 0;
  const mb4_word *word = read->word;
  if (word->slave == 1) { /* one byte shorter, and at any SCLK (I204) */
    mb4_plan_add(plan, (uint8_t)(word->bytes + 1), MB4_CYCLIC_READ0, filler, filler);
  } else {
    mb4_plan_add(plan, (uint8_t)(word->bytes + 2), MB4_CYCLIC_READ, (uint8_t)(8 * word->slave - 8),
                 filler);
  }
}

MB4_APART void mb4_cyclic_add_status(mb4_plan *plan) {
  /* A bus that stores nothing must not turn an old answer into a new one: this is no status. */
  plan->rx[plan->frames][1] = 0;
  mb4_plan_add(plan, 1 + MB4_STATUS_BYTES, MB4_CYCLIC_STATUS, 0, 0);
}

/* Clears SVALID of the slave. With `size` 6 it also writes 0xF4, HOLDBANK = 0; 0xF3 between them is
 * read-only. */
static inline void mb4_cyclic_add_clear(const mb4_cyclic *read, mb4_plan *plan, uint8_t size) {
  const uint8_t index = (uint8_t)(read->word->slave - 1);
  uint8_t *tx = plan->tx[plan->frames];
  mb4_plan_add(plan, size, MB4_CYCLIC_WRITE, MB4_CYCLIC_SVALID, 0xFF);
  tx[2 + index / 4] = (uint8_t) ~(2U << 2 * (index % 4));
  tx[5] = MB4_CYCLIC_AGS;
}

static inline void mb4_cyclic_add_instruction(mb4_plan *plan, uint8_t instruction) {
  mb4_plan_add(plan, 2, MB4_CYCLIC_INSTRUCT, instruction, 0);
}

/* The next plan begins: `code` is the result if nothing else happens. */
MB4_APART uint8_t mb4_cyclic_next(mb4_cyclic *read, mb4_plan *plan, uint8_t stage, uint8_t code) {
  plan->frames = 0;
  read->built = 0;
  read->stage = stage;
  read->code = code;
  return MB4_MORE;
}

MB4_APART uint8_t mb4_cyclic_release(mb4_cyclic *read, mb4_plan *plan, uint8_t code) {
  (void)mb4_cyclic_next(read, plan, MB4_STAGE_END, code);
  mb4_cyclic_add_instruction(plan, MB4_CYCLIC_AGS);
  return MB4_MORE;
}

/* Begins a try. */
MB4_APART uint8_t mb4_cyclic_try(mb4_cyclic *read, mb4_plan *plan, uint8_t with) {
  const bool full = (with & MB4_WITH_FULL) != 0 && read->spi_check == MB4_SPI_CHECK_FULL;
  const bool unheld = (with & MB4_WITH_UNHELD) != 0 && read->unheld;
  (void)mb4_cyclic_next(read, plan, full || unheld ? MB4_STAGE_LOOK : MB4_STAGE_DATA,
                        MB4_NO_DATA);
  if (!unheld) {
    mb4_cyclic_add_instruction(plan, MB4_CYCLIC_HOLD);
  } else if (full) {
    mb4_cyclic_add_status(plan);
  }
  if (read->stage == MB4_STAGE_DATA) {
    mb4_cyclic_add_data(read, plan);
  }
  mb4_cyclic_add_status(plan);
  if (read->chain && !read->again) {
    mb4_cyclic_add_clear(read, plan, 6);
  }
  return MB4_MORE;
}

/* Begins a read: writes its first frames to `plan`. `with`: as of mb4_cyclic_finish(). */
static inline void mb4_cyclic_plan(mb4_cyclic *read, mb4_plan *plan, uint8_t with) {
  plan->pause_us = 0;
  read->again = false;
  read->bad = false;
  read->running = false;
  read->unproven = false;
  if (read->watch->held) {
    /* Words that have waited in a held bank, or behind it, are old. INSTR = 000 beside an access is
     * for chips that allow it; the access itself has begun with HOLDBANK = 0. */
    (void)mb4_cyclic_next(read, plan, MB4_STAGE_FREE, MB4_NO_DATA);
    if ((with & MB4_WITH_UNHELD) == 0 || !read->unheld) {
      mb4_cyclic_add_instruction(plan, MB4_CYCLIC_AGS);
    }
    mb4_cyclic_add_clear(read, plan, 4);
  } else if (read->built == plan) {
    read->stage = MB4_STAGE_DATA;
    read->code = MB4_NO_DATA;
    plan->rx[2][1] = 0;
  } else {
    (void)mb4_cyclic_try(read, plan, with);
    read->built = read->chain ? plan : 0;
  }
}

/* Takes a status. Returns MB4_OK, or what is wrong with it. */
static inline uint8_t mb4_cyclic_take_status(mb4_cyclic *read, const uint8_t *rx) {
  uint8_t i = 0;
  for (i = 0; i < MB4_STATUS_BYTES; ++i) {
    read->status[i] = rx[1 + i];
  }
  /* Constant bits (pages 21, 22): MISO stuck at 0 or 1 fails them. */
  if ((rx[1] & MB4_CYCLIC_CONST0) == 0 || ((rx[2] | rx[3]) & MB4_CYCLIC_CONST1) != 0) {
    return MB4_NOT_DETECTED;
  }
  read->running = read->access && (rx[1] & MB4_CYCLIC_REGEND) == 0;
  /* The chip must hold exactly what was written; AGS may have ended by an error. Without HOLDBANK
   * the bytes may come from two frames; with SWBANK or INIT they are other data. */
  return read->unheld || (rx[5] | MB4_CYCLIC_AGS) == MB4_CYCLIC_HOLD ? MB4_OK : MB4_CORRUPTED;
}

static inline bool mb4_cyclic_valid(const mb4_cyclic *read) {
  const uint8_t index = (uint8_t)(read->word->slave - 1);
  return ((uint8_t)(read->status[1 + index / 4] >> 2 * (index % 4)) & 2U) != 0;
}

static inline bool mb4_cyclic_frame_bad(const mb4_cyclic *read) {
  return (read->status[0] & MB4_CYCLIC_SCDERR) == 0;
}

/* The bytes of SCDATAx, which end frame `frame` of `plan`. */
static inline void mb4_cyclic_load(const mb4_cyclic *read, const mb4_plan *plan, uint8_t frame,
                                   uint32_t *low, uint32_t *high) {
  const uint8_t *bytes = &plan->rx[frame][plan->size[frame]];
  uint8_t left = read->word->bytes;
  uint32_t part = 0;
  *high = 0;
  if (left > 4) {
    do {
      part = part << 8 | *--bytes;
    } while (--left > 4);
    *high = part;
    part = 0;
  }
  do {
    part = part << 8 | *--bytes;
  } while (--left > 0);
  *low = part;
}

/* Keeps the data bits of `low`, `high`. False: a bit above them, in the same byte, is 1 although
 * the chip makes it 0. */
static inline bool mb4_cyclic_cut(const mb4_word *word, uint32_t *low, uint32_t *high,
                                  uint8_t with) {
  uint32_t *top = low;
  uint8_t bits = word->bits;
  uint8_t unused = 0;
  uint32_t kept = 0;
  uint32_t cut = 0;
  if ((with & MB4_WITH_LONG) != 0 && bits > 32) {
    top = high;
    bits = (uint8_t)(bits - 32);
  } else {
    *high = 0;
  }
  unused = (uint8_t)(32 - bits);
  kept = *top << unused >> unused;
  cut = *top ^ kept;
  *top = kept;
  return (bits & 7U) == 0 || (cut >> bits & (0xFFU >> (bits & 7U))) == 0;
}

/* The CRC that the chip has stored, in the top byte(s) (page 26). */
static inline uint16_t mb4_cyclic_stored_crc(const mb4_cyclic *read) {
  return (uint16_t)(read->high >> (read->word->crc_bits > 8 ? 16 : 24));
}

/* Fills read->reading. False: the word contradicts itself. */
static inline bool mb4_cyclic_decode(mb4_cyclic *read, uint8_t with) {
  const mb4_word *word = read->word;
  mb4_reading *reading = &read->reading;
  uint32_t low = read->low;
  uint32_t high = read->high;
  uint32_t sent = 0;
  if (!mb4_cyclic_cut(word, &low, &high, with)) {
    return false;
  }
  reading->crc_stored = word->crc_bits != 0;
  reading->crc = 0;
  if (reading->crc_stored) {
    reading->crc = mb4_cyclic_stored_crc(read);
    if (reading->crc != mb4_word_crc(word, low, high, with)) {
      return false;
    }
  }
  /* With Gray code the chip converts the flags together with the position. */
  sent = (with & MB4_WITH_GRAY) != 0 && word->gray ? low ^ low >> 1 : low;
  reading->slave = word->slave;
  reading->error = word->flags && (sent & 2U) == 0;
  reading->warning = word->flags && (sent & 1U) == 0;
  if (word->flags) {
    reading->raw = (uint64_t)high << 32 | ((low & ~3U) | (sent & 3U));
    low = low >> 2 | high << 30;
    high >>= 2;
    reading->position = (uint64_t)high << 32 | low;
  } else {
    reading->raw = (uint64_t)high << 32 | low;
    reading->position = reading->raw;
  }
  return true;
}

/* FULL: data that only a second reading proves. Without a stored CRC this is any data. With a CRC
 * it is all zeros and all ones: a line that was stuck for a moment makes them, and the CRC may
 * accept them. */
static inline bool mb4_cyclic_needs_second(const mb4_cyclic *read, uint8_t with) {
  uint32_t low = read->low;
  uint32_t high = read->high;
  uint32_t ones_low = 0xFFFFFFFFU;
  uint32_t ones_high = 0xFFFFFFFFU;
  if (read->word->crc_bits == 0) {
    return true;
  }
  (void)mb4_cyclic_cut(read->word, &low, &high, with);
  (void)mb4_cyclic_cut(read->word, &ones_low, &ones_high, with);
  return (low | high) == 0 || (low == ones_low && high == ones_high);
}

/* The word in the held bank has no SVALID, and the last frame was bad. A stored CRC tells whether
 * this word is the bad one; otherwise it was good and has been read before. A bad word gets the CRC
 * that fits, so that it counts once; the next frame overwrites it. Adds the frame for this to
 * `plan`. */
MB4_APART uint8_t mb4_cyclic_judge(mb4_cyclic *read, mb4_plan *plan, uint8_t with) {
  const mb4_word *word = read->word;
  uint32_t low = read->low;
  uint32_t high = read->high;
  uint16_t crc = 0;
  uint8_t bytes = 0;
  uint8_t *tx = 0;
  if (word->crc_bits == 0) {
    read->unproven = true;
    return (with & MB4_WITH_SEVERAL) != 0 && read->watch->several ? MB4_NO_DATA : MB4_CRC;
  }
  (void)mb4_cyclic_cut(word, &low, &high, with);
  crc = mb4_word_crc(word, low, high, with);
  if (crc == mb4_cyclic_stored_crc(read)) {
    return MB4_NO_DATA;
  }
  read->bad = true;
  if (read->chain && !read->again) {
    return MB4_CRC; /* the bank is free already; it must be held while the word is marked */
  }
  bytes = word->crc_bits > 8 ? 2 : 1;
  tx = plan->tx[plan->frames];
  mb4_plan_add(plan, (uint8_t)(2 + bytes), MB4_CYCLIC_WRITE, (uint8_t)(8 * word->slave - bytes),
               (uint8_t)crc);
  if (bytes == 2) {
    tx[3] = (uint8_t)(crc >> 8);
  }
  return MB4_CRC;
}

/* Data and status of a held bank are here. */
static inline uint8_t mb4_cyclic_held(mb4_cyclic *read, mb4_plan *plan, uint8_t with) {
  const bool full = (with & MB4_WITH_FULL) != 0 && read->spi_check == MB4_SPI_CHECK_FULL;
  const bool valid = mb4_cyclic_valid(read);
  const bool chained = read->chain && !read->again;
  uint8_t code = MB4_NO_DATA;
  if (valid && (!full || read->fresh)) {
    code = mb4_cyclic_decode(read, with) ? MB4_OK : MB4_CORRUPTED;
  }
  if (!chained) {
    (void)mb4_cyclic_next(read, plan, MB4_STAGE_END, code);
  }
  read->code = code;
  if (!valid && !(full && read->fresh) && mb4_cyclic_frame_bad(read)) {
    read->code = mb4_cyclic_judge(read, plan, with);
    if (chained && read->bad) {
      read->again = true;
      return mb4_cyclic_try(read, plan, with);
    }
  }
  if (chained) {
    return read->code;
  }
  if (full && (valid || read->fresh)) {
    read->stage = MB4_STAGE_CLEAR;
    read->again = read->code == MB4_OK && mb4_cyclic_needs_second(read, with);
    if (read->again) {
      mb4_cyclic_add_data(read, plan);
    }
    mb4_cyclic_add_clear(read, plan, 4);
    mb4_cyclic_add_status(plan);
  } else if (valid) {
    mb4_cyclic_add_clear(read, plan, 6);
  } else {
    mb4_cyclic_add_instruction(plan, MB4_CYCLIC_AGS);
  }
  return MB4_MORE;
}

/* Without HOLDBANK two facts prove that the data belongs to one good frame. SVALID was cleared
 * before the data was read and is still 0: no good frame has ended meanwhile. nSCDERR is 1: no bad
 * frame has ended either. Directly after a switch of the banks there is the time of a frame until
 * the next one, so a second try follows. */
static inline uint8_t mb4_cyclic_unheld(mb4_cyclic *read, mb4_plan *plan, uint8_t code,
                                        uint8_t with) {
  if ((code == MB4_NO_DATA || code == MB4_BANK_SWITCHED) && !read->again) {
    read->again = true;
    return mb4_cyclic_try(read, plan, with);
  }
  return code;
}

static inline uint8_t mb4_cyclic_take_unheld(mb4_cyclic *read, mb4_plan *plan, uint8_t with) {
  const bool repeated = plan->frames == 2;
  uint32_t low = 0;
  uint32_t high = 0;
  uint8_t code = mb4_cyclic_take_status(read, plan->rx[plan->frames - 1]);
  if (code != MB4_OK) {
    return code;
  }
  if (mb4_cyclic_valid(read) || mb4_cyclic_frame_bad(read)) {
    return mb4_cyclic_unheld(read, plan, MB4_BANK_SWITCHED, with);
  }
  mb4_cyclic_load(read, plan, (uint8_t)(plan->frames - 2), &low, &high);
  if (repeated) {
    return low == read->low && high == read->high ? read->code : (uint8_t)MB4_CORRUPTED;
  }
  read->low = low;
  read->high = high;
  code = mb4_cyclic_decode(read, with) ? MB4_OK : MB4_CORRUPTED;
  if (read->spi_check == MB4_SPI_CHECK_FULL && code == MB4_OK &&
      mb4_cyclic_needs_second(read, with)) {
    (void)mb4_cyclic_next(read, plan, MB4_STAGE_UNHELD, code);
    mb4_cyclic_add_data(read, plan);
    mb4_cyclic_add_status(plan);
    return MB4_MORE;
  }
  return code;
}

/* LOOK: is there a new frame? */
static inline uint8_t mb4_cyclic_take_look(mb4_cyclic *read, mb4_plan *plan, uint8_t with) {
  const bool unheld = (with & MB4_WITH_UNHELD) != 0 && read->unheld;
  uint8_t frame = unheld ? 0 : 1;
  uint8_t code = MB4_OK;
  read->fresh = true;
  for (; frame < plan->frames && code == MB4_OK; ++frame) {
    code = mb4_cyclic_take_status(read, plan->rx[frame]);
    read->fresh = read->fresh && mb4_cyclic_valid(read);
  }
  if (unheld) {
    if (code != MB4_OK) {
      return code;
    }
    if (!read->fresh) {
      return mb4_cyclic_unheld(read, plan, MB4_NO_DATA, with);
    }
    (void)mb4_cyclic_next(read, plan, MB4_STAGE_UNHELD, MB4_OK);
    mb4_cyclic_add_clear(read, plan, 4);
  } else {
    if (code != MB4_OK || (!read->fresh && !mb4_cyclic_frame_bad(read))) {
      return mb4_cyclic_release(read, plan, code != MB4_OK ? code : (uint8_t)MB4_NO_DATA);
    }
    (void)mb4_cyclic_next(read, plan, MB4_STAGE_SECOND, MB4_OK);
  }
  mb4_cyclic_add_data(read, plan);
  mb4_cyclic_add_status(plan);
  return MB4_MORE;
}

/* CLEAR: was the second reading the same, and is SVALID 0? The chip takes some system clocks for
 * this, so the status is read twice before it counts as a fault. */
static inline uint8_t mb4_cyclic_take_clear(mb4_cyclic *read, mb4_plan *plan) {
  const bool last = plan->frames == 1;
  uint32_t low = 0;
  uint32_t high = 0;
  uint8_t code = mb4_cyclic_take_status(read, plan->rx[plan->frames - 1]);
  if (plan->frames == 3) {
    mb4_cyclic_load(read, plan, 0, &low, &high);
    if (low != read->low || high != read->high) {
      read->code = MB4_CORRUPTED;
    }
  }
  if (code == MB4_OK && mb4_cyclic_valid(read)) {
    if (!last) {
      (void)mb4_cyclic_next(read, plan, MB4_STAGE_CLEAR, read->code);
      mb4_cyclic_add_status(plan);
      return MB4_MORE;
    }
    code = MB4_CORRUPTED;
  }
  return mb4_cyclic_release(read, plan, code == MB4_OK ? read->code : code);
}

/* The result is `code`. Frames that stay away for too long turn it into an alarm. A word that is
 * new, good or bad, proves that frames come. nSCDERR = 0 stays when no more frames end, so a bad
 * frame without a stored CRC proves nothing. */
static inline uint8_t mb4_cyclic_watch(mb4_cyclic *read, mb4_plan *plan, uint8_t code,
                                       uint32_t now_us, uint8_t with) {
  mb4_watch *watch = read->watch;
  const bool omitted = (read->status[0] & MB4_CYCLIC_AGSERR) == 0;
  const bool several = (with & MB4_WITH_SEVERAL) != 0 && watch->several;
  const uint8_t index = (uint8_t)(read->word->slave - 1);
  uint32_t limit_us = 0;
  if (several && code == MB4_OK) {
    watch->taken = (uint8_t)(watch->taken | 1U << index);
    watch->good_us[index] = now_us;
  }
  if (read->unheld || code == MB4_OK || read->bad || code == MB4_CORRUPTED) {
    watch->news_us = now_us;
    return code;
  }
  /* Other slaves keep news_us young. Bad frames without a good word of this one are its own. */
  if (several && read->unproven && now_us - watch->good_us[index] > watch->omitted_us) {
    code = MB4_CRC;
  }
  limit_us = omitted || read->unproven ? watch->omitted_us : watch->silent_us;
  if ((code != MB4_NO_DATA && code != MB4_CRC) || watch->silent_us == 0 ||
      now_us - watch->news_us <= limit_us) {
    return code;
  }
  (void)mb4_cyclic_next(read, plan, MB4_STAGE_LINES,
                        read->unproven && !omitted ? MB4_CRC : MB4_TIMEOUT);
  plan->rx[0][MB4_CYCLIC_LINES] = 0;
  mb4_plan_add(plan, 1 + MB4_CYCLIC_LINES, MB4_CYCLIC_STATUS, 0, 0);
  return MB4_MORE;
}

/* Takes what came back. `transferred`: all frames of the plan were made, in order. `now_us`: the
 * time, a counter of microseconds that wraps at 2^32. `with`: MB4_WITH_..., a constant.
 *
 * Returns MB4_MORE (make the frames of the new plan, then call it again) or the result:
 *
 *   MB4_OK             read->reading is a new position
 *   MB4_NO_DATA        no frame with data of this slave has ended since the last read
 *   MB4_CRC            one has, and its CRC was wrong; told once for each frame. Without a stored
 *                      CRC: by each read until a frame is good, if the slave is the only one
 *   MB4_CORRUPTED, MB4_NOT_DETECTED, MB4_TRANSPORT, MB4_BANK_SWITCHED, MB4_TIMEOUT, MB4_LINE_ERROR
 *                      as Automatic::poll() in mb4/automatic.hpp describes them
 *
 * At most four calls a read without MB4_SPI_CHECK_FULL, six with it or unheld; one more after a read
 * that has ended without the release of the bank. A read may be given up: call this function with
 * transferred = false, without the frames, until it does not return MB4_MORE. */
static inline uint8_t mb4_cyclic_finish(mb4_cyclic *read, mb4_plan *plan, bool transferred,
                                        uint32_t now_us, uint8_t with) {
  const uint8_t stage = read->stage;
  uint8_t code = transferred ? read->code : (uint8_t)MB4_TRANSPORT;
  if (stage == MB4_STAGE_LINES) {
    const uint8_t lines = read->watch->lines;
    const bool idle = (plan->rx[0][MB4_CYCLIC_LINES] & lines) == lines;
    return transferred && !idle ? (uint8_t)MB4_LINE_ERROR : code;
  }
  if (stage == MB4_STAGE_FREE) {
    read->watch->held = !transferred;
    read->watch->news_us = now_us; /* no bank was switched meanwhile */
    return transferred ? mb4_cyclic_try(read, plan, with) : code;
  }
  if (stage == MB4_STAGE_END) {
    /* The release was the last frame. If it was not alone, it may not have been tried. */
    if (!transferred && (plan->frames > 1 || plan->size[0] > 2)) {
      return mb4_cyclic_release(read, plan, code);
    }
    read->watch->held = !transferred;
    if (read->bad && code == MB4_NO_DATA) {
      code = MB4_CRC; /* chain: the bank has gone before the word was marked */
    }
  } else if ((with & MB4_WITH_UNHELD) != 0 && read->unheld) {
    if (transferred) {
      code = stage == MB4_STAGE_LOOK ? mb4_cyclic_take_look(read, plan, with)
                                     : mb4_cyclic_take_unheld(read, plan, with);
    }
  } else if (!transferred) {
    return mb4_cyclic_release(read, plan, code);
  } else if ((with & MB4_WITH_FULL) != 0 && stage == MB4_STAGE_LOOK) {
    return mb4_cyclic_take_look(read, plan, with);
  } else if ((with & MB4_WITH_FULL) != 0 && stage == MB4_STAGE_CLEAR) {
    return mb4_cyclic_take_clear(read, plan);
  } else {
    const uint8_t frame = stage == MB4_STAGE_DATA ? 1 : 0;
    code = mb4_cyclic_take_status(read, plan->rx[frame + 1]);
    if (code != MB4_OK) {
      return mb4_cyclic_release(read, plan, code);
    }
    mb4_cyclic_load(read, plan, frame, &read->low, &read->high);
    code = mb4_cyclic_held(read, plan, with);
  }
  return code == MB4_MORE ? code : mb4_cyclic_watch(read, plan, code, now_us, with);
}

#undef MB4_APART

#ifdef __cplusplus
}
#endif

#endif /* MB4_CYCLIC_H_ */
