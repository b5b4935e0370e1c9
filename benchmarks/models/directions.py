# SPDX-License-Identifier: GPL-3.0-or-later
"""B11: regular sheets in every direction."""

import numpy as np
from accuracy import plots

from .program import figures
from .rows import Row, section

POISSON = 0.3
STRETCH, BENDING = (3 * POISSON - 1) / (3 * (1 - POISSON)), (3 * POISSON - 1) / 4
PRINTED = {0.0: (0.535, 0.50), 22.5: (0.714, None), 45.0: (0.857, 0.20)}  # degrees: modulus, Poisson's ratio
TEXT = """An endless sheet of squares and one of equilateral triangles, 2 cm apart, h = 0.1 cm, nu = 0.3, are pulled
along a direction, free to contract, and bent to a cylinder. Theory makes the modulus of both E h (1 + (3 nu - 1)/(3
(1 - nu))), the bending stiffness D (1 + (3 nu - 1)/4) and Poisson's ratio 1/3 in every direction. Squares with
(5.102) as printed, with 8 where (5.86) and (5.100) demand 4, do not have that; their figures are those of the text's
own assumption that the sheet does not shear. Where it may (dotted), it gives way more between the axes."""
MESHES = ("triangles", "squares")


def run(context):
    found = figures(context, "directions")
    degrees = np.array(found["degrees"])
    rows = []
    for name in MESHES:
        values = {k: np.array(v) for k, v in found[name].items()}

        def worst(key, expected, values=values):
            return values[key][np.abs(values[key] - expected).argmax()]
        every = f"{name}, the direction that is farthest off of {len(degrees)}"
        rounding = "rounding"
        rows += [Row(f"E h of {every}", 1 + STRETCH, "(5.107)", worst("modulus", 1 + STRETCH), rounding),
                 Row(f"Poisson's ratio of {every}", 1 / 3, "5.3.1", worst("poisson_ratio", 1 / 3), rounding),
                 Row(f"D of {every}", 1 + BENDING, "(5.77)", worst("bending", 1 + BENDING),
                     "the next order of the curvature, and what is lost where energies are subtracted")]
    for angle, (modulus, poisson) in PRINTED.items():
        at = int(np.abs(degrees - angle).argmin())
        values = found["squares_as_printed"]
        why = "digits of the published figure"
        rows.append(Row(f"E h of squares as printed, {angle:g} degrees", modulus, "(5.102) in another program",
                        values["straight_modulus"][at], why))
        if poisson:
            rows.append(Row(f"Poisson's ratio of squares as printed, {angle:g} degrees", poisson,
                            "(5.102) in another program", values["straight_poisson_ratio"][at], why))
    fig, axes = plots.figure(2, width=8.4)
    for ax, key, label in ((axes[0], "modulus", "modulus over E h"), (axes[1], "poisson_ratio", "Poisson's ratio")):
        ax.plot(degrees, found["triangles"][key], color=plots.COLOUR["anp"], linewidth=3, label="triangles")
        ax.plot(degrees, found["squares"][key], "--", color=plots.COLOUR["tet10"], label="squares")
        ax.plot(degrees, found["squares_as_printed"]["straight_" + key], color=plots.COLOUR["tet4"],
                label="squares as printed")
        ax.plot(degrees, found["squares_as_printed"][key], ":", color=plots.COLOUR["tet4"],
                label="the same, free to shear")
        ax.set(xlabel="direction [degrees]", ylabel=label, xticks=range(0, 91, 15))
    axes[0].legend()
    axes[0].set_ylim(0, 1.02)
    axes[1].set_ylim(0, 0.6)
    return section("B11: stretch and bending in every direction (5.3.1)", TEXT, rows,
                   [(plots.save(fig, context.images, "directions.svg"),
                     "Modulus and Poisson's ratio of regular sheets over the direction")])
