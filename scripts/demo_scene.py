#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Replays a shipped scene on its shipped trajectory, and draws the forces and their largest moment.

    scripts/demo_scene.py NAME

`palpate scenes` lists the names. Leaves demo/NAME.csv, demo/NAME.png and demo/NAME_largest_force.png in the
present folder.
"""
import csv
import os
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import meshio  # noqa: E402
import numpy as np  # noqa: E402
import yaml  # noqa: E402

from find_palpate import ROOT, program  # noqa: E402


def files_of(name):
    """The files of a shipped scene and of its trajectory."""
    done = subprocess.run([program(), "scenes", name], stdout=subprocess.PIPE, universal_newlines=True, check=False)
    if done.returncode != 0:
        sys.exit(done.returncode)
    files = dict(line.split(" ", 1) for line in done.stdout.splitlines())
    return files["scene"], files["trajectory"] or sys.exit("demo_scene.py: no trajectory comes with " + name)


def replay(scene, trajectory, out):
    done = subprocess.run([program(), "replay", scene, "--trajectory", trajectory, "--out", out, "--profile"], check=False)
    if done.returncode not in (0, 1):  # 1: some cycles did not converge, which is said
        sys.exit(done.returncode)
    with open(out, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def column(rows, name):
    return np.array([float(row[name]) for row in rows])


def forces(scene, rows):
    """Of each instrument, its name and the force (n, 3) [N]."""
    names = [tool["name"] for tool in scene["instruments"]]
    prefix = [name + "/" for name in names] if len(names) > 1 else [""]
    return [(name, np.stack([column(rows, p + axis) for axis in ("fx", "fy", "fz")], axis=1))
            for name, p in zip(names, prefix)]


def plot(title, t, tools, path):
    figure, axes = plt.subplots(figsize=(8, 3.2))
    for name, force in tools:
        axes.plot(t, np.linalg.norm(force, axis=1), label=name)
    axes.set(xlabel="t [s]", ylabel="force [N]", title=title, xlim=(t[0], t[-1]))
    axes.set_ylim(bottom=0.0)
    axes.grid(alpha=0.3)
    axes.legend(frameon=False)
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def smallness(scene, folder):
    """Of scenes much smaller than the camera's place is meant for: their width over 0.1 m, otherwise 1."""
    widest = 0.0
    for organ in scene["organs"]:
        file = organ.get("surface") or organ.get("tetrahedra")
        if not file or "://" in file:
            return 1.0
        points = meshio.read(os.path.join(folder, file)).points * organ.get("scale", 1.0)
        widest = max(widest, np.ptp(points, axis=0).max())
    return widest / 0.1 if widest < 0.05 else 1.0


def draw(scene, file, trajectory, time, largest, path):
    """`largest`: of the forces then [N]; its arrow stays in the picture."""
    middle = np.mean([(o.get("pose") or {}).get("position", (0, 0, 0)) for o in scene["organs"]], axis=0)
    small = smallness(scene, os.path.dirname(file))
    middle = middle + small * np.array([0.0, 0.0, 0.03])
    eye = middle + small * np.array([0.22, -0.34, 0.2])
    command = [os.path.join(ROOT, "scripts/render_replay.py"), file]
    command += ["--trajectory", trajectory, "--time", "%.4f" % time, "--out", path]
    command += ["--eye", *map(str, eye), "--look-at", *map(str, middle), "--arrow-scale",
                str(small * min(0.2, 0.04 / max(largest, 1e-9)))]
    subprocess.run(command, check=True)


def main():
    if sys.argv[1:] in (["--help"], ["-h"]):
        print(__doc__.strip())
        return
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    name = sys.argv[1]
    path, trajectory = files_of(name)
    with open(path, encoding="utf-8") as file:
        scene = yaml.safe_load(file)
    os.makedirs("demo", exist_ok=True)
    out = os.path.join("demo", name)
    rows = replay(path, trajectory, out + ".csv")
    t, tools = column(rows, "t"), forces(scene, rows)
    plot(scene.get("name", name), t, tools, out + ".png")
    largest = np.max([np.linalg.norm(force, axis=1) for _, force in tools], axis=0)
    at = int(np.argmax(largest))
    draw(scene, path, trajectory, t[at], largest[at], out + "_largest_force.png")
    print()
    for tool, force in tools:
        print("%-12s largest force %.3f N" % (tool, np.linalg.norm(force, axis=1).max()))
    print("demo/%s.csv  demo/%s.png  demo/%s_largest_force.png" % (name, name, name))


if __name__ == "__main__":
    main()
