# SPDX-License-Identifier: GPL-3.0-or-later
"""How far off a figure of the finest mesh may be, from coarser meshes and theory alone: a bound must not
come from the error that it is to judge."""

import math


def refined(sizes, values, scale, order):
    """The grid convergence index [Roache 1994, J. Fluids Eng. 116, 405]: what refining further may still
    change, as a part of |scale|: Fs |f1 - f2| / (r^p - 1), r the ratio of the two finest sizes, p the
    order that theory promises at least, Fs = 1.25 for three meshes and more, 3 for two. Neither the
    reference nor the error enters; an error that no mesh removes is not covered, and fails.

    sizes: of the elements, coarse to fine; values: what each gave."""
    ratio = sizes[-2] / sizes[-1]
    safety = 1.25 if len(values) > 2 else 3.0
    return safety * abs(values[-1] - values[-2]) / (ratio ** order - 1.0) / abs(scale)


def held(force, young, poisson, depth, displacement):
    """What a block that is held `depth` [m] below its load changes of a half space, as a part: the
    displacement that the half space has there under a point load [Boussinesq 1885], over that of the tool."""
    return force * (1 + poisson) * (3 - 2 * poisson) / (2 * math.pi * young * depth) / displacement


def extrapolated(sizes, values):
    """(limit, order) of value = limit + c size^order through the last three; (NaN, NaN) where these do not
    close in on one."""
    (h1, h2, h3), (f1, f2, f3) = sizes[-3:], values[-3:]

    def miss(order):
        return (f1 - f2) * (h2 ** order - h3 ** order) - (f2 - f3) * (h1 ** order - h2 ** order)
    low, high = 0.1, 8.0
    if (f1 - f2) * (f2 - f3) <= 0.0 or miss(low) * miss(high) > 0.0:
        return math.nan, math.nan
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if miss(low) * miss(middle) > 0.0 else (low, middle)
    c = (f2 - f3) / (h2 ** low - h3 ** low)
    return f3 - c * h3 ** low, low
