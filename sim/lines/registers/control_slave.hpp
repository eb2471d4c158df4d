// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The slave's side of BiSS C control communication: one CDM bit in and one CDS bit out per frame.
// step() takes the CDM at the end of a frame and prepares the CDS of the next frame. cds() returns
// this CDS. The slave is strict on purpose: a master that breaks the protocol gets no further
// answer in that control frame, and a counter shows the mistake.
//
// Source: iC-MB4 Rev D2, pages 27 to 29.
#ifndef MB4SIM_CONTROL_SLAVE_HPP_
#define MB4SIM_CONTROL_SLAVE_HPP_

#include <cstdint>

#include "sim/core/time.hpp"
#include "sim/lines/register_file.hpp"
#include "sim/lines/registers/busy_time.hpp"
#include "sim/lines/registers/control_faults.hpp"

namespace mb4::sim {

struct ControlConfig : RegisterFile::Layout {
  bool present = true;  // false: unidirectional device, adds nothing to CDS
  unsigned ids = 1;     // 1 to 8 slave IDs that the device locks
  BusyTime read_busy;   // before the data of each read
  BusyTime write_busy;  // before the data of each write
  BusyTime store_busy;  // after each write: the next access waits for it
};

// Counts of what has arrived, for tests.
struct ControlCounters {
  std::uint64_t starts = 0;           // start bits after 14 zeros
  std::uint64_t reads = 0;            // registers read, last CRC bit sent
  std::uint64_t writes = 0;           // registers written (also protected ones)
  std::uint64_t commands = 0;         // commands executed
  std::uint64_t aborts = 0;           // control frames ended by 14 zeros before their end
  std::uint64_t header_errors = 0;    // header CRC wrong
  std::uint64_t data_errors = 0;      // CRC of written data wrong: the register keeps its value
  std::uint64_t protocol_errors = 0;  // a bit that must be 0 or 1 had the other level
};

// An executed BiSS command.
struct ControlCommand {
  std::uint8_t ids = 0;   // bit 7 = ID 0, as register 0x80 of the chip; 0 = broadcast
  std::uint8_t code = 0;  // 0 to 3
};

class ControlSlave {
 public:
  ControlSlave(const ControlConfig& config, RegisterFile& registers)
      : config_(config), registers_(registers) {}

  // The device's CDS bit of this frame. The caller ORs it with the bit from the slave behind.
  bool cds() const;
  // The CDS bit ends. Called once a frame; `sli` is the bit from the slave behind.
  void end_cds(bool sli);
  // A frame ends. `cdm` is the CDM bit that it carried.
  void step(Time now, bool cdm);

  // Effects of commands. Both are active after power-on.
  bool data_active() const { return data_active_; }
  bool control_active() const { return control_active_; }
  // State of the bus coupler. It is recorded and has no effect.
  bool coupler_on_line() const { return coupler_on_line_; }

  // The IDs that are locked in the running or last control frame: bit k = ID k.
  unsigned ids() const { return ids_; }
  const ControlCounters& counters() const { return counters_; }
  const ControlCommand& last_command() const { return command_; }
  ControlFaults& faults() { return faults_; }

 private:
  enum class State {
    kIdle,    // outside a control frame, or no longer part of it
    kHeader,  // up to the last CRC bit
    kRead,
    kWrite,
    kStart,  // S of the first byte
    kBusy,   // S seen, the slave's own S not yet sent
    kData,
    kStop,
    kNext,  // S of the next byte or the end
    kCommand,
  };
  enum class Cds : std::uint8_t { kZero, kOne, kLock };

  void advance(Time now, bool cdm, unsigned zeros_before);
  void start();
  void header_bit(bool cdm);
  void header_done();
  void begin_access(Time now, bool cdm);
  void answer_when_ready(Time now);
  void data_bit(Time now, bool cdm);
  void command_slot(bool cdm);
  void execute();
  void break_off();
  unsigned answered_ids() const;
  bool may_lock() const { return locked_ < config_.ids && control_active_; }
  // True between the header of a command and EX, where zeros do not count.
  bool before_ex() const { return state_ == State::kCommand && ex_slot_ == 0; }
  static Cds bit(bool level) { return level ? Cds::kOne : Cds::kZero; }

  const ControlConfig& config_;
  RegisterFile& registers_;
  ControlFaults faults_;
  ControlCounters counters_;
  State state_ = State::kIdle;
  Cds cds_ = Cds::kZero;
  unsigned zeros_ = 0;
  unsigned slot_ = 0;  // of the last CDM
  unsigned bits_ = 0;  // received bits of header or data, CRC in the lowest four
  unsigned ids_ = 0;
  unsigned locked_ = 0;   // number of IDs in ids_
  unsigned block_ = 0;    // first register of the addressed ID
  unsigned address_ = 0;  // 0 to 127
  bool reading_ = false;
  unsigned count_ = 0;    // bits of kData done
  unsigned answer_ = 0;   // data and CRC of a read
  unsigned ex_slot_ = 0;  // slot in which EX has come; 0: not yet
  ControlCommand pending_;
  ControlCommand command_;
  BusyTimer access_busy_;
  BusyTimer store_busy_;
  bool data_active_ = true;
  bool control_active_ = true;
  bool coupler_on_line_ = false;
};

}  // namespace mb4::sim

#endif  // MB4SIM_CONTROL_SLAVE_HPP_
