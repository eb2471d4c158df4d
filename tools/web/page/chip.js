// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The simulator and the driver of native/openmb4_web.cpp. A call that fails throws an Error with
// the words of the C interface.
"use strict";

// Base64 of a gzip file.
async function unpack(text) {
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

class Chip {
  static async load(wasm) {
    return new Chip(await openmb4({wasmBinary: await unpack(wasm)}));
  }

  constructor(module) {
    this.module = module;
  }

  text(name, types = [], values = []) {
    return this.module.ccall(name, "string", types, values);
  }

  number(name) {
    return this.module.ccall(name, "number", [], []);
  }

  // Calls what returns "" or an error.
  must(...call) {
    const error = this.text(...call);
    if (error !== "") throw new Error(error);
  }

  version() { return this.text("web_version"); }
  presets() { return JSON.parse(this.text("web_presets")); }
  frequencies(clkHz) { return JSON.parse(this.text("web_frequencies", ["number"], [clkHz])); }
  open(scenario) { this.must("web_open", ["string"], [scenario]); }
  configure() { this.must("web_configure"); }
  advance(ns) { this.must("web_advance_ns", ["number"], [ns]); }
  inject(toml) { this.must("web_inject", ["string"], [toml]); }
  report() { return JSON.parse(this.text("web_report")); }
  record(on) { this.module._web_record(on ? 1 : 0); }
  setPin(name, level) { this.must("web_set_pin", ["string", "number"], [name, level]); }
  pin(name) { return this.module.ccall("web_pin", "number", ["string"], [name]); }
  get timeNs() { return this.number("web_time_ns"); }
  get clocks() { return this.number("web_clk_cycles"); }

  // Frames of all slaves; the rows that web_read() tells.
  read(count = 1) {
    const {error, rows} = JSON.parse(this.text("web_read", ["number"], [count]));
    if (error !== "") throw new Error(error);
    return rows;
  }

  // One SPI frame. Returns the chip's bytes.
  spi(bytes) {
    const {module} = this;
    const memory = module._malloc(Math.max(bytes.length, 1));
    module.HEAPU8.set(bytes, memory);
    try {
      this.must("web_spi", ["number", "number"], [memory, bytes.length]);
      return module.HEAPU8.slice(memory, memory + bytes.length);
    } finally {
      module._free(memory);
    }
  }

  // Edges and frames since the last call: [{time, place, level}] of channel 1, and web_frames().
  taken() {
    const count = this.number("web_edge_count");
    const first = this.number("web_edges");
    const numbers = new Float64Array(this.module.HEAPU8.buffer, first, 4 * count);
    const edges = [];
    for (let i = 0; i < numbers.length; i += 4) {
      if (numbers[i + 1] === 1) {
        edges.push({time: numbers[i], place: numbers[i + 2], level: numbers[i + 3]});
      }
    }
    return {edges, frames: JSON.parse(this.text("web_frames"))};
  }
}
