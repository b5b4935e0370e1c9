# SPDX-License-Identifier: GPL-3.0-or-later
"""A motion with one mesh after the other, beside the converged force."""

import dataclasses
import math

from accuracy.rows import table

from ...jumps import Jumps
from ...replays import play
from ..reach import Goal
from .settings import SHIPPED

ERROR, BEST, P50, P99 = 8.0, 3.0, 5.0, 10.0  # asked for: [%], of the best mesh [%], [ms] with two threads
HEAD = ["mesh", "nodes, at most", "force error, RMS", "peak force", "off by", "largest error",
        "one thread: p50, p99", "two: p50, p99", "step at a change of the mesh, above those near it",
        "least det F", "not converged", "same bits"]


@dataclasses.dataclass
class Judged:
    """A mesh's replays with one thread (None: not asked for) and two, and its errors."""
    one: object
    two: object
    errors: object

    def line(self, name):
        e, two, jumps = self.errors, self.two, Jumps(self.two)
        same = "-" if self.one is None else "yes" if self.one.bits() == two.bits() else "**NO**"
        det = two["min_jacobian"].min()
        return [name, f"{two['nodes'].max():.0f}", _within(100 * e.rms, ERROR, "%", 1), f"{two.peak:.3f} N",
                _within(100 * e.peak, ERROR, "%", 1, sign="+"), f"{100 * e.largest:.1f} %",
                "-" if self.one is None else f"{self.one.ms(0.5):.2f}, {self.one.ms(0.99):.1f} ms",
                f"{_within(two.ms(0.5), P50, 'ms', 2)}, {_within(two.ms(0.99), P99, 'ms', 1)}",
                f"{100 * jumps.excess:.1f} %",
                f"{det:.2f}" if det > 0 else f"**{det:.2f}**", two.bad or "", same]


def _within(value, bound, unit, digits, sign=""):
    text = f"{value:{sign}.{digits}f} {unit}"
    return text if abs(value) <= bound else f"**{text}**"


def judge(context, title, scenes, motion, truth, threads=(1, 2)):
    """{name: Judged} of {name: scene}."""
    found = {}
    for name, scene in scenes.items():
        one, two = (play(context, scene, motion, n) if n in threads else None for n in (1, 2))
        found[name] = Judged(one, two, truth.errors(two))
        e = found[name].errors
        context.progress(f"{title}, {name}: rms {100 * e.rms:.1f} %, peak {100 * e.peak:+.1f} %, "
                         f"p50 {two.ms(0.5):.2f} ms, p99 {two.ms(0.99):.1f} ms"
                         + (f", {two.bad} NOT CONVERGED" if two.bad else ""))
    return found


def tabled(found):
    return table(HEAD, [judged.line(name) for name, judged in found.items()])


def goals(title, found):
    """What was set for the shipped scene, and for the best of all meshes whatever it costs."""
    e, two = found[SHIPPED].errors, found[SHIPPED].two
    yield Goal(f"{title}, as shipped: RMS error of the force", 100 * e.rms, ERROR, "%")
    yield Goal(f"{title}, as shipped: error of the peak force", 100 * abs(e.peak), ERROR, "%")
    yield Goal(f"{title}, as shipped, two threads: p50 of a cycle", two.ms(0.5), P50, "ms")
    yield Goal(f"{title}, as shipped, two threads: p99 of a cycle", two.ms(0.99), P99, "ms")
    best = min((j.errors.rms for j in found.values()), default=math.nan)
    yield Goal(f"{title}, the best mesh: RMS error of the force", 100 * best, BEST, "%")
