# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the force in the hand is right: shipped scenes under a moving tool, against converged forces."""

from accuracy.rows import Section, table

from ... import bracket, motions
from ...charts import over_time
from ...replays import shipped
from ...truth import HEAD, truth
from . import holds, palpation, slides, wandering
from .settings import LADDER, SHIPPED, settings

QUICK = True
# Arguments of truth(): 1.6 radii of the ball around its way; the jaws, which open far from the way of their frame.
BALL, JAWS = ((0.003, 0.002, 0.0014), 0.008), ((0.001, 0.0007, 0.0005), None)
QUICK_BALL, QUICK_JAWS = ((0.008, 0.006, 0.005), 0.008), ((0.007, 0.006, 0.005), None)
KIDNEY = (-0.04, 0.0)  # where the grasper takes hold [m]


def run(context):
    quick = context.quick
    liver, kidney = shipped("liver_palpation"), shipped("kidney_grasper")
    hand, recorded = motions.Hand(liver), motions.recorded()
    motion = recorded.during(1.2, 1.9) if quick else recorded
    squeeze = motions.grasp(kidney, KIDNEY)
    squeeze = squeeze.during(0.7, 1.3) if quick else squeeze
    ladder, growths, threads = ((0.006,), (0.5,), (2,)) if quick else (LADDER, (0.5, 1.0), (1, 2))
    parts, goals, cases, curves, references = [], [], [], {}, []
    for title, scene, way, meshes, grows in (("demo", liver, motion, QUICK_BALL if quick else BALL, growths),
                                             ("grasper", kidney, squeeze, QUICK_JAWS if quick else JAWS,
                                              growths[:1])):
        limit = truth(context, scene, way, *meshes)
        references.append(limit.line(TITLES[title]))
        found = palpation.judge(context, title, settings(scene, ladder, grows), way, limit, threads)
        parts.append(f"**{TITLES[title]}**\n\n" + palpation.tabled(found))
        goals += palpation.goals(title, found)
        cases += [(f"{title}, {name}", limit.bracket(judged.two)) for name, judged in found.items()]
        curves[TITLES[title]] = _curves(limit, found)

    def at_rest(scene, way):
        return truth(context, scene, way, *(QUICK_BALL if quick else BALL), integrator="static", step=0.01)
    for text, more in (holds.run(context, liver, hand, recorded, at_rest, 0.2 if quick else 5.0),
                       slides.run(context, liver, hand, 0.6 if quick else 4.0),
                       wandering.run(context, liver, hand, *((8.0, 1.5) if quick else (600.0, 60.0)))):
        parts.append(text)
        goals += more
    figure = over_time(context.images, "hand.svg", curves, "force [N]")
    return Section("The force in the hand", TEXT, [], [(figure, "Force over time, and the converged one")], [
        table(["what", "measured", "asked for", ""], [g.line() for g in goals]),
        CONVERGED + table(HEAD, references), *parts, BRACKETS + bracket.tabled(cases)])


TITLES = {"demo": "The recorded palpation of the liver", "grasper": "A grasper closes on the kidney and pulls"}


def _curves(limit, found):
    """{name: (times, forces)}: the shipped mesh, one that never changes, one that adapts, and the converged force."""
    shown = {SHIPPED: found[SHIPPED]}
    names = list(found)
    for wanted in ("mesh that never changes", "2 mm at the tool, growth 0.5", names[-1]):
        if wanted in found and len(shown) < 3:
            shown.setdefault(wanted, found[wanted])
    curves = {name: (judged.two.times, judged.two.forces) for name, judged in shown.items()}
    return {**curves, "converged": (limit.times, limit.forces)}


TEXT = """Shipped scenes, as they are and with other meshes, driven by `palpate replay` in cycles of the scene's
length, and what the hand feels beside the converged force: the error is the true one, of mesh, step, tolerance and
contact's samples together. The RMS error is a part of the RMS force over the whole motion, that of the peak a part
of the peak. What is bold misses what is asked for, though that is asked of the shipped meshes alone. Edges at the
tool are those of `organs[].adapt` ([meshes.md](../meshes.md#meshes-that-follow-the-tool))."""

CONVERGED = """**The converged forces** are those of three meshes, by `bdf2` with steps of half the length and a tolerance
of 1e-5, the two finest extrapolated at each time. What this adds to the finest stands beside it: no error below that
means much. Of the ball the meshes have short edges along its whole way and never change; around the grasper's jaws,
which open far from the way of their frame, they follow the tool. The order is the second.

"""

BRACKETS = """**The error beside the force**, `mesh_error`, where the converged force is largest.

"""
