// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Registers and fields by their generated names, with the rules of the Python package: a field
// write is a read-modify-write, refused where it does harm.
"use strict";

const SPI_READ = 0x03, SPI_WRITE = 0x02;
const WORD_BYTES = 4;
const hex = (value, digits) => "0x" + value.toString(16).toUpperCase().padStart(digits, "0");

// A number as a user types it; null: none.
function parseNumber(text) {
  return /^(0x[0-9a-f]+|[0-9]+)$/i.test(text.trim()) ? BigInt(text.trim()) : null;
}

// How the registers of a master are reached. `group` of readGroup() has `first` and `size`.
class SpiBus {
  name = "SPI";
  unit = "byte";
  bytes = 1;

  constructor(chip) { this.chip = chip; }
  read(address) { return this.chip.spi([SPI_READ, address, 0])[2]; }
  write(address, value) { this.chip.spi([SPI_WRITE, address, value]); }
  // {address: value}, by one SPI frame.
  readGroup({first, size}) {
    const bytes = this.chip.spi([SPI_READ, first, ...new Array(size).fill(0)]).slice(2);
    return Object.fromEntries([...bytes].map((byte, i) => [first + i, byte]));
  }
}

class AxiBus {
  name = "AXI4-Lite";
  unit = "word";
  bytes = WORD_BYTES;

  constructor(chip) { this.chip = chip; }
  read(address) { return this.chip.readWord(address); }
  write(address, value) { this.chip.writeWord(address, value); }
  // {address: value} of those that have a field.
  readGroup(group, addresses) {
    return Object.fromEntries(addresses.map((address) => [address, this.read(address)]));
  }
}

// Some bits of a number; numbers of 32 bits have no sign.
const bitsOf = (value, lsb, width) => BigInt(value) >> BigInt(lsb) & (1n << BigInt(width)) - 1n;

class Registers {
  // `bus`: a SpiBus or AxiBus. `table`: the fields of NAME_regs.json, and addresses: {register:
  // address}. `last`: the highest address.
  constructor(bus, table, last) {
    this.bus = bus;
    this.last = last;
    this.digits = last > 0xFF ? 3 : 2;
    this.addresses = Object.fromEntries(
      Object.entries(table.addresses).filter(([, address]) => address <= last));
    this.names = Object.fromEntries(
      Object.entries(this.addresses).map(([name, address]) => [address, name]));
    this.fields = new Map();
    for (const part of table.fields) {
      if (part.access === "rom" || part.address > last) continue;
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
    if (number === null || number > this.last || number % BigInt(this.bus.bytes) !== 0n) {
      throw new Error(`no register '${text.trim()}'`);
    }
    return Number(number);
  }

  // The name of a register, or its address.
  title(address) { return this.names[address] ?? hex(address, this.digits); }
  hexOf(value) { return hex(value, 2 * this.bus.bytes); }

  read(address) { return this.bus.read(address); }

  write(address, value) {
    if (value === null || value >> BigInt(8 * this.bus.bytes)) {
      throw new Error(`${this.title(address)}: this is no ${this.bus.unit}`);
    }
    this.bus.write(address, Number(value));
  }

  // The value of a field out of {address: value of the register}.
  static value(field, values) {
    let value = 0n, shift = 0n;
    for (const part of field.parts) {
      value |= bitsOf(values[part.address], part.lsb, part.width) << shift;
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
      const whole = part.width === 8 * this.bus.bytes;
      const old = whole ? 0n : BigInt(this.read(part.address));
      const lsb = BigInt(part.lsb);
      const mask = bitsOf(-1n, 0, part.width) << lsb;
      this.write(part.address, old & ~mask | value << lsb & mask);
      value >>= BigInt(part.width);
    }
  }
}

// The groups as <details>; open ones follow the chip.
class RegisterView {
  // `groups`: [{title, first, size, and without: [first, last] of addresses}].
  constructor(registers, groups, parent, tell) {
    this.registers = registers;
    this.tell = tell;
    parent.replaceChildren();
    this.groups = groups.map((group) => {
      const details = document.createElement("details");
      const summary = document.createElement("summary");
      summary.textContent = group.title;
      const last = group.first + group.size - registers.bus.bytes;
      const [from, to] = [group.first, last].map((address) => hex(address, registers.digits));
      summary.append(Object.assign(document.createElement("span"),
                                   {className: "hint", textContent: ` ${from} to ${to}`}));
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
    holder.className = `fields ${this.registers.bus.unit}`;
    group.inputs = [];
    const has = (field) => field.address >= group.first && field.address < group.first + group.size &&
      !(group.without && field.address >= group.without[0] && field.address <= group.without[1]);
    const {bus, digits} = this.registers;
    const fields = [...this.registers.fields.values()].filter(has);
    group.addresses = [...new Set(fields.flatMap(({parts}) => parts.map((part) => part.address)))];
    for (const field of fields) {
      const label = document.createElement("label");
      const part = field.parts[0];
      const where = field.parts.length > 1 || part.width === 8 * bus.bytes ? hex(field.address, digits)
        : `${hex(field.address, digits)}.${part.width > 1 ? `${part.lsb + part.width - 1}:` : ""}${part.lsb}`;
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
      const word = Object.assign(document.createElement("span"), {className: "hint meaning"});
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
      let values;
      try {
        values = this.registers.bus.readGroup(group, group.addresses);
      } catch (error) {
        this.tell(error.message, true);
        return;
      }
      for (const {field, input, word} of group.inputs) {
        const value = Registers.value(field, values);
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
