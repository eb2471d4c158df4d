# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Parts of an edge of CLK (sim/model/edge): split_edge_test.py FOLDER HEADER

FOLDER has the modules, HEADER is what was made of the chip. That the parts compute what the whole
does is shown by tests/chip/lockstep_test.cpp; here are the rules, with statements made by hand."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FOLDER, HEADER = sys.argv[1:3]
sys.path.insert(0, FOLDER)

from generated_model import NotUnderstood, analyse, apart, split, statements  # noqa: E402
from groups import Kinds, groups_of, inputs, looks, parts_of  # noqa: E402
from header import Writer  # noqa: E402


def rows(*texts, local=()):
    return [analyse(text, "f", set(local)) for text in texts]


def order(parts):
    return [row.text for part in parts for row in part.rows]


class Statements(unittest.TestCase):
    def test_names(self):
        row, = rows("vlSelf->a = ((IData)(vlSelf->b) + x);", local={"x"})
        self.assertEqual((row.reads, row.writes, row.defines), ({"b", "f.x"}, {"a"}, {"a"}))

    def test_conditional_write_keeps_the_rest(self):
        row, = rows("if (vlSelf->c) { vlSelf->a = 1U; }")
        self.assertEqual((row.writes, row.defines, inputs([row])), ({"a"}, set(), {"a", "c"}))

    def test_element_of_an_array_keeps_the_rest(self):
        row, = rows("vlSelf->m[(IData)(vlSelf->i)] = vlSelf->m[0U];")
        self.assertEqual((row.reads, row.writes, row.defines, row.arrays),
                         ({"i", "m"}, {"m"}, set(), {"m"}))

    def test_comparison_is_no_write(self):
        row, = rows("vlSelf->a = (vlSelf->b == vlSelf->c);")
        self.assertEqual(row.writes, {"a"})

    def test_what_is_only_compared_with_numbers_has_these(self):
        row, = rows("vlSelf->a = ((0U != (IData)(vlSelf->b)) & (0x1fU == vlSelf->c));")
        self.assertEqual((row.reads, row.looks), ({"b", "c"}, {("b", 0), ("c", 31)}))
        found = looks(rows("vlSelf->a = (0U == (IData)(vlSelf->b));", "vlSelf->d = vlSelf->b;"))
        self.assertEqual(found, {("b", None)})

    def test_comparisons_of_another_form_are_reads(self):
        for text in ("(0U < (IData)(vlSelf->b))", "(0U == (vlSelf->b & 3U))",
                     "(0U == (IData)(vlSelf->b[1U]))", "(0U == vlSelf->b + 1U)",
                     "(vlSelf->c == (IData)(vlSelf->b))"):
            row, = rows(f"vlSelf->a = {text};")
            self.assertIn(("b", None), row.looks, msg=text)

    def test_text_and_comments_have_no_names(self):
        row, = rows('VL_WRITEF("vlSelf->a = %d; {\\n", vlSelf->b/*7:0*/);')
        self.assertEqual((row.reads, row.writes), ({"b"}, set()))

    def test_unknown_is_refused(self):
        for text in ("vlSelf->a = vl_random();", "VL_ASSIGN_W(70, vlSelf->a, vlSelf->b);",
                     "vlSelf->a += 1U;", "for (;;) { vlSelf->a = 1U; }", "other(vlSelf);",
                     "vlSelf->a = vlSymsp->TOP__x.y;"):
            with self.assertRaises(NotUnderstood, msg=text):
                rows(text)

    def test_bodies_are_split_at_their_statements(self):
        body = 'vlSelf->a = 1U;\nif (vlSelf->b) {\n x = "};"; } else { y = 1U; }\n// c\nz = 2U;'
        self.assertEqual([" ".join(text.split()) for text in split(body)],
                         ["vlSelf->a = 1U;", 'if (vlSelf->b) { x = "};"; } else { y = 1U; }',
                          "z = 2U;"])

    def test_local_variable_read_before_it_is_written_is_zero(self):
        head = "    // Init\n    CData/*0:0*/ x;\n    x = 0;\n    // Body\n"
        _, kept = statements("f", head + "if (vlSelf->a) { x = 1U; }\nvlSelf->b = x;")
        self.assertEqual(kept[0].text, "x = 0;")
        _, kept = statements("f", head + "x = vlSelf->a;\nvlSelf->b = x;")
        self.assertEqual(len(kept), 2)


class LongConditionals(unittest.TestCase):
    PAD = "/*" + 1500 * "-" + "*/"

    def pieces(self, text):
        return apart(self.PAD.join(["if (vlSelf->c", text]), "f", set())

    def test_independent_statements_part(self):
        self.assertEqual(len(self.pieces(") { vlSelf->a = 1U; vlSelf->b = 2U; }"
                                         " else { vlSelf->b = 3U; vlSelf->a = 4U; }")), 2)

    def test_dependent_statements_stay_together_in_their_order(self):
        found = self.pieces(") { vlSelf->a = 1U; } else { vlSelf->p = 2U; vlSelf->a = vlSelf->p; }")
        self.assertEqual(len(found), 1)
        self.assertLess(found[0].index("vlSelf->p = 2U"), found[0].index("vlSelf->a = vlSelf->p"))

    def test_condition_that_is_written_stays_whole(self):
        self.assertEqual(len(self.pieces(") { vlSelf->c = 1U; vlSelf->b = 2U; }")), 1)


class Parts(unittest.TestCase):
    def test_a_register_has_its_statements_in_one_group(self):
        groups = groups_of(rows("vlSelf->d = vlSelf->q;", "vlSelf->d = vlSelf->e;",
                                "vlSelf->x = vlSelf->y;"))
        self.assertEqual(sorted(len(group.rows) for group in groups), [1, 2])

    def test_circles_are_one_group(self):
        groups = groups_of(rows("vlSelf->a = vlSelf->q;", "vlSelf->b = vlSelf->a;",
                                "if (vlSelf->b) { vlSelf->a = 1U; }"))
        self.assertEqual(len(groups), 1)

    def test_old_values_are_read_before_they_change(self):
        texts = ["vlSelf->m__DOT__s = vlSelf->m__DOT__r;", "vlSelf->m__DOT__r = vlSelf->m__DOT__d;",
                 "vlSelf->m__DOT__d = vlSelf->m__DOT__s;"]
        for name in "srd":
            for kind in ("fast", "often"):
                self.assertEqual(order(self.parts(texts, [(kind, f"m__DOT__{name}")])), texts)

    def parts(self, texts, busy, widths=None):
        widths = widths or {f"m__DOT__{name}": 1 for name in "srd"}
        return parts_of(groups_of(rows(*texts)), Kinds(busy, widths), False)[0]

    def test_who_writes_a_fast_variable_runs_always(self):
        parts = self.parts(["vlSelf->a = vlSelf->b;", "vlSelf->c = vlSelf->d;"], [("fast", "a")])
        self.assertEqual([(part.flag, part.bits) for part in parts], [(0, 0), (0, 1)])

    def test_who_reads_fast_variables_has_a_flag_for_each_of_their_values(self):
        texts = ["vlSelf->a = (vlSelf->b & vlSelf->c);"]
        part, = self.parts(texts, [("fast", "b")], {"b": 2})
        self.assertEqual((part.key, part.bits, part.looks), (("b",), 4, {("c", None)}))
        part, = self.parts(texts, [("fast", "b"), ("fast", "c")], {"b": 2, "c": 1})
        self.assertEqual((part.key, part.bits, part.looks), (("b", "c"), 8, set()))

    def test_wide_or_unknown_keys_and_arrays_run_always(self):
        for text, widths in (("vlSelf->a = vlSelf->b;", {"b": 4}), ("vlSelf->a = vlSelf->b;", {}),
                             ("vlSelf->a[0U] = vlSelf->b;", {"b": 1})):
            part, = self.parts([text], [("fast", "b")], widths)
            self.assertEqual((part.bits, part.key), (0, ()))

    def test_flags_of_a_key_stay_in_a_word(self):
        texts = [f"vlSelf->m{i}__DOT__a = vlSelf->k{i % 8};" for i in range(30)]
        parts = self.parts(texts, [("fast", f"k{i}") for i in range(8)],
                           {f"k{i}": 3 for i in range(8)})
        self.assertEqual(len(parts), 30)
        for part in parts:
            self.assertEqual(part.flag // 64, (part.flag + part.bits - 1) // 64)
        self.assertEqual(len({part.flag + i for part in parts for i in range(part.bits)}), 240)

    def header(self, texts, busy, widths):
        lists = {"rise": self.parts(texts, busy, widths)}
        return Writer({}, widths, {}, [], set(), set(), lists).header(64, False)

    def test_other_values_of_a_key_are_looked_at_again(self):
        text = self.header(["vlSelf->a = (vlSelf->b & vlSelf->c);", "vlSelf->c = vlSelf->d;"],
                           [("fast", "b")], {"b": 2})
        self.assertIn("at = 0 + (static_cast<unsigned>(vlSelf->b) << 0);", text)
        self.assertIn("if ((before0 != vlSelf->a)) { kept.changed[0] |= 0xfULL & ~here; }", text)
        self.assertIn("if ((before0 != vlSelf->c)) { kept.changed[0] |= 0xfULL; }", text)

    def test_behind_eval_writers_run_as_readers_do(self):
        texts = ["vlSelf->y = (vlSelf->k & vlSelf->x);", "vlSelf->z = (1U == vlSelf->y);"]
        lists = {"rise": self.parts(texts, [("fast", "k")], {"k": 1})}
        places = {"x": 0, "y": 1}
        text = Writer({}, {"k": 1}, places, [], set(), set(places), lists).header(64, False)
        keyed = [part for part in lists["rise"] if part.key]
        plain = [part for part in lists["rise"] if not part.key]
        both = 0b11 << keyed[0].flag
        self.assertIn("if (then(root, root.x) != root.x) \n"
                      f"{{ kept.changed[0] |= {both:#x}ULL; }}", text)
        self.assertIn("if (then(root, root.y) != root.y) \n"
                      f"{{ kept.changed[0] |= {both | 1 << plain[0].flag:#x}ULL; }}", text)

    def test_a_comparison_counts_when_it_changes(self):
        text = self.header(["vlSelf->a = (2U == (IData)(vlSelf->b));", "vlSelf->b = vlSelf->c;"],
                           [("fast", "b")], {"b": 8})
        self.assertIn("if (((before0 == 2U) != (vlSelf->b == 2U))) {", text)


class Fallback(unittest.TestCase):
    def header(self, folder):
        output = Path(folder, "edge.hpp")
        subprocess.run([sys.executable, "-B", Path(FOLDER, "split_edge.py"), folder,
                        Path(FOLDER, "busy.txt"), output], check=True, capture_output=True)
        return output.read_text(encoding="utf-8")

    def test_no_model_of_this_kind_runs_whole(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(self.header(folder), "#define MB4_EDGE_NOT_SPLIT\n")
            # Files of that name, but not text; then a folder in the place of one.
            Path(folder, "Vmb4_chip.cmake").write_bytes(b"\xff\xfe\x00")
            self.assertEqual(self.header(folder), "#define MB4_EDGE_NOT_SPLIT\n")
            Path(folder, "Vmb4_chip.cmake").unlink()
            Path(folder, "Vmb4_chip.cmake").mkdir()
            self.assertEqual(self.header(folder), "#define MB4_EDGE_NOT_SPLIT\n")


class Chip(unittest.TestCase):
    def test_the_chip_is_split(self):
        text = Path(HEADER).read_text(encoding="utf-8")
        self.assertNotIn("MB4_EDGE_NOT_SPLIT", text)
        self.assertGreater(text.count("__builtin_expect"), 20)


unittest.main(argv=sys.argv[:1])
