# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs `palpate replay`: the real cycle, with contact, of a ball that goes down and stays."""

import json
import subprocess

import meshio
import numpy as np

from .solve import Failed, program, read_table

# A ball on one joint, z, which lifts it.
URDF = """<?xml version="1.0"?>
<robot name="ball">
  <link name="base"/>
  <link name="tip"><collision><geometry><sphere radius="{radius}"/></geometry></collision></link>
  <joint name="z" type="prismatic">
    <parent link="base"/><child link="tip"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="100" velocity="10"/>
  </joint>
</robot>
"""


def tetrahedra(folder, mesh, element):
    """Keys of an organ that is this mesh."""
    folder.mkdir(parents=True, exist_ok=True)
    mesh.for_element(element).write(folder / "body.vtu")
    return {"tetrahedra": "body.vtu", "element": element}


def press(folder, organ, support, radius, heights, contact, solver, hold=1):
    """What the ball feels: (len(heights), 3) forces at rest [N], the largest penetrations [m], and the
    rows of the replay's table. The folder keeps all of it, and a picture of the end.

    organ: keys of the scene's organ, but name and supports, with its top at z = 0; heights: of the
    ball's centre, one after the other, each reached in one step and held for `hold` more."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "ball.urdf").write_text(URDF.format(radius=radius))
    scene = {
        "gravity": [0, 0, 0],
        "organs": [{"name": "body", **organ, "supports": [{"select": support}]}],
        "instruments": [{"name": "ball", "urdf": "ball.urdf", "control_frame": "tip"}],
        "contact": contact, "solver": solver}
    (folder / "scene.yaml").write_text(json.dumps(scene, indent=1))
    step, rows = solver["step"], [(0.0, heights[0])]
    ends = []
    for height in heights:
        for _ in range(1 + hold):
            rows.append((rows[-1][0] + step, height))
        ends.append(len(rows) - 1)
    (folder / "trajectory.csv").write_text("t,z\n" + "".join(f"{t:.9g},{z:.12g}\n" for t, z in rows))
    run = subprocess.run([program(), "replay", "scene.yaml", "--trajectory", "trajectory.csv",
                          "--out", "forces.csv", "--vtu", ".", "--every", str(len(rows))], cwd=folder, stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, text=True)
    (folder / "log.txt").write_text(run.stdout)
    if run.returncode != 0:
        raise Failed(f"palpate replay {folder}/scene.yaml: {run.stdout.strip()[-600:]}")
    report = read_table(folder / "forces.csv")
    bad = [r for r in report if r["status"] != "converged"]
    if len(report) < len(rows) or bad:
        raise Failed(f"{folder}/forces.csv: {len(report)} of {len(rows)} rows, {len(bad)} not converged")

    def column(row, name):
        return float(next(v for k, v in row.items() if k.split(".")[-1] == name))
    at_rest = [report[end] for end in ends]
    forces = np.array([[column(r, k) for k in ("fx", "fy", "fz")] for r in at_rest])
    return forces, np.array([column(r, "max_penetration") for r in at_rest]), report


def size(folder):
    """Of the mesh that was pressed, in words."""
    picture = meshio.read(sorted(folder.glob("body_*.vtu"))[-1])
    return f"{len(picture.cells[0].data)} tetrahedra, {len(picture.points)} nodes"
