/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The names of the published calls of a DSL master, on dsl.h, for firmware that moves here. C99,
 * header only. The types are C's own; a handle is a dsl_master that dsl_open() has made.
 *
 * A read returns the register's value, and all ones if the bus failed. The positions of
 * HDSL_get_pos() are registers as they are: they are not checked, see dsl_read_position() and
 * dsl_read_safe(). Message calls return 0, or a negative dsl_error. Names that set up the published
 * core, its memory and its time base have no counterpart: docs/dsl.md, "Driver", lists them.
 */
#ifndef HDSL_H_
#define HDSL_H_

#include "dsl.h"
#include "dsl_regs.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef dsl_master *HDSL_Handle;

/* n bytes of the map from `address` on, the first one the highest. */
static inline uint64_t hdsl_bytes(HDSL_Handle handle, uint8_t address, unsigned n) {
  uint64_t value = 0;
  unsigned i;
  for (i = 0; i < n; ++i) {
    uint8_t byte = 0;
    if (dsl_read_byte(handle, (uint8_t)(address + i), &byte).error != DSL_OK) {
      return ~(uint64_t)0;
    }
    value = value << 8 | byte;
  }
  return value;
}

static inline uint8_t hdsl_byte(HDSL_Handle handle, uint8_t address) {
  return (uint8_t)hdsl_bytes(handle, address, 1);
}
static inline uint16_t hdsl_two_bytes(HDSL_Handle handle, uint8_t address) {
  return (uint16_t)hdsl_bytes(handle, address, 2);
}

static inline int32_t hdsl_status(dsl_result result) { return -(int32_t)result.error; }

/* position_id: 0 fast, 1 safe 1, 2 safe 2. 40 bits. */
static inline uint64_t HDSL_get_pos(HDSL_Handle handle, int position_id) {
  switch (position_id) {
    case 0: return hdsl_bytes(handle, DSL_ADDR_POS4, 5);
    case 1: return hdsl_bytes(handle, DSL_ADDR_VPOS4, 5);
    case 2: return hdsl_bytes(handle, DSL_ADDR_VPOS2_4, 5);
    default: return ~(uint64_t)0;
  }
}
static inline uint8_t HDSL_get_qm(HDSL_Handle handle) {
  return (uint8_t)(hdsl_byte(handle, DSL_ADDR_MASTER_QM) & 0xFU);
}
static inline uint8_t HDSL_get_master_qm(HDSL_Handle handle) {
  return hdsl_byte(handle, DSL_ADDR_MASTER_QM);
}
static inline uint16_t HDSL_get_events(HDSL_Handle handle) {
  return hdsl_two_bytes(handle, DSL_ADDR_EVENT_H);
}
static inline uint8_t HDSL_get_safe_events(HDSL_Handle handle) {
  return hdsl_byte(handle, DSL_ADDR_EVENT_S);
}
static inline uint16_t HDSL_get_online_status_d(HDSL_Handle handle) {
  return hdsl_two_bytes(handle, DSL_ADDR_ONLINE_D_H);
}
static inline uint16_t HDSL_get_online_status_1(HDSL_Handle handle) {
  return hdsl_two_bytes(handle, DSL_ADDR_ONLINE_1_H);
}
static inline uint16_t HDSL_get_online_status_2(HDSL_Handle handle) {
  return hdsl_two_bytes(handle, DSL_ADDR_ONLINE_2_H);
}
static inline uint8_t HDSL_get_sum(HDSL_Handle handle) {
  return hdsl_byte(handle, DSL_ADDR_SUMMARY);
}
static inline uint8_t HDSL_get_acc_err_cnt(HDSL_Handle handle) {
  return hdsl_byte(handle, DSL_ADDR_ACC_ERR_CNT);
}
static inline uint8_t HDSL_get_rssi(HDSL_Handle handle) {
  return (uint8_t)(hdsl_byte(handle, DSL_ADDR_DELAY) >> 4 & 0xFU);
}
static inline uint8_t HDSL_get_delay(HDSL_Handle handle) {
  return (uint8_t)(hdsl_byte(handle, DSL_ADDR_DELAY) & 0xFU);
}
static inline uint8_t HDSL_get_edges(HDSL_Handle handle) {
  return hdsl_byte(handle, DSL_ADDR_EDGES);
}
static inline uint8_t HDSL_get_sync_ctrl(HDSL_Handle handle) {
  return hdsl_byte(handle, DSL_ADDR_SYNC_CTRL);
}
static inline int32_t HDSL_set_sync_ctrl(HDSL_Handle handle, uint8_t value) {
  return hdsl_status(dsl_write_byte(handle, DSL_ADDR_SYNC_CTRL, value));
}
/* byte: 0 to 2, ENC_ID0 to ENC_ID2. */
static inline uint8_t HDSL_get_enc_id(HDSL_Handle handle, int byte) {
  return byte < 0 || byte > 2
             ? (uint8_t)0xFF
             : hdsl_byte(handle, (uint8_t)(DSL_ADDR_ENC_ID0 - (uint8_t)byte));
}

/* Messages. The buffer of a long message: 0 to 7. */
static inline int32_t HDSL_write_pc_buffer(HDSL_Handle handle, uint8_t offset, uint8_t value) {
  return offset > 7 ? -(int32_t)DSL_ARGUMENT
                    : hdsl_status(
                          dsl_write_byte(handle, (uint8_t)(DSL_ADDR_PC_BUFFER0 + offset), value));
}
static inline uint8_t HDSL_read_pc_buffer(HDSL_Handle handle, uint8_t offset) {
  return offset > 7 ? (uint8_t)0xFF
                    : hdsl_byte(handle, (uint8_t)(DSL_ADDR_PC_BUFFER0 + offset));
}
static inline int32_t HDSL_set_pc_addr(HDSL_Handle handle, uint8_t address_h, uint8_t address_l,
                                       uint8_t offset_h, uint8_t offset_l) {
  const uint8_t bytes[4] = {address_h, address_l, offset_h, offset_l};
  uint8_t i;
  for (i = 0; i < 4; ++i) {
    const dsl_result done = dsl_write_byte(handle, (uint8_t)(DSL_ADDR_PC_ADD_H + i), bytes[i]);
    if (done.error != DSL_OK) {
      return hdsl_status(done);
    }
  }
  return 0;
}
static inline int32_t HDSL_set_pc_ctrl(HDSL_Handle handle, uint8_t value) {
  return hdsl_status(dsl_write_byte(handle, DSL_ADDR_PC_CTRL, value));
}
static inline int32_t HDSL_read_pc_short_msg(HDSL_Handle handle, uint8_t address, uint8_t *value,
                                             uint32_t limit_us) {
  return hdsl_status(dsl_short_read(handle, DSL_MAIN_HOST, address, limit_us, value));
}
static inline int32_t HDSL_write_pc_short_msg(HDSL_Handle handle, uint8_t address, uint8_t value,
                                              uint32_t limit_us) {
  return hdsl_status(dsl_short_write(handle, DSL_MAIN_HOST, address, value, limit_us));
}
static inline int32_t HDSL_read_pc_long_msg(HDSL_Handle handle, const dsl_long_request *request,
                                            dsl_long_answer *answer, uint32_t limit_us) {
  return request->write ? -(int32_t)DSL_ARGUMENT : hdsl_status(dsl_ask(handle, request, limit_us, answer));
}
static inline int32_t HDSL_write_pc_long_msg(HDSL_Handle handle, const dsl_long_request *request,
                                             uint32_t limit_us) {
  dsl_long_answer answer;
  return !request->write ? -(int32_t)DSL_ARGUMENT : hdsl_status(dsl_ask(handle, request, limit_us, &answer));
}

#ifdef __cplusplus
}
#endif

#endif /* HDSL_H_ */
