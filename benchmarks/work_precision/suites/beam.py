# SPDX-License-Identifier: GPL-3.0-or-later
"""A thrown beam, one linear solve a step, beside Bullet on the same tetrahedra."""

import math
import shutil
import subprocess

from accuracy.rows import Section, table
from accuracy.solve import Failed, build_folder

from .. import norms
from ..runs import P99_CYCLES, Config, Run

QUICK = True
SIZES = (3000, 24000)
BASE = Config("beam", duration=0.5, step=0.01)
# One linear solve a step, as game engines do.
ONE_SOLVE = {"max_newton": 1, "tolerance": 1e-12, "linear_tolerance": 1e-6}
BULLET = {"neo-Hookean, one solve": ("force=neo_hookean", "cg=1000", "tolerance=1e-6"),
          "neo-Hookean, 20 iterations at most": ("force=neo_hookean", "cg=20", "tolerance=1e-6"),
          "corotated, one solve": ("force=linear", "cg=1000", "tolerance=1e-6")}


def bullet_program():
    """The built program, or None: without Bullet there is none."""
    found = [p for p in build_folder().rglob("palpate_bullet") if p.is_file()]
    return found[0] if found else None


def _bullet(context, mesh, name, settings):
    folder = context.work / "bullet" / f"{mesh.parent.name}_{name}".replace(" ", "_").replace(",", "")
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    repeats = 1 if context.quick else math.ceil(P99_CYCLES * BASE.step / BASE.duration)
    words = [*settings, f"duration={BASE.duration}", f"step={BASE.step}", f"repeat={repeats}"]
    done = subprocess.run([str(bullet_program()), str(mesh), str(folder), *words],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        raise Failed(f"palpate_bullet {mesh}: {done.stdout.strip()[-300:]}")
    run = Run(None, folder)
    context.progress(f"Bullet, {name}: {run.median_ms:.3g} ms")
    return run


def _line(name, run, error):
    linear = run.summary["linear_iterations"]
    return [name, run.summary["tets"], f"{run.median_ms:.2f}", run.p99_text, f"{100 * error:.2f} %",
            linear, f"{linear / run.summary['cycles']:.1f}"]


def run(context):
    lines = []
    for tets in (192,) if context.quick else SIZES:
        context.prepare([BASE.but(tets=tets, element=e) for e in ("tet4", "anp")])
        for element in ("tet4", "anp"):
            base = BASE.but(tets=tets, element=element)
            for method in context.methods:
                for how, settings in (("one solve", ONE_SOLVE), ("default tolerances", {})):
                    if how == "one solve" and not method.startswith("implicit"):
                        continue
                    if method in ("implicit_direct", "newton_bicgstab") and tets > 10000:
                        continue
                    run = context.attempt(base.but(method=method, **settings), repeats=2)
                    if run is not None:
                        lines.append(_line(f"`{element}`, `{method}`, {how}", run,
                                           context.errors(run)["displacement"]))
        if bullet_program():
            reference = context.reference(BASE.but(tets=tets, element="tet4"))
            for name, settings in BULLET.items():
                theirs = _bullet(context, reference.folder / "mesh.vtu", name, settings)
                error = norms.displacement_error(*theirs.frames(), *reference.frames())
                lines.append(_line(f"Bullet, {name}", theirs, error))
    text = TEXT if bullet_program() else TEXT + " (Bullet was not installed for this run.)"
    return Section("A thrown beam, and Bullet beside it", text, [], [], [table(
        ["program", "tetrahedra", "median ms a step", "p99 ms", "displacement error",
         "linear iterations", "of them a step"], lines)])


TEXT = """A beam of 100 x 100 x 400 mm (E = 5 kPa, nu = 0.45, density 1000 kg/m^3), held at one end, starts
sideways at 0.15 m/s and swings for 0.5 s in steps of 10 ms. "One solve" is one Newton iteration with
one linear solve a step, whatever is left over, until the residual is 1e-6 of that at its start, each
program in the norm that its conjugate gradients watch. Bullet 3.24's deformable bodies get the same
tetrahedra, masses, supports and start: its stable neo-Hookean energy with the constants that are
Hooke's at small strain, and its corotated one; its elements are plain linear tetrahedra in single
precision, its preconditioner is the masses. Errors are against palpate's reference on the same mesh (for Bullet that of `tet4`): most of
it is the first-order time step that all of them share."""
