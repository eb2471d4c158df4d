# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The examples in Python run, and what they show is what their scenarios say."""

import base64
import json
import os
import subprocess
import sys
from pathlib import Path

import nbclient
import nbformat
import openmb4

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "python"
PACKAGE = str(Path(openmb4.__file__).parents[1])


def test_notebook_runs(tmp_path, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", PACKAGE)
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path))
    notebook = nbformat.read(EXAMPLES / "frames.ipynb", as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells)  # it is kept without outputs
    nbclient.NotebookClient(notebook, timeout=100,
                            resources={"metadata": {"path": str(tmp_path)}}).execute()
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    texts = [output["data"]["text/plain"] for output in outputs
             if output["output_type"] == "execute_result"]
    pictures = [base64.b64decode(output["data"]["image/png"]) for output in outputs
                if "image/png" in output.get("data", {})]
    assert not [output for output in outputs if output["output_type"] == "stream"]
    assert len(pictures) == 2 and all(picture.startswith(b"\x89PNG") for picture in pictures)
    record, = [output["data"] for output in outputs if "image/svg+xml" in output.get("data", {})]
    assert record["text/plain"].startswith("<Edges of 6 us") and "SLO1" in record["image/svg+xml"]
    if folder := os.environ.get("MB4_KEEP_PICTURES"):  # to look at them
        for number, picture in enumerate(pictures):
            Path(folder, f"notebook{number}.png").write_bytes(picture)
    texts = [text for text in texts if not text.startswith("<Edges")]
    good, bad = eval(texts[1])  # "(147, 3)", with numpy 2 "(np.int64(147), np.int64(3))"
    assert good + bad == 150 and good > 100 and bad > 0
    freqs, freq, length = eval(texts[2])
    assert freqs == 0 and freq & 0x1F == 0 and length == 28 - 1  # 10 MHz; SCDLEN = bits - 1
    losses = eval(texts[3])
    assert losses[:3] == [0, 0, 0] and 0 < losses[3] <= 200  # 60 ns are more than half a period


def test_study_counts_and_goes_on(tmp_path):
    command = [sys.executable, str(EXAMPLES / "frame_error_rate.py"), str(tmp_path), "--frames", "20"]
    environment = {**os.environ, "PYTHONPATH": PACKAGE}
    first = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert first.stdout.startswith("1440 frames, lost ")
    rows = [json.loads(line) for line in
            (tmp_path / "frame_error_rate.jsonl").read_text().splitlines()[1:]]
    assert [row["index"] for row in rows] == list(range(72))
    # Item I305 allows jitter up to 25 %: the first two of eight points lose nothing.
    assert all(row["result"] == {"lost": 0, "wrong": 0} for row in rows if row["index"] % 8 < 2)
    assert any(row["result"]["lost"] for row in rows)
    assert (tmp_path / "frame_error_rate.png").stat().st_size > 10_000
    again = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert again.stdout == first.stdout

    wrong = subprocess.run([*command[:3], "--frames", "0"], env=environment, capture_output=True,
                           text=True, check=False)
    assert wrong.returncode == 2 and "--frames: 1 or more" in wrong.stderr
