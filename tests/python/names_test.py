# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Every public name of the package has a docstring."""

import importlib
import inspect
import pkgutil

import openmb4
import pytest

MODULES = ["openmb4"] + [f"openmb4.{one.name}" for one in pkgutil.iter_modules(openmb4.__path__)
                         if not one.name.startswith(("_", "lib"))]


def members(place, owner):
    """Classes, functions and properties that `owner` has of its own, with those inside them."""
    for name, value in vars(owner).items():
        if name.startswith("_"):
            continue
        value = getattr(value, "__func__", value)
        if isinstance(value, property) or inspect.isfunction(value):
            yield f"{place}.{name}", value
        elif inspect.isclass(value) and value.__module__.startswith("openmb4"):
            yield f"{place}.{name}", value
            if value.__module__ == (owner.__name__ if inspect.ismodule(owner) else owner.__module__):
                yield from members(f"{place}.{name}", value)


def public():
    for name in MODULES:
        module = importlib.import_module(name)
        assert module.__doc__, name
        for place, value in members(name, module):
            if getattr(value, "__module__", "openmb4").startswith("openmb4"):
                yield place, value


FOUND = dict(public())


def test_the_names_are_found():
    assert {"openmb4.Simulator", "openmb4.simulator.Simulator.record", "openmb4.driver.Driver.verify",
            "openmb4.codes.Code", "openmb4.to_pandas", "openmb4.plot.timing"} <= FOUND.keys()
    assert len(FOUND) > 100
    assert set(openmb4.__all__) >= {name for name in vars(openmb4) if inspect.isclass(
        getattr(openmb4, name)) and getattr(openmb4, name).__module__.startswith("openmb4.")}


@pytest.mark.parametrize("place", FOUND)
def test_has_a_docstring(place):
    text = FOUND[place].__doc__
    # namedtuple and dataclass make one of the fields, which says nothing.
    assert text and not text.startswith(f"{place.rpartition('.')[2]}("), place
