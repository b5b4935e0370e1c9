# SPDX-License-Identifier: GPL-3.0-or-later
"""python3 -m hands [--quick] [--list] [PART ...]: see scripts/page.sh hands."""

import sys
import time

import command_line
import provenance

with command_line.needs("accuracy", ours=["accuracy", "hands"]):
    from accuracy.report import made_with
    from accuracy.solve import ROOT, Failed, build_folder

    from . import between, energy, sweep, zwidth

PARTS = {"hands": sweep, "parts": zwidth, "between": between, "energy": energy}
HEAD = """# Hands

Loops through simulated hands, with the parts that [haptics.md](../haptics.md) describes: `scripts/page.sh hands` runs
`palpate hand` and writes this page. Nothing on it was typed in by hand.

"""


class Context:
    def __init__(self, work, images, quick):
        self.work, self.images, self.quick = work, images, quick
        self.start, self.results = time.time(), []
        work.mkdir(parents=True, exist_ok=True)

    def progress(self, text):
        print(f"[{time.time() - self.start:6.0f} s] {text}", flush=True)

    def result(self, text):
        self.results.append(text)
        self.progress(text)


def main():
    arguments = command_line.parse("scripts/page.sh hands", __doc__, "part", list(PARTS), {})
    whole = not arguments.names and not arguments.quick
    begin = provenance.State.now()
    work = build_folder() / "hands"
    docs = ROOT / "docs" / "results" if whole else work
    context = Context(work, docs / "images" / "hands", arguments.quick)
    text, failures = [HEAD], 0
    for name in arguments.names or PARTS:
        section, failure = command_line.attempt(lambda name=name: PARTS[name].run(context), Failed)
        text.append(section or f"## {name}\n\nFailed: {failure}\n")
        context.progress(f"{name}: {command_line.outcome(failure, time.time() - context.start)}")
        failures += failure is not None
    made = made_with(provenance.sentence(begin, provenance.State.now()), time.time() - context.start, "all hands")
    text.append(f"## Made with\n\n{made}\n")
    page = docs / "hands.md"
    page.write_text("\n".join(text), encoding="utf-8")
    print("\n".join(context.results) + f"\n{page}: {failures} parts failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
