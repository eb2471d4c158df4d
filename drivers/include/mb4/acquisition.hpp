// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The former name of device.hpp for single frames: Device::read_frame() and read_all().

#ifndef MB4_ACQUISITION_HPP_
#define MB4_ACQUISITION_HPP_

#include "enc/cpp17.hpp"
#if __cplusplus >= 201703L

#include "mb4/device.hpp"

#endif  // C++17

#endif  // MB4_ACQUISITION_HPP_
