// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/dsl_model/safe_channels.hpp"

#include <span>

namespace mb4::sim::dsl_model {
namespace {

std::uint64_t position_in(const std::array<std::uint8_t, SafeChannels::kFrames>& bytes) {
  std::uint64_t position = 0;
  for (unsigned i = 1; i <= 5; ++i) position = position << 8U | bytes[i];
  return position;
}

std::uint16_t crc_in(const std::array<std::uint8_t, SafeChannels::kFrames>& bytes) {
  return static_cast<std::uint16_t>(bytes[6] << 8U | bytes[7]);
}

}  // namespace

bool fits(std::uint64_t position, unsigned bits, bool is_signed) {
  constexpr unsigned kBits = 40;
  const std::uint64_t above = (std::uint64_t{1} << kBits) - (std::uint64_t{1} << bits);
  const bool negative = is_signed && (position >> (bits - 1) & 1U) != 0;
  return (position & above) == (negative ? above : 0);
}

bool SafeChannels::frame(unsigned place, const Word& vertical, const Word& secondary,
                         QualityEvents& events) {
  // The map of the SDK compares the first byte of a position by its value alone.
  const auto take = [&](Bytes& channel, const Word& word, std::uint8_t marker) {
    channel.bytes[place] = word.byte;
    const bool first_error = word.error && !channel.code_error;
    channel.code_error |= word.error;
    const bool special = word.special && !word.is_k28();
    const bool by_value = place == 1 && word.byte == marker;
    channel.marked |= !word.error && (sdk_map_ ? by_value : special);
    return first_error;
  };
  events.safe1_error = take(bytes1_, vertical, kMarker1);
  events.safe2_error = take(bytes2_, secondary, kMarker2);
  if (firmware_ && place == 0 && (bytes2_.bytes[0] & status2::kTest) != 0)
    events.safe2_error = true;
  for (SafeChannel* safe : {&safe1_, &safe2_}) {
    if (safe->age) ++*safe->age;
  }
  if (place + 1 != kFrames) return false;

  const auto judge_channel = [](const Bytes& channel, SafeChannel& safe) {
    const std::span<const std::uint8_t> covered(channel.bytes.data(), 6);
    const bool crc = crc16(covered) == crc_in(channel.bytes);
    safe.error = channel.code_error || !crc;
    safe.marked = channel.marked;
    safe.valid = !safe.error && !channel.marked;
    if (!safe.valid) return crc;
    safe.age = 0;
    safe.position = position_in(channel.bytes);
    safe.crc = crc_in(channel.bytes);
    safe.summary = channel.bytes[0];
    return crc;
  };
  const bool crc1 = judge_channel(bytes1_, safe1_);
  const bool crc2 = judge_channel(bytes2_, safe2_);
  // A vertical frame counts once.
  if (!bytes1_.code_error) (crc1 ? events.safe1_good : events.safe1_error) = true;
  if (!bytes2_.code_error && !crc2 && !firmware_) events.safe2_error = true;
  check(crc1, crc2);
  begin();
  return true;
}

// STATUS2 is judged if the vertical frame that brought it is good.
void SafeChannels::check(bool crc1, bool crc2) {
  flags_ = {};
  flags_.set(SafeCheck::kCode1, bytes1_.code_error);
  flags_.set(SafeCheck::kCode2, bytes2_.code_error);
  flags_.set(SafeCheck::kCrc1, !bytes1_.code_error && !crc1);
  flags_.set(SafeCheck::kCrc2, !bytes2_.code_error && !crc2);
  flags_.set(SafeCheck::kMarked1, safe1_.marked);
  flags_.set(SafeCheck::kMarked2, safe2_.marked);
  if (toggle2_) toggle2_ = !*toggle2_;
  if (safe2_.error) return;
  const std::uint8_t status = bytes2_.bytes[0];
  const bool toggle = (status & status2::kToggle) != 0;
  flags_.set(SafeCheck::kToggle2, toggle2_.value_or(toggle) != toggle);
  flags_.set(SafeCheck::kTest2, (status & status2::kTest) != 0);
  flags_.set(SafeCheck::kError2, (status & status2::kError) != 0);
  flags_.set(SafeCheck::kFix2, (status & status2::kFixMask) != status2::kFix);
  toggle2_ = toggle;
}

}  // namespace mb4::sim::dsl_model
