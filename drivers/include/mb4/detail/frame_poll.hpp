// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Reads one slave or all slaves from automatic frames, with HOLDBANK, or without it while
// a control communication runs.

#ifndef MB4_DETAIL_FRAME_POLL_HPP_
#define MB4_DETAIL_FRAME_POLL_HPP_

#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/detail/chip.hpp"
#include "mb4/detail/fetch.hpp"
#include "mb4/frame.hpp"
#include "mb4/result.hpp"
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

  using Fetch = Result<void> (*)(Chip<Bus, Clock>& chip, void* data);

  // Reads the slaves of `mask`, all sensors; `fetch` stores their bytes in `data`.
  // `beside_control`: a control communication runs, and 0xF4 must not be written.
  Result<void> read(std::uint8_t mask, bool beside_control, Outcome& out, Fetch fetch, void* data) {
    if (beside_control) {
      return run(mask, true, out, fetch, data);
    }
    constexpr std::uint8_t kAgs = regs::AGS::encode<1>();
    Result<void> done = chip_.write_instruction(kHoldAndAgs);
    if (done) {
      done = run(mask, false, out, fetch, data);
    }
    const Result<void> released = chip_.write_instruction(kAgs);
    return done ? released : done;
  }

 private:
  // While a control communication runs, the bank is not held. Two facts prove that the data belongs
  // to one good frame. SVALID of all slaves is cleared before the data is read and still 0 after
  // it, so no good frame has ended meanwhile. nSCDERR is 1, so no bad frame has ended either.
  // SVALID is then seen only in the first status; with SpiCheck::kFull the driver reads that status
  // twice.
  Result<void> run(std::uint8_t mask, bool beside_control, Outcome& out, Fetch fetch, void* data) {
    Status& status = out.status;
    std::uint8_t fresh = mask;
    for (unsigned looks = beside_control && chip_.checks_all() ? 2 : 1; looks > 0; --looks) {
      if (const Result<void> look = chip_.look(status); !look) {
        return look;
      }
      // The chip must hold exactly the byte that was written. Without HOLDBANK the bytes may come
      // from two frames; with SWBANK or INIT they are other data.
      if (!beside_control && chip_.checks_all() &&
          (status.instruction() | regs::AGS::encode<1>()) != kHoldAndAgs) {
        return Error::kCorrupted;
      }
      fresh = static_cast<std::uint8_t>(fresh & status.valid_mask());
      if (fresh == 0) {
        return {};
      }
    }
    Result<void> done = beside_control ? chip_.clear_valid(mask) : Result<void>();
    if (done) {
      done = fetch(chip_, data);
    }
    if (done) {
      done = chip_.look(status);
    }
    if (!done) {
      return done;
    }
    const unsigned still = status.valid_mask() & unsigned{mask};
    if (beside_control) {
      out.good = fresh;
      return status.scd_error() || still != 0 ? Error::kBankSwitched : Error::kNone;
    }
    out.good = static_cast<std::uint8_t>(fresh & still);
    return chip_.clear_valid_checked(mask);
  }

  Chip<Bus, Clock>& chip_;
};

}  // namespace mb4::detail

#endif  // MB4_DETAIL_FRAME_POLL_HPP_
