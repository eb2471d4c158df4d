// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Every Verilated model is compiled with this header. The model then prints its messages to
// standard error, because standard output carries data. A failing assertion throws
// mb4::sim::ModelStopped and does not end the process.
#ifndef MB4_SIM_MODEL_VERILATED_HOOKS_H_
#define MB4_SIM_MODEL_VERILATED_HOOKS_H_

// Included by path, so that any library with Verilated models can use it without an include
// directory.
#include "../include/mb4sim/model_stopped.hpp"

// Replaces printf inside Verilator's runtime ($display, assertion texts).
int mb4sim_vl_printf(const char* format, ...) __attribute__((format(printf, 1, 2)));

namespace mb4sim {
using mb4::sim::ModelStopped;
}  // namespace mb4sim

#endif  // MB4_SIM_MODEL_VERILATED_HOOKS_H_
