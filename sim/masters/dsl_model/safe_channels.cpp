// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/dsl_model/safe_channels.hpp"

#include <span>

namespace mb4::sim::dsl_model {
namespace {

constexpr std::uint8_t kTest2 = 0x40;  // in STATUS2

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
  const auto take = [place](Bytes& channel, const Word& word) {
    channel.bytes[place] = word.byte;
    const bool first_error = word.error && !channel.code_error;
    channel.code_error |= word.error;
    channel.marked |= word.special && !word.error && !word.is_k28();
    return first_error;
  };
  events.safe1_error = take(bytes1_, vertical);
  events.safe2_error = take(bytes2_, secondary);
  if (firmware_ && place == 0 && (bytes2_.bytes[0] & kTest2) != 0) events.safe2_error = true;
  if (place + 1 != kFrames) return false;

  const auto judge_channel = [](const Bytes& channel, SafeChannel& safe) {
    const std::span<const std::uint8_t> covered(channel.bytes.data(), 6);
    const bool crc = crc16(covered) == crc_in(channel.bytes);
    safe.error = channel.code_error || !crc;
    safe.valid = !safe.error && !channel.marked;
    if (!safe.valid) return crc;
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
  begin();
  return true;
}

}  // namespace mb4::sim::dsl_model
