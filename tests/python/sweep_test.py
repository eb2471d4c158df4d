# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""sweep(): expected values are worked out from the points."""

import json
import os
import signal
import subprocess
import sys
import time
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import distributed
import numpy as np
import openmb4
import pytest

GRID = {"a": [1, 2, 3], "b": [10, 20]}
EXPECTED = [{"sum": a + b} for a in GRID["a"] for b in GRID["b"]]


def add(point):
    time.sleep(point.get("s", 0))
    return {"sum": point["a"] + point["b"]}


def fail_at_3(point):
    if point["a"] == 3:
        raise ValueError("three")
    return point["a"]


def read_positions(point):
    """Positions of a ramp: start and step are the point's."""
    with openmb4.Simulator({"channel": [{"number": 1, "slave": [
            {"protocol": "biss-c", "data_bits": 28, "source": "ramp", **point}]}]}) as chip:
        chip.driver.configure()
        rows = chip.driver.read_all(20)
        return np.diff(rows["frame"]["reading"]["position"][:, 0]).tolist()


class LastFirst:
    """An executor that finishes what came last first."""

    def __init__(self):
        self._waiting = []

    def submit(self, function, point):
        future = Future()
        self._waiting.append((future, function, point))
        if len(self._waiting) == len(EXPECTED):
            for future_, function_, point_ in reversed(self._waiting):
                future_.set_result(function_(point_))
        return future


def test_results_are_in_grid_order():
    assert openmb4.sweep(add, GRID) == EXPECTED
    assert openmb4.sweep(add, [{"a": 5, "b": 6}, {"a": 1, "b": 1}], workers=1) == [
        {"sum": 11}, {"sum": 2}]
    assert openmb4.sweep(add, []) == []


def test_simulators_run_in_the_processes():
    steps = [1, 7, 1000]
    assert openmb4.sweep(read_positions, {"start": [0], "step": steps}, workers=2) == [
        [step] * 19 for step in steps]


def test_file_is_the_same_in_any_order(tmp_path):
    openmb4.sweep(add, GRID, LastFirst(), file=tmp_path / "last.jsonl")
    openmb4.sweep(add, GRID, workers=1, file=str(tmp_path / "one.jsonl"))
    with ThreadPoolExecutor(2) as pool:
        openmb4.sweep(add, GRID, pool, file=tmp_path / "threads.jsonl")
    texts = {file.read_bytes() for file in tmp_path.iterdir()}
    assert len(texts) == 1
    lines = texts.pop().decode().splitlines()
    assert json.loads(lines[0])["points"] == len(EXPECTED)
    assert [json.loads(line) for line in lines[1:]] == [
        {"index": index, "result": result} for index, result in enumerate(EXPECTED)]


def test_dask_client_gives_the_same_file(tmp_path):
    openmb4.sweep(add, GRID, file=tmp_path / "local.jsonl")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True,
                                  dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            assert openmb4.sweep(add, GRID, client, file=tmp_path / "dask.jsonl") == EXPECTED
            assert openmb4.sweep(add, [{"a": 1, "b": 2}] * 3, client) == [{"sum": 3}] * 3
    assert (tmp_path / "dask.jsonl").read_bytes() == (tmp_path / "local.jsonl").read_bytes()


def test_killed_in_the_middle_and_resumed_gives_the_same_file(tmp_path):
    grid = {"a": list(range(40)), "b": [0], "s": [0.05]}
    openmb4.sweep(add, grid, ThreadPoolExecutor(40), file=tmp_path / "whole.jsonl")
    script = ("import sys; sys.path[:0] = sys.argv[1:3]\n"
              "import openmb4, sweep_test\n"
              f"openmb4.sweep(sweep_test.add, {grid!r}, workers=2, file=sys.argv[3])\n")
    part = tmp_path / "part.jsonl"
    process = subprocess.Popen(
        [sys.executable, "-c", script, str(Path(openmb4.__file__).parents[1]),
         str(Path(__file__).parent), str(part)], start_new_session=True)
    while not part.exists() or len(part.read_text().splitlines()) < 8:
        assert process.poll() is None
        time.sleep(0.01)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    kept = len(part.read_text().splitlines()) - 1
    assert 7 <= kept < 40
    with part.open("a") as output:
        output.write('{"index": 39, "res')  # what a kill within a write leaves

    called = []
    with ThreadPoolExecutor(1) as pool:
        submit = pool.submit
        pool.submit = lambda function, point: called.append(point) or submit(function, point)
        results = openmb4.sweep(add, grid, pool, file=part)
    assert len(called) == 40 - kept
    assert results == [{"sum": a} for a in range(40)]
    assert part.read_bytes() == (tmp_path / "whole.jsonl").read_bytes()
    assert openmb4.sweep(add, grid, LastFirst(), file=part) == results  # nothing is left to do


def test_exception_comes_out_and_results_are_kept(tmp_path):
    file = tmp_path / "x.jsonl"
    with pytest.raises(ValueError, match="three"):
        openmb4.sweep(fail_at_3, {"a": [1, 2, 3]}, workers=1, file=file)
    assert [json.loads(line)["result"] for line in file.read_text().splitlines()[1:]] == [1, 2]


def test_numbers_of_numpy_are_results():
    with ThreadPoolExecutor(1) as pool:
        assert openmb4.sweep(lambda point: np.int64(point["a"]), {"a": [7]}, pool) == [7]


@pytest.mark.parametrize("text, message", [
    ('{"openmb4": "other"}\n', "x.jsonl: holds another sweep"),
    ("HEAD{}\n", "x.jsonl:2: no result"),
    ('HEAD{"index": 6, "result": 1}\n', "x.jsonl:2: no result"),
    ('HEAD{"index": 0, "result": 1}\nnonsense\n', "x.jsonl:3: no result"),
])
def test_wrong_file_is_named_and_kept(tmp_path, text, message):
    file = tmp_path / "x.jsonl"
    openmb4.sweep(add, GRID, file=file)
    file.write_text(text.replace("HEAD", file.read_text().splitlines(keepends=True)[0]))
    before = file.read_bytes()
    with pytest.raises(openmb4.Error, match=message):
        openmb4.sweep(add, GRID, file=file)
    assert file.read_bytes() == before


def test_wrong_arguments():
    with pytest.raises(openmb4.Error, match="workers must be 1 or more, not 0"):
        openmb4.sweep(add, GRID, workers=0)
    with pytest.raises(openmb4.Error, match="a point holds what JSON does not"):
        openmb4.sweep(add, [{"a": object()}])


def test_bar_only_where_it_is_wanted(capfd):
    openmb4.sweep(add, GRID)
    assert capfd.readouterr().err == ""
    openmb4.sweep(add, GRID, progress=True)
    assert "6/6" in capfd.readouterr().err
