// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The timing diagram of one frame of channel 1.
"use strict";

// MB4SIM_EDGE_..., from the top.
const ROWS = [{place: 0, name: "MA", y: 36}, {place: 2, name: "SL", y: 104},
              {place: 3, name: "SLO", y: 154}];
const SWING = 26, BRACKET = 92, LEFT = 46, TOP = 28, BOTTOM = 188, HEIGHT = 214;

// Steps of the time axis: 1, 2, 5 times a power of ten; the smallest that leaves room for labels.
function niceStep(span, places) {
  const rough = span / places;
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((factor) => factor * power).find((step) => step >= rough);
}

class Diagram {
  constructor(canvas) {
    this.canvas = canvas;
    this.picture = null;
    this.until = Infinity;
    new ResizeObserver(() => this.draw()).observe(canvas.parentElement);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
  }

  // `picture`: edges in order, from and to in ns, brackets [{from, to, text}] on SL.
  show(picture, until = Infinity) {
    this.picture = picture;
    this.until = until;
    this.draw();
  }

  draw() {
    const {canvas, picture} = this;
    const width = canvas.parentElement.clientWidth;
    const scale = devicePixelRatio || 1;
    canvas.width = Math.round(width * scale);
    canvas.height = Math.round(HEIGHT * scale);
    canvas.style.height = `${HEIGHT}px`;
    const context = canvas.getContext("2d");
    context.scale(scale, scale);
    const style = getComputedStyle(canvas);
    const colour = (name) => style.getPropertyValue(name).trim();
    context.font = "13px system-ui, sans-serif";
    context.textBaseline = "middle";
    context.fillStyle = colour("--text");
    for (const row of ROWS) context.fillText(row.name, 4, row.y + SWING / 2);
    if (picture === null) return;
    const right = width - 8;
    const x = (time) => LEFT + (time - picture.from) / (picture.to - picture.from) * (right - LEFT);
    const end = Math.min(picture.to, this.until);

    const step = niceStep(picture.to - picture.from, (right - LEFT) / 70);
    context.textAlign = "center";
    for (let at = 0; at <= picture.to - picture.zero; at += step) {
      const px = x(picture.zero + at);
      if (px < LEFT) continue;
      context.fillStyle = colour("--faint");
      context.fillRect(Math.round(px), TOP, 1, BOTTOM - TOP);
      context.fillStyle = colour("--quiet");
      const last = at + step > picture.to - picture.zero;
      context.fillText(`${+(at / 1000).toFixed(3)}${last ? " µs" : ""}`, Math.min(px, right - 18), BOTTOM + 14);
    }

    context.lineWidth = 1.5;
    context.lineJoin = "round";
    ROWS.forEach((row, i) => {
      const y = (level) => row.y + (level ? 0 : SWING);
      let level = picture.before[row.place];
      context.strokeStyle = colour(`--row${i}`);
      context.beginPath();
      context.moveTo(LEFT, y(level));
      for (const edge of picture.edges) {
        if (edge.place !== row.place || edge.time > end) continue;
        if (edge.time >= picture.from) {
          context.lineTo(x(edge.time), y(level));
          context.lineTo(x(edge.time), y(edge.level));
        }
        level = edge.level;
        if (edge.time < picture.from) context.moveTo(LEFT, y(level));
      }
      context.lineTo(x(end), y(level));
      context.stroke();
    });

    context.font = "12px system-ui, sans-serif";
    for (const {from, to, text, short} of picture.brackets) {
      if (from > end) continue;
      const left = x(from) + 1, stop = x(Math.min(to, end)) - 1;
      const y = BRACKET;
      context.strokeStyle = colour("--quiet");
      context.lineWidth = 1;
      context.beginPath();
      context.moveTo(left, y + 4);
      context.lineTo(left, y);
      context.lineTo(stop, y);
      if (to <= end) context.lineTo(stop, y + 4);
      context.stroke();
      const room = x(to) - x(from);
      const said = [text, short].find((words) => context.measureText(words).width + 4 <= room);
      if (to <= end && said !== undefined) {
        context.fillStyle = colour("--text");
        context.fillText(said, (left + x(to)) / 2, y - 9);
      }
    }
    if (this.until < picture.to) {
      context.fillStyle = colour("--accent");
      context.fillRect(x(end), TOP, 2, BOTTOM - TOP);
    }
    context.textAlign = "start";
    if (this.until >= picture.to) {
      context.fillStyle = colour(picture.good ? "--text" : "--bad");
      context.fillText(picture.title, LEFT, 10);
    }
  }
}

// The parts of a frame on SL, from its edges: acknowledge, start bit, CDS, data, CRC. Empty if SL
// does not look like a frame of this encoder.
function brackets(edges, frame, encoder, dataBits, roundTripNs) {
  const rises = edges.filter((edge) => edge.place === 0 && edge.level === 1 &&
                             edge.time > frame.start_ns && edge.time <= frame.end_ns + 1);
  if (rises.length < 3) return [];
  const period = (rises.at(-1).time - rises[0].time) / (rises.length - 1);
  const found = [];
  let at = rises[0].time + roundTripNs;
  const add = (bits, text, short = "") => {
    if (bits > 0) found.push({from: at, to: at + bits * period, text, short});
    at += bits * period;
  };
  if (encoder.start_bit) {
    const sl = edges.filter((edge) => edge.place === 2 && edge.time > frame.start_ns);
    const fall = sl.findIndex((edge) => edge.level === 0);
    const rise = sl.find((edge, i) => fall >= 0 && i > fall && edge.level === 1);
    if (rise === undefined || rise.time > frame.end_ns + roundTripNs) return [];
    found.push({from: sl[fall].time, to: rise.time, text: "acknowledge", short: "A"});
    at = rise.time;
    add(1, "start", "S");
    if (encoder.control) add(1, "CDS", "C");
  }
  const position = dataBits - encoder.flag_bits;
  add(position, `position, ${position} bits`, `${position} bits`);
  if (encoder.flag_bits === 2) add(2, "nE nW", "EW");
  else add(encoder.flag_bits, `flags, ${encoder.flag_bits}`, "F");
  add(encoder.crc_bits, `CRC, ${encoder.crc_bits}`, "CRC");
  return found;
}
