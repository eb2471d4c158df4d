# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""How Sphinx draws the documentation site. tools/site/build.sh calls it."""

import re
from pathlib import Path

project = "openmb4"
copyright = "The openmb4 authors"
version = release = re.search(
    r"project\(openmb4 VERSION ([\d.]+)",
    (Path(__file__).parents[2] / "CMakeLists.txt").read_text(encoding="utf-8"))[1]

extensions = ["myst_parser"]
myst_heading_anchors = 6  # links to headings as in the repository
smartquotes = False
suppress_warnings = ["misc.highlighting_failure", "myst.header"]

html_theme = "furo"
html_title = f"openmb4 {release}"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_js_files = ["site.js"]
html_copy_source = False
html_use_index = False
html_show_sphinx = False
html_theme_options = {"navigation_with_keys": True}
