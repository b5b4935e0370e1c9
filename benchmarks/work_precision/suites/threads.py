# SPDX-License-Identifier: GPL-3.0-or-later
"""What a second thread gives."""

from accuracy.rows import Section, table

from ..runs import Config

QUICK = False


def pair(context, element, tets, poisson=0.45):
    """Runs of one and of two threads, which must feel the same bits."""
    config = Config("cube", tets=tets, element=element, poisson_ratio=poisson, step=0.01,
                    method="implicit_pcg")
    return [context.measure(config.but(threads=n)) for n in (1, 2)]


def run(context):
    lines = []
    for element, tets, poisson in (("anp", 4860, 0.45), ("tet4", 20250, 0.45), ("anp", 20250, 0.45),
                                   ("anp", 20250, 0.49), ("anp", 50400, 0.45)):
        one, two = pair(context, element, tets, poisson)
        same = (one.forces()[1] == two.forces()[1]).all()
        lines.append([f"`{element}`", one.summary["tets"], f"{poisson:g}", f"{one.step_ms:.2f}",
                      f"{two.step_ms:.2f}", f"{one.step_ms / two.step_ms:.2f}", "yes" if same else "**NO**"])
    return Section("Two threads", TEXT, [], [], [table(
        ["element", "tetrahedra", "nu", "one thread: ms a cycle", "two threads", "times faster",
         "same bits"], lines)])


TEXT = "`solver.threads` of the cube, steps of 10 ms, `implicit_pcg`: mean time of a cycle."
