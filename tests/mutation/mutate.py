#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Random faults in the RTL, all in one model: each is asleep until its number is chosen.
Only modules below the tops of a design (masters.toml, `measured`) get faults, and those of them that count
there: its tests are those that meet them.

  mutate.py FOLDER [--design NAME] [--count N] [--seed S]
                                            writes the changed RTL and mutants.txt to FOLDER
                                            (120 faults in the design "chip" by default)
  mutate.py --rows FILE                     each row of FILE (equivalent.txt) is a fault that the RTL can have

Kinds: constant (a literal is another one), operator (== is !=, ! is nothing, one side of && or ||
is left out), stuck net (an assigned net is 0 or 1), stuck flop (it keeps its value)."""

import random
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import project  # noqa: E402

LITERAL = re.compile(r"(?<![\w)\]])(\d+)'([bdh])([0-9a-fA-F]+)\b")
NOT = re.compile(r"(?<=[(=?:,&|] )!(?=[\w(])|(?<=\()!(?=[\w(])")


def blank_comments(text):
    return re.sub(r"//[^\n]*", lambda m: " " * len(m.group()), text)


def operand_end(code, start):
    """Where the right operand of an operator at `start` ends."""
    depth = 0
    for match in re.compile(r"[({\[]|[)}\]]|&&|\|\||::|[?:;,]").finditer(code, start):
        token = match.group()
        if token in "({[":
            depth += 1
        elif token in ")}]" and depth:
            depth -= 1
        elif depth == 0 and token != "::":
            return match.start()
    raise ValueError("no end of an operand")


def below(top, codes):
    """The modules of a design, of {module: code}: the top, and what it instantiates."""
    found, open_ones = set(), {top}
    while open_ones:
        module = open_ones.pop()
        found.add(module)
        open_ones |= project.instances(codes[module], codes) - found
    return found


def no_logic(code):
    """(start, end) of what is no logic: local parameters and the functions that these call, conditions
    of generated blocks, checks."""
    parentheses = r"\([^()]*\)"
    for _ in range(5):
        parentheses = rf"\((?:[^()]|{parentheses})*\)"
    found = [match.span() for match in re.finditer(
        r"\blocalparam\b[^;]*;|\bif \((?:(?!\bbegin\b)[^;])*\bbegin : ", code)]
    called = " ".join(code[start:end] for start, end in found)
    for match in re.finditer(r"\bfunction\b[^;(]*\b(\w+)\s*[;(].*?\bendfunction\b", code, re.S):
        if re.search(rf"\b{match[1]}\b", called):
            found.append(match.span())
    found += [match.span() for match in re.finditer(rf"`ENC_\w+{parentheses}", code)]
    return found


def logic_lines(code):
    """(start, end) of text in which expressions may change: behind the ports, outside constants,
    case labels, generates, checks and sensitivity lists. A module without ports only checks parameters."""
    body = code.find("\n);\n") + 4
    if body < 4:
        return
    fixed = no_logic(code)
    for match in re.compile(r"[^\n]+\n").finditer(code, body):
        line = match.group()
        if any(start < match.end() and match.start() < end for start, end in fixed):
            continue
        if re.search(r"parameter|`|\bfor\b|\bgenerate\b|always_ff|\$error|typedef|#\(|"
                     r"^\s*\.\w+|if \(!\w*rst|if \(!\w*por|if \(!alive|\bcase|begin : ", line):
            continue
        yield match.start(), match.end()


def sites(code):
    """(kind, start, end, replacement with M for 'this fault is awake')."""
    found = []
    for start, end in logic_lines(code):
        line = code[start:end]
        label = re.match(r"\s*(?:[\w':, ?]+|default)\s*:(?!:)", line)
        first = start + (label.end() if label and "?" not in label.group() else 0)
        if label and "::" in line[:label.end() + 1]:
            continue
        for m in LITERAL.finditer(code, first, end):
            width, base = int(m.group(1)), {"b": 2, "d": 10, "h": 16}[m.group(2)]
            other = (int(m.group(3), base) ^ 1) % (1 << width)
            if code[m.end():m.end() + 2].strip().startswith(":"):
                continue
            found.append(("constant", m.start(), m.end(),
                          f"(M ? {width}'d{other} : {m.group()})"))
        for m in NOT.finditer(code, first, end):
            found.append(("operator", m.start(), m.end(), "(M) ^ !"))
        for m in re.compile(r"[!=]=").finditer(code, first, end):
            stop = operand_end(code, m.end())
            found.append(("operator", stop, stop, " ^ (M)"))
        for m in re.compile(r"&&|\|\|").finditer(code, first, end):
            stop = operand_end(code, m.end())
            right = code[m.end():stop].strip()
            part = f" ({right} || M)" if m.group() == "&&" else f" ({right} && !(M))"
            found.append(("operator", m.end(), stop, part))
    for m in re.compile(r"\bassign (\w+)\s*=\s*([^;]*);").finditer(code):
        if "'{" not in m.group(2) and m.group(1) != "unused":
            for value in ("'0", "'1"):
                if value != m.group(2):
                    found.append(("stuck net", m.start(2), m.end(2), f"(M) ? {value} : ({m.group(2)})"))
    for m in re.compile(r"\b(\w+_q)\s*<=\s*(\w+_d);").finditer(code):
        found.append(("stuck flop", m.start(2), m.end(2), f"(M) ? {m.group(1)} : {m.group(2)}"))
    return found


def told(code, site):
    """(line, fault) of a site in a module's text."""
    kind, start, end, new = site
    text = code[code.rfind("\n", 0, start) + 1:code.index("\n", end)]
    change = f"{code[start:end].strip()} -> {new.strip()}"
    return code.count("\n", 0, start) + 1, " ".join(f"{kind}: {change} in: {text}".split())


def reasons(file):
    """{fault without its line: why no test can see it} of equivalent.txt."""
    rows = {}
    for line in file.read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            fault, reason = line.split(" | because ")
            rows[fault.strip()] = reason.strip()
    return rows


def pool_of(design, codes):
    """(module, site) of every fault that a design can have."""
    files = project.rtl_modules()
    modules = set().union(*(below(model.top, codes) for model in design.models.values()))
    return [(module, *site) for module in sorted(modules) if design.counts(files[module]) for site in sites(codes[module])]


def check_rows(file, pool):
    texts = {module: path.read_text(encoding="utf-8") for module, path in project.rtl_modules().items()}
    known = {f"{module}: {told(texts[module], site)[1]}" for module, *site in pool}
    rows = reasons(file)
    project.finish([f"{file.name}: the RTL has no such place: {row}" for row in rows if row not in known],
                   f"{len(rows)} rows, each a fault that the RTL can have")


def main():
    folder = Path(sys.argv[1])
    options = dict(zip(sys.argv[2::2], sys.argv[3::2]))
    seed = int(options.get("--seed", 20260102))
    chance = random.Random(seed)
    codes = {module: blank_comments(path.read_text(encoding="utf-8"))
             for module, path in project.rtl_modules().items()}
    if sys.argv[1] == "--rows":
        designs = project.all_of("measured").values()
        check_rows(Path(sys.argv[2]), [row for design in designs for row in pool_of(design, codes)])
        return
    design = project.design(options.get("--design", "chip"))
    pool = pool_of(design, codes)
    chance.shuffle(pool)
    chosen = []
    for site in pool:
        if len(chosen) == int(options.get("--count", 120)):
            break
        # Two faults in the same text cannot live side by side.
        if all(site[0] != c[0] or site[3] < c[2] or site[2] > c[3] for c in chosen):
            chosen.append(site)
    folder.mkdir(parents=True, exist_ok=True)
    listing = []
    for path in project.listed(design.master.list):
        code = path.read_text(encoding="utf-8")
        mine = [(number, c) for number, c in enumerate(chosen, 1) if c[0] == path.stem]
        whole = code
        for number, (_, *site) in sorted(mine, key=lambda c: -c[1][2]):
            _, start, end, new = site
            line, fault = told(whole, site)
            listing.append((number, f"{path.stem}:{line}: {fault}"))
            code = code[:start] + re.sub(r"\bM\b", f"(mutant == {number})", new) + code[end:]
        if mine:
            at = code.index("\n);\n") + 4
            code = (code[:at] + "  int mutant;\n  initial mutant = $c(\"mb4_mutant()\");\n"
                    + code[at:])
        (folder / path.name).write_text(code, encoding="utf-8")
    head = f"# seed {seed}: {len(chosen)} of {len(pool)} possible faults\n"
    (folder / "mutants.txt").write_text(
        head + "".join(f"{n} {text}\n" for n, text in sorted(listing)), encoding="utf-8")
    print(head.strip())


if __name__ == "__main__":
    main()
