// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// position.cpp through a Guarded device; with PLAIN without it (guarded.sh).

#include "enc/guarded.hpp"

#include "board.hpp"

#ifdef PLAIN
struct Shared {
  BoardDevice device;
  BoardDevice* operator->() { return &device; }
};
#else
using Shared = enc::Guarded<BoardDevice>;
#endif

extern "C" bool firmware(Shared& device, std::uint64_t& position) {
  const mb4::Result<mb4::Reading> reading = device->automatic().poll_slave<0>(1);
  if (!reading) {
    return false;
  }
  position = reading->position;
  return true;
}
