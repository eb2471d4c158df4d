#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""A study: how many frames a BiSS C line loses over its frequency, delay and jitter.

  frame_error_rate.py FOLDER [--frames N]     N frames a point, 72 points; default 2000

Writes FOLDER/frame_error_rate.jsonl, where a run that was ended goes on, and
FOLDER/frame_error_rate.png. The encoder has 28 bits and CRC 0x43; its line delay is that of the cable.
A frame is lost if the driver reports an error, and wrong if a word that passes the CRC is not the one
that the encoder sent."""

import argparse
from pathlib import Path
from typing import Any, Dict

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import openmb4  # noqa: E402

GRID = {"ma_hz": [10_000_000, 5_000_000, 2_500_000],
        "delay_ns": [100, 330, 1015],
        "jitter_percent": [0, 25, 40, 45, 50, 55, 60, 75]}  # of the period of MA, peak to peak


def count(point: Dict[str, Any]) -> Dict[str, int]:
    """Lost and wrong frames of one point."""
    scenario = {
        "chip": {"f_clk_hz": 20_000_000},
        "channel": [{"number": 1, "delay_ns": point["delay_ns"],
                     "jitter_ns": point["jitter_percent"] / 100 * 1e9 / point["ma_hz"],
                     "slave": [{"protocol": "biss-c", "data_bits": 28, "source": "ramp",
                                "start": 0, "step": 40503}]}]}
    lost = wrong = 0
    with openmb4.Simulator(scenario) as chip:
        config = chip.driver.config()
        config.ma_hz = point["ma_hz"]
        chip.driver.configure(config)
        left = point["frames"]
        while left:
            before = chip.frames(1)
            rows = chip.driver.read_all(min(left, 1000))
            good = rows["frame"]["code"][:, 0] == openmb4.Code.OK
            sent = np.array([chip.sent(1, before + 1 + i) for i in range(len(rows))], np.uint64)
            lost += int((~good).sum())
            wrong += int((rows["frame"]["reading"]["raw"][good, 0] != sent[good]).sum())
            left -= len(rows)
    return {"lost": lost, "wrong": wrong}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--frames", type=int, default=2000, help="frames a point, 1 or more")
    arguments = parser.parse_args()
    if arguments.frames < 1:
        parser.error("--frames: 1 or more")
    arguments.folder.mkdir(parents=True, exist_ok=True)
    grid = {**GRID, "frames": [arguments.frames]}
    results = openmb4.sweep(count, grid, file=arguments.folder / "frame_error_rate.jsonl")

    rates = np.array([result["lost"] for result in results]).reshape(
        [len(values) for values in GRID.values()]) / arguments.frames
    figure, panels = plt.subplots(1, len(GRID["ma_hz"]), figsize=(11, 3.5), sharey=True,
                                  layout="constrained")
    for panel, ma_hz, rows in zip(panels, GRID["ma_hz"], rates):
        for delay, row in zip(GRID["delay_ns"], rows):
            panel.plot(GRID["jitter_percent"], 100 * row, "o-", label=f"delay {delay} ns")
        panel.set_title(f"MA {ma_hz / 1e6:g} MHz")
        panel.set_xlabel("jitter / % of the period")
        panel.grid(alpha=0.3)
    panels[0].set_ylabel("lost frames / %")
    panels[0].legend()
    figure.savefig(arguments.folder / "frame_error_rate.png", dpi=120)
    print(f"{arguments.frames * len(results)} frames, lost {sum(r['lost'] for r in results)}, "
          f"wrong {sum(r['wrong'] for r in results)}")


if __name__ == "__main__":
    main()
