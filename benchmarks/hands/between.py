# SPDX-License-Identifier: GPL-3.0-or-later
"""The force at 1 kHz against the same scene solved every millisecond, for hands whose motion is prescribed."""

import itertools

import numpy as np

from . import runs

RATES, MOTIONS = (50, 100, 200), ("press", "tremor", "slide", "taps")
DURATION, DEPTH = 2.0, 0.006
COLUMNS = ("fx", "fy", "fz")
INTRODUCTION = """## Between two solves

Hands whose motion is prescribed: down by 6 mm at 30 mm/s ("press"), and then a tremor of 2 mm at 4 Hz, or 20 mm aside in
half a second ("slide"); or taps, in and out twice a second. The simulation at 50, 100 and 200 Hz, each solve for half of
its cycle; against the same scene solved every millisecond, its wrench there at once. RMS of the difference over the peak,
and the delay that fits best. *Held* is the newest wrench alone. *Jitter* is what the force of the solves each
millisecond itself goes up and down from one to the next, by its second differences: no model of it can be nearer.
"""


def force(file):
    return np.array(runs.columns(file, *COLUMNS)).T


def difference(a, b, late):
    """RMS of a, that many ticks late, against b."""
    n = len(a) - abs(late)
    x, y = (a[late:], b[:n]) if late >= 0 else (a[:n], b[-late:])
    return np.sqrt(np.mean(np.sum((x - y) ** 2, axis=1)))


def jitter(a):
    """RMS of the part of a that is white noise."""
    second = a[2:] - 2.0 * a[1:-1] + a[:-2]
    return np.sqrt(np.mean(np.sum(second ** 2, axis=1)) / 6.0)


def run(context):
    scenes = {"slab": runs.SHIPPED / "slab_probe.yaml"}
    if not context.quick:
        scenes["liver, uniform mesh"] = runs.uniform_liver(context.work)
    rates = RATES[1:2] if context.quick else RATES
    motions = MOTIONS[:1] if context.quick else MOTIONS
    exact = [(s, m, 1000, "exact") for s, m in itertools.product(scenes, motions)]
    cases = exact + [(s, m, r, kind) for s, m, r in itertools.product(scenes, motions, rates)
                     for kind in ("local", "held")]
    context.progress(f"{len(cases)} prescribed hands")

    def play(case):
        scene, motion, rate, kind = case
        file = context.work / ("_".join([scene.split(",")[0], motion, str(rate), kind]) + ".csv")
        how = dict(exact=dict(solve=0.0, late=True), local=dict(solve=0.5 / rate), held=dict(solve=0.5 / rate, hold=True))
        runs.hand(scenes[scene], prescribed=True, motion=motion, depth=DEPTH, duration=DURATION, rate=rate, passivity=0.0,
                  out=file, **how[kind])
        return force(file)

    found = runs.each(play, cases)
    lines = ["| scene | motion | jitter | " + " | ".join(f"{r} Hz: local | held" for r in rates) + " |",
             "|" + "---|" * (3 + 2 * len(rates))]
    worst = 0.0
    for scene, motion in itertools.product(scenes, motions):
        truth = found[scene, motion, 1000, "exact"]
        row = [f"{100 * jitter(truth) / np.linalg.norm(truth, axis=1).max():.1f} %"]
        for rate, kind in itertools.product(rates, ("local", "held")):
            got = found[scene, motion, rate, kind]
            peak = np.linalg.norm(truth, axis=1).max()
            error = difference(got, truth, 0) / peak
            late = min(range(-10, 40), key=lambda k: difference(got, truth, k))
            row.append(f"{100 * error:.1f} %, {late} ms")
            if rate == 100 and kind == "local":
                worst = max(worst, error)
        lines.append(f"| {scene} | {motion} | " + " | ".join(row) + " |")
    context.result(f"between solves at 100 Hz: at most {100 * worst:.1f} % of the peak")
    return INTRODUCTION + "\n" + "\n".join(lines) + "\n"
