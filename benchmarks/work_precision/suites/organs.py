# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies nearer to surgery: livers as shipped and coarser, a stiff ball and a stiff layer in gel."""

from accuracy.rows import Section, table

from .. import converged
from ..charts import work_precision
from ..runs import Config

QUICK = False
SCENES = {
    "liver": Config("liver", duration=2.0),
    "liver_500": Config("liver_500", duration=2.0),
    "inclusion": Config("inclusion", tets=4374),
    "capsule": Config("capsule", tets=4374),
}
LIVER = ("liver", None, 4.0)  # whose converged force the coarser ones have too, as long as they last
STEPS = (0.02, 0.01, 0.005)


def run(context):
    context.prepare(SCENES.values())
    converged.prepare(context, [(name,) if SCENES[name].tets else LIVER for name in SCENES])
    panels, lines = {}, []
    for name, base in SCENES.items():
        panels[name] = {}
        limit = converged.converged(context, *((name,) if base.tets else LIVER))
        for method in context.methods:
            for step in STEPS:
                run = context.attempt(base.but(method=method, step=step), repeats=1)
                if run is None:
                    continue
                errors = context.errors(run)
                panels[name].setdefault(method, []).append(
                    (errors["rms"], run.second_ms, f"step {1e3 * step:g} ms"))
                lines.append([name, run.summary["nodes"], f"`{method}`", f"{1e3 * step:g} ms",
                              f"{run.second_ms:.0f}", f"{run.median_ms:.2f}", run.p99_text,
                              f"{100 * errors['rms']:.2f} %", f"{100 * errors['max']:.2f} %",
                              f"{100 * limit.errors(run)[0]:.1f} %",
                              f"{100 * errors['displacement']:.2f} %",
                              run.summary["failed_cycles"] or ""])
    half = list(panels)
    figures = [(work_precision(context.images, f"organs_{k + 1}.svg", {n: panels[n] for n in names},
                               "ms a simulated second", "RMS force error [%]"),
                "Time over error of the force: " + ", ".join(names))
               for k, names in enumerate((half[:2], half[2:]))]
    return Section("Organs and bodies of two materials", TEXT, [], figures, [table(
        ["scene", "nodes", "method", "step", "ms a simulated s", "median ms", "p99 ms",
         "force error, RMS", "largest", "RMS against the converged force", "displacement error", "failed cycles"], lines)])


TEXT = """`liver` is the shipped scene, whose mesh follows the tool, and two seconds of its recorded
palpation, `liver_500` the same with about 500 nodes, which never change; `inclusion` is the cube with a ball of 20 times the stiffness below the surface,
`capsule` the cube with a layer of 20 times the stiffness all around. Default tolerances, one thread,
errors against a reference on the same mesh, and of the force against the converged one, in which the
mesh counts as well. Methods that refuse a scene (`linear_precomputed` knows no
damping) are not in its part of the table."""
