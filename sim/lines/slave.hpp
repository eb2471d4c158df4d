// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The interface of every device on a line. It has two sides: the line side (clock and data pins),
// and an access from outside the line, by which a test sets values and looks at what has arrived.
#ifndef MB4SIM_SLAVE_HPP_
#define MB4SIM_SLAVE_HPP_

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/core/time.hpp"
#include "sim/lines/registers/register_file.hpp"
#include "sim/lines/shift_register.hpp"
#include "sim/lines/slave_fault.hpp"

namespace mb4::sim {

class Actuator;
class ControlSlave;

class Slave {
 public:
  Slave() = default;
  Slave(const Slave&) = delete;
  Slave& operator=(const Slave&) = delete;
  virtual ~Slave() = default;

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
  // Length of the process data in bits, without CRC.
  virtual unsigned data_bits() const = 0;
  // Sets the raw word that is latched from now on. Returns false if it does not fit into
  // data_bits() or if the slave has no data of its own (replay).
  virtual bool set_data(std::uint64_t raw) = 0;
  // The raw word of the current or last frame. Nothing if the device does not know it (replay).
  virtual std::optional<std::uint64_t> sent_word() const { return std::nullopt; }
  // Begins or ends a fault, one that DeviceConfig::refuses() says the device can have. A frame that
  // is past the place where a fault acts goes on as it was; kSilent acts at once, with
  // SlaveChain::refresh().
  virtual void set_fault(const SlaveFault& fault, bool on) {
    if (fault == slave_fault::kSilent) silent_ = on;
    if (fault == slave_fault::kBusy) busy_for_ever_ = on;
    if (fault == slave_fault::kWrongCrc) wrong_crc_ = on;
  }
  bool silent() const { return silent_; }
  // Its data and those of the slave behind it come in exchanged order. Here because SlaveChain does
  // it.
  bool swapped_words() const { return swapped_words_; }
  // Number of frames in which the slave has sent its start bit.
  std::uint64_t frames() const { return frames_; }
  // The raw word that the slave latched for its frame `frame`, from 1 on. Nothing if there was no
  // such frame, if it is not one of the last kKeptFrames, or if the device does not know its words.
  static constexpr std::size_t kKeptFrames = 1024;
  std::optional<std::uint64_t> sent_in(std::uint64_t frame) const {
    if (frame == 0 || frame > frames_ || frames_ - frame >= kKeptFrames) return std::nullopt;
    return kept_[(frame - 1) % kKeptFrames];
  }
  // Number of CDM bits taken so far, and the last of them: the inverted level of MA at the end of
  // the timeout. last_cdm() is false before the first one.
  std::uint64_t cdm_count() const { return cdm_count_; }
  bool last_cdm() const { return last_cdm_; }
  // The slave's own registers; every address is valid. Below 0x40 they are those of bank 0.
  std::uint8_t reg_read(std::uint8_t address) const { return registers_.get(address); }
  void reg_write(std::uint8_t address, std::uint8_t value) { registers_.set(address, value); }
  RegisterFile& registers() { return registers_; }
  // Control communication with its counters and faults. Null if the device has none.
  virtual ControlSlave* control() { return nullptr; }
  // The words received over MO. Null if the device is not an actuator.
  virtual const Actuator* actuator() const { return nullptr; }

 protected:
  bool busy_for_ever() const { return busy_for_ever_; }
  bool wrong_crc() const { return wrong_crc_; }
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
  void count_frame() {
    const std::size_t place = frames_ % kKeptFrames;
    if (place == kept_.size()) kept_.emplace_back();
    kept_[place] = sent_word();
    ++frames_;
  }
  void take_cdm(bool cdm) {
    last_cdm_ = cdm;
    ++cdm_count_;
  }

 private:
  Time deadline_ = kNever;
  bool slo_ = true;
  bool idle_ = true;
  bool takes_sli_ = false;
  // Faults: true as long as they last.
  bool silent_ = false;
  bool busy_for_ever_ = false;
  bool wrong_crc_ = false;
  bool swapped_words_ = false;
  ShiftRegister* shifting_ = nullptr;
  RegisterFile registers_;
  std::uint64_t frames_ = 0;
  std::vector<std::optional<std::uint64_t>> kept_;  // sent_word() of the last frames
  std::uint64_t cdm_count_ = 0;
  bool last_cdm_ = false;
};

}  // namespace mb4::sim

#endif  // MB4SIM_SLAVE_HPP_
