// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Must not compile: the clock has no now_us().

#include "mb4/mb4.hpp"

struct Clock {
  int now();
};

mb4::Device<mb4::FunctionBus, Clock> misuse(mb4::FunctionBus& bus, Clock& clock) {
  return mb4::Device<mb4::FunctionBus, Clock>(bus, clock);
}
