# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures that C++ tests record (test/support/accuracy_record.h): every test program whose name
ends in _accuracy_test is run and its lines become rows, one section for each problem."""

import json
import os
import subprocess

from .rows import Row, Section
from .solve import ROOT, Failed, build_folder


def names():
    """Names of the test programs, from their sources."""
    return sorted(p.stem for p in (ROOT / "test").rglob("*_accuracy_test.cpp"))


def _program(name):
    found = [p for p in build_folder().rglob(name) if p.is_file() and os.access(p, os.X_OK)]
    if not found:
        raise Failed(f"{name} is not built: run scripts/build.sh {name}")
    return found[0]


def read(text):
    """Rows of JSON lines, in their order; a number that was not finite fails its bound."""
    rows = []
    for line in text.splitlines():
        fields = json.loads(line)
        for key in ("value", "reference", "error"):
            fields[key] = float("nan") if fields[key] is None else fields[key]
        rows.append(Row(**fields))
    return rows


def run(name, context):
    """Sections of one test program, by title. A test that fails is a case that did not run."""
    out = context.folder("recorded") / f"{name}.jsonl"
    out.parent.mkdir(parents=True, exist_ok=True)
    out.unlink(missing_ok=True)
    done = subprocess.run([str(_program(name))], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, env={**os.environ, "PALPATE_ACCURACY_OUT": str(out)})
    rows = read(out.read_text()) if out.exists() else []
    if not rows or (done.returncode != 0 and all(r.passed for r in rows)):
        raise Failed(f"{name}: status {done.returncode}: {done.stdout.strip()[-600:]}")
    sections = {}
    for row in rows:
        text = f"Computed by the test program `{name}`."
        sections.setdefault(row.case, Section(row.case, text, [])).rows.append(row)
    return sections
