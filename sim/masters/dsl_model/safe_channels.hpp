// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The two safe channels: eight frames bring the eight bytes of each, and the last one judges them.
#ifndef MB4SIM_DSL_MODEL_SAFE_CHANNELS_HPP_
#define MB4SIM_DSL_MODEL_SAFE_CHANNELS_HPP_

#include <array>
#include <cstdint>
#include <optional>

#include "sim/masters/dsl_model/line_code.hpp"
#include "sim/masters/dsl_model/quality.hpp"
#include "sim/masters/dsl_model/safe_checks.hpp"

namespace mb4::sim::dsl_model {

// STATUS2, the first byte of the second channel.
namespace status2 {
inline constexpr std::uint8_t kToggle = 0x80;  // it changes with each vertical frame
inline constexpr std::uint8_t kTest = 0x40;    // a test runs
inline constexpr std::uint8_t kError = 0x20;
inline constexpr std::uint8_t kFixMask = 0x1F;
inline constexpr std::uint8_t kFix = 0x1C;  // of these bits
}  // namespace status2

// A safe channel: what came with the last good vertical frame.
struct SafeChannel {
  std::uint64_t position = 0;  // 40 bits
  std::uint16_t crc = 0;
  std::uint8_t summary = 0;  // STATUS2 of the second channel
  bool valid = false;        // the last vertical frame was good
  bool error = false;        // its code or its CRC was wrong
  bool marked = false;       // the encoder said in it that it has no position
  // Frames since the last good vertical frame; nothing: none in this link, or no link.
  std::optional<std::uint32_t> age{};
};

// The bits of a safe position above its width are as its sign, or without a sign 0.
bool fits(std::uint64_t position, unsigned bits, bool is_signed);

class SafeChannels {
 public:
  // Frames of a vertical frame.
  static constexpr unsigned kFrames = 8;

  explicit SafeChannels(QualityRules rules, bool sdk_map = false)
      : firmware_(rules == QualityRules::kFirmware), sdk_map_(sdk_map) {}

  // A link begins.
  void start() {
    safe1_ = safe2_ = {};
    toggle2_.reset();
  }
  // Its first vertical frame does.
  void begin() { bytes1_ = bytes2_ = {}; }
  // A frame, the one at `place` in its vertical frame. True: the channels have been judged.
  bool frame(unsigned place, const Word& vertical, const Word& secondary, QualityEvents& events);

  const SafeChannel& safe1() const { return safe1_; }
  const SafeChannel& safe2() const { return safe2_; }
  // What the last vertical frame has failed by its own bytes.
  const SafeFlags& flags() const { return flags_; }

 private:
  // The bytes of the running vertical frame.
  struct Bytes {
    std::array<std::uint8_t, kFrames> bytes{};
    bool code_error = false;
    bool marked = false;  // the encoder reports a fault of its own, or another special character
  };

  void check(bool crc1, bool crc2);

  bool firmware_;
  bool sdk_map_;
  Bytes bytes1_;
  Bytes bytes2_;
  SafeChannel safe1_;
  SafeChannel safe2_;
  SafeFlags flags_;
  std::optional<bool> toggle2_;  // that the next vertical frame must have
};

}  // namespace mb4::sim::dsl_model

#endif  // MB4SIM_DSL_MODEL_SAFE_CHANNELS_HPP_
