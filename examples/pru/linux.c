/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* port.h on a Linux board whose processor reaches the master over AXI4-Lite: a Zynq, or an SoC with a bridge to its FPGA.
 *
 *   /dev/uio0     driver uio_pdrv_genirq: the device tree has `reg` (4 KiB), `interrupts` and compatible = "generic-uio".
 *                 board_sleep_us() waits for the interrupt. Any user with rights to the file may run the program.
 *   0x43C00000    the physical address, by /dev/mem: root, and a kernel that allows it. No interrupt. */

#define _DEFAULT_SOURCE /* usleep(), mmap() */
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include "port.h"

enum { kBytes = 0x1000 };

static volatile uint32_t *registers;
static int uio = -1;

/* The file is opened with O_SYNC, so that the pages are not cached and the accesses stay in order. */
static uint32_t port_read(void *context, uint32_t offset) {
  (void)context;
  return registers[offset / 4];
}

static void port_write(void *context, uint32_t offset, uint32_t value) {
  (void)context;
  registers[offset / 4] = value;
}

static uint32_t port_now_us(void *context) {
  struct timespec now;
  (void)context;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (uint32_t)((uint64_t)now.tv_sec * 1000000U + (uint64_t)now.tv_nsec / 1000U);
}

bool board_open(const char *place, biss_pru_port *port) {
  const bool by_uio = place[0] == '/';
  const off_t address = by_uio ? 0 : (off_t)strtoul(place, NULL, 0);
  const int file = open(by_uio ? place : "/dev/mem", O_RDWR | O_SYNC);
  void *pages = MAP_FAILED;
  if (file >= 0) pages = mmap(NULL, kBytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, address);
  if (pages == MAP_FAILED) {
    perror(place);
    if (file >= 0) close(file);
    return false;
  }
  registers = pages;
  if (by_uio) {
    uio = file;
  } else {
    close(file); /* the pages stay */
  }
  port->context = NULL;
  port->read = port_read;
  port->write = port_write;
  port->now_us = port_now_us;
  return true;
}

void board_close(void) {
  munmap((void *)(uintptr_t)registers, kBytes);
  if (uio >= 0) close(uio);
}

void board_sleep_us(uint32_t us) {
  struct pollfd wait = {uio, POLLIN, 0};
  const uint32_t on = 1;
  uint32_t count = 0;
  if (uio < 0) {
    usleep(us);
    return;
  }
  /* The kernel turns the interrupt off when it comes. irq_o is a level, so none is lost here. */
  if (write(uio, &on, sizeof on) != (ssize_t)sizeof on) perror("uio");
  if (poll(&wait, 1, (int)(us / 1000U) + 1) == 1 && read(uio, &count, sizeof count) < 0) perror("uio");
}
