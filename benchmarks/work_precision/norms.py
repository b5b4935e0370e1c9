# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors of forces and displacements, Pareto fronts, exponents of growth."""

import numpy as np


def at(times, wanted):
    """Indices of `wanted` in `times`, both ascending [s]; raises ValueError if one is missing."""
    index = np.clip(np.searchsorted(times, wanted - 1e-9), 0, len(times) - 1)
    if np.abs(times[index] - wanted).max(initial=0.0) > 1e-9:
        raise ValueError("the reference lacks a time of the run")
    return index


def force_error(times, forces, reference_times, reference_forces):
    """(RMS, maximum) over the run's times of |F - F_ref|, as parts of the largest |F_ref|.
    times (k) [s], forces (k, 3) [N]; the reference has these times among others."""
    wanted = reference_forces[at(reference_times, times)]
    scale = peak(reference_forces)
    if not scale > 0.0:
        raise ValueError("the reference feels no force")
    error = np.linalg.norm(forces - wanted, axis=1) / scale
    return float(np.sqrt(np.mean(error ** 2))), float(error.max())


def peak(forces):
    """The largest |F| of forces (k, 3) [N]."""
    return float(np.linalg.norm(forces, axis=1).max())


def displacement_error(times, frames, reference_times, reference_frames):
    """Relative L2 over all nodes and common times: frames (k, n, 3) [m] of the same nodes. NaN where
    the reference does not move."""
    wanted = reference_frames[at(reference_times, times)]
    scale = np.linalg.norm(wanted)
    return float(np.linalg.norm(frames - wanted) / scale) if scale > 0.0 else float("nan")


def pareto(errors, costs):
    """Indices of the points than which none is both cheaper and more accurate, by cost. Points
    that are not finite are left out."""
    errors, costs = np.asarray(errors, float), np.asarray(costs, float)
    order = sorted((i for i in range(len(costs)) if np.isfinite(errors[i]) and np.isfinite(costs[i])),
                   key=lambda i: (costs[i], errors[i]))
    front, best = [], np.inf
    for i in order:
        if errors[i] < best:
            front.append(i)
            best = errors[i]
    return front


def cost_at(wanted, errors, costs):
    """What an error of `wanted` costs, of meshes from coarse to fine: between neighbours of which one is worse and
    the other is not, along a power law; else of the cheapest that is not worse. NaN if all are worse."""
    found = [c for e, c in zip(errors, costs) if e <= wanted]
    for (e1, c1), (e2, c2) in zip(zip(errors, costs), zip(errors[1:], costs[1:])):
        if e2 <= wanted < e1 and e2 > 0.0:
            part = np.log(e1 / wanted) / np.log(e1 / e2)
            found.append(float(c1 ** (1 - part) * c2 ** part))
    return min(found, default=float("nan"))


def exponent(sizes, costs):
    """p of the power law cost = c size^p nearest to the points in the logarithms."""
    if len(sizes) < 2:
        raise ValueError("an exponent needs two sizes")
    return float(np.polyfit(np.log(sizes), np.log(costs), 1)[0])
