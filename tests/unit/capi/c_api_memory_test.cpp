// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The C interface when memory runs out. A program of its own: it replaces the allocation functions,
// which sanitizers need for themselves.
#include <gtest/gtest.h>

#include <cstdlib>
#include <initializer_list>
#include <new>

#include "mb4_regs.hpp"
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

namespace reg = mb4::regs;

// On this long cable more edges are on their way than the event queue keeps without new memory.
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
  send({reg::kSpiOpcodeWriteRegisters, reg::slave_cfg_address(1), reg::kEnscdYes | 27,
        reg::kScrclenCrc6, 0, 0});
  send({reg::kSpiOpcodeWriteRegisters, reg::kAddrCtrl, reg::kRegversBissC, reg::FREQR::of(5), 0,
        reg::kFreqagsAgsMin});
  send({reg::kSpiOpcodeWriteRegisters, reg::kAddrCfgch, reg::kCfgch1BissC | reg::kCfgch2Unused});
  memory_is_out = true;
  int status = send({reg::kSpiOpcodeWriteInstruction, reg::kInstrCdm0});
  for (int i = 0; i < 100 && status == 0; ++i) status = send({reg::kSpiOpcodeReadStatus, 0});
  memory_is_out = false;
  EXPECT_EQ(status, MB4SIM_ERROR_FAILED);
  const uint64_t stopped = mb4sim_time_ns(sim);
  mb4sim_advance_ns(sim, 1000);
  EXPECT_EQ(mb4sim_time_ns(sim), stopped);
  EXPECT_EQ(send({reg::kSpiOpcodeReadStatus, 0}), MB4SIM_ERROR_FAILED);
  EXPECT_EQ(mb4sim_pin_write(sim, "GETSENS", 1), MB4SIM_ERROR_FAILED);
  EXPECT_EQ(mb4sim_spi_byte(sim, reg::kSpiOpcodeReadStatus), 0);
  mb4sim_close(sim);
}

}  // namespace
