# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""A SystemRDL file as the plain lists of registers, fields and codes that the templates print."""

import re
from dataclasses import dataclass, field
from pathlib import Path

from systemrdl import RDLCompiler
from systemrdl.node import FieldNode, RegfileNode, RegNode

HERE = Path(__file__).resolve().parent


@dataclass(frozen=True)
class Access:
    """One kind of access."""

    cpp: str  # enumerator
    note: str  # behind it
    text: str  # in the manual
    meaning: str
    writable: bool  # a host write can change the field
    rules: tuple  # (sw, onwrite, onread, cleared by hardware) in SystemRDL


ACCESS = {
    "rw": Access("kReadWrite", "", "R/W", "The host writes, the value stays.", True, (("rw", "", "", False),)),
    "ro": Access("kReadOnly", "", "R", "The host only reads; writes have no effect.", False,
                 (("r", "", "", False), ("r", "", "", True))),
    "wo": Access("kWriteOnly", "reads 0", "W", "The host only writes; it reads 0.", True,
                 (("w", "", "", False), ("w", "", "", True))),
    "sc": Access("kSelfClearing", "written by the host, cleared by the chip", "R/W, self-clearing",
                 "The host writes, the chip sets it back to 0 when it has acted.", True, (("rw", "", "", True),)),
    "w0c": Access("kWriteZeroClears", "writing 0 clears, writing 1 changes nothing", "R, write 0 clears",
                  "The chip sets it; writing 0 clears, writing 1 changes nothing.", True,
                  (("rw", "wzc", "", False), ("w", "wzc", "", False))),
    "w1c": Access("kWriteOneClears", "writing 1 clears, writing 0 changes nothing", "R, write 1 clears",
                  "The chip sets it; writing 1 clears, writing 0 changes nothing.", True,
                  (("rw", "woclr", "", False), ("w", "woclr", "", False))),
    "w1s": Access("kWriteOneSets", "writing 1 sets, writing 0 changes nothing", "R, write 1 sets",
                  "Writing 1 sets it, writing 0 changes nothing; the chip clears it.", True,
                  (("rw", "woset", "", False), ("rw", "woset", "", True))),
    "rc": Access("kReadClears", "reading clears", "R, read clears", "The chip sets it; reading clears it.", False,
                 (("r", "", "rclr", False),)),
}  # fmt: skip


def size_for(bits):
    """Bits of the smallest integer type that holds them."""
    return next(n for n in (8, 16, 32) if bits <= n)


def camel(name):
    """BISS_B -> BissB"""
    return "".join(p[:1].upper() + p[1:].lower() for p in name.split("_") if p)


# ---- Model ---------------------------------------------------------------------------------------


@dataclass
class Field:
    """One field at one place: SCDLEN3 is an object of its own."""

    ident: str  # identifier, without the number for members of a family
    index: int | None  # slave or channel number x, counted from 1
    name: str  # datasheet name with number and part, e.g. SCRCSTART3(7:0)
    label: str  # the same as table 6 prints it, with the bits of wide fields
    address: int
    lsb: int
    width: int
    access: str  # key of ACCESS, or rom: bits of a constant
    reset: int
    table: int | None  # of the datasheet, if there is one
    page: int | None
    description: str
    used_when: str
    codes: list
    alternate: bool
    part: int | None = None  # of a word that several registers make up
    others: list = field(default_factory=list)  # fields of the other meaning on the same bits

    @property
    def msb(self):
        return self.lsb + self.width - 1

    @property
    def mask(self):
        return (1 << self.width) - 1 << self.lsb

    @property
    def bits(self):
        return str(self.lsb) if self.width == 1 else f"{self.msb}:{self.lsb}"

    @property
    def sentence(self):
        return f"If {self.used_when}: {self.description}" if self.used_when else self.description

    @property
    def numbered(self):
        """The sentence with the number in place of x."""
        return self.sentence if self.index is None else re.sub(r"(?<=[A-Z])x\b|\bx\b", str(self.index), self.sentence)

    @property
    def x_name(self):
        """Name with x for the number: SCRCSTARTx(7:0)."""
        return self.name if self.index is None else re.sub(rf"{self.index}(?=\(|$)", "x", self.name, count=1)

    def overlaps(self, other):
        return self.address == other.address and self.mask & other.mask


@dataclass
class Register:
    """One register or, with count > 1, the first of an array of equal ones."""

    ident: str
    title: str
    description: str
    section: str
    address: int
    group: str
    count: int
    stride: int
    alternate: bool
    block: str  # array of register groups that it is part of, or empty
    parts: int  # registers that make up this word, or 1
    map: "Map"
    fields: list  # of the first element, most significant first
    others: list = field(default_factory=list)  # fields of the other view
    others_group: str = ""

    @property
    def reset(self):
        return sum(f.reset << f.lsb for f in self.fields)

    @property
    def wmask(self):
        return sum(f.mask for f in self.fields if f.access != "rom" and ACCESS[f.access].writable)

    @property
    def constant(self):
        """Bits that never change."""
        return sum(f.mask for f in self.fields if f.access == "rom")

    @property
    def where(self):
        """Address or, for an array, the formula."""
        if self.count == 1:
            return self.map.hex(self.address)
        return f"{self.map.hex(self.address)} + {self.stride if self.stride > 1 else ''}(x - 1)"

    @property
    def anchor(self):
        return self.ident.lower().replace("_", "-")

    def shown(self, f):
        return f.x_name if self.count > 1 else f.name

    @property
    def meanings(self):
        """Fields of both views, most significant first, constants left out."""
        both = [f for f in self.fields + self.others if f.access != "rom"]
        return sorted(both, key=lambda f: (-f.msb, f.alternate))

    @property
    def code_lists(self):
        """(names, field) for fields with the same codes."""
        groups = {}
        for f in self.meanings:
            if f.codes:
                groups.setdefault(str(f.codes), []).append(f)
        return [(", ".join(self.shown(f) for f in fields), fields[0]) for fields in groups.values()]

    @property
    def bit_texts(self):
        """One text per group of bits, second meanings behind a slash."""
        texts = []
        for f in self.fields:
            names = [self.shown(f) if f.access != "rom" else f"'{f.reset:0{f.width}b}'"]
            others = [self.shown(o) for o in self.others if f.overlaps(o)]
            if others:
                names.append(self.others_group or ", ".join(others))
            texts.append(f"{f.bits} {' / '.join(names)}")
        return texts

    @property
    def group_ident(self):
        return re.sub(r"\W.*", "", self.group)


@dataclass
class Family:
    """Equal fields numbered 1..count: where field x is."""

    ident: str
    fields: list
    per_register: int = 0
    stride: int = 0
    lsb_step: int = 0

    def __post_init__(self):
        first = self.fields[0]
        self.per_register = sum(f.address == first.address for f in self.fields)
        if len(self.fields) > self.per_register:
            self.stride = self.fields[self.per_register].address - first.address
        if self.per_register > 1:
            self.lsb_step = self.fields[1].lsb - first.lsb
        for i, f in enumerate(self.fields):
            expected = (
                first.address + self.stride * (i // self.per_register),
                first.lsb + self.lsb_step * (i % self.per_register),
            )
            if (f.address, f.lsb) != expected or f.index != i + 1:
                raise ValueError(f"{f.name} breaks the regular layout of {self.ident}")

    @property
    def first(self):
        return self.fields[0]

    @property
    def count(self):
        return len(self.fields)

    def c_formula(self, text, step, n):
        return f"({text} + {step}U * {n})" if step else text

    def c_address(self, base):
        n = "((x) - 1U)" if self.per_register == 1 else f"(((x) - 1U) / {self.per_register}U)"
        return self.c_formula(base, self.stride, n)

    @property
    def c_shift(self):
        return self.c_formula(f"{self.first.lsb}U", self.lsb_step, f"(((x) - 1U) % {self.per_register}U)")


@dataclass
class Block:
    """An array of equal groups of registers."""

    ident: str
    title: str
    address: int
    count: int
    stride: int
    registers: list = field(default_factory=list)


@dataclass
class Map:
    """What the templates see."""

    name: str
    top: object  # of the compiler
    address_width: int
    register_width: int
    registers: list = field(default_factory=list)
    alternate_registers: list = field(default_factory=list)
    fields: list = field(default_factory=list)  # first meanings, every element of every array
    alternate_fields: list = field(default_factory=list)
    blocks: list = field(default_factory=list)
    enums: list = field(default_factory=list)

    def text(self, name, default=""):
        return self.top.get_property(name, default=default)

    @property
    def prefix(self):
        return self.text("prefix", self.name)

    @property
    def namespace(self):
        return self.text("cpp_namespace", f"{self.prefix}::regs")

    @property
    def title(self):
        return self.text("name")

    @property
    def numbers(self):
        return self.text("numbers", [])

    @property
    def command_lists(self):
        return self.text("command_lists", [])

    # Forms of addresses (a) and register values (v).

    def hex(self, address):
        return f"0x{address:0{(self.address_width + 3) // 4}X}"

    def value_hex(self, value):
        return f"0x{value:0{self.register_width // 4}X}"

    def sv_a(self, address):
        return f"{self.address_width}'h{self.hex(address)[2:]}"

    def sv_v(self, value):
        return f"{self.register_width}'h{self.value_hex(value)[2:]}"

    @property
    def a_type(self):
        return f"std::uint{size_for(self.address_width)}_t"

    @property
    def v_type(self):
        return f"std::uint{self.register_width}_t"

    @property
    def c_suffix(self):
        """Behind a C constant in place; int may have 16 bits."""
        return "U" if self.register_width < 16 else "UL"

    @property
    def lower_case_example(self):
        """A field whose name is not all capitals."""
        return next((f.ident for f in self.fields if f.ident != f.ident.upper() and f.index is None), None)

    @property
    def cited(self):
        """Do fields name a page of a datasheet?"""
        return any(f.page is not None for f in self.fields)

    @property
    def kinds(self):
        """Kinds of access in use."""
        used = {f.access for f in self.fields + self.alternate_fields}
        return [kind for key, kind in ACCESS.items() if key in used]

    @property
    def all_registers(self):
        return sorted(self.registers + self.alternate_registers, key=lambda r: (r.address, r.alternate))

    @property
    def addresses(self):
        """Registers that get an address constant of their own."""
        known = {r.ident for r in self.registers}
        return [r for r in self.all_registers if not r.block and not (r.alternate and r.ident in known)]

    @property
    def arrays(self):
        """Registers and words that occur several times."""
        return [r for r in self.registers if not r.block and r.count > 1]

    @property
    def words(self):
        return [r for r in self.arrays if r.parts > 1]

    @property
    def sections(self):
        """(heading, registers) in the order of the addresses."""
        found = {}
        for r in self.registers:
            found.setdefault(r.section, []).append(r)
        return list(found.items())

    @property
    def gaps(self):
        """Reserved addresses as (first, last)."""
        used = {f.address for f in self.fields}
        step = self.register_width // 8
        free = {a for a in range(0, 2**self.address_width, step) if a not in used}
        firsts = sorted(a for a in free if a - step not in free)
        lasts = sorted(a for a in free if a + step not in free)
        return list(zip(firsts, lasts))

    @property
    def families(self):
        groups = {}
        for f in self.fields + self.alternate_fields:
            if f.index is not None and f.part is None and f.access != "rom":
                groups.setdefault(f.ident, []).append(f)
        families = [Family(k, sorted(v, key=lambda f: f.index)) for k, v in groups.items()]
        return sorted(families, key=lambda f: (f.first.address, -f.first.lsb))

    @property
    def singles(self):
        return [f for f in self.fields + self.alternate_fields if f.index is None and f.access != "rom"]

    @property
    def places(self):
        """(name, lowest bit, codes) of the coded fields whose place does not depend on a number."""
        fields = [(f.ident, f) for f in self.singles]
        for family in self.families:
            if family.lsb_step == 0:
                fields.append((family.ident, family.first))
            elif family.count == 2:
                fields += [(f"{family.ident}{f.index}", f) for f in family.fields]
        return [(n, f.lsb, e) for n, f in fields for e in self.enums if {f.ident, f.ident + "x"} & set(e.users)]

    @property
    def words_by_address(self):
        """(name, title, address, fields) of every register, each element of an array by itself."""
        named = {
            r.address + i * r.stride: (r.ident + (str(i + 1) if r.count > 1 else ""), r.title)
            for r in self.registers
            for i in range(r.count)
        }
        words = {}
        for f in self.fields:
            words.setdefault(f.address, []).append(f)
        unnamed = ("WORD_{:X}", "Element of an array in an array")
        return [
            (*(text.format(address) for text in named.get(address, unnamed)), address, fields)
            for address, fields in sorted(words.items())
        ]

    @property
    def code_table(self):
        """Each list of codes once, and its place in the sum of all: (codes, {str(codes): first})."""
        table, places = [], {}
        for f in self.fields + self.alternate_fields:
            if f.codes and f.access != "rom" and str(f.codes) not in places:
                places[str(f.codes)] = len(table)
                table += f.codes
        return table, places

    @property
    def groups(self):
        """Whole registers that the datasheet also names: (identifier, register)."""
        taken = {f.ident for f in self.families}
        return [
            (r.group_ident + ("_ALL" if r.group_ident in taken else ""), r) for r in self.all_registers if r.group
        ]


# ---- RDL to model --------------------------------------------------------------------------------


def indices(node):
    """Array indices on the way to a node, outermost first."""
    found = []
    while node is not None:
        if getattr(node, "current_idx", None):
            found = list(node.current_idx) + found
        node = node.parent
    return found


def any_array(node):
    """Is a field part of an array?"""
    while node is not None:
        if getattr(node, "is_array", False):
            return True
        node = node.parent
    return False


def word_of(reg):
    """The regfile whose parts are registers, or None."""
    return reg.parent if isinstance(reg.parent, RegfileNode) and reg.parent.get_property("word", default=False) else None


def register_ident(node):
    return "_".join((word_of(node) or node).get_path_segments(array_suffix="", empty_array_suffix="")[1:])


def access_of(node):
    """Key of ACCESS by what SystemRDL says of reading, writing and the hardware."""
    if node.get_property("constant", default=False):
        return "rom"
    onwrite, onread = node.get_property("onwrite"), node.get_property("onread")
    rule = (
        "r" * node.is_sw_readable + "w" * node.is_sw_writable,
        onwrite.name if onwrite else "",
        onread.name if onread else "",
        bool(node.get_property("hwclr") or node.get_property("singlepulse")),
    )
    for key, kind in ACCESS.items():
        if rule in kind.rules:
            return key
    raise ValueError(f"{node.get_path()}: no kind of access for (sw, onwrite, onread, cleared by hardware) = {rule}")


def codes_of(node):
    codes = [
        {"first": r.first, "last": r.last, "name": "", "word": "", "meaning": r.meaning}
        for r in node.get_property("code_ranges", default=None) or []
    ]
    for m in node.get_property("encode") or []:
        ranges = [c for c in codes if c["first"] == m.value]  # a rule may go on from a named code
        last = ranges[0]["last"] if ranges else m.value
        codes = [c for c in codes if c not in ranges]
        codes.append({"first": m.value, "last": last, "name": m.name, "word": m.rdl_name or m.name,
                      "meaning": m.rdl_desc.rstrip(".")})  # fmt: skip
    return sorted(codes, key=lambda c: (c["first"], c["last"]))


def make_field(node, alternate):
    idx = indices(node.parent)
    family = node.get_property("family", default=None)
    ident, index = node.inst_name, None
    name = node.get_property("ds_name", default=node.inst_name)
    if family:
        ident, index = family, int(node.inst_name[len(family):])
    elif idx:
        index = idx[0] + 1
        name += str(index)
    label = f"{name}({node.width - 1}:0)" if node.width > 1 else name
    part = node.get_property("part_lsb", default=None)
    if part is not None:
        part += node.get_property("part_step", default=0) * idx[-1]
        label = f"{name}({part + node.width - 1}:{part})"
        name = label if part % 8 == 0 else name  # bytes are fields of their own, SCRCPOLYx(7:1) is one field
    return Field(
        ident, index, name, label, node.parent.absolute_address, node.low, node.width, access_of(node),
        node.get_property("reset") or 0, node.get_property("ds_table", default=None),
        node.get_property("ds_page", default=None), node.get_property("desc") or "",
        node.get_property("used_when", default=""), codes_of(node), alternate,
        idx[-1] if word_of(node.parent) else None,
    )  # fmt: skip


def make_registers(model, top, alternate):
    registers, fields, section = [], [], "All registers"
    for reg in top.descendants(unroll=True):
        if isinstance(reg, FieldNode):
            continue
        section = reg.get_property("section", default=section)
        if not isinstance(reg, RegNode):
            continue
        if reg.get_property("regwidth") != model.register_width:
            raise ValueError(f"{reg.get_path()}: all registers of a map have the same width")
        made = sorted((make_field(f, alternate) for f in reg.fields()), key=lambda f: -f.lsb)
        fields += made
        if any(indices(reg)):
            continue  # only the first element of an array becomes a Register
        whole = word_of(reg) or reg
        array = whole if whole.is_array else reg.parent
        is_array = getattr(array, "is_array", False)
        block = ""
        if is_array and array is not whole:
            block = array.inst_name
            if not alternate and block not in {b.ident for b in model.blocks}:
                model.blocks.append(
                    Block(block, array.get_property("name"), array.absolute_address, array.array_dimensions[0],
                          array.array_stride)
                )  # fmt: skip
        registers.append(
            Register(
                register_ident(reg), whole.get_property("name"), whole.get_property("desc") or "", section,
                reg.absolute_address, reg.get_property("group", default=""),
                array.array_dimensions[0] if is_array else 1, array.array_stride if is_array else 0, alternate,
                block, reg.array_dimensions[0] if whole is not reg else 1, model, made,
            )  # fmt: skip
        )
        if block and not alternate:
            next(b for b in model.blocks if b.ident == block).registers.append(registers[-1])
    return registers, fields


@dataclass
class Enum:
    name: str
    width: int
    members: list
    users: list  # fields it encodes

    @property
    def type(self):
        return camel(self.name.removesuffix("_e"))

    @property
    def prefix(self):
        return self.name.removesuffix("_e").upper()


def enums_of(nodes):
    """Code lists in order of first use."""
    found = {}
    for top in nodes:
        for node in top.descendants(unroll=False):
            enum = node.get_property("encode") if isinstance(node, FieldNode) else None
            if enum:
                made = found.setdefault(enum.type_name, Enum(enum.type_name, node.width, list(enum), []))
                family = node.get_property("family", default=node.inst_name if any_array(node) else None)
                user = family + "x" if family else node.inst_name
                if user not in made.users:
                    made.users.append(user)
    return list(found.values())


def version():
    """The project's version, as CMakeLists.txt has it."""
    cmake = (HERE.parents[1] / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(openmb4 VERSION ([\d.]+)", cmake)[1]


def version_macros():
    """Macros that a map may use: VERSION_MAJOR, VERSION_MINOR, VERSION_PATCH."""
    return dict(zip(("VERSION_MAJOR", "VERSION_MINOR", "VERSION_PATCH"), version().split(".")))


def load(rdl):
    """The map of one file: addrmap NAME and, where bits have a second meaning, addrmap NAME_alternate."""
    compiler = RDLCompiler()
    compiler.compile_file(str(rdl), incl_search_paths=[str(HERE)], defines=version_macros())
    name = rdl.stem
    names = [n for n in (name, f"{name}_alternate") if n in compiler.root.comp_defs]
    if name not in names:
        raise ValueError(f"{rdl}: no addrmap {name}")
    tops = [compiler.elaborate(n).top for n in names]
    first = next(n for n in tops[0].descendants() if isinstance(n, RegNode))
    model = Map(
        name, tops[0],
        tops[0].get_property("address_width", default=size_for((tops[0].size - 1).bit_length())),
        first.get_property("regwidth"),
    )  # fmt: skip
    if model.register_width not in (8, 16, 32) or 2**model.address_width < tops[0].size:
        raise ValueError(f"{rdl}: registers have 8, 16 or 32 bits, and addresses reach all of them")
    model.registers, model.fields = make_registers(model, tops[0], False)
    for top in tops[1:]:
        model.alternate_registers, model.alternate_fields = make_registers(model, top, True)
    for a in model.alternate_fields:
        for f in model.fields:
            if f.overlaps(a):
                f.others.append(a)
                a.others.append(f)
    for a in model.alternate_registers:
        for r in model.registers:
            if r.address == a.address:
                r.others, r.others_group = a.fields, a.group
    model.enums = enums_of(tops)
    return model, tops
