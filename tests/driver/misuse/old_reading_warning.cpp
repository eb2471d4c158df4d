// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Must not compile: the member has another name.

#include "mb4/mb4.hpp"

const char* misuse(const mb4::Reading& reading) { return reading.warning ? "warning" : ""; }
