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
        self.sampled, self.state, restart, self.answer, good, errors, position, *safe = words
        self.sampled, self.restart, self.good = int(self.sampled), restart == "1", good == "1"
        self.errors, self.position = int(errors), int(position)
        self.safe = [None if one == "-" else int(one) for one in safe]  # of both channels


def read(text):
    edges, frames, messages = {OUT: [], ENABLE: [], IN: [], ENCODER: []}, [], []
    for line in text.splitlines():
        words = line.split()
        if words[0] == "F":
            frames.append(Master(words[1:]))
        elif words[0] == "M":
            messages.append(tuple(bytes.fromhex(word) for word in words[1:]))
        else:
            edges[int(words[0])].append((int(words[1]), int(words[2])))
    return edges, frames, messages


def messages_of(decoded):
    talk = importlib.import_module("dsl.message").Talk()
    found = []
    for frame in decoded:
        if frame.symbol in ("RESET", "SYNC", "START", "LEARN", "CHECK", "ID REQ"):
            talk.clear()
        else:
            found += talk.take(frame)
    return found


def check_messages(decoded, taken):
    """The decoder has each message that went well, request and answer, in their order."""
    found, texts = messages_of(decoded), set()
    good = iter([message for message in found if message.good])
    missing = 0
    for request, answer in taken:
        for data, is_answer in ((request, False), (answer, True)):
            message = next((one for one in good if one.answer == is_answer and one.data == data), None)
            missing += message is None
            texts.add(message.text() if message else None)
    bad = sum(not message.good for message in found)
    print(f"messages: {len(taken)} went well, {missing} requests or answers were not found; {bad} were broken")
    expected = {"write 7Fh = AB", "7Fh written", "read 7Fh", "7Fh is AB", "read 000h, 4 bytes", "000h: 52 4F 4F 54",
                "read 081h, 8 bytes", "081h: 52 45 53 4F 4C 55 54 4E", "read 40h", "40h is 01",
                "read 081h offset 3, 2 bytes", "081h: 00 0F", "write 000h value: 12 34", "000h value: error 41/10",
                "read 082h value, 4 bytes", "082h value: 00 00 10 00"}
    if texts != expected:
        print(f"messages: {texts ^ expected}")
    return missing == 0 and len(taken) > 100 and 0 < bad < len(taken) // 10 and texts == expected


def decode(module, edges, drives=()):
    """With `drives`, the edges of the master's driver."""
    line = module.Line(BIT)
    found = []
    for time, driver, level in sorted([(time, False, level) for time, level in edges] +
                                      [(time, True, level) for time, level in drives]):
        if driver:
            line.driver(time, level)
        else:
            found.append(line.edge(time, level))
    return [frame for frame in found if frame is not None]


def differences(decoded, frames):
    """What differs, frame by frame; and how many frames, errors and restarts were compared."""
    found, counts = [], {"frames": 0, "words": 0, "errors": 0, "bad": 0, "safe": 0, "restarts": 0}
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
        errors = sum(byte is None for byte, _ in other.words.values())
        counts["errors"] += errors
        if errors != frame.errors:
            found.append(f"frame {number}: {errors} words are none instead of {frame.errors}")
        for safe, channel in zip(frame.safe, (other.vertical, other.secondary)):
            if safe is not None:
                counts["safe"] += 1
                data, good = channel or (None, False)
                if not good or int.from_bytes(bytes(data[1:6]), "big") != safe:
                    found.append(f"frame {number}: safe position {data} {good} instead of {safe}")
            elif channel and channel[1]:
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


def check_encoder(edges):
    """While the master's driver is off, _IN is what _ENCODER was a cable earlier."""
    one_way, jitter, off = 35 * 5300, 8000, 60000
    sent = edges[ENCODER]
    level, since, place, wrong, compared = 0, 0, 0, 0, 0
    changes = sorted([(time, 0, value) for time, value in edges[ENABLE]] +
                     [(time, 1, value) for time, value in edges[IN]])
    for time, wire, value in changes:
        if wire == 0:
            level, since = value, time
        elif not level and time - since > off:
            while place < len(sent) and sent[place][0] < time - one_way - jitter - 1:
                place += 1
            compared += 1
            wrong += not any(before <= time - one_way + 1 and there == value
                             for before, there in sent[place:place + 3])
    return wrong, compared


def check_driver(module, edges):
    """EN shows the window of each frame; a window that is moved by a bit is told."""
    shown = decode(module, edges[IN], edges[ENABLE])
    plain = decode(module, edges[IN])
    if [frame.answer for frame in shown] != [frame.answer for frame in plain]:
        print("EN changes what is decoded")
        return False
    told = [frame.driver_mistake() for frame in shown if frame.symbol not in ("RESET", "SYNC")]
    known = sum(frame.off is not None for frame in shown)
    moved = decode(module, edges[IN], [(time + round(BIT), level) for time, level in edges[ENABLE]])
    told_moved = [frame.driver_mistake() for frame in moved if frame.symbol not in ("RESET", "SYNC")]
    print(f"EN: {known} windows, {len(told) - told.count(None)} are elsewhere; "
          f"{told_moved.count(None)} of {len(told_moved)} if moved by a bit")
    return known > 9000 and told.count(None) == len(told) and told_moved.count(None) == 0


def check_extra(module):
    """A drive in sync mode: whole ones and eighths in SAMPLE, stuffing behind the trailer."""
    words = {"IDLE": "1001001101", "START": "0101100100"}
    bits, expected = [], []
    for number in range(40):
        symbol, extra, blocks = ("IDLE", "START")[number % 2], (0, 4, 5.125, 9.875)[number % 4], number % 5
        level = "0" * 8 + "0" * 8 + "1" * 8 + "0" * 8 + "1" * 32 + "1" * round(8 * extra)
        for bit in "0110" + "0000" + words[symbol] + "1" * 74 + "00000011" + blocks * "001011":
            level += 8 * bit
        bits.append(level)
        expected.append((symbol, extra))
    line, found, last = module.Line(BIT), [], "1"
    for place, level in enumerate("".join(bits)):
        if level != last:
            found.append(line.edge(1e6 + place * BIT / 8, int(level)))
        last = level
    found = [(frame.symbol, frame.extra) for frame in found if frame is not None]
    if found != expected[:-1]:
        print(f"sync mode: {found}")
        return False
    return True


def check_samples(module, edges, decoded):
    """A logic analyser with few samples: what it takes is the level at its own times."""
    some = [edge for edge in edges[IN] if edge[0] < 20_000_000_000]  # 20 ms
    for rate in (37_500_000, 100_000_000):
        step = 1e12 / rate
        taken = {}
        for time, level in some:
            taken[int(-(-time // step))] = level
        line = module.Line(rate / 9_375_000)
        found = [frame for frame in (line.edge(*edge) for edge in taken.items()) if frame is not None]
        expected = [(frame.symbol, frame.answer) for frame in decoded[:len(found)]]
        if len(found) < 1500 or [(frame.symbol, frame.answer) for frame in found] != expected:
            print(f"{rate / 1e6} million samples a second: another result")
            return False
    return True


def check_without_training(module, edges, decoded):
    """From the middle of a link the decoder finds the same answers, at each of some begins."""
    running = [frame for frame in decoded if frame.symbol == "IDLE"]
    answers = {frame.begin: frame.answer for frame in decoded}
    for number in range(200, len(running) - 60, 531):
        begin, end = running[number].at(3), running[number + 30].begin
        found = decode(module, [edge for edge in edges[IN] if begin < edge[0] < end])
        if any(frame.symbol != "IDLE" for frame in found):
            continue  # a restart
        with_answer = [frame for frame in found if frame.answer is not None]
        wrong = [frame for frame in with_answer if answers.get(frame.begin) != frame.answer]
        if len(with_answer) < 20 or wrong:
            print(f"from frame {number} on: {len(with_answer)} answers, {len(wrong)} wrong")
            return False
    return True


def by_sigrok(root, edges, decoded, drives=(), inverted=False):
    """The states and safe positions that sigrok prints are those of the plain decoder. False: not.

    `inverted`: the probe is on the other wire of the pair."""
    if inverted:
        edges = [(time, 1 - level) for time, level in edges]
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / "line.vcd"
        lines = ["$timescale 1 ps $end", "$var wire 1 L LINE $end", "$var wire 1 E EN $end",
                 "$enddefinitions $end"]
        lines += [f"#{time}\n{level}{wire}" for time, level, wire in
                  sorted([(*edge, "L") for edge in edges] + [(*edge, "E") for edge in drives])]
        path.write_text("\n".join(lines) + "\n", encoding="ascii")
        text = subprocess.run(
            ["sigrok-cli", "-I", f"vcd:downsample={DOWNSAMPLE}", "-i", path, "-P",
             f"dsl:line=LINE{':en=EN' * bool(drives)}{':invert=yes' * inverted}", "-A", "dsl=states:safes:drivers:requests:replies"],
            check=True, capture_output=True, text=True,
            env={**os.environ, "SIGROKDECODE_DIR": str(Path(root).resolve() / "tools" / "sigrok")}).stdout
    printed = sorted(line.removeprefix("dsl-1: ") for line in text.splitlines())
    expected = [frame.symbol for frame in decoded]
    messages = [message.text() for message in messages_of(decoded)]
    if not messages:
        print("no message")
        return False
    expected += messages
    for frame in decoded:
        byte, special = frame.words.get("s_par", (None, False))
        if frame.symbol not in ("ID REQ", "INIT") and byte is not None and not special:
            name = {0x15: "Short NAK", 0x1A: "Long NAK", 0x1F: "INIT"}.get(byte & 0x1F)
            expected += [name] if name else []
    if drives:
        expected += ["Master", "Encoder", "Master"] * sum(frame.off is not None for frame in decoded)
    for frame in decoded:
        for channel, safe in ((1, frame.vertical), (2, frame.secondary)):
            if safe is not None:
                data = safe[0][1:6]
                shown = "?" if None in data else bytes(data).hex().upper()
                expected.append(f"Safe position {channel}: {shown}")
    if printed != sorted(expected):
        print(f"sigrok prints {len(printed)} lines, {len(expected)} were expected")
        return False
    print(f"sigrok prints the same {len(printed)} states, safe positions and drivers")
    return True


def main():
    recording, root = sys.argv[1:3]
    frames = sys.argv[3] if len(sys.argv) > 3 else "10000"
    text = subprocess.run([recording, frames], check=True, capture_output=True, text=True).stdout
    module = load(root)
    edges, taken, messages = read(text)
    decoded = decode(module, edges[IN])
    found, counts = differences(decoded, taken)
    for line in found[:20]:
        print(line)
    print(f"{len(decoded)} frames decoded, {counts}, {len(found)} differences")
    if found or check_wires(edges):
        return 1
    wrong, compared = check_encoder(edges)
    print(f"_IN against _ENCODER: {compared} edges, {wrong} differ")
    if wrong or compared < 100000:
        return 1
    if not check_messages(decoded, messages):
        return 1
    if not check_extra(module) or not check_samples(module, edges, decoded):
        return 1
    if not check_driver(module, edges) or not check_without_training(module, edges, decoded):
        return 1
    identities = {frame.identity() for frame in decoded if frame.symbol == "ID REQ"}
    if identities != {"position 32 bits, unsigned, second difference 11 bits, index 0"}:
        print(identities)
        return 1
    some, drives = ([edge for edge in edges[wire] if edge[0] < 5_000_000_000] for wire in (IN, ENABLE))  # 5 ms
    if shutil.which("sigrok-cli"):
        if not by_sigrok(root, some, decode(module, some)):
            return 1
        if not by_sigrok(root, some, decode(module, some, drives), drives):
            return 1
        if not by_sigrok(root, some, decode(module, some), inverted=True):
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
