# SPDX-License-Identifier: GPL-3.0-or-later
"""What the hand feels of a change of the mesh."""

import numpy as np

NEAR = 10  # cycles before and after, among which a change is compared
BOUND = 0.01  # of the peak: a step that counts


def steps(forces):
    """|F_k - F_k-1| of each cycle (k) [N]; 0 of the first."""
    return np.concatenate([[0.0], np.linalg.norm(np.diff(forces, axis=0), axis=1)])


class Jumps:
    """The steps of a Played's force while it is touched, of cycles in which the mesh changed and of others, as parts of
    the largest force. A motion has steps of its own, so that those at a change are compared with their neighbours."""

    def __init__(self, played):
        size = steps(played.forces) / played.peak
        touched = np.linalg.norm(played.forces, axis=1) > 0.0
        touched[1:] &= touched[:-1]
        changed = played["mesh_changes"] > 0
        at, others = np.flatnonzero(touched & changed), touched & ~changed
        self.changes = len(at)
        self.largest, self.rms = _figures(size[at])
        self.elsewhere, self.usual = _figures(size[others])
        excess = np.array([size[k] - self._around(size, others, k) for k in at])
        self.excess = float(excess.max(initial=0.0))  # over the largest step of the cycles near it
        self.above = int(np.sum(excess > BOUND))
        self.added = float(np.sqrt(max(0.0, self.rms ** 2 - self.usual ** 2)))  # to the RMS step

    @staticmethod
    def _around(size, others, k):
        near = slice(max(0, k - NEAR), k + NEAR + 1)
        return size[near][others[near]].max(initial=0.0)


def _figures(size):
    """(Largest, RMS)."""
    return (float(size.max()), float(np.sqrt(np.mean(size ** 2)))) if len(size) else (0.0, 0.0)
