#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Proofs of single blocks: Yosys and ABC; bounded search, cover points, reachability or induction (yosys-smtbmc, z3).

  prove.py NAME FOLDER [--bounds|--mutations|--short] [PRESET]   one proof; FOLDER is for what the tools leave;
                                   --short: of the mutations only the first; PRESET: modules with the parameter
                                   Features have this preset, without it the full chip
  prove.py table [--check FILE]                 the table of docs/proofs.md, or: FILE holds it,
                                   and the RTL has each text that a proof changes

A proof is NAME.sv here: a bench `proof` around the block, with lines `// key: value` in its header; a line
that begins with `//   ` goes on with the one before:
  claim      what is proved, in a line
  clocks     one: a step is a clock; many: a step is any instant, clocks are inputs like others
  depth      steps that the bounded proof looks at, from reset
  cover      steps within which each cover point must be reached, so that nothing holds by being
             impossible
  unbounded  "reachability": ABC's PDR; "induction K": K-step induction by z3, "induction K each": each claim by
             itself behind K steps in which all hold, which takes less time; or "no: REASON"
  checks     there: the block's own checks depend on more than the bench, and are left out
  look       WIRE = PATH: the bench's undriven WIRE shows a signal inside the block
  keep       FILE | OLD | NEW: a smaller size for the proof; OLD occurs once
  mutation   FILE | OLD | NEW: with this change of the RTL (OLD occurs once) the proof fails

ABC says in which step a claim fails; yosys-smtbmc and z3 must then find the same step, and tell the claim's name."""

import re
import shutil
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import project  # noqa: E402
import yosys  # noqa: E402

KEYS = {"checks", "claim", "clocks", "depth", "cover", "unbounded", "look", "keep", "mutation"}
# Bits of the word FEATURES, and of those that modules have as a parameter of their own.
TWO_LINES = 0x40
PARAMETERS = {"BissB": 0x20, "Ssi": 0x10, "Mo": 0x08, "Control": 0x04, "FreeCrc": 0x01}
SOLVER = "z3"
PACKAGE = {"z3": "z3"}  # the others are of the package yosys
FAR = 30
# A cover point as the claim that it is never reached.
COVERS = """(* techmap_celltype = "$cover" *)
module cover_is_never_reached (input A, EN);
  \\$assert claim (.A(!A), .EN(EN));
endmodule
"""
# From words to AND gates and flops.
GATES = ["memory_map", "opt -full", "setundef -undriven -anyseq", "opt_clean", "techmap", "opt -full", "simplemap",
         "dffunmap", "opt_clean", "abc -g AND -fast", "opt_clean"]
AIGER = "write_aiger -I -B -zinit"


class Proof:
    def __init__(self, name, preset="full"):
        self.name = name
        self.preset = preset
        self.path = HERE / f"{name}.sv"
        if not self.path.exists():
            there = ", ".join(sorted(path.stem for path in HERE.glob("*.sv")))
            raise SystemExit(f"prove.py: {name}: tests/formal/{name}.sv does not exist; there are {there}")
        self.values = {}
        head = self.path.read_text(encoding="utf-8").split("\nmodule ")[0]
        head = re.sub(r"\n//   ", " ", head)
        for key, value in re.findall(r"^// (\w+): (.*)$", head, re.M):
            if key in KEYS:
                self.values.setdefault(key, []).append(value.strip())
        for key in ("claim", "clocks", "depth", "cover", "unbounded", "mutation"):
            if key not in self.values:
                raise SystemExit(f"{self.path.name}: no line '// {key}: ...'")

    def one(self, key):
        return self.values[key][0]

    def changes(self, key):
        return [tuple(part.strip() for part in value.split(" | "))
                for value in self.values.get(key, [])]


def read_rtl():
    """{relative name: text} of the RTL."""
    return {path.name if project.RTL not in path.parents else str(path.relative_to(project.RTL)):
            path.read_text(encoding="utf-8") for path in project.all_rtl_files()}


def misplaced(change, sources, where):
    """What is wrong with a change: its OLD must occur once in the file FILE of the sources."""
    file, old, _ = change
    count = sources.get(file, "").count(old)
    return [] if count == 1 else [f"{where}: '{old}' occurs {count} times in {file}"]


def model(proof, folder, mutation=None):
    """Writes the model of a proof, with one mutation or none."""
    features = project.presets()[proof.preset]
    absent = "|".join(name for name, bit in PARAMETERS.items() if not features & bit) or "none"
    defaults = ((re.compile(r"(parameter logic \[31:0\] Features = )mb4_pkg::FEATURES_FULL\b"),
                 rf"\1mb4_page_regs_pkg::FEATURES_{proof.preset.upper()}"),
                (re.compile(rf"(parameter bit +(?:{absent}) += )1'b1\b"), r"\g<1>1'b0"))
    if folder.exists():
        shutil.rmtree(folder)
    folder.mkdir(parents=True)
    sources = read_rtl()
    for change in proof.changes("keep") + ([mutation] if mutation else []):
        for fault in misplaced(change, sources, proof.path.name):
            raise SystemExit(fault)
        file, old, new = change
        sources[file] = sources[file].replace(old, new)
    files = []
    for name, text in sources.items():
        target = folder / "rtl" / name
        target.parent.mkdir(parents=True, exist_ok=True)
        for pattern, value in defaults:
            text = pattern.sub(value, text)
        target.write_text(text, encoding="utf-8")
        files.append(target)
    formal = "" if "checks" in proof.values else "-formal"
    two_lines = features & TWO_LINES
    looks = [value.split(" = ") for value in proof.values.get("look", [])
             if two_lines or "gen_line[1]" not in value]
    commands = [f"read_verilog -defer -sv {formal} -I{project.INCLUDE} " +
                " ".join(str(f) for f in files),
                f"read_verilog -sv -formal {'' if two_lines else '-DONE_LINE'} {proof.path}",
                # A read-only memory made of a case would hold anything in the induction.
                "hierarchy -check -top proof", "proc -norom", "flatten", "cd proof",
                *[f"connect -nounset -set {wire} {path}" for wire, path in looks], "cd",
                "opt_clean", "check",
                "memory -nomap", "opt -full",
                "clk2fflogic" if proof.one("clocks") == "many" else "async2sync",
                "dffunmap", "opt_clean", "check", "write_smt2 -wires model.smt2",
                *GATES, "design -save gates", "chformal -cover -remove", f"{AIGER} claims.aig",
                "design -load gates", "chformal -assert -remove", "techmap -map covers.v", "simplemap", "opt_clean",
                f"{AIGER} covers.aig"]
    (folder / "covers.v").write_text(COVERS, encoding="utf-8")
    status, text = yosys.execute(commands, folder, "model")
    if status != 0:
        raise SystemExit(text)
    drivers = [line for line in text.splitlines() if "no driver" in line]
    if drivers:
        raise SystemExit("\n".join(drivers))


def smtbmc(folder, *arguments):
    return project.run([project.tool("yosys-smtbmc"), "-s", SOLVER, "--noprogress", "--noincr",
                        "--unroll", *arguments, "model.smt2"], cwd=folder)


def abc(folder, file, command):
    """What ABC says about the claims of a file under its assumptions."""
    status, text = project.run([project.tool("yosys-abc"), "-c", f"read_aiger {file}; fold; strash; {command}"],
                               cwd=folder)
    return text if status == 0 else f"{command} ends with {status}\n"


def failed_step(folder, step):
    """The claim that fails in this step, by the other solver; reachability may need far more steps than it can look at."""
    if step > FAR:
        return f"Assert failed in ABC: a claim in step {step}"
    _, text = smtbmc(folder, "-t", f"{step}:1:{step + 1}", "--dump-vcd", "trace.vcd")
    if "Assert failed" not in text:
        text = f"ABC finds a claim that fails in step {step}, {SOLVER} finds none:\n{text}"
    return text


def claims(folder, command, proved):
    """Whether ABC says `proved` of the claims, and what it or the other solver says."""
    text = abc(folder, "claims.aig", command)
    failed = re.search(r"was asserted in frame (\d+)", text)
    if failed:
        return False, failed_step(folder, int(failed.group(1)))
    return proved in text, text


def bounded(proof, folder):
    depth = int(proof.one("depth"))
    return claims(folder, f"bmc3 -F {depth}", f"No output asserted in {depth} frames")


def each_claim(folder, steps):
    """The induction, for each claim by itself: the step that smtbmc writes has them as a conjunction, negated."""
    (folder / "answers").write_text("sat\n" * int(steps) + "unsat\n", encoding="utf-8")
    project.run([project.tool("yosys-smtbmc"), "-s", "dummy", "--dummy", "answers", "--noprogress", "--noincr", "--unroll",
                 "-i", "-t", steps, "--dump-smt2", "step.smt2", "model.smt2"], cwd=folder)
    names = re.findall(r"^; yosys-smt2-assert \d+ (.*)$", (folder / "model.smt2").read_text(encoding="utf-8"), re.M)
    text = re.sub(r"\((check-sat|set-info :status \w+|exit)\)", "", (folder / "step.smt2").read_text(encoding="utf-8"))
    whole = re.search(r"^\(assert \(not \(and (\|\S+\|) true\)\)\)$", text, re.M)
    parts = re.search(rf"^\(define-fun {re.escape(whole[1])} \(\) Bool \(and (.*)\)\)$", text, re.M)[1].split()
    if len(parts) != len(names):
        return False, f"{len(names)} claims, but {len(parts)} parts of the step"
    for name, part in zip(names, parts):
        query = text.replace(whole[0], f"(assert (not {part}))")
        query += "\n(check-sat-using (then simplify propagate-values solve-eqs bit-blast sat))\n"
        (folder / "claim.smt2").write_text(query, encoding="utf-8")
        _, said = project.run([project.tool(SOLVER), "claim.smt2"], cwd=folder)
        if said.split() != ["unsat"]:
            return False, f"Assert failed in proof: {name}\n{said[-200:]}"
    return len(names) > 0, ""


def unbounded(proof, folder):
    how = proof.one("unbounded").split()
    if how[0] == "induction" and how[2:] == ["each"]:
        return each_claim(folder, how[1])
    if how[0] == "induction":
        status, text = smtbmc(folder, "-i", "-t", how[1])
        return status == 0 and "Status: PASSED" in text, text
    if how[0] == "reachability":
        return claims(folder, "pdr", "Property proved")
    return True, ""


def cover(proof, folder):
    """Each cover point is reached: each claim that it is not fails, within the steps."""
    points = int(re.search(r"i/o = *\d+/ *(\d+)", abc(folder, "covers.aig", "print_stats")).group(1))
    unreached = [point for point in range(points) if "was asserted in frame" not in
                 abc(folder, "covers.aig", f"cone -s -O {point}; bmc3 -F {proof.one('cover')}")]
    return points > 0 and not unreached, f"{points} cover points, not reached: {unreached}"


def mutated(proof, folder, number, mutation):
    folder = folder / f"mutation{number}"
    model(proof, folder, mutation)
    good, text = bounded(proof, folder)
    if good:
        good, text = unbounded(proof, folder)
    failed = re.search(r"Assert failed in \S+: (.*)", text)
    where = failed.group(1) if failed else ""
    if good or not failed:
        return [f"{proof.name}: this change of the RTL goes unnoticed: {' | '.join(mutation)}\n"
                f"{text[-2000:]}"]
    print(f"  mutation {number} of {mutation[0]} fails in {where}", flush=True)
    return []


def timed(what, function, *arguments):
    begin = time.monotonic()
    good, text = function(*arguments)
    print(f"  {what}: {'ok' if good else 'FAILED'}, {time.monotonic() - begin:.1f} s", flush=True)
    return [] if good else [f"{what} failed:\n{text[-4000:]}"]


def prove(name, folder, part, preset):
    for program in (SOLVER, "yosys", "yosys-smtbmc"):
        if shutil.which(program) is None:
            print(f"skipped: {program} is not installed (package {PACKAGE.get(program, program)}; "
                  f"tools/setup.sh test installs it)")
            sys.exit(project.SKIPPED)
    proof = Proof(name, preset)
    print(f"{name}, {preset}: {proof.one('claim')}", flush=True)
    findings = []
    if part != "--mutations":
        model(proof, folder / "rtl_model")
        findings += timed(f"bounded, {proof.one('depth')} steps", bounded, proof,
                          folder / "rtl_model")
        findings += timed("cover points", cover, proof, folder / "rtl_model")
        findings += timed(f"unbounded: {proof.one('unbounded')}", unbounded, proof,
                          folder / "rtl_model")
    if part != "--bounds":
        mutations = proof.changes("mutation")
        for number, mutation in enumerate(mutations[:1] if part == "--short" else mutations, 1):
            findings += mutated(proof, folder, number, mutation)
    which = {"--short": "and the first mutation is found", "--bounds": "without mutations"}
    project.finish(findings, f"{name}: proved, {which.get(part, 'and every mutation is found')}")


def table():
    lines = ["| proof | claim | bounded, steps | unbounded | mutations |", "|---|---|---|---|---|"]
    for path in sorted(HERE.glob("*.sv")):
        proof = Proof(path.stem)
        step = "instants" if proof.one("clocks") == "many" else "clocks"
        how = proof.one("unbounded")
        how = "yes, reachability" if how == "reachability" else re.sub(r"induction (\d+)( each)?", r"yes, \1-step induction", how)
        lines.append(f"| [`{proof.name}`](../tests/formal/{path.name}) | {proof.one('claim')} | "
                     f"{proof.one('depth')} {step} | {how} | {len(proof.changes('mutation'))} |")
    return "\n".join(lines)


def main():
    if sys.argv[1] == "table":
        text = table()
        if len(sys.argv) > 2:
            held = Path(sys.argv[3]).read_text(encoding="utf-8")
            lost = [row for row in text.splitlines() if row not in held.splitlines()]
            findings = [f"{sys.argv[3]} has no such row; `prove.py table` prints the table: {row}" for row in lost]
            if not lost and text not in held:
                findings = [f"{sys.argv[3]} has the rows in another order, or more; `prove.py table` prints the table"]
            sources = read_rtl()
            for path in sorted(HERE.glob("*.sv")):
                proof = Proof(path.stem)
                for change in proof.changes("keep") + proof.changes("mutation"):
                    findings += misplaced(change, sources, path.name)
            project.finish(findings, "the table is that of the proofs, and the RTL has each text they change")
        print(text)
        return
    parts = [word for word in sys.argv[3:] if word.startswith("--")]
    presets = [word for word in sys.argv[3:] if word in project.presets()]
    if len(parts) > 1 or len(presets) > 1 or len(parts) + len(presets) != len(sys.argv) - 3:
        raise SystemExit(f"prove.py: {' '.join(sys.argv[3:])}: one of --bounds, --mutations, --short, and one preset")
    prove(sys.argv[1], Path(sys.argv[2]).resolve(), (parts or [""])[0], (presets or ["full"])[0])


main()
