# SPDX-License-Identifier: GPL-3.0-or-later
"""python3 -m models [--quick] [--list] [PART ...]: see scripts/reproduce.sh."""

import sys
import time

import command_line
import provenance

with command_line.needs("accuracy", ours=["accuracy", "models"]):
    from accuracy.report import made_with
    from accuracy.solve import ROOT, Failed, build_folder

    from . import (beams, cells, directions, discs, ends, free_sheet, hung_cloth, ideal, plates, solids, table_2_1,
                   touched, unrolling)

PARTS = {"beams": beams, "directions": directions, "free_sheet": free_sheet, "discs": discs, "ends": ends,
         "ideal": ideal, "plates": plates, "solids": solids, "hung_cloth": hung_cloth, "unrolling": unrolling,
         "cells": cells, "touched": touched, "table_2_1": table_2_1}
HEAD = """# Models of the literature

Tables and curves of [Wang 2005], computed anew, and every model under the same tool: `scripts/reproduce.sh springs`
runs `palpate_models`, `palpate solve` and `palpate replay`, and writes this page. Ours and the differences were not typed
in by hand; what is published is, with its place in the source. B numbers are this page's own. Where the print contradicts
itself, both versions stand here.

Difference: of ours from what is published, as a part of it, or in points where both are errors; where the source only
promises a limit, whether it is kept. *Another program*: the source's networks computed anew with other code, where the
source has a curve without figures, or none.

"""
SOURCE = """## Source

X. Wang, *Deformable Haptic Models for Surgical Simulation*, PhD thesis, University of Texas at Arlington, 2005.
"""


class Context:
    def __init__(self, work, images, quick):
        self.work, self.images, self.quick = work, images, quick
        self.start = time.time()
        work.mkdir(parents=True, exist_ok=True)

    def progress(self, text):
        print(f"[{time.time() - self.start:6.0f} s] {text}", flush=True)


def main():
    arguments = command_line.parse("scripts/reproduce.sh springs", __doc__, "part", list(PARTS), {})
    whole = not arguments.names and not arguments.quick
    begin = provenance.State.now()
    work = build_folder() / "models"
    docs = ROOT / "docs" if whole else work
    context = Context(work, docs / "images" / "models", arguments.quick)
    text, failures = [HEAD], 0
    for name in arguments.names or PARTS:
        section, failure = command_line.attempt(lambda name=name: PARTS[name].run(context), Failed)
        text.append(section or f"## {name}\n\nFailed: {failure}\n")
        context.progress(f"{name}: {command_line.outcome(failure, time.time() - context.start)}")
        failures += failure is not None
    made = made_with(provenance.sentence(begin, provenance.State.now()), time.time() - context.start, "all parts")
    text += [SOURCE, f"## Made with\n\n{made}\n"]
    page = docs / "models.md"
    page.write_text("\n".join(text), encoding="utf-8")
    print(f"{page}: {failures} parts failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
