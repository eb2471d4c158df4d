/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * As much of Zephyr's rtio/rtio.h (Zephyr 3.7 documentation, "Real Time I/O") as the example uses;
 * names and parameters as in Zephyr. */
#ifndef ZEPHYR_RTIO_RTIO_H_
#define ZEPHYR_RTIO_RTIO_H_

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define RTIO_PRIO_NORM 127U
#define RTIO_SQE_CHAINED (1U << 1)

struct rtio {
  const void* private_data;
};
struct rtio_iodev {
  const void* private_data;
};
struct rtio_sqe {
  uint8_t prio;
  uint16_t flags;
  const struct rtio_iodev* iodev;
  void* userdata;
};
typedef void (*rtio_callback_t)(struct rtio* r, const struct rtio_sqe* sqe, void* arg0);

struct rtio_sqe* rtio_sqe_acquire(struct rtio* r);
void rtio_sqe_drop_all(struct rtio* r);
void rtio_sqe_prep_transceive(struct rtio_sqe* sqe, const struct rtio_iodev* iodev, int8_t prio,
                              const uint8_t* tx_buf, uint8_t* rx_buf, uint32_t buf_len,
                              void* userdata);
void rtio_sqe_prep_write(struct rtio_sqe* sqe, const struct rtio_iodev* iodev, int8_t prio,
                         const uint8_t* buf, uint32_t len, void* userdata);
void rtio_sqe_prep_callback(struct rtio_sqe* sqe, rtio_callback_t callback, void* arg0,
                            void* userdata);
int rtio_submit(struct rtio* r, uint32_t wait_count);

#ifdef __cplusplus
}
#endif

#endif
