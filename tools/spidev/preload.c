/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Preload library of `mb4sim spidev`: calls that name the device or a descriptor of it go to the
 * simulator, all others to the C library. Opening the device opens an empty file of mb4sim's in its
 * place, and a descriptor is the device's if it shows that file: so dup, fcntl, close, fork and
 * exec need no help.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/uio.h>
#include <unistd.h>

#include "bridge_client.h"
#include "next_function.h"
#include "simulated_time.h"
#include "spidev_device.h"

enum { PATH_SIZE = 4096, SPIDEV_MAJOR = 153 };

static char device[PATH_SIZE]; /* the node that is taken; empty: none */
static char token[PATH_SIZE];  /* the file in its place */
static struct stat token_status;

void *next_function(const char *name) {
  void *const found = dlsym(RTLD_NEXT, name);
  if (found == NULL) {
    fprintf(stderr, "mb4sim spidev: the C library has no %s\n", name);
    _exit(127);
  }
  return found;
}

__attribute__((constructor)) static void start(void) {
  const char *const name = getenv("MB4SIM_SPIDEV_DEVICE");
  const char *const folder = getenv("MB4SIM_SPIDEV_DIR");
  const char *const time = getenv("MB4SIM_SPIDEV_TIME");
  if (name == NULL || folder == NULL) return;
  char socket_path[PATH_SIZE];
  snprintf(socket_path, sizeof socket_path, "%s/socket", folder);
  snprintf(token, sizeof token, "%s/device", folder);
  bridge_set_path(socket_path);
  if (time != NULL && strcmp(time, "simulated") == 0) simulated_time_on();
  if (fstatat(AT_FDCWD, token, &token_status, 0) == 0) {
    snprintf(device, sizeof device, "%s", name);
  }
}

static int is_device_path(const char *path) {
  return device[0] != '\0' && path != NULL && strcmp(path, device) == 0;
}

static int is_device(int fd) {
  struct stat status;
  const int error = errno;
  const int yes = device[0] != '\0' && fstat(fd, &status) == 0 &&
                  status.st_dev == token_status.st_dev && status.st_ino == token_status.st_ino;
  errno = error;
  return yes;
}

/* As the kernel looks before it asks the driver. */
static int is_open_for(int fd, int unwanted) {
  if ((fcntl(fd, F_GETFL) & O_ACCMODE) != unwanted) return 1;
  errno = EBADF;
  return 0;
}

static int open_token(int flags) {
  const int kept = O_ACCMODE | O_CLOEXEC | O_NONBLOCK;
  return NEXT(openat)(AT_FDCWD, token, flags & kept);
}

static mode_t mode_of(int flags, va_list *arguments) {
  const int has_mode = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
  return has_mode ? va_arg(*arguments, mode_t) : 0;
}

#define DEFINE_OPEN(name)                               \
  EXPORT int name(const char *path, int flags, ...) {   \
    if (is_device_path(path)) return open_token(flags); \
    va_list arguments;                                  \
    va_start(arguments, flags);                         \
    const mode_t mode = mode_of(flags, &arguments);     \
    va_end(arguments);                                  \
    return NEXT(name)(path, flags, mode);               \
  }
#define DEFINE_OPENAT(name)                                       \
  EXPORT int name(int folder, const char *path, int flags, ...) { \
    if (is_device_path(path)) return open_token(flags);           \
    va_list arguments;                                            \
    va_start(arguments, flags);                                   \
    const mode_t mode = mode_of(flags, &arguments);               \
    va_end(arguments);                                            \
    return NEXT(name)(folder, path, flags, mode);                 \
  }
DEFINE_OPEN(open)
DEFINE_OPEN(open64)
DEFINE_OPENAT(openat)
DEFINE_OPENAT(openat64)

/* What _FORTIFY_SOURCE makes of the same calls. */
extern int __open_2(const char *path, int flags);
extern int __open64_2(const char *path, int flags);
extern int __openat_2(int folder, const char *path, int flags);
extern int __openat64_2(int folder, const char *path, int flags);
extern ssize_t __read_chk(int fd, void *buffer, size_t size, size_t room);

EXPORT int __open_2(const char *path, int flags) {
  return is_device_path(path) ? open_token(flags) : NEXT(__open_2)(path, flags);
}
EXPORT int __open64_2(const char *path, int flags) {
  return is_device_path(path) ? open_token(flags) : NEXT(__open64_2)(path, flags);
}
EXPORT int __openat_2(int folder, const char *path, int flags) {
  return is_device_path(path) ? open_token(flags) : NEXT(__openat_2)(folder, path, flags);
}
EXPORT int __openat64_2(int folder, const char *path, int flags) {
  return is_device_path(path) ? open_token(flags) : NEXT(__openat64_2)(folder, path, flags);
}

EXPORT ssize_t read(int fd, void *buffer, size_t size) {
  if (!is_device(fd)) return NEXT(read)(fd, buffer, size);
  return is_open_for(fd, O_WRONLY) ? spidev_read(buffer, size) : -1;
}
EXPORT ssize_t __read_chk(int fd, void *buffer, size_t size, size_t room) {
  if (!is_device(fd)) return NEXT(__read_chk)(fd, buffer, size, room);
  if (size > room) abort();
  return read(fd, buffer, size);
}
EXPORT ssize_t write(int fd, const void *buffer, size_t size) {
  if (!is_device(fd)) return NEXT(write)(fd, buffer, size);
  return is_open_for(fd, O_RDONLY) ? spidev_write(buffer, size) : -1;
}

/* A transfer for each part, as the kernel does it for drivers that know no vectors. */
EXPORT ssize_t readv(int fd, const struct iovec *parts, int count) {
  if (!is_device(fd)) return NEXT(readv)(fd, parts, count);
  ssize_t total = 0;
  for (int i = 0; i < count; ++i) {
    const ssize_t got = read(fd, parts[i].iov_base, parts[i].iov_len);
    if (got < 0) return total > 0 ? total : -1;
    total += got;
  }
  return total;
}
EXPORT ssize_t writev(int fd, const struct iovec *parts, int count) {
  if (!is_device(fd)) return NEXT(writev)(fd, parts, count);
  ssize_t total = 0;
  for (int i = 0; i < count; ++i) {
    const ssize_t sent = write(fd, parts[i].iov_base, parts[i].iov_len);
    if (sent < 0) return total > 0 ? total : -1;
    total += sent;
  }
  return total;
}

EXPORT off_t lseek(int fd, off_t offset, int whence) {
  if (!is_device(fd)) return NEXT(lseek)(fd, offset, whence);
  errno = ESPIPE;
  return -1;
}

EXPORT int ioctl(int fd, unsigned long request, ...) {
  va_list arguments;
  va_start(arguments, request);
  void *const argument = va_arg(arguments, void *);
  va_end(arguments);
  return is_device(fd) ? spidev_ioctl(request, argument) : NEXT(ioctl)(fd, request, argument);
}

/* --- programs that look before they open ------------------------------------------------- */

#define DEVICE_STATUS(status)                   \
  memset(status, 0, sizeof *(status));          \
  (status)->st_mode = S_IFCHR | 0660;           \
  (status)->st_nlink = 1;                       \
  (status)->st_ino = token_status.st_ino;       \
  (status)->st_rdev = makedev(SPIDEV_MAJOR, 0); \
  (status)->st_uid = getuid();                  \
  (status)->st_gid = getgid();                  \
  (status)->st_blksize = token_status.st_blksize

#define DEFINE_STAT(name, type)                                 \
  EXPORT int name(const char *path, struct type *status) {      \
    if (!is_device_path(path)) return NEXT(name)(path, status); \
    DEVICE_STATUS(status);                                      \
    return 0;                                                   \
  }
DEFINE_STAT(stat, stat)
DEFINE_STAT(lstat, stat)
DEFINE_STAT(stat64, stat64)
DEFINE_STAT(lstat64, stat64)

EXPORT int statx(int folder, const char *path, int flags, unsigned mask, struct statx *status) {
  if (!is_device_path(path)) return NEXT(statx)(folder, path, flags, mask, status);
  memset(status, 0, sizeof *status);
  status->stx_mask = STATX_TYPE | STATX_MODE | STATX_NLINK;
  status->stx_mode = S_IFCHR | 0660;
  status->stx_nlink = 1;
  status->stx_rdev_major = SPIDEV_MAJOR;
  return 0;
}
EXPORT int access(const char *path, int mode) {
  if (!is_device_path(path)) return NEXT(access)(path, mode);
  return NEXT(access)(token, mode);
}
EXPORT int faccessat(int folder, const char *path, int mode, int flags) {
  if (!is_device_path(path)) return NEXT(faccessat)(folder, path, mode, flags);
  return NEXT(faccessat)(AT_FDCWD, token, mode, flags);
}
