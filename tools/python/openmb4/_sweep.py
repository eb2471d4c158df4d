# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""sweep(): one function on every point of a grid, on the processors of this machine or of others."""

import hashlib
import itertools
import json
import multiprocessing
import os
import queue
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any, Callable, Dict, Iterable, List, Mapping, Optional, Sequence, Union

from tqdm import tqdm

from ._library import Error, version

Point = Dict[str, Any]
Grid = Union[Mapping[str, Sequence[Any]], Iterable[Point]]


def points(grid: Grid) -> List[Point]:
    """The points of a grid in their order: of a dict of lists every combination, the last name
    running fastest; of a list of dicts the list itself."""
    if isinstance(grid, Mapping):
        return [dict(zip(grid, values)) for values in itertools.product(*grid.values())]
    return [dict(point) for point in grid]


def _line(entry: Any) -> str:
    """An entry of the file. numpy's numbers are written as Python's."""
    return json.dumps(entry, default=lambda value: value.item(), allow_nan=True) + "\n"


class _Store:
    """The file of a sweep: a line that tells the grid, then one for each point in the order in which
    they came; the finished file is sorted. JSON, so that any language reads it."""

    def __init__(self, path: Optional[Path], head: Dict[str, Any], count: int):
        self._path, self._head, self._output = path, _line(head), None
        self.results: Dict[int, Any] = {}
        if path is None:
            return
        if path.exists():
            # A line that a killed process has not finished has no end.
            lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
            lines = [line for line in lines if line.endswith("\n")]
            if lines and lines[0] != self._head:
                raise Error(f"{path}: holds another sweep; name another file or remove this one")
            for number, line in enumerate(lines[1:], 2):
                entry = self._read(line, f"{path}:{number}", count)
                self.results[entry["index"]] = entry["result"]
        self._write()
        self._output = path.open("a", encoding="utf-8")

    @staticmethod
    def _read(line: str, place: str, count: int) -> Dict[str, Any]:
        try:
            entry: Dict[str, Any] = json.loads(line)
            if type(entry["index"]) is int and 0 <= entry["index"] < count and "result" in entry:
                return entry
        except (ValueError, TypeError, KeyError):
            pass
        raise Error(f"{place}: no result of a sweep")

    def _write(self) -> None:
        """Writes all at once: the file is the old one or the new one, whenever the process ends."""
        assert self._path is not None
        new = self._path.with_name(self._path.name + ".new")
        with new.open("w", encoding="utf-8") as output:
            output.write(self._head)
            output.writelines(_line({"index": index, "result": self.results[index]})
                              for index in sorted(self.results))
        os.replace(new, self._path)

    def add(self, index: int, result: Any) -> None:
        line = _line({"index": index, "result": result})
        self.results[index] = json.loads(line)["result"]
        if self._output:
            self._output.write(line)
            self._output.flush()

    def finish(self) -> None:
        if self._output:
            self._output.close()
            self._write()


def sweep(function: Callable[[Point], Any], grid: Grid, client: Any = None, *,
          file: "Union[None, str, os.PathLike[str]]" = None, workers: Optional[int] = None,
          progress: Optional[bool] = None) -> List[Any]:
    """Calls `function(point)` for every point of `grid` and returns the results in grid order.

    grid      {name: values}: every combination; or a list of points, which are dicts
    client    what calls the function: a Dask `distributed.Client`, or an executor of
              concurrent.futures; None: `workers` processes of this machine
    file      keeps each result when it comes. A sweep that was ended goes on from there; the finished
              file is sorted by point and the same for any order of the results
    workers   1 or more; by default one for each processor
    progress  True or False: a bar on standard error; None: where standard error is a terminal

    A result is what JSON holds: numbers, texts, lists, dicts. The function must depend on its point
    only. Its exception comes out of sweep(); the results that came before are kept in `file`.
    """
    todo = points(grid)
    if workers is not None and workers < 1:
        raise Error(f"sweep: workers must be 1 or more, not {workers}")
    name = f"{getattr(function, '__module__', '')}.{getattr(function, '__qualname__', function)}"
    try:
        digest = hashlib.sha256(_line(todo).encode()).hexdigest()
    except (AttributeError, TypeError) as error:
        raise Error(f"sweep: a point holds what JSON does not: {error}") from error
    store = _Store(None if file is None else Path(file),
                   {"openmb4": version(), "function": name, "points": len(todo), "grid": digest},
                   len(todo))
    pool = client or ProcessPoolExecutor(workers, multiprocessing.get_context("fork"))
    done: "queue.SimpleQueue[Any]" = queue.SimpleQueue()
    futures: Dict[Any, int] = {}
    try:
        for index, point in enumerate(todo):
            if index not in store.results:
                futures[pool.submit(function, point)] = index
        for future in futures:
            future.add_done_callback(done.put)
        with tqdm(total=len(todo), initial=len(store.results), unit="point",
                  disable=None if progress is None else not progress) as bar:
            for _ in range(len(futures)):
                future = done.get()
                store.add(futures[future], future.result())
                bar.update()
        store.finish()
    finally:
        for future in futures:
            future.cancel()
        if client is None:
            pool.shutdown()
    return [store.results[index] for index in range(len(todo))]
