# SPDX-License-Identifier: GPL-3.0-or-later
"""Each switch solver.skip.*: the time that it saves and the force that it changes."""

from accuracy.rows import Section, table

from .. import norms
from ..runs import Config

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
    return Section("Work that is skipped", TEXT, [], [], [table(
        ["scene", "switch", "default", "off: ms a simulated s", "on", "times faster",
         "change of the force: RMS, largest"], lines)])


TEXT = """Each switch of the scene's section `solver.skip` against the same run without it. The change of the
force is a part of the largest force."""
