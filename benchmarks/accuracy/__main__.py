# SPDX-License-Identifier: GPL-3.0-or-later
"""python3 -m accuracy [--quick] [--list] [CASE ...]: see scripts/page.sh accuracy."""

import concurrent.futures
import os
import pathlib
import shutil
import sys
import time

import command_line
import provenance

with command_line.needs("accuracy", ours=["accuracy"]):
    from . import recorded, report
    from .cases import CASES
    from .solve import ROOT, Failed, build_folder


class Context:
    """Where a case works, draws and tells how far it is."""

    def __init__(self, images, work, quick):
        self.images, self.work, self.quick = images, work, quick
        self.start = time.time()
        self.case = ""

    def folder(self, *names):
        return self.work.joinpath(*names)

    def progress(self, text):
        print(f"[{time.time() - self.start:6.0f} s] {self.case}: {text}", flush=True)


def _run_case(name, context):
    """Sections of one case by title, and what went wrong or None."""
    context.case = name
    begin = time.time()
    sections, failure = command_line.attempt(
        lambda: {name: CASES[name].run(context)} if name in CASES else recorded.run(name, context), Failed)
    context.progress(command_line.outcome(failure, time.time() - begin))
    return sections or {}, failure


def _run(names, context):
    """Sections and failures, by name, in the order of the names; as many cases at a time as there
    are cores. A case that does not run does not stop the others."""
    sections, failures = {}, {}
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
        started = {name: pool.submit(_run_case, name, context) for name in names}
        for name, done in started.items():
            found, failure = done.result()
            for title, section in found.items():
                if title in sections:  # of several test programs
                    sections[title].rows += section.rows
                else:
                    sections[title] = section
            if failure:
                failures[name] = failure
    return sections, failures


def main():
    known = [*CASES, *recorded.names()]
    arguments = command_line.parse("scripts/page.sh accuracy", __doc__, "case", known, {})
    whole = not arguments.names and not arguments.quick
    begin = provenance.State.now()
    work = build_folder() / "accuracy"
    docs = ROOT / "docs" / "results" if whole else work
    if whole:
        shutil.rmtree(work, ignore_errors=True)
    names = arguments.names or [n for n in known if not arguments.quick
                                or getattr(CASES.get(n), "QUICK", False)]
    lacking = [tool for n in names for tool in getattr(CASES.get(n), "NEEDS", ()) if not tool.available()]
    if lacking:
        print(f"not installed: {' '.join(t.PACKAGE for t in lacking)}; run "
              "scripts/install_dependencies.sh accuracy")
        return command_line.SKIPPED
    context = Context(docs / "images" / "accuracy", work, arguments.quick)
    sections, failures = _run(names, context)
    docs.mkdir(parents=True, exist_ok=True)
    page = pathlib.Path(docs / "accuracy.md")
    made = report.made_with(provenance.sentence(begin, provenance.State.now()), time.time() - context.start)
    page.write_text(report.page(sections, failures, made), encoding="utf-8")

    missed = sum(not r.passed for s in sections.values() for r in s.rows)
    print(report.terminal(sections))
    print(f"{page}: {sum(len(s.rows) for s in sections.values())} figures, {missed} out of bounds, "
          f"{len(failures)} cases failed: {' '.join(failures) or '-'}")
    return 1 if missed or failures else 0


if __name__ == "__main__":
    sys.exit(main())
