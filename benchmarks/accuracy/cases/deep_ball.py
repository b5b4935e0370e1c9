# SPDX-License-Identifier: GPL-3.0-or-later
"""A small ball pressed deep into a block, on graded meshes: the force in the hand, against dolfinx."""

import itertools
import math

from .. import axisymmetric, bounds, replay
from ..plots import COLOUR, figure, save
from ..report import rows_table
from ..rows import Row, Section, table

CASE = "deep ball"
NEEDS = (axisymmetric,)
BALL, DEPTH = 0.005, 0.008  # [m]: deeper than its radius
WIDTH, HEIGHT = 0.120, 0.060  # [m] of the block, which is square
YOUNG, POISSON, LAW = 6.0e3, 0.45, "stable_neo_hookean"  # [Pa], [-]: those of the shipped liver
CONTACT = {"stiffness": 3e8, "smoothing": 1e-4}  # a scene's defaults
SOLVER = {"integrator": "static", "step": 0.1, "tolerance": 1e-5, "threads": 1, "max_newton_iterations": 100,
          "max_linear_iterations": 5000}
STEPS = 16  # of half a millimetre
# Radii of the cylinder that stands for the block: of equal area, within it and around it.
EQUAL, INSCRIBED, AROUND = WIDTH / math.sqrt(math.pi), WIDTH / 2, WIDTH / math.sqrt(2)
EDGES = (0.002, 0.001, 0.0005)  # [m] of dolfinx's triangles at the ball
# Edges at the ball [m], coarse to fine.
MESHES = {"anp": (0.003, 0.002, 0.0014), "tet10": (0.004, 0.003, 0.002),
          "tet10p": (0.004, 0.003, 0.002)}
COARSEST, REACH, GROWTH = 0.015, 0.008, 0.3  # [m], [m], edge per distance beyond that


SOURCE = "dolfinx 0.5.2, axisymmetric, quadratic triangles of {:g} mm, cylinder of the block's area"


def reference(context, edge, radius, law=LAW):
    """Force [N] on the ball at its deepest, in dolfinx."""
    file = context.folder(CASE, f"dolfinx_{law}_{1e3 * edge:g}_{1e3 * radius:.1f}.json")
    answer = axisymmetric.solve(file, law=law, young_modulus=YOUNG, poisson_ratio=POISSON, ball=BALL, depth=DEPTH,
                                radius=radius, height=HEIGHT, edge=edge, fine=0.010, growth=0.2, steps=32, **CONTACT)
    context.progress(f"dolfinx, {1e3 * edge:g} mm, radius {1e3 * radius:.1f} mm: {answer['forces'][-1]:.5f} N, "
                     f"{answer['iterations']} iterations")
    return answer["forces"][-1]


def block(folder):
    """The block's surface as a file: its top's middle is the origin."""
    folder.mkdir(parents=True, exist_ok=True)
    half = WIDTH / 2
    corners = list(itertools.product((-half, half), (-half, half), (-HEIGHT, 0.0)))
    quads = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
    lines = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in corners]
    lines += [f"f {a} {b} {c}\nf {a} {c} {d}" for a, b, c, d in quads]
    (folder / "block.obj").write_text("\n".join(lines) + "\n")
    return "block.obj"


def press(folder, element, edge, law=LAW):
    """Force [N] on the ball at its deepest, by `palpate replay` on a graded mesh, and the mesh's size."""
    organ = {"surface": block(folder), "element": element,
             "edge_length": {"coarsest": COARSEST, "near": [
                 {"finest": edge, "point": [0, 0, 0], "radius": REACH, "growth": GROWTH}]},
             "material": {"law": law, "young_modulus": YOUNG, "poisson_ratio": POISSON}}
    heights = [BALL + 1e-3] + [BALL - DEPTH * k / STEPS for k in range(1, STEPS + 1)]
    ground = {"plane": {"axis": "z", "at": -HEIGHT, "tolerance": 1e-6}}
    forces, _, _ = replay.press(folder, organ, ground, BALL, heights, CONTACT, SOLVER)
    return forces[-1, 2], replay.size(folder)


def run(context):
    theirs = [reference(context, edge, EQUAL) for edge in EDGES]
    within, around = (reference(context, EDGES[1], r) for r in (INSCRIBED, AROUND))
    limit, source = theirs[-1], SOURCE.format(1e3 * EDGES[-1])
    name = "force at the deepest [N]"
    rows = [Row(CASE, f"dolfinx, triangles of {1e3 * e:g} mm at the ball", "", name, f, limit, source)
            for e, f in zip(EDGES[:-1], theirs)]
    rows += [Row(CASE, f"dolfinx, 1 mm, cylinder of {1e3 * r:.1f} mm, {what} the block", "", name, f, limit, source)
             for r, f, what in ((INSCRIBED, within, "within"), (AROUND, around, "around"))]
    # What is unknown of the reference: its last refinement, and that it is a cylinder, not a block.
    unknown = (abs(theirs[-1] - theirs[-2]) + (around - within) / 2) / limit
    forces = {}
    for element, edges in MESHES.items():
        for edge in edges:
            forces[element, edge], mesh = press(context.folder(CASE, f"{element}_{1e3 * edge:g}"), element, edge)
            found = [forces[element, e] for e in edges if e >= edge]
            # First order at least: where the contact ends the surface has a kink in its curvature.
            bound = bounds.refined(edges[:len(found)], found, limit, order=1) + unknown if len(found) > 2 else None
            rows.append(Row(CASE, f"{1e3 * edge:g} mm at the ball, {mesh}", element, name, forces[element, edge],
                            limit, source, bound))
            context.progress(f"{element} {1e3 * edge:g} mm: {forces[element, edge]:.5f} N "
                             f"({100 * rows[-1].error:+.2f} %), {mesh}")
    return Section("A ball pressed deep into a block", TEXT, rows, [_plot(context, forces, limit)],
                   [rows_table(rows), EXTRAPOLATED + _limits(forces, limit)])


TEXT = (f"A ball of {1e3 * BALL:g} mm radius goes {1e3 * DEPTH:g} mm deep into a block of {1e3 * WIDTH:g} x "
        f"{1e3 * WIDTH:g} x {1e3 * HEIGHT:g} mm (E = {YOUNG / 1e3:g} kPa, nu = {POISSON:g}, `{LAW}`) "
        "that is held at its ground, by `palpate replay`: the cycle that the hand feels, in static steps. What "
        "is off is the mesh: it is fine at the ball only, with edges as said within "
        f"{1e3 * REACH:g} mm, and then longer by {GROWTH:g} a unit of distance. The reference has the same law, contact "
        "penalty and depth in a cylinder of the block's area; cylinders within and around the block bound what that "
        "changes. The bound is what refining further may still change by first order, and what is unknown of the "
        "reference.")

EXTRAPOLATED = """Limit and order of force = limit + c h^order through the three meshes of an element:

"""


def _limits(forces, limit):
    lines = []
    for element, edges in MESHES.items():
        far, order = bounds.extrapolated(edges, [forces[element, e] for e in edges])
        lines.append([f"`{element}`", f"{far:.4f} N", f"{order:.2f}", f"{100 * (far / limit - 1):+.2f} %"])
    return table(["element", "limit", "order", "beside dolfinx"], lines)


def _plot(context, forces, limit):
    fig, axis = figure()
    axis.axhline(limit, color=COLOUR["reference"], linestyle="--", label="dolfinx")
    for element, edges in MESHES.items():
        axis.plot([1e3 * e for e in edges], [forces[element, e] for e in edges], "o-", label=element,
                  color=COLOUR[element])
    axis.set(xlabel="edges at the ball [mm]", ylabel="force on the ball [N]", xlim=(0, None))
    axis.legend()
    return save(fig, context.images, "deep_ball.svg"), "Force on the ball over the edges where it touches"
