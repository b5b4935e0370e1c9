# SPDX-License-Identifier: GPL-3.0-or-later
"""The page's two kinds of figure: cost over error, and cost over size."""

import math

from accuracy.plots import figure, save  # before matplotlib: it chooses the backend
from matplotlib.lines import Line2D

from . import norms

METHOD_COLOUR = {
    "implicit_pcg": "#1f4e79", "implicit_direct": "#8a5a00", "implicit_async": "#3a7d44",
    "tled": "#b5322a", "lbfgs": "#7a3b8f", "linear_precomputed": "#2a9d9d",
    "newton_bicgstab": "#888888", "auto": "#000000", "Bullet": "#d98a00", "CalculiX": "#d98a00"}
MARKERS = "osD^vPX*"


def colour(name, position=0):
    return METHOD_COLOUR.get(name) or ["#1f4e79", "#b5322a", "#3a7d44", "#8a5a00", "#7a3b8f",
                                       "#2a9d9d"][position % 6]


def work_precision(folder, file, panels, cost_label, error_label):
    """panels: {title: {series: [(error, cost, variant)]}}. One marker a variant, one colour a series;
    a thick grey line joins what nothing beats. Returns the file's name."""
    variants = list(dict.fromkeys(v for p in panels.values() for s in p.values() for _, _, v in s))
    series = list(dict.fromkeys(name for p in panels.values() for name in p))
    columns = len(panels)
    fig, axes = _with_legend(columns, 3.9 * columns, 4.6)
    for axis, (title, found) in zip(axes, panels.items()):
        points = [(e, c) for s in found.values() for e, c, _ in s if math.isfinite(e) and e > 0]
        front = norms.pareto([e for e, _ in points], [c for _, c in points])
        axis.plot([100 * points[i][0] for i in front], [points[i][1] for i in front], "-",
                  color="#cccccc", linewidth=5, zorder=1, solid_capstyle="round")
        for name, values in found.items():
            values = [v for v in values if math.isfinite(v[0]) and v[0] > 0]
            axis.plot([100 * e for e, _, _ in values], [c for _, c, _ in values], "-", linewidth=0.8,
                      color=colour(name, series.index(name)), zorder=2)
            for error, cost, variant in values:
                axis.plot([100 * error], [cost], MARKERS[variants.index(variant) % len(MARKERS)],
                          color=colour(name, series.index(name)), zorder=3)
        axis.set(title=title, xlabel=error_label, xscale="log", yscale="log")
        axis.grid(True, which="both", color="#eeeeee")
    axes[0].set_ylabel(cost_label)
    axes[-1].legend(handles=_handles(series, variants), loc="center left")
    return save(fig, folder, file)


def _with_legend(columns, width, height):
    """A row of axes that share y, and one more at the right that holds the legend."""
    fig, axes = figure(columns + 1, width=width + 2.3, height=height,
                       gridspec_kw={"width_ratios": [width / columns] * columns + [2.3]})
    for axis in axes[1:columns]:
        axis.sharey(axes[0])
    axes[-1].axis("off")
    return fig, axes


def _handles(series, variants):
    handles = [Line2D([], [], color=colour(n, i), linewidth=2, label=n) for i, n in enumerate(series)]
    if variants != [""]:
        handles += [Line2D([], [], color="#444444", marker=MARKERS[i % len(MARKERS)], linestyle="",
                           label=v) for i, v in enumerate(variants)]
    return handles + [Line2D([], [], color="#cccccc", linewidth=5, label="not beaten")]


def growth(folder, file, series, cost_label, size_label="tetrahedra", line=None):
    """series: {name: [(size, cost)]}, each with its exponent in the legend. `line`: (cost, text) of
    a level to be seen."""
    fig, (axis, beside) = _with_legend(1, 5.6, 4.4)
    for position, (name, values) in enumerate(series.items()):
        sizes, costs = [s for s, _ in values], [c for _, c in values]
        text = f"{name}: exponent {norms.exponent(sizes, costs):.2f}" if len(values) > 1 else name
        axis.plot(sizes, costs, "o-", label=text, color=colour(name.split(",")[-1].strip(), position))
    if line:
        axis.axhline(line[0], color="#999999", linestyle="--", linewidth=1, label=line[1])
    axis.set(xscale="log", yscale="log", xlabel=size_label, ylabel=cost_label)
    axis.grid(True, which="both", color="#eeeeee")
    beside.legend(*axis.get_legend_handles_labels(), loc="center left")
    return save(fig, folder, file)
