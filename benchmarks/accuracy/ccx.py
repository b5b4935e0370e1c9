# SPDX-License-Identifier: GPL-3.0-or-later
"""The same mesh, law and supports in CalculiX (ccx): C3D4 with one integration point, C3D10 with
four. Results are read from the .dat file, which has seven digits."""

import os
import pathlib
import shutil
import subprocess

import numpy as np

from .solve import Failed

PACKAGE = "calculix-ccx"


def available():
    return shutil.which("ccx") is not None


def version():
    text = subprocess.run(["ccx", "-v"], stdout=subprocess.PIPE, text=True).stdout
    return "CalculiX " + text.split()[-1]


def _material(material):
    """The cards of a law. Hyperelastic ones share palpate's volumetric energy,
    kappa/2 (J - 1)^2 = 1/D1 (J - 1)^2; *ELASTIC with NLGEOM is Hooke in the Green strain."""
    law = material["law"]
    if law == "st_venant_kirchhoff":
        mu, kappa = material["mu"], material["kappa"]
        young, poisson = 9 * kappa * mu / (3 * kappa + mu), (3 * kappa - 2 * mu) / (6 * kappa + 2 * mu)
        return f"*ELASTIC\n{young:.12e},{poisson:.12e}\n"
    d1 = 2.0 / material["kappa"]
    if law == "neo_hookean":
        return f"*HYPERELASTIC,NEO HOOKE\n{material['mu'] / 2:.12e},{d1:.12e}\n"
    if law == "mooney_rivlin":
        return f"*HYPERELASTIC,MOONEY-RIVLIN\n{material['c10']:.12e},{material['c01']:.12e},{d1:.12e}\n"
    if law == "yeoh":
        c1, c2, c3 = (material[c] for c in ("c1", "c2", "c3"))
        return f"*HYPERELASTIC,YEOH\n{c1:.12e},{c2:.12e},{c3:.12e},{d1:.12e},1e30,1e30\n"
    raise Failed(f"law {law} is not translated for CalculiX")


def _ids(name, nodes):
    lines = [f"*NSET,NSET={name}"]
    ids = [str(i + 1) for i in nodes]
    lines += [",".join(ids[k:k + 12]) + "," for k in range(0, len(ids), 12)]
    return lines


def solve(folder, mesh, material, targets):
    """Displacement and support reaction (n, 3) with prescribed nodes.

    targets: list of {node: displacement (3)}, one for each step; the last one is the state asked
    for, the earlier ones lead there (ccx moves nodes on straight lines within a step)."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    lines = ["*NODE,NSET=NALL"]
    lines += [f"{i + 1},{x:.12e},{y:.12e},{z:.12e}" for i, (x, y, z) in enumerate(mesh.points)]
    lines += [f"*ELEMENT,TYPE={'C3D10' if mesh.quadratic else 'C3D4'},ELSET=EALL"]
    lines += [",".join(str(n) for n in [e + 1, *(t + 1)]) for e, t in enumerate(mesh.tets)]
    held = sorted(targets[-1])
    lines += _ids("HELD", held)
    lines += ["*MATERIAL,NAME=M", _material(material).rstrip(), "*SOLID SECTION,ELSET=EALL,MATERIAL=M"]
    for step, target in enumerate(targets):
        # Newton goes on until the residual is 1e-9 of the mean force; the cut-back is left out.
        lines += ["*STEP,NLGEOM,INC=1000", "*STATIC", "0.5,1.,1e-5,1.",
                  "*CONTROLS,PARAMETERS=FIELD", "1e-9,1e-8,,,1e-9,1e-8,1e-9,", "*BOUNDARY"]
        lines += [f"{i + 1},{k + 1},{k + 1},{target[i][k]:.12e}" for i in held for k in range(3)]
        if step == len(targets) - 1:
            lines += ["*NODE PRINT,NSET=NALL,FREQUENCY=100000", "U",
                      "*NODE PRINT,NSET=HELD,FREQUENCY=100000", "RF"]
        lines += ["*END STEP"]
    (folder / "job.inp").write_text("\n".join(lines) + "\n")
    run = subprocess.run(["ccx", "-i", "job"], cwd=folder, stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, text=True,
                         env={**os.environ, "OMP_NUM_THREADS": "1"})
    (folder / "log.txt").write_text(run.stdout)
    if run.returncode != 0 or "*ERROR" in run.stdout:
        raise Failed(f"ccx {folder}/job.inp: {run.stdout.strip()[-600:]}")
    return _read(folder / "job.dat", len(mesh.points))


def _read(file, num_nodes):
    """The last displacements and forces of a .dat file."""
    values = {"displacements": np.full((num_nodes, 3), np.nan), "forces": np.zeros((num_nodes, 3))}
    current = None
    for line in file.read_text().splitlines():
        word = line.split()
        if not word:
            continue
        if word[0] in values:
            current = values[word[0]]
        elif current is not None and len(word) == 4:
            current[int(word[0]) - 1] = [float(w) for w in word[1:]]
    if np.isnan(values["displacements"]).any():
        raise Failed(f"{file} lacks displacements")
    return values["displacements"], values["forces"]
