# SPDX-License-Identifier: GPL-3.0-or-later
"""How time and memory grow with the mesh."""

from accuracy.rows import Section, table

from .. import norms
from ..charts import growth
from ..runs import Config

QUICK = True
SIZES = (1080, 4860, 10368, 20250, 50400)
QUICK_SIZES = (162, 750)
# (element, method, most tetrahedra)
SERIES = (("anp", "implicit_pcg", 10 ** 9), ("tet4", "implicit_pcg", 10 ** 9),
          ("anp", "implicit_async", 10 ** 9), ("anp", "tled", 10 ** 9), ("anp", "lbfgs", 21000),
          ("anp", "implicit_direct", 11000))


def base(context, tets, element, method):
    config = Config("cube", tets=tets, element=element, poisson_ratio=0.45, method=method, step=0.01)
    return config.but(duration=0.1) if context.quick else config


def measured(context):
    """{(element, method): [run]} of the methods there are."""
    found = {}
    for element, method, most in SERIES:
        if method not in context.methods:
            continue
        for tets in QUICK_SIZES if context.quick else SIZES:
            if tets <= most:
                run = context.attempt(base(context, tets, element, method), repeats=2)
                if run is not None and not run.failed:
                    found.setdefault((element, method), []).append(run)
    return found


def run(context):
    found = measured(context)
    series = {f"{e}, {m}": [(r.summary["tets"], r.step_ms) for r in runs]
              for (e, m), runs in found.items()}
    sizes = sorted({r.summary["tets"] for runs in found.values() for r in runs})
    lines = []
    for name, values in series.items():
        cells = {r.summary["tets"]: f"{r.step_ms:.2f} ({r.p99_text}) ms, "
                                    f"{r.summary['peak_megabytes']:.0f} MB"
                 for r in found[tuple(name.split(", "))]}
        grows = f"{norms.exponent(*zip(*values)):.2f}" if len(values) > 1 else ""
        lines.append([f"`{name}`", *(cells.get(s, "") for s in sizes), grows])
    head = ["element, method", *(f"{s} tetrahedra" for s in sizes), "exponent"]
    figure = growth(context.images, "size.svg", series, "mean time of a cycle [ms]",
                    line=(10.0, "10 ms: real time"))
    return Section("Growth with the size of the mesh", TEXT, [],
                   [(figure, "Time of a cycle over tetrahedra")], [table(head, lines)])


TEXT = """The same cube with 1000 to 50 000 tetrahedra, steps of 10 ms, default tolerances, nu = 0.45, one
thread: mean time of a cycle (the p99 of 500 and more), and the largest memory that the process had. The exponent is
p of time = c tetrahedra^p, fitted in the logarithms."""
