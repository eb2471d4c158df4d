// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The checks of a vertical frame that a safety user decides by. The master shows them and decides
// nothing.
#ifndef MB4SIM_DSL_MODEL_SAFE_CHECKS_HPP_
#define MB4SIM_DSL_MODEL_SAFE_CHECKS_HPP_

#include <cstdint>

namespace mb4::sim::dsl_model {

// Of a host.
struct SafeCheckRules {
  unsigned bits2 = 0;      // of the second safe position; 0: the two are not compared
  unsigned tolerance = 0;  // their difference may be that much, in steps of the second
};

// Bit numbers of what a vertical frame has failed.
enum class SafeCheck : unsigned {
  kMismatch,  // the two safe positions differ
  kToggle2,   // the toggle bit is that of the last good STATUS2
  kTest2,
  kError2,
  kFix2,  // the lowest five bits of STATUS2 are not 11100
  kMarked1,
  kMarked2,
  kCrc1,
  kCrc2,
  kCode1,
  kCode2,
  kVsyncEarly,
  kVsyncMissing,  // of the vertical frame before
  kStale,         // safe and fast position differ
  kVsyncLate,     // of the vertical frame before: VSYNC came with RX0 of this one
};
constexpr unsigned kSafeChecks = 15;
const char* name_of(SafeCheck check);

// A set of them.
class SafeFlags {
 public:
  bool has(SafeCheck check) const { return (bits_ >> static_cast<unsigned>(check) & 1U) != 0; }
  void set(SafeCheck check, bool on) {
    if (on) bits_ |= 1U << static_cast<unsigned>(check);
  }
  unsigned bits() const { return bits_; }

 private:
  unsigned bits_ = 0;
};

// Both positions are of the same vertical frame. The second one is inverted, and has the upper bits
// of the first one if it has fewer.
bool positions_agree(std::uint64_t first, unsigned bits1, std::uint64_t second,
                     const SafeCheckRules& rules);

// VSYNC over the frames of vertical frames.
class VsyncWatch {
 public:
  // The first vertical frame begins behind a VSYNC.
  void start() { *this = {}; }
  // A frame at this place. Nothing is judged if S_PAR could not be read.
  void frame(unsigned place, bool readable, bool vsync);
  // At the end of a vertical frame: what is known of VSYNC.
  void judge(SafeFlags& flags);

 private:
  enum class Last { kCame, kUnknown, kMissing };
  Last before_ = Last::kCame;  // VSYNC of the vertical frame before this one
  Last own_ = Last::kUnknown;
  bool early_ = false;
  bool late_ = false;
};

}  // namespace mb4::sim::dsl_model

#endif  // MB4SIM_DSL_MODEL_SAFE_CHECKS_HPP_
