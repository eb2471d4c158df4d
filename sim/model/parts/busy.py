# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""What is busy in a model, found by counting: the program that was built with `--count` runs a busy
workload and prints lines `moves COUNT VARIABLE` and `runs COUNT GROUP`."""

from dataclasses import dataclass, field

FAST = 0.45  # a variable is fast if it changes at this share of the clocks
RATES = (("often", 0.05), ("seldom", 0.012))  # the rest: hardly ever


@dataclass
class Busy:
    fast: set = field(default_factory=set)  # variables; NAME==N: whether NAME is N
    rate: dict = field(default_factory=dict)  # {group: "often" or "seldom"}


def busy_of(text):
    """The result of a count. A wrong one costs speed, not results; an empty one is allowed."""
    counts = {"runs": {}, "moves": {}}
    for kind, count, name in map(str.split, text.splitlines()):
        counts[kind][name] = max(int(count), counts[kind].get(name, 0))
    found = Busy()
    if not counts["runs"]:
        return found
    # All groups run after an edge of a host pin, so those runs are subtracted.
    runs = counts["runs"].values()
    least, clocks = min(runs), max(1, max(runs) - min(runs))
    found.fast = {name for name, count in counts["moves"].items() if count / clocks >= FAST}
    for name, count in counts["runs"].items():
        for rate, limit in RATES:
            if (count - least) / clocks >= limit:
                found.rate[name] = rate
                break
    return found
