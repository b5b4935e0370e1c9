# SPDX-License-Identifier: GPL-3.0-or-later
"""B18 to B22: cubes and shafts; the lattice that collapses."""

import numpy as np

from .program import figures
from .rows import Row, number, section, table_of

CUBE, SHAFT = 1000.0, 523.6  # N/cm, as (7.74) and (7.75) for E = 100 N/cm^2
TORSION = 100.0 / 2.5 * np.pi * 5.0 ** 4 / 2  # G pi R^4/2 with nu = 1/4, N cm^2
TEXT = """A cube of 10 cm and a shaft of radius 5 and length 15 cm, E = 100 N/cm^2 (the text has 10, which contradicts
its 1000 dL and 523.6 dL), in tension between ends that glide, the shaft also in torsion between ends that are held.
Lattices of cubes with edges and face diagonals (7.71), with 2 E h in place of the 4 E h of (7.70), and with edges and
body diagonals (7.72, 7.73); springs fitted to tetrahedra ("fitted"), and the same with their mean matched ("matched",
not in the source). Forces in N a cm of extension, moments in N cm a 1/cm of twist."""


def of_lattice(found, cells):
    pulls = found[f"cube_{cells}"]

    def farthest(values, expected):
        return max(values, key=lambda v: abs(v - expected))
    sides = [p[k] for p in pulls.values() for k in ("contraction_1", "contraction_2")]
    at = f"cube of {cells} x {cells} x {cells} cells, x, y, z, tension and compression, the farthest off"
    return [Row(f"B18 force, {at}", CUBE, "(7.74)", farthest([p["force"] for p in pulls.values()], CUBE), "rounding"),
            Row(f"B18 contraction, {at}", 0.25, "7.4.1", farthest(sides, 0.25), "rounding")]


def of_fit(found, fit):
    why = {"matched": "the mean is the continuum's, its parts are not",
           "fitted": "least squares leave springs too soft"}[fit]
    cube, shaft = found[fit]["cube"], found[fit]["shaft"]
    rows = [Row(f"B20 force of the cube, {fit}, {cube['points']:.0f} masses", CUBE, "(7.74)",
                cube["tension"]["force"], why)]
    rows += [Row(f"B20 contraction along {axis}, {fit}", 0.25, "7.4.1: wrong, and unequal",
                 cube["tension"][key], "least squares over all masses; unequal, but not by much on this mesh")
             for axis, key in (("x", "contraction_1"), ("y", "contraction_2"))]
    section_error = found[fit]["section"] / (25 * np.pi) - 1
    rows += [Row(f"B21 force of the shaft, {fit}, {shaft['points']:.0f} masses", SHAFT, "(7.75)",
                 shaft["tension"]["force"], f"{why}; its section is {100 * section_error:+.1f} % off the circle's"),
             Row("the same, of the section that its mesh has", shaft["tension"]["force_of_theory"], "E A/L",
                 shaft["tension"]["force"], why),
             Row(f"B22 moment of the shaft, {fit}", TORSION, "7.4.2", shaft["torsion"]["moment"],
                 f"{why}; the section counts squared"),
             Row("the same, of the section that its mesh has", shaft["torsion"]["moment_of_theory"], "G A^2/(2 pi)",
                 shaft["torsion"]["moment"], why)]
    return rows


def by_edge(found):
    """A table of the fitted bodies' errors mesh by mesh."""
    def error(answer, key):
        return f"{100 * (answer[key] / answer[key + '_of_theory'] - 1):+.1f} %"
    lines = [[f"{mesh['edge']:g}", f"{mesh['cube']['points']:.0f}", error(mesh["cube"]["tension"], "force"),
              number(mesh["cube"]["tension"]["contraction_1"]), number(mesh["cube"]["tension"]["contraction_2"]),
              f"{mesh['shaft']['points']:.0f}", error(mesh["shaft"]["tension"], "force"),
              error(mesh["shaft"]["torsion"], "moment")] for mesh in found["by_edge"]]
    return ("Errors of fitted bodies over the tetrahedra's edges, of the section that their mesh has; the source calls\n"
            "force and moment very close to the theory's:\n\n" +
            table_of(["edge [cm]", "cube: masses", "force", "contraction x", "contraction y", "shaft: masses", "force",
                      "moment"], lines))


def run(context):
    found = figures(context, "solids")
    rows = of_lattice(found, 2) + of_lattice(found, 5)
    rows.append(Row("B18 force along z, constants as printed", CUBE, "(7.74)", found["cube_as_printed"]["+z"]["force"],
                    "4 E h in (7.70) is twice what (7.59) demands"))
    for cells, modes in enumerate(found["mechanisms"]["body_diagonals"], 1):
        rows.append(Row(f"B19 motions without energy, edges and body diagonals, {cells} x {cells} x {cells} cells",
                        "often collapses", "7.4.1", modes, "beside six rigid ones: why it collapses"))
    rows.append(Row("B19 most of them with edges and face diagonals, of as many cells", "does not", "7.4.1",
                    max(found["mechanisms"]["face_diagonals"]), ""))
    rows += of_fit(found, "fitted") + of_fit(found, "matched")
    return section("B18 to B22: cubes and shafts (7.4)", TEXT + "\n\n" + by_edge(found), rows)
