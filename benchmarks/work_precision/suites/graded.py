# SPDX-License-Identifier: GPL-3.0-or-later
"""A ball pressed into a block: the force that uniform and graded meshes feel, and what they cost."""

import csv
import json
import re
import shutil
import subprocess

import numpy as np

from accuracy.rows import Section, table
from accuracy.solve import ROOT, Failed, program, read_table

QUICK = False
SIDE, HEIGHT = 0.12, 0.06  # of the block [m]
RADIUS, DEPTH = 0.005, 0.008  # of the shipped probe's ball, and how deep it goes [m]
COARSEST, NEAR, GROWTH = 0.015, 0.008, 0.3  # of graded meshes
REFERENCE = ("tet10p", None, 0.001)
# Element, edges of a uniform mesh or None, edges at the ball of a graded one [m].
MESHES = ([("anp", edge, None) for edge in (0.015, 0.010, 0.0075, 0.005)]
          + [("anp", None, finest) for finest in (0.004, 0.003, 0.002, 0.0014, 0.001)]
          + [("p1p1", edge, None) for edge in (0.015, 0.010)]
          + [("p1p1", None, finest) for finest in (0.004, 0.003, 0.002, 0.0014)]
          + [("tet4", edge, None) for edge in (0.015, 0.010, 0.0075)]
          + [("tet4", None, finest) for finest in (0.004, 0.003, 0.002, 0.0014, 0.001)]
          + [(element, edge, None) for element in ("tet10", "tet10p") for edge in (0.015, 0.010)]
          + [(element, None, finest) for element in ("tet10", "tet10p")
             for finest in (0.006, 0.004, 0.003, 0.002)])
# Element, `finest` and `growth` of meshes of COARSEST that adapt.
ADAPTED = ([("anp", finest, 0.5) for finest in (0.003, 0.002, 0.0015)]
           + [(element, finest, growth) for element in ("tet10", "tet10p") for growth in (0.5, 1.0)
              for finest in (0.006, 0.004, 0.003)])


def _write_block(file):
    x, z = (-SIDE / 2, SIDE / 2), (0.0, HEIGHT)
    points = [(a, b, c) for c in z for b in x for a in x]
    triangles = ((1, 3, 4), (1, 4, 2), (5, 6, 8), (5, 8, 7), (1, 2, 6), (1, 6, 5),
                 (3, 7, 8), (3, 8, 4), (1, 5, 7), (1, 7, 3), (2, 4, 8), (2, 8, 6))
    file.write_text("".join("v %g %g %g\n" % p for p in points)
                    + "".join("f %d %d %d\n" % t for t in triangles))


def _write_press(file):
    """Down at 20 mm/s in 0.4 s, then held for 0.6 s."""
    with open(file, "w", encoding="utf-8", newline="") as text:
        rows = csv.writer(text)
        rows.writerow(["t", "x", "y", "z", "roll", "pitch", "yaw"])
        for k in range(101):
            rows.writerow([f"{0.01 * k:.2f}", 0, 0, -DEPTH * min(1.0, k / 40), 0, 0, 0])


def _write_scene(folder, element, uniform, finest, growth=None):
    """JSON, which is YAML. The ball's lowest point begins at the block's top. With `growth`, the
    mesh adapts."""
    if growth:
        uniform = COARSEST
    edge_length = uniform or {"coarsest": COARSEST, "near": [
        {"finest": finest, "point": [0, 0, HEIGHT], "radius": NEAR, "growth": GROWTH}]}
    scene = {
        "gravity": [0, 0, 0],
        "organs": [{
            "name": "block", "surface": "block.obj", "edge_length": edge_length, "element": element,
            "material": {"young_modulus": 6.0e3, "poisson_ratio": 0.45, "density": 1000.0},
            "damping": {"mass": 5.0},
            "supports": [{"select": {"plane": {"axis": "z", "at": 0.0, "tolerance": 1e-6}}}]}],
        "instruments": [{
            "name": "probe", "urdf": str(ROOT / "config/instruments/probe.urdf"),
            "base": {"position": [0, 0, HEIGHT + RADIUS]}, "control_frame": "tip"}],
        "solver": {"step": 0.01}}
    kind = "_graded"
    if growth:
        scene["organs"][0]["adapt"] = {"finest": finest, "growth": growth}
        kind = f"_adapted_{growth:g}"
    elif uniform:
        kind = ""
    file = folder / f"{element}_{1e6 * (finest or uniform):.0f}{kind}.yaml"
    file.write_text(json.dumps(scene))
    return file


def _palpate(*words):
    done = subprocess.run([program(), *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True, check=False)
    if done.returncode != 0:
        raise Failed(f"palpate {' '.join(map(str, words))}: {done.stderr.strip()[-400:]}")
    return done.stdout


def _size(scene):
    report = _palpate("mesh", "--scene", scene, "--out", scene.with_suffix(".vtu"))
    return {key: int(re.search(word + r" +(\d+)", report).group(1))
            for key, word in (("nodes", "nodes"), ("tets", "tetrahedra"))}


def _size_at_the_end(scene, folder):
    """Of a mesh that adapts, from a picture of the last row; with middle nodes."""
    pictures = folder / "pictures"
    shutil.rmtree(pictures, ignore_errors=True)
    _palpate("replay", scene, "--trajectory", folder / "T.csv", "--out", folder / "R.csv",
             "--vtu", pictures, "--every", 100)
    head = max(pictures.glob("*.vtu")).read_bytes()[:4000].decode("latin1")
    return {key: int(re.search(word + '="([0-9]+)"', head).group(1))
            for key, word in (("nodes", "NumberOfPoints"), ("tets", "NumberOfCells"))}


def press(folder, element, uniform, finest, growth=None, repeats=3):
    """{"tets", "nodes", "force" [N] at the end of the hold, "p50", "p99" [ms]} of one mesh, or as it
    is in the end where it adapts; of times the best run."""
    scene = _write_scene(folder, element, uniform, finest, growth)
    found = _size_at_the_end(scene, folder) if growth else _size(scene)
    times = []
    for _ in range(repeats):
        _palpate("replay", scene, "--trajectory", folder / "T.csv", "--out", folder / "R.csv")
        rows = read_table(folder / "R.csv")
        ms = np.array([float(r["step_ms"]) for r in rows])
        times.append((np.quantile(ms, 0.5), np.quantile(ms, 0.99)))
    found["force"] = float(rows[-1]["fz"])
    found["p50"], found["p99"] = min(times)
    return found


def _fit(excess):
    """[(edge by radius, excess)] as factor and power of a power law."""
    power, factor = np.polyfit(*np.log(np.array(excess).T), 1)
    return np.exp(factor), power


def run(context):
    folder = context.work / "graded"
    folder.mkdir(parents=True, exist_ok=True)
    _write_block(folder / "block.obj")
    _write_press(folder / "T.csv")
    reference = press(folder, *REFERENCE, repeats=1)
    context.progress(f"reference {reference['force']:.4f} N")
    lines, points = [], {}

    def measure(element, mesh, *settings):
        found = press(folder, element, *settings)
        excess = found["force"] / reference["force"] - 1.0
        context.progress(f"{element}, {mesh}: {found['force']:.4f} N, {100 * excess:+.1f} %")
        lines.append([f"`{element}`", mesh, found["tets"], found["nodes"], f"{found['force']:.3f} N",
                      f"{100 * excess:+.1f} %", f"{found['p50']:.2f}", f"{found['p99']:.1f}"])
        return excess

    for element, uniform, finest in MESHES:
        mesh = f"uniform {1e3 * uniform:g} mm" if uniform else f"{1e3 * finest:g} mm at the ball"
        excess = measure(element, mesh, uniform, finest)
        points.setdefault(element, []).append(((uniform or finest) / RADIUS, max(excess, 1e-3)))
    for element, finest, growth in ADAPTED:
        measure(element, f"adapts to {1e3 * finest:g} mm, growth {growth:g}", None, finest, growth)
    lines.append([f"`{REFERENCE[0]}`", f"{1e3 * REFERENCE[2]:g} mm at the ball", reference["tets"],
                  reference["nodes"], f"{reference['force']:.3f} N", "", f"{reference['p50']:.2f}",
                  f"{reference['p99']:.1f}"])
    fits = [[f"`{element}`", *(f"{x:.2f}" for x in _fit(found))] for element, found in points.items()]
    return Section("Graded meshes: a ball pressed into a block", TEXT, [], [], [
        table(["element", "edges", "tetrahedra", "nodes", "force", "above the last row", "p50 [ms]",
               "p99 [ms]"], lines),
        table(["element", "factor", "power"], fits)])


TEXT = f"""A ball of {1e3 * RADIUS:g} mm pressed {1e3 * DEPTH:g} mm into a block of
{1e3 * SIDE:g} x {1e3 * SIDE:g} x {1e3 * HEIGHT:g} mm whose bottom is held (E = 6 kPa, nu = 0.45, the default
law), in 0.4 s, and held for 0.6 s, through `palpate replay` with one thread. Graded meshes have
{1e3 * COARSEST:g} mm far from the ball and grow by {GROWTH:g} mm a mm from {1e3 * NEAR:g} mm on. Meshes
that adapt are of {1e3 * COARSEST:g} mm, and counted with middle nodes. Forces are those at the end, times of a cycle of 10 ms, the best of three runs. The second table fits the excess by a
factor times a power of edge by radius, which is what the advice on a scene's meshes says."""
