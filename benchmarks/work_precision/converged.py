# SPDX-License-Identifier: GPL-3.0-or-later
"""The force that a scene has with no error of the mesh: graded meshes far finer than those that are
judged, in short steps, solved tightly, and extrapolated."""

import dataclasses

import numpy as np

from accuracy import bounds

from . import norms
from .bracket import bracket
from .runs import Config

# Edges where the tool goes [m], coarse to fine.
CUBE, FLAP, LIVER = (0.005, 0.0035, 0.0025), (0.004, 0.003, 0.002), (0.003, 0.002, 0.0014)
EDGES = {"cube": CUBE, "inclusion": CUBE, "capsule": CUBE, "flap": FLAP, "liver": LIVER, "liver_500": LIVER,
         "liver_150": LIVER}
SAME = {"liver_500": "liver", "liver_150": "liver"}  # as coarser meshes of it
COARSEST = {"capsule": 0.010}  # [m] elsewhere, where the scene's own is too coarse for its layer
ELEMENT = {"flap": "tet10"}  # else anp, which bends too stiffly where a body is few elements thick
BESIDE = {"cube": ("tet10", 0.005)}  # another element's word on a limit, where it costs a minute only
ORDER = 2  # of linear elements in the energy, and so in forces [Ciarlet 1978]; quadratic ones have no less


@dataclasses.dataclass
class Converged:
    """Forces (k, 3) [N] at times (k) [s]; what each mesh and the extrapolation say of the largest one."""
    times: np.ndarray
    forces: np.ndarray
    sizes: list  # of the meshes: (edge [m], tetrahedra, peak force [N])
    limit: float  # of the peaks, through all three [N]; NaN where they do not close in on one
    order: float
    unknown: float  # RMS of what the extrapolation adds to the finest mesh, as a part of the peak

    def line(self, title):
        """Of a table with head()."""
        return [title, *(f"{1e3 * h:g} mm, {n}: {f:.4f} N" for h, n, f in self.sizes),
                f"{norms.peak(self.forces):.4f} N",
                f"{self.limit:.4f} N ({self.order:.2f})" if np.isfinite(self.limit) else "-",
                f"{100 * self.unknown:.1f} %"]

    def errors(self, run):
        """(RMS, largest) of a run's force, as parts of the largest meanwhile; NaN of a failed one."""
        if run.failed:
            return float("nan"), float("nan")
        times, forces = run.forces()
        meanwhile = self.times <= times[-1] + 1e-9
        return norms.force_error(times, forces, self.times[meanwhile], self.forces[meanwhile])

    def bracket(self, run):
        """Whether the force's own mesh error holds; of a run that has not failed."""
        times, forces = run.forces()
        return bracket(forces, run.column("mesh_error"), self.forces[norms.at(self.times, times)])


HEAD = ["scene", "coarse: edge, tetrahedra, peak", "middle", "fine", "extrapolated", "limit of the peaks (order)",
        "what extrapolation adds, RMS"]


def config(scene, edge, poisson_ratio=None, duration=None):
    return Config(scene, finest=edge, edge_length=COARSEST.get(scene), poisson_ratio=poisson_ratio, element=ELEMENT.get(scene, "anp"),
                  method="implicit_pcg", integrator="bdf2", step=0.005, tolerance=1e-5, threads=1, max_newton=50,
                  duration=duration, sets=("contact.sample_spacing=0.0025",))


def beside(context, limit, scene, poisson_ratio=None, duration=None):
    """What another element says of a scene's limit, in words; "" where none is asked."""
    if scene not in BESIDE:
        return ""
    element, edge = BESIDE[scene]
    run = context.kept(config(scene, edge, poisson_ratio, duration).but(element=element))
    return f"`{element}`, {1e3 * edge:g} mm: {norms.peak(run.forces()[1]):.4f} N, {100 * limit.errors(run)[0]:.1f} %"


def prepare(context, wanted):
    """Runs what converged() needs, side by side; wanted: its arguments after `context`."""
    context.keep([config(SAME.get(scene, scene), edge, *more) for scene, *more in wanted
                  for edge in EDGES[SAME.get(scene, scene)]])


def converged(context, scene, poisson_ratio=None, duration=None):
    """The Converged force of a scene, from runs that are kept as references are."""
    scene = SAME.get(scene, scene)
    edges = EDGES[scene]
    runs = [context.kept(config(scene, edge, poisson_ratio, duration)) for edge in edges]
    times, fine = runs[-1].forces()
    _, middle = runs[-2].forces()
    added = (fine - middle) / ((edges[-2] / edges[-1]) ** ORDER - 1)
    peaks = [norms.peak(r.forces()[1]) for r in runs]
    limit, order = bounds.extrapolated(edges, peaks)
    unknown = float(np.sqrt(np.mean(np.sum(added ** 2, axis=1)))) / norms.peak(fine + added)
    return Converged(times, fine + added, [(h, r.summary["tets"], f) for h, r, f in zip(edges, runs, peaks)],
                     limit, order, unknown)
