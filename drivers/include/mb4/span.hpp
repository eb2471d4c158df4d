// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Span, a view of contiguous memory: enc/span.hpp.

#ifndef MB4_SPAN_HPP_
#define MB4_SPAN_HPP_

#include "enc/span.hpp"

namespace mb4 {

using enc::Span;

}  // namespace mb4

#endif  // MB4_SPAN_HPP_
