#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Wrong arguments of the scripts in tools/synth: one line, exit status 2, nothing made."""

import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
SYNTH = HERE.parents[1] / "tools" / "synth"
sys.path.insert(0, str(SYNTH))

import project  # noqa: E402

SCRIPTS = ("report.py", "plain_verilog.py", "gate_netlist.py", "constraints.py", "ipxact.py",
           "vivado_ip.py")


def main():
    findings = []
    with tempfile.TemporaryDirectory() as folder:
        for script in SCRIPTS:
            for arguments in ([], ["-x"], ["--chek", "a"], ["a", "b"], [str(SYNTH / script)]):
                status, text = project.run([sys.executable, "-B", SYNTH / script, *arguments],
                                           cwd=folder, timeout=20)
                if status != 2 or text.count("\n") != 1 or not text.startswith(script):
                    findings.append(f"{script} {arguments}: exit status {status}: {text}")
            status, text = project.run([sys.executable, "-B", SYNTH / script, "--help"],
                                       cwd=folder, timeout=20)
            if status != 0 or not text.startswith("usage:") or "FOLDER" not in text:
                findings.append(f"{script} --help: exit status {status}: {text}")
        findings += [f"made: {path.name}" for path in Path(folder).iterdir()]
    project.finish(findings, f"{len(SCRIPTS)} scripts")


try:
    main()
except subprocess.TimeoutExpired as error:
    project.finish([f"works instead of refusing: {error.cmd}"], "")
