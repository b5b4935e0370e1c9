# SPDX-License-Identifier: GPL-3.0-or-later
"""A block under the shipped probe, of any model, and what its replay says."""

import subprocess

import numpy as np
import yaml

from accuracy.solve import ROOT, Failed, program, read_table

RADIUS, TOP = 0.005, 0.03  # of the ball, of the slab [m]
ABOVE = 0.07  # the probe's base above the top [m]
STEP = 0.005  # [s]
SUPPORT = {"select": {"plane": {"axis": "z", "at": 0.0, "tolerance": 1e-4}}}


def material(poisson_ratio):
    return {"law": "neo_hookean", "young_modulus": 1e4, "poisson_ratio": poisson_ratio, "density": 1000.0}


def write_scene(folder, organ, solver, base, friction):
    """The scene of config/scenes/slab_probe.yaml with this organ in the place of its slab."""
    slab = {"name": "slab", "surface": str(ROOT / "config/organs/slab.obj"), "supports": [SUPPORT]}
    scene = {"name": "slab", "gravity": [0, 0, 0], "organs": [{**slab, **organ}],
             "instruments": [{"name": "probe", "urdf": str(ROOT / "config/instruments/probe.urdf"),
                              "base": {"position": [0, 0, base]}, "input": "joints", "control_frame": "tip"}],
             "solver": {"step": STEP, "threads": 1, **solver}}
    if friction > 0.0:
        scene["contact"] = {"friction": {"pairs": [{"instrument": "probe", "static": friction, "kinetic": friction}]}}
    file = folder / "scene.yaml"
    file.write_text(yaml.safe_dump(scene, sort_keys=False), encoding="utf-8")
    return file


def write_motion(folder, waypoints):
    """Rows t [s], x, z [mm] of the ball's centre above where it would touch, by minimum-jerk parts."""
    times = np.arange(0.0, waypoints[-1][0] + 0.5 * STEP, STEP)
    at = np.array([w[0] for w in waypoints])
    k = np.clip(np.searchsorted(at, times, side="right") - 1, 0, len(at) - 2)
    s = np.clip((times - at[k]) / (at[k + 1] - at[k]), 0.0, 1.0)
    s = s ** 3 * (10.0 - 15.0 * s + 6.0 * s * s)
    ways = [1e-3 * (np.array([w[c] for w in waypoints])[k] * (1 - s) + np.array([w[c] for w in waypoints])[k + 1] * s)
            for c in (1, 2)]
    rows = np.column_stack([times, ways[0], 0 * times, RADIUS + ways[1] - ABOVE, 0 * times, 0 * times, 0 * times])
    file = folder / "motion.csv"
    np.savetxt(file, rows, delimiter=",", header="t,x,y,z,roll,pitch,yaw", comments="", fmt="%.9g")
    return file


class Replay:
    """Of one block: t [s], force (n, 3) [N], ms of each cycle, whether it touches and was solved, nodes, least
    det F. `top`: of the block [m]."""

    def __init__(self, folder, organ, waypoints, solver=None, top=TOP, friction=0.0):
        folder.mkdir(parents=True, exist_ok=True)
        out = folder / "replay.csv"
        scene = write_scene(folder, organ, solver or {}, top + ABOVE, friction)
        command = [program(), "replay", scene, "--trajectory", write_motion(folder, waypoints), "--out", out,
                   "--threads", "1"]
        done = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        if done.returncode not in (0, 1):  # 1: cycles that did not converge, which the table shows
            raise Failed(done.stderr.strip() or f"palpate replay: status {done.returncode}")
        rows = read_table(out)

        def column(name):
            return np.array([float(r[name]) for r in rows])
        self.t, self.ms = column("t"), column("step_ms")
        self.force = np.column_stack([column(c) for c in ("fx", "fy", "fz")])
        self.touches = column("contacts") > 0
        self.good = np.array([r["status"] == "converged" for r in rows])
        self.nodes, self.least = int(column("nodes").max()), column("min_jacobian").min()

    def within(self, begin, end):
        return (self.t > begin + 1e-9) & (self.t < end + 1e-9)
