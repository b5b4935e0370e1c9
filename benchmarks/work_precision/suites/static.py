# SPDX-License-Identifier: GPL-3.0-or-later
"""One static problem in palpate and in CalculiX: time and difference."""

import time

import numpy as np

from accuracy import ccx, meshes
from accuracy.rows import Section, table
from accuracy.solve import plane, reaction, solve

QUICK = False
EDGE, DEPTH = 0.1, 0.02  # [m]
MATERIAL = {"law": "neo_hookean", "young_modulus": 5.0e3, "poisson_ratio": 0.45}
STEPS = 4


def _patch(mesh):
    """The glued nodes: a square of half the edge in the middle of the top."""
    off = np.abs(mesh.points[:, :2] - EDGE / 2).max(axis=1)
    return np.flatnonzero((mesh.points[:, 2] > EDGE - 1e-9) & (off < EDGE / 4 + 1e-9))


def _palpate(folder, mesh, element):
    low, high = EDGE / 4 - 1e-6, 3 * EDGE / 4 + 1e-6
    box = {"box": {"min": [low, low, EDGE - 1e-6], "max": [high, high, EDGE + 1e-6]}}
    return solve(folder, mesh, element, MATERIAL,
                 [{"select": plane("z", 0.0), "displacement": [0, 0, 0]},
                  {"select": box, "displacement": [0, 0, -DEPTH]}],
                 [reaction("tool", box)], {"load_steps": STEPS, "tolerance": 1e-9})


def _calculix(folder, mesh):
    """Displacements, force on the tool [N], seconds."""
    young, poisson = MATERIAL["young_modulus"], MATERIAL["poisson_ratio"]
    law = {"law": "neo_hookean", "mu": young / (2 * (1 + poisson)),
           "kappa": young / (3 * (1 - 2 * poisson))}
    held, glued = np.flatnonzero(mesh.points[:, 2] < 1e-9), _patch(mesh)
    steps = [{**{i: np.zeros(3) for i in held},
              **{i: np.array([0, 0, -DEPTH * k / STEPS]) for i in glued}} for k in range(1, STEPS + 1)]
    begin = time.time()
    u, f = ccx.solve(folder, mesh, law, steps)
    return u, f[glued].sum(axis=0), time.time() - begin


def run(context):
    lines = []
    for n in (8, 12):
        mesh = meshes.box((EDGE,) * 3, (n,) * 3)
        mine = _palpate(context.work / "static" / f"tet4_{n}", mesh, "tet4")
        force = -mine.force("tool")[2]
        lines.append(["palpate, `tet4`", len(mesh.tets), f"{mine.seconds:.2f}", f"{force:.4f}", ""])
        anp = _palpate(context.work / "static" / f"anp_{n}", mesh, "anp")
        lines.append(["palpate, `anp`", len(mesh.tets), f"{anp.seconds:.2f}",
                      f"{-anp.force('tool')[2]:.4f}", ""])
        context.progress(f"{n}^3 cells: tet4 {mine.seconds:.2f} s, anp {anp.seconds:.2f} s")
        if ccx.available():
            u, theirs, seconds = _calculix(context.work / "static" / f"ccx_{n}", mesh)
            off = np.abs(mine.displacement - u).max() / np.abs(u).max()
            lines.append([f"{ccx.version()}, C3D4", len(mesh.tets), f"{seconds:.2f}",
                          f"{-theirs[2]:.4f}", f"{off:.1e}"])
            context.progress(f"{n}^3 cells: CalculiX {seconds:.2f} s, difference {off:.1e}")
    return Section("One static problem, and CalculiX beside it", TEXT, [], [], [table(
        ["program", "tetrahedra", "seconds", "force [N]", "largest difference of a displacement"], lines)])


TEXT = f"""The gel cube with a square of 50 mm of its top glued to a tool that goes {1e3 * DEPTH:g} mm down, in
{STEPS} load steps: neo-Hookean, E = 5 kPa, nu = 0.45, the same tetrahedra in both programs. Seconds of
the whole program with reading and writing for CalculiX, of the solve for palpate; one thread each. The
difference is against `tet4`, which is the same element as C3D4."""
