// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The whole driver: every call of Device, Automatic, Control and the scan. Device, configuration
// and arguments come from elsewhere, so that the compiler knows nothing of them in advance.

#include "board.hpp"

struct Work {
  const mb4::Config& config;
  mb4::Frame& frame;
  mb4::Command command;
  mb4::SlaveAddress address;
  mb4::Span<std::uint8_t> bytes;
  mb4::Span<mb4::SlaveIdentity> identities;
  mb4::PositionTracker& tracker;
  std::uint64_t word;
  std::uint32_t hz_or_ns;
  std::uint8_t slave;
};

extern "C" bool firmware(BoardDevice& device, Work& work) {
  mb4::Automatic<BoardBus, BoardClock> automatic = device.automatic();
  mb4::Control<BoardBus, BoardClock> control = device.control();
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
         control.begin_read(work.address, work.slave, work.bytes.size()) && control.poll() &&
         control.take(work.bytes) && control.begin_write(work.address, work.slave, work.bytes) &&
         control.begin_command(work.command) && control.abort();
  work.hz_or_ns = mb4::ma_hz_at_most(work.config.f_clk_hz, work.hz_or_ns);
  return good;
}
