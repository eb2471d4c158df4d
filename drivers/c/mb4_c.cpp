// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The C binding of mb4.h.

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "enc/snapshot.hpp"
#include "mb4.h"
#include "mb4/mb4.hpp"
#include "mb4/safety.hpp"
#include "mb4_c_access.hpp"
#include "mb4_c_convert.hpp"

namespace {

using mb4_c::bytes;
using mb4_c::from_c;
using mb4_c::store;
using mb4_c::to_c;

struct Opened {
  Opened(mb4_transfer transfer, void* transfer_context, mb4_now_us now_us, void* clock_context)
      : bus(transfer, transfer_context), clock(now_us, clock_context), device(bus, clock) {}

  mb4::FunctionBus bus;
  mb4::FunctionClock clock;
  mb4::Device<mb4::FunctionBus, mb4::FunctionClock> device;
};

static_assert(sizeof(Opened) <= sizeof(mb4_device), "mb4: mb4_device in mb4.h is too small");
static_assert(alignof(Opened) <= alignof(mb4_device));
static_assert(sizeof(mb4::Operation) <= sizeof(mb4_operation));
static_assert(sizeof(mb4::FrameRead) <= sizeof(mb4_frame_read));
static_assert(std::is_trivially_destructible_v<mb4::Operation>);
static_assert(std::is_trivially_destructible_v<mb4::FrameRead>);
static_assert(mb4::Steps::kMaxFrames == MB4_STEP_FRAMES);
static_assert(sizeof(mb4::PositionTracker) <= sizeof(mb4_tracker));
static_assert(std::is_trivially_destructible_v<Opened>);
static_assert(sizeof(mb4::Safety) <= sizeof(mb4_safety));
static_assert(std::is_trivially_destructible_v<mb4::Safety>);
static_assert(sizeof(mb4_safety_verdict) % sizeof(std::uint32_t) == 0);

using Snapshot = enc::detail::SnapshotWords<enc::detail::SharedMemory>;
// The caller's value, of any type.
using Words [[gnu::may_alias]] = std::uint32_t;

mb4::Device<mb4::FunctionBus, mb4::FunctionClock>& of(mb4_device* device) {
  return reinterpret_cast<Opened*>(device->opaque)->device;
}

// The access that the caller polls.
mb4_c::PolledAccess<mb4::FunctionBus, mb4::FunctionClock> access_of(mb4_device* device) {
  return mb4_c::PolledAccess(of(device));
}

mb4::Operation& of(mb4_operation* operation) {
  return *reinterpret_cast<mb4::Operation*>(operation->opaque);
}
const mb4::Operation& of(const mb4_operation* operation) {
  return *reinterpret_cast<const mb4::Operation*>(operation->opaque);
}
mb4::FrameRead& of(mb4_frame_read* read) {
  return *reinterpret_cast<mb4::FrameRead*>(read->opaque);
}

mb4::Safety& of(mb4_safety* safety) { return *reinterpret_cast<mb4::Safety*>(safety->opaque); }

std::size_t frames_of(mb4::Steps& steps, mb4_spi_frame* frames) {
  for (std::size_t i = 0; i < steps.frames(); ++i) {
    const mb4::Span<const std::uint8_t> tx = steps.tx(i);
    const mb4::Span<std::uint8_t> rx = steps.rx(i);
    frames[i] = {tx.data(), rx.empty() ? nullptr : rx.data(), tx.size()};
  }
  return steps.frames();
}

// The memory of an object that the caller provides, never null. A small target may have no header
// <new>, so this file has its own placement operator. It throws nothing, but noexcept would make
// each call ask for a null pointer.
struct Place {
  void* memory;
};

}  // namespace

// NOLINTNEXTLINE(cert-dcl54-cpp): placement into memory that is never deleted
inline void* operator new(std::size_t /*size*/, Place place) { return place.memory; }

extern "C" {

void mb4_open(mb4_device* device, mb4_transfer transfer, void* transfer_context, mb4_now_us now_us,
              void* clock_context) {
  ::new (Place{device->opaque}) Opened(transfer, transfer_context, now_us, clock_context);
}

mb4_config mb4_config_default(void) { return to_c(mb4::Config()); }

uint32_t mb4_ma_hz_at_most(uint32_t f_clk_hz, uint32_t limit_hz) {
  return mb4::ma_hz_at_most(f_clk_hz, limit_hz);
}
uint32_t mb4_frame_period_clk_at_least(uint32_t f_clk_hz, uint32_t period_ns) {
  return mb4::frame_period_clk_at_least(f_clk_hz, period_ns);
}
mb4_result mb4_validate(const mb4_config* config) { return to_c(mb4::validate(from_c(*config))); }

mb4_result mb4_probe(mb4_device* device, uint8_t* version, uint8_t* revision) {
  const mb4::Result<mb4::Identity> identity = of(device).probe();
  if (identity) {
    *version = identity->version;
    *revision = identity->revision;
  }
  return to_c(identity);
}
mb4_result mb4_configure(mb4_device* device, const mb4_config* config) {
  return to_c(of(device).configure(from_c(*config)));
}
mb4_result mb4_verify(mb4_device* device) { return to_c(of(device).verify()); }
mb4_result mb4_reset(mb4_device* device) { return to_c(of(device).reset()); }
mb4_result mb4_initialize(mb4_device* device, uint8_t quarters[MB4_CHANNELS]) {
  const mb4::Result<mb4::LineDelay> delay = of(device).initialize();
  for (std::size_t i = 0; delay && i < mb4::kChannels; ++i) {
    quarters[i] = delay->quarters[i];
  }
  return to_c(delay);
}
mb4_result mb4_read_frame(mb4_device* device, uint8_t slave, mb4_reading* reading) {
  return store(of(device).read_frame(slave), reading);
}
mb4_result mb4_read_all(mb4_device* device, mb4_frame* frame) {
  mb4::Frame read;
  const mb4::Result<void> done = of(device).read_all(read);
  return store(done, read, frame);
}
mb4_result mb4_write_actuator(mb4_device* device, uint8_t slave, uint64_t word) {
  return to_c(of(device).write_actuator(slave, word));
}
mb4_result mb4_break_transmission(mb4_device* device) {
  return to_c(of(device).break_transmission());
}
mb4_result mb4_read_status(mb4_device* device, uint8_t status[MB4_STATUS_BYTES]) {
  const mb4::Result<mb4::Status> read = of(device).read_status();
  for (std::size_t i = 0; read && i < mb4::Status::kBytes; ++i) {
    status[i] = read->bytes()[i];
  }
  return to_c(read);
}
mb4_result mb4_clear_valid(mb4_device* device, uint8_t slave) {
  return to_c(of(device).clear_valid(slave));
}

mb4_result mb4_automatic_start(mb4_device* device) { return to_c(of(device).automatic().start()); }
mb4_result mb4_automatic_stop(mb4_device* device) { return to_c(of(device).automatic().stop()); }
mb4_result mb4_automatic_restart(mb4_device* device) {
  return to_c(of(device).automatic().restart());
}
mb4_result mb4_automatic_poll(mb4_device* device, mb4_frame* frame) {
  mb4::Frame read;
  const mb4::Result<void> done = of(device).automatic().poll(read);
  return store(done, read, frame);
}
mb4_result mb4_automatic_poll_slave(mb4_device* device, uint8_t slave, mb4_reading* reading) {
  return store(of(device).automatic().poll_slave(slave), reading);
}
mb4_result mb4_automatic_write_actuator(mb4_device* device, uint8_t slave, uint64_t word) {
  return to_c(of(device).automatic().write_actuator(slave, word));
}
mb4_result mb4_automatic_next(mb4_device* device, mb4_frame* frame) {
  mb4::Frame read;
  const mb4::Result<void> done = of(device).automatic().next(read);
  return store(done, read, frame);
}

mb4_result mb4_slave_read(mb4_device* device, uint8_t channel, uint8_t id, uint8_t address,
                          uint8_t* data, size_t size) {
  return to_c(of(device).control().read_registers({channel, id}, address, bytes(data, size)));
}
mb4_result mb4_slave_write(mb4_device* device, uint8_t channel, uint8_t id, uint8_t address,
                           const uint8_t* data, size_t size) {
  return to_c(of(device).control().write_registers({channel, id}, address, bytes(data, size)));
}
mb4_result mb4_slave_command(mb4_device* device, const mb4_command* command) {
  return to_c(of(device).control().send(from_c(*command)));
}
mb4_result mb4_slave_activate(mb4_device* device, uint8_t ids, uint8_t ids_2) {
  return to_c(of(device).control().activate(ids, ids_2));
}
mb4_result mb4_slave_begin_read(mb4_device* device, uint8_t channel, uint8_t id, uint8_t address,
                                size_t size) {
  return to_c(access_of(device).begin_read({channel, id}, address, size));
}
mb4_result mb4_slave_begin_write(mb4_device* device, uint8_t channel, uint8_t id, uint8_t address,
                                 const uint8_t* data, size_t size) {
  return to_c(access_of(device).begin_write({channel, id}, address, bytes(data, size)));
}
mb4_result mb4_slave_begin_command(mb4_device* device, const mb4_command* command) {
  return to_c(access_of(device).begin_command(from_c(*command)));
}
mb4_result mb4_slave_poll(mb4_device* device, bool* ended) {
  const mb4::Result<bool> result = access_of(device).poll();
  *ended = result.value_or(false);
  return to_c(result);
}
mb4_result mb4_slave_take(mb4_device* device, uint8_t* data, size_t size) {
  return to_c(access_of(device).take(bytes(data, size)));
}
mb4_result mb4_slave_abort(mb4_device* device) { return to_c(of(device).control().abort()); }

void mb4_operation_begin(mb4_operation* operation) {
  ::new (Place{operation->opaque}) mb4::Operation();
}
void mb4_frame_read_begin(mb4_frame_read* read) { ::new (Place{read->opaque}) mb4::FrameRead(); }

mb4_result mb4_plan_configure(mb4_device* device, mb4_operation* operation,
                              const mb4_config* config) {
  return to_c(of(device).plan_configure(of(operation), from_c(*config)));
}
mb4_result mb4_plan_verify(mb4_device* device, mb4_operation* operation) {
  return to_c(of(device).plan_verify(of(operation)));
}
mb4_result mb4_plan_initialize(mb4_device* device, mb4_operation* operation) {
  return to_c(of(device).plan_initialize(of(operation)));
}
mb4_result mb4_plan_read_all(mb4_device* device, mb4_operation* operation, mb4_frame_read* read) {
  return to_c(of(device).plan_read_all(of(operation), of(read)));
}
mb4_result mb4_plan_actuator(mb4_device* device, mb4_operation* operation, uint8_t slave,
                             uint64_t word) {
  return to_c(of(device).plan_actuator(of(operation), slave, word));
}
mb4_result mb4_plan_break(mb4_device* device, mb4_operation* operation) {
  return to_c(of(device).plan_break(of(operation)));
}
mb4_result mb4_plan_start(mb4_device* device, mb4_operation* operation) {
  return to_c(of(device).automatic().plan_start(of(operation)));
}
mb4_result mb4_plan_stop(mb4_device* device, mb4_operation* operation) {
  return to_c(of(device).automatic().plan_stop(of(operation)));
}
mb4_result mb4_plan_restart(mb4_device* device, mb4_operation* operation) {
  return to_c(of(device).automatic().plan_restart(of(operation)));
}
mb4_result mb4_plan_automatic_actuator(mb4_device* device, mb4_operation* operation, uint8_t slave,
                                       uint64_t word) {
  return to_c(of(device).automatic().plan_actuator(of(operation), slave, word));
}
mb4_result mb4_plan_slave_read(mb4_device* device, mb4_operation* operation, uint8_t channel,
                               uint8_t id, uint8_t address, uint8_t* data, size_t size) {
  return to_c(
      of(device).control().plan_read(of(operation), {channel, id}, address, bytes(data, size)));
}
mb4_result mb4_plan_slave_write(mb4_device* device, mb4_operation* operation, uint8_t channel,
                                uint8_t id, uint8_t address, const uint8_t* data, size_t size) {
  return to_c(
      of(device).control().plan_write(of(operation), {channel, id}, address, bytes(data, size)));
}
mb4_result mb4_plan_slave_command(mb4_device* device, mb4_operation* operation,
                                  const mb4_command* command) {
  return to_c(of(device).control().plan_command(of(operation), from_c(*command)));
}

mb4_result mb4_plan_slave_activate(mb4_device* device, mb4_operation* operation, uint8_t ids,
                                   uint8_t ids_2) {
  return to_c(of(device).control().plan_activate(of(operation), ids, ids_2));
}

size_t mb4_operation_frames(mb4_operation* operation, mb4_spi_frame* frames, uint32_t* pause_us) {
  *pause_us = of(operation).pause_us();
  return frames_of(of(operation), frames);
}
bool mb4_finish(mb4_device* device, mb4_operation* operation, bool transferred, uint32_t now_us) {
  return of(device).finish(of(operation), transferred, now_us);
}
mb4_result mb4_operation_result(const mb4_operation* operation) {
  return to_c(of(operation).result());
}
void mb4_operation_line_delay(const mb4_operation* operation, uint8_t quarters[MB4_CHANNELS]) {
  for (std::size_t i = 0; i < mb4::kChannels; ++i) {
    quarters[i] = of(operation).line_delay().quarters[i];
  }
}

mb4_result mb4_plan_frame(mb4_device* device, mb4_frame_read* read, bool wide) {
  return to_c(of(device).automatic().plan(of(read), wide));
}
size_t mb4_frame_read_frames(mb4_frame_read* read, mb4_spi_frame* frames) {
  return frames_of(of(read), frames);
}
bool mb4_finish_frame(mb4_device* device, mb4_frame_read* read, bool transferred, uint32_t now_us) {
  return of(device).automatic().finish(of(read), transferred, now_us);
}
mb4_result mb4_frame_read_result(const mb4_frame_read* read, mb4_frame* frame) {
  mb4::Frame out;
  const mb4::Result<void> done = reinterpret_cast<const mb4::FrameRead*>(read->opaque)->result(out);
  return store(done, out, frame);
}

mb4_safety_config mb4_bp3_safety(uint8_t control_bits, uint8_t safety_bits, uint16_t control_start,
                                 uint16_t safety_start) {
  return to_c(mb4::bp3_safety(control_bits, safety_bits, control_start, safety_start));
}
mb4_result mb4_safety_fits(const mb4_config* config, uint8_t control, uint8_t safety,
                           const mb4_safety_config* words) {
  return to_c(mb4::safety_fits(from_c(*config), control, safety, from_c(*words)));
}
mb4_result mb4_safety_configure(mb4_safety* safety, const mb4_safety_config* words) {
  auto* check = ::new (Place{safety->opaque}) mb4::Safety;
  const mb4::SafetyField wrong = check->configure(from_c(*words));
  const bool good = wrong == mb4::SafetyField::kNone;
  return {static_cast<std::uint8_t>(good ? MB4_OK : MB4_INVALID_ARGUMENT), 0,
          static_cast<std::uint8_t>(wrong), 0};
}
void mb4_safety_restart(mb4_safety* safety) { of(safety).restart(); }
void mb4_safety_check(mb4_safety* safety, const mb4_frame* frame, uint8_t control_slave,
                      uint8_t safety_slave, uint32_t frames, mb4_safety_verdict* verdict) {
  const mb4::SafetyVerdict found = of(safety).check(
      {mb4_c::safety_word(frame, control_slave), mb4_c::safety_word(frame, safety_slave),
       frame == nullptr || frame->one_frame},
      frames);
  *verdict = {found.position, found.safety_position, found.checks_failed, found.life,
              found.warning};
}
const char* mb4_safety_text(uint8_t check) {
  return enc::to_string(static_cast<mb4::SafetyCheck>(check));
}

void mb4_snapshot_write(uint32_t* snapshot, const void* value, size_t size) {
  Snapshot::write(snapshot, static_cast<const Words*>(value), size / sizeof(std::uint32_t));
}
bool mb4_snapshot_read(const uint32_t* snapshot, void* value, size_t size) {
  if (!Snapshot::is_written(snapshot)) {
    return false;
  }
  while (!Snapshot::try_read(snapshot, static_cast<Words*>(value), size / sizeof(std::uint32_t))) {
  }
  return true;
}
uint32_t mb4_snapshot_writes(const uint32_t* snapshot) { return Snapshot::writes(snapshot); }

mb4_result mb4_scan(mb4_device* device, uint8_t channel, mb4_identity* identities, size_t size,
                    uint8_t* count) {
  std::array<mb4::SlaveIdentity, mb4::kSlaveIds> found{};
  const mb4::Result<std::uint8_t> result = mb4::scan_bus(of(device), channel, found);
  *count = result.value_or(0);
  for (std::size_t i = 0; i < *count && i < size; ++i) {
    const mb4::SlaveIdentity& from = found[i];
    mb4_identity& to = identities[i];
    for (std::size_t byte = 0; byte < from.device_id.size(); ++byte) {
      to.device_id[byte] = from.device_id[byte];
    }
    for (std::size_t byte = 0; byte < from.manufacturer.size(); ++byte) {
      to.manufacturer[byte] = from.manufacturer[byte];
    }
    to.eds_bank = from.eds_bank;
    to.has_identity = from.has_identity;
    to.has_eds = from.has_eds;
  }
  return to_c(result);
}

mb4_result mb4_write_registers(mb4_device* device, uint8_t address, const uint8_t* data,
                               size_t size) {
  return to_c(of(device).opcodes().write_registers(address, bytes(data, size)));
}
mb4_result mb4_read_registers(mb4_device* device, uint8_t address, uint8_t* data, size_t size) {
  return to_c(of(device).opcodes().read_registers(address, bytes(data, size)));
}

const char* mb4_error_text(uint8_t code) { return mb4::to_string(static_cast<mb4::Error>(code)); }
const char* mb4_field_text(uint8_t field) {
  return mb4::to_string(static_cast<mb4::ConfigField>(field));
}

int64_t mb4_to_signed(uint64_t position, uint8_t bits) { return mb4::to_signed(position, bits); }
uint64_t mb4_gray_to_binary(uint64_t gray) { return mb4::gray_to_binary(gray); }
uint64_t mb4_binary_to_gray(uint64_t binary) { return mb4::binary_to_gray(binary); }
mb4_result mb4_split_turns(uint64_t position, uint8_t multi_bits, uint8_t single_bits,
                           uint64_t* multi, uint64_t* single) {
  const mb4::Result<mb4::Turns> turns = mb4::split_turns(position, multi_bits, single_bits);
  if (turns) {
    *multi = turns->multi;
    *single = turns->single;
  }
  return to_c(turns);
}

void mb4_tracker_begin(mb4_tracker* tracker, uint8_t bits, uint64_t max_step) {
  ::new (Place{tracker->opaque}) mb4::PositionTracker(bits, max_step);
}
mb4_result mb4_tracker_update(mb4_tracker* tracker, uint64_t position, int64_t* total) {
  const mb4::Result<std::int64_t> result =
      reinterpret_cast<mb4::PositionTracker*>(tracker->opaque)->update(position);
  if (result) {
    *total = *result;
  }
  return to_c(result);
}

}  // extern "C"
