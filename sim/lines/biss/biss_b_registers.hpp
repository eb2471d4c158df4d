// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Register mode of a BiSS B slave.
//
// A bit cell of MA begins with its rising edge. MA is high for 25 % of a 0 and for 75 % of a 1.
//
//   address part  start bit 1, ID, address, WNR, inverted CRC, stop bit 0
//   write         for each byte start bit 1, data, inverted CRC, stop bit 0. The slave sends these
//                 bits back one cell later.
//   read          MA only clocks. The slave sends 0 while it is busy, then the same fields.
//
// Addresses count up. The slave is strict, as ControlSlave is: after a mistake of the master it is
// silent until register mode ends.
//
// Source: iC-MB4 Rev D2, pages 13, 16, 30; docs/choices.md for figures that these pages leave open.
#ifndef MB4SIM_BISS_B_REGISTERS_HPP_
#define MB4SIM_BISS_B_REGISTERS_HPP_

#include <cstdint>

#include "sim/core/time.hpp"
#include "sim/lines/register_file.hpp"
#include "sim/lines/registers/busy_time.hpp"
#include "sim/lines/registers/control_slave.hpp"

namespace mb4::sim {

// Configuration of the register mode. The slave never answers an access to a missing register.
struct BissBRegisterConfig : RegisterFile::Layout {
  bool present = true;  // false: the device has no registers and answers nothing
  unsigned ids = 1;     // 1 to 8 slave IDs in a row
  // First ID of the slave in a point-to-point connection: the number of IDs behind the slave, 0 for
  // the last slave. With MO the chip itself is ID 0, so the IDs of all slaves are one higher.
  unsigned first_id = 0;
  BusyTime read_busy;   // before the start bit of each byte read, in periods of the register clock
  BusyTime store_busy;  // after each byte written; an earlier write is not answered
};

class BissBRegisters {
 public:
  BissBRegisters(const BissBRegisterConfig& config, RegisterFile& registers)
      : config_(config), registers_(registers) {}

  // Register mode begins. `by_mo`: MO has selected it, else the timeout.
  void begin(bool by_mo);
  void ma_edge(Time now, bool ma);
  // The timeout has ended register mode.
  void end();

  // Level that the slave itself puts on the line.
  bool out() const { return out_; }
  // Number of rising edges of MA since begin().
  std::uint64_t cells() const { return cells_; }
  const ControlCounters& counters() const { return counters_; }
  // `wrong`: the last CRC bit of data read is inverted. `silent`: the slave does not answer at all.
  void set_wrong_data_crc(bool wrong) { wrong_data_crc_ = wrong; }
  void set_silent(bool silent) { silent_ = silent; }

 private:
  enum class State {
    kOff,  // not addressed, or no longer part of the access
    kStart,
    kHeader,
    kHeaderStop,
    kReadBusy,
    kReadData,
    kReadStop,
    kWriteStart,
    kWriteData,
    kWriteStop,
  };

  void rising(Time now);
  void take(Time now, bool bit);
  void header_done();
  void read_clock(Time now);
  void answer_when_ready(Time now);
  void write_bit(Time now, bool bit);
  void break_off();
  bool expects_pwm() const {
    return state_ != State::kOff && state_ != State::kReadBusy && state_ != State::kReadData &&
           state_ != State::kReadStop;
  }

  const BissBRegisterConfig& config_;
  RegisterFile& registers_;
  ControlCounters counters_;
  State state_ = State::kOff;
  bool by_mo_ = false;
  bool out_ = false;
  bool wrong_data_crc_ = false;
  bool silent_ = false;
  std::uint64_t cells_ = 0;
  Time rise_ = 0;
  Time fall_ = 0;
  unsigned bits_ = 0;
  unsigned count_ = 0;
  unsigned block_ = 0;  // first register of the addressed ID
  unsigned address_ = 0;
  bool writing_ = false;
  unsigned answer_ = 0;
  BusyTimer read_busy_;
  BusyTimer store_busy_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_BISS_B_REGISTERS_HPP_
