/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 */
#define _GNU_SOURCE
#include "caller_memory.h"

#include <errno.h>
#include <stdint.h>
#include <string.h>
#include <sys/uio.h>
#include <unistd.h>

typedef ssize_t carrier(pid_t, const struct iovec *, unsigned long, const struct iovec *,
                        unsigned long, unsigned long);

/* Page by page: the kernel carries a part in full or not at all. */
static size_t carry(carrier *carry_part, void *own, const void *caller, size_t size) {
  const uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE);
  const int error = errno;
  size_t done = 0;
  while (done < size) {
    const uintptr_t at = (uintptr_t)caller + done;
    const size_t in_page = page - at % page;
    const size_t part = size - done < in_page ? size - done : in_page;
    const struct iovec here = {(char *)own + done, part};
    const struct iovec there = {(void *)at, part};
    errno = EFAULT;
    if (carry_part(getpid(), &here, 1, &there, 1, 0) != (ssize_t)part) {
      if (errno == EFAULT) break;
      /* A sandbox without these calls: take the pointer as it is. */
      if (carry_part == process_vm_readv) {
        memcpy(here.iov_base, there.iov_base, part);
      } else {
        memcpy(there.iov_base, here.iov_base, part);
      }
    }
    done += part;
  }
  errno = error;
  return done;
}

size_t read_caller(void *to, const void *caller, size_t size) {
  return carry(process_vm_readv, to, caller, size);
}

size_t write_caller(void *caller, const void *from, size_t size) {
  return carry(process_vm_writev, (void *)(uintptr_t)from, caller, size);
}

static int all(size_t done, size_t size) {
  if (done == size) return 0;
  errno = EFAULT;
  return -1;
}

int get_from_caller(void *to, const void *caller, size_t size) {
  return all(read_caller(to, caller, size), size);
}

int give_to_caller(void *caller, const void *from, size_t size) {
  return all(write_caller(caller, from, size), size);
}
