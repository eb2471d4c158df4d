/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The driver of the DSL master for C99: the same code as dsl/device.hpp, messages.hpp and
 * resources.hpp, compiled once in c/dsl_c.cpp. It uses no heap and no static data.
 *
 * The comment of the C++ call says what a call does, its ranges and errors; dsl/error.hpp describes
 * the errors. No pointer may be null. Outputs are valid only with DSL_OK. hdsl.h has the names of
 * the published calls.
 */
#ifndef DSL_H_
#define DSL_H_

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* As dsl::Error, in its order. */
typedef enum {
  DSL_OK = 0,
  DSL_BUS,
  DSL_ABSENT,
  DSL_ARGUMENT,
  DSL_TIMEOUT,
  DSL_NO_LINK,
  DSL_UNCERTAIN,
  DSL_NO_SAFE,
  DSL_SAFE_OLD,
  DSL_SAFE_CRC,
  DSL_SAFE_STATE,
  DSL_SAFE_DIFFERS,
  DSL_BUSY,
  DSL_RESET,
  DSL_REFUSED,
  DSL_ENCODER
} dsl_error;

typedef struct {
  dsl_error error;
  uint16_t encoder; /* DSL_ENCODER: its code */
} dsl_result;

/* The compiler warns where a result is dropped (GCC, Clang). */
#if defined(__GNUC__)
#define DSL_RESULT __attribute__((warn_unused_result)) dsl_result
#else
#define DSL_RESULT dsl_result
#endif

/* The bus and the clock of the caller; the contracts are those of dsl/port.hpp and enc/bus.hpp. */
typedef struct {
  bool (*read)(void *context, uint32_t offset, uint32_t *word);
  bool (*write)(void *context, uint32_t offset, uint8_t byte);
  uint32_t (*now_us)(void *context);
  void *context;
} dsl_port;

/* One master. The caller provides the memory and does not use its contents. */
typedef struct {
  uint64_t opaque[24];
} dsl_master;

typedef struct {
  uint8_t position_bits;
  uint8_t acceleration_bits;
  bool is_signed;
} dsl_encoder;

typedef struct {
  int64_t position; /* steps */
  int32_t speed;    /* steps a frame */
  uint32_t frame;
  uint8_t quality;
} dsl_position;

typedef struct {
  uint8_t bits2;
  uint8_t tolerance;
  uint32_t max_age;    /* frames */
  uint32_t bad_states; /* SAFE_STATUS */
} dsl_safe_rules;

typedef struct {
  int64_t position;
  uint8_t summary;
  bool toggle;
  uint32_t age; /* frames */
} dsl_safe_position;

typedef struct {
  uint8_t quality;
  uint8_t rssi;
  uint8_t delay_bits;
  uint8_t edges;
  uint8_t restart_reason;
  uint16_t restarts;
  uint16_t illegal_words;
} dsl_quality;

typedef struct {
  uint8_t high; /* EVENT_H */
  uint8_t low;  /* EVENT_L */
  uint8_t safe; /* EVENT_S */
} dsl_events;

typedef enum { DSL_MAIN_HOST, DSL_SAFE_HOST } dsl_host;

typedef struct {
  uint16_t resource;
  bool write;
  bool indirect;
  uint16_t offset;
  uint8_t size; /* 0, 2, 4, 8 */
  uint8_t data[8];
} dsl_long_request;

typedef struct {
  uint8_t size;
  uint8_t data[8];
} dsl_long_answer;

typedef struct {
  uint16_t id;
  char name[9];
  uint16_t size;
  uint8_t read_level;
  uint8_t write_level;
  uint16_t time_ms;
  uint8_t type; /* dsl::ResourceType */
} dsl_resource;

/* Before every other call. It makes no access. `port` is copied. */
void dsl_open(dsl_master *master, const dsl_port *port);

DSL_RESULT dsl_start(dsl_master *master);
DSL_RESULT dsl_stop(dsl_master *master);
DSL_RESULT dsl_linked(dsl_master *master, bool *linked);
DSL_RESULT dsl_wait_for_link(dsl_master *master, uint32_t limit_us, dsl_encoder *encoder);
DSL_RESULT dsl_read_position(dsl_master *master, dsl_position *position);
/* The default values of dsl::SafeRules. */
dsl_safe_rules dsl_safe_rules_default(void);
DSL_RESULT dsl_read_safe(dsl_master *master, const dsl_safe_rules *rules,
                         dsl_safe_position *position);
DSL_RESULT dsl_read_quality(dsl_master *master, dsl_quality *quality);
DSL_RESULT dsl_take_events(dsl_master *master, dsl_events *events);
DSL_RESULT dsl_mask_events(dsl_master *master, const dsl_events *events, uint8_t summary);
DSL_RESULT dsl_enable_interrupts(dsl_master *master, uint8_t mask);
DSL_RESULT dsl_take_interrupts(dsl_master *master, uint8_t *pending);

/* Short messages. */
DSL_RESULT dsl_short_read(dsl_master *master, dsl_host host, uint8_t address, uint32_t limit_us,
                          uint8_t *value);
DSL_RESULT dsl_short_write(dsl_master *master, dsl_host host, uint8_t address, uint8_t value,
                           uint32_t limit_us);
DSL_RESULT dsl_short_begin_read(dsl_master *master, dsl_host host, uint8_t address,
                                uint32_t limit_us);
DSL_RESULT dsl_short_begin_write(dsl_master *master, dsl_host host, uint8_t address, uint8_t value,
                                 uint32_t limit_us);
DSL_RESULT dsl_short_poll(dsl_master *master, dsl_host host, uint8_t *value);

/* Long messages of the main host. */
DSL_RESULT dsl_ask(dsl_master *master, const dsl_long_request *request, uint32_t limit_us,
                   dsl_long_answer *answer);
DSL_RESULT dsl_long_begin(dsl_master *master, const dsl_long_request *request, uint32_t limit_us);
DSL_RESULT dsl_long_poll(dsl_master *master, dsl_long_answer *answer);
DSL_RESULT dsl_reset_messages(dsl_master *master);

/* Resources. */
DSL_RESULT dsl_describe(dsl_master *master, uint16_t id, uint32_t limit_us, dsl_resource *resource);
DSL_RESULT dsl_walk(dsl_master *master, uint32_t limit_us,
                    void (*found)(void *context, const dsl_resource *resource, unsigned depth),
                    void *context);

/* A byte of the map (dsl_regs.h), as it is. */
DSL_RESULT dsl_read_byte(dsl_master *master, uint8_t address, uint8_t *value);
DSL_RESULT dsl_write_byte(dsl_master *master, uint8_t address, uint8_t value);

#ifdef __cplusplus
}
#endif

#endif /* DSL_H_ */
