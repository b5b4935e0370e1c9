# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the true force lies within the error that stands beside the force that the hand feels."""

import dataclasses

import numpy as np

from accuracy.rows import table

WANTED = 0.9  # of the cases
HEAD = ["case", "force", "its mesh error, estimated", "converged force", "off by", "estimate over error", "within",
        "of all cycles that touch"]


@dataclasses.dataclass(frozen=True)
class Bracket:
    """Where the true force is largest, all [N]; `share`: of the cycles that touch, those where it holds."""
    force: float
    estimate: float
    truth: float
    error: float  # |F - F_true|, as vectors
    share: float

    @property
    def holds(self):
        return self.error <= self.estimate

    def line(self, case):
        """Of a table with HEAD."""
        return [case, f"{self.force:.3f} N", f"{self.estimate:.3f} N", f"{self.truth:.3f} N", f"{self.error:.3f} N",
                f"{self.estimate / self.error:.2f}" if self.error > 0.0 else "-", "yes" if self.holds else "**no**",
                f"{100 * self.share:.0f} %"]


def bracket(forces, estimates, truth):
    """forces, truth (k, 3) at the same times, estimates (k) of what the forces are too large by, all [N]."""
    error = np.linalg.norm(forces - truth, axis=1)
    size = np.linalg.norm(truth, axis=1)
    peak = int(size.argmax())
    touches = size > 0.05 * size[peak]  # below, both are as good as nothing
    return Bracket(float(np.linalg.norm(forces[peak])), float(estimates[peak]), float(size[peak]), float(error[peak]),
                   float(np.mean(error[touches] <= estimates[touches])))


def tabled(cases):
    """Markdown of [(case, Bracket)], with how many hold."""
    held = sum(b.holds for _, b in cases)
    reached = held >= WANTED * len(cases)
    text = (f"The converged force is within the force and its estimated error in {held} of {len(cases)} cases; nine "
            f"of ten are asked for: {'reached' if reached else '**missed**'}.\n\n")
    return text + table(HEAD, [b.line(case) for case, b in cases])
