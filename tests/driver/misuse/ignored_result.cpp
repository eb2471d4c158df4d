// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Must not compile with warnings as errors: an unread result hides a failure.

#include "mb4/mb4.hpp"

void misuse(mb4::Device<mb4::FunctionBus, mb4::FunctionClock>& device) {
  device.break_transmission();
}
