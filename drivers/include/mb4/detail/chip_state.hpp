// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// What the driver knows about a chip, without its bus and clock.

#ifndef MB4_DETAIL_CHIP_STATE_HPP_
#define MB4_DETAIL_CHIP_STATE_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/cyclic.hpp"
#include "mb4/detail/control_time.hpp"
#include "mb4/detail/time_limit.hpp"
#include "mb4/operation.hpp"
#include "mb4/reading.hpp"
#include "mb4/register_image.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4::detail {

// 0xF4 while a bank is held.
inline constexpr std::uint8_t kHoldAndAgs = regs::AGS::encode<1>() | regs::HOLDBANK::encode<1>();

// Time for a slave whose frame BREAK has ended, until it is ready again. A slave needs its timeout
// for this; 12.5 to 40 us are common.
inline constexpr std::uint32_t kLineRecoveryUs = 100;

// The control communication that is running, and the registers of the last read.
struct ControlState {
  enum class Kind : std::uint8_t { kNone, kRead, kWrite, kCommand };

  Kind kind = Kind::kNone;
  std::uint8_t readable = 0;     // registers that a finished read has left in RDATA
  std::uint8_t count = 0;        // registers of this access, 1..64
  std::uint8_t first = 0;        // SpiCheck::kFull: the first of `readable`
  bool waits = false;            // take() has not fetched them
  bool armed = false;            // 0xE2..0xE5 may hold another request than the one at rest
  bool biss_b = false;           // one instruction runs the whole access, without frames
  bool ended = false;            // REGEND = 1: an access has ended, and nothing has begun since
  bool seen_running = false;     // a read of positions has seen REGEND = 0 since the last poll
  bool first_frame = false;      // REGEND may belong to the access before; BiSS B: not ended yet
  bool stray = false;            // an access that nobody asked for may run
  bool suspect = false;          // a status could not be read: 0x07 for 0x05 writes 0xF4 and 0xF5
  bool no_hand_over = false;     // BiSS B: no slave has entered register mode
  bool agserr_at_start = false;  // BiSS B: the chip sets nAGSERR = 0 at each write of 0xF4
  std::uint32_t access_us = 0;   // start of the access
  std::uint32_t frames = 0;      // begun so far, without automatic frames
  const Operation* owner =
      nullptr;  // runs it, or takes its registers; null once BREAK has ended it
};

// All that the calls on one chip share, except its bus and its clock.
struct ChipState {
  using Make = bool (*)(ChipState&, Steps&);
  using AskUs = std::uint32_t (*)(ChipState&);

  constexpr ChipState(Make the_make, AskUs the_ask_us, std::uint32_t the_step_us)
      : make(the_make), ask_us(the_ask_us), step_us(the_step_us) {}

  // First what most calls look at: short offsets make short code.
  Make make;     // the frames of a step, on the bus
  AskUs ask_us;  // asks the clock
  bool configured = false;
  // AGS = 1 was written, and nothing has stopped it.
  bool automatic = false;
  // A frame may still run and SVALID is unknown: BREAK comes before the next request. Every error
  // after the first transfer of a call sets this flag.
  bool recover_first = true;
  // Why reads of positions are kBusy: an actuator holds the bank between its steps; a disturbed
  // write may have changed the configuration, which the operation compares now; a
  // request is in the chip and not yet begun, and the 0x02 of a read with one
  // wrong bit (0xF1 and 0xE1) would make another one of it.
  static constexpr std::uint8_t kForActuator = 1;
  static constexpr std::uint8_t kForProof = 2;
  static constexpr std::uint8_t kForRequest = 4;
  std::uint8_t reads_wait = 0;
  // The caller wants automatic frames, but they need BREAK and a new start first (table 69).
  bool restart = false;
  std::uint16_t sensor_flags = 0;  // flag_of() of `sensors`
  std::uint8_t sensors = 0;        // slaves of `config` that deliver data; bit 0 is slave 1
  std::uint8_t actuators = 0;      // slaves of `config` that take words; bit 0 is slave 1
  ControlState control{};
  std::uint32_t frame_us = 0;             // frame_timeout_us(), worked out once
  std::uint32_t busy_us = 0;              // register_busy_us()
  std::uint32_t pitch_us = 0;             // frame_pitch_us()
  mb4_watch watch{};                      // are automatic frames coming?
  std::array<mb4_word, kSlaves> words{};  // how the data of each of `sensors` is read, in order
  RegisterImage image{};                  // 0xC0..0xF2 as configure() has written them
  std::uint8_t interface_byte = 0;        // 0xF5, the same
  std::uint8_t mark = 0;                  // behind the last word of an actuator: add_mark()
  std::uint32_t step_us;                  // of the clock
  std::uint8_t count = 0;                 // of `words`
  std::uint8_t needs = 0;                 // MB4_WITH_..., for any slave
  Config config{};
  Operation own;  // of the calls that make the frames themselves

  // How the data of `slave`, one of `sensors`, is read.
  [[nodiscard]] const mb4_word* word_of(std::uint8_t slave) const {
    const mb4_word* word = words.data();
    while (word->slave != slave) {
      ++word;
    }
    return word;
  }

  void set_waits(std::uint8_t why, bool waits) {
    reads_wait = static_cast<std::uint8_t>(waits ? reads_wait | why : reads_wait & ~unsigned{why});
  }

  // Before a new configuration.
  void forget() {
    configured = false;
    automatic = false;
    reads_wait = 0;
    restart = false;
    recover_first = true;
    control = {};
  }

  // Works out what the calls need of a valid configuration.
  void take(const Config& from) {
    config = from;
    image = encode_registers(from);
    interface_byte = encode_interface(from);
    sensors = mb4::sensors(from);
    sensor_flags = Status::valid_registers(sensors);
    actuators = mb4::actuators(from);
    frame_us = frame_timeout_us(from);
    pitch_us = frame_pitch_us(from);
    busy_us = register_busy_us(from);
    needs = (sensors & (sensors - 1U)) != 0 ? MB4_WITH_SEVERAL : 0;
    set_counts(watch.counts);
    count = 0;
    for (std::uint8_t slave = 1; slave <= kSlaves; ++slave) {
      if (is_in(sensors, slave)) {
        set_word(from, slave, words[count++]);
        needs = static_cast<std::uint8_t>(needs | needed(from, slave));
      }
    }
    set_watch();
  }

  // Reads that cannot count do not begin then. Period and time are those of the moment.
  void set_counts(mb4_counts* counts) {
    watch.counts = counts;
    needs = static_cast<std::uint8_t>(counts != nullptr ? needs | MB4_WITH_COUNTS
                                                        : needs & ~unsigned{MB4_WITH_COUNTS});
  }

  // Works out when frames have stayed away for too long: Automatic::poll(). A slave that needs
  // longer than a period says so by Config::frame_timeout_us.
  void set_watch() {
    const std::uint32_t two_us = 2 * pitch_us;
    const std::uint32_t slow_us = config.frame_timeout_us + pitch_us;
    const bool on_pin = config.frame_start == FrameStart::kOnPin && config.pin_period_us == 0;
    watch.omitted_us = (two_us > slow_us ? two_us : slow_us) + step_us;
    watch.silent_us = on_pin ? MB4_NEVER : 14 * pitch_us + watch.omitted_us;
    watch.lines = static_cast<std::uint8_t>(
        (config.channels[0].protocol == Protocol::kUnused ? 0 : regs::SL1::kMask) |
        (config.channels[1].protocol == Protocol::kUnused ? 0 : regs::SL2::kMask));
    watch.several = (sensors & (sensors - 1U)) != 0;
  }

  // Automatic frames begin now.
  void started(std::uint32_t now_us) {
    automatic = true;
    set_waits(kForActuator | kForRequest, false);
    restart = false;
    watch.news_us = now_us;
    watch.taken = 0;
    watch.held = false;
    watch.astray = false;
    control.stray = false;  // BREAK has ended it
    for (std::uint32_t& good_us : watch.good_us) {
      good_us = now_us;
    }
  }

  [[nodiscard]] bool control_runs() const { return control.kind != ControlState::Kind::kNone; }

  // The configuration is compared, or must be.
  [[nodiscard]] bool in_doubt() const { return (reads_wait & kForProof) != 0; }

  // 0xE2..0xE5 need not hold the request at rest.
  [[nodiscard]] bool request_is_away() const { return control_runs() || control.armed; }

  [[nodiscard]] Result<void> single_frame_allowed() const {
    if (!configured) {
      return Error::kNotConfigured;
    }
    if (control_runs() || in_doubt()) {
      return Error::kBusy;
    }
    return automatic ? Error::kWrongMode : Error::kNone;
  }

  // `again`: automatic frames may run.
  [[nodiscard]] Result<void> start_allowed(bool again) const {
    if (const Result<void> single = single_frame_allowed();
        !single && (!again || single.error() != Error::kWrongMode)) {
      return single;
    }
    return config.single_bank ? ErrorInfo(Error::kUnsupported, ConfigField::kSingleBank, 0)
                              : ErrorInfo();
  }

  [[nodiscard]] bool checks_all() const { return config.spi_check >= SpiCheck::kFull; }
  // A status follows each byte for 0xF4 with AGS = 1.
  [[nodiscard]] bool proves_release() const {
    return config.spi_check == SpiCheck::kFullAndRelease;
  }

  // A read frees the bank that it has read.
  [[nodiscard]] Result<void> read_allowed() const {
    if (!automatic) {
      return Error::kWrongMode;
    }
    return reads_wait != 0 ? Error::kBusy : Error::kNone;
  }

  // Time from BREAK until all slaves are ready, by any clock. Slaves of BiSS B may be in register
  // mode and need longer.
  [[nodiscard]] std::uint32_t recovery_us() const {
    constexpr std::uint32_t kShortest = kLineRecoveryUs + kClockStepUs;
    return any_channel_is(config, Protocol::kBissB) ? kShortest + config.register_timeout_us
                                                    : kShortest;
  }

  // What BREAK ends.
  void stopped() {
    automatic = false;
    set_waits(kForActuator | kForRequest, false);
    control.kind = ControlState::Kind::kNone;
    control.owner = nullptr;
    control.waits = false;
    control.ended = false;
  }
};

}  // namespace mb4::detail

#endif  // MB4_DETAIL_CHIP_STATE_HPP_
