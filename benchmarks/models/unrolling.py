# SPDX-License-Identifier: GPL-3.0-or-later
"""B7, B17: sheets that unroll."""

import numpy as np
from accuracy import plots

from .program import figures
from .rows import Row, section

SETS = {"without": "without preload", "with": "with preload"}
TEXT = """Sheets of model `cloth`, free and without weight, begin rolled up as r = R_t (1 - c beta), and are let go. Flat they are
from when they stay within {flat:g} of their length of a plane; open by so much as their first row is from the last one, over that
at rest. The source gives no times. B7: 15 x 15 masses, 1 cm apart, of 200 g/m^2, with both sets of springs of B6 in N/m,
R_t = 22 mm, c = 0.05, drag {drag:g}/s; the older ones end after 3 s. B17: polypropylene, 40 x 100 x 0.5 mm, 90 g/m^2, E = 10 MPa,
nu = 0.3, points 2.5 mm apart, rolled 2.7 turns in a tube of R_t = 8 mm that goes away at once, c = 0.03, drag {wet:g}/s, layers
kept in [0.5, 1.2] mm; here the springs of chapter 5 are taken with their preload, or without. Computing times are of the
machine at the page's end, and of implicit steps of 1 and 0.25 ms; what lies still costs nothing."""


def at(record, time):
    return float(np.interp(time, record["t"], record["open"]))


def rows_of(name, part, found):
    without, done = found["without"], found["with"]
    end = without["t"][-1]
    rows = [Row(f"{name}, masses", "15 x 15" if part == "4.4" else "none given", part, done["masses"], ""),
            Row("with preload: flat after [s]", "none given", part, done["flat_at"], "the drag is our choice"),
            Row("computed in [s]", "none given", part, done["computing_flat"], "this machine"),
            Row("without preload, when that is flat: open by", "barely unrolled" if part == "4.4" else "much slower", part,
                at(without, done["flat_at"]), f"begins with {without['open'][0]:.2g}, for the spiral's ends are so far apart"),
            Row("without preload: flat after [s]", "none given", part,
                without["flat_at"] if without["flat_at"] >= 0 else float("nan"), f"none: not within {end:g} s"),
            Row(f"open by then, after {end:g} s", "none given", part, without["open"][-1], ""),
            Row(f"those {end:g} s computed in [s]", "none given", part, without["computing"], "this machine"),
            Row("cycles that did not converge, both", 0.0, "", without["failed"] + done["failed"], "")]
    nearest = min(without["least_gap"], done["least_gap"])
    if nearest < 1.0:
        rows.append(Row("nearest that layers came, over T_l", "1 or more", part, nearest / found["gap_least"],
                        "an energy without a bound there"))
    return rows


def draw(context, found, name, title, file):
    fig, axes = plots.figure(3, width=9.6, height=3.0)
    for axis, key in zip(axes, SETS):
        for time, (y, z) in zip(found["looks"], found[key]["profiles"]):
            axis.plot(100 * np.array(y), 100 * np.array(z), label=f"{time:g} s", linewidth=1.2)
        axis.set(title=f"{name}, {SETS[key]}", xlabel="y [cm]", ylabel="z [cm]")
        axis.set_aspect("equal", adjustable="datalim")
    axes[1].legend(fontsize=7)
    for key, colour in zip(SETS, ("tet10", "anp")):
        axes[2].plot(found[key]["t"], found[key]["open"], color=plots.COLOUR[colour], label=SETS[key])
    axes[2].axvline(found["with"]["flat_at"], color=plots.COLOUR["reference"], linestyle="--", label="flat, with preload")
    axes[2].set(xlabel="t [s]", ylabel="open", ylim=(0, 1.05))
    axes[2].legend(fontsize=7, frameon=True, framealpha=1.0, edgecolor="white")
    return plots.save(fig, context.images, file), title


def run(context):
    found = figures(context, "unrolling")
    cloth, mesh = found["demonstration"], found["polypropylene"]
    pictures = [draw(context, cloth, "B7", "15 x 15 masses that unroll: the middle line at a few times, and how far open they are",
                     "unrolling_cloth.svg"),
                draw(context, mesh, "B17", "Polypropylene that unrolls, likewise", "unrolling_mesh.svg")]
    text = TEXT.format(flat=cloth["flat"], drag=cloth["drag"], wet=mesh["drag"])
    return section("B7, B17: unrolling (4.4, 6.4.2)", text,
                   rows_of("B7", "4.4", cloth) + rows_of("B17", "6.4.2", mesh), pictures)
