// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The quality monitor: a number of 0 to 15 by what happens in the frames. Three documents give it
// different rules.
#ifndef MB4SIM_DSL_MODEL_QUALITY_HPP_
#define MB4SIM_DSL_MODEL_QUALITY_HPP_

#include <cstdint>

namespace mb4::sim::dsl_model {

enum class QualityRules { kDocument, kSick, kFirmware };

// What a frame tells. Each of the flags counts once.
struct QualityEvents {
  bool vsync_early = false;    // VSYNC where it must not be
  bool vsync_missing = false;  // no VSYNC in the eighth frame
  bool vsync_good = false;     // VSYNC there
  bool rssi_low = false;
  bool parameter_error = false;  // code of S_PAR, of the pipeline, of the acceleration
  bool pipeline_error = false;
  bool acceleration_error = false;
  unsigned specials = 0;  // special characters that must not be there
  bool safe1_error = false;
  bool safe1_good = false;  // its CRC
  bool safe2_error = false;
};

class Quality {
 public:
  static constexpr int kStart = 8;
  static constexpr int kMost = 15;

  explicit Quality(QualityRules rules) : rules_(rules) {}
  void start() { value_ = kStart; }
  // False: the link has to begin again.
  bool frame(const QualityEvents& events);
  unsigned value() const { return value_ < 0 ? 0U : static_cast<unsigned>(value_); }
  bool low() const { return value_ < 14; }

 private:
  QualityRules rules_;
  int value_ = 0;
};

}  // namespace mb4::sim::dsl_model

#endif  // MB4SIM_DSL_MODEL_QUALITY_HPP_
