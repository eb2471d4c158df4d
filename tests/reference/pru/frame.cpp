// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

#include "tests/reference/pru/frame.hpp"

namespace pru_judge {
namespace {

// The first byte that is not 0xFF, from byte 0 to the byte in which the clocks of the search end.
std::optional<unsigned> transition(const FrameSettings& settings, const Samples& samples) {
  for (unsigned m = 0; m <= settings.search_periods(); ++m) {
    if (samples.byte(m) != 0xFF) return m;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Time> rising_edge_1(const std::vector<Edge>& ma) {
  bool fallen = false;
  for (const Edge& edge : ma) {
    if (edge.level && fallen) return edge.at;
    fallen = fallen || !edge.level;
  }
  return std::nullopt;
}

FrameReading read_frame(const FrameSettings& settings, const Trace& sl, Time rising_edge_1) {
  FrameReading reading;
  reading.rising_edge_1 = rising_edge_1;
  const Samples samples(settings.rate, settings.phase, sl,
                        rising_edge_1 + settings.rate.period_ps());

  const std::optional<unsigned> found = transition(settings, samples);
  if (!found) {
    reading.kind = FrameKind::kNoAcknowledge;
    reading.raw = 0xFF;
    reading.byte = settings.search_periods();
    reading.last_sample = samples.instant(reading.byte * kSamples + kSamples - 1);
    return reading;
  }
  reading.byte = *found;
  reading.raw = samples.byte(reading.byte);
  reading.own_place = place_of(reading.raw, settings.first_low);
  reading.used_place = settings.averages
                           ? settings.average.used(reading.own_place, settings.sma_wrap)
                           : reading.own_place;

  // One sample each period from the one of the acknowledge on, which is not looked at itself.
  unsigned sample = reading.byte * kSamples + reading.used_place;
  while (!samples.level(sample += kSamples)) {
    if (++reading.zeros > settings.limit) {
      reading.kind = FrameKind::kDropped;
      reading.last_sample = samples.instant(sample);
      return reading;
    }
  }
  reading.kind = FrameKind::kRead;
  reading.start_bit = samples.instant(sample);
  reading.cds = samples.level(sample += kSamples);
  for (unsigned i = 0; i < settings.bits(); ++i) {
    reading.bits += samples.level(sample += kSamples) ? '1' : '0';
  }
  reading.last_sample = samples.instant(sample);
  return reading;
}

}  // namespace pru_judge
