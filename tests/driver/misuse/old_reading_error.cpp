// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Must not compile: the flag of the encoder is not the error of the call.

#include "mb4/mb4.hpp"

bool misuse(const mb4::Result<mb4::Reading>& reading) { return reading.ok() && !reading->error; }
