// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What the two hosts of a master see in its byte map of messages, events and the second safe
// channel: the registers by their addresses, without a bus. The main host has EVENT_H and EVENT_L,
// PC_DATA and SLAVE_REG_CTRL; the safe host has EVENT_S, S_PC_DATA and S_SLAVE_REG_CTRL. Long
// messages are the main host's.
//
// An event sets its bit at the end of the frame that brings it; a host clears it by writing 0. A
// start of a message clears FREL, or FRES of its host.
#ifndef MB4SIM_DSL_MODEL_HOST_BYTES_HPP_
#define MB4SIM_DSL_MODEL_HOST_BYTES_HPP_

#include <array>
#include <cstdint>

#include "sim/masters/dsl_model/messages.hpp"
#include "sim/masters/dsl_model/safe_channels.hpp"
#include "sim/masters/dsl_model/safe_checks.hpp"

namespace mb4::sim::dsl_model {

// Addresses of the bytes that are here.
namespace host_address {
inline constexpr unsigned kSysCtrl = 0x00;  // MRST alone
inline constexpr unsigned kEventH = 0x04;
inline constexpr unsigned kEventL = 0x05;
inline constexpr unsigned kMaskH = 0x06;
inline constexpr unsigned kMaskL = 0x07;
inline constexpr unsigned kMaskSum = 0x08;
inline constexpr unsigned kBuffer0 = 0x20;
inline constexpr unsigned kAddH = 0x28;
inline constexpr unsigned kAddL = 0x29;
inline constexpr unsigned kOffH = 0x2A;
inline constexpr unsigned kOffL = 0x2B;
inline constexpr unsigned kCtrl = 0x2C;
inline constexpr unsigned kPipeS = 0x2D;
inline constexpr unsigned kPipeD = 0x2E;
inline constexpr unsigned kData = 0x2F;
inline constexpr unsigned kSafeControl = 0x34;  // S_SLAVE_REG_CTRL
inline constexpr unsigned kSafeCtrl = 0x35;     // MRST alone
inline constexpr unsigned kSafeData = 0x37;
inline constexpr unsigned kEventS = 0x3D;
inline constexpr unsigned kMaskS = 0x3E;
inline constexpr unsigned kControl = 0x40;
inline constexpr unsigned kPosTx = 0x4E;
inline constexpr unsigned kOnlineD = 0x50;  // high byte, and then the low one
inline constexpr unsigned kOnline1 = 0x52;
inline constexpr unsigned kOnline2 = 0x54;
}  // namespace host_address

// Bits of the event registers.
namespace host_bit {
inline constexpr std::uint8_t kMrst = 0x40;  // SYS_CTRL, SAFE_CTRL
inline constexpr std::uint8_t kInt = 0x80;   // EVENT_H; SINT of EVENT_S
inline constexpr std::uint8_t kSum = 0x40;
inline constexpr std::uint8_t kSce = 0x20;
inline constexpr std::uint8_t kPos = 0x08;
inline constexpr std::uint8_t kVpos = 0x04;
inline constexpr std::uint8_t kPrst = 0x01;
inline constexpr std::uint8_t kMin = 0x20;  // EVENT_L
inline constexpr std::uint8_t kAns = 0x10;
inline constexpr std::uint8_t kQmlw = 0x04;
inline constexpr std::uint8_t kFrel = 0x02;
inline constexpr std::uint8_t kFres = 0x01;
inline constexpr std::uint8_t kSafeVpos = 0x10;  // EVENT_S
inline constexpr std::uint8_t kSafeQmlw = 0x08;
inline constexpr std::uint8_t kSafePrst = 0x04;
inline constexpr std::uint8_t kSafeMin = 0x02;
inline constexpr std::uint8_t kSafeFres = 0x01;
inline constexpr std::uint8_t kStart = 0x01;  // PC_CTRL
}  // namespace host_bit

// Bits of PIPE_S. One byte is kept, so none is lost.
namespace pipe_bit {
inline constexpr std::uint8_t kEmpty = 0x04;    // PEMP: none has come in this link
inline constexpr std::uint8_t kError = 0x02;    // PERR: its code was wrong
inline constexpr std::uint8_t kSpecial = 0x01;  // PSCI: it was a special character
}  // namespace pipe_bit

// What a frame of a link tells, for events and live states.
struct FrameNews {
  bool linked = false;
  bool lost = true;       // POS
  bool low = false;       // QM below 14
  bool safe_new = false;  // the end of a vertical frame
  SafeChannel safe1;
  SafeChannel safe2;
  std::uint8_t pipeline_state = pipe_bit::kEmpty;  // of PIPE_S
  std::uint8_t pipeline = 0;                       // the last good byte
};

// Five causes of an interrupt, each for a frame.
struct Causes {
  bool event = false;    // INT rose
  bool event_s = false;  // SINT rose
  bool safe1 = false;    // a new good safe position
  bool safe2 = false;
  bool frame = false;
};

class HostBytes {
 public:
  HostBytes(const MessageRules& rules) : sdk_map_(rules.sdk_map), messages_(rules) {}

  // --- the hosts, between two frames -------------------------------------------------------------
  void write(unsigned address, std::uint8_t data);
  std::uint8_t read(unsigned address) const;
  // POSTX without the time up to the frame's end (Link::position_state()).
  std::uint8_t position_state() const { return position_state_; }
  SafeCheckRules& check_rules() { return check_rules_; }
  const Causes& causes() const { return causes_; }
  Messages& messages() { return messages_; }
  const Messages& messages() const { return messages_; }

  // --- the link ----------------------------------------------------------------------------------
  void reset_begins();  // RESET of the training
  void link_begins();
  void link_ends();
  unsigned symbol() { return messages_.symbol(); }
  void frame(const Word& parameter, const FrameNews& news);

 private:
  using Bits = std::uint8_t;

  void take(const MessageEvents& events);
  void begin_causes();
  void end_causes();
  bool interrupt() const;
  bool safe_interrupt() const;
  void start_short(Messages::Host host, std::uint8_t control);
  std::uint8_t online(unsigned address) const;

  bool sdk_map_;
  Messages messages_;
  SafeCheckRules check_rules_;
  FrameNews news_;
  Bits event_h_ = 0;
  Bits event_l_ = 0;
  Bits event_s_ = 0;
  Bits mask_h_ = 0;
  Bits mask_l_ = 0;
  Bits mask_s_ = 0;
  Bits mask_sum_ = 0;
  bool running_ = false;
  bool wrong_answer_ = false;  // of the last long message
  bool initialised_ = false;   // since the last start of a message
  bool marked1_ = false;       // of the last vertical frame
  bool marked2_ = false;
  std::uint8_t position_state_ = 0;
  bool was_interrupt_ = false;
  bool was_safe_interrupt_ = false;
  Causes causes_;
};

}  // namespace mb4::sim::dsl_model

#endif  // MB4SIM_DSL_MODEL_HOST_BYTES_HPP_
