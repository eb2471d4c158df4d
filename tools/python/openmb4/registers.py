# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Registers and fields of the chip by their generated names (regmap/generated/mb4)."""

import json
import re
from typing import TYPE_CHECKING, Any, Dict, List, Union

from ._library import HERE, Error

if TYPE_CHECKING:
    from .simulator import Simulator

READ, WRITE = 0x03, 0x02  # SPI opcodes


def _addresses() -> Dict[str, int]:
    """{register: address}; those of a data channel as "SLAVE_CFG_CRC3"."""
    header = (HERE / "mb4_regs.h").read_text(encoding="utf-8")
    found = {name: int(number, 16)
             for name, number in re.findall(r"#define MB4_ADDR_(\w+) (0x\w+)U", header)}
    base = found.pop("SLAVE_CFG")
    for name, offset in re.findall(r"#define MB4_(SLAVE_CFG_\w+)_OFFSET (\d+)U", header):
        for channel in range(8):
            found[f"{name}{channel + 1}"] = base + 4 * channel + int(offset)
    for name, size in (("SCDATA", 64), ("RDATA", 64)):
        first = found.pop(name)
        found.update({f"{name}_BYTE{i + 1}": first + i for i in range(size)})
    return found


class Register:
    """A byte of the chip, read and written through SPI or, where the scenario's host is one, the
    parallel bus. Both take simulated time."""

    def __init__(self, simulator: "Simulator", name: str, address: int):
        self._simulator, self.name, self.address = simulator, name, address

    def __repr__(self) -> str:
        return f"<register {self.name} at 0x{self.address:02X}>"

    def read(self) -> int:
        try:
            return self._simulator.spi(bytes((READ, self.address, 0)))[2]
        except Error as error:
            if error.code != "MB4SIM_ERROR_HOST":
                raise
            return self._simulator.bus_read(self.address)

    def write(self, value: int) -> None:
        """Writes all eight bits."""
        if not 0 <= value < 256:
            raise Error(f"{self.name}: {value} is no byte")
        try:
            self._simulator.spi(bytes((WRITE, self.address, value)))
        except Error as error:
            if error.code != "MB4SIM_ERROR_HOST":
                raise
            self._simulator.bus_write(self.address, value)


class Field:
    """Some bits of a register, or of several bytes in a row (SCDATA, SCRCSTART)."""

    def __init__(self, simulator: "Simulator", name: str, parts: List[dict],
                 registers: Dict[int, Register]):
        self.name = name
        self.access: str = parts[0]["access"]
        self.width: int = sum(part["width"] for part in parts)
        self._parts = [(registers[part["address"]], part["lsb"], part["width"]) for part in parts]
        self._simulator = simulator

    def __repr__(self) -> str:
        return f"<field {self.name}, {self.width} bits in {self.register!r}>"

    @property
    def register(self) -> Register:
        """The register that holds the field; of several the one with the lowest bits."""
        return self._parts[0][0]

    def read(self) -> int:
        value = shift = 0
        for register, lsb, width in self._parts:
            value |= (register.read() >> lsb & (1 << width) - 1) << shift
            shift += width
        return value

    def modify(self, value: int) -> None:
        """Reads the register, changes the bits of this field, writes the register. Refused where
        that does harm: at INSTR (0xF4), where a written 1 is an instruction, at SVALID, where a
        written 0 clears what came in meanwhile, and at fields that are only read."""
        if self.access in ("ro", "rom"):
            raise Error(f"{self.name}: can only be read")
        if self.access == "w0c" or self.register.name == "INSTR":
            raise Error(f"{self.name}: a read-modify-write of {self.register.name} does harm; "
                        f"write the whole register, regs.{self.name}.register.write()")
        if not 0 <= value < 1 << self.width:
            raise Error(f"{self.name}: {value} has more than {self.width} bits")
        with self._simulator._lock:
            for register, lsb, width in self._parts:
                mask = (1 << width) - 1
                if width == 8:
                    register.write(value & mask)
                else:
                    register.write(register.read() & ~(mask << lsb) | (value & mask) << lsb)
                value >>= width


class Registers:
    """`regs.FREQS` is a field, `regs.FREQ` the whole register around it. Fields of a slave, a data
    channel or a channel carry its number: `regs.SCDLEN3`, `regs.CFGCH2`, or `regs["SCDLEN3"]`.
    Where field and register have one name it is the field; `regs.REGADR.register` is the register.
    """

    def __init__(self, simulator: "Simulator"):
        registers = {name: Register(simulator, name, address)
                     for name, address in _addresses().items()}
        by_address = {register.address: register for register in registers.values()}
        fields: Dict[str, List[dict]] = {}
        table = json.loads((HERE / "mb4_regs.json").read_text(encoding="utf-8"))
        for field in table["fields"] + table["alternate_fields"]:
            if field["access"] != "rom":
                name = re.sub(r"\(.*", "", field["label"])
                name = field["ident"] if name == "CHSEL" else name
                fields.setdefault(name, []).append(field)
        self._names: Dict[str, Union[Register, Field]] = {
            **registers, **{name: Field(simulator, name, parts, by_address)
                            for name, parts in fields.items()}}

    def __getitem__(self, name: str) -> Any:
        if name not in self._names:
            raise Error(f"no register or field '{name}'")
        return self._names[name]

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__") or name not in self._names:
            raise AttributeError(f"no register or field '{name}'")
        return self._names[name]

    def __dir__(self) -> List[str]:
        return sorted(self._names)
