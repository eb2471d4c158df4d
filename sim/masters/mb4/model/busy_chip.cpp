// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// busy_chip KIND OUTPUT: runs the chip as busy as a kind of chip_edges.hpp can be. The build links
// this program with a model that counts what moves in it (parts/model_parts.py --count) and that
// prints the counts when the program ends. The program also ends well if an assertion stops the
// chip: then the counts are worse, and the tests tell the reason.
//
//   one_line    a slave, frames back to back, MA 10 MHz: workload A of `mb4sim bench`
//   both_lines  eight slaves on both lines, frames back to back, a register access: B
//   slow_ma     one_line with MA 1 MHz: K
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
Frame data_channels(int count) {
  Frame frame{kWriteRegisters, 0xC0};
  for (int channel = 0; channel < count; ++channel) {
    frame.insert(frame.end(), {0x5B, 0x06, 0x00, 0x00});
  }
  return frame;
}

std::string channel(char number, int slaves) {
  std::string text = std::string("[[channel]]\nnumber = ") + number + '\n';
  for (int slave = 0; slave < slaves; ++slave) {
    text += "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\nsource = \"ramp\"\n";
  }
  return text;
}

void run(const std::string& kind) {
  const bool both = kind == "both_lines";
  mb4::sim::Simulator simulator(mb4::sim::parse_scenario(
      both ? channel('1', 4) + channel('2', 4) : channel('1', 1), "busy_chip"));
  const auto send = [&](const Frame& frame) { simulator.spi().transfer(frame, {}); };
  send(data_channels(both ? 8 : 1));
  // BiSS C, one frame as soon as the other has ended (AGSMIN). FREQS: f_CLK / 2 or / 20.
  const std::uint8_t freqs = kind == "slow_ma" ? 0x09 : 0x00;
  send({kWriteRegisters, 0xE5, 0x40, static_cast<std::uint8_t>(0xA0 | freqs), 0x00, 0x7C});
  // Slaves from 5 on are on channel 2, which is BiSS C too; or it is not used.
  send(both ? Frame{kWriteRegisters, 0xEC, 0x11, 0x05} : Frame{kWriteRegisters, 0xEC, 0x01, 0x0D});
  send({kWriteInstruction, kAgs});
  // 64 registers take 13 ms. The host looks every 0.1 ms whether they are there.
  if (both) {
    send({kWriteRegisters, 0xE2, 0x40, 0x3F, 0x01, 0xC0});  // from register 0x40 on, of slave 1
    send({kWriteInstruction, kAgsAndRegister});
  }
  for (int look = 0; look < 150; ++look) {
    simulator.advance(100 * mb4::sim::kPsPerUs);
    if (both) send({kReadStatus, 0x00, 0x00, 0x00, 0x00, 0x00});
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3 || std::freopen(arguments[2], "w", stdout) == nullptr) return 2;
  try {
    run(arguments[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "busy_chip: %s\n", error.what());
  }
}
