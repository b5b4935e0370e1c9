# SPDX-License-Identifier: GPL-3.0-or-later
"""python3 -m models [--quick] [--list] [CHAPTER or PART ...]: see scripts/page.sh reproduce."""

import importlib
import sys
import textwrap
import time

import command_line
import provenance

with command_line.needs("accuracy", ours=["accuracy", "models"]):
    from accuracy.report import made_with
    from accuracy.solve import ROOT, Failed, build_folder

    from .chapters import CHAPTERS
    from .page import Page

    PARTS = {part: importlib.import_module("models." + part) for chapter in CHAPTERS.values() for part in chapter.parts}


class Context:
    def __init__(self, work, images, quick):
        self.work, self.images, self.quick = work, images, quick
        self.start = time.time()
        work.mkdir(parents=True, exist_ok=True)

    def progress(self, text):
        print(f"[{time.time() - self.start:6.0f} s] {text}", flush=True)


def text_of(chapter, names, context):
    """The chapter with its parts of these names, and how many of them failed."""
    begin, start, failures = provenance.State.now(), time.time(), 0
    text = [f"## {chapter.title}\n\n{textwrap.fill(chapter.head, 120)}\n"]
    for name in names:
        section, failure = command_line.attempt(lambda name=name: PARTS[name].run(context), Failed)
        text.append(section or f"### {name}\n\nFailed: {failure}\n")
        context.progress(f"{name}: {command_line.outcome(failure, time.time() - context.start)}")
        failures += failure is not None
    if chapter.source:
        text.append(f"*Source:* {chapter.source}\n")
    made = made_with(provenance.sentence(begin, provenance.State.now()), time.time() - start, "this chapter")
    return "\n".join(text + [f"*Made with:*\n\n{made}\n"]), failures


def main():
    arguments = command_line.parse("scripts/page.sh reproduce", __doc__, "part", [*CHAPTERS, *PARTS], {})
    whole = not arguments.quick and all(name in CHAPTERS for name in arguments.names)
    chosen = {part for name in arguments.names or CHAPTERS
              for part in (CHAPTERS[name].parts if name in CHAPTERS else [name])}
    work = build_folder() / "models"
    docs = ROOT / "docs" / "results" if whole else work
    context = Context(work, docs / "images" / "models", arguments.quick)
    page, failures = Page(docs / "models.md", keep=whole), 0
    for name, chapter in CHAPTERS.items():
        parts = [part for part in chapter.parts if part in chosen]
        if not parts:
            continue
        text, failed = text_of(chapter, parts, context)
        failures += failed
        page.put(name, text)
        page.write({name: chapter.title for name, chapter in CHAPTERS.items()})
    print(f"{page.file}: {failures} parts failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
