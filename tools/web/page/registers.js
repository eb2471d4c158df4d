// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Registers and fields by their generated names, with the rules of the Python package: a field
// write is a read-modify-write, refused where it does harm.
"use strict";

const SPI_READ = 0x03, SPI_WRITE = 0x02;
const hex = (value, digits) => "0x" + value.toString(16).toUpperCase().padStart(digits, "0");

// A number as a user types it; null: none.
function parseNumber(text) {
  return /^(0x[0-9a-f]+|[0-9]+)$/i.test(text.trim()) ? BigInt(text.trim()) : null;
}

class Registers {
  // `table`: mb4_regs.json; `addresses`: {register: address}.
  constructor(chip, table, addresses) {
    this.chip = chip;
    this.addresses = addresses;
    this.names = Object.fromEntries(
      Object.entries(addresses).map(([name, address]) => [address, name]));
    this.fields = new Map();
    for (const part of [...table.fields, ...table.alternate_fields]) {
      if (part.access === "rom") continue;
      let name = part.label.replace(/\(.*/, "");
      if (name === "CHSEL") name = part.ident;
      if (!this.fields.has(name)) this.fields.set(name, {name, access: part.access, parts: []});
      this.fields.get(name).parts.push(part);
    }
    for (const field of this.fields.values()) {
      field.width = field.parts.reduce((sum, part) => sum + part.width, 0);
      field.address = field.parts[0].address;
      field.codes = new Map();  // name: code
      const {codes, names} = field.parts[0];
      if (field.parts.length === 1 && names !== undefined) {
        names.forEach((name, i) => { if (name !== "") field.codes.set(name, BigInt(codes[i][0])); });
      }
    }
  }

  // The address of a register's name or number.
  address(text) {
    const name = text.trim().toUpperCase();
    if (name in this.addresses) return this.addresses[name];
    const number = parseNumber(text);
    if (number === null || number > 0xFFn) throw new Error(`no register '${text.trim()}'`);
    return Number(number);
  }

  read(address, size = 1) {
    return this.chip.spi([SPI_READ, address, ...new Array(size).fill(0)]).slice(2);
  }

  write(address, value) {
    if (value === null || value > 0xFFn) {
      throw new Error(`${this.names[address] ?? hex(address, 2)}: this is no byte`);
    }
    this.chip.spi([SPI_WRITE, address, Number(value)]);
  }

  // The value of a field out of the bytes of the chip, {address: byte}.
  static value(field, bytes) {
    let value = 0n, shift = 0n;
    for (const part of field.parts) {
      const bits = bytes[part.address] >> part.lsb & (1 << part.width) - 1;
      value |= BigInt(bits) << shift;
      shift += BigInt(part.width);
    }
    return value;
  }

  // The name of a code of a field; empty: it has none.
  static nameOf(field, value) {
    for (const [name, code] of field.codes) if (code === value) return name;
    return "";
  }

  // What a user types: a number, or the name of a code. null: neither.
  static parse(field, text) {
    return field.codes.get(text.trim()) ?? parseNumber(text);
  }

  modify(name, value) {
    const field = this.fields.get(name);
    const register = this.names[field.address];
    if (field.access === "ro") throw new Error(`${name}: can only be read`);
    if (field.access === "w0c" || register === "INSTR") {
      throw new Error(`${name}: a read-modify-write of ${register} does harm; ` +
                      "write the whole register");
    }
    if (value === null) throw new Error(`${name}: this is no number`);
    if (value >> BigInt(field.width)) {
      throw new Error(`${name}: ${value} has more than ${field.width} bits`);
    }
    for (const part of field.parts) {
      const mask = (1 << part.width) - 1;
      const bits = Number(value & BigInt(mask));
      const old = part.width === 8 ? 0 : this.read(part.address)[0] & ~(mask << part.lsb);
      this.write(part.address, BigInt(old | bits << part.lsb));
      value >>= BigInt(part.width);
    }
  }
}

// The groups of the page: what one SPI frame reads, 64 bytes at most.
const GROUPS = [
  {title: "Status and instruction", first: 0xF0, size: 12},
  {title: "Configuration", first: 0xE2, size: 20, without: [0xF0, 0xF4]},
  {title: "Data channels", first: 0xC0, size: 32},
  {title: "Single-cycle data", first: 0x00, size: 64},
  {title: "Register data", first: 0x80, size: 64},
];

// The groups as <details>; open ones follow the chip.
class RegisterView {
  constructor(registers, parent, tell) {
    this.registers = registers;
    this.tell = tell;
    this.groups = GROUPS.map((group) => {
      const details = document.createElement("details");
      const summary = document.createElement("summary");
      summary.textContent = group.title;
      const last = group.first + group.size - 1;
      summary.append(Object.assign(document.createElement("span"),
                                   {className: "hint", textContent: ` ${hex(group.first, 2)} to ${hex(last, 2)}`}));
      details.append(summary);
      parent.append(details);
      const shown = {...group, details, inputs: null};
      details.addEventListener("toggle", () => {
        if (details.open) this.refresh();
      });
      return shown;
    });
  }

  build(group) {
    const holder = document.createElement("div");
    holder.className = "fields";
    group.inputs = [];
    const has = (field) => field.address >= group.first && field.address < group.first + group.size &&
      !(group.without && field.address >= group.without[0] && field.address <= group.without[1]);
    const fields = [...this.registers.fields.values()].filter(has);
    if (group.first === 0xF0) {
      fields.splice(0, fields.length, ...fields.filter((field) => field.address !== 0xF5));
    }
    for (const field of fields) {
      const label = document.createElement("label");
      const part = field.parts[0];
      const where = field.parts.length > 1 || part.width === 8 ? hex(field.address, 2)
        : `${hex(field.address, 2)}.${part.width > 1 ? `${part.lsb + part.width - 1}:` : ""}${part.lsb}`;
      label.innerHTML = `<span class="name"></span> <span class="hint"></span>`;
      label.children[0].textContent = field.name;
      label.children[1].textContent = where;
      const input = document.createElement("input");
      Object.assign(input, {id: `field-${field.name}`, autocomplete: "off", spellcheck: false,
                            readOnly: field.access === "ro"});
      if (field.width > 16) label.className = "long";
      const change = () => {
        mark(input, "");
        if (input.value === input.dataset.shown) return;
        try {
          this.registers.modify(field.name, Registers.parse(field, input.value));
          this.tell(`${field.name} is written`, false);
        } catch (error) {
          this.tell(error.message, true);
          mark(input, error.message);
          return;
        }
        input.dataset.shown = "";
        this.refresh(true);
      };
      input.addEventListener("keydown", (event) => {
        if (event.key === "Enter") {
          event.preventDefault();
          change();
        } else if (event.key === "Escape") {
          input.value = input.dataset.shown;
          mark(input, "");
        }
      });
      input.addEventListener("blur", () => {
        if (input.value !== input.dataset.shown && !input.hasAttribute("aria-invalid")) {
          this.tell(`${field.name} is not written: Enter writes it`, true);
        }
        input.value = input.dataset.shown;
        mark(input, "");
      });
      label.append(input);
      const word = Object.assign(document.createElement("span"), {className: "hint word"});
      if (field.codes.size > 0) {
        input.title = [...field.codes].map(([name, code]) => `${code}: ${name}`).join("\n");
        label.append(word);
      }
      holder.append(label);
      group.inputs.push({field, input, word});
    }
    group.details.append(holder);
  }

  // Reads the open groups. A value that the user is changing stays, unless `all`.
  refresh(all = false) {
    for (const group of this.groups) {
      if (!group.details.open) continue;
      if (group.inputs === null) this.build(group);
      const bytes = {};
      try {
        this.registers.read(group.first, group.size).forEach((byte, i) => { bytes[group.first + i] = byte; });
      } catch (error) {
        this.tell(error.message, true);
        return;
      }
      for (const {field, input, word} of group.inputs) {
        const value = Registers.value(field, bytes);
        word.textContent = Registers.nameOf(field, value);
        const text = field.width >= 8 ? hex(value, Math.ceil(field.width / 4)) : String(value);
        const changing = document.activeElement === input && input.value !== input.dataset.shown;
        input.closest("label").classList.toggle("new", "shown" in input.dataset &&
          input.dataset.shown !== "" && input.dataset.shown !== text);
        if (!changing || all) input.value = text;
        input.dataset.shown = text;
      }
    }
  }
}
