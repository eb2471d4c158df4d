/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Every call of mb4.h, from C99, on the Verilated chip: success, and that errors come through.
 */
#include <stdio.h>
#include <string.h>

#include "mb4.h"
#include "mb4sim.h"

static unsigned failures;

static void check(int good, const char *what, int line) {
  if (!good) {
    printf("line %d: %s\n", line, what);
    ++failures;
  }
}
#define CHECK(condition) check((condition), #condition, __LINE__)
#define OK(call) check((call).code == MB4_OK, #call, __LINE__)
#define FAILS(call, error) check((call).code == (error), #call " is not " #error, __LINE__)

static const char kScenario[] =
    "[[channel]]\nnumber = 1\ndelay_ns = 500\n[[channel.slave]]\nprotocol = \"biss-c\"\n"
    "data_bits = 28\ndata = 0xAAF37BF\ncontrol = true\n"
    "registers = { 0x44 = [0x00, 0xD9, 0x01, 0x32] }\n";

/* A bus that refuses when `broken` is set. */
typedef struct {
  mb4sim *simulator;
  bool broken;
} bus_t;

static bool transfer(void *context, const uint8_t *tx, uint8_t *rx, size_t size) {
  bus_t *bus = context;
  return !bus->broken && mb4sim_spi_transfer(bus->simulator, tx, rx, size) == 0;
}

static uint32_t now_us(void *context) {
  bus_t *bus = context;
  mb4sim_advance_ns(bus->simulator, 100);
  return (uint32_t)(mb4sim_time_ns(bus->simulator) / 1000);
}

static mb4_config encoder(void) {
  mb4_config config = mb4_config_default();
  config.ma_hz = mb4_ma_hz_at_most(config.f_clk_hz, 5000000);
  config.protocol[0] = MB4_PROTOCOL_BISS_C;
  config.slaves[0].enabled = true;
  config.slaves[0].data_bits = 28;
  config.slaves[0].crc_polynomial = 0x43;
  return config;
}

static void test_configuration(void) {
  mb4_config config = encoder();
  CHECK(config.ma_hz == 5000000);
  CHECK(mb4_frame_period_clk_at_least(20000000, 100000) == 2000);
  OK(mb4_validate(&config));
  config.slaves[0].data_bits = 65;
  const mb4_result wrong = mb4_validate(&config);
  CHECK(wrong.code == MB4_INVALID_CONFIG && wrong.number == 1);
  CHECK(strcmp(mb4_field_text(wrong.field), "data_bits") == 0);
  CHECK(strcmp(mb4_error_text(wrong.code), "invalid configuration") == 0);
}

static void test_single(mb4_device *device) {
  uint8_t version = 0;
  uint8_t revision = 0;
  uint8_t quarters[MB4_CHANNELS] = {0, 0};
  uint8_t status[MB4_STATUS_BYTES];
  const mb4_config config = encoder();
  mb4_reading reading;
  mb4_frame frame;
  FAILS(mb4_read_frame(device, 1, &reading), MB4_NOT_CONFIGURED);
  FAILS(mb4_initialize(device, quarters), MB4_NOT_CONFIGURED);
  OK(mb4_probe(device, &version, &revision));
  CHECK(version == 0x84 && revision == 0x20);
  OK(mb4_configure(device, &config));
  OK(mb4_verify(device));
  OK(mb4_initialize(device, quarters));
  CHECK(quarters[0] >= 10 && quarters[0] <= 12 && quarters[1] == 0);
  OK(mb4_read_frame(device, 1, &reading));
  CHECK(reading.position == 0x2ABCDEF && reading.raw == 0xAAF37BF && reading.slave == 1);
  CHECK(!reading.slave_error && !reading.slave_warning && reading.crc_stored &&
        reading.crc == 0x18);
  FAILS(mb4_read_frame(device, 2, &reading), MB4_INVALID_ARGUMENT);
  OK(mb4_read_all(device, &frame));
  CHECK(frame.code[0] == MB4_OK && frame.reading[0].position == 0x2ABCDEF);
  CHECK(frame.code[1] == MB4_INVALID_ARGUMENT && (frame.status[0] & 1) == 1);
  OK(mb4_read_status(device, status));
  CHECK(status[0] == 0xFB);
  OK(mb4_clear_valid(device, 1));
  FAILS(mb4_clear_valid(device, 9), MB4_INVALID_ARGUMENT);
  OK(mb4_break_transmission(device));
}

static void test_slave_registers(mb4_device *device) {
  const uint8_t written[2] = {0x12, 0x34};
  const uint8_t serial[4] = {0x00, 0xD9, 0x01, 0x32};
  const mb4_command activate = {1, 1, 0, true};
  uint8_t data[4];
  bool ended = false;
  mb4_identity identity;
  uint8_t count = 0;
  OK(mb4_slave_write(device, 1, 0, 0x60, written, 2));
  OK(mb4_slave_read(device, 1, 0, 0x60, data, 2));
  CHECK(memcmp(data, written, 2) == 0);
  OK(mb4_slave_begin_read(device, 1, 0, 0x44, 4));
  FAILS(mb4_slave_begin_write(device, 1, 0, 0x60, written, 2), MB4_BUSY);
  while (!ended) {
    const mb4_result polled = mb4_slave_poll(device, &ended);
    OK(polled);
    if (polled.code != MB4_OK) {
      break;
    }
  }
  OK(mb4_slave_take(device, data, 4));
  CHECK(memcmp(data, serial, 4) == 0);
  OK(mb4_slave_begin_write(device, 1, 0, 0x60, written, 2));
  OK(mb4_slave_abort(device));
  OK(mb4_slave_begin_command(device, &activate));
  OK(mb4_slave_abort(device));
  OK(mb4_slave_command(device, &activate));
  OK(mb4_slave_activate(device, 0, 0));
  CHECK(mb4_slave_activate(device, 0, 1).code == MB4_UNSUPPORTED); /* channel 2 is not used */
  const mb4_result missing = mb4_slave_read(device, 1, 5, 0x44, data, 1);
  CHECK(missing.code == MB4_REGISTER && missing.detail == 0);
  OK(mb4_scan(device, 1, &identity, 1, &count));
  CHECK(count == 1);
  count = 0;
  OK(mb4_scan(device, 1, NULL, 0, &count));
  CHECK(count == 1);
}

/* An actuator of 16 bits. */
static void test_actuator(void) {
  static const char scenario[] =
      "[[channel]]\nnumber = 1\nmo = true\n[[channel.slave]]\nprotocol = \"biss-c\"\n"
      "data_bits = 16\nactuator = true\n";
  char error[200];
  uint8_t word[2] = {0, 0};
  bus_t bus = {mb4sim_open(scenario, error, sizeof error), false};
  mb4_device device;
  mb4_config config = encoder();
  config.mo = true;
  config.frame_start = MB4_START_PERIODIC;
  config.frame_period_clk = 2000;
  config.slaves[0].data_bits = 16;
  config.slaves[0].actuator = true;
  if (bus.simulator == NULL) {
    check(0, error, __LINE__);
    return;
  }
  mb4_open(&device, transfer, &bus, now_us, &bus);
  OK(mb4_configure(&device, &config));
  OK(mb4_write_actuator(&device, 1, 0x1234));
  OK(mb4_read_registers(&device, 0x00, word, 2));
  CHECK(word[0] == 0x34 && word[1] == 0x12);
  FAILS(mb4_write_actuator(&device, 1, 0x10000), MB4_INVALID_ARGUMENT);
  FAILS(mb4_write_actuator(&device, 2, 1), MB4_INVALID_ARGUMENT);
  FAILS(mb4_automatic_write_actuator(&device, 1, 1), MB4_WRONG_MODE);
  OK(mb4_automatic_start(&device));
  OK(mb4_automatic_write_actuator(&device, 1, 0x5678));
  OK(mb4_automatic_stop(&device));
  bus.broken = true;
  FAILS(mb4_write_actuator(&device, 1, 1), MB4_TRANSPORT);
  mb4sim_close(bus.simulator);
}

static void test_automatic(mb4_device *device, mb4sim *simulator) {
  mb4_config config = encoder();
  mb4_frame frame;
  mb4_reading reading;
  config.frame_start = MB4_START_PERIODIC;
  config.frame_period_clk = mb4_frame_period_clk_at_least(config.f_clk_hz, 100000);
  OK(mb4_configure(device, &config));
  FAILS(mb4_automatic_poll(device, &frame), MB4_WRONG_MODE);
  OK(mb4_automatic_start(device));
  OK(mb4_automatic_next(device, &frame));
  CHECK(frame.code[0] == MB4_OK && frame.reading[0].position == 0x2ABCDEF);
  OK(mb4_automatic_restart(device));
  mb4sim_advance_ns(simulator, 150000);
  OK(mb4_automatic_poll(device, &frame));
  CHECK(frame.code[0] == MB4_OK);
  mb4sim_advance_ns(simulator, 150000);
  OK(mb4_automatic_poll_slave(device, 1, &reading));
  CHECK(reading.position == 0x2ABCDEF);
  FAILS(mb4_automatic_poll_slave(device, 1, &reading), MB4_NO_DATA);
  OK(mb4_automatic_stop(device));
}

/* Makes all steps of an operation; afterwards its result. */
static mb4_result complete(mb4_device *device, bus_t *bus, mb4_operation *operation) {
  mb4_spi_frame frames[MB4_STEP_FRAMES];
  bool transferred = true;
  unsigned steps = 0;
  do {
    uint32_t pause_us = 0;
    const size_t count = mb4_operation_frames(operation, frames, &pause_us);
    size_t i = 0;
    mb4sim_advance_ns(bus->simulator, pause_us * UINT64_C(1000));
    transferred = true;
    for (i = 0; i < count && transferred; ++i) {
      transferred = transfer(bus, frames[i].tx, frames[i].rx, frames[i].size);
    }
    CHECK(++steps < 10000);
  } while (!mb4_finish(device, operation, transferred, now_us(bus)));
  return mb4_operation_result(operation);
}

static void test_steps(mb4_device *device, bus_t *bus) {
  static const uint8_t data[2] = {0x5A, 0xC3};
  mb4_config config = encoder();
  mb4_operation operation;
  mb4_frame_read read;
  mb4_frame frame;
  mb4_spi_frame frames[MB4_STEP_FRAMES];
  mb4_command command = {1, 0, 1, false};
  uint8_t quarters[MB4_CHANNELS] = {0, 0};
  uint8_t back[4] = {0, 0, 0, 0};
  bool transferred = true;
  mb4_operation_begin(&operation);
  mb4_frame_read_begin(&read);
  FAILS(mb4_operation_result(&operation), MB4_WRONG_MODE);
  OK(mb4_plan_configure(device, &operation, &config));
  OK(complete(device, bus, &operation));
  OK(mb4_plan_verify(device, &operation));
  OK(complete(device, bus, &operation));
  OK(mb4_plan_initialize(device, &operation));
  FAILS(mb4_plan_break(device, &operation), MB4_BUSY);
  OK(complete(device, bus, &operation));
  mb4_operation_line_delay(&operation, quarters);
  CHECK(quarters[0] > 1);
  OK(mb4_plan_read_all(device, &operation, &read));
  OK(complete(device, bus, &operation));
  OK(mb4_frame_read_result(&read, &frame));
  CHECK(frame.code[0] == MB4_OK && frame.reading[0].position == 0x2ABCDEF && frame.one_frame);
  OK(mb4_plan_slave_write(device, &operation, 1, 0, 0x60, data, sizeof data));
  OK(complete(device, bus, &operation));
  OK(mb4_plan_slave_read(device, &operation, 1, 0, 0x60, back, 2));
  OK(complete(device, bus, &operation));
  CHECK(back[0] == 0x5A && back[1] == 0xC3);
  OK(mb4_plan_slave_command(device, &operation, &command));
  OK(complete(device, bus, &operation));
  OK(mb4_plan_slave_activate(device, &operation, 1, 0));
  OK(complete(device, bus, &operation));
  FAILS(mb4_plan_actuator(device, &operation, 1, 1), MB4_INVALID_ARGUMENT);
  FAILS(mb4_plan_automatic_actuator(device, &operation, 1, 1), MB4_WRONG_MODE);
  config.frame_start = MB4_START_PERIODIC;
  config.frame_period_clk = mb4_frame_period_clk_at_least(config.f_clk_hz, 100000);
  OK(mb4_plan_configure(device, &operation, &config));
  OK(complete(device, bus, &operation));
  OK(mb4_plan_start(device, &operation));
  OK(complete(device, bus, &operation));
  OK(mb4_plan_restart(device, &operation));
  OK(complete(device, bus, &operation));
  mb4sim_advance_ns(bus->simulator, 150000);
  OK(mb4_plan_frame(device, &read, false));
  do {
    const size_t count = mb4_frame_read_frames(&read, frames);
    size_t i = 0;
    for (i = 0; i < count; ++i) {
      transferred = transferred && transfer(bus, frames[i].tx, frames[i].rx, frames[i].size);
    }
  } while (!mb4_finish_frame(device, &read, transferred, now_us(bus)));
  OK(mb4_frame_read_result(&read, &frame));
  CHECK(frame.code[0] == MB4_OK && frame.reading[0].position == 0x2ABCDEF && frame.one_frame);
  OK(mb4_plan_stop(device, &operation));
  OK(complete(device, bus, &operation));
  FAILS(mb4_plan_frame(device, &read, false), MB4_WRONG_MODE);
  OK(mb4_plan_break(device, &operation));
  bus->broken = true;
  FAILS(complete(device, bus, &operation), MB4_TRANSPORT);
  bus->broken = false;
}

static void test_raw_and_reset(mb4_device *device, bus_t *bus) {
  const uint8_t byte = 0x5A;
  uint8_t data[2];
  uint8_t status[MB4_STATUS_BYTES];
  OK(mb4_write_registers(device, 0x80, &byte, 1));
  OK(mb4_read_registers(device, 0x80, data, 1));
  CHECK(data[0] == 0x5A);
  OK(mb4_reset(device));
  OK(mb4_read_registers(device, 0xED, data, 1));
  CHECK(data[0] == 0);
  bus->broken = true;
  FAILS(mb4_probe(device, &data[0], &data[1]), MB4_TRANSPORT);
  FAILS(mb4_reset(device), MB4_TRANSPORT);
  FAILS(mb4_read_status(device, status), MB4_TRANSPORT);
  bus->broken = false;
}

static const char kSafetyScenario[] =
    "[[channel]]\nnumber = 1\n"
    "[[channel.slave]]\nprotocol = \"biss-c\"\npreset = \"bp3-cpw\"\nsource = \"ramp\"\nstep = "
    "100\n"
    "[[channel.slave]]\nprotocol = \"biss-c\"\npreset = \"bp3-spw\"\ncrc_start = 0x1234\n"
    "source = \"ramp\"\nstep = 100\n"
    "[[fault]]\nkind = \"stuck-counter\"\nslave = 2\nat_us = 2000\nfor_us = 300\n";

/* BiSS Safety: a stuck counter is found, and a verdict goes through a snapshot. */
static void test_safety(void) {
  char error[200];
  bus_t bus = {mb4sim_open(kSafetyScenario, error, sizeof error), false};
  mb4_device device;
  mb4_safety safety;
  mb4_safety_config words = mb4_bp3_safety(26, 26, 0, 0x1234);
  mb4_safety_config wrong = words;
  mb4_safety_verdict verdict;
  mb4_safety_verdict seen;
  mb4_config config = encoder();
  mb4_frame frame;
  mb4_result misfit;
  uint32_t latest[MB4_SNAPSHOT_WORDS(sizeof(mb4_safety_verdict))] = {0};
  uint64_t next_ns = 0;
  unsigned tick = 0;
  unsigned good = 0;
  unsigned stuck = 0;
  unsigned other = 0;
  if (bus.simulator == NULL) {
    check(0, error, __LINE__);
    return;
  }
  CHECK(words.control.data_bits == 28 && words.safety.data_bits == 34 && words.life_bits == 6);
  CHECK(words.safety.crc_polynomial == 0x190D9 && words.safety.crc_start == 0x1234);
  config.spi_check = MB4_SPI_CHECK_CRC;
  config.frame_start = MB4_START_PERIODIC;
  config.frame_period_clk = mb4_frame_period_clk_at_least(config.f_clk_hz, 100000);
  config.slaves[1].enabled = true;
  config.slaves[1].data_bits = 34;
  config.slaves[1].flags = MB4_FLAGS_NONE;
  config.slaves[1].crc_polynomial = 0x190D9;
  misfit = mb4_safety_fits(&config, 1, 2, &words);
  CHECK(misfit.code == MB4_UNSUPPORTED && misfit.number == 2);
  CHECK(strcmp(mb4_field_text(misfit.field), "crc_start") == 0);
  config.slaves[1].crc_start = 0x1234;
  OK(mb4_safety_fits(&config, 1, 2, &words));
  FAILS(mb4_safety_fits(&config, 1, 1, &words), MB4_INVALID_ARGUMENT);
  /* What is not configured passes nothing. */
  wrong.life_bits = 9;
  misfit = mb4_safety_configure(&safety, &wrong);
  CHECK(misfit.code == MB4_INVALID_ARGUMENT && misfit.number == 9); /* SafetyField::kLife */
  mb4_safety_check(&safety, NULL, 1, 2, 1, &verdict);
  CHECK(verdict.checks_failed == 1U << MB4_SAFETY_CONFIGURED);
  OK(mb4_safety_configure(&safety, &words));
  mb4_safety_check(&safety, NULL, 1, 2, 1, &verdict);
  CHECK(verdict.checks_failed == (1U << MB4_SAFETY_CONTROL_WORD | 1U << MB4_SAFETY_SAFETY_WORD));
  mb4_open(&device, transfer, &bus, now_us, &bus);
  OK(mb4_configure(&device, &config));
  OK(mb4_automatic_start(&device));
  mb4sim_advance_ns(bus.simulator, 150000);
  next_ns = mb4sim_time_ns(bus.simulator);
  CHECK(!mb4_snapshot_read(latest, &seen, sizeof seen) && mb4_snapshot_writes(latest) == 0);
  for (tick = 0; tick < 40; ++tick) {
    next_ns += 100000;
    mb4sim_advance_ns(bus.simulator, next_ns - mb4sim_time_ns(bus.simulator));
    OK(mb4_automatic_poll(&device, &frame));
    if (tick == 30) mb4_safety_restart(&safety);
    mb4_safety_check(&safety, &frame, 1, 2, 1, &verdict);
    if (verdict.checks_failed == 0) {
      ++good;
      CHECK(verdict.position == frame.reading[0].position);
      CHECK(verdict.safety_position == verdict.position);
      CHECK(verdict.life == (frame.reading[1].raw & 63));
    } else if (tick == 0 || tick == 30) {
      CHECK(verdict.checks_failed == 1U << MB4_SAFETY_LIFE_KNOWN);
    } else if (verdict.checks_failed == 1U << MB4_SAFETY_LIFE_STUCK) {
      ++stuck;
    } else { /* the counter goes on: one verdict */
      ++other;
    }
    mb4_snapshot_write(latest, &verdict, sizeof verdict);
    CHECK(mb4_snapshot_read(latest, &seen, sizeof seen));
    CHECK(seen.position == verdict.position && seen.checks_failed == verdict.checks_failed);
    CHECK(mb4_snapshot_writes(latest) == tick + 1);
  }
  CHECK(stuck >= 2 && stuck <= 4 && other <= 1 && good + stuck + other == 38);
  /* Swapped words: the start values tell them apart. A slave that does not exist brings nothing. */
  mb4_safety_check(&safety, &frame, 2, 1, 1, &verdict);
  CHECK((verdict.checks_failed & 1U << MB4_SAFETY_CONTROL_CRC) != 0);
  mb4_safety_check(&safety, &frame, 0, 9, 1, &verdict);
  CHECK((verdict.checks_failed & 1U << MB4_SAFETY_SAFETY_WORD) != 0);
  frame.one_frame = false;
  mb4_safety_check(&safety, &frame, 1, 2, 1, &verdict);
  CHECK((verdict.checks_failed & 1U << MB4_SAFETY_ONE_FRAME) != 0);
  frame.code[0] = MB4_CRC;
  mb4_safety_check(&safety, &frame, 1, 2, 1, &verdict);
  CHECK((verdict.checks_failed & 1U << MB4_SAFETY_CONTROL_CRC) != 0 && verdict.position == 0);
  CHECK(strcmp(mb4_safety_text(MB4_SAFETY_LIFE_STUCK), "life counter stuck") == 0);
  CHECK(strcmp(mb4_safety_text(99), "unknown") == 0);
  mb4sim_close(bus.simulator);
}

static void test_positions(void) {
  uint64_t multi = 0;
  uint64_t single = 0;
  int64_t total = 0;
  mb4_tracker tracker;
  CHECK(mb4_to_signed(0x3FF, 10) == -1);
  CHECK(mb4_gray_to_binary(mb4_binary_to_gray(1234)) == 1234);
  OK(mb4_split_turns(0x12345, 4, 16, &multi, &single));
  CHECK(multi == 1 && single == 0x2345);
  FAILS(mb4_split_turns(0, 0, 0, &multi, &single), MB4_INVALID_ARGUMENT);
  mb4_tracker_begin(&tracker, 12, 0);
  OK(mb4_tracker_update(&tracker, 4090, &total));
  OK(mb4_tracker_update(&tracker, 5, &total));
  CHECK(total == 4101);
  FAILS(mb4_tracker_update(&tracker, 5 + 2048, &total), MB4_JUMP);
}

int main(void) {
  char error[200];
  bus_t bus = {mb4sim_open(kScenario, error, sizeof error), false};
  mb4_device device;
  if (bus.simulator == NULL) {
    printf("%s\n", error);
    return 1;
  }
  mb4_open(&device, transfer, &bus, now_us, &bus);
  test_configuration();
  test_single(&device);
  test_slave_registers(&device);
  test_automatic(&device, bus.simulator);
  test_steps(&device, &bus);
  test_raw_and_reset(&device, &bus);
  test_positions();
  test_safety();
  test_actuator();
  mb4sim_close(bus.simulator);
  printf("%u failures\n", failures);
  return failures != 0;
}
