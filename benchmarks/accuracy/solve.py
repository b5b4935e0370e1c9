# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs `palpate solve` on a case given as Python values and reads what it writes."""

import csv
import json
import os
import pathlib
import subprocess

import meshio
import numpy as np
from scipy.spatial import cKDTree

from .meshes import is_quadratic

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Failed(Exception):
    """A program did not do what a case needs."""


def read_table(file):
    """The rows of a CSV file, each by the names in its first."""
    with open(file, encoding="utf-8", newline="") as text:
        return list(csv.DictReader(text))


def build_folder():
    """PALPATE_BUILD, or build/ of the source tree."""
    return pathlib.Path(os.environ.get("PALPATE_BUILD", ROOT / "build"))


def program():
    """The built `palpate`; PALPATE_CLI names another one."""
    if "PALPATE_CLI" in os.environ:
        return os.environ["PALPATE_CLI"]
    for place in ("devel/lib/palpate", "src/cli"):  # with catkin, without
        file = build_folder() / place / "palpate"
        if file.is_file():
            return str(file)
    raise Failed(f"palpate is not built in {build_folder()}: run scripts/build.sh")


class Result:
    """What a run gave: `json` (result.json) and, node by node of the mesh that was given,
    `displacement` and `reaction`, each (n, 3)."""

    def __init__(self, folder, mesh):
        self.folder = folder
        self.json = json.loads((folder / "result.json").read_text())
        vtu = meshio.read(folder / "result.vtu")
        self.cells = vtu.cell_data
        distance, node = cKDTree(vtu.points).query(mesh.points)
        if distance.max() > 1e-9 * np.ptp(mesh.points):
            raise Failed(f"{folder}/result.vtu lacks nodes of the mesh")
        self.displacement = vtu.point_data["displacement"][node]
        self.reaction = vtu.point_data["reaction"][node]
        self.mesh = mesh

    def force(self, probe):
        return np.array(self.json["probes"][probe]["force"])

    def moment(self, probe):
        return np.array(self.json["probes"][probe]["moment"])

    def at(self, point):
        """Displacement of the node at `point`."""
        distance = np.linalg.norm(self.mesh.points - np.asarray(point), axis=1)
        if distance.min() > 1e-9 * np.ptp(self.mesh.points):
            raise Failed(f"no node at {point}")
        return self.displacement[distance.argmin()]

    def history(self, column):
        """Times and values of a column of probes.csv."""
        rows = read_table(self.folder / "probes.csv")
        return np.array([float(r["t"]) for r in rows]), np.array([float(r[column]) for r in rows])

    @property
    def seconds(self):
        return self.json["seconds"]["total"]


def plane(axis, at, tolerance=None):
    """A selection of nodes, as in a case file."""
    select = {"axis": axis, "at": float(at)}
    if tolerance is not None:
        select["tolerance"] = tolerance
    return {"plane": select}


def reaction(name, select):
    return {"name": name, "select": select, "quantity": "reaction"}


def solve(folder, mesh, element, material, boundary, probes=(), analysis=None, **other):
    """A converged Result; `folder` keeps the case and its results. `analysis` adds to a static one,
    or has a `kind` and stands as it is.
    @throws Failed with what palpate said."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    mesh = mesh if mesh.quadratic == is_quadratic(element) else mesh.for_element(element)
    mesh.write(folder / "mesh.vtu")
    case = {"mesh": {"file": "mesh.vtu"}, "element": element, "material": material,
            "boundary": boundary, "probes": list(probes), **other}
    static = {"kind": "static", "load_steps": 4, "tolerance": 1e-9}
    case["analysis"] = analysis if "kind" in (analysis or {}) else {**static, **(analysis or {})}
    (folder / "case.yaml").write_text(json.dumps(case, indent=1))  # JSON is YAML
    run = subprocess.run([program(), "solve", "case.yaml", "--out", "out",
                          "--threads", os.environ.get("PALPATE_THREADS", "1")],
                         cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    (folder / "log.txt").write_text(run.stdout)
    if run.returncode != 0:
        raise Failed(f"palpate solve {folder}/case.yaml: status {run.returncode}: "
                     + run.stdout.strip()[-600:])
    return Result(folder / "out", mesh)
