#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The block diagrams: NAME.dot in this folder is the source of NAME.svg.

  draw.py           draws all pictures anew (needs `dot` of the Debian package graphviz)
  draw.py --check   every arrow is true, and every picture shows the nodes and arrows of its source

A node MODULE.INSTANCE is an instance in the RTL. An arrow between two instances stands for nets from an output
of the one to an input of the other, and the words of its label are names of such nets. In simulator.dot a node is
a header or source file; of two files with an arrow one includes the other. Other nodes stand for the outside.
"""

import html
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
STYLE = ["-Gfontname=DejaVu Sans", "-Nfontname=DejaVu Sans", "-Efontname=DejaVu Sans Mono", "-Gfontsize=13",
         "-Nfontsize=13", "-Efontsize=10", "-Gcolor=gray50", "-Ecolor=gray30", "-Efontcolor=gray20", "-Gbgcolor=white",
         "-Glabeljust=l"]
ARROW = re.compile(r'^ *"?([\w.]+)"? -> (?:"?([\w.]+)"?|\{([^}]*)\})(?: \[(.*)\])?;$', re.M)


def bracket(text, start):
    """Index behind the bracket that matches the one before start."""
    depth = 1
    while depth:
        depth += {"(": 1, ")": -1}.get(text[start], 0)
        start += 1
    return start


def names(expression):
    """Identifiers of an expression, without fields, packages and literals."""
    return re.findall(r"(?<![\w.:'])[a-z_]\w*", re.sub(r"\w+::\w+|\d*'[a-z]\w+", "", expression))


class Module:
    def __init__(self, path):
        text = re.sub(r"//[^\n]*", "", path.read_text(encoding="utf-8"))
        self.assigns = [(target, right) for left, right in re.findall(r"assign ([^=;]*)=([^;]*);", text)
                        for target in names(left)]
        self.instances = {}  # name: (module, {port: nets})
        for found in re.finditer(r"\b([a-z]\w*_\w+)\s*(?:#\s*\((?:[^()]|\([^()]*\))*\)\s*)?(u_\w+)\s*\(", text):
            ports, inside = {}, text[found.end():bracket(text, found.end()) - 1]
            for port in re.finditer(r"\.(\w+)\s*(\()?", inside):
                if port[2]:
                    ports[port[1]] = names(inside[port.end():bracket(inside, port.end()) - 1])
                elif inside[:port.start()].count("(") == inside[:port.start()].count(")"):
                    ports.setdefault(port[1], [port[1]])
            self.instances[found[2]] = (found[1], ports)


def reached(graph, start):
    seen, todo = set(), list(start)
    while todo:
        node = todo.pop()
        if node not in seen:
            seen.add(node)
            todo += graph.get(node, ())
    return seen


def rtl_graph(modules, drawn):
    """{net: nets that it drives} inside the drawn modules; a net is (module or module.instance, name)."""
    graph = {}
    for name in drawn:
        for target, expression in modules[name].assigns:
            for net in names(expression):
                graph.setdefault((name, net), set()).add((name, target))
        for instance, (module, ports) in modules[name].instances.items():
            inner = module if module in drawn else f"{name}.{instance}"
            for port, nets in ports.items():
                for net in nets:
                    ends = (name, net), (inner, port)
                    source, target = ends[::-1] if port.endswith(("_o", "_no")) else ends
                    graph.setdefault(source, set()).add(target)
    return graph


def rtl_findings(arrows, modules):
    nodes = {end for arrow in arrows for end in arrow[:2] if "." in end}
    findings = [f"no instance {node}" for node in sorted(nodes)
                if node.split(".")[1] not in getattr(modules.get(node.split(".")[0]), "instances", ())]
    if findings:
        return findings
    graph = rtl_graph(modules, {node.split(".")[0] for node in nodes})
    every = set(graph).union(*graph.values())
    ahead = {net: reached(graph, [net]) for net in every}

    def ports(node, output):
        return {net for net in every if net[0] == node and net[1].endswith(("_o", "_no")) == output}

    def between(source, target):
        """Nets from an output of the source to an input of the target; an outside is any end."""
        out = ports(source, True) if "." in source else every
        into = ports(target, False) if "." in target else every
        return {net for net in set().union(*(ahead[start] for start in out)) if ahead[net] & into}

    for source, target, ways, words in arrows:
        nets = [between(*way) for way in ways]
        findings += [f"{way[0]} -> {way[1]}: no net" for way, found in zip(ways, nets) if not found]
        known = {name for found in nets for _, name in found}
        findings += [f"{source} -> {target}: '{word}' is no net of theirs" for word in words if word not in known]
    return findings


def sim_findings(arrows, files):
    findings = []
    for source, target, _, _ in arrows:
        if source in files and target in files and not any(
                re.search(rf'#include "(?:[\w/]+/)?{b}\.hpp"', files[a])
                for a, b in ((source, target), (target, source))):
            findings.append(f"{source} -> {target}: neither includes the other")
    return findings


def read(text):
    """[(source, target, [(from, to)], words of the label)]"""
    arrows = []
    for source, target, group, options in ARROW.findall(text):
        label = re.search(r'label="([^"]*)"', options)
        words = re.findall(r"\w+", label[1].replace("\\n", " ")) if label else []
        direction = re.search(r"dir=(\w+)", options)
        for end in re.findall(r"[\w.]+", group) if group else [target]:
            ways = {"back": [(end, source)], "both": [(source, end), (end, source)]}
            arrows.append((source, end, ways.get(direction and direction[1], [(source, end)]), words))
    return arrows


PLANTED = {  # an arrow that is not true: what is found
    '"mb4_engine.u_regs" -> "mb4_engine.u_nobody";': "no instance",
    '"mb4_lines.u_timebase" -> "mb4_engine.u_regs";': "no net",
    '"mb4_engine.u_regs" -> "mb4_engine.u_control" [label="start"];': "is no net of theirs",
    '"mb4_engine.u_control" -> pins [label="ma1_o"];': "is no net of theirs",
    "slave -> scenario;": "neither includes the other",
}


def check():
    modules = {path.stem: Module(path) for path in ROOT.glob("rtl/**/*.sv")}
    files = {}
    for path in (*ROOT.glob("sim/**/*.hpp"), *ROOT.glob("sim/**/*.cpp")):
        files[path.stem] = files.get(path.stem, "") + path.read_text(encoding="utf-8")
    findings = []
    for line, expected in PLANTED.items():
        found = " ".join(rtl_findings(read(line), modules) if "." in line else sim_findings(read(line), files))
        if expected not in found:
            findings.append(f"planted {line} expected '{expected}', found '{found}'")
    sources = sorted(HERE.glob("*.dot"))
    for source in sources:
        text = source.read_text(encoding="utf-8")
        arrows = read(text)
        found = sim_findings(arrows, files) if source.stem == "simulator" else rtl_findings(arrows, modules)
        picture = source.with_suffix(".svg").read_text(encoding="utf-8")
        titles = {html.unescape(title) for title in re.findall(r'class="edge">\n<title>(.*)</title>', picture)}
        if titles != {f"{arrow[0]}->{arrow[1]}" for arrow in arrows}:
            found.append("the picture has other arrows; draw.py draws it anew")
        shown = html.unescape(" ".join(re.findall(r"<text [^>]*>([^<]*)</text>", picture))).replace("\u00a0", " ")
        for label in re.findall(r'label="([^"]*)"', text):
            found += [f"the picture does not show '{line}'; draw.py draws it anew"
                      for line in label.split("\\n") if line.strip() not in shown]
        findings += [f"{source.name}: {line}" for line in found]
    print("\n".join(findings) or f"{len(sources)} pictures")
    return 1 if findings else 0


def main():
    if sys.argv[1:] == ["--check"]:
        return check()
    for source in sorted(HERE.glob("*.dot")):
        picture = subprocess.run(["dot", "-Tsvg", *STYLE, source], check=True, capture_output=True, text=True).stdout
        spdx = "\n".join(f"<!-- {line[3:]} -->" for line in source.read_text().splitlines()[:2])
        head, newline, rest = picture.partition("\n")
        source.with_suffix(".svg").write_text(f"{head}{newline}{spdx}\n{rest}", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
