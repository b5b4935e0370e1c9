# SPDX-License-Identifier: GPL-3.0-or-later
"""Half a page a model: what it is, when to use it, and where it stands under the tool."""

from .scene import STEP
from .touched import figures

# Name in scenes: idea, equations as corrected, parameters, when to use it.
MODELS = {
    "mass_spring": (
        "Point masses at the corners of tetrahedra, springs with preload between them, and nothing that knows a volume.",
        "F(u) = P + k (u - U). On regular meshes k1 + 4 k2 = E h (2 U^2 + h^2)/(4 (1 - nu) U^2) for squares (5.102; printed with 8 "
        "for the 4), k1 = k2 = 2 E h/5 for edges and face diagonals of cubes (7.70; printed with 4 E h for 2 E h). On tetrahedra "
        "k = E V/L^2 of the volume V around an edge, or the bounded least squares of chapter 7, times the number that makes "
        "their mean right, which is not in the source.",
        "`springs.constants` (volumes, fitted, a file of `palpate springs`), `springs.scheme` (implicit, symplectic Euler, the "
        "patent's trapezoidal step, forward Euler), `springs.region` (the patent's restriction to what is touched).",
        "For small presses of a tissue with nu = 1/4, where a cycle must be cheap: a cut would void nothing. Not deep: nothing "
        "resists the loss of volume, so forces are too small there, and finer meshes do not mend it. Explicit steps stay folded "
        "once they are inside out, which is reported."),
    "tensor_mass": (
        "Linear elasticity in 3 x 3 tensors of points and edges, which is the stiffness of linear tetrahedra at rest, with point "
        "masses.",
        "K_jk = (l M_j M_k^T + m M_k M_j^T + m (M_j . M_k) I)/(36 V), M_j the outward area vector, twice its area long, of the face "
        "opposite j. In (2.16) the first two products are the other way round for the force on j.",
        "The law's moduli at rest; nothing of its own.",
        "Where strains stay small and the mesh may be cut. A turn is a strain of half its square; nearly incompressible tissue "
        "locks as linear tetrahedra do."),
    "hybrid": (
        "Tensors in a region, in a rest that is linear, quasi-static and solved beforehand.",
        "u_p = a + T u_c + C e, f_c = S u_c + b - T^T e of the rest's surface p and of what it shares with the region, c; all is "
        "balanced in one solve (`exchange: monolithic`), or by an exchange each cycle as published, which is stable while K + "
        "4 M/h^2 - S of the region is positive definite.",
        "`hybrid.region`, `hybrid.exchange`.",
        "Where a small region is to be cut in a large organ. Not to save time: it did not here, for what is shared is dense."),
    "sampled_elasticity": (
        "Particles in cubes of an octree, which are parted where the displacement bends, and differences to neighbours in place "
        "of derivatives.",
        "rho a = (3 mu - 3/2 (lambda + mu)) L + 15/2 (lambda + mu) G with the umbrella operators L and G of (2.9) to (2.11); as "
        "published, mu L + (lambda + mu) G, a block sags 2.5 to 3.1 times too far, for over directions that are all alike L is a "
        "third of the Laplacian.",
        "`sampling.coarsest`, `levels`, `refine_above`, `coarsen_below`, `weights`.",
        "For fields that are drawn. Not for a hand: no mesh that ran in real time came within the error of the coarsest "
        "elements."),
    "honeycomb": (
        "Boxes of elastic fabric, full of an incompressible fluid; a side moves along its normal, and a solve goes from cell to "
        "cell in waves.",
        "Each side balances the pressures and the fabric of its two cells (3.8), each cell keeps its volume, to first order "
        "(3.10) or exactly. 1/24 for the 1/6 of (3.16); signs of (3.8) as in (3.5); of (3.20) those of the walls' tension and of "
        "the weight: as printed a ball would be drawn into the block.",
        "`honeycomb.cell_size`, `volume`, `cut_off`, `waves`; E of the law, with nu = 1/2.",
        "To reproduce it. On cells as large as a tool forces are multiples of the right ones, and where a tool snaps over a "
        "cell's edge they jump."),
    "cloth": (
        "A sheet of springs whose preload resists bending, rolled up if one likes, with its layers kept apart.",
        "P1 = sqrt(3) E h^3/(9 (1 - nu) U), P2 = -P1/2 and k1 + 4 k2 = E h/(sqrt(3) (1 - nu)) for equal triangles (5.114, 5.115, "
        "5.121); rolled on r = R_t (1 - c beta) (6.4.2).",
        "`cloth.width`, `length`, `thickness`, `spacing`, or a surface; `preload`, `rolled`.",
        "For meshes and membranes. Not where they wrinkle finely: edges do not meet edges, and springs contract as with nu = "
        "1/3."),
    "enriched": (
        "Coarse finite elements carry a fine surface, which is shown and felt, with detail that presses of finer ones taught.",
        "A fine point is at sum w_k x_k + r + d; d = |c| phi_max X a of what interpolation leaves out, by the regressor of "
        "[Bounik, Shamsi, Sedaaghi 2020] on features c of length 1; as published, a mean of fine displacements, a body at rest "
        "has the mean shape of its samples.",
        "`enriched.detail`, `samples`, `force`, `patch`, `triangles`, `splits`, `sigma`, `time`, or a `database`.",
        "For pictures of a coarse simulation. Not for the force: it stays that of the coarse elements; `adapt` mends it."),
    "neural": (
        "What presses taught answers those that are like them; finite elements answer all others.",
        "F = (A_0 + A(x)) d of the displacement d of the deepest point, x = (place, d); A by kernels, ridge regression, or by a "
        "perceptron. Strange is what is far from all ways to a sample, in the kernels' widths.",
        "`neural.file`, of `palpate train`; `switch_time`.",
        "For one tool of one shape on a known patch, where a cycle may take a tenth of a millisecond. Not where presses leave what "
        "was learned: there it costs what its elements cost, and is as far off."),
}
ELSEWHERE = {"cloth": "the scene `cloth` and the parts on hung and unrolling cloth have its times",
             "neural": "the part on learned presses has its error and its times, on the block that it learned"}
TEXT = """What each model is, with the formulas as they are right, and the place of its best mesh in real time on the plane above.
[theory.md](../theory.md#springs-and-tensors-for-tissue) has them whole. Boundary elements, the published interface, skin and
samples have chapters of their own."""


def place(rows, name):
    """Of the model's meshes the one with the least error that a cycle of real time allows."""
    own = [r for r in rows if r["name"].split(",")[0].strip("`") == name]
    if not own:
        elsewhere = ELSEWHERE.get(name, "this run is quick and leaves it out")
        return f"*Place:* none under this tool; {elsewhere}."
    fast = [r for r in own if 1e-3 * r["median"] <= STEP]
    best = min(fast or own, key=lambda r: r["press"])
    lead = "" if fast else "none in real time; the nearest, "
    return (f"*Place:* {lead}{best['name']}, {best['mesh']}: {best['median']:.2f} ms a cycle, {100 * best['press']:.0f} % off "
            f"pressed, {100 * best['slide']:.0f} % in the slide, {100 * best['deep']:+.0f} % 10 mm deep.")


def run(context):
    rows, _ = figures(context)
    parts = [f"**`{name}`** *Idea:* {idea} *Equations:* {equations} *Parameters:* {parameters} *Use:* {use} "
             f"{place(rows, name)}\n" for name, (idea, equations, parameters, use) in MODELS.items()]
    return f"### The models in short\n\n{TEXT}\n\n" + "\n".join(parts)
