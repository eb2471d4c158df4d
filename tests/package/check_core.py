# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The FuseSoC core files.

  check_core.py lists   openmb4.core, openmb4-axi.core and openmb4-clb.core name the files of
                        rtl/mb4/mb4.f, rtl/axi/axi.f and rtl/clb/clb.f in their order
  check_core.py run     runs their targets, none of which may give a warning; skipped without fusesoc (PyPI)
"""
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "synth"))

import project  # noqa: E402

SKIPPED = 77


CORES = {"openmb4.core": "mb4/mb4.f", "openmb4-axi.core": "axi/axi.f",
         "openmb4-clb.core": "clb/clb.f"}
# docs/integration.md, "Features"
BYTES = {"sim": 0x00, "sim_drive": 0xC7, "sim_single": 0x85, "sim_reader": 0x80}


def lists():
    for name, rtl in CORES.items():
        core = (ROOT / name).read_text()
        assert core.startswith("CAPI=2:"), f"{name}: a core file begins with CAPI=2:"
        named = re.findall(r"(?m)^ +- (\S+\.sv)$", core)
        listed = [path.relative_to(ROOT).as_posix() for path in project.listed(project.RTL / rtl)]
        assert named == listed, f"{name}: {sorted(set(named) ^ set(listed)) or 'another order'}"
        for file in re.findall(r"(?m)^ +- ([\w./]+)", core):
            assert (ROOT / file).is_file(), file
        print(f"{name}: {len(named)} files")


def run():
    fusesoc = shutil.which("fusesoc")
    if fusesoc is None:
        print("skipped: fusesoc is not installed (PyPI: fusesoc)")
        sys.exit(SKIPPED)
    found = []
    for name in CORES:
        core = (ROOT / name).read_text()
        ip = re.search(r"(?m)^name: (\S+):[\d.]+$", core).group(1)
        targets = re.findall(r"(?m)^  (\w+):", core.split("\ntargets:\n")[1])
        found += [(ip, target) for target in targets if target != "default"]
    presets = set(project.presets()) - {"full"}
    missing = {f"{kind}_{preset}" for kind in ("lint", "sim", "synth") for preset in presets} - {
        target for _, target in found}
    assert not missing, f"no target: {missing}"
    with tempfile.TemporaryDirectory() as folder:
        for ip, target in found:
            done = subprocess.run(
                [fusesoc, "--cores-root", str(ROOT), "run", "--build-root", folder, "--target", target, ip],
                cwd=folder, capture_output=True, text=True, timeout=380, check=False)
            output = done.stdout + done.stderr
            expected = f"version 0x84, features 0x{BYTES[target]:02X}\n" if target in BYTES else ""
            warned = re.findall(r"(?i)^.*(?:deprecated|^warning:).*$", output, re.M)
            assert done.returncode == 0 and expected in output and not warned, (
                f"{target}: {warned}\n{output[-3000:]}")
            print(f"{ip}, {target}: good", flush=True)


{"lists": lists, "run": run}[sys.argv[1]]()
