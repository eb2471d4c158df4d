#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""tools/cmake/steady_model.py on a small module: what is written again, and what keeps its time.

  steady_model_test.py STEADY_MODEL VERILATOR"""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

STEADY, VERILATOR = sys.argv[1:3]
MODULE = """module adder (input logic clk_i, input logic [3:0] a_i, output logic [3:0] b_o);
{comment}  always_ff @(posedge clk_i) begin
    b_o <= a_i + {step};
    sum_is_small: assert (a_i != 4'd9);
  end
endmodule
"""


class SteadyModel(unittest.TestCase):
    def setUp(self):
        self.kept = tempfile.TemporaryDirectory()
        self.addCleanup(self.kept.cleanup)
        self.source = self.enter(Path(self.kept.name) / "adder.sv")
        self.model = Path(self.kept.name) / "model"
        self.model.mkdir()
        self.make()
        self.age()

    def enter(self, path, comment="", step="4'd1"):
        path.write_text(MODULE.format(comment=comment, step=step), encoding="utf-8")
        return path

    def make(self, expected=0):
        done = subprocess.run(
            [sys.executable, "-B", STEADY, VERILATOR, "--cc", "-fno-const-bit-op-tree", "--assert", "--make", "cmake", "--prefix", "Vadder",
             "--top-module", "adder", "--Mdir", str(self.model), str(self.source)],
            check=False, capture_output=True, text=True)
        self.assertEqual(done.returncode == 0, expected == 0, done.stderr)

    def age(self):
        """All files are of a time long ago."""
        for path in self.model.iterdir():
            os.utime(path, (1_000_000_000, 1_000_000_000))

    def new(self):
        return {path.name for path in self.model.iterdir()
                if path.suffix in (".cpp", ".h") and path.stat().st_mtime > 1_000_000_000}

    def lines(self):
        return (self.model / "Vadder__lines.cpp").read_text(encoding="utf-8")

    def test_a_comment_changes_the_table_of_lines_only(self):
        self.assertIn("{4}", self.lines())
        self.enter(self.source, comment="  // one more line\n")
        self.make()
        self.assertEqual(self.new(), {"Vadder__lines.cpp"})
        self.assertIn("{5}", self.lines())

    def test_a_change_renews_the_main_file_and_what_differs(self):
        self.enter(self.source, step="4'd2")
        self.make()
        self.assertIn("Vadder.cpp", self.new())
        self.assertNotIn("Vadder.h", self.new())
        self.assertTrue(any("DepSet" in name for name in self.new()), self.new())

    def test_nothing_changed_writes_nothing(self):
        self.make()
        self.assertEqual(self.new(), set())

    def test_a_lost_file_and_a_spoilt_one_come_back(self):
        lost, spoilt = self.model / "Vadder__Syms.cpp", self.model / "Vadder.cpp"
        right = spoilt.read_text(encoding="utf-8")
        lost.unlink()
        spoilt.write_text("// half a file", encoding="utf-8")
        self.make()
        self.assertTrue(lost.is_file())
        self.assertEqual(spoilt.read_text(encoding="utf-8"), right)

    def test_a_mistake_is_verilators_and_the_next_run_mends_it(self):
        good = self.source.read_text(encoding="utf-8")
        self.source.write_text("module adder (;\n", encoding="utf-8")
        self.make(expected=1)
        self.source.write_text(good, encoding="utf-8")
        self.make()
        self.assertIn("{4}", self.lines())

    def test_a_folder_with_a_space_is_never_taken_for_unchanged(self):
        folder = Path(self.kept.name) / "a b"
        folder.mkdir()
        self.source = self.enter(folder / "adder.sv")
        self.make()
        self.age()
        self.enter(self.source, step="4'd2")
        self.make()
        self.assertIn("Vadder.cpp", self.new())

    def test_the_list_for_cmake_names_the_table(self):
        listing = (self.model / "Vadder.cmake").read_text(encoding="utf-8")
        self.assertIn(f'CLASSES_SLOW "{self.model}/Vadder__lines.cpp"', listing)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
