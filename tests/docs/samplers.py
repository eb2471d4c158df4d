#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The margins of the samplers in docs/samplers.md, by `mb4sim sweep`: one encoder of 12 bits with CRC behind delays of 0 to
12 periods of MA.

  samplers.py MB4SIM ROOT           each margin of the page holds, in fewer frames and with another seed
  samplers.py MB4SIM ROOT --write   measures, and writes the table of the page and docs/pictures/samplers.svg
"""

import csv
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

MARK = "<!-- measured by tests/docs/samplers.py -->\n"
STEP = 5  # percent of T_MA
MOST = 70
FRAMES = 8  # at each delay and jitter


class Sampler(NamedTuple):
    name: str
    mhz: int
    master: str   # [master], [chip] and [chip.quirks] of the scenario
    code: int     # of the frequency, for sweep


def master(kind, clock, more=""):
    return f'[master]\ntype = "{kind}"\n[chip]\nf_clk_hz = {clock}_000_000\n{more}'


SAMPLERS = [
    Sampler("`biss_sl_sampler`: iC-MB4, four points", 10, master("ic-mb4", 20), 0),
    Sampler("`biss_delay_sampler`: `biss_axi` at 100 MHz", 10, master("axi", 100), 5),
    Sampler("`biss_frame_sampler`: `biss_axi` at 100 MHz with FRAME_SAMPLER", 10, master("axi", 100, 'features = "frames"\n'), 5),
    Sampler("`biss_frame_sampler`: the same at 200 MHz", 10, master("axi", 200, 'features = "frames"\n'), 10),
    Sampler("`clb_state`: `biss_clb` at 200 MHz", 10, master("clb", 200), 9),
    Sampler("`biss_os_sampler`: `biss_pru`, without the average", 10, master("pru", 200), 10),
    Sampler("the same with `FIRST_LOW`", 10, master("pru", 200, "[chip.quirks]\nFIRST_LOW = true\n"), 10),
    Sampler("`biss_os_sampler`: `biss_pru`, with the average", 5, master("pru", 200), 5),
    Sampler("the same with `FIRST_LOW`", 5, master("pru", 200, "[chip.quirks]\nFIRST_LOW = true\n"), 5),
]


def scenario(sampler, skew):
    """A skew above 0 delays the falling edges of SL, in percent of T_MA."""
    return (sampler.master + f"[host]\nma_hz = {sampler.mhz}_000_000\n[[channel]]\nnumber = 1\n"
            f"skew_ns = {skew * 10 / sampler.mhz}\n[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 14\ncrc = 0x43\n"
            'source = "ramp"\nstart = 1234\nstep = 1001\n')


class Bench:
    def __init__(self, mb4sim, folder):
        self.mb4sim, self.folder = mb4sim, Path(folder)

    def sweep(self, sampler, jitters, skew, frames, seed, delays=121):
        """Words and bad ones by jitter."""
        path, rows = self.folder / "line.toml", self.folder / "sweep.csv"
        path.write_text(scenario(sampler, skew), encoding="utf-8")
        period = 1000 / sampler.mhz
        step = 12 * period / (delays - 1)
        result = subprocess.run(
            [self.mb4sim, "sweep", str(path), "--delays", f"0:{12 * period:g}:{step:g}", "--jitters", jitters, "--freqs",
             str(sampler.code), "--frames", str(frames), "--seed", str(seed), "--csv", str(rows)],
            capture_output=True, text=True, check=False)
        if result.returncode not in (0, 1):
            raise SystemExit(result.stderr)
        words, bad = {}, {}
        with open(rows, encoding="utf-8", newline="") as file:
            for row in csv.DictReader(file):
                jitter = float(row["jitter_percent"])
                words[jitter] = words.get(jitter, 0) + int(row["words"])
                bad[jitter] = bad.get(jitter, 0) + int(row["flagged"]) + int(row["wrong"])
        return words, bad


def margin(bad):
    """The highest jitter up to which no word was bad."""
    good = [jitter for jitter in sorted(bad) if all(bad[each] == 0 for each in bad if each <= jitter)]
    return int(good[-1]) if good else None


def measure(bench, frames):
    """Of each sampler: the margin of jitter, the widest skews either way, the curve."""
    found = []
    for sampler in SAMPLERS:
        words, bad = bench.sweep(sampler, f"0:{MOST}:{STEP}", 0, frames, 1)
        skews = []
        for sign in (-1, 1):
            skew = 0
            while skew < MOST:
                _, of_skew = bench.sweep(sampler, "0", sign * (skew + STEP), 1, 1)
                if any(of_skew.values()):
                    break
                skew += STEP
            skews.append(skew)
        found.append((sampler, margin(bad), skews, {jitter: bad[jitter] / words[jitter] for jitter in words}))
        print(f"{sampler.name}, {sampler.mhz} MHz: jitter {found[-1][1]} %, skew {skews}")
    return found


def table(found):
    lines = ["| sampler | MA | jitter of SL | falling edges of SL late | early |", "|---|---|---|---|---|"]
    for sampler, jitter, (early, late), _ in found:
        lines.append(f"| {sampler.name} | {sampler.mhz} MHz | {jitter} % | {late} % | {early} % |")
    return "\n".join(lines) + "\n"


def draw(found, path):
    import matplotlib
    matplotlib.use("svg")
    matplotlib.rcParams.update({"svg.hashsalt": "samplers", "svg.fonttype": "none", "font.size": 10})
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(9, 4.6), layout="constrained")
    styles = ["-", "-", "-", "--", "-", "-", "--", "-", "--"]
    colours = ["#1f4e8c", "#2a8f5a", "#333333", "#333333", "#b5651d", "#a02c5d", "#a02c5d", "#6a51a3", "#6a51a3"]
    names = ["iC-MB4, 10 MHz", "biss_axi, 10 MHz", "biss_axi by frames, 10 MHz", "the same, 200 MHz",
             "biss_clb, 10 MHz", "biss_pru, 10 MHz", "the same, FIRST_LOW",
             "biss_pru, average, 5 MHz", "the same, FIRST_LOW"]
    for (_, _, _, curve), style, colour, name in zip(found, styles, colours, names):
        jitters = sorted(curve)
        axes.plot(jitters, [100 * curve[each] for each in jitters], style, color=colour, marker="o", markersize=3, label=name)
    axes.set_yscale("symlog", linthresh=0.01)
    axes.set_yticks([0, 0.01, 0.1, 1, 10, 100], ["0", "0.01", "0.1", "1", "10", "100"])
    axes.set_ylim(bottom=-0.002)
    axes.set_xlabel("jitter of SL, peak to peak, % of T_MA")
    axes.set_ylabel("bad words, %")
    axes.grid(alpha=0.3)
    axes.legend(frameon=False, loc="upper left")
    figure.savefig(path, metadata={"Date": None})


def check(bench, page):
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in page.split(MARK)[1].splitlines()[2:]
            if line.startswith("|")]
    if [(row[0], row[1]) for row in rows] != [(each.name, f"{each.mhz} MHz") for each in SAMPLERS]:
        return ["docs/samplers.md: other samplers than those of tests/docs/samplers.py"]
    findings = []
    for sampler, row in zip(SAMPLERS, rows):
        jitter, late, early = (int(re.match(r"(\d+) %", cell)[1]) for cell in row[2:5])
        # Within each margin all words are good; three steps beyond it some are not.
        for jitters, skew, good in ((jitter, 0, True), (0, late, True), (0, -early, True), (jitter + 3 * STEP, 0, False),
                                    (0, late + 3 * STEP, False), (0, -early - 3 * STEP, False)):
            words, bad = bench.sweep(sampler, str(jitters), skew, 2 if good else FRAMES, 7, 41)
            if not words or any(bad.values()) == good:
                findings.append(f"{sampler.name}, {sampler.mhz} MHz: {sum(bad.values())} bad words with jitter {jitters} %, "
                                f"skew {skew} %")
    return findings


def main():
    if len(sys.argv) not in (3, 4) or sys.argv[3:] not in ([], ["--write"]):
        raise SystemExit(__doc__)
    root = Path(sys.argv[2])
    page = root / "docs" / "samplers.md"
    text = page.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(sys.argv[1], folder)
        if len(sys.argv) == 3:
            findings = check(bench, text)
            print("\n".join(findings) or f"{len(SAMPLERS)} samplers, each margin holds")
            return 1 if findings else 0
        found = measure(bench, FRAMES)
    before, after = text.split(MARK)[0], text.split(MARK)[2]
    page.write_text(before + MARK + table(found) + MARK + after, encoding="utf-8")
    draw(found, root / "docs" / "pictures" / "samplers.svg")
    return 0


sys.exit(main())
