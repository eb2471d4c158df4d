// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// A drive on the Verilated chip for the sweeps over single faults of the bus: it brings the chip
// into a state, makes one call with a fault, reads on, and judges all that was handed out. What is
// right comes from the encoders alone: the words that each one has sent, by frame, its registers,
// and whether it still sends.

#ifndef TESTS_DRIVER_RTL_SWEEP_RIG_HPP_
#define TESTS_DRIVER_RTL_SWEEP_RIG_HPP_

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "drivers/c/mb4_c_access.hpp"
#include "mb4/mb4.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/lines/clocked/actuator.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/registers/control_slave.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/driver/rtl/c99_read.hpp"
#include "tests/driver/rtl/mean_bus.hpp"

namespace mb4test {

namespace sim = mb4::sim;
using mb4::Config;
using mb4::Error;
using mb4::Result;
using mb4::SpiCheck;

// How positions are read.
enum class Way : std::uint8_t {
  kReadFrame,
  kReadAll,
  kPlanReadAll,
  kPollSlave,
  kPoll,
  kNext,
  kPlanSlave,
  kPlan,
  kC99,
  kCount,
};
inline const char* to_string(Way way) {
  constexpr const char* kNames[] = {"read_frame", "read_all", "plan_read_all",
                                    "poll_slave", "poll",     "next",
                                    "plan_slave", "plan",     "mb4_cyclic"};
  return kNames[static_cast<unsigned>(way)];
}
inline bool is_single(Way way) { return way <= Way::kPlanReadAll; }
inline bool is_of_one(Way way) {
  return way == Way::kReadFrame || way == Way::kPollSlave || way == Way::kPlanSlave;
}

// What is on the bus.
enum class Bus : std::uint8_t {
  kOne,       // one encoder, 28 bits, CRC of 6 bits
  kTwo,       // two of them
  kEight,     // eight, 24 bits
  kNoCrc,     // one of 40 bits without a CRC
  kLong,      // one of 64 bits, whose CRC of 16 bits the chip has no room for
  kChannels,  // one on each channel
  kBissB,
  kSsi,       // Gray code and a CRC
  kActuator,  // an actuator, and one encoder behind it
  kCount,
};
inline const char* to_string(Bus bus) {
  constexpr const char* kNames[] = {"One",      "Two",   "Eight", "NoCrc",   "Long",
                                    "Channels", "BissB", "Ssi",   "Actuator"};
  return kNames[static_cast<unsigned>(bus)];
}

// What has happened before the call.
enum class Before : std::uint8_t {
  kFresh,
  kRead,        // a register was read
  kWrite,       // a register was written, and the encoder has changed it since
  kCommand,     // addressed command 00, which switches data on
  kBeside,      // two registers are being written
  kNothingNew,  // the last frame has been read just before the call
  kBadBefore,   // the same, and its word has come with a wrong CRC
  kBadNow,      // the next frame's word comes with a wrong CRC
  kCount,
};
inline bool is_bad(Before before) { return before >= Before::kBadBefore; }
inline const char* to_string(Before before) {
  constexpr const char* kNames[] = {
      "fresh",       "after a read",      "after a write", "after a command", "beside an access",
      "nothing new", "a bad word before", "a bad word now"};
  return kNames[static_cast<unsigned>(before)];
}

inline const char* to_string(SpiCheck check) {
  constexpr const char* kNames[] = {"kOff", "kCrc", "kFull", "kFullAndRelease"};
  return kNames[static_cast<unsigned>(check)];
}

// The other calls.
enum class Act : std::uint8_t {
  kNone,
  kStart,
  kStop,
  kRestart,
  kVerify,
  kConfigure,
  kReset,
  kInitialize,
  kBreak,
  kReadRegisters,
  kWriteRegisters,
  kSend,
  kBeginRead,  // begin_read(), poll() and take(), with reads of positions between them
  kBeginWrite,
  kBeginCommand,
  kWriteActuator,
  kWriteNextActuator,  // Automatic::write_actuator()
  kPlanStart,          // in steps, with reads of positions between them where frames run
  kPlanRestart,
  kPlanVerify,
  kPlanConfigure,
  kPlanInitialize,
  kPlanRead,
  kPlanWrite,
  kPlanCommand,
  kPlanActuator,
  kReadBesideVerify,  // plan_verify() begins before the access, and goes on beside it
  kWriteBesideVerify,
  kActivate,
  kPlanActivate,
  kCount,
};
inline const char* to_string(Act act) {
  constexpr const char* kNames[] = {"none",
                                    "start",
                                    "stop",
                                    "restart",
                                    "verify",
                                    "configure",
                                    "reset",
                                    "initialize",
                                    "break",
                                    "read_registers",
                                    "write_registers",
                                    "send",
                                    "begin_read",
                                    "begin_write",
                                    "begin_command",
                                    "write_actuator",
                                    "automatic().write_actuator",
                                    "plan_start",
                                    "plan_restart",
                                    "plan_verify",
                                    "plan_configure",
                                    "plan_initialize",
                                    "plan_read",
                                    "plan_write",
                                    "plan_command",
                                    "plan_actuator",
                                    "plan_read beside plan_verify",
                                    "plan_write beside plan_verify",
                                    "activate",
                                    "plan_activate"};
  return kNames[static_cast<unsigned>(act)];
}

struct Setup {
  Way way = Way::kPollSlave;
  Bus bus = Bus::kOne;
  Before before = Before::kFresh;
  SpiCheck check = SpiCheck::kFull;
  bool omits = false;    // AGSERR_ON_HOLDBANK
  Act act = Act::kNone;  // the disturbed call; kNone: a read of positions
  // What is read and written is 0, which is what the chip answers where it is not asked.
  bool zeros = false;
  bool unheld = false;  // Config::hold_beside_access = false
  // Milliseconds pass between the steps of an operation, and then positions are read.
  bool slow = false;

  [[nodiscard]] std::string text() const {
    return (act != Act::kNone ? std::string(mb4test::to_string(act)) + ", " : std::string()) +
           std::string(mb4test::to_string(way)) + ", " + mb4test::to_string(bus) + ", " +
           mb4test::to_string(before) + ", " + mb4test::to_string(check) +
           (omits ? ", omits" : ", overwrites") + (zeros ? ", zeros" : "") +
           (unheld ? ", unheld" : "") + (slow ? ", slow" : "");
  }
};

inline bool activates(Act act) { return act == Act::kActivate || act == Act::kPlanActivate; }

// What came out of a case, the worst last.
enum class Verdict : std::uint8_t {
  kRight,      // no call shows the fault
  kTold,       // an error
  kHidden,     // a new word was not there: kNoData
  kUncounted,  // a sample was lost and not counted
  kDead,       // no position comes back, and no call says why
  kUntrue,     // a control call has succeeded and not done what it says
  kOld,        // an old position as new
  kWrong,      // a position that the encoder has not sent
  kRegister,   // a register of an encoder was written that no call named
  kOff,        // an encoder is switched off, and no call says kNoWord
  kStopped,    // the program has stopped
  kCount,
};
inline constexpr unsigned kVerdicts = static_cast<unsigned>(Verdict::kCount);
inline const char* to_string(Verdict verdict) {
  constexpr const char* kNames[] = {"right", "told",  "hidden",   "not counted", "dead",   "untrue",
                                    "old",   "wrong", "register", "encoder off", "stopped"};
  return kNames[static_cast<unsigned>(verdict)];
}

// The two bits that SpiCheck::kFull leaves open, in the 0x07 that releases the bank
// (docs/driver.md, "Left to the user"): INSTR = 100, whose end may be taken for that of an access
// that begins at this time (kUntrue), and SWBANK, behind which an older word may come (kOld).
// kRight: another bit.
inline Verdict left_open(SpiCheck check, const MeanFault& fault, const Transfer& hit) {
  const bool release = hit.opcode == 0x07 && hit.second == 0x01;
  if (check != SpiCheck::kFull || fault.kind != MeanKind::kFlipMosi || !release) {
    return Verdict::kRight;
  }
  return fault.place == 12 ? Verdict::kUntrue : fault.place == 10 ? Verdict::kOld : Verdict::kRight;
}

inline unsigned bits_of(Bus bus) {
  switch (bus) {
    case Bus::kEight:
      return 24;
    case Bus::kNoCrc:
      return 40;
    case Bus::kLong:
      return 64;
    case Bus::kSsi:
      return 25;
    default:
      return 28;
  }
}
inline std::uint32_t crc_of(Bus bus) {
  return bus == Bus::kNoCrc ? 0 : bus == Bus::kLong ? 0x190D9 : 0x43;
}
// The encoders, by the number of their SCDATAx.
inline std::vector<std::uint8_t> sensors_of(Bus bus) {
  switch (bus) {
    case Bus::kTwo:
      return {1, 2};
    case Bus::kEight:
      return {1, 2, 3, 4, 5, 6, 7, 8};
    case Bus::kChannels:
      return {1, 5};
    case Bus::kActuator:
      return {2};
    default:
      return {1};
  }
}
inline bool is_biss_c(Bus bus) { return bus != Bus::kBissB && bus != Bus::kSsi; }

// Each encoder has words of its own, far apart: a ramp with a large step.
inline std::string scenario_of(const Setup& setup) {
  const std::string channel = "[[channel]]\nnumber = ";
  const auto encoder = [&setup](unsigned slave) {
    std::string keys = "biss-c\"\ncontrol = true";
    if (setup.bus == Bus::kBissB) keys = "biss-b\"\ntimeout = 2";
    if (setup.bus == Bus::kSsi) keys = "ssi\"\ntimeout = 2\ngray = true";
    unsigned start = 0x123457 * slave;
    unsigned step = 0x5A3C1 + 0x2A6 * slave;
    if (setup.bus == Bus::kTwo && slave == 2) {
      // Its low byte is what a status leaves there that shares the memory.
      start = 0x246841;
      step = 0x5A900;
    }
    return "[[channel.slave]]\nprotocol = \"" + keys +
           "\nflag_bits = 0\nsource = \"ramp\"\nstart = " + std::to_string(start) +
           "\nstep = " + std::to_string(step) +
           "\ndata_bits = " + std::to_string(bits_of(setup.bus)) +
           "\ncrc = " + std::to_string(crc_of(setup.bus)) +
           (!is_biss_c(setup.bus) ? "\n"
            : setup.zeros         ? "\nregisters = { 0x44 = [0, 0, 0, 0], 0x60 = [0xFF, 0xFF] }\n"
                          : "\nregisters = { 0x44 = [0x6E, 0xD9, 0x01, 0x32], 0x60 = [0, 0] }\n");
  };
  std::string text = std::string("[chip.quirks]\nAGSERR_ON_HOLDBANK = ") +
                     (setup.omits ? "true" : "false") + "\n[host]\nsclk_hz = 10_000_000\n" +
                     channel + "1\n";
  if (setup.bus == Bus::kActuator) {
    text +=
        "mo = true\n[[channel.slave]]\nprotocol = \"biss-c\"\nactuator = true\n"
        "data_bits = 32\n" +
        encoder(2);
    return text;
  }
  for (const unsigned slave : sensors_of(setup.bus)) {
    if (slave == 5 && setup.bus == Bus::kChannels) text += channel + "2\n";
    text += encoder(slave);
  }
  return text;
}

inline std::uint32_t period_us(const Setup& setup) {
  // Two reads, one behind the other, fit into a period of several slaves.
  return setup.bus == Bus::kEight      ? 300
         : setup.bus == Bus::kChannels ? 150
         : setup.bus == Bus::kTwo      ? 100
                                       : 70;
}

inline Config config_of(const Setup& setup) {
  Config config;
  config.ma_hz = 10'000'000;
  config.channels[0].protocol = setup.bus == Bus::kBissB ? mb4::Protocol::kBissB
                                : setup.bus == Bus::kSsi ? mb4::Protocol::kSsi
                                                         : mb4::Protocol::kBissC;
  if (setup.bus == Bus::kChannels) config.channels[1].protocol = mb4::Protocol::kBissC;
  for (const std::uint8_t slave : sensors_of(setup.bus)) {
    mb4::SlaveConfig& one = config.slaves[slave - 1];
    one.enabled = true;
    one.data_bits = static_cast<std::uint8_t>(bits_of(setup.bus));
    one.flags = mb4::Flags::kNone;
    one.crc_polynomial = crc_of(setup.bus);
    one.gray = setup.bus == Bus::kSsi;
  }
  if (setup.bus == Bus::kActuator) {
    mb4::SlaveConfig& one = config.slaves[0];
    one.enabled = true;
    one.data_bits = 32;
    one.flags = mb4::Flags::kNone;
    one.actuator = true;
    config.mo = true;
  }
  if (!is_single(setup.way)) {
    config.frame_start = mb4::FrameStart::kPeriodic;
    config.frame_period_clk =
        mb4::frame_period_clk_at_least(config.f_clk_hz, period_us(setup) * 1000);
  }
  config.spi_check = setup.check;
  config.hold_beside_access = !setup.unheld;
  return config;
}

class Rig {
 public:
  static constexpr std::uint8_t kNamed = 0x60;  // the first register that a call writes
  static constexpr std::uint8_t kNamedCount = 2;
  static constexpr unsigned kKept = 1000;  // frames of which a word may be, at most

  virtual ~Rig() = default;
  explicit Rig(const Setup& setup)
      : setup_(setup),
        simulator(sim::parse_scenario(scenario_of(setup), "sweep.toml")),
        bus(simulator),
        clock(simulator),
        device(bus, clock),
        sensors_(sensors_of(setup.bus)) {
    if (setup.zeros) values_ = {};
    configure();
    if (!is_single(setup.way)) start();
    prepare();
    for (unsigned i = 0; i < 3; ++i) read();
    EXPECT_EQ(verdict, Verdict::kRight)
        << mb4test::to_string(verdict) << " before the fault: " << setup.text();
    EXPECT_NE(good_, 0U) << setup.text() << ": no position before the fault";
    if (is_bad(setup.before)) {
      for (const unsigned channel : {1U, 2U}) {
        // A bit of the first word; 0 is the start bit.
        // The word of the second encoder begins 34 bits later, where there is one.
        if (sim::Line* line = simulator.line(channel))
          clocked(line)->faults().flip_next_frame({9, 43});
      }
    }
    if (setup.before == Before::kBadBefore) {
      read();
      verdict = Verdict::kRight;
    }
    snapshot();
  }

  // One disturbed or undisturbed read, at the next tick of the loop or at once.
  void read(bool at_once = false) {
    if (!at_once) next_tick();
    std::vector<std::uint64_t> before;
    for (const std::uint8_t slave : sensors_) before.push_back(frames(slave));
    words_.clear();
    whole_ = Error::kNone;
    call_stack().run(bus, [this] { call(); });
    judge(before);
  }

  // The disturbed call.
  void disturb(const MeanFault& fault) {
    const bool frames_run = !is_single(setup_.way);
    if (setup_.act == Act::kStart || setup_.act == Act::kPlanStart) {
      call_stack().run(bus, [this] { EXPECT_TRUE(device.automatic().stop().ok()); });
    }
    if (writes(setup_.act)) named_ = values_;
    command_ = setup_.act == Act::kSend || setup_.act == Act::kBeginCommand ||
               setup_.act == Act::kPlanCommand || activates(setup_.act);
    bus.plan(fault);
    if (setup_.act == Act::kNone) {
      read(setup_.before == Before::kNothingNew || setup_.before == Before::kBadBefore);
    } else {
      act();
    }
    made_ = bus.made();
    bus.plan({});
    if (setup_.act == Act::kNone) return;
    last_error_ = Error::kNone;
    if (!device.configured()) configure();
    if (frames_run && !device.automatic().running()) restart();
  }

  // What the user does about what the last read has said (docs/driver.md).
  void react() {
    if (is_single(setup_.way)) return;
    const Error error = last_error_;
    if (!device.configured()) {
      configure();
      start();
    } else if (error == Error::kTimeout || error == Error::kLineError ||
               error == Error::kWrongMode || !device.automatic().running()) {
      if (setup_.way != Way::kNext || error == Error::kWrongMode) restart();
    }
  }

  void reads(unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
      read();
      poll_access();
      react();
    }
  }

  // After the disturbed call: the rest of the case.
  void go_on(unsigned count) {
    bus.plan({});
    react();
    reads(count);
    // Two registers are still being written, or an access runs that nobody has asked for.
    for (unsigned i = 0; i < 90 && access_; ++i) reads(1);
    if (access_starts() != starts_) reads(70);
    if (access_) end_access();
    bool verified = true;
    call_stack().run(bus, [&] { verified = device.verify().ok(); });
    if (!verified) configure();
    bool initialized = false;
    Error initialization = Error::kNone;
    call_stack().run(bus, [&] {
      if (!is_single(setup_.way)) static_cast<void>(device.automatic().stop());
      const Result<mb4::LineDelay> done = device.initialize();
      initialized = done.ok();
      initialization = done.error();
    });
    note("initialize(): " + std::string(mb4::to_string(initialization)));
    no_word_ = no_word_ || initialization == Error::kNoWord;
    if (!is_single(setup_.way)) start();
    good_ = 0;
    reads(20);
    conclude();
  }

  void raise(Verdict to, const std::string& what) {
    note(std::string(mb4test::to_string(to)) + ": " + what);
    verdict = std::max(verdict, to);
    ++seen[static_cast<unsigned>(to)];
  }

  void configure() {
    call_stack().run(bus, [this] {
      const Result<void> done = device.configure(config_of(setup_));
      if (!done) note(std::string("configure(): ") + mb4::to_string(done.error()));
    });
    if (setup_.way == Way::kC99) c99_.set_up(config_of(setup_));
    counting_ = false;
  }
  void start() {
    call_stack().run(bus, [this] {
      const Result<void> done = device.automatic().start();
      if (!done) note(std::string("start(): ") + mb4::to_string(done.error()));
    });
    started();
  }
  void restart() {
    end_access();
    call_stack().run(bus, [this] {
      const Result<void> done = device.automatic().restart();
      note(std::string("restart(): ") + mb4::to_string(done.error()));
    });
    started(true);
  }
  void started(bool again = false) {
    if (!again) {
      counts_ = {};
      device.automatic().count(&counts_);
      c99_.counts = {};
      counting_ = false;
    }
    restarted_ = again;
    if (setup_.way == Way::kC99) c99_.set_up(config_of(setup_));
    c99_.started(clock.now_us());
    first_read_ = true;
    const sim::Time period = period_time();
    tick_ = simulator.now() + 2 * period + period / 3;
    tick_number_ += 3;
  }

  // The transfers of the disturbed call.
  [[nodiscard]] const std::vector<Transfer>& made() const { return made_; }

  // The encoders' registers as they must stay, but for those that a call has named.
  void snapshot() {
    registers_.clear();
    commands_.clear();
    for (const std::uint8_t slave : sensors_) {
      std::array<std::uint8_t, 128> bytes{};
      for (unsigned i = 0; i < bytes.size(); ++i) {
        bytes[i] = simulator.slave(slave)->reg_read(static_cast<std::uint8_t>(i));
      }
      registers_.push_back(bytes);
      sim::ControlSlave* control = clocked(simulator.slave(slave))->control();
      commands_.push_back(control != nullptr ? control->counters().commands : 0);
    }
    starts_ = access_starts();
  }

  [[nodiscard]] std::uint64_t frames(std::uint8_t slave) const {
    return simulator.slave(slave)->frames();
  }
  [[nodiscard]] const std::vector<std::uint8_t>& sensors() const { return sensors_; }
  [[nodiscard]] std::uint64_t access_starts() const {
    std::uint64_t sum = 0;
    for (const std::uint8_t slave : sensors_) {
      sim::ControlSlave* control =
          clocked(const_cast<sim::Simulator&>(simulator).slave(slave))->control();
      if (control != nullptr) sum += control->counters().starts;
    }
    return sum;
  }
  static CallStack& call_stack() {
    static CallStack stack;
    return stack;
  }
  void note(const std::string& text) {
    if (telling) story += text + "\n";
  }

  Verdict verdict = Verdict::kRight;
  std::array<std::uint64_t, kVerdicts> seen{};  // how often each
  std::uint64_t line_limits = 0;  // words that the plug has cut and whose CRC fits all the same
  std::uint64_t cut_writes = 0;   // bytes of a write, the same
  std::uint64_t slips = 0;        // counts that are wrong, and `doubtful` says so
  bool telling = false;
  std::string story;

 protected:
  Setup setup_;

 public:
  sim::Simulator simulator;
  MeanBus bus;
  mb4::tool::SimClock clock;
  mb4::Device<MeanBus, mb4::tool::SimClock> device;

 protected:
  struct Word {
    std::uint8_t slave;
    Error code;
    std::uint64_t raw;
    std::uint16_t crc;
  };
  // Did the line itself, cut by the plug, carry this word with the CRC that fits it?
  [[nodiscard]] virtual bool cut_on_the_line(const Word& /*word*/) const { return false; }
  // An old word now comes from a fault that docs/driver.md leaves open.
  [[nodiscard]] virtual bool may_be_old() { return false; }
  [[nodiscard]] virtual bool cut_write(std::uint8_t /*now*/, std::uint8_t /*named*/) const {
    return false;
  }

  [[nodiscard]] sim::Time period_time() const {
    const Config config = config_of(setup_);
    return is_single(setup_.way) ? 60 * sim::kPsPerUs
                                 : config.frame_period_clk * (sim::kPsPerSecond / config.f_clk_hz);
  }
  void next_tick() {
    const sim::Time period = period_time();
    do {
      tick_ += period;
      ++tick_number_;
    } while (tick_ < simulator.now());
    simulator.run_until(tick_);
  }

  static bool writes(Act act) {
    return act == Act::kWriteRegisters || act == Act::kBeginWrite || act == Act::kPlanWrite ||
           act == Act::kWriteBesideVerify;
  }
  // ID of the first encoder: the slave next to SL has the highest one.
  [[nodiscard]] std::uint8_t id() const {
    return mb4::slave_address(config_of(setup_), sensors_[0]).id;
  }
  [[nodiscard]] mb4::Command addressed() const {
    mb4::Command command;
    command.ids = static_cast<std::uint8_t>(1U << id());
    command.test_acknowledge = true;
    return command;
  }

  // A blocking call.
  template <typename Call>
  void perform(Call call) {
    Error error = Error::kNone;
    call_stack().run(bus, [&] { error = call().error(); });
    ended(error);
  }
  void ended(Error error) {
    act_error_ = error;
    note(std::string(mb4test::to_string(setup_.act)) + ": " + mb4::to_string(error));
    if (error == Error::kNoWord) no_word_ = true;
    if (error != Error::kNone) raise(Verdict::kTold, mb4::to_string(error));
  }
  // An operation in steps.
  void steps(const Result<void>& planned) {
    if (!planned) {
      ended(planned.error());
      return;
    }
    bool done = false;
    in_steps_ = true;
    for (unsigned i = 0; i < 2000 && !done; ++i) {
      verify_step();
      if (op_.pause_us() != 0) simulator.advance(op_.pause_us() * sim::kPsPerUs);
      const bool transferred = op_.run(bus);
      done = device.finish(op_, transferred, clock.now_us());
      // A read is kBusy between the steps of an actuator, which holds the bank.
      if (done || !device.automatic().running() || setup_.act == Act::kPlanActuator) continue;
      if (setup_.slow && i < 8) simulator.advance((1U << i) * sim::kPsPerUs * 100);
      for (unsigned k = 0; k < (setup_.slow ? 3U : 1U); ++k) read();
    }
    in_steps_ = false;
    for (unsigned i = 0; i < 20; ++i) verify_step();
    if (!done) raise(Verdict::kDead, "the operation does not end");
    ended(op_.result().error());
  }
  void begin_verify() {
    if (setup_.act != Act::kReadBesideVerify && setup_.act != Act::kWriteBesideVerify) return;
    static_cast<void>(device.plan_verify(verify_));
  }
  void verify_step() {
    if (verify_.result().error() != Error::kBusy) return;
    const bool transferred = verify_.run(bus);
    static_cast<void>(device.finish(verify_, transferred, clock.now_us()));
  }
  void until_ended() {
    bool ends = act_error_ != Error::kNone;
    for (unsigned i = 0; i < 2000 && !ends; ++i) {
      if (device.automatic().running()) {
        read();
      } else {
        simulator.advance(20 * sim::kPsPerUs);
      }
      call_stack().run(bus, [&] {
        const Result<bool> over = mb4_c::PolledAccess(device).poll();
        ends = !over || *over;
        if (ends) ended(over.error());
      });
    }
    if (!ends) raise(Verdict::kDead, "the access does not end");
  }

  void act() {
    auto automatic = device.automatic();
    mb4_c::PolledAccess control(device);
    const mb4::SlaveAddress slave{1, id()};
    const mb4::Span<const std::uint8_t> values(values_.data(), values_.size());
    const std::uint64_t word = setup_.zeros ? 0 : 0x12345678;
    switch (setup_.act) {
      case Act::kStart:
        perform([&] { return automatic.start(); });
        started();
        break;
      case Act::kStop:
        perform([&] { return automatic.stop(); });
        break;
      case Act::kRestart:
        perform([&] { return automatic.restart(); });
        started(true);
        break;
      case Act::kVerify:
        perform([&] { return device.verify(); });
        break;
      case Act::kConfigure:
        perform([&] { return device.configure(config_of(setup_)); });
        break;
      case Act::kReset:
        perform([&] { return device.reset(); });
        break;
      case Act::kInitialize:
        perform([&] { return device.initialize(); });
        break;
      case Act::kBreak:
        perform([&] { return device.break_transmission(); });
        break;
      case Act::kReadRegisters:
        perform([&] { return control.read_registers(slave, 0x44, back_); });
        break;
      case Act::kWriteRegisters:
        perform([&] { return control.write_registers(slave, kNamed, values); });
        break;
      case Act::kSend:
        perform([&] { return control.send(addressed()); });
        break;
      case Act::kBeginRead:
        perform([&] { return control.begin_read(slave, 0x44, back_.size()); });
        until_ended();
        if (act_error_ == Error::kNone) perform([&] { return control.take(back_); });
        break;
      case Act::kBeginWrite:
        perform([&] { return control.begin_write(slave, kNamed, values); });
        until_ended();
        break;
      case Act::kBeginCommand:
        perform([&] { return control.begin_command(addressed()); });
        until_ended();
        break;
      case Act::kWriteActuator:
        perform([&] { return device.write_actuator(1, word); });
        break;
      case Act::kWriteNextActuator:
        perform([&] { return automatic.write_actuator(1, word); });
        break;
      case Act::kPlanStart:
        steps(automatic.plan_start(op_));
        started();
        break;
      case Act::kPlanRestart:
        steps(automatic.plan_restart(op_));
        started(true);
        break;
      case Act::kPlanVerify:
        steps(device.plan_verify(op_));
        break;
      case Act::kPlanConfigure:
        steps(device.plan_configure(op_, config_of(setup_)));
        break;
      case Act::kPlanInitialize:
        steps(device.plan_initialize(op_));
        break;
      case Act::kReadBesideVerify:
      case Act::kPlanRead:
        begin_verify();
        steps(control.plan_read(op_, slave, 0x44, back_));
        break;
      case Act::kWriteBesideVerify:
      case Act::kPlanWrite:
        begin_verify();
        steps(control.plan_write(op_, slave, kNamed, values));
        break;
      case Act::kPlanCommand:
        steps(control.plan_command(op_, addressed()));
        break;
      case Act::kActivate:
        perform([&] { return control.activate(); });
        break;
      case Act::kPlanActivate:
        steps(control.plan_activate(op_));
        break;
      case Act::kPlanActuator:
        steps(device.plan_actuator(op_, 1, word));
        break;
      default:
        break;
    }
    judge_act();
  }

  // The call has succeeded: has it done what it says?
  void judge_act() {
    if (act_error_ != Error::kNone) return;
    const sim::Slave& slave = *simulator.slave(sensors_[0]);
    const bool reads = setup_.act == Act::kReadRegisters || setup_.act == Act::kBeginRead ||
                       setup_.act == Act::kPlanRead || setup_.act == Act::kReadBesideVerify;
    for (unsigned i = 0; i < kNamedCount; ++i) {
      if (reads && back_[i] != slave.reg_read(static_cast<std::uint8_t>(0x44 + i))) {
        raise(Verdict::kUntrue, "another value was read");
      }
      if (writes(setup_.act) &&
          slave.reg_read(static_cast<std::uint8_t>(kNamed + i)) != values_[i]) {
        raise(Verdict::kUntrue, "nothing was written");
      }
    }
  }

  void take(std::uint8_t slave, const Result<mb4::Reading>& reading) {
    words_.push_back({slave, reading.error(), reading ? reading->raw : 0,
                      reading ? reading->crc : std::uint16_t{0}});
  }
  void take(const Result<void>& done, const mb4::Frame& frame) {
    whole_ = done.error();
    for (const std::uint8_t slave : sensors_) {
      if (done) take(slave, frame[slave]);
    }
  }
  // Makes the frames of `steps` and asks `finish` until it is done.
  template <typename Planned, typename Finish>
  void make(Planned& steps, Finish finish) {
    bool transferred = false;
    do {
      if (steps.pause_us() != 0) simulator.advance(steps.pause_us() * sim::kPsPerUs);
      transferred = steps.run(bus);
    } while (!finish(transferred, clock.now_us()));
  }

  void call() {
    auto automatic = device.automatic();
    mb4::Frame frame;
    const std::uint8_t slave = sensors_.back();
    switch (setup_.way) {
      case Way::kReadFrame:
        take(slave, device.read_frame(slave));
        break;
      case Way::kReadAll:
        take(device.read_all(frame), frame);
        break;
      case Way::kPlanReadAll: {
        Result<void> done = device.plan_read_all(op_, all_);
        if (done) {
          make(op_, [this](bool transferred, std::uint32_t now_us) {
            return device.finish(op_, transferred, now_us);
          });
          done = all_.result(frame);
        }
        take(done, frame);
        break;
      }
      case Way::kPollSlave:
        take(slave, automatic.poll_slave<kCounting>(slave));
        break;
      case Way::kPoll:
        take(automatic.poll(frame), frame);
        break;
      case Way::kNext:
        take(automatic.next(frame), frame);
        break;
      case Way::kPlanSlave: {
        const Result<void> done = automatic.plan_slave<kCounting>(slave, one_);
        if (!done) {
          take(slave, done.failure());
          break;
        }
        make(one_, [this, &automatic](bool transferred, std::uint32_t now_us) {
          return automatic.finish<kCounting>(one_, transferred, now_us);
        });
        take(slave, one_.result());
        break;
      }
      case Way::kPlan: {
        Result<void> done = automatic.plan(all_);
        if (done) {
          make(all_, [this, &automatic](bool transferred, std::uint32_t now_us) {
            return automatic.finish<kCounting>(all_, transferred, now_us);
          });
          done = all_.result(frame);
        }
        take(done, frame);
        break;
      }
      default:
        call_c99();
    }
  }

  void call_c99() {
    if (!device.automatic().running()) {
      whole_ = Error::kWrongMode;
      return;
    }
    c99_.read.access = access_;
    const std::uint8_t code = c99_.run(bus, clock);
    if (!c99_.read.told) {
      whole_ = static_cast<Error>(code);
      return;
    }
    for (unsigned i = 0; i < c99_.count; ++i) {
      Word word{c99_.words[i].slave, static_cast<Error>(c99_.slots[i].code), 0, 0};
      if (word.code == Error::kNone) {
        mb4_reading reading;
        mb4_slot_reading(&c99_.words[i], &c99_.slots[i], &reading, kCounting);
        word.raw = reading.raw;
        word.crc = reading.crc;
      }
      words_.push_back(word);
    }
  }

  // The frame in which `slave` has sent `raw`, if it is one of the last ones.
  [[nodiscard]] std::optional<std::uint64_t> frame_of(std::uint8_t slave, std::uint64_t raw) const {
    const std::uint64_t sent = frames(slave);
    for (std::uint64_t frame = sent; frame != 0 && frame + kKept > sent; --frame) {
      if (simulator.slave(slave)->sent_in(frame) == raw) return frame;
    }
    return {};
  }

  void judge(const std::vector<std::uint64_t>& before) {
    bool good = false;
    bool late = false;
    last_error_ = whole_;
    if (whole_ != Error::kNone) told(whole_);
    for (const Word& word : words_) {
      const std::size_t index = static_cast<std::size_t>(
          std::find(sensors_.begin(), sensors_.end(), word.slave) - sensors_.begin());
      if (word.code != Error::kNone) {
        last_error_ = word.code;
        if (word.code == Error::kNoData && !is_single(setup_.way) &&
            before[index] > seen_[word.slave]) {
          if (first_read_) continue;  // it may drop what has waited since before the start
          raise(Verdict::kHidden, "slave " + std::to_string(word.slave));
        } else {
          told(word.code);
        }
        continue;
      }
      good = true;
      ++good_;
      const std::optional<std::uint64_t> frame = frame_of(word.slave, word.raw);
      std::optional<std::uint64_t>& last = last_[word.slave];
      if (!frame && cut_on_the_line(word)) {
        ++line_limits;
        note("cut on the line: " + number(word.raw));
      } else if (!frame) {
        raise(Verdict::kWrong, number(word.raw) + " of slave " + std::to_string(word.slave));
      } else {
        const std::string text = number(word.raw) + " of frame " + std::to_string(*frame) + ", " +
                                 std::to_string(before[index]) + " were sent";
        const std::uint64_t oldest = is_single(setup_.way)
                                         ? before[index] + 1
                                         : std::max<std::uint64_t>(before[index], 1) - 1;
        if (*frame < oldest || (last && *frame <= *last)) {
          if (may_be_old()) {
            note("left open, old: " + text);
          } else {
            raise(Verdict::kOld, text);
          }
          late = true;
        } else {
          note("good: " + text);
        }
        last = std::max(last.value_or(0), *frame);
      }
    }
    for (std::size_t i = 0; i < sensors_.size(); ++i) seen_[sensors_[i]] = before[i];
    first_read_ = false;
    if (good && !late && counts_lost()) judge_counts();
  }

  void told(Error error) {
    // Before an instruction, and while the configuration is compared.
    if (error == Error::kBusy && in_steps_) return;
    no_word_ = no_word_ || error == Error::kNoWord;
    if (error != Error::kNoData || is_single(setup_.way)) {
      raise(Verdict::kTold, mb4::to_string(error));
    }
  }

  [[nodiscard]] bool counts_lost() const {
    return setup_.way == Way::kPollSlave || setup_.way == Way::kPlanSlave ||
           setup_.way == Way::kPlan || setup_.way == Way::kC99;
  }
  // A good read: all samples since the one before are counted, and the periods.
  void judge_counts() {
    const mb4_counts& counts = setup_.way == Way::kC99 ? c99_.counts : counts_;
    const std::uint64_t frame = last_[words_[0].slave].value_or(0);
    if (counts.good + counts.lost != counts.sequence) {
      raise(Verdict::kUncounted, "the sum is wrong");
    }
    if (counting_ && words_[0].code == Error::kNone) {
      const std::uint64_t counted = counts.sequence - counted_sequence_;
      const std::uint64_t ticks = tick_number_ - counted_tick_;
      // After a restart the loop has another phase, so the periods between are no whole number.
      bool good = restarted_ ? counted + 1 >= frame - counted_frame_
                             : counted >= frame - counted_frame_ && counted == ticks;
      // By so much the counts say that they may be wrong: a read that takes long beside one that
      // takes short has slipped by a period.
      const std::uint64_t doubts = counts.doubtful - counted_doubts_;
      if (!good && doubts != 0 && counted + doubts >= frame - counted_frame_ &&
          (restarted_ || (counted + doubts >= ticks && counted <= ticks + doubts))) {
        good = true;
        ++slips;
      }
      // A read that begins with a release takes longer, and may bring the word of the frame after.
      // The reads behind it show whether a sample is missing in the end.
      const auto near = [counted](std::uint64_t number) {
        return counted + 1 >= number && number + 1 >= counted;
      };
      if (!good && near(ticks) && near(frame - counted_frame_) && unsettled_++ < 3) return;
      if (!good) {
        raise(Verdict::kUncounted, std::to_string(counted) + " counted, " + std::to_string(ticks) +
                                       " ticks, " + std::to_string(frame - counted_frame_) +
                                       " frames");
      }
    }
    if (words_[0].code != Error::kNone) return;
    counting_ = true;
    restarted_ = false;
    unsettled_ = 0;
    counted_sequence_ = counts.sequence;
    counted_doubts_ = counts.doubtful;
    counted_tick_ = tick_number_;
    counted_frame_ = frame;
  }

  void prepare() {
    mb4_c::PolledAccess control(device);
    const std::uint8_t slave = id();
    std::array<std::uint8_t, 2> bytes{0x11, 0x22};
    Result<void> done;
    switch (setup_.before) {
      case Before::kRead:
        done = control.read_registers({1, slave}, 0x44, bytes);
        break;
      case Before::kWrite:
        done = control.write_registers({1, slave}, 0x50, bytes);
        simulator.slave(sensors_[0])->reg_write(0x50, 0xEE);
        simulator.slave(sensors_[0])->reg_write(0x51, 0xEE);
        break;
      case Before::kCommand:
        done = control.send(addressed());
        command_ = true;
        break;
      case Before::kBeside:
        named_ = {0x11, 0x22};
        done = control.begin_write({1, slave}, kNamed, *named_);
        access_ = true;
        break;
      default:
        break;
    }
    EXPECT_TRUE(done.ok()) << setup_.text() << ": " << mb4::to_string(done.error());
  }

  void poll_access() {
    if (!access_) return;
    call_stack().run(bus, [this] {
      const Result<bool> ended = mb4_c::PolledAccess(device).poll();
      if (ended && !*ended) return;
      access_ = false;
      note(std::string("the access has ended: ") + mb4::to_string(ended.error()));
      if (ended && setup_.check >= SpiCheck::kFull) {
        for (unsigned i = 0; i < kNamedCount; ++i) {
          if (simulator.slave(sensors_[0])->reg_read(static_cast<std::uint8_t>(kNamed + i)) !=
              (*named_)[i]) {
            raise(Verdict::kUntrue, "the access beside has not written what it says");
          }
        }
      }
    });
  }
  void end_access() {
    if (!access_) return;
    call_stack().run(bus, [this] { static_cast<void>(device.control().abort()); });
    access_ = false;
  }

  void judge_slaves() {
    for (std::size_t s = 0; s < sensors_.size(); ++s) {
      sim::Slave& slave = *simulator.slave(sensors_[s]);
      for (unsigned i = 0; i < registers_[s].size(); ++i) {
        const std::uint8_t now = slave.reg_read(static_cast<std::uint8_t>(i));
        const bool names = s == 0 && named_ && i >= kNamed && i < kNamed + kNamedCount;
        const std::uint8_t named = names ? (*named_)[i - kNamed] : registers_[s][i];
        if (now == registers_[s][i] || now == named) continue;
        if (names && cut_write(now, named)) {
          ++cut_writes;
          registers_[s][i] = now;
          continue;
        }
        raise(Verdict::kRegister, "register " + number(i) + " of slave " +
                                      std::to_string(sensors_[s]) + " is " + number(now));
      }
      sim::ControlSlave* control = clocked(&slave)->control();
      if (control == nullptr) continue;
      if (!control->data_active() && !no_word_) {
        raise(Verdict::kOff, "slave " + std::to_string(sensors_[s]));
      }
      const sim::ControlCommand& last = control->last_command();
      // Addressed 00 to the encoders that the call has named, and broadcast 01 of activate().
      const bool named =
          last.ids == 0 ? activates(setup_.act) && last.code == 1
                        : last.code == 0 && (activates(setup_.act) || last.ids == 0x80U >> id());
      if (control->counters().commands != commands_[s] && !(command_ && named)) {
        raise(Verdict::kRegister, "command " + number(last.code) + " to " + number(last.ids));
      }
    }
  }
  void conclude() {
    judge_slaves();
    if (good_ == 0 && !no_word_) raise(Verdict::kDead, "no position after initialize()");
  }

  static std::string number(std::uint64_t value) {
    constexpr const char* kDigits = "0123456789ABCDEF";
    std::string text;
    do {
      text.insert(text.begin(), kDigits[value % 16]);
      value /= 16;
    } while (value != 0);
    return "0x" + text;
  }

  std::vector<std::uint8_t> sensors_;
  mb4::Operation op_;
  mb4::Operation verify_;                                     // beside it
  std::array<std::uint8_t, kNamedCount> values_{0x5C, 0xA3};  // that a call writes
  mb4::FrameRead all_;
  mb4::CyclicRead one_;
  C99Read c99_;
  mb4_counts counts_{};
  sim::Time tick_ = 0;
  std::uint64_t tick_number_ = 0;
  std::vector<Word> words_;
  Error whole_ = Error::kNone;
  Error last_error_ = Error::kNone;
  std::map<std::uint8_t, std::optional<std::uint64_t>> last_;  // frame of the last good word
  std::map<std::uint8_t, std::uint64_t> seen_;                 // frames sent before the last read
  unsigned good_ = 0;
  bool no_word_ = false;
  bool in_steps_ = false;
  bool access_ = false;  // two registers are being written beside the reads
  bool counting_ = false;
  bool restarted_ = false;  // since the last good read
  bool first_read_ = true;  // since the start of frames
  unsigned unsettled_ = 0;  // good reads since the counts have agreed
  std::uint32_t counted_sequence_ = 0;
  std::uint32_t counted_doubts_ = 0;
  std::uint64_t counted_tick_ = 0;
  std::uint64_t counted_frame_ = 0;
  std::vector<std::array<std::uint8_t, 128>> registers_;
  std::optional<std::array<std::uint8_t, kNamedCount>> named_;
  std::vector<std::uint64_t> commands_;  // executed by each encoder
  bool command_ = false;                 // addressed 00 was sent
  std::uint64_t starts_ = 0;
  std::vector<Transfer> made_;
  Error act_error_ = Error::kNone;
  std::array<std::uint8_t, kNamedCount> back_{};
};

}  // namespace mb4test

#endif  // TESTS_DRIVER_RTL_SWEEP_RIG_HPP_
