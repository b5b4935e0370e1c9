# SPDX-License-Identifier: GPL-3.0-or-later
"""Rivlin's torsion of a cylinder: the moment, and the force along the axis that no linear theory has."""

import numpy as np

from .. import bounds, meshes
from ..plots import COLOUR, figure, save
from ..report import rows_table
from ..rows import Row, Section, balance
from ..solve import plane, reaction, solve

CASE = "torsion"
QUICK = True
RADIUS, LENGTH, MU, POISSON = 0.01, 0.02, 1.0e3, 0.499
TWIST = 1.0 / RADIUS  # [rad/m]: a line on the mantle leans by 45 degrees
SOURCE = "closed form [Rivlin 1949], incompressible neo-Hookean: M = pi/2 mu psi A^4, N = -pi/4 mu psi^2 A^4"
MESHES = {"anp": (4, 8, 11), "tet10": (2, 3, 4), "tet10p": (2, 3, 4)}  # rings of the disc
QUICK_MESHES = {"tet10": (2, 3)}  # without a bound
# Bounded: what refining may still change, by the order of the energy norm, which the smooth solution has;
# and Poisson's ratio, whose 1 - 2 nu is 0.002.
ORDER = {"anp": 1, "tet10": 2, "tet10p": 2}
UNKNOWN = 1 - 2 * POISSON


def cylinder(rings, quadratic):
    """Hexagonal rings and layers as thick as these are wide; curved edges with mid-edge nodes."""
    radii = np.linspace(0, 1, rings + 1)[1:]
    points, triangles = meshes.disc(radii, [6 * (k + 1) for k in range(rings)])
    mesh = meshes.prisms(points, triangles, np.linspace(0, LENGTH, 2 * rings + 1))
    if quadratic:
        mesh = mesh.with_midnodes()

    def bend(p):
        """Midpoints of the rings' sides go out to their circle."""
        p = p.copy()
        r = np.hypot(p[:, 0], p[:, 1])
        angle = np.arctan2(p[:, 1], p[:, 0])
        # A side of ring k is a chord; the point's own ring is the one whose chords it lies between.
        for k, radius in enumerate(radii):
            on = np.abs(r - radius * np.cos(np.pi / (6 * (k + 1)))) < 1e-9
            r = np.where(on, radius, r)
        p[:, 0], p[:, 1] = RADIUS * r * np.cos(angle), RADIUS * r * np.sin(angle)
        return p
    return mesh.mapped(bend)


def twist(folder, element, rings, law):
    return solve(folder, cylinder(rings, meshes.is_quadratic(element)), element, law,
                 [{"select": plane("z", 0.0), "displacement": [0, 0, 0]},
                  {"select": plane("z", LENGTH), "displacement": [0, 0, 0],
                   "rotation": {"axis": [0, 0, 1], "angle": TWIST * LENGTH}}],
                 [reaction("near", plane("z", 0.0)), reaction("far", plane("z", LENGTH))],
                 {"load_steps": 5})


def run(context):
    moment = np.pi / 2 * MU * TWIST * RADIUS ** 4
    force = -np.pi / 4 * MU * TWIST ** 2 * RADIUS ** 4
    law = {"law": "neo_hookean", "mu": MU, "kappa": 2 * MU * (1 + POISSON) / (3 * (1 - 2 * POISSON))}
    rows, shown, errors, found = [], [], {}, {}
    for element, sizes in (QUICK_MESHES if context.quick else MESHES).items():
        for rings in sizes:
            result = twist(context.folder(CASE, f"{element}_{rings}"), element, rings, law)
            mesh = f"{rings} rings, {result.mesh.size()}"
            far = result.json["probes"]["far"]
            found.setdefault(element, []).append((far["moment"][2], far["force"][2]))
            limits = [None, None]
            if len(found[element]) > 2:
                limits = [bounds.refined([1 / k for k in sizes], values, exact, ORDER[element]) + UNKNOWN
                          for values, exact in zip(zip(*found[element]), (moment, force))]
            m = Row(CASE, mesh, element, "moment M [N m]", far["moment"][2], moment, SOURCE, limits[0])
            n = Row(CASE, mesh, element, "force N along the axis [N]", far["force"][2], force, SOURCE,
                    limits[1])
            shown += [m, n]
            rows += [m, n, balance(CASE, mesh, element, result.force("near"), result.force("far"))]
            errors[element, rings] = abs(m.error), abs(n.error)
            context.progress(f"{element} {rings} rings: M {100 * m.error:+.2f} %, N {100 * n.error:+.2f} %, "
                             f"{result.seconds:.1f} s")
    return Section("Torsion of a cylinder", TEXT, rows, [_plot(context, errors)], [rows_table(shown)])


TEXT = (f"A cylinder, radius A = {1e3 * RADIUS:g} mm, length {1e3 * LENGTH:g} mm, mu = {MU / 1e3:g} kPa, "
        f"Poisson's ratio {POISSON:g} for incompressible, which changes the answer by about 0.1 %. One end is held, the other turned by "
        f"{TWIST * LENGTH:g} rad, so that lines on the mantle lean by 45 degrees. In the exact solution "
        "every cross-section turns as a rigid disc; both ends are held as it says. A twisted cylinder "
        "wants to grow longer (Poynting's effect), so the supports must press: this force is of second "
        "order and a test of finite strain. The ends' forces balance in every run (bound 1e-6). The "
        "quadratic meshes have curved edges.")


def _plot(context, errors):
    fig, axes = figure(2, width=7.5, height=3.2, sharey=True)
    for axis, k, name in ((axes[0], 0, "moment"), (axes[1], 1, "axial force")):
        for element in dict.fromkeys(e for e, _ in errors):
            sizes = [n for e, n in errors if e == element]
            h = [1e3 * RADIUS / n / (2 if meshes.is_quadratic(element) else 1) for n in sizes]
            axis.loglog(h, [100 * errors[element, n][k] for n in sizes], "o-", label=element,
                        color=COLOUR[element])
        axis.set(title=name, xlabel="distance of nodes [mm]")
    axes[0].set_ylabel("error [%]")
    axes[0].legend()
    return save(fig, context.images, "torsion.svg"), "Errors of moment and axial force over the mesh size"
