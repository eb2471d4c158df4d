// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Version of the driver's programming interface (semantic versioning).

#ifndef MB4_VERSION_HPP_
#define MB4_VERSION_HPP_

#include <cstdint>

namespace mb4 {

inline constexpr std::uint32_t kDriverVersionMajor = 0;
inline constexpr std::uint32_t kDriverVersionMinor = 2;
inline constexpr std::uint32_t kDriverVersionPatch = 0;

}  // namespace mb4

#endif  // MB4_VERSION_HPP_
