# SPDX-License-Identifier: GPL-3.0-or-later
"""The cases, in the order of the page. Each module has run(context) -> Section; one with
QUICK = True takes seconds and is run by --quick too."""

from . import (calculix, cook, deep_ball, elastica, glued_patch, hertz, land, prony, punch,
               second_opinion, thick_sphere, torsion)

CASES = {"glued_patch": glued_patch, "calculix": calculix, "dolfinx": second_opinion, "cook": cook,
         "torsion": torsion, "thick_sphere": thick_sphere, "elastica": elastica, "punch": punch,
         "hertz": hertz, "deep_ball": deep_ball, "land": land, "prony": prony}
