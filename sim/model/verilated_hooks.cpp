// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "verilated_hooks.h"

#include <cstdarg>
#include <cstdio>

int mb4sim_vl_printf(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  const int written = std::vfprintf(stderr, format, arguments);
  va_end(arguments);
  return written;
}

namespace mb4::sim {

ModelStopped::ModelStopped(const char* file, int line, const char* hierarchy)
    : std::runtime_error(std::string(file) + ":" + std::to_string(line) + ": assertion failed" +
                         (*hierarchy != '\0' ? std::string(" in ") + hierarchy : "")) {}

}  // namespace mb4::sim

// Declared by verilated.h. VL_USER_STOP is set, so Verilator calls it for $stop and for failing
// assertions.
void vl_stop(const char* filename, int linenum, const char* hier) {
  throw mb4::sim::ModelStopped(filename, linenum, hier);
}
