#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Counts what one good read costs the processor: runs cyclic.c in QEMU instruction by instruction.

  cycles.py TARGET CRC INCLUDE_DIR...  TARGET: cortex-m0plus (-Os, cycles), cortex-m4 (-O2,
                                       instructions); CRC: bits, table
  cycles.py TARGET steps INCLUDE_DIR...  the longest plan and finish of all operations in steps
                                       (operation_main.cpp)
  cycles.py TARGET safety INCLUDE_DIR...  one check of BiSS Safety, a write and a read of a Snapshot
                                       (safety_main.cpp)
  cycles.py TARGET dsl INCLUDE_DIR...  one position of the DSL master: instructions, and its bytes of code
  cycles.py self-test                 the sum can be wrong

The board's own functions are not counted. The cycles are those of the Cortex-M0+ Technical
Reference Manual, table 3-1, with memory without wait states: 1 for arithmetic, 2 for a load or
store and a taken branch, 3 for BL, 1 + N for PUSH, POP, LDM and STM of N registers, 2 more where
POP loads PC. Limits: budget.toml. Exit status 77: a tool is missing.
"""

import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
SKIPPED = 77
TARGETS = {"cortex-m0plus": ("mps2-an385", "-Os", "cycles"),
           "cortex-m4": ("mps2-an386", "-O2", "instructions")}
LINK = """MEMORY { code (rx) : ORIGIN = 0, LENGTH = 64K  ram (rw) : ORIGIN = 0x20000000, LENGTH = 64K }
SECTIONS { .text : { KEEP(*(.vectors)) *(.text*) *(.rodata*) } > code
  .data : { *(.data*) *(.bss*) *(COMMON) } > ram
  stack_top = ORIGIN(ram) + LENGTH(ram); }
"""


def run(command, **kwargs):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, **kwargs)
    if done.returncode != 0:
        sys.exit(f"{done.stdout}{done.stderr}{' '.join(map(str, command))}: exit {done.returncode}")
    return done.stdout


def registers(operands):
    """Number of registers in {r0, r4-r7, lr}."""
    count = 0
    for part in re.search(r"\{(.*)\}", operands).group(1).split(","):
        ends = re.findall(r"r(\d+)", part)
        count += int(ends[1]) - int(ends[0]) + 1 if len(ends) == 2 else 1
    return count


def cost(mnemonic, operands, jumps):
    name = mnemonic.split(".")[0]
    if name == "bl":
        return 3
    if name in ("push", "pop", "ldmia", "stmia", "ldm", "stm"):
        return 1 + registers(operands) + (2 if name == "pop" and "pc" in operands else 0)
    if name.startswith(("ldr", "str")):
        return 2
    if name in ("bx", "blx"):
        return 2
    return 2 if jumps else 1


def text_bytes(listing):
    """Bytes of code and constants in the output of size -A."""
    return sum(int(line.split()[1]) for line in listing.splitlines()
               if line.startswith((".text", ".rodata")))


def functions(listing):
    """{address: (function, mnemonic, operands, next address)} of objdump -d."""
    found = {}
    name = ""
    for line in listing.splitlines():
        title = re.match(r"^[0-9a-f]+ <(\S+)>:", line)
        if title:
            name = title.group(1)
        code = re.match(r"^\s*([0-9a-f]+):\t([0-9a-f ]+)\t(\S+)\s*(.*)", line)
        if code:
            address = int(code.group(1), 16)
            size = len(code.group(2).replace(" ", "")) // 2
            found[address] = (name, code.group(3), code.group(4), address + size)
    return found


def count(trace, code):
    """(instructions, cycles, {function: instructions}) from the entry of firmware to its return."""
    begin = next(address for address, line in code.items() if line[0] == "firmware")
    start = len(trace) - 1 - trace[::-1].index(begin)  # the last call
    steps = cycles = 0
    each = {}
    for here, after in zip(trace[start:], trace[start + 1:]):
        name, mnemonic, operands, following = code[here]
        if name in ("reset", "<reset>"):
            return steps, cycles, each
        if name.startswith("board_"):
            continue
        steps += 1
        cycles += cost(mnemonic, operands, after != following)
        each[name] = each.get(name, 0) + 1
    sys.exit("firmware does not return")


def longest(trace, code):
    """{function: (cycles, instructions)} of the longest call of each function measured_...()."""
    found = {}
    index = 0
    while index < len(trace):
        name, _, _, _ = code.get(trace[index], ("", "", "", 0))
        title = re.search(r"measured_[a-z_]+", name)
        # Not where a branch leads back to the begin of the function.
        if not title or index == 0 or code.get(trace[index - 1], name)[0] == name:
            index += 1
            continue
        back = code[trace[index - 1]][3]  # behind the call
        steps = cycles = 0
        while trace[index] != back:
            _, mnemonic, operands, following = code[trace[index]]
            steps += 1
            cycles += cost(mnemonic, operands, trace[index + 1] != following)
            index += 1
        found[title.group()] = max(found.get(title.group(), (0, 0)), (cycles, steps))
    return found


def traced(elf, machine, work):
    run(["qemu-system-arm", "-M", machine, "-nographic", "-semihosting", "-singlestep",
         "-d", "exec,nochain", "-D", work / "trace", "-kernel", elf], timeout=60)
    return [int(found, 16) for found in
            re.findall(r"\[[0-9a-f]+/([0-9a-f]+)/", (work / "trace").read_text())]


# {argument: (program, number of functions measured_...())}
LONGEST = {"steps": ("operation_main.cpp", 6), "safety": ("safety_main.cpp", 3), "dsl": ("dsl_main.cpp", 1)}


def measure_longest(target, what, includes):
    program, functions_wanted = LONGEST[what]
    machine, optimize, unit = TARGETS[target]
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        (work / "link.ld").write_text(LINK)
        run(["arm-none-eabi-g++", f"-mcpu={target}", "-mthumb", "-std=c++17", "-ffreestanding",
             "-fno-exceptions", "-fno-rtti", "-fno-threadsafe-statics", "-ffunction-sections",
             *[f"-I{path}" for path in includes], optimize, "-nostartfiles", "--specs=nano.specs",
             "--specs=nosys.specs", "-Wl,--gc-sections", "-T", work / "link.ld",
             HERE / program, "-o", work / "unit.elf"])
        code = functions(run(["arm-none-eabi-objdump", "-d", work / "unit.elf"]))
        found = longest(traced(work / "unit.elf", machine, work), code)
    if what == "dsl":
        unit = "instructions"
        size = sum(following - address for address, (name, _, _, following) in code.items() if "measured_" in name)
        print(f"{target} {optimize}: {size} bytes of code")
        if size > 1024:
            sys.exit("more than 1 KiB")
    limits = tomllib.loads((HERE / "budget.toml").read_text())["time"][target]
    if len(found) != functions_wanted:
        sys.exit(f"{sorted(found)}: {functions_wanted} functions were to be measured")
    result = 0
    for name, (cycles, steps) in sorted(found.items()):
        value = cycles if unit == "cycles" else steps
        limit = limits[what]
        print(f"{target} {optimize}, {name[9:]}: at most {value} {unit}")
        if value > limit:
            print(f"  more than the budget of {limit}")
            result = 1
    return result


def measure(target, crc, includes):
    for tool in ("qemu-system-arm", "arm-none-eabi-gcc"):
        if not shutil.which(tool):
            print(f"skipped: {tool} is not installed")
            return SKIPPED
    if crc in LONGEST:
        return measure_longest(target, crc, includes)
    machine, optimize, unit = TARGETS[target]
    flags = [f"-mcpu={target}", "-mthumb", "-std=gnu99", "-ffreestanding", "-ffunction-sections",
             *[f"-I{path}" for path in includes]]
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        (work / "link.ld").write_text(LINK)
        parts = "-DPARTS=" + {"bits": "0", "table": "MB4_WITH_TABLE"}[crc]
        run(["arm-none-eabi-gcc", *flags, optimize, parts, "-c", HERE / "cyclic.c", "-o",
             work / "cyclic.o"])
        run(["arm-none-eabi-gcc", *flags, "-O1", parts, "-nostartfiles", "--specs=nosys.specs",
             "-T", work / "link.ld", HERE / "cycles_main.c", work / "cyclic.o", "-o",
             work / "unit.elf"])
        flash = text_bytes(run(["arm-none-eabi-size", "-A", work / "cyclic.o"]))
        code = functions(run(["arm-none-eabi-objdump", "-d", work / "unit.elf"]))
        trace = traced(work / "unit.elf", machine, work)
    steps, cycles, each = count(trace, code)
    print(f"{target} {optimize}, CRC by {crc}: {steps} instructions, {cycles} cycles of a Cortex-M0+")
    for name, value in sorted(each.items(), key=lambda item: -item[1]):
        print(f"  {name}: {value}")
    limits = tomllib.loads((HERE / "budget.toml").read_text())["time"][target]
    limit = limits[crc]
    value = cycles if unit == "cycles" else steps
    if value > limit:
        print(f"{value} {unit}, more than the budget of {limit}")
        return 1
    print(f"  code: {flash} bytes")
    if crc == "table" and flash > limits.get("flash", flash):
        print(f"{flash} bytes of code, more than the budget of {limits['flash']}")
        return 1
    return 0


def self_test():
    assert registers("{r4, r5-r7, lr}") == 5
    assert cost("push", "{r4, lr}", False) == 3 and cost("pop", "{r4, pc}", True) == 5
    assert cost("ldrb", "r0, [r1]", False) == 2 and cost("adds", "", False) == 1
    assert cost("beq.n", "", True) == 2 and cost("beq.n", "", False) == 1
    listing = ("00000000 <firmware>:\n   0:\tb510 \tpush\t{r4, lr}\n   2:\tbd10 \tpop\t{r4, pc}\n"
               "00000010 <reset>:\n  10:\tbf00 \tnop\n")
    assert count([0x10, 0, 2, 0x10, 0x10], functions(listing))[:2] == (2, 8)
    code = functions(listing.replace("firmware", "measured_plan").replace("<reset>:\n", "<reset>:\n   e:\te7f6 \tbl\t0\n"))
    assert longest([0x0E, 0, 2, 0x10, 0x0E, 0, 2, 0x10], code) == {"measured_plan": (8, 2)}
    print("the sum can be wrong")
    return 0


if __name__ == "__main__":
    sys.exit(self_test() if sys.argv[1:] == ["self-test"] else measure(*sys.argv[1:3], sys.argv[3:]))
