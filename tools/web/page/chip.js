// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The session of native/openmb4_web.cpp. A call that fails throws an Error with its words.
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

  // A row of `mb4sim run --csv`: the words of the encoder are in the order of columns().
  static row(line) {
    const quoted = line.endsWith('"');
    const end = quoted ? line.indexOf(',"') : line.lastIndexOf(",");
    const state = quoted ? line.slice(end + 2, -1) : line.slice(end + 1);
    const [, us, slave, ...words] = line.slice(0, end).split(",");
    return {us, slave, words, state, good: /^ok\b/.test(state)};
  }

  version() { return this.text("web_version"); }
  presets() { return JSON.parse(this.text("web_presets")); }
  columns() { return JSON.parse(this.text("web_columns")); }
  // Why a master cannot read an encoder; "" if it can.
  refuses(master, encoder) { return this.text("web_refuses", ["string", "string"], [master, encoder]); }
  frequencies(clkHz) { return JSON.parse(this.text("web_frequencies", ["number"], [clkHz])); }
  open(scenario) { this.must("web_open", ["string"], [scenario]); }
  configure() { this.must("web_configure"); }
  advance(ns) { this.must("web_advance_ns", ["number"], [ns]); }
  inject(toml) { this.must("web_inject", ["string"], [toml]); }
  report() { return JSON.parse(this.text("web_report")); }
  record(on) { this.module._web_record(on ? 1 : 0); }
  setPin(name, level) { this.must("web_set_pin", ["string", "number"], [name, level]); }
  pin(name) { return this.module.ccall("web_pin", "number", ["string"], [name]); }
  get timePs() { return this.number("web_time_ps"); }
  get timeNs() { return Math.floor(this.timePs / 1000); }
  get clocks() { return this.number("web_clk_cycles"); }

  // Frames: of each a row for each slave.
  read(count = 1) {
    const {error, rows} = JSON.parse(this.text("web_read", ["number"], [count]));
    if (error !== "") throw new Error(error);
    return rows.map((frame) => frame.map(Chip.row));
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

  // A word of a master on a bus of words.
  readWord(address) {
    const {module} = this;
    const memory = module._malloc(4);
    try {
      this.must("web_word_read", ["number", "number"], [address, memory]);
      return module.HEAPU32[memory >> 2];
    } finally {
      module._free(memory);
    }
  }

  writeWord(address, value) { this.must("web_word_write", ["number", "number"], [address, value]); }

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
