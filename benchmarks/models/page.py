# SPDX-License-Identifier: GPL-3.0-or-later
"""A page of chapters that are made one by one."""

import re

HEAD = """# Models of the literature

What the literature that this package grew from computed, computed anew, model by model, and every model under the same
tool: `scripts/page.sh reproduce` writes this page, and `scripts/page.sh reproduce CHAPTER` one chapter of it. Ours and the
differences were not typed in by hand; what is published is, with its place in the source. Where a print contradicts
itself, both versions stand here.

Difference: of ours from what is published, as a part of it, or in points where both are errors; where the source only
promises a limit, whether it is kept.
"""
MARK = re.compile(r"^<!-- chapter (\w+) -->\n", re.MULTILINE)


class Page:
    """In `file`; with `keep` the chapters that it has and that are not put() stay as they are."""

    def __init__(self, file, keep):
        self.file, self.chapters = file, {}
        if keep and file.exists():
            pieces = MARK.split(file.read_text(encoding="utf-8"))
            self.chapters = dict(zip(pieces[1::2], pieces[2::2]))

    def put(self, name, text):
        self.chapters[name] = text.rstrip("\n") + "\n\n"

    def write(self, titles):
        """titles: {name: title}, in the order of the page; what has no title goes."""
        there = [name for name in titles if name in self.chapters]
        listed = "\n".join(f"- [{titles[name]}](#{anchor(titles[name])}) (`{name}`)" for name in there)
        text = "".join(f"<!-- chapter {name} -->\n{self.chapters[name]}" for name in there)
        self.file.write_text(f"{HEAD}\n{listed}\n\n{text.rstrip()}\n", encoding="utf-8")


def anchor(title):
    """GitHub's, of a heading."""
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")
