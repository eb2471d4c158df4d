// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The frame that is shown, as files.
"use strict";

const VCD_CODES = ["!", "#", "$"];  // of ROWS

// The lines of a frame as VCD, in simulated time.
function vcdOf(picture) {
  const ps = (ns) => Math.round(ns * 1000);
  const edges = picture.edges.filter((edge) => ROWS.some((row) => row.place === edge.place));
  const start = Math.min(picture.from, ...edges.slice(0, 1).map((edge) => edge.time));
  const code = (place) => VCD_CODES[ROWS.findIndex((row) => row.place === place)];
  const lines = ["$version openmb4 $end", "$timescale 1 ps $end", "$scope module channel1 $end",
                 ...ROWS.map((row) => `$var wire 1 ${code(row.place)} ${row.name} $end`),
                 "$upscope $end", "$enddefinitions $end", `#${ps(start)}`, "$dumpvars",
                 ...ROWS.map((row) => `${picture.before[row.place]}${code(row.place)}`), "$end"];
  let now = ps(start);
  for (const edge of edges) {
    if (ps(edge.time) !== now) lines.push(`#${now = ps(edge.time)}`);
    lines.push(`${edge.level}${code(edge.place)}`);
  }
  lines.push(`#${Math.max(ps(picture.to), now + 1)}`);
  return lines.join("\n") + "\n";
}

// Gives a text to the user as a file.
function save(name, type, text) {
  const address = URL.createObjectURL(new Blob([text], {type}));
  Object.assign(document.createElement("a"), {href: address, download: name}).click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
