# SPDX-License-Identifier: GPL-3.0-or-later
"""A viscous block that is sheared at once and held: how its force relaxes."""

import numpy as np

from .. import meshes
from ..plots import COLOUR, figure, save
from ..report import rows_table
from ..rows import Row, Section
from ..solve import plane, reaction, solve

CASE = "Prony"
QUICK = True
EDGE, SHEAR, MU, KAPPA = 0.01, 0.3, 1.0e3, 2.0e4  # [m], [-], [Pa], [Pa]
TERMS = [{"g": 0.45, "tau": 0.5}, {"g": 0.3, "tau": 5.0}]  # [-], [s]
STEP, DURATION = 0.005, 10.0  # [s]
TIMES = (0.05, 0.5, 2.0, 10.0)  # [s]
SOURCE = "closed form mu gamma A (1 - sum g + sum g exp(-t/tau)), t from the middle of the ramp [Holzapfel 2000, 6.10]"
# The history is updated by the middle of each step: second order in a step over the shortest tau.
BOUND = (STEP / min(term["tau"] for term in TERMS)) ** 2


def exact(t):
    """Force [N] at time t [s] after the step."""
    left = 1 - sum(term["g"] for term in TERMS)
    return MU * SHEAR * EDGE ** 2 * (left + sum(k["g"] * np.exp(-t / k["tau"]) for k in TERMS))


def relax(folder, element):
    """Times [s] and forces on the top [N]. All nodes of the surface move as in a simple shear, the
    one within is free; the move takes one time step."""
    mesh = meshes.box((EDGE,) * 3, (2, 2, 2)).for_element(element)
    surface = np.flatnonzero(np.any((mesh.points < 1e-12) | (mesh.points > EDGE - 1e-12), axis=1))
    boundary = [{"select": {"sphere": {"center": list(mesh.points[i]), "radius": 1e-9}},
                 "displacement": [SHEAR * mesh.points[i, 2], 0, 0]} for i in surface]
    result = solve(folder, mesh, element,
                   {"law": "neo_hookean", "mu": MU, "kappa": KAPPA, "viscoelastic": TERMS}, boundary,
                   [reaction("top", plane("z", EDGE))],
                   {"kind": "dynamic", "integrator": "static", "dt": STEP, "duration": DURATION,
                    "ramp_time": STEP, "tolerance": 1e-10, "linear_tolerance": 1e-10})
    return result.history("top.fx")


def run(context):
    rows, curves = [], {}
    for element in ("tet4", "anp", "tet10"):
        t, force = curves[element] = relax(context.folder(CASE, element), element)
        for time in TIMES:
            value = force[np.abs(t - time).argmin()]
            rows.append(Row(CASE, "2 x 2 x 2 cells", element, f"force at t = {time:g} s [N]", value,
                            exact(time - STEP / 2), SOURCE, BOUND))
        context.progress(f"{element}: error at most {max(abs(r.error) for r in rows[-len(TIMES):]):.1e}")
    return Section("Relaxation under a sudden shear", TEXT, rows, [_plot(context, curves)],
                   [rows_table(rows)])


TEXT = (f"A block is sheared by {SHEAR:g} within {1e3 * STEP:g} ms and held. Its law is neo-Hookean for a sudden "
        "load; a Prony series lets " + " and ".join(f"{100 * k['g']:g} % relax with tau = {k['tau']:g} s"
                                                    for k in TERMS) +
        f". The force is compared with the closed form; the integrator is `static` with steps of {1e3 * STEP:g} ms.")


def _plot(context, curves):
    fig, axis = figure()
    t = np.geomspace(STEP, DURATION, 200)
    axis.semilogx(t, 1e3 * exact(t), color=COLOUR["reference"], label="exact")
    for (element, (times, force)), marker in zip(curves.items(), "o+x"):
        shown = [np.abs(times - x).argmin() for x in np.geomspace(2 * STEP, DURATION, 15)]
        axis.semilogx(times[shown], 1e3 * force[shown], marker, color=COLOUR[element], label=element)
    axis.set(xlabel="time after the step [s]", ylabel="shear force [mN]")
    axis.legend()
    return save(fig, context.images, "prony.svg"), "Shear force over time"
