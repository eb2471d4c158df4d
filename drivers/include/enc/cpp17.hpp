// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// An older C++ gets this one error from the headers that a program includes, instead of hundreds.
// Each of them is empty then.

#ifndef ENC_CPP17_HPP_
#define ENC_CPP17_HPP_

#if __cplusplus < 201703L
#error "openmb4: the driver needs C++17 or newer: compile with -std=c++17 (CMake: cxx_std_17)"
#endif

#endif  // ENC_CPP17_HPP_
