/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* The master that the programs here drive: a simulated one. A board has other functions of the same names. */

#ifndef PORT_H_
#define PORT_H_

#include <stdbool.h>
#include <stdint.h>

/* In a loop that waits for dataReady time must pass. On a board it does by itself. */
#define PM_BISSC_WAIT() board_pause_us(1)

bool board_open(const char *scenario);
void board_close(void);
/* The clock of the master. */
uint32_t board_clk_hz(void);
void board_pause_us(uint32_t us);
/* The processor sleeps up to the interrupt of irq_o, at most so long. False without one. */
bool board_sleep_us(uint32_t us);

#include "pm_bissc_include.h"

#endif /* PORT_H_ */
