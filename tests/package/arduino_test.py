#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The library for Arduino and PlatformIO has what both tools ask for; its sketches compile for their
boards and read true positions from the simulated chip.

  arduino_test.py LIBMB4SIM CC CXX    exit status 77: avr-gcc or arm-none-eabi-g++ is missing

Without Arduino's own builder the test does its part: it hands src/ to the compiler as include folder
and compiles the .ino as C++ and each .c beside it as C."""

import json
import shutil
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

import programs
from programs import ROOT, call

STUB = Path(__file__).resolve().parent / "arduino"
CORE = Path("/usr/share/arduino/hardware/arduino/avr")
LIBRARY, CC, CXX = Path(sys.argv[1]).resolve(), sys.argv[2], sys.argv[3]
WARNINGS = ["-Wall", "-Wextra", "-Werror"]
CHIP_SKETCHES = {"PositionAvr", "Positions"}
SKETCHES = CHIP_SKETCHES | {"BissSpi"}
SCENARIO = """[chip]
f_clk_hz = 0
[host]
sclk_hz = 4_000_000
[[channel]]
number = 1
[[channel.slave]]
protocol = "biss-c"
data_bits = 28
data = {data}
"""
BISS_SPI = """[master]
type = "axi"
[chip]
f_clk_hz = 48_000_000
[host]
interface = "spi"
sclk_hz = 4_000_000
[[channel]]
number = 1
[[channel.slave]]
protocol = "biss-c"
data_bits = 28
data = {data}
[[channel]]
number = 2
[[channel.slave]]
protocol = "biss-c"
data_bits = 28
data = 15
"""


class Library(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.work = Path(cls.folder.name)
        archive = call(sys.executable, "-B", ROOT / "tools/arduino.py", cls.work).strip()
        cls.bytes = Path(archive).read_bytes()
        with zipfile.ZipFile(archive) as opened:
            opened.extractall(cls.work)
        cls.library = cls.work / "openmb4"

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def lines_of(self, name, scenario):
        """What the sketch prints in four calls of loop() on the simulated chip."""
        program = self.work / f"{name}-program"
        if not program.exists():
            objects = self.build(name, CC, CXX, [], "-std=c++17", [STUB])
            call(CXX, "-std=c++17", *WARNINGS, f"-I{STUB}", f"-I{ROOT / 'sim/include'}",
                STUB / "board.cpp", *objects, LIBRARY, f"-Wl,-rpath,{LIBRARY.parent}", "-o", program)
        path = self.work / "scenario.toml"
        path.write_text(scenario)
        return call(program, path, "4").splitlines()

    def build(self, name, cc, cxx, flags, standard, includes):
        """Compiles a sketch; returns its objects."""
        sketch = self.library / "examples" / name
        objects = []
        for path in sorted(sketch.iterdir()):
            out = self.work / f"{name}-{path.name}.o"
            folders = [f"-I{one}" for one in (*includes, self.library / "src", sketch)]
            if path.suffix == ".ino":
                call(cxx, "-x", "c++", standard, *WARNINGS, *flags, *folders, "-c", path, "-o", out)
            elif path.suffix == ".c":
                call(cc, "-std=c99", "-Wpedantic", *WARNINGS, *flags, *folders, "-c", path, "-o", out)
            else:
                continue
            objects.append(out)
        return objects

    def test_archive_is_what_the_tools_expect(self):
        version = programs.version()
        pairs = dict(line.split("=", 1) for line in
                     (self.library / "library.properties").read_text().splitlines())
        # Arduino's library specification 1.5 asks for these.
        self.assertLessEqual({"name", "version", "author", "maintainer", "sentence", "paragraph",
                              "category", "url", "architectures"}, set(pairs))
        described = json.loads((self.library / "library.json").read_text())
        for found in (pairs, described):
            self.assertEqual((found["name"], found["version"]), ("openmb4", version))
        self.assertTrue((self.library / "src" / pairs["includes"]).is_file())
        self.assertTrue((self.library / "src" / described["headers"]).is_file())
        self.assertEqual({path.name for path in (self.library / "examples").iterdir()}, SKETCHES)
        for name in SKETCHES:
            self.assertTrue((self.library / "examples" / name / f"{name}.ino").is_file())
        for name in described["export"]["include"]:
            self.assertTrue((self.library / name).exists(), name)

    def test_same_sources_give_the_same_bytes(self):
        again = call(sys.executable, "-B", ROOT / "tools/arduino.py", self.work / "again").strip()
        self.assertEqual(Path(again).read_bytes(), self.bytes)

    def test_sketch_for_avr_compiles_with_arduinos_core(self):
        flags = ["-mmcu=atmega328p", "-DF_CPU=16000000L", "-DARDUINO=10800", "-Os",
                 "-fno-exceptions", "-Wno-error"]  # the core has warnings
        core = [f"-I{CORE / part}" for part in ("cores/arduino", "variants/standard",
                                                      "libraries/SPI/src")]
        objects = self.build("PositionAvr", "avr-gcc", "avr-g++", flags + core, "-std=gnu++11", [])
        self.assertEqual(len(objects), 2)
        text, data, bss = map(int, call("avr-size", "--totals", *objects).splitlines()[-1].split()[:3])
        self.assertLess(text + data, 8 * 1024)  # an Uno has 32 KiB, and 2 KiB of RAM
        self.assertLess(data + bss, 512)

    def test_sketches_compile_for_arm(self):
        flags = ["-mcpu=cortex-m0plus", "-mthumb", "-Os", "-fno-exceptions"]
        for name in SKETCHES:
            self.build(name, "arm-none-eabi-gcc", "arm-none-eabi-g++", flags, "-std=gnu++17", [STUB])

    def test_sketches_read_the_word_of_the_encoder(self):
        for name in CHIP_SKETCHES:
            for word in (0x2ABCDEF, 0xFFFFFFF):
                lines = self.lines_of(name, SCENARIO.format(data=hex(word)))
                self.assertEqual(lines[1:], [str(word >> 2)] * 3, name)

    def test_sketches_give_no_position_of_an_encoder_that_reports_an_error(self):
        for name in CHIP_SKETCHES:
            for word in (0x2ABCDED, 0xFFFFFFC, 1):
                lines = self.lines_of(name, SCENARIO.format(data=hex(word)))
                self.assertTrue(all("encoder reports an error" in line for line in lines[1:]), lines)
                self.assertNotIn(str(word >> 2), lines)

    def test_sketch_of_biss_spi_reads_both_encoders(self):
        lines = self.lines_of("BissSpi", BISS_SPI.format(data=0x2ABCDEF))
        self.assertEqual(lines, [str(0x2ABCDEF >> 2), "3"] * 4)
        lines = self.lines_of("BissSpi", BISS_SPI.format(data=0x2ABCDED))
        self.assertEqual(lines, ["the encoder reports an error", "3"] * 4)
        silent = '[[fault]]\nkind = "silent"\nslave = 1\nat_us = 0\nfor_us = 10_000_000\n'
        self.assertEqual(self.lines_of("BissSpi", BISS_SPI.format(data=3) + silent), ["no word", "3"] * 4)

    def test_sketches_tell_an_encoder_that_is_silent(self):
        silent = '[[fault]]\nkind = "silent"\nslave = 1\nat_us = 0\nfor_us = 10_000_000\n'
        for name in CHIP_SKETCHES:
            lines = self.lines_of(name, SCENARIO.format(data=3) + silent)
            self.assertRegex(lines[-1], "^(error|frame did not end in time)$", name)


if __name__ == "__main__":
    if missing := [tool for tool in ("avr-g++", "arm-none-eabi-g++") if not shutil.which(tool)]:
        print(f"skipped: {', '.join(missing)} not installed (tools/setup.sh test installs it)")
        sys.exit(77)
    if not CORE.exists():
        print("skipped: arduino-core-avr is not installed (tools/setup.sh test installs it)")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
