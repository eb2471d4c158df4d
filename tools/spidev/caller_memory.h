/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Accesses the program's memory as the kernel does: a bad pointer gives an error and no crash.
 */
#ifndef MB4_TOOLS_SPIDEV_CALLER_MEMORY_H_
#define MB4_TOOLS_SPIDEV_CALLER_MEMORY_H_

#include <stddef.h>

/* As many bytes as can be read from, or written to, the program's memory. errno stays. */
size_t read_caller(void *to, const void *caller, size_t size);
size_t write_caller(void *caller, const void *from, size_t size);

/* All of them: 0, or -1 and EFAULT. */
int get_from_caller(void *to, const void *caller, size_t size);
int give_to_caller(void *caller, const void *from, size_t size);

#endif /* MB4_TOOLS_SPIDEV_CALLER_MEMORY_H_ */
