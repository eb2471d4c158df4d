// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// One read of a position in steps: the driver plans SPI frames, the caller makes them, by DMA or
// otherwise, and the driver takes what came back. The code is that of mb4_cyclic.h.

#ifndef MB4_CYCLIC_HPP_
#define MB4_CYCLIC_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/error.hpp"
#include "mb4/reading.hpp"
#include "mb4/result.hpp"
#include "mb4/span.hpp"
#include "mb4/status.hpp"
#include "mb4_cyclic.h"

namespace mb4 {

// Memory for one read, in the caller's hands: Automatic::plan_slave() begins the read,
// Automatic::finish() continues it. The object may be used again and again, and must stay where it
// is until the read has ended. Place it where DMA reaches it; each frame begins at a whole word.
class CyclicRead {
 public:
  CyclicRead() = default;
  CyclicRead(const CyclicRead&) = delete;
  CyclicRead& operator=(const CyclicRead&) = delete;

  static constexpr std::size_t kMaxFrames = MB4_PLAN_FRAMES;
  static constexpr std::size_t kMaxFrameBytes = 10;

  // SPI frames to make now, in this order, each with NCS low: tx(i) goes out while rx(i) comes in.
  // rx(i) is as long as tx(i), or empty for a write. i < frames() <= kMaxFrames.
  [[nodiscard]] std::size_t frames() const { return plan_.frames; }
  [[nodiscard]] Span<const std::uint8_t> tx(std::size_t i) const {
    return {plan_.tx[i], plan_.size[i]};
  }
  [[nodiscard]] Span<std::uint8_t> rx(std::size_t i) {
    return {plan_.rx[i], mb4_plan_reads(&plan_, static_cast<std::uint8_t>(i)) ? plan_.size[i] : 0U};
  }

  // Makes the frames on a bus (bus.hpp), one after the other. False: one has failed, and those
  // after it were not made.
  template <typename Bus>
  [[nodiscard]] bool run(Bus& bus) {
    for (std::size_t i = 0; i < frames(); ++i) {
      if (!bus.transfer(tx(i), rx(i))) {
        return false;
      }
    }
    return true;
  }

  // After finish() has returned true. kNone: position() is new, without the flag bits. Smaller code
  // than result().
  [[nodiscard]] Error error() const { return static_cast<Error>(code_); }
  [[nodiscard]] std::uint64_t position() const { return read_.reading.position; }
  // nE and nW of the slave, as in a Reading.
  [[nodiscard]] bool slave_error() const { return read_.reading.error; }
  [[nodiscard]] bool slave_warning() const { return read_.reading.warning; }

  // The same with everything else: what Automatic::poll_slave() returns.
  [[nodiscard]] Result<Reading> result() const {
    if (code_ != MB4_OK) {
      return static_cast<Error>(code_);
    }
    const mb4_reading& from = read_.reading;
    Reading reading;
    reading.raw = from.raw;
    reading.position = from.position;
    reading.crc = from.crc;
    reading.crc_stored = from.crc_stored;
    reading.error = from.error;
    reading.warning = from.warning;
    reading.slave = from.slave;
    return reading;
  }

 private:
  template <typename Bus, typename Clock>
  friend class Automatic;

  mb4_plan plan_;
  mb4_cyclic read_{};
  std::uint8_t code_ = MB4_NO_DATA;
};

namespace detail {

// `slave` 1..8 of a valid configuration.
inline void set_word(const Config& config, std::uint8_t slave, mb4_word& word) {
  const SlaveConfig& from = config.slaves[slave - 1U];
  mb4_slave_config one{};
  one.data_bits = from.data_bits;
  one.flags = static_cast<std::uint8_t>(from.flags);
  one.crc_start = from.crc_start;
  one.crc_polynomial = from.crc_polynomial;
  one.gray = from.gray;
  mb4_word_set(&word, slave, &one, static_cast<std::uint8_t>(config.spi_check));
}

// The parts of the read path, MB4_WITH_..., that `slave` needs.
constexpr unsigned needed(const Config& config, std::uint8_t slave) {
  const SlaveConfig& one = config.slaves[slave - 1U];
  unsigned parts = one.data_bits > 32 ? unsigned{MB4_WITH_LONG} : 0U;
  parts |= one.gray ? unsigned{MB4_WITH_GRAY} : 0U;
  parts |= config.spi_check == SpiCheck::kFull ? unsigned{MB4_WITH_FULL} : 0U;
  return parts | (config.hold_beside_access ? 0U : unsigned{MB4_WITH_UNHELD});
}

static_assert(static_cast<int>(Error::kCorrupted) == MB4_CORRUPTED);
static_assert(static_cast<int>(Error::kBankSwitched) == MB4_BANK_SWITCHED);
static_assert(static_cast<int>(SpiCheck::kFull) == MB4_SPI_CHECK_FULL);

}  // namespace detail
}  // namespace mb4

#endif  // MB4_CYCLIC_HPP_
