// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Messages by the fields of the page.
"use strict";

// A field holds what cannot be used.
class FieldError extends Error {
  constructor(input, text) {
    super(text);
    this.input = input;
  }
}

// Puts `text` by the field; "": the field is right.
function mark(input, text) {
  let note = document.getElementById(`${input.id}-wrong`);
  if (note === null) {
    if (text === "") return;
    note = Object.assign(document.createElement("span"), {id: `${input.id}-wrong`, className: "wrong"});
    const label = input.closest("label");
    if (label.classList.contains("inline")) label.after(note);
    else label.append(note);
  }
  note.textContent = text;
  note.hidden = text === "";
  if (text === "") {
    input.removeAttribute("aria-invalid");
    input.removeAttribute("aria-describedby");
  } else {
    input.setAttribute("aria-invalid", "true");
    input.setAttribute("aria-describedby", note.id);
  }
}

// Why a field with type="number" cannot be used; "" if it can.
function wrongNumber(input) {
  const whole = input.step !== "any";
  const number = Number(input.value);
  const good = input.value !== "" && number >= Number(input.min) && number <= Number(input.max) &&
    (!whole || Number.isInteger(number));
  return good ? "" : `${whole ? "a whole number" : "a number"} from ${input.min} to ${input.max}`;
}
