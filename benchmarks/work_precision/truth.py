# SPDX-License-Identifier: GPL-3.0-or-later
"""The force that a motion has in a scene with no error of the mesh, from meshes far finer than those that are
judged, extrapolated, and how far a replay is off it."""

import concurrent.futures
import dataclasses
import hashlib
import os

import numpy as np

from accuracy import bounds

from . import bracket, norms
from .replays import adapted, but, play

ORDER = 2  # of linear elements in forces, see converged.py
GROWTH = 0.3  # of meshes that follow the tool, finer than by default
# Twice as many steps of second order and tighter tolerances than scenes have.
SOLVER = {"integrator": "bdf2", "tolerance": 1e-5, "max_newton_iterations": 50}


@dataclasses.dataclass
class Truth:
    """Forces (k, 3) [N] at times (k) [s], extrapolated from the two finest meshes."""
    times: np.ndarray
    forces: np.ndarray
    sizes: list  # of the meshes: (edge [m], nodes, peak force [N])
    unknown: float  # RMS of what the extrapolation adds to the finest mesh, as a part of the RMS force

    @property
    def peak(self):
        return norms.peak(self.forces)

    def line(self, title):
        """Of a table with HEAD."""
        limit, order = bounds.extrapolated([h for h, _, _ in self.sizes], [f for _, _, f in self.sizes])
        return [title, *(f"{1e3 * h:g} mm, {n:.0f}: {f:.4f} N" for h, n, f in self.sizes), f"{self.peak:.4f} N",
                f"{limit:.4f} N ({order:.2f})" if np.isfinite(limit) else "-", f"{100 * self.unknown:.1f} %"]

    def at(self, played):
        """At the times of a Played, (k, 3)."""
        return self.forces[norms.at(self.times, played.times)]

    def errors(self, played):
        """Errors of a Played; of one with cycles that did not converge as well."""
        truth = self.at(played)
        error, size = np.linalg.norm(played.forces - truth, axis=1), np.linalg.norm(truth, axis=1)
        return Errors(float(np.sqrt(np.mean(error ** 2) / np.mean(size ** 2))), played.peak / float(size.max()) - 1.0,
                      float(error.max() / size.max()))

    def bracket(self, played):
        return bracket.bracket(played.forces, played["mesh_error"], self.at(played))


@dataclasses.dataclass(frozen=True)
class Errors:
    """Against the converged force F: `rms` of |F_run - F| over the motion as a part of that of |F|; `peak`: by
    how much the largest force is too large; `largest` |F_run - F| as a part of the largest |F|."""
    rms: float
    peak: float
    largest: float


HEAD = ["motion", "coarse: edge, nodes, peak", "middle", "fine", "extrapolated", "limit of the peaks (order)",
        "what extrapolation adds, RMS"]


def graded(scene, folder, motion, finest, radius):
    """A copy of a scene whose first organ has short edges along the way of a motion and never changes them."""
    name = f"way_{hashlib.sha256(motion.text().encode()).hexdigest()[:12]}.csv"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_text(motion.text())
    edge = scene["organs"][0].get("edge_length", 0.01)
    edge = edge["coarsest"] if isinstance(edge, dict) else edge
    near = {"finest": finest, "trajectory": str(folder / name), "radius": radius}
    return but(scene, {"adapt": None, "edge_length": {"coarsest": edge, "near": [near]}})


def truth(context, scene, motion, edges, radius, order=ORDER, **solver):
    """The Truth; edges: of three meshes where the tool goes, coarse to fine, as far as `radius` from the way of its
    control frame [m]. Where that says little of where the tool is, radius is None, and the meshes follow the tool."""
    step = float(scene.get("solver", {}).get("step", 0.01))
    fine = but(scene, solver={**SOLVER, "step": step / 2, **solver})

    def run(edge):
        one = graded(fine, context.work / "references", motion, edge, radius) if radius else adapted(fine, edge, GROWTH)
        return play(context, one, motion, kept=True)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        runs = list(pool.map(run, reversed(edges)))[::-1]
    added = (runs[-1].forces - runs[-2].forces) / ((edges[-2] / edges[-1]) ** order - 1)
    forces = runs[-1].forces + added
    unknown = float(np.sqrt(np.sum(added ** 2) / np.sum(forces ** 2)))
    sizes = [(h, r["nodes"].max(), r.peak) for h, r in zip(edges, runs)]
    bad = sum(r.bad for r in runs)
    context.progress(f"converged force: {', '.join(f'{f:.4f} N' for _, _, f in sizes)}, {norms.peak(forces):.4f} N"
                     + (f", {bad} CYCLES NOT CONVERGED" if bad else ""))
    return Truth(runs[-1].times, forces, sizes, unknown)
