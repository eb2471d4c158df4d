// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A host that runs control communication by the registers of the datasheet, pages 27..29, 32, 34.
#ifndef MB4_TESTS_CHIP_CONTROL_HOST_HPP_
#define MB4_TESTS_CHIP_CONTROL_HOST_HPP_

#include <cstdint>
#include <vector>

#include "chip_fixture.hpp"

namespace mb4test {

constexpr std::uint8_t kRegend = 0x04;      // 0xF0
constexpr std::uint8_t kNoRegErr = 0x08;    // nREGERR
constexpr std::uint8_t kNoDelayErr = 0x20;  // nDELAYERR
constexpr std::uint8_t kNoAgsErr = 0x40;
constexpr std::uint8_t kNoScdErr = 0x10;
constexpr std::uint8_t kAllGood = 0xFF;  // 0xF0 after a good control communication (decision 27)
constexpr std::uint8_t kAgsmin = 0x7C;

class ControlHost {
 public:
  explicit ControlHost(Chip& chip) : chip_(chip) {}

  void select(std::uint8_t chsel) { chip_.write(0xE4, {chsel}); }
  void set_read(unsigned id, unsigned address, unsigned count) {
    chip_.write(0xE2, {static_cast<std::uint8_t>(address), static_cast<std::uint8_t>(count - 1)});
    chip_.write(0xE5, {static_cast<std::uint8_t>(0xC0 | id << 3U)});
  }
  void set_write(unsigned id, unsigned address, const std::vector<std::uint8_t>& bytes) {
    std::vector<std::uint8_t> tx{0x02, 0x80};
    tx.insert(tx.end(), bytes.begin(), bytes.end());
    chip_.spi(tx);
    chip_.write(0xE2, {static_cast<std::uint8_t>(0x80 | address),
                       static_cast<std::uint8_t>(bytes.size() - 1)});
    chip_.write(0xE5, {static_cast<std::uint8_t>(0xC0 | id << 3U)});
  }
  // `ids`: bit 7 = ID 0 (Table 32).
  void set_command(std::uint8_t ids, unsigned code, bool ida_test = false) {
    chip_.write(0x80, {ids});
    chip_.write(0xE5, {static_cast<std::uint8_t>(0x40 | code << 4U | (ida_test ? 8U : 0U))});
  }

  // AGS = 0: one frame for each write of INSTR, until REGEND = 1. Number of frames, 0 if `limit`
  // was not enough. Every frame's CDM as MA showed it goes to cdm().
  unsigned run_single(unsigned limit, std::uint8_t instruction = 0x08, unsigned line = 1) {
    cdm_.clear();
    const sim::Slave& near = *chip_.simulator.slave(line == 1 ? 1 : 5);
    for (unsigned frame = 1; frame <= limit; ++frame) {
      chip_.instruct(instruction);
      if (!chip_.wait_eot(200000)) return 0;
      const std::uint8_t status = chip_.status();
      // Past the slaves' timeout: the level of MA after the frame is the inverted CDM.
      chip_.simulator.run_while_waiting([&] { return near.idle(); },
                                        chip_.simulator.now() + 100 * sim::kPsPerUs);
      cdm_.push_back(!chip_.simulator.line(line)->monitor().last(chip_.simulator.now()).rest_level);
      if ((status & kRegend) != 0) return frame;
    }
    return 0;
  }
  const std::vector<bool>& cdm() const { return cdm_; }

  // AGS = 1: one write; false if INSTR has not cleared itself after `us`.
  bool run_ags(std::uint64_t us, std::uint8_t instruction = 0x09) {
    chip_.instruct(instruction);
    const sim::Time end = chip_.simulator.now() + us * sim::kPsPerUs;
    while (chip_.simulator.now() < end) {
      if ((chip_.read(0xF4) & 0x0E) == 0) return true;
      chip_.advance_us(20);
    }
    return false;
  }
  std::uint8_t status() { return chip_.status(); }
  unsigned regbytes() { return chip_.read(0xF3) & 0x3FU; }
  std::vector<std::uint8_t> rdata(std::size_t count) { return chip_.read(0x80, count); }

 private:
  Chip& chip_;
  std::vector<bool> cdm_;
};

}  // namespace mb4test

#endif  // MB4_TESTS_CHIP_CONTROL_HOST_HPP_
