// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/dsl_model/frame_plan.hpp"

#include "sim/masters/dsl_model/line_code.hpp"

namespace mb4::sim::dsl_model {
namespace {

constexpr unsigned kGapBits = 16;

}  // namespace

unsigned equalise(int& disparity) {
  struct Choice {
    unsigned pattern;
    int counts;
  };
  const Choice choice = disparity > 3     ? Choice{0b0000, -4}
                        : disparity > 1   ? Choice{0b0010, -2}
                        : disparity >= -1 ? Choice{0b0000, 0}
                        : disparity >= -3 ? Choice{0b1101, 2}
                                          : Choice{0b1111, 4};
  disparity += choice.counts;
  return choice.pattern;
}

void FramePlan::put(bool level, bool drives) {
  eighths_[bits_] = level ? 0xFF : 0;
  drives_[bits_++] = drives;
}

void FramePlan::put_bits(unsigned bits, unsigned count) {
  while (count-- > 0) put((bits >> count & 1U) != 0);
}

void FramePlan::make(unsigned parameter, bool answer, const FrameShape& shape, int& disparity,
                     int added) {
  bits_ = 0;
  put_bits(0b001011'11, 8);
  for (unsigned i = 0; i < shape.extra; ++i) put(true);
  sample_tick_ = bits_ * kTicksPerBit + shape.rest;
  if (shape.rest != 0) {
    put(true);
    eighths_[bits_ - 1] = static_cast<std::uint8_t>(0xFF00U >> shape.rest);
  }
  put_bits(0b0'110, 4);
  disparity += added;
  equalisation_ = equalise(disparity);
  parameter_word_ = encode_parameter(parameter, disparity);
  put_bits(equalisation_, 4);
  put_bits(parameter_word_, 10);
  switch_bit_ = bits_;
  for (unsigned i = 0; i < kWindowBits; ++i) put(answer || i % 2 != 0, !answer);
  put_bits(0b00000011, 8);
  trailer_end_ = bits_;
  for (unsigned i = 0; i < shape.blocks; ++i) put_bits(0b001011, 6);
  if (answer) disparity = 0;
}

void FramePlan::make_gap() {
  bits_ = 0;
  for (unsigned i = 0; i < kGapBits; ++i) put(true, false);
  put_bits(0, kGapBits);
  trailer_end_ = bits_;
  sample_tick_ = switch_bit_ = 0;
}

}  // namespace mb4::sim::dsl_model
