/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 */
#define _GNU_SOURCE
#include "simulated_time.h"

#include <errno.h>
#include <stdatomic.h>
#include <stdint.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include "bridge_client.h"
#include "caller_memory.h"
#include "next_function.h"

enum { CLOCKS = 16 };

static const int64_t NS_PER_S = 1000000000;
static const int64_t LOOK_NS = 1000;              /* a look at a clock */
static const int64_t MAX_WAIT_NS = 1000000000000; /* of one request W */

static int on;
static _Atomic int64_t offsets[CLOCKS]; /* of each clock to simulated time; 0: not known yet */

void simulated_time_on(void) { on = 1; }

static int64_t to_ns(const struct timespec *time) {
  return (int64_t)time->tv_sec * NS_PER_S + time->tv_nsec;
}

/* Clocks that show simulated time; processor time stays what it is. */
static int moves(clockid_t clock) {
  return clock == CLOCK_REALTIME || clock == CLOCK_MONOTONIC || clock == CLOCK_MONOTONIC_RAW ||
         clock == CLOCK_BOOTTIME || clock == CLOCK_REALTIME_COARSE ||
         clock == CLOCK_MONOTONIC_COARSE;
}

/* Simulated time after `ns` have passed, or -1 if the simulator cannot be asked. */
static int64_t pass(int64_t ns) {
  const int error = errno;
  int64_t now = -1;
  do {
    const int64_t part = ns < MAX_WAIT_NS ? ns : MAX_WAIT_NS;
    uint8_t payload[8], answer[8];
    for (unsigned i = 0; i < 8; ++i) payload[i] = (uint8_t)((uint64_t)part >> 8 * i);
    if (bridge_request('W', payload, sizeof payload, answer, sizeof answer) != sizeof answer) {
      errno = error;
      return -1;
    }
    now = 0;
    for (unsigned i = 8; i-- > 0;) now = now << 8 | answer[i];
    ns -= part;
  } while (ns > 0);
  return now;
}

static int sleep_there(int64_t ns) { return pass(ns > 0 ? ns : 0) < 0 ? -1 : 0; }

EXPORT int clock_gettime(clockid_t clock, struct timespec *time) {
  const int result = NEXT(clock_gettime)(clock, time);
  if (result != 0 || !on || !moves(clock)) return result;
  const int64_t simulated = pass(LOOK_NS);
  if (simulated < 0) return 0;
  int64_t offset = 0;
  if (atomic_compare_exchange_strong(&offsets[clock], &offset, to_ns(time) - simulated)) {
    return 0; /* the first reading: simulated time continues from here */
  }
  time->tv_sec = (time_t)((offset + simulated) / NS_PER_S);
  time->tv_nsec = (long)((offset + simulated) % NS_PER_S);
  return 0;
}

EXPORT int gettimeofday(struct timeval *restrict time, void *restrict zone) {
  if (!on) return NEXT(gettimeofday)(time, zone);
  struct timespec now;
  if (clock_gettime(CLOCK_REALTIME, &now) != 0) return -1;
  time->tv_sec = now.tv_sec;
  time->tv_usec = now.tv_nsec / 1000;
  return 0;
}

/* True if the requested time is readable and valid; otherwise the C library answers. */
static int is_valid(const struct timespec *wanted, struct timespec *copy) {
  return read_caller(copy, wanted, sizeof *copy) == sizeof *copy && copy->tv_sec >= 0 &&
         copy->tv_nsec >= 0 && copy->tv_nsec < NS_PER_S;
}

EXPORT int nanosleep(const struct timespec *wanted, struct timespec *left) {
  struct timespec time;
  if (on && is_valid(wanted, &time) && sleep_there(to_ns(&time)) == 0) return 0;
  return NEXT(nanosleep)(wanted, left);
}

EXPORT int clock_nanosleep(clockid_t clock, int flags, const struct timespec *wanted,
                           struct timespec *left) {
  struct timespec time, now;
  if (on && is_valid(wanted, &time)) {
    int64_t ns = to_ns(&time);
    if ((flags & TIMER_ABSTIME) != 0 && clock_gettime(clock, &now) == 0) ns -= to_ns(&now);
    if (sleep_there(ns) == 0) return 0;
  }
  return NEXT(clock_nanosleep)(clock, flags, wanted, left);
}

EXPORT int usleep(useconds_t us) {
  const struct timespec wanted = {us / 1000000, (long)(us % 1000000) * 1000};
  return nanosleep(&wanted, NULL);
}

EXPORT unsigned sleep(unsigned seconds) {
  if (on && sleep_there((int64_t)seconds * NS_PER_S) == 0) return 0;
  return NEXT(sleep)(seconds);
}
