// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Register mode of a BiSS B slave (iC-MB4 Rev D2, pages 13, 16, 30; docs/choices.md for what its
// missing figures leave open). A bit cell of MA begins with its rising edge: high for 25 % of it is
// 0, for 75 % is 1. The address part: start bit 1, ID, address, WNR, inverted CRC, stop bit 0. A
// write goes on with start bit 1, data, inverted CRC, stop bit 0 for each byte, which the slave
// sends back one cell later. For a read MA only clocks: the slave sends 0 while it is busy, then
// the same fields. Addresses count up. Strict, as ControlSlave is: after a mistake of the master
// the slave is silent until register mode ends.
#ifndef MB4SIM_BISS_B_REGISTERS_HPP_
#define MB4SIM_BISS_B_REGISTERS_HPP_

#include <cstdint>

#include "mb4sim/busy_time.hpp"
#include "mb4sim/control_slave.hpp"
#include "mb4sim/register_file.hpp"
#include "mb4sim/time.hpp"

namespace mb4::sim {

// A missing register is never answered.
struct BissBRegisterConfig : RegisterFile::Layout {
  bool present = true;  // false: the device has no registers and answers nothing
  unsigned ids = 1;     // 1 to 8 slave IDs in a row
  // First ID in a point-to-point connection: number of IDs behind the slave, which is 0 for the
  // last one. With MO the chip itself is ID 0 and all slaves come one later.
  unsigned first_id = 0;
  BusyTime read_busy;   // before the start bit of each byte read, in periods of the register clock
  BusyTime store_busy;  // after each byte written; a write that comes too early is not answered
};

class BissBRegisters {
 public:
  BissBRegisters(const BissBRegisterConfig& config, RegisterFile& registers)
      : config_(config), registers_(registers) {}

  // Register mode begins, selected by MO or by the timeout.
  void begin(bool by_mo);
  void ma_edge(Time now, bool ma);
  // The timeout has ended it.
  void end();

  // What the slave itself puts on the line.
  bool out() const { return out_; }
  // Rising edges of MA since begin().
  std::uint64_t cells() const { return cells_; }
  const ControlCounters& counters() const { return counters_; }
  // One bit less in the CRC of data read: wrong. Makes no answer at all if silent.
  void set_wrong_data_crc(bool wrong) { wrong_data_crc_ = wrong; }
  void set_silent(bool silent) { silent_ = silent; }

 private:
  enum class State {
    kOff,  // not addressed, or no longer taking part
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
