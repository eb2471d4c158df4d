/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What lib.rs calls: the read path of mb4_cyclic.h for one BiSS C encoder at slave 1, and the
 * registers that it needs. The memory of a read belongs to Rust, which may move it between two
 * calls of openmb4_plan(). No function makes a transfer.
 */
#include "mb4_cyclic.h"

enum {
  FIRST = MB4_ADDR_SLAVE_CFG, /* of the image, which ends with the interface byte */
  IMAGE_BYTES = MB4_ADDR_IFACE - FIRST + 1,
  HEADER = 2, /* opcode and address, in front of the image in an SPI frame */
  /* Words of up to 64 bits, each check of SPI, counts, closer looks. Left out: what SSI, register
   * accesses and several encoders need, and the table of the CRC. */
  PARTS = MB4_WITH_LONG | MB4_WITH_FULL | MB4_WITH_COUNTS | MB4_WITH_BEATS,
  STEP_US = 33 /* the coarsest step of the caller's clock, rounded up */
};

/* The same members in the same order as in lib.rs: Config, Reading, Counts. */
typedef struct {
  uint32_t f_clk_hz;
  uint32_t max_ma_hz;
  uint32_t frame_period_ns;
  uint32_t crc_polynomial;
  uint16_t crc_start;
  uint8_t data_bits;
  uint8_t spi_check;
  bool error_warning;
  bool internal_clock;
  bool on_pin;
} openmb4_config;

typedef struct {
  uint64_t position;
  uint64_t raw;
  bool warning;
} openmb4_reading;

typedef struct {
  uint32_t good, slave_errors, crc, no_word, lost, sequence, late, faults, doubtful;
  bool omits;
} openmb4_counts;

/* The memory behind Encoder::memory. */
typedef struct {
  mb4_word word;
  mb4_watch watch;
  mb4_slot slot;
  mb4_cyclic read;
  mb4_counts counts;
  mb4_plan plan;
  uint32_t tx[MB4_PLAN_WORDS(1)];
  uint32_t rx[MB4_PLAN_WORDS(1)];
  bool started; /* since the last read */
} openmb4_encoder;

uint8_t openmb4_begin(openmb4_encoder *encoder, uint32_t bytes, const openmb4_config *config,
                      uint8_t *image);
void openmb4_started(openmb4_encoder *encoder);
uint8_t openmb4_compare(const uint8_t *image, const uint8_t *rx, bool running);
uint8_t openmb4_plan(openmb4_encoder *encoder, uint32_t now_us);
uint8_t openmb4_frame(const openmb4_encoder *encoder, uint8_t frame, const uint8_t **tx,
                      uint8_t **rx);
uint8_t openmb4_finish(openmb4_encoder *encoder, bool transferred, uint32_t now_us);
void openmb4_reading_of(const openmb4_encoder *encoder, openmb4_reading *reading);
void openmb4_counts_of(const openmb4_encoder *encoder, openmb4_counts *counts);

/* Degree of a polynomial: the width of its CRC. */
static uint8_t width_of(uint32_t polynomial) {
  uint8_t width = 0;
  while (polynomial >> 1 >> width != 0) {
    ++width;
  }
  return width;
}

/* The register of SELCRCSx and SCRCLENx, or 0xFF: the chip does not have this polynomial (table
 * 14). A width selects a fixed polynomial; others are stored without their lowest bit, which is 1. */
static uint8_t crc_code(uint32_t polynomial) {
  static const uint32_t fixed[] = {0, 0x0B, 0x13, 0x25, 0x43, 0x89, 0x12F, 0x190D9};
  uint8_t i = 0;
  for (; i < sizeof fixed / sizeof fixed[0]; ++i) {
    if (polynomial == fixed[i]) {
      return width_of(polynomial);
    }
  }
  if (polynomial < 3 || polynomial > 0xFF || (polynomial & 1U) == 0) {
    return 0xFF;
  }
  return (uint8_t)(MB4_SELCRCS_MASK(1U) | polynomial >> 1);
}

/* f_CLK / f_MA of the fastest code of FREQS that is not above max_ma_hz (table 35), 0: none. */
static uint32_t ma_divider(const openmb4_config *config, uint8_t *freqs) {
  uint8_t code = 0;
  for (; code <= MB4_FREQS_MASK; ++code) {
    const uint32_t divider = code < 0x10 ? 2U * (code + 1U) : 20U * (code - 15U);
    if (code != 0x10 && (uint64_t)config->max_ma_hz * divider >= config->f_clk_hz) {
      *freqs = code;
      return divider;
    }
  }
  return 0;
}

/* Shortest period of FREQAGS that is at least frame_period_ns (table 37) in system clocks, 0: none. */
static uint32_t period_clk(const openmb4_config *config, uint8_t *freqags) {
  uint32_t best = 0;
  unsigned code = 0;
  for (; code <= MB4_FREQAGS_MASK; ++code) {
    const uint32_t clk = code < MB4_AGS_RATE_AGS_MIN ? 20U * (code + 1U) : 625U * (code - 127U);
    if ((code < MB4_AGS_RATE_AGS_MIN || code >= 0x80) && (best == 0 || clk < best) &&
        clk * (uint64_t)1000000000U >= (uint64_t)config->frame_period_ns * config->f_clk_hz) {
      best = clk;
      *freqags = (uint8_t)code;
    }
  }
  return best;
}

static bool in_range(const openmb4_config *config) {
  return config->f_clk_hz >= (config->internal_clock ? 10000000U : 1000000U) &&
         config->f_clk_hz <= 25000000U && config->frame_period_ns >= 1000U &&
         config->frame_period_ns <= 1000000000U && config->data_bits >= 1 &&
         config->data_bits <= 64 && crc_code(config->crc_polynomial) != 0xFF;
}

/* Sets the word and the limits of the frames that stay away: two periods, if the chip has left some
 * out, otherwise 16. The internal oscillator may be three times as slow as it should be. */
static void set_read(openmb4_encoder *encoder, const openmb4_config *config, uint32_t period_ns) {
  const mb4_slave_config slave = {
      true, config->data_bits,
      (uint8_t)(config->error_warning ? MB4_FLAGS_ERROR_WARNING : MB4_FLAGS_NONE),
      config->crc_start, config->crc_polynomial, false, false, false};
  const uint32_t period_us = (period_ns / 1000U + 1U) * (config->internal_clock ? 3U : 1U);
  mb4_word_set(&encoder->word, 1, &slave, config->spi_check);
  mb4_word_biss_c(&encoder->word, &slave, 1);
  encoder->watch.omitted_us = 2U * period_us + STEP_US;
  encoder->watch.silent_us = 14U * period_us + encoder->watch.omitted_us;
  encoder->watch.lines = MB4_CYCLIC_SL1;
  encoder->counts.period_ns = config->internal_clock ? 0 : period_ns;
  encoder->read.count = 1;
  encoder->read.spi_check = config->spi_check;
  encoder->read.chain = config->spi_check < MB4_SPI_CHECK_FULL;
}

/* All pointers into the memory, which Rust may have moved. MB4_OK, or as mb4_cyclic_check(). */
static uint8_t bind(openmb4_encoder *encoder) {
  encoder->read.words = &encoder->word;
  encoder->read.slots = &encoder->slot;
  encoder->read.watch = &encoder->watch;
  encoder->watch.counts = &encoder->counts;
  mb4_plan_memory(&encoder->plan, encoder->tx, encoder->rx);
  return mb4_cyclic_check(&encoder->read, &encoder->plan, MB4_PLAN_WORDS(1), PARTS);
}

/* The registers from FIRST on, IMAGE_BYTES; no frames run and MA is not forced. The request at rest
 * is a read of register 0 (REGVERS: BiSS C, table 26). */
static void set_image(uint8_t *image, const openmb4_config *config, uint8_t freqs,
                      uint8_t freqags) {
  uint8_t i = 0;
  for (; i < IMAGE_BYTES; ++i) {
    image[i] = 0;
  }
  image[MB4_SCDLEN_ADDR(1U) - FIRST] = (uint8_t)(MB4_ENSCD_MASK(1U) | (config->data_bits - 1U));
  image[MB4_SCRCLEN_ADDR(1U) - FIRST] = crc_code(config->crc_polynomial);
  image[MB4_SCRCSTART_LO_ADDR(1U) - FIRST] = (uint8_t)config->crc_start;
  image[MB4_SCRCSTART_HI_ADDR(1U) - FIRST] = (uint8_t)(config->crc_start >> 8);
  image[MB4_ADDR_CTRL - FIRST] = MB4_REGVERS_MASK | MB4_CTS_MASK;
  image[MB4_ADDR_FREQ - FIRST] = (uint8_t)(5U << MB4_FREQR_SHIFT | freqs); /* table 36 */
  image[MB4_ADDR_FREQAGS - FIRST] =
      config->on_pin ? (uint8_t)MB4_AGS_RATE_AGS_INFINITE : freqags;
  image[MB4_ADDR_SLAVELOC5 - FIRST] = MB4_RESET_SLAVELOC5;
  image[MB4_ADDR_CFGCH - FIRST] = (uint8_t)(MB4_PROTOCOL_BISS_C << MB4_CFGCH_SHIFT(1U) |
                                            MB4_PROTOCOL_UNUSED << MB4_CFGCH_SHIFT(2U));
  image[MB4_ADDR_IFACE - FIRST] = config->internal_clock ? MB4_CLKENI_MASK : 0;
}

/* `encoder`: `bytes` of zeros. `image`: IMAGE_BYTES. MB4_OK, MB4_INVALID_CONFIG, or
 * MB4_INVALID_ARGUMENT: the memory is too small. */
uint8_t openmb4_begin(openmb4_encoder *encoder, uint32_t bytes, const openmb4_config *config,
                      uint8_t *image) {
  uint8_t freqs = 0;
  uint8_t freqags = 0;
  uint32_t divider = 0;
  uint32_t clk = 0;
  uint32_t period_ns = config->frame_period_ns;
  uint64_t frame_clk = 0; /* hundredths: 5 periods of MA, the word, 0.55 for the timeout */
  if (bytes < sizeof *encoder) {
    return MB4_INVALID_ARGUMENT;
  }
  if (!in_range(config)) {
    return MB4_INVALID_CONFIG;
  }
  divider = ma_divider(config, &freqs);
  clk = period_clk(config, &freqags);
  if (config->on_pin) {
    clk = (uint32_t)((uint64_t)period_ns * config->f_clk_hz / 1000000000U);
  } else {
    period_ns = (uint32_t)(clk * (uint64_t)1000000000U / config->f_clk_hz);
  }
  frame_clk = (555U + 100U * (config->data_bits + width_of(config->crc_polynomial))) * divider;
  if (divider == 0 || clk * (uint64_t)100U < frame_clk) {
    return MB4_INVALID_CONFIG;
  }
  set_image(image, config, freqs, freqags);
  set_read(encoder, config, period_ns);
  return bind(encoder);
}

/* Frames have been started: the next read drops the words from before. */
void openmb4_started(openmb4_encoder *encoder) {
  encoder->started = true;
  encoder->watch.held = true;
}

/* `rx`: HEADER bytes, then registers as the chip tells them. Reserved and constant registers are
 * left out (table 6). The status in between ends a MISO that is stuck. `running`: frames run. */
uint8_t openmb4_compare(const uint8_t *image, const uint8_t *rx, bool running) {
  const uint8_t *is = rx + HEADER;
  const uint8_t instruction = is[MB4_ADDR_INSTR - FIRST];
  uint8_t address = FIRST;
  if (is[MB4_ADDR_VERSION - FIRST] != MB4_DEVICE_VERSION_IC_MB4 ||
      !mb4_status_constant(is + (MB4_ADDR_STATUS0 - FIRST) - 1)) {
    return MB4_NOT_DETECTED;
  }
  for (; address < MB4_ADDR_STATUS0; ++address) {
    if (address != 0xE0 && address != 0xE1 && address != 0xEE && address != MB4_ADDR_REVISION &&
        address != MB4_ADDR_VERSION && is[address - FIRST] != image[address - FIRST]) {
      return MB4_VERIFY;
    }
  }
  return is[MB4_ADDR_IFACE - FIRST] == image[MB4_ADDR_IFACE - FIRST] &&
                 (instruction == 0 || (running && instruction == MB4_AGS_MASK))
             ? MB4_OK
             : MB4_VERIFY;
}

/* Begins a read. MB4_OK, or as mb4_cyclic_check(). */
uint8_t openmb4_plan(openmb4_encoder *encoder, uint32_t now_us) {
  const uint8_t code = bind(encoder);
  if (code == MB4_OK) {
    if (encoder->started) {
      encoder->started = false;
      encoder->watch.news_us = now_us;
    }
    mb4_cyclic_plan(&encoder->read, &encoder->plan, PARTS);
  }
  return code;
}

/* Bytes of SPI frame `frame` of the plan, 0: there is none. tx and rx have nothing in common. */
uint8_t openmb4_frame(const openmb4_encoder *encoder, uint8_t frame, const uint8_t **tx,
                      uint8_t **rx) {
  if (frame >= encoder->plan.frames) {
    return 0;
  }
  *tx = mb4_plan_tx(&encoder->plan, frame);
  *rx = mb4_plan_rx(&encoder->plan, frame);
  return encoder->plan.size[frame];
}

/* As mb4_cyclic_finish(). */
uint8_t openmb4_finish(openmb4_encoder *encoder, bool transferred, uint32_t now_us) {
  return mb4_cyclic_finish(&encoder->read, &encoder->plan, transferred, now_us, PARTS);
}

/* The position of a read that has ended with MB4_OK. */
void openmb4_reading_of(const openmb4_encoder *encoder, openmb4_reading *reading) {
  mb4_reading all;
  mb4_slot_reading(&encoder->word, &encoder->slot, &all, PARTS);
  reading->position = all.position;
  reading->raw = all.raw;
  reading->warning = all.slave_warning;
}

void openmb4_counts_of(const openmb4_encoder *encoder, openmb4_counts *counts) {
  const mb4_counts *from = &encoder->counts;
  counts->good = from->good;
  counts->slave_errors = from->slave_errors;
  counts->crc = from->crc;
  counts->no_word = from->no_word;
  counts->lost = from->lost;
  counts->sequence = from->sequence;
  counts->late = from->late;
  counts->faults = from->faults;
  counts->doubtful = from->doubtful;
  counts->omits = from->omits;
}
