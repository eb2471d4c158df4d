// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Must not compile: two Devices would each have their own knowledge of one chip.

#include "mb4/mb4.hpp"

using Device = mb4::Device<mb4::FunctionBus, mb4::FunctionClock>;

void use(Device device);

void misuse(Device& device) { use(device); }
