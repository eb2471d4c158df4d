# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Lays out the pages of the documentation site for Sphinx. tools/site/build.sh calls it.

  pages.py ROOT FOLDER [CHIP_PAGE]

FOLDER/source receives every page of ROOT that can be reached from README.md and docs/README.md, at its own
path, and its pictures. README.md becomes index.md; it has the navigation, which is that of
docs/README.md. A link to a file that is no page leads to the bare text of this file in FOLDER/text, which
build.sh copies beside the pages: the search knows pages only. A link to a folder leads to its place on the one
page that lists the files, files.md. CHIP_PAGE is the page of tools/web/build.sh; docs/browser.md
then links to it. A link to nothing is an error."""

import os
import re
import shutil
import sys
from pathlib import Path

INDEX = "docs/README.md"
HOME = "README.md"
PICTURES = {".svg", ".png"}
FILES = "files.md"  # the page that lists them
TEXTS = "files"  # where the site has their texts
LINK = re.compile(r"(?<=\]\()([^)\s#]*)(#[^)\s]*)?(?=\))")
FENCE = re.compile(r"^ *(```+|~~~+).*?^ *\1[`~]*$", re.M | re.S)
CODE = re.compile(r"(`+)(?!`).*?(?<!`)\1(?!`)", re.S)
CHIP_NOTE = """
```{{admonition}} On this site
<a href="{target}">Open the chip in your browser</a>. It is the page that the commands below build.
```
"""


def folder_anchor(path):
    return "folder-" + re.sub(r"[^a-z0-9]+", "-", path.lower()).strip("-")


def opening(text, at):
    """The [ of the ] at `at`."""
    depth = 0
    for place in range(at, -1, -1):
        depth += (text[place] == "]") - (text[place] == "[")
        if depth == 0:
            return place
    raise SystemExit(f"no [ of a link: {text[max(0, at - 40):at + 1]}")


class Site:
    def __init__(self, root, folder):
        self.root = root
        self.folder = folder / "source"
        self.texts = folder / "text"
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
            target = self.link(path, found[1], found[2] or "")
            if target.endswith(".txt"):
                # Sphinx takes no links to files of other builders: this one is HTML.
                label = opening(text, found.start() - 2)
                parts += [text[at:label], f'<a href="{target}">', text[label + 1:found.start() - 2], "</a>"]
                at = found.end() + 1
            else:
                parts += [text[at:found.start()], target]
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
            if here.is_dir():
                return f"#{folder_anchor(place)}"
            anchor = ""
        return os.path.relpath(self.place(place), os.path.dirname(self.place(path))) + anchor

    def place(self, path):
        """Where the site has a page, a picture or the text of a file of the repository."""
        if path == HOME:
            return "index.md"
        return f"{TEXTS}/{path}.txt" if path in self.files else path

    def write(self, place, text):
        target = self.folder / place
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8")

    def files_page(self):
        """The folders that pages link to, and those of the files that they link to."""
        folders = {path for path in self.files if (self.root / path).is_dir()}
        files = self.files - folders
        folders |= {os.path.dirname(path) for path in files}
        text = "---\norphan: true\nnosearch: true\n---\n\n# Files\n\n" \
               "The folders of the repository that pages of this site name. A file that a page names is here as text.\n"
        for folder in sorted(folders):
            text += f"\n({folder_anchor(folder)})=\n## {folder or 'openmb4'}/\n\n"
            for child in sorted((self.root / folder).iterdir()):
                place = os.path.join(folder, child.name)
                name = child.name + ("/" if child.is_dir() else "")
                if place in files:
                    text += f'* <a href="{self.place(place)}">{name}</a>\n'
                elif place in folders:
                    text += f"* [{name}](#{folder_anchor(place)})\n"
                elif not re.match(r"[._]|build", name):
                    text += f"* `{name}`\n"
        return text

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
        self.write(FILES, self.files_page())
        for path in self.files:
            if (self.root / path).is_file():
                target = self.texts / f"{path}.txt"
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(self.root / path, target)
        for path in self.pictures:
            (self.folder / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(self.root / path, self.folder / path)


def main(root, folder, chip_page=None):
    for part in ("source", "text"):
        shutil.rmtree(Path(folder, part), ignore_errors=True)
    Site(Path(root).resolve(), Path(folder)).make(chip_page)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        raise SystemExit(__doc__)
    main(*sys.argv[1:])
