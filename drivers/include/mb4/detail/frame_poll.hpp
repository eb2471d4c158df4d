// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Reads one slave or all slaves from automatic frames, with HOLDBANK, or without it where a chip
// does not allow it beside a control communication.

#ifndef MB4_DETAIL_FRAME_POLL_HPP_
#define MB4_DETAIL_FRAME_POLL_HPP_

#include <array>
#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/detail/chip.hpp"
#include "mb4/detail/fetch.hpp"
#include "mb4/frame.hpp"
#include "mb4/reading.hpp"
#include "mb4/result.hpp"
#include "mb4/span.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4::detail {

// 0xF4 while a bank is held.
inline constexpr std::uint8_t kHoldAndAgs = regs::AGS::encode<1>() | regs::HOLDBANK::encode<1>();

// Used through Automatic::poll() and poll_slave(), which document order and errors. The caller
// passes the function that fetches the data. So a program that reads one slave does not link the
// code for all slaves, and a program with both has this procedure only once.
template <typename Bus, typename Clock>
class FramePoll {
 public:
  explicit constexpr FramePoll(Chip<Bus, Clock>& chip) : chip_(chip) {}

  // Reads the data. Of the slaves of `missing` it finds out which are bad (judge()); if they are
  // all that is read, it reads no other data.
  using Fetch = Result<void> (*)(Chip<Bus, Clock>& chip, void* data, std::uint16_t missing,
                                 std::uint16_t& bad);

  // Reads the slaves of `mask` (flag_of()); `fetch` stores their bytes in `data`.
  // `beside_control`: a control communication runs.
  Result<void> read(std::uint16_t mask, bool beside_control, Outcome& out, Fetch fetch,
                    void* data) {
    if (beside_control && !chip_.config.hold_beside_access) {
      const Result<void> first = run(mask, true, out, fetch, data);
      // Directly after a switch there is the time of a frame until the next one. A frame may also
      // have ended after the first look.
      // watch() counts from the end of the control communication, which has its own timeout.
      chip_.watch.news_us = chip_.clock->now_us();
      return (first ? out.good != 0 : first.error() != Error::kBankSwitched)
                 ? first
                 : run(mask, true, out, fetch, data);
    }
    constexpr std::uint8_t kAgs = regs::AGS::encode<1>();
    chip_.control.overwritten = true;
    Result<void> done = chip_.write_instruction(kHoldAndAgs);
    if (done) {
      done = run(mask, false, out, fetch, data);
    }
    const Result<void> released = chip_.write_instruction(kAgs);
    done = done ? released : done;
    return done ? watch(out) : done;
  }

 private:
  // `unheld`: 0xF4 must not be written. Two facts then prove that the data belongs to one good
  // frame. SVALID of all slaves is cleared before the data is read and still 0 after
  // it, so no good frame has ended meanwhile. nSCDERR is 1, so no bad frame has ended either, and
  // no word is bad: there is nothing to judge. judge() may write only into a bank that is held.
  // SVALID is then seen only in the first status; with SpiCheck::kFull the driver reads that status
  // twice.
  Result<void> run(std::uint16_t mask, bool unheld, Outcome& out, Fetch fetch, void* data) {
    Status& status = out.status;
    unsigned fresh = mask;
    for (unsigned looks = unheld && chip_.checks_all() ? 2 : 1; looks > 0; --looks) {
      if (const Result<void> look = chip_.look(status); !look) {
        return look;
      }
      // The chip must hold exactly the byte that was written. Without HOLDBANK the bytes may come
      // from two frames; with SWBANK or INIT they are other data.
      if (!unheld && chip_.checks_all() &&
          (status.instruction() | regs::AGS::encode<1>()) != kHoldAndAgs) {
        return Error::kCorrupted;
      }
      chip_.control.seen_running = !status.control_ended();
      fresh &= status.valid_flags();
      if (fresh == 0) {
        // nSCDERR = 0 names no slave, and stays until the next frame.
        return status.scd_error() && !unheld ? fetch(chip_, data, mask, out.bad) : Result<void>();
      }
    }
    Result<void> done = unheld ? chip_.clear_valid(mask) : Result<void>();
    if (done) {
      const unsigned missing = unheld ? 0 : mask & ~fresh;
      done = fetch(chip_, data, static_cast<std::uint16_t>(missing), out.bad);
    }
    if (done) {
      done = chip_.look(status);
    }
    if (!done) {
      return done;
    }
    const unsigned still = status.valid_flags() & unsigned{mask};
    if (unheld && (status.scd_error() || still != 0)) {
      return Error::kBankSwitched;
    }
    out.good = static_cast<std::uint16_t>(unheld ? fresh : fresh & still);
    return unheld ? Result<void>() : chip_.clear_valid_checked(mask);
  }

  // Two periods without a frame are too long, if the chip has left out frames (nAGSERR = 0), or if
  // the last one was bad and no stored CRC tells whose word; the lines tell more. nSCDERR = 0 stays
  // when no more frames end, so nAGSERR = 0 counts first: a bad word is then news only by its
  // stored CRC. A loop that holds the bank for longer than the frames are apart may meet no switch
  // for a while, and nAGSERR stays 1. So does it for frames back to back, and in a chip that has
  // been reset or lost its clock; the limit without a flag is generous. With FrameStart::kOnPin
  // only the caller knows when frames come.
  Result<void> watch(const Outcome& out) {
    const std::uint32_t now_us = chip_.clock->now_us();
    const bool left_out = out.status.start_error();
    const bool unproven = (out.bad & kUnproven) != 0;
    if (out.good != 0 || (out.bad != 0 && !unproven)) {
      chip_.watch.news_us = now_us;
    }
    const mb4_watch& watch = chip_.watch;
    const std::uint32_t limit_us = left_out || unproven ? watch.omitted_us : watch.silent_us;
    if (watch.silent_us == 0 || now_us - watch.news_us <= limit_us) {
      return {};
    }
    const Result<void> line = chip_.look_at_lines();
    return line ? unproven && !left_out ? Error::kCrc : Error::kTimeout : line.error();
  }

  Chip<Bus, Clock>& chip_;
};

// Tells whether the word of `slave` in the held bank, whose SVALID is 0, is a bad one: sets its
// flag in `bad`. Otherwise it was good, and has been read before.
//
// With a stored CRC the word itself tells. A bad word then gets the CRC that fits, so that it
// counts once; the next frame overwrites it. Without one nSCDERR = 0 is all there is: it concerns
// this slave if there is no other, or if `news`, a good word of another slave, shows that the frame
// is new.
template <typename Bus, typename Clock>
Result<void> judge(Chip<Bus, Clock>& chip, std::uint8_t slave, const std::uint8_t* bytes, bool news,
                   std::uint16_t& bad) {
  const SlaveConfig& one = chip.config.slaves[slave - 1U];
  const std::uint16_t flag = flag_of(slave);
  if (!crc_is_stored(chip.config, one)) {
    bad = static_cast<std::uint16_t>(bad | kUnproven);
    if (news || chip.sensor_flags == flag) {
      bad = static_cast<std::uint16_t>(bad | flag);
    }
    return {};
  }
  const std::uint32_t crc = crc_on_line(one, bytes);
  if (crc == stored_crc(one, bytes)) {
    return {};
  }
  bad = static_cast<std::uint16_t>(bad | flag);
  const std::array<std::uint8_t, 2> both{static_cast<std::uint8_t>(crc),
                                         static_cast<std::uint8_t>(crc >> 8)};
  const std::uint8_t size = crc_bytes(one);
  return chip.opcodes.write_registers(
      static_cast<std::uint8_t>(regs::scdata_address(slave) + regs::kScdataStride - size),
      Span<const std::uint8_t>(both.data(), size));
}

}  // namespace mb4::detail

#endif  // MB4_DETAIL_FRAME_POLL_HPP_
