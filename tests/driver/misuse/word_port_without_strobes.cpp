// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Must not compile: the port cannot write single bytes.

#include <cstdint>

#include "mb4/words/memory_bus.hpp"

struct Port {
  bool read(std::uint32_t offset, std::uint32_t& value);
  bool write(std::uint32_t offset, std::uint32_t value);
};

mb4::MemoryBus<Port> misuse(Port& port) { return mb4::MemoryBus<Port>(port); }
