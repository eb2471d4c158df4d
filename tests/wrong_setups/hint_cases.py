# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The set-ups of setups.toml, and random right ones, for the tests of hints."""

import random
import re
import tomllib
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
FRAMES = 3


@dataclass
class Setup:
    name: str
    scenario: str  # TOML
    lines: list  # what the host sends after the driver has configured the chip
    hint: dict | None = None  # kind, place, names; None: no hint


def scenario_text(name):
    return (HERE / "scenarios" / f"{name}.toml").read_text(encoding="utf-8")


def listed():
    """Each set-up of the list, and the one beside it without the mistake."""
    for entry in tomllib.loads((HERE / "setups.toml").read_text(encoding="utf-8"))["setup"]:
        yield Setup(entry["name"], scenario_text(entry["scenario"]), entry["writes"],
                    {key: entry[key] for key in ("kind", "place", "names")})
        yield Setup(f"beside {entry['name']}",
                    scenario_text(entry.get("beside_scenario", entry["scenario"])), entry["beside"])


def wrong_with(setup, hints):
    """What is wrong with the hints of a set-up, each a dict of kind, place and text; "" if nothing."""
    if setup.hint is None:
        return "" if hints == [] else f"{setup.name}: {hints}"
    if len(hints) != 1:
        return f"{setup.name}: {len(hints)} hints: {hints}"
    hint, text = setup.hint, hints[0]["text"]
    # A number is named as a whole word.
    missing = [name for name in hint["names"]
               if not re.search(rf"(?<![\w.]){re.escape(name)}(?![\w.]*\w)", text + " ")]
    if (hints[0]["kind"], hints[0]["place"]) != (hint["kind"], hint["place"]) or missing:
        return f"{setup.name}: expected {hint}, found {hints[0]}, missing {missing}"
    return ""


def apply(line, spi, advance_ns, set_pin):
    """Does what a line of `mb4sim spi` says."""
    words = line.split()
    if words[0] == "pin":
        set_pin(words[1], int(words[2]))
    elif words[0].startswith("+"):
        advance_ns(int(words[0][1:]))
    else:
        spi(bytes.fromhex("".join(words)))


PRESETS = {"biss-c": ["resolute-26", "lika-sma1", "eds-sensor", "bp3-spw", "ic-mr-mt"],
           "biss-b": ["lika-sma1-b", "ic-nq"], "ssi": ["posital-ssi-25"]}
CRCS = [0, 0x43, 0x43, 0x43, 0x25, 0x12F, 0x190D9, 0x89, 0x5B, 0x13, 0xB, 0x47]
FAULTS = ('kind = "unplug"\nat_us = {at}\nfor_us = {time}\nslave = {slave}',
          'kind = "jitter"\nat_us = {at}\nfor_us = {time}\nchannel = {channel}\njitter_ns = {jitter}',
          'kind = "bit-flip"\nper_s = 20000\nchannel = {channel}',
          'kind = "silent"\nat_us = {at}\nfor_us = {time}\nslave = {slave}',
          'kind = "stuck"\nat_us = {at}\nfor_us = {time}\nchannel = {channel}\nlevel = {level}',
          'kind = "glitch"\nper_s = 50000\nchannel = {channel}\nwidth_ns = 30')


def slave_keys(dice, protocol, period_ns):
    """Keys of a slave; periods of MA are shorter than its timeout."""
    keys = [f'protocol = "{protocol}"']
    if dice.random() < 0.3:
        keys.append(f'preset = "{dice.choice(PRESETS[protocol])}"')
        return keys
    bits = dice.choice([3, 12, 24, 26, 32, 48, 64, dice.randint(3, 64)])
    crc = dice.choice(CRCS) if protocol != "ssi" else dice.choice([0, 0, 0x43])
    keys += [f"data_bits = {bits}", f"flag_bits = {dice.choice([0, 2])}", f"crc = 0x{crc:X}"]
    if crc and dice.random() < 0.3:
        keys.append(f"crc_start = {dice.randrange(1 << 3)}")
    if dice.random() < 0.3:
        keys.append(f"timeout = {1.2 * period_ns / 1000 + dice.randint(1, 20)}")
    if protocol == "ssi":
        keys.append(f"gray = {dice.choice(['true', 'false'])}")
        if bits <= 32 and dice.random() < 0.3:
            keys.append("ring = true")
    return keys + ['source = "ramp"', "step = 3"]


def right(seed, faults=False):
    """A random set-up in which the driver configures the chip as the scenario says."""
    dice = random.Random(f"{seed} {faults}")
    clk = dice.choice([20_000_000, 20_000_000, 10_000_000, 0])
    divider = dice.choice([2, 4, 4, 8, 20, 40])
    period_ns = divider * 1e9 / (clk or 20_000_000)
    lines = ["[sim]", f"seed = {seed}", "[chip]", f"f_clk_hz = {clk}", "[host]",
             f'ma_hz = {(clk or 20_000_000) // divider}']
    channels = dice.choice([[1], [1], [2], [1, 2]])
    slaves = []
    for channel in channels:
        protocol = dice.choice(["biss-c", "biss-c", "biss-b", "ssi"])
        most = (period_ns - 30) * 0.9 if protocol == "ssi" else 3000
        lines += ["[[channel]]", f"number = {channel}", f"delay_ns = {dice.uniform(0, most):.3f}"]
        if dice.random() < 0.3 and protocol != "ssi":
            lines.append(f"jitter_ns = {dice.uniform(0, period_ns / 4):.3f}")
        for i in range(1 if protocol == "ssi" else dice.randint(1, 3)):
            lines += ["[[channel.slave]]", *slave_keys(dice, protocol, period_ns)]
            slaves.append((channel, (1 if channel == 1 else 5) + i))
    if faults:
        for _ in range(dice.randint(1, 2)):
            channel, slave = dice.choice(slaves)
            lines += ["[[fault]]", dice.choice(FAULTS).format(
                at=dice.randint(1, 300), time=dice.randint(1, 300), slave=slave, channel=channel,
                jitter=int(period_ns * dice.uniform(0.3, 2)), level=dice.randint(0, 1))]
    return Setup(f"right set-up {seed}{' with faults' if faults else ''}", "\n".join(lines) + "\n", [])


def rights(count, first):
    """As many right set-ups, every second one with faults."""
    for i in range(count):
        yield right(first + i, faults=i % 2 == 1)
