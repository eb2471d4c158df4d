/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Finds the function that a preloaded function hides.
 */
#ifndef MB4_TOOLS_SPIDEV_NEXT_FUNCTION_H_
#define MB4_TOOLS_SPIDEV_NEXT_FUNCTION_H_

#define EXPORT __attribute__((visibility("default")))

/* The next library's function of this name and type; looked for once. */
#define NEXT(name)                                             \
  (__extension__({                                             \
    static __typeof__(&name) next;                             \
    if (!next) next = (__typeof__(&name))next_function(#name); \
    next;                                                      \
  }))

/* Ends the program if there is none. */
void *next_function(const char *name);

#endif /* MB4_TOOLS_SPIDEV_NEXT_FUNCTION_H_ */
