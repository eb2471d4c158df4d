// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Faults of the SPI bus, on the Verilated chip: with SpiCheck::kFull every single disturbed
// transfer, in each bit of both directions, and every bus that is stuck from some transfer on,
// gives an error or the right position, never a wrong or an old one. The encoder sends another word
// in each frame, so that each position tells the frame that it comes from.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "drivers/c/mb4_c_access.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/driver/rtl/fault_bus.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4::Config;
using mb4::Error;
using mb4::Frame;
using mb4test::all_faults;
using mb4test::Fault;
using mb4test::FaultKind;
using mb4test::FaultyChip;
using mb4test::kForEver;

// How positions are read.
enum class Way : std::uint8_t { kSingle, kAll, kPoll, kPollSlave, kNext, kPollBeside, kPollUnheld };

struct Setup {
  std::string name;
  Way way;
  unsigned data_bits;
  std::uint32_t crc;
  std::uint8_t slave;  // 1, or 2 behind another one
  mb4::Protocol protocol = mb4::Protocol::kBissC;
  mb4::SpiCheck check = mb4::SpiCheck::kFull;
  unsigned period_us = 50;  // of automatic frames
};

std::string scenario(const Setup& setup) {
  const std::string first =
      "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 9\nflag_bits = 0\ndata = 0x155\n";
  std::string keys = "biss-c\"\ncontrol = true";
  if (setup.protocol == mb4::Protocol::kBissB) keys = "biss-b\"\ntimeout = 2";
  if (setup.protocol == mb4::Protocol::kSsi) keys = "ssi\"\ntimeout = 2\ngray = true";
  // Then a read fits between two frames.
  const std::string fast = setup.period_us == 50 ? "" : "[host]\nsclk_hz = 10_000_000\n";
  return fast + "[[channel]]\nnumber = 1\n" + (setup.slave == 2 ? first : std::string()) +
         "[[channel.slave]]\nprotocol = \"" + keys +
         "\nflag_bits = 0\nsource = \"ramp\"\nstart = 0\nstep = 1\ndata_bits = " +
         std::to_string(setup.data_bits) + "\ncrc = " + std::to_string(setup.crc) + "\n";
}

Config config(const Setup& setup) {
  Config config = mb4test::config26(10'000'000);
  config.slaves[setup.slave - 1] = config.slaves[0];
  if (setup.slave == 2) {
    config.slaves[0].data_bits = 9;
    config.slaves[0].flags = mb4::Flags::kNone;
  }
  mb4::SlaveConfig& slave = config.slaves[setup.slave - 1];
  slave.data_bits = static_cast<std::uint8_t>(setup.data_bits);
  slave.flags = mb4::Flags::kNone;
  slave.crc_polynomial = setup.crc;
  slave.gray = setup.protocol == mb4::Protocol::kSsi;
  config.channels[0].protocol = setup.protocol;
  if (setup.way != Way::kSingle && setup.way != Way::kAll) {
    config.frame_start = mb4::FrameStart::kPeriodic;
    config.frame_period_clk = 20 * setup.period_us;
  }
  config.hold_beside_access = setup.way != Way::kPollUnheld;
  config.spi_check = setup.check;
  return config;
}

// One drive: reads, and tells wrong from right.
class Drive {
 public:
  explicit Drive(const Setup& setup) : setup_(setup), chip(scenario(setup)) {
    EXPECT_TRUE(chip.device.configure(config(setup)).ok());
    if (automatic()) {
      EXPECT_TRUE(chip.device.automatic().start().ok());
    }
    EXPECT_TRUE(read().has_value());
    if (setup.way == Way::kPollBeside || setup.way == Way::kPollUnheld) {
      // The last register of many: frames for as long as the test needs.
      EXPECT_TRUE(mb4_c::PolledAccess(chip.device).begin_read({1, 0}, 0x00, 64).ok());
      EXPECT_TRUE(read().has_value());
    }
  }

  // One read, at once or a frame later. The position, if there is one; checks that it is right and
  // new.
  std::optional<std::uint64_t> read(bool at_once = false) {
    const std::uint64_t before = frames();
    if (automatic() && setup_.way != Way::kNext && !at_once) {
      chip.simulator.advance((setup_.period_us + 10) * mb4::sim::kPsPerUs);
    }
    const mb4::Result<mb4::Reading> reading = call();
    if (!reading) {
      EXPECT_NE(reading.error(), Error::kInvalidArgument);
      return {};
    }
    const std::uint64_t word = reading->raw;
    // The frame whose number it is has been sent, ...
    EXPECT_LT(word, frames());
    if (automatic()) {
      EXPECT_TRUE(!last_ || word > *last_) << "old: " << word << " after " << *last_;
      // Frames run on while the bank is held (decision 15), up to the end of a call with faults.
      EXPECT_LE(frames() - word, 8U) << "old: " << word << " of " << frames();
    } else {
      EXPECT_GE(word, before) << "older than the request";
    }
    last_ = word;
    return word;
  }

  // All steps of `op`, a read before each; the one before step `at` is `disturbed`.
  template <typename Read>
  bool finish(mb4::Operation& op, unsigned at, Read disturbed) {
    for (unsigned i = 0; i < 300; ++i) {
      chip.bus.plan({});
      if (i == at) {
        disturbed();
      } else {
        read();
      }
      chip.bus.plan({});
      if (chip.device.finish(op, op.run(chip.bus), chip.clock.now_us())) return true;
    }
    return false;
  }

  [[nodiscard]] bool automatic() const {
    return setup_.way != Way::kSingle && setup_.way != Way::kAll;
  }
  [[nodiscard]] std::uint64_t frames() const {
    return chip.simulator.slave(setup_.slave)->frames();
  }

 private:
  mb4::Result<mb4::Reading> from(const mb4::Result<void>& done, const Frame& frame) const {
    return done ? frame[setup_.slave] : mb4::Result<mb4::Reading>(done.info());
  }

  mb4::Result<mb4::Reading> call() {
    Frame frame;
    switch (setup_.way) {
      case Way::kSingle:
        return chip.device.read_frame(setup_.slave);
      case Way::kAll:
        return from(chip.device.read_all(frame), frame);
      case Way::kPoll:
        return from(chip.device.automatic().poll(frame), frame);
      case Way::kNext:
        return from(chip.device.automatic().next(frame), frame);
      default:
        return chip.device.automatic().poll_slave(setup_.slave);
    }
  }

  Setup setup_;
  std::optional<std::uint64_t> last_;

 public:
  FaultyChip chip;
};

class DriverFault : public testing::TestWithParam<Setup> {};

// The fault hits one read; three more reads follow, the second with a line that is stuck low, so
// that no frame can replace what an unnoticed fault has left behind.
TEST_P(DriverFault, EveryFault_NeverAWrongOrOldPosition) {
  std::vector<std::size_t> bits;
  {
    Drive good(GetParam());
    good.chip.bus.plan({});
    ASSERT_TRUE(good.read().has_value());
    bits = good.chip.bus.bits();
  }
  unsigned unnoticed = 0;
  unsigned recovered = 0;
  // All of them take a minute a way; the long run is for the night.
  const bool all = std::getenv("MB4_ALL_FAULTS") != nullptr;
  const std::vector<Fault> faults = all_faults(bits, all ? 1 : 23);
  for (const Fault& fault : faults) {
    SCOPED_TRACE(fault.text());
    Drive run(GetParam());
    run.chip.bus.plan(fault);
    unnoticed += run.read().has_value() ? 1 : 0;
    if (GetParam().way == Way::kPollSlave || GetParam().way == Way::kPollBeside) {
      EXPECT_LE(run.chip.bus.count(), mb4::kMaxPollSlaveTransfersChecked +
                                          (GetParam().check == mb4::SpiCheck::kFull ? 0 : 1));
    }
    if (GetParam().way == Way::kPollUnheld) {
      EXPECT_LE(run.chip.bus.count(), 12U);
    }
    if (fault.last == kForEver) {
      run.read();
      run.read();
    }
    run.chip.bus.plan({});
    clocked(run.chip.simulator.line(1))->faults().stick(false);
    run.chip.simulator.refresh_lines();
    run.read();
    clocked(run.chip.simulator.line(1))->faults().stick(std::nullopt);
    run.chip.simulator.refresh_lines();
    run.read();
    bool good = run.read().has_value();
    // What a fault has changed in the configuration is found, and mended by configuring again.
    if (!good) {
      EXPECT_TRUE(run.chip.device.configure(config(GetParam())).ok());
      if (run.automatic()) {
        EXPECT_TRUE(run.chip.device.automatic().start().ok());
      }
      good = run.read().has_value();
      // A slave of BiSS B that an INIT has put into register mode holds SL low: the read says
      // kLineError, and restart() waits for its timeout.
      if (!good && run.automatic()) {
        EXPECT_TRUE(run.chip.device.automatic().restart().ok());
        good = run.read().has_value();
      }
    } else {
      ++recovered;
    }
    EXPECT_TRUE(good) << "does not come back";
    if (HasFailure()) break;
  }
  std::printf("%s: %zu transfers, %zu faults, %u without effect on the read, %u recover alone\n",
              GetParam().name.c_str(), bits.size(), faults.size(), unnoticed, recovered);
}

INSTANTIATE_TEST_SUITE_P(
    Ways, DriverFault,
    testing::Values(Setup{"Single26Crc6", Way::kSingle, 26, 0x43, 1},
                    Setup{"Single40NoCrc", Way::kSingle, 40, 0, 1},
                    Setup{"Single64Crc16", Way::kSingle, 64, 0x190D9, 1},
                    Setup{"All26Crc6", Way::kAll, 26, 0x43, 2},
                    Setup{"Poll26Crc6", Way::kPoll, 26, 0x43, 1},
                    Setup{"Next26Crc6", Way::kNext, 26, 0x43, 1},
                    Setup{"PollSlave26Crc6", Way::kPollSlave, 26, 0x43, 1},
                    Setup{"PollSlave64Crc16Slave2", Way::kPollSlave, 64, 0x190D9, 2},
                    Setup{"PollSlave26Release", Way::kPollSlave, 26, 0x43, 1, mb4::Protocol::kBissC,
                          mb4::SpiCheck::kFullAndRelease},
                    Setup{"Poll26Release", Way::kPoll, 26, 0x43, 1, mb4::Protocol::kBissC,
                          mb4::SpiCheck::kFullAndRelease},
                    Setup{"Next26Release", Way::kNext, 26, 0x43, 1, mb4::Protocol::kBissC,
                          mb4::SpiCheck::kFullAndRelease},
                    Setup{"PollSlave26BesideRelease", Way::kPollBeside, 26, 0x43, 1,
                          mb4::Protocol::kBissC, mb4::SpiCheck::kFullAndRelease},
                    Setup{"PollSlave26UnheldRelease", Way::kPollUnheld, 26, 0x43, 1,
                          mb4::Protocol::kBissC, mb4::SpiCheck::kFullAndRelease},
                    Setup{"PollSlave26Beside", Way::kPollBeside, 26, 0x43, 1},
                    Setup{"PollSlave26Unheld", Way::kPollUnheld, 26, 0x43, 1},
                    Setup{"SingleBissB", Way::kSingle, 26, 0x43, 1, mb4::Protocol::kBissB},
                    Setup{"PollSlaveBissB", Way::kPollSlave, 26, 0x43, 1, mb4::Protocol::kBissB},
                    Setup{"SingleSsi", Way::kSingle, 25, 0, 1, mb4::Protocol::kSsi},
                    Setup{"PollSlaveSsi", Way::kPollSlave, 25, 0x43, 1, mb4::Protocol::kSsi}),
    [](const auto& test) { return test.param.name; });

constexpr unsigned kNever = 1000;  // no step has this number

const Setup kRelease{
    "", Way::kPollSlave, 26, 0x43, 1, mb4::Protocol::kBissC, mb4::SpiCheck::kFullAndRelease, 100};

// A read comes so late that a frame is lost, and a bit of a byte for 0xF4 is flipped: HOLDBANK, or
// the release of a read without or with a new word. Only kFullAndRelease finds SWBANK = 1: the
// other bank holds the word that nobody has read.
TEST(DriverFaultRelease, LateAndFlipped_NeverAnOldPosition) {
  for (unsigned at = 0; at < 10 * 3 * 8; ++at) {
    Drive run(kRelease);
    run.chip.bus.plan({});
    run.read();
    std::size_t release = run.chip.bus.opcodes().size() - 1;  // the last 0x07 of a good read
    while (run.chip.bus.opcodes()[release] != 0x07) --release;
    const unsigned late_us = 60 + at % 10 * 10;
    const unsigned where = at / 10 % 3;
    const std::size_t transfer = std::array<std::size_t, 3>{0, 2, release}[where];
    const std::size_t bit = 8 + at / 30;
    SCOPED_TRACE(std::to_string(late_us) + " us late, transfer " + std::to_string(transfer) +
                 ", bit " + std::to_string(bit));
    run.chip.simulator.advance(late_us * mb4::sim::kPsPerUs);
    if (where == 1) {  // the flip meets a second read, which finds no new word
      run.read();
      run.chip.bus.plan({FaultKind::kFlipMosi, transfer, transfer, bit});
      run.read(true);
    } else {
      run.chip.bus.plan({FaultKind::kFlipMosi, transfer, transfer, bit});
      run.read();
    }
    run.chip.bus.plan({});
    for (unsigned i = 0; i < 4; ++i) run.read();
  }
}

// The same bit in the byte that holds the bank: the release swaps the banks back, and a frame may
// have ended meanwhile. At each microsecond of more than one period.
TEST(DriverFaultRelease, SwapWhileTheBankIsHeld_NeverAnOldPosition) {
  for (const mb4::SpiCheck check : {mb4::SpiCheck::kFull, mb4::SpiCheck::kFullAndRelease}) {
    for (unsigned late_us = 90; late_us < 220; ++late_us) {
      SCOPED_TRACE("check " + std::to_string(static_cast<int>(check)) + ", " +
                   std::to_string(late_us) + " us late");
      auto setup = kRelease;
      setup.check = check;
      Drive run(setup);
      run.chip.simulator.advance(late_us * mb4::sim::kPsPerUs);
      run.read();
      run.chip.simulator.advance((late_us - 60) / 2 * mb4::sim::kPsPerUs);
      run.chip.bus.plan({FaultKind::kFlipMosi, 0, 0, 10});
      run.read(true);
      run.chip.bus.plan({});
      for (unsigned i = 0; i < 4; ++i) run.read(i == 0);
    }
  }
}

// 0x03 and 0x07 differ in one bit: the reading of a word is an instruction then, and its second
// byte on MOSI goes to 0xF5, where it must not force MA. Without a CRC nothing would tell that the
// words behind it are none of the encoder.
TEST(DriverFaultOpcode, ReadThatIsAnInstruction_ForcesNoLine) {
  constexpr std::uint64_t kWord = 0x12C3456;
  const auto encoder = [](const std::string& keys) {
    return "[[channel.slave]]\n" + keys +
           "flag_bits = 0\ndata_bits = 25\ncrc = 0\ndata = " + std::to_string(kWord) + "\n";
  };
  for (const bool ssi : {true, false}) {
    const std::string one =
        encoder(ssi ? "protocol = \"ssi\"\ntimeout = 2\n" : "protocol = \"biss-c\"\n");
    const std::string between = ssi ? "[[channel]]\nnumber = 2\n" : "";
    const std::uint8_t slave = ssi ? 5 : 2;
    Config config;
    config.ma_hz = 10'000'000;
    for (mb4::ChannelConfig& channel : config.channels) {
      channel.protocol = ssi ? mb4::Protocol::kSsi : mb4::Protocol::kBissC;
    }
    if (!ssi) config.channels[1].protocol = mb4::Protocol::kUnused;
    for (const unsigned number : {1U, unsigned{slave}}) {
      config.slaves[number - 1] = {true, 25, mb4::Flags::kNone, 0};
    }
    config.frame_start = mb4::FrameStart::kPeriodic;
    config.frame_period_clk = mb4::frame_period_clk_at_least(config.f_clk_hz, 200'000);
    // Each reading of the word, at several instants of a frame.
    for (std::size_t hit = 0; hit < 8; ++hit) {
      for (unsigned late_us = 0; late_us < 200; late_us += 23) {
        FaultyChip chip("[host]\nsclk_hz = 10_000_000\n[[channel]]\nnumber = 1\n" + one + between +
                        one);
        ASSERT_TRUE(chip.device.configure(config).ok());
        ASSERT_TRUE(chip.device.automatic().start().ok());
        chip.simulator.advance((300 + late_us) * mb4::sim::kPsPerUs);
        for (unsigned i = 0; i < 20; ++i) {
          chip.bus.plan(i == 1 ? Fault{FaultKind::kFlipMosi, hit, hit, 5} : Fault{});
          const mb4::Result<mb4::Reading> reading = chip.device.automatic().poll_slave(slave);
          if (i == 1 && (hit >= chip.bus.count() || chip.bus.opcodes()[hit] != 0x03)) break;
          if (reading) {
            ASSERT_EQ(reading->position, kWord)
                << "ssi " << ssi << ", transfer " << hit << ", " << late_us << " us, read " << i;
          }
          chip.simulator.advance(200 * mb4::sim::kPsPerUs);
        }
      }
    }
  }
}

// A read between two steps of an access starts the access before once more, by INSTR = 100 in the
// 0x07 that releases the bank. No other register of the encoder is written, and the access has
// failed or has done what it says.
TEST(DriverFaultRelease, StrayAccessBetweenSteps_IsNotTakenForTheNewOne) {
  for (const bool writes : {true, false}) {
    for (unsigned before = 0; before < 8; ++before) {
      SCOPED_TRACE(std::string(writes ? "write" : "read") + ", after " + std::to_string(before) +
                   " steps");
      Drive run(kRelease);
      mb4::sim::Slave& slave = *run.chip.simulator.slave(1);
      std::uint8_t value = 0x11;
      mb4::Operation op;
      const auto access = [&](std::uint8_t address, unsigned at) {
        EXPECT_TRUE(
            writes ? run.chip.device.control().plan_write(op, {1, 0}, address, {&value, 1}).ok()
                   : run.chip.device.control().plan_read(op, {1, 0}, address, {&value, 1}).ok());
        EXPECT_TRUE(run.finish(op, at, [&run] {
          run.read();
          // The release is the third transfer of a read that finds no new word.
          run.chip.bus.plan({FaultKind::kFlipMosi, 2, 2, 12});
          run.read(true);
        }));
        return op.result().ok();
      };
      slave.reg_write(0x20, 0x20);
      slave.reg_write(0x30, 0x30);
      EXPECT_TRUE(access(0x20, kNever));
      value = 0x33;
      const bool done = access(0x30, before);
      run.chip.simulator.advance(20'000 * mb4::sim::kPsPerUs);  // the stray one ends too
      EXPECT_EQ(slave.reg_read(0x20), writes ? 0x11 : 0x20);
      if (done) {
        EXPECT_EQ(writes ? slave.reg_read(0x30) : value, writes ? 0x33 : 0x30);
      }
    }
  }
}

// A status comes before the next byte of 0xF4.
bool looks(const mb4::Operation& op) {
  for (unsigned i = 0; i < op.frames(); ++i) {
    if (op.tx(i)[0] == 0x07) return false;
    if (op.tx(i)[0] == 0x05) return true;
  }
  return false;
}

// With kFull nothing proves the release of the bank. One bit of it swaps the banks (SWBANK),
// shortly after a frame that was lost, so that the other bank holds a word that nobody has read.
// Each operation whose next step looks at the status sees the bit.
TEST(DriverFaultRelease, SwapSeenByAnOperation_NeverAnOldPosition) {
  auto setup = kRelease;
  setup.check = mb4::SpiCheck::kFull;
  for (const char* const kind : {"read", "write", "verify"}) {
    unsigned seen = 0;
    bool more = true;
    for (unsigned before = 0; more; ++before) {
      bool polls = false;  // one time is enough for each of many
      for (unsigned i = 0; i < (polls ? 1U : 10U); ++i) {
        const unsigned late_us = 60 + (before + i) % 10 * 10;
        SCOPED_TRACE(std::string(kind) + ", after " + std::to_string(before) + " steps, " +
                     std::to_string(late_us) + " us late");
        Drive run(setup);
        std::array<std::uint8_t, 2> values{0x12, 0x34};
        for (std::uint8_t k = 0; k < 2; ++k) {  // zeros would be looked at more closely
          run.chip.simulator.slave(1)->reg_write(static_cast<std::uint8_t>(0x30 + k), values[k]);
        }
        mb4::Operation op;
        const auto plan = [&] {
          auto control = run.chip.device.control();
          return *kind == 'v'   ? run.chip.device.plan_verify(op)
                 : *kind == 'r' ? control.plan_read(op, {1, 0}, 0x30, values)
                                : control.plan_write(op, {1, 0}, 0x30, values);
        };
        ASSERT_TRUE(plan().ok());  // an access has ended before
        EXPECT_TRUE(run.finish(op, kNever, [] {}));
        ASSERT_TRUE(plan().ok());
        more = false;
        EXPECT_TRUE(run.finish(op, before, [&] {
          more = true;
          polls = op.tx(0)[0] == 0x05;
          if (looks(op)) {
            ++seen;
            run.chip.simulator.advance(late_us * mb4::sim::kPsPerUs);
            run.chip.bus.plan({FaultKind::kFlipMosi, 6, 6, 10});
          }
          run.read();
        }));
        EXPECT_TRUE(op.result().ok());
        for (unsigned k = 0; k < 3; ++k) run.read();
      }
    }
    EXPECT_GE(seen, *kind == 'v' ? 10U : 50U);
  }
}

// The 0x02 that clears SVALID goes to another address, between two steps of a write: to the request
// or the data of the access, too. Only the register that is meant is written, or none.
TEST(DriverFaultRelease, SvalidGoesElsewhereBetweenSteps_OnlyTheRegisterMeantIsWritten) {
  for (const mb4::SpiCheck check : {mb4::SpiCheck::kFull, mb4::SpiCheck::kFullAndRelease}) {
    for (unsigned at = 0; at < 5 * 8; ++at) {
      const unsigned before = at / 8;
      const std::size_t bit = 8 + at % 8;
      SCOPED_TRACE("check " + std::to_string(static_cast<int>(check)) + ", after " +
                   std::to_string(before) + " steps, bit " + std::to_string(bit));
      auto setup = kRelease;
      setup.check = check;
      Drive run(setup);
      mb4::sim::Slave& slave = *run.chip.simulator.slave(1);
      std::array<std::uint8_t, 128> registers{};
      for (unsigned i = 0; i < registers.size(); ++i) {
        registers[i] = slave.reg_read(static_cast<std::uint8_t>(i));
      }
      const std::uint8_t value = 0x33;
      mb4::Operation op;
      ASSERT_TRUE(run.chip.device.control()
                      .plan_write(op, {1, 0}, 0x30, mb4::Span<const std::uint8_t>(&value, 1))
                      .ok());
      EXPECT_TRUE(run.finish(op, before, [&run, bit] {
        run.chip.bus.plan({FaultKind::kFlipMosi, 4, 4, bit});
        run.read();
      }));
      run.chip.simulator.advance(20'000 * mb4::sim::kPsPerUs);
      for (unsigned i = 0; i < registers.size(); ++i) {
        const std::uint8_t now = slave.reg_read(static_cast<std::uint8_t>(i));
        if (i == 0x30) {
          EXPECT_TRUE(now == value || (now == registers[i] && !op.result().ok()));
        } else {
          EXPECT_EQ(now, registers[i]) << "register " << i;
        }
      }
    }
  }
}

}  // namespace
