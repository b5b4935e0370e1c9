# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of `palpate hand`, side by side, and the scenes they are on."""

import concurrent.futures
import os
import re
import subprocess

import yaml
from accuracy.solve import ROOT, Failed, program, read_table

SHIPPED = ROOT / "config" / "scenes"
STIFF = {"law": "neo_hookean", "poisson_ratio": 0.45, "density": 1000.0}
PRINTED = {"swing": r"swing of the last .* s: (\S+) mm", "tissue": r"stiffness of the tissue (\S+) N/m",
           "rendered": r"as rendered (\S+) N/m", "energy": r"at most: (\S+) mJ", "deepest": r"deepest (\S+) mm"}


def block(folder, young_modulus):
    """The shipped slab, of so stiff a solid [Pa] that the contact's own stiffness is not felt."""
    scene = yaml.safe_load((SHIPPED / "slab_probe.yaml").read_text())
    organ = scene["organs"][0]
    organ["surface"] = str((SHIPPED / organ["surface"]).resolve())
    organ["material"] = dict(STIFF, young_modulus=float(young_modulus))
    organ["adapt"] = {"finest": 0.004}
    scene["instruments"][0]["urdf"] = str((SHIPPED / scene["instruments"][0]["urdf"]).resolve())
    scene["contact"] = {"stiffness": max(3.0e8, 1.0e4 * float(young_modulus))}
    return write(folder, f"block_{young_modulus:.3g}.yaml", scene)


def uniform_liver(folder):
    """The shipped liver on a mesh that stays: one that follows the tool differs with the step."""
    scene = yaml.safe_load((SHIPPED / "liver_palpation.yaml").read_text())
    organ = scene["organs"][0]
    organ["surface"] = str((SHIPPED / organ["surface"]).resolve())
    organ["material"] = {"file": str((SHIPPED / organ["material"]["file"]).resolve())}
    organ["edge_length"] = 0.01
    del organ["adapt"]
    scene["instruments"][0]["urdf"] = str((SHIPPED / scene["instruments"][0]["urdf"]).resolve())
    return write(folder, "liver_uniform.yaml", scene)


def write(folder, name, scene):
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / name
    file.write_text(yaml.safe_dump(scene))
    return file


def hand(scene, **options):
    """What one run printed, by PRINTED, and the command. Options as on the command line; True: a flag."""
    words = [str(scene)]
    for name, value in options.items():
        words += [f"--{name.replace('_', '-')}"] + ([] if value is True else [f"{value:.9g}" if isinstance(
            value, float) else str(value)])
    done = subprocess.run([str(program()), "hand", *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise Failed(f"palpate hand {' '.join(words)}: {done.stderr.strip().splitlines()[-1:]}")
    return {name: float(re.search(pattern, done.stdout).group(1)) for name, pattern in PRINTED.items()}


def each(run, cases):
    """{case: run(case)}, as many at a time as there are cores."""
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return dict(zip(cases, pool.map(run, cases)))


def columns(file, *names):
    """Columns of a CSV file, as lists."""
    return [[float(row[name]) for row in rows] for rows in [read_table(file)] for name in names]
