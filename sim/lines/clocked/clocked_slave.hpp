// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A device on a clocked line: a Slave with the pins MA, SLI and SLO.
#ifndef MB4SIM_CLOCKED_SLAVE_HPP_
#define MB4SIM_CLOCKED_SLAVE_HPP_

#include <cstddef>
#include <cstdint>

#include "sim/core/time.hpp"
#include "sim/lines/clocked/shift_register.hpp"
#include "sim/lines/slave.hpp"

namespace mb4::sim {

class Actuator;
class ControlSlave;

class ClockedSlave : public Slave {
 public:
  // --- line side, called by SlaveChain -------------------------------------------------------
  // MA changes. The chain calls all its slaves at one time, from the farthest to the nearest one.
  // `sli_before` is SLI before the edge; `sli` is SLI after the slaves behind have changed.
  virtual void ma_edge(Time now, bool ma, bool sli_before, bool sli) = 0;
  // SLI changed without an edge of MA.
  virtual void sli_changed(Time now, bool sli) = 0;
  // Called at deadline(). `sli` is the present level of SLI.
  virtual void timer(Time now, bool sli) = 0;
  // The chain reads the next values at every edge of MA, so they are not virtual.
  // The next time at which the slave wants a call of timer() if nothing happens before; kNever if
  // it wants none.
  Time deadline() const { return deadline_; }
  // Level of pin SLO. In the data of a frame this may still be the level from before the data;
  // SlaveChain::slo() has the present one.
  bool slo() const { return slo_; }
  // True between two frames: the timeout has elapsed.
  bool idle() const { return idle_; }
  // The register that a rising edge of MA shifts in the data of a frame, where nothing else happens
  // before the timeout. Null at other times. The chain may leave out calls of ma_edge() there. It
  // then must call set_shifted() and last_edge() before any other call.
  const ShiftRegister* shifting() const { return shifting_; }
  // While shifting: bits from SLI come in; otherwise zeros come in.
  bool takes_sli() const { return takes_sli_; }
  void set_shifted(ShiftRegister::Bits bits, std::size_t shifts) {
    shifting_->set_shifted(bits, shifts);
    slo_ = shifting_->out();
  }
  // The last edge of MA was at `edge`; `ma` is its level since then.
  virtual void last_edge(Time /*edge*/, bool /*ma*/) {}

  // --- access from outside the line ----------------------------------------------------------
  // Its data and those of the slave behind it come in exchanged order. Here because SlaveChain does
  // it.
  bool swapped_words() const { return swapped_words_; }
  // Number of CDM bits taken so far, and the last of them: the inverted level of MA at the end of
  // the timeout. last_cdm() is false before the first one.
  std::uint64_t cdm_count() const { return cdm_count_; }
  bool last_cdm() const { return last_cdm_; }
  // Control communication with its counters and faults. Null if the device has none.
  virtual ControlSlave* control() { return nullptr; }
  // The words received over MO. Null if the device is not an actuator.
  virtual const Actuator* actuator() const { return nullptr; }

 protected:
  void set_swapped_words(bool on) { swapped_words_ = on; }
  void set_slo(bool level) { slo_ = level; }
  void set_idle(bool idle) { idle_ = idle; }
  // `data`: the register to shift, null if the slave is not shifting.
  void set_shifting(ShiftRegister* data, bool takes_sli) {
    shifting_ = data;
    takes_sli_ = takes_sli;
  }
  void shift(bool sli_before) {
    shifting_->shift(sli_before && takes_sli_);
    slo_ = shifting_->out();
  }
  void set_deadline(Time deadline) { deadline_ = deadline; }
  void take_cdm(bool cdm) {
    last_cdm_ = cdm;
    ++cdm_count_;
  }

 private:
  Time deadline_ = kNever;
  bool slo_ = true;
  bool idle_ = true;
  bool takes_sli_ = false;
  bool swapped_words_ = false;  // a fault, as long as it lasts
  ShiftRegister* shifting_ = nullptr;
  std::uint64_t cdm_count_ = 0;
  bool last_cdm_ = false;
};

// A slave of a clocked line, for a program that knows that it is one.
inline ClockedSlave* clocked(Slave* slave) { return static_cast<ClockedSlave*>(slave); }
inline const ClockedSlave* clocked(const Slave* slave) {
  return static_cast<const ClockedSlave*>(slave);
}

}  // namespace mb4::sim

#endif  // MB4SIM_CLOCKED_SLAVE_HPP_
