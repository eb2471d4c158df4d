/* SPDX-FileCopyrightText: 2026 The openmb4 authors */
/* SPDX-License-Identifier: Apache-2.0 */

/* The C calls of the hello-fpga BiSS-C master manual (2.5), with its names and arguments, for
 * biss_axi. They return 0 for success, BISS_C_ARGUMENT for a wrong argument (nothing was written),
 * BISS_C_BUS for an access that failed. `hdev` is any number; the calls hand it to the functions
 * below, which the program supplies. Calls for the same hdev must not run at the same time. */

#ifndef BISS_C_H_
#define BISS_C_H_

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define BISS_C_ARGUMENT 1
#define BISS_C_BUS 2
#define BISS_C_SLAVE_ERROR 3
#define BISS_C_CRC 4

/* Supplied by the program: one access of 32 bits at a byte offset of the master, 0 for success;
 * microseconds, counting up and wrapping at 2^32; the frequency of axi_aclk in hertz, not 0. */
int biss_c_port_write(int hdev, uint32_t offset, uint32_t value);
int biss_c_port_read(int hdev, uint32_t offset, uint32_t *value);
uint32_t biss_c_port_now_us(int hdev);
uint32_t biss_c_port_clk_hz(int hdev);

/* Ends what runs and clears all results. Single-point mode, CRC checked, MA 10 MHz or the next
 * lower frequency that is possible, 32 bits, channel 0. */
int BISS_C_Init(int hdev);
/* ignoreCRC: 1 = words are delivered whatever their CRC is, 0 = the CRC is checked. */
int BISS_C_IgnoreCRC(int hdev, int ignoreCRC);
/* Round trip from MA to SLO of the channel's last frame in clocks, 0 to 1023 (no acknowledge). */
int BISS_C_CheckAjustDelay(int hdev, int channelIndex, int *maSloDelayTicks);
/* Sample-clock mode with f_aclk / (2 * highlowTicksNum), 1 to 268435455, or with pin
 * ext_sample_clk. */
int BISS_C_ConfigSampleClk(int hdev, int highlowTicksNum, bool isExtSampleClk);
/* MA is f_aclk / (2 * highlowTicksNum), 1 to 255. */
int BISS_C_ConfigMAClk(int hdev, int highlowTicksNum);
/* Bits of the position, 1 to 32. */
int BISS_C_ConfigPositionDatabits(int hdev, int bitsNum);
/* Bit c enables channel c: 0x03 enables channels 0 and 1. */
int BISS_C_ConfigChannels(int hdev, int channelEnable);
/* One frame in single-point mode, which the call chooses, and the word of one channel. 0 with
 * *isValid = false: no good word came; *data is then 0. BISS_C_SLAVE_ERROR: it came, and its nE is
 * 0, so that its position is not to be trusted; *isValid is false, *data is what the encoder has
 * sent. BISS_C_CRC: nE and nW do not follow from the word and register 0x30; *data is 0. Waits for
 * at most one frame with the longest processing time and 40 us. */
int BISS_C_ReadSinglePoint(int hdev, int channelIndex, unsigned int *data, bool *isValid);

#ifdef __cplusplus
}
#endif

#endif /* BISS_C_H_ */
