/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The board is `mb4sim bridge` at the other end of a Unix socket, whose path stands in the
 * environment variable CHIP. An emulator does the same in its model of an SPI controller. Requests:
 * docs/bridge.md.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>

#include "board.h"

static void fail(const char *what) {
  fprintf(stderr, "bridge: %s\n", what);
  exit(1);
}

static int bridge(void) {
  static int connected = -1;
  const char *path = getenv("CHIP");
  struct sockaddr_un address = {.sun_family = AF_UNIX};
  if (connected >= 0) return connected;
  if (path == NULL || strlen(path) >= sizeof address.sun_path) fail("CHIP is no path of a socket");
  strcpy(address.sun_path, path);
  connected = socket(AF_UNIX, SOCK_STREAM, 0);
  if (connect(connected, (struct sockaddr *)&address, sizeof address) != 0) fail("nobody listens");
  return connected;
}

/* One request with a payload of `size` bytes; the answer's payload, as many bytes, goes to
 * `answer`. */
static void request(char kind, const uint8_t *payload, uint8_t *answer, size_t size) {
  uint8_t head[3] = {(uint8_t)kind, (uint8_t)size, (uint8_t)(size >> 8)};
  if (send(bridge(), head, 3, MSG_NOSIGNAL) != 3 ||
      send(bridge(), payload, size, MSG_NOSIGNAL) != (ssize_t)size ||
      recv(bridge(), head, 3, MSG_WAITALL) != 3 || head[0] != 0 ||
      recv(bridge(), answer, size, MSG_WAITALL) != (ssize_t)size) {
    fail("the simulator refuses or has gone");
  }
}

void board_transfer(const uint8_t *tx, uint8_t *rx, size_t size) { request('T', tx, rx, size); }

void board_wait_us(unsigned us) {
  uint8_t time[8] = {0};
  for (int i = 0; i < 8; ++i) time[i] = (uint8_t)((us * 1000ULL) >> (8 * i));
  request('W', time, time, sizeof time);
}
