#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Builds the documentation site and reads it as a browser would: site_test.py ROOT FOLDER. Exit status
77: Python's venv or PyPI is missing."""

import json
import re
import subprocess
import sys
import tempfile
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

SKIPPED = 77
VOID = {"script": "src", "img": "src", "source": "src", "iframe": "src", "link": "href"}


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.anchors, self.links, self.parts, self.captions = set(), [], [], []
        self.entries = []  # of the navigation, in order: captions and links
        self.tables = 0
        self.in_caption = False
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.anchors |= {values[key] for key in ("id", "name") if values.get(key)}
        self.tables += tag == "table"
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
            if "reference" in (values.get("class") or "") and self.captions:
                self.entries.append((self.captions[-1], values["href"]))
        if tag in VOID and values.get(VOID[tag]) and values.get("rel") not in ("canonical",):
            self.parts.append(values[VOID[tag]])
        if tag == "object" and values.get("data"):
            self.parts.append(values["data"])
        self.in_caption = "caption-text" in (values.get("class") or "")

    def handle_data(self, data):
        if self.in_caption:
            self.captions.append(data)
            self.in_caption = False


def findings(html):
    """What does not resolve in a folder of HTML, and what would need a network."""
    pages = {path: Page(path) for path in sorted(html.rglob("*.html"))}
    found = []
    for path, page in pages.items():
        name = path.relative_to(html)
        for link in page.parts + page.links:
            parts = urlsplit(link)
            if parts.scheme in ("data", "mailto"):
                continue
            if parts.scheme or parts.netloc:
                if link in page.parts:
                    found.append(f"{name}: needs the network for {link}")
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if not target.is_file():
                found.append(f"{name}: nothing at {link}")
            elif parts.fragment and target in pages and \
                    unquote(parts.fragment) not in pages[target].anchors:
                found.append(f"{name}: no such place: {link}")
    return pages, found


def check_checker():
    """The checker finds each kind of mistake."""
    with tempfile.TemporaryDirectory() as folder:
        html = Path(folder).resolve()
        (html / "good.html").write_text('<p id="here"><a href="#here">x</a></p>')
        (html / "bad.html").write_text(
            '<a href="good.html#here">1</a><a href="https://example.org">2</a><a href="none.html">3</a>'
            '<a href="good.html#there">4</a><img src="none.svg"><script src="https://x.org/a.js"></script>')
        _, found = findings(html)
        assert sorted(found) == [
            "bad.html: needs the network for https://x.org/a.js", "bad.html: no such place: good.html#there",
            "bad.html: nothing at none.html", "bad.html: nothing at none.svg"], found


def check_refusals(root):
    """A link to nothing, and a page that the index leaves out, end the build."""
    for readme, page, message in ((("[a](docs/none.md)"), "", "docs/none.md"),
                                  ("", "# Left out", "has no link to docs/new.md")):
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder, "copy")
            (copy / "docs").mkdir(parents=True)
            (copy / "README.md").write_text(f"# Home\n{readme}\n")
            (copy / "docs/README.md").write_text("# Index\n## You\n[Home](../README.md)\n")
            if page:
                (copy / "docs/new.md").write_text(f"{page}\n")
            result = subprocess.run([sys.executable, "-B", root / "tools/site/pages.py", copy,
                                     Path(folder, "out")], capture_output=True, text=True, check=False)
            assert result.returncode == 1 and message in result.stderr, result


def check_dialect(root, html, pages):
    """Every page is there, with all its tables: Sphinx has read them as Markdown."""
    names = [path.relative_to(root) for path in sorted((root / "docs").glob("*.md"))]
    for name in names + [Path("CHANGELOG.md"), Path("drivers/README.md"), Path("sim/README.md")]:
        page = pages[html / name.with_suffix(".html")]
        text = re.sub(r"^ *```.*?^ *```", "", (root / name).read_text(encoding="utf-8"),
                      flags=re.M | re.S)
        wanted = len(re.findall(r"^ *\|(?: *:?-+:? *\|)+$", text, re.M))
        assert page.tables == wanted, f"{name}: {page.tables} tables instead of {wanted}"


def check_navigation(root, html, pages):
    """The navigation is that of docs/README.md."""
    text = (root / "docs/README.md").read_text(encoding="utf-8")
    home = pages[html / "index.html"]
    seen = {"README.md"}
    for part in re.split(r"^## ", text, flags=re.M)[1:]:
        heading, _, body = part.partition("\n")
        wanted = []
        for target in re.findall(r"\]\(([^)#\s]+\.md)\)", body):
            path = (root / "docs" / target).resolve().relative_to(root).as_posix()
            if path not in seen:
                seen.add(path)
                wanted.append(path[:-len("md")] + "html")
        shown = [link for caption, link in home.entries if caption == heading]
        assert shown[:len(wanted)] == wanted, f"{heading}: {shown} instead of {wanted}"


def check_pages_only(root, html, pages):
    """The site and its search have pages of the repository, and one page that lists files. A source is a text."""
    made = {"genindex", "search", "files", "index", "chip"}
    for path in pages:
        name = path.relative_to(html).with_suffix("")
        assert str(name) in made or (root / f"{name}.md").is_file(), f"{name}: a page of the site only"
    index = (html / "searchindex.js").read_text(encoding="utf-8")
    names = json.loads(re.search(r'"?docnames"?:(\[.*?\])', index)[1])
    assert all(name in made or (root / f"{name}.md").is_file() for name in names), names
    # The first word is on a page. The second one is in a source that a page links to, and on no page.
    assert "halspibus" in index and "priu32" not in index
    link = "../files/examples/mcu/stm32/encoder.cpp.txt"
    assert link in pages[html / "docs/boards.html"].links
    assert (html / "docs" / link).resolve().read_bytes() == (root / "examples/mcu/stm32/encoder.cpp").read_bytes()
    assert "files.html#folder-regmap" in pages[html / "index.html"].links


def main(root, folder):
    root, html = Path(root).resolve(), Path(folder).resolve() / "html"
    check_checker()
    check_refusals(root)
    chip = Path(folder, "chip_for_test.html")
    Path(folder).mkdir(parents=True, exist_ok=True)
    chip.write_text('<!doctype html><html lang="en"><title>chip</title></html>')
    result = subprocess.run([root / "tools/site/build.sh", folder, chip], capture_output=True,
                            text=True, check=False)
    if result.returncode == 3 or "tools/setup.sh site" in result.stderr:
        print("skipped:", result.stderr.strip().splitlines()[-1])
        return SKIPPED
    if result.returncode:
        print(result.stdout, result.stderr)
        return 1
    pages, found = findings(html)
    check_dialect(root, html, pages)
    check_navigation(root, html, pages)
    check_pages_only(root, html, pages)
    if "../chip.html" not in pages[html / "docs/browser.html"].links:
        found.append("docs/browser.html: no link to the chip's page")
    documents = re.search(r'<html lang="en" data-documents="([^"]+)">', (html / "chip.html").read_text())
    if documents is None or not (html / documents[1]).is_file():
        found.append("chip.html: does not name the documents")
    print("\n".join(found) or f"{len(pages)} pages, "
          f"{sum(len(page.links) + len(page.parts) for page in pages.values())} links and pictures: good")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
