/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * For the examples as they stand, with the linker's --wrap: whatever scenario they open, its
 * encoders report an error (nE = 0, nW = 1). */
#include <stddef.h>

#include "mb4sim.h"

mb4sim *__real_mb4sim_open(const char *scenario_text, char *error, size_t error_size);
mb4sim *__real_mb4sim_open_file(const char *path, char *error, size_t error_size);
mb4sim *__wrap_mb4sim_open(const char *scenario_text, char *error, size_t error_size);
mb4sim *__wrap_mb4sim_open_file(const char *path, char *error, size_t error_size);

static mb4sim *with_error(mb4sim *sim) {
  for (unsigned slave = 1; sim != NULL && slave <= 8; ++slave) {
    (void)mb4sim_slave_set_data(sim, slave, 500U << 2 | 1U); /* no sensor: nothing happens */
  }
  return sim;
}

mb4sim *__wrap_mb4sim_open(const char *scenario_text, char *error, size_t error_size) {
  return with_error(__real_mb4sim_open(scenario_text, error, error_size));
}
mb4sim *__wrap_mb4sim_open_file(const char *path, char *error, size_t error_size) {
  return with_error(__real_mb4sim_open_file(path, error, error_size));
}
