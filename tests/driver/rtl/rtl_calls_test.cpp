// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Every public call that talks to the chip, on the Verilated chip: success, each transfer failing,
// MISO stuck at either level. What calls.toml lists.

#include "tests/driver/rtl/rtl_calls.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/c/mb4_c_access.hpp"
#include "tests/driver/rtl/fault_bus.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using namespace mb4test;  // NOLINT: the states and names of rtl_calls.hpp

struct Call {
  std::string name;
  State state;
  Error (*run)(FaultyChip& chip);
  Error stuck_low;   // with MISO at 0, and ...
  Error stuck_high;  // ... at 1, from the call's first transfer on
  // Numbers, from the end, of transfers that report nothing when they fail once: the end of a
  // register access, which is then sent again.
  std::size_t quiet = 0;
  std::size_t quiet_count = 0;
  // Before these transfers one look at the status may fail.
  bool patient = false;
};

// The position out of a frame, or what is wrong with it.
Error position(const mb4::Result<void>& done, const Frame& frame) {
  if (!done) return done.error();
  if (!frame[1]) return frame[1].error();
  return frame[1]->position == 0x2ABCDEF ? Error::kNone : Error::kInvalidArgument;
}
Error position(const mb4::Result<mb4::Reading>& reading) {
  if (!reading) return reading.error();
  return reading->position == 0x2ABCDEF ? Error::kNone : Error::kInvalidArgument;
}
// What was read against what it has to be.
Error bytes(const mb4::Result<void>& done, std::array<std::uint8_t, 4> want) {
  if (!done) return done.error();
  return buffer == want ? Error::kNone : Error::kInvalidArgument;
}
const std::array<std::uint8_t, 4> kSerial{0x00, 0xD9, 0x01, 0x32};

constexpr Error kNo = Error::kNotDetected;
constexpr Error kOdd = Error::kInvalidArgument;  // read something else: raw calls have no check

const Call kCalls[] = {
    {"Probe", State::kFresh, [](FaultyChip& c) { return c.device.probe().error(); }, kNo, kNo},
    {"Configure", State::kFresh,
     [](FaultyChip& c) { return c.device.configure(encoder(false)).error(); }, kNo, kNo},
    {"Verify", State::kConfigured, [](FaultyChip& c) { return c.device.verify().error(); }, kNo,
     kNo},
    {"Reset", State::kConfigured, [](FaultyChip& c) { return c.device.reset().error(); }, kNo, kNo},
    {"Initialize", State::kConfigured, [](FaultyChip& c) { return c.device.initialize().error(); },
     kNo, kNo},
    {"ReadFrame", State::kConfigured, [](FaultyChip& c) { return position(c.device.read_frame()); },
     kNo, kNo},
    {"ReadAll", State::kConfigured,
     [](FaultyChip& c) {
       Frame frame;
       return position(c.device.read_all(frame), frame);
     },
     kNo, kNo},
    {"Break", State::kConfigured,
     [](FaultyChip& c) { return c.device.break_transmission().error(); }, kNo, kNo},
    {"ReadStatus", State::kFresh, [](FaultyChip& c) { return c.device.read_status().error(); }, kNo,
     kNo},
    {"ClearValid", State::kFresh, [](FaultyChip& c) { return c.device.clear_valid(1).error(); },
     Error::kNone, Error::kNone},
    {"Start", State::kConfigured,
     [](FaultyChip& c) { return c.device.automatic().start().error(); }, kNo, kNo},
    {"Stop", State::kAutomatic, [](FaultyChip& c) { return c.device.automatic().stop().error(); },
     kNo, kNo},
    {"Restart", State::kAutomatic,
     [](FaultyChip& c) { return c.device.automatic().restart().error(); }, kNo, kNo},
    {"Poll", State::kAutomatic,
     [](FaultyChip& c) {
       Frame frame;
       return position(c.device.automatic().poll(frame), frame);
     },
     kNo, kNo},
    {"PollSlave", State::kAutomatic,
     [](FaultyChip& c) { return position(c.device.automatic().poll_slave(1)); }, kNo, kNo},
    {"Next", State::kAutomatic,
     [](FaultyChip& c) {
       Frame frame;
       return position(c.device.automatic().next(frame), frame);
     },
     kNo, kNo},
    {"BeginRead", State::kConfigured,
     [](FaultyChip& c) {
       return mb4_c::PolledAccess(c.device).begin_read({1, 0}, 0x44, 4).error();
     },
     kNo, kNo},
    {"BeginWrite", State::kConfigured,
     [](FaultyChip& c) {
       return mb4_c::PolledAccess(c.device).begin_write({1, 0}, 0x60, kBytes).error();
     },
     kNo, kNo},
    {"BeginCommand", State::kConfigured,
     [](FaultyChip& c) { return mb4_c::PolledAccess(c.device).begin_command(activate()).error(); },
     kNo, kNo},
    {"ControlPoll", State::kReadBegun,
     [](FaultyChip& c) {
       Error error = Error::kNone;
       for (int i = 0; i < 3 && error == Error::kNone; ++i) {
         error = mb4_c::PolledAccess(c.device).poll().error();
       }
       return error;
     },
     kNo, kNo, 0, 0, true},
    {"Take", State::kReadEnded,
     [](FaultyChip& c) { return bytes(mb4_c::PolledAccess(c.device).take(buffer), kSerial); }, kNo,
     kNo},
    {"Abort", State::kReadBegun, [](FaultyChip& c) { return c.device.control().abort().error(); },
     kNo, kNo},
    {"ReadRegisters", State::kConfigured,
     [](FaultyChip& c) {
       return bytes(c.device.control().read_registers({1, 0}, 0x44, buffer), kSerial);
     },
     kNo, kNo, 5, 6, true},
    {"WriteRegisters", State::kConfigured,
     [](FaultyChip& c) {
       return c.device.control().write_registers({1, 0}, 0x60, kBytes).error();
     },
     kNo, kNo, 1, 4, true},
    {"Send", State::kConfigured,
     [](FaultyChip& c) { return c.device.control().send(activate()).error(); }, kNo, kNo, 1, 4,
     true},
    {"Activate", State::kConfigured,
     [](FaultyChip& c) { return c.device.control().activate().error(); }, kNo, kNo, 1, 4, true},
    {"FieldGet", State::kFresh,
     [](FaultyChip& c) {
       const auto value = c.device.fields().get<regs::VERSION>();
       return value ? (*value == 0x84 ? Error::kNone : kOdd) : value.error();
     },
     kOdd, kOdd},
    {"FieldModify", State::kFresh,
     [](FaultyChip& c) { return c.device.fields().modify<regs::HOLDCDM>(1).error(); }, Error::kNone,
     Error::kNone},
    {"FieldModifyConstant", State::kFresh,
     [](FaultyChip& c) { return c.device.fields().modify<regs::HOLDCDM, 1>().error(); },
     Error::kNone, Error::kNone},
    {"OpcodeWriteRegisters", State::kFresh,
     [](FaultyChip& c) { return c.device.opcodes().write_registers(0x80, kBytes).error(); },
     Error::kNone, Error::kNone},
    {"OpcodeReadRegisters", State::kFresh,
     [](FaultyChip& c) {
       return bytes(c.device.opcodes().read_registers(0xEA, buffer), {0x20, 0x84, 0x01, 0x00});
     },
     kOdd, kOdd},
    {"OpcodeReadStatus", State::kFresh,
     [](FaultyChip& c) {
       return bytes(c.device.opcodes().read_status(buffer), {0xFB, 0x00, 0x00, 0x00});
     },
     kOdd, kOdd},
    {"OpcodeWriteInstruction", State::kFresh,
     [](FaultyChip& c) {
       return c.device.opcodes()
           .write_instruction(mb4::Span<const std::uint8_t>(kBytes).first(1))
           .error();
     },
     Error::kNone, Error::kNone},
    {"OpcodeReadRegisters0", State::kFresh,
     [](FaultyChip& c) { return bytes(c.device.opcodes().read_registers0(buffer), {}); },
     Error::kNone, kOdd},
    {"OpcodeWriteRegisters0", State::kFresh,
     [](FaultyChip& c) { return c.device.opcodes().write_registers0(kBytes).error(); },
     Error::kNone, Error::kNone},
};

class DriverCall : public testing::TestWithParam<Call> {};

TEST_P(DriverCall, Success) {
  FaultyChip chip(kEncoder);
  prepare(chip, GetParam().state);
  chip.bus.plan({});
  EXPECT_EQ(GetParam().run(chip), Error::kNone);
  EXPECT_GE(chip.bus.count(), 1U);
}

// kTransport, whichever transfer fails; but one look at an access that runs may fail.
TEST_P(DriverCall, EachTransferFails_IsTransport) {
  std::size_t count = 0;
  std::vector<std::uint8_t> opcodes;
  {
    FaultyChip chip(kEncoder);
    prepare(chip, GetParam().state);
    chip.bus.plan({});
    ASSERT_EQ(GetParam().run(chip), Error::kNone);
    count = chip.bus.count();
    opcodes = chip.bus.opcodes();
  }
  // Of a register access the polls in the middle are all alike.
  for (std::size_t index = 0; index<count; index += count> 40 && index == 8 ? count - 20 : 1) {
    for (const FaultKind kind : {FaultKind::kRefused, FaultKind::kFailedAfter}) {
      FaultyChip chip(kEncoder);
      prepare(chip, GetParam().state);
      chip.bus.plan({kind, index, index, 0});
      const std::size_t left = count - index;
      const std::size_t last_quiet = GetParam().quiet + GetParam().quiet_count;
      // A status behind a reading is a witness.
      const bool witness = index > 0 && opcodes[index - 1] == 0x03;
      const bool look =
          GetParam().patient && opcodes[index] == 0x05 && !witness && left >= last_quiet;
      const bool quiet = look || (left >= GetParam().quiet && left < last_quiet);
      const Error want = quiet ? Error::kNone : Error::kTransport;
      EXPECT_EQ(GetParam().run(chip), want) << "transfer " << index << " of " << count;
    }
  }
}

TEST_P(DriverCall, MisoStuck_IsNotDetectedOrCorrupted) {
  for (const bool high : {false, true}) {
    FaultyChip chip(kEncoder);
    prepare(chip, GetParam().state);
    buffer = {};
    chip.bus.plan({high ? FaultKind::kMisoHigh : FaultKind::kMisoLow, 0, kForEver, 0});
    EXPECT_EQ(GetParam().run(chip), high ? GetParam().stuck_high : GetParam().stuck_low) << high;
  }
}

INSTANTIATE_TEST_SUITE_P(Rtl, DriverCall, testing::ValuesIn(kCalls),
                         [](const auto& test) { return test.param.name; });

}  // namespace
