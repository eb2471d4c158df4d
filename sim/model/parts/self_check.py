# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Makes check() and another host() for the header. They test the assumptions of the parts while the
model runs."""

import re

HEAD = """#include <cstdlib>
#include <type_traits>
inline void differs(const char* name, unsigned value) {
std::fprintf(stderr, "edge: %s would change, key %u, but no flag says so\\n", name, value);
std::abort();
}"""


def check_host(writer, names):
    """Lines of a host() that at some edges compares all variables with those after eval()."""
    root = writer.root
    compared = [name for name in names if re.match(r"(?!__V|\w+__Syms)", name)]
    compared += [f"__Vtrigrprev__TOP__{name}" for name in writer.events]
    return [*writer.opening("host", "bool"),
            "if (++kept.edges % 5 != 0) return unchecked_host(vlSelf, kept);",
            f"static std::byte before[sizeof({root})], after[sizeof({root})];",
            f"std::memcpy(before, vlSelf, sizeof({root}));",
            "const bool seen = unchecked_host(vlSelf, kept);",
            f"std::memcpy(after, vlSelf, sizeof({root}));",
            f"std::memcpy(static_cast<void*>(vlSelf), before, sizeof({root}));",
            f"{root}___eval(vlSelf);",
            "const auto base = reinterpret_cast<const std::byte*>(vlSelf);",
            *(f"if (const auto p = reinterpret_cast<const std::byte*>(&vlSelf->{name}); "
              f"std::memcmp(after + (p - base), p, sizeof vlSelf->{name}) != 0) "
              f'differs("host: {name}", 0);' for name in compared), "return seen;", "}"]


def check(writer):
    """Lines of check(). It computes each part whose flag is not set, with every value of its key,
    and ends the program if a variable changes. It leaves out parts that write arrays, and
    messages."""
    lines = [HEAD, *writer.opening("check")]
    for part in writer.lists["rise"]:
        if part.bits and not part.arrays:
            lines += one(writer, part)
    return [*lines, "}"]


def one(writer, part):
    lasting = writer.lasting(part)
    lines = ["{", *writer.declared(part)]
    for kind, names in (("was", lasting), ("key", part.key)):
        lines += [f"const auto {kind}{k} = {writer.variable(name)};"
                  for k, name in enumerate(names)]
    lines += [f"for (unsigned value = 0; value < {part.bits}; ++value) {{",
              f"if (({writer.flag(part, 'value')}) != 0) continue;"]
    for k, (name, at) in enumerate(writer.bits_of(part)):
        mask = (1 << writer.widths[name]) - 1
        lines.append(f"{writer.variable(name)} = "
                     f"static_cast<std::remove_cv_t<decltype(key{k})>>(value >> {at} & {mask});")
    lines += [writer.text(row) for row in part.rows if "VL_WRITEF" not in row.text]
    lines += [f'if (was{k} != {writer.variable(name)}) differs("{name}", value);'
              for k, name in enumerate(lasting)]
    return [*lines, "}", *(f"{writer.variable(name)} = key{k};"
                           for k, name in enumerate(part.key)), "}"]
