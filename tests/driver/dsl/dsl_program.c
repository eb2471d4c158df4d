/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* All calls of dsl.h and hdsl.h, as a program in C99 makes them. dsl_c_test.cpp runs it. */

#include "dsl_program.h"

#define LIMIT_US 40000U
#define PING 0x7FU

#define TRY(call)                                  \
  do {                                             \
    if ((call).error != DSL_OK) {                  \
      return __LINE__;                             \
    }                                              \
  } while (0)
#define TRY_PUBLISHED(call) \
  do {                      \
    if ((call) != 0) {      \
      return __LINE__;      \
    }                       \
  } while (0)

static void found(void *context, const dsl_resource *resource, unsigned depth) {
  dsl_program_report *report = (dsl_program_report *)context;
  report->resources += resource->name[0] != 0 ? 1U : 0U;
  report->deepest = depth > report->deepest ? depth : report->deepest;
}

static dsl_long_request temperature(void) {
  dsl_long_request request = {0x202, false, true, 0, 2, {0}};
  return request;
}

static int messages(dsl_master *master, const dsl_port *port, void (*wait)(void *context),
                    dsl_program_report *report) {
  dsl_long_request request = temperature();
  dsl_result result;
  TRY(dsl_short_write(master, DSL_MAIN_HOST, PING, 0x41, LIMIT_US));
  TRY(dsl_short_read(master, DSL_MAIN_HOST, PING, LIMIT_US, &report->ping[0]));
  TRY(dsl_short_begin_write(master, DSL_MAIN_HOST, PING, 0x42, LIMIT_US));
  do {
    wait(port->context);
    result = dsl_short_poll(master, DSL_MAIN_HOST, &report->ping[1]);
  } while (result.error == DSL_BUSY);
  TRY(result);
  TRY(dsl_short_begin_read(master, DSL_SAFE_HOST, PING, LIMIT_US));
  do {
    wait(port->context);
    result = dsl_short_poll(master, DSL_SAFE_HOST, &report->ping[2]);
  } while (result.error == DSL_BUSY);
  TRY(result);
  TRY(dsl_ask(master, &request, LIMIT_US, &report->temp));
  TRY(dsl_long_begin(master, &request, LIMIT_US));
  do {
    wait(port->context);
    result = dsl_long_poll(master, &report->again);
  } while (result.error == DSL_BUSY);
  TRY(result);
  TRY(dsl_describe(master, 0x202, LIMIT_US, &report->resource));
  TRY(dsl_walk(master, LIMIT_US, found, report));
  request.resource = 0x203;
  request.size = 4;
  result = dsl_ask(master, &request, LIMIT_US, &report->again);
  report->secret = result.error == DSL_ENCODER ? result.encoder : 0;
  report->wrong_address = dsl_short_read(master, DSL_MAIN_HOST, 1, LIMIT_US, &report->ping[3]).error;
  TRY(dsl_reset_messages(master));
  for (unsigned i = 0; i < 40; ++i) {
    wait(port->context);
  }
  return 0;
}

static int published(dsl_master *master, void (*wait)(void *context), const dsl_port *port,
                     dsl_program_report *report) {
  dsl_long_request request = temperature();
  dsl_long_answer answer;
  int i;
  TRY_PUBLISHED(HDSL_write_pc_short_msg(master, PING, 0x43, LIMIT_US));
  TRY_PUBLISHED(HDSL_read_pc_short_msg(master, PING, &report->ping[3], LIMIT_US));
  TRY_PUBLISHED(HDSL_read_pc_long_msg(master, &request, &answer, LIMIT_US));
  report->published_error = HDSL_write_pc_long_msg(master, &request, LIMIT_US);
  request.resource = 0x204;
  request.write = true;
  TRY_PUBLISHED(HDSL_write_pc_long_msg(master, &request, LIMIT_US));
  /* A long message by its registers. */
  TRY_PUBLISHED(HDSL_set_pc_addr(master, 0x80U | 0x40U | 0x10U | 1U << 2 | 2U, 0x02, 0x80, 0));
  TRY_PUBLISHED(HDSL_write_pc_buffer(master, 7, 0x99));
  TRY_PUBLISHED(HDSL_set_pc_ctrl(master, 1));
  while ((HDSL_get_events(master) & 2U) == 0) {
    wait(port->context);
  }
  report->published_states[0] =
      (uint16_t)(HDSL_read_pc_buffer(master, 0) << 8 | HDSL_read_pc_buffer(master, 1));
  report->published_states[1] = HDSL_get_online_status_d(master);
  report->published_states[2] = HDSL_get_online_status_1(master);
  report->published_states[3] = HDSL_get_online_status_2(master);
  report->published_states[4] =
      (uint16_t)(HDSL_get_qm(master) << 8 | HDSL_get_master_qm(master));
  report->published_states[5] =
      (uint16_t)(HDSL_get_rssi(master) << 8 | HDSL_get_delay(master));
  report->published_states[6] =
      (uint16_t)(HDSL_get_enc_id(master, 1) << 8 | HDSL_get_enc_id(master, 0));
  report->published_states[7] =
      (uint16_t)(HDSL_get_sum(master) | HDSL_get_acc_err_cnt(master) | HDSL_get_sync_ctrl(master) |
                 (HDSL_get_edges(master) == 0 ? 1U : 0U) | (HDSL_get_safe_events(master) & 0x80U));
  for (i = 0; i < 3; ++i) {
    report->published_position[i] = HDSL_get_pos(master, i);
  }
  if (HDSL_get_pos(master, 3) != ~(uint64_t)0 || HDSL_read_pc_buffer(master, 8) != 0xFF ||
      HDSL_write_pc_buffer(master, 8, 0) == 0 || HDSL_get_enc_id(master, 3) != 0xFF ||
      HDSL_read_pc_long_msg(master, &request, &answer, LIMIT_US) == 0) {
    return __LINE__;
  }
  TRY_PUBLISHED(HDSL_set_sync_ctrl(master, 0));
  return 0;
}

int dsl_program(const dsl_port *port, void (*wait)(void *context), dsl_program_report *report) {
  dsl_master master;
  dsl_safe_rules rules = dsl_safe_rules_default();
  dsl_events mask = {0, 0, 0};
  bool linked = false;
  int line;
  unsigned i;
  dsl_open(&master, port);
  TRY(dsl_start(&master));
  TRY(dsl_wait_for_link(&master, 5000, &report->encoder));
  TRY(dsl_linked(&master, &linked));
  if (!linked) {
    return __LINE__;
  }
  for (i = 0; i < 30; ++i) {
    wait(port->context);
  }
  TRY(dsl_read_position(&master, &report->position));
  rules.bits2 = report->encoder.position_bits;
  TRY(dsl_read_safe(&master, &rules, &report->safe));
  TRY(dsl_read_quality(&master, &report->quality));
  TRY(dsl_mask_events(&master, &mask, 0));
  TRY(dsl_take_events(&master, &report->events));
  TRY(dsl_enable_interrupts(&master, 1));
  wait(port->context);
  TRY(dsl_take_interrupts(&master, &report->interrupts));
  line = messages(&master, port, wait, report);
  if (line != 0) {
    return line;
  }
  line = published(&master, wait, port, report);
  if (line != 0) {
    return line;
  }
  TRY(dsl_stop(&master));
  wait(port->context);
  wait(port->context);
  report->after_stop = dsl_read_position(&master, &report->position).error;
  return 0;
}
