// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/dsl_model/host_bytes.hpp"

namespace mb4::sim::dsl_model {
namespace {

namespace at = host_address;
namespace on = host_bit;

constexpr std::uint8_t kFixed = 0x10;  // in each high byte of ONLINE_STATUS
// Events and masks that are there.
constexpr std::uint8_t kEventsH = on::kSum | on::kSce | on::kPos | on::kVpos | on::kPrst;
constexpr std::uint8_t kEventsL = on::kMin | on::kAns | on::kQmlw | on::kFrel | on::kFres;
constexpr std::uint8_t kEventsS = 0x7F;

constexpr std::uint8_t bit(bool there, std::uint8_t mask) { return there ? mask : 0; }

template <typename... Bits>
constexpr std::uint8_t bits(Bits... each) {
  return static_cast<std::uint8_t>((0U | ... | each));
}

void set(std::uint8_t& events, bool happened, std::uint8_t mask) {
  if (happened) events = bits(events, mask);
}

}  // namespace

// ---- The hosts ----------------------------------------------------------------------------------

void HostBytes::start_short(Messages::Host host, std::uint8_t control) {
  if (!messages_.start_short(host, control)) return;
  initialised_ = false;
  // In the map of the SDK the safe host alone has short messages.
  if (host == Messages::kMain) {
    event_l_ = event_l_ & static_cast<Bits>(~on::kFres);
  } else {
    event_s_ = event_s_ & static_cast<Bits>(~on::kSafeFres);
  }
}

void HostBytes::write(unsigned address, std::uint8_t data) {
  const Messages::Host own = sdk_map_ ? Messages::kSafe : Messages::kMain;
  if (address >= at::kBuffer0 && address < at::kBuffer0 + Messages::kDataBytes) {
    return messages_.set_buffer(address - at::kBuffer0, data);
  }
  switch (address) {
    case at::kSysCtrl:
    case at::kSafeCtrl:
      if ((data & on::kMrst) != 0 && (address == at::kSysCtrl || sdk_map_)) messages_.reset();
      return;
    case at::kEventH:
      event_h_ &= data;
      return;
    case at::kEventL:
      event_l_ &= data;
      return;
    case at::kEventS:
      event_s_ &= data;
      return;
    case at::kMaskH:
      mask_h_ = data & kEventsH;
      return;
    case at::kMaskL:
      mask_l_ = data & kEventsL;
      return;
    case at::kMaskS:
      mask_s_ = data & kEventsS;
      return;
    case at::kMaskSum:
      mask_sum_ = data;
      return;
    case at::kAddH:
      return messages_.set_address(Messages::kAddressHigh, data);
    case at::kAddL:
      return messages_.set_address(Messages::kAddressLow, data);
    case at::kOffH:
      return messages_.set_address(Messages::kOffsetHigh, data);
    case at::kOffL:
      return messages_.set_address(Messages::kOffsetLow, data);
    case at::kCtrl:
      if ((data & on::kStart) == 0 || !messages_.start_long()) return;
      event_l_ = event_l_ & static_cast<Bits>(~on::kFrel);
      wrong_answer_ = initialised_ = false;
      return;
    case at::kData:
      return messages_.set_data(own, data);
    case at::kSafeData:
      return messages_.set_data(Messages::kSafe, data);
    case at::kControl:
      return start_short(own, data);
    case at::kSafeControl:
      if (!sdk_map_) start_short(Messages::kSafe, data);
      return;
    default:
      return;
  }
}

bool HostBytes::interrupt() const { return (event_h_ & mask_h_) != 0 || (event_l_ & mask_l_) != 0; }
bool HostBytes::safe_interrupt() const { return (event_s_ & mask_s_) != 0; }

std::uint8_t HostBytes::read(unsigned address) const {
  const Messages::Host own = sdk_map_ ? Messages::kSafe : Messages::kMain;
  if (address >= at::kBuffer0 && address < at::kBuffer0 + Messages::kDataBytes) {
    return messages_.buffer(address - at::kBuffer0);
  }
  if (address >= at::kOnlineD && address <= at::kOnline2 + 1) return online(address);
  switch (address) {
    case at::kSysCtrl:
      return bit(messages_.resetting(), on::kMrst);
    case at::kSafeCtrl:
      return bit(sdk_map_ && messages_.resetting(), on::kMrst);
    case at::kEventH:
      return bits(event_h_, bit(interrupt(), on::kInt));
    case at::kEventL:
      return event_l_;
    case at::kEventS:
      return bits(event_s_, bit(safe_interrupt(), on::kInt));
    case at::kMaskH:
      return mask_h_;
    case at::kMaskL:
      return mask_l_;
    case at::kMaskS:
      return mask_s_;
    case at::kMaskSum:
      return mask_sum_;
    case at::kAddH:
      return messages_.address(Messages::kAddressHigh);
    case at::kAddL:
      return messages_.address(Messages::kAddressLow);
    case at::kOffH:
      return messages_.address(Messages::kOffsetHigh);
    case at::kOffL:
      return messages_.address(Messages::kOffsetLow);
    case at::kPipeS:
      return sdk_map_ ? std::uint8_t{0} : news_.pipeline_state;
    case at::kPipeD:
      return news_.pipeline;
    case at::kData:
      return messages_.data(own);
    case at::kSafeData:
      return messages_.data(Messages::kSafe);
    case at::kControl:
      return messages_.control(own);
    case at::kSafeControl:
      return sdk_map_ ? 0 : messages_.control(Messages::kSafe);
    case at::kPosTx:
      return position_state_;
    default:
      return 0;
  }
}

// High bytes at even addresses.
std::uint8_t HostBytes::online(unsigned address) const {
  const std::uint8_t second = news_.linked ? news_.safe2.summary : std::uint8_t{0};
  const std::uint8_t summary = news_.linked ? news_.safe1.summary : std::uint8_t{0};
  const bool linked = news_.linked;
  const std::uint8_t prst = bit(!linked, on::kPrst);
  const std::uint8_t low = bit(linked && news_.low, on::kQmlw);
  switch (address) {
    case at::kOnlineD:
      return bits(kFixed, bit(interrupt(), on::kInt), bit((summary & mask_sum_) != 0, on::kSum),
                  bit(linked && (news_.safe1.error || news_.safe2.error), on::kSce),
                  bit(news_.lost, on::kPos), bit(linked && marked1_, on::kVpos), prst);
    case at::kOnlineD + 1:
      return bits(bit(initialised_, on::kMin), bit(wrong_answer_, on::kAns), low,
                  bit(running_ && !messages_.long_runs(), on::kFrel),
                  bit(running_ && !messages_.short_runs(Messages::kMain), on::kFres));
    case at::kOnline1:
      return bits(kFixed, bit(safe_interrupt(), on::kInt), bit(summary != 0, on::kSum),
                  bit(linked && news_.safe1.error, on::kSce), bit(linked && marked1_, on::kVpos),
                  prst);
    case at::kOnline1 + 1:
      return bits(bit(initialised_, on::kMin), low,
                  bit(running_ && !messages_.short_runs(Messages::kSafe), on::kFres));
    case at::kOnline2:
      return bits(kFixed, bit((second & (status2::kTest | status2::kError)) != 0, on::kSum),
                  bit(linked && news_.safe2.error, on::kSce), bit(linked && marked2_, on::kVpos),
                  prst);
    default:
      return bits(
          static_cast<std::uint8_t>(second & (status2::kToggle | status2::kTest | status2::kError)),
          low);
  }
}

// ---- The link -----------------------------------------------------------------------------------

void HostBytes::begin_causes() {
  was_interrupt_ = interrupt();
  was_safe_interrupt_ = safe_interrupt();
  causes_ = {};
}

void HostBytes::end_causes() {
  causes_.event = interrupt() && !was_interrupt_;
  causes_.event_s = safe_interrupt() && !was_safe_interrupt_;
}

void HostBytes::take(const MessageEvents& events) {
  set(event_l_, events.wrong_answer, on::kAns);
  set(event_l_, events.initialised, on::kMin);
  set(event_l_, events.long_free, on::kFrel);
  set(event_l_, events.short_free[Messages::kMain], on::kFres);
  set(event_s_, events.short_free[Messages::kSafe], on::kSafeFres);
  set(event_s_, events.initialised, on::kSafeMin);
  wrong_answer_ |= events.wrong_answer;
  initialised_ |= events.initialised;
}

void HostBytes::reset_begins() {
  begin_causes();
  set(event_h_, true, on::kPrst);
  set(event_s_, true, on::kSafePrst);
  end_causes();
}

void HostBytes::link_begins() {
  begin_causes();
  running_ = true;
  take(messages_.link_begins());
  end_causes();
}

void HostBytes::link_ends() {
  begin_causes();
  take(messages_.link_ends());
  running_ = false;
  news_.linked = false;
  news_.lost = true;
  news_.pipeline_state = pipe_bit::kEmpty;
  marked1_ = marked2_ = false;
  set(event_h_, true, on::kPos);
  end_causes();
}

void HostBytes::frame(const Word& parameter, const FrameNews& news) {
  begin_causes();
  news_ = news;
  take(messages_.frame(parameter));
  set(event_h_, news.lost, on::kPos);
  set(event_l_, news.low, on::kQmlw);
  set(event_s_, news.low, on::kSafeQmlw);
  if (news.safe_new) {
    marked1_ = news.safe1.marked;
    marked2_ = news.safe2.marked;
    set(event_h_, (news.safe1.summary & mask_sum_) != 0, on::kSum);
    set(event_s_, news.safe1.summary != 0, on::kSum);
    set(event_h_, news.safe1.error || news.safe2.error, on::kSce);
    set(event_s_, news.safe1.error, on::kSce);
    set(event_h_, marked1_, on::kVpos);
    set(event_s_, marked1_, on::kSafeVpos);
  }
  causes_.frame = true;
  causes_.safe1 = news.safe_new && news.safe1.valid;
  causes_.safe2 = news.safe_new && news.safe2.valid;
  constexpr std::uint8_t kFast = 2;
  position_state_ = kFast;
  if (causes_.safe1) position_state_ = sdk_map_ ? 3 : 1;
  if (causes_.safe2 && !sdk_map_) position_state_ = 3;
  end_causes();
}

}  // namespace mb4::sim::dsl_model
