#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The decoders as the sigrok project takes them: sigrok_pack.py FOLDER [--mb4sim FILE]

FOLDER gets three folders, each with the layout of a repository of that project:

  libsigrokdecode/decoders/ID/       the decoder: __init__.py, pd.py and what they import
  sigrok-dumps/ID/openmb4/           captures of the simulator as .sr, with a README of their making
  sigrok-test/decoder/test/ID/       test.conf: what the project's own `pdtest` runs on these captures

Needs mb4sim (default build/bin/mb4sim) and sigrok-cli. A decoder that breaks a rule of the project is one
line of error; FOLDER is then not made.
"""

import argparse
import ast
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
DECODERS = ROOT / "tools" / "sigrok"
SAMPLE_PS = 5000  # 200 MHz
LINE = "-" * 79

# Capture: (scenario, arguments of `mb4sim plot`, channels, options of the decoder, what it shows).
DUMPS = {
    "biss_c": {
        "frame": ("examples/resolute-26.toml", ["--frame", "3"], {"ma": "MA1", "sl": "SL1"}, {},
                  "Three frames of an encoder of 26 bits at 10 MHz, 10 m of cable."),
        "register_read": ("docs/pictures/registers.toml", ["--read", "0x67"], {"ma": "MA1", "sl": "SL1"},
                          {"data_bits": "14"}, "A register read: address 0x67 of ID 0 holds 0x5F."),
        "command": ("docs/pictures/registers.toml", ["--command", "0:0"], {"ma": "MA1", "sl": "SL1"},
                    {"data_bits": "14"}, "Command 0 to ID 0."),
        "wrong_crc": ("docs/pictures/bad-crc.toml", [], {"ma": "MA1", "sl": "SL1"}, {"data_bits": "20"},
                      "A frame with one inverted bit: its CRC is wrong."),
    },
    "dsl": {
        "motor": ("examples/dsl/motor.toml", ["--frame", "9"], {"line": "IN1", "en": "EN1"}, {},
                  "Nine frames of the feedback of a motor, 20 m of cable; the driver enable is there too."),
    },
}


class Fault(Exception):
    """A rule that is broken or a tool that fails, in one line."""


def run(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, cwd=ROOT, check=False)
    if done.returncode > 1 or (done.returncode == 1 and "plot" not in command):
        raise Fault(f"{command[0]}: {done.stderr.strip().splitlines()[-1:]}")
    return done.stdout


def check(folder):
    """The rules for a decoder of the project."""
    name = folder.name
    files = {path.name for path in folder.iterdir() if path.name != "__pycache__"}
    if not {"__init__.py", "pd.py"} <= files or any(not file.endswith(".py") for file in files):
        raise Fault(f"{name}: expected __init__.py, pd.py and other .py files only, found {sorted(files)}")
    for file in sorted(files):
        tree = ast.parse((folder / file).read_text(encoding="utf-8"), file)
        for node in ast.walk(tree):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom) and node.level == 0:
                names = [node.module]
            for module in names:
                if module != "sigrokdecode" and module.split(".")[0] not in sys.stdlib_module_names:
                    raise Fault(f"{name}/{file}:{node.lineno}: expected no package but Python's own, found {module}")
    start = ast.parse((folder / "__init__.py").read_text(encoding="utf-8"))
    if not ast.get_docstring(start):
        raise Fault(f"{name}/__init__.py: expected a text about the decoder")
    values = {}
    for node in ast.walk(ast.parse((folder / "pd.py").read_text(encoding="utf-8"))):
        if isinstance(node, ast.ClassDef) and node.name == "Decoder":
            values = {one.targets[0].id: one.value for one in node.body if isinstance(one, ast.Assign)}
    for key in ("api_version", "id", "name", "longname", "desc", "license", "inputs", "outputs", "tags",
                "annotations", "annotation_rows"):
        if key not in values:
            raise Fault(f"{name}/pd.py: expected '{key}' in class Decoder")
    if ast.literal_eval(values["api_version"]) != 3 or ast.literal_eval(values["id"]) != name:
        raise Fault(f"{name}/pd.py: expected api_version = 3 and id = '{name}', as the folder")
    if not ast.literal_eval(values["desc"]).endswith("."):
        raise Fault(f"{name}/pd.py: expected a full stop at the end of 'desc'")


def readme(name, dumps):
    text = f"{LINE}\n{name}: captures of the openmb4 simulator\n{LINE}\n\n"
    text += ("The simulator openmb4 (mb4sim) made these captures with the Verilated master and a model of the\n"
             "encoder. No hardware was measured. They are in the public domain (CC0).\n\n\n")
    text += "Logic analyzer setup\n--------------------\n\n"
    text += f"None: signals at the pins of the master, sampled every {SAMPLE_PS // 1000} ns (200 MHz).\n\n\n"
    text += "Data\n----\n\n"
    for dump, (scenario, arguments, channels, options, what) in dumps.items():
        text += f"{dump}.sr\n  {what}\n  Channels: " + ", ".join(
            f"{pin} is {channel}" for channel, pin in channels.items()) + ".\n"
        if options:
            text += "  Options: " + ", ".join(f"{key}={value}" for key, value in options.items()) + ".\n"
        text += "  " + " ".join(["Made by: mb4sim plot", scenario, *arguments, "--vcd", f"{dump}.vcd"]) + "\n"
        text += f"           sigrok-cli -I vcd:downsample={SAMPLE_PS} -i {dump}.vcd -o {dump}.sr\n\n"
    return text


def bit_of(path, channel):
    """The number of a channel in the samples of a session; test.conf counts them so."""
    with zipfile.ZipFile(path) as session:
        found = re.search(rf"(?m)^probe(\d+)={channel}$", session.read("metadata").decode())
    return int(found[1]) - 1


def test_conf(name, dumps, place):
    text = ""
    for dump, (_, _, channels, options, _) in dumps.items():
        pins = "".join(f" channel {channel}={bit_of(place / f'{dump}.sr', pin)}" for channel, pin in channels.items())
        chosen = "".join(f" option {key}={value}" for key, value in options.items())
        text += (f"test {dump}\n\tprotocol-decoder {name}{pins}{chosen}\n\tinput {name}/openmb4/{dump}.sr\n"
                 f"\toutput {name} annotation match {dump}.output\n\n")
    return text


def make(folder, mb4sim):
    for name, dumps in DUMPS.items():
        check(DECODERS / name)
        shutil.copytree(DECODERS / name, folder / "libsigrokdecode/decoders" / name,
                        ignore=shutil.ignore_patterns("__pycache__"))
        place = folder / "sigrok-dumps" / name / "openmb4"
        place.mkdir(parents=True)
        (place / "README").write_text(readme(name, dumps), encoding="utf-8")
        for dump, (scenario, arguments, channels, _, _) in dumps.items():
            with tempfile.TemporaryDirectory() as work:
                vcd = Path(work, "line.vcd")
                run(mb4sim, "plot", scenario, *arguments, "--vcd", vcd)
                run("sigrok-cli", "-I", f"vcd:downsample={SAMPLE_PS}", "-i", vcd, "-C", ",".join(channels.values()),
                    "-o", place / f"{dump}.sr")
        test = folder / "sigrok-test/decoder/test" / name
        test.mkdir(parents=True)
        (test / "test.conf").write_text(test_conf(name, dumps, place), encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--mb4sim", type=Path, default=ROOT / "build/bin/mb4sim")
    options = parser.parse_args()
    try:
        if options.folder.exists():
            raise Fault(f"{options.folder} is there already")
        for tool in (options.mb4sim, "sigrok-cli"):
            if shutil.which(tool) is None:
                raise Fault(f"{tool} is not there")
        with tempfile.TemporaryDirectory() as work:
            make(Path(work, "pack"), options.mb4sim.absolute())
            shutil.move(Path(work, "pack"), options.folder)
    except Fault as fault:
        print(f"sigrok_pack: {fault}", file=sys.stderr)
        return 1
    print(options.folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
