// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/hosts/host_check.hpp"

#include "sim/core/number_text.hpp"

namespace mb4::sim {

void HostCheck::clear() {
  violations_.clear();
  count_ = 0;
}

void HostCheck::violated(Time now, const char* item, const char* what, Time since, Time minimum) {
  ++count_;
  if (violations_.size() >= kKept) return;
  violations_.push_back({item, std::string(item) + ": " + what + " " + ns_text(now - since) +
                                   " ns at " + ns_text(now) + " ns, at least " + ns_text(minimum) +
                                   " ns"});
}

}  // namespace mb4::sim
