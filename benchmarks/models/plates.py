# SPDX-License-Identifier: GPL-3.0-or-later
"""B13 to B16: fitted plates beside finite elements."""

import numpy as np
from accuracy import meshes
from accuracy.solve import plane, reaction, solve

from .program import figures
from .rows import Row, section, table_of

E, POISSON, THICKNESS, PRESSURE = 1.0e7, 0.3, 0.1, 0.002  # N/cm^2, cm
LENGTH, WIDTH = 32.0, 24.0
LOADS = {"corner": "1 N at a corner", "pressure": "0.002 N/cm^2"}
PLATES = {"whole": "plate", "hole": "plate with a hole"}
PUBLISHED = {("whole", "corner"): ("B13", 0.078, 20.0), ("whole", "pressure"): ("B14", 0.28, 33.5),
             ("hole", "corner"): ("B15", 0.16, 19.2), ("hole", "pressure"): ("B16", 0.45, 39.3)}
TEXT = """A plate of 32 x 24 x 0.1 cm (E = 1e7 N/cm^2, nu = 0.3), with or without a hole of radius 6 cm in its middle,
is clamped at a short end and loaded by 1 N at a corner of the other, or by 0.002 N/cm^2. The largest deflection of
springs that are fitted to an irregular mesh of triangles ("fitted"), and of the same with their mean matched
("matched", not in the source), is compared with that of quadratic tetrahedra, `palpate solve` with `tet10` and the
law `linear`, in place of the source's ANSYS. The error is the deflection's, as a part of the elements'; + is more
deflection, which way the source's errors go it does not say. Nor does it say how many masses it had, or the weights
of its least squares; what the mesh makes of the error is in the second table. Behind the clamped line the network
goes on for 4 cm, held. Without preload nothing resists a small deflection; what is given is an equilibrium at large
ones, found from the flat sheet.

The elements' own error: """


def deflection(context, name, plate, load, layers=1):
    """The largest of a mesh of quadratic tetrahedra [cm], and its size in words."""
    corners = np.array(plate["corners"], int).reshape(-1, 3)
    points = np.stack([plate["x"], plate["y"]], axis=1)
    mesh = meshes.prisms(points, corners, np.linspace(0.0, THICKNESS, layers + 1)).for_element("tet10")
    clamp = {"select": plane("x", 0.0, 1e-6), "displacement": [0, 0, 0]}
    at_corner = {"box": {"min": [LENGTH - 1e-6, WIDTH - 1e-6, -1e-6],
                         "max": [LENGTH + 1e-6, WIDTH + 1e-6, THICKNESS + 1e-6]}}
    if load == "corner":
        loaded = {"select": at_corner, "displacement": [None, None, 1.0]}
    else:
        loaded = {"select": plane("z", THICKNESS, 1e-6), "traction": [0, 0, PRESSURE]}
    result = solve(context.work / name, mesh, "tet10", {"law": "linear", "young_modulus": E, "poisson_ratio": POISSON},
                   [clamp, loaded], [reaction("corner", at_corner)], {"load_steps": 1})
    most = result.displacement[:, 2].max()
    if load == "corner":
        most /= result.force("corner")[2]  # of 1 N
    context.progress(f"{name}: {most:.5g} cm, {mesh.size()}, {result.seconds:.1f} s")
    return most, mesh.size()


def by_edge(found, elements):
    """A table of the fitted springs' errors mesh by mesh; elements: deflection by plate and load [cm]."""
    def error(deflection, right):  # None where a network buckles by itself
        return "does not resist" if deflection is None else f"{100 * (deflection / right - 1):+.1f} %"
    head, lines = ["edge [cm]"], [[f"{edge:g}"] for edge in found["edges"]]
    for plate, name in PLATES.items():
        values = found[plate]["by_edge"]
        head += [f"{name}: masses", *LOADS.values()]
        for k, line in enumerate(lines):
            line.append(f"{values['points'][k]:.0f}")
            line += [error(values[load][k], elements[plate, load]) for load in LOADS]
    return table_of(head, lines)


def run(context):
    found = figures(context, "plates")
    rows, convergence, elements = [], [], {}
    for plate, plate_name in PLATES.items():
        for load, load_name in LOADS.items():
            number, error, bare = PUBLISHED[plate, load]
            (coarse, coarse_size), (fine, fine_size) = (
                deflection(context, f"{plate}_{load}_{mesh}", found[plate][mesh], load) for mesh in ("coarse", "fine"))
            thick, _ = deflection(context, f"{plate}_{load}_two_layers", found[plate]["coarse"], load, 2)
            elements[plate, load] = fine
            convergence.append([f"{plate_name}, {load_name}", coarse_size, f"{coarse:.5f}", fine_size, f"{fine:.5f}",
                                f"{100 * (fine / coarse - 1):+.2f} %", f"{100 * (thick / coarse - 1):+.2f} %"])
            for fit in ("fitted", "matched"):
                w = found[plate][fit][load]
                at = f"{plate_name}, {load_name}, {fit}, {found[plate][fit]['points']:.0f} masses"
                why = f"{w['linear']:.4f} cm beside {fine:.4f} cm"
                rows.append(Row(f"{number} {at}: error", error, "6.4.1", w["linear"] / fine - 1.0,
                                why + "; least squares leave springs too soft" if fit == "fitted" else why,
                                percent=True))
            w = found[plate]["fitted"][load]
            rows.append(Row(f"{number} the same, large deflections, fitted: error", error, "6.4.1",
                            w["large"] / fine - 1.0, f"{w['large']:.4f} cm; the elements' answer is linear",
                            percent=True))
            rows.append(Row(f"{number} without preload, fitted: error, in times the elements' deflection", bare,
                            "6.4.1", w["bare"] / fine - 1.0,
                            f"{w['bare']:.3f} cm; it yields until springs are stretched; the mesh is not the source's"))
    return section("B13 to B16: clamped plates (6.4.1)",
                   TEXT + "two meshes, one layer thick, and the coarse one with two layers.\n\n" +
                   table_of(["case", "coarse", "deflection [cm]", "fine", "deflection [cm]", "change",
                             "two layers, change"], convergence) +
                   "\n\nThe error of fitted springs, linear, over the triangles' edges:\n\n" + by_edge(found, elements),
                   rows)
