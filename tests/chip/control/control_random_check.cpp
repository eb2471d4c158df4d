// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Compares the reports of the chip with the actions of the slaves.
#include <algorithm>
#include <sstream>

#include "sim/lines/registers/control_slave.hpp"
#include "sim/lines/registers/control_slots.hpp"
#include "tests/chip/control/control_random.hpp"
#include "tests/support/bits.hpp"

namespace mb4test {
namespace {

using Access = ControlAccess;
using Fault = ControlFault;
namespace slot = sim::control_slot;

constexpr unsigned kWordBits = 12;  // data and CRC

const char* const kFaultNames[] = {
    "none", "CDM", "CDM of the addressed slave", "CDS", "zero", "data", "silent", "wrong CRC"};

// Eight data bits and CRC4 as they stand on the line.
std::string word_of(std::uint8_t value) {
  return word_on_line(value, 8, mb4test::crc_choice(0x04), 0);
}

bool addressed(const Access& access, unsigned id) {
  return access.ids == 0 || ((access.ids >> (7U - id)) & 1U) != 0;
}

}  // namespace

// The slave's start bit of a byte was lost, or a false one came in the frame before and D7 = 1
// looks like the S that the slave wants repeated. Either way all echoes fit, one frame late or
// early; the CRC keeps the slave from writing. docs/choices.md.
std::optional<unsigned> ControlRun::weak_byte(const ControlAccess& access,
                                              const ControlFault& fault, bool& early) const {
  if (access.kind != Access::Kind::kWrite || fault.kind != Fault::Kind::kCds || by_time_) return {};
  const std::vector<unsigned> slots = starts(access);
  unsigned first = slot::kAnswerStart;  // frame in which the start bit is awaited
  for (unsigned i = 0; i < slots.size(); ++i) {
    const std::uint8_t value = access.data[i];
    early = fault.slot + 1 == slots[i] && fault.slot >= first && (value & 0x80U) != 0;
    if (early || (fault.slot == slots[i] && word_of(value).back() == '0')) return i;
    first = slots[i] + 14;
  }
  return {};
}

// A slave that sees CDM = 1 while it sends a byte falls silent: zeros follow, whose CRC fits in a
// few cases. docs/choices.md.
std::optional<ControlRun::CutByte> ControlRun::cut_read(const ControlAccess& access,
                                                        const ControlFault& fault) const {
  if (fault.kind != Fault::Kind::kCdm && fault.kind != Fault::Kind::kCdmAlone) return {};
  if (by_time_ || access.id >= devices_.size()) return {};
  const std::vector<unsigned> slots = starts(access);
  for (unsigned i = 0; i < slots.size(); ++i) {
    if (fault.slot < slots[i] || fault.slot >= slots[i] + kWordBits) continue;
    const unsigned sent = fault.slot - slots[i];
    std::string word = word_of(devices_[access.id].model.read(access.address + i));
    for (unsigned k = sent; k < kWordBits; ++k) word[k] = '0';
    const auto value = static_cast<std::uint8_t>(from_bits(word.substr(0, 8)));
    return CutByte{i, value, word_of(value) == word};
  }
  return {};
}

void ControlRun::check_read(const ControlAccess& access, const ControlFault& fault,
                            const Outcome& outcome, ControlTally& tally) {
  const bool error = outcome.reg_error || outcome.delay_error;
  const std::size_t good = error ? outcome.good_bytes : access.data.size();
  require(good <= access.data.size(), "REGBYTES");
  require(good <= there_, "a register that is not there was read");
  const std::optional<CutByte> cut = cut_read(access, fault);
  if (cut) require(good == cut->index + (cut->written ? 1U : 0U), "REGBYTES behind a wrong bit");
  const std::vector<std::uint8_t> data = host_->rdata(std::max<std::size_t>(good, 1));
  for (unsigned i = 0; i < good; ++i) {
    const std::uint8_t value = devices_[access.id].model.read(access.address + i);
    const bool weak = cut && cut->index == i;
    if (weak && cut->value != value) ++tally.cut_reads;
    require(data[i] == (weak ? cut->value : value),
            "wrong value of register " + std::to_string((access.address + i) % 128));
  }
}

// The bits that the slave receives of a byte of which one bit is wrong. The chip stops at the wrong
// echo, one frame after it has sent the bit, and zeros follow. In 1.5 % of all cases the CRC fits,
// and the slave writes the byte. nREGERR and REGBYTES show the error.
std::optional<ControlRun::CutByte> ControlRun::cut_byte(const ControlAccess& access,
                                                        const ControlFault& fault) const {
  const bool back = fault.kind == Fault::Kind::kCds;
  const bool out = fault.kind == Fault::Kind::kCdm || fault.kind == Fault::Kind::kCdmAlone;
  if ((!back && !out) || by_time_) return {};
  const std::vector<unsigned> slots = starts(access);
  for (unsigned i = 0; i < slots.size(); ++i) {
    // An echo comes one slot after its bit.
    const unsigned first = slots[i] + (back ? 1 : 0);
    if (fault.slot < first || fault.slot >= first + kWordBits) continue;
    const unsigned bit = fault.slot - first;
    std::string word = word_of(access.data[i]);
    if (out) invert(word, bit);
    for (unsigned k = bit + 2; k < kWordBits; ++k) word[k] = '0';
    const auto value = static_cast<std::uint8_t>(from_bits(word.substr(0, 8)));
    return CutByte{i, value, word_of(value) == word};
  }
  return {};
}

void ControlRun::check_write(const ControlAccess& access, const ControlFault& fault,
                             const Outcome& outcome, ControlTally& tally) {
  const bool error = outcome.reg_error || outcome.delay_error;
  const auto size = static_cast<unsigned>(access.data.size());
  const unsigned good = error ? outcome.good_bytes : size;
  require(good <= there_, "a register that is not there was written");
  Device* const device = target(access);
  if (device == nullptr) return;
  // The registers that are written are the first ones of the access: as many as reported, or one
  // more.
  unsigned least = good;
  unsigned most = std::min(good + (error ? 1U : 0U), size);
  std::optional<CutByte> cut;
  bool early = false;
  if (const auto weak = weak_byte(access, fault, early)) {
    require(good == *weak + 1, "the protocol does not show this one");
    least = most = *weak;
    ++(early ? tally.early_start : tally.lost_start);
  } else if ((cut = cut_byte(access, fault))) {
    require(outcome.reg_error && good == cut->index, "a wrong bit was not reported");
    least = most = cut->index;
    if (cut->written && cut->value != access.data[cut->index]) ++tally.cut_writes;
  }
  for (unsigned count = least; count <= most; ++count) {
    RegisterModel after = device->model;
    for (unsigned i = 0; i < count && after.exists(access.address + i); ++i) {
      after.write(access.address + i, access.data[i]);
    }
    if (cut && cut->written) after.write(access.address + cut->index, cut->value);
    if (after.equals(device->slave->registers())) {
      device->model = after;
      return;
    }
  }
  require(false, "the slave does not hold what was written");
}

void ControlRun::check_command(const ControlAccess& access, const ControlFault& fault,
                               const Outcome& outcome, ControlTally& tally) {
  const bool line_fault = fault.kind == Fault::Kind::kCdm;
  bool lost = false;
  for (unsigned id = 0; id < 8; ++id) {
    const bool exists = id < devices_.size();
    if (!exists) {
      if (outcome.reg_error || access.ids == 0 || !addressed(access, id)) continue;
      // An acknowledge is one bit without a CRC.
      require(fault.kind == Fault::Kind::kCds && fault.slot == slot::kIda + id,
              "acknowledged by nobody");
      ++tally.false_acknowledge;
      continue;
    }
    const auto count = devices_[id].slave->control()->counters().commands;
    const bool done = count != executed_[id];
    require(count <= executed_[id] + 1, "a command was executed twice");
    executed_[id] = count;
    require(!done || addressed(access, id), "a slave that was not addressed has executed");
    // EX has one of two slots. If a fault inverts the zero in the other slot, the slave takes it
    // for EX.
    const bool too_early = line_fault && fault.slot == slot::kExImmediate;
    require(!(done && outcome.reg_error && access.tested) || too_early,
            "executed although the test failed");
    lost = lost || (!outcome.reg_error && addressed(access, id) && !done);
  }
  require(!outcome.delay_error, "nDELAYERR of a command");
  if (!lost) return;
  // Nothing acknowledges a broadcast, nor the execution bit of any command.
  const unsigned ex = access.tested ? slot::kExTested : slot::kExImmediate;
  require(line_fault && (fault.slot == ex || (access.ids == 0 && fault.slot <= slot::kCrcEnd)),
          "reported as done, but not executed");
  ++(fault.slot == ex ? tally.lost_execution : tally.lost_broadcast);
}

// Checks what every access must leave as it is, and what an access without a fault must show.
void ControlRun::check_rest(const ControlAccess& access, const ControlFault& fault,
                            const Outcome& outcome) {
  for (const Device& device : devices_) {
    require(device.model.equals(device.slave->registers()), "a register has changed by itself");
  }
  const bool reading = access.kind == Access::Kind::kRead;
  const bool harmless = fault.kind == Fault::Kind::kNone || fault.kind == Fault::Kind::kData ||
                        (fault.kind == Fault::Kind::kWrongCrc && !reading);
  const bool error = outcome.reg_error || outcome.delay_error;
  if (fault.kind == Fault::Kind::kSilent || (fault.kind == Fault::Kind::kWrongCrc && reading)) {
    require(error && outcome.good_bytes == 0, "nobody has answered rightly");
  }
  if (!harmless) return;
  if (access.kind == Access::Kind::kCommand) {
    const unsigned here = 0xFF00U >> count_ & 0xFFU;
    require(outcome.reg_error == ((access.ids & ~here) != 0), "flags without a fault");
    return;
  }
  const unsigned there = there_;
  require(outcome.reg_error == (access.id >= count_), "nREGERR without a fault");
  require(outcome.delay_error == (access.id < count_ && there < access.data.size()),
          "nDELAYERR without a fault");
  if (error) require(outcome.good_bytes == there, "REGBYTES without a fault");
}

void ControlRun::note(const ControlAccess& access, const ControlFault& fault) {
  std::ostringstream line;
  line << std::hex;
  if (access.kind == Access::Kind::kCommand) {
    line << "command ids 0x" << unsigned{access.ids} << (access.tested ? " tested" : "");
  } else {
    line << (access.kind == Access::Kind::kRead ? "read" : "write") << " id " << access.id
         << " address 0x" << access.address;
    if (access.kind == Access::Kind::kRead) line << std::dec << " x " << access.data.size();
    for (const std::uint8_t byte : access.data) {
      if (access.kind == Access::Kind::kWrite) line << " " << unsigned{byte};
    }
  }
  line << std::dec << "; fault " << kFaultNames[static_cast<unsigned>(fault.kind)];
  if (fault.kind != Fault::Kind::kNone) line << " slot " << fault.slot;
  log_ += line.str() + "\n";
}

void ControlRun::note(const Outcome& outcome) {
  log_ += std::string("  -> ") + (outcome.reg_error ? "nREGERR " : "") +
          (outcome.delay_error ? "nDELAYERR " : "") + "REGBYTES " +
          std::to_string(outcome.good_bytes) + "\n";
}

void ControlRun::require(bool good, const std::string& what) const {
  if (!good) throw WrongReport(what);
}

}  // namespace mb4test
