/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* The result of biss_pru_position() is not looked at. */

#include "biss_pru.h"

void loop(biss_pru_master *pru, biss_pru_reading *reading);

void loop(biss_pru_master *pru, biss_pru_reading *reading) { biss_pru_position(pru, reading); }
