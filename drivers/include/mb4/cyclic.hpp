// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// One read of positions in steps: the driver plans SPI frames, the caller makes them, by DMA or
// otherwise, and the driver takes what came back. The code is that of mb4_cyclic.h.

#ifndef MB4_CYCLIC_HPP_
#define MB4_CYCLIC_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/error.hpp"
#include "mb4/frame.hpp"
#include "mb4/reading.hpp"
#include "mb4/result.hpp"
#include "mb4/status.hpp"
#include "mb4/steps.hpp"
#include "mb4_cyclic.h"

namespace mb4 {

namespace detail {
struct Blocking;
struct Procedures;
struct Reads;
}  // namespace detail

// The SPI frames of a read in steps.
class ReadSteps : public Steps {
 protected:
  ReadSteps() = default;
  ~ReadSteps() = default;
  void attach(std::uint32_t* tx, std::uint32_t* rx, mb4_slot* slots) {
    mb4_plan_memory(&plan_, tx, rx);
    read_.slots = slots;
  }

  friend struct detail::Blocking;
  friend struct detail::Procedures;
  friend struct detail::Reads;

  mb4_cyclic read_{};
  std::uint8_t code_ = MB4_NO_DATA;
  std::uint32_t shape_ = 0;  // bytes of each slave in the plan, four bits each
};

// Memory for reads of one slave, in the caller's hands: Automatic::plan_slave() begins the read,
// Automatic::finish() continues it. The object may be used again and again with one Device, which
// must not be made anew meanwhile, and must stay where it is until the read has ended. Place it
// where DMA reaches it; each frame begins at a whole word.
class CyclicRead : public ReadSteps {
 public:
  CyclicRead() { attach(tx_.data(), rx_.data(), &slot_); }

  static constexpr std::size_t kMaxFrameBytes = 10;

  // After finish() has returned true. kNone: position() is new, without the flag bits. kSlaveError:
  // it is new, and nE is 0: it is not to be trusted. Other errors: it is an old one. Smaller code
  // than result().
  [[nodiscard]] Error error() const { return static_cast<Error>(code_); }
  [[nodiscard]] std::uint64_t position() const { return reading_.position; }
  // nE and nW of the slave, as in a Reading.
  [[nodiscard]] bool slave_error() const { return reading_.slave_error; }
  [[nodiscard]] bool slave_warning() const { return reading_.slave_warning; }

  // The same with everything else: what Automatic::poll_slave() returns.
  [[nodiscard]] Result<Reading> result() const { return detail::to_result(reading_, code_); }

 private:
  friend struct detail::Blocking;
  friend struct detail::Reads;

  // After a single frame: the result of the one word.
  Result<Reading> single() const {
    return code_ != MB4_OK ? Result<Reading>(static_cast<Error>(code_))
                           : detail::to_result(*read_.words, slot_);
  }

  std::array<std::uint32_t, MB4_PLAN_WORDS(1)> tx_;
  std::array<std::uint32_t, MB4_PLAN_WORDS(1)> rx_;
  mb4_slot slot_{};
  mb4_reading reading_{};
};

// The same for all slaves at once: Automatic::plan() and finish(), or, by a single frame,
// Device::plan_read_all(). About 450 bytes.
class FrameRead : public ReadSteps {
 public:
  FrameRead() { attach(tx_.data(), rx_.data(), slots_.data()); }

  static constexpr std::size_t kMaxFrameBytes = MB4_PLAN_LONGEST;

  // After finish() has returned true: what Automatic::poll() returns, and the results of the
  // slaves.
  Result<void> result(Frame& frame) const {
    frame.clear();
    if (!read_.told) {
      return static_cast<Error>(code_);
    }
    fill(frame);
    return {};
  }
  // All readings of the result are of one frame. Always true, except after a bad word, whose slave
  // may have sent a good one meanwhile.
  [[nodiscard]] bool one_frame() const { return read_.one_frame; }

 private:
  void fill(Frame& frame) const {
    std::array<std::uint8_t, Status::kBytes> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      bytes[i] = read_.status[i];
    }
    frame.status = Status(bytes);
    frame.one_frame = read_.one_frame;
    for (std::size_t i = 0; i < read_.count; ++i) {
      frame.set(read_.words[i].slave, detail::to_result(read_.words[i], slots_[i]));
    }
  }

  std::array<std::uint32_t, MB4_PLAN_WORDS(kSlaves)> tx_;
  std::array<std::uint32_t, MB4_PLAN_WORDS(kSlaves)> rx_;
  std::array<mb4_slot, kSlaves> slots_{};
};

namespace detail {

// The parts of the read path, MB4_WITH_..., that `slave` needs.
constexpr unsigned needed(const Config& config, std::uint8_t slave) {
  const SlaveConfig& one = config.slaves[slave - 1U];
  unsigned parts = one.data_bits > 32 ? unsigned{MB4_WITH_LONG} : 0U;
  parts |= one.gray ? unsigned{MB4_WITH_GRAY} : 0U;
  parts |= config.spi_check >= SpiCheck::kFull ? unsigned{MB4_WITH_FULL} : 0U;
  return parts | (config.hold_beside_access ? 0U : unsigned{MB4_WITH_UNHELD});
}

}  // namespace detail
}  // namespace mb4

#endif  // MB4_CYCLIC_HPP_
