// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Must not compile: writing 0xF1 back clears flags that were set in between.

#include "mb4/mb4.hpp"

mb4::Result<void> misuse(mb4::Fields<mb4::FunctionBus>& fields) {
  return fields.modify<mb4::regs::SVALID<1>>(0);
}
