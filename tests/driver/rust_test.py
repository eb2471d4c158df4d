#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The Rust crate drivers/rust/openmb4.

  rust_test.py style CRATE TARGET ...          formatted, no message of clippy, as short as promised
  rust_test.py no_std CRATE TARGET ...         compiles for a Cortex-M0+, which has no std
  rust_test.py chip CRATE TARGET LIBRARY ...   its tests on the simulated chip, LIBRARY is libmb4sim.so

TARGET is the folder of what cargo makes. Further folders are those of the headers, which
`tools/test.sh --changed` finds in the command. Nothing is fetched where cargo has the crates already.
Exit status 77: no cargo; crates.io cannot be reached; no library for the Cortex-M0+ or no C compiler.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

LINES = {"src/*.rs": 300, "examples/*.rs": 40}
CORE = "thumbv6m-none-eabi"
FETCH_S = 120


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)


class Crate:
    def __init__(self, folder, target):
        if not shutil.which("cargo") or subprocess.run(["cargo", "--version"], capture_output=True, check=False).returncode != 0:
            skip("no cargo")
        self.folder = Path(folder)
        self.environment = os.environ | {"CARGO_TARGET_DIR": target, "CARGO_TERM_COLOR": "never", "CARGO_NET_RETRY": "1",
                                         "CARGO_HTTP_TIMEOUT": "20"}
        if self.call("fetch", "--locked", "--offline")[0] != 0:
            status, text = self.call("fetch", "--locked")
            if status != 0 and "--locked" in text:
                print(text)
                sys.exit("Cargo.lock does not fit Cargo.toml")
            if status != 0:
                print(text)
                skip("crates.io cannot be reached, and cargo does not have the crates of Cargo.lock")

    def call(self, *arguments, **more):
        """Exit status and all text."""
        limit = FETCH_S if arguments[0] == "fetch" else None
        try:
            done = subprocess.run(["cargo", *arguments], cwd=self.folder, env=self.environment | more, text=True, check=False,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=limit)
        except subprocess.TimeoutExpired:
            return 1, f"cargo {arguments[0]}: no end after {limit} s"
        return done.returncode, done.stdout

    def need(self, *arguments, **more):
        status, text = self.call(*arguments, **more)
        print(text)
        if status != 0:
            sys.exit(f"cargo {' '.join(arguments)}: exit status {status}")

    def has(self, command):
        if self.call(command, "--version")[0] == 0:
            return True
        print(f"left out: no cargo {command}")
        return False


def style(crate):
    for pattern, limit in LINES.items():
        for path in sorted(crate.folder.glob(pattern)):
            lines = path.read_text(encoding="utf-8").splitlines()
            if pattern.startswith("examples"):  # of code
                lines = [line for line in lines if line.strip() and not line.strip().startswith("//")]
            print(f"{path.name}: {len(lines)} lines")
            if len(lines) > limit:
                sys.exit(f"{path}: more than {limit} lines")
    if crate.has("fmt"):
        crate.need("fmt", "--check")
    if crate.has("clippy"):
        crate.need("clippy", "--locked", "--offline", "--all-targets", "--all-features", "--", "-D", "warnings")


def no_std(crate):
    sysroot = subprocess.run(["rustc", "--print", "sysroot"], capture_output=True, text=True, check=True).stdout.strip()
    if not (Path(sysroot) / "lib/rustlib" / CORE).is_dir():
        skip(f"no {CORE} (rustup target add {CORE})")
    if not shutil.which("arm-none-eabi-gcc"):
        skip("no arm-none-eabi-gcc")
    crate.need("build", "--locked", "--offline", "--release", "--target", CORE, "--lib", "--examples")


def main():
    mode, folder, target, *more = sys.argv[1:]
    crate = Crate(folder, target)
    if mode == "chip":
        crate.need("test", "--locked", "--offline", "--features", "simulator", MB4SIM_LIB=str(Path(more[0]).resolve().parent))
    else:
        {"style": style, "no_std": no_std}[mode](crate)


main()
