# SPDX-License-Identifier: GPL-3.0-or-later
"""Energy that comes out of the port and never went in, over minutes of random motions."""

from . import runs

MINUTES = 10


def run(context):
    seconds = 20.0 if context.quick else 60.0 * MINUTES
    context.progress(f"{seconds:.0f} s of random motions")
    found = runs.hand(runs.SHIPPED / "slab_probe.yaml", motion="wander", depth=0.006, duration=seconds)
    context.result(f"energy out in {seconds:.0f} s: {found['energy']:.3g} mJ")
    return f"""## Energy

A light hand wanders through the slab and out of it for {seconds / 60:.3g} minutes, to random places within 20 mm and as far
below the surface as {found['deepest']:.2g} mm. At most {found['energy']:.2g} mJ came out that never went in.
"""
