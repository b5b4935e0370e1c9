# SPDX-License-Identifier: GPL-3.0-or-later
"""Boundary elements: the literature's plate, bodies with closed forms, and how far a linear model holds."""

import numpy as np
from accuracy import plots
from accuracy.rows import table as table_of

from .program import figures
from .rows import Row, rows_table
from .scene import TOP, Replay, material

SCALE = 0.3  # of the block 100 x 100 x 30 mm
DEPTHS = (1, 3, 5, 10, 20, 30)  # [% of the block]
SLOW = 2.0  # [s] a pass down
TEXT = """Model `bem`: an organ by its surface alone, linear elastostatics [Castillo Leon 2011, ch. 5]. A point force in an
infinite body displaces by Kelvin's U and exerts the tractions T; so does each element of the surface, and for each point of
it c u + int T u = int U t, dense and not symmetric, H u = G t, of which either u or t is known. The print's T has its last
bracket reversed ((5.34); in the program's listing a + for a product too); right is, in the plane,

    T_ij = -1/(4 pi (1 - nu) r) [dr/dn ((1 - 2 nu) d_ij + 2 r,i r,j) - (1 - 2 nu) (r,i n_j - r,j n_i)].

In space this package tests the equations with the elements themselves, and adds the one of tractions (symmetric Galerkin):
the result is a symmetric stiffness of the surface's points, whose forces balance, of which the inverse where nothing
holds is what contact needs. [theory.md](../theory.md#boundary-elements) has the formulas.

Parameters: `edge_length` of the triangles, at most 1000 points; Young's modulus, Poisson's ratio and density of the
material at rest. Take it for presses of up to a tenth of the depth, of an organ that is held, where no mesh of the inside
is wanted or at hand and nothing is cut: a cycle then solves for what is touched. Do not take it where tissue turns or is
pressed deeper, nor for details: loading needs dense matrices of 6 n x 6 n, so edges cannot be as short as the contacts of
thin tools want. It is as linear as method `linear_precomputed`, and with the same edges less wrong. Where both lie between
time and error shows the part *Under a tool*."""
PLATE = """A plate, plane stress, clamped at its left, 3000 kN/m^2 to the right on its right side; E = 210e6 kN/m^2, nu = 0.3.
The text does not say how large it is: here it is the unit square. The source finds the same deformation by both, without
figures. *Apart*: of displacements at the elements' middles, or inside by an integral each, as a part of the largest."""
BODIES = """Closed forms in space: a cube in tension (what is left is quadrature), a sphere of radius 2 with a cavity of radius 1
under pressure [Lame], and a cavity in an infinite body in tension, whose strain is uniform [Eshelby 1957], with the stress
at its equator over that far away [Goodier 1933: {stress:.4f} for nu = 0.3]. Errors are the largest displacement's, over the
largest one. Corners lie on the spheres and triangles inside them; an icosahedron has one radial motion only, so its error
is no measure. *Not symmetric*: the single layer before it is made so. *Rigid*: largest force of a rigid motion over that
of as large a motion of one point, before it is projected out. One thread.

A cavity of {most} points takes {seconds:.0f} s, once, of which the integrals of all pairs are {share}: they grow with the
square of the points, dense factor and inverse with the cube. Hierarchical matrices or multipoles would spare the integrals and the
memory, but contact asks for single entries of the inverse, and up to 1000 points dense is a matter of seconds; beyond,
finite elements are the better choice."""
VALIDITY = """A block 30 x 30 x 9 mm, E = 10 kPa, nu = 1/4, glued below, under a ball of 5 mm that goes down in {slow:g} s: boundary
elements with edges of {edge:g} mm, linear finite elements (`anp`, method `linear_precomputed`) with the same edges, linear
and neo-Hookean ones (`anp`) that adapt to {finest:g} mm. Force in N where it is pressed to a part of the block's depth.
*Mesh*: of those with long edges from the fine linear ones, *linear*: of these from the neo-Hookean ones, which is what a
linear model is wrong by, whatever its mesh. Shallow contacts are narrower than an edge, which makes both coarse ones too
stiff; so a coarse linear model may look right at some depth for two reasons that are none."""


def plate_part(found):
    beside = found["beside_coarse"]
    rows = [Row("unknowns, triangles", 442, "ch. 5", found["unknowns"], f"{found['triangles']:.0f} triangles"),
            Row("entries of K", 5198, "ch. 5", found["entries"],
                f"by structure, of 10 x 10 cells of four triangles; {found['nonzero']:.0f} are not 0 as numbers"),
            Row("unknowns, boundary elements", 40, "ch. 5", beside["unknowns"], "20 elements, dense"),
            Row("deformation, apart on the boundary", "the same", "ch. 5", beside["off"], "part of the largest displacement",
                limit=0.1),
            Row("inside", "the same", "ch. 5", beside["inside"], "likewise", limit=0.1)]
    lines = [[f"{found['triangles']:.0f} triangles", f"{found['unknowns']:.0f}", f"{found['entries']:.0f}",
              f"{1e6 * found['end']:.4f}", "-", "-"]]
    lines += [[f"{p['elements']:.0f} elements", f"{p['unknowns']:.0f}", f"{p['entries']:.0f}", f"{1e6 * p['end']:.4f}",
               f"{100 * p['off']:.2f} %", f"{100 * p['inside']:.2f} %"] for p in found["beside_fine"]]
    lines.append([f"{found['fine_triangles']:.0f} triangles", "-", "-", f"{1e6 * found['fine_end']:.4f}", "0", "0"])
    table = table_of(["", "unknowns", "entries", "end goes [um]", "apart from the finest, boundary", "inside"], lines)
    return f"#### The plate of the literature\n\n{PLATE}\n\n{rows_table(rows)}\n\n{table}\n"


def bodies_part(found):
    lines = []
    for key, name in (("cube", "cube in tension"), ("hollow", "hollow sphere"), ("cavity", "cavity")):
        last = None
        for b in found[key]:
            order = f"{np.log(last[1] / b['error']) / np.log(last[0] / b['edge']):.1f}" if last and key != "cube" else ""
            last = (b["edge"], b["error"]) if b["triangles"] > 40 else None  # two icosahedra
            stress = f"{b['stress']:.4f}" if key == "cavity" else ""
            lines.append([name, f"{b['points']:.0f}", f"{b['triangles']:.0f}", f"{b['edge']:.2f}",
                          f"{100 * b['error']:.3f} %", order, stress, f"{b['skew']:.0e}",
                          f"{b['rigid']:.0e}" if key != "cavity" else "", f"{b['seconds']:.1f}"])
    table = table_of(["body", "points", "triangles", "edge", "error", "order", "stress", "not symmetric", "rigid", "s"],
                     lines)
    most = found["cavity"][-1]
    text = BODIES.format(stress=found["cavity_stress"], most=f"{most['points']:.0f}", seconds=most["seconds"],
                         share=f"{found['integral_seconds']:.1f} s")
    return f"#### Closed forms in space\n\n{text}\n\n{table}\n"


def press(context, name, organ, depth, solver=None):
    """Depth [m] and force [N] on the way down."""
    waypoints = [(0, 0, 0.5), (0.1, 0, 0.5), (0.1 + SLOW, 0, -1e3 * depth), (0.2 + SLOW, 0, -1e3 * depth)]
    replay = Replay(context.work / "boundary" / name, {"scale": SCALE, "material": material(0.25), **organ}, waypoints,
                    solver, top=SCALE * TOP)
    s = np.clip((replay.t - 0.1) / SLOW, 0.0, 1.0)
    s = s ** 3 * (10.0 - 15.0 * s + 6.0 * s * s)
    context.progress(f"boundary: {name}, {replay.nodes} nodes, {int((~replay.good).sum())} cycles not solved")
    down = replay.t < 0.1 + SLOW + 1e-9
    return 1e-3 * (s * (1e3 * depth + 0.5) - 0.5)[down], replay.force[down, 2]


def validity_part(context):
    edge, finest = (0.004, 0.002) if context.quick else (0.0021, 0.00035)
    depth = 0.01 * DEPTHS[-1] * SCALE * TOP
    fine = {"edge_length": edge, "adapt": {"finest": finest}}
    runs = {"boundary elements": press(context, "bem", {"model": "bem", "edge_length": edge}, depth),
            "`linear_precomputed`": press(context, "same_edges", {"edge_length": edge}, depth,
                                          {"method": "linear_precomputed"}),
            "linear, fine": press(context, "linear", {**fine, "material": {**material(0.25), "law": "linear"}}, depth),
            "neo-Hookean, fine": press(context, "nonlinear", fine, depth)}
    lines = []
    for part in DEPTHS:
        bem, tets, linear, curved = found = [np.interp(0.01 * part * SCALE * TOP, *run) for run in runs.values()]
        pairs = ((bem, linear), (tets, linear), (linear, curved), (bem, curved))
        lines.append([f"{part} %", *(f"{f:.4f}" for f in found), *(f"{100 * (f / of - 1):+.0f} %" for f, of in pairs)])
    table = table_of(["depth", *runs, "mesh, boundary elements", "mesh, `linear_precomputed`", "linear",
                      "boundary elements in all"], lines)
    fig, ax = plots.figure()
    for (name, (at, force)), style in zip(runs.items(), ("-", "--", "-.", ":")):
        ax.plot(100 * at / (SCALE * TOP), force, style, label=name.replace("`", ""))
    ax.set(xlabel="depth [% of the block]", ylabel="force [N]", xlim=(0, DEPTHS[-1]), ylim=(0, None))
    ax.legend()
    picture = plots.save(fig, context.images, "boundary.svg")
    text = VALIDITY.format(slow=SLOW, edge=1e3 * edge, finest=1e3 * finest)
    return (f"#### How deep a linear model holds\n\n{text}\n\n![Force over depth](images/models/{picture})\n\n{table}\n")


def run(context):
    found = figures(context, "boundary")
    return (f"### Boundary elements\n\n{TEXT}\n\n{plate_part(found['plate'])}\n{bodies_part(found)}\n"
            f"{validity_part(context)}\n")
