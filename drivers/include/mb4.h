/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The driver for C99: the same code as mb4/mb4.hpp, compiled once in c/mb4_c.cpp. It uses no heap
 * and no static data.
 *
 * The comment of the C++ call with the same name states what a call does, its transfers, ranges and
 * errors: mb4/device.hpp, automatic.hpp, control.hpp, scan.hpp, enc/position.hpp. That of
 * mb4_slave_begin_read() to mb4_slave_take() is in c/mb4_c_access.hpp. mb4/error.hpp and
 * docs/driver.md describe the errors. No pointer may be null unless its comment allows it. Outputs
 * are valid only on success unless the comment says otherwise.
 */
#ifndef MB4_H_
#define MB4_H_

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "mb4_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The compiler warns where a result is dropped (GCC, Clang). */
#if defined(__GNUC__)
#define MB4_RESULT __attribute__((warn_unused_result)) mb4_result
#else
#define MB4_RESULT mb4_result
#endif

/* Makes one SPI frame: NCS low, `size` bytes, NCS high. rx may be null. The contract is that of Bus
 * in mb4/bus.hpp. Returns true when all bytes were exchanged. */
typedef bool (*mb4_transfer)(void *context, const uint8_t *tx, uint8_t *rx, size_t size);
/* Returns the time in microseconds; it wraps at 2^32. mb4_automatic_poll() and
 * mb4_automatic_poll_slave() ask for it too: in an interrupt it must be safe there. */
typedef uint32_t (*mb4_now_us)(void *context);

/* One chip. The caller provides the memory and does not use its contents. */
typedef struct {
  uint64_t opaque[128];
} mb4_device;

/* Call it before every other call on `device`. It makes no transfer. The functions must not be
 * null; the contexts may be. */
void mb4_open(mb4_device *device, mb4_transfer transfer, void *transfer_context, mb4_now_us now_us,
              void *clock_context);

/* The default values of mb4::Config. ma_hz, the protocols and the slaves are still to be set. */
mb4_config mb4_config_default(void);
/* Largest frequency of table 35 that is at most `limit_hz`; 0 if there is none. */
uint32_t mb4_ma_hz_at_most(uint32_t f_clk_hz, uint32_t limit_hz);
/* Shortest frame period of table 37 that is at least `period_ns`, in clocks; 0 if there is none. */
uint32_t mb4_frame_period_clk_at_least(uint32_t f_clk_hz, uint32_t period_ns);
MB4_RESULT mb4_validate(const mb4_config *config);

MB4_RESULT mb4_probe(mb4_device *device, uint8_t *version, uint8_t *revision);
MB4_RESULT mb4_configure(mb4_device *device, const mb4_config *config);
MB4_RESULT mb4_verify(mb4_device *device);
MB4_RESULT mb4_reset(mb4_device *device);
/* quarters: line delay of channels 1 and 2 in quarters of a period of MA, 0..255. */
MB4_RESULT mb4_initialize(mb4_device *device, uint8_t quarters[MB4_CHANNELS]);
MB4_RESULT mb4_read_frame(mb4_device *device, uint8_t slave, mb4_reading *reading);
MB4_RESULT mb4_read_all(mb4_device *device, mb4_frame *frame);
/* `word` for the actuator `slave` (1..8): at most data_bits bits. */
MB4_RESULT mb4_write_actuator(mb4_device *device, uint8_t slave, uint64_t word);
MB4_RESULT mb4_break_transmission(mb4_device *device);
MB4_RESULT mb4_read_status(mb4_device *device, uint8_t status[MB4_STATUS_BYTES]);
MB4_RESULT mb4_clear_valid(mb4_device *device, uint8_t slave);

MB4_RESULT mb4_automatic_start(mb4_device *device);
MB4_RESULT mb4_automatic_stop(mb4_device *device);
MB4_RESULT mb4_automatic_restart(mb4_device *device);
MB4_RESULT mb4_automatic_poll(mb4_device *device, mb4_frame *frame);
MB4_RESULT mb4_automatic_poll_slave(mb4_device *device, uint8_t slave, mb4_reading *reading);
MB4_RESULT mb4_automatic_write_actuator(mb4_device *device, uint8_t slave, uint64_t word);
MB4_RESULT mb4_automatic_next(mb4_device *device, mb4_frame *frame);

MB4_RESULT mb4_slave_read(mb4_device *device, uint8_t channel, uint8_t id, uint8_t address,
                          uint8_t *data, size_t size);
MB4_RESULT mb4_slave_write(mb4_device *device, uint8_t channel, uint8_t id, uint8_t address,
                           const uint8_t *data, size_t size);
MB4_RESULT mb4_slave_command(mb4_device *device, const mb4_command *command);
/* `ids`, `ids_2`: bit 0 is ID 0, of channel 1 and 2; both 0: those of the enabled slaves. */
MB4_RESULT mb4_slave_activate(mb4_device *device, uint8_t ids, uint8_t ids_2);
MB4_RESULT mb4_slave_begin_read(mb4_device *device, uint8_t channel, uint8_t id, uint8_t address,
                                size_t size);
MB4_RESULT mb4_slave_begin_write(mb4_device *device, uint8_t channel, uint8_t id, uint8_t address,
                                 const uint8_t *data, size_t size);
MB4_RESULT mb4_slave_begin_command(mb4_device *device, const mb4_command *command);
/* `ended` becomes true when the access has ended without error, otherwise false. */
MB4_RESULT mb4_slave_poll(mb4_device *device, bool *ended);
MB4_RESULT mb4_slave_take(mb4_device *device, uint8_t *data, size_t size);
MB4_RESULT mb4_slave_abort(mb4_device *device);
/* Stores the identities of up to `size` IDs; `count` becomes the number of IDs that have answered,
 * 0 on error. */
MB4_RESULT mb4_scan(mb4_device *device, uint8_t channel, mb4_identity *identities, size_t size,
                    uint8_t *count);

/* ---- Operations in steps ----
 *
 * The driver plans SPI frames, the caller makes them, by DMA or otherwise, and the driver takes
 * what came back. The comments of mb4::Operation (mb4/operation.hpp) and of the C++ calls with the
 * same name state steps, pauses and errors, and what wrong use answers:
 *
 *   mb4_operation_begin(&operation);                      // once
 *   if (mb4_plan_restart(&device, &operation).code == MB4_OK) {
 *     do {
 *       size_t count = mb4_operation_frames(&operation, frames, &pause_us);
 *       ...   // waits pause_us, then makes the frames one after the other, NCS low for each
 *     } while (!mb4_finish(&device, &operation, transferred, now_us()));
 *     result = mb4_operation_result(&operation);
 *   }
 *
 * No call below makes a transfer or asks for the time. */

enum { MB4_STEP_FRAMES = 18 /* most frames of a step; of an operation 4 */ };

/* One SPI frame to make: `size` bytes from tx, while as many are received into rx; null: not
 * needed. Each begins at a whole word. */
typedef struct {
  const uint8_t *tx;
  uint8_t *rx;
  size_t size;
} mb4_spi_frame;

/* The memory of an operation, where DMA reaches it. The caller does not use its contents; it stays
 * where it is until the operation has ended. */
typedef struct {
  uint64_t opaque[40];
} mb4_operation;
/* The same for reads of the positions of all slaves: mb4::FrameRead. */
typedef struct {
  uint64_t opaque[72];
} mb4_frame_read;

/* Call it before the first other call on the object. */
void mb4_operation_begin(mb4_operation *operation);
void mb4_frame_read_begin(mb4_frame_read *read);

MB4_RESULT mb4_plan_configure(mb4_device *device, mb4_operation *operation,
                              const mb4_config *config);
MB4_RESULT mb4_plan_verify(mb4_device *device, mb4_operation *operation);
MB4_RESULT mb4_plan_initialize(mb4_device *device, mb4_operation *operation);
/* `read` holds the frames; then mb4_frame_read_result(). */
MB4_RESULT mb4_plan_read_all(mb4_device *device, mb4_operation *operation, mb4_frame_read *read);
MB4_RESULT mb4_plan_actuator(mb4_device *device, mb4_operation *operation, uint8_t slave,
                             uint64_t word);
MB4_RESULT mb4_plan_break(mb4_device *device, mb4_operation *operation);
MB4_RESULT mb4_plan_start(mb4_device *device, mb4_operation *operation);
MB4_RESULT mb4_plan_stop(mb4_device *device, mb4_operation *operation);
MB4_RESULT mb4_plan_restart(mb4_device *device, mb4_operation *operation);
MB4_RESULT mb4_plan_automatic_actuator(mb4_device *device, mb4_operation *operation, uint8_t slave,
                                       uint64_t word);
/* `data` stays until the operation has ended. size 1..64. */
MB4_RESULT mb4_plan_slave_read(mb4_device *device, mb4_operation *operation, uint8_t channel,
                               uint8_t id, uint8_t address, uint8_t *data, size_t size);
MB4_RESULT mb4_plan_slave_write(mb4_device *device, mb4_operation *operation, uint8_t channel,
                                uint8_t id, uint8_t address, const uint8_t *data, size_t size);
MB4_RESULT mb4_plan_slave_command(mb4_device *device, mb4_operation *operation,
                                  const mb4_command *command);
MB4_RESULT mb4_plan_slave_activate(mb4_device *device, mb4_operation *operation, uint8_t ids,
                                   uint8_t ids_2);

/* The frames to make now, at most MB4_STEP_FRAMES: fills `frames` and `pause_us` and returns their
 * number. */
size_t mb4_operation_frames(mb4_operation *operation, mb4_spi_frame *frames, uint32_t *pause_us);
/* `transferred`: all of them were made, in order. True: the operation has ended. */
bool mb4_finish(mb4_device *device, mb4_operation *operation, bool transferred, uint32_t now_us);
MB4_RESULT mb4_operation_result(const mb4_operation *operation);
/* After mb4_plan_initialize(): as of mb4_initialize(). */
void mb4_operation_line_delay(const mb4_operation *operation, uint8_t quarters[MB4_CHANNELS]);

/* mb4_automatic_poll() in steps: Automatic::plan(), finish() and FrameRead::result(). For one slave
 * without the driver's library: mb4_cyclic.h. */
MB4_RESULT mb4_plan_frame(mb4_device *device, mb4_frame_read *read, bool wide);
size_t mb4_frame_read_frames(mb4_frame_read *read, mb4_spi_frame *frames);
bool mb4_finish_frame(mb4_device *device, mb4_frame_read *read, bool transferred, uint32_t now_us);
MB4_RESULT mb4_frame_read_result(const mb4_frame_read *read, mb4_frame *frame);

/* ---- BiSS Safety (BP3) ----
 *
 * Two slaves bring the two words of one sensor. mb4/safety.hpp and enc/safety.hpp state members,
 * checks and their order; docs/safety.md says what is found and what stays with the caller:
 *
 *   mb4_safety_config words = mb4_bp3_safety(26, 26, 0, 0x1234);
 *   mb4_safety_fits(&config, 1, 2, &words);                // once: slave 1 is CPW, slave 2 is SPW
 *   mb4_safety_configure(&safety, &words);
 *   if (mb4_automatic_poll(&device, &frame).code == MB4_OK) ...
 *   mb4_safety_check(&safety, &frame, 1, 2, 1, &verdict);  // for each frame that was due
 *   if (verdict.checks_failed == 0) control(verdict.position);
 *
 * No call makes a transfer, waits or asks for the time. All calls on one mb4_safety belong in one
 * context. */

/* The check's memory. The caller does not use its contents. */
typedef struct {
  uint64_t opaque[12];
} mb4_safety;

/* The layout of BP3 for positions of so many bits, with the start values of both CRCs. */
mb4_safety_config mb4_bp3_safety(uint8_t control_bits, uint8_t safety_bits, uint16_t control_start,
                                 uint16_t safety_start);
/* Slaves `control` and `safety` (1..8, not the same) of a valid `config` bring these words, each
 * with its CRC. MB4_INVALID_ARGUMENT; MB4_UNSUPPORTED with field and number. */
MB4_RESULT mb4_safety_fits(const mb4_config *config, uint8_t control, uint8_t safety,
                           const mb4_safety_config *words);
/* Call it before the first other call on the object. MB4_INVALID_ARGUMENT: `words` is not possible;
 * `number` is the number of the wrong member, enc::SafetyField. Each check then fails. */
MB4_RESULT mb4_safety_configure(mb4_safety *safety, const mb4_safety_config *words);
/* The counter of the next word is compared with none before. */
void mb4_safety_restart(mb4_safety *safety);
/* Checks the words of the slaves `control_slave` and `safety_slave` (1..8; another number: the word
 * is missing). `frame`: as a call has filled it that reads all slaves, also after its error; null:
 * no frame. `frames`: those that the sensor has sent since the call before, 0 counts as 1. */
void mb4_safety_check(mb4_safety *safety, const mb4_frame *frame, uint8_t control_slave,
                      uint8_t safety_slave, uint32_t frames, mb4_safety_verdict *verdict);
/* Short text of a check, MB4_SAFETY_...; never null. */
const char *mb4_safety_text(uint8_t check);

/* ---- A value for several contexts ----
 *
 * enc::Snapshot (enc/snapshot.hpp) in memory of the caller: one context writes, any number of
 * others read, without a lock. A reader never gets parts of two values, and the writer never waits.
 *
 *   static uint32_t latest[MB4_SNAPSHOT_WORDS(sizeof(mb4_safety_verdict))];  // all 0 at first
 *   mb4_snapshot_write(latest, &verdict, sizeof verdict);                    // in the interrupt
 *   if (mb4_snapshot_read(latest, &verdict, sizeof verdict)) ...             // in a task
 *
 * `size` is the same in each call on one snapshot, a multiple of 4, and `value` begins at a whole
 * word. */

/* Words of a snapshot of a value of `size` bytes: a size of an array. */
#define MB4_SNAPSHOT_WORDS(size) (2U + (size) / 2U) /* NOLINT(cppcoreguidelines-macro-usage) */

/* Makes the value the newest. Never waits. All calls belong in one context. */
void mb4_snapshot_write(uint32_t *snapshot, const void *value, size_t size);
/* Copies the newest value. It copies again only if the writer comes twice meanwhile; for a writer
 * that comes so often it would not end. False: nothing was written yet, `value` is unchanged. Any
 * context may call it, also one that has interrupted the writer. */
bool mb4_snapshot_read(const uint32_t *snapshot, void *value, size_t size);
/* The number of writes, modulo 2^31: a reader tells by it whether there is a new value. */
uint32_t mb4_snapshot_writes(const uint32_t *snapshot);

/* SPI opcodes 0x02 and 0x03 without any protection of bits; size 1..64. */
MB4_RESULT mb4_write_registers(mb4_device *device, uint8_t address, const uint8_t *data,
                               size_t size);
MB4_RESULT mb4_read_registers(mb4_device *device, uint8_t address, uint8_t *data, size_t size);

/* Text of mb4_result.code and mb4_result.field; never null. */
const char *mb4_error_text(uint8_t code);
const char *mb4_field_text(uint8_t field);

/* Arithmetic on positions; see mb4/position.hpp for the ranges. */
int64_t mb4_to_signed(uint64_t position, uint8_t bits);
uint64_t mb4_gray_to_binary(uint64_t gray);
uint64_t mb4_binary_to_gray(uint64_t binary);
MB4_RESULT mb4_split_turns(uint64_t position, uint8_t multi_bits, uint8_t single_bits,
                           uint64_t *multi, uint64_t *single);

/* mb4::PositionTracker in mb4/position.hpp. Call mb4_tracker_begin() first. */
typedef struct {
  uint64_t opaque[4];
} mb4_tracker;
void mb4_tracker_begin(mb4_tracker *tracker, uint8_t bits, uint64_t max_step);
MB4_RESULT mb4_tracker_update(mb4_tracker *tracker, uint64_t position, int64_t *total);

#undef MB4_RESULT

#ifdef __cplusplus
}
#endif

#endif /* MB4_H_ */
