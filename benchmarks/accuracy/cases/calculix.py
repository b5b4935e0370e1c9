# SPDX-License-Identifier: GPL-3.0-or-later
"""The same meshes, laws and supports in palpate and in CalculiX."""

import numpy as np
from scipy.spatial.transform import Rotation

from .. import ccx, meshes
from ..rows import Row, Section, table
from ..solve import plane, reaction, solve

CASE = "CalculiX"
QUICK = True
NEEDS = (ccx,)
# CalculiX prints seven digits, so that each figure is off by up to 5e-7 of itself, and its Newton iteration
# ends at 1e-8 of the displacements. Sums over the nodes of an end, which cancel in part, lose another digit.
BOUND = 1e-5
LENGTH, WIDTH = 0.12, 0.04  # [m]
MU, KAPPA = 2.0e3, 2.0e4  # [Pa]
LAWS = [
    {"law": "neo_hookean", "mu": MU, "kappa": KAPPA},
    {"law": "mooney_rivlin", "c10": 0.6e3, "c01": 0.4e3, "kappa": KAPPA},
    {"law": "yeoh", "c1": 1.0e3, "c2": 0.3e3, "c3": 0.1e3, "kappa": KAPPA},
    {"law": "st_venant_kirchhoff", "mu": MU, "kappa": KAPPA},
]
# What happens to the far end of the bar: turn [rad] about an axis through its middle, then a shift.
LOADS = {
    "twist 90 deg": {"axis": [0, 0, 1], "angle": np.pi / 2, "shift": [0, 0, 0]},
    "bend 60 deg": {"axis": [1, 0, 0], "angle": np.pi / 3, "shift": [0, -0.05, -0.02]},
    "pull 50 %": {"axis": [0, 0, 1], "angle": 0.0, "shift": [0, 0, 0.06]},
    "press 20 %, shear": {"axis": [0, 0, 1], "angle": 0.0, "shift": [0.02, 0, -0.024]},
}
STEPS = 6


def _bar(element, cells):
    return meshes.box((WIDTH, WIDTH, LENGTH), cells).for_element(element)


def _targets(mesh, load):
    """The prescribed displacements of both ends, step by step."""
    z = mesh.points[:, 2]
    low, high = np.flatnonzero(z < 1e-12), np.flatnonzero(z > LENGTH - 1e-12)
    origin = np.array([WIDTH / 2, WIDTH / 2, LENGTH])
    steps = []
    for k in range(1, STEPS + 1):
        turn = Rotation.from_rotvec(np.array(load["axis"]) * load["angle"] * k / STEPS)
        x = mesh.points[high]
        moved = turn.apply(x - origin) + origin - x + np.array(load["shift"]) * k / STEPS
        steps.append({**{i: np.zeros(3) for i in low}, **dict(zip(high, moved))})
    return steps, low, high


def _compare(folder, mesh, element, material, load):
    """Largest difference of a node's displacement, and difference of the force on the near end,
    each as a part of the largest; and that force."""
    steps, low, high = _targets(mesh, load)
    far = plane("z", LENGTH)
    turn = {"axis": load["axis"], "angle": load["angle"], "origin": [WIDTH / 2, WIDTH / 2, LENGTH]}
    mine = solve(folder / "palpate", mesh, element, material,
                 [{"select": plane("z", 0.0), "displacement": [0, 0, 0]},
                  {"select": far, "rotation": turn, "displacement": load["shift"]}],
                 [reaction("near", plane("z", 0.0)), reaction("far", far)],
                 {"load_steps": 12, "tolerance": 1e-12})
    u, f = ccx.solve(folder / "ccx", mesh, material, steps)
    du = np.abs(mine.displacement - u).max() / np.abs(u).max()
    # A twist has no resultant force: forces are compared by halves of the far end, x below and
    # above the middle, whose sums are the resultant and the couple.
    half = [[i for i in high if side * (mesh.points[i, 0] - WIDTH / 2) >= -1e-12] for side in (-1, 1)]
    sums = [(mine.reaction[nodes].sum(axis=0), f[nodes].sum(axis=0)) for nodes in (*half, low)]
    scale = max(np.linalg.norm(theirs) for _, theirs in sums)
    df = max(np.linalg.norm(a - b) for a, b in sums) / scale
    return du, df, np.linalg.norm(sums[0][0]), np.linalg.norm(sums[0][1])


def run(context):
    rows, lines = [], []
    elements = [("tet4", (3, 3, 9)), ("tet10", (2, 2, 5))]
    for element, cells in elements:
        mesh = _bar(element, cells)
        for load_name, load in LOADS.items():
            line = [element, mesh.size(), load_name]
            for material in LAWS:
                if context.quick and (material["law"], load_name) not in QUICK_PAIRS:
                    continue
                name = f"{element}_{load_name}_{material['law']}".replace(" ", "_").replace("%", "pc")
                du, df, mine, theirs = _compare(context.folder(CASE, name), mesh, element, material, load)
                where = f"{material['law']}, {load_name}"
                rows.append(Row(CASE, mesh.size(), element, f"{where}: nodal displacements, largest "
                                "difference / largest", du, 0.0, ccx.version(), BOUND, du))
                rows.append(Row(CASE, mesh.size(), element, f"{where}: force on a half of the end [N]",
                                mine, theirs, ccx.version(), BOUND, df))
                line.append(f"{du:.1e} / {df:.1e}")
                context.progress(f"{name}: displacement {du:.1e}, force {df:.1e}")
            lines.append(line)
    head = ["element", "mesh", "load", *(m["law"] for m in LAWS)]
    text = (f"A bar of {1e3 * WIDTH:g} x {1e3 * WIDTH:g} x {1e3 * LENGTH:g} mm with both ends held is "
            f"twisted, bent, pulled and pressed in palpate and in {ccx.version()}, on the same mesh, "
            "with the same law and constants. What is left is rounding, and the seven digits that "
            "CalculiX prints. Two independent programs that agree to five digits have the same "
            "energies, the same kinematics, and the same signs and units of forces.\n\n"
            "Each cell: largest difference of a node's displacement / difference of the support "
            f"forces, both as parts of the largest value. Bound: {BOUND:g}.")
    return Section("The same mesh in CalculiX", text, rows, tables=[] if context.quick else [table(head, lines)])


QUICK_PAIRS = {("neo_hookean", "twist 90 deg"), ("st_venant_kirchhoff", "bend 60 deg"),
               ("yeoh", "press 20 %, shear"), ("mooney_rivlin", "pull 50 %")}
