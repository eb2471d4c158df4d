/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The read path of a control loop, in C99 and C++: positions of 1 to 8 slaves from automatic
 * frames. Automatic::poll_slave() and poll() are loops over it. A program in C needs this header,
 * mb4_types.h and the generated mb4_regs.h, and no C++ compiler. There is no heap, static data,
 * callback or clock.
 *
 * A read is one or more plans. A plan holds SPI frames; the caller makes them, by DMA or otherwise.
 * read, word and slot are set up by mb4_word_set(), mb4_plan_memory() and mb4_cyclic_check():
 *
 *   mb4_cyclic_plan(&read, &plan, MB4_WITH_ALL);      // begins a read
 *   do {
 *     bool done = ...;    // for each i < plan.frames, NCS low: plan.size[i] bytes
 *                         // from mb4_plan_tx(&plan, i) to mb4_plan_rx(&plan, i)
 *     code = mb4_cyclic_finish(&read, &plan, done, now_us, MB4_WITH_ALL);
 *   } while (code == MB4_MORE);
 *   if (code == MB4_OK) { mb4_slot_reading(&word, &slot, &reading, MB4_WITH_ALL); ... }
 *
 * Of several slaves each has a code of its own, in its slot (mb4_cyclic_finish()).
 * MB4_SLAVE_ERROR is a new word too, but its nE is 0: the encoder says that its position is not to
 * be trusted. mb4_slot_reading() then gives what it sent, for a message or a log.
 *
 * With `read.chain` set, a read is one plan of these SPI opcodes (table 69 of the datasheet): 0x07
 * HOLDBANK, 0x09 or 0x03 data of one slave or several, 0x05 status, 0x02 SVALID = 0 and
 * HOLDBANK = 0. Only a bad word needs another plan. Without it the 0x02 is a plan of its own, and a
 * bad word needs one SPI frame more than a good one.
 *
 * No function may be interrupted by another one on the same object.
 */
#ifndef MB4_CYCLIC_H_
#define MB4_CYCLIC_H_

#include <stdbool.h>
#include <stdint.h>

#include "mb4_types.h"

/* The same generated register map in either language. */
#ifdef __cplusplus
#include "mb4_regs.hpp"
enum {
  MB4_CYCLIC_AGS = mb4::regs::AGS::encode<1>(),
  MB4_CYCLIC_HOLD = mb4::regs::HOLDBANK::encode<1>() | MB4_CYCLIC_AGS,
  MB4_CYCLIC_NO_INSTR = 0xFF & ~(mb4::regs::INSTR::kMask | mb4::regs::AGS::kMask),
  MB4_CYCLIC_SWBANK = mb4::regs::SWBANK::kMask,
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
  MB4_CYCLIC_SL1 = mb4::regs::SL1::kMask,
  MB4_CYCLIC_SL2 = mb4::regs::SL2::kMask,
  MB4_CYCLIC_IFACE = mb4::regs::MAFS::kAddress - mb4::regs::kAddrStatus0 + 1,
  MB4_CYCLIC_FORCED = mb4::regs::MAFS::kMask | mb4::regs::MAFO::kMask,
  MB4_CYCLIC_LINES = mb4::regs::SL1::kAddress - mb4::regs::kAddrStatus0 + 1,
  MB4_CYCLIC_BANKS = mb4::regs::SWBANKFAIL::kAddress - mb4::regs::kAddrStatus0 + 1,
  MB4_CYCLIC_BANKFAIL = mb4::regs::SWBANKFAIL::kMask
};
#else
#include "mb4_regs.h"
enum {
  MB4_CYCLIC_AGS = MB4_AGS_MASK,
  MB4_CYCLIC_HOLD = MB4_HOLDBANK_MASK | MB4_AGS_MASK,
  MB4_CYCLIC_NO_INSTR = 0xFF & ~(MB4_INSTR_MASK | MB4_AGS_MASK),
  MB4_CYCLIC_SWBANK = MB4_SWBANK_MASK,
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
  MB4_CYCLIC_SL1 = MB4_SL_MASK(1U),
  MB4_CYCLIC_SL2 = MB4_SL_MASK(2U),
  MB4_CYCLIC_IFACE = MB4_MAFS_ADDR - MB4_ADDR_STATUS0 + 1,
  MB4_CYCLIC_FORCED = MB4_MAFS_MASK | MB4_MAFO_MASK,
  MB4_CYCLIC_LINES = MB4_SL_ADDR(1U) - MB4_ADDR_STATUS0 + 1,
  MB4_CYCLIC_BANKS = MB4_SWBANKFAIL_ADDR - MB4_ADDR_STATUS0 + 1,
  MB4_CYCLIC_BANKFAIL = MB4_SWBANKFAIL_MASK
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
  MB4_PLAN_FRAMES = 18,  /* most frames of a plan, with eight slaves */
  MB4_PLAN_LONGEST = 25, /* bytes of the longest frame, unless mb4_cyclic.wide asks for more */
  MB4_MORE = 255,        /* of mb4_cyclic_finish(): make the frames of the plan */
  MB4_NOT_STORED = 0xFF, /* a byte of rx that the bus has not stored */
  /* FULL: MOSI while data is read. It is what a disturbed opcode writes (0x03 and 0x02, 0x0B), so
   * it is not 0, which may pass. 0x03 may become 0x07 too: then it goes to 0xF5, where it forces no
   * line and keeps ENTEST = 0. */
  MB4_CYCLIC_FILLER = 0xA0
};

/* Words of 32 bits for tx, and for rx, of a read of `slaves` slaves: a size of an array. */
#define MB4_PLAN_WORDS(slaves) (4U * (slaves) + 4U) /* NOLINT(cppcoreguidelines-macro-usage) */

/* SPI frames to make one after the other, each with NCS low: mb4_plan_tx() to mb4_plan_rx(),
 * size[i] bytes. Every frame begins at a whole word. Write only rx. */
typedef struct {
  uint32_t pause_us; /* the next plan must not begin earlier than this after the last frame */
  uint8_t *tx; /* the caller's memory, where DMA reaches it. The plan writes into rx too: with a
                  data cache clean and invalidate both before the frames of a plan are made */
  uint8_t *rx;
  uint8_t frames;                /* 1..MB4_PLAN_FRAMES */
  uint8_t size[MB4_PLAN_FRAMES]; /* bytes of each frame, 2..25, with `wide` 2..66 */
  uint8_t at[MB4_PLAN_FRAMES];   /* where each frame begins in tx and rx */
} mb4_plan;

/* Gives the plan its memory: MB4_PLAN_WORDS() words of 32 bits each. */
static inline void mb4_plan_memory(mb4_plan *plan, void *tx, void *rx) {
  plan->tx = (uint8_t *)tx; /* NOLINT(cppcoreguidelines-pro-type-cstyle-cast) */
  plan->rx = (uint8_t *)rx; /* NOLINT(cppcoreguidelines-pro-type-cstyle-cast) */
}

static inline uint8_t *mb4_plan_tx(const mb4_plan *plan, uint8_t frame) {
  return plan->tx + plan->at[frame];
}

static inline uint8_t *mb4_plan_rx(const mb4_plan *plan, uint8_t frame) {
  return plan->rx + plan->at[frame];
}

/* Adds a frame of `size` bytes that begins with `first` and `second`; the rest is `filler`. Returns
 * it. The last byte in rx becomes what no answer ends with: a bus that reports success and has not
 * stored all bytes must not turn an old answer into a new one. */
MB4_APART uint8_t *mb4_plan_add(mb4_plan *plan, uint8_t size, uint8_t first, uint8_t second,
                                uint8_t filler) {
  const uint8_t frame = plan->frames;
  uint8_t at = 0;
  uint8_t *tx = 0;
  uint8_t *next = 0;
  if (frame != 0) {
    at = (uint8_t)(((unsigned)plan->at[frame - 1] + plan->size[frame - 1] + 3U) & ~3U);
  }
  plan->at[frame] = at;
  plan->size[frame] = size;
  plan->frames = (uint8_t)(frame + 1);
  tx = plan->tx + at;
  tx[0] = first;
  tx[1] = second;
  for (next = tx + size; next != tx + 2;) {
    *--next = filler;
  }
  plan->rx[at + size - 1] = MB4_NOT_STORED;
  return tx;
}

/* False: the frame writes, so what comes back need not be stored. */
static inline bool mb4_plan_reads(const mb4_plan *plan, uint8_t frame) {
  const uint8_t opcode = mb4_plan_tx(plan, frame)[0];
  return opcode != MB4_CYCLIC_WRITE && opcode != MB4_CYCLIC_INSTRUCT;
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
  uint8_t line;          /* of mb4_word_biss_c(); 0: a word that is all 0 has no code of its own */
  uint8_t crc_high;      /* private: bits of the stored CRC below the last byte, 0 or 8 */
  uint8_t guard;         /* private: bits of the last byte that become 1 once it is taken */
  uint8_t flip;          /* private: bits that are inverted */
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
  word->line = 0;
  word->crc_high = word->crc_bits > 8 ? 8 : 0;
  /* Bits that the chip makes 0. A stored CRC that leaves none in its byte is inverted. */
  width = word->crc_bits != 0 ? word->crc_bits : word->bits;
  word->guard = (uint8_t)((width & 7U) != 0 ? 0xFFU << (width & 7U) : 0U);
  word->flip = word->crc_bits != 0 && (width & 7U) == 0 ? 0xFF : 0;
}

/* The slave is one of BiSS C on `channel` 1 or 2: a bad word that is all 0 on the line is
 * MB4_NO_WORD (with MB4_WITH_BEATS). Nothing changes for a slave whose CRC the chip does not check.
 */
static inline void mb4_word_biss_c(mb4_word *word, const mb4_slave_config *config,
                                   uint8_t channel) {
  const uint8_t line = channel == 1 ? MB4_CYCLIC_SL1 : MB4_CYCLIC_SL2;
  word->line = config->crc_polynomial != 0 ? line : 0;
}

/* Parts of the read path that a build may leave out: the last argument of mb4_cyclic_finish(). A
 * constant lets the compiler drop the rest. What is left out must not be configured:
 * mb4_cyclic_check(). */
enum {
  MB4_WITH_LONG = 1,     /* data of more than 32 bits */
  MB4_WITH_GRAY = 2,     /* SSI with Gray code */
  MB4_WITH_FULL = 4,     /* MB4_SPI_CHECK_FULL, _FULL_AND_RELEASE */
  MB4_WITH_UNHELD = 8,   /* without HOLDBANK beside a register access */
  MB4_WITH_SEVERAL = 16, /* more than one slave delivers data */
  MB4_WITH_TABLE = 32,   /* CRC by word->table, four bits a step, where it is not null */
  MB4_WITH_COUNTS = 64,  /* watch->counts, where it is not null */
  MB4_WITH_BEATS = 128,  /* closer looks: no MB4_TIMEOUT where the reads meet the end of each frame
                            for a while; MB4_NO_WORD. No configuration needs it */
  MB4_WITH_ALL = 255
};

/* `steps` (1..32) bits, of a CRC that is left aligned and has the data added to it. */
static inline uint32_t mb4_crc_steps(uint32_t crc, uint32_t polynomial, uint8_t steps) {
  uint_fast8_t left = steps;
  do {
    crc = crc << 1 ^ (polynomial & (0U - (crc >> 31))); /* without a branch */
  } while (--left != 0);
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

/* What the reads of one chip have met: with MB4_WITH_COUNTS, each finished read of one slave or of
 * all. Set the object to zero once. The chip counts nothing: nAGSERR stays 0 from the first frame
 * that it has left out until BREAK or INIT, and SWBANKFAIL (0xFB) is 1 only until the next switch.
 * So lost samples are counted by time: the counts know how many periods lie between two reads with
 * a new word. The count is exact under three conditions. The frames have a fixed period. The time
 * from a frame to its read never differs by more than half a period from what it was at the first
 * such read. The clocks of the caller and of the chip agree: where they drift apart, each half
 * period of difference is one wrong count. One object serves the reads of one slave, or the reads
 * of all. Reads of several slaves, one by one, would hide from each other what is lost. A read of
 * all is good if one of its words is. */
typedef struct {
  uint32_t period_ns; /* the caller's: of the frames, at most 10^9; 0: nothing is counted as lost */
  uint32_t good;      /* reads with a new position: MB4_OK */
  uint32_t slave_errors; /* reads with a new word whose nE is 0. Such a sample is not lost: for one
                            slave, sequence is good + slave_errors + lost. Of a read of all it may
                            be one of its words, and the read is good by another one */
  uint32_t crc;          /* reads with a bad word */
  uint32_t lost; /* samples that no read has brought: left out, overwritten or bad; known with the
                    next new one */
  uint32_t sequence; /* number of the last new sample; the first one is 1 */
  uint32_t switched; /* MB4_BANK_SWITCHED */
  uint32_t late;     /* reads that ended more than 1.5 periods after the last one */
  uint32_t faults;   /* other errors */
  uint32_t restarts; /* of the C++ calls next(), restart() and plan_restart() */
  uint32_t no_word;  /* reads with MB4_NO_WORD for a slave; not in `crc` */
  uint32_t doubtful; /* by so much `lost` and `sequence` may be wrong: how often the time since the
                        good word before says another number of samples than the time since the
                        first one. It rises with each sample that is lost or comes late if period_ns
                        or a clock is wrong, and when a loop with another period than the frames
                        slips by one */
  bool omits;        /* nAGSERR = 0: the chip has left out a frame */
  /* Private. */
  uint32_t last_us; /* a new word */
  uint32_t read_us;
  uint32_t rest_ns;
} mb4_counts;

/* What all slaves of one chip share. */
typedef struct {
  uint32_t news_us;    /* when the last frame was seen; set it when frames are started */
  uint32_t omitted_us; /* longest time without a frame after the chip has left some out */
  uint32_t silent_us; /* longest time without a frame; MB4_NEVER: no alarm, only the caller knows */
  uint8_t lines;      /* bits of 0xF8 that are 1 while the lines are idle: SL1, SL2 */
  bool several;       /* more than one slave delivers data */
  bool held;          /* a read has ended without the release of the bank: the next one begins with
                         it, and drops the words that wait; set it when frames are started, because
                         words may wait from before */
  uint8_t taken;      /* slaves (bit 0 is slave 1) of which a read of one has taken a new word */
  uint32_t good_us[MB4_SLAVES]; /* when; set them when frames are started */
  mb4_counts *counts;           /* for MB4_WITH_COUNTS; may be null */
  uint16_t told[MB4_SLAVES];    /* private: low bits of the last bad word that was told */
  bool astray; /* private, FULL: SVALID = 0 was not seen; the write may have forced MA in 0xF5 */
} mb4_watch;

/* mb4_watch.silent_us: no alarm when frames stay away. */
#define MB4_NEVER 0xFFFFFFFFU /* NOLINT(cppcoreguidelines-macro-usage) */

/* The word of one slave, from one read. */
typedef struct {
  uint32_t low; /* SCDATAx */
  uint32_t high;
  uint16_t crc; /* that fits the data */
  uint8_t code; /* MB4_OK, MB4_NO_DATA, MB4_CRC, MB4_NO_WORD, MB4_CORRUPTED, MB4_SLAVE_ERROR */
  bool bad;     /* private: the word of this try has a wrong CRC */
} mb4_slot;

/* One read. Set the object to zero once; then the members up to `chain` are the caller's, and
 * mb4_cyclic_check() looks at them. The frames of a chain stay in the plan, so that the next read
 * need not write them again: when the plan's memory, one of these members or a word has changed,
 * call mb4_cyclic_check() again, or clear `built`. */
typedef struct {
  const mb4_word *words; /* of the slaves to read, in ascending order */
  mb4_slot *slots;       /* one for each word */
  mb4_watch *watch;
  uint8_t count;     /* words, 1..8; more than one needs MB4_WITH_SEVERAL */
  uint8_t spi_check; /* MB4_SPI_CHECK_..., as configured */
  bool wide;         /* SPI frames may be longer than 25 bytes: up to 66 */
  bool unheld;       /* a register access runs, and the chip allows no HOLDBANK beside it */
  bool access;       /* a register access has begun, and its end has not been seen; FULL: or the
                        registers that it has read are still needed */
  bool chain;        /* one plan; not with MB4_SPI_CHECK_FULL or _FULL_AND_RELEASE, not unheld */
  /* Results. */
  /* These two with MB4_WITH_SEVERAL: */
  bool told;        /* the slots hold the result of each slave; otherwise the code is that of all */
  bool one_frame;   /* all words that are MB4_OK or MB4_SLAVE_ERROR belong to one frame */
  bool bad;         /* a new word came with a wrong CRC; with MB4_OK a good one has followed */
  bool slave_error; /* a new word came with nE = 0; with MB4_OK another one is good */
  bool running;     /* with `access`: REGEND = 0 in the last status, it runs */
  uint8_t status[MB4_STATUS_BYTES]; /* the last one */
  /* Private. */
  uint8_t stage;
  uint8_t code;   /* the result, once it is known; MB4_OK: the slots tell */
  bool again;     /* the second try, or the second reading, runs */
  bool unproven;  /* a bad frame, and no stored CRC tells whose */
  uint16_t flags; /* SVALID of the slaves that this try reads */
  uint16_t fresh; /* those that were 1 before the data was read; then those read twice */
  uint16_t blank; /* those whose bad word is all 0; bit 0: one of them is MB4_NO_WORD */
  uint16_t parts; /* MB4_WITH_... that fit the set-up, and 0x100: mb4_cyclic_check() has said so */
  /* The caller's again. */
  const mb4_plan *built; /* holds the frames of the chain; null: none */
} mb4_cyclic;

enum {
  MB4_STAGE_DATA,      /* HOLDBANK, data, status; in a chain also the end */
  MB4_STAGE_LOOK,      /* FULL: HOLDBANK, status; unheld: status, with FULL twice */
  MB4_STAGE_SECOND,    /* FULL: data, status */
  MB4_STAGE_UNHELD,    /* SVALID = 0, data, status; then, if need be, data and status again */
  MB4_STAGE_CLEAR,     /* FULL: data again, SVALID = 0, status; then, if need be, status again */
  MB4_STAGE_END,       /* the bank is released; the result is known */
  MB4_STAGE_LINES,     /* are the lines idle? */
  MB4_STAGE_BLANK,     /* a word is all 0: is its line idle? */
  MB4_STAGE_FREE,      /* the bank was still held: release, SVALID = 0 */
  MB4_STAGE_PROVE_END, /* FULL_AND_RELEASE, after END: status */
  MB4_STAGE_PROVE_FREE /* the same after FREE */
};

/* Number of words, a constant where there is only one. */
static inline uint8_t mb4_cyclic_count(const mb4_cyclic *read, uint8_t with) {
  return (with & MB4_WITH_SEVERAL) != 0 ? read->count : 1;
}

/* FULL: the byte that holds the bank had SWBANK in it, which has swapped the banks until the
 * release: what waits then may be old. */
static inline bool mb4_cyclic_swapped(const mb4_cyclic *read, uint8_t with) {
  return (with & MB4_WITH_FULL) != 0 && read->spi_check >= MB4_SPI_CHECK_FULL &&
         read->code == MB4_CORRUPTED &&
         (read->status[4] | MB4_CYCLIC_AGS) == (MB4_CYCLIC_HOLD | MB4_CYCLIC_SWBANK);
}

/* A plan with a status follows the release of the bank. */
static inline bool mb4_cyclic_proves(const mb4_cyclic *read, uint8_t with) {
  return (with & MB4_WITH_FULL) != 0 && read->spi_check == MB4_SPI_CHECK_FULL_AND_RELEASE;
}

/* SVALID of a slave in 0xF2 and 0xF1, high and low byte. */
static inline uint16_t mb4_word_flag(const mb4_word *word) {
  return (uint16_t)(2UL << 2 * (word->slave - 1));
}

/* The slaves of this try whose SVALID is 1 in the last status. */
static inline uint16_t mb4_cyclic_valid(const mb4_cyclic *read) {
  const uint16_t low = read->status[1];
  const uint16_t high = (uint16_t)((uint16_t)read->status[2] << 8);
  return (uint16_t)((low | high) & read->flags);
}

static inline bool mb4_cyclic_frame_bad(const mb4_cyclic *read) {
  return (read->status[0] & MB4_CYCLIC_SCDERR) == 0;
}

/* Is the slave one of `flags`, a part of read->flags? */
static inline bool mb4_word_in(const mb4_word *word, uint16_t flags, uint8_t with) {
  return (with & MB4_WITH_SEVERAL) != 0 ? (mb4_word_flag(word) & flags) != 0 : flags != 0;
}

/* Adds the frames that read the data of the slaves `flags`. Neighbours share a frame when the bytes
 * between them cost no more than another opcode and address. */
MB4_APART void mb4_cyclic_add_data(const mb4_cyclic *read, mb4_plan *plan, uint16_t flags,
                                   uint8_t with) {
  const bool full = (with & MB4_WITH_FULL) != 0 && read->spi_check >= MB4_SPI_CHECK_FULL;
  const uint8_t filler = full ? MB4_CYCLIC_FILLER : 0;
  const uint8_t limit = read->wide ? 255 : MB4_PLAN_LONGEST;
  const mb4_word *word = read->words;
  const mb4_word *last = word + mb4_cyclic_count(read, with);
  while (word != last) {
    const mb4_word *first = word;
    const uint8_t from = (uint8_t)(8 * word->slave - 8);
    /* For slave 1 one byte shorter, and at any SCLK (I204). */
    const uint8_t header = from == 0 ? 1 : 2;
    uint8_t size = (uint8_t)(header + word->bytes);
    const bool wanted = (with & MB4_WITH_SEVERAL) == 0 || mb4_word_in(word, flags, with);
    ++word;
    if (!wanted) {
      continue;
    }
    for (; (with & MB4_WITH_SEVERAL) != 0 && word != last; ++word) {
      const uint8_t end = (uint8_t)(header + 8 * word->slave - 8 - from);
      if (!mb4_word_in(word, flags, with)) {
        continue;
      }
      if (end - size > 2 || end + word->bytes > limit) {
        break;
      }
      size = (uint8_t)(end + word->bytes);
    }
    mb4_plan_add(plan, size, header == 1 ? MB4_CYCLIC_READ0 : MB4_CYCLIC_READ,
                 header == 1 ? filler : from, filler);
    /* The last byte of each word, as that of the frame. */
    for (; (with & MB4_WITH_SEVERAL) != 0 && first != word; ++first) {
      const uint8_t end = (uint8_t)(header + 8 * first->slave - 8 - from + first->bytes);
      if (end <= size) {
        mb4_plan_rx(plan, (uint8_t)(plan->frames - 1))[end - 1] = MB4_NOT_STORED;
      }
    }
  }
}

MB4_APART void mb4_cyclic_add_status(mb4_plan *plan) {
  (void)mb4_plan_add(plan, 1 + MB4_STATUS_BYTES, MB4_CYCLIC_STATUS, 0, 0);
}

/* A status, with `more` up to 0xF5. */
static inline void mb4_cyclic_add_proof(mb4_plan *plan, bool more) {
  const uint8_t last = more ? (uint8_t)MB4_CYCLIC_IFACE : (uint8_t)MB4_STATUS_BYTES;
  (void)mb4_plan_add(plan, (uint8_t)(1 + last), MB4_CYCLIC_STATUS, 0, 0);
}

/* 0xF5 was asked for, and an MA line is forced: the write of SVALID = 0 has gone there. A frame
 * that has run meanwhile is none of the encoder, and no CRC need tell. */
static inline bool mb4_cyclic_forced(const mb4_plan *plan) {
  return plan->size[0] > 1 + MB4_STATUS_BYTES &&
         (mb4_plan_rx(plan, 0)[MB4_CYCLIC_IFACE] & MB4_CYCLIC_FORCED) != 0;
}

/* Clears SVALID of the slaves of this try. With `size` 6 it also writes 0xF4, HOLDBANK = 0; 0xF3
 * between them is read-only. */
static inline void mb4_cyclic_add_clear(mb4_plan *plan, uint16_t flags, uint8_t size) {
  uint8_t *tx = mb4_plan_add(plan, size, MB4_CYCLIC_WRITE, MB4_CYCLIC_SVALID, 0xFF);
  tx[2] = (uint8_t)~flags;
  tx[3] = (uint8_t)(~(uint32_t)flags >> 8);
  if (size == 6) {
    tx[5] = MB4_CYCLIC_AGS;
  }
}

static inline void mb4_cyclic_add_instruction(mb4_plan *plan, uint8_t instruction) {
  (void)mb4_plan_add(plan, 2, MB4_CYCLIC_INSTRUCT, instruction, 0);
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

/* A status shows whether the bank is free. It goes on to 0xF5 where that has to be seen. */
static inline uint8_t mb4_cyclic_prove(mb4_cyclic *read, mb4_plan *plan, uint8_t stage,
                                       uint8_t code) {
  (void)mb4_cyclic_next(read, plan, stage, code);
  mb4_cyclic_add_proof(plan, read->watch->astray);
  return MB4_MORE;
}

/* Begins a try. */
MB4_APART uint8_t mb4_cyclic_try(mb4_cyclic *read, mb4_plan *plan, uint8_t with) {
  const bool full = (with & MB4_WITH_FULL) != 0 && read->spi_check >= MB4_SPI_CHECK_FULL;
  const bool unheld = (with & MB4_WITH_UNHELD) != 0 && read->unheld;
  (void)mb4_cyclic_next(read, plan, full || unheld ? MB4_STAGE_LOOK : MB4_STAGE_DATA, MB4_OK);
  if (!unheld) {
    mb4_cyclic_add_instruction(plan, MB4_CYCLIC_HOLD);
  } else if (full) {
    mb4_cyclic_add_proof(plan, read->watch->astray);
  }
  if (read->stage == MB4_STAGE_DATA) {
    mb4_cyclic_add_data(read, plan, read->flags, with);
  }
  mb4_cyclic_add_status(plan);
  if (read->chain && !read->again) {
    mb4_cyclic_add_clear(plan, read->flags, 6);
  }
  return MB4_MORE;
}

/* FULL: the read begins with a look at 0xF5. Unheld the first status of each try has it. */
static inline bool mb4_cyclic_looks(const mb4_cyclic *read, uint8_t with) {
  return (with & MB4_WITH_FULL) != 0 && read->watch->astray && !read->unheld;
}

/* mb4_cyclic.parts */
static inline uint16_t mb4_cyclic_parts(uint8_t with) { return (uint16_t)(0x100U | with); }

/* All slaves of the read belong to the next try. */
static inline void mb4_cyclic_all(mb4_cyclic *read, uint8_t with) {
  uint8_t i = 0;
  read->flags = 0;
  for (; i < mb4_cyclic_count(read, with); ++i) {
    read->flags = (uint16_t)(read->flags | mb4_word_flag(&read->words[i]));
    read->slots[i].code = MB4_NO_DATA;
    read->slots[i].bad = false;
  }
}

/* MB4_OK, or what of a word and of the order of the words is wrong. `parts`: of MB4_WITH_..., those
 * that the words before need; those of this one are added. */
static inline uint8_t mb4_word_check(const mb4_word *word, const mb4_word *before, uint8_t *parts) {
  const uint8_t data_bytes = (uint8_t)((word->bits + 7U) / 8U);
  const uint8_t crc_bytes = word->crc_bits > 8 ? 2 : word->crc_bits > 0 ? 1 : 0;
  if (word->slave < 1 || word->slave > MB4_SLAVES ||
      (before != 0 && word->slave <= before->slave)) {
    return MB4_INVALID_CONFIG;
  }
  if (word->bits < 1 || word->bits > 64 || word->crc_bits > 16 || data_bytes + crc_bytes > 8 ||
      word->bytes != (crc_bytes != 0 ? 8 : data_bytes) || (word->flags && word->bits < 2)) {
    return MB4_INVALID_CONFIG;
  }
  *parts |= (uint8_t)((word->bits > 32 ? MB4_WITH_LONG : 0) | (word->gray ? MB4_WITH_GRAY : 0) |
                      (word->table != 0 ? MB4_WITH_TABLE : 0));
  return MB4_OK;
}

/* Two pieces of memory of `bytes` have some in common. */
static inline bool mb4_memory_meets(const uint8_t *one, const uint8_t *other, uint32_t bytes) {
  const uintptr_t first = (uintptr_t)one;    /* NOLINT(cppcoreguidelines-pro-type-cstyle-cast) */
  const uintptr_t second = (uintptr_t)other; /* NOLINT(cppcoreguidelines-pro-type-cstyle-cast) */
  return first < second + bytes && second < first + bytes;
}

/* The members of a read fit each other. */
static inline bool mb4_cyclic_in_range(const mb4_cyclic *read) {
  const bool full = read->spi_check >= MB4_SPI_CHECK_FULL;
  return read->count >= 1 && read->count <= MB4_SLAVES &&
         read->spi_check <= MB4_SPI_CHECK_FULL_AND_RELEASE &&
         !(read->chain && (full || read->unheld)) && (read->count == 1 || read->watch->several);
}

/* The lines, the limits and the period of a watch are possible. */
static inline bool mb4_watch_in_range(const mb4_watch *watch) {
  const uint32_t period_ns = watch->counts != 0 ? watch->counts->period_ns : 0;
  return watch->lines != 0 && (watch->lines & ~(unsigned)(MB4_CYCLIC_SL1 | MB4_CYCLIC_SL2)) == 0 &&
         watch->omitted_us != 0 && watch->silent_us != 0 && period_ns <= 1000000000U &&
         watch->omitted_us >= period_ns / 1000U && watch->silent_us >= period_ns / 1000U;
}

/* Checks what a read is set up with, once all members are set (`unheld`: whether it may become
 * true): before the first mb4_cyclic_plan(), and again after a change of a member (but for `unheld`
 * and `access`), a word, a member of the watch or the plan's memory. Until it has returned MB4_OK
 * for the same `with`, mb4_cyclic_finish() returns MB4_UNSUPPORTED. `words`: 32-bit words of the
 * plan's tx, and of its rx. It makes no transfer.
 *
 *   MB4_UNSUPPORTED       the set-up needs a part that `with` leaves out
 *   MB4_INVALID_ARGUMENT  a pointer is null; tx and rx overlap or are too short: MB4_PLAN_WORDS()
 *   MB4_INVALID_CONFIG    a word that mb4_word_set() has not made; slaves not in ascending order;
 *                         `count` or `spi_check` out of range; several words and watch->several =
 *                         false; `chain` with MB4_SPI_CHECK_FULL or `unheld`; watch->lines is none;
 *                         a limit of the watch is 0 (no alarm is MB4_NEVER) or shorter than
 *                         period_ns; period_ns is above 10^9
 *
 * It cannot see what the chip is configured with. It clears `built`, and the codes of the slots
 * become MB4_NO_DATA. */
static inline uint8_t mb4_cyclic_check(mb4_cyclic *read, const mb4_plan *plan, uint16_t words,
                                       uint8_t with) {
  const mb4_watch *watch = read->watch;
  const bool full = read->spi_check >= MB4_SPI_CHECK_FULL;
  uint8_t parts = (uint8_t)((full ? MB4_WITH_FULL : 0) | (read->unheld ? MB4_WITH_UNHELD : 0));
  uint8_t i = 0;
  read->parts = 0;
  read->built = 0;
  if (read->words == 0 || read->slots == 0 || watch == 0 || plan->tx == 0 || plan->rx == 0 ||
      words < MB4_PLAN_WORDS(read->count) ||
      mb4_memory_meets(plan->tx, plan->rx, (uint32_t)words * 4U)) {
    return MB4_INVALID_ARGUMENT;
  }
  if (!mb4_cyclic_in_range(read) || !mb4_watch_in_range(watch)) {
    return MB4_INVALID_CONFIG;
  }
  parts = (uint8_t)(parts | (watch->counts != 0 ? MB4_WITH_COUNTS : 0) |
                    (watch->several ? MB4_WITH_SEVERAL : 0));
  for (; i < read->count; ++i) {
    const uint8_t code = mb4_word_check(&read->words[i], i == 0 ? 0 : &read->words[i - 1], &parts);
    if (code != MB4_OK) {
      return code;
    }
    read->slots[i].code = MB4_NO_DATA;
  }
  if ((parts & ~(unsigned)with) != 0) {
    return MB4_UNSUPPORTED;
  }
  read->parts = mb4_cyclic_parts(with);
  return MB4_OK;
}

/* Begins a read: writes its first frames to `plan`, whose memory is for as many slaves
 * (mb4_plan_memory()). mb4_cyclic_check() has allowed `with`. */
static inline void mb4_cyclic_plan(mb4_cyclic *read, mb4_plan *plan, uint8_t with) {
  plan->pause_us = 0;
  read->again = false;
  read->bad = false;
  read->slave_error = false;
  read->running = false;
  read->unproven = false;
  if ((with & MB4_WITH_BEATS) != 0) {
    read->blank = 0;
  }
  if ((with & MB4_WITH_SEVERAL) != 0) {
    read->told = false;
    read->one_frame = true;
  }
  mb4_cyclic_all(read, with);
  if (read->watch->held || mb4_cyclic_looks(read, with)) {
    /* Words that have waited in a held bank, or behind it, are old. INSTR = 000 beside an access is
     * for chips that allow it; the access itself has begun with HOLDBANK = 0. */
    (void)mb4_cyclic_next(read, plan, MB4_STAGE_FREE, MB4_OK);
    if ((with & MB4_WITH_UNHELD) == 0 || !read->unheld) {
      mb4_cyclic_add_instruction(plan, MB4_CYCLIC_AGS);
    }
    if ((with & MB4_WITH_FULL) == 0 || read->watch->held) {
      mb4_cyclic_add_clear(plan, 0xAAAAU, 4); /* SVALID1 to 8: of the other slaves too */
      if ((with & MB4_WITH_FULL) != 0 && read->spi_check >= MB4_SPI_CHECK_FULL) {
        mb4_cyclic_add_clear(plan, 0xAAAAU, 4); /* no status shows that one was lost */
        read->watch->astray = true;             /* one may go to 0xF5 by one bit */
      }
    } /* else the bank is free, and what waits is good if no line is forced */
  } else if (read->built == plan) {
    read->stage = MB4_STAGE_DATA;
    read->code = MB4_OK;
    /* The last byte that the bus stores; this is no 0xF4. */
    mb4_plan_rx(plan, (uint8_t)(plan->frames - 2))[MB4_STATUS_BYTES] = MB4_NOT_STORED;
  } else {
    (void)mb4_cyclic_try(read, plan, with);
    read->built = read->chain ? plan : 0;
  }
}

/* Constant bits of a status (pages 21, 22): MISO stuck at 0 or 1 fails them. `rx`: the frame. */
static inline bool mb4_status_constant(const uint8_t *rx) {
  return (rx[1] & MB4_CYCLIC_CONST0) != 0 && ((rx[2] | rx[3]) & MB4_CYCLIC_CONST1) == 0;
}

/* Takes a status. Returns MB4_OK, or what is wrong with it. */
static inline uint8_t mb4_cyclic_take_status(mb4_cyclic *read, const mb4_plan *plan,
                                             uint8_t frame) {
  const uint8_t *rx = mb4_plan_rx(plan, frame);
  read->status[0] = rx[1]; /* a loop would take longer and no less code */
  read->status[1] = rx[2];
  read->status[2] = rx[3];
  read->status[3] = rx[4];
  read->status[4] = rx[5];
  if (!mb4_status_constant(rx)) {
    return MB4_NOT_DETECTED;
  }
  read->running = read->access && (rx[1] & MB4_CYCLIC_REGEND) == 0;
  /* The chip must hold exactly what was written; AGS may have ended by an error. Without HOLDBANK
   * the bytes may come from two frames; with SWBANK or INIT they are other data. Unheld, INSTR is
   * that of the access. */
  if (read->unheld) {
    return (rx[5] & MB4_CYCLIC_NO_INSTR) == 0 ? MB4_OK : MB4_CORRUPTED;
  }
  return (rx[5] | MB4_CYCLIC_AGS) == MB4_CYCLIC_HOLD ? MB4_OK : MB4_CORRUPTED;
}

/* The status behind a release. 0xF4 must be AGS alone: the bank is not held, SWBANK has not
 * switched it, no access was started. AGS may have ended by an error. BREAK reads 0, so it is not
 * seen: frames stay away then. Unheld, INSTR is that of the access. Returns the result of the read
 * so far, or what is wrong. */
static inline uint8_t mb4_cyclic_take_proof(const mb4_cyclic *read, const mb4_plan *plan) {
  const uint8_t *rx = mb4_plan_rx(plan, 0);
  uint8_t code = MB4_CORRUPTED;
  if (!mb4_status_constant(rx)) {
    code = MB4_NOT_DETECTED;
  } else if ((read->unheld ? rx[5] & MB4_CYCLIC_NO_INSTR
                           : (rx[5] | MB4_CYCLIC_AGS) ^ MB4_CYCLIC_AGS) == 0 &&
             !mb4_cyclic_forced(plan)) {
    read->watch->held = mb4_cyclic_swapped(read, MB4_WITH_FULL);
    read->watch->astray = false;
    code = MB4_OK;
  }
  return read->code == MB4_OK ? code : read->code;
}

/* Takes the bytes of SCDATAx. */
static inline void mb4_slot_load(const mb4_word *word, mb4_slot *slot, const uint8_t *bytes) {
  uint8_t left = word->bytes;
  uint32_t part = 0;
  bytes += left;
  slot->high = 0;
  if (left > 4) {
    do {
      part = part << 8 | *--bytes;
    } while (--left > 4);
    slot->high = part;
    part = 0;
  }
  do {
    part = part << 8 | *--bytes;
  } while (--left > 0);
  slot->low = part;
}

/* Takes SCDATAx of `word`. With one word it ends frame `frame`; otherwise it is looked for. What is
 * left in rx contradicts itself, so a bus that stores nothing the next time does not make a new
 * word of it. A word without CRC and unused bits stays as it is. True: the frame has sent an
 * address. */
static inline bool mb4_cyclic_load(const mb4_plan *plan, uint8_t frame, const mb4_word *word,
                                   mb4_slot *slot, uint8_t with) {
  uint8_t *last = 0;
  uint8_t offset = (uint8_t)(plan->size[frame] - word->bytes);
  if ((with & MB4_WITH_SEVERAL) != 0) {
    uint8_t header = 0;
    frame = 0xFF;
    do {
      const uint8_t *tx = mb4_plan_tx(plan, ++frame);
      header = tx[0] == MB4_CYCLIC_READ0 ? 1 : tx[0] == MB4_CYCLIC_READ ? 2 : 0xFF;
      offset = (uint8_t)(8 * word->slave - 8 - (header == 2 ? tx[1] : 0));
    } while (offset + header >= plan->size[frame]);
    offset = (uint8_t)(offset + header);
  }
  last = mb4_plan_rx(plan, frame) + offset;
  mb4_slot_load(word, slot, last);
  last += word->bytes - 1;
  *last = (uint8_t)((*last ^ word->flip) | word->guard);
  return mb4_plan_tx(plan, frame)[0] == MB4_CYCLIC_READ;
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

/* The word in `slot`. False: it contradicts itself, in its CRC, which the chip has stored in the
 * top byte(s) (page 26), or in bits that the chip makes 0. */
MB4_APART bool mb4_slot_good(const mb4_word *word, mb4_slot *slot, uint8_t with) {
  uint32_t low = slot->low;
  uint32_t high = slot->high;
  const bool fits = mb4_cyclic_cut(word, &low, &high, with);
  slot->crc = 0;
  if (word->crc_bits == 0) {
    return fits;
  }
  slot->crc = mb4_word_crc(word, low, high, with);
  return fits && slot->crc == (uint16_t)(slot->high >> (word->crc_bits > 8 ? 16 : 24));
}

/* The last bits, nE and nW, as the slave sent them. With Gray code the chip converts the flags
 * together with the position. */
static inline uint32_t mb4_slot_flags(const mb4_word *word, const mb4_slot *slot, uint8_t with) {
  return (with & MB4_WITH_GRAY) != 0 && word->gray ? slot->low ^ slot->low >> 1 : slot->low;
}

/* A slot with MB4_OK whose nE is 0 becomes MB4_SLAVE_ERROR. Returns its code. */
static inline uint8_t mb4_slot_tell(const mb4_word *word, mb4_slot *slot, uint8_t with) {
  if (slot->code == MB4_OK && word->flags && (mb4_slot_flags(word, slot, with) & 2U) == 0) {
    slot->code = MB4_SLAVE_ERROR;
  }
  return slot->code;
}

/* Works out the reading of a slot with MB4_OK or MB4_SLAVE_ERROR. */
static inline void mb4_slot_reading(const mb4_word *word, const mb4_slot *slot,
                                    mb4_reading *reading, uint8_t with) {
  uint32_t low = slot->low;
  uint32_t high = slot->high;
  const uint32_t sent = mb4_slot_flags(word, slot, with);
  (void)mb4_cyclic_cut(word, &low, &high, with);
  reading->crc_stored = word->crc_bits != 0;
  reading->crc = slot->crc;
  reading->slave = word->slave;
  reading->slave_error = word->flags && (sent & 2U) == 0;
  reading->slave_warning = word->flags && (sent & 1U) == 0;
  if (word->flags) {
    reading->raw = (uint64_t)high << 32 | ((low & ~(uint32_t)3) | (sent & 3U));
    low = low >> 2 | high << 30;
    high >>= 2;
    reading->position = (uint64_t)high << 32 | low;
  } else {
    reading->raw = (uint64_t)high << 32 | low;
    reading->position = reading->raw;
  }
}

/* FULL: data that only a second reading proves, also if opcode 0x09 has read it. Without a stored
 * CRC this is any data. With a CRC it is all zeros and all ones: a line that was stuck for a moment
 * makes them, and the CRC may accept them. So may a CRC of 8 or 16 bits whose last byte is what a
 * bus leaves there that has not stored all bytes. */
static inline bool mb4_slot_needs_second(const mb4_word *word, const mb4_slot *slot, uint8_t with) {
  uint32_t low = slot->low;
  uint32_t high = slot->high;
  uint32_t ones_low = 0xFFFFFFFFU;
  uint32_t ones_high = 0xFFFFFFFFU;
  if (word->crc_bits == 0) {
    return true;
  }
  (void)mb4_cyclic_cut(word, &low, &high, with);
  (void)mb4_cyclic_cut(word, &ones_low, &ones_high, with);
  return (low | high) == 0 || (low == ones_low && high == ones_high) ||
         slot->high >> 24 == MB4_NOT_STORED;
}

/* A bad word that is all 0 on the line. Its data bits are 0, and so are the bits of its CRC, which
 * the chip inverts before it stores them (page 26): they are all 1. */
static inline bool mb4_slot_blank(const mb4_word *word, const mb4_slot *slot, uint8_t with) {
  const uint32_t crc = ((uint32_t)1 << word->crc_bits) - 1;
  uint32_t low = slot->low;
  uint32_t high = slot->high;
  return word->line != 0 && mb4_cyclic_cut(word, &low, &high, with) && (low | high) == 0 &&
         (crc == 0 || slot->high >> (crc > 0xFF ? 16 : 24) == crc);
}

/* Takes the data of this try; that of the slaves `flags` is new. FULL: returns the slaves of which
 * only a second reading proves it. */
static inline uint16_t mb4_cyclic_take(mb4_cyclic *read, const mb4_plan *plan, uint8_t frame,
                                       uint16_t flags, uint8_t with) {
  uint16_t second = 0;
  uint8_t i = 0;
  for (; i < mb4_cyclic_count(read, with); ++i) {
    const mb4_word *word = &read->words[i];
    mb4_slot *slot = &read->slots[i];
    bool addressed = false;
    if (!mb4_word_in(word, read->flags, with)) {
      continue;
    }
    addressed = mb4_cyclic_load(plan, frame, word, slot, with);
    if (mb4_word_in(word, flags, with)) {
      slot->code = mb4_slot_good(word, slot, with) ? MB4_OK : MB4_CORRUPTED;
      /* A disturbed address reads SCDATA of another slave, whose CRC fits too, or an old one. */
      if ((with & MB4_WITH_FULL) != 0 && read->spi_check >= MB4_SPI_CHECK_FULL &&
          slot->code == MB4_OK && (addressed || mb4_slot_needs_second(word, slot, with))) {
        second = (uint16_t)(second | mb4_word_flag(word));
      }
    }
  }
  return second;
}

/* The second reading of the slaves `flags`. */
static inline void mb4_cyclic_compare(mb4_cyclic *read, const mb4_plan *plan, uint8_t frame,
                                      uint16_t flags, uint8_t with) {
  uint8_t i = 0;
  for (; i < mb4_cyclic_count(read, with); ++i) {
    mb4_slot *slot = &read->slots[i];
    mb4_slot other;
    if (mb4_word_in(&read->words[i], flags, with)) {
      (void)mb4_cyclic_load(plan, frame, &read->words[i], &other, with);
      if (other.low != slot->low || other.high != slot->high) {
        slot->code = MB4_CORRUPTED;
      }
    }
  }
}

/* For a single frame, whose bad words have MB4_CRC: the slaves with SVALID, and those whose bad
 * word may be all 0. Then, once the data is taken, it looks for such a word and keeps those with
 * SVALID.
 */
static inline uint16_t mb4_cyclic_readable(const mb4_cyclic *read, uint8_t with) {
  uint16_t flags = mb4_cyclic_valid(read);
  uint8_t i = 0;
  for (; i < mb4_cyclic_count(read, with); ++i) {
    if (read->slots[i].code == MB4_CRC && read->words[i].line != 0) {
      flags = (uint16_t)(flags | mb4_word_flag(&read->words[i]));
    }
  }
  return flags;
}

static inline void mb4_cyclic_find_blank(mb4_cyclic *read, uint8_t with) {
  const uint16_t valid = mb4_cyclic_valid(read);
  const uint16_t bad = (uint16_t)(read->flags & ~(unsigned)valid);
  uint8_t i = 0;
  for (; i < mb4_cyclic_count(read, with); ++i) {
    if (mb4_word_in(&read->words[i], bad, with) &&
        mb4_slot_blank(&read->words[i], &read->slots[i], with)) {
      read->blank = (uint16_t)(read->blank | mb4_word_flag(&read->words[i]));
    }
  }
  read->flags = valid;
}

/* The last byte of a bad word that was told: its CRC with all bits but one wrong. So it can never
 * be good, whatever single bit of a transfer flips, and with a CRC that leaves bits free the chip
 * does not make it. It is not 0xFF, the CRC of a word that is all 0. */
static inline uint8_t mb4_slot_mark(const mb4_word *word, const mb4_slot *slot) {
  const uint8_t crc = (uint8_t)(slot->crc >> word->crc_high);
  return crc != 1U ? (uint8_t)(crc ^ 0xFE) : (uint8_t)0x7E;
}

/* The bad word has been told. A CRC of 8 or 16 bits leaves no bit free, so one in 256 bad words
 * looks as if it had the mark; with MB4_WITH_BEATS only one with the same data. */
static inline bool mb4_slot_told(const mb4_cyclic *read, const mb4_word *word, const mb4_slot *slot,
                                 uint8_t with) {
  return slot->high >> 24 == mb4_slot_mark(word, slot) &&
         ((with & MB4_WITH_BEATS) == 0 ||
          read->watch->told[word->slave - 1] == (uint16_t)slot->low);
}

/* The words in the held bank without SVALID, and the last frame was bad. A word with a stored CRC
 * tells whether it is the bad one; otherwise it was good and has been read before. A word without a
 * stored CRC cannot tell. It is the bad one if there is no other slave; or if two facts come
 * together: a good word of another slave (`news`) shows that the frame is new, and no read of one
 * slave has taken this word of the same frame. */
static inline void mb4_cyclic_judge(mb4_cyclic *read, uint16_t missing, bool news, uint8_t with) {
  uint8_t i = 0;
  for (; i < mb4_cyclic_count(read, with); ++i) {
    const mb4_word *word = &read->words[i];
    mb4_slot *slot = &read->slots[i];
    if (!mb4_word_in(word, missing, with)) {
      continue;
    }
    if (word->crc_bits == 0) {
      const bool several = (with & MB4_WITH_SEVERAL) != 0 && read->watch->several;
      read->unproven = true;
      if (!several || (news && (read->watch->taken >> (word->slave - 1) & 1) == 0)) {
        slot->code = MB4_CRC;
      }
    } else if (!mb4_slot_good(word, slot, with) && !mb4_slot_told(read, word, slot, with)) {
      slot->code = MB4_CRC;
      slot->bad = true;
      read->bad = true;
    }
    if ((with & MB4_WITH_BEATS) != 0 && slot->code == MB4_CRC && mb4_slot_blank(word, slot, with)) {
      read->blank = (uint16_t)(read->blank | mb4_word_flag(word));
    }
  }
}

/* Marks the bad words of the held bank, so that they count once; the next frame overwrites them.
 * FULL: not where one disturbed bit of the address would change a register of an access. */
static inline void mb4_cyclic_mark(mb4_cyclic *read, mb4_plan *plan, uint8_t with) {
  uint8_t i = 0;
  if ((with & MB4_WITH_FULL) != 0 && read->spi_check >= MB4_SPI_CHECK_FULL && read->access) {
    read->bad = false; /* it may be the bad word of before: no proof that frames come */
    return;
  }
  for (; i < mb4_cyclic_count(read, with); ++i) {
    const mb4_word *word = &read->words[i];
    const mb4_slot *slot = &read->slots[i];
    if (slot->bad) {
      if ((with & MB4_WITH_BEATS) != 0) {
        read->watch->told[word->slave - 1] = (uint16_t)slot->low;
      }
      (void)mb4_plan_add(plan, 3, MB4_CYCLIC_WRITE, (uint8_t)(8 * word->slave - 1),
                         mb4_slot_mark(word, slot));
    }
  }
}

/* In a chain the bank is free already. It must be held while bad words are marked, so they are read
 * once more. */
static inline uint8_t mb4_cyclic_end_chain(mb4_cyclic *read, mb4_plan *plan, uint8_t with) {
  uint8_t i = 0;
  if (!read->bad) {
    return MB4_OK;
  }
  read->again = true;
  for (; i < mb4_cyclic_count(read, with); ++i) {
    mb4_slot *slot = &read->slots[i];
    if ((with & MB4_WITH_SEVERAL) != 0 && !slot->bad) {
      read->flags = (uint16_t)(read->flags & ~mb4_word_flag(&read->words[i]));
      read->one_frame = read->one_frame && slot->code != MB4_OK;
    }
    slot->bad = false;
  }
  return mb4_cyclic_try(read, plan, with);
}

/* Data and status of a held bank are here. */
static inline uint8_t mb4_cyclic_held(mb4_cyclic *read, mb4_plan *plan, uint8_t frame,
                                      uint8_t with) {
  const bool full = (with & MB4_WITH_FULL) != 0 && read->spi_check >= MB4_SPI_CHECK_FULL;
  const uint16_t valid = mb4_cyclic_valid(read);
  const uint16_t fresh = full ? read->fresh : 0;
  const uint16_t second =
      mb4_cyclic_take(read, plan, frame, full ? (uint16_t)(valid & fresh) : valid, with);
  if (mb4_cyclic_frame_bad(read)) {
    mb4_cyclic_judge(read, (uint16_t)(read->flags & ~(valid | fresh)), valid != 0, with);
  }
  if (read->chain && !read->again) {
    return mb4_cyclic_end_chain(read, plan, with);
  }
  (void)mb4_cyclic_next(read, plan, MB4_STAGE_END, MB4_OK);
  mb4_cyclic_mark(read, plan, with);
  if (full) {
    /* One disturbed bit of a status must not drop a new word: without both the word waits. */
    read->flags = (uint16_t)(valid & fresh);
  }
  if (full && read->flags != 0) {
    read->stage = MB4_STAGE_CLEAR;
    read->fresh = second;
    if (second != 0) {
      mb4_cyclic_add_data(read, plan, second, with);
    }
    mb4_cyclic_add_clear(plan, read->flags, 4);
    mb4_cyclic_add_status(plan);
  } else if (valid != 0 && !full) {
    mb4_cyclic_add_clear(plan, read->flags, 6);
  } else {
    if ((with & MB4_WITH_SEVERAL) != 0) {
      read->one_frame = true; /* no word has come since the first try */
    }
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
  if (!read->again) {
    read->again = true;
    return mb4_cyclic_try(read, plan, with);
  }
  return code;
}

static inline uint8_t mb4_cyclic_take_unheld(mb4_cyclic *read, mb4_plan *plan, uint8_t with) {
  const bool repeated = mb4_plan_tx(plan, 0)[0] != MB4_CYCLIC_WRITE;
  const uint8_t frame = (uint8_t)(plan->frames - 2);
  const uint8_t code = mb4_cyclic_take_status(read, plan, (uint8_t)(plan->frames - 1));
  if (code != MB4_OK) {
    return code;
  }
  if (mb4_cyclic_valid(read) != 0 || mb4_cyclic_frame_bad(read)) {
    read->watch->astray = (with & MB4_WITH_FULL) != 0 &&
                          read->spi_check >= MB4_SPI_CHECK_FULL; /* or a frame has ended */
    mb4_cyclic_all(read, with);
    return mb4_cyclic_unheld(read, plan, MB4_BANK_SWITCHED, with);
  }
  if (repeated) {
    mb4_cyclic_compare(read, plan, frame, read->fresh, with);
    return MB4_OK;
  }
  read->fresh = mb4_cyclic_take(read, plan, frame, read->fresh, with);
  if (read->fresh == 0) {
    return MB4_OK;
  }
  (void)mb4_cyclic_next(read, plan, MB4_STAGE_UNHELD, MB4_OK);
  mb4_cyclic_add_data(read, plan, read->fresh, with);
  mb4_cyclic_add_status(plan);
  return MB4_MORE;
}

/* LOOK: is there a new frame? */
static inline uint8_t mb4_cyclic_take_look(mb4_cyclic *read, mb4_plan *plan, uint8_t with) {
  const bool unheld = (with & MB4_WITH_UNHELD) != 0 && read->unheld;
  uint8_t frame = unheld ? 0 : 1;
  uint8_t code = MB4_OK;
  read->fresh = read->flags;
  for (; frame < plan->frames && code == MB4_OK; ++frame) {
    code = mb4_cyclic_take_status(read, plan, frame);
    read->fresh = (uint16_t)(read->fresh & mb4_cyclic_valid(read));
  }
  if (unheld) {
    if (code == MB4_OK && mb4_cyclic_forced(plan)) {
      code = MB4_CORRUPTED;
    }
    if (code != MB4_OK) {
      return code;
    }
    read->watch->astray = false;
    if (read->fresh == 0) {
      return mb4_cyclic_unheld(read, plan, MB4_OK, with);
    }
    (void)mb4_cyclic_next(read, plan, MB4_STAGE_UNHELD, MB4_OK);
    mb4_cyclic_add_clear(plan, read->fresh, 4);
  } else {
    if (code != MB4_OK || (read->fresh == 0 && !mb4_cyclic_frame_bad(read))) {
      return mb4_cyclic_release(read, plan, code);
    }
    (void)mb4_cyclic_next(read, plan, MB4_STAGE_SECOND, MB4_OK);
  }
  mb4_cyclic_add_data(read, plan, read->flags, with);
  mb4_cyclic_add_status(plan);
  return MB4_MORE;
}

/* CLEAR: was the second reading the same, and is SVALID 0? The chip takes some system clocks for
 * this, so the status is read twice before it counts as a fault. */
static inline uint8_t mb4_cyclic_take_clear(mb4_cyclic *read, mb4_plan *plan, uint8_t with) {
  const bool last = plan->frames == 1;
  uint8_t code = mb4_cyclic_take_status(read, plan, (uint8_t)(plan->frames - 1));
  if (!last && read->fresh != 0) {
    mb4_cyclic_compare(read, plan, (uint8_t)(plan->frames - 3), read->fresh, with);
  }
  if (code == MB4_OK && mb4_cyclic_valid(read) != 0) {
    if (!last) {
      (void)mb4_cyclic_next(read, plan, MB4_STAGE_CLEAR, MB4_OK);
      mb4_cyclic_add_status(plan);
      return MB4_MORE;
    }
    code = MB4_CORRUPTED;
    read->watch->astray = true;
  }
  return mb4_cyclic_release(read, plan, code);
}

/* Reads 0xF0..0xF8. A byte of 0xF8 that the bus does not store is no idle line. */
static inline void mb4_cyclic_add_lines(mb4_plan *plan) {
  (void)mb4_plan_add(plan, 1 + MB4_CYCLIC_LINES, MB4_CYCLIC_STATUS, 0, 0);
  mb4_plan_rx(plan, (uint8_t)(plan->frames - 1))[MB4_CYCLIC_LINES] = 0;
}

/* A word was all 0, and 0xF0..0xF8 are in `rx`. Its slave has sent nothing if SL of its line is 1.
 * True: a line is still 0. */
static inline bool mb4_cyclic_tell_blank(mb4_cyclic *read, const uint8_t *rx, uint8_t with) {
  bool more = false;
  uint8_t i = 0;
  for (; i < mb4_cyclic_count(read, with); ++i) {
    const mb4_word *word = &read->words[i];
    mb4_slot *slot = &read->slots[i];
    if (slot->code == MB4_CRC && mb4_word_in(word, read->blank & 0xFFFEU, with)) {
      if ((rx[MB4_CYCLIC_LINES] & word->line) != 0) {
        slot->code = MB4_NO_WORD;
        read->blank |= 1U;
      } else {
        more = true;
      }
    }
  }
  return more;
}

/* BLANK: in the slave's timeout and in a frame SL is 0, so the driver looks twice. */
static inline bool mb4_cyclic_take_blank(mb4_cyclic *read, mb4_plan *plan, uint8_t with) {
  bool more = true;
  if (read->stage != MB4_STAGE_BLANK) {
    read->fresh = 1; /* one more */
  } else {
    more = mb4_cyclic_tell_blank(read, mb4_plan_rx(plan, 0), with) && read->fresh != 0;
    read->fresh = 0;
  }
  if (more) {
    (void)mb4_cyclic_next(read, plan, MB4_STAGE_BLANK, MB4_OK);
    mb4_cyclic_add_lines(plan);
  }
  return more;
}

/* The slots tell the result. Returns the code of the read. */
static inline uint8_t mb4_cyclic_tell(mb4_cyclic *read, uint32_t now_us, uint8_t with) {
  mb4_watch *watch = read->watch;
  const bool several = (with & MB4_WITH_SEVERAL) != 0 && watch->several;
  uint8_t result = MB4_NO_DATA;
  uint8_t i = 0;
  if ((with & MB4_WITH_SEVERAL) != 0) {
    read->told = true;
  }
  for (; i < mb4_cyclic_count(read, with); ++i) {
    mb4_slot *slot = &read->slots[i];
    const uint8_t index = (uint8_t)(read->words[i].slave - 1);
    if (several && slot->code == MB4_OK) {
      watch->taken = (uint8_t)(read->count > 1 ? 0 : watch->taken | 1U << index);
      watch->good_us[index] = now_us;
    } else if (several && read->unproven && read->words[i].crc_bits == 0 &&
               now_us - watch->good_us[index] > watch->omitted_us) {
      /* Other slaves keep news_us young. Bad frames without a good word of this one are its own. */
      slot->code = MB4_CRC;
    }
    if (mb4_slot_tell(&read->words[i], slot, with) == MB4_SLAVE_ERROR) {
      read->slave_error = true;
      result = result == MB4_OK ? result : slot->code;
    } else if (result == MB4_NO_DATA || slot->code == MB4_OK) {
      result = slot->code;
    }
  }
  return result;
}

/* The result is `code`, or what the slots tell. Frames that stay away for too long turn it into an
 * alarm. A word that is new, good or bad, proves that frames come. nSCDERR = 0 stays when no more
 * frames end, so a bad frame without a stored CRC proves nothing. */
static inline uint8_t mb4_cyclic_watch(mb4_cyclic *read, mb4_plan *plan, uint8_t code,
                                       uint32_t now_us, uint8_t with) {
  mb4_watch *watch = read->watch;
  const bool omitted = (read->status[0] & MB4_CYCLIC_AGSERR) == 0;
  uint32_t limit_us = 0;
  if (code == MB4_OK) {
    code = mb4_cyclic_tell(read, now_us, with);
  }
  if (code == MB4_OK || read->slave_error || read->unheld || read->bad || code == MB4_CORRUPTED) {
    watch->news_us = now_us;
    return code;
  }
  limit_us = omitted || read->unproven ? watch->omitted_us : watch->silent_us;
  if ((code != MB4_NO_DATA && code != MB4_CRC &&
       ((with & MB4_WITH_BEATS) == 0 || code != MB4_NO_WORD)) ||
      watch->silent_us == MB4_NEVER || now_us - watch->news_us <= limit_us) {
    return code;
  }
  if (!read->unproven || omitted) {
    code = MB4_TIMEOUT;
  } else if ((with & MB4_WITH_BEATS) != 0 && code == MB4_NO_WORD) {
    return code; /* this read has seen SL = 1 */
  } else {
    code = MB4_CRC;
  }
  (void)mb4_cyclic_next(read, plan, MB4_STAGE_LINES, code);
  if ((with & MB4_WITH_SEVERAL) != 0) {
    read->told = false;
  }
  if ((with & MB4_WITH_BEATS) != 0) {
    (void)mb4_plan_add(plan, 1 + MB4_CYCLIC_BANKS, MB4_CYCLIC_STATUS, 0, 0);
    mb4_plan_rx(plan, 0)[MB4_CYCLIC_BANKS] = 0;
    mb4_plan_rx(plan, 0)[MB4_CYCLIC_LINES] = 0;
    mb4_cyclic_add_status(plan);
  } else {
    mb4_cyclic_add_lines(plan);
  }
  return MB4_MORE;
}

/* LINES: why do frames stay away? All may be well: a loop whose reads always meet the end of a
 * frame sees none. Then a frame ends now, or SWBANKFAIL = 1 says that one was lost because the bank
 * was held. The flag stays 1 if the system clock stops, so it only makes the limit four times as
 * long.
 */
static inline uint8_t mb4_cyclic_take_lines(mb4_cyclic *read, const mb4_plan *plan, uint32_t now_us,
                                            uint8_t with) {
  const mb4_watch *watch = read->watch;
  const uint8_t *rx = mb4_plan_rx(plan, 0);
  if ((with & MB4_WITH_BEATS) != 0 && read->code == MB4_TIMEOUT) {
    const bool lost = (rx[MB4_CYCLIC_BANKS] & MB4_CYCLIC_BANKFAIL) != 0 &&
                      (rx[1] & MB4_CYCLIC_AGSERR) != 0 &&
                      now_us - watch->news_us <= 4 * watch->silent_us;
    const bool ended =
        mb4_cyclic_take_status(read, plan, 1) != MB4_NOT_DETECTED && mb4_cyclic_valid(read) != 0;
    if (lost || ended) {
      if ((with & MB4_WITH_SEVERAL) != 0) {
        read->told = true;
      }
      return MB4_NO_DATA;
    }
  }
  return (rx[MB4_CYCLIC_LINES] & watch->lines) == watch->lines ? read->code
                                                               : (uint8_t)MB4_LINE_ERROR;
}

/* FREE: the bank that was still held is free. */
static inline uint8_t mb4_cyclic_take_free(mb4_cyclic *read, mb4_plan *plan, bool transferred,
                                           uint32_t now_us, uint8_t with) {
  read->watch->news_us = now_us; /* no bank was switched meanwhile */
  if (!transferred) {
    return MB4_TRANSPORT;
  }
  if ((with & MB4_WITH_FULL) != 0 && read->watch->astray) {
    /* A bank that was held stays so until the proof: the clears may have met it. */
    return mb4_cyclic_prove(read, plan, MB4_STAGE_PROVE_FREE, read->code);
  }
  read->watch->held = false;
  return mb4_cyclic_try(read, plan, with);
}

/* END: the release of the bank was the last frame. If it was not alone, it may not have been tried.
 */
static inline uint8_t mb4_cyclic_take_end(mb4_cyclic *read, mb4_plan *plan, bool transferred,
                                          uint8_t with) {
  if (!transferred && (plan->frames > 1 || plan->size[0] > 2)) {
    return mb4_cyclic_release(read, plan, MB4_TRANSPORT);
  }
  /* The bank counts as held until it is known to be free. */
  read->watch->held =
      !transferred || mb4_cyclic_proves(read, with) || mb4_cyclic_swapped(read, with);
  if (transferred && mb4_cyclic_proves(read, with)) {
    return mb4_cyclic_prove(read, plan, MB4_STAGE_PROVE_END, read->code);
  }
  return transferred ? read->code : (uint8_t)MB4_TRANSPORT;
}

/* DATA, and with FULL LOOK, SECOND and CLEAR: the bank is held. */
static inline uint8_t mb4_cyclic_take_held(mb4_cyclic *read, mb4_plan *plan, bool transferred,
                                           uint8_t with) {
  const uint8_t end = read->chain && !read->again ? 2 : 1;
  const uint8_t frame = (uint8_t)(plan->frames - end);
  uint8_t code = MB4_TRANSPORT;
  if (!transferred) {
    return mb4_cyclic_release(read, plan, code);
  }
  if ((with & MB4_WITH_FULL) != 0 && read->stage == MB4_STAGE_LOOK) {
    return mb4_cyclic_take_look(read, plan, with);
  }
  if ((with & MB4_WITH_FULL) != 0 && read->stage == MB4_STAGE_CLEAR) {
    return mb4_cyclic_take_clear(read, plan, with);
  }
  code = mb4_cyclic_take_status(read, plan, frame);
  if (code != MB4_OK) {
    return mb4_cyclic_release(read, plan, code);
  }
  return mb4_cyclic_held(read, plan, (uint8_t)(frame - 1), with);
}

/* mb4_cyclic_finish() without the counts. */
static inline uint8_t mb4_cyclic_step(mb4_cyclic *read, mb4_plan *plan, bool transferred,
                                      uint32_t now_us, uint8_t with) {
  const uint8_t stage = read->stage;
  uint8_t code = transferred ? read->code : (uint8_t)MB4_TRANSPORT;
  if (stage == MB4_STAGE_LINES) {
    return transferred ? mb4_cyclic_take_lines(read, plan, now_us, with) : code;
  }
  if ((with & MB4_WITH_BEATS) != 0 && stage == MB4_STAGE_BLANK) {
    /* The words are here: without the look they are bad ones. */
    return transferred && mb4_cyclic_take_blank(read, plan, with)
               ? (uint8_t)MB4_MORE
               : mb4_cyclic_watch(read, plan, MB4_OK, now_us, with);
  }
  if (stage == MB4_STAGE_FREE) {
    return mb4_cyclic_take_free(read, plan, transferred, now_us, with);
  }
  if (stage == MB4_STAGE_END) {
    code = mb4_cyclic_take_end(read, plan, transferred, with);
  } else if ((with & MB4_WITH_FULL) != 0 && stage >= MB4_STAGE_PROVE_END) {
    code = transferred ? mb4_cyclic_take_proof(read, plan) : code;
    if (stage == MB4_STAGE_PROVE_FREE && code == MB4_OK) {
      return mb4_cyclic_try(read, plan, with);
    }
  } else if ((with & MB4_WITH_UNHELD) != 0 && read->unheld) {
    if (transferred) {
      code = stage == MB4_STAGE_LOOK ? mb4_cyclic_take_look(read, plan, with)
                                     : mb4_cyclic_take_unheld(read, plan, with);
    }
  } else {
    code = mb4_cyclic_take_held(read, plan, transferred, with);
  }
  if (code == MB4_MORE || ((with & MB4_WITH_BEATS) != 0 && code == MB4_OK && read->blank != 0 &&
                           mb4_cyclic_take_blank(read, plan, with))) {
    return MB4_MORE;
  }
  return mb4_cyclic_watch(read, plan, code, now_us, with);
}

/* A new word is here: how many samples have passed since the one before? */
static inline void mb4_counts_take_sample(mb4_counts *counts, uint32_t now_us) {
  const uint32_t period_ns = counts->period_ns;
  const uint32_t before_ns = counts->rest_ns;
  uint32_t left_us = now_us - counts->last_us;
  uint32_t periods = 0;
  uint32_t phase_ns = 0;
  counts->last_us = now_us;
  if (counts->sequence == 0 || period_ns == 0) {
    ++counts->sequence;
    counts->rest_ns = period_ns / 2;
    return;
  }
  do {
    const uint32_t part_us = left_us > 2000000U ? 2000000U : left_us;
    const uint32_t time_ns = counts->rest_ns + part_us * 1000U;
    periods += time_ns / period_ns;
    counts->rest_ns = time_ns % period_ns;
    left_us -= part_us;
  } while (left_us != 0);
  /* Rounded to whole periods, is the time since the last good read the same number? */
  phase_ns = counts->rest_ns + period_ns / 2;
  if (periods == 0) { /* a new word is a new sample */
    periods = 1;
    counts->rest_ns = 0;
  } else if (phase_ns < before_ns || phase_ns - before_ns >= period_ns) {
    ++counts->doubtful;
  }
  counts->sequence += periods;
  counts->lost += periods - 1;
}

/* A read has ended with `code`. */
MB4_APART void mb4_cyclic_count_read(const mb4_cyclic *read, uint8_t code, uint32_t now_us) {
  mb4_counts *counts = read->watch->counts;
  const uint32_t period_ns = counts->period_ns;
  const uint32_t since_us = now_us - counts->read_us;
  if (counts->read_us != 0 && period_ns != 0 && since_us > period_ns / 1000 * 3 / 2) {
    ++counts->late;
  }
  counts->read_us = now_us | 1U;
  if (code != MB4_TRANSPORT && code != MB4_NOT_DETECTED) { /* there is a status */
    counts->omits = counts->omits || (read->status[0] & MB4_CYCLIC_AGSERR) == 0;
  }
  if ((read->blank & 1U) != 0) {
    ++counts->no_word;
  } else if (read->bad || code == MB4_CRC) {
    ++counts->crc;
  } else if (code == MB4_BANK_SWITCHED) {
    ++counts->switched;
  } else if (code != MB4_OK && code != MB4_NO_DATA && code != MB4_SLAVE_ERROR) {
    ++counts->faults;
  }
  if (read->slave_error) {
    ++counts->slave_errors;
  }
  if (code == MB4_OK) {
    ++counts->good;
  } else if (code != MB4_SLAVE_ERROR) {
    return;
  }
  mb4_counts_take_sample(counts, now_us);
}

/* Takes what came back. `transferred`: all frames of the plan were made, in order. `now_us`: the
 * time, a counter of microseconds that wraps at 2^32. `with`: MB4_WITH_..., a constant.
 *
 * Returns MB4_MORE (make the frames of the new plan, then call it again) or the result, which is
 * that of the slave, or of all (`told` is false). With several slaves it is MB4_OK if one slot is,
 * else MB4_SLAVE_ERROR if one slot is; look at the code of each slot before its position is used:
 *
 *   MB4_OK             mb4_slot_reading() gives the new position
 *   MB4_SLAVE_ERROR    a new word whose nE is 0: mb4_slot_reading() gives it, but its position is
 *                      not to be trusted. In every other way the word is as good as with MB4_OK
 *   MB4_NO_DATA        no frame with data of this slave has ended since the last read
 *   MB4_CRC            one has, and its CRC was wrong; told once for each frame, FULL beside a
 *                      register access by each read until the next frame. Without a stored CRC: by
 *                      each read until a frame is good, if the slave is the only one
 *   MB4_NO_WORD        as MB4_CRC, and the word of a slave of mb4_word_biss_c() is all 0, CRC too
 *                      (without a stored one all data bits), while SL is 1 again: the slave
 *                      acknowledges and sends nothing. With MB4_WITH_BEATS
 *   MB4_UNSUPPORTED    mb4_cyclic_check() has not allowed `with`
 *   MB4_CORRUPTED, MB4_NOT_DETECTED, MB4_TRANSPORT, MB4_BANK_SWITCHED, MB4_TIMEOUT, MB4_LINE_ERROR
 *                      as Automatic::poll() in mb4/automatic.hpp describes them
 *
 * At most five calls a read; seven with MB4_SPI_CHECK_FULL or unheld, eight with
 * MB4_SPI_CHECK_FULL_AND_RELEASE. After a read that has ended without the release of the bank one
 * more, with MB4_SPI_CHECK_FULL and above two; these too after one whose SVALID = 0 was not seen.
 * MB4_CORRUPTED that does not end may be an MA line that such a write has forced: start the frames
 * anew.
 * A read may be given up: call this function with transferred = false, without the frames, until it
 * does not return MB4_MORE. */
static inline uint8_t mb4_cyclic_finish(mb4_cyclic *read, mb4_plan *plan, bool transferred,
                                        uint32_t now_us, uint8_t with) {
  uint8_t code = MB4_UNSUPPORTED;
  if (read->parts != mb4_cyclic_parts(with)) {
    return code;
  }
  code = mb4_cyclic_step(read, plan, transferred, now_us, with);
  if ((with & MB4_WITH_COUNTS) != 0 && code != MB4_MORE && read->watch->counts != 0) {
    mb4_cyclic_count_read(read, code, now_us);
  }
  return code;
}

#undef MB4_APART

#ifdef __cplusplus
}
#endif

#endif /* MB4_CYCLIC_H_ */
