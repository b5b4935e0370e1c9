# SPDX-License-Identifier: GPL-3.0-or-later
"""python3 -m work_precision [--quick] [--resume] [--list] [SUITE ...]: see scripts/benchmark.sh."""

import argparse
import hashlib
import pathlib
import shutil
import sys
import time
import traceback

SKIPPED = 77  # what ctest takes for a skipped test
try:
    from accuracy.solve import ROOT, Failed, program

    from . import report
    from .context import Context, build_work
    from .suites import SUITES
except ModuleNotFoundError as missing:
    if missing.name.split(".")[0] in ("accuracy", "work_precision"):
        raise
    print(f"no Python module {missing.name}; run scripts/install_dependencies.sh benchmark")
    sys.exit(SKIPPED)


def _stamp():
    """Of the program that is measured, its library included."""
    cli = pathlib.Path(program())
    files = [cli, *sorted(cli.parent.parent.parent.glob("lib/libpalpate_core.*"))]
    return hashlib.sha256(b"".join(f.read_bytes() for f in files if f.is_file())).hexdigest()


def _forget(runs, resume):
    """Drops earlier measurements, unless they are of the same program and wanted."""
    stamp = runs / "program"
    if not (resume and stamp.exists() and stamp.read_text() == _stamp()):
        shutil.rmtree(runs, ignore_errors=True)
    runs.mkdir(parents=True, exist_ok=True)
    stamp.write_text(_stamp())


def _run(names, context):
    """Sections and failures by name. A suite that does not run does not stop the others."""
    sections, failures = {}, {}
    for name in names:
        context.suite, begin = name, time.time()
        try:
            sections[name] = SUITES[name].run(context)
        except Failed as error:
            failures[name] = str(error)
        except Exception:  # a broken suite is reported like one that fails
            failures[name] = traceback.format_exc(limit=-3)
        context.progress(f"{'FAILED: ' + failures[name] if name in failures else 'done'} "
                         f"({time.time() - begin:.0f} s)")
    return sections, failures


def main():
    parser = argparse.ArgumentParser(prog="scripts/benchmark.sh", description=__doc__)
    parser.add_argument("suites", nargs="*", metavar="SUITE", help="default: all of " + " ".join(SUITES))
    parser.add_argument("--quick", action="store_true", help="small versions of the quick suites")
    parser.add_argument("--resume", action="store_true", help="keep what the same program measured before")
    parser.add_argument("--list", action="store_true", help="print the names and do nothing")
    arguments = parser.parse_args()
    if arguments.list:
        print("\n".join(SUITES))
        return 0
    unknown = [s for s in arguments.suites if s not in SUITES]
    if unknown:
        parser.error(f"no suite {' '.join(unknown)}; known: {' '.join(SUITES)}")

    whole = not arguments.suites and not arguments.quick
    work = build_work() / ("quick" if arguments.quick else "full")
    docs = ROOT / "docs" if whole else work
    names = arguments.suites or [n for n, s in SUITES.items() if s.QUICK or not arguments.quick]
    _forget(work / "runs", arguments.resume)
    context = Context(work, docs / "images" / "benchmarks", arguments.quick, arguments.resume)
    sections, failures = _run(names, context)
    docs.mkdir(parents=True, exist_ok=True)
    page = docs / "benchmarks.md"
    page.write_text(report.page(sections, failures, time.time() - context.start), encoding="utf-8")
    context.write_table(docs / "benchmarks.csv")
    print(f"{page}: {len(context.lines)} runs, {len(failures)} suites failed: {' '.join(failures) or '-'}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
