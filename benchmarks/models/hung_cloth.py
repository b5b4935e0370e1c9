# SPDX-License-Identifier: GPL-3.0-or-later
"""B6: cloth that hangs from two corners."""

import numpy as np
from accuracy import plots

from .program import figures
from .rows import Row, section

NAMES = {"older": "without preload", "newer": "with preload"}
# Per mass, by the curvature squared: D A/2 of the plate with nu = 1/3, and by its fourth power: flexion 2/9, structural
# 1/288, shear 2.4/1152.
NEWER, OLDER = 9 / 16, 2 / 9 + 1 / 288 + 2.4 / 1152
TEXT = """Square cloth of {side} x {side} masses a distance U apart hangs by two corners that are opposite. Older springs: squares,
structural and flexion 4.0, shear 2.4, without preload. Newer ones: triangles, structural 4.0, flexion 0.5 and preload,
F = 4.0 u and 0.5 (u - 6 U). The source gives neither weights nor figures; here a mass weighs a part of 4.0 U. Sag is that of
the lowest mass over the diagonal that is held, openness the distance of the two free corners over that of the flat cloth:
without preload the cloth folds about the diagonal. *Bending* is the energy of a mass far from the edges in cloth that is
bent to a cylinder of curvature rho, over the other springs'; it falls as 1/(U rho)^2, for springs without preload resist
with rho^4 only. The newer springs also sag by stretch, for which those of chapter 4 are too soft."""


def draw(context, found, at):
    fig, axes = plots.figure(2, width=8.8, height=4.0, subplot_kw={"projection": "3d"})
    side = int(found["side"])
    quads = np.arange(side * side).reshape(side, side)
    for axis, name, colour in zip(axes, NAMES, ("tet10", "anp")):
        x, y, z = (np.array(found[name][at][c])[quads] for c in "xyz")
        axis.plot_surface(x, y, z, color=plots.COLOUR[colour], edgecolor="white", linewidth=0.3, rstride=1, cstride=1)
        axis.set(title=NAMES[name], xlim=(0, side), ylim=(0, side), zlim=(-0.75 * side, 0.25 * side))
        axis.set_box_aspect((1, 1, 1))
        axis.view_init(elev=12, azim=-70)
        axis.set_xticks([]), axis.set_yticks([]), axis.set_zticks([])
    return plots.save(fig, context.images, "hung_cloth.svg")


def run(context):
    found = figures(context, "hung_cloth")
    rows = []
    for k, weight in enumerate(found["weights"]):
        for name, words in NAMES.items():
            rows.append(Row(f"sag {words}, a mass weighs {weight:g}", "none given", "4.4", found[name][k]["sag"],
                            "the picture alone is in the source"))
            rows.append(Row("its openness", "none given", "4.4", found[name][k]["open"], "1: flat; 0: folded together"))
    for rho, older, newer in zip(found["curvatures"], found["older_bending"], found["newer_bending"]):
        rows.append(Row(f"bending, with preload over without, U rho = {rho:g}", NEWER / (OLDER * rho ** 2),
                        "closed form, small rho; 4.4: far stiffer", newer / older, "next powers of rho"))
    rho, newer = found["curvatures"][0], found["newer_bending"][0]
    rows.append(Row(f"with preload, over D A rho^2/2, U rho = {rho:g}", 1.0, "(4.38), nu = 1/3",
                    newer / (NEWER * rho ** 2), "next powers of rho, rounding"))
    return section("B6: hung cloth (4.4)", TEXT.format(side=int(found["side"])), rows,
                   [(draw(context, found, 1), f"Both at rest, a mass weighs {found['weights'][1]:g}")])
