# SPDX-License-Identifier: GPL-3.0-or-later
"""Hands from limp to stiff, devices, dampings and delays: how far each swings, three seconds after it came."""

import itertools
import math

from . import runs

DELAYS, DAMPINGS = (0.0, 0.003, 0.010), (0.05, 0.2, 1.0, 5.0)
MASSES, GRIPS = (0.045, 0.1, 0.3), (0, 100, 300, 1000, 2000)
DEPTH, DURATION, REST = 0.006, 5.4, 0.2  # m, s, mm
SCENES = {"slab": "the shipped slab", "liver": "the shipped liver", "block": "a block of 1e5 N/m"}
INTRODUCTION = f"""## At rest in every hand

The hand means to be {1e3 * DEPTH:g} mm below the surface and gets there at 30 mm/s; encoders of 0.055 mm, simulation at
100 Hz with 5 ms a solve, and the device's mass (45 g), damping and delay told. Below: how far it still swings between 3
and 5 s after it came, in mm, creep left out; a dot is at most {REST} mm, "off" one that touches nothing any more. In each cell hands with springs of 0 (limp,
leaning on the tool with 0.5 N), 100, 300, 1000 and 2000 N/m, and a damping of a hundredth of that. *Rendered* is the
largest stiffness that a hand of 100 N/m on 100 g felt. *Ideal* swings are those of a limp hand on a spring as stiff as
what is rendered, without delay, ticks or encoders: what no controller without damping of its own betters.
"""


def one(scene):
    def run(case):
        delay, damping, mass, grip = case
        held = dict(grip="limp") if grip == 0 else dict(grip="light", grip_stiffness=grip, grip_damping=0.01 * grip)
        return runs.hand(scene, mass=mass, damping=damping, delay_in=delay, delay_out=delay, depth=DEPTH,
                         duration=DURATION, **held)
    return run


def ideal(stiffness, mass, damping, push=0.5, above=0.005):
    """Swing of a limp hand on a spring, as above [mm]: dropped from `above`, from the end of its way on."""
    if stiffness <= 0.0:
        return math.inf
    speed = math.sqrt(2.0 * push / mass * above)
    decay, omega2 = damping / (2.0 * mass), stiffness / mass
    if decay * decay >= omega2:
        return 0.0
    amplitude = math.sqrt((push / stiffness) ** 2 + speed * speed / omega2)
    return 2e3 * amplitude * math.exp(-decay * (DURATION - 2.0))


def cells(found, delay, damping):
    line = []
    for mass in MASSES:
        swings = [found[delay, damping, mass, grip]["swing"] for grip in GRIPS]
        felt = [found[delay, damping, mass, grip]["rendered"] for grip in GRIPS]
        line.append("`" + " ".join("off" if f == 0.0 else "." if s <= REST else f"{s:.1g}"
                                   for s, f in zip(swings, felt)) + "`")
    return line


def table(found, delays, dampings):
    lines = ["| delay each way | damping of the device | " + " | ".join(f"{1e3 * m:.0f} g" for m in MASSES)
             + " | rendered | ideal, limp | energy out, most |", "|" + "---|" * (5 + len(MASSES))]
    for delay, damping in itertools.product(delays, dampings):
        rendered = found[delay, damping, 0.1, 100]["rendered"]
        best = [ideal(found[delay, damping, m, 0]["rendered"], m, damping) for m in MASSES]
        energy = max(r["energy"] for c, r in found.items() if c[:2] == (delay, damping))
        lines.append(f"| {1e3 * delay:g} ms | {damping:g} N s/m | " + " | ".join(cells(found, delay, damping))
                     + f" | {rendered:.3g} N/m | `" + " ".join("." if b <= REST else f"{b:.1g}" for b in best)
                     + f"` | {energy:.2g} mJ |")
    return "\n".join(lines)


def run(context):
    delays, dampings = ((0.003,), (0.2,)) if context.quick else (DELAYS, DAMPINGS)
    text = [INTRODUCTION]
    for name, title in SCENES.items():
        if context.quick and name == "liver":
            continue
        scene = {"slab": runs.SHIPPED / "slab_probe.yaml", "liver": runs.SHIPPED / "liver_palpation.yaml",
                 "block": None}[name] or runs.block(context.work, 1.0e7)
        cases = list(itertools.product(delays, dampings, MASSES, GRIPS))
        context.progress(f"{len(cases)} hands on {title}")
        found = runs.each(one(scene), cases)
        swinging = {c: r for c, r in found.items() if r["swing"] > REST or r["rendered"] == 0.0}
        passive = [c for c, r in swinging.items() if c[3] > 0 or ideal(r["rendered"], c[2], c[1]) <= REST]
        text.append(f"### {title[0].upper() + title[1:]}\n\n{len(found) - len(swinging)} of {len(found)} rest; of those "
                    f"that do not, {len(swinging) - len(passive)} swing on an ideal spring, too. Largest stiffness that "
                    f"a tool felt: {max(r['tissue'] for r in found.values()):.3g} N/m.\n\n"
                    + table(found, delays, dampings) + "\n")
        context.result(f"{name}: {len(found) - len(swinging)} of {len(found)} rest, {len(passive)} of the others would "
                       "on an ideal spring")
    return "\n".join(text)
