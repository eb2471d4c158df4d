# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of frames with matplotlib, which `pip install openmb4[plot]` brings. Every function draws
on the axes that it is given, or on new ones, and returns them."""

from typing import Any, Optional, Sequence, Tuple

import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes

from ._library import Error
from .record import Edges

GOOD, BAD, LINE = "#0072b2", "#d55e00", "#333333"  # colours that the colour-blind tell apart


def _axes(axes: Optional[Axes], height: float = 3.0) -> Axes:
    return axes if axes is not None else plt.subplots(
        figsize=(9.0, height), layout="constrained")[1]


def timing(record: Edges, axes: Optional[Axes] = None) -> Axes:
    """A timing diagram of what Simulator.record() took: one row for each pin, time in us."""
    axes = _axes(axes, 0.8 + 0.6 * len(record.pins))
    for row, name in enumerate(reversed(list(record.pins))):
        times, levels = record.pins[name]
        times = np.append(times, record.end_ps)
        levels = np.append(levels, levels[-1])
        axes.step((times - record.start_ps) / 1e6, row + 0.7 * levels, where="post", color=LINE,
                  linewidth=1.2)
    axes.set_yticks([row + 0.35 for row in range(len(record.pins))], list(record.pins)[::-1])
    axes.tick_params(axis="y", length=0)
    axes.set_xlim(0, (record.end_ps - record.start_ps) / 1e6)
    axes.set_xlabel("time / us")
    axes.spines[["top", "right", "left"]].set_visible(False)
    return axes


def _start_bit(rising: npt.NDArray[Any], period: int, sl: Any, end: int) -> int:
    """When SL rose with the start bit of the last frame that has ended in a record: a pause comes
    behind it."""
    times, levels = sl
    begins = rising[np.flatnonzero(np.diff(rising, prepend=-end) > 4 * period)]
    if end - rising[-1] < 10 * period:
        begins = begins[:-1]
    begin = begins[-1] if len(begins) else end
    acknowledge = times[(times > begin) & (levels == 0)][:1]
    start = times[(times > acknowledge) & (levels == 1)][:1] if len(acknowledge) else acknowledge
    if not len(start):
        raise Error("eye: no frame has ended in the record, so there is no place for the measured eye")
    return int(start[0])


def eye(record: Edges, ma: str = "MA1", sl: str = "SL1", axes: Optional[Axes] = None, *,
        measured: Optional[Tuple[int, int, float]] = None) -> Axes:
    """The eye of a line: SL in the two periods of MA around each rising edge of MA, all laid over
    each other. Where no line crosses, SL may be sampled. The period is the commonest distance of two
    rising edges; the record should hold some hundred of them.

    `measured` is what biss_axi says of the last frame of the record (extra FRAME_SAMPLER):
    EYE_WIDTH and EYE_POINT in clocks, and the length of a clock in ns. It is drawn beside the lines,
    with its sampling point."""
    times, levels = record.pins[ma]
    rising = times[1:][levels[1:] == 1]
    if len(rising) < 3:
        raise Error(f"eye: the record holds {len(rising)} rising edges of {ma}; three are the least")
    distances, counts = np.unique(np.diff(rising), return_counts=True)
    period = distances[counts.argmax()]
    axes = _axes(axes)
    times, levels = record.pins[sl]
    for edge in rising[1:-1]:
        first, last = np.searchsorted(times, (edge - period, edge + period))
        inside = np.pad(times[first:last] - edge, 1, constant_values=(-period, period))
        values = levels[max(first - 1, 0):last]
        values = np.concatenate((values, values[-1:]))
        axes.step(inside[-len(values):] / 1000, values, where="post", color=GOOD, alpha=0.15,
                  linewidth=1.2)
    axes.axvline(0, color=BAD, linewidth=1.0, label=f"{ma} rises")
    where = "center right"
    if measured is not None:
        where = "upper right"
        width, point, clock = measured
        start = _start_bit(rising, period, record.pins[sl], record.end_ps)
        behind = (start - rising[rising <= start][-1]) % period
        for turn in (-2, -1, 0):
            at = (behind + turn * period) / 1000 + point * clock
            first = not turn + 2
            axes.axvspan(at - (width - 1) // 2 * clock, at + width // 2 * clock, 0.45, 0.55,
                         color=LINE, alpha=0.4, label="measured eye" if first else None)
            axes.plot(at, 0.5, "x", color=BAD, label="sampling point" if first else None)
        axes.set_xlim(-period / 1000, period / 1000)
    axes.set_yticks((0, 1))
    axes.set_ylabel(sl)
    axes.set_xlabel(f"time from a rising edge of {ma} / ns")
    axes.legend(loc=where)
    return axes


def positions(rows: npt.NDArray[Any], slave: int = 1, expected: Optional[Sequence[int]] = None,
              axes: Optional[Axes] = None) -> Any:
    """Position over time of the rows of Driver.read_all() or automatic_next(). Frames without a good
    word of this slave are ticks at the lower edge. With `expected`, one value a row, a second diagram
    shows the error; then `axes` are two."""
    if not 1 <= slave <= 8:
        raise Error(f"positions: slave must be 1 to 8, not {slave}")
    if expected is not None and len(expected) != len(rows):
        raise Error(f"positions: {len(expected)} expected values for {len(rows)} rows")
    if expected is not None and axes is None:
        axes = plt.subplots(2, 1, figsize=(9.0, 5.0), sharex=True, layout="constrained")[1]
    both = (_axes(axes),) if expected is None else tuple(axes if axes is not None else ())
    time = (rows["time_ns"] - rows["time_ns"][:1]) / 1e6
    frame = rows["frame"]
    good = frame["code"][:, slave - 1] == 0
    position = frame["reading"]["position"][:, slave - 1]
    both[0].plot(time[good], position[good], ".", color=GOOD, markersize=3,
                 label=f"slave {slave}, {good.sum()} good")
    both[0].plot(time[~good], np.full((~good).sum(), 0.02), "|", color=BAD, markersize=12,
                 label=f"{(~good).sum()} bad", transform=both[0].get_xaxis_transform())
    both[0].set_ylabel("position")
    both[0].legend(loc="upper right")
    if expected is not None:
        error = position[good].astype(np.int64) - np.asarray(expected, dtype=np.int64)[good]
        both[1].plot(time[good], error, ".", color=GOOD, markersize=3)
        both[1].set_ylabel("error")
    both[-1].set_xlabel("time / ms")
    return axes if expected is not None else both[0]
