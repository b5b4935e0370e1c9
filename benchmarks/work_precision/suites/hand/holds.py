# SPDX-License-Identifier: GPL-3.0-or-later
"""The ball is brought to the deepest point of the recording from two sides and held: does it feel the same?"""

import numpy as np

from accuracy.rows import table

from ... import motions
from ...replays import elastic, play
from ..reach import Goal
from .settings import fine, settings

WITHIN = 2.0  # asked for [%]
ASIDE = 0.02  # where the second way presses first [m]
DEEPEST = 6.7  # time of the recording [s]
WAYS = ("from above", "from the side")
STEPPERS = {"`backward_euler`": {"integrator": "backward_euler"}, "`bdf2`": {"integrator": "bdf2"},
            "`static`": {"integrator": "static"}, "`tled`": {"method": "tled"}}


def at_rest(played):
    """The mean force of the last tenth of a second (3), and how far it moved in the last second [N]."""
    last = played.forces[played.times > played.times[-1] - 0.1 + 1e-9].mean(axis=0)
    second = played.forces[played.times > played.times[-1] - 1.0 + 1e-9]
    return last, float(np.linalg.norm(second - last, axis=1).max())


def run(context, scene, hand, recorded, truth_of, seconds):
    """(Markdown, goals). truth_of(scene, motion): a Truth, solved statically."""
    scene, was_viscous = elastic(scene)
    row = int(np.searchsorted(recorded.times, DEEPEST - 1e-9))
    place, tilt = hand.tip(recorded, row)
    ways = motions.hold(hand, place, tilt, ASIDE, seconds)
    truth = truth_of(scene, motions.hold(hand, place, tilt, ASIDE, 0.1)[0]).forces[-1]
    meshes = dict([fine(scene, context.quick)])
    if not context.quick:
        meshes.update(list(settings(scene, ladder=()).items())[-1:])
    lines, spread = [], {}
    for mesh, one in meshes.items():
        forces = []
        for stepper, keys in STEPPERS.items():
            for way, motion in zip(WAYS, ways):
                played = play(context, {**one, "solver": {**one.get("solver", {}), **keys}}, motion)
                force, moved = at_rest(played)
                forces.append(force)
                off = np.linalg.norm(force - truth) / np.linalg.norm(truth)
                lines.append([mesh, stepper, way, f"{np.linalg.norm(force):.4f} N", f"{100 * off:.1f} %",
                              f"{100 * moved / np.linalg.norm(force):.2f} %",
                              f"{played['min_jacobian'].min():.2f}", played.bad or ""])
                context.progress(f"hold, {mesh}, {stepper}, {way}: {np.linalg.norm(force):.4f} N"
                                 + (f", {played.bad} NOT CONVERGED" if played.bad else ""))
        mean = np.mean(forces, axis=0)
        spread[mesh] = max(np.linalg.norm(a - b) for a in forces for b in forces) / np.linalg.norm(mean)
    text = TEXT.format(seconds=seconds, viscous=VISCOUS if was_viscous else "", truth=np.linalg.norm(truth))
    what = "rest forces from two directions by four steppers, farthest apart"
    goals = [Goal(f"hold, {mesh}: {what}", 100 * s, WITHIN, "%") for mesh, s in spread.items()]
    return text + table(HEAD, lines), goals


HEAD = ["mesh", "stepped by", "came", "force at rest", "off the converged force", "moved in the last second",
        "least det F", "not converged"]
VISCOUS = " The tissue's viscous terms are left out here: held, it would creep for minutes."
TEXT = """**Held from two directions**: the ball goes to the deepest point of the recording straight from above, or
presses 20 mm beside it first and then slides there, and is held for {seconds:g} s.{viscous} The converged
force at rest, found statically, is {truth:.4f} N.

"""
