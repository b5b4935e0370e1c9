# SPDX-License-Identifier: GPL-3.0-or-later
"""Euler's elastica: a slender bar bent far beyond linear theory by a dead load at its end."""

import numpy as np

from .. import bounds, meshes
from ..plots import COLOUR, figure, save
from ..report import rows_table
from ..rows import Row, Section, balance
from ..solve import plane, reaction, solve

CASE = "elastica"
LENGTH, HEIGHT, YOUNG = 0.4, 0.01, 1.0e6  # [m], [m], [Pa]
# P L^2/(E I): tip deflection w/L across and u/L along the bar [elliptic integrals].
REFERENCE = {0.5: (0.162144, 0.015919), 1: (0.301721, 0.056433), 2: (0.493457, 0.160642),
             5: (0.713792, 0.387628), 10: (0.810609, 0.554996)}
SOURCE = "elliptic integrals [Bisshopp and Drucker 1945]"
MESHES = {"tet10": ((2, 2, 10), (2, 2, 20), (2, 2, 40)), "anp": ((4, 4, 160),)}
QUICK_MESHES = {"tet10": ((2, 2, 20),)}
ORDER = 2  # in the energy norm, of quadratic elements
# The same bar of nearly incompressible rubber, four cells across: what an element that bends must reach.
RUBBER, RUBBER_LOAD = (0.45, 0.499), 1
RUBBER_MESHES = {"tet10p": (2, 2, 40), "tet10": (2, 2, 40), "anp": (4, 4, 160), "tet4": (4, 4, 160)}
RUBBER_BOUND = {"tet10p": 0.03}


def theory(load):
    """What the elastica leaves out, as a part of the deflection: the shear, of 3 E I/(k G A L^2) with k = 5/6
    and E = 2 G [Timoshenko 1921], and the square of the largest strain, P L^2/(E I) h/(2 L) at most, for
    Hooke's law in the Green strain is not that of a beam beyond the first order."""
    shear = 0.6 * (HEIGHT / LENGTH) ** 2
    return shear + (load * HEIGHT / (2 * LENGTH)) ** 2


def bend(folder, element, cells, load, law="st_venant_kirchhoff", poisson=0.0):
    force = load * YOUNG * HEIGHT ** 4 / 12 / LENGTH ** 2
    mesh = meshes.box((HEIGHT, HEIGHT, LENGTH), cells).for_element(element)
    result = solve(folder, mesh, element,
                   {"law": law, "young_modulus": YOUNG, "poisson_ratio": poisson},
                   [{"select": plane("z", 0.0), "displacement": [0, 0, 0]},
                    {"select": plane("z", LENGTH), "traction": [force / HEIGHT ** 2, 0, 0]}],
                   [reaction("wall", plane("z", 0.0))],
                   {"load_steps": max(4, round(2 * load)), "tolerance": 1e-8})
    return result.at([HEIGHT / 2, HEIGHT / 2, LENGTH]) / LENGTH, force, result


def run(context):
    rows, shown, found = [], [], {}
    for element, sizes in (QUICK_MESHES if context.quick else MESHES).items():
        for cells in sizes:
            for load, (across, along) in REFERENCE.items():
                tip, force, result = bend(context.folder(CASE, f"{element}_{cells[2]}_{load}"), element, cells, load)
                mesh = f"{cells[0]} x {cells[1]} x {cells[2]} cells, {result.mesh.size()}"
                found.setdefault((element, load), []).append((tip[0], -tip[2]))
                limits = [None, None]
                if element == "tet10" and len(found[element, load]) > 2:
                    # u grows with the square of w, and so twice as much of it.
                    limits = [bounds.refined([1 / c[2] for c in sizes], values, exact, ORDER) + times * theory(load)
                              for values, exact, times in zip(zip(*found[element, load]), (across, along), (1, 2))]
                w = Row(CASE, mesh, element, f"w/L at P L^2/(E I) = {load:g}", tip[0], across, SOURCE, limits[0])
                u = Row(CASE, mesh, element, f"u/L at P L^2/(E I) = {load:g}", -tip[2], along, SOURCE, limits[1])
                shown += [w, u]
                rows += [w, u, balance(CASE, mesh, element, result.force("wall"), [force, 0, 0])]
                context.progress(f"{element} {cells} load {load}: {100 * w.error:+.2f} {100 * u.error:+.2f} %, "
                                 f"{result.json['newton_iterations']} its, {result.seconds:.1f} s")
    figures, tables = ([], []) if context.quick else ([_plot(context, shown)], [_rubber(context, rows)])
    return Section("Elastica", TEXT, rows, figures, [rows_table(shown), *tables])


def _rubber(context, rows):
    """Nodes lie four apart across the bar for each element; adds to `rows`."""
    shown = []
    for element, cells in RUBBER_MESHES.items():
        for poisson in RUBBER:
            tip, force, result = bend(context.folder(CASE, f"rubber_{element}_{poisson}"), element, cells, RUBBER_LOAD,
                                      "neo_hookean", poisson)
            mesh = f"{cells[0]} x {cells[1]} x {cells[2]} cells, {result.mesh.size()}"
            shown.append(Row(CASE, mesh, element, f"w/L of rubber, nu = {poisson:g}", tip[0], REFERENCE[RUBBER_LOAD][0],
                             SOURCE, RUBBER_BOUND.get(element)))
            rows.append(balance(CASE, mesh, element, result.force("wall"), [force, 0, 0]))
            context.progress(f"rubber {element} nu {poisson}: {100 * shown[-1].error:+.2f} %, {result.seconds:.1f} s")
    rows += shown
    return rows_table(shown)


TEXT = (f"A bar, {1e3 * LENGTH:g} mm long, {1e3 * HEIGHT:g} mm square, is clamped at one end and bent by a "
        "force P at the other that keeps its direction. The theory has neither shear nor stretch, which "
        "in this bar change the deflection by about 0.05 %; Poisson's ratio is 0, so that the clamp does "
        "not stiffen it. Hooke's law in the Green strain (`st_venant_kirchhoff`). The wall's force "
        "balances P in every run (bound 1e-6). Linear tetrahedra without or with averaged pressure bend "
        "poorly: `anp` is shown for comparison. Below, the bar is of nearly incompressible rubber (`neo_hookean`, "
        f"P L^2/(E I) = {RUBBER_LOAD}), with four nodes' distances across it for every element: `tet10p` is asked for "
        "3 %. The clamp now keeps the bar's sides from contracting, over about its width, a fortieth of the length.")


def _plot(context, rows):
    fig, axis = figure()
    loads = list(REFERENCE)
    for k, name in ((0, "w/L"), (1, "u/L")):
        axis.plot(loads, [REFERENCE[p][k] for p in loads], color=COLOUR["reference"], linestyle="-" if k else "--",
                  label=f"{name}, exact")
    for element, sizes in MESHES.items():
        finest = "{} x {} x {} cells".format(*sizes[-1])
        for name in ("w/L", "u/L"):
            values = [r.value for r in rows if r.element == element and r.mesh.startswith(finest)
                      and r.quantity.startswith(name)]
            axis.plot(loads, values, "o" if element == "tet10" else "x", color=COLOUR[element],
                      label=element if name == "w/L" else None)
    axis.set(xlabel="P L^2/(E I)", ylabel="deflection of the tip / length")
    axis.legend()
    return save(fig, context.images, "elastica.svg"), "Deflection of the tip over the load"
