// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The whole driver: every call that blocks or plans.

#include "whole.hpp"

// The linker keeps it: what a Device reaches through its pointers counts.
extern "C" BoardDevice firmware_open(BoardBus& bus, BoardClock& clock) {
  return BoardDevice(bus, clock);
}

extern "C" bool firmware(BoardDevice& device, Work& work) { return call_all(device, work); }
