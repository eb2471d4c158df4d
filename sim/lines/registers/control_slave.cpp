// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/registers/control_slave.hpp"

#include "sim/lines/crc.hpp"
#include "sim/lines/registers/control_slots.hpp"

namespace mb4::sim {
namespace {

namespace slot = control_slot;

constexpr Crc kControlCrc{0x13, 0};
constexpr unsigned kCrcBits = 4;
constexpr unsigned kHeaderBits = slot::kHeaderEnd - slot::kCts + 1;
constexpr unsigned kDataBits = slot::kAccessBits - kCrcBits;

// Returns true if the lowest four bits are the inverted CRC of the bits above them.
bool crc_fits(unsigned bits, unsigned data_bits) {
  return kControlCrc.line_bits(bits >> kCrcBits, data_bits) == (bits & 0xFU);
}

}  // namespace

// A slave that has an ID to lock always sends 1: its own 1, or that of a slave behind it.
bool ControlSlave::cds() const { return cds_ == Cds::kOne || (cds_ == Cds::kLock && may_lock()); }

void ControlSlave::end_cds(bool sli) {
  // The slave takes the first free ID: slaves behind it have sent 1 in the slots of their IDs.
  if (cds_ != Cds::kLock || sli || !may_lock()) return;
  ids_ |= 1U << slot_;  // slot 1 + k carries ID k; slot_ is the slot of the frame before
  ++locked_;
}

void ControlSlave::step(Time now, bool cdm) {
  cdm = faults_.take_cdm(cdm);
  const unsigned zeros_before = zeros_;
  if (cdm) {
    zeros_ = 0;
  } else if (!before_ex() && zeros_ < slot::kZerosBeforeStart) {
    ++zeros_;
  }
  access_busy_.frame();
  store_busy_.frame();
  ++slot_;
  cds_ = Cds::kZero;
  if (zeros_ == slot::kZerosBeforeStart && state_ != State::kIdle) {
    if (state_ != State::kNext && state_ != State::kCommand) ++counters_.aborts;
    state_ = State::kIdle;
    return;
  }
  advance(now, cdm, zeros_before);
}

void ControlSlave::advance(Time now, bool cdm, unsigned zeros_before) {
  switch (state_) {
    case State::kIdle:
      if (cdm && zeros_before >= slot::kZerosBeforeStart) start();
      break;
    case State::kHeader:
      header_bit(cdm);
      break;
    case State::kRead:
      reading_ = cdm;
      cds_ = bit(cdm);
      state_ = State::kWrite;
      break;
    case State::kWrite:
      cds_ = bit(cdm);
      if (cdm == reading_) {
        break_off();
      } else {
        state_ = State::kStart;
      }
      break;
    case State::kStart:
      begin_access(now, cdm);
      break;
    case State::kBusy:
      // The master must repeat S until it sees the S of the slave.
      if (cdm) {
        answer_when_ready(now);
      } else {
        break_off();
      }
      break;
    case State::kData:
      data_bit(now, cdm);
      break;
    case State::kStop:
      if (cdm) {
        break_off();
      } else {
        state_ = State::kNext;
      }
      break;
    case State::kNext:
      if (cdm) {
        address_ = (address_ + 1) % RegisterFile::kPerId;
        begin_access(now, cdm);
      } else {
        state_ = State::kIdle;
      }
      break;
    case State::kCommand:
      command_slot(cdm);
      break;
  }
}

void ControlSlave::break_off() {
  ++counters_.protocol_errors;
  state_ = State::kIdle;
}

void ControlSlave::start() {
  ++counters_.starts;
  slot_ = slot::kStart;
  bits_ = 0;
  ids_ = 0;
  locked_ = 0;
  cds_ = Cds::kLock;
  state_ = State::kHeader;
}

void ControlSlave::header_bit(bool cdm) {
  bits_ = bits_ << 1U | (cdm ? 1U : 0U);
  if (slot_ + 1 < slot::kIdl + slot::kIds) cds_ = Cds::kLock;
  if (slot_ == slot::kCrcEnd) header_done();
}

void ControlSlave::header_done() {
  state_ = State::kIdle;
  if (!crc_fits(bits_, kHeaderBits)) {
    ++counters_.header_errors;
    return;
  }
  const unsigned header = bits_ >> kCrcBits;
  if ((header >> (kHeaderBits - 1)) == 0) {
    // All slaves follow a command, so that no slave takes a late EX for a start bit.
    pending_.ids = static_cast<std::uint8_t>(header >> 2U);
    pending_.code = static_cast<std::uint8_t>(header & 3U);
    ex_slot_ = 0;
    state_ = State::kCommand;
    return;
  }
  const unsigned id = (header >> 7U) & 7U;
  const unsigned own = answered_ids();
  if (((own >> id) & 1U) == 0 || faults_.silent()) return;
  // The slave's own IDs are in a row. The first one has the first 128 registers, and so on.
  unsigned block = 0;
  for (unsigned k = 0; k < id; ++k) block += (own >> k) & 1U;
  block_ = block * RegisterFile::kPerId;
  address_ = header & 0x7FU;
  state_ = State::kRead;
}

unsigned ControlSlave::answered_ids() const {
  return faults_.wrong_id() ? (ids_ << 1U) & ((1U << slot::kIds) - 1U) : ids_;
}

void ControlSlave::begin_access(Time now, bool cdm) {
  if (!cdm) {
    break_off();
    return;
  }
  access_busy_.start(now, reading_ ? config_.read_busy : config_.write_busy);
  state_ = State::kBusy;
  answer_when_ready(now);
}

void ControlSlave::answer_when_ready(Time now) {
  const unsigned address = block_ + address_;
  if (!registers_.exists(address) || !access_busy_.over(now) || !store_busy_.over(now)) return;
  if (reading_) {
    const unsigned value = registers_.read(address);
    answer_ = value << kCrcBits | kControlCrc.line_bits(value, kDataBits);
    if (faults_.wrong_data_crc()) answer_ ^= 1U;
  }
  bits_ = 0;
  count_ = 0;
  cds_ = Cds::kOne;
  state_ = State::kData;
}

void ControlSlave::data_bit(Time now, bool cdm) {
  ++count_;
  if (reading_) {
    if (cdm) {
      break_off();
      return;
    }
    cds_ = bit(((answer_ >> (slot::kAccessBits - count_)) & 1U) != 0);
  } else {
    bits_ = bits_ << 1U | (cdm ? 1U : 0U);
    cds_ = bit(cdm);
  }
  if (count_ < slot::kAccessBits) return;
  state_ = State::kStop;
  if (reading_) {
    ++counters_.reads;
  } else if (crc_fits(bits_, kDataBits)) {
    registers_.write(block_ + address_, static_cast<std::uint8_t>(bits_ >> kCrcBits));
    ++counters_.writes;
    store_busy_.start(now, config_.store_busy, 2);  // for P and the next S
  } else {
    ++counters_.data_errors;
  }
}

// The slave does not know whether the master tests IDA. So EX comes in one of two slots; P follows.
void ControlSlave::command_slot(bool cdm) {
  if (slot_ == slot::kExImmediate && cdm) {
    ex_slot_ = slot::kExImmediate;
  } else if (slot_ == slot::kExTested && ex_slot_ == 0) {
    if (cdm) {
      ex_slot_ = slot::kExTested;
    } else {
      state_ = State::kIdle;  // the master has cancelled the command
    }
  } else if (ex_slot_ != 0 && slot_ == ex_slot_ + 1) {
    execute();
    if (cdm) ++counters_.protocol_errors;
  }
  if (slot_ < slot::kIda + slot::kIds - 1) {
    // The slot of IDA of ID k. Bit 7 of IDS is ID 0.
    const unsigned k = slot_ + 1 - slot::kIda;
    const bool addressed = ((pending_.ids >> (7U - k)) & 1U) != 0;
    cds_ = bit(addressed && ((answered_ids() >> k) & 1U) != 0 && !faults_.silent());
  } else if (ex_slot_ != 0 && slot_ > ex_slot_) {
    state_ = State::kIdle;
  }
}

// The command takes effect when P has arrived.
void ControlSlave::execute() {
  const bool broadcast = pending_.ids == 0;
  if (!broadcast) {
    unsigned addressed = 0;
    for (unsigned k = 0; k < slot::kIds; ++k) addressed |= ((pending_.ids >> (7U - k)) & 1U) << k;
    if ((addressed & answered_ids()) == 0 || faults_.silent()) return;
  }
  ++counters_.commands;
  command_ = pending_;
  switch (pending_.code) {
    case 0:
      data_active_ = !broadcast;
      break;
    case 1:
      control_active_ = broadcast;
      break;
    case 2:
      coupler_on_line_ = !broadcast;
      break;
    default:  // reserved, or specific to the device
      break;
  }
}

}  // namespace mb4::sim
