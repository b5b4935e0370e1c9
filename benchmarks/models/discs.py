# SPDX-License-Identifier: GPL-3.0-or-later
"""B5, B12: clamped discs."""

import numpy as np
from accuracy import plots

from .program import figures
from .rows import Row, section

CLOSED_SMALLEST = 6 * np.sqrt(3) * (1 + 0.3) / (16 * np.pi)  # (4.64) over (4.62), n = 1
CHECKED = {"triangles": {1: .269, 2: .438, 4: .632, 8: .775, 16: .879, 32: .931},
           "squares": {1: .388, 2: .500, 4: .668, 8: .810, 16: .888, 32: .931}}
SOURCE = "5.3.4, network of another program"
STIFFENED = {"triangles": (1.09, 7.1), "squares": (1.15, 7.4)}  # n = 8, at h and 5 h
TEXT = """A disc of radius 10 cm, h = 0.01 cm, nu = 0.3, n spacings in its radius, is clamped (its rim and three rings
of masses beyond are held) and pushed in the middle. Its stiffness is a part of the plate's, 16 pi D/a^2 (4.62). For
many masses both meshes go to 3/4 (1 + nu) of it, for springs contract as with nu = 1/3. Without preload nothing
resists a small deflection."""


def run(context):
    found = figures(context, "discs")
    n, large = [int(i) for i in found["n"]], found["large"]
    rows = [Row("triangles, n = 1", CLOSED_SMALLEST, "(4.64)", found["triangles"][0], "rounding")]
    for mesh, values in CHECKED.items():
        rows += [Row(f"{mesh}, n = {i}", values[i], SOURCE, found[mesh][n.index(i)], "three digits are given")
                 for i in n if i in values]
        rows.append(Row(f"{mesh}, limit of many masses, at n = {n[-1]}", 0.975, "3/4 (1 + nu)", found[mesh][-1],
                        "n is finite; the difference falls about as 1/n"))
        rows.append(Row(f"{mesh}, n = {n[-1]}, nu = 1/3", 1.0, "(4.62)", found[f"{mesh}_of_one_third"],
                        "n is finite; no error of Poisson's ratio is left"))
    rows.append(Row(f"either mesh without preload, n = 1 to {n[-1]}, small deflections", 0.0, "(4.64), 4.3.5",
                    max(found["without_preload"]), "the largest stiffness across the sheet, over that with preload"))
    thick = np.array(large["thicknesses"])
    for mesh, (at_1, at_5) in STIFFENED.items():
        for times, value in ((1, at_1), (5, at_5)):
            if large["n"] != 8:
                continue
            ours = large[mesh][int(np.abs(thick - times).argmin())]
            rows.append(Row(f"{mesh}, n = 8, deflected by {times} h", value, SOURCE, ours, "the digits given"))
    rows += [Row(f"triangles, n = {large['n']:g}, deflected by 5 h = {5 * 0.01 * large['n'] / 10:.2g} U", 1.0,
                 "5.3.4: as the plate below U", large["triangles"][-1],
                 "a clamped sheet stretches beyond h; with k of chapter 5, which grows with h, any mesh of it does"),
             Row("squares over triangles there", "much higher", "5.3.4", large["squares"][-1] / large["triangles"][-1],
                 "not found with k of chapter 5 for both"),
             Row("the same, triangles of chapter 4", "much higher", "5.3.4",
                 large["squares"][-1] / large["bending_triangles"][-1],
                 "these have k for bending only; a comparison of two k, not of two meshes")]
    for part, ratio in zip(large["spacings"], large["bending_triangles_by_spacings"]):
        rows.append(Row(f"triangles of chapter 4, n = {large['n']:g}, deflected by {part:g} U", 1.0,
                        "4.3.5: as the plate below U", ratio,
                        f"n is finite, {large['bending_triangles'][0]:.3f} for small ones; beyond, the sheet stretches"))
    bare = large["bending_triangles_without_preload_by_spacings"]
    rows.append(Row(f"the same without preload, {large['spacings'][0]:g} U", "much smaller, not linear", "4.3.5",
                    bare[0], "no linear term: its force grows with the cube of the deflection"))
    fold = np.log(bare[1] / bare[0]) / np.log(large["spacings"][1] / large["spacings"][0]) + 1
    rows.append(Row("power of the deflection with which it grows", 3.0, "(4.64) without its linear term", fold,
                    "the next power"))
    fig, axes = plots.figure(2, width=8.8)
    for mesh, colour in (("triangles", "anp"), ("squares", "tet10")):
        axes[0].semilogx(n, found[mesh], "o-", base=2, color=plots.COLOUR[colour], label=mesh)
        axes[1].plot(thick, large[mesh], "o-", color=plots.COLOUR[colour], label=mesh)
        axes[1].plot(thick, large[f"{mesh}_without_preload"], "o:", color=plots.COLOUR[colour],
                     label=f"{mesh} without preload")
    axes[1].plot(thick, large["bending_triangles"], "o-", color=plots.COLOUR["p1p1"], label="triangles of chapter 4")
    axes[1].plot(thick, large["bending_triangles_without_preload"], "o:", color=plots.COLOUR["p1p1"],
                 label="the same without preload")
    axes[0].semilogx(n, found["without_preload"], "o:", base=2, color=plots.COLOUR["tet4"],
                     label="either without preload")
    axes[0].axhline(0.975, color=plots.COLOUR["reference"], linestyle="--", label="3/4 (1 + nu)")
    axes[0].set(xlabel="n", ylabel="stiffness over 16 pi D/a$^2$", ylim=(-0.02, 1.02), xticks=n, xticklabels=n)
    axes[1].set(xlabel=f"deflection over h, n = {large['n']:g}", ylabel="force over the linear plate's")
    axes[0].legend(loc="center right")
    axes[1].legend(fontsize=8)
    return section("B5, B12: clamped discs (4.3.5, 5.3.4)", TEXT, rows,
                   [(plots.save(fig, context.images, "clamped_discs.svg"),
                     "Stiffness of clamped discs over n and over the deflection")])
