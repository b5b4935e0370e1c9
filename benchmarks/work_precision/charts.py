# SPDX-License-Identifier: GPL-3.0-or-later
"""The page's two kinds of figure: cost over error, and cost over size."""

import itertools
import math

from accuracy.plots import COLOUR, figure, save  # before matplotlib: it chooses the backend
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from . import norms

METHOD_COLOUR = {
    "implicit_pcg": "#1f4e79", "implicit_pcg bdf2": "#5b9bd5", "implicit_direct": "#8a5a00",
    "implicit_async": "#3a7d44",
    "tled": "#b5322a", "lbfgs": "#7a3b8f", "linear_precomputed": "#2a9d9d",
    "newton_bicgstab": "#999999", "auto": "#000000"}
MARKERS = "osD^vPX*"
OVER_TIME = ("#b5322a", "#1f4e79", "#8a5a00", "#3a7d44")


def colour(name):
    """Of a method, an element, or "element, method"."""
    last = name.split(", ")[-1]
    return METHOD_COLOUR.get(last) or COLOUR.get(last, "#444444")


def work_precision(folder, file, panels, cost_label, error_label, join_variants=True):
    """panels: {title: {series: [(error, cost, variant)]}}. One marker a variant, one colour a series;
    a thick grey line joins what nothing beats; thin lines join a series, or each of its variants
    alone. Returns the file's name."""
    variants = list(dict.fromkeys(v for p in panels.values() for s in p.values() for _, _, v in s))
    series = list(dict.fromkeys(name for p in panels.values() for name in p))
    fig, axes = _with_legend(len(panels), 3.9 * len(panels), 4.6)
    for axis, (title, found) in zip(axes, panels.items()):
        found = {name: [(100 * e, c, v) for e, c, v in values if math.isfinite(e) and e > 0]
                 for name, values in found.items()}
        points = [(e, c) for values in found.values() for e, c, _ in values]
        front = [points[i] for i in norms.pareto([e for e, _ in points], [c for _, c in points])]
        if front:
            axis.plot(*zip(*front), "-", color="#cccccc", linewidth=5, zorder=1, solid_capstyle="round")
        for name, values in found.items():
            for line in _lines(values, join_variants):
                axis.plot([e for e, _, _ in line], [c for _, c, _ in line], "-", linewidth=0.8,
                          color=colour(name), zorder=2)
            for error, cost, variant in values:
                axis.plot([error], [cost], MARKERS[variants.index(variant) % len(MARKERS)],
                          color=colour(name), zorder=3)
        axis.set(title=title, xlabel=error_label)
        _logarithmic(axis)
        _widen(axis, [e for e, _ in points])
    axes[0].set_ylabel(cost_label)
    axes[-1].legend(handles=_handles(series, variants), loc="center left")
    return save(fig, folder, file)


def _lines(values, join_variants):
    if join_variants:
        return [values]
    ordered = sorted(values, key=lambda v: v[2])
    return [list(group) for _, group in itertools.groupby(ordered, key=lambda v: v[2])]


def _with_legend(columns, width, height):
    """A row of axes that share y, and one more at the right that holds the legend."""
    fig, axes = figure(columns + 1, width=width + 2.3, height=height,
                       gridspec_kw={"width_ratios": [width / columns] * columns + [2.3]})
    for axis in axes[1:columns]:
        axis.sharey(axes[0])
    axes[-1].axis("off")
    return fig, axes


def _handles(series, variants):
    handles = [Line2D([], [], color=colour(n), linewidth=2, label=n) for n in series]
    if variants != [""]:
        handles += [Line2D([], [], color="#444444", marker=MARKERS[i % len(MARKERS)], linestyle="",
                           label=v) for i, v in enumerate(variants)]
    return handles + [Line2D([], [], color="#cccccc", linewidth=5, label="not beaten")]


def _logarithmic(axis):
    """Logarithmic in x and y, with plain numbers at 1, 2 and 5."""
    axis.set(xscale="log", yscale="log")
    for side in (axis.xaxis, axis.yaxis):
        side.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        side.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        side.set_minor_formatter(NullFormatter())
    axis.grid(True, which="both", color="#eeeeee")
    axis.set_axisbelow(True)


def _widen(axis, values):
    """At least a decade in x, so that close points look close."""
    if not values:
        return
    low, high = min(values), max(values)
    extra = max(1.15, math.sqrt(max(1.0, 10.0 / (high / low))))
    axis.set_xlim(low / extra, high * extra)


def growth(folder, file, series, cost_label, size_label="tetrahedra", line=None):
    """series: {"element, method": [(size, cost)]}, each with its exponent in the legend; dashed for
    tet4. `line`: (cost, text) of a level to be seen."""
    fig, (axis, beside) = _with_legend(1, 5.6, 4.4)
    for name, values in series.items():
        sizes, costs = [s for s, _ in values], [c for _, c in values]
        text = f"{name}: exponent {norms.exponent(sizes, costs):.2f}" if len(values) > 1 else name
        axis.plot(sizes, costs, "o--" if name.startswith("tet4") else "o-", label=text, color=colour(name))
    if line:
        axis.axhline(line[0], color="#999999", linestyle=":", linewidth=1.5, label=line[1])
    axis.set(xlabel=size_label, ylabel=cost_label)
    _logarithmic(axis)
    beside.legend(*axis.get_legend_handles_labels(), loc="center left")
    return save(fig, folder, file)


def over_time(folder, file, panels, label):
    """panels: {title: {series: (times (k) [s], forces (k, 3))}}: their length over time, "converged" in black."""
    fig, axes = figure(1, width=8.2, height=3.1 * len(panels), nrows=len(panels), squeeze=False)
    axes = axes[:, 0]
    for axis, (title, series) in zip(axes, panels.items()):
        for k, (name, (times, forces)) in enumerate(series.items()):
            true = name == "converged"
            axis.plot(times, np.linalg.norm(forces, axis=1), "--" if true else "-", label=name,
                      color="#000000" if true else OVER_TIME[k % len(OVER_TIME)], linewidth=1.2)
        axis.set(title=title, ylabel=label)
        axis.legend(loc="upper left", fontsize=8)
    axes[-1].set_xlabel("time [s]")
    return save(fig, folder, file)
