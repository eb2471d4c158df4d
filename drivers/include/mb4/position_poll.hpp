// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Layer 4: the position of one slave out of automatic frames, as small and as fast as it gets.

#ifndef MB4_POSITION_POLL_HPP_
#define MB4_POSITION_POLL_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/chip.hpp"
#include "mb4/config.hpp"
#include "mb4/frame.hpp"
#include "mb4/frame_poll.hpp"
#include "mb4/opcodes.hpp"
#include "mb4/reading.hpp"
#include "mb4/result.hpp"
#include "mb4/span.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

// Most SPI transfers of one Automatic::poll_slave(), whatever the chip answers.
inline constexpr unsigned kMaxPollSlaveTransfers = 6;
// The same with SpiCheck::kFull.
inline constexpr unsigned kMaxPollSlaveTransfersChecked = 9;

// Used through Automatic::poll_slave(), which documents the errors. The order of table 69, and why
// nothing is torn or old, as for Automatic::poll(); SVALID of this slave alone is looked at and
// cleared.
template <typename Bus, typename Clock>
class PositionPoll {
 public:
  constexpr PositionPoll(detail::Chip<Bus, Clock>& chip, std::uint8_t slave)
      : chip_(chip), slave_(slave) {}

  // Automatic frames run and the slave is enabled. `beside_control`: 0xF4 must not be written.
  Result<Reading> read(bool beside_control) {
    if (beside_control) {
      return read_frame(true);
    }
    Result<Reading> result = Error::kTransport;
    if (chip_.write_instruction(detail::kHoldAndAgs)) {
      result = read_frame(false);
    }
    if (!chip_.write_instruction(kAgs)) {
      return Error::kTransport;
    }
    return result;
  }

 private:
  static constexpr std::uint8_t kAgs = regs::AGS::encode<1>();

  // Beside a control communication the bank is not held. The flag is then cleared before the data
  // is read, so that it tells whether another frame has come meanwhile.
  Result<Reading> read_frame(bool beside_control) {
    const bool checks_all = chip_.checks_all();
    for (unsigned looks = beside_control && checks_all ? 2 : 1; looks > 0; --looks) {
      if (const Error failed = look(); failed != Error::kNone) {
        return failed;
      }
      if (!beside_control && checks_all && (status_.instruction() | kAgs) != detail::kHoldAndAgs) {
        return Error::kCorrupted;
      }
      if (!status_.valid(slave_)) {
        return status_.scd_error() ? Error::kCrc : Error::kNoData;
      }
    }
    if (beside_control && !write_clear()) {
      return Error::kTransport;
    }
    const Result<Reading> reading = fetch();
    if (const Error failed = look(); failed != Error::kNone) {
      return failed;
    }
    if (beside_control) {
      return status_.scd_error() || status_.valid(slave_) ? Error::kBankSwitched : reading;
    }
    if (!status_.valid(slave_)) {
      return Error::kNoData;
    }
    const Error kept = clear();
    return kept == Error::kNone ? reading : kept;
  }

  // Reads the status to status_. kTransport, kNotDetected.
  Error look() {
    std::array<std::uint8_t, Status::kBytes> bytes{};
    if (!chip_.opcodes.read_status(bytes)) {
      return Error::kTransport;
    }
    status_ = Status(bytes);
    return status_.plausible() ? Error::kNone : Error::kNotDetected;
  }

  using Bytes = std::array<std::uint8_t, regs::kScdataStride>;

  bool read_data(Bytes& bytes) {
    const Span<std::uint8_t> used(bytes.data(), reading_bytes(chip_.config, slave_));
    const std::uint8_t filler = chip_.checks_all() ? detail::kDataFiller : 0;
    return slave_ == 1
               ? chip_.opcodes.read_registers0(used, filler).ok()
               : chip_.opcodes.read_registers(regs::scdata_address(slave_), used, filler).ok();
  }

  Result<Reading> fetch() {
    Bytes bytes{};
    if (!read_data(bytes)) {
      return Error::kTransport;
    }
    if (chip_.checks_all() && detail::needs_second_reading(chip_.config, slave_, bytes)) {
      Bytes second{};
      if (!read_data(second)) {
        return Error::kTransport;
      }
      for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (bytes[i] != second[i]) {
          return Error::kCorrupted;
        }
      }
    }
    return decode_reading(chip_.config, slave_, bytes);
  }

  // 0 clears, 1 has no effect (page 35).
  bool write_clear() {
    const std::uint8_t keep =
        static_cast<std::uint8_t>(~unsigned{regs::kFamilySvalid.mask(slave_)});
    return chip_.opcodes
        .write_registers(regs::kFamilySvalid.address(slave_), Span<const std::uint8_t>(&keep, 1))
        .ok();
  }

  // With SpiCheck::kFull the flag is looked at; the chip takes some system clocks to clear it.
  Error clear() {
    if (!write_clear()) {
      return Error::kTransport;
    }
    if (!chip_.checks_all()) {
      return Error::kNone;
    }
    for (unsigned looks = 2; looks > 0; --looks) {
      if (const Error failed = look(); failed != Error::kNone) {
        return failed;
      }
      if (!status_.valid(slave_)) {
        return Error::kNone;
      }
    }
    return Error::kCorrupted;
  }

  detail::Chip<Bus, Clock>& chip_;
  Status status_;
  std::uint8_t slave_;
};

}  // namespace mb4

#endif  // MB4_POSITION_POLL_HPP_
