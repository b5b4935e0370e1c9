# SPDX-License-Identifier: GPL-3.0-or-later
"""B4: a free sheet of 21 x 21 masses."""

import numpy as np

from .program import figures
from .rows import Row, section

CLAIM = "below 1 %"
TEXT = """21 x 21 masses in equilateral triangles with the springs of chapter 4 (k1 : k2 = 8 : 1, rest lengths 0 and 6
U) come to rest in their plane. The text says that springs more than two structural springs from the boundary keep
their length within 1 %. Lengths are changes over the spacing."""


def run(context):
    found = figures(context, "free_sheet")
    along, across = np.array(found["along_the_middle_row"]), np.array(found["across_the_rows"])

    def largest(values):
        return values[np.abs(values).argmax()]
    rows = [Row("middle row, from the third spring on", CLAIM, "4.3.4", largest(along[2:-2]), "", 0.01),
            Row("across the rows in the middle, from the second on", CLAIM, "4.3.4", largest(across[1:-1]), "", 0.01),
            Row("all springs between masses three nodes inside", CLAIM, "4.3.4", found["worst_three_nodes_inside"],
                "corners: the strain of two edges adds up there; the claim holds along the middle", 0.01),
            Row("middle row, first and last spring", "more", "4.3.4", min(along[0], along[-1]),
                "the end with the mass that juts out"),
            Row("its other end", "more", "4.3.4", max(along[0], along[-1]), "the end that is set back"),
            Row("middle row, second springs", "more", "4.3.4", largest(along[[1, -2]]), ""),
            Row("across the rows, first and last", "more", "4.3.4", largest(across[[0, -1]]), "")]
    return section("B4: free sheet of 21 x 21 masses (4.3.4)", TEXT, rows)
