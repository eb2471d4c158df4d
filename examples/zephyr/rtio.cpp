// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Steps of the driver by Zephyr's RTIO: the frames of a step are one chain of submissions, and a
// callback behind them takes what came back and submits the next step. Nothing blocks.
//
// This file is compiled against stand-ins of Zephyr's headers, and a test runs it on them. It has
// not run on Zephyr.
//
// Each submission must be a frame of its own: the RTIO device of the SPI controller releases chip
// select after it. Opcode 0x03 needs SCLK of 5 MHz or less (I204): `read_device` is the same chip
// with that rate. A step that begins after a pause is given to a k_timer by `pause`.

#include <zephyr/rtio/rtio.h>

#include <cstdint>

#include "mb4/mb4.hpp"

namespace mb4_rtio {

struct Context {
  rtio* queue;
  const rtio_iodev* device;
  const rtio_iodev* read_device;
  std::uint32_t (*now_us)();
  // Calls submit() again after `us`; from a k_timer.
  void (*pause)(Context& context, std::uint32_t us);
  // Takes what came back: true when the work has ended. `owner` is the program's.
  bool (*finish)(void* owner, bool transferred, std::uint32_t now_us);
  // The work has ended.
  void (*ended)(void* owner);
  void* owner;
  mb4::Steps* steps;
};

void begin(Context& context);

// RTIO stops a chain at its first error, and then calls no callback that belongs to it: the owner's
// watchdog calls this with transferred = false.
void finish(Context& context, bool transferred) {
  if (context.finish(context.owner, transferred, context.now_us())) {
    context.ended(context.owner);
  } else {
    begin(context);
  }
}

// One chain. False: the queue has no room, and nothing was submitted.
bool submit(Context& context) {
  mb4::Steps& steps = *context.steps;
  for (std::size_t i = 0; i < steps.frames(); ++i) {
    rtio_sqe* entry = rtio_sqe_acquire(context.queue);
    if (entry == nullptr) {
      rtio_sqe_drop_all(context.queue);
      return false;
    }
    const mb4::Span<const std::uint8_t> tx = steps.tx(i);
    const mb4::Span<std::uint8_t> rx = steps.rx(i);
    const rtio_iodev* device = mb4::needs_read_sclk(tx) ? context.read_device : context.device;
    const std::uint32_t size = static_cast<std::uint32_t>(tx.size());
    if (rx.empty()) {
      rtio_sqe_prep_write(entry, device, RTIO_PRIO_NORM, tx.data(), size, nullptr);
    } else {
      rtio_sqe_prep_transceive(entry, device, RTIO_PRIO_NORM, tx.data(), rx.data(), size, nullptr);
    }
    entry->flags = static_cast<std::uint16_t>(entry->flags | RTIO_SQE_CHAINED);
  }
  rtio_sqe* last = rtio_sqe_acquire(context.queue);
  if (last == nullptr) {
    rtio_sqe_drop_all(context.queue);
    return false;
  }
  rtio_sqe_prep_callback(
      last,
      [](rtio*, const rtio_sqe*, void* argument) {
        finish(*static_cast<Context*>(argument), true);
      },
      &context, nullptr);
  return rtio_submit(context.queue, 0) == 0;
}

// Begins what has been planned: Operation, CyclicRead or FrameRead.
void begin(Context& context) {
  if (context.steps->pause_us() != 0) {
    context.pause(context, context.steps->pause_us());
  } else if (!submit(context)) {
    finish(context, false);
  }
}

}  // namespace mb4_rtio
