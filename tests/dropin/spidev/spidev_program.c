/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * An ordinary program for spidev: it knows nothing of a simulator. It brings an encoder
 * of 26 bits into operation and tries what the interface offers; sizes and errors are those of
 * Linux (Documentation/spi/spidev.rst), register values those of the datasheet (Rev D2) and the
 * word of golden.toml. It uses no header of this project, so registers and opcodes are numbers.
 *
 *   spidev_program [DEVICE]
 */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <linux/spi/spi.h>
#include <linux/spi/spidev.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static const char *device = "/dev/spidev0.0";
static int failures;

#define CHECK(condition)                                              \
  do {                                                                \
    if (!(condition)) {                                               \
      fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition); \
      ++failures;                                                     \
    }                                                                 \
  } while (0)
#define CHECK_ERROR(call, error) \
  errno = 0;                     \
  CHECK((call) == -1 && errno == (error))

static struct spi_ioc_transfer transfer(const void *tx, void *rx, unsigned length) {
  const struct spi_ioc_transfer result = {
      .tx_buf = (uintptr_t)tx, .rx_buf = (uintptr_t)rx, .len = length};
  return result;
}

static int send_all(int fd, const void *tx, unsigned length) {
  const struct spi_ioc_transfer one = transfer(tx, NULL, length);
  return ioctl(fd, SPI_IOC_MESSAGE(1), &one);
}

/* Opcode 0x03 and its answer as two transfers of one frame. */
static int read_registers(int fd, uint8_t address, void *values, unsigned count) {
  const uint8_t command[] = {0x03, address};
  const struct spi_ioc_transfer both[] = {transfer(command, NULL, 2),
                                          transfer(NULL, values, count)};
  return ioctl(fd, SPI_IOC_MESSAGE(2), both);
}

static void identify(int fd) {
  uint8_t id[3] = {0};
  CHECK(read_registers(fd, 0xEA, id, 3) == 5);
  CHECK(id[0] == 0x20 && id[1] == 0x84 && id[2] == 0x01); /* revision, version, fixed bits */
}

/* Full duplex: the answer follows opcode and address in the same transfer. */
static void read_full_duplex(int fd) {
  const uint8_t tx[5] = {0x03, 0xEA};
  uint8_t rx[5] = {0xFF, 0xFF};
  const struct spi_ioc_transfer one = transfer(tx, rx, 5);
  CHECK(ioctl(fd, SPI_IOC_MESSAGE(1), &one) == 5);
  CHECK(memcmp(rx, "\0\0\x20\x84\x01", 5) == 0);
}

static void read_position(int fd) {
  const uint8_t channel[] = {0x02, 0xC0, 0x5B, 0x06, 0, 0}; /* 28 bits, CRC6 */
  const uint8_t protocol[] = {0x02, 0xED, 0x01};            /* BiSS C */
  const uint8_t control[] = {0x02, 0xE5, 0x40, 0xA0};       /* REGVERS; 10 MHz */
  const uint8_t request[] = {0x07, 0x04};                   /* a frame with CDM = 0 */
  CHECK(write(fd, channel, sizeof channel) == sizeof channel);
  CHECK(write(fd, protocol, sizeof protocol) == sizeof protocol);
  CHECK(send_all(fd, control, sizeof control) == sizeof control);
  CHECK(send_all(fd, request, sizeof request) == sizeof request);
  uint8_t status[3] = {0};
  const uint8_t command[3] = {0x05};
  const struct spi_ioc_transfer poll = transfer(command, status, 3);
  int polls = 0;
  do {
    CHECK(ioctl(fd, SPI_IOC_MESSAGE(1), &poll) == 3);
  } while ((status[1] & 1) == 0 && ++polls < 1000);
  CHECK((status[1] & 0x11) == 0x11); /* EOT, nSCDERR */
  CHECK((status[2] & 0x02) == 0x02); /* SVALID1 */
  uint8_t word[8];
  CHECK(read_registers(fd, 0x00, word, 8) == 10);
  CHECK(memcmp(word, "\xBF\x37\xAF\x0A\0\0\0\x18", 8) == 0);
}

static void frames_of_a_message(int fd) {
  const uint8_t command[] = {0x03, 0xEA};
  uint8_t id[2] = {0xFF, 0xFF};
  struct spi_ioc_transfer both[] = {transfer(command, NULL, 2), transfer(NULL, id, 2)};
  /* NCS high between the transfers: the second frame begins with opcode 0x00, which is none. */
  both[0].cs_change = 1;
  CHECK(ioctl(fd, SPI_IOC_MESSAGE(2), both) == 4);
  CHECK(id[0] == 0 && id[1] == 0);
  /* NCS low behind the last one: read() goes on in the same frame. */
  both[0].cs_change = 1;
  CHECK(ioctl(fd, SPI_IOC_MESSAGE(1), both) == 2);
  CHECK(read(fd, id, 2) == 2);
  CHECK(id[0] == 0x20 && id[1] == 0x84);
  /* And ends it: a frame of its own begins with an opcode. */
  CHECK(read(fd, id, 2) == 2);
  CHECK(id[0] == 0 && id[1] == 0);
}

static void settings(int fd) {
  uint32_t mode32 = 99, speed = 0;
  uint8_t mode = 99, bits = 0, lsb = 99;
  CHECK(ioctl(fd, SPI_IOC_RD_MODE, &mode) == 0 && mode == 0);
  CHECK(ioctl(fd, SPI_IOC_RD_MODE32, &mode32) == 0 && mode32 == 0);
  /* Some callers keep the request in an int, which extends its sign. */
  CHECK(ioctl(fd, (unsigned long)(long)(int)SPI_IOC_RD_MODE, &mode) == 0);
  CHECK(ioctl(fd, SPI_IOC_RD_BITS_PER_WORD, &bits) == 0 && bits == 8);
  CHECK(ioctl(fd, SPI_IOC_RD_LSB_FIRST, &lsb) == 0 && lsb == 0);
  speed = 1234567;
  CHECK(ioctl(fd, SPI_IOC_WR_MAX_SPEED_HZ, &speed) == 0);
  speed = 0;
  CHECK(ioctl(fd, SPI_IOC_RD_MAX_SPEED_HZ, &speed) == 0 && speed == 1234567);
  identify(fd);
  speed = 0;
  CHECK_ERROR(ioctl(fd, SPI_IOC_WR_MAX_SPEED_HZ, &speed), EINVAL);

  mode = SPI_CS_HIGH;
  CHECK_ERROR(ioctl(fd, SPI_IOC_WR_MODE, &mode), EINVAL);
  bits = 33;
  CHECK_ERROR(ioctl(fd, SPI_IOC_WR_BITS_PER_WORD, &bits), EINVAL);
  CHECK(ioctl(fd, SPI_IOC_RD_BITS_PER_WORD, &bits) == 0 && bits == 8);
}

/* The chip wants mode 0: with CPHA = 1 it takes each bit a clock late. */
static void wrong_mode(int fd) {
  uint8_t mode = SPI_MODE_1;
  uint8_t id[2] = {0};
  CHECK(ioctl(fd, SPI_IOC_WR_MODE, &mode) == 0);
  CHECK(ioctl(fd, SPI_IOC_RD_MODE, &mode) == 0 && mode == SPI_MODE_1);
  CHECK(read_registers(fd, 0xEA, id, 2) == 4);
  CHECK(!(id[0] == 0x20 && id[1] == 0x84));
  mode = SPI_MODE_0;
  CHECK(ioctl(fd, SPI_IOC_WR_MODE, &mode) == 0);
  identify(fd);
}

static void words_and_bit_order(int fd) {
  /* 16 bits: words in the machine's byte order, MSB first on the wire. */
  const uint16_t tx[] = {0x03EA, 0};
  uint16_t rx[2] = {0xFFFF, 0};
  struct spi_ioc_transfer one = transfer(tx, rx, 4);
  one.bits_per_word = 16;
  CHECK(ioctl(fd, SPI_IOC_MESSAGE(1), &one) == 4);
  CHECK(rx[0] == 0 && rx[1] == 0x2084);
  one.len = 3;
  CHECK_ERROR(ioctl(fd, SPI_IOC_MESSAGE(1), &one), EINVAL);
  /* LSB first: the mirrored opcode and address, mirrored answers. */
  uint8_t lsb = 1;
  const uint8_t mirrored[] = {0xC0, 0x57, 0};
  uint8_t answer[3] = {0};
  CHECK(ioctl(fd, SPI_IOC_WR_LSB_FIRST, &lsb) == 0);
  const struct spi_ioc_transfer swapped = transfer(mirrored, answer, 3);
  CHECK(ioctl(fd, SPI_IOC_MESSAGE(1), &swapped) == 3);
  CHECK(answer[2] == 0x04); /* 0x20 */
  lsb = 0;
  CHECK(ioctl(fd, SPI_IOC_WR_LSB_FIRST, &lsb) == 0);
  identify(fd);
}

static void errors(int fd) {
  static uint8_t big[4097];
  CHECK_ERROR(read(fd, big, sizeof big), EMSGSIZE);
  CHECK_ERROR(write(fd, big, sizeof big), EMSGSIZE);
  CHECK(read(fd, big, sizeof big - 1) == sizeof big - 1);
  const struct spi_ioc_transfer two[] = {transfer(big, NULL, 4096), transfer(big, NULL, 1)};
  CHECK_ERROR(ioctl(fd, SPI_IOC_MESSAGE(2), two), EMSGSIZE);
  CHECK(ioctl(fd, SPI_IOC_MESSAGE(0), two) == 0);
  CHECK_ERROR(ioctl(fd, _IOC(_IOC_WRITE, SPI_IOC_MAGIC, 0, 31), two), EINVAL);
  CHECK_ERROR(ioctl(fd, _IOR(SPI_IOC_MAGIC, 77, uint8_t), big), ENOTTY);
  CHECK_ERROR(ioctl(fd, FIONREAD, big), ENOTTY);
  struct spi_ioc_transfer wide = transfer(big, NULL, 2);
  wide.tx_nbits = 4;
  CHECK_ERROR(ioctl(fd, SPI_IOC_MESSAGE(1), &wide), EINVAL);
  CHECK(ioctl(fd, FIOCLEX) == 0 && (fcntl(fd, F_GETFD) & FD_CLOEXEC) != 0);
  const int read_only = open(device, O_RDONLY);
  CHECK(read_only >= 0);
  CHECK_ERROR(write(read_only, big, 1), EBADF);
  close(read_only);
  identify(fd);
}

/* A page that can be used and one behind it that cannot; `edge` points to `room` bytes before it.
 */
static long page;
static uint8_t *edge(unsigned room) {
  static uint8_t *base;
  if (base == NULL) {
    page = sysconf(_SC_PAGESIZE);
    base = mmap(NULL, 2 * (size_t)page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mprotect(base, (size_t)page, PROT_READ | PROT_WRITE) != 0) exit(2);
  }
  return base + page - room;
}

/* The register RDATA1 holds what was written to it. */
static void set_rdata(int fd, uint8_t value) {
  const uint8_t frame[] = {0x02, 0x80, value};
  CHECK(write(fd, frame, sizeof frame) == sizeof frame);
}
static int rdata(int fd) {
  uint8_t value = 0;
  CHECK(read_registers(fd, 0x80, &value, 1) == 3);
  return value;
}

/* Memory that is not the program's. */
static void bad_pointers(int fd) {
  void *const nowhere = edge(0);
  void *volatile null = NULL; /* unknown to the compiler */
  volatile int count = -1;
  struct spi_ioc_transfer two[2];
  uint8_t frame[3] = {0x02, 0x80, 0x22}, answer[3] = {0xFF, 0xFF, 0xFF};
  set_rdata(fd, 0x11);
  /* What was received for as much as fits; nothing is sent of what cannot be read in full. */
  CHECK_ERROR(read(fd, null, 4), EFAULT);
  CHECK_ERROR(read(fd, nowhere, 4), EFAULT);
  CHECK(read(fd, edge(2), 4) == 2);
  CHECK(read(fd, null, 0) == 0);
  CHECK_ERROR(read(fd, nowhere, 4097), EMSGSIZE);
  CHECK_ERROR(write(fd, null, 4), EFAULT);
  memcpy(edge(3), frame, 3);
  CHECK_ERROR(write(fd, edge(3), 4), EFAULT);
  CHECK(rdata(fd) == 0x11);

  CHECK_ERROR(ioctl(fd, SPI_IOC_MESSAGE(1), NULL), EFAULT);
  CHECK_ERROR(ioctl(fd, SPI_IOC_MESSAGE(2), edge(sizeof two[0])), EFAULT);
  CHECK_ERROR(ioctl(fd, _IOW(SPI_IOC_MAGIC, 77, uint8_t), nowhere), ENOTTY);
  two[0] = transfer(edge(3), NULL, 4);
  two[1] = transfer(frame, NULL, 5000);
  CHECK_ERROR(ioctl(fd, SPI_IOC_MESSAGE(2), two), EFAULT); /* in the order of the transfers */
  two[0] = transfer(frame, NULL, 3);
  CHECK_ERROR(ioctl(fd, SPI_IOC_MESSAGE(2), two), EMSGSIZE);
  two[1] = transfer(edge(3), NULL, 4);
  CHECK_ERROR(ioctl(fd, SPI_IOC_MESSAGE(2), two), EFAULT);
  two[1].rx_nbits = 4; /* the controller is asked last */
  CHECK_ERROR(ioctl(fd, SPI_IOC_MESSAGE(2), two), EFAULT);
  CHECK(rdata(fd) == 0x11);
  /* An answer that cannot be stored: the message has been sent, and what came before is there. */
  two[0] = transfer(frame, answer, 3);
  two[1] = transfer(NULL, nowhere, 1);
  CHECK_ERROR(ioctl(fd, SPI_IOC_MESSAGE(2), two), EFAULT);
  CHECK(memcmp(answer, "\0\0\0", 3) == 0 && rdata(fd) == 0x22);
  /* Memory that can be read only. */
  CHECK_ERROR(read(fd, (void *)(uintptr_t) "constant", 4), EFAULT);
  CHECK(write(fd, "\2\200\63", 3) == 3 && rdata(fd) == 0x33);

  static const unsigned long kSettings[] = {SPI_IOC_RD_MODE,          SPI_IOC_RD_MODE32,
                                            SPI_IOC_RD_LSB_FIRST,     SPI_IOC_RD_BITS_PER_WORD,
                                            SPI_IOC_RD_MAX_SPEED_HZ,  SPI_IOC_WR_MODE,
                                            SPI_IOC_WR_MODE32,        SPI_IOC_WR_LSB_FIRST,
                                            SPI_IOC_WR_BITS_PER_WORD, SPI_IOC_WR_MAX_SPEED_HZ};
  for (size_t i = 0; i < sizeof kSettings / sizeof *kSettings; ++i) {
    CHECK_ERROR(ioctl(fd, kSettings[i], NULL), EFAULT);
    CHECK_ERROR(ioctl(fd, kSettings[i], nowhere), EFAULT);
  }
  CHECK_ERROR(ioctl(fd, SPI_IOC_WR_MAX_SPEED_HZ, edge(3)), EFAULT);

  const struct iovec parts[] = {{answer, 2}, {edge(1), 2}, {answer, 3}};
  CHECK_ERROR(readv(fd, nowhere, 1), EFAULT);
  CHECK_ERROR(readv(fd, parts, count), EINVAL);
  count = 1025;
  CHECK_ERROR(writev(fd, parts, count), EINVAL);
  CHECK(readv(fd, parts, 3) == 3);  /* up to the part that does not fit */
  CHECK(writev(fd, parts, 3) == 2); /* up to the part that cannot be read */
  CHECK(readv(fd, parts, 0) == 0);

  /* Bad pointers also in calls of other functions, whose arguments the library looks at. */
  char *const path = (char *)edge(8);
  struct stat status;
  struct timespec time;
  memcpy(path, device, 8);
  CHECK_ERROR(open(nowhere, O_RDWR), EFAULT);
  CHECK_ERROR(open(path, O_RDWR), EFAULT);
  CHECK_ERROR(stat(path, &status), EFAULT);
  CHECK_ERROR(access(path, R_OK), EFAULT);
  CHECK_ERROR(stat(device, nowhere), EFAULT);
  CHECK_ERROR(fstat(fd, nowhere), EFAULT);
  CHECK_ERROR(statx(fd, "", AT_EMPTY_PATH, STATX_TYPE, nowhere), EFAULT);
  CHECK_ERROR(nanosleep(nowhere, &time), EFAULT);
  CHECK(clock_nanosleep(CLOCK_MONOTONIC, 0, nowhere, &time) == EFAULT);
}

/* A character device, by its name and by its descriptor. */
static void looks(int fd) {
  struct stat by_name, status;
  struct stat64 status64;
  struct statx extended;
  CHECK(stat(device, &by_name) == 0 && S_ISCHR(by_name.st_mode));
  CHECK(fstat(fd, &status) == 0 && S_ISCHR(status.st_mode));
  CHECK(status.st_rdev == by_name.st_rdev && status.st_ino == by_name.st_ino &&
        status.st_dev == by_name.st_dev && status.st_size == 0);
  CHECK(fstat64(fd, &status64) == 0 && S_ISCHR(status64.st_mode));
  CHECK(fstatat(AT_FDCWD, device, &status, 0) == 0 && S_ISCHR(status.st_mode));
  CHECK(fstatat(fd, "", &status, AT_EMPTY_PATH) == 0 && S_ISCHR(status.st_mode));
  CHECK(statx(fd, "", AT_EMPTY_PATH, STATX_TYPE, &extended) == 0 && S_ISCHR(extended.stx_mode));
  CHECK(statx(AT_FDCWD, device, 0, STATX_TYPE, &extended) == 0 && S_ISCHR(extended.stx_mode));
  /* Other files are not changed. */
  CHECK(fstat(STDERR_FILENO, &status) == 0 && status.st_rdev != by_name.st_rdev);
  CHECK(fstatat(AT_FDCWD, "/", &status, 0) == 0 && S_ISDIR(status.st_mode));
}

/* The device has no positions and no memory, and nothing to be cut or stored. */
static void is_no_file(int fd) {
  uint8_t byte = 0;
  const struct iovec part = {&byte, 1};
  const int whence[] = {SEEK_SET, SEEK_CUR, SEEK_END};
  for (int i = 0; i < 3; ++i) {
    CHECK_ERROR(lseek(fd, 0, whence[i]), ESPIPE);
    CHECK_ERROR(lseek64(fd, 0, whence[i]), ESPIPE);
  }
  CHECK_ERROR(lseek(fd, 0, 99), EINVAL);
  CHECK_ERROR(pread(fd, &byte, 1, 0), ESPIPE);
  CHECK_ERROR(pwrite(fd, &byte, 1, 0), ESPIPE);
  CHECK_ERROR(pread64(fd, &byte, 1, 0), ESPIPE);
  CHECK_ERROR(pwrite64(fd, &byte, 1, 0), ESPIPE);
  CHECK_ERROR(preadv(fd, &part, 1, 0), ESPIPE);
  CHECK_ERROR(pwritev(fd, &part, 1, 0), ESPIPE);
  CHECK_ERROR(pread(fd, &byte, 1, -1), EINVAL);
  CHECK_ERROR(fsync(fd), EINVAL);
  CHECK_ERROR(fdatasync(fd), EINVAL);
  CHECK_ERROR(ftruncate(fd, 0), EINVAL);

#define CHECK_NO_MAP(map, error) \
  errno = 0;                     \
  CHECK((map) == MAP_FAILED && errno == (error))
  const size_t size = (size_t)page;
  CHECK_NO_MAP(mmap(NULL, size, PROT_READ, MAP_SHARED, fd, 0), ENODEV);
  CHECK_NO_MAP(mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE, fd, 0), ENODEV);
  CHECK_NO_MAP(mmap64(NULL, size, PROT_READ, MAP_SHARED, fd, 0), ENODEV);
  CHECK_NO_MAP(mmap(NULL, 0, PROT_READ, MAP_SHARED, fd, 0), EINVAL);
  CHECK_NO_MAP(mmap(NULL, size, PROT_READ, MAP_SHARED, fd, 1), EINVAL);
  CHECK_NO_MAP(mmap(NULL, size, PROT_READ, 0, fd, 0), EINVAL);
  const int read_only = open(device, O_RDONLY);
  CHECK_NO_MAP(mmap(NULL, size, PROT_WRITE, MAP_SHARED, read_only, 0), EACCES);
  close(read_only);
  /* What was in the place stays. */
  *edge(1) = 0x5A;
  CHECK_NO_MAP(mmap(edge((unsigned)page), size, PROT_READ, MAP_SHARED | MAP_FIXED, fd, 0), ENODEV);
  CHECK(*edge(1) == 0x5A);
  void *const own = mmap(NULL, size, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, fd, 0);
  CHECK(own != MAP_FAILED && munmap(own, size) == 0);
}

/* Descriptors of the device are copied like any others; a closed one is no longer the device's. */
static void copies(int fd) {
  const int copy = dup(fd);
  identify(copy);
  const int high = fcntl(fd, F_DUPFD_CLOEXEC, 200);
  identify(high);
  close(high);
  uint8_t byte = 0;
  CHECK_ERROR(ioctl(high, SPI_IOC_RD_MODE, &byte), EBADF);
  close(copy);
  FILE *const file = tmpfile(); /* takes the number of the copy */
  if (file != NULL) {
    const int other = fileno(file);
    CHECK(read(other, &byte, 1) == 0);
    CHECK_ERROR(ioctl(other, SPI_IOC_RD_MODE, &byte), ENOTTY);
    fclose(file);
  }
  uint8_t command[] = {0x03, 0xEA}, zeros[2] = {0};
  const struct iovec parts[] = {{command, 2}, {zeros, 2}};
  CHECK(writev(fd, parts, 2) == 4);
  identify(fd);
}

/* Each reads a register of its own, so that a mixed up answer shows. */
static void *read_often(void *argument) {
  static const struct {
    uint8_t address, value;
  } kRegister[] = {{0xEA, 0x20}, {0xEB, 0x84}, {0xEC, 0x01}, {0xF9, 0x55}};
  const int which = *(const int *)argument;
  const int fd = open(device, O_RDWR);
  for (int i = 0; i < 1000; ++i) {
    uint8_t value = 0;
    CHECK(read_registers(fd, kRegister[which].address, &value, 1) == 3);
    CHECK(value == kRegister[which].value);
    if (failures > 20) break;
  }
  close(fd);
  return NULL;
}

/* Parent, child and two threads at once: messages are never mixed. */
static void everybody_at_once(void) {
  static const int kWhich[] = {0, 1, 2, 3};
  int go[2];
  if (pipe(go) != 0) return;
  const pid_t child = fork();
  if (child == 0) {
    char byte;
    failures = read(go[0], &byte, 1) == 1 ? 0 : 1;
    read_often((void *)&kWhich[3]);
    _exit(failures == 0 ? 0 : 1);
  }
  pthread_t threads[2];
  CHECK(write(go[1], "", 1) == 1);
  for (int i = 0; i < 2; ++i) {
    pthread_create(&threads[i], NULL, read_often, (void *)&kWhich[i + 1]);
  }
  read_often((void *)&kWhich[0]);
  for (int i = 0; i < 2; ++i) pthread_join(threads[i], NULL);
  int status = 1;
  CHECK(waitpid(child, &status, 0) == child && status == 0);
}

int main(int argc, char **argv) {
  if (argc > 1) device = argv[1];
  const int fd = open(device, O_RDWR);
  if (fd < 0) {
    perror(device);
    return 2;
  }
  identify(fd);
  read_full_duplex(fd);
  read_position(fd);
  frames_of_a_message(fd);
  settings(fd);
  wrong_mode(fd);
  words_and_bit_order(fd);
  errors(fd);
  bad_pointers(fd);
  looks(fd);
  is_no_file(fd);
  copies(fd);
  everybody_at_once();
  close(fd);
  if (failures == 0) puts("all good");
  return failures == 0 ? 0 : 1;
}
