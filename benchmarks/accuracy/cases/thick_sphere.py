# SPDX-License-Identifier: GPL-3.0-or-later
"""A thick-walled ball blown up from inside: large strains of a nearly incompressible body."""

import numpy as np

from .. import bounds, meshes
from ..plots import COLOUR, figure, save
from ..report import rows_table
from ..rows import BALANCE, Row, Section
from ..solve import solve

CASE = "thick sphere"
INNER, OUTER, MU, POISSON = 0.01, 0.02, 1.0e3, 0.4999
SOURCE = "closed form [Green and Zerna 1954, incompressible neo-Hooke]"
STRETCHES = (1.1, 1.25, 1.5, 2.0)  # of the inner radius; the pressure is highest at about 1.83
MESHES = {"anp": (4, 8, 12), "tet10": (2, 3, 4), "tet10p": (2, 3, 4)}  # parts of an arc of 90 degrees
QUICK_MESHES = {"tet10": (2,)}
# Bounded: what refining may still change, by the order of the energy norm, which the smooth solution has;
# and Poisson's ratio, whose 1 - 2 nu is 0.0002, with strains of one.
ORDER = {"anp": 1, "tet10": 2, "tet10p": 2}
UNKNOWN = 2 * (1 - 2 * POISSON)


def pressure(stretch):
    """Inner pressure [Pa] that widens the inner radius by `stretch`."""
    volume = INNER ** 3 * (stretch ** 3 - 1)
    outer = np.cbrt(OUTER ** 3 + volume) / OUTER

    def part(s):
        return s ** -4 + 4 / s
    return MU / 2 * (part(outer) - part(stretch))


def octant(n, quadratic):
    """n^2 triangles of the octant's surface, in layers that are as thick as they are wide."""
    flat, triangles = meshes.triangle(n)
    layers = round(0.75 * n) if n > 2 else 2
    # Prisms over the first two barycentric coordinates; the third coordinate is the radius.
    mesh = meshes.prisms(flat[:, :2], triangles, INNER * (OUTER / INNER) ** np.linspace(0, 1, layers + 1))
    if quadratic:
        mesh = mesh.with_midnodes()

    def blow(p):
        axes = np.stack([p[:, 0], p[:, 1], 1 - p[:, 0] - p[:, 1]], 1)
        axes[np.abs(axes) < 1e-12] = 0.0
        return p[:, 2:] * axes / np.linalg.norm(axes, axis=1)[:, None]
    return mesh.mapped(blow)


def inflate(folder, element, n, stretch):
    """Pressure [Pa]: the force along the normals of the inner surface over its area. Every node of
    the inner surface is moved along its radius."""
    mesh = octant(n, meshes.is_quadratic(element))
    radius = np.linalg.norm(mesh.points, axis=1)
    inner = np.flatnonzero(np.abs(radius - INNER) < 1e-9)
    axes = "xyz"
    boundary = [{"select": {"plane": {"axis": axes[k], "at": 0.0}},
                 "displacement": [0 if i == k else None for i in range(3)]} for k in range(3)]
    boundary += [{"select": {"sphere": {"center": list(mesh.points[i]), "radius": 1e-8}},
                  "displacement": list((stretch - 1) * mesh.points[i])} for i in inner]
    result = solve(folder, mesh, element,
                   {"law": "neo_hookean", "mu": MU, "kappa": 2 * MU * (1 + POISSON) / (3 * (1 - 2 * POISSON))},
                   boundary, [], {"load_steps": max(2, round(8 * (stretch - 1)))})
    normal = mesh.points[inner] / INNER
    force = np.sum(result.reaction[inner] * normal)
    # Planes of symmetry hold the octant: their forces and the inner surface's balance.
    gap = np.abs(result.reaction.sum(axis=0)).max() / np.abs(result.reaction).sum()
    return force / (np.pi / 2 * (stretch * INNER) ** 2), gap, result


def run(context):
    rows, shown, errors, found = [], [], {}, {}
    for element, sizes in (QUICK_MESHES if context.quick else MESHES).items():
        for n in sizes:
            for stretch in STRETCHES:
                p, gap, result = inflate(context.folder(CASE, f"{element}_{n}_{stretch}"), element, n, stretch)
                mesh = f"{n} parts of 90 deg, {result.mesh.size()}"
                values = found.setdefault((element, stretch), [])
                values.append(p)
                bound = None
                if len(values) > 2:
                    bound = bounds.refined([1 / k for k in sizes], values, pressure(stretch), ORDER[element]) + UNKNOWN
                row = Row(CASE, mesh, element, f"pressure at a = {stretch:g} A [Pa]", p, pressure(stretch),
                          SOURCE, bound)
                rows += [row, Row(CASE, mesh, element, f"sum of all forces / sum of sizes, a = {stretch:g} A",
                                  gap, 0.0, "equilibrium", BALANCE, gap)]
                shown.append(row)
                errors[element, n, stretch] = abs(row.error)
                context.progress(f"{element} {n} a = {stretch} A: {100 * row.error:+.2f} %, "
                                 f"{result.seconds:.1f} s")
    figures = [] if context.quick else [_plot(context, shown, errors)]
    return Section("A thick-walled ball under inner pressure", TEXT, rows, figures, [rows_table(shown)])


TEXT = (f"A hollow ball, inner radius A = {1e3 * INNER:g} mm, outer {1e3 * OUTER:g} mm, mu = {MU / 1e3:g} kPa, "
        f"Poisson's ratio {POISSON:g} for incompressible. The inner surface is moved out to the radius a, up "
        "to twice the rest radius: beyond 1.83 A the pressure falls again, which is why the radius is "
        "prescribed and the pressure measured, as the sum of the forces along the normals over the area "
        "of the inner sphere. One octant between three planes of symmetry; all forces on it balance in "
        "every run (bound 1e-6). The quadratic meshes are curved.")


def _plot(context, rows, errors):
    fig, axes = figure(2, width=8.0, height=3.2)
    s = np.linspace(1, 2.1, 200)
    axes[0].plot(s, pressure(s), color=COLOUR["reference"], label="exact")
    for element, sizes in MESHES.items():
        finest = [r for r in rows if r.element == element and r.mesh.startswith(f"{sizes[-1]} ")]
        axes[0].plot(STRETCHES, [r.value for r in finest], "o", label=element, color=COLOUR[element],
                     fillstyle="none" if element == "anp" else "full")
        h = [1 / n / (2 if meshes.is_quadratic(element) else 1) for n in sizes]
        axes[1].loglog(h, [100 * errors[element, n, 1.5] for n in sizes], "o-", label=element,
                       color=COLOUR[element])
    axes[0].set(xlabel="a / A", ylabel="pressure [Pa]")
    axes[1].set(xlabel="distance of nodes / arc of 90 degrees", ylabel="error at a = 1.5 A [%]")
    axes[0].legend()
    axes[1].legend()
    return save(fig, context.images, "thick_sphere.svg"), "Pressure over the inner radius; errors over the mesh size"
