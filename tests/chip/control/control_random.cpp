// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/chip/control/control_random.hpp"

#include <algorithm>
#include <sstream>

#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/registers/control_slave.hpp"
#include "sim/lines/registers/control_slots.hpp"

namespace mb4test {
namespace {

using Access = ControlAccess;
using Fault = ControlFault;
namespace slot = sim::control_slot;

constexpr unsigned kFramesOfByte = 14;  // S, eight bits, CRC, P
constexpr unsigned kLastOfByte = 13;    // from the slave's start bit to the next S or the end

}  // namespace

ControlRun::ControlRun(std::uint64_t seed) : random_(seed) {
  scenario_ = make_scenario();
  chip_ = std::make_unique<Chip>(scenario_);
  host_ = std::make_unique<ControlHost>(*chip_);
  for (unsigned id = 0; id < count_; ++id) {
    const unsigned first = channel_ == 1 ? 1 : 5;
    sim::ClockedSlave* const slave = clocked(chip_->simulator.slave(first + count_ - 1 - id));
    RegisterModel model = models_[id];
    for (unsigned i = 0; i < RegisterModel::kSize; ++i) {
      model.bytes[i] = i == RegisterModel::kBankSelect ? 0 : static_cast<std::uint8_t>(below(256));
      slave->reg_write(static_cast<std::uint8_t>(i), model.bytes[i]);
    }
    devices_.push_back({slave, model});
    executed_.push_back(0);
  }
  configure();
}

std::string ControlRun::make_scenario() {
  channel_ = one_in(4) ? 2 : 1;
  count_ = 1 + below(3);
  ags_ = !one_in(4);
  by_time_ = one_in(5);
  const auto busy = [&] { return one_in(2) ? 0U : below(one_in(4) ? 20 : 4); };
  read_busy_ = busy();
  write_busy_ = busy();
  store_busy_ = busy();
  std::ostringstream text;
  text << "[host]\nsclk_hz = 50_000_000\n[[channel]]\nnumber = " << channel_
       << "\ndelay_ns = " << below(400) << ".0\n";
  models_.resize(count_);
  for (unsigned id = count_; id-- > 0;) {  // the near slave has the highest ID
    RegisterModel& model = models_[id];
    text << "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 5\ndata = " << below(32) << "\n";
    if (by_time_) {
      text << "read_busy_us = " << below(60) << "\nwrite_busy_us = " << below(60) << "\n";
    } else {
      text << "read_busy_frames = " << read_busy_ << "\nwrite_busy_frames = " << write_busy_
           << "\nstore_busy_frames = " << store_busy_ << "\n";
    }
    if (one_in(3)) {
      text << "banks = { 1 = { 0x00 = [1, 2, 3] }, 7 = { 0x3F = 9 } }\n";
      model.banks[1] = {1, 2, 3};
      model.banks[7] = {};
      model.banks[7][0x3F] = 9;
    }
    const unsigned gap = below(128);
    const unsigned hard = below(128);
    text << "missing = [" << gap << "]\nwrite_protected = [" << hard << "]\n";
    model.missing.set(gap);
    model.write_protected.set(hard);
  }
  return text.str();
}

void ControlRun::configure() {
  for (unsigned i = 0; i < count_; ++i) {
    const unsigned at = reg::slave_cfg_address(i + (channel_ == 1 ? 1 : 5));
    chip_->write(static_cast<std::uint8_t>(at),
                 {reg::kEnscdYes | 4, reg::kScrclenCrc6, 0x00, 0x00});
  }
  host_->select(static_cast<std::uint8_t>(channel_));
  // FREQR = 0: the limit for the start bit is 8192 periods of MA.
  chip_->write(reg::kAddrCtrl, {reg::kRegversBissC, 0, 0, reg::kFreqagsAgsMin});
  chip_->write(
      reg::kAddrSlaveloc5,
      {static_cast<std::uint8_t>(channel_ == 1 ? reg::kResetSlaveloc5
                                               : reg::kResetSlaveloc5 | reg::kSlaveloc5Split),
       static_cast<std::uint8_t>(channel_ == 1 ? reg::kCfgch2Unused | reg::kCfgch1BissC
                                               : reg::kCfgch2BissC | reg::kCfgch1Unused)});
}

ControlAccess ControlRun::draw_access() {
  if (written_ && !one_in(4)) {
    Access back = *written_;
    back.kind = Access::Kind::kRead;
    written_.reset();
    return back;
  }
  Access access;
  if (one_in(8)) {
    access.kind = Access::Kind::kCommand;
    // No slave here has IDs 4 to 7; now and then the test addresses one of them.
    access.ids = static_cast<std::uint8_t>(one_in(3) ? 0 : 1U << (7 - below(count_)));
    if (access.ids != 0 && one_in(3)) access.ids |= static_cast<std::uint8_t>(1U << (7 - below(8)));
    access.tested = access.ids != 0 && one_in(2);
    return access;
  }
  access.kind = one_in(2) ? Access::Kind::kWrite : Access::Kind::kRead;
  access.id = one_in(20) ? below(8) : below(count_);
  access.address = one_in(10) ? RegisterModel::kBankSelect : below(128);
  const unsigned most = one_in(40) && ags_ ? 64 : one_in(4) ? 8 : 3;
  access.data.resize(1 + below(most));
  for (std::uint8_t& byte : access.data) byte = static_cast<std::uint8_t>(below(256));
  if (access.address == RegisterModel::kBankSelect) {
    const std::uint8_t banks[] = {0, 0, 1, 7};
    access.data[0] = banks[below(4)];
  }
  return access;
}

std::vector<unsigned> ControlRun::starts(const ControlAccess& access) const {
  std::vector<unsigned> out;
  unsigned wait = slot::kAnswerStart;
  for (std::size_t i = 0; i < access.data.size(); ++i) {
    const bool reading = access.kind == Access::Kind::kRead;
    const unsigned busy = reading  ? read_busy_
                          : i == 0 ? write_busy_
                                   : std::max(write_busy_, store_busy_);
    out.push_back(wait + busy);
    wait += busy + kFramesOfByte;
  }
  return out;
}

ControlRun::Device* ControlRun::target(const ControlAccess& access) {
  return access.id < devices_.size() ? &devices_[access.id] : nullptr;
}

unsigned ControlRun::existing(const ControlAccess& access) const {
  if (access.id >= devices_.size()) return 0;
  RegisterModel model = devices_[access.id].model;  // writing may select another bank
  for (unsigned i = 0; i < access.data.size(); ++i) {
    if (!model.exists(access.address + i)) return i;
    if (access.kind == Access::Kind::kWrite) model.write(access.address + i, access.data[i]);
  }
  return static_cast<unsigned>(access.data.size());
}

ControlFault ControlRun::draw_fault(const ControlAccess& access) {
  Fault fault;
  const bool command = access.kind == Access::Kind::kCommand;
  if (one_in(2)) return fault;
  fault.kind = static_cast<Fault::Kind>(1 + below(Fault::kKinds - 1));
  // Slots are known up to the first register that does not exist, and with busy times in frames.
  unsigned last = slot::kReadEcho;
  if (command) {
    last = access.ids == 0 ? slot::kExImmediate + 1 : slot::kExTested;
  } else if (!by_time_ && existing(access) == access.data.size()) {
    const auto slots = starts(access);
    last = slots.back() + kLastOfByte;
    if (one_in(3)) {
      const unsigned start = slots[below(static_cast<unsigned>(slots.size()))];
      fault.slot = std::max(start - below(3), 1U);
    }
  }
  const bool back = fault.kind == Fault::Kind::kCds;
  if (fault.slot == 0) fault.slot = back ? 1 + below(last) : below(last + 1);
  if (fault.kind == Fault::Kind::kZero) fault.slot = 1 + below(10);
  // A missing echo ends the access before that slot.
  const bool nobody = !command && access.id >= devices_.size();
  if (nobody ||
      (command && (fault.kind == Fault::Kind::kZero || fault.kind == Fault::Kind::kCdmAlone ||
                   fault.kind == Fault::Kind::kSilent))) {
    fault.kind = Fault::Kind::kNone;
  }
  return fault;
}

void ControlRun::apply(const ControlAccess& access, const ControlFault& fault) {
  sim::ControlFaults& near = devices_.back().slave->control()->faults();
  const auto at_target = [&]() -> sim::ControlFaults& {
    return devices_[access.id].slave->control()->faults();
  };
  switch (fault.kind) {
    case Fault::Kind::kNone:
      break;
    case Fault::Kind::kCdm:
      for (Device& device : devices_)
        device.slave->control()->faults().flip_cdm_in_slot(fault.slot);
      break;
    case Fault::Kind::kCdmAlone:
      // A slave that misses S locks no ID, and the IDs of other slaves change. This test leaves
      // that out.
      at_target().flip_cdm_in_slot(std::max(fault.slot, 1U));
      break;
    case Fault::Kind::kCds:
      near.flip_cds_in_slot(fault.slot);
      break;
    case Fault::Kind::kZero:
      for (Device& device : devices_)
        device.slave->control()->faults().flip_cdm_of_frame(fault.slot);
      break;
    case Fault::Kind::kData:
      clocked(chip_->simulator.line(channel_))->faults().flip_next_frame({2 + below(5)});
      break;
    case Fault::Kind::kSilent:
      at_target().set_silent(true);
      break;
    case Fault::Kind::kWrongCrc:
      if (access.kind == Access::Kind::kRead) at_target().set_wrong_data_crc(true);
      break;
  }
}

ControlRun::Outcome ControlRun::run(const ControlAccess& access) {
  if (access.kind == Access::Kind::kRead) {
    host_->set_read(access.id, access.address, static_cast<unsigned>(access.data.size()));
  } else if (access.kind == Access::Kind::kWrite) {
    host_->set_write(access.id, access.address, access.data);
  } else {
    host_->set_command(access.ids, access.ids == 0 ? 2 : 3, access.tested);
  }
  const bool ended =
      ags_ ? host_->run_ags(20000) : host_->run_single(3000, reg::kInstrControl, channel_) != 0;
  bool in_time = ended;
  if (!ags_ && !ended) {  // between frames the limit passes without them
    chip_->advance_us(1000);
    in_time = (host_->status() & reg::REGEND::kMask) != 0;
  }
  require(in_time, "it never ends");
  if (ags_) chip_->advance_us(10);
  const std::uint8_t status = host_->status();
  Outcome outcome;
  outcome.reg_error = (status & reg::nREGERR::kMask) == 0;
  outcome.delay_error = (status & reg::nDELAYERR::kMask) == 0;
  outcome.good_bytes = host_->regbytes();
  require((status & reg::REGEND::kMask) != 0, "REGEND = 0 at the end");
  require(!(outcome.reg_error && outcome.delay_error), "nREGERR and nDELAYERR");
  require((status & reg::nAGSERR::kMask) != 0, "nAGSERR");
  return outcome;
}

void ControlRun::send_zeros(unsigned frames) {
  if (ags_) return chip_->advance_us(10 * frames);  // they come by themselves
  for (unsigned i = 0; i < frames; ++i) {
    chip_->instruct(reg::kInstrCdm0);
    require(chip_->wait_eot(), "a frame with CDM = 0");
    chip_->advance_us(2);
  }
}

void ControlRun::step(ControlTally& tally) {
  const Access access = draw_access();
  const Fault fault = draw_fault(access);
  note(access, fault);
  there_ = existing(access);
  apply(access, fault);
  const Outcome outcome = run(access);
  note(outcome);
  // Zeros end the control frame in which an access has left a slave. The chip counts its zeros from
  // the stop bit on and does not know that a fault has inverted one of them. Then the next access
  // would fail (nREGERR = 0), so the host sends more zeros here. The inverted zero may also have
  // looked like S. A slave that takes the following bits for a command does not count zeros before
  // EX and needs ten more.
  if (fault.kind != Fault::Kind::kNone || outcome.delay_error) send_zeros(24);
  ++tally.faults[static_cast<unsigned>(fault.kind)];
  if (outcome.reg_error) ++tally.reg_errors;
  if (outcome.delay_error) ++tally.delay_errors;
  if (!outcome.reg_error && !outcome.delay_error) require(outcome.good_bytes == 0, "Table 63");
  if (access.kind == Access::Kind::kRead) {
    ++tally.reads;
    check_read(access, fault, outcome, tally);
  } else if (access.kind == Access::Kind::kWrite) {
    ++tally.writes;
    check_write(access, fault, outcome, tally);
    if (!outcome.reg_error && !outcome.delay_error) written_ = access;
  } else {
    ++tally.commands;
    check_command(access, fault, outcome, tally);
  }
  tally.bytes += access.data.size();
  if (there_ < access.data.size()) ++tally.missing;
  check_rest(access, fault, outcome);
  for (Device& device : devices_) {
    sim::ControlFaults& faults = device.slave->control()->faults();
    faults.set_silent(false);
    faults.set_wrong_data_crc(false);
    require(!faults.pending(), "the fault was not reached");
  }
}

}  // namespace mb4test
