/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * With `mb4sim spidev --simulated-time` the program lives in simulated time: its clocks show it,
 * and its sleeps pass in the simulation and return at once. A look at a clock takes a microsecond,
 * so that a program that only reads the clock while it waits makes progress.
 */
#ifndef MB4_TOOLS_SPIDEV_SIMULATED_TIME_H_
#define MB4_TOOLS_SPIDEV_SIMULATED_TIME_H_

void simulated_time_on(void);

#endif /* MB4_TOOLS_SPIDEV_SIMULATED_TIME_H_ */
