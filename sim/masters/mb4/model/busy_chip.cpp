// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// busy_chip OUTPUT: runs the chip as busy as it can be. The build links this program with a model
// that counts what moves in it (parts/model_parts.py --count) and that prints the counts when the
// program ends. The program also ends well if an assertion stops the chip: then the counts are
// worse, and the tests tell the reason.
//
// All eight slaves are read back to back during a register access, as in workload B of
// `mb4sim bench`.
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "mb4sim/simulator.hpp"
#include "sim/scenario/scenario.hpp"

namespace {

using Frame = std::vector<std::uint8_t>;

constexpr std::uint8_t kWriteRegisters = 0x02;
constexpr std::uint8_t kReadStatus = 0x05;
constexpr std::uint8_t kWriteInstruction = 0x07;
constexpr std::uint8_t kAgs = 0x01;             // INSTR: automatic frames
constexpr std::uint8_t kAgsAndRegister = 0x09;  // INSTR: and one register access

// Data channels of 28 bits and CRC 0x43.
Frame data_channels() {
  Frame frame{kWriteRegisters, 0xC0};
  for (int channel = 0; channel < 8; ++channel) frame.insert(frame.end(), {0x5B, 0x06, 0x00, 0x00});
  return frame;
}

std::string slaves() {
  std::string text;
  for (const char* number : {"1", "2"}) {
    text += std::string("[[channel]]\nnumber = ") + number + '\n';
    for (int slave = 0; slave < 4; ++slave) {
      text += "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\nsource = \"ramp\"\n";
    }
  }
  return text;
}

void run() {
  mb4::sim::Simulator simulator(mb4::sim::parse_scenario(slaves(), "busy_chip"));
  const auto send = [&](const Frame& frame) { simulator.spi().transfer(frame, {}); };
  send(data_channels());
  // BiSS C, MA 10 MHz, one frame as soon as the other has ended (AGSMIN).
  send({kWriteRegisters, 0xE5, 0x40, 0xA0, 0x00, 0x7C});
  send({kWriteRegisters, 0xEC, 0x11, 0x05});
  send({kWriteInstruction, kAgs});
  // 64 registers take 13 ms. The host looks every 0.1 ms whether they are there.
  send({kWriteRegisters, 0xE2, 0x40, 0x3F, 0x01, 0xC0});  // from register 0x40 on, of slave 1
  send({kWriteInstruction, kAgsAndRegister});
  for (int look = 0; look < 150; ++look) {
    simulator.advance(100 * mb4::sim::kPsPerUs);
    send({kReadStatus, 0x00, 0x00, 0x00, 0x00, 0x00});
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2 || std::freopen(arguments[1], "w", stdout) == nullptr) return 2;
  try {
    run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "busy_chip: %s\n", error.what());
  }
}
