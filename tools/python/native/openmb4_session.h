/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What the Python package adds to mb4sim.h and mb4.h: the driver on a simulator, so that Python has
 * no work in its SPI transfers. Python reads this file, mb4sim.h and mb4.h at run time.
 */
#ifndef OPENMB4_SESSION_H_
#define OPENMB4_SESSION_H_

#include "mb4.h"
#include "mb4sim.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A device whose bus and clock are a simulator. */
typedef struct {
  mb4_device device;
  mb4sim *sim;
  int error; /* of the simulator in the latest transfer that failed: MB4SIM_ERROR_..., or 0 */
} openmb4_session;

/* One row of an array of frames. */
typedef struct {
  uint64_t time_ns;  /* of the end of the call that read it */
  mb4_result result; /* of the whole frame; without MB4_OK every code of the frame is that error */
  mb4_frame frame;
} openmb4_row;

/* Call it before every other call on `session`. `sim` stays the caller's. */
void openmb4_begin(openmb4_session *session, mb4sim *sim);

/* Reads `count` frames: single ones (mb4_read_all()), or with `automatic` the next ones of
 * automatic operation (mb4_automatic_next()). Returns how many rows it has written: fewer only
 * after the simulator has failed; then session->error is set. */
size_t openmb4_read(openmb4_session *session, bool automatic, openmb4_row *rows, size_t count);

/* The configuration that `mb4sim run` gives to the chip: all slaves of a scenario. `scenario` is
 * its TOML text, or with `is_path` the name of its file. Returns 0, or MB4SIM_ERROR_VALUE and one
 * line in `error`, as mb4sim_open() does. */
int openmb4_config(const char *scenario, bool is_path, mb4_config *config, char *error,
                   size_t error_size);

#ifdef __cplusplus
}
#endif

#endif /* OPENMB4_SESSION_H_ */
