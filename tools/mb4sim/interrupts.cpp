// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "interrupts.hpp"

#include <fmt/core.h>

#include <cstring>

namespace mb4::tool {
namespace {

volatile sig_atomic_t g_first = 0;

void remember(int signal) {
  if (g_first == 0) g_first = signal;
}

}  // namespace

Interrupted::Interrupted(int signal)
    : std::runtime_error(fmt::format("interrupted by SIG{}", ::sigabbrev_np(signal))),
      signal_(signal) {}

Interrupts::Interrupts() {
  g_first = 0;
  struct sigaction action {};
  action.sa_handler = &remember;
  // Without SA_RESTART a waiting system call returns with EINTR.
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) ::sigaction(kSignals[i], &action, nullptr);
  }
}

int Interrupts::signal() const { return g_first; }

void Interrupts::restore() const {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], &before_[i], nullptr);
  }
}

}  // namespace mb4::tool
