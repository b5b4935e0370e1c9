# SPDX-License-Identifier: GPL-3.0-or-later
"""What the mesh costs: the error of the force against a much finer mesh, by element."""

from accuracy.rows import Section, table

from .. import norms
from ..charts import work_precision
from ..runs import Config

QUICK = False
ELEMENTS = {"tet4": (1080, 4860, 20250), "anp": (1080, 4860, 20250), "p1p1": (1080, 4860),
            "tet10": (162, 750)}
POISSON = (0.45, 0.499)
FINE = {"element": "tet10", "tets": 6000}


def _config(element, tets, poisson):
    # Solved tightly, with steps short enough, so that only the mesh differs. One spacing of the
    # contact's points for all meshes.
    return Config("cube", tets=tets, element=element, poisson_ratio=poisson, method="implicit_pcg",
                  step=0.01, tolerance=1e-5, sets=("contact.sample_spacing=0.0025",))


def run(context):
    panels, lines = {}, []
    for poisson in POISSON:
        fine = context.measure(_config(poisson=poisson, **FINE), repeats=1)
        panel = panels[f"nu = {poisson:g}"] = {}
        for element, sizes in ELEMENTS.items():
            for tets in sizes:
                run = context.measure(_config(element, tets, poisson), repeats=1)
                rms, largest = norms.force_error(*run.forces(), *fine.forces())
                panel.setdefault(element, []).append((rms, run.second_ms, ""))
                lines.append([f"{poisson:g}", f"`{element}`", run.summary["tets"], run.summary["nodes"],
                              f"{run.step_ms:.1f}", f"{100 * rms:.1f} %", f"{100 * largest:.1f} %",
                              f"{run.summary['peak_force']:.3f} N"])
        lines.append([f"{poisson:g}", "`tet10`, the finest", fine.summary["tets"],
                      fine.summary["nodes"], f"{fine.step_ms:.1f}", "", "",
                      f"{fine.summary['peak_force']:.3f} N"])
    figure = work_precision(context.images, "discretisation.svg", panels, "ms a simulated second",
                            "RMS force error against the finest [%]")
    return Section("What the mesh costs, by element", TEXT, [],
                   [(figure, "Time over the mesh's error of the force, by element")],
                   [table(["nu", "element", "tetrahedra", "nodes", "ms a cycle", "force error, RMS",
                           "largest", "peak force"], lines)])


TEXT = """The pressed and slid cube, solved tightly on meshes of several elements and sizes: the error is that
of the mesh, against `tet10` on the finest one. Beside it the time of a cycle. Near the incompressible,
the plain `tet4` pays for its locking with any number of tetrahedra."""
