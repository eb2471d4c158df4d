# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Frames as a table of pandas, which `pip install openmb4[pandas]` brings."""

from typing import Any, Optional, Sequence

import numpy as np
import numpy.typing as npt

from ._library import Error
from .codes import Code


def to_pandas(rows: npt.NDArray[Any], slaves: Optional[Sequence[int]] = None) -> Any:
    """The rows of Driver.read_all() or automatic_next() as a pandas.DataFrame, one line for each word:
    frame (from 0 on), time_ns, slave, code, position, raw, crc, slave_error, slave_warning. `code` is
    the name of a Code: "OK" for a good word. `slaves`: which ones; by default those that the driver
    reads, and all eight where no frame has come."""
    try:
        import pandas
    except ImportError as error:
        raise Error("to_pandas: pandas is not installed: pip install openmb4[pandas]") from error
    codes, readings = rows["frame"]["code"], rows["frame"]["reading"]
    if slaves is None:
        # What the driver was not told to read is INVALID_ARGUMENT in every frame that has come.
        came = rows["result"]["code"] == Code.OK
        there = (codes[came] != Code.INVALID_ARGUMENT).any(axis=0)
        slaves = [int(each) + 1 for each in np.flatnonzero(there)] or range(1, codes.shape[1] + 1)
    for slave in slaves:
        if not 1 <= slave <= codes.shape[1]:
            raise Error(f"to_pandas: slave is 1 to {codes.shape[1]}, not {slave}")
    chosen = [slave - 1 for slave in slaves]
    names = [Code(number).name for number in range(len(Code))]
    return pandas.DataFrame({
        "frame": np.repeat(np.arange(len(rows)), len(chosen)),
        "time_ns": np.repeat(rows["time_ns"], len(chosen)),
        "slave": np.tile(np.array(slaves, np.int64), len(rows)),
        "code": pandas.Categorical.from_codes(codes[:, chosen].ravel().astype(np.int8), names),
        **{name: readings[name][:, chosen].ravel()
           for name in ("position", "raw", "crc", "slave_error", "slave_warning")}})
