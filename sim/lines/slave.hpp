// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A device at the end of a line, as a user or a test sees it: its words, its frames, its registers
// and its faults. It has no clock and no pins. Each kind of line derives a class that has them.
#ifndef MB4SIM_SLAVE_HPP_
#define MB4SIM_SLAVE_HPP_

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/lines/register_file.hpp"
#include "sim/lines/slave_fault.hpp"

namespace mb4::sim {

class Slave {
 public:
  Slave() = default;
  Slave(const Slave&) = delete;
  Slave& operator=(const Slave&) = delete;
  virtual ~Slave() = default;

  // Length of the process data in bits, without CRC.
  virtual unsigned data_bits() const = 0;
  // Sets the raw word that is latched from now on. Returns false if it does not fit into
  // data_bits() or if the slave has no data of its own (replay).
  virtual bool set_data(std::uint64_t raw) = 0;
  // The raw word of the current or last frame. Nothing if the device does not know it (replay).
  virtual std::optional<std::uint64_t> sent_word() const { return std::nullopt; }
  // Begins or ends a fault, one that DeviceConfig::refuses() says the device can have. A frame that
  // is past the place where a fault acts goes on as it was; kSilent acts at once, with
  // Line::slave_changed().
  virtual void set_fault(const SlaveFault& fault, bool on) {
    if (fault == slave_fault::kSilent) silent_ = on;
    if (fault == slave_fault::kBusy) busy_for_ever_ = on;
    if (fault == slave_fault::kWrongCrc) wrong_crc_ = on;
  }
  bool silent() const { return silent_; }
  // False: the master has told the device to leave its data out of the frames.
  virtual bool sends_data() const { return true; }
  // Number of frames in which the slave has sent a word.
  std::uint64_t frames() const { return frames_; }
  // The raw word that the slave latched for its frame `frame`, from 1 on. Nothing if there was no
  // such frame, if it is not one of the last kKeptFrames, or if the device does not know its words.
  static constexpr std::size_t kKeptFrames = 1024;
  std::optional<std::uint64_t> sent_in(std::uint64_t frame) const {
    if (frame == 0 || frame > frames_ || frames_ - frame >= kKeptFrames) return std::nullopt;
    return kept_[(frame - 1) % kKeptFrames];
  }
  // The slave's own registers; every address is valid. Below 0x40 they are those of bank 0.
  std::uint8_t reg_read(std::uint8_t address) const { return registers_.get(address); }
  void reg_write(std::uint8_t address, std::uint8_t value) { registers_.set(address, value); }
  RegisterFile& registers() { return registers_; }

 protected:
  bool busy_for_ever() const { return busy_for_ever_; }
  bool wrong_crc() const { return wrong_crc_; }
  void count_frame() {
    const std::size_t place = frames_ % kKeptFrames;
    if (place == kept_.size()) kept_.emplace_back();
    kept_[place] = sent_word();
    ++frames_;
  }

 private:
  // Faults: true as long as they last.
  bool silent_ = false;
  bool busy_for_ever_ = false;
  bool wrong_crc_ = false;
  RegisterFile registers_;
  std::uint64_t frames_ = 0;
  std::vector<std::optional<std::uint64_t>> kept_;  // sent_word() of the last frames
};

}  // namespace mb4::sim

#endif  // MB4SIM_SLAVE_HPP_
