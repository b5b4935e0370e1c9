# SPDX-License-Identifier: GPL-3.0-or-later
"""What a suite works with: measured runs, references, progress, and the table of everything."""

import concurrent.futures
import csv
import math
import os
import pathlib
import time

from accuracy.solve import Failed, build_folder

from . import norms
from .runs import P99_CYCLES, Run, bench, methods

# Of references: backward differences of order two with steps ten times as short and more, and
# tolerances of forces, positions and linear systems far below those that are judged.
REFERENCE = {"integrator": "bdf2", "step": 5e-4, "tolerance": 1e-7, "linear_tolerance": 1e-3,
             "max_newton": 50, "threads": 1, "sets": ("solver.position_tolerance=1e-9",)}
COLUMNS = ["suite", "scene", "tets", "nodes", "finest", "adapt", "element", "poisson_ratio", "method", "integrator", "step",
           "tolerance", "linear_tolerance", "threads", "sets", "force_error_rms", "force_error_max",
           "displacement_error", "median_ms", "max_ms", "ms_per_second", "typical_median_ms",
           "timed_cycles", "p99_ms", "newton_iterations", "linear_iterations", "skipped", "failed_cycles",
           "peak_megabytes"]


class Context:
    def __init__(self, work, images, quick, resume):
        self.work, self.images, self.quick, self.resume = pathlib.Path(work), images, quick, resume
        self.start, self.suite = time.time(), ""
        self.methods = methods()
        self.lines = {}  # of the table of everything, by the run's folder
        self.commands = []

    def progress(self, text):
        print(f"[{time.time() - self.start:6.0f} s] {self.suite}: {text}", flush=True)

    def measure(self, config, repeats=3, seconds=6.0):
        """A timed run: so many repeats and enough for a 99th percentile, but none begins after
        `seconds`. Nothing else of this program runs meanwhile. With --resume one that was finished
        before by the same program is taken as it is."""
        if config.method is not None and config.method not in self.methods:
            raise Failed(f"this build has no method {config.method}")
        folder = self.work / "runs" / config.name()
        known = str(folder) in self.lines
        if known or (self.resume and (folder / "summary.json").exists()):
            run = Run(config, folder)
        else:
            run = bench(config, folder, repeats, 1 if self.quick else P99_CYCLES, seconds)
            self.progress(f"{' '.join(config.arguments())}: {run.median_ms:.3g} ms, p99 {run.p99_text}"
                          + (" FAILED CYCLES" if run.failed else ""))
        if not known:
            self.lines[str(folder)] = self._line(run)
        return run

    def attempt(self, config, **options):
        """As measure(), or None where the program refuses (a method that a scene does not allow)."""
        try:
            return self.measure(config, **options)
        except Failed as failure:
            self.progress(f"left out: {failure}")
            return None

    def reference(self, config):
        """The reference of a configuration: same scene, mesh, element and law."""
        return self.kept(self._reference_config(config))

    def kept(self, config):
        """A run whose times do not matter. Kept while the program is the same."""
        folder = self.work / "references" / config.name()
        if not (folder / "summary.json").exists():
            begin = time.time()
            bench(config, folder)
            self.progress(f"reference {' '.join(config.arguments())}: {time.time() - begin:.0f} s")
        return Run(config, folder)

    def prepare(self, configs):
        """Computes references of configurations side by side; times do not matter for them."""
        self.keep([self._reference_config(c) for c in configs])

    def keep(self, configs):
        """Runs that kept() then has, side by side."""
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            list(pool.map(self.kept, {c.name(): c for c in configs}.values()))

    def _reference_config(self, config):
        # By factorisation, which shares no linear solver with what is judged, where that is cheap.
        small = config.tets is not None and config.tets < 3000
        method = "implicit_direct" if small and "implicit_direct" in self.methods else "implicit_pcg"
        return config.but(method=method, **REFERENCE)

    def errors(self, run, reference=None):
        """{"rms", "max", "displacement"} of a run; a force error is NaN where no tool touches. Kept
        in the table of everything."""
        reference = reference or self.reference(run.config)
        found = {"displacement": norms.displacement_error(*run.frames(), *reference.frames())}
        try:
            found["rms"], found["max"] = norms.force_error(*run.forces(), *reference.forces())
        except ValueError:
            found["rms"] = found["max"] = float("nan")
        if run.failed:
            found = {key: float("nan") for key in found}
        line = self.lines.get(str(run.folder))
        if line is not None:
            line.update(force_error_rms=found["rms"], force_error_max=found["max"],
                        displacement_error=found["displacement"])
        return found

    def _line(self, run):
        s, settings = run.summary, run.summary["settings"]
        line = {"suite": self.suite, "finest": run.config.finest or "",
                "adapt": run.config.adapt or "", "sets": " ".join(run.config.sets), **s["fastest"],
                "typical_median_ms": s["typical"]["median_ms"], "timed_cycles": run.timed_cycles,
                "p99_ms": run.p99_ms if math.isfinite(run.p99_ms) else ""}
        for key in ("scene", "tets", "nodes", "element", "poisson_ratio", "newton_iterations",
                    "linear_iterations", "skipped", "failed_cycles", "peak_megabytes"):
            line[key] = s[key]
        for key in ("method", "integrator", "step", "tolerance", "linear_tolerance", "threads"):
            line[key] = settings.get("solver." + key, "")
        return line

    def write_table(self, file):
        """Every measured run as a row."""
        with open(file, "w", encoding="utf-8", newline="") as text:
            table = csv.DictWriter(text, COLUMNS, restval="", extrasaction="ignore")
            table.writeheader()
            table.writerows(self.lines.values())


def build_work():
    return build_folder() / "benchmark"
