# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Lays out the pages of the documentation site for Sphinx. tools/site/build.sh calls it.

  pages.py ROOT FOLDER [CHIP_PAGE]

FOLDER receives every page of ROOT that can be reached from README.md and docs/README.md, at its own
path, and its pictures. README.md becomes index.md; it has the navigation, which is that of
docs/README.md. A link to a file that is no page leads to a page with the text of this file, and a
link to a folder to a list of its files. CHIP_PAGE is the page of tools/web/build.sh; docs/browser.md
then links to it. A link to nothing is an error."""

import os
import re
import shutil
import sys
from pathlib import Path

INDEX = "docs/README.md"
HOME = "README.md"
PICTURES = {".svg", ".png"}
LANGUAGES = {".c": "c", ".h": "c", ".hpp": "cpp", ".cpp": "cpp", ".py": "python", ".sh": "bash",
             ".sv": "systemverilog", ".toml": "toml", ".json": "json", ".yml": "yaml"}
LINK = re.compile(r"(?<=\]\()([^)\s#]*)(#[^)\s]*)?(?=\))")
FENCE = re.compile(r"^ *(```+|~~~+).*?^ *\1[`~]*$", re.M | re.S)
CODE = re.compile(r"(`+)(?!`).*?(?<!`)\1(?!`)", re.S)
CHIP_NOTE = """
```{{admonition}} On this site
<a href="{target}">Open the chip in your browser</a>. It is the page that the commands below build.
```
"""


class Site:
    def __init__(self, root, folder):
        self.root = root
        self.folder = folder
        self.pages = {}  # path in the repository: text
        self.files = set()  # files and folders that pages link to
        self.pictures = set()

    def read(self, path):
        """Takes a page, and the pages that it links to."""
        if path in self.pages:
            return
        text = (self.root / path).read_text(encoding="utf-8")
        self.pages[path] = text
        self.pages[path] = self.links_of(path, text)

    def links_of(self, path, text):
        """The text of a page with its links as the site has them."""
        shown = [found.span() for found in FENCE.finditer(text)]
        shown += [found.span() for found in CODE.finditer(text)
                  if not any(a <= found.start() < b for a, b in shown)]
        parts, at = [], 0
        for found in LINK.finditer(text):
            if any(a <= found.start() < b for a, b in shown):
                continue
            parts += [text[at:found.start()], self.link(path, found[1], found[2] or "")]
            at = found.end()
        text = "".join(parts) + text[at:]
        # Sphinx knows the anchors that headings make. A page's own ones are HTML, as are their links.
        for anchor in re.findall(r'<a id="([\w-]+)"></a>', text):
            text = re.sub(rf"\[([^\]\n]*)\]\(#{anchor}\)", rf'<a href="#{anchor}">\1</a>', text)
        return text

    def link(self, path, target, anchor):
        if not target or re.match(r"[a-z]+:", target):
            return target + anchor
        place = os.path.normpath(os.path.join(os.path.dirname(path), target))
        here = self.root / place
        if place.startswith("..") or not here.exists():
            raise SystemExit(f"{path}: link to '{target}', which does not exist")
        if here.is_file() and here.suffix == ".md":
            self.read(place)
        elif here.is_file() and here.suffix in PICTURES:
            self.pictures.add(place)
        else:
            self.files.add(place)
            anchor = ""
        return os.path.relpath(self.place(place), os.path.dirname(self.place(path))) + anchor

    def place(self, path):
        """Where the site has a page, a picture or a file of the repository."""
        if path == HOME:
            return "index.md"
        if path in self.files:
            is_folder = (self.root / path).is_dir()
            return os.path.join("files", path, "index.md") if is_folder else f"files/{path}.md"
        return path

    def write(self, place, text):
        target = self.folder / place
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8")

    def file_page(self, path):
        text = (self.root / path).read_text(encoding="utf-8")
        fence = "`" * max(3, 1 + max(map(len, re.findall("`+", text)), default=0))
        language = LANGUAGES.get(Path(path).suffix, "text")
        return f"---\norphan: true\n---\n\n# {Path(path).name}\n\n`{path}`\n\n" \
               f"{fence}{language}\n{text}{fence}\n"

    def folder_page(self, path):
        rows = []
        for child in sorted((self.root / path).iterdir()):
            name = child.name + ("/" if child.is_dir() else "")
            whole = f"{path}/{child.name}"
            known = whole in self.files or whole in self.pages
            to = os.path.relpath(self.place(whole), os.path.dirname(self.place(path)))
            if not re.match(r"[._]", name):
                rows.append(f"* [{name}]({to})" if known else f"* `{name}`")
        return f"---\norphan: true\n---\n\n# {path}\n\n" \
               "A folder of the repository. This site holds those of its files that have a link.\n\n" \
               + "\n".join(rows) + "\n"

    def navigation(self):
        """[(heading of docs/README.md, [(title, page)])], in its order. A page stands below the first
        heading that names it."""
        sections, seen = [], {HOME}
        text = (self.root / INDEX).read_text(encoding="utf-8")
        for part in re.split(r"^## ", text, flags=re.M)[1:]:
            heading, _, body = part.partition("\n")
            rows = []
            for title, target in re.findall(r"\[((?:[^\]`]|`[^`]*`)+)\]\(([^)#\s]+\.md)\)", body):
                page = os.path.normpath(os.path.join(os.path.dirname(INDEX), target))
                if page not in seen:
                    seen.add(page)
                    title = title.replace("`", "")
                    rows.append((title[0].upper() + title[1:], page))
            if rows:
                sections.append((heading.strip(), rows))
        # Pages are called by their headings. Where two have the same, the index tells them apart.
        heads = {page: re.search(r"^# (.*)", self.pages[page], re.M)[1]
                 for _, rows in sections for _, page in rows}
        names = list(heads.values())
        return [(heading, [(heads[page] if names.count(heads[page]) == 1 else title, page)
                           for title, page in rows]) for heading, rows in sections]

    def toctrees(self):
        def tree(caption, rows):
            entries = "".join(f"{title} <{self.place(page)}>\n" for title, page in rows)
            return f"\n```{{toctree}}\n:hidden:\n{caption}\n{entries}```\n"

        sections = self.navigation()
        listed = {page for _, rows in sections for _, page in rows} | {HOME, INDEX}
        for page in sorted(self.pages):
            if page not in listed and page.startswith("docs/"):
                raise SystemExit(f"{INDEX}: has no link to {page}")
            if page not in listed:
                self.pages[page] = "---\norphan: true\n---\n\n" + self.pages[page]
        return tree("", [("Documents, by reader", INDEX)]) + "".join(
            tree(f":caption: {heading}\n", rows) for heading, rows in sections)

    def make(self, chip_page):
        self.read(HOME)
        self.read(INDEX)
        for page in sorted((self.root / "docs").glob("*.md")):
            self.read(page.relative_to(self.root).as_posix())
        trees = self.toctrees()
        if chip_page is not None:
            name = "docs/browser.md"
            head, line, rest = self.pages[name].partition("\n## ")
            self.pages[name] = head + CHIP_NOTE.format(target="../chip.html") + line + rest
        for page, text in self.pages.items():
            self.write(self.place(page), text + (trees if page == HOME else ""))
        for path in self.files:
            is_folder = (self.root / path).is_dir()
            self.write(self.place(path), (self.folder_page if is_folder else self.file_page)(path))
        for path in self.pictures:
            (self.folder / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(self.root / path, self.folder / path)


def main(root, folder, chip_page=None):
    shutil.rmtree(folder, ignore_errors=True)
    Site(Path(root).resolve(), Path(folder)).make(chip_page)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        raise SystemExit(__doc__)
    main(*sys.argv[1:])
