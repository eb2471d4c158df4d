// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Random transactions of the two hosts of a DSL master with its encoder, one in four disturbed, and
// the judgement of each end: every one ends or is retried by rule, and none tells a success that
// the encoder has not had. The master is reached by the bytes of its map alone, so that the model
// and the RTL have the same judge.
#ifndef MB4_TESTS_UNIT_DSL_DIALOGUE_HPP_
#define MB4_TESTS_UNIT_DSL_DIALOGUE_HPP_

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/random.hpp"
#include "sim/lines/dsl/dsl_messages.hpp"
#include "sim/masters/dsl_model/host_bytes.hpp"
#include "tests/support/environment.hpp"

namespace mb4::sim::dsl_test {

namespace host_at = dsl_model::host_address;
namespace host_on = dsl_model::host_bit;

// Transactions of a long test: 1,000 in the suite, as many as the nightly run says.
inline std::uint64_t transactions(std::uint64_t usual = 1000) {
  return mb4test::number("MB4_DSL_TRANSACTIONS", usual);
}

// The bytes of a master's map.
struct HostPort {
  std::function<std::uint8_t(unsigned address)> read;
  std::function<void(unsigned address, std::uint8_t data)> write;
};

// What a host asks for, and how it judges the end.
struct Asked {
  bool is_long = false;
  bool safe = false;
  bool disturbed = false;
  std::vector<std::uint8_t> request;  // without CRC
  std::size_t done_before = 0;
  std::uint64_t began = 0;
};

// Drives transactions of both kinds and both hosts, and checks each end. Its user runs the frames.
class Dialogue {
 public:
  Dialogue(HostPort host, dsl::ParameterChannel& channel, RegisterFile& registers,
           std::uint64_t seed)
      : host_(std::move(host)), channel_(channel), registers_(registers), random_(seed) {
    channel.on_done = [this](std::span<const std::uint8_t> request) {
      done_.emplace_back(request.begin(), request.end());
    };
  }
  static dsl::MessageConfig encoder() {
    dsl::MessageConfig config;
    config.long_latency = 5;
    config.short_latency = 1;
    config.access_level = 14;
    for (unsigned i = 0; i < 16; ++i) {
      dsl::Resource one;
      one.id = 0x200 + i;
      one.name = "OWN";
      one.type = dsl::ResourceType::kString;
      for (unsigned k = 0; k < 8; ++k) one.value.push_back(pattern(i, k));
      one.write_level = 0;
      config.resources.push_back(one);
    }
    return config;
  }

  // Once a frame, before it.
  void host_acts() {
    ++frame_;
    if (disturbance_ended()) end_disturbance();
    watch(kMainShort, host_.read(host_at::kEventL) & host_on::kFres);
    watch(kSafeShort, host_.read(host_at::kEventS) & host_on::kSafeFres);
    watch(kLong, host_.read(host_at::kEventL) & host_on::kFrel);
    for (const unsigned which : {kMainShort, kSafeShort, kLong}) {
      if (!asked_[which] && random_.up_to(20) == 0) start(which);
    }
    // A host that waits too long resets the channel.
    if (asked_[kLong] && frame_ - asked_[kLong]->began > kPatience && !host_resets_) {
      EXPECT_TRUE(asked_[kLong]->disturbed) << "a long message hangs";
      host_.write(host_at::kSysCtrl, host_on::kMrst);
      host_resets_ = true;
      ++resets;
    }
    if (host_resets_ && (host_.read(host_at::kSysCtrl) & host_on::kMrst) == 0) {
      EXPECT_NE(host_.read(host_at::kEventL) & host_on::kMin, 0);
      host_.write(host_at::kEventL, static_cast<std::uint8_t>(~host_on::kMin));
      host_resets_ = false;
      for (auto& one : asked_) {
        if (one) ++ended;
        one.reset();
      }
    }
  }
  std::uint64_t ended = 0;
  std::uint64_t good = 0;
  std::uint64_t bad_answers = 0;
  std::uint64_t error_answers = 0;
  std::uint64_t resets = 0;
  std::uint64_t disturbed = 0;
  // Errors of the line in this frame, if the disturbance makes them.
  bool answer_unreadable = false;
  bool request_unreadable = false;
  unsigned request_flip = 0;
  bool link_lost = false;
  // Of the line: at random while a disturbance of this kind lasts.
  void make_line_errors() {
    // On a line the next frame is hit.
    answer_unreadable =
        kind_ == kBadAnswers && frame_ + 2 < disturbed_until_ && random_.up_to(3) == 0;
    request_unreadable = kind_ == kBadRequests && random_.up_to(5) == 0;
    request_flip = kind_ == kFlips && random_.up_to(5) == 0
                       ? static_cast<unsigned>(1U << random_.up_to(4))
                       : 0;
    link_lost = kind_ == kLinkLoss && frame_ == disturbed_until_ - 1;
  }
  // Every short one ends, when the disturbances have ended.
  bool all_ended() const { return !asked_[0] && !asked_[1] && !asked_[2]; }
  void stop_starting() { may_start_ = false; }
  // The line itself disturbs any transaction.
  void disturb_all() { always_disturbed_ = true; }

 private:
  static constexpr unsigned kMainShort = 0;
  static constexpr unsigned kSafeShort = 1;
  static constexpr unsigned kLong = 2;
  static constexpr std::uint64_t kPatience = 1500;
  enum Disturbance : unsigned {
    kNothing,
    kLostNibble,
    kWrongCrc,
    kNak,
    kSilent,
    kLate,
    kForeignAddress,
    kForeignDirection,
    kForeignLength,
    kBadAnswers,
    kBadRequests,
    kFlips,
    kLinkLoss,
    kAll
  };

  static std::uint8_t pattern(unsigned id, unsigned place) {
    return static_cast<std::uint8_t>(0x11 * id + 7 * place + 3);
  }
  std::uint8_t random_byte() { return static_cast<std::uint8_t>(random_.next() >> 13U); }

  void start(unsigned which) {
    if (!may_start_ || host_resets_) return;
    Asked asked;
    asked.is_long = which == kLong;
    asked.safe = which == kSafeShort;
    asked.done_before = done_.size();
    asked.began = frame_;
    if (random_.up_to(3) == 0 && kind_ == kNothing) begin_disturbance();
    asked.disturbed = always_disturbed_;
    if (kind_ != kNothing) {
      for (auto& one : asked_) {
        if (one) one->disturbed = true;
      }
      asked.disturbed = true;
      ++disturbed;
    }
    const bool read = random_.up_to(1) == 0;
    const std::uint8_t data = random_byte();
    if (asked.is_long) {
      const unsigned id = 0x200 + static_cast<unsigned>(random_.up_to(20));  // some are not there
      const unsigned code = static_cast<unsigned>(random_.up_to(3));
      const unsigned length = code == 0 ? 0 : 1U << code;
      const bool offset = random_.up_to(2) == 0;
      const auto header = static_cast<std::uint8_t>(0x92U | (read ? 0x40U : 0U) |
                                                    (offset ? 0x20U : 0U) | code << 2U);
      asked.request = {header, static_cast<std::uint8_t>(id)};
      if (offset) {
        const auto at = static_cast<std::uint8_t>(random_.up_to(8));
        host_.write(host_at::kOffH, 0);
        host_.write(host_at::kOffL, at);
        asked.request.push_back(0x80);
        asked.request.push_back(at);
      }
      for (unsigned i = 0; i < length && !read; ++i) {
        const std::uint8_t byte = random_byte();
        host_.write(host_at::kBuffer0 + i, byte);
        asked.request.push_back(byte);
      }
      host_.write(host_at::kAddH, header);
      host_.write(host_at::kAddL, asked.request[1]);
      host_.write(host_at::kCtrl, host_on::kStart);
      host_.write(host_at::kEventL, static_cast<std::uint8_t>(~host_on::kAns));
    } else {
      constexpr std::uint8_t kRegisters[] = {0x40, 0x41, 0x42, 0x43, 0x44, 0x45, 0x46, 0x47, 0x7F};
      const std::uint8_t at = kRegisters[random_.up_to(8)];
      const auto six = static_cast<std::uint8_t>(at & 0x3FU);
      asked.request = read ? std::vector<std::uint8_t>{static_cast<std::uint8_t>(0x40U | six)}
                           : std::vector<std::uint8_t>{six, data};
      host_.write(asked.safe ? host_at::kSafeData : host_at::kData, data);
      host_.write(asked.safe ? host_at::kSafeControl : host_at::kControl,
                  static_cast<std::uint8_t>(at | (read ? 0x80U : 0U)));
    }
    asked_[which] = asked;
  }

  void begin_disturbance() {
    kind_ = static_cast<Disturbance>(1 + random_.up_to(kAll - 2));
    disturbed_until_ = frame_ + 20 + random_.up_to(180);
    dsl::MessageFaults& faults = channel_.faults();
    faults.lost_nibble = kind_ == kLostNibble;
    faults.wrong_crc = kind_ == kWrongCrc;
    faults.nak = kind_ == kNak;
    faults.silent = kind_ == kSilent;
    faults.late = kind_ == kLate;
    faults.foreign_address = kind_ == kForeignAddress;
    faults.foreign_direction = kind_ == kForeignDirection;
    faults.foreign_length = kind_ == kForeignLength;
  }
  bool disturbance_ended() const { return kind_ != kNothing && frame_ >= disturbed_until_; }
  void end_disturbance() {
    channel_.faults() = {};
    kind_ = kNothing;
  }

  void watch(unsigned which, unsigned free) {
    std::optional<Asked>& asked = asked_[which];
    if (!asked || free == 0 || host_resets_) return;
    const bool read = (asked->request[0] & 0x40) != 0;
    const bool was_done = std::find(done_.begin() + static_cast<std::ptrdiff_t>(asked->done_before),
                                    done_.end(), asked->request) != done_.end();
    const std::string what = "transaction " + std::to_string(ended) + " of kind " +
                             std::to_string(which) + " from frame " + std::to_string(asked->began);
    ++ended;
    if (!asked->is_long) {
      EXPECT_TRUE(was_done) << what << " was not done";
      ++good;
      if (read) {
        const std::uint8_t at = static_cast<std::uint8_t>(0x40U | (asked->request[0] & 0x3FU));
        // Nobody writes between the answer and here but the other host.
        if (!asked_[which == kMainShort ? kSafeShort : kMainShort]) {
          EXPECT_EQ(host_.read(asked->safe ? host_at::kSafeData : host_at::kData),
                    registers_.get(at))
              << what;
        }
      }
    } else if ((host_.read(host_at::kEventL) & host_on::kAns) != 0) {
      EXPECT_TRUE(asked->disturbed) << what << " failed undisturbed";
      ++bad_answers;
    } else if ((host_.read(host_at::kAddH) & 0x20) != 0) {
      ++error_answers;  // refused: no such resource, offset, length
      EXPECT_FALSE(was_done) << what;
    } else {
      EXPECT_TRUE(was_done) << what << " was not done";
      ++good;
      if (read) check_long(*asked, what);
    }
    if (asked->is_long) host_.write(host_at::kEventL, static_cast<std::uint8_t>(~host_on::kAns));
    asked.reset();
  }
  void check_long(const Asked& asked, const std::string& what) const {
    const dsl::Resource* resource = channel_.resources().find(0x200U | asked.request[1]);
    ASSERT_NE(resource, nullptr);
    const unsigned offset = (asked.request[0] & 0x20) != 0 ? asked.request[3] : 0;
    const unsigned code = asked.request[0] >> 2U & 3U;
    for (unsigned i = 0; i < (code == 0 ? 0U : 1U << code); ++i) {
      const std::uint8_t byte =
          offset + i < resource->value.size() ? resource->value[offset + i] : std::uint8_t{0};
      EXPECT_EQ(host_.read(host_at::kBuffer0 + i), byte) << what << ", byte " << i;
    }
  }

  HostPort host_;
  dsl::ParameterChannel& channel_;
  RegisterFile& registers_;
  Random random_;
  std::vector<std::vector<std::uint8_t>> done_;
  std::optional<Asked> asked_[3];
  std::uint64_t frame_ = 0;
  std::uint64_t disturbed_until_ = 0;
  Disturbance kind_ = kNothing;
  bool host_resets_ = false;
  bool may_start_ = true;
  bool always_disturbed_ = false;
};

}  // namespace mb4::sim::dsl_test

#endif  // MB4_TESTS_UNIT_DSL_DIALOGUE_HPP_
