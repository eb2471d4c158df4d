// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Writes the registers of a configuration, and compares them with what the chip holds.

#ifndef MB4_DETAIL_CONFIGURATION_HPP_
#define MB4_DETAIL_CONFIGURATION_HPP_

#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/detail/procedures.hpp"
#include "mb4/register_image.hpp"

namespace mb4::detail {

// Frames of the step of the middle part with a look at SCDATA1.
inline constexpr std::uint32_t kMadeWithLook = 3;

// What is written and compared goes in three parts. The last one is compared first, because VERSION
// is in it: without a chip every register differs, and kVerify would say less. No other part
// reaches the request of an access that begins meanwhile: a reading whose opcode was disturbed
// writes there, and the parts before may be all 0. A witness comes with the last part that is
// compared, because a MISO that is stuck from some part on may look like the right registers, but
// like no status; drops_words() needs it in the same step.
inline constexpr std::uint8_t kPartBytes = Operation::kMaxFrameBytes - 2;
inline constexpr std::uint8_t kLastPart = regs::kAddrRegadr;
inline constexpr std::uint8_t kMiddlePart = kLastPart - kPartBytes;
static_assert(kMiddlePart - kImageFirst <= kPartBytes);
static_assert(kLastPart + kPartBytes >= kImageFirst + kImageBytes);
[[nodiscard]] constexpr std::uint8_t part_bytes(std::uint32_t address) {
  return address == kImageFirst ? kMiddlePart - kImageFirst : kPartBytes;
}

// While the chip is in doubt it is the proof. One that has begun before is none: what it has read
// may be older.
inline void Procedures::plan_verify(ChipState& chip, Operation& op) {
  begin(chip, op, chip.in_doubt() ? proof_step : configuration_step);
  op.purpose_ = Operation::Purpose::kCompare;
  op.request_away_ = chip.request_is_away();
  add_compared(chip, op, kLastPart);
}

// An operation has ended in doubt: the configuration is compared, and a status says whether
// automatic frames run as they should.
inline void Procedures::plan_proof(ChipState& chip, Operation& op, const Result<void>& cause) {
  plan_verify(chip, op);
  op.cause_ = cause.info();
}

// The operation has the result that it had, or that of the comparison.
inline Result<void> Procedures::proof_step(ChipState& chip, Operation& op, std::uint32_t now_us) {
  if (!chip.in_doubt()) {
    return op.cause_;  // configure(), or another proof, has ended it meanwhile
  }
  const Result<void> done = configuration_step(chip, op, now_us);
  if (op.plan_.frames != 0) {
    return done;
  }
  if (!done) {
    chip.configured = false;
    chip.stopped();
    chip.control.readable = 0;
    return done;
  }
  chip.set_waits(ChipState::kForProof, false);
  chip.recover_first = true;
  if (chip.automatic && op.status_.get<regs::AGS>() == 0) {
    chip.restart = true;
    chip.stopped();
    if (op.cause_) {
      op.cause_ = Error::kCorrupted;
    }
  } else {
    chip.watch.held = true;  // the next read drops the words that wait
  }
  return op.cause_;
}

// `config` is valid.
inline void Procedures::plan_configure(ChipState& chip, Operation& op, const Config& config) {
  const std::uint32_t before_us = chip.recovery_us();  // frames of these slaves may run
  chip.forget();
  chip.take(config);
  begin(chip, op, configuration_step);
  op.purpose_ = Operation::Purpose::kConfigure;
  op.request_away_ = false;
  op.limit_.timeout_us = before_us > chip.recovery_us() ? before_us : chip.recovery_us();
  if (needs_revision_y(config)) {
    op.stage_ = kIdentity;
    add_read(op, regs::kAddrRevision, 2);
  } else {
    add_image(chip, op);
  }
}

inline void Procedures::plan_reset(ChipState& chip, Operation& op) {
  chip.forget();
  chip.image = {};
  chip.image[regs::kAddrSlaveloc5 - kImageFirst] = regs::kResetSlaveloc5;
  chip.interface_byte = 0;
  begin(chip, op, configuration_step);
  op.purpose_ = Operation::Purpose::kReset;
  op.request_away_ = false;
  add_image(chip, op);
}

// BREAK, clock source and interface; then two parts.
inline void Procedures::add_image(ChipState& chip, Operation& op) {
  op.stage_ = kImage;
  mb4_plan_add(&op.plan_, 3, MB4_CYCLIC_INSTRUCT, regs::BREAK::encode<1>(), chip.interface_byte);
  for (const std::uint8_t part : {std::uint8_t{kImageFirst}, kMiddlePart}) {
    add_bytes(op, part, &chip.image[part - kImageFirst], part_bytes(part));
  }
}

inline void Procedures::add_compared(const ChipState& chip, Operation& op, std::uint8_t address) {
  op.stage_ = kStart;
  op.address_ = address;
  add_read(op, address, part_bytes(address));
  if (address == kMiddlePart) {
    if (chip.automatic && chip.checks_all()) {
      mb4_plan_add(&op.plan_, 1 + regs::kScdataStride, MB4_CYCLIC_READ0, MB4_CYCLIC_FILLER,
                   MB4_CYCLIC_FILLER);
    }
    add_witness(op);
  }
  if (address == kLastPart) {  // a bus that stores nothing is no chip
    mb4_plan_rx(&op.plan_, static_cast<std::uint8_t>(op.plan_.frames -
                                                     1))[2 + regs::kAddrVersion - kLastPart] = 0;
  }
}

inline Result<void> Procedures::configuration_step(ChipState& chip, Operation& op,
                                                   std::uint32_t /*now_us*/) {
  const Result<void> done = configuration_stage(chip, op);
  const bool compares = op.purpose_ == Operation::Purpose::kCompare;
  if (compares && (done.error() == Error::kNotDetected || done.error() == Error::kVerify)) {
    // Reads of a chip that is configured otherwise may bring the word of another slave.
    chip.configured = false;
    chip.stopped();
  }
  if (done && op.plan_.frames == 0 && op.purpose_ == Operation::Purpose::kConfigure) {
    chip.configured = true;
    // Without a system clock EOT is 0 too; then BREAK changes nothing.
    chip.recover_first = !op.status_.idle();
  }
  return done;
}

// The first frame needs a chip that waits for nothing, and SVALID = 0: BREAK may be lost, and a
// disturbed 1 in the place of SVALID changes nothing.
[[nodiscard]] inline ErrorInfo at_rest(const ChipState& chip, const Status& status) {
  const unsigned valid = status.valid_flags() & unsigned{chip.sensor_flags};
  if (status.instruction() == 0 && valid == 0) {
    return {};
  }
  return ErrorInfo::at_register(Error::kVerify, status.instruction() != 0 ? regs::kAddrInstr
                                                : valid > 0xFF            ? regs::kAddrSvalidHi
                                                                          : regs::kAddrSvalidLo);
}

inline Result<void> Procedures::configuration_stage(ChipState& chip, Operation& op) {
  const bool compares = op.purpose_ == Operation::Purpose::kCompare;
  op.request_away_ = op.request_away_ || chip.request_is_away();
  if (!op.good_ || (compares && !chip.configured)) {
    return op.good_ ? Error::kWrongMode : Error::kTransport;
  }
  switch (op.stage_) {
    case kIdentity:
      return take_identity(chip, op);
    case kImage:
      return take_image(chip, op);
    default:
      return take_compared(chip, op);
  }
}

// `version` is that of an iC-MB4.
[[nodiscard]] inline bool is_device(std::uint8_t version) {
  return version == static_cast<std::uint8_t>(regs::DeviceVersion::kIcMb4);
}

// REVISION and VERSION were read.
inline Result<void> Procedures::take_identity(ChipState& chip, Operation& op) {
  const std::uint8_t* is = received(op) + 2;
  if (!is_device(is[1])) {
    return Error::kNotDetected;
  }
  const ErrorInfo old = check_revision(is[0]);
  if (old.code == Error::kNone) {
    add_image(chip, op);
  }
  return old;
}

// All but the last part was written. BREAK may have cut a frame; the next one comes after the
// slaves' timeout.
inline Result<void> Procedures::take_image(ChipState& chip, Operation& op) {
  constexpr std::size_t kBefore = kLastPart - kImageFirst;
  op.plan_.pause_us =
      op.purpose_ == Operation::Purpose::kConfigure ? op.limit_.timeout_us : std::uint32_t{0};
  add_bytes(op, kLastPart, chip.image.data() + kBefore, kImageBytes - kBefore);
  add_compared(chip, op, kLastPart);
  return {};
}

// A part was read.
inline Result<void> Procedures::take_compared(ChipState& chip, Operation& op) {
  const bool middle = op.address_ == kMiddlePart;
  const std::uint8_t* is = received(op, middle ? op.made_ - 1U : 0) + 2;
  const bool last = op.address_ == kLastPart;
  if (last && !is_device(is[regs::kAddrVersion - kLastPart])) {
    return Error::kNotDetected;
  }
  if (const unsigned at =
          differs_at(chip, op.address_, is, part_bytes(op.address_), op.request_away_);
      at != kNowhere) {
    return ErrorInfo::at_register(Error::kVerify, static_cast<std::uint8_t>(at));
  }
  if (middle) {
    return take_configuration_end(chip, op);
  }
  add_compared(chip, op, last ? std::uint8_t{kImageFirst} : kMiddlePart);
  return {};
}

// Beside automatic frames SCDATA1 was read between the middle part and the witness. Words that wait
// may be foreign: where slaves 5 to 8 are not used the middle part is 0, so its reading may have
// been none. A disturbed opcode (0x03 and 0x0B) puts 0xD0 and zeros into SCDATA1 to 3. The look at
// SCDATA1 may be a write, too (0x09 and 0x0B); then it reads 0. They may be old where a disturbed
// release of the bank has swapped the banks: SWBANK.
inline bool Procedures::drops_words(const ChipState& chip, const Operation& op) {
  const std::uint8_t* fillers = mb4_plan_tx(&op.plan_, 0) + 2;
  const bool waits = (op.status_.valid_flags() & unsigned{chip.sensor_flags}) != 0;
  return (waits && bytes_equal(received(op, 1) + 2, fillers, regs::kScdataStride - 1)) ||
         op.status_.get<regs::SWBANK>() != 0;
}

// All is as it was written; the witness was read.
inline Result<void> Procedures::take_configuration_end(ChipState& chip, Operation& op) {
  const Result<void> seen = take_status(op);
  if (seen && interface_changed(chip, op)) {
    return ErrorInfo::at_register(Error::kVerify, regs::kAddrIface);
  }
  if (seen && op.made_ == kMadeWithLook && drops_words(chip, op)) {
    chip.watch.held = true;  // the next read drops them
  }
  return seen && op.purpose_ == Operation::Purpose::kConfigure ? at_rest(chip, op.status_) : seen;
}

}  // namespace mb4::detail

#endif  // MB4_DETAIL_CONFIGURATION_HPP_
