/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 */
#define _GNU_SOURCE
#include "bridge_client.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

enum { HEADER = 3, STATUS_GOOD = 0, STATUS_REFUSED = 2, FIRST_FD = 64 };

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_once_t once = PTHREAD_ONCE_INIT;
static struct sockaddr_un address = {.sun_family = AF_UNIX};
static int connection = -1;
static struct stat identity; /* of the connection, because a program may close it */

void bridge_set_path(const char *path) {
  snprintf(address.sun_path, sizeof address.sun_path, "%s", path);
}

static void lock(void) { pthread_mutex_lock(&mutex); }
static void unlock(void) { pthread_mutex_unlock(&mutex); }

/* The parent still uses the connection; the requests of both processes would mix. */
static void forget(void) {
  if (connection >= 0) syscall(SYS_close, connection);
  connection = -1;
  pthread_mutex_unlock(&mutex);
}

static void prepare(void) { pthread_atfork(lock, unlock, forget); }

static int still_ours(void) {
  struct stat now;
  return connection >= 0 && fstat(connection, &now) == 0 && now.st_dev == identity.st_dev &&
         now.st_ino == identity.st_ino;
}

static int connect_bridge(void) {
  if (still_ours()) return 0;
  connection = -1;
  const int low = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (low < 0) return -1;
  /* Takes a high number, because some programs expect that low numbers are free. */
  int fd = fcntl(low, F_DUPFD_CLOEXEC, FIRST_FD);
  if (fd < 0) fd = low;
  if (fd != low) syscall(SYS_close, low);
  if (connect(fd, (const struct sockaddr *)&address, sizeof address) != 0 ||
      fstat(fd, &identity) != 0) {
    syscall(SYS_close, fd);
    errno = ENODEV;
    return -1;
  }
  connection = fd;
  return 0;
}

static int lost(void) {
  syscall(SYS_close, connection);
  connection = -1;
  errno = ENODEV;
  return -1;
}

static int send_all(const uint8_t *bytes, size_t length) {
  while (length > 0) {
    const ssize_t count = send(connection, bytes, length, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return lost();
    bytes += count;
    length -= (size_t)count;
  }
  return 0;
}

static int receive_all(uint8_t *bytes, size_t length) {
  while (length > 0) {
    const ssize_t count = recv(connection, bytes, length, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return lost();
    bytes += count;
    length -= (size_t)count;
  }
  return 0;
}

static long exchange(char request, const uint8_t *payload, size_t length, uint8_t *answer,
                     size_t size) {
  if (connect_bridge() != 0) return -1;
  const uint8_t head[HEADER] = {(uint8_t)request, (uint8_t)length, (uint8_t)(length >> 8)};
  uint8_t status[HEADER];
  if (send_all(head, HEADER) != 0 || send_all(payload, length) != 0 ||
      receive_all(status, HEADER) != 0) {
    return -1;
  }
  uint8_t text[256]; /* the text of an error, read only to reach the next answer */
  size_t left = (size_t)(status[1] | status[2] << 8);
  if (status[0] == STATUS_GOOD && left <= size) {
    return receive_all(answer, left) == 0 ? (long)left : -1;
  }
  while (left > 0) {
    const size_t part = left < sizeof text ? left : sizeof text;
    if (receive_all(text, part) != 0) return -1;
    left -= part;
  }
  errno = status[0] == STATUS_REFUSED ? EINVAL : EIO;
  return -1;
}

long bridge_request(char request, const uint8_t *payload, size_t length, uint8_t *answer,
                    size_t size) {
  if (length > BRIDGE_MAX_PAYLOAD) {
    errno = EMSGSIZE;
    return -1;
  }
  pthread_once(&once, prepare);
  /* A signal handler or a cancelled thread must not leave half a request behind. */
  sigset_t all, before;
  int cancel;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &cancel);
  lock();
  const long result = exchange(request, payload, length, answer, size);
  const int error = errno;
  unlock();
  pthread_setcancelstate(cancel, NULL);
  pthread_sigmask(SIG_SETMASK, &before, NULL);
  errno = error;
  return result;
}
