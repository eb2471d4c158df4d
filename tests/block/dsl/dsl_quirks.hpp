// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The rules of a link as a block of the DSL master takes them.
#ifndef TESTS_BLOCK_DSL_DSL_QUIRKS_HPP_
#define TESTS_BLOCK_DSL_DSL_QUIRKS_HPP_

#include "sim/masters/dsl_model/link.hpp"

namespace mb4test {

// dsl_pkg::quirks_t.
inline unsigned quirks_of(const mb4::sim::dsl_model::LinkRules& rules) {
  unsigned port = 0;
  const auto add = [&port](unsigned value, unsigned width) { port = port << width | value; };
  add(0, 1);
  add(rules.recover ? 1 : 0, 1);
  add(rules.check == mb4::sim::dsl_model::CodeCheck::kStrict ? 1 : 0, 1);
  add(static_cast<unsigned>(rules.sample), 2);
  add(static_cast<unsigned>(rules.quality), 2);
  add(rules.rssi_table ? 1 : 0, 1);
  add(rules.rx_start, 4);
  add(rules.start_blocks, 5);
  add(rules.vsync_limit, 8);
  add(rules.stale_limit, 2);
  return port;
}

}  // namespace mb4test

#endif  // TESTS_BLOCK_DSL_DSL_QUIRKS_HPP_
