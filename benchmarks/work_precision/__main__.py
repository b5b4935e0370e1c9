# SPDX-License-Identifier: GPL-3.0-or-later
"""python3 -m work_precision [--quick] [--resume] [--list] [SUITE ...]: see scripts/page.sh benchmark."""

import hashlib
import pathlib
import shutil
import sys
import time

import command_line
import provenance

with command_line.needs("benchmark", ours=["accuracy", "work_precision"]):
    from accuracy.report import made_with
    from accuracy.solve import ROOT, Failed, program

    from . import report
    from .context import Context, build_work
    from .suites import SUITES


def _stamp():
    """Of the program that is measured, its library included."""
    cli = pathlib.Path(program())
    files = [cli, *sorted(cli.parent.parent.parent.glob("lib/libpalpate_core.*"))]
    return hashlib.sha256(b"".join(f.read_bytes() for f in files if f.is_file())).hexdigest()


def _forget(folder, keep):
    """Drops what an earlier run left in a folder, unless it is of the same program and wanted."""
    stamp = folder / "program"
    if not (keep and stamp.exists() and stamp.read_text() == _stamp()):
        shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True, exist_ok=True)
    stamp.write_text(_stamp())


def _run(names, context):
    """Sections and failures by name. A suite that does not run does not stop the others."""
    sections, failures = {}, {}
    for name in names:
        context.suite, begin = name, time.time()
        section, failure = command_line.attempt(lambda suite=SUITES[name]: suite.run(context), Failed)
        if failure:
            failures[name] = failure
        else:
            sections[name] = section
        context.progress(command_line.outcome(failure, time.time() - begin))
    return sections, failures


def main():
    arguments = command_line.parse("scripts/page.sh benchmark", __doc__, "suite", list(SUITES),
                                   {"resume": "keep what the same program measured before"})
    whole = not arguments.names and not arguments.quick
    begin = provenance.State.now()
    work = build_work() / ("quick" if arguments.quick else "full")
    docs = ROOT / "docs" / "results" if whole else work
    names = arguments.names or [n for n, s in SUITES.items() if s.QUICK or not arguments.quick]
    _forget(work / "runs", arguments.resume)
    _forget(work / "references", True)
    context = Context(work, docs / "images" / "benchmarks", arguments.quick, arguments.resume)
    sections, failures = _run(names, context)
    docs.mkdir(parents=True, exist_ok=True)
    page = docs / "benchmarks.md"
    made = made_with(provenance.sentence(begin, provenance.State.now()), time.time() - context.start, "everything")
    page.write_text(report.page(sections, failures, made), encoding="utf-8")
    context.write_table(docs / "benchmarks.csv")
    print(f"{page}: {len(context.lines)} runs, {len(failures)} suites failed: {' '.join(failures) or '-'}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
