# SPDX-License-Identifier: GPL-3.0-or-later
"""The meshes that are judged: a shipped scene as it is, and others in its place."""

from ...replays import adapted

LADDER = (0.004, 0.003, 0.002, 0.0015)  # edges at the tool [m]
GROWTHS = (0.5, 1.0)
SHIPPED = "as shipped"


def settings(scene, ladder=LADDER, growths=GROWTHS):
    """{name: scene}, each once: the shipped one first."""
    found = {SHIPPED: scene, "mesh that never changes": adapted(scene, None)}
    for finest in ladder:
        for growth in growths:
            found[f"{1e3 * finest:g} mm at the tool, growth {growth:g}"] = adapted(scene, finest, growth)
    once = []
    return {name: one for name, one in found.items() if one not in once and not once.append(one)}


def fine(scene, quick=False):
    """(name, scene) of the shipped scene if it adapts, else of one that does."""
    finest = 0.006 if quick else 0.002
    if scene["organs"][0].get("adapt"):
        return SHIPPED, scene
    return f"{1e3 * finest:g} mm at the tool", adapted(scene, finest)
