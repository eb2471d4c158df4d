// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults of control communication in one slave. A faulty bit is inverted once. Slots count from the
// start bit S that really was on the line (slot 0), so a fault can hit S itself. control_slots.hpp
// lists the slots.
#ifndef MB4SIM_CONTROL_FAULTS_HPP_
#define MB4SIM_CONTROL_FAULTS_HPP_

#include <cstdint>
#include <optional>

#include "sim/lines/registers/control_slots.hpp"

namespace mb4::sim {

class ControlFaults {
 public:
  // The slave takes the CDM of the n-th frame from now inverted. 1 = the running or next frame.
  void flip_cdm_of_frame(unsigned n) { flip_frame_ = n; }
  // The slave takes the CDM of this slot of the next control frame inverted.
  void flip_cdm_in_slot(unsigned slot) {
    flip_cdm_slot_ = slot;
    watch();
  }
  // The slave sends the CDS of this slot (1 or more) of the next control frame inverted. This CDS
  // is its own bit combined with those of the slaves behind it.
  void flip_cds_in_slot(unsigned slot) {
    flip_cds_slot_ = slot;
    watch();
  }
  // The slave locks its IDs but neither confirms nor answers any access or command.
  void set_silent(bool silent) { silent_ = silent; }
  bool silent() const { return silent_; }
  // The CRC of data read is wrong by one bit.
  void set_wrong_data_crc(bool wrong) { wrong_data_crc_ = wrong; }
  bool wrong_data_crc() const { return wrong_data_crc_; }
  // The slave answers accesses and commands to the ID that follows each of its own IDs, and not
  // those to its own IDs.
  void set_wrong_id(bool wrong) { wrong_id_ = wrong; }
  bool wrong_id() const { return wrong_id_; }
  // False when every slot fault has happened.
  bool pending() const { return flip_frame_ != 0 || flip_cdm_slot_ || flip_cds_slot_; }

  // --- slave's side --------------------------------------------------------------------------
  // Returns the level of CDM that the slave takes instead of `cdm`.
  bool take_cdm(bool cdm);
  // True if the CDS bit that is sent now must be inverted.
  bool flip_cds();

 private:
  // The next start bit begins a new count of slots.
  void watch() { slot_.reset(); }

  unsigned flip_frame_ = 0;
  std::optional<unsigned> flip_cdm_slot_;
  std::optional<unsigned> flip_cds_slot_;
  std::optional<unsigned> slot_;  // of the last CDM
  unsigned zeros_ = 0;            // number of CDM = 0 in a row on the line
  bool silent_ = false;
  bool wrong_data_crc_ = false;
  bool wrong_id_ = false;
};

inline bool ControlFaults::take_cdm(bool cdm) {
  const bool start = cdm && zeros_ >= control_slot::kZerosBeforeStart;
  zeros_ = cdm ? 0 : zeros_ + (zeros_ < control_slot::kZerosBeforeStart ? 1 : 0);
  if (!pending()) return cdm;
  if (slot_) {
    ++*slot_;
  } else if (start) {
    slot_ = 0;
  }
  bool flip = false;
  if (flip_frame_ != 0 && --flip_frame_ == 0) flip = true;
  if (slot_ && flip_cdm_slot_ == slot_) {
    flip = true;
    flip_cdm_slot_.reset();
  }
  return cdm != flip;
}

inline bool ControlFaults::flip_cds() {
  if (!slot_ || !flip_cds_slot_ || *flip_cds_slot_ != *slot_ + 1) return false;
  flip_cds_slot_.reset();
  return true;
}

}  // namespace mb4::sim

#endif  // MB4SIM_CONTROL_FAULTS_HPP_
