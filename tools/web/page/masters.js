// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The masters of the page, by `type` of a scenario: their clock, what they make of it, and their
// registers. The first is the one of a link that names none.
"use strict";

const MHZ = 1e6;
const MASTERS = {
  "ic-mb4": {
    name: "iC-MB4", clkHz: 20 * MHZ, sclkHz: 10 * MHZ,
    maHz: null,  // those that the chip makes
    Bus: SpiBus, table: "mb4", last: 0xFF, register: "INSTR", value: "0x08",
    // What one SPI frame reads, 64 bytes at most.
    groups: [
      {title: "Status and instruction", first: 0xF0, size: 12, without: [0xF5, 0xF5]},
      {title: "Configuration", first: 0xE2, size: 20, without: [0xF0, 0xF4]},
      {title: "Data channels", first: 0xC0, size: 32},
      {title: "Single-cycle data", first: 0x00, size: 64},
      {title: "Register data", first: 0x80, size: 64}]},
  axi: {
    name: "biss_axi", clkHz: 100 * MHZ, maHz: [10, 5, 2.5, 2, 1, 0.5, 0.25, 0.2].map((mhz) => mhz * MHZ),
    Bus: AxiBus, table: "axi", last: 0x3C, register: "REQUEST", value: "1",
    groups: [{title: "All registers", first: 0x00, size: 0x40}]},
  clb: {
    name: "biss_clb", clkHz: 200 * MHZ, maHz: [10, 8, 5, 4, 2, 1, 0.5, 0.25, 0.1].map((mhz) => mhz * MHZ),
    Bus: AxiBus, table: "clb", last: 0x220, register: "WATCHDOG", value: "0",
    groups: [
      {title: "Clock tile", first: 0x000, size: 0x48},
      {title: "FSM tile", first: 0x084, size: 0x48},
      {title: "SPI", first: 0x100, size: 0x0C},
      {title: "Interrupts, time, watchdog", first: 0x200, size: 0x24}]},
  pru: {
    name: "biss_pru", clkHz: 200 * MHZ, maHz: [10, 5, 2, 1].map((mhz) => mhz * MHZ),
    periodNs: 100_000,  // it makes frames by itself
    Bus: AxiBus, table: "pru", last: 0x238, register: "TRIGGER_PERIOD", value: "20000",
    groups: [
      {title: "Memory of the firmware", first: 0x000, size: 0x20},
      {title: "Interrupts, time, trigger", first: 0x200, size: 0x3C}]},
};
