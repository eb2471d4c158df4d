// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Every call of Device, Automatic, Control and the scan. Device, configuration and arguments come
// from elsewhere, so that the compiler knows nothing of them in advance.

#ifndef MB4_TESTS_DRIVER_FOOTPRINT_WHOLE_HPP_
#define MB4_TESTS_DRIVER_FOOTPRINT_WHOLE_HPP_

#include "board.hpp"

struct Work {
  const mb4::Config& config;
  mb4::Frame& frame;
  mb4::Command command;
  mb4::SlaveAddress address;
  mb4::Span<std::uint8_t> bytes;
  mb4::Span<mb4::SlaveIdentity> identities;
  mb4::PositionTracker& tracker;
  mb4::Operation& operation;
  mb4::FrameRead& read;
  std::uint64_t word;
  std::uint32_t hz_or_ns;
  std::uint8_t slave;
};

template <typename Device>
[[gnu::noinline]] bool plan_all(Device& device, Work& work) {
  auto automatic = device.automatic();
  auto control = device.control();
  mb4::Operation& op = work.operation;
  return device.plan_configure(op, work.config) && device.plan_verify(op) &&
         device.plan_initialize(op) && device.plan_read_all(op, work.read) &&
         device.plan_actuator(op, work.slave, work.word) && device.plan_break(op) &&
         automatic.plan_start(op) && automatic.plan_stop(op) && automatic.plan_restart(op) &&
         automatic.plan_actuator(op, work.slave, work.word) && automatic.plan(work.read) &&
         control.plan_read(op, work.address, work.slave, work.bytes) &&
         control.plan_write(op, work.address, work.slave, work.bytes) &&
         control.plan_command(op, work.command) && control.plan_activate(op) &&
         automatic.finish(work.read, true, work.hz_or_ns) &&
         device.finish(op, true, work.hz_or_ns) && work.read.result(work.frame) && op.result();
}

template <typename Device>
[[gnu::noinline]] bool call_all(Device& device, Work& work) {
  auto automatic = device.automatic();
  auto control = device.control();
  bool good = device.probe() && device.reset() && device.configure(work.config) &&
              device.verify() && device.read_all(work.frame) && device.read_status() &&
              device.clear_valid(work.slave) && device.break_transmission() &&
              device.write_actuator(work.slave, work.word);
  if (const mb4::Result<mb4::LineDelay> delay = device.initialize(); delay) {
    work.hz_or_ns = mb4::line_delay_ns(device.config(), delay->quarters[0]);
  }
  good = good && device.read_frame(work.slave) && automatic.start() && automatic.next(work.frame) &&
         automatic.poll(work.frame) && automatic.write_actuator(work.slave, work.word) &&
         automatic.restart() && automatic.stop();
  if (const mb4::Result<mb4::Reading> reading = automatic.poll_slave(work.slave); reading) {
    good = good && work.tracker.update(reading->position);
  }
  good = good && mb4::scan_bus(device, work.slave, work.identities) && control.send(work.command) &&
         control.read_registers(work.address, work.slave, work.bytes) &&
         control.write_registers(work.address, work.slave, work.bytes) &&
         control.activate(work.slave) && control.abort() && plan_all(device, work);
  work.hz_or_ns = mb4::ma_hz_at_most(work.config.f_clk_hz, work.hz_or_ns);
  return good;
}

#endif  // MB4_TESTS_DRIVER_FOOTPRINT_WHOLE_HPP_
