/* SPDX-FileCopyrightText: 2026 The openmb4 authors
   SPDX-License-Identifier: Apache-2.0

   Number of the fault that is awake, from the environment variable MB4_MUTANT; 0 = none. */
#ifndef MB4_TESTS_MUTATION_MUTANT_H_
#define MB4_TESTS_MUTATION_MUTANT_H_

#include <cstdlib>

inline int mb4_mutant() {
  static const int number = [] {
    const char* text = std::getenv("MB4_MUTANT");
    return text == nullptr ? 0 : std::atoi(text);
  }();
  return number;
}

#endif  // MB4_TESTS_MUTATION_MUTANT_H_
