# SPDX-License-Identifier: GPL-3.0-or-later
"""Table 2.1: what models are said to do, beside what they did."""

from accuracy.rows import table as table_of

from .touched import figures

# Model, what the source says of it (efficiency; large deformation; cut and suture beside what is computed before;
# theory), which of ours it is, and what a cut would void there.
MODELS = [
    ("mass-spring", ("real time", "yes", "n/a", "incomplete"), "`mass_spring`", "nothing: a spring is dropped"),
    ("finite elements", ("very slow", "no", "no", "solid"), "`fem`, `anp`", "factors, made anew beside the cycles"),
    ("finite spheres", ("very slow", "no", "no", "solid"), None, ""),
    ("elasticity, sampled", ("real time", "no", "n/a", "solid"), "`sampled_elasticity`",
     "nothing: neighbours are found anew"),
    ("tensor-mass", ("barely real time", "no", "yes", "solid"), "`tensor_mass`", "the cut tetrahedra's own tensors"),
    ("quasi-static, precomputed", ("barely real time", "no", "no", "solid"), "`fem`, `linear_precomputed`",
     "all that was computed before"),
    ("hybrid", ("barely real time", "no", "yes", "solid"), "`hybrid`", "in its region no more than of tensor-mass"),
    ("cells full of fluid (ch. 3)", None, "`honeycomb`", "the two cells' walls"),
]
TEXT = """What the source says of models it reviews (Table 2.1), and what those of this package did under the tool above,
each on tetrahedra with edges of 6 mm or, of other cells, with nearest to as many nodes: cycles a second (median of those
in touch), error pressed, error 10 mm deep against converged finite elements of the same material. The package neither cuts
nor sutures with any model; the last column says what of the work that a model does before its first cycle a cut would
void, by how it is built, not by a measurement. Finite spheres are not in the package."""


NODES = 2769  # of tetrahedra with edges of 6 mm


def chosen(measured, name):
    """Of a model's meshes the first of those with nearest to so many nodes."""
    return min((r for r in measured if r["name"] == name), key=lambda r: abs(r["nodes"] - NODES), default=None)


def run(context):
    measured, _ = figures(context)
    lines = []
    for model, said, name, void in MODELS:
        row = chosen(measured, name) if name else None
        ours = [name, row["mesh"], f"{1e3 / row['median']:.0f} Hz", f"{100 * row['press']:.0f} %",
                f"{100 * row['deep']:+.0f} %"] if row else ["-"] * 5
        lines.append([model, *(said or ["-"] * 4), *ours, void if row else ""])
    table = table_of(["model", "efficiency", "large deformation", "precomputation with cut and suture", "theory",
                      "ours", "mesh", "rate", "error, pressed", "10 mm deep", "a cut would void"], lines)
    return f"### Table 2.1: the models beside each other\n\n{TEXT}\n\n{table}\n"
