# SPDX-License-Identifier: GPL-3.0-or-later
"""B1: a thousand cells full of fluid, pushed and dragged."""

import numpy as np

from accuracy.rows import table as table_of

from .rows import Row, section
from .scene import Replay, material

SIDE, CELL = 0.1, 0.01  # [m]
# t [s], x, z [mm] of the ball above where it would touch: push, then drag.
MOTION = [(0, -10, 2), (0.1, -10, 2), (0.4, -10, -5), (0.6, -10, -5), (1.2, 10, -5), (1.4, 10, -5)]
PUSHED, DRAGGED = (0.1, 0.6), (0.6, 1.4)  # [s]
TEXT = """A cube of 10 cm in cells of 1 cm, on a table, pushed 5 mm deep by a ball of 5 mm that clings to it, and
dragged 2 cm, with E = 10 kPa, each cycle solved until no side moves farther than 1 um in a wave of forces. The source
calls the surface jerky at large deformation (3.6): the largest jump of the force from a cycle to the next is in the
table."""
WHY = "a Pentium IV of 2 GHz there, a core of this machine here; its threshold and cut-off are not given"


def cube(folder):
    folder.mkdir(parents=True, exist_ok=True)
    corners = [(x, y, z) for z in (0, SIDE) for y in (-SIDE / 2, SIDE / 2) for x in (-SIDE / 2, SIDE / 2)]
    sides = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (2, 4, 8, 6), (4, 3, 7, 8), (3, 1, 5, 7)]
    file = folder / "cube.obj"
    file.write_text("".join(f"v {x} {y} {z}\n" for x, y, z in corners) +
                    "".join(f"f {a} {b} {c}\nf {a} {c} {d}\n" for a, b, c, d in sides), encoding="utf-8")
    return str(file)


def replay(context, volume):
    folder = context.work / "cells" / volume
    cell = 2 * CELL if context.quick else CELL
    organ = {"surface": cube(folder), "edge_length": 0.02, "model": "honeycomb", "material": material(0.49),
             "honeycomb": {"cell_size": cell, "volume": volume}}
    return Replay(folder, organ, MOTION, top=SIDE, friction=0.8)


def run(context):
    found = {volume: replay(context, volume) for volume in ("linear", "exact")}
    rows, lines = [], []
    for volume, r in found.items():
        for word, phase in (("pushed", PUSHED), ("dragged", DRAGGED)):
            ms = r.ms[r.within(*phase) & r.touches]
            rows.append(Row(f"B1 cycles a second, 1000 cells, volumes {volume}, {word}", 100.0, "3.5",
                            1e3 / np.mean(ms), WHY))
            lines.append([volume, word, f"{np.median(ms):.1f}", f"{np.percentile(ms, 99):.1f}",
                          str(int((~r.good)[r.within(*phase)].sum())), str(len(ms)),
                          f"{np.abs(np.diff(r.force[r.within(*phase), 2])).max():.3f}",
                          f"{r.force[r.within(*phase), 2].max():.3f}"])
    table = table_of(["volumes", "", "ms a cycle: median", "p99", "cycles not solved", "of",
                      "largest jump of the force [N]", "largest force [N]"], lines)
    return section("B1: a thousand cells full of fluid (3.5)", TEXT + "\n\n" + table, rows)
