# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Where the files of an installed package are."""

from pathlib import Path

from ._library import HERE


def files() -> Path:
    """The folder of the package. In it a wheel has bin/mb4sim, lib/ with libmb4sim.so, pkgconfig and
    cmake, include/ and share/."""
    return HERE


def examples() -> Path:
    """The folder with the example scenarios."""
    return HERE / "share" / "openmb4" / "examples"
