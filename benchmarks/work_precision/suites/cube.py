# SPDX-License-Identifier: GPL-3.0-or-later
"""A gel cube pressed and slid over by a ball: every method, step and tolerance, cost over error."""

from accuracy.rows import Section, table

from .. import converged, norms
from ..charts import work_precision
from ..runs import Config

QUICK = True
STEPS = (0.02, 0.01, 0.005)
TOLERANCES = (1e-2, 1e-3, 1e-4)
# Methods that leave one thing to choose, the step: their tolerance is the default.
ONE_TOLERANCE = ("tled", "linear_precomputed", "implicit_direct", "implicit_async", "newton_bicgstab",
                 "auto")
# (tets, element, Poisson's ratio); the first three are one figure, the others the next.
PANELS = ((4374, "anp", 0.45), (4374, "anp", 0.49), (4374, "anp", 0.499),
          (20250, "anp", 0.45), (20250, "tet4", 0.45), (20250, "anp", 0.49))
QUICK_PANELS = ((750, "anp", 0.45),)
# Too slow on more tetrahedra than this to be part of a page that anybody can make again.
LEFT_OUT_ABOVE = {"implicit_direct": 10000, "newton_bicgstab": 2000, "linear_precomputed": 10000}


def panel_title(tets, element, poisson):
    return f"{element}, {tets} tetrahedra, nu = {poisson:g}"


def configs(context, tets, element, poisson):
    """(method, variant, Config) of a panel."""
    base = Config("cube", tets=tets, element=element, poisson_ratio=poisson)
    if context.quick:
        base = base.but(duration=0.1)
    for method in context.methods:
        if tets > LEFT_OUT_ABOVE.get(method, tets):
            continue
        # Factorisations are slow everywhere: one point says so.
        one_point = context.quick or (method == "implicit_direct" and poisson != 0.45)
        for step in (0.01,) if one_point else STEPS:
            tolerances = (1e-4,) if one_point or method in ONE_TOLERANCE else TOLERANCES
            for tolerance in tolerances:
                config = base.but(method=method, step=step, tolerance=tolerance)
                yield method, f"{1e3 * step:g} ms, {tolerance:g}", config
                if method == "implicit_pcg" and tolerance == 1e-4 and not one_point:
                    yield ("implicit_pcg bdf2", f"{1e3 * step:g} ms, {tolerance:g}",
                           config.but(integrator="bdf2"))


def sweep(context, panels):
    """{panel: [(method, variant, run, errors)]}; errors["true"]: RMS against the converged force."""
    context.prepare([next(iter(configs(context, *p)))[2] for p in panels])
    if not context.quick:
        converged.prepare(context, {("cube", poisson) for *_, poisson in panels})
    found = {}
    for panel in panels:
        found[panel] = []
        limit = None if context.quick else converged.converged(context, "cube", panel[2])
        for method, variant, config in configs(context, *panel):
            run = context.attempt(config, repeats=2, seconds=4.0)
            if run is not None:
                true = limit.errors(run)[0] if limit else float("nan")
                found[panel].append((method, variant, run, {**context.errors(run), "true": true}))
    return found


def _points(runs):
    series = {}
    for method, variant, run, errors in runs:
        step = "step " + variant.split(",")[0]
        series.setdefault(method, []).append((errors["rms"], run.second_ms, step))
    return series


def _table(panel, runs):
    front = set(norms.pareto([e["rms"] for *_, e in runs], [r.second_ms for _, _, r, _ in runs]))
    lines = []
    for i, (method, variant, run, errors) in enumerate(runs):
        mark = "**" if i in front else ""
        lines.append([f"{mark}`{method}`{mark}", variant, f"{run.second_ms:.1f}", f"{run.median_ms:.2f}",
                      run.p99_text, f"{100 * errors['rms']:.2f} %", f"{100 * errors['max']:.2f} %",
                      f"{100 * errors['true']:.1f} %", f"{100 * errors['displacement']:.2f} %", run.summary["newton_iterations"],
                      run.summary["linear_iterations"], run.summary["failed_cycles"] or ""])
    lines.sort(key=lambda line: (line[0].strip("*`"), float(line[2])))
    return f"### {panel_title(*panel)}\n\n" + table(
        ["method", "step, tolerance", "ms a simulated s", "median ms", "p99 ms", "force error, RMS",
         "largest", "RMS against the converged force", "displacement error", "Newton it.", "linear it.", "failed cycles"], lines)


def run(context):
    panels = QUICK_PANELS if context.quick else PANELS
    found = sweep(context, panels)
    figures = []
    for k in range(0, len(panels), 3):
        shown = {panel_title(*p): _points(found[p]) for p in panels[k:k + 3]}
        figures.append((work_precision(context.images, f"cube_{k // 3 + 1}.svg", shown,
                                       "ms a simulated second", "RMS force error [%]",
                                       join_variants=False),
                        "Time over error of the force, by method"))
    return Section("Pressed and slid: time over error, same mesh", TEXT, [], figures,
                   [_table(p, found[p]) for p in panels])


TEXT = """A gel cube of 100 mm (E = 5 kPa, density 1000 kg/m^3), held at its bottom, is pressed 15 mm deep
by a ball of 15 mm radius at 50 mm/s, which then slides sideways; 0.5 s. Every method that a scene can
name goes through it with steps of 20, 10 and 5 ms, and those that iterate to a tolerance with several
of them. The error is against a reference on the **same mesh**: it is what step and tolerance cost,
not what the mesh costs (that is a section below). The force error is the RMS (and the largest)
over all cycles as a part of the largest force, beside it the RMS against the converged force, in which
the mesh counts as well; the displacement error the relative L2 norm over all
nodes and every 20 ms. One thread; `backward_euler` but where `bdf2` is said. In bold: what no other
configuration beats in both. Methods that factorise or take no preconditioner are left out where a run
would last minutes (`implicit_direct` and `linear_precomputed` above 10 000 tetrahedra,
`newton_bicgstab` above 2000). `linear_precomputed` is linear and quasi-static: most of its error is
what it leaves out, not what it computes."""
