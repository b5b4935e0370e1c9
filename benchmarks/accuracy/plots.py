# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of the page: one style, the same bytes for the same numbers."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

COLOUR = {"tet4": "#b5322a", "anp": "#1f4e79", "p1p1": "#3a7d44", "tet10": "#8a5a00",
          "tet10p": "#7b4aa0", "reference": "#444444"}

plt.rcParams.update({
    "svg.hashsalt": "palpate", "svg.fonttype": "path", "font.size": 10, "axes.grid": True,
    "grid.color": "#dddddd", "axes.spines.top": False, "axes.spines.right": False,
    "legend.frameon": False, "lines.linewidth": 1.6, "lines.markersize": 5,
    "figure.constrained_layout.use": True})


def figure(columns=1, width=6.4, height=3.6, **options):
    return plt.subplots(options.pop("nrows", 1), columns, figsize=(width, height), **options)


def save(fig, folder, name):
    folder.mkdir(parents=True, exist_ok=True)
    fig.savefig(folder / name, metadata={"Date": None})
    plt.close(fig)
    return name
