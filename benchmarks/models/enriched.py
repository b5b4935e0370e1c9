# SPDX-License-Identifier: GPL-3.0-or-later
"""Fine shapes from coarse ones after samples, on the two published bodies."""

import numpy as np
from accuracy import plots
from accuracy.rows import table as table_of

from .program import figures
from .rows import Row, rows_table

PUBLISHED = {  # points and triangles coarse and fine, samples; seconds of five fine models; feature sizes
    "cylinder": {"counts": (182, 360, 722, 1440), "samples": (18, 10), "fine": 7.566, "all": 0.107, "ordered": 0.023,
                 "speed_up": 329, "features": 546},
    "liver": {"counts": (140, 276, 2210, 4416), "samples": (60, 45), "fine": 49.292, "all": 0.603, "ordered": 0.128,
              "speed_up": 385, "features": 420}}
WAYS = {"from_contact": "10 nearest the contact", "all_from_contact": "all, in the order from the contact",
        "all_by_number": "all, as numbered",
        "residual": "what interpolation leaves out, 10 nearest"}
COLOURS = {"from_contact": "#1f4e79", "all_from_contact": "#3a7d44", "all_by_number": "#b5322a",
           "residual": "#8a5a9e"}
TEXT = """**Idea.** A coarse body is simulated, a fine one is shown: its shape is a mean of fine samples, weighted by how alike
the coarse shapes are. What is compared are displacements of the coarse points that are nearest to the contact, nearest
first, and fine displacements are kept in the same order: a dent at one place then says something about one at another.

**Equations.** phi_ij = exp(-|c_i - c_j|^2/(2 sigma^2)) of the features c of samples i and j; A the matrix without
negative entries that has the least |Phi A - I|_F, column by column (the source's equation (3) is lost, and it does not
say which problem it solves); a = A phi(c)/sum(A phi(c)); x = X a. The source makes the sum of phi 1 instead of the sum
of a: a sample would not be its own prediction.

**Parameters.** 10 points (30 numbers), sigma; the source's best is 0.2 for both bodies, in units that it does not give.
Here sigma is a part of the root mean square distance of the samples' features, the spread.

**Bodies.** A round bar, 40 x 80 mm, held at both ends, and the package's liver, held below 15 mm; corotational, E = 5 kPa,
nu = 0.45; presses of a quarter to all of 0.3 and 1 N on patches as wide as a coarse edge, within 30 degrees of the normal,
drawn by `palpate database`'s plan. The source's shapes, forces and supports are not given. Its coarse shapes are sampled
from the fine ones, which no running simulation has: errors are given of these and of coarse elements under the same press.
Errors are root mean squares over all fine points and tests, as a part of the root mean square displacement.

**What interpolation leaves out** can be learned in place of displacements, of features of length 1, times that length and the
nearest sample's kernel: nothing at rest, nothing where nothing like it was seen. Not in the source.

**When to use it.** Measured below, beside what the source leaves out: plain interpolation of the coarse points on their
triangles, and a mesh that is fine at the contact only."""


def best(found, way, kind):
    """(width, error) of the least error."""
    k = int(np.argmin(found[way][kind]))
    return found["widths"][k], found[way][kind][k]


def picture(context, found):
    fig, axes = plots.figure(len(found), 8.0, 3.4, sharey=False)
    for axis, (name, body) in zip(np.atleast_1d(axes), found.items()):
        for way, text in WAYS.items():
            axis.semilogx(body["widths"], 100 * np.array(body[way]["sampled"]), "o-", color=COLOURS[way], label=text)
        axis.axhline(100 * body["embedded_sampled"], color="#444444", ls="--", label="interpolated")
        axis.set(xlabel="sigma / spread", title=name)
        axis.set_ylim(bottom=0)
    np.atleast_1d(axes)[0].set_ylabel("error [%]")
    np.atleast_1d(axes)[0].legend(fontsize=8)
    return plots.save(fig, context.images, "enriched.svg")


def rows(name, found):
    published = PUBLISHED[name]
    fine = float(np.mean(found["fine_seconds"]))
    keys = ("coarse_points", "coarse_triangles", "fine_points", "fine_triangles")
    made = [Row(f"{name}: {key.replace('_', ' ')}", value, "table", found[key], "")
            for key, value in zip(keys, published["counts"])]
    for way, key in (("all_by_number", "all"), ("from_contact", "ordered")):
        made.append(Row(f"{name}: finite elements over {WAYS[way]}, time", published["fine"] / published[key], "table",
                        fine / found[way]["seconds"],
                        "theirs is Python and five models at once; neither counts the coarse simulation"))
    coarse = float(np.mean(found["coarse_seconds"]))
    made.append(Row(f"{name}: the same with the coarse elements' own time", "not given", "",
                    fine / (coarse + found["from_contact"]["seconds"]), "what a running simulation gains"))
    least = [best(found, way, "sampled")[1] for way in ("from_contact", "all_by_number")]
    clearly = "clearly below 1" if name == "cylinder" else "about 1"
    made.append(Row(f"{name}: least error ordered over unordered", clearly, "curves", least[0] / least[1],
                    "with these shapes and presses"))
    return made


def table(found):
    lines = []
    for name, body in found.items():
        for way, text in WAYS.items():
            (width, sampled), (_, simulated) = best(body, way, "sampled"), best(body, way, "simulated")
            lines.append([name, text, f"{width:g}", f"{100 * sampled:.1f} %", f"{100 * simulated:.1f} %",
                          f"{1e6 * body[way]['seconds']:.0f} us"])
        lines.append([name, "interpolated on coarse triangles", "-", f"{100 * body['embedded_sampled']:.1f} %",
                      f"{100 * body['embedded_simulated']:.1f} %", "-"])
        graded = body["graded"]
        lines.append([name, f"mesh fine at the contact, {graded['nodes']:.0f} nodes, first {graded['tests']:.0f} tests", "-",
                      "-", f"{100 * graded['error']:.1f} %", f"{1e3 * graded['seconds']:.0f} ms"])
        if body["unsolved"]:
            lines.append([name, f"{body['unsolved']:.0f} presses were not solved and are left out", "-", "-", "-", "-"])
        lines.append([name, f"coarse elements, {body['coarse_nodes']:.0f} nodes", "-", "-", "as interpolated",
                      f"{1e3 * np.mean(body['coarse_seconds']):.0f} ms"])
        lines.append([name, f"fine elements, {body['fine_nodes']:.0f} nodes", "-", "-", "0: they are the truth here",
                      f"{1e3 * np.mean(body['fine_seconds']):.0f} ms"])
    return table_of(["body", "fine shape by", "best sigma / spread", "from the fine shape's own coarse points",
                     "from coarse elements", "time"], lines)


def verdict(found):
    said = []
    for name, body in found.items():
        regressed, plain = best(body, "from_contact", "simulated")[1], body["embedded_simulated"]
        said.append(f"on the {name} {100 * regressed:.0f} % against {100 * plain:.1f} % of plain interpolation")
    learned = [f"{100 * best(b, 'residual', 'simulated')[1]:.1f} %" for b in found.values()]
    worse = all(best(b, "from_contact", "simulated")[1] > b["embedded_simulated"] for b in found.values())
    return ("Of a running coarse simulation the regressor's best error is " + ", ".join(said) + ". " +
            ("**It is simply worse than interpolation**, which needs no samples: a mean of samples moves every point by "
             "what other presses moved it, interpolation only smooths what lies between points that are right."
             if worse else "It is worth its samples where that is less.") +
            f" What interpolation leaves out, learned, comes to {' and '.join(learned)}: that model `enriched` adds to its "
            "elements' surface, whose own error is most of the rest.")


def run(context):
    found = figures(context, "enriched")
    every = [row for name, body in found.items() for row in rows(name, body)]
    return (f"### Fine shapes from coarse ones\n\n{TEXT}\n\n![Error over the kernels' width]"
            f"(images/models/{picture(context, found)})\n\n{table(found)}\n\n{verdict(found)}\n\n{rows_table(every)}\n")
