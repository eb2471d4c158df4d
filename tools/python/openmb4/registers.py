# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Registers and fields of a master by their generated names (regmap/generated)."""

import json
import re
from typing import Any, Callable, Dict, List, Optional, Protocol, Union

from ._library import HERE, Error, NameMistake, similar
from ._opened import Opened

READ, WRITE = 0x03, 0x02  # SPI opcodes


class Bus(Protocol):
    """How the registers of a master are reached. Both calls take simulated time."""

    bits: int  # of a register
    simulator: Opened

    def read(self, address: int) -> int:
        """The register at an address."""

    def write(self, address: int, value: int) -> None:
        """Writes the register at an address."""


class ChipBus:
    """The iC-MB4 through what its host has: SPI, the parallel bus or a bus of words."""

    bits = 8

    def __init__(self, simulator: Opened):
        self.simulator = simulator

    def _by_host(self, *ways: Callable[[], Any]) -> Any:
        """The result of the first way that the host has."""
        self.simulator._must_be("ic-mb4")
        for way in ways[:-1]:
            try:
                return way()
            except Error as error:
                if error.code != "MB4SIM_ERROR_HOST":
                    raise
        return ways[-1]()

    def read(self, address: int) -> int:
        """The register at an address."""
        chip = self.simulator
        value: int = self._by_host(lambda: chip.spi(bytes((READ, address, 0)))[2],
                                   lambda: chip.bus_read(address),
                                   lambda: chip.mem_read(address, 1)[0])
        return value

    def write(self, address: int, value: int) -> None:
        """Writes the register at an address."""
        chip = self.simulator
        self._by_host(lambda: chip.spi(bytes((WRITE, address, value))),
                      lambda: chip.bus_write(address, value),
                      lambda: chip.mem_write(address, bytes((value,))))


class AxiBus:
    """A master on AXI4-Lite, `[master] type` of the scenario."""

    bits = 32

    def __init__(self, simulator: Opened, master: str):
        self.simulator, self._master = simulator, master

    def read(self, address: int) -> int:
        """The register at an address."""
        self.simulator._must_be(self._master)
        return self.simulator.axi_read(address)

    def write(self, address: int, value: int) -> None:
        """Writes the register at an address."""
        self.simulator._must_be(self._master)
        self.simulator.axi_write(address, value)


class DslBus:
    """The byte map of the DSL master, whose bus has words."""

    bits = 8

    def __init__(self, simulator: Opened):
        self.simulator = simulator

    def read(self, address: int) -> int:
        """The register at an address."""
        self.simulator._must_be("dsl")
        return self.simulator.mem_read(address, 1)[0]

    def write(self, address: int, value: int) -> None:
        """Writes the register at an address, and no other byte of its word."""
        self.simulator._must_be("dsl")
        self.simulator.mem_write(address, bytes((value,)))


def _addresses(master: str) -> Dict[str, int]:
    """{register: address}; those of a data channel as "SLAVE_CFG_CRC3"."""
    header = (HERE / f"{master}_regs.h").read_text(encoding="utf-8")
    prefix = master.upper()
    found = {name: int(number, 16)
             for name, number in re.findall(rf"#define {prefix}_ADDR_(\w+) (0x\w+)U", header)}
    for name, offset in re.findall(rf"#define {prefix}_(SLAVE_CFG_\w+)_OFFSET (\d+)U", header):
        for channel in range(8):
            found[f"{name}{channel + 1}"] = found["SLAVE_CFG"] + 4 * channel + int(offset)
    found.pop("SLAVE_CFG", None)
    for name in found.keys() & {"SCDATA", "RDATA"}:
        first = found.pop(name)
        found.update({f"{name}_BYTE{i + 1}": first + i for i in range(64)})
    return found


class Register:
    """A byte of the chip, or a word of a master on AXI. Reading and writing take simulated time."""

    def __init__(self, bus: Bus, name: str, address: int):
        self._bus, self.name, self.address = bus, name, address

    def __repr__(self) -> str:
        return f"<register {self.name} at 0x{self.address:02X}>"

    def read(self) -> int:
        """The whole register."""
        return self._bus.read(self.address)

    def write(self, value: int) -> None:
        """Writes all bits."""
        if not 0 <= value < 1 << self._bus.bits:
            raise Error(f"{self.name}: {value} is no {'byte' if self._bus.bits == 8 else 'word'}; it "
                        f"is 0 to 0x{(1 << self._bus.bits) - 1:X}")
        self._bus.write(self.address, value)


class Field:
    """Some bits of a register, or of several bytes in a row (SCDATA, SCRCSTART)."""

    def __init__(self, bus: Bus, name: str, parts: List[Dict[str, Any]],
                 registers: Dict[int, Register]):
        self.name = name
        self.access: str = parts[0]["access"]
        self.width: int = sum(part["width"] for part in parts)
        self._parts = [(registers[part["address"]], part["lsb"], part["width"]) for part in parts]
        self._bus = bus
        #: {name: code}, such as {"BiSS_C": 1} of CFGCH1
        self.codes: Dict[str, int] = {
            name: codes[0] for codes, name in zip(parts[0]["codes"], parts[0].get("names", []))
            if name and len(parts) == 1}

    def __repr__(self) -> str:
        return f"<field {self.name}, {self.width} bits in {self.register!r}>"

    @property
    def register(self) -> Register:
        """The register that holds the field; of several the one with the lowest bits."""
        return self._parts[0][0]

    def read(self) -> int:
        """The bits of the field as a number."""
        value = shift = 0
        for register, lsb, width in self._parts:
            value |= (register.read() >> lsb & (1 << width) - 1) << shift
            shift += width
        return value

    def read_name(self) -> str:
        """The name of the code that the field holds, such as "BiSS_C", else the number as text."""
        value = self.read()
        return next((name for name, code in self.codes.items() if code == value), str(value))

    @property
    def modifies(self) -> bool:
        """modify() is possible."""
        return self.access not in ("ro", "rom", "w0c") and self.register.name != "INSTR"

    def modify(self, value: Union[int, str]) -> None:
        """Reads the register, changes the bits of this field, writes the register. Refused where
        that does harm: at INSTR (0xF4), where a written 1 is an instruction, at SVALID, where a
        written 0 clears what came in meanwhile, and at fields that are only read."""
        if self.access in ("ro", "rom"):
            raise Error(f"{self.name}: can only be read")
        if not self.modifies:
            raise Error(f"{self.name}: a read-modify-write of {self.register.name} does harm; "
                        f"write the whole register, regs.{self.name}.register.write()")
        if isinstance(value, str):
            if value not in self.codes:
                known = ", ".join(self.codes)
                raise Error(f"{self.name}: no code has the name '{value}'; "
                            f"{f'they are {known}' if known else 'its codes have no names'}")
            value = self.codes[value]
        if not 0 <= value < 1 << self.width:
            raise Error(f"{self.name}: {value} has more than {self.width} bits; it is 0 to "
                        f"{(1 << self.width) - 1}")
        with self._bus.simulator._lock:
            for register, lsb, width in self._parts:
                mask = (1 << width) - 1
                if width == self._bus.bits:
                    register.write(value & mask)
                else:
                    register.write(register.read() & ~(mask << lsb) | (value & mask) << lsb)
                value >>= width


class Registers:
    """`regs.FREQS` is a field, `regs.FREQ` the whole register around it. Fields of a slave, a data
    channel or a channel carry its number: `regs.SCDLEN3`, `regs.CFGCH2`, or `regs["SCDLEN3"]`.
    Where field and register have one name it is the field; `regs.REGADR.register` is the register.
    """

    def __init__(self, bus: Bus, master: str, more: Optional["Registers"] = None):
        self._master = master
        registers = {name: Register(bus, name, address)
                     for name, address in _addresses(master).items()}
        by_address = {register.address: register for register in registers.values()}
        fields: Dict[str, List[Dict[str, Any]]] = {}
        table = json.loads((HERE / f"{master}_regs.json").read_text(encoding="utf-8"))
        for field in table["fields"] + table.get("alternate_fields", []):
            if field["access"] != "rom":
                name = re.sub(r"\(.*", "", field["label"])
                name = field["ident"] if name == "CHSEL" else name
                fields.setdefault(name, []).append(field)
        self._names: Dict[str, Union[Register, Field]] = {
            **(more._names if more is not None else {}), **registers, **{name: Field(bus, name, parts, by_address)
                            for name, parts in fields.items()}}

    def __getitem__(self, name: str) -> Any:
        if name not in self._names:
            raise self._unknown(name)
        return self._names[name]

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name not in self._names:
            raise self._unknown(name)
        return self._names[name]

    def __setattr__(self, name: str, value: Any) -> None:
        if name.startswith("_"):
            return object.__setattr__(self, name, value)
        if name not in self._names:
            raise self._unknown(name)
        one = self._names[name]
        place = f"{'' if self._master == 'mb4' else self._master + '_'}regs.{name}"
        if isinstance(one, Register):
            how = f"{place}.write({value!r}) writes the register"
        elif one.modifies:
            how = f"{place}.modify({value!r}) writes these bits"
        elif one.access in ("ro", "rom"):
            how = "this one can only be read"
        else:
            how = f"{place}.register.write() writes its register as a whole"
        raise NameMistake(f"{name}: a register is not assigned; {how}")

    def _unknown(self, name: str) -> NameMistake:
        names = () if name.startswith("_") else self._names
        return NameMistake(f"no register or field '{name}'{similar(name, names)}")

    def __repr__(self) -> str:
        return f"<Registers of {self._master}: {len(self._names)} names, dir() lists them>"

    def __dir__(self) -> List[str]:
        return sorted(self._names)
