#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""make_expressions.py SV_FILE INC_FILE: random XOR trees with inversions inside, 60 single bits of
a 32-bit input, as a SystemVerilog module and as plain C++ to compare with. Always the same ones."""

import random
import sys
from pathlib import Path

SEED = 5006
BITS = 32
OUTPUTS = 60
LEAVES = (6, 14)

SPDX = ("// SPDX-FileCopyrightText: 2026 The openmb4 authors\n"
        "// SPDX-License-Identifier: Apache-2.0\n"
        "// Made by tests/canary/make_expressions.py.\n")


def tree(rng, leaves):
    """A tree as (operator, left, right), ("~", tree) or a bit number."""
    if leaves == 1:
        node = rng.randrange(BITS)
    else:
        left = rng.randint(1, leaves - 1)
        node = ("^", tree(rng, left), tree(rng, leaves - left))
    return ("~", node) if rng.random() < 0.4 else node


def text(node, bit, inversion):
    if isinstance(node, int):
        return bit.format(node)
    if node[0] == "~":
        return inversion.format(text(node[1], bit, inversion))
    return f"({text(node[1], bit, inversion)} ^ {text(node[2], bit, inversion)})"


def main():
    rng = random.Random(SEED)
    trees = [tree(rng, rng.randint(*LEAVES)) for _ in range(OUTPUTS)]
    module = [f"module xor_trees (input logic [{BITS - 1}:0] x_i, "
              f"output logic [{OUTPUTS - 1}:0] y_o);"]
    module += [f"  assign y_o[{i}] = {text(t, 'x_i[{}]', '(~{})')};" for i, t in enumerate(trees)]
    # All inputs are used, whatever the trees took.
    module += ["  logic unused;", "  assign unused = ^x_i;", "endmodule", ""]
    expected = [f"constexpr int kOutputs = {OUTPUTS};", "// One bit, 0 or 1.",
                "inline unsigned expected(int output, std::uint32_t x) {", "  switch (output) {"]
    expected += [f"    case {i}: return {text(t, '(x >> {} & 1u)', '({} ^ 1u)')};"
                 for i, t in enumerate(trees)]
    expected += ["    default: return 0;", "  }", "}", ""]
    Path(sys.argv[1]).write_text(SPDX + "\n".join(module), encoding="utf-8")
    Path(sys.argv[2]).write_text(SPDX + "\n".join(expected), encoding="utf-8")


main()
