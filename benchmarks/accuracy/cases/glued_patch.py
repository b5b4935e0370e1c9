# SPDX-License-Identifier: GPL-3.0-or-later
"""A gel cube with a square patch of its top glued to a tool and pushed down: the force in the hand."""

from .. import bounds, meshes
from ..plots import COLOUR, figure, save
from ..rows import Row, Section, balance, table
from ..solve import plane, reaction, solve

CASE = "glued patch"
QUICK = True
EDGE, PATCH, DEPTH, YOUNG = 0.1, 0.05, 0.02, 5.0e3  # [m], [m], [m], [Pa]
# Converged force [N] by Poisson's ratio, each +-0.2 N: extrapolated from six kinds of element.
REFERENCE = {0.45: 8.0, 0.49: 8.2, 0.499: 8.45}
UNKNOWN = 0.2  # [N]
SOURCE = "extrapolation from six kinds of element under refinement, +-0.2 N (regression value)"
# Bounded: what refining further may still change, by first order, and what is unknown of the reference. At
# the patch's edge stresses grow as the inverse root of the distance, so that any element's force converges
# by first order in the end. `tet4` locks before that, and two meshes of `p1p1` say too little.
ORDER, BOUNDED = 1, ("anp", "tet10", "tet10p")
MESHES = {"tet4": (8, 16), "anp": (4, 8, 16), "p1p1": (8, 12), "tet10": (2, 4, 8),
          "tet10p": (2, 4, 8)}
QUICK_MESHES = {"tet4": (8,), "anp": (4, 8)}


def push(folder, element, n, poisson):
    """Result of the cube of n^3 cells."""
    mesh = meshes.box((EDGE,) * 3, (n,) * 3).for_element(element)
    low, high = (EDGE - PATCH) / 2 - 1e-6, (EDGE + PATCH) / 2 + 1e-6
    patch = {"box": {"min": [low, low, EDGE - 1e-6], "max": [high, high, EDGE + 1e-6]}}
    return solve(folder, mesh, element,
                 {"law": "neo_hookean", "young_modulus": YOUNG, "poisson_ratio": poisson},
                 [{"select": plane("z", 0.0), "displacement": [0, 0, 0]},
                  {"select": patch, "displacement": [0, 0, -DEPTH]}],
                 [reaction("tool", patch), reaction("table", plane("z", 0.0))], {"load_steps": 5})


def run(context):
    rows, force, iterations = [], {}, {}
    for element, sizes in (QUICK_MESHES if context.quick else MESHES).items():
        for n in sizes:
            for poisson, reference in REFERENCE.items():
                result = push(context.folder(CASE, f"{element}_{n}_{poisson}"), element, n, poisson)
                mesh = f"{n}^3 cells, {result.mesh.size()}"
                f = -result.force("tool")[2]
                force[element, n, poisson] = f
                iterations[element, n, poisson] = result.json["newton_iterations"]
                bound = None
                if element in BOUNDED and n == sizes[-1]:
                    found = [force[element, k, poisson] for k in sizes]
                    bound = bounds.refined([1 / k for k in sizes], found, reference, ORDER) + UNKNOWN / reference
                rows.append(Row(CASE, mesh, element, f"force, nu = {poisson:g} [N]", f, reference,
                                SOURCE, bound))
                rows.append(balance(CASE, mesh, element, result.force("table"), result.force("tool")))
                context.progress(f"{element} {n}^3 nu {poisson}: {f:.3f} N, {result.seconds:.1f} s")
    figures = [] if context.quick else [_plot(context, force)]
    return Section("A patch of a gel cube, glued and pushed", TEXT, rows, figures,
                   [_table(force, iterations)], _headline(force))


TEXT = (f"A cube of {1e3 * EDGE:g} mm, neo-Hookean, E = {YOUNG / 1e3:g} kPa, stands glued on a table. "
        f"A square of {1e3 * PATCH:g} mm in the middle of its top is glued to a tool, which moves "
        f"{1e3 * DEPTH:g} mm down. What does the hand feel? The stress is singular at the edge of the "
        "patch, so there is no closed form, and refinement pays slowly; the force needs no such edge "
        "to be resolved, only an element that does not lock. The supports' forces balance to rounding "
        "in every run (bound 1e-6).")


def _head():
    return ["element", "mesh"] + [f"nu = {p:g}: force, error" for p in REFERENCE]


def _lines(force):
    lines = []
    for element, n in dict.fromkeys((e, n) for e, n, _ in force):
        cells = [f"{force[element, n, p]:.2f} N, {100 * (force[element, n, p] / r - 1):+.1f} %"
                 for p, r in REFERENCE.items()]
        lines.append([f"`{element}`", f"{6 * n ** 3} tetrahedra", *cells])
    return lines + [["converged", "", *(f"{r:g} +-0.2 N" for r in REFERENCE.values())]]


def _table(force, iterations):
    text = table(_head(), _lines(force))
    most = {e: max(i for (k, _, _), i in iterations.items() if k == e) for e, _, _ in force}
    return text + "\n\nNewton iterations, at most: " + ", ".join(f"`{e}` {i}" for e, i in most.items()) + "."


def _headline(force):
    kept = {k: f for k, f in force.items() if k[0] in ("tet4", "anp")}
    return (f"**The force of a soft cube against a tool.** {1e3 * EDGE:g} mm cube, E = {YOUNG / 1e3:g} kPa, "
            f"glued patch of {1e3 * PATCH:g} mm pushed {1e3 * DEPTH:g} mm in; nu is Poisson's ratio. The "
            "plain element `tet4` locks: the nearer to incompressible, the stiffer it feels. "
            f"`anp` does not.\n\n{table(_head(), _lines(kept))}\n")


def _plot(context, force):
    fig, axes = figure(len(REFERENCE), width=9.0, height=3.2, sharey=True)
    for axis, (poisson, reference) in zip(axes, REFERENCE.items()):
        axis.axhspan(reference - 0.2, reference + 0.2, color="#dddddd", label="converged")
        for element, sizes in MESHES.items():
            points = [(2 * n if meshes.is_quadratic(element) else n) + 1 for n in sizes]
            axis.plot(points, [force[element, n, poisson] for n in sizes], "o-", label=element,
                      color=COLOUR[element])
        axis.set(title=f"nu = {poisson:g}", xlabel="nodes along an edge",
                 ylim=(0, 1.05 * max(force.values())))
    axes[0].set_ylabel("force on the tool [N]")
    axes[0].legend()
    return save(fig, context.images, "glued_patch.svg"), "Force on the tool over the fineness of the mesh"
