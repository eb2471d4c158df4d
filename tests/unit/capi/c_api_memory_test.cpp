// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The C interface when memory runs out. A program of its own: it replaces the allocation functions,
// which sanitizers need for themselves.
#include <gtest/gtest.h>

#include <cstdlib>
#include <initializer_list>
#include <new>

#include "mb4sim.h"

// The library allocates through these, so that a test can let it run out of memory.
namespace {
bool memory_is_out = false;
}  // namespace

void* operator new(std::size_t size) {
  void* const memory = memory_is_out ? nullptr : std::malloc(size != 0 ? size : 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }

namespace {

// A cable so long that more edges are on their way than the event queue keeps without memory.
constexpr const char* kScenario = R"(
[[channel]]
number = 1
delay_ns = 20000.0
[[channel.slave]]
protocol = "biss-c"
preset = "resolute-26"
)";

TEST(CApiMemory, OutOfMemory_IsAnErrorAndStaysOne) {
  char error[200];
  mb4sim* const sim = mb4sim_open(kScenario, error, sizeof error);
  ASSERT_NE(sim, nullptr) << error;
  const auto send = [&](std::initializer_list<uint8_t> bytes) {
    return mb4sim_spi_transfer(sim, bytes.begin(), nullptr, bytes.size());
  };
  send({0x02, 0xC0, 0x5B, 0x06, 0, 0});
  send({0x02, 0xE5, 0x40, 0xA0, 0x00, 0x7C});
  send({0x02, 0xED, 0x0D});
  memory_is_out = true;
  int status = send({0x07, 0x04});
  for (int i = 0; i < 100 && status == 0; ++i) status = send({0x05, 0x00});
  memory_is_out = false;
  EXPECT_EQ(status, MB4SIM_ERROR_FAILED);
  const uint64_t stopped = mb4sim_time_ns(sim);
  mb4sim_advance_ns(sim, 1000);
  EXPECT_EQ(mb4sim_time_ns(sim), stopped);
  EXPECT_EQ(send({0x05, 0x00}), -5);
  EXPECT_EQ(mb4sim_pin_write(sim, "GETSENS", 1), -5);
  EXPECT_EQ(mb4sim_spi_byte(sim, 0x05), 0);
  mb4sim_close(sim);
}

}  // namespace
