# SPDX-License-Identifier: GPL-3.0-or-later
"""The stiffest block that rests in a light hand, over the damping of the device: with and without each part."""

import numpy as np
from accuracy.plots import figure, save

from . import runs

PARTS = {"wrench held for a cycle": dict(hold=True, passivity=0.0),
         "local model": dict(late=True, passivity=0.0),
         "and passivity": dict(late=True),
         "and for where the hand will be,\nthrough a spring": dict()}
COLOURS = ("#999999", "#b5322a", "#8a5a00", "#1f4e79")
DELAYS = (0.0, 0.003)
REST = 0.2  # mm


def stiffness(scene):
    """What the tool feels of a block 3 mm deep [N/m]."""
    return runs.hand(scene, prescribed=True, depth=0.003, duration=2.0, passivity=0.0, late=True)["tissue"]


def run(context):
    moduli = np.geomspace(1e3, 1e7, 3 if context.quick else 17)
    dampings = np.geomspace(0.02, 5.0, 2 if context.quick else 9)
    blocks = {e: runs.block(context.work, e) for e in moduli}
    found = runs.each(lambda e: stiffness(blocks[e]), list(moduli))
    cases = [(part, d, b, e) for part in PARTS for d in DELAYS for b in dampings for e in moduli]
    context.progress(f"{len(cases)} hands for the picture")

    def rests(case):
        part, delay, damping, modulus = case
        return runs.hand(blocks[modulus], grip="light", depth=0.003, duration=5.4, damping=float(damping),
                         delay_in=delay, delay_out=delay, **PARTS[part])["swing"] <= REST

    rest = runs.each(rests, cases)
    fig, axes = figure(2, width=8.4, height=3.8, sharey=True)
    lines = []
    for axis, delay in zip(axes, DELAYS):
        for colour, part in zip(COLOURS, PARTS):
            largest = []
            for b in dampings:
                held = [bool(rest[part, delay, b, e]) for e in moduli]
                first = held.index(False) if False in held else len(held)
                largest.append(found[moduli[first - 1]] if first else np.nan)
            axis.plot(dampings, largest, "o-", color=colour, label=part)
            lines.append(f"| {1e3 * delay:g} ms | {' '.join(part.split())} | "
                         + " | ".join("-" if np.isnan(k) else f"{k:.3g}" for k in largest) + " |")
        axis.set(title=f"{1e3 * delay:g} ms of delay each way", xlabel="damping of the device [N s/m]", xscale="log",
                 yscale="log")
    axes[0].set_ylabel("stiffest block that rests [N/m]")
    axes[0].legend(fontsize=7)
    name = save(fig, context.images, "z_width.svg")
    top = max(found.values())
    return f"""## What each part is for

The stiffest block that comes to rest within {REST} mm in a light hand (100 g, 100 N/m, 1 N s/m) 3 mm deep, over the
damping of the device: the Z-width of Colgate and Brown [1994]. The stiffest of all blocks has {top:.2g} N/m; through a spring
it is felt as stiff as the device can render.

![Stiffest block that rests, over the device's damping](images/hands/{name})

| delay each way | parts | {" | ".join(f"{b:.2g} N s/m" for b in dampings)} |
|{"---|" * (2 + len(dampings))}
""" + "\n".join(lines) + "\n"
