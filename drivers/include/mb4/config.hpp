// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The configuration: Config, what follows from it, and validate(), its complete check.

#ifndef MB4_CONFIG_HPP_
#define MB4_CONFIG_HPP_

#include "mb4/config/frame_time.hpp"
#include "mb4/config/members.hpp"
#include "mb4/config/slaves.hpp"
#include "mb4/config/validate.hpp"
#include "mb4/crc.hpp"
#include "mb4/frequency.hpp"

#endif  // MB4_CONFIG_HPP_
