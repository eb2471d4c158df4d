// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Automatic frames (AGS = 1). Reads them so that the bytes of one position always come from one
// frame.

#ifndef MB4_AUTOMATIC_HPP_
#define MB4_AUTOMATIC_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/cyclic.hpp"
#include "mb4/detail/blocking.hpp"
#include "mb4/detail/chip.hpp"
#include "mb4/detail/procedures.hpp"
#include "mb4/detail/reads.hpp"
#include "mb4/frame.hpp"
#include "mb4/operation.hpp"
#include "mb4/result.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

// Most SPI transfers of one Automatic::poll_slave(), whatever the chip answers. Beside a control
// communication without Config::hold_beside_access it takes up to 9, with SpiCheck::kFull and
// kFullAndRelease 17.
inline constexpr unsigned kMaxPollSlaveTransfers = 10;
// The same with SpiCheck::kFull. SpiCheck::kFullAndRelease needs one more.
inline constexpr unsigned kMaxPollSlaveTransfersChecked = 14;

// Automatic frames, at the rate or on the event that Config::frame_start selects (table 44):
//
//   device.automatic().start();
//   device.automatic().poll(frame);    // in an interrupt: the last frame, if it is new
//   device.automatic().next(frame);    // in a loop: waits for the next frame
//
// Why the bytes of a position belong together:
//  * HOLDBANK holds the bank while the driver reads it (page 33, table 69).
//  * HOLDBANK takes effect some system clocks after the write. With SCLK above 2 f_CLK, bytes read
//    at once could still come from the old bank. So with SpiCheck::kFull the driver reads the
//    status between HOLDBANK and the data, which takes at least 48 SCLK periods. With kCrc and kOff
//    it reads the data at once, which needs SCLK of at most 2 f_CLK; on a parallel bus four system
//    clocks between the two cycles.
//  * While a control communication runs, the byte with HOLDBANK has INSTR = 000: INSTR = 100,
//    written back at the wrong moment, would start the access again. The access goes on. Where a
//    chip does not allow this (Config::hold_beside_access = false) the driver reads without
//    HOLDBANK. It drops the data unless SVALID and nSCDERR prove that no bank was switched, tries
//    once more, and then reports kBankSwitched. It then reports no kCrc and no dead line.
//
// Why data is never old: the driver clears SVALID of all enabled slaves after each read. SVALID = 1
// therefore means that a frame has ended since then (note of table 61).
//
// `With` leaves out parts of the read path that the configuration does not use: MB4_WITH_... of
// mb4_cyclic.h, for all calls of the object: device.automatic<0>(). A read whose configuration
// needs a part that is not there is kUnsupported.
template <typename Bus, typename Clock, std::uint8_t With = MB4_WITH_ALL>
class Automatic {
 public:
  explicit constexpr Automatic(detail::Chip<Bus, Clock>& chip) : chip_(chip) {}

  // Sets AGS = 1. One transfer; after a failed read and after stop() 2 more and 100 us (BREAK,
  // SVALID; BiSS B adds register_timeout_us). SpiCheck::kFull: 4, or 7 with BREAK.
  // Not touched: kNotConfigured, kWrongMode (AGS is on already), kBusy, kUnsupported with
  // kSingleBank. Touched: kTransport, with SpiCheck::kFull kNotDetected and kCorrupted
  // too (AGS may be on; call stop() or start() again).
  Result<void> start() {
    const Result<void> allowed = chip_.start_allowed(false);
    return allowed ? detail::Blocking::start(chip_) : allowed;
  }

  // Begins start() without a transfer: the caller makes the frames of `operation` and calls
  // Device::finish() until it returns true. One step of one frame, with SpiCheck::kFull four; after
  // a failed read and after stop() two steps, of which the second begins after a pause. Not
  // touched: kNotConfigured, kWrongMode, kBusy, kUnsupported as of start(). operation.result():
  // kTransport, kNotDetected, kCorrupted as of start(); kWrongMode (operation.hpp).
  Result<void> plan_start(Operation& operation) {
    const Result<void> allowed =
        detail::Procedures::possible(operation, chip_.start_allowed(false));
    if (allowed) {
      detail::Procedures::plan_start(chip_, operation);
    }
    return allowed;
  }

  // Sets AGS = 0: the running frame ends normally and no other frame follows. One transfer; with
  // SpiCheck::kFull a status proves it, and it is sent once more where 0xF4 is not 0. The call is
  // allowed when no frames run. kBusy (not touched); touched, AGS may be on or off: kTransport;
  // with SpiCheck::kFull kNotDetected, kCorrupted.
  Result<void> stop() {
    if (chip_.control_runs()) {
      return Error::kBusy;
    }
    detail::Procedures::plan_stop(chip_, chip_.own, 0, false);
    return detail::Blocking::run(chip_, chip_.own);
  }

  // Begins stop() without a transfer, as plan_start(): one step of one frame, with SpiCheck::kFull
  // of two, and once more where the first has not come. kBusy (not touched); operation.result():
  // kTransport, kNotDetected, kCorrupted.
  Result<void> plan_stop(Operation& operation) {
    const Result<void> allowed =
        detail::Procedures::possible(operation, chip_.control_runs() ? Error::kBusy : Error::kNone);
    if (allowed) {
      detail::Procedures::plan_stop(chip_, operation, 0, false);
    }
    return allowed;
  }

  // Starts automatic frames again (table 69): BREAK, 100 us for the slaves' timeout, SVALID = 0,
  // AGS = 1. BiSS B adds register_timeout_us. Three transfers, with SpiCheck::kFull seven. Not for
  // interrupts, because it waits. Not touched, frames that run go on: kNotConfigured, kBusy,
  // kUnsupported. kTransport, with SpiCheck::kFull kNotDetected and kCorrupted too: next() then
  // tries again. It counts: count().
  template <std::uint8_t Parts = With>
  Result<void> restart() {
    return detail::Blocking::restart<Parts>(chip_);
  }

  // Begins restart() without a transfer, as plan_start(). Two steps: BREAK; then, after the pause,
  // SVALID = 0 and AGS = 1. It may be called in an interrupt. Not touched, frames that run go on:
  // kNotConfigured, kBusy, kUnsupported. After a failure next() tries again.
  template <std::uint8_t Parts = With>
  Result<void> plan_restart(Operation& operation) {
    const Result<void> allowed = detail::Procedures::possible(operation, chip_.start_allowed(true));
    if (allowed) {
      detail::Procedures::prepare_restart<Parts>(chip_);
      detail::Procedures::plan_start(chip_, operation);
    }
    return allowed;
  }

  // True when the driver has set AGS = 1 and nothing has stopped it.
  [[nodiscard]] bool running() const { return chip_.automatic; }

  // Fetches the last complete frame if it has not been fetched yet. Never waits. A loop over plan()
  // and finish(), so the code is that of poll_slave(). Transfers without SpiCheck::kFull, whatever
  // the chip answers: 3 + b for b bursts of data, at most one for each slave; after a bad word one
  // more for each. In order:
  //   0x07        HOLDBANK = 1, AGS = 1
  //   0x09, 0x03  SCDATA of the enabled slaves; only the bytes that hold data, neighbours together,
  //               at most 25 bytes in a transfer
  //   0x05        0xF0..0xF4: SVALID (table 69)
  //   0x02        SVALID of the enabled slaves = 0, HOLDBANK = 0, AGS = 1; without news 0x07 alone
  // SpiCheck::kFull reads the status before the data (3 transfers when nothing is new), data again
  // where a stored CRC does not prove it or an address was sent (0x03: a wrong one reads the word
  // of another slave), and the status once or twice after a 0x02 of its own.
  // Beside a control communication without Config::hold_beside_access the order is 0x05, 0x02,
  // data, 0x05, twice at most. After a read that could not release the bank, 0x07 and 0x02
  // come first; with SpiCheck::kFull 0x02 twice, and 0x05 up to 0xF5.
  // SpiCheck::kFullAndRelease reads the status after each 0x07 that releases the bank.
  //
  // After a frame with a bad word (nSCDERR = 0) it checks the data of the slaves without SVALID as
  // well: a stored CRC that fits shows a word that has been read before. A bad word then gets the
  // CRC that can never fit, so that it counts once: one 0x02 more for each. A word of BiSS C that
  // is all 0: 0x05 up to 0xF8, twice at most. With SpiCheck::kFull, beside an access and until its
  // registers are taken, it gets no such CRC: one disturbed bit of the address would change RDATA.
  // Each read tells it then, until the next frame. When frames stay away: two 0x05 more, up to 0xFB
  // and to 0xF4.
  //
  // With SpiCheck::kFull one disturbed bit of the first status may hide a new frame: this call says
  // kNoData, and the next one brings the word, if no later frame has overwritten it.
  //
  // An interrupt may call it, if it interrupts no other call on the same Device. It calls now_us()
  // of the Clock, so this must be safe in the interrupt too.
  //
  // Success: frame[slave] is a Reading, kSlaveError (new, and nE is 0), kNoData (nothing new), kCrc
  // (a bad frame, told once), kNoWord (the same, for a slave of BiSS C whose word is all 0, CRC
  // too, while its line is at 1 again: it acknowledges and sends nothing) or kCorrupted for each
  // enabled slave. With SpiCheck::kOff, and where the data leaves no room for a CRC, kCrc is told
  // only together with a good word of another slave, and by each call if no good word of the slave
  // has come for two periods or if there is no other slave. frame.status shows that frames were
  // omitted (nAGSERR), not how many; frames that later ones have overwritten are not counted
  // either. The datasheet asks for restart() when SVALID is 0 although a frame must have ended
  // (table 69). This call does not restart; next() does.
  //
  // Errors: kWrongMode (automatic frames do not run; not touched), kBusy (not touched: between the
  // steps of plan_actuator() with SpiCheck::kFull; while an operation compares the configuration;
  // between a request and its instruction), kTransport, kNotDetected,
  // kBankSwitched;
  // kCorrupted (HOLDBANK is not in the chip). On error `frame` holds no Reading.
  // kTimeout, kLineError (SL is 0): frames stay away for more than two periods and the step of
  // the clock (enc::clock_step_us), if the chip has left frames out, otherwise for 16 periods. With
  // Config::frame_timeout_us it is that time and one period if this is longer than two: a chip that
  // has lost its configuration or its clock sets no flag. Where SWBANKFAIL = 1 says that a frame
  // has ended while the bank was held: 64 periods. A loop whose transfers do not fit between the
  // frames may meet the end of each one for so long. Back to back a period is frame_timeout_us().
  // With FrameStart::kOnPin only if Config::pin_period_us says how often pulses come. Nothing is
  // changed, and each call says so until a frame ends: call restart(). A dead line on one channel
  // stops both, see without_channel(). Where no CRC is stored and the last frame was bad, such a
  // time ends with kCrc instead, if the chip has left no frame out; each call says so again.
  Result<void> poll(Frame& frame) { return detail::Blocking::poll(chip_, frame); }

  // As poll(), for one slave (1..8). At most kMaxPollSlaveTransfers transfers, with SpiCheck::kFull
  // kMaxPollSlaveTransfersChecked. Its code is small and fast, for the
  // interrupt of a control loop. It does not change SVALID of other slaves.
  //
  // Not touched: kInvalidArgument (the slave is no enabled sensor), kWrongMode (automatic frames do
  // not run), kBusy as for poll(). kNoData: no frame with data of this slave has ended since the
  // last call; or, with SpiCheck::kFull, a call before has seen what may have changed the words
  // that wait, mostly a register access or a command that has read zeros, and this call drops them.
  // kCrc: one has, and its CRC was wrong; told once for each frame,
  // without a stored CRC as for poll(). kSlaveError: one has, and its nE is 0; Result::reading()
  // has it. kNoWord: as for poll(). kTimeout, kLineError, kCorrupted, kTransport, kNotDetected,
  // kBankSwitched as for poll().
  //
  // `Parts` is as With, for this call: poll_slave<0>() is for one slave, BiSS of up to 32 data bits
  // with SpiCheck::kCrc or kOff and Config::hold_beside_access. Without MB4_WITH_BEATS it does not
  // look at SWBANKFAIL, so the alarm always comes after 16 periods, and kNoWord is kCrc.
  // kUnsupported (not touched): the configuration, count() or crc_table() needs such a part.
  template <std::uint8_t Parts = With>
  Result<Reading> poll_slave(std::uint8_t slave) {
    return detail::Blocking::poll_slave<Parts>(chip_, slave);
  }

  // Begins to read one slave (1..8) without a transfer: the caller makes the frames of `read` and
  // calls finish() until it returns true. The result is that of poll_slave(). Most reads are one
  // step of four frames:
  //   0x07        HOLDBANK = 1, AGS = 1
  //   0x09, 0x03  SCDATA of the slave; only the bytes that hold data
  //   0x05        0xF0..0xF4
  //   0x02        0xF1..0xF4: SVALID of the slave = 0, HOLDBANK = 0, AGS = 1
  // A bad word needs two more steps, of three frames and two. SpiCheck::kFull and a control
  // communication without Config::hold_beside_access need up to six steps, as poll_slave() does,
  // and SpiCheck::kFullAndRelease up to seven: they decide between the transfers.
  //
  // No other call on the Device may come between this one and the end of the read. To give up a
  // read, call finish() with transferred = false until it returns true, without making its frames.
  // Not touched: kInvalidArgument, kWrongMode, kBusy, kUnsupported as for poll_slave().
  template <std::uint8_t Parts = With>
  Result<void> plan_slave(std::uint8_t slave, CyclicRead& read) {
    return detail::Reads::plan<Parts>(chip_, read, slave, !chip_.checks_all());
  }

  // Takes what came back. `transferred`: every frame of `read` was made. `now_us`: the time, as
  // Clock::now_us() counts it. True: the read has ended, see CyclicRead::result(). False: make the
  // frames that `read` holds now, and call it again. It makes no transfer and does not ask for the
  // time. `Parts` is that of plan_slave(). With another one the read ends with kUnsupported.
  template <std::uint8_t Parts = With>
  [[nodiscard]] bool finish(CyclicRead& read, bool transferred, std::uint32_t now_us) {
    return detail::Reads::finish<Parts>(chip_, read, transferred, now_us);
  }

  // As plan_slave(), for all enabled sensors, in one chain: 0x07; 0x09 and 0x03, 1..n frames, the
  // neighbours in one; 0x05; 0x02. No frame is longer than 25 bytes, unless `wide` allows 66. Then
  // finish() until it returns true, and FrameRead::result(). kWrongMode, kBusy (not touched) as for
  // poll().
  Result<void> plan(FrameRead& read, bool wide = false) {
    return detail::Reads::begin(chip_, read, !chip_.checks_all(), wide);
  }
  template <std::uint8_t Parts = With>
  [[nodiscard]] bool finish(FrameRead& read, bool transferred, std::uint32_t now_us) {
    static_assert(Parts == With, "mb4: the read of all slaves has all parts");
    return detail::Reads::take<MB4_WITH_ALL>(chip_, read, transferred, now_us);  // as plan()
  }

  // The same for an operation that this object has begun: Device::finish().
  [[nodiscard]] bool finish(Operation& operation, bool transferred, std::uint32_t now_us) {
    return detail::Procedures::finish(chip_, operation, transferred, now_us);
  }

  // Call it again after configure() and start(): period and time are those of the moment. Counts
  // the reads from now on in `counts` (mb4_cyclic.h), which must outlive the Device or the next
  // call; nullptr ends it. A call without MB4_WITH_COUNTS in its parts is kUnsupported meanwhile.
  // What is lost is counted with FrameStart::kPeriodic and with Config::pin_period_us. If that is
  // no whole number of microseconds, set counts->period_ns after this call.
  void count(mb4_counts* counts) {
    static_assert((With & MB4_WITH_COUNTS) != 0,
                  "mb4: this object cannot count; it needs the part MB4_WITH_COUNTS");
    chip_.set_counts(counts);
    if (counts != nullptr) {
      const Config& config = chip_.config;
      counts->period_ns = config.frame_start != FrameStart::kPeriodic
                              ? config.pin_period_us * 1000U
                              : static_cast<std::uint32_t>(std::uint64_t{config.frame_period_clk} *
                                                           1'000'000'000U / config.f_clk_hz);
    }
  }

  // From now on the CRC of `slave` goes by `table`, four bits a step: 64 bytes of RAM for half the
  // time of a read. The driver fills the table, which must outlive the Device or the next
  // configure(), which ends it. Not touched: kNotConfigured; kInvalidArgument: the slave is no
  // enabled sensor, or no CRC of it is stored.
  Result<void> crc_table(std::uint8_t slave, std::array<std::uint32_t, 16>& table) {
    static_assert((With & MB4_WITH_TABLE) != 0,
                  "mb4: this object has no table; it needs the part MB4_WITH_TABLE");
    return detail::Reads::crc_table(chip_, slave, table.data());
  }

  // Device::write_actuator() for a control loop that writes a word for each frame. Never waits;
  // three transfers, seven with SpiCheck::kFull. `word` has at most data_bits bits. The
  // chip sends the word with the frame after the one that runs. Only one of the two banks gets the
  // word: if the caller writes no other word before the frame after that, that frame sends the
  // previous word.
  //
  // Not touched: kWrongMode (automatic frames do not run), kBusy, kInvalidArgument. kTransport,
  // kNotDetected, kCorrupted as for Device::write_actuator().
  Result<void> write_actuator(std::uint8_t slave, std::uint64_t word) {
    return detail::Blocking::run(chip_, plan_word(chip_.own, slave, word, actuator_allowed()));
  }

  // Begins write_actuator() without a transfer, as plan_start(): one step of three frames, with
  // SpiCheck::kFull three steps of two or three, between which a read of positions is kBusy: it
  // would free the bank. Not touched: kWrongMode, kBusy, kInvalidArgument. operation.result():
  // kTransport, kNotDetected, kCorrupted.
  Result<void> plan_actuator(Operation& operation, std::uint8_t slave, std::uint64_t word) {
    return plan_word(operation, slave, word,
                     detail::Procedures::possible(operation, actuator_allowed()));
  }

  // Waits for the next new frame, at most frame_timeout_us() plus one frame period, and fetches it
  // as poll() does. After an error, and after a frame in which a slave was not good (table 69), the
  // next call begins with restart(), unless a control communication runs; not after kSlaveError.
  //
  // Errors: kWrongMode (automatic frames do not run; not touched) and those of poll(). kTimeout,
  // kLineError: no frame has ended in time; BREAK was sent, which also ends a control
  // communication. kNoData: no pulse at pin GETSENS in that time (FrameStart::kOnPin without
  // Config::pin_period_us); nothing is changed.
  template <std::uint8_t Parts = With>
  Result<void> next(Frame& frame) {
    return detail::Blocking::next<Parts>(chip_, frame);
  }

 private:
  [[nodiscard]] Result<void> actuator_allowed() const {
    if (!chip_.automatic) {
      return Error::kWrongMode;
    }
    return chip_.control_runs() || chip_.in_doubt() ? Error::kBusy : Error::kNone;
  }
  Result<void> plan_word(Operation& operation, std::uint8_t slave, std::uint64_t word,
                         const Result<void>& allowed) {
    return allowed ? detail::Procedures::plan_actuator(chip_, operation, slave, word, false)
                   : allowed;
  }

  detail::Chip<Bus, Clock>& chip_;
};

}  // namespace mb4

#endif  // MB4_AUTOMATIC_HPP_
