# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Reads the file that describes a model: MODEL.toml.

  prefix     the class that Verilator makes
  namespace  the C++ namespace of the header
  clocks     the clock's pin, and variables that are this clock while the edge functions are in use
  host       optional: pins whose edges host() evaluates
  seen       optional: variables. host() tells their changes, and those of what a clock's edge reads
  released   optional: clocks or resets that an edge of the clock may change: the code that uses the
             header looks for the change, or the change starts nothing
  [follow]   optional: FUNCTION = [pins]. Such a pin changes without eval(). The function computes
             what depends on it before the next edge
  [changed]  optional: FUNCTION = [variables]. The function tells the parts that these have changed

Variables have the names of the source, as in TOP.u_part.gen_line[0].count_q."""

import tomllib
from dataclasses import dataclass, field

from generated_model import NotUnderstood


@dataclass
class Description:
    prefix: str
    namespace: str
    clocks: list
    host: list = field(default_factory=list)
    seen: list = field(default_factory=list)
    released: list = field(default_factory=list)
    follow: dict = field(default_factory=dict)
    changed: dict = field(default_factory=dict)

    @property
    def root(self):
        return f"{self.prefix}___024root"

    def variables(self):
        """All names that the file mentions."""
        return {name for names in (self.clocks, self.host, self.seen, self.released,
                                   *self.follow.values(), *self.changed.values()) for name in names}

    def events(self, edge):
        """The events of the clock, as Verilator names them."""
        return {f"{edge} {name}" for name in self.clocks}


def member(name):
    """The name of a variable in the generated class."""
    return name.replace(".", "__DOT__").replace("[", "__BRA__").replace("]", "__KET__")


def members(names):
    return [member(name) for name in names]


def read(path):
    try:
        return Description(**tomllib.loads(path.read_text(encoding="utf-8")))
    except (TypeError, ValueError) as error:
        raise SystemExit(f"{path}: {error}") from error


def check(description, places):
    unknown = sorted(name for name in description.variables() if member(name) not in places)
    if unknown:
        raise NotUnderstood(f"the model has no {', '.join(unknown)}")
