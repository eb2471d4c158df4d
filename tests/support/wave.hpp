// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A test again, with a waveform: MB4_WAVE=file.fst. The simulators of a test count from 1, and all
// but the first have their number in the name: file.2.fst. A second test writes over the files of
// the first one, so run one at a time. A test that fails prints the command. Tests without a
// simulator (block_test) and those of the DSL master write nothing.
#ifndef TESTS_SUPPORT_WAVE_HPP_
#define TESTS_SUPPORT_WAVE_HPP_

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "mb4sim/simulator.hpp"

namespace mb4test {

// Prints the command behind a test that has failed.
class WaveAdvice : public testing::EmptyTestEventListener {
 public:
  static unsigned& simulators() {
    static unsigned count = 0;
    return count;
  }

 private:
  void OnTestStart(const testing::TestInfo& /*info*/) override { simulators() = 0; }
  void OnTestEnd(const testing::TestInfo& info) override {
    if (!info.result()->Failed() || simulators() == 0 || std::getenv("MB4_WAVE") != nullptr) return;
    std::string settings;  // seeds, numbers of frames, the host
    for (char** one = environ; *one != nullptr; ++one) {
      const std::string_view setting{*one};
      if (!setting.starts_with("MB4_")) continue;
      const std::size_t name = setting.find('=') + 1;
      settings.append(setting.substr(0, name)).append("'").append(setting.substr(name)) += "' ";
    }
    std::printf("the same with a waveform: %sMB4_WAVE=wave.fst %s --gtest_filter=%s.%s\n",
                settings.c_str(), std::filesystem::read_symlink("/proc/self/exe").c_str(),
                info.test_suite_name(), info.name());
  }
};

inline const bool kAdvises = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new WaveAdvice);
  return true;
}();

// The options of a test's simulator.
inline mb4::sim::SimulatorOptions with_wave(mb4::sim::SimulatorOptions options = {}) {
  const unsigned number = ++WaveAdvice::simulators();
  const char* const file = std::getenv("MB4_WAVE");
  if (file == nullptr || options.trace_path) return options;
  std::filesystem::path path = file;
  if (number > 1) path.replace_extension(std::to_string(number) + path.extension().string());
  options.trace_path = path.string();
  return options;
}

}  // namespace mb4test

#endif  // TESTS_SUPPORT_WAVE_HPP_
