# SPDX-License-Identifier: GPL-3.0-or-later
"""Model neural: kernels beside a network of equal size, and a press that leaves what was learned."""

import re
import subprocess

import numpy as np
from accuracy import plots
from accuracy.rows import table as table_of
from accuracy.solve import ROOT, Failed, program

from .scene import Replay

SIZES = ("8,8", "16,16", "32,32")
LEAVES = [(0, 0, 0.5), (0.5, 0, -3.0), (1.0, 0, -3.0), (2.0, 43, -3.0), (2.5, 43, -3.0), (3.5, 0, -3.0), (4.0, 0, -3.0),
          (4.5, 0, 0.5), (5.0, 0, 0.5)]  # t [s], x, z [mm] of the ball, 3 mm deep
TEXT = """Model `neural`: an organ that answers a press as it learned from a database of presses, and by finite elements
what is unlike those; [theory.md](../theory.md#surrogates-of-a-bodys-answer) has the formulas,
[databases.md](../databases.md) the commands. The source only proposes it, so there is nothing to compare with but finite elements.

*Learned*: presses of up to 0.5 N around the middle of the slab's top; of a fifth of the places none is learned, which is
*held out*. *Far*: presses of up to 1.2 N anywhere, up to 60 degrees askew. Errors are those of the force, over the forces.
Kernels get as many parameters as the network. *Strange*: of presses missed by more than 20 %, and of the others, in the
half of places that did not set what is strange."""
TRACE = """The shipped `slab_neural` under a ball that presses 3 mm deep where it learned, slides 43 mm aside, out of what
it learned, and back. The elements that take over have edges of 6 mm, which makes them too stiff for this ball, so the force
goes up while they are told; what was learned is of edges of 5 mm under a patch, which depends less on them. The slowest
cycle is the one in which they begin, with the ball in the slab at once. *Adapted*: elements of 10 mm to 2 mm around the
ball, the nearest to the truth here."""


def palpate(*arguments):
    done = subprocess.run([program(), *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode not in (0, 1):  # 1: presses that were not solved, which are left out
        raise Failed(done.stderr.strip() or f"palpate {arguments[0]}: status {done.returncode}")
    return done.stdout


def databases(context):
    """Folders of what is learned, and of presses that go farther."""
    few = context.quick
    scene, folder = ROOT / "config/scenes/slab_probe.yaml", context.work / ("neural_quick" if few else "neural")
    learned, far = folder / "learned", folder / "far"
    surfaces = ["--triangles", 1400, "--splits", 0, "--edge-length", 0.01 if few else 0.005, "--patch", 0.006]
    palpate("database", scene, *surfaces, "--samples", 60 if few else 240, "--force", 0.5, "--within", "0,0,0.03,0.02",
            "--out", learned)
    context.progress("neural: presses to learn")
    palpate("database", scene, *surfaces, "--samples", 10 if few else 34, "--force", 1.2, "--cone", 60, "--seed", 3,
            "--out", far)
    context.progress("neural: presses that go farther")
    return learned, far


def numbers(pattern, text):
    found = re.search(pattern, text)
    if not found:
        raise Failed(f"palpate train does not say {pattern}")
    return [float(group) for group in found.groups()]


def sizes_part(context):
    learned, far = databases(context)
    (context.work / "neural").mkdir(parents=True, exist_ok=True)
    lines = []
    error = r" +\d+ samples, force ([\d.e+-]+) % \(median ([\d.e+-]+) %"
    for hidden in SIZES:
        for kind in ("kernel", "network"):
            said = palpate("train", learned, "--kind", kind, "--hidden", hidden, "--far", far, "--check", far, "--out",
                           context.work / "neural" / f"{kind}_{hidden}.net")
            parameters = numbers(r"(\d+) parameters", said)[0]
            held, away = numbers("held out" + error, said), numbers("checked" + error, said)
            time = numbers(r"modes ([\d.]+) us", said)[0]
            flagged, wrong, false, right = numbers(
                r"other half: (\d+) of (\d+) that are missed by more than 20 %, and (\d+) of (\d+)", said)
            lines.append([kind, f"{parameters:.0f}", *(f"{e:.1f} %" for e in (*held, *away)), f"{time:.1f}",
                          f"{flagged:.0f} of {wrong:.0f}, {false:.0f} of {right:.0f}"])
            context.progress(f"neural: {kind} of {parameters:.0f} parameters")
    return table_of(["kind", "parameters", "held out, rms", "median", "far, rms", "median", "us a prediction", "strange"],
                    lines)


def trace_part(context):
    organ = {"material": {"file": str(ROOT / "config/materials/phantom.yaml")}, "damping": {"mass": 20.0},
             "edge_length": 0.006}
    runs = {
        "neural": {**organ, "model": "neural", "neural": {"file": str(ROOT / "config/networks/slab.net")}},
        "elements, 6 mm": organ,
        "elements, adapted": {**organ, "edge_length": 0.01, "adapt": {"finest": 0.004 if context.quick else 0.002}}}
    runs = {name: Replay(context.work / "neural" / name.replace(" ", "_").replace(",", ""), of, LEAVES)
            for name, of in runs.items()}
    true = runs["elements, adapted"]
    held, aside = true.within(0.6, 1.0), true.within(2.2, 2.5)
    lines = []
    for name, r in runs.items():
        step = np.linalg.norm(np.diff(r.force, axis=0), axis=1).max()
        touching = r.ms[r.touches]
        lines.append([name, f"{r.force[held, 2].mean():.4f}", f"{r.force[aside, 2].mean():.4f}", f"{step:.4f}",
                      f"{np.median(r.ms[held]):.2f}", f"{np.median(r.ms[aside]):.2f}", f"{touching.max():.1f}",
                      f"{(~r.good).sum()}"])
    table = table_of(["", "held [N]", "held aside [N]", "largest change in a cycle [N]", "ms a cycle, held", "aside",
                      "slowest", "not solved"], lines)
    fig, ax = plots.figure()
    for (name, r), style in zip(runs.items(), ("-", "--", ":")):
        ax.plot(r.t, r.force[:, 2], style, label=name)
    ax.set(xlabel="t [s]", ylabel="force [N]", xlim=(0, LEAVES[-1][0]), ylim=(0, None))
    ax.legend()
    picture = plots.save(fig, context.images, "neural.svg")
    return f"{TRACE}\n\n![Force over time](images/models/{picture})\n\n{table}"


def run(context):
    return (f"### Learned presses\n\n{TEXT}\n\n{sizes_part(context)}\n\n#### Out of what was learned, and back\n\n"
            f"{trace_part(context)}\n")
