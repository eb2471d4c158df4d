/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* What a program in C has read by all calls of dsl.h and hdsl.h. */
#ifndef MB4_TESTS_DRIVER_DSL_PROGRAM_H_
#define MB4_TESTS_DRIVER_DSL_PROGRAM_H_

#include "hdsl.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  dsl_encoder encoder;
  dsl_position position;
  dsl_safe_position safe;
  dsl_quality quality;
  dsl_events events;
  uint8_t interrupts;
  uint8_t ping[4];       /* blocking, in steps, of the safe host, by the published name */
  dsl_long_answer temp;  /* blocking */
  dsl_long_answer again; /* in steps */
  dsl_resource resource;
  unsigned resources; /* of the walk */
  unsigned deepest;
  uint64_t published_position[3];
  uint16_t published_states[8];
  uint16_t secret; /* code of the encoder */
  dsl_error wrong_address;
  int32_t published_error;
  dsl_error after_stop;
} dsl_program_report;

/* 0, or the line of the call that failed. wait() lets a frame pass. */
int dsl_program(const dsl_port *port, void (*wait)(void *context), dsl_program_report *report);

#ifdef __cplusplus
}
#endif

#endif /* MB4_TESTS_DRIVER_DSL_PROGRAM_H_ */
