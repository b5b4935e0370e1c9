# SPDX-License-Identifier: GPL-3.0-or-later
"""Cook's membrane in three dimensions: a tapered panel, clamped on the left, sheared on the right."""

import numpy as np

from .. import meshes
from ..plots import COLOUR, figure, save
from ..report import rows_table
from ..rows import Row, Section, balance
from ..solve import plane, reaction, solve

CASE = "Cook"
WIDTH, LEFT, RISE, RIGHT, THICKNESS = 0.048, 0.044, 0.044, 0.016, 0.010  # [m]
MU, TRACTION = 80.194e6, 6.25e6  # [Pa]
LOAD = TRACTION * RIGHT * THICKNESS  # [N]
REFERENCE = {0.45: 8.50, 0.49: 8.36, 0.499: 8.33}  # [mm]
SOURCE = ("refinement of mean-dilatation hexahedra (up to 32 x 32 x 13) and quadratic tetrahedra, "
          "extrapolated, +-0.04 mm")
BOUND = {("anp", 16): 0.10, ("tet10", 8): 0.06}
MESHES = {"tet4": (8, 16), "anp": (8, 16), "p1p1": (8, 12), "tet10": (4, 8)}
QUICK_MESHES = {"tet10": (4,), "anp": (8,)}


def panel(n):
    """n x n cells and 0.4 n over the thickness."""
    mesh = meshes.box((1, 1, THICKNESS), (n, n, round(0.4 * n)))

    def taper(p):
        x, y = p[:, 0] * WIDTH, p[:, 1]
        return np.stack([x, RISE * p[:, 0] + y * (LEFT + (RIGHT - LEFT) * p[:, 0]), p[:, 2]], 1)
    return mesh.mapped(taper)


def shear(folder, element, n, poisson):
    kappa = 2 * MU * (1 + poisson) / (3 * (1 - 2 * poisson))
    return solve(folder, panel(n).for_element(element), element,
                 {"law": "neo_hookean", "mu": MU, "kappa": kappa},
                 [{"select": plane("x", 0.0), "displacement": [0, 0, 0]},
                  {"select": plane("x", WIDTH), "traction": [0, TRACTION, 0]}],
                 [{"name": "tip", "point": [WIDTH, RISE + RIGHT, THICKNESS / 2]},
                  reaction("wall", plane("x", 0.0))], {"load_steps": 4})


def run(context):
    rows, tip = [], {}
    for element, sizes in (QUICK_MESHES if context.quick else MESHES).items():
        for n in sizes:
            for poisson, reference in REFERENCE.items():
                result = shear(context.folder(CASE, f"{element}_{n}_{poisson}"), element, n, poisson)
                mesh = f"{n} x {n} x {round(0.4 * n)} cells, {result.mesh.size()}"
                u = 1e3 * result.json["probes"]["tip"]["displacement"][1]
                tip[element, n, poisson] = u
                rows.append(Row(CASE, mesh, element, f"rise of the corner, nu = {poisson:g} [mm]", u,
                                reference, SOURCE, BOUND.get((element, n))))
                rows.append(balance(CASE, mesh, element, result.force("wall"), [0, LOAD, 0]))
                context.progress(f"{element} {n} nu {poisson}: {u:.3f} mm, {result.seconds:.1f} s")
    figures = [] if context.quick else [_plot(context, tip)]
    shown = [r for r in rows if r.source == SOURCE]
    return Section("Cook's membrane", TEXT, rows, figures, [rows_table(shown)])


TEXT = ("A panel, 48 mm long, 44 mm high at the wall and 16 mm at its free end, 10 mm thick, "
        "neo-Hookean with mu = 80.194 MPa, is sheared by 1000 N at the free end. The rise of its upper "
        "corner tells whether an element locks in bending and in volume at once: the classical trial "
        "of elements for near-incompressible bodies [Cook 1974; here in three dimensions and with "
        "finite strain]. The wall's force balances the 1000 N in every run (bound 1e-6).")


def _plot(context, tip):
    fig, axes = figure(len(REFERENCE), width=9.0, height=3.2, sharey=True)
    for axis, (poisson, reference) in zip(axes, REFERENCE.items()):
        axis.axhline(reference, color=COLOUR["reference"], linestyle="--", label="converged")
        for element, sizes in MESHES.items():
            points = [n if element != "tet10" else 2 * n for n in sizes]
            axis.plot(points, [tip[element, n, poisson] for n in sizes], "o-", label=element,
                      color=COLOUR[element])
        axis.set(title=f"nu = {poisson:g}", xlabel="node distances along the wall", ylim=(0, None))
    axes[0].set_ylabel("rise of the corner [mm]")
    axes[0].legend()
    return save(fig, context.images, "cook.svg"), "Rise of the corner over the fineness of the mesh"
