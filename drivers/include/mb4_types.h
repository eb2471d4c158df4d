/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The types and numbers that the calls of mb4.h and the read path of mb4_cyclic.h share.
 */
#ifndef MB4_TYPES_H_
#define MB4_TYPES_H_

#include <stdbool.h>
#include <stdint.h>

enum {
  MB4_SLAVES = 8,
  MB4_CHANNELS = 2,
  MB4_STATUS_BYTES = 5 /* 0xF0..0xF4 */
};

/* Values of mb4_result.code: mb4::Error. */
enum {
  MB4_OK = 0,
  MB4_INVALID_ARGUMENT = 1,
  MB4_INVALID_CONFIG = 2,
  MB4_UNSUPPORTED = 3,
  MB4_NOT_CONFIGURED = 4,
  MB4_TRANSPORT = 5,
  MB4_NOT_DETECTED = 6,
  MB4_VERIFY = 7,
  MB4_TIMEOUT = 8,
  MB4_LINE_ERROR = 9,
  MB4_CRC = 10,
  MB4_NO_DATA = 11,
  MB4_CORRUPTED = 12,
  MB4_REGISTER = 13,
  MB4_REGISTER_DELAY = 14,
  MB4_COMMAND = 15,
  MB4_BUSY = 16,
  MB4_WRONG_MODE = 17,
  MB4_BANK_SWITCHED = 18,
  MB4_LINE_DELAY = 19,
  MB4_JUMP = 20,
  MB4_SLAVE_ERROR = 21,
  MB4_NO_WORD = 22
};

/* Result of a call: mb4::ErrorInfo. */
typedef struct {
  uint8_t code;   /* MB4_OK or an error */
  uint8_t field;  /* for MB4_INVALID_CONFIG, MB4_UNSUPPORTED: see mb4_field_text() */
  uint8_t number; /* slave 1..8 or channel 1..2 that the field belongs to; 0 = whole chip */
  uint8_t detail; /* MB4_VERIFY: register address; register accesses: good bytes */
} mb4_result;

enum { MB4_PROTOCOL_BISS_B, MB4_PROTOCOL_BISS_C, MB4_PROTOCOL_SSI, MB4_PROTOCOL_UNUSED };
enum { MB4_CLOCK_EXTERNAL, MB4_CLOCK_INTERNAL };
enum { MB4_LINE_TTL, MB4_LINE_CMOS, MB4_LINE_RS422, MB4_LINE_LVDS };
enum { MB4_START_BACK_TO_BACK, MB4_START_ON_PIN, MB4_START_PERIODIC };
enum { MB4_FLAGS_NONE, MB4_FLAGS_ERROR_WARNING };
enum { MB4_SPI_CHECK_OFF, MB4_SPI_CHECK_CRC, MB4_SPI_CHECK_FULL, MB4_SPI_CHECK_FULL_AND_RELEASE };

/* mb4::SlaveConfig in mb4/config/members.hpp, which states the ranges. */
typedef struct {
  bool enabled;
  uint8_t data_bits;       /* 1..64: position and flags, without CRC */
  uint8_t flags;           /* MB4_FLAGS_... */
  uint16_t crc_start;      /* only the low bits, as many as the CRC has, are used */
  uint32_t crc_polynomial; /* with the highest bit: 0x43 = x^6 + x + 1; 0 = no CRC */
  bool gray;               /* SSI: the encoder sends Gray code */
  bool actuator;           /* takes a word: mb4_write_actuator() */
  bool stop_bit;           /* actuators: a stop bit comes before the word */
} mb4_slave_config;

/* mb4::Config in mb4/config/members.hpp, which states ranges and meaning. Begin with
 * mb4_config_default(). */
typedef struct {
  uint32_t f_clk_hz;         /* 1'000'000..25'000'000; internal clock from 10'000'000 */
  uint32_t ma_hz;            /* from mb4_ma_hz_at_most() */
  uint32_t frame_period_clk; /* MB4_START_PERIODIC: mb4_frame_period_clk_at_least(), else 0 */
  uint32_t frame_timeout_us; /* 1..1'000'000; 0 = calculated */
  uint32_t register_busy_us; /* 1..10'000'000; 0 = the chip's own limit */
  uint8_t clock_source;      /* MB4_CLOCK_... */
  uint8_t line_interface;    /* MB4_LINE_... */
  uint8_t frame_start;       /* MB4_START_... */
  uint8_t spi_check;         /* MB4_SPI_CHECK_... */
  bool single_bank;
  bool hold_cdm;
  bool mo;                             /* pin MO is wired to SLI of the last slave */
  uint8_t mo_busy;                     /* periods of MA; 0 without mo */
  uint16_t register_divider;           /* f_MA / register clock of BiSS B: 2, 4, 8 ... 256 */
  uint32_t register_timeout_us;        /* longest timeout of the BiSS B slaves, up to 1'000'000 */
  uint8_t protocol[MB4_CHANNELS];      /* MB4_PROTOCOL_...; [0] is channel 1 */
  mb4_slave_config slaves[MB4_SLAVES]; /* [0] is slave 1 */
  bool hold_beside_access;             /* HOLDBANK beside register accesses too */
  bool activate_at_initialize;         /* mb4_slave_activate() in mb4_initialize() */
  uint32_t pin_period_us; /* MB4_START_ON_PIN: from pulse to pulse, 1..1'000'000; 0 = unknown */
} mb4_config;

/* mb4::Reading in mb4/reading.hpp. */
typedef struct {
  uint64_t raw;      /* all data bits, right aligned */
  uint64_t position; /* the data bits without flags, right aligned */
  uint16_t crc;      /* not inverted; 0 unless crc_stored */
  bool crc_stored;
  bool slave_error;   /* nE = 0, the encoder reports an error: do not trust the position. The call
                         that brings such a reading returns MB4_SLAVE_ERROR */
  bool slave_warning; /* nW = 0, the encoder reports a warning */
  uint8_t slave;      /* 1..8 */
} mb4_reading;

/* mb4::Frame: reading[i] is valid where code[i] is MB4_OK. Where it is MB4_SLAVE_ERROR, reading[i]
 * is what the slave has sent, and its position is not to be trusted. [0] is slave 1. A call that
 * takes a mb4_frame always writes it. */
typedef struct {
  mb4_reading reading[MB4_SLAVES];
  uint8_t code[MB4_SLAVES];
  uint8_t status[MB4_STATUS_BYTES];
  bool one_frame; /* all readings are of one frame of the line */
} mb4_frame;

/* mb4::Command in mb4/command.hpp. */
typedef struct {
  uint8_t channels;      /* bit 0 channel 1, bit 1 channel 2 */
  uint8_t ids;           /* bit 0 is ID 0; 0 = broadcast */
  uint8_t code;          /* 0..3 */
  bool test_acknowledge; /* IDA test; not with broadcast */
} mb4_command;

/* mb4::SlaveIdentity in mb4/scan.hpp. */
typedef struct {
  uint8_t device_id[6];
  uint8_t manufacturer[2];
  uint8_t eds_bank;
  bool has_identity;
  bool has_eds;
} mb4_identity;

/* ---- BiSS Safety (BP3) ---- */

enum { MB4_NO_BIT = 0xFF }; /* the place of a flag that a word does not have */

/* One word: enc::SafetyWord. */
typedef struct {
  uint8_t data_bits; /* without the CRC, 1..64 */
  uint8_t position_bits;
  uint8_t position_place; /* of the lowest position bit; place 0 is the lowest data bit */
  uint8_t error_place;    /* nE, MB4_NO_BIT: none */
  uint8_t warning_place;  /* nW, MB4_NO_BIT: none */
  uint16_t crc_start;
  uint32_t crc_polynomial; /* in full, degree 1..16 */
} mb4_safety_word;

/* Both words, the counter, and what the positions have to do with each other: enc::SafetyConfig. */
typedef struct {
  mb4_safety_word control;
  mb4_safety_word safety;
  uint8_t life_bits; /* 2..8 */
  uint8_t life_place;
  uint8_t life_first; /* 0, 1 */
  uint8_t control_shift;
  uint8_t safety_shift;
  bool safety_inverted;
  uint8_t compare_bits; /* 0: as many as both positions have after their shifts */
  uint64_t safety_offset;
  uint64_t tolerance; /* below half of 2^compare_bits */
} mb4_safety_config;

/* What one frame has shown: enc::SafetyVerdict. Its size is whole words of 32 bits. */
typedef struct {
  uint64_t position;        /* of the control word; 0 unless its CRC is right */
  uint64_t safety_position; /* of the safety word; 0 unless its CRC is right */
  uint16_t checks_failed;   /* bit n: the check n of MB4_SAFETY_...; 0: every check is passed */
  uint8_t life;             /* sign of life; 0 unless the CRC of the safety word is right */
  bool warning;             /* nW of a word with a right CRC is 0; no failure */
} mb4_safety_verdict;

/* enc::SafetyCheck, bits of checks_failed. */
enum {
  MB4_SAFETY_CONFIGURED = 0,
  MB4_SAFETY_CONTROL_WORD,
  MB4_SAFETY_SAFETY_WORD,
  MB4_SAFETY_ONE_FRAME,
  MB4_SAFETY_CONTROL_CRC,
  MB4_SAFETY_SAFETY_CRC,
  MB4_SAFETY_LIFE_KNOWN,
  MB4_SAFETY_LIFE_VALUE,
  MB4_SAFETY_LIFE_STUCK,
  MB4_SAFETY_LIFE_SKIPPED,
  MB4_SAFETY_LIFE_REPEATED,
  MB4_SAFETY_POSITIONS,
  MB4_SAFETY_CONTROL_ERROR,
  MB4_SAFETY_SAFETY_ERROR
};

#endif /* MB4_TYPES_H_ */
