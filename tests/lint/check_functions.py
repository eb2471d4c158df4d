#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""No function of drivers/ is longer than 40 lines, from its first line to its closing brace: one function does one stage.
A longer one has a row here, with the reason. Functions are found by their braces, in C, C++, Arduino sketches and Rust.

  check_functions.py [--all N]     the files of drivers/; --all prints each function of more than N lines and its length
  check_functions.py --self-test   planted functions are found, and what only looks like one is not
"""

import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tools" / "synth"))

import project  # noqa: E402

MOST = 40
SOURCE = re.compile(r"^drivers/.*\.(c|h|cpp|hpp|ino|rs)$")
# (file, function): why it may be longer. A row that is not needed is a finding.
TEXTS = "a table of texts, one line for each value"
WAIVED: dict[tuple[str, str], str] = {
    ("drivers/include/biss_pru.h", "biss_pru_text"): TEXTS,
    ("drivers/include/mb4/error.hpp", "to_string"): TEXTS,
}

# What a function is not: blanked, with its line ends kept. A character of Rust is no lifetime ('a).
COMMENT_OR_TEXT = re.compile(r"""//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\])*"|'(?:\\.[^']*|[^'\\])'""", re.DOTALL)
DIRECTIVE = re.compile(r"(?m)^[ \t]*#[ \t]*(?:\\\n|[^\n])*")
ATTRIBUTE = re.compile(r"\[\[[^]]*\]\]|#\[[^]]*\]|\balignas\([^()]*\)|__attribute__\(\([^()]*(?:\([^()]*\))*[^()]*\)\)")
SCOPE = re.compile(r"\b(?:namespace|class|struct|union|enum|extern|mod|trait|impl)\b")
NAME = re.compile(r"([A-Za-z_~]\w*(?:\s*(?:[=!<>+*\[\]-]+|\(\))(?=\())?)\s*\($")


def blanked(text, pattern):
    return pattern.sub(lambda found: re.sub(r"[^\n]", " ", found.group(0)), text)


def without(text, pattern):
    """The text without what the pattern finds, from the innermost to the outermost."""
    while (shorter := re.sub(pattern, "", text)) != text:
        text = shorter
    return text


def is_scope(head):
    """True for the braces of a namespace, a type or a linkage."""
    head = ATTRIBUTE.sub(" ", head).strip()
    return bool(SCOPE.search(head)) and ("(" not in head or head.startswith(("impl", "unsafe impl")))


def name_of(head):
    """The name in the head of a function; None: the braces hold values."""
    head = ATTRIBUTE.sub(" ", head)
    plain = without(head, r"<[^<>()]*>") if "operator" not in head else head
    if "operator" not in plain and "=" in without(plain, r"\([^()]*\)"):
        return None
    found = NAME.search(plain[:plain.find("(") + 1])
    return found.group(1) if found else None


def end_of_braces(text, opening):
    """Where the brace that is opened there is closed."""
    depth = 0
    for sign in re.finditer(r"[{}]", text[opening:]):
        depth += 1 if sign.group() == "{" else -1
        if depth == 0:
            return opening + sign.start()
    raise ValueError("the braces do not close")


def end_of_function(text, opening):
    """The same for a function, whose first braces may belong to a member that is initialized before the body."""
    end = end_of_braces(text, opening)
    while following := re.match(r"\s*(?:\{|,[^;{}]*\{)", text[end + 1:]):
        end = end_of_braces(text, end + following.end())
    return end


def functions(text):
    """(name, first line, lines) of each function."""
    text = blanked(blanked(text, COMMENT_OR_TEXT), DIRECTIVE)
    found, scopes, head_at = [], 0, 0
    while sign := re.search(r"[;{}]", text[head_at:]):
        at = head_at + sign.start()
        head = text[head_at:at]
        if sign.group() == "{" and not is_scope(head):
            begin, end = at - len(head.lstrip()), end_of_function(text, at)
            if name := name_of(head):
                found.append((name, text.count("\n", 0, begin) + 1, text.count("\n", begin, end) + 1))
            at = end
        elif sign.group() != ";":
            scopes += 1 if sign.group() == "{" else -1
        head_at = at + 1
    if scopes != 0:
        raise ValueError("the braces do not close")
    return found


def findings(texts, waived):
    """What is wrong in {file: text}."""
    wrong, used = [], set()
    for name, text in texts.items():
        try:
            for function, line, length in functions(text):
                if length <= MOST:
                    continue
                if (name, function) in waived:
                    used.add((name, function))
                else:
                    wrong.append(f"{name}:{line}: {function} has {length} lines, more than {MOST}: one function a stage")
        except ValueError as error:
            wrong.append(f"{name}: {error}")
    wrong += [f"{name}: {function}: a row that is not needed" for name, function in waived if (name, function) not in used]
    return wrong


def self_test():
    body = "  step();\n" * (MOST - 1)
    many = "  1,\n" * MOST
    long = f"{{\n{body}}}\n"
    fits = f"{{\n{body[:-10]}}}\n"
    cases = {  # file: (text, names that are reported)
        "plain.c": (f"static int run(int a) {long}", ["run"]),
        "fits.c": (f"static int run(int a) {fits}", []),
        "head.c": (f"static int run(int a,\n               int b) {fits}", ["run"]),
        "blocks.c": (f"void run(void) {{\n  if (a) {{\n{body}  }}\n}}\n", ["run"]),
        "member.hpp": (f"namespace a::b {{\nclass C : public D {{\n public:\n  [[nodiscard]] Result<void> run() const {long}}};\n}}\n",
                       ["run"]),
        "outside.hpp": (f"inline Result<void> C::run(A& a) {long}", ["run"]),
        "template.hpp": (f"template <typename T, std::size_t N>\nconstexpr std::array<T, N> run(T t) {fits}", ["run"]),
        "constructor.hpp": (f"struct C {{\n  C(int a) : one_{{a}}, two_{{}} {long}}};\n", ["C"]),
        "linkage.c": (f'extern "C" {{\nint run(struct a *b) {long}}}\n', ["run"]),
        "returns.c": (f"struct a *run(struct a *b) {long}", ["run"]),
        "attribute.hpp": (f"[[gnu::noinline]] static bool run() {long}", ["run"]),
        "macro.h": (f"MB4_APART void run(int a) {long}", ["run"]),
        "cut.c": (f"#define A(x) {{ \\\n  x\nint run(void) {long}", ["run"]),
        "operator.hpp": (f"constexpr bool operator==(const A& a, const A& b) {long}", ["operator"]),
        "table.c": (f"static const int run[SIZE(3)] = {{\n{many}}};\n", []),
        "list.c": (f"enum {{\n{many}}};\nstruct s {{\n{many}}};\n", []),
        "words.c": (f'/* int run(void) {{ */ // {{\nconst char *a = "{{";\nint b(char c) {{ return c == \'{{\'; }}\n', []),
        "open.c": ("int run(void) {\n", ["close"]),
        "trait.rs": (f"impl<'a, B: Bus> Chip<'a, B> {{\n  pub fn run(&'a mut self) -> Result<(), Error> {long}}}\n", ["run"]),
        "extern.rs": (f"unsafe extern \"C\" fn run(a: *mut u8) -> bool {long}", ["run"]),
    }
    missed = []
    for name, (text, names) in cases.items():
        found = findings({name: text}, {})
        if len(found) != len(names) or not all(want in one for want, one in zip(names, found)):
            missed.append(f"{name}: wanted {names}, found {found}")
    text = cases["plain.c"][0]
    if findings({"plain.c": text}, {("plain.c", "run"): "why"}):
        missed.append("a row does not excuse its function")
    if len(findings({"plain.c": text}, {("plain.c", "run"): "why", ("plain.c", "other"): "why"})) != 1:
        missed.append("a row that is not needed is not reported")
    return missed


def main():
    if sys.argv[1:] == ["--self-test"]:
        project.finish(self_test(), "each planted function is reported")
    files = [name for name in project.tracked() if SOURCE.search(name) and (ROOT / name).is_file()]
    texts = {name: (ROOT / name).read_text(encoding="utf-8") for name in files}
    if sys.argv[1:2] == ["--all"]:
        for name, text in texts.items():
            for function, line, length in functions(text):
                if length > int(sys.argv[2]):
                    print(f"{length:4} {name}:{line}: {function}")
        return
    for (name, function), why in WAIVED.items():
        print(f"left out: {name}: {function}: {why}")
    count = sum(len(functions(text)) for text in texts.values())
    project.finish(findings(texts, WAIVED), f"{count} functions in {len(files)} files, {len(WAIVED)} rows")


if __name__ == "__main__":
    main()
