#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The decoder of DSL on the recorded line of a simulated motor with faults: without help it must
find each answer as the master has taken it, the errors in it, and the restarts of the link.

  sigrok_dsl_test.py RECORDING ROOT [FRAMES]
"""

import importlib
import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

BIT = 320000 / 3  # ps
DOWNSAMPLE = 5000  # ps
OUT, ENABLE, IN, ENCODER = range(4, 8)


def load(root):
    """tools/sigrok/dsl without sigrok: the package, but for pd.py."""
    folder = Path(root) / "tools" / "sigrok" / "dsl"
    package = importlib.util.module_from_spec(importlib.util.spec_from_loader("dsl", None))
    package.__path__ = [str(folder)]
    sys.modules["dsl"] = package
    return importlib.import_module("dsl.frame")


class Master:
    """What the master has taken."""

    def __init__(self, words):
        self.sampled, self.state, restart, self.answer, good, position, safe = words
        self.sampled, self.restart, self.good = int(self.sampled), restart == "1", good == "1"
        self.position, self.safe = int(position), None if safe == "-" else int(safe)


def read(text):
    edges, frames = {OUT: [], ENABLE: [], IN: [], ENCODER: []}, []
    for line in text.splitlines():
        words = line.split()
        if words[0] == "F":
            frames.append(Master(words[1:]))
        else:
            edges[int(words[0])].append((int(words[1]), int(words[2])))
    return edges, frames


def decode(module, edges):
    line = module.Line(BIT)
    found = [line.edge(time, level) for time, level in edges]
    return [frame for frame in found if frame is not None]


def differences(decoded, frames):
    """What differs, frame by frame; and how many frames, errors and restarts were compared."""
    found, counts = [], {"frames": 0, "words": 0, "bad": 0, "safe": 0, "restarts": 0}
    by_time = {round((frame.begin + 8 * BIT) / BIT): frame for frame in decoded}
    for number, frame in enumerate(frames[:-1]):
        place = round(frame.sampled / BIT)
        other = next((by_time[near] for near in (place, place - 1, place + 1, place + 2, place + 3,
                                                 place + 4) if near in by_time), None)
        if other is None:
            found.append(f"frame {number}, {frame.state}: not found")
            continue
        counts["frames"] += 1
        counts["restarts"] += frame.restart
        if frame.state in ("START", "LEARN", "CHECK"):
            if other.symbol != frame.state:
                found.append(f"frame {number}: {other.symbol} instead of {frame.state}")
            elif bool(other.pattern) == frame.restart:
                found.append(f"frame {number}: pattern {other.pattern}, restart {frame.restart}")
            continue
        if other.answer != frame.answer:
            found.append(f"frame {number}: answer {other.answer} instead of {frame.answer}")
        if frame.state != "running":
            continue
        counts["words"] += 6
        counts["bad"] += not frame.good
        if (other.acceleration is not None) != frame.good:
            found.append(f"frame {number}: acceleration {other.acceleration}, good {frame.good}")
        if frame.safe is not None:
            counts["safe"] += 1
            data, good = other.vertical or (None, False)
            if not good or int.from_bytes(bytes(data[1:6]), "big") != frame.safe:
                found.append(f"frame {number}: safe position {data} {good} instead of {frame.safe}")
        elif other.vertical and other.vertical[1]:
            found.append(f"frame {number}: a good safe position that the master did not take")
    symbols = [frame.symbol for frame in decoded]
    seen = sum(a != "RESET" and b == "RESET" for a, b in zip(symbols, symbols[1:]))
    if abs(seen - counts["restarts"]) > 0:
        found.append(f"{seen} restarts seen, {counts['restarts']} made")
    return found, counts


def check_wires(edges):
    """_IN is the sum of both ends: it is what _OUT says while _EN is 1, a driver's delay apart."""
    late = 60000
    out, enable, seen = (iter(edges[wire]) for wire in (OUT, ENABLE, IN))
    level = {OUT: 1, ENABLE: 0, IN: 1}
    changes = sorted([(time, OUT, value) for time, value in out] +
                     [(time, ENABLE, value) for time, value in enable] +
                     [(time, IN, value) for time, value in seen])
    wrong, since, last = 0, 0, 0
    for time, wire, value in changes:
        if level[ENABLE] and level[OUT] != level[IN] and time - max(since, last) > late:
            wrong += 1
        if wire != IN:
            since = time
        last = time
        level[wire] = value
    return wrong


def by_sigrok(root, edges, decoded):
    """The states and safe positions that sigrok prints are those of the plain decoder. False: not."""
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / "line.vcd"
        lines = ["$timescale 1 ps $end", "$var wire 1 L LINE $end", "$enddefinitions $end"]
        lines += [f"#{time}\n{level}L" for time, level in edges]
        path.write_text("\n".join(lines) + "\n", encoding="ascii")
        text = subprocess.run(
            ["sigrok-cli", "-I", f"vcd:downsample={DOWNSAMPLE}", "-i", path, "-P", "dsl:line=LINE", "-A",
             "dsl=states:safes"], check=True, capture_output=True, text=True,
            env={**os.environ, "SIGROKDECODE_DIR": str(Path(root).resolve() / "tools" / "sigrok")}).stdout
    printed = sorted(line.removeprefix("dsl-1: ") for line in text.splitlines())
    expected = [frame.symbol for frame in decoded]
    for frame in decoded:
        for channel, safe in ((1, frame.vertical), (2, frame.secondary)):
            if safe is not None:
                data = safe[0][1:6]
                shown = "?" if None in data else bytes(data).hex().upper()
                expected.append(f"Safe position {channel}: {shown}")
    if printed != sorted(expected):
        print(f"sigrok prints {len(printed)} lines, {len(expected)} were expected")
        return False
    print(f"sigrok prints the same {len(printed)} states and safe positions")
    return True


def main():
    recording, root = sys.argv[1:3]
    frames = sys.argv[3] if len(sys.argv) > 3 else "10000"
    text = subprocess.run([recording, frames], check=True, capture_output=True, text=True).stdout
    module = load(root)
    edges, taken = read(text)
    decoded = decode(module, edges[IN])
    found, counts = differences(decoded, taken)
    for line in found[:20]:
        print(line)
    print(f"{len(decoded)} frames decoded, {counts}, {len(found)} differences")
    if found or check_wires(edges):
        return 1
    some = [edge for edge in edges[IN] if edge[0] < 5_000_000_000]  # 5 ms
    if shutil.which("sigrok-cli") and not by_sigrok(root, some, decode(module, some)):
        return 1
    if counts["restarts"] < 2 or counts["bad"] < 20 or counts["safe"] < 100:
        print("too few faults to say anything")
        return 1
    # The comparison must be able to fail: one bit of the line more.
    broken = list(edges[IN])
    begin = next(frame for frame in decoded if frame.symbol == "IDLE").at(40)
    place = next(i for i, (time, _) in enumerate(broken) if time > begin)
    del broken[place:place + 2]
    if not differences(decode(module, broken), taken)[0]:
        print("two lost edges were not noticed")
        return 1
    return 0


sys.exit(main())
