/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* What pm_bissc_test.cpp calls of pm_bissc_program.c. */

#ifndef PM_BISSC_PROGRAM_H_
#define PM_BISSC_PROGRAM_H_

#include <stdint.h>

#define PM_BISSC_WAIT() pm_bissc_program_wait()

#ifdef __cplusplus
extern "C" {
#endif

void pm_bissc_program_wait(void); /* supplied by the test: time passes, and the interrupt comes */

#include "pm_bissc_include.h"

extern PM_bissc_scdStruct scd;
extern PM_bissc_cdStruct cd;
extern PM_bissc_registerStruct reg;
extern PM_bissc_encoderStruct encoder;

void program_begin(uint16_t mt_bits, uint16_t st_bits, uint16_t crc_bits, uint16_t crc_poly,
                   uint16_t crc_start, uint32_t div);
uint16_t program_frame(uint32_t div);
/* Frames until the access has ended; its status. PM_BISSC_FAIL after 200 frames. */
uint16_t program_access(enum cdRegisterAccessType type, uint16_t address, uint16_t data,
                        uint32_t div);
/* Uses what the others do not; 0. */
int program_rest(void);

#ifdef __cplusplus
}
#endif

#endif /* PM_BISSC_PROGRAM_H_ */
