// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Operations in steps on the Verilated chip: the test makes the frames and keeps the time, as DMA
// and a timer would. Source of the procedures: datasheet pages 27 to 29, 33, table 69.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "drivers/c/mb4_c_access.hpp"
#include "sim/lines/clocked/actuator.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/driver/rtl/protocol_bus.hpp"
#include "tests/driver/rtl/rtl_calls.hpp"

namespace {

using namespace mb4test;  // NOLINT: scenarios and configurations
using mb4::Operation;
using mb4::Result;
using mb4::Span;
using mb4::SpiCheck;
namespace sim = mb4::sim;

// Makes all steps; `between` is other work after each step.
template <typename Between>
Result<void> complete(FaultyChip& chip, Operation& op, Between between) {
  bool ended = false;
  for (unsigned steps = 0; !ended; ++steps) {
    if (steps > 10'000) {
      ADD_FAILURE() << "the operation does not end";
      return op.result();
    }
    for (std::size_t i = 0; i < op.frames(); ++i) {
      EXPECT_LE(op.tx(i).size(), Operation::kMaxFrameBytes);
    }
    chip.simulator.advance(op.pause_us() * sim::kPsPerUs);
    const bool transferred = op.run(chip.bus);
    ended = chip.device.finish(op, transferred, chip.clock.now_us());
    if (!ended) between();
  }
  return op.result();
}
Result<void> complete(FaultyChip& chip, Operation& op) {
  return complete(chip, op, [&chip] { chip.simulator.advance(10 * sim::kPsPerUs); });
}

void stick(FaultyChip& chip, std::optional<bool> level) {
  clocked(chip.simulator.line(1))->faults().stick(level);
  chip.simulator.refresh_lines();
}

// ---- Start and restart --------------------------------------------------------------------------

class DriverOperation : public testing::TestWithParam<SpiCheck> {
 protected:
  static Config config(bool automatic) {
    Config one = encoder(automatic);
    one.spi_check = GetParam();
    return one;
  }
};

std::string name_of(const testing::TestParamInfo<SpiCheck>& test) {
  if (test.param == SpiCheck::kOff) return "Off";
  return test.param == SpiCheck::kCrc ? "Crc" : "Full";
}
INSTANTIATE_TEST_SUITE_P(Checks, DriverOperation,
                         testing::Values(SpiCheck::kOff, SpiCheck::kCrc, SpiCheck::kFull), name_of);

TEST_P(DriverOperation, Restart_BringsPositionsBack) {
  FaultyChip chip(kEncoder);
  ASSERT_TRUE(chip.device.configure(config(true)).ok());
  Operation op;
  ASSERT_TRUE(chip.device.automatic().plan_start(op).ok());
  ASSERT_TRUE(complete(chip, op).ok());
  for (int i = 0; i < 3; ++i) {
    chip.simulator.advance(250 * sim::kPsPerUs);
    ASSERT_TRUE(chip.device.automatic().poll_slave(1).ok());
    stick(chip, false);
    Error error = Error::kNoData;
    for (int tick = 0; tick < 100 && error != Error::kLineError; ++tick) {
      chip.simulator.advance(100 * sim::kPsPerUs);
      error = chip.device.automatic().poll_slave(1).error();
    }
    EXPECT_EQ(error, Error::kLineError);
    stick(chip, std::nullopt);
    ASSERT_TRUE(chip.device.automatic().plan_restart(op).ok());
    const sim::Time begin = chip.simulator.now();
    ASSERT_TRUE(complete(chip, op).ok());
    EXPECT_GE(chip.simulator.now() - begin, 100 * sim::kPsPerUs);
    EXPECT_EQ(chip.device.automatic().poll_slave(1).error(), Error::kNoData) << "an old position";
    chip.simulator.advance(250 * sim::kPsPerUs);
    const Result<mb4::Reading> reading = chip.device.automatic().poll_slave(1);
    ASSERT_TRUE(reading.ok()) << mb4::to_string(reading.error());
    EXPECT_EQ(reading->position, 0xAAF37BFU >> 2U);
  }
}

// ---- INIT and verify ----------------------------------------------------------------------------

TEST_P(DriverOperation, Initialize_MeasuresAsTheBlockingCall) {
  const auto line = [](const std::string& delay, const std::string& number) {
    return "[[channel]]\nnumber = " + number + "\ndelay_ns = " + delay +
           "\n[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\n";
  };
  FaultyChip chip(line("520", "1") + line("1020", "2"));
  Config both = config(false);
  both.channels[1].protocol = mb4::Protocol::kBissC;
  both.slaves[4] = both.slaves[0];
  ASSERT_TRUE(chip.device.configure(both).ok());
  const Result<mb4::LineDelay> blocking = chip.device.initialize();
  ASSERT_TRUE(blocking.ok());
  Operation op;
  ASSERT_TRUE(chip.device.plan_initialize(op).ok());
  EXPECT_TRUE(complete(chip, op).ok());
  EXPECT_EQ(op.line_delay().quarters, blocking->quarters);
  EXPECT_GT(op.line_delay().quarters[1], op.line_delay().quarters[0]);
  EXPECT_TRUE(chip.device.read_frame().ok());
}

TEST_P(DriverOperation, InitializeFaults_AreTold) {
  FaultyChip chip(kEncoder);
  ASSERT_TRUE(chip.device.configure(config(false)).ok());
  Operation op;
  for (const auto& [level, error] : {std::pair{std::optional(false), Error::kLineError},
                                     std::pair{std::optional(true), Error::kLineDelay},
                                     std::pair{std::optional<bool>(), Error::kNone}}) {
    stick(chip, level);
    ASSERT_TRUE(chip.device.plan_initialize(op).ok());
    EXPECT_EQ(complete(chip, op).error(), error);
  }
  FaultyChip dead("[chip]\nf_clk_hz = 0\n" + kEncoder);
  ASSERT_TRUE(dead.device.configure(config(false)).ok());
  ASSERT_TRUE(dead.device.plan_initialize(op).ok());
  EXPECT_EQ(complete(dead, op).error(), Error::kTimeout);
}

TEST_P(DriverOperation, Verify_BesidePositionsFindsAChange) {
  FaultyChip chip(kEncoder);
  ASSERT_TRUE(chip.device.configure(config(true)).ok());
  ASSERT_TRUE(chip.device.automatic().start().ok());
  Operation op;
  unsigned positions = 0;
  const auto tick = [&] {
    chip.simulator.advance(110 * sim::kPsPerUs);
    positions += chip.device.automatic().poll_slave(1).ok() ? 1 : 0;
  };
  ASSERT_TRUE(chip.device.plan_verify(op).ok());
  EXPECT_TRUE(complete(chip, op, tick).ok());
  EXPECT_EQ(positions, 2U);  // between three steps
  const std::uint8_t other = 0x1A;
  ASSERT_TRUE(chip.device.opcodes().write_registers(0xC8, Span<const std::uint8_t>(&other, 1)));
  ASSERT_TRUE(chip.device.plan_verify(op).ok());
  EXPECT_EQ(complete(chip, op).error(), Error::kVerify);
  EXPECT_EQ(op.result().info().address(), 0xC8);
  EXPECT_FALSE(chip.device.configured());
}

// The steps of docs/driver.md, "The rest by DMA": those of an access until its status is polled.
TEST_P(DriverOperation, Steps_AreThoseOfThePage) {
  FaultyChip chip(kEncoder);
  Config one = config(true);
  one.spi_check = GetParam();
  Operation op;
  const auto steps = [&](const Result<void>& planned) {
    EXPECT_TRUE(planned.ok());
    unsigned count = 0;
    unsigned begun = 0;
    for (bool ended = !planned.ok(); !ended; ++count) {
      const bool polls = op.frames() == 1 && op.tx(0)[0] == 0x05;
      begun = polls && begun == 0 ? count : begun;
      if (op.pause_us() != 0) chip.simulator.advance(op.pause_us() * sim::kPsPerUs);
      ended = chip.device.finish(op, op.run(chip.bus), chip.clock.now_us());
      chip.simulator.advance(10 * sim::kPsPerUs);
    }
    EXPECT_TRUE(op.result().ok()) << mb4::to_string(op.result().error());
    return begun != 0 ? begun : count;
  };
  EXPECT_EQ(steps(chip.device.plan_configure(op, one)), 4U);
  EXPECT_EQ(steps(chip.device.plan_verify(op)), 3U);
  ASSERT_TRUE(chip.device.automatic().start().ok());
  std::array<std::uint8_t, 9> bytes{1, 2, 3, 4, 5, 6, 7, 8, 9};
  const Span<std::uint8_t> all(bytes);
  auto control = chip.device.control();
  EXPECT_EQ(steps(control.plan_read(op, {1, 0}, 4, all)), 2U);
  EXPECT_EQ(steps(control.plan_write(op, {1, 0}, 4, all.first(8))), 2U + 2U);
  EXPECT_EQ(steps(control.plan_write(op, {1, 0}, 4, all)), 2U + 4U);
  mb4::Command command;
  command.ids = 1;
  EXPECT_EQ(steps(control.plan_command(op, command)), 4U);
}

// ---- Registers ----------------------------------------------------------------------------------

TEST_P(DriverOperation, Registers_AreWrittenAndRead) {
  for (const bool automatic : {false, true}) {
    FaultyChip chip(kEncoder);
    ASSERT_TRUE(chip.device.configure(config(automatic)).ok());
    if (automatic) {
      ASSERT_TRUE(chip.device.automatic().start().ok());
    }
    Operation op;
    for (const std::size_t count : {1U, 2U, 18U, 19U, 37U, 64U}) {
      std::vector<std::uint8_t> bytes(count);
      for (std::size_t i = 0; i < count; ++i)
        bytes[i] = static_cast<std::uint8_t>(0x35 * i + count);
      ASSERT_TRUE(chip.device.control().plan_write(op, {1, 0}, 0x04, {bytes.data(), count}).ok());
      ASSERT_TRUE(complete(chip, op).ok()) << count;
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_EQ(chip.simulator.slave(1)->reg_read(static_cast<std::uint8_t>(4 + i)), bytes[i]);
      }
      std::vector<std::uint8_t> back(count);
      ASSERT_TRUE(chip.device.control().plan_read(op, {1, 0}, 0x04, {back.data(), count}).ok());
      ASSERT_TRUE(complete(chip, op).ok()) << count;
      EXPECT_EQ(back, bytes);
    }
    ASSERT_TRUE(chip.device.control().plan_command(op, activate()).ok());
    EXPECT_TRUE(complete(chip, op).ok());
    // No slave has ID 5.
    std::uint8_t none = 0;
    ASSERT_TRUE(chip.device.control().plan_read(op, {1, 5}, 0x44, {&none, 1}).ok());
    EXPECT_EQ(complete(chip, op).error(), Error::kRegister);
    if (!automatic) {
      EXPECT_TRUE(chip.device.read_frame().ok());
    }
  }
}

TEST_P(DriverOperation, BissB_RegistersByTheHandOver) {
  FaultyChip chip(biss_b_bus(false, "data = 0xABCDEF7"));
  Config one = biss_b_config(false);
  one.spi_check = GetParam();
  ASSERT_TRUE(chip.device.configure(one).ok());
  const mb4::SlaveAddress slave = mb4::slave_address(one, 1);
  Operation op;
  std::array<std::uint8_t, 3> back{};
  ASSERT_TRUE(chip.device.control().plan_write(op, slave, 0x20, Span<const std::uint8_t>(kBytes)));
  ASSERT_TRUE(complete(chip, op).ok());
  ASSERT_TRUE(chip.device.control().plan_read(op, slave, 0x21, back).ok());
  ASSERT_TRUE(complete(chip, op).ok());
  EXPECT_EQ(back, (std::array<std::uint8_t, 3>{2, 3, 4}));
  ASSERT_TRUE(chip.device.plan_initialize(op).ok());
  EXPECT_TRUE(complete(chip, op).ok());
  EXPECT_TRUE(chip.device.read_frame().ok());
}

// nAGSERR = 0 means that no slave has taken part, but a chip may set it at each write of 0xF4. The
// slaves' timeout after the access is no part of the time that tells the two apart, and a chip that
// does not set it lets the caller be as slow as it likes. 4096 register clocks are 3.3 ms here.
TEST_P(DriverOperation, BissBWithASlowCaller_IsNoFailedHandOver) {
  struct Slow {
    const char* quirk;
    std::uint32_t register_timeout_us;
    std::uint32_t tick_us;
  };
  for (const Slow& slow :
       {Slow{"true", 2000, 100}, Slow{"false", 2000, 100}, Slow{"false", 5, 5000}}) {
    FaultyChip chip(std::string("[chip.quirks]\nAGSERR_ON_INSTR_WRITE = ") + slow.quirk + "\n" +
                    biss_b_bus(false, "data = 0xABCDEF7"));
    Config one = biss_b_config(false);
    one.spi_check = GetParam();
    one.register_timeout_us = slow.register_timeout_us;
    ASSERT_TRUE(chip.device.configure(one).ok());
    const mb4::SlaveAddress slave = mb4::slave_address(one, 1);
    const auto tick = [&] { chip.simulator.advance(slow.tick_us * sim::kPsPerUs); };
    Operation op;
    std::array<std::uint8_t, 4> back{};
    ASSERT_TRUE(
        chip.device.control().plan_write(op, slave, 0x20, Span<const std::uint8_t>(kBytes)));
    EXPECT_TRUE(complete(chip, op, tick).ok()) << mb4::to_string(op.result().error());
    ASSERT_TRUE(chip.device.control().plan_read(op, slave, 0x20, back).ok());
    EXPECT_TRUE(complete(chip, op, tick).ok()) << mb4::to_string(op.result().error());
    EXPECT_EQ(back, kBytes);
    // Without a slave the hand-over fails.
    stick(chip, true);
    ASSERT_TRUE(chip.device.control().plan_read(op, slave, 0x20, back).ok());
    EXPECT_EQ(complete(chip, op, tick).error(), Error::kRegister) << slow.quirk;
  }
}

// The byte with INIT is lost, or one of its bits is flipped. With kFull no delay of another time
// and no hand-over that was not made counts as done.
TEST(DriverOperationInit, LostInstruction_IsNoSuccess) {
  for (const mb4::Protocol protocol : {mb4::Protocol::kBissC, mb4::Protocol::kBissB}) {
    for (const FaultKind kind : {FaultKind::kLost, FaultKind::kFlipMosi, FaultKind::kRefused}) {
      for (std::size_t bit = 0; bit < (kind == FaultKind::kFlipMosi ? 16U : 1U); ++bit) {
        const bool biss_b = protocol == mb4::Protocol::kBissB;
        FaultyChip chip(biss_b ? biss_b_bus(false) : kEncoder);
        Config one = biss_b ? biss_b_config(false) : encoder(false);
        one.spi_check = SpiCheck::kFull;
        ASSERT_TRUE(chip.device.configure(one).ok());
        Operation op;
        ASSERT_TRUE(chip.device.plan_initialize(op).ok());
        bool faulty = false;
        for (bool ended = false; !ended;) {
          const bool init = op.tx(0)[0] == 0x07 && op.tx(0)[1] == 0x10;
          chip.bus.plan(init ? Fault{kind, 0, 0, bit} : Fault{});
          faulty = faulty || init;
          chip.simulator.advance(op.pause_us() * sim::kPsPerUs);
          const bool transferred = op.run(chip.bus);
          ended = chip.device.finish(op, transferred, chip.clock.now_us());
        }
        ASSERT_TRUE(faulty);
        if (kind == FaultKind::kFlipMosi && bit >= 8 && bit != 11) continue;  // INIT, and more
        const Error error = op.result().error();
        EXPECT_TRUE(error == (kind == FaultKind::kRefused ? Error::kTransport : Error::kCorrupted))
            << mb4::to_string(error) << ", BiSS B " << biss_b << ", bit " << bit;
      }
    }
  }
}

// ---- Configuration, single frames, stop and BREAK, actuators ------------------------------------

TEST_P(DriverOperation, ConfigureAndSingleFrames_AsTheBlockingCalls) {
  FaultyChip chip(kEncoder);
  Operation op;
  ASSERT_TRUE(chip.device.plan_configure(op, config(false)).ok());
  EXPECT_FALSE(chip.device.configured());
  ASSERT_TRUE(complete(chip, op).ok());
  EXPECT_TRUE(chip.device.configured());
  EXPECT_TRUE(chip.device.verify().ok());
  mb4::FrameRead read;
  Frame frame;
  // The first one after a configuration, the second one directly after it, and one after a bad one.
  for (int i = 0; i < 4; ++i) {
    if (i == 2) {
      stick(chip, false);
      ASSERT_TRUE(chip.device.plan_read_all(op, read).ok());
      EXPECT_EQ(complete(chip, op).error(), Error::kLineError);
      EXPECT_EQ(read.result(frame).error(), Error::kLineError);
      EXPECT_FALSE(frame.one_frame);
      stick(chip, std::nullopt);
    }
    ASSERT_TRUE(chip.device.plan_read_all(op, read).ok());
    EXPECT_TRUE(complete(chip, op).ok());
    ASSERT_TRUE(read.result(frame).ok());
    ASSERT_TRUE(frame[1].ok()) << mb4::to_string(frame[1].error());
    EXPECT_EQ(frame[1]->position, 0x2ABCDEFU);
    EXPECT_TRUE(frame.one_frame);
  }
}

TEST_P(DriverOperation, StopAndBreak_EndTheFrames) {
  FaultyChip chip(kEncoder);
  ASSERT_TRUE(chip.device.configure(config(true)).ok());
  Operation op;
  for (const bool by_break : {false, true}) {
    ASSERT_TRUE(chip.device.automatic().plan_start(op).ok());
    ASSERT_TRUE(complete(chip, op).ok());
    chip.simulator.advance(250 * sim::kPsPerUs);
    const std::uint64_t running = chip.simulator.slave(1)->frames();
    EXPECT_GT(running, 0U);
    ASSERT_TRUE(
        (by_break ? chip.device.plan_break(op) : chip.device.automatic().plan_stop(op)).ok());
    ASSERT_TRUE(complete(chip, op).ok());
    EXPECT_FALSE(chip.device.automatic().running());
    chip.simulator.advance(110 * sim::kPsPerUs);
    const std::uint64_t stopped = chip.simulator.slave(1)->frames();
    chip.simulator.advance(500 * sim::kPsPerUs);
    EXPECT_EQ(chip.simulator.slave(1)->frames(), stopped);
  }
}

const std::string kActuator =
    "[[channel]]\nnumber = 1\nmo = true\n[[channel.slave]]\nprotocol = \"biss-c\"\n"
    "data_bits = 16\nactuator = true\n";

Config actuator(bool automatic) {
  Config one = encoder(automatic);
  one.mo = true;
  one.slaves[0].data_bits = 16;
  one.slaves[0].flags = mb4::Flags::kNone;
  one.slaves[0].actuator = true;
  one.slaves[0].stop_bit = true;
  return one;
}

// As in docs/driver.md: the next frame sends the word, and each one after it.
TEST_P(DriverOperation, Actuator_WordIsSent) {
  for (const bool automatic : {false, true}) {
    FaultyChip chip(kActuator);
    Config one = actuator(automatic);
    one.spi_check = GetParam();
    ASSERT_TRUE(chip.device.configure(one).ok());
    Operation op;
    if (automatic) {
      ASSERT_TRUE(chip.device.automatic().plan_start(op).ok());
      ASSERT_TRUE(complete(chip, op).ok());
    }
    for (const std::uint64_t word : {0x1234U, 0xFEDCU, 0x0000U}) {
      ASSERT_TRUE(chip.device.plan_actuator(op, 1, word).ok());
      ASSERT_TRUE(complete(chip, op).ok()) << mb4::to_string(op.result().error());
      for (int i = 0; i < 4; ++i) {
        mb4::FrameRead read;
        if (!automatic) {
          ASSERT_TRUE(chip.device.plan_read_all(op, read).ok());
          ASSERT_TRUE(complete(chip, op).ok());
        }
        chip.simulator.advance(automatic && i == 0 ? 250 * sim::kPsPerUs : 100 * sim::kPsPerUs);
        EXPECT_EQ(clocked(chip.simulator.slave(1))->actuator()->word(), word) << i;
      }
    }
    if (!automatic) continue;
    // A word for each frame, in a loop.
    for (std::uint64_t word = 1; word < 20; ++word) {
      ASSERT_TRUE(chip.device.automatic().plan_actuator(op, 1, word).ok());
      ASSERT_TRUE(complete(chip, op).ok());
      chip.simulator.advance(100 * sim::kPsPerUs);
      const std::uint64_t sent = clocked(chip.simulator.slave(1))->actuator()->word();
      // The frame after the one that runs sends it. The loop is longer than a period.
      EXPECT_TRUE(word < 3 || (sent <= word && sent + 2 >= word)) << sent << " for " << word;
    }
  }
}

// The bus fails at each transfer in turn, for once or from then on; MISO is stuck.
TEST(DriverOperationActuator, FaultOfTheBus_IsToldAndTheBankIsFree) {
  for (const bool automatic : {false, true}) {
    for (const SpiCheck check : {SpiCheck::kOff, SpiCheck::kFull}) {
      for (const FaultKind kind :
           {FaultKind::kRefused, FaultKind::kMisoLow, FaultKind::kMisoHigh, FaultKind::kFlipMosi}) {
        if (check == SpiCheck::kOff && kind != FaultKind::kRefused) continue;
        for (std::size_t at = 0; at < (kind == FaultKind::kRefused ? 3U : 1U); ++at) {
          FaultyChip chip(kActuator);
          Config one = actuator(automatic);
          one.spi_check = check;
          ASSERT_TRUE(chip.device.configure(one).ok());
          if (automatic) {
            ASSERT_TRUE(chip.device.automatic().start().ok());
          }
          Operation op;
          // MOSI: a bit of the word, or of 0xF4.
          const std::size_t last =
              kind == FaultKind::kRefused || kind == FaultKind::kFlipMosi ? at : kForEver;
          chip.bus.plan({kind, at, last, automatic ? 14U : 20U});
          ASSERT_TRUE(chip.device.plan_actuator(op, 1, 0x1234).ok());
          const Error error = complete(chip, op).error();
          const Error want = kind == FaultKind::kRefused    ? Error::kTransport
                             : kind == FaultKind::kFlipMosi ? Error::kCorrupted
                                                            : Error::kNotDetected;
          EXPECT_EQ(error, want) << automatic << " " << static_cast<int>(kind) << " " << at;
          chip.bus.plan({});
          if (!chip.device.configured()) {  // a stuck MISO may hide what has changed the chip
            EXPECT_EQ(error, Error::kNotDetected);
            ASSERT_TRUE(chip.device.configure(one).ok());
            ASSERT_TRUE(!automatic || chip.device.automatic().start().ok());
          }
          ASSERT_TRUE(chip.device.plan_actuator(op, 1, 0x4321).ok());
          EXPECT_TRUE(complete(chip, op).ok());
          if (automatic) {
            chip.simulator.advance(350 * sim::kPsPerUs);
            EXPECT_EQ(clocked(chip.simulator.slave(1))->actuator()->word(), 0x4321U);
          }
        }
      }
    }
  }
}

// A read would free the bank that the actuator holds: the word would be written without HOLDBANK.
TEST(DriverOperationActuator, ReadBetweenItsSteps_IsBusy) {
  for (const SpiCheck check : {SpiCheck::kFull, SpiCheck::kFullAndRelease}) {
    FaultyChip chip(kActuator +
                    "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\ndata = 5\n");
    Config one = actuator(true);
    one.slaves[1] = one.slaves[0];
    one.slaves[1].actuator = one.slaves[1].stop_bit = false;
    one.slaves[1].data_bits = 28;
    one.spi_check = check;
    ASSERT_TRUE(chip.device.configure(one).ok());
    auto automatic = chip.device.automatic();
    ASSERT_TRUE(automatic.start().ok());
    Operation op;
    for (const bool ends : {true, false}) {
      ASSERT_TRUE(automatic.plan_actuator(op, 1, 0x1234).ok());
      mb4::Frame frame;
      mb4::FrameRead read;
      mb4::CyclicRead single;
      chip.bus.plan({});
      std::size_t made = 0;
      do {
        EXPECT_EQ(automatic.poll(frame).error(), Error::kBusy);
        EXPECT_EQ(automatic.plan(read).error(), Error::kBusy);
        EXPECT_EQ(automatic.poll_slave(2).error(), Error::kBusy);
        EXPECT_EQ(automatic.plan_slave(2, single).error(), Error::kBusy);
        EXPECT_EQ(chip.bus.count(), made);
        made += op.frames();
        if (!ends) break;
      } while (!chip.device.finish(op, op.run(chip.bus), chip.clock.now_us()));
      // An actuator that is given up frees the bank, or restart() does.
      if (ends) {
        EXPECT_TRUE(op.result().ok());
      } else {
        EXPECT_TRUE(automatic.restart().ok());
      }
      chip.simulator.advance(250 * sim::kPsPerUs);
      EXPECT_TRUE(automatic.poll(frame).ok());
      EXPECT_TRUE(frame[2].ok());
    }
  }
}

// A loop that ticks with the frames: in each tick a chain for the position, then one step of the
// access. At least 99 % of the ticks bring a position, at each of 25 phases, but one: a read waits
// between the request and its instruction.
TEST_P(DriverOperation, ReadBesideEveryPhase_PositionsGoOn) {
  for (unsigned phase = 0; phase < 25; ++phase) {
    FaultyChip chip(
        "[host]\nsclk_hz = 10_000_000\n[[channel]]\nnumber = 1\n[[channel.slave]]\n"
        "protocol = \"biss-c\"\ndata_bits = 28\nsource = \"ramp\"\nstep = 1\n"
        "control = true\nregisters = { 0x44 = [0x00, 0xD9, 0x01, 0x32] }\n");
    Config one = mb4test::config26(10'000'000);
    one.spi_check = GetParam();
    one.frame_start = mb4::FrameStart::kPeriodic;
    one.frame_period_clk = mb4::frame_period_clk_at_least(one.f_clk_hz, 50'000);
    ASSERT_TRUE(chip.device.configure(one).ok());
    const sim::Time period = one.frame_period_clk * (sim::kPsPerSecond / one.f_clk_hz);
    ASSERT_TRUE(chip.device.automatic().start().ok());
    sim::Time tick = chip.simulator.now() + 2 * period + period * phase / 25;
    mb4::CyclicRead read;
    Operation op;
    std::array<std::uint8_t, 4> serial{};
    ASSERT_TRUE(chip.device.control().plan_read(op, {1, 0}, 0x44, serial).ok());
    unsigned ticks = 0;
    unsigned positions = 0;
    unsigned waits = 0;
    std::uint64_t last = 0;
    for (bool ended = false; !ended; ++ticks) {
      ASSERT_LT(ticks, 500U);
      chip.simulator.run_until(tick);
      tick += period;
      const Error planned = chip.device.automatic().plan_slave(1, read).error();
      ASSERT_TRUE(planned == Error::kNone || planned == Error::kBusy);
      waits += planned == Error::kBusy ? 1 : 0;
      bool transferred = false;
      while (planned == Error::kNone) {
        transferred = read.run(chip.bus);
        if (chip.device.automatic().finish(read, transferred, chip.clock.now_us())) break;
      }
      if (planned == Error::kNone && read.error() == Error::kNone) {
        EXPECT_TRUE(positions == 0 || read.position() > last);
        last = read.position();
        ++positions;
      }
      transferred = op.run(chip.bus);
      ended = chip.device.finish(op, transferred, chip.clock.now_us());
    }
    ASSERT_TRUE(op.result().ok()) << mb4::to_string(op.result().error());
    EXPECT_EQ(serial, (std::array<std::uint8_t, 4>{0x00, 0xD9, 0x01, 0x32}));
    EXPECT_GE(ticks, 80U);
    EXPECT_EQ(waits, 1U);
    EXPECT_GE((positions + 2 + waits) * 100, ticks * 99) << "phase " << phase;
  }
}

// ---- Wrong use ----------------------------------------------------------------------------------

// Every plan call in turn, with good arguments.
constexpr unsigned kKinds = 7;
Result<void> plan(FaultyChip& chip, Operation& op, unsigned kind, mb4::SlaveAddress slave) {
  static std::array<std::uint8_t, 2> bytes;
  switch (kind) {
    case 0:
      return chip.device.automatic().plan_start(op);
    case 1:
      return chip.device.automatic().plan_restart(op);
    case 2:
      return chip.device.plan_verify(op);
    case 3:
      return chip.device.plan_initialize(op);
    case 4:
      return chip.device.control().plan_read(op, slave, 0x44, bytes);
    case 5:
      return chip.device.control().plan_write(op, slave, 0x50, Span<const std::uint8_t>(bytes));
    default:
      return chip.device.control().plan_command(op, activate());
  }
}

TEST(DriverOperationUse, WrongUse_PlansNothing) {
  Operation op;
  FaultyChip chip(kEncoder);
  for (unsigned kind = 0; kind < kKinds; ++kind) {
    EXPECT_EQ(plan(chip, op, kind, {1, 0}).error(), Error::kNotConfigured) << kind;
  }
  prepare(chip, State::kAutomatic);
  EXPECT_EQ(plan(chip, op, 0, {1, 0}).error(), Error::kWrongMode);
  EXPECT_EQ(plan(chip, op, 3, {1, 0}).error(), Error::kWrongMode);
  chip.bus.plan({});
  for (const mb4::SlaveAddress slave : {mb4::SlaveAddress{0, 0}, {3, 0}, {1, 8}, {2, 0}}) {
    EXPECT_EQ(plan(chip, op, 4, slave).error(), Error::kInvalidArgument);
    EXPECT_EQ(plan(chip, op, 5, slave).error(), Error::kInvalidArgument);
  }
  mb4::Command command;
  command.channels = 4;
  EXPECT_EQ(chip.device.control().plan_command(op, command).error(), Error::kInvalidArgument);
  EXPECT_EQ(chip.bus.count(), 0U);
  ASSERT_TRUE(mb4_c::PolledAccess(chip.device).begin_read({1, 0}, 0x44, 1).ok());
  for (unsigned kind = 0; kind < kKinds; ++kind) {
    EXPECT_EQ(plan(chip, op, kind, {1, 0}).error(), kind == 2 ? Error::kNone : Error::kBusy)
        << kind;
  }
  FaultyChip other(kEncoder);
  Config config = encoder(false);
  config.single_bank = true;
  config.frame_start = mb4::FrameStart::kRequireIdleLine;
  ASSERT_TRUE(other.device.configure(config).ok());
  for (const unsigned kind : {0U, 1U, 4U, 5U, 6U}) {
    EXPECT_EQ(plan(other, op, kind, {1, 0}).error(), Error::kUnsupported) << kind;
  }
  EXPECT_EQ(other.device.automatic().restart().error(), Error::kUnsupported);
  FaultyChip biss_b(biss_b_bus(false));
  Config periodic = biss_b_config(false);
  ASSERT_TRUE(biss_b.device.configure(periodic).ok());
  ASSERT_TRUE(biss_b.device.automatic().start().ok());
  const mb4::SlaveAddress slave = mb4::slave_address(periodic, 1);
  EXPECT_EQ(plan(biss_b, op, 4, slave).error(), Error::kWrongMode);
  EXPECT_EQ(plan(biss_b, op, 5, slave).error(), Error::kWrongMode);
}

// The first transfer fails; MISO is stuck from the first one on.
TEST(DriverOperationUse, FaultOfTheBus_EachOperationTellsIt) {
  for (unsigned kind = 0; kind < kKinds; ++kind) {
    for (const FaultKind fault : {FaultKind::kRefused, FaultKind::kMisoLow, FaultKind::kMisoHigh}) {
      FaultyChip chip(kEncoder);
      Config config = encoder(kind == 0 || kind == 1);
      config.spi_check = SpiCheck::kFull;
      ASSERT_TRUE(chip.device.configure(config).ok());
      Operation op;
      chip.bus.plan({fault, 0, kForEver, 0});
      ASSERT_TRUE(plan(chip, op, kind, {1, 0}).ok());
      const Error error = complete(chip, op).error();
      if (fault == FaultKind::kRefused) {
        EXPECT_EQ(error, Error::kTransport) << kind;
      } else if (kind > 1) {  // start and restart read nothing
        EXPECT_TRUE(error == Error::kNotDetected || error == Error::kCorrupted) << kind;
      }
    }
  }
}

// The operations that configure, stop, read single frames and write words.
TEST(DriverOperationUse, WrongUseOfTheOthers_PlansNothing) {
  Operation op;
  Operation busy;
  mb4::FrameRead read;
  FaultyChip chip(kEncoder);
  chip.bus.plan({});
  EXPECT_EQ(chip.device.plan_configure(op, Config()).error(), Error::kInvalidConfig);
  EXPECT_EQ(chip.device.plan_read_all(op, read).error(), Error::kNotConfigured);
  EXPECT_EQ(chip.device.plan_actuator(op, 1, 1).error(), Error::kNotConfigured);
  EXPECT_EQ(chip.device.automatic().plan_actuator(op, 1, 1).error(), Error::kWrongMode);
  EXPECT_EQ(chip.bus.count(), 0U);
  prepare(chip, State::kAutomatic);
  EXPECT_EQ(chip.device.plan_read_all(op, read).error(), Error::kWrongMode);
  EXPECT_EQ(chip.device.plan_actuator(op, 1, 1).error(), Error::kInvalidArgument);
  EXPECT_EQ(chip.device.automatic().plan_actuator(op, 9, 1).error(), Error::kInvalidArgument);
  std::array<std::uint8_t, 1> byte{};
  ASSERT_TRUE(chip.device.control().plan_read(busy, {1, 0}, 0x44, byte).ok());
  EXPECT_EQ(chip.device.automatic().plan_stop(op).error(), Error::kBusy);
  EXPECT_EQ(chip.device.automatic().plan_actuator(op, 1, 1).error(), Error::kBusy);
  EXPECT_EQ(chip.device.plan_actuator(op, 1, 1).error(), Error::kBusy);
  EXPECT_EQ(chip.device.plan_read_all(op, read).error(), Error::kBusy);
  EXPECT_EQ(chip.device.plan_break(busy).error(), Error::kBusy);
  // BREAK ends the access of the other object, which says so.
  ASSERT_TRUE(chip.device.plan_break(op).ok());
  EXPECT_TRUE(complete(chip, op).ok());
  EXPECT_EQ(complete(chip, busy).error(), Error::kWrongMode);
}

// The first transfer fails; MISO is stuck; a part of the configuration is lost.
TEST(DriverOperationUse, FaultOfTheBusInTheOthers_IsTold) {
  const auto run = [](const Fault& fault, unsigned kind) {
    FaultyChip chip(kEncoder);
    Operation op;
    mb4::FrameRead read;
    Config one = encoder(kind == 1);
    one.spi_check = SpiCheck::kFull;
    EXPECT_TRUE(chip.device.configure(one).ok());
    if (kind == 1) {
      EXPECT_TRUE(chip.device.automatic().start().ok());
    }
    chip.bus.plan(fault);
    const Result<void> planned = kind == 0   ? chip.device.plan_configure(op, one)
                                 : kind == 1 ? chip.device.automatic().plan_stop(op)
                                 : kind == 2 ? chip.device.plan_break(op)
                                             : chip.device.plan_read_all(op, read);
    EXPECT_TRUE(planned.ok());
    const Error error = complete(chip, op).error();
    EXPECT_EQ(chip.device.configured(), kind != 0);
    return error;
  };
  for (unsigned kind = 0; kind < 4; ++kind) {
    EXPECT_EQ(run({FaultKind::kRefused, 0, 0, 0}, kind), Error::kTransport) << kind;
  }
  for (const FaultKind stuck : {FaultKind::kMisoLow, FaultKind::kMisoHigh}) {
    EXPECT_EQ(run({stuck, 0, kForEver, 0}, 0), Error::kNotDetected);
    EXPECT_EQ(run({stuck, 0, kForEver, 0}, 3), Error::kNotDetected);
  }
  // 0xC0..0xD1: a bit of the first register.
  EXPECT_EQ(run({FaultKind::kFlipMosi, 1, 1, 17}, 0), Error::kVerify);
}

// Without a system clock nothing ends.
TEST(DriverOperationUse, NoClock_IsTimeout) {
  FaultyChip chip("[chip]\nf_clk_hz = 0\n" + kEncoder);
  ASSERT_TRUE(chip.device.configure(encoder(false)).ok());
  Operation op;
  for (const unsigned kind : {4U, 5U, 6U}) {
    ASSERT_TRUE(plan(chip, op, kind, {1, 0}).ok());
    EXPECT_EQ(complete(chip, op).error(), Error::kTimeout) << kind;
  }
}

// The slave has no register 0x50; no slave has ID 5; nobody acknowledges the command to ID 3.
TEST(DriverOperationUse, SlaveRefuses_IsTold) {
  FaultyChip chip(
      "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\n"
      "data_bits = 28\ncontrol = true\nmissing = [0x50]\n");
  prepare(chip, State::kAutomatic);
  Operation op;
  for (const unsigned kind : {4U, 5U}) {
    ASSERT_TRUE(plan(chip, op, kind, {1, 5}).ok());
    EXPECT_EQ(complete(chip, op).error(), Error::kRegister);
  }
  std::array<std::uint8_t, 2> bytes{};
  ASSERT_TRUE(chip.device.control().plan_read(op, {1, 0}, 0x4F, bytes).ok());
  EXPECT_EQ(complete(chip, op).error(), Error::kRegisterDelay);
  EXPECT_EQ(op.result().info().bytes(), 1);
  ASSERT_TRUE(
      chip.device.control().plan_write(op, {1, 0}, 0x4F, Span<const std::uint8_t>(bytes)).ok());
  EXPECT_EQ(complete(chip, op).error(), Error::kRegisterDelay);
  mb4::Command command = activate();
  command.ids = 0x08;
  ASSERT_TRUE(chip.device.control().plan_command(op, command).ok());
  EXPECT_EQ(complete(chip, op).error(), Error::kCommand);
}

// ---- Faults of the bus --------------------------------------------------------------------------

// Each transfer refused, and each one made but reported as failed: an error, and afterwards the
// chip works. Only SVALID = 0 behind the access may fail without one.
TEST_P(DriverOperation, EachTransferFails_IsTransportAndTheChipGoesOn) {
  for (const FaultKind kind : {FaultKind::kRefused, FaultKind::kFailedAfter}) {
    for (std::size_t index = 0; index < 400; index += index < 8 ? 1 : 13) {
      FaultyChip chip(kEncoder);
      ASSERT_TRUE(chip.device.configure(config(false)).ok());
      Operation op;
      std::array<std::uint8_t, 2> out{};
      chip.bus.plan({kind, index, index, 0});
      ASSERT_TRUE(chip.device.control().plan_read(op, {1, 0}, 0x45, out).ok());
      const Error error =
          complete(chip, op, [&] { chip.simulator.advance(10 * sim::kPsPerUs); }).error();
      const bool met = chip.bus.count() > index;
      EXPECT_TRUE(error == Error::kNone || (met && error == Error::kTransport)) << index;
      if (error == Error::kNone) {
        EXPECT_EQ(out[0], 0xD9);
      }
      chip.bus.plan({});
      EXPECT_TRUE(chip.device.read_frame().ok()) << index;
      EXPECT_TRUE(chip.device.control().read_registers({1, 0}, 0x44, buffer).ok()) << index;
      if (!met) break;
    }
  }
}

// SpiCheck::kFull: no single disturbed transfer and no stuck line makes a wrong register, nor a
// good result of an operation that has not been made.
TEST(DriverOperationFault, AnyFault_NoWrongRegisterAndNoFalseSuccess) {
  std::vector<std::size_t> bits;
  const auto run = [&](const Fault& fault, bool write) {
    FaultyChip chip(kEncoder);
    EXPECT_TRUE(chip.device.configure(encoder(true)).ok());
    EXPECT_TRUE(chip.device.automatic().start().ok());
    Operation op;
    std::array<std::uint8_t, 2> out{};
    const std::array<std::uint8_t, 2> data{0xA7, 0x3C};
    chip.bus.plan(fault);
    EXPECT_TRUE((write ? chip.device.control().plan_write(op, {1, 0}, 0x50, data)
                       : chip.device.control().plan_read(op, {1, 0}, 0x45, out))
                    .ok());
    const Result<void> done =
        complete(chip, op, [&] { chip.simulator.advance(1'500 * sim::kPsPerUs); });
    bits = chip.bus.bits();
    if (done && write) {
      EXPECT_EQ(chip.simulator.slave(1)->reg_read(0x50), 0xA7) << fault.text();
      EXPECT_EQ(chip.simulator.slave(1)->reg_read(0x51), 0x3C) << fault.text();
    } else if (done) {
      EXPECT_EQ(out, (std::array<std::uint8_t, 2>{0xD9, 0x01})) << fault.text();
    }
    EXPECT_EQ(chip.simulator.slave(1)->reg_read(0x45), 0xD9) << fault.text();
    // Afterwards the chip works. A lost BREAK is repeated by the restart.
    chip.bus.plan({});
    if (!chip.device.configured()) {  // MISO was stuck where the configuration was compared
      EXPECT_TRUE(chip.device.configure(encoder(true)).ok()) << fault.text();
    }
    EXPECT_TRUE(chip.device.automatic().restart().ok()) << fault.text();
    chip.simulator.advance(250 * sim::kPsPerUs);
    EXPECT_TRUE(chip.device.automatic().poll_slave(1).ok()) << fault.text();
    return done;
  };
  for (const bool write : {false, true}) {
    ASSERT_TRUE(run({}, write).ok());
    EXPECT_LT(bits.size(), 40U);
    for (const Fault& fault : all_faults(bits, 17)) static_cast<void>(run(fault, write));
  }
}

}  // namespace
