// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A waveform file as a test sees it.
#ifndef TESTS_UNIT_MODEL_WAVEFORM_HPP_
#define TESTS_UNIT_MODEL_WAVEFORM_HPP_

#include <gtest/gtest.h>
#include <gtkwave/fstapi.h>

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/time.hpp"

namespace mb4test {

using Changes = std::vector<std::pair<std::uint64_t, std::string>>;  // times and values

struct Waveform {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
  std::map<std::string, Changes> changes;  // by the name of a signal
};

inline Waveform read_waveform(const std::string& path) {
  void* const reader = fstReaderOpen(path.c_str());
  if (reader == nullptr) throw std::runtime_error(path + " is no waveform");
  Waveform wave;
  wave.begin = fstReaderGetStartTime(reader);
  wave.end = fstReaderGetEndTime(reader);
  EXPECT_EQ(fstReaderGetTimescale(reader), -12);  // ps
  std::map<fstHandle, std::string> names;
  fstReaderResetScope(reader);
  std::string scope;
  while (const fstHier* entry = fstReaderIterateHier(reader)) {
    if (entry->htyp == FST_HT_SCOPE)
      scope = fstReaderPushScope(reader, entry->u.scope.name, nullptr);
    if (entry->htyp == FST_HT_UPSCOPE) scope = fstReaderPopScope(reader);
    if (entry->htyp == FST_HT_VAR) {
      names.emplace(entry->u.var.handle, scope + "." + entry->u.var.name);
    }
  }
  struct Context {
    Waveform& wave;
    const std::map<fstHandle, std::string>& names;
  } context{wave, names};
  fstReaderSetFacProcessMaskAll(reader);
  fstReaderIterBlocks(
      reader,
      [](void* user, std::uint64_t time, fstHandle signal, const unsigned char* value) {
        auto& to = *static_cast<Context*>(user);
        auto& changes = to.wave.changes[to.names.at(signal)];
        const std::string text = reinterpret_cast<const char*>(value);
        if (changes.empty() || changes.back().second != text) changes.emplace_back(time, text);
      },
      &context, nullptr);
  fstReaderClose(reader);
  return wave;
}

// The values from `begin` on. Several evaluations of one time stand one picosecond after the other,
// and there may be one more at the begin of a file.
inline Changes since(mb4::sim::Time begin, const Changes& changes) {
  constexpr mb4::sim::Time kEvaluations = 20;
  Changes found;
  for (const auto& [time, value] : changes) {
    const bool first = time <= begin + kEvaluations;
    if (first) found.clear();
    found.emplace_back(first ? begin : time, value);
  }
  return found;
}

}  // namespace mb4test

#endif  // TESTS_UNIT_MODEL_WAVEFORM_HPP_
