# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""What the Markdown pages tell their readers to type.

A page holds commands in three places: blocks of language `sh`, lines that begin with `$ ` in blocks
without a language, and `inline code` of a program with arguments. In front of a block, or directly
behind inline code, a comment can say more:

  <!-- not run: REASON -->      a test leaves it out; REASONS lists the reasons. `REASON; REASON`: one
                                for each command of the block
  <!-- exit status: N -->       how the commands end, when not with 0

A block `text` shows the output of the commands before it, one without a language what its own `$ `
lines print; `...` stands for any lines. A block `LANGUAGE FILE` is a file that the reader saves.
"""

import contextlib
import dataclasses
import os
import re
import shlex
import shutil
import signal
import subprocess
import tempfile
from pathlib import Path

TIMEOUT_S = 200
REASONS = ("is a synopsis", "needs hardware", "is the test command itself", "runs long",
           "installs packages")
CODE = ("c", "c++", "cmake", "cpp", "python", "rust", "systemverilog", "tcl",
        "toml", "vhdl")  # languages without commands
PROGRAMS = ("apt-get", "arm-none-eabi-g++", "cc", "cmake", "ctest", "echo", "fusesoc", "gtkwave",
            "icepack", "iceprog", "mb4sim", "nextpnr-ice40", "pip", "pkg-config", "python3",
            "qemu-system-arm", "sigrok-cli", "source", "spi-config", "spi-pipe", "sudo", "yosys")
SCRIPTS = re.compile(r"\./|build/bin/|(tools|tests|regmap)/.*\.(sh|py)$")


class Fault(Exception):
    """A page that does not keep to the rules above."""


@dataclasses.dataclass
class Block:
    line: int
    language: str  # "": none; "inline": no block
    file: str
    text: str
    reasons: list[str]
    status: int = 0

    def commands(self):
        """[(command, lines that the page shows as its output)] of a block with `$ ` lines."""
        found = []
        for line in self.text.splitlines():
            if line.startswith("$ "):
                found.append((line[2:], []))
            elif found:
                found[-1][1].append(line)
        return found

    def marked(self):
        """[(reason, command)] of what is left out."""
        if self.language:
            joined = re.sub(r"\\\n\s*", "", self.text)
            commands = [re.sub(r"\s{2,}#.*", "", line) for line in joined.splitlines()
                        if line and not line.startswith("#")]
        else:
            commands = [command for command, _ in self.commands()]
        if len(self.reasons) not in (1, len(commands)):
            raise Fault(f"{len(self.reasons)} reasons for {len(commands)} commands")
        return list(zip(self.reasons * (len(commands) // len(self.reasons)), commands))


def is_command(text):
    """Inline code: a program with arguments. `mb4sim run` alone is a name, and so is `tools/x.sh`."""
    try:
        words = shlex.split(text)
    except ValueError:
        words = text.split()
    while words and re.match(r"[A-Z0-9_]+=", words[0]):
        words.pop(0)
    if not words or not (words[0] in PROGRAMS or SCRIPTS.match(words[0])):
        return False
    return len(words) > (2 if words[0] == "mb4sim" and not words[-1].startswith("-") else 1)


def reasons_of(text):
    reasons = [reason.strip() for reason in text.split(";")]
    for reason in reasons:
        if reason not in REASONS:
            raise Fault(f"'{reason}' is none of the reasons: {', '.join(REASONS)}")
    return reasons


def inline(text, first_line):
    """The commands of running text."""
    pattern = re.compile(r"(?<!`)`((?:[^`\n]|\n(?!\n))+)`(?!`)(?:<!-- not run: (.*?) -->)?")
    for match in pattern.finditer(text):
        code = re.sub(r"\s+", " ", match[1].replace(r"\|", "|"))
        if is_command(code):
            line = first_line + text.count("\n", 0, match.start())
            yield Block(line, "inline", "", code, reasons_of(match[2]) if match[2] else [])


def blocks(text):
    """Blocks and inline commands of a page in their order."""
    pattern = re.compile(r"^(?:<!-- (not run|exit status): (.*?) -->\n+)?```(.*)\n((?:.*\n)*?)```$",
                         re.MULTILINE)
    found, end = [], 0
    for match in pattern.finditer(text):
        line = 1 + text.count("\n", 0, match.start(3))
        found += inline(text[end:match.start()], 1 + text.count("\n", 0, end))
        end = match.end()
        language, _, file = match[3].partition(" ")
        block = Block(line, language, file, match[4], [])
        if match[1] == "not run":
            block.reasons = reasons_of(match[2])
        elif match[1]:
            block.status = int(match[2])
        if language not in ("", "sh", "text", *CODE):
            raise Fault(f"line {line}: a block of language '{language}'")
        if not language:
            for shown in block.text.splitlines():
                if is_command(shown.split("#")[0]):
                    raise Fault(f"line {line}: '{shown}' is a command; the block is not of sh")
        found.append(block)
    found += inline(text[end:], 1 + text.count("\n", 0, end))
    if text.count("```") != 2 * sum(block.language != "inline" for block in found):
        raise Fault("a fence is indented or has no end")
    marks = len(re.findall("<!-- (?:not run|exit status): ", text))
    if marks != sum(bool(block.reasons) + (block.status != 0) for block in found):
        raise Fault("a mark stands at no command")
    return found


def foreign(folder, names):
    """Those that are no part of the repository: build trees, what git and Python keep."""
    return [name for name in names if name in (".git", "__pycache__", "build", "build-sanitize")
            or os.path.exists(os.path.join(folder, name, "CMakeCache.txt"))]


def pages(root):
    """{name: text} of all pages that tell readers what to type."""
    found = {}
    for folder, folders, files in os.walk(root):
        folders[:] = sorted(set(folders) - set(foreign(folder, folders)))
        for name in sorted(files):
            if name.endswith(".md") and name != "CHANGELOG.md":
                path = Path(folder, name)
                found[str(path.relative_to(root))] = path.read_text(encoding="utf-8")
    return found


@contextlib.contextmanager
def workspace(root, mb4sim):
    """A copy of the repository. Its build/ holds only bin/mb4sim and the libraries."""
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder, "openmb4")
        shutil.copytree(root, copy, symlinks=True, ignore=foreign)
        (copy / "build" / "bin").mkdir(parents=True)
        built = Path(mb4sim).resolve()
        (copy / "build" / "bin" / "mb4sim").symlink_to(built)
        (copy / "build" / "lib").symlink_to(built.parents[1] / "lib")
        yield copy


def shell(script, folder):
    """(status, output) of a script as bash runs it; background jobs count. None: it does not end."""
    environment = dict(os.environ, TERM="dumb", HOME=str(folder), MANPAGER="cat",
                       PATH=f"{folder}/build/bin{os.pathsep}{os.environ['PATH']}")
    # bash forgets a job that has ended, but not the status of a known process.
    note = "trap 'case \" $jobs_of_page \" in *\" $! \"*) ;; *) jobs_of_page=\"$jobs_of_page $!\" ;; esac' DEBUG\n"
    wait = "\ntrap - DEBUG\nfor job in $jobs_of_page; do wait $job; done\n"
    run = subprocess.Popen(["bash", "-e", "-o", "pipefail", "-c", note + script + wait], cwd=folder,
                           env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                           stderr=subprocess.STDOUT, text=True, errors="replace",
                           start_new_session=True)
    try:
        output = run.communicate(timeout=TIMEOUT_S)[0]
    except subprocess.TimeoutExpired:
        os.killpg(run.pid, signal.SIGKILL)
        return None, run.communicate()[0]
    if run.returncode != 0:  # a server may be left behind
        try:
            os.killpg(run.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
    return run.returncode, output
