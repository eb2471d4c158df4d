/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * C interface of the openmb4 simulator (C99): a simulated iC-MB4-compatible chip with a host and
 * encoders around it. A process may hold any number of simulators, all used from one thread. No
 * function throws, prints or ends the process.
 *
 * When an assertion in the chip's RTL fails, the simulator stops for good: time stands still from
 * then on, mb4sim_spi_transfer() and mb4sim_pin_write() return MB4SIM_ERROR_STOPPED,
 * mb4sim_spi_byte() returns 0. The same with MB4SIM_ERROR_FAILED, also from
 * mb4sim_slave_set_data() and mb4sim_slave_reg_write(), when a call runs out of memory or fails in
 * another unforeseen way. One exception: the TOML parser ends the process when memory runs out
 * while a scenario is opened.
 */
#ifndef MB4SIM_H_
#define MB4SIM_H_

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define MB4SIM_API __attribute__((visibility("default")))
#else
#define MB4SIM_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mb4sim mb4sim;

/* Negative return values. */
enum {
  MB4SIM_ERROR_UNKNOWN = -1, /* no such pin or slave, or a null pointer */
  MB4SIM_ERROR_VALUE = -2,   /* level not 0 or 1; word longer than the slave's data */
  MB4SIM_ERROR_DRIVEN = -3,  /* the pin is an output or driven by the simulation */
  MB4SIM_ERROR_STOPPED = -4, /* an assertion in the chip's RTL has failed */
  MB4SIM_ERROR_FAILED = -5,  /* out of memory or another failure; only closing is left */
  MB4SIM_ERROR_HOST = -6     /* SPI with a scenario whose host is on the parallel bus */
};

/* Opens a simulator from the TOML text of a scenario (sim/README.md). Files that it names are
 * looked for in the working directory. The chip has been reset and the time is 1 us. On error
 * returns NULL and writes one line "scenario:line:column: key 'x': message" to `error`, cut to
 * error_size bytes with the terminating 0; error may be NULL. */
MB4SIM_API mb4sim *mb4sim_open(const char *scenario_text, char *error, size_t error_size);

/* The same from a file; messages begin with its path, files that it names are looked for in its
 * folder. */
MB4SIM_API mb4sim *mb4sim_open_file(const char *path, char *error, size_t error_size);

/* Ends a simulator. NULL is allowed. */
MB4SIM_API void mb4sim_close(mb4sim *sim);

/* One SPI frame: NCS low, n bytes full duplex at the scenario's sclk_hz, NCS high. rx may be NULL.
 * Simulated time advances by its real duration. While NCS is low after mb4sim_spi_select(sim, 1)
 * the n bytes continue that frame, and it ends with them. 0 or a negative error. */
MB4SIM_API int mb4sim_spi_transfer(mb4sim *sim, const uint8_t *tx, uint8_t *rx, size_t n);

/* The same byte by byte: active != 0 pulls NCS low. */
MB4SIM_API void mb4sim_spi_select(mb4sim *sim, int active);
MB4SIM_API uint8_t mb4sim_spi_byte(mb4sim *sim, uint8_t mosi);

/* Lets `ns` nanoseconds pass, but not beyond 2^63 ps (106 days) since power-on. */
MB4SIM_API void mb4sim_advance_ns(mb4sim *sim, uint64_t ns);
/* Time since power-on, rounded down. */
MB4SIM_API uint64_t mb4sim_time_ns(const mb4sim *sim);
/* Rising edges of the chip's system clock (pin CLK, or the oscillator with CLKENI = 1). */
MB4SIM_API uint64_t mb4sim_clk_cycles(const mb4sim *sim);

/* Level of a pin, 0 or 1, by its datasheet name: NCS, ALE, NRD_RNW, NWR_E, DB0..DB7, CFGSPI,
 * INT_NMOT, NRES, CLK, GETSENS, NER, EOT, MA1, MA2_NMA1, MO1, MO2_NMO1, SL1, SL2_NSL1; also SCLK,
 * MOSI, MISO, MA2, MO2, SL2. CLK too has its present level.
 * MB4SIM_ERROR_UNKNOWN for any other name. */
MB4SIM_API int mb4sim_pin_read(mb4sim *sim, const char *pin);
/* Drives an input from outside; 0 or a negative error. NER: 0 pulls it low, 1 lets it go. */
MB4SIM_API int mb4sim_pin_write(mb4sim *sim, const char *pin, int level);

/* Raw word (flags included) that slave `slave` latches from now on; 1 to 8 as in SCDATAx. 0 or a
 * negative error; a replay slave has no data of its own (MB4SIM_ERROR_VALUE). */
MB4SIM_API int mb4sim_slave_set_data(mb4sim *sim, unsigned slave, uint64_t raw);
/* The slave's own register file. 0 or a negative error. */
MB4SIM_API int mb4sim_slave_reg_read(mb4sim *sim, unsigned slave, uint8_t address, uint8_t *value);
MB4SIM_API int mb4sim_slave_reg_write(mb4sim *sim, unsigned slave, uint8_t address, uint8_t value);
/* Frames in which this slave has sent its start bit; 0 for a slave that does not exist. */
MB4SIM_API uint64_t mb4sim_slave_frames(const mb4sim *sim, unsigned slave);

/* Version of the library, "0.1.0". */
MB4SIM_API const char *mb4sim_version(void);

#ifdef __cplusplus
}
#endif

#endif /* MB4SIM_H_ */
