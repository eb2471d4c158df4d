// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A host that runs control communication by the registers of the datasheet, pages 27..29, 32, 34.
#ifndef TESTS_SUPPORT_CONTROL_HOST_HPP_
#define TESTS_SUPPORT_CONTROL_HOST_HPP_

#include <cstdint>
#include <vector>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/chip_fixture.hpp"

namespace mb4test {

constexpr std::uint8_t kAllGood = reg::kResetStatus0 | reg::kRegendDone;

class ControlHost {
 public:
  explicit ControlHost(Chip& chip) : chip_(chip) {}

  void select(std::uint8_t chsel) { chip_.write(reg::kAddrChsel, {chsel}); }
  void set_read(unsigned id, unsigned address, unsigned count) {
    chip_.write(reg::kAddrRegadr,
                {static_cast<std::uint8_t>(address), static_cast<std::uint8_t>(count - 1)});
    chip_.write(reg::kAddrCtrl,
                {static_cast<std::uint8_t>(reg::kCtsRegisterAccess | reg::kRegversBissC |
                                           reg::SLAVEID::of(id))});
  }
  void set_write(unsigned id, unsigned address, const std::vector<std::uint8_t>& bytes) {
    std::vector<std::uint8_t> tx{reg::kSpiOpcodeWriteRegisters, reg::kAddrRdata};
    tx.insert(tx.end(), bytes.begin(), bytes.end());
    chip_.spi(tx);
    chip_.write(reg::kAddrRegadr, {static_cast<std::uint8_t>(reg::kWnrWrite | address),
                                   static_cast<std::uint8_t>(bytes.size() - 1)});
    chip_.write(reg::kAddrCtrl,
                {static_cast<std::uint8_t>(reg::kCtsRegisterAccess | reg::kRegversBissC |
                                           reg::SLAVEID::of(id))});
  }
  // `ids`: bit 7 = ID 0 (Table 32).
  void set_command(std::uint8_t ids, unsigned code, bool ida_test = false) {
    chip_.write(reg::kAddrIds, {ids});
    chip_.write(reg::kAddrCtrl, {static_cast<std::uint8_t>(reg::kRegversBissC | reg::CMD::of(code) |
                                                           (ida_test ? reg::kIdaTestTested : 0))});
  }

  // AGS = 0: one frame for each write of INSTR, until REGEND = 1. Returns the number of frames, 0
  // if `limit` was not enough. Every frame's CDM as MA showed it goes to cdm().
  unsigned run_single(unsigned limit, std::uint8_t instruction = reg::kInstrControl,
                      unsigned line = 1) {
    cdm_.clear();
    const sim::ClockedSlave& near = *clocked(chip_.simulator.slave(line == 1 ? 1 : 5));
    for (unsigned frame = 1; frame <= limit; ++frame) {
      chip_.instruct(instruction);
      if (!chip_.wait_eot(200000)) return 0;
      const std::uint8_t status = chip_.status();
      // Past the slaves' timeout: the level of MA after the frame is the inverted CDM.
      chip_.simulator.run_while_waiting([&] { return near.idle(); },
                                        chip_.simulator.now() + 100 * sim::kPsPerUs);
      cdm_.push_back(
          !clocked(chip_.simulator.line(line))->monitor().last(chip_.simulator.now()).rest_level);
      if ((status & reg::REGEND::kMask) != 0) return frame;
    }
    return 0;
  }
  const std::vector<bool>& cdm() const { return cdm_; }

  // AGS = 1: one write; false if INSTR has not cleared itself after `us`.
  bool run_ags(std::uint64_t us, std::uint8_t instruction = reg::kInstrControl | reg::kAgsOn) {
    chip_.instruct(instruction);
    const sim::Time end = chip_.simulator.now() + us * sim::kPsPerUs;
    while (chip_.simulator.now() < end) {
      if ((chip_.read(reg::kAddrInstr) & reg::INSTR::kMask) == 0) return true;
      chip_.advance_us(20);
    }
    return false;
  }
  std::uint8_t status() { return chip_.status(); }
  unsigned regbytes() { return chip_.read(reg::kAddrStatus3) & reg::REGBYTES::kMask; }
  std::vector<std::uint8_t> rdata(std::size_t count) { return chip_.read(reg::kAddrRdata, count); }

 private:
  Chip& chip_;
  std::vector<bool> cdm_;
};

}  // namespace mb4test

#endif  // TESTS_SUPPORT_CONTROL_HOST_HPP_
