# SPDX-License-Identifier: GPL-3.0-or-later
"""The ball slides over the liver so fast that its mesh changes all the time: does the force jump?"""

from accuracy.rows import table

from ... import motions
from ...jumps import BOUND, NEAR, Jumps
from ...replays import adapted, play
from ...truth import graded
from ..reach import Goal
from .settings import fine

SPEED, DEPTH = 0.1, 0.005  # [m/s], [m]


def run(context, scene, hand, seconds):
    """(Markdown, goals)."""
    motion = motions.slide(hand, DEPTH, SPEED, seconds)
    shown, one = fine(scene, context.quick)
    finest = one["organs"][0]["adapt"]["finest"]
    scenes = {shown: one}
    if not context.quick:
        scenes["3 mm at the tool"] = adapted(scene, 0.003)
        scenes[f"never changes, {1e3 * finest:g} mm along the way"] = graded(
            scene, context.work / "runs", motion, finest, 0.008)
    lines, goals = [], []
    for name, changed in scenes.items():
        played = play(context, changed, motion)
        j = Jumps(played)
        lines.append([name, f"{played.peak:.3f} N", j.changes, f"{100 * j.largest:.2f} %, {100 * j.rms:.2f} %",
                      f"{100 * j.elsewhere:.2f} %, {100 * j.usual:.2f} %", f"{100 * j.excess:.2f} %",
                      j.above, f"{100 * j.added:.2f} %", f"{played['min_jacobian'].min():.2f}", played.bad or ""])
        context.progress(f"slide, {name}: {j.changes} changes, largest step there {100 * j.largest:.2f} % of the peak, "
                         f"elsewhere {100 * j.elsewhere:.2f} %, excess {100 * j.excess:.2f} %")
        if name == shown:
            goals.append(Goal(f"slide at {SPEED:g} m/s, {name}: step of the force at a change of the mesh above the "
                              f"largest near it", 100 * j.excess, 100 * BOUND, "% of the peak"))
    return TEXT + table(HEAD, lines), goals


HEAD = ["mesh", "peak", "changes in touch", "steps at these: largest, RMS", "at others", "most above those near it",
        f"more than {100 * BOUND:g} % above", "what changes add to the RMS", "least det F", "not converged"]
TEXT = f"""**A slide at {SPEED:g} m/s**, {1e3 * DEPTH:g} mm deep, to and fro over the liver. Step: by how
much the force changes in a cycle, as a part of the peak. The motion has steps of its own, most where the ball goes
over an edge; so each one in a cycle in which the mesh became another is compared with the largest among those of the
{NEAR} cycles before and after in which it did not.

"""
