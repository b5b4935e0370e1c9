# SPDX-License-Identifier: GPL-3.0-or-later
"""B9, B10: what free ends and edges do."""

import math

import numpy as np

from .program import figures
from .rows import Row, section

TEXT = """A free beam of 32 cm with 30 masses, and free sheets of 32 x 24 cm with spacings of 2 cm, all 0.1 cm thick,
come to rest under their preload. Without flexion stiffness (k2 = 0) only the outermost springs shorten, by s0 =
h^2/(6 U^2) of U in a beam and h^2/(6 U^2 + h^2) in squares. With c = k1/k2, shortenings decay by the root of appendix
B that is in (-1, 1)."""


def run(context):
    found = figures(context, "ends")
    h, U, spacing = found["thickness"], found["beam_spacing"], found["sheet_spacing"]
    beam, strip = np.array(found["beam"]), np.array(found["strip"])
    exact = h * h / (6 * U * U)
    rows = [Row("beam, k2 = 0, outermost spring", exact, "(P1 + P2)/k1, appendix B", beam[0], "rounding"),
            Row("the most of any other spring", 0.0, "5.2.4", np.abs(beam[1:-1]).max(), "rounding")]
    for c, shortenings in found["beam_by_stiffness_ratio"].items():
        root = 0.5 * (-(2 + float(c)) + math.sqrt(float(c) ** 2 + 4 * float(c)))
        rows.append(Row(f"beam, k1/k2 = {c}: second over first spring past the end's", root, "appendix B",
                        shortenings[2] / shortenings[1], "the far end, and rounding where springs hardly shorten"))
        if float(c) >= 1.0:
            rows.append(Row("the same: most beyond two springs from the end, of U", "negligible", "5.2.4",
                            max(np.abs(shortenings[2:-2])), f"the root's square, {root * root:.2g} of the end's"))
    square = h * h / (6 * spacing ** 2 + h * h)
    rows += [Row("endless strip of squares, outermost spring", square, "5.3.3", strip[0],
                 "preload that turns with the springs, h^2/U^2 of it"),
             Row("the most of any other spring, over that", 0.0, "5.3.3", np.abs(strip[1:-1]).max() / strip[0],
                 "the same"),
             Row("free sheet of squares, outermost spring of the middle row", square, "5.3.3", found["squares"][0],
                 "edges along the row lack half of their diagonals and pull, which strains all of the sheet"),
             Row("the most of any other spring of the row", "negligible", "5.3.3",
                 np.abs(found["squares"][1:-1]).max(), "the same"),
             Row("free sheet of triangles: the most from the fourth spring of the middle row on, over the squares' s0",
                 "smaller", "5.3.3", np.abs(found["triangles"][3:-3]).max() / square, "", 1.0),
             Row("its outermost springs, mean of both ends, over the squares' s0", "smaller", "Table 5.1",
                 np.array(found["triangles"])[[0, -1]].mean() / square, "", 1.0),
             Row("the one of them that shortens most, over the squares' s0", "smaller", "Table 5.1",
                 max(found["triangles"][0], found["triangles"][-1]) / square,
                 "the edge is a zigzag: a mass that juts out has fewer springs than one that is set back", 1.0)]
    return section("B9, B10: free ends and edges (5.2.4, 5.3.3)", TEXT, rows)
