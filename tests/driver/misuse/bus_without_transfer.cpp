// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Must not compile: the bus has no transfer().

#include "mb4/mb4.hpp"

struct Bus {
  void send(int byte);
};

mb4::Device<Bus, mb4::FunctionClock> misuse(Bus& bus, mb4::FunctionClock& clock) {
  return mb4::Device<Bus, mb4::FunctionClock>(bus, clock);
}
