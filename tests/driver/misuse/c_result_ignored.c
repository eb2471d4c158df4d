/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Must not compile with warnings as errors: an unread result hides a failure. */
#include "mb4.h"

void misuse(mb4_device *device);
void misuse(mb4_device *device) { mb4_break_transmission(device); }
