// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "report/progress.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>
#include <string>

namespace mb4::tool {
namespace {

constexpr auto kLong = std::chrono::seconds(1);
constexpr auto kRedraw = std::chrono::milliseconds(100);
constexpr std::uint64_t kWidth = 30;

}  // namespace

Progress::Progress(std::uint64_t total)
    : total_(total), terminal_(::isatty(STDERR_FILENO) != 0), begin_(Clock::now()) {
  next_ = begin_ + kLong;
}

void Progress::update(std::uint64_t done) {
  if (!terminal_ || done == 0 || done >= total_) return;
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + kRedraw;
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  const double left = seconds * static_cast<double>(total_ - done) / static_cast<double>(done);
  const auto filled = static_cast<std::size_t>(kWidth * done / total_);
  std::fflush(stdout);
  fmt::print(stderr, "\r\033[K[{:<{}}] {:>3} %  {} of {}, {:.0f} s left", std::string(filled, '#'),
             kWidth, 100 * done / total_, done, total_, left);
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::clear() {
  if (!drawn_) return;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace mb4::tool
