// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The sim targets of openmb4.core: mb4_core alone, clocked by hand, reads REVISION and VERSION
// (opcode 0x03, address 0xEA) and the features (0x7F) over SPI.
#include <Vmb4_core.h>
#include <verilated.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>

namespace {

// A clock of CLK; the host's pins stay.
void tick(Vmb4_core& core) {
  core.clk_i = 1;
  core.eval();
  core.clk_i = 0;
  core.eval();
}

std::uint8_t exchange(Vmb4_core& core, std::uint8_t mosi) {
  unsigned miso = 0;
  for (unsigned bit = 8; bit-- > 0;) {
    core.mosi_i = (mosi >> bit) & 1U;
    tick(core);
    miso = (miso << 1U) | core.miso_o;
    core.sclk_i = 1;
    core.eval();
    tick(core);
    core.sclk_i = 0;
    core.eval();
  }
  return static_cast<std::uint8_t>(miso);
}

}  // namespace

int main(int argc, char** argv) {
  VerilatedContext context;
  context.commandArgs(argc, argv);
  const auto core = std::make_unique<Vmb4_core>(&context);
  core->cs_ni = 1;
  core->ner_i = 1;
  core->sl1_i = 1;
  core->sl2_i = 1;
  core->quirks_i = 0;  // as the simulator
  // Asynchronous resets need an edge.
  context.assertOn(false);
  for (const int level : {1, 0}) {
    core->rst_ni = core->por_ni = level;
    for (int i = 0; i < 8; ++i) tick(*core);
  }
  core->rst_ni = core->por_ni = 1;
  for (int i = 0; i < 8; ++i) tick(*core);
  context.assertOn(true);
  const auto read = [&](std::uint8_t address, std::array<unsigned, 2>& bytes) {
    core->cs_ni = 0;
    core->eval();
    exchange(*core, 0x03);
    exchange(*core, address);
    for (unsigned& byte : bytes) byte = exchange(*core, 0);
    core->cs_ni = 1;
    core->eval();
  };
  std::array<unsigned, 2> bytes{};
  read(0x7F, bytes);
  const unsigned features = bytes[0];
  read(0xEA, bytes);
  const auto [revision, version] = bytes;
  std::printf("revision 0x%02X, version 0x%02X, features 0x%02X\n", revision, version, features);
  core->final();
  return revision == 0x20 && version == 0x84 ? 0 : 1;
}
