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

/* What a scenario has, for messages. */
typedef struct {
  char master[16];     /* "ic-mb4", "axi" ... */
  uint32_t f_clk_hz;   /* of the system clock */
  uint32_t slaves;     /* members of `slave` in use */
  struct {
    uint8_t number; /* as mb4sim_slave_set_data() counts */
    uint8_t channel;
    uint8_t data_bits;
    char protocol[13];
  } slave[64];
} openmb4_scenario;

/* A new level that openmb4_record() has seen; `name` is the index of what has it. */
typedef struct {
  uint64_t time_ps;
  uint32_t name;
  uint32_t level;
} openmb4_edge;

/* What openmb4_record() has seen, in the order of time. */
typedef struct {
  const openmb4_edge *edges;
  size_t count;
  void *memory;
} openmb4_edges;

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

/* Lets `ns` pass and keeps every new level of `n` wires, first their present ones. A wire is a pin
 * (place[i] is -1, name[i] its name), or a place of a line: place[i] is MB4SIM_EDGE_..., channel[i]
 * its channel. Returns 0 or the error of mb4sim_watch_pins() or mb4sim_on_edge(), whose callback it
 * replaces. `*edges` is to be freed in every case. */
int openmb4_record(mb4sim *sim, const char *const *name, const int *place, const unsigned *channel,
                   size_t n, uint64_t ns, openmb4_edges *edges);
void openmb4_free(openmb4_edges *edges);

/* The scenario in short; its arguments are those of openmb4_config(). */
int openmb4_describe(const char *scenario, bool is_path, openmb4_scenario *found, char *error,
                     size_t error_size);

/* Writes GTKWave's view of a finished waveform to `view`, as `mb4sim run --trace` does. Returns 0,
 * or MB4SIM_ERROR_TRACE and one line in `error`. */
int openmb4_write_view(const char *scenario, bool is_path, const char *trace, const char *view,
                       char *error, size_t error_size);

#ifdef __cplusplus
}
#endif

#endif /* OPENMB4_SESSION_H_ */
