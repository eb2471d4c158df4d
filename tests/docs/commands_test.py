#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Runs every command of README and docs, page by page, each page in a fresh copy of the repository.

  commands_test.py MB4SIM ROOT [--write]

What is not run carries a mark with its reason in the page (pages.py). not_run.txt lists the marks; with
another list the test fails. --write writes the list and runs nothing.
"""

import re
import shutil
import sys
import time
from pathlib import Path

import pages

SKIPPED = 77  # exit status of this repository's scripts when a tool is missing
TOOLS = ("arm-none-eabi-g++", "fusesoc", "man", "qemu-system-arm", "sigrok-cli", "spi-config",
         "spi-pipe", "xxd")
LIST = "tests/docs/not_run.txt"
HEAD = """\
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Commands of README and docs that commands_test.py does not run, with the reason that the page gives.
# Made by `tests/docs/commands_test.py MB4SIM ROOT --write`.

"""


def missing_line(shown, output):
    """The first line that a page shows and that was not printed in this order, or None."""
    printed = iter(line.rstrip() for line in output.splitlines())
    for line in shown:
        if line.strip() not in ("", "...") and line.rstrip() not in printed:
            return line
    return None


class Page:
    def __init__(self, name, text):
        self.name = name
        self.blocks = pages.blocks(text)
        self.ran = 0
        self.skipped = []
        self.findings = []

    def marked(self):
        return [f"{self.name}: {reason}: {command}"
                for block in self.blocks if block.reasons for reason, command in block.marked()]

    def check(self, block, script, folder):
        """Runs a script; its output, or None if a tool is missing or it has failed."""
        absent = [tool for tool in TOOLS
                  if re.search(rf"(?<![\w-]){re.escape(tool)}(?![\w-])", script)
                  and not shutil.which(tool)]
        if absent:
            self.skipped.append(f"{self.name}:{block.line}: {', '.join(absent)} not installed")
            return None
        began = time.monotonic()
        status, output = pages.shell(script, folder)
        if status == SKIPPED:
            self.skipped.append(f"{self.name}:{block.line}: {output.strip().splitlines()[-1]}")
            return None
        self.ran += 1
        took = time.monotonic() - began
        if took > 1:
            print(f"  {self.name}:{block.line} took {took:.1f} s")
        if status != block.status:
            self.findings.append(f"{self.name}:{block.line}: status {status} instead of "
                                 f"{block.status}:\n{script}\n{output}")
            return None
        return output

    def compare(self, block, shown, output):
        line = missing_line(shown, output)
        if line is not None:
            self.findings.append(f"{self.name}:{block.line}: the page shows this line, the command "
                                 f"does not print it:\n{line}\n{output}")

    def run(self, root, mb4sim):
        if not any(block.language in ("sh", "inline") or block.commands() for block in self.blocks
                   if not block.reasons):
            return
        with pages.workspace(root, mb4sim) as folder:
            output = None
            for block in self.blocks:
                if block.file:
                    (folder / block.file).write_text(block.text, encoding="utf-8")
                elif block.reasons:
                    output = None
                elif block.language == "text":
                    if output is not None:
                        self.compare(block, block.text.splitlines(), output)
                elif block.language in ("sh", "inline"):
                    output = self.check(block, block.text, folder)
                elif block.language == "":
                    for command, shown in block.commands():
                        output = self.check(block, command, folder)
                        if output is not None:
                            self.compare(block, shown, output)


PLANTED = {  # page: what is found, or the fault of the page
    "```sh\nfalse\n```\n": "status 1 instead of 0",
    "```sh\nno-such-program x\n```\n": "status 127",
    "```sh\nfalse | cat\n```\n": "status 1",
    "```sh\nfalse &\n```\n": "status 1",
    "Then `tools/no-such.sh --now` does it.\n": "status 127",
    "```\n$ echo a\nb\n```\n": "does not print it:\nb",
    "```sh\necho a; echo b\n```\n```text\nb\na\n```\n": "does not print it:\na",
    "<!-- exit status: 1 -->\n```sh\ntrue\n```\n": "status 0 instead of 1",
    "```bash\ntrue\n```\n": "language 'bash'",
    "```\nmb4sim run x.toml\n```\n": "is a command",
    "  ```sh\n  true\n  ```\n": "indented",
    "<!-- not run: too dull -->\n```sh\ntrue\n```\n": "none of the reasons",
    "<!-- not run: runs long; runs long -->\n```sh\ntrue\n```\n": "2 reasons for 1",
    "<!-- not run: runs long -->\nText.\n": "stands at no command",
    "```sh\n[ -e README.md ] && [ -x build/bin/mb4sim ]\ntouch new\n```\n```sh\n[ -e new ]\n```\n"
    "```sh f.sh\nexit 3\n```\n<!-- exit status: 3 -->\n```sh\nbash f.sh\n```\n"
    "`mb4sim run` is a name, `mb4sim\n--version` runs, `mb4sim SCENARIO x`<!-- not run: is a synopsis "
    "--> not.\n<!-- not run: runs long; needs hardware -->\n```sh\na \\\n  b  # c\nd\n```\n": None,
}


def self_test(root, mb4sim):
    for text, expected in PLANTED.items():
        try:
            page = Page("planted", text)
            marked = page.marked()
            page.run(root, mb4sim)
            found = "\n".join(page.findings)
        except pages.Fault as fault:
            found = str(fault)
        if (expected is None and found) or (expected or "") not in found:
            raise SystemExit(f"planted page:\n{text}\nexpected: {expected}\nfound: {found}")
    # The last page has no fault.
    if (page.ran, marked) != (4, ["planted: is a synopsis: mb4sim SCENARIO x",
                                  "planted: runs long: a b", "planted: needs hardware: d"]):
        raise SystemExit(f"planted page: {page.ran} commands, marks {marked}")


def main():
    mb4sim, root = sys.argv[1], Path(sys.argv[2])
    every = []
    for name, text in pages.pages(root).items():
        try:
            every.append(Page(name, text))
            every[-1].marked()
        except pages.Fault as fault:
            print(f"{name}: {fault}")
            return 1
    marks = HEAD + "".join(line + "\n" for page in every for line in page.marked())
    if sys.argv[3:] == ["--write"]:
        (root / LIST).write_text(marks, encoding="utf-8")
        return 0
    findings = []
    if (root / LIST).read_text(encoding="utf-8") != marks:
        findings.append(f"{LIST} is not the list of the marks; commands_test.py MB4SIM ROOT --write "
                        "makes it anew")
    self_test(root, mb4sim)
    for page in every:
        page.run(root, mb4sim)
        findings += page.findings
    print(marks.removeprefix(HEAD))
    for page in every:
        if page.ran or page.skipped or page.marked():
            print(f"{page.name}: {page.ran} run, {len(page.skipped)} skipped, "
                  f"{len(page.marked())} not to be run")
            for line in page.skipped:
                print(f"  skipped: {line}")
    print(f"{sum(page.ran for page in every)} run, {sum(len(page.skipped) for page in every)} "
          f"skipped, {marks.removeprefix(HEAD).count(chr(10))} not to be run")
    for line in findings:
        print(f"\n{line}")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
