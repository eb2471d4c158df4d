// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Includes the whole driver. Its layers: drivers/README.md.

#ifndef MB4_MB4_HPP_
#define MB4_MB4_HPP_

#include "enc/cpp17.hpp"
#if __cplusplus >= 201703L

#include "mb4/automatic.hpp"
#include "mb4/bus.hpp"
#include "mb4/command.hpp"
#include "mb4/config.hpp"
#include "mb4/config/features.hpp"
#include "mb4/control.hpp"
#include "mb4/crc.hpp"
#include "mb4/device.hpp"
#include "mb4/error.hpp"
#include "mb4/fields.hpp"
#include "mb4/frame.hpp"
#include "mb4/frequency.hpp"
#include "mb4/line_delay.hpp"
#include "mb4/opcodes.hpp"
#include "mb4/parallel_bus.hpp"
#include "mb4/position.hpp"
#include "mb4/reading.hpp"
#include "mb4/register_image.hpp"
#include "mb4/result.hpp"
#include "mb4/scan.hpp"
#include "mb4/slave_address.hpp"
#include "mb4/status.hpp"
#include "mb4/version.hpp"

#endif  // C++17

#endif  // MB4_MB4_HPP_
