// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The rules of a link as a block of the DSL master takes them.
#ifndef TESTS_BLOCK_DSL_DSL_QUIRKS_HPP_
#define TESTS_BLOCK_DSL_DSL_QUIRKS_HPP_

#include "sim/masters/dsl_model/dsl_quirks.hpp"

namespace mb4test {

// dsl_pkg::quirks_t.
inline unsigned quirks_of(const mb4::sim::dsl_model::LinkRules& rules) {
  return mb4::sim::dsl_model::packed(rules);
}

}  // namespace mb4test

#endif  // TESTS_BLOCK_DSL_DSL_QUIRKS_HPP_
