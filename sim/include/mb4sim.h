/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * C interface of the openmb4 simulator (C99): a simulated iC-MB4-compatible chip with a host and
 * encoders around it. A process may hold any number of simulators. All of them are used from one
 * thread. No function throws, prints or ends the process.
 *
 * A simulator can stop for good. Its time then stands still, and calls return this error:
 *
 *   MB4SIM_ERROR_STOPPED  an assertion in the chip's RTL has failed, or a pulse at MA was too
 *                         short: all calls that let time pass, mb4sim_pin_write(), mb4sim_inject(),
 *                         mb4sim_trace_start()
 *   MB4SIM_ERROR_FAILED   a call ran out of memory or failed in another unforeseen way: all calls
 *                         that change something
 *
 * In both cases mb4sim_spi_byte() returns 0; mb4sim_last_error() after it tells why. One
 * exception: the TOML parser ends the process if memory runs out while a scenario is opened.
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

/* Errors: the negative values that calls return. */
enum {
  MB4SIM_ERROR_UNKNOWN = -1,  /* no such pin or slave, or a null pointer */
  MB4SIM_ERROR_VALUE = -2,    /* level not 0 or 1; word longer than the slave's data; a text with a
                                 mistake; a frame that is not kept; an address or a
                                 strobe that the bus does not have */
  MB4SIM_ERROR_DRIVEN = -3,   /* the pin is an output or driven by the simulation */
  MB4SIM_ERROR_STOPPED = -4,  /* an assertion in the chip's RTL has failed; an MA pulse too short */
  MB4SIM_ERROR_FAILED = -5,   /* out of memory or another failure; only closing is left */
  MB4SIM_ERROR_HOST = -6,     /* the scenario's host has another interface */
  MB4SIM_ERROR_CALLBACK = -7, /* a callback has called what changes something */
  MB4SIM_ERROR_SILENT = -8,   /* the bus has not answered: the clock stands still, or the master is
                                 in reset */
  MB4SIM_ERROR_TRACE = -9     /* no waveform; mb4sim_last_error() tells why */
};

/* Opens a simulator from the TOML text of a scenario (sim/README.md). File names in the text are
 * relative to the working directory. On return the chip has been reset and the time is 1 us.
 * On error the call returns NULL and writes one line "scenario:line:column: key 'x': message" to
 * `error`. The line is cut to error_size bytes with the terminating 0. Without an error `error`
 * becomes an empty string. `error` may be NULL. */
MB4SIM_API mb4sim *mb4sim_open(const char *scenario_text, char *error, size_t error_size);

/* The same from a file. Messages begin with its path. File names in the scenario are relative to
 * its folder. */
MB4SIM_API mb4sim *mb4sim_open_file(const char *path, char *error, size_t error_size);

/* Ends a simulator and frees its memory. NULL is allowed. */
MB4SIM_API void mb4sim_close(mb4sim *sim);

/* Sends one SPI frame: NCS low, n bytes full duplex at the scenario's sclk_hz, NCS high. The chip's
 * bytes go to rx, which may be NULL. Simulated time advances by the real duration of the frame.
 * After mb4sim_spi_select(sim, 1), while NCS is low, the n bytes continue that frame and end it.
 * Returns 0 or a negative error: MB4SIM_ERROR_HOST if the host is on the parallel bus. */
MB4SIM_API int mb4sim_spi_transfer(mb4sim *sim, const uint8_t *tx, uint8_t *rx, size_t n);

/* The same frame byte by byte: active != 0 pulls NCS low, 0 ends the frame. mb4sim_spi_byte()
 * returns the chip's byte. */
MB4SIM_API void mb4sim_spi_select(mb4sim *sim, int active);
MB4SIM_API uint8_t mb4sim_spi_byte(mb4sim *sim, uint8_t mosi);

/* Lets `ns` nanoseconds pass. Time ends at 2^63 ps (106 days) after power-on. */
MB4SIM_API void mb4sim_advance_ns(mb4sim *sim, uint64_t ns);
/* Time since power-on in ns, rounded down. 0 for a null pointer. */
MB4SIM_API uint64_t mb4sim_time_ns(const mb4sim *sim);
/* Number of rising edges of the chip's system clock so far. The system clock is pin CLK, or the
 * oscillator with CLKENI = 1. */
MB4SIM_API uint64_t mb4sim_clk_cycles(const mb4sim *sim);

/* Returns the level of a pin, 0 or 1, by its datasheet name: NCS, ALE, NRD_RNW, NWR_E, DB0..DB7,
 * CFGSPI, INT_NMOT, NRES, CLK, GETSENS, NER, EOT, MA1, MA2_NMA1, MO1, MO2_NMO1, SL1, SL2_NSL1.
 * SCLK, MOSI, MISO, MA2, MO2 and SL2 are names too. CLK reads as its present level. Any other name
 * gives MB4SIM_ERROR_UNKNOWN. */
MB4SIM_API int mb4sim_pin_read(mb4sim *sim, const char *pin);
/* Drives an input pin from outside with `level` 0 or 1. At NER 0 pulls the pin low and 1 lets it
 * go. Returns 0, or MB4SIM_ERROR_UNKNOWN, _VALUE or _DRIVEN. */
MB4SIM_API int mb4sim_pin_write(mb4sim *sim, const char *pin, int level);

/* Sets the raw word (flags included) that slave `slave` latches from now on. Slaves count from 1:
 * iC-MB4: as in SCDATAx; biss_axi: the channel. Returns 0 or a negative error: MB4SIM_ERROR_VALUE
 * if the word is too long, and for a replay slave, which has no data of its own. */
MB4SIM_API int mb4sim_slave_set_data(mb4sim *sim, unsigned slave, uint64_t raw);
/* Reads and writes the slave's own register file, without any traffic on the line. Below address
 * 0x40 this is bank 0. Returns 0 or a negative error. */
MB4SIM_API int mb4sim_slave_reg_read(mb4sim *sim, unsigned slave, uint8_t address, uint8_t *value);
MB4SIM_API int mb4sim_slave_reg_write(mb4sim *sim, unsigned slave, uint8_t address, uint8_t value);
/* Number of frames in which this slave has sent its start bit; 0 if the slave does not exist. */
MB4SIM_API uint64_t mb4sim_slave_frames(const mb4sim *sim, unsigned slave);

/* --- for programs that test firmware --- */

/* Adds faults and cable events while the simulation runs. `toml` holds [[fault]] tables as in a
 * scenario (sim/README.md), or [[channel]] tables with `number` and [[channel.event]] only; an
 * empty text adds nothing. Their times count from now. As in a scenario, the first end of two
 * faults that do the same at one place stops both. Returns 0, or MB4SIM_ERROR_VALUE and the line
 * "inject:line:column: key 'x': message" in `error`, as mb4sim_open() does; then nothing
 * is added. */
MB4SIM_API int mb4sim_inject(mb4sim *sim, const char *toml, char *error, size_t error_size);

/* The raw word (flags included) that slave `slave` latched for its frame number `frame`, from 1 to
 * mb4sim_slave_frames(). It sent this word, unless the frame was reduced or cut. Returns 0;
 * MB4SIM_ERROR_VALUE if there was no such frame, if it is not one of the last 1024, or for a
 * slave that does not know its words (replay). */
MB4SIM_API int mb4sim_slave_sent(const mb4sim *sim, unsigned slave, uint64_t frame, uint64_t *raw);

/* Lets time pass until a pin (mb4sim_pin_read()) has this level, 0 or 1, at most `limit_ns`
 * nanoseconds. Returns 1 when it has, 0 at the limit, or a negative error: MB4SIM_ERROR_DRIVEN for
 * CLK, whose edges cannot be waited for. */
MB4SIM_API int mb4sim_run_until(mb4sim *sim, const char *pin, int level, uint64_t limit_ns);

/* One cycle of the parallel bus with the scenario's timing. Returns 0 or a negative error:
 * MB4SIM_ERROR_HOST if the host of the scenario is not on the parallel bus. */
MB4SIM_API int mb4sim_bus_write(mb4sim *sim, uint8_t address, uint8_t data);
MB4SIM_API int mb4sim_bus_read(mb4sim *sim, uint8_t address, uint8_t *data);

/* One access of a bus of 32-bit words, for a master with such a host (AXI4-Lite: biss_axi;
 * sim/README.md tells the interfaces). `address` is a byte address, a multiple of 4 inside the
 * master's range (biss_axi: 0 to 0xFC). `strobe` has the bits 0 to 3: bit b lets byte b (bits
 * 8b+7..8b) be written. Simulated time advances by the duration of the access.
 *
 * Returns 0; 1 if the bus answered with an error, or a negative error: MB4SIM_ERROR_VALUE for
 * another address or strobe, and nothing has been accessed; MB4SIM_ERROR_HOST if the scenario's
 * host is on no such bus; MB4SIM_ERROR_SILENT if no answer came (biss_axi: within 1000 clocks).
 * `*data` is written only with 0 and 1. */
MB4SIM_API int mb4sim_axi_write(mb4sim *sim, uint32_t address, uint32_t data, uint8_t strobe);
MB4SIM_API int mb4sim_axi_read(mb4sim *sim, uint32_t address, uint32_t *data);

/* `n` bytes from any byte address on over the same bus: one access for each word that they touch,
 * upwards, with strobes for a part of a word; byte 0 of a word is its bits 7..0. n = 0 accesses
 * nothing. Simulated time advances by the duration of the accesses.
 *
 * Returns 0, or as mb4sim_axi_*: MB4SIM_ERROR_VALUE if a byte is outside of the master's range, and
 * nothing has been accessed; otherwise what the first access has returned that was not 0. It was
 * the last one. A read has then written the bytes of the words before it, and of its own word with
 * the answer 1. */
MB4SIM_API int mb4sim_mem_write(mb4sim *sim, uint32_t address, const uint8_t *bytes, size_t n);
MB4SIM_API int mb4sim_mem_read(mb4sim *sim, uint32_t address, uint8_t *bytes, size_t n);

/* The next beat of the stream beside that bus (biss_axi: s_axis, taken at once by a sink that keeps
 * 65,536 beats). At most n words are written; words may be NULL with n = 0. `user`, which may be
 * NULL, receives the side band (biss_axi: bit c: the word of channel c is of this frame and good).
 * Returns the number of words of the beat (biss_axi: 1, 4 or 16, the channels of the model; with
 * features = "full" two for each, the lower first), 0 if none waits, or a negative error:
 * MB4SIM_ERROR_HOST if there is no stream. No time passes. */
MB4SIM_API int mb4sim_stream_read(mb4sim *sim, uint32_t *words, size_t n, uint32_t *user);

/* A frame on a line. The struct may grow at its end; `size` tells what there is. */
typedef struct mb4sim_frame {
  size_t size;       /* of this struct, bytes */
  unsigned channel;  /* 1 or 2 */
  uint64_t number;   /* of the frame on its channel since power-on, from 1 on. INIT, BREAK, BiSS B
                        accesses and MA force bits count too, so it is not a slave's number */
  uint64_t start_ns; /* first falling edge of MA at the chip, since power-on */
  uint64_t end_ns;   /* last edge of MA */
  unsigned ma_edges; /* edges of MA, both directions */
  unsigned flags;    /* MB4SIM_FRAME_... */
} mb4sim_frame;

enum {
  MB4SIM_FRAME_MA_LOW = 1, /* MA rests at 0 after the frame: CDM = 1 in BiSS C */
  MB4SIM_FRAME_FAULT = 2   /* a [[fault]] of the line, a slave or the clock lasted in the frame */
};

typedef void (*mb4sim_frame_callback)(void *context, const mb4sim_frame *frame);

/* From now on `callback` is called at the end of every frame of a channel, inside the call that
 * lets time pass. NULL ends it. Returns 0 or a negative error. mb4sim_on_edge() tells the single
 * edges of a frame; both may be in use at once.
 *
 * A frame is over when MA has rested for 1.5 of its periods (40 us before its second rising edge).
 * So MA below 12.5 kHz, or a clock that changes inside a frame, splits a frame; slaves with a
 * shorter timeout join two. The chip's flags may follow later: read them at EOT = 1.
 *
 * `frame` is valid in the call only. The callback may read pins, time, words and registers, and
 * close the simulator. It must not throw or jump. Calls that change something return
 * MB4SIM_ERROR_CALLBACK in it, mb4sim_on_frame() too. */
MB4SIM_API int mb4sim_on_frame(mb4sim *sim, mb4sim_frame_callback callback, void *context);

/* Where an edge of a line is. */
enum {
  MB4SIM_EDGE_MA = 0, /* pins of the chip */
  MB4SIM_EDGE_MO = 1,
  MB4SIM_EDGE_SL = 2,
  MB4SIM_EDGE_SLO = 3, /* output of the slave next to SL, at its end of the cable */
  /* of a line with one wire that both ends drive */
  MB4SIM_EDGE_OUT = 4,    /* level that the master sends */
  MB4SIM_EDGE_EN = 5,     /* enable of its driver */
  MB4SIM_EDGE_IN = 6,     /* level that the master sees */
  MB4SIM_EDGE_ENCODER = 7 /* level that the encoder sends, 1 while its driver is off, at its end */
};

/* A line has a new level, 0 or 1, since `time_ps` picoseconds after power-on. `channel` is from 1
 * on, `place` is MB4SIM_EDGE_... */
typedef void (*mb4sim_edge_callback)(void *context, unsigned channel, unsigned place,
                                     uint64_t time_ps, int level);

/* From now on `callback` is called at every edge of the scenario's lines, inside the call that lets
 * time pass. This call itself tells the present level of every place. NULL ends it. Several edges
 * may have the same time; those of one place alternate. Returns 0 or a negative error. The callback
 * must not do what that of mb4sim_on_frame() must not. */
MB4SIM_API int mb4sim_on_edge(mb4sim *sim, mb4sim_edge_callback callback, void *context);

/* A watched pin has a new level, 0 or 1, since `time_ps` picoseconds after power-on. `pin` is its
 * index in the list of mb4sim_watch_pins(). */
typedef void (*mb4sim_pin_callback)(void *context, size_t pin, uint64_t time_ps, int level);

/* Lets `ns` nanoseconds pass and calls `callback` at every change of these `n` pins
 * (mb4sim_pin_read()), first for their present levels. A change lasts at least until the next event
 * of the simulation: a shorter one is not told. Returns 0 or a negative error:
 * MB4SIM_ERROR_UNKNOWN, and MB4SIM_ERROR_DRIVEN for CLK, whose edges are not told; then no time has
 * passed. The callback must not do what that of mb4sim_on_frame() must not. */
MB4SIM_API int mb4sim_watch_pins(mb4sim *sim, const char *const *pins, size_t n, uint64_t ns,
                                 mb4sim_pin_callback callback, void *context);

/* Begins a waveform now: an FST file (GTKWave, Surfer) at `path`, as `mb4sim run --trace` writes
 * it, with the pins, the registers inside the chip, and the levels at the slaves. Edges that are on
 * a cable when it begins may appear early at the slaves. Its times are those since power-on in ps.
 * An existing file is replaced. The simulation goes on as without a waveform, at a few per cent of
 * its speed.
 *
 * Returns 0, or MB4SIM_ERROR_TRACE, and then nothing has changed: the file cannot be written; a
 * waveform is being written already; the master writes none (biss_axi); the library was built
 * without waveforms. MB4SIM_ERROR_UNKNOWN for a null pointer, MB4SIM_ERROR_CALLBACK in a
 * callback. */
MB4SIM_API int mb4sim_trace_start(mb4sim *sim, const char *path);
/* Ends the waveform and completes its file; mb4sim_close() does so too. It works after
 * MB4SIM_ERROR_STOPPED: the file then ends where the simulator stopped. Returns 0, or
 * MB4SIM_ERROR_TRACE if no waveform is being written, MB4SIM_ERROR_CALLBACK in a callback. */
MB4SIM_API int mb4sim_trace_stop(mb4sim *sim);

/* Writes what has gone wrong so far as JSON to `json`, cut to `size` bytes with the terminating 0:
 *
 *   time_ns          now
 *   faults           list of [[fault]]s that have happened: kind, channel (0: host and clock),
 *                    slave (0: none), what, begin_ns, end_ns (null: it lasts), frames: how many it
 *                    touched, ner_low: after how many of them pin NER was low, at EOT = 1 or when
 *                    the next frame started
 *   host_violations  count, and first: a list of up to 100 with item ("I205") and text
 *   hints            list of what does not fit between the master, as its host has told it, and the
 *                    scenario: kind ("length"; sim/README.md lists them), place ("slave 1",
 *                    "channel 1", "chip", "host") and text. They compare set-ups only, at the latest
 *                    request for words: a fault gives none
 *
 * Returns the length that the whole text needs, without the 0, or a negative error. `json` may be
 * NULL with size 0. Frames are counted from power-on if the scenario has [[fault]], else from the
 * first mb4sim_inject(), mb4sim_on_frame() or mb4sim_on_edge() on. */
MB4SIM_API int mb4sim_report(const mb4sim *sim, char *json, size_t size);

/* The error of the latest call of mb4sim_spi_select(), mb4sim_spi_byte(), mb4sim_advance_ns(),
 * mb4sim_trace_start() or mb4sim_trace_stop(), 0 if it had none. `text` receives it in words, cut
 * to `size` bytes; it may be NULL. */
MB4SIM_API int mb4sim_last_error(const mb4sim *sim, char *text, size_t size);

/* Version of the library, "major.minor.patch". */
MB4SIM_API const char *mb4sim_version(void);

#ifdef __cplusplus
}
#endif

#endif /* MB4SIM_H_ */
