# SPDX-License-Identifier: GPL-3.0-or-later
"""A nearly incompressible block in palpate and, with quite another element, in FEniCS' dolfinx."""

import numpy as np

from .. import bounds, meshes, taylor_hood
from ..plots import COLOUR, figure, save
from ..report import rows_table
from ..rows import Row, Section, balance
from ..solve import plane, reaction, solve

CASE = "dolfinx"
NEEDS = (taylor_hood,)
WIDTH, LENGTH = 0.04, 0.12  # [m]
TURN, PULL = np.pi / 2, 0.024  # [rad], [m]
YOUNG, POISSON = 5.0e3, 0.499  # [Pa]
MU, KAPPA = YOUNG / (2 * (1 + POISSON)), YOUNG / (3 * (1 - 2 * POISSON))
SOURCE = "dolfinx 0.5.2, Taylor-Hood elements, {0} x {0} x {1} cells"
THEIRS = (2, 4, 6)
MESHES = {"anp": (6, 9, 12), "tet10": (3, 4, 5), "tet10p": (3, 4, 5)}
# Bounded: what refining may still change here and there, by first order. Where a held face meets a free one
# stresses are infinite, and the energy of any element converges by order 1.2 (nearly incompressible, a right
# angle [Williams 1952]).
ORDER = 1


def _about_axis(force, moment):
    """Moment about the bar's axis, from that about the origin."""
    return moment[2] - WIDTH / 2 * (force[1] - force[0])


def ours(folder, element, n):
    """(pull [N], moment [N m]) and the result."""
    mesh = meshes.box((WIDTH, WIDTH, LENGTH), (n, n, 3 * n)).for_element(element)
    far = plane("z", LENGTH)
    result = solve(folder, mesh, element, {"law": "neo_hookean", "mu": MU, "kappa": KAPPA},
                   [{"select": plane("z", 0.0), "displacement": [0, 0, 0]},
                    {"select": far, "displacement": [0, 0, PULL],
                     "rotation": {"axis": [0, 0, 1], "angle": TURN, "origin": [WIDTH / 2, WIDTH / 2, 0]}}],
                   [reaction("tool", far), reaction("table", plane("z", 0.0))], {"load_steps": 6})
    force = result.force("tool")
    return (force[2], _about_axis(force, result.moment("tool"))), result


def dolfinx(file, n):
    answer = taylor_hood.solve(file, size=[WIDTH, WIDTH, LENGTH], cells=[n, n, 3 * n],
                               law={"law": "neo_hookean", "mu": MU, "kappa": KAPPA}, axis=2, angle=TURN,
                               origin=[WIDTH / 2, WIDTH / 2, 0], displacement=[0, 0, PULL], steps=4)
    return answer["force"][2], _about_axis(answer["force"], answer["moment"])


def _bound(sizes, ours_found, theirs_found):
    """Of our error and theirs together."""
    scale = theirs_found[-1]
    return (bounds.refined([1 / n for n in sizes], ours_found, scale, ORDER)
            + bounds.refined([1 / n for n in THEIRS], theirs_found, scale, ORDER))


def run(context):
    theirs = {}
    for n in THEIRS:
        theirs[n] = dolfinx(context.folder(CASE, f"dolfinx_{n}.json"), n)
        context.progress(f"dolfinx {n}: force {theirs[n][0]:.6f} N, moment {theirs[n][1]:.8f} N m")
    reference, source = theirs[THEIRS[-1]], SOURCE.format(THEIRS[-1], 3 * THEIRS[-1])
    names = ("force along the axis [N]", "moment about the axis [N m]")
    shown = [Row(CASE, "dolfinx, {0} x {0} x {1} cells".format(n, 3 * n), "", names[k], theirs[n][k], reference[k],
                 source) for n in THEIRS[:-1] for k in range(2)]
    rows, values = [], {}
    for element, sizes in MESHES.items():
        for n in sizes:
            values[element, n], result = ours(context.folder(CASE, f"{element}_{n}"), element, n)
            size = f"{n} x {n} x {3 * n} cells, {result.mesh.size()}"
            pair = [Row(CASE, size, element, names[k], values[element, n][k], reference[k], source,
                        _bound(sizes, [values[element, m][k] for m in sizes], [theirs[m][k] for m in THEIRS])
                        if n == sizes[-1] else None) for k in range(2)]
            shown += pair
            rows.append(balance(CASE, size, element, result.force("table"), result.force("tool")))
            context.progress(f"{element} {n}: force {100 * pair[0].error:+.2f} %, moment "
                             f"{100 * pair[1].error:+.2f} %, {result.seconds:.1f} s")
    return Section("A second opinion from dolfinx", TEXT, shown + rows,
                   [_plot(context, values, theirs)], [rows_table(shown)])


TEXT = (f"A gel bar of {1e3 * WIDTH:g} x {1e3 * WIDTH:g} x {1e3 * LENGTH:g} mm, neo-Hookean, E = {YOUNG / 1e3:g} "
        f"kPa, nu = {POISSON:g}, is held at one end; the other is glued to a tool that turns by 90 degrees and "
        f"pulls {1e3 * PULL:g} mm. dolfinx solves the same problem with Taylor-Hood elements (quadratic "
        "displacements, linear pressure), which share nothing with palpate's: no code, no element, no "
        "treatment of volume. The moment about the axis converges more slowly than the force along it. The "
        "bounds are what refining may still change in both programs, by first order. Both ends' forces balance "
        "in every run (bound 1e-6).")


def _plot(context, values, theirs):
    fig, axes = figure(2, width=8.0, height=3.2)
    for k, (axis, name) in enumerate(zip(axes, ("force [N]", "moment [N m]"))):
        axis.plot([2 * n for n in theirs], [f[k] for f in theirs.values()], "s--",
                  color=COLOUR["reference"], label="dolfinx, Taylor-Hood")
        for element, sizes in MESHES.items():
            points = [2 * n if meshes.is_quadratic(element) else n for n in sizes]
            axis.plot(points, [values[element, n][k] for n in sizes], "o-", color=COLOUR[element], label=element)
        axis.set(xlabel="node distances over the width", ylabel=name)
    axes[0].legend()
    return save(fig, context.images, "dolfinx.svg"), "Force and moment of both programs over the mesh"
