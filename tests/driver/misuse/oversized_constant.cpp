// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Must not compile: FREQS has five bits.

#include "mb4/mb4.hpp"

mb4::Result<void> misuse(mb4::Fields<mb4::FunctionBus>& fields) {
  return fields.modify<mb4::regs::FREQS, 0x20>();
}
