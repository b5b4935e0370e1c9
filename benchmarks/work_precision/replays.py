# SPDX-License-Identifier: GPL-3.0-or-later
"""`palpate replay` on copies of shipped scenes with some keys changed, and what it wrote."""

import copy
import dataclasses
import hashlib
import json
import pathlib
import subprocess
import time

import numpy as np
import yaml

from accuracy.solve import ROOT, Failed, program, read_table

from . import norms

FILES = ("surface", "tetrahedra", "urdf", "file", "trajectory")  # keys whose text is a path from the scene's folder


def shipped(name):
    """A scene of config/scenes as Python values, with whole paths."""
    folder = ROOT / "config" / "scenes"
    return _with_whole_paths(yaml.safe_load((folder / f"{name}.yaml").read_text()), folder)


def _with_whole_paths(value, folder):
    if isinstance(value, list):
        return [_with_whole_paths(v, folder) for v in value]
    if not isinstance(value, dict):
        return value
    return {key: str((folder / v).resolve()) if key in FILES and isinstance(v, str) and "://" not in v
            else _with_whole_paths(v, folder) for key, v in value.items()}


def but(scene, organ=None, **sections):
    """A copy in which keys of the first organ and of sections are others; None: the key is not there.
    but(scene, {"adapt": {...}}, solver={"step": 0.005})."""
    scene = copy.deepcopy(scene)
    for values, changes in [(scene["organs"][0], organ or {})] + [
            (scene.setdefault(name, {}), changes) for name, changes in sections.items()]:
        for key, value in changes.items():
            if value is None:
                values.pop(key, None)
            else:
                values[key] = value
    return scene


def adapted(scene, finest, growth=None):
    """A copy whose first organ follows its tools; finest None: does not."""
    if finest is None:
        return but(scene, {"adapt": None})
    return but(scene, {"adapt": {"finest": finest, **({} if growth is None else {"growth": growth})}})


def elastic(scene):
    """(A copy whose first organ has no viscous terms, whether it had any)."""
    material = dict(scene["organs"][0]["material"])
    if "file" in material:
        known = yaml.safe_load(pathlib.Path(material.pop("file")).read_text())
        for key in ("description", "sources", "choices"):
            known.pop(key, None)
        material = {**known, **material}
    viscous = bool(material.pop("viscoelastic", None))
    return (but(scene, {"material": material}), True) if viscous else (scene, False)


@dataclasses.dataclass(frozen=True, eq=False)
class Motion:
    """A table of joint positions: values (k, joints) [m or rad] at times (k) [s]."""
    names: tuple
    times: np.ndarray
    values: np.ndarray

    def during(self, begin, end):
        rows = (self.times > begin - 1e-9) & (self.times < end + 1e-9)
        return Motion(self.names, self.times[rows], self.values[rows])

    def text(self):
        rows = [",".join(("t",) + self.names)]
        rows += [f"{t:.4f}," + ",".join(f"{v:.9f}" for v in row) for t, row in zip(self.times, self.values)]
        return "\n".join(rows) + "\n"


class Played:
    """What a replay gave: columns of R.csv by name, `forces` (k, 3) [N]."""

    def __init__(self, folder):
        rows = read_table(folder / "R.csv")
        self.folder = folder
        self.status = [r["status"] for r in rows]
        self.hashes = [r["state_hash"] for r in rows]
        words = ("status", "state_hash")
        self.columns = {k: np.array([float(r[k]) for r in rows]) for k in rows[0] if k not in words}
        self.forces = np.column_stack([self.columns[k] for k in ("fx", "fy", "fz")])
        self.log = (folder / "log.txt").read_text()
        self.resident = json.loads((folder / "resident.json").read_text())  # [(part of the wall time, MB)]

    def __getitem__(self, name):
        return self.columns[name]

    @property
    def times(self):
        return self.columns["t"]

    @property
    def bad(self):
        """Rows that did not converge."""
        return sum(s != "converged" for s in self.status)

    @property
    def peak(self):
        return norms.peak(self.forces)

    def ms(self, part):
        """Quantile of the time of a cycle [ms]."""
        return float(np.quantile(self.columns["step_ms"], part))

    def bits(self):
        """All that depends on the inputs alone."""
        return [self.columns[k].tobytes() for k in sorted(self.columns) if k != "step_ms"] + self.status + self.hashes


def play(context, scene, motion, threads=1, *, kept=False, again=False, words=()):
    """The Played of a scene, a motion and more words of the command line, in which {folder} is the folder of the
    results. `kept`: times do not matter, and it is kept while the program is the same; `again`: anew in any case."""
    texts = yaml.safe_dump(scene, sort_keys=False), motion.text(), str(threads), *map(str, words)
    name = hashlib.sha256("\0".join(texts).encode()).hexdigest()[:16]
    folder = context.work / ("references" if kept else "runs") / f"replay_{name}"
    if not again and (kept or context.resume) and (folder / "resident.json").exists():
        return Played(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "resident.json").unlink(missing_ok=True)
    (folder / "scene.yaml").write_text(texts[0])
    (folder / "T.csv").write_text(texts[1])
    begin = time.time()
    command = [program(), "replay", folder / "scene.yaml", "--trajectory", folder / "T.csv",
               "--out", folder / "R.csv", "--threads", str(threads), *(str(w).format(folder=folder) for w in words)]
    with open(folder / "log.txt", "w", encoding="utf-8") as log:
        child = subprocess.Popen(list(map(str, command)), stdout=log, stderr=subprocess.STDOUT)
        resident = _watch(child, begin)
    if child.returncode not in (0, 1):
        raise Failed(f"palpate replay {folder}/scene.yaml: status {child.returncode}: "
                     + (folder / "log.txt").read_text().strip()[-400:])
    wall = time.time() - begin
    # Written last: a folder that has it is whole.
    (folder / "resident.json").write_text(json.dumps([((t - begin) / wall, mb) for t, mb in resident]))
    return Played(folder)


def _watch(child, begin):
    """[(time, resident memory [MB])] of a process until it ends, some hundred at most."""
    found, wait = [], 0.02
    while child.poll() is None:
        found.append((time.time(), _resident(child.pid)))
        wait = max(wait, (time.time() - begin) / 200)  # first often, then seldom: it is not known how long it takes
        try:
            child.wait(wait)
        except subprocess.TimeoutExpired:
            pass
    return [(t, mb) for t, mb in found if mb > 0.0]


def _resident(pid):
    try:
        for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines():
            if line.startswith("VmRSS:"):
                return int(line.split()[1]) / 1024
    except OSError:
        pass
    return 0.0
