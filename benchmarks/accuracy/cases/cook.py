# SPDX-License-Identifier: GPL-3.0-or-later
"""Cook's membrane in three dimensions: a tapered panel, clamped on the left, sheared on the right."""

import numpy as np

from .. import bounds, meshes, taylor_hood
from ..plots import COLOUR, figure, save
from ..report import rows_table
from ..rows import Row, Section, balance
from ..solve import plane, reaction, solve

CASE = "Cook"
NEEDS = (taylor_hood,)
WIDTH, LEFT, RISE, RIGHT, THICKNESS = 0.048, 0.044, 0.044, 0.016, 0.010  # [m]
MU, TRACTION = 80.194e6, 6.25e6  # [Pa]
LOAD = TRACTION * RIGHT * THICKNESS  # [N]
POISSON = (0.45, 0.49, 0.499)
THEIRS = (8, 12)  # hexahedra along the panel and up the wall, a quarter of that over half the thickness
SOURCE = "dolfinx 0.5.2, quadratic hexahedra with linear pressure, {0} x {0} x {1}, extrapolated, +-{2:.2f} mm"
# Bounded: what refining further may still change, by first order, and what is unknown of the reference.
# Where the wall ends stresses are infinite, and the energy of any element, and with it the work of the
# load, converges by hardly more than first order. `tet4` locks before that.
ORDER, BOUNDED = 1, ("anp", "tet10", "tet10p")
MESHES = {"tet4": (8, 16), "anp": (4, 8, 16), "p1p1": (8, 12), "tet10": (2, 4, 8),
          "tet10p": (2, 4, 8)}
QUICK_MESHES = {"tet10": (4,), "anp": (8,), "tet10p": (4,)}


def bulk(poisson):
    return 2 * MU * (1 + poisson) / (3 * (1 - 2 * poisson))


def reference(context, poisson):
    """Rise of the corner [mm] of half a panel of hexahedra, finer where the wall ends, and what is unknown of
    it: where these stresses are infinite its order is between one and two, and it is taken for the middle of
    what the two make of it."""
    rise = []
    for n in THEIRS:
        cells = [n, n, round(n / 4)]
        answer = taylor_hood.solve(
            context.folder(CASE, f"dolfinx_{n}_{poisson}.json"), size=[WIDTH, 1, 1], cells=cells, axis=0, steps=8,
            law={"law": "neo_hookean", "mu": MU, "kappa": bulk(poisson)}, pressure=TRACTION,
            point=[WIDTH, RISE + RIGHT, THICKNESS / 2],
            panel={"width": WIDTH, "left": LEFT, "rise": RISE, "right": RIGHT, "thickness": THICKNESS})
        rise.append(1e3 * answer["displacement"][1])
        context.progress(f"dolfinx {n} nu {poisson}: {rise[-1]:.4f} mm")
    ratio = THEIRS[1] / THEIRS[0]
    ends = [rise[1] + (rise[1] - rise[0]) / (ratio ** order - 1) for order in (1, 2)]
    return (ends[0] + ends[1]) / 2, abs(ends[0] - ends[1]) / 2


def panel(n):
    """n x n cells and 0.4 n over the thickness."""
    mesh = meshes.box((1, 1, THICKNESS), (n, n, round(0.4 * n)))

    def taper(p):
        x, y = p[:, 0] * WIDTH, p[:, 1]
        return np.stack([x, RISE * p[:, 0] + y * (LEFT + (RIGHT - LEFT) * p[:, 0]), p[:, 2]], 1)
    return mesh.mapped(taper)


def shear(folder, element, n, poisson):
    return solve(folder, panel(n).for_element(element), element,
                 {"law": "neo_hookean", "mu": MU, "kappa": bulk(poisson)},
                 [{"select": plane("x", 0.0), "displacement": [0, 0, 0]},
                  {"select": plane("x", WIDTH), "traction": [0, TRACTION, 0]}],
                 [{"name": "tip", "point": [WIDTH, RISE + RIGHT, THICKNESS / 2]},
                  reaction("wall", plane("x", 0.0))], {"load_steps": 4})


def run(context):
    rows, shown, tip = [], [], {}
    limits = {poisson: reference(context, poisson) for poisson in POISSON}
    for element, sizes in (QUICK_MESHES if context.quick else MESHES).items():
        for n in sizes:
            for poisson, (limit, unknown) in limits.items():
                result = shear(context.folder(CASE, f"{element}_{n}_{poisson}"), element, n, poisson)
                mesh = f"{n} x {n} x {round(0.4 * n)} cells, {result.mesh.size()}"
                u = 1e3 * result.json["probes"]["tip"]["displacement"][1]
                tip[element, n, poisson] = u
                bound = None
                if element in BOUNDED and n == MESHES[element][-1]:
                    found = [tip[element, k, poisson] for k in sizes]
                    bound = bounds.refined([1 / k for k in sizes], found, limit, ORDER) + unknown / limit
                source = SOURCE.format(THEIRS[-1], round(THEIRS[-1] / 4), unknown)
                shown.append(Row(CASE, mesh, element, f"rise of the corner, nu = {poisson:g} [mm]", u, limit,
                                 source, bound))
                rows.append(shown[-1])
                rows.append(balance(CASE, mesh, element, result.force("wall"), [0, LOAD, 0]))
                context.progress(f"{element} {n} nu {poisson}: {u:.3f} mm, {result.seconds:.1f} s")
    figures = [] if context.quick else [_plot(context, tip, limits)]
    return Section("Cook's membrane", TEXT, rows, figures, [rows_table(shown)])


TEXT = ("A panel, 48 mm long, 44 mm high at the wall and 16 mm at its free end, 10 mm thick, "
        "neo-Hookean with mu = 80.194 MPa, is sheared by 1000 N at the free end. The rise of its upper "
        "corner tells whether an element locks in bending and in volume at once: the classical trial "
        "of elements for near-incompressible bodies [Cook 1974; here in three dimensions and with "
        "finite strain]. The wall's force balances the 1000 N in every run (bound 1e-6).")


def _plot(context, tip, limits):
    fig, axes = figure(len(limits), width=9.0, height=3.2, sharey=True)
    for axis, (poisson, (limit, _)) in zip(axes, limits.items()):
        axis.axhline(limit, color=COLOUR["reference"], linestyle="--", label="dolfinx")
        for element, sizes in MESHES.items():
            points = [2 * n if meshes.is_quadratic(element) else n for n in sizes]
            axis.plot(points, [tip[element, n, poisson] for n in sizes], "o-", label=element,
                      color=COLOUR[element])
        axis.set(title=f"nu = {poisson:g}", xlabel="node distances along the wall", ylim=(0, None))
    axes[0].set_ylabel("rise of the corner [mm]")
    axes[0].legend()
    return save(fig, context.images, "cook.svg"), "Rise of the corner over the fineness of the mesh"
