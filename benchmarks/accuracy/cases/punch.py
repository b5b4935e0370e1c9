# SPDX-License-Identifier: GPL-3.0-or-later
"""A flat, frictionless punch on a half space."""

import numpy as np

from .. import bounds, meshes
from ..plots import COLOUR, figure, save
from ..report import rows_table
from ..rows import BALANCE, Row, Section
from ..solve import plane, reaction, solve

CASE = "flat punch"
RADIUS, DEPTH, YOUNG = 0.01, 0.001, 5.0e3  # [m], [m], [Pa]
SIZE = 1.0  # [m], of the block that stands for the half space
SOURCE = "closed form F = 2 E a d/(1 - nu^2) [Sneddon 1965]"
POISSON = (0.45, 0.49, 0.4999)
FINEST = {"anp": 32, "tet10": 8, "tet10p": 8, "tet4": 32}  # parts of the radius at the punch's edge
COARSER = {"anp": (2, 1, 0), "tet10": (2, 1, 0), "tet10p": (2, 1, 0), "tet4": (0,)}  # how often all elements are larger by RATIO
QUICK_COARSER = {"anp": (2,)}
RATIO = 1.5
# Bounded, for the law `linear`: what refining all elements may still change, by first order, for the stress is
# infinite as the inverse root of the distance at the punch's edge; and that the block is held, not infinite.
ORDER, BOUNDED = 1, ("anp", "tet10", "tet10p")


def force(poisson):
    return 2 * YOUNG * RADIUS * DEPTH / (1 - poisson ** 2)


# Sectors of the quarter, and growth of the elements inwards, outwards and downwards.
FINE, COARSE = (18, 1.22, 1.5, 1.2), (12, 1.4, 1.6, 1.5)
GRADING = {"anp": FINE, "tet4": FINE, "tet10": COARSE, "tet10p": COARSE}


def block(n, grading, coarser):
    """A quarter of a cylinder with its top at z = 0; elements of RADIUS/n at the punch's edge, which
    grow away from it. `coarser` times all elements are larger by RATIO."""
    larger = RATIO ** coarser
    sectors = round(grading[0] / larger)
    inwards, outwards, down = (growth ** larger for growth in grading[1:])
    first = RADIUS / n * larger
    inner = RADIUS - meshes.graded(first, RADIUS, inwards)[::-1]
    outer = RADIUS + meshes.graded(first, SIZE - RADIUS, outwards)
    radii = np.concatenate([inner[1:], outer[1:]])
    counts = [min(2 * (k + 1), sectors) for k in range(len(radii))]
    points, triangles = meshes.disc(radii, counts, quarter=True)
    return meshes.prisms(points, triangles, -meshes.graded(first, SIZE, down)[::-1])


def press(folder, element, coarser, material):
    n = FINEST[element] / RATIO ** coarser
    mesh = block(FINEST[element], GRADING[element], coarser).for_element(element)
    far = 50.0  # [m]; a ball this large, dipped into the top, selects a disc
    disc = {"sphere": {"center": [0, 0, far], "radius": float(np.hypot(far, RADIUS * (1 + 1e-7)))}}
    rim = RADIUS / n / 2
    selected = np.linalg.norm(mesh.points - [0, 0, far], axis=1) <= disc["sphere"]["radius"]
    assert mesh.points[selected, 2].min() == 0.0, "the ball selects nodes inside the block"
    assert np.hypot(*mesh.points[selected, :2].T).max() > RADIUS - rim, "the rim is not selected"
    return solve(folder, mesh, element, material,
                 [{"select": plane("z", -SIZE), "displacement": [0, 0, 0]},
                  {"select": plane("x", 0.0, 1e-12), "displacement": [0, None, None]},
                  {"select": plane("y", 0.0, 1e-12), "displacement": [None, 0, None]},
                  {"select": disc, "displacement": [None, None, -DEPTH]}],
                 [reaction("punch", disc), reaction("ground", plane("z", -SIZE))],
                 {"load_steps": 1, "tolerance": 1e-8})


def run(context):
    rows, shown, found = [], [], {}
    for element, levels in (QUICK_COARSER if context.quick else COARSER).items():
        for coarser in levels:
            for law in ("linear", "neo_hookean"):
                for poisson in POISSON:
                    name = f"{element}_{coarser}_{poisson}_{law}"
                    result = press(context.folder(CASE, name), element, coarser,
                                   {"law": law, "young_modulus": YOUNG, "poisson_ratio": poisson})
                    # The quarter's share; forces of the planes of symmetry lie in them.
                    f = -4 * result.force("punch")[2]
                    gap = abs(result.force("punch")[2] + result.force("ground")[2]) / (f / 4)
                    mesh = f"edge a/{FINEST[element] / RATIO ** coarser:.3g}, {result.mesh.size()}"
                    values = found.setdefault((element, law, poisson), [])
                    values.append(f)
                    bound = _bound(levels, values, poisson) if (
                        coarser == 0 and law == "linear" and element in BOUNDED) else None
                    row = Row(CASE, mesh, element, f"force, {law}, nu = {poisson:g} [N]", f, force(poisson),
                              SOURCE, bound)
                    shown.append(row)
                    rows += [row, Row(CASE, mesh, element, f"punch + ground / punch, {law}, nu = {poisson:g}",
                                      gap, 0.0, "equilibrium", BALANCE, gap)]
                    context.progress(f"{name}: {100 * row.error:+.2f} %, {result.seconds:.1f} s")
    return Section("A flat punch on a half space", TEXT, rows, [], [rows_table(shown)])


def _bound(levels, values, poisson):
    exact = force(poisson)
    return (bounds.refined([RATIO ** k for k in levels], values, exact, ORDER)
            + bounds.held(exact, YOUNG, poisson, SIZE, DEPTH))


TEXT = (f"A rigid, frictionless disc of radius a = {1e3 * RADIUS:g} mm is pressed d = {1e3 * DEPTH:g} mm into "
        f"a half space with E = {YOUNG / 1e3:g} kPa. The half space is a quarter of a cylinder, "
        f"{SIZE:g} m in radius and depth, with elements that grow from the punch's edge, where the stress "
        "is infinite. The closed form is that of small strains: the bound applies to the law `linear`. "
        "`neo_hookean` shows what finite strain makes of it at this depth.")
