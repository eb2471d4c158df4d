// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/dsl_model/link.hpp"

#include <algorithm>

namespace mb4::sim::dsl_model {
namespace {

constexpr unsigned kResetFrames = 2;
constexpr unsigned kSyncFrames = 16;
constexpr unsigned kStartFrames = 9;
constexpr unsigned kLearnFrames = 9;
constexpr unsigned kCheckFrames = 16;
constexpr unsigned kVertical = SafeChannels::kFrames;
constexpr unsigned kLowRssi = 2;
constexpr std::uint8_t kVsync = 0x80;  // in S_PAR
constexpr unsigned kMaxPositionBits = 40;
constexpr unsigned kMore = 8;             // in bits 19 to 16 of the identity
constexpr std::uint32_t kSigned = 0x400;  // in the identity
constexpr unsigned kMaxAccelerationBits = 11;

// A special character where only `allowed` may stand.
bool unexpected(const Word& word, std::uint8_t allowed) {
  return word.special && !word.error && word.byte != allowed;
}

}  // namespace

const char* name_of(LinkState state) {
  constexpr const char* kNames[] = {"gap",   "RESET",  "SYNC",       "START",  "LEARN",
                                    "CHECK", "ID REQ", "WAIT VSYNC", "running"};
  return kNames[static_cast<unsigned>(state)];
}

const char* name_of(Restart reason) {
  constexpr const char* kNames[] = {"none",
                                    "no answer was found",
                                    "another pattern in LEARN",
                                    "another pattern in CHECK",
                                    "the encoder's identity is broken",
                                    "no VSYNC",
                                    "the quality is too low",
                                    "too many accelerations are missing"};
  return kNames[static_cast<unsigned>(reason)];
}

// In the personality of the SDK K28 is repaired in the second safe channel alone.
AnswerWords words_of(Answer answer, CodeCheck check, bool sdk_map) {
  const Channel most = sdk_map ? Channel::kAcceleration : Channel::kPlain;
  const auto in = [&](unsigned lowest, Channel channel) {
    return decode(static_cast<unsigned>(answer >> lowest), check, channel);
  };
  return {.vertical = in(51, most),
          .parameter = in(41, most),
          .pipeline = in(31, most),
          .acceleration_high = in(21, Channel::kAcceleration),
          .acceleration_low = in(11, Channel::kAcceleration),
          .secondary = in(0, Channel::kSecond),
          .direction = (answer >> 10U & 1U) != 0};
}

std::optional<int> acceleration_in(const AnswerWords& words, CodeCheck check) {
  const auto plain = [check](const Word& word) {
    return !word.error && (check == CodeCheck::kPublished || !word.special || word.is_k28());
  };
  const Word& high = words.acceleration_high;
  const Word& low = words.acceleration_low;
  const auto word = static_cast<std::uint16_t>(high.byte << 8U | low.byte);
  if (!plain(high) || !plain(low) || !acceleration_is_good(word)) return std::nullopt;
  return acceleration_of(word);
}

Link::Link(const LinkRules& rules)
    : rules_(rules),
      receiver_(rules.sample, rules.rssi_table),
      motion_({.recover = rules.recover, .stale_limit = rules.stale_limit}),
      quality_(rules.quality),
      safe_(rules.quality, rules.sdk_map),
      host_({.check_answers = rules.check_answers, .sdk_map = rules.sdk_map}) {
  restarting_ = true;
}

// ---- Frames -------------------------------------------------------------------------------------

void Link::enter(LinkState state, unsigned frames) {
  state_ = state;
  left_ = frames;
}

// The state of the next frame. Those with an answer are left by judge().
void Link::step() {
  if (restarting_) {
    restarting_ = false;
    receiver_.forget();
    disparity_ = 0;
    vertical_ = false;
    return enter(LinkState::kGap, 1);
  }
  if (left_ != 0) return;
  switch (state_) {
    case LinkState::kGap:
      host_.reset_begins();
      return enter(LinkState::kReset, kResetFrames);
    case LinkState::kReset:
      return enter(LinkState::kSync, kSyncFrames);
    case LinkState::kSync:
      return enter(LinkState::kStart, kStartFrames);
    case LinkState::kStart:
      return enter(LinkState::kLearn, kLearnFrames);
    case LinkState::kLearn:
      return enter(LinkState::kCheck, kCheckFrames);
    case LinkState::kCheck:
      return enter(LinkState::kIdRequest, 1);
    case LinkState::kIdRequest:
      waited_ = 0;
      return enter(LinkState::kWaitVsync, 1);
    case LinkState::kWaitVsync:
    case LinkState::kRun:
      left_ = 1;
      return;
  }
}

void Link::next_frame() {
  step();
  --left_;
  tick_ = 0;
  began_ = ticks_;
  receiving_ = false;
  if (state_ == LinkState::kGap) {
    plan_.make_gap();
    end_ = plan_.bits() * kTicksPerBit;
    return;
  }
  unsigned parameter = 0;
  FrameShape shape;
  bool answer = true;
  switch (state_) {
    case LinkState::kReset:
      parameter = kReset;
      answer = false;
      break;
    case LinkState::kSync:
      parameter = kSync;
      answer = false;
      break;
    case LinkState::kStart:
      parameter = kStart;
      shape.blocks = rules_.start_blocks;
      break;
    case LinkState::kLearn:
      parameter = kLearn;
      break;
    case LinkState::kCheck:
      parameter = kCheck;
      break;
    case LinkState::kIdRequest:
      parameter = kIdRequest;
      break;
    case LinkState::kWaitVsync:
      parameter = kInit | kFirstBit;
      break;
    default:
      parameter = host_.symbol() | kFirstBit | (vertical_ ? kVerticalBit : 0U);
  }
  plan_.make(parameter, answer, shape, disparity_);
  end_ = plan_.bits() * kTicksPerBit;
  receiving_ = answer;
  first_sample_ = plan_.switch_bit() * kTicksPerBit + rules_.rx_start;
  receiver_.begin();
}

// The frame is finished with its trailer.
void Link::restart(Restart reason) {
  restarting_ = true;
  ++restarts_;
  last_restart_ = reason;
  plan_.drop_stuffing();
  end_ = plan_.bits() * kTicksPerBit;
  if (frame_.linked) host_.link_ends();
  frame_.linked = false;
  frame_.lost = true;
  frame_.safe1.valid = frame_.safe2.valid = false;
  frame_.safe1.age = frame_.safe2.age = std::nullopt;
  frame_.restart = reason;
}

// ---- Answers ------------------------------------------------------------------------------------

// The window is over.
void Link::judge() {
  receiving_ = false;
  frame_.number = 0;
  frame_.sampled = began_ + plan_.sample_tick();
  frame_.state = state_;
  frame_.safe_new = frame_.safe1_new = false;
  frame_.restart = Restart::kNone;
  switch (state_) {
    case LinkState::kStart:
      if (!receiver_.learn()) restart(Restart::kNotFound);
      break;
    case LinkState::kLearn:
      if (!receiver_.matches()) restart(Restart::kLearn);
      break;
    case LinkState::kCheck:
      if (!receiver_.matches()) restart(Restart::kCheck);
      break;
    default:
      frame_.answer = receiver_.answer(state_ != LinkState::kIdRequest);
      frame_.rssi = receiver_.rssi();
      frame_.words = words_of(frame_.answer, rules_.check, rules_.sdk_map);
      count_illegal();
      if (state_ == LinkState::kIdRequest) take_identity();
      if (state_ == LinkState::kWaitVsync) {
        wait_for_vsync();
      } else if (state_ == LinkState::kRun) {
        run();
      }
  }
  frame_.delay = receiver_.delay();
  frame_.sample_place = receiver_.delay() * 8 + receiver_.eighth();
  if (listener_ != nullptr) listener_->answered(frame_);
}

void Link::count_illegal() {
  const AnswerWords& words = frame_.words;
  for (const Word* word : {&words.vertical, &words.parameter, &words.pipeline,
                           &words.acceleration_high, &words.acceleration_low, &words.secondary}) {
    if (word->only_strict) ++illegal_;
  }
}

// Errors of the code are not looked at: the bytes stand there twice.
void Link::take_identity() {
  const AnswerWords& words = frame_.words;
  const unsigned high = words.pipeline.byte & 0xFU;
  identity_ = high << 16U | unsigned{words.parameter.byte} << 8U | words.vertical.byte;
  const unsigned acceleration_bits = (identity_ & 0xFU) + 8;
  position_bits_ = (identity_ >> 4U & 0x3FU) + acceleration_bits;
  const bool twice = words.vertical.byte == words.acceleration_low.byte &&
                     words.parameter.byte == words.acceleration_high.byte &&
                     words.pipeline.byte >> 4U == high;
  const bool more = rules_.strict_id && (high & kMore) != 0;
  if (!twice || more || acceleration_bits > kMaxAccelerationBits ||
      position_bits_ > kMaxPositionBits) {
    return restart(Restart::kIdentity);
  }
  frame_.linked = true;
  frame_.lost = true;
  safe_.start();
  frame_.safe1 = frame_.safe2 = {};
  frame_.checks = {};
  quality_.start();
  frame_.quality = quality_.value();
  motion_.start(position_bits_);
}

void Link::wait_for_vsync() {
  const Word& parameter = frame_.words.parameter;
  if (!parameter.error && (parameter.byte & kVsync) != 0) {
    place_ = 0;
    safe_.begin();
    vsync_.start();
    host_.link_begins();
    enter(LinkState::kRun, 0);
    return;
  }
  if (++waited_ == rules_.vsync_limit) restart(Restart::kVsync);
}

void Link::run() {
  const AnswerWords& words = frame_.words;
  frame_.number = ++running_;
  frame_.place = place_;
  QualityEvents events;
  if (!words.parameter.error) {
    const bool vsync = (words.parameter.byte & kVsync) != 0;
    const bool last = place_ + 1 == kVertical;
    vsync_.frame(place_, true, vsync);
    events.vsync_early = vsync && !last;
    events.vsync_missing = !vsync && last;
    events.vsync_good = vsync && last;
  }
  events.rssi_low = frame_.rssi < kLowRssi;
  events.parameter_error = words.parameter.error;
  events.pipeline_error = words.pipeline.error;
  const Word& high = words.acceleration_high;
  const Word& low = words.acceleration_low;
  events.acceleration_error = high.error || low.error;
  // With the strict check K28 is a byte like others.
  for (const Word* word : {&words.vertical, &high, &low}) {
    const bool byte = rules_.check == CodeCheck::kStrict && word->is_k28();
    if (unexpected(*word, kMarker1) && !byte) ++events.specials;
  }
  if (words.parameter.special && !words.parameter.error) ++events.specials;
  if (unexpected(words.secondary, kMarker2) && !words.secondary.is_k28()) ++events.specials;

  const std::optional<int> acceleration = acceleration_in(words, rules_.check);
  frame_.acceleration_good = acceleration.has_value();
  motion_.frame(acceleration, high.is(kMarker1) || low.is(kMarker1));
  take_safe(events);

  frame_.position = motion_.position();
  frame_.speed = motion_.speed();
  frame_.lost = motion_.lost();
  const bool good = quality_.frame(events);
  frame_.quality = quality_.value();
  if (frame_.safe_new) take_checks();
  tell_host();
  place_ = (place_ + 1) % kVertical;
  if (!good) {
    restart(Restart::kQuality);
  } else if (motion_.missing() >= std::max(rules_.acceleration_limit, 1U)) {
    restart(Restart::kAcceleration);
  } else if (rules_.strict_id && frame_.safe1_new &&
             !fits(frame_.safe1.position, position_bits_, (identity_ & kSigned) != 0)) {
    restart(Restart::kIdentity);
  }
}

void Link::take_checks() {
  SafeFlags& checks = frame_.checks;
  checks = safe_.flags();
  vsync_.judge(checks);
  checks.set(SafeCheck::kStale, motion_.disagreed());
  if (!frame_.safe1.valid || !frame_.safe2.valid) return;
  checks.set(SafeCheck::kMismatch, !positions_agree(frame_.safe1.position, position_bits_,
                                                    frame_.safe2.position, host_.check_rules()));
}

void Link::tell_host() {
  const Word& pipeline = frame_.words.pipeline;
  if (!pipeline.error) pipeline_ = pipeline.byte;
  const bool special = pipeline.special && !pipeline.error;
  host_.frame(frame_.words.parameter, {.linked = frame_.linked,
                                       .lost = frame_.lost,
                                       .low = quality_.low(),
                                       .safe_new = frame_.safe_new,
                                       .safe1 = frame_.safe1,
                                       .safe2 = frame_.safe2,
                                       .pipeline_state = pipeline.error ? pipe_bit::kError
                                                         : special      ? pipe_bit::kSpecial
                                                                        : std::uint8_t{0},
                                       .pipeline = pipeline_});
}

// Both safe channels bring a byte with each frame.
void Link::take_safe(QualityEvents& events) {
  const AnswerWords& words = frame_.words;
  frame_.safe_new = safe_.frame(place_, words.vertical, words.secondary, events);
  frame_.safe1 = safe_.safe1();
  frame_.safe2 = safe_.safe2();
  if (!frame_.safe_new) return;
  frame_.safe1_new = frame_.safe1.valid;
  motion_.vertical_end(frame_.safe1.valid ? std::optional(frame_.safe1.position) : std::nullopt);
  vertical_ = !vertical_;
}

}  // namespace mb4::sim::dsl_model
