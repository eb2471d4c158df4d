// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Must not compile: the configuration is checked by the compiler.

#include "mb4/mb4.hpp"

constexpr mb4::Config kConfig;  // no channel, no slave, no MA frequency
static_assert(mb4::validate(kConfig).ok(), "the configuration is not valid");
