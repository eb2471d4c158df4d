/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* Where the master is: port_simulator.c has a simulated one, linux.c one in the memory of a Linux board. */

#ifndef PORT_H_
#define PORT_H_

#include <stdbool.h>
#include <stdint.h>

#include "biss_pru.h"

/* `place`: a scenario; or /dev/uio0; or a physical address, for /dev/mem. Says what is wrong and returns false. */
bool board_open(const char *place, biss_pru_port *port);
void board_close(void);
/* Sleeps up to the interrupt of irq_o, at most so long. Without an interrupt always so long. */
void board_sleep_us(uint32_t us);

#endif /* PORT_H_ */
