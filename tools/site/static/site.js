/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A link from each picture to itself alone, and a button to copy each block of code. Of a terminal's text, "$ command" and its output, it copies the
 * commands. */
"use strict";

function copiedText(block) {
  const text = block.textContent.replace(/\n+$/, "\n");
  const commands = text.split("\n").filter((line) => line.startsWith("$ "));
  return commands.length === 0 ? text : commands.map((line) => line.slice(2) + "\n").join("");
}

// Pages that are opened as files, or come without https, have no clipboard in some browsers.
async function copy(text) {
  if (navigator.clipboard && window.isSecureContext) return navigator.clipboard.writeText(text);
  const area = document.createElement("textarea");
  area.value = text;
  document.body.append(area);
  area.select();
  const done = document.execCommand("copy");
  area.remove();
  if (!done) throw new Error("not copied");
}

document.addEventListener("DOMContentLoaded", () => {
  for (const picture of document.querySelectorAll("article img")) {
    if (picture.closest("a") !== null) continue;
    const link = document.createElement("a");
    link.href = picture.src;
    link.title = "This picture alone, in its full size";
    picture.replaceWith(link);
    link.append(picture);
  }
  for (const block of document.querySelectorAll("div.highlight")) {
    const button = document.createElement("button");
    button.className = "copy";
    button.type = "button";
    button.textContent = "Copy";
    button.setAttribute("aria-label", "Copy this block");
    button.addEventListener("click", async () => {
      try {
        await copy(copiedText(block.querySelector("pre")));
        button.textContent = "Copied";
      } catch {
        button.textContent = "Not copied";
      }
      setTimeout(() => { button.textContent = "Copy"; }, 1500);
    });
    block.append(button);
  }
});
