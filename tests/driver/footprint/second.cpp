// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The whole driver on two types of bus. footprint.py counts what is there for OtherBus alone,
// without call_all(), which is the program's.

#include "whole.hpp"

struct OtherBus {
  bool transfer(mb4::Span<const std::uint8_t> tx, mb4::Span<std::uint8_t> rx) {
    return board_transfer(tx.data(), rx.data(), tx.size());
  }
};
using OtherDevice = mb4::Device<OtherBus, BoardClock>;

struct Opened {
  OtherBus bus;
  BoardClock clock;
  OtherDevice device{bus, clock};
};

// The linker keeps it: what a Device reaches through its pointers counts.
extern "C" BoardDevice firmware_open(BoardBus& bus, BoardClock& clock) {
  return BoardDevice(bus, clock);
}

extern "C" bool firmware(BoardDevice& device, Opened& other, Work& work) {
  return call_all(device, work) && call_all(other.device, work);
}
extern "C" Opened firmware_other() { return Opened(); }
