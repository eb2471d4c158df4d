/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A connection to the bridge of mb4sim (docs/bridge.md), one for each process: a child made by fork
 * gets its own with its first request. Used by several threads at once.
 */
#ifndef MB4_TOOLS_SPIDEV_BRIDGE_CLIENT_H_
#define MB4_TOOLS_SPIDEV_BRIDGE_CLIENT_H_

#include <stddef.h>
#include <stdint.h>

enum { BRIDGE_MAX_PAYLOAD = 0xFFFF };

/* Sets the place at which the simulator listens; mb4sim tells it to the library. */
void bridge_set_path(const char *path);

/* Carries out one request. The answer's payload, at most `size` bytes, goes to `answer` and its
 * length is returned. Else -1 and errno: EINVAL (the simulator refuses a value), EIO (the
 * simulation has stopped, or an answer makes no sense), ENODEV (there is no simulator any more). */
long bridge_request(char request, const uint8_t *payload, size_t length, uint8_t *answer,
                    size_t size);

#endif /* MB4_TOOLS_SPIDEV_BRIDGE_CLIENT_H_ */
