// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What every device on a line offers: the side the line sees (clock and data pins) and the back
// door by which a test sets the world and looks at what arrived.
#ifndef MB4SIM_SLAVE_HPP_
#define MB4SIM_SLAVE_HPP_

#include <cstdint>
#include <optional>

#include "mb4sim/register_file.hpp"
#include "mb4sim/shift_register.hpp"
#include "mb4sim/time.hpp"

namespace mb4::sim {

class Actuator;
class ControlSlave;

// What can be wrong with a slave; true for as long as it lasts. See also SlaveChain::detach() and
// ControlFaults.
struct SlaveFaults {
  bool silent = false;     // SLO is 1 whatever the slave does
  bool busy = false;       // BiSS: the acknowledge does not end
  bool wrong_crc = false;  // the last bit of the CRC behind the data is inverted
};

class Slave {
 public:
  Slave() = default;
  Slave(const Slave&) = delete;
  Slave& operator=(const Slave&) = delete;
  virtual ~Slave() = default;

  // --- line side, called by SlaveChain -------------------------------------------------------
  // A change of MA goes to all slaves of a chain at once, from the far one to the near one.
  // `sli_before`: SLI as it was before the edge; `sli`: as the slaves behind have left it.
  virtual void ma_edge(Time now, bool ma, bool sli_before, bool sli) = 0;
  // SLI changed without an edge of MA.
  virtual void sli_changed(Time now, bool sli) = 0;
  virtual void timer(Time now, bool sli) = 0;
  // The chain asks these at every edge of MA: no virtual calls.
  // Next time the slave wants timer() to be called if nothing happens before; kNever if none.
  Time deadline() const { return deadline_; }
  // Level of pin SLO.
  bool slo() const { return slo_; }
  // True between two frames: the timeout has elapsed.
  bool idle() const { return idle_; }
  // True in the data of a frame, where a rising edge of MA shifts and nothing else happens before
  // the timeout. Instead of ma_edge() the chain then may call shift() at rising edges, and
  // last_edge() before anything else.
  bool shifting() const { return shifting_ != nullptr; }
  void shift(bool sli_before) {
    shifting_->shift(sli_before && takes_sli_);
    slo_ = shifting_->out();
  }
  // The last edge of MA was `edge`, and `ma` is its level since then.
  virtual void last_edge(Time /*edge*/, bool /*ma*/) {}

  // --- back door -----------------------------------------------------------------------------
  // Length of the process data in bits, without CRC.
  virtual unsigned data_bits() const = 0;
  // Raw word that is latched from now on. False if it does not fit into data_bits() or the slave
  // has no data of its own (replay).
  virtual bool set_data(std::uint64_t raw) = 0;
  // The raw word sent in the current or last frame; nothing if the device does not know it
  // (replay).
  virtual std::optional<std::uint64_t> sent_word() const { return std::nullopt; }
  // SlaveChain::refresh() makes a changed `silent` seen; the others count from the next frame on.
  SlaveFaults& faults() { return faults_; }
  const SlaveFaults& faults() const { return faults_; }
  // Frames seen: those in which the slave has sent its start bit.
  std::uint64_t frames() const { return frames_; }
  // CDM bits taken so far, and the last of them: the inverted level of MA at the end of the
  // timeout. False before the first.
  std::uint64_t cdm_count() const { return cdm_count_; }
  bool last_cdm() const { return last_cdm_; }
  // The slave's own registers, every address valid; below 0x40 those of bank 0.
  std::uint8_t reg_read(std::uint8_t address) const { return registers_.get(address); }
  void reg_write(std::uint8_t address, std::uint8_t value) { registers_.set(address, value); }
  RegisterFile& registers() { return registers_; }
  // Control communication: counters, faults. Null if the device has none.
  virtual ControlSlave* control() { return nullptr; }
  // Words received over MO. Null if the device is no actuator.
  virtual const Actuator* actuator() const { return nullptr; }

 protected:
  void set_slo(bool level) { slo_ = level; }
  void set_idle(bool idle) { idle_ = idle; }
  // Null: not shifting. `takes_sli`: else zeros come in.
  void set_shifting(ShiftRegister* data, bool takes_sli) {
    shifting_ = data;
    takes_sli_ = takes_sli;
  }
  void set_deadline(Time deadline) { deadline_ = deadline; }
  void count_frame() { ++frames_; }
  void take_cdm(bool cdm) {
    last_cdm_ = cdm;
    ++cdm_count_;
  }

 private:
  Time deadline_ = kNever;
  bool slo_ = true;
  bool idle_ = true;
  bool takes_sli_ = false;
  ShiftRegister* shifting_ = nullptr;
  SlaveFaults faults_;
  RegisterFile registers_;
  std::uint64_t frames_ = 0;
  std::uint64_t cdm_count_ = 0;
  bool last_cdm_ = false;
};

}  // namespace mb4::sim

#endif  // MB4SIM_SLAVE_HPP_
