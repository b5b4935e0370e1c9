# SPDX-License-Identifier: GPL-3.0-or-later
"""Each switch solver.skip.*: the time that it saves and the force that it changes."""

import re

from accuracy.rows import Section, table
from accuracy.solve import Failed

from .. import norms
from ..runs import Config
from . import kernels

QUICK = False
SCENES = {"liver": Config("liver", duration=2.0), "cube": Config("cube", tets=20250),
          "rest": Config("rest", tets=20250, duration=1.0)}
PREFIX = "solver.skip."


def switches(run):
    """Keys of switches that the scene has, with what they are by default."""
    return {key: value for key, value in run.summary["settings"].items()
            if key.startswith(PREFIX) and value in ("true", "false")}


def _change(run, other):
    try:
        rms, largest = norms.force_error(*run.forces(), *other.forces())
        return f"{rms:.1e}, {largest:.1e}"
    except ValueError:
        return "no force"


def _frozen(context):
    """What a linear solve leaves where only part of the nodes, those nearest to the load, may move."""
    lines = []
    for name, entry in kernels.measure(context).items():
        found = re.fullmatch(r"frozen_region/tets:(\d+)/moving:(\d+%)", name)
        if found:
            lines.append([*found.groups(), f"{100 * entry['residual_left']:.1f} %"])
    return lines


def run(context):
    lines = []
    for scene, config in SCENES.items():
        default = context.measure(config)
        for key, value in switches(default).items():
            other = context.attempt(config.but(sets=(f"{key}={'false' if value == 'true' else 'true'}",)))
            if other is None:
                continue
            on, off = (default, other) if value == "true" else (other, default)
            lines.append([scene, f"`{key[len(PREFIX):]}`", "on" if value == "true" else "off",
                          f"{off.second_ms:.1f}", f"{on.second_ms:.1f}",
                          f"{off.second_ms / on.second_ms:.2f}", _change(on, off)])
    if not lines:
        lines.append(["", "this build has no switches"] + [""] * 5)
    tables = [table(["scene", "switch", "default", "off: ms a simulated s", "on", "times faster",
                     "change of the force: RMS, largest"], lines)]
    try:
        tables.append(FROZEN + table(["tetrahedra", "nodes that move", "residual left"], _frozen(context)))
    except Failed as failure:
        context.progress(f"left out: {failure}")
    return Section("Work that is skipped", TEXT, [], [], tables)


TEXT = """Each switch of the scene's section `solver.skip` against the same run without it. The change of the
force is a part of the largest force."""

FROZEN = """**What is not skipped: the far parts of an organ that is touched.** In a step of 10 ms the force of a
contact reaches all through soft, nearly incompressible tissue. Below, only the nodes nearest to the load
may move in a linear solve of a step (`anp`, E = 5 kPa), the rest is frozen; then the residual of the whole
body is looked at, as a part of the load. Newton's linear solves leave 10 % at most and mostly 0.5 to
5 %, so a frozen region fails the look at the whole residual unless it is so small that freezing it
saves nothing. What is far is left out where nothing connects it: other organs, and islands of one.

"""
