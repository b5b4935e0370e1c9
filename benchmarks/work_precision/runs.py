# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs `palpate bench`, keeps what it wrote in a folder a configuration, and reads it."""

import dataclasses
import hashlib
import json
import math
import re
import shutil
import subprocess
from typing import Optional

import numpy as np

from accuracy.solve import ROOT, Failed, program, read_table


@dataclasses.dataclass(frozen=True)
class Config:
    """What `palpate bench` is asked for; None: what the scene has."""
    scene: str
    tets: Optional[int] = None
    edge_length: Optional[float] = None
    finest: Optional[float] = None
    adapt: Optional[float] = None
    growth: Optional[float] = None
    poisson_ratio: Optional[float] = None
    element: Optional[str] = None
    method: Optional[str] = None
    integrator: Optional[str] = None
    step: Optional[float] = None
    tolerance: Optional[float] = None
    linear_tolerance: Optional[float] = None
    max_newton: Optional[int] = None
    threads: Optional[int] = None
    duration: Optional[float] = None
    sets: tuple = ()  # KEY=VALUE

    def but(self, **changes):
        return dataclasses.replace(self, **changes)

    def arguments(self):
        words = []
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if field.name == "sets":
                words += [w for s in value for w in ("--set", s)]
            elif value is not None:
                words += ["--" + field.name.replace("_", "-"), str(value)]
        return words

    def name(self):
        """Of a folder: readable, and different for different configurations."""
        text = " ".join(self.arguments())
        words = "_".join(str(w) for w in (self.scene, self.tets, self.finest, self.adapt, self.element,
                                                self.method, self.step)
                         if w is not None)
        return words + "_" + hashlib.sha256(text.encode()).hexdigest()[:10]


P99_CYCLES = 500  # from fewer a 99th percentile is little more than the slowest cycle


class Run:
    """What one configuration gave."""

    def __init__(self, config, folder):
        self.config, self.folder = config, folder
        self.summary = json.loads((folder / "summary.json").read_text())

    def table(self, file="forces.csv"):
        return read_table(self.folder / file)

    def forces(self):
        """Times (k) [s] and forces on the tool (k, 3) [N]."""
        rows = self.table()
        return (np.array([float(r["t"]) for r in rows]),
                np.array([[float(r[c]) for c in ("fx", "fy", "fz")] for r in rows]))

    def column(self, name):
        """A figure of each cycle (k): mesh_error [N], nodes, mesh_changes, min_jacobian ..."""
        return np.array([float(r[name]) for r in self.table()])

    def frames(self):
        """Times (k) [s] and displacements (k, n, 3) [m]."""
        times = np.array(self.summary["frame_times"])
        values = np.fromfile(self.folder / "displacements.bin", dtype="<f8")
        return times, values.reshape(len(times), -1, 3)

    @property
    def failed(self):
        """A cycle whose solve failed, or forces that differ between repeats."""
        return self.summary.get("failed_cycles", 0) > 0 or not self.summary.get("same_bits", True)

    @property
    def step_ms(self):
        """Mean time of a cycle in the fastest repeat [ms]."""
        return self.second_ms * self.summary["duration"] / self.summary["cycles"]

    @property
    def second_ms(self):
        """Time of a simulated second in the fastest repeat [ms]."""
        return self.summary["fastest"]["ms_per_second"]

    @property
    def median_ms(self):
        return self.summary["fastest"]["median_ms"]

    @property
    def timed_cycles(self):
        """In all repeats together."""
        return self.summary["cycles"] * self.summary["repeats"]

    @property
    def p99_ms(self):
        """Of the cycles of all repeats together; NaN where these are too few to say."""
        return self.summary["pooled"]["p99_ms"] if self.timed_cycles >= P99_CYCLES else math.nan

    @property
    def p99_text(self):
        """For a table of milliseconds."""
        return f"{self.p99_ms:.2f}" if math.isfinite(self.p99_ms) else "-"


def bench(config, folder, repeats=1, cycles=1, seconds=None):
    """The Run of a configuration, anew. @throws Failed with what palpate said."""
    working = folder.with_name(folder.name + ".part")
    shutil.rmtree(working, ignore_errors=True)
    working.parent.mkdir(parents=True, exist_ok=True)
    command = [program(), "bench", *config.arguments(), "--repeat", str(repeats), "--cycles", str(cycles),
               "--out", str(working)]
    if seconds is not None:
        command += ["--seconds", str(seconds)]
    done = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode not in (0, 1) or not (working / "summary.json").exists():
        raise Failed(f"palpate bench {' '.join(config.arguments())}: status {done.returncode}: "
                     + done.stderr.strip()[-400:])
    shutil.rmtree(folder, ignore_errors=True)
    working.rename(folder)  # a folder with its final name is whole
    return Run(config, folder)


def methods():
    """Names of solver.method that this build knows."""
    done = subprocess.run([program(), "bench", "--scene", "cube", "--tets", "6", "--method", "?"],
                          cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    found = re.search(r"solver\.method = \?: must be one of (.*)", done.stderr)
    if not found:
        raise Failed("palpate bench does not say which methods there are: " + done.stderr.strip()[-300:])
    return [name.strip() for name in found.group(1).split(",")]
