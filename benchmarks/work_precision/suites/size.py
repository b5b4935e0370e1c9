# SPDX-License-Identifier: GPL-3.0-or-later
"""How time and memory grow with the mesh."""

from accuracy.rows import Section, table

from .. import norms
from ..charts import growth
from ..runs import Config

QUICK = True
SIZES = (1080, 4860, 10368, 20250, 50400)
QUICK_SIZES = (162, 750)
# (element, method, Poisson's ratio, most tetrahedra)
SERIES = (("anp", "implicit_pcg", 0.45, 10 ** 9), ("anp", "implicit_pcg", 0.499, 10 ** 9),
          ("tet4", "implicit_pcg", 0.45, 10 ** 9), ("anp", "implicit_async", 0.45, 10 ** 9),
          ("anp", "tled", 0.45, 10 ** 9), ("anp", "lbfgs", 0.45, 21000),
          ("anp", "implicit_direct", 0.45, 11000))


def base(context, tets, element, method, poisson_ratio):
    config = Config("cube", tets=tets, element=element, poisson_ratio=poisson_ratio, method=method, step=0.01)
    return config.but(duration=0.1) if context.quick else config


def measured(context):
    """{(element, method, Poisson's ratio): [run]} of the methods there are."""
    found = {}
    for element, method, poisson_ratio, most in SERIES:
        if method not in context.methods:
            continue
        for tets in QUICK_SIZES if context.quick else SIZES:
            if tets <= most:
                run = context.attempt(base(context, tets, element, method, poisson_ratio), repeats=2)
                if run is not None and not run.failed:
                    found.setdefault((element, method, poisson_ratio), []).append(run)
    return found


def run(context):
    found = measured(context)
    name = "{}, {}, nu = {}".format
    series = {name(*key): [(r.summary["tets"], r.step_ms) for r in runs] for key, runs in found.items()}
    sizes = sorted({r.summary["tets"] for runs in found.values() for r in runs})
    lines = []
    for key, values in zip(found, series.values()):
        cells = {r.summary["tets"]: f"{r.step_ms:.2f} ({r.p99_text}) ms, "
                                    f"{r.summary['peak_megabytes']:.0f} MB"
                 for r in found[key]}
        grows = f"{norms.exponent(*zip(*values)):.2f}" if len(values) > 1 else ""
        lines.append([f"`{key[0]}`, `{key[1]}`, {key[2]}", *(cells.get(s, "") for s in sizes), grows])
    head = ["element, method, nu", *(f"{s} tetrahedra" for s in sizes), "exponent"]
    figure = growth(context.images, "size.svg", series, "mean time of a cycle [ms]",
                    line=(10.0, "10 ms: real time"))
    return Section("Growth with the size of the mesh", TEXT, [],
                   [(figure, "Time of a cycle over tetrahedra")], [table(head, lines)])


TEXT = """The same cube with 1000 to 50 000 tetrahedra, steps of 10 ms, default tolerances, one
thread: mean time of a cycle (the p99 of 500 and more), and the largest memory that the process had. The exponent is
p of time = c tetrahedra^p, fitted in the logarithms."""
