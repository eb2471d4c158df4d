# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""What Simulator.record() has seen, and its picture for notebooks."""

from html import escape
from typing import Any, Dict, List, NamedTuple, Tuple

import numpy as np
import numpy.typing as npt

_LEFT, _RIGHT, _ROW, _HIGH, _WIDTH = 80, 20, 34, 18, 900


def _ticks(span_us: float) -> List[float]:
    """About eight round places on an axis from 0."""
    step = 10.0 ** np.floor(np.log10(max(span_us, 1e-6) / 4))
    while span_us / step > 10:
        step *= 2 if span_us / step <= 20 else 2.5 if span_us / step <= 25 else 5
    return [float(each) for each in np.arange(0, span_us + step / 100, step)]


class Edges(NamedTuple):
    """What record() saw: of each pin the times in ps since power-on at which a level began, the first
    at start_ps, and these levels. A notebook shows it as a timing diagram."""

    start_ps: int
    end_ps: int
    pins: Dict[str, Tuple[npt.NDArray[np.int64], npt.NDArray[np.int8]]]

    def __repr__(self) -> str:
        pins = ", ".join(f"{name} {len(times) - 1}" for name, (times, _) in self.pins.items())
        return (f"<Edges of {(self.end_ps - self.start_ps) / 1e6:g} us from "
                f"{self.start_ps / 1e6:g} us on: {pins}>")

    def _path(self, times: npt.NDArray[Any], levels: npt.NDArray[Any], low: float) -> str:
        """The line of a pin. Edges closer than a tenth of a unit of the picture are drawn once."""
        scale = (_WIDTH - _LEFT - _RIGHT) / max(self.end_ps - self.start_ps, 1)
        path, last = "", ""
        for time, level in zip(times, levels):
            step = f"H{_LEFT + (int(time) - self.start_ps) * scale:.1f}V{low - _HIGH * int(level):g}"
            path += step if path else f"M{step[1:].replace('V', ' ')}"
            if step == last:
                path = path[:-len(step)]
            last = step
        return f"{path}H{_WIDTH - _RIGHT}"

    def _repr_svg_(self) -> str:
        """The timing diagram as SVG; it needs no other package."""
        bottom = 14 + _ROW * len(self.pins)
        scale = (_WIDTH - _LEFT - _RIGHT) / max(self.end_ps - self.start_ps, 1) * 1e6
        parts = []
        for at in _ticks((self.end_ps - self.start_ps) / 1e6):
            x = _LEFT + at * scale
            parts.append(f'<path d="M{x:.1f} 8V{bottom}" stroke="#cccccc"/>'
                         f'<text x="{x:.1f}" y="{bottom + 14}" text-anchor="middle">{at:g}</text>')
        for row, (name, (times, levels)) in enumerate(self.pins.items()):
            low = 8 + _ROW * row + (_ROW + _HIGH) / 2
            parts.append(f'<text x="{_LEFT - 8}" y="{low - 4:g}" text-anchor="end">{escape(name)}'
                         f'</text><path d="{self._path(times, levels, low)}" fill="none" '
                         'stroke="#333333"/>')
        parts.append(f'<text x="{_WIDTH - _RIGHT}" y="{bottom + 30}" text-anchor="end">'
                     f'us from {self.start_ps / 1e6:g} us on</text>')
        return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH} {bottom + 36}" '
                f'width="{_WIDTH}" font-family="sans-serif" font-size="12">'
                f'<rect width="100%" height="100%" fill="white"/>{"".join(parts)}</svg>')
