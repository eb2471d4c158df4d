#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The examples of examples/mcu/ compile without a warning for the cores that they are for.

  mcu_size.py PORT CORE     compiles the example of PORT and prints its size, which docs/boards.md has to 2 %
  mcu_size.py files         no example has more than 40 lines of code; the files for the builds name what exists

Debian has no compiler for Xtensa: an ESP32 is checked as an ESP32-C3, whose core is RISC-V.
Exit status 77: the compiler is missing.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
sys.path.insert(0, str(HERE.parent / "footprint"))

import footprint  # noqa: E402

EXAMPLES = {"stm32": "stm32/encoder.cpp", "pico": "pico/main.cpp", "esp_idf": "esp_idf/main/main.cpp"}
ARM, RISCV = ("arm-none-eabi-", "--specs=nano.specs"), ("riscv64-unknown-elf-", "--specs=picolibc.specs")
CORES = {
    "cortex-m0plus": (ARM, ["-mcpu=cortex-m0plus", "-mthumb"], 0),
    "cortex-m4": (ARM, ["-mcpu=cortex-m4", "-mthumb"], 4),
    "cortex-m7": (ARM, ["-mcpu=cortex-m7", "-mthumb"], 7),
    "cortex-m33": (ARM, ["-mcpu=cortex-m33", "-mthumb"], 33),
    "rv32imc": (RISCV, ["-march=rv32imc", "-mabi=ilp32"], 0),
    "rv32imac": (RISCV, ["-march=rv32imac", "-mabi=ilp32"], 0),
}
# The cores in docs/boards.md.
NAMES = {"cortex-m0plus": "Cortex-M0+", "cortex-m4": "Cortex-M4", "cortex-m7": "Cortex-M7", "cortex-m33": "Cortex-M33",
         "rv32imc": "RV32IMC", "rv32imac": "RV32IMAC"}
FLAGS = ("-std=c++17 -Os -fno-exceptions -fno-rtti -fno-threadsafe-statics -ffunction-sections "
         "-fdata-sections -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror").split()
LINES = 40


def of_the_page(port, core):
    """The bytes of flash in docs/boards.md."""
    text = (ROOT / "docs/boards.md").read_text(encoding="utf-8")
    return int(re.search(rf"^\| {port} \| {re.escape(NAMES[core])}(?: \([^)]*\))? \| (\d+) \|$", text, re.MULTILINE)[1])


def compile_for(port, core):
    (prefix, specs), flags, number = CORES[core]
    if not shutil.which(prefix + "g++"):
        footprint.skip(f"{prefix}g++ is not installed")
    includes = [f"-I{ROOT / 'drivers/include'}", f"-I{ROOT / 'regmap/generated/mb4'}", f"-I{HERE / port}"]
    # All clocks of a port, used by its example or not. The HAL of some families has const, of others not.
    uses = {"stm32": "std::uint32_t clocks(mb4::ports::Timer16Clock& a) {\n#ifdef DWT_CTRL_CYCCNTENA_Msk\n"
                     "mb4::ports::DwtClock::start(); mb4::ports::DwtClock b; return b.now_us();\n#endif\n"
                     "return a.now_us(); }\n"}
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        example = ROOT / "examples/mcu" / EXAMPLES[port]
        (work / "clocks.cpp").write_text(f'#include "{example}"\n{uses.get(port, "")}', encoding="utf-8")
        command = [prefix + "g++", specs, *flags, *FLAGS, f"-DMB4_TEST_CORE={number}", *includes,
                   *footprint.library_headers(prefix), "-c"]
        footprint.run([*command, work / "clocks.cpp", "-DHAL_CONST=const", "-o", work / "clocks.o"])
        footprint.run([*command, example, "-o", work / "example.o"])
        text, data, bss = footprint.sizes(prefix, work / "example.o")
    print(f"{port} on {core}: {text + data} bytes of flash, {data + bss} bytes of static RAM (printf() "
          "and the vendor's library not counted)")
    page = of_the_page(port, core)
    if abs(text + data - page) > page / 50:
        print(f"docs/boards.md has {page} bytes")
        return 1
    return 0 if data + bss == 0 else 1


def files():
    wrong = 0
    for name in ("drivers/esp_idf/openmb4/CMakeLists.txt", "examples/mcu/esp_idf/CMakeLists.txt",
                 "examples/mcu/pico/CMakeLists.txt"):
        path = ROOT / name
        for place in re.findall(r"(?:/|(?<=\s)|\()((?:\.\./)+[\w/]+)", path.read_text(encoding="utf-8")):
            print(f"{name}: {place}")
            wrong += not (path.parent / place).is_dir()
    headers = re.search(r"INCLUDE_DIRS ([^\n]+)", (ROOT / "drivers/esp_idf/openmb4/CMakeLists.txt").read_text())[1]
    for header in ("mb4/mb4.hpp", "mb4_regs.hpp"):
        wrong += not any((ROOT / "drivers/esp_idf/openmb4" / folder / header).exists() for folder in headers.split())
    for name in EXAMPLES.values():
        text = (ROOT / "examples/mcu" / name).read_text(encoding="utf-8").splitlines()
        code = [line for line in text if line.strip() and not line.startswith("//")]
        print(f"examples/mcu/{name}: {len(code)} lines of code")
        wrong += len(code) > LINES
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(files() if sys.argv[1:] == ["files"] else compile_for(*sys.argv[1:]))
