#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of `mb4sim plot`: what they show against golden vectors, that their labels can be read,
and that those of the manual are what the command draws.

  plot_test.py MB4SIM ROOT [--write]      --write: draws the manual's pictures again
"""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

MB4SIM, ROOT = sys.argv[1], Path(sys.argv[2])
PICTURES = ROOT / "docs" / "pictures"
GOLDEN = str(ROOT / "tests" / "dropin" / "golden.toml")
SVG = "{http://www.w3.org/2000/svg}"
# Worked examples: read 0x67 of ID 0, which holds 0x5F; write 0x06 to 0x60. Slots 0 to 32.
READ_CDM = "1 1000 1100111 0010 101 00000000 0000 0 0"
READ_CDS = "0 10000000 00000000 10 1 01011111 1111 0"
WRITE_CDM = "1 1000 1100000 1011 011 00000110 0101 0 0"
WRITE_CDS = "0 10000000 00000000 01 1 00000110 0101 0"


def plot(*arguments):
    return subprocess.run([MB4SIM, "plot", *arguments], capture_output=True, text=True, timeout=60,
                          cwd=ROOT, check=False)


def listed():
    """(file, arguments) of the manual's pictures."""
    for line in (PICTURES / "list.txt").read_text(encoding="ascii").splitlines():
        if line and not line.startswith("#"):
            name, arguments, title = (part.strip() for part in line.split("|"))
            yield name, [*arguments.split(), "--title", title]


class Picture:
    def __init__(self, svg):
        self.root = xml.etree.ElementTree.fromstring(svg)
        self.texts = [(float(t.get("x")), float(t.get("y")), t.get("class"), t.text)
                      for t in self.root.iter(SVG + "text")]

    def labels(self):
        return [text for _, _, kind, text in self.texts if kind in ("field", "tight") and text]

    def rows(self):
        """Texts by height, from left to right."""
        rows = {}
        for x, y, kind, text in self.texts:
            if text:
                rows.setdefault(y, []).append((x, kind, text))
        return {y: sorted(row) for y, row in sorted(rows.items())}

    def bits(self):
        """Rows of nothing but 0 and 1, as strings, from top to bottom."""
        return ["".join(text for _, _, text in row) for row in self.rows().values()
                if all(kind == "digit" and text in "01" for _, kind, text in row)]


    def marks(self, kind):
        """Places of the paths of a class: M x y."""
        found = []
        for path in self.root.iter(SVG + "path"):
            place = re.match(r"M([\d.]+) ([\d.]+)", path.get("d"))
            if path.get("class") == kind:
                found.append((float(place.group(1)), float(place.group(2)), path.get("d")))
        return found

    def ticks(self):
        """(x, value) of the axis, from left to right; pictures of one line only."""
        row = list(self.rows().values())[-1]
        return [(x, float(text)) for x, kind, text in row if kind == "digit"]


CELL = 28  # pixels of a period of MA


def crc6(data, bits):
    """0x43, bit by bit."""
    register = 0
    for index in reversed(range(bits)):
        feedback = (data >> index & 1) ^ (register >> 5)
        register = (register << 1 ^ (0x43 if feedback else 0)) & 0x3F
    return register


def width(kind, text):
    """Of the widest usual font, DejaVu Sans: 0.6 of its size a character, measured generously."""
    size = {"title": 15, "note": 12, "name": 12, "digit": 9, "unit": 9, "tight": 9}.get(kind, 10)
    return sum(0.35 if c in "fijlt.,:;|' 1I" else 0.6 for c in text) * size


class Plot(unittest.TestCase):
    def picture(self, *arguments, status=0):
        result = plot(*arguments)
        self.assertEqual(result.returncode, status, result.stderr)
        return Picture(result.stdout)

    def test_frame_shows_the_golden_word(self):
        picture = self.picture(GOLDEN)
        self.assertEqual(picture.labels(), ["CDM = 0", "Ack", "start", "CDS",
                                            "position 0x2ABCDEF (26 bits)", "nE", "nW",
                                            "CRC 0x18 good", "timeout"])
        # Acknowledge, start bit, CDS; data; the inverted CRC 0x27.
        self.assertEqual(picture.bits(), ["010" + "1010101011110011011110111111" + "100111"])
        # N + 5 rising edges.
        numbers = [row for row in picture.rows().values() if row[-1][2] == "39"]
        self.assertEqual([text for _, _, text in numbers[0]],
                         ["1", "2", "3", "5", "10", "15", "20", "25", "30", "35", "39"])
        self.assertIn("39 rising edges", " ".join(t[3] for t in picture.texts))

    def control(self, arguments, cdm, cds):
        picture = self.picture(str(PICTURES / "registers.toml"), *arguments)
        bits = picture.bits()
        self.assertEqual(len(bits), 2)
        # Four cells of zeros stand in front, one behind.
        self.assertEqual(bits[0], "0000" + cdm.replace(" ", "") + "0")
        self.assertEqual(bits[1], "0000" + cds.replace(" ", "") + "0")
        return picture.labels()

    def test_register_access_shows_the_worked_examples(self):
        labels = self.control(["--read", "0x67"], READ_CDM, READ_CDS)
        for label in ("ID 0", "address 0x67", "CRC 0xD good", "data 0x5F", "CRC 0x0 good"):
            self.assertIn(label, labels)
        labels = self.control(["--write", "0x60:6"], WRITE_CDM, WRITE_CDS)
        for label in ("address 0x60", "CRC 0x4 good", "data 0x06", "CRC 0xA good", "echo 0x06"):
            self.assertIn(label, labels)

    def test_ssi_in_gray_code(self):
        # 0x1357 is 0x1AFC in Gray code; monoflop 20 us.
        picture = self.picture(str(PICTURES / "ssi.toml"))
        self.assertEqual(picture.labels(), ["monoflop 20 us", "Gray code 0x1AFC = 0x1357 (13 bits)"])
        self.assertEqual(picture.bits(), [f"{0x1AFC:013b}"])

    def test_biss_b_has_no_cds_and_no_cdm(self):
        # Golden vector: 21 bits 0x15A5A5 have the CRC 0x27, 0x18 on the line.
        picture = self.picture(str(PICTURES / "biss-b.toml"))
        self.assertEqual(picture.labels()[1:], ["start", "position 0x56969 (19 bits)", "nE", "nW",
                                                "CRC 0x27 good", "timeout 16 us"])
        self.assertEqual(picture.bits(), ["0000" + "1" + f"{0x15A5A5:021b}" + f"{0x18:06b}"])

    def test_a_disturbed_frame_is_bad(self):
        picture = self.picture(str(PICTURES / "bad-crc.toml"), status=1)
        data = 0xAB5A3 ^ 1 << 20 - 1 - 7  # resolute-18: 20 bits, the eighth is inverted
        both = f"CRC 0x{crc6(0xAB5A3, 20):02X} wrong, 0x{crc6(data, 20):02X} right"
        self.assertIn(both, picture.labels())
        self.assertIn(both, " ".join(text for _, _, kind, text in picture.texts if kind == "note"))
        self.assertIn("#f6b9b4", [r.get("fill") for r in picture.root.iter(SVG + "rect")])

    def test_a_wrong_crc_shows_both_values_in_narrow_fields_too(self):
        for bits, polynomial in ((1, 0x3), (3, 0xB), (4, 0x13), (5, 0x25)):
            with self.subTest(bits=bits), tempfile.TemporaryDirectory() as folder:
                path = Path(folder, "x.toml")
                path.write_text("[[channel]]\nnumber = 1\nflips = [[1, 2]]\n[[channel.slave]]\n"
                                f"protocol = \"biss-c\"\ndata_bits = 8\ncrc = {polynomial}\n"
                                "data = 0x5A\n", encoding="ascii")
                picture = self.picture(str(path), status=1)
                notes = " ".join(text for _, _, kind, text in picture.texts if kind == "note")
                got, right = re.search(r"CRC 0x(\w+) wrong, 0x(\w+) right", notes).groups()
                self.assertNotEqual(got, right)
                if bits >= 3:
                    self.assertTrue([label for label in picture.labels()
                                     if f"0x{got}" in label and f"0x{right}" in label])
                self.readable(picture)

    def test_the_monoflop_begins_with_the_last_falling_edge(self):
        picture = self.picture(str(PICTURES / "ssi.toml"))
        ma = picture.marks("wave")[0]
        low = max(float(y) for y in re.findall(r"V([\d.]+)", ma[2]))
        last = [float(x) for x, y in re.findall(r"H([\d.]+)V([\d.]+)", ma[2]) if float(y) == low][-1]
        box = next(r for r in picture.root.iter(SVG + "rect") if r.get("stroke-dasharray"))
        self.assertAlmostEqual(float(box.get("x")), last, delta=0.2)

    def test_a_rest_is_true_to_scale_up_to_its_cut_and_behind_it(self):
        for name, period in (("ssi", 1.0), ("biss-b", 0.4)):
            picture = self.picture(str(PICTURES / f"{name}.toml"))
            cut = picture.marks("cutline")[0][0] + 2.5  # the middle of what is left white
            ticks = picture.ticks()
            before = [tick for tick in ticks if tick[0] < cut]
            for x, t in before:
                self.assertAlmostEqual(x - before[0][0], t / period * CELL, delta=0.2)
            # Three periods before the cut the last bit begins or MA has its last edge, three behind
            # it is the end.
            edges = [float(x) for x in re.findall(r"H([\d.]+)V", picture.marks("wave")[0][2])]
            self.assertAlmostEqual(cut - edges[-1], 3 * CELL, delta=CELL)
            notes = " ".join(text for _, _, kind, text in picture.texts if kind == "note")
            end = float(re.search(r"MA, ([\d.]+) us", notes).group(1))
            self.assertEqual([t for x, t in ticks if x > cut], [end])
            self.assertAlmostEqual(ticks[-1][0] - cut, 3 * CELL, delta=0.2)

    def test_the_manual_shows_what_the_command_draws(self):
        names = set()
        for name, arguments in listed():
            with self.subTest(name=name):
                names.add(name)
                drawn = plot(*arguments)
                self.assertEqual(drawn.stdout, (PICTURES / name).read_text(encoding="utf-8"))
                self.assertEqual(drawn.returncode, 1 if "bad" in name else 0, drawn.stderr)
        # `sweep` draws the eye; CONTRIBUTING's commands compare it.
        self.assertEqual(names | {"axi-eye.svg", "eye.svg", "dsl-eye.svg", "samplers.svg"}, {path.name for path in PICTURES.glob("*.svg")})

    def test_no_label_overlaps_another_or_leaves_the_picture(self):
        extra = [[GOLDEN], ["examples/two-channels.toml", "--channel", "2"],
                 ["examples/control-bus.toml"],
                 ["docs/pictures/registers.toml", "--read", "0x78:6"],
                 ["docs/pictures/registers.toml", "--read", "0:64"],
                 ["docs/pictures/registers.toml", "--write", "0:" + ",".join(["0xA5"] * 64)],
                 [GOLDEN, "--title", 9 * "A title that is far longer than the picture. "]]
        for arguments in [arguments for _, arguments in listed()] + extra:
            with self.subTest(arguments=arguments):
                self.readable(Picture(plot(*arguments).stdout))

    def test_the_axis_keeps_its_title_free_of_ticks(self):
        """Also where a line of the picture begins with a tick."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "x.toml")
            for bits in range(40, 65):
                # A period is 2/11 us: long numbers.
                path.write_text("[chip]\nf_clk_hz = 11_000_000\n[[channel]]\nnumber = 1\n"
                                "[[channel.slave]]\nprotocol = \"biss-c\"\n"
                                f"data_bits = {bits}\n", encoding="ascii")
                with self.subTest(bits=bits):
                    self.readable(self.picture(str(path)))

    def readable(self, picture):
        right = float(picture.root.get("width"))
        boxes = []
        for x, y, kind, text in picture.texts:
            if not text:
                continue
            wide = width(kind, text)
            left = {"title": x, "note": x, "name": x - wide, "unit": x - wide}.get(kind, x - wide / 2)
            high = {"title": 15, "note": 12, "name": 12}.get(kind, 9)
            self.assertGreaterEqual(left + 0.5, 0, text)
            self.assertLessEqual(left + wide, right, text)
            # Letters reach from three quarters of the font's size above the line to a quarter below.
            boxes.append((left, left + wide, y - 0.75 * high, y + 0.25 * high, text))
        boxes.sort()
        for i, (_, end, top, bottom, text) in enumerate(boxes):
            for left, _, other_top, other_bottom, other in boxes[i + 1:]:
                if left + 0.5 >= end:
                    break
                self.assertFalse(top < other_bottom and other_top < bottom, f"{text} / {other}")
        for rect in picture.root.iter(SVG + "rect"):
            if rect.get("x") and rect.get("class") is None:
                self.assertLessEqual(float(rect.get("x")) + float(rect.get("width")), right)

    def test_vcd_has_the_edges(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "line.vcd")
            self.assertEqual(plot(GOLDEN, "--vcd", str(path)).returncode, 0)
            vcd = path.read_text(encoding="ascii")
        codes = dict(re.findall(r"\$var wire 1 (\S) (\S+) \$end", vcd))
        self.assertEqual(sorted(codes.values()), ["MA1", "MO1", "SL1"])
        ma = next(code for code, name in codes.items() if name == "MA1")
        body = vcd.split("$enddefinitions $end\n#0\n", 1)[1]
        self.assertEqual(body.count(f"\n0{ma}\n"), 39)

    def wavejson(self, *arguments, status=0):
        """The signals of the picture as WaveJSON: {name: (states of each tick, [(tick, label), ...])}."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "frame.json")
            result = plot(*arguments, "--wavejson", str(path))
            self.assertEqual((result.returncode, result.stdout), (status, ""), result.stderr)
            found = json.loads(path.read_text(encoding="utf-8"))
        self.assertEqual(set(found), {"signal", "head", "foot"})
        rows = []
        for signal in found["signal"]:
            states, boxes, labels = "", [], signal.get("data", [])
            for tick, state in enumerate(signal["wave"]):
                self.assertIn(state, "01z.|2345679")
                if state in "2345679":
                    boxes.append((tick, labels[len(boxes)]))
                states += states[-1] if state in ".|" else state
            self.assertEqual(len(boxes), len(labels), signal)
            rows.append((signal["name"], states, boxes))
        self.assertEqual(len({len(states) for _, states, _ in rows}), 1, "signals of one length")
        return rows

    def test_wavejson_has_the_golden_word(self):
        rows = self.wavejson(GOLDEN)
        names = [name for name, _, _ in rows if name]
        self.assertEqual(names, ["MA", "SL"])
        ma = next(states for name, states, _ in rows if name == "MA")
        self.assertEqual(len(re.findall("1+0", ma)), 39)
        sl = next(states for name, states, _ in rows if name == "SL")
        boxes = rows[-1][2]
        # Four ticks a period: each bit in its middle, from the start bit on.
        start = next(tick for tick, label in boxes if label == "start")
        bits = "".join(sl[start + 2 + 4 * i] for i in range(2 + 28 + 6))
        self.assertEqual(bits, f"10{0xAAF37BF:028b}100111")  # the published CRC 0x18, inverted
        labels = [label for _, label in boxes]
        self.assertEqual(labels[:3], ["Ack", "start", "CDS"])
        self.assertTrue(any("0x2ABCDEF" in label for label in labels), labels)

    def test_wavejson_of_an_access_has_a_tick_a_frame(self):
        rows = self.wavejson("docs/pictures/registers.toml", "--read", "0x67")
        cdm, cds = (next(states for name, states, _ in rows if name == wanted) for wanted in ("CDM", "CDS"))
        self.assertIn(READ_CDM.replace(" ", ""), cdm)
        self.assertIn(READ_CDS.replace(" ", ""), cds)

    def test_wavejson_of_a_wrong_crc_is_red_and_of_a_rest_has_a_gap(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "a.json")
            self.assertEqual(plot("docs/pictures/bad-crc.toml", "--wavejson", str(path)).returncode, 1)
            self.assertRegex(path.read_text(encoding="utf-8"), '"wave": "[^"]*9')
            self.assertEqual(plot("docs/pictures/chain.toml", "--wavejson", str(path)).returncode, 0)
            waves = re.findall('"wave": "([^"]*)"', path.read_text(encoding="utf-8"))
            self.assertTrue(all("|" in wave for wave in waves), waves)

    def test_wrong_use(self):
        registers = "docs/pictures/registers.toml"
        for arguments in ([], ["nothing.toml"], [GOLDEN, "--frame", "0"],
                          [GOLDEN, "--channel", "2"],
                          [registers, "--read", "0x80"], [registers, "--read", "1:65"],
                          [registers, "--read", "1:"], [registers, "--write", "1"],
                          [registers, "--write", "1:256"], [registers, "--command", "4"],
                          [registers, "--command", "0:9"],
                          [registers, "--read", "1", "--write", "1:1"],
                          [GOLDEN, "--svg", GOLDEN], [GOLDEN, "--wavejson", GOLDEN], [GOLDEN, "--svg", "/no/folder/x.svg"]):
            with self.subTest(arguments=arguments):
                result = plot(*arguments)
                self.assertEqual(result.returncode, 2)
                self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
                self.assertEqual(result.stdout, "")

    def test_a_printer_can_draw_them(self):
        if shutil.which("rsvg-convert") is None:
            self.skipTest("rsvg-convert (librsvg2-bin) is not installed")
        for name, _ in listed():
            done = subprocess.run(["rsvg-convert", "-f", "pdf", str(PICTURES / name)],
                                  capture_output=True, timeout=60, check=False)
            self.assertEqual((done.returncode, done.stdout[:4]), (0, b"%PDF"), name)


if __name__ == "__main__":
    if sys.argv[3:] == ["--write"]:
        for file, command in listed():
            (PICTURES / file).write_text(plot(*command).stdout, encoding="utf-8")
    else:
        unittest.main(argv=sys.argv[:1])
