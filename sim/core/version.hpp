// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#ifndef MB4SIM_VERSION_HPP_
#define MB4SIM_VERSION_HPP_

namespace mb4::sim {

// Version of the library as "major.minor.patch". It is the project's version in the top-level
// CMakeLists.txt.
const char* version();

}  // namespace mb4::sim

#endif  // MB4SIM_VERSION_HPP_
