/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A program for spidev as anybody writes it: it knows nothing of a simulator. It brings an encoder
 * of 26 bits into operation and tries what the interface offers; sizes and errors are those of
 * Linux (Documentation/spi/spidev.rst), register values those of the datasheet (Rev D2) and the
 * word of golden.toml.
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
#include <sys/uio.h>
#include <sys/wait.h>
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
  CHECK_ERROR(lseek(fd, 0, SEEK_SET), ESPIPE);
  const int read_only = open(device, O_RDONLY);
  CHECK(read_only >= 0);
  CHECK_ERROR(write(read_only, big, 1), EBADF);
  close(read_only);
  identify(fd);
}

/* Descriptors go the ways that all descriptors go; a closed one is nobody's. */
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
  copies(fd);
  everybody_at_once();
  close(fd);
  if (failures == 0) puts("all good");
  return failures == 0 ? 0 : 1;
}
