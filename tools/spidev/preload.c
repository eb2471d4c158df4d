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
#include <limits.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/uio.h>
#include <unistd.h>

#include "bridge_client.h"
#include "caller_memory.h"
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
  const size_t size = strlen(device) + 1;
  for (size_t at = 0; size > 1; at += 64) { /* every open of the program comes here: little stack */
    char part[64];
    const size_t wanted = size - at < sizeof part ? size - at : sizeof part;
    if (read_caller(part, path + at, wanted) != wanted) return 0;
    if (memcmp(part, device + at, wanted) != 0) return 0;
    if (at + wanted == size) return 1;
  }
  return 0;
}

static int is_device(int fd) {
  struct stat status;
  const int error = errno;
  const int yes = device[0] != '\0' && NEXT(fstat)(fd, &status) == 0 &&
                  status.st_dev == token_status.st_dev && status.st_ino == token_status.st_ino;
  errno = error;
  return yes;
}

static int fail(int error) {
  errno = error;
  return -1;
}

/* Checks the access mode of the descriptor, as the kernel does before it calls the driver. */
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

/* The names that _FORTIFY_SOURCE gives to the same calls. */
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
typedef ssize_t transfer_part(int fd, const struct iovec *part);

static ssize_t read_part(int fd, const struct iovec *part) {
  return read(fd, part->iov_base, part->iov_len);
}
static ssize_t write_part(int fd, const struct iovec *part) {
  return write(fd, part->iov_base, part->iov_len);
}
static ssize_t every_part(int fd, const struct iovec *parts, int count, transfer_part *one) {
  if (count < 0 || count > IOV_MAX) return fail(EINVAL);
  struct iovec *const part = calloc((size_t)count + 1, sizeof *part);
  if (part == NULL) return -1;
  ssize_t total = get_from_caller(part, parts, (size_t)count * sizeof *part);
  for (int i = 0; total >= 0 && i < count; ++i) {
    const ssize_t done = one(fd, &part[i]);
    if (done >= 0) total += done;
    if (done < 0 && total == 0) total = -1;
    if (done < 0 || (size_t)done < part[i].iov_len) break;
  }
  const int error = errno;
  free(part);
  errno = error;
  return total;
}
EXPORT ssize_t readv(int fd, const struct iovec *parts, int count) {
  if (!is_device(fd)) return NEXT(readv)(fd, parts, count);
  return every_part(fd, parts, count, read_part);
}
EXPORT ssize_t writev(int fd, const struct iovec *parts, int count) {
  if (!is_device(fd)) return NEXT(writev)(fd, parts, count);
  return every_part(fd, parts, count, write_part);
}

/* The device has no positions. */
#define DEFINE_SEEK(name, type)                                      \
  EXPORT type name(int fd, type offset, int whence) {                \
    if (!is_device(fd)) return NEXT(name)(fd, offset, whence);       \
    return fail(whence < 0 || whence > SEEK_HOLE ? EINVAL : ESPIPE); \
  }
DEFINE_SEEK(lseek, off_t)
DEFINE_SEEK(lseek64, off64_t)

#define DEFINE_AT(name, pointer, number, type)                           \
  EXPORT ssize_t name(int fd, pointer data, number count, type offset) { \
    if (!is_device(fd)) return NEXT(name)(fd, data, count, offset);      \
    return fail(offset < 0 ? EINVAL : ESPIPE);                           \
  }
DEFINE_AT(pread, void *, size_t, off_t)
DEFINE_AT(pread64, void *, size_t, off64_t)
DEFINE_AT(pwrite, const void *, size_t, off_t)
DEFINE_AT(pwrite64, const void *, size_t, off64_t)
DEFINE_AT(preadv, const struct iovec *, int, off_t)
DEFINE_AT(preadv64, const struct iovec *, int, off64_t)
DEFINE_AT(pwritev, const struct iovec *, int, off_t)
DEFINE_AT(pwritev64, const struct iovec *, int, off64_t)

extern ssize_t __pread_chk(int fd, void *buffer, size_t size, off_t offset, size_t room);
extern ssize_t __pread64_chk(int fd, void *buffer, size_t size, off64_t offset, size_t room);

EXPORT ssize_t __pread_chk(int fd, void *buffer, size_t size, off_t offset, size_t room) {
  if (!is_device(fd)) return NEXT(__pread_chk)(fd, buffer, size, offset, room);
  return pread(fd, buffer, size, offset);
}
EXPORT ssize_t __pread64_chk(int fd, void *buffer, size_t size, off64_t offset, size_t room) {
  if (!is_device(fd)) return NEXT(__pread64_chk)(fd, buffer, size, offset, room);
  return pread64(fd, buffer, size, offset);
}

/* The device has no memory either. The kernel finds other mistakes first, so this maps the empty
 * file, at a place that the kernel chooses. */
static void *refuse_map(size_t size, int protection, int flags, int fd, off64_t offset) {
  const int elsewhere = flags & ~(MAP_FIXED | MAP_FIXED_NOREPLACE);
  void *const map = NEXT(mmap64)(NULL, size, protection, elsewhere, fd, offset);
  if (map != MAP_FAILED) {
    munmap(map, size);
    errno = ENODEV;
  }
  return MAP_FAILED;
}
#define DEFINE_MMAP(name, type)                                                              \
  EXPORT void *name(void *at, size_t size, int protection, int flags, int fd, type offset) { \
    if ((flags & MAP_ANONYMOUS) == 0 && is_device(fd)) {                                     \
      return refuse_map(size, protection, flags, fd, offset);                                \
    }                                                                                        \
    return NEXT(name)(at, size, protection, flags, fd, offset);                              \
  }
DEFINE_MMAP(mmap, off_t)
DEFINE_MMAP(mmap64, off64_t)

EXPORT int fsync(int fd) { return is_device(fd) ? fail(EINVAL) : NEXT(fsync)(fd); }
EXPORT int fdatasync(int fd) { return is_device(fd) ? fail(EINVAL) : NEXT(fdatasync)(fd); }
EXPORT int ftruncate(int fd, off_t size) {
  return is_device(fd) ? fail(EINVAL) : NEXT(ftruncate)(fd, size);
}
EXPORT int ftruncate64(int fd, off64_t size) {
  return is_device(fd) ? fail(EINVAL) : NEXT(ftruncate64)(fd, size);
}

EXPORT int ioctl(int fd, unsigned long request, ...) {
  va_list arguments;
  va_start(arguments, request);
  void *const argument = va_arg(arguments, void *);
  va_end(arguments);
  /* Requests that concern the descriptor and not the device. */
  const int of_any = request == FIOCLEX || request == FIONCLEX || request == FIONBIO;
  if (of_any || !is_device(fd)) return NEXT(ioctl)(fd, request, argument);
  return spidev_ioctl(request, argument);
}

/* --- programs that look before they open ------------------------------------------------- */

#define DEFINE_GIVE_STATUS(type)                       \
  static int give_##type(struct type *to) {            \
    struct type status;                                \
    memset(&status, 0, sizeof status);                 \
    status.st_mode = S_IFCHR | 0660;                   \
    status.st_nlink = 1;                               \
    status.st_dev = token_status.st_dev;               \
    status.st_ino = token_status.st_ino;               \
    status.st_rdev = makedev(SPIDEV_MAJOR, 0);         \
    status.st_uid = getuid();                          \
    status.st_gid = getgid();                          \
    status.st_blksize = token_status.st_blksize;       \
    return give_to_caller(to, &status, sizeof status); \
  }
DEFINE_GIVE_STATUS(stat)
DEFINE_GIVE_STATUS(stat64)

#define DEFINE_STAT(name, type)                                 \
  EXPORT int name(const char *path, struct type *status) {      \
    if (!is_device_path(path)) return NEXT(name)(path, status); \
    return give_##type(status);                                 \
  }
DEFINE_STAT(stat, stat)
DEFINE_STAT(lstat, stat)
DEFINE_STAT(stat64, stat64)
DEFINE_STAT(lstat64, stat64)

#define DEFINE_FSTAT(name, type)                       \
  EXPORT int name(int fd, struct type *status) {       \
    if (!is_device(fd)) return NEXT(name)(fd, status); \
    return give_##type(status);                        \
  }
DEFINE_FSTAT(fstat, stat)
DEFINE_FSTAT(fstat64, stat64)

/* A path, or the descriptor itself. */
static int is_device_at(int folder, const char *path, int flags) {
  char first;
  if (is_device_path(path)) return 1;
  if ((flags & AT_EMPTY_PATH) == 0 || !is_device(folder)) return 0;
  return read_caller(&first, path, 1) == 1 && first == '\0';
}
#define DEFINE_FSTATAT(name, type)                                                \
  EXPORT int name(int folder, const char *path, struct type *status, int flags) { \
    if (is_device_at(folder, path, flags)) return give_##type(status);            \
    return NEXT(name)(folder, path, status, flags);                               \
  }
DEFINE_FSTATAT(fstatat, stat)
DEFINE_FSTATAT(fstatat64, stat64)

EXPORT int statx(int folder, const char *path, int flags, unsigned mask, struct statx *to) {
  if (!is_device_at(folder, path, flags)) return NEXT(statx)(folder, path, flags, mask, to);
  struct statx status;
  memset(&status, 0, sizeof status);
  status.stx_mask = STATX_TYPE | STATX_MODE | STATX_NLINK;
  status.stx_mode = S_IFCHR | 0660;
  status.stx_nlink = 1;
  status.stx_rdev_major = SPIDEV_MAJOR;
  return give_to_caller(to, &status, sizeof status);
}
EXPORT int access(const char *path, int mode) {
  if (!is_device_path(path)) return NEXT(access)(path, mode);
  return NEXT(access)(token, mode);
}
EXPORT int faccessat(int folder, const char *path, int mode, int flags) {
  if (!is_device_path(path)) return NEXT(faccessat)(folder, path, mode, flags);
  return NEXT(faccessat)(AT_FDCWD, token, mode, flags);
}
