/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The read path in C99 on the Verilated chip, without the C++ driver: no library of it is linked.
 */
#include <stdio.h>
#include <string.h>

#include "mb4_cyclic.h"
#include "mb4_regs.h"
#include "mb4sim.h"

static unsigned failures;

static void check(int good, const char *what, int line) {
  if (!good) {
    printf("line %d: %s\n", line, what);
    ++failures;
  }
}
#define CHECK(condition) check((condition), #condition, __LINE__)

enum { kPeriodNs = 50000, kPhases = 25 };

/* BiSS C at 10 MHz, 28 bits; the position counts the frames. */
static const char kScenario[] =
    "[chip.quirks]\nAGSERR_ON_HOLDBANK = %s\n[host]\nsclk_hz = 10_000_000\n"
    "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\n"
    "source = \"ramp\"\nstep = 1\n";

typedef struct {
  mb4sim *simulator;
  mb4_word word;
  mb4_watch watch;
  mb4_cyclic read;
  mb4_slot slot;
  mb4_reading reading;
  mb4_plan plan;
  uint32_t tx[MB4_PLAN_WORDS(1)];
  uint32_t rx[MB4_PLAN_WORDS(1)];
  uint32_t table[16];
  uint8_t parts;
  unsigned transfers;
  unsigned bytes;
} drive_t;

static void write_bytes(drive_t *drive, const uint8_t *bytes, size_t size) {
  CHECK(mb4sim_spi_transfer(drive->simulator, bytes, NULL, size) == 0);
}

static uint32_t now_us(const drive_t *drive) {
  return (uint32_t)(mb4sim_time_ns(drive->simulator) / 1000);
}

static void start_with(drive_t *drive, const char *text, uint8_t spi_check, bool chain,
                       bool by_table) {
  char error[200];
  const uint8_t stop[] = {0x07, 0x80, 0x00};
  const uint8_t run[] = {0x07, 0x01};
  const mb4_slave_config slave = {true, 28, MB4_FLAGS_ERROR_WARNING, 0, 0x43, false, false, false};
  uint8_t image[2 + 0xF3 - 0xC0] = {0x02, 0xC0, 0x5B, 0x06}; /* SCDLEN1 = 27, SCRCLEN1 = 6 */
  memset(drive, 0, sizeof *drive);
  drive->simulator = mb4sim_open(text, error, sizeof error);
  if (drive->simulator == NULL) {
    printf("%s\n", error);
    ++failures;
    return;
  }
  image[2 + MB4_ADDR_CTRL - 0xC0] = 0x40; /* REGVERS: BiSS C (table 26) */
  image[2 + MB4_ADDR_FREQ - 0xC0] = 0xA0; /* FREQS = 0: 20 MHz / 2 (table 35), FREQR = 5 */
  image[2 + MB4_ADDR_BANKCFG - 0xC0] = spi_check == MB4_SPI_CHECK_OFF ? 0x02 : 0x00; /* NOCRC */
  image[2 + MB4_ADDR_FREQAGS - 0xC0] = 50 - 1; /* 20 MHz / 20 / 50: every 50 us (table 37) */
  image[2 + MB4_ADDR_SLAVELOC5 - 0xC0] = 0x01;
  image[2 + MB4_ADDR_CFGCH - 0xC0] = 0x0D; /* channel 1 BiSS C, channel 2 unused (table 8) */
  write_bytes(drive, stop, sizeof stop);
  write_bytes(drive, image, sizeof image);
  mb4_word_set(&drive->word, 1, &slave, spi_check);
  mb4_word_biss_c(&drive->word, &slave, 1);
  drive->parts = MB4_WITH_ALL;
  if (by_table) {
    mb4_crc_table(&drive->word, drive->table);
  }
  drive->watch.news_us = now_us(drive);
  drive->watch.omitted_us = 2 * kPeriodNs / 1000 + 2;
  drive->watch.silent_us = 16 * kPeriodNs / 1000;
  drive->watch.lines = 1;
  drive->read.words = &drive->word;
  drive->read.slots = &drive->slot;
  drive->read.count = 1;
  mb4_plan_memory(&drive->plan, drive->tx, drive->rx);
  drive->read.watch = &drive->watch;
  drive->read.spi_check = spi_check;
  drive->read.chain = chain;
  CHECK(mb4_cyclic_check(&drive->read, &drive->plan, MB4_PLAN_WORDS(1), drive->parts) == MB4_OK);
  write_bytes(drive, run, sizeof run);
}

static void start(drive_t *drive, bool omits, uint8_t spi_check, bool chain, bool by_table) {
  char text[400];
  (void)snprintf(text, sizeof text, kScenario, omits ? "true" : "false");
  start_with(drive, text, spi_check, chain, by_table);
}

static uint8_t read_plans(drive_t *drive) {
  uint8_t code;
  unsigned calls = 0;
  drive->transfers = 0;
  drive->bytes = 0;
  mb4_cyclic_plan(&drive->read, &drive->plan, drive->parts);
  do {
    uint8_t i;
    for (i = 0; i < drive->plan.frames; ++i) {
      const uint8_t size = drive->plan.size[i];
      CHECK(size <= 25);
      CHECK(mb4sim_spi_transfer(drive->simulator, mb4_plan_tx(&drive->plan, i),
                                mb4_plan_rx(&drive->plan, i), size) == 0);
      ++drive->transfers;
      drive->bytes += size;
    }
    code = mb4_cyclic_finish(&drive->read, &drive->plan, true, now_us(drive), drive->parts);
    CHECK(++calls <= 7);
  } while (code == MB4_MORE);
  return code;
}

static uint8_t read_position(drive_t *drive) {
  const uint8_t code = read_plans(drive);
  if (code == MB4_OK) {
    mb4_slot_reading(&drive->word, &drive->slot, &drive->reading, drive->parts);
  }
  return code;
}

/* At each phase of a loop that ticks with the frames each word comes once, in order, and is true;
 * what is missing was left out or overwritten while the bank was held. */
static void test_phases(bool omits, uint8_t spi_check, bool chain, bool by_table) {
  unsigned phase;
  for (phase = 0; phase < kPhases; ++phase) {
    drive_t drive;
    uint64_t last = 0;
    uint64_t due;
    unsigned good = 0;
    unsigned ticks;
    start(&drive, omits, spi_check, chain, by_table);
    if (drive.simulator == NULL) {
      return;
    }
    due = mb4sim_time_ns(drive.simulator) + 3 * kPeriodNs + phase * kPeriodNs / kPhases;
    for (ticks = 0; ticks < 100; ++ticks) {
      const uint64_t now = mb4sim_time_ns(drive.simulator);
      uint8_t code;
      uint64_t before;
      CHECK(now <= due);
      mb4sim_advance_ns(drive.simulator, due - now);
      due += kPeriodNs;
      before = mb4sim_time_ns(drive.simulator);
      code = read_position(&drive);
      if (code == MB4_OK) {
        const uint64_t position = drive.reading.position;
        uint64_t sent = 0;
        CHECK(mb4sim_slave_sent(drive.simulator, 1, position + 1, &sent) == 0);
        CHECK(sent == drive.reading.raw);
        CHECK(ticks == 0 || position > last);
        CHECK(mb4sim_slave_frames(drive.simulator, 1) - position <= 4);
        CHECK(!drive.reading.slave_error && !drive.reading.slave_warning);
        last = position;
        ++good;
        if (chain) {
          CHECK(drive.transfers == 4 && drive.bytes <= 23);
          CHECK(mb4sim_time_ns(drive.simulator) - before <= 19000);
        }
      } else {
        CHECK(code == MB4_NO_DATA);
      }
    }
    CHECK(good >= 98);
    mb4sim_close(drive.simulator);
  }
}

/* A bad word is told once; then a dead line within three frames, and what it is. */
static void test_faults(bool omits, bool chain, unsigned stuck_level, uint8_t alarm) {
  drive_t drive;
  char error[200];
  char fault[200];
  unsigned told = 0;
  unsigned i;
  uint8_t code = MB4_NO_DATA;
  start(&drive, omits, MB4_SPI_CHECK_CRC, chain, false);
  if (drive.simulator == NULL) {
    return;
  }
  mb4sim_advance_ns(drive.simulator, 3 * kPeriodNs);
  CHECK(read_position(&drive) == MB4_OK);
  for (i = 0; i < 40; ++i) {
    if (i == 5) {
      CHECK(mb4sim_inject(drive.simulator,
                          "[[fault]]\nkind = \"bit-flip\"\nchannel = 1\nat_us = 0\nbits = [9]\n",
                          error, sizeof error) == 0);
    }
    code = read_position(&drive);
    told += code == MB4_CRC ? 1 : 0;
    CHECK(code == MB4_OK || code == MB4_CRC || code == MB4_NO_DATA);
    mb4sim_advance_ns(drive.simulator, 2000);
  }
  if (told != 1) {
    printf("%u bad words were told\n", told);
    ++failures;
  }
  mb4sim_advance_ns(drive.simulator, kPeriodNs);
  CHECK(read_position(&drive) == MB4_OK);
  (void)snprintf(fault, sizeof fault,
                 "[[fault]]\nkind = \"stuck\"\nchannel = 1\nat_us = 0\nlevel = %u\n", stuck_level);
  if (mb4sim_inject(drive.simulator, fault, error, sizeof error) != 0) {
    printf("%s\n", error);
    ++failures;
  }
  for (i = 0; i < 5 && code != alarm; ++i) {
    mb4sim_advance_ns(drive.simulator, kPeriodNs - 20000);
    code = read_position(&drive);
  }
  CHECK(code == alarm);
  CHECK(i <= 4);
  mb4sim_close(drive.simulator);
}

/* REGEND is 0 before any access too, so only the caller knows that one has begun. */
static void test_running(void) {
  drive_t drive;
  const uint8_t channel[] = {0x02, MB4_ADDR_CHSEL, 0x01};
  const uint8_t access[] = {0x07, 0x09}; /* AGS = 1, INSTR = 100 (table 45) */
  unsigned i;
  unsigned seen = 0;
  start(&drive, false, MB4_SPI_CHECK_CRC, true, false);
  if (drive.simulator == NULL) {
    return;
  }
  mb4sim_advance_ns(drive.simulator, 3 * kPeriodNs);
  CHECK(read_position(&drive) == MB4_OK);
  CHECK(!drive.read.running);
  write_bytes(&drive, channel, sizeof channel);
  write_bytes(&drive, access, sizeof access);
  drive.read.access = true;
  for (i = 0; i < 100 && (i == 0 || drive.read.running); ++i) {
    mb4sim_advance_ns(drive.simulator, kPeriodNs);
    CHECK(read_position(&drive) == MB4_OK);
    seen += drive.read.running ? 1 : 0;
  }
  CHECK(seen >= 14 && i < 100); /* 14 frames with CDM = 0 begin it (page 28) */
  mb4sim_close(drive.simulator);
}

/* The read is given up between HOLDBANK and its release, or the release fails: the next read
 * releases the bank, and what is in it is old by then. */
static void test_given_up(bool omits, bool chain) {
  drive_t drive;
  uint8_t status[6] = {0x05, 0, 0, 0, 0, 0};
  unsigned i;
  start(&drive, omits, MB4_SPI_CHECK_CRC, chain, false);
  if (drive.simulator == NULL) {
    return;
  }
  mb4sim_advance_ns(drive.simulator, 3 * kPeriodNs);
  CHECK(read_position(&drive) == MB4_OK);
  mb4sim_advance_ns(drive.simulator, kPeriodNs);
  mb4_cyclic_plan(&drive.read, &drive.plan, drive.parts);
  write_bytes(&drive, mb4_plan_tx(&drive.plan, 0), drive.plan.size[0]); /* HOLDBANK */
  CHECK(mb4_cyclic_finish(&drive.read, &drive.plan, false, now_us(&drive), drive.parts) ==
        MB4_MORE);
  CHECK(mb4_cyclic_finish(&drive.read, &drive.plan, false, now_us(&drive), drive.parts) ==
        MB4_TRANSPORT);
  for (i = 0; i < 4; ++i) {
    uint8_t code;
    mb4sim_advance_ns(drive.simulator, 20 * kPeriodNs);
    code = read_position(&drive);
    CHECK(code == (i == 0 ? MB4_NO_DATA : MB4_OK));
    if (code == MB4_OK) {
      CHECK(mb4sim_slave_frames(drive.simulator, 1) - drive.reading.position <= 3);
    }
  }
  CHECK(mb4sim_spi_transfer(drive.simulator, status, status, sizeof status) == 0);
  CHECK(status[5] == 0x01); /* HOLDBANK = 0 */
  mb4sim_close(drive.simulator);
}

/* Two slaves on one line in one chain: the words of one frame, at each phase, and the counts. */
static void test_two(bool omits) {
  static const char text[] =
      "[chip.quirks]\nAGSERR_ON_HOLDBANK = %s\n[host]\nsclk_hz = 10_000_000\n[[channel]]\nnumber = "
      "1\n"
      "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\nsource = \"ramp\"\nstep = 1\n"
      "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\nsource = \"ramp\"\nstep = 1\n"
      "start = 5000\n";
  const mb4_slave_config slave = {true, 28, MB4_FLAGS_ERROR_WARNING, 0, 0x43, false, false, false};
  const uint8_t part[] = {0x02, 0xC4, 0x5B, 0x06}; /* the second slave as the first */
  const uint8_t with = MB4_WITH_ALL;
  unsigned phase;
  for (phase = 0; phase < kPhases; ++phase) {
    drive_t drive;
    mb4_word words[2];
    mb4_slot slots[2];
    uint32_t tx[MB4_PLAN_WORDS(2)];
    uint32_t rx[MB4_PLAN_WORDS(2)];
    mb4_counts counts;
    char scenario[500];
    uint64_t due;
    unsigned ticks;
    memset(&counts, 0, sizeof counts);
    (void)snprintf(scenario, sizeof scenario, text, omits ? "true" : "false");
    start_with(&drive, scenario, MB4_SPI_CHECK_CRC, true, false);
    if (drive.simulator == NULL) {
      return;
    }
    write_bytes(&drive, part, sizeof part);
    mb4_word_set(&words[0], 1, &slave, MB4_SPI_CHECK_CRC);
    mb4_word_set(&words[1], 2, &slave, MB4_SPI_CHECK_CRC);
    drive.read.words = words;
    drive.read.slots = slots;
    drive.read.count = 2;
    mb4_plan_memory(&drive.plan, tx, rx);
    drive.watch.several = true;
    drive.watch.counts = &counts;
    drive.parts = with;
    counts.period_ns = kPeriodNs;
    CHECK(mb4_cyclic_check(&drive.read, &drive.plan, MB4_PLAN_WORDS(2), with) == MB4_OK);
    due = mb4sim_time_ns(drive.simulator) + 4 * kPeriodNs + phase * kPeriodNs / kPhases;
    for (ticks = 0; ticks < 40; ++ticks) {
      mb4_reading first;
      mb4_reading second;
      mb4sim_advance_ns(drive.simulator, due - mb4sim_time_ns(drive.simulator));
      due += ticks % 7 == 3 ? 3 * kPeriodNs : kPeriodNs; /* two samples are lost */
      if (read_plans(&drive) != MB4_OK) {
        CHECK(ticks <= 1);
        continue;
      }
      CHECK(drive.read.told && drive.read.one_frame);
      CHECK(slots[0].code == MB4_OK && slots[1].code == MB4_OK);
      CHECK(drive.transfers == 4 && drive.bytes == 31);
      mb4_slot_reading(&words[0], &slots[0], &first, with);
      mb4_slot_reading(&words[1], &slots[1], &second, with);
      CHECK(first.position + 5000 == second.position && first.slave == 1 && second.slave == 2);
    }
    CHECK(counts.good >= 38 && counts.crc == 0 && counts.faults == 0);
    CHECK(counts.lost >= 10 && counts.lost <= 13);
    CHECK(counts.sequence == counts.good + counts.lost);
    mb4sim_close(drive.simulator);
  }
}

/* nE = 0 of one of two slaves, then of both: each word is told, and none is lost. */
static void test_slave_error(uint8_t spi_check, bool chain) {
  const mb4_slave_config slave = {true, 28, MB4_FLAGS_ERROR_WARNING, 0, 0x43, false, false, false};
  const uint8_t part[] = {0x02, 0xC4, 0x5B, 0x06}; /* the second slave as the first */
  const char *const text =
      "[host]\nsclk_hz = 10_000_000\n[[channel]]\nnumber = 1\n"
      "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\n"
      "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\n";
  drive_t drive;
  mb4_word words[2];
  mb4_slot slots[2] = {{0, 0, 0, MB4_NO_DATA, false}, {0, 0, 0, MB4_NO_DATA, false}};
  uint32_t tx[MB4_PLAN_WORDS(2)];
  uint32_t rx[MB4_PLAN_WORDS(2)];
  mb4_counts counts;
  uint64_t due;
  unsigned ticks;
  unsigned good = 0;
  unsigned errors = 0;
  memset(&counts, 0, sizeof counts);
  start_with(&drive, text, spi_check, chain, false);
  if (drive.simulator == NULL) {
    return;
  }
  write_bytes(&drive, part, sizeof part);
  mb4_word_set(&words[0], 1, &slave, spi_check);
  mb4_word_set(&words[1], 2, &slave, spi_check);
  drive.read.words = words;
  drive.read.slots = slots;
  drive.read.count = 2;
  mb4_plan_memory(&drive.plan, tx, rx);
  drive.watch.several = true;
  drive.watch.counts = &counts;
  drive.parts = MB4_WITH_ALL | MB4_WITH_COUNTS;
  counts.period_ns = kPeriodNs;
  CHECK(mb4_cyclic_check(&drive.read, &drive.plan, MB4_PLAN_WORDS(2), drive.parts) == MB4_OK);
  due = mb4sim_time_ns(drive.simulator) + 4 * kPeriodNs + kPeriodNs / 2;
  for (ticks = 0; ticks < 120; ++ticks) {
    const unsigned flags = ticks / 30; /* bit 0: nE of slave 1, bit 1: of slave 2 */
    unsigned i;
    uint8_t code;
    CHECK(mb4sim_slave_set_data(drive.simulator, 1, 1000U << 2 | (flags & 1U) << 1 | 1U) == 0);
    CHECK(mb4sim_slave_set_data(drive.simulator, 2, 2000U << 2 | (flags & 2U) | 1U) == 0);
    mb4sim_advance_ns(drive.simulator, due - mb4sim_time_ns(drive.simulator));
    due += kPeriodNs;
    code = read_plans(&drive);
    if (ticks % 30 < 3 || code == MB4_NO_DATA) { /* the old data may still be under way */
      good += code == MB4_OK ? 1 : 0;
      errors += drive.read.slave_error ? 1 : 0;
      continue;
    }
    CHECK(code == (flags == 0 ? MB4_SLAVE_ERROR : MB4_OK));
    CHECK(drive.read.told && drive.read.slave_error == (flags != 3));
    good += flags == 0 ? 0 : 1;
    errors += flags != 3 ? 1 : 0;
    for (i = 0; i < 2; ++i) {
      const bool error = (flags >> i & 1U) == 0;
      mb4_reading reading;
      CHECK(slots[i].code == (error ? MB4_SLAVE_ERROR : MB4_OK));
      mb4_slot_reading(&words[i], &slots[i], &reading, drive.parts);
      CHECK(reading.slave_error == error && !reading.slave_warning);
      CHECK(reading.position == 1000U * (i + 1));
    }
  }
  CHECK(good >= 80 && counts.good == good);
  CHECK(errors >= 80 && counts.slave_errors == errors);
  CHECK(counts.crc == 0 && counts.faults == 0 && counts.lost <= 1);
  mb4sim_close(drive.simulator);
}

int main(void) {
  test_slave_error(MB4_SPI_CHECK_CRC, true);
  test_slave_error(MB4_SPI_CHECK_OFF, false);
  test_slave_error(MB4_SPI_CHECK_FULL, false);
  test_phases(false, MB4_SPI_CHECK_CRC, true, false);
  test_phases(true, MB4_SPI_CHECK_CRC, true, true);
  test_phases(false, MB4_SPI_CHECK_OFF, true, false);
  test_phases(false, MB4_SPI_CHECK_CRC, false, true);
  test_phases(false, MB4_SPI_CHECK_FULL, false, false);
  test_faults(false, true, 1, MB4_TIMEOUT);
  test_faults(true, false, 0, MB4_LINE_ERROR);
  test_two(false);
  test_two(true);
  test_running();
  test_given_up(false, true);
  test_given_up(true, true);
  test_given_up(true, false);
  printf("%u failures\n", failures);
  return failures != 0;
}
