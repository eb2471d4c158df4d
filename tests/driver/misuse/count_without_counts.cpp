// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Must not compile: the reads of this object have no code that counts.

#include "mb4/mb4.hpp"

using Device = mb4::Device<mb4::FunctionBus, mb4::FunctionClock>;

void misuse(Device& device, mb4_counts& counts) { device.automatic<0>().count(&counts); }
