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

const MIN_EDGE_PX = 1.5, MIN_DENSE_EDGES = 8;  // edges closer than this are not drawn one by one

// A row of a picture in parts: [{from, to, level}], and {from, to, edges} where edges are closer
// than `minGap` ns, with the number of these edges.
function stretches(picture, place, minGap) {
  const inside = (edge) => edge.place === place && edge.time <= picture.to;
  const edges = picture.edges.filter((edge) => inside(edge) && edge.time >= picture.from);
  let level = picture.edges.findLast((edge) => inside(edge) && edge.time < picture.from)?.level ??
    picture.before[place];
  const found = [];
  let at = picture.from;
  for (let i = 0; i < edges.length;) {
    let last = i;
    while (last + 1 < edges.length && edges[last + 1].time - edges[last].time < minGap) ++last;
    const dense = last - i + 1 >= MIN_DENSE_EDGES;
    if (!dense) last = i;
    found.push({from: at, to: edges[i].time, level});
    if (dense) found.push({from: edges[i].time, to: edges[last].time, edges: last - i + 1});
    at = edges[last].time;
    level = edges[last].level;
    i = last + 1;
  }
  found.push({from: at, to: picture.to, level});
  return found;
}

// A drawing as SVG, with those calls of a canvas that Diagram.paint() makes.
class SvgContext {
  constructor(width, height, measure) {
    Object.assign(this, {width, height, measure, parts: [], path: "", textAlign: "start"});
  }

  measureText(text) {
    this.measure.font = this.font;
    return this.measure.measureText(text);
  }

  static number(value) { return String(+value.toFixed(2)); }

  beginPath() { this.path = ""; }
  moveTo(x, y) { this.path += `M${SvgContext.number(x)} ${SvgContext.number(y)}`; }
  lineTo(x, y) { this.path += `L${SvgContext.number(x)} ${SvgContext.number(y)}`; }

  stroke() {
    this.parts.push(`<path d="${this.path}" fill="none" stroke="${this.strokeStyle}" ` +
                    `stroke-width="${this.lineWidth}" stroke-linejoin="round"/>`);
  }

  fillRect(...box) {
    const [x, y, width, height] = box.map(SvgContext.number);
    this.parts.push(`<rect x="${x}" y="${y}" width="${width}" height="${height}" fill="${this.fillStyle}"/>`);
  }

  fillText(text, x, y) {
    const anchor = this.textAlign === "center" ? "middle" : "start";
    const safe = text.replace(/[&<>]/g, (letter) => `&#${letter.charCodeAt(0)};`);
    this.parts.push(`<text x="${SvgContext.number(x)}" y="${SvgContext.number(y)}" fill="${this.fillStyle}" ` +
                    `font-size="${parseInt(this.font)}" text-anchor="${anchor}">${safe}</text>`);
  }

  toString() {
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${this.width}" height="${this.height}" ` +
      `viewBox="0 0 ${this.width} ${this.height}" font-family="system-ui, sans-serif" ` +
      `dominant-baseline="central">\n${this.parts.join("\n")}\n</svg>\n`;
  }
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

  get width() {
    const style = getComputedStyle(this.canvas.parentElement);
    return this.canvas.parentElement.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight);
  }

  draw() {
    const {canvas, width} = this;
    const scale = devicePixelRatio || 1;
    canvas.width = Math.round(width * scale);
    canvas.height = Math.round(HEIGHT * scale);
    canvas.style.height = `${HEIGHT}px`;
    const context = canvas.getContext("2d");
    context.scale(scale, scale);
    this.paint(context, width, this.until);
  }

  // The whole picture, as SVG.
  svg() {
    const context = new SvgContext(Math.round(this.width), HEIGHT, this.canvas.getContext("2d"));
    context.fillStyle = getComputedStyle(this.canvas).getPropertyValue("--card").trim();
    context.fillRect(0, 0, context.width, HEIGHT);
    this.paint(context, context.width, Infinity);
    return String(context);
  }

  paint(context, width, until) {
    const {picture} = this;
    const style = getComputedStyle(this.canvas);
    const colour = (name) => style.getPropertyValue(name).trim();
    context.font = "13px system-ui, sans-serif";
    context.textBaseline = "middle";
    context.fillStyle = colour("--text");
    for (const row of ROWS) context.fillText(row.name, 4, row.y + SWING / 2);
    if (picture === null) return;
    const right = width - 8;
    const x = (time) => LEFT + (time - picture.from) / (picture.to - picture.from) * (right - LEFT);
    const end = Math.min(picture.to, until);

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

    context.lineJoin = "round";
    const minGap = (picture.to - picture.from) / (right - LEFT) * MIN_EDGE_PX;
    ROWS.forEach((row, i) => this.paintRow(context, row, {
      parts: stretches(picture, row.place, minGap), x, end, line: colour(`--row${i}`),
      card: colour("--card"), quiet: colour("--quiet")}));

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
    if (until < picture.to) {
      context.fillStyle = colour("--accent");
      context.fillRect(x(end), TOP, 2, BOTTOM - TOP);
    }
    context.textAlign = "start";
    if (until >= picture.to) {
      context.fillStyle = colour(picture.good ? "--text" : "--bad");
      context.fillText(picture.title, LEFT, 10);
    }
  }

  // One line. Where edges are too close, two thin rails and the number of periods; a line that keeps
  // its level through most of a frame without a word is thin, with its time.
  paintRow(context, row, {parts, x, end, line, card, quiet}) {
    const {picture} = this;
    const y = (level) => row.y + (level ? 0 : SWING);
    const texts = [];
    let before = null;  // the level in front
    for (const part of parts) {
      if (part.from > end) break;
      const left = x(part.from), stop = x(Math.min(part.to, end));
      const dense = "edges" in part;
      // A part that the picture cuts off counts from the start of the frame to its end.
      const ns = (part.to < picture.to ? part.to : picture.seen) -
        (part.from > picture.from ? part.from : picture.zero);
      const silent = !dense && !picture.good && ns > (picture.seen - picture.zero) / 2;
      context.strokeStyle = silent ? quiet : line;
      context.lineWidth = dense || silent ? 1 : 1.5;
      context.beginPath();
      for (const level of dense ? [0, 1] : [part.level]) {
        if (!dense && before !== null && before !== level) {
          context.moveTo(left, y(before));
          context.lineTo(left, y(level));
        } else {
          context.moveTo(left, y(level));
        }
        context.lineTo(stop, y(level));
      }
      if (dense) {
        context.moveTo(left, y(0));
        context.lineTo(left, y(1));
      }
      context.stroke();
      before = dense ? null : part.level;
      if (part.to > end || !(dense || silent)) continue;
      const time = `${+(ns / 1000).toFixed(2)} µs`;
      texts.push({text: dense ? `${Math.floor(part.edges / 2)} periods in ${time}` : `${part.level} for ${time}`,
                  middle: (left + stop) / 2, room: stop - left});
    }
    context.font = "12px system-ui, sans-serif";
    for (const {text, middle, room} of texts) {
      const wide = context.measureText(text).width + 8;
      if (wide > room) continue;
      context.fillStyle = card;
      context.fillRect(middle - wide / 2, row.y + SWING / 2 - 8, wide, 16);
      context.fillStyle = line;
      context.fillText(text, middle, row.y + SWING / 2);
    }
    context.font = "13px system-ui, sans-serif";
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
