# SPDX-License-Identifier: GPL-3.0-or-later
"""The chapters of the page: what each is about, its parts by name and its source."""

import dataclasses


@dataclasses.dataclass
class Chapter:
    title: str
    head: str
    parts: list  # modules of this folder, whose run(context) gives Markdown
    source: str


CHAPTERS = {
    "tool": Chapter(
        "Every model under the same tool",
        "What a cycle costs, and how far its force is from the converged one: the place of each model on the plane of "
        "time and error.",
        ["touched", "summaries", "table_2_1"],
        "Table 2.1: X. Wang, *Deformable Haptic Models for Surgical Simulation*, PhD thesis, University of Texas at "
        "Arlington, 2005."),
    "springs": Chapter(
        "Springs, tensors, cells and cloth",
        "Tables and curves of [Wang 2005]; `palpate_models`, `palpate solve` and `palpate replay` compute them. B numbers "
        "are this page's own. *Another program*: the source's networks computed anew with other code, where the source has "
        "a curve without figures, or none.",
        ["beams", "directions", "free_sheet", "discs", "ends", "ideal", "plates", "solids", "hung_cloth", "unrolling",
         "cells"],
        "X. Wang, *Deformable Haptic Models for Surgical Simulation*, PhD thesis, University of Texas at Arlington, "
        "2005."),
    "interface": Chapter(
        "The organ-instrument interface",
        "The system that this package carries on from [Castillo Leon 2011]: a segment that prescribes displacements where "
        "it meets the surface, and the boundary elements that it compares with finite ones.",
        ["interface", "boundary"],
        "J. A. Castillo León, *Real-time simulation of organ-instrument interaction in a surgical procedure within a "
        "teleoperation environment*, MSc thesis, Universidad Nacional de Colombia, 2011."),
    "skin": Chapter(
        "Two layers of skin",
        "A plane block of two layers on bone, pressed in its middle [Triantafyllopoulos 2005]; `palpate skin` and `palpate "
        "solve` compute it.",
        ["skin", "skin_fit"],
        "P. I. Triantafyllopoulos, *Skin deformation model with the finite element method: application to an interactive "
        "display system*, diploma thesis, National Technical University of Athens, 2005. Its readings are of M. A. "
        "Srinivasan, *Surface deflection of primate fingertip under line load*, 1989."),
    "enriched": Chapter(
        "Enriched by samples",
        "A coarse interactive model made fine by a regressor [Bounik, Shamsi, Sedaaghi 2020]; the room `enrichment` has it, "
        "`palpate database` makes its samples.",
        ["enriched", "neural"],
        "Bounik, Shamsi, Sedaaghi, in *Journal of Nonlinear Systems in Electrical Engineering* 7(1), 2020, "
        "149-162."),
}
