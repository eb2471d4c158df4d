// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Positions of automatic frames by snapshots: without HOLDBANK, without a write to the chip, and
// with the time at which the slave has latched its position.

#ifndef MB4_WORDS_SNAPSHOTS_HPP_
#define MB4_WORDS_SNAPSHOTS_HPP_

#include "enc/cpp17.hpp"
#if __cplusplus >= 201703L

#include <array>
#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/reading.hpp"
#include "mb4/result.hpp"
#include "mb4/words/page.hpp"
#include "mb4_page_regs.hpp"

namespace mb4 {

struct TimedReading {
  Reading reading;
  std::uint64_t latched = 0;  // clock of the core at which the slave latched this position
  std::uint32_t frame = 0;    // number of the line's frame, from 1 on
  // Frames of the line between this one and the one that the last call with a word, good or bad,
  // has told.
  std::uint32_t missed = 0;
};

// Reads what the frames of a Device bring that were started with Automatic::start(). It can be used
// from another context than the Device, for example an interrupt on page::FRAME, if the port can.
//
// Calls of the Device that take words from the chip (poll(), poll_slave(), next()) clear SVALID and
// may hold a bank: the words that they have taken are kCrc here. Use one way or the other.
template <typename Port>
class Snapshots {
 public:
  // `page` must outlive this object.
  explicit constexpr Snapshots(Page<Port>& page) : page_(&page) {}

  // `config` is that of the Device. Call it again after configure() or a reset of the chip. poll()
  // gives frames that end after this call. It also takes the events of before. kTransport;
  // kInvalidConfig: as validate() says, or SINGLEBANK.
  Result<void> begin(const Config& config) {
    if (const Result<void> valid = validate(config); !valid) {
      return valid;
    }
    if (config.single_bank) {
      return ErrorInfo(Error::kInvalidConfig, ConfigField::kSingleBank, 0);
    }
    sensors_ = sensors(config);
    for (std::uint8_t slave = 1; slave <= kSlaves; ++slave) {
      if (!is_in(sensors_, slave)) {
        continue;
      }
      detail::set_word(config, slave, words_[slave - 1U]);
      const Result<Snapshot> old = page_->snapshot(slave);
      if (!old) {
        return old.failure();
      }
      frames_[slave - 1U] = old->frame;
    }
    const Result<Events> taken = page_->take_events();
    return taken ? Result<void>() : taken.failure();
  }

  // The newest word of a slave. Never waits; six accesses, which change nothing.
  // kInvalidArgument: the slave is no enabled sensor. kNoData: no frame with a word of this slave
  // has ended since the last call. kCrc: one has, and its word is not valid; told once for each
  // frame. kCorrupted: the stored CRC does not belong to the data; told once. kSlaveError: nE is 0;
  // Result::reading() has the word. kTransport.
  Result<TimedReading> poll(std::uint8_t slave) {
    if (!is_in(sensors_, slave)) {
      return Error::kInvalidArgument;
    }
    const Result<Snapshot> taken = page_->snapshot(slave);
    if (!taken) {
      return taken.failure();
    }
    std::uint32_t& last = frames_[slave - 1U];
    // A frame that ended early leaves the bank with the word of an older one.
    const std::uint32_t newer = taken->frame - last;
    if (newer == 0 || newer > kHalf) {
      return Error::kNoData;
    }
    TimedReading timed;
    timed.missed = newer - 1U;
    last = taken->frame;
    if (!taken->valid) {
      return Error::kCrc;
    }
    const mb4_word& word = words_[slave - 1U];
    mb4_slot slot{};
    slot.low = static_cast<std::uint32_t>(taken->word);
    slot.high = static_cast<std::uint32_t>(taken->word >> 32U);
    slot.code = mb4_slot_good(&word, &slot, MB4_WITH_ALL) ? MB4_OK : MB4_CORRUPTED;
    static_cast<void>(mb4_slot_tell(&word, &slot, MB4_WITH_ALL));
    const Result<Reading> reading = detail::to_result(word, slot);
    if (!reading.has_reading()) {
      return reading.failure();
    }
    timed.reading = reading.reading();
    timed.latched = taken->latched;
    timed.frame = taken->frame;
    return {timed, reading.error()};
  }

 private:
  static constexpr std::uint32_t kHalf = 0x7FFF'FFFF;  // of the numbers, which wrap

  Page<Port>* page_;
  std::uint8_t sensors_ = 0;
  std::array<mb4_word, kSlaves> words_{};
  std::array<std::uint32_t, kSlaves> frames_{};  // number of the last one that poll() has seen
};

}  // namespace mb4

#endif  // C++17

#endif  // MB4_WORDS_SNAPSHOTS_HPP_
