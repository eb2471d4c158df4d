// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Layer 4: all slaves out of automatic frames, held by HOLDBANK or beside a control communication.

#ifndef MB4_FRAME_POLL_HPP_
#define MB4_FRAME_POLL_HPP_

#include <cstdint>

#include "mb4/chip.hpp"
#include "mb4/config.hpp"
#include "mb4/frame.hpp"
#include "mb4/result.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

namespace detail {

// 0xF4 while a bank is held.
inline constexpr std::uint8_t kHoldAndAgs = regs::AGS::encode<1>() | regs::HOLDBANK::encode<1>();

}  // namespace detail

// Used through Automatic::poll(), which documents order and errors.
template <typename Bus, typename Clock>
class FramePoll {
 public:
  explicit constexpr FramePoll(detail::Chip<Bus, Clock>& chip) : chip_(chip) {}

  // HOLDBANK is set.
  Result<void> read_held(Frame& frame) {
    const Result<Status> before = chip_.read_status();
    if (!before) {
      return before.info();
    }
    // Without HOLDBANK data may be torn, with SWBANK or INIT it is another one.
    if (chip_.checks_all() &&
        (before->instruction() | regs::AGS::encode<1>()) != detail::kHoldAndAgs) {
      return Error::kCorrupted;
    }
    const std::uint8_t fresh = detail::valid_slaves(chip_.config, *before);
    if (fresh == 0) {
      return store(frame, *before, 0, nullptr);
    }
    detail::FetchedData data;
    if (const Result<void> fetched =
            detail::fetch_data(chip_.opcodes, chip_.config, enabled_slaves(chip_.config), data);
        !fetched) {
      return fetched;
    }
    const Result<Status> after = chip_.read_status();
    if (!after) {
      return after.info();
    }
    if (const Result<void> clear = chip_.clear_valid_checked(enabled_slaves(chip_.config));
        !clear) {
      return clear;
    }
    const unsigned good = fresh & detail::valid_slaves(chip_.config, *after);
    return store(frame, *after, static_cast<std::uint8_t>(good), &data);
  }

  // No HOLDBANK. Proof that the data belongs together: SVALID of all is 0 after it has been read,
  // so no good frame has ended since it was cleared; nSCDERR = 1, so the last frame was not a bad
  // one either. Proof that it is good: that last frame is the one that was read.
  Result<void> read_beside_control(Frame& frame) {
    const Result<Status> before = chip_.read_status();
    if (!before) {
      return before.info();
    }
    std::uint8_t fresh = detail::valid_slaves(chip_.config, *before);
    if (fresh != 0 && chip_.checks_all()) {
      // The flags are cleared before the data is read: this is the only other look at them.
      const Result<Status> again = chip_.read_status();
      if (!again) {
        return again.info();
      }
      fresh = static_cast<std::uint8_t>(fresh & detail::valid_slaves(chip_.config, *again));
    }
    if (fresh == 0) {
      return store(frame, *before, 0, nullptr);
    }
    if (const Result<void> clear = chip_.clear_valid(enabled_slaves(chip_.config)); !clear) {
      return clear;
    }
    detail::FetchedData data;
    if (const Result<void> fetched =
            detail::fetch_data(chip_.opcodes, chip_.config, enabled_slaves(chip_.config), data);
        !fetched) {
      return fetched;
    }
    const Result<Status> after = chip_.read_status();
    if (!after) {
      return after.info();
    }
    if (after->scd_error() || detail::valid_slaves(chip_.config, *after) != 0) {
      return Error::kBankSwitched;
    }
    return store(frame, *after, fresh, &data);
  }

 private:
  // nSCDERR is about the last frame on the line, which may be later than the bank that was read. A
  // slave without SVALID beside one with it was bad in any case.
  Result<void> store(Frame& frame, const Status& status, std::uint8_t good,
                     const detail::FetchedData* data) {
    frame.status = status;
    const std::uint8_t enabled = enabled_slaves(chip_.config);
    for (std::uint8_t slave = 1; slave <= kSlaves; ++slave) {
      const unsigned bit = 1U << (slave - 1U);
      if ((good & bit) != 0) {
        frame.set(slave, detail::decode(chip_.config, slave, *data));
      } else if ((enabled & bit) != 0) {
        frame.set(slave, good != 0 || status.scd_error() ? Error::kCrc : Error::kNoData);
      }
    }
    return {};
  }

  detail::Chip<Bus, Clock>& chip_;
};

}  // namespace mb4

#endif  // MB4_FRAME_POLL_HPP_
