// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What whoever runs a test can set.
#ifndef TESTS_SUPPORT_ENVIRONMENT_HPP_
#define TESTS_SUPPORT_ENVIRONMENT_HPP_

#include <cstdint>
#include <cstdlib>

namespace mb4test {

// A variable of the environment, decimal or with 0x; `usual` if it is not set.
inline std::uint64_t number(const char* name, std::uint64_t usual) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 0) : usual;
}

}  // namespace mb4test

#endif  // TESTS_SUPPORT_ENVIRONMENT_HPP_
