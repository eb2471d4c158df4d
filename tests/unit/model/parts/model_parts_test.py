# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""A model in parts: model_parts_test.py FOLDER HEADER VERILATOR CXX RUNTIME

FOLDER has the program (sim/model/parts), HEADER is what it has made of the chip, RUNTIME a library
with Verilator's runtime. tests/chip/random/lockstep_test.cpp shows that the parts of
the chip compute what the whole does. Here are the rules, with statements made by hand, and a small
model that is not the chip."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FOLDER, HEADER, VERILATOR, CXX, RUNTIME = sys.argv[1:]
sys.path.insert(0, FOLDER)

from busy import Busy, busy_of  # noqa: E402
from description import Description  # noqa: E402
from generated_model import NotUnderstood, analyse, apart, in_words, split, statements  # noqa: E402
from groups import HostKinds, Kinds, groups_of, inputs, looks, parts_of  # noqa: E402
from header import Writer  # noqa: E402


def rows(*texts, local=(), function="f"):
    return [analyse(text, function, set(local)) for text in texts]


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

    def test_wide_local_variable_is_one_for_each_word(self):
        head = "    VlWide<2>/*63:0*/ w;\n    VL_ZERO_W(64, w);\n    // Body\n"
        body = head + "w[0U] = vlSelf->a;\nw[1U] = w[0U];\nvlSelf->b = (w[1U] + vlSelf->w[1U]);\n"
        local, found = statements("f", in_words(body))
        self.assertEqual(local, {"f.w__0": "IData", "f.w__1": "IData"})
        self.assertEqual([(row.reads, row.writes, row.arrays) for row in found],
                         [({"a"}, {"f.w__0"}, set()), ({"f.w__0"}, {"f.w__1"}, set()),
                          ({"f.w__1", "w"}, {"b"}, set())])
        for use in ("w[(IData)(vlSelf->i)] = 1U;", "VL_ASSIGN_W(64, vlSelf->b, w);"):
            self.assertEqual(in_words(head + use), head + use)

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
        known = Busy({name for kind, name in busy if kind == "fast"},
                     {name: kind for kind, name in busy if kind != "fast"})
        return parts_of(groups_of(rows(*texts)), Kinds(known, widths), False)[0]

    def writer(self, widths, lists, events=(), host=()):
        described = Description("Vm", "m", ["clk"], list(host))
        return Writer(described, {}, widths, [], dict(events),
                      {"pins": [], "events": []} | lists, 64)

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

    def test_every_part_with_a_key_has_a_row_of_its_own(self):
        texts = [f"vlSelf->m{i}__DOT__a = vlSelf->k{i % 8};" for i in range(30)]
        parts = self.parts(texts, [("fast", f"k{i}") for i in range(8)],
                           {f"k{i}": 3 for i in range(8)})
        self.assertEqual([part.bits for part in parts], [8] * 30)
        self.assertEqual({part.flag for part in parts}, set(range(30)))
        self.assertIn("keyed[31][8];", self.writer({f"k{i}": 3 for i in range(8)},
                                                   {"rise": parts}).header(False))

    def header(self, texts, busy, widths):
        lists = {"rise": self.parts(texts, busy, widths)}
        return self.writer(widths, lists).header(False)

    def test_other_values_of_a_key_are_looked_at_again(self):
        text = self.header(["vlSelf->a = (vlSelf->b & vlSelf->c);", "vlSelf->c = vlSelf->d;"],
                           [("fast", "b")], {"b": 2})
        self.assertIn("if (auto& here = kept.keyed[0][(unsigned{vlSelf->b} << 0)];", text)
        self.assertIn("if (vlSelf->a != now0) { std::memset(kept.keyed[0], 1, 4); here = 0; "
                      "vlSelf->a = now0; }", text)
        self.assertIn("if (vlSelf->c != now0) { std::memset(kept.keyed[0], 1, 4); "
                      "vlSelf->c = now0; }", text)

    def test_what_a_part_with_a_key_makes_of_its_own_result_is_not_known_yet(self):
        text = self.header(["vlSelf->a = (vlSelf->a ^ vlSelf->b);", "vlSelf->c = vlSelf->a;"],
                           [("fast", "b")], {"b": 1})
        self.assertIn("own = 1; std::memset(kept.keyed[0], 1, 2); here = own; "
                      "vlSelf->a = now0; }", text)

    def test_a_host_pin_marks_registers_and_other_values_of_keys(self):
        keyed, = self.parts(["vlSelf->y = (vlSelf->k & vlSelf->x);"], [("fast", "k")], {"k": 1})
        register = parts_of(groups_of(rows("vlSelf->q = vlSelf->x;", function="nba_sequent__0")),
                            Kinds(Busy(), {}), False, 2)[0]
        logic = parts_of(groups_of(rows("vlSelf->z = vlSelf->x;")), Kinds(Busy(), {}), False, 3)[0]
        writer = self.writer({"k": 1}, {"rise": [keyed, *register, *logic]}, host=["x"])
        # host() computes what has no clock itself. The last flag: an edge of the clock sees it.
        self.assertEqual(writer.by_host["x"][None], {keyed, *register, writer.core})
        self.assertEqual(writer.by_clock["x"][None], {keyed, *register, *logic})

    def test_a_host_pin_marks_who_writes_a_local_variable_that_another_part_reads(self):
        # host() computes z in a variable of its own, so t would be old when only y changes.
        texts = ["t = vlSelf->x;", "vlSelf->z = (t & vlSelf->y);"]
        first, second = (parts_of(groups_of(rows(text, local={"t"})), Kinds(Busy(), {}), False,
                                  flag)[0][0] for flag, text in enumerate(texts))
        described = Description("Vm", "m", ["clk"], ["x", "y"])
        writer = Writer(described, {"f.t": "CData"}, {"f.t": 1}, [], {},
                        {"pins": [], "events": [], "rise": [first, second]}, 64)
        self.assertEqual(writer.kept, {"f.t"})
        self.assertEqual(writer.by_host["x"][None], {first})
        self.assertNotIn("y", writer.by_host)

    def test_what_an_event_starts_waits_for_it(self):
        when = {"nba_sequent__0": 0b01, "nba_comb__0": 0b10}
        found = [*rows("vlSelf->q = vlSelf->d;", "vlSelf->p = vlSelf->c;",
                       function="nba_sequent__0"),
                 *rows("vlSelf->z = (vlSelf->q & vlSelf->c);", function="nba_comb__0")]
        parts, _ = parts_of(groups_of(found), HostKinds(when, {"c"}), True)
        # A register that reads what the clock writes is computed after each edge of the clock.
        self.assertEqual({tuple(part.writes): (part.when, part.always) for part in parts},
                         {("q",): (1, False), ("p",): (1, True), ("z",): (2, False)})
        text = self.writer({}, {"rise": [], "events": parts}, {"s": 0}, ["s"]).header(False)
        self.assertIn("next |= vlSelf->s != 0 ? 0x1 : 0x2;", text)
        clocked = next(part for part in parts if part.always)
        self.assertIn("if (std::exchange(kept.clocked, false)) "
                      f"{{ kept.changed[0] |= {1 << clocked.flag:#x}ULL; }}", text)

    def test_an_element_of_an_array_marks_when_it_changes(self):
        text = self.header(["vlSelf->m[0U] = vlSelf->x;", "vlSelf->a = vlSelf->m[1U];"], [], {})
        self.assertIn("{ const auto was = vlSelf->m[0U]; vlSelf->m[0U] = vlSelf->x; "
                      "if (was != vlSelf->m[0U]) { kept.changed[0] |=", text)

    def test_a_comparison_counts_when_it_changes(self):
        text = self.header(["vlSelf->a = (2U == (IData)(vlSelf->b));", "vlSelf->b = vlSelf->c;"],
                           [("fast", "b")], {"b": 8})
        self.assertIn("if ((vlSelf->b == 2U) != (now0 == 2U)) { kept.changed[0] |= 0x1ULL;", text)
        self.assertIn("if (vlSelf->b != now0) {  vlSelf->b = now0; }", text)


class Counts(unittest.TestCase):
    def test_what_moves_at_most_clocks_is_fast(self):
        # The ten runs are those of all groups after edges of host pins.
        found = busy_of("runs 10 g\nruns 110 often\nruns 15 often\nruns 13 seldom\nruns 11 hardly\n"
                        "moves 45 a\nmoves 44 b\nmoves 100 c==3\n")
        self.assertEqual(found, Busy({"a", "c==3"}, {"often": "often", "seldom": "seldom"}))

    def test_nothing_counted_is_nothing_busy(self):
        self.assertEqual(busy_of(""), Busy())


SAMPLE = """
module sample (input logic clk_i, rst_ni, en_i, sck_i, input logic [7:0] add_i,
               output logic [7:0] sum_o, output logic [1:0] turn_o, output logic high_o, late_o,
               output logic [7:0] got_o, output logic near_o);
  logic [3:0] wait_q, wait_d;
  logic [7:0] sum_d;
  assign high_o = sum_o > 8'd200;
  assign wait_d = wait_q != 4'd0 ? wait_q - 4'd1 : en_i ? 4'd9 : 4'd0;
  assign sum_d = turn_o == 2'd2 && wait_q == 4'd4 ? sum_o + add_i + got_o : sum_o;
  // A register on a clock of the host, and a clock behind a gate.
  logic gated, odd_q;
  assign gated = sck_i & en_i;
  always_ff @(posedge sck_i or negedge rst_ni) begin
    if (!rst_ni) got_o <= '0;
    else if (en_i) got_o <= got_o ^ add_i ^ sum_o;
  end
  always_ff @(negedge gated or negedge rst_ni) begin
    if (!rst_ni) odd_q <= 1'b0;
    else odd_q <= !odd_q;
  end
  assign near_o = (got_o[3:0] == sum_o[3:0]) ^ odd_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) sum_o <= '0;
    else sum_o <= sum_d;
  end
  always_ff @(posedge clk_i) wait_q <= wait_d;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) turn_o <= '0;
    else turn_o <= turn_o + 2'd1;
  end
  FALL
endmodule
"""
FALLING = "always_ff @(negedge clk_i) late_o <= high_o;"
RISING = "always_ff @(posedge clk_i) late_o <= high_o;"
DIVIDED = "logic half_q; always_ff @(posedge clk_i) half_q <= !half_q;" \
          "always_ff @(posedge half_q) late_o <= high_o;"
DESCRIBED = 'prefix = "Vsample"\nnamespace = "sample"\nclocks = ["clk_i"]\n' \
    'host = ["en_i", "add_i", "sck_i"]\n'


class SecondModel(unittest.TestCase):
    """A model that is not the chip."""

    def setUp(self):
        keeper = tempfile.TemporaryDirectory()
        self.addCleanup(keeper.cleanup)
        self.folder = Path(keeper.name)
        (self.folder / "model.toml").write_text(DESCRIBED, encoding="utf-8")

    def run_in(self, *command):
        return subprocess.run([str(word) for word in command], cwd=self.folder, check=True,
                              capture_output=True, text=True).stdout

    def verilate(self, fall):
        (self.folder / "sample.sv").write_text(SAMPLE.replace("FALL", fall), encoding="utf-8")
        self.run_in(VERILATOR, "--cc", "--make", "cmake", "--prefix", "Vsample", "--Mdir", "v",
                    "-fno-const-bit-op-tree", "--x-initial", "unique", "sample.sv")

    def parts(self, *options):
        """(the header, what the program says)."""
        told = self.run_in(sys.executable, "-B", Path(FOLDER, "model_parts.py"), "model.toml", "v",
                           "v/Vsample_edge.hpp", *options)
        return (self.folder / "v/Vsample_edge.hpp").read_text(encoding="utf-8"), told

    def compare(self):
        """Runs the parts beside eval(). Returns what the program prints."""
        root = self.run_in(VERILATOR, "--getenv", "VERILATOR_ROOT").strip()
        files = [Path(__file__).with_name("parts_sample.cpp").resolve(),
                 *sorted((self.folder / "v").glob("*.cpp"))]
        (self.folder / "all.cpp").write_text(
            "".join(f'#include "{file}"\n' for file in files), encoding="utf-8")
        self.run_in(CXX, "-std=c++20", "-O0", "-Iv", f"-isystem{root}/include",
                    f"-isystem{root}/include/vltstd", "-o", "sample", "all.cpp", RUNTIME,
                    "-pthread", "-latomic", "-lz")
        return self.run_in(self.folder / "sample")

    def test_parts_compute_what_eval_does(self):
        self.verilate(FALLING)
        text, told = self.parts("--count")
        self.assertEqual((told, text.count("MODEL_RUNS_WHOLE")), ("", 0))
        (self.folder / "counts").write_text(self.compare(), encoding="utf-8")
        text, _ = self.parts("--busy", "counts", "--check")
        # turn_o moves at each clock, and what reads it has a flag for each of its values.
        self.assertRegex(text, r"here = kept\.keyed\[\d+\]\[\(unsigned\{vlSelf->turn_o\} << 0\)\];")
        self.assertEqual(self.compare(), "")

    def test_without_counts_and_falling_edges_too(self):
        self.verilate(RISING)
        text, told = self.parts()
        self.assertEqual((told, text.count("auto& here = kept.keyed")), ("", 0))
        self.assertEqual(self.compare(), "")

    def test_a_clock_made_by_the_clock_is_refused(self):
        self.verilate(DIVIDED)
        text, told = self.parts()
        self.assertEqual(text, "#define MODEL_RUNS_WHOLE\n")
        self.assertIn("Vsample runs whole", told)
        self.assertIn("an edge of the clock makes events: ['sample__DOT__half_q']", told)

    def test_a_name_that_the_model_does_not_have_is_told(self):
        self.verilate(FALLING)
        with (self.folder / "model.toml").open("a", encoding="utf-8") as file:
            file.write('[changed]\nmore = ["sample.wait_q", "sample.u_a.gone_q"]\n')
        text, told = self.parts()
        self.assertEqual(text, "#define MODEL_RUNS_WHOLE\n")
        self.assertIn("the model has no sample.u_a.gone_q\n", told)

    def test_an_unknown_key_is_an_error(self):
        (self.folder / "model.toml").write_text(DESCRIBED + "clock = 1\n", encoding="utf-8")
        with self.assertRaises(subprocess.CalledProcessError) as caught:
            self.parts()
        self.assertIn("'clock'", caught.exception.stderr)

    def test_what_no_verilator_has_made_runs_whole(self):
        (self.folder / "v").mkdir()
        self.assertEqual(self.parts()[0], "#define MODEL_RUNS_WHOLE\n")
        # Files of that name, but not text; then a folder in the place of one.
        listing = self.folder / "v/Vsample.cmake"
        listing.write_bytes(b"\xff\xfe\x00")
        self.assertEqual(self.parts()[0], "#define MODEL_RUNS_WHOLE\n")
        listing.unlink()
        listing.mkdir()
        self.assertEqual(self.parts()[0], "#define MODEL_RUNS_WHOLE\n")


class Chip(unittest.TestCase):
    def test_the_chip_is_split(self):
        text = Path(HEADER).read_text(encoding="utf-8")
        self.assertNotIn("MODEL_RUNS_WHOLE", text)
        self.assertGreater(text.count("__builtin_expect"), 20)
        # Some parts have a flag for each value of fast variables: the chip's counts were taken.
        self.assertGreater(text.count("auto& here = kept.keyed"), 10)


unittest.main(argv=sys.argv[:1])
