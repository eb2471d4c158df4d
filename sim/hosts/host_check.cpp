// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/hosts/host_check.hpp"

#include <cstdio>

namespace mb4::sim {
namespace {

std::string ns(Time time) {
  char text[40];
  std::snprintf(text, sizeof(text), "%llu.%03llu", static_cast<unsigned long long>(time / kPsPerNs),
                static_cast<unsigned long long>(time % kPsPerNs));
  return text;
}

}  // namespace

void HostCheck::clear() {
  violations_.clear();
  count_ = 0;
}

void HostCheck::need(Time now, const char* item, const char* what, Time since, Time minimum) {
  if (since == kNever || now - since >= minimum) return;
  ++count_;
  if (violations_.size() >= kKept) return;
  violations_.push_back({item, std::string(item) + ": " + what + " " + ns(now - since) + " ns at " +
                                   ns(now) + " ns, at least " + ns(minimum) + " ns"});
}

}  // namespace mb4::sim
