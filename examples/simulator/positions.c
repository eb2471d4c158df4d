/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The driver on the simulator, from C99: what runs here runs on a board, but for transfer() and
 * now_us(). An SSI encoder on channel 1, a BiSS C encoder and an actuator on channel 2.
 *
 *   cc positions.c $(pkg-config --cflags --libs mb4_c mb4sim) && ./a.out
 */
#include <inttypes.h>
#include <stdio.h>

#include "mb4.h"
#include "mb4sim.h"

static const char kScenario[] =
    "[[channel]]\nnumber = 1\n"
    "[[channel.slave]]\nprotocol = \"ssi\"\ndata_bits = 25\ngray = true\n"
    "source = \"ramp\"\nstart = 1000\nstep = 3\n"
    "[[channel]]\nnumber = 2\nmo = true\n"
    "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\nsource = \"ramp\"\nstart = 500\n"
    "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 16\nactuator = true\n";

/* One SPI frame; on a board: NCS low, exchange, NCS high. */
static bool transfer(void *context, const uint8_t *tx, uint8_t *rx, size_t size) {
  return mb4sim_spi_transfer(context, tx, rx, size) == 0;
}

/* Microseconds; looking at the clock takes time, as on a processor. */
static uint32_t now_us(void *context) {
  mb4sim_advance_ns(context, 100);
  return (uint32_t)(mb4sim_time_ns(context) / 1000);
}

static mb4_config configuration(void) {
  mb4_config config = mb4_config_default();
  config.ma_hz = mb4_ma_hz_at_most(config.f_clk_hz, 2000000);
  config.mo = true;
  config.protocol[0] = MB4_PROTOCOL_SSI;
  config.protocol[1] = MB4_PROTOCOL_BISS_C;
  config.slaves[0].enabled = true; /* SSI */
  config.slaves[0].data_bits = 25;
  config.slaves[0].gray = true;
  config.slaves[0].flags = MB4_FLAGS_NONE;
  config.slaves[0].crc_polynomial = 0;
  config.slaves[4].enabled = true; /* BiSS C, 26 bits, nE, nW */
  config.slaves[4].data_bits = 28;
  config.slaves[5].enabled = true; /* actuator */
  config.slaves[5].data_bits = 16;
  config.slaves[5].actuator = true;
  return config;
}

static int failed(const char *what, mb4_result result) {
  if (result.code != MB4_OK) {
    printf("%s: %s\n", what, mb4_error_text(result.code));
  }
  return result.code != MB4_OK;
}

int main(void) {
  char error[200];
  mb4sim *const chip = mb4sim_open(kScenario, error, sizeof error);
  mb4_device device;
  const mb4_config config = configuration();
  int status = 1;
  if (chip == NULL) {
    printf("%s\n", error);
    return 1;
  }
  mb4_open(&device, transfer, chip, now_us, chip);
  if (!failed("configure", mb4_configure(&device, &config)) &&
      !failed("actuator", mb4_write_actuator(&device, 6, 0x1234))) {
    status = 0;
  }
  for (int i = 0; i < 3 && status == 0; ++i) {
    mb4_frame frame;
    status = failed("frame", mb4_read_all(&device, &frame));
    if (status == 0 && frame.code[0] == MB4_OK && frame.code[4] == MB4_OK) {
      printf("SSI %" PRIu64 ", BiSS C %" PRIu64 "\n", frame.reading[0].position,
             frame.reading[4].position);
    } else {
      if (status == 0) {
        printf("SSI: %s, BiSS C: %s\n", mb4_error_text(frame.code[0]),
               mb4_error_text(frame.code[4]));
      }
      status = 1;
    }
  }
  mb4sim_close(chip);
  return status;
}
