// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/dsl/dsl_slave.hpp"

#include <algorithm>
#include <utility>

#include "sim/lines/dsl/dsl_faults.hpp"

namespace mb4::sim {
namespace {

constexpr double kBitPs = 320'000.0 / 3;  // 9.375 Mbit/s
constexpr unsigned kFrameBits = 108;
constexpr unsigned kBitsToEdge = 8;       // SYNC and the ones of SAMPLE
constexpr unsigned kSampleOnes = 4;       // before the edge, with those of SYNC
constexpr unsigned kEdgeToParameter = 8;  // CYCLE RESET with the 0 of SAMPLE, EQUALISATION
constexpr unsigned kParameterBits = 10;
constexpr unsigned kEdgeToWindow = 19;  // up to the end of SWITCH
constexpr unsigned kToEnd = 100;        // from the edge to the end of the trailer
constexpr unsigned kBlock = 6;          // bits of a block of stuffing
constexpr unsigned kMostStuffing = 26 * kBlock;
constexpr unsigned kLongestRun = 60;
constexpr std::uint64_t kTestPattern = 0x4CC8115DFB33499;  // 60 bits, without the direction bit
constexpr std::uint8_t kMarker1 = 0xFD;
constexpr std::uint8_t kMarker2 = 0xFB;
constexpr std::uint8_t kVsync = 0x80;
constexpr std::uint8_t kInitSymbol = 0x1F;
constexpr std::uint8_t kStatus2 = 0x1C;
constexpr std::uint8_t kToggle2 = 0x80;
constexpr std::uint8_t kTest2 = 0x40;
constexpr std::uint8_t kError2 = 0x20;
constexpr std::uint8_t kWrongFix2 = 0x01;
constexpr std::size_t kStatus0Address = 0x40;  // ENC_ST0
constexpr std::uint8_t kProtocolReset = 0x01;
constexpr std::uint8_t kOverflow = 0x02;

// Symbols of the master.
constexpr unsigned kMasterIdle = 0x10;
constexpr unsigned kMasterSync = 0x19;
constexpr unsigned kMasterStart = 0x1A;
constexpr unsigned kMasterCheck = 0x1C;
constexpr unsigned kMasterIdRequest = 0x1D;
constexpr unsigned kMasterInit = 0x1E;
constexpr unsigned kMasterReset = 0x1F;
constexpr unsigned kSymbol = 0x1F;
constexpr unsigned kMsyncBit = 0x40;
constexpr unsigned kFirstBit = 0x80;

// Timers, with the number of the frame above.
constexpr std::uint64_t kParameterTimer = 0;
constexpr std::uint64_t kEnableTimer = 1;
constexpr std::uint64_t kBitTimer = 2;
constexpr std::uint64_t kDisableTimer = 3;
constexpr std::uint64_t kEndTimer = 4;
constexpr unsigned kTimerBits = 3;

std::int64_t low_signed(std::uint64_t value, unsigned bits) {
  return static_cast<std::int64_t>(value << (64 - bits)) >> (64 - bits);
}

}  // namespace

std::unique_ptr<Slave> DslSlaveConfig::make_slave(std::uint64_t /*seed*/) const {
  return std::make_unique<DslSlave>(*this);
}

DeviceTraits DslSlaveConfig::traits() const {
  return {.protocol = {.key = "dsl", .title = "DSL", .start_bit = false, .answer_bits = 61},
          .alone = "an encoder with DSL"};
}

std::string_view DslSlaveConfig::refuses(const SlaveFault& fault) const {
  if (fault == slave_fault::kSilent || fault == slave_fault::kWrongCrc) return {};
  for (const SlaveFault* own : slave_fault::kOfDsl) {
    if (fault == *own) return {};
  }
  return fault.refusal;
}

DslSlave::DslSlave(const DslSlaveConfig& config)
    : config_(config),
      bit_(kBitPs / (1 + config.clock_ppm * 1e-6)),
      messages_(config.messages, {.position_bits = config.data_bits, .is_signed = config.is_signed},
                registers()) {
  set_drive(0, {true, false});
}

void DslSlave::set_fault(const SlaveFault& fault, bool on) {
  dsl::MessageFaults& messages = messages_.faults();
  const struct {
    const SlaveFault& fault;
    bool& flag;
  } kFlags[] = {{slave_fault::kWrongCrc2, wrong_crc2_},
                {slave_fault::kFastMarker, fast_marker_},
                {slave_fault::kSafeMarker, safe_marker_},
                {slave_fault::kSafe2Marker, safe2_marker_},
                {slave_fault::kNoVsync, no_vsync_},
                {slave_fault::kEarlyVsync, early_vsync_},
                {slave_fault::kLateVsync, late_vsync_},
                {slave_fault::kStaleSafe, stale_safe_},
                {slave_fault::kSafe2Mismatch, mismatch2_},
                {slave_fault::kToggle2, stuck_toggle2_},
                {slave_fault::kTest2, test2_},
                {slave_fault::kError2, error2_},
                {slave_fault::kFix2, wrong_fix2_},
                {slave_fault::kLostNibble, messages.lost_nibble},
                {slave_fault::kWrongMessage, messages.wrong_crc},
                {slave_fault::kMessageNak, messages.nak},
                {slave_fault::kNoMessage, messages.silent},
                {slave_fault::kLateMessage, messages.late},
                {slave_fault::kForeignAddress, messages.foreign_address},
                {slave_fault::kForeignDirection, messages.foreign_direction},
                {slave_fault::kForeignLength, messages.foreign_length}};
  for (const auto& each : kFlags) {
    if (fault == each.fault) each.flag = on;
  }
  DuplexSlave::set_fault(fault, on);
}

// ---- The line -----------------------------------------------------------------------------------

// Runs are counted in whole bits.
void DslSlave::line_changed(Time now, bool level) {
  const bool was = level_;
  const auto length = static_cast<double>(now - last_edge_);
  level_ = level;
  last_edge_ = now;
  if (!listening_) return;
  if (in_frame_ || !told_) edges_.push_back({now, level});
  if (in_frame_) return;
  std::move_backward(lengths_.begin(), lengths_.end() - 1, lengths_.end());
  lengths_[0] = static_cast<unsigned>(std::min(length / bit_ + 0.5, double{kLongestRun}));
  if (was && !level) look_for_sync(now);
}

// ...00 1 0 11 and the ones of SAMPLE before a falling edge.
void DslSlave::look_for_sync(Time now) {
  if (lengths_[0] < 4 || lengths_[1] != 1 || lengths_[2] != 1 || lengths_[3] < 2) return;
  begin(now);
}

void DslSlave::begin(Time now) {
  // Frames that were not recognised.
  unsigned frames = 1;
  if (any_sample_ && frame_time_ != 0) {
    constexpr double kMost = 1000;
    const double passed = static_cast<double>(now - sampled_at_) / static_cast<double>(frame_time_);
    frames = passed < kMost ? std::max(1U, static_cast<unsigned>(passed + 0.5)) : 1U;
  }
  const Time since = any_sample_ ? now - sampled_at_ : 0;
  for (unsigned i = 1; i < frames; ++i) {
    sample(sampled_at_ + since * i / frames);
    miss();
  }
  frame_time_ = since / frames;
  any_sample_ = true;
  sample(now);
  sampled_at_ = now;
  in_frame_ = true;
  edges_.clear();
  told_ = false;
  extra_ = lengths_[0] - kSampleOnes;
  stuffing_ = 0;
  ++turn_;
  // Wrong bits up to the edge hide the frame.
  lost_sync_ = false;
  wrong_parameter_ = 0;
  for (unsigned i = 0; i <= kBitsToEdge; ++i) lost_sync_ |= wrong_master_bit();
  for (unsigned i = 0; i < kParameterBits; ++i) {
    wrong_parameter_ = wrong_parameter_ << 1U | (wrong_master_bit() ? 1U : 0U);
  }
  const Time ahead = bits(kBitsToEdge + extra_);
  announce_frame(now > ahead ? now - ahead : 0);
  call_at(now + bits(kEdgeToParameter + kParameterBits - 0.25),
          turn_ << kTimerBits | kParameterTimer);
  call_at(now + bits(kToEnd + kBlock + 0.5), turn_ << kTimerBits | kEndTimer);
}

void DslSlave::timer(Time now, std::uint64_t word) {
  if (word >> kTimerBits != turn_) return;
  switch (word & ((1U << kTimerBits) - 1)) {
    case kParameterTimer:
      return take_parameter(now);
    case kEnableTimer:
      return set_drive(now, {config_.lead_level, true});
    case kBitTimer:
      return send(now);
    case kDisableTimer:
      return set_drive(now, {drive().level, false});
    default:
      return look_for_stuffing();
  }
}

// A block 001011 with a 0 behind it is stuffing; before a 1 it is the next SYNC.
void DslSlave::look_for_stuffing() {
  unsigned block = 0;
  for (unsigned i = 0; i <= kBlock; ++i) {
    block = block << 1U | (level_at(kToEnd + stuffing_ + i + 0.5) ? 1U : 0U);
  }
  if (block == 0b001011'0 && stuffing_ < kMostStuffing) {
    stuffing_ += kBlock;
    return call_at(sampled_at_ + bits(kToEnd + stuffing_ + kBlock + 0.5),
                   turn_ << kTimerBits | kEndTimer);
  }
  told_ = true;
  end_frame(sampled_at_ + bits(kToEnd + stuffing_), kFrameBits + extra_ + stuffing_);
}

bool DslSlave::level_at(double bits_behind_sample) const {
  const Time at = sampled_at_ + bits(bits_behind_sample);
  bool level = false;
  for (const Edge& edge : edges_) {
    if (edge.at > at) break;
    level = edge.level;
  }
  return level;
}

// The bits of M_PAR, each in its middle.
std::optional<std::uint8_t> DslSlave::parameter() const {
  unsigned bits_seen = 0;
  for (unsigned i = 0; i < kParameterBits; ++i) {
    bits_seen = bits_seen << 1U | (level_at(kEdgeToParameter + i + 0.5) ? 1U : 0U);
  }
  return dsl::parameter_of(bits_seen ^ wrong_parameter_);
}

void DslSlave::take_parameter(Time now) {
  if (lost_sync_) {
    miss();
    return finish(now);
  }
  // Symbols of the training are whole bytes, so that one wrong bit of a running frame makes none.
  const std::optional<std::uint8_t> read = parameter();
  const unsigned byte = read.value_or(kMasterIdle | kFirstBit | (msync_ ? kMsyncBit : 0U));
  const unsigned symbol = byte >= kMasterSync && byte <= kMasterReset ? byte
                          : (byte & kSymbol) == kMasterInit           ? kMasterInit
                                                                      : kMasterIdle;
  if (symbol == kMasterReset || symbol == kMasterSync) {
    syncs_ = symbol == kMasterReset ? 0 : syncs_ + 1;
    training_ = 0;
    started_ = false;
    return finish(now);
  }
  // Up to the first START the line is the master's.
  if (syncs_ < config_.sync_frames || (training_ == 0 && symbol != kMasterStart)) {
    return finish(now);
  }
  const bool changes = msync_seen_ && ((byte & kMsyncBit) != 0) != msync_;
  msync_ = (byte & kMsyncBit) != 0;
  msync_seen_ = started_;
  if (started_ && changes && config_.msync == DslFollow::kFollow) {
    place_ = (kVertical - config_.vsync_phase) % kVertical;
  }
  word_ = answer(symbol, read ? std::optional<unsigned>(byte & kSymbol) : std::nullopt);
  if (config_.first == DslFollow::kIgnore || (byte & kFirstBit) != 0) go_on();

  listening_ = false;
  next_bit_ = 0;
  answer_at_ = sampled_at_ + bits(kEdgeToWindow) + config_.latency;
  const Time before = config_.lead + enable_time();
  const Time on = std::max(now, answer_at_ - std::min(answer_at_, before));
  call_at(on, turn_ << kTimerBits | kEnableTimer);
  call_at(answer_at_, turn_ << kTimerBits | kBitTimer);
  const Time off = answer_at_ + bits(kAnswerBits) + config_.lead;
  call_at(off - std::min(off - answer_at_, disable_time()), turn_ << kTimerBits | kDisableTimer);
}

// Sends the bit that begins now, and those equal to it.
void DslSlave::send(Time now) {
  if (next_bit_ == kAnswerBits) {
    set_drive(now, {config_.lead_level, drive().enable});
    return finish(now);
  }
  const bool level = (word_ >> (kAnswerBits - 1 - next_bit_) & 1U) != 0;
  set_drive(now, {level, drive().enable});
  while (next_bit_ < kAnswerBits && ((word_ >> (kAnswerBits - 1 - next_bit_) & 1U) != 0) == level) {
    ++next_bit_;
  }
  call_at(answer_at_ + bits(next_bit_), turn_ << kTimerBits | kBitTimer);
}

// It looks for the next frame.
void DslSlave::finish(Time now) {
  in_frame_ = false;
  listening_ = true;
  if (!told_) edges_.push_back({now, level_});  // the edges of its answer are not there
  last_edge_ = now;
  lengths_.fill(0);
}

// ---- Motion -------------------------------------------------------------------------------------

std::optional<std::uint64_t> DslSlave::sampled_near(Time at, Time within) const {
  for (const Sample& one : last_) {
    const Time away = one.at > at ? one.at - at : at - one.at;
    if (one.at != kNever && away <= within) return one.position;
  }
  return std::nullopt;
}

void DslSlave::sample(Time at) {
  before_ = position_;
  const std::uint64_t mask = ~std::uint64_t{0} >> (64 - config_.data_bits);
  position_ = (motion_ != nullptr ? motion_(motion_context_) : config_.word(at, samples_)) & mask;
  last_[samples_ % last_.size()] = {at, position_};
  ++samples_;
  const std::int64_t speed = low_signed(position_ - before_, config_.data_bits);
  acceleration_ = speed - speed_;
  speed_ = speed;
}

// The next frame of the vertical frame.
void DslSlave::go_on() {
  if (started_) place_ = (place_ + 1) % kVertical;
}

// A frame without an answer.
void DslSlave::miss() {
  if (started_ && place_ == 0) fill_channels();
  if (vsync_sent_) {
    ++running_;
    count_frame();
    messages_.miss();
  }
  go_on();
}

// ---- Answers ------------------------------------------------------------------------------------

std::uint64_t DslSlave::answer(unsigned symbol, std::optional<unsigned> seen) {
  inverted_ = noise();
  if (symbol >= kMasterStart && symbol <= kMasterCheck) return pattern() ^ inverted_;
  if (symbol == kMasterIdRequest) return identity() ^ inverted_;
  if (!started_) {
    started_ = true;
    inits_ = 0;
    vsync_sent_ = false;
    owes_vsync_ = false;
    told_safe_.reset();
    messages_.reset();
    set_status0(kProtocolReset);
    msync_seen_ = true;
    place_ = (kVertical - config_.vsync_after % kVertical) % kVertical;
    fill_channels();
  }
  if (symbol == kMasterInit && !vsync_sent_) ++inits_;
  const std::uint64_t word = data_frame(seen);
  return word ^ inverted_;
}

// The bits of an answer that are wrong at random.
std::uint64_t DslSlave::noise() {
  std::uint64_t wrong = 0;
  for (unsigned i = 0; i < kAnswerBits; ++i) {
    wrong |= std::uint64_t{wrong_answer_bit() ? 1U : 0U} << i;
  }
  return wrong;
}

std::uint64_t DslSlave::pattern() {
  constexpr unsigned kAfter = 10;  // bits behind the direction bit
  const std::uint64_t high = kTestPattern >> kAfter;
  const bool direction = config_.direction.value_or((high & 1U) == 0);
  std::uint64_t word =
      (high << 1U | (direction ? 1U : 0U)) << kAfter | (kTestPattern & ((1U << kAfter) - 1));
  ++training_;
  if (training_ == config_.wrong_pattern && !pattern_was_wrong_) {
    pattern_was_wrong_ = true;
    word ^= std::uint64_t{1} << 30U;
  }
  if (training_ == training_flip_.first) {
    word ^= std::uint64_t{1} << (kAnswerBits - 1 - training_flip_.second);
    training_flip_ = {0, 0};
  }
  return word;
}

namespace {

std::uint64_t join(std::initializer_list<unsigned> words) {
  std::uint64_t all = 0;
  for (const unsigned word : words) all = all << 10U | word;
  return all;
}

// Five words, the direction bit, and the last word.
std::uint64_t with_direction(std::uint64_t five, std::optional<bool> direction, unsigned last) {
  const bool bit = direction.value_or((five & 1U) == 0);
  return (five << 1U | (bit ? 1U : 0U)) << 10U | last;
}

}  // namespace

std::uint64_t DslSlave::identity() const {
  const unsigned id =
      (config_.index << 12U | (config_.is_signed ? 1U << 10U : 0U) |
       (config_.data_bits - config_.acceleration_bits) << 4U | (config_.acceleration_bits - 8)) ^
      config_.identity_flip;
  dsl::Coder coder(config_.positive);
  const auto low = static_cast<std::uint8_t>(id);
  const auto high = static_cast<std::uint8_t>(id >> 8U);
  const auto nibble = static_cast<std::uint8_t>(id >> 16U);
  const unsigned a = coder.data(low);
  const unsigned b = coder.data(high);
  const unsigned c = coder.data(static_cast<std::uint8_t>(nibble << 4U | nibble));
  const unsigned d = coder.data(high);
  const unsigned e =
      coder.data(config_.broken_identity ? static_cast<std::uint8_t>(low ^ 1U) : low);
  return with_direction(join({a, b, c, d, e}), config_.direction, coder.data(kStatus2));
}

// The safe position is that of the sample before the vertical frame.
void DslSlave::fill_channels() {
  const unsigned width = config_.data_bits;
  if (!stale_safe_ || !told_safe_) told_safe_ = before_;
  const auto position =
      config_.is_signed ? low_signed(*told_safe_, width) : static_cast<std::int64_t>(*told_safe_);
  const unsigned width2 = config_.safe2_bits == 0 ? width : std::min(config_.safe2_bits, width);
  std::int64_t second = ~(position >> (width - width2));
  if (mismatch2_) second ^= std::int64_t{1} << (width2 - 1);
  const auto fill = [](Channel& channel, std::uint8_t status, std::int64_t value,
                       std::optional<std::uint8_t> marker) {
    channel.bytes[0] = status;
    for (unsigned i = 1; i <= 5; ++i) {
      channel.bytes[i] = static_cast<std::uint8_t>(value >> 8U * (5 - i));
    }
    channel.marked = marker.has_value();
    if (marker) channel.bytes[1] = *marker;
    const auto& b = channel.bytes;
    const std::uint16_t crc = dsl::check_safe({b[0], b[1], b[2], b[3], b[4], b[5]});
    channel.bytes[6] = static_cast<std::uint8_t>(crc >> 8U);
    channel.bytes[7] = static_cast<std::uint8_t>(crc);
  };
  if (!stuck_toggle2_) toggle2_ = !toggle2_;
  const unsigned status2 = (kStatus2 ^ (wrong_fix2_ ? kWrongFix2 : 0U)) |
                           (toggle2_ ? kToggle2 : 0U) | (test2_ ? kTest2 : 0U) |
                           (error2_ ? kError2 : 0U);
  fill(safe1_, config_.summary, position, safe_marker_ ? std::optional(kMarker1) : std::nullopt);
  fill(safe2_, static_cast<std::uint8_t>(status2), second,
       safe2_marker_ ? std::optional(kMarker2) : std::nullopt);
  if (wrong_crc()) safe1_.bytes[7] ^= 1U;
  if (wrong_crc2_) safe2_.bytes[7] ^= 1U;
}

void DslSlave::set_status0(std::uint8_t bits) {
  const std::uint8_t before = registers().get(kStatus0Address);
  registers().set(kStatus0Address, static_cast<std::uint8_t>(before | bits));
}

// VSYNC, with its faults.
bool DslSlave::vsync_now() {
  constexpr unsigned kLast = kVertical - 1;
  const bool owed = std::exchange(owes_vsync_, false);
  const bool due = place_ == kLast && inits_ >= config_.vsync_after;
  if (due) vsync_sent_ = true;
  if (no_vsync_) return early_vsync_ && place_ + 1 == kLast;
  if (due && late_vsync_) {
    owes_vsync_ = true;
    return false;
  }
  return due || owed || (early_vsync_ && place_ + 1 == kLast);
}

std::uint8_t DslSlave::s_par(std::optional<unsigned> symbol) {
  unsigned own = kInitSymbol;
  if (vsync_sent_) {
    own = messages_.frame(symbol);
    if (symbol == kMasterInit) {
      messages_.reset();
      own = kInitSymbol;
    }
  }
  return static_cast<std::uint8_t>((vsync_now() ? kVsync : 0U) | config_.s_par_bits << 5U | own);
}

std::uint64_t DslSlave::data_frame(std::optional<unsigned> symbol) {
  if (place_ == 0) fill_channels();
  const bool running = vsync_sent_;

  const std::int64_t limit = std::int64_t{1} << (config_.acceleration_bits - 1);
  const bool fits = acceleration_ >= -limit && acceleration_ < limit;
  if (!fits) {
    overflowed_ = true;
    set_status0(kOverflow);
  }
  dsl::Coder coder(config_.positive);
  const bool marked1 = safe1_.marked && place_ == 1;
  const bool marked2 = safe2_.marked && place_ == 1;
  const std::uint8_t first = safe1_.bytes[place_];
  const bool special1 = config_.vertical_k28 && (first & 0x1FU) == kStatus2;
  const unsigned a = marked1    ? coder.special(kMarker1)
                     : special1 ? coder.special(first)
                                : coder.data(first);
  const unsigned b = coder.data(s_par(symbol));
  const unsigned c = coder.data(config_.pipeline);
  unsigned d = 0;
  unsigned e = 0;
  if (fits && !fast_marker_) {
    const std::uint16_t word = dsl::with_check(static_cast<int>(acceleration_));
    d = coder.data(static_cast<std::uint8_t>(word >> 8U));
    e = coder.data(static_cast<std::uint8_t>(word));
  } else {
    d = coder.special(kMarker1);
    e = coder.special(kMarker1);
  }
  const std::uint64_t five = join({a, b, c, d, e});
  const std::uint8_t second = safe2_.bytes[place_];
  const bool special2 = place_ == 0 && config_.status2_k28 && (second & 0x1FU) == kStatus2;
  const unsigned f = marked2    ? coder.special(kMarker2)
                     : special2 ? coder.special(second)
                                : coder.data(second);

  if (running) {
    ++running_;
    count_frame();
    std::uint64_t flips = 0;
    for (const unsigned bit : take_flips(running_)) {
      if (bit < kAnswerBits) flips |= std::uint64_t{1} << (kAnswerBits - 1 - bit);
    }
    inverted_ ^= flips;
  }
  return with_direction(five, config_.direction, f);
}

}  // namespace mb4::sim
