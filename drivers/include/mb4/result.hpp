// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Of enc/: `Result<T>`, which carries either a value or one of the driver's errors
// (enc/result.hpp), and `Span`, a view of contiguous memory (enc/span.hpp).

#ifndef MB4_RESULT_HPP_
#define MB4_RESULT_HPP_

#include "enc/result.hpp"
#include "enc/span.hpp"
#include "mb4/error.hpp"

namespace mb4 {

using enc::Span;

using Failure = enc::Failure<ErrorInfo>;

template <typename T>
using Result = enc::Result<T, ErrorInfo>;

}  // namespace mb4

#endif  // MB4_RESULT_HPP_
