// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The host waits for the interrupt behind each running frame, and reads the window of the channel
// before the next one ends. Where a safe position is good its age is 0; the events tell of the
// others.
#include <fmt/core.h>

#include <vector>

#include "dsl_page_regs_table.hpp"
#include "dsl_regs_table.hpp"
#include "dsl_window.hpp"
#include "masters/dsl/dsl_readings.hpp"
#include "sim/masters/dsl/live_dsl.hpp"
#include "sim/masters/dsl_model/link.hpp"
#include "word_port.hpp"
#include "word_registers.hpp"

namespace mb4::tool {
namespace {

namespace map = dsl::regs;
namespace page = dsl::page;

using sim::dsl_model::LinkState;
using sim::dsl_model::Restart;
using sim::dsl_model::SafeChannel;

constexpr const char* kNoAnswer = "AXI: no answer, or an error answer";

// A register of the map in its word.
constexpr unsigned word_at(unsigned address) { return address & ~3U; }
constexpr std::uint32_t byte_of(std::uint32_t word, unsigned address) {
  return word >> 8 * (address & 3U) & 0xFFU;
}

const char* reason_name(std::uint32_t code) {
  return sim::dsl_model::name_of(static_cast<Restart>(code));
}

class RegisterReadings final : public DslReadings {
 public:
  RegisterReadings(sim::Simulator& simulator, std::string* log)
      : simulator_(simulator),
        host_(simulator.host<sim::DslHost>("axi")),
        port_(simulator, log),
        irq_(*simulator.pin_by_name("irq_o")) {}

  std::string begin() override {
    const std::uint32_t enable = page::FRAME_ENDED_ENABLE::kMask | page::LINK_LOST_ENABLE::kMask;
    return port_.write(page::kAddrIrqEnable, enable) ? "" : kNoAnswer;
  }
  std::optional<DslReading> next(sim::Time limit) override;
  std::uint64_t restarts() override {
    count_restarts();
    return restarts_;
  }
  std::string state() override;
  std::uint32_t identity() const override { return identity_; }
  RegisterMap registers() override;
  std::string note() const override {
    return missed_ == 0
               ? ""
               : fmt::format("{} frames ended before the host had read the one before", missed_);
  }

 private:
  bool take(DslReading& frame);
  bool take_position(DslReading& frame);
  bool take_safe(DslReading& frame);
  bool read_safe(unsigned first, SafeChannel& safe, std::uint32_t& age);
  bool read_identity();
  bool count_restarts();

  sim::Simulator& simulator_;
  sim::DslHost& host_;
  WordPort port_;
  sim::Pin irq_;
  std::uint32_t identity_ = 0;
  std::uint32_t counted_ = 0;        // NUM_RESETS
  std::uint64_t restarts_ = 0;       // without its wrap
  std::uint64_t number_ = 0;         // FRAME_COUNT without its wrap
  std::uint64_t number_before_ = 0;  // of the frame that was read before
  std::uint64_t missed_ = 0;
};

std::optional<DslReading> RegisterReadings::next(sim::Time limit) {
  while (true) {
    simulator_.run_while_waiting([this] { return simulator_.pin(irq_); }, limit);
    std::uint32_t status = 0;
    if (!simulator_.pin(irq_) || !port_.read(page::kAddrIrqStatus, status) ||
        !port_.write(page::kAddrIrqStatus, status)) {
      return std::nullopt;
    }
    const std::uint64_t before = restarts_;
    DslReading frame;
    const bool ended = page::FRAME_ENDED::get(status) != 0;
    if ((ended && !take(frame)) || !count_restarts()) return std::nullopt;
    if (restarts_ != before) {
      identity_ = 0;  // another encoder may come
      std::uint32_t now = 0;
      if (!port_.read(page::kAddrStatus, now)) return std::nullopt;
      frame.restart = reason_name(page::RESTART_REASON::get(now));
    }
    // The position alone is lost before its frame has ended.
    if (ended || restarts_ != before) return frame;
  }
}

bool RegisterReadings::count_restarts() {
  std::uint32_t word = 0;
  if (!port_.read(page::kAddrRestarts, word)) return false;
  constexpr std::uint32_t kWraps = page::NUM_RESETS::kMask;
  const std::uint32_t counted = page::NUM_RESETS::get(word);
  restarts_ += (counted - counted_) & kWraps;
  counted_ = counted;
  return true;
}

bool RegisterReadings::take(DslReading& frame) {
  return (identity_ != 0 || read_identity()) && take_position(frame) && take_safe(frame);
}

bool RegisterReadings::read_identity() {
  std::uint32_t high = 0;
  std::uint32_t low = 0;
  if (!port_.read(word_at(map::kAddrEncId2), high) || !port_.read(word_at(map::kAddrEncId0), low)) {
    return false;
  }
  const auto byte = [&](unsigned address) {
    return byte_of(word_at(address) == word_at(map::kAddrEncId2) ? high : low, address);
  };
  identity_ = byte(map::kAddrEncId2) << 16U | byte(map::kAddrEncId1) << 8U | byte(map::kAddrEncId0);
  return true;
}

bool RegisterReadings::take_position(DslReading& frame) {
  const auto window = read_dsl_window(port_);
  std::uint32_t missing = 0;
  if (!window || !port_.read(word_at(map::kAddrAccErrCnt), missing)) return false;
  const std::uint32_t since = window->number - static_cast<std::uint32_t>(number_);
  if (number_ != 0 && since > 1) missed_ += since - 1;
  number_before_ = number_;
  number_ += since;
  frame.number = number_;
  frame.sampled = host_.edge_at(window->time).value_or(simulator_.now());
  frame.acceleration_good = byte_of(missing, map::kAddrAccErrCnt) == 0;
  frame.lost = window->lost;
  frame.position = window->position & ~std::uint64_t{0} >> (64 - dsl_position_bits(identity_));
  frame.speed = window->speed;
  frame.quality = window->quality;
  frame.delay = window->delay;
  return true;
}

bool RegisterReadings::take_safe(DslReading& frame) {
  std::uint32_t events = 0;
  std::uint32_t age = 0;
  if (!port_.read(word_at(map::kAddrEventH), events) ||
      !read_safe(page::kAddrSafe1Lo, frame.safe1, age)) {
    return false;
  }
  constexpr std::uint32_t kOfSafe = map::SCE::kMask | map::VPOS::kMask;
  const std::uint32_t told = byte_of(events, map::kAddrEventH) & kOfSafe;
  const auto since = static_cast<std::uint32_t>(frame.number - number_before_);
  frame.safe_new = told != 0 || (frame.safe1.valid && age < since);
  if (!frame.safe_new) return true;
  // Writing 0 clears an event.
  constexpr unsigned kLane = map::kAddrEventH & 3U;
  const std::uint32_t kept = ~told & 0xFFU;
  std::uint32_t again = 0;
  std::uint32_t count = 0;
  std::uint32_t age2 = 0;
  const bool done = (told == 0 || port_.write(word_at(map::kAddrEventH), kept << 8 * kLane,
                                              static_cast<std::uint8_t>(1U << kLane))) &&
                    read_safe(page::kAddrSafe2Lo, frame.safe2, age2) &&
                    port_.read(page::kAddrPosLo, again) && port_.read(page::kAddrFrameCount, count);
  // On a slow bus they may be those of another frame.
  frame.safe_here = age == 0 && count == static_cast<std::uint32_t>(frame.number);
  return done;
}

// Both groups have the same form.
bool RegisterReadings::read_safe(unsigned first, SafeChannel& safe, std::uint32_t& age) {
  static_assert(page::kAddrSafe2Age - page::kAddrSafe2Lo ==
                page::kAddrSafe1Age - page::kAddrSafe1Lo);
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint32_t check = 0;
  const auto at = [first](unsigned address) { return first + (address - page::kAddrSafe1Lo); };
  if (!port_.read(first, low) || !port_.read(at(page::kAddrSafe1Hi), high) ||
      !port_.read(at(page::kAddrSafe1Check), check) || !port_.read(at(page::kAddrSafe1Age), age)) {
    return false;
  }
  safe.position = std::uint64_t{page::SAFE1_HI::get(high)} << 32U | low;
  safe.valid = page::SAFE1_GOOD::get(check) != 0;
  safe.error = page::SAFE1_SCE::get(check) != 0;
  safe.summary = static_cast<std::uint8_t>(page::SAFE1_SUMMARY::get(check));
  safe.crc = static_cast<std::uint16_t>(page::SAFE1_CRC::get(check));
  return true;
}

std::string RegisterReadings::state() {
  std::uint32_t status = 0;
  if (!port_.read(page::kAddrStatus, status) || !count_restarts()) return kNoAnswer;
  return fmt::format("state {}, {} restarts, the last one: {}",
                     sim::dsl_model::name_of(static_cast<LinkState>(page::LINK_STATE::get(status))),
                     restarts_, reason_name(page::RESTART_REASON::get(status)));
}

// Those of the map are bytes of its words. Frames that ended since the last reading are no event of
// the link.
RegisterMap RegisterReadings::registers() {
  port_.write(page::kAddrIrqStatus, page::FRAME_ENDED::kMask | page::FRAME_LOST::kMask);
  RegisterMap out = read_registers(port_, page::kAddrTimeHigh, page::kFields, page::kCodes);
  std::vector<RegisterMap::Field> fields;
  for (const auto& field : map::kFields) {
    const unsigned lane = 8 * (field.address & 3U);
    fields.push_back(
        field_of(field, map::kCodes, out.words[field.address / sizeof(std::uint32_t)]));
    fields.back().address = word_at(field.address);
    fields.back().lsb += lane;
  }
  out.fields.insert(out.fields.begin(), fields.begin(), fields.end());
  return out;
}

}  // namespace

std::unique_ptr<DslReadings> readings_of_registers(sim::Simulator& simulator, std::string* log) {
  return std::make_unique<RegisterReadings>(simulator, log);
}

}  // namespace mb4::tool
