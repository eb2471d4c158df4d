#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The RTL with bench.sv in Icarus Verilog.

  run_icarus.py FOLDER              the checks of bench.sv
  run_icarus.py FOLDER --break      with faults in the RTL; each must be reported
  run_icarus.py FOLDER --plain      the checks with the plain Verilog of each top, and of mb4_core
                                    with a fault, which must be reported
  run_icarus.py FOLDER --speed N [MB4SIM]
                                    workload A (one encoder, 26 bits, AGSMIN, 10 MHz), N clocks:
                                    clocks per second of processor time; with MB4SIM, the program,
                                    in turns with its own, and how many times more that does

Icarus 11 does not read all of the RTL's SystemVerilog. What it cannot read is spelled differently,
by text and without any tool that knows the language: constants and types of the packages become
global names (mb4_pkg::x is mb4_pkg_x), `int unsigned` is int, `unique case` is case, signed'(x) is
$signed(x), an enum is a vector with constants, always_comb has a list of what it reads."""

import json
import re
import resource
import statistics
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools" / "synth"))

import plain_verilog  # noqa: E402
import project  # noqa: E402

# File, text, replacement: what the bench must notice.
FAULTS = [
    ("mb4_spi_shift", "bit_q + 3'd1", "bit_q + 3'd3"),
    ("enc_crc", "feed_i & (bit_i ^ top)", "feed_i & bit_i"),
    ("biss_edge_count", "biss_c_i ? {!bus, {2{bus}}}", "biss_c_i ? {2'b01, bus}"),
    ("biss_control_frame", "slot_q + 6'd1", "slot_q + 6'd2"),
    ("enc_posted", "rd_q + (AddrW+1)'(fetch)", "rd_q"),
]
# Sensitivity to more than what is read; '0 at a port is taken for one bit and padded with zeros.
HARMLESS = (r".*sorry: constant selects in always_\* processes are not currently supported.*"
            r"|.*Port \d+ \(rd2_addr_i\) of \w+ expects 5 bits, got 1\.|.*: Padding 4 high bits.*")


def package_names(text):
    names = set(re.findall(r"\blocalparam\b[^;=]*?(\w+)\s*=", text))
    for members in re.findall(r"\benum\s[^{]*\{([^}]*)\}", re.sub(r"//[^\n]*", "", text)):
        names |= {member.split("=")[0].strip() for member in members.split(",")}
    names |= set(re.findall(r"\bfunction\b[^;(]*?(\w+)\s*\(", text))
    return names | set(re.findall(r"\}\s*(\w+)\s*;", text))


def plain_enum(match):
    """An enum as a vector and constants."""
    base, members, name = match.groups()
    members = [m.strip() for m in re.sub(r"//[^\n]*", "", members).split(",")]
    values = ", ".join(member if "=" in member else f"{member} = {number}"
                       for number, member in enumerate(members))
    return f"typedef {base} {name}; localparam {base} {values};"



WORDS = {"begin", "end", "if", "else", "for", "int", "case", "casez", "endcase", "default",
         "unique", "signed", "unsigned"}


def type_of(name, text):
    """The declared type of a variable."""
    found = re.search(rf"\b(logic(?:\s+signed)?(?:\s*\[[^\]]*\])?|(?:\w+::)?\w+_[te])"
                      rf"\s+(?:\w+\s*,\s*)*{name}\b", text)
    return found and found.group(1)


def explicit_sensitivity(text):
    """always_comb runs at first and whenever one of the signals changes that it reads and does not
    write, and shows what it has computed at its end. (Icarus 11 also runs it when it has written a
    part of a vector, and shows others a default before the result: both may go on for ever.)"""
    position = 0
    while (start := text.find("always_comb begin", position)) >= 0:
        depth, end = 0, start
        for word in re.finditer(r"\b(begin|end)\b", text[start:]):
            depth += 1 if word.group() == "begin" else -1
            if depth == 0:
                end = start + word.end()
                break
        body = text[start + len("always_comb "):end]
        code = re.sub(r"\w*'[hbd][0-9a-fA-F_?]+", "", body)
        written = set(re.findall(r"(?:^|;|\)|:|\b(?:begin|end|endcase|else))"
                                 r"\s*(\w+)(?:\.\w+|\[[^]=]*\])*\s*=(?!=)", code))
        written |= set(re.findall(r"\{([\w, ]+)\}\s*=(?!=)", code))
        written |= {name.strip() for group in written for name in group.split(",")}
        read = set(re.findall(r"(?<![.$\w'])([a-z]\w+)\b(?!\s*')(?!::)", code)) - WORDS - written
        read = sorted(name for name in read if not "_pkg" in name)
        written = sorted(name for name in written if type_of(name, text))
        shadows = " ".join(f"{type_of(name, text)} {name}_shadow;" for name in written)
        shown = " ".join(f"{name} = {name}_shadow;" for name in written)
        for name in written:
            body = re.sub(rf"(?<![.\w]){name}\b", f"{name}_shadow", body)
        text = (f"{text[:start]}{shadows} always begin {body} {shown} "
                f"@({' or '.join(read)}); end{text[end:]}")
        position = start + len(shadows) + 12
    return text


def translate(path, packages):
    text = re.sub(r"//[^\n]*", "", path.read_text(encoding="utf-8"))
    if path.stem in packages:
        text = re.sub(r"^\s*(?:package\s.*|endpackage.*)$", "", text, flags=re.M)
        names = "|".join(sorted(packages[path.stem], key=len, reverse=True))
        text = re.sub(rf"\b({names})\b", rf"{path.stem}_\1", text)
    text = explicit_sensitivity(text)
    text = re.sub(r"\b(\w+_pkg)::(\w+)", r"\1_\2", text)
    text = re.sub(r"\btypedef enum (logic \[[^]]*\])\s*\{([^}]*)\}\s*(\w+)\s*;",
                  plain_enum, text)
    text = re.sub(r"\bint unsigned\b", "int", text)
    text = re.sub(r"\bunique0?\s+(case[xz]?)\b", r"\1", text)
    # Icarus casts no member of a struct.
    text = re.sub(r"\b(\d+)'\((\w+\.[\w.]+)\)", r"(\1'd0 | \2)", text)
    return re.sub(r"\bsigned'\(", "$signed(", text)


def with_fault(path, text, fault):
    """The text, with the fault if it belongs to this file."""
    if not fault or path.stem != fault[0]:
        return text
    if text.count(fault[1]) != 1:
        raise SystemExit(f"{path.stem}: '{fault[1]}' occurs {text.count(fault[1])} times")
    return text.replace(fault[1], fault[2])


def changed(path, fault, folder):
    """The file itself, or a copy of it with the fault."""
    if path.stem != fault[0]:
        return path
    copy = folder / path.name
    copy.write_text(with_fault(path, path.read_text(encoding="utf-8"), fault), encoding="utf-8")
    return copy


def build(folder, fault=None):
    folder.mkdir(parents=True, exist_ok=True)
    packages = {p.stem: package_names(p.read_text(encoding="utf-8"))
                for p in project.rtl_packages()}
    files = []
    for path in project.rtl_files():
        text = with_fault(path, translate(path, packages), fault)
        files.append(folder / path.name)
        files[-1].write_text(text, encoding="utf-8")
    program = folder / "bench.vvp"
    status, text = project.run([project.tool("iverilog"), "-g2012", f"-I{project.INCLUDE}",
                                "-o", program, "-s", "bench", *files, HERE / "bench.sv"])
    messages = [line for line in text.splitlines() if not re.fullmatch(HARMLESS, line)]
    if status != 0 or messages:
        raise SystemExit("\n".join(messages) or text)
    return program


def play(program, *arguments):
    status, text = project.run([project.tool("vvp"), "-n", program, *arguments])
    return status == 0 and re.search(r"^passed", text, re.M) and "FAILED" not in text, text


def compiled(folder, top, files):
    """bench.sv with these files, each read as Verilog 2005 first, without a message."""
    define = top.removeprefix("mb4_").upper()
    if top != "mb4_core":
        files = [*files, HERE / "plain_tops.v"]
    options = [project.tool("iverilog"), f"-D{define}"]
    program = folder / f"{top}.vvp"
    for more in (["-g2005", "-Wall", "-t", "null", "-s", "mb4_core", *files],
                 ["-g2012", "-o", program, "-s", "bench", *files, HERE / "bench.sv"]):
        status, text = project.run([*options, *more])
        if status != 0 or text:
            raise SystemExit(f"{top}: {text}")
    return program


def plain(folder):
    """(findings, sentence) of the plain Verilog."""
    findings, texts = [], []
    for top in ("mb4_core", "mb4_engine", "mb4_chip"):   # those with a bench
        extra = [plain_verilog.write("mb4_spi", folder)] if top == "mb4_engine" else []
        good, text = play(compiled(folder, top, [plain_verilog.write(top, folder), *extra]))
        texts.append(f"{top} {text.strip()}")
        if not good:
            findings.append(texts[-1])
    broken = folder / "broken"
    broken.mkdir(exist_ok=True)
    files = [changed(path, FAULTS[1], broken) for path in project.rtl_files()]
    good, _ = play(compiled(broken, "mb4_core", [plain_verilog.write("mb4_core", broken, files)]))
    if good:
        findings.append(f"not noticed: {' | '.join(FAULTS[1])}")
    return findings, ", ".join(texts)


def processor_time():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def speed(program, arguments, turns=3):
    clocks = int(arguments[0])
    icarus, verilated = [], []
    for _ in range(turns):
        begin = processor_time()
        good, text = play(program, f"+speed={clocks}")
        icarus.append(clocks / (processor_time() - begin))
        if not good:
            project.finish([text], "")
        if len(arguments) > 1:
            output = subprocess.run([arguments[1], "bench", "--workload", "A", "--repeats", "1",
                                     "--json"], capture_output=True, check=True).stdout
            verilated.append(json.loads(output)["rates"][0]["clk_per_s"])
    text = f"{statistics.median(icarus):.0f} clocks per second (Icarus, workload A)"
    if verilated:
        ratio = statistics.median(v / i for v, i in zip(verilated, icarus))
        text += f", mb4sim {statistics.median(verilated):.0f}: {ratio:.0f} times as many"
    project.finish([], text)


def main():
    folder = Path(sys.argv[1])
    project.tool("iverilog")
    if "--plain" in sys.argv:
        project.finish(*plain(folder))
    if "--break" in sys.argv:
        findings = []
        for fault in FAULTS:
            good, _ = play(build(folder / fault[0], fault))
            if good:
                findings.append(f"not noticed: {' | '.join(fault)}")
        project.finish(findings, f"{len(FAULTS)} faults, all reported")
    program = build(folder)
    if "--speed" in sys.argv:
        speed(program, sys.argv[sys.argv.index("--speed") + 1:])
    good, text = play(program)
    project.finish([] if good else [text], text.strip())


main()
