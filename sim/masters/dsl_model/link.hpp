// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A whole master of DSL for one line, as a model of the published facts: it trains the
// line, takes the answer of each frame, and keeps position, safe positions and quality. It has no
// time of its own: tick() is one edge of a clock of 75 MHz, eight of which are a bit.
//
// Errors never stop it: a link that fails begins again, without end.
#ifndef MB4SIM_DSL_MODEL_LINK_HPP_
#define MB4SIM_DSL_MODEL_LINK_HPP_

#include <array>
#include <cstdint>
#include <optional>

#include "sim/masters/dsl_model/frame_plan.hpp"
#include "sim/masters/dsl_model/host_bytes.hpp"
#include "sim/masters/dsl_model/line_code.hpp"
#include "sim/masters/dsl_model/motion.hpp"
#include "sim/masters/dsl_model/quality.hpp"
#include "sim/masters/dsl_model/receiver.hpp"
#include "sim/masters/dsl_model/safe_channels.hpp"

namespace mb4::sim::dsl_model {

struct LinkRules {
  SampleRule sample = SampleRule::kTracking;
  bool sdk_map = false;  // the personality of the SDK
  CodeCheck check = CodeCheck::kStrict;
  bool strict_id = true;  // the identity is whole, and safe positions are as wide as it says
  QualityRules quality = QualityRules::kSick;
  bool rssi_table = false;
  bool recover = true;
  unsigned rx_start = 5;             // ticks from the driver's end to the first sample, 0 to 15
  unsigned start_blocks = 4;         // stuffing of START frames, 0 to 26
  unsigned vsync_limit = 64;         // frames without VSYNC after the training; 0: no limit
  unsigned stale_limit = 2;          // MotionRules
  unsigned acceleration_limit = 31;  // words missing one after another; 0 is as 1
  bool check_answers = true;         // MessageRules
};

enum class LinkState { kGap, kReset, kSync, kStart, kLearn, kCheck, kIdRequest, kWaitVsync, kRun };
const char* name_of(LinkState state);

// Why the link began again.
enum class Restart {
  kNone,
  kNotFound,  // START: no answer, or not where one fits
  kLearn,     // LEARN, CHECK: another pattern
  kCheck,
  kIdentity,      // of the encoder: broken, or widths that cannot be, or that are not true
  kVsync,         // it did not come
  kQuality,       // too low
  kAcceleration,  // too many words missing
};
const char* name_of(Restart reason);

// The six words of an answer, and the bit between the last two.
struct AnswerWords {
  Word vertical;
  Word parameter;
  Word pipeline;
  Word acceleration_high;
  Word acceleration_low;
  Word secondary;
  bool direction = false;
};
AnswerWords words_of(Answer answer, CodeCheck check, bool sdk_map = false);
// The second difference of an answer; nothing if a word is wrong. The strict check refuses special
// characters but K28.x, the published one looks at code errors and CRC5 alone.
std::optional<int> acceleration_in(const AnswerWords& words, CodeCheck check);

// A frame with an answer.
struct LinkFrame {
  std::uint64_t number = 0;   // running frames from 1 on; 0: the line is not that far
  std::uint64_t sampled = 0;  // tick of the edge in SAMPLE
  LinkState state = LinkState::kGap;
  Answer answer = 0;
  AnswerWords words;  // of the identity and later frames
  bool acceleration_good = false;
  unsigned place = 0;  // in the vertical frame, 0 to 7
  std::uint64_t position = 0;
  int speed = 0;
  bool lost = true;  // POS
  bool linked = false;
  unsigned quality = 0;
  unsigned delay = 0;
  unsigned rssi = 0;
  unsigned sample_place = 0;  // number of the sample of the first bit
  bool safe_new = false;      // safe1 and safe2 have been judged with this frame
  bool safe1_new = false;     // ... and safe1 was good
  SafeChannel safe1;          // not valid without a link
  SafeChannel safe2;
  SafeFlags checks;                  // what the last vertical frame has failed
  Restart restart = Restart::kNone;  // the frame ends the link
};

class LinkListener {
 public:
  virtual void answered(const LinkFrame& frame) = 0;

 protected:
  ~LinkListener() = default;
};

class Link {
 public:
  explicit Link(const LinkRules& rules);

  // One edge of the clock. `in`: the level that the receiver shows just before it.
  void tick(bool in) {
    if (tick_ == end_) next_frame();
    if (receiving_) {
      if (tick_ >= first_sample_) {
        receiver_.take(in);
        if (receiver_.full()) judge();
      }
    }
    const auto bit = static_cast<unsigned>(tick_) / kTicksPerBit;
    out_ = plan_.level(bit, static_cast<unsigned>(tick_) % kTicksPerBit);
    enable_ = plan_.drives(bit);
    ++tick_;
    ++ticks_;
  }
  // From this edge to the next one.
  bool out() const { return out_; }
  bool enable() const { return enable_; }
  // Edges before the next one that could change something or take a sample.
  unsigned idle_ticks() const {
    if (receiving_ && tick_ + kTicksPerBit > first_sample_) return 0;
    const unsigned in_bit = tick_ % kTicksPerBit;
    if (in_bit == 0 || !plan_.whole(tick_ / kTicksPerBit)) return 0;
    return kTicksPerBit - in_bit;
  }
  void skip(unsigned ticks) {
    tick_ += ticks;
    ticks_ += ticks;
  }

  void set_listener(LinkListener* listener) { listener_ = listener; }

  LinkState state() const { return state_; }
  bool linked() const { return frame_.linked; }
  std::uint64_t restarts() const { return restarts_; }
  Restart last_restart() const { return last_restart_; }
  // Words that only the strict check refused.
  std::uint64_t illegal_words() const { return illegal_; }
  std::uint32_t identity() const { return identity_; }
  unsigned position_bits() const { return position_bits_; }
  std::uint8_t edges() const { return receiver_.edges(); }
  const LinkFrame& frame() const { return frame_; }
  const FramePlan& plan() const { return plan_; }
  // Registers of messages and events.
  HostBytes& host() { return host_; }
  const HostBytes& host() const { return host_; }
  // POSTX: 0 from the sample edge to the end of the answer.
  std::uint8_t position_state() const {
    const bool asked = receiving_ && tick_ > plan_.sample_tick();
    return asked && state_ == LinkState::kRun ? std::uint8_t{0} : host_.position_state();
  }
  std::uint64_t ticks() const { return ticks_; }

 private:
  void next_frame();
  void enter(LinkState state, unsigned frames);
  void step();
  void judge();
  void count_illegal();
  void take_identity();
  void wait_for_vsync();
  void run();
  void take_safe(QualityEvents& events);
  void take_checks();
  void tell_host();
  void restart(Restart reason);

  LinkRules rules_;
  FramePlan plan_;
  Receiver receiver_;
  Motion motion_;
  Quality quality_;
  SafeChannels safe_;
  VsyncWatch vsync_;
  HostBytes host_;
  std::uint8_t pipeline_ = 0;  // the last good byte
  LinkListener* listener_ = nullptr;

  unsigned tick_ = 0;  // of the frame
  unsigned end_ = 0;
  unsigned first_sample_ = 0;
  std::uint64_t ticks_ = 0;
  std::uint64_t began_ = 0;  // the frame, by ticks_
  bool receiving_ = false;
  bool out_ = true;
  bool enable_ = false;

  LinkState state_ = LinkState::kGap;
  unsigned left_ = 0;  // frames of this state
  int disparity_ = 0;
  bool restarting_ = false;
  std::uint64_t restarts_ = 0;
  Restart last_restart_ = Restart::kNone;
  std::uint64_t illegal_ = 0;
  std::uint32_t identity_ = 0;
  unsigned position_bits_ = 0;
  unsigned waited_ = 0;    // frames for VSYNC
  unsigned place_ = 0;     // of the next running frame
  bool vertical_ = false;  // msync
  std::uint64_t running_ = 0;
  LinkFrame frame_;
};

}  // namespace mb4::sim::dsl_model

#endif  // MB4SIM_DSL_MODEL_LINK_HPP_
