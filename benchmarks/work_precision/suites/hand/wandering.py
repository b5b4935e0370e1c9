# SPDX-License-Identifier: GPL-3.0-or-later
"""Minutes of random presses, slides and leaves: what stays behind in energy, volume and memory, and the bits."""

import meshio
import numpy as np

from accuracy.rows import table

from ... import motions
from ...jumps import Jumps
from ...replays import play
from ..reach import Goal
from .settings import fine

PICTURES = 10
MEMORY = 5.0  # [%]; a replay keeps a hundred bytes of each cycle for itself


def _volumes(folder):
    """(Volume at rest, volume now) [m^3] of the first organ in each picture of a replay."""
    found = []
    for file in sorted(folder.glob("pictures/*.vtu")):
        picture = meshio.read(file)
        cells = picture.cells_dict["tetra"]

        def volume(x):
            a, b, c, d = (x[cells[:, k]] for k in range(4))
            return float(np.sum(np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)) / 6)
        found.append((volume(picture.points), volume(picture.points + picture.point_data["displacement"])))
    return found


def _left(played, stays):
    """The energies that are left at the end of each stay away of the tool [J]."""
    energy = played["elastic_energy"] + played["kinetic_energy"]
    return [energy[np.searchsorted(played.times, end - 1e-9)] for _, end in stays if end <= played.times[-1]]


def _resumes(context, scene, motion, whole, middle):
    """Whether a replay that is saved in the middle [s] and goes on in another process gives the bits of the whole."""
    first = play(context, scene, motion.during(0.0, middle), words=("--save-state", "{folder}/state"), again=True)
    rest = play(context, scene, motion.during(middle, motion.times[-1]),
                words=("--initial-state", f"{first.folder}/state"), again=True)
    size = len(rest.times)
    same = [whole[k][-size:].tobytes() == rest[k].tobytes() for k in rest.columns if k != "step_ms"]
    return all(same) and whole.status[-size:] == rest.status


def run(context, scene, hand, seconds, part):
    """(Markdown, goals). part: of the motion that is run again [s]."""
    name, one = fine(scene, context.quick)
    motion, stays = motions.wander(hand, seconds, pause=min(20.0, seconds / 3))
    every = max(1, (len(motion.times) - 1) // PICTURES)
    played = play(context, one, motion, words=("--vtu", "{folder}/pictures", "--every", every), again=True)
    short = motion.during(0.0, part)
    whole = play(context, one, short, 1)
    same = whole.bits() == play(context, one, short, 2).bits()
    resumed = _resumes(context, one, short, whole, round(0.4 * part, 2))
    left, stored = _left(played, stays), played["elastic_energy"].max()
    volumes, memory = _volumes(played.folder), np.array(played.resident)
    rest = [v for v, _ in volumes]
    quarters = [np.median(memory[np.floor(4 * memory[:, 0]) == k, 1]) for k in range(4)]
    jumps, det = Jumps(played), played["min_jacobian"].min()
    steady = (max(rest) - min(rest)) / rest[0]
    rows = [
        ["simulated, wall time of the cycles", f"{played.times[-1]:.0f} s, {played['step_ms'].sum() / 1e3:.0f} s"],
        ["changes of the mesh; of these in touch", f"{played['mesh_changes'].sum():.0f}; {jumps.changes}"],
        ["nodes: least, most", f"{played['nodes'].min():.0f}, {played['nodes'].max():.0f}"],
        ["p50, p99 of a cycle, one thread", f"{played.ms(0.5):.2f}, {played.ms(0.99):.1f} ms"],
        ["cycles that did not converge", f"{played.bad} of {len(played.times)}"],
        ["least det F of any element", f"{det:.2f}" if det > 0 else f"**{det:.2f}**"],
        ["energy when the tool was away for 2 s, of the most that was stored: first, last, most",
         ", ".join(f"{100 * e / stored:.2g} %" for e in (left[0], left[-1], max(left))) if left else "-"],
        ["volume at rest, largest difference", f"{100 * steady:.1e} %"],
        ["volume in the pictures, of that at rest", f"{min(b / a for a, b in volumes):.4f} to "
                                                   f"{max(b / a for a, b in volumes):.4f}"],
        ["resident memory, median of each quarter of the time", ", ".join(f"{q:.0f}" for q in quarters) + " MB"],
        ["largest step of the force at a change of the mesh, at others; most above those near it",
         f"{100 * jumps.largest:.1f} %, {100 * jumps.elsewhere:.1f} %; {100 * jumps.excess:.1f} % of the peak"],
        [f"same bits with one and two threads, {part:g} s", "yes" if same else "**NO**"],
        [f"same bits after a state was saved and restored, {part:g} s", "yes" if resumed else "**NO**"]]
    for what, value in rows:
        context.progress(f"random motion: {what}: {value}")
    goals = [Goal("random motion: cycles that did not converge", played.bad, 0, ""),
             Goal("random motion: elements turned inside out (1: yes)", float(det <= 0.0), 0, ""),
             Goal("random motion: bits that differ with threads or after a restore (1: yes)",
                  float(not (same and resumed)), 0, "")]
    goals.append(Goal("random motion: memory grows from the second to the last quarter",
                      100 * (quarters[3] / quarters[1] - 1), MEMORY, "%"))
    return TEXT.format(minutes=played.times[-1] / 60, mesh=name) + table(["", ""], rows), goals


TEXT = """**Random motion**, {minutes:.3g} minutes, {mesh}: presses up to 10 mm deep, slides, leaves and goes
elsewhere at up to 0.1 m/s, from a fixed seed.

"""
